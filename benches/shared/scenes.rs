//! Five scenes of bodies of undeclared convexity: smooth and round, folded, cornered, wavy.

use super::paper::{self, Example};
use linecontact::{Curve, CurvePoint, Flat, ParametricProfile};
use std::f64::consts::PI;

type Body = Box<dyn ParametricProfile<f64>>;

/// Two bodies, κ = 1, and the load that presses them.
pub struct Scene {
    pub lower: Body,
    pub upper: Body,
    pub load: f64,
}

/// Names of the [scenes](scene).
pub const SCENES: [&str; 5] = ["parabola", "circle", "example3", "example4", "wave"];

/// Wave number of the wave, and the largest curvature that it adds to the curvature 1 of the
/// parabola. Between its crests the gap is concave, and the load presses them flat.
const WAVE_NUMBER: f64 = 20.0;
const WAVE_CURVATURE: f64 = 1.5;

fn on_flat(
    load: f64,
    half: f64,
    point: impl Fn(f64) -> CurvePoint<f64> + Send + Sync + 'static,
) -> Scene {
    Scene { lower: Box::new(Flat), upper: Box::new(Curve::new([-half, half], point)), load }
}

fn printed(example: Example) -> Scene {
    let Example { lower, upper, c } = example;
    Scene { lower, upper, load: c / PI }
}

/// Returns a scene by its name.
///
/// # Panics
/// If there is no scene with this name.
pub fn scene(name: &str) -> Scene {
    match name {
        "parabola" => on_flat(0.02, 1.0, |k| CurvePoint { x: k, y: 0.5 * k * k, dx: 1.0, dy: k }),
        // Half the radius wide: 2 (K(m) - E(m)), m = 1/4.
        "circle" => on_flat(0.436_576_291_006_337_8 / PI, 1.0, |k| {
            let (half_sin, half_cos) = (0.5 * k).sin_cos();
            let [y, x] = [2.0 * half_sin * half_sin, 2.0 * half_sin * half_cos];
            CurvePoint { x, y, dx: 1.0 - y, dy: x }
        }),
        "example3" => printed(paper::three()),
        "example4" => printed(paper::four()),
        "wave" => on_flat(0.1, 1.0, |k| {
            let (sin, cos) = (WAVE_NUMBER * k).sin_cos();
            let slope = WAVE_CURVATURE / WAVE_NUMBER;
            let (y, dy) = (0.5 * k * k - slope / WAVE_NUMBER * cos, k + slope * sin);
            CurvePoint { x: k, y, dx: 1.0, dy }
        }),
        other => panic!("{other}: one of {SCENES:?}"),
    }
}
