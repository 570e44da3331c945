//! The midpoint rule, and the trapezoidal one, on one grid, for a pole at any x.
//!
//! The paper's rule is meant for z on the grid `-1 + 2i/N`, where the two neighbours of the pole
//! cancel. Elsewhere the sum has a pole at each of its points, and the integral has none. A known
//! term makes up for it, and keeps the order of the rule:
//!
//! ```text
//! PV∫ h(t)/(z - t) dt ≈ M_N - π h(z) cot(π (z - t₀)/w),    t₀ any of the points
//! ```
//!
//! Close to a point t_j both parts are large and cancel. Their finite difference is `-w [z, t_j]h`
//! plus `h(z) (1/δ - π cot πδ)`, δ = (z - t_j)/w, and the divided difference `[z, t_j]h` is formed
//! from `sqrt(1 - t²)`, where it is exact, and from `g`. The divided difference of `g` is an even
//! analytic function of its spread. Where the two points are too close to be subtracted, it is read
//! off three wider spreads about the same middle.

use crate::gap::{Cost, Gap, Sampler};
use crate::numerics::CompensatedSum;
use crate::real::same;
use crate::{ContactError, Fallible, Interval, Real};

/// Point x at which the integral is wanted; the slope there is sampled when first needed.
pub(super) struct Pole<'g, T: Real> {
    gap: &'g Gap<'g, T>,
    on: Interval<T>,
    x: T,
    slope: Option<T>,
    sampler: Sampler<T>,
}

impl<'g, T: Real> Pole<'g, T> {
    pub fn new(gap: &'g Gap<'g, T>, on: Interval<T>, x: T) -> Self {
        Self { gap, on, x, slope: None, sampler: Sampler::default() }
    }

    /// Returns the cost of the samples.
    pub fn cost(&self) -> Cost {
        self.sampler.cost
    }

    fn slope(&mut self) -> Fallible<T, T> {
        match self.slope {
            Some(slope) => Ok(slope),
            None => Ok(*self.slope.insert(self.sampler.slope(self.gap, self.x)?)),
        }
    }

    /// Returns sqrt(1 - z²).
    fn root(&self) -> T {
        self.on.chebyshev_weight(self.x) / self.on.half_width()
    }
}

/// Values of h at the points of one level. Places are counted in segments from the left edge, so
/// that the distance of a point from the pole is a difference of two small exact numbers.
#[derive(Clone)]
pub(super) struct Level<T> {
    /// Number of segments.
    pub n: usize,
    /// Place of the first point: 1/2 for the midpoint rule, 1 for the trapezoidal sum.
    first: T,
    trapezoidal: bool,
    h: Vec<T>,
    /// Values of sqrt(1 - t²).
    root: Vec<T>,
}

impl<T: Real> Level<T> {
    pub fn sample(
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

    /// Returns the slopes at the edges, by the line through the slopes at the first and the last
    /// point.
    pub fn edge_slopes(&self) -> [T; 2] {
        let Some(last) = self.h.len().checked_sub(1) else { return [T::zero(); 2] };
        let [first, last] = [0, last].map(|i| self.h[i] / self.root[i]);
        let between = T::count(self.n) - self.first - self.first;
        if between <= T::zero() {
            return [first, last];
        }
        let beyond = (last - first) * self.first / between;
        [first - beyond, last + beyond]
    }

    fn place(&self, i: usize) -> T {
        self.first + T::count(i)
    }

    /// Returns the abscissa of point i, from the nearer edge.
    fn x(&self, on: Interval<T>, i: usize) -> T {
        let (n, from_left) = (T::count(self.n), self.place(i));
        let width = on.right - on.left;
        if from_left + from_left < n {
            on.left + width * (from_left / n)
        } else {
            on.right - width * ((n - from_left) / n)
        }
    }

    /// Returns t at a place.
    fn t(&self, place: T) -> T {
        T::of(2.0) * place / T::count(self.n) - T::one()
    }

    /// Returns the rule's values for the pole: for g itself, and for 1 and t in place of g.
    pub fn at(&self, pole: &mut Pole<'_, T>) -> Result<[T; 3], ContactError<T>> {
        let (n, on) = (T::count(self.n), pole.on);
        let place = n * ((pole.x - on.left) / (on.right - on.left));
        let is_close = |&i: &usize| (place - self.place(i)).abs() <= T::of(0.5);
        let closest = (0..self.h.len()).find(is_close);
        let delta = place - self.place(closest.unwrap_or(0));
        let near = closest.filter(|_| self.trapezoidal || delta.abs() < T::of(0.0625));

        let (mut of_g, mut of_one, mut of_t) = (CompensatedSum::new(), T::zero(), T::zero());
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

        // Term that makes up for the pole, for each of the three functions.
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

    /// Returns `(g(z) - g(t_i))/(z - t_i)` for z a fraction `delta` of a segment from t_i.
    fn divided_difference(&self, pole: &mut Pole<'_, T>, i: usize, delta: T) -> Fallible<T, T> {
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

/// Returns `1/δ - π cot πδ`, without cancellation for small δ: with y = πδ it is
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
