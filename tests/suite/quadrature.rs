//! The paper's quadrature: its orders, its tables, pressures at any x, and the residual of the
//! equation.
#![allow(missing_docs)]

use crate::common;
use crate::common::NanSafe;

use approx::assert_relative_eq;
use common::{
    example_1_exact, example_2_exact, graph, join, on_flat, order, paper, parabola, reference,
    scenes,
};
use linecontact::Cost;
use linecontact::{
    Contact, ContactError, Control, Edge, EdgePressure, EvaluationError, Exponents, Flat, Interval,
    Midpoint, Solution,
};
use std::f64::consts::PI;

const EVEN: Exponents = Exponents::Even;
const HALF_ODD: Exponents = Exponents::HalfInteger;

fn rule(segments: usize, extrapolations: u32, exponents: Exponents) -> Midpoint {
    Midpoint { segments, extrapolations, exponents }
}

/// Returns the pressure of Example 1 or 2 at x, for its exact limits.
fn pressure(example: usize, rule: Midpoint, xs: &[f64]) -> Vec<f64> {
    let (scene, kappa, on) = match example {
        1 => (paper::one(), 1.0, Interval { left: -1.0, right: 1.0 }),
        _ => (paper::two(), PI / 2.0, Interval { left: -0.6, right: 1.0 }),
    };
    let contact = Contact::new(&*scene.lower, &*scene.upper).unwrap().kappa(kappa);
    let contact = contact.edges(Edge::Fixed(on.left), Edge::Fixed(on.right)).quadrature(&rule);
    let contact = contact.single_interval(true);
    let solution = contact.solve(Control::Load(scene.c / PI)).unwrap();
    let pressure = solution.pressure().unwrap();
    xs.iter().map(|&x| pressure.at(x).unwrap()).collect()
}

fn exact(example: usize, x: f64) -> f64 {
    if example == 1 { example_1_exact(x) } else { example_2_exact(x) }
}

/// Returns the order in N of a rule at each of some x, on the grid and off it.
fn orders(example: usize, extrapolations: u32, exponents: Exponents, xs: &[f64]) -> Vec<f64> {
    let sizes = [32, 64, 128, 256];
    let runs = sizes.map(|n| pressure(example, rule(n, extrapolations, exponents), xs));
    let errors = |i: usize| -> Vec<(usize, f64)> {
        let error = |(n, run): (usize, &Vec<f64>)| (n, (run[i] - exact(example, xs[i])).abs());
        sizes.into_iter().zip(&runs).map(error).collect()
    };
    (0..xs.len()).map(|i| order(&errors(i))).collect()
}

fn assert_order(got: Vec<f64>, want: f64) {
    assert!(got.iter().all(|order| (order - want).abs() < 0.12), "{got:?} where {want} was due");
}

/// Places on the grid of every N used, z = -1/2 and 1/4, and off every grid.
const XS_1: [f64; 4] = [-0.5, 0.25, 0.1234, -0.6180339];
const XS_2: [f64; 4] = [-0.2, 0.4, 0.3333, -0.4142135];

#[test]
fn example_1_converges_with_the_even_orders() {
    assert_order(orders(1, 1, EVEN, &XS_1), 2.0);
    assert_order(orders(1, 2, EVEN, &XS_1), 4.0);
}

#[test]
fn a_third_extrapolation_gains_two_more_orders() {
    // From N = 8: at 32 segments the error is already rounding.
    let sizes = [6, 8, 12, 16];
    let error = |n| (pressure(1, rule(n, 3, EVEN), &[0.1234])[0] - exact(1, 0.1234)).abs();
    let got = order(&sizes.map(|n| (n, error(n))));
    assert!((5.0..7.5).contains(&got), "{got}");
}

