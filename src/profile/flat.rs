//! The flat body.

use super::{Convexity, CurvePoint, ParametricProfile};
use crate::Real;

/// A flat surface, `Y = 0`, as long as the number type allows. Costs nothing: its slope is
/// known everywhere, so nothing is inverted or evaluated for it.
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
