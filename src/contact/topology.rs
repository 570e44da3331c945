//! Which intervals the bodies touch in.
//!
//! A contact is sought as one interval first, from where it was, or from the lowest gap. It is then
//! [checked](super::signorini_check): corners press, nothing pulls inside, nothing overlaps
//! outside. Where the search or a check fails, a coarse [active set](super::active_set) says in how
//! many intervals the bodies touch and about where, and Newton's method finds [all
//! limits](super::newton_several) at once; and where that leads to an end of the bodies, the load
//! under which a limit just comes there. Without adhesion a contact problem has one solution: what
//! passes the checks is it, whatever the way there.

use super::Contact;
use super::active_set::{Coarse, FIRST_CELLS, NotFound, Scene, active_set};
use super::capacity::{Capacity, capacity};
use super::edges::{Conditions, Edge, Given};
use super::exterior_field::ExteriorField;
use super::newton_several::{Besides, NewtonSeveral, SeveralOutcome};
use super::signorini_check::{
    Overlaps, Passed, SignoriniCheck, TensionSpans, Under, step_of_heights,
};
use super::single_contact::Single;
use crate::gap::{Asked, Cost, Gap, Survey};
use crate::quadrature::panels::Several;
use crate::quadrature::{Integrator, LoadCase, Panels, Quadrature, panels};
use crate::solution::{ContactState, largest_pressure};
use crate::solution::{Outcome, Report, Start};
use crate::{ContactError, Ends, Interval, Real, Side};

/// The shares of F/κ by which heights may be uncertain where the bodies may touch: to start from, and to tell by them
/// alone where they do.
const ROUGHLY: f64 = 0.25;
const CLOSELY: f64 = 0.002;

/// Sets of contacts tried before the search is given up.
const MOST_TRIALS: usize = 12;

/// The share of a contact by which a limit leaves a corner that does not hold it; its square is the share of the
/// bodies that a contact has at first where they would overlap.
const CLOSER: f64 = 0.01;

/// How closely the load under which cells reach an end of the bodies is enclosed.
const NEAR: f64 = 1.25;

/// The first of the shares of a load, each the square of the one before, among which one is sought that reaches no
/// end of the bodies; and how many.
const LESS: f64 = 0.25;
const MOST_SHARES: usize = 6;

/// What a search needs besides samples, kept from one solve to the next.
#[derive(Clone)]
pub(crate) struct Workspace<T> {
    /// Heights of the bodies, with the number of the gap that they are of.
    look: Survey<T>,
    of: Option<u64>,
    /// The length of the narrowest feature that was asked for last.
    resolution: Option<T>,
    newton: NewtonSeveral<T>,
    fields: Vec<ExteriorField<T>>,
    /// The contacts last found, and those that Newton's method started from.
    last: Vec<Interval<T>>,
    before: Vec<Interval<T>>,
    passed: Passed<T>,
    /// Where the bodies would pull at each other in what was checked last.
    tension_spans: TensionSpans<T>,
    /// Dips in which they would overlap.
    overlaps: Overlaps<T>,
    pub report: Report,
}

impl<T: Real> Workspace<T> {
    pub fn new() -> Self {
        Self {
            look: Survey::new(),
            of: None,
            resolution: None,
            newton: NewtonSeveral::new(),
            fields: Vec::new(),
            last: Vec::new(),
            before: Vec::new(),
            passed: Passed::new(),
            tension_spans: TensionSpans::new(),
            overlaps: Overlaps::new(),
            report: Report::new(),
        }
    }

    /// Keeps the contacts that were found.
    pub fn keep(&mut self, contacts: &[Interval<T>]) {
        self.last.clear();
        self.last.extend_from_slice(contacts);
    }

    /// Returns the interval from the first of the contacts found last to the last.
    pub fn hull(&self) -> Option<Interval<T>> {
        let (first, last) = (self.last.first()?, self.last.last()?);
        Some(Interval { left: first.left, right: last.right })
    }

    /// Returns about the load that is asked for, as F/κ.
    pub fn about(
        &mut self,
        gap: &Gap<'_, T>,
        asked: Asked<T>,
        cost: &mut Cost,
    ) -> Result<T, ContactError<T>> {
        self.take(gap, cost)?;
        Ok(self.look.load_of(asked))
    }

