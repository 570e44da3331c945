//! Contact of bodies with a regular kernel, Eq. (1) in full.
//!
//! ```text
//! (i)   the contact of the bodies bent by r                       the search as it is
//! (ii)  ρ = ∫ K P ds - r                                          the residual of Eq. (1)
//! (iii) a correction δP on the contacts held fixed                linear, kernel/correction.rs
//! (iv)  r ← ∫ K (P + δP) ds, as a whole or in part
//! ```
//!
//! Each turn about squares ρ. A contact in one interval is checked at the beginning and at the end.
//! The contact of half-planes comes first. Where it fits no bodies, or the next step is none, the
//! search begins with cells that have the whole kernel.

mod cells;
mod row;

use super::by_load::{self, ByApproach, HalfWidth, Peak};
use super::{Contact, Control, Work, find_under, first_touch};
use crate::gap::Gap;
use crate::kernel::{Bend, Correction, Kept, Kernel, Spread};
use crate::solution::{ContactState, Integrals, Report, Solved};
use crate::{ContactError, Edge, Ends, Fallible, InputError, Interval, Real, Side, SolveError};
use cells::load;
use row::{fills, hull, merged};

/// Contacts solved before the search is given up.
const MAX_SOLVES: usize = 120;

/// ρ that ends the search, in units in the last place: the rounding of r.
const LEAST: f64 = 16.0;

/// Residual that ends the search, too, as a share of the error of the limits.
const BELOW: f64 = 1.0 / 64.0;

/// Share of the last ρ that shows that it falls no more.
const STALLED: f64 = 0.2;

/// Share of the load of complete contact, which is large with corners, from which on a lighter load
/// may be a start; its share of the load, and the least factor from there to the next.
const LIGHT: f64 = 0.005;
const LIGHTER: f64 = 0.8;
const LEAST_GROWTH: f64 = 1.005;

/// Least part of a correction that is tried.
const LEAST_PART: f64 = 1.0 / 64.0;

/// Parts of corrections in each contact of a row, beyond which its gaps are too narrow to go on:
/// each part adds pressures whose bend is summed, and up to there gaps of 2 % are found.
const MOST_MIXED: usize = 8;

/// Largest half-width of the contacts by the thickness of a layer: the cost grows with the square.
const THINNEST: f64 = 100.0;

/// Factor by which a contact may be too wide on the way.
const MOST_TIMES: f64 = 2.0;

/// Returns the kernel of a scene, if it has one, after a check that it can be solved.
pub(super) fn kernel<'b, T: Real>(
    contact: &Contact<'b, T>,
    control: Control<T>,
) -> Fallible<T, Option<Box<Kernel<'b, T>>>> {
    let Some(kernel) = contact.kernel_of_bodies()? else { return Ok(None) };
    let refuse = |why| Err(InputError::KernelNotSupported { why }.into());
    if contact.edges.are_adhesive() {
        return refuse("an edge is Adhesive");
    }
    if contact.search.is_some() {
        return refuse("a strategy of one's own adjusts the limits");
    }
    if contact.edge_pressure.is_some() {
        return refuse("the edges are by Eq. (6)");
    }
    if contact.quadrature.panels().is_none() {
        return refuse("the quadrature is another");
    }
    if kernel.row.is_none() {
        return Ok(Some(kernel));
    }
    if kernel.formula.is_some() {
        return refuse("the bodies have a period, and the kernel is by a formula");
    }
    if contact.edges != Ends::both(Edge::Free) {
        return refuse("edges of bodies with a period are free, and one here is not Free");
    }
    if matches!(control, Control::Moment { .. } | Control::CentreOfPressure { .. }) {
        return refuse("the bodies have a period, and a moment would turn them");
    }
    Ok(Some(kernel))
}

