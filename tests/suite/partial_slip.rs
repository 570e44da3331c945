//! Partial slip: against Cattaneo and Mindlin, Nowell and Hills, closed forms of other punches, and
//! the equation of the stick zone, with the test's own integrals.
#![allow(missing_docs)]

use crate::common::{Profile, graph, quartic, worst};
use crate::integrals::{integral, principal, strength};
use linecontact::profile::{Ellipse, Parabola};
use linecontact::reference::{ClosedForm, RoundedPunch, body};
use linecontact::{
    Body, Contact, ContactError, Control, Edge, Flat, InputError, Material, PartialSlip,
    PlaneState, Shear, SolveError, Solver,
};
use std::f64::consts::PI;

const FRICTION: f64 = 0.4;

fn shear(force: f64, tension: f64) -> Shear<f64> {
    Shear { friction: FRICTION, force, tension }
}

#[test]
fn hertz_sticks_as_cattaneo_and_mindlin_say() {
    let body = Parabola::new(1.0, [-1.0, 1.0]).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap().contact_modulus(1.0);
    let load = 0.1;
    for share in [1e-6, 0.01, 0.5, 0.9, 0.999, 0.999_999] {
        for sign in [1.0, -1.0] {
            let force = sign * share * FRICTION * load;
            let slip = contact.partial_slip(Control::Load(load), shear(force, 0.0)).unwrap();
            let (a, stick) = (slip.normal().a(), slip.stick_zones()[0]);
            let c = a * (1.0 - share).sqrt();
            assert!((stick.right / c - 1.0).abs() < 1e-13 && (stick.left / c + 1.0).abs() < 1e-13);
            let largest = slip.normal().peak().unwrap().pressure;
            let traction = slip.traction().unwrap();
            for i in 1..40 {
                let x = a * (-1.0 + f64::from(i) / 20.0);
                let root = |r: f64| (1.0 - (x / r).powi(2)).max(0.0).sqrt();
                let exact = sign * FRICTION * largest * (root(a) - c / a * root(c));
                let found = traction.at(x).unwrap();
                assert!((found - exact).abs() < 1e-14 * largest, "{share} {x}: {found} {exact}");
                let mut many = [0.0];
                traction.at_many(&[x], &mut many).unwrap();
                assert_eq!(many[0], found);
            }
            assert_eq!(traction.at(1.1 * a).unwrap(), 0.0);
        }
    }
}

#[test]
fn tension_moves_the_stick_zone_as_nowell_and_hills_say() {
    let body = Parabola::new(1.0, [-1.0, 1.0]).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap().contact_modulus(1.0);
    let mut errors = Vec::new();
    for (force, tension) in [(0.02, 0.02), (0.02, -0.05), (-0.02, 0.02), (0.035, 0.001)] {
        let slip = contact.partial_slip(Control::Load(0.1), shear(force, tension)).unwrap();
        let (a, stick) = (slip.normal().a(), slip.stick_zones()[0]);
        let largest = slip.normal().peak().unwrap().pressure;
        let shift = tension * a / (4.0 * FRICTION * largest) * force.signum();
        let c = a * (1.0 - force.abs() / (FRICTION * 0.1)).sqrt();
        errors.push((stick.centre() - shift) / a);
        errors.push((stick.half_width() - c) / a);
    }
    assert!(worst(errors.into_iter().map(f64::abs)) < 1e-14);
}

/// Ciavarella, Hills and Monno (1998): the stick zone of a rounded punch is its contact under a
/// smaller load.
#[test]
fn a_rounded_punch_sticks_where_a_smaller_load_would_hold_it() {
    let (flat, radius, kappa) = (1.0, 3.0, 0.7);
    let form = |half_width| RoundedPunch::new(flat, radius, half_width).unwrap();
    let (all, sticks) = (form(1.4), form(1.1));
    let profile = body(&all, -3.0, 3.0).unwrap();
    let contact = Contact::new(&Flat, &profile).unwrap().kappa(kappa);
    let [load, less] = [all.load(kappa), sticks.load(kappa)];
    let slip =
        contact.partial_slip(Control::Load(load), shear(FRICTION * (load - less), 0.0)).unwrap();
    assert!((slip.stick_zones()[0].right / 1.1 - 1.0).abs() < 1e-13);
    let traction = slip.traction().unwrap();
    for x in [0.0, 0.5, 0.99, 1.05, 1.2, 1.39] {
        let exact = FRICTION
            * (all.pressure(x, kappa) - if x < 1.1 { sticks.pressure(x, kappa) } else { 0.0 });
        let found = traction.at(x).unwrap();
        assert!((found / exact - 1.0).abs() < 1e-11, "{x}: {found} {exact}");
    }
}

