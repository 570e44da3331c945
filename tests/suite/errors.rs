//! Every invalid scene ends in an error with its place and its reason.
#![allow(missing_docs)]

use crate::common;

use approx::assert_relative_eq;
use common::{Counting, NanSafe, graph, on_flat, parabola};
use linecontact::profile::{Line, Outline, Parabola, Placed, Placement};
use linecontact::search::{Brent, SearchError, StoppingCriteria};
use linecontact::{
    Attempt, Base, Body, Contact, ContactError, Control, Cost, Curve, CurvePoint, Edge,
    EdgePressure, Flat, Foundation, InputError, Interval, Layer, Material, Midpoint, Outcome,
    ParametricProfile, Piecewise, PlaneState, ProfileError, Reference, References, SolveError,
    Start,
};
use proptest::prelude::*;
use proptest::test_runner::{RngSeed, TestRunner};
use std::cell::Cell;
use std::f64::consts::PI;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

fn error(
    lower: &dyn ParametricProfile<f64>,
    upper: &dyn ParametricProfile<f64>,
    load: f64,
) -> ContactError<f64> {
    let contact = Contact::new(lower, upper);
    contact.and_then(|contact| contact.solve(Control::Load(load)).map(|_| ())).unwrap_err()
}

#[test]
fn a_load_too_large_for_the_domain() {
    // A parabola that extends to x = ±1 carries F = 1/2 at most.
    for load in [0.51, 2.0, 1e10, 1e300] {
        let ContactError::Solve(SolveError::DomainTooShort { end, carried, load: asked, .. }) =
            error(&Flat, &*parabola(1.0), load)
        else {
            panic!("load {load}")
        };
        assert_eq!((end.abs(), asked), (1.0, load));
        assert!((carried / 0.5 - 1.0).abs() < 1e-12, "{carried}");
    }
    // Short on one side only: the contact reaches that side first.
    let short = |left, right| graph(left, right, |x| [x * x / 2.0, x]);
    for (left, right, end) in [(-0.3, 5.0, -0.3), (-5.0, 0.2, 0.2)] {
        let ContactError::Solve(SolveError::DomainTooShort { end: reached, carried, .. }) =
            error(&Flat, &*short(left, right), 0.32)
        else {
            panic!("[{left}, {right}]")
        };
        assert_eq!(reached, end);
        // A symmetric contact that fits: F = L²/2.
        assert!((carried / (end * end / 2.0) - 1.0).abs() < 1e-9, "{carried}");
    }
    // Held at a corner: K = 0 at the other edge, F = L (3 L/2 + x₀).
    let body = parabola(1.0);
    let contact = Contact::new(&Flat, &*body).unwrap();
    for (x0, edges) in
        [(-0.3, [Edge::Fixed(-0.3), Edge::Free]), (0.1, [Edge::Free, Edge::Fixed(-0.1)])]
    {
        let held = contact.clone().edges(edges[0], edges[1]);
        let error = held.solve(Control::Load(2.0));
        let Err(ContactError::Solve(SolveError::DomainTooShort { end, carried, .. })) = error
        else {
            panic!("{error:?}")
        };
        let l = 0.5 * (1.0 - x0);
        assert_eq!(end, if x0 < 0.0 { 1.0 } else { -1.0 });
        assert!((carried / (l * (1.5 * l + x0)) - 1.0).abs() < 1e-13, "{carried}");
    }
    // Exactly the largest load.
    let contact = on_flat(parabola(1.0));
    assert!((contact.solve(Control::Load(0.5 * (1.0 - 1e-12))).unwrap().a() - 1.0).abs() < 1e-12);
}

