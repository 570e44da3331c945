//! Repeated solves with one solver.
#![allow(missing_docs)]

use crate::common;
use crate::common::NanSafe;

use approx::assert_relative_eq;
use common::{Counting, graph, on_flat, paper, power, scenes};
use linecontact::profile::Ellipse;
use linecontact::search::{Bisection, StoppingCriteria};
use linecontact::{
    Contact, ContactError, Control, Curve, CurvePoint, Edge, Flat, Interval, Midpoint,
    ParametricProfile, Solution, SolveError, Solver, Start,
};
use std::f64::consts::PI;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// Limits and pressures, compared relative to the half-width and to the largest pressure.
struct Result {
    on: Interval<f64>,
    pressures: [f64; 9],
}

impl Result {
    fn of(solution: &Solution<f64>) -> Self {
        let on = solution.hull();
        let pressure = solution.pressure().unwrap();
        let x = std::array::from_fn::<_, 9, _>(|i| on.centre() + on.half_width() * at(i));
        let mut pressures = [0.0; 9];
        pressure.at_many(&x, &mut pressures).unwrap();
        Self { on, pressures }
    }

    fn assert_close(&self, other: &Self, tolerance: f64, what: &str) {
        let l = other.on.half_width();
        let limits =
            (self.on.left - other.on.left).abs().nan_max((self.on.right - other.on.right).abs());
        assert!(limits <= tolerance * l, "{what}: {:?} is not {:?}", self.on, other.on);
        let largest = other.pressures.iter().fold(0.0f64, |most, p| most.max(*p));
        for (p, q) in self.pressures.iter().zip(&other.pressures) {
            assert!((p - q).abs() <= 10.0 * tolerance * largest, "{what}: {p} is not {q}");
        }
    }
}

fn at(i: usize) -> f64 {
    (i as f64 - 4.0) / 4.2
}

/// Returns a number from 0 to 1 that looks random, the same in each run.
fn scattered(i: usize) -> f64 {
    (0.5 + i as f64 * 0.618_033_988_749_894_9).fract()
}

/// Returns an ellipse of half-axes A and B, turned, with its middle at x₀; the contact is next to
/// its lowest point.
fn ellipse(long: f64, high: f64, turn: f64, x0: f64) -> impl ParametricProfile<f64> {
    let (sin_t, cos_t) = turn.sin_cos();
    Curve::new([-1.0, 1.0], move |k: f64| {
        let (sin, cos) = k.sin_cos();
        let [x, y, dx, dy] = [long * sin, -high * cos, long * cos, high * sin];
        CurvePoint {
            x: x0 + cos_t * x - sin_t * y,
            y: sin_t * x + cos_t * y,
            dx: cos_t * dx - sin_t * dy,
            dy: sin_t * dx + cos_t * dy,
        }
    })
}

#[test]
fn a_hundred_loads_up_and_down() {
    let example = paper::three();
    let cubic = power(3.0);
    let ellipse = ellipse(1.0, 0.7, 0.2, 0.05);
    for (lower, upper, least, tolerance) in [
        (&*example.lower, &*example.upper, 3.0, 1e-12),
        (&Flat as &dyn ParametricProfile<f64>, &*cubic, 0.005, 1e-13),
        (&Flat, &ellipse, 0.001, 1e-13),
    ] {
        let contact = Contact::new(lower, upper).unwrap();
        let mut solver = Solver::new();
        for i in 0..100 {
            // Small changes of the load, and factors up to 100.
            let load = least * 100f64.powf(scattered(i) * if i % 3 == 0 { 1.0 } else { 0.3 });
            let load = Control::Load(load);
            let cold = Result::of(&contact.solve(load).unwrap());
            let warm = Result::of(&solver.solve(&contact, load).unwrap());
            warm.assert_close(&cold, tolerance, &format!("{i} {load:?}"));
        }
    }
}