/// Returns the largest error in the equation of the stick zone, the law of friction and the balance
/// of forces.
fn check(slip: &PartialSlip<f64>, breakpoints: &[f64]) -> f64 {
    let Shear { friction, force, tension } = slip.shear();
    let (pressure, traction) = (slip.normal().pressure().unwrap(), slip.traction().unwrap());
    let at = |x: f64| traction.at(x).unwrap_or(0.0);
    let sticks: Vec<_> = slip.stick_zones().iter().flat_map(|on| [on.left, on.right]).collect();
    let kinks = [breakpoints, &sticks].concat();
    let contacts = slip.normal().intervals();
    let mut errors = Vec::new();
    let all: f64 = contacts.iter().map(|on| integral(*on, &kinks, strength(*on, at))).sum();
    errors.push((all - force) / (friction * slip.normal().load()));
    let mean = slip.normal().mean_pressure();
    for on in contacts {
        for i in 1..30 {
            let x = on.at_angle(PI * f64::from(i) / 30.0);
            let stuck = slip.stick_zones().iter().any(|zone| zone.contains(x));
            let allowed = friction * pressure.at(x).unwrap();
            let q = at(x);
            assert!(q.abs() <= allowed * (1.0 + 1e-12), "{x}: {q} {allowed}");
            if !stuck {
                errors.push((q.abs() - allowed) / mean);
                assert!(q * force > 0.0);
            }
        }
    }
    // The stick zone is not stretched: with both tractions, PV∫ q/(x - s) ds = πσ/4.
    for zone in slip.stick_zones() {
        for i in 1..8 {
            let x = zone.at_angle(PI * f64::from(i) / 8.0);
            let sum: f64 = contacts
                .iter()
                .map(|on| {
                    if on.contains(x) {
                        principal(*on, &kinks, x, at)
                    } else {
                        integral(*on, &kinks, strength(*on, |s| at(s) / (x - s)))
                    }
                })
                .sum();
            errors.push((sum - PI * tension / 4.0) / mean);
        }
    }
    worst(errors.into_iter().map(f64::abs))
}

#[test]
fn what_sticks_is_not_stretched_and_what_slips_obeys_friction() {
    let circle: Profile = Box::new(Ellipse::circle(1.0, [-1.5, 1.5]).unwrap());
    let lopsided = graph(-1.5, 1.5, |x| [x * x / 2.0 + x.powi(3) / 6.0, x + x * x / 2.0]);
    let quartic = quartic(-2.5, 2.5);
    let free = [Edge::Free; 2];
    let until = [Edge::FreeUntil(-0.2), Edge::FreeUntil(0.3)];
    let mut largest = 0.0f64;
    for (name, body, [left, right], load) in [
        ("circle", &circle, free, 0.3),
        ("lopsided", &lopsided, free, 0.2),
        ("until a corner", &circle, until, 0.05),
        ("two contacts", &quartic, free, 0.5),
        ("two that are one", &quartic, free, 4.0),
    ] {
        let contact = Contact::new(&Flat, &**body).unwrap().edges(left, right).contact_modulus(1.0);
        for (share, tension) in [(0.3, 0.0), (-0.6, 0.0), (0.5, 0.02), (0.5, -0.02), (-0.4, 0.03)] {
            let force = share * FRICTION * load;
            let slip = contact.partial_slip(Control::Load(load), shear(force, tension)).unwrap();
            let error = check(&slip, &[]);
            println!("{name}: {share} {tension} {} {error:.1e}", slip.stick_zones().len());
            largest = largest.max(error);
        }
    }
    assert!(largest < 1e-9, "{largest:e}");
}

