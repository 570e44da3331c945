//! Poses in, forces out: against contacts of placed bodies, invariants, the energy of an impact.
#![allow(missing_docs)]

use crate::common::{Profile, graph, quartic};
use linecontact::profile::{Curve, Ellipse, Parabola, Placed, Placement, Spline};
use linecontact::{
    Base, Contact, ContactError, Control, CurvePoint, Flat, Foundation, InputError, Layer,
    Material, Pair, ParametricProfile, Piecewise, PlaneState, Pose, Reference, References,
    SolveError, Wrench,
};

const STEEL: Material<f64> = Material::Elastic { youngs_modulus: 2.1, poisson_ratio: 0.3 };
const TO: References<f64> =
    References { x: 0.0, lower: Reference::Depth(3.0), upper: Reference::Disc(4.0) };
const REST: Pose<f64> = Pose { x: 0.0, y: 0.0, angle: 0.0 };

fn pose(x: f64, y: f64, angle: f64) -> Pose<f64> {
    Pose { x, y, angle }
}

/// Returns a lopsided body that bulges downwards, as an upper one.
fn lopsided() -> Profile {
    graph(-1.5, 1.5, |x| {
        let [square, cube] = [x * x, x * x * x];
        [0.5 * square + 0.05 * cube + 0.1 * square * square, x + 0.15 * square + 0.4 * cube]
    })
}

fn cross(lever: [f64; 2], force: [f64; 2]) -> f64 {
    lever[0] * force[1] - lever[1] * force[0]
}

/// Asserts that both torques are those of the force at its place.
fn assert_balanced(wrench: &Wrench<f64>, lower: Pose<f64>, upper: Pose<f64>) {
    let size = wrench.force[0].hypot(wrench.force[1]);
    for (torque, origin, sign) in [(wrench.torque[0], lower, -1.0), (wrench.torque[1], upper, 1.0)]
    {
        let lever = [wrench.at[0] - origin.x, wrench.at[1] - origin.y];
        let exact = sign * cross(lever, wrench.force);
        assert!((torque - exact).abs() < 1e-13 * size * (1.0 + lever[0].hypot(lever[1])));
    }
}

#[test]
fn it_is_the_contact_of_the_placed_bodies_at_their_overlap() {
    let (body, ground) = (lopsided(), Parabola::new(-8.0, [-3.0, 3.0]).unwrap());
    let mut pair = Pair::new(&ground, &*body, (STEEL, STEEL), TO);
    for (x, y, angle) in [(0.1, -0.02, 0.0), (-0.3, -0.004, 0.2), (0.5, -0.05, -0.15)] {
        let placement = Placement::default().rotated(angle).shifted(x, y);
        let placed = Placed::new(lopsided(), placement).unwrap();
        let contact = Contact::new(&ground, &placed).unwrap();
        let contact = contact.materials(STEEL, STEEL, PlaneState::Strain);
        let wrench = pair.at(REST, pose(x, y, angle)).unwrap();
        // The lowest of many heights.
        let lowest = (0..=200_000).map(|i| -1.0 + 2.0 * f64::from(i) / 200_000.0).map(|k| {
            let point = placed.at(k);
            point.y + point.x * point.x / 16.0
        });
        let lowest = lowest.fold(f64::INFINITY, f64::min);
        assert!((wrench.penetration + lowest).abs() < 1e-9, "{} {lowest}", wrench.penetration);
        let references = References { x, ..TO };
        let control = Control::Approach { approach: wrench.penetration, references };
        let solution = contact.solve(control).unwrap();
        let (load, centre) = (solution.load(), solution.centre_of_pressure().unwrap());
        assert!((wrench.force[1] / load - 1.0).abs() < 1e-12 && wrench.force[0] == 0.0);
        assert!((wrench.at[0] - centre).abs() < 1e-12 && wrench.contacts == 1);
        assert!((wrench.at[1] + centre * centre / 16.0).abs() < 1e-12);
        assert_balanced(&wrench, REST, pose(x, y, angle));
        // The same scene seen from elsewhere.
        let (there, turn) = (pose(40.0, -7.0, 2.2), 2.2f64);
        let [sin, cos] = [turn.sin(), turn.cos()];
        let upper = pose(there.x + cos * x - sin * y, there.y + sin * x + cos * y, angle + turn);
        let moved = pair.at(there, upper).unwrap();
        let turned = [-sin * wrench.force[1], cos * wrench.force[1]];
        for (found, exact) in moved.force.iter().zip(turned) {
            assert!((found - exact).abs() < 1e-10 * load, "{:?}", moved.force);
        }
        assert!((moved.penetration - wrench.penetration).abs() < 1e-13);
        assert!((moved.torque[1] - wrench.torque[1]).abs() < 1e-10 * load);
        assert_balanced(&moved, there, upper);
    }
}

