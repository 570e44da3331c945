//! Splines in files: their cubics, and the settings of a fit.

use super::{Cubic, Spline, SplineError, points};
use crate::Real;
use crate::profile::ParametricProfile;
use crate::rounded::six;
use thiserror::Error;

/// Reason why cubics do not make a spline.
#[derive(Debug, Error)]
pub(in crate::profile) enum Fault<T: Real> {
    #[error(transparent)]
    Knots(#[from] SplineError<T>),
    #[error(
        "cubic {cubic} (from 0, left to right) does not go on from the one before, at x = {x}",
        x = six(*x)
    )]
    Break { cubic: usize, x: T },
}

impl<T: Real> Spline<T> {
    /// Builds a spline from cubics that meet as closely as when they were made.
    pub(in crate::profile) fn of_cubics(cubics: Vec<Cubic<T>>, noise: T) -> Result<Self, Fault<T>> {
        let start = |cubic: &Cubic<T>| (cubic.x[0], [cubic.coefficients[0], cubic.coefficients[1]]);
        let mut knots: Vec<_> = cubics.iter().map(start).collect();
        knots.extend(
            cubics.last().map(|last| last.at(last.x[1])).map(|end| (end.x, [end.y, end.dy])),
        );
        let (x, knots): (Vec<_>, Vec<_>) = knots.into_iter().unzip();
        let heights: Vec<_> = x.iter().zip(&knots).map(|(&x, &[y, _])| [x, y]).collect();
        points::check(&heights)?;
        if let Some(i) = cubics.windows(2).position(|pair| pair[0].x[1] != pair[1].x[0]) {
            return Err(Fault::Break { cubic: i + 1, x: cubics[i].x[1] });
        }
        let spline = Self { cubics, noise, smooth: None };
        match spline.first_gap(&knots) {
            None => Ok(spline),
            Some((i, is_finite)) => {
                let [before, x] = spline.cubics[i].x;
                let overflow = SplineError::Overflow { row: i + 2, x, before };
                Err(if is_finite { Fault::Break { cubic: i + 1, x } } else { overflow.into() })
            }
        }
    }
}

/// Reads and writes 0 in place of `None`, which TOML cannot write.
pub(in crate::profile) mod or_zero {
    use crate::Real;
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    pub(in crate::profile) fn serialize<T: Real + Serialize, S: Serializer>(
        value: &Option<T>,
        file: S,
    ) -> Result<S::Ok, S::Error> {
        value.unwrap_or(T::zero()).serialize(file)
    }

    pub(in crate::profile) fn deserialize<'de, T: Real + Deserialize<'de>, D: Deserializer<'de>>(
        file: D,
    ) -> Result<Option<T>, D::Error> {
        let value = T::deserialize(file)?;
        Ok((!value.is_zero()).then_some(value))
    }
}
