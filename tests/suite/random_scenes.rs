//! Random rough, wavy, kinked and cornered bodies against boundary elements: every `Ok` is the
//! contact.
//!
//! Scene i is the same in every run.
//! `cargo test --release --test suite a_thousand -- --ignored --nocapture` prints the refused
//! scenes.
#![allow(missing_docs)]

use crate::boundary_elements::{Oracle, solve};
use crate::common::NanSafe;
use crate::common::{Profile, intervals};

use linecontact::{
    Contact, ContactError, Control, Cost, Curve, CurvePoint, Edge, EvaluationError, Flat, Interval,
    Piecewise, Solution, SolveError,
};
use std::collections::BTreeMap;
use std::f64::consts::PI;
use std::sync::Arc;

/// Allowed errors: of a pressure, as a share of the peak; of an overlap, times κ, as a share of the
/// load, the scale of the logarithmic potential. The oracle gives the allowed error of a limit.
const PRESSURE: f64 = 0.01;
const OVERLAP: f64 = 3e-5;
const TENSION: f64 = 1e-9;

/// Random numbers by Marsaglia's xorshift, 64 bits.
pub struct Dice(u64);

impl Dice {
    pub fn new(seed: u64) -> Self {
        let mut dice = Self((seed + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15));
        for _ in 0..8 {
            dice.uniform();
        }
        dice
    }

    pub fn uniform(&mut self) -> f64 {
        for (left, by) in [(true, 13), (false, 7), (true, 17)] {
            self.0 ^= if left { self.0 << by } else { self.0 >> by };
        }
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn within(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.uniform()
    }

    pub fn power_of_ten(&mut self, from: f64, to: f64) -> f64 {
        10f64.powf(self.within(from, to))
    }

    pub fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.uniform()).sum::<f64>() - 6.0
    }
}

/// Wave `a cos(k x + φ)`.
#[derive(Clone, Copy)]
struct Wave {
    a: f64,
    k: f64,
    phase: f64,
}

/// Height `c x²/2 + t x`, with waves and kinks `m abs(x - x₀)`.
#[derive(Clone)]
struct Surface {
    curvature: f64,
    tilt: f64,
    waves: Vec<Wave>,
    /// Pairs of m and x₀.
    kinks: Vec<[f64; 2]>,
}

impl Surface {
    /// Returns height and slope; at a kink the slope on its right.
    fn at(&self, x: f64) -> [f64; 2] {
        let mut sum = [x * (0.5 * self.curvature * x + self.tilt), self.curvature * x + self.tilt];
        for &Wave { a, k, phase } in &self.waves {
            let (sin, cos) = (k * x + phase).sin_cos();
            sum = [sum[0] + a * cos, sum[1] - a * k * sin];
        }
        for &[m, x0] in &self.kinks {
            sum = [sum[0] + m * (x - x0).abs(), sum[1] + if x < x0 { -m } else { m }];
        }
        sum
    }
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    Rough,
    Wavy,
    Kinked,
    KinkedUndeclared,
    Cornered,
}

struct Scene {
    kind: Kind,
    gap: Surface,
    /// Part of the gap that belongs to the lower body.
    lower: Option<Surface>,
    /// Bend of the parameter: x = k + bend sin k.
    bend: f64,
    range: [f64; 2],
    kappa: f64,
    load: f64,
    /// True if corners that the contact reaches are given as fixed.
    fixed: bool,
}

