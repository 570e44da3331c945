//! The benches whose instructions are counted, as one program: the solver is compiled only once.
//!
//! The variable BENCH selects the bench; see instructions.sh.
#![allow(missing_docs)]
#![allow(clippy::duplicate_mod, reason = "programs of their own")]

#[path = "default.rs"]
mod default;
#[path = "embedding.rs"]
mod embedding;
#[path = "questions.rs"]
mod questions;
#[path = "several.rs"]
mod several;

fn main() {
    match std::env::var("BENCH").as_deref() {
        Ok("default") => default::main(),
        Ok("embedding") => embedding::main(),
        Ok("questions") => questions::main(),
        Ok("several") => several::main(),
        // `cargo bench` alone, which runs each of them by itself.
        _ => println!("BENCH: give default, embedding, questions or several"),
    }
}
