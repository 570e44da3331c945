//! A curve that Python evaluates, many points in a call.

use crate::{call, errors};
use linecontact::{Convexity, CurvePoint, ParametricProfile};
use numpy::{PyArray1, PyArrayMethods, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::IntoPyDict;

/// `k -> (x, y, dx, dy)`, with the points at both ends, which are asked for again and again.
pub struct Curve {
    domain: [f64; 2],
    function: Py<PyAny>,
    convexity: Convexity,
    ends: [CurvePoint<f64>; 2],
}

const NOWHERE: CurvePoint<f64> =
    CurvePoint { x: f64::NAN, y: f64::NAN, dx: f64::NAN, dy: f64::NAN };

impl Curve {
    /// Calls the function once, with both ends.
    pub fn new(
        py: Python<'_>,
        domain: [f64; 2],
        function: Py<PyAny>,
        convexity: Convexity,
    ) -> PyResult<Self> {
        let mut ends = [NOWHERE; 2];
        evaluate(py, &function, &domain, &mut ends)?;
        Ok(Self { domain, function, convexity, ends })
    }
}

impl ParametricProfile<f64> for Curve {
    fn domain(&self) -> [f64; 2] {
        self.domain
    }

    fn convexity(&self) -> Convexity {
        self.convexity
    }

    fn at(&self, k: f64) -> CurvePoint<f64> {
        if let Some(end) = self.domain.iter().position(|&end| end == k) {
            return self.ends[end];
        }
        let mut point = [NOWHERE];
        self.at_many(&[k], &mut point);
        point[0]
    }

    fn at_many(&self, k: &[f64], points: &mut [CurvePoint<f64>]) {
        if k.is_empty() || call::has_raised() {
            points.fill(NOWHERE);
            return;
        }
        let done = Python::attach(|py| evaluate(py, &self.function, k, points));
        if let Err(error) = done {
            call::raise(error);
            points.fill(NOWHERE);
        }
    }
}

fn evaluate(
    py: Python<'_>,
    function: &Py<PyAny>,
    k: &[f64],
    points: &mut [CurvePoint<f64>],
) -> PyResult<()> {
    let found = function.bind(py).call1((PyArray1::from_slice(py, k),))?;
    let count = found.len().unwrap_or(1);
    if count != 4 {
        return Err(errors::missing_derivatives(py, count));
    }
    for i in 0..4 {
        let part = found.get_item(i)?;
        let row = match part.extract::<PyReadonlyArray1<'_, f64>>() {
            Ok(row) if row.as_array().len() == k.len() => row,
            _ => spread(&part, k.len())?,
        };
        let row = row.as_array();
        for (point, &value) in points.iter_mut().zip(row) {
            let CurvePoint { x, y, dx, dy } = point;
            *[x, y, dx, dy][i] = value;
        }
    }
    Ok(())
}

/// A number for all points, or an array of other numbers, as one of `float`.
fn spread<'py>(part: &Bound<'py, PyAny>, count: usize) -> PyResult<PyReadonlyArray1<'py, f64>> {
    let py = part.py();
    let numpy = py.import("numpy")?;
    let float = [("dtype", "float64")].into_py_dict(py)?;
    let row = numpy.call_method("asarray", (part,), Some(&float))?;
    let row = numpy.call_method1("broadcast_to", (row, (count,)))?;
    let row = numpy.call_method1("ascontiguousarray", (row,))?;
    Ok(row.cast_into::<PyArray1<f64>>()?.readonly())
}