#[test]
fn a_load_too_large_on_the_gentle_side() {
    // A wedge on one side of 0: g = x, less by s at x < 0. With cos θ₀ = -c/L it is in balance if π
    // c = s (π - θ₀), and carries F = L²/2 + s L sin θ₀/π. It reaches x = 1 first: c = 1 - L.
    let steep_side = |s: f64| graph(-1.0, 0.0, move |x| [x * x / 2.0 - s * x, x - s]);
    let mirrored = |s: f64| graph(0.0, 1.0, move |x| [x * x / 2.0 + s * x, x + s]);
    let gentle = |from, to| graph(from, to, |x| [x * x / 2.0, x]);
    for s in [0.3, 10.0, 1e3] {
        let angle = |half_width: f64| (1.0 - 1.0 / half_width).acos();
        let (mut low, mut high) = (0.5, 1.0);
        for _ in 0..60 {
            let l = 0.5 * (low + high);
            let balanced = PI * (1.0 - l) > s * (PI - angle(l));
            if balanced { low = l } else { high = l }
        }
        let most = low * low / 2.0 + s * low * angle(low).sin() / PI;
        let right = common::join(vec![steep_side(s), gentle(0.0, 1.0)]);
        let left = common::join(vec![gentle(-1.0, 0.0), mirrored(s)]);
        for times in [1.01, 1.5, 3.0, 10.0, 100.0] {
            for (body, wanted) in [(&right, 1.0), (&left, -1.0)] {
                let error = error(&Flat, &**body, times * most);
                let ContactError::Solve(SolveError::DomainTooShort { end, carried, .. }) = error
                else {
                    panic!("{s} {times}: {error}")
                };
                assert_eq!(end, wanted, "{s} {times}");
                assert!((carried / most - 1.0).abs() < 1e-8, "{s} {times}: {carried} {most}");
            }
        }
    }
}

#[test]
fn bodies_that_do_not_meet() {
    let parabola_at = |from, to| graph(from, to, |x| [x * x / 2.0, x]);
    // Upside down: the gap closes away from x = 0.
    let inverted = error(&*parabola(1.0), &Flat, 0.1);
    assert!(
        matches!(inverted, ContactError::Solve(SolveError::NoFirstContact { .. })),
        "{inverted}"
    );
    // Flat on flat: no edge anywhere.
    let level = graph(-1.0, 1.0, |_| [0.0, 0.0]);
    let flat = error(&Flat, &*level, 0.1);
    assert!(matches!(flat, ContactError::Solve(SolveError::NoFirstContact { .. })), "{flat}");
    // The lowest point lies beyond the domain.
    let beyond = error(&Flat, &*parabola_at(0.1, 1.0), 0.1);
    assert!(matches!(beyond, ContactError::Solve(SolveError::NoFirstContact { .. })), "{beyond}");
    // A gap that leads down to one end: the slopes are those at both.
    for slope in [0.1, -0.1] {
        let leads_down = error(&Flat, &Line::new(slope, [-1.0, 1.0]).unwrap(), 0.1);
        let says =
            format!("its slope is {slope} at x = -1 and {slope} at x = 1; this gap leads down");
        assert!(leads_down.to_string().contains(&says), "{leads_down}");
    }
}

/// Heights that underflow are all alike, but the bodies are not parallel.
#[test]
fn heights_below_the_smallest_number() {
    for (end, radius) in [(1e-308, 1.0), (1e-310, 1.0), (1e-200, 1e-200), (1.0, 1e308)] {
        let body = graph(-end, end, move |x| [x * x / (2.0 * radius), x / radius]);
        let error = error(&Flat, &*body, 1.0);
        let ContactError::Solve(SolveError::NoFirstContact { slope, .. }) = error else {
            panic!("{end} {radius}: {error}")
        };
        assert!(slope[0] < 0.0 && slope[1] > 0.0, "{slope:?}");
        assert!(error.to_string().contains("below the smallest normal number"), "{error}");
    }
    // Flats are parallel, however small their heights.
    for height in [0.0, 1e-308, 1e-320] {
        let error = error(&Flat, &*graph(-1.0, 1.0, move |_| [height, 0.0]), 1.0);
        assert!(error.to_string().contains("parallel"), "{height}: {error}");
    }
}

