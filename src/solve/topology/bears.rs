//! The load that the bodies bear in several contacts, where they end under less than what is asked for.

use super::super::active_set::FIRST_CELLS;
use super::super::capacity::Capacity;
use super::super::edges::{Conditions, Given};
use super::Search;
use crate::quadrature::{LoadCase, panels};
use crate::solution::{ContactState, largest_pressure};
use crate::{Ends, Real, Side};

/// How closely the load under which cells reach an end of the bodies is enclosed.
const NEAR: f64 = 1.25;

/// The first of the shares of a load, each the square of the one before, among which one is sought that reaches no
/// end of the bodies; and how many.
const LESS: f64 = 0.25;
const MOST_SHARES: usize = 6;

impl<T: Real> Search<'_, '_, '_, T> {
    /// What the bodies bear, where that is less than a load under which cells reach an end of them: the load
    /// grows with the contacts, so there is one under which the outermost limit is at an end.
    pub(super) fn bears(&mut self, conditions: &Conditions<T>, end: Side) -> Option<Capacity<T>> {
        let (load, end) = self.end_reached_by(conditions, end)?;
        let conditions = Conditions { given: Given::Load(load), ..*conditions };
        let mut search = Search::new(self.contact, conditions, &mut *self.work);
        search.end = Some(end);
        let ContactState { interval: on, load, free, .. } = search.several(None).ok()?;
        let ends = self.contact.ends();
        let room = Ends { left: on.left - ends.left, right: ends.right - on.right };
        let side = if room.right < room.left { Side::Right } else { Side::Left };
        // A single contact as wide as the widest in balance may be another one.
        if room[side] > T::epsilon().sqrt() * on.half_width() {
            return None;
        }
        let (integrator, gap) = (&*self.work.integrator, &self.contact.gap);
        let one = [on];
        let contacts = panels::several(integrator).map_or(&one[..], |several| several.contacts());
        let load_case = LoadCase { kappa: conditions.kappa, load, free };
        let mut highest = if free == Ends::both(true) { T::zero() } else { T::one() / T::zero() };
        for contact in contacts.iter().copied().enumerate() {
            highest = highest.max(
                largest_pressure(integrator, gap, &load_case, contact, self.work.cost)
                    .ok()?
                    .1
                    .value,
            );
        }
        Some(Capacity { on, end: ends[side], load, peak: highest })
    }

    /// A load, and the end of the bodies that cells reach under it: not much less does not.
    fn end_reached_by(&mut self, conditions: &Conditions<T>, end: Side) -> Option<(T, Side)> {
        let mut end_reached = |load: T| {
            let given = Given::Load(load);
            let coarse = self.coarse(&Conditions { given, ..*conditions }, FIRST_CELLS).ok()?;
            Some(self.end_reached(&coarse))
        };
        let mut high = (conditions.load(), end);
        let (mut low, mut share) = (None, T::of(LESS));
        for _ in 0..MOST_SHARES {
            let load = share * conditions.load();
            match end_reached(load)? {
                Some(end) => high = (load, end),
                None => {
                    low = Some(load);
                    break;
                }
            }
            share *= share;
        }
        let mut low = low?;
        while high.0 > T::of(NEAR) * low {
            let load = low.sqrt() * high.0.sqrt();
            match end_reached(load)? {
                Some(end) => high = (load, end),
                None => low = load,
            }
        }
        Some(high)
    }
}
