//! The edge integrals of the gap slope.
//!
//! In `x = c + L cos θ` the weights of the edge strengths become 1 and cos θ, and the integrand is
//! smooth between the breakpoints of the profiles. Therefore θ is split there, and each panel is
//! integrated by Fejér's second rule: interpolation at `cos(jπ/m)`, j = 1 ... m-1, which never
//! touches an end of a panel (a slope may jump or be infinite there), and whose points are kept
//! when m is doubled.
//!
//! m is doubled until two results differ by less than `ε^(5/8)` of the integral of `|g|`. For
//! a slope analytic on the panel the error is then about the square of that difference, so
//! the last result is good to rounding.
//!
//! Users' formulas have noise of their own: the paper's Examples 3 to 5 cancel terms of order 10
//! over a contact of size 1e-3. It shows in the highest coefficients of the interpolant, which for
//! a smooth slope have sunk into it: the coefficients of a panel of m points with noise σ level off
//! at about σ/sqrt(m), and its integral is uncertain by about twice that level. If the interpolant
//! has not converged, the same coefficients measure its error.

use crate::gap::{Gap, Sampler};
use crate::quadrature::Moments;
use crate::{Fallible, Interval, Real};
use std::f64::consts::PI;
use std::sync::LazyLock;

/// Fewest and most intervals of a panel, both powers of two.
const FEWEST_INTERVALS: usize = 8;
const FINEST: usize = 256;

/// Weights of Fejér's second rule on [-1, 1] with m intervals, m = 8, 16 ... 256.
static WEIGHTS: LazyLock<Vec<Vec<f64>>> = LazyLock::new(|| {
    let rules = std::iter::successors(Some(FEWEST_INTERVALS), |m| Some(2 * m));
    rules.take_while(|&m| m <= FINEST).map(fejer).collect()
});

/// Returns the weights of Fejér's second rule (Fejér, *Math. Z.* 37 (1933) 287), in the closed form
/// of Waldvogel, *BIT Numer. Math.* 46 (2006) 195, Eq. (2.3).
fn fejer(m: usize) -> Vec<f64> {
    let weight = |j: usize| {
        let phi = PI * j as f64 / m as f64;
        let sum: f64 = (1..=m / 2).map(|i| (2 * i - 1) as f64).map(|i| (i * phi).sin() / i).sum();
        4.0 * phi.sin() * sum / m as f64
    };
    (1..m).map(weight).collect()
}

/// Integrates the slope over `on`, a panel at a time.
pub(super) fn moments<T: Real>(
    sampler: &mut Sampler<T>,
    gap: &Gap<'_, T>,
    on: Interval<T>,
) -> Fallible<T, Moments<T>> {
    let mut angles: Vec<T> = vec![T::pi()];
    angles.extend(gap.breakpoints(on).map(|x| on.angle(x)));
    angles.push(T::zero());
    angles.reverse();

    sampler.missed = T::zero();
    let mut panels = Vec::with_capacity(angles.len() - 1);
    for ends in angles.windows(2).filter(|ends| ends[0] < ends[1]) {
        let mut panel = Segment::new(ends[0], ends[1]);
        panel.refine(sampler, gap, on)?;
        panels.push(panel);
    }
    let small = T::epsilon().powf(T::of(0.625));
    for i in 0..panels.len() {
        loop {
            let size = total(&panels, |panel| panel.sums[2]);
            if panels[i].change <= small * size || !panels[i].refine(sampler, gap, on)? {
                break;
            }
        }
    }
    let [mean, first, size] = [0, 1, 2].map(|i| total(&panels, |panel| panel.sums[i]));
    // At a kink the remaining coefficients add up, however little the last rule has changed.
    let left_open = |panel: &Segment<T>| panel.plateau() * T::of(4.0);
    let error = total(&panels, left_open).max(T::of(4.0) * T::epsilon() * size);
    Ok(Moments {
        m0: mean,
        m1: first,
        m2: None,
        l1_norm: size,
        error,
        inversion: sampler.missed,
        derivatives: None,
    })
}

fn total<T: Real>(panels: &[Segment<T>], part: impl Fn(&Segment<T>) -> T) -> T {
    panels.iter().fold(T::zero(), |sum, panel| sum + part(panel))
}

/// Range of θ without a breakpoint, and the slope sampled on it.
struct Segment<T> {
    from: T,
    to: T,
    /// Index into `WEIGHTS` of the rule to use next.
    rule: usize,
    /// Samples at the points of the finest rule, taken as needed.
    slope: [Option<T>; FINEST],
    /// Integrals of g, g cos θ and |g|, divided by π.
    sums: [T; 3],
    /// Largest change of the first two at the last refinement.
    change: T,
}

impl<T: Real> Segment<T> {
    fn new(from: T, to: T) -> Self {
        let sums = [T::zero(); 3];
        Self { from, to, rule: 0, slope: [None; FINEST], sums, change: T::zero() }
    }

    /// Returns the error of the integrals by the highest coefficients of the interpolant.
    fn plateau(&self) -> T {
        let m = FEWEST_INTERVALS << (self.rule - 1);
        let sine = |i: usize| T::of((PI * (i % (2 * m)) as f64 / m as f64).sin());
        let coefficient = |degree: usize| {
            let slope = |i: usize| self.slope[i * (FINEST / m)].unwrap_or_else(T::zero);
            let term = |sum, i| sum + slope(i) * sine(i) * sine(i * degree);
            (1..m).fold(T::zero(), term) * T::of(2.0) / T::count(m)
        };
        let highest = (m - 4..m).map(coefficient).fold(T::zero(), |max, c| max.max(c.abs()));
        highest * (self.to - self.from) / T::pi()
    }

    /// Applies the next rule; `false` when there is none.
    fn refine(
        &mut self,
        sampler: &mut Sampler<T>,
        gap: &Gap<'_, T>,
        on: Interval<T>,
    ) -> Fallible<T, bool> {
        let Some(weights) = WEIGHTS.get(self.rule) else { return Ok(false) };
        let stride = FINEST / (weights.len() + 1);
        let width = self.to - self.from;
        let mut sums = [T::zero(); 3];
        for (j, &weight) in weights.iter().enumerate() {
            let index = (j + 1) * stride;
            // (1 - cos φ)/2 = sin²(φ/2), exact next to either end of the panel.
            let half = T::of(0.5 * PI * index as f64 / FINEST as f64);
            let theta = if 2 * index < FINEST {
                self.from + width * half.sin().powi(2)
            } else {
                self.to - width * half.cos().powi(2)
            };
            let slope = match self.slope[index] {
                Some(slope) => slope,
                None => *self.slope[index].insert(sampler.slope(gap, on.at_angle(theta))?),
            };
            let term = T::of(weight) * slope;
            sums[0] += term;
            sums[1] += term * theta.cos();
            sums[2] += term.abs();
        }
        let scale = T::of(0.5) * width / T::pi();
        let sums = sums.map(|sum| sum * scale);
        self.change = (sums[0] - self.sums[0]).abs().max((sums[1] - self.sums[1]).abs());
        if self.rule == 0 {
            // Nothing to compare with yet.
            self.change = T::max_value().unwrap_or(sums[2] / T::epsilon());
        }
        self.sums = sums;
        self.rule += 1;
        Ok(true)
    }
}