    /// Forgets what it was that coarser features left open.
    fn look_for_features(&mut self, gap: &Gap<'_, T>) {
        if self.resolution != gap.resolution() {
            self.resolution = gap.resolution();
            self.passed.clear();
            self.look.look_again();
        }
    }

    /// Surveys the bodies, once for a pair of them and as closely as is asked for.
    fn look(
        &mut self,
        gap: &Gap<'_, T>,
        asked: Asked<T>,
        cost: &mut Cost,
    ) -> Result<&Survey<T>, ContactError<T>> {
        self.take(gap, cost)?;
        self.look.refine(gap, asked, T::of(ROUGHLY), cost)?;
        Ok(&self.look)
    }

    /// Takes a first look at the bodies, once for a pair of them.
    fn take(&mut self, gap: &Gap<'_, T>, cost: &mut Cost) -> Result<(), ContactError<T>> {
        if self.of != Some(gap.number()) {
            self.of = None;
            self.passed.clear();
            // Room for what a check takes, which not all bodies need.
            self.fields.reserve(1);
            self.overlaps.closed_before.reserve(3);
            // It serves whatever the tilt.
            self.look.take(&gap.tilted(T::zero()), cost)?;
            self.of = Some(gap.number());
        }
        Ok(())
    }
}

/// Finds the contacts of two bodies.
pub(super) fn find<T: Real>(
    contact: &Contact<'_, T>,
    conditions: Conditions<T>,
    integrator: &mut dyn Integrator<T>,
    workspace: &mut Workspace<T>,
    cost: &mut Cost,
) -> Result<ContactState<T>, ContactError<T>> {
    workspace.look_for_features(&contact.gap);
    let found = find_contacts(contact, conditions, integrator, workspace, cost);
    found.map_err(|error| match error {
        // A step of the heights of which no slope tells is no crest that could be pressed flat.
        ContactError::Overlap { x, interval, .. } => {
            step_of_heights(&contact.gap, interval, x).unwrap_or(error)
        }
        _ => error,
    })
}

fn find_contacts<T: Real>(
    contact: &Contact<'_, T>,
    conditions: Conditions<T>,
    integrator: &mut dyn Integrator<T>,
    workspace: &mut Workspace<T>,
    cost: &mut Cost,
) -> Result<ContactState<T>, ContactError<T>> {
    let gap = &contact.gap;
    let edges = contact.checked_edges()?;
    let given = !edges.are_sought();
    let cells = FIRST_CELLS;
    let closed = Vec::new();
    let mut search = Search {
        contact,
        conditions,
        integrator,
        workspace,
        cost,
        cells,
        closed,
        runs_out: None,
        end: None,
        has_run_out: false,
    };
    let turns = search.turns();
    if contact.single_interval {
        let (start, found) = search.one(false);
        search.workspace.report.add(start, Outcome::Unchecked);
        return found;
    }
    let mut fault = None;
    if search.workspace.last.len() <= 1 {
        // Of several valleys heights tell at less cost what a search for one contact fails at.
        if search.has_valleys()? {
            match search.several(None) {
                Err(error) if !matches!(error, ContactError::DomainTooShort { .. }) => {}
                found => return found,
            }
        }
        let looks = !gap.is_convex() && !turns && !given;
        let (start, found) = match search.one(looks) {
            // Without a look at the bodies.
            (start, found @ Err(ContactError::NoEquilibrium { .. }))
                if gap.is_convex() && !turns =>
            {
                search.workspace.report.add(start, Outcome::NotFound);
                let (start, again) = search.one(true);
                (start, again.or(found))
            }
            found => found,
        };
        match found {
            Ok(found) => match search.checked(&found)? {
                None => {
                    search.workspace.report.add(start, Outcome::Passed);
                    return Ok(found);
                }
                // Of bodies that turn, more contacts may press at the corner.
                Some(error @ ContactError::LiftsOff { .. }) if search.is_convex() || !turns => {
                    return Err(error);
                }
                Some(error) => {
                    search.workspace.report.add(start, Outcome::of(&error));
                    fault = Some(error);
                }
            },
            Err(error) if given || !error.may_be_several() => return Err(error),
            // Of bodies that turn, one contact may be hard to find too; so it may among waves that nothing has shown yet.
            Err(error)
                if !turns
                    && (search.is_convex()
                        || !matches!(error, ContactError::NoEquilibrium { .. })
                            && search.look()?.bulges()) =>
            {
                return Err(error);
            }
            Err(error) => {
                search.workspace.report.add(start, Outcome::NotFound);
                fault = Some(error);
            }
        }
    }
    search.several(fault)
}