/// The stick zone is the contact under a smaller load: two zones in one contact.
#[test]
fn one_contact_may_stick_in_two_places() {
    let body = quartic(-2.5, 2.5);
    let contact = Contact::new(&Flat, &*body).unwrap().contact_modulus(1.0);
    let load = 4.0;
    let force = 0.9 * FRICTION * load;
    let slip = contact.partial_slip(Control::Load(load), shear(force, 0.0)).unwrap();
    assert_eq!((slip.normal().intervals().len(), slip.stick_zones().len()), (1, 2));
    let alone = contact.solve(Control::Load(0.1 * load)).unwrap();
    for (zone, contact) in slip.stick_zones().iter().zip(alone.intervals()) {
        assert!((zone.left - contact.left).abs() < 1e-13);
        assert!((zone.right - contact.right).abs() < 1e-13);
    }
}

#[test]
fn it_costs_no_evaluation() {
    let body = Ellipse::circle(1.0, [-1.5, 1.5]).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap().contact_modulus(1.0);
    let mut solver = Solver::new();
    let slip = solver.partial_slip(&contact, Control::Load(0.3), shear(0.05, 0.0)).unwrap();
    let normal = contact.solve(Control::Load(0.3)).unwrap();
    assert_eq!(slip.normal().cost(), normal.cost());
    // From the stick zone back to the whole contact.
    let again = solver.partial_slip(&contact, Control::Load(0.3), shear(0.05, 0.01)).unwrap();
    assert_eq!(again.normal().cost().evaluations, 0);
    assert!((again.normal().a() / slip.normal().a() - 1.0).abs() < 1e-14);
}

#[test]
fn stress_below_is_that_of_pressure_and_traction() {
    let body = graph(-1.5, 1.5, |x| [x * x / 2.0 + x.powi(3) / 6.0, x + x * x / 2.0]);
    let contact = Contact::new(&Flat, &*body).unwrap().contact_modulus(1.0);
    let slip = contact.partial_slip(Control::Load(0.2), shear(-0.03, 0.02)).unwrap();
    let (on, zone) = (slip.normal().hull(), slip.stick_zones()[0]);
    let (pressure, traction) = (slip.normal().pressure().unwrap(), slip.traction().unwrap());
    let mean = slip.normal().mean_pressure();
    let mut errors = Vec::new();
    for (body, sign) in [(Body::Lower, 1.0), (Body::Upper, -1.0)] {
        let below = slip.subsurface(body).unwrap();
        for (x, y) in [(0.0, 0.2), (0.3, 0.5), (-0.6, 0.1), (1.2, 0.3)] {
            // Johnson, Eqs. 2.23.
            let sum = |of: &dyn Fn(f64, f64, f64) -> f64| {
                let density = |s: f64| {
                    let (p, q) =
                        (pressure.at(s).unwrap_or(0.0), sign * traction.at(s).unwrap_or(0.0));
                    let square = (x - s).powi(2) + y * y;
                    -2.0 / PI * of(p, q, x - s) / square.powi(2)
                };
                integral(on, &[zone.left, zone.right, x], strength(on, density))
            };
            let found = below.at(x, y).unwrap();
            errors.push(found.sigma_x - sum(&|p, q, d| p * y * d * d + q * d.powi(3)));
            errors.push(found.sigma_y - sum(&|p, q, d| p * y.powi(3) + q * y * y * d));
            errors.push(found.tau_xy - sum(&|p, q, d| p * y * y * d + q * y * d * d));
        }
        // On the surface the stress is pressure and traction.
        for x in [0.0, 0.5 * (on.right + zone.right), 1.2] {
            let found = below.at(x, 0.0).unwrap();
            errors.push(found.sigma_y + pressure.at(x).unwrap());
            errors.push(found.tau_xy + sign * traction.at(x).unwrap());
        }
        // In the stick zone σ_x of each body differs from -P by half of the tension.
        let found = below.at(zone.centre(), 0.0).unwrap();
        errors.push(found.sigma_x + pressure.at(zone.centre()).unwrap() + sign * 0.5 * 0.02);
    }
    let largest = worst(errors.into_iter().map(f64::abs)) / mean;
    println!("{largest:.1e} of the mean pressure");
    assert!(largest < 1e-11);
}

