//! The limits a and b: against 25-digit references, from poor starts, under the symmetries of
//! the problem, and by every strategy.
#![allow(missing_docs)]

use crate::common;
use crate::common::NanSafe;

use approx::assert_relative_eq;
use common::{graph, paper, parabola, reference, scenes};
use linecontact::search::{Bisection, Brent, LimitSearch, Newton, Secant};
use linecontact::{
    Contact, Control, Curve, CurvePoint, Edge, EdgePressure, Exponents, Flat, Interval, Midpoint,
    ParametricProfile,
};
use std::f64::consts::PI;

fn close(got: f64, want: f64, tolerance: f64, what: &str) {
    assert!((got / want - 1.0).abs() <= tolerance, "{what}: {got} is not {want}");
}

#[test]
fn limits_agree_with_the_references() {
    for scene in scenes() {
        let want = reference(scene.name);
        let contact = scene.contact();
        let solution = contact.solve(Control::Load(want.c / PI)).expect(scene.name);
        println!(
            "{:32} a {:9.1e}  b {:9.1e}  estimate {:8.1e}  {:?}",
            scene.name,
            solution.a() / want.a - 1.0,
            solution.b() / want.b - 1.0,
            solution.limits_error().unwrap(),
            solution.cost()
        );
        close(solution.a(), want.a, scene.accuracy, scene.name);
        close(solution.b(), want.b, scene.accuracy, scene.name);
    }
}

#[test]
fn poor_starts_converge() {
    for scene in scenes() {
        let want = reference(scene.name);
        if scene.name == "hertz_offcentre" {
            continue; // There 10 b is 2^30 away from the contact.
        }
        let width = want.half_width();
        let starts = [
            (10.0 * want.b, 10.0 * want.a),
            (0.1 * want.b, 0.1 * want.a),
            (want.b - 1.5 * width, want.a + 2.0 * width),
            (want.b + 3.0 * width, want.a - 1.9 * width),
        ];
        for (b, a) in starts {
            let contact = scene.contact().start(Interval { left: -b, right: a });
            let solution = contact.solve(Control::Load(want.c / PI)).expect(scene.name);
            close(solution.a(), want.a, scene.accuracy, scene.name);
            close(solution.b(), want.b, scene.accuracy, scene.name);
        }
    }
}

#[test]
fn every_strategy_serves_for_either_search() {
    let strategies: [&dyn LimitSearch<f64>; 4] =
        [&Bisection::default(), &Secant::default(), &Brent::default(), &Newton::default()];
    for scene in scenes() {
        let want = reference(scene.name);
        for strategy in strategies {
            for contact in
                [scene.contact().limit_search(strategy), scene.contact().inversion(strategy)]
            {
                // Bisection of a curve with its zero at k = 0 goes on to the smallest number.
                let solution = contact.solve(Control::Load(want.c / PI)).expect(scene.name);
                close(solution.a(), want.a, scene.accuracy, scene.name);
                close(solution.b(), want.b, scene.accuracy, scene.name);
            }
        }
    }
}

/// A pair of bodies without any symmetry, and their limits.
fn lopsided() -> (impl Fn(f64) -> [f64; 2] + Copy, f64) {
    (|x: f64| [x * x / 2.0 + x * x * x / 5.0 + x.powi(4), x + 0.6 * x * x + 4.0 * x.powi(3)], 0.03)
}

fn limits_of(lower: &dyn ParametricProfile<f64>, upper: &dyn ParametricProfile<f64>) -> [f64; 2] {
    let contact = Contact::new(lower, upper).unwrap();
    let solution = contact.solve(Control::Load(0.03)).unwrap();
    [solution.b(), solution.a()]
}

