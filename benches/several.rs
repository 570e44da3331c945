//! The cost of several contacts: one, two, ten, and about a hundred of a measured profile.
//!
//! ```sh
//! cargo bench --bench several                      # the table, tab-separated
//! cargo bench --bench several -- repeat ten cold 100   # only this, 100 times: for instructions.sh
//! cargo bench --bench several -- many             # contacts against time: docs/several_contacts.md
//! cargo bench --bench several -- heights CELLS     # the profile, for benches/rivals/bem_rough.py
//! cargo bench --bench several -- periodic         # rough surfaces that repeat, for tamaas_periodic.py
//! ```
//!
//! - `word`: a circle pressed to half its radius, convexity declared; `one`: the same circle
//!   undeclared, so that its heights are sampled and its pressure is checked;
//! - `two`: `x⁴ - 2x²` at a third of the load at which its two contacts merge;
//! - `ten`: ten contacts by a polynomial map;
//! - `rough`: a `Spline` through 10 000 points of a parabola with five waves.
//!
//! cold: from the bodies to the limits. warm: with a `Solver`, loads 0, 2, 4 and 6 % above the
//! first.
//! Each solution is checked once, for the number of its contacts and its load.

#[path = "../examples/shared/rough.rs"]
pub(crate) mod rough;
#[path = "shared/timing.rs"]
mod timing;

use linecontact::profile::Spline;
use linecontact::reference::{ClosedForm, Hertz, PolynomialMap};
use linecontact::{
    Contact, Control, Convexity, Curve, CurvePoint, Flat, Panels, ParametricProfile, Solver,
};
use std::f64::consts::PI;
use std::hint::black_box;
use std::time::Instant;
use timing::time;

const CASES: [&str; 5] = ["word", "one", "two", "ten", "rough"];

/// Half-length of the profile, its curvature, and its number of points.
const HALF: f64 = 10.0;
const BEND: f64 = 1e-3;
const POINTS: i32 = 10_000;
/// Load under which a parabola of this curvature would touch on a quarter of the profile.
pub(crate) const ROUGH_LOAD: f64 = 0.5 * BEND * HALF * HALF * 0.25;

/// Lengths, heights and phases of the waves.
const WAVES: [[f64; 3]; 5] = [
    [0.1, 1.2e-4, 0.3],
    [0.231, 1.1e-4, 1.7],
    [0.173, 0.8e-4, 4.1],
    [0.0613, 0.2e-4, 2.9],
    [1.37, 3e-4, 5.2],
];

pub(crate) fn profile() -> Spline<f64> {
    let point = |i: i32| {
        let x = HALF * (2.0 * f64::from(i) / f64::from(POINTS - 1) - 1.0);
        let wave =
            |[length, height, phase]: [f64; 3]| height * (2.0 * PI * x / length + phase).cos();
        [x, 0.5 * BEND * x * x + WAVES.into_iter().map(wave).sum::<f64>()]
    };
    let points: Vec<[f64; 2]> = (0..POINTS).map(point).collect();
    Spline::through(&points).expect("the points are in order")
}

/// Body of a closed form.
struct Ten(PolynomialMap<f64, Hertz<f64>>);

impl ParametricProfile<f64> for Ten {
    fn domain(&self) -> [f64; 2] {
        [-1.2, 1.2]
    }

    fn at(&self, k: f64) -> CurvePoint<f64> {
        CurvePoint { x: k, y: self.0.height(k), dx: 1.0, dy: self.0.slope(k) }
    }
}

struct Case {
    body: Box<dyn ParametricProfile<f64>>,
    load: f64,
    /// Smallest and largest number of contacts allowed.
    contacts: [usize; 2],
}

/// Returns a case by its name; κ is 1.
fn case(name: &str) -> Case {
    let circle = |convexity| {
        let curve = Curve::new([-1.0, 1.0], |k: f64| {
            let (half_sin, half_cos) = (0.5 * k).sin_cos();
            let [y, x] = [2.0 * half_sin * half_sin, 2.0 * half_sin * half_cos];
            CurvePoint { x, y, dx: 1.0 - y, dy: x }
        });
        // π F for a half-width of half the radius: 2 (K(m) - E(m)), m = 1/4.
        let load = 0.436_576_291_006_337_8 / PI;
        Case { body: Box::new(curve.with_convexity(convexity)), load, contacts: [1, 1] }
    };
    match name {
        "word" => circle(Convexity::Convex),
        "one" => circle(Convexity::Unknown),
        "two" => {
            let quartic = Curve::new([-2.0, 2.0], |k: f64| {
                let (y, dy) = (k * k * (k * k - 2.0), 4.0 * k * (k * k - 1.0));
                CurvePoint { x: k, y, dx: 1.0, dy }
            });
            Case { body: Box::new(quartic), load: 2.0 / 3.0, contacts: [2, 2] }
        }
        "ten" => {
            let form = Hertz::under_load(1.0, 0.05, 1.0).expect("a positive load");
            let form = PolynomialMap::new(form, 10, 0.9, 1.0).expect("apart");
            let load = form.load(1.0);
            Case { body: Box::new(Ten(form)), load, contacts: [10, 10] }
        }
        "rough" => Case { body: Box::new(profile()), load: ROUGH_LOAD, contacts: [80, 130] },
        other => panic!("{other}: one of {CASES:?}"),
    }
}

