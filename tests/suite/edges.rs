//! Free, fixed and adhesive edges on either side, against closed forms.
//!
//! Bodies with a polynomial slope have closed forms. With `x = c + L cos θ` and
//! `κ g = c₀/2 + c₁ cos θ + c₂ cos 2θ`,
//!
//! ```text
//! P = (c₁ sin θ + c₂ sin 2θ)/π + (α + β cos θ)/sin θ,   β = -c₀/(2π),   π α = F/L - c₁/2
//! K_a = α + β,   K_b = α - β:   0 if free,   -2 sqrt(κ w/L)/π if adhesive
//! ```
#![allow(missing_docs)]

use crate::common;
use crate::forms::KAPPA;

use approx::{assert_abs_diff_eq, assert_relative_eq};
use common::{Profile, assert_close, graph, on_flat, parabola};
use linecontact::{
    Contact, ContactError, Control, Edge, Flat, Interval, Midpoint, Solution, SolveError,
};
use std::f64::consts::PI;

pub const WORK: f64 = 1e-3;

/// Slope g₀ + g₁ x + g₂ x².
#[derive(Clone, Copy)]
pub struct Quadratic(pub [f64; 3]);

impl Quadratic {
    pub fn body(self, from: f64, to: f64) -> Profile {
        let Self([g0, g1, g2]) = self;
        graph(from, to, move |x| [x * (g0 + x * (g1 / 2.0 + x * g2 / 3.0)), g0 + x * (g1 + x * g2)])
    }

    fn slope(self, x: f64) -> f64 {
        let Self([g0, g1, g2]) = self;
        g0 + x * (g1 + x * g2)
    }

    /// Returns c₀/2, c₁ and c₂, for κ = 1.
    pub fn coefficients(self, on: Interval<f64>) -> [f64; 3] {
        let (Self([g0, g1, g2]), c, l) = (self, on.centre(), on.half_width());
        [g0 + g1 * c + g2 * c * c + g2 * l * l / 2.0, l * (g1 + 2.0 * g2 * c), g2 * l * l / 2.0]
    }

    /// Returns K_b and K_a.
    pub fn strengths(self, load: f64, on: Interval<f64>) -> [f64; 2] {
        let [mean, first, _] = self.coefficients(on);
        let alpha = (load / on.half_width() - KAPPA * first / 2.0) / PI;
        [alpha + KAPPA * mean / PI, alpha - KAPPA * mean / PI]
    }

    fn pressure(self, load: f64, on: Interval<f64>, theta: f64) -> f64 {
        let [_, c1, c2] = self.coefficients(on);
        let [at_b, at_a] = self.strengths(load, on);
        let (sin, cos) = theta.sin_cos();
        let singular = (at_a * (1.0 + cos) + at_b * (1.0 - cos)) / (2.0 * sin);
        KAPPA * (c1 * sin + c2 * (2.0 * theta).sin()) / PI + singular
    }
}

/// Returns the strength required by an edge; `None` for a fixed edge, whose strength is a result.
pub fn wanted(edge: Edge<f64>, half_width: f64) -> Option<f64> {
    match edge {
        Edge::Free => Some(0.0),
        Edge::Adhesive(work) => Some(-2.0 * (KAPPA * work / half_width).sqrt() / PI),
        Edge::Fixed(_) | Edge::FreeUntil(_) => None,
    }
}

