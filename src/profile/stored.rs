//! What a body is in a file. Each is made by its constructor, and refused as by that.

use super::{ParametricProfile, PiecewiseError, Placement, ProfileError, finite};
use crate::Real;
use serde::de::Error;
use serde::{Deserialize, Deserializer};

/// The parameters of a shape under the names that they have in a file, and its constructor.
macro_rules! stored {
    ($($shape:ident { $($(#[$attribute:meta])* $field:ident: $type:ty),* } => $make:expr;)*) => {$(
        #[derive(Deserialize)]
        #[serde(deny_unknown_fields)]
        pub(super) struct $shape<T> {
            $($(#[$attribute])* $field: $type,)*
        }

        impl<T: Real> TryFrom<$shape<T>> for super::$shape<T> {
            type Error = ProfileError<T>;

            fn try_from($shape { $($field),* }: $shape<T>) -> Result<Self, Self::Error> {
                $make
            }
        }
    )*};
}
stored! {
    Ellipse { along: T, across: T, angles: [T; 2] } => Self::new(along, across, angles);
    Line { slope: T, domain: [T; 2] } => Self::new(slope, domain);
    Involute { base_radius: T, origin: T, angles: [T; 2] } => Self::new(base_radius, origin, angles);
    Crowning { depth: T, half_length: T, domain: [T; 2] } => Self::new(depth, half_length, domain);
    Parabola {
        // So that none is not the same as null.
        #[serde(deserialize_with = "Deserialize::deserialize")]
        #[serde(bound(deserialize = "T: Deserialize<'de>"))]
        radius: Option<T>,
        domain: [T; 2]
    } => match radius {
        Some(radius) => Self::new(radius, domain),
        None => Self::straight(domain),
    };
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Placed<T, P> {
    curve: P,
    #[serde(bound(deserialize = "T: Real + Deserialize<'de>"))]
    placement: Placement<T>,
}

impl<T: Real, P: ParametricProfile<T>> TryFrom<Placed<T, P>> for super::Placed<T, P> {
    type Error = ProfileError<T>;

    fn try_from(Placed { curve, placement }: Placed<T, P>) -> Result<Self, Self::Error> {
        Self::new(curve, placement)
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Piecewise<T, P> {
    parts: Vec<P>,
    tolerance: T,
}

impl<T: Real, P: ParametricProfile<T>> TryFrom<Piecewise<T, P>> for super::Piecewise<T, P> {
    type Error = PiecewiseError<T>;

    fn try_from(Piecewise { parts, tolerance }: Piecewise<T, P>) -> Result<Self, Self::Error> {
        Self::with_tolerance(parts, tolerance)
    }
}

/// The matrix of a placement: turned, mirrored or scaled, but not bent out of shape.
pub(super) fn matrix<'de, T: Real + Deserialize<'de>, D: Deserializer<'de>>(
    file: D,
) -> Result<[[T; 2]; 2], D::Error> {
    let matrix = <[[T; 2]; 2]>::deserialize(file)?;
    let [[a, b], [c, d]] = matrix;
    let [size, other] = [a.hypot(b), c.hypot(d)];
    let name = "the product of all factors of a placement";
    finite(name, size, size > T::zero(), "finite and not zero").map_err(D::Error::custom)?;
    let allowed = T::epsilon().sqrt();
    // In shares of the size, whose products neither overflow nor vanish.
    let square = (a / size) * (c / size) + (b / size) * (d / size);
    let differ = (other - size) / size;
    finite(
        "the angle between the rows of a placement, by its cosine,",
        square,
        square.abs() <= allowed,
        "zero",
    )
    .and_then(|()| {
        let name = "the difference of the two factors of a placement, as a share,";
        finite(name, differ, differ.abs() <= allowed, "zero")
    })
    .map_err(D::Error::custom)?;
    Ok(matrix)
}

/// The shift of a placement.
pub(super) fn shift<'de, T: Real + Deserialize<'de>, D: Deserializer<'de>>(
    file: D,
) -> Result<[T; 2], D::Error> {
    let shift = <[T; 2]>::deserialize(file)?;
    for value in shift {
        finite("a shift of a placement", value, true, "finite").map_err(D::Error::custom)?;
    }
    Ok(shift)
}
