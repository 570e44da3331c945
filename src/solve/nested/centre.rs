//! The inner search: where a contact of given width sits.

use super::width::ulps;
use super::{NestedSearch, TrialContact, nearer};
use crate::search::Bracket;
use crate::solve::equations::Equations;
use crate::{ContactError, Ends, Interval, Real};

/// What became of a contact of given width.
pub(super) enum Centred<T> {
    /// It sits here.
    At(TrialContact<T>),
    /// It would have to reach beyond the left (0) or the right (1) end of the bodies.
    Beyond(usize),
    /// It would have to let go of the point of first contact, and be no contact; or one beyond this.
    Adrift(Interval<T>),
}

impl<T: Real> NestedSearch<'_, T> {
    /// Finds where a contact of given half-width sits.
    pub fn centre(&mut self, half_width: T) -> Result<Centred<T>, ContactError<T>> {
        let zero = T::zero();
        let width = T::of(2.0) * half_width;
        let room = self.room();
        let [room_left, room_right] = room;
        match self.equations.limits() {
            Ends { left: Some(left), .. } if width >= room_right => {
                return self.attempt(Interval { left, right: self.range[1] }).map(Centred::At);
            }
            Ends { left: Some(left), .. } => {
                return self.attempt(Interval { left, right: left + width }).map(Centred::At);
            }
            Ends { right: Some(right), .. } if width >= room_left => {
                return self.attempt(Interval { left: self.range[0], right }).map(Centred::At);
            }
            Ends { right: Some(right), .. } => {
                return self.attempt(Interval { left: right - width, right }).map(Centred::At);
            }
            Ends { left: None, right: None } => {}
        }
        let (near, far) = (self.near, 1 - self.near);
        let (lo, hi) = ((width - room[far]).max(zero), width.min(room[near]));
        if lo >= hi {
            // All of the bodies, up to rounding, may be just wide enough.
            let [left, right] = self.range;
            let trial = self.attempt(Interval { left, right })?;
            let shift = (self.unbalance)(&trial.residual);
            let rounding = ulps::<T>() * (left.abs() + right.abs());
            return Ok(if shift != zero {
                Centred::Beyond(usize::from(shift > zero))
            } else if lo - hi <= rounding {
                Centred::At(trial)
            } else {
                Centred::Beyond(usize::from(room_right < room_left))
            });
        }
        let origin = self.origin;
        let on = |reach: T| match near {
            0 => Interval { left: origin - reach, right: origin + (width - reach) },
            _ => Interval { left: origin + (reach - width), right: origin + reach },
        };
        let reached = |trial: &TrialContact<T>| reaches(trial.on, origin)[near];
        let mut reach = (self.share * width).max(lo).min(hi);
        let mut trial = self.attempt(on(reach))?;
        let widest = T::of(0.125) * width;
        let mut factor = T::of(2.0);
        let [low, high] = loop {
            let shift = (self.unbalance)(&trial.residual);
            if shift == zero {
                return Ok(self.placed(trial, width));
            }
            // Twice as far as the balance seems to be, so as to pass it.
            let past = self.stiffness.map(|stiffness| shift.abs() / stiffness * factor);
            let step = past.filter(|&past| past < widest).unwrap_or(widest * factor * T::of(0.5));
            let step = step.max(ulps::<T>() * reach).max(self.resolution());
            let outward = (shift > zero) == (near == 1);
            let next = if outward { (reach + step).min(hi) } else { (reach - step).max(lo) };
            if next == reach {
                // The balance lies beyond what is left of the bodies, or of the contact.
                return if reach == room[near] {
                    Ok(Centred::Beyond(near))
                } else if reach == width - room[far] {
                    Ok(Centred::Beyond(far))
                } else {
                    Ok(match self.equations {
                        Equations::Strength { .. } => Centred::Adrift(trial.on),
                        // Not balanced, it still tells whether to widen; then it may find its
                        // balance, and if not, the pressures at its edges show it.
                        Equations::Pressure { .. } => Centred::At(trial),
                    })
                };
            }
            let before = trial;
            trial = self.attempt(on(next))?;
            let moved = (self.unbalance)(&trial.residual);
            reach = next;
            if moved != zero {
                let rightward = reached(&trial) - reached(&before);
                let rightward = if near == 1 { rightward } else { -rightward };
                let stiffness = (shift - moved) / rightward;
                self.stiffness = Some(stiffness).filter(|&stiffness| stiffness > zero);
                if (shift > zero) != (moved > zero) {
                    break if outward { [before, trial] } else { [trial, before] };
                }
            }
            factor *= T::of(4.0);
        };
        let unbalance = self.unbalance;
        let ends = Bracket::new(reached(&low), reached(&high))
            .values(unbalance(&low.residual), unbalance(&high.residual));
        let mut best = nearer(low, high, unbalance);
        let trial =
            self.run(&ends, &mut best, unbalance, |search, reach| search.attempt(on(reach)))?;
        Ok(self.placed(trial, width))
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

/// How far a contact reaches to the left and to the right of a point in it.
fn reaches<T: Real>(on: Interval<T>, origin: T) -> [T; 2] {
    [origin - on.left, on.right - origin]
}
