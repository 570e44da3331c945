//! Bodies in files. Each is made by its constructor, with the same errors.

use crate::Real;
use serde::de::Error;
use serde::{Deserialize, Deserializer};

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
    Ellipse { along: T, across: T, angles: [T; 2] } => Self::new(along, across, angles);
    Line { slope: T, domain: [T; 2] } => Self::new(slope, domain);
    Involute { base_radius: T, origin: T, angles: [T; 2] } => Self::new(base_radius, origin, angles);
    Crowning { depth: T, half_length: T, domain: [T; 2] } => Self::new(depth, half_length, domain);
    Parabola { radius: T, domain: [T; 2] } => Self::new(radius, domain);
}
