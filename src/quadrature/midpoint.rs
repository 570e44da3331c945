//! The paper's quadrature: the midpoint rule, extrapolated, at any x.
//!
//! With `x = c + L z` the Cauchy integral is `I(x) = L PV∫ h(t)/(z - t) dt` over [-1, 1] with
//! `h(t) = sqrt(1 - t²) g(c + L t)`. Let N be the number of segments and w = 2/N.
//!
//! **ET = 0** is the trapezoidal sum of Eq. (17): the point at the pole is left out, which costs
//! about `w h'(z)`. **ET = 1** (Eq. (20)) combines two of these so that the left-out points
//! cancel, and what remains is the midpoint rule `M_N`; **ET = 2** (Eq. (26)) is
//! `(4 M_2N - M_N)/3`, and each further extrapolation takes away one more power of w.
//!
//! **Any x.** The paper's rule is meant for z on the grid `-1 + 2i/N`, where the two neighbours
//! of the pole cancel. Elsewhere the sum has a pole at each of its points, and the integral has
//! not. The term that makes up for it is known, and keeps the order of the rule:
//!
//! ```text
//! PV∫ h(t)/(z - t) dt ≈ M_N - π h(z) cot(π (z - t₀)/w),    t₀ any of the points
//! ```
//!
//! Close to a point t_j both parts are large and cancel. Their finite difference is
//! `-w [z, t_j]h` plus `h(z) (1/δ - π cot πδ)`, δ = (z - t_j)/w, and the divided difference
//! `[z, t_j]h` is formed from `sqrt(1 - t²)`, where it is exact, and from `g`. That of `g` is an
//! even analytic function of its spread, so where the two points are too close to be
//! subtracted it is read off three wider spreads about the same middle.
//!
//! **The exponents.** The error expands in w², w⁴, ... if h is smooth at both ends, as in the
//! paper's Example 1. Where `g` does not vanish at an edge (any free edge), h ends like a square
//! root and the error expands in w^{3/2}, w^{5/2}, ...: then the paper's extrapolation gains a
//! factor 7 and no order, and [`Exponents::HalfOdd`] restores it. A joint inside the contact
//! breaks either expansion unless it lies on the grid.
//!
//! **Next to an edge** the expansion holds from about a segment inward. Closer, the error of the
//! rule stays while the pressure of a free edge goes to zero, and is soon larger than it.
//!
//! **The error estimate.** What spoils the rule are the ends of h, and there g is nearly the line
//! A + B t through its values at the edges. The rule is run on that line as well, for which the
//! integrals are known (π z for 1, π (z² - 1/2) for t), and what it misses is its error, up to
//! and into the last segment. What the last extrapolation changed is added: that sees kinks. A
//! jump of the slope at a joint is added by its size and distance.

use super::moments::moments;
use super::{Engine, Estimate, Moments, Pressing, Quadrature, UNKEPT};
use crate::gap::{Cost, Gap, Sampler, Side};
use crate::real::{Sum, same};
use crate::{ContactError, Interval, Real};
use std::sync::OnceLock;

/// The midpoint rule with N segments and Richardson extrapolation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Midpoint {
    /// N, the segments of the coarsest level; each level has twice those of the one before.
    pub segments: usize,
    /// ET: 0 for the trapezoidal sum, 1 for the midpoint rule, one more for each power of w
    /// taken away. Level ET has `N 2^(ET-1)` segments.
    pub extrapolations: u32,
    /// The powers of w that are taken away.
    pub exponents: Exponents,
}

/// The powers of the segment width in which the error expands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Exponents {
    /// 2, 4, 6, ...: as the paper has it; right where `sqrt(1 - t²) g` is smooth at the edges.
    Even,
    /// 3/2, 5/2, 7/2, ...: right where `g` is finite and not zero at the edges.
    HalfOdd,
}

impl Exponents {
    fn power<T: Real>(self, i: usize) -> T {
        match self {
            Self::Even => T::count(2 * (i + 1)),
            Self::HalfOdd => T::count(i + 1) + T::of(0.5),
        }
    }
}

