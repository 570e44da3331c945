//! Given widths and peaks where an edge is held, or the tip is hollow.
#![allow(missing_docs)]

use crate::common::{assert_close, graph, on_flat, parabola};
use approx::assert_relative_eq;
use linecontact::profile::{Ellipse, wedge};
use linecontact::search::Brent;
use linecontact::{
    Contact, ContactError, Control, Edge, EvaluationError, Flat, Interval, Midpoint, Panels,
    SolveError, Solver,
};
use std::f64::consts::PI;

/// One limit and the width give the other limit, and K = 0 at the free edge gives the load: F =
/// L²/2 - L c with the free edge on the left, c the centre of the contact.
#[test]
fn a_width_beside_a_fixed_edge() {
    let (body, brent) = (parabola(1.0), Brent::default());
    let contact = Contact::new(&Flat, &*body).unwrap();
    let others =
        [contact.clone().limit_search(&brent), contact.clone().quadrature(&Midpoint::DEFAULT)];
    for contact in [contact].into_iter().chain(others) {
        for (held, half_width) in [(0.5, 0.5), (0.5, 0.7), (0.1, 0.5), (0.7, 0.85)] {
            let far = held - 2.0 * half_width;
            let load = half_width * (0.5 * half_width - (held - half_width));
            let mirrored = contact.clone().edges(Edge::Fixed(-held), Edge::Free);
            let contact = contact.clone().edges(Edge::Free, Edge::Fixed(held));
            let solution = contact.solve(Control::HalfWidth(half_width)).unwrap();
            assert_relative_eq!(solution.hull().left, far, epsilon = 0.0, max_relative = 1e-14);
            assert_relative_eq!(solution.load(), load, epsilon = 0.0, max_relative = 1e-9);
            let solution = mirrored.solve(Control::HalfWidth(half_width)).unwrap();
            assert_relative_eq!(solution.a(), -far, epsilon = 0.0, max_relative = 1e-14);
            assert_relative_eq!(solution.load(), load, epsilon = 0.0, max_relative = 1e-9);
        }
        for other in [Edge::Free, Edge::Adhesive(1e-3)] {
            let contact = contact.clone().edges(other, Edge::Fixed(0.1));
            let error = contact.solve(Control::HalfWidth(5.0)).map(|_| ()).unwrap_err();
            assert!(
                matches!(error, ContactError::Solve(SolveError::OutsideBodies { x: -9.9, .. })),
                "{error}"
            );
        }
    }
}

/// With one limit and the width given, nothing is searched for: the limits are exact, even at a
/// breakpoint, and the load is F = L (m₁ + m₀), by Gauss-Chebyshev sums. (A wedge up to its tip:
/// m₁ = 0.)
#[test]
fn a_width_beside_a_fixed_edge_is_exact() {
    let tip = wedge([-0.25, 1.75], 1.0).unwrap();
    let contact = Contact::new(&Flat, &tip).unwrap().edges(Edge::Fixed(-0.5), Edge::Free);
    let contact = contact.single_interval(true);
    let solution = contact.solve(Control::HalfWidth(0.25)).unwrap();
    assert_eq!(solution.hull(), Interval { left: -0.5, right: 0.0 });
    assert_relative_eq!(solution.load(), -0.0625, epsilon = 0.0, max_relative = 1e-14);

    let arc = Ellipse::circle(1.0, [-1.5, 1.5]).unwrap();
    let slope = |x: f64| x / (1.0 - x * x).sqrt();
    for (left, half_width) in [(-0.5, 0.25), (-0.1, 0.2), (-0.3, 0.5)] {
        let (count, centre) = (400, left + half_width);
        let nodes = (0..count).map(|i| ((f64::from(i) + 0.5) * PI / f64::from(count)).cos());
        let sum: f64 = nodes.map(|t| slope(centre + half_width * t) * (1.0 + t)).sum();
        let load = half_width * sum / f64::from(count);
        for tolerance in [0.0, 1e-8, 1e-4] {
            let panels = Panels { tolerance };
            let contact = Contact::new(&Flat, &arc).unwrap().quadrature(&panels);
            let contact = contact.edges(Edge::Fixed(left), Edge::Free).single_interval(true);
            let solution = contact.solve(Control::HalfWidth(half_width)).unwrap();
            assert_eq!(solution.hull().left, left);
            let off = (solution.load() / load - 1.0).abs();
            let estimate = solution.limits_error().unwrap();
            assert!(off <= 4.0 * estimate + 1e-15, "{left} {tolerance}: {off} {estimate}");
            assert!(estimate <= 1e-14 + tolerance, "{left} {tolerance}: {estimate}");
        }
    }
}

#[test]
fn a_corner_is_not_passed() {
    let contact = on_flat(graph(-1.0, 1.0, |x| [-x * x / 2.0, -x]));
    let contact = contact.edges(Edge::FreeUntil(-0.1), Edge::Adhesive(0.0));
    assert!(contact.solve(Control::HalfWidth(0.3)).is_err());
}

/// Two tips with a hollow between them: no narrow contact has pressure everywhere.
#[test]
fn a_peak_of_a_hollow_tip() {
    let contact = on_flat(graph(-1.0, 1.0, |x| {
        let square = x * x;
        [square * square - 0.02 * square, 4.0 * square * x - 0.04 * x]
    }));
    let under = contact.solve(Control::Load(0.1)).unwrap();
    let peak = under.peak().unwrap().pressure;
    let found = contact.solve(Control::PeakPressure(peak)).unwrap();
    assert_relative_eq!(found.a(), under.a(), epsilon = 0.0, max_relative = 1e-7);
    assert_relative_eq!(found.load(), 0.1, epsilon = 0.0, max_relative = 1e-7);
}

