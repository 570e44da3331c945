//! The default solve next to the bare equations: the price of knowing nothing about the bodies, and
//! of checking the solution.
//!
//! ```sh
//! cargo bench --bench default                             # the table of docs/speed.md
//! cargo bench --bench default -- declared                # what it saves to declare the convexity of the bodies
//! cargo bench --bench default -- repeat circle cold 100   # only this, 100 times: for instructions.sh
//! ```
//!
//! The [scenes]: a parabola and a circle as closures, the paper's Examples 3 and 4, and a parabola
//! with a wave, pressed into one contact. No pressures are computed.
//!
//! cold: from the bodies to the limits. next: with a `Solver`, a load 2 % above the one before,
//! then back; evaluations are counted the first time, when nothing is known beyond the lower load.
//! `layer0.3` and `layer1` are circles on a bonded layer of a tenth of their radius, with contacts
//! of this half-width by its thickness. They are only counted, by `repeat`.
//!
//! In `bare-cold` and `bare-next` one interval is sought and not checked
//! (`Contact::single_interval`).

#[allow(dead_code)] // Examples 1, 2 and 5 are not among the scenes.
#[path = "../examples/paper/curves.rs"]
mod paper;
#[path = "shared/scenes.rs"]
mod scenes;
#[path = "shared/timing.rs"]
mod timing;

use linecontact::profile::{Crowning, Ellipse, Involute, Parabola, Spline};
use linecontact::{Base, Contact, Control, Convexity, Cost, Curve, CurvePoint, Flat, Layer};
use linecontact::{Material, ParametricProfile, Piece, PlaneState, Solver};
use scenes::{SCENES, Scene, scene};
use std::hint::black_box;
use timing::time;

const CASES: [&str; 4] = ["cold", "bare-cold", "next", "bare-next"];

/// Ratio of the next load to the first.
const NEXT: f64 = 1.02;

/// Passes a case to the visitor: a call that solves it once and returns its cost.
fn solves(name: &str, case: &str, visit: impl FnOnce(&mut dyn FnMut() -> Cost)) {
    let ratio = name.strip_prefix("layer").map(|ratio| ratio.parse().expect("a number"));
    let Scene { lower, upper, load } = ratio.map_or_else(|| scene(name), on_layer);
    let is_bare = case.starts_with("bare");
    let contact = || {
        let contact = Contact::new(&*lower, &*upper).expect("they overlap");
        let contact = if ratio.is_some() { layered(contact) } else { contact };
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

/// Makes body 1 a layer of thickness 1 on a rigid base.
fn layered(contact: Contact<'_, f64>) -> Contact<'_, f64> {
    let layer = Layer { material: Material::elastic(1.0, 0.3), thickness: 1.0, base: Base::Bonded };
    contact.materials(layer, Material::Rigid, PlaneState::Strain)
}

/// Returns a circle of radius 10, and the load under which it touches such a layer over twice a
/// half-width.
fn on_layer(half_width: f64) -> Scene {
    let circle = Curve::new([-1.5, 1.5], |k: f64| {
        let (sin, cos) = k.sin_cos();
        CurvePoint { x: 10.0 * sin, y: 10.0 * (1.0 - cos), dx: 10.0 * cos, dy: 10.0 * sin }
    });
    let contact = layered(Contact::new(&Flat, &circle).expect("they overlap"));
    let load = contact.solve(Control::HalfWidth(half_width)).expect("it is on the circle").load();
    Scene { lower: Box::new(Flat), upper: Box::new(circle), load }
}

/// Prints a line for each scene: the time of the default solve in µs and relative to the bare
/// equations, and the evaluations of the curves. `tests/suite/default_solve.rs` compares the
/// evaluations in docs/speed.md.
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

/// Body with another declaration of its convexity.
struct Declared<'b>(&'b dyn ParametricProfile<f64>, Convexity);

impl ParametricProfile<f64> for Declared<'_> {
    fn domain(&self) -> [f64; 2] {
        self.0.domain()
    }
    fn at(&self, k: f64) -> CurvePoint<f64> {
        self.0.at(k)
    }
    fn at_many(&self, k: &[f64], points: &mut [CurvePoint<f64>]) {
        self.0.at_many(k, points);
    }
    fn slope_at(&self, x: f64) -> Option<f64> {
        self.0.slope_at(x)
    }
    fn pieces(&self) -> usize {
        self.0.pieces()
    }
    fn piece(&self, index: usize) -> Option<Piece<'_, f64>> {
        self.0.piece(index)
    }
    fn convexity(&self) -> Convexity {
        self.1
    }
}

