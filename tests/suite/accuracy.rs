//! Accuracy of limits and pressures, its estimates, and its cost.
#![allow(missing_docs)]

use crate::common;
use crate::common::NanSafe;

use approx::assert_relative_eq;
use common::{Counting, graph, on_flat, paper, power, reference, scenes};
use linecontact::{
    Contact, Control, Cost, Curve, CurvePoint, Exponents, Flat, Interval, Midpoint, Panels,
    ParametricProfile, Piecewise,
};
use std::f64::consts::PI;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Contact with limits and pressures that are known independently.
struct Known {
    name: &'static str,
    lower: common::Profile,
    upper: common::Profile,
    load: f64,
    limits: Interval<f64>,
    points: Vec<[f64; 2]>,
}

fn from_reference(name: &'static str, lower: common::Profile, upper: common::Profile) -> Known {
    let want = reference(name);
    assert_eq!(want.kappa, 1.0);
    let points = want.points.iter().copied().filter(|[x, _]| want.z(*x).abs() < 0.99).collect();
    let limits = Interval { left: -want.b, right: want.a };
    Known { name, lower, upper, load: want.c / PI, limits, points }
}

/// Returns a circle of radius 1 on a flat, with the half-width 1/2: `g = tan(asin x)`. The
/// trapezoidal rule gives the Fourier coefficients in θ, and these give the pressure.
fn circle() -> Known {
    const N: usize = 256;
    let l = 0.5;
    let angle = |i: usize| PI * (i as f64 + 0.5) / N as f64;
    let slope = |x: f64| x / ((1.0 - x) * (1.0 + x)).sqrt();
    let coefficient = |k: usize| -> f64 {
        let values = (0..N).map(|i| slope(l * angle(i).cos()) * (k as f64 * angle(i)).cos());
        2.0 / N as f64 * values.sum::<f64>()
    };
    let coefficients: Vec<f64> = (0..60).map(coefficient).collect();
    let points = (1..40).map(|i| {
        let theta = PI * i as f64 / 40.0;
        let terms = coefficients.iter().enumerate().rev();
        [l * theta.cos(), terms.map(|(k, c)| c * (k as f64 * theta).sin()).sum::<f64>() / PI]
    });
    Known {
        name: "circle",
        lower: Box::new(Flat),
        upper: common::circle(-1.5, 1.5, 1.0),
        load: l * coefficients[1] / 2.0,
        limits: Interval { left: -l, right: l },
        points: points.filter(|[x, _]| x.abs() < 0.99 * l).collect(),
    }
}

fn known() -> [Known; 3] {
    let example = paper::three();
    [
        from_reference("paper_example_3_scale_one", example.lower, example.upper),
        from_reference("power_n_20", Box::new(Flat), power(20.0)),
        circle(),
    ]
}

/// Returns the evaluations of each contact at tolerances of 1e-12, 1e-9, 1e-6 and 1e-3, after
/// checking that the errors stay within them.
fn at_tolerances() -> Vec<(&'static str, [usize; 4])> {
    let of = |known: Known| {
        let tolerances = [1e-12, 1e-9, 1e-6, 1e-3];
        let mut evaluations = [0; 4];
        for (i, tolerance) in tolerances.into_iter().enumerate() {
            let panels = Panels { tolerance };
            let contact = Contact::new(&*known.lower, &*known.upper).unwrap().quadrature(&panels);
            let solution = contact.solve(Control::Load(known.load)).unwrap();
            evaluations[i] = solution.cost().evaluations;
            let pressure = solution.pressure().unwrap();
            let largest = known.points.iter().fold(0.0f64, |most, [_, p]| most.max(*p));
            let mut worst = 0.0f64;
            // x = 0 is a breakpoint, see below.
            for &[x, exact] in known.points.iter().filter(|[x, _]| *x != 0.0) {
                let got = pressure.estimate(x, &mut Cost::default()).unwrap().value;
                worst = worst.nan_max((got - exact).abs() / largest);
            }
            let (got, want) = (solution.hull(), known.limits);
            let limits = (got.left - want.left).abs().nan_max((got.right - want.right).abs());
            let limits = limits / want.half_width();
            println!(
                "{:26} tolerance {tolerance:.0e}: limits {limits:.1e} P {worst:.1e}, {:?}",
                known.name,
                solution.cost()
            );
            assert!(worst <= 20.0 * tolerance, "{}: {worst} at {tolerance}", known.name);
            assert!(limits <= 20.0 * tolerance, "{}: {limits} at {tolerance}", known.name);
        }
        (known.name, evaluations)
    };
    known().into_iter().map(of).collect()
}

