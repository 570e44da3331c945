//! The stress below a roller on a flat: where the material yields first.
//!
//! Run with `cargo run --release --example stress_field`. It prints the greatest shear and the
//! greatest von Mises stress with their depths, checked against Hertz's solution, and draws the two
//! bodies before and under load, the pressure, and the lines of equal shear below, all in terms of
//! the half-width L and the peak pressure p₀, to `target/figures/stress_field.svg`.
//!
//! The bodies are of like material, so that each takes half of what the pressure moves their
//! surfaces apart. How far they approach each other as a whole has no meaning in plane strain without
//! a place to measure it from: the loaded bodies are drawn with y = 0 at the edges of the contact.

use kuva::prelude::*;
use linecontact::stress::Subsurface;
use linecontact::{Contact, ContactError, Control, Cost, Curve, CurvePoint, Flat, Solution};
use std::error::Error;
use std::fs;
use std::time::Instant;

const L: f64 = 0.1;
const BLUE: &str = "#1f5fa8";
const RED: &str = "#b5401a";

fn main() -> Result<(), Box<dyn Error>> {
    // A roller of radius 1 as the parabola that Hertz takes it for.
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
    let start = Instant::now();
    let path = draw(&solution, &below, p0)?;
    println!("{path}, in {:.2} s", start.elapsed().as_secs_f64());

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

/// Draws everything over the same x, and says where.
fn draw(
    solution: &Solution<f64>,
    below: &Subsurface<f64>,
    p0: f64,
) -> Result<&'static str, Box<dyn Error>> {
    const REACH: f64 = 2.5;
    let x: Vec<f64> = (-250..=250).map(|i| f64::from(i) / 100.0).collect();
    let line = |points: Vec<(f64, f64)>, color| {
        LinePlot::new().with_data(points).with_color(color).with_stroke_width(2.0)
    };

    // The roller on the flat, in units of L²/R = L². Of the gap that opens beside the contact over
    // that of the bodies, and of their common surface in it, each has half.
    let loaded = |x: f64| {
        let inside = solution.hull().contains(L * x);
        let gap = if inside { 0.0 } else { solution.gap_at(L * x)? / (L * L) };
        let [flat, roller] = [0.0, (x * x - 1.0) / 2.0];
        let moved = 0.5 * (gap - (roller - flat));
        Ok([flat - moved, roller + moved])
    };
    let loaded: Vec<[f64; 2]> =
        x.iter().map(|&x| loaded(x)).collect::<Result<_, ContactError<_>>>()?;
    let under = |i: usize| line(x.iter().zip(&loaded).map(|(&x, y)| (x, y[i])).collect(), BLUE);
    let before = |height: fn(f64) -> f64| {
        line(x.iter().map(|&x| (x, height(x))).collect(), RED).with_dashed()
    };
    let bodies: Vec<Plot> = vec![
        before(|_| 0.0).with_legend("before loading").into(),
        before(|x| x * x / 2.0).into(),
        under(0).with_legend("under load").into(),
        under(1).into(),
    ];
    let pressure = solution.pressure()?;
    let share = |&x: &f64| Ok((x, pressure.estimate(L * x, &mut Cost::default())?.value / p0));
    let pressure: Vec<Plot> =
        vec![line(x.iter().map(share).collect::<Result<_, ContactError<_>>>()?, BLUE).into()];

    let across: Vec<f64> = (-75..=75).map(|i| REACH * f64::from(i) / 75.0).collect();
    let up: Vec<f64> = (0..=75).rev().map(|i| -REACH * f64::from(i) / 75.0).collect();
    let row = |&y: &f64| {
        let shear = |&x: &f64| Ok(below.at(L * x, -L * y)?.max_shear() / p0);
        across.iter().map(shear).collect::<Result<Vec<f64>, ContactError<f64>>>()
    };
    let grid = up.iter().map(row).collect::<Result<Vec<_>, _>>()?;
    let levels: Vec<f64> = (1..=14).map(|i| 0.02 * f64::from(i)).collect();
    let contours = ContourPlot::new().with_grid(grid, across, up).with_levels(&levels);
    let field: Vec<Plot> = vec![contours.with_line_color(BLUE).with_line_width(1.2).into()];

    let framed = |plots: &[Plot], title: &str, y: &str| {
        let layout = Layout::auto_from_plots(plots).with_title(title).with_y_label(y);
        layout.with_x_axis_min(-REACH).with_x_axis_max(REACH).with_box_axes()
    };
    let layouts = vec![
        framed(&bodies, "The two bodies (under load: from the edges of the contact)", "y R/L²")
            .with_legend_position(LegendPosition::InsideTopCenter),
        framed(&pressure, "Pressure", "P/p₀").with_y_axis_min(0.0),
        framed(&field, "Largest shear stress, 0.02 p₀ from line to line", "−depth/L")
            .with_x_label("x/L")
            .with_y_axis_min(-REACH),
    ];
    let figure = Figure::new(3, 1).with_plots(vec![bodies, pressure, field]).with_layouts(layouts);
    let figure = figure.with_cell_size(640.0, 260.0).with_row_height(2, 420.0).with_shared_x_all();
    fs::create_dir_all("target/figures")?;
    fs::write("target/figures/stress_field.svg", SvgBackend.render_scene(&figure.render()))?;
    Ok("target/figures/stress_field.svg")
}
