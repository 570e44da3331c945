//! A given moment or centre of pressure, for which the bodies turn.
#![allow(missing_docs)]

use crate::common::{Profile, graph, intervals, join, parabola};

use approx::assert_relative_eq;
use linecontact::profile::{Outline, Parabola, wedge};
use linecontact::search::Brent;
use linecontact::{
    Contact, ContactError, Control, Edge, Ends, Flat, InputError, Interval, Midpoint, Solution,
    SolveError, Solver,
};
use std::f64::consts::{FRAC_PI_2, PI};

/// Returns the control of a load with a moment about x = 0.
fn moment(load: f64, moment: f64) -> Control<f64> {
    Control::Moment { load, moment, about: 0.0 }
}

fn near(got: f64, due: f64, size: f64, what: &str) {
    assert!((got - due).abs() <= 1e-13 * size, "{what}: {got:e} for {due:e}, size {size:e}");
}

/// Asserts that a solution agrees with a solution of the turned body.
fn assert_same(got: &Solution<f64>, due: &Solution<f64>, allowed: f64) {
    let (contacts, known) = (intervals(got), intervals(due));
    assert_eq!(contacts.len(), known.len(), "{contacts:?} {known:?}");
    let hull = due.hull();
    let width = 2.0 * hull.half_width();
    for (on, known) in contacts.iter().zip(&known) {
        let size = allowed * known.half_width();
        assert!((on.left - known.left).abs() <= size, "{on:?} {known:?}");
        assert!((on.right - known.right).abs() <= size, "{on:?} {known:?}");
    }
    let mean = due.mean_pressure();
    let (pressure, known_pressure) = (got.pressure().unwrap(), due.pressure().unwrap());
    for on in &known {
        for i in 1..20 {
            let x = on.at_angle(PI * f64::from(i) / 20.0);
            let [p, q] = [pressure.at(x).unwrap(), known_pressure.at(x).unwrap()];
            assert!((p - q).abs() <= 10.0 * allowed * q.abs().max(mean), "P({x}) {p:e} for {q:e}");
            let left = got.residual(x).unwrap();
            assert!(left.abs() <= 1e-9 * mean, "residual({x}) {left:e}");
        }
    }
    let [x, depth] = [hull.centre() + 0.1 * width, 0.3 * width];
    let stress =
        |solution: &Solution<f64>| solution.subsurface().unwrap().at(x, depth).unwrap().max_shear();
    assert_relative_eq!(stress(got), stress(due), epsilon = 0.0, max_relative = 1e3 * allowed);
    for x in [hull.left - 0.2 * width, hull.right + 0.1 * width] {
        if let (Ok(open), Ok(known)) = (got.gap_at(x), due.gap_at(x)) {
            assert!(
                (open - known).abs() <= 1e3 * allowed * known.abs().max(1e-3),
                "{open} {known}"
            );
            let [slope, known] = [got, due].map(|solution| solution.gap_slope(x).unwrap());
            assert!((slope - known).abs() <= 1e3 * allowed * known.abs().max(1e-3));
        }
    }
    if known.len() == 1 {
        assert_relative_eq!(
            got.load_rates().unwrap().a,
            due.load_rates().unwrap().a,
            epsilon = 1e-14,
            max_relative = 1e3 * allowed
        );
        let strengths = [got, due].map(Solution::edge_singularities);
        for (k, known) in strengths[0].into_iter().zip(strengths[1]) {
            assert!((k - known).abs() <= 1e2 * allowed * mean, "K {k:e} {known:e}");
        }
    }
}

