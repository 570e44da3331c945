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
//! On a thin layer the contact of half-planes, the first one, may be wider than the bodies: then the
//! load is smaller in the beginning.

use super::{Contact, Control, Work, find_under};
use crate::gap::Gap;
use crate::kernel::{Bend, Correction, Kept, Kernel, Spread};
use crate::quadrature::panels;
use crate::solution::{ContactState, Integrals, Report, Solved};
use crate::{ContactError, InputError, Interval, Real, SolveError};
use std::sync::Arc;

/// Contacts solved before the search is given up.
const MAX_SOLVES: usize = 120;

/// Least part of a correction that is tried.
const LEAST_PART: f64 = 1.0 / 64.0;

/// Least share of the load from which a search starts.
const LEAST_SHARE: f64 = 1e-9;

/// Largest half-width of the contacts by the thickness of a layer: the cost grows with the square.
const THINNEST: f64 = 100.0;

/// ρ, as a share of r, at which a smaller load gives way to a larger one.
const NEAR: f64 = 0.05;

/// Returns the kernel of a scene, if it has one, after a check that it can be solved.
pub(super) fn kernel<'b, T: Real>(
    contact: &Contact<'b, T>,
    control: Control<T>,
) -> Result<Option<Kernel<'b, T>>, ContactError<T>> {
    let Some(kernel) = contact.beside.kernel(contact.layers()?)? else { return Ok(None) };
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
    if contact.quadrature.integrator()?.panels().is_none() {
        return refuse("the quadrature is another");
    }
    if matches!(control, Control::Approach { .. }) {
        return refuse("the approach is given");
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
    let spreads = std::mem::take(&mut work.workspace.spreads);
    let spreads = warm(spreads, control);
    let infinite = T::one() / T::zero();
    let mut bending = Bending {
        contact,
        kernel,
        control,
        work,
        from: Vec::new(),
        spreads,
        part: T::one(),
        before: infinite,
        share: T::one(),
        fault: None,
    };
    let found = bending.find()?;
    Ok(found)
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
    kernel: &'s Kernel<'b, T>,
    control: Control<T>,
    work: &'s mut Work<'w, T>,
    /// Pressures that bend the bodies now, and those from which this step began.
    spreads: Vec<Spread<T>>,
    from: Vec<Spread<T>>,
    /// Part of the correction that is taken.
    part: T,
    /// ρ from which this step began.
    before: T,
    /// Share of the load.
    share: T,
    /// Error of the first solve, on the way to the whole load.
    fault: Option<ContactError<T>>,
}

/// A solve on the bent bodies.
struct Solve<'b, T: Real> {
    found: ContactState<T>,
    gap: Gap<'b, T>,
    bend: Option<Arc<Bend<'b, T>>>,
    is_checked: bool,
}

impl<'b, T: Real> Bending<'_, '_, 'b, T> {
    fn find(&mut self) -> Result<(ContactState<T>, Gap<'b, T>), ContactError<T>> {
        let (mut is_checked, mut left) = (true, T::DERIVATIVE_ORDER);
        let mut target: Vec<Spread<T>> = Vec::new();
        for _ in 0..MAX_SOLVES {
            let solved = match self.solve(is_checked) {
                Ok(solved) => solved,
                Err(error) => {
                    self.retreat(error, &target)?;
                    is_checked = true;
                    continue;
                }
            };
            let Some(correction) = self.correct(&solved)? else { break };
            let residual = correction.residual;
            self.check_width(&solved, residual)?;
            let is_small = residual <= T::of(4.0) * T::epsilon();
            let is_least = residual <= T::epsilon().powf(T::of(0.75))
                && residual > T::of(0.2) * self.before;
            let is_whole = self.share >= T::one();
            if (is_small || is_least) && is_whole && left == 0 {
                if solved.is_checked {
                    let error = solved.found.error.map(|error| error + residual);
                    self.work.workspace.spreads = correction.spreads;
                    return Ok((ContactState { error, ..solved.found }, solved.gap));
                }
                is_checked = true;
                continue;
            }
            if is_small || is_least {
                left = left.saturating_sub(1);
            }
            let falls = residual <= (T::one() - T::of(0.25) * self.part) * self.before;
            if !falls && !is_least && self.part > T::of(LEAST_PART) {
                self.halve(&target);
                continue;
            }
            (self.from, self.before) = (std::mem::take(&mut self.spreads), residual);
            (self.part, is_checked) = (T::one(), correction.spreads.len() > 1);
            target = correction.spreads;
            self.spreads.clone_from(&target);
            if !is_whole && residual < T::of(NEAR) {
                self.load_more();
            }
        }
        let (residual, solves) = (self.before, MAX_SOLVES);
        Err(SolveError::Bending { residual, solves, share: self.share }.into())
    }

