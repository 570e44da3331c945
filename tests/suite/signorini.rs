//! Waves and measured points against the conditions of contact: no tension, the gap is closed in
//! the contact and open outside it, and the pressure carries the load. These conditions determine
//! the contact.
//!
//! The gap is computed here from heights of the bodies and the pressures of the solution alone.
//! Over one contact, with `s = c + L cos θ`, the function `P L sin θ` is a cosine series, and for
//! k > 0
//!
//! ```text
//! ∫ cos kθ ln|z - cos θ| dθ = -(π/k) cos kφ      for z = cos φ
//!                           = -(π/k) exp(-kξ)    for z = cosh ξ, times (-1)^k for z = -cosh ξ
//! ```
//!
//! `SCENES=10000 cargo test --release --test suite signorini -- --nocapture` solves 10 000 scenes
//! in each test, from the seed `FIRST` on.

mod equal_crests;
mod features;
mod inner_corners;
mod lugs;
mod right_answers;

use crate::random_scenes::Dice;
use linecontact::profile::{Fit, Spline};
use linecontact::reference::{ClosedForm, Quartic};
use linecontact::{
    Contact, ContactError, Control, Curve, CurvePoint, Flat, Interval, Material, Panels,
    ParametricProfile, Piecewise, PlaneState, Real, Reference, References, Solution, SolveError,
    Solver,
};
use std::f64::consts::{LN_2, PI};

/// Number of terms of a cosine series: initial, largest, and largest if the second of [`TAIL`] is
/// exceeded.
const TERMS: [usize; 3] = [64, 8192, 32768];
/// Tail at which a series ends, as a share of the load: goal, and upper bound.
const TAIL: [f64; 2] = [1e-10, 1e-7];
/// Allowed error of the potential, as a share of the load: waves, and splines, whose series
/// converge slowly.
const WAVES: f64 = 1e-8;
const SPLINES: f64 = 1e-6;
/// Allowed tension, as a share of the largest pressure.
const TENSION: f64 = 1e-8;

/// Pressure over a contact as a cosine series of `P L sin θ`.
struct Series {
    on: Interval<f64>,
    terms: Vec<f64>,
    /// Contribution of the last terms to the potential.
    tail: f64,
    /// Smallest and largest pressure of a node.
    pressures: [f64; 2],
}

impl Series {
    fn new<T: Real + Into<f64>>(
        on: Interval<T>,
        solution: &Solution<T>,
        load: f64,
        goal: f64,
    ) -> Self {
        let pressure = solution.pressure().unwrap();
        let on = Interval { left: on.left.into(), right: on.right.into() };
        let fill = |x: &[f64], values: &mut [f64]| {
            let x: Vec<T> = x.iter().map(|&x| T::of(x)).collect();
            let mut found = vec![T::zero(); x.len()];
            pressure.at_many(&x, &mut found).unwrap();
            values.iter_mut().zip(found).for_each(|(value, found)| *value = found.into());
        };
        let mut count = TERMS[0];
        loop {
            let series = Self::of(on, count, &fill);
            let is_left = |share: f64| series.tail > share * load;
            if !is_left(if count >= TERMS[1] { goal.max(TAIL[1]) } else { goal })
                || count == TERMS[2]
            {
                return series;
            }
            count *= 2;
        }
    }

    fn of(on: Interval<f64>, count: usize, fill: &dyn Fn(&[f64], &mut [f64])) -> Self {
        let step = PI / (2 * count) as f64;
        let half = 0.5 * (on.right - on.left);
        let angle = |i: usize| step * (2 * i + 1) as f64;
        let x: Vec<f64> = (0..count).map(|i| at_angle(on, angle(i))).collect();
        let mut values = vec![0.0; count];
        fill(&x, &mut values);
        let least = values.iter().copied().fold(f64::INFINITY, f64::min);
        let largest = values.iter().copied().fold(0.0, f64::max);
        for (i, value) in values.iter_mut().enumerate() {
            *value *= half * angle(i).sin();
        }
        // Every second value, there and back (Makhoul, *IEEE Trans. ASSP* 28, 1980, 27).
        let there = (0..count).step_by(2);
        let order = there.chain((0..count).rev().filter(|i| i % 2 == 1));
        let sums = fourier(order.map(|i| [values[i], 0.0]).collect());
        let term = |(k, [re, im]): (usize, [f64; 2])| {
            let (sin, cos) = (step * k as f64).sin_cos();
            (cos * re + sin * im) * if k == 0 { 1.0 } else { 2.0 } / count as f64
        };
        let terms: Vec<f64> = sums.into_iter().enumerate().map(term).collect();
        let last = (count - count / 8..count).map(|k| terms[k].abs() * PI / k as f64);
        Self { on, tail: last.sum(), terms, pressures: [least, largest] }
    }

    fn load(&self) -> f64 {
        PI * self.terms[0]
    }

    /// Returns `∫ P ln|x - s| ds` at an angle inside.
    fn inside(&self, angle: f64) -> f64 {
        let ([mut cos, mut sin], (by_sin, by_cos)) = ([1.0, 0.0], angle.sin_cos());
        let mut sum = 0.0;
        for (k, term) in self.terms.iter().enumerate().skip(1) {
            [cos, sin] = [cos * by_cos - sin * by_sin, cos * by_sin + sin * by_cos];
            sum += term / k as f64 * cos;
        }
        self.load() * (0.5 * (self.on.right - self.on.left) / 2.0).ln() - PI * sum
    }

    /// Returns `∫ P ln|x - s| ds` outside.
    fn outside(&self, x: f64) -> f64 {
        let Interval { left, right } = self.on;
        let half = 0.5 * (right - left);
        let beyond = (if x < left { left - x } else { x - right }) / half;
        let xi = (beyond + (beyond * (beyond + 2.0)).sqrt()).ln_1p();
        let ratio = if x < left { -(-xi).exp() } else { (-xi).exp() };
        let (mut sum, mut power) = (0.0, 1.0);
        for (k, term) in self.terms.iter().enumerate().skip(1) {
            power *= ratio;
            if power.abs() < 1e-18 {
                break;
            }
            sum += power * term / k as f64;
        }
        self.load() * (half.ln() + xi - LN_2) - PI * sum
    }

