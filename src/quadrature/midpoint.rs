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
//! rule stays while the pressure of a free edge goes to zero, and is soon larger than it. With two
//! levels or more the last extrapolation shows that: see [`Estimate::error`].

use super::moments::moments;
use super::{Engine, Estimate, Moments, Quadrature, Transform};
use crate::gap::{Cost, Gap, Sampler};
use crate::real::Sum;
use crate::{ContactError, Interval, Real};

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
        if self.segments == 0 || !counted || finest as u64 >= 1 << 32 {
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
    fn prepare<'g>(&self, gap: &'g Gap<'g, T>) -> Result<Box<dyn Engine<T> + 'g>, ContactError<T>> {
        let Self { segments, extrapolations, .. } = *self;
        let Some(levels) = self.levels() else {
            return Err(ContactError::Segments { segments, extrapolations });
        };
        Ok(Box::new(AtWork { rule: *self, levels, gap, sampler: gap.sampler() }))
    }
}

struct AtWork<'g, T: Real> {
    rule: Midpoint,
    levels: Vec<usize>,
    gap: &'g Gap<'g, T>,
    /// Kept from one trial to the next: it knows where on the curves it is.
    sampler: Sampler<'g, T>,
}

impl<T: Real> Engine<T> for AtWork<'_, T> {
    fn moments(&mut self, on: Interval<T>) -> Result<Moments<T>, ContactError<T>> {
        moments(&mut self.sampler, self.gap.joints(), on)
    }

    fn transform<'e>(
        &'e self,
        on: Interval<T>,
        cost: &mut Cost,
    ) -> Result<Box<dyn Transform<T> + 'e>, ContactError<T>> {
        let mut sampler = self.gap.sampler();
        let trapezoidal = self.rule.extrapolations == 0;
        let mut levels = Vec::with_capacity(self.levels.len());
        for &n in &self.levels {
            levels.push(Level::sample(&mut sampler, on, n, trapezoidal)?);
        }
        *cost += sampler.cost;
        Ok(Box::new(Sums { gap: self.gap, on, levels, exponents: self.rule.exponents }))
    }

    fn cost(&self) -> Cost {
        self.sampler.cost
    }
}

/// All levels, sampled on one interval.
struct Sums<'g, T: Real> {
    gap: &'g Gap<'g, T>,
    on: Interval<T>,
    levels: Vec<Level<T>>,
    exponents: Exponents,
}

impl<T: Real> Transform<T> for Sums<'_, T> {
    fn at(&self, x: T, cost: &mut Cost) -> Result<Estimate<T>, ContactError<T>> {
        let mut pole = Pole { on: self.on, x, slope: None, sampler: self.gap.sampler() };
        let mut values = Vec::with_capacity(self.levels.len());
        for level in &self.levels {
            values.push(level.at(&mut pole)?);
        }
        *cost += pole.sampler.cost;
        // What the last extrapolation changed bounds the error of what came of it.
        let mut error = None;
        for i in 0..values.len() - 1 {
            let gain = T::of(2.0).powf(self.exponents.power(i)) - T::one();
            error = values.last().copied();
            for j in 0..values.len() - 1 {
                values[j] = values[j + 1] + (values[j + 1] - values[j]) / gain;
            }
            values.pop();
            error = error.map(|before| (before - values[values.len() - 1]).abs());
        }
        let half_width = self.on.half_width();
        let error = error.map(|error: T| half_width * error);
        Ok(Estimate { value: half_width * values[0], error })
    }
}

/// The point x at which the integral is wanted; the slope there is sampled when first needed.
struct Pole<'g, T: Real> {
    on: Interval<T>,
    x: T,
    slope: Option<T>,
    sampler: Sampler<'g, T>,
}

impl<T: Real> Pole<'_, T> {
    fn slope(&mut self) -> Result<T, ContactError<T>> {
        match self.slope {
            Some(slope) => Ok(slope),
            None => Ok(*self.slope.insert(self.sampler.slope(self.x)?)),
        }
    }

    /// sqrt(1 - z²)
    fn root(&self) -> T {
        self.on.edge_root(self.x) / self.on.half_width()
    }

    fn h(&mut self) -> Result<T, ContactError<T>> {
        Ok(self.root() * self.slope()?)
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
}

