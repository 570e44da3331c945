//! Bodies with a sharp corner that the contact may or may not reach.
#![allow(missing_docs)]

use crate::common;
use crate::random_scenes::Dice;

use approx::assert_relative_eq;
use common::{Profile, graph, join, on_flat, parabola};
use linecontact::profile::{Line, Parabola, Placed, Placement};
use linecontact::{
    Contact, ContactError, Control, Curve, CurvePoint, Edge, Flat, Interval, Piecewise, Solution,
    SolveError, Solver,
};
use std::f64::consts::PI;

/// Returns the limits and a pressure.
fn key(contact: Contact<f64>, load: Control<f64>) -> [f64; 4] {
    let solution = contact.solve(load).unwrap_or_else(|error| panic!("{load:?}: {error}"));
    let x = solution.hull().at_angle(1.0);
    [solution.a(), solution.b(), solution.load(), solution.pressure().unwrap().at(x).unwrap()]
}

#[test]
fn a_contact_is_free_up_to_a_corner_and_fixed_from_then_on() {
    // The parabola reaches x = 0.3 under F = 0.3²/2 = 0.045.
    let (corner, free) = (Edge::FreeUntil(0.3), Edge::Free);
    let contact = on_flat(parabola(2.0));
    for load in [1e-8, 1e-3, 0.03, 0.0449, 0.0451, 0.06, 0.3, 0.9] {
        let reached = load > 0.045;
        let (known, mirror) = if reached {
            ([free, Edge::Fixed(0.3)], [Edge::Fixed(-0.3), free])
        } else {
            ([free, free], [free, free])
        };
        let load = Control::Load(load);
        for ([left, right], [known_left, known_right]) in
            [([free, corner], known), ([Edge::FreeUntil(-0.3), free], mirror)]
        {
            let got = key(contact.clone().edges(left, right), load);
            let known = key(contact.clone().edges(known_left, known_right), load);
            assert_relative_eq!(got[..], known[..], epsilon = 0.0, max_relative = 4e-15);
        }
    }
    // Corners on both sides: 0.3 is reached first, then, under F = L (3 L/2 - 0.3) with 2 L = 0.8,
    // the corner at -0.5.
    let critical = 0.4 * (0.6 - 0.3);
    for load in [0.01, 0.044, 0.046, 0.99 * critical, 1.01 * critical, 0.5] {
        let right = if load > 0.045 { Edge::Fixed(0.3) } else { free };
        let left = if load > critical { Edge::Fixed(-0.5) } else { free };
        let load = Control::Load(load);
        let got = key(contact.clone().edges(Edge::FreeUntil(-0.5), corner), load);
        let known = key(contact.clone().edges(left, right), load);
        assert_relative_eq!(got[..], known[..], epsilon = 0.0, max_relative = 4e-15);
    }
}

#[test]
fn a_corner_may_be_the_end_of_the_body() {
    let ends_at_corner = graph(-1.0, 0.3, |x| [x * x / 2.0, x]);
    let endless = parabola(2.0);
    let corner = |body, load| {
        let contact = Contact::new(&Flat, body).unwrap();
        key(contact.edges(Edge::Free, Edge::FreeUntil(0.3)), Control::Load(load))
    };
    for load in [1e-3, 0.0449, 0.0451, 0.2] {
        let (got, known) = (corner(&*ends_at_corner, load), corner(&*endless, load));
        assert_relative_eq!(got[..], known[..], epsilon = 0.0, max_relative = 4e-15);
    }
}

#[test]
fn a_corner_far_away_does_not_matter() {
    // A contact held at the corner would have to extend beyond the other end of the body.
    let contact = on_flat(graph(-0.25, 1.0, |x| [x * x / 2.0, x]));
    let load = Control::Load(0.005);
    let got = key(contact.clone().edges(Edge::Free, Edge::FreeUntil(0.9)), load);
    assert_relative_eq!(got[0], 0.1, epsilon = 0.0, max_relative = 4e-15);
    assert_relative_eq!(got[1], 0.1, epsilon = 0.0, max_relative = 4e-15);
}

