//! The table of counts and errors: written, and compared with the one kept in `tests/data`.

use super::kept::{counts_agree, errors_agree};
use super::measure::Outcome;
use super::methods::Way;
use super::scenes::Scene;

/// Line of the table.
pub struct Row {
    pub scene: &'static str,
    pub method: &'static str,
    pub setting: String,
    pub inversion: &'static str,
    pub limits: &'static str,
    /// Outcome; `None` if the solve ended in an error.
    pub outcome: Option<Outcome>,
    pub micros: Option<f64>,
}

pub const HEADING: &str = "scene\tmethod\tsetting\tinversion\tlimits\tsamples\tevaluations\t\
    for_limits\terror_a\terror_b\terror_P\terror_P_edge\theights";

impl Row {
    pub fn new(scene: &Scene, way: Way, outcome: Option<Outcome>, micros: Option<f64>) -> Self {
        let Way { method, setting, inversion, limits, .. } = way;
        Self { scene: scene.name, method, setting, inversion, limits, outcome, micros }
    }

    /// Writes the line without the time, with errors to one digit.
    pub fn line(&self) -> String {
        let Self { scene, method, setting, inversion, limits, .. } = self;
        let results = self.outcome.map_or(["-"; 8].join("\t"), |outcome| {
            let Outcome { cost, for_limits, limits: [a, b], pressure: [inside, edge] } = outcome;
            let counts = format!("{}\t{}\t{for_limits}", cost.samples, cost.evaluations);
            format!("{counts}\t{a:.0e}\t{b:.0e}\t{inside:.0e}\t{edge:.0e}\t{}", cost.heights)
        });
        format!("{scene}\t{method}\t{setting}\t{inversion}\t{limits}\t{results}")
    }

    pub fn timed_line(&self) -> String {
        self.line() + &self.micros.map_or("\t-".to_owned(), |micros| format!("\t{micros:.4}"))
    }
}

/// Lists the differences between the lines and those kept.
pub fn differences(kept: &str, rows: &[Row]) -> Vec<String> {
    let mut wrong = Vec::new();
    let kept: Vec<&str> = kept.lines().skip(1).collect();
    if kept.len() != rows.len() {
        wrong.push(format!("{} lines, {} are kept", rows.len(), kept.len()));
    }
    for (kept, row) in kept.into_iter().zip(rows) {
        let line = row.line();
        if !agree(kept, &line) {
            wrong.push(format!("kept  {kept}\nfound {line}"));
        }
    }
    wrong
}

fn agree(kept: &str, found: &str) -> bool {
    let [kept, found] = [kept, found].map(|line| line.split('\t').collect::<Vec<_>>());
    let columns = kept.len() == found.len() && kept.len() == HEADING.split('\t').count();
    columns
        && kept.into_iter().zip(found).enumerate().all(|(i, (kept, found))| {
            let numbers = (kept.parse::<f64>(), found.parse::<f64>());
            match (i, numbers) {
                (5..=7 | 12, (Ok(kept), Ok(found))) => counts_agree(kept, found),
                (8..=11, (Ok(kept), Ok(found))) => errors_agree(kept, found),
                _ => kept == found,
            }
        })
}
