//! Bodies in files. Each is made by its constructor, with the same errors.

use crate::Real;
use serde::de::Error;
use serde::{Deserialize, Deserializer};

/// Two numbers, and no more: TOML would drop those beyond the length of an array.
#[derive(Deserialize)]
#[serde(try_from = "Vec<T>")]
pub(crate) struct Pair<T>(pub [T; 2]);

impl<T> TryFrom<Vec<T>> for Pair<T> {
    type Error = String;

    fn try_from(numbers: Vec<T>) -> Result<Self, String> {
        let count = numbers.len();
        numbers.try_into().map(Self).map_err(|_| format!("{count} numbers: there must be two"))
    }
}

/// Reads bodies: for each the names of its parameters in a file, and its constructor.
macro_rules! stored {
    ($($body:ident { $($field:ident: $type:ty),* } => $make:expr;)*) => {$(
        impl<'de, T: Real + Deserialize<'de>> Deserialize<'de> for super::$body<T> {
            fn deserialize<D: Deserializer<'de>>(file: D) -> Result<Self, D::Error> {
                #[derive(Deserialize)]
                #[serde(deny_unknown_fields, bound(deserialize = "T: Real + Deserialize<'de>"))]
                struct $body<T> {
                    $($field: $type,)*
                }
                let $body { $($field),* } = $body::deserialize(file)?;
                $make.map_err(D::Error::custom)
            }
        }
    )*};
}
stored! {
    Ellipse { along: T, across: T, angles: Pair<T> } => Self::new(along, across, angles.0);
    Line { slope: T, domain: Pair<T> } => Self::new(slope, domain.0);
    Involute { base_radius: T, origin: T, angles: Pair<T> } => Self::new(base_radius, origin, angles.0);
    Crowning { depth: T, half_length: T, domain: Pair<T> } => Self::new(depth, half_length, domain.0);
    Parabola { radius: T, domain: Pair<T> } => Self::new(radius, domain.0);
}
