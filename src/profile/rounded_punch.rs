//! A flat punch with rounded edges.

use super::{Parabola, Piecewise, PiecewiseError, Placed, Placement, finite};
use crate::Real;

/// Half a parabola, a flat and the other half of the parabola.
type Parts<T> = Piecewise<T, Placed<T, Parabola<T>>>;

/// Builds a punch that is flat from `-flat` to `flat` and goes on as the parabola
/// `(abs(X) - flat)²/(2R)`, up to `abs(X) = reach`: the body of
/// [`reference::RoundedPunch`](crate::reference::RoundedPunch).
///
/// Edges that are circular arcs can be joined in the same way from
/// [`Ellipse::circle`](super::Ellipse) and a [`Line`](super::Line).
///
/// # Errors
/// [`PiecewiseError::InPiece`] with [`ProfileError::Parameter`](super::ProfileError) unless R and
/// 1/R are finite and `0 < flat < reach`.
///
/// ```
/// use linecontact::profile::rounded_punch;
/// use linecontact::reference::{ClosedForm, RoundedPunch};
/// use linecontact::{Contact, Control, Flat};
///
/// let (flat, radius, load) = (1.0f64, 0.5, 0.3);
/// let body = rounded_punch(flat, radius, 3.0)?;
/// let contact = Contact::new(&Flat, &body)?;
/// let solution = contact.solve(Control::Load(load))?;
/// let form = RoundedPunch::under_load(flat, radius, load, 1.0)?;
/// assert!((solution.a() / form.limits().right - 1.0).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn rounded_punch<T: Real>(flat: T, radius: T, reach: T) -> Result<Parts<T>, PiecewiseError<T>> {
    let (zero, edge) = (T::zero(), reach - flat);
    let part = |piece, curve: Result<Parabola<T>, _>, shift| {
        let placement = Placement::default().shifted(shift, zero);
        let placed = curve.and_then(|curve| Placed::new(curve, placement));
        placed.map_err(PiecewiseError::in_piece(piece))
    };
    let rounds =
        finite("the reach", reach, reach > flat, "finite and more than the half-width of the flat");
    let is_flat = finite("the half-width of the flat", flat, flat > zero, "positive and finite");
    Piecewise::new(vec![
        part(0, rounds.and_then(|()| Parabola::new(radius, [-edge, zero])), -flat)?,
        part(1, is_flat.and_then(|()| Parabola::straight([-flat, flat])), zero)?,
        part(2, Parabola::new(radius, [zero, edge]), flat)?,
    ])
}
