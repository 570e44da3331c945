//! Chebyshev series: the tables for a few fixed sizes, and evaluation.
//!
//! The sizes are multiples of four, and all loops over nodes run over arrays of a length known to
//! the compiler, which turns them into vector instructions.

// Loops over arrays of a known length, several at once, are clearer with the index.
#![allow(clippy::needless_range_loop)]

use crate::Real;
use crate::real::fma;
use std::f64::consts::PI;
use std::sync::LazyLock;

/// Numbers of nodes in use: multiples of four, for the sake of vector instructions.
pub(crate) const SIZES: [usize; 6] = [4, 8, 12, 16, 24, 32];
/// Largest of the [`SIZES`].
pub(crate) const MAX_SIZE: usize = 32;

/// Calls an expression for one of the [`SIZES`], with the number of nodes known to the compiler.
macro_rules! by_size {
    ($n:expr, $size:ident => $call:expr) => {
        by_size!(@ $n, $size, $call, 4 8 12 16 24)
    };
    (@ $n:expr, $size:ident, $call:expr, $($each:literal)*) => {
        match $n {
            $($each => {
                const $size: usize = $each;
                $call
            })*
            _ => {
                const $size: usize = crate::numerics::chebyshev::MAX_SIZE;
                $call
            }
        }
    };
}
pub(crate) use by_size;

/// Coefficients or values of a panel, one for each of its nodes.
pub(crate) type Coeffs<T> = [T; MAX_SIZE];

/// Zeros of `T_n`, and the transform from values there to coefficients.
#[derive(Default)]
pub(crate) struct Table {
    /// Nodes, rising, and `sin θ` there.
    pub z: [f64; MAX_SIZE],
    pub sine: [f64; MAX_SIZE],
    /// Distance from each node to the nearest other.
    pub spacing: [f64; MAX_SIZE],
    /// Share of the value at node j in coefficient k, as `transform[j][k]`.
    transform: [[f64; MAX_SIZE]; MAX_SIZE],
    /// Share of the value at node j in the value at the right end.
    pub at_end: [f64; MAX_SIZE],
}

static TABLES: LazyLock<[Table; SIZES.len()]> = LazyLock::new(|| SIZES.map(Table::new));
static COARSE: LazyLock<Table> = LazyLock::new(Table::with_ends);

impl Table {
    fn new(n: usize) -> Self {
        let mut table = Self::default();
        // With z = cos θ at node n - 1 - j for θ = (2j + 1) π/2n.
        let angle = |eighths: usize| PI * eighths as f64 / (2 * n) as f64;
        let cosine = |k: usize, j: usize| angle((2 * (n - 1 - j) + 1) * k % (4 * n)).cos();
        for j in 0..n {
            // sin of a small angle of either sign, so that the nodes are symmetric.
            table.z[j] = ((2.0 * j as f64 + 1.0 - n as f64) * PI / (2 * n) as f64).sin();
            table.sine[j] = (1.0 - table.z[j] * table.z[j]).sqrt();
            for k in 0..n {
                table.transform[j][k] = if k == 0 { 1.0 } else { 2.0 * cosine(k, j) } / n as f64;
            }
            table.at_end[j] = table.transform[j][..n].iter().sum();
        }
        table.set_spacing(n);
        table
    }

    fn set_spacing(&mut self, n: usize) {
        self.spacing[0] = self.z[1] - self.z[0];
        for j in 1..n {
            self.spacing[j] = self.z[j] - self.z[j - 1];
            self.spacing[j - 1] = self.spacing[j - 1].min(self.spacing[j]);
        }
    }

    /// Returns the table of four nodes, two of them at the ends.
    fn with_ends() -> Self {
        let mut table = Self::default();
        table.z[..4].copy_from_slice(&[-1.0, -0.5, 0.5, 1.0]);
        table.set_spacing(4);
        for j in 0..4 {
            for k in 0..4 {
                let halved = |i: usize| if i == 0 || i == 3 { 0.5 } else { 1.0 };
                let cosine = (PI * (k * (3 - j)) as f64 / 3.0).cos();
                table.transform[j][k] = 2.0 / 3.0 * halved(j) * halved(k) * cosine;
            }
        }
        table
    }