#[test]
fn a_spent_budget_carries_the_best_limits() {
    let body = graph(-1.0, 1.0, |x| [x * x / 2.0 + x.powi(3) / 5.0, x + 0.6 * x * x]);
    let hasty =
        Brent { tolerance: StoppingCriteria { max_evaluations: 2, ..StoppingCriteria::FULL } };
    let contact = Contact::new(&Flat, &*body).unwrap().limit_search(&hasty);
    let error = contact.solve(Control::Load(0.03)).unwrap_err();
    let ContactError::Solve(SolveError::LimitSearch { best, source: SearchError::Budget { .. } }) =
        error
    else {
        panic!("{error}")
    };
    assert!((best.half_width() / 0.24 - 1.0).abs() < 0.5, "{best:?}");
}

/// Any value of any number: no panic, no endless loop, and Hertz's contact or an error.
#[test]
fn no_input_is_fatal() {
    let any = prop::num::f64::ANY;
    let numbers = (any, 0..8usize, -60..60i32, -60..60i32, -60..60i32, 0..6, 0.0..1.0f64);
    let config = ProptestConfig {
        rng_seed: RngSeed::Fixed(7),
        failure_persistence: None,
        cases: 1000,
        ..ProptestConfig::default()
    };
    let solved = Cell::new(0);
    let check =
        |(any, which, width, curvature, stiffness, mode, share): (_, _, i32, i32, i32, _, _)| {
            let two = |power: i32| 2f64.powi(power);
            let (l, bend, kappa) = (two(width), two(curvature), two(stiffness));
            let reach = l * (1.1 + 9.0 * share);
            let load = kappa * bend * l * l / 2.0;
            // Parameters of Hertz's contact, one of them replaced by any value.
            let mut scene = [load, kappa, bend, reach, -2.0 * l * share, l, 0.01 * l, 1e-6 * kappa];
            scene[which] = any;
            let [load, kappa, bend, reach, left, right, distance, tolerance] = scene;
            let body = graph(-reach, 0.9 * reach, move |x| [bend * x * x / 2.0, bend * x]);
            let Ok(contact) = Contact::new(&Flat, &*body) else { return Ok(()) };
            let rule = Midpoint {
                segments: 9,
                extrapolations: 2,
                exponents: linecontact::Exponents::Even,
            };
            let contact = if mode % 2 == 0 { contact.quadrature(&rule) } else { contact };
            let contact = match mode / 2 {
                0 => contact,
                1 => contact.start(Interval { left, right }),
                _ => contact.edge_pressure(EdgePressure::zero(distance, tolerance)),
            };
            let contact = contact.kappa(kappa);
            if let Ok(solution) = contact.solve(Control::Load(load)) {
                let exact = (2.0 * load).sqrt() / kappa.sqrt() / bend.sqrt();
                let hull = solution.hull();
                prop_assert!(hull.left.is_finite() && hull.right.is_finite());
                prop_assert!(hull.left < hull.right || solution.is_apart() && load == 0.0);
                if mode / 2 < 2 && exact.is_normal() {
                    let off =
                        (hull.right / exact - 1.0).abs().nan_max((hull.left / exact + 1.0).abs());
                    prop_assert!(off < 1e-13, "{hull:?} {exact:e}, of {scene:?}");
                }
                solved.set(solved.get() + 1);
            }
            Ok(())
        };
    TestRunner::new(config).run(&numbers, check).unwrap();
    println!("{} solved", solved.get());
    assert!(solved.get() > 400, "{}", solved.get());
}

proptest! {
    #![proptest_config(ProptestConfig {
        rng_seed: RngSeed::Fixed(7),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    /// A parabola of any curvature under any load is Hertz's, or does not fit.
    #[test]
    fn hertz_at_any_scale(
        load in -80..80i32, kappa in -80..80i32, curvature in -80..80i32, reach in -80..80i32,
        fraction in 1.0..2.0f64,
    ) {
        let two = |i: i32| 2f64.powi(i);
        let bend = two(curvature);
        let reach = two(reach);
        let contact = on_flat(graph(-reach, 1.3 * reach, move |x| [bend * x * x / 2.0, bend * x])).kappa(two(kappa));
        let load = fraction * two(load);
        let exact = (2.0 * load / two(kappa) / bend).sqrt();
        match contact.solve(Control::Load(load)) {
            Ok(solution) => {
                prop_assert!((solution.a() / exact - 1.0).abs() < 4e-15, "{:?} {}", solution, exact);
                prop_assert!((solution.b() / exact - 1.0).abs() < 4e-15, "{:?} {}", solution, exact);
            }
            Err(error) => {
                prop_assert!(exact > reach * (1.0 - 1e-12), "{} at {}", error, exact);
                let too_short = matches!(error, ContactError::Solve(SolveError::DomainTooShort { .. }));
                prop_assert!(too_short, "{}", error);
            }
        }
    }
}

