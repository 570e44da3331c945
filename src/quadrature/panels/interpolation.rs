//! Slopes of a body at the nodes, from samples near the nodes, and their error.

use crate::Real;
use crate::gap::SampleCache;
use crate::numerics::chebyshev::{MAX_SIZE, Table};
use crate::real::fma;

/// Zeros with a 1 in the middle, which replaces the difference of a node from itself.
const ONE: [f64; 2 * MAX_SIZE] = {
    let mut one = [0.0; 2 * MAX_SIZE];
    one[MAX_SIZE] = 1.0;
    one
};

/// Returns the slopes of a body at the nodes from the slopes at its sampled points. Both count from
/// the left end of the panel, where the rounding of x matters less.
///
/// With node t next to the point xᵢ, Lagrange's formula for the difference of the slope from fᵢ is
///
/// ```text
/// f(t) = fᵢ + Σⱼ (fⱼ - fᵢ) wⱼ Π_{m≠j} (t - x_m),    wⱼ = 1/Π_{m≠j} (xⱼ - x_m)
/// ```
///
/// Its terms are small where rounding would be large, and it takes no division per node.
// Inlined like `sample_near`, for the speed of a bare solve.
#[inline(always)]
pub(super) fn at_nodes<const N: usize, T: Real>(
    nodes: &[T; N],
    cache: &SampleCache<T>,
    left: T,
    reach: T,
) -> [T; N] {
    let curve_samples = &cache.curve_samples()[..N];
    let known: [T; N] = std::array::from_fn(|i| curve_samples[i].slope);
    if cache.direct {
        return known;
    }
    // In units that keep the products near 1.
    let unit = T::of(2.0) / reach;
    let x: [T; N] = std::array::from_fn(|i| (curve_samples[i].x - left) * unit);
    let at = nodes.map(|node| node * unit);
    // Factors in the order of the products below, so that both round alike.
    let mut weight = [T::one(); N];
    for j in 0..N {
        let one = &ONE[MAX_SIZE - j..MAX_SIZE - j + N];
        for i in 0..N {
            weight[i] *= x[i] - x[j] + T::of(one[i]);
        }
    }
    let weight = weight.map(|weight| T::one() / weight);
    let (mut sum, mut product) = ([T::zero(); N], [T::one(); N]);
    for j in 0..N {
        for i in 0..N {
            let distance = at[i] - x[j];
            sum[i] = fma(sum[i], distance, (known[j] - known[i]) * (weight[j] * product[i]));
            product[i] *= distance;
        }
    }
    // Not finite if points coincide, on a panel of a few units in the last place.
    let apart = sum.iter().fold(true, |all, sum| all & sum.is_finite());
    std::array::from_fn(|i| if apart { known[i] + sum[i] } else { known[i] })
}

/// Estimates the error of a body's slopes at the nodes: the first coefficient beyond the series,
/// times the share by which points are off the nodes.
pub(super) fn left_open<const N: usize, T: Real>(
    nodes: &[T; N],
    cache: &SampleCache<T>,
    reach: T,
    slopes: &[T; N],
    coarse: bool,
) -> T {
    let table = Table::of(N);
    if cache.direct || coarse {
        return T::zero();
    }
    // The slope of `T_N` at its zeros is N/sin θ.
    let curve_samples = &cache.curve_samples()[..N];
    let off = (0..N).fold(T::zero(), |max, i| {
        max.max((curve_samples[i].x - nodes[i]).abs() / T::of(table.sine[i]))
    });
    let off = (off * T::count(N) / reach).min(T::one());
    let [before, last] = table.last_pairs::<N, T>(slopes);
    let largest = slopes.iter().fold(T::zero(), |max, slope| max.max(slope.abs()));
    if last <= T::of(8.0) * T::epsilon() * largest {
        return T::zero();
    }
    off * last * (last / before).min(T::one())
}

/// Returns the error of a body's series at the ends of its piece, where the slopes are known.
pub(super) fn missed_at_ends<const N: usize, T: Real>(
    x: [T; 2],
    cache: &SampleCache<T>,
    slopes: &[T; N],
    coarse: bool,
) -> T {
    let known = cache.ends();
    let is_end = |i: usize| known[i].x == x[i] && known[i].slope.is_finite();
    if cache.direct || coarse || !(is_end(0) || is_end(1)) {
        return T::zero();
    }
    let shares = &Table::of(N).at_end[..N];
    let missed = |i: usize| {
        let slope = |j: usize| slopes[if i == 0 { N - 1 - j } else { j }];
        (0..N).fold(-known[i].slope, |sum, j| fma(slope(j), T::of(shares[j]), sum)).abs()
    };
    (0..2).filter(|&i| is_end(i)).map(missed).fold(T::zero(), T::max)
}
