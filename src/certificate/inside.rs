//! No tension inside.
//!
//! Where the slope of the gap rises throughout, the pressure is positive (its integral over g' has a
//! kernel that is). Elsewhere what is bounded from below is the pressure times the square root of
//! the distance from an edge, or at a free edge divided by it: a function that is smooth between
//! the joints and as positive at the edges as elsewhere. Between joints it is a Chebyshev series on
//! cells, which are halved until the coefficients leave no doubt of the sign; so the cells are
//! graded towards the logarithms at the joints.

use super::series::{below, least, tail};
use super::{Place, undecided};
use crate::gap::{Cost, Gap};
use crate::quadrature::panels::chebyshev::Table;
use crate::quadrature::{Engine, Pressing};
use crate::{ContactError, Interval, Real};

/// Nodes of a cell.
const NODES: usize = 16;
/// How often a stretch between two joints is halved.
const MOST_LEVELS: usize = 52;
/// Cells in all.
const MOST_CELLS: usize = 1 << 16;
/// Joints at which the pressure is asked for, besides those where the slope jumps down.
const MOST_JOINTS: usize = 512;

/// Pressures at the nodes of a cell, and the series of what is smooth.
struct Cell<T> {
    x: [T; NODES],
    pressure: [T; NODES],
    series: [T; NODES],
}

/// A contact whose engine has been prepared.
pub(super) struct Inside<'c, T: Real> {
    pub engine: &'c dyn Engine<T>,
    pub gap: &'c Gap<'c, T>,
    pub pressing: Pressing<T>,
    pub on: Interval<T>,
    /// From the first limit of all contacts to the last.
    pub hull: Interval<T>,
    /// Pressures down to the negative of this are zero.
    pub allowed: T,
}

impl<T: Real> Inside<'_, T> {
    fn tension(&self, Place { x, value: pressure }: Place<T>) -> ContactError<T> {
        let (interval, load) = (self.hull, self.pressing.load);
        ContactError::Tension { x, pressure, interval, load }
    }

    /// The least pressure found, negative only if it is less than what is allowed for; and where
    /// the ratio of the pressure to that under a smooth body is least.
    pub fn least(&self, cost: &mut Cost) -> Result<Place<T>, ContactError<T>> {
        let on = self.on;
        let worst: std::cell::Cell<Option<Place<T>>> = std::cell::Cell::new(None);
        let mut meet = |x: T, value: T| {
            if value < -self.allowed && worst.get().is_none_or(|worst| value < worst.value) {
                worst.set(Some(Place { x, value }));
            }
        };
        for x in self.gap.telling_joints(on, -T::one(), MOST_JOINTS) {
            let mut pressure = [T::zero()];
            self.engine.pressures(self.gap, &self.pressing, &[x], &mut pressure, cost)?;
            meet(x, pressure[0]);
        }
        // Each stretch between two joints is a cell or more.
        let crowded = self.gap.joints(on).count() >= MOST_CELLS;
        // The ratio that is smallest, and where.
        let mut ratio: Option<Place<T>> = None;
        let (mut waiting, mut cells, mut left) = (Vec::new(), 0, Some(on.left));
        while let Some(start) = left.filter(|_| !crowded) {
            let joint = self.gap.joint_after(start).filter(|&joint| joint < on.right);
            waiting.push(([start, joint.unwrap_or(on.right)], 0));
            left = joint;
            while let Some(([from, to], level)) = waiting.pop() {
                cells += 1;
                if cells > MOST_CELLS {
                    // One place with tension is enough.
                    let seen = worst.get();
                    return Err(
                        seen.map_or_else(|| undecided(from, *cost), |place| self.tension(place))
                    );
                }
                let middle = T::of(0.5) * from + T::of(0.5) * to;
                let Some(cell) = self.cell([from, to], cost)? else { continue };
                let Cell { x, pressure, series } = cell;
                let left_out = tail(&series);
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
                        ratio = Some(Place { x, value });
                    }
                    if value < -self.allowed {
                        self.deepest([from, to], &mut meet, cost)?;
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
            (None, None) => Err(undecided(on.centre(), *cost)),
        }
    }

    /// Looks at a cell; nothing if there is no room.
    fn cell(
        &self,
        [from, to]: [T; 2],
        cost: &mut Cost,
    ) -> Result<Option<Cell<T>>, ContactError<T>> {
        let half = T::of(0.5);
        let (middle, reach) = (half * from + half * to, half * (to - from));
        let table = Table::of(NODES);
        let x: [T; NODES] = std::array::from_fn(|i| middle + reach * T::of(table.z[i]));
        if x[0] <= from || x[NODES - 1] >= to {
            return Ok(None);
        }
        let mut pressure = [T::zero(); NODES];
        self.engine.pressures(self.gap, &self.pressing, &x, &mut pressure, cost)?;
        let smooth: [T; NODES] = std::array::from_fn(|i| pressure[i] * self.factor(x[i]));
        Ok(Some(Cell { x, pressure, series: table.coefficients(&smooth) }))
    }

    /// What makes the pressure smooth at the edges.
    fn factor(&self, x: T) -> T {
        let [free_b, free_a] = self.pressing.free;
        let by_half_width = T::one() / self.on.half_width();
        let part = |distance: T, free: bool| {
            let root = (distance * by_half_width).sqrt();
            if free { T::one() / root } else { root }
        };
        part(self.on.right - x, free_a) * part(x - self.on.left, free_b)
    }

    /// The least pressure itself on a cell that has some below zero, by shrinking a grid.
    fn deepest(
        &self,
        [mut from, mut to]: [T; 2],
        meet: &mut dyn FnMut(T, T),
        cost: &mut Cost,
    ) -> Result<(), ContactError<T>> {
        for _ in 0..12 {
            let Some(Cell { x, pressure, .. }) = self.cell([from, to], cost)? else { break };
            let lower = |best: usize, i: usize| if pressure[i] < pressure[best] { i } else { best };
            let best = (0..NODES).fold(0, lower);
            meet(x[best], pressure[best]);
            let (start, end) = (from, to);
            from = if best == 0 { start } else { x[best - 1] };
            to = if best + 1 == NODES { end } else { x[best + 1] };
        }
        Ok(())
    }
}
