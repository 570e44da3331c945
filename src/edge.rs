//! One edge of a contact.

use crate::Real;

/// Condition at one edge of the contact.
///
/// ```
/// use linecontact::{Contact, Control, Edge, Flat};
///
/// // A flat punch from -1 to 1.
/// let contact = Contact::new(&Flat, &Flat)?.edges(Edge::Fixed(-1.0f64), Edge::Fixed(1.0));
/// let solution = contact.solve(Control::Load(0.3))?;
/// // F/(π sqrt(1 - x²))
/// let exact = 0.3 / (0.8 * std::f64::consts::PI);
/// assert!((solution.pressure()?.at(0.6)? / exact - 1.0).abs() < 1e-14);
/// # Ok::<(), linecontact::ContactError<f64>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(deny_unknown_fields, rename_all = "snake_case"))]
pub enum Edge<T> {
    /// Smooth body: the limit is where the pressure ends at zero.
    Free,
    /// Sharp corner at this `x`, where the body ends and the limit stays: nothing beyond it is
    /// checked. The pressure may be infinite there. If it
    /// would be negative, or the contact ends before the corner, the body lifts off
    /// ([`SolveError::LiftsOff`](crate::SolveError::LiftsOff)). Between two such corners the
    /// load must be positive, and the contacts may be several, unless [a single
    /// interval](crate::Contact::single_interval) is asked for: the paper's fixed limits.
    Fixed(T),
    /// Smooth body with a sharp corner at this `x`: free as long as the contact does not reach the
    /// corner, fixed from then on.
    FreeUntil(T),
    /// Adhesion over so short a range that it acts at the edge alone (Johnson, Kendall and
    /// Roberts), with this work of adhesion w: energy per unit area, not negative.
    Adhesive(T),
}

impl<T: Real> Edge<T> {
    /// Returns the limit, if it is known.
    pub(crate) fn limit(&self) -> Option<T> {
        match *self {
            Self::Fixed(x) => Some(x),
            _ => None,
        }
    }

    /// Moves a place that is an end of the bodies but for rounding to that end.
    pub(crate) fn moved_to(self, end: T) -> Self {
        let (Self::Fixed(x) | Self::FreeUntil(x)) = self else { return self };
        let (off, rounding) = ((x - end).component(0), T::of(8.0) * T::epsilon() * x.abs());
        match self {
            _ if !(off.abs() <= rounding && x.is_finite()) => self,
            Self::Fixed(_) => Self::Fixed(x - off),
            _ => Self::FreeUntil(x - off),
        }
    }

    /// Turns a fixed corner into one that the contact need not reach.
    pub(crate) fn let_go(self) -> Self {
        if let Self::Fixed(x) = self { Self::FreeUntil(x) } else { self }
    }

    pub(crate) fn is_free(&self) -> bool {
        matches!(self, Self::Free | Self::FreeUntil(_))
    }
}