#[test]
fn mirror_swap_shift_and_scale() {
    let (f, load) = lopsided();
    let [b, a] = limits_of(&Flat, &*graph(-0.8, 0.8, f));
    assert!((a - b).abs() > 0.01 * a, "the scene is meant to be lopsided");

    let mirrored = graph(-0.8, 0.8, move |x| {
        let [y, dy] = f(-x);
        [y, -dy]
    });
    assert_relative_eq!(
        limits_of(&Flat, &*mirrored)[..],
        [a, b][..],
        epsilon = 0.0,
        max_relative = 4e-15
    );

    // The gap decides, not which body is curved: turned upside down it is the lower one.
    let below = graph(-0.8, 0.8, move |x| f(x).map(|v| -v));
    assert_relative_eq!(
        limits_of(&*below, &Flat)[..],
        [b, a][..],
        epsilon = 0.0,
        max_relative = 4e-15
    );

    // The same curve by another parameter, running the other way.
    let other = Curve::new([-0.7, 0.7], move |k: f64| {
        let (x, dx) = (-k - k * k * k, -1.0 - 3.0 * k * k);
        let [y, dy] = f(x);
        CurvePoint { x, y, dx, dy: dy * dx }
    });
    assert_relative_eq!(
        limits_of(&Flat, &other)[..],
        [b, a][..],
        epsilon = 0.0,
        max_relative = 4e-15
    );

    // A common tilt and bend changes nothing.
    let bent = |x: f64| [0.3 * x - x * x, 0.3 - 2.0 * x];
    let sum = move |x: f64| [f(x)[0] + bent(x)[0], f(x)[1] + bent(x)[1]];
    let both = limits_of(&*graph(-0.8, 0.8, bent), &*graph(-0.8, 0.8, sum));
    assert_relative_eq!(both[..], [b, a][..], epsilon = 0.0, max_relative = 1e-14);

    let shifted = graph(-0.3, 1.3, move |x| f(x - 0.5));
    assert_relative_eq!(
        limits_of(&Flat, &*shifted)[..],
        [b - 0.5, a + 0.5][..],
        epsilon = 0.0,
        max_relative = 1e-14
    );

    // Lengths times s and pressures times p: loads per length times s p.
    for (s, p) in [(1024.0, 1.0), (1e-6, 1e11), (3.0, 0.1)] {
        let scaled = graph(-0.8 * s, 0.8 * s, move |x| [s * f(x / s)[0], f(x / s)[1]]);
        let contact = Contact::new(&Flat, &*scaled).unwrap().kappa(p);
        let solution = contact.solve(Control::Load(load * s * p)).unwrap();
        assert_relative_eq!(solution.a(), s * a, epsilon = 0.0, max_relative = 4e-15);
        assert_relative_eq!(solution.b(), s * b, epsilon = 0.0, max_relative = 4e-15);
    }
}

#[test]
fn a_gap_that_is_not_convex() {
    // f = x²/2 + x³ has a second level point at x = -1/3. With g = x + 3 x² the conditions are
    // c + 3 c² + 3 L²/2 = 0 and 2 F = L² (1 + 6 c): F = L² sqrt(1 - 18 L²)/2, at most 0.010692.
    let body = graph(-1.0, 1.0, |x| [x * x / 2.0 + x.powi(3), x + 3.0 * x * x]);
    let contact = Contact::new(&Flat, &*body).unwrap().single_interval(true);
    for load in [1e-6, 1e-3, 5e-3, 0.01, 0.0106] {
        let l = contact.solve(Control::Load(load)).unwrap().hull().half_width();
        let carried = l * l * (1.0 - 18.0 * l * l).sqrt() / 2.0;
        assert_relative_eq!(carried, load, epsilon = 0.0, max_relative = 1e-14);
        assert!(l * l < 1.0 / 27.0, "the branch that grows with the load");
    }
    for load in [0.0107, 0.011, 0.02] {
        assert!(contact.solve(Control::Load(load)).is_err(), "{load}");
    }
}

#[test]
fn the_scale_has_two_names() {
    let body = parabola(1.0);
    let contact = Contact::new(&Flat, &*body).unwrap();
    let by_modulus = contact.clone().contact_modulus(3.0);
    let modulus = by_modulus.solve(Control::Load(0.1)).unwrap();
    let kappa = contact.kappa(1.5 * PI).solve(Control::Load(0.1)).map(|s| [s.a(), s.load()]);
    assert_eq!(kappa.unwrap(), [modulus.a(), modulus.load()]);
    // Hertz: L² = 4 F R/(π E*).
    assert_relative_eq!(
        modulus.a(),
        (0.4 / (3.0 * PI)).sqrt(),
        epsilon = 0.0,
        max_relative = 1e-15
    );
}

