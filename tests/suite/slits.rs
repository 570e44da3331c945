//! Lands with slits between them, and planes with scratches, under rollers: narrow ones, and many.
#![allow(missing_docs)]

use crate::common::Shares;
use linecontact::profile::{Ellipse, Outline, Placed, Placement};
use linecontact::{
    Attempt, Contact, ContactError, Control, Flat, Outcome, SolveError, Solver, Start,
};

/// Lands or a plane, with grooves between flat parts, and a roller.
#[derive(Debug)]
struct Scene {
    /// Widths of the flat parts, and their heights.
    lands: Vec<[f64; 2]>,
    /// Between them: the width at the bottom, the depth below the deeper side, and the slope.
    grooves: Vec<[f64; 3]>,
    radius: f64,
    place: f64,
    load: f64,
    /// Distance of the load from the place of the roller, if the bodies turn.
    aside: Option<f64>,
}

impl Scene {
    fn new(random: &mut Shares, is_scratched: bool) -> Self {
        let count = random.between(2.0, if is_scratched { 12.0 } else { 6.0 }) as usize;
        let wear = random.power_of_ten(-8.0, -3.5);
        let worn = random.between(0.0, 1.0) < 0.5;
        let land = |random: &mut Shares| {
            let height = if worn && random.between(0.0, 1.0) < 0.5 {
                wear * random.between(0.0, 1.0)
            } else {
                0.0
            };
            [random.power_of_ten(-1.0, 0.3), if is_scratched { 0.0 } else { height }]
        };
        let lands: Vec<[f64; 2]> = (0..count).map(|_| land(random)).collect();
        let all: f64 = lands.iter().map(|land| land[0]).sum();
        let depth = random.power_of_ten(-3.0, 0.0);
        let grooves = (1..count).map(|_| match is_scratched {
            true => {
                let [bottom, run] =
                    [0, 1].map(|_| all / count as f64 * random.power_of_ten(-3.0, -0.5));
                let slope = random.power_of_ten(-4.0, 1.5);
                [bottom, run * slope, slope]
            }
            false => [random.power_of_ten(-5.0, -1.0), depth, 1e6],
        });
        let grooves = grooves.collect();
        let radius = all * random.power_of_ten(1.0, 3.0);
        let place = all * random.between(0.2, 0.8);
        let half_width = 0.5 * all * random.power_of_ten(-1.5, -0.1);
        let load = half_width * half_width * std::f64::consts::FRAC_PI_2 / (2.0 * radius);
        let aside =
            (random.between(0.0, 1.0) < 0.25).then(|| half_width * random.between(-0.1, 0.1));
        Self { lands, grooves, radius, place, load, aside }
    }

    fn outline(&self) -> Outline<f64> {
        let mut drawn = Outline::from([0.0, -self.lands[0][1]]).line(self.lands[0][0]);
        for (i, &[bottom, depth, slope]) in self.grooves.iter().enumerate() {
            let [from, to] = [self.lands[i][1], self.lands[i + 1][1]];
            let lowest = from.max(to) + depth;
            drawn = drawn.corner(-slope).line((lowest - from) / slope).corner(0.0).line(bottom);
            drawn = drawn
                .corner(slope)
                .line((lowest - to) / slope)
                .corner(0.0)
                .line(self.lands[i + 1][0]);
        }
        drawn
    }
}

