//! Inner search: the place of a contact of given width.

use super::width::ulps;
use super::{NestedSearch, TrialContact, nearer};
use crate::search::Bracket;
use crate::solve::equations::Equations;
use crate::{Ends, Fallible, Interval, Real};

/// Outcome of the search for the place of a contact of given width.
pub(super) enum Centred<T> {
    /// Contact found.
    At(TrialContact<T>),
    /// End of the bodies, left (0) or right (1), beyond which the contact would have to reach.
    Beyond(usize),
    /// Contact that would have to let go of the point of first contact: it does not exist, or lies
    /// further on.
    Adrift(Interval<T>),
}

/// Two contacts that enclose the balance, or the end of the search for them.
type SteppedOut<T> = Result<[TrialContact<T>; 2], Centred<T>>;

impl<T: Real> NestedSearch<'_, T> {
    /// Finds the place of a contact of given half-width.
    pub fn centre(&mut self, half_width: T) -> Fallible<T, Centred<T>> {
        let width = T::of(2.0) * half_width;
        let ([first, last], room) = (self.range, self.room());
        let given = match self.equations.limits() {
            Ends { left: Some(left), .. } => Some([left, (left + width).min(last)]),
            Ends { right: Some(right), .. } => Some([(right - width).max(first), right]),
            Ends { left: None, right: None } => None,
        };
        if let Some([left, right]) = given {
            return self.attempt(Interval { left, right }).map(Centred::At);
        }
        let (near, far) = (self.near, 1 - self.near);
        let (lo, hi) = ((width - room[far]).max(T::zero()), width.min(room[near]));
        if lo >= hi {
            // The whole width of the bodies, up to rounding, may just suffice.
            let trial = self.attempt(Interval { left: first, right: last })?;
            let shift = (self.unbalance)(&trial.residual);
            let rounding = ulps::<T>() * (first.abs() + last.abs());
            return Ok(if shift != T::zero() {
                Centred::Beyond(usize::from(shift > T::zero()))
            } else if lo - hi <= rounding {
                Centred::At(trial)
            } else {
                Centred::Beyond(usize::from(room[1] < room[0]))
            });
        }
        let [low, high] = match self.step_out(width, [lo, hi])? {
            Ok(bracket) => bracket,
            Err(Centred::At(trial)) if (self.unbalance)(&trial.residual) == T::zero() => {
                return Ok(self.placed(trial, width));
            }
            Err(found) => return Ok(found),
        };
        let (unbalance, reached) = (self.unbalance, [low, high].map(|trial| self.reached(&trial)));
        let ends = Bracket::new(reached[0], reached[1])
            .values(unbalance(&low.residual), unbalance(&high.residual));
        let mut best = nearer(low, high, unbalance);
        let trial = self.run(&ends, &mut best, unbalance, |search, reach| {
            search.attempt(search.reaching(width, reach))
        })?;
        Ok(self.placed(trial, width))
    }

    /// Steps from the place of the last contact until the balance is between two reaches of the
    /// near edge; otherwise returns the outcome of the last trial.
    fn step_out(&mut self, width: T, [lo, hi]: [T; 2]) -> Fallible<T, SteppedOut<T>> {
        let (zero, near, room) = (T::zero(), self.near, self.room());
        let mut reach = (self.share * width).max(lo).min(hi);
        let mut trial = self.attempt(self.reaching(width, reach))?;
        let widest = T::of(0.125) * width;
        let mut factor = T::of(2.0);
        loop {
            let shift = (self.unbalance)(&trial.residual);
            if shift == zero {
                return Ok(Err(Centred::At(trial)));
            }
            // Twice the estimated distance of the balance, to pass it.
            let past = self.stiffness.map(|stiffness| shift.abs() / stiffness * factor);
            let step = past.filter(|&past| past < widest).unwrap_or(widest * factor * T::of(0.5));
            let step = step.max(ulps::<T>() * reach).max(self.resolution());
            let outward = (shift > zero) == (near == 1);
            let next = if outward { (reach + step).min(hi) } else { (reach - step).max(lo) };
            if next == reach {
                // The balance lies beyond what is left of the bodies, or of the contact.
                return Ok(Err(match self.equations {
                    _ if reach == room[near] => Centred::Beyond(near),
                    _ if reach == width - room[1 - near] => Centred::Beyond(1 - near),
                    Equations::Strength { .. } => Centred::Adrift(trial.on),
                    // The unbalanced contact still tells whether to widen, and a wider one may be
                    // balanced. If not, the pressures at its edges show it.
                    Equations::Pressure { .. } => Centred::At(trial),
                }));
            }
            let before = trial;
            trial = self.attempt(self.reaching(width, next))?;
            let moved = (self.unbalance)(&trial.residual);
            reach = next;
            if moved != zero {
                let outwards = self.reached(&trial) - self.reached(&before);
                let rightward = if near == 1 { outwards } else { -outwards };
                let stiffness = (shift - moved) / rightward;
                self.stiffness = Some(stiffness).filter(|&stiffness| stiffness > zero);
                if (shift > zero) != (moved > zero) {
                    return Ok(Ok(if outward { [before, trial] } else { [trial, before] }));
                }
            }
            factor *= T::of(4.0);
        }
    }

    /// Returns the contact of a width with its near edge at a distance from the origin.
    fn reaching(&self, width: T, reach: T) -> Interval<T> {
        let origin = self.origin;
        match self.near {
            0 => Interval { left: origin - reach, right: origin + (width - reach) },
            _ => Interval { left: origin + (reach - width), right: origin + reach },
        }
    }

    /// Returns the distance of the near edge of a contact from the origin.
    fn reached(&self, trial: &TrialContact<T>) -> T {
        reaches(trial.on, self.origin)[self.near]
    }

    /// Remembers the near edge of a placed contact, and its share, for the next.
    fn placed(&mut self, trial: TrialContact<T>, width: T) -> Centred<T> {
        let reaches = reaches(trial.on, self.origin);
        if reaches[1 - self.near] < T::of(0.125) * reaches[self.near] {
            self.near = 1 - self.near;
        }
        self.share = reaches[self.near] / width;
        Centred::At(trial)
    }
}

/// Returns the distances that a contact reaches to the left and to the right of a point in it.
fn reaches<T: Real>(on: Interval<T>, origin: T) -> [T; 2] {
    [origin - on.left, on.right - origin]
}