#[test]
fn example_2_converges_with_the_half_odd_orders() {
    // The paper's extrapolation reduces the error by a factor, without raising the order.
    assert_order(orders(2, 1, EVEN, &XS_2), 1.5);
    assert_order(orders(2, 2, EVEN, &XS_2), 1.5);
    assert_order(orders(2, 1, HALF_ODD, &XS_2), 1.5);
    assert_order(orders(2, 2, HALF_ODD, &XS_2), 2.5);
    assert_order(orders(2, 3, HALF_ODD, &XS_2), 3.5);
}

#[test]
fn the_trapezoidal_sum_is_of_first_order() {
    assert_order(orders(1, 0, EVEN, &XS_1[..2]), 1.0);
    assert_order(orders(2, 0, EVEN, &XS_2[..2]), 1.0);
    // Twice the finer sum less the coarser is the midpoint rule (Eq. (20)).
    let x = [0.4];
    let [coarse, fine] = [64, 128].map(|n| pressure(2, rule(n, 0, EVEN), &x)[0]);
    let midpoint = pressure(2, rule(64, 1, EVEN), &x)[0];
    assert_relative_eq!(2.0 * fine - coarse, midpoint, epsilon = 0.0, max_relative = 1e-13);
}

/// Compares table entries (N, ET, x, printed error) with the errors, to a relative tolerance.
fn assert_printed(example: usize, exponents: Exponents, rows: &[(usize, u32, f64, f64)], to: f64) {
    for &(n, et, x, printed) in rows {
        let error = (pressure(example, rule(n, et, exponents), &[x])[0] - exact(example, x)).abs();
        assert!((error / printed - 1.0).abs() < to, "N {n} ET {et} x {x}: {error:e}");
    }
}

#[test]
fn entries_of_the_papers_tables() {
    let of_1 = [(64, 1, -0.75, 4.26e-5), (64, 2, 0.5, 2.40e-9), (256, 2, 0.25, 1.83e-12)];
    assert_printed(1, EVEN, &of_1, 3e-3);
    let of_2 = [(256, 1, -0.5, 4.33e-3), (1024, 2, 0.2, 8.36e-6), (4096, 2, 0.9, 9.21e-6)];
    assert_printed(2, EVEN, &of_2, 3e-3);
    // From an independent computation in 20 digits, with the right exponents.
    let right = [
        (64, 2, 0.2, 2.2e-6),
        (64, 3, 0.2, 6.0e-10),
        (256, 2, 0.2, 7.0e-8),
        (256, 3, 0.2, 4.7e-12),
    ];
    assert_printed(2, HALF_ODD, &right, 0.03);
}

#[test]
fn any_x_has_the_accuracy_of_the_grid() {
    // The error of the rule itself is only 2e-14 here: x at, next to and around points of the
    // coarsest and the finest level, where sum and correction both have a pole, and elsewhere.
    let n = 64;
    let mut xs: Vec<f64> = (-50..50).map(|i| 0.2 + 0.8 * f64::from(i) / 1503.0).collect();
    for level in [n, 2 * n, 8 * n] {
        let point = -0.6 + 1.6 * (level as f64 / 2.0 + 0.5) / level as f64;
        xs.push(point);
        for exponent in 1..18 {
            let step = 0.8 / level as f64 * 10f64.powi(-exponent);
            xs.extend([point + step, point - step, point + 0.61 * step]);
        }
    }
    let worst = |et, exponents| {
        let got = pressure(2, rule(n, et, exponents), &xs);
        let error = |(&x, p): (&f64, f64)| (p / example_2_exact(x) - 1.0).abs();
        xs.iter().zip(got).map(error).fold(0.0, NanSafe::nan_max)
    };
    // On the grid, at x = 0.2, the three have 3.0e-4, 4.2e-5 and 1.8e-14.
    let [midpoint, paper, right] = [worst(1, EVEN), worst(2, EVEN), worst(4, HALF_ODD)];
    assert!(
        midpoint < 3.1e-4 && paper < 4.3e-5 && right < 4e-14,
        "{midpoint:e} {paper:e} {right:e}"
    );
}

