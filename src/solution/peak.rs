//! The largest pressure.

use super::{ContactState, Solution};
use crate::gap::{Cost, Gap};
use crate::quadrature::{Estimate, Integrator, LoadCase, panels};
use crate::{ContactError, Interval, Real, Side};

/// Points at which a largest pressure is first looked for.
const POINTS: usize = 64;

/// The most of them.
const MOST_POINTS: usize = 1 << 14;

/// A largest pressure.
///
/// ```
/// use linecontact::profile::Parabola;
/// use linecontact::{Contact, Control, Flat};
///
/// let body = Parabola::new(1.0f64, [-1.0, 1.0])?;
/// let solution = Contact::new(&Flat, &body)?.solve(Control::Load(0.02))?;
/// let peak = solution.peak()?;
/// assert!(peak.x.abs() < 1e-6);
/// assert!((peak.pressure / (0.04 / (0.2 * std::f64::consts::PI)) - 1.0).abs() < 1e-14); // 2 F/(π L)
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Peak<T> {
    /// Where it is.
    pub x: T,
    /// How large it is.
    pub pressure: T,
}

impl<T: Real> Solution<'_, T> {
    /// The largest pressure (a pressure) and its place: the largest on a grid in each contact, of 64 points or twice
    /// as many as it took samples, and at the breakpoints, refined. The pressure is flat there: its value has all digits, its place half of them.
    ///
    /// Where the pressure of an edge goes to minus infinity, as at an adhesive one, the peak is that
    /// inside.
    ///
    /// It takes about a hundred pressures for each contact, which cost evaluations with [`Midpoint`](crate::Midpoint)
    /// only; they are not in [`cost`](Self::cost).
    ///
    /// # Errors
    /// [`ContactError::Singular`] where the pressure is infinite: at a fixed edge, or where the
    /// slope of the gap jumps up ([`contacts`](Self::contacts) has the peaks of the others);
    /// [`ContactError::Unresolved`] from a [`Midpoint`](crate::Midpoint) of fewer than four segments; those of
    /// sampling the gap.
    pub fn peak(&self) -> Result<Peak<T>, ContactError<T>> {
        self.integrator.complete(&self.gap)?;
        let last = self.intervals().len() - 1;
        let mut best = self.peak_in(last)?;
        for i in (0..last).rev() {
            let peak = self.peak_in(i)?;
            if peak.pressure >= best.pressure {
                best = peak;
            }
        }
        Ok(best)
    }

    /// That of one contact, by its number.
    pub(super) fn peak_in(&self, contact: usize) -> Result<Peak<T>, ContactError<T>> {
        let contacts = self.intervals();
        let (on, last) = (contacts[contact], contacts.len() - 1);
        let (x, Estimate { value: pressure, error }) = largest_pressure(
            &**self.integrator,
            &self.gap,
            &self.load_case(),
            (contact, on),
            &mut Cost::default(),
        )?;
        if !pressure.is_finite() {
            return Err(ContactError::Singular { x });
        }
        if !error.is_finite() {
            return Err(ContactError::Unresolved { x, pressure, error });
        }
        let ContactState { strengths, free, .. } = self.found;
        let rounding = T::of(64.0) * T::epsilon() * pressure.abs();
        // Where both edges are at fault it is the right one that is named.
        for (side, outermost) in [(Side::Right, contact == last), (Side::Left, contact == 0)] {
            if outermost && !free[side] && strengths[side] > rounding {
                return Err(ContactError::Singular { x: on[side] });
            }
        }
        Ok(Peak { x, pressure })
    }
}

