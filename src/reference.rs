//! Closed forms: contacts whose limits, load and pressure are known, to test a solver against.
//!
//! | form | the upper body, on a flat | load known, limits known |
//! |---|---|---|
//! | [`Hertz`] | parabola; also the gap outside | both ways |
//! | [`Jkr`] | parabola with adhesion | both ways, load to limits by a quartic equation |
//! | [`Wedge`] | two straight flanks, alike or not | both ways |
//! | [`PowerLaw`] | `A abs(x)ⁿ`, any real n ≥ 1 | both ways |
//! | [`Biquadratic`] | `x²/(2R) + B x⁴` | both ways |
//! | [`UnequalRadii`] | parabola with two radii, left and right | both ways, by one equation |
//! | [`RoundedPunch`] | flat with parabolic edges | both ways, load to limits by one equation |
//! | [`FlatPunch`] | flat with sharp edges, upright or tilted | load to limits |
//! | [`Crowning`] | logarithmic relief, `-C ln(1 - x²/l²)` | both ways |
//! | [`Ellipse`] | ellipse, circle | limits to load |
//! | [`Hyperbola`] | wedge with a rounded tip | limits to load |
//! | [`Exponential`] | `eˣ - 1 - x` | limits to load |
//! | [`Cosine`] | `1 - cos x`, one crest alone | limits to load |
//! | [`Quartic`] | `D ((x/r)² - 1)²`: two contacts, which merge | load to limits |
//! | [`PolynomialMap`] | N contacts in a row, made of any form above but JKR | as that form |
//! | [`Westergaard`] | `1 - cos x`, all crests at once, without end | both ways |
//! | [`PinInHole`] | circle in a hole of nearly its radius, no half-planes | load to limits |
//!
//! Each is a struct made from the body's parameters and the half-width of the contact (`new`) or
//! the load on it (`under_load`). All but the last two implement [`ClosedForm`]. Published results
//! name their source; the rest follows from the two representations below, both of which are
//! classical (Johnson, *Contact Mechanics*, 1985, chapters 2, 4 and 5; Hills, Nowell and Sackfield,
//! *Mechanics of Elastic Contacts*, 1993; Barber, *Contact Mechanics*, 2018).
//!
//! # Where they come from
//! With `g` the slope of the gap, `w = sqrt((a - x)(x + b))`, and the angles of `x = c + L cos θ`
//! and `t = c + L cos φ`, a contact between two free edges has
//!
//! ```text
//! P(x) = κ/π² w(x) PV∫ g(t)/((t - x) w(t)) dt,       0 = ∫ g dφ,       F = κ L/π ∫ g cos φ dφ
//! P(x) = κ/π² ∫ Λ(x, t) dg(t),       Λ = ln( sin((θ + φ)/2) / abs(sin((θ - φ)/2)) )
//! ```
//!
//! with all integrals over the contact. The second is the first after integration by parts; a jump
//! of `g` counts in it as it is. A slope made of straight lines is a sum of `Λ` and of its integral
//! `∫_t^a Λ dt' = (x - t) Λ + φ w`. If the body is symmetric, a contact that grows adds the
//! pressures of flat punches, `dF/(π sqrt(l² - x²))` each, so that (Barber)
//!
//! ```text
//! P(x) = 1/π ∫ F'(l)/sqrt(l² - x²) dl,   abs(x) < l < L
//! F(l) = 2 κ l/π ∫ g(l sin φ) sin φ dφ
//! ```
//!
//! with φ from 0 to π/2.
//!
//! # Accuracy
//! Some units in the last place, also of a pressure next to an edge for the given `x` and limits:
//! the distance to the edge is their difference, and the formulas are arranged so that nothing else
//! cancels there. The accuracy is lower where a pressure passes through zero ([`Jkr`]) or is about
//! to at the edges ([`Cosine`] near its largest load, [`Biquadratic`] with B < 0).
//!
//! ```
//! use linecontact::reference::{ClosedForm, UnequalRadii, body};
//! use linecontact::{Contact, Control, Flat};
//!
//! let (kappa, load): (f64, f64) = (1.7, 0.05);
//! let form = UnequalRadii::under_load(1.0, 0.2, load, kappa)?;
//! let body = body(&form, -1.0, 1.0)?;
//! let contact = Contact::new(&Flat, &body)?.kappa(kappa);
//! let solution = contact.solve(Control::Load(load))?;
//! assert!((solution.a() / form.limits().right - 1.0).abs() < 1e-14);
//! let pressure = solution.pressure()?.at(0.01)?;
//! assert!((pressure / form.pressure(0.01, kappa) - 1.0).abs() < 1e-14);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod angles;
mod biquadratic;
mod conics;
mod cosine;
mod crowning;
mod exponential;
mod flat_punch;
mod graph;
mod hertz;
mod jkr;
mod pin_in_hole;
mod polynomial_map;
mod power_law;
mod quartic;
mod rounded_punch;
mod unequal_radii;
mod wedge;
mod westergaard;