#[test]
fn a_hundred_time_steps() {
    let mut solver = Solver::new();
    for i in 0..100 {
        let t = i as f64 / 100.0;
        // It moves to and fro, turns, and changes its curvature; every tenth step it jumps, so that
        // the last contact is a poor guess.
        let jump = if i % 10 == 9 { 0.3 * (scattered(i) - 0.5) } else { 0.0 };
        let x0 = 0.3 * (7.0 * t).sin() + jump;
        let body = ellipse(1.0 + 0.2 * t, 0.7 - 0.2 * t, 0.25 * (5.0 * t).cos(), x0);
        let below = graph(-3.0, 3.0, move |x| {
            let bend = 0.1 * (3.0 * t).cos();
            [bend * x * x / 2.0, bend * x]
        });
        let mut contact = Contact::new(&*below, &body).unwrap();
        if i == 0 {
            // A poor first guess.
            contact = contact.start(Interval { left: -0.6, right: -0.55 });
        }
        let load = Control::Load(0.005 * 10f64.powf(scattered(i / 7)));
        let cold = Result::of(&Contact::new(&*below, &body).unwrap().solve(load).unwrap());
        let warm = Result::of(&solver.solve(&contact, load).unwrap());
        warm.assert_close(&cold, 1e-13, &format!("step {i}"));
    }
}

#[test]
fn the_last_contact_may_lie_beyond_the_next_bodies() {
    let scene = |middle: f64| {
        graph(middle - 1.0, middle + 1.0, move |x| [(x - middle).powi(2) / 2.0, x - middle])
    };
    let mut solver = Solver::new();
    for middle in [0.0, 0.9, 2.5, -4.0, 1e6, 0.0] {
        let body = scene(middle);
        let contact = Contact::new(&Flat, &*body).unwrap();
        let solution = solver.solve(&contact, Control::Load(0.02));
        let solution = solution.unwrap_or_else(|error| panic!("{middle}: {error}"));
        let rounding = 4.0 * f64::EPSILON * (1.0 + middle.abs());
        assert!((solution.a() - middle - 0.2).abs() <= rounding, "{middle}: {}", solution.a());
        assert!((solution.b() + middle - 0.2).abs() <= rounding, "{middle}: {}", solution.b());
    }
}

#[test]
fn one_solver_serves_scenes_that_have_nothing_in_common() {
    let scenes = scenes();
    let mut solver = Solver::new();
    for round in 0..2 {
        for i in 0..scenes.len() {
            let scene = &scenes[(i * 8 + round * 5) % scenes.len()];
            let want = common::reference(scene.name);
            let contact = scene.contact();
            let solution = solver.solve(&contact, Control::Load(want.c / PI)).expect(scene.name);
            for (got, want) in [(solution.a(), want.a), (solution.b(), want.b)] {
                assert!((got / want - 1.0).abs() <= scene.accuracy, "{}: {got}", scene.name);
            }
        }
    }
}

#[test]
fn the_next_load_costs_nothing_or_little() {
    let calls = AtomicUsize::new(0);
    let body = Counting(ellipse(1.0, 0.7, 0.2, 0.05), &calls);
    let contact = Contact::new(&Flat, &body).unwrap();
    let mut solver = Solver::new();
    let mut count = |load: f64| {
        let before = calls.load(Ordering::Relaxed);
        let solution = solver.solve(&contact, Control::Load(load)).unwrap();
        let mut pressures = [0.0; 101];
        let on = solution.hull();
        let x: [f64; 101] = std::array::from_fn(|i| on.at_angle(0.01 + 0.03 * i as f64));
        solution.pressure().unwrap().at_many(&x, &mut pressures).unwrap();
        let (calls, cost) = (calls.load(Ordering::Relaxed) - before, solution.cost());
        assert_eq!(calls, cost.evaluations + cost.heights, "what the solution says of it");
        cost.evaluations
    };
    let cold = count(0.1);
    assert!(cold > 0);
    // Within the sampled range: not a call.
    for load in [0.1, 0.1001, 0.099, 0.09, 0.07, 0.05, 0.1, 0.095] {
        assert_eq!(count(load), 0, "{load}");
    }
    // A little wider: no more than from scratch, and then no calls again.
    let mut all = 0;
    for load in [0.105, 0.11, 0.115, 0.12, 0.125, 0.13] {
        let wider = count(load);
        println!("from scratch {cold}, a little wider {wider}");
        assert!(wider <= cold, "{wider} {cold}");
        assert_eq!(count(load), 0);
        assert_eq!(count(0.9 * load), 0);
        all += wider;
    }
    assert!(all > 0 && all <= 3 * cold, "{all} {cold}");
}