#[test]
fn an_odd_number_of_segments_has_a_point_at_the_centre() {
    for n in [3, 5, 63, 101] {
        let p = pressure(2, rule(n, 4, HALF_ODD), &[0.2])[0];
        let error = (p / 12.8 - 1.0).abs();
        assert!(error < 0.3 * (n as f64).powf(-4.0), "{n}: {error:e}");
    }
}

/// Returns the residual of the equation, PV∫ P/(x - s) ds - κ g, by an independent rule.
///
/// In s = c + L cos φ, with x = c + L cos θ, the constant P(x) sin θ is subtracted, whose principal
/// value is zero; the remainder is smooth and periodic.
fn residual(solution: &Solution<'_, f64>, x: f64, kappa_g: f64) -> f64 {
    let Interval { left, right } = solution.hull();
    let (c, l) = ((right + left) / 2.0, (right - left) / 2.0);
    let pressure = solution.pressure().unwrap();
    let theta = ((x - c) / l).acos();
    let here = pressure.at(x).unwrap() * theta.sin();
    let m = 40;
    let term = |j: usize| {
        let phi = PI * (j as f64 + 0.5) / m as f64;
        let there = pressure.at(c + l * phi.cos()).unwrap() * phi.sin();
        (there - here) / (theta.cos() - phi.cos())
    };
    (0..m).map(term).sum::<f64>() * PI / m as f64 - kappa_g
}

#[test]
fn the_pressure_satisfies_the_equation() {
    // f = x + 0.6 x² + 4 x³ against a flat, κ = 2: no closed form is used.
    let slope = |x: f64| x + 0.6 * x * x + 4.0 * x.powi(3);
    let body = graph(-1.0, 1.0, move |x| [x * x / 2.0 + x.powi(3) / 5.0 + x.powi(4), slope(x)]);
    let rule = rule(4096, 4, HALF_ODD);
    let contact = Contact::new(&Flat, &*body).unwrap().kappa(2.0).quadrature(&rule);
    let solution = contact.solve(Control::Load(0.2)).unwrap();
    let Interval { left, right } = solution.hull();
    for z in [-0.71, -0.3, 0.013, 0.44, 0.83] {
        let x = (right + left) / 2.0 + z * (right - left) / 2.0;
        let relative = residual(&solution, x, 2.0 * slope(x)) / slope(right);
        assert!(relative.abs() < 1e-9, "{relative:e} at z = {z}");
    }
    // Equilibrium: the pressure adds up to the load (Gauss rule for sqrt(1 - z²) times a
    // polynomial).
    let pressure = solution.pressure().unwrap();
    let (m, l) = (30, (right - left) / 2.0);
    let term = |j: usize| {
        let phi = PI * j as f64 / (m + 1) as f64;
        pressure.at((right + left) / 2.0 + l * phi.cos()).unwrap() * phi.sin()
    };
    let load = (1..=m).map(term).sum::<f64>() * l * PI / (m + 1) as f64;
    assert_relative_eq!(load, 0.2, epsilon = 0.0, max_relative = 1e-10);
}

#[test]
fn pressures_agree_with_the_references() {
    // Away from the edges, where the rule is meant to hold; a breakpoint inside breaks its
    // expansion.
    for scene in scenes() {
        let tolerance = match scene.name {
            "paper_example_2" | "hertz_tiny" | "hertz_huge" | "k3eps_hertz" => 1e-9,
            "paper_example_3_scale_one" | "paper_example_3_scale_half_pi" => 1e-9,
            "gear_involute_pitch_point" => 1e-9,
            "paper_example_4_scale_one" | "paper_example_5_scale_one" => 2e-4,
            _ => continue,
        };
        let want = reference(scene.name);
        let rule = rule(256, 4, HALF_ODD);
        let contact = scene.contact().quadrature(&rule);
        let solution = contact.solve(Control::Load(want.c / PI)).unwrap();
        let pressure = solution.pressure().unwrap();
        let mut compared = 0;
        for &[x, p] in want.points.iter().filter(|[x, _]| want.z(*x).abs() < 0.95) {
            let got = pressure.at(x).unwrap();
            assert!((got / p - 1.0).abs() < tolerance, "{} at {x:e}: {got} is not {p}", scene.name);
            compared += 1;
        }
        assert!(compared >= 9, "{}: only {compared} points", scene.name);
    }
}