pub use biquadratic::Biquadratic;
pub use conics::{Ellipse, Hyperbola};
pub use cosine::Cosine;
pub use crowning::Crowning;
pub use exponential::Exponential;
pub use flat_punch::FlatPunch;
pub use graph::{Graph, body};
pub use hertz::Hertz;
pub use jkr::Jkr;
pub use pin_in_hole::PinInHole;
pub use polynomial_map::PolynomialMap;
pub use power_law::PowerLaw;
pub use quartic::Quartic;
pub use rounded_punch::RoundedPunch;
pub use unequal_radii::UnequalRadii;
pub use wedge::Wedge;
pub use westergaard::Westergaard;

pub use crate::error::ReferenceError;

use crate::{Edge, Interval, Real};
use std::fmt::Debug;

/// Contact of a body on a flat, in one interval or several, that is known in closed form.
///
/// `x` and heights are lengths in one unit. `kappa` is κ = π E\*/2, a pressure; a contact made for
/// a load needs the κ given with the load.
pub trait ClosedForm<T: Real>: Debug + Send + Sync {
    /// Returns the contact `[-b, a]`; of several, from the first limit to the last.
    fn limits(&self) -> Interval<T>;

    /// Returns the contacts, from left to right. Default: one.
    fn contacts(&self) -> Vec<Interval<T>> {
        vec![self.limits()]
    }

    /// Returns the load per unit length F, of all contacts.
    fn load(&self, kappa: T) -> T;

    /// Returns the pressure `P(x)`: zero outside the contact and between contacts, infinite at a
    /// sharp edge.
    fn pressure(&self, x: T, kappa: T) -> T;

    /// Returns the height of the body above the flat before it is loaded, up to a constant.
    fn height(&self, x: T) -> T;

    /// Returns the slope g of the body; on its right side where it jumps.
    fn slope(&self, x: T) -> T;

    /// Returns the slope on the left side.
    fn slope_left(&self, x: T) -> T {
        self.slope(x)
    }

    /// Lists the places where the slope is not smooth, from left to right.
    fn breakpoints(&self) -> Vec<T> {
        Vec::new()
    }

    /// Returns the conditions at `-b` and at `a`, as [`Contact::edges`](crate::Contact::edges)
    /// takes them.
    fn edges(&self) -> [Edge<T>; 2] {
        [Edge::Free; 2]
    }
}

/// Refuses a parameter that is not finite, or for which `holds` is false.
fn check<T: Real>(
    name: &'static str,
    value: T,
    holds: bool,
    must: &'static str,
) -> Result<(), ReferenceError<T>> {
    if holds && value.is_finite() {
        Ok(())
    } else {
        Err(ReferenceError::Parameter { name, value, must })
    }
}

/// Refuses the first parameter that is not positive and finite.
fn positive<T: Real, const N: usize>(
    parameters: [(&'static str, T); N],
) -> Result<(), ReferenceError<T>> {
    let mut parameters = parameters.into_iter();
    parameters
        .try_for_each(|(name, value)| check(name, value, value > T::zero(), "positive and finite"))
}

/// Returns the contact `[-L, L]`.
fn centred<T: Real>(half_width: T) -> Interval<T> {
    Interval { left: -half_width, right: half_width }
}

/// Tells whether x lies outside the limits; false for NaN, which goes through the formulas.
fn outside<T: Real>(limits: Interval<T>, x: T) -> bool {
    x < limits.left || x > limits.right
}

/// Returns `sqrt((a - x)(x + b))`, to which a pressure is proportional near free edges; `None`
/// outside.
fn root_inside<T: Real>(limits: Interval<T>, x: T) -> Option<T> {
    (!outside(limits, x)).then(|| limits.chebyshev_weight(x))
}
