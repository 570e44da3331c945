//! Dips of the loaded gap in which bodies overlap, and the contacts that belong there.

use super::SignoriniCheck;
use crate::gap::{Cost, Sampler};
use crate::solution::{CLOSED_WIDTH, Solved};
use crate::solve::exterior_field::ExteriorFields;
use crate::{Fallible, Interval, Real, Side};

/// Halvings of a span in search of its lowest place behind a hollow corner, however close to it.
const HALVES: usize = 24;

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
}

impl<T: Real> Overlaps<T> {
    pub fn new() -> Self {
        Self { dips: Vec::new(), closed_before: Vec::new() }
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

    /// Returns the lowest place of a span, or the only one, with the gap there by the pressures
    /// themselves, if it is known and the bodies overlap. (At an upright end a curve tells no
    /// height.)
    pub(super) fn overlap_by_pressures(
        &self,
        fields: &ExteriorFields<T>,
        [from, to]: [T; 2],
        cost: &mut Cost,
    ) -> Option<Dip<T>> {
        let &Self { gap, engine: integrator, kappa, found, .. } = self;
        let loaded = Solved { gap, integrator, kappa, found };
        let slope = |x| loaded.gap_slope(x).unwrap_or(T::of(f64::NAN));
        let x = if from < to { Self::lowest_between(slope, HALVES, [from, to]) } else { from };
        let mut sampler = Sampler::default();
        sampler.height(gap, x).ok()?;
        let allowed = self.allowed(sampler.highest, T::zero());
        let open = loaded.gap_at(x).ok()?;
        // Here, there, and at the limit.
        cost.heights += 3 * sampler.cost.evaluations;
        if open < -allowed { self.dip(fields, [x, open], &mut sampler).ok()? } else { None }
    }
}
