//! Bodies.

mod lift;

pub use lift::{AsTheyAre, Lift, Rate, Varied};

use crate::call::{self, Array, Numbers};
use crate::curve::Curve;
use crate::errors;
use linecontact::profile::{Fit, Placed, Placement, Spline};
use linecontact::scene::Shape;
use linecontact::{
    ContactError, Convexity, CurvePoint, ParametricProfile, Piecewise, Real, check_derivatives,
};
use numpy::PyReadonlyArray2;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::borrow::Cow;
use std::collections::HashMap;
use std::sync::Arc;

pub type Shared<T> = Arc<dyn ParametricProfile<T>>;

/// Name of a step in Python, and its numbers.
type Step = (String, Vec<f64>);

/// Body before it is placed: everything that it is built from, in numbers of any kind.
enum Recipe {
    /// Shape of the library, by its name and its numbers.
    Shape(String, HashMap<String, f64>),
    /// Measured points, and the settings of the fit.
    Spline(Vec<[f64; 2]>, Fit<f64>),
    Curve(Arc<Curve>),
    /// Parts, and the tolerance of their joints.
    Piecewise(Vec<Py<Profile>>, Option<f64>),
}

/// A body, ready to be pressed against another.
#[pyclass(frozen, module = "linecontact._native")]
pub struct Profile {
    recipe: Arc<Recipe>,
    steps: Vec<Step>,
    pub built: Shared<f64>,
    /// Noise of measured points, as the fit has estimated it.
    #[pyo3(get)]
    noise: f64,
}

impl Recipe {
    /// Builds the body where it is placed, from numbers that `lift` makes of the recipe's.
    fn build<L: Lift>(
        &self,
        py: Python<'_>,
        steps: &[Step],
        lift: &mut L,
    ) -> PyResult<Shared<L::Of>> {
        let of = <L::Of as Real>::of;
        let shape = match self {
            Self::Shape(name, numbers) => {
                let number = |of: &str| Some(lift.number(of, *numbers.get(of)?));
                let Some(made) = Shape::from_numbers(name, number) else {
                    return Err(PyValueError::new_err(format!("no shape {name} of {numbers:?}")));
                };
                made.map_err(|error| errors::to_python(py, &error))?
            }
            // Measured points are not parameters.
            Self::Spline(points, fit) => Shape::Spline {
                points: points.iter().map(|point| point.map(of)).collect(),
                fit: Fit {
                    smooth: fit.smooth,
                    outliers: fit.outliers.map(of),
                    period: fit.period.map(of),
                },
            },
            Self::Curve(curve) => {
                let (curve, to) = (lift.curve(curve)?, placement(steps, lift)?);
                return call::library(py, || {
                    Ok::<Shared<_>, ContactError<_>>(match to {
                        None => curve,
                        Some(to) => Arc::new(Placed::new(curve, to)?),
                    })
                });
            }
            Self::Piecewise(parts, tolerance) => {
                let parts = lift.inside("parts", |lift| {
                    let part = |(i, part): (usize, &Py<Profile>)| {
                        lift.inside(i, |lift| lift.body(py, part.get()))
                    };
                    parts.iter().enumerate().map(part).collect::<PyResult<Vec<_>>>()
                })?;
                let to = placement(steps, lift)?;
                return call::library(py, || {
                    let whole = match tolerance {
                        None => Piecewise::new(parts)?,
                        Some(tolerance) => Piecewise::with_tolerance(parts, of(*tolerance))?,
                    };
                    Ok::<Shared<_>, ContactError<_>>(match to {
                        None => Arc::new(whole),
                        Some(to) => Arc::new(whole.placed(to)?),
                    })
                });
            }
        };
        let to = placement(steps, lift)?;
        call::library(py, || shape.build(to))
    }
}

/// Returns the placement by some steps; `None` if there are none.
fn placement<L: Lift>(steps: &[Step], lift: &mut L) -> PyResult<Option<Placement<L::Of>>> {
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
    Ok((!steps.is_empty()).then_some(placement))
}

