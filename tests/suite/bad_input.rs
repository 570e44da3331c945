//! Invalid input, function by function: each row has the expected error, with its place and values,
//! and the number of evaluations of the curves that it may take.
#![allow(missing_docs)]
#![allow(clippy::type_complexity)] // Rows of a table hold functions.

use crate::common;

mod answers;
mod closed_forms;
mod liars;
mod panics;
mod profiles;
mod scene;
mod searches;

use common::{Profile, by_cubic, power};
use linecontact::profile::{Placed, Placement};
use linecontact::quadrature::{Integrator, LoadCase, Moments, Quadrature};
use linecontact::search::{Bracket, Brent, Root, SearchError, StoppingCriteria, strategies};
use linecontact::stress::Stress;
use linecontact::{
    Body, Contact, ContactError, Control, Cost, Curve, CurvePoint, Edge, EdgePressure, Estimate,
    EvaluationError, Exponents, Flat, Gap, InputError, Interval, Midpoint, Panels,
    ParametricProfile, Piece, Piecewise, PiecewiseError, ProfileError, Solution, SolveError,
    check_derivatives,
};
use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind};

const NAN: f64 = f64::NAN;

const INF: f64 = f64::INFINITY;

const TINY: f64 = 5e-324;

thread_local! {
    static EVALUATIONS: Cell<usize> = const { Cell::new(0) };
}

/// Returns a curve whose evaluations are counted.
fn curve(domain: [f64; 2], at: impl Fn(f64) -> CurvePoint<f64> + Send + Sync + 'static) -> Profile {
    Box::new(Curve::new(domain, move |k| {
        EVALUATIONS.set(EVALUATIONS.get() + 1);
        at(k)
    }))
}

fn body() -> Profile {
    curve([-1.0, 1.0], by_cubic)
}

/// Any error of the crate.
#[derive(Debug)]
enum Wrong {
    Input(InputError<f64>),
    Solve(SolveError<f64>),
    Evaluation(EvaluationError<f64>),
    Search(SearchError<f64>),
    Profile(ProfileError<f64>),
    Breakpoint(PiecewiseError<f64>),
}

macro_rules! from {
    ($($variant:ident($error:ident)),*) => {$(
        impl From<$error<f64>> for Wrong {
            fn from(error: $error<f64>) -> Self {
                Self::$variant(error)
            }
        }
    )*};
}

from!(Search(SearchError), Profile(ProfileError), Breakpoint(PiecewiseError));

impl From<ContactError<f64>> for Wrong {
    fn from(error: ContactError<f64>) -> Self {
        match error {
            ContactError::Input(error) => Self::Input(error),
            ContactError::Solve(error) => Self::Solve(error),
            ContactError::Evaluation(error) => Self::Evaluation(error),
        }
    }
}

type Outcome = Result<String, Wrong>;

struct Table {
    function: &'static str,
    wrong: Vec<String>,
    rows: usize,
}

impl Table {
    fn new(function: &'static str) -> Self {
        Self { function, wrong: Vec::new(), rows: 0 }
    }

    fn row<R: std::fmt::Debug>(
        &mut self,
        name: &str,
        most: usize,
        call: impl FnOnce() -> Result<R, Wrong>,
        expected: impl Fn(&Wrong) -> bool,
    ) {
        self.outcome(name, most, call, |outcome| outcome.as_ref().is_err_and(&expected));
    }

    fn solve(
        &mut self,
        name: &str,
        most: usize,
        contact: &Contact<f64>,
        control: Control<f64>,
        expected: impl Fn(&Wrong) -> bool,
    ) {
        self.row(name, most, || Ok(contact.solve(control).map(|_| ())?), expected);
    }

    fn outcome<R: std::fmt::Debug>(
        &mut self,
        name: &str,
        most: usize,
        call: impl FnOnce() -> Result<R, Wrong>,
        expected: impl Fn(&Outcome) -> bool,
    ) {
        EVALUATIONS.set(0);
        self.rows += 1;
        let row = format!("{}, {name}", self.function);
        let outcome = catch_unwind(AssertUnwindSafe(|| call().map(|good| format!("{good:?}"))));
        let took = EVALUATIONS.get();
        match outcome {
            Err(_) => self.wrong.push(format!("{row}: panics")),
            Ok(outcome) if !expected(&outcome) => self.wrong.push(format!("{row}: {outcome:?}")),
            Ok(_) if took > most => self.wrong.push(format!("{row}: {took} evaluations")),
            // A message takes one to three lines.
            Ok(Err(wrong)) if message(&wrong).len() > 500 => {
                self.wrong.push(format!("{row}: {}", message(&wrong)));
            }
            Ok(_) => {}
        }
    }

    fn finish(self) {
        assert!(self.rows > 0 && self.wrong.is_empty(), "\n{}", self.wrong.join("\n"));
    }
}

fn message(wrong: &Wrong) -> String {
    match wrong {
        Wrong::Input(error) => error.to_string(),
        Wrong::Solve(error) => error.to_string(),
        Wrong::Evaluation(error) => error.to_string(),
        Wrong::Search(error) => error.to_string(),
        Wrong::Profile(error) => error.to_string(),
        Wrong::Breakpoint(error) => error.to_string(),
    }
}

/// Tells whether two numbers are equal, or both NaN.
fn same(one: f64, other: f64) -> bool {
    one == other || one.is_nan() && other.is_nan()
}

macro_rules! contact_error {
    (ContactError::$kind:ident($pattern:pat) $(if $guard:expr)?) => {
        |wrong: &Wrong| matches!(wrong, Wrong::$kind($pattern) $(if $guard)?)
    };
}
use contact_error;

fn solve(upper: &dyn ParametricProfile<f64>, load: Control<f64>) -> Result<(), Wrong> {
    Contact::new(&Flat, upper)?.solve(load)?;
    Ok(())
}
