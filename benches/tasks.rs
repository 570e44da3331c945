//! Time, error and cost of whole solves: the limits, then the pressure at 101 points.
//!
//! `cargo bench --bench tasks` prints one line of tab-separated values per task and tolerance.
//! Arguments: tolerances (default 1e-3 1e-6 1e-9 1e-12) and names of tasks (default all).
//!
//! `cargo bench --bench tasks -- judge FILE` reads the results of other programs
//! (`benches/rivals`), and prints their errors by the same measure, before its own.
//!
//! T1, T2, T3a and T3b (κ = 1 and π/2), T5: the paper's Examples 1 to 4; T4: a circle on a flat.
//! Every search starts at [-0.3, 0.3]. Error: the largest `|P - P_ref|` over the largest `|P_ref|`.

#[path = "shared/timing.rs"]
mod timing;

use linecontact::{Contact, ContactError, Control, CurvePoint, Edge, Flat, Interval, Solver};
use linecontact::{Panels, ParametricProfile, Piecewise, Solution};
use std::f64::consts::{FRAC_PI_2, PI};
use std::hint::black_box;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use timing::time;

type Body = Box<dyn ParametricProfile<f64>>;
type Result<T> = std::result::Result<T, ContactError<f64>>;

// What touches the solver ...

fn scene<'a>(task: &Task, bodies: &'a [Body; 2], panels: &'a Panels) -> Result<Contact<'a, f64>> {
    let contact = Contact::new(&*bodies[0], &*bodies[1])?.kappa(task.kappa).quadrature(panels);
    Ok(match task.fixed {
        Some([left, right]) => {
            contact.edges(Edge::Fixed(left), Edge::Fixed(right)).single_interval(true)
        }
        None => contact.start(Interval { left: -0.3, right: 0.3 }),
    })
}

/// Computes the pressures at the points, and returns the limits.
fn pressures(solution: &Solution<f64>, points: &mut Points) -> Result<[f64; 2]> {
    let on = solution.hull();
    points.x = places(on);
    solution.pressure()?.at_many(&points.x, &mut points.p)?;
    Ok([on.left, on.right])
}

/// Solves from the bodies on.
fn cold(task: &Task, bodies: &[Body; 2], tolerance: f64, points: &mut Points) -> Result<[f64; 2]> {
    let panels = Panels { tolerance };
    let contact = scene(task, bodies, &panels)?;
    let solution = contact.solve(Control::Load(task.c / PI))?;
    pressures(&solution, points)
}

/// Returns the µs of a solve that starts from the one before: the same bodies under a load up to 2
/// % less.
fn warm(task: &Task, bodies: &[Body; 2], tolerance: f64) -> Result<f64> {
    let panels = Panels { tolerance };
    let contact = scene(task, bodies, &panels)?;
    let mut solver = Solver::new();
    let (mut points, mut turn) = (Points::new(), 0);
    Ok(time(|| {
        turn = (turn + 1) % 3;
        let load = Control::Load(task.c * (1.0 - 0.01 * f64::from(turn)) / PI);
        let solution = solver.solve(&contact, black_box(load)).expect("solved before");
        let _ = black_box(pressures(&solution, &mut points));
    }))
}

// ... ends here.

/// The 101 places and the pressures there.
struct Points {
    x: [f64; 101],
    p: [f64; 101],
}

/// Returns 101 equidistant places.
fn places(on: Interval<f64>) -> [f64; 101] {
    let (c, half) = (on.centre(), on.half_width());
    Z.map(|z| c + half * z)
}

/// Table of these places on [-1, 1], which the other programs have, too.
const Z: [f64; 101] = {
    let mut z = [0.0; 101];
    let mut i = 0;
    while i < 101 {
        z[i] = -1.0 + 2.0 * (i + 1) as f64 / 102.0;
        i += 1;
    }
    z
};

impl Points {
    fn new() -> Self {
        Self { x: [0.0; 101], p: [0.0; 101] }
    }

    fn iter(&self) -> impl Iterator<Item = [f64; 2]> {
        self.x.into_iter().zip(self.p).map(|(x, p)| [x, p])
    }
}

/// Returns sin k, cos k and cos k - 1, all to full relative accuracy.
fn trig(k: f64) -> (f64, f64, f64) {
    let (s, c) = (0.5 * k).sin_cos();
    let m = -2.0 * s * s;
    (2.0 * s * c, 1.0 + m, m)
}

