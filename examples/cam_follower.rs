//! A cam and a flat follower in a simulation: the contact is solved at each step of time.
//!
//! Run with `cargo run --release --example cam_follower`. The cam drags a flywheel, lifts the
//! follower against its spring, and gets back the energy that the spring returns. Each step starts
//! a [`Solver`] from the last contact and takes the torque from the place of the new one. From the
//! second revolution on nothing is allocated. Lengths in mm, forces in N per mm of width, masses in
//! t, times in s. The place of the contact is checked against the derivative of the lift, its
//! half-width against Hertz with the cam's radius of curvature there, and the energy against its
//! first value. The cam, the place and the half-width are drawn to
//! `target/figures/cam_follower.svg`.

#[path = "shared/drawing.rs"]
mod drawing;

use drawing::{BLACK, BLUE, Panel, Points, RED, SeriesLabelPosition};
use linecontact::{Contact, ContactError, Control, CurvePoint, Flat, ParametricProfile, Solver};
use stats_alloc::{INSTRUMENTED_SYSTEM, Region, StatsAlloc};
use std::alloc::System;
use std::error::Error;
use std::f64::consts::{PI, TAU};

#[global_allocator]
pub(crate) static ALLOCATOR: &StatsAlloc<System> = &INSTRUMENTED_SYSTEM;

const MODULUS: f64 = 115e3;
const BASE: f64 = 20.0;
const LIFT: f64 = 3.0;
const FOLLOWER: f64 = 1e-5;
const FLYWHEEL: f64 = 5.0; // moment of inertia, t mm²
const SPRING: f64 = 10.0;
const PRELOAD: f64 = 100.0;
const STEP: f64 = 1e-4;
const STEPS: usize = 2000; // two revolutions

/// Errors of the simulation.
#[derive(Debug, thiserror::Error)]
enum SimulationError {
    #[error("the contact was not found: {0}")]
    Contact(#[from] ContactError<f64>),
    #[error("the follower lifts off at {time} s")]
    LiftsOff { time: f64 },
}

/// Cam turned by an angle, given by the distance h(φ) from its axis to the tangent whose normal
/// points at φ: the height of the follower when φ is on top.
struct Cam {
    angle: f64,
}

impl Cam {
    /// Returns h, h' and h''. The radius of curvature is h + h''.
    fn support(phi: f64) -> [f64; 3] {
        let (sin, cos) = (2.0 * phi).sin_cos();
        [BASE + 0.5 * LIFT * (1.0 - cos), LIFT * sin, 2.0 * LIFT * cos]
    }
}

impl ParametricProfile<f64> for Cam {
    fn domain(&self) -> [f64; 2] {
        [-0.2, 0.2]
    }

    fn at(&self, k: f64) -> CurvePoint<f64> {
        let ([h, dh, ddh], (sin, cos)) = (Self::support(self.angle + k), k.sin_cos());
        let radius = h + ddh;
        CurvePoint {
            x: h * sin + dh * cos,
            y: h * cos - dh * sin,
            dx: radius * cos,
            dy: -radius * sin,
        }
    }
}

/// State of the simulation, with its largest errors so far.
struct Simulation {
    solver: Solver<f64>,
    angle: f64,
    speed: f64,
    energy: f64,
    /// Largest relative error of the half-width, error of the place in half-widths, and relative
    /// error of the energy.
    off: [f64; 3],
    widest: f64,
    /// Angle, place and half-width at each step.
    rows: Vec<[f64; 3]>,
}

impl Simulation {
    fn new() -> Self {
        let (angle, speed) = (0.0, 10.0 * TAU);
        let energy = energy(angle, speed);
        Self {
            solver: Solver::new(),
            angle,
            speed,
            energy,
            off: [0.0; 3],
            widest: 0.0,
            rows: Vec::with_capacity(STEPS),
        }
    }

