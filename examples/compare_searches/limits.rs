//! Parts 2 and 3: one search for the limits `a` and `b`, and one for the inversions that it needs.

use super::scenes::{self, Scene};
use super::{NAMES, Tally, searches};
use linecontact::{Contact, ContactError, Control, Cost, Interval};
use std::f64::consts::PI;

/// Result for one contact.
struct Outcome {
    cost: Cost,
    /// Relative errors of a and b.
    errors: [f64; 2],
    failure: Option<String>,
}

fn solve(scene: &Scene, contact: &Contact<'_, f64>) -> Outcome {
    match contact.solve(Control::Load(scene.c / PI)) {
        Ok(found) => {
            let errors = scene.errors(found.a(), found.b());
            let poor = errors.iter().any(|&error| error > scene.allowed);
            let failure = poor.then(|| format!("an error above {:.1e}", scene.allowed));
            Outcome { cost: found.cost(), errors, failure }
        }
        Err(error) => {
            let (cost, errors) = (Cost::default(), [f64::NAN; 2]);
            Outcome { cost, errors, failure: Some(error.to_string()) }
        }
    }
}

impl Tally {
    fn add(&mut self, strategy: usize, outcome: &Outcome) {
        self.count(strategy, outcome.cost.evaluations as f64);
        if let Some(text) = &outcome.failure {
            self.fail(strategy, text);
        }
    }
}

fn head(what: &str) {
    println!(
        "{:<24} {what:<10} {:>8} {:>11} {:>9} {:>9}",
        "contact", "samples", "evaluations", "err(a)", "err(b)"
    );
}

fn row(scene: &Scene, i: usize, outcome: &Outcome) {
    let Outcome { cost, errors: [a, b], .. } = outcome;
    let (name, Cost { samples, evaluations, .. }) = (if i == 0 { scene.name } else { "" }, cost);
    println!("{name:<24} {:<10} {samples:>8} {evaluations:>11} {a:>9.1e} {b:>9.1e}", NAMES[i]);
}

/// Part 2: tries each search for the limits, from the solver's own start.
pub fn limits() -> Result<Tally, ContactError<f64>> {
    println!();
    println!("# 2. Search for the limits a and b; inversion by the default, Newton. Samples are");
    println!(
        "# values of the gap's slope, evaluations calls of the curves. Errors are relative to"
    );
    println!(
        "# a or b, or to the half-width where it is smaller, against closed forms and 25 digits."
    );
    head("search");
    let mut tally = Tally::default();
    for scene in scenes::all() {
        for (i, search) in searches().iter().enumerate() {
            let outcome = solve(&scene, &scene.contact()?.limit_search(&**search));
            row(&scene, i, &outcome);
            tally.add(i, &outcome);
        }
    }
    Ok(tally)
}

/// Start `[-b, a]` for a scene, relative to its true half-width and centre.
struct Start {
    name: &'static str,
    /// Half-width, and shift of the centre, both in true half-widths.
    width: f64,
    shift: f64,
}

const STARTS: [Start; 4] = [
    Start { name: "10 times too wide", width: 10.0, shift: 0.0 },
    Start { name: "10 times too narrow", width: 0.1, shift: 0.0 },
    Start { name: "beside it, left", width: 1.0, shift: -3.0 },
    Start { name: "far right, narrow", width: 0.01, shift: 20.0 },
];

/// Part 2, continued: repeats the comparison from poor starts.
pub fn poor_starts() -> Result<Tally, ContactError<f64>> {
    println!();
    println!("# 2, continued: evaluations from poor starts, and the largest error of a and b");
    print!("{:<24} {:<20}", "contact", "start");
    println!("{}  {:>9}", NAMES.map(|name| format!(" {name:>9}")).concat(), "error");
    let mut tally = Tally::default();
    for scene in scenes::all() {
        let (half_width, centre) = (0.5 * (scene.a + scene.b), 0.5 * (scene.a - scene.b));
        for (i, start) in STARTS.iter().enumerate() {
            let middle = centre + start.shift * half_width;
            let reach = start.width * half_width;
            let name = if i == 0 { scene.name } else { "" };
            print!("{name:<24} {:<20}", start.name);
            let mut outcomes = Vec::new();
            for search in &searches() {
                let contact = scene.contact()?.limit_search(&**search);
                let outcome = solve(
                    &scene,
                    &contact.start(Interval { left: middle - reach, right: middle + reach }),
                );
                print!(" {:>9}", outcome.cost.evaluations);
                outcomes.push(outcome);
            }
            let errors = outcomes.iter().flat_map(|outcome| outcome.errors);
            println!("  {:>9.1e}", errors.fold(0.0, f64::max));
            for (i, outcome) in outcomes.iter().enumerate() {
                tally.add(i, outcome);
            }
        }
    }
    Ok(tally)
}

/// Part 3: tries each search for the inversions, with the default search for the limits.
pub fn inversions() -> Result<Tally, ContactError<f64>> {
    println!();
    println!(
        "# 3. Inversion within a contact, from the neighbouring sample; limits by the default,"
    );
    println!("# Brent");
    head("inversion");
    let mut tally = Tally::default();
    for scene in scenes::paper() {
        for (i, search) in searches().iter().enumerate() {
            let outcome = solve(&scene, &scene.contact()?.inversion(&**search));
            row(&scene, i, &outcome);
            tally.add(i, &outcome);
        }
    }
    Ok(tally)
}