#[test]
fn a_corner_serves_every_control() {
    let contact = on_flat(parabola(2.0)).edges(Edge::Free, Edge::FreeUntil(0.3));
    let between = contact.clone().edges(Edge::FreeUntil(-0.3), Edge::FreeUntil(0.3));
    // Hertz below the corner.
    for load in [Control::HalfWidth(0.2), Control::PeakPressure(0.2 / PI), Control::Load(0.02)] {
        for contact in [&contact, &between] {
            let solution = contact.solve(load).unwrap_or_else(|e| panic!("{load:?}: {e}"));
            assert_relative_eq!(solution.a(), 0.2, epsilon = 0.0, max_relative = 1e-12);
            assert_relative_eq!(solution.load(), 0.02, epsilon = 0.0, max_relative = 1e-12);
        }
    }
    // Held at the corner, F = L (3 L/2 - 0.3).
    let solution = contact.solve(Control::HalfWidth(0.4)).unwrap();
    assert_eq!(solution.a(), 0.3);
    assert_relative_eq!(solution.load(), 0.4 * 0.3, epsilon = 0.0, max_relative = 1e-14);
    let error = contact.solve(Control::PeakPressure(2.0 * 0.3 / PI)).unwrap_err();
    let ContactError::Solve(SolveError::PeakTooHigh { half_width, found, .. }) = error else {
        panic!("{error}")
    };
    assert_relative_eq!(half_width, 0.3, epsilon = 0.0, max_relative = 1e-12);
    assert_relative_eq!(found, 0.3 / PI, epsilon = 0.0, max_relative = 1e-12);
}

#[test]
fn a_corner_is_let_go_under_adhesion_too() {
    // At no load, and under a pull, as under the least load that presses.
    let body = parabola(1.0);
    let (corner, glued) = (Edge::FreeUntil(-0.1), Edge::Adhesive(1e-3));
    for load in [1e-9, 0.0, -1e-9, -1e-3] {
        let held = Contact::new(&Flat, &*body).unwrap().edges(corner, glued);
        let free = Contact::new(&Flat, &*body).unwrap().edges(Edge::Free, glued);
        let [held, free] =
            [&held, &free].map(|contact| contact.solve(Control::Load(load)).unwrap().hull());
        for (held, free) in [(held.left, free.left), (held.right, free.right)] {
            assert_relative_eq!(held, free, epsilon = 0.0, max_relative = 1e-12);
        }
    }
}

#[test]
fn an_edge_may_be_fixed_close_to_the_end_of_the_bodies() {
    // Half of a punch whose edge K is anywhere: the condition at the free edge, of a parabola from
    // x = s on, is F = κ L (m₁ + m₀), m₀ = c and m₁ = L/2.
    let body = parabola(1.0);
    for (s, load) in [(0.51, 0.01), (0.9, 0.01), (-0.6, 0.01)] {
        let edges =
            if s > 0.0 { [Edge::Fixed(s), Edge::Free] } else { [Edge::Free, Edge::Fixed(s)] };
        let contact = Contact::new(&Flat, &*body).unwrap().edges(edges[0], edges[1]);
        let solution = contact.solve(Control::Load(load)).unwrap();
        let l = solution.hull().half_width();
        assert_relative_eq!(l * (1.5 * l + s.abs()), load, epsilon = 0.0, max_relative = 1e-12);
    }
}

/// The double well `(x² - 1)²` touches at `sqrt(1 ± sqrt(F/(2κ)))` until the outer limits are at
/// the corners.
#[test]
fn two_contacts_grow_to_their_corners_and_leave_them() {
    let well = Curve::new([-1.5, 1.5], |k: f64| {
        let s = k * k - 1.0;
        CurvePoint { x: k, y: s * s, dx: 1.0, dy: 4.0 * k * s }
    });
    let corners = [-1.2, 1.2].map(Edge::FreeUntil);
    let contact = Contact::new(&Flat, &well).unwrap().edges(corners[0], corners[1]);
    let limits = |solution: &Solution<f64>| -> Vec<f64> {
        solution.intervals().iter().flat_map(|on| [on.left, on.right]).collect()
    };
    for loads in [&[0.3, 0.5, 0.1][..], &[1e-3, 1.0, 1e-3], &[1e-3, 0.7], &[1.0, 0.01, 0.03]] {
        let mut solver = Solver::new();
        for &load in loads {
            let solution = solver.solve(&contact, Control::Load(load)).unwrap();
            let found = limits(&solution);
            let [inner, outer] =
                [-1.0f64, 1.0].map(|sign| (1.0 + sign * f64::sqrt(load / 2.0)).sqrt());
            let due = if outer < 1.2 {
                vec![-outer, -inner, inner, outer]
            } else {
                limits(&contact.solve(Control::Load(load)).unwrap())
            };
            assert_eq!(found.len(), 4, "{loads:?} {load}: {found:?}");
            for i in 0..4 {
                let [off, askew] = [found[i] - due[i], found[i] + found[3 - i]];
                assert!(off.abs() < 1e-13 && askew.abs() < 1e-13, "{loads:?} {load}: {found:?}");
            }
        }
    }
}

