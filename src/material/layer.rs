//! Elastic layers.
//!
//! The surface of a layer of thickness h answers a pressure of wavenumber ω like a half-plane of
//! the same material whose compliance is multiplied by K(ξ), ξ = ω h (`E = exp(-2ξ)`, μ the ratio
//! of the shear moduli of layer and base, `κ_i = 3 - 4ν_i`):
//!
//! ```text
//! K = (1 + 4χξE - λχE²)/Δ      Δ = 1 - (λ + χ + 4χξ²) E + λχE²
//! λ = (μκ₂ - κ₁)/(1 + μκ₂)     χ = (μ - 1)/(μ + κ₁)              bonded to a half-plane
//! λ = -κ₁                      χ = -1/κ₁                         bonded to a rigid base
//! K = (1 - E)²/(1 + 4ξE - E²)                                    on a rigid base without friction
//! ```
//!
//! λ and χ are combinations of Dundurs' constants. K - 1 goes to zero like `ξ² exp(-2ξ)`.

use super::sheets::Sheets;
use super::{Elasticity, Material};
use crate::{Body, Fallible, InputError, PlaneState, Real};
use std::sync::Arc;

/// Layer of even thickness at the surface of a body.
///
/// ```
/// use linecontact::{Base, Contact, Control, Flat, Layer, Material, PlaneState};
/// use linecontact::profile::Parabola;
///
/// // A rubber cover of 10 mm on a steel core: mm, MPa, N/mm.
/// let roller = Parabola::new(100.0, [-30.0, 30.0])?;
/// let cover = Layer { material: Material::elastic(5.0, 0.48), thickness: 10.0, base: Base::Bonded };
/// let contact = Contact::new(&Flat, &roller)?;
/// let contact = contact.materials(Material::Rigid, cover, PlaneState::Strain);
/// let nip = contact.solve(Control::Load(20.0))?;
/// assert!(nip.a() > 13.0 && nip.a() < 13.02);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Layer<T> {
    /// Material of the layer.
    pub material: Material<T>,
    /// Thickness h of the layer: a length.
    pub thickness: T,
    /// Body below the layer.
    pub base: Base<T>,
}

/// Body below a layer.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields, rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Base<T> {
    /// Half-plane to which the layer is bonded.
    HalfPlane(Material<T>),
    /// Rigid base to which the layer is bonded.
    Bonded,
    /// Rigid base on which the layer slides without friction and from which it does not lift off.
    Frictionless,
}

/// Several layers, bonded to each other, on a base.
///
/// The stress below them and depths as a [`Reference`](crate::Reference) are refused.
///
/// ```
/// use linecontact::{Base, Contact, Control, Flat, Material, PlaneState, Stack};
/// use linecontact::profile::Parabola;
///
/// // Carbon of 2 µm on nitride of 3 µm on steel: mm, MPa, N/mm.
/// let [carbon, nitride, steel] = [180e3, 280e3, 210e3].map(|e| Material::elastic(e, 0.25));
/// let base = Base::HalfPlane(steel);
/// let coated = Stack { layers: vec![(carbon, 2e-3), (nitride, 3e-3)], base };
/// let roller = Parabola::new(10.0, [-1.0, 1.0])?;
/// let contact = Contact::new(&Flat, &roller)?;
/// let contact = contact.materials(coated, steel, PlaneState::Strain);
/// assert!(contact.solve(Control::Load(10.0))?.a() < 0.034);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Stack<T> {
    /// Layers from the surface down: the material of each, and its thickness, a length.
    pub layers: Vec<(Material<T>, T)>,
    /// Body below the last layer.
    pub base: Base<T>,
}

/// What a body is made of below its surface.
///
/// In a file a half-plane is written as its [`Material`], a layer under the name `layer`, and
/// several under `stack`.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Foundation<T> {
    /// Layer on a base.
    Layer(Layer<T>),
    /// Several layers on a base.
    Stack(Stack<T>),
    /// Half-plane of one material.
    #[cfg_attr(feature = "serde", serde(untagged))]
    HalfPlane(Material<T>),
}

/// Reads a foundation. One enum of all names tells what may stand in a place; without it the line
/// and the field of a fault would be lost.
#[cfg(feature = "serde")]
impl<'de, T: serde::Deserialize<'de>> serde::Deserialize<'de> for Foundation<T> {
    fn deserialize<D: serde::Deserializer<'de>>(file: D) -> Result<Self, D::Error> {
        #[derive(serde::Deserialize)]
        #[serde(deny_unknown_fields, rename_all = "snake_case")]
        enum Material<T> {
            Elastic { youngs_modulus: T, poisson_ratio: T },
            Rigid,
            Layer(Layer<T>),
            Stack(Stack<T>),
        }
        Ok(match Material::deserialize(file)? {
            Material::Elastic { youngs_modulus, poisson_ratio } => {
                Self::HalfPlane(crate::Material::Elastic { youngs_modulus, poisson_ratio })
            }
            Material::Rigid => Self::HalfPlane(crate::Material::Rigid),
            Material::Layer(layer) => Self::Layer(layer),
            Material::Stack(stack) => Self::Stack(stack),
        })
    }
}