#[test]
fn the_next_time_step_costs_less_than_the_first() {
    let calls = AtomicUsize::new(0);
    let mut solver = Solver::new();
    let (mut cold, mut warm) = (0, 0);
    for i in 0..20 {
        let t = f64::from(i) / 20.0;
        let body = ellipse(1.0, 0.7 - 0.1 * t, 0.1 * t, 0.2 * t);
        let body = Counting(body, &calls);
        let contact = Contact::new(&Flat, &body).unwrap();
        let load = Control::Load(0.02);
        let before = calls.load(Ordering::Relaxed);
        contact.solve(load).unwrap();
        let between = calls.load(Ordering::Relaxed);
        solver.solve(&contact, load).unwrap();
        if i > 0 {
            cold += between - before;
            warm += calls.load(Ordering::Relaxed) - between;
        }
    }
    println!("19 steps: {cold} calls from scratch, {warm} with a solver");
    assert!(warm <= cold, "{warm} {cold}");
}

#[test]
fn the_same_calls_give_the_same_bits() {
    let body = ellipse(1.0, 0.7, 0.2, 0.05);
    let other = power(3.0);
    let run = || {
        let contact = Contact::new(&Flat, &body).unwrap();
        let second = Contact::new(&Flat, &*other).unwrap();
        let mut solver = Solver::new();
        let mut bits = Vec::new();
        for i in 0..30 {
            let contact = if i % 7 == 6 { &second } else { &contact };
            let load = Control::Load(0.01 * 20f64.powf(scattered(i)));
            let result = Result::of(&solver.solve(contact, load).unwrap());
            bits.extend([result.on.left, result.on.right].map(f64::to_bits));
            bits.extend(result.pressures.map(f64::to_bits));
        }
        bits
    };
    assert_eq!(run(), run());
}

#[test]
fn a_solver_moves_to_another_thread() {
    let body = ellipse(1.0, 0.7, 0.2, 0.05);
    let contact = Contact::new(&Flat, &body).unwrap();
    let load = Control::Load(0.03);
    let cold = Result::of(&contact.solve(load).unwrap());
    let mut solver = Solver::new();
    solver.solve(&contact, Control::Load(0.02)).unwrap();
    let results = std::thread::scope(|scope| {
        let first = scope.spawn(|| Result::of(&solver.solve(&contact, load).unwrap()));
        let second = scope.spawn(|| {
            let mut solver = Solver::new();
            Result::of(&solver.solve(&contact, load).unwrap())
        });
        [first.join().unwrap(), second.join().unwrap()]
    });
    for result in results {
        result.assert_close(&cold, 1e-14, "from the thread");
    }
}

