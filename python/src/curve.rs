//! A curve that Python evaluates, many points in a call.

use crate::{call, errors};
use linecontact::{Convexity, CurvePoint, ParametricProfile};
use numpy::{PyArray1, PyArrayMethods, PyReadonlyArray1};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::IntoPyDict;

/// Function `k -> (x, y, dx, dy)`, with the points at both ends, which are needed again and again.
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
        let mut point = [NOWHERE];
        self.at_many(&[k], &mut point);
        point[0]
    }

    fn at_many(&self, k: &[f64], points: &mut [CurvePoint<f64>]) {
        let end = |&k: &f64| self.domain.iter().position(|&end| end == k);
        let ends = k.iter().map(|k| end(k).map(|end| self.ends[end]));
        if ends.clone().all(|end| end.is_some()) {
            points.iter_mut().zip(ends.flatten()).for_each(|(point, end)| *point = end);
            return;
        }
        if call::has_raised() {
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
    let function = function.bind(py);
    let found = function
        .call1((PyArray1::from_slice(py, k),))
        .map_err(|error| said_to_take_arrays(py, function, k, error))?;
    let alone =
        found.getattr("ndim").and_then(|axes| axes.extract()).is_ok_and(|axes: usize| axes < 2);
    let count = match found.len() {
        Ok(count) if !(alone && count != 4) => count,
        _ => usize::from(!found.is_none()),
    };
    if count != 4 {
        return Err(errors::missing_derivatives(py, count));
    }
    for i in 0..4 {
        let part = found.get_item(i)?;
        let row = match part.extract::<PyReadonlyArray1<'_, f64>>() {
            Ok(row) if row.as_array().len() == k.len() => row,
            _ => spread(&part, k.len()).map_err(|error| match is_complex(&part) {
                true => error,
                false => of_no_length(py, i, &part, k.len()),
            })?,
        };
        let row = row.as_array();
        for (point, &value) in points.iter_mut().zip(row) {
            let CurvePoint { x, y, dx, dy } = point;
            *[x, y, dx, dy][i] = value;
        }
    }
    Ok(())
}

/// Makes the exception of a function called with an array: if it accepts a single number, this is
/// the fault.
fn said_to_take_arrays(
    py: Python<'_>,
    function: &Bound<'_, PyAny>,
    k: &[f64],
    error: PyErr,
) -> PyErr {
    let of_type =
        error.is_instance_of::<PyTypeError>(py) || error.is_instance_of::<PyValueError>(py);
    if !of_type || function.call1((k[0],)).is_err() {
        return error;
    }
    let says = format!(
        "the function of a Curve takes one number, but it is called with an array of k, here of {}: use the functions \
         of numpy, such as np.cosh for math.cosh, and np.where for if ({})",
        k.len(),
        error.value(py)
    );
    let better = PyTypeError::new_err(says);
    better.set_cause(py, Some(error));
    better
}

/// Makes the exception for a part of the result of a function.
fn of_no_length(py: Python<'_>, part: usize, found: &Bound<'_, PyAny>, count: usize) -> PyErr {
    let name = ["x", "y", "dx", "dy"][part];
    let shape = py.import("numpy").and_then(|numpy| numpy.call_method1("shape", (found,)));
    let found = match shape.and_then(|shape| shape.str()) {
        Ok(shape) => format!("of shape {shape}"),
        Err(_) => "that is no array".to_owned(),
    };
    PyValueError::new_err(format!(
        "the function of a Curve has returned {name} {found} for {count} values of k: each of x, y, dx and dy must be \
         as many numbers, or a plain number for all"
    ))
}

fn is_complex(part: &Bound<'_, PyAny>) -> bool {
    let numpy = part.py().import("numpy");
    let found = numpy.and_then(|numpy| numpy.call_method1("iscomplexobj", (part,)));
    found.is_ok_and(|found| found.is_truthy().unwrap_or(false))
}

/// Returns a number for all points, or an array of other numbers, as one of `float`.
fn spread<'py>(part: &Bound<'py, PyAny>, count: usize) -> PyResult<PyReadonlyArray1<'py, f64>> {
    let py = part.py();
    let numpy = py.import("numpy")?;
    if is_complex(part) {
        let says = "the function of a Curve has returned complex numbers: give real ones";
        return Err(PyTypeError::new_err(says));
    }
    let float = [("dtype", "float64")].into_py_dict(py)?;
    let row = numpy.call_method("asarray", (part,), Some(&float))?;
    // An array of one number is one whose others are missing.
    if row.len().is_ok_and(|length| length != count) {
        return Err(PyTypeError::new_err("an array of another length"));
    }
    let row = numpy.call_method1("broadcast_to", (row, (count,)))?;
    let row = numpy.call_method1("ascontiguousarray", (row,))?;
    Ok(row.cast_into::<PyArray1<f64>>()?.readonly())
}