#[test]
fn apart_and_beside_it_is_zero_and_it_is_continuous() {
    let circle = Ellipse::circle(1.0, [-1.4, 1.4]).unwrap();
    let mut pair = Pair::new(&Flat, &circle, (STEEL, STEEL), TO);
    let apart = pair.at(REST, pose(5.0, 0.25, 0.1)).unwrap();
    assert_eq!((apart.force, apart.torque, apart.contacts), ([0.0; 2], [0.0; 2], 0));
    // The centre of the circle is 1 above its origin, which has turned.
    let centre = [5.0 - f64::sin(0.1), 0.25 + f64::cos(0.1)];
    assert!((apart.penetration - (1.0 - centre[1])).abs() < 1e-15, "{}", apart.penetration);
    assert!((apart.at[0] - centre[0]).abs() < 1e-14 && apart.at[1] == 0.0);
    assert_eq!(pair.stiffness(REST, pose(5.0, 0.25, 0.1)).unwrap(), [[0.0; 3]; 3]);
    let beside = Parabola::new(1.0, [-1.0, 1.0]).unwrap();
    let mut two = Pair::new(&beside, &circle, (STEEL, STEEL), TO);
    let beside = two.at(REST, pose(50.0, -1.0, 0.0)).unwrap();
    assert!(beside.force == [0.0; 2] && beside.penetration == f64::NEG_INFINITY);
    // Through first touch the force rises from zero, by less than κ δ.
    let mut before = 0.0;
    for i in 0..=60 {
        let depth = 1e-17 * 10f64.powf(0.25 * f64::from(i));
        let force = pair.at(REST, pose(0.0, -depth, 0.0)).unwrap().force[1];
        assert!(force >= before && force < 4.0 * depth, "{depth:e}: {force:e} after {before:e}");
        before = force;
    }
    assert!(before > 1e-3);
}

/// A second contact is born under a body of two bumps: the force has no jump.
#[test]
fn a_birth_leaves_no_jump() {
    let quartic = quartic(-1.8, 1.8);
    let mut pair = Pair::new(&Flat, &*quartic, (STEEL, STEEL), TO);
    let at = |pair: &mut Pair<'_, f64>, y: f64| pair.at(REST, pose(0.0, y, 0.02)).unwrap();
    let (mut before, mut numbers) = (at(&mut pair, 1.04), Vec::new());
    for i in 1..400 {
        let y = 1.04 - 2e-3 * f64::from(i);
        let next = at(&mut pair, y);
        numbers.push(next.contacts);
        // The stiffness of the table is below 1.5.
        assert!(next.force[1] >= before.force[1] && next.force[1] - before.force[1] < 3e-3);
        assert!((next.torque[1] - before.torque[1]).abs() < 6e-3, "{} {}", next.torque[1], y);
        before = next;
    }
    numbers.dedup();
    assert_eq!(numbers, [0, 1, 2]);
}

/// A burr that no default sample meets bears alone, if it is asked for.
#[test]
fn a_resolution_shows_what_is_narrow() {
    let burr = graph(-1.0, 1.0, |x| {
        let s = (x - 0.6303) / 0.0005;
        let rest = (1.0 - s * s).max(0.0);
        let height = 0.25 * rest.powi(3);
        [0.5 * x * x - height, x + 1.5 * s * rest.powi(2) / 0.0005]
    });
    let lifted = pose(3.0, 0.01, 0.0);
    let mut pair = Pair::new(&Flat, &*burr, (STEEL, STEEL), TO);
    assert_eq!(pair.at(REST, lifted).unwrap().contacts, 0);
    let mut pair = pair.resolution(1e-3);
    for (y, contacts) in [(0.06, 0), (0.01, 1), (-0.03, 2), (0.07, 0)] {
        let wrench = pair.at(REST, pose(3.0, y, 0.0)).unwrap();
        assert_eq!(wrench.contacts, contacts, "{y}: {wrench:?}");
        let lowest = 0.5 * 0.6303f64.powi(2) - 0.25;
        assert!((wrench.penetration + lowest + y).abs() < 1e-6, "{y}: {wrench:?}");
        assert!(contacts == 2 || (wrench.at[0] - 3.6303).abs() < 1e-5, "{y}: {wrench:?}");
    }
    for length in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-9] {
        let mut pair = Pair::new(&Flat, &*burr, (STEEL, STEEL), TO).resolution(length);
        let error = pair.at(REST, lifted).unwrap_err();
        let ContactError::Input(InputError::Pose { y: 0.01, source, .. }) = error else {
            panic!("{length}: {error}")
        };
        assert!(
            matches!(*source, ContactError::Input(InputError::InvalidResolution { .. })),
            "{length}: {source}"
        );
    }
}

