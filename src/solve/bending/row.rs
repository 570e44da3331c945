//! Rows of contacts, one in each period: where a period is cut, and the start.
//!
//! The kernel of a row is singular where a contact of the next period begins. So the period is cut
//! in the widest gap, and the search begins with the load spread evenly over all of it: then the
//! first contacts are about as many as the last ones.

use super::{Bending, Spread, load};
use crate::kernel::{Kernel, loads, punch};
use crate::numerics::ascending;
use crate::{ContactError, Fallible, Interval, Real, SolveError};

/// Least distance of the cut from the contacts, by the widest gap; and least width of a gap in
/// which a contact may be born, by the period.
const SHORT: f64 = 0.2;

/// Least width of the widest gap that is solved, by the half-width of the widest contact.
const LEAST_GAP: f64 = 0.04;

/// Share of the period that the first pressures leave free.
const FREE: f64 = 0.1;

impl<T: Real> Bending<'_, '_, '_, T> {
    /// Returns the pressures to begin with: none for half-planes.
    pub(super) fn begin(&self) -> Vec<Spread<T>> {
        let (Some(row), Some(load)) = (&self.kernel.row, load(self.control)) else {
            return Vec::new();
        };
        let ([left, right], free) = (self.gap.range(), T::of(0.5 * FREE) * row.period);
        let on = Interval { left: left + free, right: right - free };
        let mut kernel = self.kernel.clone();
        kernel.in_range([left, right], on);
        let spreads = punch(&kernel, &[on], true).unwrap_or_default();
        spreads.iter().map(|spread| spread.times(load)).collect()
    }

    /// Cuts the period in the widest gap, where the bodies under load are furthest apart, unless
    /// the present cut is about as far from the contacts, and none is born there.
    pub(super) fn cut(&mut self, is_born: bool) -> Fallible<T, ()> {
        let Some(period) = self.kernel.row.as_ref().map(|row| row.period) else { return Ok(()) };
        let contacts = merged(&self.spreads);
        let (Some(first), Some(last)) = (contacts.first(), contacts.last()) else { return Ok(()) };
        let [left, right] = self.gap.range();
        let at_cut = (first.left - left).min(right - last.right);
        let [from, to] = widest_gap(&contacts, period);
        // In a narrow gap nothing is born: the period is about to be filled.
        let is_wide = to - from > T::of(SHORT) * period;
        if at_cut >= T::of(SHORT) * (to - from) && !(is_born && is_wide) {
            return Ok(());
        }
        let (quarter, kappa) = (T::of(0.25) * (to - from), self.contact.kappa);
        let loads = loads(self.kernel.distance(), &self.spreads);
        let drawn = |x: T| {
            let regular = self.kernel.sums([1], x, &loads)[0];
            loads.iter().fold(regular, |sum, &[s, load]| sum + load * (x - s).abs().ln()) / kappa
        };
        self.gap =
            self.gap.cut_at_highest([from + quarter, to - quarter], drawn, self.work.cost)?;
        let gap = &self.gap;
        for spreads in [&mut self.spreads, &mut self.from, &mut self.target] {
            for Spread { on, .. } in spreads {
                let shift = gap.folded(on.centre()) - on.centre();
                *on = Interval { left: on.left + shift, right: on.right + shift };
            }
        }
        // Pressures over the cut cannot be mixed with those beside it: the step begins from none.
        let [left, right] = gap.range();
        if self.from.iter().any(|spread| spread.on.left <= left || spread.on.right >= right) {
            self.from.clear();
        }
        self.work.workspace.keep(&merged(&self.spreads));
        Ok(())
    }

    /// Tells the kernel how far the next period is, after a check that some gap is wide enough.
    pub(super) fn look_beside(&mut self, contacts: &[Interval<T>]) -> Fallible<T, ()> {
        let Some(period) = self.kernel.row.as_ref().map(|row| row.period) else { return Ok(()) };
        let (Some(first), Some(last)) = (contacts.first(), contacts.last()) else { return Ok(()) };
        let on = Interval { left: first.left, right: last.right };
        self.kernel.in_range(self.gap.range(), on);
        let largest = contacts.iter().fold(T::zero(), |most, on| most.max(on.half_width()));
        let [from, to] = widest_gap(contacts, period);
        match to - from < T::of(LEAST_GAP) * largest {
            true => Err(self.complete()?),
            false => Ok(()),
        }
    }

    /// Tells whether an error means that the contacts fill the period.
    pub(super) fn fills(&self, error: &ContactError<T>) -> bool {
        use SolveError::{CompleteContact, DomainTooShort};
        let is_wide =
            matches!(error, ContactError::Solve(CompleteContact { .. } | DomainTooShort { .. }));
        self.kernel.row.is_some() && is_wide
    }

    /// Returns the error for bodies that touch all over a period.
    pub(super) fn complete(&mut self) -> Fallible<T, ContactError<T>> {
        let compliance = |omega: T| self.kernel.compliance(omega);
        let kappa = self.contact.kappa;
        let complete = self.gap.complete_load(kappa, compliance, self.work.cost)?;
        let load = load(self.control).unwrap_or(complete);
        Ok(SolveError::CompleteContact { load, complete }.into())
    }
}

/// Tells whether a contact of this half-width fills the period of a row.
pub(super) fn fills<T: Real>(kernel: &Kernel<'_, T>, half_width: T) -> bool {
    kernel.row.as_ref().is_some_and(|row| half_width + half_width >= row.period)
}

/// Returns the widest gap between some contacts, or between the last one and the next period.
fn widest_gap<T: Real>(contacts: &[Interval<T>], period: T) -> [T; 2] {
    let last = contacts.len() - 1;
    let around = [contacts[last].right, contacts[0].left + period];
    let gaps = contacts.windows(2).map(|pair| [pair[0].right, pair[1].left]);
    let wider =
        |one: [T; 2], gap: [T; 2]| if gap[1] - gap[0] > one[1] - one[0] { gap } else { one };
    gaps.fold(around, wider)
}

/// Returns the interval of some pressures, from the first to the last.
pub(super) fn hull<T: Real>(spreads: &[Spread<T>]) -> Option<Interval<T>> {
    let contacts = merged(spreads);
    let [first, last] = [contacts.first()?, contacts.last()?];
    Some(Interval { left: first.left, right: last.right })
}

/// Lists the intervals of pressures from left to right; those before and after a step overlap.
pub(super) fn merged<T: Real>(spreads: &[Spread<T>]) -> Vec<Interval<T>> {
    let mut ends: Vec<Interval<T>> = spreads.iter().map(|spread| spread.on).collect();
    ends.sort_by(|one, other| ascending(&one.left, &other.left));
    ends.dedup_by(|next, last| {
        let is_one = next.left <= last.right;
        last.right = if is_one { last.right.max(next.right) } else { last.right };
        is_one
    });
    ends
}