/// Finds the contact under a control, and returns it with the bent bodies.
pub(super) fn find<'b, T: Real>(
    contact: &Contact<'b, T>,
    kernel: &Kernel<'b, T>,
    control: Control<T>,
    work: &mut Work<'_, T>,
) -> Fallible<T, (ContactState<T>, Gap<'b, T>)> {
    if let Control::Approach { approach, references } = control {
        let bodies = contact.elasticity()?.ok_or(InputError::NoMaterials)?;
        let by = ByApproach { references, bodies };
        return by_load::find_of(contact, Some(kernel), &by, ("approach", approach), work);
    }
    // One period of half-planes is no start for a row.
    if let (Some(_), Control::PeakPressure(peak)) = (&kernel.row, control) {
        let by = Peak::new(contact)?;
        return by_load::find_of(contact, Some(kernel), &by, ("peak pressure", peak), work);
    }
    if let Control::HalfWidth(half_width) = control {
        check_width(kernel, half_width, 1.0)?;
    }
    let mut found = from_last(contact, kernel, control, work);
    // Where a row is about to touch all over, the contacts under a lighter load are a start, and so
    // are those under each load on the way.
    if let (Err(ContactError::Solve(SolveError::CompleteContact { load, complete })), true) =
        (&found, matches!(control, Control::Load(_)))
        && load < complete
        && *load > T::of(LIGHT) * *complete
        && find(contact, kernel, Control::Load(T::of(LIGHTER) * *load), work).is_ok()
    {
        let (load, mut growth) = (*load, T::of(LIGHTER).recip());
        let mut reached = T::of(LIGHTER) * load;
        while reached < load && growth > T::of(LEAST_GROWTH) {
            let next = if growth * reached < load { growth * reached } else { load };
            let last = work.workspace.spreads.clone();
            found = from_last(contact, kernel, Control::Load(next), work);
            if found.is_ok() {
                reached = next;
            } else {
                (work.workspace.spreads, growth) = (last, growth.sqrt());
            }
        }
        if let Err(ContactError::Solve(SolveError::CompleteContact { load: of, .. })) = &mut found {
            *of = load;
        }
    }
    match (found, control) {
        (Err(error), _) if ends(&error) => Err(error),
        (Err(error), Control::HalfWidth(half_width)) if fills(kernel, half_width) => Err(error),
        // The same bodies without the kernel, or with that of another load, may not be as wide.
        (Err(_), Control::HalfWidth(half_width)) => {
            by_load::find_of(contact, Some(kernel), &HalfWidth, ("half-width", half_width), work)
        }
        (Err(_), Control::PeakPressure(peak)) => {
            let by = Peak::new(contact)?;
            by_load::find_of(contact, Some(kernel), &by, ("peak pressure", peak), work)
        }
        (found, _) => found,
    }
}

/// Finds the contact from the pressures of the last solve, if there are any.
fn from_last<'b, T: Real>(
    contact: &Contact<'b, T>,
    kernel: &Kernel<'b, T>,
    control: Control<T>,
    work: &mut Work<'_, T>,
) -> Fallible<T, (ContactState<T>, Gap<'b, T>)> {
    let spreads = warm(std::mem::take(&mut work.workspace.spreads), control);
    let (before, one) = (T::one() / T::zero(), T::one());
    let may_be_one = spreads.is_empty() || !work.workspace.is_held;
    let [from, target] = [Vec::new(), Vec::new()];
    let gap = contact.gap.clone();
    Bending {
        contact,
        gap,
        bent: None,
        kernel: kernel.clone(),
        control,
        work: &mut *work,
        spreads,
        from,
        target,
        part: one,
        before,
        of_rates: before,
        fault: None,
        reaches: None,
        has_cells: false,
        is_checked: true,
        has_converged: false,
        may_be_one,
    }
    .find()
}

/// Refuses a contact that is some times too wide beside the kernel.
fn check_width<T: Real>(kernel: &Kernel<'_, T>, half_width: T, times: f64) -> Fallible<T, ()> {
    let Some(distance) = kernel.layer_distance() else { return Ok(()) };
    let (ratio, limit) = (half_width / (T::of(0.5) * distance), T::of(THINNEST));
    if ratio > T::of(times) * limit {
        return Err(InputError::LayerTooThin { ratio, limit }.into());
    }
    Ok(())
}

/// Tells whether a search ends with this error: no other bend would help.
fn ends<T: Real>(error: &ContactError<T>) -> bool {
    use SolveError::{BudgetSpent, Cancelled};
    match error {
        ContactError::Solve(failed) => matches!(failed, Cancelled { .. } | BudgetSpent { .. }),
        ContactError::Input(fault) => !matches!(fault, InputError::LayerTooThin { .. }),
        ContactError::Evaluation(_) => true,
    }
}

