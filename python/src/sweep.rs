//! Many solves in one call, over all cores.

use crate::call::{self, Array, Numbers, Stop};
use crate::control::{ReferenceRow, control, references};
use crate::errors;
use crate::quantity::{Asked, NAMES, Quantity};
use crate::scene::Scene;
use crate::solution::body;
use linecontact::{Body, ContactError, Control, EvaluationError, References, Solver};
use numpy::PyArrayLike1;
use pyo3::exceptions::{PyException, PyValueError};
use pyo3::prelude::*;
use rayon::ThreadPoolBuilder;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;

/// Reason why a row lacks some or all numbers.
enum Failure {
    /// Error of the solver.
    Refused(ContactError<f64>),
    /// Exception raised by a user's function.
    Raised(PyErr),
}

/// Scene of a row, and its prescribed quantity.
struct Row<'s> {
    scene: &'s Scene,
    control: Control<f64>,
}

/// Numbers in the order of the request, and the failure: rows without errors have all numbers.
type Found = (Vec<f64>, Option<Failure>);

fn row(
    stop: &Stop,
    solver: &mut Solver<f64>,
    &Row { scene, control }: &Row<'_>,
    wanted: &[Quantity],
    (between, below): (Option<&References<f64>>, Option<Body>),
) -> Found {
    let mut numbers = vec![f64::NAN; wanted.len()];
    let mut failed = None;
    match solver.solve(&scene.contact, control) {
        Err(error) => failed = Some(error),
        Ok(solution) => {
            let asked = Asked::of(&solution, between, below);
            for (number, &quantity) in numbers.iter_mut().zip(wanted) {
                match asked.value(quantity) {
                    Ok(value) => *number = value,
                    // What is infinite at a corner is a result, not a failure.
                    Err(error) => match (quantity.infinite(), &error) {
                        (Some(at), ContactError::Evaluation(EvaluationError::Singular { x })) => {
                            *number = at(*x);
                        }
                        _ => {
                            failed.get_or_insert(error);
                        }
                    },
                }
            }
        }
    }
    let failed = match call::raised() {
        Some(raised) => {
            // KeyboardInterrupt and SystemExit are not errors of a function: they end everything.
            if !Python::attach(|py| raised.is_instance_of::<PyException>(py)) {
                stop.set();
            }
            Some(Failure::Raised(raised))
        }
        None => failed.map(Failure::Refused),
    };
    (numbers, failed)
}

/// Returns the names of all columns.
#[pyfunction]
pub fn quantities() -> Vec<&'static str> {
    NAMES.iter().map(|&(name, _)| name).collect()
}

/// One column for each quantity, and the failed rows with their exceptions.
type Columns = (Vec<Array>, Vec<(usize, Py<PyAny>)>);

/// Solves row after row: of the scenes that `which` names, under prescribed numbers, given as one
/// array for each number.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "each is named in Python")]
pub fn sweep(
    py: Python<'_>,
    scenes: Vec<Bound<'_, Scene>>,
    which: PyArrayLike1<'_, usize>,
    kind: &str,
    numbers: Vec<Numbers<'_>>,
    to: Option<ReferenceRow>,
    of: Option<&str>,
    wanted: Vec<String>,
    threads: usize,
    progress: Option<Py<PyAny>>,
) -> PyResult<Columns> {
    let wanted: Vec<Quantity> =
        wanted.iter().map(|name| Quantity::named(name)).collect::<PyResult<_>>()?;
    let prescribed_references = if kind == "approach" { to.clone() } else { None };
    let (between, below) = (to.map(references).transpose()?, of.map(body).transpose()?);
    let mut rows = Vec::with_capacity(which.as_array().len());
    for (i, &scene) in which.as_array().iter().enumerate() {
        let numbers = numbers.iter().map(|of_all| of_all.as_array()[i]).collect();
        let control = control((kind.to_owned(), numbers, prescribed_references.clone()))?;
        rows.push(Row { scene: scenes[scene].get(), control });
    }
    let mut found = in_parallel(py, &rows, threads, progress, |stop, solver, scene| {
        row(stop, solver, scene, &wanted, (between.as_ref(), below))
    })?;

    let ends = |(_, failed): &Found| match failed {
        Some(Failure::Raised(raised)) => !raised.is_instance_of::<PyException>(py),
        _ => false,
    };
    if let Some(i) = found.iter().position(ends)
        && let Some(Failure::Raised(raised)) = found.swap_remove(i).1
    {
        return Err(raised);
    }
    let column = |i: usize| call::array(py, found.iter().map(|(numbers, _)| numbers[i]).collect());
    let columns = (0..wanted.len()).map(column).collect();
    let mut failures = Vec::new();
    for (i, (_, failed)) in found.into_iter().enumerate() {
        let exception = match failed {
            None => continue,
            Some(Failure::Raised(raised)) => raised,
            Some(Failure::Refused(error)) => errors::to_python(py, &error),
        };
        failures.push((i, exception.into_value(py).into_any()));
    }
    Ok((columns, failures))
}

/// Releases the interpreter, solves in its own threads, and returns now and then to check for
/// signals and to report progress.
///
/// The threads end with the call: a process forked later has none of them, and waits for none.
fn in_parallel<R: Send>(
    py: Python<'_>,
    rows: &[Row<'_>],
    threads: usize,
    progress: Option<Py<PyAny>>,
    one: impl Fn(&Stop, &mut Solver<f64>, &Row<'_>) -> R + Sync,
) -> PyResult<Vec<R>> {
    let (stop, done) = (Stop::default(), AtomicUsize::new(0));
    let look = |py: Python<'_>| -> PyResult<()> {
        py.check_signals()?;
        if let Some(progress) = &progress {
            progress.call1(py, (done.load(Ordering::Relaxed),))?;
        }
        Ok(())
    };
    let found = py.detach(|| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().map_err(|failed| {
            let says = format!("{threads} threads could not be started: {failed}");
            PyValueError::new_err(says)
        })?;
        thread::scope(|scope| {
            let (ended, end) = mpsc::channel();
            let work = scope.spawn(|| {
                // Dropped at the end in any case.
                let _ended: mpsc::Sender<()> = ended;
                let one = |solver: &mut Solver<f64>, row: &Row<'_>| {
                    // After a stop the remaining rows are skipped.
                    if stop.is_set() {
                        Err(())
                    } else {
                        Ok(call::elsewhere(&stop, || one(&stop, solver, row)))
                    }
                };
                let count = |so_far| done.store(so_far, Ordering::Relaxed);
                pool.install(|| linecontact::sweep(rows, one, count))
            });
            let mut raised = Ok(());
            while end.recv_timeout(call::BETWEEN_SIGNALS) == Err(RecvTimeoutError::Timeout) {
                if raised.is_ok() {
                    raised = Python::attach(look);
                    if raised.is_err() {
                        stop.set();
                    }
                }
            }
            let found = work.join().expect("no row panics");
            raised.map(|()| found.into_iter().flatten().collect())
        })
    })?;
    look(py)?;
    Ok(found)
}
