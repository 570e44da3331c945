//! The searches as general root finders.
#![allow(missing_docs)]

use linecontact::search::{
    Bracket, LimitSearch, Newton, Root, SearchError, StoppingCriteria, strategies,
};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// Function with its slope, a bracket, and its root.
struct Case {
    name: &'static str,
    f: fn(f64) -> (f64, f64),
    lo: f64,
    hi: f64,
    root: f64,
}

fn cases() -> Vec<Case> {
    let case = |name, f: fn(f64) -> (f64, f64), lo, hi, root| Case { name, f, lo, hi, root };
    vec![
        case("parabola", |x| (x * x - 2.0, 2.0 * x), 1.0, 2.0, 2f64.sqrt()),
        case("from a flat end", |x| (x * x - 2.0, 2.0 * x), 0.0, 1e3, 2f64.sqrt()),
        case("cos x = x", |x| (x.cos() - x, -x.sin() - 1.0), 0.0, 1.0, 0.739_085_133_215_160_6),
        case("exponential", |x| (x.exp() - 1e5, x.exp()), -10.0, 100.0, 1e5f64.ln()),
        case("saturating", |x| ((x - 0.1).atan(), 1.0 / (1.0 + (x - 0.1).powi(2))), -1e3, 2e4, 0.1),
        case("pole at an end", |x| (1.0 / x - 1e3, -1.0 / x / x), 1e-9, 100.0, 1e-3),
        case("infinite slope", |x| (x.sqrt() - 1e-5, 0.5 / x.sqrt()), 0.0, 1.0, 1e-10),
        case("flat, then steep", |x| (x.powi(9) - 1e-18, 9.0 * x.powi(8)), -1.0, 4.0, 0.01),
        case("a jump", |x| (if x < 0.3 { -1.0 } else { 3.0 }, 0.0), -1.0, 2.0, 0.3),
        case("tiny root in a wide bracket", |x| (x - 1e-151, 1.0), -1.0, 1.0, 1e-151),
        case("falling", |x| (3.0 - x * x * x, -3.0 * x * x), 0.5, 7.0, 3f64.cbrt()),
    ]
}

fn run(
    search: &dyn LimitSearch<f64>,
    case: &Case,
    x: f64,
    y: f64,
) -> Result<Root<f64>, SearchError<f64>> {
    let mut f = |u: f64| {
        let (value, slope) = (case.f)(u / x);
        (value * y, slope * y / x)
    };
    search.find_with_slope(&mut f, &Bracket::new(case.lo * x, case.hi * x))
}

#[test]
fn roots_are_found_to_the_last_digits() {
    for (name, search) in strategies(StoppingCriteria::FULL) {
        for case in cases() {
            let root = run(&*search, &case, 1.0, 1.0).unwrap();
            let what = format!("{name}, {}: {root:?}", case.name);
            assert!((root.x / case.root - 1.0).abs() <= 2e-15, "{what}");
            let [lo, hi] = root.bracket;
            assert!(lo <= root.x && root.x <= hi && lo >= case.lo && hi <= case.hi, "{what}");
            assert_eq!(root.residual, (case.f)(root.x).0, "{what}");
        }
    }
}

#[test]
fn powers_of_two_change_nothing() {
    for (name, search) in strategies(StoppingCriteria::FULL) {
        for case in cases() {
            let plain = run(&*search, &case, 1.0, 1.0).unwrap();
            for (x, y) in [(-30, 90), (40, -200), (-200, 3), (0, 700)]
                .map(|(i, j)| (2f64.powi(i), 2f64.powi(j)))
            {
                let scaled = run(&*search, &case, x, y).unwrap();
                let what = format!("{name}, {}, x {x:e}, f {y:e}", case.name);
                assert_eq!(scaled.x, plain.x * x, "{what}");
                assert_eq!(scaled.residual, plain.residual * y, "{what}");
                assert_eq!(scaled.bracket, plain.bracket.map(|end| end * x), "{what}");
                assert_eq!(scaled.evaluations, plain.evaluations, "{what}");
            }
        }
    }
}

#[test]
fn evaluations_are_counted_and_none_is_made_twice() {
    for (name, search) in strategies(StoppingCriteria::FULL) {
        for case in cases() {
            let mut seen = Vec::new();
            let mut f = |x: f64| {
                assert!(x >= case.lo && x <= case.hi, "{name} left the bracket: {x}");
                seen.push(x);
                (case.f)(x)
            };
            let root = search.find_with_slope(&mut f, &Bracket::new(case.lo, case.hi)).unwrap();
            assert_eq!(seen.len(), root.evaluations, "{name}, {}", case.name);
            seen.sort_by(f64::total_cmp);
            seen.dedup();
            assert_eq!(seen.len(), root.evaluations, "{name}, {}: a point twice", case.name);
        }
    }
}

