//! The prescribed quantity.

use super::References;

/// Prescribed quantity of the contact: the load, or another number from which the load follows
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
#[cfg_attr(feature = "serde", serde(deny_unknown_fields, rename_all = "snake_case"))]
#[non_exhaustive]
pub enum Control<T> {
    /// Load per unit length F = ∫ P dx: force/length. (The paper gives C = π F.) Under a load of
    /// zero, bodies whose edges are free just touch
    /// ([`Solution::is_apart`](crate::Solution::is_apart)).
    Load(T),
    /// Half-width L = (a + b)/2, a length; of several contacts, from the first limit to the last.
    /// With a [period](crate::Contact::period) the first limit is the first after the cut, whose
    /// place changes with the load: several loads may give this half-width, and one is found.
    HalfWidth(T),
    /// Largest pressure p₀ = max P(x) of all contacts, between edges where the pressure is bounded:
    /// a pressure.
    PeakPressure(T),
    /// Distance by which the bodies come together after first touch: the
    /// [approach](crate::Solution::approach) `Approach::bodies`, to given references. The bodies'
    /// [materials](crate::Contact::materials) must be known, and the approach must grow with the
    /// load.
    Approach {
        /// δ: a length. At zero and below, bodies whose edges are free are apart by -δ
        /// ([`Solution::is_apart`](crate::Solution::is_apart)).
        approach: T,
        /// Points of the bodies between which δ is measured.
        references: References<T>,
    },
    /// Load, and moment of the pressure about a given place. The bodies tilt by
    /// [`Solution::tilt`](crate::Solution::tilt) until the moment has this value.
    ///
    /// Body 2 turns freely, as if hinged. Only the gap is turned, so that it does not matter which
    /// body turns, or about which point. The load must be positive, and must act at a place of the
    /// bodies, `x₀ + M/F`; without load and moment they are apart, and do not turn.
    ///
    /// M adds one equation to the search, and the tilt one unknown (Johnson, *Contact Mechanics*,
    /// 1985, §2.7, has the flat punch under an eccentric load).
    Moment {
        /// Load per unit length F = ∫ P dx: force/length.
        load: T,
        /// M = ∫ P (x - x₀) dx, a force; positive if the load acts to the right of x₀.
        moment: T,
        /// x₀, a length.
        about: T,
    },
    /// Load, and the place where it acts, `x̄ = ∫ x P dx/F`: a [`Moment`](Self::Moment) F x̄ about
    /// x = 0.
    CentreOfPressure {
        /// Load per unit length F: force/length.
        load: T,
        /// x̄, a length.
        at: T,
    },
}
