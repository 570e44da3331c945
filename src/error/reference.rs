//! Errors of closed forms.

use crate::Real;
use crate::rounded::six;
use thiserror::Error;

/// Reason why a closed form does not exist.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum ReferenceError<T: Real> {
    /// Parameter outside the range in which the form holds.
    #[error("{name} is {value}: it must be {must}", value = six(*value))]
    Parameter {
        /// Name of the parameter.
        name: &'static str,
        /// Value of the parameter.
        value: T,
        /// Condition on the parameter.
        must: &'static str,
    },
    /// Tensile load that adhesion cannot bear.
    #[error("no contact under the load {}: the bodies come apart at {}", six(*load), six(*least))]
    PullOff {
        /// Load per unit length.
        load: T,
        /// Load at pull-off.
        least: T,
    },
}
