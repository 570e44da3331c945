//! Error against work, one diagram for a scene and a kind of work, as SVG.

use crate::methods::{DEFAULT, METHODS};
use crate::table::Row;
use kuva::prelude::*;
use std::path::Path;
use std::sync::Arc;

const COLORS: [&str; 7] =
    ["#111111", "#1f5fa8", "#5fa8e0", "#b5401a", "#e08a3c", "#c9b037", "#7a3fa0"];
/// Exponents of the errors drawn; an error of zero is drawn at the least.
const EXPONENTS: [f64; 2] = [-17.0, 0.0];

/// Draws all scenes into a folder.
pub fn draw(rows: &[Row], folder: &Path) -> std::io::Result<usize> {
    let mut scenes: Vec<&str> = rows.iter().map(|row| row.scene).collect();
    scenes.dedup();
    for (i, scene) in scenes.iter().enumerate() {
        let rows: Vec<&Row> = rows.iter().filter(|row| row.scene == *scene).collect();
        let evaluations = |row: &Row| row.outcome.map(|outcome| outcome.cost.evaluations as f64);
        let number = i + 1;
        let svg = diagram(&rows, scene, "evaluations of the curves", evaluations);
        std::fs::write(folder.join(format!("{number:02}_evaluations.svg")), svg)?;
        let svg = diagram(&rows, scene, "time / µs", |row| row.micros);
        std::fs::write(folder.join(format!("{number:02}_time.svg")), svg)?;
    }
    Ok(2 * scenes.len())
}

fn diagram(rows: &[&Row], scene: &str, label: &str, work: impl Fn(&Row) -> Option<f64>) -> String {
    let mut plots: Vec<Plot> = Vec::new();
    for (method, color) in METHODS.into_iter().zip(COLORS) {
        let default = rows.iter().filter(|row| row.inversion == DEFAULT && row.limits == DEFAULT);
        let point = |row: &&Row| {
            let (work, error) = (work(row)?.max(1.0), row.outcome?.error());
            error.is_finite().then_some((work, error.log10().clamp(EXPONENTS[0], EXPONENTS[1])))
        };
        let points: Vec<(f64, f64)> = default
            .copied()
            .filter(|row| row.method == method)
            .filter_map(|row| point(&row))
            .collect();
        if points.is_empty() {
            continue;
        }
        let line =
            LinePlot::new().with_data(points.clone()).with_color(color).with_stroke_width(2.0);
        plots.push(line.with_legend(method).into());
        let marks = ScatterPlot::new().with_data(points).with_color(color).with_size(4.0);
        plots.push(marks.into());
    }
    let layout = Layout::auto_from_plots(&plots)
        .with_title(format!("{scene}: the largest error of a, b and P"))
        .with_x_label(label)
        .with_y_label("relative error")
        .with_log_x()
        // Exponents, as the library's logarithmic axis ends at 1e-10.
        .with_y_axis_min(EXPONENTS[0])
        .with_y_axis_max(EXPONENTS[1])
        .with_y_tick_step(2.0)
        .with_y_tick_format(TickFormat::Custom(Arc::new(|exponent| format!("1e{exponent:.0}"))))
        .with_box_axes()
        .with_legend_box(false);
    kuva::render_to_svg(plots, layout)
}
