//! Core of `linecontact` for Python: plain numbers and arrays in, plain numbers and arrays out.
//! Names, units and defaults are in `python/linecontact`.

mod call;
mod control;
mod curve;
mod errors;
mod files;
mod finite_roller;
mod gradient;
mod outline;
mod pair;
mod profile;
mod quantity;
mod scene;
mod solution;
mod sweep;

use pyo3::prelude::*;

#[pymodule]
mod _native {
    #[pymodule_export]
    use super::errors::variants;
    #[pymodule_export]
    use super::files::scene_text;
    #[pymodule_export]
    use super::finite_roller::FiniteRoller;
    #[pymodule_export]
    use super::gradient::{gradient, parameters};
    #[pymodule_export]
    use super::outline::outline;
    #[pymodule_export]
    use super::pair::Pair;
    #[pymodule_export]
    use super::profile::Profile;
    #[pymodule_export]
    use super::scene::{Scene, Solver, SpringTable, contact_modulus, pin_in_hole, searches};
    #[pymodule_export]
    use super::solution::{LoadRates, PartialSlip, Solution};
    #[pymodule_export]
    use super::sweep::{quantities, sweep};
}
