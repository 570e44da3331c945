//! The quantity that is prescribed.

use crate::References;

/// What is prescribed of the contact: the load, or another number for which the load comes out
/// ([`Solution::load`](crate::Solution::load)).
///
/// ```
/// use linecontact::profile::Parabola;
/// use linecontact::{Contact, Control, Flat};
///
/// let body = Parabola::new(1.0f64, [-1.0, 1.0])?;
/// let contact = Contact::new(&Flat, &body)?;
/// let by_width = contact.solve(Control::HalfWidth(0.2))?;
/// assert!((by_width.load() / 0.02 - 1.0).abs() < 1e-14); // κ L²/(2 R)
/// let by_peak = contact.solve(Control::PeakPressure(0.05))?;
/// assert!((by_peak.a() / (0.05 * std::f64::consts::PI) - 1.0).abs() < 1e-12); // π R p₀/κ
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields))]
#[non_exhaustive]
pub enum Control<T> {
    /// The load per unit length F = ∫ P dx: force/length. (The paper gives C = π F.)
    Load(T),
    /// The half-width L = (a + b)/2, of several contacts from the first to the last: a length.
    HalfWidth(T),
    /// The largest pressure p₀ = max P(x) of all contacts, between edges where the pressure is bounded: a pressure.
    PeakPressure(T),
    /// How far the bodies come together, from where they just touch: the [approach](crate::Solution::approach)
    /// `Approach::bodies`, to given references. The bodies' [materials](crate::Contact::materials) must be known, and the
    /// approach must grow with the load.
    Approach {
        /// δ: a length, positive.
        approach: T,
        /// What it is measured between.
        references: References<T>,
    },
    /// A load, and the moment of the pressures about a given place. The bodies turn until it is that: by
    /// [`Solution::tilt`](crate::Solution::tilt).
    ///
    /// Body 2 may turn freely, as one that is held by a hinge; what is turned is the gap, so that it does
    /// not matter which body turns, nor about which point. The load must be positive, and the moment such
    /// that the load acts at a place of the bodies, `x₀ + M/F`.
    ///
    /// M is one more equation of the same search, and the tilt one more unknown (Johnson, *Contact Mechanics*,
    /// 1985, §2.7, has the flat punch under an eccentric load).
    Moment {
        /// The load per unit length F = ∫ P dx: force/length.
        load: T,
        /// M = ∫ P (x - x₀) dx, a force; positive where the load acts at the right of x₀.
        moment: T,
        /// x₀, a length.
        about: T,
    },
    /// A load, and the place where it acts, `x̄ = ∫ x P dx/F`: as a [`Moment`](Self::Moment) F x̄ about x = 0.
    CentreOfPressure {
        /// The load per unit length F: force/length.
        load: T,
        /// x̄, a length.
        at: T,
    },
}
