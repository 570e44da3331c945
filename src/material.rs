//! Materials of the bodies, and the points between which an approach is measured.
//!
//! ```text
//! 1/E* = 1/M₁ + 1/M₂      M = E/(1 - ν²) in plane strain, M = E in plane stress
//! ```
//!
//! (Johnson, *Contact Mechanics*, 1985, §4.2 for plane strain.) Plane stress is plane strain with
//! `ν/(1 + ν)` in place of ν and the same M (Timoshenko and Goodier, *Theory of Elasticity*, 1970,
//! §§ 16 and 17).
//!
//! **Unlike bodies.** Without friction, E* is the only elastic constant in the equations of a
//! half-plane: limits and pressure are as exact for unlike bodies as for like ones. Friction would
//! couple the two directions (Johnson, §7.2).

mod layer;
mod sheets;

pub(crate) use layer::Coating;
pub use layer::{Base, Foundation, Layer, Stack};

use crate::{Body, ContactError, Fallible, InputError, Real};

/// Isotropic elastic material, or a rigid body.
///
/// ```
/// use linecontact::{Material, PlaneState};
///
/// let steel = Material::elastic(210e3, 0.3); // MPa
/// let modulus = PlaneState::Strain.contact_modulus(steel, steel)?;
/// assert!((modulus / (210e3 / (2.0 * 0.91)) - 1.0f64).abs() < 1e-15);
/// let on_rigid = PlaneState::Strain.contact_modulus(Material::Rigid, steel)?;
/// assert!((on_rigid / modulus - 2.0).abs() < 1e-15);
/// # Ok::<(), linecontact::ContactError<f64>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields, rename_all = "snake_case"))]
pub enum Material<T> {
    /// Elastic and the same in all directions.
    Elastic {
        /// Young's modulus E: a pressure.
        youngs_modulus: T,
        /// Poisson's ratio ν, from 0 to 1/2.
        poisson_ratio: T,
    },
    /// Rigid: the body keeps its shape.
    Rigid,
}

impl<T: Real> Material<T> {
    /// Creates an elastic material from Young's modulus E, a pressure, and Poisson's ratio ν, from
    /// 0 to 1/2.
    #[must_use]
    pub fn elastic(youngs_modulus: T, poisson_ratio: T) -> Self {
        Self::Elastic { youngs_modulus, poisson_ratio }
    }
}

/// Point of a body that its surface approaches.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields, rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Reference<T> {
    /// Point at this depth below the surface, a length: in the half-plane, in a layer, or in the
    /// base below it.
    Depth(T),
    /// Centre of a disc of this radius, a length, which is loaded at the opposite point: a roller
    /// between two plates (Johnson, *Contact Mechanics*, 1985, §5.6). The formula is for a contact
    /// that is small beside the disc; its error is of the order of `(L/R)²`. A roller between two
    /// blocks has a contact on each side: the approaches add. A layer must be thin beside the disc.
    Disc(T),
    /// ℓ in `2 ln(ℓ/|x - s|)`, a length, longer than the contact: with a short one, approach and
    /// stiffness are negative. A constant C as in `C - 2 ln|x - s|` means `ℓ = exp(C/2)`. Below a
    /// layer it is the constant of the base, as it is seen from far beside the contact.
    Length(T),
}

/// References of both bodies. Those of a [rigid](crate::Material::Rigid) body, of a layer on a
/// rigid base and of bodies that repeat are not used.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct References<T> {
    /// Abscissa x of the references, on the bodies or beside them. It matters for depths of a few
    /// half-widths, not for far larger ones, nor for discs and lengths.
    pub x: T,
    /// Reference of body 1.
    pub lower: Reference<T>,
    /// Reference of body 2.
    pub upper: Reference<T>,
}

/// Thickness of the bodies, across the plane of the contact.
///
/// A roller, a gear tooth or a rail is long beside the width of its contact: the material inside
/// cannot expand along it, and the strain is plane. A thin disc or a sheet that is loaded on its
/// edge is short beside the width: the *stress* is plane. Within about one half-width of the ends
/// of a roller neither holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum PlaneState {
    /// Bodies much longer than the contact is wide.
    #[default]
    Strain,
    /// Bodies much shorter than the contact is wide.
    Stress,
}

