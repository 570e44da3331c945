//! Bodies by their parameters.

use crate::profile::stored::Pair;
use crate::profile::{
    Crowning, Ellipse, Fit, Involute, Line, Parabola, Placed, Placement, Spline, rounded_punch,
    wedge,
};
use crate::{ContactError, Flat, ParametricProfile, Piecewise, Real};
use serde::{Deserialize, Deserializer, Serialize, de};
use std::sync::Arc;

/// Body that a file can hold: a shape, and the steps that place it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(
    deny_unknown_fields,
    bound(serialize = "T: Real + Serialize", deserialize = "T: Real + Deserialize<'de>")
)]
pub struct PlacedShape<T> {
    /// Shape, with its vertex at the origin.
    pub shape: Shape<T>,
    /// Steps that place it, the first one first.
    #[serde(default = "Vec::new", skip_serializing_if = "Vec::is_empty")]
    pub steps: Vec<Step<T>>,
}

/// Shape by its parameters, under the names of its constructor's arguments.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(
    deny_unknown_fields,
    rename_all = "snake_case",
    bound(serialize = "T: Real + Serialize", deserialize = "T: Real + Deserialize<'de>")
)]
#[non_exhaustive]
pub enum Shape<T> {
    /// Level line without ends.
    Flat,
    /// Straight line.
    Line(Line<T>),
    /// Parabola.
    Parabola(Parabola<T>),
    /// Arc of an ellipse or a circle.
    Ellipse(Ellipse<T>),
    /// Flank of a gear tooth.
    Involute(Involute<T>),
    /// Logarithmic crowning.
    Crowning(Crowning<T>),
    /// Two flanks: [`wedge`].
    Wedge {
        /// Slopes of the left and the right flank.
        #[serde(deserialize_with = "pair")]
        slopes: [T; 2],
        /// Length to which the flanks reach, on either side.
        reach: T,
    },
    /// Flat between two half parabolas: [`rounded_punch`].
    RoundedPunch {
        /// Half of the flat, a length.
        flat: T,
        /// Radius of the edges, a length.
        radius: T,
        /// Length to which the edges reach, on either side.
        reach: T,
    },
    /// Measured points: [`Spline::fitted`].
    Spline {
        /// Points `[x, y]` in order of rising x.
        #[serde(deserialize_with = "pairs")]
        points: Vec<[T; 2]>,
        /// Settings of the fit.
        #[serde(default)]
        fit: Fit<T>,
    },
    /// Pieces from left to right: [`Piecewise::new`].
    Piecewise {
        /// Pieces; each may be joined itself.
        parts: Vec<PlacedShape<T>>,
        /// Tolerance of the joints: [`Piecewise::with_tolerance`].
        #[serde(default, skip_serializing_if = "Option::is_none")]
        tolerance: Option<T>,
    },
}

/// Step of a placement, about the origin: a method of [`Placement`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "snake_case")]
pub enum Step<T> {
    /// Moves along X and across, by two lengths.
    Shifted(T, T),
    /// Exchanges left and right.
    Mirrored,
    /// Turns the body upside down.
    Flipped,
    /// Turns by an angle in radians, from X towards Y.
    Rotated(T),
    /// Multiplies all lengths by a factor.
    Scaled(T),
}

impl<T> From<Shape<T>> for PlacedShape<T> {
    fn from(shape: Shape<T>) -> Self {
        Self { shape, steps: Vec::new() }
    }
}

impl<T: Real> PlacedShape<T> {
    /// Builds the body. A smoothed spline is fitted to the points where they are placed, so that it
    /// keeps its uncertainty.
    ///
    /// # Errors
    /// [`InputError::Shape`](crate::InputError::Shape),
    /// [`InputError::Pieces`](crate::InputError::Pieces) and
    /// [`InputError::Points`](crate::InputError::Points), as of the constructors.
    pub fn build(&self) -> Result<Arc<dyn ParametricProfile<T>>, ContactError<T>> {
        let to = (!self.steps.is_empty())
            .then(|| self.steps.iter().fold(Placement::default(), Step::after));
        macro_rules! joined {
            ($whole:expr) => {
                match to {
                    None => Arc::new($whole),
                    Some(to) => Arc::new($whole.placed(to)?),
                }
            };
        }
        Ok(match &self.shape {
            Shape::Flat => smooth(Flat, to)?,
            Shape::Line(line) => smooth(*line, to)?,
            Shape::Parabola(parabola) => smooth(*parabola, to)?,
            Shape::Ellipse(ellipse) => smooth(*ellipse, to)?,
            Shape::Involute(involute) => smooth(*involute, to)?,
            Shape::Crowning(crowning) => smooth(*crowning, to)?,
            &Shape::Wedge { slopes, reach } => joined!(wedge(slopes, reach)?),
            &Shape::RoundedPunch { flat, radius, reach } => {
                joined!(rounded_punch(flat, radius, reach)?)
            }
            Shape::Spline { points, fit } => match to {
                Some(to) if fit.smooth => Arc::new(Spline::fitted_at(points, *fit, to)?),
                _ => joined!(Spline::fitted(points, *fit)?),
            },
            Shape::Piecewise { parts, tolerance } => {
                let parts = parts.iter().map(Self::build).collect::<Result<_, _>>()?;
                joined!(match *tolerance {
                    None => Piecewise::new(parts)?,
                    Some(tolerance) => Piecewise::with_tolerance(parts, tolerance)?,
                })
            }
        })
    }
}

fn smooth<T: Real, P: ParametricProfile<T> + 'static>(
    curve: P,
    to: Option<Placement<T>>,
) -> Result<Arc<dyn ParametricProfile<T>>, ContactError<T>> {
    Ok(match to {
        None => Arc::new(curve),
        Some(to) => Arc::new(Placed::new(curve, to)?),
    })
}

impl<T: Real> Step<T> {
    fn after(placement: Placement<T>, step: &Self) -> Placement<T> {
        match *step {
            Self::Shifted(along, across) => placement.shifted(along, across),
            Self::Mirrored => placement.mirrored(),
            Self::Flipped => placement.flipped(),
            Self::Rotated(angle) => placement.rotated(angle),
            Self::Scaled(factor) => placement.scaled(factor),
        }
    }
}

fn pair<'de, T: Deserialize<'de>, D: Deserializer<'de>>(file: D) -> Result<[T; 2], D::Error> {
    Pair::deserialize(file).map(|pair| pair.0)
}

fn pairs<'de, T: Deserialize<'de>, D: Deserializer<'de>>(file: D) -> Result<Vec<[T; 2]>, D::Error> {
    Ok(Vec::<Pair<T>>::deserialize(file)?.into_iter().map(|pair| pair.0).collect())
}

/// Reads a body, and refuses one that cannot be built.
pub(super) fn possible<'de, T: Real + Deserialize<'de>, D: Deserializer<'de>>(
    file: D,
) -> Result<PlacedShape<T>, D::Error> {
    let body = PlacedShape::deserialize(file)?;
    body.build().map_err(de::Error::custom)?;
    Ok(body)
}
