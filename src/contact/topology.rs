//! Which intervals the bodies touch in.
//!
//! A contact is sought as one interval first, from where it was, or from the lowest gap. It is then
//! [checked](super::check): nothing pulls inside, nothing overlaps outside. Where the search or a check fails, a
//! coarse [active set](super::active_set) says in how many intervals the bodies touch and about where, and
//! Newton's method finds [all limits](super::several) at once. Without adhesion a contact problem has one
//! solution: what passes the checks is it, whatever the way there.

use super::active_set::{NotFound, Scene, active_set};
use super::check::Check;
use super::edges::{Conditions, Edge};
use super::field::Field;
use super::several::{Newton, Outcome};
use super::{Contact, Found, approach};
use crate::gap::{Cost, FirstLook, Gap, Sampler};
use crate::quadrature::Engine;
use crate::quadrature::panels;
use crate::solution::{Report, Start, Verdict};
use crate::{ContactError, Interval, Real};

/// Sets of contacts tried before the search is given up.
const MOST_TRIALS: usize = 12;

/// The share of a contact, or of the bodies, on which a place that fails a check is looked at more closely.
const CLOSER: f64 = 0.01;

/// What a search needs besides samples, kept from one solve to the next.
#[derive(Clone)]
pub(crate) struct Workspace<T> {
    /// Heights of the bodies, with the number of the gap that they are of.
    look: FirstLook<T>,
    of: Option<u64>,
    newton: Newton<T>,
    fields: Vec<Field<T>>,
    /// The contacts last found.
    last: Vec<Interval<T>>,
    pub report: Report<T>,
}

impl<T: Real> Workspace<T> {
    pub fn new() -> Self {
        Self {
            look: FirstLook::new(),
            of: None,
            newton: Newton::new(),
            fields: Vec::new(),
            last: Vec::new(),
            report: Report::new(),
        }
    }

    /// Forgets the contacts last found.
    pub fn forget(&mut self) {
        self.last.clear();
    }

    /// Keeps the contacts that were found.
    pub fn keep(&mut self, contacts: &[Interval<T>]) {
        self.last.clear();
        self.last.extend_from_slice(contacts);
    }

    /// The hull of the contacts last found.
    pub fn hull(&self) -> Option<Interval<T>> {
        let (first, last) = (self.last.first()?, self.last.last()?);
        Some(Interval { left: first.left, right: last.right })
    }

    /// Looks at the bodies, once for a pair of them.
    fn look_at(&mut self, gap: &Gap<'_, T>, cost: &mut Cost) -> Result<(), ContactError<T>> {
        if self.of != Some(gap.number()) {
            self.of = None;
            self.look.take(gap, cost)?;
            self.of = Some(gap.number());
        }
        Ok(())
    }
}

/// Finds the contacts under a load.
pub(super) fn find<T: Real>(
    contact: &Contact<'_, T>,
    conditions: Conditions<T>,
    engine: &mut dyn Engine<T>,
    workspace: &mut Workspace<T>,
    cost: &mut Cost,
) -> Result<Found<T>, ContactError<T>> {
    let gap = &contact.gap;
    let mut search = Search { contact, conditions, engine, workspace, cost };
    let convex = gap.is_convex();
    let mut fault = None;
    if search.workspace.last.len() <= 1 {
        let start = search.first_start(convex)?;
        match search.one(start) {
            Ok(found) => match search.checked(&found, convex)? {
                None => return Ok(found),
                failed => fault = failed,
            },
            Err(error) if convex || !error.may_be_several() => return Err(error),
            Err(error) => {
                search.workspace.report.add(start.0, Verdict::NotFound);
                fault = Some(error);
            }
        }
    }
    search.several(fault)
}

struct Search<'s, 'b, T: Real> {
    contact: &'s Contact<'b, T>,
    conditions: Conditions<T>,
    engine: &'s mut dyn Engine<T>,
    workspace: &'s mut Workspace<T>,
    cost: &'s mut Cost,
}

impl<T: Real> Search<'_, '_, T> {
    /// Where one contact is sought: where it was, where the user says, or at the lowest gap.
    fn first_start(
        &mut self,
        convex: bool,
    ) -> Result<(Start, Option<Interval<T>>), ContactError<T>> {
        if let Some(&last) = self.workspace.last.first() {
            return Ok((Start::Last, Some(last)));
        }
        if self.contact.start.is_some() {
            return Ok((Start::Given, None));
        }
        if !convex {
            self.workspace.look_at(&self.contact.gap, self.cost)?;
            if !self.workspace.look.bulges() {
                return Ok((Start::LowestGap, None));
            }
        }
        Ok((Start::Middle, None))
    }