impl<T> From<Material<T>> for Foundation<T> {
    fn from(material: Material<T>) -> Self {
        Self::HalfPlane(material)
    }
}

impl<T> From<Layer<T>> for Foundation<T> {
    fn from(layer: Layer<T>) -> Self {
        Self::Layer(layer)
    }
}

impl<T> From<Stack<T>> for Foundation<T> {
    fn from(stack: Stack<T>) -> Self {
        Self::Stack(stack)
    }
}

impl<T: Real> Foundation<T> {
    /// Returns the elastic constants of the surface, with those of a layer below it.
    pub(super) fn elasticity(&self, body: Body, state: PlaneState) -> Fallible<T, Elasticity<T>> {
        let (given, base) = match self {
            Self::HalfPlane(material) => return Elasticity::of(body, *material, state),
            Self::Layer(layer) => (&[(layer.material, layer.thickness)][..], &layer.base),
            Self::Stack(Stack { layers, base }) => (&layers[..], base),
        };
        let mut layers = Vec::with_capacity(given.len());
        for &(material, thickness) in given {
            if !(thickness.is_finite() && thickness > T::zero()) {
                return Err(InputError::InvalidThickness { body, thickness }.into());
            }
            layers.push((Elasticity::of(body, material, state)?, thickness));
        }
        // A rigid layer is a rigid base, whatever is below it.
        let rigid = layers.iter().position(|(of, _)| of.compliance.is_zero());
        layers.truncate(rigid.unwrap_or(layers.len()));
        let (below, slides) = match base {
            Base::HalfPlane(below) if rigid.is_none() => (*below, false),
            _ => (Material::Rigid, rigid.is_none() && *base == Base::Frictionless),
        };
        let below = Elasticity::of(body, below, state)?;
        let Some((surface, thickness)) = layers.first().cloned() else { return Ok(below) };
        let layer = Coating {
            thickness,
            at_zero: below.compliance / surface.compliance - T::one(),
            ratios: [surface.ratio, below.ratio],
            bonded: (!slides).then(|| constants(&surface, &below)),
            sheets: (layers.len() > 1).then(|| Arc::new(Sheets::new(&layers, &below, slides))),
        };
        Ok(Elasticity { layer: Some(layer), ..surface })
    }
}

/// Constants of a layer.
#[derive(Clone, Debug)]
pub(crate) struct Coating<T> {
    pub thickness: T,
    /// K(0) - 1.
    pub at_zero: T,
    /// ν of layer and base.
    ratios: [T; 2],
    /// `[1 - λ, 1 - χ]`; `None` on a base without friction.
    bonded: Option<[T; 2]>,
    /// All layers, if there are more below it.
    sheets: Option<Arc<Sheets<T>>>,
}

/// Returns `1 - λ` and `1 - χ` for a layer bonded to a base; 1/M of a rigid base is zero.
fn constants<T: Real>(layer: &Elasticity<T>, base: &Elasticity<T>) -> [T; 2] {
    let (one, three, four) = (T::one(), T::of(3.0), T::of(4.0));
    let [kappa, below] = [layer.ratio, base.ratio].map(|ratio| three - four * ratio);
    // The shear modulus is M (1 - ν)/2.
    let ratio = (one - layer.ratio) * base.compliance / (layer.compliance * (one - base.ratio));
    [(one + kappa) / (one + ratio * below), (one + kappa) / (ratio + kappa)]
}

impl<T: Real> Coating<T> {
    /// Returns the longest length on which K changes.
    pub fn longest(&self) -> T {
        let single = self.thickness * (T::one() + self.at_zero).max(T::one());
        self.sheets.as_ref().map_or(single, |sheets| sheets.longest())
    }

    /// Tells whether it lies on another layer.
    pub fn is_of_stack(&self) -> bool {
        self.sheets.is_some()
    }

    /// Tells whether the base is rigid.
    pub fn is_on_rigid(&self) -> bool {
        self.at_zero == -T::one()
    }

    /// Returns K - 1, to rounding relative to itself: every sum is one of positive terms.
    pub fn excess(&self, xi: T) -> T {
        let (one, two, four) = (T::one(), T::of(2.0), T::of(4.0));
        if let Some(sheets) = &self.sheets {
            return sheets.excess(xi / self.thickness);
        }
        let [decay, rest] = decays(xi);
        let Some([less_lambda, less_chi]) = self.bonded else {
            return -two * decay * (two * xi + rest) / delta_of_slip(xi, decay);
        };
        let (lambda, chi) = (one - less_lambda, one - less_chi);
        let sum = lambda * less_chi
            + chi * less_lambda
            + four * chi * xi * (one + xi)
            + two * lambda * chi * rest;
        decay * sum / delta([less_lambda, less_chi], xi, [decay, rest])
    }

