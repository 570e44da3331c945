//! Limits by a search of one unknown at a time: every kind of edge and of load against closed
//! forms, evaluation counts, and error messages.
#![allow(missing_docs)]

use crate::edges::{Quadratic, WORK, wanted};
use crate::forms::KAPPA;
use crate::{common, kept::counts_agree};

use approx::{assert_abs_diff_eq, assert_relative_eq};
use common::{assert_close, graph};
use linecontact::search::{Brent, StoppingCriteria, strategies};
use linecontact::{
    Contact, ContactError, Control, Edge, EdgePressure, Exponents, Flat, Interval, Midpoint,
    SolveError,
};

/// Slope with first contact at x = 0.2707, for bodies that extend farther to the right.
const BENT: Quadratic = Quadratic([-0.3, 1.0, 0.4]);

/// Returns the mirror image.
fn mirrored(Quadratic([g0, g1, g2]): Quadratic) -> Quadratic {
    Quadratic([-g0, g1, -g2])
}

fn first_contact(Quadratic([g0, g1, g2]): Quadratic) -> f64 {
    -2.0 * g0 / (g1 + (g1 * g1 - 4.0 * g0 * g2).sqrt())
}

/// Rule with which every trial contact takes evaluations of its own.
const RULE: Midpoint =
    Midpoint { segments: 32, extrapolations: 2, exponents: Exponents::HalfInteger };

/// Evaluation counts of a search, in the tests below.
struct Counts {
    search: &'static str,
    edges: [usize; 8],
    far: [usize; 3],
    not_convex: [usize; 6],
    pressures: [usize; 4],
}

const KEPT: &[Counts] = &[
    Counts {
        search: "bisection",
        edges: [20954, 5010, 4987, 20390, 23030, 19368, 4967, 4836],
        far: [4968, 3945, 24997],
        not_convex: [13450, 18813, 19557, 21417, 20766, 0],
        pressures: [13274, 14258, 11307, 14187],
    },
    Counts {
        search: "secant",
        edges: [2442, 1000, 933, 2389, 2870, 2500, 1005, 899],
        far: [597, 597, 3832],
        not_convex: [1949, 2507, 2631, 3592, 4181, 0],
        pressures: [2153, 2611, 1801, 2632],
    },
    Counts {
        search: "brent",
        edges: [2473, 937, 810, 2421, 2307, 2561, 909, 899],
        far: [628, 535, 3832],
        not_convex: [1887, 2290, 2755, 3251, 3623, 0],
        pressures: [1958, 2612, 1506, 2338],
    },
    Counts {
        search: "newton",
        edges: [2475, 967, 935, 2609, 2467, 2473, 969, 899],
        far: [628, 628, 3832],
        not_convex: [1763, 2290, 2755, 3344, 3809, 0],
        pressures: [2153, 2611, 1800, 2435],
    },
];

/// Asserts that the counts found of each search are those kept of it.
fn check<const N: usize>(kept: fn(&Counts) -> [usize; N], found: &[(&str, [usize; N])]) {
    let kept: Vec<_> = KEPT.iter().map(|of| (of.search, kept(of))).collect();
    let counts = |all: &[(_, [usize; N])]| all.iter().flat_map(|&(_, of)| of).collect::<Vec<_>>();
    let agree = |(&kept, &found): (&usize, &usize)| counts_agree(kept as f64, found as f64);
    let same_searches = kept.iter().map(|(of, _)| of).eq(found.iter().map(|(of, _)| of));
    let same = same_searches && counts(&kept).iter().zip(&counts(found)).all(agree);
    assert!(same, "kept {kept:?}\nfound {found:?}");
}