#[test]
fn a_parabola_rolls() {
    for radius in [1.0, 30.0] {
        let body = Parabola::new(radius, [-4.0 * radius, 4.0 * radius]).unwrap();
        let contact = Contact::new(&Flat, &body).unwrap().contact_modulus(1.0);
        for load in [1e-6, 0.2, 0.4 * radius] {
            let half_width = (4.0 * load * radius / PI).sqrt();
            for arm in [0.0, 0.01, -0.3, 1.0, -1.9] {
                let solution = contact.solve(moment(load, load * arm * radius)).unwrap();
                let on = solution.hull();
                near(on.centre(), arm * radius, radius * (1.0 + arm.abs()), "centre");
                near(on.half_width(), half_width, half_width + 4.0 * arm.abs() * radius, "width");
                near(solution.tilt(), -arm, 1.0, "tilt");
                assert!(solution.limits_error().unwrap() < 1e-9);
                assert!(solution.report().is_checked());
                solution.certify().unwrap();
                let got = solution.moment().unwrap();
                near(got, load * arm * radius, load * (half_width + radius), "moment");
            }
        }
    }
}

#[test]
fn a_wedge_leans() {
    let t = 0.3;
    let body = wedge([-t, t], 60.0).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap().contact_modulus(1.0);
    for load in [1e-3, 0.2, 1.0] {
        for share in [-2.0, -0.4, 0.0, 0.1, 1.0, 3.0] {
            let m = share * load * load / (2.0 * t);
            let theta = f64::atan2(1.0, -2.0 * t * m / (load * load));
            let solution = contact.solve(moment(load, m)).unwrap();
            // With the tip close to an edge, the first search may fail.
            let trials = solution.report().attempts().len();
            assert!(trials == 1 || share > 2.0, "{load} {share}");
            near(solution.tilt(), t * (1.0 - 2.0 * theta / PI), t, "tilt");
            let half_width = load / (t * theta.sin());
            near(solution.hull().half_width(), half_width, half_width, "half-width");
            // The tip is at θ₀ of the contact.
            near(solution.hull().centre(), -half_width * theta.cos(), half_width, "centre");
        }
    }
}

#[test]
fn a_flat_punch_tilts() {
    // P = (F - m x)/(π sqrt(L² - x²)): its moment is -m L²/2.
    let half_width = 0.7;
    let edges = [Edge::Fixed(-half_width), Edge::Fixed(half_width)];
    let contact = Contact::new(&Flat, &Flat).unwrap().edges(edges[0], edges[1]);
    let load = 0.3;
    for slope in [0.0, 0.1, -0.3, 0.42] {
        let m = -slope * half_width * half_width / 2.0;
        let solution = contact.solve(moment(load, m)).unwrap();
        near(solution.tilt(), slope, 1.0, "tilt");
        let pressure = solution.pressure().unwrap();
        for x in [-0.6, -0.1, 0.0, 0.3, 0.69f64] {
            let due = (load - slope * x) / (PI * (half_width * half_width - x * x).sqrt());
            near(pressure.at(x).unwrap(), due, due, "P");
        }
        near(solution.moment().unwrap(), m, load, "moment");
        assert_eq!(solution.limits_error(), None);
    }
}

/// With x²/2 and a corner at e on the right: under F, of half-width L, the load acts at
/// `e - L/2 - L³/(4 F)`, and the bodies are turned by `L/2 - F/L - (e - L)`.
#[test]
fn a_parabola_held_by_one_corner() {
    let (corner, body) = (0.3, parabola(3.0));
    let contact = Contact::new(&Flat, &*body).unwrap();
    for (load, half_width) in [(0.2, 0.4), (0.2, 0.6), (0.1, 0.01), (1.0, 1.1)] {
        let arm = half_width / 2.0 + f64::powi(half_width, 3) / (4.0 * load);
        let tilt = half_width / 2.0 - load / half_width - (corner - half_width);
        for (edges, sign) in [
            ([Edge::Free, Edge::Fixed(corner)], 1.0),
            ([Edge::Free, Edge::FreeUntil(corner)], 1.0),
            ([Edge::Fixed(-corner), Edge::Free], -1.0),
            ([Edge::FreeUntil(-corner), Edge::Free], -1.0),
        ] {
            let contact = contact.clone().edges(edges[0], edges[1]);
            let control = Control::CentreOfPressure { load, at: sign * (corner - arm) };
            let solution = contact.solve(control).unwrap_or_else(|error| panic!("{error}"));
            near(solution.hull().half_width(), half_width, half_width, "half-width");
            near(solution.tilt(), sign * tilt, 1.0 + tilt.abs(), "tilt");
            let slope = solution.tilt();
            let turned = graph(-3.0, 3.0, move |x| [x * x / 2.0 + slope * x, x + slope]);
            let known = Contact::new(&Flat, &*turned).unwrap().edges(edges[0], edges[1]);
            assert_same(&solution, &known.solve(Control::Load(load)).unwrap(), 1e-12);
        }
    }
}