/// Solves and certifies a hundred random scenes and some more, or as many as `SCENES` in the
/// environment says.
fn check(is_scratched: bool, more: &[u64]) {
    let scenes = std::env::var("SCENES").ok().map(|count| count.parse().unwrap());
    let seeds: Vec<u64> = match scenes {
        Some(count) => (0..count).collect(),
        None => (0..100).chain(more.iter().copied()).collect(),
    };
    let (mut solved, mut faults) = (0, Vec::new());
    for &seed in &seeds {
        let mut random = Shares(seed);
        random.between(0.0, 1.0);
        let scene = Scene::new(&mut random, is_scratched);
        let Ok(body) = scene.outline().build() else { continue };
        let reach = 0.9f64.min(6.0 * scene.place / scene.radius);
        let roller = Ellipse::circle(scene.radius, [-reach, reach]).unwrap();
        let roller = Placed::new(roller, Placement::default().shifted(scene.place, 0.0)).unwrap();
        let contact = Contact::new(&body, &roller).unwrap().kappa(1.0);
        let Scene { load, place, .. } = scene;
        let control = match scene.aside {
            Some(aside) => Control::CentreOfPressure { load, at: place + aside },
            None => Control::Load(load),
        };
        match contact.solve(control) {
            Ok(solution) => {
                solved += 1;
                if let Err(error) = solution.certify() {
                    faults.push(format!("{seed} {scene:?}: {solution}: {error}"));
                }
            }
            Err(ContactError::Solve(
                SolveError::DomainTooShort { .. } | SolveError::TiltNotFound { .. },
            )) => {}
            Err(error) => faults.push(format!("{seed} {scene:?}: {error}")),
        }
    }
    println!("{solved} of {} solved, {} faults", seeds.len(), faults.len());
    assert!(faults.is_empty() && 5 * solved > 4 * seeds.len(), "{}", faults.join("\n"));
}

/// Cells see no slit that is narrower than they are; next to one a worn land may be left within
/// less than its hundredth.
#[test]
fn lands_with_slits() {
    check(false, &[109, 121]);
}

/// At the foot of a shallow scratch the gap is as narrow as rounding, or ends on its wall.
#[test]
fn planes_with_scratches() {
    check(true, &[549, 570]);
}

/// A crown of radius R on either side of a groove with upright walls: each of the two contacts is
/// held at its wall, and under a load F of its own is `w = sqrt(8 F R/(3 κ))` wide where that is
/// far less than the groove. The wall's slope tells nothing of the crown's height, nor does the
/// floor of the groove.
#[test]
fn light_loads_beside_upright_walls() {
    for (groove, depth) in [(1.0, 0.5), (5.0, 0.5), (0.2, 1e-3)] {
        let half = Outline::from([0.0, depth]).line(groove).wall(-depth).arc(100.0, 30.0);
        let body = half.mirrored().build().unwrap();
        let contact = Contact::new(&Flat, &body).unwrap().kappa(1.0);
        for power in 6..=14 {
            let load = 10f64.powi(-power);
            let due = (8.0 * 0.5 * load * 100.0 / 3.0).sqrt();
            if due > 0.02 * groove {
                continue;
            }
            let solution = contact.solve(Control::Load(load));
            let solution = solution.unwrap_or_else(|error| panic!("{groove} {load}: {error}"));
            let &[one, other] = solution.intervals() else { panic!("{groove} {load}: {solution}") };
            for on in [one, other] {
                let width = 2.0 * on.half_width();
                let rounding = 4.0 * f64::EPSILON * groove / due;
                assert!(
                    (width / due - 1.0).abs() < 0.5 * due / groove + rounding,
                    "{load}: {on:?}"
                );
            }
        }
    }
}

/// Of two lands of unequal height one touches, held at its wall: for the next load it is a start as
/// it is, and nothing else is tried.
#[test]
fn a_land_held_at_its_wall_is_the_start_of_the_next_load() {
    let half =
        |depth: f64| Outline::from([0.0, 0.3]).line(0.5).wall(-depth).line(1.0).arc(50.0, 3.0);
    let body = half(0.3).left(half(0.25)).build().unwrap();
    let contact = Contact::new(&Flat, &body).unwrap().kappa(1.0);
    let mut solver = Solver::new();
    solver.solve(&contact, Control::Load(5e-3)).unwrap();
    for load in [5.5e-3, 6e-3, 7e-3] {
        let due = contact.solve(Control::Load(load)).unwrap().hull();
        let next = solver.solve(&contact, Control::Load(load)).unwrap();
        let (from, outcome) = (Start::Last, Outcome::Passed);
        assert_eq!(next.report().attempts(), [Attempt { start: from, outcome }], "{load}");
        assert!((next.hull().right - due.right).abs() < 1e-12 && next.hull().left == due.left);
    }
}
