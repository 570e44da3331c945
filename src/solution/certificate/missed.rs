//! Whether the panels of the contact have missed anything.
//!
//! Panels are as long as the coefficients of their series allow, and what lies between two nodes shows
//! in none of them. So the contact is sampled a second time, in cells as short as those outside it, and
//! all that is known of it is compared with them: the panels of the certificate, and those that the
//! limits were found from.

use crate::gap::{Cost, Gap, Sampler};
use crate::numerics::chebyshev::Table;
use crate::quadrature::panels::{Panel, PanelSet, edge_integrals};
use crate::quadrature::{Integrator, Moments};
use crate::{ContactError, Ends, Interval, Real, Side};

/// The share of the largest slope by which the two may differ, besides the noise.
const ALLOWED: f64 = 1e-6;

/// The share of a cell below which a part of it is not looked at.
const SHORT: f64 = 1e-6;

/// What is assumed of the slope of the gap.
pub(super) trait Assumed<T> {
    /// The slope at x, and the error that it may have.
    fn at(&self, x: T) -> Option<(T, T)>;
}

impl<T: Real> Assumed<T> for PanelSet<T> {
    fn at(&self, x: T) -> Option<(T, T)> {
        self.slope(x).zip(self.truncation_error(x))
    }
}

/// One that keeps no samples assumes nothing.
impl<T: Real> Assumed<T> for &dyn Integrator<T> {
    fn at(&self, x: T) -> Option<(T, T)> {
        self.slope(x).zip(self.doubt(x))
    }
}

/// The panels that the solver has one of several contacts on.
pub(super) struct Solved<'s, T>(pub &'s PanelSet<T>);

impl<T: Real> Assumed<T> for Solved<'_, T> {
    fn at(&self, x: T) -> Option<(T, T)> {
        let (slope, tail) = self.0.at(x)?;
        Some((slope, tail + self.0.tolerance * self.0.size))
    }
}

/// The contact in short cells.
pub(super) struct Cells<T> {
    pub panels: Vec<Panel<T>>,
    /// The least error that the panels of the solver claim.
    pub doubt: T,
    pub cost: Cost,
}

impl<T: Real> Cells<T> {
    pub fn moments(&self, on: Interval<T>) -> Moments<T> {
        edge_integrals(&self.panels, on)
    }
}

/// Compares the slopes assumed on an interval, last those of the solver, with those at eight nodes or
/// more in each cell; where they differ most is what is named.
pub(super) fn compare<T: Real>(
    gap: &Gap<'_, T>,
    assumed: [&dyn Assumed<T>; 2],
    on: Interval<T>,
    spacing: T,
    steepest: T,
) -> Result<Cells<T>, ContactError<T>> {
    let mut cells = PanelSet::new(T::epsilon().sqrt());
    let mut sampler = Sampler::default();
    let (mut panels, mut doubt) = (Vec::new(), None);
    let mut missed: Option<(T, ContactError<T>)> = None;
    let mut left = on.left;
    let mut before: Option<(Interval<T>, usize)> = None;
    // Beyond its last node a cell does not see: the ends are looked at.
    let looks = Ends::from_fn(|end| cells.look_at(gap, end, on[end]));
    while left < on.right {
        let next = left + spacing;
        let right = if next > left { next.min(on.right) } else { on.right };
        let cell = Interval { left, right };
        cells.held = looks;
        cells.sample_anew(gap, cell)?;
        let apart = |last: &Panel<T>| {
            !cells.meets(last, &cells.panels[0], cells.tolerance * steepest)
                && !gap.is_breakpoint(left)
        };
        if let (Some((last, first)), true) = (before, panels.last().is_some_and(apart)) {
            // So it is where two of them do not meet, and both are sampled again.
            cells.held.right = cells.look_at(gap, Side::Right, left);
            cells.sample_anew(gap, last)?;
            panels.truncate(first);
            panels.extend_from_slice(&cells.panels);
            cells.held = Ends { left: cells.look_at(gap, Side::Left, left), ..looks };
            cells.sample_anew(gap, cell)?;
        }
        before = Some((cell, panels.len()));
        panels.extend_from_slice(&cells.panels);
        left = right;
    }
    // Those halved down to a jump end at one of its two sides, by chance.
    let short = T::of(SHORT) * spacing.min(on.right - on.left);
    for cell in panels.iter().filter(|cell| cell.half() > short) {
        let table = Table::of(cell.n);
        for &z in &table.z[..cell.n] {
            let x = cell.x[0] + cell.half() * T::of(1.0 + z);
            for (i, assumed) in assumed.iter().enumerate() {
                let Some((assumed, error)) = assumed.at(x) else { continue };
                if i == 1 {
                    doubt = Some(doubt.map_or(error, |least: T| least.min(error)));
                }
                let allowed = T::of(ALLOWED) * steepest + T::of(16.0) * error;
                let most = missed.as_ref().map_or(allowed, |&(most, _)| allowed.max(most));
                if (cell.value(x) - assumed).abs() <= most {
                    continue;
                }
                // The series of the cell may itself be off.
                let slope = sampler.slope(gap, x)?;
                let off = (slope - assumed).abs();
                if off > most {
                    missed = Some((off, ContactError::FeatureMissed { x, slope, assumed }));
                }
            }
        }
    }
    if let Some((_, error)) = missed {
        return Err(error);
    }
    let cost = cells.cost + sampler.cost;
    Ok(Cells { panels, doubt: doubt.unwrap_or(T::zero()), cost })
}
