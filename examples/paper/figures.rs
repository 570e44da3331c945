//! Figures 2 to 7: the solids and the pressures of Examples 3 to 5, as SVG.

use super::curves::Example;
use super::drawing::{self, BLUE, Panel, Points, RED, SeriesLabelPosition};
use super::limits::{Case, Solved};
use linecontact::search::{Bracket, LimitSearch, Newton, SearchError};
use linecontact::{Interval, ParametricProfile};
use std::error::Error;

/// Scale of x in the figures, so that tick labels need no exponents. The paper has no units.
const UNIT: f64 = 1e-3;
const X_LABEL: &str = "x / 10⁻³ (no unit)";

/// Draws the solids and the pressure of an example, and returns a line that names the file.
pub fn draw(case: &Case, solved: &[Solved; 2]) -> Result<String, Box<dyn Error>> {
    let first = 2 * case.number - 4; // Example 3 has Figures 2 and 3, and so on.
    let title = format!("Figure {first}: solids of Example {}, contact for κ = 1", case.number);
    let solids = solids(case, solved[0].contact, &title)?;
    let pressures =
        pressures(solved, &format!("Figure {}: pressure in Example {}", first + 1, case.number));
    drawing::save(&format!("paper_example{}", case.number), vec![vec![solids], vec![pressures]])
}

/// Makes a panel of both solids over twice the width of the contact.
fn solids(case: &Case, contact: Interval<f64>, title: &str) -> Result<Panel, SearchError<f64>> {
    let Example { lower, upper, .. } = (case.example)();
    let lower = outline(&lower, contact)?;
    let upper = outline(&upper, contact)?;
    let heights = || lower.iter().chain(&upper).map(|&(_, y)| y);
    let bottom = heights().fold(f64::INFINITY, f64::min);
    let top = heights().fold(f64::NEG_INFINITY, f64::max);
    let margin = 0.15 * (top - bottom);
    let (bottom, top) = (bottom - 2.0 * margin, top + margin); // with room for the legend
    let range = [lower[0].0, lower[lower.len() - 1].0];
    let panel = Panel::new(title, (X_LABEL, range), ("y (no unit)", [bottom, top])).size(400, 280);
    Ok(panel
        .legend(SeriesLabelPosition::LowerMiddle)
        .body(upper, top, RED, "upper body")
        .body(lower, bottom, BLUE, "lower body")
        .limit(contact.left / UNIT, "−b")
        .limit(contact.right / UNIT, "a"))
}

/// Makes a panel of the pressures for both scales κ.
fn pressures([one, half_pi]: &[Solved; 2], title: &str) -> Panel {
    let lines = [closed(one), closed(half_pi)];
    let top = 1.6 * lines.iter().flatten().map(|at| at.1).fold(0.0, f64::max);
    let margin = 0.1 * one.contact.half_width(); // the wider of the two contacts
    let range = [one.contact.left - margin, one.contact.right + margin].map(|x| x / UNIT);
    let [blue, red] = lines;
    Panel::new(title, (X_LABEL, range), ("P (no unit)", [0.0, top]))
        .size(400, 280)
        .legend(SeriesLabelPosition::UpperMiddle)
        .line(blue, BLUE, "κ = 1")
        .dashed(vertical(one.contact.left, top), BLUE, "its limits −b, a")
        .dashed(vertical(one.contact.right, top), BLUE, "")
        .line(red, RED, "κ = π/2")
        .dashed(vertical(half_pi.contact.left, top), RED, "its limits −b, a")
        .dashed(vertical(half_pi.contact.right, top), RED, "")
}

fn vertical(x: f64, top: f64) -> Points {
    vec![(x / UNIT, 0.0), (x / UNIT, top)]
}

/// Returns the points (x, Y) of a profile around the contact.
fn outline(
    profile: &dyn ParametricProfile<f64>,
    contact: Interval<f64>,
) -> Result<Points, SearchError<f64>> {
    (-100..=100)
        .map(|step| contact.centre() + contact.half_width() * f64::from(step) / 50.0)
        .map(|x| Ok((x / UNIT, height(profile, x)?)))
        .collect()
}

/// Returns Y of a profile at x; the parameter is found as the solver finds it.
fn height(profile: &dyn ParametricProfile<f64>, x: f64) -> Result<f64, SearchError<f64>> {
    let [from, to] = profile.domain();
    let mut miss = |k| {
        let point = profile.at(k);
        (point.x - x, point.dx)
    };
    let root = Newton::default().find_with_slope(&mut miss, &Bracket::new(from, to))?;
    Ok(profile.y(root.x))
}

/// Returns the pressure from limit to limit. In the first and the last segment it follows the
/// square root with which it ends.
fn closed(solved: &Solved) -> Points {
    let inside = &solved.pressure;
    let end = |limit: f64, (x, pressure): (f64, f64)| {
        let roots = (0..8).map(|eighth| f64::from(eighth) / 8.0);
        roots.map(move |root| (limit + (x - limit) * root * root, pressure * root))
    };
    let left = end(solved.contact.left, inside[0]);
    let right = end(solved.contact.right, inside[inside.len() - 1]).rev();
    let points = left.chain(inside.iter().copied().step_by(2)).chain(right);
    points.map(|(x, pressure)| (x / UNIT, pressure)).collect()
}
