//! The kernel of `x - s` that a compliance by wavenumber has, tabulated.
//!
//! ```text
//! K(x, s) = Γ(x - s)     Γ(y) = ∫ (K(ω) - 1) sin ωy dω     over ω > 0
//! ```
//!
//! In a row of contacts, one in each period p, the wavenumbers are `2πn/p`, each with the weight
//! `2π/p`, and Γ is odd about p/2, too.
//!
//! Γ is odd, and its nearest singularities are those at `±ic`, with c the decay of K - 1. It is a
//! Chebyshev series on each of some panels that grow with the distance, made when it is asked for,
//! once for each scene.

use super::{RegularKernel, SurfaceCompliance};
use crate::Real;
use crate::numerics::chebyshev::{Table as Nodes, primitive, value_at, values};
use crate::numerics::dot;
use crate::numerics::gauss_legendre::GaussLegendre;
use std::sync::{Arc, OnceLock};

/// Ends of the first panels, in units of c, and the growth of the others: on each a series of 20
/// terms leaves an error of 1e-16.
const FIRST_ENDS: [f64; 3] = [0.5, 1.0, 2.0];
const GROWTH: f64 = 1.75;

/// Largest number of terms of a panel.
const PANEL_TERMS: usize = 24;

/// Number of values that are summed together.
const LANES: usize = 8;

/// Number of panels: distances up to 1e18 c.
const PANELS: usize = 78;

/// Width of the first panel of wavenumbers, times the longest length on which K changes; the growth
/// of the others; and the phase that their sixteen nodes resolve.
const FIRST_WIDTH: f64 = 0.8;
const WIDTH_GROWTH: f64 = 2.5;
const PHASE: f64 = 12.0;

/// Wavenumbers that count at a distance y or more: those above 48/y are left out smoothly, by a
/// factor `1 - (1 - exp(-(ωy/48)²))¹²`. It is 1 at ω = 0 but for a term in `ω²⁴`, which with the
/// singularity of Γ at infinity leaves an error of `24!/48²⁴`, 3e-17, and 1e-17 at 6.5 times that
/// ω.
const KEPT: f64 = 48.0;
const FLATNESS: i32 = 12;
const BEYOND: f64 = 6.5;

/// Γ and its integral.
pub(crate) struct Table<T> {
    of: Arc<dyn SurfaceCompliance<T>>,
    period: Option<T>,
    /// Distances on each panel.
    spans: Vec<[T; 2]>,
    rows: Vec<OnceLock<[Vec<T>; 2]>>,
}

impl<T: Real> Table<T> {
    /// Creates the table of a compliance, for a row of contacts if a period is given; the
    /// wavenumber, if K is not a positive number there.
    pub fn new(of: Arc<dyn SurfaceCompliance<T>>, period: Option<T>) -> Result<Self, T> {
        let decay = of.decay();
        let mut ends: Vec<T> = FIRST_ENDS.iter().map(|&end| T::of(end) * decay).collect();
        while ends.len() < PANELS {
            ends.push(T::of(GROWTH) * ends[ends.len() - 1]);
        }
        if let Some(period) = period {
            let half = T::of(0.5) * period;
            ends.retain(|&end| end < half);
            ends.push(half);
        }
        let mut fault = None;
        wavenumbers([decay, of.longest()], None, [T::zero(), ends[0]], |omega, _| {
            let compliance = T::one() + of.excess(omega);
            if !(compliance.is_finite() && compliance > T::zero()) {
                fault = fault.or(Some(omega));
            }
        });
        let rows = ends.iter().map(|_| OnceLock::new()).collect();
        let span = |from: &mut T, to: T| Some([std::mem::replace(from, to), to]);
        let spans = ends.into_iter().scan(T::zero(), span).collect();
        fault.map_or(Ok(Self { of, period, spans, rows }), Err)
    }

    /// Returns K(ω) - 1.
    pub fn excess(&self, wavenumber: T) -> T {
        self.of.excess(wavenumber)
    }

    /// Returns the panel of a difference `x - s`, sought first at a known one, the place in it from
    /// -1 to 1, and the sign of Γ.
    #[inline(always)]
    fn place(&self, difference: T, near: usize) -> (usize, T, T) {
        let (mut distance, mut sign) = (difference.abs(), T::one());
        if let Some(period) = self.period {
            distance -= period * (distance / period).floor();
            if distance > T::of(0.5) * period {
                (distance, sign) = (period - distance, -sign);
            }
        }
        let [from, to] = self.spans[near];
        let is_near = distance > from && distance <= to;
        let last = self.spans.len() - 1;
        let sought = || self.spans.iter().position(|span| distance <= span[1]).unwrap_or(last);
        let panel = if is_near { near } else { sought() };
        let [from, to] = self.spans[panel];
        // An endless body is as far as the last panel.
        let z = ((distance.min(to) - from) - (to - distance.min(to))) / (to - from);
        (panel, z, if difference < T::zero() { -sign } else { sign })
    }

