//! Sums over wavenumbers, and the harmonics of a pressure in an interval.
//!
//! On an interval of centre c and half-width L, with `x = c + L cos θ`,
//!
//! ```text
//! P = (1/(π L sin θ)) Σ q_k cos kθ      P̂(ω) = exp(-iωc) Σ q_k (-i)ᵏ J_k(ωL)
//! exp(iωx) = exp(iωc) Σ ε_k iᵏ J_k(ωL) cos kθ                            ε₀ = 1, else 2
//! ```
//!
//! (Jacobi and Anger.) Both need only `J_k(ωL) exp(iωc) iᵏ`, and no other sine or cosine.

use super::SurfaceCompliance;
use crate::numerics::chebyshev::value_at;
use crate::numerics::dot;
use crate::numerics::gauss_legendre::GaussLegendre;
use crate::{Interval, Real};
use std::sync::{Arc, OnceLock};

/// Number of nodes of a panel of wavenumbers, and the phase that they resolve.
const PHASE: f64 = 12.0;

/// Width of the first panel, in units of the longest length, and the growth of the others.
const FIRST: f64 = 0.8;
const GROWTH: f64 = 2.5;

/// Power by which low wavenumbers are kept where only they reach, and the range of wavenumbers
/// kept, times the distance: the rest is left out to 1e-16.
const FLATNESS: i32 = 12;
const KEPT: f64 = 48.0;
const BEYOND: f64 = 6.5;

/// Pressure in one interval by its coefficients q_k, `P = Σ q_k cos kθ/(π L sin θ)`.
#[derive(Clone)]
pub(crate) struct Spread<T> {
    pub on: Interval<T>,
    pub q: Vec<T>,
}

impl<T: Real> Spread<T> {
    /// Returns the same pressure, multiplied by a factor.
    pub fn times(&self, factor: T) -> Self {
        Self { on: self.on, q: self.q.iter().map(|&q| factor * q).collect() }
    }

    /// Lists the nodes of a Gauss-Chebyshev rule, each with its weight times `P w`.
    pub fn nodes(&self) -> impl Iterator<Item = [T; 2]> {
        let (n, Interval { left, right }) = (self.q.len(), self.on);
        let (centre, half_width) = (T::of(0.5) * (left + right), T::of(0.5) * (right - left));
        (0..n).map(move |i| {
            let cos = (T::pi() * (T::count(i) + T::of(0.5)) / T::count(n)).cos();
            [centre + half_width * cos, value_at(&self.q, cos) / T::count(n)]
        })
    }
}

/// Rule in ω: its nodes, and its weights times K - 1.
pub(crate) struct Rule<T> {
    pub omega: Vec<T>,
    pub weights: Vec<T>,
    /// `∫ (K - 1)/ω (exp(-ω y) - exp(-ω c)) dω` for the distance y of this level.
    offset: T,
    /// `exp(-ω y)` at the nodes, each times its weight over ω, and before low wavenumbers are kept.
    levelled: Vec<T>,
}

impl<T: Real> Rule<T> {
    /// Creates the rule for distances `|x - s|` from `least` to `most`.
    fn new(of: &dyn SurfaceCompliance<T>, [least, most]: [T; 2]) -> Self {
        let (decay, distance) = (of.decay(), least.max(of.decay()));
        let kept = T::of(KEPT) / least;
        let whole = top(decay);
        let is_kept = T::of(BEYOND) * kept < whole;
        let end = if is_kept { T::of(BEYOND) * kept } else { whole };
        let (mut omega, mut weights, mut levelled) = (Vec::new(), Vec::new(), Vec::new());
        let first = T::of(FIRST) / of.longest().max(most * T::of(FIRST / PHASE));
        panels([first, T::of(PHASE) / most], end, |at, weight| {
            let weight = weight * of.excess(at);
            let share = if is_kept {
                let square = (at / kept) * (at / kept);
                T::one() - (-(-square).exp_m1()).powi(FLATNESS)
            } else {
                T::one()
            };
            omega.push(at);
            weights.push(weight * share);
            levelled.push(weight / at * (-at * distance).exp());
        });
        let mut offset = T::zero();
        if distance > decay {
            let first = T::of(FIRST) / of.longest().max(distance);
            panels([first, T::one() / T::zero()], whole, |at, weight| {
                let change = (-at * decay).exp() * (at * (decay - distance)).exp_m1();
                offset += weight * of.excess(at) / at * change;
            });
        }
        Self { omega, weights, offset, levelled }
    }

    /// Tells at which wavenumber K is not a positive number, if at any.
    fn fault(&self, of: &dyn SurfaceCompliance<T>) -> Option<T> {
        let is_positive = |at: &&T| {
            let excess = of.excess(**at);
            excess.is_finite() && excess > -T::one()
        };
        self.omega.iter().find(|at| !is_positive(at)).copied()
    }

