//! Effect of the pressure outside the contacts, from a few of its values.
//!
//! With `P w = q₀ + Σ q_n cos nθ` over a contact, w² = (x + b)(a - x), and u the Joukowski variable
//! of a place outside it (|u| <= 1 there, and 1 at the edge)
//!
//! ```text
//! ∫ P ln|x - s| ds = π (q₀ ln(L/(2|u|)) - Σ q_n uⁿ/n)
//! ```
//!
//! Values at 32 angles suffice for rounding if the pressure is smooth, and for a thousandth of it
//! otherwise; more are taken if the result depends on them.

use crate::numerics::chebyshev::{Table, power_series};
use crate::numerics::{Combine, FarField};
use crate::{Ends, Interval, Real};
use std::f64::consts::PI;

/// Number of angles at which the pressure is evaluated, and of coefficients.
pub(crate) const POINTS: usize = 32;

/// Number of stretches beyond all contacts for which there is room from the first: 32 doublings on
/// either side.
const MOST_STRETCHES: usize = 64;

/// Pressure of one contact as a cosine series.
#[derive(Clone)]
pub(crate) struct ExteriorField<T> {
    pub on: Interval<T>,
    /// First [places](Self::place), and the pressures there.
    pub x: [T; POINTS],
    pub pressures: [T; POINTS],
    q: [T; POINTS],
    /// Coefficients from more values in place of `q`, if any.
    finer: Vec<T>,
    /// Flags: the pressure is zero at this limit.
    free: Ends<bool>,
    /// Uncertainty of the potential at the limits, due to the coefficients left out.
    pub doubt: T,
    /// Flag: the slope of the gap jumps inside, so that the potentials are off by about as much.
    pub has_corner: bool,
}

impl<T: Real> ExteriorField<T> {
    /// Returns place i of `count` at which the pressure is needed: Chebyshev nodes of the contact.
    pub fn place(on: Interval<T>, i: usize, count: usize) -> T {
        on.at_angle(T::pi() * (T::count(count - i) - T::of(0.5)) / T::count(count))
    }

    /// Creates the series from the pressures at the first places.
    pub fn new(on: Interval<T>, free: Ends<bool>, x: [T; POINTS], pressures: [T; POINTS]) -> Self {
        let bounded: [T; POINTS] =
            std::array::from_fn(|i| pressures[i] * on.chebyshev_weight(x[i]));
        let q = Table::of(POINTS).coefficients(&bounded);
        let (finer, doubt) = (Vec::new(), tail(&q, free));
        Self { on, x, pressures, q, finer, free, doubt, has_corner: false }
    }

    /// Computes the coefficients from the pressures at more [places](Self::place).
    pub fn refine(&mut self, x: &[T], mut pressures: Vec<T>) {
        pressures.iter_mut().zip(x).for_each(|(p, &x)| *p *= self.on.chebyshev_weight(x));
        self.finer = coefficients(&pressures);
        self.doubt = tail(&self.finer, self.free).max(peaked(&pressures));
    }

    /// Returns the coefficients q₀, q₁, ...
    pub fn coefficients(&self) -> &[T] {
        if self.finer.is_empty() { &self.q } else { &self.finer }
    }

    /// Returns `∫ P ln|x - s| ds` at a place that is not inside the contact.
    pub fn potential(&self, x: T) -> T {
        let [u, _] = self.joukowski(x);
        let (mut sum, mut power) = (T::zero(), T::one());
        let all = self.coefficients();
        for (n, &q) in all.iter().enumerate().skip(1) {
            power *= u;
            // From afar a contact is a line load.
            if power.abs() < T::epsilon() {
                break;
            }
            sum += q * power / T::count(n);
        }
        T::pi() * (all[0] * (T::of(0.5) * self.on.half_width() / u.abs()).ln() - sum)
    }

    /// Returns u at a place that is not inside the contact, and `sqrt((x - a)(x + b))` there.
    fn joukowski(&self, x: T) -> [T; 2] {
        let half_width = self.on.half_width();
        let right = x > self.on.centre();
        let distance = if right { x - self.on.right } else { self.on.left - x };
        let beyond = distance.max(T::zero()) / half_width;
        let root = (beyond * (beyond + T::of(2.0))).sqrt();
        let size = T::one() / (T::one() + beyond + root);
        [if right { size } else { -size }, root * half_width]
    }