#[test]
fn a_looser_tolerance_is_kept_and_costs_less() {
    let costs = at_tolerances();
    let share = |(_, cost): &(_, [usize; 4])| cost[3] as f64 / cost[0] as f64;
    let cheapest = costs.iter().map(share).fold(f64::INFINITY, f64::min);
    assert!(cheapest <= 0.8, "{cheapest}");
    assert!(costs.iter().all(|(_, cost)| cost.is_sorted_by(|a, b| a >= b)), "{costs:?}");
}

#[test]
fn a_breakpoint_is_no_singularity_at_any_tolerance() {
    // The slope of |x|²⁰/20 is continuous at its breakpoint.
    let want = reference("power_n_20");
    let exact = want.points.iter().find(|[x, _]| *x == 0.0).expect("the middle")[1];
    let body = power(20.0);
    for tolerance in [1e-12, 1e-9, 1e-6, 1e-3] {
        let panels = Panels { tolerance };
        let contact = Contact::new(&Flat, &*body).unwrap().quadrature(&panels);
        let solution = contact.solve(Control::Load(want.c / PI)).unwrap();
        let got =
            solution.pressure().unwrap().at(0.0).unwrap_or_else(|e| panic!("{tolerance}: {e}"));
        assert!((got / exact - 1.0).abs() <= 20.0 * tolerance, "{got} at {tolerance}");
    }
}

#[test]
fn the_papers_example_3_takes_few_calls() {
    let example = paper::three();
    let calls = AtomicUsize::new(0);
    let (lower, upper) = (Counting(&*example.lower, &calls), Counting(&*example.upper, &calls));
    let panels = Panels { tolerance: 1e-12 };
    let contact = Contact::new(&lower, &upper).unwrap().quadrature(&panels);
    let contact = contact.start(Interval { left: -0.3, right: 0.3 });
    let before = calls.load(Ordering::Relaxed);
    assert_eq!(before, 4, "the ends of both bodies");
    let solution = contact.solve(Control::Load(example.c / PI)).unwrap();
    let (on, mut pressures) = (solution.hull(), [0.0; 101]);
    let x: [f64; 101] = std::array::from_fn(|i| on.at_angle(PI * (i as f64 + 0.5) / 101.0));
    solution.pressure().unwrap().at_many(&x, &mut pressures).unwrap();
    let want = reference("paper_example_3_scale_one");
    assert_relative_eq!(solution.a(), want.a, epsilon = 0.0, max_relative = 2e-11);
    assert_relative_eq!(solution.b(), want.b, epsilon = 0.0, max_relative = 2e-11);
    let (calls, cost) = (calls.load(Ordering::Relaxed) - before, solution.cost());
    println!("{calls} calls, {cost:?} of them by solve");
    assert_eq!(calls, cost.evaluations + cost.heights);
    // Seven slopes between the nodes for either body, besides 64 heights.
    assert!(cost.evaluations <= 32 && cost.heights <= 2 * (64 + 7), "{cost:?}");
}

#[test]
fn pressures_keep_their_relative_accuracy_next_to_an_edge() {
    // Hertz with L = 1/2: P = sqrt((1/2 - x)(1/2 + x))/π.
    let contact = on_flat(common::parabola(1.0));
    let solution = contact.solve(Control::Load(0.125)).unwrap();
    let pressure = solution.pressure().unwrap();
    for power in 10..=40 {
        let d = 0.5f64.powi(power);
        for x in [0.5 - d, d - 0.5] {
            // d is a difference of x, a and b, 1/2 each: amplification of their relative errors.
            let amplification = 1.0 + 0.5 * (1.0 / d + 1.0);
            let exact = (d * (1.0 - d)).sqrt() / PI;
            let got = pressure.estimate(x, &mut Cost::default()).unwrap().value;
            let error = (got / exact - 1.0).abs();
            assert!(error <= 4.0 * amplification * 1e-16, "at {d:e} from the edge: {error:e}");
        }
    }
}

