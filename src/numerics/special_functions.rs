//! Special functions for the closed forms.

use crate::Real;

/// Sums `first (1 + r₁ + r₁ r₂ + ...)`, given the ratio of each term to the one before.
pub(crate) fn series<T: Real>(first: T, ratio: impl Fn(T) -> T) -> T {
    let (mut sum, mut term) = (first, first);
    for k in 1..1000 {
        term *= ratio(T::count(k));
        sum += term;
        if term.abs() <= T::of(0.25) * T::epsilon() * sum.abs() {
            break;
        }
    }
    sum
}

/// Finds the root of a rising convex function from its value and derivative, by Newton's method:
/// from below the first step leads above the root, and from above all steps lead down to it.
pub(crate) fn convex_root<T: Real>(start: T, function: impl Fn(T) -> [T; 2]) -> T {
    let step = |x: T| match function(x) {
        [value, _] if value == T::zero() => x,
        [value, slope] => x - value / slope,
    };
    let further = |&x: &T| Some(step(x)).filter(|&next| next < x);
    std::iter::successors(Some(step(start)), further).take(61).fold(start, |_, x| x)
}

/// Returns `u - atan u` for u ≥ 0.
pub(crate) fn minus_atan<T: Real>(u: T) -> T {
    if u > T::of(0.75) { u - u.atan() } else { beyond_first(u, -u * u) }
}

/// Returns `artanh z - z` for 0 ≤ z ≤ 1/2.
pub(crate) fn artanh_minus<T: Real>(z: T) -> T {
    beyond_first(z, z * z)
}

/// Sums `z³/3 + z³ s/5 + z³ s²/7 + ...`
fn beyond_first<T: Real>(z: T, s: T) -> T {
    let two = T::of(2.0);
    series(z * z * z / T::of(3.0), |k| s * (two * k + T::one()) / (two * k + T::of(3.0)))
}

/// Returns `y - sin y` for y ≥ 0.
pub(crate) fn minus_sin<T: Real>(y: T) -> T {
    if y > T::one() { y - y.sin() } else { beyond_first_by_factorials(y, -y * y) }
}

/// Returns `sinh y - y` for y ≥ 0.
pub(crate) fn sinh_minus<T: Real>(y: T) -> T {
    if y > T::of(2.0) { y.sinh() - y } else { beyond_first_by_factorials(y, y * y) }
}

/// Sums `y³/3! + y³ s/5! + y³ s²/7! + ...`
fn beyond_first_by_factorials<T: Real>(y: T, s: T) -> T {
    let two = T::of(2.0);
    series(y * y * y / T::of(6.0), |k| s / ((two * k + two) * (two * k + T::of(3.0))))
}

/// Returns `sin φ - φ cos φ` for 0 ≤ φ ≤ π.
pub(crate) fn sin_minus_cos<T: Real>(phi: T) -> T {
    if phi > T::one() {
        return phi.sin() - phi * phi.cos();
    }
    // The terms φ^(2k+1) (1/(2k)! - 1/(2k+1)!) = φ^(2k+1) 2k/(2k+1)!, of alternating sign.
    let two = T::of(2.0);
    let term = |k: T| -phi * phi / (two * k * (two * k + T::of(3.0)));
    series(phi * phi * phi / T::of(3.0), term)
}

/// Returns `e^y - 1 - y`.
pub(crate) fn exp_minus<T: Real>(y: T) -> T {
    if y.abs() > T::one() {
        return y.exp_m1() - y;
    }
    series(T::of(0.5) * y * y, |k| y / (k + T::of(2.0)))
}

/// Returns the complete elliptic integral in the form of Bulirsch (*Numer. Math.* 13, 1969, 305),
///
/// ```text
/// ∫ (a cos² + b sin²) / ((cos² + p sin²) sqrt(cos² + k'² sin²)) dφ,   0 < φ < π/2
/// ```
///
/// for k', p > 0 and a, b ≥ 0, by Bartky's transformation, whose arithmetic and geometric means
/// carry p, a and b along. No difference occurs, so all digits are kept. K is the case a = b = p =
/// 1.
pub(crate) fn elliptic<T: Real>(complement: T, p: T, a: T, b: T) -> T {
    let half = T::of(0.5);
    let (mut mean, mut geometric) = (T::one(), complement);
    let (mut p, mut a, mut b) = (p.sqrt(), a, b / p.sqrt());
    for _ in 0..60 {
        let product = mean * geometric;
        (a, b) = (half * (a + b / p), half * (b + a * product / p));
        p = half * (p + product / p);
        (mean, geometric) = (half * (mean + geometric), product.sqrt());
        let apart = (mean - geometric).abs().max((mean - p).abs());
        if apart <= T::of(4.0) * T::epsilon() * mean {
            break;
        }
    }
    T::frac_pi_2() * (b + a * mean) / (mean * (mean + p))
}