#[test]
fn every_pair_of_edges() {
    let body = BENT.body(-0.5, 1.1);
    let (free, left, right) = (Edge::Free, Edge::Fixed(-0.1), Edge::Fixed(0.55));
    let pairs = [
        [free, free],
        [left, free],
        [free, right],
        [Edge::Adhesive(WORK), free],
        [free, Edge::Adhesive(WORK)],
        [Edge::Adhesive(WORK), Edge::Adhesive(2.0 * WORK)],
        [left, Edge::Adhesive(WORK)],
        [Edge::Adhesive(WORK), right],
    ];
    let mut found = Vec::new();
    for (search, strategy) in strategies(StoppingCriteria::FULL) {
        let mut counts = [0; 8];
        for (pair, count) in pairs.into_iter().zip(&mut counts) {
            let contact = Contact::new(&Flat, &*body).unwrap().kappa(KAPPA);
            let contact =
                contact.edges(pair[0], pair[1]).limit_search(&*strategy).single_interval(true);
            let started = contact.clone().start(Interval { left: -0.2, right: 0.5 });
            for (contact, load) in [
                (&contact, Control::Load(0.2)),
                (&contact, Control::Load(0.1)),
                (&started, Control::Load(0.15)),
                (&contact, Control::HalfWidth(0.3)),
            ] {
                let solution = contact.solve(load).unwrap_or_else(|e| panic!("{pair:?}: {e}"));
                let on = solution.hull();
                let scale = KAPPA * on.half_width();
                let exact = BENT.strengths(solution.load(), on);
                for (i, edge) in pair.into_iter().enumerate() {
                    if let Some(wanted) = wanted(edge, on.half_width()) {
                        assert_abs_diff_eq!(exact[i], wanted, epsilon = 2e-14 * scale);
                    }
                }
                let least = f64::EPSILON;
                let error = solution.limits_error().unwrap();
                assert!((least..1e-13).contains(&error), "{pair:?} {load:?}: {error:e}");
                let by_rule = contact.clone().quadrature(&RULE);
                let other = by_rule.solve(load).unwrap_or_else(|e| panic!("{pair:?}: {e}"));
                assert_relative_eq!(other.a(), on.right, epsilon = 0.0, max_relative = 1e-12);
                assert_close(other.load(), solution.load(), 1e-12);
                *count += other.cost().evaluations;
            }
        }
        found.push((search, counts));
    }
    check(|kept| kept.edges, &found);
}

#[test]
fn far_from_the_origin() {
    let mut found = Vec::new();
    for (search, strategy) in strategies(StoppingCriteria::FULL) {
        let mut counts = [0; 3];
        for (place, count) in [1e3, -1e6, 1e9].into_iter().zip(&mut counts) {
            let body = graph(place - 0.5, place + 1.1, move |x| {
                let (u, Quadratic([g0, g1, g2])) = (x - place, BENT);
                [u * (g0 + u * (g1 / 2.0 + u * g2 / 3.0)), g0 + u * (g1 + u * g2)]
            });
            let contact =
                Contact::new(&Flat, &*body).unwrap().kappa(KAPPA).limit_search(&*strategy);
            let solution = contact.solve(Control::Load(0.2)).unwrap();
            let Interval { left, right } = solution.hull();
            let on = Interval { left: left - place, right: right - place };
            let rounding = 4.0 * f64::EPSILON * place.abs();
            let exact = BENT.strengths(0.2, on);
            assert_abs_diff_eq!(exact[..], [0.0; 2][..], epsilon = 4.0 * KAPPA * rounding);
            let contact = contact.clone().quadrature(&RULE);
            let other = contact.solve(Control::Load(0.2)).unwrap();
            assert_abs_diff_eq!(other.a(), right, epsilon = 4.0 * rounding);
            *count += other.cost().evaluations;
        }
        found.push((search, counts));
    }
    check(|kept| kept.far, &found);
}