    /// Returns the uncertainty of the rise of the potential across a region outside the contact.
    /// The coefficients left out act less and less with the distance, as powers of u. But they
    /// alias into the known ones, those of `ln u` and of low powers, which act from afar.
    fn doubt_in(&self, room: Interval<T>) -> T {
        let [left, right] = [room.left, room.right].map(|x| self.joukowski(x)[0].abs());
        let (near, far) = (left.max(right), left.min(right));
        let n = T::count(self.coefficients().len());
        // From afar, 32 coefficients leave less than rounding.
        let left_out = if near < T::of(0.25) { T::zero() } else { near.powf(n) };
        // A logarithm is no more than this.
        self.doubt * (near / far - T::one()).min(T::one()).max(left_out)
    }

    /// Returns `∫ P/(x - s) ds` at a place outside the contact.
    pub fn slope(&self, x: T) -> T {
        let [u, root] = self.joukowski(x);
        T::pi() * power_series(self.coefficients(), u) / (root * u.signum())
    }

    /// Returns the load of the contact.
    pub fn load(&self) -> T {
        T::pi() * self.coefficients()[0]
    }
}

/// Pressures of all contacts.
#[derive(Clone)]
pub(crate) struct ExteriorFields<T> {
    /// Series of each contact, from left to right.
    pub each: Vec<ExteriorField<T>>,
    on: Vec<Interval<T>>,
    /// Gaps, and stretches before and after all contacts.
    places: Vec<Interval<T>>,
    /// Parts of the potential and of its slope by the contacts far from each place.
    far: [FarField<T>; 2],
}

impl<T: Real> ExteriorFields<T> {
    pub fn new() -> Self {
        let far = [Combine::Sum; 2].map(FarField::new);
        Self { each: Vec::new(), on: Vec::new(), places: Vec::new(), far }
    }

    /// Sums up the series of contacts far from each place, within the range of the bodies.
    pub fn gather(&mut self, [from, to]: [T; 2]) {
        let Self { each, on, places, far: [potential, slope] } = self;
        places.clear();
        // One contact is summed by itself.
        let [first, .., last] = &each[..] else { return };
        let [first, last] = [first.on, last.on];
        places.reserve(each.len() + MOST_STRETCHES);
        on.clear();
        on.extend(each.iter().map(|field| field.on));
        // Beyond all contacts, stretches each as long as its distance.
        let (mut right, mut width) = (first.left, first.right - first.left);
        while right > from {
            places.push(Interval { left: right - width, right });
            (right, width) = (right - width, width + width);
        }
        places.reverse();
        places.extend(on.windows(2).map(|on| Interval { left: on[0].right, right: on[1].left }));
        let (mut left, mut width) = (last.right, last.right - last.left);
        while left < to {
            places.push(Interval { left, right: left + width });
            (left, width) = (left + width, width + width);
        }
        potential.set(on, places.iter().copied(), false, &|i, x| each[i].potential(x));
        slope.set(on, places.iter().copied(), false, &|i, x| each[i].slope(x));
    }

    /// Returns `∫ P ln|x - s| ds` over all contacts, at a place that is not inside any.
    pub fn potential(&self, x: T) -> T {
        self.total(&self.far[0], x, ExteriorField::potential)
    }

    /// Returns `∫ P/(x - s) ds` over all contacts, at a place outside them.
    pub fn slope(&self, x: T) -> T {
        self.total(&self.far[1], x, ExteriorField::slope)
    }

    /// Returns the uncertainty of the rise of the potential across a region outside the contacts,
    /// by all of them and by those with corners.
    pub fn doubt_in(&self, room: Interval<T>) -> [T; 2] {
        self.each.iter().fold([T::zero(); 2], |[all, corners], field| {
            let doubt = field.doubt_in(room);
            [all + doubt, if field.has_corner { corners + doubt } else { corners }]
        })
    }

    fn total(&self, far: &FarField<T>, x: T, of: impl Fn(&ExteriorField<T>, T) -> T) -> T {
        let sum = |near: &[ExteriorField<T>]| {
            near.iter().fold(T::zero(), |sum, field| sum + of(field, x))
        };
        let place = self.places.partition_point(|place| place.right < x);
        match self.places.get(place) {
            Some(_) => sum(&self.each[far.near(place)]) + far.far(place, [x])[0],
            None => sum(&self.each),
        }
    }
}