const BULGES: [(&str, Convexity); 4] = [
    ("unknown", Convexity::Unknown),
    ("straight", Convexity::Straight),
    ("convex", Convexity::Convex),
    ("concave", Convexity::Concave),
];

fn convexity(name: &str) -> PyResult<Convexity> {
    let found = BULGES.iter().find(|(known, _)| *known == name).map(|&(_, convexity)| convexity);
    let none = format!("{name:?} is none of 'unknown', 'straight', 'convex', 'concave'");
    found.ok_or_else(|| PyValueError::new_err(none))
}

impl Profile {
    fn of(py: Python<'_>, recipe: Arc<Recipe>, steps: Vec<Step>) -> PyResult<Self> {
        let built = recipe.build(py, &steps, &mut AsTheyAre)?;
        Ok(Self { recipe, steps, built, noise: 0.0 })
    }

    fn new(py: Python<'_>, recipe: Recipe) -> PyResult<Self> {
        Self::of(py, Arc::new(recipe), Vec::new())
    }
}

#[pymethods]
impl Profile {
    /// Makes the shape of the library that has this name, from its numbers by name.
    #[staticmethod]
    fn shape(py: Python<'_>, name: String, numbers: HashMap<String, f64>) -> PyResult<Self> {
        Self::new(py, Recipe::Shape(name, numbers))
    }

    /// Makes a spline from rows of x and y.
    #[staticmethod]
    fn spline(
        py: Python<'_>,
        points: PyReadonlyArray2<'_, f64>,
        smooth: bool,
        outliers: Option<f64>,
        period: Option<f64>,
    ) -> PyResult<Self> {
        let rows = points.as_array();
        let points: Vec<_> = rows.rows().into_iter().map(|row| [row[0], row[1]]).collect();
        let fit = Fit { smooth, outliers, period };
        let spline = call::library(py, || Spline::fitted(&points, fit))?;
        let (noise, recipe) = (spline.noise(), Arc::new(Recipe::Spline(points, fit)));
        Ok(Self { recipe, steps: Vec::new(), built: Arc::new(spline), noise })
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
        Self::new(py, Recipe::Curve(Arc::new(curve)))
    }

    #[staticmethod]
    fn piecewise(py: Python<'_>, parts: Vec<Py<Self>>, tolerance: Option<f64>) -> PyResult<Self> {
        Self::new(py, Recipe::Piecewise(parts, tolerance))
    }

    /// Takes further steps.
    fn placed(&self, py: Python<'_>, steps: Vec<Step>) -> PyResult<Self> {
        Self::of(py, self.recipe.clone(), [self.steps.clone(), steps].concat())
    }

    #[getter]
    fn domain(&self) -> [f64; 2] {
        self.built.domain()
    }

    #[getter]
    fn pieces(&self) -> usize {
        self.built.pieces().max(1)
    }

    #[getter]
    fn convexity(&self) -> &'static str {
        let own = self.built.convexity();
        BULGES.iter().find(|(_, known)| *known == own).map_or("unknown", |&(name, _)| name)
    }

    /// Returns X, Y, X' and Y'.
    fn at(&self, py: Python<'_>, k: Numbers<'_>) -> PyResult<[Array; 4]> {
        let k = k.as_array().to_vec();
        let points = call::library(py, || {
            let zero = CurvePoint { x: 0.0, y: 0.0, dx: 0.0, dy: 0.0 };
            let mut points = vec![zero; k.len()];
            self.built.at_many(&k, &mut points);
            Ok::<_, ContactError<f64>>(points)
        })?;
        let part =
            |of: fn(&CurvePoint<f64>) -> f64| call::array(py, points.iter().map(of).collect());
        Ok([part(|p| p.x), part(|p| p.y), part(|p| p.dx), part(|p| p.dy)])
    }

    fn check_derivatives(&self, py: Python<'_>) -> PyResult<()> {
        call::library(py, || check_derivatives(&self.built))
    }
}