/// Returns the pressures of the last solve, in proportion to the load.
fn warm<T: Real>(spreads: Vec<Spread<T>>, control: Control<T>) -> Vec<Spread<T>> {
    let last = spreads.iter().fold(T::zero(), |sum, spread| sum + spread.q[0]);
    match load(control) {
        Some(load) if last > T::zero() => {
            spreads.iter().map(|spread| spread.times(load / last)).collect()
        }
        _ => spreads,
    }
}

struct Bending<'s, 'w, 'b, T: Real> {
    contact: &'s Contact<'b, T>,
    /// Bodies before they are bent, over the period at hand.
    gap: Gap<'b, T>,
    /// The same with the bend of the last solve, if it is to be solved once more.
    bent: Option<Gap<'b, T>>,
    kernel: Kernel<'b, T>,
    control: Control<T>,
    work: &'s mut Work<'w, T>,
    /// Pressures that bend the bodies now, those from which this step began, and the corrected
    /// ones.
    spreads: Vec<Spread<T>>,
    from: Vec<Spread<T>>,
    target: Vec<Spread<T>>,
    /// Part of the correction that is taken.
    part: T,
    /// ρ from which this step began, and the last one of the derivatives.
    before: T,
    of_rates: T,
    /// Error of the last solve that failed.
    fault: Option<ContactError<T>>,
    /// End of the bodies that cells reach.
    reaches: Option<Side>,
    /// Flags: the start from cells has been tried; the next solve may have several contacts; the
    /// next one is the last, a check with features; contacts that are one interval when they are
    /// first checked are sought as one.
    has_cells: bool,
    is_checked: bool,
    has_converged: bool,
    may_be_one: bool,
}

/// Returns the ρ of rounding.
fn rounding<T: Real>() -> T {
    T::of(LEAST) * T::epsilon()
}

/// A solve on the bent bodies.
struct Solve<'b, T: Real> {
    found: ContactState<T>,
    gap: Gap<'b, T>,
    is_checked: bool,
}

impl<'b, T: Real> Bending<'_, '_, 'b, T> {
    fn find(&mut self) -> Fallible<T, (ContactState<T>, Gap<'b, T>)> {
        if let Control::HalfWidth(half_width) = self.control
            && fills(&self.kernel, half_width)
        {
            return Err(self.complete()?);
        }
        if self.spreads.is_empty() {
            self.spreads = self.begin();
        }
        self.cut(false)?;
        self.is_checked = self.kernel.row.is_some() || self.spreads.len() != 1 || !self.may_be_one;
        for _ in 0..MAX_SOLVES {
            let solved = match self.solve() {
                Ok(solved) => solved,
                Err(error) => {
                    self.recover(error)?;
                    continue;
                }
            };
            let Some(Correction { spreads, residuals }) = self.correct(&solved)? else { break };
            // Corners that hold a land are found only among any number of contacts.
            self.may_be_one &= !self.work.workspace.is_held;
            let residual = residuals[0];
            if self.has_converged && spreads.len() != self.target.len() {
                // The ρ that was reached is that of other contacts.
                self.before = T::one() / T::zero();
            }
            let is_least = self.is_least(residual, &solved);
            // Derivatives converge like the values, but may have begun further off; those that are
            // no numbers stay so.
            let of_rates = residuals[1..].iter().copied().fold(T::zero(), T::max);
            let gains = of_rates > rounding() && of_rates < T::of(STALLED) * self.of_rates;
            self.of_rates = of_rates;
            if is_least && !gains {
                check_width(&self.kernel, solved.found.interval.half_width(), 1.0)?;
                if solved.is_checked {
                    let error = solved.found.error.map(|error| error + residual);
                    self.work.workspace.spreads = spreads;
                    return Ok((ContactState { error, ..solved.found }, solved.gap));
                }
                // The samples at hand serve the check.
                self.bent = Some(solved.gap);
                (self.is_checked, self.has_converged) = (true, true);
                continue;
            }
            let falls = residual <= (T::one() - T::of(0.25) * self.part) * self.before;
            if !falls && !is_least {
                self.less()?;
                continue;
            }
            // Each residual is about the square of the one before, times the same factor.
            let fall = residual / self.before;
            let next = if fall > T::zero() { residual * fall * fall } else { residual };
            self.has_converged |= T::COMPONENTS < 2 && self.part == T::one() && next <= rounding();
            // A check may have found other contacts than the one that was sought.
            self.is_checked = self.has_converged || !self.may_be_one || spreads.len() > 1;
            // The whole correction.
            self.from = std::mem::replace(&mut self.spreads, spreads.clone());
            (self.target, self.part, self.before) = (spreads, T::one(), residual);
            self.cut(false)?;
        }
        Err(self.not_found())
    }

