//! The kernel of a row of contacts, one in each period.
//!
//! ```text
//! K(x, s) = π/p cot πt - 1/(x - s)     ∫ K dx = ln|sin πt/πt|     t = (x - s)/p
//! ```
//!
//! The nearest contacts on both sides and the next ones are the terms
//! `2t/(t² - n²)` of n = 1 and 2; all others are a power series, `-2 Σ t^(2j+1) Σ n^(-2j-2)` over
//! `n > 2`.

use super::RegularKernel;
use crate::Real;
use nalgebra::Complex;

/// Number of terms of the power series: for |t| < 1 the next one is below 1e-17.
const TERMS: usize = 17;

/// Coefficients of `1/z - cot z` by odd powers of z, and the largest |z|² for them: the next term
/// is below 1e-17.
const COTANGENT: [f64; 5] = [1.0 / 3.0, 1.0 / 45.0, 2.0 / 945.0, 1.0 / 4725.0, 2.0 / 93555.0];
const SMALL: f64 = 0.01;

#[derive(Clone, Debug)]
pub(crate) struct Periodic<T> {
    pub period: T,
    /// Period at hand, and the distance from its ends to the contacts in it.
    pub range: [T; 2],
    pub distance: T,
    /// Coefficients of the power series, from the lowest power, and of its integral.
    terms: [T; TERMS],
    integral: [T; TERMS],
}

impl<T: Real> Periodic<T> {
    pub fn new(period: T) -> Self {
        // The first three are ζ(2), ζ(4) and ζ(6) less two terms; of the others n = 64 is 1e-15.
        let square = std::f64::consts::PI * std::f64::consts::PI;
        let first = [
            square / 6.0 - 5.0 / 4.0,
            square * square / 90.0 - 17.0 / 16.0,
            square * square * square / 945.0 - 65.0 / 64.0,
        ];
        let power = |n: f64, j: usize| (0..=j).fold(1.0, |power, _| power / (n * n));
        let sum = |j: usize| (3..=64).rev().map(|n| power(f64::from(n), j)).sum();
        let term = |j: usize| T::of(first.get(j).copied().unwrap_or_else(|| sum(j)));
        let (range, distance) = ([T::zero(), period], T::of(0.5) * period);
        let integral = std::array::from_fn(|j| term(j) / T::count(j + 1));
        Self { period, range, distance, terms: std::array::from_fn(term), integral }
    }

    /// Returns t; the ends of an endless body count as the next period.
    fn turns(&self, x: T, s: T) -> T {
        let most = T::of(1.5);
        ((x - s) / self.period).max(-most).min(most)
    }

    /// Returns K and its derivative at a distance from s, at a depth below the surface.
    pub fn below(&self, distance: T, depth: T) -> [Complex<T>; 2] {
        let [zero, one] = [T::zero(), T::one()].map(|real| Complex::new(real, T::zero()));
        let (scale, two) = (T::pi() / self.period, T::of(2.0));
        let z = Complex::new(distance, depth) * scale;
        let [value, slope] = if z.norm_sqr() < T::of(SMALL) {
            let terms = COTANGENT.iter().enumerate().rev();
            let [value, slope] = terms.fold([zero; 2], |[value, slope], (k, &term)| {
                let term = T::of(term);
                [value * z * z - term, slope * z * z - term * T::count(2 * k + 1)]
            });
            [value * z, slope]
        } else {
            // exp(2iz), zero far below.
            let (sin, cos) = (two * z.re).sin_cos();
            let turn = Complex::new(cos, sin) * (-two * z.im).exp();
            let inverse = |z: Complex<T>| z.conj() * z.norm_sqr().recip();
            let (by, pole) = (inverse(turn - one), inverse(z));
            let cotangent = Complex::new(T::zero(), T::one()) * (turn + one) * by;
            [cotangent - pole, turn * by * by * T::of(4.0) + pole * pole]
        };
        [value * scale, slope * (scale * scale)]
    }
}

/// Returns a polynomial, given its coefficients from the lowest power.
fn polynomial<T: Real>(terms: &[T; TERMS], x: T) -> T {
    terms.iter().rev().fold(T::zero(), |sum, &term| sum * x + term)
}

impl<T: Real> RegularKernel<T> for Periodic<T> {
    fn slope(&self, x: T, s: T) -> T {
        let (one, two, t) = (T::one(), T::of(2.0), self.turns(x, s));
        let near = ((t - one) * (t + one)).recip() + ((t - two) * (t + two)).recip();
        two * t * (near - polynomial(&self.terms, t * t)) / self.period
    }

    fn height(&self, x: T, s: T) -> T {
        let (one, two, quarter, t) = (T::one(), T::of(2.0), T::of(0.25), self.turns(x, s));
        let square = t * t;
        // Next to the image of s the sum would lose what is left.
        let near = if square < quarter {
            (quarter * square * (square - T::of(5.0))).ln_1p()
        } else {
            (quarter * (one - t) * (one + t) * (two - t) * (two + t)).abs().ln()
        };
        near - square * polynomial(&self.integral, square)
    }

    fn nearest_singularity(&self) -> T {
        self.distance
    }
}
