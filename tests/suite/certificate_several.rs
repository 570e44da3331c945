//! Certificates of several contacts: they pass, and features missed in, between or outside them are
//! refused at the right place with the right value.
#![allow(missing_docs)]

use crate::common::{Profile, graph, on_flat, quartic};
use crate::narrow_features::dented;
use crate::several_quantities::{Scene, all_scenes};
use crate::several_solved::forms;

use linecontact::reference::{Quartic, body};
use linecontact::{
    Contact, ContactError, Control, Curve, CurvePoint, Edge, Extremum, Flat, Piecewise, SolveError,
};
use std::f64::consts::PI;
use std::sync::atomic::{AtomicBool, Ordering};

const KAPPA: f64 = PI / 2.0;

#[test]
fn closed_forms_with_several_contacts_pass() {
    let mut forms = forms::<f64>();
    forms.retain(|(name, ..)| [", 2", ", 3", ", 5"].iter().any(|count| name.ends_with(count)));
    for load in [0.01, 1.0, 3.0] {
        let form = Quartic::under_load(1.0, 1.0, load, KAPPA).unwrap();
        forms.push((format!("quartic, {load}"), Box::new(form), 2.5));
    }
    let mut faults = Vec::new();
    for (name, form, reach) in forms {
        let body = body(&*form, -reach, reach).unwrap();
        let contact = Contact::new(&Flat, &body).unwrap().kappa(KAPPA);
        let solution = match contact.solve(Control::Load(form.load(KAPPA))) {
            Ok(solution) => solution,
            Err(error) => {
                faults.push(format!("{name}: not solved: {error}"));
                continue;
            }
        };
        assert!(solution.intervals().len() > 1, "{name}");
        let start = std::time::Instant::now();
        let certificate = match solution.certify() {
            Ok(certificate) => certificate,
            Err(error) => {
                faults.push(format!("{name}: {error}"));
                continue;
            }
        };
        println!("{name:20} {:?} {certificate:?}", start.elapsed());
        // Between two contacts the gap grows and then shrinks; it has no interior minimum.
        assert_eq!(certificate.gap, None, "{name}");
        let mut least = f64::INFINITY;
        for on in form.contacts() {
            let places: Vec<f64> =
                (0..400).map(|i| on.at_angle(PI * (f64::from(i) + 0.5) / 400.0)).collect();
            let weighed = |&x: &f64| form.pressure(x, KAPPA) * on.chebyshev_weight(x);
            let load = PI / 400.0 * places.iter().map(weighed).sum::<f64>();
            let mean = load / (2.0 * on.half_width());
            let ratio =
                |x: f64| form.pressure(x, KAPPA) * on.half_width() / on.chebyshev_weight(x) / mean;
            least = places.iter().fold(least, |least, &x| least.min(ratio(x)));
        }
        let Extremum { x, value } = certificate.pressure.unwrap();
        assert!((value / least - 1.0).abs() < 0.01, "{name}: {value} at {x}, for {least}");
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn contacts_of_the_files_pass() {
    for Scene { name, body, load, .. } in all_scenes() {
        let mut contact = Contact::new(&Flat, &*body).unwrap().kappa(KAPPA);
        if name.contains("corner") {
            contact = contact.edges(Edge::FreeUntil(-1.0), Edge::FreeUntil(1.0));
        }
        let solution = contact.solve(Control::Load(load)).unwrap();
        let certificate = solution.certify().unwrap_or_else(|error| panic!("{name}: {error}"));
        println!("{name:24} {certificate:?}");
    }
}

/// A hollow punch touches at its two corners; a body with corners and a low middle touches in three
/// places.
#[test]
fn two_corners() {
    let hollow = graph(-1.0, 1.0, |x| [-0.05 * x * x, -0.1 * x]);
    let wavy = graph(-1.0, 1.0, |x| {
        let (sin, cos) = (2.0 * PI * x).sin_cos();
        [-0.02 * cos, 0.04 * PI * sin]
    });
    for (body, load, count) in [(hollow, 0.01, 2), (wavy, 0.02, 3)] {
        let contact = Contact::new(&Flat, &*body).unwrap();
        let contact = contact.edges(Edge::FreeUntil(-1.0), Edge::FreeUntil(1.0));
        let solution = contact.solve(Control::Load(load)).unwrap();
        assert_eq!(solution.intervals().len(), count, "{solution:?}");
        assert!(solution.a() == 1.0 && solution.b() == 1.0, "{solution:?}");
        let certificate = solution.certify().unwrap();
        assert_eq!(certificate.gap, None);
        assert!(certificate.pressure.unwrap().value > 0.0);
    }
}

#[test]
fn in_single_precision() {
    let body = Curve::new([-2.5, 2.5], |k: f32| CurvePoint {
        x: k,
        y: k.powi(4) - 2.0 * k * k,
        dx: 1.0,
        dy: 4.0 * k.powi(3) - 4.0 * k,
    });
    let contact = Contact::new(&Flat, &body).unwrap().kappa(KAPPA as f32).certified(true);
    for load in [0.1, 1.0, 2.0] {
        let solution = contact.solve(Control::Load(load)).unwrap();
        assert_eq!(solution.intervals().len(), 2);
    }
}

/// Contacts of `x⁴ - 2x²` under F = 1, E* = 1.
struct Pair {
    /// Half of β² - α².
    d: f64,
}

impl Pair {
    const LOAD: f64 = 1.0;

    fn new() -> Self {
        Self { d: (4.0 * Self::LOAD / PI).sqrt() / 2.0 }
    }

    fn limits(&self) -> [f64; 2] {
        [(1.0 - self.d).sqrt(), (1.0 + self.d).sqrt()]
    }

    /// Returns the gap, which opens with the slope `4x sqrt((x² - α²)(x² - β²))`.
    fn gap(&self, x: f64) -> f64 {
        let t = (x * x - 1.0).abs();
        let s = (t * t - self.d * self.d).sqrt();
        t * s - self.d * self.d * ((t + s) / self.d).ln()
    }
}

/// Returns a bump of height 1 and width 1, and its slope.
fn bump(s: f64) -> [f64; 2] {
    let t = 1.0 - 4.0 * s * s;
    if t > 0.0 { [t.powi(4), -32.0 * s * t.powi(3)] } else { [0.0; 2] }
}

fn with_a_bump(at: f64, width: f64, height: f64) -> Profile {
    graph(-2.5, 2.5, move |x: f64| {
        let [y, dy] = bump((x - at) / width);
        let [y, dy] = [height * y, height * dy / width];
        [x.powi(4) - 2.0 * x * x - y, 4.0 * x.powi(3) - 4.0 * x - dy]
    })
}

#[test]
fn a_narrow_asperity_between_two_contacts_or_beside_them() {
    let pair = Pair::new();
    for (at, width) in
        [(0.0, 0.01), (0.1234, 0.01), (-0.301, 4e-3), (0.3, 2e-3), (1.9, 0.01), (-2.2, 0.005)]
    {
        // Place at which a growing bump first touches the flat, and its height then: the least
        // ratio of the gap to the bump.
        let steps = 20_000;
        let places = (1..steps).map(|i| at + width * (f64::from(i) / f64::from(steps) - 0.5));
        let ratio = |x: f64| pair.gap(x) / bump((x - at) / width)[0];
        let place = places.fold(at, |best, x| if ratio(x) < ratio(best) { x } else { best });
        let touching = ratio(place);
        for off in [-1e-2, -1e-5, 1e-5, 1e-2] {
            let body = with_a_bump(at, width, touching * (1.0 + off));
            let contact = Contact::new(&Flat, &*body).unwrap().kappa(KAPPA);
            let solution = contact.solve(Control::Load(Pair::LOAD)).unwrap();
            let due = -off * touching;
            let near = match solution.certify() {
                Ok(certificate) if off < 0.0 => certificate.gap.expect("it comes near"),
                Err(ContactError::Solve(SolveError::Overlap { x, gap: value, .. }))
                    if off > 0.0 =>
                {
                    Extremum { x, value }
                }
                // The solver has seen it.
                Ok(_) if solution.intervals().len() > 2 => continue,
                other => panic!("{at}, {off}: {other:?}"),
            };
            println!("{at} {off}: {near:?} for {due:e}, {:?}", solution.intervals().len());
            assert!((near.x - place).abs() < 0.1 * width, "{near:?} for {place}");
            assert!((near.value - due).abs() < 0.02 * due.abs() + 1e-11, "{near:?} for {due:e}");
        }
    }
}

/// A bump inside one of two contacts, between two nodes.
#[test]
fn what_the_panels_of_one_contact_have_missed() {
    let pair = Pair::new();
    let [from, to] = pair.limits();
    let (mut missed, width) = (0, 0.006);
    for i in 0..40 {
        let at = from + (to - from) * (f64::from(i) + 0.5) / 40.0;
        let at = if i % 2 == 0 { at } else { -at };
        let body = with_a_bump(at, width, -0.01);
        let contact = Contact::new(&Flat, &*body).unwrap().kappa(KAPPA);
        let Ok(solution) = contact.solve(Control::Load(Pair::LOAD)) else { continue };
        let unaware = solution.intervals().len() == 2 && (solution.a() - to).abs() < 1e-12;
        match solution.certify() {
            Err(ContactError::Solve(SolveError::FeatureMissed { x, slope, assumed }))
                if unaware =>
            {
                missed += 1;
                let smooth = 4.0 * x.powi(3) - 4.0 * x;
                assert!((x - at).abs() < width / 2.0, "{x}, {at}");
                assert!((assumed - smooth).abs() < 1e-9 && (slope - smooth).abs() > 1e-3);
            }
            other => assert!(!unaware || other.is_err(), "{at}: {other:?}"),
        }
    }
    assert!(missed > 5, "{missed}");
}

/// One half of a body sinks after the solve: its slopes are unchanged, but the gap no longer
/// closes.
#[test]
fn heights_that_do_not_go_with_the_contacts() {
    let sunk = AtomicBool::new(false);
    let depth = 1e-6;
    let quartic = Curve::new([-2.5, 2.5], |k: f64| {
        let depth = if sunk.load(Ordering::Relaxed) && k > 0.0 { depth } else { 0.0 };
        let [y, dy] = [k.powi(4) - 2.0 * k * k + depth, 4.0 * k.powi(3) - 4.0 * k];
        CurvePoint { x: k, y, dx: 1.0, dy }
    });
    let contact = Contact::new(&Flat, &quartic).unwrap().kappa(KAPPA);
    let solution = contact.solve(Control::Load(Pair::LOAD)).unwrap();
    solution.certify().unwrap();
    sunk.store(true, Ordering::Relaxed);
    let error = solution.certify().unwrap_err();
    let ContactError::Solve(SolveError::Unbalanced { x, strength, allowed }) = error else {
        panic!("{error}")
    };
    let [_, b] = Pair::new().limits();
    assert!((x - b).abs() < 1e-12 && allowed < 1e-3 * strength, "{error}");
    // P = 2x sqrt((x² - α²)(β² - x²)); a limit with this error leaves this strength.
    let off = (contact.solve(Control::Load(Pair::LOAD)).unwrap().a() - solution.a()).abs();
    let half_width = solution.intervals()[1].half_width();
    let factor = 2.0 * b * (2.0 * Pair::new().d * 2.0 * b).sqrt();
    let due = factor * off / 2.0 * (2.0 / half_width).sqrt();
    assert!((strength / due - 1.0).abs() < 1e-3, "{strength:e} for {due:e}");
}

#[test]
fn several_tilted_contacts_are_certified() {
    let contact = on_flat(quartic(-2.0, 2.0)).contact_modulus(1.0);
    for at in [0.1, -0.3] {
        let solution = contact.solve(Control::CentreOfPressure { load: 1.0, at }).unwrap();
        assert!(solution.intervals().len() == 2 && solution.tilt() != 0.0);
        solution.certify().unwrap();
    }
}

/// The middle of the gap lies next to the roof by rounding: if the rest of a panel is continued
/// there, the gap stays undecided.
#[test]
fn a_roof_between_two_contacts() {
    for (roof, bend, load) in [(0.6, 2.0, 0.05), (1.0, 0.5, 0.2), (0.6, 0.5, 0.1), (0.3, 2.0, 0.01)]
    {
        let half = |side: f64, domain: [f64; 2]| {
            Curve::new(domain, move |k: f64| CurvePoint {
                x: k,
                y: bend * k * k - side * roof / 2.0 * k,
                dx: 1.0,
                dy: 2.0 * bend * k - side * roof / 2.0,
            })
        };
        let body = Piecewise::new(vec![half(-1.0, [-2.0, 0.0]), half(1.0, [0.0, 2.0])]).unwrap();
        let solution = Contact::new(&Flat, &body).unwrap().solve(Control::Load(load)).unwrap();
        assert_eq!(solution.intervals().len(), 2);
        assert!(solution.gap_at(0.0).unwrap() > 0.0);
        assert_eq!(solution.certify().unwrap().gap, None, "{roof} {bend} {load}");
    }
}

/// A limit on the shoulder of a wall that is shorter than its cell: the singularity of the slope in
/// that cell is as close to the limit as the wall, and the gap was followed by steps a hundred
/// times as long. Limits by Gauss's rules of 220 nodes with 30 digits.
#[test]
fn a_limit_on_a_shoulder_is_balanced() {
    let (x0, width) = (0.0734844, 0.0708670);
    let walls = [-0.5, 0.5].map(|end| x0 + end * width);
    let body = Curve::new([-1.0, 1.0], dented(-0.00933426, 0.00128238, walls));
    let contact = Contact::new(&Flat, &body).unwrap().contact_modulus(210e3 / 0.91 / 2.0);
    let solution = contact.solve(Control::Load(740.6147)).unwrap();
    let limits = solution.intervals().iter().flat_map(|on| [on.left, on.right]);
    let known =
        [-0.199062673926183, -0.13887136973739578, 0.03961075110536314, 0.10727250945261517];
    for (found, known) in limits.zip(known) {
        assert!((found - known).abs() < 1e-14, "{found} for {known}");
    }
    solution.certify().unwrap();
}
