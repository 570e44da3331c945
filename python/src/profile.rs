//! Bodies.

use crate::call::{self, Array, Numbers};
use crate::curve::Curve;
use crate::errors;
use linecontact::profile::{
    Crowning, Ellipse, Fit, Involute, Line, Parabola, Placed, Placement, Spline, rounded_punch,
    wedge,
};
use linecontact::{ContactError, PiecewiseError};
use linecontact::{Convexity, CurvePoint, Flat, ParametricProfile, Piecewise, check_derivatives};
use numpy::PyReadonlyArray2;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::sync::Arc;

pub type Shared = Arc<dyn ParametricProfile<f64>>;

/// A body that can be put elsewhere: how depends on what it is joined from.
enum Shape {
    Smooth(Shared),
    Joined(Piecewise<f64, Shared>),
    Wedge([f64; 2], f64),
    RoundedPunch(f64, f64, f64),
    Spline(Spline<f64>),
}

/// A body, ready to be pressed against another.
#[pyclass(frozen, module = "linecontact._native")]
pub struct Profile {
    shape: Shape,
    pub shared: Shared,
}

/// A row of Python's own: the name of a step and its numbers.
type Step = (String, Vec<f64>);

fn placement(steps: Vec<Step>) -> PyResult<Placement<f64>> {
    let mut placement = Placement::default();
    for (name, numbers) in steps {
        placement = match (name.as_str(), numbers.as_slice()) {
            ("shifted", &[along, across]) => placement.shifted(along, across),
            ("mirrored", []) => placement.mirrored(),
            ("flipped", []) => placement.flipped(),
            ("rotated", &[angle]) => placement.rotated(angle),
            ("scaled", &[factor]) => placement.scaled(factor),
            _ => return Err(PyValueError::new_err(format!("no step {name}{numbers:?}"))),
        };
    }
    Ok(placement)
}

fn convexity(name: &str) -> PyResult<Convexity> {
    Ok(match name {
        "unknown" => Convexity::Unknown,
        "straight" => Convexity::Straight,
        "convex" => Convexity::Convex,
        "concave" => Convexity::Concave,
        _ => {
            let says = format!("{name:?} is none of 'unknown', 'straight', 'convex', 'concave'");
            return Err(PyValueError::new_err(says));
        }
    })
}

impl Profile {
    fn smooth<E: Into<ContactError<f64>>>(
        py: Python<'_>,
        made: Result<impl ParametricProfile<f64> + 'static, E>,
    ) -> PyResult<Self> {
        let made = made.map_err(|error| errors::to_python(py, &error.into()))?;
        let shared: Shared = Arc::new(made);
        Ok(Self { shape: Shape::Smooth(shared.clone()), shared })
    }
}

#[pymethods]
impl Profile {
    #[staticmethod]
    fn flat(py: Python<'_>) -> PyResult<Self> {
        Self::smooth(py, Ok::<_, ContactError<f64>>(Flat))
    }

    #[staticmethod]
    fn line(py: Python<'_>, slope: f64, domain: [f64; 2]) -> PyResult<Self> {
        Self::smooth(py, Line::new(slope, domain))
    }

    #[staticmethod]
    fn parabola(py: Python<'_>, radius: f64, domain: [f64; 2]) -> PyResult<Self> {
        Self::smooth(py, Parabola::new(radius, domain))
    }

    #[staticmethod]
    fn ellipse(py: Python<'_>, along: f64, across: f64, angles: [f64; 2]) -> PyResult<Self> {
        Self::smooth(py, Ellipse::new(along, across, angles))
    }

    #[staticmethod]
    fn involute(py: Python<'_>, base_radius: f64, origin: f64, angles: [f64; 2]) -> PyResult<Self> {
        Self::smooth(py, Involute::new(base_radius, origin, angles))
    }

    #[staticmethod]
    fn crowning(py: Python<'_>, depth: f64, half_length: f64, domain: [f64; 2]) -> PyResult<Self> {
        Self::smooth(py, Crowning::new(depth, half_length, domain))
    }

    #[staticmethod]
    fn wedge(py: Python<'_>, slopes: [f64; 2], reach: f64) -> PyResult<Self> {
        let shared = call::library(py, || wedge(slopes, reach))?;
        Ok(Self { shape: Shape::Wedge(slopes, reach), shared: Arc::new(shared) })
    }

    #[staticmethod]
    fn rounded_punch(py: Python<'_>, flat: f64, radius: f64, reach: f64) -> PyResult<Self> {
        let shared = call::library(py, || rounded_punch(flat, radius, reach))?;
        Ok(Self { shape: Shape::RoundedPunch(flat, radius, reach), shared: Arc::new(shared) })
    }

