//! All ways to prescribe the pressing lead to the same contact.
#![allow(missing_docs)]

use crate::common;

use approx::assert_relative_eq;
use common::{
    assert_close, controls::controls_of, graph, on_flat, paper, parabola, power, reference,
};
use linecontact::search::Brent;
use linecontact::{
    Contact, ContactError, Control, Curve, CurvePoint, Edge, Flat, InputError, Interval, SolveError,
};
use std::f64::consts::PI;

/// Known values of a contact: limits, C, and the largest pressure.
struct Known {
    a: f64,
    b: f64,
    c: f64,
    peak: f64,
}

fn check(contact: &Contact<f64>, known: &Known, tolerance: f64) {
    let Known { a, b, c, peak } = *known;
    let half_width = 0.5 * (a + b);
    let ways = [
        (Control::Load(c / PI), 1.0),
        (Control::HalfWidth(half_width), 1.0),
        // The peak is known to rounding, and so is the resulting half-width.
        (Control::PeakPressure(peak), 10.0),
    ];
    let found = controls_of(&contact.solve(Control::Load(c / PI)).unwrap());
    for (load, factor) in ways.into_iter().chain(found.into_iter().map(|control| (control, 20.0))) {
        let solution = contact.solve(load).unwrap_or_else(|error| panic!("{load:?}: {error}"));
        let tolerance = factor * tolerance;
        assert_relative_eq!(solution.a(), a, epsilon = 0.0, max_relative = tolerance);
        assert_relative_eq!(solution.b(), b, epsilon = 0.0, max_relative = tolerance);
        assert_close(solution.load(), c / PI, 10.0 * tolerance);
        let strengths = solution.edge_singularities().map(|k| (k * half_width * PI / c).abs());
        assert!(strengths.into_iter().all(|k| k < 10.0 * tolerance), "{load:?}: {strengths:?}");
    }
}

#[test]
fn hertz_by_each_of_them() {
    // F = κ L²/(2 R), p₀ = κ L/(π R).
    let (radius, kappa) = (0.4, 2.5);
    let contact =
        on_flat(graph(-3.0, 3.0, move |x| [x * x / (2.0 * radius), x / radius])).kappa(kappa);
    for l in [1e-6, 0.02, 1.0, 2.2] {
        let c = PI * kappa * l * l / (2.0 * radius);
        let known = Known { a: l, b: l, c, peak: kappa * l / (PI * radius) };
        check(&contact, &known, 2e-15);
        // From any start.
        for reach in [1e-3, 2.0] {
            let start = Interval { left: -reach, right: 0.3 * reach };
            check(&contact.clone().start(start), &known, 4e-15);
        }
    }
}

#[test]
fn the_papers_example_3_by_each_of_them() {
    let example = paper::three();
    let want = reference("paper_example_3_scale_one");
    let contact = Contact::new(&*example.lower, &*example.upper).unwrap();
    // P_max of the reference.
    let known = Known { a: want.a, b: want.b, c: want.c, peak: 1052.6986135955237 };
    check(&contact, &known, 2e-14);
}

#[test]
fn a_pressure_that_is_largest_beside_the_middle() {
    // |x|⁶/6 has two peaks. The computed peak of a contact leads back to it.
    let body = power(6.0);
    let want = reference("power_n_6");
    let contact = Contact::new(&Flat, &*body).unwrap().kappa(want.kappa);
    let solution = contact.solve(Control::Load(want.c / PI)).unwrap();
    let pressure = solution.pressure().unwrap();
    let scan = (1..4000).map(|i| pressure.at(-want.b + i as f64 * want.half_width() / 2000.0));
    let peak = scan.fold(0.0, |most: f64, p| most.max(p.unwrap()));
    assert!(peak > 1.01 * pressure.at(0.0).unwrap());
    let by_peak = contact.solve(Control::PeakPressure(peak)).unwrap();
    // The scan misses the top by a share of (1/2000)².
    assert_relative_eq!(by_peak.a(), want.a, epsilon = 0.0, max_relative = 1e-6);
    let by_width = contact.solve(Control::HalfWidth(want.half_width())).unwrap();
    assert_relative_eq!(by_width.load() * PI, want.c, epsilon = 0.0, max_relative = 1e-14);
}