/// Number of points in a batch.
const W: usize = 4;

/// Returns sin k, cos k and cos k - 1 at W points, for |k| up to 6: by series of a quarter of k,
/// which a compiler turns into vector instructions.
fn trig_many(k: &[f64; W]) -> [[f64; W]; 3] {
    // 1/3! ... 1/19! and 1/2! ... 1/20!, of alternating sign.
    let (mut odd, mut even) = ([0.0; W], [0.0; W]);
    let mut share = -1.0 / (2..=20).fold(1.0, |product, i| product * f64::from(i));
    let square = k.map(|k| k * k / 16.0);
    for i in (1..=10).rev() {
        let (even_share, odd_share) = (-share, share * f64::from(2 * i));
        for j in 0..W {
            even[j] = fma(even[j], square[j], even_share);
            odd[j] = fma(odd[j], square[j], odd_share);
        }
        share = -odd_share * f64::from(2 * i - 1);
    }
    let mut trig = [[0.0; W]; 3];
    for j in 0..W {
        // sin and cos of k/4, then of k/2.
        let (s, c) = (0.25 * k[j] * odd[j], fma(even[j], square[j], 1.0));
        let (s, c) = (2.0 * s * c, 1.0 - 2.0 * s * s);
        let m = -2.0 * s * s;
        (trig[0][j], trig[1][j], trig[2][j]) = (2.0 * s * c, 1.0 + m, m);
    }
    trig
}

/// Returns `a b + c`, with one instruction where there is one.
fn fma(a: f64, b: f64, c: f64) -> f64 {
    if cfg!(target_feature = "fma") { a.mul_add(b, c) } else { a * b + c }
}

static CALLS: AtomicUsize = AtomicUsize::new(0);

/// Curves by name, range of k, and X, X', Y, Y'; s, c, m are sin k, cos k, cos k - 1. Those with
/// `COUNT` count their evaluations, in an untimed run.
macro_rules! curves {
    ($($name:ident: $from:literal to $to:literal, $k:ident $($s:ident $c:ident $m:ident)? =>
        $point:expr;)*) => {$(
        struct $name<const COUNT: bool>;
        impl<const COUNT: bool> ParametricProfile<f64> for $name<COUNT> {
            fn domain(&self) -> [f64; 2] {
                [$from, $to]
            }
            fn at(&self, $k: f64) -> CurvePoint<f64> {
                COUNT.then(|| CALLS.fetch_add(1, Relaxed));
                $(let ($s, $c, $m) = trig($k);)?
                let [x, dx, y, dy] = $point;
                CurvePoint { x, y, dx, dy }
            }
            #[allow(unused_variables)] // not every curve uses k itself
            fn at_many(&self, k: &[f64], points: &mut [CurvePoint<f64>]) {
                COUNT.then(|| CALLS.fetch_add(k.len(), Relaxed));
                for (k, points) in k.chunks(W).zip(points.chunks_mut(W)) {
                    let mut lanes = [k[0]; W];
                    lanes[..k.len()].copy_from_slice(k);
                    #[allow(unused_variables)] // of use to some
                    let trig = trig_many(&lanes);
                    for (i, point) in points.iter_mut().enumerate() {
                        let $k = lanes[i];
                        $(let [$s, $c, $m] = trig.map(|row| row[i]);)?
                        let [x, dx, y, dy] = $point;
                        *point = CurvePoint { x, y, dx, dy };
                    }
                }
            }
        }
    )*};
}
curves! {
    Lower1: -2.0 to 0.0, k => [k + 1.0, 1.0, -0.5 * (k + 1.0).asin(), -0.5 / (-k * (k + 2.0)).sqrt()];
    Upper1: -0.3333333333333333 to 0.3333333333333333, k => [3.0 * k, 3.0,
        1.5 * k * (1.0 - 9.0 * k * k).sqrt(), 1.5 * (1.0 - 18.0 * k * k) / (1.0 - 9.0 * k * k).sqrt()];
    Lower2: -2.0 to 2.0, k => [2.0 * k + 0.2, 2.0, -36.0 * k * k, -72.0 * k];
    Upper2: -2.0 to 2.0, k => [3.0 * k + 0.2, 3.0, 63.0 * k * k, 126.0 * k];
    Lower3: -1.3539997025528523 to 0.7911938540783813, k s c m => [
        2.0 * m - 8.0 * k * c - 9.0 * s + 7.0 * k * s, -17.0 * c + 5.0 * s + 8.0 * k * s + 7.0 * k * c,
        (15.0 * s + 9.0 * m - 15.0 * k * c - 6.0 * k * s) * 1e5, (-15.0 * s + 15.0 * k * s - 6.0 * k * c) * 1e5];
    Upper3: -1.428061671618955 to 0.7623463067015128, k s c m => [
        7.0 * s - 8.0 * m + 3.0 * k * c - 9.0 * k * s, 10.0 * c - s - 3.0 * k * s - 9.0 * k * c,
        (35.0 * k * c - 35.0 * s - 30.0 * m + 10.0 * k * s) * 1e5, (40.0 * s - 35.0 * k * s + 10.0 * k * c) * 1e5];
    Circle: -1.5 to 1.5, k s c m => [s, c, -m, s];
    Left4: 0.0 to 5.540299783323928, k s c m => [
        12.0 * m - 2.0 * s - 3.0 * k * c + 2.0 * k * s, -5.0 * c - 10.0 * s + 3.0 * k * s + 2.0 * k * c,
        (711.0 * m + 63.0 * s - 63.0 * k * c - 783.0 * k * s) * 1e4,
        (-1494.0 * s + 63.0 * k * s - 783.0 * k * c) * 1e4];
    Right4: -1.5010288405450835 to 0.0, k s c m => [
        6.0 * m - 5.0 * s - 3.0 * k * c + 9.0 * k * s, -8.0 * c + 3.0 * s + 3.0 * k * s + 9.0 * k * c,
        (7.0 * k * s - 56000.0 * k * k - 35.0 * k * k * c) * 1e4,
        (7.0 * s - 63.0 * k * c - 112000.0 * k + 35.0 * k * k * s) * 1e4];
    Upper4: -1.317538157404613 to 0.9495704265766943, k s c m => [
        3.0 * s + 2.0 * k * c - k * s, 5.0 * c - 2.0 * k * s - s - k * c,
        (27.0 * k * c - 27.0 * s - 1800.0 * m) * 1e4, (1800.0 * s - 27.0 * k * s) * 1e4];
}

