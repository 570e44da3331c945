//! Bodies.

mod lift;

pub use lift::{AsTheyAre, Lift, Rate, Varied};

use crate::call::{self, Array, Numbers};
use crate::curve::Curve;
use crate::errors::{self, Named};
use linecontact::profile::{
    Crowning, Ellipse, Fit, Involute, Line, Parabola, Placed, Placement, Spline, rounded_punch,
    wedge,
};
use linecontact::{
    ContactError, Convexity, CurvePoint, Flat, ParametricProfile, Piecewise, Real,
    check_derivatives,
};
use numpy::PyReadonlyArray2;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::borrow::Cow;
use std::sync::Arc;

pub type Shared<T> = Arc<dyn ParametricProfile<T>>;

/// Name of a step in Python, and its numbers.
type Step = (String, Vec<f64>);

/// Recipe of a body: everything that it is built from, in numbers of any kind.
pub enum Recipe {
    Flat,
    Line { slope: f64, domain: [f64; 2] },
    Parabola { radius: f64, domain: [f64; 2] },
    Ellipse { along: f64, across: f64, angles: [f64; 2] },
    Involute { base_radius: f64, origin: f64, angles: [f64; 2] },
    Crowning { depth: f64, half_length: f64, domain: [f64; 2] },
    Wedge { slopes: [f64; 2], reach: f64 },
    RoundedPunch { flat: f64, radius: f64, reach: f64 },
    Spline { points: Vec<[f64; 2]>, smooth: bool, outliers: Option<f64> },
    Curve(Arc<Curve>),
    Piecewise { parts: Vec<Py<Profile>>, tolerance: Option<f64> },
    Placed { body: Py<Profile>, steps: Vec<Step> },
}

/// Body that can be placed, in a way that depends on its pieces.
#[derive(Clone)]
pub enum Built<T: Real> {
    Smooth(Shared<T>),
    Joined(Piecewise<T, Shared<T>>),
    Wedge(Piecewise<T, Line<T>>),
    RoundedPunch(Piecewise<T, Placed<T, Parabola<T>>>),
    Spline(Spline<T>),
}

/// A body, ready to be pressed against another.
#[pyclass(frozen, module = "linecontact._native")]
pub struct Profile {
    pub recipe: Recipe,
    pub built: Built<f64>,
    shared: Shared<f64>,
}

fn smooth<T: Real + Named, E: Into<ContactError<T>>>(
    py: Python<'_>,
    made: Result<impl ParametricProfile<T> + 'static, E>,
) -> PyResult<Built<T>> {
    let made = made.map_err(|error| errors::to_python(py, &error.into()))?;
    Ok(Built::Smooth(Arc::new(made)))
}