#[test]
fn a_pressure_carries_its_doubt() {
    // Up to the edge the estimate covers the error, without being far too large.
    let rules =
        [rule(64, 4, HALF_ODD), rule(1024, 2, EVEN), rule(256, 1, EVEN), rule(128, 3, EVEN)];
    for (name, scene) in
        [("paper_example_2", paper::two()), ("paper_example_3_scale_one", paper::three())]
    {
        let want = reference(name);
        for rule in rules {
            let contact = Contact::new(&*scene.lower, &*scene.upper).unwrap();
            let contact = contact.kappa(want.kappa).quadrature(&rule);
            let solution = contact.solve(Control::Load(want.c / PI)).unwrap();
            let pressure = solution.pressure().unwrap();
            for &[x, p] in &want.points {
                let estimate = pressure.estimate(x, &mut linecontact::Cost::default()).unwrap();
                let error = (estimate.value - p).abs();
                let place = format!("{name} {rule:?} at z = {}: {error:e}", want.z(x));
                assert!(error <= estimate.error + 1e-11 * p, "{place} {estimate:?}");
                if rule.exponents == EVEN && want.z(x).abs() > 1e-9 {
                    assert!(estimate.error <= 6.0 * error, "{place} {estimate:?}");
                }
                match pressure.at(x) {
                    Ok(value) => assert!((value / p - 1.0).abs() < 0.6, "{place}"),
                    Err(ContactError::Evaluation(EvaluationError::Unresolved { .. })) => {
                        assert!(error > 0.1 * p, "{place}");
                    }
                    Err(other) => panic!("{place}: {other}"),
                }
            }
        }
    }
}

#[test]
fn outside_the_contact_the_pressure_is_zero() {
    let contact = on_flat(common::parabola(1.0));
    let solution = contact.solve(Control::Load(0.02)).unwrap();
    let pressure = solution.pressure().unwrap();
    for x in [solution.a(), -solution.b(), 0.21, -0.9, 1.0] {
        assert_eq!(pressure.at(x), Ok(0.0));
    }
}

#[test]
fn cost_is_counted() {
    let body = common::parabola(1.0);
    let rule = Midpoint::paper(64, 2);
    let contact = Contact::new(&Flat, &*body).unwrap().quadrature(&rule);
    let solution = contact.solve(Control::Load(0.02)).unwrap();
    let pressure = solution.pressure().unwrap();
    assert_eq!(pressure.cost().samples, 64 + 128);
    let centre = solution.hull().centre();
    let mut on_grid = linecontact::Cost::default();
    pressure.estimate(centre, &mut on_grid).unwrap();
    assert_eq!(on_grid.samples, 0);
    let mut off_grid = linecontact::Cost::default();
    pressure.estimate(centre + 0.01234, &mut off_grid).unwrap();
    assert_eq!(off_grid.samples, 1);
}

