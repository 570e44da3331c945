//! Outer search: the width of the contact.

use super::centre::Centred;
use super::{NestedSearch, TrialContact, nearer};
use crate::search::Bracket;
use crate::solve::equations::{Equations, Residual};
use crate::{ContactError, Ends, Fallible, Interval, Real};

/// Widths tried before the search gives up bracketing the load: enough to halve the largest number
/// down to the smallest.
const MAX_TRIED_WIDTHS: usize = 2200;

/// Largest exponent of the power of the width that the load is taken to follow.
const STEEPEST_LOAD: f64 = 40.0;

impl<T: Real> NestedSearch<'_, T> {
    /// Finds the half-width at which the spread vanishes, starting from a guess.
    pub fn widen(&mut self, guess: T) -> Fallible<T, TrialContact<T>> {
        let [narrow, wide] = self.enclose(guess)?;
        if narrow.residual.spread() == T::zero() {
            return Ok(narrow);
        }
        let ends = Bracket::new(narrow.on.half_width(), wide.on.half_width())
            .values(narrow.residual.deficit(), wide.residual.deficit());
        let mut best = nearer(narrow, wide, Residual::deficit);
        self.run(&ends, &mut best, Residual::deficit, |search, half_width| {
            match search.centre(half_width)? {
                Centred::At(trial) => Ok(trial),
                Centred::Beyond(_) | Centred::Adrift(_) => Err(search.no_balance(half_width)),
            }
        })
    }

    /// Finds a contact too narrow for the load and one too wide, or the exact one twice.
    fn enclose(&mut self, guess: T) -> Fallible<T, [TrialContact<T>; 2]> {
        let (zero, half) = (T::zero(), T::of(0.5));
        // Closer to a given limit than this, the other limit is the same number.
        let given = self.equations.limits() != Ends::both(None);
        let resolution = if given { self.resolution() } else { zero };
        let least = (half * self.equations.least_width()).max(resolution);
        let most = half * (self.range[1] - self.range[0]);
        let (mut narrow, mut wide): (Option<TrialContact<T>>, Option<TrialContact<T>>) =
            (None, None);
        let mut half_width = guess.max(least * T::of(1.5)).min(most * half);
        let mut next_width = NextWidth::new();
        for _ in 0..MAX_TRIED_WIDTHS {
            let (trial, is_pinned) = match (self.centre(half_width)?, narrow) {
                (Centred::At(trial), _) => (trial, self.is_at_end(trial.on)),
                (Centred::Adrift(_), _) => {
                    let from = narrow.map_or(zero, |narrow| narrow.on.half_width());
                    half_width = half * from + half * half_width;
                    if half_width - from <= T::of(1e-3) * from || half_width <= least {
                        break;
                    }
                    continue;
                }
                (Centred::Beyond(end), Some(narrow)) => (self.pin(end, narrow.on)?, true),
                (Centred::Beyond(_), None) if half_width * half > least => {
                    half_width *= half;
                    continue;
                }
                (Centred::Beyond(_), None) => break,
            };
            let (last, spread) = (trial.on.half_width(), trial.residual.spread());
            if spread == zero {
                return Ok([trial, trial]);
            }
            if spread > zero && is_pinned {
                return Err(self.too_short(trial.on));
            }
            half_width = next_width.after(last, trial.residual.growth, spread > zero);
            *(if spread > zero { &mut narrow } else { &mut wide }) = Some(trial);
            if let (Some(narrow), Some(wide)) = (narrow, wide) {
                // A wide bracket is narrowed from the end last tried, as long as this helps.
                let (from, to) = (narrow.on.half_width(), wide.on.half_width());
                let inside = half_width > from && half_width < to;
                if !inside || to <= T::of(1.5) * from {
                    return Ok([narrow, wide]);
                }
                continue;
            }
            if spread > zero {
                half_width = half_width.min(most);
                if half_width <= last {
                    return Err(self.too_short(trial.on));
                }
            } else {
                half_width = half_width.max(least * (T::one() + ulps()));
                if half_width >= last || half_width <= zero {
                    break;
                }
            }
        }
        Err(self.no_balance(half_width))
    }

    /// Tells whether a contact with one given limit has its free limit at an end of the bodies.
    fn is_at_end(&self, on: Interval<T>) -> bool {
        let ends = Ends::from(self.range);
        let free = self.equations.limits().only_free();
        free.is_some_and(|side| on[side] == ends[side])
    }

    /// Returns the balanced contact that just reaches one end of the bodies, wider than a given
    /// one.
    fn pin(&mut self, end: usize, narrow: Interval<T>) -> Fallible<T, TrialContact<T>> {
        let (origin, range, room) = (self.origin, self.range, self.room());
        let on = |other: T| match end {
            0 => Interval { left: range[0], right: origin + other },
            _ => Interval { left: origin - other, right: range[1] },
        };
        let least = if end == 0 { narrow.right - origin } else { origin - narrow.left };
        let (near, far) = (self.attempt(on(least))?, self.attempt(on(room[1 - end]))?);
        let [f_near, f_far] = [near.residual.shift(), far.residual.shift()];
        if f_far == T::zero() || (f_near > T::zero()) == (f_far > T::zero()) {
            return Ok(far);
        }
        let ends = Bracket::new(least, room[1 - end]).values(f_near, f_far);
        let mut best = nearer(near, far, Residual::shift);
        self.run(&ends, &mut best, Residual::shift, |search, other| search.attempt(on(other)))
    }

    /// Returns the error for a contact that reaches the end of the bodies and must still widen.
    fn too_short(&mut self, on: Interval<T>) -> ContactError<T> {
        let missed = match self.equations {
            Equations::Pressure { wanted, .. } => self
                .attempt(on)
                .and_then(|trial| wanted.met(on, [trial.residual.at_a, trial.residual.at_b]))
                .err(),
            Equations::Strength { .. } => None,
        };
        missed.unwrap_or(self.no_balance(on.half_width()))
    }
}

