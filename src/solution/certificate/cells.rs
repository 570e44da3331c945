//! The slope of the gap in short cells, and whether the panels of the solver have missed anything of it.
//!
//! Panels are as long as the coefficients of their series allow, and what lies between two nodes shows
//! in none of them. So all of the gap is sampled a second time, in cells of a given length at most, and in the
//! contacts what the limits were found from is compared with them.

use super::{MOST_EVALUATIONS, undecided};
use crate::gap::{Cost, Gap, Sampler};
use crate::numerics::chebyshev::Table;
use crate::quadrature::panels::{Panel, PanelSet};
use crate::{ContactError, Ends, Interval, Real, Side};

/// The share of the largest slope by which the two may differ, besides the noise.
const ALLOWED: f64 = 1e-6;

/// The share of a cell below which a part of it is not looked at.
const SHORT: f64 = 1e-6;

/// Samples the gap in cells.
pub(super) struct Cells<'g, T: Real> {
    gap: &'g Gap<'g, T>,
    /// The longest of them.
    pub spacing: T,
    one: PanelSet<T>,
}

impl<'g, T: Real> Cells<'g, T> {
    pub fn new(gap: &'g Gap<'g, T>, spacing: T) -> Self {
        Self { gap, spacing, one: PanelSet::new(T::epsilon().powf(T::of(0.75))) }
    }

    /// Returns what all of them have cost.
    pub fn cost(&self) -> Cost {
        self.one.cost
    }

    /// Looks at the heights of the gap at places of a row, and at what the slopes say of them.
    pub fn heights<const N: usize>(
        &mut self,
        row: &PanelSet<T>,
        x: [T; N],
    ) -> Result<[T; N], ContactError<T>> {
        row.heights(self.gap, x, &mut self.one.cost)
    }

    /// Samples the cells between places, which rise.
    pub fn over(&mut self, places: &[T]) -> Result<PanelSet<T>, ContactError<T>> {
        let (gap, cells) = (self.gap, &mut self.one);
        let mut row = PanelSet::new(cells.tolerance);
        row.tilt = gap.tilt();
        // Beyond its last node a cell does not see: the ends are looked at.
        let ends = Ends { left: places[0], right: places[places.len() - 1] };
        let looks = Ends::from_fn(|end| cells.look_at(gap, end, ends[end]));
        // The cell before, its first panel and how steep it is.
        let mut before: Option<(Interval<T>, usize, T)> = None;
        for pair in places.windows(2) {
            let cell = Interval { left: pair[0], right: pair[1] };
            cells.held = looks;
            cells.sample_anew(gap, cell)?;
            if let (Some((other, first, steep)), Some(last)) = (before, row.panels.last())
                && !cells.meets(last, &cells.panels[0], cells.tolerance * steep)
                && !gap.is_breakpoint(cell.left)
            {
                // So it is where two of them do not meet, and both are sampled again.
                cells.held.right = cells.look_at(gap, Side::Right, cell.left);
                cells.sample_anew(gap, other)?;
                row.panels.truncate(first);
                row.panels.extend_from_slice(&cells.panels);
                cells.held = Ends { left: cells.look_at(gap, Side::Left, cell.left), ..looks };
                cells.sample_anew(gap, cell)?;
            }
            if cells.cost.evaluations > MOST_EVALUATIONS || cells.cost.samples > MOST_EVALUATIONS {
                return Err(undecided(cell.left, cells.cost));
            }
            before = Some((cell, row.panels.len(), cells.size));
            row.panels.extend_from_slice(&cells.panels);
        }
        Ok(row)
    }

    /// Lists the ends of cells from an edge of a contact to a place, by rising x: no longer than the spacing, and the
    /// shorter the nearer they are to the edge.
    pub fn places(&self, edge: T, end: T, half_width: T) -> Vec<T> {
        let (sign, reach) = (if end < edge { -T::one() } else { T::one() }, (end - edge).abs());
        let (mut places, mut reached) = (vec![edge], T::zero());
        while reached < reach && places.len() < MOST_EVALUATIONS {
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

    /// Compares what is assumed of the slope in a contact, and how far it may be off, with the nodes of all cells of a
    /// row, which are eight or more in each; where they differ most is what is named. Returns the least error that is
    /// assumed.
    pub fn compare(
        &self,
        row: &[Panel<T>],
        assumed: impl Fn(T) -> Option<(T, T)>,
        steepest: T,
    ) -> Result<T, ContactError<T>> {
        let mut sampler = Sampler::default();
        let mut doubt = None;
        let mut missed: Option<(T, ContactError<T>)> = None;
        // Those halved down to a jump end at one of its two sides, by chance.
        let short = T::of(SHORT) * self.spacing;
        for cell in row.iter().filter(|cell| cell.half() > short) {
            for &z in &Table::of(cell.n).z[..cell.n] {
                let x = cell.x[0] + cell.half() * T::of(1.0 + z);
                let Some((assumed, error)) = assumed(x) else { continue };
                doubt = Some(doubt.map_or(error, |least: T| least.min(error)));
                let allowed = T::of(ALLOWED) * steepest + T::of(16.0) * error;
                let most = missed.as_ref().map_or(allowed, |&(most, _)| allowed.max(most));
                if (cell.value(x) - assumed).abs() <= most {
                    continue;
                }
                // The series of the cell may itself be off.
                let slope = sampler.slope(self.gap, x)?;
                let off = (slope - assumed).abs();
                if off > most {
                    missed = Some((off, ContactError::FeatureMissed { x, slope, assumed }));
                }
            }
        }
        missed.map_or(Ok(doubt.unwrap_or(T::zero())), |(_, error)| Err(error))
    }
}