/// Returns `∫ cosⁿ φ dφ` from 0 to π/2, which is `sqrt(π)/2 Γ((n+1)/2)/Γ(n/2+1)`, for n ≥ 0.
pub(crate) fn wallis<T: Real>(mut n: T) -> T {
    let (one, two, mut factor) = (T::one(), T::of(2.0), T::one());
    // W(n) = W(n+2) (n+2)/(n+1), until n is large.
    while n < T::of(24.0) {
        factor *= (n + two) / (n + one);
        n += two;
    }
    // Γ(y + 1/4)/Γ(y + 3/4) has an expansion in even powers of 1/y.
    let y = T::of(0.5) * n + T::of(0.25);
    let v = (y * y).recip();
    let coefficients = [
        1.0,
        -1.0 / 64.0,
        21.0 / 8192.0,
        -671.0 / 524288.0,
        180323.0 / 134217728.0,
        -20898423.0 / 8589934592.0,
    ];
    let sum = coefficients.into_iter().rev().fold(T::zero(), |sum, c| sum * v + T::of(c));
    factor * T::of(0.5) * (T::pi() / y).sqrt() * sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::assert_relative_eq;
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

    fn close(got: f64, want: f64) {
        assert_relative_eq!(got, want, epsilon = 0.0, max_relative = 2e-15);
    }

    #[test]
    fn elliptic_integrals_have_their_known_values() {
        // K and E of the lemniscate, k² = 1/2.
        let half = 0.5f64.sqrt();
        close(elliptic(half, 1.0, 1.0, 1.0), 1.854_074_677_301_371_9);
        close(elliptic(half, 1.0, 1.0, 0.5), 1.350_643_881_047_675_5);
        // Π(n | 0) = π/(2 sqrt(1 - n)).
        close(elliptic(1.0, 0.75, 1.0, 1.0), PI / (2.0 * 0.75f64.sqrt()));
        // Legendre's relation, with (K - E)/k² and K.
        for k in [1e-6f64, 0.3, 0.8, 0.999_999] {
            let c = ((1.0 - k) * (1.0 + k)).sqrt();
            let [first, second] = [c, k].map(|c| elliptic(c, 1.0, 1.0, 1.0));
            let [e, f] = [c, k].map(|c| elliptic(c, 1.0, 1.0, c * c));
            close(e * second + first * f, FRAC_PI_2 + first * second);
            close(first - k * k * elliptic(c, 1.0, 0.0, 1.0), e);
        }
    }

    #[test]
    fn wallis_integrals_have_their_known_values() {
        close(wallis(0.0), FRAC_PI_2);
        close(wallis(1.0), 1.0);
        close(wallis(2.0), FRAC_PI_4);
        close(wallis(3.0), 2.0 / 3.0);
        for n in [0.3, 2.7, 11.1, 23.9, 100.5] {
            close(wallis(n) * wallis(n + 1.0), FRAC_PI_2 / (n + 1.0));
        }
    }

    #[test]
    fn the_differences_agree_where_both_formulas_hold() {
        let close = |got, want| assert_relative_eq!(got, want, epsilon = 0.0, max_relative = 1e-14);
        close(minus_atan(0.74f64), 0.74 - 0.74f64.atan());
        close(artanh_minus(0.5f64), 0.5f64.atanh() - 0.5);
        close(minus_sin(0.99f64), 0.99 - 0.99f64.sin());
        close(sinh_minus(1.99f64), 1.99f64.sinh() - 1.99);
        close(sin_minus_cos(0.99f64), 0.99f64.sin() - 0.99 * 0.99f64.cos());
        close(exp_minus(-0.99f64), (-0.99f64).exp_m1() + 0.99);
        close(exp_minus(0.99f64), 0.99f64.exp_m1() - 0.99);
    }
}