#[test]
fn a_wedge_has_a_width_but_no_peak() {
    // F = 2 m L/π.
    let contact = on_flat(power(1.0));
    for l in [1e-3, 0.1, 1.5] {
        let solution = contact.solve(Control::HalfWidth(l)).unwrap();
        assert_relative_eq!(solution.load(), 2.0 * l / PI, epsilon = 0.0, max_relative = 1e-14);
        assert_relative_eq!(solution.a(), l, epsilon = 0.0, max_relative = 1e-15);
        let solution = contact.solve(Control::Load(2.0 * l / PI)).unwrap();
        assert_relative_eq!(solution.a(), l, epsilon = 0.0, max_relative = 1e-14);
    }
    for peak in [1e-3, 1.0, 1e3] {
        let error = contact.solve(Control::PeakPressure(peak)).unwrap_err();
        let ContactError::Solve(SolveError::NoPeak { wanted, found, .. }) = error else {
            panic!("{error}")
        };
        assert_eq!((wanted, found), (peak, f64::INFINITY));
    }
}

#[test]
fn sharp_and_adhesive_edges_have_a_width_but_no_peak() {
    let contact = on_flat(parabola(4.0));
    // K = 0 at the free edge: F = L (3 L/2 + x₀).
    for (x0, l) in [(0.0, 0.5), (-0.3, 0.4), (0.2, 1.5)] {
        let load = l * (1.5 * l + x0);
        for (left, right, free) in
            [(Edge::Fixed(x0), Edge::Free, 0), (Edge::Free, Edge::Fixed(-x0), 1)]
        {
            let contact = contact.clone().edges(left, right);
            for control in [Control::HalfWidth(l), Control::Load(load)] {
                let solution = contact.solve(control).unwrap();
                let limits = [solution.a(), solution.b()];
                assert_eq!(limits[1 - free], -x0);
                let far = x0 + 2.0 * l;
                assert_relative_eq!(limits[free], far, epsilon = 0.0, max_relative = 2e-15);
                assert_relative_eq!(solution.load(), load, epsilon = 0.0, max_relative = 1e-14);
            }
            let error = contact.solve(Control::PeakPressure(0.3)).unwrap_err();
            let edge = if free == 0 { left } else { right };
            assert_eq!(error, ContactError::Input(InputError::PeakEdge { edge }));
        }
    }
    // Two adhesive edges: F = L²/2 - 2 sqrt(w L), negative where the contact is narrow.
    let (work, l) = (0.01, 0.3f64);
    let adhesive = contact.clone().edges(Edge::Adhesive(work), Edge::Adhesive(work));
    let solution = adhesive.solve(Control::HalfWidth(l)).unwrap();
    let load = l * l / 2.0 - 2.0 * (work * l).sqrt();
    assert_relative_eq!(solution.load(), load, epsilon = 0.0, max_relative = 1e-14);
    assert_relative_eq!(solution.a(), l, epsilon = 0.0, max_relative = 1e-15);
    // Also for a contact that does not grow with the load.
    let narrow = adhesive.solve(Control::HalfWidth(0.1)).unwrap();
    let load = 0.005 - 2.0 * (work * 0.1).sqrt();
    assert_relative_eq!(narrow.load(), load, epsilon = 0.0, max_relative = 1e-14);
    let error = adhesive.solve(Control::PeakPressure(0.3)).unwrap_err();
    assert_eq!(error, ContactError::Input(InputError::PeakEdge { edge: Edge::Adhesive(work) }));
}