/// Next to a corner the rounding of a limit, over its distance from there, is not left in the
/// moment, nor in the tilt: without a tilt the moment is that of the load by itself.
#[test]
fn the_moment_of_a_limit_beside_a_corner() {
    let (radius, x) = (20.0f64, 0.25f64);
    let root = (radius * radius - x * x).sqrt();
    let wall = Outline::from([x - 0.005, radius - root + 0.5]).corner(-100.0).line(0.005);
    let body = wall.corner(x / root).arc(radius, 7.75).build().unwrap();
    let contact = Contact::new(&Flat, &body).unwrap().contact_modulus(115e3);
    for load in [30.0, 300.0] {
        let alone = contact.solve(Control::Load(load)).unwrap();
        let turned = contact.solve(moment(load, alone.moment().unwrap())).unwrap();
        let (on, due) = (turned.hull(), alone.hull());
        near(on.right, due.right, due.half_width(), "a");
        near(on.left, due.left, due.half_width(), "-b");
        near(turned.tilt(), 0.0, 1.0, "tilt");
    }
}

/// Bodies with two corners, of which one, both or none hold the contact.
#[test]
fn corners_hold_as_the_load_moves() {
    let body = parabola(3.0);
    let contact = Contact::new(&Flat, &*body).unwrap();
    let contact = contact.edges(Edge::FreeUntil(-0.5), Edge::FreeUntil(0.3));
    let mut solver = Solver::new();
    let mut held = [0; 4];
    for load in [0.01, 0.05, 0.2] {
        for at in [-0.45, -0.3, -0.2, -0.1, 0.0, 0.1, 0.2, 0.25] {
            let control = Control::CentreOfPressure { load, at };
            let solution = solver.solve(&contact, control).unwrap();
            let on = solution.hull();
            assert!(on.left >= -0.5 - 1e-15 && on.right <= 0.3 + 1e-15);
            held[usize::from(on.left == -0.5) + 2 * usize::from(on.right == 0.3)] += 1;
            let Ends { left: k_b, right: k_a } = solution.edge_singularities();
            assert!(k_b > -1e-14 && k_a > -1e-14, "{load} {at}");
            near(solution.centre_of_pressure().unwrap(), at, 1.0, "centre of pressure");
            let slope = solution.tilt();
            let turned = graph(-3.0, 3.0, move |x| [x * x / 2.0 + slope * x, x + slope]);
            let known = Contact::new(&Flat, &*turned).unwrap();
            let known = known.edges(Edge::FreeUntil(-0.5), Edge::FreeUntil(0.3));
            assert_same(&solution, &known.solve(Control::Load(load)).unwrap(), 1e-12);
        }
    }
    assert!(held.iter().all(|&count| count > 0), "{held:?}");
}

fn quartic(tilt: f64) -> Profile {
    graph(-3.0, 3.0, move |x| {
        let square = x * x;
        [square * (square - 2.0) + tilt * x, 4.0 * x * (square - 1.0) + tilt]
    })
}

