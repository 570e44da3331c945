//! Many solves in one call, over all cores.

use crate::call::{self, Array, Numbers, Stop};
use crate::control::{ReferenceRow, control, references};
use crate::errors;
use crate::quantity::{Asked, NAMES, Quantity};
use crate::scene::Scene;
use linecontact::{ContactError, Control, References, Solver};
use numpy::PyArrayLike1;
use pyo3::exceptions::{PyException, PyValueError};
use pyo3::prelude::*;
use rayon::ThreadPoolBuilder;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;

/// Why a row has no numbers, or not all.
enum Failure {
    /// The solver refuses it.
    Refused(ContactError<f64>),
    /// A function of the user's has raised it.
    Raised(PyErr),
}

/// The scene of a row, and what is prescribed.
struct Row<'s> {
    scene: &'s Scene,
    control: Control<f64>,
}

/// Numbers in the order in which they were asked for, and what has failed: rows without errors have all of them.
type Found = (Vec<f64>, Option<Failure>);

fn row(
    stop: &Stop,
    solver: &mut Solver<f64>,
    &Row { scene, control }: &Row<'_>,
    wanted: &[Quantity],
    between: Option<&References<f64>>,
) -> Found {
    let mut numbers = vec![f64::NAN; wanted.len()];
    let mut failed = None;
    match solver.solve(&scene.contact, control) {
        Err(error) => failed = Some(error),
        Ok(solution) => {
            let asked = Asked::of(&solution, between);
            for (number, &quantity) in numbers.iter_mut().zip(wanted) {
                match asked.value(quantity) {
                    Ok(value) => *number = value,
                    // Beside a corner that is no failure, but how it is.
                    Err(ContactError::Singular { .. }) if quantity == Quantity::PeakPressure => {
                        *number = f64::INFINITY;
                    }
                    Err(error) => {
                        failed.get_or_insert(error);
                    }
                }
            }
        }
    }
    let failed = match call::raised() {
        Some(raised) => {
            // What is no mistake of a function, but means to end all: KeyboardInterrupt, SystemExit.
            if !Python::attach(|py| raised.is_instance_of::<PyException>(py)) {
                stop.set();
            }
            Some(Failure::Raised(raised))
        }
        None => failed.map(Failure::Refused),
    };
    (numbers, failed)
}

/// Names of all columns that there are.
#[pyfunction]
pub fn quantities() -> Vec<&'static str> {
    NAMES.iter().map(|&(name, _)| name).collect()
}

/// One column for each quantity, and the rows that have failed, with their exceptions.
type Columns = (Vec<Array>, Vec<(usize, Py<PyAny>)>);

/// Solves row after row: of the scenes that `which` names, under what is prescribed, one array for each of its numbers.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "each is named in Python")]
pub fn sweep(
    py: Python<'_>,
    scenes: Vec<Bound<'_, Scene>>,
    which: PyArrayLike1<'_, usize>,
    kind: &str,
    numbers: Vec<Numbers<'_>>,
    to: Option<ReferenceRow>,
    wanted: Vec<String>,
    threads: usize,
    progress: Option<Py<PyAny>>,
) -> PyResult<Columns> {
    let wanted: Vec<Quantity> =
        wanted.iter().map(|name| Quantity::named(name)).collect::<PyResult<_>>()?;
    let prescribed_references = if kind == "approach" { to.clone() } else { None };
    let between = to.map(references).transpose()?;
    let mut rows = Vec::with_capacity(which.as_array().len());
    for (i, &scene) in which.as_array().iter().enumerate() {
        let numbers = numbers.iter().map(|of_all| of_all.as_array()[i]).collect();
        let control = control((kind.to_owned(), numbers, prescribed_references.clone()))?;
        rows.push(Row { scene: scenes[scene].get(), control });
    }
    let mut found = in_parallel(py, &rows, threads, progress, |stop, solver, scene| {
        row(stop, solver, scene, &wanted, between.as_ref())
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

/// Lets go of the interpreter, solves in threads of its own, and comes back now and then to look at signals and to
/// tell how far it is.
///
/// The threads end with the call: a process that is forked later finds none of them, and waits for none.
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
                // Dropped at the end, whatever happens.
                let _ended: mpsc::Sender<()> = ended;
                let one = |solver: &mut Solver<f64>, row: &Row<'_>| {
                    // What is left when it is stopped is not looked at.
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
