//! Steps of the heights, where bodies seem to overlap.

use crate::gap::{Gap, Sampler};
use crate::quadrature::panels::{PanelSet, Rises, rise};
use crate::{ContactError, Interval, Real};

/// Halvings of the way in search of a step, down to about ε^(1/2) of it.
const MAX_STEP_HALVES: usize = 26;

/// Searches the way from the contacts to an overlap for a step of the heights that the slopes do
/// not show.
///
/// Returns [`InputError::InconsistentHeights`] with two places around the step, or `None` if
/// slopes and heights agree.
pub(in crate::solve) fn step_of_heights<T: Real>(
    gap: &Gap<'_, T>,
    contacts: Interval<T>,
    overlap: T,
) -> Option<ContactError<T>> {
    let gap = &gap.as_described();
    let left = gap.nearest(contacts.left.min(overlap));
    let right = gap.nearest(contacts.right.max(overlap));
    let (mut panels, mut sampler) = (PanelSet::new(T::epsilon().sqrt()), Sampler::default());
    panels.extend(gap, Interval { left, right }).ok()?;
    let error = panels.panels.iter().fold(T::zero(), |error, panel| error.max(panel.error));
    let rises = |[from, to]: [[T; 2]; 2], highest: T| Rises {
        between: [from[0], to[0]],
        by_heights: to[1] - from[1],
        by_slopes: rise(&panels.panels, from[0], to[0]),
        highest,
        open: T::of(8.0) * error * (to[0] - from[0]),
    };
    let mut place = |x: T| Some([x, sampler.height(gap, x).ok()?]);
    let mut ends = [place(left)?, place(right)?];
    let misses = |rises: Rises<T>| (rises.by_heights - rises.by_slopes).abs();
    for _ in 0..MAX_STEP_HALVES {
        let [from, to] = ends;
        let middle = place(T::of(0.5) * (from[0] + to[0]))?;
        let halves = [[from, middle], [middle, to]];
        let [first, second] = halves.map(|half| misses(rises(half, T::zero())));
        ends = halves[usize::from(second > first)];
    }
    let highest = sampler.highest;
    rises(ends, highest).compare_beside_noise(gap, &mut sampler).err()
}