#[test]
fn edge_pressures_of_the_exact_solution_give_its_limits() {
    // Eq. (6) with A and B that the exact pressure has at these distances.
    let example = paper::two();
    let (eps_a, eps_b) = (0.05, 0.02);
    let wanted = EdgePressure {
        at_a: common::example_2_exact(1.0 - eps_a),
        at_b: common::example_2_exact(eps_b - 0.6),
        distance_a: eps_a,
        distance_b: eps_b,
        tolerance_a: 1e-7,
        tolerance_b: 1e-7,
    };
    let rule = Midpoint { segments: 512, extrapolations: 4, exponents: Exponents::HalfInteger };
    let strategies: [&dyn LimitSearch<f64>; 4] =
        [&Bisection::default(), &Secant::default(), &Brent::default(), &Newton::default()];
    let starts = [(0.6, 1.0), (6.0, 10.0), (0.06, 0.1), (-0.5, 3.0)];
    for (strategy, (b, a)) in strategies.into_iter().zip(starts) {
        let contact = Contact::new(&*example.lower, &*example.upper).unwrap().kappa(PI / 2.0);
        let contact = contact.edge_pressure(wanted).quadrature(&rule).limit_search(strategy);
        let contact = contact.start(Interval { left: -b, right: a });
        let solution = contact.solve(Control::Load(example.c / PI)).unwrap();
        assert_relative_eq!(solution.a(), 1.0, epsilon = 0.0, max_relative = 1e-7);
        assert_relative_eq!(solution.b(), 0.6, epsilon = 0.0, max_relative = 1e-7);
        // The condition itself, as a user would check it.
        let pressure = solution.pressure().unwrap();
        let at_a = pressure.at(solution.a() - eps_a).unwrap();
        let at_b = pressure.at(eps_b - solution.b()).unwrap();
        assert!((at_a - wanted.at_a).abs() <= 1e-7 && (at_b - wanted.at_b).abs() <= 1e-7);
    }
}

#[test]
fn edge_pressures_approach_the_free_limits() {
    // With A = B = 0 the limits are too narrow by about ε, and the rule adds its own error.
    let example = paper::three();
    let want = reference("paper_example_3_scale_one");
    let rule = Midpoint::paper(1024, 2);
    let mut last = f64::INFINITY;
    for eps in [4e-3, 1e-3, 2.5e-4] {
        let edges = EdgePressure::zero(eps, 1e-6);
        let contact = Contact::new(&*example.lower, &*example.upper).unwrap();
        let contact = contact.edge_pressure(edges).quadrature(&rule);
        let solution = contact.solve(Control::Load(example.c / PI)).unwrap();
        let error =
            (solution.a() / want.a - 1.0).abs().nan_max((solution.b() / want.b - 1.0).abs());
        assert!(error < 0.6 * last, "{error} at ε = {eps}, {last} at four times that");
        last = error;
    }
    assert!(last < 1e-2);
}

#[test]
fn edge_singularities_vanish_at_free_edges_and_answer_at_fixed_ones() {
    let body = parabola(1.0);
    let contact = Contact::new(&Flat, &*body).unwrap();
    let free = contact.solve(Control::Load(0.08)).unwrap();
    let scale = 0.08 / free.a();
    assert!(free.edge_singularities().iter().all(|k| k.abs() < 1e-14 * scale));

    // A flat punch of half-width 0.5, tilted by m: P = (F - m x)/(π sqrt(L² - x²)) for κ = 1, so
    // K = (F - m x)/(π L) at each edge.
    let (m, load) = (0.3, 2.0);
    let tilted = graph(-1.0, 1.0, move |x| [m * x, m]);
    let on = Interval { left: -0.5, right: 0.5 };
    let contact =
        Contact::new(&Flat, &*tilted).unwrap().edges(Edge::Fixed(on.left), Edge::Fixed(on.right));
    let solution = contact.solve(Control::Load(load)).unwrap();
    let [k_b, k_a] = solution.edge_singularities();
    assert_relative_eq!(k_a, (load - m * 0.5) / (PI * 0.5), epsilon = 0.0, max_relative = 1e-14);
    assert_relative_eq!(k_b, (load + m * 0.5) / (PI * 0.5), epsilon = 0.0, max_relative = 1e-14);
    assert_eq!(solution.limits_error(), None);
}

#[test]
fn a_flat_body_is_never_evaluated() {
    use std::sync::atomic::{AtomicUsize, Ordering};
    let calls = AtomicUsize::new(0);
    let body = Curve::new([-1.0, 1.0], |k: f64| {
        calls.fetch_add(1, Ordering::Relaxed);
        CurvePoint { x: k, y: k * k / 2.0, dx: 1.0, dy: k }
    });
    let contact = Contact::new(&Flat, &body).unwrap();
    let before = calls.load(Ordering::Relaxed);
    assert_eq!(before, 2, "of a body the two ends are looked at");
    let solution = contact.solve(Control::Load(0.02)).unwrap();
    let cost = solution.cost();
    let calls = calls.load(Ordering::Relaxed) - before;
    assert_eq!(calls, cost.evaluations + cost.heights, "the count is exact");
    // x = k, so that one evaluation inverts it; only the flat could have doubled that.
    assert!(cost.evaluations <= cost.samples + 4, "{cost:?}");
}

