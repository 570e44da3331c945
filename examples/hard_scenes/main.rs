//! Solves scenes close to the limits of floating-point numbers, and prints the errors of the
//! limits, their condition numbers and the cost.
//!
//! ```sh
//! cargo run --release --example hard_scenes              # prints the table
//! cargo run --release --example hard_scenes -- --check   # compares it with docs/hard_scenes.md
//! cargo run --release --example hard_scenes -- --update  # keeps that of this run
//! ```

#[path = "../../tests/common/mod.rs"]
mod common;
#[path = "../../tests/common/kept.rs"]
mod kept;
mod scenes;

use common::NanSafe;
use kept::{counts_agree, errors_agree, estimates_agree};
use linecontact::{Contact, ContactError, Control, Cost, CurvePoint, Interval};
use scenes::{Profile, Scene};
use std::error::Error;
use std::path::Path;
use std::sync::Arc;

const HEADING: &str = "\
# Hard scenes

Written by `cargo run --release --example hard_scenes -- --update`; CI compares it.

- **condition**: by how many times a relative change of the slopes is magnified in the limits, as a
  share of the half-width L. The slopes of either body are changed by the same share everywhere, or
  by a share that grows from one edge to the other, and the worst counts; the rounding of x, which
  is its size over L, is added. Times 1e-16 it is what any solver must be expected to lose.
- **error**: of the limits found under the exact load, by L, from closed forms or 25 digits.
- **estimated**: what the solution says of that error.
- **P**: largest relative error of the pressure, up to a thousandth of L from an edge at most.
- **evaluations** of the curves.
- **heights**: evaluations of the curves for their heights, besides those.

| scene | condition | error | estimated | P | evaluations | heights |
|---|---|---|---|---|---|---|
";

/// Largest error of the limits that passes, in units of the condition times the rounding of
/// numbers.
const MARGIN: f64 = 8.0;

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let lines = scenes::all().iter().map(line).collect::<Result<Vec<_>, _>>()?;
    let text = format!("{HEADING}{}\n", lines.join("\n"));
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/hard_scenes.md");
    match std::env::args().nth(1).as_deref() {
        Some("--update") => std::fs::write(path, text)?,
        Some("--check") => {
            let kept = std::fs::read_to_string(path)?;
            let rows = |text: &str| {
                text.lines()
                    .filter(|line| line.starts_with('|'))
                    .map(str::to_owned)
                    .collect::<Vec<_>>()
            };
            let (kept, found) = (rows(&kept), rows(&text));
            let differ = kept.iter().zip(&found).filter(|(kept, found)| !agree(kept, found));
            let wrong: Vec<String> =
                differ.map(|(kept, found)| format!("kept  {kept}\nfound {found}")).collect();
            if !wrong.is_empty() || kept.len() != found.len() {
                return Err(format!(
                    "{}\nif that is meant, keep it with --update",
                    wrong.join("\n")
                )
                .into());
            }
            println!("{} hard scenes as kept", lines.len());
        }
        Some(other) => return Err(format!("{other}: give --check, --update or nothing").into()),
        None => print!("{text}"),
    }
    Ok(())
}

fn solve<T>(
    scene: &Scene,
    [lower, upper]: &[Profile; 2],
    with: impl FnOnce(&linecontact::Solution<f64>) -> Result<T, ContactError<f64>>,
) -> Result<T, ContactError<f64>> {
    let contact = Contact::new(&**lower, &**upper)?.kappa(scene.kappa);
    with(&contact.solve(Control::Load(scene.load))?)
}

/// Returns the larger distance between the limits of two contacts, by the half-width of the first.
fn apart(one: Interval<f64>, other: Interval<f64>) -> f64 {
    (one.left - other.left).abs().nan_max((one.right - other.right).abs()) / one.half_width()
}

fn line(scene: &Scene) -> Result<String, String> {
    let of = |error: ContactError<f64>| format!("{}: {error}", scene.name);
    let bodies = scene.changed(0, Arc::new(|point| point));
    let (found, estimate, cost, pressure) = solve(scene, &bodies, |solution| {
        let all = solution.pressure()?;
        let mut worst: f64 = 0.0;
        for &[x, exact] in &scene.points {
            let z = (x - scene.limits.centre()) / scene.limits.half_width();
            if z.abs() < 0.9991 {
                let value = all.estimate(x, &mut Cost::default())?.value;
                worst = worst.nan_max((value / exact - 1.0).abs());
            }
        }
        let known = !scene.points.is_empty();
        let pressure = if known { format!("{worst:.0e}") } else { "-".to_owned() };
        let estimate = solution.limits_error().unwrap_or(f64::NAN);
        Ok((solution.hull(), estimate, solution.cost(), pressure))
    })
    .map_err(of)?;
    let condition = condition(scene, found).map_err(of)?;
    let error = apart(scene.limits, found);
    if error.is_nan() || error > estimate {
        let name = &scene.name;
        return Err(format!("{name}: the limits are off by {error:e}, estimated {estimate:e}"));
    }
    // The loss of any solver, and a margin for this one.
    let bearable = MARGIN * f64::EPSILON * condition;
    if condition.is_nan() || error > bearable {
        return Err(format!(
            "{}: the limits are off by {error:e}, {bearable:e} is allowed",
            scene.name
        ));
    }
    let name = scene.name.replace('|', "\\|");
    let Cost { evaluations, heights, .. } = cost;
    let errors = format!("{condition:.0e} | {error:.0e} | {estimate:.0e} | {pressure}");
    Ok(format!("| {name} | {errors} | {evaluations} | {heights} |"))
}

/// Returns the condition number: the factor by which relative changes of the slopes are magnified.
fn condition(scene: &Scene, on: Interval<f64>) -> Result<f64, ContactError<f64>> {
    const CHANGE: f64 = 1e-7;
    let (centre, half_width) = (on.centre(), on.half_width());
    let mut worst: f64 = 0.0;
    for which in 0..2 {
        if scene.bodies[which].is_empty() {
            continue;
        }
        for tilted in [false, true] {
            let change = move |point: CurvePoint<f64>| {
                let share =
                    if tilted { ((point.x - centre) / half_width).clamp(-1.5, 1.5) } else { 1.0 };
                CurvePoint { dy: point.dy * (1.0 + CHANGE * share), ..point }
            };
            let changed = scene.changed(which, Arc::new(change));
            let moved = solve(scene, &changed, |solution| Ok(solution.hull()))?;
            worst = worst.nan_max(apart(on, moved) / CHANGE);
        }
    }
    Ok(worst + on.left.abs().max(on.right.abs()) / half_width)
}

/// Tells whether two lines agree: conditions within a factor of 2, estimates within one of 10,
/// errors at most 10 times as large, counts nearly equal.
fn agree(kept: &str, found: &str) -> bool {
    let [kept, found] = [kept, found].map(|line| line.rsplit(" | ").collect::<Vec<_>>());
    kept.len() == found.len()
        && kept.into_iter().zip(found).enumerate().all(|(i, (kept, found))| {
            let [a, b] = [kept, found].map(|cell| cell.trim_end_matches(" |").parse::<f64>());
            match (i, a, b) {
                (0..=1, Ok(kept), Ok(found)) => counts_agree(kept, found),
                (2 | 4, Ok(kept), Ok(found)) => errors_agree(kept, found),
                (3, Ok(kept), Ok(found)) => estimates_agree(kept, found),
                (5, Ok(kept), Ok(found)) => found <= 2.0 * kept && kept <= 2.0 * found,
                _ => kept == found,
            }
        })
}
