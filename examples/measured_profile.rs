//! From a measuring machine's file to the contact: a roller whose profile is measured with noise.
//!
//! Run with `cargo run --release --example measured_profile`. It writes the points of a circle,
//! with noise, to `target/measured_profile.txt`, as a machine would. Then it reads them back,
//! smooths them and solves. Since the body is a circle, the answer is known. The pressure is drawn
//! to `target/figures/measured_profile.svg`. Lengths in mm, pressures in MPa, load in N/mm.
//!
//! At last it prints the errors of limits and peak for several numbers of points, and for a noise
//! that is given a tenth too small or too large. Two of them are in the README.

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
/// Half-widths relative to the radius, and numbers of points, of the table.
const SIZES: [(f64, i32); 6] =
    [(0.02, 401), (0.02, 4001), (0.1, 401), (0.1, 4001), (0.22, 401), (0.22, 4001)];

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    fs::create_dir_all("target")?;
    fs::write("target/measured_profile.txt", measurement(&mut Random(1))?)?;
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

    // The error names a speck of dust by its row.
    let mut dusty = points.clone();
    dusty[1233][1] += 0.005;
    let error = Spline::through(&dusty).map(|_| ()).expect_err("dust");
    println!("with a speck of dust: {error}");

    let x: Vec<f64> = (0..=200).map(|i| on.at_angle(PI * f64::from(i) / 200.0)).collect();
    let mut pressures = vec![0.0; x.len()];
    pressure.at_many(&x, &mut pressures)?;
    let solved: Points = x.iter().copied().zip(pressures).collect();
    let known = x.iter().map(|&x| (x, exact.pressure(x, kappa))).step_by(8).collect();
    // Height of the measured and the smoothed profile above the circle, in micrometres.
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
        ("y − y(circle) / µm", [-0.4, 0.7]),
    )
    .size(520, 170)
    .dots(near, GRAY, "measured")
    .line(fitted.collect(), BLUE, "smoothed");
    let pressures = Panel::new("Pressure on a flat", ("x / mm", range), ("P / MPa", [0.0, 1600.0]))
        .size(520, 220)
        .legend(SeriesLabelPosition::LowerMiddle)
        .line(solved, BLUE, "smoothed")
        .dots(known, RED, "of the circle")
        .limit(on.left, "−b")
        .limit(on.right, "a");
    println!("{}", drawing::save("measured_profile", vec![vec![heights, pressures]])?);

    assert!(off.into_iter().all(|off| off.abs() < 0.01), "{off:?}");
    assert!(slope(&smooth) < 0.003 * slope(&raw));
    assert!(matches!(error, SplineError::Outlier { row: 1234, .. }));
    table()
}

/// Makes the file of the machine: x and y in each line.
fn measurement(random: &mut Random) -> Result<String, std::fmt::Error> {
    let mut text = String::new();
    for i in -POINTS..=POINTS {
        let x = 1e-3 * f64::from(i);
        let y = RADIUS - (RADIUS * RADIUS - x * x).sqrt() + NOISE * random.normal();
        writeln!(text, "{x:.3} {y:.6}")?;
    }
    Ok(text)
}

/// Prints the largest errors of twenty measurements of a circle, over four half-widths to either
/// side, with noise of 1e-5 of the radius.
fn table() -> Result<(), Box<dyn Error>> {
    let noise = 1e-5;
    println!("noise 1e-5 R, points over four half-widths to either side, largest errors of 20:");
    println!("         noise given: 0.9 of it         all            1.1 of it");
    println!("L/R    points   limits   peak    limits   peak    limits   peak");
    let mut of_readme = Vec::new();
    for (half_width, count) in SIZES {
        print!("{half_width:<5} {count:7}");
        let exact = Ellipse::circle(1.0, half_width)?;
        for given in [0.9, 1.0, 1.1] {
            let mut worst = [0.0f64; 2];
            for seed in 0..20 {
                let mut random = Random(seed);
                let point = |i: i32| {
                    let x = 4.0 * half_width * (f64::from(2 * i) / f64::from(count - 1) - 1.0);
                    [x, 1.0 - ((1.0 - x) * (1.0 + x)).sqrt() + noise * random.normal()]
                };
                let points: Vec<_> = (0..count).map(point).collect();
                let body = Spline::fitted(&points, Fit { noise: given * noise, ..Fit::default() })?;
                let solution = Contact::new(&Flat, &body)?.solve(Control::Load(exact.load(1.0)))?;
                let limits = [solution.a(), solution.b()].map(|x| (x / half_width - 1.0).abs());
                let peak = solution.peak()?.pressure / exact.pressure(0.0, 1.0) - 1.0;
                worst = [worst[0].max(limits[0]).max(limits[1]), worst[1].max(peak.abs())];
            }
            print!("  {:7.0e} {:7.0e}", worst[0], worst[1]);
            if count == 4001 && given == 1.0 {
                of_readme.push(worst);
            }
        }
        println!();
    }
    let readme = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/README.md"))?;
    for (i, name) in ["limits, 4001 measured points, noise 1e-5 R", "peak pressure, the same"]
        .into_iter()
        .enumerate()
    {
        let [narrow, wide] = [of_readme[0][i], of_readme[1][i]];
        let row = format!("|{name}|{narrow:.0e} at L/R = 0.02, {wide:.0e} at 0.1|");
        assert!(readme.contains(&row), "the README has another row than {row}");
    }
    Ok(())
}

/// Generator of random numbers, the same in every run.
struct Random(u64);

impl Random {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    /// Returns a number of nearly normal distribution.
    fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.uniform()).sum::<f64>() - 6.0
    }
}

/// Reads the points of a file with two numbers in each line.
fn read(text: &str) -> Result<Vec<[f64; 2]>, Box<dyn Error>> {
    let point = |(row, line): (usize, &str)| {
        let numbers: Vec<f64> =
            line.split_whitespace().map(str::parse).collect::<Result<_, _>>()?;
        numbers.try_into().map_err(|_| format!("row {}: two numbers, please", row + 1).into())
    };
    text.lines().enumerate().map(point).collect()
}
