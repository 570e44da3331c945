//! Capacity of the bodies: the last of their balanced contacts.
//!
//! For each half-width there is one balanced contact, whose load and largest pressure grow with the
//! half-width. The family ends where a limit reaches the end of a body. This last contact depends
//! on the bodies alone: it is found on panels of its own, whatever the control and the method.

use super::Contact;
use super::edges::{Conditions, Given};
use super::equations::Equations;
use crate::gap::Cost;
use crate::quadrature::{Engine, LoadCase, Panels};
use crate::search::{Bracket, Brent, try_find};
use crate::solution::largest_pressure;
use crate::{ContactError, Ends, Interval, Real, Side, SolveError};

/// Relative tolerance of the samples until the largest contact is bracketed: the whole of the
/// bodies may be hard to sample, and only the direction of the shift counts.
const ROUGH_TOLERANCE: f64 = 3e-2;

/// Least imbalance of a roughly sampled contact, as a share of its load, that makes its sign
/// certain.
const SURE_IMBALANCE: f64 = 0.1;

/// Factor by which contacts at the end become narrower until one is too narrow.
const NARROWING_FACTOR: f64 = 8.0;

/// Widest balanced contact.
#[derive(Clone, Copy)]
pub(super) struct Capacity<T> {
    pub half_width: T,
    /// End of the bodies that the contact reaches.
    pub end: T,
    pub load: T,
    /// Largest pressure; infinite at a corner, or where the slope of the gap jumps up.
    pub peak: T,
}

impl<T: Real> Capacity<T> {
    /// Returns the zero capacity of bodies that first touch at an end.
    pub fn nothing(end: T) -> Self {
        let zero = T::zero();
        Self { half_width: zero, end, load: zero, peak: zero }
    }

    /// Returns the error for a load or a width beyond the capacity.
    pub fn exceeded(&self, conditions: &Conditions<T>) -> ContactError<T> {
        match conditions.given {
            Given::HalfWidth(wanted) => self.too_wide(wanted),
            _ => self.too_short(conditions.load()),
        }
    }

    /// Returns the error for a load beyond the capacity.
    pub fn too_short(&self, load: T) -> ContactError<T> {
        let (Self { half_width, end, load: carried, peak }, kappa_is_default) = (*self, false);
        SolveError::DomainTooShort { end, carried, load, half_width, peak, kappa_is_default }.into()
    }

    /// Returns the error for a width that has no room on the bodies.
    pub fn too_wide(&self, wanted: T) -> ContactError<T> {
        let (Self { half_width, end, load, peak }, kappa_is_default) = (*self, false);
        SolveError::HalfWidthTooLarge { wanted, half_width, end, load, peak, kappa_is_default }
            .into()
    }

    /// Returns the error for a peak that takes more room than there is on the bodies.
    pub fn too_high(&self, wanted: T) -> ContactError<T> {
        let (Self { half_width, end, load, peak: found }, kappa_is_default) = (*self, false);
        SolveError::PeakTooHigh { wanted, half_width, found, end, load, kappa_is_default }.into()
    }
}

/// Returns the balanced contact that reaches one of the ends, as an interval and a capacity; `None`
/// if there is none, as for bodies that do not open towards their ends.
pub(super) fn capacity<T: Real>(
    contact: &Contact<'_, T>,
    conditions: &Conditions<T>,
    ends: Ends<T>,
    cost: &mut Cost,
) -> Option<(Interval<T>, Capacity<T>)> {
    let Ends { left, right } = ends;
    let mut full = Engine::new(&Panels::FULL).ok()?;
    let mut rough = Engine::new(&Panels { tolerance: ROUGH_TOLERANCE }).ok()?;
    let fixed = conditions.limits();
    // Only the balance counts.
    let equations = Equations::Strength(conditions.under(T::zero()));
    let mut pinned = Pinned { contact, equations, full: &mut full, rough: &mut rough };
    let (left, right) = (fixed.left.unwrap_or(left), fixed.right.unwrap_or(right));
    let found = pinned.largest_contact(Interval { left, right });
    let pulled = conditions.edges.are_adhesive();
    let capacity = found.and_then(|(on, side)| {
        if on.half_width().is_zero() {
            return (!pulled).then_some((on, Capacity::nothing(ends[side])));
        }
        let m = full.moments(&contact.gap, on).ok()?;
        let load = conditions.balance(on, &m)?;
        full.prepare(&contact.gap, on).ok()?;
        let free = conditions.edges.map(|edge| edge.is_free());
        let load_case = LoadCase { kappa: conditions.kappa, load, free };
        let peak = if fixed == Ends::both(None) {
            let (gap, cost) = (&contact.gap, &mut Cost::default());
            largest_pressure(&full, gap, &load_case, (0, on), cost).ok()?.1.value
        } else {
            T::one() / T::zero()
        };
        Some((on, Capacity { half_width: on.half_width(), end: ends[side], load, peak }))
    });
    *cost += full.cost() + rough.cost();
    // Without adhesion, a contact in total tension does not count: the bodies touch next to a
    // hollow.
    capacity.filter(|(_, found)| found.load.is_finite() && (pulled || found.load >= T::zero()))
}