#[test]
fn two_contacts_under_a_moment() {
    let body = quartic(0.0);
    let contact = Contact::new(&Flat, &*body).unwrap().contact_modulus(1.0);
    let mut counts = [0; 2];
    for load in [0.1, 1.0, 3.0, 4.0] {
        for arm in [0.0, 1e-3, 0.1, -0.5, 0.9, -1.1] {
            let control = Control::Moment { load, moment: load * (arm + 0.2), about: -0.2 };
            let solution = contact.solve(control).unwrap_or_else(|e| panic!("{load} {arm}: {e}"));
            assert!(solution.report().is_checked());
            let known = quartic(solution.tilt());
            let known = Contact::new(&Flat, &*known).unwrap().contact_modulus(1.0);
            let due = known.solve(Control::Load(load)).unwrap();
            assert_same(&solution, &due, 1e-11);
            near(due.centre_of_pressure().unwrap(), arm, 100.0, "centre of pressure");
            near(solution.centre_of_pressure().unwrap(), arm, 100.0, "centre of pressure");
            if solution.intervals().len() == 1 {
                solution.certify().unwrap();
            }
            counts[solution.intervals().len() - 1] += 1;
        }
    }
    assert!(counts[0] > 3 && counts[1] > 3, "{counts:?}");
}

#[test]
fn a_change_of_tilt_samples_nothing() {
    let (body, load) = (parabola(3.0), 0.02);
    let contact = Contact::new(&Flat, &*body).unwrap();
    let plain = contact.solve(Control::Load(load)).unwrap().cost();
    let turned = contact.solve(moment(load, 0.0)).unwrap().cost();
    assert!(turned.samples <= plain.samples, "{turned:?} {plain:?}");
    let two = quartic(0.0);
    let contact = Contact::new(&Flat, &*two).unwrap().contact_modulus(1.0);
    let plain = contact.solve(Control::Load(1.0)).unwrap().cost();
    let turned = contact.solve(moment(1.0, 0.01)).unwrap().cost();
    let all = |cost: linecontact::Cost| cost.evaluations + cost.heights;
    assert!(all(turned) <= 3 * all(plain), "{turned:?} {plain:?}");
}

/// Two rough bodies, and their mirror image.
#[test]
fn mirror_images() {
    let rough = |sign: f64| {
        graph(-2.0, 2.0, move |x| {
            let x = sign * x;
            let y = 0.5 * x * x + 0.05 * (7.0 * x + 0.4).sin();
            [y, sign * (x + 0.35 * (7.0 * x + 0.4).cos())]
        })
    };
    let [one, other] = [rough(1.0), rough(-1.0)];
    let [one, other] = [&one, &other].map(|body| Contact::new(&Flat, &**body).unwrap());
    let mut several = 0;
    for load in [1e-4, 0.01, 0.1, 0.5] {
        for arm in [-0.7, -0.1, 0.0, 0.3] {
            let [a, b] = [(&one, 1.0), (&other, -1.0)].map(|(contact, sign)| {
                let control = moment(load, sign * load * arm);
                contact.solve(control).unwrap_or_else(|error| panic!("{load} {arm}: {error}"))
            });
            near(a.tilt(), -b.tilt(), 10.0, "tilt");
            let mirrored: Vec<_> = intervals(&b)
                .into_iter()
                .rev()
                .map(|Interval { left, right }| Interval { left: -right, right: -left })
                .collect();
            for (on, other) in intervals(&a).iter().zip(&mirrored) {
                near(on.left, other.left, 10.0, "left");
                near(on.right, other.right, 10.0, "right");
            }
            several += usize::from(a.intervals().len() > 1);
            near(a.centre_of_pressure().unwrap(), arm, 10.0, "centre of pressure");
        }
    }
    assert!(several > 2);
}

#[test]
fn a_centre_of_pressure_is_a_moment() {
    let body = parabola(3.0);
    let contact = Contact::new(&Flat, &*body).unwrap();
    for (load, at, about) in [(0.1, 0.2, 0.0), (0.3, -1.0, 2.0), (1e-3, 0.5, -7.0)] {
        let one = contact.solve(Control::CentreOfPressure { load, at }).unwrap();
        let other = Control::Moment { load, moment: load * (at - about), about };
        let other = contact.solve(other).unwrap();
        near(one.a(), other.a(), 10.0, "a");
        near(one.b(), other.b(), 10.0, "b");
        near(one.tilt(), other.tilt(), 10.0, "tilt");
    }
}

