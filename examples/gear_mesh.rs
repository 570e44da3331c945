//! Solves a pair of spur gears along the path of contact, for half-width and peak pressure.
//!
//! Run with `cargo run --release --example gear_mesh`. The flanks, half-width and peak pressure are
//! drawn to `target/figures/gear_mesh.svg`. Lengths in mm, pressures in MPa, load in N/mm. At each
//! instant the two flanks are involutes that touch on the line tangent to both base circles. The
//! results are checked against Hertz with the radii of curvature there. The flanks are modelled a
//! little longer than the teeth, so that the corners at their tips do not count; two pairs share
//! the load equally.

#[path = "shared/drawing.rs"]
mod drawing;

use drawing::{BLACK, BLUE, Panel, Points, RED};
use linecontact::profile::{Involute, Placed, Placement};
use linecontact::{Contact, Control, ParametricProfile, ProfileError, Solver};
use std::error::Error;
use std::f64::consts::PI;

const MODULE: f64 = 3.0;
const TEETH: [f64; 2] = [20.0, 60.0];
const PRESSURE_ANGLE: f64 = 20.0 * PI / 180.0;
const MODULUS: f64 = 113.187e3; // E* of steel on steel
const LOAD: f64 = 300.0; // along the line of action
const STEPS: u32 = 240;

/// Line of action of the pair, as a function of the distance s from its point on the pinion's base
/// circle.
struct Mesh {
    base: [f64; 2],
    /// Length of the line between the base circles: the radii of curvature are s and `line - s`.
    line: f64,
    /// Values of s at which contact begins, at the wheel's tip, and ends, at the pinion's.
    path: [f64; 2],
    /// Distance between two pairs of teeth.
    pitch: f64,
}

impl Mesh {
    fn new() -> Self {
        let radii = TEETH.map(|teeth| 0.5 * MODULE * teeth);
        let base = radii.map(|radius| radius * PRESSURE_ANGLE.cos());
        let line = (radii[0] + radii[1]) * PRESSURE_ANGLE.sin();
        let to_tip = [0, 1].map(|i| ((radii[i] + MODULE).powi(2) - base[i].powi(2)).sqrt());
        let pitch = PI * MODULE * PRESSURE_ANGLE.cos();
        Self { base, line, path: [line - to_tip[1], to_tip[0]], pitch }
    }

    fn load(&self, s: f64) -> f64 {
        let alone = s > self.path[1] - self.pitch && s < self.path[0] + self.pitch;
        if alone { LOAD } else { 0.5 * LOAD }
    }

    /// Returns the two flanks that touch at s, with that point as origin; the pinion is below,
    /// turned by half a turn.
    fn flanks(&self, s: f64) -> Result<[Flank; 2], ProfileError<f64>> {
        let flank = |i: usize, arm: f64, placement| {
            let rolled = arm / self.base[i];
            let involute = Involute::new(self.base[i], rolled, [0.1 * rolled, rolled + 0.2])?;
            Placed::new(involute, placement)
        };
        let half_turn = Placement::default().mirrored().flipped();
        Ok([flank(0, s, half_turn)?, flank(1, self.line - s, Placement::default())?])
    }
}

type Flank = Placed<f64, Involute<f64>>;

