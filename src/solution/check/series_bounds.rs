//! Bounds of a polynomial from the coefficients of its Chebyshev series.

use crate::Real;
use crate::numerics::chebyshev::{expand, value_at};
use crate::quadrature::panels::Panel;

/// Largest number of halves examined before the least value found is accepted.
const MAX_EXAMINED: usize = 512;

/// Returns a lower and an upper bound of the series.
pub(in crate::solution) fn bounds<T: Real>(series: &[T]) -> [T; 2] {
    let others = series[1..].iter().fold(T::zero(), |sum, a| sum + a.abs());
    [series[0] - others, series[0] + others]
}

/// Returns a lower and an upper bound of the slope on panels.
pub(in crate::solution) fn extremes<T: Real>(panels: &[Panel<T>]) -> [T; 2] {
    let infinite = T::one() / T::zero();
    panels.iter().map(Panel::coefficients).fold([infinite, -infinite], |[least, most], series| {
        let [below, above] = bounds(series);
        [least.min(below), most.max(above)]
    })
}

/// Returns the place of the minimum, from -1 to 1, and its value to within `enough`: halves whose
/// bound is not below the best known value are skipped.
pub(in crate::solution) fn least<T: Real>(series: &[T], enough: T) -> [T; 2] {
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
        if looked < MAX_EXAMINED && bounds(&part)[0] < best[1] - enough && middle > left {
            waiting.extend([[middle, right], [left, middle]]);
        }
    }
    best
}

/// Estimates the truncation error from the last coefficients.
pub(in crate::solution) fn truncation_error<T: Real>(series: &[T]) -> T {
    let n = series.len();
    // NaN in one value is in all coefficients, and resolves nothing.
    let last =
        series[n - 4..].iter().fold(T::zero(), |max, a| if max > a.abs() { max } else { a.abs() });
    last * T::count(n)
}