impl Recipe {
    /// Builds the body from numbers that `lift` makes of the recipe's.
    pub fn build<L: Lift>(&self, py: Python<'_>, lift: &mut L) -> PyResult<Built<L::Of>> {
        match *self {
            Self::Flat => Ok(Built::Smooth(Arc::new(Flat))),
            Self::Line { slope, domain } => {
                let slope = lift.number("slope", slope);
                smooth(py, Line::new(slope, lift.pair("domain", domain)))
            }
            Self::Parabola { radius, domain } => {
                let radius = lift.number("radius", radius);
                smooth(py, Parabola::new(radius, lift.pair("domain", domain)))
            }
            Self::Ellipse { along, across, angles } => {
                let (along, across) = (lift.number("along", along), lift.number("across", across));
                smooth(py, Ellipse::new(along, across, lift.pair("angles", angles)))
            }
            Self::Involute { base_radius, origin, angles } => {
                let base_radius = lift.number("base_radius", base_radius);
                let origin = lift.number("origin", origin);
                smooth(py, Involute::new(base_radius, origin, lift.pair("angles", angles)))
            }
            Self::Crowning { depth, half_length, domain } => {
                let depth = lift.number("depth", depth);
                let half_length = lift.number("half_length", half_length);
                smooth(py, Crowning::new(depth, half_length, lift.pair("domain", domain)))
            }
            Self::Wedge { slopes, reach } => {
                let (slopes, reach) = (lift.pair("slopes", slopes), lift.number("reach", reach));
                call::library(py, || wedge(slopes, reach)).map(Built::Wedge)
            }
            Self::RoundedPunch { flat, radius, reach } => {
                let (flat, radius) = (lift.number("flat", flat), lift.number("radius", radius));
                let reach = lift.number("reach", reach);
                call::library(py, || rounded_punch(flat, radius, reach)).map(Built::RoundedPunch)
            }
            // Measured points are not parameters.
            Self::Spline { ref points, smooth, outliers } => {
                let of = <L::Of as Real>::of;
                let points: Vec<_> = points.iter().map(|point| point.map(of)).collect();
                let fit = Fit { smooth, outliers: outliers.map(of) };
                call::library(py, || Spline::fitted(&points, fit)).map(Built::Spline)
            }
            Self::Curve(ref curve) => lift.curve(curve),
            Self::Piecewise { ref parts, tolerance } => {
                let mut built = Vec::with_capacity(parts.len());
                lift.inside("parts", |lift| {
                    for (i, part) in parts.iter().enumerate() {
                        let part = lift.inside(i, |lift| lift.body(py, part.get()))?;
                        built.push(part.shared());
                    }
                    Ok::<_, PyErr>(())
                })?;
                let joined = call::library(py, || match tolerance {
                    None => Piecewise::new(built),
                    Some(tolerance) => {
                        Piecewise::with_tolerance(built, <L::Of as Real>::of(tolerance))
                    }
                });
                joined.map(Built::Joined)
            }
            Self::Placed { ref body, ref steps } => {
                if let Self::Spline { points, smooth: true, .. } = &body.get().recipe {
                    let placement = placement(steps, lift)?;
                    return call::library(py, || refitted(points, placement)).map(Built::Spline);
                }
                let body = lift.body(py, body.get())?;
                let placement = placement(steps, lift)?;
                // A body is placed in one go: Python keeps the steps.
                call::library(py, || body.placed(placement)).map(Built::Smooth)
            }
        }
    }
}

/// Fits a smoothed spline to its points where they are placed: placed afterwards, it would lose its
/// uncertainty.
fn refitted<T: Real>(
    points: &[[f64; 2]],
    placement: Placement<T>,
) -> Result<Spline<T>, ContactError<T>> {
    // Refuses an impossible placement.
    Placed::new(Flat, placement)?;
    let points: Vec<_> = points.iter().map(|point| point.map(T::of)).collect();
    // The fit at the first place has looked for outliers.
    Ok(Spline::fitted_at(&points, Fit { smooth: true, outliers: None }, placement)?)
}

fn placement<L: Lift>(steps: &[Step], lift: &mut L) -> PyResult<Placement<L::Of>> {
    let mut placement = Placement::default();
    for (i, (name, numbers)) in steps.iter().enumerate() {
        let alike = |steps: &[Step]| steps.iter().filter(|(other, _)| other == name).count();
        // A number distinguishes steps of the same name.
        let label = match alike(steps) {
            1 => Cow::from(name),
            _ => Cow::from(format!("{name}.{}", alike(&steps[..i]))),
        };
        placement = lift.inside(label, |lift| {
            Ok(match (name.as_str(), numbers.as_slice()) {
                ("shifted", &[along, across]) => {
                    let along = lift.number("along", along);
                    placement.shifted(along, lift.number("across", across))
                }
                ("mirrored", []) => placement.mirrored(),
                ("flipped", []) => placement.flipped(),
                ("rotated", &[angle]) => placement.rotated(lift.number("angle", angle)),
                ("scaled", &[factor]) => placement.scaled(lift.number("factor", factor)),
                _ => return Err(PyValueError::new_err(format!("no step {name}{numbers:?}"))),
            })
        })?;
    }
    Ok(placement)
}

impl<T: Real> Built<T> {
    pub fn shared(&self) -> Shared<T> {
        match self {
            Self::Smooth(shared) => shared.clone(),
            Self::Joined(whole) => Arc::new(whole.clone()),
            Self::Wedge(whole) => Arc::new(whole.clone()),
            Self::RoundedPunch(whole) => Arc::new(whole.clone()),
            Self::Spline(spline) => Arc::new(spline.clone()),
        }
    }

