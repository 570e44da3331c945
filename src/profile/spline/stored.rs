//! What a spline is in a file: its cubics.

use super::{Cubic, SplineError, points};
use crate::Real;
use crate::profile::ParametricProfile;
use crate::rounded::six;
use serde::Deserialize;
use thiserror::Error;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Spline<T> {
    cubics: Vec<Cubic<T>>,
}

/// Why cubics make no spline.
#[derive(Debug, Error)]
pub(super) enum Fault<T: Real> {
    #[error(transparent)]
    Knots(#[from] SplineError<T>),
    #[error(
        "cubic {cubic} (from 0, left to right) does not go on from the one before, at x = {x}",
        x = six(*x)
    )]
    Break { cubic: usize, x: T },
}

impl<T: Real> TryFrom<Spline<T>> for super::Spline<T> {
    type Error = Fault<T>;

    fn try_from(Spline { cubics }: Spline<T>) -> Result<Self, Fault<T>> {
        let start = |cubic: &Cubic<T>| [cubic.x[0], cubic.coefficients[0]];
        let mut knots: Vec<_> = cubics.iter().map(start).collect();
        knots.extend(cubics.last().map(|last| [last.x[1], last.at(last.x[1]).y]));
        points::check(&knots)?;
        let size = |i: usize| {
            let end = cubics.last().map(|last| last.at(last.x[1]));
            let end = end.map_or(T::zero(), |end| [end.y, end.dy][i]);
            cubics.iter().fold(end.abs(), |size, cubic| size.max(cubic.coefficients[i].abs()))
        };
        // As where it was made.
        let allowed = [0, 1].map(|i| T::epsilon().sqrt() * size(i));
        for (i, cubic) in cubics.iter().enumerate() {
            let (x, end) = (cubic.x[1], cubic.at(cubic.x[1]));
            let [height, slope] = match cubics.get(i + 1) {
                Some(next) if next.x[0] != x => return Err(Fault::Break { cubic: i + 1, x }),
                Some(next) => [next.coefficients[0], next.coefficients[1]],
                None => [end.y, end.dy],
            };
            let meets =
                (end.y - height).abs() <= allowed[0] && (end.dy - slope).abs() <= allowed[1];
            if !(allowed[0].is_finite() && allowed[1].is_finite() && end.dy.is_finite()) {
                return Err(SplineError::Overflow { row: i + 2, x, before: cubic.x[0] }.into());
            }
            if !meets {
                return Err(Fault::Break { cubic: i + 1, x });
            }
        }
        Ok(Self { cubics })
    }
}
