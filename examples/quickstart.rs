//! A steel roller in a groove: where they touch, how hard they press, and how sure that is.
//!
//! Lengths in mm, pressures in MPa, load in N/mm. Run with `cargo run --release --example
//! quickstart`; the pressure is drawn to `target/figures/quickstart.svg`. Two circles have an exact
//! solution, against which the figures are checked.

use kuva::prelude::*;
use linecontact::{Contact, ContactError, Control, Cost, Curve, CurvePoint, Solution};
use std::error::Error;
use std::f64::consts::{FRAC_PI_2, PI};
use std::fs;

const MODULUS: f64 = 115e3; // E*: 1/E* = (1 - ν₁²)/E₁ + (1 - ν₂²)/E₂
const LOAD: f64 = 500.0;
const ROLLER: f64 = 10.0; // radius
const GROOVE: f64 = 40.0;

fn main() -> Result<(), Box<dyn Error>> {
    // The lower part of a circle, by the angle k from its lowest point.
    let arc = |r: f64| {
        Curve::new([-1.5, 1.5], move |k: f64| {
            let (sin, cos) = k.sin_cos();
            CurvePoint { x: r * sin, y: r * (1.0 - cos), dx: r * cos, dy: r * sin }
        })
    };
    let (groove, roller) = (arc(GROOVE), arc(ROLLER));
    let contact = Contact::new(&groove, &roller)?.contact_modulus(MODULUS);
    let solution = contact.solve(Control::Load(LOAD))?;

    let (a, b) = (solution.a(), solution.b());
    let (peak, pressure) = (solution.peak()?, solution.pressure()?);
    let limits_error = solution.limits_error().unwrap_or(0.0);
    let peak_error = pressure.estimate(peak.x, &mut Cost::default())?.error / peak.pressure;
    println!("a = {a:.13} mm, b = {b:.13} mm, estimated relative error {limits_error:.0e}");
    println!("peak {:.9} MPa at x = {:.0e} mm", peak.pressure, peak.x);
    println!("  estimated relative error {peak_error:.0e}");
    println!("{} evaluations of the two curves", solution.cost().evaluations);
    println!("{}", draw(&solution)?);

    // The slope of the gap is x/sqrt(r² - x²) of the roller less that of the groove, and so are the
    // load and the pressure in the middle: with m = (a/r)², E* r (K(m) - E(m)) and E* a K(m)/(π r).
    let [(k, k_less_e), (k_groove, k_less_e_groove)] = [ROLLER, GROOVE].map(|r| elliptic(a / r));
    let load = MODULUS * (ROLLER * k_less_e - GROOVE * k_less_e_groove);
    let middle = MODULUS * a / PI * (k / ROLLER - k_groove / GROOVE);
    assert!((load / LOAD - 1.0).abs() < 1e-13 && (a - b).abs() < 1e-14);
    assert!((peak.pressure / middle - 1.0).abs() < 1e-13 && peak.x.abs() < 1e-7);
    Ok(())
}

/// Complete elliptic integrals K(m) and K(m) - E(m), m = modulus², by the arithmetic-geometric mean.
fn elliptic(modulus: f64) -> (f64, f64) {
    let (mut a, mut b, mut c) = (1.0, (1.0 - modulus * modulus).sqrt(), modulus);
    let (mut sum, mut share) = (0.0, 0.5);
    while c > 1e-18 {
        sum += share * c * c;
        (a, b) = (0.5 * (a + b), f64::sqrt(a * b));
        (c, share) = (c * c / (4.0 * a), 2.0 * share);
    }
    (FRAC_PI_2 / a, FRAC_PI_2 / a * sum)
}

/// Draws the pressure, and says where.
fn draw(solution: &Solution<f64>) -> Result<&'static str, Box<dyn Error>> {
    let (on, pressure) = (solution.hull(), solution.pressure()?);
    // At equal angles, close together at the edges where the pressure is steep.
    let x = (0..=200).map(|i| on.at_angle(PI * (1.0 - f64::from(i) / 200.0)));
    let points =
        x.map(|x| Ok((x, pressure.at(x)?))).collect::<Result<Vec<_>, ContactError<_>>>()?;
    let line = LinePlot::new().with_data(points).with_color("#1f5fa8").with_stroke_width(2.0);
    let limit = |x, name| ReferenceLine::vertical(x).with_color("black").with_label(name);
    let plots: Vec<Plot> = vec![line.into()];
    let layout = Layout::auto_from_plots(&plots)
        .with_title("A steel roller in a groove, 500 N/mm")
        .with_x_label("x / mm")
        .with_y_label("P / MPa")
        .with_y_axis_min(0.0)
        .with_box_axes()
        .with_reference_line(limit(on.left, "−b"))
        .with_reference_line(limit(on.right, "a"));
    fs::create_dir_all("target/figures")?;
    fs::write("target/figures/quickstart.svg", kuva::render_to_svg(plots, layout))?;
    Ok("target/figures/quickstart.svg")
}
