//! Brent's method and the secant method: the `roots` crate behind our own bookkeeping. The crate
//! does not show outside this file.
//!
//! Taken as it is, `roots` 0.0.8 evaluates known points again, has one absolute epsilon for `x` and
//! `f`, tests signs by a product that can underflow, cannot report NaN, and returns errors without
//! data; its Brent lacks the minimum step of the textbook, so that it ends in some fifty halvings.
//! Here it only *proposes* points. The [`BracketState`] evaluates them (never twice, never outside
//! the sign change), decides when the root is found, and ends a run without progress; then the
//! bracket is halved and a new run begins. If a run comes within the tolerance of a known point,
//! steps outward from it supply the minimum step.

use super::bracket_state::BracketState;
use super::{SearchError, StoppingCriteria};
use crate::Real;
use std::cell::RefCell;
use std::ops::{Add, Div, Mul, Neg, Sub};

pub(super) fn brent<T: Real>(state: &mut BracketState<'_, T>) -> Result<(), SearchError<T>> {
    run(Method::Brent, state)
}

pub(super) fn secant<T: Real>(state: &mut BracketState<'_, T>) -> Result<(), SearchError<T>> {
    run(Method::Secant, state)
}

#[derive(Clone, Copy, PartialEq)]
enum Method {
    Brent,
    Secant,
}

/// Iterations after which a run of the secant method makes way for a halving: a converging run
/// needs fewer. (Brent's method halves by itself.)
const PATIENCE: usize = 12;

fn run<T: Real>(method: Method, state: &mut BracketState<'_, T>) -> Result<(), SearchError<T>> {
    while !state.done() {
        let width = state.half_width();
        if propose(method, state)? == Ended::Close {
            state.close_in()?;
        }
        // Whatever a run did, the bracket is about halved before the next.
        if !state.halve_since(width)? {
            break;
        }
    }
    Ok(())
}

/// Reason for the end of a run of the `roots` crate.
#[derive(Clone, Copy, PartialEq)]
enum Ended {
    /// The run proposed a point within the tolerance of a known one.
    Close,
    /// The run left the sign change, or ran out of patience.
    Stuck,
}

/// Lets the `roots` crate propose points until the root is found or the run ends.
fn propose<T: Real>(
    method: Method,
    state: &mut BracketState<'_, T>,
) -> Result<Ended, SearchError<T>> {
    let (lo, hi) = (Number(state.lo.x), Number(state.hi.x));
    // Values are scaled to 1 and kept off 0, so that no product of two underflows and loses its
    // sign.
    let unit = state.lo.f.abs().max(state.hi.f.abs());
    let most = T::max_value().unwrap_or_else(|| T::epsilon().powi(-4));
    let least = T::of(4.0) / most.sqrt();
    let scaled = |f: T| Number((f / unit).abs().max(least).copysign(f));

    let run = RefCell::new(Run { state, ended: None, fresh: false });
    let f = |Number(x)| {
        let mut run = run.borrow_mut();
        let Run { state, ended, fresh } = &mut *run;
        let seen = [state.lo, state.hi, state.last];
        if let Some(known) = seen.into_iter().find(|known| x == known.x && ended.is_none()) {
            return scaled(known.f);
        }
        if ended.is_none() && (state.close(x, state.lo.x) || state.close(x, state.hi.x)) {
            *ended = Some(Ok(Ended::Close));
        }
        if ended.is_some() {
            return scaled(T::zero());
        }
        let best = state.best().x;
        let (end, value) = match state.visit(x) {
            Ok(Some(seen)) => {
                *fresh = true;
                // After a step this short interpolation would only follow noise.
                let short = T::of(1e-3) * (x - best).abs() <= StoppingCriteria::FULL.width(x);
                ((short || state.done()).then_some(Ok(Ended::Close)), seen.f)
            }
            Ok(None) => (Some(Ok(Ended::Stuck)), T::zero()),
            Err(error) => (Some(Err(error)), T::zero()),
        };
        *ended = end;
        scaled(value)
    };
    let patience = if method == Method::Secant { PATIENCE } else { usize::MAX };
    let mut rule = Rule { run: &run, patience };
    // The result is ignored: the state knows more.
    let _ = match method {
        Method::Brent => roots::find_root_brent(lo, hi, f, &mut rule),
        Method::Secant => roots::find_root_secant(lo, hi, f, &mut rule),
    };
    let ended = run.borrow_mut().ended.take();
    ended.unwrap_or(Ok(Ended::Stuck))
}

struct Run<'r, 'f, T: Real> {
    state: &'r mut BracketState<'f, T>,
    ended: Option<Result<Ended, SearchError<T>>>,
    /// True if this iteration has evaluated the function.
    fresh: bool,
}

/// Stopping rule for the `roots` crate.
struct Rule<'c, 'r, 'f, T: Real> {
    run: &'c RefCell<Run<'r, 'f, T>>,
    patience: usize,
}

impl<T: Real> roots::Convergency<Number<T>> for Rule<'_, '_, '_, T> {
    // Every iteration ends with the query for its limit, which ends the run.
    fn is_root_found(&mut self, _: Number<T>) -> bool {
        false
    }

    fn is_converged(&mut self, _: Number<T>, _: Number<T>) -> bool {
        false
    }

    fn is_iteration_limit_reached(&mut self, iteration: usize) -> bool {
        let mut run = self.run.borrow_mut();
        // An iteration that only came back to known points has a step below their spacing.
        let idle = !std::mem::replace(&mut run.fresh, false);
        if run.ended.is_none() && idle {
            run.ended = Some(Ok(Ended::Close));
        } else if run.ended.is_none() && iteration >= self.patience {
            run.ended = Some(Ok(Ended::Stuck));
        }
        run.ended.is_some()
    }
}

/// Wrapper of a [`Real`] with the traits that the `roots` crate requires.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
struct Number<T>(T);

impl<T: Real> From<i16> for Number<T> {
    fn from(n: i16) -> Self {
        Self(T::of(f64::from(n)))
    }
}

impl<T: Real> Neg for Number<T> {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

macro_rules! operators {
    ($($operator:ident $name:ident $sign:tt;)*) => {$(
        impl<T: Real> $operator for Number<T> {
            type Output = Self;
            fn $name(self, other: Self) -> Self {
                Self(self.0 $sign other.0)
            }
        }
    )*};
}
operators! { Add add +; Sub sub -; Mul mul *; Div div /; }

macro_rules! constants {
    ($($name:ident: $value:expr;)*) => {$(
        fn $name() -> Self {
            Self($value)
        }
    )*};
}

macro_rules! functions {
    ($($name:ident)*) => {$(
        fn $name(self) -> Self {
            Self(self.0.$name())
        }
    )*};
}

impl<T: Real> roots::FloatType for Number<T> {
    constants! {
        zero: T::zero(); one: T::one(); one_third: T::of(1.0 / 3.0);
        pi: T::pi(); two_third_pi: T::of(2.0) * T::frac_pi_3();
    }
    functions! { sqrt atan acos sin cos abs }

    fn powf(self, n: Self) -> Self {
        Self(self.0.powf(n.0))
    }
}
