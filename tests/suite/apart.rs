//! Bodies that no load presses together: what a simulation meets whenever a follower lifts off.
#![allow(missing_docs)]

use crate::common::{graph, quartic};
use linecontact::profile::{Ellipse, Parabola};
use linecontact::{
    Base, Body, Contact, ContactError, Control, Curve, CurvePoint, Edge, EvaluationError, Flat,
    InputError, Interval, Layer, Material, Midpoint, Outcome, Piecewise, PlaneState, Reference,
    References, Solution, Solver, Start,
};

const TO: References<f64> =
    References { x: 0.0, lower: Reference::Depth(3.0), upper: Reference::Disc(4.0) };

fn steel(contact: Contact<'_, f64>) -> Contact<'_, f64> {
    let steel = Material::elastic(2.1, 0.3);
    contact.materials(steel, steel, PlaneState::Strain)
}

fn approach(approach: f64) -> Control<f64> {
    Control::Approach { approach, references: TO }
}

/// Asserts all answers of bodies that are apart by a distance and touch first at a place; heights
/// are above that place.
fn assert_apart(
    solution: &Solution<f64>,
    [place, separation]: [f64; 2],
    heights: impl Fn(f64) -> [f64; 2],
    ends: [f64; 2],
) {
    assert!(solution.is_apart() && solution.intervals().is_empty(), "{solution}");
    assert!(solution.contacts().unwrap().is_empty());
    assert_eq!((solution.load(), solution.separation()), (0.0, separation));
    let x = solution.a();
    assert!((x - place).abs() < 2e-15 * (1.0 + place.abs()), "{x} for {place}");
    assert_eq!((solution.b(), solution.hull().left, solution.hull().half_width()), (-x, x, 0.0));
    let peak = solution.peak().unwrap();
    assert_eq!((peak.x, peak.pressure), (x, 0.0));
    assert_eq!(solution.mean_pressure(), 0.0);
    assert_eq!(solution.moment().unwrap(), 0.0);
    assert!(matches!(
        solution.centre_of_pressure(),
        Err(ContactError::Input(InputError::InvalidLoad {
            quantity: "load",
            value: 0.0,
            must: "not zero"
        }))
    ));
    let pressure = solution.pressure().unwrap();
    assert!(pressure.sample(5).unwrap().is_empty());
    let places: Vec<f64> =
        (0..=40).map(|i| ends[0] + (ends[1] - ends[0]) * f64::from(i) / 40.0).collect();
    let mut values = vec![f64::NAN; places.len()];
    pressure.at_many(&places, &mut values).unwrap();
    for (&at, value) in places.iter().chain([&x]).zip(values.iter().chain([&0.0])) {
        assert_eq!((pressure.at(at).unwrap(), *value), (0.0, 0.0));
        let [height, slope] = heights(at);
        let gap = solution.gap_at(at).unwrap();
        assert!((gap - separation - height).abs() < 4e-15 * (1.0 + height), "{gap} at {at}");
        if at != x {
            let found = solution.gap_slope(at).unwrap();
            assert!((found - slope).abs() < 1e-13 * (1.0 + slope.abs()), "{found} at {at}");
        }
    }
    assert!(pressure.at(5.0 * ends[1]).is_err() && pressure.at(f64::NAN).is_err());
    assert!(!solution.is_steep() && solution.conformity().is_none());
    assert_eq!(solution.steepest_slope().unwrap(), 0.0);
    let certificate = solution.certify().unwrap();
    assert!(certificate.pressure.is_none());
    assert!(certificate.gap.is_none_or(|least| least.value >= separation));
    assert!(solution.report().is_checked());
    assert_eq!(solution.report().attempts().last().unwrap().outcome, Outcome::Apart);
    assert!(matches!(
        solution.load_rates(),
        Err(ContactError::Evaluation(EvaluationError::NoLoadDerivative { .. }))
    ));
    let summary = solution.summary().unwrap();
    assert!(summary.intervals.is_empty() && summary.checked && summary.load == 0.0);
    assert!(format!("{solution}").starts_with("apart by "), "{solution}");
    for body in [Body::Lower, Body::Upper] {
        let below = solution.subsurface_of(body).unwrap();
        let stress = below.at(x, 0.1).unwrap();
        assert_eq!([stress.sigma_x, stress.sigma_y, stress.tau_xy], [0.0; 3]);
        assert_eq!(below.max_shear().unwrap().value, 0.0);
        assert_eq!(below.max_von_mises(0.3).unwrap().value, 0.0);
        assert_eq!(below.max_tension().unwrap().value, 0.0);
    }
    if let Ok(found) = solution.approach(&TO) {
        assert_eq!([found.bodies, found.lower, found.upper], [-separation, 0.0, 0.0]);
        assert_eq!(solution.stiffness(&TO).unwrap(), 0.0);
    }
}

#[test]
fn a_roller_above_a_flat_is_apart() {
    let circle = Ellipse::circle(1.0, [-1.0, 1.2]).unwrap();
    let contact = steel(Contact::new(&Flat, &circle).unwrap());
    let heights = |x: f64| [1.0 - (1.0 - x * x).sqrt(), x / (1.0 - x * x).sqrt()];
    let ends = [-0.8, 0.9];
    for (control, separation) in [
        (Control::Load(0.0), 0.0),
        (Control::Load(-0.0), 0.0),
        (Control::Moment { load: 0.0, moment: -0.0, about: 0.4 }, 0.0),
        (approach(0.0), 0.0),
        (approach(-0.3), 0.3),
    ] {
        for contact in [
            contact.clone(),
            contact.clone().certified(true),
            contact.clone().start(Interval { left: -0.5, right: 0.7 }),
        ] {
            assert_apart(&contact.solve(control).unwrap(), [0.0, separation], heights, ends);
        }
    }
    let error = contact.solve(Control::Approach {
        approach: -0.1,
        references: References { lower: Reference::Depth(-1.0), ..TO },
    });
    let error = error.map(drop).unwrap_err();
    assert!(matches!(error, ContactError::Input(InputError::InvalidReference { .. })), "{error}");
    for about in [f64::NAN, f64::INFINITY] {
        let error = contact.solve(Control::Moment { load: 0.0, moment: 0.0, about });
        let error = error.map(drop).unwrap_err();
        assert!(matches!(error, ContactError::Input(InputError::InvalidMoment { .. })), "{error}");
    }
    // Held edges and glued ones answer as before.
    let glued = contact.clone().edges(Edge::Adhesive(1e-3), Edge::Adhesive(1e-3));
    assert!(!glued.solve(Control::Load(0.0)).unwrap().is_apart());
    let held = contact.clone().edges(Edge::Fixed(-0.1), Edge::Fixed(0.1));
    let error = held.solve(Control::Load(0.0)).map(drop).unwrap_err();
    assert!(error.to_string().contains("single_interval(true)"), "{error}");
    let idle = held.single_interval(true).solve(Control::Load(0.0)).unwrap();
    assert!(!idle.is_apart() && idle.load() == 0.0);
}

#[test]
fn the_lowest_place_is_found_wherever_it_is() {
    // The lower of two valleys, a tip, an end, a corner, and the middle of a flat.
    let quartic = quartic(-2.0, 2.0);
    let leaning = |by: f64| {
        Curve::new([-2.0, 2.0], move |k: f64| {
            let k2 = k * k;
            CurvePoint { x: k, y: k2 * (k2 - 2.0) + by * k, dx: 1.0, dy: 4.0 * k * (k2 - 1.0) + by }
        })
    };
    for (by, sign) in [(1e-6, -1.0), (-1e-6, 1.0), (0.3, -1.0)] {
        let body = leaning(by);
        let solution = Contact::new(&Flat, &body).unwrap().solve(Control::Load(0.0)).unwrap();
        // 4 x (x² - 1) + by = 0 beside sign.
        let mut x: f64 = sign;
        for _ in 0..50 {
            x -= (4.0 * x * (x * x - 1.0) + by) / (12.0 * x * x - 4.0);
        }
        let y = |x: f64| x * x * (x * x - 2.0) + by * x;
        let heights = |at: f64| [y(at) - y(x), 4.0 * at * (at * at - 1.0) + by];
        assert_apart(&solution, [x, 0.0], heights, [-2.0, 2.0]);
    }
    // A valley beyond a corner does not count.
    let body = leaning(-0.3);
    let until = Contact::new(&Flat, &body).unwrap().edges(Edge::Free, Edge::FreeUntil(0.5));
    let solution = until.solve(Control::Load(0.0)).unwrap();
    assert!((solution.a() + 0.96).abs() < 0.01, "{}", solution.a());
    assert!(solution.gap_at(0.5).unwrap() > 0.1);
    let found = Contact::new(&Flat, &*quartic).unwrap().solve(Control::Load(0.0)).unwrap();
    assert!((found.a().abs() - 1.0).abs() < 1e-15, "either valley: {}", found.a());
    let body = Parabola::new(1.0, [0.5, 2.0]).unwrap();
    let at_end = Contact::new(&Flat, &body).unwrap().solve(Control::Load(0.0)).unwrap();
    assert_apart(&at_end, [0.5, 0.0], |x| [0.5 * (x * x - 0.25), x], [0.5, 2.0]);
    let body = Parabola::new(1.0, [-2.0, 2.0]).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap();
    let until = contact.edges(Edge::FreeUntil(-0.1), Edge::FreeUntil(0.5));
    let solution = until.solve(Control::Load(0.0)).unwrap();
    assert_apart(&solution, [0.0, 0.0], |x| [0.5 * x * x, x], [-0.1, 0.5]);
    let tip = Piecewise::new(vec![
        graph(-1.0, 0.25, |x| [0.25 - x, -1.0]),
        graph(0.25, 1.0, |x| [0.5 * (x - 0.25), 0.5]),
    ])
    .unwrap();
    let solution = Contact::new(&Flat, &tip).unwrap().solve(Control::Load(0.0)).unwrap();
    let flank = |x: f64| if x < 0.25 { [0.25 - x, -1.0] } else { [0.5 * (x - 0.25), 0.5] };
    assert_apart(&solution, [0.25, 0.0], flank, [-1.0, 1.0]);
    // Of a flat bottom, any place will do.
    let blunt = |x: f64| {
        let beyond = (x.abs() - 0.3).max(0.0);
        [beyond * beyond, 2.0 * beyond.copysign(x)]
    };
    let body = graph(-1.0, 1.0, blunt);
    let solution = Contact::new(&Flat, &*body).unwrap().solve(Control::Load(0.0)).unwrap();
    assert!(solution.is_apart() && solution.a().abs() < 0.31, "{}", solution.a());
    assert!((solution.gap_at(0.8).unwrap() - 0.25).abs() < 1e-14);
    assert_apart(&solution, [solution.a(), 0.0], blunt, [-1.0, 1.0]);
}

#[test]
fn a_solver_lifts_off_and_touches_down() {
    let circle = Ellipse::circle(1.0, [-1.0, 1.0]).unwrap();
    let contact = steel(Contact::new(&Flat, &circle).unwrap());
    let mut solver = Solver::new();
    for _ in 0..3 {
        for delta in [0.01, 0.002, -1e-3, 0.0, -0.1, 3e-3] {
            let [warm, cold] =
                [solver.solve(&contact, approach(delta)), contact.solve(approach(delta))];
            let (warm, cold) = (warm.unwrap(), cold.unwrap());
            assert_eq!(warm.is_apart(), delta <= 0.0);
            assert!((warm.load() - cold.load()).abs() <= 1e-13 * cold.load());
            assert!((warm.approach(&TO).unwrap().bodies - delta).abs() < 1e-14);
        }
        let warm = solver.solve(&contact, Control::Load(0.0)).unwrap();
        assert_eq!(warm.report().attempts().len(), 1);
        assert_eq!(warm.report().attempts()[0].start, Start::LowestGap);
    }
    // A smooth way to no force.
    let loads = [1e-6, 1e-9, 1e-12].map(|delta| contact.solve(approach(delta)).unwrap().load());
    assert!(loads[0] > loads[1] && loads[1] > loads[2] && loads[2] > 0.0 && loads[0] < 1e-5);
}

#[test]
fn apart_is_the_same_with_layers_periods_and_other_quadratures() {
    let steel = Material::elastic(2.1, 0.3);
    let layer = Layer {
        material: Material::elastic(0.1, 0.4),
        thickness: 0.2,
        base: Base::HalfPlane(steel),
    };
    let body = Parabola::new(1.0, [-1.0, 1.0]).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap();
    let heights = |x: f64| [0.5 * x * x, x];
    let coated = contact.clone().materials(layer, steel, PlaneState::Strain);
    assert_apart(&coated.solve(approach(-0.2)).unwrap(), [0.0, 0.2], heights, [-1.0, 1.0]);
    let rule = Midpoint::DEFAULT;
    let midpoint = contact.clone().quadrature(&rule);
    assert_apart(&midpoint.solve(Control::Load(0.0)).unwrap(), [0.0, 0.0], heights, [-1.0, 1.0]);
    let wave = Curve::new([0.0, 1.0], |k: f64| {
        let angle = std::f64::consts::TAU * k;
        CurvePoint {
            x: k,
            y: 0.01 * angle.sin(),
            dx: 1.0,
            dy: 0.01 * std::f64::consts::TAU * angle.cos(),
        }
    });
    let row = Contact::new(&Flat, &wave).unwrap().period(1.0);
    let solution = row.solve(Control::Load(0.0)).unwrap();
    assert!(solution.is_apart() && (solution.a() - 0.75).abs() < 1e-14, "{}", solution.a());
    assert!((solution.gap_at(5.25).unwrap() - 0.02).abs() < 1e-15);
}

#[test]
fn a_resolution_holds_at_first_touch() {
    // A burr below the lowest place of a parabola, and ten times narrower than the first samples.
    let burr = graph(-1.0, 1.0, |x| {
        let s = (x - 0.6303) / 0.0005;
        let rest = (1.0 - s * s).max(0.0);
        [0.5 * x * x - 0.25 * rest.powi(3), x + 1.5 * s * rest.powi(2) / 0.0005]
    });
    let contact = steel(Contact::new(&Flat, &*burr).unwrap());
    let close = contact.clone().resolution(1e-3);
    let mut solver = Solver::new();
    for control in [Control::Load(0.0), approach(-0.3)] {
        let missed = contact.solve(control).unwrap();
        let _ = solver.solve(&contact, control).unwrap();
        let found = [solver.solve(&close, control).unwrap(), close.solve(control).unwrap()];
        assert!(missed.a().abs() < 1e-9, "{missed}");
        for found in found {
            assert!((found.a() - 0.6303).abs() < 1e-5, "{found}");
            let above = found.gap_at(0.0).unwrap() - found.separation();
            assert!((above - (0.25 - 0.5 * 0.6303f64.powi(2))).abs() < 1e-6, "{above}");
        }
    }
}

/// Features that the first samples miss are no proof: a dent that lies lower, and a hole of NaN.
#[test]
fn what_first_samples_miss_is_not_certified() {
    let dent = graph(-5.0, 5.0, |x| {
        let z = (x - 1.7) / 0.2;
        let bump = 0.3 * (-z * z).exp();
        [x * x / 20.0 - bump, x / 10.0 + 2.0 * z / 0.2 * bump]
    });
    let hole = graph(-5.0, 5.0, |x| {
        let y = if (2.0..2.1).contains(&x) { f64::NAN } else { x * x / 20.0 };
        [y, x / 10.0 + 0.0 * y]
    });
    for (name, body) in [("dent", dent), ("hole", hole)] {
        let contact = Contact::new(&Flat, &*body).unwrap();
        // Either the lowest place is found, or nothing is proved of another.
        let Ok(solution) = contact.solve(Control::Load(0.0)) else { continue };
        let is_lowest = name == "dent" && (solution.a() - 1.7).abs() < 0.1;
        assert!(is_lowest || solution.certify().is_err(), "{name}: {solution}");
        assert!(is_lowest || contact.certified(true).solve(Control::Load(0.0)).is_err(), "{name}");
    }
}
