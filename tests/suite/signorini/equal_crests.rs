//! Rollers of one size side by side, under a flat: all of them bear the load. Joined pieces meet
//! within rounding or further off, and crests are equal to the last bit or nearly.

use super::{Bodies, Dice, TAIL, Tally, WAVES, scenes};
use crate::common::{Profile, join};
use linecontact::profile::{Ellipse, Line, Parabola, Placed, Placement};
use linecontact::{
    Contact, ContactError, Control, Curve, CurvePoint, Flat, Material, Piecewise, PlaneState,
    Solution, SolveError,
};
use std::f64::consts::PI;

/// Kind of a roller of radius 1.
#[derive(Clone, Copy, Debug)]
enum Kind {
    Circle,
    Arc,
    Parabola,
    Graph,
}

#[derive(Debug)]
struct Row {
    kind: Kind,
    /// Lowest points `[x, y]`, from left to right.
    crests: Vec<[f64; 2]>,
    load: f64,
}

impl Row {
    fn new(dice: &mut Dice) -> Self {
        let kind = [Kind::Circle, Kind::Arc, Kind::Parabola, Kind::Graph];
        let kind = kind[(4.0 * dice.uniform()) as usize];
        let count = 2 + (5.0 * dice.uniform()) as usize;
        let apart = if dice.uniform() < 0.5 { 0.0 } else { dice.power_of_ten(-15.0, -6.0) };
        let mut x = dice.within(-20.0, 20.0);
        let crest = |_| {
            x += dice.within(0.8, 1.6);
            [x, apart * (2.0 * dice.uniform()).floor()]
        };
        let crests = (0..count).map(crest).collect();
        Self { kind, crests, load: dice.power_of_ten(-5.0, -2.5) }
    }

    /// Returns the ends of a piece, from its crest.
    fn reach(&self, i: usize) -> [f64; 2] {
        let middle = |one: usize, other: usize| 0.5 * (self.crests[one][0] + self.crests[other][0]);
        let from = if i == 0 { -0.8 } else { middle(i - 1, i) - self.crests[i][0] };
        let last = self.crests.len() - 1;
        let to = if i == last { 0.8 } else { middle(i, i + 1) - self.crests[i][0] };
        [from, to]
    }

    fn piece(&self, i: usize) -> Profile {
        let ([x, y], reach) = (self.crests[i], self.reach(i));
        let to = Placement::default().shifted(x, y);
        let angles = reach.map(f64::asin);
        match self.kind {
            Kind::Circle => {
                Box::new(Placed::new(Ellipse::circle(1.0, angles).unwrap(), to).unwrap())
            }
            Kind::Parabola => {
                Box::new(Placed::new(Parabola::new(1.0, reach).unwrap(), to).unwrap())
            }
            Kind::Arc => Box::new(Curve::new(angles, move |k: f64| {
                let (sin, cos) = k.sin_cos();
                CurvePoint { x: x + sin, y: y + (1.0 - cos), dx: cos, dy: sin }
            })),
            Kind::Graph => Box::new(Curve::new(reach.map(|end| x + end), move |k: f64| {
                CurvePoint { x: k, y: y + 0.5 * (k - x).powi(2), dx: 1.0, dy: k - x }
            })),
        }
    }

    fn height(&self, x: f64) -> f64 {
        let i = (0..self.crests.len() - 1)
            .take_while(|&i| x > self.crests[i][0] + self.reach(i)[1])
            .count();
        let [at, y] = self.crests[i];
        let off = x - at;
        match self.kind {
            Kind::Circle | Kind::Arc => y + off * off / (1.0 + (1.0 - off * off).sqrt()),
            Kind::Parabola | Kind::Graph => y + 0.5 * off * off,
        }
    }
}

#[test]
fn equal_rollers_share_the_load() {
    let mut tally = Tally::default();
    for seed in scenes(100) {
        let row = Row::new(&mut Dice::new(seed));
        let parts = (0..row.crests.len()).map(|i| row.piece(i)).collect();
        let body = Piecewise::with_tolerance(parts, 1e-5).unwrap();
        let contact = Contact::new(&Flat, &body).unwrap();
        let height = |x: f64| row.height(x);
        let [from, to] = [row.crests[0][0] - 0.8, row.crests[row.crests.len() - 1][0] + 0.8];
        let share = |i: u32| from + (to - from) * f64::from(i) / 2000.0;
        let mut places: Vec<f64> = (0..=2000).map(share).collect();
        places.extend(row.crests.iter().map(|crest| crest[0]));
        places.sort_by(f64::total_cmp);
        let bodies = Bodies { tail: TAIL[0], height: &height, kappa: 1.0, places };
        // Bodies that are too short are refused at once.
        let wide = || Ok(contact.solve(Control::Load(row.load))?.intervals().to_vec());
        tally.take(&format!("{seed} {row:?}"), &contact, &wide, &bodies, row.load, WAVES);
    }
    tally.finish();
}

/// Two rollers whose arcs meet within one rounding of x, steel, N and mm: each bears half the load,
/// as Hertz has it but for the slope that the other one leaves.
#[test]
fn two_equal_rollers_bear_half_each() {
    let half = 0.8f64.asin();
    let roller = |x: f64| -> Profile {
        let circle = Ellipse::circle(10.0, [-half, half]).unwrap();
        Box::new(Placed::new(circle, Placement::default().shifted(x, 0.0)).unwrap())
    };
    let both = join(vec![roller(0.37), roller(16.37)]);
    let steel = Material::elastic(210e3, 0.3);
    let contact = Contact::new(&Flat, &both).unwrap().materials(steel, steel, PlaneState::Strain);
    for load in [0.01, 0.1, 1.0, 3.0] {
        let solution: Solution<f64> = contact.solve(Control::Load(load)).unwrap();
        let contacts = solution.contacts().unwrap();
        assert_eq!(contacts.len(), 2, "{load}");
        let modulus = 210e3 / 0.91 / 2.0;
        let hertz = (modulus * 0.5 * load / (PI * 10.0)).sqrt();
        for one in contacts {
            assert!((one.load / (0.5 * load) - 1.0).abs() < 1e-9, "{load}: {}", one.load);
            let peak = one.peak.unwrap().pressure;
            assert!((peak / hertz - 1.0).abs() < 1e-5, "{load}: {peak} for {hertz}");
        }
    }
}

/// Two equal ridges: the kink is where the other one would overlap, and its two slopes say nothing
/// against that. One of them alone never passes.
#[test]
fn two_equal_ridges_are_never_one() {
    let line = |slope: f64, from: f64, height: f64| -> Profile {
        let line = Line::new(slope, [0.0, 1.0]).unwrap();
        Box::new(Placed::new(line, Placement::default().shifted(from, height)).unwrap())
    };
    let ridges = join(vec![
        line(-0.005, -2.0, 0.005),
        line(1.0, -1.0, 0.0),
        line(-1.0, 0.0, 1.0),
        line(0.005, 1.0, 0.0),
    ]);
    let contact = Contact::new(&Flat, &ridges).unwrap().contact_modulus(1e5);
    for load in [0.1, 1.0, 10.0, 100.0] {
        match contact.solve(Control::Load(load)) {
            Ok(solution) => assert_eq!(solution.intervals().len(), 2, "{load}"),
            Err(error) => assert!(
                matches!(error, ContactError::Solve(SolveError::Overlap { x, .. }) if x == 1.0),
                "{load}: {error}"
            ),
        }
    }
}