    /// Returns `[K - 1, D, A, B]` of the stress function of a wave of pressure, with `ζ = ω y` at a
    /// depth y and `η = ζ - ξ`:
    ///
    /// ```text
    /// φ = (1 + ζ)e^{-ζ} + (K - 1)(ζe^{-ζ} - sinh ζ) + 2Dζ sinh ζ         in the layer
    /// φ = (A + Bη) e^{-η}                                                in an elastic base
    /// D = χEV/Δ,   A = e^{-ξ}((1 - λ)U + (1 - χ)V)/(2Δ),   B = e^{-ξ}(1 - λ)U/Δ
    /// U = 1 - χ(1 - 2ξ)E,   V = 1 + 2ξ - λE;   D = -E(1 - E)/(1 + 4ξE - E²)   without friction
    /// ```
    pub fn amplitudes(&self, xi: T) -> [T; 4] {
        let (zero, two) = (T::zero(), T::of(2.0));
        let [decay, rest] = decays(xi);
        let Some([less_lambda, less_chi]) = self.bonded else {
            return [self.excess(xi), -decay * rest / delta_of_slip(xi, decay), zero, zero];
        };
        let (lambda, chi) = (T::one() - less_lambda, T::one() - less_chi);
        let u = less_chi + chi * (rest + two * xi * decay);
        let v = less_lambda + lambda * rest + two * xi;
        let share = delta([less_lambda, less_chi], xi, [decay, rest]).recip();
        let (first, second) = (less_lambda * u, less_chi * v);
        let base = [T::of(0.5) * (first + second), first].map(|a| share * (-xi).exp() * a);
        [self.excess(xi), share * chi * decay * v, base[0], base[1]]
    }

    /// Returns `V - V₀` at a depth in the layer or an elastic base: the displacement by a wave of
    /// pressure, less that in a half-plane of the layer's material, as a multiple of that of the
    /// surface of such a half-plane.
    ///
    /// ```text
    /// V - V₀ = ((K - 1)((1 - 2ν₁ + ζ)e^{-ζ} + cosh ζ)
    ///           + 2D((1 - 2ν₁) sinh ζ - ζ cosh ζ))/(2(1 - ν₁))       in the layer
    /// V      = K(0) (A + B(1 - 2ν₂ + η)) e^{-η}/(2(1 - ν₂))          in the base
    /// V₀     = (1 + ζ/(2(1 - ν₁))) e^{-ζ}
    /// ```
    pub fn displacement(&self, wavenumber: T, depth: T) -> T {
        let (one, two) = (T::one(), T::of(2.0));
        let [excess, slope, a, b] = self.amplitudes(wavenumber * self.thickness);
        let [own, below] = self.ratios.map(|ratio| one - ratio - ratio);
        let (zeta, twice) = (wavenumber * depth, one + own);
        if depth > self.thickness {
            let eta = wavenumber * (depth - self.thickness);
            let in_base = (a + b * (below + eta)) * (-eta).exp() / (one + below);
            return (one + self.at_zero) * in_base - (one + zeta / twice) * (-zeta).exp();
        }
        let (sinh, cosh) = (zeta.sinh(), zeta.cosh());
        let first = excess * ((own + zeta) * (-zeta).exp() + cosh);
        (first + two * slope * (own * sinh - zeta * cosh)) / twice
    }
}

/// Returns E and 1 - E.
fn decays<T: Real>(xi: T) -> [T; 2] {
    let twice = -T::of(2.0) * xi;
    [twice.exp(), -twice.exp_m1()]
}

/// Returns Δ, given `1 - λ`, `1 - χ`, E and 1 - E.
fn delta<T: Real>([less_lambda, less_chi]: [T; 2], xi: T, [decay, rest]: [T; 2]) -> T {
    let (one, four) = (T::one(), T::of(4.0));
    let (lambda, chi) = (one - less_lambda, one - less_chi);
    if chi < T::zero() {
        (one - lambda * decay) * (one - chi * decay) - four * chi * xi * xi * decay
    } else {
        less_lambda * less_chi
            + less_lambda * chi * decay * rest
            + less_chi * lambda * rest
            + four * chi * squares(xi, decay)
    }
}

/// Returns `1 + 4ξE - E²`, given E.
fn delta_of_slip<T: Real>(xi: T, decay: T) -> T {
    let four = T::of(4.0);
    four * xi * decay - (-four * xi).exp_m1()
}

/// Returns `(sinh²ξ - ξ²) exp(-2ξ)`, given the exponential.
fn squares<T: Real>(xi: T, decay: T) -> T {
    if xi > T::of(30.0) {
        return T::of(0.25);
    }
    // sinh ξ - ξ, below 1.5 by its series: eleven terms leave an error of 1e-17.
    let less = if xi < T::of(1.5) {
        let (mut term, mut sum) = (xi * xi * xi / T::of(6.0), T::zero());
        for k in 1..=11 {
            sum += term;
            term *= xi * xi / T::count((2 * k + 2) * (2 * k + 3));
        }
        sum
    } else {
        xi.sinh() - xi
    };
    less * (less + xi + xi) * decay
}
