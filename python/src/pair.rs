//! Two bodies that move.

use crate::call;
use crate::control::{ReferenceRow, references};
use crate::profile::{AsTheyAre, Profile};
use crate::scene::{Surface, foundation, plane};
use linecontact::Pose;
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

#[pymethods]
impl Pair {
    #[new]
    fn new(
        lower: &Profile,
        upper: &Profile,
        materials: (Surface, Surface, String),
        to: ReferenceRow,
        resolution: Option<f64>,
    ) -> PyResult<Self> {
        let (one, other, state) = &materials;
        let surfaces = (foundation(one, &mut AsTheyAre)?, foundation(other, &mut AsTheyAre)?);
        let (lower, upper, to) = (lower.built.clone(), upper.built.clone(), references(to)?);
        let mut pair =
            linecontact::Pair::owned(lower, upper, surfaces, to).plane_state(plane(state)?);
        if let Some(length) = resolution {
            pair = pair.resolution(length);
        }
        Ok(Self(Mutex::new(pair)))
    }

    fn at(&self, py: Python<'_>, lower: [f64; 3], upper: [f64; 3]) -> PyResult<Row> {
        let found = call::alone(py, &self.0, "Pair", |pair| pair.at(pose(lower), pose(upper)))?;
        let linecontact::Wrench { penetration, force, at, torque, contacts, is_steep } = found;
        Ok((penetration, force, at, torque, contacts, is_steep))
    }

    fn stiffness(
        &self,
        py: Python<'_>,
        lower: [f64; 3],
        upper: [f64; 3],
    ) -> PyResult<[[f64; 3]; 3]> {
        call::alone(py, &self.0, "Pair", |pair| pair.stiffness(pose(lower), pose(upper)))
    }
}
