//! Tables of load against approach, compared with solves between their points.
#![allow(missing_docs)]

use crate::common::{Profile, quartic, worst};
use linecontact::profile::{Ellipse, Parabola};
use linecontact::{
    Contact, ContactError, Control, Edge, EvaluationError, Flat, InputError, Material, PlaneState,
    Reference, References, SolveError, SpringTable,
};

const STEEL: Material<f64> = Material::Elastic { youngs_modulus: 2.1, poisson_ratio: 0.3 };

const REFERENCES: References<f64> =
    References { x: 0.0, lower: Reference::Depth(3.0), upper: Reference::Disc(4.0) };

fn steel(contact: Contact<'_, f64>) -> Contact<'_, f64> {
    contact.materials(STEEL, STEEL, PlaneState::Strain)
}

/// Returns the largest errors of load, half-width and peak, and of the stiffness, among loads
/// between the points.
fn errors(contact: &Contact<f64>, table: &SpringTable<f64>, loads: [f64; 2]) -> [f64; 2] {
    let [mut values, mut stiffness] = [Vec::new(), Vec::new()];
    for i in 0..=200 {
        let load = loads[0] * (loads[1] / loads[0]).powf(f64::from(i) / 200.0);
        let solution = contact.solve(Control::Load(load)).unwrap();
        let approach = solution.approach(&REFERENCES).unwrap().bodies;
        let range = [0, table.points().len() - 1].map(|i| table.points().nth(i).unwrap().approach);
        let spring = table.at(approach.clamp(range[0], range[1])).unwrap();
        let half_width: f64 = solution.intervals().iter().map(|on| on.half_width()).sum();
        values.extend([spring.load / load - 1.0, spring.half_contact / half_width - 1.0]);
        if let Some(peak) = spring.peak {
            values.push(peak / solution.peak().unwrap().pressure - 1.0);
        }
        stiffness.push(spring.stiffness / solution.stiffness(&REFERENCES).unwrap() - 1.0);
    }
    [values, stiffness].map(|errors| worst(errors.into_iter().map(f64::abs)))
}

#[test]
fn between_its_points_a_table_is_as_good_as_it_says() {
    let circle: Profile = Box::new(Ellipse::circle(1.0, [-1.5, 1.5]).unwrap());
    let quartic = quartic(-2.5, 2.5);
    let free = [Edge::Free; 2];
    let until = [Edge::FreeUntil(-0.1), Edge::FreeUntil(0.2)];
    let punch = [Edge::Fixed(-0.1), Edge::Fixed(0.1)];
    for (name, body, [left, right], loads) in [
        ("circle", &circle, free, [1e-4, 0.5]),
        ("two contacts", &quartic, free, [0.01, 1.0]),
        ("two become one", &quartic, free, [0.5, 6.0]),
        ("until a corner", &circle, until, [1e-3, 0.2]),
        ("corners", &circle, punch, [0.1, 0.5]),
    ] {
        let contact = steel(Contact::new(&Flat, &**body).unwrap().edges(left, right));
        for tolerance in [1e-2, 1e-4, 1e-6] {
            let make = |tolerance| SpringTable::new(&contact, &REFERENCES, loads, tolerance);
            let (table, tolerance) = match make(tolerance) {
                // Points next to a kink are not drawn together any further: what is left is named.
                Err(ContactError::Solve(SolveError::ToleranceNotReached { reached, .. })) => {
                    assert!(name == "two become one" && reached > tolerance, "{name}");
                    // Other points are tried with another tolerance, and leave about as much.
                    (make(1.01 * reached).unwrap(), 1.01 * reached)
                }
                table => (table.unwrap(), tolerance),
            };
            let [values, stiffness] = errors(&contact, &table, loads);
            println!(
                "{name} {tolerance:.0e}: {} points, {values:.1e} of {:.1e}, {stiffness:.1e} of {:.1e}",
                table.points().len(),
                table.error(),
                table.stiffness_error()
            );
            assert!(values <= table.error() + 1e-13, "{name}");
            assert!(stiffness <= table.stiffness_error() + 1e-13, "{name}");
            assert!(table.error() <= tolerance, "{name}");
        }
    }
}

#[test]
fn what_makes_no_table_is_refused() {
    let body = Parabola::new(1.0, [-1.0, 1.0]).unwrap();
    let contact = steel(Contact::new(&Flat, &body).unwrap());
    let table = |loads, tolerance| SpringTable::new(&contact, &REFERENCES, loads, tolerance);
    let (positive, more) =
        (("least load", "positive"), ("largest load", "more than the least load"));
    for (loads, says) in [
        ([0.0, 1.0], positive),
        ([-1.0, 1.0], positive),
        ([f64::NAN, 1.0], positive),
        ([f64::INFINITY, 1.0], positive),
        ([0.1, 0.1], more),
        ([0.2, 0.1], more),
        ([0.1, f64::NAN], more),
        ([0.1, f64::INFINITY], more),
    ] {
        let error = table(loads, 1e-3).unwrap_err();
        let ContactError::Input(InputError::InvalidLoad { quantity, must, .. }) = error else {
            panic!("{loads:?}: {error}")
        };
        assert_eq!((quantity, must), says, "{loads:?}");
    }
    for tolerance in [0.0, -1.0, 1.0, f64::NAN] {
        let error = table([0.01, 0.1], tolerance).unwrap_err();
        assert!(
            matches!(error, ContactError::Input(InputError::InvalidTolerance { .. })),
            "{tolerance}"
        );
    }
    // Rounding leaves more. What is left is a tolerance that is reached.
    let Err(ContactError::Solve(SolveError::ToleranceNotReached { reached, .. })) =
        table([0.01, 0.1], 1e-17)
    else {
        panic!("a tolerance below rounding")
    };
    assert!(reached > 1e-17 && reached < 1e-12, "{reached:e}");
    // Next to what is reached, too.
    for tolerance in [5e-16, 1e-15, 2e-15, 5e-15] {
        let error = table([0.01, 0.1], tolerance).map_or(0.0, |table| table.error());
        assert!(error <= tolerance, "{error:e} of {tolerance:e}");
    }
    assert!(table([0.01, 0.1], reached).unwrap().error() <= reached);
    assert!(table([0.01, 0.1], 1e-14).unwrap().error() <= 1e-14);
    assert!(matches!(
        table([0.01, 1e9], 1e-3),
        Err(ContactError::Solve(SolveError::DomainTooShort { .. }))
    ));
    let table = table([0.01, 0.1], 1e-3).unwrap();
    for approach in [1.0, f64::INFINITY, f64::NAN] {
        let error = table.at(approach).unwrap_err();
        assert!(matches!(error, ContactError::Evaluation(EvaluationError::OutsideTable { .. })));
        // No load makes the table cover what is no number.
        let remedy = if approach.is_finite() { "larger loads" } else { "must be finite" };
        assert!(error.to_string().ends_with(remedy), "{error}");
    }
    let ends: Vec<f64> = table.points().map(|point| point.approach).collect();
    assert!((table.at(ends[0]).unwrap().load / 0.01 - 1.0).abs() < 1e-14);
    assert!((table.at(ends[ends.len() - 1]).unwrap().load / 0.1 - 1.0).abs() < 1e-14);
    // An end that was worked out anew may be off by rounding.
    let last = ends[ends.len() - 1];
    assert_eq!(table.at(last * (1.0 + f64::EPSILON)).unwrap(), table.at(last).unwrap());
    assert!(table.at(last * (1.0 + 1e6 * f64::EPSILON)).is_err());
}

#[test]
fn a_table_starts_at_touch() {
    let circle: Profile = Box::new(Ellipse::circle(1.0, [-1.5, 1.5]).unwrap());
    for (edges, linear) in [([Edge::Free; 2], false), ([Edge::Fixed(-0.1), Edge::Fixed(0.1)], true)]
    {
        let contact = steel(Contact::new(&Flat, &*circle).unwrap().edges(edges[0], edges[1]));
        let table = SpringTable::new(&contact, &REFERENCES, [0.1, 0.5], 1e-6).unwrap();
        let first = table.points().next().unwrap();
        for approach in [0.0, -1e-300, -0.3, f64::NEG_INFINITY] {
            let apart = table.at(approach).unwrap();
            assert_eq!([apart.load, apart.stiffness, apart.half_contact], [0.0; 3]);
            assert_eq!((apart.approach, apart.peak), (approach, Some(0.0)));
        }
        let mut most = 0.0f64;
        for i in 1..200 {
            let load = 0.1 * 0.93f64.powi(i);
            // The corners of a punch on a circle need a load.
            let Ok(solution) = contact.solve(Control::Load(load)) else { continue };
            let approach = solution.approach(&REFERENCES).unwrap().bodies;
            let off = (table.at(approach).unwrap().load - load).abs() / first.load;
            most = most.max(off);
        }
        println!("{most:.1e} of {:.1e}", table.touch_error());
        assert!(most <= table.touch_error() + 1e-13, "{most:e} of {:e}", table.touch_error());
        assert!(linear || most > 1e-4);
        // Continuous at the first point.
        let [below, above] = [1.0 - 1e-9, 1.0 + 1e-9].map(|share| table.at(share * first.approach));
        assert!((below.unwrap().load / above.unwrap().load - 1.0).abs() < 1e-8);
    }
}
