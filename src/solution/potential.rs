//! The potential of the pressure on one contact, and its pull, by powers of the Joukowski variable.
//!
//! With `ζ = x + iy = c + L z`, `u = z - sqrt(z - 1) sqrt(z + 1)`, |u| < 1, the slope as the series
//! `g = Σ a_k cos kθ`, and the strengths K of the edges,
//!
//! ```text
//! W(ζ) = ∫ P(s)/(ζ - s) ds = κ Σ_{k≥1} a_k uᵏ + π u (K_a/(1 - u) + K_b/(1 + u))
//! ∫ P ln|ζ - s| ds = Re [F ln(L/2u) + L (κ Σ_{k≥1} p_k uᵏ - π/2 (K_a - K_b) u)]
//! p_k = (a_{k-1} - a_{k+1})/2k, without a_0
//! ```
//!
//! The second is the integral of the first. On a single panel both sums end, and hold at any depth.

use crate::numerics::chebyshev::Coeffs;
use crate::quadrature::panels::{inverse, length, sqrt};
use crate::{Ends, Interval, Real};
use nalgebra::Complex;

/// Largest |u| at which the terms left out of a series of several panels, from u²⁴ on, are
/// rounding.
const LARGEST: f64 = 0.2;

/// Pressure on one contact, as seen from below.
pub(crate) struct Potential<T> {
    pub on: Interval<T>,
    /// Coefficients a, the number of those known, and a flag: there are no others.
    pub series: (Coeffs<T>, usize),
    pub is_whole: bool,
    /// K_b and K_a.
    pub strengths: Ends<T>,
    pub kappa: T,
    pub load: T,
}

impl<T: Real> Potential<T> {
    /// Returns the moment about the centre over the half-width, a force per unit length: from afar
    /// W is `F/(ζ - c) + M/(ζ - c)²`.
    pub fn moment(&self) -> T {
        let ((series, terms), Ends { left, right }) = (&self.series, self.strengths);
        let second = if *terms > 2 { self.kappa * series[2] } else { T::zero() };
        T::of(0.25) * self.on.half_width() * (second + T::pi() * (right - left))
    }

    /// Returns `∫ P ln|ζ - s| ds` and `y Im W` at x, at a depth y; `None` where terms that count
    /// are unknown.
    pub fn at(&self, x: T, depth: T) -> Option<[T; 2]> {
        let (half, half_width) = (T::of(0.5), self.on.half_width());
        let place = |t: T| Complex::new(x - t, depth) * (half / half_width);
        let [left, right] = [place(self.on.left), place(self.on.right)];
        let u = inverse(left + right + sqrt(left) * sqrt(right) * T::of(2.0));
        if !self.is_whole && length(u) > T::of(LARGEST) {
            return None;
        }
        let (zero, one) = (Complex::new(T::zero(), T::zero()), Complex::new(T::one(), T::zero()));
        let (series, terms) = &self.series;
        let a = |k: usize| if k > 0 && k < *terms { series[k] } else { T::zero() };
        let [mut pull, mut potential] = [zero; 2];
        for k in (1..=*terms).rev() {
            pull = (pull + a(k)) * u;
            potential = (potential + (a(k - 1) - a(k + 1)) / T::count(2 * k)) * u;
        }
        pull *= self.kappa;
        potential *= self.kappa;
        let Ends { left, right } = self.strengths;
        for (strength, sign) in [(left, T::one()), (right, -T::one())] {
            // Next to an edge without a singularity the quotient may be 0/0.
            if !strength.is_zero() {
                pull += u * inverse(one + u * sign) * (T::pi() * strength);
                potential += u * (T::frac_pi_2() * sign * strength);
            }
        }
        let logarithm = self.load * (half * half_width / length(u)).ln();
        Some([logarithm + half_width * potential.re, depth * pull.im])
    }
}