#[test]
fn what_does_not_slip_in_part_is_refused() {
    let body = Parabola::new(1.0, [-1.0, 1.0]).unwrap();
    let scene = Contact::new(&Flat, &body).unwrap();
    let contact = scene.clone().contact_modulus(1.0);
    let load = Control::Load(0.1);
    let error = |shear| contact.partial_slip(load, shear).map(|_| ()).unwrap_err();
    for friction in [0.0, -0.3, f64::NAN, f64::INFINITY] {
        let error = error(Shear { friction, force: 0.01, tension: 0.0 });
        assert!(
            matches!(error, ContactError::Input(InputError::InvalidSlipFriction { .. })),
            "{error}"
        );
    }
    for wrong in [f64::NAN, f64::INFINITY] {
        assert!(matches!(
            error(shear(wrong, 0.0)),
            ContactError::Input(InputError::InvalidShear { quantity: "force", .. })
        ));
        assert!(matches!(
            error(shear(0.01, wrong)),
            ContactError::Input(InputError::InvalidShear { quantity: "tension", .. })
        ));
    }
    for force in [0.041, -0.0401, 1e9] {
        let error = error(shear(force, 0.0));
        assert!(
            matches!(error, ContactError::Solve(SolveError::SlipsEverywhere { .. })),
            "{force}: {error}"
        );
    }
    // The difference would have no digits left.
    for force in [1e-14, -1e-300] {
        let error = error(shear(force, 0.0));
        assert!(
            matches!(error, ContactError::Solve(SolveError::SticksEverywhere { .. })),
            "{force}: {error}"
        );
    }
    // With the tension alone, or with too much of it, slip has to reverse.
    for (force, tension) in [(0.0, 0.02), (0.01, 0.2), (-0.01, -0.2)] {
        let error = error(shear(force, tension));
        assert!(
            matches!(error, ContactError::Solve(SolveError::ReversedSlip { .. })),
            "{force} {tension}: {error}"
        );
    }
    // Off the bodies altogether.
    let error = error(shear(0.01, 1e3));
    assert!(matches!(error, ContactError::Input(InputError::SlipNotSupported { .. })), "{error}");
    let materials = |lower, upper| {
        let contact = scene.clone().materials(lower, upper, PlaneState::Strain);
        contact.partial_slip(load, shear(0.01, 0.0)).map(|_| ())
    };
    let (steel, soft) = (Material::elastic(2.1, 0.3), Material::elastic(1.0, 0.3));
    let rubber = Material::elastic(1.0, 0.5);
    assert!(materials(steel, steel).is_ok());
    assert!(materials(Material::Rigid, rubber).is_ok());
    match materials(steel, soft) {
        // 1/2 ((1 - 2ν₁)/G₁ - (1 - 2ν₂)/G₂)/((1 - ν₁)/G₁ + (1 - ν₂)/G₂)
        Err(ContactError::Input(InputError::UnlikeBodies { beta })) => {
            let shear = [2.1 / 2.6, 1.0 / 2.6];
            let exact =
                0.5 * 0.4 * (1.0 / shear[0] - 1.0 / shear[1]) / (0.7 / shear[0] + 0.7 / shear[1]);
            assert!((beta / exact - 1.0).abs() < 1e-14);
        }
        other => panic!("{other:?}"),
    }
    let adhesive = contact.clone().edges(Edge::Adhesive(0.01), Edge::Adhesive(0.01));
    let error = adhesive.partial_slip(load, shear(0.01, 0.0)).map(|_| ()).unwrap_err();
    assert!(matches!(error, ContactError::Input(InputError::SlipNotSupported { .. })), "{error}");
}