    /// Returns the table for a first estimate. Its nodes include the ends, so that a panel next to
    /// a breakpoint is accurate where it matters, however long it is.
    pub fn coarse() -> &'static Self {
        &COARSE
    }

    /// Returns the table for one of the [`SIZES`].
    pub fn of(n: usize) -> &'static Self {
        &TABLES[SIZES.iter().position(|&size| size == n).unwrap_or(SIZES.len() - 1)]
    }

    /// Returns the share of each node in a sum of coefficients, each times a number.
    pub fn shares<const N: usize, T: Real>(&self, numbers: &[T; N]) -> [T; N] {
        std::array::from_fn(|j| {
            let row = self.transform[j][..N].iter().zip(numbers);
            row.fold(T::zero(), |sum, (&share, &number)| fma(number, T::of(share), sum))
        })
    }

    /// Returns the larger of the last two coefficients, after the larger of the two before.
    pub fn last_pairs<const N: usize, T: Real>(&self, values: &[T; N]) -> [T; 2] {
        let mut last = [T::zero(); 4];
        for (row, &value) in self.transform.iter().zip(values) {
            for k in 0..4 {
                last[k] = fma(value, T::of(row[N - 4 + k]), last[k]);
            }
        }
        let [a, b, c, d] = last.map(|a| a.abs());
        [a.max(b), c.max(d)]
    }

    /// Returns the coefficients of the polynomial with given values at the nodes.
    #[inline(always)]
    pub fn coefficients<const N: usize, T: Real>(&self, values: &[T; N]) -> [T; N] {
        let mut row = [T::zero(); N];
        for j in 0..N {
            for k in 0..N {
                row[k] = fma(values[j], T::of(self.transform[j][k]), row[k]);
            }
        }
        row
    }
}

/// Returns the polynomial and its derivative at W points (Clenshaw).
#[inline(always)]
pub(crate) fn evaluate<const W: usize, T: Real>(
    coefficients: &[T],
    s: &[T; W],
) -> ([T; W], [T; W]) {
    let twice: [T; W] = std::array::from_fn(|i| s[i] + s[i]);
    let zero = [[T::zero(); W]; 2];
    // Half the derivatives need no doubled values.
    let [[b1, d1], [b2, d2]] = clenshaw(&coefficients[1..], zero, |[b1, d1], [b2, d2], a| {
        for i in 0..W {
            b2[i] = fma(twice[i], b1[i], a - b2[i]);
            d2[i] = fma(twice[i], d1[i], b1[i] - d2[i]);
        }
    });
    let value = std::array::from_fn(|i| fma(s[i], b1[i], coefficients[0] - b2[i]));
    let slope = std::array::from_fn(|i| fma(twice[i], d1[i], b1[i] - (d2[i] + d2[i])));
    (value, slope)
}

/// Goes from the last coefficient to the first: each step replaces the last but one number of the
/// recurrence by the next. Returns the last two, the later one first.
#[inline(always)]
fn clenshaw<T: Copy, B: Copy>(coefficients: &[T], zero: B, step: impl Fn(&B, &mut B, T)) -> [B; 2] {
    let (mut b1, mut b2) = (zero, zero);
    let (pairs, last) = coefficients.as_chunks();
    for &a in last {
        step(&b2, &mut b1, a);
    }
    // Two steps at a time copy no number.
    for &[a, after] in pairs.iter().rev() {
        step(&b1, &mut b2, after);
        step(&b2, &mut b1, a);
    }
    [b1, b2]
}

/// Returns the polynomial at W points.
#[inline(always)]
pub(crate) fn values<const W: usize, T: Real>(coefficients: &[T], s: &[T; W]) -> [T; W] {
    let [b1, b2] = second_kind(&coefficients[1..], s);
    std::array::from_fn(|i| fma(s[i], b1[i], coefficients[0] - b2[i]))
}

