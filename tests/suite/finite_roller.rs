//! Rollers of finite length, compared with closed forms of linear springs side by side, with plane
//! contacts, with the formulas of the standards for bearings, and with Lundberg's roller.
#![allow(missing_docs)]

use crate::common::worst;
use linecontact::profile::{Crowning, Ellipse, Line, Parabola, Placed, Placement, Spline};
use linecontact::{
    Contact, ContactError, Control, Curve, CurvePoint, Edge, EvaluationError, FiniteRoller, Flat,
    InputError, Material, ParametricProfile, Piecewise, PlaneState, Real, Reference, References,
    RollerState, SolveError, SpringTable,
};
use std::f64::consts::PI;

/// Contact modulus of steel on steel, and the plane modulus of one body.
const MODULUS: f64 = 0.5 * PLANE;
const PLANE: f64 = 206e3 / 0.91;

/// Stiffness of a flat punch of half-width 1 on steel, with ℓ = 10: δ = F/(π M) 2 ln(2 ℓ/L), by the
/// mean of the logarithm over a punch.
fn punch_stiffness() -> f64 {
    PI * PLANE / (2.0 * 20f64.ln())
}

fn steel<T: Real>() -> Material<T> {
    Material::elastic(T::of(206e3), T::of(0.3))
}

/// Presses a steel roller of this radius on a large raceway: mm, MPa, N/mm.
fn with_contact<T: Real, R>(
    [radius, length]: [f64; 2],
    work: impl FnOnce(&Contact<'_, T>, &References<T>) -> R,
) -> R {
    let circle = Ellipse::circle(T::of(radius), [-1.0, 1.0].map(T::of)).unwrap();
    let contact = Contact::new(&Flat, &circle).unwrap();
    let contact = contact.materials(steel(), steel(), PlaneState::Strain);
    let (lower, upper) = (Reference::Length(T::of(length)), Reference::Disc(T::of(radius)));
    work(&contact, &References { x: T::zero(), lower, upper })
}

fn table(sizes: [f64; 2], loads: [f64; 2]) -> SpringTable<f64> {
    with_contact(sizes, |contact, to| SpringTable::new(contact, to, loads, 1e-8).unwrap())
}

/// Makes the table of a flat punch, whose load is proportional to the approach.
fn linear() -> SpringTable<f64> {
    let body = Curve::new([-1.0, 1.0], |k| CurvePoint { x: k, y: 0.0, dx: 1.0, dy: 0.0 });
    let contact = Contact::new(&Flat, &body).unwrap().edges(Edge::Fixed(-1.0), Edge::Fixed(1.0));
    let contact = contact.materials(Material::Rigid, steel(), PlaneState::Strain);
    let to = Reference::Length(10.0);
    let to = References { x: 0.0, lower: to, upper: to };
    SpringTable::new(&contact, &to, [1.0, 3000.0], 1e-8).unwrap()
}

fn iso_relief(diameter: f64, length: f64) -> Crowning<f64> {
    Crowning::new(0.00035 * diameter, 0.5 * length, [-0.5 * length, 0.5 * length]).unwrap()
}

/// Returns the largest of the relative differences of load, moment and misalignment.
fn off(state: &RollerState<f64>, [load, moment, misalignment]: [f64; 3]) -> f64 {
    let share = |found: f64, exact: f64| (found / exact - 1.0).abs();
    worst([
        share(state.load, load),
        share(state.moment, moment),
        share(state.misalignment, misalignment),
    ])
}

#[test]
fn aligned_and_without_relief_it_is_the_plane_contact_times_its_length() {
    let table = table([5.0, 10.0], [1.0, 1000.0]);
    for slices in [1, 2, 7, 40, 10_001] {
        let roller = FiniteRoller::new(table.clone(), 10.0, slices, &Flat).unwrap();
        for load in [1.0, 30.0, 555.0, 1000.0] {
            let state = roller.under_load(10.0 * load, 0.0).unwrap();
            let errors = with_contact([5.0, 10.0], |contact, to| {
                let plane = contact.solve(Control::Load(load)).unwrap();
                [
                    state.approach / plane.approach(to).unwrap().bodies - 1.0,
                    state.stiffness[0][0] / (10.0 * plane.stiffness(to).unwrap()) - 1.0,
                    state.largest_pressure().unwrap() / plane.peak().unwrap().pressure - 1.0,
                    state.slices[0].point.half_contact / plane.a() - 1.0,
                    state.load / (10.0 * load) - 1.0,
                    state.moment / state.load,
                    state.stiffness[0][1] / state.stiffness[0][0],
                ]
            });
            let error = worst(errors.map(f64::abs));
            assert!(error < 2e-7, "{slices} slices under {load} N/mm: {error:e}");
            let back = roller.at(state.approach, 0.0).unwrap();
            assert!((back.load / state.load - 1.0).abs() < 1e-14);
        }
    }
}

#[test]
fn linear_springs_side_by_side_have_their_closed_forms() {
    let (table, spring, length, n) = (linear(), punch_stiffness(), 10.0, 4001);
    let cylinder = FiniteRoller::new(table.clone(), length, n, &Flat).unwrap();
    // All of the roller in contact.
    let state = cylinder.at(5e-3, 4e-4).unwrap();
    let second = spring * length.powi(3) / 12.0 * (1.0 - 1.0 / f64::from(n as u32).powi(2));
    let exact = [spring * length * 5e-3, second * 4e-4, 4e-4];
    assert!(off(&state, exact) < 1e-11, "{:e}", off(&state, exact));
    assert!((state.stiffness[0][0] / (spring * length) - 1.0).abs() < 1e-11);
    assert!((state.stiffness[1][1] / second - 1.0).abs() < 1e-11);
    assert_eq!(state.largest_pressure(), None);
    let back = cylinder.under_moment(state.load, state.moment).unwrap();
    assert!((back.approach / 5e-3 - 1.0).abs() < 1e-12);
    assert!((back.misalignment / 4e-4 - 1.0).abs() < 1e-12);

    // A part of it lifted off: a triangle of length c at one end.
    for slope in [2e-3, -3e-3, 0.1] {
        let (at_end, touching) = (8e-3, 8e-3 / f64::abs(slope));
        let load = 0.5 * spring * at_end * touching;
        let moment = slope.signum() * load * (0.5 * length - touching / 3.0);
        let approach = at_end - 0.5 * length * slope.abs();
        let exact = [load, moment, slope];
        // The place of the load determines the misalignment the less, the shorter the contact.
        let width = length / f64::from(n as u32);
        let allowed = (width / touching).powi(2) * length / touching;
        for state in [
            cylinder.at(approach, slope).unwrap(),
            cylinder.under_load(load, slope).unwrap(),
            cylinder.under_moment(load, moment).unwrap(),
        ] {
            let error = off(&state, exact).max((state.approach - approach).abs() / at_end);
            assert!(error < allowed, "{slope}: {error:e} of {allowed:e}");
        }
    }

    // A crown: the misalignment moves the contact along the axis.
    let crown = Parabola::new(1000.0, [-6.0, 6.0]).unwrap();
    let roller = FiniteRoller::new(table, length, n, &crown).unwrap();
    for slope in [0.0, 1.5e-3, -2e-3] {
        let deepest = 4e-3;
        let load = spring * 4.0 / 3.0 * deepest * (2e3 * deepest).sqrt();
        let (moment, approach) = (load * 1e3 * slope, deepest - 500.0 * slope * slope);
        for state in [
            roller.at(approach, slope).unwrap(),
            roller.under_load(load, slope).unwrap(),
            roller.under_moment(load, moment).unwrap(),
        ] {
            let error = worst([
                state.load / load - 1.0,
                (state.moment - moment) / (load * length),
                1e3 * (state.misalignment - slope) / length,
                state.approach / approach - 1.0,
            ]);
            assert!(error.abs() < 2e-6, "{slope}: {error:e}");
        }
    }
}

#[test]
fn a_chamfer_and_a_measured_profile_are_reliefs() {
    let (table, spring) = (linear(), punch_stiffness());
    // Over the last millimetre of either end 20 µm.
    let part = |slope: f64, height: f64, domain| {
        let to = Placement::default().shifted(0.0, height);
        Placed::new(Line::new(slope, domain).unwrap(), to).unwrap()
    };
    let chamfered = Piecewise::new(vec![
        part(-0.02, -0.08, [-5.0, -4.0]),
        part(0.0, 0.0, [-4.0, 4.0]),
        part(0.02, -0.08, [4.0, 5.0]),
    ])
    .unwrap();
    let roller = FiniteRoller::new(table.clone(), 10.0, 5000, &chamfered).unwrap();
    let load = spring * (8.0 * 7e-3 + 7e-3f64.powi(2) / 0.02);
    let error = roller.at(7e-3, 0.0).unwrap().load / load - 1.0;
    assert!(error.abs() < 1e-6, "{error:e}");

    let points: Vec<[f64; 2]> =
        (-60..=60).map(|i| 0.1 * f64::from(i)).map(|z| [z, z * z / 2e3]).collect();
    let measured = Spline::through(&points).unwrap();
    let crown = Parabola::new(1000.0, [-6.0, 6.0]).unwrap();
    let [measured, crown] = [&measured as &dyn ParametricProfile<f64>, &crown].map(|relief| {
        let roller = FiniteRoller::new(table.clone(), 10.0, 40, relief).unwrap();
        roller.under_load(1000.0, 1e-3).unwrap()
    });
    assert!((measured.moment / crown.moment - 1.0).abs() < 1e-10);
}

#[test]
fn a_mirrored_roller_has_the_mirrored_moment() {
    let table = table([5.0, 10.0], [0.1, 2000.0]);
    let lopsided = |side: f64| {
        Curve::new([-6.0, 6.0], move |z: f64| {
            let z3 = side * z.powi(3);
            let (y, dy) = (z * z / 4e3 + z3 / 2e4, z / 2e3 + 3.0 * side * z * z / 2e4);
            CurvePoint { x: z, y, dx: 1.0, dy }
        })
    };
    let [one, other] = [1.0, -1.0]
        .map(|side| FiniteRoller::new(table.clone(), 10.0, 41, &lopsided(side)).unwrap());
    for misalignment in [0.0, 3e-4, -2e-3] {
        let state = one.at(0.01, misalignment).unwrap();
        let mirrored = other.at(0.01, -misalignment).unwrap();
        assert!(state.moment.abs() > 0.01 * state.load);
        assert!((mirrored.load / state.load - 1.0).abs() < 1e-14);
        assert!((mirrored.moment / state.moment + 1.0).abs() < 1e-13);
        assert!((mirrored.stiffness[0][1] / state.stiffness[0][1] + 1.0).abs() < 1e-12);
        for (slice, opposite) in state.slices.iter().zip(mirrored.slices.iter().rev()) {
            assert_eq!(slice.z, -opposite.z);
            let difference = slice.point.load - opposite.point.load;
            assert!(difference.abs() < 1e-12 * state.load);
        }
    }
}

#[test]
fn the_stiffness_is_that_of_finite_differences() {
    let table = table([5.0, 10.0], [0.01, 3000.0]);
    let roller = FiniteRoller::new(table, 10.0, 40, &iso_relief(10.0, 10.0)).unwrap();
    for [approach, misalignment] in [[0.01, 0.0], [0.01, 1e-3], [0.004, -3e-3], [0.02, 5e-4]] {
        let state = roller.at(approach, misalignment).unwrap();
        let by = |step: [f64; 2]| {
            let [above, below] = [1.0, -1.0].map(|sign| {
                roller.at(approach + sign * step[0], misalignment + sign * step[1]).unwrap()
            });
            let step = 2.0 * (step[0] + step[1]);
            [(above.load - below.load) / step, (above.moment - below.moment) / step]
        };
        let (by_approach, by_misalignment) = (by([1e-7, 0.0]), by([0.0, 2e-8]));
        let [[direct, coupling], [other, tilting]] = state.stiffness;
        let size = (direct * tilting).sqrt();
        let errors = [
            by_approach[0] / direct - 1.0,
            by_misalignment[1] / tilting - 1.0,
            (by_approach[1] - coupling) / size,
            (by_misalignment[0] - other) / size,
        ];
        let error = worst(errors.map(f64::abs));
        assert!(error < 1e-6, "{approach} {misalignment}: {error:e}");
        assert_eq!(coupling, other);
    }
}

#[test]
fn the_error_falls_as_the_square_of_the_number_of_slices() {
    let (table, spring) = (linear(), punch_stiffness());
    let crown = Parabola::new(5000.0, [-6.0, 6.0]).unwrap();
    // F = K (δ l - l³/(24 R)), with all of the crown in contact.
    let load = spring * (0.01 * 10.0 - 1e3 / (24.0 * 5e3));
    let errors = [10, 20, 40, 80].map(|slices| {
        let roller = FiniteRoller::new(table.clone(), 10.0, slices, &crown).unwrap();
        roller.at(0.01, 0.0).unwrap().load / load - 1.0
    });
    for pair in errors.windows(2) {
        assert!((pair[0] / pair[1] - 4.0).abs() < 1e-5, "{errors:?}");
    }
}

/// Deviations from the laws of the bearing standards are within 4 % for rollers of 0.5 to 2
/// diameters in length and pressures of 500 to 3000 MPa, as the documentation says.
#[test]
fn the_approach_is_that_of_iso_16281_and_of_palmgren_within_four_percent() {
    let (mut iso, mut palmgren) = (Vec::new(), Vec::new());
    for (radius, ratio) in [(3.0, 0.5), (5.0, 1.0), (5.0, 2.0), (10.0, 0.5), (20.0, 1.0)] {
        let length = 2.0 * radius * ratio;
        let loads =
            [500.0f64, 1000.0, 2000.0, 3000.0].map(|peak| PI * radius * peak * peak / MODULUS);
        let table = table([radius, length], [loads[0], loads[3]]);
        let roller = FiniteRoller::new(table, length, 30, &Flat).unwrap();
        for load in loads.map(|load| load * length) {
            let approach = roller.under_load(load, 0.0).unwrap().approach;
            // With both raceways.
            let by_iso = 35_948.0 * length.powf(8.0 / 9.0) * (2.0 * approach).powf(10.0 / 9.0);
            iso.push((by_iso / load - 1.0).abs());
            let by_palmgren = 3.84e-5 * load.powf(0.9) / length.powf(0.8);
            palmgren.push((approach / by_palmgren - 1.0).abs());
        }
    }
    let (iso, palmgren) = (worst(iso), worst(palmgren));
    println!("off ISO/TS 16281 by {iso:.3}, off Palmgren by {palmgren:.3}");
    assert!(iso < 0.04 && palmgren < 0.04, "{iso} {palmgren}");
}

/// Returns the depth to which a line load sinks at its middle, at a small distance.
fn sunk_middle(load: f64, length: f64) -> f64 {
    load / (PI * MODULUS) * 2.0 * (0.5 * length / 1e-5).asinh()
}

/// On the half-space Lundberg's roller bears the same load in all slices: the difference is the
/// coupling that the model leaves out, as large as the documentation says.
#[test]
fn without_coupling_lundbergs_roller_is_loaded_in_its_middle() {
    for (length, expected) in [(5.0, [0.09, -0.15]), (10.0, [0.08, -0.14]), (20.0, [0.07, -0.13])] {
        let even = PI * MODULUS * 0.0035;
        let table = table([5.0, length], [0.1, 3000.0]);
        let roller = FiniteRoller::new(table, length, 410, &iso_relief(10.0, length)).unwrap();
        let state = roller.under_load(even * length, 0.0).unwrap();
        let [middle, near_end] = [205, 389].map(|i| state.slices[i].point.load / even - 1.0);
        let pressure = (even * MODULUS / (PI * 5.0)).sqrt();
        let higher = state.largest_pressure().unwrap() / pressure - 1.0;
        // The roller sinks evenly by the half-space under a line of this load.
        let sunk = [0, 50, 205, 389].map(|i: usize| {
            let z = state.slices[i].z;
            let arms = [0.5 * length + z, 0.5 * length - z];
            let line: f64 = arms.iter().map(|arm| (arm / 1e-5).asinh()).sum();
            even / (PI * MODULUS) * line - 0.0035 * (1.0 - (2.0 * z / length).powi(2)).ln()
        });
        assert!(sunk.iter().all(|sunk| (sunk / sunk_middle(even, length) - 1.0).abs() < 1e-5));
        println!("{length}: {middle:.3} {near_end:.3} {pressure:.0} MPa, {higher:.3}");
        assert!((state.slices[389].z / (0.5 * length) - 0.9).abs() < 1e-12);
        assert!((middle - expected[0]).abs() < 6e-3 && (near_end - expected[1]).abs() < 6e-3);
        assert!((higher - 0.04).abs() < 5e-3 && (pressure / 3000.0 - 1.0).abs() < 2e-3);
    }
}

#[test]
fn below_the_table_the_error_is_as_stated() {
    let roller = |least| {
        let table = table([5.0, 10.0], [least, 3000.0]);
        FiniteRoller::new(table, 10.0, 400, &iso_relief(10.0, 10.0)).unwrap()
    };
    let exact = roller(1e-6);
    for least in [0.1, 10.0, 100.0] {
        for misalignment in [0.0, 1e-3, 4e-3] {
            let [state, exact] =
                [&roller(least), &exact].map(|r| r.at(0.01, misalignment).unwrap());
            let error = (state.load / exact.load - 1.0).abs();
            println!("{least} {misalignment}: {error:.1e} of {:.1e}", state.error);
            assert!(error <= state.error + 1e-7);
            // Slices next to those that have lifted off are there in any case.
            assert!(state.error > 2e-8 || least < 1.0, "{}", state.error);
        }
    }
}

#[test]
fn with_the_relief_of_iso_16281_the_slices_leave_the_error_that_is_stated() {
    let table = table([5.0, 10.0], [0.01, 2000.0]);
    let [few, more, exact] = [41, 101, 8001].map(|slices| {
        let roller = FiniteRoller::new(table.clone(), 10.0, slices, &iso_relief(10.0, 10.0));
        roller.unwrap().under_load(5e3, 1e-3).unwrap().moment
    });
    let errors = [few, more].map(|moment| moment / exact - 1.0);
    println!("{errors:?}");
    assert!((errors[0] - 0.02).abs() < 2e-3 && (errors[1] - 0.005).abs() < 1e-3, "{errors:?}");
}

#[test]
fn a_steep_misalignment_loads_the_last_slice() {
    let roller = FiniteRoller::new(table([5.0, 10.0], [1.0, 1000.0]), 10.0, 10, &Flat).unwrap();
    for misalignment in [1.0, 1e6, 1e12, -1e12] {
        let state = roller.under_load(300.0, misalignment).unwrap();
        assert!((state.load / 300.0 - 1.0).abs() < 1e-12, "{misalignment}");
        assert!((state.moment / (300.0 * 4.5) - misalignment.signum()).abs() < 1e-12);
    }
}

#[test]
fn in_single_precision_it_is_the_same() {
    let in_f32 = with_contact([5.0, 10.0], |contact, to| {
        let table = SpringTable::<f32>::new(contact, to, [1.0, 2000.0], 1e-4).unwrap();
        let relief = Crowning::new(0.0035, 5.0, [-5.0, 5.0]).unwrap();
        FiniteRoller::new(table, 10.0, 40, &relief).unwrap().under_moment(5e3, 3e3).unwrap()
    });
    let table = table([5.0, 10.0], [1.0, 2000.0]);
    let roller = FiniteRoller::new(table, 10.0, 40, &iso_relief(10.0, 10.0)).unwrap();
    let state = roller.under_moment(5e3, 3e3).unwrap();
    assert!((f64::from(in_f32.approach) / state.approach - 1.0).abs() < 3e-4);
    assert!((f64::from(in_f32.misalignment) / state.misalignment - 1.0).abs() < 3e-4);
}

#[test]
fn rollers_that_cannot_be_made_are_refused() {
    let table = table([5.0, 10.0], [1.0, 100.0]);
    let made = |length, slices, relief: &dyn ParametricProfile<f64>| {
        FiniteRoller::new(table.clone(), length, slices, relief).unwrap_err()
    };
    for (length, slices) in [
        (0.0, 30),
        (-1.0, 30),
        (f64::NAN, 30),
        (f64::INFINITY, 30),
        (f64::MIN_POSITIVE * f64::EPSILON, 30),
        (10.0, 0),
        (10.0, usize::MAX),
    ] {
        assert!(
            matches!(
                made(length, slices, &Flat),
                ContactError::Input(InputError::InvalidRoller { .. })
            ),
            "{length} {slices}"
        );
    }
    // A crown upside down is refused, a hollow whose ends recede nowhere near is none of it.
    let crown = Parabola::new(-1e3, [-5.0, 5.0]).unwrap();
    let ContactError::Input(InputError::InvalidRelief { z, height }) = made(10.0, 5, &crown) else {
        panic!("a relief of the wrong sign")
    };
    assert_eq!((z, height), (-4.0, -8e-3));
    let hollow = Placed::new(crown, Placement::default().shifted(0.0, 5e-3)).unwrap();
    assert!(FiniteRoller::new(table.clone(), 10.0, 5, &hollow).is_ok());
    let short = Parabola::new(1e3, [-4.0, 4.0]).unwrap();
    let error = made(10.0, 30, &short);
    let says = "the relief of the roller: the z of a slice is -4.83333: it must be where the relief is known";
    assert!(error.to_string().starts_with(says), "{error}");
    let of = |height: fn(f64) -> f64| {
        Curve::new([-5.0, 5.0], move |z: f64| CurvePoint { x: z, y: height(z), dx: 1.0, dy: 0.0 })
    };
    for height in [|_| f64::NAN, |_| f64::INFINITY, |z: f64| if z > 2.0 { f64::NAN } else { 0.0 }] {
        let error = made(10.0, 30, &of(height));
        let says = error.to_string();
        assert!(matches!(error, ContactError::Input(InputError::Relief { .. })), "{error}");
        assert!(
            says.starts_with("the relief of the roller: Y") && !says.contains("body"),
            "{says}"
        );
    }
}

#[test]
fn apart_a_roller_bears_nothing() {
    let roller = FiniteRoller::new(table([5.0, 10.0], [1.0, 1000.0]), 10.0, 40, &Flat).unwrap();
    for misalignment in [0.0, 1e-3] {
        let lowest = -misalignment * 4.875;
        let touching = roller.under_load(0.0, misalignment).unwrap();
        assert!((touching.approach - lowest).abs() < 1e-15);
        for state in [touching, roller.at(lowest - 0.2, misalignment).unwrap()] {
            assert_eq!([state.load, state.moment], [0.0; 2]);
            assert!(state.error < 1e-7);
            assert_eq!((state.stiffness, state.largest_pressure()), ([[0.0; 2]; 2], Some(0.0)));
            assert!(state.slices.iter().all(|slice| slice.point.load == 0.0));
        }
        // The first slices that touch bear little.
        let little = roller.at(lowest + 1e-7, misalignment).unwrap();
        assert!(little.load > 0.0 && little.load < 0.1, "{}", little.load);
        let back = roller.under_load(little.load, misalignment).unwrap();
        assert!((back.approach - little.approach).abs() < 1e-15);
    }
    assert_eq!(roller.under_moment(0.0, 0.0).unwrap(), roller.under_load(0.0, 0.0).unwrap());
    let error = roller.under_moment(0.0, 1.0).unwrap_err();
    assert!(error.to_string().ends_with("zero without a moment"), "{error}");
}

#[test]
fn loads_that_no_table_covers_are_refused() {
    let table = table([5.0, 10.0], [1.0, 1000.0]);
    let roller = |slices, relief: &dyn ParametricProfile<f64>| {
        FiniteRoller::new(table.clone(), 10.0, slices, relief).unwrap()
    };
    let (cylinder, one) = (roller(40, &Flat), roller(1, &Flat));
    let outside = |result: Result<RollerState<f64>, _>, end: f64| {
        let error = result.unwrap_err();
        let ContactError::Evaluation(EvaluationError::SliceOutsideTable { z, .. }) = error else {
            panic!("{error}");
        };
        assert_eq!(z, end, "{error}");
    };
    // Too far, at one end, and under loads per unit length out of the table.
    for approach in [1.0, f64::INFINITY, f64::NAN] {
        outside(cylinder.at(approach, 0.0), -4.875);
    }
    let endless = cylinder.at(f64::NAN, 0.0).unwrap_err().to_string();
    assert!(endless.ends_with("must be finite"), "{endless}");
    outside(cylinder.at(0.01, 1e-2), 4.875);
    outside(cylinder.at(0.01, -1e-2), -4.875);
    outside(cylinder.under_load(5e3, 1.0), 4.875);
    outside(cylinder.under_load(1e300, 0.0), -4.875);
    outside(cylinder.under_moment(5e3, 2e4), 4.875);
    for value in [f64::NAN, f64::INFINITY, 1e308] {
        for result in [cylinder.at(0.01, value), cylinder.under_load(5e3, value)] {
            let error = result.unwrap_err();
            assert!(
                matches!(error, ContactError::Input(InputError::InvalidMoment { .. })),
                "{error}"
            );
        }
    }
    for load in [-5.0, f64::NAN, f64::INFINITY] {
        for result in [cylinder.under_load(load, 0.0), cylinder.under_moment(load, 0.0)] {
            let error = result.unwrap_err();
            assert!(
                matches!(error, ContactError::Input(InputError::InvalidLoad { .. })),
                "{error}"
            );
        }
    }
    let error = cylinder.under_moment(5e3, f64::NAN).unwrap_err();
    assert!(matches!(error, ContactError::Input(InputError::InvalidMoment { .. })), "{error}");
    for moment in [25e3, -25e3, 1e308] {
        let error = cylinder.under_moment(5e3, moment).unwrap_err();
        assert!(
            matches!(error, ContactError::Solve(SolveError::LoadBeyondSlices { .. })),
            "{error}"
        );
    }
    // One slice bears all of the load: at the end, as there is no other, or as no other reaches.
    let crown = Parabola::new(1e-3, [-6.0, 6.0]).unwrap();
    for (roller, moment) in [(&cylinder, 5e3 * 4.875), (&one, 0.0), (&roller(3, &crown), 0.0)] {
        let error = roller.under_moment(5e3, moment).unwrap_err();
        assert!(matches!(error, ContactError::Solve(SolveError::OneSlice { .. })), "{error}");
    }
    let steep = Line::new(3e307, [-5.0, 5.0]).unwrap();
    let error = roller(40, &steep).under_moment(100.0, 0.0).unwrap_err();
    assert!(matches!(error, ContactError::Solve(SolveError::RollerNotFound { .. })), "{error}");
}