#[test]
fn up_to_the_most_that_a_gap_bears() {
    // g = u + 3 u²: c + 3 c² + 3 L²/2 = 0 and F = L² sqrt(1 - 18 L²)/2, at most 0.010692. No
    // contact is in balance beyond L = sqrt(1/18).
    let place = 0.3;
    let body = graph(place - 1.0, place + 1.0, move |x| {
        let u = x - place;
        [u * u / 2.0 + u.powi(3), u + 3.0 * u * u]
    });
    let mut found = Vec::new();
    let loads = [1e-6, 1e-3, 5e-3, 0.01, 0.0106, 0.02];
    for (search, strategy) in strategies(StoppingCriteria::FULL) {
        let mut counts = [0; 6];
        for (load, count) in loads.into_iter().zip(&mut counts) {
            for half_width in [0.25, 1e-3, 0.15] {
                let start = Interval { left: place - 1.01 * half_width, right: place + half_width };
                let contact =
                    Contact::new(&Flat, &*body).unwrap().limit_search(&*strategy).start(start);
                let contact = contact.single_interval(true);
                let by_rule = contact.clone().quadrature(&RULE);
                let other = by_rule.solve(Control::Load(load));
                match contact.solve(Control::Load(load)) {
                    Ok(solution) => {
                        let l = solution.hull().half_width();
                        let carried = l * l * (1.0 - 18.0 * l * l).sqrt() / 2.0;
                        assert_relative_eq!(carried, load, epsilon = 0.0, max_relative = 1e-13);
                        *count += other.unwrap().cost().evaluations;
                    }
                    Err(ContactError::Solve(SolveError::NoEquilibrium { half_width, near })) => {
                        assert!(load > 0.0107, "{load}");
                        assert_relative_eq!(near, place, epsilon = 0.0, max_relative = 1e-12);
                        assert!((0.9 / 18f64.sqrt()..1.0).contains(&half_width), "{half_width}");
                    }
                    Err(error) => panic!("{load}: {error}"),
                }
            }
        }
        found.push((search, counts));
    }
    check(|kept| kept.not_convex, &found);
}

#[test]
fn a_width_beyond_the_bodies_names_the_end() {
    for (bent, reach) in [(BENT, [-0.5, 1.1]), (mirrored(BENT), [-1.1, 0.5])] {
        let (body, origin) = (bent.body(reach[0], reach[1]), first_contact(bent));
        let contact = Contact::new(&Flat, &*body).unwrap();
        for half_width in [0.79, 0.81, 5.0] {
            for (_, strategy) in strategies(StoppingCriteria::FULL) {
                let contact = contact.clone().limit_search(&*strategy);
                let error = contact.solve(Control::HalfWidth(half_width)).unwrap_err();
                let ContactError::Solve(SolveError::HalfWidthTooLarge {
                    wanted,
                    half_width: room,
                    end,
                    ..
                }) = error
                else {
                    panic!("{error}")
                };
                assert_eq!(wanted, half_width);
                // The contact with that end as its limit, and c₀ = 0.
                let way = if end < 0.0 { 1.0 } else { -1.0 };
                let inner = end + way * 2.0 * room;
                let on = Interval { left: end.min(inner), right: end.max(inner) };
                assert!(reach.contains(&end) && on.left < origin && on.right > origin);
                assert!(bent.coefficients(on)[0].abs() < 1e-13, "{on:?}");
            }
        }
    }
}