impl Midpoint {
    /// The rule as the paper uses it: N segments, ET extrapolations, even exponents.
    pub const fn paper(segments: usize, extrapolations: u32) -> Self {
        Self { segments, extrapolations, exponents: Exponents::Even }
    }

    /// 64 segments and three powers of w taken away, for free edges: 960 samples. Where the gap
    /// is smooth the relative error is about 1e-13 in the middle of the contact, 1e-9 at 0.8 L
    /// from it, and 1e-5 a segment (L/32) from an edge.
    pub const DEFAULT: Self =
        Self { segments: 64, extrapolations: 4, exponents: Exponents::HalfOdd };

    /// The segments of each level.
    fn levels(&self) -> Option<Vec<usize>> {
        let finest = self.segments.checked_shl(self.extrapolations.saturating_sub(1))?;
        let counted = finest >> self.extrapolations.saturating_sub(1) == self.segments;
        if self.segments == 0 || !counted || finest as u64 >= 1 << 24 {
            return None;
        }
        Some((0..self.extrapolations.max(1)).map(|i| self.segments << i).collect())
    }
}

impl Default for Midpoint {
    fn default() -> Self {
        Self::DEFAULT
    }
}

impl<T: Real> Quadrature<T> for Midpoint {
    fn engine(&self) -> Result<Box<dyn Engine<T>>, ContactError<T>> {
        let Self { segments, extrapolations, .. } = *self;
        let Some(levels) = self.levels() else {
            return Err(ContactError::Segments { segments, extrapolations });
        };
        let sampler = Sampler::default();
        let sums = OnceLock::new();
        Ok(Box::new(AtWork { rule: *self, levels, sampler, on: None, sums, moments: None }))
    }
}

struct AtWork<T: Real> {
    rule: Midpoint,
    levels: Vec<usize>,
    /// Kept from one trial to the next: it knows where on the curves it is.
    sampler: Sampler<T>,
    /// The interval prepared, and the levels sampled on it when they are first needed.
    on: Option<Interval<T>>,
    sums: OnceLock<Sums<T>>,
    /// The interval last integrated over, and the error of its edge integrals.
    moments: Option<(Interval<T>, T)>,
}

impl<T: Real> Engine<T> for AtWork<T> {
    fn reset(&mut self, same_bodies: bool) {
        self.sampler.cost = Cost::default();
        if !same_bodies {
            (self.sampler, self.on, self.moments) = (Sampler::default(), None, None);
        }
    }

    fn moments(
        &mut self,
        gap: &Gap<'_, T>,
        on: Interval<T>,
    ) -> Result<Moments<T>, ContactError<T>> {
        gap.check_budget(self.sampler.cost, UNKEPT, 0, on)?;
        let m = moments(&mut self.sampler, gap, on)?;
        self.moments = Some((on, m.error));
        Ok(m)
    }

    fn prepare(&mut self, _gap: &Gap<'_, T>, on: Interval<T>) -> Result<(), ContactError<T>> {
        (self.on, self.sums) = (Some(on), OnceLock::new());
        Ok(())
    }

    fn complete(&self, gap: &Gap<'_, T>) -> Result<Cost, ContactError<T>> {
        let Some(on) = self.on.filter(|_| self.sums.get().is_none()) else {
            return Ok(Cost::default());
        };
        let mut sampler = Sampler::default();
        let trapezoidal = self.rule.extrapolations == 0;
        let mut levels = Vec::with_capacity(self.levels.len());
        for &n in &self.levels {
            levels.push(Level::sample(&mut sampler, gap, on, n, trapezoidal)?);
        }
        let mut jumps = Vec::new();
        for x in gap.joints(on) {
            let left = sampler.slope_from(gap, x, Side::Left)?;
            jumps.push((x, (sampler.slope_from(gap, x, Side::Right)? - left).abs()));
        }
        let exponents = self.rule.exponents;
        self.sums.get_or_init(|| Sums { on, levels, jumps, exponents });
        Ok(sampler.cost)
    }