    /// Seeks one contact.
    fn one(
        &mut self,
        (start, last): (Start, Option<Interval<T>>),
    ) -> Result<Found<T>, ContactError<T>> {
        let Self { contact, conditions, .. } = *self;
        let at_lowest;
        let contact = if start == Start::LowestGap {
            let around = self.workspace.look.around_lowest(conditions.kappa, conditions.load());
            at_lowest = Contact { start: Some(around), ..contact.clone() };
            &at_lowest
        } else {
            contact
        };
        approach::find(contact, conditions, self.engine, last, self.cost)
    }

    /// What a solution fails by, if anything.
    fn checked(
        &mut self,
        found: &Found<T>,
        convex: bool,
    ) -> Result<Option<ContactError<T>>, ContactError<T>> {
        if let Some(error) = found.lifts_off(&self.conditions) {
            return Err(error);
        }
        if convex {
            return Ok(None);
        }
        let gap = &self.contact.gap;
        if panels::several(self.engine).is_none() {
            self.engine.prepare(gap, found.interval)?;
        }
        self.workspace.look_at(gap, self.cost)?;
        let Workspace { look, fields, .. } = &mut *self.workspace;
        let kappa = self.conditions.kappa;
        let check = Check { gap, engine: &*self.engine, kappa, found };
        let (interval, load) = (found.interval, found.load);
        fields.clear();
        if let Some([x, pressure]) = check.tension(fields)? {
            return Ok(Some(ContactError::Tension { x, pressure, interval, load }));
        }
        if look.bulges() {
            return Ok(None);
        }
        if fields.is_empty() {
            check.fields(fields)?;
        }
        let [left, right] = self.contact.ends();
        let within = |&[x, _]: &[T; 2]| x >= left && x <= right;
        let heights = look.heights().iter().copied().filter(within);
        let overlap = check.overlap(fields, heights, self.cost)?;
        Ok(overlap.map(|[x, gap]| ContactError::Overlap { x, gap, interval, load }))
    }

    /// Seeks any number of contacts; `fault` is what one alone has failed by.
    fn several(
        &mut self,
        mut fault: Option<ContactError<T>>,
    ) -> Result<Found<T>, ContactError<T>> {
        let gap = &self.contact.gap;
        // Engines of the user's, and the paper's, know but one contact.
        if panels::several_mut(self.engine).is_none() {
            return Err(fault.unwrap_or(ContactError::NoBalance {
                half_width: gap.range()[1] - gap.range()[0],
                near: gap.range()[0],
            }));
        }
        self.workspace.look_at(gap, self.cost)?;
        let ends = self.contact.ends();
        let edges = self.conditions.edges;
        let at_corner = edges.map(|edge| matches!(edge, Edge::Fixed(_) | Edge::UpTo(_)));
        let last = &self.workspace.last;
        let mut start = if last.len() > 1 { Start::Last } else { Start::ActiveSet };
        self.workspace.newton.on.clone_from(last);
        for _ in 0..MOST_TRIALS {
            if start == Start::ActiveSet {
                self.active_set(fault.as_ref())?;
            }
            let on = &mut self.workspace.newton.on;
            let hull = Interval { left: on[0].left, right: on[on.len() - 1].right };
            let corners = [
                at_corner[0] && (hull.left <= ends[0] || matches!(edges[0], Edge::Fixed(_))),
                at_corner[1] && (hull.right >= ends[1] || matches!(edges[1], Edge::Fixed(_))),
            ];
            let count = on.len();
            let found = match self.settle(corners, ends) {
                Ok(found) => found,
                Err(error) if error.may_be_several() => {
                    self.workspace.report.add(start, Verdict::NotFound);
                    (start, fault) = (Start::ActiveSet, Some(error));
                    continue;
                }
                Err(error) => return Err(error),
            };
            match found {
                Ok(found) => match self.checked(&found, false)? {
                    None => {
                        self.workspace.report.add(start, Verdict::Passed);
                        return Ok(found);
                    }
                    Some(error) => {
                        self.workspace.report.add(start, Verdict::of(&error));
                        (start, fault) = (Start::ActiveSet, Some(error));
                    }
                },
                Err(outcome) => {
                    let on = &mut self.workspace.newton.on;
                    let verdict = match outcome {
                        Outcome::Closed(i) if count > 1 => {
                            let next = on.remove(i + 1);
                            on[i].right = next.right;
                            Verdict::Merged
                        }
                        Outcome::Lost(i) if count > 1 => {
                            on.remove(i);
                            Verdict::Lost
                        }
                        Outcome::Beyond(side) if at_corner[side] => {
                            let last = on.len() - 1;
                            if side == 0 {
                                on[0].left = ends[0];
                            } else {
                                on[last].right = ends[1];
                            }
                            Verdict::ReachedCorner
                        }
                        _ => Verdict::NotFound,
                    };
                    self.workspace.report.add(start, verdict);
                    start = if verdict == Verdict::NotFound {
                        Start::ActiveSet
                    } else {
                        Start::Contacts
                    };
                }
            }
        }
        Err(fault.unwrap_or(ContactError::NoBalance {
            half_width: gap.range()[1] - gap.range()[0],
            near: gap.range()[0],
        }))
    }

