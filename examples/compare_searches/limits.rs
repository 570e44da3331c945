//! Parts 2 and 3: one search for the limits `a` and `b`, and one for the inversions that it needs.

use super::scenes::{self, Scene};
use super::{Tally, searches};
use linecontact::{Contact, ContactError, Control, Cost, Interval, Midpoint};
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
    fn add(&mut self, search: &'static str, outcome: &Outcome) {
        self.count(search, outcome.cost.search_values);
        if let Some(text) = &outcome.failure {
            self.fail(search, text);
        }
    }
}

fn head(what: &str) {
    println!(
        "{:<24} {what:<10} {:>8} {:>7} {:>11} {:>9} {:>9}",
        "contact", "searches", "values", "evaluations", "err(a)", "err(b)"
    );
}

fn row(contact: &str, search: &str, outcome: &Outcome) {
    let Outcome { cost, errors: [a, b], .. } = outcome;
    let Cost { evaluations, searches, search_values, .. } = cost;
    print!("{contact:<24} {search:<10} {searches:>8} {search_values:>7} {evaluations:>11}");
    println!(" {a:>9.1e} {b:>9.1e}");
}

/// Part 2: tries each search for the limits, from the solver's own start.
pub fn limits() -> Result<Tally, ContactError<f64>> {
    println!();
    println!("# 2. Searches for the limits a and b; inversion by the default, Newton. Values are");
    println!("# those of the functions searched, evaluations those of the curves. Errors are");
    println!(
        "# relative to a or b, or to the half-width where it is smaller, against closed forms"
    );
    println!("# and 25 digits.");
    head("search");
    let mut tally = Tally::default();
    for scene in scenes::all() {
        for (i, (search, strategy)) in searches().into_iter().enumerate() {
            let outcome = solve(&scene, &scene.contact()?.limit_search(&*strategy));
            row(if i == 0 { scene.name } else { "" }, search, &outcome);
            tally.add(search, &outcome);
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
    println!("# 2, continued: function values from poor starts, and the largest error of a and b");
    print!("{:<24} {:<20}", "contact", "start");
    for (search, _) in searches() {
        print!("  {search:>9}");
    }
    println!("  {:>9}", "error");
    let mut tally = Tally::default();
    for scene in scenes::all() {
        let (half_width, centre) = (0.5 * (scene.a + scene.b), 0.5 * (scene.a - scene.b));
        for (i, start) in STARTS.iter().enumerate() {
            let middle = centre + start.shift * half_width;
            let reach = start.width * half_width;
            let start_at = Interval { left: middle - reach, right: middle + reach };
            let name = if i == 0 { scene.name } else { "" };
            print!("{name:<24} {:<20}", start.name);
            let (mut outcomes, mut largest) = (Vec::new(), 0f64);
            for (search, strategy) in searches() {
                let contact = scene.contact()?.limit_search(&*strategy).start(start_at);
                let outcome = solve(&scene, &contact);
                print!("  {:>9}", outcome.cost.search_values);
                largest = outcome.errors.into_iter().fold(largest, f64::max);
                outcomes.push((search, outcome));
            }
            println!("  {largest:>9.1e}");
            for (search, outcome) in &outcomes {
                tally.add(search, outcome);
            }
        }
    }
    Ok(tally)
}

/// Part 3: tries each search for the inversions, with the default search for the limits, on the
/// paper's rule: panels invert by a few of Newton's steps.
pub fn inversions() -> Result<Tally, ContactError<f64>> {
    println!();
    println!("# 3. Inversion within a contact by the paper's rule, from the neighbouring sample;");
    println!("# limits by the default, Newton on both at once");
    head("inversion");
    let mut tally = Tally::default();
    let rule = Midpoint::default();
    for scene in scenes::paper() {
        for (i, (search, strategy)) in searches().into_iter().enumerate() {
            let contact = scene.contact()?.quadrature(&rule).inversion(&*strategy);
            let outcome = solve(&scene, &contact);
            row(if i == 0 { scene.name } else { "" }, search, &outcome);
            tally.add(search, &outcome);
        }
    }
    Ok(tally)
}
