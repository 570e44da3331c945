//! Proof that the pressure is positive inside a contact.
//!
//! If the slope of the gap rises throughout, the pressure is positive, as an integral of g' with a
//! positive kernel. Otherwise the bounded function is the pressure times the square root of the
//! distance from an edge, or at a free edge divided by it: a function that is smooth between the
//! breakpoints and as positive at the edges as elsewhere. Between breakpoints it is a Chebyshev
//! series on cells, which are halved until the coefficients prove the sign; so the cells are graded
//! towards the logarithms at the breakpoints.

use super::series_bounds::{below, least, truncation_error};
use super::{Extremum, nearer, undecided};
use crate::gap::{Cost, Gap};
use crate::numerics::chebyshev::Table;
use crate::{ContactError, Ends, Interval, Real, SolveError};

/// Number of nodes of a cell.
const NODES: usize = 16;
/// Largest number of halvings of a span between two breakpoints.
const MAX_LEVELS: usize = 52;
/// Largest number of cells in all.
const MAX_CELLS: usize = 1 << 16;
/// Largest number of breakpoints at which the pressure is taken, besides those where the slope
/// jumps down.
const MAX_JOINTS: usize = 512;

/// Pressures at the nodes of a cell, and the series of the pressure times its smoothing factor.
struct CheckedCell<T> {
    x: [T; NODES],
    pressure: [T; NODES],
    series: [T; NODES],
}

/// Results so far: the deepest tension, and the least ratio.
struct Found<T> {
    worst: Option<Extremum<T>>,
    ratio: Option<Extremum<T>>,
    cells: usize,
}

/// Contact with known pressures.
pub(super) struct Inside<'c, T: Real> {
    pub pressures: &'c dyn Fn(&[T], &mut [T]),
    pub gap: &'c Gap<'c, T>,
    pub on: Interval<T>,
    /// Flags: the limit is free.
    pub free: Ends<bool>,
    pub load: T,
    /// Interval from the first limit of all contacts to the last.
    pub hull: Interval<T>,
    /// Largest tension that counts as zero.
    pub allowed: T,
}

impl<T: Real> Inside<'_, T> {
    fn tension(&self, place: Extremum<T>, cost: Cost) -> ContactError<T> {
        let (Extremum { x, value: pressure }, interval, load) = (place, self.hull, self.load);
        if pressure.partial_cmp(&pressure).is_none() {
            return undecided(x, cost);
        }
        ContactError::Solve(SolveError::Tension { x, pressure, interval, load })
    }

    /// Finds the place where the ratio of the pressure to that under a smooth body is least. Fails
    /// at the deepest tension found beyond `allowed`.
    pub fn least(&self, cost: Cost) -> Result<Extremum<T>, ContactError<T>> {
        let on = self.on;
        let mut found = Found { worst: None, ratio: None, cells: 0 };
        for x in self.gap.telling_breakpoints(on, -T::one(), MAX_JOINTS) {
            let mut pressure = [T::zero()];
            (self.pressures)(&[x], &mut pressure);
            self.meet(&mut found, x, pressure[0]);
        }
        // Each span between two breakpoints is one cell or more.
        if self.gap.breakpoints(on).count() < MAX_CELLS {
            let mut left = on.left;
            for right in self.gap.breakpoints(on).chain([on.right]) {
                self.bound([left, right], &mut found, cost)?;
                left = right;
            }
        }
        match found.worst {
            Some(place) => Err(self.tension(place, cost)),
            None => found.ratio.ok_or_else(|| undecided(on.centre(), cost)),
        }
    }

    /// Records a pressure that is a tension beyond `allowed`, if it is the deepest so far.
    fn meet(&self, found: &mut Found<T>, x: T, value: T) {
        // NaN counts as tension.
        let presses = value >= -self.allowed;
        if !presses {
            found.worst = nearer(Some(Extremum { x, value }), found.worst);
        }
    }

    /// Bounds the ratio between two breakpoints.
    fn bound(&self, span: [T; 2], found: &mut Found<T>, cost: Cost) -> Result<(), ContactError<T>> {
        let mut waiting = vec![(span, 0)];
        while let Some(([from, to], level)) = waiting.pop() {
            found.cells += 1;
            if found.cells > MAX_CELLS {
                // One place with tension is enough.
                let tension = found.worst.map(|place| self.tension(place, cost));
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
                // The sign is the sign of the polynomial, up to `allowed`.
                let enough = if bound > T::zero() { coarse } else { T::of(1e-4) * self.allowed };
                let [s, value] = least(&series, enough);
                let x = (middle + s * T::of(0.5) * (to - from)).max(from).min(to);
                found.ratio = nearer(Some(Extremum { x, value }), found.ratio);
                if value < -self.allowed {
                    self.deepest([from, to], found);
                }
            } else if level < MAX_LEVELS && middle > from && middle < to {
                waiting.extend([([middle, to], level + 1), ([from, middle], level + 1)]);
            } else {
                x.iter().zip(&pressure).for_each(|(&x, &pressure)| self.meet(found, x, pressure));
            }
        }
        Ok(())
    }

    /// Samples a cell; `None` if its nodes do not fit between its ends.
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

    /// Returns the factor that makes the pressure smooth at the edges.
    fn factor(&self, x: T) -> T {
        let free = self.free;
        let by_half_width = T::one() / self.on.half_width();
        let part = |distance: T, free: bool| {
            let root = (distance * by_half_width).sqrt();
            if free { T::one() / root } else { root }
        };
        part(self.on.right - x, free.right) * part(x - self.on.left, free.left)
    }

    /// Finds the least pressure on a cell where it is negative, by shrinking a grid.
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gap::Shape;
    use crate::profile::{Curve, CurvePoint, Flat, Piecewise};
    use crate::search::Newton as Inversion;

    /// Pressures that are no numbers prove nothing, next to a joint or further.
    #[test]
    fn a_pressure_that_is_unknown_decides_nothing() {
        let piece = |ends: [f64; 2]| {
            Curve::new(ends, |k: f64| CurvePoint { x: k, y: 0.5 * k * k, dx: 1.0, dy: k })
        };
        let body = Piecewise::new(vec![piece([-1.0, 0.1]), piece([0.1, 1.0])]).unwrap();
        let inversion = Inversion::default();
        let gap = Gap::new(Shape::Lent(&Flat), Shape::Lent(&body), &inversion).unwrap();
        let on = Interval { left: -0.2, right: 0.2 };
        for hidden in [0.0, 1e-12, 0.1] {
            let pressures = |x: &[f64], pressures: &mut [f64]| {
                for (pressure, x) in pressures.iter_mut().zip(x) {
                    let is_hidden = (x - 0.1).abs() < hidden;
                    *pressure = if is_hidden { f64::NAN } else { on.chebyshev_weight(*x) };
                }
            };
            let free = Ends::both(true);
            let inside = Inside {
                pressures: &pressures,
                gap: &gap,
                on,
                free,
                load: 1.0,
                hull: on,
                allowed: 1e-9,
            };
            let found = inside.least(Cost::default());
            let is_open =
                matches!(found, Err(ContactError::Solve(crate::SolveError::Undecided { .. })));
            assert_eq!(is_open, hidden > 0.0, "{hidden}: {found:?}");
        }
    }
}
