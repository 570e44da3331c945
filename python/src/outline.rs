//! Outlines from a drawing.

use crate::call;
use linecontact::ContactError;
use linecontact::profile::{Outline, Segment};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// Name of a method of `Outline`, and its numbers.
type Step = (String, Vec<f64>);

/// Radius or slope, ends and place of a piece; the radius is `None` for a line.
type Piece = (Option<f64>, f64, [f64; 2], [f64; 2]);

fn drawn(start: [f64; 2], steps: &[Step]) -> PyResult<Outline<f64>> {
    steps.iter().try_fold(Outline::from(start), |outline, (name, numbers)| {
        Ok(match (name.as_str(), numbers.as_slice()) {
            ("line", &[length]) => outline.line(length),
            ("arc", &[radius, length]) => outline.arc(radius, length),
            ("wall", &[height]) => outline.wall(height),
            ("corner", &[slope]) => outline.corner(slope),
            ("fillet", &[radius]) => outline.fillet(radius),
            ("chamfer", &[before, behind]) => outline.chamfer(before, behind),
            _ => return Err(PyValueError::new_err(format!("no step {name}{numbers:?}"))),
        })
    })
}

/// Returns the pieces of an outline, from left to right, with the left half if there is one, and
/// the tolerance of their joints.
#[pyfunction]
pub fn outline(
    py: Python<'_>,
    start: [f64; 2],
    steps: Vec<Step>,
    left: Option<([f64; 2], Vec<Step>)>,
) -> PyResult<(Vec<Piece>, f64)> {
    let mut whole = drawn(start, &steps)?;
    if let Some((start, steps)) = left {
        whole = whole.left(drawn(start, &steps)?);
    }
    let segments = call::library(py, || whole.segments().map_err(ContactError::from))?;
    let tolerance = Outline::tolerance(&segments);
    let piece = |one: Segment<f64>| (one.radius, one.slope, one.ends, one.at);
    Ok((segments.into_iter().map(piece).collect(), tolerance))
}