    /// Tells whether no other step is worth its cost: the residual is that of rounding, far below
    /// the error of the limits, or below it and falls no more, as limits next to weak corners move
    /// by their error from solve to solve. Next to a kink r is known to fewer digits, and a limit d
    /// beyond a corner gives a pressure there that its rounding changes by a share ε x/d.
    fn is_least(&self, residual: T, Solve { found, gap, .. }: &Solve<'b, T>) -> bool {
        let error = found.error.unwrap_or(T::zero());
        // A limit nearer to a corner than its rounding matters is held there.
        let share = |x: T, joint: Option<T>| {
            let corner = joint.filter(|&z| z != x && gap.jump(z)[0] > T::zero());
            corner.map_or(T::zero(), |z| T::epsilon() * (x / (x - z)).abs())
        };
        let contacts = self.work.integrator.contacts(&found.interval);
        let shares = contacts.iter().flat_map(|&Interval { left, right }| {
            let joints = [gap.breakpoint_after(left), gap.breakpoint_before(right)];
            [share(left, joints[0]), share(right, joints[1])]
        });
        let known = shares.fold(T::epsilon().powf(T::of(2.0 / 3.0)).max(error), T::max);
        // Between contacts r is known like the heights.
        let survey = self.work.workspace.survey_of(gap).filter(|_| contacts.len() > 1);
        let doubt = survey.map_or(T::zero(), |look| look.doubt_at(look.lowest));
        let known = known.max(self.contact.kappa * doubt / found.load);
        residual <= (T::of(BELOW) * error).max(rounding())
            || residual <= known && residual > T::of(STALLED) * self.before
    }

    /// Goes on from a solve that failed.
    fn recover(&mut self, error: ContactError<T>) -> Fallible<T, ()> {
        if ends(&error) || self.spreads.is_empty() && self.bears_nothing(&error)? {
            return Err(error);
        }
        let is_mixed = self.from.len() > MOST_MIXED * merged(&self.from).len();
        if self.fills(&error) && (is_mixed || !self.has_cells) {
            let full = self.complete()?;
            let is_over = matches!(full, ContactError::Solve(SolveError::CompleteContact { load, complete }) if load > complete);
            if is_over || self.has_cells {
                return Err(full);
            }
        }
        let was_one = !std::mem::replace(&mut self.is_checked, true);
        let may_be_more = was_one && self.may_be_one && !self.contact.single_interval;
        if may_be_more && !self.spreads.is_empty() && !self.fills(&error) {
            self.may_be_one = false;
            return Ok(());
        }
        let [cut, _] = self.gap.range();
        if self.fills(&error) && !self.spreads.is_empty() {
            self.cut(true)?;
            if self.gap.range()[0] != cut {
                return Ok(());
            }
        }
        self.fault = Some(error);
        self.less()
    }

    /// Returns the error of the search.
    fn not_found(&mut self) -> ContactError<T> {
        let error = match (self.fault.take(), self.reaches) {
            (Some(fault), _) if self.fills(&fault) => self.complete(),
            (_, Some(side)) => Ok(self.too_short(self.contact.ends_of(&self.gap)[side])),
            // What is too wide, or bears this load, is the contact of half-planes.
            (Some(ContactError::Input(InputError::LayerTooThin { .. })), _) => Ok(self.stuck()),
            (Some(ContactError::Solve(SolveError::DomainTooShort { end, .. })), _) => {
                Ok(self.too_short(end))
            }
            (Some(fault), _) if self.target.is_empty() => Ok(fault),
            _ => Ok(self.stuck()),
        };
        error.unwrap_or_else(|error| error)
    }

    fn stuck(&self) -> ContactError<T> {
        SolveError::Bending { residual: self.before, solves: MAX_SOLVES }.into()
    }

