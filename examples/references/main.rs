//! Solves the contacts of a folder of reference files and compares the results.
//!
//! ```sh
//! cargo run --release --example references [-- FOLDER]
//! ```
//!
//! Each file (`tests/data` has them) holds two bodies as formulas in `k`, the load, and, to 30
//! digits, the limits and the pressure; or it says that there must be an error. The columns are the
//! errors of `a` and `b` as shares of the half-width, the largest relative error of the pressure,
//! the highest floor, and the cost. The floor is the error due to rounding and to the noise of the
//! formulas.
//!
//! A file passes if every error is at most 1e-12 or, where that is more, 20 times the floor at that
//! point. A file with several contacts (`contact-reference-2`) gives its own tolerances: of the
//! limits as shares of the width, of the pressure as a share of the largest one. If the solution in
//! one interval is no contact, the file passes if that solution is found, is then rejected with the
//! error that the file names, and boundary elements agree with the contacts in several places.
//! Where an error is due, it must be of the variant that the file names. The program fails if a
//! file does.

#[path = "../../tests/common/boundary_elements.rs"]
mod boundary_elements;

mod bodies;
mod noise;
mod range;
mod reference;
mod report;

use bodies::{Body, BodyError};
use boundary_elements::Oracle;
use linecontact::{Contact, ContactError, Control, Cost, Edge, Interval};
use reference::{Kind, Reference, Several};
use report::{Answer, Report};
use std::error::Error;
use std::f64::consts::PI;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

/// Solves the contact of a file, with the pressures at the given places. All calls of the solver
/// are here.
fn solve(
    bodies: &[Body<f64>; 2],
    wanted: &Reference,
    places: &[f64],
) -> Result<Answer, ContactError<f64>> {
    let mut contact = Contact::new(&*bodies[0], &*bodies[1])?.kappa(wanted.kappa);
    if let (Kind::Fixed, Some(on)) = (wanted.kind, wanted.limits) {
        contact = contact.edges(Edge::Fixed(on.left), Edge::Fixed(on.right)).single_interval(true);
    }
    if let Some(Several { corners, .. }) = wanted.several {
        let edge = |corner, x| if corner { Edge::Fixed(x) } else { Edge::Free };
        let [left, right] = range::of(&*bodies[1]);
        contact = contact.edges(edge(corners[0], left), edge(corners[1], right));
    }
    let solution = contact.solve(Control::Load(wanted.c / PI))?;
    if wanted.kind != Kind::Fixed {
        solution.certify()?;
    }
    let (contacts, cost) = (solution.intervals().to_vec(), solution.cost());
    let pressure = solution.pressure()?;
    let at = |x| pressure.estimate(x, &mut Cost::default()).map_err(|error| error.to_string());
    let pressures = places.iter().map(|&x| Ok(at(x)?.value)).collect();
    Ok(Answer { contacts, pressures, cost: cost + pressure.cost() })
}

/// Checks a file. An error is returned only for a fault of the file itself.
fn check(path: &Path) -> Result<Report, Box<dyn Error>> {
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    let file = serde_json::from_str(&std::fs::read_to_string(path)?)?;
    let reference =
        Reference::read(&file).ok_or("not a reference file, or of a kind unknown here")?;
    let failed = |error: String, variant: String| {
        let expected = match reference.kind {
            Kind::Error => reference.error.as_ref().is_some_and(|name| is_in(name, &variant)),
            _ => false,
        };
        let unlike = reference.error.as_ref().filter(|_| !expected);
        let said = unlike.map_or(String::new(), |name| format!(" (expected: {name})"));
        let kind = reference.kind_name.clone();
        Ok(Report::of_error(&name, kind, expected, error + &said))
    };
    let bodies = match bodies::bodies(&file) {
        Ok(bodies) => bodies,
        Err(BodyError::Pieces(error)) => return failed(error.to_string(), format!("{error:?}")),
        Err(error) => return Err(error.into()),
    };
    let mut places: Vec<_> = reference.points.iter().map(|point| point.x).collect();
    let mut oracle = None;
    if reference.kind == Kind::Unphysical {
        let found = elements(&bodies, &reference).ok_or("the boundary elements do not settle")?;
        places.clone_from(&found.x);
        oracle = Some(found);
    }
    let answer = match solve(&bodies, &reference, &places) {
        Ok(answer) => answer,
        Err(error) => return failed(error.to_string(), format!("{error:?}")),
    };
    if let Some(oracle) = oracle {
        let elements =
            Report::of_elements(&name, &reference, &answer, &oracle, &reference.breakpoints);
        return Ok(match one_interval(&name, &bodies, &reference) {
            Ok(one) => one.and(elements),
            Err(why) => Report::of_error(&name, reference.kind_name, false, why),
        });
    }
    if let Some(several) = &reference.several {
        return Ok(Report::of_several(&name, &reference, several, &answer));
    }
    if reference.kind == Kind::Error {
        // Under no load an empty contact is right, too.
        let is_apart = reference.error.as_deref() == Some("InvalidLoad");
        let ok = is_apart && answer.contacts.is_empty();
        let said = if ok { "no contact" } else { "solved, but an error is expected" };
        return Ok(Report::of_error(&name, reference.kind_name, ok, said.to_owned()));
    }
    let on = reference.limits.ok_or("no limits")?;
    // With given edges the integral for the pressure contains the root of both distances from the
    // edges, and so does the weight of the slope.
    let weight =
        if reference.kind == Kind::Fixed { |angle: f64| angle.sin().powi(2) } else { |_| 1.0 };
    let rounded = &reference.rounded_breakpoints;
    let noise = noise::measure([&*bodies[0], &*bodies[1]], on, &places, rounded, weight)?;
    Ok(Report::of_answer(&name, &reference, &answer, &noise))
}