    /// Returns P̂, its real parts before its imaginary ones, of the sum of some pressures.
    pub fn transform(&self, spreads: &[Spread<T>]) -> Transform<T> {
        let harmonics = spreads.iter().map(|Spread { on, q }| Harmonics::new(self, *on, q.len()));
        self.sum(&harmonics.collect::<Vec<_>>(), spreads)
    }

    /// Returns P̂ of the sum of some pressures, given the harmonics of their intervals.
    pub fn sum(&self, harmonics: &[Harmonics<T>], spreads: &[Spread<T>]) -> Transform<T> {
        let (mut parts, mut load) = (vec![T::zero(); 2 * self.omega.len()], T::zero());
        for (harmonics, Spread { q, .. }) in harmonics.iter().zip(spreads) {
            load += q[0];
            harmonics.add(q, &mut parts);
        }
        Transform { parts, load }
    }

    /// Returns `∫ r dx` at x, up to a constant that is the same for all rules.
    pub fn height(&self, of: &Transform<T>, x: T) -> T {
        let (real, imaginary) = of.parts.split_at(self.omega.len());
        let mut sum = self.offset * of.load;
        for (i, &omega) in self.omega.iter().enumerate() {
            let (sin, cos) = (omega * x).sin_cos();
            let wave = cos * real[i] - sin * imaginary[i];
            sum += self.weights[i] / omega * wave - self.levelled[i] * of.load;
        }
        -sum
    }

    /// Returns r at x.
    pub fn slope(&self, of: &Transform<T>, x: T) -> T {
        let (real, imaginary) = of.parts.split_at(self.omega.len());
        let term = |i: usize| {
            let (sin, cos) = (self.omega[i] * x).sin_cos();
            self.weights[i] * (sin * real[i] + cos * imaginary[i])
        };
        (0..self.omega.len()).map(term).fold(T::zero(), |sum, term| sum + term)
    }
}

/// Returns the wavenumber from which on K - 1 is below rounding: its factor `ξ²` is at most 400.
fn top<T: Real>(decay: T) -> T {
    (T::of(6.0) - T::epsilon().ln()) / decay
}

/// Calls a function for the nodes and weights of Gauss rules on panels from 0 to `end`, given the
/// width of the first panel and the largest width.
fn panels<T: Real>([first, widest]: [T; 2], end: T, mut node: impl FnMut(T, T)) {
    let rule = GaussLegendre::sixteen();
    let (mut from, mut width) = (T::zero(), first);
    while from < end {
        let to = (from + width.min(widest)).min(end);
        let half = T::of(0.5) * (to - from);
        for i in 0..rule.n {
            node(from + half * (T::one() + T::of(rule.nodes[i])), half * T::of(rule.weights[i]));
        }
        (from, width) = (to, T::of(GROWTH) * width.min(to));
    }
}

/// Fourier transform of a pressure at the nodes of a rule.
#[derive(Clone)]
pub(crate) struct Transform<T> {
    pub parts: Vec<T>,
    load: T,
}

impl<T: Real> Transform<T> {
    /// Returns the transform of a `cos kθ/(π L sin θ)`, given its parts.
    pub fn of(parts: Vec<T>, k: usize) -> Self {
        Self { parts, load: if k == 0 { T::one() } else { T::zero() } }
    }

    /// Returns the difference of two.
    pub fn less(&self, other: &Self) -> Self {
        let parts = self.parts.iter().zip(&other.parts).map(|(&one, &other)| one - other);
        Self { parts: parts.collect(), load: self.load - other.load }
    }
}

/// `J_k(ωL) exp(iωc) iᵏ` of an interval at the nodes of a rule, by k: the real parts of all ω, then
/// the imaginary ones.
pub(crate) struct Harmonics<T> {
    rows: Vec<Vec<T>>,
}

impl<T: Real> Harmonics<T> {
    pub fn new(rule: &Rule<T>, on: Interval<T>, n: usize) -> Self {
        let (centre, half_width, count) = (on.centre(), on.half_width(), rule.omega.len());
        let mut rows = vec![vec![T::zero(); 2 * count]; n];
        let mut bessel = vec![T::zero(); n];
        for (j, &omega) in rule.omega.iter().enumerate() {
            bessel_row(omega * half_width, &mut bessel);
            let (sin, cos) = (omega * centre).sin_cos();
            let mut turned = [cos, sin];
            for (row, &value) in rows.iter_mut().zip(&bessel) {
                (row[j], row[count + j]) = (turned[0] * value, turned[1] * value);
                turned = [-turned[1], turned[0]];
            }
        }
        Self { rows }
    }

    /// Keeps only the first harmonics.
    pub fn truncate(&mut self, count: usize) {
        self.rows.truncate(count);
    }

    /// Adds P̂ of the pressure with these coefficients.
    fn add(&self, q: &[T], parts: &mut [T]) {
        let count = parts.len() / 2;
        let (real, imaginary) = parts.split_at_mut(count);
        for (&q, row) in q.iter().zip(&self.rows) {
            let (u, v) = row.split_at(count);
            real.iter_mut().zip(u).for_each(|(sum, &u)| *sum += q * u);
            imaginary.iter_mut().zip(v).for_each(|(sum, &v)| *sum -= q * v);
        }
    }

