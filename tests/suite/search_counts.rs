//! Evaluation counts of the searches.
//!
//! The functions consist of `+ - * /` and roots, which round alike on every platform, so the counts
//! are the same, too.
#![allow(missing_docs)]

use linecontact::search::{Bracket, LimitSearch, Newton, Root, StoppingCriteria, strategies};
use std::collections::BTreeMap;

/// Function with its slope, a bracket, the root, and the blur of the root by rounding.
struct Case {
    name: &'static str,
    f: fn(f64) -> (f64, f64),
    bracket: [f64; 2],
    root: f64,
    blur: f64,
}

fn cube(x: f64) -> f64 {
    x * x * x
}

fn cases() -> [Case; 11] {
    let case =
        |name, f: fn(f64) -> (f64, f64), bracket, root, blur| Case { name, f, bracket, root, blur };
    [
        case("parabola", |x| (x * x - 2.0, 2.0 * x), [0.0, 7.0], 2f64.sqrt(), 0.0),
        case("infinite slope", |x| (x.sqrt() - 1e-5, 0.5 / x.sqrt()), [0.0, 1.0], 1e-10, 0.0),
        case("pole", |x| (1e3 - 1.0 / x, 1.0 / x / x), [1e-9, 100.0], 1e-3, 0.0),
        case("falling", |x| (3.0 - cube(x), -3.0 * x * x), [-7.0, 1.5], 3f64.cbrt(), 0.0),
        case("flat", |x| (cube(cube(x)) - 1e-18, 9.0 * cube(cube(x)) / x), [-4.0, 1.0], 0.01, 0.0),
        case("a jump", |x| (if x < 0.3 { -1.0 } else { 3.0 }, 0.0), [-1.0, 2.0], 0.3, 0.0),
        case("at zero", |x| (x + x * x, 1.0 + 2.0 * x), [-0.7, 3.0], 0.0, 0.0),
        // Close to 1 three large terms cancel.
        case(
            "noise",
            |x| (cube(x) - 3.0 * x * x + 4.0 * x - 2.0, 3.0 * x * x - 6.0 * x + 4.0),
            [-3.0, 30.0],
            1.0,
            2e-15,
        ),
        // A triple root, blurred by noise over the cube root of the rounding unit.
        case(
            "triple, noise",
            |x| (cube(x) - 3.0 * x * x + 3.0 * x - 1.0, 3.0 * x * x - 6.0 * x + 3.0),
            [-1.5, 7.0],
            1.0,
            2e-5,
        ),
        // A staircase of values, by rounding on a large number.
        case("stairs", |x| ((x + 1e6) - 1e6 - 0.3, 1.0), [-3.0, 2.5], 0.3, 2e-10),
        case("a poor slope", |x| (x * x - 2.0, 3.0 * x), [0.5, 2.0], 2f64.sqrt(), 5e-15),
    ]
}

/// Kept counts of each search on each case, with each of the tolerances.
#[rustfmt::skip]
const KEPT: &[(&str, [[usize; 3]; 11])] = &[
    ("bisection", [
        [55, 25, 15], [86, 56, 12], [69, 39, 19], [55, 25, 16], [61, 31, 6], [56, 26, 14],
        [1075, 1075, 14], [55, 27, 18], [22, 22, 14], [57, 27, 15], [53, 23, 13],
    ]),
    ("secant", [
        [13, 12, 10], [14, 14, 3], [44, 48, 34], [8, 7, 6], [75, 83, 24], [67, 31, 21],
        [17, 17, 13], [19, 16, 14], [105, 62, 33], [29, 4, 3], [10, 8, 7],
    ]),
    ("brent", [
        [12, 11, 10], [13, 13, 3], [27, 48, 34], [8, 7, 6], [27, 28, 19], [71, 26, 15],
        [14, 14, 10], [18, 17, 16], [41, 41, 25], [26, 4, 3], [10, 8, 7],
    ]),
    ("newton", [
        [14, 13, 11], [19, 18, 3], [27, 48, 34], [8, 7, 6], [34, 32, 19], [62, 28, 18],
        [17, 17, 12], [23, 22, 21], [58, 58, 33], [23, 4, 3], [10, 10, 7],
    ]),
    ("newton on slopes", [
        [9, 8, 7], [39, 38, 12], [24, 23, 19], [6, 5, 4], [28, 27, 14], [56, 26, 14],
        [10, 10, 7], [16, 15, 14], [68, 67, 18], [4, 3, 3], [32, 13, 7],
    ]),
];

const TOLERANCES: [StoppingCriteria; 3] = [
    StoppingCriteria::FULL,
    StoppingCriteria::relative(1e-6),
    StoppingCriteria { absolute: 1e-3, residual: 1e-9, ..StoppingCriteria::FULL },
];

/// Finds the root of a case on chords by each search, and by Newton's method on slopes.
fn roots(tolerance: StoppingCriteria, case: &Case) -> Vec<(&'static str, Root<f64>)> {
    let [lo, hi] = case.bracket;
    let bracket = Bracket::new(lo, hi);
    let chords = strategies(tolerance).into_iter();
    let mut all: Vec<_> = chords
        .map(|(name, search)| (name, search.find(&mut |x| (case.f)(x).0, &bracket).unwrap()))
        .collect();
    let newton = Newton { tolerance };
    let on_slopes = newton.find_with_slope(&mut |x| (case.f)(x), &bracket).unwrap();
    all.push(("newton on slopes", on_slopes));
    all
}

#[test]
fn evaluations_are_those_kept() {
    let mut found = BTreeMap::new();
    for (i, case) in cases().iter().enumerate() {
        for (j, tolerance) in TOLERANCES.into_iter().enumerate() {
            for (search, root) in roots(tolerance, case) {
                let StoppingCriteria { absolute, relative, .. } = tolerance;
                // At a triple root, and with a poor slope, a step removes only a part of the error.
                let partly = ["triple, noise", "a poor slope"].contains(&case.name);
                let times = if partly { 4.0 } else { 1.0 };
                let allowed = absolute.max(relative.max(1e-15) * case.root.abs());
                let allowed = times * allowed + case.blur;
                let error = (root.x - case.root).abs();
                // If f is small but not zero, x has the error that f allows.
                let excused = tolerance.residual > 0.0 && root.residual.abs() <= tolerance.residual;
                let name = case.name;
                assert!(error <= allowed || excused, "{name} {j} {search}: {root:?}");
                found.entry(search).or_insert([[0; 3]; 11])[i][j] = root.evaluations;
            }
        }
    }
    assert_eq!(found, KEPT.iter().copied().collect());
}

#[test]
fn a_straight_line_takes_one_step() {
    // All numbers are exact: the chord through the ends meets the root.
    let root = Newton::default().find(&mut |x| 2.0 * x - 1.0, &Bracket::new(-1.0, 3.0)).unwrap();
    assert_eq!((root.x, root.residual, root.evaluations), (0.5, 0.0, 3));
}

#[test]
fn a_guess_that_is_the_root_is_looked_at_once() {
    // With the slope, a value at the rounding of the end values is a proof.
    let mut f = |x: f64| (x * x - 2.0, 2.0 * x);
    let bracket = Bracket::new(1.0, 2.0).values(-1.0, 2.0).guess(2f64.sqrt());
    let root = Newton::default().find_with_slope(&mut f, &bracket).unwrap();
    assert_eq!((root.x, root.evaluations), (2f64.sqrt(), 1));
}