/// Returns what the survey is asked for.
fn asked_by<T: Real>(conditions: &Conditions<T>) -> Asked<T> {
    match conditions.given {
        Given::HalfWidth(half_width) => Asked::HalfWidth(half_width),
        Given::Load(load) => Asked::Load(load / conditions.kappa),
        Given::Centre { load, .. } => Asked::Turning(load / conditions.kappa),
    }
}

struct Search<'s, 'b, T: Real> {
    contact: &'s Contact<'b, T>,
    conditions: Conditions<T>,
    integrator: &'s mut dyn Integrator<T>,
    workspace: &'s mut Workspace<T>,
    cost: &'s mut Cost,
    /// Cells that the next active set starts with.
    cells: usize,
    /// Where gaps have closed.
    closed: Vec<Interval<T>>,
    /// The end of the bodies that contacts reach, where no corner holds them.
    runs_out: Option<Side>,
    /// The end of the bodies that the contacts are to reach, where the load is sought under which they do.
    end: Option<Side>,
    /// Whether cells have done so before.
    has_run_out: bool,
}

impl<T: Real> Search<'_, '_, T> {
    /// Seeks one contact: where it was, where the user says, or at the lowest gap. Without a
    /// look at the bodies it starts in their middle.
    fn one(&mut self, looks: bool) -> (Start, Result<ContactState<T>, ContactError<T>>) {
        let mut start = if self.turns() { Start::LineOfLoad } else { Start::Middle };
        let asked = self.asked();
        let (contact, cost) = (self.contact, &mut *self.cost);
        let last = self.workspace.last.first().copied();
        let told = last.is_some() || contact.start.is_some();
        if looks && !told {
            start = Start::LowestGap;
            if let Err(error) = self.workspace.look(&contact.gap, asked, cost) {
                return (start, Err(error));
            }
        }
        start = match (last, contact.start) {
            (Some(_), _) => Start::Last,
            (_, Some(_)) => Start::Given,
            _ => start,
        };
        let mut found = self.one_from(last, looks);
        for _ in 0..panels::MOST_MISSED {
            let Ok(state) = &found else { break };
            match self.misses(state) {
                Ok(false) => break,
                Ok(true) => found = self.one_from(Some(state.interval), looks),
                Err(error) => found = Err(error),
            }
        }
        (start, found)
    }

    /// Seeks one contact around the last one, if any; without it where a survey may say.
    fn one_from(
        &mut self,
        last: Option<Interval<T>>,
        looks: bool,
    ) -> Result<ContactState<T>, ContactError<T>> {
        let (contact, integrator) = (self.contact, &mut *self.integrator);
        let Workspace { look, of, .. } = &*self.workspace;
        let look = Some(look).filter(|_| looks && *of == Some(contact.gap.number()));
        let cost = &mut *self.cost;
        let (conditions, start, bears) = (self.conditions, contact.start, None);
        Single { contact, conditions, start, look, integrator, cost, bears }.find(last)
    }

    /// Looks for narrow features in the contacts that were found; tells whether the panels missed one.
    fn misses(&mut self, found: &ContactState<T>) -> Result<bool, ContactError<T>> {
        let contact = self.contact;
        if contact.single_interval || contact.gap.is_convex() {
            return Ok(false);
        }
        let Interval { left, right } = found.interval;
        contact.gap.check_resolution(left.abs().max(right.abs()))?;
        let (Workspace { look, of, .. }, load) =
            (&*self.workspace, found.load.abs() / contact.kappa);
        let gap = &contact.gap.tilted(found.tilt);
        if *of == Some(gap.number()) && look.is_resolved(gap, load) {
            return Ok(false);
        }
        panels::probe(self.integrator, gap, found.interval)
    }

