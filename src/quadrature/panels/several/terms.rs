//! Terms of V besides its integrals.

use super::super::cauchy_transform::inverse;
use super::weight::Weight;
use crate::Real;
use nalgebra::Complex;

/// Sum of a linear function and of poles in gaps.
///
/// V has the terms `-π Σ c/(x - μ)` over the poles μ of p, and with more corners than contacts
/// `-π F`.
#[derive(Clone, Debug)]
pub(in super::super) struct Terms<T> {
    /// Place about which the linear function is written, its value there, and its slope.
    pub about: T,
    pub by_power: [T; 2],
    /// Number of the gap, place and residue of each pole.
    pub poles: Vec<(usize, T, T)>,
}

impl<T: Real> Terms<T> {
    pub fn none() -> Self {
        Self { about: T::zero(), by_power: [T::zero(); 2], poles: Vec::new() }
    }

    /// Returns the sum at a place.
    pub fn at(&self, x: T) -> T {
        self.beside(usize::MAX, x)
    }

    /// Returns the sum at a place in gap k, times the distance from its pole, if it has one.
    pub fn in_gap(&self, k: usize, x: T) -> T {
        let own = self.poles.iter().find(|&&(gap, ..)| gap == k);
        own.map_or(self.at(x), |&(_, pole, residue)| self.beside(k, x) * (x - pole) + residue)
    }

    /// Returns the slope of the chord from a place, in a gap without a pole, to another.
    pub fn chord(&self, [from, to]: [T; 2]) -> T {
        self.poles.iter().fold(self.by_power[1], |sum, &(_, pole, residue)| {
            sum - residue / ((from - pole) * (to - pole))
        })
    }

    /// Returns the sum of the residues, each times a power of the distance of its pole.
    pub fn residues(&self, from: T, power: i32) -> T {
        self.poles.iter().fold(T::zero(), |sum, &(_, x, by)| sum + by * (x - from).powi(power))
    }

    /// Returns the sum times a width and its derivative at a place in the plane, given the
    /// distances from it in widths.
    pub fn in_plane(&self, place: &impl Fn(T) -> Complex<T>, width: T) -> [Complex<T>; 2] {
        let zero = Complex::new(T::zero(), T::zero());
        let start = [Complex::new(self.by_power[0] * width, T::zero()), zero];
        self.poles.iter().fold(start, |[sum, rate], &(_, pole, residue)| {
            let by = inverse(place(pole));
            let part = by * residue;
            [sum + part, rate - part * by]
        })
    }

    /// Returns the sum without the pole in gap k.
    fn beside(&self, k: usize, x: T) -> T {
        let [constant, slope] = self.by_power;
        let others = self.poles.iter().filter(|&&(gap, ..)| gap != k);
        others.fold(constant + slope * (x - self.about), |sum, &(_, pole, residue)| {
            sum + residue / (x - pole)
        })
    }
}

impl<T: Real> Weight<T> {
    /// Returns the terms of V for a load, given as F/κ, and the residues c at the poles of p.
    pub(super) fn terms(&self, load: T, residues: &[T]) -> Terms<T> {
        let pole = |((k, x), &residue): ((usize, T), &T)| (k, x, -T::pi() * residue);
        let poles = self.poles().zip(residues).map(pole).collect();
        let constant = if self.is_inverse() { -T::pi() * load } else { T::zero() };
        Terms { about: T::zero(), by_power: [constant, T::zero()], poles }
    }
}
