//! Sign of the pressure inside a contact.
//!
//! If the slope of the gap rises throughout, the pressure is positive, as an integral of g' with a
//! positive kernel. Otherwise the bounded function is the pressure times the square root of the
//! distance from an edge, or at a free edge divided by it: a function that is smooth between the
//! breakpoints and as positive at the edges as elsewhere. Between breakpoints it is a Chebyshev
//! series on cells, which are halved until the coefficients show the sign; so the cells are graded
//! towards the logarithms at the breakpoints.

use super::series_bounds::{bounds, least, truncation_error};
use super::{Closeness, Extremum, nearer};
use crate::numerics::ascending;
use crate::numerics::chebyshev::Table;
use crate::{ContactError, Ends, Fallible, Interval, Real, Side};

/// Number of nodes of a cell.
const NODES: usize = 16;
/// Largest number of cells in all.
const MAX_CELLS: usize = 1 << 16;

/// Number of places between a tension and the end of the contact at which the pressure is
/// evaluated: enough to halve the distance down to rounding.
const HALVES: i32 = 52;

/// Pressures at places.
pub(crate) type Pressures<'c, T> = &'c dyn Fn(&[T], &mut [T]) -> Fallible<T, ()>;

/// Nodes of a cell, and the pressures there.
type Cell<T> = [[T; NODES]; 2];

/// Results so far: places with tension, and the least ratio.
#[derive(Clone)]
pub(crate) struct Tensions<T> {
    pub found: Vec<Extremum<T>>,
    pub ratio: Option<Extremum<T>>,
    cells: usize,
    /// Place from which on there were too many cells.
    pub given_up: Option<T>,
    /// Spans still to be bounded, each with the number of its halvings.
    waiting: Vec<([T; 2], usize)>,
}

/// Contact with known pressures.
pub(crate) struct Inside<'c, T: Real> {
    pub pressures: Pressures<'c, T>,
    pub on: Interval<T>,
    /// Flags: the limit is free.
    pub free: Ends<bool>,
    /// Largest tension that counts as zero.
    pub allowed: T,
    pub closeness: Closeness,
}

/// Sign of a series: positive, by a bound, that of the least value `[s, value]`, or not known.
enum Sign<T> {
    Above(T),
    OfLeast([T; 2]),
    Open,
}

impl<T: Real> Tensions<T> {
    pub fn new() -> Self {
        let (found, waiting) = (Vec::new(), Vec::new());
        Self { found, ratio: None, cells: 0, given_up: None, waiting }
    }

    /// Starts anew; a ratio counts if it is less than a known one.
    pub fn clear(&mut self, known: Extremum<T>) {
        self.found.clear();
        (self.ratio, self.cells, self.given_up) = (Some(known), 0, None);
    }

    /// Sorts the places by their pressures, the deepest tension first.
    pub fn sort(&mut self) {
        self.found.sort_by(|one, other| ascending(&one.value, &other.value));
    }

    /// Records pressures that are tensions.
    pub fn meet(&mut self, x: &[T], pressures: &[T], allowed: T) {
        // NaN counts as tension.
        let presses = |value: T| value >= -allowed;
        let both = x.iter().zip(pressures).filter(|&(_, &value)| !presses(value));
        self.found.extend(both.map(|(&x, &value)| Extremum { x, value }));
    }
}

