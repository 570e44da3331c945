//! A roller of finite length by slices: with and without relief, aligned and misaligned.
//!
//!     cargo run --release --example finite_roller
//!
//! The cylinder is checked against the law of ISO/TS 16281 for load and approach.

#[path = "shared/drawing.rs"]
mod drawing;

use drawing::SeriesLabelPosition::{LowerMiddle, UpperLeft};
use drawing::{BLACK, BLUE, Panel, Points, RED};
use linecontact::profile::{Crowning, Ellipse};
use linecontact::{
    Contact, ContactError, FiniteRoller, Flat, Material, PlaneState, Reference, References,
    RollerState, SpringPoint, SpringTable,
};
use std::error::Error;

/// Diameter and length of a steel roller on a steel raceway. Units: mm, MPa, N.
const DIAMETER: f64 = 10.0;
const LENGTH: f64 = 10.0;

/// Load, and misalignments in radians.
const LOAD: f64 = 5000.0;
const MISALIGNMENTS: [f64; 2] = [0.0, 1e-3];

const SLICES: usize = 101;

/// Returns the load by ISO/TS 16281 (2008): `Q = 35948 δ^(10/9) l^(8/9)` N, with the approach δ of
/// the contacts with both raceways, in mm.
fn iso_16281(approach: f64) -> f64 {
    35_948.0 * (2.0 * approach).powf(10.0 / 9.0) * LENGTH.powf(8.0 / 9.0)
}

/// Returns a cylinder, and a roller with the relief of ISO/TS 16281.
fn rollers() -> Result<[FiniteRoller<f64>; 2], Box<dyn Error>> {
    let circle = Ellipse::circle(0.5 * DIAMETER, [-0.5, 0.5])?;
    let steel = Material::elastic(206e3, 0.3);
    let contact = Contact::new(&Flat, &circle)?.materials(steel, steel, PlaneState::Strain);
    // A large raceway sinks under a load of this length as from such a distance.
    let (lower, upper) = (Reference::Length(LENGTH), Reference::Disc(0.5 * DIAMETER));
    let references = References { x: 0.0, lower, upper };
    let table = SpringTable::new(&contact, &references, [0.01, 2000.0], 1e-6)?;
    let end = 0.5 * LENGTH;
    let relief = Crowning::new(0.00035 * DIAMETER, end, [-end, end])?;
    Ok([
        FiniteRoller::new(table.clone(), LENGTH, SLICES, &Flat)?,
        FiniteRoller::new(table, LENGTH, SLICES, &relief)?,
    ])
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let rollers = rollers()?;
    println!("5 kN        mrad  approach/µm  moment/N m  N/mm at the ends  largest pressure/MPa");
    let mut states = Vec::new();
    for (name, roller) in ["cylinder", "relief"].into_iter().zip(&rollers) {
        for misalignment in MISALIGNMENTS {
            let state = roller.under_load(LOAD, misalignment)?;
            let ends = [0, SLICES - 1].map(|i| state.slices[i].point.load);
            println!(
                "{name:<11} {:<5} {:<12.3} {:<11.3} {:<6.0} {:<10.0} {:.0}",
                1e3 * misalignment,
                1e3 * state.approach,
                1e-3 * state.moment,
                ends[0],
                ends[1],
                pressure(&state)
            );
            let back = roller.under_moment(LOAD, state.moment)?;
            assert!((back.misalignment - misalignment).abs() < 1e-12, "{}", back.misalignment);
            states.push(state);
        }
    }
    // Misaligned, the relief takes a part of the moment and of the pressure away.
    assert!(states[3].moment < states[1].moment && pressure(&states[3]) < pressure(&states[1]));

    let mut worst = 0.0f64;
    for load in [250.0, 500.0, 1e3, 2e3, 5e3, 1e4] {
        let approach = rollers[0].under_load(load, 0.0)?.approach;
        worst = worst.max((iso_16281(approach) / load - 1.0).abs());
    }
    println!("the cylinder's load is off ISO/TS 16281 by up to {:.1} %", 100.0 * worst);
    assert!(worst < 0.03, "{worst}");

    let left = vec![along(&states, "load / (N/mm)", 1200.0), along(&states, "P / MPa", 3000.0)];
    let right = vec![approaches(&rollers)?, moments(&rollers)?];
    println!("{}", drawing::save("finite_roller", vec![left, right])?);
    Ok(())
}

fn pressure(state: &RollerState<f64>) -> f64 {
    state.largest_pressure().unwrap_or(f64::INFINITY)
}

/// Draws loads per unit length or largest pressures along the axis.
fn along(states: &[RollerState<f64>], quantity: &str, most: f64) -> Panel {
    let is_load = quantity.starts_with("load");
    let title = if is_load { "Load of 5 kN along the axis" } else { "Largest pressure" };
    let points = |state: &RollerState<f64>| -> Points {
        let slices = state.slices.iter();
        let value = |point: SpringPoint<f64>| {
            if is_load { point.load } else { point.peak.unwrap_or(f64::INFINITY) }
        };
        slices.map(|slice| (slice.z, value(slice.point))).collect()
    };
    Panel::new(title, ("z / mm", [-5.0, 5.0]), (quantity, [0.0, most]))
        .size(400, 200)
        .legend(if is_load { UpperLeft } else { LowerMiddle })
        .dashed(points(&states[0]), RED, "cylinder")
        .line(points(&states[1]), RED, "cylinder, 1 mrad")
        .dashed(points(&states[2]), BLUE, "relief")
        .line(points(&states[3]), BLUE, "relief, 1 mrad")
}

/// Draws load against approach.
fn approaches(rollers: &[FiniteRoller<f64>; 2]) -> Result<Panel, ContactError<f64>> {
    let [mut cylinder, mut relief] = [const { Vec::new() }; 2];
    for i in 1..=80 {
        let load = 125.0 * f64::from(i);
        for (roller, points) in rollers.iter().zip([&mut cylinder, &mut relief]) {
            points.push((1e3 * roller.under_load(load, 0.0)?.approach, 1e-3 * load));
        }
    }
    let iso = (1..=12).map(|i| 2e-3 * f64::from(i));
    let iso = iso.map(|approach| (1e3 * approach, 1e-3 * iso_16281(approach))).collect();
    let axes = (("approach / µm", [0.0, 30.0]), ("load / kN", [0.0, 10.0]));
    Ok(Panel::new("Aligned", axes.0, axes.1)
        .size(400, 200)
        .legend(UpperLeft)
        .line(cylinder, RED, "cylinder")
        .line(relief, BLUE, "relief")
        .dots(iso, BLACK, "ISO/TS 16281"))
}

/// Draws the moment under the load against the misalignment.
fn moments(rollers: &[FiniteRoller<f64>; 2]) -> Result<Panel, ContactError<f64>> {
    let [mut cylinder, mut relief] = [const { Vec::new() }; 2];
    for i in 0..=80 {
        let misalignment = 5e-5 * f64::from(i);
        for (roller, points) in rollers.iter().zip([&mut cylinder, &mut relief]) {
            let moment = roller.under_load(LOAD, misalignment)?.moment;
            points.push((1e3 * misalignment, 1e-3 * moment));
        }
    }
    let axes = (("misalignment / mrad", [0.0, 4.0]), ("moment / (N m)", [0.0, 15.0]));
    Ok(Panel::new("Moment under 5 kN", axes.0, axes.1)
        .size(400, 200)
        .legend(UpperLeft)
        .line(cylinder, RED, "cylinder")
        .line(relief, BLUE, "relief"))
}