#[test]
fn bodies_that_are_too_short_carry_so_much() {
    // Free edges: c₀ = 0 with one limit at the end of the bodies. A fixed one: K = 0 at the other.
    let reach = 0.5;
    let (fixed, load) = (-0.1, 3.0);
    let balanced = |left: f64| BENT.coefficients(Interval { left, right: reach })[0];
    let (mut lo, mut hi) = (-0.5, 0.4);
    for _ in 0..60 {
        let middle = 0.5 * (lo + hi);
        if balanced(middle) < 0.0 { lo = middle } else { hi = middle }
    }
    for (left, edge) in [(lo, Edge::Free), (fixed, Edge::Fixed(fixed))] {
        let on = Interval { left, right: reach };
        let [mean, first, _] = BENT.coefficients(on);
        let most = KAPPA * on.half_width() * (first / 2.0 + mean);
        for side in [1.0, -1.0] {
            let (bent, edges) = if side > 0.0 {
                (BENT, [edge, Edge::Free])
            } else {
                let turned = if edge == Edge::Free { edge } else { Edge::Fixed(-fixed) };
                (mirrored(BENT), [Edge::Free, turned])
            };
            let body = bent.body(-0.5, 0.5);
            let contact = Contact::new(&Flat, &*body).unwrap().kappa(KAPPA);
            let contact = contact.edges(edges[0], edges[1]);
            let searches = strategies(StoppingCriteria::FULL);
            let mut scenes: Vec<_> = searches
                .iter()
                .map(|(_, search)| contact.clone().limit_search(&**search))
                .collect();
            scenes.push(contact);
            for contact in scenes {
                let error = contact.solve(Control::Load(load)).unwrap_err();
                let ContactError::Solve(SolveError::DomainTooShort {
                    end,
                    carried,
                    load: asked,
                    ..
                }) = error
                else {
                    panic!("{error}")
                };
                assert_eq!([end, asked], [side * reach, load], "{edges:?}");
                assert_relative_eq!(carried, most, epsilon = 0.0, max_relative = 1e-12);
            }
        }
    }
}

#[test]
fn a_sloppy_search_for_the_place_shows() {
    let body = BENT.body(-0.5, 1.1);
    let contact = Contact::new(&Flat, &*body).unwrap();
    let l = 0.3;
    let exact = contact.solve(Control::HalfWidth(l)).unwrap().hull().centre();
    for relative in [0.3, 0.1, 1e-2, 1e-4, 1e-8] {
        for (_, strategy) in strategies(StoppingCriteria::relative(relative)) {
            let contact = contact.clone().limit_search(&*strategy);
            let solution = contact.solve(Control::HalfWidth(l)).unwrap();
            let error = (solution.hull().centre() - exact).abs() / l;
            let estimate = solution.limits_error().unwrap();
            assert!(error <= 2.0 * estimate, "{relative}: {error:e} {estimate:e}");
            assert!(estimate <= 4.0 * error + 1e-13, "{relative}: {error:e} {estimate:e}");
        }
    }
}

#[test]
fn pressures_wanted_at_a_distance() {
    // Hertz: P = κ sqrt(L² - u²)/π. The rule of 32 segments adds an error of its own.
    let (place, l) = (0.3, 0.4f64);
    let load = KAPPA * l * l / 2.0;
    let body = graph(place - 0.9, place + 1.1, move |x| [(x - place).powi(2) / 2.0, x - place]);
    let [at_a, at_b] =
        [0.1, 0.05].map(|e| KAPPA * (l * l - (l - e) * (l - e)).sqrt() / std::f64::consts::PI);
    let [distance_a, distance_b] = [0.1, 0.05];
    let (tolerance_a, tolerance_b) = (1e-9, 1e-9);
    let edge_pressure =
        EdgePressure { at_a, at_b, distance_a, distance_b, tolerance_a, tolerance_b };
    let starts = [None, Some([0.29, 0.31]), Some([-0.5, 1.3]), Some([0.4, 0.6])];
    let mut found = Vec::new();
    for (search, strategy) in strategies(StoppingCriteria::FULL) {
        let mut counts = [0; 4];
        for (start, count) in starts.into_iter().zip(&mut counts) {
            let contact = Contact::new(&Flat, &*body).unwrap().kappa(KAPPA).quadrature(&RULE);
            let mut contact = contact.edge_pressure(edge_pressure).limit_search(&*strategy);
            if let Some([left, right]) = start {
                contact = contact.start(Interval { left, right });
            }
            let solution = contact.solve(Control::Load(load)).unwrap();
            let on = solution.hull();
            assert_relative_eq!(on.right, place + l, epsilon = 0.0, max_relative = 1e-3);
            assert_relative_eq!(on.left, place - l, epsilon = 0.0, max_relative = 1e-2);
            let pressure = solution.pressure().unwrap();
            let got = [on.right - distance_a, on.left + distance_b]
                .map(|x| pressure.estimate(x, &mut Default::default()).unwrap().value);
            assert_abs_diff_eq!(got[..], [at_a, at_b][..], epsilon = 1e-9);
            *count += solution.cost().evaluations;
        }
        found.push((search, counts));
    }
    check(|kept| kept.pressures, &found);
}