#[test]
fn a_profile_that_fails_where_the_bodies_touch_first_is_named() {
    let failing = graph(-1.0, 1.0, |x| {
        let y = x * x / 2.0;
        [y, if (x - 0.07).abs() < 1e-3 { f64::NAN } else { x - 0.07 }]
    });
    let brent = Brent::default();
    let contact = Contact::new(&Flat, &*failing).unwrap().limit_search(&brent);
    for start in [[-0.5, 0.9], [-0.8, 0.3], [-0.2, 0.9]] {
        let contact = contact.clone().start(Interval { left: start[0], right: start[1] });
        let error = contact.solve(Control::Load(0.1)).unwrap_err();
        let ContactError::Input(InputError::Profile {
            source: ProfileError::NotFinite { k, .. },
            ..
        }) = error
        else {
            panic!("{error}")
        };
        assert!((k - 0.07).abs() < 1e-3, "{k}");
    }
}

#[test]
fn a_profile_that_fails_after_a_while_is_named_under_a_given_peak() {
    use std::sync::atomic::{AtomicUsize, Ordering};
    let (mut found, mut failed) = (0, 0);
    for most in (0..3000).step_by(17) {
        let calls = AtomicUsize::new(0);
        let body = Curve::new([-1.0, 1.0], |k: f64| {
            let dy = if calls.fetch_add(1, Ordering::Relaxed) < most { k } else { f64::NAN };
            CurvePoint { x: k, y: k * k / 2.0, dx: 1.0, dy }
        });
        let Ok(contact) = Contact::new(&Flat, &body) else { continue };
        match contact.solve(Control::PeakPressure(0.2)) {
            Ok(solution) => {
                found += 1;
                assert!((solution.a() / (0.2 * std::f64::consts::PI) - 1.0).abs() < 1e-12);
            }
            Err(error) => {
                failed += 1;
                let named = matches!(
                    error,
                    ContactError::Input(InputError::Profile {
                        source: ProfileError::NotFinite { .. },
                        ..
                    })
                );
                assert!(named, "{most}: {error}");
            }
        }
    }
    assert!(found > 0 && failed > 0, "{found} {failed}");
}

#[test]
fn a_slope_given_by_x_that_fails_is_named() {
    struct Graph;
    impl ParametricProfile<f64> for Graph {
        fn domain(&self) -> [f64; 2] {
            [-1.0, 1.0]
        }
        fn at(&self, k: f64) -> CurvePoint<f64> {
            CurvePoint { x: k, y: k * k / 2.0, dx: 1.0, dy: k }
        }
        fn slope_at(&self, x: f64) -> Option<f64> {
            Some(if x > 0.15 { f64::NAN } else { x })
        }
    }
    let error = error(&Flat, &Graph, 0.1);
    let ContactError::Input(InputError::Profile {
        body: Body::Upper,
        source: ProfileError::NotFinite { quantity, k, value },
    }) = error
    else {
        panic!("{error}")
    };
    assert!(quantity == "slope_at(x)" && k > 0.15 && value.is_nan(), "{quantity} {k}");
}

#[test]
fn a_profile_that_fails_under_a_pull_is_named() {
    let glued = Edge::Adhesive(1e-3);
    let failing =
        graph(-1.0, 1.0, |x| [x * x / 2.0, if x > 0.05 && x < 0.5 { f64::NAN } else { x }]);
    let contact = Contact::new(&Flat, &*failing).unwrap().edges(glued, glued);
    let error = contact.solve(Control::Load(-1e-3)).unwrap_err();
    let ContactError::Input(InputError::Profile {
        source: ProfileError::NotFinite { k, .. }, ..
    }) = error
    else {
        panic!("{error}")
    };
    assert!(k > 0.05 && k < 0.5, "{k}");
}

