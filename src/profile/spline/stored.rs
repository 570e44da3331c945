//! Settings of a fit in files: 0 in place of `None`, which TOML cannot write.

use crate::Real;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

pub(super) fn serialize<T: Real + Serialize, S: Serializer>(
    value: &Option<T>,
    file: S,
) -> Result<S::Ok, S::Error> {
    value.unwrap_or(T::zero()).serialize(file)
}

pub(super) fn deserialize<'de, T: Real + Deserialize<'de>, D: Deserializer<'de>>(
    file: D,
) -> Result<Option<T>, D::Error> {
    let value = T::deserialize(file)?;
    Ok((!value.is_zero()).then_some(value))
}