/// Solves the equations for one interval, whose solution is in the file, and checks that this
/// solution is rejected by the error that the file names.
fn one_interval(name: &str, bodies: &[Body<f64>; 2], wanted: &Reference) -> Result<Report, String> {
    let said = |error: ContactError<f64>| format!("as one interval: {error}");
    let (on, error) = wanted.limits.zip(wanted.error.as_ref()).ok_or("no limits, or no error")?;
    let wide = 0.01 * on.half_width();
    let start = Interval { left: on.left - wide, right: on.right + 0.5 * wide };
    let contact = Contact::new(&*bodies[0], &*bodies[1]).map_err(said)?.kappa(wanted.kappa);
    let contact = contact.single_interval(true).start(start);
    // One load may have several such solutions; a width has one load.
    let load = wanted.c / PI;
    let control = if wanted.one_of_several {
        Control::HalfWidth(on.half_width())
    } else {
        Control::Load(load)
    };
    let solution = contact.solve(control).map_err(said)?;
    let pressure = solution.pressure().map_err(said)?;
    let at = |x| pressure.estimate(x, &mut Cost::default()).map_err(|error| error.to_string());
    let places: Vec<_> = wanted.points.iter().map(|point| point.x).collect();
    let pressures = places.iter().map(|&x| Ok(at(x)?.value)).collect();
    let cost = solution.cost() + pressure.cost();
    let answer = Answer { contacts: solution.intervals().to_vec(), pressures, cost };
    let both = [&*bodies[0], &*bodies[1]];
    let noise = noise::measure(both, on, &places, &wanted.rounded_breakpoints, |_| 1.0);
    let noise = noise.map_err(|error| error.to_string())?;
    let mut report = Report::of_answer(name, wanted, &answer, &noise);
    let off = (solution.load() / load - 1.0).abs();
    if off.is_nan() || off > 1e-12 {
        report.fail(format!("load: off {off:.1e}"));
    }
    match solution.certify() {
        Ok(_) => report.fail(format!("certified as one interval (expected: {error})")),
        Err(denied) if is_in(error, &format!("{denied:?}")) => {}
        Err(denied) => report.fail(format!("{denied} (expected: {error})")),
    }
    Ok(report)
}

/// Tells whether a word is in the debug output of an error, such as `Profile { body: Upper, source:
/// TurnsBack { .. } }`.
fn is_in(word: &str, shown: &str) -> bool {
    shown.split(|c: char| !c.is_alphanumeric()).any(|part| part == word)
}

/// Solves the contact by boundary elements.
fn elements(bodies: &[Body<f64>; 2], wanted: &Reference) -> Option<Oracle> {
    let [lower, upper] = [&*bodies[0], &*bodies[1]];
    let gap = |x| boundary_elements::height(upper, x) - boundary_elements::height(lower, x);
    let [one, two] = [range::of(lower), range::of(upper)];
    let range = [one[0].max(two[0]), one[1].min(two[1])];
    boundary_elements::solve(&gap, wanted.kappa, wanted.c / PI, range, &wanted.breakpoints)
}

pub(crate) fn main() -> Result<ExitCode, Box<dyn Error>> {
    let given = std::env::args_os().nth(1).map(PathBuf::from);
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data");
    let folders = match given {
        Some(folder) => vec![folder],
        None => vec![data.clone(), data.join("several")],
    };
    let mut paths = Vec::new();
    for folder in folders {
        let named = |error| format!("{}: {error}", folder.display());
        for entry in std::fs::read_dir(&folder).map_err(named)? {
            let path = entry?.path();
            if path.extension().is_some_and(|extension| extension == "json") {
                paths.push(path);
            }
        }
    }
    paths.sort();
    println!("{}", Report::heading());
    let mut failures = 0;
    for path in &paths {
        // One bad file does not stop the others.
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