#[test]
fn a_spent_budget_of_a_peak_carries_the_best_limits() {
    let contact = on_flat(common::power(3.0));
    let exact = contact.solve(Control::PeakPressure(0.1)).unwrap().a();
    // The load is a power of the width: on its logarithm one evaluation would do.
    let hasty =
        Brent { tolerance: StoppingCriteria { max_evaluations: 0, ..StoppingCriteria::FULL } };
    let error = contact.limit_search(&hasty).solve(Control::PeakPressure(0.1)).unwrap_err();
    let ContactError::Solve(SolveError::LimitSearch { best, source: SearchError::Budget { .. } }) =
        error
    else {
        panic!("{error}")
    };
    assert!((best.half_width() / exact - 1.0).abs() < 0.5, "{best:?} {exact}");
}

/// Failures of the floating-point range, not of the contact.
#[test]
fn distances_and_loads_that_numbers_cannot_hold() {
    let contact = on_flat(parabola(1.0));
    for distance in [1e-20, 1e-300] {
        for contact in [contact.clone(), contact.clone().quadrature(&Midpoint::DEFAULT)] {
            let contact = contact.edge_pressure(EdgePressure::zero(distance, 1e-6));
            let error = contact.solve(Control::Load(0.01)).map(|_| ()).unwrap_err();
            assert_eq!(
                error,
                ContactError::Input(InputError::InvalidEdgePressure {
                    name: "ε_a",
                    value: distance
                })
            );
        }
    }
    let held = contact.edges(Edge::Fixed(-0.1), Edge::Fixed(0.1));
    let alone = held.clone().single_interval(true);
    for (held, load) in [(&held, 1e308), (&alone, 1e308), (&alone, -1e308), (&held, f64::MAX)] {
        let error = held.solve(Control::Load(load)).map(|_| ()).unwrap_err();
        assert!(matches!(error, ContactError::Solve(SolveError::Overflow { .. })), "{error}");
    }
    // P = F/(π sqrt(L² - x²)), next to which the effect of the parabola is negligible.
    let pressure = held.solve(Control::Load(1e300)).unwrap().pressure().unwrap().at(0.06).unwrap();
    let exact = 1e300 / (std::f64::consts::PI * 0.08);
    assert!((pressure / exact - 1.0).abs() < 1e-14, "{pressure:e}");
}

/// A step of Y that does not show in the slopes. Heights may have a large offset.
#[test]
fn a_step_of_the_heights() {
    let with = |at: f64, step: f64, from: f64| {
        graph(-1.0, 1.0, move |x| [from + x * x / 2.0 + if x > at { step } else { 0.0 }, x])
    };
    for load in [0.02, 0.001] {
        for from in [0.0, 1e4, 1e8] {
            let body = with(0.0, 0.0, from);
            let solution = Contact::new(&Flat, &*body).unwrap().solve(Control::Load(load)).unwrap();
            assert_relative_eq!(solution.a(), (2.0 * load).sqrt(), max_relative = 1e-14);
            assert_eq!(solution.cost().evaluations, 8);
            solution.certify().unwrap();
        }
        // An error in every solve if the step lies within the contact, or outside it and the bodies
        // would overlap; elsewhere only a certificate finds it.
        for at in [0.0, 0.03, -0.0123, 0.044, 0.0711, 0.5, -0.777] {
            for (step, from) in [(1e-4, 0.0), (-1e-3, 0.0), (0.01, 0.0), (0.01, 1e4)] {
                let body = with(at, step, from);
                let solved = Contact::new(&Flat, &*body).unwrap().solve(Control::Load(load));
                let seen = f64::abs(at) < (2.0 * load).sqrt();
                let at_once = solved.is_err();
                let overlaps = step < 0.0 && at == 0.0711;
                let expected = seen || overlaps;
                assert!(at_once == expected || step == 1e-4 && !at_once, "{step} at {at}");
                let error = solved.and_then(|found| found.certify().map(|_| ())).unwrap_err();
                let ContactError::Input(InputError::InconsistentHeights {
                    between: [one, two],
                    by_heights,
                    by_slopes,
                }) = error
                else {
                    panic!("{step} at {at}: {error}")
                };
                assert!(one.min(two) <= at && at <= one.max(two), "{step} at {at}: {error}");
                let found = (by_heights - by_slopes) * (two - one).signum();
                assert!((found / step - 1.0).abs() < 1e-6, "{step} at {at}: {error}");
                assert!(!at_once || two - one < 1e-3, "{step} at {at}: {error}");
            }
        }
    }
    // A steep ramp between the nodes is resolved.
    let ramp = |step: f64| {
        graph(-1.0, 1.0, move |x| {
            let t = (1e3 * (x - 0.07)).tanh();
            [x * x / 2.0 + step * t, x + 1e3 * step * (1.0 - t * t)]
        })
    };
    let body = ramp(-1e-5);
    let solution = Contact::new(&Flat, &*body).unwrap().solve(Control::Load(0.02)).unwrap();
    assert!(solution.cost().evaluations > 50);
    solution.certify().unwrap();
}