/// Returns `Σ c_k U_k` and `Σ c_{k+1} U_k` at W points, with the Chebyshev polynomials `U_k` of the
/// second kind.
#[inline(always)]
pub(crate) fn second_kind<const W: usize, T: Real>(coefficients: &[T], s: &[T; W]) -> [[T; W]; 2] {
    let twice: [T; W] = std::array::from_fn(|i| s[i] + s[i]);
    clenshaw(coefficients, [T::zero(); W], |b1, b2, a| {
        for i in 0..W {
            b2[i] = fma(twice[i], b1[i], a - b2[i]);
        }
    })
}

/// Returns the polynomial at one point.
pub(crate) fn value_at<T: Real>(coefficients: &[T], s: T) -> T {
    values(coefficients, &[s])[0]
}

/// Returns an antiderivative, which has one coefficient more.
#[inline(always)]
pub(crate) fn primitive<T: Real>(coefficients: &[T]) -> [T; MAX_SIZE + 1] {
    let mut primitive = [T::zero(); MAX_SIZE + 1];
    // 2 ∫ T_k ds = T_{k+1}/(k+1) - T_{k-1}/(k-1), but T₁ of T₀, and T₂/4 of T₁.
    for (k, &before) in coefficients.iter().enumerate() {
        let after = coefficients.get(k + 2).copied().unwrap_or(T::zero());
        let before = if k == 0 { before + before } else { before };
        primitive[k + 1] = (before - after) / T::count(2 * k + 2);
    }
    primitive
}

/// Returns `Σ a_k uᵏ` for |u| < 1, up to the last power that counts.
pub(crate) fn power_series<T: Real>(coefficients: &[T], u: T) -> T {
    let (mut power, mut terms) = (u.abs(), 1);
    let last = power * T::epsilon();
    while power > last && terms < coefficients.len() {
        (power, terms) = (power * power, 2 * terms);
    }
    let length = &coefficients[..terms.min(coefficients.len())];
    length.iter().rev().fold(T::zero(), |sum, &a| sum * u + a)
}

/// Number of coefficients treated together; [`MAX_SIZE`] is a multiple of it.
const ABREAST: usize = 4;

/// Returns the coefficients of the same polynomial on the range from `left` to `right`, which need
/// not lie between -1 and 1.
///
/// Clenshaw's recurrence for `s = middle + reach t`. Each of its numbers is itself a series in t,
/// one term longer than the one before: `t T_k = (T_{k+1} + T_{k-1})/2`.
pub(crate) fn expand<T: Real>(coefficients: &[T], [left, right]: [T; 2]) -> Coeffs<T> {
    let half = T::of(0.5);
    let (middle, reach) = (half * (left + right), half * (right - left));
    // Coefficients from T_{-1} = T_1 on, all doubled, so that every term is treated alike.
    let [mut one, mut other] = [[T::zero(); MAX_SIZE + 2]; 2];
    let (mut b1, mut b2) = (&mut one, &mut other);
    for (length, a) in coefficients[1..].iter().rev().enumerate() {
        step(b1, b2, length, [middle + middle, reach], *a);
        std::mem::swap(&mut b1, &mut b2);
    }
    // The last step has half the factors of the others.
    step(b1, b2, coefficients.len() - 1, [middle, half * reach], coefficients[0]);
    b2[1] *= half;
    std::array::from_fn(|k| b2[k + 1])
}

/// Replaces the last but one number of the recurrence by the next; the last has `length` terms.
#[inline(always)]
fn step<T: Real>(
    b1: &[T; MAX_SIZE + 2],
    b2: &mut [T; MAX_SIZE + 2],
    length: usize,
    [by_middle, by_reach]: [T; 2],
    a: T,
) {
    for block in 0..(length / ABREAST + 1).min(MAX_SIZE / ABREAST) {
        let first = ABREAST * block;
        let around: [T; ABREAST + 2] = std::array::from_fn(|i| b1[first + i]);
        let next: [T; ABREAST] = std::array::from_fn(|i| {
            let beside = fma(by_reach, around[i] + around[i + 2], -b2[first + 1 + i]);
            fma(by_middle, around[i + 1], beside)
        });
        b2[first + 1..=first + ABREAST].copy_from_slice(&next);
    }
    b2[1] += a + a;
    b2[0] = b2[2];
}

