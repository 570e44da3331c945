//! Errors of questions to a solution.

use super::advice::how_to_cover;
use crate::rounded::{apart, six, span};
use crate::{Interval, Real};
use thiserror::Error;

/// Reason why a quantity of a known contact is not available. Every variant names the place and the
/// values.
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum EvaluationError<T: Real> {
    /// A quantity was asked for where the pressure is infinite: at a fixed or adhesive edge, at an
    /// edge where Eq. (6) has left a singularity, or where the slope of a body jumps.
    #[error("the pressure at x = {} is infinite; ask beside it, or for edge_singularities()", six(*x))]
    Singular {
        /// Abscissa asked for.
        x: T,
    },
    /// A point is above the surface, or not finite.
    #[error("no stress at x = {}, depth {}: both must be finite, the depth not negative", six(*x), six(*depth))]
    AboveSurface {
        /// Abscissa.
        x: T,
        /// Depth below the surface.
        depth: T,
    },
    /// There is no elastic material at some depths.
    #[error("no stress at depths from {} to {}: they begin at 0, on the surface, rise, and end at a rigid base",
        apart(depths[0], &[depths[1]]), apart(depths[1], &[depths[0]]))]
    NoStress {
        /// Depths asked for, twice the same if it is one.
        depths: [T; 2],
    },
    /// The table of a spring does not cover this approach.
    #[error(
        "the points of the table have approaches from {}, not {}: {}",
        span(range[0], range[1]), apart(*approach, range), how_to_cover(*approach, "make it for larger loads")
    )]
    OutsideTable {
        /// Approach as given.
        approach: T,
        /// Least and largest approach of the points of the table.
        range: [T; 2],
    },
    /// The table of a spring does not cover the slice of a roller that is pressed most.
    #[error(
        "the slice at z = {}, pressed most, has an approach of {}, and the points of the table those from {}: {}",
        six(*z), apart(*approach, range), span(range[0], range[1]),
        how_to_cover(*approach, "make it for larger loads, or lower approach, load or misalignment")
    )]
    SliceOutsideTable {
        /// Place of the slice along the axis, from the middle of the roller: a length.
        z: T,
        /// Approach of this slice, the largest of all.
        approach: T,
        /// Least and largest approach of the points of the table.
        range: [T; 2],
    },
    /// A point is not inside the contact, or not outside it, as required.
    #[error(
        "x = {} must lie {}side the contact from {}",
        apart(*x, &[interval.left, interval.right]), if *inside { "in" } else { "out" },
        span(interval.left, interval.right)
    )]
    InvalidPosition {
        /// Abscissa of the point.
        x: T,
        /// True if the point must be strictly inside.
        inside: bool,
        /// Contact.
        interval: Interval<T>,
    },
    /// The formula of a quantity is for half-planes, and the bodies have layers, a period or
    /// another kernel.
    #[error("{quantity} is not known of bodies with a layer, a period or another kernel")]
    HalfPlanesOnly {
        /// Name of the quantity.
        quantity: &'static str,
    },
    /// The derivatives of the contact by the load are not known.
    #[error("the derivatives by the load are not known: {why}")]
    NoLoadDerivative {
        /// Reason, for the message.
        why: &'static str,
    },
    /// The uncertainty by the noise of measured points is not known.
    #[error("the uncertainty by the noise of measured points is not known: {why}")]
    NoUncertainty {
        /// Reason, for the message.
        why: &'static str,
    },
    /// The number of places for pressures is not the number of abscissae.
    #[error("{x} abscissae, but {pressures} places for pressures: give as many of both")]
    LengthMismatch {
        /// Number of abscissae.
        x: usize,
        /// Number of places for pressures.
        pressures: usize,
    },
    /// An integral over the pressure has not converged.
    #[error(
        "an integral over the pressure for x = {x} has not converged in {panels} panels: the \
         pressure is too rough; set a looser tolerance or a finer quadrature", x = six(*x)
    )]
    Integral {
        /// Abscissa for which the integral was taken.
        x: T,
        /// Number of panels tried.
        panels: usize,
    },
    /// The quadrature has no correct digit of the pressure: `x` is too close to an edge for its
    /// segments.
    #[error(
        "the pressure at x = {x} is not resolved: {pressure} with an error of about \
         {error}; take more segments, or stay further away from the edge",
        x = six(*x), pressure = six(*pressure), error = six(*error)
    )]
    Unresolved {
        /// Abscissa asked for.
        x: T,
        /// Pressure by the quadrature.
        pressure: T,
        /// Estimated error of this pressure.
        error: T,
    },
}