/// Lower body of Example 4, both pieces of one type.
enum Lower4<const COUNT: bool> {
    Left,
    Right,
}
impl<const COUNT: bool> ParametricProfile<f64> for Lower4<COUNT> {
    fn domain(&self) -> [f64; 2] {
        if matches!(self, Self::Left) { Left4::<COUNT>.domain() } else { Right4::<COUNT>.domain() }
    }
    fn at(&self, k: f64) -> CurvePoint<f64> {
        if matches!(self, Self::Left) { Left4::<COUNT>.at(k) } else { Right4::<COUNT>.at(k) }
    }
    fn at_many(&self, k: &[f64], points: &mut [CurvePoint<f64>]) {
        match self {
            Self::Left => Left4::<COUNT>.at_many(k, points),
            Self::Right => Right4::<COUNT>.at_many(k, points),
        }
    }
}

fn bodies<const COUNT: bool>(task: &str) -> [Body; 2] {
    match task {
        "T1" => [Box::new(Lower1::<COUNT>), Box::new(Upper1::<COUNT>)],
        "T2" => [Box::new(Lower2::<COUNT>), Box::new(Upper2::<COUNT>)],
        "T4" => [Box::new(Flat), Box::new(Circle::<COUNT>)],
        "T5" => {
            let lower = Piecewise::new(vec![Lower4::<COUNT>::Left, Lower4::Right]);
            [Box::new(lower.expect("both pass through the origin")), Box::new(Upper4::<COUNT>)]
        }
        _ => [Box::new(Lower3::<COUNT>), Box::new(Upper3::<COUNT>)],
    }
}