#[test]
fn the_stiffness_is_that_of_closed_forms() {
    // A circle about its centre: a turn changes nothing.
    let (radius, depth) = (2.0, 0.01);
    let circle = Curve::new([-1.2, 1.2], move |k: f64| {
        let (sin, cos) = k.sin_cos();
        CurvePoint { x: radius * sin, y: -radius * cos, dx: radius * cos, dy: radius * sin }
    });
    let mut pair = Pair::new(&Flat, &circle, (STEEL, STEEL), TO);
    let upper = pose(0.3, radius - depth, 0.0);
    let contact = Contact::new(&Flat, &circle).unwrap();
    let contact = contact.materials(STEEL, STEEL, PlaneState::Strain);
    let control = Control::Approach { approach: depth, references: TO };
    let solution = contact.solve(control).unwrap();
    let (load, exact) = (solution.load(), solution.stiffness(&TO).unwrap());
    let found = pair.stiffness(REST, upper).unwrap();
    assert!((found[1][1] / exact - 1.0).abs() < 1e-6, "{} {exact}", found[1][1]);
    for (row, column) in [(0, 0), (0, 1), (0, 2), (1, 2), (2, 2), (2, 1)] {
        let off = found[row][column].abs();
        assert!(off < 1e-6 * (exact + load), "{row} {column}: {off:e}");
    }
    // About its lowest point, a turn moves the centre of pressure by -R.
    let rolling = Ellipse::circle(radius, [-1.2, 1.2]).unwrap();
    let mut pair = Pair::new(&Flat, &rolling, (STEEL, STEEL), TO);
    let found = pair.stiffness(REST, pose(0.0, -depth, 0.0)).unwrap();
    let load = contact.solve(control).unwrap().load();
    assert!((found[2][2] / (radius * load) - 1.0).abs() < 1e-6, "{:?}", found[2]);
    // Any body: other differences.
    let body = lopsided();
    let mut pair = Pair::new(&Flat, &*body, (STEEL, STEEL), TO);
    let place = [0.2, -0.03, 0.1];
    let found = pair.stiffness(REST, pose(place[0], place[1], place[2])).unwrap();
    for which in 0..3 {
        let mut at = |step: f64| {
            let mut moved = place;
            moved[which] += step;
            let wrench = pair.at(REST, pose(moved[0], moved[1], moved[2])).unwrap();
            [wrench.force[0], wrench.force[1], wrench.torque[1]]
        };
        let steps = [1e-4, 2e-4].map(|step| {
            let [before, after] = [at(-step), at(step)];
            [0, 1, 2].map(|i| (before[i] - after[i]) / (2.0 * step))
        });
        for row in 0..3 {
            let exact = (4.0 * steps[0][row] - steps[1][row]) / 3.0;
            let off = (found[row][which] - exact).abs();
            assert!(off < 1e-6 * found[1][1], "{row} {which}: {exact} {off:e}");
        }
    }
}

