//! Several layers, bonded to each other: the compliance of the surface, from the base up.
//!
//! Below a wave of pressure of wavenumber ω the stress function of a layer is f(y) cos ωx with
//!
//! ```text
//! f = (a + bζ) e^{-ζ} + (c + dη) e^{η}      ζ = ωy from its top, η = ωy from its bottom
//! ```
//!
//! The tractions are f and f', the displacements, in units of 1/(2Gω), are
//! `V = (1 - ν)f''' - (2 - ν)f'` and `U = (1 - ν)f'' + νf`. With the compliance Y of what is below,
//! the displacements there are Y times the tractions: so the waves c, d that rise from the bottom
//! are a matrix times those that sink, which fall by `e^{-2ξ}` on their way down and up, with
//! `ξ = ωh`. In units of 1/(2G), Y of the top of the layer is that of a half-plane and
//!
//! ```text
//! W = 4(1 - ν) [[-1, 0], [1, 1]] R (T₋ + T₊R)⁻¹     T₋ = [[1, 0], [-1, 1]], T₊ = [[1, 0], [1, 1]]
//! ```
//!
//! with R the rising waves by the sinking ones at the top, and T the tractions of either. At the
//! surface `K - 1 = W₀₀/(2(1 - ν))`.

use super::Elasticity;
use crate::Real;
use nalgebra::Matrix2;

/// Layers from the surface down, and their base.
#[derive(Clone, Debug)]
pub(crate) struct Sheets<T> {
    layers: Vec<Sheet<T>>,
    base: Sheet<T>,
    /// Flag: the base is rigid, and the lowest layer slides on it.
    slides: bool,
}

/// Layer or base: 1/(2G), ν, and the thickness.
#[derive(Clone, Copy, Debug)]
struct Sheet<T> {
    softness: T,
    ratio: T,
    thickness: T,
}

impl<T: Real> Sheet<T> {
    fn new(of: &Elasticity<T>, thickness: T) -> Self {
        // The shear modulus is M (1 - ν)/2.
        Self { softness: of.compliance / (T::one() - of.ratio), ratio: of.ratio, thickness }
    }
}

impl<T: Real> Sheets<T> {
    /// Takes layers from the surface down, each with its thickness, and their base.
    pub fn new(layers: &[(Elasticity<T>, T)], base: &Elasticity<T>, slides: bool) -> Self {
        let sheets = layers.iter().map(|(of, thickness)| Sheet::new(of, *thickness));
        Self { layers: sheets.collect(), base: Sheet::new(base, T::zero()), slides }
    }

    /// Returns K - 1 at a wavenumber.
    pub fn excess(&self, wavenumber: T) -> T {
        let (one, two, zero) = (T::one(), T::of(2.0), T::zero());
        let tractions = [-one, one].map(|sign| Matrix2::new(one, zero, sign, one));
        let (mut below, mut slides) =
            (half_plane(self.base.ratio) * self.base.softness, self.slides);
        let (mut excess, mut share) = (Matrix2::zeros(), zero);
        for &Sheet { softness, ratio, thickness } in self.layers.iter().rev() {
            let (xi, rest) = (wavenumber * thickness, one - ratio);
            // The waves that sink and those that rise, at the bottom.
            let [sinking, rising] =
                [(one, tractions[0]), (-one, tractions[1])].map(|(sign, waves)| {
                    let moved = Matrix2::new(sign, one - ratio - ratio, one, -sign * two * rest);
                    let misfit = moved * softness - below * waves;
                    let sliding = Matrix2::from_rows(&[moved.row(0), waves.row(1)]);
                    if slides { sliding } else { misfit }
                });
            let [down, up] = [xi, -xi].map(|way| Matrix2::new(one, way, zero, one));
            let unknown = Matrix2::from_element(T::of(f64::NAN));
            let inverse = |of: Matrix2<T>| of.try_inverse().unwrap_or(unknown);
            let reflected = up * inverse(rising) * sinking * down * -(-two * xi).exp();
            let loads = inverse(tractions[0] + tractions[1] * reflected);
            excess = Matrix2::new(-one, zero, one, one) * reflected * loads * (T::of(4.0) * rest);
            (below, slides) = ((half_plane(ratio) + excess) * softness, false);
            share = two * rest;
        }
        excess[(0, 0)] / share
    }

    /// Returns the longest length on which K changes: all layers, by the largest ratio of the
    /// stiffness of one to that of something below it.
    pub fn longest(&self) -> T {
        let (mut length, mut ratio, mut stiffest) = (T::zero(), T::one(), T::zero());
        for sheet in self.layers.iter().chain([&self.base]) {
            length += sheet.thickness;
            ratio = ratio.max(stiffest * sheet.softness);
            stiffest = stiffest.max(sheet.softness.recip());
        }
        length * ratio
    }
}

/// Returns the compliance of a half-plane.
fn half_plane<T: Real>(ratio: T) -> Matrix2<T> {
    let (normal, other) = (T::of(2.0) * (T::one() - ratio), T::one() - ratio - ratio);
    Matrix2::new(normal, other, -other, -normal)
}

#[cfg(test)]
mod tests {
    use crate::{Base, Body, Foundation, Material, PlaneState, Stack};

    /// K of two layers, each `[E, ν, h]`, by a direct system of all conditions in 60 digits.
    #[test]
    fn compliances_of_sixty_digits() {
        let elastic = |[e, nu]: [f64; 2]| Material::elastic(e, nu);
        let like = Base::HalfPlane(elastic([1.0, 0.3]));
        let soft = Base::HalfPlane(elastic([0.5, 0.3]));
        let cases = [
            (
                [[4.0, 0.05, 0.2], [0.4, 0.35, 0.6]],
                soft,
                [[0.01, 6.281148418660201], [3.0, 4.771779487576218]],
                4e-15,
            ),
            (
                [[1.0, 0.5, 0.5], [2.0, 0.3, 0.5]],
                Base::Bonded,
                [[0.1, -0.9874425183758307], [3.0, -0.308315731794438]],
                4e-15,
            ),
            (
                [[1.0, 0.3, 0.5], [2.0, 0.3, 0.5]],
                Base::Frictionless,
                [[0.1, -0.9632742002135289], [10.0, -0.001214569683325657]],
                4e-15,
            ),
            (
                [[1000.0, 0.3, 0.5], [1.0, 0.3, 0.5]],
                like,
                [[0.01, 923.4551877194525], [3.0, 1.83909414671434]],
                4e-13,
            ),
            (
                [[1.0, 0.3, 0.5], [1000.0, 0.3, 0.5]],
                like,
                [[0.3, -0.36432149278526216], [10.0, -0.0031204397347610454]],
                4e-13,
            ),
        ];
        for (layers, base, values, tolerance) in cases {
            let layers = layers.map(|[e, nu, h]| (elastic([e, nu]), h)).to_vec();
            let of = Foundation::from(Stack { layers, base });
            let layer = of.elasticity(Body::Lower, PlaneState::Strain).unwrap().layer.unwrap();
            for [wavenumber, exact] in values {
                let off = (layer.excess(wavenumber * layer.thickness) - exact) / exact;
                assert!(off.abs() < tolerance, "{base:?} {wavenumber}: {off:e}");
            }
        }
    }
}
