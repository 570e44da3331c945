//! A rough surface that repeats, pressed on a flat: its area of contact against the load.
//!
//!     cargo run --release --example rough_surface
//!
//! The surface is self-affine: 21 waves a period. From a light load to a nearly complete contact,
//! the share of the period in contact is compared with Persson's law for many waves of random
//! phases. Lengths in periods, pressures in E* times the root mean square slope.

#[path = "shared/drawing.rs"]
mod drawing;
#[path = "shared/rough.rs"]
mod rough;

use drawing::{BLUE, GRAY, Panel, Points, RED, SeriesLabelPosition, mix, tint};
use linecontact::{
    Contact, ContactError, Control, Flat, Interval, Panels, Solution, SolveError, Solver,
};
use std::error::Error;
use std::f64::consts::SQRT_2;

/// Largest number of waves a period.
const MOST: u32 = 24;
/// Mean pressures: the first, the last and their number.
const LOADS: (f64, f64, usize) = (0.003, 0.9, 20);
/// Which of them are drawn over the period.
const DRAWN: [usize; 3] = [10, 14, 17];

/// Result for one load.
struct Pressed {
    load: f64,
    contacts: Vec<Interval<f64>>,
    /// Pressures and gaps along the period, for the loads that are drawn.
    rows: Option<[Points; 2]>,
}

impl Pressed {
    /// Returns the share of the period that is in contact.
    fn area(&self) -> f64 {
        self.contacts.iter().map(|on| on.right - on.left).sum()
    }
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let body = rough::surface(MOST);
    let panels = Panels { tolerance: 1e-8 };
    let contact = Contact::new(&Flat, &body)?.contact_modulus(1.0).period(1.0).quadrature(&panels);
    // Where it is complete, an error says so.
    let Err(ContactError::Solve(SolveError::CompleteContact { complete, .. })) =
        contact.solve(Control::Load(10.0))
    else {
        return Err("under ten times the stiffness it is pressed flat".into());
    };
    println!("complete contact from a mean pressure of {complete:.3}");
    println!("mean pressure  contacts  area     Persson  largest pressure");
    let (first, last, count) = LOADS;
    let (mut solver, mut all) = (Solver::new(), Vec::with_capacity(count));
    for i in 0..count {
        let load = first * (last / first).powf(i as f64 / (count - 1) as f64);
        let solution = solver.solve(&contact, Control::Load(load))?;
        let contacts = solution.intervals().to_vec();
        let rows = if DRAWN.contains(&i) { Some(rows(&solution)?) } else { None };
        let pressed = Pressed { load, contacts, rows };
        let (area, peak) = (pressed.area(), solution.peak()?.pressure);
        println!(
            "{load:<14.4} {:<9} {area:<8.4} {:<8.4} {peak:.4}",
            pressed.contacts.len(),
            persson(load)
        );
        all.push(pressed);
    }
    check(&all);
    println!("{}", drawing::save("rough_surface", draw(&all))?);
    Ok(())
}

/// Returns the share in contact of many waves of random phases under a mean pressure (Persson, *J.
/// Chem. Phys.* 115, 2001, 3840).
///
/// In complete contact a wave `a cos ωx` bears the pressure `E*/2 ω a cos ωx`, so that the pressure
/// is Gaussian about its mean p, and its variance V is (E*/2)² times that of the slope. As waves
/// are added one by one, its density spreads like heat, and what gets to zero loses contact: `∫₀
/// (G(s - p) - G(s + p)) ds = erf(p/√(2V))` is left.
fn persson(load: f64) -> f64 {
    erf(SQRT_2 * load)
}

/// Returns the error function, from its series.
fn erf(x: f64) -> f64 {
    let (mut term, mut sum) = (x, x);
    for n in 1..60 {
        term *= -x * x / f64::from(n);
        sum += term / f64::from(2 * n + 1);
    }
    std::f64::consts::FRAC_2_SQRT_PI * sum
}

