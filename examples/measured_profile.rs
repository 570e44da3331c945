//! From a measuring machine's file to the contact: a roller, its profile measured with noise.
//!
//! Run with `cargo run --release --example measured_profile`. It writes the points of a circle, with
//! noise, to `target/measured_profile.txt`, as a machine would, reads them back, smooths them and
//! solves; since it is a circle, the answer is known. The pressure is drawn to
//! `target/figures/measured_profile.svg`. Lengths in mm, pressures in MPa, load in N/mm.

#[path = "shared/drawing.rs"]
mod drawing;

use drawing::{BLUE, GRAY, Panel, Points, RED, SeriesLabelPosition};
use linecontact::profile::{Fit, Spline, SplineError};
use linecontact::reference::{ClosedForm, Ellipse};
use linecontact::{Contact, Control, Flat, ParametricProfile};
use std::error::Error;
use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt::Write;
use std::fs;

const RADIUS: f64 = 10.0;
const HALF_WIDTH: f64 = 0.25;
const MODULUS: f64 = 115e3;
const NOISE: f64 = 1e-4; // standard deviation of the heights, a tenth of a micrometre
const POINTS: i32 = 2000; // on either side, a micrometre apart

fn main() -> Result<(), Box<dyn Error>> {
    fs::create_dir_all("target")?;
    fs::write("target/measured_profile.txt", measurement()?)?;
    let points = read(&fs::read_to_string("target/measured_profile.txt")?)?;
    let (raw, smooth) = (
        Spline::through(&points)?,
        Spline::fitted(&points, Fit { noise: NOISE, ..Fit::default() })?,
    );

    let kappa = FRAC_PI_2 * MODULUS;
    let exact = Ellipse::circle(RADIUS, HALF_WIDTH)?;
    let contact = Contact::new(&Flat, &smooth)?.contact_modulus(MODULUS);
    let solution = contact.solve(Control::Load(exact.load(kappa)))?;
    let (on, pressure) = (solution.hull(), solution.pressure()?);
    let middle = pressure.at(0.0)?;
    let off = [on.right / HALF_WIDTH, -on.left / HALF_WIDTH, middle / exact.pressure(0.0, kappa)];
    let off = off.map(|ratio| ratio - 1.0);
    println!("{} points, from {:.4} to {:.4} mm", points.len(), on.left, on.right);
    println!("off by {:.1e} and {:.1e}, pressure in the middle by {:.1e}", off[0], off[1], off[2]);

    let slope = |body: &Spline<f64>| {
        let off = |i: i32| body.at(1e-3 * f64::from(i)).dy - exact.slope(1e-3 * f64::from(i));
        ((-240..=240).map(|i| off(i).powi(2)).sum::<f64>() / 481.0).sqrt()
    };
    println!("slopes off by {:.1e} as measured, {:.1e} smoothed", slope(&raw), slope(&smooth));

    // A speck of dust is named by its row.
    let mut dusty = points.clone();
    dusty[1233][1] += 0.005;
    let error = Spline::through(&dusty).map(|_| ()).expect_err("dust");
    println!("with a speck of dust: {error}");

    let x: Vec<f64> = (1..200).map(|i| on.at_angle(PI * f64::from(i) / 200.0)).collect();
    let mut pressures = vec![0.0; x.len()];
    pressure.at_many(&x, &mut pressures)?;
    let solved: Points = x.iter().copied().zip(pressures).collect();
    let known = x.iter().map(|&x| (x, exact.pressure(x, kappa))).step_by(6).collect();
    // What is measured and smoothed beyond the circle, in micrometres.
    let beyond = |x: f64, y: f64| (x, 1e3 * (y - RADIUS + (RADIUS * RADIUS - x * x).sqrt()));
    let range = [-0.3, 0.3];
    let near: Points = points
        .iter()
        .map(|&[x, y]| beyond(x, y))
        .filter(|at| at.0.abs() <= 0.3)
        .step_by(2)
        .collect();
    let fitted = (-100..=100).map(|i| 0.003 * f64::from(i)).map(|x| beyond(x, smooth.at(x).y));
    let heights = Panel::new(
        "A measured roller: heights beyond the circle",
        ("", range),
        ("y − y(circle) / µm", [-0.4, 0.6]),
    )
    .size(520, 170)
    .dots(near, GRAY, "measured")
    .line(fitted.collect(), BLUE, "smoothed");
    let pressures = Panel::new("Pressure on a flat", ("x / mm", range), ("P / MPa", [0.0, 1600.0]))
        .size(520, 220)
        .legend(SeriesLabelPosition::LowerMiddle)
        .line(solved, BLUE, "as measured")
        .dots(known, RED, "of the circle")
        .limit(on.left, "−b")
        .limit(on.right, "a");
    println!("{}", drawing::save("measured_profile", vec![vec![heights, pressures]])?);

    assert!(off.into_iter().all(|off| off.abs() < 0.01), "{off:?}");
    assert!(slope(&smooth) < 0.003 * slope(&raw));
    assert!(matches!(error, SplineError::Outlier { row: 1234, .. }));
    Ok(())
}

/// What the machine writes: x and y in each line.
fn measurement() -> Result<String, std::fmt::Error> {
    let mut state = 1u64;
    let mut uniform = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    let mut text = String::new();
    for i in -POINTS..=POINTS {
        let x = 1e-3 * f64::from(i);
        let normal = (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
        let y = RADIUS - (RADIUS * RADIUS - x * x).sqrt() + NOISE * normal;
        writeln!(text, "{x:.3} {y:.6}")?;
    }
    Ok(text)
}

/// The points of a file with two numbers in each line.
fn read(text: &str) -> Result<Vec<[f64; 2]>, Box<dyn Error>> {
    let point = |(row, line): (usize, &str)| {
        let numbers: Vec<f64> =
            line.split_whitespace().map(str::parse).collect::<Result<_, _>>()?;
        numbers.try_into().map_err(|_| format!("row {}: two numbers, please", row + 1).into())
    };
    text.lines().enumerate().map(point).collect()
}