impl<T: Real> Inside<'_, T> {
    /// Looks at the pressures at places.
    pub fn look_at(&self, places: &[T], found: &mut Tensions<T>) -> Result<(), ContactError<T>> {
        places.chunks(NODES).try_for_each(|places| {
            let pressures = &mut [T::zero(); NODES][..places.len()];
            (self.pressures)(places, pressures)?;
            found.meet(places, pressures, self.allowed);
            Ok(())
        })
    }

    /// Returns the least ratio of the pressure to that under a smooth body, or a positive bound of
    /// it, from pressures at the Chebyshev nodes of the contact. It is negative if they do not show
    /// it.
    pub fn least<const N: usize>(&self, x: &[T; N], pressures: &[T; N]) -> T {
        match self.sign(&self.series(x, pressures), T::zero(), T::zero()) {
            Sign::Above(least) | Sign::OfLeast([_, least]) => least,
            Sign::Open => -T::one(),
        }
    }

    /// Bounds this ratio on a span between two breakpoints.
    pub fn bound(&self, span: [T; 2], found: &mut Tensions<T>) -> Result<(), ContactError<T>> {
        found.waiting.clear();
        found.waiting.push((span, 0));
        while let Some(([from, to], level)) = found.waiting.pop() {
            found.cells += 1;
            if found.cells > MAX_CELLS {
                found.given_up = found.given_up.or(Some(from));
                return Ok(());
            }
            let (middle, half) = (T::of(0.5) * from + T::of(0.5) * to, T::of(0.5) * (to - from));
            let place = |s: T| (middle + s * half).max(from).min(to);
            let Some([x, pressures]) = self.cell([from, to])? else { continue };
            let known = found.ratio.map_or(T::one() / T::zero(), |ratio| ratio.value);
            // Next to a narrow gap the rounding of x is all that the series leaves out.
            let rounding = T::of(16.0) * T::epsilon() * from.abs().max(to.abs()) / (to - from);
            let sign = self.sign(&self.series(&x, &pressures), known, rounding.min(T::one()));
            if let Sign::OfLeast([s, value]) = sign {
                found.ratio = nearer(Some(Extremum { x: place(s), value }), found.ratio);
                if value < -self.allowed {
                    found.meet(&x, &pressures, self.allowed);
                    let series = Table::of(NODES).coefficients(&pressures);
                    // The place of a least value is known to the root of this.
                    let enough = T::epsilon().powf(T::of(0.75)) * value.abs();
                    let [deepest, _] = least(&series, enough);
                    // At a limit the pressure is not defined: half the way to the first node.
                    let first = T::of(0.5) * from + T::of(0.5) * x[0];
                    let last = T::of(0.5) * x[NODES - 1] + T::of(0.5) * to;
                    let within = |s: T| match place(s) {
                        at if at <= self.on.left => first,
                        at if at >= self.on.right => last,
                        at => at,
                    };
                    self.look_at(&[within(s), within(deepest)], found)?;
                }
            }
            if !matches!(sign, Sign::Open) {
                continue;
            }
            if level < self.closeness.levels && middle > from && middle < to {
                found.waiting.extend([([middle, to], level + 1), ([from, middle], level + 1)]);
            } else {
                found.meet(&x, &pressures, self.allowed);
            }
        }
        Ok(())
    }

    /// Returns the sign of a series, or that it is above a known ratio, as soon as the truncation
    /// error is a share of the least value that is rounding.
    fn sign<const N: usize>(&self, series: &[T; N], known: T, rounding: T) -> Sign<T> {
        let left_out = truncation_error(series);
        let size = series.iter().fold(T::zero(), |max, a| max.max(a.abs()));
        let bound = bounds(series)[0] - left_out;
        if bound > T::zero() && known <= bound {
            return Sign::Above(bound);
        }
        let coarse = T::epsilon().sqrt() * size;
        if left_out <= T::of(0.25) * self.allowed || (bound > T::zero() && left_out <= coarse) {
            // The sign is the sign of the polynomial, up to `allowed`.
            let enough = if bound > T::zero() { coarse } else { T::of(1e-4) * self.allowed };
            return Sign::OfLeast(least(series, enough));
        }
        let share = T::of(self.closeness.share).max(rounding);
        // No value of the series is above N times its largest coefficient.
        let may_be = left_out <= share * T::count(N) * size;
        let rough = may_be.then(|| least(series, T::of(0.5) * left_out));
        let is_known = |&[_, value]: &[T; 2]| left_out <= share * value.abs();
        rough.filter(is_known).map_or(Sign::Open, Sign::OfLeast)
    }

    /// Returns the nodes of a cell and the pressures there; `None` if they do not fit between its
    /// ends.
    fn cell(&self, [from, to]: [T; 2]) -> Fallible<T, Option<Cell<T>>> {
        let (half, table) = (T::of(0.5), Table::of(NODES));
        let (middle, reach) = (half * from + half * to, half * (to - from));
        let x: [T; NODES] = std::array::from_fn(|i| middle + reach * T::of(table.z[i]));
        if x[0] <= from || x[NODES - 1] >= to {
            return Ok(None);
        }
        let mut pressures = [T::zero(); NODES];
        (self.pressures)(&x, &mut pressures)?;
        Ok(Some([x, pressures]))
    }

    /// Returns the series of the ratio from the pressures at the nodes of a cell.
    fn series<const N: usize>(&self, x: &[T; N], pressures: &[T; N]) -> [T; N] {
        let smooth: [T; N] = std::array::from_fn(|i| pressures[i] * self.factor(x[i]));
        Table::of(N).coefficients(&smooth)
    }

    /// Returns the factor that makes the pressure smooth at the edges.
    pub fn factor(&self, x: T) -> T {
        let free = self.free;
        let by_half_width = T::one() / self.on.half_width();
        let part = |distance: T, free: bool| {
            let root = (distance * by_half_width).sqrt();
            if free { T::one() / root } else { root }
        };
        part(self.on.right - x, free.right) * part(x - self.on.left, free.left)
    }
}