/// A flat that runs to an end of the bodies bears nothing there, unless the end is a corner.
#[test]
fn a_flat_up_to_an_end() {
    let arc = Outline::from([-6.0, 0.0]).line(3.0).arc(80.0, 5.0);
    let land =
        Outline::from([-6.0, 0.0]).line(3.0).arc(30.0, 2.0).corner(0.8).fillet(0.5).line(1.0);
    for (outline, load) in [(&arc, 1e-3), (&arc, 1e-5), (&land, 1e-3), (&land, 1e-5)] {
        let body = outline.build().unwrap();
        let contact = Contact::new(&Flat, &body).unwrap();
        let error = contact.solve(Control::Load(load)).unwrap_err();
        let ContactError::Solve(SolveError::DomainTooShort { end, .. }) = error else {
            panic!("{error}")
        };
        let text = error.to_string();
        assert!(
            end == -6.0 && text.contains("carry nothing") && text.contains("FreeUntil(-6"),
            "{text}"
        );
        let solution = contact.edges(Edge::FreeUntil(-6.0), Edge::Free).solve(Control::Load(load));
        assert_eq!(solution.unwrap().b(), 6.0);
    }
}

/// Pieces that do not meet are refused at their joint, by a solve or by a certificate, however
/// large the tolerance that they were joined with.
#[test]
fn a_step_at_a_joint_is_named() {
    let half = |from, to, by: f64| graph(from, to, move |x| [x * x / 2.0 + by, x]);
    let direct = |from, to, by: f64| -> Box<dyn ParametricProfile<f64>> {
        let placement = Placement::default().shifted(0.0, by);
        Box::new(Placed::new(Parabola::new(1.0, [from, to]).unwrap(), placement).unwrap())
    };
    for at in [0.0, 0.1, 0.5, -0.5] {
        for step in [1e-5, -1e-5, 1e-3, -1e-4] {
            let curves: Vec<Box<dyn ParametricProfile<f64>>> =
                vec![half(-1.0, at, 0.0), half(at, 1.0, step)];
            for parts in [curves, vec![direct(-1.0, at, 0.0), direct(at, 1.0, step)]] {
                let body = Piecewise::with_tolerance(parts, 0.01).unwrap();
                let contact = Contact::new(&Flat, &body).unwrap();
                let found = contact.solve(Control::Load(0.02));
                // Within the contact, and large beside its deformation, in a solve, too.
                let matters = at.abs() < 0.2 && step.abs() > 1e-4 * 1.5;
                assert!(found.is_err() || !matters, "{step} at {at}");
                let error = found.and_then(|found| found.certify().map(|_| ())).unwrap_err();
                let ContactError::Input(InputError::InconsistentHeights {
                    between,
                    by_heights,
                    by_slopes: 0.0,
                }) = error
                else {
                    panic!("{step} at {at}: {error}")
                };
                assert_eq!(between, [at; 2], "{step}");
                assert!((by_heights - step).abs() < 1e-15, "{step} at {at}: {error}");
            }
        }
    }
}

