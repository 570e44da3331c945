//! Programs, each run as a process of its own: the examples, the random scenes of `fuzz/`, and a
//! count of allocations.
//!
//! They are compiled as one, so that the solver is compiled only once.
//! `cargo test --test programs -- stress spring` runs those with one of these words in their name.
#![allow(missing_docs, dead_code)]
#![allow(clippy::duplicate_mod, reason = "programs of their own")]
#![allow(unused_imports, reason = "those of unit tests, which need a harness")]

#[path = "programs/allocation.rs"]
mod allocation;
#[path = "../examples/cam_follower.rs"]
mod cam_follower;
#[path = "../examples/compare_searches/main.rs"]
mod compare_searches;
#[path = "../examples/custom_profile.rs"]
mod custom_profile;
#[path = "../examples/finite_roller.rs"]
mod finite_roller;
#[path = "../fuzz/src/main.rs"]
mod fuzz;
#[path = "../examples/gear_mesh.rs"]
mod gear_mesh;
#[path = "../examples/guideways.rs"]
mod guideways;
#[path = "../examples/hard_coating.rs"]
mod hard_coating;
#[path = "../examples/hard_scenes/main.rs"]
mod hard_scenes;
#[path = "../examples/lifting_follower.rs"]
mod lifting_follower;
#[path = "../examples/measured_profile.rs"]
mod measured_profile;
#[path = "../examples/paper/main.rs"]
mod paper;
#[path = "../examples/pieces.rs"]
mod pieces;
#[path = "../examples/printing_nip.rs"]
mod printing_nip;
#[path = "../examples/quickstart.rs"]
mod quickstart;
#[path = "../examples/reference_tables/main.rs"]
mod reference_tables;
#[path = "../examples/references/main.rs"]
mod references;
#[path = "../examples/rough_profile.rs"]
mod rough_profile;
#[path = "../examples/rough_surface.rs"]
mod rough_surface;
#[path = "../examples/speed_vs_error/main.rs"]
mod speed_vs_error;
#[path = "../examples/spring.rs"]
mod spring;
#[path = "../examples/stress_field.rs"]
mod stress_field;

use std::path::Path;
use std::process::{Command, ExitCode, Termination};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;

/// Name, main function and arguments of a program in the test.
type Program = (&'static str, fn() -> ExitCode, &'static [&'static str]);

macro_rules! program {
    ($name:ident $($argument:literal)*) => {
        (stringify!($name), || $name::main().report(), &[$($argument),*])
    };
}

/// Programs, the longest first.
const PROGRAMS: [Program; 23] = [
    program!(fuzz "0" "2000"),
    program!(measured_profile),
    program!(speed_vs_error "--check"),
    program!(references),
    program!(reference_tables "--check"),
    program!(hard_scenes "--check"),
    program!(allocation),
    program!(cam_follower),
    program!(compare_searches),
    program!(custom_profile),
    program!(finite_roller),
    program!(gear_mesh),
    program!(guideways),
    program!(hard_coating),
    program!(lifting_follower),
    program!(paper),
    program!(pieces),
    program!(printing_nip),
    program!(quickstart),
    program!(rough_profile),
    program!(rough_surface),
    program!(spring),
    program!(stress_field),
];

/// Environment variable that names the program to run.
const NAME: &str = "LINECONTACT_PROGRAM";

fn main() -> ExitCode {
    if let Ok(name) = std::env::var(NAME) {
        let program = PROGRAMS.iter().find(|program| program.0 == name);
        return program.expect("it is one of them").1();
    }
    let missing = examples().filter(|name| PROGRAMS.iter().all(|program| program.0 != name));
    assert_eq!(missing.collect::<Vec<_>>(), [""; 0], "these examples are not run");
    let words: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with('-')).collect();
    let is_meant = |name: &str| words.is_empty() || words.iter().any(|word| name.contains(word));
    let (next, failed) = (AtomicUsize::new(0), AtomicUsize::new(0));
    let work = || {
        while let Some(&(name, _, arguments)) = PROGRAMS.get(next.fetch_add(1, Ordering::Relaxed)) {
            if is_meant(name) && !passes(name, arguments) {
                failed.fetch_add(1, Ordering::Relaxed);
            }
        }
    };
    std::thread::scope(|scope| {
        let count = std::thread::available_parallelism().map_or(1, usize::from);
        (0..count).for_each(|_| drop(scope.spawn(work)));
    });
    let failed = failed.into_inner();
    println!("{failed} programs failed");
    if failed == 0 { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

/// Lists the names of the examples.
fn examples() -> impl Iterator<Item = String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    let paths =
        folder.read_dir().expect("it is there").map(|entry| entry.expect("so is it").path());
    let examples = paths.filter(|path| path.is_file() || path.join("main.rs").exists());
    examples.filter_map(|path| Some(path.file_stem()?.to_str()?.to_owned()))
}

/// Runs a program; prints its output if it fails.
fn passes(name: &str, arguments: &[&str]) -> bool {
    let (start, this) = (Instant::now(), std::env::current_exe().expect("it has a path"));
    let output = Command::new(this).args(arguments).env(NAME, name).output().expect("it runs");
    let (ok, seconds) = (output.status.success(), start.elapsed().as_secs_f64());
    println!("program {name} ... {} in {seconds:.1} s", if ok { "ok" } else { "FAILED" });
    if !ok {
        let text = [output.stdout, output.stderr].concat();
        println!("{}", String::from_utf8_lossy(&text));
    }
    ok
}