/// Checks that the pressure solves the equation of the bodies and carries the load, by the
/// Gauss-Chebyshev rule. With the weight of the edges it is exact here (Erdogan and Gupta, *Q.
/// Appl. Math.* 29, 1972).
fn check_integrals(solution: &Solution<f64>, slope: impl Fn(f64) -> f64, kappa: f64) {
    const N: usize = 12;
    let (on, pressure) = (solution.hull(), solution.pressure().unwrap());
    let x = |angle: f64| on.centre() + on.half_width() * angle.cos();
    let nodes: Vec<[f64; 2]> = (0..N)
        .map(|j| {
            let angle = PI * (j as f64 + 0.5) / N as f64;
            let s = x(angle);
            [s, pressure.estimate(s, &mut Default::default()).unwrap().value * angle.sin()]
        })
        .collect();
    let weight = PI / N as f64 * on.half_width();
    let load: f64 = nodes.iter().map(|[_, strength]| weight * strength).sum();
    let size = nodes.iter().map(|[_, strength]| weight * strength.abs()).sum::<f64>();
    assert_abs_diff_eq!(load, solution.load(), epsilon = 1e-13 * size);
    let steepest = slope(on.left).abs().max(slope(on.right).abs()).max(size / on.half_width());
    for k in 1..N {
        let x = x(PI * k as f64 / N as f64);
        let integral: f64 = nodes.iter().map(|[s, strength]| weight * strength / (x - s)).sum();
        assert_abs_diff_eq!(integral, kappa * slope(x), epsilon = 1e-12 * kappa * steepest);
    }
}

fn points(on: Interval<f64>) -> impl Iterator<Item = (f64, f64)> {
    // Angles of the rounded x, from the distance to the nearer edge.
    (1..40).map(move |i| {
        let x = on.at_angle(PI * f64::from(i) / 40.0);
        (x, 2.0 * ((on.right - x) / (x - on.left)).sqrt().atan())
    })
}

#[test]
fn all_nine_pairs_of_edges_meet_their_conditions() {
    let g = Quadratic([-0.02, 1.0, 0.4]);
    let body = g.body(-0.8, 0.8);
    let left = [Edge::Free, Edge::Fixed(-0.2), Edge::Adhesive(WORK)];
    let right = [Edge::Free, Edge::Fixed(0.25), Edge::Adhesive(2.0 * WORK)];
    for (left, right) in left.iter().flat_map(|&left| right.map(|right| (left, right))) {
        let name = format!("{left:?} {right:?}");
        let contact = Contact::new(&Flat, &*body).unwrap().kappa(KAPPA).edges(left, right);
        for load in [0.2, 0.1] {
            let solution = contact.solve(Control::Load(load)).expect(&name);
            let (on, load) = (solution.hull(), solution.load());
            let scale = KAPPA * on.half_width();
            let exact = g.strengths(load, on);
            let solved = solution.edge_singularities().into_iter();
            for ((i, edge), solved) in [left, right].into_iter().enumerate().zip(solved) {
                if let Some(wanted) = wanted(edge, on.half_width()) {
                    assert_abs_diff_eq!(exact[i], wanted, epsilon = 2e-15 * scale);
                }
                assert_abs_diff_eq!(solved, exact[i], epsilon = 4e-15 * scale);
            }
            for (edge, limit) in [(left, on.left), (right, on.right)] {
                if let Edge::Fixed(x) = edge {
                    assert_eq!(limit, x, "{name}");
                }
            }
            let pressure = solution.pressure().unwrap();
            for (x, theta) in points(on) {
                let got = pressure.estimate(x, &mut Default::default()).unwrap().value;
                let exact = g.pressure(load, on, theta);
                assert_abs_diff_eq!(got, exact, epsilon = 1e-14 * (scale + exact.abs()));
            }
            check_integrals(&solution, |x| g.slope(x), KAPPA);
        }
    }
}

/// Solves a parabola of radius R with its lowest point at x = 0, with these edges.
fn on_parabola(load: f64, radius: f64, left: Edge<f64>, right: Edge<f64>) -> [f64; 4] {
    let body = Quadratic([0.0, 1.0 / radius, 0.0]).body(-4.0, 4.0);
    let contact = Contact::new(&Flat, &*body).unwrap().kappa(KAPPA).edges(left, right);
    // The conditions at the edges, whatever their signs.
    let contact = contact.single_interval(true);
    let solution = contact.solve(Control::Load(load)).unwrap();
    let on = solution.hull();
    let x = on.left + 0.3 * (on.right - on.left);
    let pressure = solution.pressure().unwrap().estimate(x, &mut Default::default()).unwrap();
    [solution.a(), solution.b(), x, pressure.value]
}

