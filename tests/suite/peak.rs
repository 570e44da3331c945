//! The largest pressure: its place, and contacts without one.
#![allow(missing_docs)]

use crate::common;

use common::{graph, on_flat, parabola, power};
use linecontact::profile::rounded_punch;
use linecontact::reference::{ClosedForm, RoundedPunch};
use linecontact::{
    Contact, ContactError, Control, Curve, CurvePoint, Edge, EvaluationError, Flat, Midpoint,
    Piecewise,
};
use std::f64::consts::PI;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

#[test]
fn of_a_parabola_away_from_zero() {
    let contact = on_flat(graph(-1.0, 1.0, |x| [(x - 0.1).powi(2) / 2.0, x - 0.1]));
    let paper = Midpoint::paper(256, 2);
    for (contact, accuracy) in [(contact.clone(), 1e-14), (contact.quadrature(&paper), 1e-4)] {
        let solution = contact.solve(Control::Load(0.02)).unwrap();
        let peak = solution.peak().unwrap();
        let exact = 0.2 / PI;
        assert!((peak.pressure / exact - 1.0).abs() < accuracy, "{peak:?}");
        assert!((peak.x - 0.1).abs() < 0.2 * accuracy.sqrt(), "{peak:?}");
    }
}

#[test]
fn infinite_at_a_fixed_edge_and_at_a_wedge() {
    let singular = |contact: Contact<'_, f64>, place: f64| {
        let solution = contact.solve(Control::Load(0.1)).unwrap();
        let found = solution.peak();
        assert!(
            matches!(found, Err(ContactError::Evaluation(EvaluationError::Singular { x })) if x == place),
            "{found:?}"
        );
    };
    let body = parabola(1.0);
    let scene = Contact::new(&Flat, &*body).unwrap();
    singular(scene.clone().edges(Edge::Fixed(-0.25), Edge::Fixed(0.25)), 0.25);
    singular(scene.edges(Edge::Fixed(-0.25), Edge::Free), -0.25);
    let face = |slope: f64| {
        move |k: f64| CurvePoint { x: k, y: slope * k + k * k, dx: 1.0, dy: slope + 2.0 * k }
    };
    let wedge = Piecewise::new(vec![
        Curve::new([-2.0, 0.0], face(-0.1)),
        Curve::new([0.0, 2.0], face(0.3)),
    ]);
    let wedge = wedge.unwrap();
    singular(Contact::new(&Flat, &wedge).unwrap(), 0.0);
}

#[test]
fn inside_an_adhesive_contact() {
    let contact = on_flat(parabola(1.0));
    let contact = contact.edges(Edge::Adhesive(1e-3), Edge::Adhesive(1e-3));
    let solution = contact.solve(Control::Load(0.02)).unwrap();
    let peak = solution.peak().unwrap();
    let beside = solution.pressure().unwrap().at(0.05).unwrap();
    assert!(peak.x.abs() < 1e-7 && peak.pressure > beside, "{peak:?}");
}

#[test]
fn of_many_pieces_one_of_which_has_a_corner() {
    const PIECES: i32 = 1000;
    let end = |i: i32| -0.5 + f64::from(i) / f64::from(PIECES);
    let make = |corner: f64| {
        let arcs = (0..PIECES).map(|i| {
            let bend = if i >= 517 { corner } else { 0.0 };
            graph(end(i), end(i + 1), move |x| [x * x / 2.0 + bend * (x - end(517)), x + bend])
        });
        Piecewise::new(arcs.collect()).unwrap()
    };
    let smooth = make(0.0);
    let contact = Contact::new(&Flat, &smooth).unwrap();
    let peak = contact.solve(Control::Load(0.02)).unwrap().peak().unwrap();
    assert!((peak.pressure * PI / 0.2 - 1.0).abs() < 1e-12 && peak.x.abs() < 1e-7);

    let up = make(1e-4);
    let contact = Contact::new(&Flat, &up).unwrap();
    let peak = contact.solve(Control::Load(0.02)).unwrap().peak();
    assert!(
        matches!(peak, Err(ContactError::Evaluation(EvaluationError::Singular { x })) if x == end(517)),
        "{peak:?}"
    );

    let down = make(-1e-4);
    let contact = Contact::new(&Flat, &down).unwrap().single_interval(true);
    let solution = contact.solve(Control::Load(0.02)).unwrap();
    assert!(solution.peak().is_ok());
    // The bodies part over far less than a rounding of x.
    let proof = solution.certify().unwrap();
    let least = proof.pressure.unwrap();
    assert!([least.x, least.value] == [end(517), 0.0] && !proof.is_proved(), "{proof:?}");
}