    /// What a solution fails by, if anything.
    fn checked(
        &mut self,
        found: &ContactState<T>,
    ) -> Result<Option<ContactError<T>>, ContactError<T>> {
        // More contacts may press at a corner that is not reached.
        let (edges, lifts_off) = (self.contact.edges, found.lifts_off(self.contact.edges));
        let is_said = self.contact.gap.is_convex();
        if is_said || lifts_off.is_some() && found.reaches(edges) == Ends::both(true) {
            return Ok(lifts_off);
        }
        self.resolve(found)?;
        if self.is_convex() {
            return Ok(lifts_off);
        }
        let (gap, kappa) = (&self.contact.gap.tilted(found.tilt), self.contact.kappa);
        if self.touches_once(gap, found)? {
            return Ok(lifts_off);
        }
        // Where the integrator has no panels, the contact is looked at on some that are made for it.
        let mut own = None;
        if panels::several(self.integrator).is_none() {
            let integrator = if panels::is_panels(self.integrator) {
                &mut *self.integrator
            } else {
                &mut **own.insert(Panels::FULL.integrator()?)
            };
            integrator.prepare(gap, found.interval)?;
        }
        let integrator = own.as_deref().unwrap_or(&*self.integrator);
        let covers = self.covers(found);
        if !covers {
            self.workspace.take(gap, self.cost)?;
        }
        let (interval, load) = (found.interval, found.load);
        let Workspace { look, fields, tension_spans, passed, overlaps, .. } = &mut *self.workspace;
        let under = [load / kappa, found.tilt];
        let on = Under { under, samples: integrator.cost().samples };
        let contacts = panels::several(integrator).map(Several::contacts);
        let contacts = contacts.unwrap_or(std::slice::from_ref(&interval));
        // What a heavier load has left open a lighter one leaves open; what a lighter one presses a heavier one does.
        let (widest, pressed) = (passed.under_more(under), passed.under_less(on, contacts));
        let closed = &self.closed;
        let check = SignoriniCheck { gap, integrator, kappa, found, closed, widest, pressed };
        fields.clear();
        overlaps.dips.clear();
        if let Some([x, pressure]) = check.tension(fields, tension_spans)? {
            if pressure.partial_cmp(&pressure).is_none() {
                return Err(ContactError::Overflow { interval });
            }
            return Ok(Some(ContactError::Tension { x, pressure, interval, load }));
        }
        // From end to end nothing lies outside.
        if !covers {
            check.overlap(fields, overlaps, look, self.contact.ends(), self.cost)?;
        }
        let overlap = overlaps.worst();
        if overlap.is_none() && found.adhesive == Ends::both(false) {
            passed.keep(on, contacts);
            overlaps.closed_before.reserve(1 + 2 * contacts.len());
        }
        if let Some(own) = own {
            self.cost.heights += own.cost().evaluations;
        }
        let overlap = overlap.map(|[x, gap]| ContactError::Overlap { x, gap, interval, load });
        Ok(overlap.or(lifts_off))
    }

    /// Looks for narrow features beside the contacts that were found.
    fn resolve(&mut self, found: &ContactState<T>) -> Result<(), ContactError<T>> {
        let gap = &self.contact.gap.tilted(found.tilt);
        self.workspace.take(gap, self.cost)?;
        let contacts = panels::several(self.integrator).map(|several| several.contacts());
        let contacts = contacts.unwrap_or(std::slice::from_ref(&found.interval));
        let load = found.load.abs() / self.contact.kappa;
        self.workspace.look.resolve(gap, load, contacts, self.cost)
    }

    /// Tells whether one contact leaves nothing of the bodies outside.
    fn covers(&self, found: &ContactState<T>) -> bool {
        let (on, ends) = (found.interval, self.contact.ends());
        let is_one = panels::several(self.integrator).is_none();
        is_one && on.left <= ends.left && on.right >= ends.right
    }

