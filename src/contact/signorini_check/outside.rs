//! Whether the loaded bodies overlap beside their contacts, where their heights are known and at
//! their corners.

use super::SignoriniCheck;
use crate::contact::exterior_field::ExteriorField;
use crate::gap::{CoarseHeights, Cost, LowPoint, Sampler};
use crate::quadrature::panels;
use crate::{ContactError, Ends, Interval, Real, Side};

/// The share of the load that the series of its pressures may leave open before more of them are
/// taken; and the share of that, where it hides whether the bodies overlap.
const OPEN: f64 = 1e-3;
const LESS_OPEN: f64 = 0.01;

/// Places between two heights that are looked at where these may hide a wave.
const PLACES: usize = 8;

/// How often a span between two heights is halved in search of its lowest place.
const MOST_HALVES: usize = 8;

impl<T: Real> SignoriniCheck<'_, T> {
    /// Between which of some places the loaded gap is lowest.
    fn valley(
        &self,
        pressed: &impl Fn(T) -> T,
        sampler: &mut Sampler<T>,
        [from, to]: [T; 2],
    ) -> Result<[T; 2], ContactError<T>> {
        let step = (to - from) / T::count(PLACES + 1);
        let (mut lowest, mut least) = (from, None);
        for i in 1..=PLACES {
            let x = from + step * T::count(i);
            let gap = sampler.height(self.gap, x)? - pressed(x) / self.kappa;
            if least.is_none_or(|least| gap < least) {
                (lowest, least) = (x, Some(gap));
            }
        }
        Ok([lowest - step, lowest + step])
    }

    /// About where the loaded gap is lowest between two places, at the first of which it falls and
    /// at the second rises.
    fn lowest_between(
        &self,
        fields: &[ExteriorField<T>],
        sampler: &mut Sampler<T>,
        [mut left, mut right]: [T; 2],
    ) -> Result<T, ContactError<T>> {
        let half = T::of(0.5);
        let (mut falls, mut rises) = (None, None);
        for _ in 0..MOST_HALVES {
            let x = half * (left + right);
            let pushed = fields.iter().fold(T::zero(), |sum, field| sum + field.slope(x));
            let slope = sampler.slope(self.gap, x)? - pushed / self.kappa;
            if slope > T::zero() {
                (right, rises) = (x, Some(slope));
            } else {
                (left, falls) = (x, Some(-slope));
            }
        }
        // The slope is all but straight by now.
        let share = match (falls, rises) {
            (Some(falls), Some(rises)) => falls / (falls + rises),
            _ => half,
        };
        Ok(left + share * (right - left))
    }

    /// Whether one contact leaves nothing of the bodies outside.
    pub fn covers(&self, ends: Ends<T>) -> bool {
        let Interval { left, right } = self.found.interval;
        panels::several(self.integrator).is_none() && left <= ends.left && right >= ends.right
    }

    /// Where the loaded bodies would overlap outside the contacts, up to their ends, and the gap
    /// there.
    pub fn overlap(
        &self,
        fields: &mut Vec<ExteriorField<T>>,
        look: &CoarseHeights<T>,
        ends: Ends<T>,
        cost: &mut Cost,
    ) -> Result<Option<[T; 2]>, ContactError<T>> {
        if fields.is_empty() {
            self.fields(fields)?;
        }
        let corners = [self.corner(Side::Left, ends, cost)?, self.corner(Side::Right, ends, cost)?];
        let within = |low: LowPoint<T>| {
            let height = self.gap.turned(low.x, low.height);
            let [from, to] = low.between.unwrap_or([low.x; 2]);
            let (from, to) = (from.max(ends.left), to.min(ends.right));
            let between = low.between.map(|_| [from, to]);
            (from <= to).then(|| LowPoint { x: low.x.max(from).min(to), height, between, ..low })
        };
        let mut share = T::of(OPEN);
        self.resolve(fields, share)?;
        loop {
            let [first, last] = corners;
            let heights = first.into_iter().chain(look.low_points().filter_map(within)).chain(last);
            let (overlap, is_hidden) = self.overlap_at(fields, heights, cost)?;
            share *= T::of(LESS_OPEN);
            if overlap.is_some() || !is_hidden || !self.resolve(fields, share)? {
                return Ok(overlap);
            }
        }
    }

    /// A corner before the end of the bodies that the contacts do not reach: where the gap falls
    /// towards it, no height before it is as low.
    fn corner(
        &self,
        side: Side,
        ends: Ends<T>,
        cost: &mut Cost,
    ) -> Result<Option<LowPoint<T>>, ContactError<T>> {
        let x = ends[side];
        let reached = [self.gap.range()[side as usize], self.found.interval[side]];
        if reached.contains(&x) {
            return Ok(None);
        }
        let mut sampler = Sampler::default();
        let height = sampler.height(self.gap, x)?;
        cost.heights += sampler.cost.evaluations;
        Ok(Some(LowPoint { x, height, between: None, doubt: T::zero() }))
    }

    /// Where the loaded bodies would overlap outside the contacts, and the gap there, as far as
    /// heights of the gap before loading show it, by rising x; and whether they may overlap by no
    /// more than the series leave open.
    fn overlap_at(
        &self,
        fields: &[ExteriorField<T>],
        heights: impl Iterator<Item = LowPoint<T>>,
        cost: &mut Cost,
    ) -> Result<(Option<[T; 2]>, bool), ContactError<T>> {
        let (contacts, hull) = (self.contacts(), self.found.interval);
        let last = contacts.len() - 1;
        let mut sampler = Sampler::default();
        let (mut worst, mut is_hidden) = (None::<[T; 2]>, false);
        let total = |x: T| fields.iter().fold(T::zero(), |sum, field| sum + field.potential(x));
        let load = fields.iter().fold(T::zero(), |sum, field| sum + field.load());
        let doubt = fields.iter().fold(T::zero(), |sum, field| sum + field.doubt()) / self.kappa;
        // The edge from which the gap is followed to x, the height of the gap there, and what the
        // pressure takes off it.
        let mut from: Option<(usize, T, T)> = None;
        let mut next = 0;
        for LowPoint { x, height, between, doubt: hidden } in heights {
            while next <= last && contacts[next].right <= x {
                next += 1;
            }
            if next <= last && contacts[next].left <= x {
                continue;
            }
            let (contact, side) = match next.checked_sub(1) {
                None => (0, Side::Left),
                Some(before) => (before, Side::Right),
            };
            let (_, at_edge, taken) = match from.filter(|&(at, ..)| at == next) {
                Some(known) => known,
                None => {
                    let edge = contacts[contact][side];
                    let height = match panels::several(self.integrator) {
                        Some(several) => several.height(contact, side),
                        None => sampler.height(self.gap, self.gap.nearest(edge))?,
                    };
                    *from.insert((next, height, total(edge)))
                }
            };
            // From no place does the load act further away than from the far end of the contacts.
            let most = load * (x - hull.left).max(hull.right - x).ln();
            if height - hidden - at_edge >= (most - taken) / self.kappa {
                continue;
            }
            let pushed = (total(x) - taken) / self.kappa;
            let gap = |height: T| height - at_edge - pushed;
            let allowed = self.found.nothing() * (height - at_edge).abs()
                + T::of(64.0) * T::epsilon() * (height.abs() + at_edge.abs());
            if gap(height - hidden) >= -(allowed + doubt) {
                is_hidden |= gap(height - hidden) < -allowed;
                continue;
            }
            // The height may be an interpolated one, or a bound.
            let x = match between {
                Some([from, to]) => {
                    // Not in the contacts on either side.
                    let from = next.checked_sub(1).map_or(from, |i| from.max(contacts[i].right));
                    let to = contacts.get(next).map_or(to, |on| to.min(on.left));
                    let mut between = [from, to];
                    if gap(height + hidden) >= -(allowed + doubt) {
                        between = self.valley(&total, &mut sampler, between)?;
                    }
                    self.lowest_between(fields, &mut sampler, between)?
                }
                None => x,
            };
            let height = sampler.height(self.gap, x)?;
            let gap = height - at_edge - (total(x) - taken) / self.kappa;
            // Where the formulas are all rounding, heights do not go with the slopes on both
            // sides, and tell nothing.
            let aside = T::epsilon().sqrt() * hull.half_width();
            let beside = self.gap.nearest(x + aside);
            let rise = sampler.height(self.gap, beside)? - height;
            let slopes = sampler.slope_again(self.gap, beside) + sampler.slope(self.gap, x)?;
            let due = T::of(0.5) * slopes * (beside - x);
            let rounding = T::of(64.0) * T::epsilon() * (height.abs() + at_edge.abs());
            let is_sound = (rise - due).abs() <= T::of(0.1) * due.abs() + rounding;
            let noise = T::of(8.0) * (rise - due).abs();
            let is_open = gap >= -(allowed + doubt + noise) || !is_sound;
            is_hidden |= is_open && is_sound && gap < -(allowed + noise);
            if !is_open && worst.is_none_or(|[_, least]| gap < least) {
                worst = Some([x, gap]);
            }
        }
        cost.heights += sampler.cost.evaluations;
        Ok((worst, is_hidden))
    }
}
