//! Dips of the loaded gap in which bodies overlap, and the contacts that belong there.

use super::outside::MAX_HALVES;
use super::{MAX_POINTS, SignoriniCheck};
use crate::gap::{Cost, Sampler};
use crate::solution::{CLOSED_WIDTH, Solved};
use crate::solve::exterior_field::ExteriorFields;
use crate::{Fallible, Interval, Real, Side};
use std::cell::Cell;

/// Lowest place of a dip of the loaded gap in which bodies overlap, and the gap there.
#[derive(Clone, Copy)]
pub(in crate::solve) struct Dip<T> {
    pub x: T,
    pub gap: T,
    /// Shift of the contact that belongs there to the left, as a share of its half-width: as of a
    /// wedge's at a corner, mostly on its flatter side.
    pub lean: T,
    /// Largest half-width of that contact; infinite if it is not known.
    pub width: T,
}

/// Dips of the loaded gap in which bodies overlap, by rising x.
#[derive(Clone)]
pub(in crate::solve) struct Overlaps<T> {
    pub dips: Vec<Dip<T>>,
    /// Spans outside the contacts that a heavier load has closed.
    pub closed_before: Vec<Interval<T>>,
    /// Flag: at some place neither the series of the pressures nor the pressures themselves tell
    /// whether the bodies overlap.
    pub is_untold: bool,
}

impl<T: Real> Overlaps<T> {
    pub fn new() -> Self {
        Self { dips: Vec::new(), closed_before: Vec::new(), is_untold: false }
    }

    /// Forgets the dips.
    pub fn clear(&mut self) {
        self.dips.clear();
        self.is_untold = false;
    }

    /// Returns the deepest dip.
    pub fn worst(&self) -> Option<Dip<T>> {
        let dips = self.dips.iter().copied();
        dips.reduce(|worst, dip| if dip.gap < worst.gap { dip } else { worst })
    }
}

impl<T: Real> SignoriniCheck<'_, T> {
    /// Describes a dip by its place and the gap there. At a corner where the gap falls and rises,
    /// the contact is a tenth as wide as the overlap over the change of the slope, or wider; `None`
    /// if x is too coarse to tell it.
    pub(super) fn dip(
        &self,
        fields: &ExteriorFields<T>,
        [x, gap]: [T; 2],
        sampler: &mut Sampler<T>,
    ) -> Fallible<T, Option<Dip<T>>> {
        let [before, after] = Side::BOTH.map(|side| sampler.slope_from(self.gap, x, side));
        let (before, after, rate) = (before?, after?, self.rate(fields, x));
        let share = (rate - before) / (after - before);
        let is_corner = share > T::zero() && share < T::one();
        let lean = if is_corner { (T::pi() * share).cos() } else { T::zero() };
        let width = if is_corner { -gap / (after - before) } else { T::one() / T::zero() };
        let least = T::of(10.0 * CLOSED_WIDTH) * T::epsilon() * x.abs();
        // A gap that is no number is an overlap.
        let is_untold = width <= least;
        Ok((!is_untold).then_some(Dip { x, gap, lean, width }))
    }

    /// Finds the dips among the lowest places of some spans, or of spans without width the only
    /// ones, by the pressures themselves. (At an upright end a curve tells no height.)
    pub(super) fn overlap_by_pressures(
        &self,
        fields: &ExteriorFields<T>,
        spans: &[[T; 2]],
        Overlaps { dips, is_untold, .. }: &mut Overlaps<T>,
        cost: &mut Cost,
    ) -> Fallible<T, ()> {
        let &Self { gap, engine: integrator, kappa, found, .. } = self;
        let loaded = Solved { gap, integrator, kappa, found };
        let is_unknown = Cell::new(false);
        let slope = |x| {
            let slope = loaded.gap_slope(x).unwrap_or(T::of(f64::NAN));
            is_unknown.set(is_unknown.get() || slope.partial_cmp(&slope).is_none());
            slope
        };
        for &[from, to] in spans {
            // Behind a hollow corner the place may be very close to it.
            let halves = 3 * MAX_HALVES;
            let x = if from < to { Self::lowest_between(slope, halves, [from, to]) } else { from };
            let mut sampler = Sampler::default();
            if sampler.height(gap, x).is_err() {
                continue;
            }
            let allowed = self.allowed(sampler.highest, T::zero());
            // Here, there, and at the limit.
            cost.heights += 3 * sampler.cost.evaluations;
            match loaded.gap_up_to(MAX_POINTS, x) {
                Ok(open) if open < -allowed => {
                    dips.extend(self.dip(fields, [x, open], &mut sampler)?);
                }
                Ok(open) if open >= -allowed => {}
                // The next one would take as long, and tell as little.
                _ => is_unknown.set(true),
            }
            if is_unknown.get() {
                *is_untold = true;
                break;
            }
        }
        Ok(())
    }
}
