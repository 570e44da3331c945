//! The Cauchy transform of the pressure: everything about the stress below the surface.
//!
//! With V and p of `several.rs` (p = 1 for one contact), at a place ζ = x + iy off the contacts,
//!
//! ```text
//! W(ζ) = ∫ P(s)/(ζ - s) ds = -κ S(ζ)/p(ζ) V(ζ)/π
//! ```
//!
//! and the further part of a single contact, if the strengths K of its edges are not zero:
//!
//! ```text
//! π/2 (K_a (A/B - 1) + K_b (1 - B/A)) - κ m₀,      A = sqrt(ζ + b),   B = sqrt(ζ - a)
//! ```
//!
//! On a panel whose polynomial q can be continued to ζ, V has a closed form, as on the surface
//! (`hilbert_transform.rs`):
//!
//! ```text
//! ∫_u^v q(s) dθ/(s - ζ) = ∫ (q(s) - q(ζ))/(s - ζ) dθ - i q(ζ)/R (Λ(ζ, v) - Λ(ζ, u)),   R = A B
//! Λ(ζ, t) = ln (m - i n)²/((ζ - t)(a + b)),     m = A sqrt(a - t),   n = B sqrt(t + b)
//! Λ' = -i w(t)/(R (ζ - t))
//! ```
//!
//! Only the logarithm is steep, and its argument keeps its digits: W is exact to rounding of the
//! largest slope at any depth.

use super::near_far_sum::{NearFarSum, Seen};
use super::panel::within;
use super::several::{Middle, Terms};
use super::{LoadCase, PanelIntegrator};
use crate::{Ends, Interval, Real};
use nalgebra::Complex;

/// Function of ζ, and its derivative.
pub(super) type WithDerivative<T> = [Complex<T>; 2];

/// Number of points on the circle whose mean stands for a place close to a zero of p, and the
/// radius as a share of the gap around the zero. The mean is off by the eighth power of the radius,
/// each value by rounding over the radius.
const CIRCLE: usize = 8;
const RADIUS: f64 = 1.0 / 64.0;

/// Contacts with their panels, as seen from anywhere in the plane.
pub(crate) struct CauchyTransform<T> {
    pub(super) contacts: Vec<(Interval<T>, NearFarSum<T>)>,
    /// Zero or pole of p in each gap, if it has one.
    pub(super) middles: Vec<Option<Middle<T>>>,
    /// Limits that are held at corners, where S has an inverse root.
    pub(super) corners: Vec<T>,
    /// Terms of V besides the integrals.
    pub(super) terms: Terms<T>,
    /// Strengths of the edges of a single contact, pressures.
    pub(super) strengths: Ends<T>,
    /// W of the panels of a single contact far away: κ m₀.
    pub(super) far_away: T,
    pub(super) kappa: T,
    pub(super) load: T,
}

impl<T: Real> CauchyTransform<T> {
    /// Returns the transform of the pressure on prepared panels.
    pub fn of(integrator: &PanelIntegrator<T>, load_case: &LoadCase<T>) -> Self {
        let LoadCase { kappa, load, .. } = *load_case;
        if integrator.is_several {
            return integrator.several.cauchy_transform(kappa, load);
        }
        let (on, mut sum) = (integrator.transform.on, NearFarSum::new());
        sum.set(within(&integrator.panel_set.panels, on), on, Seen::Below);
        let [_, strengths] = integrator.strengths(load_case);
        Self {
            contacts: vec![(on, sum)],
            middles: Vec::new(),
            corners: Vec::new(),
            terms: Terms::none(),
            strengths,
            far_away: integrator.moments.map_or(T::zero(), |(_, m)| kappa * m.m0),
            kappa,
            load,
        }
    }

    /// Returns the interval from the first limit to the last.
    fn hull(&self) -> Interval<T> {
        let last = self.contacts.len() - 1;
        Interval { left: self.contacts[0].0.left, right: self.contacts[last].0.right }
    }