    /// Rows of x and y.
    #[staticmethod]
    #[pyo3(signature = (points, noise, outliers))]
    fn spline(
        py: Python<'_>,
        points: PyReadonlyArray2<'_, f64>,
        noise: f64,
        outliers: Option<f64>,
    ) -> PyResult<Self> {
        let points: Vec<[f64; 2]> =
            points.as_array().rows().into_iter().map(|row| [row[0], row[1]]).collect();
        let spline = call::library(py, || Spline::fitted(&points, Fit { noise, outliers }))?;
        Ok(Self { shape: Shape::Spline(spline.clone()), shared: Arc::new(spline) })
    }

    #[staticmethod]
    #[pyo3(name = "curve")]
    fn of_function(
        py: Python<'_>,
        domain: [f64; 2],
        function: Py<PyAny>,
        bulges: &str,
    ) -> PyResult<Self> {
        let curve = Curve::new(py, domain, function, convexity(bulges)?)?;
        Self::smooth(py, Ok::<_, ContactError<f64>>(curve))
    }

    #[staticmethod]
    #[pyo3(signature = (parts, tolerance))]
    fn piecewise(
        py: Python<'_>,
        parts: Vec<Bound<'_, Self>>,
        tolerance: Option<f64>,
    ) -> PyResult<Self> {
        let parts: Vec<Shared> = parts.iter().map(|part| part.get().shared.clone()).collect();
        let joined = call::library(py, || match tolerance {
            None => Piecewise::new(parts),
            Some(tolerance) => Piecewise::with_tolerance(parts, tolerance),
        })?;
        Ok(Self { shape: Shape::Joined(joined.clone()), shared: Arc::new(joined) })
    }

    fn placed(&self, py: Python<'_>, steps: Vec<Step>) -> PyResult<Self> {
        let placement = placement(steps)?;
        fn joined<P: ParametricProfile<f64> + 'static>(
            put: Piecewise<f64, P>,
        ) -> Result<Shared, PiecewiseError<f64>> {
            Ok(Arc::new(put))
        }
        let shared: Shared = match &self.shape {
            Shape::Smooth(shared) => {
                let shared = shared.clone();
                Arc::new(call::library(py, || Placed::new(shared, placement))?)
            }
            Shape::Joined(whole) => {
                let whole = whole.clone();
                call::library(py, || whole.placed(placement).and_then(joined))?
            }
            &Shape::Wedge(slopes, reach) => {
                call::library(py, || wedge(slopes, reach)?.placed(placement).and_then(joined))?
            }
            &Shape::RoundedPunch(flat, radius, reach) => call::library(py, || {
                rounded_punch(flat, radius, reach)?.placed(placement).and_then(joined)
            })?,
            Shape::Spline(spline) => {
                let spline = spline.clone();
                call::library(py, || spline.placed(placement).and_then(joined))?
            }
        };
        // What is put elsewhere is put there in one go: Python keeps the steps.
        Ok(Self { shape: Shape::Smooth(shared.clone()), shared })
    }

    #[getter]
    fn domain(&self) -> [f64; 2] {
        self.shared.domain()
    }

    #[getter]
    fn pieces(&self) -> usize {
        self.shared.pieces().max(1)
    }

    #[getter]
    fn convexity(&self) -> &'static str {
        match self.shared.convexity() {
            Convexity::Unknown => "unknown",
            Convexity::Straight => "straight",
            Convexity::Convex => "convex",
            Convexity::Concave => "concave",
        }
    }

    /// X, Y, X' and Y'.
    fn at(&self, py: Python<'_>, k: Numbers<'_>) -> PyResult<[Array; 4]> {
        let k = k.as_array().to_vec();
        let points = call::library(py, || {
            let zero = CurvePoint { x: 0.0, y: 0.0, dx: 0.0, dy: 0.0 };
            let mut points = vec![zero; k.len()];
            self.shared.at_many(&k, &mut points);
            Ok::<_, ContactError<f64>>(points)
        })?;
        let part =
            |of: fn(&CurvePoint<f64>) -> f64| call::array(py, points.iter().map(of).collect());
        Ok([part(|p| p.x), part(|p| p.y), part(|p| p.dx), part(|p| p.dy)])
    }

    fn check_derivatives(&self, py: Python<'_>) -> PyResult<()> {
        call::library(py, || check_derivatives(&self.shared))
    }
}
