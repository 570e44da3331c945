//! Partial slip: a tangential force that friction carries.
//!
//! The bodies are first pressed together, by P with the load F. Then a force Q < μF acts along the
//! contact, and one of the bodies may be stretched by a tension σ. The middle of each contact
//! sticks. At its sides the bodies slip, with the traction at the friction limit. For like bodies
//!
//! ```text
//! q(x) = μ (P(x) - P*(x)),    ∫ q dx = Q
//! ```
//!
//! where P* is the pressure of the same bodies under the load `F - Q/μ`, with the gap turned by
//! `-σ/(2 μ E*)`. The bodies stick wherever P* is positive (Ciavarella, *Int. J. Solids Struct.*
//! 35, 1998, 2349; Jäger, *Arch. Appl. Mech.* 68, 1998, 1). This holds for any number of contacts,
//! as long as each stick zone lies within a contact; otherwise slip would reverse while the force
//! grows. For Hertz the stick zone is `sqrt(1 - Q/(μF))` of the contact (Cattaneo 1938, Mindlin
//! 1949), moved by `σ L/(4 μ p₀)` (Nowell and Hills 1987).
//!
//! P* is found from the samples of P, without an evaluation, unless a stretched body sticks outside
//! the sampled range.

use super::stress::{Stress, StressPeak, Subsurface};
use super::{Extremum, Pressure, Solution};
use crate::{Body, ContactError, Fallible, Interval, Real, SolveError};

/// Loads along the contact, and its friction.
///
/// ```
/// use linecontact::profile::Parabola;
/// use linecontact::{Contact, Control, Flat, Shear};
///
/// let body = Parabola::new(1.0f64, [-1.0, 1.0])?;
/// let contact = Contact::new(&Flat, &body)?.contact_modulus(1.0);
/// let shear = Shear { friction: 0.4, force: 0.03, tension: 0.0 };
/// let slip = contact.partial_slip(Control::Load(0.1), shear)?;
/// let stick = slip.stick_zones()[0].half_width() / slip.normal().a();
/// assert!((stick - 0.25f64.sqrt()).abs() < 1e-14); // sqrt(1 - Q/(μF))
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
pub struct Shear<T> {
    /// Coefficient of friction μ, positive.
    pub friction: T,
    /// Q, the force per unit length that acts on body 1 in the direction of positive x, and on body
    /// 2 in the opposite one. Less than μF in size, of either sign.
    pub force: T,
    /// σ, the tension along x that stretches body 1 under the force, less the tension in body 2: a
    /// pressure, negative in compression.
    pub tension: T,
}

/// Contact that sticks in part, and slips in part:
/// [`Contact::partial_slip`](crate::Contact::partial_slip).
#[derive(Clone, Debug)]
pub struct PartialSlip<'b, T: Real> {
    normal: Solution<'b, T>,
    stick: Solution<'b, T>,
    shear: Shear<T>,
}

impl<'b, T: Real> PartialSlip<'b, T> {
    /// Combines the contact under P with the contact under P*, which covers the stick zones.
    pub(crate) fn new(
        normal: Solution<'b, T>,
        stick: Solution<'b, T>,
        shear: Shear<T>,
    ) -> Fallible<T, Self> {
        let error = |solution: &Solution<'_, T>| solution.limits_error().unwrap_or(T::zero());
        let open = T::of(16.0) * (T::epsilon() + error(&normal) + error(&stick));
        for &zone in stick.intervals() {
            let middle = zone.centre();
            let mut contacts = normal.intervals().iter();
            let around = contacts.find(|on| on.left <= middle && on.right >= middle);
            let is_within = |on: &Interval<T>| {
                let rounding = T::epsilon() * (on.left.abs() + on.right.abs());
                let allowed = open * on.half_width() + rounding;
                zone.left >= on.left - allowed && zone.right <= on.right + allowed
            };
            if !around.is_some_and(is_within) {
                let contact = around.copied().unwrap_or(normal.hull());
                return Err(SolveError::ReversedSlip { zone, contact }.into());
            }
        }
        Ok(Self { normal, stick, shear })
    }

