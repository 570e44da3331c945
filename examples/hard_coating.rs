//! A hard coating of 3 µm on steel under a needle roller.
//!
//!     cargo run --release --example hard_coating
//!
//! For half-widths of half to eight thicknesses: the shear that the interface has to bear, the
//! tension on the surface beside the contact, which opens cracks, and the largest von Mises stress
//! in coating and steel. Lengths in mm, pressures in MPa, loads in N/mm.

#[path = "shared/drawing.rs"]
mod drawing;

use drawing::{BLACK, BLUE, GRAY, Grid, Panel, Points, RED, SeriesLabelPosition};
use linecontact::profile::Parabola;
use linecontact::stress::{Stress, Subsurface};
use linecontact::{
    Base, Body, Contact, ContactError, Control, Flat, Layer, Material, PlaneState, Solution,
};
use std::error::Error;

const THICKNESS: f64 = 3e-3;
const RADIUS: f64 = 1.0;
const STEEL: [f64; 2] = [210e3, 0.3];
const COATING: [f64; 2] = [400e3, 0.25];
/// Half-widths by the thickness.
const WIDTHS: [f64; 5] = [0.5, 1.0, 2.0, 4.0, 8.0];
/// The one that is drawn.
const DRAWN: f64 = 2.0;

/// Place and value of the largest shear along the interface.
fn interface_shear(
    below: &Subsurface<'_, f64>,
    half_width: f64,
) -> Result<[f64; 2], ContactError<f64>> {
    let mut largest = [0.0; 2];
    for i in 0..=2000 {
        let x = 3.0 * half_width.max(THICKNESS) * f64::from(i) / 2000.0;
        let shear = below.at(x, THICKNESS)?.tau_xy.abs();
        if shear > largest[1] {
            largest = [x, shear];
        }
    }
    Ok(largest)
}

/// First depth in the steel.
fn below_interface() -> f64 {
    THICKNESS * (1.0 + f64::EPSILON)
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let roller = Parabola::new(RADIUS, [-0.2, 0.2])?;
    let [steel, hard] = [STEEL, COATING].map(|[modulus, ratio]| Material::elastic(modulus, ratio));
    let coating = Layer { material: hard, thickness: THICKNESS, base: Base::HalfPlane(steel) };
    let contact = Contact::new(&Flat, &roller)?;
    let contact = contact.materials(coating, steel, PlaneState::Strain);
    println!(
        "half-width a, thickness t: interface shear τ, tension σx, von Mises in coating and steel"
    );
    println!(
        "{:<5}{:<12}{:<10}{:<8}{:<8}{:<8}{:<8}{:<9}{:<8}{:<8}at y/t",
        "a/t",
        "F / (N/mm)",
        "p₀ / MPa",
        "τ/p₀",
        "at x/a",
        "σx/p₀",
        "at x/a",
        "coating",
        "at y/t",
        "steel"
    );
    let mut drawn = String::new();
    for width in WIDTHS {
        let half_width = width * THICKNESS;
        let solution = contact.solve(Control::HalfWidth(half_width))?;
        let below = || solution.subsurface_of(Body::Lower);
        let peak = solution.peak()?.pressure;
        let [place, shear] = interface_shear(&below()?, half_width)?;
        let tension = below()?.max_tension()?;
        let in_coating = below()?.within([0.0, THICKNESS])?.max_von_mises(COATING[1])?;
        let in_steel = below()?.within([THICKNESS, f64::INFINITY])?.max_von_mises(STEEL[1])?;
        println!(
            "{width:<5}{:<12.3}{peak:<10.1}{:<8.4}{:<8.3}{:<8.4}{:<8.3}{:<9.4}{:<8.3}{:<8.4}{:.3}",
            solution.load(),
            shear / peak,
            place / half_width,
            tension.value / peak,
            tension.x.abs() / half_width,
            in_coating.value / peak,
            in_coating.depth / THICKNESS,
            in_steel.value / peak,
            in_steel.depth / THICKNESS,
        );
        // What the interface bears is the same on both sides.
        let above = below()?.at(0.0, THICKNESS)?;
        let beneath = below()?.at(0.0, below_interface())?;
        assert!((above.sigma_y - beneath.sigma_y).abs() < 1e-12 * peak);
        assert!(tension.value > 0.0);
        if width == DRAWN {
            drawn = draw(&solution, half_width, peak)?;
        }
    }
    println!("{drawn}");
    Ok(())
}

fn draw(
    solution: &Solution<'_, f64>,
    half_width: f64,
    peak: f64,
) -> Result<String, Box<dyn Error>> {
    const WIDTH: i32 = 400;
    const RANGE: [f64; 2] = [-2.5, 2.5];
    let below = solution.subsurface_of(Body::Lower)?;
    let line = |depth: f64, part: fn(Stress<f64>) -> f64| -> Result<Points, ContactError<f64>> {
        let x = (-250..=250).map(|i| f64::from(i) / 100.0);
        x.map(|x| Ok((x, part(below.at(half_width * x, depth)?) / peak))).collect()
    };
    let along = |stress: Stress<f64>| stress.sigma_x;
    let axes = (("", RANGE), ("σx/p₀", [-1.4, 1.0]));
    let tension = Panel::new("Stress along the surface and the interface", axes.0, axes.1)
        .size(WIDTH, 240)
        .legend(SeriesLabelPosition::UpperRight)
        .line(line(0.0, along)?, BLACK, "surface")
        .line(line(THICKNESS, along)?, BLUE, "coating at the interface")
        .line(line(below_interface(), along)?, RED, "steel at the interface")
        .dashed(vec![(-2.5, 0.0), (2.5, 0.0)], GRAY, "");
    let axes = (("", RANGE), ("stress/p₀", [-1.1, 0.4]));
    let bond = Panel::new("Stress that the interface bears", axes.0, axes.1)
        .size(WIDTH, 180)
        .legend(SeriesLabelPosition::LowerRight)
        .line(line(THICKNESS, |stress| stress.sigma_y)?, BLUE, "σy")
        .line(line(THICKNESS, |stress| stress.tau_xy)?, RED, "τxy");
    let levels: Vec<f64> = (1..=16).map(|i| 0.02 * f64::from(i)).collect();
    let deepest = -2.0;
    let shear = |x: f64, y: f64| below.at(half_width * x, -half_width * y);
    let shear = |x: f64, y: f64| Ok::<_, ContactError<f64>>(shear(x, y)?.max_shear() / peak);
    let grid = Grid::new(RANGE, [deepest, 0.0], [80, 60], shear)?;
    let interface = -THICKNESS / half_width;
    let field =
        Panel::new("Largest shear below the surface", ("x/a", RANGE), ("y/a", [deepest, 0.0]))
            .with_equal_scales(WIDTH)
            .levels(&grid, &levels, RED)
            .dashed(vec![(-2.5, interface), (2.5, interface)], BLACK, "");
    let key = Panel::key("largest shear stress / p₀", WIDTH, &levels, RED);
    drawing::save("hard_coating", vec![vec![tension, bond, field, key]])
}
