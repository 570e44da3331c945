//! Solves the contacts of a folder of reference files and compares the results.
//!
//! ```sh
//! cargo run --release --example references [-- FOLDER]
//! ```
//!
//! Each file (`tests/data` has them) holds two bodies as formulas in `k`, the load, and, to 30
//! digits, the limits and the pressure; or says that there must be an error. The columns: errors
//! of `a` and `b` as shares of the half-width; the largest relative error of the pressure and the
//! highest floor, that is, what rounding and the noise of the formulas leave open; the cost.
//! A file passes if every error is at most 1e-12 or, where that is more, 20 times the floor at
//! that very point. The program fails if a file does.

mod bodies;
mod noise;
mod reference;
mod report;

use bodies::{Body, BodyError};
use linecontact::{Contact, ContactError, Control, Cost, Edge};
use reference::{Kind, Reference};
use report::{Answer, Report};
use std::error::Error;
use std::f64::consts::PI;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// The solver at work: all that depends on how it is called.
fn solve(bodies: &[Body<f64>; 2], wanted: &Reference) -> Result<Answer, ContactError<f64>> {
    let mut contact = Contact::new(&*bodies[0], &*bodies[1])?.kappa(wanted.kappa);
    if let (Kind::Fixed, Some(on)) = (wanted.kind, wanted.limits) {
        contact = contact.edges(Edge::Fixed(on.left), Edge::Fixed(on.right));
    }
    let solution = contact.solve(Control::Load(wanted.c / PI))?;
    if wanted.kind != Kind::Fixed {
        solution.certify()?;
    }
    let (limits, cost) = (solution.interval(), solution.cost());
    let pressure = solution.pressure()?;
    let at = |x| pressure.estimate(x, &mut Cost::default()).map_err(|error| error.to_string());
    let pressures = wanted.points.iter().map(|point| Ok(at(point.x)?.value)).collect();
    Ok(Answer { limits, pressures, cost: cost + pressure.cost() })
}

/// What comes of a file. An error is one that the file itself is to blame for.
fn check(path: &Path) -> Result<Report, Box<dyn Error>> {
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    let file = serde_json::from_str(&std::fs::read_to_string(path)?)?;
    let reference = Reference::read(&file).ok_or("not a reference file")?;
    let failed = |error: String| {
        let expected = reference.kind == Kind::Error;
        Ok(Report::of_error(&name, reference.kind_name.clone(), expected, error))
    };
    let bodies = match bodies::bodies(&file) {
        Ok(bodies) => bodies,
        Err(BodyError::Pieces(error)) => return failed(error.to_string()),
        Err(error) => return Err(error.into()),
    };
    let answer = match solve(&bodies, &reference) {
        Ok(answer) => answer,
        Err(error) => return failed(error.to_string()),
    };
    let on = reference.limits.unwrap_or(answer.limits);
    let places: Vec<_> = reference.points.iter().map(|point| point.x).collect();
    // Given edges enter the integral for the pressure with the root of both distances, and G with it.
    let weight =
        if reference.kind == Kind::Fixed { |angle: f64| angle.sin().powi(2) } else { |_| 1.0 };
    let rounded = &reference.rounded_joints;
    let noise = noise::measure([&*bodies[0], &*bodies[1]], on, &places, rounded, weight)?;
    Ok(Report::of_answer(&name, &reference, &answer, &noise))
}

fn main() -> Result<ExitCode, Box<dyn Error>> {
    let given = std::env::args_os().nth(1).map(PathBuf::from);
    let folder = given.unwrap_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data"));
    let mut paths = Vec::new();
    let named = |error| format!("{}: {error}", folder.display());
    for entry in std::fs::read_dir(&folder).map_err(named)? {
        let path = entry?.path();
        if path.extension().is_some_and(|extension| extension == "json") {
            paths.push(path);
        }
    }
    paths.sort();
    println!("{}", Report::heading());
    let mut failures = 0;
    for path in &paths {
        // The others are still to be heard.
        let report = check(path).unwrap_or_else(|error| {
            let name = path.file_stem().unwrap_or_default().to_string_lossy();
            Report::of_error(&name, "cannot be read".to_owned(), false, error.to_string())
        });
        println!("{report}");
        failures += usize::from(!report.ok);
    }
    println!("{} of {} files pass", paths.len() - failures, paths.len());
    let passed = failures == 0 && !paths.is_empty();
    Ok(if passed { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}
