//! The numbers of a scene by name: plain, or with a derivative.

use super::{Profile, Shared};
use crate::curve::Curve;
use crate::errors::Named;
use linecontact::Real;
use linecontact::autodiff::num_dual::Dual64;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::fmt::{Display, Write};
use std::sync::Arc;

/// Conversion of the numbers of a scene to the kind of numbers in which it is solved.
pub trait Lift: Sized {
    type Of: Real + Named;

    /// Returns the number with this name in Python.
    fn number(&mut self, name: impl Display, value: f64) -> Self::Of;

    /// Does work inside this name: it is put before the names of all numbers in the work.
    fn inside<R>(&mut self, name: impl Display, work: impl FnOnce(&mut Self) -> R) -> R;

    fn body(&mut self, py: Python<'_>, body: &Profile) -> PyResult<Shared<Self::Of>>;

    fn curve(&self, curve: &Arc<Curve>) -> PyResult<Shared<Self::Of>>;
}

/// Plain numbers. Bodies that are already built are not built again.
pub struct AsTheyAre;

impl Lift for AsTheyAre {
    type Of = f64;

    fn number(&mut self, _: impl Display, value: f64) -> f64 {
        value
    }

    fn inside<R>(&mut self, _: impl Display, work: impl FnOnce(&mut Self) -> R) -> R {
        work(self)
    }

    fn body(&mut self, _: Python<'_>, body: &Profile) -> PyResult<Shared<f64>> {
        Ok(body.built.clone())
    }

    fn curve(&self, curve: &Arc<Curve>) -> PyResult<Shared<f64>> {
        Ok(curve.clone())
    }
}

/// Name of a number, and its rate of change with a parameter.
pub type Rate = (String, f64);

/// Numbers with their derivative by one parameter.
#[derive(Default)]
pub struct Varied<'r> {
    rates: &'r [Rate],
    path: String,
    /// All numbers that have been asked for.
    pub named: Vec<(String, f64)>,
}

impl<'r> Varied<'r> {
    pub fn by(rates: &'r [Rate]) -> Self {
        Self { rates, ..Self::default() }
    }
}

impl Lift for Varied<'_> {
    type Of = Dual64;

    fn number(&mut self, name: impl Display, value: f64) -> Dual64 {
        let name = format!("{}{name}", self.path);
        let rates = self.rates.iter().filter(|(known, _)| *known == name);
        let rate = rates.map(|&(_, rate)| rate).sum();
        self.named.push((name, value));
        Dual64::new(value, rate)
    }

    fn inside<R>(&mut self, name: impl Display, work: impl FnOnce(&mut Self) -> R) -> R {
        let outside = self.path.len();
        // Writing to a string does not fail.
        let _ = write!(self.path, "{name}.");
        let found = work(self);
        self.path.truncate(outside);
        found
    }

    fn body(&mut self, py: Python<'_>, body: &Profile) -> PyResult<Shared<Dual64>> {
        body.recipe.build(py, &body.steps, self)
    }

    fn curve(&self, _: &Arc<Curve>) -> PyResult<Shared<Dual64>> {
        let body = self.path.trim_end_matches('.');
        Err(PyValueError::new_err(format!(
            "{body} is a Curve, of which second derivatives are not known: derivatives of a solution need \
             shapes of this package, or a Spline of points of the curve"
        )))
    }
}