/// Task: name, κ, C, fixed limits, and its solution: centre, half-width, Chebyshev coefficients of
/// the right-hand side (T5: of a right-hand side for the part of P without the logarithm).
struct Task {
    name: &'static str,
    kappa: f64,
    c: f64,
    fixed: Option<[f64; 2]>,
    solution: (f64, f64, &'static str),
}

#[rustfmt::skip]
const TASKS: [Task; 6] = [
    Task { name: "T1", kappa: 1.0, c: 0.0, fixed: Some([-1.0, 1.0]), solution: (0.0, 1.0, "") },
    Task { name: "T2", kappa: FRAC_PI_2, c: 128.0 * PI * PI / 25.0, fixed: None, solution: (0.2, 0.8,
        "0 40.21238596594935") },
    Task { name: "T3a", kappa: 1.0, c: 300.0, fixed: None, solution: (-0.00011218768434954629, 0.05774899329627286,
        "0 3307.1733515846536 6.424798476792179 0.04808389031058748 0.00025813285758667 1.7092377412696486e-06 \
        1.0939264538202458e-08 7.335405226928906e-11 4.925182490446023e-13") },
    Task { name: "T3b", kappa: FRAC_PI_2, c: 300.0, fixed: None,
        solution: (-7.142057824209629e-05, 0.046077268928881136,
        "0 4144.905636769736 6.424693528807875 0.03836467546514821 0.00016432838517098272 8.681805410828562e-07 \
        4.433368320127571e-09 2.3719636916371646e-11 1.2707043626945634e-13") },
    Task { name: "T4", kappa: 1.0, c: 2.0 * (1.685750354812596 - 1.4674622093394272), fixed: None, solution: (0.0, 0.5,
        "0 0.555866197926681 0 0.020313340445760702 0 0.0011002657326953011 0 6.602238201921369e-05 0 \
        4.154937871502372e-06 0 2.6879317039424103e-07 0 1.7704998456001767e-08 0 1.18110072717243e-09 0 \
        7.953781558835368e-11 0 5.3953963306224255e-12 0 3.6812014189293114e-13 0 2.5235146905426402e-14 0 \
        1.736698e-15") },
    Task { name: "T5", kappa: 1.0, c: 20.0, fixed: None, solution: (-0.001221227286410431, 0.0018828900077427146,
        "0 11675.914075788261 -1.689868735563791 0.0012598662795463855 -7.643078970743352e-08 \
        2.5613425669178454e-10 5.2157753485198495e-14") },
];
/// Kink of T5, as z: on its right G is larger by Σ `JUMP[m] (z - KINK)^m`.
const KINK: f64 = 0.6485919418492684;
const JUMP: &str = "0 31252.11420401319 -19.02592960852482 0.010535653793177342 \
    -1.1187810397463631e-05 3.4111734521404177e-09 -8.953820989601547e-12";

fn numbers(list: &str) -> Vec<f64> {
    list.split_whitespace().map(|number| number.parse().expect("a number")).collect()
}

impl Task {
    fn pressure(&self, x: f64) -> f64 {
        if self.name == "T1" {
            let log = ((1.0 + x) / (1.0 - x)).ln();
            return -(2.0 * x + (1.0 - x * x) * log) / (PI * PI * (1.0 - x * x).sqrt());
        }
        let (c, half, series) = self.solution;
        let z = (x - c) / half;
        let (mut u, mut jump) = ([0.0; 2], 0.0);
        let series = numbers(series);
        series[1..].iter().rev().for_each(|c| u = [c + 2.0 * z * u[0] - u[1], u[0]]);
        let smooth = (1.0 - z * z).max(0.0).sqrt() / PI * u[0];
        if self.name != "T5" {
            return smooth;
        }
        numbers(JUMP).iter().rev().for_each(|d| jump = d + (z - KINK) * jump);
        let tau = |z: f64| ((1.0 - z) / (1.0 + z)).sqrt();
        let log = ((tau(KINK) + tau(z)) / (tau(KINK) - tau(z))).abs().ln();
        smooth + if log.is_finite() { jump * log } else { 0.0 } / (PI * PI)
    }

