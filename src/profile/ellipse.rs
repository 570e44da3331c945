//! Arcs of ellipses and circles.

use super::{Convexity, CurvePoint, ParametricProfile, ProfileError, finite, interval};
use crate::Real;

/// Arc of an ellipse or a circle, `X = A sin k`, `Y = B (1 - cos k)`, by the angle k from its
/// lowest point, which lies at the origin.
///
/// B is positive for an upper body that bulges, or a lower one that is hollow, and negative for the
/// reverse. The height is computed as `sin² k/(1 + cos k)`, so that it keeps its digits next to the
/// origin. The slope is exact up to the ends at ±π/2, where it is infinite.
///
/// ```
/// use linecontact::profile::Ellipse;
/// use linecontact::{Contact, Control};
///
/// // A roller of 10 mm radius in a groove of 40 mm, up to 80° either way.
/// let (roller, groove) = (Ellipse::circle(10.0, [-1.4, 1.4])?, Ellipse::circle(40.0, [-1.4, 1.4])?);
/// let contact = Contact::new(&groove, &roller)?.contact_modulus(115e3);
/// let solution = contact.solve(Control::Load(500.0))?;
/// // Hertz, with 1/R = 1/10 - 1/40.
/// let hertz = (4.0 * 500.0 * (1.0 / (0.1 - 0.025)) / (std::f64::consts::PI * 115e3)).sqrt();
/// assert!((solution.a() / hertz - 1.0).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Ellipse<T> {
    along: T,
    across: T,
    angles: [T; 2],
}

impl<T: Real> Ellipse<T> {
    /// Creates an arc with the semi-axes A, along the contact, and B, across it, between two angles
    /// in radians.
    ///
    /// # Errors
    /// [`ProfileError::Parameter`] unless A is positive and B is not zero, both finite, and the
    /// angles are within ±π/2; [`ProfileError::Domain`].
    pub fn new(along: T, across: T, angles: [T; 2]) -> Result<Self, ProfileError<T>> {
        finite("the semi-axis along the contact", along, along > T::zero(), "positive and finite")?;
        finite("the semi-axis across it", across, !across.is_zero(), "finite and not zero")?;
        for angle in interval(angles)? {
            let within = angle.abs() <= T::frac_pi_2();
            finite("an angle", angle, within, "in radians, from -π/2 to π/2")?;
        }
        Ok(Self { along, across, angles })
    }

    /// Creates an arc of a circle with the radius R, negative where it bulges upwards, between two
    /// angles.
    ///
    /// # Errors
    /// As [`new`](Self::new).
    pub fn circle(radius: T, angles: [T; 2]) -> Result<Self, ProfileError<T>> {
        Self::new(radius.abs(), radius, angles)
    }
}

impl<T: Real> ParametricProfile<T> for Ellipse<T> {
    fn domain(&self) -> [T; 2] {
        self.angles
    }

    fn convexity(&self) -> Convexity {
        Convexity::of_sign(self.across)
    }

    fn at(&self, k: T) -> CurvePoint<T> {
        let (sin, cos) = k.sin_cos();
        CurvePoint {
            x: self.along * sin,
            y: self.across * sin * (sin / (T::one() + cos)),
            dx: self.along * cos,
            dy: self.across * sin,
        }
    }
}
