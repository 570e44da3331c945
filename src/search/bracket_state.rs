//! Bookkeeping of all searches: the tightest sign change seen, and the number of evaluations.

use super::{Bracket, Root, SearchError, StoppingCriteria};
use crate::Real;

/// Point, and the function there.
#[derive(Clone, Copy)]
pub(super) struct Evaluated<T> {
    pub x: T,
    pub f: T,
    /// Slope, if the function gives one.
    pub slope: Option<T>,
}

/// State of a search. Evaluates the function for a strategy, keeps the sign change, refuses values
/// that are not finite, counts evaluations, and knows when the root is found.
pub(super) struct BracketState<'f, T: Real> {
    function: &'f mut dyn FnMut(T) -> (T, Option<T>),
    tolerance: StoppingCriteria,
    pub lo: Evaluated<T>,
    pub hi: Evaluated<T>,
    /// Last point evaluated; before the first, an end of the bracket.
    pub last: Evaluated<T>,
    /// Rounding of the smaller one of the values at the ends of the bracket as given.
    pub rounding: T,
    evaluations: usize,
}

impl<'f, T: Real> BracketState<'f, T> {
    /// Checks the bracket, evaluates its ends unless they are known, then the guess.
    pub fn new(
        function: &'f mut dyn FnMut(T) -> (T, Option<T>),
        bracket: &Bracket<T>,
        tolerance: StoppingCriteria,
    ) -> Result<Self, SearchError<T>> {
        tolerance.check()?;
        let Bracket { lo, hi, values, guess } = *bracket;
        if !(lo.is_finite() && hi.is_finite() && lo <= hi) {
            return Err(SearchError::Bracket { lo, hi });
        }
        let [lo_end, hi_end] = [lo, hi].map(|x| Evaluated { x, f: T::zero(), slope: None });
        let (last, rounding, evaluations) = (lo_end, T::zero(), 0);
        let mut it =
            Self { function, tolerance, lo: lo_end, hi: hi_end, last, rounding, evaluations };
        match values {
            Some([f_lo, f_hi]) => {
                it.lo.f = finite(lo, f_lo)?;
                it.hi.f = finite(hi, f_hi)?;
            }
            None => {
                it.lo = it.call(lo)?;
                if !it.small(it.lo.f) {
                    it.hi = it.call(hi)?;
                }
            }
        }
        for end in [it.lo, it.hi] {
            if it.small(end.f) {
                (it.lo, it.hi) = (end, end);
                return Ok(it);
            }
        }
        if (it.lo.f < T::zero()) == (it.hi.f < T::zero()) {
            return Err(SearchError::NoSignChange { lo, hi, f_lo: it.lo.f, f_hi: it.hi.f });
        }
        it.rounding = T::of(4.0) * T::epsilon() * it.lo.f.abs().min(it.hi.f.abs());
        it.last = it.best();
        if let Some(x) = guess {
            it.visit(x)?;
        }
        Ok(it)
    }

    /// Evaluates at `x` and narrows the sign change. A point that is not strictly inside is not
    /// evaluated: it could not narrow the sign change.
    pub fn visit(&mut self, x: T) -> Result<Option<Evaluated<T>>, SearchError<T>> {
        if !(x > self.lo.x && x < self.hi.x) {
            return Ok(None);
        }
        if self.evaluations >= self.tolerance.max_evaluations {
            return Err(SearchError::Budget { best: self.root() });
        }
        let seen = self.call(x)?;
        if self.small(seen.f) {
            (self.lo, self.hi) = (seen, seen);
            return Ok(Some(seen));
        }
        let below = (seen.f < T::zero()) == (self.lo.f < T::zero());
        *(if below { &mut self.lo } else { &mut self.hi }) = seen;
        Ok(Some(seen))
    }

    /// Halves the sign change; `false` if no number lies between its ends.
    pub fn halve(&mut self) -> Result<bool, SearchError<T>> {
        let half = T::of(0.5);
        Ok(self.visit(half * self.lo.x + half * self.hi.x)?.is_some())
    }

    /// Halves the sign change unless its half-width is already well below `before`, an earlier
    /// half-width; `false` if no number lies between its ends.
    pub fn halve_since(&mut self, before: T) -> Result<bool, SearchError<T>> {
        Ok(self.done() || self.half_width() < T::of(0.6) * before || self.halve()?)
    }

    /// Returns the slope of the chord over the sign change.
    pub fn chord(&self) -> T {
        (self.hi.f - self.lo.f) / (self.hi.x - self.lo.x)
    }

    /// Tells whether the sign change is as tight as the tolerance.
    pub fn done(&self) -> bool {
        self.close(self.lo.x, self.hi.x)
    }

    /// Returns half the length of the bracket, which is finite whatever its ends.
    pub fn half_width(&self) -> T {
        T::of(0.5) * self.hi.x - T::of(0.5) * self.lo.x
    }

    /// Tells whether two points are within the tolerance of each other.
    pub fn close(&self, x: T, y: T) -> bool {
        self.negligible(x - y, x.abs().min(y.abs()))
    }

    /// Tells whether an error of a root near `x` is within the tolerance.
    pub fn negligible(&self, error: T, x: T) -> bool {
        error.abs() <= self.tolerance.width(x)
    }

    /// Steps from the best point towards the sign change, by lengths that grow from the tolerance.
    /// If the root is as close as it seems, the first step closes the bracket on it; if noise has
    /// hidden it, one of the next steps does. If the chord of a step leads out of the bracket, the
    /// root only seemed to be close, next to a value that is small compared with the value at the
    /// other end.
    pub fn close_in(&mut self) -> Result<(), SearchError<T>> {
        let best = self.best().x;
        let rightward = best == self.lo.x;
        let mut step = T::of(0.75) * self.tolerance.width(best);
        while !self.done() && step < T::of(0.5) * self.half_width() {
            let x = if rightward { best + step } else { best - step };
            let before = if rightward { self.lo } else { self.hi };
            let crossed = |it: &Self| if rightward { it.hi.x == x } else { it.lo.x == x };
            // From x = 0 there is no relative step.
            if self.visit(x)?.is_none() || crossed(self) {
                break;
            }
            let change = (self.last.f - before.f).abs() * self.half_width();
            if change < before.f.abs() * T::of(0.5) * (x - before.x).abs() {
                break;
            }
            step *= T::of(8.0);
        }
        Ok(())
    }

    /// Returns the end of the sign change with the smaller value.
    pub fn best(&self) -> Evaluated<T> {
        if self.hi.f.abs() < self.lo.f.abs() { self.hi } else { self.lo }
    }

    pub fn root(&self) -> Root<T> {
        let Evaluated { x, f: residual, .. } = self.best();
        Root { x, residual, bracket: [self.lo.x, self.hi.x], evaluations: self.evaluations }
    }

    fn call(&mut self, x: T) -> Result<Evaluated<T>, SearchError<T>> {
        self.evaluations += 1;
        let (f, slope) = (self.function)(x);
        self.last = Evaluated { x, f: finite(x, f)?, slope };
        Ok(self.last)
    }

    fn small(&self, f: T) -> bool {
        f.abs() <= T::of(self.tolerance.residual)
    }
}

fn finite<T: Real>(x: T, value: T) -> Result<T, SearchError<T>> {
    if value.is_finite() { Ok(value) } else { Err(SearchError::NotFinite { x, value }) }
}