    /// Returns `∫ P f ds` of a function without singularities near the contact.
    fn integral(&self, f: impl Fn(f64) -> f64) -> f64 {
        let count = self.terms.len();
        let angle = |i: usize| PI * (i as f64 + 0.5) / count as f64;
        let value = |i: usize| {
            let terms = self.terms.iter().enumerate();
            terms.map(|(k, term)| term * (k as f64 * angle(i)).cos()).sum::<f64>()
        };
        let places = 0..count;
        places.map(|i| value(i) * f(at_angle(self.on, angle(i)))).sum::<f64>() * PI / count as f64
    }
}

/// Returns the sums of `value exp(-2πi jk/n)` over all complex values, for each k; n is a power of
/// two.
fn fourier(values: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    let count = values.len();
    if count < 2 {
        return values;
    }
    let half = |first: usize| fourier(values.iter().copied().skip(first).step_by(2).collect());
    let [even, odd] = [half(0), half(1)];
    let turned = odd.iter().enumerate().map(|(k, [re, im])| {
        let (sin, cos) = (2.0 * PI * k as f64 / count as f64).sin_cos();
        [cos * re + sin * im, cos * im - sin * re]
    });
    let turned: Vec<[f64; 2]> = turned.collect();
    let both = |sign: f64| {
        let pairs = even.iter().zip(&turned);
        pairs.map(move |(even, odd)| [even[0] + sign * odd[0], even[1] + sign * odd[1]])
    };
    both(1.0).chain(both(-1.0)).collect()
}

fn at_angle(on: Interval<f64>, angle: f64) -> f64 {
    // From the nearer limit.
    let width = on.right - on.left;
    if angle < PI / 2.0 {
        on.right - width * (angle / 2.0).sin().powi(2)
    } else {
        on.left + width * (angle / 2.0).cos().powi(2)
    }
}

/// Heights of the gap before loading, and places dense enough to resolve them.
struct Bodies<'h> {
    height: &'h dyn Fn(f64) -> f64,
    kappa: f64,
    /// Places from end to end, several for each wave, or between two measured points.
    places: Vec<f64>,
    /// Tail at which a series ends, as a share of the load.
    tail: f64,
}

/// Violations of the conditions of contact: potentials as shares of the load.
#[derive(Debug)]
#[allow(dead_code)] // Fields that are only printed.
struct Faults {
    load: f64,
    tension: f64,
    level: f64,
    overlap: f64,
    /// Place of the overlap.
    at: f64,
    /// Uncertainty of the judge.
    doubt: f64,
}

impl Faults {
    fn is_wrong(&self, allowed: f64) -> bool {
        let is_right = self.load <= allowed
            && self.tension <= TENSION
            && self.level <= allowed
            && self.overlap <= allowed;
        !is_right
    }
}

struct Judge<'h> {
    bodies: &'h Bodies<'h>,
    contacts: Vec<Series>,
    /// Sum of κ times the gap and the potential, in the contacts.
    level: f64,
    unlevel: f64,
    load: f64,
}

impl<'h> Judge<'h> {
    fn new<T: Real + Into<f64>>(bodies: &'h Bodies<'h>, solution: &Solution<T>, load: f64) -> Self {
        let series = |on: &Interval<T>| Series::new(*on, solution, load, bodies.tail);
        Self::of(bodies, solution.intervals().iter().map(series).collect(), load)
    }

    fn of(bodies: &'h Bodies<'h>, contacts: Vec<Series>, load: f64) -> Self {
        let mut judge = Self { bodies, contacts, level: 0.0, unlevel: 0.0, load };
        let mut levels = Vec::new();
        for (i, series) in judge.contacts.iter().enumerate() {
            let count = 24 + series.terms.len() / 16;
            for j in 0..count {
                // Between nodes.
                let angle = PI * (j as f64 + 0.5 + 0.1 * (j as f64).sin()) / count as f64;
                let x = at_angle(series.on, angle);
                levels
                    .push(bodies.kappa * (bodies.height)(x) - judge.potential(x, Some((i, angle))));
            }
        }
        let [least, most] =
            levels.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |ends, &level| {
                [ends[0].min(level), ends[1].max(level)]
            });
        judge.level = 0.5 * (least + most);
        judge.unlevel =
            if levels.iter().any(|level| level.is_nan()) { f64::NAN } else { most - least };
        judge
    }

    fn potential(&self, x: f64, inside: Option<(usize, f64)>) -> f64 {
        let of = |(i, series): (usize, &Series)| match inside {
            Some((number, angle)) if number == i => series.inside(angle),
            _ => series.outside(x),
        };
        self.contacts.iter().enumerate().map(of).sum()
    }

    /// Returns κ times the gap.
    fn gap(&self, x: f64) -> f64 {
        self.bodies.kappa * (self.bodies.height)(x) - self.potential(x, None) - self.level
    }

    /// Returns places outside, between two limits or a limit and an end, from left to right.
    fn places(&self, [from, to]: [f64; 2], is_limit: [bool; 2]) -> Vec<f64> {
        let places = &self.bodies.places;
        let first = places.partition_point(|&x| x <= from);
        let after = places.partition_point(|&x| x < to).max(first);
        let mut all = places[first..after].to_vec();
        for i in 0..=16 {
            let share = 0.5 * 10f64.powf(-0.375 * f64::from(i));
            let beside = share * (to - from);
            all.extend(is_limit[0].then_some(from + beside));
            all.extend(is_limit[1].then_some(to - beside));
        }
        all.extend([(!is_limit[0]).then_some(from), (!is_limit[1]).then_some(to)].iter().flatten());
        all.retain(|&x| (x > from || !is_limit[0]) && (x < to || !is_limit[1]));
        all.sort_by(f64::total_cmp);
        all.dedup();
        all
    }

    fn faults(&self) -> Faults {
        let ends = [self.bodies.places[0], *self.bodies.places.last().unwrap()];
        let limits = self.contacts.iter().flat_map(|series| [series.on.left, series.on.right]);
        let all: Vec<f64> = std::iter::once(ends[0]).chain(limits).chain([ends[1]]).collect();
        let [mut lowest, mut at] = [0.0, f64::NAN];
        for (i, span) in all.chunks_exact(2).enumerate() {
            let is_limit = [i > 0, 2 * i + 2 < all.len()];
            if span[1] <= span[0] {
                continue;
            }
            let places = self.places([span[0], span[1]], is_limit);
            let gaps: Vec<f64> = places.iter().map(|&x| self.gap(x)).collect();
            let mut take = |x: f64, gap: f64| {
                if gap.is_nan() || gap < lowest {
                    [lowest, at] = [gap, x];
                }
            };
            for j in 0..places.len() {
                take(places[j], gaps[j]);
                let beside = j.checked_sub(1).zip((j + 1 < places.len()).then_some(j + 1));
                let Some((before, after)) = beside else { continue };
                let rises = [gaps[before] - gaps[j], gaps[after] - gaps[j]];
                // A dip that may extend below zero.
                if rises[0] >= 0.0 && rises[1] >= 0.0 && gaps[j] < rises[0].max(rises[1]) {
                    let [x, gap] = lowest_between(places[before], places[after], &|x| self.gap(x));
                    take(x, gap);
                }
            }
        }
        let largest =
            self.contacts.iter().fold(0.0f64, |most, series| most.max(series.pressures[1]));
        let least =
            self.contacts.iter().fold(0.0f64, |least, series| least.min(series.pressures[0]));
        let load: f64 = self.contacts.iter().map(Series::load).sum();
        Faults {
            load: (load / self.load - 1.0).abs(),
            tension: -least / largest,
            level: self.unlevel / self.load,
            overlap: -lowest / self.load,
            at,
            doubt: self.contacts.iter().map(|series| series.tail).sum::<f64>() / self.load,
        }
    }
}