/// Visitor of a case: its name, and a call that solves it once and returns contacts, samples,
/// evaluations and heights.
type Visit<'v> = dyn FnMut(&str, &mut dyn FnMut() -> [usize; 4]) + 'v;

/// Passes a cold and a warm solve of a case to the visitor.
fn solves(name: &str, visit: &mut Visit<'_>) {
    let Case { body, load, contacts: [fewest, most] } = case(name);
    let counts = |solution: linecontact::Solution<f64>| {
        let (cost, contacts) = (solution.cost(), solution.intervals().len());
        assert!((fewest..=most).contains(&contacts), "{name}: {contacts} contacts");
        [contacts, cost.samples, cost.evaluations, cost.heights]
    };
    let scene = || Contact::new(&Flat, &*body).expect("they overlap");
    let done = "the scene has a solution";
    visit("cold", &mut || counts(scene().solve(Control::Load(black_box(load))).expect(done)));
    let (contact, mut solver, mut turn) = (scene(), Solver::new(), 0);
    visit("warm", &mut || {
        turn += 1;
        let load = load * (1.0 + 0.02 * f64::from(turn % 4));
        counts(solver.solve(&contact, Control::Load(black_box(load))).expect(done))
    });
}

/// Scenes with more and more contacts: points of a parabola through which a spline runs, standard
/// deviation of their independent noise as a share of the load, and load.
pub(crate) const MANY: [(usize, f64, f64); 8] = [
    (1500, 0.02, 2.5e-3),
    (2000, 0.06, 8e-3),
    (1700, 0.03, 2e-2),
    (3000, 0.03, 2e-2),
    (4300, 0.03, 2e-2),
    (6000, 0.03, 2e-2),
    (4800, 0.03, 9e-2),
    (17_000, 0.03, 9e-2),
];

/// Waves on a parabola that touch at more and more crests: their numbers. The load is 0.02.
const CRESTS: [f64; 3] = [320.0, 800.0, 1600.0];

/// Returns a flat parabola with a number of waves of slopes up to 0.3.
fn waves(count: f64) -> impl ParametricProfile<f64> {
    let (rate, steep) = (PI * count, 0.3);
    Curve::new([-1.0, 1.0], move |k: f64| {
        let (sin, cos) = (rate * k).sin_cos();
        let y = 0.05 * k * k - steep / rate * cos;
        CurvePoint { x: k, y, dx: 1.0, dy: 0.1 * k + steep * sin }
    })
}

/// Returns a spline through points of a parabola with independent noise.
pub(crate) fn noisy(count: usize, deviation: f64) -> Spline<f64> {
    let mut state = 1u64;
    let mut uniform = || {
        // Knuth's linear congruential generator; its upper bits are random enough.
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / (1u64 << 31) as f64
    };
    let mut normal = || (0..12).map(|_| uniform()).sum::<f64>() - 6.0;
    let point = |i: usize| {
        let x = 2.0 * i as f64 / (count - 1) as f64 - 1.0;
        [x, 0.5 * x * x + deviation * normal()]
    };
    let points: Vec<[f64; 2]> = (0..count).map(point).collect();
    Spline::through(&points).expect("the points are in order")
}

/// Prints contacts and milliseconds of a first solve, milliseconds of the next, 2 % heavier, and
/// the sets of contacts tried; each solve is done once.
fn many() {
    println!("|body|contacts|first solve, ms|sets tried|next load, ms|sets tried|");
    println!("|---|---|---|---|---|---|");
    for (count, noise, load) in MANY {
        row(&format!("{count} points"), &noisy(count, noise * load), load);
    }
    for count in CRESTS {
        row(&format!("{count} waves"), &waves(count), 0.02);
    }
}

fn row(name: &str, body: &dyn ParametricProfile<f64>, load: f64) {
    let contact = Contact::new(&Flat, body).expect("they overlap");
    let (mut solver, mut contacts) = (Solver::new(), None);
    let row = [1.0, 1.02].map(|factor| {
        let start = Instant::now();
        let solution = solver.solve(&contact, Control::Load(factor * load));
        let millis = 1e3 * start.elapsed().as_secs_f64();
        let Ok(solution) = solution else { return format!("{millis:.0}|refused") };
        contacts.get_or_insert(solution.intervals().len());
        format!("{millis:.0}|{}", solution.report().attempts().len())
    });
    println!("|{name}|{}|{}|", contacts.unwrap_or(0), row.join("|"));
}