/// Peaks by a rule of a few points are inaccurate, and so is the width. Next to an edge such a rule
/// has no correct digit.
#[test]
fn a_doubtful_peak_is_a_doubtful_width() {
    let body = parabola(1.0);
    for segments in [4, 8, 16, 32] {
        let rule = Midpoint { segments, ..Midpoint::DEFAULT };
        let contact = Contact::new(&Flat, &*body).unwrap().quadrature(&rule);
        let solution = contact.solve(Control::PeakPressure(0.1)).unwrap();
        let off = (solution.a() / (0.1 * PI) - 1.0).abs();
        let estimate = solution.limits_error().unwrap();
        assert!(off <= estimate && estimate < 1e-7, "{segments}: {off} {estimate}");
        let (peak, last) = (solution.peak().unwrap(), 2e-14);
        assert!((peak.pressure / 0.1 - 1.0).abs() < last && peak.x.abs() < 1e-6, "{peak:?}");
    }
    // Fewer segments leave no way to judge them.
    for segments in [1, 2, 3] {
        let rule = Midpoint { segments, ..Midpoint::DEFAULT };
        let contact = Contact::new(&Flat, &*body).unwrap().quadrature(&rule);
        let error = contact.solve(Control::PeakPressure(0.1)).map(|_| ()).unwrap_err();
        assert!(
            matches!(error, ContactError::Evaluation(EvaluationError::Unresolved { .. })),
            "{error}"
        );
        let peak = contact.solve(Control::Load(0.02)).unwrap().peak();
        assert!(
            matches!(peak, Err(ContactError::Evaluation(EvaluationError::Unresolved { .. }))),
            "{peak:?}"
        );
    }
}

/// Pulled at one edge, K = 0 at the other: c = sqrt(w/L) towards the pull, and F = L²/2 - L c. With
/// c beyond L the contact lies next to the lowest point of the parabola.
#[test]
fn a_width_pulled_at_one_edge() {
    let (body, brent) = (parabola(2.0), Brent::default());
    let contact = Contact::new(&Flat, &*body).unwrap();
    let others =
        [contact.clone().limit_search(&brent), contact.clone().quadrature(&Midpoint::DEFAULT)];
    for contact in [contact].into_iter().chain(others) {
        for (half_width, leaning) in
            [(0.3f64, 0.2), (0.3, 1.0), (0.3, 1.5), (0.1, 1.9), (0.01, 1.2)]
        {
            let centre = leaning * half_width;
            let pull = Edge::Adhesive(centre * centre * half_width);
            let load = half_width * (0.5 * half_width - centre);
            for (edges, sign) in [([Edge::Free, pull], 1.0), ([pull, Edge::Free], -1.0)] {
                let contact = contact.clone().edges(edges[0], edges[1]);
                let solution = contact.solve(Control::HalfWidth(half_width)).unwrap();
                let on = solution.hull();
                assert_close(on.centre(), sign * centre, 1e-13);
                assert_close(on.half_width(), half_width, 1e-14);
                assert_relative_eq!(solution.load(), load, epsilon = 0.0, max_relative = 1e-12);
            }
        }
    }
}

/// Around so narrow a contact there is no balance within many widths: the error says so.
#[test]
fn a_width_pulled_far_away_ends() {
    let (body, brent) = (parabola(2.0), Brent::default());
    let contact = Contact::new(&Flat, &*body).unwrap().limit_search(&brent);
    for (edges, work) in
        [([Edge::Free, Edge::Adhesive(1e-2)], 1e-2), ([Edge::Adhesive(1.0), Edge::Free], 1.0)]
    {
        let contact = contact.clone().edges(edges[0], edges[1]);
        let error = contact.solve(Control::HalfWidth(1e-9)).map(|_| ()).unwrap_err();
        assert!(
            matches!(
                error,
                ContactError::Solve(
                    SolveError::NoEquilibrium { .. } | SolveError::OutsideBodies { .. }
                )
            ),
            "{work}: {error}"
        );
    }
}

/// A width after another one that a corner has held gives the result of a cold solve, at about the
/// same number of evaluations. Held: F = L²/2 - L c, the free edge on the left; let go: F = L²/2.
#[test]
fn a_width_after_one_held_by_a_corner() {
    let evaluations = |steep: f64, corner: f64, half_widths: [f64; 2]| {
        let body = graph(-2.5, 2.5, move |x| [x * x / 2.0 - steep * x, x - steep]);
        let contact =
            Contact::new(&Flat, &*body).unwrap().edges(Edge::Free, Edge::FreeUntil(corner));
        let mut solver = Solver::new();
        let mut last = 0;
        for half_width in half_widths {
            let solution = solver.solve(&contact, Control::HalfWidth(half_width)).unwrap();
            last = solution.cost().evaluations;
            let held = steep + half_width > corner;
            let right = if held { corner } else { steep + half_width };
            let load = half_width * (0.5 * half_width - (right - half_width - steep));
            assert_relative_eq!(solution.a(), right, epsilon = 0.0, max_relative = 1e-14);
            assert_relative_eq!(solution.load(), load, epsilon = 0.0, max_relative = 1e-12);
        }
        let cold = contact.solve(Control::HalfWidth(half_widths[1])).unwrap().cost().evaluations;
        (last, cold)
    };
    for (steep, corner, half_widths) in [
        (0.186, 0.004, [0.0016, 0.0017]),
        (0.186, 0.004, [0.0016, 0.0012]),
        (0.0, 0.3, [0.5, 0.2]),
        (0.0, 0.3, [0.2, 0.5]),
    ] {
        let (warm, cold) = evaluations(steep, corner, half_widths);
        assert!(warm <= 5 * cold, "{half_widths:?}: {warm}, from nothing {cold}");
    }
}
