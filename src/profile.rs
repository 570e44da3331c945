//! Bodies as plane curves `[X(k), Y(k)]`.
//!
//! A profile is what the user writes: implement [`ParametricProfile`] for a struct, or wrap
//! a closure in a [`Curve`]. Smooth profiles are joined by [`Piecewise`]. The only shape
//! built in is the one that needs no curve: [`Flat`].

mod curve;
mod flat;
mod piece;
mod piecewise;

pub use curve::Curve;
pub use flat::Flat;
pub use piece::Piece;
pub(crate) use piece::turning_point;
pub use piecewise::{Piecewise, PiecewiseError};

use crate::Real;
use std::sync::Arc;
use thiserror::Error;

/// A point of a curve with the derivatives by the parameter.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvePoint<T> {
    /// `X(k)`, along the contact.
    pub x: T,
    /// `Y(k)`, across it; the upper body lies towards larger `Y`.
    pub y: T,
    /// `X'(k)`.
    pub dx: T,
    /// `Y'(k)`.
    pub dy: T,
}

/// A body's surface as a parametric curve over which `X` rises or falls strictly.
///
/// The parameter `k` needs no meaning, and `X` need not have an inverse in closed form. The
/// unit of `X` and `Y` is free, but the same for both bodies of a contact.
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
pub trait ParametricProfile<T: Real>: Send + Sync {
    /// The range of `k`, both ends finite, over which `X` rises or falls strictly.
    fn domain(&self) -> [T; 2];

    /// The point at `k`, with both derivatives: one call, so that what they share is
    /// computed once.
    fn at(&self, k: T) -> CurvePoint<T>;

    /// The slope `dY/dX` at `x`, where it can be had without inverting `X(k) = x`: the body
    /// is flat, or the graph of a function, or the inverse is known. `None` by default.
    ///
    /// Never asked outside the range of `X`.
    fn slope_at(&self, _x: T) -> Option<T> {
        None
    }

    /// The points at many parameters, for a curve that can be evaluated in a batch. By default
    /// one after the other.
    ///
    /// Both slices have the same length.
    fn at_many(&self, k: &[T], points: &mut [CurvePoint<T>]) {
        for (point, &k) in points.iter_mut().zip(k) {
            *point = self.at(k);
        }
    }

    /// How many smooth pieces a compound profile has; 0 (the default) for a profile that is
    /// smooth itself.
    fn pieces(&self) -> usize {
        0
    }

    /// A smooth piece of a compound profile, counted from the left; `None` beyond the last.
    fn piece(&self, _index: usize) -> Option<Piece<'_, T>> {
        None
    }

    /// `X(k)` alone.
    fn x(&self, k: T) -> T {
        self.at(k).x
    }

    /// `Y(k)` alone.
    fn y(&self, k: T) -> T {
        self.at(k).y
    }

    /// `X'(k)` alone.
    fn dx(&self, k: T) -> T {
        self.at(k).dx
    }

    /// `Y'(k)` alone.
    fn dy(&self, k: T) -> T {
        self.at(k).dy
    }
}

/// A pointer to a profile is one.
macro_rules! forward {
    ($($pointer:ty),*) => {$(
        impl<T: Real, P: ParametricProfile<T> + ?Sized> ParametricProfile<T> for $pointer {
            fn domain(&self) -> [T; 2] {
                (**self).domain()
            }
            fn at(&self, k: T) -> CurvePoint<T> {
                (**self).at(k)
            }
            fn slope_at(&self, x: T) -> Option<T> {
                (**self).slope_at(x)
            }
            fn at_many(&self, k: &[T], points: &mut [CurvePoint<T>]) {
                (**self).at_many(k, points)
            }
            fn pieces(&self) -> usize {
                (**self).pieces()
            }
            fn piece(&self, index: usize) -> Option<Piece<'_, T>> {
                (**self).piece(index)
            }
            fn x(&self, k: T) -> T {
                (**self).x(k)
            }
            fn y(&self, k: T) -> T {
                (**self).y(k)
            }
            fn dx(&self, k: T) -> T {
                (**self).dx(k)
            }
            fn dy(&self, k: T) -> T {
                (**self).dy(k)
            }
        }
    )*};
}
forward!(&P, Box<P>, Arc<P>);

/// What is wrong with a smooth curve.
#[derive(Clone, Copy, Debug, Error, PartialEq)]
pub enum ProfileError<T: Real> {
    /// The range of `k` is empty, reversed, or not finite.
    #[error(
        "k cannot run from {from:?} to {to:?}: the domain needs two finite ends in rising order, a finite distance apart"
    )]
    Domain {
        /// Start of the range.
        from: T,
        /// End of the range.
        to: T,
    },
    /// The curve returned NaN or an infinity.
    #[error("{quantity} is {value:?} at k = {k:?}: end the domain, or a piece, before this point")]
    NotFinite {
        /// `X`, `Y`, `X'` or the slope `Y'/X'`.
        quantity: &'static str,
        /// Where.
        k: T,
        /// What it is there.
        value: T,
    },
    /// A derivative is not that of its function.
    #[error(
        "{quantity} is {given:?} at k = {k:?}, but differences give {difference:?}: check the \
         formula of the derivative"
    )]
    Derivative {
        /// `X'` or `Y'`.
        quantity: &'static str,
        /// Where.
        k: T,
        /// What the profile says.
        given: T,
        /// The central difference.
        difference: T,
    },
    /// `X` does not rise, or fall, all the way.
    #[error(
        "X turns back at k = {k:?} (x = {x:?}): end the domain there, or make a piece of each side"
    )]
    TurnsBack {
        /// Parameter of the turning point, as near as it was found.
        k: T,
        /// `X` there.
        x: T,
    },
    /// A compound profile does not have the pieces that it says it has.
    #[error(
        "of {count} pieces, piece {index} (from 0, left to right) is missing, or does not start where \
         the one before ends: check piece() and pieces()"
    )]
    Pieces {
        /// How many pieces it says it has.
        count: usize,
        /// The first piece at fault.
        index: usize,
    },
}