/// Returns a relative step that is certain to change a number.
pub(super) fn ulps<T: Real>() -> T {
    T::of(8.0) * T::epsilon()
}

/// Predictor of widths from the loads of the last ones: the load is taken to follow a power of the
/// width, 2 for bodies round at the contact, and known after two trials.
struct NextWidth<T> {
    exponent: T,
    /// Last half-width, and the growth required there.
    before: Option<[T; 2]>,
    /// Exponent on the expected factor of the width, chosen to pass the root and so enclose it, and
    /// the largest excess over this factor. Small at first; while the root is not passed, twice and
    /// four times as far (on a logarithmic scale).
    power: T,
    beyond: T,
}

impl<T: Real> NextWidth<T> {
    fn new() -> Self {
        let little = T::of(1.1);
        Self { exponent: T::of(2.0), before: None, power: little, beyond: little }
    }

    /// Returns the next half-width after one that is too narrow (`wider`) or too wide. `growth` is
    /// the factor by which a round body would have to grow.
    fn after(&mut self, half_width: T, growth: T, wider: bool) -> T {
        if let Some([last, asked]) = self.before.replace([half_width, growth]) {
            let seen = T::of(-2.0) * (growth / asked).ln() / (half_width / last).ln();
            if seen > T::of(0.5) {
                self.exponent = seen.min(T::of(STEEPEST_LOAD));
            }
        }
        let pull = growth.powf(T::of(2.0) / self.exponent);
        let factor = if wider {
            pull.powf(self.power).min(pull * self.beyond).max(T::one() + ulps())
        } else {
            pull.powf(self.power).max(pull / self.beyond).min(T::one() - ulps())
        };
        (self.power, self.beyond) = (self.power + self.power, self.beyond.powi(4));
        half_width * factor
    }
}
