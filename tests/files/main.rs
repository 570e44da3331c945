//! Tests of the features `serde` and `scene`: bodies, settings, results and scenes in files.
#![allow(missing_docs)]

#[path = "../common/mod.rs"]
mod common;

mod parts;
mod scene;
