//! Remedies in the texts of errors.

use crate::rounded::{Rounded, apart, endless, is_far, six, span};
use crate::{Body, Real};

/// Tells whether a number is so small that it has fewer digits than others.
pub(crate) fn is_subnormal<T: Real>(value: T) -> bool {
    value.is_finite() && !value.is_zero() && !(T::one() / value).is_finite()
}

pub(super) fn lost_digits<T: Real>(value: T) -> &'static str {
    if is_subnormal(value) {
        "; of so small a number digits are lost: choose units in which it is nearer to 1"
    } else {
        ""
    }
}

/// Rounds an abscissa for a message; the ends of a flat without ends become infinite.
pub(super) fn place<T: Real>(x: T) -> Rounded {
    six(endless(x))
}

/// Tells which part of a load the bodies carry up to one of their ends, and the first remedies.
pub(super) fn borne<T: Real>(end: T, [carried, load]: [T; 2], half_width: T, peak: T) -> String {
    let (x, asked) = (six(end), apart(load, &[carried]));
    if carried.abs() <= T::epsilon() * load.abs() {
        return format!(
            "the bodies touch first at their end x = {x}, and carry nothing of the load {asked}: extend the domain, as a \
             half drawing by its mirror image"
        );
    }
    let leave = format!("the contact would leave the bodies at x = {x}");
    if carried.partial_cmp(&carried).is_none() {
        return format!("{leave} under the load {asked}: extend the domain, lower the load");
    }
    let lower = if carried < T::zero() { "adhesion, which pulls there" } else { "the load" };
    let (carried, half_width, peak) = (apart(carried, &[load]), six(half_width), six(peak));
    format!(
        "{leave}: up to there they carry {carried} of the load {asked}, with half-width {half_width} and peak pressure \
         {peak}; extend the domain, lower {lower}"
    )
}

/// Describes the widest contact of bodies in the given words, or says that there is none.
pub(super) fn widest<T: Real>(half_width: T, end: T, words: impl FnOnce() -> String) -> String {
    match half_width.is_zero() {
        true => {
            format!("the bodies touch first at their end x = {}, where none has room", six(end))
        }
        false => words(),
    }
}

/// Names the peak pressure of a contact, if it is known.
pub(super) fn at_peak<T: Real>(peak: T) -> String {
    let is_known = peak.partial_cmp(&peak).is_some();
    if is_known { format!(" with peak pressure {}", six(peak)) } else { String::new() }
}

/// Returns the remedy for an approach that a table does not cover.
pub(super) fn how_to_cover<T: Real>(approach: T, remedy: &'static str) -> &'static str {
    if approach.is_finite() { remedy } else { "it must be finite" }
}

/// Names the body that a message is about, if it is one of a contact.
pub(super) fn of_body(body: Option<Body>) -> String {
    body.map_or_else(String::new, |body| format!("{body} body: "))
}

/// Names the span between two places, or their common place.
pub(super) fn along<T: Real>([from, to]: [T; 2]) -> String {
    if from < to { format!("from x = {}", span(from, to)) } else { format!("at x = {}", six(from)) }
}

/// Remedy where the contact found is not the whole contact, whatever is given.
pub(super) const SEVERAL: &str = "the search has gone on from there in vain: step the load to it with a Solver, change it a \
    little, declare kinks as breakpoints, smooth measured points (Fit::smooth); with adhesion, single_interval, or an own \
    search or quadrature only one contact is sought";

/// Returns the remedy where no contact of a half-width is in balance.
pub(super) fn how_to_balance<T: Real>(near: T, half_width: T) -> String {
    match is_far(near, half_width) {
        true => "x is too far from 0 to have digits for it: move the origin to the contact".into(),
        false => format!("{SEVERAL}, or give a start"),
    }
}

/// Returns the remedy for a negative pressure.
pub(super) fn how_to_press<T: Real>(pressure: T) -> &'static str {
    if pressure.is_finite() {
        SEVERAL
    } else {
        "step the load to it with a Solver, change it until the contact ends beside that hollow corner, or round the corner off"
    }
}

/// Returns the remedy for a peak pressure that is not found, given the one tried last.
pub(super) fn how_to_peak<T: Real>(found: T) -> &'static str {
    if found.is_finite() {
        "give the load or the half-width, or a start nearer to the contact"
    } else if found > T::zero() {
        "where the slope of a body jumps the pressure is infinite: round the kink, or give the load or the half-width"
    } else {
        "no contact was found under any load tried: give a start nearer to the contact, or the load"
    }
}

/// Returns a hint at a missing stiffness, for a contact that is too wide.
pub(super) fn hint(kappa_is_default: bool) -> &'static str {
    if kappa_is_default { " (κ is 1, the default: is contact_modulus missing?)" } else { "" }
}

/// Returns the remedy for slopes, on the left and on the right, that do not belong to a closing
/// gap.
pub(super) fn how_to_touch<T: Real>([left, right]: [T; 2]) -> &'static str {
    if left.is_zero() && right.is_zero() {
        "these bodies are parallel, so that they touch all along: two flats need Edge::Fixed or FreeUntil at their \
         corners; flip one of two like curves (Placement::flipped), or change its radius"
    } else if left < T::zero() && right > T::zero() {
        "the heights are all alike, as below the smallest normal number: choose units in which they are nearer to 1"
    } else if left >= T::zero() && right <= T::zero() {
        "these bodies bulge away from each other: flip one (Placement::flipped), swap them, or give a hollow a larger radius"
    } else {
        "this gap leads down to an end of the bodies: widen their domains, or tilt one of them"
    }
}
