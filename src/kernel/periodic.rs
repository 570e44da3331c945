//! The kernel of a row of contacts, one in each period.
//!
//! ```text
//! K(x, s) = π/p cot(π(x - s)/p) - 1/(x - s)     its integral by x: ln|sin(π(x - s)/p)/(π(x - s)/p)|
//! ```
//!
//! With t = (x - s)/p, the nearest contacts on both sides and the next ones are the terms
//! `2t/(t² - n²)` of n = 1 and 2; all others are a power series, `-2 Σ t^(2j+1) Σ n^(-2j-2)` over
//! `n > 2`.

use super::RegularKernel;
use crate::Real;

/// Number of terms of the power series: for |t| < 1 the next one is below 1e-17.
const TERMS: usize = 17;

#[derive(Clone, Debug)]
pub(crate) struct Periodic<T> {
    pub period: T,
    /// Distance from the nearest place of the bodies to the next contact.
    pub distance: T,
    /// Coefficients of the power series, from the lowest power.
    terms: [T; TERMS],
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
        let sum = |j: usize| (3..=64).rev().map(|n| f64::from(n).powi(-2 * j as i32 - 2)).sum();
        let term = |j: usize| T::of(first.get(j).copied().unwrap_or_else(|| sum(j)));
        Self { period, distance: T::of(0.5) * period, terms: std::array::from_fn(term) }
    }

    /// Returns t; the ends of an endless body count as the next period.
    fn turns(&self, x: T, s: T) -> T {
        let most = T::of(1.5);
        ((x - s) / self.period).max(-most).min(most)
    }

    /// Returns a polynomial in t² with coefficients from those of the power series.
    fn polynomial(&self, square: T, of: impl Fn(usize, T) -> T) -> T {
        let terms = self.terms.iter().enumerate().rev();
        terms.fold(T::zero(), |sum, (j, &term)| sum * square + of(j, term))
    }
}

impl<T: Real> RegularKernel<T> for Periodic<T> {
    fn slope(&self, x: T, s: T) -> T {
        let (one, two, t) = (T::one(), T::of(2.0), self.turns(x, s));
        let near = ((t - one) * (t + one)).recip() + ((t - two) * (t + two)).recip();
        two * t * (near - self.polynomial(t * t, |_, term| term)) / self.period
    }

    fn height(&self, x: T, s: T) -> T {
        let (one, quarter, t) = (T::one(), T::of(0.25), self.turns(x, s));
        let square = t * t;
        // Next to the image of s the sum would lose what is left.
        let near = if square < T::of(0.5) {
            (-square).ln_1p()
        } else {
            ((one - t) * (one + t)).abs().ln()
        };
        let others = self.polynomial(square, |j, term| term / T::count(j + 1));
        near + (-quarter * square).ln_1p() - square * others
    }

    fn nearest_singularity(&self) -> T {
        self.distance
    }
}
