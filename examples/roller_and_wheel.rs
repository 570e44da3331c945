//! A roller with relief on a raceway, and a wheel of arcs on a rail of arcs.
//!
//! Run with `cargo run --release --example roller_and_wheel`. The first is checked against its closed
//! form, the second against a parabola with another radius on either side, which the arcs are as far
//! as the contact is small. Lengths in mm, pressures in MPa, load in N/mm.

use linecontact::profile::{Crowning, Ellipse, Placed, Placement};
use linecontact::reference::{self, ClosedForm, UnequalRadii};
use linecontact::{Contact, Control, Flat, ParametricProfile, Piecewise};
use std::error::Error;
use std::f64::consts::FRAC_PI_2;

const MODULUS: f64 = 115e3;

fn main() -> Result<(), Box<dyn Error>> {
    roller()?;
    wheel()
}

fn roller() -> Result<(), Box<dyn Error>> {
    let (depth, end, kappa) = (0.003, 8.0, FRAC_PI_2 * MODULUS);
    let roller = Crowning::new(depth, end, [-end, end])?;
    let contact = Contact::new(&Flat, &roller)?.contact_modulus(MODULUS);
    println!("roller with relief: off the closed form by");
    for half_width in [2.0, 6.0, 7.9] {
        let form = reference::Crowning::new(depth, end, half_width)?;
        let load = form.load(kappa);
        let solution = contact.solve(Control::Load(load))?;
        let x = 0.9 * half_width;
        let ratios =
            [solution.a() / half_width, solution.pressure()?.at(x)? / form.pressure(x, kappa)];
        let off = ratios.map(|ratio| (ratio - 1.0).abs());
        println!("  {:.0e} and {:.0e} at {load:.0} N/mm", off[0], off[1]);
        assert!(off.into_iter().all(|off| off < 1e-12), "{off:?}");
    }
    Ok(())
}

/// Arcs without corners between them.
type Arcs = Piecewise<f64, Placed<f64, Ellipse<f64>>>;

/// Arcs joined without a corner, one or several to the left of x = 0 and to its right: each goes on
/// where the last one ended, in the direction it had. Given by radius and length in x, from the
/// middle outwards; a negative radius bulges upwards.
fn arcs(sides: [&[(f64, f64)]; 2]) -> Result<Arcs, Box<dyn Error>> {
    let mut parts = Vec::new();
    for (side, outwards) in sides.into_iter().zip([-1.0, 1.0]) {
        let (mut x, mut y, mut slope) = (0.0, 0.0, 0.0f64);
        for &(radius, length) in side {
            // The slope is that of the angle, turned over with the arc.
            let from = (slope * radius.signum()).atan();
            let to = (from.sin() + outwards * length / radius.abs()).asin();
            let arc = Ellipse::circle(radius, [from.min(to), from.max(to)])?;
            let (start, stop) = (arc.at(from), arc.at(to));
            let shift = Placement::default().shifted(x - start.x, y - start.y);
            parts.push(Placed::new(arc, shift)?);
            (x, y, slope) = (x + stop.x - start.x, y + stop.y - start.y, stop.dy / stop.dx);
        }
        if outwards < 0.0 {
            parts.reverse();
        }
    }
    Ok(Piecewise::new(parts)?)
}

fn wheel() -> Result<(), Box<dyn Error>> {
    // Arcs of 300, 80 and 13 mm on the rail; on the wheel a hollow tread of 500, and a bulging one.
    let rail = arcs([&[(-300.0, 25.0)], &[(-80.0, 15.0), (-13.0, 8.0)]])?;
    let tread = arcs([&[(-500.0, 20.0), (400.0, 15.0)], &[(400.0, 30.0)]])?;
    let contact = Contact::new(&rail, &tread)?.contact_modulus(MODULUS).certified(true);
    let combined = |rail: f64, tread: f64| 1.0 / (1.0 / rail + 1.0 / tread);
    let radii = [combined(300.0, -500.0), combined(80.0, 400.0)];
    println!("wheel on rail: radii {radii:.1?}; off the parabolas by");
    let kappa = FRAC_PI_2 * MODULUS;
    let mut last = f64::INFINITY;
    for load in [1000.0, 100.0, 10.0] {
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
        // The square of the half-width over the radii goes with the load.
        assert!(off < 2e-6 * load && off < 0.2 * last, "{off}");
        last = off;
    }
    Ok(())
}
