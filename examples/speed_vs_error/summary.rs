//! The method with the fewest evaluations for an error, and the factor by which the next one needs
//! more.

use super::methods::{DEFAULT, METHODS, PANELS, searches};
use super::table::Row;

const TARGETS: [f64; 4] = [1e-3, 1e-6, 1e-9, 1e-12];

/// Returns the fewest evaluations with which some of the rows reach an error.
fn fewest<'r>(rows: impl Iterator<Item = &'r Row>, target: f64) -> Option<f64> {
    let reached = rows.filter_map(|row| row.outcome).filter(|outcome| outcome.error() <= target);
    reached.map(|outcome| outcome.cost.evaluations.max(1) as f64).min_by(f64::total_cmp)
}

/// Evaluations of each competitor on each scene; `None` if it does not reach the error.
struct Race {
    names: Vec<&'static str>,
    /// Evaluations by scene and competitor.
    evaluations: Vec<Vec<Option<f64>>>,
}

impl Race {
    fn run(
        rows: &[Row],
        scenes: &[&str],
        names: &[&'static str],
        target: f64,
        competes: impl Fn(&Row, &str) -> bool,
    ) -> Self {
        let of = |scene: &str, name: &str| {
            fewest(rows.iter().filter(|row| row.scene == scene && competes(row, name)), target)
        };
        let evaluations =
            scenes.iter().map(|scene| names.iter().map(|name| of(scene, name)).collect());
        Self { names: names.to_vec(), evaluations: evaluations.collect() }
    }

    /// Names the first and the second on a scene: "panels 18, 14 x paper ET=2".
    fn on_scene(&self, scene: usize) -> String {
        let count = |i: usize| self.evaluations[scene][i];
        let mut order: Vec<usize> = (0..self.names.len()).filter(|&i| count(i).is_some()).collect();
        order.sort_by(|&i, &j| count(i).partial_cmp(&count(j)).expect("no NaN"));
        match order[..] {
            [] => "nobody".to_owned(),
            [first] => format!("{} {:.0}, alone", self.names[first], count(first).unwrap_or(0.0)),
            [first, second, ..] => {
                let [one, two] = [first, second].map(|i| count(i).unwrap_or(0.0));
                let times = factor(two / one);
                format!("{} {one:.0}, {times} x {}", self.names[first], self.names[second])
            }
        }
    }

    /// Names first the competitor that reaches the error on the most scenes, and among equals the
    /// one with the fewest evaluations (geometric mean). Each other competitor has a factor over
    /// the scenes that both reach.
    fn overall(&self) -> String {
        let mean = |pairs: &dyn Fn(&Vec<Option<f64>>) -> Option<f64>| {
            let logarithms: Vec<f64> =
                self.evaluations.iter().filter_map(pairs).map(f64::ln).collect();
            let count = logarithms.len();
            (count, (logarithms.iter().sum::<f64>() / count.max(1) as f64).exp())
        };
        let results: Vec<(usize, f64)> =
            (0..self.names.len()).map(|i| mean(&|scene| scene[i])).collect();
        let mut order: Vec<usize> = (0..self.names.len()).collect();
        order.sort_by(|&i, &j| {
            results[j].0.cmp(&results[i].0).then(results[i].1.total_cmp(&results[j].1))
        });
        let first = order[0];
        let (count, evaluations) = results[first];
        if count == 0 {
            return "nobody".to_owned();
        }
        let of = self.evaluations.len();
        let mut text = format!("{} {evaluations:.0} ({count} of {of} scenes)", self.names[first]);
        for &other in order[1..].iter().filter(|&&i| results[i].0 > 0) {
            let (_, times) = mean(&|scene| Some(scene[other]? / scene[first]?));
            let (count, name) = (results[other].0, self.names[other]);
            text += &format!("; {} x {name} ({count})", factor(times));
        }
        text
    }
}

fn factor(times: f64) -> String {
    if times < 10.0 { format!("{times:.2}") } else { format!("{times:.0}") }
}

/// Writes the whole summary.
pub fn summary(rows: &[Row]) -> String {
    let mut scenes: Vec<&str> = rows.iter().map(|row| row.scene).collect();
    scenes.dedup();
    let plain = |row: &Row| row.inversion == DEFAULT && row.limits == DEFAULT;
    let methods = TARGETS.map(|target| {
        Race::run(rows, &scenes, &METHODS, target, |row, name| plain(row) && row.method == name)
    });
    let mut text = String::from(
        "Fewest evaluations of the curves for limits and pressure within an error: the winner, its\n\
         evaluations, and how many times as many the next one needs. Each quadrature with the default\n\
         searches, on a ladder of its settings.\n",
    );
    for (i, scene) in scenes.iter().enumerate() {
        text += &format!("\n{scene}\n");
        for (race, target) in methods.iter().zip(TARGETS) {
            text += &format!("  {target:.0e}  {}\n", race.on_scene(i));
        }
    }
    text +=
        "\nAll scenes: who gets there most often, by geometric means; in brackets on how many.\n";
    for (race, target) in methods.iter().zip(TARGETS) {
        text += &format!("  {target:.0e}  {}\n", race.overall());
    }
    let free: Vec<&str> =
        scenes.iter().copied().filter(|scene| searches_limits(rows, scene)).collect();
    for (heading, method, scenes, of_limits) in [
        ("Searches that invert X(k) = x, under the panels", PANELS, &scenes, false),
        ("The same under the paper's rule (right powers, ET=4, N=64)", METHODS[1], &scenes, false),
        (
            "Searches for the limits, under the panels (default: Newton on both)",
            PANELS,
            &free,
            true,
        ),
    ] {
        let default = of_limits.then_some(DEFAULT);
        let names: Vec<&'static str> = default.into_iter().chain(searches()).collect();
        text += &format!("\n{heading}\n");
        for target in TARGETS {
            let mut race = Race::run(rows, scenes, &names, target, |row, name| {
                let [this, other] = if of_limits {
                    [row.limits, row.inversion]
                } else {
                    [row.inversion, row.limits]
                };
                // The searches are tried on three rungs of the ladder, so the default counts on
                // these alone.
                let rung = !["tol=1e-9", "tol=1e-12"].contains(&&*row.setting);
                row.method == method && this == name && other == DEFAULT && rung
            });
            // At the noise of the formulas success is luck: only scenes that all reach count.
            race.evaluations.retain(|scene| scene.iter().all(Option::is_some));
            text += &format!("  {target:.0e}  {}\n", race.overall());
        }
    }
    text
}

fn searches_limits(rows: &[Row], scene: &str) -> bool {
    rows.iter().any(|row| row.scene == scene && row.limits != DEFAULT)
}
