//! The flank of a gear tooth.

use super::{Convexity, CurvePoint, ParametricProfile, ProfileError, finite, interval};
use crate::Real;
use crate::numerics::special_functions::sin_minus_cos;

/// Involute of a circle, with the origin of coordinates at one of its points.
///
/// A taut string that unrolls from the base circle, of radius r, draws it. The angle t rolled off
/// gives the point on the curve: there the string has the length r t, which is the radius of
/// curvature, and is normal to the curve. The origin is at a point t₀ of the flank, `X` along the
/// tangent there, and the centre of the base circle at `[-r, r t₀]`. With `k = t - t₀`
/// ```text
/// X = r (cos k + t sin k - 1),   Y = r (sin k - t cos k + t₀)
/// ```
///
/// Two flanks that mesh touch at a point of the line tangent to both base circles. At each instant
/// they are two involutes with one origin, whose roll angles add up to the length of that line,
/// `r₁ t₁ + r₂ t₂`. The lower one is turned by half a turn:
/// [`Placement::mirrored`](super::Placement::mirrored) and [`flipped`](super::Placement::flipped).
/// (Example `gear_mesh`.)
///
/// ```
/// use linecontact::profile::Involute;
/// use linecontact::{Contact, Control, Flat};
///
/// // Where 0.4 rad have been rolled off a circle of 50 mm the radius of curvature is 20 mm.
/// let flank = Involute::new(50.0, 0.4, [0.0, 0.8])?;
/// let contact = Contact::new(&Flat, &flank)?;
/// let solution = contact.solve(Control::HalfWidth(0.1))?;
/// let hertz = 0.1 * 0.1 / (2.0 * 20.0);
/// assert!((solution.load() / hertz - 1.0f64).abs() < 1e-4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Involute<T> {
    base_radius: T,
    origin: T,
    angles: [T; 2],
}

impl<T: Real> Involute<T> {
    /// Creates an involute with the radius r of the base circle and the angle t₀ rolled off at the
    /// origin, between two angles t in radians.
    ///
    /// # Errors
    /// [`ProfileError::Parameter`] unless r is positive, t₀ and the angles are not negative, all
    /// finite, and the angles are within π/2 of t₀, beyond which `X` would turn back;
    /// [`ProfileError::Domain`].
    pub fn new(base_radius: T, origin: T, angles: [T; 2]) -> Result<Self, ProfileError<T>> {
        finite("the base radius", base_radius, base_radius > T::zero(), "positive and finite")?;
        finite("the angle at the origin", origin, origin >= T::zero(), "finite and not negative")?;
        for angle in interval(angles)? {
            let rolled = angle >= T::zero() && (angle - origin).abs() <= T::frac_pi_2();
            let must = "not negative and within a quarter of a turn of that at the origin";
            finite("a roll angle", angle, rolled, must)?;
        }
        Ok(Self { base_radius, origin, angles })
    }
}

impl<T: Real> ParametricProfile<T> for Involute<T> {
    fn domain(&self) -> [T; 2] {
        self.angles.map(|angle| angle - self.origin)
    }

    fn convexity(&self) -> Convexity {
        Convexity::Convex
    }

    fn at(&self, k: T) -> CurvePoint<T> {
        let (sin, cos) = k.sin_cos();
        let rolled = self.origin + k;
        // 1 - cos k and sin k - k cos k, whose leading terms cancel.
        let versine = sin * (sin / (T::one() + cos));
        let bulge = if k < T::zero() { -sin_minus_cos(-k) } else { sin_minus_cos(k) };
        let [r, arm] = [self.base_radius, self.base_radius * rolled];
        CurvePoint {
            x: r * (rolled * sin - versine),
            y: r * (self.origin * versine + bulge),
            dx: arm * cos,
            dy: arm * sin,
        }
    }
}
