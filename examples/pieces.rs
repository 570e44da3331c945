//! Measures the cost of a contact of many pieces: a circle cut into up to 100 000 arcs, half of
//! them in the contact.
//!
//! Run with `cargo run --release --example pieces`. Evaluations and times of a solve are per piece
//! in the contact, the time of making the body per piece of the body, and the time of a pressure as
//! a whole. The limits are checked against the exact solution; the evaluations are drawn to
//! `target/figures/pieces.svg`.

#[path = "shared/drawing.rs"]
mod drawing;

use drawing::{BLUE, Panel, Points, RED, SeriesLabelPosition};
use linecontact::{Contact, Control, Curve, CurvePoint, Flat, Piecewise, Solver};
use std::error::Error;
use std::f64::consts::FRAC_PI_2;
use std::fs;
use std::hint::black_box;
use std::time::Instant;

/// Largest angle of the arcs on either side, on a circle of radius 1.
const END: f64 = 0.5;
/// Half-widths of the first and of the second contact.
const HALF_WIDTHS: [f64; 2] = [0.25, 0.26];
/// Number of pressures computed one by one.
const POINTS: u32 = 16;

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    measure(10)?; // The tables of the quadrature are made once, at the first solve.
    println!("            evaluations               microseconds");
    println!("    pieces  first  next  |   make   first    next   P(x)  |  error of a");
    let (mut first_solves, mut next_solves) = (Points::new(), Points::new());
    let (mut least, mut most, mut each) = (f64::INFINITY, 0.0f64, 0.0);
    for pieces in [10, 100, 1_000, 10_000, 100_000] {
        let Row { evaluations: [first, next], micros: [make, cold, warm, pressure], error } =
            measure(pieces)?;
        println!(
            "{pieces:10} {first:6.2} {next:5.2}  | {make:6.2} {cold:7.2} {warm:7.2} {pressure:6.2}  \
             | {error:9.0e}"
        );
        let inside = (pieces as f64 * 0.5).log10();
        first_solves.push((inside, (first * pieces as f64 * 0.5).log10()));
        next_solves.push((inside, (next * pieces as f64 * 0.5).max(1.0).log10()));
        // The two pieces at the edges are sampled beyond the contact: of ten pieces they are too
        // large a share.
        if pieces >= 100 {
            (least, most) = (least.min(first), most.max(first));
        }
        assert!(error < 1e-12);
        each = first;
    }
    let axes = (("pieces in the contact", [0.5, 5.0]), ("evaluations of the curves", [0.0, 6.0]));
    let panel = Panel::new("A circle cut into arcs", axes.0, axes.1)
        .size(440, 300)
        .powers(true, true)
        .legend(SeriesLabelPosition::UpperLeft)
        .line(first_solves.clone(), BLUE, "first solve")
        .dots(first_solves, BLUE, "")
        .line(next_solves.clone(), RED, "next solve, 8 % more load")
        .dots(next_solves, RED, "");
    println!("{}", drawing::save("pieces", vec![vec![panel]])?);
    assert!(most < 1.3 * least, "a piece costs the same however many there are");
    let readme = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/README.md"))?;
    let row = readme.lines().find(|line| line.starts_with("|each piece of 100 000|"));
    let is_as_counted = row.is_some_and(|row| row.ends_with(&format!("|{each:.0}|")));
    assert!(is_as_counted, "the README has another count than {each:.0}: {row:?}");
    Ok(())
}

struct Row {
    /// Evaluations of the curve per piece in the contact, in the first and in the second solve.
    evaluations: [f64; 2],
    /// Microseconds: making the body and the two solves per piece, and one pressure.
    micros: [f64; 4],
    /// Larger relative error of `a`.
    error: f64,
}

/// Solves one body under two loads.
fn measure(pieces: usize) -> Result<Row, Box<dyn Error>> {
    let end = |i: usize| END * (2.0 * i as f64 / pieces as f64 - 1.0);
    let clock = Clock::start();
    let arcs = (0..pieces).map(|i| {
        Curve::new([end(i), end(i + 1)], |k: f64| {
            let (sin, cos) = k.sin_cos();
            CurvePoint { x: sin, y: 1.0 - cos, dx: cos, dy: sin }
        })
    });
    let body = Piecewise::new(arcs.collect())?;
    let make = clock.micros() / pieces as f64;

    // With E* = 1 the load is K(m) - E(m), m = a².
    let contact = Contact::new(&Flat, &body)?.contact_modulus(1.0);
    let mut solver = Solver::new();
    let (mut evaluations, mut micros, mut error) = ([0.0; 2], [make, 0.0, 0.0, 0.0], 0.0f64);
    for (i, a) in HALF_WIDTHS.into_iter().enumerate() {
        let inside = (0..pieces).filter(|&i| end(i + 1) > -a.asin() && end(i) < a.asin());
        let count = inside.count() as f64;
        let clock = Clock::start();
        let solution = solver.solve(&contact, Control::Load(k_less_e(a)))?;
        micros[1 + i] = clock.micros() / count;
        evaluations[i] = solution.cost().evaluations as f64 / count;
        error = error.max((solution.a() / a - 1.0).abs());

        let pressure = solution.pressure()?;
        let clock = Clock::start();
        for j in 0..POINTS {
            black_box(pressure.at(a * (f64::from(j) / f64::from(POINTS) - 0.47))?);
        }
        micros[3] = clock.micros() / f64::from(POINTS);
    }
    Ok(Row { evaluations, micros, error })
}

/// Computes `K(m) - E(m)` of the complete elliptic integrals, m = modulus², by the
/// arithmetic-geometric mean.
fn k_less_e(modulus: f64) -> f64 {
    let (mut a, mut b, mut c) = (1.0, (1.0 - modulus * modulus).sqrt(), modulus);
    let (mut sum, mut share) = (0.0, 0.5);
    while c > 1e-18 {
        sum += share * c * c;
        (a, b) = (0.5 * (a + b), f64::sqrt(a * b));
        (c, share) = (c * c / (4.0 * a), 2.0 * share);
    }
    FRAC_PI_2 / a * sum
}

struct Clock(Instant);

impl Clock {
    fn start() -> Self {
        Self(Instant::now())
    }

    fn micros(&self) -> f64 {
        self.0.elapsed().as_secs_f64() * 1e6
    }
}
