//! No tension inside.
//!
//! Where the slope of the gap rises throughout, the pressure is positive (its integral over g' has a
//! kernel that is). Elsewhere what is bounded from below is the pressure times the square root of
//! the distance from an edge, or at a free edge divided by it: a function that is smooth between
//! the breakpoints and as positive at the edges as elsewhere. Between breakpoints it is a Chebyshev series on
//! cells, which are halved until the coefficients leave no doubt of the sign; so the cells are
//! graded towards the logarithms at the breakpoints.

use super::series_bounds::{below, least, truncation_error};
use super::{Extremum, undecided};
use crate::gap::{Cost, Gap};
use crate::numerics::chebyshev::Table;
use crate::{ContactError, Ends, Interval, Real};

/// Nodes of a cell.
const NODES: usize = 16;
/// How often a span between two breakpoints is halved.
const MOST_LEVELS: usize = 52;
/// Cells in all.
const MOST_CELLS: usize = 1 << 16;
/// Breakpoints at which the pressure is asked for, besides those where the slope jumps down.
const MOST_JOINTS: usize = 512;

/// Pressures at the nodes of a cell, and the series of what is smooth.
struct CheckedCell<T> {
    x: [T; NODES],
    pressure: [T; NODES],
    series: [T; NODES],
}

/// A contact whose pressures are known.
pub(super) struct Inside<'c, T: Real> {
    pub pressures: &'c dyn Fn(&[T], &mut [T]),
    pub gap: &'c Gap<'c, T>,
    pub on: Interval<T>,
    /// Whether its limits are free.
    pub free: Ends<bool>,
    pub load: T,
    /// From the first limit of all contacts to the last.
    pub hull: Interval<T>,
    /// Pressures down to the negative of this are zero.
    pub allowed: T,
}

impl<T: Real> Inside<'_, T> {
    fn tension(&self, Extremum { x, value: pressure }: Extremum<T>) -> ContactError<T> {
        let (interval, load) = (self.hull, self.load);
        ContactError::Tension { x, pressure, interval, load }
    }

    /// The least pressure found, negative only if it is less than what is allowed for; and where
    /// the ratio of the pressure to that under a smooth body is least.
    pub fn least(&self, cost: Cost) -> Result<Extremum<T>, ContactError<T>> {
        let on = self.on;
        let worst: std::cell::Cell<Option<Extremum<T>>> = std::cell::Cell::new(None);
        let mut meet = |x: T, value: T| {
            if value < -self.allowed && worst.get().is_none_or(|worst| value < worst.value) {
                worst.set(Some(Extremum { x, value }));
            }
        };
        for x in self.gap.telling_breakpoints(on, -T::one(), MOST_JOINTS) {
            let mut pressure = [T::zero()];
            (self.pressures)(&[x], &mut pressure);
            meet(x, pressure[0]);
        }
        // Each span between two breakpoints is a cell or more.
        let crowded = self.gap.breakpoints(on).count() >= MOST_CELLS;
        // The ratio that is smallest, and where.
        let mut ratio: Option<Extremum<T>> = None;
        let (mut waiting, mut cells, mut left) = (Vec::new(), 0, Some(on.left));
        while let Some(start) = left.filter(|_| !crowded) {
            let breakpoint =
                self.gap.breakpoint_after(start).filter(|&breakpoint| breakpoint < on.right);
            waiting.push(([start, breakpoint.unwrap_or(on.right)], 0));
            left = breakpoint;
            while let Some(([from, to], level)) = waiting.pop() {
                cells += 1;
                if cells > MOST_CELLS {
                    // One place with tension is enough.
                    let seen = worst.get();
                    return Err(
                        seen.map_or_else(|| undecided(from, cost), |place| self.tension(place))
                    );
                }
                let middle = T::of(0.5) * from + T::of(0.5) * to;
                let Some(cell) = self.cell([from, to]) else { continue };
                let CheckedCell { x, pressure, series } = cell;
                let left_out = truncation_error(&series);
                let size = series.iter().fold(T::zero(), |max, a| max.max(a.abs()));
                let bound = below(&series) - left_out;
                if bound > T::zero() && ratio.is_some_and(|ratio| ratio.value <= bound) {
                    continue;
                }
                let coarse = T::epsilon().sqrt() * size;
                let fine = T::of(0.25) * self.allowed;
                if left_out <= fine || (bound > T::zero() && left_out <= coarse) {
                    // The sign is that of the polynomial, but for what is allowed.
                    let enough =
                        if bound > T::zero() { coarse } else { T::of(1e-4) * self.allowed };
                    let [s, value] = least(&series, enough);
                    let x = (middle + s * T::of(0.5) * (to - from)).max(from).min(to);
                    if ratio.is_none_or(|ratio| value < ratio.value) {
                        ratio = Some(Extremum { x, value });
                    }
                    if value < -self.allowed {
                        self.deepest([from, to], &mut meet);
                    }
                    continue;
                }
                if level < MOST_LEVELS && middle > from && middle < to {
                    waiting.extend([([middle, to], level + 1), ([from, middle], level + 1)]);
                    continue;
                }
                x.iter().zip(&pressure).for_each(|(&x, &pressure)| meet(x, pressure));
            }
        }
        match (worst.get(), ratio) {
            (Some(place), _) => Err(self.tension(place)),
            (None, Some(ratio)) => Ok(ratio),
            (None, None) => Err(undecided(on.centre(), cost)),
        }
    }

    /// Looks at a cell; nothing if there is no room.
    fn cell(&self, [from, to]: [T; 2]) -> Option<CheckedCell<T>> {
        let half = T::of(0.5);
        let (middle, reach) = (half * from + half * to, half * (to - from));
        let table = Table::of(NODES);
        let x: [T; NODES] = std::array::from_fn(|i| middle + reach * T::of(table.z[i]));
        if x[0] <= from || x[NODES - 1] >= to {
            return None;
        }
        let mut pressure = [T::zero(); NODES];
        (self.pressures)(&x, &mut pressure);
        let smooth: [T; NODES] = std::array::from_fn(|i| pressure[i] * self.factor(x[i]));
        Some(CheckedCell { x, pressure, series: table.coefficients(&smooth) })
    }

    /// What makes the pressure smooth at the edges.
    fn factor(&self, x: T) -> T {
        let free = self.free;
        let by_half_width = T::one() / self.on.half_width();
        let part = |distance: T, free: bool| {
            let root = (distance * by_half_width).sqrt();
            if free { T::one() / root } else { root }
        };
        part(self.on.right - x, free.right) * part(x - self.on.left, free.left)
    }

    /// The least pressure itself on a cell that has some below zero, by shrinking a grid.
    fn deepest(&self, [mut from, mut to]: [T; 2], meet: &mut dyn FnMut(T, T)) {
        for _ in 0..12 {
            let Some(CheckedCell { x, pressure, .. }) = self.cell([from, to]) else { break };
            let lower = |best: usize, i: usize| if pressure[i] < pressure[best] { i } else { best };
            let best = (0..NODES).fold(0, lower);
            meet(x[best], pressure[best]);
            let (start, end) = (from, to);
            from = if best == 0 { start } else { x[best - 1] };
            to = if best + 1 == NODES { end } else { x[best + 1] };
        }
    }
}
