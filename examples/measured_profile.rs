//! From a measuring machine's file to the contact: a roller, its profile measured with noise.
//!
//! Run with `cargo run --release --example measured_profile`. It writes the points of a circle, with
//! noise, to `target/measured_profile.txt`, as a machine would, reads them back, smooths them and
//! solves; since it is a circle, the answer is known. The pressure is drawn to
//! `target/figures/measured_profile.svg`. Lengths in mm, pressures in MPa, load in N/mm.

use kuva::prelude::*;
use linecontact::profile::{Fit, Spline, SplineError};
use linecontact::reference::{ClosedForm, Ellipse};
use linecontact::{Contact, Control, Flat};
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
    fs::create_dir_all("target/figures")?;
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
        use linecontact::ParametricProfile;
        let off = |i: i32| body.at(1e-3 * f64::from(i)).dy - exact.slope(1e-3 * f64::from(i));
        ((-240..=240).map(|i| off(i).powi(2)).sum::<f64>() / 481.0).sqrt()
    };
    println!("slopes off by {:.1e} as measured, {:.1e} smoothed", slope(&raw), slope(&smooth));

    // A speck of dust is named by its row.
    let mut dusty = points.clone();
    dusty[1233][1] += 0.005;
    let error = Spline::through(&dusty).map(|_| ()).expect_err("dust");
    println!("with a speck of dust: {error}");

    let line = |points: Vec<(f64, f64)>, color, legend| -> Plot {
        let line = LinePlot::new().with_data(points).with_color(color).with_legend(legend);
        line.with_stroke_width(2.0).into()
    };
    let x: Vec<f64> = (1..200).map(|i| on.at_angle(PI * f64::from(i) / 200.0)).collect();
    let mut pressures = vec![0.0; x.len()];
    pressure.at_many(&x, &mut pressures)?;
    let solved = x.iter().copied().zip(pressures).collect();
    let known = x.iter().map(|&x| (x, exact.pressure(x, kappa))).collect();
    let plots = vec![line(known, "#b5401a", "the circle"), line(solved, "#1f5fa8", "as measured")];
    let layout = Layout::auto_from_plots(&plots)
        .with_title("A measured roller on a flat")
        .with_x_label("x / mm")
        .with_y_label("P / MPa")
        .with_y_axis_min(0.0);
    fs::write("target/figures/measured_profile.svg", kuva::render_to_svg(plots, layout))?;

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
