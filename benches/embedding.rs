//! Cost of the solver in a program that embeds it: a first solve, the next ones, and pressures, in
//! `f64` and `f32`, and their growth with the number of pieces of the body.
//!
//! `cargo bench --bench embedding` prints µs a call and the evaluations of the curves,
//! tab-separated. `cargo bench --bench embedding -- 10 100` measures 10 and 100 pieces. The line
//! that starts with "growth" gives the power of the number of pieces with which the last step has
//! grown.
//!
//! The scene: a circle cut into equal arcs, pressed on a flat to half its radius, so that half of
//! the arcs (by angle, 52 %) are in the contact. A body of one piece is not joined. Its convexity
//! is declared, so that no heights are sampled; `several.rs` has bodies of undeclared convexity.
//!
//! - cold: from the bodies to the limits;
//! - load: with a `Solver`, the same scene under a load up to 2 % less;
//! - body: with a `Solver`, a body up to 0.2 % larger, already made, and its scene;
//! - moment: as cold, under a moment that turns the bodies by a tenth;
//! - turned: as cold, with a body that is already turned by a tenth;
//! - P1, P100, P10k: pressures at 1, 100 and 10 000 points.
//!
//! `cargo bench --bench embedding -- repeat cold f64 1 1000` does only one of these, 1000 times,
//! and prints nothing: for `instructions.sh`.

#[path = "shared/timing.rs"]
mod timing;

use linecontact::{
    Contact, Control, Convexity, Curve, CurvePoint, Flat, ParametricProfile, Piecewise, Real,
    Solver,
};
use std::hint::black_box;
use timing::time;

const CASES: [&str; 8] = ["cold", "load", "body", "moment", "turned", "P1", "P100", "P10k"];
const PIECES: [usize; 5] = [1, 10, 100, 1_000, 10_000];

/// π F for a half-width of half the radius, κ = 1: 2 (K(m) - E(m)), m = 1/4.
const C: f64 = 0.436_576_291_006_337_8;

/// Increase of the slope of a turned body.
const TILT: f64 = 0.1;

fn roller<T: Real>(radius: f64, tilt: f64, pieces: usize) -> Box<dyn ParametricProfile<T>> {
    let (radius, tilt) = (T::of(radius), T::of(tilt));
    let arc = move |from: f64, to: f64| {
        Curve::new([T::of(from), T::of(to)], move |k: T| {
            // Not 1 - cos k, which would be mere rounding in narrow arcs of `f32`.
            let (half_sin, half_cos) = (T::of(0.5) * k).sin_cos();
            let double = radius + radius;
            let [y, x] = [double * half_sin * half_sin, double * half_sin * half_cos];
            CurvePoint { x, y: y + tilt * x, dx: radius - y, dy: x + tilt * (radius - y) }
        })
        .with_convexity(Convexity::Convex)
    };
    if pieces == 1 {
        return Box::new(arc(-1.0, 1.0));
    }
    let end = |i: usize| 2.0 * i as f64 / pieces as f64 - 1.0;
    let arcs = (0..pieces).map(|i| arc(end(i), end(i + 1)));
    Box::new(Piecewise::new(arcs.collect()).expect("the arcs meet"))
}

/// Passes each case to the visitor: its name, and a call that does it once and returns the
/// evaluations of the curves while solving.
fn cases<T: Real>(pieces: usize, visit: &mut dyn FnMut(&str, &mut dyn FnMut() -> usize)) {
    let bodies = [1.0, 1.001, 1.002].map(|radius| roller::<T>(radius, 0.0, pieces));
    let scene = |turn: usize| Contact::new(&Flat, &*bodies[turn % 3]).expect("they overlap");
    let load = |turn: usize| Control::Load(T::of(C * (1.0 - 0.01 * (turn % 3) as f64)) / T::pi());
    let done = "the scene has a solution";

    visit("cold", &mut || scene(0).solve(black_box(load(0))).expect(done).cost().evaluations);

    let (contact, mut turn) = (scene(0), 0);
    let mut solver = Solver::new();
    visit("load", &mut || {
        turn += 1;
        solver.solve(&contact, black_box(load(turn))).expect(done).cost().evaluations
    });
    visit("body", &mut || {
        turn += 1;
        solver.solve(&scene(turn), black_box(load(0))).expect(done).cost().evaluations
    });

    let turned = roller::<T>(1.0, TILT, pieces);
    let turned = || Contact::new(&Flat, &*turned).expect("they overlap");
    let solution = turned().solve(load(0)).expect(done);
    let at = solution.centre_of_pressure().expect("there is a load");
    let moment = Control::CentreOfPressure { load: solution.load(), at };
    visit("moment", &mut || scene(0).solve(black_box(moment)).expect(done).cost().evaluations);
    visit("turned", &mut || turned().solve(black_box(load(0))).expect(done).cost().evaluations);

    let solution = contact.solve(load(0)).expect(done);
    for (name, count) in [("P1", 1u32), ("P100", 100), ("P10k", 10_000)] {
        let place = |i| T::of(0.98 * (f64::from(i) + 0.6) / f64::from(count) - 0.49);
        let x: Vec<T> = (0..count).map(place).collect();
        let mut p = vec![T::of(0.0); x.len()];
        visit(name, &mut || {
            solution.pressure().expect(done).at_many(black_box(&x), &mut p).expect(done);
            black_box(&p);
            0
        });
    }
}

/// Prints a line for each number of pieces, and one for the growth from the last but one to the
/// last.
fn table<T: Real>(scalar: &str, pieces: &[usize]) {
    let (mut last, mut growth) = (None::<(usize, Vec<f64>)>, Vec::new());
    for &pieces in pieces {
        let (mut micros, mut evaluations) = (Vec::new(), Vec::new());
        cases::<T>(pieces, &mut |_, call| {
            // One round of the loads or bodies; a solver starts with its first solve.
            call();
            evaluations.push((call() + call() + call()) / 3);
            micros.push(time(|| {
                black_box(call());
            }));
        });
        let times: Vec<String> = micros.iter().map(|micros| format!("{micros:.4}")).collect();
        let counts: Vec<String> = evaluations[..3].iter().map(usize::to_string).collect();
        println!("{scalar}\t{pieces}\t{}\t{}", times.join("\t"), counts.join("\t"));
        if let Some((before, old)) = &last {
            let step = (pieces as f64 / *before as f64).ln();
            let power = |(new, old): (&f64, &f64)| format!("{:.2}", (new / old).ln() / step);
            growth = micros.iter().zip(old).map(power).collect();
        }
        last = Some((pieces, micros));
    }
    println!("{scalar}\tgrowth\t{}\t\t\t", growth.join("\t"));
}

fn repeat<T: Real>(case: &str, pieces: usize, times: usize) {
    cases::<T>(pieces, &mut |name, call| {
        if name == case {
            (0..times).for_each(|_| {
                black_box(call());
            });
        }
    });
}

pub(crate) fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| a != "--bench").collect();
    if let [word, case, scalar, pieces, times] = &arguments[..]
        && word == "repeat"
    {
        let count = |text: &str| text.parse().expect("a number");
        let repeat = if scalar == "f32" { repeat::<f32> } else { repeat::<f64> };
        return repeat(case, count(pieces), count(times));
    }
    let mut pieces: Vec<usize> = arguments.iter().filter_map(|a| a.parse().ok()).collect();
    if pieces.is_empty() {
        pieces = PIECES.into();
    }
    println!("scalar\tpieces\t{}\tcold_evals\tload_evals\tbody_evals", CASES.join("\t"));
    table::<f64>("f64", &pieces);
    table::<f32>("f32", &pieces);
}
