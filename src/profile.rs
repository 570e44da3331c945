//! Bodies as plane curves `[X(k), Y(k)]`.
//!
//! A profile is written by the user: implement [`ParametricProfile`] for a struct, or wrap a
//! closure in a [`Curve`]. Smooth profiles are joined by [`Piecewise`].
//!
//! Common shapes are here, with exact derivatives and with heights and slopes that keep their
//! digits where a formula would cancel:
//!
//! | shape | `Y` | parameter |
//! |---|---|---|
//! | [`Flat`] | 0 | `X`; no ends |
//! | [`Line`] | `m X` | `X` |
//! | [`Parabola`] | `X²/(2R)` | `X` |
//! | [`Ellipse`], [`circle`](Ellipse::circle) | `B (1 - sqrt(1 - X²/A²))` | angle from the vertex |
//! | [`Involute`] | flank of a gear tooth | angle rolled off |
//! | [`Crowning`] | `-C ln(1 - X²/l²)` | `X` |
//! | [`wedge`] | two lines | joined |
//! | [`rounded_punch`] | a flat between two half parabolas | joined |
//! | [`Outline`] | lines and arcs from a drawing | joined |
//! | [`Spline`] | through measured points, or near them | `X`, joined |
//!
//! Each vertex is at the origin; convex shapes open upwards. [`Placed`] moves, turns, mirrors,
//! flips and scales a shape; [`Piecewise::placed`] does so with a joined one.
//!
//! With the feature `serde` the smooth shapes can be kept in files, under the names of their
//! constructors' arguments, and with the feature `scene` all of them, joined and placed ones too,
//! as a `scene::PlacedShape`. A shape read from a file is made by its constructor, with the same
//! errors:
//!
//! ```
//! # #[cfg(feature = "serde")] {
//! use linecontact::profile::Parabola;
//!
//! let read = |text| serde_json::from_str::<Parabola<f64>>(text);
//! let body = read(r#"{"radius": 2.0, "domain": [-1.0, 1.0]}"#)?;
//! assert_eq!(body, Parabola::new(2.0, [-1.0, 1.0])?);
//! let refused = read(r#"{"radius": 0.0, "domain": [-1.0, 1.0]}"#).unwrap_err();
//! assert_eq!(refused.to_string(), "the radius is 0: it must be finite and not zero");
//! # }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod convexity;
mod crowning;
mod curve;
mod derivatives;
mod ellipse;
mod flat;
mod involute;
mod line;
mod noise;
mod outline;
mod parabola;
mod piece;
mod piecewise;
mod placed;
mod rounded_punch;
mod spline;
#[cfg(feature = "serde")]
pub(crate) mod stored;

pub use convexity::Convexity;
pub use crowning::Crowning;
pub(crate) use crowning::relief;
pub use curve::Curve;
pub use derivatives::check_derivatives;
pub use ellipse::Ellipse;
pub use flat::Flat;
pub use involute::Involute;
pub use line::{Line, wedge};
pub(crate) use noise::Noise;
pub use outline::{Outline, Segment};
pub use parabola::Parabola;
pub use piece::Piece;
pub(crate) use piece::first_turn;
pub use piecewise::{Piecewise, PiecewiseError};
pub use placed::{Placed, Placement};
pub use rounded_punch::rounded_punch;
pub use spline::{Fit, Spline, SplineError};

use crate::Real;
use crate::rounded::{six, span};
use std::sync::Arc;
use thiserror::Error;

/// Point of a curve with the derivatives by the parameter.
///
/// ```
/// use linecontact::{Curve, CurvePoint, ParametricProfile};
///
/// // A circle of radius 2 by its angle.
/// let arc = Curve::new([-1.0, 1.0], |k: f64| {
///     let (sin, cos) = k.sin_cos();
///     CurvePoint { x: 2.0 * sin, y: 2.0 - 2.0 * cos, dx: 2.0 * cos, dy: 2.0 * sin }
/// });
/// let CurvePoint { dx, dy, .. } = arc.at(0.3);
/// assert!((dy / dx - 0.3f64.tan()).abs() < 1e-15);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct CurvePoint<T> {
    /// Abscissa `X(k)`, along the contact.
    pub x: T,
    /// Height `Y(k)`, across the contact; the upper body lies towards larger `Y`.
    pub y: T,
    /// Derivative `X'(k)`.
    pub dx: T,
    /// Derivative `Y'(k)`.
    pub dy: T,
}

