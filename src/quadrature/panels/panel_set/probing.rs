//! Slopes between the nodes of a panel, where a feature shows that is too narrow for them.
//!
//! A Gaussian bump of a full width w at half its height has at a distance d from its top a share
//! `exp(-2.77 (d/w)²)` of it. A panel of a smooth body takes eight nodes, a fifth of the contact apart: a bump between two of them
//! may be felt by none. Slopes there contradict the series.

use super::PanelSet;
use crate::gap::{Cost, Gap, NARROWEST, sample_near};
use crate::numerics::chebyshev::{Table, by_size};
use crate::quadrature::panels::Panel;
use crate::quadrature::panels::interpolation::at_nodes;
use crate::{Body, ContactError, Interval, Real};

/// The distance of places in a contact, in widths of the narrowest feature to be seen: at three of them from its top the
/// slope of a bump that moves the peak by 1 % is 1e-12 of that of the gap, and panels are more exact.
const BETWEEN: f64 = 6.0;

/// Times that panels which miss a feature are sampled anew.
pub(crate) const MOST_MISSED: usize = 8;

/// Times the uncertainty of a panel by which a slope may miss it.
const MISSED: f64 = 32.0;

/// The share of the distance to the nearest node by which a point may miss its place.
const NEAR: f64 = 0.1;

/// The most points for one node of a panel, however long that is beside a contact.
const MOST_PARTS: usize = 1 << 10;

impl<T: Real> PanelSet<T> {
    /// Asks for slopes between the nodes of the panels of a contact where a narrow feature has room, and covers the span
    /// anew where a panel misses one; tells whether any does.
    ///
    /// # Errors
    /// Those of sampling the bodies.
    pub fn probe(&mut self, gap: &Gap<'_, T>, on: Interval<T>) -> Result<bool, ContactError<T>> {
        let apart = T::of(2.0 * BETWEEN * NARROWEST) * on.half_width();
        let (tilt, before) = (self.tilt, self.cost);
        self.turn(T::zero());
        let mut cuts = Vec::new();
        for i in 0..self.panels.len() {
            let panel = self.panels[i];
            let is_touched = panel.x[0] < on.right && panel.x[1] > on.left;
            if is_touched && panel.apart > apart {
                match self.missed_between(gap, &panel, on, apart)? {
                    Some(x) => cuts.push(x),
                    None => self.panels[i].apart = apart,
                }
            }
        }
        // They are checks, as heights are.
        let Cost { samples, evaluations, .. } = before;
        self.cost.heights += self.cost.evaluations - evaluations;
        (self.cost.samples, self.cost.evaluations) = (samples, evaluations);
        if !cuts.is_empty() {
            self.cut(gap, &cuts)?;
        }
        self.turn(tilt);
        Ok(!cuts.is_empty())
    }

    /// Covers the same span anew, by panels that end at some places: next to them nodes are closest.
    fn cut(&mut self, gap: &Gap<'_, T>, cuts: &[T]) -> Result<(), ContactError<T>> {
        let Some(have) = self.interval() else { return Ok(()) };
        self.clear(true);
        self.initial = super::LEAST;
        let mut left = have.left;
        for &right in cuts.iter().chain([&have.right]) {
            self.sample(gap, Interval { left, right }, 0, None)?;
            left = right;
        }
        self.at_first = self.panels.len();
        Ok(())
    }

    /// Returns a place in a contact where a panel misses the slope of the gap, of places no further apart, with its
    /// nodes, than a distance.
    fn missed_between(
        &mut self,
        gap: &Gap<'_, T>,
        panel: &Panel<T>,
        on: Interval<T>,
        apart: T,
    ) -> Result<Option<T>, ContactError<T>> {
        let spacing = T::pi() * panel.half() / T::count(panel.n);
        let mut parts = 1;
        while T::count(parts) * apart < spacing && parts < MOST_PARTS {
            parts += 1;
        }
        for part in 1..parts {
            gap.check_budget(self.cost, 1, 0, on)?;
            let share = part as f64 / parts as f64;
            let missed = by_size!(panel.n, N => self.missed_at::<N>(gap, panel, on, share))?;
            if missed.is_some() {
                return Ok(missed);
            }
        }
        Ok(None)
    }

    /// Looks at a share of the way from each node to the next.
    fn missed_at<const N: usize>(
        &mut self,
        gap: &Gap<'_, T>,
        panel: &Panel<T>,
        on: Interval<T>,
        share: f64,
    ) -> Result<Option<T>, ContactError<T>> {
        let (reach, table) = (panel.half(), Table::of(N));
        let offsets: [T; N] = std::array::from_fn(|i| {
            // From the last node only half as far to the end.
            let on = if i + 1 < N { share } else { 0.5 * share };
            let angle = std::f64::consts::PI * (i as f64 + 0.5 + on) / N as f64;
            reach * T::of(-angle.cos())
        });
        let centre = T::of(0.5) * panel.x[0] + T::of(0.5) * panel.x[1];
        let places = offsets.map(|offset| centre + offset);
        let room = std::array::from_fn(|i| T::of(NEAR * table.spacing[i]) * reach);
        for (body, trace) in [Body::Lower, Body::Upper].into_iter().zip(&mut self.traces) {
            sample_near(gap, body, &places, &room, trace, &mut self.cost)?;
        }
        let wanted = offsets.map(|offset| reach + offset);
        let [lower, upper] = [0, 1].map(|i| at_nodes(&wanted, &self.traces[i], panel.x[0], reach));
        let size = |i: usize| lower[i].abs() + upper[i].abs();
        let steepest = (0..N).fold(T::zero(), |most, i| most.max(size(i)));
        let least = (self.tolerance * self.size).max(T::epsilon() * steepest);
        let allowed = T::of(MISSED) * panel.tail.max(least);
        let is_missed = |&i: &usize| {
            let missed = (panel.value(places[i]) - (upper[i] - lower[i])).abs();
            on.contains(places[i]) && missed > allowed
        };
        Ok((0..N).find(is_missed).map(|i| places[i]))
    }
}