    fn estimate(
        &self,
        gap: &Gap<'_, T>,
        pressing: &Pressing<T>,
        x: T,
        cost: &mut Cost,
    ) -> Result<Estimate<T>, ContactError<T>> {
        let Some(sums) = self.sums.get() else {
            // Not prepared, so nothing is known.
            return Ok(Estimate { value: T::zero(), error: T::one() / T::zero() });
        };
        let Estimate { value, error } = sums.at(gap, x, cost)?;
        let edge = T::pi() * T::pi() * sums.on.edge_root(x);
        let Pressing { kappa, load, .. } = *pressing;
        let value = (T::pi() * load - kappa * value) / edge;
        // An error of the edge integrals is one of the limits, or of the load.
        let same = |(on, _): &(Interval<T>, T)| on.is_same(&sums.on);
        let of_edges = self.moments.filter(same).map_or(T::zero(), |(_, error)| error);
        let of_edges = T::of(6.0) * T::pi() * sums.on.half_width() * of_edges;
        Ok(Estimate { value, error: kappa * (error + of_edges) / edge })
    }

    fn cost(&self) -> Cost {
        self.sampler.cost
    }
}

/// All levels, sampled on one interval.
struct Sums<T: Real> {
    on: Interval<T>,
    levels: Vec<Level<T>>,
    /// The joints in the interval, and by how much the slope jumps there.
    jumps: Vec<(T, T)>,
    exponents: Exponents,
}

impl<T: Real> Sums<T> {
    /// The Cauchy integral `I(x)`.
    fn at(&self, gap: &Gap<'_, T>, x: T, cost: &mut Cost) -> Result<Estimate<T>, ContactError<T>> {
        let mut pole = Pole { gap, on: self.on, x, slope: None, sampler: Sampler::default() };
        let mut rows = Vec::with_capacity(self.levels.len());
        for level in &self.levels {
            rows.push(level.at(&mut pole)?);
        }
        *cost += pole.sampler.cost;
        let [value, of_one, of_t] =
            [0, 1, 2].map(|i| self.extrapolate(rows.iter().map(|row| row[i]).collect()));

        // The line through the slopes next to the two edges, A + B t.
        let [left, right] = self.levels[self.levels.len() - 1].end_slopes();
        let [a, b] = [T::of(0.5) * (right + left), T::of(0.5) * (right - left)];
        let z = (x - self.on.centre()) / self.on.half_width();
        let one_missed = of_one.0 - T::pi() * z;
        let t_missed = of_t.0 - T::pi() * (z * z - T::of(0.5));
        let error = (a * one_missed + b * t_missed).abs() + value.1.abs();
        let error = error + self.jump_error(x) + self.coarse_error();
        let half_width = self.on.half_width();
        Ok(Estimate { value: half_width * value.0, error: half_width * error })
    }

    /// What the rule can miss of `PV∫ h/(z - t) dt` where h jumps at a joint: the joint may lie
    /// anywhere in its segment, and next to it the integral has a logarithm.
    fn jump_error(&self, x: T) -> T {
        let half = T::of(0.5);
        let coarsest = self.levels[0].n;
        let segment = (self.on.right - self.on.left) / T::count(coarsest);
        let missed = |&(joint, jump): &(T, T)| {
            let segments = (x - joint).abs() / segment;
            let shape = if segments > half {
                half / segments
            } else {
                T::one() - (segments + segments).ln()
            };
            // A kink alone has no logarithm, and ln 0 times no jump is none.
            if jump.is_zero() { jump } else { jump * shape }
        };
        let root = |x| self.on.edge_root(x) / self.on.half_width();
        let sum = |sum, jump: &(T, T)| sum + root(jump.0) * missed(jump);
        self.jumps.iter().fold(T::zero(), sum)
    }

    /// What Richardson extrapolation makes of the levels, and what its last step has changed.
    fn extrapolate(&self, mut values: Vec<T>) -> (T, T) {
        let mut changed = T::zero();
        for i in 0..values.len() - 1 {
            let gain = T::of(2.0).powf(self.exponents.power(i)) - T::one();
            let finest = values.pop().expect("one more value than steps are left");
            let before = *values.last().expect("likewise");
            changed = (finest - before) / gain;
            let mut next = finest;
            for value in values.iter_mut().rev() {
                (*value, next) = (next + (next - *value) / gain, *value);
            }
        }
        (values[0], changed)
    }

