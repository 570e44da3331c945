//! Whether the panels of the contact have missed anything.
//!
//! Panels are as long as the coefficients of their series allow, and what lies between two nodes shows
//! in none of them. So the contact is sampled a second time, in cells as short as those outside it, and
//! the two are compared.

use crate::gap::{Cost, Gap, Sampler};
use crate::quadrature::panels::Cover;
use crate::quadrature::panels::chebyshev::Table;
use crate::{ContactError, Interval, Real};

/// The share of the largest slope by which the two may differ, besides the noise.
const ALLOWED: f64 = 1e-6;

/// The share of a cell below which a part of it is not looked at.
const SHORT: f64 = 1e-6;

/// Compares the slopes of the panels on an interval with those at eight nodes or more in each cell.
pub(super) fn compare<T: Real>(
    gap: &Gap<'_, T>,
    panels: &Cover<T>,
    on: Interval<T>,
    spacing: T,
    steepest: T,
) -> Result<Cost, ContactError<T>> {
    // Loose: it is the values at the nodes that count.
    let mut cells = Cover::new(T::of(1e-3));
    let mut sampler = Sampler::default();
    let mut left = on.left;
    while left < on.right {
        let next = left + spacing;
        let right = if next > left { next.min(on.right) } else { on.right };
        cells.sample_anew(gap, Interval { left, right })?;
        // Those halved down to a jump end at one of its two sides, by chance.
        let short = T::of(SHORT) * (right - left);
        for cell in cells.panels.iter().filter(|cell| cell.half() > short) {
            let table = Table::of(cell.n);
            for &z in &table.z[..cell.n] {
                let x = cell.x[0] + cell.half() * T::of(1.0 + z);
                let Some((assumed, tail)) = panels.slope(x).zip(panels.tail(x)) else { continue };
                let allowed = T::of(ALLOWED) * steepest + T::of(16.0) * tail;
                if (cell.value(x) - assumed).abs() <= allowed {
                    continue;
                }
                // The series of the cell may itself be off.
                let slope = sampler.slope(gap, x)?;
                if (slope - assumed).abs() > allowed {
                    return Err(ContactError::Missed { x, slope, assumed });
                }
            }
        }
        left = right;
    }
    Ok(cells.cost + sampler.cost)
}