#[test]
fn known_ends_and_a_guess_save_evaluations() {
    let mut f = |x: f64| (x.exp() - 2.0, x.exp());
    let wide = Bracket::new(-3.0, 3.0);
    let known = wide.values((-3f64).exp() - 2.0, 3f64.exp() - 2.0);
    let close = known.guess(2f64.ln() + 1e-5);
    for (name, search) in strategies(StoppingCriteria::FULL) {
        let count = |f: &mut dyn FnMut(f64) -> (f64, f64), bracket| {
            let root = search.find_with_slope(f, bracket).unwrap();
            assert!((root.x / 2f64.ln() - 1.0).abs() < 1e-15, "{name}: {root:?}");
            root.evaluations
        };
        assert_eq!(count(&mut f, &wide), count(&mut f, &known) + 2, "{name}");
        if name == "newton" {
            assert!(count(&mut f, &close) <= 3, "{}", count(&mut f, &close));
        }
    }
}

#[test]
fn typical_costs() {
    // Counts promised by the table in the module's doc.
    let table = include_str!("../../src/search.rs").to_lowercase();
    let most = [("bisection", 60), ("secant", 14), ("brent", 14), ("newton", 9)];
    for (name, search) in strategies(StoppingCriteria::FULL) {
        let cost = |case: &Case| run(&*search, case, 1.0, 1.0).unwrap().evaluations;
        let simple: Vec<Case> = cases().into_iter().take(3).filter(|c| c.hi < 10.0).collect();
        let (_, most) = most.iter().find(|(of, _)| *of == name).expect(name);
        assert!(table.contains(&format!("//! | [`{name}`]")), "{name} is not in the table");
        assert!(simple.iter().all(|case| cost(case) <= *most), "{name}");
    }
}

#[test]
fn multiple_roots_are_slow_but_right() {
    let tolerance = StoppingCriteria::FULL;
    for (name, search) in strategies(tolerance) {
        let mut f = |x: f64| ((x - 1.0).powi(9), 9.0 * (x - 1.0).powi(8));
        let root = search.find_with_slope(&mut f, &Bracket::new(-1.0, 4.0)).unwrap();
        assert!((root.x - 1.0).abs() < 2e-14, "{name}: {root:?}");
    }
}

#[test]
fn noise_ends_a_search() {
    // Large terms that cancel: the value is accurate to 1e-15, the root to a relative 1e-12.
    let f = |k: f64| 12.0 * k.cos() - 5.0 * k.sin() - 12.0;
    let slope = |k: f64| -12.0 * k.sin() - 5.0 * k.cos();
    for target in [1e-3, -4e-4, 3e-16, -1e-9] {
        for (name, search) in strategies(StoppingCriteria::FULL) {
            let mut g = |k: f64| (f(k) - target, slope(k));
            let bracket = Bracket::new(-0.5, 0.5).guess(-target / 5.0 + 1e-5);
            let root = search.find_with_slope(&mut g, &bracket).unwrap();
            assert!(root.residual.abs() < 4e-15, "{name}: {root:?}");
            assert!(name != "newton" || root.evaluations <= 8, "{name}: {root:?}");
        }
    }
}

#[test]
fn tolerances_are_kept() {
    let mut f = |x: f64| (x * x - 2.0, 2.0 * x);
    let bracket = Bracket::new(0.0, 2.0);
    let error = |root: Root<f64>| (root.x - 2f64.sqrt()).abs();
    for tolerance in [
        StoppingCriteria { absolute: 1e-3, ..StoppingCriteria::FULL },
        StoppingCriteria::relative(1e-3),
        StoppingCriteria { residual: 1e-3, ..StoppingCriteria::FULL },
    ] {
        let full = strategies(StoppingCriteria::FULL);
        for ((name, search), (_, full)) in strategies(tolerance).into_iter().zip(full) {
            let root = search.find_with_slope(&mut f, &bracket).unwrap();
            assert!(error(root) < 1.5e-3, "{name}: {root:?}");
            let most = full.find_with_slope(&mut f, &bracket).unwrap();
            assert!(root.evaluations < most.evaluations, "{name}: nothing saved");
        }
    }
    // A tolerance below the floating-point resolution is raised to it.
    for (name, search) in strategies(StoppingCriteria::relative(1e-300)) {
        let root = search.find_with_slope(&mut f, &bracket).unwrap();
        assert!(error(root) < 1e-15, "{name}");
    }
}

#[test]
fn an_end_that_is_the_root_is_found_at_once() {
    for (name, search) in strategies(StoppingCriteria::FULL) {
        for bracket in [Bracket::new(2.0, 5.0), Bracket::new(-1.0, 2.0), Bracket::new(2.0, 2.0)] {
            let root = search.find(&mut |x| x - 2.0, &bracket).unwrap();
            assert_eq!((root.x, root.residual, root.bracket), (2.0, 0.0, [2.0, 2.0]), "{name}");
            assert!(root.evaluations <= 2, "{name}");
        }
    }
}

#[test]
fn an_infinite_value_at_an_end_is_named() {
    for (name, search) in strategies(StoppingCriteria::FULL) {
        let infinite = search.find(&mut |x| 1.0 / x, &Bracket::new(0.0, 1.0));
        assert!(matches!(infinite, Err(SearchError::NotFinite { x: 0.0, .. })), "{name}");
    }
}

