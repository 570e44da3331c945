//! Partial slip: a tangential force that friction carries.
//!
//! The bodies are pressed together first, by P with the load F. Then a force Q < μF acts along the contact, and
//! perhaps one of the bodies is stretched by a tension σ. The middle of each contact sticks; beside it the bodies
//! slip, where the traction is what friction allows. Of like bodies
//!
//! ```text
//! q(x) = μ (P(x) - P*(x)),    ∫ q dx = Q
//! ```
//!
//! where P* is the pressure of the same bodies under the load `F - Q/μ`, with the gap turned by `-σ/(2 μ E*)`; where
//! P* presses the bodies stick (Ciavarella, *Int. J. Solids Struct.* 35, 1998, 2349; Jäger, *Arch. Appl. Mech.* 68,
//! 1998, 1). This holds for any number of contacts, as long as they stick within their contacts; else slip would
//! reverse while the force grows. For Hertz the stick zone is `sqrt(1 - Q/(μF))` of the contact (Cattaneo 1938, Mindlin
//! 1949), moved by `σ L/(4 μ p₀)` (Nowell and Hills 1987).
//!
//! P* is found from the samples of P. So it costs no evaluation, unless a stretched body sticks beside
//! what was sampled.

use super::stress::{Stress, Subsurface};
use super::{Pressure, Solution};
use crate::{Body, ContactError, Interval, Real};

/// What acts along the contact.
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
    /// The coefficient of friction μ, positive.
    pub friction: T,
    /// Q, the force per unit length that acts on body 1 in the direction of positive x; on body 2 it is opposite.
    /// Less than μF, of either sign.
    pub force: T,
    /// σ, the tension along x by which body 1 is stretched under the force, less that of body 2: a pressure, negative
    /// in compression.
    pub tension: T,
}

/// A contact that sticks in part, and slips in part: [`Contact::partial_slip`](crate::Contact::partial_slip).
#[derive(Clone, Debug)]
pub struct PartialSlip<'b, T: Real> {
    normal: Solution<'b, T>,
    stick: Solution<'b, T>,
    shear: Shear<T>,
}

impl<'b, T: Real> PartialSlip<'b, T> {
    /// From the contact, and that which presses where it sticks.
    pub(crate) fn new(
        normal: Solution<'b, T>,
        stick: Solution<'b, T>,
        shear: Shear<T>,
    ) -> Result<Self, ContactError<T>> {
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
                return Err(ContactError::ReversedSlip { zone, contact });
            }
        }
        Ok(Self { normal, stick, shear })
    }

    /// The contact under its load, without what acts along it: limits and pressure are those.
    pub fn normal(&self) -> &Solution<'b, T> {
        &self.normal
    }

    /// Where the bodies stick, from left to right. In the rest of the contacts they slip.
    pub fn stick_zones(&self) -> &[Interval<T>] {
        self.stick.intervals()
    }

    /// What acts along the contact.
    pub fn shear(&self) -> Shear<T> {
        self.shear
    }

    /// The traction q along the contact. It is a difference: its error is the rounding of μP, whatever Q is.
    ///
    /// # Errors
    /// Those of [`Solution::pressure`].
    pub fn traction(&self) -> Result<Traction<'_, T>, ContactError<T>> {
        let pressures = [self.normal.pressure()?, self.stick.pressure()?];
        Ok(Traction { pressures, friction: self.signed_friction() })
    }

    /// The stress below the surface of one of the bodies, from pressure and traction. That of a tension that stretches
    /// the body is to be added to σ_x.
    ///
    /// # Errors
    /// Those of [`Solution::subsurface`].
    pub fn subsurface(&self, body: Body) -> Result<SlipStress<'_, T>, ContactError<T>> {
        let parts = [self.normal.subsurface()?, self.stick.subsurface()?];
        let friction = self.signed_friction();
        let friction = if body == Body::Lower { friction } else { -friction };
        Ok(SlipStress { parts, friction })
    }

    /// μ with the sign of the force on body 1.
    fn signed_friction(&self) -> T {
        if self.shear.force < T::zero() { -self.shear.friction } else { self.shear.friction }
    }
}

/// The traction q along a contact: [`PartialSlip::traction`].
#[derive(Debug)]
pub struct Traction<'p, T: Real> {
    /// P and P*.
    pressures: [Pressure<'p, T>; 2],
    friction: T,
}

impl<T: Real> Traction<'_, T> {
    /// q(x), a pressure: on body 1 in the direction of positive x, on body 2 opposite. Zero outside the contacts.
    ///
    /// # Errors
    /// As [`Pressure::at`].
    pub fn at(&self, x: T) -> Result<T, ContactError<T>> {
        let [pressure, stick] = &self.pressures;
        Ok(self.friction * (pressure.at(x)? - stick.at(x)?))
    }

    /// q(x) at any number of points: cheaper than one by one.
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

/// The stress below a contact that slips in part: [`PartialSlip::subsurface`].
#[derive(Debug)]
pub struct SlipStress<'p, T: Real> {
    /// Of P and P*.
    parts: [Subsurface<'p, T>; 2],
    friction: T,
}

impl<T: Real> SlipStress<'_, T> {
    /// The stress at any x, at any depth from zero on.
    ///
    /// # Errors
    /// As [`Subsurface::at`].
    pub fn at(&self, x: T, depth: T) -> Result<Stress<T>, ContactError<T>> {
        let [normal, stick] = &self.parts;
        let [pressed, along] = normal.parts(x, depth, true)?;
        let [_, less] = stick.parts(x, depth, true)?;
        Ok(pressed.with(self.friction, along).with(-self.friction, less))
    }
}
