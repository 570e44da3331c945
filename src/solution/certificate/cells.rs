//! The slope of the gap in short cells, compared with the panels of the solver.
//!
//! Panels are as long as the coefficients of their series allow, and a feature between two nodes
//! shows in none of the coefficients. So all of the gap is sampled a second time, in cells of at
//! most a given length. In the contacts the slope from which the limits were found is compared with
//! them.

use super::{MAX_EVALUATIONS, undecided};
use crate::gap::{Cost, Gap, Sampler};
use crate::numerics::chebyshev::Table;
use crate::quadrature::panels::{Panel, PanelSet};
use crate::{ContactError, Ends, Interval, Real, Side, SolveError};

/// Largest difference of the two slopes, as a share of the largest slope, besides the noise.
const MAX_DIFFERENCE: f64 = 2e-7;

/// Half-length of a cell, as a share of the spacing, below which the cell is not compared.
const LEAST_CELL: f64 = 1e-6;

/// Samples of the gap in cells.
pub(super) struct Cells<'g, T: Real> {
    gap: &'g Gap<'g, T>,
    /// Largest length of a cell.
    pub spacing: T,
    one: PanelSet<T>,
}

impl<'g, T: Real> Cells<'g, T> {
    pub fn new(gap: &'g Gap<'g, T>, spacing: T) -> Self {
        Self { gap, spacing, one: PanelSet::new(T::epsilon().powf(T::of(0.75))) }
    }

    /// Returns the cost of all cells.
    pub fn cost(&self) -> Cost {
        self.one.cost
    }

    /// Checks that the heights of the gap at places of a row agree with its slopes.
    pub fn check_heights<const N: usize>(
        &mut self,
        row: &PanelSet<T>,
        x: [T; N],
    ) -> Result<(), ContactError<T>> {
        row.heights(self.gap, x, &mut self.one.cost).map(|_| ())
    }

    /// Samples the cells between rising places.
    pub fn over(&mut self, places: &[T]) -> Result<PanelSet<T>, ContactError<T>> {
        let (gap, cells) = (&self.gap.as_described(), &mut self.one);
        let mut row = PanelSet::new(cells.tolerance);
        // A cell shows nothing beyond its last node: the ends are probed.
        let ends = Ends { left: places[0], right: places[places.len() - 1] };
        let looks = Ends::from_fn(|end| cells.look_at(gap, end, ends[end]));
        // The previous cell, its first panel and its largest slope.
        let mut before: Option<(Interval<T>, usize, T)> = None;
        for pair in places.windows(2) {
            let cell = Interval { left: pair[0], right: pair[1] };
            cells.held = looks;
            cells.sample_anew(gap, cell)?;
            if let (Some((other, first, steep)), Some(last)) = (before, row.panels.last())
                && !cells.meets(last, &cells.panels[0], cells.tolerance * steep)
                && !gap.is_breakpoint(cell.left)
            {
                // Two cells do not meet here: both are sampled again with this end probed.
                cells.held.right = cells.look_at(gap, Side::Right, cell.left);
                cells.sample_anew(gap, other)?;
                row.panels.truncate(first);
                row.panels.extend_from_slice(&cells.panels);
                cells.held = Ends { left: cells.look_at(gap, Side::Left, cell.left), ..looks };
                cells.sample_anew(gap, cell)?;
            }
            if cells.cost.evaluations > MAX_EVALUATIONS || cells.cost.samples > MAX_EVALUATIONS {
                return Err(undecided(cell.left, cells.cost));
            }
            before = Some((cell, row.panels.len(), cells.size));
            row.panels.extend_from_slice(&cells.panels);
        }
        row.add(self.gap);
        Ok(row)
    }

    /// Lists the ends of cells from an edge of a contact to a place, by rising x. Cells are no
    /// longer than the spacing, and shorter the nearer they are to the edge.
    pub fn places(&self, edge: T, end: T, half_width: T) -> Vec<T> {
        let (sign, reach) = (if end < edge { -T::one() } else { T::one() }, (end - edge).abs());
        let (mut places, mut reached) = (vec![edge], T::zero());
        while reached < reach && places.len() < MAX_EVALUATIONS {
            let step = (T::of(0.5) * reached).max(T::of(0.0625) * half_width).min(self.spacing);
            // No sliver at the end.
            let is_last = reached + T::of(1.25) * step >= reach;
            reached = if is_last { reach } else { reached + step };
            let to = if is_last { end } else { edge + sign * reached };
            if places.last() != Some(&to) {
                places.push(to);
            }
        }
        if sign < T::zero() {
            places.reverse();
        }
        places
    }

    /// Compares the assumed slope in a contact, given with its error, with the nodes of all cells
    /// of a row, eight or more in each. Fails at the largest difference, if it exceeds the
    /// tolerance. Returns the least error assumed.
    pub fn compare(
        &self,
        row: &[Panel<T>],
        assumed: impl Fn(T) -> Option<(T, T)>,
        steepest: T,
    ) -> Result<T, ContactError<T>> {
        let mut sampler = Sampler::default();
        let mut doubt = None;
        let mut missed: Option<(T, ContactError<T>)> = None;
        // A cell halved down to a jump ends on one side of it, by chance.
        let short = T::of(LEAST_CELL) * self.spacing;
        for cell in row.iter().filter(|cell| cell.half() > short) {
            for &z in &Table::of(cell.n).z[..cell.n] {
                let x = cell.x[0] + cell.half() * T::of(1.0 + z);
                let Some((assumed, error)) = assumed(x) else { continue };
                doubt = Some(doubt.map_or(error, |least: T| least.min(error)));
                let allowed = T::of(MAX_DIFFERENCE) * steepest + T::of(16.0) * error;
                let most = missed.as_ref().map_or(allowed, |&(most, _)| allowed.max(most));
                if (cell.value(x) - assumed).abs() <= most {
                    continue;
                }
                // The series of the cell may itself be wrong.
                let slope = sampler.slope(self.gap, x)?;
                let off = (slope - assumed).abs();
                if off > most {
                    missed = Some((off, SolveError::FeatureMissed { x, slope, assumed }.into()));
                }
            }
        }
        missed.map_or(Ok(doubt.unwrap_or(T::zero())), |(_, error)| Err(error))
    }
}
