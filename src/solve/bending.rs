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
//! On a thin layer the contact of half-planes, the first one, may be wider than the bodies: then
//! the load is smaller in the beginning. On a base far softer than its coating the first one is far
//! too narrow: then the kernel is.

mod row;

use super::by_load::{self, ByApproach, HalfWidth, Peak};
use super::{Contact, Control, Work, find_under};
use crate::gap::Gap;
use crate::kernel::{Bend, Correction, Kept, Kernel, Spread};
use crate::solution::{ContactState, Integrals, Report, Solved};
use crate::{ContactError, Edge, Ends, InputError, Interval, Real, SolveError};
use std::sync::Arc;

/// Contacts solved before the search is given up.
const MAX_SOLVES: usize = 120;

/// ρ that ends the search, in units in the last place: the rounding of r.
const LEAST: f64 = 16.0;

/// Residual that ends the search, too, as a share of the error of the limits.
const BELOW: f64 = 1.0 / 64.0;

/// Share of the last ρ that shows that it falls no more.
const STALLED: f64 = 0.2;

/// Least part of a correction that is tried.
const LEAST_PART: f64 = 1.0 / 64.0;

/// Least share of the load from which a search starts.
const LEAST_SHARE: f64 = 1e-9;

/// Largest half-width of the contacts by the thickness of a layer: the cost grows with the square.
const THINNEST: f64 = 100.0;

/// ρ, as a share of Eq. (1), at which a smaller load gives way to a larger one, the first factor
/// between the two, and the least.
const NEAR: f64 = 0.05;
const GROWTH: f64 = 2.0;
const LEAST_GROWTH: f64 = 1.01;

/// First share of a kernel that is too strong to begin with.
const FIRST_KERNEL: f64 = 1.0 / 64.0;

/// Factor by which a contact may be too wide on the way.
const MOST_TIMES: f64 = 2.0;

/// Returns the kernel of a scene, if it has one, after a check that it can be solved.
pub(super) fn kernel<'b, T: Real>(
    contact: &Contact<'b, T>,
    control: Control<T>,
) -> Result<Option<Box<Kernel<'b, T>>>, ContactError<T>> {
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
        return refuse("the bodies have a period, and an edge is not Free");
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
) -> Result<(ContactState<T>, Gap<'b, T>), ContactError<T>> {
    if let Control::Approach { approach, references } = control {
        let bodies = contact.elasticity()?.ok_or(InputError::NoMaterials)?;
        let by = ByApproach { references, bodies };
        return by_load::find_of(contact, Some(kernel), &by, ("approach", approach), work);
    }
    let spreads = warm(std::mem::take(&mut work.workspace.spreads), control);
    let (before, one) = (T::one() / T::zero(), T::one());
    let [from, target] = [Vec::new(), Vec::new()];
    let (part, share, reached, growth, fault) = (one, one, T::zero(), T::of(GROWTH), None);
    let gap = contact.gap.clone();
    let along = Along::Load;
    let found = Bending {
        contact,
        gap,
        bent: None,
        kernel: kernel.clone(),
        control,
        work: &mut *work,
        spreads,
        from,
        target,
        part,
        before,
        along,
        share,
        reached,
        growth,
        fault,
        is_checked: true,
        has_converged: false,
        may_be_one: true,
    }
    .find();
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

/// Tells whether a contact of this half-width fills the period of a row.
fn fills<T: Real>(kernel: &Kernel<'_, T>, half_width: T) -> bool {
    kernel.row.as_ref().is_some_and(|row| half_width + half_width >= row.period)
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

/// Returns the load of a control that gives one.
fn load<T: Real>(control: Control<T>) -> Option<T> {
    match control {
        Control::Load(load)
        | Control::Moment { load, .. }
        | Control::CentreOfPressure { load, .. } => Some(load),
        _ => None,
    }
}

struct Bending<'s, 'w, 'b, T: Real> {
    contact: &'s Contact<'b, T>,
    /// Bodies before they are bent, over the period at hand.
    gap: Gap<'b, T>,
    /// The same with the bend of the last solve, if it is to be solved once more.
    bent: Option<Gap<'b, T>>,
    /// The kernel, times its share.
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
    /// ρ from which this step began.
    before: T,
    /// Share of the load or of the kernel, the share reached before, and the factor of the next
    /// step.
    along: Along,
    share: T,
    reached: T,
    growth: T,
    /// Error of the first solve, on the way to the whole load, or of the last one.
    fault: Option<ContactError<T>>,
    /// Flags: the next solve may have several contacts; the next one is the last, a check with
    /// features; contacts that are one interval when they are first checked are sought as one.
    is_checked: bool,
    has_converged: bool,
    may_be_one: bool,
}

/// Returns the interval of some pressures, from the first to the last.
fn hull<T: Real>(spreads: &[Spread<T>]) -> Option<Interval<T>> {
    let hull = |one: Interval<T>, on: Interval<T>| Interval {
        left: one.left.min(on.left),
        right: one.right.max(on.right),
    };
    spreads.iter().map(|spread| spread.on).reduce(hull)
}

/// What grows on the way to the whole problem.
#[derive(Clone, Copy, PartialEq)]
enum Along {
    Load,
    Kernel,
}

/// A solve on the bent bodies.
struct Solve<'b, T: Real> {
    found: ContactState<T>,
    gap: Gap<'b, T>,
    is_checked: bool,
}

