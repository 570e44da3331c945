//! Load against approach: a roller on a raceway as a spring, compared with the usual formulas.
//!
//!     cargo run --release --example spring

#[path = "shared/drawing.rs"]
mod drawing;

use drawing::{BLACK, BLUE, GRAY, Panel, RED, SeriesLabelPosition};
use linecontact::profile::Ellipse;
use linecontact::{
    Contact, ContactError, Control, Flat, Material, PlaneState, Reference, References, SpringTable,
};
use std::error::Error;
use std::f64::consts::PI;

/// Radius of a steel roller, and depth at which the raceway is held. Units: mm, MPa, N/mm.
const RADIUS: f64 = 5.0;
const DEPTH: f64 = 15.0;
const YOUNGS_MODULUS: f64 = 206e3;
const POISSON_RATIO: f64 = 0.3;

/// Length of the roller, on which the formula of ISO/TS 16281 depends.
const LENGTH: f64 = 10.0;

const LOADS: [f64; 2] = [1.0, 1000.0];

/// Returns the load per unit length by ISO/TS 16281 (2008): `Q = 35948 δ^(10/9) l^(8/9)` N. There
/// δ, in mm, is the approach of the contacts with both raceways; the contact with one raceway has
/// half of it.
fn iso_16281(approach: f64) -> f64 {
    35_948.0 * (2.0 * approach).powf(10.0 / 9.0) * LENGTH.powf(8.0 / 9.0) / LENGTH
}

/// Returns the approach by Weber and Banaschek (1953): of the half-plane towards the depth, and of
/// the roller towards its middle by the same formula, with the half-width of Hertz.
fn weber_banaschek(load: f64) -> f64 {
    let compliance = (1.0 - POISSON_RATIO * POISSON_RATIO) / YOUNGS_MODULUS;
    let half_width = (8.0 * load * RADIUS * compliance / PI).sqrt();
    let body = |depth: f64| {
        let ratio = POISSON_RATIO / (2.0 * (1.0 - POISSON_RATIO));
        2.0 * compliance * load / PI * ((2.0 * depth / half_width).ln() - ratio)
    };
    body(DEPTH) + body(RADIUS)
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let roller = Ellipse::circle(RADIUS, [-0.5, 0.5])?;
    let steel = Material::elastic(YOUNGS_MODULUS, POISSON_RATIO);
    let contact = Contact::new(&Flat, &roller)?.materials(steel, steel, PlaneState::Strain);
    let references =
        References { x: 0.0, lower: Reference::Depth(DEPTH), upper: Reference::Disc(RADIUS) };
    let table = SpringTable::new(&contact, &references, LOADS, 1e-6)?;
    println!(
        "{} points, errors of the load up to {:.0e}, of the stiffness up to {:.0e}",
        table.points().len(),
        table.error(),
        table.stiffness_error()
    );
    assert!(table.error() <= 1e-6);

    // A constant stiffness, from the middle of the range.
    let middle = contact.solve(Control::Load(300.0))?;
    let (start, stiffness) = (middle.approach(&references)?.bodies, middle.stiffness(&references)?);
    println!("N/mm     approach  Weber and B.  ISO/TS 16281  constant   (µm and load by it)");
    let mut worst = [0.0f64; 3];
    for load in [1.0, 10.0, 100.0, 300.0, 1000.0] {
        let solution = contact.solve(Control::Load(load))?;
        let approach = solution.approach(&references)?.bodies;
        let others = [
            weber_banaschek(load) / approach,
            iso_16281(approach) / load,
            (300.0 + stiffness * (approach - start)) / load,
        ];
        println!(
            "{load:<8} {:<9.4} {:<13.4} {:<13.4} {:.4}",
            1e3 * approach,
            1e3 * weber_banaschek(load),
            iso_16281(approach),
            300.0 + stiffness * (approach - start)
        );
        if load >= 10.0 {
            for (worst, other) in worst.iter_mut().zip(others) {
                *worst = worst.max((other - 1.0).abs());
            }
        }
    }
    println!("off by up to {worst:.3?} from 10 N/mm on");
    // The formulas are made for this contact; a constant stiffness holds at its own load only.
    assert!(worst[0] < 0.05 && worst[1] < 0.08 && worst[2] > 1.0, "{worst:?}");

    println!(
        "{}",
        drawing::save("spring", vec![vec![loads(&table)?, shares(&table, [start, stiffness])?]])?
    );
    Ok(())
}

/// Draws load against approach.
fn loads(table: &SpringTable<f64>) -> Result<Panel, ContactError<f64>> {
    let solved = table.points().map(|point| (1e3 * point.approach, point.load)).collect();
    let last = table.points().last().map_or(0.0, |point| point.approach);
    let first = table.points().next().map_or(0.0, |point| point.approach);
    let line = (0..=200).map(|i| table.at(first + (last - first) * f64::from(i) / 200.0));
    let line = line.map(|point| point.map(|point| (1e3 * point.approach, point.load)));
    let axes = (("approach / µm", [0.0, 25.0]), ("load / (N/mm)", [0.0, 1000.0]));
    Ok(Panel::new("A roller of 5 mm on a raceway", axes.0, axes.1)
        .size(440, 200)
        .legend(SeriesLabelPosition::UpperLeft)
        .line(line.collect::<Result<_, _>>()?, BLUE, "table")
        .dots(solved, BLUE, "its points"))
}

/// Draws the relative differences of the formulas' loads at the same approach.
fn shares(table: &SpringTable<f64>, tangent: [f64; 2]) -> Result<Panel, ContactError<f64>> {
    let [mut iso, mut weber, mut constant] = [const { Vec::new() }; 3];
    for i in 0..=120 {
        let exponent = f64::from(i) / 40.0;
        let load = 10f64.powf(exponent);
        // Approaches outside the table are left out.
        if let Ok(point) = table.at(weber_banaschek(load)) {
            weber.push((exponent, 100.0 * (load / point.load - 1.0)));
            let (approach, exponent) = (point.approach, point.load.log10());
            iso.push((exponent, 100.0 * (iso_16281(approach) / point.load - 1.0)));
            let load = 300.0 + tangent[1] * (approach - tangent[0]);
            constant.push((exponent, 100.0 * (load / point.load - 1.0)));
        }
    }
    let axes = (("load / (N/mm)", [0.0, 3.0]), ("off by / %", [-15.0, 20.0]));
    Ok(Panel::new("The load by other formulas, at the same approach", axes.0, axes.1)
        .size(440, 200)
        .powers(true, false)
        .legend(SeriesLabelPosition::UpperLeft)
        .line(weber, BLACK, "Weber and Banaschek")
        .line(iso, RED, "ISO/TS 16281")
        .dashed(constant, GRAY, "constant stiffness"))
}