/// Where the pressure of a prepared contact is largest, and how large, adding to `cost` what it takes.
pub(crate) fn largest_pressure<T: Real>(
    integrator: &dyn Integrator<T>,
    gap: &Gap<'_, T>,
    load_case: &LoadCase<T>,
    (contact, on): (usize, Interval<T>),
    cost: &mut Cost,
) -> Result<(T, Estimate<T>), ContactError<T>> {
    // Waves that took many samples have many maxima.
    let mut samples = 0;
    panels::nodes(integrator, contact, &mut |_| {
        samples += 1;
        Ok(())
    })?;
    let points = (2 * samples).clamp(POINTS, MOST_POINTS).next_multiple_of(POINTS);
    let place = |i: usize| on.at_angle(T::pi() * (T::count(i) + T::of(0.5)) / T::count(points));
    let (mut best, mut largest) = (0, None);
    for first in (0..points).step_by(POINTS) {
        let x: [T; POINTS] = std::array::from_fn(|i| place(first + i));
        let mut pressures = [T::zero(); POINTS];
        integrator.pressures(gap, load_case, &x, &mut pressures, cost)?;
        for (i, pressure) in pressures.into_iter().enumerate() {
            if largest.is_none_or(|largest| pressure > largest) {
                (best, largest) = (first + i, Some(pressure));
            }
        }
    }
    let mut top = (place(best), integrator.estimate(gap, load_case, place(best), cost)?);
    if top.1.value.is_finite() && !top.1.is_resolved() {
        // Next to an edge a rule of few segments has no digit, and any value.
        for i in 0..points {
            let there = integrator.estimate(gap, load_case, place(i), cost)?;
            let larger = there.value > top.1.value || !top.1.is_resolved();
            if there.is_resolved() && larger {
                (best, top) = (i, (place(i), there));
            }
        }
    }
    let mut lo = if best + 1 < points { place(best + 1) } else { on.left };
    let mut hi = if best == 0 { on.right } else { place(best - 1) };
    let mut at = |x: T| -> Result<T, ContactError<T>> {
        let pressure = integrator.estimate(gap, load_case, x, cost)?;
        if pressure.value > top.1.value && (pressure.is_resolved() || !top.1.is_resolved()) {
            top = (x, pressure);
        }
        Ok(pressure.value)
    };
    // Breakpoints are where a pressure is not smooth, and may be infinite.
    for breakpoint in gap.telling_breakpoints(on, T::one(), 4 * POINTS) {
        let pressure = at(breakpoint)?;
        if !pressure.is_finite() && pressure > T::zero() {
            return Ok((breakpoint, Estimate { value: pressure, error: T::zero() }));
        }
    }
    // Golden section: the pressure is flat at its peak, so half the digits of x are enough.
    let golden = T::of(0.618_033_988_749_894_9);
    let (mut left, mut right) = (hi - golden * (hi - lo), lo + golden * (hi - lo));
    let (mut p_left, mut p_right) = (at(left)?, at(right)?);
    let resolution = T::epsilon().sqrt() * (hi - lo);
    while hi - lo > resolution && left < right {
        if p_left < p_right {
            (lo, left, p_left) = (left, right, p_right);
            right = lo + golden * (hi - lo);
            p_right = at(right)?;
        } else {
            (hi, right, p_right) = (right, left, p_left);
            left = hi - golden * (hi - lo);
            p_left = at(left)?;
        }
    }
    // Half of them are not enough for derivatives: a step of Newton's rule takes the place where it goes.
    for _ in 0..T::DERIVATIVE_ORDER {
        let (x, here) = top;
        let beside = |from: T, breakpoint: T| from.min((x - breakpoint).abs());
        let room = gap.breakpoints(on).fold((x - on.left).min(on.right - x), beside);
        let step = T::epsilon().sqrt().sqrt() * room;
        let mut pressure = |x: T| integrator.estimate(gap, load_case, x, cost);
        let [before, after] = [pressure(x - step)?.value, pressure(x + step)?.value];
        let move_on =
            T::of(0.5) * step * (after - before) / (here.value + here.value - before - after);
        if move_on.abs() < step {
            top = (x + move_on, pressure(x + move_on)?);
        }
    }
    Ok(top)
}
