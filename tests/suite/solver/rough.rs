//! A warm solver on rough bodies, with many contacts that merge and part from load to load.
#![allow(missing_docs)]

use crate::common::{Shares, controls::controls_of};
use linecontact::profile::Spline;
use linecontact::{
    Contact, ContactError, Control, Flat, Material, PlaneState, Reference, References, Solution,
    Solver,
};
use std::f64::consts::PI;

type Solved<'b> = Result<Solution<'b, f64>, ContactError<f64>>;

/// Returns a roller of 20 mm with a wave and noise, in mm, by measured points.
fn rough(seed: u64, wave: f64, noise: f64) -> Spline<f64> {
    let mut random = Shares(seed);
    let point = |i: i32| {
        let x = 0.01 * f64::from(i);
        let round = 20.0 - (400.0 - x * x).sqrt();
        [x, round + wave * (2.0 * PI * x / 0.3).sin() + noise * random.between(-1.0, 1.0)]
    };
    let points: Vec<[f64; 2]> = (-200..=200).map(point).collect();
    Spline::through(&points).unwrap()
}

/// Seeds of the bodies, with their waves and their noise.
const BODIES: [(u64, f64, f64); 6] = [
    (1, 1e-3, 2e-4),
    (2, 1e-3, 2e-4),
    (3, 1e-3, 0.0),
    (4, 3e-4, 1e-4),
    (5, 0.0, 1e-4),
    (6, 1e-4, 1e-5),
];

fn contact(body: &Spline<f64>) -> Contact<'_, f64> {
    let steel = Material::elastic(209e3, 0.3);
    Contact::new(&Flat, body).unwrap().materials(steel, steel, PlaneState::Strain)
}

/// Returns the rising, the falling and a scattered order.
fn orders(count: usize) -> [Vec<usize>; 3] {
    let rising: Vec<usize> = (0..count).collect();
    let mut falling = rising.clone();
    falling.reverse();
    let mixed = rising.iter().map(|i| (7 * i + 3) % count).collect();
    [rising, falling, mixed]
}

/// Solves all controls in each order, with one solver per order, and returns the number solved.
/// Every warm solve agrees with the cold one: found or refused with the same message, and if the
/// contact is `unique` with the same limits.
fn check(contact: &Contact<'_, f64>, controls: &[Control<f64>], unique: bool, name: &str) -> usize {
    let cold: Vec<Solved<'_>> = controls.iter().map(|&control| contact.solve(control)).collect();
    let mut found = 0;
    for order in orders(controls.len()) {
        let mut solver = Solver::new();
        for i in order {
            let name = format!("{name}, {:?}", controls[i]);
            match (solver.solve(contact, controls[i]), &cold[i]) {
                (Ok(warm), Ok(cold)) if unique => assert_close(&warm, cold, &name),
                (Ok(_), _) => {}
                (Err(warm), Err(cold)) => assert_eq!(warm, *cold, "{name}"),
                (Err(warm), Ok(_)) => panic!("{name}: {warm}"),
            }
            found += usize::from(cold[i].is_ok());
        }
    }
    found
}

/// Asserts that the limits agree within the estimates of both solutions.
fn assert_close(warm: &Solution<'_, f64>, cold: &Solution<'_, f64>, name: &str) {
    let [one, other] = [warm, cold].map(Solution::intervals);
    assert_eq!(one.len(), other.len(), "{name}: {:?} and {:?}", warm.report(), cold.report());
    let share = [warm, cold].iter().filter_map(|of| of.limits_error()).sum::<f64>();
    for (one, other) in one.iter().zip(other) {
        let allowed = share * other.half_width();
        for off in [one.left - other.left, one.right - other.right] {
            assert!(off.abs() <= allowed, "{name}: {one:?} is not {other:?}, within {allowed:e}");
        }
    }
}

/// Returns values from one to another by equal factors.
fn by_factors(from: f64, to: f64, count: usize) -> impl Iterator<Item = f64> {
    (0..count).map(move |i| from * (to / from).powf(i as f64 / (count - 1) as f64))
}

