//! The `roots` crate behind our own bookkeeping; nothing of it shows outside this file.
//!
//! Taken as it is, `roots` 0.0.8 evaluates known points again, has one absolute epsilon for
//! `x` and `f`, tests signs by a product that can underflow, cannot report NaN, returns
//! errors that carry nothing, and its Brent lacks the least step of the textbook, so that it
//! ends in some fifty halvings. So it only *proposes* points here. The [`BracketState`] evaluates
//! them (never twice, never outside the sign change), decides when the root is found, and
//! ends a run that goes nowhere; then the bracket is halved and a new run begins. Where a run
//! comes within the tolerance of a known point, steps outward from it supply the least step.

use super::bracket_state::BracketState;
use super::{Bracket, Root, SearchError, StoppingCriteria};
use crate::Real;
use std::cell::RefCell;
use std::ops::{Add, Div, Mul, Neg, Sub};

#[derive(Clone, Copy, PartialEq)]
pub(super) enum Method {
    Brent,
    Secant,
}

impl Method {
    /// Iterations after which a run has to make way for a halving. A secant that converges
    /// needs fewer; Brent's method halves by itself.
    fn patience(self) -> usize {
        match self {
            Self::Brent => usize::MAX,
            Self::Secant => 12,
        }
    }
}

pub(super) fn run<T: Real>(
    method: Method,
    f: &mut dyn FnMut(T) -> T,
    bracket: &Bracket<T>,
    tolerance: StoppingCriteria,
) -> Result<Root<T>, SearchError<T>> {
    let mut f = |x| (f(x), None);
    let mut state = BracketState::new(&mut f, bracket, tolerance)?;
    while !state.done() {
        let width = state.half_width();
        if propose(method, &mut state)? == Ended::Close {
            state.close_in()?;
        }
        // Whatever a run did, the bracket is about halved before the next.
        let halved = state.half_width() < T::of(0.6) * width;
        if !state.done() && !halved && !state.halve()? {
            break;
        }
    }
    Ok(state.root())
}

/// Why a run of the `roots` crate ended.
#[derive(Clone, Copy, PartialEq)]
enum Ended {
    /// It proposed a point within the tolerance of a known one.
    Close,
    /// It left the sign change, or ran out of patience.
    Stuck,
}

/// Lets the `roots` crate propose points until the root is found or the run ends.
fn propose<T: Real>(method: Method, state: &mut BracketState<'_, T>) -> Result<Ended, SearchError<T>> {
    let (lo, hi) = (Number(state.lo.x), Number(state.hi.x));
    // Scaled to 1 and kept off 0, no product of two values can underflow and lose its sign.
    let unit = state.lo.f.abs().max(state.hi.f.abs());
    let most = T::max_value().unwrap_or_else(|| T::epsilon().powi(-4));
    let least = T::of(4.0) / most.sqrt();
    let scaled = |f: T| Number((f / unit).abs().max(least).copysign(f));

    let run = RefCell::new(Run { state, ended: None, fresh: false });
    let f = |Number(x)| {
        let mut run = run.borrow_mut();
        if run.ended.is_some() {
            return scaled(T::zero());
        }
        for known in [run.state.lo, run.state.hi, run.state.last] {
            if x == known.x {
                return scaled(known.f);
            }
        }
        if run.state.close(x, run.state.lo.x) || run.state.close(x, run.state.hi.x) {
            run.ended = Some(Ok(Ended::Close));
            return scaled(T::zero());
        }
        let best = run.state.best().x;
        match run.state.visit(x) {
            Ok(Some(seen)) => {
                run.fresh = true;
                // A step this short leaves nothing for interpolation to do but follow noise.
                let short = T::of(1e-3) * (x - best).abs() <= StoppingCriteria::FULL.width(x);
                if short || run.state.done() {
                    run.ended = Some(Ok(Ended::Close));
                }
                scaled(seen.f)
            }
            Ok(None) => {
                run.ended = Some(Ok(Ended::Stuck));
                scaled(T::zero())
            }
            Err(error) => {
                run.ended = Some(Err(error));
                scaled(T::zero())
            }
        }
    };
    let mut rule = Rule { run: &run, patience: method.patience() };
    // What it returns is left aside: the state knows more.
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
    /// Whether this iteration has evaluated anything.
    fresh: bool,
}

/// Tells the `roots` crate when to stop.
struct Rule<'c, 'r, 'f, T: Real> {
    run: &'c RefCell<Run<'r, 'f, T>>,
    patience: usize,
}

impl<T: Real> roots::Convergency<Number<T>> for Rule<'_, '_, '_, T> {
    // Every iteration ends with the question after its limit, and that ends the run.
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

/// A [`Real`] in the dress that the `roots` crate asks for.
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

impl<T: Real> Add for Number<T> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0)
    }
}

impl<T: Real> Sub for Number<T> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0)
    }
}

impl<T: Real> Mul for Number<T> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self(self.0 * other.0)
    }
}

impl<T: Real> Div for Number<T> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        Self(self.0 / other.0)
    }
}

impl<T: Real> roots::FloatType for Number<T> {
    fn zero() -> Self {
        Self(T::zero())
    }
    fn one() -> Self {
        Self(T::one())
    }
    fn one_third() -> Self {
        Self(T::of(1.0 / 3.0))
    }
    fn pi() -> Self {
        Self(T::pi())
    }
    fn two_third_pi() -> Self {
        Self(T::of(2.0) * T::frac_pi_3())
    }
    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }
    fn atan(self) -> Self {
        Self(self.0.atan())
    }
    fn acos(self) -> Self {
        Self(self.0.acos())
    }
    fn sin(self) -> Self {
        Self(self.0.sin())
    }
    fn cos(self) -> Self {
        Self(self.0.cos())
    }
    fn abs(self) -> Self {
        Self(self.0.abs())
    }
    fn powf(self, n: Self) -> Self {
        Self(self.0.powf(n.0))
    }
}
