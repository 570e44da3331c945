//! Calls from Python to the library and back: the interpreter is released meanwhile, signals are
//! checked, and an exception of a user's own function comes out unchanged.

use crate::errors;
use linecontact::{ContactError, Cost, Interval};
use numpy::{AllowTypeChange, PyArray1, PyArrayLike1};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use std::cell::{Cell, RefCell};
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};

/// Time between two checks for signals in a solve: unnoticed at a keyboard, and long enough to wait
/// rarely for the interpreter.
pub const BETWEEN_SIGNALS: Duration = Duration::from_millis(50);

thread_local! {
    /// Exception of a user's function, or of a signal, in the current call of this thread.
    static RAISED: RefCell<Option<PyErr>> = const { RefCell::new(None) };
    static LOOKED: Cell<Option<Instant>> = const { Cell::new(None) };
    /// Signal to end, set in our own threads, which signals of the system do not reach.
    static STOP: RefCell<Option<Stop>> = const { RefCell::new(None) };
}

/// Signal that ends our own threads.
#[derive(Clone, Default)]
pub struct Stop(Arc<AtomicBool>);

impl Stop {
    pub fn set(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    pub fn is_set(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Keeps an exception until the library has returned.
pub fn raise(error: PyErr) {
    RAISED.with_borrow_mut(|raised| {
        raised.get_or_insert(error);
    });
}

/// Returns the exception that was kept, and forgets it.
pub fn raised() -> Option<PyErr> {
    RAISED.take()
}

/// Tells whether an exception is kept: then results are ignored.
pub fn has_raised() -> bool {
    RAISED.with_borrow(Option::is_some)
}

/// Checks for signals, if it is time. Ends the current work if there is an exception.
pub fn look() -> ControlFlow<()> {
    if let Some(stopped) = STOP.with_borrow(|stop| stop.as_ref().map(Stop::is_set)) {
        let ended = stopped || has_raised();
        return if ended { ControlFlow::Break(()) } else { ControlFlow::Continue(()) };
    }
    let now = Instant::now();
    let due = LOOKED.get().is_none_or(|last| now.duration_since(last) >= BETWEEN_SIGNALS);
    if due && !has_raised() {
        // The first check only starts the clock: most calls end long before it is due.
        if LOOKED.replace(Some(now)).is_some()
            && let Err(error) = Python::attach(|py| py.check_signals())
        {
            raise(error);
        }
    }
    if has_raised() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
}

/// Watches a solve, see [`Contact::watch`](linecontact::Contact::watch).
pub fn watch<T>(_: Cost, _: Interval<T>) -> ControlFlow<()> {
    look()
}

/// Calls the library without holding the interpreter.
pub fn library<R: Send, E: errors::Describe + Send>(
    py: Python<'_>,
    work: impl FnOnce() -> Result<R, E> + Send,
) -> PyResult<R> {
    let found = py.detach(|| {
        LOOKED.set(None);
        work()
    });
    match raised() {
        Some(raised) => Err(raised),
        None => found.map_err(|error| errors::to_python(py, &error)),
    }
}

/// Does work in a thread of our own, until it is done or told to stop.
pub fn elsewhere<R>(stop: &Stop, work: impl FnOnce() -> R) -> R {
    let before = STOP.replace(Some(stop.clone()));
    let found = work();
    STOP.set(before);
    found
}

/// Runs work with an object that serves one thread at a time, and not from within a curve that is
/// being solved. Other calls fail instead of waiting, as they might wait for ever.
pub fn alone<S: Send, R: Send>(
    py: Python<'_>,
    object: &Mutex<S>,
    name: &str,
    work: impl FnOnce(&mut S) -> Result<R, ContactError<f64>> + Send,
) -> PyResult<R> {
    let Ok(mut object) = object.try_lock() else {
        let says = format!("this {name} is solving: one serves one thread at a time, make another");
        return Err(PyRuntimeError::new_err(says));
    };
    let object = &mut *object;
    library(py, || work(object))
}

/// Computes a value for each number of an array.
pub fn each(
    x: &[f64],
    mut value: impl FnMut(f64) -> Result<f64, ContactError<f64>>,
) -> Result<Vec<f64>, ContactError<f64>> {
    let mut values = Vec::with_capacity(x.len());
    for &x in x {
        if look().is_break() {
            break;
        }
        values.push(value(x)?);
    }
    Ok(values)
}

/// Array of any numbers as one of `float`.
pub type Numbers<'py> = PyArrayLike1<'py, f64, AllowTypeChange>;

/// Our own numbers as an array.
pub type Array = Py<PyArray1<f64>>;

pub fn array(py: Python<'_>, values: Vec<f64>) -> Array {
    PyArray1::from_vec(py, values).unbind()
}
