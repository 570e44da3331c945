//! The cost of questions to a solution: pressures, the stress below it, the approach of the bodies,
//! a certificate.
//!
//! ```sh
//! cargo bench --bench questions                                # the table of docs/speed.md
//! cargo bench --bench questions -- repeat circle certify 100   # only this, 100 times: for instructions.sh
//! ```
//!
//! The scenes are those of `default.rs`, of steel on steel.
//!
//! - pressures: the pressure at 100 places;
//! - warm-pressures: the same, of a `Solver` that has solved loads up to 1.8 times as large;
//! - ready: [`Solution::subsurface`], once for any number of stresses;
//! - stress: the stress at 100 places, from 1e-3 to 4 half-widths deep;
//! - shear: the largest shear stress;
//! - approach: the approach of references 20 half-widths deep;
//! - by-approach: a cold solve for that approach;
//! - certify: the certificate.

#[allow(dead_code)] // Examples 1, 2 and 5 are not among the scenes.
#[path = "../examples/paper/curves.rs"]
mod paper;
#[path = "shared/scenes.rs"]
mod scenes;
#[path = "shared/timing.rs"]
mod timing;

use linecontact::{
    Contact, Control, Cost, Material, PlaneState, Reference, References, Solution, Solver,
};
use scenes::{SCENES, Scene, scene};
use std::hint::black_box;
use timing::time;

const CASES: [&str; 8] = [
    "pressures",
    "warm-pressures",
    "ready",
    "stress",
    "shear",
    "approach",
    "by-approach",
    "certify",
];

/// Number of places of pressures and stresses, and the depths of the latter in half-widths.
const PLACES: usize = 100;
const DEPTHS: [f64; 2] = [1e-3, 4.0];

/// Depth of the references, in half-widths.
const DEEP: f64 = 20.0;

/// Passes a case to the visitor: a call that does it once and returns its cost in evaluations of
/// the curves.
fn questions(name: &str, case: &str, visit: impl FnOnce(&mut dyn FnMut() -> Cost)) {
    let Scene { lower, upper, load } = scene(name);
    let steel = Material::elastic(2.0, 0.3);
    let contact = Contact::new(&*lower, &*upper).expect("they overlap");
    let contact = contact.materials(steel, steel, PlaneState::Strain);
    let done = "the scene has a solution";
    let solution = contact.solve(Control::Load(load)).expect(done);
    let (on, none) = (solution.hull(), Cost::default());
    let depth = Reference::Depth(DEEP * on.half_width());
    let references = References { x: on.centre(), lower: depth, upper: depth };
    let below = |solution: &Solution<'_, f64>| solution.subsurface().map(|_| none);
    match case {
        "pressures" | "warm-pressures" => {
            let mut solver = Solver::new();
            if case.starts_with("warm") {
                for factor in [1.0, 1.2, 1.5, 1.8] {
                    solver.solve(&contact, Control::Load(factor * load)).expect(done);
                }
            }
            let solution = solver.solve(&contact, Control::Load(load)).expect(done);
            let x: [f64; PLACES] = std::array::from_fn(|i| {
                on.left + (on.right - on.left) * (i as f64 + 0.5) / PLACES as f64
            });
            let mut pressures = [0.0; PLACES];
            visit(&mut || {
                let pressure = solution.pressure().expect(done);
                pressure.at_many(black_box(&x), &mut pressures).expect(done);
                black_box(&pressures);
                none
            });
        }
        "ready" => visit(&mut || below(black_box(&solution)).expect(done)),
        "stress" => {
            let below = solution.subsurface().expect(done);
            let [shallow, deep] = DEPTHS;
            visit(&mut || {
                for i in 0..PLACES {
                    let share = (i as f64 + 0.5) / PLACES as f64;
                    // Columns that are independent of the depth.
                    let along = 3.0 * (0.618_034 * i as f64).fract() - 1.5;
                    let depth = on.half_width() * shallow * (deep / shallow).powf(share);
                    let x = on.centre() + along * on.half_width();
                    black_box(below.at(black_box(x), depth).expect(done));
                }
                none
            });
        }
        "shear" => visit(&mut || {
            black_box(solution.subsurface().and_then(|below| below.max_shear()).expect(done));
            none
        }),
        "approach" => visit(&mut || {
            black_box(solution.approach(black_box(&references)).expect(done));
            none
        }),
        "by-approach" => {
            let approach = solution.approach(&references).expect(done).bodies;
            let control = Control::Approach { approach, references };
            visit(&mut || contact.solve(black_box(control)).expect(done).cost());
        }
        "certify" => visit(&mut || black_box(&solution).certify().expect(done).cost),
        other => panic!("{other}: one of {CASES:?}"),
    }
}

/// Prints a line for each scene: µs of each question, and the evaluations of the curves and for
/// heights of the last two.
fn table() {
    println!(
        "|scene|100 stresses, µs|largest shear, ms|approach, µs|solve by approach, µs|evaluations|\
         certificate, ms|evaluations|"
    );
    println!("|---|---|---|---|---|---|---|---|");
    for name in SCENES {
        let [_, _, _, stress, shear, approach, by_approach, certify] = CASES.map(|case| {
            let mut measured = (0.0, 0);
            questions(name, case, |call| {
                let cost = call();
                let micros = time(|| {
                    black_box(call());
                });
                measured = (micros, cost.evaluations.max(cost.samples) + cost.heights);
            });
            measured
        });
        println!(
            "|{name}|{:.0}|{:.1}|{:.1}|{:.0}|{}|{:.2}|{}|",
            stress.0,
            shear.0 / 1e3,
            approach.0,
            by_approach.0,
            by_approach.1,
            certify.0 / 1e3,
            certify.1
        );
    }
}

pub(crate) fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| a != "--bench").collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words[..] {
        ["repeat", name, case, times] => questions(name, case, |call| {
            (0..times.parse().expect("a number")).for_each(|_: u32| {
                black_box(call());
            });
        }),
        [] => table(),
        _ => panic!("nothing, or `repeat SCENE CASE TIMES`"),
    }
}
