//! A profile made from a closure.

use super::{Convexity, CurvePoint, ParametricProfile};
use crate::Real;

/// Profile made from a closure and the range of its parameter.
///
/// ```
/// use linecontact::{Curve, CurvePoint};
///
/// let r = 0.02;
/// let roller = Curve::new([-1.5, 1.5], move |k: f64| {
///     let (sin, cos) = k.sin_cos();
///     CurvePoint { x: r * sin, y: -r * cos, dx: r * cos, dy: r * sin }
/// });
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Curve<T, F> {
    domain: [T; 2],
    point: F,
    convexity: Convexity,
}

impl<T: Real, F: Fn(T) -> CurvePoint<T> + Send + Sync> Curve<T, F> {
    /// Creates the curve `point(k)` for `k` in `domain`.
    pub fn new(domain: [T; 2], point: F) -> Self {
        Self { domain, point, convexity: Convexity::Unknown }
    }

    /// Declares the convexity of the curve: see [`Convexity`].
    #[must_use]
    pub fn with_convexity(self, convexity: Convexity) -> Self {
        Self { convexity, ..self }
    }
}

impl<T: Real, F: Fn(T) -> CurvePoint<T> + Send + Sync> ParametricProfile<T> for Curve<T, F> {
    fn domain(&self) -> [T; 2] {
        self.domain
    }

    fn convexity(&self) -> Convexity {
        self.convexity
    }

    fn at(&self, k: T) -> CurvePoint<T> {
        (self.point)(k)
    }
}
