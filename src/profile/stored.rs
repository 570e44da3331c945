//! Shapes in files: the table of all, and how they are read. Each is made by its constructor, with
//! the same errors.

use crate::Real;
use serde::{Deserialize, Deserializer, de::Error};

/// Gives a macro the table of shapes: of each the name, and the names of its parameters, in files
/// and in Python. A smooth one has a type; one that is joined, below, a function.
macro_rules! shapes {
    ($make:ident) => {
        $make! {
            /// Straight line.
            "line" Line { slope: T, domain: [T; 2] }
            /// Parabola.
            "parabola" Parabola { radius: T, domain: [T; 2] }
            /// Arc of an ellipse or a circle.
            "ellipse" Ellipse { along: T, across: T, angles: [T; 2] }
            /// Flank of a gear tooth.
            "involute" Involute { base_radius: T, origin: T, angles: [T; 2] }
            /// Logarithmic crowning.
            "crowning" Crowning { depth: T, half_length: T, domain: [T; 2] }
            ;
            /// Two flanks: [`wedge`](crate::profile::wedge).
            "wedge" Wedge = wedge {
                /// Slopes of the left and the right flank.
                slopes: [T; 2],
                /// Length to which the flanks reach, on either side.
                reach: T
            }
            /// Flat between two half parabolas: [`rounded_punch`](crate::profile::rounded_punch).
            "rounded_punch" RoundedPunch = rounded_punch {
                /// Half of the flat, a length.
                flat: T,
                /// Radius of the edges, a length.
                radius: T,
                /// Length to which the edges reach, on either side.
                reach: T
            }
        }
    };
}
#[cfg(feature = "scene")]
pub(crate) use shapes;

/// Reads two numbers, and no more: TOML would drop those beyond the length of an array.
pub(crate) fn pair<'de, T: Deserialize<'de>, D: Deserializer<'de>>(
    file: D,
) -> Result<[T; 2], D::Error> {
    let numbers = Vec::deserialize(file)?;
    let count = numbers.len();
    let must = |_| D::Error::custom(format!("{count} numbers: there must be two"));
    numbers.try_into().map_err(must)
}

/// Reads the smooth shapes.
macro_rules! stored {
    (
        $($(#[$about:meta])* $name:literal $body:ident {
            $($field:ident: $($one:ident)? $([$two:ident; 2])?),*
        })*
        ; $($joined:tt)*
    ) => {$(
        impl<'de, T: Real + Deserialize<'de>> Deserialize<'de> for super::$body<T> {
            fn deserialize<D: Deserializer<'de>>(file: D) -> Result<Self, D::Error> {
                #[derive(Deserialize)]
                #[serde(deny_unknown_fields, bound(deserialize = "T: Real + Deserialize<'de>"))]
                struct $body<T> {$(
                    $($field: $one,)?
                    $(#[serde(deserialize_with = "pair")] $field: [$two; 2],)?
                )*}
                let $body { $($field),* } = $body::deserialize(file)?;
                Self::new($($field),*).map_err(D::Error::custom)
            }
        }
    )*};
}
shapes!(stored);