fn scene(number: u64) -> Scene {
    let dice = &mut Dice::new(number);
    let kind = match number % 8 {
        0..3 => Kind::Rough,
        3 => Kind::Wavy,
        4 => Kind::Kinked,
        5 => Kind::KinkedUndeclared,
        _ => Kind::Cornered,
    };
    let mut gap = Surface { curvature: 1.0, tilt: 0.0, waves: Vec::new(), kinks: Vec::new() };
    let wave = |dice: &mut Dice, a, k| Wave { a, k, phase: dice.within(0.0, 2.0 * PI) };
    match kind {
        Kind::Rough => {
            let rough = dice.power_of_ten(0.0, 1.4);
            for _ in 0..12 {
                let k = dice.within(3.0, 25.0);
                let a = 0.8 * dice.normal() / (k * k) * rough;
                gap.waves.push(wave(dice, a, k));
            }
        }
        Kind::Wavy => {
            let length = dice.within(0.15, 0.8);
            let a = dice.power_of_ten(-1.4, 0.5) * length * length;
            gap.waves.push(wave(dice, a, 2.0 * PI / length));
        }
        Kind::Kinked | Kind::KinkedUndeclared => {
            let k = dice.within(3.0, 15.0);
            let a = dice.power_of_ten(-0.3, 1.0) / (k * k);
            gap.waves.push(wave(dice, a, k));
            for _ in 0..1 + (dice.uniform() * 4.0) as usize {
                // Two thirds of the kinks are convex.
                let sign = if dice.uniform() < 0.67 { 1.0 } else { -1.0 };
                let m = sign * dice.power_of_ten(-2.0, -0.5);
                gap.kinks.push([m, dice.within(-0.7, 0.7)]);
            }
            gap.kinks.sort_by(|one, two| one[1].total_cmp(&two[1]));
        }
        Kind::Cornered => {
            (gap.curvature, gap.tilt) = (dice.within(-0.05, 0.2), 0.03 * dice.normal());
            let k = dice.within(2.0, 16.0);
            let a = dice.power_of_ten(-1.5, -0.3) / k;
            gap.waves.push(wave(dice, a, k));
        }
    }
    // A third of the smooth gaps have a curved, wavy body below.
    let smooth = gap.kinks.is_empty();
    let lower = (smooth && dice.uniform() < 0.33).then(|| {
        let (a, k) = (0.05 * dice.normal(), dice.within(0.5, 3.0));
        let waves = vec![wave(dice, a, k)];
        Surface { curvature: dice.within(-1.0, 0.9), tilt: 0.1, waves, kinks: Vec::new() }
    });
    // A corner must be exact in x, so cornered bodies have no bend.
    let bend = if smooth && kind != Kind::Cornered && dice.uniform() < 0.5 {
        dice.within(-0.4, 0.4)
    } else {
        0.0
    };
    let range = if kind == Kind::Cornered { [-1.0, 1.0] } else { [-2.0, 2.0] };
    let kappa = dice.power_of_ten(-1.0, 1.0);
    let few = dice.uniform() < 0.2;
    let load =
        kappa * if few { dice.power_of_ten(-7.0, -3.0) } else { dice.power_of_ten(-3.0, -0.3) };
    Scene { kind, gap, lower, bend, range, kappa, load, fixed: dice.uniform() < 0.5 }
}

impl Scene {
    /// Returns the lower and the upper body.
    fn bodies(&self) -> [Profile; 2] {
        let flat = Surface { curvature: 0.0, tilt: 0.0, waves: Vec::new(), kinks: Vec::new() };
        let lower = Arc::new(self.lower.clone().unwrap_or(flat));
        let gap = Arc::new(self.gap.clone());
        let below = lower.clone();
        let upper = move |x: f64| {
            let ([y, dy], [below, slope]) = (gap.at(x), below.at(x));
            [y + below, dy + slope]
        };
        let upper = self.body(upper, if self.kind == Kind::Kinked { &self.gap.kinks } else { &[] });
        let is_flat = self.lower.is_none();
        [if is_flat { Box::new(Flat) } else { self.body(move |x| lower.at(x), &[]) }, upper]
    }

