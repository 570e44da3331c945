//! What the coefficients of a Chebyshev series say of the least value of the polynomial.

use crate::Real;
use crate::numerics::chebyshev::{expand, value_at};

/// Halves looked at before a least value is taken as it is.
const MOST_HALVES: usize = 512;

/// No value of the series is below this.
pub(super) fn below<T: Real>(series: &[T]) -> T {
    let others = series[1..].iter().fold(T::zero(), |sum, a| sum + a.abs());
    series[0] - others
}

/// No value of the series is above this.
pub(super) fn above<T: Real>(series: &[T]) -> T {
    series.iter().skip(1).fold(series[0], |sum, a| sum + a.abs())
}

/// The place, from -1 to 1, and the value of the minimum, to within `enough`: halves whose bound is
/// not below the best value known are left out.
pub(super) fn least<T: Real>(series: &[T], enough: T) -> [T; 2] {
    let one = T::one();
    let mut best = [-one, value_at(series, -one)];
    let mut waiting = vec![[-one, one]];
    let mut looked = 0;
    while let Some([left, right]) = waiting.pop() {
        let middle = T::of(0.5) * (left + right);
        for s in [middle, right] {
            let value = value_at(series, s);
            if value < best[1] {
                best = [s, value];
            }
        }
        looked += 1;
        let part = expand(series, [left, right]);
        if looked < MOST_HALVES && below(&part) < best[1] - enough && middle > left {
            waiting.extend([[middle, right], [left, middle]]);
        }
    }
    best
}

/// Whether the series rises from -1 to 1, up to errors of this size in its values.
pub(super) fn rises<T: Real>(series: &[T], error: T) -> bool {
    let n = series.len();
    let mut slopes = vec![T::zero(); n + 1];
    for k in (1..n).rev() {
        let before = if k + 1 < n { slopes[k + 1] } else { T::zero() };
        slopes[k - 1] = before + T::count(2 * k) * series[k];
    }
    slopes[0] *= T::of(0.5);
    let slopes = &slopes[..(n - 1).max(1)];
    // Markov's inequality: so large may the derivative of such an error be.
    let noise = error * T::count(n * n);
    below(slopes) >= -noise || least(slopes, noise)[1] >= -(noise + noise)
}

/// What the last coefficients say that those left out add up to.
pub(super) fn truncation_error<T: Real>(series: &[T]) -> T {
    let n = series.len();
    let last = series[n - 4..].iter().fold(T::zero(), |max, a| max.max(a.abs()));
    last * T::count(n)
}
