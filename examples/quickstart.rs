//! A steel roller in a groove: the limits of the contact, the pressure, and their errors.
//!
//! Lengths in mm, pressures in MPa, load in N/mm. Run with `cargo run --release --example
//! quickstart`. The bodies, the pressure and the stress below are drawn to
//! `target/figures/quickstart.svg`. Two circles have an exact solution, against which the results
//! are checked.

#[path = "shared/drawing.rs"]
mod drawing;

use drawing::{BLACK, BLUE, Grid, Panel, Points, RED, tint};
use linecontact::{Contact, ContactError, Control, Curve, CurvePoint, ParametricProfile, Solution};
use std::error::Error;
use std::f64::consts::{FRAC_PI_2, PI};

const MODULUS: f64 = 115e3; // E*: 1/E* = (1 - ν₁²)/E₁ + (1 - ν₂²)/E₂
const LOAD: f64 = 500.0;
const ROLLER: f64 = 10.0; // radius
const GROOVE: f64 = 40.0;

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    // Lower part of a circle, by the angle k from its lowest point.
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
    let peak_error = peak.error / peak.pressure;
    let lines = [
        format!("contact from {:.6} to {a:.6} mm", -b),
        format!("largest pressure {:.3} MPa", peak.pressure),
        format!("pressure at 0.1 mm {:.3} MPa", pressure.at(0.1)?),
    ];
    for line in lines {
        println!("{line}");
        assert!(include_str!("../README.md").contains(&line), "the README prints something else");
    }
    println!("estimated relative errors: limits {limits_error:.0e}, peak {peak_error:.0e}");
    println!("{} evaluations of the two curves", solution.cost().evaluations);
    println!("{}", draw(&groove, &solution)?);

    // The slope of the gap is the difference of two slopes x/sqrt(r² - x²), of the roller and of
    // the groove. So load and peak are differences, too, of E* r (K(m) - E(m)) and E* a K(m)/(π r),
    // with m = (a/r)².
    let [(k, k_less_e), (k_groove, k_less_e_groove)] = [ROLLER, GROOVE].map(|r| elliptic(a / r));
    let load = MODULUS * (ROLLER * k_less_e - GROOVE * k_less_e_groove);
    let middle = MODULUS * a / PI * (k / ROLLER - k_groove / GROOVE);
    assert!((load / LOAD - 1.0).abs() < 1e-13 && (a - b).abs() < 1e-14);
    assert!((peak.pressure / middle - 1.0).abs() < 1e-13 && peak.x.abs() < 1e-7);
    Ok(())
}

/// Computes the complete elliptic integrals K(m) and K(m) - E(m), m = modulus², by the
/// arithmetic-geometric mean.
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

/// Draws the bodies, the pressure and the stress below, and returns a line that names the file.
fn draw(
    groove: &dyn ParametricProfile<f64>,
    solution: &Solution<f64>,
) -> Result<String, Box<dyn Error>> {
    let arc = (-100..=100).map(|i| groove.at(0.0032 * f64::from(i))).map(|at| (at.x, at.y));
    let angles = (0..=200).map(|i| PI * f64::from(i) / 100.0);
    let circle: Points =
        angles.map(|angle| (ROLLER * angle.sin(), ROLLER * (1.0 - angle.cos()))).collect();
    let arrow = vec![(0.0, 5.0), (-0.5, 6.4), (0.5, 6.4)];
    let axes = (("x / mm", [-12.0, 12.0]), ("y / mm", [-4.0, 20.5]));
    let whole = Panel::new("A roller in a groove", axes.0, axes.1)
        .with_equal_scales(370)
        .body(arc.collect(), -4.0, BLUE, "")
        .area(circle.clone(), tint(RED, 0.18))
        .line(circle, RED, "")
        .line(vec![(0.0, 10.0), (0.0, 6.0)], BLACK, "")
        .area(arrow, BLACK)
        .note(0.0, 11.3, "F = 500 N/mm", BLACK)
        .note(0.0, 16.0, "roller, r = 10 mm", RED)
        .note(0.0, -1.8, "groove, r = 40 mm", BLUE);

    let (on, pressure, below) = (solution.hull(), solution.pressure()?, solution.subsurface()?);
    // Places at equal angles: close together at the edges, where the pressure is steep.
    let x = (0..=200).map(|i| on.at_angle(PI * (1.0 - f64::from(i) / 200.0)));
    let points =
        x.map(|x| Ok((x, pressure.at(x)?))).collect::<Result<Points, ContactError<_>>>()?;
    const WIDTH: i32 = 420;
    let range = [-0.6, 0.6];
    let pressures = Panel::new("Pressure between them", ("", range), ("P / MPa", [0.0, 1400.0]))
        .size(WIDTH, 110)
        .body(points, 0.0, BLUE, "")
        .limit(on.left, "−b")
        .limit(on.right, "a");

    let shear = |x, y: f64| Ok::<_, ContactError<f64>>(below.at(x, -y)?.max_shear());
    let depths = [-0.5, 0.0];
    let shears = Grid::new(range, depths, [120, 50], shear)?;
    let levels: Vec<f64> = (1..=17).map(|i| 20.0 * f64::from(i)).collect();
    let worst = below.max_shear()?;
    let name = format!("{:.0} MPa", worst.value);
    let stress = Panel::new("Stress below it", ("x / mm", range), ("y / mm", depths))
        .with_equal_scales(WIDTH)
        .levels(&shears, &levels, RED)
        .dots(vec![(worst.x, -worst.depth)], BLACK, "")
        .note(worst.x, -worst.depth - 0.03, &name, BLACK);
    let key = Panel::key("largest shear stress / MPa", WIDTH, &levels, RED);
    drawing::save("quickstart", vec![vec![whole], vec![pressures, stress, key]])
}
