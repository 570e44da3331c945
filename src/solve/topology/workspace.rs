//! The state that a search keeps from one solve to the next.

use super::super::exterior_field::ExteriorField;
use super::super::newton::several::NewtonSeveral;
use super::super::signorini_check::{Overlaps, Passed, TensionSpans};
use crate::gap::{Asked, Cost, Gap, Survey};
use crate::solution::Report;
use crate::{ContactError, Interval, Real};

/// The share of F/κ by which heights may be uncertain where the bodies may touch, to start from.
const ROUGHLY: f64 = 0.25;

/// What a search needs besides samples, kept from one solve to the next.
#[derive(Clone)]
pub(crate) struct Workspace<T> {
    /// Heights of the bodies, with the number of the gap that they are of.
    pub(super) look: Survey<T>,
    pub(super) of: Option<u64>,
    /// The length of the narrowest feature that was asked for last.
    pub(super) resolution: Option<T>,
    pub(super) newton: NewtonSeveral<T>,
    pub(super) fields: Vec<ExteriorField<T>>,
    /// The contacts last found, and those that Newton's method started from.
    pub(super) last: Vec<Interval<T>>,
    pub(super) before: Vec<Interval<T>>,
    pub(super) passed: Passed<T>,
    /// Where the bodies would pull at each other in what was checked last.
    pub(super) tension_spans: TensionSpans<T>,
    /// Dips in which they would overlap.
    pub(super) overlaps: Overlaps<T>,
    /// Cells times steps of the active sets of the search so far.
    pub cell_work: usize,
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
            cell_work: 0,
            report: Report::new(),
        }
    }

    /// Returns the survey, if it is one of these bodies.
    pub fn survey_of(&self, gap: &Gap<'_, T>) -> Option<&Survey<T>> {
        (self.of == Some(gap.number())).then_some(&self.look)
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
    pub(super) fn look_for_features(&mut self, gap: &Gap<'_, T>) {
        if self.resolution != gap.resolution() {
            self.resolution = gap.resolution();
            self.passed.clear();
            self.look.look_again();
        }
    }

    /// Surveys the bodies, once for a pair of them and as closely as is asked for.
    pub fn look(
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
    pub(super) fn take(
        &mut self,
        gap: &Gap<'_, T>,
        cost: &mut Cost,
    ) -> Result<(), ContactError<T>> {
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