    /// Returns the errors of the pressure and of the limits.
    fn errors(&self, [left, right]: [f64; 2], points: &Points) -> [f64; 2] {
        // `total_cmp` orders NaN as the largest number.
        let largest = |of: &dyn Fn([f64; 2]) -> f64| points.iter().map(of).max_by(f64::total_cmp);
        let error = largest(&|[x, p]| (p - self.pressure(x)).abs());
        let scale = largest(&|[x, _]| self.pressure(x).abs());
        let (c, half, _) = self.solution;
        let limits = (left - (c - half)).abs().max((right - (c + half)).abs()) / half;
        [error.unwrap_or(f64::NAN) / scale.unwrap_or(f64::NAN), limits]
    }
}

/// Returns the errors of the pressure and of the limits, and the evaluations of the curves.
fn count(task: &Task, tolerance: f64) -> Result<([f64; 2], usize)> {
    let (mut points, counted) = (Points::new(), bodies::<true>(task.name));
    let before = CALLS.load(Relaxed);
    let contact = cold(task, &counted, tolerance, &mut points)?;
    Ok((task.errors(contact, &points), CALLS.load(Relaxed) - before))
}

/// Returns the evaluations of the curves for a task by its name.
#[allow(dead_code)] // Of use to tests/suite/readme.rs.
pub(crate) fn evaluations(name: &str, tolerance: f64) -> usize {
    let task = TASKS.iter().find(|task| task.name == name).expect("one of the tasks");
    count(task, tolerance).expect("the task has a solution").1
}

/// Returns the errors of the pressure and of the limits, the evaluations of the curves, and µs
/// cold.
fn measure(task: &Task, tolerance: f64) -> Result<([f64; 2], usize, f64)> {
    let (errors, calls) = count(task, tolerance)?;
    let (bodies, mut points) = (bodies::<false>(task.name), Points::new());
    let us = time(|| {
        let _ = black_box(cold(task, black_box(&bodies), black_box(tolerance), &mut points));
        black_box(&mut points);
    });
    Ok((errors, calls, us))
}

/// Judges a line of the results of another program: its name, task, setting, -b, a, evaluations,
/// µs, and the pressures at 101 equidistant points of its contact.
fn judge(line: &str) -> Option<()> {
    let columns: Vec<&str> = line.split('\t').collect();
    let [name, of, setting, left, right, evaluations, us, pressures] = columns[..] else {
        return None;
    };
    let task = TASKS.iter().find(|task| task.name == of)?;
    let on = Interval { left: left.parse().ok()?, right: right.parse().ok()? };
    let p: [f64; 101] = numbers(pressures).try_into().ok()?;
    let [error, limits] = task.errors([on.left, on.right], &Points { x: places(on), p });
    println!("{of}\t{name}\t{setting}\t{error:.1e}\t{limits:.1e}\t{evaluations}\t{us}");
    Some(())
}

fn judge_all(path: &str) {
    let found = std::fs::read_to_string(path).unwrap_or_else(|error| panic!("{path}: {error}"));
    println!("task\tprogram\tsetting\terror\tlimit_error\tevaluations\tmicroseconds");
    for line in found.lines() {
        judge(line).unwrap_or_else(|| eprintln!("not a result: {line:.60}"));
    }
    for task in TASKS.iter().filter(|task| ["T2", "T3a", "T4", "T5"].contains(&task.name)) {
        for tolerance in [1e-3, 1e-6, 1e-9, 1e-12] {
            let (name, own) = (task.name, measure(task, tolerance));
            let ([error, limits], calls, us) =
                own.unwrap_or_else(|error| panic!("{name}: {error}"));
            print!("{name}\tlinecontact\ttol={tolerance:e}\t");
            println!("{error:.1e}\t{limits:.1e}\t{calls}\t{us:.3}");
        }
    }
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let Some(word) = arguments.iter().position(|argument| argument == "judge") {
        return judge_all(arguments.get(word + 1).expect("judge FILE"));
    }
    let mut tolerances: Vec<f64> = arguments.iter().filter_map(|a| a.parse().ok()).collect();
    if tolerances.is_empty() {
        tolerances = vec![1e-3, 1e-6, 1e-9, 1e-12];
    }
    let named = |name| arguments.iter().any(|a| a == name);
    let all = !TASKS.iter().any(|task| named(task.name));
    println!("task\ttol\terror\tlimit_error\tevaluations\tcold_us\twarm_us");
    for task in TASKS.iter().filter(|task| all || named(task.name)) {
        let (name, bodies) = (task.name, bodies::<false>(task.name));
        for &tolerance in &tolerances {
            match (measure(task, tolerance), warm(task, &bodies, tolerance)) {
                (Ok(([error, limits], calls, us)), Ok(warm)) => {
                    print!("{name}\t{tolerance:e}\t{error:.1e}\t{limits:.1e}\t");
                    println!("{calls}\t{us:.4}\t{warm:.4}");
                }
                (Err(error), _) | (_, Err(error)) => eprintln!("{name}: {error}"),
            }
        }
    }
}