    /// Fewer than four points leave nothing to judge a rule by.
    fn coarse_error(&self) -> T {
        if self.levels[0].n < 4 { T::one() / T::zero() } else { T::zero() }
    }
}

/// The point x at which the integral is wanted; the slope there is sampled when first needed.
struct Pole<'g, T: Real> {
    gap: &'g Gap<'g, T>,
    on: Interval<T>,
    x: T,
    slope: Option<T>,
    sampler: Sampler<T>,
}

impl<T: Real> Pole<'_, T> {
    fn slope(&mut self) -> Result<T, ContactError<T>> {
        match self.slope {
            Some(slope) => Ok(slope),
            None => Ok(*self.slope.insert(self.sampler.slope(self.gap, self.x)?)),
        }
    }

    /// sqrt(1 - z²)
    fn root(&self) -> T {
        self.on.edge_root(self.x) / self.on.half_width()
    }
}

/// h at the points of one level. Places are counted in segments from the left edge, so that
/// the distance of a point from the pole is a difference of two small exact numbers.
struct Level<T> {
    n: usize,
    /// Place of the first point: 1/2 for the midpoint rule, 1 for the trapezoidal sum.
    first: T,
    trapezoidal: bool,
    h: Vec<T>,
    /// sqrt(1 - t²)
    root: Vec<T>,
}

impl<T: Real> Level<T> {
    fn sample(
        sampler: &mut Sampler<T>,
        gap: &Gap<'_, T>,
        on: Interval<T>,
        n: usize,
        trapezoidal: bool,
    ) -> Result<Self, ContactError<T>> {
        let (first, points) = if trapezoidal { (T::one(), n - 1) } else { (T::of(0.5), n) };
        let [h, root] = [(); 2].map(|()| Vec::with_capacity(points));
        let mut level = Self { n, first, trapezoidal, h, root };
        let count = T::count(n);
        for i in 0..points {
            let from_left = level.place(i);
            let root = T::of(2.0) * (from_left * (count - from_left)).sqrt() / count;
            level.root.push(root);
            level.h.push(root * sampler.slope(gap, level.x(on, i))?);
        }
        Ok(level)
    }

    /// The slopes at the first and the last point.
    fn end_slopes(&self) -> [T; 2] {
        let end = |h: Option<&T>, root: Option<&T>| match (h, root) {
            (Some(&h), Some(&root)) => h / root,
            _ => T::zero(),
        };
        [end(self.h.first(), self.root.first()), end(self.h.last(), self.root.last())]
    }

    fn place(&self, i: usize) -> T {
        self.first + T::count(i)
    }

    /// The abscissa of point i, from the nearer edge.
    fn x(&self, on: Interval<T>, i: usize) -> T {
        let (n, from_left) = (T::count(self.n), self.place(i));
        let width = on.right - on.left;
        if from_left + from_left < n {
            on.left + width * (from_left / n)
        } else {
            on.right - width * ((n - from_left) / n)
        }
    }

    /// t at a place.
    fn t(&self, place: T) -> T {
        T::of(2.0) * place / T::count(self.n) - T::one()
    }