/// Body whose slope by x disagrees with its points.
struct WrongSlope(f64, linecontact::Convexity);

impl ParametricProfile<f64> for WrongSlope {
    fn domain(&self) -> [f64; 2] {
        [-1.0, 1.0]
    }
    fn at(&self, k: f64) -> CurvePoint<f64> {
        CurvePoint { x: k, y: k * k / 2.0, dx: 1.0, dy: k }
    }
    fn slope_at(&self, x: f64) -> Option<f64> {
        Some(x + self.0 * x * x)
    }
    fn convexity(&self) -> linecontact::Convexity {
        self.1
    }
}

/// For a body declared convex a wrong slope is found only by a certificate.
#[test]
fn a_slope_by_x_that_is_wrong() {
    use linecontact::Convexity::{Convex, Unknown};
    for off in [1e-3, 0.3, -0.3] {
        let body = WrongSlope(off, Unknown);
        let error = Contact::new(&Flat, &body).unwrap().solve(Control::Load(0.02)).unwrap_err();
        let ContactError::Input(InputError::Profile {
            source: ProfileError::Derivative { quantity, .. },
            ..
        }) = error
        else {
            panic!("{error}")
        };
        assert_eq!(quantity, "slope_at(x)");
        let body = WrongSlope(off, Convex);
        let solution = Contact::new(&Flat, &body).unwrap().solve(Control::Load(0.02)).unwrap();
        let error = solution.certify().unwrap_err();
        assert!(
            matches!(error, ContactError::Input(InputError::InconsistentHeights { .. })),
            "{error}"
        );
    }
    let body = WrongSlope(0.0, Unknown);
    Contact::new(&Flat, &body).unwrap().solve(Control::Load(0.02)).unwrap().certify().unwrap();
}

/// A factor that X' and Y' share, such as degrees for radians, shows in no slope.
#[test]
fn rates_that_share_a_wrong_factor() {
    for factor in [1.0f64.to_radians().recip(), 25.4, 1e-3, -1.0] {
        for radius in [1.0, 40.0] {
            let roller = Curve::new([-1.2, 1.2], move |k: f64| {
                let (sin, cos) = k.sin_cos();
                let [dx, dy] = [cos, sin].map(|rate| factor * radius * rate);
                CurvePoint { x: radius * sin, y: radius * (1.0 - cos), dx, dy }
            });
            let calls = AtomicUsize::new(0);
            let roller = Counting(&roller, &calls);
            let solved = Contact::new(&Flat, &roller).and_then(|of| of.solve(Control::Load(0.01)));
            let error = solved.unwrap_err();
            let ContactError::Input(InputError::Profile { source, .. }) = error else {
                panic!("{factor}: {error}")
            };
            if factor > 0.0 {
                let ProfileError::Derivative { quantity: "X'", given, difference, .. } = source
                else {
                    panic!("{factor}: {source}")
                };
                assert_relative_eq!(given / difference, factor, max_relative = 1e-3);
            }
            assert!(calls.load(Ordering::Relaxed) < 10_000, "{factor}: {calls:?}");
        }
    }
}

/// A curve that fails once: the search goes on from another start, and the report has both.
#[test]
fn an_attempt_that_an_error_has_ended_is_reported() {
    let solve = |failing: usize| {
        let calls = AtomicUsize::new(0);
        let body = graph(-1.5, 1.5, move |x| {
            let fails = calls.fetch_add(1, Ordering::Relaxed) == failing;
            let (sin, cos) = (4.0 * PI * x).sin_cos();
            let y = x * x / 20.0 - 0.01 * cos;
            [if fails { f64::NAN } else { y }, x / 10.0 + 0.04 * PI * sin]
        });
        Contact::owned(Arc::new(Flat), body.into())?.solve(Control::Load(0.03))
    };
    let plain = solve(usize::MAX).unwrap();
    let passed = Attempt { start: Start::ActiveSet, outcome: Outcome::Passed };
    assert_eq!(plain.report().attempts(), [passed]);
    let cost = plain.cost();
    let mut goes_on = 0;
    for failing in (0..cost.evaluations + cost.heights).step_by(5) {
        let Ok(solution) = solve(failing) else { continue };
        let attempts = solution.report().attempts();
        if attempts != [passed] {
            let first = Attempt { outcome: Outcome::NotFound, ..passed };
            assert_eq!(attempts.first(), Some(&first), "{failing}: {attempts:?}");
            goes_on += 1;
        }
    }
    assert!(goes_on > 0);
}

