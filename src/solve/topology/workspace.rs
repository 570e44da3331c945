//! State that a search keeps from one solve to the next.

use super::super::exterior_field::ExteriorFields;
use super::super::newton::several::NewtonSeveral;
use super::super::signorini_check::{Overlaps, Passed, TensionSpans};
use crate::gap::{Asked, Cost, Gap, GapId, Survey};
use crate::kernel::Spread;
use crate::solution::Report;
use crate::{Fallible, Interval, Real};

/// Largest uncertainty of heights where the bodies may touch, as a share of F/κ, for a start.
const MAX_START_UNCERTAINTY: f64 = 0.25;

/// State that a search needs besides samples, kept from one solve to the next.
#[derive(Clone)]
pub(crate) struct Workspace<T> {
    /// Heights of the bodies, and the number of their gap.
    pub(in super::super) look: Survey<T>,
    pub(super) of: Option<GapId<T>>,
    /// Length of the narrowest feature of the last request.
    pub(super) resolution: Option<T>,
    pub(super) newton: NewtonSeveral<T>,
    pub(super) fields: ExteriorFields<T>,
    /// Contacts last found, and those from which Newton's method started.
    pub(super) last: Vec<Interval<T>>,
    /// Flag: a corner inside the bodies holds the first or the last of them.
    pub(in super::super) is_held: bool,
    pub(super) before: Vec<Interval<T>>,
    pub(super) passed: Passed<T>,
    /// Spans of tension in the solution checked last.
    pub(super) tension_spans: TensionSpans<T>,
    /// Dips in which the bodies would overlap in the solution checked last.
    pub(super) overlaps: Overlaps<T>,
    /// Cells times steps, summed over the active sets of this search.
    pub cell_work: usize,
    pub report: Report,
    /// Pressures that bend the bodies, of a scene with a kernel, and its bodies, of which the
    /// panels have samples.
    pub(in super::super) spreads: Vec<Spread<T>>,
    pub(in super::super) bent: Option<GapId<T>>,
}

impl<T: Real> Workspace<T> {
    pub fn new() -> Self {
        Self {
            look: Survey::new(),
            of: None,
            resolution: None,
            newton: NewtonSeveral::new(),
            fields: ExteriorFields::new(),
            last: Vec::new(),
            is_held: false,
            before: Vec::new(),
            passed: Passed::new(),
            tension_spans: TensionSpans::new(),
            overlaps: Overlaps::new(),
            cell_work: 0,
            report: Report::new(),
            spreads: Vec::new(),
            bent: None,
        }
    }

    /// Returns the survey, if it belongs to these bodies, bent as they are.
    pub fn survey_of(&self, gap: &Gap<'_, T>) -> Option<&Survey<T>> {
        (self.of == Some(gap.id()) && self.look.is_bent_as(gap)).then_some(&self.look)
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

    /// Returns an estimate of the load for this request, as F/κ.
    pub fn about(&mut self, gap: &Gap<'_, T>, asked: Asked<T>, cost: &mut Cost) -> Fallible<T, T> {
        self.take(gap, cost)?;
        Ok(self.look.load_of(gap, asked))
    }

    /// Forgets the searches for narrow features, and the solutions that have passed, if another
    /// resolution is requested.
    pub(in super::super) fn look_for_features(&mut self, gap: &Gap<'_, T>) {
        if self.resolution != gap.resolution() {
            self.resolution = gap.resolution();
            self.passed.clear();
            self.look.resolved = None;
        }
    }

    /// Surveys the bodies, once for each pair, and as closely as requested.
    pub fn look(
        &mut self,
        gap: &Gap<'_, T>,
        asked: Asked<T>,
        cost: &mut Cost,
    ) -> Fallible<T, &Survey<T>> {
        self.take(gap, cost)?;
        self.look.refine(gap, asked, T::of(MAX_START_UNCERTAINTY), cost)?;
        Ok(&self.look)
    }

    /// Takes a first look at the bodies, once for each pair.
    pub(super) fn take(&mut self, gap: &Gap<'_, T>, cost: &mut Cost) -> Fallible<T, ()> {
        if self.of != Some(gap.id()) {
            self.of = None;
            self.passed.clear();
            // Room for the check, which not all bodies need.
            self.fields.each.reserve(1);
            self.overlaps.closed_before.reserve(3);
            // The survey serves any tilt.
            self.look.take(&gap.tilted(T::zero()), cost)?;
            self.of = Some(gap.id());
        } else if !self.look.is_bent_as(gap) {
            self.passed.clear();
            self.look.bend(gap);
        }
        Ok(())
    }
}