    /// The rule's values for the pole: for g itself, and for 1 and t in the place of g.
    fn at(&self, pole: &mut Pole<'_, T>) -> Result<[T; 3], ContactError<T>> {
        let (n, on) = (T::count(self.n), pole.on);
        let place = n * ((pole.x - on.left) / (on.right - on.left));
        let nearest =
            nalgebra::try_convert::<T, f64>(place - self.first).unwrap_or(f64::NAN).round();
        let delta = (place - self.first) - T::of(nearest);
        let index = Some(nearest).filter(|&i| i >= 0.0);
        let index = index.map(|i| i as usize).filter(|&i| i < self.h.len());
        let near = index.filter(|_| self.trapezoidal || delta.abs() < T::of(0.0625));

        let (mut of_g, mut of_one, mut of_t) = (Sum::new(), T::zero(), T::zero());
        for (i, (&h, &root)) in self.h.iter().zip(&self.root).enumerate() {
            if Some(i) != near {
                let point = self.place(i);
                let distance = place - point;
                of_g.add(h / distance);
                let one = root / distance;
                of_one += one;
                of_t += one * self.t(point);
            }
        }

        // What makes up for the pole, for each of the three functions.
        let z = self.t(place);
        let root = pole.root();
        let mut sums = [of_g.value(), of_one, of_t];
        let factor = match near {
            // On the grid of the midpoint rule, or at a left-out point: nothing is missing.
            None if same(delta.abs(), T::of(0.5)) => return Ok(sums),
            Some(_) if self.trapezoidal && same(delta, T::zero()) => return Ok(sums),
            None => -T::pi() / (T::pi() * delta).tan(),
            Some(_) => pole_remainder(delta),
        };
        for (sum, slope) in sums.iter_mut().zip([pole.slope()?, T::one(), z]) {
            *sum += factor * root * slope;
        }
        if let Some(i) = near.filter(|_| !self.trapezoidal) {
            // [z, t_i] of sqrt(1 - t²) times each function, by the rule for products.
            let t = self.t(self.place(i));
            let of_root = -(z + t) / (root + self.root[i]);
            let slopes = [pole.slope()?, T::one(), z];
            let spreads = [self.divided_difference(pole, i, delta)?, T::zero(), T::one()];
            for ((sum, slope), spread) in sums.iter_mut().zip(slopes).zip(spreads) {
                *sum -= T::of(2.0) * (slope * of_root + self.root[i] * spread) / n;
            }
        }
        Ok(sums)
    }

    /// `(g(z) - g(t_i))/(z - t_i)` for z a fraction `delta` of a segment from t_i.
    fn divided_difference(
        &self,
        pole: &mut Pole<'_, T>,
        i: usize,
        delta: T,
    ) -> Result<T, ContactError<T>> {
        let n = T::count(self.n);
        // Half spreads of 1/8, 2/8, 3/8 of a segment about the middle of z and t_i, and the
        // polynomial of degree two in the square of the half spread through them.
        let segment = (pole.on.right - pole.on.left) / n;
        let middle = self.x(pole.on, i) + T::of(0.5) * delta * segment;
        let square = |eighths: f64| T::of(eighths * eighths / 64.0);
        let wanted = T::of(0.25) * delta * delta;
        let mut of_slope = T::zero();
        for (j, eighths) in [1.0, 2.0, 3.0].into_iter().enumerate() {
            let half_spread = T::of(eighths / 8.0);
            let right = pole.sampler.slope(pole.gap, middle + half_spread * segment)?;
            let left = pole.sampler.slope(pole.gap, middle - half_spread * segment)?;
            let mut weight = T::one();
            for (_, other) in [1.0, 2.0, 3.0].into_iter().enumerate().filter(|&(m, _)| m != j) {
                weight *= (wanted - square(other)) / (square(eighths) - square(other));
            }
            // A segment is 2/n long in t.
            of_slope += weight * (right - left) * n / (T::of(4.0) * half_spread);
        }
        Ok(of_slope)
    }
}

/// `1/δ - π cot πδ`, without cancellation for small δ: with y = πδ it is
/// `π (sin y - y cos y)/(y sin y)`.
fn pole_remainder<T: Real>(delta: T) -> T {
    let y = T::pi() * delta;
    if delta.abs() >= T::of(0.0625) {
        return delta.recip() - T::pi() / y.tan();
    }
    if delta.is_zero() {
        return T::pi() * y / T::of(3.0);
    }
    let y2 = y * y;
    let series = [-1.0 / 45360.0, 1.0 / 840.0, -1.0 / 30.0, 1.0 / 3.0]
        .into_iter()
        .fold(T::of(1.0 / 3_991_680.0), |sum, c| sum * y2 + T::of(c));
    T::pi() * y2 * series / y.sin()
}