/// `Fixed` corners that the load does not reach. K = (F/L - κ L/2)/π is negative there.
#[test]
fn corners_that_the_load_does_not_reach() {
    let body = Parabola::new(1.0, [-1.0, 1.0]).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap();
    for edges in [[Edge::Fixed(-0.5), Edge::Free], [Edge::Free, Edge::Fixed(0.5)]] {
        let held = contact.clone().edges(edges[0], edges[1]);
        let error = held.solve(Control::Load(0.01)).map(|s| s.hull()).unwrap_err();
        assert!(matches!(error, ContactError::Solve(SolveError::LiftsOff { .. })), "{error}");
    }
}

/// Two pads, each held at both of its corners: no limit is free but the one at the end up to which
/// the load is sought.
#[test]
fn a_peak_between_corners_is_refused() {
    // A hollow punch with a groove in the middle.
    let groove = |x: f64| (0.01 - x.abs()).max(0.0);
    let height = move |x: f64, slope: f64| CurvePoint {
        x,
        y: groove(x) - 0.01 * x * x,
        dx: 1.0,
        dy: slope - 0.02 * x,
    };
    let pieces = [(-0.5, -0.01, 0.0), (-0.01, 0.0, 1.0), (0.0, 0.01, -1.0), (0.01, 0.5, 0.0)];
    let pieces = pieces.map(|(from, to, slope)| Curve::new([from, to], move |x| height(x, slope)));
    let punch = Piecewise::new(pieces.into()).unwrap();
    let contact = on_flat(Box::new(punch)).edges(Edge::FreeUntil(-0.5), Edge::FreeUntil(0.5));
    for peak in [0.02, 0.2, 2.0] {
        let error = contact.solve(Control::PeakPressure(peak)).map(|s| s.hull()).unwrap_err();
        assert!(matches!(error, ContactError::Solve(SolveError::NoPeak { .. })), "{error}");
    }
}

/// With both corners held the left one pulls: the last contact lies between them, and the next one
/// would pass both if it were free.
#[test]
fn a_corner_that_was_passed_lets_go_if_the_other_one_holds() {
    let contact = on_flat(parabola(2.0)).edges(Edge::FreeUntil(-0.5), Edge::FreeUntil(0.5));
    for load in [0.4, 1.0, 4.0] {
        let mut solver = Solver::new();
        solver.solve(&contact, Control::CentreOfPressure { load: 0.005, at: -0.3 }).unwrap();
        let control = Control::CentreOfPressure { load, at: 0.33 };
        let [warm, cold] = [solver.solve(&contact, control), contact.solve(control)];
        let [warm, cold] = [warm.unwrap().hull(), cold.unwrap().hull()];
        assert_relative_eq!(warm.left, cold.left, epsilon = 1e-13);
        assert!(warm.left > -0.4 && [warm.right, cold.right] == [0.5; 2], "{warm:?} {cold:?}");
    }
}

/// A parabola in three pieces, and one whose outer pieces open more steeply, touch just up to the
/// joints next to ±1.
#[test]
fn a_limit_at_a_joint_is_free_unless_the_joint_is_a_corner() {
    for (jump, joint) in
        [0.0, 1e-3, 10.0].into_iter().flat_map(|jump| [1.0, 1.0 - 1e-15].map(|joint| (jump, joint)))
    {
        let side = |from: f64, to: f64, sign: f64| {
            let y = move |x: f64| x * x / 2.0 + jump * (x.abs() - joint);
            graph(from, to, move |x| [y(x), x + sign * jump])
        };
        let middle = graph(-joint, joint, |x| [x * x / 2.0, x]);
        let contact = on_flat(join(vec![side(-3.0, -joint, -1.0), middle, side(joint, 3.0, 1.0)]));
        for control in [Control::Load(0.5), Control::HalfWidth(1.0)] {
            let solution = contact.solve(control).unwrap();
            let hull = solution.hull();
            assert!(
                (hull.left + 1.0).abs() < 1e-13 && (hull.right - 1.0).abs() < 1e-13,
                "{hull:?}"
            );
            let [region] = solution.contacts().unwrap()[..] else { panic!("{solution}") };
            let is_held = region.held.left || region.held.right;
            assert!(jump > 0.0 || !is_held, "{control:?}: {solution}");
            assert!(solution.limits_error().unwrap() < 1e-12, "{solution}");
        }
    }
}

