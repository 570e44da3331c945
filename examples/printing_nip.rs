//! A printing nip: a roller with a rubber cover against a steel roller.
//!
//!     cargo run --release --example printing_nip
//!
//! Nip width and largest pressure against thickness and load, the pressure in the nip, and the
//! stiffness that a press needs. Thin covers are compared with the law of a nearly incompressible
//! layer, and thick ones with Hertz. Lengths in mm, pressures in MPa, load in N/mm.

#[path = "shared/drawing.rs"]
mod drawing;

use drawing::{BLUE, GRAY, Panel, Points, RED, SeriesLabelPosition, mix};
use linecontact::profile::{Ellipse, Parabola, Placed, Placement};
use linecontact::{
    Base, Contact, ContactError, Control, Flat, Layer, Material, PlaneState, Reference, References,
    Solution,
};
use std::error::Error;
use std::f64::consts::PI;

/// Radii of the covered roller and of the steel roller.
const RADII: [f64; 2] = [100.0, 150.0];
const RUBBER: f64 = 5.0;
const RATIO: f64 = 0.49;
const LOADS: [f64; 3] = [2.0, 10.0, 50.0];
const THICKNESSES: [f64; 6] = [2.0, 4.0, 8.0, 15.0, 30.0, 60.0];

/// Returns the radius of a roller on a flat with the same gap.
fn radius() -> f64 {
    1.0 / (1.0 / RADII[0] + 1.0 / RADII[1])
}

/// Returns the half-width of the contact of half-planes (Hertz).
fn hertz(load: f64) -> f64 {
    let modulus = RUBBER / (1.0 - RATIO * RATIO);
    (4.0 * load * radius() / (PI * modulus)).sqrt()
}

fn cover(thickness: f64, ratio: f64) -> Layer<f64> {
    Layer { material: Material::elastic(RUBBER, ratio), thickness, base: Base::Bonded }
}

/// Nip of a cover of some thickness.
struct Nip {
    rollers: [Placed<f64, Ellipse<f64>>; 2],
}

impl Nip {
    fn new() -> Result<Self, Box<dyn Error>> {
        let place = Placement::default();
        let lower = Placed::new(Ellipse::circle(RADII[1], [-0.5, 0.5])?, place.flipped())?;
        let upper = Placed::new(Ellipse::circle(RADII[0], [-0.5, 0.5])?, place)?;
        Ok(Self { rollers: [lower, upper] })
    }

    fn contact(&self, cover: Layer<f64>) -> Result<Contact<'_, f64>, ContactError<f64>> {
        let [lower, upper] = &self.rollers;
        Ok(Contact::new(lower, upper)?.materials(Material::Rigid, cover, PlaneState::Strain))
    }
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let nip = Nip::new()?;
    println!(
        "cover / mm  load / (N/mm)  nip / mm  Hertz   peak / MPa  closed by / mm  N/mm per mm"
    );
    let references =
        References { x: 0.0, lower: Reference::Depth(1.0), upper: Reference::Depth(1.0) };
    let mut widths = Vec::new();
    for thickness in THICKNESSES {
        let contact = nip.contact(cover(thickness, RATIO))?;
        for load in LOADS {
            let solution = contact.solve(Control::Load(load))?;
            widths.push((thickness, load, 2.0 * solution.a()));
            println!(
                "{thickness:<11} {load:<14} {:<9.3} {:<7.3} {:<11.4} {:<15.4} {:.3}",
                2.0 * solution.a(),
                2.0 * hertz(load),
                solution.peak()?.pressure,
                solution.approach(&references)?.bodies,
                solution.stiffness(&references)?,
            );
        }
    }
    // A thick cover is a half-plane; a thin one is stiffer.
    let thick = nip.contact(cover(1e3, RATIO))?.solve(Control::Load(2.0))?;
    assert!((thick.a() / hertz(2.0) - 1.0).abs() < 1e-3);
    assert!(widths.iter().all(|&(_, load, width)| width < 2.0 * hertz(load)));
    thin_layers()?;
    println!("{}", drawing::save("printing_nip", vec![vec![of_widths(&nip)?, pressures(&nip)?]])?);
    Ok(())
}