fn mirrored([a, b, x, pressure]: [f64; 4]) -> [f64; 4] {
    [b, a, -x, pressure]
}

#[test]
fn free_edges_give_hertz() {
    let radius = 2.5;
    for l in [1e-9, 1e-3, 0.3, 1.5f64] {
        let load = KAPPA * l * l / (2.0 * radius);
        let [a, b, x, pressure] = on_parabola(load, radius, Edge::Free, Edge::Free);
        assert_relative_eq!([a, b][..], [l, l][..], epsilon = 0.0, max_relative = 1e-15);
        let exact = KAPPA * (l * l - x * x).sqrt() / (PI * radius);
        assert_relative_eq!(pressure, exact, epsilon = 0.0, max_relative = 1e-14);
    }
}

#[test]
fn a_parabola_with_one_corner_inside() {
    // K = 0 at the free edge: F R = κ L (3 L/2 + x₀), and
    // P = κ/(π R) sqrt((a - x)/(x - x₀)) (x - x₀ + c).
    let radius = 2.5;
    for x0 in [-0.2, 0.0, 0.4] {
        for l in [0.21, 0.5, 1.3] {
            let load = KAPPA * l * (1.5 * l + x0) / radius;
            let cases = [
                on_parabola(load, radius, Edge::Fixed(x0), Edge::Free),
                mirrored(on_parabola(load, radius, Edge::Free, Edge::Fixed(-x0))),
            ];
            for [a, b, x, pressure] in cases {
                assert_eq!(b, -x0);
                assert_relative_eq!(a, x0 + 2.0 * l, epsilon = 0.0, max_relative = 2e-15);
                let root = ((a - x) / (x - x0)).sqrt();
                let exact = KAPPA / (PI * radius) * root * (x - x0 + (x0 + l));
                assert_relative_eq!(pressure, exact, epsilon = 0.0, max_relative = 1e-14);
            }
        }
    }
}

#[test]
fn a_tilted_flat_punch_rests_on_one_corner() {
    // g = m: F = κ m L, P = (κ m/π) sqrt((a - x)/(x - x₀)).
    let (m, x0) = (0.03, -0.4);
    let load = KAPPA * m * 0.7;
    for sign in [1.0, -1.0] {
        let range = if sign > 0.0 { [x0, 3.0] } else { [-3.0, -x0] };
        let body = Quadratic([sign * m, 0.0, 0.0]).body(range[0], range[1]);
        let (left, right) =
            if sign > 0.0 { (Edge::Fixed(x0), Edge::Free) } else { (Edge::Free, Edge::Fixed(-x0)) };
        let contact = Contact::new(&Flat, &*body).unwrap().kappa(KAPPA).edges(left, right);
        let solution = contact.solve(Control::Load(load)).unwrap();
        let a = if sign > 0.0 { solution.a() } else { solution.b() };
        assert_relative_eq!(a, x0 + 1.4, epsilon = 0.0, max_relative = 4e-15);
        let pressure = solution.pressure().unwrap();
        for i in 1..20 {
            let x = x0 + 0.07 * f64::from(i);
            let exact = KAPPA * m / PI * ((a - x) / (x - x0)).sqrt();
            assert_close(pressure.at(sign * x).unwrap(), exact, 1e-13);
        }
        check_integrals(&solution, |_| sign * m, KAPPA);
        solution.certify().unwrap();
    }
}

