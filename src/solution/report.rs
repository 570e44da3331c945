//! Report of a solve: its attempts and their outcomes.

use crate::Real;
use crate::{ContactError, Fallible, SolveError};

/// Largest number of attempts kept; of more, the last replaces the one before.
const MAX_ATTEMPTS: usize = 12;

/// Starts that a solve has tried, in their order, and the outcome of each.
///
/// ```
/// use linecontact::profile::Parabola;
/// use linecontact::{Contact, Control, Flat, Start, Attempt, Outcome};
///
/// let body = Parabola::new(1.0f64, [-1.0, 1.0])?;
/// let solution = Contact::new(&Flat, &body)?.solve(Control::Load(0.02))?;
/// let report = solution.report();
/// assert!(report.is_checked());
/// // Bodies that bulge towards each other touch in one interval, and one start is enough.
/// assert_eq!(report.attempts(), [Attempt { start: Start::Middle, outcome: Outcome::Passed }]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(from = "Vec<Attempt>", into = "Vec<Attempt>"))]
pub struct Report {
    attempts: [Attempt; MAX_ATTEMPTS],
    count: usize,
}

/// One start, and its outcome.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Attempt {
    /// Place where the contacts were sought.
    pub start: Start,
    /// Result of the checks.
    pub outcome: Outcome,
}

/// Place where contacts were sought.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Start {
    /// Middle of the bodies, from where the search goes to their lowest gap: the bodies declare
    /// that they bulge towards each other, or [a single interval](crate::Contact::single_interval)
    /// was asked for. Also used between two corners, where both limits are known.
    Middle,
    /// Lowest gap between the bodies.
    LowestGap,
    /// Interval set by the user, with [`Contact::start`](crate::Contact::start).
    Given,
    /// Surroundings of the line along which the load is to act.
    LineOfLoad,
    /// Contacts of the solver's last solution.
    Last,
    /// Contacts of a coarse active set on cells of constant pressure.
    ActiveSet,
    /// Contacts that the previous attempt has left.
    Attempt,
}

/// Outcome of an attempt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Outcome {
    /// Contact found: corners press, the pressure is nowhere negative and the bodies do not
    /// overlap, as far as they were checked. Bodies that [bulge](crate::profile::Convexity) towards
    /// each other need no check, and where an edge is adhesive they may pull.
    Passed,
    /// Solution without further checks: the edges are by the paper's Eq. (6), or [a single
    /// interval](crate::Contact::single_interval) was asked for.
    Unchecked,
    /// Solution too rough for any check to decide: a limit is uncertain by more than a 1600th of
    /// the half-width ([`Solution::limits_error`](crate::Solution::limits_error)), as from a search
    /// that stops early or from a coarse quadrature; or the pressures do not tell whether bodies
    /// overlap, as next to corners that are no breakpoints.
    Doubtful,
    /// Tension between the bodies inside a contact.
    Tension,
    /// Overlap of the bodies outside the contacts.
    Overlap,
    /// Merger of two contacts.
    Merged,
    /// Loss of a contact.
    Lost,
    /// Contact that reached a corner.
    ReachedCorner,
    /// Bodies that no load presses together, or that are apart
    /// ([`Solution::is_apart`](crate::Solution::is_apart)).
    Apart,
    /// Failure: no limits were found.
    NotFound,
}

impl Outcome {
    pub(crate) fn of<T: Real>(error: &ContactError<T>) -> Self {
        match error {
            ContactError::Solve(SolveError::Tension { .. }) => Self::Tension,
            ContactError::Solve(SolveError::Overlap { .. }) => Self::Overlap,
            _ => Self::NotFound,
        }
    }
}

impl Report {
    pub(crate) fn new() -> Self {
        let attempt = Attempt { start: Start::Middle, outcome: Outcome::NotFound };
        Self { attempts: [attempt; MAX_ATTEMPTS], count: 0 }
    }

    /// Ends an attempt: enters its outcome, and returns its result.
    pub(crate) fn end<T: Real, R>(
        &mut self,
        start: Start,
        attempt: Fallible<T, (Outcome, R)>,
    ) -> Fallible<T, R> {
        let outcome = attempt.as_ref().map_or_else(Outcome::of, |&(outcome, _)| outcome);
        self.add(start, outcome);
        attempt.map(|(_, result)| result)
    }

    /// Enters an attempt.
    pub(crate) fn add(&mut self, start: Start, outcome: Outcome) {
        self.count = (self.count + 1).min(MAX_ATTEMPTS);
        self.attempts[self.count - 1] = Attempt { start, outcome };
    }

    /// Marks the last attempt as doubtful, if it has passed.
    pub(crate) fn doubt(&mut self) {
        if let Some(Attempt { outcome, .. }) = self.attempts[..self.count].last_mut()
            && *outcome == Outcome::Passed
        {
            *outcome = Outcome::Doubtful;
        }
    }

    /// Returns the attempts; the last one has led to the solution.
    #[must_use]
    pub fn attempts(&self) -> &[Attempt] {
        &self.attempts[..self.count]
    }

    /// Tells whether the solution was checked, and is the contact as far as the checks can see.
    #[must_use]
    pub fn is_checked(&self) -> bool {
        let is_checked = |at: &Attempt| matches!(at.outcome, Outcome::Passed | Outcome::Apart);
        self.attempts().last().is_some_and(is_checked)
    }
}

impl std::fmt::Debug for Report {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Report").field("attempts", &self.attempts()).finish()
    }
}

#[cfg(feature = "serde")]
impl From<Vec<Attempt>> for Report {
    fn from(attempts: Vec<Attempt>) -> Self {
        let mut report = Self::new();
        attempts.into_iter().for_each(|Attempt { start, outcome }| report.add(start, outcome));
        report
    }
}

#[cfg(feature = "serde")]
impl From<Report> for Vec<Attempt> {
    fn from(report: Report) -> Self {
        report.attempts().to_vec()
    }
}