/// Search among contacts that reach an end.
struct Pinned<'s, T: Real> {
    contact: &'s Contact<'s, T>,
    equations: Equations<T>,
    full: &'s mut Engine<T>,
    /// Integrator that samples to within [`ROUGH_TOLERANCE`].
    rough: &'s mut Engine<T>,
}

impl<T: Real> Pinned<'_, T> {
    /// Returns the balanced contact, and the side of the end that it reaches; with no width if it
    /// would be narrower than x is rounded.
    fn largest_contact(&mut self, whole: Interval<T>) -> Option<(Interval<T>, Side)> {
        let Interval { left, right } = whole;
        if let Some(side) = self.equations.limits().only_free() {
            return Some((whole, side));
        }
        let at_whole = self.rough_shift(whole)?;
        let side = if at_whole > T::zero() { Side::Right } else { Side::Left };
        if at_whole.is_zero() {
            return Some((whole, side));
        }
        // One limit stays at the end towards which the whole interval would shift; the other moves
        // in.
        let on = |x: T| match side {
            Side::Left => Interval { left, right: x },
            Side::Right => Interval { left: x, right },
        };
        let (mut wide, mut at_wide, mut width) = (whole[side.other()], at_whole, right - left);
        let end = whole[side];
        let rounding = T::epsilon() * (right - left).max(end.abs());
        while width > T::of(NARROWING_FACTOR) * rounding {
            width /= T::of(NARROWING_FACTOR);
            let narrow = match side {
                Side::Left => left + width,
                Side::Right => right - width,
            };
            let at_narrow = self.rough_shift(on(narrow))?;
            if (at_narrow > T::zero()) != (at_wide > T::zero()) {
                let [one, other] = [(narrow, at_narrow), (wide, at_wide)];
                let [lo, hi] = if side == Side::Left { [one, other] } else { [other, one] };
                let bracket = Bracket::new(lo.0, hi.0).values(lo.1, hi.1);
                let shift = |x| self.shift(on(x)).ok_or(());
                let root = try_find(&Brent::DEFAULT, shift, &bracket).ok()?;
                return Some((on(root.x), side));
            }
            (wide, at_wide) = (narrow, at_narrow);
        }
        // The bodies touch first at this end.
        Some((Interval { left: end, right: end }, side))
    }

    /// Returns a shift that is positive if the contact must move to the right. If rough samples
    /// make its sign certain, only the sign is exact.
    fn rough_shift(&mut self, on: Interval<T>) -> Option<T> {
        let Self { contact, equations, rough, .. } = self;
        let rough = equations.residual(&contact.gap, on, rough, &mut Cost::default()).ok();
        let rough = rough.filter(|rough| {
            rough.shift().abs() > (T::of(SURE_IMBALANCE) + T::of(16.0) * rough.error) * rough.size
        });
        let shift = rough.map(|rough| rough.shift()).or_else(|| self.shift(on));
        // NaN has no sign; next to an upright end an infinite shift has one.
        shift.filter(|shift| shift.partial_cmp(shift).is_some())
    }

    /// Returns the shift from full samples.
    fn shift(&mut self, on: Interval<T>) -> Option<T> {
        let Self { contact, equations, full, .. } = self;
        Some(equations.residual(&contact.gap, on, full, &mut Cost::default()).ok()?.shift())
    }
}
