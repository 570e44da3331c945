//! Straight bodies: a line, and two of them as a wedge.

use super::{Convexity, CurvePoint, ParametricProfile, Piecewise, PiecewiseError, ProfileError};
use super::{finite, interval};
use crate::Real;

/// Straight line `Y = m X` through the origin, with `X = k`. For a level line without ends use
/// [`Flat`](crate::Flat).
///
/// ```
/// use linecontact::ParametricProfile;
/// use linecontact::profile::Line;
///
/// let flank = Line::new(0.25, [0.0, 2.0])?;
/// assert_eq!(flank.y(2.0), 0.5);
/// # Ok::<(), linecontact::ProfileError<f64>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Line<T> {
    slope: T,
    domain: [T; 2],
}

impl<T: Real> Line<T> {
    /// Creates a line with the slope m between two abscissae.
    ///
    /// # Errors
    /// [`ProfileError::Parameter`] for a slope that is not finite, [`ProfileError::Domain`].
    pub fn new(slope: T, domain: [T; 2]) -> Result<Self, ProfileError<T>> {
        finite("the slope", slope, true, "finite")?;
        Ok(Self { slope, domain: interval(domain)? })
    }
}

impl<T: Real> ParametricProfile<T> for Line<T> {
    fn domain(&self) -> [T; 2] {
        self.domain
    }

    fn convexity(&self) -> Convexity {
        Convexity::Straight
    }

    fn at(&self, k: T) -> CurvePoint<T> {
        CurvePoint { x: k, y: self.slope * k, dx: T::one(), dy: self.slope }
    }

    fn slope_at(&self, _x: T) -> Option<T> {
        Some(self.slope)
    }
}

/// Builds a wedge of two straight flanks that meet at the origin, each with its slope, from
/// `-reach` to `reach`.
///
/// A wedge that points down has a negative slope on the left and a positive one on the right.
///
/// # Errors
/// [`PiecewiseError::InPiece`] with [`ProfileError::Parameter`] for a slope that is not finite, or
/// a reach that is not positive and finite.
///
/// ```
/// use linecontact::profile::wedge;
/// use linecontact::{Contact, Control, Flat};
///
/// let body = wedge([-0.1, 0.1], 1.0)?;
/// let contact = Contact::new(&Flat, &body)?;
/// let solution = contact.solve(Control::Load(0.02))?;
/// // L = π F/(2 κ m)
/// assert!((solution.a() / (0.1 * std::f64::consts::PI) - 1.0).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn wedge<T: Real>(
    slopes: [T; 2],
    reach: T,
) -> Result<Piecewise<T, Line<T>>, PiecewiseError<T>> {
    let part = |i: usize, domain| {
        finite("the reach", reach, reach > T::zero(), "positive and finite")
            .and_then(|()| Line::new(slopes[i], domain))
            .map_err(PiecewiseError::in_piece(i))
    };
    Piecewise::new(vec![part(0, [-reach, T::zero()])?, part(1, [T::zero(), reach])?])
}
