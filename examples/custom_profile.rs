//! A profile of your own: two spur gear teeth, pressed together at the pitch point.
//!
//! A flank is the involute of its base circle. As a function of the angle `k` rolled off beyond the
//! pitch point it is two short formulas; as `y = f(x)` it has no closed form. Lengths in m,
//! pressures in Pa, load in N/m. The results are checked against a solution of 25 digits
//! (`tests/data/gear_involute_pitch_point.json`), and drawn to `target/figures/custom_profile.svg`.

#[path = "shared/drawing.rs"]
mod drawing;

use drawing::{BLACK, BLUE, Panel, Points, RED};
use linecontact::{Contact, Control, CurvePoint, ParametricProfile};
use std::error::Error;
use std::f64::consts::PI;

/// Flank of a tooth. `x` runs along the common tangent at the pitch point, `y` across it.
struct Flank {
    base_radius: f64,
    /// Tangent of the pressure angle: the angle rolled off up to the pitch point.
    pitch: f64,
    /// 1 for the upper tooth; -1, half a turn, for the lower one.
    side: f64,
}

impl ParametricProfile<f64> for Flank {
    fn domain(&self) -> [f64; 2] {
        [-0.36, 1.0] // from next to the base circle, where the involute begins
    }

    fn at(&self, k: f64) -> CurvePoint<f64> {
        let ((sin, cos), roll) = (k.sin_cos(), self.pitch + k);
        let scale = self.side * self.base_radius;
        CurvePoint {
            x: scale * (cos + roll * sin - 1.0),
            y: scale * (sin - roll * cos + self.pitch),
            dx: scale * roll * cos,
            dy: scale * roll * sin,
        }
    }
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let pitch = 93.0 / 256.0; // tan 19.97°
    let pinion = Flank { base_radius: 37.5e-3, pitch, side: -1.0 };
    let wheel = Flank { base_radius: 112.5e-3, pitch, side: 1.0 };
    let contact = Contact::new(&pinion, &wheel)?.contact_modulus(113.187e9);
    let solution = contact.solve(Control::Load(1571e3 / PI))?;

    let (a, b) = (solution.a(), solution.b());
    let pressure = solution.pressure()?;
    let mut points: Points = Vec::new();
    for i in 0..=2000 {
        // At equal angles: close together at the edges, where the pressure is steep.
        let x = solution.hull().at_angle(PI * f64::from(i) / 2000.0);
        points.push((x, pressure.at(x)?));
    }
    let peak = points.iter().fold(0.0f64, |peak, &(_, p)| peak.max(p));
    println!("contact from x = {:.6} mm to {:.6} mm", -b * 1e3, a * 1e3);
    println!("peak pressure {:.3} MPa", peak / 1e6);

    let outline = |flank: &Flank| -> Points {
        let [from, to] = flank.domain();
        let points = (0..=200).map(|i| flank.at(from + (to - from) * f64::from(i) / 200.0));
        points.map(|at| (1e3 * at.x, 1e3 * at.y)).collect()
    };
    let heights = [-12.0, 12.0];
    let flanks =
        Panel::new("Two flanks at the pitch point", ("x / mm", [-16.0, 16.0]), ("y / mm", heights))
            .with_equal_scales(400)
            .body(outline(&pinion), heights[0], BLUE, "")
            .body(outline(&wheel), heights[1], RED, "")
            .dots(vec![(0.0, 0.0)], BLACK, "")
            .note(-4.0, -6.0, "pinion", BLUE)
            .note(4.0, 6.0, "wheel", RED);
    let points = points.into_iter().map(|(x, p)| (1e3 * x, 1e-6 * p)).step_by(10).collect();
    let pressures = Panel::new("Pressure", ("x / mm", [-0.3, 0.3]), ("P / MPa", [0.0, 1500.0]))
        .size(400, 300)
        .body(points, 0.0, BLUE, "")
        .limit(-1e3 * b, "−b")
        .limit(1e3 * a, "a");
    println!("{}", drawing::save("custom_profile", vec![vec![flanks], vec![pressures]])?);

    assert!((a / 2.3773942151913456e-4 - 1.0).abs() < 1e-12);
    assert!((b / 2.4161411179371945e-4 - 1.0).abs() < 1e-12);
    assert!((peak / 1.3280819681515775e9 - 1.0).abs() < 1e-6, "seen on a grid of 2000 points");
    Ok(())
}
