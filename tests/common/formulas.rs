//! Curves for numbers of any kind.
#![allow(dead_code)] // Each test crate uses its own part.

use linecontact::Real;
use linecontact::autodiff::{Formula, Over};

/// Bodies of the paper's Example 3, Eqs. (33), (34), with one coefficient of the lower body (8 in
/// the paper) and the scales of X and Y (both 1) as parameters.
#[derive(Clone, Copy)]
pub struct Lower3<T> {
    pub coefficient: T,
    pub scale: [T; 2],
}

#[derive(Clone, Copy)]
pub struct Upper3<T> {
    pub scale: [T; 2],
}

impl<T: Real> Formula<T> for Lower3<T> {
    fn domain(&self) -> [T; 2] {
        [-1.353, 0.791].map(T::of)
    }
    fn point<N: Over<T>>(&self, k: N) -> (N, N) {
        let (n, eight) = (N::of, N::lift(self.coefficient));
        let (s, c) = k.sin_cos();
        let x = n(2.0) * c - eight * k * c - n(9.0) * s + n(7.0) * k * s - n(2.0);
        let y = n(15.0) * s + n(9.0) * c - n(15.0) * k * c - n(6.0) * k * s - n(9.0);
        let [sx, sy] = self.scale.map(N::lift);
        (sx * x, sy * (y * n(1e5)))
    }
}

impl<T: Real> Formula<T> for Upper3<T> {
    fn domain(&self) -> [T; 2] {
        [-1.428, 0.762].map(T::of)
    }
    fn point<N: Over<T>>(&self, k: N) -> (N, N) {
        let n = N::of;
        let (s, c) = k.sin_cos();
        let x = n(7.0) * s - n(8.0) * c + n(3.0) * k * c - n(9.0) * k * s + n(8.0);
        let y = n(35.0) * k * c - n(35.0) * s - n(30.0) * c + n(10.0) * k * s + n(30.0);
        let [sx, sy] = self.scale.map(N::lift);
        (sx * x, sy * (y * n(1e5)))
    }
}

/// Bodies of the paper's Example 2, Eqs. (30), (31), with the coefficients of k² (-36 and 63) as
/// parameters.
#[derive(Clone, Copy)]
pub struct Body2<T> {
    pub along: T,
    pub across: T,
}

impl<T: Real> Formula<T> for Body2<T> {
    fn domain(&self) -> [T; 2] {
        [-2.0, 2.0].map(T::of)
    }
    fn point<N: Over<T>>(&self, k: N) -> (N, N) {
        (N::lift(self.along) * k + N::of(0.2), N::lift(self.across) * k * k)
    }
}
