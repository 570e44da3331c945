//! First estimate of one contact, from few samples.

use super::super::newton::Stop;
use super::super::newton::single::{Converged, Effort};
use super::{MAX_GUESSES, Single};
use crate::{Fallible, Interval, Real};

/// Initial guesses that may reach for an end before the capacity of the bodies is computed.
const MAX_GUESSES_AT_END: usize = 2;

/// Share of its span above which a contact needs no closer span.
const LARGE_SHARE: f64 = 0.4;

/// Estimate of the contact.
struct Guess<T> {
    on: Interval<T>,
    /// Error of the search on the samples, as a share of the half-width.
    error: T,
    /// Error of the samples, as a share of the span.
    doubt: T,
}

impl<T: Real> Single<'_, '_, T> {
    /// Returns a first estimate of the contact, and its uncertainty as a share of its half-width;
    /// `None` if guesses lead nowhere.
    pub(super) fn initial_guess(&mut self) -> Fallible<T, Option<(Interval<T>, T)>> {
        let gap = &self.contact.gap;
        let [left, right] = gap.range();
        // A place that the survey found may have no derivative, which points near it would keep.
        let (mut span, mut on, mut at_end) = (self.start().plain(), None, 0);
        for _ in 0..MAX_GUESSES {
            if !(span.left >= left && span.right <= right && span.left < span.right) {
                return Ok(None);
            }
            let Some(doubt) = self.integrator.sample_over(gap, span, true)? else {
                return Ok(None);
            };
            let (next, reaches_end) = match self.converge(on.unwrap_or(span), Effort::Guess)? {
                Ok(Converged { on: guess, error, .. }) => {
                    let guess = Guess { on: guess.plain(), error, doubt };
                    if let Some(share) = self.share_in_doubt(span, &guess) {
                        return Ok(Some((guess.on, share)));
                    }
                    on = Some(guess.on);
                    self.closer(span, &guess)
                }
                Err(Stop::Beyond(reached)) => {
                    on = None;
                    (self.up_to_corners(reached.plain()), true)
                }
                Err(_) => return Ok(None),
            };
            at_end += usize::from(reaches_end);
            let is_spent = reaches_end && at_end == MAX_GUESSES_AT_END && !self.may_bear()?;
            if is_spent || on.is_none() && next.is_same(&span) {
                return Ok(None);
            }
            span = next;
        }
        Ok(None)
    }

    /// Tells whether a breakpoint lies inside: its place is exact, and only the width is uncertain.
    fn is_broken(&self, on: Interval<T>) -> bool {
        let breakpoint = self.contact.gap.breakpoint_after(on.left);
        breakpoint.is_some_and(|breakpoint| breakpoint < on.right)
    }

    /// Returns the uncertainty of a guess, as a share of its half-width, if it is small enough.
    fn share_in_doubt(&self, span: Interval<T>, guess: &Guess<T>) -> Option<T> {
        let Guess { on, error, doubt } = *guess;
        let share = on.half_width() / span.half_width();
        let (broken, comparable) = (self.is_broken(on), share >= T::of(LARGE_SHARE));
        let doubt = if broken && !comparable { doubt.sqrt() } else { doubt };
        let relative = if broken { doubt } else { doubt / share };
        let sure = T::of(if broken { 0.1 } else { 0.02 });
        if on.left >= span.left && on.right <= span.right {
            let is_sure = error <= T::of(0.1) && (comparable || relative <= sure);
            return is_sure.then(|| relative.min(T::of(0.1)));
        }
        // Outside the span, the uncertainty grows with the powers that the guess has left out.
        let apart = (on.centre() - span.centre()).abs() / span.half_width();
        let reached = share.max(apart).max(T::one());
        let is_sure = relative * reached.powi(5) <= T::of(1e-3) && error <= sure;
        is_sure.then(|| sure * T::of(0.5))
    }

    /// Returns a span around a guess, as close as its place is known, and whether it reached for an
    /// end of the bodies: it then goes half the way there, where the slope may be infinite.
    fn closer(&self, span: Interval<T>, guess: &Guess<T>) -> (Interval<T>, bool) {
        let Guess { on, doubt, .. } = *guess;
        let rounding = T::of(64.0) * T::epsilon() * span.left.abs().max(span.right.abs());
        let doubt = if self.is_broken(on) { T::zero() } else { (doubt + doubt).min(T::of(0.3)) };
        let reach = (doubt * span.half_width()).max(rounding);
        let [left, right] = self.beyond(on, T::of(0.125));
        // Beyond the span, the guess relies on the outermost panel, which may be a short one.
        let guessed = |by: T| T::of(1.0 / 64.0) * by.max(T::zero());
        let next = Interval {
            left: left.min(on.left - reach - guessed(span.left - on.left)),
            right: right.max(on.right + reach + guessed(on.right - span.right)),
        };
        let range = self.contact.gap.range();
        let half_way = |x: T, from: T, end: T, is_beyond: bool| {
            if is_beyond { T::of(0.5) * from + T::of(0.5) * end } else { x }
        };
        let is_beyond = [next.left <= range[0], next.right >= range[1]];
        let next = Interval {
            left: half_way(next.left, on.left, range[0], is_beyond[0]),
            right: half_way(next.right, on.right, range[1], is_beyond[1]),
        };
        (self.up_to_corners(next), is_beyond[0] || is_beyond[1])
    }
}