    /// Returns a curve x = k + bend sin k, in pieces.
    fn body(
        &self,
        height: impl Fn(f64) -> [f64; 2] + Send + Sync + Clone + 'static,
        kinks: &[[f64; 2]],
    ) -> Profile {
        let bend = self.bend;
        // X = k if there are kinks, and the bodies end with the range.
        let end = |x: f64| {
            let mut k = x;
            for _ in 0..60 {
                k -= (k + bend * k.sin() - x) / (1.0 + bend * k.cos());
            }
            k
        };
        let mut ends = vec![end(self.range[0])];
        ends.extend(kinks.iter().map(|kink| kink[1]));
        ends.push(end(self.range[1]));
        let piece = |ends: &[f64]| -> Profile {
            let (height, right) = (height.clone(), ends[1]);
            Box::new(Curve::new([ends[0], right], move |k: f64| {
                let (x, dx) = (k + bend * k.sin(), 1.0 + bend * k.cos());
                let [y, mut slope] = height(x);
                if k == right {
                    // Slope on the left of the kink.
                    slope = height(x.next_down())[1];
                }
                CurvePoint { x, y, dx, dy: slope * dx }
            }))
        };
        let mut pieces: Vec<Profile> = ends.windows(2).map(piece).collect();
        if pieces.len() == 1 {
            pieces.remove(0)
        } else {
            Box::new(Piecewise::new(pieces).expect("the pieces meet"))
        }
    }

    fn oracle(&self) -> Option<Oracle> {
        let kinks: Vec<f64> = self.gap.kinks.iter().map(|kink| kink[1]).collect();
        solve(&|x| self.gap.at(x)[0], self.kappa, self.load, self.range, &kinks)
    }
}

enum Outcome {
    Solved,
    Refused(String),
    Wrong(String),
}

fn outcome(scene: &Scene, oracle: &Oracle) -> Outcome {
    let bodies = scene.bodies();
    let contact = match Contact::new(&*bodies[0], &*bodies[1]) {
        Ok(contact) => contact.kappa(scene.kappa),
        Err(error) => return Outcome::Wrong(format!("no scene: {error}")),
    };
    let last = oracle.x.len() - 1;
    let reached = [0, last].map(|i| oracle.pressure[i] > 0.0);
    let cornered = scene.kind == Kind::Cornered;
    let edge = |i: usize| match cornered {
        true if scene.fixed && reached[i] => Edge::Fixed(scene.range[i]),
        true => Edge::FreeUntil(scene.range[i]),
        false => Edge::Free,
    };
    let contact = contact.edges(edge(0), edge(1));
    let too_short = !cornered && reached != [false; 2];
    match contact.solve(Control::Load(scene.load)) {
        Err(ContactError::Solve(SolveError::DomainTooShort { .. })) if too_short => Outcome::Solved,
        Err(error) => Outcome::Refused(error.to_string()),
        Ok(_) if too_short => Outcome::Wrong("it is wider than the bodies".to_owned()),
        Ok(solution) => match fault(scene, oracle, &solution) {
            Ok(None) => Outcome::Solved,
            Ok(Some(fault)) => Outcome::Wrong(fault),
            Err(error) => Outcome::Wrong(format!("solved, but no pressure: {error}")),
        },
    }
}

/// Returns places in a contact and their weights, dense at the ends and at kinks.
fn quadrature(on: Interval<f64>, kinks: &[f64]) -> Vec<[f64; 2]> {
    const COUNT: usize = 1600;
    let mut angles: Vec<f64> =
        kinks.iter().filter(|&&x| on.contains(x)).map(|&x| on.angle(x)).chain([0.0, PI]).collect();
    angles.sort_by(f64::total_cmp);
    let panel = |ends: &[f64]| {
        let [from, over] = [ends[0], ends[1] - ends[0]];
        (0..COUNT).map(move |i| {
            let s = (i as f64 + 0.5) / COUNT as f64;
            let theta = from + over * s * s * (3.0 - 2.0 * s);
            let weight = over * 6.0 * s * (1.0 - s) / COUNT as f64;
            [on.at_angle(theta), weight * on.half_width() * theta.sin()]
        })
    };
    angles.windows(2).flat_map(panel).collect()
}