#[test]
fn a_solver_works_on_after_an_error() {
    let body = ellipse(1.0, 0.7, 0.2, 0.05);
    let contact = Contact::new(&Flat, &body).unwrap();
    let load = Control::Load(0.03);
    let cold = Result::of(&contact.solve(load).unwrap());
    let mut solver = Solver::new();
    let nan = Curve::new([-1.0, 1.0], |k: f64| CurvePoint {
        x: k,
        y: k * k / 2.0,
        dx: if k.abs() > 0.1 && k.abs() < 0.9 { f64::NAN } else { 1.0 },
        dy: k,
    });
    let faulty = Contact::new(&Flat, &nan).unwrap();
    let reversed = contact.clone().edges(Edge::Fixed(0.3), Edge::Fixed(-0.3));
    for (contact_at_fault, load_at_fault) in
        [(&contact, 1e6), (&contact, -1.0), (&faulty, 0.1), (&reversed, 0.1)]
    {
        let error = solver.solve(contact_at_fault, Control::Load(load_at_fault)).unwrap_err();
        println!("{error}");
        assert!(!matches!(error, ContactError::Solve(SolveError::LimitSearch { .. })));
        for _ in 0..2 {
            let result = Result::of(&solver.solve(&contact, load).unwrap());
            result.assert_close(&cold, 1e-13, "after an error");
        }
    }
}

#[test]
fn edges_and_controls_may_change_from_call_to_call() {
    let contact = on_flat(graph(-2.0, 2.0, |x| [x * x / 2.0, x]));
    let corner = contact.clone().edges(Edge::Fixed(-0.1), Edge::Free);
    let adhesive = contact.clone().edges(Edge::Adhesive(0.01), Edge::Adhesive(0.01));
    let stiffer = contact.clone().kappa(3.0);
    let mut solver = Solver::new();
    for i in 0..24 {
        let contact = [&contact, &corner, &adhesive, &stiffer][i % 4];
        let load = match i % 3 {
            0 => Control::Load(0.02 + 0.2 * scattered(i)),
            1 => Control::HalfWidth(0.2 + 0.3 * scattered(i)),
            _ => Control::Load((0.1 + 0.4 * scattered(i)) / PI),
        };
        let [cold, warm] = [contact.solve(load), solver.solve(contact, load)]
            .map(|solution| solution.unwrap_or_else(|error| panic!("{i} {load:?}: {error}")));
        let of = |s: &Solution<f64>| [s.a(), s.b(), s.load()];
        for (warm, cold) in of(&warm).into_iter().zip(of(&cold)) {
            assert!((warm - cold).abs() <= 1e-14, "{i} {load:?}: {warm} is not {cold}");
        }
    }
}

#[test]
fn given_limits_are_sampled_once() {
    // P = sqrt(L² - x²)/π + (F - L²/2)/(π sqrt(L² - x²)).
    let body = common::parabola(1.0);
    let edges = [Edge::Fixed(-0.4), Edge::Fixed(0.4)];
    let contact = Contact::new(&Flat, &*body).unwrap().edges(edges[0], edges[1]);
    let mut solver = Solver::new();
    for (i, load) in [0.1, 0.2, 0.3].into_iter().enumerate() {
        let solution = solver.solve(&contact, Control::Load(load)).unwrap();
        assert_eq!(solution.cost().evaluations == 0, i > 0, "{i}");
        let root = f64::sqrt(0.16 - 0.01);
        let want = (root + (load - 0.08) / root) / PI;
        let got = solution.pressure().unwrap().at(0.1).unwrap();
        assert!((got / want - 1.0).abs() < 1e-13, "{got} {want}");
    }
}

#[test]
fn the_papers_rule_starts_afresh_with_other_bodies() {
    // A curve, and the same curve reversed and shifted: the samples of one are wrong for the other.
    // Each solution counts its own evaluations.
    let calls = AtomicUsize::new(0);
    let curve = |sign: f64, shift: f64| {
        let ends = if sign > 0.0 { [-1.0, 1.2] } else { [-1.2, 1.0] };
        Box::new(Curve::new(ends, move |k: f64| {
            let (u, du) = (sign * (k + 0.3 * k * k * k), sign * (1.0 + 0.9 * k * k));
            CurvePoint { x: u + shift, y: u * u / 2.0, dx: du, dy: u * du }
        }))
    };
    let bodies = [Counting(curve(1.0, 0.0), &calls), Counting(curve(-1.0, 0.4), &calls)];
    let rule = Midpoint { segments: 16, ..Midpoint::DEFAULT };
    let scenes = [0, 1].map(|i| Contact::new(&Flat, &bodies[i]).unwrap().quadrature(&rule));
    let mut solver = Solver::new();
    for i in [0, 0, 1, 0, 1, 1] {
        let before = calls.load(Ordering::Relaxed);
        let solution = solver.solve(&scenes[i], Control::Load(0.02)).unwrap();
        let (calls, cost) = (calls.load(Ordering::Relaxed) - before, solution.cost());
        assert_eq!(calls, cost.evaluations + cost.heights, "what the solution says of it");
        let middle = [0.0, 0.4][i];
        assert!((solution.a() - 0.2 - middle).abs() < 1e-14, "{solution:?}");
        assert!((solution.b() - 0.2 + middle).abs() < 1e-14, "{solution:?}");
    }
}

