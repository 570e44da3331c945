//! Derivatives of numbers of a solution by the numbers of its scene.

use crate::call;
use crate::control::{Prescribed, ReferenceRow, control_of, references_of};
use crate::profile::{AsTheyAre, Lift, Rate, Varied};
use crate::quantity::{Asked, Quantity};
use crate::scene::Scene;
use crate::solution::body;
use linecontact::{Body, ContactError, Control, Real, References, Solution, Solver};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// Values, and their derivatives by each parameter.
type Found = (Vec<f64>, Vec<Vec<f64>>);

/// Returns the derivatives of the `wanted` numbers of a solution, by parameters with which numbers
/// of the scene change at given rates.
#[pyfunction]
pub fn gradient(
    py: Python<'_>,
    scene: Bound<'_, Scene>,
    prescribed: Prescribed,
    to: Option<ReferenceRow>,
    of: Option<&str>,
    wanted: Vec<String>,
    by: Vec<Vec<Rate>>,
) -> PyResult<Found> {
    let (scene, below) = (scene.get(), of.map(body).transpose()?);
    let wanted: Vec<Quantity> =
        wanted.iter().map(|name| Quantity::differentiable(name)).collect::<PyResult<_>>()?;
    // First without derivatives: errors of the scene then name plain numbers.
    let (control, between) = given(&prescribed, to.as_ref(), &mut AsTheyAre)?;
    let values = call::library(py, || {
        numbers(&scene.contact.solve(control)?, between.as_ref(), below, &wanted)
    })?;
    // The values are the same for all parameters, so that the contact is found at once.
    let mut solver = Solver::new();
    let mut derivatives = Vec::with_capacity(by.len());
    for rates in &by {
        py.check_signals()?;
        let mut lift = Varied::by(rates);
        let contact = scene.lifted(py, &mut lift)?;
        let (control, between) = given(&prescribed, to.as_ref(), &mut lift)?;
        known(rates, &lift)?;
        let found = call::library(py, || {
            numbers(&solver.solve(&contact, control)?, between.as_ref(), below, &wanted)
        })?;
        derivatives.push(found.iter().map(|number| number.eps).collect());
    }
    Ok((values, derivatives))
}

/// Returns all numbers that have derivatives, by name.
#[pyfunction]
#[pyo3(signature = (scene, prescribed, to))]
pub fn parameters(
    py: Python<'_>,
    scene: Bound<'_, Scene>,
    prescribed: Option<Prescribed>,
    to: Option<ReferenceRow>,
) -> PyResult<Vec<(String, f64)>> {
    let mut lift = Varied::by(&[]);
    scene.get().lifted(py, &mut lift)?;
    if let Some(prescribed) = prescribed {
        given(&prescribed, to.as_ref(), &mut lift)?;
    }
    Ok(lift.named)
}

type Given<T> = (Control<T>, Option<References<T>>);

/// Returns the prescribed quantity, and the references between which an approach is measured.
fn given<L: Lift>(
    prescribed: &Prescribed,
    to: Option<&ReferenceRow>,
    lift: &mut L,
) -> PyResult<Given<L::Of>> {
    let control = control_of(prescribed, lift)?;
    let between = match (control, to) {
        (Control::Approach { references, .. }, _) => Some(references),
        (_, Some(to)) => Some(references_of(to, lift)?),
        _ => None,
    };
    Ok((control, between))
}

fn known(rates: &[Rate], lift: &Varied<'_>) -> PyResult<()> {
    for (name, _) in rates {
        if !lift.named.iter().any(|(known, _)| known == name) {
            let all: Vec<&str> = lift.named.iter().map(|(known, _)| known.as_str()).collect();
            let says = format!("no parameter {name:?}: there are {}", all.join(", "));
            return Err(PyValueError::new_err(says));
        }
    }
    Ok(())
}

fn numbers<T: Real>(
    solution: &Solution<'_, T>,
    between: Option<&References<T>>,
    below: Option<Body>,
    wanted: &[Quantity],
) -> Result<Vec<T>, ContactError<T>> {
    let asked = Asked::of(solution, between, below);
    wanted.iter().map(|&quantity| asked.value(quantity)).collect()
}