/// Load, and half-width and peak pressure from the solver and from Hertz.
struct Row {
    s: f64,
    load: f64,
    solved: [f64; 2],
    hertz: [f64; 2],
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let mesh = Mesh::new();
    let mut solver = Solver::new();
    let (mut rows, mut off, mut least) = (Vec::new(), [0.0f64; 2], f64::INFINITY);
    let mut share = 0.0f64;
    for step in 0..=STEPS {
        let s = mesh.path[0] + (mesh.path[1] - mesh.path[0]) * f64::from(step) / f64::from(STEPS);
        let [pinion, wheel] = mesh.flanks(s)?;
        let contact = Contact::new(&pinion, &wheel)?.contact_modulus(MODULUS);
        let load = mesh.load(s);
        let solution = solver.solve(&contact, Control::Load(load))?;
        let solved = [solution.hull().half_width(), solution.peak()?.pressure];

        let radius = s * (mesh.line - s) / mesh.line; // 1/R = 1/s + 1/(line - s)
        let half_width = (4.0 * load * radius / (PI * MODULUS)).sqrt();
        let hertz = [half_width, 2.0 * load / (PI * half_width)];
        // Relative change of the radii over the half-width, which Hertz leaves out. (The radius of
        // an involute, r t, changes by dX/t.)
        let change = half_width * (mesh.base[0] / (s * s) + mesh.base[1] / (mesh.line - s).powi(2));
        for i in 0..2 {
            let here = (solved[i] / hertz[i] - 1.0).abs();
            off[i] = off[i].max(here);
            least = least.min(here);
            share = share.max(here / (change * change));
        }
        rows.push(Row { s: (s - mesh.path[0]) / mesh.pitch, load, solved, hertz });
    }
    let (first, last) = (&rows[0], &rows[rows.len() - 1]);
    println!("contact ratio {:.4}", last.s);
    for (place, row) in [("wheel's tip", first), ("pinion's tip", last)] {
        let [half_width, peak] = row.solved;
        println!("at the {place}: half-width {half_width:.5} mm, peak {peak:.2} MPa");
    }
    println!("off Hertz by no more than {:.1e} and {:.1e}, at best {least:.0e}", off[0], off[1]);
    println!("  and {share:.3} of the square of the change of the radii over the half-width");
    println!("{}", draw(&mesh, &rows)?);

    assert!(off[0] < 0.01 && off[1] < 0.01 && share < 0.1, "{off:?} {share}");
    Ok(())
}

/// Draws the flanks at the pitch point, and half-width and peak over the mesh, and returns a line
/// that names the file.
fn draw(mesh: &Mesh, rows: &[Row]) -> Result<String, Box<dyn Error>> {
    let pitch_point = mesh.base[0] * PRESSURE_ANGLE.tan();
    let outline = |flank: &Flank| -> Points {
        let [from, to] = flank.domain();
        let points = (0..=200).map(|i| flank.at(from + (to - from) * f64::from(i) / 200.0));
        points.map(|at| (at.x, at.y)).collect()
    };
    let [pinion, wheel] = mesh.flanks(pitch_point)?.each_ref().map(outline);
    let heights = [-2.28, 2.28]; // as high as the two others
    let flanks =
        Panel::new("The flanks at the pitch point", ("x / mm", [-3.0, 3.0]), ("y / mm", heights))
            .with_equal_scales(400)
            .body(pinion, heights[0], BLUE, "")
            .body(wheel, heights[1], RED, "")
            .dots(vec![(0.0, 0.0)], BLACK, "")
            .note(0.0, -1.3, "pinion, 20 teeth", BLUE)
            .note(0.0, 1.4, "wheel, 60 teeth", RED);
    let along = |i: usize, title: &str, label: &str, unit: &str, top: f64| {
        let end = rows[rows.len() - 1].s;
        let mut panel = Panel::new(title, (label, [0.0, end]), (unit, [0.0, top])).size(400, 130);
        // The load jumps: a line for each part.
        for (j, part) in rows.chunk_by(|one, next| one.load == next.load).enumerate() {
            let points = part.iter().map(|row| (row.s, row.solved[i])).collect();
            panel = panel.line(points, BLUE, if j == 0 { "involutes" } else { "" });
        }
        let hertz = rows.iter().map(|row| (row.s, row.hertz[i])).step_by(8);
        panel.dots(hertz.collect(), RED, "Hertz")
    };
    let width = along(0, "Half-width", "", "half-width / mm", 0.3);
    let label = "distance along path of contact / base pitch";
    let peak = along(1, "Peak pressure", label, "peak / MPa", 2000.0);
    drawing::save("gear_mesh", vec![vec![flanks], vec![width, peak]])
}
