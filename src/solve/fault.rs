//! Reasons why a set of contacts is not the solution.

use crate::{ContactError, Real, Side};

/// Fault of a set of contacts, with all places of its kind.
pub(super) enum Fault<T: Real> {
    /// Tension inside the contacts, with its spans in the workspace.
    Tension(ContactError<T>),
    /// Overlap outside the contacts, with its dips in the workspace.
    Overlap(ContactError<T>),
    /// Flags: contacts that vanish, and contacts with a gap after them that closes.
    Gone { vanished: Vec<bool>, closed: Vec<bool> },
    /// End of the bodies that a limit passes, step after step.
    Beyond(Side),
    /// Limits that are not found.
    Failed,
    /// Error of a search that another set of contacts may avoid.
    Error(ContactError<T>),
    /// Error that no other set would avoid.
    Final(ContactError<T>),
}

impl<T: Real> From<ContactError<T>> for Fault<T> {
    fn from(error: ContactError<T>) -> Self {
        Self::Error(error)
    }
}