#[test]
fn pressures_missed_are_those_of_the_best_contact() {
    // A search that stops early; the expected pressures at both places are those between fixed
    // limits.
    let (load, distances) = (0.1, [0.07, 0.03]);
    let body = BENT.body(-0.5, 1.1);
    let [at_a, at_b] = [0.05, 0.04];
    let wanted = EdgePressure {
        at_a,
        at_b,
        distance_a: distances[0],
        distance_b: distances[1],
        tolerance_a: 1e-7,
        tolerance_b: 1e-7,
    };
    let sloppy = Brent { tolerance: StoppingCriteria::relative(0.02) };
    let contact = Contact::new(&Flat, &*body).unwrap().kappa(KAPPA).quadrature(&RULE);
    let missed = |wanted| {
        let contact = contact.clone().limit_search(&sloppy).edge_pressure(wanted);
        match contact.solve(Control::Load(load)) {
            Err(ContactError::Solve(SolveError::EdgePressureNotMet { best, at_a, at_b })) => {
                (best, [at_a, at_b])
            }
            other => panic!("{other:?}"),
        }
    };
    let (best, by) = missed(wanted);
    let fixed = contact.clone().edges(Edge::Fixed(best.left), Edge::Fixed(best.right));
    let fixed = fixed.single_interval(true).solve(Control::Load(load)).unwrap();
    let pressure = fixed.pressure().unwrap();
    let at = |x| pressure.estimate(x, &mut Default::default()).unwrap().value;
    let exact = [at(best.right - distances[0]) - at_a, at(best.left + distances[1]) - at_b];
    assert_relative_eq!(by[..], exact[..], epsilon = 0.0, max_relative = 1e-9);
    // Either residual alone is enough for a refusal.
    let [most_a, most_b] = by.map(|by| 2.0 * by.abs());
    let one = missed(EdgePressure { tolerance_a: most_a, ..wanted });
    let other = missed(EdgePressure { tolerance_b: most_b, ..wanted });
    assert_eq!([one.0, other.0], [best; 2]);
}

#[test]
fn edges_take_the_place_of_edge_pressures() {
    let body = BENT.body(-0.5, 1.1);
    let contact = Contact::new(&Flat, &*body).unwrap();
    let asked = contact.clone().edge_pressure(EdgePressure::zero(0.1, 1e-6));
    let again = asked.edges(Edge::Free, Edge::Free);
    let limits = |contact: &Contact<f64>| {
        contact.solve(Control::Load(0.1)).map(|solution| solution.hull()).unwrap()
    };
    assert_eq!(limits(&again), limits(&contact));
}

#[test]
fn forces_beyond_any_number_are_an_overflow() {
    let body = graph(-1.0, 1.0, |x| [1e200 * x * x / 2.0, 1e200 * x]);
    for (_, strategy) in strategies(StoppingCriteria::FULL) {
        let contact = Contact::new(&Flat, &*body).unwrap().kappa(1e200).limit_search(&*strategy);
        for load in [1e-3, 1e300] {
            let error = contact.solve(Control::Load(load)).unwrap_err();
            let ContactError::Solve(SolveError::Overflow { interval }) = error else {
                panic!("{error}")
            };
            assert!(interval.left < 0.0 && interval.right > 0.0, "{interval:?}");
        }
    }
}
