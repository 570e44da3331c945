#![allow(missing_docs, dead_code)]
#[path = "common/mod.rs"]
mod common;
#[path = "common/forms.rs"]
mod forms;
#[path = "suite/several_quantities.rs"]
mod several_quantities;