    /// Returns W and `y W'` at x, at a depth y that is not negative.
    pub fn at(&self, x: T, depth: T) -> WithDerivative<T> {
        let hull = self.hull();
        let by_width = T::one() / (hull.right - hull.left);
        let (y, from_centre) = (depth * by_width, x - hull.centre());
        // Seen from so far, a contact is a line load.
        if (from_centre * by_width).abs().max(y) > T::one() / T::epsilon() {
            let radius = from_centre.hypot(depth);
            let turn = Complex::new(from_centre / radius, -depth / radius);
            let pull = turn * (self.load / radius);
            return [pull, -(pull * turn) * (depth / radius)];
        }
        let place = |t: T| Complex::new((x - t) * by_width, y);
        let gap = self.contacts.partition_point(|(on, _)| on.right < x).wrapping_sub(1);
        let Some(&Some(middle)) = self.middles.get(gap) else { return self.off_zeros(&place, y) };
        // p and V vanish together, or are infinite.
        let radius = T::of(RADIUS) * (self.contacts[gap + 1].0.left - self.contacts[gap].0.right);
        let radius = radius * by_width;
        if length(place(middle.place())) > T::of(0.5) * radius {
            return self.off_zeros(&place, y);
        }
        let mut mean = [Complex::new(T::zero(), T::zero()); 2];
        for i in 0..CIRCLE {
            let angle = T::two_pi() * T::count(i) / T::count(CIRCLE);
            let aside = Complex::new(radius * angle.cos(), radius * angle.sin());
            // Above the surface W is the conjugate of W below.
            let above = y + aside.im < T::zero();
            let mirrored = |z: Complex<T>| if above { z.conj() } else { z };
            let found = self.off_zeros(&|t| mirrored(place(t) + aside), y);
            let share = T::one() / T::count(CIRCLE);
            mean = [0, 1].map(|j| mean[j] + mirrored(found[j]) * share);
        }
        mean
    }

    /// Returns the result of [`at`](Self::at) where p is not zero, given the distances from ζ, in
    /// widths of the hull. ζ is not above the surface.
    fn off_zeros(&self, place: &impl Fn(T) -> Complex<T>, y: T) -> WithDerivative<T> {
        let one = Complex::new(T::one(), T::zero());
        let hull = self.hull();
        let width = hull.right - hull.left;
        let mut value = [one * T::zero(); 2];
        // S/p, its logarithmic derivative, and its dimension as a power of a length.
        let (mut factor, mut rate, mut power) = (one, one * T::zero(), -1);
        for (i, (on, sum)) in self.contacts.iter().enumerate() {
            let ends = [place(on.left), place(on.right)];
            let roots = ends.map(sqrt);
            let part = sum.in_plane(place, *on, width);
            value = [0, 1].map(|j| value[j] + part[j]);
            (factor, power) = (factor * roots[0] * roots[1], power + 1);
            rate += (inverse(ends[0]) + inverse(ends[1])) * T::of(0.5);
            match self.middles.get(i) {
                Some(&Some(Middle::Pole(pole))) => {
                    let by = place(pole);
                    (factor, rate, power) = (factor * by, rate + inverse(by), power + 1);
                }
                Some(&Some(Middle::Zero(zero))) => {
                    let by = inverse(place(zero));
                    (factor, rate, power) = (factor * by, rate - by, power - 1);
                }
                _ => {}
            }
        }
        for &corner in &self.corners {
            let by = inverse(place(corner));
            (factor, rate, power) = (factor * by, rate - by, power - 1);
        }
        let terms = self.terms.in_plane(place, width);
        value = [0, 1].map(|j| value[j] + terms[j]);
        let scale = -self.kappa * T::frac_1_pi() * width.powi(power);
        let pull = factor * value[0] * scale;
        let slope = pull * rate + factor * value[1] * scale;
        let [more, steeper] = self.of_strengths([hull.left, hull.right].map(place));
        [pull + more - self.far_away, (slope + steeper) * y]
    }

    /// Returns the part of given strengths, from the distances to both limits.
    fn of_strengths(&self, limits: [Complex<T>; 2]) -> WithDerivative<T> {
        let Ends { left, right } = self.strengths;
        if left.is_zero() && right.is_zero() {
            return [Complex::new(T::zero(), T::zero()); 2];
        }
        let [a, b] = limits.map(sqrt);
        let [left, right] = [left, right].map(|strength| strength * T::frac_pi_2());
        let [by_a, by_b] = [inverse(a), inverse(b)];
        let steep = by_b * by_b * right + by_a * by_a * left;
        [(by_a * left + by_b * right) * inverse(a + b), steep * by_a * by_b * T::of(-0.5)]
    }
}

/// Returns the distance from zero.
pub(crate) fn length<T: Real>(z: Complex<T>) -> T {
    z.re.hypot(z.im)
}

/// Returns the reciprocal, of however small a number.
pub(crate) fn inverse<T: Real>(z: Complex<T>) -> Complex<T> {
    let by = T::one() / length(z);
    Complex::new((z.re * by) * by, -(z.im * by) * by)
}

/// Returns the root whose real part is not negative, with all digits of both parts.
pub(crate) fn sqrt<T: Real>(z: Complex<T>) -> Complex<T> {
    let half = T::of(0.5);
    let large = ((length(z) + z.re.abs()) * half).sqrt();
    if large.is_zero() {
        return z;
    }
    let small = z.im.abs() * half / large;
    let [re, im] = if z.re >= T::zero() { [large, small] } else { [small, large] };
    Complex::new(re, if z.im < T::zero() { -im } else { im })
}

/// Returns the natural logarithm.
pub(super) fn ln<T: Real>(z: Complex<T>) -> Complex<T> {
    Complex::new(length(z).ln(), z.im.atan2(z.re))
}