impl PlaneState {
    /// Returns the contact modulus E* of two bodies, a pressure.
    ///
    /// # Errors
    /// [`InputError::InvalidYoungsModulus`], [`InputError::InvalidPoissonRatio`];
    /// [`InputError::BothRigid`].
    pub fn contact_modulus<T: Real>(
        self,
        lower: Material<T>,
        upper: Material<T>,
    ) -> Result<T, ContactError<T>> {
        Ok(Elasticity::of_bodies(&[lower.into(), upper.into()], self)?.1)
    }
}

/// Elastic constants that the surface of a body depends on.
#[derive(Clone, Debug)]
pub(crate) struct Elasticity<T> {
    /// 1/M, zero for a rigid body.
    pub compliance: T,
    /// ν in plane strain, `ν/(1 + ν)` in plane stress.
    pub ratio: T,
    /// Layer at the surface, if there is one; the other constants are those of its material.
    pub layer: Option<Coating<T>>,
}

impl<T: Real> Elasticity<T> {
    /// Returns the elastic constants of both bodies, and their contact modulus.
    pub fn of_bodies(
        foundations: &[Foundation<T>; 2],
        state: PlaneState,
    ) -> Result<([Self; 2], T), ContactError<T>> {
        let lower = foundations[0].elasticity(Body::Lower, state)?;
        let upper = foundations[1].elasticity(Body::Upper, state)?;
        let compliance = lower.compliance + upper.compliance;
        if compliance.is_zero() {
            return Err(InputError::BothRigid.into());
        }
        Ok(([lower, upper], T::one() / compliance))
    }

    /// Returns Dundurs' β, zero for like bodies and for incompressible ones. With β = 0 friction
    /// leaves the pressure unchanged (Johnson, Eq. 5.3).
    pub fn dundurs([lower, upper]: &[Self; 2]) -> T {
        // (1 - 2ν)/(2 G), with 1/M = (1 - ν)/(2 G).
        let coupling = |body: &Self| {
            body.compliance * (T::one() - body.ratio - body.ratio) / (T::one() - body.ratio)
        };
        T::of(0.5) * (coupling(lower) - coupling(upper)) / (lower.compliance + upper.compliance)
    }

    /// Refuses bodies whose β is not zero to rounding.
    pub fn check_like(bodies: &[Self; 2]) -> Result<(), InputError<T>> {
        let beta = Self::dundurs(bodies);
        let is_zero = beta.abs() <= T::of(16.0) * T::epsilon();
        if is_zero { Ok(()) } else { Err(InputError::UnlikeBodies { beta }) }
    }

    fn of(body: Body, material: Material<T>, state: PlaneState) -> Fallible<T, Self> {
        let (zero, one) = (T::zero(), T::one());
        let Material::Elastic { youngs_modulus: modulus, poisson_ratio: ratio } = material else {
            return Ok(Self { compliance: zero, ratio: zero, layer: None });
        };
        let compliance = one / modulus;
        if !(modulus.is_finite() && modulus > zero && compliance.is_finite()) {
            return Err(InputError::InvalidYoungsModulus { body, modulus }.into());
        }
        checked_ratio(ratio, Some(body))?;
        let [compliance, ratio] = match state {
            PlaneState::Strain => [(one - ratio) * (one + ratio) * compliance, ratio],
            PlaneState::Stress => [compliance, ratio / (one + ratio)],
        };
        Ok(Self { compliance, ratio, layer: None })
    }
}

/// Refuses a number that cannot be a Poisson's ratio.
pub(crate) fn checked_ratio<T: Real>(ratio: T, body: Option<Body>) -> Fallible<T, T> {
    let is_valid = ratio >= T::zero() && ratio <= T::of(0.5);
    if is_valid { Ok(ratio) } else { Err(InputError::InvalidPoissonRatio { body, ratio }.into()) }
}