/// Returns the lowest value, by golden-section search.
fn lowest_between(mut from: f64, mut to: f64, f: &dyn Fn(f64) -> f64) -> [f64; 2] {
    let share = 0.5 * (5f64.sqrt() - 1.0);
    let mut x = [to - share * (to - from), from + share * (to - from)];
    let mut y = x.map(f);
    for _ in 0..40 {
        if y[0] < y[1] {
            to = x[1];
            x = [to - share * (to - from), x[0]];
            y = [f(x[0]), y[0]];
        } else {
            from = x[0];
            x = [x[1], from + share * (to - from)];
            y = [y[1], f(x[1])];
        }
    }
    if y[0] < y[1] { [x[0], y[0]] } else { [x[1], y[1]] }
}

fn judge<T: Real + Into<f64>>(bodies: &Bodies<'_>, solution: &Solution<T>, load: f64) -> Faults {
    let tilt: f64 = solution.tilt().into();
    let height = |x: f64| (bodies.height)(x) + tilt * x;
    let Bodies { kappa, places, tail, .. } = bodies;
    let turned = Bodies { height: &height, kappa: *kappa, places: places.clone(), tail: *tail };
    Judge::new(&turned, solution, load).faults()
}

/// Judges once more, by series with a tail of 1e-7, where shorter ones find a fault: next to a
/// corner that holds a limit, these leave more open than their tail says.
fn judge_closer(bodies: &Bodies<'_>, solution: &Solution<f64>, load: f64, allowed: f64) -> Faults {
    let faults = judge(bodies, solution, load);
    if !faults.is_wrong(allowed) || bodies.tail <= TAIL[1] {
        return faults;
    }
    let closer = Bodies { tail: TAIL[1], places: bodies.places.clone(), ..*bodies };
    judge(&closer, solution, load)
}

/// Returns a control with a share of its load.
fn lighter(control: Control<f64>, share: f64) -> Control<f64> {
    match control {
        Control::Load(load) => Control::Load(share * load),
        Control::CentreOfPressure { load, at } => {
            Control::CentreOfPressure { load: share * load, at }
        }
        other => panic!("{other:?}"),
    }
}

/// Outcomes of scenes.
#[derive(Default)]
struct Tally {
    scenes: u64,
    wrong: Vec<String>,
    refused: Vec<String>,
    too_short: usize,
    /// Scenes whose cold and warm contacts differ.
    apart: Vec<String>,
    most_contacts: usize,
    contacts: usize,
    /// Largest violations in correct solutions.
    worst: [f64; 5],
    slowest: f64,
}

impl Tally {
    /// Solves a scene cold, and from a heavier load and a lighter one.
    ///
    /// `wide` solves the scene on longer bodies, to tell whether the bodies are too short.
    fn take(
        &mut self,
        name: &str,
        contact: &Contact<'_, f64>,
        wide: &dyn Fn() -> Result<Vec<Interval<f64>>, ContactError<f64>>,
        bodies: &Bodies<'_>,
        control: Control<f64>,
        allowed: f64,
    ) {
        self.scenes += 1;
        let started = std::time::Instant::now();
        let solved = contact.solve(control);
        self.slowest = self.slowest.max(started.elapsed().as_secs_f64());
        let solution = match solved {
            Ok(solution) => solution,
            Err(error @ ContactError::Solve(SolveError::DomainTooShort { .. })) => {
                self.too_short += 1;
                let [from, to] = [bodies.places[0], *bodies.places.last().unwrap()];
                match wide() {
                    Ok(on) if on[0].left > from && on[on.len() - 1].right < to => {
                        self.refused.push(format!("{name}: {error}, but {on:?}"));
                    }
                    _ => {}
                }
                return;
            }
            Err(error) => {
                self.refused.push(format!("{name}: {error}"));
                return;
            }
        };
        let contacts = solution.intervals().len();
        self.contacts += contacts;
        self.most_contacts = self.most_contacts.max(contacts);
        let load = solution.load();
        let faults = judge_closer(bodies, &solution, load, allowed);
        let is_aside = match control {
            Control::Load(given) => load != given,
            Control::CentreOfPressure { load: given, at } => {
                let off = (solution.centre_of_pressure().unwrap() - at).abs();
                load != given || off > 1e-6 * solution.hull().half_width()
            }
            other => panic!("{other:?}"),
        };
        if is_aside || faults.is_wrong(allowed) {
            self.wrong.push(format!("{name}: {contacts} contacts, {faults:?}"));
        } else {
            let found = [faults.load, faults.tension, faults.level, faults.overlap, faults.doubt];
            self.worst = std::array::from_fn(|i| self.worst[i].max(found[i]));
        }
        for share in [1.5, 0.6] {
            let mut solver = Solver::new();
            let _ = solver.solve(contact, lighter(control, share));
            match solver.solve(contact, control) {
                Ok(warm) => {
                    let apart = apart(solution.intervals(), warm.intervals());
                    // Where one of them is held at a corner, the error says how far it may be off.
                    let known = [&solution, &warm].map(|one| one.limits_error().unwrap_or(0.0));
                    let known = (known[0] + known[1]).min(1e-6);
                    if apart.is_nan() || apart > 1e-9 + known {
                        let (is_wrong, warmed) =
                            (faults.is_wrong(allowed), judge(bodies, &warm, load));
                        let from = format!("from {share} of the load {apart:e} of the contact");
                        let count = warm.intervals().len();
                        self.apart.push(format!(
                            "{name}: {from}, {count} for {contacts}, cold wrong: {is_wrong}, warm {warmed:?}"
                        ));
                    }
                }
                Err(error) => self.apart.push(format!("{name}: from {share} of the load {error}")),
            }
        }
    }