    /// Refuses a contact that is wide beside the kernel, once it is nearly known.
    fn check_width(&self, solved: &Solve<'b, T>, residual: T) -> Result<(), ContactError<T>> {
        let thickness = T::of(0.5) * self.kernel.distance();
        let (ratio, limit) = (solved.found.interval.half_width() / thickness, T::of(THINNEST));
        let is_known = residual < T::of(NEAR) && self.share >= T::one();
        if ratio > limit && is_known || ratio > T::of(4.0) * limit {
            return Err(InputError::LayerTooThin { ratio, limit }.into());
        }
        Ok(())
    }

    /// Takes half of the part of the correction.
    fn halve(&mut self, target: &[Spread<T>]) {
        self.part *= T::of(0.5);
        let (less, part) = (T::one() - self.part, self.part);
        self.spreads.clear();
        self.spreads.extend(self.from.iter().map(|spread| spread.times(less)));
        self.spreads.extend(target.iter().map(|spread| spread.times(part)));
    }

    /// Goes on from a solve that failed: with less of the correction, or with a smaller load.
    fn retreat(
        &mut self,
        error: ContactError<T>,
        target: &[Spread<T>],
    ) -> Result<(), ContactError<T>> {
        use SolveError::{BudgetSpent, Cancelled};
        let ends = matches!(&error, ContactError::Solve(Cancelled { .. } | BudgetSpent { .. }));
        if ends || matches!(error, ContactError::Input(_)) || load(self.control).is_none() {
            return Err(error);
        }
        if !target.is_empty() && self.part > T::of(LEAST_PART) {
            self.halve(target);
            return Ok(());
        }
        let error = self.fault.take().unwrap_or(error);
        self.share *= T::of(0.5);
        if self.share < T::of(LEAST_SHARE) || !target.is_empty() {
            return Err(error);
        }
        self.fault = Some(error);
        self.spreads.clear();
        Ok(())
    }

    /// Doubles the load, up to the whole one, and the bend with it.
    fn load_more(&mut self) {
        let share = (T::of(2.0) * self.share).min(T::one());
        let factor = share / self.share;
        self.spreads.iter_mut().for_each(|spread| *spread = spread.times(factor));
        (self.share, self.before) = (share, T::one() / T::zero());
        self.from.clear();
    }

    /// Returns the control with the present share of the load.
    fn reduced(&self) -> Control<T> {
        let share = self.share;
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
    fn solve(&mut self, is_checked: bool) -> Result<Solve<'b, T>, ContactError<T>> {
        let kappa = self.contact.kappa;
        let bend = (!self.spreads.is_empty())
            .then(|| Arc::new(Bend::new(self.kernel, &self.spreads)));
        let gap = match &bend {
            Some(bend) => self.contact.gap.bent(bend, kappa)?,
            None => self.contact.gap.clone(),
        };
        let mut scene = self.contact.clone();
        scene.gap = gap.clone();
        scene.single_interval |= !is_checked;
        let control = self.reduced();
        let Work { integrator, workspace, cost } = &mut *self.work;
        **cost += integrator.cost();
        integrator.reset(false);
        (workspace.report, workspace.cell_work) = (Report::new(), 0);
        let found = find_under(&scene, control, self.work)?;
        self.work.keep(&gap.tilted(found.tilt), found.interval)?;
        let is_checked = is_checked || self.contact.single_interval;
        Ok(Solve { found, gap, bend, is_checked })
    }

    /// Corrects the pressures of a solve.
    fn correct(&mut self, solved: &Solve<'b, T>) -> Result<Option<Correction<T>>, ContactError<T>> {
        let (found, kappa) = (&solved.found, self.contact.kappa);
        let contacts = panels::contacts(self.work.integrator, &found.interval).to_vec();
        let gap = &solved.gap.tilted(found.tilt);
        let pressures = Solved { gap, integrator: &*self.work.integrator, kappa, found };
        let kept = match self.control {
            Control::HalfWidth(_) => Kept::Width,
            Control::PeakPressure(_) => Kept::Pressure(pressures.peak()?.x),
            Control::Moment { .. } | Control::CentreOfPressure { .. } => Kept::Moment(kappa),
            _ => Kept::Load,
        };
        let integrals = Integrals::new(pressures)?;
        let spread = |(i, &on): (usize, &Interval<T>)| {
            let [_, some, most] = self.kernel.terms(on);
            Ok(Spread { on, q: integrals.coefficients(i, [some, most])? })
        };
        let spreads = contacts.iter().enumerate().map(spread);
        let spreads = spreads.collect::<Result<Vec<_>, ContactError<T>>>()?;
        Ok(Correction::new(self.kernel, solved.bend.as_deref(), spreads, kept))
    }
}