/// Surface of a body as a parametric curve over which `X` rises or falls strictly.
///
/// The parameter `k` needs no meaning, and `X` need not have an inverse in closed form. The unit of
/// `X` and `Y` is free, but the same for both bodies of a contact.
///
/// A profile is a pure function of `k`: the solver may call it in any order and, because it
/// is `Sync`, from several threads.
///
/// ```
/// use linecontact::{CurvePoint, ParametricProfile};
///
/// /// The lower half of a circle of radius `r`, by the angle from its lowest point.
/// struct Roller { r: f64 }
///
/// impl ParametricProfile<f64> for Roller {
///     fn domain(&self) -> [f64; 2] {
///         [-1.5, 1.5]
///     }
///     fn at(&self, k: f64) -> CurvePoint<f64> {
///         let (sin, cos) = k.sin_cos();
///         CurvePoint { x: self.r * sin, y: -self.r * cos, dx: self.r * cos, dy: self.r * sin }
///     }
/// }
/// ```
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a profile: it has no `ParametricProfile<{T}>`",
    label = "not a profile",
    note = "implement `ParametricProfile<{T}>` for a struct, or wrap a closure: `Curve::new([from, to], closure)`",
    note = "both bodies of a contact, its loads and edges have one number type"
)]
pub trait ParametricProfile<T: Real>: Send + Sync {
    /// Returns the range of `k`, both ends finite, over which `X` rises or falls strictly.
    fn domain(&self) -> [T; 2];

    /// Returns the point at `k` with both derivatives, in one call, so that common terms are
    /// computed once. At an end of the domain the derivatives are one-sided, from inside. A wrong
    /// one there (`signum` at 0, say) costs hundreds of evaluations.
    fn at(&self, k: T) -> CurvePoint<T>;

    /// Returns the slope `dY/dX` at `x`, if it is known without inverting `X(k) = x`: the body is
    /// flat, or the graph of a function, or the inverse is known. `None` by default.
    ///
    /// Never called outside the range of `X`.
    fn slope_at(&self, _x: T) -> Option<T> {
        None
    }

    /// Evaluates the points at many parameters, for a curve that can be evaluated in a batch. By
    /// default one after the other.
    ///
    /// Both slices have the same length.
    fn at_many(&self, k: &[T], points: &mut [CurvePoint<T>]) {
        for (point, &k) in points.iter_mut().zip(k) {
            *point = self.at(k);
        }
    }

    /// Returns the direction in which the body bulges. Two bodies that bulge towards each other
    /// touch in one interval, and the solver need not look for others. [`Convexity::Unknown`] by
    /// default.
    fn convexity(&self) -> Convexity {
        Convexity::Unknown
    }

    /// Returns the standard deviation that noise of a measurement leaves in `Σ wᵢ dY/dX(xᵢ)`, given
    /// the xᵢ and the wᵢ; `None` if it is not known. By default the curve is exact: 0.
    fn slope_deviation(&self, _x: &[T], _weights: &[T]) -> Option<T> {
        Some(T::zero())
    }

    /// Returns the number of smooth pieces of a compound profile; 0 (the default) for a profile
    /// that is smooth itself.
    fn pieces(&self) -> usize {
        0
    }

    /// Returns a smooth piece of a compound profile, counted from the left; `None` beyond the last.
    fn piece(&self, _index: usize) -> Option<Piece<'_, T>> {
        None
    }

    /// Returns `X(k)` alone.
    fn x(&self, k: T) -> T {
        self.at(k).x
    }

    /// Returns `Y(k)` alone.
    fn y(&self, k: T) -> T {
        self.at(k).y
    }

    /// Returns `X'(k)` alone.
    fn dx(&self, k: T) -> T {
        self.at(k).dx
    }

    /// Returns `Y'(k)` alone.
    fn dy(&self, k: T) -> T {
        self.at(k).dy
    }
}

/// Implements the trait for pointers to profiles.
macro_rules! forward {
    ($($name:ident($($argument:ident: $type:ty),*) $(-> $result:ty)?;)*) => {
        forward!(&P: $($name($($argument: $type),*) $(-> $result)?;)*);
        forward!(Box<P>: $($name($($argument: $type),*) $(-> $result)?;)*);
        forward!(Arc<P>: $($name($($argument: $type),*) $(-> $result)?;)*);
    };
    ($pointer:ty: $($name:ident($($argument:ident: $type:ty),*) $(-> $result:ty)?;)*) => {
        impl<T: Real, P: ParametricProfile<T> + ?Sized> ParametricProfile<T> for $pointer {
            $(fn $name(&self, $($argument: $type),*) $(-> $result)? {
                (**self).$name($($argument),*)
            })*
        }
    };
}
forward! {
    domain() -> [T; 2]; at(k: T) -> CurvePoint<T>; slope_at(x: T) -> Option<T>;
    at_many(k: &[T], points: &mut [CurvePoint<T>]); convexity() -> Convexity;
    slope_deviation(x: &[T], weights: &[T]) -> Option<T>;
    pieces() -> usize; piece(index: usize) -> Option<Piece<'_, T>>;
    x(k: T) -> T; y(k: T) -> T; dx(k: T) -> T; dy(k: T) -> T;
}