#[test]
fn a_spent_budget_carries_the_best_point() {
    for budget in [3, 5, 6] {
        let tolerance = StoppingCriteria { max_evaluations: budget, ..StoppingCriteria::FULL };
        for (name, search) in strategies(tolerance) {
            let mut count = 0;
            let mut f = |x: f64| {
                count += 1;
                (x.powi(5) - 2e-3, 5.0 * x.powi(4))
            };
            let found = search.find_with_slope(&mut f, &Bracket::new(-1.0, 8.0));
            let Err(SearchError::Budget { best }) = found else { panic!("{name}: {found:?}") };
            assert_eq!((best.evaluations, count), (budget, budget), "{name}");
            assert!(best.bracket[0] <= best.x && best.x <= best.bracket[1], "{name}");
            assert_eq!(best.residual, best.x.powi(5) - 2e-3, "{name}");
        }
    }
}

#[test]
fn errors_travel() {
    fn travels<E: std::error::Error + Send + Sync + 'static>() {}
    travels::<SearchError<f64>>();
    travels::<SearchError<f32>>();
}

#[test]
fn single_precision() {
    for (name, search) in strategies(StoppingCriteria::FULL) {
        let mut f = |x: f32| (x * x - 2.0, 2.0 * x);
        let root = search.find_with_slope(&mut f, &Bracket::new(0.5, 9.0)).unwrap();
        assert!((root.x / 2f32.sqrt() - 1.0).abs() < 4e-7, "{name}: {root:?}");
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        rng_seed: RngSeed::Fixed(1),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]

    /// Random monotone functions: a line bent by a cubic, from a random bracket.
    #[test]
    fn random_monotone_functions(
        root in -1e3..1e3f64, bend in 0.0..1e3f64, left in 1e-6..1e4f64, right in 1e-6..1e4f64,
    ) {
        let f = |x: f64| {
            let u = x - root;
            (u + bend * u.powi(3), 1.0 + 3.0 * bend * u * u)
        };
        for (name, search) in strategies(StoppingCriteria::FULL) {
            let bracket = Bracket::new(root - left, root + right);
            let found = search.find_with_slope(&mut |x| f(x), &bracket).unwrap();
            prop_assert!((found.x - root).abs() <= 1e-14 * root.abs(), "{}: {:?}", name, found);
            prop_assert!(found.evaluations <= 400, "{}: {:?}", name, found);
        }
    }

    /// For any values of the function, a search ends with a root or an error.
    #[test]
    fn nonsense_ends(values in prop::collection::vec(prop::num::f64::ANY, 1..20)) {
        for (_, search) in strategies(StoppingCriteria::FULL) {
            let mut i = 0;
            let mut next = |_| { i += 1; values[i % values.len()] };
            let found = search.find(&mut next, &Bracket::new(-1.0, 1.5));
            prop_assert!(found.is_err() || found.is_ok_and(|root| root.x.abs() <= 1.5));
            let mut i = 0;
            let mut next = |_| { i += 1; (values[i % values.len()], values[(3 * i) % values.len()]) };
            let found = search.find_with_slope(&mut next, &Bracket::new(-1.0, 1.5));
            prop_assert!(found.is_err() || found.is_ok_and(|root| root.x.abs() <= 1.5));
        }
    }
}

#[test]
fn a_slope_alone_is_no_proof() {
    // Steep only at the end of the bracket; and a slope that is clearly wrong.
    let newton = Newton::default();
    let mut steep = |x: f64| {
        let root = (x - 1.0 + 1e-40).sqrt();
        (root - 0.4, 0.5 / root)
    };
    let found = newton.find_with_slope(&mut steep, &Bracket::new(1.0, 2.0)).unwrap();
    assert!((found.x - 1.16).abs() < 1e-15, "{found:?}");
    let bracket = Bracket::new(-1.0, 1.0).values(-1.5, 0.5).guess(0.3);
    let found = newton.find_with_slope(&mut |x: f64| (x - 0.5, 1e16), &bracket).unwrap();
    assert!((found.x - 0.5).abs() < 1e-15, "{found:?}");
}

#[test]
fn ends_of_any_size_are_no_trap() {
    // The length of the first bracket overflows; the second goes down to the smallest number; in
    // the third the chord points to the flat end.
    let tiny = f64::MIN_POSITIVE / 4.0;
    for (name, search) in strategies(StoppingCriteria::FULL) {
        let found = search.find(&mut |x: f64| x - 1.0, &Bracket::new(-1.7e308, 1.7e308)).unwrap();
        assert!((found.x - 1.0).abs() < 1e-15, "{name}: {found:?}");
        let mut step = |x: f64| if x < 0.0 { -1.0 } else { 1.0 + x };
        let found = search.find(&mut step, &Bracket::new(-tiny, 3.0 * tiny)).unwrap();
        assert!(found.x.abs() <= 1e-323, "{name}: {found:?}");
        let mut steep = |x: f64| (100.0 * x).exp() - 1e-20;
        let found = search.find(&mut steep, &Bracket::new(-1.0, 1.0)).unwrap();
        assert!((found.x / (1e-20f64.ln() / 100.0) - 1.0).abs() < 1e-15, "{name}: {found:?}");
    }
}