#[test]
fn pressures_at_fixed_edges_keep_it_too() {
    // A flat punch: P = F/(π sqrt(L² - x²)); here the edges are exact.
    let contact = on_flat(graph(-1.0, 1.0, |_| [0.0, 0.0]));
    let edges = [-0.5, 0.5].map(linecontact::Edge::Fixed);
    let contact = contact.edges(edges[0], edges[1]);
    let solution = contact.solve(Control::Load(1.0)).unwrap();
    let pressure = solution.pressure().unwrap();
    for power in 2..=52 {
        let d = 0.5f64.powi(power);
        for x in [0.5 - d, d - 0.5] {
            let exact = 1.0 / (PI * (d * (1.0 - d)).sqrt());
            let got = pressure.at(x).unwrap();
            assert_relative_eq!(got, exact, epsilon = 0.0, max_relative = 2e-15);
        }
    }
}

#[test]
fn many_at_once_are_the_same_as_one_by_one() {
    for scene in scenes() {
        let want = reference(scene.name);
        let contact = scene.contact();
        let solution = contact.solve(Control::Load(want.c / PI)).expect(scene.name);
        let (on, pressure) = (solution.hull(), solution.pressure().unwrap());
        // Any number of places, in any order, also outside.
        for count in [0, 1, 2, 7, 8, 9, 101] {
            let x: Vec<f64> = (0..count)
                .map(|i| on.at_angle(PI * (0.5 + (i * 37 % 101) as f64) / 102.0))
                .collect();
            let mut many = vec![0.0; count];
            pressure.at_many(&x, &mut many).unwrap();
            for (&x, many) in x.iter().zip(many) {
                let one = pressure.estimate(x, &mut Cost::default()).unwrap().value;
                let ulps = (many - one).abs() / (f64::EPSILON * one.abs());
                assert!(ulps <= 4.0, "{}: {many} is not {one}", scene.name);
            }
        }
        let outside = on.right + 0.01 * on.half_width();
        // Not the centre, where a wedge has its tip.
        let x = [on.at_angle(2.0), outside, on.left, on.at_angle(1.0)];
        let mut many = [f64::NAN; 4];
        pressure.at_many(&x, &mut many).unwrap();
        assert_eq!(many[1..3], [0.0, 0.0], "{}", scene.name);
        // Limits and places beyond them, among enough places to be evaluated row by row.
        let x: Vec<f64> = (0..700)
            .map(|i| on.centre() + on.half_width() * (f64::from(i) / 349.5 - 1.0))
            .chain([on.left, on.right, outside])
            .collect();
        let mut many = vec![f64::NAN; x.len()];
        pressure.at_many(&x, &mut many).unwrap();
        for (&x, many) in x.iter().zip(many) {
            let one = pressure.estimate(x, &mut Cost::default()).unwrap().value;
            let ulps = (many - one).abs() / (f64::EPSILON * one.abs());
            assert!(many == one || ulps <= 4.0, "{}: {many} is not {one} at {x}", scene.name);
        }
    }
}

#[test]
fn the_two_quadratures_agree() {
    let rule = Midpoint { segments: 512, extrapolations: 4, exponents: Exponents::HalfInteger };
    for known in [circle(), {
        let example = paper::three();
        from_reference("paper_example_3_scale_one", example.lower, example.upper)
    }] {
        let panels = Contact::new(&*known.lower, &*known.upper).unwrap();
        let midpoint = panels.clone().quadrature(&rule);
        let [panels, midpoint] = [&panels, &midpoint]
            .map(|contact| contact.solve(Control::Load(known.load)).expect(known.name));
        assert_relative_eq!(panels.a(), midpoint.a(), epsilon = 0.0, max_relative = 4e-14);
        assert_relative_eq!(panels.b(), midpoint.b(), epsilon = 0.0, max_relative = 4e-14);
        let [panels, midpoint] = [&panels, &midpoint].map(|solution| solution.pressure().unwrap());
        // Away from the outermost segments, where the rule is inaccurate.
        for i in 8..43 {
            let x = known.limits.at_angle(PI * f64::from(i) / 50.0);
            let [panels, midpoint] = [&panels, &midpoint].map(|p| p.at(x).unwrap());
            assert_relative_eq!(panels, midpoint, epsilon = 0.0, max_relative = 4e-12);
        }
    }
}