    fn finish(self) {
        let [load, tension, level, overlap, doubt] = self.worst;
        println!(
            "{} scenes, {} contacts, at most {}; {} too short; slowest {:.2} s\n\
             load {load:.1e} tension {tension:.1e} level {level:.1e} overlap {overlap:.1e} doubt {doubt:.1e}",
            self.scenes, self.contacts, self.most_contacts, self.too_short, self.slowest
        );
        let [wrong, refused, apart] = [&self.wrong, &self.refused, &self.apart];
        let counts = [wrong.len(), refused.len(), apart.len()];
        let lists = [wrong, refused, apart].map(|list| list.join("\n"));
        assert!(
            counts == [0; 3],
            "{} wrong:\n{}\n{} refused:\n{}\n{} cold and warm apart:\n{}",
            counts[0],
            lists[0],
            counts[1],
            lists[1],
            counts[2],
            lists[2]
        );
    }
}

/// Returns the length covered by only one of two contacts, as a share of both.
fn apart(one: &[Interval<f64>], other: &[Interval<f64>]) -> f64 {
    let mut limits: Vec<(f64, bool, f64)> = Vec::new();
    for (of_one, all) in [(true, one), (false, other)] {
        limits.extend(all.iter().flat_map(|on| [(on.left, of_one, 1.0), (on.right, of_one, -1.0)]));
    }
    limits.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut inside, mut apart, mut all) = ([0.0, 0.0], 0.0, 0.0);
    for pair in limits.windows(2) {
        inside[usize::from(pair[0].1)] += pair[0].2;
        let length = pair[1].0 - pair[0].0;
        apart += if inside[0] == inside[1] { 0.0 } else { length };
        all += if inside == [0.0, 0.0] { 0.0 } else { length };
    }
    apart / all
}

/// Parabola `x²/(2R)` with waves `a cos(w x + phase)`.
#[derive(Clone, Debug)]
struct Wavy {
    radius: f64,
    waves: Vec<[f64; 3]>,
    /// Load F/κ.
    load: f64,
    kappa: f64,
}

impl Wavy {
    /// Returns random waves on bodies from -1 to 1: 3 to 300 waves, and a load of 1e-7 to 0.1 of κ
    /// and the width.
    fn new(dice: &mut Dice) -> Self {
        loop {
            let load = 2.0 * dice.power_of_ten(-7.0, -1.0);
            let radius = dice.power_of_ten(-0.5, (0.18 / load).log10().min(1.0));
            let count = if dice.uniform() < 0.5 { 1 } else { 2 };
            let is_symmetric = dice.uniform() < 0.2;
            let mut wave = || {
                let w = PI * dice.power_of_ten(3f64.log10(), 300f64.log10());
                // Relative to the amplitude at which the gap is still convex.
                let a = dice.power_of_ten(-0.7, 2.3) / (w * w * radius);
                let turn = (2.0 * dice.uniform()).floor() * PI;
                let phase = dice.within(-PI, PI);
                [a, w, if is_symmetric { turn } else { phase }]
            };
            let waves: Vec<_> = (0..count).map(|_| wave()).collect();
            let heights: f64 = waves.iter().map(|[a, ..]| a.abs()).sum();
            // Distance within which crests may touch, and their number.
            let reach = (2.0 * radius * load + 4.0 * radius * heights).sqrt();
            let crests = waves.iter().fold(0.0f64, |most, wave| most.max(reach * wave[1] / PI));
            let kappa = dice.power_of_ten(-3.0, 3.0);
            if reach < 0.8 && crests < 100.0 {
                return Self { radius, waves, load, kappa };
            }
        }
    }

    /// Returns height and slope.
    fn at(&self, x: f64) -> [f64; 2] {
        let mut at = [x * x / (2.0 * self.radius), x / self.radius];
        for &[a, w, phase] in &self.waves {
            let (sin, cos) = (w * x + phase).sin_cos();
            at = [at[0] + a * cos, at[1] - a * w * sin];
        }
        at
    }

    fn body(&self, reach: f64) -> impl ParametricProfile<f64> + use<> {
        let scene = self.clone();
        Curve::new([-reach, reach], move |x| {
            let [y, dy] = scene.at(x);
            CurvePoint { x, y, dx: 1.0, dy }
        })
    }

    /// Returns places from -1 to 1, `each` for each wave.
    fn places(&self, each: f64) -> Vec<f64> {
        let finest = self.waves.iter().fold(0.0f64, |most, wave| most.max(wave[1] / PI));
        even((each * finest).max(400.0) as usize)
    }
}

fn even(count: usize) -> Vec<f64> {
    (0..=count).map(|i| 2.0 * i as f64 / count as f64 - 1.0).collect()
}

/// Returns the seeds: `SCENES` of them from `FIRST` on, if set in the environment.
fn scenes(default: u64) -> std::ops::Range<u64> {
    let number = |name: &str| std::env::var(name).ok().map(|count| count.parse::<u64>().unwrap());
    let first = number("FIRST").unwrap_or(0);
    first..first + number("SCENES").unwrap_or(default)
}

