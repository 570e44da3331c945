//! From a measuring machine's file to the contact: a roller whose profile is measured with noise.
//!
//! Run with `cargo run --release --example measured_profile`. It writes the points of a circle,
//! with noise, to `target/measured_profile.txt`, as a machine would. Then it reads them back,
//! smooths them and solves. Since the body is a circle, the answer is known. The pressure is drawn
//! to `target/figures/measured_profile.svg`. Lengths in mm, pressures in MPa, load in N/mm.
//!
//! At last it prints the errors of half-width and peak for several numbers of points, and how often
//! they are within twice the standard deviation that the solution states. Two rows are in the
//! README. `-- --all` prints the table of docs/accuracy.md, of 200 measurements each.

#[path = "shared/drawing.rs"]
mod drawing;

use drawing::{BLUE, GRAY, Panel, Points, RED, SeriesLabelPosition};
use linecontact::profile::{Fit, Spline, SplineError};
use linecontact::reference::{ClosedForm, Ellipse};
use linecontact::{Contact, Control, Curve, CurvePoint, Flat, ParametricProfile};
use std::error::Error;
use std::f64::consts::{FRAC_PI_2, PI};
use std::fmt::Write;
use std::fs;

const RADIUS: f64 = 10.0;
const HALF_WIDTH: f64 = 0.25;
const MODULUS: f64 = 115e3;
const NOISE: f64 = 1e-4; // standard deviation of the heights, a tenth of a micrometre
const POINTS: i32 = 2000; // on either side, a micrometre apart
/// Noise, half-widths and numbers of points of the table; the radius is 1.
const USUAL: Table = Table {
    crowned: &[false],
    noises: &[1e-5],
    half_widths: &[0.02, 0.1, 0.3],
    counts: &[401, 4001],
    measurements: 20,
};
const ALL: Table = Table {
    crowned: &[false, true],
    noises: &[1e-6, 1e-5, 1e-4],
    half_widths: &[0.01, 0.03, 0.1, 0.3],
    counts: &[200, 2000, 20_000],
    measurements: 200,
};

struct Table {
    crowned: &'static [bool],
    noises: &'static [f64],
    half_widths: &'static [f64],
    counts: &'static [usize],
    measurements: u64,
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    fs::create_dir_all("target")?;
    fs::write("target/measured_profile.txt", measurement(&mut Random(1))?)?;
    let points = read(&fs::read_to_string("target/measured_profile.txt")?)?;
    let fit = Fit { smooth: true, ..Fit::default() };
    let (raw, smooth) = (Spline::through(&points)?, Spline::fitted(&points, fit)?);

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
    let uncertainty = solution.uncertainty()?;
    let deviations = [uncertainty.a / HALF_WIDTH, uncertainty.b / HALF_WIDTH];
    let peak = uncertainty.peak_pressure / middle;
    println!("expected: {:.1e} and {:.1e}, {peak:.1e}", deviations[0], deviations[1]);
    println!("noise {:.2e} mm, {NOISE:.0e} in truth", smooth.noise());

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

    let stated = [deviations[0], deviations[1], peak];
    assert!(off.iter().zip(stated).all(|(off, stated)| off.abs() < 2.0 * stated), "{off:?}");
    assert!(slope(&smooth) < 0.003 * slope(&raw));
    assert!(matches!(error, SplineError::Outlier { row: 1234, .. }));
    if std::env::args().any(|argument| argument == "--all") { ALL.print() } else { USUAL.print() }
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

/// Errors of the measurements of one body.
#[derive(Default)]
struct Errors {
    /// Largest relative errors of half-width and peak.
    largest: [f64; 2],
    /// Numbers of errors within two standard deviations.
    within: [u64; 2],
}

impl Table {
    /// Measures bodies of radius 1 over half of it to either side, and compares the contacts.
    fn print(&self) -> Result<(), Box<dyn Error>> {
        println!("|body|noise/R|L/R|points|half-width|within 2σ|peak|within 2σ|");
        println!("|---|---|---|---|---|---|---|---|");
        let mut of_readme = Vec::new();
        for &crowned in self.crowned {
            for &noise in self.noises {
                for &half_width in self.half_widths {
                    for &count in self.counts {
                        let errors = self.errors(crowned, noise, half_width, count)?;
                        let [half, peak] = errors.largest;
                        let [first, second] = errors.within.map(|n| 100 * n / self.measurements);
                        let body = if crowned { "crowned" } else { "circle" };
                        print!("|{body}|{noise:.0e}|{half_width}|{count}|");
                        println!("{half:.0e}|{first} %|{peak:.0e}|{second} %|");
                        assert!(first.min(second) >= 85, "too far off");
                        if count == 4001 {
                            of_readme.push(errors.largest);
                        }
                    }
                }
            }
        }
        if of_readme.is_empty() { Ok(()) } else { compare_with_readme(&of_readme) }
    }

    fn errors(
        &self,
        crowned: bool,
        noise: f64,
        half_width: f64,
        count: usize,
    ) -> Result<Errors, Box<dyn Error>> {
        let exact = Curve::new([-0.5, 0.5], move |x| {
            let [y, dy] = height(crowned, x);
            CurvePoint { x, y, dx: 1.0, dy }
        });
        let exact = Contact::new(&Flat, &exact)?.solve(Control::HalfWidth(half_width))?;
        let top = exact.peak()?.pressure;
        let mut errors = Errors::default();
        for seed in 0..self.measurements {
            let mut random = Random(seed);
            let point = |i: usize| {
                let x = i as f64 / (count - 1) as f64 - 0.5;
                [x, height(crowned, x)[0] + noise * random.normal()]
            };
            let points: Vec<_> = (0..count).map(point).collect();
            let body = Spline::fitted(&points, Fit { smooth: true, ..Fit::default() })?;
            let solution = Contact::new(&Flat, &body)?.solve(Control::Load(exact.load()))?;
            let stated = solution.uncertainty()?;
            let off = [solution.hull().half_width() - half_width, solution.peak()?.pressure - top];
            let off = off.map(f64::abs);
            for (i, (stated, unit)) in
                [(stated.half_width, half_width), (stated.peak_pressure, top)].iter().enumerate()
            {
                errors.largest[i] = errors.largest[i].max(off[i] / unit);
                errors.within[i] += u64::from(off[i] <= 2.0 * stated);
            }
        }
        Ok(errors)
    }
}

/// Returns height and slope of a circle, or of a roller whose ends are crowned.
fn height(crowned: bool, x: f64) -> [f64; 2] {
    let root = ((1.0 - x) * (1.0 + x)).sqrt();
    if crowned {
        [x * x / 2.0 + 5.0 * x.powi(6), x + 30.0 * x.powi(5)]
    } else {
        [x * x / (1.0 + root), x / root]
    }
}

/// Compares errors of half-width and peak, of a narrow and of a wider contact, with the README.
fn compare_with_readme(errors: &[[f64; 2]]) -> Result<(), Box<dyn Error>> {
    let readme = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/README.md"))?;
    let names = ["half-width, 4001 measured points, noise 1e-5 R", "peak pressure, the same"];
    for (i, name) in names.into_iter().enumerate() {
        let [narrow, wide] = [errors[0][i], errors[1][i]];
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
