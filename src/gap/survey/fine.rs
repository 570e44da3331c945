//! A survey as a certificate takes it: no cell of its grid without points of its own, and no step of the heights.

use super::body::Rise;
use super::{Node, Survey, is_in};
use crate::gap::{Cost, Gap};
use crate::{Body as Which, ContactError, Real};

/// Rounds of cuts: the first by what a coarse panel says of X(k), others where that was wrong.
const MOST_CUTS: usize = 60;

/// The share of a cell by which a panel may miss its ends.
const ROOM: f64 = 0.1;

impl<T: Real> Survey<T> {
    /// Returns all points of either body, by rising x.
    pub fn nodes(&self) -> &[Node<T>] {
        &self.nodes
    }

    /// Cuts the panels of both bodies so that each cell of a grid has its own, and samples those in some spans.
    ///
    /// # Errors
    /// As [`take`](Self::take).
    pub fn cut(
        &mut self,
        gap: &Gap<'_, T>,
        grid: &[T],
        spans: &[[T; 2]],
        cost: &mut Cost,
    ) -> Result<(), ContactError<T>> {
        let beside = |i: usize| {
            let before = i.checked_sub(1).map(|before| grid[i] - grid[before]);
            let after = grid.get(i + 1).map(|&after| after - grid[i]);
            before.into_iter().chain(after).fold(T::one() / T::zero(), T::min)
        };
        let place = |(i, &x): (usize, &T)| [x, T::of(ROOM) * beside(i)];
        let places: Vec<[T; 2]> = grid.iter().enumerate().map(place).collect();
        for which in [Which::Lower, Which::Upper] {
            let (surface, body) = (&gap.bodies[which as usize], &mut self.bodies[which as usize]);
            for _ in 0..MOST_CUTS {
                let found = body.cut(surface, self.range, [&places, spans], &mut cost.heights);
                let changes =
                    found.map_err(|source| ContactError::Profile { body: which, source })?;
                if !changes {
                    break;
                }
            }
        }
        self.join();
        Ok(())
    }

    /// Refines both bodies in some spans until their heights are uncertain by no more than a tolerance, or by what
    /// finer panels do not better. Returns a place where that takes more than a number of evaluations.
    ///
    /// # Errors
    /// As [`take`](Self::take).
    pub fn settle(
        &mut self,
        gap: &Gap<'_, T>,
        spans: &[[T; 2]],
        tolerance: T,
        most: usize,
        cost: &mut Cost,
    ) -> Result<Option<T>, ContactError<T>> {
        let half = T::of(0.5) * tolerance;
        while cost.heights + self.cost_at(gap, spans, Some(half)) <= most {
            if !self.refine_at(gap, spans, Some(tolerance), cost)? {
                return Ok(None);
            }
        }
        let panels = self.bodies.iter().flat_map(|body| &body.panels);
        let mut open = panels.filter(|panel| is_in(spans, panel) && panel.may_gain(half));
        Ok(open.next().map(|panel| panel.x()[0]))
    }

    /// Returns the rises of the gap between neighbouring points in some spans, each by heights and by slopes.
    pub fn rises(&self, spans: &[[T; 2]]) -> impl Iterator<Item = Rise<T>> {
        let sign = |which: usize| if which == Which::Lower as usize { -T::one() } else { T::one() };
        let both = self.bodies.iter().enumerate();
        let all = both.flat_map(move |(which, body)| {
            body.rises(spans).map(move |rise| rise.times(sign(which)))
        });
        all.filter(|rise| is_within(spans, rise.between))
    }
}

/// Tells whether a stretch lies in one of some spans, in rising order.
fn is_within<T: Real>(spans: &[[T; 2]], [from, to]: [T; 2]) -> bool {
    let first = spans.partition_point(|span| span[1] < to);
    spans.get(first).is_some_and(|span| span[0] <= from)
}
