//! Several panels as one sum over the contact: the series of each, continued over all of it.
//!
//! A polynomial over the contact `c + L z` is `Σ c_k T_k(z) = Σ c_k cos kθ`, and a panel is a span
//! of θ, so that all integrals over it follow from those of `cos kθ`. A series may be continued as
//! long as its coefficients do not grow too much on the way, which would cost digits.

use super::half_angle::{HalfAngle, Sines};
use super::panel::Panel;
use crate::numerics::chebyshev::{Coeffs, MAX_SIZE, size_for};
use crate::{Interval, Real};

/// Largest sum of the coefficients over the contact, in units of the largest slope; a larger sum
/// would cost digits.
const MAX_SUM: f64 = 16.0;

/// Part of a contact on one panel.
pub(super) struct PanelAngles<'a, T> {
    pub panel: &'a Panel<T>,
    /// True for the panel at the left edge of the contact; the others start at a breakpoint.
    pub is_first: bool,
    /// Start of the part.
    pub start: HalfAngle<T>,
    /// Series over the whole contact, and the number of its significant coefficients.
    pub series: Coeffs<T>,
    pub terms: usize,
    /// Sum of the absolute values of the coefficients.
    pub bulk: T,
    /// Integrals of `cos kθ` over the part: two more than there are coefficients.
    pub integrals: Sines<T>,
    /// Slopes at the two ends.
    pub ends: [T; 2],
}

/// Shows the parts of a contact one by one, from left to right; `false` if one of several has a
/// series that cannot be continued so far.
#[inline(always)]
pub(super) fn reexpanded<T: Real>(
    panels: &[Panel<T>],
    on: Interval<T>,
    mut show: impl FnMut(&PanelAngles<'_, T>),
) -> bool {
    let zero = T::zero();
    let most = panels.iter().map(|panel| panel.length).max().unwrap_or(MAX_SIZE);
    let count = size_for(most) + 2;
    let last = panels.len().saturating_sub(1);
    let ends_of = |i: usize| {
        let panel = &panels[i];
        let [from, to] = panel.at_ends();
        [
            if i == 0 { panel.value(on.left) } else { from },
            if i == last { panel.value(on.right) } else { to },
        ]
    };
    let slopes = (0..panels.len()).flat_map(ends_of);
    let most_bulk = T::of(MAX_SUM) * slopes.fold(zero, |max, slope| max.max(slope.abs()));
    let mut start = HalfAngle::of(on, on.left);
    let mut left = [zero; MAX_SIZE + 2];
    left[0] = T::pi();
    for (i, panel) in panels.iter().enumerate() {
        let (series, terms) = panel.over(on);
        let bulk = series[..terms].iter().fold(zero, |sum, a| sum + a.abs());
        if bulk > most_bulk {
            return false;
        }
        let ends = ends_of(i);
        let (mut end, mut right) = (start, [zero; MAX_SIZE + 2]);
        if i < last {
            end = HalfAngle::of(on, panel.x[1]);
            right = end.sines(count);
        }
        let integrals: Sines<T> = std::array::from_fn(|k| left[k] - right[k]);
        show(&PanelAngles { panel, is_first: i == 0, start, series, terms, bulk, integrals, ends });
        (start, left) = (end, right);
    }
    true
}
