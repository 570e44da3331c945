//! First start of one contact, and further ones after a search that has found none.

use super::super::edges::{Conditions, Given};
use super::super::first_contact::first_contact;
use super::{Elsewhere, MAX_GUESSES, Single};
use crate::gap::Sampler;
use crate::{Ends, Fallible, Interval, Real, SolveError};

impl<T: Real> Single<'_, '_, T> {
    /// Returns another start: low places of the gap, if heights are known, or the place of first
    /// contact.
    ///
    /// On a flat that leans a little, if only by rounding, the lowest place is at one of its ends,
    /// whose neighbourhood says nothing of the other end. But at the limits of a contact, the gap
    /// of round bodies is F/κ, and of wedges, which rise most, up to twice as much: up to this
    /// height the flat takes part.
    pub(super) fn elsewhere(&mut self, from: Elsewhere) -> Fallible<T, Option<Interval<T>>> {
        if from == Elsewhere::Low {
            let Some(look) = self.look else { return Ok(None) };
            let gap = &self.contact.gap;
            return Ok(match self.conditions.given {
                Given::Load(load) => {
                    Some(look.below(gap, T::of(2.0) * load / self.conditions.kappa))
                }
                Given::HalfWidth(half_width) => Some(look.level(gap, half_width)),
                Given::Centre { .. } => None,
            });
        }
        let mut sampler = Sampler::default();
        let around = self.around_first_contact(&mut sampler, from == Elsewhere::Leaning);
        *self.cost += sampler.cost;
        around.map(Some)
    }

    /// Returns the place of first contact, with a width that may bear the load: with the slopes -m
    /// and n at the limits a parabola bears `F = κ L (m + n)/4`. A leaning contact has the place of
    /// first contact at the angle φ = π m/(m + n), like a wedge of these slopes, which bears
    /// `F = κ L (m + n) sin φ/π`.
    fn around_first_contact(
        &self,
        sampler: &mut Sampler<T>,
        leans: bool,
    ) -> Fallible<T, Interval<T>> {
        let (gap, conditions, quarter) = (&self.contact.gap, &self.conditions, T::of(0.25));
        let x = first_contact(sampler, gap, self.start)?;
        let [left, right] = gap.range();
        let around = |reach: T, lean: T| Interval {
            left: x - reach * (T::one() + lean),
            right: x + reach * (T::one() - lean),
        };
        let mut reach = quarter * (x - left).min(right - x);
        let mut on = around(reach, T::zero());
        if let Given::HalfWidth(half_width) = conditions.given {
            (reach, on) = (half_width, around(half_width.min(reach), T::zero()));
        }
        for _ in 0..MAX_GUESSES {
            let falls = -sampler.slope(gap, on.left)?;
            let rise = falls + sampler.slope(gap, on.right)?;
            let stiffness = quarter * conditions.kappa * rise;
            // So small a load is below any number.
            if stiffness > T::zero() && (reach * stiffness).is_zero() {
                return Err(SolveError::Overflow { interval: on }.into());
            }
            let share =
                if leans { (falls / rise).max(T::zero()).min(T::one()) } else { T::of(0.5) };
            let (sin, cos) = (T::pi() * share).sin_cos();
            match conditions.given {
                Given::Load(load) | Given::Centre { load, .. }
                    if load > T::zero() && reach * stiffness * sin > load =>
                {
                    reach *= quarter;
                    on = around(reach, cos);
                }
                _ => break,
            }
        }
        Ok(on)
    }

    /// Returns the start, or the lowest gap, if known.
    pub(super) fn start_if_known(&self) -> Option<Interval<T>> {
        let Conditions { edges, given, kappa } = self.conditions;
        // Next to the effect of adhesion, a load tells nothing.
        let adhesive = edges.are_adhesive();
        let load = match given {
            Given::Load(load) if !adhesive => Some(load / kappa),
            _ => None,
        };
        self.start.or_else(|| Some(self.look?.around_lowest(load)))
    }

    /// Returns the first guess: the start, or the middle half of the bodies; for a load at a given
    /// place, an interval around it.
    pub(super) fn start(&self) -> Interval<T> {
        let [left, right] = self.contact.gap.range();
        let (whole, half) = (Interval { left, right }, T::of(0.5));
        let quarter = half * whole.half_width();
        let (centre, reach) = match self.conditions.given {
            Given::Centre { at, .. } => {
                let at = at.component(0);
                let reach = quarter.min(half * (at - left).min(right - at));
                if reach > T::zero() { (at, reach) } else { (whole.centre(), quarter) }
            }
            _ => (whole.centre(), quarter),
        };
        let middle = Interval { left: centre - reach, right: centre + reach };
        let inside = |on: &Interval<T>| on.left >= left && on.right <= right;
        let start = self.start_if_known().filter(inside).unwrap_or(middle);
        let on = self.conditions.with_given_limits(start);
        // A given limit may be closer to the end of the bodies than this width.
        Interval {
            left: if on.left < left { half * left + half * on.right } else { on.left },
            right: if on.right > right { half * on.left + half * right } else { on.right },
        }
    }

    /// Returns both limits, moved outward by a share of their distance to the next breakpoint
    /// inside. (A body may be a thousand times as steep on the other side of a breakpoint.)
    pub(super) fn beyond(&self, on: Interval<T>, share: T) -> [T; 2] {
        let gap = &self.contact.gap;
        let first = gap.breakpoint_after(on.left).filter(|&breakpoint| breakpoint < on.right);
        let last = gap.breakpoint_before(on.right).filter(|&breakpoint| breakpoint > on.left);
        let [right_end, left_end] = [first.unwrap_or(on.right), last.unwrap_or(on.left)];
        [on.left - share * (right_end - on.left), on.right + share * (on.right - left_end)]
    }

    /// Returns a span a little wider than a contact, by at most half the way to the ends of the
    /// bodies.
    pub(super) fn around(&self, on: Interval<T>, share: T) -> Interval<T> {
        let (half, range) = (T::of(0.5), self.contact.gap.range());
        let [left, right] = self.beyond(on, share);
        self.up_to_corners(Interval {
            left: left.max(half * on.left + half * range[0]),
            right: right.min(half * on.right + half * range[1]),
        })
    }

    /// Cuts a span at a fixed edge.
    pub(super) fn up_to_corners(&self, on: Interval<T>) -> Interval<T> {
        let Ends { left, right } = self.conditions.limits();
        Interval { left: left.unwrap_or(on.left), right: right.unwrap_or(on.right) }.plain()
    }
}