/// Load of a given width, by a search of one unknown at a time: an adhesive edge lowers it by the
/// pull, a fixed edge leaves it to the condition at the other edge.
#[test]
fn a_width_by_a_search_takes_the_load_of_its_edges() {
    let contact = on_flat(parabola(1.0)).limit_search(&SEARCH);
    let l: f64 = 0.3;
    let (round, pull) = (l * l / 2.0, 2.0 * (0.01 * l).sqrt());
    // With the left edge at -b and no strength at a: F = κ L (m₁ + m₀), m₀ = c, m₁ = L/2.
    let centre = -0.2 + l;
    let free = Edge::Free;
    for (edges, load) in [
        ([free, free], round),
        ([Edge::Adhesive(0.01), Edge::Adhesive(0.01)], round - pull),
        ([Edge::Fixed(-0.2), free], l * (l / 2.0 + centre)),
        ([free, Edge::Fixed(0.2)], l * (l / 2.0 + centre)),
    ] {
        let contact = contact.clone().edges(edges[0], edges[1]);
        let solution = contact.solve(Control::HalfWidth(l)).unwrap();
        assert_relative_eq!(solution.load(), load, epsilon = 0.0, max_relative = 1e-13);
    }
}

const SEARCH: Brent = Brent::DEFAULT;

#[test]
fn the_error_says_that_the_bodies_are_too_short() {
    let contact = on_flat(parabola(1.0));
    for value in [1.01, 2.0, 1e6, 1e300] {
        let error = contact.solve(Control::HalfWidth(value)).unwrap_err();
        let ContactError::Solve(SolveError::HalfWidthTooLarge {
            wanted,
            half_width,
            end,
            load,
            peak,
            ..
        }) = error
        else {
            panic!("{value}: {error}")
        };
        assert_eq!((wanted, half_width, end.abs()), (value, 1.0, 1.0));
        assert_relative_eq!(load, 0.5, epsilon = 0.0, max_relative = 1e-14);
        assert_relative_eq!(peak, 1.0 / PI, epsilon = 0.0, max_relative = 1e-14);
        too_high(&contact, value / PI, 1.0, 1.0 / PI);
        // The contact reaches the shorter side, or a corner.
        let short = graph(-3.0, 0.7, |x| [x * x / 2.0, x]);
        too_high(&Contact::new(&Flat, &*short).unwrap(), value / PI, 0.7, 0.7 / PI);
        for edges in
            [[Edge::FreeUntil(-0.3), Edge::Free], [Edge::FreeUntil(-0.8), Edge::FreeUntil(0.3)]]
        {
            let contact = contact.clone().edges(edges[0], edges[1]);
            too_high(&contact, value / PI, 0.3, 0.3 / PI);
        }
    }
}

fn too_high(contact: &Contact<f64>, peak: f64, widest: f64, reached: f64) {
    let error = contact.solve(Control::PeakPressure(peak)).unwrap_err();
    let ContactError::Solve(SolveError::PeakTooHigh { wanted, half_width, found, .. }) = error
    else {
        panic!("{error}")
    };
    assert_eq!(wanted, peak);
    assert_relative_eq!(half_width, widest, epsilon = 0.0, max_relative = 1e-14);
    assert_relative_eq!(found, reached, epsilon = 0.0, max_relative = 1e-13);
}

#[test]
fn a_peak_too_high_is_measured_against_the_widest_contact_there_is_room_for() {
    // No closed form: slightly below this half-width there is a contact, slightly above none.
    for sign in [1.0, -1.0] {
        let contact = on_flat(graph(-0.5, 0.5, move |x| {
            [x * x / 2.0 + sign * x.powi(3) / 5.0, x + sign * 0.6 * x * x]
        }));
        let error = contact.solve(Control::PeakPressure(1.0)).unwrap_err();
        let ContactError::Solve(SolveError::PeakTooHigh { half_width, found, .. }) = error else {
            panic!("{error}")
        };
        assert!(half_width > 0.3 && half_width < 0.5);
        assert!(contact.solve(Control::HalfWidth(half_width * (1.0 + 1e-9))).is_err());
        let fits = contact.solve(Control::HalfWidth(half_width * (1.0 - 1e-9))).unwrap();
        assert_close(fits.peak().unwrap().pressure, found, 1e-8);
        for part in [1.0, 1.0 - 1e-12, 1.0 - 1e-6] {
            let reached = contact.solve(Control::PeakPressure(part * found)).unwrap();
            let peak = reached.peak().unwrap().pressure;
            assert_relative_eq!(peak, part * found, epsilon = 0.0, max_relative = 1e-13);
        }
    }
}