/// An impact of a roller keeps its energy: the force depends on the pose alone.
#[test]
fn an_impact_without_damping_keeps_its_energy() {
    let circle = Ellipse::circle(1.0, [-1.0, 1.0]).unwrap();
    let mut pair = Pair::new(&Flat, &circle, (STEEL, STEEL), TO);
    let mut force = |y: f64| pair.at(REST, pose(0.0, y, 0.0)).unwrap().force[1];
    let (mass, step, speed) = (1.0, 2e-3, 0.02);
    let (mut y, mut v, mut deepest, mut steps) = (1e-3, -speed, 0.0f64, 0);
    while y < 2e-3 {
        // Runge and Kutta's method of fourth order.
        let rate = |y: f64, v: f64, force: &mut dyn FnMut(f64) -> f64| [v, force(y) / mass];
        let one = rate(y, v, &mut force);
        let two = rate(y + 0.5 * step * one[0], v + 0.5 * step * one[1], &mut force);
        let three = rate(y + 0.5 * step * two[0], v + 0.5 * step * two[1], &mut force);
        let four = rate(y + step * three[0], v + step * three[1], &mut force);
        y += step / 6.0 * (one[0] + 2.0 * (two[0] + three[0]) + four[0]);
        v += step / 6.0 * (one[1] + 2.0 * (two[1] + three[1]) + four[1]);
        (deepest, steps) = (deepest.min(y), steps + 1);
    }
    let lost = (v / speed).powi(2) - 1.0;
    println!("{steps} steps, {deepest:.4} deep, energy changed by {lost:.1e}");
    assert!(lost.abs() < 1e-6 && deepest < -0.01, "{lost:e} {deepest}");
}

#[test]
fn joined_bodies_measured_ones_and_layers_move_too() {
    let roof = Piecewise::new(vec![
        graph(-1.0, 0.0, |x| [-0.02 * x, -0.02]),
        graph(0.0, 1.0, |x| [0.01 * x, 0.01]),
    ])
    .unwrap();
    let points: Vec<[f64; 2]> =
        (-100..=100).map(|i| 0.01 * f64::from(i)).map(|x| [x, 0.05 * x * x]).collect();
    let spline = Spline::through(&points).unwrap();
    let layer = Layer { material: Material::elastic(0.2, 0.4), thickness: 0.3, base: Base::Bonded };
    let bodies: [&dyn ParametricProfile<f64>; 2] = [&roof, &spline];
    for body in bodies {
        for lower in [Foundation::from(STEEL), Foundation::from(layer)] {
            let pair = Pair::new(&Flat, body, (lower.clone(), STEEL), TO);
            let mut pair = pair.plane_state(PlaneState::Strain);
            let level = pair.at(REST, pose(0.0, -1e-3, 0.0)).unwrap();
            let contact = Contact::new(&Flat, body).unwrap();
            let contact = contact.materials(lower, STEEL, PlaneState::Strain);
            let control = Control::Approach { approach: 1e-3, references: TO };
            let load = contact.solve(control).unwrap().load();
            assert!((level.force[1] / load - 1.0).abs() < 1e-9, "{} {load}", level.force[1]);
            let turned = pair.at(REST, pose(2.0, -1e-3, 5e-3)).unwrap();
            assert!(turned.force[1] > 0.0 && turned.contacts == 1);
            assert_balanced(&turned, REST, pose(2.0, -1e-3, 5e-3));
        }
    }
}

/// A cam about its middle, near half a turn: what is described of it is its far side, with the
/// material below, and its near side is nowhere.
#[test]
fn a_body_upside_down_is_refused() {
    let cam = Placed::new(
        Ellipse::new(1.0, 0.8, [-1.2, 1.2]).unwrap(),
        Placement::default().shifted(0.0, -0.8),
    )
    .unwrap();
    let joined = Piecewise::new(vec![
        graph(-1.0, 0.0, |x| [0.3 * x * x - 0.8, 0.6 * x]),
        graph(0.0, 1.0, |x| [0.4 * x * x - 0.8, 0.8 * x]),
    ])
    .unwrap();
    // From right to left with k.
    let back = Curve::new([-1.0, 1.0], |k: f64| CurvePoint {
        x: -k,
        y: 0.5 * k * k - 0.8,
        dx: -1.0,
        dy: k,
    });
    let bodies: [&dyn ParametricProfile<f64>; 3] = [&cam, &joined, &back];
    for body in bodies {
        let mut pair = Pair::new(&Flat, body, (STEEL, STEEL), TO);
        for angle in [2.8, std::f64::consts::PI, -3.0] {
            let error = pair.at(REST, pose(0.0, 0.79, angle)).unwrap_err();
            assert!(matches!(error, ContactError::Input(InputError::Pose { .. })), "{error}");
            assert!(error.to_string().contains("not upside down"), "{error}");
        }
        assert_eq!(pair.at(REST, pose(0.0, 0.79, 0.0)).unwrap().contacts, 1);
        // The frame of body 1 counts.
        let (sin, cos) = 3.0f64.sin_cos();
        let turned = pair.at(pose(0.0, 0.0, 3.0), pose(-0.79 * sin, 0.79 * cos, 3.0)).unwrap();
        assert_eq!(turned.contacts, 1);
    }
}