    /// Returns the sum of Γ, or of its integral, over loads at some places. Neighbours on one panel
    /// are summed together.
    pub fn sums<const N: usize>(&self, which: [usize; N], x: T, loads: &[[T; 2]]) -> [T; N] {
        let (mut totals, mut z, mut weights) =
            ([T::zero(); N], [T::zero(); LANES], [[T::zero(); LANES]; 2]);
        let (mut count, mut on) = (0, 0);
        let mut flush = |panel: usize, z: &[T; LANES], weights: &mut [[T; LANES]; 2]| {
            let row = self.row(panel);
            for (total, which) in totals.iter_mut().zip(which) {
                *total += dot(&values(&row[which], z), &weights[which]);
            }
            *weights = [[T::zero(); LANES]; 2];
        };
        for &[s, load] in loads {
            let (panel, place, sign) = self.place(x - s, on);
            if count == LANES || count > 0 && panel != on {
                flush(on, &z, &mut weights);
                count = 0;
            }
            (on, z[count]) = (panel, place);
            // Γ is odd, and its integral is even.
            (weights[0][count], weights[1][count]) = (sign * load, load);
            count += 1;
        }
        if count > 0 {
            flush(on, &z, &mut weights);
        }
        totals
    }

    fn row(&self, panel: usize) -> &[Vec<T>; 2] {
        self.rows[panel].get_or_init(|| {
            let [from, to] = self.spans[panel];
            let nodes = Nodes::of(PANEL_TERMS);
            let half = T::of(0.5) * (to - from);
            let mut values = [T::zero(); PANEL_TERMS];
            let lengths = [self.of.decay(), self.of.longest()];
            wavenumbers(lengths, self.period, [from, to], |omega, weight| {
                let weight = weight * self.of.excess(omega);
                for (value, &z) in values.iter_mut().zip(&nodes.z) {
                    *value += weight * (omega * (from + half * (T::one() + T::of(z)))).sin();
                }
            });
            let series = nodes.coefficients(&values);
            let largest = series.iter().fold(T::zero(), |most, a| most.max(a.abs()));
            let counts = |a: &T| a.abs() > T::of(0.25) * T::epsilon() * largest;
            let terms = series.iter().rposition(counts).map_or(1, |last| last + 1);
            let mut integral = primitive(&series[..terms])[..=terms].to_vec();
            integral.iter_mut().for_each(|a| *a *= half);
            let before =
                panel.checked_sub(1).map(|before| value_at(&self.row(before)[1], T::one()));
            integral[0] = before.unwrap_or(T::zero()) - value_at(&integral, -T::one());
            [series[..terms].to_vec(), integral]
        })
    }
}

impl<T: Real> RegularKernel<T> for Table<T> {
    fn slope(&self, x: T, s: T) -> T {
        let (panel, z, sign) = self.place(x - s, 0);
        sign * value_at(&self.row(panel)[0], z)
    }

    fn height(&self, x: T, s: T) -> T {
        let (panel, z, _) = self.place(x - s, 0);
        value_at(&self.row(panel)[1], z)
    }

    fn nearest_singularity(&self) -> T {
        self.of.decay()
    }
}

/// Calls a function for the nodes and the weights of a rule in ω, rising, for a compliance with a
/// decay and a longest length, and distances from `least` to `most`; or for the wavenumbers of a
/// period.
pub(crate) fn wavenumbers<T: Real>(
    [decay, longest]: [T; 2],
    period: Option<T>,
    [least, most]: [T; 2],
    mut node: impl FnMut(T, T),
) {
    let kept = T::of(KEPT) / least;
    // There K - 1 is below rounding: it has a factor ξ², at most 400.
    let whole = (T::of(6.0) - T::epsilon().ln()) / decay;
    if let Some(period) = period {
        let step = T::two_pi() / period;
        let omegas = (1..).map(|n| step * T::count(n)).take_while(|&omega| omega < whole);
        return omegas.for_each(|omega| node(omega, step));
    }
    let is_cut = T::of(BEYOND) * kept < whole;
    let end = if is_cut { T::of(BEYOND) * kept } else { whole };
    let (rule, widest) = (GaussLegendre::sixteen(), T::of(PHASE) / most);
    let (mut from, mut width) = (T::zero(), T::of(FIRST_WIDTH) / longest);
    while from < end {
        let to = (from + width.min(widest)).min(end);
        let half = T::of(0.5) * (to - from);
        for i in 0..rule.n {
            let omega = from + half * (T::one() + T::of(rule.nodes[i]));
            let square = (omega / kept) * (omega / kept);
            let left = if is_cut { (-(-square).exp_m1()).powi(FLATNESS) } else { T::zero() };
            node(omega, half * T::of(rule.weights[i]) * (T::one() - left));
        }
        (from, width) = (to, T::of(WIDTH_GROWTH) * width.min(to));
    }
}