#[test]
fn an_infinite_peak_is_refused_whatever_its_unit() {
    // A flat punch, tilted: K > 0 at both edges. And a wedge, infinite at one point.
    for unit in [1e-150, 1e-20, 1.0, 1e20] {
        let contact = on_flat(graph(-1.0, 1.0, |x| [0.1 * x, 0.1])).kappa(unit);
        let contact = contact.edges(Edge::Fixed(-0.5), Edge::Fixed(0.5));
        let solution = contact.solve(Control::Load(2.0 * unit)).unwrap();
        assert_eq!(
            solution.peak(),
            Err(ContactError::Evaluation(EvaluationError::Singular { x: 0.5 })),
            "{unit}"
        );
        let contact = on_flat(power(1.0)).kappa(unit);
        let solution = contact.solve(Control::HalfWidth(0.5)).unwrap();
        let pressure = solution.pressure().unwrap();
        let mut three = [0.0; 3];
        let refused = pressure.at_many(&[0.1, 0.0, -0.2], &mut three);
        assert_eq!(
            refused,
            Err(ContactError::Evaluation(EvaluationError::Singular { x: 0.0 })),
            "{unit}"
        );
        assert_eq!(three[0], pressure.at(0.1).unwrap());
    }
}

/// Every call of a curve during a search for a peak is in the cost.
#[test]
fn what_a_given_peak_costs() {
    let calls = AtomicUsize::new(0);
    let body = Curve::new([-1.0, 1.0], |k: f64| {
        calls.fetch_add(1, Relaxed);
        CurvePoint { x: k + k * k * k, y: k * k / 2.0, dx: 1.0 + 3.0 * k * k, dy: k }
    });
    let contact = Contact::new(&Flat, &body).unwrap();
    let rule = Midpoint { segments: 32, ..Midpoint::DEFAULT };
    for contact in [contact.clone(), contact.quadrature(&rule)] {
        let before = calls.load(Relaxed);
        let cost = contact.solve(Control::PeakPressure(0.05)).unwrap().cost();
        assert_eq!(cost.evaluations + cost.heights, calls.load(Relaxed) - before);
    }
}

/// A wide trial spans hollows, and its pressure hardly depends on the load: the next trial must not
/// start there.
#[test]
fn of_one_crest_of_many() {
    for (w, steep, phase, load) in [
        (74.23460738669868, 2.387420189230763, 6.093179177912889, 8.767190905891958e-7),
        (156.1475603184488, 13.766458396941339, 5.495245245702054, 3.479030365063762e-8),
    ] {
        let a: f64 = steep / (w * w);
        let contact = on_flat(graph(-1.0, 1.0, move |x| {
            let (sin, cos) = (w * x + phase).sin_cos();
            [x * x / 2.0 + a * cos, x - a * w * sin]
        }));
        let under = contact.solve(Control::Load(load)).unwrap();
        let found = contact.solve(Control::PeakPressure(under.peak().unwrap().pressure)).unwrap();
        assert!(
            (found.load() / load - 1.0).abs() < 1e-7,
            "{found} {:?} {under} {:?}",
            found.peak(),
            under.peak()
        );
        assert!((found.a() - under.a()).abs() < 1e-7 * under.hull().half_width());
    }
}

/// The peak of a contact leads back to it, even if the contact hardly extends beyond a flat.
#[test]
fn peaks_of_a_punch_with_a_flat() {
    for (flat, radius) in [(1.0, 1.0), (1.0, 0.1), (0.1, 5.0)] {
        let body = rounded_punch(flat, radius, 1.5 * flat).unwrap();
        let contact = Contact::new(&Flat, &body).unwrap();
        for beyond in [1e-5f64, 1e-4, 3e-4, 1e-3, 3e-3, 0.01, 0.1, 0.3] {
            let form = RoundedPunch::new(flat, radius, flat * (1.0 + beyond)).unwrap();
            let solution = contact.solve(Control::Load(form.load(1.0))).unwrap();
            let peak = solution.peak().unwrap().pressure;
            let again = contact.solve(Control::PeakPressure(peak));
            let again = again.unwrap_or_else(|e| panic!("{flat} {radius} {beyond}: {e}"));
            let off = (again.a() / flat - 1.0 - beyond).abs() / beyond;
            assert!(off < 1e-9, "{flat} {radius} {beyond}: off by {off:e}");
        }
    }
}

/// The largest of 20 000 pressures does not exceed the peak.
#[test]
fn the_peak_among_fine_waves() {
    let q = 400.0;
    let contact = on_flat(graph(-1.0, 1.0, move |x: f64| {
        [x * x / 2.0 + 0.15 / q / q * (q * x + 0.3).sin(), x + 0.15 / q * (q * x + 0.3).cos()]
    }));
    let solution = contact.solve(Control::Load(0.08)).unwrap();
    let points = solution.pressure().unwrap().sample(20_000).unwrap();
    let most = points.iter().map(|point| point[1]).max_by(f64::total_cmp).unwrap();
    let peak = solution.peak().unwrap().pressure;
    assert!(peak >= most && peak < most * (1.0 + 1e-6), "{peak} {most}");
    let again = contact.solve(Control::PeakPressure(peak)).unwrap();
    assert!((again.load() / 0.08 - 1.0).abs() < 1e-9, "{}", again.load());
}