/// Longest move of either end of a range, as a share of its half-width, that takes few terms.
const MAX_MOVE: f64 = 2e-3;

/// Most terms of a move.
const MAX_MOVE_TERMS: usize = 8;

/// Replaces a series of N coefficients by the same polynomial on the range from `left - 1` to
/// `right + 1`; `false` if that takes longer than to [expand] it.
///
/// The substitution `z -> z + δ + λ z` is `exp((α + β z) d/dz)` with `β = ln(1 + λ)`, `α = δ β/λ`.
pub(crate) fn moved<const N: usize, T: Real>(row: &mut Coeffs<T>, [left, right]: [T; 2]) -> bool {
    if left.abs().max(right.abs()) > T::of(MAX_MOVE) {
        return false;
    }
    let half = T::of(0.5);
    let [shift, wider] = [half * (left + right), half * (right - left)];
    // ln(1 + λ)/λ
    let share = (1..=8).rev().fold(T::zero(), |sum, k| T::count(k).recip() - wider * sum);
    let size = |row: &Coeffs<T>| row[..N].iter().fold(T::zero(), |sum, a| sum + a.abs());
    let (mut term, mut before, mut exact) = (*row, size(row), 0);
    let (mut sum, nothing) = (term, T::of(0.125) * T::epsilon() * before);
    for count in 1..=MAX_MOVE_TERMS {
        let slopes = derivative::<N, T>(&term);
        let [along, beside] = [shift, half * wider].map(|by| share * by / T::count(count));
        for k in 0..N {
            term[k] = along * slopes[k + 1] + beside * (slopes[k] + slopes[k + 2]);
            sum[k] += term[k];
        }
        term[0] *= half;
        sum[0] -= term[0];
        let here = size(&term);
        // The terms fall at least as fast as from the last to this one. Each further term makes one
        // more derivative exact.
        exact += usize::from(here * here <= nothing * before);
        if exact > T::DERIVATIVE_ORDER {
            *row = sum;
            return true;
        }
        before = here;
    }
    false
}

/// Returns the coefficients of the derivative of a series of N, from `T_{-1} = T_1` on. The
/// coefficient of `T_0` is doubled: in a recurrence every term is then treated alike.
#[inline(always)]
pub(crate) fn derivative<const N: usize, T: Real>(row: &Coeffs<T>) -> [T; MAX_SIZE + 2] {
    let mut slopes = [T::zero(); MAX_SIZE + 2];
    for k in (1..N).rev() {
        slopes[k] = slopes[k + 2] + T::of(2.0 * k as f64) * row[k];
    }
    slopes[0] = slopes[2];
    slopes
}

/// Returns the smallest of the [`SIZES`] that holds n coefficients.
pub(crate) fn size_for(n: usize) -> usize {
    SIZES.into_iter().find(|&size| size >= n).unwrap_or(MAX_SIZE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_moved_series_is_the_one_expanded_anew() {
        // A steep slope and a root nearby: coefficients that fall slowly.
        let function = |z: f64| 3.0 * z + (1.2 + z).sqrt();
        let values: [f64; 32] = std::array::from_fn(|j| function(Table::of(32).z[j]));
        let series: Coeffs<f64> = Table::of(32).coefficients(&values);
        for ends in [[1e-3, -2e-3], [-2e-3, 2e-3], [1e-6, 2e-6], [2e-3, 2e-3], [0.0, 0.0]] {
            let mut row = series;
            assert!(moved::<32, f64>(&mut row, ends), "{ends:?}");
            let anew = expand(&series, [ends[0] - 1.0, ends[1] + 1.0]);
            for (k, (one, other)) in row.iter().zip(&anew).enumerate() {
                assert!((one - other).abs() < 1e-14, "{ends:?} {k}: {one:e} {other:e}");
            }
        }
        let mut row = series;
        assert!(!moved::<32, f64>(&mut row, [0.01, 0.0]) && row == series);
        assert!(!moved::<32, f64>(&mut row, [f64::NAN, 0.0]));
    }
}
