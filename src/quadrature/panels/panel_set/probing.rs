//! Slopes between the nodes of a panel, where a feature shows that is too narrow for the nodes.
//!
//! At a distance d from its top, a Gaussian bump of full width w at half height has the share
//! `exp(-2.77 (d/w)²)` of its height. A panel of a smooth body takes eight nodes, a fifth of the
//! contact apart: a bump between two of them may show at neither. Slopes there contradict the
//! series.

use super::PanelSet;
use crate::gap::Gap;
use crate::numerics::chebyshev::{Table, by_size, primitive, values};
use crate::quadrature::panels::Panel;
use crate::{ContactError, Fallible, Interval, Real};

/// Default distance between probed places in a contact, in widths of the narrowest feature to be
/// seen. Three widths from the top of a bump that moves the peak by 1 %, its slope is 1e-12 of the
/// slope of the gap, and panels are more exact.
const SPACING: f64 = 6.0;

/// Allowed error of a panel at a probed place, in units of the panel's uncertainty.
const MAX_PROBE_ERROR: f64 = 32.0;

/// Largest offset of a point from its place, as a share of the distance to the nearest node, and of
/// the distance between places.
const OFF_NODE: f64 = 0.1;
const OFF_PLACE: f64 = 0.25;

/// Most points per node of a panel by default, however long the panel is outside the contact.
const MAX_A_NODE: usize = 1 << 10;

impl<T: Real> PanelSet<T> {
    /// Samples slopes between the nodes of the panels of a contact where a narrow feature has room,
    /// and samples anew the panels that miss one, until none does. Tells whether any did.
    ///
    /// # Errors
    /// Those of sampling the bodies.
    pub fn probe(&mut self, gap: &Gap<'_, T>, on: Interval<T>) -> Result<bool, ContactError<T>> {
        let apart = gap.spacing(on.half_width(), SPACING);
        let mut is_missed = false;
        self.take_off();
        loop {
            let (before, mut missed) = (self.cost, Vec::new());
            for i in 0..self.panels.len() {
                let panel = self.panels[i];
                if panel.x[0] < on.right && panel.x[1] > on.left && panel.apart > apart {
                    missed.extend(self.missed_between(gap, &panel, on, apart)?.map(|x| (i, x)));
                    self.panels[i].apart = apart;
                }
            }
            // Probes are checks, and are counted with the heights.
            self.cost.heights += self.cost.evaluations - before.evaluations;
            (self.cost.samples, self.cost.evaluations) = (before.samples, before.evaluations);
            if missed.is_empty() {
                self.add(gap);
                return Ok(is_missed);
            }
            is_missed = true;
            // From the right, so that the numbers of panels on the left stay.
            for &(i, x) in missed.iter().rev() {
                self.cut(gap, i, x, apart)?;
            }
        }
    }

    /// Samples the span of a panel anew, by panels that end at and around `x`: nodes are closest
    /// next to the ends.
    fn cut(&mut self, gap: &Gap<'_, T>, i: usize, x: T, apart: T) -> Fallible<T, ()> {
        let after = self.panels.split_off(i + 1);
        let Some(panel) = self.panels.pop() else { return Ok(()) };
        let [mut left, end] = panel.x;
        let neighbour = after.first().copied().filter(|_| !gap.is_breakpoint(end));
        let mut known = i - usize::from(i > 0 && !gap.is_breakpoint(left));
        let room = T::of(OFF_PLACE) * apart;
        let has_room = |x: &T| *x > panel.x[0] + room && *x < end - room;
        self.initial = super::MIN_NODES;
        for right in [x - apart, x, x + apart].into_iter().filter(has_room) {
            self.sample(gap, Interval { left, right }, known, None)?;
            (left, known) = (right, self.panels.len() - 1);
        }
        self.sample(gap, Interval { left, right: end }, known, neighbour)?;
        self.panels.extend_from_slice(&after[usize::from(neighbour.is_some())..]);
        self.at_first = self.panels.len();
        Ok(())
    }