#[test]
fn single_precision_has_its_digits() {
    // Hertz, and the paper's Example 2.
    let hertz = Curve::new([-2.0f32, 2.0], |k| CurvePoint { x: k, y: k * k, dx: 1.0, dy: 2.0 * k });
    let lower = Curve::new([-2.0f32, 2.0], |k| CurvePoint {
        x: 2.0 * k + 0.2,
        y: -36.0 * k * k,
        dx: 2.0,
        dy: -72.0 * k,
    });
    let upper = Curve::new([-2.0f32, 2.0], |k| CurvePoint {
        x: 3.0 * k + 0.2,
        y: 63.0 * k * k,
        dx: 3.0,
        dy: 126.0 * k,
    });
    // A parabola in pieces of its own parameters.
    let piece = |from: f32, to: f32| {
        Curve::new([0.0f32, 1.0], move |k| {
            let x = if k == 1.0 { to } else { from + k * (to - from) };
            CurvePoint { x, y: x * x, dx: to - from, dy: 2.0 * x * (to - from) }
        })
    };
    let ends = [-2.0, -0.7, -0.3, 0.1, 0.4, 2.0];
    let pieces = ends.windows(2).map(|end| piece(end[0], end[1])).collect();
    let pieces = Piecewise::new(pieces).unwrap();
    let half_pi = std::f32::consts::FRAC_PI_2;
    let hertz_limits = Interval { left: -0.5, right: 0.5 };
    let hertz_pressure: fn(f64) -> f64 = |x| 2.0 * (0.25 - x * x).sqrt() / PI;
    type Case<'a> = (
        &'a dyn ParametricProfile<f32>,
        &'a dyn ParametricProfile<f32>,
        f32,
        f64,
        Interval<f64>,
        fn(f64) -> f64,
    );
    let cases: [Case; 3] = [
        (&Flat, &hertz, 1.0, PI / 4.0, hertz_limits, hertz_pressure),
        (
            &lower,
            &upper,
            half_pi,
            128.0 * PI * PI / 25.0,
            Interval { left: -0.6, right: 1.0 },
            common::example_2_exact,
        ),
        (&Flat, &pieces, 1.0, PI / 4.0, hertz_limits, hertz_pressure),
    ];
    for (lower, upper, kappa, c, on, exact) in cases {
        let contact = Contact::new(lower, upper).unwrap().kappa(kappa);
        let solution = contact.solve(Control::Load(c as f32 / std::f32::consts::PI)).unwrap();
        let close = 1e-5 * on.half_width();
        assert!((f64::from(solution.a()) - on.right).abs() <= close, "{}", solution.a());
        assert!((f64::from(-solution.b()) - on.left).abs() <= close, "{}", solution.b());
        let pressure = solution.pressure().unwrap();
        // Closer to an edge the rounding of x alone exceeds the tolerance.
        for i in 4..37 {
            let x = on.at_angle(PI * f64::from(i) / 40.0) as f32;
            let (got, exact) = (f64::from(pressure.at(x).unwrap()), exact(f64::from(x)));
            assert_relative_eq!(got, exact, epsilon = 0.0, max_relative = 1e-5);
        }
    }
}

#[test]
fn a_flat_body_is_never_evaluated() {
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
    // x = k, so that one evaluation inverts it; only the flat could have doubled the count.
    assert!(cost.evaluations <= cost.samples + 4, "{cost:?}");
}

#[test]
fn no_number_of_points_is_too_many() {
    let contact = on_flat(graph(-1.0, 1.0, |x: f64| [x * x / 2.0, x]));
    let solution = contact.solve(Control::Load(0.02)).unwrap();
    let points = solution.pressure().unwrap().sample(usize::MAX).unwrap();
    assert!(points.len() == 1 << 20 && points.is_sorted_by(|a, b| a[0] <= b[0]));
    assert_eq!(solution.pressure().unwrap().sample(0).unwrap().len(), 2);
}
