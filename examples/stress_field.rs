//! The stress below a roller on a flat, and the place where the material yields first.
//!
//! Run with `cargo run --release --example stress_field`. It prints the largest shear and the
//! largest von Mises stress with their depths, checked against Hertz's solution. It draws the two
//! bodies before and under load, the pressure, and the shear below, all in terms of the half-width
//! L and the peak pressure p₀, to `target/figures/stress_field.svg`.
//!
//! The bodies are of like material, so each takes half of the displacement that the pressure causes
//! between their surfaces. In plane strain their approach as a whole has no meaning without a
//! reference point: the loaded bodies are drawn with y = 0 at the edges of the contact.

#[path = "shared/drawing.rs"]
mod drawing;

use drawing::{BLACK, BLUE, Grid, Panel, Points, RED, SeriesLabelPosition};
use linecontact::stress::Subsurface;
use linecontact::{Contact, ContactError, Control, Cost, Curve, CurvePoint, Flat, Solution};
use std::error::Error;
use std::f64::consts::PI;

const L: f64 = 0.1;

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    // Roller of radius 1 as a parabola, as in Hertz's theory.
    let roller =
        Curve::new([-1.0, 1.0], |k: f64| CurvePoint { x: k, y: k * k / 2.0, dx: 1.0, dy: k });
    let contact = Contact::new(&Flat, &roller)?;
    let solution = contact.solve(Control::HalfWidth(L))?;
    let p0 = solution.peak()?.pressure;
    let below = solution.subsurface()?;

    let (shear, mises) = (below.max_shear()?, below.max_von_mises(0.3)?);
    println!("largest shear {:.7} p₀ at depth {:.7} L", shear.value / p0, shear.depth / L);
    println!("largest von Mises stress, ν = 0.3, {:.7} p₀", mises.value / p0);
    println!("  at depth {:.7} L", mises.depth / L);
    let sliding = solution.subsurface()?.friction(0.25)?;
    let moved = sliding.max_shear()?;
    println!("with friction 0.25: largest shear {:.7} p₀", moved.value / p0);
    println!("  at x = {:.7} L, depth {:.7} L", moved.x / L, moved.depth / L);
    println!("{}", draw(&solution, [&below, &sliding], p0)?);

    // Johnson, Contact Mechanics, 1985, Eqs. 4.46 and 4.47.
    assert!((shear.value / p0 - 0.3002831).abs() < 1e-7);
    assert!((shear.depth / L - 0.7861514).abs() < 1e-6);
    let on_axis = |t: f64| {
        let root = 1f64.hypot(t);
        let [x, y] = [2.0 * t - (1.0 + 2.0 * t * t) / root, -1.0 / root];
        let z = 0.3 * (x + y);
        (((x - y).powi(2) + (y - z).powi(2) + (z - x).powi(2)) / 2.0).sqrt()
    };
    let depth = mises.depth / L;
    assert!((mises.value / p0 - on_axis(depth)).abs() < 1e-13);
    assert!(on_axis(depth) > on_axis(depth - 1e-3) && on_axis(depth) > on_axis(depth + 1e-3));
    assert!((mises.value / p0 - 0.5575162).abs() < 1e-7 && (depth - 0.7042917).abs() < 1e-6);
    Ok(())
}

/// Draws everything over the same x, and returns a line that names the file.
fn draw(
    solution: &Solution<f64>,
    below: [&Subsurface<f64>; 2],
    p0: f64,
) -> Result<String, Box<dyn Error>> {
    const REACH: f64 = 2.5;
    const WIDTH: i32 = 400;
    let x: Vec<f64> = (-100..=100).map(|i| f64::from(i) / 40.0).collect();

    // Heights of flat and roller under load, in units of L²/R = L². Each surface moves by half the
    // difference between the gap under load and the undeformed gap.
    let loaded = |x: f64| {
        let inside = solution.hull().contains(L * x);
        let gap = if inside { 0.0 } else { solution.gap_at(L * x)? / (L * L) };
        let [flat, roller] = [0.0, (x * x - 1.0) / 2.0];
        let moved = 0.5 * (gap - (roller - flat));
        Ok([flat - moved, roller + moved])
    };
    let loaded: Vec<[f64; 2]> =
        x.iter().map(|&x| loaded(x)).collect::<Result<_, ContactError<_>>>()?;
    let surface = |i: usize| -> Points { x.iter().zip(&loaded).map(|(&x, y)| (x, y[i])).collect() };
    let before = |height: fn(f64) -> f64| -> Points { x.iter().map(|&x| (x, height(x))).collect() };
    let range = [-REACH, REACH];
    let heights = [-0.9, 2.6];
    let bodies = Panel::new("The bodies", ("", range), ("y R/L²", heights))
        .size(WIDTH, 220)
        .legend(SeriesLabelPosition::UpperMiddle)
        .body(surface(0), heights[0], BLUE, "flat under load")
        .body(surface(1), heights[1], RED, "roller under load")
        .dashed(before(|_| 0.0), BLACK, "before loading")
        .dashed(before(|x| x * x / 2.0), BLACK, "");

    let pressure = solution.pressure()?;
    // Places at equal angles: close together at the edges, where the pressure is steep.
    let on = solution.hull();
    let x = (0..=200).map(|i| on.at_angle(PI * f64::from(i) / 200.0));
    let share = |x| Ok((x / L, pressure.estimate(x, &mut Cost::default())?.value / p0));
    let pressures = x.map(share).collect::<Result<Points, ContactError<_>>>()?;
    let pressures = Panel::new("Pressure", ("x/L", range), ("P/p₀", [0.0, 1.2]))
        .size(WIDTH, 160)
        .body(pressures, 0.0, BLUE, "")
        .limit(-1.0, "−L")
        .limit(1.0, "L");

    let levels: Vec<f64> = (1..=16).map(|i| 0.02 * f64::from(i)).collect();
    let field = |below: &Subsurface<f64>, title: &str, label: &str| {
        let shear =
            |x, y: f64| Ok::<_, ContactError<f64>>(below.at(L * x, -L * y)?.max_shear() / p0);
        let grid = Grid::new(range, [-2.0, 0.0], [100, 40], shear)?;
        let worst = below.max_shear()?;
        let (x, y) = (worst.x / L, -worst.depth / L);
        let name = format!("{:.3} p₀", worst.value / p0);
        let panel = Panel::new(title, (label, range), ("y/L", [-2.0, 0.0]))
            .with_equal_scales(WIDTH)
            .levels(&grid, &levels, RED)
            .dots(vec![(x, y)], BLACK, "")
            .note(x, y - 0.06, &name, BLACK);
        Ok::<_, ContactError<f64>>(panel)
    };
    let still = field(below[0], "Stress below the surface", "")?;
    let sliding = field(below[1], "The same with friction, µ = 0.25", "x/L")?;
    let key = Panel::key("largest shear stress / p₀", WIDTH, &levels, RED);
    drawing::save("stress_field", vec![vec![bodies, pressures], vec![still, sliding, key]])
}