#[test]
fn flat_and_tilted_punches_between_two_corners() {
    let l = 0.5;
    for (m, load) in [(0.0, 2.0), (0.3, 2.0), (-0.9, 0.8), (0.2, 0.0), (0.0, -1.0)] {
        let body = Quadratic([m, 0.0, 0.0]).body(-1.0, 1.0);
        let contact = Contact::new(&Flat, &*body).unwrap().kappa(KAPPA);
        let contact = contact.edges(Edge::Fixed(-l), Edge::Fixed(l)).single_interval(true);
        let solution = contact.solve(Control::Load(load)).unwrap();
        assert_eq!([solution.a(), solution.b(), solution.load()], [l, l, load]);
        let pressure = solution.pressure().unwrap();
        for i in -9..10 {
            let x = 0.05 * f64::from(i);
            let root = PI * (l * l - x * x).sqrt();
            let exact = (load - KAPPA * m * x) / root;
            let got = pressure.at(x).unwrap();
            assert_abs_diff_eq!(got, exact, epsilon = 4e-15 * (load.abs() + 1.0) / root);
        }
    }
}

#[test]
fn two_adhesive_edges_give_the_line_contact_of_johnson_kendall_and_roberts() {
    // F = π E* L²/(4 R) - sqrt(2 π E* w L).
    let (modulus, work, radius) = (3.0, 0.02, 1.5);
    let body = Quadratic([0.0, 1.0 / radius, 0.0]).body(-9.0, 9.0);
    let contact = Contact::new(&Flat, &*body).unwrap().contact_modulus(modulus);
    let contact = contact.edges(Edge::Adhesive(work), Edge::Adhesive(work));
    let load =
        |l: f64| PI * modulus * l * l / (4.0 * radius) - (2.0 * PI * modulus * work * l).sqrt();
    let kappa = PI * modulus / 2.0;
    let least = (radius * radius * work / kappa).cbrt();
    let at_zero = (16.0 * radius * radius * work / kappa).cbrt();
    assert!(load(at_zero).abs() < 1e-15);
    for l in [at_zero, 1.02 * least, 1.2 * least, 1.5 * least, 1.3 * at_zero, 5.0] {
        let solution = contact.solve(Control::Load(load(l))).unwrap();
        // Near pull-off dF/dL vanishes, and a rounded load leaves L more uncertain.
        let stiffness = kappa * l / radius - (kappa * work / l).sqrt();
        let open = 1e-15 * (1.0 + (kappa * work / l).sqrt() / stiffness * 4.0);
        assert_relative_eq!(solution.a(), l, epsilon = 0.0, max_relative = 4.0 * open);
        assert_relative_eq!(solution.b(), l, epsilon = 0.0, max_relative = 4.0 * open);
        let pressure = solution.pressure().unwrap();
        for i in -9..10 {
            let x = 0.1 * f64::from(i) * l;
            let root = (l * l - x * x).sqrt();
            let hertz = kappa * root / (PI * radius);
            let pull = 2.0 * (kappa * work * l).sqrt() / (PI * root);
            let got = pressure.estimate(x, &mut Default::default()).unwrap().value;
            assert_abs_diff_eq!(got, hertz - pull, epsilon = 100.0 * open * (hertz + pull));
        }
        check_integrals(&solution, |x| x / radius, kappa);
    }
}

#[test]
fn one_adhesive_edge_draws_the_contact_to_its_side() {
    // α = -sqrt(κ w/L)/π = -β: F = κ L²/(2 R) - sqrt(κ w L), c = -R sqrt(w/(κ L)) if on the left.
    let (work, radius) = (3e-3, 2.0);
    for l in [0.4, 0.9f64] {
        let pull = (KAPPA * work * l).sqrt();
        let load = KAPPA * l * l / (2.0 * radius) - pull;
        let c = -radius * (work / (KAPPA * l)).sqrt();
        let cases = [
            on_parabola(load, radius, Edge::Adhesive(work), Edge::Free),
            mirrored(on_parabola(load, radius, Edge::Free, Edge::Adhesive(work))),
        ];
        for [a, b, ..] in cases {
            assert_relative_eq!(a, c + l, epsilon = 0.0, max_relative = 1e-14);
            assert_relative_eq!(b, l - c, epsilon = 0.0, max_relative = 1e-14);
        }
    }
}

