//! The default solve beside the bare equations: the price of knowing nothing of the bodies, and of looking
//! whether a solution is one.
//!
//! ```sh
//! cargo bench --bench default                             # the table of docs/speed.md
//! cargo bench --bench default -- repeat circle cold 100   # only this, 100 times: for instructions.sh
//! ```
//!
//! The [scenes]: a parabola and a circle as closures, the paper's Examples 3 and 4, and a parabola with a wave,
//! pressed into one contact. No pressures are asked for.
//!
//! cold: from the bodies to the limits. next: with a `Solver`, a load 2 % above the one before or below it by as
//! much; counted is the first time, when nothing is known beyond the lower one. In `bare-cold` and `bare-next` one
//! interval is sought and not checked (`Contact::single_interval`).

#[allow(dead_code)] // Examples 1, 2 and 5 are not among the scenes.
#[path = "../examples/paper/curves.rs"]
mod paper;
#[path = "shared/scenes.rs"]
mod scenes;
#[path = "shared/timing.rs"]
mod timing;

use linecontact::{Contact, Control, Cost, Solver};
use scenes::{SCENES, Scene, scene};
use std::hint::black_box;
use timing::time;

const CASES: [&str; 4] = ["cold", "bare-cold", "next", "bare-next"];

/// The next load, by the first.
const NEXT: f64 = 1.02;

/// Hands over a case: a call that solves it once and returns its cost.
fn solves(name: &str, case: &str, visit: impl FnOnce(&mut dyn FnMut() -> Cost)) {
    let Scene { lower, upper, load } = scene(name);
    let is_bare = case.starts_with("bare");
    let contact = || {
        let contact = Contact::new(&*lower, &*upper).expect("they overlap");
        if is_bare { contact.single_interval(true) } else { contact }
    };
    let control = |factor: f64| Control::Load(black_box(factor * load));
    let done = "the scene has a solution";
    if case.ends_with("cold") {
        return visit(&mut || contact().solve(control(1.0)).expect(done).cost());
    }
    let (contact, mut solver, mut is_heavy) = (contact(), Solver::new(), false);
    solver.solve(&contact, control(1.0)).expect(done);
    visit(&mut || {
        is_heavy = !is_heavy;
        let factor = if is_heavy { NEXT } else { 1.0 };
        solver.solve(&contact, control(factor)).expect(done).cost()
    });
}

/// Prints a line for each scene: µs of the default solve and by those of the bare equations, and the evaluations of the
/// curves. `tests/suite/default_solve.rs` compares the evaluations in docs/speed.md.
fn table() {
    println!(
        "|scene|cold, µs|by bare|evaluations|heights|next load, µs|by bare|evaluations and heights|"
    );
    println!("|---|---|---|---|---|---|---|---|");
    for name in SCENES {
        let [cold, bare_cold, next, bare_next] = CASES.map(|case| {
            let mut measured = (0.0, Cost::default());
            solves(name, case, |call| {
                let cost = call();
                let micros = time(|| {
                    black_box(call());
                });
                measured = (micros, cost);
            });
            measured
        });
        let Cost { evaluations, heights, .. } = cold.1;
        let again = next.1.evaluations + next.1.heights;
        let by_bare = [cold.0 / bare_cold.0, next.0 / bare_next.0];
        println!(
            "|{name}|{:.1}|{:.1}|{evaluations}|{heights}|{:.1}|{:.1}|{again}|",
            cold.0, by_bare[0], next.0, by_bare[1]
        );
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| a != "--bench").collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words[..] {
        ["repeat", name, case, times] => solves(name, case, |call| {
            (0..times.parse().expect("a number")).for_each(|_: u32| {
                black_box(call());
            });
        }),
        [] => table(),
        _ => panic!("nothing, or `repeat SCENE CASE TIMES`"),
    }
}