#[test]
fn waves_touch_as_bodies_do() {
    let mut tally = Tally::default();
    // Two equally high crests, on the left and on the right; crests next to the limit of a contact,
    // where halved panels were as uncertain at first, and where about one node in six waves is
    // known; waves for which a single contact fails; contacts that appear and vanish from one trial
    // to the next, three and twenty.
    let by_name = [395, 2795, 6938, 8098, 2626, 9035];
    for seed in scenes(200).chain(by_name) {
        let scene = Wavy::new(&mut Dice::new(seed));
        let body = scene.body(1.0);
        let load = scene.kappa * scene.load;
        let contact = Contact::new(&Flat, &body).unwrap().kappa(scene.kappa);
        let wide = || {
            let body = scene.body(3.0);
            let contact = Contact::new(&Flat, &body)?.kappa(scene.kappa);
            Ok(contact.solve(Control::Load(load))?.intervals().to_vec())
        };
        let height = |x: f64| scene.at(x)[0];
        let bodies = Bodies {
            tail: TAIL[0],
            height: &height,
            kappa: scene.kappa,
            places: scene.places(12.0),
        };
        tally.take(
            &format!("{seed} {scene:?}"),
            &contact,
            &wide,
            &bodies,
            Control::Load(load),
            WAVES,
        );
    }
    tally.finish();
}

/// A correct solution is certified, under any load.
#[test]
fn waves_are_certified() {
    let (mut evaluations, mut most, mut refused) = (0, 0, Vec::new());
    let seeds = scenes(100);
    for seed in seeds.clone() {
        let scene = Wavy::new(&mut Dice::new(seed));
        let body = scene.body(1.0);
        let contact = Contact::new(&Flat, &body).unwrap().kappa(scene.kappa);
        let solution = contact.solve(Control::Load(scene.kappa * scene.load)).unwrap();
        match solution.certify() {
            Ok(certificate) => {
                let cost = certificate.cost;
                evaluations += cost.evaluations.max(cost.samples);
                most = most.max(cost.evaluations.max(cost.samples));
            }
            Err(error) => refused.push(format!("{seed}: {error}")),
        }
    }
    let mean = evaluations / (seeds.end - seeds.start) as usize;
    println!("{mean} evaluations a certificate, {most} at most; refused {refused:#?}");
    assert!(refused.is_empty());
}

/// One interval unchecked, often with tension inside or overlap outside, by panels of a loose
/// tolerance: a certificate is refused where the bodies part or overlap by more than 2 %. The
/// first scene passed although its tension is 84 % of the peak.
#[test]
fn no_wrong_answer_of_a_loose_tolerance_is_certified() {
    let silent = [certified_though_wrong::<f64>(), certified_though_wrong::<f32>()];
    assert!(silent.iter().all(Vec::is_empty), "{silent:#?}");
}

/// Lists the scenes whose solution in a number type is wrong and certified.
fn certified_though_wrong<T: Real + Into<f64>>() -> Vec<String> {
    let (mut silent, mut wrong, mut certified) = (Vec::new(), 0, 0);
    for seed in scenes(100) {
        let dice = &mut Dice::new(seed);
        let (mut wave, mut tolerance, mut load) = ([0.125, 8.0, 1.0], 1e-4, 0.03);
        if seed > 0 {
            let w = dice.within(4.0, 20.0);
            wave = [dice.power_of_ten(-0.5, 1.0) / (w * w), w, dice.within(-PI, PI)];
            (tolerance, load) = (dice.power_of_ten(-6.0, -2.0), dice.power_of_ten(-2.5, -1.0));
        }
        let scene = Wavy { radius: 1.0, waves: vec![wave], load, kappa: 1.0 };
        let wavy = scene.clone();
        let body = Curve::new([-T::one(), T::one()], move |x: T| {
            let [y, dy] = wavy.at(x.into()).map(T::of);
            CurvePoint { x, y, dx: T::one(), dy }
        });
        let rule = Panels { tolerance };
        let contact = Contact::new(&Flat, &body).unwrap().kappa(T::one()).quadrature(&rule);
        let contact = contact.single_interval(true);
        let Ok(solution) = contact.solve(Control::Load(T::of(load))) else { continue };
        let height = |x: f64| scene.at(x)[0];
        let places = scene.places(12.0);
        let bodies = Bodies { tail: 1e-6, height: &height, kappa: 1.0, places };
        let faults = judge(&bodies, &solution, load);
        let is_wrong = faults.tension > 0.02 || faults.overlap > 0.02;
        let is_certified = solution.certify().is_ok();
        (wrong, certified) = (wrong + u64::from(is_wrong), certified + u64::from(is_certified));
        if is_wrong && is_certified {
            silent.push(format!("{seed} {tolerance} {scene:?}: {faults:?}"));
        }
    }
    println!("{wrong} wrong, {certified} certified, of which wrong: {}", silent.len());
    assert!(wrong > 0 && certified > 0);
    silent
}

/// Points measured on a parabola from -1 to 1.
struct Measured {
    name: String,
    points: Vec<[f64; 2]>,
    /// Load F/κ.
    load: f64,
}

