//! Two bodies that move.

use crate::call;
use crate::control::{ReferenceRow, references};
use crate::profile::{AsTheyAre, Profile};
use crate::scene::{Surface, foundation, plane};
use linecontact::{ContactError, Pose};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::sync::Mutex;

/// Two bodies in frames of their own.
#[pyclass(frozen, module = "linecontact._native")]
pub struct Pair(Mutex<linecontact::Pair<'static, f64>>);

/// Penetration, force, place, torques, number of contacts, and a flag: steep.
type Row = (f64, [f64; 2], [f64; 2], [f64; 2], usize, bool);

fn pose([x, y, angle]: [f64; 3]) -> Pose<f64> {
    Pose { x, y, angle }
}

impl Pair {
    /// Runs work with the pair, for one thread at a time and not from within a curve that is being
    /// solved.
    fn with<R: Send>(
        &self,
        py: Python<'_>,
        work: impl FnOnce(&mut linecontact::Pair<'static, f64>) -> Result<R, ContactError<f64>> + Send,
    ) -> PyResult<R> {
        let Ok(mut pair) = self.0.try_lock() else {
            let says = "this Pair is solving: one serves one thread at a time, make another";
            return Err(PyRuntimeError::new_err(says));
        };
        let pair = &mut *pair;
        call::library(py, || work(pair))
    }
}

#[pymethods]
impl Pair {
    #[new]
    fn new(
        lower: &Profile,
        upper: &Profile,
        materials: (Surface, Surface, String),
        to: ReferenceRow,
    ) -> PyResult<Self> {
        let (one, other, state) = &materials;
        let surfaces = (foundation(one, &mut AsTheyAre)?, foundation(other, &mut AsTheyAre)?);
        let (lower, upper, to) = (lower.built.clone(), upper.built.clone(), references(to)?);
        let pair = linecontact::Pair::owned(lower, upper, surfaces, to);
        Ok(Self(Mutex::new(pair.plane_state(plane(state)?))))
    }

    fn at(&self, py: Python<'_>, lower: [f64; 3], upper: [f64; 3]) -> PyResult<Row> {
        let found = self.with(py, |pair| pair.at(pose(lower), pose(upper)))?;
        let linecontact::Wrench { penetration, force, at, torque, contacts, is_steep } = found;
        Ok((penetration, force, at, torque, contacts, is_steep))
    }

    fn stiffness(
        &self,
        py: Python<'_>,
        lower: [f64; 3],
        upper: [f64; 3],
    ) -> PyResult<[[f64; 3]; 3]> {
        self.with(py, |pair| pair.stiffness(pose(lower), pose(upper)))
    }
}