    /// Returns the weights times these harmonics, for `series`.
    pub fn weighted(&self, rule: &Rule<T>) -> Self {
        let count = rule.omega.len();
        let weighted = |(k, row): (usize, &Vec<T>)| {
            let share = if k == 0 { T::one() } else { T::of(2.0) };
            // Those of the real parts are the imaginary parts of the harmonics.
            let at = |i: usize| share * rule.weights[i % count] * row[(i + count) % (2 * count)];
            (0..2 * count).map(at).collect()
        };
        Self { rows: self.rows.iter().enumerate().map(weighted).collect() }
    }

    /// Returns the Chebyshev coefficients of r on the interval of these weighted harmonics.
    pub fn series(&self, parts: &[T]) -> Vec<T> {
        self.rows.iter().map(|row| dot(row, parts)).collect()
    }

    /// Returns the first coefficients of [`series`](Self::series).
    pub fn first(&self, terms: usize, parts: &[T]) -> Vec<T> {
        self.rows[..terms].iter().map(|row| dot(row, parts)).collect()
    }

    /// Returns P̂ of `cos kθ/(π L sin θ)`.
    pub fn of_one(&self, k: usize) -> Vec<T> {
        let count = self.rows[k].len() / 2;
        self.rows[k].iter().enumerate().map(|(i, &a)| if i < count { a } else { -a }).collect()
    }
}

/// Fills in J_0(z), J_1(z), … for z > 0, by Miller's recurrence from far above.
fn bessel_row<T: Real>(z: T, row: &mut [T]) {
    let (zero, two) = (T::zero(), T::of(2.0));
    // J_k falls faster than exponentially beyond max(n, z).
    let large = T::count(row.len()).max(z.component(0));
    let mut start = row.len();
    while T::count(start) < large + T::of(8.0) * large.cbrt() + T::of(12.0) {
        start += 1;
    }
    let huge = T::one() / T::epsilon().powi(4);
    let (mut above, mut here, mut sum) = (zero, T::epsilon(), zero);
    for k in (0..start).rev() {
        let below = two * T::count(k + 1) / z * here - above;
        (above, here) = (here, below);
        if k < row.len() {
            row[k] = here;
        }
        if k % 2 == 0 {
            sum += if k == 0 { here } else { here + here };
        }
        if here.abs() > huge {
            let scale = here.abs().recip();
            (above, here, sum) = (above * scale, here * scale, sum * scale);
            row.iter_mut().skip(k).for_each(|value| *value *= scale);
        }
    }
    row.iter_mut().for_each(|value| *value /= sum);
}

/// Rules for distances that double, each made when it is needed.
pub(crate) struct Levels<T> {
    pub of: Arc<dyn SurfaceCompliance<T>>,
    /// Length of the contacts for which the rules serve.
    pub reach: T,
    rules: Vec<OnceLock<Rule<T>>>,
}

/// Factor between the lengths of contacts for which rules are made.
const GROWTH_OF_REACH: f64 = 1.25;

/// Number of levels: bodies up to 2⁴⁸ times as long as K - 1 falls.
pub(crate) const LEVELS: usize = 48;

impl<T: Real> Levels<T> {
    /// Creates the levels for contacts of a length, and returns the fault of the compliance: the
    /// wavenumber, if it is not a positive number there.
    pub fn new(of: Arc<dyn SurfaceCompliance<T>>, length: T) -> Result<Self, T> {
        let mut reach = of.decay();
        while reach < length {
            reach *= T::of(GROWTH_OF_REACH);
        }
        let rules = (0..LEVELS).map(|_| OnceLock::new()).collect();
        let levels = Self { of, reach, rules };
        let fault = levels.rule(0).fault(&*levels.of);
        fault.map_or(Ok(levels), Err)
    }

    /// Tells whether these rules serve contacts of a length.
    pub fn serves(&self, length: T) -> bool {
        let least = self.reach / (T::of(GROWTH_OF_REACH) * T::of(GROWTH_OF_REACH));
        length <= self.reach && (length > least || self.reach <= self.of.decay())
    }

    /// Returns the least and the largest distance from the contacts at which a level serves.
    pub fn distances(&self, level: usize) -> [T; 2] {
        let at = |level: usize| self.of.decay() * (T::of(2.0).powi(level as i32) - T::one());
        // Two doublings share the first level.
        if level == 0 { [T::zero(), at(2)] } else { [at(level + 1), at(level + 2)] }
    }

    /// Returns a rule: the first is for the contacts themselves.
    pub fn rule(&self, level: usize) -> &Rule<T> {
        self.rules[level].get_or_init(|| {
            let [least, most] = self.distances(level);
            Rule::new(&*self.of, [least, most + self.reach])
        })
    }
}