/// Returns the span of tension around a place `[x, P]` in a contact, and whether it counts as
/// closed. It reaches to the nearest pressure on each side, among places each twice as far away as
/// the one before, or else to the end of the contact.
pub(crate) fn parting<T: Real>(
    pressures: Pressures<'_, T>,
    on: Interval<T>,
    [x, pressure]: [T; 2],
    least_width: T,
) -> Fallible<T, (Interval<T>, bool)> {
    let presses_from = |side: Side| -> Fallible<T, T> {
        let end = on[side];
        let share = |times: i32| T::of(0.5).powi(times);
        let places: Vec<T> = (1..=HALVES).rev().map(|i| x + (end - x) * share(i)).collect();
        let mut found = vec![T::zero(); places.len()];
        pressures(&places, &mut found)?;
        let mut both = places.iter().zip(&found);
        let first = both.find(|&(&place, &pressure)| place != x && pressure > T::zero());
        Ok(first.map_or(end, |(&place, _)| place))
    };
    let span = Interval { left: presses_from(Side::Left)?, right: presses_from(Side::Right)? };
    // A pressure that is no number is none of a gap that is closed.
    Ok((span, pressure < T::zero() && span.half_width() <= least_width))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pressures that are no numbers prove nothing.
    #[test]
    fn a_pressure_that_is_unknown_decides_nothing() {
        let on = Interval { left: -0.2, right: 0.2 };
        let free = Ends::both(true);
        for closeness in [Closeness::OF_A_SOLVE, Closeness::OF_A_PROOF] {
            for hidden in [0.0, 1e-12, 0.1] {
                let pressures = |x: &[f64], pressures: &mut [f64]| {
                    for (pressure, x) in pressures.iter_mut().zip(x) {
                        let is_hidden = (x - 0.1).abs() < hidden;
                        *pressure = if is_hidden { f64::NAN } else { on.chebyshev_weight(*x) };
                    }
                    Ok(())
                };
                let inside = Inside { pressures: &pressures, on, free, allowed: 1e-9, closeness };
                let mut found = Tensions::new();
                inside.look_at(&[0.1], &mut found).unwrap();
                inside.bound([-0.2, 0.1], &mut found).unwrap();
                inside.bound([0.1, 0.2], &mut found).unwrap();
                found.sort();
                let is_unknown = found.found.first().is_some_and(|worst| worst.value.is_nan());
                assert_eq!(is_unknown, hidden > 0.0, "{hidden}: {:?}", found.found);
            }
        }
    }

    /// A gap is closed if it is too narrow to be told, and its pressure is known.
    #[test]
    fn a_gap_of_unknown_pressure_is_not_closed() {
        let on = Interval { left: -0.2, right: 0.2 };
        let unknown = (f64::NAN, 1e-15, false);
        for (hidden, half, closes) in [(-1e9, 1e-15, true), (-1e9, 1e-3, false), unknown] {
            let pressures = |x: &[f64], pressures: &mut [f64]| {
                for (pressure, x) in pressures.iter_mut().zip(x) {
                    let is_hidden = (x - 0.1).abs() < half;
                    *pressure = if is_hidden { hidden } else { on.chebyshev_weight(*x) };
                }
                Ok(())
            };
            let (span, is_closed) = parting(&pressures, on, [0.1, hidden], 1e-12).unwrap();
            assert!(is_closed == closes && span.contains(0.1), "{hidden} {half}: {span:?}");
        }
    }

    /// A dip no narrower than a tenth of a span is found, and none is accused that is not there.
    #[test]
    fn a_solve_finds_the_tension_that_a_proof_does() {
        let on = Interval { left: -1.0, right: 1.0 };
        for (least, width) in [(-1e-3, 1.0), (1e-3, 1.0), (-1e-3, 0.01), (1e-3, 0.01)] {
            let pressures = |x: &[f64], pressures: &mut [f64]| {
                for (pressure, x) in pressures.iter_mut().zip(x) {
                    let z = (x - 0.0123) / width;
                    let dip = (1.0 - least) / (1.0 + z * z);
                    *pressure = on.chebyshev_weight(*x) * (1.0 - dip);
                }
                Ok(())
            };
            for closeness in [Closeness::OF_A_SOLVE, Closeness::OF_A_PROOF] {
                let (free, mut found) = (Ends::both(true), Tensions::new());
                let inside = Inside { pressures: &pressures, on, free, allowed: 1e-12, closeness };
                let span = [-1.0, 1.0].map(|end: f64| end * (5.0 * width).min(1.0));
                inside.bound(span, &mut found).unwrap();
                found.sort();
                let worst = found.found.first();
                assert_eq!(worst.is_some(), least < 0.0, "{least} {width}");
                let near = worst.is_none_or(|worst| (worst.x - 0.0123).abs() < 0.1 * width);
                assert!(near, "{least} {width}: {worst:?}");
            }
        }
    }
}