    fn placed(self, placement: Placement<T>) -> Result<Shared<T>, ContactError<T>> {
        Ok(match self {
            Self::Smooth(shared) => Arc::new(Placed::new(shared, placement)?),
            Self::Joined(whole) => Arc::new(whole.placed(placement)?),
            Self::Wedge(whole) => Arc::new(whole.placed(placement)?),
            Self::RoundedPunch(whole) => Arc::new(whole.placed(placement)?),
            Self::Spline(spline) => Arc::new(spline.placed(placement)?),
        })
    }
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
    fn of(py: Python<'_>, recipe: Recipe) -> PyResult<Self> {
        let built = recipe.build(py, &mut AsTheyAre)?;
        let shared = built.shared();
        Ok(Self { recipe, built, shared })
    }
}

#[pymethods]
impl Profile {
    #[staticmethod]
    fn flat(py: Python<'_>) -> PyResult<Self> {
        Self::of(py, Recipe::Flat)
    }

    #[staticmethod]
    fn line(py: Python<'_>, slope: f64, domain: [f64; 2]) -> PyResult<Self> {
        Self::of(py, Recipe::Line { slope, domain })
    }

    #[staticmethod]
    fn parabola(py: Python<'_>, radius: f64, domain: [f64; 2]) -> PyResult<Self> {
        Self::of(py, Recipe::Parabola { radius, domain })
    }

    #[staticmethod]
    fn ellipse(py: Python<'_>, along: f64, across: f64, angles: [f64; 2]) -> PyResult<Self> {
        Self::of(py, Recipe::Ellipse { along, across, angles })
    }

    #[staticmethod]
    fn involute(py: Python<'_>, base_radius: f64, origin: f64, angles: [f64; 2]) -> PyResult<Self> {
        Self::of(py, Recipe::Involute { base_radius, origin, angles })
    }

    #[staticmethod]
    fn crowning(py: Python<'_>, depth: f64, half_length: f64, domain: [f64; 2]) -> PyResult<Self> {
        Self::of(py, Recipe::Crowning { depth, half_length, domain })
    }

    #[staticmethod]
    fn wedge(py: Python<'_>, slopes: [f64; 2], reach: f64) -> PyResult<Self> {
        Self::of(py, Recipe::Wedge { slopes, reach })
    }

    #[staticmethod]
    fn rounded_punch(py: Python<'_>, flat: f64, radius: f64, reach: f64) -> PyResult<Self> {
        Self::of(py, Recipe::RoundedPunch { flat, radius, reach })
    }

    /// Makes a spline from rows of x and y.
    #[staticmethod]
    #[pyo3(signature = (points, smooth, outliers))]
    fn spline(
        py: Python<'_>,
        points: PyReadonlyArray2<'_, f64>,
        smooth: bool,
        outliers: Option<f64>,
    ) -> PyResult<Self> {
        let rows = points.as_array();
        let points = rows.rows().into_iter().map(|row| [row[0], row[1]]).collect();
        Self::of(py, Recipe::Spline { points, smooth, outliers })
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
        Self::of(py, Recipe::Curve(Arc::new(curve)))
    }

    #[staticmethod]
    #[pyo3(signature = (parts, tolerance))]
    fn piecewise(py: Python<'_>, parts: Vec<Py<Self>>, tolerance: Option<f64>) -> PyResult<Self> {
        Self::of(py, Recipe::Piecewise { parts, tolerance })
    }

    #[pyo3(name = "placed")]
    fn put(body: Py<Self>, py: Python<'_>, steps: Vec<Step>) -> PyResult<Self> {
        Self::of(py, Recipe::Placed { body, steps })
    }

    #[getter]
    fn domain(&self) -> [f64; 2] {
        self.shared.domain()
    }

    #[getter]
    fn pieces(&self) -> usize {
        self.shared.pieces().max(1)
    }

    /// Returns the noise of measured points, as the fit has estimated it.
    #[getter]
    fn noise(&self) -> f64 {
        match &self.built {
            Built::Spline(spline) => spline.noise(),
            _ => 0.0,
        }
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

    /// Returns X, Y, X' and Y'.
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