    /// Returns the contact under its normal load alone; forces along it change neither limits nor
    /// pressure.
    pub fn normal(&self) -> &Solution<'b, T> {
        &self.normal
    }

    /// Returns the intervals in which the bodies stick, from left to right. In the rest of the
    /// contacts they slip.
    pub fn stick_zones(&self) -> &[Interval<T>] {
        self.stick.intervals()
    }

    /// Returns the loads along the contact, and its friction.
    pub fn shear(&self) -> Shear<T> {
        self.shear
    }

    /// Returns the traction q along the contact. As a difference of pressures it has the rounding
    /// error of μP, whatever Q is.
    ///
    /// # Errors
    /// Those of [`Solution::pressure`].
    pub fn traction(&self) -> Result<Traction<'_, T>, ContactError<T>> {
        let pressures = [self.normal.pressure()?, self.stick.pressure()?];
        Ok(Traction { pressures, friction: self.signed_friction() })
    }

    /// Returns the stress below the surface of one of the bodies, from pressure and traction. The
    /// stress of a tension that stretches the body has to be added to σ_x.
    ///
    /// # Errors
    /// Those of [`Solution::subsurface`].
    pub fn subsurface(&self, body: Body) -> Result<SlipStress<'_, T>, ContactError<T>> {
        let friction = self.signed_friction();
        let friction = if body == Body::Lower { friction } else { -friction };
        let normal = self.normal.subsurface()?.friction(friction)?;
        Ok(SlipStress(normal.less(self.stick.subsurface()?)))
    }

    /// Returns μ with the sign of the force on body 1. Without a force there is no traction.
    fn signed_friction(&self) -> T {
        let Shear { friction, force, .. } = self.shear;
        if force.is_zero() { force } else { friction.copysign(force) }
    }
}

/// Traction q along a contact: [`PartialSlip::traction`].
#[derive(Debug)]
pub struct Traction<'p, T: Real> {
    /// P and P*.
    pressures: [Pressure<'p, T>; 2],
    friction: T,
}

impl<T: Real> Traction<'_, T> {
    /// Returns q(x), a pressure: on body 1 in the direction of positive x, on body 2 opposite. Zero
    /// outside the contacts.
    ///
    /// # Errors
    /// As [`Pressure::at`].
    pub fn at(&self, x: T) -> Result<T, ContactError<T>> {
        let [pressure, stick] = &self.pressures;
        Ok(self.friction * (pressure.at(x)? - stick.at(x)?))
    }

    /// Fills in q(x) at any number of points, faster than one by one.
    ///
    /// # Errors
    /// As [`Pressure::at_many`].
    pub fn at_many(&self, x: &[T], tractions: &mut [T]) -> Result<(), ContactError<T>> {
        let [pressure, stick] = &self.pressures;
        let mut other = vec![T::zero(); tractions.len()];
        pressure.at_many(x, tractions)?;
        stick.at_many(x, &mut other)?;
        for (traction, other) in tractions.iter_mut().zip(other) {
            *traction = self.friction * (*traction - other);
        }
        Ok(())
    }
}

/// Stress below a contact that slips in part: [`PartialSlip::subsurface`].
///
/// Cracks of fretting start where the surface is stretched most: at the edge of the contact that
/// the traction pulls away from.
///
/// ```
/// use linecontact::profile::Parabola;
/// use linecontact::{Body, Contact, Control, Flat, Shear};
///
/// let body = Parabola::new(1.0f64, [-1.0, 1.0])?;
/// let contact = Contact::new(&Flat, &body)?.contact_modulus(1.0);
/// let shear = Shear { friction: 0.4, force: 0.03, tension: 0.0 };
/// let slip = contact.partial_slip(Control::Load(0.1), shear)?;
/// let tension = slip.subsurface(Body::Lower)?.max_tension()?;
/// assert_eq!(tension.x, -slip.normal().b());
/// // 2 μ p₀ sqrt(Q/(μF))
/// let peak = slip.normal().peak()?.pressure;
/// assert!((tension.value / (2.0 * 0.4 * peak * 0.75f64.sqrt()) - 1.0).abs() < 1e-13);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct SlipStress<'p, T: Real>(Subsurface<'p, T>);

impl<T: Real> SlipStress<'_, T> {
    /// Returns the stress at any x, at any depth from zero on.
    ///
    /// # Errors
    /// As [`Subsurface::at`].
    pub fn at(&self, x: T, depth: T) -> Result<Stress<T>, ContactError<T>> {
        self.0.at(x, depth)
    }

    /// Finds the largest shear stress in the plane, as [`Subsurface::max_shear`] does, with the
    /// limits of the stick zones among the places where it is looked for.
    ///
    /// # Errors
    /// As [`Subsurface::max_shear`]. Where the slope of the gap jumps, the shear is infinite only
    /// if the bodies slip there.
    pub fn max_shear(&self) -> Result<StressPeak<T>, ContactError<T>> {
        self.0.max_shear()
    }

    /// Finds the largest von Mises equivalent stress, in the same way.
    ///
    /// # Errors
    /// As [`max_shear`](Self::max_shear), and where the slope of the gap jumps, unless ν is 1/2;
    /// [`InputError::InvalidPoissonRatio`](crate::InputError::InvalidPoissonRatio).
    pub fn max_von_mises(&self, poisson: T) -> Result<StressPeak<T>, ContactError<T>> {
        self.0.max_von_mises(poisson)
    }

    /// Finds the largest tension along the surface, as [`Subsurface::max_tension`] does. A tension
    /// that stretches the body has to be added.
    ///
    /// # Errors
    /// As [`Subsurface::max_tension`].
    pub fn max_tension(&self) -> Result<Extremum<T>, ContactError<T>> {
        self.0.max_tension()
    }
}
