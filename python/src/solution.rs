//! Results of a solve.

use crate::call::{self, Array, Numbers};
use crate::control::{ReferenceRow, references};
use linecontact::stress::{Stress, StressPeak, Subsurface};
use linecontact::{
    Body, ContactError, Cost, Ends, EvaluationError, Extremum, Interval, Peak, Pressure,
    Uncertainty,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::fmt::Debug;

type Pair = (f64, f64);

/// Abscissa, pressure and its error.
type Top = (f64, f64, f64);

fn top(Peak { x, pressure, error }: Peak<f64>) -> Top {
    (x, pressure, error)
}

/// Takes an infinite value for the largest, at the corner that has it, as arrays and tables do.
fn or_infinite<R>(
    found: Result<R, ContactError<f64>>,
    infinite: impl FnOnce(f64) -> R,
) -> Result<R, ContactError<f64>> {
    match found {
        Err(ContactError::Evaluation(EvaluationError::Singular { x })) => Ok(infinite(x)),
        found => found,
    }
}

/// Returns the largest pressure, `inf` at the corner that has it.
fn peak(solution: &linecontact::Solution<'_, f64>) -> Result<Top, ContactError<f64>> {
    or_infinite(solution.peak().map(top), |x| (x, f64::INFINITY, 0.0))
}

/// Returns the largest stress below, `inf` on the surface at the corner that has it.
fn or_at_corner(
    found: Result<StressPeak<f64>, ContactError<f64>>,
) -> Result<Largest, ContactError<f64>> {
    or_infinite(found.map(largest), |x| (x, 0.0, f64::INFINITY))
}

/// Takes zero for the gap, or its slope, at a place in a contact.
fn or_zero(found: Result<f64, ContactError<f64>>) -> Result<f64, ContactError<f64>> {
    match found {
        Err(ContactError::Evaluation(EvaluationError::InvalidPosition {
            inside: false, ..
        })) => Ok(0.0),
        found => found,
    }
}

/// Fields of a [`Cost`].
type Counts = (usize, usize, usize, usize, usize);

fn pair(on: &Interval<f64>) -> Pair {
    (on.left, on.right)
}

fn counts(cost: Cost) -> Counts {
    let Cost { samples, evaluations, heights, searches, search_values } = cost;
    (samples, evaluations, heights, searches, search_values)
}

/// Returns the name of a variant in Python, `lowest_gap` of `LowestGap`.
fn name(variant: impl Debug) -> String {
    let mut name = String::new();
    for letter in format!("{variant:?}").chars() {
        name += if letter.is_uppercase() && !name.is_empty() { "_" } else { "" };
        name.push(letter.to_ascii_lowercase());
    }
    name
}

/// A solved contact.
#[pyclass(frozen, module = "linecontact._native")]
pub struct Solution(pub linecontact::Solution<'static, f64>);

/// Interval, load, strengths, peak, moment, centre of pressure, and flags: held at corners.
type Region = (Pair, f64, Pair, Top, f64, Option<f64>, (bool, bool));

/// Intervals, load, loads, κ, tilt, mean pressure, peak and centre of pressure.
type Row = (Vec<Pair>, f64, Vec<f64>, f64, f64, f64, Top, Option<f64>);

/// Least ratio of pressures, least gap, spacing and cost.
type Proof = (Option<Pair>, Option<Pair>, f64, Counts, bool);

/// Abscissa x, depth and value.
type Largest = (f64, f64, f64);

fn largest(StressPeak { x, depth, value }: StressPeak<f64>) -> Largest {
    (x, depth, value)
}

fn extremum(Extremum { x, value }: Extremum<f64>) -> Pair {
    (x, value)
}

/// Returns σ_x, σ_y and τ_xy at points.
fn stresses(
    (x, depth): (&[f64], &[f64]),
    at: impl Fn(f64, f64) -> Result<Stress<f64>, ContactError<f64>>,
) -> Result<[Vec<f64>; 3], ContactError<f64>> {
    let mut found: [Vec<f64>; 3] = Default::default();
    for (&x, &depth) in x.iter().zip(depth) {
        if call::look().is_break() {
            break;
        }
        let Stress { sigma_x, sigma_y, tau_xy } = at(x, depth)?;
        for (of_all, stress) in found.iter_mut().zip([sigma_x, sigma_y, tau_xy]) {
            of_all.push(stress);
        }
    }
    Ok(found)
}

pub fn body(name: &str) -> PyResult<Body> {
    match name {
        "lower" => Ok(Body::Lower),
        "upper" => Ok(Body::Upper),
        _ => Err(PyValueError::new_err(format!("body is {name:?}: 'lower' or 'upper'"))),
    }
}

impl Solution {
    /// Takes an infinite pressure, or tension, for its value at a corner, as NumPy does.
    fn or_infinite(
        &self,
        x: f64,
        found: Result<f64, ContactError<f64>>,
    ) -> Result<f64, ContactError<f64>> {
        if !matches!(found, Err(ContactError::Evaluation(EvaluationError::Singular { .. }))) {
            return found;
        }
        let strength = |one: &linecontact::ContactRegion<f64>| {
            let Ends { left, right } = one.edge_singularities;
            let inside = one.interval.contains(x).then_some(1.0);
            if x == one.interval.left {
                Some(left)
            } else if x == one.interval.right {
                Some(right)
            } else {
                inside
            }
        };
        // A strength that is zero to rounding has no sign.
        let least = 1e-12 * self.0.mean_pressure().abs();
        let strength = self.0.contacts()?.iter().find_map(strength).filter(|k| k.abs() > least);
        strength.map_or(found, |strength| Ok(f64::INFINITY.copysign(strength)))
    }

    /// Prepares the stress below one body, or below both alike, from one depth to another.
    fn below(
        &self,
        of: Option<Body>,
        depths: Option<Pair>,
        friction: f64,
    ) -> Result<Subsurface<'_, f64>, ContactError<f64>> {
        let mut below = match of {
            Some(of) => self.0.subsurface_of(of)?,
            None => self.0.subsurface()?,
        };
        if let Some((from, to)) = depths {
            below = below.within([from, to])?;
        }
        below.friction(friction)
    }
}

#[pymethods]
impl Solution {
    #[getter]
    fn a(&self) -> f64 {
        self.0.a()
    }

    #[getter]
    fn b(&self) -> f64 {
        self.0.b()
    }

    #[getter]
    fn load(&self) -> f64 {
        self.0.load()
    }

    #[getter]
    fn tilt(&self) -> f64 {
        self.0.tilt()
    }

    #[getter]
    fn half_width(&self) -> f64 {
        self.0.hull().half_width()
    }

    #[getter]
    fn centre(&self) -> f64 {
        self.0.hull().centre()
    }

    #[getter]
    fn intervals(&self) -> Vec<Pair> {
        self.0.intervals().iter().map(pair).collect()
    }

    #[getter]
    fn limits_error(&self) -> Option<f64> {
        self.0.limits_error()
    }

    #[getter]
    fn edge_singularities(&self) -> (f64, f64) {
        let Ends { left, right } = self.0.edge_singularities();
        (left, right)
    }

    #[getter]
    fn mean_pressure(&self) -> f64 {
        self.0.mean_pressure()
    }

    #[getter]
    fn attempts(&self) -> Vec<(String, String)> {
        let attempts = self.0.report().attempts().iter();
        attempts.map(|attempt| (name(attempt.start), name(attempt.outcome))).collect()
    }

    #[getter]
    fn is_checked(&self) -> bool {
        self.0.report().is_checked()
    }

    #[getter]
    fn is_apart(&self) -> bool {
        self.0.is_apart()
    }

    #[getter]
    fn separation(&self) -> f64 {
        self.0.separation()
    }

    #[getter]
    fn is_steep(&self, py: Python<'_>) -> PyResult<bool> {
        call::library(py, || Ok::<_, ContactError<f64>>(self.0.is_steep()))
    }

    #[getter]
    fn conformity(&self, py: Python<'_>) -> PyResult<Option<(f64, f64, f64)>> {
        let found = call::library(py, || Ok::<_, ContactError<f64>>(self.0.conformity()))?;
        Ok(found.map(|found| (found.angle, found.too_low, found.parabolas_too_low)))
    }

    #[getter]
    fn cost(&self) -> Counts {
        counts(self.0.cost())
    }

    fn steepest_slope(&self, py: Python<'_>) -> PyResult<f64> {
        call::library(py, || self.0.steepest_slope())
    }

    fn pressure(&self, py: Python<'_>, x: Numbers<'_>) -> PyResult<Array> {
        let x = x.as_array().to_vec();
        let pressures = call::library(py, || {
            let (mut pressures, pressure) = (vec![0.0; x.len()], self.0.pressure()?);
            match pressure.at_many(&x, &mut pressures) {
                Err(ContactError::Evaluation(EvaluationError::Singular { .. })) => {
                    x.iter().map(|&x| self.or_infinite(x, pressure.at(x))).collect()
                }
                found => found.map(|()| pressures),
            }
        })?;
        Ok(call::array(py, pressures))
    }

    fn pressure_estimate(&self, py: Python<'_>, x: Numbers<'_>) -> PyResult<(Array, Array)> {
        let x = x.as_array().to_vec();
        let (values, errors) = call::library(py, || {
            let pressure: Pressure<'_, f64> = self.0.pressure()?;
            let estimate = |&x| match pressure.with_error(x) {
                Ok(found) => Ok((found.value, found.error)),
                Err(error) => self.or_infinite(x, Err(error)).map(|infinite| (infinite, 0.0)),
            };
            x.iter().map(estimate).collect::<Result<(Vec<f64>, Vec<f64>), ContactError<f64>>>()
        })?;
        Ok((call::array(py, values), call::array(py, errors)))
    }

    /// Returns abscissae and pressures for drawing.
    fn sample(&self, py: Python<'_>, count: usize) -> PyResult<(Array, Array)> {
        let points = call::library(py, || self.0.pressure()?.sample(count))?;
        let (x, pressures) = points.into_iter().map(|[x, pressure]| (x, pressure)).unzip();
        Ok((call::array(py, x), call::array(py, pressures)))
    }

    fn peak(&self, py: Python<'_>) -> PyResult<Top> {
        call::library(py, || peak(&self.0))
    }

    #[getter]
    fn moment(&self, py: Python<'_>) -> PyResult<f64> {
        call::library(py, || self.0.moment())
    }

    #[getter]
    fn centre_of_pressure(&self, py: Python<'_>) -> PyResult<f64> {
        call::library(py, || self.0.centre_of_pressure())
    }

    fn contacts(&self, py: Python<'_>) -> PyResult<Vec<Region>> {
        let contacts = call::library(py, || self.0.contacts())?;
        let region = |contact: &linecontact::ContactRegion<f64>| {
            let Ends { left, right } = contact.edge_singularities;
            let infinite = || (contact.infinite_at.unwrap_or(f64::NAN), f64::INFINITY, 0.0);
            let peak = contact.peak.map_or_else(infinite, top);
            let centre = contact.centre_of_pressure().ok();
            let held = (contact.held.left, contact.held.right);
            let (strengths, moment) = ((left, right), contact.moment());
            (pair(&contact.interval), contact.load, strengths, peak, moment, centre, held)
        };
        Ok(contacts.iter().map(region).collect())
    }

    fn stress(
        &self,
        py: Python<'_>,
        of: Option<&str>,
        x: Numbers<'_>,
        depth: Numbers<'_>,
        friction: f64,
    ) -> PyResult<[Array; 3]> {
        let of = of.map(body).transpose()?;
        let (x, depth) = (x.as_array().to_vec(), depth.as_array().to_vec());
        let found = call::library(py, || {
            let subsurface = self.below(of, None, friction)?;
            stresses((&x, &depth), |x, depth| subsurface.at(x, depth))
        })?;
        Ok(found.map(|stress| call::array(py, stress)))
    }

    fn max_shear(
        &self,
        py: Python<'_>,
        of: Option<&str>,
        depths: Option<Pair>,
        friction: f64,
    ) -> PyResult<Largest> {
        let of = of.map(body).transpose()?;
        call::library(py, || or_at_corner(self.below(of, depths, friction)?.max_shear()))
    }

    fn max_von_mises(
        &self,
        py: Python<'_>,
        of: Option<&str>,
        depths: Option<Pair>,
        poisson: f64,
        friction: f64,
    ) -> PyResult<Largest> {
        let of = of.map(body).transpose()?;
        call::library(py, || or_at_corner(self.below(of, depths, friction)?.max_von_mises(poisson)))
    }

    fn max_tension(&self, py: Python<'_>, of: Option<&str>, friction: f64) -> PyResult<Pair> {
        let of = of.map(body).transpose()?;
        call::library(py, || {
            or_infinite(self.below(of, None, friction)?.max_tension().map(extremum), |x| {
                (x, f64::INFINITY)
            })
        })
    }

    fn gap(&self, py: Python<'_>, x: Numbers<'_>) -> PyResult<Array> {
        let x = x.as_array().to_vec();
        let at = |x| or_zero(self.0.gap_at(x));
        Ok(call::array(py, call::library(py, || call::each(&x, at))?))
    }

    fn gap_slope(&self, py: Python<'_>, x: Numbers<'_>) -> PyResult<Array> {
        let x = x.as_array().to_vec();
        let at = |x| or_zero(self.0.gap_slope(x));
        Ok(call::array(py, call::library(py, || call::each(&x, at))?))
    }

    fn residual(&self, py: Python<'_>, x: Numbers<'_>) -> PyResult<Array> {
        let x = x.as_array().to_vec();
        Ok(call::array(py, call::library(py, || call::each(&x, |x| self.0.residual(x)))?))
    }

    fn approach(&self, py: Python<'_>, to: ReferenceRow) -> PyResult<(f64, f64, f64)> {
        let to = references(to)?;
        let approach = call::library(py, || self.0.approach(&to))?;
        Ok((approach.bodies, approach.lower, approach.upper))
    }

    fn displacement(
        &self,
        py: Python<'_>,
        x: Numbers<'_>,
        to: ReferenceRow,
        of: &str,
    ) -> PyResult<Array> {
        let (x, to, of) = (x.as_array().to_vec(), references(to)?, body(of)?);
        let at = |x| self.0.displacement(of, x, &to);
        Ok(call::array(py, call::library(py, || call::each(&x, at))?))
    }

    fn stiffness(&self, py: Python<'_>, to: ReferenceRow) -> PyResult<f64> {
        let to = references(to)?;
        call::library(py, || self.0.stiffness(&to))
    }

    fn load_rates(&self, py: Python<'_>) -> PyResult<LoadRates> {
        call::library(py, || self.0.load_rates()).map(LoadRates)
    }

    /// Returns the standard deviations of a, b, half-width and peak pressure.
    fn uncertainty(&self, py: Python<'_>) -> PyResult<(f64, f64, f64, f64)> {
        let Uncertainty { a, b, half_width, peak_pressure } =
            call::library(py, || self.0.uncertainty())?;
        Ok((a, b, half_width, peak_pressure))
    }

    fn certify(&self, py: Python<'_>) -> PyResult<Proof> {
        let proof = call::library(py, || self.0.certify())?;
        let [pressure, gap] = [proof.pressure, proof.gap].map(|found| found.map(extremum));
        Ok((pressure, gap, proof.spacing, counts(proof.cost), proof.is_proved()))
    }

    fn summary(&self, py: Python<'_>) -> PyResult<Row> {
        let (row, peak) = call::library(py, || {
            let row = self.0.summary()?;
            let peak = row.peak.map_or_else(|| peak(&self.0), |found| Ok(top(found)))?;
            Ok::<_, ContactError<f64>>((row, peak))
        })?;
        let intervals = row.intervals.iter().map(pair).collect();
        let (kappa, mean, centre) = (row.kappa, row.mean_pressure, row.centre_of_pressure);
        Ok((intervals, row.load, row.loads, kappa, row.tilt, mean, peak, centre))
    }

    fn __str__(&self, py: Python<'_>) -> PyResult<String> {
        call::library(py, || Ok::<_, ContactError<f64>>(self.0.to_string()))
    }
}

/// Derivatives by the load.
#[pyclass(frozen, module = "linecontact._native")]
pub struct LoadRates(linecontact::LoadRates<f64>);

#[pymethods]
impl LoadRates {
    #[getter]
    fn a(&self) -> f64 {
        self.0.a
    }

    #[getter]
    fn b(&self) -> f64 {
        self.0.b
    }

    #[getter]
    fn limits(&self) -> Vec<Pair> {
        self.0.limits.iter().map(|rates| (rates.left, rates.right)).collect()
    }

    fn pressure(&self, py: Python<'_>, x: Numbers<'_>) -> PyResult<Array> {
        let x = x.as_array().to_vec();
        Ok(call::array(py, call::library(py, || call::each(&x, |x| self.0.pressure(x)))?))
    }
}

/// Contact that sticks in part.
#[pyclass(frozen, module = "linecontact._native")]
pub struct PartialSlip(pub linecontact::PartialSlip<'static, f64>);

#[pymethods]
impl PartialSlip {
    #[getter]
    fn normal(&self) -> Solution {
        Solution(self.0.normal().clone())
    }

    #[getter]
    fn stick_zones(&self) -> Vec<Pair> {
        self.0.stick_zones().iter().map(pair).collect()
    }

    fn traction(&self, py: Python<'_>, x: Numbers<'_>) -> PyResult<Array> {
        let x = x.as_array().to_vec();
        let tractions = call::library(py, || {
            let mut tractions = vec![0.0; x.len()];
            self.0.traction()?.at_many(&x, &mut tractions)?;
            Ok::<_, ContactError<f64>>(tractions)
        })?;
        Ok(call::array(py, tractions))
    }

    fn stress(
        &self,
        py: Python<'_>,
        of: &str,
        x: Numbers<'_>,
        depth: Numbers<'_>,
    ) -> PyResult<[Array; 3]> {
        let (of, x, depth) = (body(of)?, x.as_array().to_vec(), depth.as_array().to_vec());
        let found = call::library(py, || {
            let subsurface = self.0.subsurface(of)?;
            stresses((&x, &depth), |x, depth| subsurface.at(x, depth))
        })?;
        Ok(found.map(|stress| call::array(py, stress)))
    }

    fn max_shear(&self, py: Python<'_>, of: &str) -> PyResult<Largest> {
        let of = body(of)?;
        call::library(py, || or_at_corner(self.0.subsurface(of)?.max_shear()))
    }

    fn max_von_mises(&self, py: Python<'_>, of: &str, poisson: f64) -> PyResult<Largest> {
        let of = body(of)?;
        call::library(py, || or_at_corner(self.0.subsurface(of)?.max_von_mises(poisson)))
    }

    fn max_tension(&self, py: Python<'_>, of: &str) -> PyResult<Pair> {
        let of = body(of)?;
        call::library(py, || {
            or_infinite(self.0.subsurface(of)?.max_tension().map(extremum), |x| (x, f64::INFINITY))
        })
    }
}