#[test]
fn next_to_a_point_of_the_rule_the_pressure_is_continuous() {
    // Within a sixteenth of a segment the pole is combined with the point; the two formulas agree.
    let body = graph(-1.0, 1.0, |x| {
        let (u, v) = (x * x, 1.0 + x * (0.3 + x * (2.0 + x * (1.0 + 3.0 * x))));
        [u / 2.0 + x.powi(3) / 10.0 + u * u / 2.0 + x.powi(5) / 5.0 + u.powi(3) / 2.0, x * v]
    });
    let rule = rule(8, 1, EVEN);
    let contact = Contact::new(&Flat, &*body).unwrap().quadrature(&rule);
    let solution = contact.solve(Control::HalfWidth(0.5)).unwrap();
    let (on, pressure) = (solution.hull(), solution.pressure().unwrap());
    let at = |place: f64| {
        let x = on.left + (on.right - on.left) * (place / 8.0);
        pressure.estimate(x, &mut Default::default()).unwrap().value
    };
    for i in [1, 3, 4, 6] {
        let point = f64::from(i) + 0.5;
        for border in [point - 0.0625, point + 0.0625] {
            let [below, above] = [at(border - 1e-9), at(border + 1e-9)];
            assert!((above / below - 1.0).abs() < 1e-8, "{i}: {below} {above}");
        }
    }
}

#[test]
fn pressure_next_to_a_jump_of_the_slope() {
    // The wedge m|x|: P = (2 m/π²) arcosh(L/|x|), infinite at the breakpoint.
    let m = 0.25;
    let wedge =
        join(vec![graph(-1.0, 0.0, move |x| [-m * x, -m]), graph(0.0, 1.0, move |x| [m * x, m])]);
    let rule = Midpoint::default();
    let contact = Contact::new(&Flat, &*wedge).unwrap().quadrature(&rule);
    let solution = contact.solve(Control::Load(2.0 * m * 0.2 / PI)).unwrap();
    let pressure = solution.pressure().unwrap();
    for x in [1e-12, 1e-9, 1e-6, 1e-5, 1e-4, 1e-3, 3e-3, 0.01, 0.05, 0.15] {
        let exact = 2.0 * m / (PI * PI) * (0.2f64 / x).acosh();
        for x in [x, -x] {
            let estimate = pressure.estimate(x, &mut Cost::default()).unwrap();
            let error = (estimate.value - exact).abs();
            assert!(error <= estimate.error, "{x:e}: {error:e} {estimate:?}");
            if let Ok(value) = pressure.at(x) {
                assert!((value / exact - 1.0).abs() < 0.5, "{x:e}: {value} for {exact}");
            }
        }
    }
    assert!(matches!(
        pressure.at(0.0),
        Err(ContactError::Evaluation(EvaluationError::Unresolved { .. }))
    ));
}

#[test]
fn rules_too_coarse_to_know() {
    let body = parabola(1.0);
    for (segments, extrapolations) in [(1, 0), (1, 1), (2, 0), (2, 1), (3, 0), (3, 2)] {
        let rule = Midpoint { segments, extrapolations, exponents: Exponents::Even };
        let contact = Contact::new(&Flat, &*body).unwrap().quadrature(&rule);
        let solution = contact.solve(Control::Load(0.02)).unwrap();
        let pressure = solution.pressure().unwrap();
        for z in [-0.9, -0.4, 0.0, 0.01, 0.6, 0.99] {
            let exact = 0.2 * (1.0f64 - z * z).sqrt() / PI;
            let estimate = pressure.estimate(0.2 * z, &mut Cost::default()).unwrap();
            assert!((estimate.value - exact).abs() <= estimate.error + 1e-15, "{rule:?} {z}");
            assert!(estimate.value.is_finite() && estimate.error.is_infinite(), "{estimate:?}");
        }
        // Fewer than four segments leave no way to judge the result.
        assert!(matches!(
            pressure.at(0.0),
            Err(ContactError::Evaluation(EvaluationError::Unresolved { .. }))
        ));
    }
    // Limits by Eq. (6) with such a rule have a large estimate, too.
    let rule = Midpoint::paper(1, 0);
    let edges = EdgePressure::zero(0.01, 1e-6);
    let contact = Contact::new(&Flat, &*body).unwrap().edge_pressure(edges).quadrature(&rule);
    if let Ok(solution) = contact.solve(Control::Load(0.02)) {
        assert!(solution.limits_error().unwrap() > 0.1, "{solution:?}");
    }
}
