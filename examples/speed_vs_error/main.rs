//! Speed against error: the evaluations of the curves and the time of each method, for limits and
//! pressures that are known to 15 digits.
//!
//! ```sh
//! cargo run --release --example speed_vs_error              # two minutes at most
//! cargo run --release --example speed_vs_error -- --check   # counts and errors against the table kept
//! cargo run --release --example speed_vs_error -- --update  # keeps those of this run
//! ```
//!
//! Thirteen contacts are solved by the panels on a ladder of tolerances, by the paper's rule on a
//! ladder of N, and with each search in each of its two places (`methods.rs`). The paper's rule is
//! tried with ET = 0, 1, 2 and its own powers of the segment width; with the right powers, up to ET
//! = 4; and with ET = 2 and the paper's Eq. (6) for the limits, one segment inside.
//!
//! For free edges `Midpoint` leaves the search to adaptive integrals of full accuracy. They take
//! most of the evaluations at small N; the column `for_limits` shows them. Evaluations for the
//! heights of the bodies have a column of their own.
//!
//! A solve starts from the bodies and ends with the pressure at 101 equidistant points; samples of
//! the slope, evaluations of the curves and time are measured for all of it. Errors are relative:
//! of a, of b, and the largest of P. The error of P is taken inside (at those 101 points if P has a
//! closed form, else at the points of the reference file that are no closer to an edge), and at a
//! millionth of the half-width from an edge, where the rounding of x alone causes some 1e-10.
//!
//! Everything goes to `target/speed_vs_error`: `measured.tsv`, and for each contact its diagrams of
//! evaluations and of time. Some of them go to `target/figures/speed_vs_error.svg`. The results
//! that do not depend on the machine are kept in `tests/data/speed_vs_error.tsv`, and compared by
//! `--check`.

#[path = "../../tests/common/mod.rs"]
mod common;
mod diagrams;
#[path = "../shared/drawing.rs"]
mod drawing;
#[path = "../../tests/common/kept.rs"]
mod kept;
mod measure;
mod methods;
mod scenes;
mod summary;
mod table;

use methods::DEFAULT;
use std::error::Error;
use std::fs;
use std::io::{IsTerminal, Write};
use std::path::Path;
use std::time::Instant;
use table::Row;

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let argument = std::env::args().skip(1).find(|argument| argument != "--docs");
    let timed = argument.is_none();
    let rows = rows(timed);
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let kept = root.join("tests/data/speed_vs_error.tsv");
    match argument.as_deref() {
        Some("--check") => {
            let wrong = table::differences(&fs::read_to_string(&kept)?, &rows);
            wrong.iter().for_each(|difference| println!("{difference}"));
            if !wrong.is_empty() {
                let advice = "if that is meant, keep them with --update";
                return Err(format!("{} lines differ; {advice}", wrong.len()).into());
            }
            println!("{} lines of counts and errors as kept", rows.len());
        }
        Some("--update") => fs::write(&kept, text(&rows, table::HEADING, Row::line))?,
        Some(other) => return Err(format!("{other}: give --check, --update or nothing").into()),
        None => {
            let folder = root.join("target/speed_vs_error");
            fs::create_dir_all(&folder)?;
            let heading = format!("{}\tmicroseconds", table::HEADING);
            fs::write(folder.join("measured.tsv"), text(&rows, &heading, Row::timed_line))?;
            let count = diagrams::all(&rows, &folder)?;
            print!("{}", summary::summary(&rows));
            println!("\n{}Times are those of {}.", sources(), machine());
            println!(
                "measured.tsv and the diagrams of {count} contacts are in target/speed_vs_error"
            );
        }
    }
    println!("{}", diagrams::some(&rows)?);
    check_default(&rows);
    Ok(())
}

/// Solves every scene in every way.
fn rows(timed: bool) -> Vec<Row> {
    let (scenes, start, mut rows) = (scenes::all(), Instant::now(), Vec::new());
    for (i, scene) in scenes.iter().enumerate() {
        let ways = methods::all(scene);
        let count = ways.len();
        for (j, way) in ways.into_iter().enumerate() {
            let (number, of, seconds) = (i + 1, scenes.len(), start.elapsed().as_secs());
            // On a terminal one line that changes; in a log one line per scene.
            if std::io::stderr().is_terminal() {
                eprint!("\r\x1b[K{seconds:3} s  {number}/{of} {}  {}/{count}", scene.name, j + 1);
                let _ = std::io::stderr().flush();
            } else if j == 0 {
                eprintln!("{seconds:3} s  {number}/{of} {}", scene.name);
            }
            let outcome = measure::outcome(scene, &way).ok();
            let micros = if timed { measure::micros(scene, &way).ok() } else { None };
            rows.push(Row::new(scene, way, outcome, micros));
        }
    }
    eprintln!("\n{} solves in {} s", rows.len(), start.elapsed().as_secs());
    rows
}

/// Checks that the default integrator at its default tolerance is as exact as the data allow; a
/// search of one limit at a time may stop a few units in the last place earlier.
fn check_default(rows: &[Row]) {
    for scene in scenes::all() {
        for row in rows.iter().filter(|row| row.scene == scene.name && row.setting == "tol=full") {
            let allowed = scene.allowed * if row.limits == DEFAULT { 1.0 } else { 10.0 };
            let error = row.outcome.map(|outcome| outcome.error());
            assert!(error.is_some_and(|error| error <= allowed), "{}", row.line());
        }
    }
}

/// Lists the sources of the exact pressures.
fn sources() -> String {
    let scenes = scenes::all();
    let of = |source: &str| {
        let named = scenes.iter().filter(|scene| scene.source == source).map(|scene| scene.name);
        named.collect::<Vec<_>>().join(", ")
    };
    let [closed, file] = [scenes::CLOSED_FORM, scenes::FILE].map(|source| (source, of(source)));
    format!("P compared: {}: {}; {}: {}.\n", closed.0, closed.1, file.0, file.1)
}

fn text(rows: &[Row], heading: &str, line: impl Fn(&Row) -> String) -> String {
    let lines: Vec<String> = rows.iter().map(line).collect();
    format!("{heading}\n{}\n", lines.join("\n"))
}

/// Returns the name of the processor, if the system has it.
fn machine() -> String {
    let info = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let named = info.lines().find_map(|line| line.strip_prefix("model name")?.split(": ").nth(1));
    format!("{} ({})", named.unwrap_or("an unnamed processor"), std::env::consts::ARCH)
}
