//! Check that a solution of the equations is a contact, as closely as it is asked for.

mod inside;
mod series_bounds;

pub(super) use inside::Pressures;
pub(crate) use inside::{Inside, Tensions, parting};
pub(super) use series_bounds::{bounds, extremes, least, truncation_error};

use super::Extremum;
use crate::gap::{Gap, Sampler};
use crate::{Interval, Real};

/// Width of a gap in a contact that counts as closed, in units of rounding.
pub(crate) const CLOSED_WIDTH: f64 = 64.0;

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

/// Returns the width below which a gap in contacts from one limit to another, as at a hollow
/// corner, counts as closed: by the rounding of x, or by that of both bodies' heights over the fall
/// of the slope. (Less than a share √ε of the contacts, which changes the rest by a share ε.)
pub(crate) fn least_width<T: Real>(gap: &Gap<'_, T>, on: Interval<T>, x: T) -> T {
    let ([jump, _], mut sampler) = (gap.jump(x), Sampler::default());
    let is_told = jump < T::zero() && sampler.height_as_described(gap, x).is_ok();
    let by_height = if is_told { sampler.highest / -jump } else { T::zero() };
    let rounding = T::epsilon() * (on.left.abs().max(on.right.abs()) + by_height);
    (T::of(CLOSED_WIDTH) * rounding).min(T::epsilon().sqrt() * on.half_width())
}