/// A solver that turns the bodies back and forth returns to the first result, to the last bit.
#[test]
fn solves_in_a_row() {
    let body = graph(-1.2, 1.2, |x| [x.cosh() - 1.0, x.sinh()]);
    let contact = Contact::new(&Flat, &*body).unwrap();
    let mut solver = Solver::new();
    let load = Control::Load(0.1);
    solver.solve(&contact, load).unwrap();
    let key = |solution: Solution<f64>| {
        let pressure = solution.pressure().unwrap().at(0.05).unwrap();
        [solution.a(), solution.b(), solution.tilt(), pressure]
    };
    let first = key(solver.solve(&contact, load).unwrap());
    for i in 0..20 {
        let turned = solver.solve(&contact, moment(0.1, 1e-5 * f64::from(i))).unwrap();
        assert!(turned.cost().evaluations == 0, "{i}: {:?}", turned.cost());
        let cold = contact.solve(moment(0.1, 1e-5 * f64::from(i))).unwrap();
        near(turned.tilt(), cold.tilt(), 1.0, "tilt");
        near(turned.a(), cold.a(), 1.0, "a");
    }
    for _ in 0..2 {
        solver.solve(&contact, load).unwrap();
    }
    let again = key(solver.solve(&contact, load).unwrap());
    assert_eq!(again[2], 0.0);
    assert_relative_eq!(again[..], first[..], epsilon = 0.0, max_relative = 4e-15);
}

#[test]
fn single_precision() {
    let body = Parabola::new(1.0f32, [-3.0, 3.0]).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap();
    let solution = contact.solve(Control::Moment { load: 0.02, moment: 0.01, about: 0.0 }).unwrap();
    assert_relative_eq!(solution.tilt(), -0.5f32, epsilon = 0.0, max_relative = 1e-5);
    assert_relative_eq!(solution.a(), 0.7f32, epsilon = 0.0, max_relative = 1e-5);
}