/// Prints a problem for boundary elements: κ, F, the ends and the heights at the middles of `cells`
/// cells.
fn heights(cells: u32) {
    let (body, ends) = (profile(), 0.75 * HALF);
    let solution =
        Contact::new(&Flat, &body).and_then(|scene| scene.solve(Control::Load(ROUGH_LOAD)));
    let solution = solution.expect("the profile has a contact");
    let (on, peak) = (solution.hull(), solution.peak().expect("free edges"));
    println!("1 {ROUGH_LOAD:?} {:?} {ends:?}", -ends);
    println!("{:?} {:?} {:?} {}", on.left, on.right, peak.pressure, solution.intervals().len());
    for i in 0..cells {
        let x = ends * (2.0 * (f64::from(i) + 0.5) / f64::from(cells) - 1.0);
        // The parameter of a spline is x itself.
        println!("{:?}", body.at(x).y);
    }
}

/// Rough surface of period 1 that is pressed, E* = 1.
pub(crate) struct Periodic {
    /// Largest number of waves a period.
    pub(crate) most: u32,
    pub(crate) load: f64,
    pub(crate) contacts: usize,
    /// Largest pressure, of the default tolerance. The suite looks whether it is right.
    pub(crate) peak: f64,
}

pub(crate) const PERIODIC: [Periodic; 3] = [
    Periodic { most: 64, load: 0.02, contacts: 6, peak: 0.666_500_259_019_5 },
    Periodic { most: 64, load: 0.13, contacts: 20, peak: 1.024_871_291_697_2 },
    Periodic { most: 204, load: 0.3, contacts: 62, peak: 1.665_812_251_398_7 },
];

/// Prints error of the peak and milliseconds of a first solve and of the next load, 2 % larger:
/// each the least of five, or of two that take longer than half a second.
fn periodic() {
    println!("waves\tload\tcontacts\tpeak\ttolerance\terror\tfirst\tnext");
    for Periodic { most, load, contacts, peak } in PERIODIC {
        let body = rough::surface(most);
        for tolerance in [1e-3, 1e-4, 1e-5, 1e-6, 1e-8, 1e-12] {
            let panels = Panels { tolerance };
            let (mut least, mut error, mut turn) = ([f64::INFINITY; 2], 0.0, 0);
            while turn < 5 && (turn < 2 || least[0] < 500.0) {
                turn += 1;
                let (mut solver, mut first) = (Solver::new(), None);
                for (factor, least) in [1.0, 1.02].into_iter().zip(&mut least) {
                    let start = Instant::now();
                    let contact = Contact::new(&Flat, &body).expect("they overlap");
                    let contact = contact.contact_modulus(1.0).period(1.0).quadrature(&panels);
                    let solution = solver.solve(&contact, Control::Load(factor * load));
                    let solution = solution.expect("the scene has a solution");
                    let found = solution.peak().expect("free edges").pressure;
                    *least = least.min(1e3 * start.elapsed().as_secs_f64());
                    first.get_or_insert(found);
                }
                error = first.map_or(f64::NAN, |found| (found / peak - 1.0).abs());
            }
            let [first, next] = least;
            let what = format!("{most}\t{load:?}\t{contacts}\t{peak:?}\t{tolerance:e}");
            println!("{what}\t{error:.1e}\t{first:.1}\t{next:.1}");
        }
    }
}

pub(crate) fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| a != "--bench").collect();
    let words: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match words[..] {
        ["many"] => many(),
        ["periodic"] => periodic(),
        ["heights", cells] => heights(cells.parse().expect("a number")),
        ["repeat", name, way, times] => solves(name, &mut |found, call| {
            if found == way {
                (0..times.parse().expect("a number")).for_each(|_: u32| {
                    black_box(call());
                });
            }
        }),
        [] => {
            println!("scene\tway\tmicroseconds\tcontacts\tsamples\tevaluations\theights");
            for name in CASES {
                solves(name, &mut |way, call| {
                    // A solver starts with its first solve.
                    call();
                    let counts = call().map(|count| count.to_string()).join("\t");
                    let micros = time(|| {
                        black_box(call());
                    });
                    println!("{name}\t{way}\t{micros:.3}\t{counts}");
                });
            }
        }
        _ => panic!("nothing, `many`, `periodic`, `heights CELLS`, or `repeat SCENE WAY TIMES`"),
    }
}
