//! What a solve went through.

use crate::ContactError;
use crate::Real;

/// The most attempts that are told apart; of more the last is kept.
const MOST: usize = 12;

/// The starts that a solve has tried, in their order, and what became of each.
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
    attempts: [Attempt; MOST],
    count: usize,
}

/// One start, and what became of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Attempt {
    /// Where the contacts were sought.
    pub start: Start,
    /// What the checks say of what was found.
    pub outcome: Outcome,
}

/// Where contacts were sought.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Start {
    /// From the middle of the bodies towards their lowest gap: they say that they bulge towards
    /// each other, or [a single interval](crate::Contact::single_interval) was asked for. Or
    /// between two corners, where nothing is to be sought.
    Middle,
    /// At the lowest gap between the bodies.
    LowestGap,
    /// Where the user said, by [`Contact::start`](crate::Contact::start).
    Given,
    /// Around the line in which the load is to act.
    LineOfLoad,
    /// Where the solver found them last.
    Last,
    /// Where a coarse active set on cells of constant pressure has them.
    ActiveSet,
    /// Where the attempt before has left them.
    Attempt,
}

/// What became of a attempt.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub enum Outcome {
    /// It is the contact: corners press, the pressure is nowhere negative and the bodies do not
    /// overlap, as far as they were looked at. Bodies that [bulge](crate::profile::Convexity)
    /// towards each other need no look, and where an edge is adhesive they may pull.
    Passed,
    /// It solves the equations, and nobody asked for more: the edges are by the paper's Eq. (6), or
    /// [a single interval](crate::Contact::single_interval) was asked for.
    Unchecked,
    /// It meets the conditions of the contact so roughly that no check says anything: a limit is in
    /// doubt by more than a 1600th of the half-width
    /// ([`Solution::limits_error`](crate::Solution::limits_error)), as from a search that stops
    /// early or from a coarse quadrature.
    Doubtful,
    /// The bodies would pull at each other inside.
    Tension,
    /// The bodies would overlap outside.
    Overlap,
    /// Two contacts became one.
    Merged,
    /// A contact vanished.
    Lost,
    /// A contact reached a corner.
    ReachedCorner,
    /// No limits were found.
    NotFound,
}

impl Outcome {
    pub(crate) fn of<T: Real>(error: &ContactError<T>) -> Self {
        match error {
            ContactError::Tension { .. } => Self::Tension,
            ContactError::Overlap { .. } => Self::Overlap,
            _ => Self::NotFound,
        }
    }
}

impl Report {
    pub(crate) fn new() -> Self {
        let attempt = Attempt { start: Start::Middle, outcome: Outcome::NotFound };
        Self { attempts: [attempt; MOST], count: 0 }
    }

    pub(crate) fn add(&mut self, start: Start, outcome: Outcome) {
        self.count = (self.count + 1).min(MOST);
        self.attempts[self.count - 1] = Attempt { start, outcome };
    }

    /// Takes back that the last attempt has passed.
    pub(crate) fn doubt(&mut self) {
        if let Some(Attempt { outcome, .. }) = self.attempts[..self.count].last_mut()
            && *outcome == Outcome::Passed
        {
            *outcome = Outcome::Doubtful;
        }
    }

    /// The attempts, the last of which has led to the solution.
    #[must_use]
    pub fn attempts(&self) -> &[Attempt] {
        &self.attempts[..self.count]
    }

    /// Whether the solution was checked, and is the contact as far as the checks can see.
    #[must_use]
    pub fn is_checked(&self) -> bool {
        self.attempts().last().is_some_and(|attempt| attempt.outcome == Outcome::Passed)
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