impl Measured {
    fn new(dice: &mut Dice) -> Self {
        let count = dice.power_of_ten(60f64.log10(), 3000f64.log10()) as usize;
        let step = 2.0 / (count - 1) as f64;
        let radius = dice.power_of_ten(-0.5, 1.0);
        let kind = ["white", "rough", "worn", "turned", "lone"][(5.0 * dice.uniform()) as usize];
        // The half-width of the parabola alone; heights relative to its depth there.
        let (half, height) = loop {
            let half = dice.power_of_ten((2.0 * step).max(2e-3).log10(), -0.3);
            let height = dice.power_of_ten(-4.0, 0.3);
            // Points in the contact: a bound on the number of contacts.
            let points = 2.0 * half / step;
            if points * (1.0 + height).sqrt() < 120.0 || points < 400.0 && height * points < 2.0 {
                break (half, height);
            }
        };
        let depth = half * half / (2.0 * radius);
        let height = height * depth;
        let jitter = if dice.uniform() < 0.3 { 0.3 * step } else { 0.0 };
        let lowest = dice.within(-0.2, 0.2);
        let mut points: Vec<[f64; 2]> = (0..count)
            .map(|i| {
                let x = -1.0 + step * i as f64 + jitter * dice.within(-1.0, 1.0);
                [x, (x - lowest).powi(2) / (2.0 * radius)]
            })
            .collect();
        let mut name = kind.to_owned();
        match kind {
            "white" => add_noise(&mut points, height, 0.0, dice),
            "rough" => {
                let length = dice.power_of_ten(0.0, 1.5);
                add_noise(&mut points, height, (-1.0 / length).exp(), dice);
                name = format!("rough {length:.1}");
            }
            "worn" => {
                add_noise(&mut points, 0.03 * height, 0.0, dice);
                let [from, to] = [dice.within(-3.0, 0.5), dice.within(0.5, 3.0)];
                let [from, to] = [from, to].map(|at| lowest + half * at);
                let is_flat = dice.uniform() < 0.5;
                let level = (from - lowest).powi(2) / (2.0 * radius);
                for [x, y] in &mut points {
                    if *x > from && *x < to {
                        *y = if is_flat { y.max(level) } else { *y + height };
                    }
                }
            }
            "turned" => {
                add_noise(&mut points, 0.01 * height, 0.0, dice);
                let period = dice.power_of_ten((6.0 * step).log10(), (60.0 * step).log10());
                let phase = dice.within(0.0, PI);
                for [x, y] in &mut points {
                    *y += 3.0 * height * (PI * *x / period + phase).sin().abs();
                }
            }
            _ => {
                add_noise(&mut points, 0.01 * height, 0.0, dice);
                for _ in 0..1 + (4.0 * dice.uniform()) as usize {
                    let at = lowest + half * dice.within(-3.0, 3.0);
                    let wide = step * dice.power_of_ten(-0.5, 1.0);
                    let high = 3.0 * height * dice.within(-1.0, 1.0);
                    for [x, y] in &mut points {
                        *y += high * (-0.5 * ((*x - at) / wide).powi(2)).exp();
                    }
                }
            }
        }
        let name = format!("{name}, {count} points, R {radius:.4}, L {half:.4}, {height:.2e}");
        Self { name, points, load: depth }
    }
}

/// Adds normally distributed heights, with a correlation from one point to the next.
fn add_noise(points: &mut [[f64; 2]], height: f64, correlation: f64, dice: &mut Dice) {
    let (own, mut last) = ((1.0 - correlation * correlation).sqrt(), 0.0);
    for point in points {
        last = correlation * last + own * dice.normal();
        point[1] += height * last;
    }
}

impl Measured {
    /// Returns four places for each point.
    fn places(&self) -> Vec<f64> {
        let between = |ends: &[[f64; 2]]| {
            [0.0, 0.25, 0.5, 0.75].map(|t| ends[0][0] + t * (ends[1][0] - ends[0][0]))
        };
        let mut places: Vec<f64> = self.points.windows(2).flat_map(between).collect();
        places.push(self.points[self.points.len() - 1][0]);
        places
    }

    /// Returns a rough parabola with up to hundreds of contacts.
    fn rough(dice: &mut Dice) -> Self {
        loop {
            let count = (500.0 * 20f64.powf(dice.uniform())) as usize;
            let load = dice.power_of_ten(-3.5, -1.0);
            let height = load * dice.power_of_ten(-2.5, -0.7);
            let length = if dice.uniform() < 0.5 { 0.0 } else { dice.within(0.3, 3.0) };
            // Three points or more, as far as they are correlated, for a contact.
            if count as f64 * (2.0 * load).sqrt() / (3.0 * length.max(1.0)) > 300.0 {
                continue;
            }
            let places = even(count - 1);
            let mut points: Vec<[f64; 2]> = places.iter().map(|&x| [x, 0.5 * x * x]).collect();
            let correlation = if length > 0.0 { (-1.0 / length).exp() } else { 0.0 };
            add_noise(&mut points, height, correlation, dice);
            let name = format!("{count} points, load {load:.2e}, {height:.2e}, {length:.2}");
            return Self { name, points, load };
        }
    }
}

/// In 567, tension so narrow that half the nodes miss it; in 704, 203 contacts of which the cells
/// find 196; in 815 a gap between two contacts opens late and closes once more before the next
/// point; in 8013 the parabola through three pressures has a third of the depth of the tension
/// between them.
#[test]
fn rough_points_touch_as_bodies_do() {
    let mut tally = Tally::default();
    for seed in scenes(2).chain([567, 704, 815, 8013]) {
        let scene = Measured::rough(&mut Dice::new(seed + (1 << 41)));
        let body = Spline::through(&scene.points).unwrap();
        let contact = Contact::new(&Flat, &body).unwrap();
        let height = |x: f64| body.at(x).y;
        let places = scene.places();
        let bodies = Bodies { tail: TAIL[0], height: &height, kappa: 1.0, places };
        let load = Control::Load(scene.load);
        let wide = || Ok(contact.solve(load)?.intervals().to_vec());
        let name = format!("{seed} {}", scene.name);
        tally.take(&name, &contact, &wide, &bodies, load, SPLINES);
    }
    tally.finish();
}

/// Without the derivative of the divisor of a narrow gap, four sets are tried in 89.
#[test]
fn few_sets_are_tried_under_the_next_load() {
    for seed in [89, 91] {
        let Measured { points, load, .. } = Measured::rough(&mut Dice::new(seed + (1 << 41)));
        let body = Spline::through(&points).unwrap();
        let (contact, mut solver) = (Contact::new(&Flat, &body).unwrap(), Solver::new());
        let tried = [load, 1.02 * load].map(|load| {
            let solution = solver.solve(&contact, Control::Load(load)).unwrap();
            solution.report().attempts().len()
        });
        println!("{seed}: {tried:?}");
        assert!(tried.into_iter().all(|tried| tried <= 3), "{seed}: {tried:?}");
    }
}

