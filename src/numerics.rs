//! Mathematics without contact.

mod linear_system;

pub(crate) use linear_system::LinearSystem;
