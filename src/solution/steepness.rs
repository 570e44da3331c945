//! Steepness of the surfaces, which limits the half-plane model.

use super::Solution;
use crate::gap::Sampler;
use crate::{Body, ContactError, Ends, Fallible, Interval, Real, Side};
use std::f64::consts::PI;

/// Slope of a surface above which the half-plane is a poor model of a body. Its error is of the
/// order of the square of the slope, a tenth at this one (Johnson, *Contact Mechanics*, 1985, §4.1,
/// asks for contacts that are small beside the radii of the bodies).
pub const STEEPEST_HALF_PLANE: f64 = 0.3;

/// Number of points of each contact at which slopes are taken.
const SLOPE_POINTS: usize = 17;

/// Share of the width of a contact beside its limits in which slopes tell nothing: a body may bear
/// there on the edge of a wall or a chamfer.
const EDGE: f64 = 1e-3;

/// Least angle of bodies that conform: 9.1°, at which Hertz's peak in a hole is 1 % too low.
const LEAST_CONFORMING: f64 = 9.1 * PI / 180.0;

/// Conformity of two bodies that touch like a pin and its hole, and what half-planes in their place
/// cost.
///
/// The shares are of the pressure of a [`PinInHole`](crate::reference::PinInHole) of like materials
/// under the same load, in the middle, where it is largest. With `v = sin²(ε/2)` they are
///
/// ```text
/// v (5/6 + 6/5 v - v²) of circles,        v (19/12 + 2/5 v) of parabolas in their place
/// ```
///
/// The first terms are those of the series of the closed forms; the others bring both to within a
/// hundredth up to 60°. (From 38° on half-planes have larger pressures beside the middle.)
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Conformity<T> {
    /// Angle ε that the surfaces have at the limits, the mean of both bodies: radians.
    pub angle: T,
    /// Share by which the pressure in the middle is too low.
    pub too_low: T,
    /// Share by which it is too low if parabolas stand for circles, as in Hertz's formulas.
    pub parabolas_too_low: T,
}

impl<T: Real> Conformity<T> {
    fn of(angle: T) -> Self {
        let v = (T::of(0.5) * angle).sin().powi(2);
        let too_low = v * (T::of(5.0 / 6.0) + v * (T::of(1.2) - v));
        Self { angle, too_low, parabolas_too_low: v * (T::of(19.0 / 12.0) + T::of(0.4) * v) }
    }
}

/// Returns an interval less a share of its width at either end.
fn but<T: Real>(on: Interval<T>, edge: T) -> Interval<T> {
    let less = edge * (on.right - on.left);
    Interval { left: on.left + less, right: on.right - less }
}

/// Tells whether a slope exceeds that of half-planes.
pub(crate) fn is_steep<T: Real>(slope: T) -> bool {
    slope.abs() > T::of(STEEPEST_HALF_PLANE)
}