impl<'b, T: Real> Bending<'_, '_, 'b, T> {
    fn find(&mut self) -> Result<(ContactState<T>, Gap<'b, T>), ContactError<T>> {
        if let Control::HalfWidth(half_width) = self.control
            && fills(&self.kernel, half_width)
        {
            return Err(self.complete()?);
        }
        if self.spreads.is_empty() {
            self.spreads = self.begin();
        }
        self.cut()?;
        self.is_checked = self.kernel.row.is_some() || self.spreads.len() != 1;
        let mut left = T::DERIVATIVE_ORDER;
        for _ in 0..MAX_SOLVES {
            let solved = match self.solve() {
                Ok(solved) => solved,
                Err(error) => {
                    self.recover(error)?;
                    continue;
                }
            };
            let Some(Correction { spreads, residual }) = self.correct(&solved)? else { break };
            let is_whole = self.share >= T::one();
            if self.has_converged && spreads.len() != self.target.len() {
                // The ρ that was reached is that of other contacts.
                self.before = T::one() / T::zero();
            }
            let is_least = self.is_least(residual, solved.found.error);
            if is_least && is_whole && left == 0 {
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
            left = if is_least { left.saturating_sub(1) } else { left };
            let falls = residual <= (T::one() - T::of(0.25) * self.part) * self.before;
            if !falls && !is_least {
                self.is_checked |= self.less()?;
                continue;
            }
            // A larger load does not make it narrower.
            if residual < T::of(NEAR) {
                self.check_width(&solved.found, T::one())?;
            }
            // A check may have found other contacts than the one that was sought.
            self.is_checked = self.has_converged || !self.may_be_one || spreads.len() > 1;
            self.step_to(spreads, residual)?;
            if !is_whole && residual < T::of(NEAR) {
                self.more();
            }
        }
        Err(self.not_converged())
    }

    /// Tells whether no other step is worth its cost: the residual is that of rounding, or far
    /// below the error of the limits. Next to a kink r is known to fewer digits.
    fn is_least(&self, residual: T, error: Option<T>) -> bool {
        let known = T::of(BELOW) * error.unwrap_or(T::zero());
        residual <= known.max(T::of(LEAST) * T::epsilon())
            || residual <= T::epsilon().powf(T::of(0.75)) && residual > T::of(STALLED) * self.before
    }

    /// Goes on from a solve that failed.
    fn recover(&mut self, error: ContactError<T>) -> Result<(), ContactError<T>> {
        self.is_checked = true;
        if self.has_converged && self.may_be_one && !ends(&error) {
            // One interval meets the equation, but is no contact.
            (self.has_converged, self.may_be_one) = (false, false);
            self.restart();
            return Ok(());
        }
        self.retreat(error)
    }

    fn not_converged(&mut self) -> ContactError<T> {
        let (residual, share) = (self.before, self.share);
        match self.fault.take() {
            Some(fault) if self.fills(&fault) => self.complete().unwrap_or_else(|error| error),
            _ => SolveError::Bending { residual, solves: MAX_SOLVES, share }.into(),
        }
    }

    /// Refuses a contact that is some times too wide beside the kernel.
    fn check_width(&self, found: &ContactState<T>, times: T) -> Result<(), ContactError<T>> {
        let Some(distance) = self.kernel.layer_distance() else { return Ok(()) };
        let thickness = T::of(0.5) * distance;
        let (ratio, limit) = (found.interval.half_width() / thickness, T::of(THINNEST));
        if ratio > times * limit {
            return Err(InputError::LayerTooThin { ratio, limit }.into());
        }
        Ok(())
    }

    /// Takes the whole correction of a solve with this residual.
    fn step_to(&mut self, target: Vec<Spread<T>>, residual: T) -> Result<(), ContactError<T>> {
        self.from = std::mem::replace(&mut self.spreads, target.clone());
        (self.target, self.part, self.before) = (target, T::one(), residual);
        self.cut()
    }

    /// Begins anew.
    fn restart(&mut self) {
        (self.part, self.before) = (T::one(), T::one() / T::zero());
        (self.from, self.target) = (Vec::new(), Vec::new());
        self.spreads = self.begin();
    }

    /// Takes half of the part of the correction.
    fn halve(&mut self) {
        self.part *= T::of(0.5);
        let (less, part) = (T::one() - self.part, self.part);
        self.spreads.clear();
        self.spreads.extend(self.from.iter().map(|spread| spread.times(less)));
        self.spreads.extend(self.target.iter().map(|spread| spread.times(part)));
    }

    /// Goes on from a solve that failed: with a smaller load, or with less of the correction.
    fn retreat(&mut self, error: ContactError<T>) -> Result<(), ContactError<T>> {
        if ends(&error) || self.target.is_empty() && load(self.control).is_none() {
            return Err(error);
        }
        if !self.target.is_empty() {
            self.fault = Some(error);
            return self.less().map(|_| ());
        }
        // The contact of half-planes is far wider than that of a layer may be.
        let fault = match self.fault.take() {
            Some(fault) => fault,
            None => self.check_load(error)?,
        };
        self.share *= T::of(0.5);
        if self.along != Along::Load || self.share < T::of(LEAST_SHARE) {
            return Err(fault);
        }
        self.fault = Some(fault);
        self.spreads = self.begin();
        Ok(())
    }

    /// Takes a shorter step. Tells whether the contacts have to be sought anew.
    fn less(&mut self) -> Result<bool, ContactError<T>> {
        if self.from.is_empty() && self.reached > T::zero() {
            // The load or the kernel has just grown.
            self.growth = self.growth.sqrt();
            if self.growth < T::of(LEAST_GROWTH) {
                return Err(self.not_converged());
            }
            self.grow(self.growth * self.reached / self.share);
        } else if self.part > T::of(LEAST_PART) {
            self.halve();
        } else if self.reached.is_zero() && self.share >= T::one() {
            // On a soft base the kernel is a hundred times the half-planes' part.
            (self.along, self.share) = match self.kernel.row {
                Some(_) => (Along::Load, T::of(0.5)),
                None => (Along::Kernel, T::of(FIRST_KERNEL)),
            };
            self.restart();
            return Ok(true);
        } else {
            return Err(self.not_converged());
        }
        Ok(self.spreads.len() > 1)
    }

    /// Takes a larger load or more of the kernel, up to all of it.
    fn more(&mut self) {
        self.reached = self.share;
        self.grow(self.growth.min(self.share.recip()));
        self.before = T::one() / T::zero();
        self.from.clear();
    }

    /// Multiplies the share. The bend grows with the load, and stays with more of the kernel.
    fn grow(&mut self, factor: T) {
        self.share = (self.share * factor).min(T::one());
        let factor = if self.along == Along::Load { factor } else { factor.recip() };
        self.target.iter_mut().for_each(|spread| *spread = spread.times(factor));
        self.spreads.clone_from(&self.target);
    }

    /// Returns the control with the present share of the load.
    fn reduced(&self) -> Control<T> {
        let share = if self.along == Along::Load { self.share } else { T::one() };
        match self.control {
            Control::Load(load) => Control::Load(share * load),
            Control::Moment { load, moment, about } => {
                Control::Moment { load: share * load, moment: share * moment, about }
            }
            Control::CentreOfPressure { load, at } => {
                Control::CentreOfPressure { load: share * load, at }
            }
            control => control,
        }
    }

    /// Finds the contact of the bent bodies.
    fn solve(&mut self) -> Result<Solve<'b, T>, ContactError<T>> {
        let (kappa, is_checked, is_last) =
            (self.contact.kappa, self.is_checked, self.has_converged);
        self.kernel.share = if self.along == Along::Kernel { self.share } else { T::one() };
        let is_again = self.bent.is_some();
        let gap = match (self.bent.take(), hull(&self.spreads)) {
            (Some(bent), _) => bent,
            (None, None) => self.gap.clone(),
            (None, Some(on)) => {
                self.kernel.in_range(self.gap.range(), on);
                self.gap.bent(&Arc::new(Bend::new(&self.kernel, &self.spreads)), kappa)?
            }
        };
        let mut scene = self.contact.clone();
        scene.gap = gap.clone();
        (scene.single_interval, scene.is_trial) = (scene.single_interval | !is_checked, !is_last);
        let control = self.reduced();
        let Work { integrator, workspace, cost } = &mut *self.work;
        **cost += integrator.cost();
        integrator.reset(is_again);
        (workspace.report, workspace.cell_work) = (Report::new(), 0);
        let found = find_under(&scene, control, self.work)?;
        self.check_width(&found, T::of(MOST_TIMES))?;
        let contacts = self.work.integrator.contacts(&found.interval).to_vec();
        self.look_beside(&contacts)?;
        self.work.keep(&gap.tilted(found.tilt), found.interval)?;
        let is_checked = is_checked && is_last || self.contact.single_interval;
        Ok(Solve { found, gap, is_checked })
    }

    /// Corrects the pressures of a solve.
    fn correct(&mut self, solved: &Solve<'b, T>) -> Result<Option<Correction<T>>, ContactError<T>> {
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