    /// Returns a place in a contact where a panel misses the slope of the gap. Places and nodes are
    /// no further than `apart` from each other.
    fn missed_between(
        &mut self,
        gap: &Gap<'_, T>,
        panel: &Panel<T>,
        on: Interval<T>,
        apart: T,
    ) -> Fallible<T, Option<T>> {
        let spacing = T::pi() * panel.half() / T::count(panel.n);
        let parts = gap.parts(spacing, apart, MAX_A_NODE);
        for part in 1..parts {
            gap.check_budget(self.spent + self.cost, 1, 0, on)?;
            let missed =
                by_size!(panel.n, N => self.missed_at::<N>(gap, panel, apart, [part, parts]))?;
            if missed.is_some() {
                return Ok(missed);
            }
        }
        Ok(None)
    }

    /// Probes each interval between nodes, at `part` of `parts` of the way, and an end, for the
    /// place where the panel is furthest off.
    fn missed_at<const N: usize>(
        &mut self,
        gap: &Gap<'_, T>,
        panel: &Panel<T>,
        apart: T,
        [part, parts]: [usize; 2],
    ) -> Fallible<T, Option<T>> {
        let (share, reach, table) = (part as f64 / parts as f64, panel.half(), Table::of(N));
        // One point between two nodes is as close as the end is without any.
        let most = N as f64 - if parts > 2 { 0.0 } else { 0.25 };
        let offsets: [T; N] = std::array::from_fn(|i| {
            // From each node to the next, and from both outermost nodes outward.
            let at = (i as f64 + 1.0 - (1.5 - share).fract()).min(most);
            reach * T::of(-(std::f64::consts::PI * at / N as f64).cos())
        });
        let centre = T::of(0.5) * panel.x[0] + T::of(0.5) * panel.x[1];
        let places = offsets.map(|offset| centre + offset);
        let most = T::of(OFF_PLACE) * apart;
        let room = std::array::from_fn(|i| (T::of(OFF_NODE * table.spacing[i]) * reach).min(most));
        let [lower, upper] = self.slopes_at(gap, panel.x, &offsets, &places, &[room; 2])?;
        let steepest = (0..N).fold(T::zero(), |most, i| most.max(lower[i].abs() + upper[i].abs()));
        let least = (self.tolerance * self.size).max(T::epsilon() * steepest);
        // Both the place and the nodes are rounded.
        let allowed = T::of(MAX_PROBE_ERROR) * panel.error.max(least) + T::of(2.0) * panel.noise;
        // A sample inside a feature disturbs the others of its batch, but less.
        let off = |i: usize| (panel.value(places[i]) - (upper[i] - lower[i])).abs();
        // Also outside the contact: a limit may leave little of a feature inside.
        let missed = (0..N).filter(|&i| off(i) > allowed);
        let worst = missed.reduce(|one, other| if off(other) > off(one) { other } else { one });
        if worst.is_some() {
            return Ok(worst.map(|i| places[i]));
        }
        // A groove between two nodes may have walls that no place meets; then its heights show it.
        let at = places.map(|x| panel.local(x));
        let rises = values(&primitive(panel.coefficients())[..=panel.length], &at);
        let rises = rises.map(|rise| reach * rise);
        let mut near = self.heights_near(places);
        // Of a body that knows its slopes the rise is between those by the slope at either place.
        let known = [lower.map(|slope| -slope), upper];
        for (slopes, _) in known.iter().zip(&self.traces).filter(|(_, cache)| cache.direct) {
            let mut height = T::zero();
            for i in 1..N {
                let half = T::of(0.5) * (places[i] - places[i - 1]);
                height += half * (slopes[i - 1] + slopes[i]);
                near[i].height += height;
                near[i].doubt += half * (slopes[i] - slopes[i - 1]).abs();
            }
        }
        let share = T::epsilon().cbrt() * steepest + T::of(16.0) * panel.error;
        let found = self.contradiction(&near, &rises, share);
        Ok(found.map(|(i, _)| places[i]))
    }
}
