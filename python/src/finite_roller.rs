//! Rollers of finite length.

use crate::call::{self, Array};
use crate::profile::Profile;
use crate::scene::SpringTable;
use linecontact::{ContactError, RollerSlice, RollerState};
use pyo3::prelude::*;

/// Roller of finite length on a raceway, as slices.
#[pyclass(frozen, module = "linecontact._native")]
pub struct FiniteRoller(linecontact::FiniteRoller<f64>);

/// Approach, misalignment, load, moment, stiffness and error; place, approach, load per unit
/// length, half-width and peak of all slices. A peak of `None` is infinite.
type Row = ([f64; 4], [[f64; 2]; 2], f64, [Array; 5]);

fn row(
    py: Python<'_>,
    find: impl FnOnce() -> Result<RollerState<f64>, ContactError<f64>> + Send,
) -> PyResult<Row> {
    let state = call::library(py, find)?;
    let column =
        |of: fn(&RollerSlice<f64>) -> f64| call::array(py, state.slices.iter().map(of).collect());
    let slices = [
        column(|slice| slice.z),
        column(|slice| slice.point.approach),
        column(|slice| slice.point.load),
        column(|slice| slice.point.half_contact),
        column(|slice| slice.point.peak.unwrap_or(f64::INFINITY)),
    ];
    let numbers = [state.approach, state.misalignment, state.load, state.moment];
    Ok((numbers, state.stiffness, state.error, slices))
}

#[pymethods]
impl FiniteRoller {
    #[new]
    fn new(
        py: Python<'_>,
        table: &SpringTable,
        length: f64,
        slices: usize,
        relief: &Profile,
    ) -> PyResult<Self> {
        let (table, relief) = (table.0.clone(), relief.built.clone());
        call::library(py, || linecontact::FiniteRoller::new(table, length, slices, &relief))
            .map(Self)
    }

    fn at(&self, py: Python<'_>, approach: f64, misalignment: f64) -> PyResult<Row> {
        row(py, || self.0.at(approach, misalignment))
    }

    fn under_load(&self, py: Python<'_>, load: f64, misalignment: f64) -> PyResult<Row> {
        row(py, || self.0.under_load(load, misalignment))
    }

    fn under_moment(&self, py: Python<'_>, load: f64, moment: f64) -> PyResult<Row> {
        row(py, || self.0.under_moment(load, moment))
    }
}
