//! Bodies in files. Each is made by its constructor, with the same errors.

use super::spline::Cubic;
use super::{ParametricProfile, Placement};
use crate::Real;
use serde::de::Error;
use serde::{Deserialize, Deserializer};

/// Reads bodies: for each the names of its parameters in a file, and its constructor.
macro_rules! stored {
    ($($body:ident<T $(, $curve:ident)?> { $($(#[$attribute:meta])* $field:ident: $type:ty),* } => $make:expr;)*) => {$(
        impl<'de, T: Real + Deserialize<'de> $(, $curve: ParametricProfile<T> + Deserialize<'de>)?> Deserialize<'de>
            for super::$body<T $(, $curve)?>
        {
            fn deserialize<D: Deserializer<'de>>(file: D) -> Result<Self, D::Error> {
                #[derive(Deserialize)]
                #[serde(deny_unknown_fields, bound(deserialize = "T: Real + Deserialize<'de>"))]
                struct $body<T $(, $curve)?> {
                    $($(#[$attribute])* $field: $type,)*
                }
                let $body { $($field),* } = $body::deserialize(file)?;
                $make.map_err(D::Error::custom)
            }
        }
    )*};
}
stored! {
    Ellipse<T> { along: T, across: T, angles: [T; 2] } => Self::new(along, across, angles);
    Line<T> { slope: T, domain: [T; 2] } => Self::new(slope, domain);
    Involute<T> { base_radius: T, origin: T, angles: [T; 2] } => Self::new(base_radius, origin, angles);
    Crowning<T> { depth: T, half_length: T, domain: [T; 2] } => Self::new(depth, half_length, domain);
    Parabola<T> {
        // A missing radius is an error; null stands for a straight line.
        #[serde(deserialize_with = "Deserialize::deserialize")]
        radius: Option<T>,
        domain: [T; 2]
    } => match radius {
        Some(radius) => Self::new(radius, domain),
        None => Self::straight(domain),
    };
    Placed<T, P> {
        #[serde(bound(deserialize = "P: Deserialize<'de>"))]
        curve: P,
        placement: Placement<T>
    } => Self::new(curve, placement);
    Piecewise<T, P> {
        #[serde(bound(deserialize = "P: Deserialize<'de>"))]
        parts: Vec<P>,
        tolerance: T
    } => Self::with_tolerance(parts, tolerance);
    Placement<T> { matrix: [[T; 2]; 2], shift: [T; 2] } => Self::read(matrix, shift);
    Spline<T> {
        cubics: Vec<Cubic<T>>,
        #[serde(default = "T::zero")]
        noise: T
    } => Self::of_cubics(cubics, noise);
}