/// Describes the fault of a solution, if any.
fn fault(
    scene: &Scene,
    oracle: &Oracle,
    solution: &Solution<f64>,
) -> Result<Option<String>, ContactError<f64>> {
    let contacts = intervals(solution);
    let kinks: Vec<f64> = scene.gap.kinks.iter().map(|kink| kink[1]).collect();
    let known = &oracle.contacts;
    if let Some([x, error]) = oracle.disagreement(&contacts) {
        return Ok(Some(format!("limit {x:?} not within {error:.1e}: {contacts:?}, {known:?}")));
    }
    let pressure = solution.pressure()?;
    let at = |x: f64| match pressure.estimate(x, &mut Cost::default()) {
        // At a kink the pressure is infinite.
        Err(ContactError::Evaluation(EvaluationError::Singular { .. })) => Ok(f64::INFINITY),
        other => other.map(|estimate| estimate.value),
    };
    // Place, pressure and integration weight.
    let mut places: Vec<[f64; 3]> = Vec::new();
    for on in &contacts {
        for [x, weight] in quadrature(*on, &kinks) {
            let p = at(x)?;
            if p.is_finite() {
                places.push([x, p, weight]);
            } else if !kinks.iter().any(|kink| (kink - x).abs() < 1e-6)
                && ![on.left, on.right].contains(&x)
            {
                return Ok(Some(format!("the pressure is {p} at {x:?}, where there is no kink")));
            }
        }
    }
    let finite = places.iter().map(|place| place[1]);
    let peak = finite.clone().fold(0.0, f64::max).min(10.0 * oracle.peak());
    if let Some(least) = finite.reduce(f64::min).filter(|&least| least < -TENSION * peak) {
        return Ok(Some(format!("a pressure of {least:.2e}, the peak being {peak:.2e}")));
    }
    let load: f64 = places.iter().map(|[_, p, weight]| p * weight).sum();
    if (load / scene.load - 1.0).abs() > 0.01 {
        return Ok(Some(format!("the pressures add up to {load} of {}", scene.load)));
    }
    let touches = |x: f64| contacts.iter().any(|on| on.contains(x));
    let value = |&x: &f64| if touches(x) { at(x) } else { Ok(0.0) };
    let values: Vec<f64> = oracle.x.iter().map(value).collect::<Result<_, _>>()?;
    let node = |x: f64| values[oracle.x.partition_point(|&node| node < x)];
    let [off, x] = oracle.pressure_off(&kinks, node);
    if off.is_nan() || off > PRESSURE {
        return Ok(Some(format!("P({x:?}) off by {off:.1e} of the peak")));
    }
    // κ times the gap and a constant, from these pressures alone.
    let gap = |x: f64| {
        let others = places.iter().filter(|place| place[0] != x && place[1] != 0.0);
        let pressed = others.map(|[s, p, weight]| p * weight * (x - s).abs().ln());
        scene.kappa * scene.gap.at(x)[0] - pressed.sum::<f64>()
    };
    let ends = contacts.iter().flat_map(|on| [on.left, on.right]);
    let approach = ends.clone().map(gap).sum::<f64>() / ends.count() as f64;
    let outside = |x: &&f64| !contacts.iter().any(|on| (on.left..=on.right).contains(*x));
    for &x in oracle.x.iter().filter(outside) {
        let open = gap(x) - approach;
        if open.is_nan() || open < -OVERLAP * scene.load {
            let share = open / scene.load;
            return Ok(Some(format!("an overlap of {share:.1e} F/κ at {x:?}")));
        }
    }
    Ok(None)
}

