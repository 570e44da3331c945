//! The two bodies of a reference file, built from the expressions in it.
//!
//! An infinite range of `k` is cut where `|X|` has reached four times the outermost `x` that the
//! file names, or 1000 if it names none. A body with `X = k`, `Y = 0` is [`Flat`], and is not cut.

#[path = "expression.rs"]
mod expression;

pub use expression::{Expression, Number, SyntaxError};

use linecontact::{CurvePoint, Flat, ParametricProfile, Piecewise, PiecewiseError};
use serde_json::Value;
use thiserror::Error;

/// Body of any kind.
pub type Body<T> = Box<dyn ParametricProfile<T>>;

/// Smooth piece of a body: four expressions in `k`, and its range.
pub struct Expressions<T: Number> {
    domain: [T; 2],
    x: Expression<T>,
    y: Expression<T>,
    dx: Expression<T>,
    dy: Expression<T>,
}

impl<T: Number> ParametricProfile<T> for Expressions<T> {
    fn domain(&self) -> [T; 2] {
        self.domain
    }

    fn at(&self, k: T) -> CurvePoint<T> {
        CurvePoint { x: self.x.at(k), y: self.y.at(k), dx: self.dx.at(k), dy: self.dy.at(k) }
    }

    fn x(&self, k: T) -> T {
        self.x.at(k)
    }

    fn y(&self, k: T) -> T {
        self.y.at(k)
    }

    fn dx(&self, k: T) -> T {
        self.dx.at(k)
    }

    fn dy(&self, k: T) -> T {
        self.dy.at(k)
    }
}

/// Reason why a body could not be built.
#[derive(Debug, Error)]
pub enum BodyError<T: Number> {
    /// Entry that the file lacks, or has not as text.
    #[error("no {0:?} in the file")]
    Missing(&'static str),
    /// Formula that cannot be read.
    #[error("the formula {text:?} cannot be read: {source}")]
    Formula {
        /// Text of the formula.
        text: String,
        /// Place and kind of the syntax error.
        source: SyntaxError,
    },
    /// Pieces that do not make a body.
    #[error(transparent)]
    Pieces(#[from] PiecewiseError<T>),
}

/// Builds the lower and the upper body of a file.
///
/// # Errors
/// [`BodyError`].
pub fn bodies<T: Number>(file: &Value) -> Result<[Body<T>; 2], BodyError<T>> {
    let reach = reach(file);
    Ok([body(&file["body1"], reach)?, body(&file["body2"], reach)?])
}

fn body<T: Number>(file: &Value, reach: T) -> Result<Body<T>, BodyError<T>> {
    let pieces = file["pieces"].as_array().ok_or(BodyError::Missing("pieces"))?;
    if let [piece] = &pieces[..] {
        let flat = ["X", "Y", "k_from", "k_to"].map(|key| piece[key].as_str().unwrap_or_default());
        return Ok(if flat == ["k", "0", "-inf", "inf"] {
            Box::new(Flat)
        } else {
            Box::new(part(piece, reach)?)
        });
    }
    let parts: Result<Vec<_>, _> = pieces.iter().map(|piece| part(piece, reach)).collect();
    Ok(Box::new(Piecewise::new(parts?)?))
}

fn part<T: Number>(piece: &Value, reach: T) -> Result<Expressions<T>, BodyError<T>> {
    let text = |key| piece[key].as_str().ok_or(BodyError::Missing(key));
    let x = formula(text("X")?)?;
    Ok(Expressions {
        domain: [end(text("k_from")?, &x, reach)?, end(text("k_to")?, &x, reach)?],
        y: formula(text("Y")?)?,
        dx: formula(text("dX")?)?,
        dy: formula(text("dY")?)?,
        x,
    })
}

fn formula<T: Number>(text: &str) -> Result<Expression<T>, BodyError<T>> {
    Expression::new(text).map_err(|source| BodyError::Formula { text: text.into(), source })
}

/// Returns an end of `k`. The text is a decimal, rounded once; a constant formula such as `-1/3`;
/// or infinite: then `k` is doubled on that side until `|X|` has reached `reach`.
fn end<T: Number>(text: &str, x: &Expression<T>, reach: T) -> Result<T, BodyError<T>> {
    let Ok(end) = text.parse::<T>() else {
        return Ok(formula(text)?.at(T::zero()));
    };
    if end.is_finite() {
        return Ok(end);
    }
    let mut k = reach.copysign(end);
    while k.is_finite() && x.at(k).abs() < reach {
        k += k;
    }
    Ok(k)
}

/// Returns the length at which an infinite body is cut.
fn reach<T: Number>(file: &Value) -> T {
    let list = |key: &str| file[key].as_array().cloned().unwrap_or_default();
    let mut named = vec![file["a"].clone(), file["b"].clone()];
    named.extend(list("breakpoints_x"));
    named.extend(list("points").iter().map(|point| point[0].clone()));
    let numbers = named.iter().filter_map(|x| x.as_str()?.parse::<T>().ok());
    let outermost = numbers.fold(T::zero(), |most, x| most.max(x.abs()));
    if outermost > T::zero() { T::of(4.0) * outermost } else { T::of(1000.0) }
}