#[test]
fn poses_that_are_none_are_named_and_steep_contacts_are_said() {
    let circle = Ellipse::circle(1.0, [-1.0, 1.0]).unwrap();
    let mut pair = Pair::new(&Flat, &circle, (STEEL, STEEL), TO);
    let wrong = [pose(0.0, -0.1, 1.4), pose(0.0, -0.1, -1.2), pose(f64::NAN, 0.0, 0.0)];
    for upper in wrong {
        let error = pair.at(REST, upper).unwrap_err();
        assert!(matches!(error, ContactError::Input(InputError::Pose { .. })), "{error}");
        assert!(error.to_string().contains("seen from body 1"), "{error}");
    }
    // The number of a pose that is none is named, not what follows from it.
    for (lower, upper, says) in [
        (REST, pose(0.0, f64::INFINITY, 0.0), "the y of a pose is inf"),
        (pose(f64::NAN, 0.0, 0.0), REST, "the x of a pose is NaN"),
        (REST, pose(0.0, 0.0, f64::NEG_INFINITY), "the angle of a pose is -inf"),
    ] {
        let error = pair.at(lower, upper).unwrap_err().to_string();
        assert!(error.ends_with(&format!("{says}: it must be finite")), "{error}");
    }
    let error = pair.at(REST, pose(0.0, f64::NAN, 0.0)).unwrap_err().to_string();
    assert!(error.contains("body 2 is at x = 0, y = NaN, turned by 0: "), "{error}");
    // What goes wrong in a contact is said of the pose: a disc as wide as the contact, bodies that
    // are pressed too deep.
    let small = References { upper: Reference::Disc(0.1), ..TO };
    let mut pinned = Pair::new(&Flat, &circle, (STEEL, STEEL), small);
    let error = pinned.at(pose(7.0, 1.0, 0.0), pose(7.5, 0.9, 0.0)).unwrap_err();
    let says = "seen from body 1, body 2 is at x = 0.5, y = -0.1, turned by 0: a reference at 0.1";
    assert!(error.to_string().starts_with(says), "{error}");
    let error = pair.at(REST, pose(0.5, -1.5, 0.0)).unwrap_err();
    let ContactError::Input(InputError::Pose { y, source, .. }) = error else { panic!("{error}") };
    assert!(
        y == -1.5 && matches!(*source, ContactError::Solve(SolveError::ApproachTooLarge { .. }))
    );
    // After an error it goes on.
    assert!(!pair.at(REST, pose(0.0, -0.01, 0.0)).unwrap().is_steep);
    let flank = graph(-2.0, 2.0, |x| [0.5 * x, 0.5]);
    let mut steep = Pair::new(&*flank, &circle, (STEEL, STEEL), TO);
    let wrench = steep.at(REST, pose(0.0, 0.0, 0.3)).unwrap();
    assert!(wrench.contacts == 1 && wrench.is_steep, "{wrench:?}");
    let mut none = Pair::new(&Flat, &circle, (Material::Rigid, Material::Rigid), TO);
    let error = none.at(REST, pose(0.0, -0.01, 0.0)).unwrap_err();
    let ContactError::Input(InputError::Pose { source, .. }) = error else { panic!("{error}") };
    assert_eq!(*source, ContactError::Input(InputError::BothRigid));
}

/// Bodies that touch first at an end bear nothing, by approach as by load: what is said is that.
#[test]
fn bodies_that_touch_at_an_end_are_told_so() {
    let body = graph(-3.0, 3.0, |x| [(0.3 - 0.05 * x * x) * x * x, (0.6 - 0.2 * x * x) * x]);
    let mut pair = Pair::new(&Flat, &*body, (STEEL, STEEL), TO);
    let error = pair.at(REST, pose(0.01, 1.3, 0.001)).unwrap_err().to_string();
    assert!(error.contains("touch first at their end x = -2.9"), "{error}");
}