    /// Tells whether bodies with this error, not yet bent, touch first at an end or all along: they
    /// do so on any layer.
    fn bears_nothing(&mut self, error: &ContactError<T>) -> Fallible<T, bool> {
        use SolveError::{DomainTooShort, NoFirstContact};
        let slope = match error {
            ContactError::Solve(NoFirstContact { slope, .. }) => slope,
            ContactError::Solve(DomainTooShort { carried, .. }) => return Ok(carried.is_zero()),
            _ => return Ok(false),
        };
        let place = first_touch(self.contact, self.work.workspace, self.work.cost)?;
        let (ends, edges) = (self.contact.ends(), self.contact.edges);
        let is_at = |side| edges[side] == Edge::Free && place == ends[side];
        Ok(slope.iter().all(T::is_zero) || Side::BOTH.into_iter().any(is_at))
    }

    /// Begins anew.
    fn restart(&mut self, spreads: Vec<Spread<T>>) {
        (self.part, self.before) = (T::one(), T::one() / T::zero());
        (self.from, self.target) = (Vec::new(), Vec::new());
        self.spreads = spreads;
    }

    /// Takes half of the part of the correction.
    fn halve(&mut self) {
        self.part *= T::of(0.5);
        let (less, part) = (T::one() - self.part, self.part);
        self.spreads.clear();
        self.spreads.extend(self.from.iter().map(|spread| spread.times(less)));
        self.spreads.extend(self.target.iter().map(|spread| spread.times(part)));
    }

    /// Takes the start from cells, or else a shorter step, if there was a step.
    fn less(&mut self) -> Fallible<T, ()> {
        if !std::mem::replace(&mut self.has_cells, true) && self.begin_with_cells()? {
            return Ok(());
        }
        if self.target.is_empty() || self.part <= T::of(LEAST_PART) {
            return Err(self.not_found());
        }
        self.halve();
        self.is_checked |= self.spreads.len() > 1;
        Ok(())
    }

    /// Finds the contact of the bent bodies.
    fn solve(&mut self) -> Fallible<T, Solve<'b, T>> {
        let (is_checked, is_last) = (self.is_checked, self.has_converged);
        let gap = match (self.bent.take(), hull(&self.spreads)) {
            (Some(bent), _) => bent,
            (None, None) => self.gap.clone(),
            (None, Some(on)) => {
                self.kernel.in_range(self.gap.range(), on);
                self.gap.bent(Bend::new(&self.kernel, &self.spreads), self.contact.kappa)
            }
        };
        let mut scene = self.contact.clone();
        scene.gap = gap.clone();
        (scene.single_interval, scene.is_trial) = (scene.single_interval | !is_checked, !is_last);
        let found = self.found_on(&scene)?;
        if let Err(error) = check_width(&self.kernel, found.interval.half_width(), MOST_TIMES) {
            self.work.workspace.keep(&[found.interval]);
            return Err(error);
        }
        let contacts = self.work.integrator.contacts(&found.interval).to_vec();
        self.look_beside(&contacts)?;
        self.work.keep(&gap.tilted(found.tilt), found.interval)?;
        let is_checked = is_checked && is_last || self.contact.single_interval;
        Ok(Solve { found, gap, is_checked })
    }

    /// Finds the contact of a scene without its kernel.
    fn found_on(&mut self, scene: &Contact<'b, T>) -> Fallible<T, ContactState<T>> {
        let Work { integrator, workspace, cost } = &mut *self.work;
        **cost += integrator.cost();
        let id = Some(scene.gap.id());
        integrator.reset(workspace.bent == id);
        workspace.bent = id;
        (workspace.report, workspace.cell_work) = (Report::new(), 0);
        find_under(scene, self.control, self.work)
    }

    /// Corrects the pressures of a solve.
    fn correct(&mut self, solved: &Solve<'b, T>) -> Fallible<T, Option<Correction<T>>> {
        let (found, kappa) = (&solved.found, self.contact.kappa);
        let gap = &solved.gap.tilted(found.tilt);
        let pressures = Solved { gap, integrator: &*self.work.integrator, kappa, found };
        let kept = match self.control {
            Control::HalfWidth(_) => Kept::Width,
            Control::PeakPressure(_) => Kept::Pressure(pressures.peak()?.x),
            Control::Moment { .. } | Control::CentreOfPressure { .. } => Kept::Moment(kappa),
            _ => Kept::Load,
        };
        let spreads = Integrals::new(pressures)?.spreads(self.kernel.distance())?;
        let correction = Correction::new(&self.kernel, solved.gap.bend(), spreads, kept);
        correction.map_err(|at| {
            InputError::Kernel { what: "K(x, s), or its integral by x, is not finite at x", at }
                .into()
        })
    }
}