/// Refuses a parameter of a shape that is not finite, or where `holds` is false.
pub(crate) fn finite<T: Real>(
    name: &'static str,
    value: T,
    holds: bool,
    must: &'static str,
) -> Result<(), ProfileError<T>> {
    if holds && value.is_finite() {
        Ok(())
    } else {
        Err(ProfileError::Parameter { name, value, must })
    }
}

/// Refuses a value of a curve that is not finite.
fn finite_at<T: Real>(quantity: &'static str, k: T, value: T) -> Result<T, ProfileError<T>> {
    if value.is_finite() { Ok(value) } else { Err(ProfileError::NotFinite { quantity, k, value }) }
}

/// Returns a range of `k`, checked.
fn interval<T: Real>([from, to]: [T; 2]) -> Result<[T; 2], ProfileError<T>> {
    if from.is_finite() && to.is_finite() && (to - from).is_finite() && from < to {
        Ok([from, to])
    } else {
        Err(ProfileError::Domain { from, to })
    }
}

/// Fault of a smooth curve.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum ProfileError<T: Real> {
    /// A parameter has a value for which the shape does not exist.
    #[error("{name} is {value}: it must be {must}", value = six(*value))]
    Parameter {
        /// Name of the parameter.
        name: &'static str,
        /// Value of the parameter.
        value: T,
        /// Condition on the parameter.
        must: &'static str,
    },
    /// A profile has several pieces where a smooth one is required.
    #[error(
        "the profile is joined from {pieces} pieces, which would be lost: use Piecewise::placed"
    )]
    Joined {
        /// Number of pieces.
        pieces: usize,
    },
    /// The range of `k` is empty, reversed, or not finite.
    #[error(
        "k cannot run from {from} to {to}: the domain needs two finite ends in rising order, a finite distance apart",
        from = six(*from), to = six(*to)
    )]
    Domain {
        /// Start of the range.
        from: T,
        /// End of the range.
        to: T,
    },
    /// The curve returned NaN or an infinity.
    #[error("{quantity} is {} at k = {}: end the domain, or a piece, before this point", six(*value), six(*k))]
    NotFinite {
        /// Name of the quantity: `X`, `Y`, `X'`, `Y'`, the slope `Y'/X'` or `slope_at(x)`.
        quantity: &'static str,
        /// Parameter of the point.
        k: T,
        /// Value of the quantity there.
        value: T,
    },
    /// A derivative does not match its function.
    #[error(
        "{quantity} is {given} at k = {k}, but differences give {difference}: check the \
         formula of the derivative", given = six(*given), k = six(*k), difference = six(*difference)
    )]
    Derivative {
        /// Name of the derivative: `X'`, `Y'` or `slope_at(x)`.
        quantity: &'static str,
        /// Parameter of the point.
        k: T,
        /// Derivative given by the profile.
        given: T,
        /// Derivative by differences.
        difference: T,
    },
    /// `X` does not rise, or fall, all the way.
    #[error(
        "X turns back at k = {k} (x = {x}) in the domain from {}: end the domain there, or make a \
         piece of each side; if a wall is turned so far that it overhangs, slant it (in an outline, a corner and a line){}",
        span(domain[0], domain[1]), in_degrees(*domain), k = six(*k), x = six(*x)
    )]
    TurnsBack {
        /// Parameter of the turning point, as closely as it was found.
        k: T,
        /// `X` there.
        x: T,
        /// Domain of the curve.
        domain: [T; 2],
    },
    /// A compound profile does not have the pieces that it declares.
    #[error(
        "pieces() is {count}, but piece({index}) {}: count them from 0, from left to right",
        if index < count { "is missing, or does not start where the one before ends" }
        else { "is there, too" }
    )]
    Pieces {
        /// Number of pieces declared.
        count: usize,
        /// Index of a faulty piece.
        index: usize,
    },
}

/// Returns a question about degrees, for a parameter whose range has 90, 180 or 360 units.
fn in_degrees<T: Real>([from, to]: [T; 2]) -> &'static str {
    let length = (to - from).abs();
    let is_angle = [90.0, 180.0, 360.0].into_iter().any(|degrees| length == T::of(degrees));
    if is_angle { " (is the parameter in degrees? sin and cos take radians)" } else { "" }
}