    /// Tells whether the gap is convex around one contact as far as its load reaches.
    fn touches_once(
        &mut self,
        gap: &Gap<'_, T>,
        found: &ContactState<T>,
    ) -> Result<bool, ContactError<T>> {
        let is_one = panels::several(self.integrator).is_none();
        if !is_one || found.adhesive != Ends::both(false) || self.covers(found) {
            return Ok(false);
        }
        self.workspace.take(gap, self.cost)?;
        let load = found.load / self.contact.kappa;
        self.workspace.look.prove(gap, found.interval, load, self.cost)
    }

    /// Whether the gap has several low places, and nothing else says where to start.
    fn has_valleys(&mut self) -> Result<bool, ContactError<T>> {
        let given = self.contact.start.is_some() || !self.contact.edges.are_sought();
        let told = given || !self.workspace.last.is_empty();
        if self.is_convex() || told || !self.may_be_several() {
            return Ok(false);
        }
        let look = self.look()?;
        Ok(!look.is_one_valley())
    }

    /// Tells whether the gap is known to be convex: the bodies say so, or it is proved.
    fn is_convex(&self) -> bool {
        let (gap, Workspace { look, of, .. }) = (&self.contact.gap, &*self.workspace);
        gap.is_convex() || *of == Some(gap.number()) && look.is_convex()
    }

    /// Returns what the survey is asked for.
    fn asked(&self) -> Asked<T> {
        asked_by(&self.conditions)
    }

    /// Surveys the bodies as closely as the load asks for.
    fn look(&mut self) -> Result<&Survey<T>, ContactError<T>> {
        let asked = self.asked();
        self.workspace.look(&self.contact.gap, asked, self.cost)
    }

    /// Whether the bodies turn until the load acts at a given place.
    fn turns(&self) -> bool {
        self.conditions.at().is_some()
    }

    /// Whether several contacts can be sought.
    fn may_be_several(&self) -> bool {
        // Integrators of the user's, and the paper's, know but one contact; so do the searches.
        let by_load = !matches!(self.conditions.given, Given::HalfWidth(_));
        by_load
            && !self.contact.edges.are_adhesive()
            && self.contact.search.is_none()
            && panels::is_panels(self.integrator)
    }