#[test]
fn under_a_load_what_is_solved_from_scratch_is_solved_from_the_last_contact() {
    for (seed, wave, noise) in BODIES {
        let body = rough(seed, wave, noise);
        // With noise alone there are dozens of contacts.
        let most = if wave > 5e-4 { 500.0 } else { 60.0 };
        let loads: Vec<_> = by_factors(2.0, most, 20).map(Control::Load).collect();
        let scene = contact(&body);
        assert_eq!(check(&scene, &loads, true, &format!("body {seed}")), 60);
    }
}

/// Under a load 3.7 times as large most contacts are others: the last would take more attempts.
#[test]
fn after_a_large_step_the_search_starts_anew() {
    let (seed, wave, noise) = BODIES[0];
    let body = rough(seed, wave, noise);
    let (scene, mut solver) = (contact(&body), Solver::new());
    let [first, load] = [245.43284518111724, 897.7060433608567].map(Control::Load);
    solver.solve(&scene, first).unwrap();
    let [cold, warm] = [scene.solve(load), solver.solve(&scene, load)].map(Result::unwrap);
    assert_eq!(warm.report(), cold.report());
    assert_close(&warm, &cold, "a large step");
    assert!(warm.cost().evaluations <= cold.cost().evaluations);
}

/// Loads under which a gap lies far from a contact whose pressure takes more than 32 values: those
/// too few to show it move the gap by more than the contacts next to it are uncertain.
#[test]
fn a_pressure_not_resolved_moves_gaps_far_off() {
    for (seed, wave, noise, load) in [
        (183, 1e-3, 4e-4, 663.3384890709345),
        (339, 2e-3, 4e-4, 350.74800700308043),
        (522, 3e-4, 2e-4, 302.35778300736644),
        (1570, 0.0, 2e-4, 792.5767995985793),
        (1995, 0.0, 4e-4, 515.0180395724742),
        (2410, 0.0, 2e-4, 947.1278512519708),
    ] {
        let body = rough(seed, wave, noise);
        let found = contact(&body).solve(Control::Load(load));
        assert!(found.is_ok(), "{seed}: {}", found.unwrap_err());
    }
}

#[test]
fn under_any_other_control_too() {
    let references =
        References { x: 0.0, lower: Reference::Depth(30.0), upper: Reference::Disc(20.0) };
    let mut found = [0; 4];
    for (seed, wave, noise) in [BODIES[1], BODIES[2], BODIES[5]] {
        let body = rough(seed, wave, noise);
        let scene = contact(&body);
        let name = format!("body {seed}");
        let widths: Vec<_> = by_factors(1e-3, 0.5, 8).map(Control::HalfWidth).collect();
        let peaks: Vec<_> = by_factors(100.0, 3000.0, 8).map(Control::PeakPressure).collect();
        let centre = |load| Control::CentreOfPressure { load, at: 0.01 };
        let centres: Vec<_> = by_factors(20.0, 200.0, 5).map(centre).collect();
        let by_approach = |approach| Control::Approach { approach, references };
        let approaches: Vec<_> = by_factors(2e-4, 3e-3, 4).map(by_approach).collect();
        // For a given half-width, or peak, several solutions may exist.
        for (i, (controls, unique)) in
            [(widths, false), (peaks, false), (centres, true), (approaches, true)]
                .into_iter()
                .enumerate()
        {
            found[i] += check(&scene, &controls, unique, &name);
        }
        // Of each kind of control, those of some loads.
        let loads = by_factors(20.0, 200.0, 5).map(Control::Load);
        let of: Vec<_> = loads.map(|load| controls_of(&scene.solve(load).unwrap())).collect();
        for i in 0..of[0].len() {
            let controls: Vec<_> = of.iter().map(|controls| controls[i]).collect();
            assert_eq!(check(&scene, &controls, false, &name), 15, "{name}, {:?}", controls[0]);
        }
    }
    println!("{found:?}");
    assert!(found.iter().all(|&found| found >= 30), "{found:?}");
}