impl<T: Real> Level<T> {
    fn sample(
        sampler: &mut Sampler<'_, T>,
        on: Interval<T>,
        n: usize,
        trapezoidal: bool,
    ) -> Result<Self, ContactError<T>> {
        let (first, points) = if trapezoidal { (T::one(), n - 1) } else { (T::of(0.5), n) };
        let mut level = Self { n, first, trapezoidal, h: Vec::with_capacity(points) };
        for i in 0..points {
            let h = level.root(i) * sampler.slope(level.x(on, i))?;
            level.h.push(h);
        }
        Ok(level)
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

    /// sqrt(1 - t²) at point i.
    fn root(&self, i: usize) -> T {
        let (n, from_left) = (T::count(self.n), self.place(i));
        T::of(2.0) * (from_left * (n - from_left)).sqrt() / n
    }

    /// The rule's value for the pole.
    fn at(&self, pole: &mut Pole<'_, T>) -> Result<T, ContactError<T>> {
        let (n, on) = (T::count(self.n), pole.on);
        let place = n * ((pole.x - on.left) / (on.right - on.left));
        let nearest = (place - self.first).round();
        let delta = (place - self.first) - nearest;
        let index = nalgebra::try_convert::<T, f64>(nearest).filter(|&i| i >= 0.0);
        let index = index.map(|i| i as usize).filter(|&i| i < self.h.len());

        let near = index.filter(|_| self.trapezoidal || delta.abs() < T::of(0.0625));
        let mut sum = Sum::new();
        for (i, &h) in self.h.iter().enumerate() {
            if Some(i) != near {
                sum.add(h / (place - self.place(i)));
            }
        }
        let half = T::of(0.5);
        Ok(sum.value()
            + match near {
                None if delta.abs() == half => T::zero(),
                None => -T::pi() * pole.h()? / (T::pi() * delta).tan(),
                Some(_) if self.trapezoidal => {
                    if delta.is_zero() {
                        T::zero()
                    } else {
                        pole.h()? * pole_remainder(delta)
                    }
                }
                Some(i) => {
                    let spread = self.divided_difference(pole, i, delta)?;
                    pole.h()? * pole_remainder(delta) - T::of(2.0) * spread / n
                }
            })
    }

    /// `(h(z) - h(t_i))/(z - t_i)` for z a fraction `delta` of a segment from t_i.
    fn divided_difference(
        &self,
        pole: &mut Pole<'_, T>,
        i: usize,
        delta: T,
    ) -> Result<T, ContactError<T>> {
        let n = T::count(self.n);
        let (root_z, root_t) = (pole.root(), self.root(i));
        // z + t = 2 (place of z + place of t)/n - 2
        let z_plus_t = T::of(2.0) * ((T::of(2.0) * self.place(i) + delta) / n - T::one());
        let of_root = -z_plus_t / (root_z + root_t);

        // Half spreads of 1/8, 2/8, 3/8 of a segment about the middle of z and t_i, and the
        // polynomial of degree two in the square of the half spread through them.
        let segment = (pole.on.right - pole.on.left) / n;
        let middle = self.x(pole.on, i) + T::of(0.5) * delta * segment;
        let square = |eighths: f64| T::of(eighths * eighths / 64.0);
        let wanted = T::of(0.25) * delta * delta;
        let mut of_slope = T::zero();
        for (j, eighths) in [1.0, 2.0, 3.0].into_iter().enumerate() {
            let half_spread = T::of(eighths / 8.0);
            let right = pole.sampler.slope(middle + half_spread * segment)?;
            let left = pole.sampler.slope(middle - half_spread * segment)?;
            let mut weight = T::one();
            for (_, other) in [1.0, 2.0, 3.0].into_iter().enumerate().filter(|&(m, _)| m != j) {
                weight *= (wanted - square(other)) / (square(eighths) - square(other));
            }
            // A segment is 2/n long in t.
            of_slope += weight * (right - left) * n / (T::of(4.0) * half_spread);
        }
        Ok(pole.slope()? * of_root + root_t * of_slope)
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
        return T::zero();
    }
    let y2 = y * y;
    let series = [-1.0 / 45360.0, 1.0 / 840.0, -1.0 / 30.0, 1.0 / 3.0]
        .into_iter()
        .fold(T::of(1.0 / 3_991_680.0), |sum, c| sum * y2 + T::of(c));
    T::pi() * y2 * series / y.sin()
}
