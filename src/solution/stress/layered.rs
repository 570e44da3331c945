//! Stress below the surface of a body with a layer.
//!
//! ```text
//! [σ_x, σ_y, τ_xy] = 1/π ∫ [Re(Z) φ'', -Re(Z) φ, Im(Z) φ'] dω     over ω > 0
//! Z = exp(iωx) ∫ P(s) exp(-iωs) ds
//! ```
//!
//! with the stress function φ of `ζ = ω y` in [`Coating::amplitudes`]. In the layer its first term
//! is that of a half-plane, which is known in closed form; the rest falls like `exp(-ω(2h - y))`.
//! In the base all of φ falls like `exp(-ω y)`.

use super::Stress;
use crate::kernel::wavenumbers;
use crate::material::Coating;
use crate::{ContactError, EvaluationError, Interval, Real};
use std::sync::OnceLock;

/// Number of ranges of distance, each twice as wide as the one before. Beyond the last one, at 1e19
/// times the width of the contacts, there is no stress.
const RANGES: usize = 64;

/// Node of the integral over ω.
struct Wave<T> {
    omega: T,
    /// `∫ P exp(-iω(s - c)) ds`, times weight and 1/π: real and imaginary part.
    pressure: [T; 2],
    amplitudes: [T; 4],
}

/// Pressures on a body with a layer.
pub(super) struct Layered<T: Real> {
    pub layer: Coating<T>,
    /// Loads at places, measured from the centre c of the contacts.
    loads: Vec<[T; 2]>,
    centre: T,
    /// Half-width of the contacts, or the thickness if it is larger.
    reach: T,
    period: Option<T>,
    waves: Vec<OnceLock<Vec<Wave<T>>>>,
}

impl<T: Real> Layered<T> {
    /// Creates the stress under loads at places in an interval, or in each period.
    pub fn new(
        layer: Coating<T>,
        mut loads: Vec<[T; 2]>,
        on: Interval<T>,
        period: Option<T>,
    ) -> Self {
        loads.iter_mut().for_each(|[s, _]| *s -= on.centre());
        let reach = on.half_width().max(layer.thickness);
        let waves = (0..RANGES).map(|_| OnceLock::new()).collect();
        Self { layer, loads, centre: on.centre(), reach, period, waves }
    }

    /// Returns the stress at a depth, given that of a half-plane.
    pub fn stress(
        &self,
        half_plane: Stress<T>,
        x: T,
        depth: T,
    ) -> Result<Stress<T>, ContactError<T>> {
        let zero = T::zero();
        let (x, thickness) = (x - self.centre, self.layer.thickness);
        let in_base = depth > thickness;
        if in_base && self.layer.is_on_rigid() {
            return Err(EvaluationError::NoStress { depths: [depth; 2] }.into());
        }
        let mut sum = Stress { sigma_x: zero, sigma_y: zero, tau_xy: zero };
        let falls = if in_base { depth } else { thickness + thickness - depth };
        // As in the rule for ω.
        let last = (T::of(6.0) - T::epsilon().ln()) / falls;
        for wave in self.waves(x.abs() + depth).iter().take_while(|wave| wave.omega <= last) {
            let ([re, im], (sin, cos)) = (wave.pressure, (wave.omega * x).sin_cos());
            let [phi, first, second] = if in_base {
                wave.in_base(wave.omega * (depth - thickness))
            } else {
                wave.in_layer(wave.omega * depth)
            };
            let (re, im) = (re * cos - im * sin, re * sin + im * cos);
            sum.sigma_x += re * second;
            sum.sigma_y -= re * phi;
            sum.tau_xy += im * first;
        }
        Ok(if in_base { sum } else { half_plane.with(T::one(), sum) })
    }

    /// Lists the depths of the layer and of an elastic base.
    pub fn materials(&self) -> Vec<[T; 2]> {
        let (zero, thickness) = (T::zero(), self.layer.thickness);
        let base = [thickness * (T::one() + T::epsilon()), T::one() / zero];
        let count = if self.layer.is_on_rigid() { 1 } else { 2 };
        [[zero, thickness], base][..count].to_vec()
    }

    /// Lists distances beside a contact at which stress is looked for: beside a stiff coating it
    /// bends.
    pub fn beside(&self) -> impl Iterator<Item = T> {
        let most = T::of(8.0) * self.layer.longest();
        let next = |distance: &T| Some(T::of(1.25) * *distance);
        let distances = std::iter::successors(Some(T::of(0.125) * self.layer.thickness), next);
        distances.take_while(move |&distance| distance < most)
    }

    /// Returns the nodes for places at a distance from the centre.
    fn waves(&self, distance: T) -> &[Wave<T>] {
        let (mut range, mut far) = (0, self.reach + self.reach);
        while distance > far && range < RANGES && self.period.is_none() {
            (range, far) = (range + 1, far + far);
        }
        self.waves.get(range).map_or(&[], |waves| waves.get_or_init(|| self.made(range, far)))
    }

    fn made(&self, range: usize, far: T) -> Vec<Wave<T>> {
        // Distances of the contacts along x and of the surface add up to more than half of `far`.
        let near = T::of(0.5) * T::of(0.5).sqrt() * (far - T::of(2.0) * self.reach);
        let near = if range < 2 { T::zero() } else { near };
        let mut waves = Vec::new();
        let mut add = |omega: T, weight: T| {
            let (weight, mut pressure) = (T::frac_1_pi() * weight, [T::zero(); 2]);
            for &[s, load] in &self.loads {
                let (sin, cos) = (omega * s).sin_cos();
                pressure[0] += load * cos;
                pressure[1] -= load * sin;
            }
            let amplitudes = self.layer.amplitudes(omega * self.layer.thickness);
            waves.push(Wave { omega, pressure: pressure.map(|part| weight * part), amplitudes });
        };
        // Half of the mean pressure belongs to either side of ω = 0, where K may be 0/0.
        if let Some(step) = self.period.map(|period| T::two_pi() / period) {
            add(T::epsilon() * step, T::of(0.5) * step);
        }
        let lengths = [self.layer.thickness, self.layer.longest()];
        wavenumbers(lengths, self.period, [near, far + self.reach], add);
        waves
    }
}

impl<T: Real> Wave<T> {
    /// Returns φ, φ' and φ'' at ζ in the layer, without those of the half-plane.
    fn in_layer(&self, zeta: T) -> [T; 3] {
        let (one, two) = (T::one(), T::of(2.0));
        let [excess, slope, ..] = self.amplitudes;
        let (grown, fallen) = (zeta.exp(), (-zeta).exp());
        let (sinh, cosh) = (T::of(0.5) * (grown - fallen), T::of(0.5) * (grown + fallen));
        [
            excess * (zeta * fallen - sinh) + two * slope * zeta * sinh,
            excess * ((one - zeta) * fallen - cosh) + two * slope * (sinh + zeta * cosh),
            excess * ((zeta - two) * fallen - sinh) + two * slope * (two * cosh + zeta * sinh),
        ]
    }

    /// Returns φ, φ' and φ'' at η in the base.
    fn in_base(&self, eta: T) -> [T; 3] {
        let [.., a, b] = self.amplitudes;
        let phi = a + b * eta;
        [phi, b - phi, phi - b - b].map(|part| part * (-eta).exp())
    }
}
