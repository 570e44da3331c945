//! Check that a solution of the equations is a contact, as closely as it is asked for.

mod inside;
mod series_bounds;

pub(super) use inside::Pressures;
pub(crate) use inside::{Inside, Tensions};
pub(super) use series_bounds::{bounds, extremes, least, truncation_error};

use super::Extremum;
use crate::Real;

/// Closeness of a check: where it stops to look closer.
#[derive(Clone, Copy)]
pub(crate) struct Closeness {
    /// Largest truncation error of a ratio of pressures, as a share of it, beside what counts as
    /// zero: 1 if only the sign is asked for.
    pub share: f64,
    /// Largest number of halvings of a span.
    pub levels: usize,
}

impl Closeness {
    /// Signs, in spans down to a 256th of a panel, in which 16 nodes are several times as close as
    /// any two of the at most 32 of the panel.
    pub const OF_A_SOLVE: Self = Self { share: 1.0, levels: 8 };

    /// Values, down to rounding: 2⁻⁵² of a span.
    pub const OF_A_PROOF: Self = Self { share: 0.0, levels: 52 };
}

/// Returns the lower of two extrema.
pub(super) fn nearer<T: Real>(
    one: Option<Extremum<T>>,
    other: Option<Extremum<T>>,
) -> Option<Extremum<T>> {
    one.into_iter()
        .chain(other)
        .reduce(|one, other| if one.value < other.value { one } else { other })
}