/// A roller in a groove of its own radius: no free contact ends anywhere, whatever the ends of both
/// arcs. That is said at once, and not after searches in the noise of rounding.
#[test]
fn a_roller_in_a_groove_of_its_radius_touches_all_along() {
    let references =
        References { x: 0.0, lower: Reference::Depth(20.0), upper: Reference::Depth(20.0) };
    let controls = [
        Control::Load(100.0),
        Control::Load(1e5),
        Control::HalfWidth(1.0),
        Control::PeakPressure(100.0),
        Control::Approach { approach: 0.01, references },
        Control::Moment { load: 100.0, moment: 1.0, about: 0.0 },
    ];
    let (steel, coat) = (Material::elastic(210e3, 0.3), Material::elastic(300e3, 0.2));
    let coating = Layer { material: coat, thickness: 0.5, base: Base::HalfPlane(steel) };
    let asked = Arc::new(AtomicUsize::new(0));
    let arc = |from: f64, to: f64| {
        let counter = asked.clone();
        Curve::new([from, to], move |angle: f64| {
            counter.fetch_add(1, Ordering::Relaxed);
            let (sin, cos) = angle.sin_cos();
            CurvePoint { x: 10.0 * sin, y: 10.0 * (1.0 - cos), dx: 10.0 * cos, dy: 10.0 * sin }
        })
    };
    let arcs = [[-0.5, 0.5, -1.0, 1.0], [-0.4, 0.6, -1.2, 1.0], [-1.0, 1.0, -0.3, 0.5]];
    for [from, to, other_from, other_to] in arcs {
        let (groove, roller) = (arc(from, to), arc(other_from, other_to));
        let contact = Contact::new(&groove, &roller).unwrap();
        for lower in [Foundation::from(steel), Foundation::from(coating)] {
            let contact = contact.clone().materials(lower, steel, PlaneState::Strain);
            for control in controls {
                let error = contact.solve(control).map(|_| ()).unwrap_err();
                let ContactError::Solve(SolveError::NoFirstContact { slope, .. }) = error else {
                    panic!("{from} {to} {control:?}: {error}")
                };
                assert!(slope == [0.0; 2] && error.to_string().contains("touch all along"));
            }
        }
    }
    let asked = asked.load(Ordering::Relaxed);
    println!("{asked} values");
    assert!(asked < 500_000, "{asked} values");
}

/// A solve looks at the watching function while it learns narrow features, too: 1 170 heights from
/// look to look, where they were 3 439, and 48 443 at twice as many waves, which took seconds.
#[test]
fn narrow_features_are_learnt_under_watch() {
    let (height, waves) = (6e-6, 500.0);
    let rough = graph(-1.0, 1.0, move |x| {
        let (sin, cos) = f64::sin_cos(waves * x * 6.2);
        [x * x / 2.0 + height * sin, x + height * waves * 6.2 * cos]
    });
    let [last, most] = [AtomicUsize::new(0), AtomicUsize::new(0)];
    let watch = |cost: Cost, _: Interval<f64>| {
        let taken = cost.heights.saturating_sub(last.swap(cost.heights, Ordering::Relaxed));
        most.fetch_max(taken, Ordering::Relaxed);
        ControlFlow::Continue(())
    };
    let contact = Contact::new(&Flat, &*rough).unwrap().watch(&watch);
    contact.solve(Control::Load(0.02)).unwrap();
    let most = most.into_inner();
    println!("{most} heights between two looks");
    assert!((1..2000).contains(&most), "{most}");
}
