//! One solver for many solves: its memory, its settings, threads.
#![allow(missing_docs)]

mod next_loads;
mod reuse;
mod rough;
mod settings;
mod threads;
