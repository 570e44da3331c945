//! A follower that lifts off its cam: `Pair` at every step of a simulation, beside Hertz's law.
//!
//!     cargo run --release --example lifting_follower
//!     STEPS=1000000 cargo run --release --example lifting_follower

#[path = "shared/drawing.rs"]
mod drawing;

use drawing::{BLUE, GRAY, Panel, RED, SeriesLabelPosition, tint};
use linecontact::{
    Curve, CurvePoint, Flat, Material, Pair, ParametricProfile, Pose, Reference, References,
};
use std::error::Error;
use std::f64::consts::{PI, TAU};
use std::time::{Duration, Instant};

/// Radius and eccentricity of a round cam, length of its references: mm.
const RADIUS: f64 = 20.0;
const ECCENTRICITY: f64 = 4.0;
const LENGTH: f64 = 30.0;
const STEEL: [f64; 2] = [206e3, 0.3];

/// Mass of the follower, stiffness and preload of its spring, and damping of its guide, for each mm
/// of width: t/mm, MPa, N/mm, MPa s.
const MASS: f64 = 2e-5;
const SPRING: f64 = 0.1;
const PRELOAD: f64 = 0.5;
const DAMPING: f64 = 2e-3;

/// Speed of the cam, 1 500 turns a minute: radians/s.
const SPEED: f64 = 25.0 * TAU;

/// Steps of one turn.
const STEPS: usize = 20_000;

/// Returns the pose of the cam at an angle of its shaft: being round it need not turn, and its half
/// that is described always faces the follower.
fn cam(angle: f64) -> Pose<f64> {
    Pose { x: ECCENTRICITY * angle.sin(), y: -ECCENTRICITY * angle.cos(), angle: PI }
}

/// Returns the pose of the follower at a height: its y axis points down to the cam.
fn follower(height: f64) -> Pose<f64> {
    Pose { x: 0.0, y: height, angle: PI }
}

/// Returns the load at an approach by Hertz, with displacements of both bodies against a length.
fn hertz(approach: f64, guess: &mut f64) -> f64 {
    if approach <= 0.0 {
        return 0.0;
    }
    let compliance = (1.0 - STEEL[1] * STEEL[1]) / STEEL[0];
    // F by a², and δ by F and a.
    let load = |a: f64| PI / (8.0 * compliance) * a * a / RADIUS;
    let mut ln_a = guess.ln();
    for _ in 0..50 {
        let a = ln_a.exp();
        let log = (2.0 * LENGTH / a).ln();
        let share = 2.0 * compliance / PI * load(a);
        let (found, rate) = (share * (2.0 * log + 1.0), share * 4.0 * log);
        let step = (approach / found).ln() * found / rate;
        ln_a += step;
        if step.abs() < 1e-13 {
            break;
        }
    }
    *guess = ln_a.exp();
    load(ln_a.exp())
}

/// States of a follower over the steps: height, load, and the time that its forces took.
struct Run {
    heights: Vec<f64>,
    loads: Vec<f64>,
    time: Duration,
}