    /// Seeks any number of contacts; `fault` is what one alone has failed by.
    fn several(
        &mut self,
        fault: Option<ContactError<T>>,
    ) -> Result<ContactState<T>, ContactError<T>> {
        let gap = &self.contact.gap;
        let [from, to] = gap.range();
        let edges = self.contact.edges;
        let no_balance =
            ContactError::NoEquilibrium { half_width: T::of(0.5) * (to - from), near: from };
        if !self.may_be_several() {
            return Err(fault.unwrap_or(no_balance));
        }
        let first = fault.clone().filter(|fault| Outcome::of(fault) == Outcome::NotFound);
        let mut fault = fault;
        let ends = self.contact.ends();
        let at_corner = edges.map(|edge| matches!(edge, Edge::Fixed(_) | Edge::FreeUntil(_)));
        // Whether a corner presses is seen of the contacts that are there without it.
        let conditions = Conditions { edges: edges.map(Edge::let_go), ..self.conditions };
        let last = &self.workspace.last;
        let is_near = last.len() > 1 && self.end.is_none();
        let mut start = if is_near { Start::Last } else { Start::ActiveSet };
        self.workspace.newton.on.clone_from(last);
        for _ in 0..MOST_TRIALS {
            gap.check_watch(*self.cost, Interval { left: from, right: to })?;
            if start == Start::ActiveSet {
                // More cells find no contact under more than the bodies bear; once they may help.
                if let Some(end) = self.runs_out {
                    if std::mem::replace(&mut self.has_run_out, true) {
                        break;
                    }
                    // Turned, they bear another load.
                    let bears = if self.end.is_some() || self.turns() {
                        None
                    } else {
                        self.bears(&conditions, end)
                    };
                    if let Some(bears) = bears.filter(|bears| bears.load < conditions.load()) {
                        return Err(bears.too_short(conditions.load()));
                    }
                }
                self.active_set(&conditions)?;
            }
            let Workspace { newton: NewtonSeveral { on, .. }, before, .. } = &mut *self.workspace;
            before.clone_from(on);
            let last = on.len() - 1;
            let corners = Ends {
                left: at_corner.left && on[0].left <= ends.left,
                right: at_corner.right && on[last].right >= ends.right,
            };
            let found = match self.converge(&conditions, corners, ends) {
                Ok(found) => found,
                Err(error) if error.may_be_several() => {
                    self.workspace.report.add(start, Outcome::NotFound);
                    (start, fault) = (Start::ActiveSet, Some(error));
                    continue;
                }
                Err(error) => return Err(error),
            };
            let outcome = match found {
                Ok(found) => match self.checked(&found)? {
                    None => {
                        self.workspace.report.add(start, Outcome::Passed);
                        return Ok(found);
                    }
                    Some(error @ ContactError::LiftsOff { .. }) => return Err(error),
                    Some(error) => {
                        self.workspace.report.add(start, Outcome::of(&error));
                        // Where one overlap follows another, cells see all of them at once.
                        let again = start == Start::Attempt
                            && self.workspace.tension_spans.spans.is_empty();
                        // An attempt that leads to itself is not made again.
                        let mended = self.mend();
                        let again = again || self.workspace.newton.on == self.workspace.before;
                        start = if mended && !again { Start::Attempt } else { Start::ActiveSet };
                        fault = Some(error);
                        continue;
                    }
                },
                Err(outcome) => outcome,
            };
            if let SeveralOutcome::Closed(i) = outcome
                && self.workspace.newton.is_nothing(i)
            {
                self.closed.push(self.workspace.newton.closed_gap(i));
            }
            // Where the search has led without an end says little.
            let Workspace { newton: NewtonSeveral { on, .. }, before, .. } = &mut *self.workspace;
            on.clone_from(before);
            let verdict = match outcome {
                SeveralOutcome::Closed(i) => {
                    on[i].right = on.remove(i + 1).right;
                    Outcome::Merged
                }
                SeveralOutcome::Lost(i) if on.len() > 1 => {
                    on.remove(i);
                    Outcome::Lost
                }
                SeveralOutcome::Beyond(side) if at_corner[side] => {
                    match side {
                        Side::Left => on[0].left = ends.left,
                        Side::Right => on[last].right = ends.right,
                    }
                    Outcome::ReachedCorner
                }
                // This end is reached under less.
                SeveralOutcome::Beyond(side) if self.end.is_some() => {
                    self.end = Some(side);
                    Outcome::ReachedCorner
                }
                _ => {
                    if let SeveralOutcome::Beyond(side) = outcome {
                        self.runs_out = Some(side);
                    }
                    // Where contacts were mended cells are to look; of others nothing is to be learnt.
                    if start != Start::Attempt {
                        on.clear();
                    }
                    Outcome::NotFound
                }
            };
            self.workspace.report.add(start, verdict);
            start = if verdict == Outcome::NotFound { Start::ActiveSet } else { Start::Attempt };
        }
        // What one contact alone has failed by says more than that it was not found.
        let runs_out = self.runs_out.map(|side| ContactError::EndReached {
            end: ends[side],
            load: conditions.load(),
            kappa_is_default: false,
        });
        // Unless that is what it would bear alone.
        let says = |fault: &ContactError<T>| match fault {
            ContactError::NoEquilibrium { .. } => false,
            ContactError::DomainTooShort { .. } => runs_out.is_none(),
            _ => true,
        };
        Err(first.filter(says).or(runs_out).or(fault).unwrap_or(no_balance))
    }

    /// Moves the contacts at hand to where they bear the load, again as long as their panels miss narrow features.
    fn converge(
        &mut self,
        conditions: &Conditions<T>,
        corners: Ends<bool>,
        ends: Ends<T>,
    ) -> Result<Result<ContactState<T>, SeveralOutcome>, ContactError<T>> {
        let mut found = self.converge_once(conditions, corners, ends)?;
        for _ in 0..panels::MOST_MISSED {
            match &found {
                Ok(state) if self.misses(state)? => {
                    found = self.converge_once(conditions, corners, ends)?;
                }
                _ => break,
            }
        }
        Ok(found)
    }