#[test]
fn measured_points_touch_as_bodies_do() {
    let mut tally = Tally::default();
    // So many kinks that the truncation of the series, or its estimate, hides overlaps; in 1203 and
    // 2839 a dip away from the lowest gap before loading; in 1514 a contact that parts where two
    // have merged.
    let by_name = [734, 1203, 1258, 1461, 1514, 2640, 2839];
    for seed in scenes(40).chain(by_name) {
        let scene = Measured::new(&mut Dice::new(seed));
        let fit = Fit { outliers: None, ..Fit::default() };
        let body = Spline::fitted(&scene.points, fit).unwrap();
        let contact = Contact::new(&Flat, &body).unwrap();
        let load = Control::Load(scene.load);
        let wide = || {
            let ends = [scene.points[0], scene.points[scene.points.len() - 1]];
            let line = |[x, y]: [f64; 2], slope: f64, on: [f64; 2]| {
                Curve::new(on, move |k| CurvePoint {
                    x: k,
                    y: y + slope * (k - x),
                    dx: 1.0,
                    dy: slope,
                })
            };
            let [left, right] = ends.map(|[x, _]| body.at(x).dy);
            let parts: Vec<Box<dyn ParametricProfile<f64>>> = vec![
                Box::new(line(ends[0], left, [-3.0, ends[0][0]])),
                Box::new(body.clone()),
                Box::new(line(ends[1], right, [ends[1][0], 3.0])),
            ];
            let body = Piecewise::with_tolerance(parts, 1e-9).unwrap();
            let contact = Contact::new(&Flat, &body)?;
            Ok(contact.solve(load)?.intervals().to_vec())
        };
        let height = |x: f64| body.at(x).y;
        let bodies = Bodies { tail: TAIL[0], height: &height, kappa: 1.0, places: scene.places() };
        let name = format!("{seed} {}", scene.name);
        tally.take(&name, &contact, &wide, &bodies, load, SPLINES);
    }
    tally.finish();
}

/// Returns the lowest height, by all places and the slope around the lowest of them.
fn first_touch(scene: &Wavy) -> f64 {
    let places = scene.places(64.0);
    let heights: Vec<f64> = places.iter().map(|&x| scene.at(x)[0]).collect();
    let lowest = heights.iter().copied().fold(f64::INFINITY, f64::min);
    let mut least = lowest;
    for i in 1..places.len() - 1 {
        let rises = [heights[i - 1] - heights[i], heights[i + 1] - heights[i]];
        if rises[0] < 0.0 || rises[1] < 0.0 || heights[i] - lowest > rises[0].max(rises[1]) {
            continue;
        }
        let [mut from, mut to] = [places[i - 1], places[i + 1]];
        for _ in 0..60 {
            let middle = 0.5 * (from + to);
            let [y, slope] = scene.at(middle);
            least = least.min(y);
            if slope < 0.0 { from = middle } else { to = middle }
        }
    }
    least
}

#[test]
fn wavy_bodies_come_nearer_by_what_is_defined() {
    let [mut worst, mut back] = [0.0f64; 2];
    let ([mut wrong, mut refused], mut not_back) = ([const { Vec::new() }; 2], Vec::new());
    let all = scenes(100);
    // Seeds by number: cells that start anew do not find the load again.
    for seed in all.clone().chain([297]) {
        let mut dice = Dice::new(seed + (1 << 40));
        let scene = Wavy::new(&mut dice);
        let ratio = dice.within(0.0, 0.5);
        let material = Material::elastic(dice.power_of_ten(-2.0, 2.0), ratio);
        let other = Material::elastic(dice.power_of_ten(-2.0, 2.0), dice.within(0.0, 0.5));
        // 1/(π M) of each.
        let share = |material: Material<f64>| match material {
            Material::Elastic { youngs_modulus, poisson_ratio } => {
                (1.0 - poisson_ratio * poisson_ratio) / (PI * youngs_modulus)
            }
            _ => 0.0,
        };
        let shares = [share(material), share(other)];
        let kappa = 0.5 / (shares[0] + shares[1]);
        let load = kappa * scene.load;
        let body = scene.body(1.0);
        let contact =
            Contact::new(&Flat, &body).unwrap().materials(material, other, PlaneState::Strain);
        let solution = match contact.solve(Control::Load(load)) {
            Ok(solution) => solution,
            Err(ContactError::Solve(SolveError::DomainTooShort { .. })) => continue,
            Err(error) => {
                refused.push(format!("{seed} {scene:?}: {error}"));
                continue;
            }
        };
        let height = |x: f64| scene.at(x)[0];
        let bodies = Bodies { tail: TAIL[0], height: &height, kappa, places: scene.places(12.0) };
        let judge = Judge::new(&bodies, &solution, load);
        let number = (dice.uniform() * judge.contacts.len() as f64) as usize;
        let angle = dice.within(0.1, 3.0);
        let x = at_angle(judge.contacts[number].on, angle);
        let wide = solution.hull().half_width();
        let mut reference = || match (3.0 * dice.uniform()) as usize {
            0 => Reference::Length(dice.power_of_ten(0.5, 2.0)),
            1 => Reference::Disc(dice.power_of_ten(0.5, 2.0)),
            _ => Reference::Depth(wide * dice.power_of_ten(0.0, 3.0)),
        };
        let references = References { x, lower: reference(), upper: reference() };
        let first = first_touch(&scene);
        let mut sum = height(x) - first;
        let mut size = sum.abs();
        let potential = judge.potential(x, Some((number, angle)));
        for ((material, share), reference) in [(material, shares[0]), (other, shares[1])]
            .into_iter()
            .zip([references.lower, references.upper])
        {
            let Material::Elastic { poisson_ratio, .. } = material else { continue };
            let integral = |f: &dyn Fn(f64) -> f64| {
                judge.contacts.iter().map(|series| series.integral(f)).sum::<f64>()
            };
            let own = match reference {
                Reference::Length(length) => 2.0 * load * length.ln(),
                Reference::Disc(radius) => 2.0 * load * ((2.0 * radius).ln() - 1.0),
                Reference::Depth(depth) => integral(&|s| {
                    let square = (x - s).powi(2) + depth * depth;
                    square.ln() - depth * depth / ((1.0 - poisson_ratio) * square)
                }),
                _ => f64::NAN,
            };
            sum += share * (own - 2.0 * potential);
            size += share * (own.abs() + (2.0 * potential).abs());
        }
        let name = format!("{seed} {scene:?} {references:?}");
        let found = match solution.approach(&references) {
            Ok(approach) => approach.bodies,
            Err(error) => {
                wrong.push(format!("{name}: {error}"));
                continue;
            }
        };
        let error = (found - sum).abs() / size;
        worst = worst.max(error);
        if error.is_nan() || error > 1e-10 {
            wrong.push(format!("{name}: {found} for {sum}, {error:e}"));
        }
        match contact.solve(Control::Approach { approach: found, references }) {
            Ok(again) => {
                let error = (again.load() / load - 1.0).abs();
                back = back.max(error);
                if error.is_nan() || error > 1e-9 {
                    wrong.push(format!("{name}: {} for {load}", again.load()));
                }
            }
            Err(error) => {
                println!("{name}: {error}");
                not_back.push(seed);
            }
        }
    }
    println!("{all:?}: {worst:.1e} of the sums, loads {back:.1e}, not found back: {not_back:?}");
    assert!(wrong.is_empty() && refused.is_empty(), "{wrong:?}\n{refused:?}");
    // The load of scene 6 is found if given, but not yet by its approach.
    assert!(not_back.iter().all(|&seed| seed == 6), "{not_back:?}");
}