    fn step(&mut self, time: f64) -> Result<(), SimulationError> {
        let cam = Cam { angle: self.angle };
        let [h, dh, ddh] = Cam::support(self.angle);
        // Spring and inertia of the follower; the flywheel slows down as it lifts the follower.
        let inertia = FOLLOWER * ddh * self.speed * self.speed;
        let force =
            (inertia + PRELOAD + SPRING * (h - BASE)) / (1.0 + FOLLOWER * dh * dh / FLYWHEEL);
        if force <= 0.0 {
            return Err(SimulationError::LiftsOff { time });
        }
        let contact = Contact::new(&cam, &Flat)?.contact_modulus(MODULUS);
        let solution = self.solver.solve(&contact, Control::Load(force))?;
        let (arm, half_width) = (solution.hull().centre(), solution.hull().half_width());

        let hertz = (4.0 * force * (h + ddh) / (PI * MODULUS)).sqrt();
        let energy = energy(self.angle, self.speed) / self.energy - 1.0;
        let off = [half_width / hertz - 1.0, (arm - dh) / half_width, energy];
        for (worst, off) in self.off.iter_mut().zip(off) {
            *worst = worst.max(off.abs());
        }
        self.widest = self.widest.max(half_width);
        self.rows.push([self.angle, arm, half_width]);
        self.speed -= STEP * force * arm / FLYWHEEL;
        self.angle += STEP * self.speed;
        Ok(())
    }
}

fn energy(angle: f64, speed: f64) -> f64 {
    let [h, dh, _] = Cam::support(angle);
    let (lift, moving) = (h - BASE, FLYWHEEL + FOLLOWER * dh * dh);
    0.5 * moving * speed * speed + PRELOAD * lift + 0.5 * SPRING * lift * lift
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let mut simulation = Simulation::new();
    // In the first revolution the solver's memory grows to its final size.
    for step in 0..STEPS / 2 {
        simulation.step(STEP * step as f64)?;
    }
    let region = Region::new(ALLOCATOR);
    for step in STEPS / 2..STEPS {
        simulation.step(STEP * step as f64)?;
    }
    let change = region.change();
    let Simulation { angle, off: [half_width, place, energy], widest, rows, .. } = simulation;
    println!("{:.3} revolutions, half-width up to {widest:.4} mm", angle / TAU);
    println!("half-width off Hertz by no more than {half_width:.1e}");
    println!("place off the derivative of the lift by {place:.1e} half-widths");
    println!("energy kept to {energy:.1e}, {} allocations in the second half", change.allocations);
    println!("{}", draw(&rows)?);

    assert_eq!(change.allocations + change.reallocations, 0);
    assert!(half_width < 1e-4 && place < 2e-3, "{half_width} {place}");
    assert!(energy < 1e-3, "{energy}");
    Ok(())
}

/// Draws the cam below its follower, with the place and the half-width of the contact, and returns
/// a line that names the file.
fn draw(rows: &[[f64; 3]]) -> Result<String, Box<dyn Error>> {
    let angle = 0.8;
    let ([h, dh, _], cam) = (Cam::support(angle), Cam { angle });
    let outline: Points =
        (0..=180).map(|i| cam.at(f64::from(i) * TAU / 180.0)).map(|at| (at.x, at.y)).collect();
    let picture = Panel::new(
        "The cam and its flat follower",
        ("x / mm", [-27.0, 27.0]),
        ("y / mm", [-25.0, 29.0]),
    )
    .with_equal_scales(360)
    .area(outline.clone(), drawing::tint(BLUE, 0.18))
    .line(outline, BLUE, "")
    .body(vec![(-24.0, h), (24.0, h)], h + 5.0, RED, "")
    .dots(vec![(0.0, 0.0), (dh, h)], BLACK, "")
    .note(0.0, -1.0, "axis", BLACK)
    .note(dh, h - 1.0, "contact", BLACK);
    let turn: Vec<_> = rows.iter().take_while(|row| row[0] <= TAU).step_by(4).collect();
    let over = |i: usize| -> Points { turn.iter().map(|row| (row[0] / TAU, row[i])).collect() };
    let axis = |label, y, range| ((label, [0.0, 1.0]), (y, range));
    let (x, y) = axis("", "x / mm", [-4.0, 9.0]);
    let known =
        over(1).into_iter().map(|(turn, _)| (turn, Cam::support(turn * TAU)[1])).step_by(12);
    let place = Panel::new("Where they touch", x, y)
        .size(420, 150)
        .legend(SeriesLabelPosition::UpperMiddle)
        .line(over(1), BLUE, "contact")
        .dots(known.collect(), RED, "derivative of the lift");
    let (x, y) = axis("revolutions", "half-width / mm", [0.0, 0.25]);
    let width =
        Panel::new("Half-width of the contact", x, y).size(420, 150).line(over(2), BLUE, "");
    drawing::save("cam_follower", vec![vec![picture], vec![place, width]])
}
