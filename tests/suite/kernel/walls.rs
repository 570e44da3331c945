//! Lands between upright walls, one in each period, and rows of them on a layer.

use linecontact::profile::{Outline, Placement};
use linecontact::{
    Base, Contact, ContactError, Control, Flat, Layer, Material, PlaneState, SolveError, Solver,
};
use std::f64::consts::PI;

/// A land drawn between walls at round places is a periodic punch, wherever it lies in the period:
///
/// ```text
/// P = F/p cos(πx/p)/sqrt(sin²(πa/p) - sin²(πx/p))
/// ```
///
/// The walls lie between all places at which slopes are taken.
#[test]
fn a_land_at_any_round_place() {
    let (mut count, mut faults) = (0, Vec::new());
    for (period, parts, widths) in [(1.0, 20, 7..=8), (0.6, 20, 8..=8), (12.0, 12, 4..=5)] {
        let places = |width: i32| (1..parts - width).map(move |from| (from, from + width));
        for (from, to) in widths.flat_map(places) {
            let at = |i: i32| period * f64::from(i) / f64::from(parts);
            let [start, end, depth] = [at(from), at(to), 0.05 * period];
            let land = Outline::from([0.0, depth]).line(start).wall(-depth).line(end - start);
            let body = land.wall(depth).line(period - end).build().unwrap();
            let contact = Contact::new(&Flat, &body).unwrap().contact_modulus(115e3).period(period);
            let solution = match contact.solve(Control::Load(5.0 * period)) {
                Ok(solution) => solution,
                Err(error) => {
                    faults.push(format!("{period} {from} {to}: {error}"));
                    continue;
                }
            };
            let (half, middle) = (0.5 * (end - start), 0.5 * (start + end));
            let pressure = solution.pressure().unwrap();
            for share in [-0.7, 0.0, 0.4] {
                let sin = |x: f64| (PI * x / period).sin().powi(2);
                let x = share * half;
                let due = 5.0 * (PI * x / period).cos() / (sin(half) - sin(x)).sqrt();
                let got = pressure.at(middle + x).unwrap_or(f64::NAN);
                count += 1;
                if (got / due - 1.0).abs() >= 1e-6 || got.is_nan() {
                    faults.push(format!("{period} {from} {to} {share}: {got} for {due}"));
                }
            }
        }
    }
    println!("{count} pressures");
    assert!(faults.is_empty(), "{}:\n{}", faults.len(), faults.join("\n"));
}

/// Ten lands on a thin layer, wherever they are drawn: heights are known to the rounding of their
/// size, and Eq. (1) no better.
#[test]
fn lands_on_a_layer_wherever_they_are_drawn() {
    let mut half = Outline::from([0.0, 0.3]).line(0.5).wall(-0.3);
    for (land, groove) in [(0.81, 0.41), (1.2, 0.85), (0.68, 0.97), (1.92, 0.4)] {
        half = half.line(land).wall(0.2).line(groove).wall(-0.2);
    }
    let body = half.line(1.0).corner(0.2).fillet(0.3).line(1.0).mirrored().build().unwrap();
    let steel = Material::elastic(210e3, 0.3);
    let base = Base::HalfPlane(steel);
    let liner = Layer { material: Material::elastic(417.0, 0.45), thickness: 0.15, base };
    let loads = |at: [f64; 2], load: f64| -> Vec<f64> {
        let body = body.clone().placed(Placement::default().shifted(at[0], at[1])).unwrap();
        let contact = Contact::new(&Flat, &body).unwrap();
        let contact = contact.materials(steel, liner, PlaneState::Strain);
        let solution = contact.solve(Control::Load(load)).unwrap_or_else(|e| panic!("{at:?}: {e}"));
        solution.contacts().unwrap().iter().map(|one| one.load / load).collect()
    };
    for load in [0.0775, 0.4] {
        let due = loads([0.0, 0.0], load);
        assert_eq!(due.len(), 10);
        for at in [[0.0, 37.0], [25.3, -0.3], [25.3, 5.0], [0.0, -2.0], [25.3, 37.0]] {
            for (got, due) in loads(at, load).iter().zip(&due) {
                assert!((got - due).abs() < 1e-8, "{at:?}, {load}: {got} for {due}");
            }
        }
    }
}

/// A stamp with two lands of unequal height on rubber, of which one touches and is held at its
/// wall: the bend is found in as many solves as any, from nothing and from the last load. (As one
/// interval, over the groove, it was not held, and led astray.)
#[test]
fn a_land_beside_one_that_does_not_touch() {
    let steel = Material::elastic(210e3, 0.3);
    let base = Base::HalfPlane(steel);
    let rubber = Layer { material: Material::elastic(5.0, 0.45), thickness: 4.0, base };
    let half =
        |depth: f64| Outline::from([0.0, 0.3]).line(0.5).wall(-depth).line(1.0).arc(50.0, 3.0);
    let body = half(0.3).left(half(0.25)).build().unwrap();
    let alone = Outline::from([0.5, 0.3]).wall(-0.3).line(1.0).arc(50.0, 3.0).build().unwrap();
    let on = |body| Contact::new(&Flat, body).unwrap().materials(steel, rubber, PlaneState::Strain);
    let (both, alone) = (on(&body), on(&alone));
    let mut solver = Solver::new();
    for i in 0..12 {
        let load = 0.003 * 1.5f64.powi(i);
        let cold = both.solve(Control::Load(load)).unwrap_or_else(|e| panic!("{load}: {e}"));
        let warm = solver.solve(&both, Control::Load(load)).unwrap();
        for (solution, samples) in [(&cold, cold.cost().samples), (&warm, warm.cost().samples)] {
            assert!(samples < 8_000, "{load}: {samples}");
            let one = alone.solve(Control::Load(load)).unwrap();
            assert!(
                (solution.a() - one.a()).abs() < 1e-9 && solution.intervals().len() == 1,
                "{load}"
            );
        }
    }
}

/// No width of less than a groove, and no peak, is that of any load.
#[test]
fn a_groove_on_a_layer_has_widths_in_no_load() {
    let steel = Material::elastic(210e3, 0.3);
    let base = Base::HalfPlane(steel);
    let rubber = Layer { material: Material::elastic(5.0, 0.48), thickness: 10.0, base };
    let half = Outline::from([0.0, 0.5]).line(1.0).wall(-0.5).arc(100.0, 30.0);
    let body = half.mirrored().build().unwrap();
    let contact = Contact::new(&Flat, &body).unwrap().materials(rubber, steel, PlaneState::Strain);
    for control in [Control::HalfWidth(0.5), Control::PeakPressure(2.0)] {
        let error = contact.solve(control).map(|found| found.hull()).unwrap_err();
        let ContactError::Solve(SolveError::InJump { .. } | SolveError::NoPeak { .. }) = error
        else {
            panic!("{control:?}: {error}");
        };
    }
}
