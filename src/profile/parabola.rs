//! The parabola of Hertz.

use super::{Convexity, CurvePoint, ParametricProfile, ProfileError, finite, interval};
use crate::Real;

/// Parabola `Y = X²/(2R)`, with `X = k`: the body of Hertz's theory.
///
/// R is the radius of curvature at the vertex, which lies at the origin. It is positive for an
/// upper body that bulges, or a lower one that is hollow, and negative for the reverse.
///
/// ```
/// use linecontact::profile::Parabola;
/// use linecontact::{Contact, Control, Flat};
///
/// let body = Parabola::new(2.0f64, [-1.0, 1.0])?;
/// let contact = Contact::new(&Flat, &body)?;
/// let solution = contact.solve(Control::Load(0.01))?;
/// assert!((solution.a() - 0.2).abs() < 1e-15); // sqrt(2 F R/κ)
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Parabola<T> {
    /// Radius R; `None` where the curvature is zero.
    radius: Option<T>,
    /// Curvature 1/R.
    #[cfg_attr(feature = "serde", serde(skip_serializing))]
    curvature: T,
    domain: [T; 2],
}

impl<T: Real> Parabola<T> {
    /// Creates a parabola with the radius R between two abscissae.
    ///
    /// # Errors
    /// [`ProfileError::Parameter`] unless R and 1/R are finite, [`ProfileError::Domain`].
    pub fn new(radius: T, domain: [T; 2]) -> Result<Self, ProfileError<T>> {
        let fits = radius.is_finite() && radius.recip().is_finite();
        finite("the radius", radius, fits, "finite and not zero")?;
        Ok(Self { radius: Some(radius), curvature: radius.recip(), domain: interval(domain)? })
    }

    /// Creates the limit of a large radius: a straight line.
    pub(super) fn straight(domain: [T; 2]) -> Result<Self, ProfileError<T>> {
        Ok(Self { radius: None, curvature: T::zero(), domain: interval(domain)? })
    }
}

impl<T: Real> ParametricProfile<T> for Parabola<T> {
    fn domain(&self) -> [T; 2] {
        self.domain
    }

    fn convexity(&self) -> Convexity {
        Convexity::of_sign(self.curvature)
    }

    fn at(&self, k: T) -> CurvePoint<T> {
        let slope = self.curvature * k;
        CurvePoint { x: k, y: T::of(0.5) * slope * k, dx: T::one(), dy: slope }
    }

    fn slope_at(&self, x: T) -> Option<T> {
        Some(self.curvature * x)
    }
}