impl<T: Real> Solution<'_, T> {
    /// Tells whether the slope of the gap next to the limits of the contacts, or the
    /// [steepest slope](Self::steepest_slope) of either surface, exceeds [`STEEPEST_HALF_PLANE`]:
    /// half-planes may then be a poor model of the bodies. A thousandth of each contact is left out
    /// at either limit, where the bodies may bear on the edge of a wall. Where a body cannot be
    /// sampled the gap alone decides.
    #[must_use]
    pub fn is_steep(&self) -> bool {
        self.has_steep_limits() || self.steepest_but(T::of(EDGE)).is_ok_and(is_steep)
    }

    /// Tells whether the slope of the gap next to the limits exceeds that of half-planes. (Bent
    /// bodies have that of a soft layer besides their own.)
    pub(crate) fn has_steep_limits(&self) -> bool {
        if self.gap.bend().is_some() {
            return false;
        }
        let limits = self.intervals().iter().map(|&on| but(on, T::of(EDGE))).enumerate();
        let solved = self.solved();
        let slopes =
            |(i, on): (usize, Interval<T>)| [on.left, on.right].map(|x| solved.sampled_slope(i, x));
        limits.flat_map(slopes).any(|slope| slope.is_some_and(|(slope, _)| is_steep(slope)))
    }

    /// Returns how the bodies conform, if they do, so that half-planes give too low a peak: at both
    /// limits of one contact, both surfaces rise from it, or both fall, and each turns by 9.1° or
    /// more to either side. It is known of half-planes between free edges. Where a body cannot be
    /// sampled the answer is `None`, too.
    ///
    /// ```
    /// use linecontact::profile::Ellipse;
    /// use linecontact::{Contact, Control};
    ///
    /// let [pin, hole] = [10.0f64, 10.02].map(|radius| Ellipse::circle(radius, [-1.5, 1.5]));
    /// let (pin, hole) = (pin?, hole?);
    /// let contact = Contact::new(&hole, &pin)?.contact_modulus(115e3);
    /// let conformity = contact.solve(Control::Load(240.0))?.conformity().unwrap();
    /// assert!((conformity.angle.to_degrees() - 20.0).abs() < 0.5);
    /// assert!((conformity.too_low - 0.026).abs() < 0.001);
    /// # Ok::<(), linecontact::ContactError<f64>>(())
    /// ```
    #[must_use]
    pub fn conformity(&self) -> Option<Conformity<T>> {
        if self.gap.bend().is_some() { None } else { self.conforming().map(Conformity::of) }
    }

    /// Returns the angle at the limits of bodies that conform, on half-planes or with layers.
    pub(super) fn conforming(&self) -> Option<T> {
        let (free, is_one) = (self.found.free, self.intervals().len() == 1);
        if !(is_one && free.left && free.right) {
            return None;
        }
        let (hull, mut sampler) = (self.hull(), Sampler::default());
        let mut slope =
            |body, side: Side| sampler.body_slope(&self.gap, body, hull[side], side.other()).ok();
        // Outward: rising, if positive.
        let mut angles = |body| {
            let [left, right] = [slope(body, Side::Left)?, slope(body, Side::Right)?];
            Some(Ends { left: -left.atan(), right: right.atan() })
        };
        let [mut lower, mut upper] = [angles(Body::Lower)?, angles(Body::Upper)?];
        if lower.left < T::zero() {
            [lower, upper] = [lower, upper].map(|angles| angles.map(|angle| -angle));
        }
        let turn = |on: Ends<T>| T::of(0.5) * (on.left + on.right);
        let is_hollow = [lower, upper].iter().all(|on| on.left > T::zero() && on.right > T::zero());
        let turns = [turn(lower), turn(upper)];
        let conform = is_hollow && turns[0].min(turns[1]) >= T::of(LEAST_CONFORMING);
        conform.then(|| T::of(0.5) * (turns[0] + turns[1]))
    }

    /// Returns the largest slope `|f'|` of either surface within the contacts, before loading: a
    /// measure of how far the bodies are from half-planes. Above [`STEEPEST_HALF_PLANE`] the
    /// solution is as exact as ever, but its equations describe the bodies less well. So large a
    /// slope often comes from a wrong unit, or a missing contact modulus.
    ///
    /// It inverts both curves at 17 points of each contact, and at the breakpoints.
    ///
    /// ```
    /// use linecontact::profile::Ellipse;
    /// use linecontact::{Contact, Control, Flat, STEEPEST_HALF_PLANE};
    ///
    /// let roller = Ellipse::circle(1.0, [-1.5, 1.5])?;
    /// let solution = Contact::new(&Flat, &roller)?.solve(Control::HalfWidth(0.5))?;
    /// let steepest = solution.steepest_slope()?;
    /// assert!((steepest - 0.5 / 0.75f64.sqrt()).abs() < 1e-14 && steepest > STEEPEST_HALF_PLANE);
    /// # Ok::<(), linecontact::ContactError<f64>>(())
    /// ```
    ///
    /// # Errors
    /// Those of sampling the bodies.
    pub fn steepest_slope(&self) -> Result<T, ContactError<T>> {
        self.steepest_but(T::zero())
    }

    /// Returns the steepest slope but for a share of each contact at either limit.
    fn steepest_but(&self, edge: T) -> Fallible<T, T> {
        let (gap, mut sampler) = (&self.gap, Sampler::default());
        let mut steepest = T::zero();
        for on in self.intervals().iter().map(|&on| but(on, edge)) {
            let angle = |i: usize| T::pi() * T::count(i) / T::count(SLOPE_POINTS - 1);
            let inside = (1..SLOPE_POINTS - 1).map(|i| (on.at_angle(angle(i)), Side::Left));
            let limits = [(on.left, Side::Right), (on.right, Side::Left)];
            let breakpoints = gap.breakpoints(on).flat_map(|x| [(x, Side::Left), (x, Side::Right)]);
            for (x, side) in inside.chain(limits).chain(breakpoints) {
                for body in [Body::Lower, Body::Upper] {
                    steepest = steepest.max(sampler.body_slope(gap, body, x, side)?.abs());
                }
            }
        }
        Ok(steepest)
    }
}
