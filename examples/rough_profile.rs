//! A rough roller on a flat, from light to heavy loads: the number of contacts, and their places.
//!
//! Run with `cargo run --release --example rough_profile`. The profile is made of measured points,
//! simulated here as a circle with four waves and the noise of the machine, and smoothed by a
//! `Spline`. One `Solver` solves sixteen loads, each from the contacts of the one before. The
//! pressures over the profile, and the number of contacts against the load, are drawn to
//! `target/figures/rough_profile.svg`. Lengths in mm, pressures in MPa, loads in N/mm.
//!
//! As the load grows, contacts appear and merge, and limits only move outwards (Buyarov and
//! Rakhmanov, 1999). This is checked from each load to the next.

#[path = "shared/drawing.rs"]
mod drawing;

use drawing::{BLUE, Panel, Points, RED, SeriesLabelPosition, mix, tint};
use linecontact::profile::{Fit, Spline};
use linecontact::{Contact, Control, Cost, Flat, Interval, ParametricProfile, Solution, Solver};
use std::error::Error;
use std::f64::consts::PI;

const RADIUS: f64 = 60.0;
const MODULUS: f64 = 115e3;
/// Length and height of each wave, and its phase.
const WAVES: [[f64; 3]; 4] =
    [[0.81, 0.6e-3, 0.4], [0.37, 0.3e-3, 1.9], [0.23, 0.17e-3, 4.0], [0.11, 0.06e-3, 2.2]];
const NOISE: f64 = 0.02e-3; // standard deviation of the heights
const POINTS: i32 = 600; // on either side, 5 micrometres apart
const LOADS: [f64; 2] = [1.0, 4000.0];
const COUNT: usize = 16;

/// Result for one load.
struct Pressed {
    load: f64,
    contacts: Vec<Interval<f64>>,
    /// Pairs of x and P(x) from the first limit to the last.
    pressures: Vec<(f64, f64)>,
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let body = Spline::fitted(&measurement(), Fit { smooth: true, ..Fit::default() })?;
    let contact = Contact::new(&Flat, &body)?.contact_modulus(MODULUS);
    let mut solver = Solver::new();
    let mut all = Vec::with_capacity(COUNT);
    println!("    F, N/mm  contacts  touching, mm  peak, MPa  evaluations");
    for i in 0..COUNT {
        let share = i as f64 / (COUNT - 1) as f64;
        let load = LOADS[0] * (LOADS[1] / LOADS[0]).powf(share);
        let solution = solver.solve(&contact, Control::Load(load))?;
        let cost = solution.cost();
        let pressed = pressed(load, &solution)?;
        let touching: f64 = pressed.contacts.iter().map(|on| on.right - on.left).sum();
        let peak = pressed.pressures.iter().fold(0.0, |peak, &(_, p)| p.max(peak));
        let (count, evaluations) = (pressed.contacts.len(), cost.evaluations);
        println!("{load:11.2} {count:9} {touching:13.4} {peak:10.1} {evaluations:12}");
        all.push(pressed);
    }
    println!("{}", draw(&body, &all)?);
    check(&body, &all);
    Ok(())
}

/// Returns the pressures of a solution, at places that are close together where a contact ends.
fn pressed(load: f64, solution: &Solution<f64>) -> Result<Pressed, Box<dyn Error>> {
    const PLACES: u32 = 800;
    let (contacts, pressure) = (solution.intervals().to_vec(), solution.pressure()?);
    let mut pressures = Vec::new();
    for on in &contacts {
        for i in (0..=PLACES).rev() {
            let x = on.at_angle(PI * f64::from(i) / f64::from(PLACES));
            pressures.push((x, pressure.estimate(x, &mut Cost::default())?.value));
        }
    }
    Ok(Pressed { load, contacts, pressures })
}