#[test]
fn what_cannot_be() {
    let body = parabola(1.0);
    let contact = Contact::new(&Flat, &*body).unwrap();
    let error = |contact: &Contact<f64>, control| contact.solve(control).err().unwrap();
    let given = |load, at| Control::CentreOfPressure { load, at };
    for load in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        for control in [given(load, 0.1), moment(load, 0.1)] {
            assert!(matches!(
                error(&contact, control),
                ContactError::Input(InputError::InvalidLoad { .. })
            ));
        }
    }
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for (control, named) in [
            (given(0.1, bad), "centre of pressure"),
            (moment(0.1, bad), "moment"),
            (
                Control::Moment { load: 0.1, moment: 0.1, about: bad },
                "place that the moment is about",
            ),
        ] {
            assert!(matches!(
                error(&contact, control),
                ContactError::Input(InputError::InvalidMoment { quantity, .. }) if quantity == named
            ));
        }
    }
    // Beyond the body, and so close to its end that there is no space for the contact.
    let ends = Ends { left: -1.0, right: 1.0 };
    for control in [given(0.5, 1.5), moment(0.5, 0.75)] {
        let beyond = SolveError::LoadBeyondBodies { load: 0.5, at: 1.5, ends };
        assert_eq!(error(&contact, control), ContactError::Solve(beyond));
    }
    for (load, at) in [(0.1, 0.9), (0.02, -0.95), (0.4, 0.5)] {
        match error(&contact, given(load, at)) {
            ContactError::Solve(SolveError::TiltNotFound {
                load: asked,
                at: place,
                reached,
                tilt,
                ends,
            }) => {
                assert_eq!((asked, place, ends), (load, at, Ends { left: -1.0, right: 1.0 }));
                // The contact of half-width L = sqrt(2 F) can be moved up to the end.
                let most = 1.0 - (2.0 * load).sqrt();
                assert_relative_eq!(reached.abs(), most, epsilon = 0.0, max_relative = 1e-3);
                assert_relative_eq!(tilt, -reached, epsilon = 0.0, max_relative = 1e-9);
            }
            error => panic!("{error}"),
        }
    }
    // More than the capacity at any tilt.
    assert!(matches!(
        error(&contact, given(2.0, 0.0)),
        ContactError::Solve(SolveError::DomainTooShort { .. })
    ));
    let no_tilt = |contact: Contact<f64>| {
        assert!(matches!(
            error(&contact, given(0.1, 0.1)),
            ContactError::Input(InputError::TiltNotSupported { .. })
        ));
    };
    no_tilt(contact.clone().edges(Edge::Adhesive(0.1), Edge::Free));
    no_tilt(contact.clone().limit_search(&Brent::DEFAULT));
    no_tilt(contact.clone().quadrature(&Midpoint::DEFAULT));
    let wanted = linecontact::EdgePressure {
        distance_a: 0.01,
        distance_b: 0.01,
        at_a: 0.0,
        at_b: 0.0,
        tolerance_a: 1e-9,
        tolerance_b: 1e-9,
    };
    let by_pressure = contact.clone().edge_pressure(wanted);
    assert!(matches!(
        error(&by_pressure, given(0.1, 0.1)),
        ContactError::Input(InputError::EdgePressureLoad)
    ));
    // At a corner that would be in tension.
    let held = contact.edges(Edge::Fixed(-0.5), Edge::Free);
    assert!(matches!(
        error(&held, given(0.1, 0.4)),
        ContactError::Solve(SolveError::LiftsOff { .. })
    ));
}

#[test]
fn kinks_and_a_curved_pair() {
    let flank = |from, to, sign: f64| {
        graph(from, to, move |x| [0.2 * sign * x + 0.3 * x * x, 0.2 * sign + 0.6 * x])
    };
    let upper = join(vec![flank(-2.0, 0.0, -1.0), flank(0.0, 2.0, 1.0)]);
    let lower = graph(-2.0, 2.0, |x| [-x.cosh() / 3.0, -x.sinh() / 3.0]);
    let contact = Contact::new(&*lower, &*upper).unwrap().kappa(FRAC_PI_2 * 3.0);
    for (load, m) in [(0.5, 0.03), (0.5, -0.1), (0.05, 0.0), (0.05, 2e-3)] {
        let solution = contact.solve(moment(load, m)).unwrap();
        near(solution.moment().unwrap(), m, 10.0 * load, "moment");
        let t = solution.tilt();
        let turned = graph(-2.0, 2.0, move |x| [-x.cosh() / 3.0 - t * x, -x.sinh() / 3.0 - t]);
        let known = Contact::new(&*turned, &*upper).unwrap().kappa(FRAC_PI_2 * 3.0);
        assert_same(&solution, &known.solve(Control::Load(load)).unwrap(), 1e-12);
    }
}

/// A load beyond a land is told so, not that the far end of the bodies carries nothing.
#[test]
fn a_load_beyond_a_land_has_no_tilt() {
    let half = Outline::from([0.0, 0.0]).line(0.5).wall(-1.0).line(0.5);
    let land = half.mirrored().build().unwrap();
    let contact = Contact::new(&land, &Flat).unwrap().contact_modulus(115e3);
    for at in [0.51f64, 0.6, 0.9] {
        let error = contact.solve(Control::CentreOfPressure { load: 1.0, at }).unwrap_err();
        let ContactError::Solve(SolveError::TiltNotFound { reached, tilt, .. }) = error else {
            panic!("{at}: {error}")
        };
        assert!((reached - 0.5).abs() < 1e-3 && tilt.abs() < 1.0f64, "{at}: {reached} {tilt}");
    }
}
