//! Errors of plain boundary elements for several meshes, compared with closed forms.

use super::elements::{Found, Kind, Scene, solve};
use std::error::Error;
use std::f64::consts::PI;

/// Numbers of elements over the contact.
const COUNTS: [u32; 5] = [16, 32, 64, 128, 256];

/// Number of positions of the mesh relative to the contact; the worst counts.
const POSITIONS: u32 = 8;

/// Length of the mesh on either side, in half-widths.
const REACH: f64 = 1.3;

/// Reference length of the approach, in half-widths.
const LENGTH: f64 = 100.0;

/// Contact with a known solution and E* = 1.
struct Known<'s> {
    name: &'static str,
    scene: Scene<'s>,
    half_width: f64,
    /// Peak pressure; zero if it is infinite.
    peak: f64,
    /// Pressure at half the half-width.
    half: f64,
    /// Approach towards the reference length; zero if there is none.
    approach: f64,
    /// True if the mesh ends at the corners of the body.
    corners: bool,
}

const QUANTITIES: [&str; 5] =
    ["half-width, counted", "half-width, from p^2", "peak pressure", "pressure at a/2", "approach"];

/// Returns the errors of the quantities; NaN for a quantity that is not known.
fn errors(known: &Known<'_>, found: &Found, element: f64) -> [f64; 5] {
    let a = known.half_width;
    let of = |found: f64, exact: f64| {
        if exact == 0.0 { f64::NAN } else { (found / exact - 1.0).abs() }
    };
    let approach = found.approach + 2.0 * known.scene.load / PI * (LENGTH * a).ln();
    let half_width = 0.5 * element * found.touching as f64;
    [
        if known.corners { f64::NAN } else { of(half_width, a) },
        if known.corners { f64::NAN } else { of(extrapolated(found), a) },
        of(found.peak(), known.peak),
        of(found.at(0.5 * a), known.half),
        of(approach, known.approach),
    ]
}

/// Returns the half-width by extrapolation. Next to a free edge the square of the pressure is
/// linear; its zero follows from the second and the fourth point inside.
fn extrapolated(found: &Found) -> f64 {
    let on = |i: &usize| found.pressure[*i] > 0.0;
    let first = (0..found.x.len()).find(on).unwrap_or(0);
    let last = (0..found.x.len()).rfind(on).unwrap_or(0);
    let zero = |near: usize, far: usize| {
        let [one, other] = [near, far].map(|i| found.pressure[i].powi(2));
        found.x[near] + one * (found.x[near] - found.x[far]) / (other - one)
    };
    0.5 * (zero(last - 1, last - 3) - zero(first + 1, first + 3))
}

fn nodes(known: &Known<'_>, count: u32, position: f64) -> Vec<f64> {
    let a = known.half_width;
    if known.corners {
        return (0..=count).map(|i| a * (2.0 * f64::from(i) / f64::from(count) - 1.0)).collect();
    }
    if let Some(period) = known.scene.period {
        let cells = (period / (2.0 * a) * f64::from(count)).ceil();
        let node = |i: u32| period * ((f64::from(i) + position) / cells - 0.5);
        return (0..=cells as u32).map(node).collect();
    }
    let beyond = (0.5 * REACH * f64::from(count)).ceil() as i32;
    let node = |i: i32| (f64::from(i) + position) * 2.0 * a / f64::from(count);
    (-beyond..=beyond).map(node).collect()
}

/// Returns the worst error over all positions, for each quantity.
fn worst(known: &Known<'_>, kind: Kind, count: u32) -> Result<[f64; 5], Box<dyn Error>> {
    let positions = if known.corners { 1 } else { POSITIONS };
    let mut worst = [f64::NAN; 5];
    for i in 0..positions {
        let nodes = nodes(known, count, f64::from(i) / f64::from(POSITIONS));
        let inside = |x: f64| x.abs() <= known.half_width;
        let found = solve(kind, &nodes, &known.scene, inside)?;
        for (worst, error) in worst.iter_mut().zip(errors(known, &found, nodes[1] - nodes[0])) {
            *worst = worst.max(error);
        }
    }
    Ok(worst)
}

/// Writes the table of the page, in Markdown.
pub fn table() -> Result<String, Box<dyn Error>> {
    let hertz = |x: f64| 0.5 * x * x;
    let wave = |x: f64| 1.0 - (2.0 * PI * x).cos();
    let log = (2.0 * LENGTH).ln();
    let known = [
        Known {
            name: "Hertz",
            scene: Scene { height: &hertz, load: PI / 4.0, period: None },
            half_width: 1.0,
            peak: 0.5,
            half: 0.5 * 0.75f64.sqrt(),
            approach: 0.5 * (log + 0.5),
            corners: false,
        },
        Known {
            name: "wedge",
            scene: Scene { height: &f64::abs, load: 1.0, period: None },
            half_width: 1.0,
            peak: 0.0,
            half: 2f64.acosh() / PI,
            approach: 2.0 / PI * (log + 1.0),
            corners: false,
        },
        Known {
            name: "flat punch",
            scene: Scene { height: &|_| 0.0, load: 1.0, period: None },
            half_width: 1.0,
            peak: 0.0,
            half: 1.0 / (PI * 0.75f64.sqrt()),
            approach: 2.0 / PI * log,
            corners: true,
        },
        Known {
            name: "wave",
            scene: Scene { height: &wave, load: 0.5 * PI, period: Some(1.0) },
            half_width: 0.25,
            peak: 2.0 * PI * 0.5f64.sqrt(),
            half: 2.0 * PI * (PI / 8.0).cos() * (0.5 - (PI / 8.0).sin().powi(2)).sqrt(),
            approach: 0.0,
            corners: false,
        },
    ];
    let heading: Vec<String> = COUNTS.iter().map(|count| format!("N = {count}")).collect();
    let mut table = format!("| case | quantity | elements | {} |\n", heading.join(" | "));
    table += &format!("|---|---|---|{}\n", "---|".repeat(COUNTS.len()));
    for known in &known {
        let mut rows = Vec::new();
        for (kind, name) in [(Kind::Constant, "constant"), (Kind::Linear, "linear")] {
            let errors = COUNTS.map(|count| worst(known, kind, count));
            let errors = errors.into_iter().collect::<Result<Vec<_>, _>>()?;
            for (i, quantity) in QUANTITIES.into_iter().enumerate() {
                let of: Vec<f64> = errors.iter().map(|errors| errors[i]).collect();
                if of.iter().all(|error| error.is_finite()) {
                    rows.push((i, quantity, name, of));
                }
            }
        }
        rows.sort_by_key(|row| row.0);
        for (_, quantity, name, of) in rows {
            let shown: Vec<String> = of.iter().map(|error| format!("{error:.1e}")).collect();
            table += &format!("| {} | {quantity} | {name} | {} |\n", known.name, shown.join(" | "));
        }
    }
    Ok(table)
}
