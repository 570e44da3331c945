//! Steepness of the surfaces, which limits the half-plane model.

use super::Solution;
use crate::gap::Sampler;
use crate::{Body, ContactError, Real, Side};

/// Slope of a surface above which the half-plane is a poor model of a body. Its error is of the
/// order of the square of the slope, a tenth at this one (Johnson, *Contact Mechanics*, 1985, §4.1,
/// asks for contacts that are small beside the radii of the bodies).
pub const STEEPEST_HALF_PLANE: f64 = 0.3;

/// Number of points of each contact at which slopes are taken.
const POINTS: usize = 17;

impl<T: Real> Solution<'_, T> {
    /// Tells whether the slope of the gap at the limits of the contacts, or the
    /// [steepest slope](Self::steepest_slope) of either surface, exceeds [`STEEPEST_HALF_PLANE`]:
    /// half-planes may then be a poor model of the bodies. Where a body cannot be sampled the gap
    /// alone decides.
    #[must_use]
    pub fn is_steep(&self) -> bool {
        let limits = self.intervals().iter().map(|on| [on.left, on.right]).enumerate();
        let solved = self.solved();
        let steep = |slope: T| slope.abs() > T::of(STEEPEST_HALF_PLANE);
        let mut slopes = limits.flat_map(|(i, limits)| limits.map(|x| solved.sampled_slope(i, x)));
        slopes.any(|slope| slope.is_some_and(|(slope, _)| steep(slope)))
            || self.steepest_slope().is_ok_and(steep)
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
        let (gap, mut sampler) = (self.gap.before_bend(), Sampler::default());
        let mut steepest = T::zero();
        for &on in self.intervals() {
            let angle = |i: usize| T::pi() * T::count(i) / T::count(POINTS - 1);
            let inside = (1..POINTS - 1).map(|i| (on.at_angle(angle(i)), Side::Left));
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
