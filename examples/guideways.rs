//! Guideways, long across the plane: a slide with relief on a flat one, and a hollow of arcs on a
//! rib of arcs.
//!
//! Run with `cargo run --release --example guideways`. The first is checked against its closed
//! form, the second against a parabola with a different radius on either side, which the arcs
//! approach as the contact becomes small. Lengths in mm, pressures in MPa, load in N/mm.

#[path = "shared/drawing.rs"]
mod drawing;

use drawing::{BLACK, BLUE, Panel, Points, RED, RGBColor, SeriesLabelPosition, mix};
use linecontact::profile::{Crowning, Outline};
use linecontact::reference::{self, ClosedForm, UnequalRadii};
use linecontact::{Contact, ContactError, Control, Flat, Interval, ParametricProfile, Solution};
use std::error::Error;
use std::f64::consts::{FRAC_PI_2, PI};

const MODULUS: f64 = 115e3;

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    println!("{}", drawing::save("guideways", vec![slide()?, hollow()?])?);
    Ok(())
}

/// Returns the pressures from edge to edge.
fn pressures(solution: &Solution<f64>) -> Result<Points, ContactError<f64>> {
    let (on, pressure) = (solution.hull(), solution.pressure()?);
    let x = (0..=400).map(|i| on.at_angle(PI * (1.0 - f64::from(i) / 400.0)));
    x.map(|x| Ok((x, pressure.at(x)?))).collect()
}

fn outline(body: &dyn ParametricProfile<f64>) -> Points {
    let [from, to] = body.domain();
    // Close together at the ends, where a relief is steep, but not at them, where it is infinite.
    let on = Interval { left: from, right: to };
    let points = (1..300).rev().map(|i| body.at(on.at_angle(PI * f64::from(i) / 300.0)));
    points.map(|at| (at.x, at.y)).collect()
}

/// Returns a colour from light blue to red, for three loads.
fn shade(i: usize) -> RGBColor {
    mix(drawing::tint(BLUE, 0.5), RED, i as f64 / 2.0)
}

fn slide() -> Result<Vec<Panel>, Box<dyn Error>> {
    let (depth, end, kappa) = (0.003, 8.0, FRAC_PI_2 * MODULUS);
    let slide = Crowning::new(depth, end, [-end, end])?;
    let contact = Contact::new(&Flat, &slide)?.contact_modulus(MODULUS);
    let range = [-8.5, 8.5];
    let relief = outline(&slide).into_iter().map(|(x, y)| (x, 1e3 * y)).collect();
    let shape = Panel::new(
        "A slide with logarithmic relief on a flat",
        ("x / mm", range),
        ("y / µm", [-4.0, 12.0]),
    )
    .size(400, 180)
    .body(vec![(-8.5, 0.0), (8.5, 0.0)], -4.0, BLUE, "")
    .body(relief, 12.0, RED, "");
    let axes = (("x / mm", range), ("P / MPa", [0.0, 300.0]));
    let mut drawn = Panel::new("Pressure under three loads", axes.0, axes.1)
        .size(400, 200)
        .legend(SeriesLabelPosition::UpperMiddle);
    println!("slide with relief: off the closed form by");
    for (i, half_width) in [4.0, 7.0, 7.6].into_iter().enumerate() {
        let form = reference::Crowning::new(depth, end, half_width)?;
        let load = form.load(kappa);
        let solution = contact.solve(Control::Load(load))?;
        let x = 0.9 * half_width;
        let ratios =
            [solution.a() / half_width, solution.pressure()?.at(x)? / form.pressure(x, kappa)];
        let off = ratios.map(|ratio| (ratio - 1.0).abs());
        println!("  {:.0e} and {:.0e} at {load:.0} N/mm", off[0], off[1]);
        assert!(off.into_iter().all(|off| off < 1e-12), "{off:?}");
        drawn = drawn.line(pressures(&solution)?, shade(i), &format!("{load:.0} N/mm"));
    }
    Ok(vec![shape, drawn])
}

fn hollow() -> Result<Vec<Panel>, Box<dyn Error>> {
    // Arcs of 300, 80 and 13 mm on the rib; on its partner a hollow of 500 mm, and bulging arcs of
    // 400 mm.
    let middle = || Outline::from([0.0, 0.0]);
    let rib = middle().arc(-80.0, 15.0).arc(-13.0, 8.0).left(middle().arc(-300.0, 25.0));
    let partner = middle().arc(400.0, 30.0).left(middle().arc(-500.0, 20.0).arc(400.0, 15.0));
    let (rib, partner) = (rib.build()?, partner.build()?);
    let contact = Contact::new(&rib, &partner)?.contact_modulus(MODULUS).certified(true);
    let combined = |rib: f64, partner: f64| 1.0 / (1.0 / rib + 1.0 / partner);
    let radii = [combined(300.0, -500.0), combined(80.0, 400.0)];
    println!("hollow on rib: radii {radii:.1?}; off the parabolas by");
    let kappa = FRAC_PI_2 * MODULUS;
    let heights = [-6.0, 6.0];
    let shape = Panel::new(
        "A hollow of arcs on a rib of arcs",
        ("x / mm", [-25.0, 23.0]),
        ("y / mm", heights),
    )
    .size(400, 180)
    .body(outline(&rib), heights[0], BLUE, "")
    .body(outline(&partner), heights[1], RED, "")
    .dots(vec![(0.0, 0.0)], BLACK, "")
    .note(0.0, -2.5, "rib, radii 300, 80 and 13 mm", BLUE)
    .note(0.0, 4.0, "hollow, radii −500 and 400 mm", RED);
    let axes = (("x / mm", [-3.5, 1.0]), ("P / MPa", [0.0, 600.0]));
    let mut drawn = Panel::new("Pressure under three loads", axes.0, axes.1)
        .size(400, 200)
        .legend(SeriesLabelPosition::UpperLeft);
    let mut last = f64::INFINITY;
    for (i, load) in [1000.0, 100.0, 10.0].into_iter().enumerate() {
        let solution = contact.solve(Control::Load(load))?;
        let form = UnequalRadii::under_load(radii[0], radii[1], load, kappa)?;
        let (got, want) = (solution.hull(), form.limits());
        let x = 0.5 * want.right;
        let ratios = [
            got.left / want.left,
            got.right / want.right,
            solution.pressure()?.at(x)? / form.pressure(x, kappa),
        ];
        let off = ratios.map(|ratio| (ratio - 1.0).abs()).into_iter().fold(0.0, f64::max);
        println!("  {off:.1e} at {load} N/mm, from {:.3} to {:.3} mm", got.left, got.right);
        // The square of half-width over radius is proportional to the load.
        assert!(off < 2e-6 * load && off < 0.2 * last, "{off}");
        last = off;
        drawn = drawn.line(pressures(&solution)?, shade(2 - i), &format!("{load:.0} N/mm"));
    }
    Ok(vec![shape, drawn])
}