    fn converge_once(
        &mut self,
        conditions: &Conditions<T>,
        corners: Ends<bool>,
        ends: Ends<T>,
    ) -> Result<Result<ContactState<T>, SeveralOutcome>, ContactError<T>> {
        let contact = self.contact;
        let newton = &mut self.workspace.newton;
        if let [on] = newton.on[..] {
            let (mut start, look, bears) = (Some(on), None, Some(None));
            let (mut conditions, integrator, cost) =
                (*conditions, &mut *self.integrator, &mut *self.cost);
            if self.end.is_some() {
                let mut widest = capacity(contact, &conditions, ends, cost);
                // At a corner more is borne, up to the other end.
                for side in Side::BOTH {
                    let (edge, end) = (&mut conditions.edges[side], ends[side]);
                    if matches!(edge, Edge::FreeUntil(_)) && widest.is_some_and(|at| at.end == end)
                    {
                        *edge = Edge::Fixed(end);
                        widest = capacity(contact, &conditions, ends, cost);
                        break;
                    }
                }
                let Some(widest) = widest else { return Ok(Err(SeveralOutcome::Failed)) };
                start = Some(widest.on);
                conditions.given = Given::HalfWidth(widest.on.half_width());
            }
            let found =
                Single { contact, conditions, start, look, integrator, cost, bears }.find(start)?;
            (newton.on[0], newton.tilt) = (found.interval, found.tilt);
            return Ok(Ok(found));
        }
        for side in Side::BOTH {
            let last = newton.on.len() - 1;
            if corners[side] || self.end == Some(side) {
                match side {
                    Side::Left => newton.on[0].left = ends.left,
                    Side::Right => newton.on[last].right = ends.right,
                }
            }
        }
        let Some(several) = panels::several_mut(self.integrator) else {
            return Ok(Err(SeveralOutcome::Failed));
        };
        let besides = conditions.at().map(Besides::Tilt).or(self.end.map(Besides::Load));
        let load = conditions.load() / conditions.kappa;
        let outcome = newton.converge(several, &contact.gap, load, corners, ends, besides)?;
        if outcome != SeveralOutcome::Found {
            return Ok(Err(outcome));
        }
        let load = match self.end {
            Some(_) => newton.load * conditions.kappa,
            None => conditions.load(),
        };
        let found = newton.found(several, conditions.kappa, load, corners, ends);
        // A corner that pulls does not hold the contact.
        for side in Side::BOTH {
            if corners[side]
                && found.strengths[side] < T::zero()
                && matches!(conditions.edges[side], Edge::FreeUntil(_))
            {
                let last = newton.on.len() - 1;
                let outermost = &mut newton.on[if side == Side::Left { 0 } else { last }];
                let inward = T::of(CLOSER) * outermost.half_width();
                match side {
                    Side::Left => outermost.left += inward,
                    Side::Right => outermost.right -= inward,
                }
                let mut corners = corners;
                corners[side] = false;
                return self.converge_once(conditions, corners, ends);
            }
        }
        Ok(Ok(found))
    }

    /// Parts the contacts at hand where they would pull, or puts some where the bodies would overlap; whether
    /// any is left.
    fn mend(&mut self) -> bool {
        let Workspace { newton: NewtonSeveral { on, .. }, tension_spans, overlaps, .. } =
            &mut *self.workspace;
        for span in &tension_spans.spans {
            let apart = |on: Interval<T>| {
                let left = Interval { right: on.right.min(span.left), ..on };
                let right = Interval { left: on.left.max(span.right), ..on };
                [left, right].into_iter().filter(|on| on.left < on.right)
            };
            *on = on.drain(..).flat_map(apart).collect();
        }
        let (half, ends) = (T::of(0.5), self.contact.ends());
        let aside = T::of(CLOSER * CLOSER) * (ends.right - ends.left);
        for &[x, _] in &overlaps.dips {
            let at = on.partition_point(|on| on.right < x);
            let left = if at == 0 { ends.left } else { on[at - 1].right };
            let right = on.get(at).map_or(ends.right, |next| next.left);
            let seed = Interval {
                left: (x - aside).max(half * (x + left)),
                right: (x + aside).min(half * (x + right)),
            };
            if seed.left < seed.right {
                on.insert(at, seed);
            }
        }
        !on.is_empty()
    }

