//! A body as finely as a certificate looks at it.

use super::known::is_straight;
use super::{Body, Panel};
use crate::gap::Surface;
use crate::gap::survey::is_in;
use crate::gap::survey::panel::{NODES, Row, Series};
use crate::numerics::chebyshev::Table;
use crate::{ProfileError, Real};

/// The least distance between two cuts, in units in the last place of the length of a panel.
const APART: f64 = 64.0;

/// A rise between two points, which is known twice.
pub(crate) struct Rise<T> {
    pub between: [T; 2],
    pub by_heights: T,
    pub by_slopes: T,
    /// The larger |Y|.
    pub highest: T,
}

impl<T: Real> Rise<T> {
    /// Compares two points with the way `[x, y]` between them by the slopes.
    fn new([left, right]: [Row<T>; 2], [dx, dy]: [T; 2]) -> Self {
        let (width, by_heights) = (right.x - left.x, right.y - left.y);
        let slope = if right.slope.is_finite() { right.slope } else { by_heights / width };
        Self {
            between: [left.x, right.x],
            by_heights,
            // The error of X counts along the body.
            by_slopes: dy + slope * (width - dx),
            highest: left.y.abs().max(right.y.abs()),
        }
    }

    /// Returns the rise of the gap by a body, given its sign in that.
    pub fn times(self, sign: T) -> Self {
        let [by_heights, by_slopes] = [self.by_heights, self.by_slopes].map(|rise| sign * rise);
        Self { by_heights, by_slopes, ..self }
    }
}

impl<T: Real> Body<T> {
    /// Cuts panels at some places, by rising x, and looks into all that some spans have a part of.
    pub fn cut(
        &mut self,
        surface: &Surface<'_, T>,
        range: [T; 2],
        [places, spans]: [&[[T; 2]]; 2],
        heights: &mut usize,
    ) -> Result<bool, ProfileError<T>> {
        // What was exact need not be so any more where its parts are looked at.
        self.panels.iter_mut().for_each(|panel| panel.vain = 0);
        let ask = |panel: &Panel<T>, series: Option<&Series<T>>, cuts: &mut Vec<T>| {
            let [from, to] = panel.x();
            if is_straight(surface, panel) || !(to - from).is_finite() {
                return false;
            }
            let usable = series.filter(|series| series.doubt.is_finite());
            let first = places.partition_point(|&[x, room]| x - room <= from);
            let inside = places[first..].iter().take_while(|&&[x, room]| x + room < to);
            for &[x, _] in inside {
                let even = ((x - from) - (to - x)) / (to - from);
                let t = usable.map_or(even, |series| series.parameter(x, [from, to]));
                let least =
                    cuts.last().map_or(-T::one(), |&last| last) + T::of(APART) * T::epsilon();
                cuts.extend((t > least && t < T::one() - T::of(APART) * T::epsilon()).then_some(t));
            }
            !cuts.is_empty() || !panel.is_sampled && is_in(spans, panel)
        };
        self.split(surface, range, ask, heights)
    }

    /// Returns the rises over the points of each panel that has a part of some spans, and from its last point to the
    /// next panel: by heights and by slopes. A step of the heights shows in one of them.
    pub fn rises(&self, spans: &[[T; 2]]) -> impl Iterator<Item = Rise<T>> {
        let in_spans = move |panel: &Panel<T>| is_in(spans, panel);
        let all = self.panels.iter().enumerate().filter(move |(_, panel)| in_spans(panel));
        let both = all.filter_map(|(i, panel)| {
            let (one, last) = (T::one(), T::of(Table::of(NODES).z[NODES - 1]));
            let along = |series: &Series<T>, ends: [T; 2]| {
                let [start, end] = ends.map(|t| series.at_end(t));
                [end[0] - start[0], end[1] - start[1]]
            };
            let series = &self.series[panel.series?];
            let [first, end] = [series.rows[0], series.rows[NODES - 1]];
            let inside = Rise::new([first, end], along(series, [-last, last]));
            let [dx, dy] = along(series, [last, one]);
            let beyond = match self.panels.get(i + 1).and_then(|next| next.series) {
                Some(next) => {
                    let next = &self.series[next];
                    let more = along(next, [-one, -last]);
                    Some(Rise::new([end, next.rows[0]], [dx + more[0], dy + more[1]]))
                }
                // The end of a piece is known.
                None => (!panel.is_inside[1]).then(|| Rise::new([end, panel.ends[1]], [dx, dy])),
            };
            Some([Some(inside), beyond])
        });
        both.flatten().flatten()
    }
}