/// Attempts of an earlier solution are not in the report of the next.
#[test]
fn a_report_is_of_one_solution_only() {
    let body = graph(-3.0, 3.0, |x| [0.5 * x * x, x]);
    let contact = Contact::new(&Flat, &*body).unwrap();
    let mut solver = Solver::new();
    for load in [0.01, 1.0, 3.0, 0.1] {
        let solution = solver.solve(&contact, Control::Load(load)).unwrap();
        assert_eq!(solution.report().attempts().len(), 1, "F = {load}");
        assert!(solution.report().is_checked());
    }
}

/// A load that rises by a thousandth at a time: samples are added step by step, and resampled once
/// they are in many pieces, or each load would take longer than the one before.
#[test]
fn a_load_that_rises_slowly() {
    let body = Ellipse::circle(10.0f64, [-1.0, 1.0]).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap().contact_modulus(115e3);
    for (rate, most) in [(1.001f64, 1500), (1.01, 1400), (1.1, 900)] {
        let (mut solver, mut load, mut evaluations) = (Solver::new(), 1.0, 0);
        while load < 2000.0 {
            let solution = solver.solve(&contact, Control::Load(load)).unwrap();
            evaluations += solution.cost().evaluations;
            let cold = contact.solve(Control::Load(load)).unwrap();
            let estimate = solution.limits_error().unwrap();
            assert!((solution.a() / cold.a() - 1.0).abs() < 1e-14, "{load}: {solution:?}");
            assert!(estimate < 2.0 * cold.limits_error().unwrap(), "{load}: {estimate:e}");
            load *= rate;
        }
        assert!(evaluations < most, "{evaluations} at {rate}");
    }
}

/// The rounding of one solve does not add to that of the next.
#[test]
fn a_hundred_thousand_loads_that_hardly_differ() {
    let body = Ellipse::circle(1.0f64, [-0.9, 0.9]).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap();
    let (mut solver, mut load) = (Solver::new(), 0.1);
    for _ in 0..100_000 {
        load *= 1.000_001;
        solver.solve(&contact, Control::Load(load)).unwrap();
    }
    let load = Control::Load(load);
    let [warm, cold] = [solver.solve(&contact, load), contact.solve(load)]
        .map(|found| Result::of(&found.unwrap()));
    warm.assert_close(&cold, 1e-15, "after all");
}

/// Body that is x²/2 or x²/8, depending on its flag.
struct Turncoat(AtomicBool);

impl ParametricProfile<f64> for Turncoat {
    fn domain(&self) -> [f64; 2] {
        [-1.0, 1.0]
    }
    fn at(&self, k: f64) -> CurvePoint<f64> {
        let curvature = if self.0.load(Ordering::Relaxed) { 0.25 } else { 1.0 };
        CurvePoint { x: k, y: curvature * k * k / 2.0, dx: 1.0, dy: curvature * k }
    }
}

