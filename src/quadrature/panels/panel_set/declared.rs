//! Check of a declared or proved convexity: the slope of the gap rises from node to node.

use super::PanelSet;
use crate::gap::Gap;
use crate::quadrature::panels::Panel;
use crate::{Fallible, InputError, Real};

/// Allowed fall of the slope on a panel, in units of its uncertainty or of the tolerance. A fall up
/// to the square root of the rounding unit, as a share of the largest slope, is always allowed:
/// formulas lose digits, and no pressure of note depends on less. A fall by this many rounding
/// units of a slope of 1 is allowed, too, as for `sin/cos`.
const MAX_FALL: f64 = 32.0;

impl<T: Real> PanelSet<T> {
    /// Checks the slopes if the bodies declare a [`Convexity`](crate::Convexity) that makes the gap
    /// convex.
    ///
    /// # Errors
    /// [`InputError::NotConvex`].
    pub(super) fn check_declared(&self, gap: &Gap<'_, T>) -> Fallible<T, ()> {
        let fall = if gap.is_convex() && !self.coarse { self.falls().next() } else { None };
        fall.map_or(Ok(()), |(between, slopes)| {
            Err(InputError::NotConvex { between, slopes }.into())
        })
    }

    /// Lists places between which the slope falls, from a node to the next or where two panels
    /// meet, and the slopes there: one pair for each panel.
    pub fn falls(&self) -> impl Iterator<Item = ([T; 2], [T; 2])> {
        let share = T::epsilon().sqrt().max(T::of(MAX_FALL) * self.tolerance);
        let least = share * self.size + T::of(MAX_FALL) * T::epsilon();
        let is_only = self.panels.len() == 1;
        let mut before: Option<([T; 2], T)> = None;
        self.panels.iter().filter_map(move |panel| {
            let allowed = T::of(MAX_FALL) * panel.error.max(panel.noise) + least;
            let [left, right] = if is_only { [T::zero(); 2] } else { panel.at_ends() };
            let at_seam = before.filter(|([_, slope], open)| left + *open + allowed < *slope);
            // A panel that is not resolved, as on a kink, leaves known what is before it.
            let is_higher = |&([_, slope], open): &([T; 2], T)| slope - open > right - allowed;
            before = before.filter(is_higher).or(Some(([panel.x[1], right], allowed)));
            match at_seam {
                Some(([x, slope], _)) => Some(([x, panel.x[0]], [slope, left])),
                None if panel.fall > allowed => fall(panel, allowed),
                None => None,
            }
        })
    }
}

/// Returns the first neighbouring nodes between which the series of a panel, free of noise, falls
/// by more than allowed, and the slopes there.
fn fall<T: Real>(panel: &Panel<T>, allowed: T) -> Option<([T; 2], [T; 2])> {
    let nodes: Vec<T> = panel.nodes().collect();
    let mut pairs = nodes.windows(2).map(|x| ([x[0], x[1]], [0, 1].map(|i| panel.value(x[i]))));
    pairs.find(|(_, slopes)| slopes[0] - slopes[1] > allowed)
}
