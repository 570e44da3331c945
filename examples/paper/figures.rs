//! Figures 2 to 7: the solids and the pressures of Examples 3 to 5, as SVG.

use crate::curves::Example;
use crate::limits::{Case, Solved};
use kuva::prelude::*;
use linecontact::search::{Bracket, LimitSearch, Newton, SearchError};
use linecontact::{Interval, ParametricProfile};
use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};

/// The unit of x in the figures, so that tick labels need no exponents.
const UNIT: f64 = 1e-3;
const X_LABEL: &str = "x / 10⁻³";

const BLUE: &str = "#1f5fa8";
const RED: &str = "#b5401a";

/// Draws the solids and the pressure of an example, and says where.
pub fn draw(case: &Case, solved: &[Solved; 2]) -> Result<[PathBuf; 2], Box<dyn Error>> {
    let directory = Path::new("target/figures");
    fs::create_dir_all(directory)?;
    let first = 2 * case.number - 4; // Example 3 has Figures 2 and 3, and so on.
    let [solids_path, pressure_path] =
        [first, first + 1].map(|number| directory.join(format!("figure{number}.svg")));
    let title = format!("Figure {first}: solids of Example {}, contact for κ = 1", case.number);
    fs::write(&solids_path, solids(case, solved[0].contact, title)?)?;
    let title = format!("Figure {}: pressure in Example {}", first + 1, case.number);
    fs::write(&pressure_path, pressures(solved, title))?;
    Ok([solids_path, pressure_path])
}

/// Both solids over twice the width of the contact.
fn solids(case: &Case, contact: Interval<f64>, title: String) -> Result<String, SearchError<f64>> {
    let Example { lower, upper, .. } = (case.example)();
    let lower = outline(&lower, contact)?;
    let upper = outline(&upper, contact)?;
    let heights = || lower.iter().chain(&upper).map(|&(_, y)| y);
    let bottom = heights().fold(f64::INFINITY, f64::min);
    let top = heights().fold(f64::NEG_INFINITY, f64::max);
    let margin = 0.15 * (top - bottom);
    let (bottom, top) = (bottom - margin, top + margin);

    let plots = vec![
        filled(&upper, top, RED),
        filled(&lower, bottom, BLUE),
        line(&upper, RED, "upper body".into()),
        line(&lower, BLUE, "lower body".into()),
    ];
    let layout = layout(&plots, title, "y")
        .with_x_axis_min(lower[0].0)
        .with_x_axis_max(lower[lower.len() - 1].0)
        .with_y_axis_min(bottom)
        .with_y_axis_max(top)
        .with_shaded_region(
            ShadedRegion::vertical(contact.left / UNIT, contact.right / UNIT).with_color("gray"),
        );
    let layout = with_limits(layout, contact, "black");
    Ok(kuva::render_to_svg(plots, layout))
}

/// The pressure for both scales κ.
fn pressures([one, half_pi]: &[Solved; 2], title: String) -> String {
    let plots = vec![
        line(&closed(one), BLUE, "κ = 1".into()),
        line(&closed(half_pi), RED, "κ = π/2".into()),
    ];
    let layout = layout(&plots, title, "P(x)").with_y_axis_min(0.0);
    let layout = with_limits(layout, one.contact, BLUE);
    let layout = with_limits(layout, half_pi.contact, RED);
    kuva::render_to_svg(plots, layout)
}

/// The points (x, Y) of a profile around the contact.
fn outline(
    profile: &dyn ParametricProfile<f64>,
    contact: Interval<f64>,
) -> Result<Vec<(f64, f64)>, SearchError<f64>> {
    (-100..=100)
        .map(|step| contact.centre() + contact.half_width() * f64::from(step) / 50.0)
        .map(|x| Ok((x / UNIT, height(profile, x)?)))
        .collect()
}

/// Y of a profile at x, whose parameter is found as the solver finds it.
fn height(profile: &dyn ParametricProfile<f64>, x: f64) -> Result<f64, SearchError<f64>> {
    let [from, to] = profile.domain();
    let mut miss = |k| {
        let point = profile.at(k);
        (point.x - x, point.dx)
    };
    let root = Newton::default().find_with_slope(&mut miss, &Bracket::new(from, to))?;
    Ok(profile.y(root.x))
}

/// The pressure from limit to limit. In the first and the last segment it follows the square
/// root with which it ends.
fn closed(solved: &Solved) -> Vec<(f64, f64)> {
    let inside = &solved.pressure;
    let end = |limit: f64, (x, pressure): (f64, f64)| {
        let roots = (0..8).map(|eighth| f64::from(eighth) / 8.0);
        roots.map(move |root| (limit + (x - limit) * root * root, pressure * root))
    };
    let left = end(solved.contact.left, inside[0]);
    let right = end(solved.contact.right, inside[inside.len() - 1]).rev();
    let points = left.chain(inside.iter().copied()).chain(right);
    points.map(|(x, pressure)| (x / UNIT, pressure)).collect()
}

fn line(points: &[(f64, f64)], color: &str, legend: String) -> Plot {
    let line = LinePlot::new().with_data(points.iter().copied()).with_color(color);
    line.with_stroke_width(2.0).with_legend(legend).into()
}

/// The body between its outline and the edge of the figure.
fn filled(outline: &[(f64, f64)], edge: f64, color: &str) -> Plot {
    let (x, y): (Vec<_>, Vec<_>) = outline.iter().copied().unzip();
    let edge = vec![edge; y.len()];
    BandPlot::new(x, y, edge).with_color(color).with_opacity(0.12).into()
}

fn layout(plots: &[Plot], title: String, y_label: &str) -> Layout {
    Layout::auto_from_plots(plots)
        .with_title(title)
        .with_x_label(X_LABEL)
        .with_y_label(y_label)
        .with_box_axes()
        .with_legend_box(false)
}

fn with_limits(layout: Layout, contact: Interval<f64>, color: &str) -> Layout {
    let limit =
        |x: f64, name: &str| ReferenceLine::vertical(x / UNIT).with_color(color).with_label(name);
    layout
        .with_reference_line(limit(contact.left, "−b"))
        .with_reference_line(limit(contact.right, "a"))
}
