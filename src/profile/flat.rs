//! The flat body.

use super::{Convexity, CurvePoint, ParametricProfile};
use crate::Real;

/// Flat surface, `Y = 0`, as long as the number type allows. It costs nothing: its slope is known
/// everywhere, so that nothing is inverted or evaluated for it.
///
/// ```
/// use linecontact::profile::Parabola;
/// use linecontact::{Contact, Control, Flat};
///
/// let body = Parabola::new(1.0f64, [-1.0, 1.0])?;
/// let solution = Contact::new(&Flat, &body)?.solve(Control::Load(0.02))?;
/// assert!((solution.a() / 0.2 - 1.0).abs() < 1e-14); // sqrt(2 F R/κ)
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Flat;

impl<T: Real> ParametricProfile<T> for Flat {
    fn domain(&self) -> [T; 2] {
        // A quarter of the largest number, so that sums of two such ends stay finite.
        let end = T::max_value().unwrap_or_else(|| T::epsilon().recip()) * T::of(0.25);
        [-end, end]
    }

    fn convexity(&self) -> Convexity {
        Convexity::Straight
    }

    fn at(&self, k: T) -> CurvePoint<T> {
        CurvePoint { x: k, y: T::zero(), dx: T::one(), dy: T::zero() }
    }

    fn slope_at(&self, _x: T) -> Option<T> {
        Some(T::zero())
    }
}