/// Returns pressures and gaps along a period.
fn rows(solution: &Solution<'_, f64>) -> Result<[Points; 2], ContactError<f64>> {
    const PLACES: u32 = 1000;
    let (on, pressure) = (solution.intervals(), solution.pressure()?);
    let mut rows = [Vec::new(), Vec::new()];
    for i in 0..=PLACES {
        let x = f64::from(i) / f64::from(PLACES);
        // The contacts may be those of the period before or after.
        let is_in = |x: f64| on.iter().any(|on| on.left < x && x < on.right);
        let touches = (-1..=1).any(|turn| is_in(x + f64::from(turn)));
        let (p, gap) = if touches { (pressure.at(x)?, 0.0) } else { (0.0, solution.gap_at(x)?) };
        rows[0].push((x, p));
        rows[1].push((x, 1e3 * gap));
    }
    Ok(rows)
}

/// Checks what holds for any surface, and how far off the law is for this one.
fn check(all: &[Pressed]) {
    for pair in all.windows(2) {
        // Limits only move outwards.
        for light in &pair[0].contacts {
            let is_within = |heavy: &Interval<f64>| {
                let turns = (light.centre() - heavy.centre()).round();
                heavy.left + turns <= light.left + 1e-9 && light.right <= heavy.right + turns + 1e-9
            };
            assert!(pair[1].contacts.iter().any(is_within), "{light:?} at {}", pair[0].load);
        }
    }
    let last = &all[all.len() - 1];
    assert!(all[0].contacts.len() < 4 && last.area() > 0.9);
    for pressed in all.iter().filter(|pressed| pressed.load > 0.05) {
        let share = pressed.area() / persson(pressed.load);
        assert!((1.0..1.7).contains(&share), "{share} at {}", pressed.load);
    }
    for Pressed { load, rows, .. } in all {
        let Some([pressures, gaps]) = rows else { continue };
        let sum: f64 = pressures[1..].iter().map(|at| at.1).sum();
        assert!((sum / pressures.len() as f64 / load - 1.0).abs() < 1e-2, "{sum} of {load}");
        assert!(gaps.iter().all(|at| at.1 > -1e-9), "an overlap at {load}");
    }
}

/// Draws pressures and gaps, and the area and number of contacts against the load.
fn draw(all: &[Pressed]) -> Vec<Vec<Panel>> {
    let panel = |title: &str, y, most| {
        Panel::new(title, ("x", [0.0, 1.0]), (y, [0.0, most])).size(440, 200)
    };
    let (mut pressures, mut gaps) = (
        panel("Pressure under three loads", "pressure", 3.0).legend(SeriesLabelPosition::UpperLeft),
        panel("Gap under the same loads", "gap, 1/1000 of the period", 60.0),
    );
    for (turn, pressed) in all.iter().filter(|pressed| pressed.rows.is_some()).enumerate() {
        let Some([pressure, gap]) = &pressed.rows else { continue };
        let color = mix(tint(BLUE, 0.5), RED, turn as f64 / 2.0);
        pressures = pressures.line(pressure.clone(), color, &format!("mean {:.2}", pressed.load));
        gaps = gaps.line(gap.clone(), color, "");
    }
    let of = |value: fn(&Pressed) -> f64| -> Points {
        all.iter().map(|one| (one.load.log10(), value(one))).collect()
    };
    let axis = ("mean pressure", [-2.6, 0.0]);
    let area = Panel::new("Area of contact", axis, ("share in contact", [-2.5, 0.0]))
        .size(440, 200)
        .powers(true, true)
        .legend(SeriesLabelPosition::UpperLeft)
        .line(of(|one| one.area().log10()), BLUE, "")
        .dots(of(|one| one.area().log10()), BLUE, "computed")
        .dashed(of(|one| persson(one.load).log10()), GRAY, "Persson");
    let counts = Panel::new("Contacts in a period", axis, ("number", [0.0, 15.0]))
        .size(440, 200)
        .powers(true, false)
        .dots(of(|one| one.contacts.len() as f64), BLUE, "");
    vec![vec![pressures, gaps], vec![area, counts]]
}