    /// Moves the contacts at hand to where they bear the load.
    fn settle(
        &mut self,
        corners: [bool; 2],
        ends: [T; 2],
    ) -> Result<Result<Found<T>, Outcome>, ContactError<T>> {
        let Self { contact, conditions, .. } = *self;
        let newton = &mut self.workspace.newton;
        if let [on] = newton.on[..] {
            let around = Contact { start: Some(on), ..contact.clone() };
            return approach::find(&around, conditions, self.engine, Some(on), self.cost).map(Ok);
        }
        for (side, corner) in corners.into_iter().enumerate() {
            let last = newton.on.len() - 1;
            match side {
                0 if corner => newton.on[0].left = ends[0],
                1 if corner => newton.on[last].right = ends[1],
                _ => {}
            }
        }
        let Some(several) = panels::several_mut(self.engine) else { return Ok(Err(Outcome::Failed)) };
        let load = conditions.load();
        let outcome = newton.settle(several, &contact.gap, load / conditions.kappa, corners, ends)?;
        if outcome != Outcome::Found {
            return Ok(Err(outcome));
        }
        let strengths = [false, true].map(|right| conditions.kappa * several.strength(right));
        // A corner that pulls does not hold the contact.
        for (side, edge) in conditions.edges.iter().enumerate() {
            if corners[side] && strengths[side] < T::zero() && matches!(edge, Edge::UpTo(_)) {
                let last = newton.on.len() - 1;
                let inward = T::of(CLOSER) * newton.on[if side == 0 { 0 } else { last }].half_width();
                match side {
                    0 => newton.on[0].left += inward,
                    _ => newton.on[last].right -= inward,
                }
                let corners = if side == 0 { [false, corners[1]] } else { [corners[0], false] };
                return self.settle(corners, ends);
            }
        }
        let on = &newton.on;
        let interval = Interval { left: on[0].left, right: on[on.len() - 1].right };
        let error = newton.errors.iter().fold(T::zero(), |max, &error| max.max(error));
        Ok(Ok(Found {
            interval,
            load,
            strengths,
            free: corners.map(|corner| !corner),
            adhesive: [false; 2],
            error: Some(error),
            force: None,
            trend: None,
            ends,
        }))
    }

    /// Takes the contacts from a coarse active set, with a closer look where a check has failed.
    fn active_set(&mut self, fault: Option<&ContactError<T>>) -> Result<(), ContactError<T>> {
        let Workspace { look, newton, .. } = &mut *self.workspace;
        let (gap, range) = (&self.contact.gap, self.contact.ends());
        let Conditions { kappa, .. } = self.conditions;
        let load = self.conditions.load();
        let share = T::of(CLOSER);
        let mut seeds = std::mem::take(&mut newton.on);
        match fault {
            Some(&ContactError::Tension { x, .. }) => {
                if let Some(i) = seeds.iter().position(|on| on.contains(x)) {
                    let on = seeds[i];
                    let aside = share * on.half_width();
                    let [from, to] = [(x - aside).max(on.left), (x + aside).min(on.right)];
                    seeds[i].right = from;
                    seeds.insert(i + 1, Interval { left: to, right: on.right });
                    seeds.retain(|on| on.left < on.right);
                }
            }
            Some(&ContactError::Overlap { x, .. }) => {
                let aside = share * share * (range[1] - range[0]);
                let at = seeds.partition_point(|on| on.right < x);
                let left = if at == 0 { range[0] } else { seeds[at - 1].right };
                let right = seeds.get(at).map_or(range[1], |next| next.left);
                let half = T::of(0.5);
                let seed = Interval {
                    left: (x - aside).max(half * (x + left)),
                    right: (x + aside).min(half * (x + right)),
                };
                seeds.insert(at, seed);
            }
            _ => seeds.clear(),
        }
        let scene = Scene { kappa, load, range, known: look.heights(), start: &seeds };
        let mut sampler = Sampler::default();
        let coarse = active_set(&scene, &mut |x| sampler.height(gap, x));
        self.cost.heights += sampler.cost.evaluations;
        match coarse {
            Ok(coarse) => {
                newton.on = coarse.intervals;
                Ok(())
            }
            Err(NotFound::Height(error)) => Err(error),
            Err(_) => Err(ContactError::NoBalance {
                half_width: T::of(0.5) * (range[1] - range[0]),
                near: look.lowest(),
            }),
        }
    }
}