/// Solves scenes, prints those refused or wrong, and returns the number of each.
fn run(numbers: std::ops::Range<u64>) -> [usize; 2] {
    let one = |number: u64| {
        let scene = scene(number);
        let oracle = scene.oracle().unwrap_or_else(|| panic!("{number}: no oracle"));
        (number, scene.kind, oracle.contacts.len(), outcome(&scene, &oracle))
    };
    let threads = std::thread::available_parallelism().map_or(1, usize::from) as u64;
    let mut all: Vec<_> = std::thread::scope(|scope| {
        let row =
            |i| numbers.clone().filter(move |number| number % threads == i).map(one).collect();
        let rows: Vec<_> =
            (0..threads).map(|i| scope.spawn(move || -> Vec<_> { row(i) })).collect();
        rows.into_iter().flat_map(|row| row.join().expect("no panic")).collect()
    });
    all.sort_by_key(|of| of.0);
    let (mut counts, [mut refused, mut wrong]) = (BTreeMap::new(), [0; 2]);
    for (number, kind, contacts, outcome) in all {
        let count = counts.entry((kind, contacts.min(6))).or_insert([0; 2]);
        count[0] += 1;
        match outcome {
            Outcome::Solved => count[1] += 1,
            Outcome::Refused(error) => {
                refused += 1;
                println!("{number:4} {kind:?}, {contacts} contacts, refused: {error}");
            }
            Outcome::Wrong(fault) => {
                wrong += 1;
                println!("{number:4} {kind:?}, {contacts} contacts, WRONG: {fault}");
            }
        }
    }
    for ((kind, contacts), [all, solved]) in &counts {
        println!("{kind:?}, {contacts} contacts: {solved} of {all}");
    }
    let several: usize =
        counts.iter().filter(|(key, _)| key.1 > 1).map(|(_, count)| count[0]).sum();
    assert!(
        4 * several > (numbers.end - numbers.start) as usize,
        "{several} with several contacts"
    );
    [refused, wrong]
}

#[test]
fn a_hundred_random_scenes() {
    assert_eq!(run(0..100), [0, 0], "refused, wrong");
}

#[test]
#[ignore = "takes a minute"]
fn a_thousand_random_scenes() {
    assert_eq!(run(0..1000), [0, 0], "refused, wrong");
}

/// The contact under a load is also the contact of bodies free to turn, with the load at the same
/// place: they do not turn.
#[test]
fn the_load_where_it_acts() {
    let mut refused = Vec::new();
    let mut several = 0;
    for number in 0..200 {
        let scene = scene(number);
        let bodies = scene.bodies();
        let contact = Contact::new(&*bodies[0], &*bodies[1]).unwrap().kappa(scene.kappa);
        let edge = |x| if scene.kind == Kind::Cornered { Edge::FreeUntil(x) } else { Edge::Free };
        let contact = contact.edges(edge(scene.range[0]), edge(scene.range[1]));
        let Ok(known) = contact.solve(Control::Load(scene.load)) else { continue };
        let at = known.centre_of_pressure().unwrap();
        let control = Control::CentreOfPressure { load: scene.load, at };
        let solution = match contact.solve(control) {
            Ok(solution) => solution,
            Err(error) => {
                refused.push((number, scene.kind, error.to_string()));
                continue;
            }
        };
        let [on, due] = [&solution, &known].map(intervals);
        several += usize::from(on.len() > 1);
        assert_eq!(on.len(), due.len(), "{number}: {on:?} {due:?}");
        let narrowest = due.iter().map(Interval::half_width).fold(f64::INFINITY, f64::min);
        let error = |solution: &Solution<f64>| solution.limits_error().unwrap_or(0.0);
        for (on, due) in on.iter().zip(&due) {
            let off = (on.left - due.left).abs().nan_max((on.right - due.right).abs());
            let allowed = 1e-7 + 100.0 * (error(&solution) + error(&known));
            let off = off / narrowest;
            assert!(off <= allowed, "{number} {:?}: off {off:e} of {allowed:e}", scene.kind);
        }
    }
    println!("{} refused, {several} with several contacts", refused.len());
    for refused in &refused {
        println!("{refused:?}");
    }
    assert!(refused.is_empty() && several > 20);
}