#[test]
fn a_corner_and_an_adhesive_edge() {
    // F R = κ L (3 L/2 + x₀) - 2 R sqrt(κ w L), down to loads that pull.
    let (work, radius, x0) = (3e-3, 2.0, -0.1);
    for l in [0.25, 0.4, 0.9f64] {
        let load = KAPPA * l * (1.5 * l + x0) / radius - 2.0 * (KAPPA * work * l).sqrt();
        let cases = [
            on_parabola(load, radius, Edge::Fixed(x0), Edge::Adhesive(work)),
            mirrored(on_parabola(load, radius, Edge::Adhesive(work), Edge::Fixed(-x0))),
        ];
        for [a, b, ..] in cases {
            assert_eq!(b, -x0);
            assert_relative_eq!(a, x0 + 2.0 * l, epsilon = 0.0, max_relative = 1e-14);
        }
    }
}

#[test]
fn adhesion_of_no_work_is_none() {
    let body = Quadratic([-0.02, 1.0, 0.4]).body(-0.8, 0.8);
    let contact = Contact::new(&Flat, &*body).unwrap().single_interval(true);
    let none = Edge::Adhesive(0.0);
    for other in [Edge::Free, none, Edge::Fixed(0.3)] {
        let without =
            contact.clone().edges(Edge::Free, if other == none { Edge::Free } else { other });
        let without = without.solve(Control::Load(0.04)).unwrap();
        let with = contact.clone().edges(none, other);
        let with = with.solve(Control::Load(0.04)).unwrap();
        assert_relative_eq!(with.a(), without.a(), epsilon = 0.0, max_relative = 2e-15);
        assert_relative_eq!(with.b(), without.b(), epsilon = 0.0, max_relative = 2e-15);
        let [with, without] = [&with, &without].map(|s| s.pressure().unwrap().at(0.05).unwrap());
        assert_relative_eq!(with, without, epsilon = 0.0, max_relative = 1e-14);
    }
}

/// 0.1 + 0.2 is more than 0.3.
#[test]
fn an_edge_at_an_end_but_for_rounding_is_at_the_end() {
    let body = linecontact::profile::Parabola::new(1.0, [-3.0, 0.3]).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap().kappa(1.0);
    for edge in [Edge::Fixed, Edge::FreeUntil] {
        let solve = |x| contact.clone().edges(Edge::Free, edge(x)).solve(Control::Load(0.1));
        let [exact, rounded] = [0.3, 0.1 + 0.2].map(|x| solve(x).unwrap());
        assert_eq!(rounded.intervals(), exact.intervals());
        assert_eq!(rounded.a(), 0.3);
    }
}

#[test]
fn edges_beyond_the_bodies_are_named() {
    let contact = on_flat(parabola(1.0));
    let error = |left, right, load| contact.clone().edges(left, right).solve(load).unwrap_err();
    let load = Control::Load(0.1);
    for (left, right, x) in [
        (Edge::Free, Edge::Fixed(1.5), 1.5),
        (Edge::Fixed(-1.5), Edge::Free, -1.5),
        (Edge::Fixed(-1.5), Edge::Fixed(0.5), -1.5),
        (Edge::Fixed(1.5), Edge::Adhesive(0.1), 1.5),
        (Edge::Free, Edge::FreeUntil(1.5), 1.5),
    ] {
        let range = [-1.0, 1.0];
        assert_eq!(
            error(left, right, load),
            ContactError::Solve(SolveError::OutsideBodies { x, range })
        );
        let by_rule = contact.clone().edges(left, right).quadrature(&Midpoint::DEFAULT);
        let error = by_rule.solve(load).unwrap_err();
        assert_eq!(error, ContactError::Solve(SolveError::OutsideBodies { x, range }));
    }
    let peak = error(Edge::Free, Edge::FreeUntil(1.5), Control::PeakPressure(0.1));
    assert_eq!(peak, ContactError::Solve(SolveError::OutsideBodies { x: 1.5, range: [-1.0, 1.0] }));
}