#[test]
fn single_precision() {
    let body =
        Curve::new([-2.0f32, 2.0], |k: f32| CurvePoint { x: k, y: k * k, dx: 1.0, dy: 2.0 * k });
    let strategies: [&dyn LimitSearch<f32>; 4] =
        [&Bisection::default(), &Secant::default(), &Brent::default(), &Newton::default()];
    for strategy in strategies {
        let contact =
            Contact::new(&Flat, &body).unwrap().limit_search(strategy).inversion(strategy);
        let solution = contact.solve(Control::Load(0.25)).unwrap();
        assert_relative_eq!(solution.a(), 0.5, epsilon = 0.0, max_relative = 1e-6);
        assert_relative_eq!(solution.b(), 0.5, epsilon = 0.0, max_relative = 1e-6);
        // P(0) = 2 L/π.
        let peak = solution.pressure().unwrap().at(0.1f32).unwrap();
        let exact = 2.0 * (0.25f64 - 0.01).sqrt() / PI;
        assert_relative_eq!(f64::from(peak), exact, epsilon = 0.0, max_relative = 1e-5);
    }
}

#[test]
fn a_curvature_that_jumps_by_two_to_the_27th() {
    // Mirrored, from any start, and by the paper's integrator, which shares no code with the panels.
    let steep = f64::from(1 << 27);
    let bent = |bend: f64| move |x: f64| [bend * x * x / 2.0, bend * x];
    let body = |left, right| {
        common::join(vec![graph(-9.0, 0.0, bent(left)), graph(0.0, 9.0, bent(right))])
    };
    let (right, left) = (body(1.0, steep), body(steep, 1.0));
    let rule = Midpoint::default();
    let scene = Contact::new(&Flat, &*right).unwrap().quadrature(&rule);
    let other = scene.solve(Control::Load(0.3)).unwrap();
    for start in [None, Some((-0.3, 0.3)), Some((3.0, 4.0)), Some((-1e-7, 1e-7))] {
        for (body, mirrored) in [(&right, false), (&left, true)] {
            let mut contact = Contact::new(&Flat, &**body).unwrap();
            if let Some((left, right)) = start {
                contact = contact.start(Interval { left, right });
            }
            let solution = contact.solve(Control::Load(0.3)).unwrap();
            let [a, b] =
                if mirrored { [solution.b(), solution.a()] } else { [solution.a(), solution.b()] };
            assert_relative_eq!(b, other.b(), epsilon = 0.0, max_relative = 2e-15);
            // A millionth of the other, and as exact as that, compared with the half-width.
            assert!((a - other.a()).abs() < 1e-15 * b, "{start:?} {a:e} {:e}", other.a());
        }
    }
}

#[test]
fn a_point_of_first_contact_between_the_ends_of_the_start() {
    // g = x - 100 x³ falls beyond x = ±0.058: at the start it has the signs of a gap that closes.
    // F = L²/2 - 75 L⁴/2.
    let body = graph(-1.0, 1.0, |x| [x * x / 2.0 - 25.0 * x.powi(4), x - 100.0 * x.powi(3)]);
    let brent = Brent::default();
    let contact = Contact::new(&Flat, &*body).unwrap().limit_search(&brent).single_interval(true);
    for l in [0.005, 0.02] {
        let load = l * l / 2.0 - 37.5 * f64::powi(l, 4);
        for start in [Interval { left: -0.31, right: 0.3 }, Interval { left: -0.2, right: 0.9 }] {
            let solution = contact.clone().start(start);
            let solution = solution.solve(Control::HalfWidth(l)).unwrap();
            close(solution.load(), load, 1e-13, "load");
            close(solution.a(), l, 1e-13, "a");
        }
    }
}

#[test]
fn an_edge_at_a_kink() {
    // x²/2 up to the kink, which the contact just does not reach, and much steeper beyond.
    // L = sqrt(2 C/π) from Hertz's F = L²/2.
    for jump in [0.5, 3.0, 5.0] {
        for short in [0.0, 1e-14, 1e-12, 1e-10, 1e-6] {
            let half_width = 1.0 - short;
            let load = Control::Load(half_width * half_width / 2.0);
            let inner = graph(-1.0, 9.0, |x| [x * x / 2.0, x]);
            let outer = graph(-9.0, -1.0, move |x| {
                let d = x + 1.0;
                [0.5 - (1.0 + jump) * d + d * d / 4.0, -1.0 - jump + d / 2.0]
            });
            let body = common::join(vec![outer, inner]);
            let contact = Contact::new(&Flat, &*body).unwrap();
            let solution = contact.solve(load).unwrap();
            for limit in [solution.a(), solution.b()] {
                let error = (limit - half_width).abs();
                assert!(error <= 2e-15, "{jump} {short:e}: {error:e}");
            }
        }
    }
}
