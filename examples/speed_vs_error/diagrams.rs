//! Diagrams of error against work, one for each scene, as SVG.

use super::drawing::{self, Panel, Points, RGBColor, SeriesLabelPosition};
use super::methods::{DEFAULT, METHODS};
use super::table::Row;
use std::error::Error;
use std::path::Path;

const COLORS: [RGBColor; 7] = [
    drawing::BLACK,
    drawing::BLUE,
    RGBColor(95, 168, 224),
    drawing::RED,
    RGBColor(224, 138, 60),
    RGBColor(150, 130, 20),
    RGBColor(122, 63, 160),
];
/// Exponents of the errors drawn; an error of zero is drawn at the lowest.
const EXPONENTS: [f64; 2] = [-17.0, 0.0];
/// Scenes in the picture of the documentation; the first one has the legend.
const SHOWN: [[&str; 2]; 2] = [["Example 4", "Example 1"], ["circle L/R=0.99", "gear teeth"]];

/// Draws some scenes into one picture, by evaluations, and returns a line that names the file.
pub fn some(rows: &[Row]) -> Result<String, Box<dyn Error>> {
    let columns = SHOWN
        .map(|pair| pair.map(|scene| diagram(rows, scene, WORK[0], scene == SHOWN[0][0])).into());
    drawing::save("speed_vs_error", columns.into())
}

/// Draws each scene by evaluations and by time into a folder, and returns the number of scenes.
pub fn all(rows: &[Row], folder: &Path) -> Result<usize, Box<dyn Error>> {
    let scenes = scenes(rows);
    for (i, scene) in scenes.iter().enumerate() {
        let columns = WORK.map(|work| vec![diagram(rows, scene, work, true)]);
        drawing::write(&folder.join(format!("{:02}.svg", i + 1)), columns.into())?;
    }
    Ok(scenes.len())
}

/// Kind of work: its name, and its amount for a row.
type Work = (&'static str, fn(&Row) -> Option<f64>);
const WORK: [Work; 2] = [
    ("evaluations of the curves", |row| row.outcome.map(|outcome| outcome.cost.evaluations as f64)),
    ("time / µs", |row| row.micros),
];

fn scenes(rows: &[Row]) -> Vec<&'static str> {
    let mut scenes: Vec<_> = rows.iter().map(|row| row.scene).collect();
    scenes.dedup();
    scenes
}

fn diagram(rows: &[Row], scene: &str, (label, work): Work, legend: bool) -> Panel {
    let rows = rows
        .iter()
        .filter(|row| row.scene == scene && row.inversion == DEFAULT && row.limits == DEFAULT);
    let mut lines = Vec::new();
    for (method, color) in METHODS.into_iter().zip(COLORS) {
        let point = |row: &Row| {
            let (work, error) = (work(row)?.max(1.0), row.outcome?.error());
            let drawn = error.log10().clamp(EXPONENTS[0], EXPONENTS[1]);
            error.is_finite().then_some((work.log10(), drawn))
        };
        let points: Points =
            rows.clone().filter(|row| row.method == method).filter_map(point).collect();
        lines.push((method, color, points));
    }
    let most = lines.iter().flat_map(|line| &line.2).fold(1.0, |most: f64, at| most.max(at.0));
    let axes = ((label, [0.0, most.ceil()]), ("relative error of a, b, P", EXPONENTS));
    let panel = Panel::new(scene, axes.0, axes.1).size(410, 260).powers(true, true);
    let drawn = lines.into_iter().filter(|line| !line.2.is_empty());
    drawn.fold(panel.legend(SeriesLabelPosition::UpperLeft), |panel, (method, color, points)| {
        let method = if legend { method } else { "" };
        panel.line(points.clone(), color, method).dots(points, color, "")
    })
}