/// Checks what holds for any profile.
fn check(body: &Spline<f64>, all: &[Pressed]) {
    let [from, to] = body.domain();
    let heights = (0..=4000).map(|i| from + (to - from) * f64::from(i) / 4000.0);
    let lowest = heights.min_by(|&a, &b| body.at(a).y.total_cmp(&body.at(b).y)).unwrap_or(f64::NAN);
    let touches = |on: &Interval<f64>| on.left < lowest + 0.001 && lowest - 0.001 < on.right;
    assert!(all[0].contacts.iter().any(touches), "the lowest point, {lowest}, does not touch");
    for pair in all.windows(2) {
        for light in &pair[0].contacts {
            let rounding = 1e-9;
            let within = |heavy: &Interval<f64>| {
                heavy.left <= light.left + rounding && light.right <= heavy.right + rounding
            };
            assert!(pair[1].contacts.iter().any(within), "{light:?} at {} is lost", pair[0].load);
        }
    }
    for Pressed { load, contacts, pressures } in all {
        let peak = pressures.iter().fold(0.0, |peak: f64, &(_, p)| p.max(peak));
        assert!(pressures.iter().all(|&(_, p)| p >= -1e-9 * peak), "a pull under {load}");
        // Trapezoidal rule; between two contacts the pressure is zero.
        let strip = |two: &[(f64, f64)]| 0.5 * (two[1].0 - two[0].0) * (two[0].1 + two[1].1);
        let sum: f64 = pressures.windows(2).map(strip).sum();
        assert!((sum / load - 1.0).abs() < 1e-3, "{sum} is not {load}");
        assert!(contacts.windows(2).all(|two| two[0].right < two[1].left));
    }
    assert!(all.iter().any(|pressed| pressed.contacts.len() > 2), "not that rough, is it");
    assert_eq!(all[COUNT - 1].contacts.len(), 1, "all pressed flat");
}

/// Makes the points of a machine: x and y.
fn measurement() -> Vec<[f64; 2]> {
    let mut state = 1u64;
    let mut uniform = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    let mut point = |i: i32| {
        let x = 0.005 * f64::from(i);
        let wave =
            |[length, height, phase]: [f64; 3]| height * (2.0 * PI * x / length + phase).cos();
        let normal = (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
        let circle = RADIUS - (RADIUS * RADIUS - x * x).sqrt();
        [x, circle + WAVES.into_iter().map(wave).sum::<f64>() + NOISE * normal]
    };
    (-POINTS..=POINTS).map(&mut point).collect()
}

/// Draws some of the pressures over the profile, and returns a line that names the file.
fn draw(body: &Spline<f64>, all: &[Pressed]) -> Result<String, Box<dyn Error>> {
    let widest = &all[all.len() - 1].contacts[0];
    let range = [widest.left - 0.1, widest.right + 0.1];
    let axes = (("", range), ("P / MPa", [0.0, 3500.0]));
    let mut pressures = Panel::new("Pressure under loads from 1 to 4000 N/mm", axes.0, axes.1)
        .size(560, 280)
        .legend(SeriesLabelPosition::UpperLeft);
    for (i, pressed) in all.iter().enumerate().step_by(3) {
        // From light blue to red; each curve goes down to zero between two contacts.
        let color = mix(tint(BLUE, 0.5), RED, i as f64 / (COUNT - 1) as f64);
        for (j, on) in pressed.contacts.iter().enumerate() {
            let here: Points =
                pressed.pressures.iter().filter(|at| on.contains(at.0)).copied().collect();
            let label = if j == 0 { format!("{:.0} N/mm", pressed.load) } else { String::new() };
            // About two points per pixel, and the last one.
            let every = (2.5 / (on.right - on.left)).clamp(1.0, 20.0) as usize;
            let last = here[here.len() - 1];
            let drawn = here.into_iter().step_by(every).chain([last]).collect();
            pressures = pressures.line(drawn, color, &label);
        }
    }
    let x = (0..=400).map(|i| range[0] + (range[1] - range[0]) * f64::from(i) / 400.0);
    let heights: Points = x.map(|x| (x, 1e3 * body.at(x).y)).collect();
    let flat = heights.iter().fold(f64::INFINITY, |least, at| least.min(at.1));
    let profile = Panel::new("The profile, on a flat", ("x / mm", range), ("y / µm", [-2.0, 16.0]))
        .size(560, 150)
        .body(vec![(range[0], flat), (range[1], flat)], -2.0, BLUE, "")
        .body(heights, 16.0, RED, "");
    let counts: Points =
        all.iter().map(|one| (one.load.log10(), one.contacts.len() as f64)).collect();
    let most = counts.iter().fold(0.0, |most: f64, at| most.max(at.1));
    let counts = Panel::new("Contacts", ("F / (N/mm)", [0.0, 3.7]), ("number", [0.0, most + 1.0]))
        .size(560, 120)
        .powers(true, false)
        .dots(counts, BLUE, "");
    drawing::save("rough_profile", vec![vec![pressures, profile, counts]])
}