/// A body that has changed: the samples kept by a warm solver are not those of `certify`.
#[test]
fn a_body_that_changes_behind_the_solver() {
    let body = Turncoat(AtomicBool::new(false));
    let contact = Contact::new(&Flat, &body).unwrap();
    let mut solver = Solver::new();
    let a = solver.solve(&contact, Control::Load(0.02)).unwrap().a();
    assert_relative_eq!(a, 0.2, epsilon = 0.0, max_relative = 1e-14);
    body.0.store(true, Ordering::Relaxed);
    let solution = solver.solve(&contact, Control::Load(0.02)).unwrap();
    let right = (solution.a() - 0.4).abs() < 1e-13;
    assert!(right || solution.certify().is_err(), "certified: {solution:?}");
}

#[test]
fn a_given_width_is_found_by_a_solver_that_was_elsewhere() {
    let two = |tilt: f64| {
        graph(-1.2, 1.2, move |x: f64| {
            [(x * x - 0.25).powi(2) + tilt * x, 4.0 * x * (x * x - 0.25) + tilt]
        })
    };
    let (one, other) = (two(0.05), two(-0.05));
    let [one, other] = [&one, &other].map(|body| Contact::new(&Flat, &**body).unwrap());
    let control = Control::HalfWidth(0.005);
    let mut solver = Solver::new();
    for contact in [&one, &other, &one] {
        let cold = contact.solve(control).unwrap().hull();
        let warm = solver.solve(contact, control).unwrap().hull();
        assert!((warm.left - cold.left).abs() < 1e-12, "{warm:?} {cold:?}");
    }
}

/// If the search from the last contacts fails, the solver falls back on `Contact::solve`, and the
/// cost includes both.
#[test]
fn a_search_that_is_made_again_is_the_one_from_scratch() {
    let ill = AtomicBool::new(false);
    let body = Curve::new([-1.6, 1.6], |k: f64| {
        // A number is missing once.
        let is_ill = ill.swap(false, Ordering::Relaxed);
        let dy = if is_ill { f64::NAN } else { 4.0 * k * (k * k - 1.0) };
        CurvePoint { x: k, y: k * k * (k * k - 2.0), dx: 1.0, dy }
    });
    let [first, load] = [0.2, 0.29].map(Control::Load);
    let cold = Contact::new(&Flat, &body).unwrap().solve(load).unwrap();
    let (scene, mut solver) = (Contact::new(&Flat, &body).unwrap(), Solver::new());
    solver.solve(&scene, first).unwrap();
    ill.store(true, Ordering::Relaxed);
    let warm = solver.solve(&scene, load).unwrap();
    assert!(!ill.load(Ordering::Relaxed));
    assert_ne!(warm.report().attempts()[0].start, Start::Last);
    assert_eq!(warm.report(), cold.report());
    assert_eq!(warm.intervals(), cold.intervals());
    assert!(warm.cost().evaluations > cold.cost().evaluations);
}

/// A solution that a search has left rough may overlap a little, and passes; no other load takes
/// from it that the bodies do not touch there.
#[test]
fn a_rough_solution_says_nothing_about_other_loads() {
    // A crest away from the contact, pressed a little.
    let body = Curve::new([-1.0, 1.0], |k: f64| {
        let s = (k - 0.6) / 0.01;
        let crest = 0.134512 * (-0.5 * s * s).exp();
        CurvePoint { x: k, y: 0.5 * k * k - crest, dx: 1.0, dy: k + crest * s / 0.01 }
    });
    let contact = Contact::new(&Flat, &body).unwrap();
    assert_eq!(contact.solve(Control::Load(0.0199)).unwrap().intervals().len(), 2);
    for relative in [1e-3, 1e-2, 0.1] {
        let search = Bisection { tolerance: StoppingCriteria::relative(relative) };
        let mut solver = Solver::new();
        let rough = contact.clone().limit_search(&search);
        assert_eq!(solver.solve(&rough, Control::Load(0.02)).unwrap().intervals().len(), 1);
        let next = solver.solve(&contact, Control::Load(0.0199)).unwrap();
        assert_eq!(next.intervals().len(), 2, "{relative}");
    }
}