#[test]
fn the_judge_knows_closed_forms_and_what_is_wrong() {
    let body = |reach: f64, y: fn(f64) -> [f64; 2]| {
        Curve::new([-reach, reach], move |x| {
            let [y, dy] = y(x);
            CurvePoint { x, y, dx: 1.0, dy }
        })
    };
    let places = even(1000);
    // P = κ/(π R) sqrt(L² - x²), by Hertz: κ and R are 1 in the solve, R is 1/2 in the closed form.
    let hertz = |x: f64| [0.5 * x * x, x];
    for half in [1e-4, 0.01, 0.5] {
        let on = Interval { left: -half, right: half };
        let series = Series::of(on, 64, &|x, p| {
            for (x, p) in x.iter().zip(p) {
                *p = 2.0 / PI * (half * half - x * x).sqrt();
            }
        });
        // ∫ P ln|x - s| ds = κ x²/(2R) + F (ln(L/2) - 1/2), F = κ L²/(2R).
        let load = half * half;
        assert!((series.load() / load - 1.0).abs() < 1e-14);
        for angle in [0.1, 1.0, 2.0, 3.0] {
            let x = at_angle(on, angle);
            let exact = x * x + load * ((half / 2.0).ln() - 0.5);
            assert!((series.inside(angle) - exact).abs() < 1e-13 * load * (1.0 + half.ln().abs()));
        }
        // Johnson, *Contact Mechanics*, 1985, Eq. 4.44.
        for xi in [1.0 + 1e-6, 1.1, 3.0, 40.0f64] {
            let root = (xi * xi - 1.0).sqrt();
            let exact = load * (xi * root - (xi + root).ln());
            let level = -load * ((half / 2.0).ln() - 0.5);
            for x in [xi * half, -xi * half] {
                let gap = x * x - series.outside(x) - level;
                assert!((gap - exact).abs() < 1e-12 * load * xi * xi, "{half} {xi}: {gap} {exact}");
            }
        }
        let parabola = body(1.0, hertz);
        let contact = Contact::new(&Flat, &parabola).unwrap();
        let solution = contact.solve(Control::Load(0.5 * load)).unwrap();
        let height = |x: f64| hertz(x)[0];
        let bodies = Bodies { tail: TAIL[0], height: &height, kappa: 1.0, places: places.clone() };
        let faults = judge(&bodies, &solution, 0.5 * load);
        assert!(!faults.is_wrong(1e-11), "{faults:?}");
    }
    // Two contacts of a quartic: closed form, solved, and as one.
    let (kappa, load) = (1.7, 0.3);
    let form = Quartic::under_load(0.3, 1.0, load, kappa).unwrap();
    let height = |x: f64| form.height(x);
    let bodies = Bodies { tail: TAIL[0], height: &height, kappa, places: places.clone() };
    let series = |on: &Interval<f64>| {
        Series::of(*on, 128, &|x, p| {
            for (x, p) in x.iter().zip(p) {
                *p = form.pressure(*x, kappa);
            }
        })
    };
    let faults = Judge::of(&bodies, form.contacts().iter().map(series).collect(), load).faults();
    assert!(form.contacts().len() == 2 && !faults.is_wrong(1e-11), "{faults:?}");
    let hills = body(1.6, |x| [0.3 * (x * x - 1.0).powi(2), 1.2 * x * (x * x - 1.0)]);
    let contact = Contact::new(&Flat, &hills).unwrap().kappa(kappa);
    let solution = contact.solve(Control::Load(load)).unwrap();
    let places: Vec<f64> = places.iter().map(|x| 1.6 * x).collect();
    let bodies = Bodies { places: places.clone(), ..bodies };
    let faults = judge(&bodies, &solution, load);
    assert!(!faults.is_wrong(1e-11), "{faults:?}");
    let start = Interval { left: -1.25, right: 1.25 };
    let one = contact.single_interval(true).start(start).solve(Control::Load(load)).unwrap();
    let faults = judge(&bodies, &one, load);
    assert!(one.intervals().len() == 1 && faults.is_wrong(1e-3), "{faults:?}");
    // A wrong load, and bumps outside and in a contact that are unknown to the solution.
    assert!(judge(&bodies, &solution, load * (1.0 + 1e-7)).is_wrong(WAVES));
    let exact = Judge::new(&bodies, &solution, load);
    let inside = solution.intervals()[0].centre();
    for at in [0.1, 1.5, inside] {
        for above in [1e-7 * load / kappa, -1e-7 * load / kappa] {
            let height = |x: f64| {
                // Gap at that place.
                let open = if at == inside { 0.0 } else { exact.gap(x).max(0.0) / kappa };
                form.height(x) - (open + above) * (-0.5 * ((x - at) / 0.01).powi(2)).exp()
            };
            let bodies = Bodies { tail: TAIL[0], height: &height, kappa, places: places.clone() };
            let faults = judge(&bodies, &solution, load);
            let is_seen = above > 0.0 || at == inside;
            assert_eq!(faults.is_wrong(WAVES), is_seen, "{at} {above}: {faults:?}");
        }
    }
}
