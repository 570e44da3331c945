//! A pin in a hole that it nearly fills.

use super::{ReferenceError, check, positive};
use crate::material::Elasticity;
use crate::search::{Bracket, Brent, LimitSearch, SearchError};
use crate::{ContactError, Material, PlaneState, Real};

/// Pin in a hole of nearly the same radius R, pressed into it by a load Q on a unit of its length:
/// an arc of the half-angle ε, on which the bodies are no half-planes (Persson, *On the stress
/// distribution of cylindrical elastic bodies in contact*, 1964; Ciavarella and Decuzzi, *Int. J.
/// Solids Struct.* 38, 2001, 4507).
///
/// ```text
/// π E* ΔR/Q sin²(ε/2) = cos⁴(ε/2) (1 + 2 s ln cos(ε/2)) - 2 s sin⁴(ε/2),      s = E*/E*_hole
/// π R P/Q = 2 ρ cos(θ/2) + cos⁴(ε/2)/sin²(ε/2) arsinh(ρ/cos(ε/2)),      ρ² = sin²(ε/2) - sin²(θ/2)
/// ```
///
/// ΔR is the radius of the hole less that of the pin, small beside R, E*_hole the plane modulus of
/// the hole, which is 2 E* for like materials. These must have Dundurs' β = 0, like two of one
/// material, or incompressible ones.
///
/// An arc is no profile of a half-plane, and so this is no [`ClosedForm`](super::ClosedForm): a
/// solution for half-planes is off by what its [`conformity`](crate::Solution::conformity) says.
/// Hertz's formulas, with parabolas for the circles, give under the same load a largest pressure
/// that is too low by 1.2, 4.8, 10.8 and 24.0 % at half-angles of 10°, 20°, 30° and 45°.
///
/// ```
/// use linecontact::reference::PinInHole;
/// use linecontact::{Material, PlaneState};
///
/// let steel = Material::elastic(210e3f64, 0.3); // MPa
/// let form = PinInHole::under_load(10.0, 0.02, 2000.0, [steel, steel], PlaneState::Strain)?;
/// assert!((form.half_angle().to_degrees() - 48.17).abs() < 0.01);
/// assert!((form.pressure(0.0) - 167.0).abs() < 0.1);
/// # Ok::<(), linecontact::ContactError<f64>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PinInHole<T> {
    radius: T,
    half_angle: T,
    load: T,
}

impl<T: Real> PinInHole<T> {
    /// Creates the form from the radius R and the half-angle ε, in radians, under a load of 1. The
    /// pressure is in proportion to the load.
    ///
    /// # Errors
    /// [`ReferenceError::Parameter`] if one of them is not positive and finite, or ε is not less
    /// than π.
    pub fn new(radius: T, half_angle: T) -> Result<Self, ReferenceError<T>> {
        positive([("the radius", radius), ("the half-angle", half_angle)])?;
        check("the half-angle", half_angle, half_angle < T::pi(), "less than π")?;
        Ok(Self { radius, half_angle, load: T::one() })
    }

    /// Creates the form from the radius R, the clearance ΔR, the load Q per unit length and the
    /// materials of pin and hole.
    ///
    /// Without clearance the half-angle depends on the materials alone, and is 84.83° for like
    /// ones. An interference, a negative clearance, is taken too if the load parts the bodies on
    /// the far side of the pin: it does where `-ΔR < 2 Q/(π E*_hole)`.
    ///
    /// # Errors
    /// [`ReferenceError::Parameter`] if radius or load is not positive and finite, the clearance is
    /// not finite, or an interference is so large that the bodies touch all round;
    /// [`InputError::UnlikeBodies`](crate::InputError::UnlikeBodies) if β is not zero, and the
    /// errors of [`PlaneState::contact_modulus`], to which the hole is the lower body.
    pub fn under_load(
        radius: T,
        clearance: T,
        load: T,
        [pin, hole]: [Material<T>; 2],
        state: PlaneState,
    ) -> Result<Self, ContactError<T>> {
        let (bodies, modulus) = Elasticity::of_bodies(&[hole.into(), pin.into()], state)?;
        Elasticity::check_like(&bodies)?;
        positive([("the radius", radius), ("the load", load)])?;
        let share = bodies[0].compliance * modulus;
        let wanted = T::pi() * (modulus / load) * clearance;
        let must = "more than -2 Q/(π E*) with E* of the hole: else the bodies touch all round";
        check("the clearance", clearance, wanted > -T::of(2.0) * share, must)?;
        let half_angle = half_angle(wanted, share);
        Ok(Self { load, ..Self::new(radius, half_angle)? })
    }

    /// Returns the half-angle ε of the contact, in radians.
    pub fn half_angle(&self) -> T {
        self.half_angle
    }

    /// Returns the pressure at an angle θ from the middle of the contact, in radians: zero outside
    /// the contact.
    pub fn pressure(&self, angle: T) -> T {
        let half = T::of(0.5);
        let (sin, cos) = (half * self.half_angle).sin_cos();
        // sin² ε/2 - sin² θ/2
        let [left, right] = [self.half_angle + angle, self.half_angle - angle];
        if left < T::zero() || right < T::zero() {
            return T::zero();
        }
        let root = (half * left).sin().sqrt() * (half * right).sin().sqrt();
        let even = T::of(2.0) * root * (half * angle).cos();
        let rest = cos.powi(4) / sin * ((root / cos).asinh() / sin);
        self.load / self.radius * T::frac_1_pi() * (even + rest)
    }
}

/// Returns the half-angle for `π E* ΔR/Q` and the share of the compliance that is the hole's.
fn half_angle<T: Real>(wanted: T, share: T) -> T {
    let (one, two) = (T::one(), T::of(2.0));
    // By v = sin² ε/2, in which the right side less the left one falls from 1, steadily.
    let less = |v: T| (one - v).powi(2) * (one + share * (-v).ln_1p()) - two * share * v * v;
    let mut excess = |v: T| less(v) - wanted * v;
    let bracket = if wanted > two {
        Bracket::new(T::zero(), two / wanted)
    } else {
        Bracket::new(T::zero(), one).values(one, -two * share - wanted)
    };
    let v = match Brent::DEFAULT.find(&mut excess, &bracket) {
        Ok(root) | Err(SearchError::Budget { best: root }) => root.x,
        // The load has left no angle.
        Err(_) => T::zero(),
    };
    two * v.sqrt().atan2((one - v).sqrt())
}
