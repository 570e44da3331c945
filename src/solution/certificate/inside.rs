//! No tension inside.
//!
//! Where the slope of the gap rises throughout, the pressure is positive (its integral over g' has a
//! kernel that is). Elsewhere what is bounded from below is the pressure times the square root of
//! the distance from an edge, or at a free edge divided by it: a function that is smooth between
//! the breakpoints and as positive at the edges as elsewhere. Between breakpoints it is a Chebyshev series on
//! cells, which are halved until the coefficients leave no doubt of the sign; so the cells are
//! graded towards the logarithms at the breakpoints.

use super::series_bounds::{below, least, truncation_error};
use super::{Extremum, nearer, undecided};
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

/// What has been found so far: the deepest tension, and the least ratio.
struct Found<T> {
    worst: Option<Extremum<T>>,
    ratio: Option<Extremum<T>>,
    cells: usize,
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
        let mut found = Found { worst: None, ratio: None, cells: 0 };
        for x in self.gap.telling_breakpoints(on, -T::one(), MOST_JOINTS) {
            let mut pressure = [T::zero()];
            (self.pressures)(&[x], &mut pressure);
            self.meet(&mut found, x, pressure[0]);
        }
        // Each span between two breakpoints is a cell or more.
        if self.gap.breakpoints(on).count() < MOST_CELLS {
            let mut left = on.left;
            for right in self.gap.breakpoints(on).chain([on.right]) {
                self.bound([left, right], &mut found, cost)?;
                left = right;
            }
        }
        match (found.worst, found.ratio) {
            (Some(place), _) => Err(self.tension(place)),
            (None, Some(ratio)) => Ok(ratio),
            (None, None) => Err(undecided(on.centre(), cost)),
        }
    }

    /// Takes a pressure into account.
    fn meet(&self, found: &mut Found<T>, x: T, value: T) {
        if value < -self.allowed {
            found.worst = nearer(Some(Extremum { x, value }), found.worst);
        }
    }

    /// Bounds the ratio between two breakpoints.
    fn bound(&self, span: [T; 2], found: &mut Found<T>, cost: Cost) -> Result<(), ContactError<T>> {
        let mut waiting = vec![(span, 0)];
        while let Some(([from, to], level)) = waiting.pop() {
            found.cells += 1;
            if found.cells > MOST_CELLS {
                // One place with tension is enough.
                let tension = found.worst.map(|place| self.tension(place));
                return Err(tension.unwrap_or_else(|| undecided(from, cost)));
            }
            let middle = T::of(0.5) * from + T::of(0.5) * to;
            let Some(CheckedCell { x, pressure, series }) = self.cell([from, to]) else { continue };
            let left_out = truncation_error(&series);
            let size = series.iter().fold(T::zero(), |max, a| max.max(a.abs()));
            let bound = below(&series) - left_out;
            if bound > T::zero() && found.ratio.is_some_and(|ratio| ratio.value <= bound) {
                continue;
            }
            let coarse = T::epsilon().sqrt() * size;
            let fine = T::of(0.25) * self.allowed;
            if left_out <= fine || (bound > T::zero() && left_out <= coarse) {
                // The sign is that of the polynomial, but for what is allowed.
                let enough = if bound > T::zero() { coarse } else { T::of(1e-4) * self.allowed };
                let [s, value] = least(&series, enough);
                let x = (middle + s * T::of(0.5) * (to - from)).max(from).min(to);
                found.ratio = nearer(Some(Extremum { x, value }), found.ratio);
                if value < -self.allowed {
                    self.deepest([from, to], found);
                }
            } else if level < MOST_LEVELS && middle > from && middle < to {
                waiting.extend([([middle, to], level + 1), ([from, middle], level + 1)]);
            } else {
                x.iter().zip(&pressure).for_each(|(&x, &pressure)| self.meet(found, x, pressure));
            }
        }
        Ok(())
    }

    /// Looks at a cell; nothing if there is no room.
    fn cell(&self, [from, to]: [T; 2]) -> Option<CheckedCell<T>> {
        let (half, table) = (T::of(0.5), Table::of(NODES));
        let (middle, reach) = (half * from + half * to, half * (to - from));
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
    fn deepest(&self, [mut from, mut to]: [T; 2], found: &mut Found<T>) {
        for _ in 0..12 {
            let Some(CheckedCell { x, pressure, .. }) = self.cell([from, to]) else { break };
            let lower = |best: usize, i: usize| if pressure[i] < pressure[best] { i } else { best };
            let best = (0..NODES).fold(0, lower);
            self.meet(found, x[best], pressure[best]);
            from = if best == 0 { from } else { x[best - 1] };
            to = x.get(best + 1).copied().unwrap_or(to);
        }
    }
}