/// Integrates the motion by velocity steps (Verlet).
fn run(steps: usize, mut force: impl FnMut(f64, f64) -> f64) -> Run {
    let step = TAU / SPEED / STEPS as f64;
    let start = RADIUS - ECCENTRICITY;
    // At rest on its spring, at the lowest place of the cam.
    let (mut height, mut speed) = (start, 0.0);
    let mut found = Run { heights: vec![], loads: vec![], time: Duration::ZERO };
    let mut load = force(0.0, height);
    for i in 1..=steps {
        let pull = |height: f64, load: f64| load - PRELOAD - SPRING * (height - start);
        speed += 0.5 * step / MASS * (pull(height, load) - DAMPING * speed);
        height += step * speed;
        let asked = Instant::now();
        load = force(TAU * i as f64 / STEPS as f64, height);
        found.time += asked.elapsed();
        let damped = 1.0 + 0.5 * step * DAMPING / MASS;
        speed = (speed + 0.5 * step / MASS * pull(height, load)) / damped;
        found.heights.push(height);
        found.loads.push(load);
    }
    found
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let steps = std::env::var("STEPS").map_or(Ok(STEPS), |steps| steps.parse())?;
    // The lower half of the cam, about its centre: it faces the follower in the follower's frame.
    let round = Curve::new([-1.2, 1.2], |k: f64| {
        let (sin, cos) = k.sin_cos();
        CurvePoint { x: RADIUS * sin, y: -RADIUS * cos, dx: RADIUS * cos, dy: RADIUS * sin }
    });
    let steel = Material::elastic(STEEL[0], STEEL[1]);
    let length = Reference::Length(LENGTH);
    let to = References { x: 0.0, lower: length, upper: length };
    let bodies: [&dyn ParametricProfile<f64>; 2] = [&Flat, &round];
    let mut pair = Pair::new(bodies[0], bodies[1], (steel, steel), to);
    let mut fault = None;
    let by_pair = run(steps, |angle, height| match pair.at(follower(height), cam(angle)) {
        // On the follower the force acts the other way.
        Ok(wrench) => -wrench.force[1],
        Err(error) => {
            fault.get_or_insert(error);
            0.0
        }
    });
    if let Some(error) = fault {
        return Err(error.into());
    }
    let mut guess = 1e-3;
    let by_hertz = run(steps, |angle, height| {
        let centre = -ECCENTRICITY * angle.cos();
        hertz(RADIUS + centre - height, &mut guess)
    });
    let lifted = by_pair.loads.iter().filter(|&&load| load == 0.0).count();
    let largest = by_pair.loads.iter().fold(0.0f64, |most, load| most.max(*load));
    println!("{steps} steps, lifted for {lifted} of them; largest load {largest:.2} N/mm");
    // Impacts magnify differences: the first turn is compared.
    let first = by_pair.heights.iter().zip(&by_hertz.heights).take(STEPS);
    let apart = first.fold(0.0f64, |most, (one, other)| most.max((one - other).abs()));
    println!("heights differ from those by Hertz's law by up to {apart:.0e} mm in the first turn");
    let [own, law] = [&by_pair, &by_hertz].map(|run| run.time.as_secs_f64() / steps as f64);
    println!("{:.1} µs a step, {:.0} times Hertz's law", 1e6 * own, own / law);
    assert!(lifted > 0 && lifted < steps && apart < 1e-3, "{lifted} {apart:e}");
    println!("{}", drawing::save("lifting_follower", vec![vec![lift(&by_pair), load(&by_pair)]])?);
    Ok(())
}

/// Lists every tenth value over the angle in degrees, in the first turn.
fn over_angle(values: impl Iterator<Item = f64>) -> Vec<(f64, f64)> {
    let degrees = |i: usize| 360.0 * (i + 1) as f64 / STEPS as f64;
    values.enumerate().take(STEPS).step_by(10).map(|(i, value)| (degrees(i), value)).collect()
}

/// Draws the rise of the follower, and that of the cam below it.
fn lift(run: &Run) -> Panel {
    let start = RADIUS - ECCENTRICITY;
    let cam = over_angle(
        (1..=STEPS).map(|i| ECCENTRICITY * (1.0 - (TAU * i as f64 / STEPS as f64).cos())),
    );
    let axes = (("angle / °", [0.0, 360.0]), ("rise / mm", [0.0, 12.0]));
    Panel::new("A follower at 1 500 turns a minute", axes.0, axes.1)
        .size(400, 220)
        .legend(SeriesLabelPosition::UpperRight)
        .line(over_angle(run.heights.iter().map(|height| height - start)), BLUE, "follower")
        .dashed(cam, GRAY, "cam")
}

/// Draws the envelope of the load: its least and its largest value within 4.5°. A contact that
/// nothing damps vibrates hundreds of times in a turn.
fn load(run: &Run) -> Panel {
    const WITHIN: usize = STEPS / 80;
    let over = |of: fn(f64, f64) -> f64| -> Vec<(f64, f64)> {
        let parts = run.loads.chunks(WITHIN).take(80).enumerate();
        let value = |loads: &[f64]| loads.iter().copied().reduce(of).unwrap_or(0.0);
        parts.map(|(i, loads)| (4.5 * (i as f64 + 0.5), value(loads))).collect()
    };
    let (least, largest) = (over(f64::min), over(f64::max));
    let most = largest.iter().fold(0.0f64, |most, (_, load)| most.max(*load));
    let between = least.iter().chain(largest.iter().rev()).copied().collect();
    let axes = (("angle / °", [0.0, 360.0]), ("load / (N/mm)", [0.0, 1.1 * most]));
    Panel::new("Its least and largest load within 4.5°", axes.0, axes.1)
        .size(400, 220)
        .area(between, tint(RED, 0.3))
        .line(least, RED, "")
        .line(largest, RED, "")
}
