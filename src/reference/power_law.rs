//! A power of the distance.

use super::{ClosedForm, ReferenceError, centred, check, positive, root_inside};
use crate::numerics::special_functions::{series, wallis};
use crate::{Interval, Real};

/// Body `A abs(x)ⁿ` for any real n ≥ 1 (Steuermann, *C. R. Acad. Sci. URSS* 25, 1939, 359, for even
/// n; Johnson, §5.3).
///
/// ```text
/// F = 2 κ n A Lⁿ/π ∫ cosⁿ φ dφ,   P = n F/(π L) ∫ tⁿ⁻¹/sqrt(t² - ξ²) dt
/// ```
///
/// with φ from 0 to π/2, t from ξ = abs(x)/L to 1. With `s = sqrt(1 - ξ²)` the second integral J is
/// `s ₂F₁(1 - n/2, 1; 3/2; s²)`; for n = 1 it is arcosh(1/ξ), and
/// `(n - 1) J(n) = s + (n - 2) ξ² J(n - 2)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PowerLaw<T> {
    coefficient: T,
    exponent: T,
    half_width: T,
}

impl<T: Real> PowerLaw<T> {
    /// Creates the form from the coefficient A, a length to the power 1 - n, the exponent n and the
    /// half-width L.
    ///
    /// # Errors
    /// [`ReferenceError::Parameter`] if A or L is not positive and finite, or n is not from 1 to
    /// 1000.
    pub fn new(coefficient: T, exponent: T, half_width: T) -> Result<Self, ReferenceError<T>> {
        positive([("the coefficient", coefficient)])?;
        let holds = exponent >= T::one() && exponent <= T::of(1000.0);
        check("the exponent", exponent, holds, "from 1 to 1000")?;
        positive([("the half-width", half_width)])?;
        Ok(Self { coefficient, exponent, half_width })
    }

    /// Creates the form from the coefficient A, the exponent n and the load F.
    ///
    /// # Errors
    /// As [`new`](Self::new), and if the load is not positive and finite.
    pub fn under_load(
        coefficient: T,
        exponent: T,
        load: T,
        kappa: T,
    ) -> Result<Self, ReferenceError<T>> {
        Self::new(coefficient, exponent, T::one())?;
        positive([("the load", load), ("κ", kappa)])?;
        // Lⁿ itself may overflow.
        let root = |value: T| value.powf(exponent.recip());
        let constant = T::frac_pi_2() / (exponent * wallis(exponent));
        let start = root(load / kappa) * root(constant) / root(coefficient);
        // A rounded 1/n costs up to a hundred units of rounding, which one Newton step removes.
        let excess = load / Self::new(coefficient, exponent, start)?.load(kappa) - T::one();
        Self::new(coefficient, exponent, start + start * excess / exponent)
    }

    /// Returns `A xⁿ` for another n, by the square root of xⁿ, which may itself overflow.
    fn times_power(&self, x: T, exponent: T) -> T {
        let root = x.powf(T::of(0.5) * exponent);
        self.coefficient * root * root
    }
}

impl<T: Real> ClosedForm<T> for PowerLaw<T> {
    fn limits(&self) -> Interval<T> {
        centred(self.half_width)
    }

    fn load(&self, kappa: T) -> T {
        let n = self.exponent;
        let power = self.times_power(self.half_width, n);
        T::of(2.0) * kappa * n * power * wallis(n) / T::pi()
    }

    fn pressure(&self, x: T, kappa: T) -> T {
        let Some(root) = root_inside(self.limits(), x) else { return T::zero() };
        let (n, l) = (self.exponent, self.half_width);
        let integral = integral(n, x.abs() / l, root / l);
        n * self.load(kappa) / (T::pi() * l) * integral
    }

    fn height(&self, x: T) -> T {
        self.times_power(x.abs(), self.exponent)
    }

    fn slope(&self, x: T) -> T {
        let (n, one) = (self.exponent, T::one());
        let slope = n * self.times_power(x.abs(), n - one);
        if x < T::zero() { -slope } else { slope }
    }

    fn slope_left(&self, x: T) -> T {
        -self.slope(-x)
    }

    fn breakpoints(&self) -> Vec<T> {
        vec![T::zero()]
    }
}

/// Returns J, with ξ and s = sqrt(1 - ξ²).
fn integral<T: Real>(exponent: T, xi: T, s: T) -> T {
    let (one, two, three) = (T::one(), T::of(2.0), T::of(3.0));
    if xi == T::zero() {
        return (exponent - one).recip();
    }
    // All terms of the recurrence are positive, from an exponent in [1, 3) on.
    let mut n = exponent;
    let mut steps = 0;
    while n >= three {
        n -= two;
        steps += 1;
    }
    let mut integral = lowest(n, xi, s);
    for step in (0..steps).rev() {
        n = exponent - two * T::count(step);
        integral = (s + (n - two) * xi * xi * integral) / (n - one);
    }
    integral
}

/// Returns J for 1 ≤ n < 3.
fn lowest<T: Real>(n: T, xi: T, s: T) -> T {
    let (one, two, half) = (T::one(), T::of(2.0), T::of(0.5));
    let hypergeometric = |square: T| series(one, |k| square * (k - half * n) / (k + half));
    if s * s <= half {
        return s * hypergeometric(s * s);
    }
    // With t = ξ cosh v and p = n - 1, J = ξᵖ ∫ coshᵖ v dv, from 0 to V = arcosh(1/ξ). The same
    // series is used up to tanh² v₁ = 1/2; from there coshᵖ v = 2⁻ᵖ Σ C(p, k) e^((p - 2k) v).
    let p = n - one;
    let near = half.sqrt() * hypergeometric(half) * (xi / half.sqrt()).powf(p);
    let v1 = one.asinh();
    let ahead = (one / xi).acosh() - v1;
    let mut sum = T::zero();
    let mut binomial = one;
    for k in 0..60 {
        let rate = p - two * T::count(k);
        let fall = -rate.abs();
        let integral = if rate == T::zero() { ahead } else { (fall * ahead).exp_m1() / fall };
        // ξᵖ e^(p v) at the end where the integrand is larger.
        let scale = if k == 0 { (one + s).powf(p) } else { xi.powf(p) * (rate * v1).exp() };
        let term = binomial * scale * integral;
        sum += term;
        if term.abs() <= T::of(0.25) * T::epsilon() * sum.abs() {
            break;
        }
        binomial *= (p - T::count(k)) / T::count(k + 1);
    }
    near + sum * half.powf(p)
}