/// Returns a bound on the potential of the coefficients that a cosine series leaves out.
///
/// If the coefficients fall as 1/n², as for a kink next to a limit, those left out add as much as
/// the last quarter of the known ones, which are off by about as much. The first few coefficients
/// may not fall yet.
///
/// At a free limit `P w` is zero. A rest h of the series there falls to zero within the last half
/// step of the angle, δ, and takes `(2/π) h δ` off each coefficient up to n = 1/δ.
fn tail<T: Real>(q: &[T], free: Ends<bool>) -> T {
    let zero = T::zero();
    let [even, odd] =
        [0, 1].map(|from| q.iter().skip(from).step_by(2).fold(zero, |sum, &q| sum + q));
    let rest = |is_free: bool, rest: T| if is_free { rest.abs() } else { zero };
    let missed = rest(free.left, even - odd) + rest(free.right, even + odd);
    let half_step = T::of(0.5) * T::pi() / T::count(q.len());
    let beside = T::of(-2.0) * missed * half_step * half_step.ln();
    if q.len() == POINTS {
        let last = q[POINTS - 4..].iter().fold(zero, |max, q| max.max(q.abs()));
        return T::of(16.0) * T::pi() * last + beside;
    }
    let first = q.len() - q.len() / 4;
    let last = (first..q.len()).fold(zero, |sum, n| sum + q[n].abs() / T::count(n));
    T::of(4.0) * T::pi() * last + beside
}

/// Returns the potential that the values of a cosine series leave uncertain where one of them
/// stands out: next to the logarithm at a kink, it stands for a pressure that its neighbours do not
/// share, and is in all coefficients.
fn peaked<T: Real>(values: &[T]) -> T {
    let out = |near: &[T]| (near[1] - T::of(0.5) * (near[0] + near[2])).abs();
    let most = values.windows(3).map(out).fold(T::zero(), T::max);
    T::of(2.0) * T::pi() * most / T::count(values.len())
}

/// Returns the coefficients of a cosine series from its values by rising x, [`POINTS`] times a
/// power of two. The even ones belong to half as many values, the means of those at θ and π - θ; so
/// do the sums of two odd ones that follow each other, by the products of half their differences
/// with 2 cos θ.
fn coefficients<T: Real>(values: &[T]) -> Vec<T> {
    if let Ok(values) = values.try_into() {
        return Table::of(POINTS).coefficients::<POINTS, T>(values).to_vec();
    }
    // From the middle, so by rising cos 2θ.
    let (left, right) = values.split_at(values.len() / 2);
    let pairs = || right.iter().zip(left.iter().rev());
    let twice = |i: usize| T::of(2.0 * (PI * (i as f64 + 0.5) / values.len() as f64).sin());
    let even: Vec<T> = pairs().map(|(&one, &other)| T::of(0.5) * (one + other)).collect();
    let odd = pairs().enumerate().map(|(i, (&one, &other))| twice(i) * T::of(0.5) * (one - other));
    let [even, sums] = [even, odd.collect()].map(|values| coefficients(&values));
    let mut last = T::zero();
    let both = even.into_iter().zip(sums).flat_map(|(even, sum)| {
        last = sum - last;
        [even, last]
    });
    both.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Parabola of radius 1 on a flat, κ = 1: P = sqrt(L² - x²)/π, and outside the surfaces open by
    /// x²/2 - L²/2 less the logarithmic potential.
    #[test]
    fn the_gap_beside_a_parabola() {
        let on = Interval { left: -0.3, right: 0.3 };
        let x = std::array::from_fn(|i| ExteriorField::place(on, i, POINTS));
        let pressures = x.map(|x: f64| (0.09 - x * x).sqrt() / PI);
        let field = ExteriorField::new(on, Ends::both(true), x, pressures);
        assert!((field.load() / 0.045 - 1.0).abs() < 1e-14);
        for x in [0.3001f64, 0.4, 1.0, 30.0, -0.31, -2.0] {
            let pushed = field.potential(x) - field.potential(0.3);
            // h(x) - h(L) = (z sqrt(z² - 1) - arcosh z) L²/2 + potential, z = |x|/L.
            let z = x.abs() / 0.3;
            let open = 0.045 * (z * (z * z - 1.0).sqrt() - z.acosh());
            let due = 0.5 * x * x - 0.045 - open;
            assert!((pushed - due).abs() < 1e-14 * (x * x).max(1.0), "{x}: {pushed} for {due}");
        }
    }

    /// Thousands of values are taken of a pressure that is infinite inside.
    #[test]
    fn many_coefficients_are_right() {
        let count = 1 << 16;
        let angle = |i: usize| PI * ((count - i) as f64 - 0.5) / count as f64;
        let values: Vec<f64> = (0..count).map(|i| (angle(i).cos() - 0.3).abs().ln()).collect();
        let found = coefficients(&values);
        for n in [0, 1, 2, 31, 32, 500, 4097, 60_001] {
            let terms = values.iter().enumerate().map(|(i, v)| v * (n as f64 * angle(i)).cos());
            let due = terms.sum::<f64>() * if n == 0 { 1.0 } else { 2.0 } / count as f64;
            assert!((found[n] - due).abs() < 1e-13, "{n}: {} {due}", found[n]);
        }
    }
}
