//! Tests of the features `autodiff` and `rayon`.
#![allow(missing_docs)]

#[path = "../common/mod.rs"]
mod common;
#[path = "../common/forms.rs"]
mod forms;
#[path = "../common/formulas.rs"]
mod formulas;

mod approach;
mod derivatives;
mod derivatives_several;
mod finite_roller;
mod kernels;
mod sweep;