    /// Takes the contacts from a coarse active set, with a closer look where a check has failed.
    fn active_set(&mut self, conditions: &Conditions<T>) -> Result<(), ContactError<T>> {
        // As many cells as have not failed yet.
        let cells = self.cells;
        self.cells = (cells + cells).min(16 * FIRST_CELLS);
        let coarse = self.coarse(conditions, cells)?;
        self.runs_out = self.end_reached(&coarse);
        let newton = &mut self.workspace.newton;
        (newton.on, newton.tilt) = (coarse.intervals, self.contact.gap.tilt() + coarse.tilt);
        Ok(())
    }

    fn coarse(
        &mut self,
        conditions: &Conditions<T>,
        cells: usize,
    ) -> Result<Coarse<T>, ContactError<T>> {
        let (gap, ends) = (&self.contact.gap, self.contact.ends());
        let asked = asked_by(conditions);
        self.workspace.take(gap, self.cost)?;
        self.workspace.look.refine(gap, asked, T::of(CLOSELY), self.cost)?;
        let Workspace { look, newton, .. } = &*self.workspace;
        let (kappa, load) = (conditions.kappa, conditions.load());
        let turned = look.heights(gap);
        let (known, start) = (&turned[..], &newton.on[..]);
        let range = [ends.left, ends.right];
        let scene = Scene { kappa, load, at: conditions.at(), range, cells, known, start };
        let coarse = active_set(&scene, &mut |x| Ok(gap.turned(x, look.height(gap.nearest(x)))));
        coarse.map_err(|error| match error {
            NotFound::Height(error) => error,
            _ => ContactError::NoEquilibrium {
                half_width: T::of(0.5) * (ends.right - ends.left),
                near: look.lowest(),
            },
        })
    }

    /// The end of the bodies that contacts reach, where no corner holds them.
    fn end_reached(&self, coarse: &Coarse<T>) -> Option<Side> {
        let is_corner =
            |side: Side| matches!(self.contact.edges[side], Edge::Fixed(_) | Edge::FreeUntil(_));
        Side::BOTH.into_iter().find(|&side| coarse.reaches[side] && !is_corner(side))
    }

    /// What the bodies bear, where that is less than a load under which cells reach an end of them: the load
    /// grows with the contacts, so there is one under which the outermost limit is at an end.
    fn bears(&mut self, conditions: &Conditions<T>, end: Side) -> Option<Capacity<T>> {
        let (load, end) = self.end_reached_by(conditions, end)?;
        let conditions = Conditions { given: Given::Load(load), ..*conditions };
        let mut search = Search {
            contact: self.contact,
            conditions,
            integrator: &mut *self.integrator,
            workspace: &mut *self.workspace,
            cost: &mut *self.cost,
            cells: FIRST_CELLS,
            closed: Vec::new(),
            runs_out: None,
            end: Some(end),
            has_run_out: false,
        };
        let ContactState { interval: on, load, free, .. } = search.several(None).ok()?;
        let ends = self.contact.ends();
        let room = Ends { left: on.left - ends.left, right: ends.right - on.right };
        let side = if room.right < room.left { Side::Right } else { Side::Left };
        // A single contact as wide as the widest in balance may be another one.
        if room[side] > T::epsilon().sqrt() * on.half_width() {
            return None;
        }
        let (integrator, gap) = (&*self.integrator, &self.contact.gap);
        let one = [on];
        let contacts = panels::several(integrator).map_or(&one[..], |several| several.contacts());
        let load_case = LoadCase { kappa: conditions.kappa, load, free };
        let mut highest = if free == Ends::both(true) { T::zero() } else { T::one() / T::zero() };
        for contact in contacts.iter().copied().enumerate() {
            highest = highest.max(
                largest_pressure(integrator, gap, &load_case, contact, self.cost).ok()?.1.value,
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