/// Compares thin covers with their laws (Johnson, *Contact Mechanics*, 1985, §5.8), which hold for
/// half-widths much larger than the thickness.
fn thin_layers() -> Result<(), Box<dyn Error>> {
    let roller = Parabola::new(100.0, [-40.0, 40.0])?;
    let contact = |thickness: f64, ratio: f64| {
        let contact = Contact::new(&Flat, &roller)?;
        let cover = cover(thickness, ratio);
        Ok::<_, ContactError<f64>>(contact.materials(cover, Material::Rigid, PlaneState::Strain))
    };
    println!("half-width by thickness, and how far the law of thin layers is off, ν = 0.3 and 0.5");
    for ratio in [4.0, 10.0, 25.0, 60.0] {
        let half_width = 20.0;
        let thickness = half_width / ratio;
        let compressible = contact(thickness, 0.3)?.solve(Control::HalfWidth(half_width))?;
        let modulus = RUBBER * 0.7 / (1.3 * 0.4);
        let law = 2.0 / 3.0 * modulus * half_width.powi(3) / (100.0 * thickness);
        let fixed = contact(thickness, 0.5)?.solve(Control::HalfWidth(half_width))?;
        let fifth = 2.0 / 45.0 * RUBBER * half_width.powi(5) / (100.0 * thickness.powi(3));
        let off = [law / compressible.load() - 1.0, fifth / fixed.load() - 1.0];
        println!("{ratio:<4} {:+.4} {:+.4}", off[0], off[1]);
        assert!(off[0].abs() < 0.5 / ratio && off[1].abs() < 8.0 / ratio, "{off:?}");
    }
    Ok(())
}

fn shade(i: usize, of: usize) -> drawing::RGBColor {
    mix(drawing::tint(BLUE, 0.5), RED, i as f64 / (of - 1) as f64)
}

fn of_widths(nip: &Nip) -> Result<Panel, Box<dyn Error>> {
    let axes = (("thickness of the cover / mm", [0.0, 62.0]), ("nip width / mm", [0.0, 80.0]));
    let panel = Panel::new("Nip width, and that of a half-plane (dashed)", axes.0, axes.1)
        .size(400, 220)
        .legend(SeriesLabelPosition::UpperLeft);
    LOADS.into_iter().enumerate().try_fold(panel, |panel, (i, load)| {
        let width = |thickness: f64| {
            let solution = nip.contact(cover(thickness, RATIO))?.solve(Control::Load(load))?;
            Ok::<_, ContactError<f64>>((thickness, 2.0 * solution.a()))
        };
        let thicknesses = (0..=48).map(|step| 2.0 * 30.0_f64.powf(f64::from(step) / 48.0));
        let points = thicknesses.map(width).collect::<Result<Points, _>>()?;
        let plain = vec![(0.0, 2.0 * hertz(load)), (62.0, 2.0 * hertz(load))];
        let color = shade(i, LOADS.len());
        Ok(panel.line(points, color, &format!("{load} N/mm")).dashed(plain, color, ""))
    })
}

/// Draws the pressures under one load.
fn pressures(nip: &Nip) -> Result<Panel, Box<dyn Error>> {
    let axes = (("x / mm", [-15.0, 15.0]), ("pressure / MPa", [0.0, 1.6]));
    let mut panel = Panel::new("Pressure under 10 N/mm", axes.0, axes.1).size(400, 220);
    let row = |solution: &Solution<'_, f64>| -> Result<Points, ContactError<f64>> {
        let (on, pressure) = (solution.hull(), solution.pressure()?);
        let x = (0..=200).map(|i| on.at_angle(PI * (1.0 - f64::from(i) / 200.0)));
        x.map(|x| Ok((x, pressure.at(x)?))).collect()
    };
    for (i, thickness) in [2.0, 8.0, 30.0].into_iter().enumerate() {
        let solution = nip.contact(cover(thickness, RATIO))?.solve(Control::Load(10.0))?;
        panel = panel.line(row(&solution)?, shade(i, 3), &format!("{thickness} mm"));
    }
    let [lower, upper] = &nip.rollers;
    let rubber = Material::elastic(RUBBER, RATIO);
    let plain = Contact::new(lower, upper)?.materials(Material::Rigid, rubber, PlaneState::Strain);
    let plain = plain.solve(Control::Load(10.0))?;
    Ok(panel.dashed(row(&plain)?, GRAY, "half-plane"))
}