/// A tooth on one of four crests, whose tip makes the potential of its contact vaguer than its
/// series tell. (The potentials left an overlap beside the tooth.)
#[test]
fn a_tooth_on_a_crest() {
    let (w, slope, at) = (0.02108533334896626, -0.02779020308149826, 0.28);
    let tooth = |from: f64, to: f64, side: f64| {
        graph(from, to, move |x| {
            let (sin, cos) = (2.0 * PI / 0.6 * x).sin_cos();
            let height = if side == 0.0 { 0.0 } else { slope * (w - (x - at).abs()) };
            let wave = [0.002 * (1.0 + cos), -0.002 * 2.0 * PI / 0.6 * sin];
            [wave[0] + height, wave[1] + slope * side]
        })
    };
    let parts = [(-1.0, at - w, 0.0), (at - w, at, 1.0), (at, at + w, -1.0), (at + w, 1.0, 0.0)];
    let body = join(parts.map(|(from, to, side)| tooth(from, to, side)).into());
    let contact = Contact::new(&Flat, &*body).unwrap().contact_modulus(1e5);
    let solution = contact.solve(Control::Load(120.0)).unwrap();
    assert_eq!(solution.intervals().len(), 5);
    assert!(solution.certify().unwrap().is_proved());
}

/// Returns a polygon through points.
pub fn polygon(points: &[[f64; 2]]) -> Profile {
    let sides = points.windows(2).map(|ends| -> Profile {
        let [[from, y], [to, end]] = [ends[0], ends[1]];
        let side = Line::new((end - y) / (to - from), [0.0, to - from]).unwrap();
        Box::new(Placed::new(side, Placement::default().shifted(from, y)).unwrap())
    });
    Box::new(Piecewise::with_tolerance(sides.collect(), 1e-12).unwrap())
}

/// A limit next to a hollow corner is not held at a corner beyond the next contact, and a gap too
/// narrow to be told is none.
#[test]
fn a_shallow_hollow_corner_is_closed_by_a_load() {
    let points = [[-2.0, 1.93994], [-0.4699, 0.08393], [-0.43097, 0.08823]];
    let others = [[0.63288, 0.1876], [0.68485, 0.26101], [2.0, 1.97621]];
    let contact = on_flat(polygon(&[&points[..], &others[..]].concat()));
    let mut counts = Vec::new();
    for i in 0..=60 {
        let load = 0.004 * 250f64.powf(f64::from(i) / 60.0);
        let solution = contact.solve(Control::Load(load));
        let solution = solution.unwrap_or_else(|error| panic!("{load}: {error}"));
        counts.push(solution.intervals().len());
    }
    counts.dedup();
    assert_eq!(counts, [2, 1, 2, 1]);
}

/// Bodies of random flat sides, with hollow corners of any depth; `SCENES=n` in the environment
/// sets their number.
#[test]
fn random_polygons_touch_under_any_load() {
    let scenes = std::env::var("SCENES").map_or(40, |n| n.parse().unwrap());
    let mut refused = 0;
    // The others were refused, or wrong.
    for seed in (0..scenes).chain([60, 87, 116, 157, 207]) {
        let mut dice = Dice::new(seed);
        let sides = 5 + (6.0 * dice.uniform()) as usize;
        let rough = dice.power_of_ten(-4.0, -1.5);
        let mut x: Vec<f64> = (1..sides).map(|_| dice.within(-1.0, 1.0)).collect();
        x.extend([-2.0, 2.0]);
        x.sort_by(f64::total_cmp);
        let points: Vec<_> = x.iter().map(|x| [*x, x * x / 2.0 + rough * dice.normal()]).collect();
        let contact = on_flat(polygon(&points));
        let (mut solver, mut last) = (Solver::new(), Interval { left: 2.0, right: -2.0 });
        for i in 0..12 {
            let scene = format!("{seed}, {i}");
            let load = Control::Load(0.003 * 266f64.powf(f64::from(i) / 11.0));
            let (cold, warm) = match (contact.solve(load), solver.solve(&contact, load)) {
                (Ok(cold), Ok(warm)) => (cold, warm),
                (cold, warm) => {
                    let error = cold.err().or(warm.err()).unwrap();
                    println!("{scene}: {error}");
                    refused += 1;
                    continue;
                }
            };
            let [on, of_warm] = [cold.hull(), warm.hull()];
            let off = (on.left - of_warm.left).abs().max((on.right - of_warm.right).abs());
            assert!(off < 1e-9 && cold.limits_error() < Some(1e-9), "{scene}: {cold}, warm {warm}");
            // Under more load the contact is wider.
            let grows = on.left <= last.left + 1e-12 && on.right >= last.right - 1e-12;
            assert!(grows, "{scene}: {cold}");
            last = on;
            if i % 4 == 0 {
                cold.certify().unwrap_or_else(|error| panic!("{scene}: {error}"));
            }
        }
    }
    assert!(refused <= scenes * 12 / 2000, "{refused} refused");
}
