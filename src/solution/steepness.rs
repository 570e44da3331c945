//! How steep the surfaces are, on which the half-planes of the equations depend.

use super::Solution;
use crate::gap::Sampler;
use crate::{Body, ContactError, Real, Side};

/// The slope of a surface above which a body is no longer much like a half-plane. What the half-plane leaves out
/// is of the order of the square of the slope, a tenth at this one (Johnson, *Contact Mechanics*, 1985, §4.1, asks
/// for contacts that are small beside the radii of the bodies).
pub const STEEPEST_HALF_PLANE: f64 = 0.3;

/// Points of each contact at which slopes are taken.
const POINTS: usize = 17;

impl<T: Real> Solution<'_, T> {
    /// Whether the slope of the gap, by the samples at hand and at the limits of the contacts, is more than
    /// [`STEEPEST_HALF_PLANE`]: then it is doubtful whether the bodies are much like half-planes. It takes no
    /// evaluation, and does not see two surfaces that are steep alike: [`steepest_slope`](Self::steepest_slope) does.
    #[must_use]
    pub fn is_steep(&self) -> bool {
        let limits = self.intervals().iter().map(|on| [on.left, on.right]).enumerate();
        let solved = self.solved();
        let steep = |slope: T| slope.abs() > T::of(STEEPEST_HALF_PLANE);
        let mut slopes = limits.flat_map(|(i, limits)| limits.map(|x| solved.sampled_slope(i, x)));
        slopes.any(|slope| slope.is_some_and(steep))
    }

    /// The largest slope `|f'|` of either surface within the contacts, before loading: how far the bodies are from
    /// the half-planes of the equations. Above [`STEEPEST_HALF_PLANE`] the solution is as exact as ever, but its
    /// equations describe the bodies less well; so large a slope is often a unit that is wrong, or a contact modulus
    /// that is missing.
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
        let (gap, mut sampler) = (&self.gap, Sampler::default());
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