/// Number of points of the measured circle.
const POINTS: usize = 100_000;

/// Returns bodies that are convex, each with its name and a load.
fn convex_bodies() -> [(&'static str, Box<dyn ParametricProfile<f64>>, f64); 7] {
    let in_range = "the parameters are in range";
    let [parabola, circle] = ["parabola", "circle"].map(scene);
    let points: Vec<[f64; 2]> = (0..POINTS)
        .map(|i| {
            let (sin, cos) = (2.0 * i as f64 / (POINTS - 1) as f64 - 1.0).sin_cos();
            [sin, 1.0 - cos]
        })
        .collect();
    let flank = Involute::new(50.0, 0.4, [0.0, 0.8]).expect(in_range);
    let crowning = Crowning::new(0.01, 5.0, [-5.0, 5.0]).expect(in_range);
    let shape = Parabola::new(1.0, [-1.0, 1.0]).expect(in_range);
    let arc = Ellipse::circle(1.0, [-1.0, 1.0]).expect(in_range);
    [
        ("`Parabola`", Box::new(shape), parabola.load),
        ("the same as a closure", parabola.upper, parabola.load),
        ("`Ellipse::circle`", Box::new(arc), circle.load),
        ("the same as a closure", circle.upper, circle.load),
        ("`Crowning`", Box::new(crowning), 1e-3),
        ("`Involute`", Box::new(flank), 1e-3),
        (
            "`Spline`, 100 000 points of a circle",
            Box::new(Spline::through(&points).expect("they rise")),
            circle.load,
        ),
    ]
}

/// Prints a line for each body on a flat: the evaluations of a first solve, including those for
/// heights, with its convexity declared and undeclared, and the ratio of undeclared to declared
/// times for the first solve and for the next load.
fn declared() {
    println!(
        "|body|evaluations, declared|undeclared|time by that declared|next load by that declared|"
    );
    println!("|---|---|---|---|---|");
    for (name, body, load) in convex_bodies() {
        let [convex, unknown] = [Convexity::Convex, Convexity::Unknown].map(|word| {
            let body = Declared(&*body, word);
            let contact = Contact::new(&Flat, &body).expect("they overlap");
            let solve =
                || contact.solve(Control::Load(black_box(load))).expect("it has a solution");
            let (cost, mut solver, mut is_heavy) = (solve().cost(), Solver::new(), false);
            let cold = time(|| {
                black_box(solve());
            });
            let next = time(|| {
                is_heavy = !is_heavy;
                let factor = if is_heavy { NEXT } else { 1.0 };
                black_box(
                    solver.solve(&contact, Control::Load(factor * load)).expect("so has the next"),
                );
            });
            (cost.evaluations + cost.heights, cold, next)
        });
        let [cold, next] = [unknown.1 / convex.1, unknown.2 / convex.2];
        println!("|{name}|{}|{}|{cold:.1}|{next:.1}|", convex.0, unknown.0);
    }
}

pub(crate) fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| a != "--bench").collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words[..] {
        ["repeat", name, case, times] => solves(name, case, |call| {
            (0..times.parse().expect("a number")).for_each(|_: u32| {
                black_box(call());
            });
        }),
        [] => table(),
        ["declared"] => declared(),
        _ => panic!("nothing, `declared`, or `repeat SCENE CASE TIMES`"),
    }
}