#[test]
fn half_widths_up_to_the_ends_of_the_bodies() {
    let contact = on_flat(parabola(1.0));
    for l in [0.9, 0.999, 0.999999, 1.0 - 1e-12] {
        let solution = contact.solve(Control::HalfWidth(l)).unwrap_or_else(|e| panic!("{l}: {e}"));
        assert_relative_eq!(solution.a(), l, epsilon = 0.0, max_relative = 1e-15);
        assert_relative_eq!(solution.load(), l * l / 2.0, epsilon = 0.0, max_relative = 1e-13);
    }
}

#[test]
fn a_contact_may_fill_the_bodies() {
    // F = L²/2, by any search, and for any rounding of the half-width.
    let brent = Brent::default();
    for i in 0..200 {
        let l = 0.3 + 0.017 * f64::from(i);
        let body = parabola(l);
        let contact = Contact::new(&Flat, &*body).unwrap();
        for contact in [contact.clone().limit_search(&brent), contact] {
            let solution =
                contact.solve(Control::HalfWidth(l)).unwrap_or_else(|e| panic!("{l}: {e}"));
            assert_relative_eq!(solution.load(), l * l / 2.0, epsilon = 0.0, max_relative = 1e-14);
            assert!(solution.a() <= l && solution.b() <= l);
        }
        let l = l as f32;
        let body =
            Curve::new([-l, l], |k: f32| CurvePoint { x: k, y: k * k / 2.0, dx: 1.0, dy: k });
        let contact = Contact::new(&Flat, &body).unwrap();
        for contact in [contact.clone().limit_search(&brent), contact] {
            let solution =
                contact.solve(Control::HalfWidth(l)).unwrap_or_else(|e| panic!("{l}: {e}"));
            assert_relative_eq!(solution.load(), l * l / 2.0, epsilon = 0.0, max_relative = 2e-6);
            assert!(solution.a() <= l && solution.b() <= l);
        }
    }
}

#[test]
fn peaks_up_to_the_ends_of_the_bodies() {
    // p₀ = L/π.
    for reach in [1.0, 3.0] {
        let contact = on_flat(parabola(reach));
        let near = [1.0 - 1e-7, 1.0 - 1e-10, 1.0 - 1e-13, 1.0];
        for part in [0.5, 0.7, 0.8, 0.85, 0.9, 0.95, 0.99, 0.9999].into_iter().chain(near) {
            let l = part * reach;
            let solution = contact.solve(Control::PeakPressure(l / PI));
            let solution = solution.unwrap_or_else(|e| panic!("{l} of {reach}: {e}"));
            assert_relative_eq!(solution.a(), l, epsilon = 0.0, max_relative = 1e-13);
        }
    }
}

#[test]
fn a_width_lost_in_the_rounding_of_x_is_refused() {
    let body = parabola(2.0);
    for fixed in [1.0, -1.0] {
        let edges = if fixed > 0.0 {
            [Edge::Free, Edge::Fixed(fixed)]
        } else {
            [Edge::Fixed(fixed), Edge::Free]
        };
        let contact = Contact::new(&Flat, &*body).unwrap().edges(edges[0], edges[1]);
        let refused = contact.solve(Control::HalfWidth(2.6e-40));
        let Err(ContactError::Input(InputError::InvalidLimits { interval })) = refused else {
            panic!("{refused:?}")
        };
        assert_eq!([interval.left, interval.right], [fixed; 2]);
    }
}

#[test]
fn a_load_less_than_any_number_is_refused() {
    let contact = on_flat(parabola(1.0));
    for load in [Control::HalfWidth(1e-300), Control::PeakPressure(1e-300)] {
        let refused = contact.solve(load);
        assert!(
            matches!(refused, Err(ContactError::Solve(SolveError::Overflow { .. }))),
            "{refused:?}"
        );
    }
}
