//! Rollers, teeth and ridges of one size side by side, on a plane: all of them bear the load.
//! Joined pieces meet within rounding or further off, and crests are equal to the last bit or
//! nearly.

use super::{Bodies, Dice, SPLINES, TAIL, Tally, WAVES, scenes};
use crate::boundary_elements::height;
use crate::common::{Profile, join, pieces};
use linecontact::profile::{Ellipse, Fit, Line, Parabola, Placed, Placement, Spline};
use linecontact::{
    Contact, Control, Curve, CurvePoint, Flat, Material, Piecewise, PlaneState, Solution,
};
use std::f64::consts::PI;

/// Allowed error of the potential at a sharp crest, as a share of the load, and tail of the series
/// of the judge: it converges slowly at the logarithm of the pressure.
const SHARP: [f64; 2] = [0.1, 5e-5];

/// Crest around its lowest point.
#[derive(Clone, Copy, Debug)]
enum Crest {
    /// Circle of radius 1.
    Round,
    Parabola,
    /// Arc of a radius between two flanks of a slope.
    Tooth {
        radius: f64,
        slope: f64,
    },
    /// Two flanks, with their slopes away from the crest.
    Ridge([f64; 2]),
    /// Spline through points of a parabola.
    Spline,
}

impl Crest {
    fn new(dice: &mut Dice) -> Self {
        match (5.0 * dice.uniform()) as usize {
            0 => Self::Round,
            1 => Self::Parabola,
            2 => Self::Tooth {
                radius: dice.power_of_ten(-2.0, -0.5),
                slope: dice.power_of_ten(-1.0, 0.2),
            },
            3 => Self::Ridge([0; 2].map(|_| dice.power_of_ten(-2.3, 0.0))),
            _ => Self::Spline,
        }
    }

    /// Returns the places where a smooth piece ends and the next begins.
    fn cuts(&self) -> Vec<f64> {
        match *self {
            Self::Tooth { radius, slope } => {
                let half = radius * slope / slope.hypot(1.0);
                vec![-half, half]
            }
            Self::Ridge(_) => vec![0.0],
            _ => vec![],
        }
    }

    /// Returns the piece between two places, as a shape or as a closure.
    fn piece(&self, is_shape: bool, [from, to]: [f64; 2]) -> Profile {
        let arc = |radius: f64| -> Profile {
            let angles = [from, to].map(|x| (x / radius).asin());
            if is_shape {
                return Box::new(Ellipse::circle(radius, angles).unwrap());
            }
            Box::new(Curve::new(angles, move |k: f64| {
                let (sin, cos) = k.sin_cos();
                let [x, y] = [radius * sin, radius * (1.0 - cos)];
                CurvePoint { x, y, dx: radius * cos, dy: radius * sin }
            }))
        };
        let line = |slope: f64, y: f64| -> Profile {
            if is_shape {
                let line = Line::new(slope, [from, to]).unwrap();
                return Box::new(Placed::new(line, Placement::default().shifted(0.0, y)).unwrap());
            }
            Box::new(Curve::new([from, to], move |x: f64| CurvePoint {
                x,
                y: y + slope * x,
                dx: 1.0,
                dy: slope,
            }))
        };
        match *self {
            Self::Round => arc(1.0),
            Self::Parabola if is_shape => Box::new(Parabola::new(1.0, [from, to]).unwrap()),
            Self::Parabola | Self::Spline => Box::new(Curve::new([from, to], |x: f64| {
                CurvePoint { x, y: 0.5 * x * x, dx: 1.0, dy: x }
            })),
            Self::Tooth { radius, slope } => {
                let below = radius * (1.0 - slope.hypot(1.0));
                match 0.5 * (from + to) {
                    x if x < -radius * slope / slope.hypot(1.0) => line(-slope, below),
                    x if x > radius * slope / slope.hypot(1.0) => line(slope, below),
                    _ => arc(radius),
                }
            }
            Self::Ridge([left, right]) => line(if from + to < 0.0 { -left } else { right }, 0.0),
        }
    }
}

#[derive(Debug)]
struct Row {
    crest: Crest,
    is_shape: bool,
    /// Lowest points `[x, y]`, from left to right.
    crests: Vec<[f64; 2]>,
    is_mirrored: bool,
    /// The row is the lower body.
    is_below: bool,
    /// Angle by which both bodies are turned.
    angle: f64,
    load: f64,
    /// Place where the load acts, as a share of the way from the first crest to the last, if the
    /// bodies turn.
    at: Option<f64>,
}

impl Row {
    fn new(dice: &mut Dice) -> Self {
        let crest = Crest::new(dice);
        let count = 2 + (5.0 * dice.uniform()) as usize;
        let apart = if dice.uniform() < 0.5 { 0.0 } else { dice.power_of_ten(-15.0, -6.0) };
        let mut x = dice.within(-20.0, 20.0);
        let next = |_| {
            x += dice.within(0.8, 1.6);
            [x, apart * (2.0 * dice.uniform()).floor()]
        };
        let crests = (0..count).map(next).collect();
        let [is_shape, is_mirrored, is_below, is_turned] = [0; 4].map(|_| dice.uniform() < 0.5);
        let angle = if is_turned { dice.within(-0.3, 0.3) } else { 0.0 };
        let load = dice.power_of_ten(-5.0, -2.5);
        let at = (dice.uniform() < 0.3).then(|| dice.within(0.1, 0.9));
        Self { crest, is_shape, crests, is_mirrored, is_below, angle, load, at }
    }

    /// Returns the ends of a crest, from its lowest point.
    fn reach(&self, i: usize) -> [f64; 2] {
        // Flanks of one height meet nearer to the steeper one.
        let share = match self.crest {
            Crest::Ridge([left, right]) => left / (left + right),
            _ => 0.5,
        };
        let (x, last) = (self.crests[i][0], self.crests.len() - 1);
        let from = if i == 0 { -0.8 } else { (share - 1.0) * (x - self.crests[i - 1][0]) };
        let to = if i == last { 0.8 } else { share * (self.crests[i + 1][0] - x) };
        [from, to]
    }

    /// Returns the pieces of one crest, in its place.
    fn pieces(&self, i: usize) -> impl Iterator<Item = Profile> {
        let ([from, to], [x, y]) = (self.reach(i), self.crests[i]);
        let places: Vec<f64> = std::iter::once(from).chain(self.crest.cuts()).chain([to]).collect();
        let pairs = (1..places.len()).map(move |i| [places[i - 1], places[i]]);
        pairs.map(move |ends| {
            let piece = self.crest.piece(self.is_shape, ends);
            Box::new(Placed::new(piece, Placement::default().shifted(x, y)).unwrap()) as Profile
        })
    }

    /// Returns points of the parabolas, alike around each crest, and where two of them meet.
    fn points(&self) -> Vec<[f64; 2]> {
        let around = |i: usize| {
            let ([x, y], ends) = (self.crests[i], self.reach(i));
            let inner = (-7..=7).map(|j| 0.05 * f64::from(j));
            let after = inner.chain([ends[1]]);
            let first = (i == 0).then_some(ends[0]);
            first.into_iter().chain(after).map(move |off| [x + off, y + 0.5 * off * off])
        };
        (0..self.crests.len()).flat_map(around).collect()
    }

    fn placement(&self) -> Placement<f64> {
        let to = Placement::default();
        let to = if self.is_mirrored { to.mirrored() } else { to };
        let to = if self.is_below { to.flipped() } else { to };
        to.rotated(self.angle)
    }

    /// Returns the lower body and the upper one.
    fn bodies(&self) -> [Profile; 2] {
        let row: Profile = match self.crest {
            Crest::Spline => {
                // Where two parabolas meet, the points have a corner.
                let fit = Fit { outliers: None, ..Fit::default() };
                let row = Spline::fitted(&self.points(), fit).unwrap();
                if self.angle == 0.0 && !self.is_mirrored && !self.is_below {
                    Box::new(row)
                } else {
                    Box::new(row.placed(self.placement()).unwrap())
                }
            }
            _ => {
                let parts = (0..self.crests.len()).flat_map(|i| self.pieces(i)).collect();
                let row = Piecewise::with_tolerance(parts, 1e-3).unwrap();
                Box::new(row.placed(self.placement()).unwrap())
            }
        };
        let flat: Profile = match self.angle {
            0.0 => Box::new(Flat),
            angle => Box::new(Line::new(angle.tan(), [-100.0, 100.0]).unwrap()),
        };
        if self.is_below { [row, flat] } else { [flat, row] }
    }

    /// Returns the abscissa of a point of the row in its place.
    fn placed(&self, [x, y]: [f64; 2]) -> f64 {
        let x = if self.is_mirrored { -x } else { x };
        let y = if self.is_below { -y } else { y };
        self.angle.cos() * x - self.angle.sin() * y
    }

    fn control(&self) -> Control<f64> {
        let load = self.load;
        let [first, last] = [0, self.crests.len() - 1].map(|i| self.placed(self.crests[i]));
        match self.at {
            Some(share) => Control::CentreOfPressure { load, at: first + share * (last - first) },
            None => Control::Load(load),
        }
    }
}

#[test]
fn equal_crests_share_the_load() {
    let mut tally = Tally::default();
    // By number: a place of the series of the pressure next to a crest.
    for seed in scenes(100).chain([394, 3413]) {
        let row = Row::new(&mut Dice::new(seed));
        let [lower, upper] = row.bodies();
        let contact = Contact::new(&*lower, &*upper).unwrap();
        let height = |x: f64| height(&*upper, x) - height(&*lower, x);
        let pieces = pieces(if row.is_below { &*lower } else { &*upper });
        let [from, to] = [pieces[0].x()[0], pieces[pieces.len() - 1].x()[1]];
        let share = |i: u32| from + (to - from) * f64::from(i) / 2000.0;
        let mut places: Vec<f64> = (0..=2000).map(share).collect();
        places.extend(row.crests.iter().map(|&crest| row.placed(crest)));
        places.sort_by(f64::total_cmp);
        let [allowed, tail] = match row.crest {
            Crest::Ridge(_) => SHARP,
            Crest::Spline => [SPLINES, TAIL[1]],
            Crest::Tooth { .. } => [1e-4, 1e-6],
            _ => [WAVES, TAIL[0]],
        };
        let bodies = Bodies { tail, height: &height, kappa: 1.0, places };
        // Bodies that are too short are refused at once.
        let wide = || Ok(contact.solve(row.control())?.intervals().to_vec());
        tally.take(&format!("{seed} {row:?}"), &contact, &wide, &bodies, row.control(), allowed);
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

/// Two equal ridges whose crests are corners inside the body: both bear the load. One of
/// them alone passed before.
#[test]
fn two_equal_ridges_bear_half_each() {
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
        let solution = contact.solve(Control::Load(load)).unwrap();
        let contacts = solution.contacts().unwrap();
        assert_eq!(contacts.len(), 2, "{load}");
        for one in &contacts {
            assert!((one.load / (0.5 * load) - 1.0).abs() < 1e-7, "{load}: {}", one.load);
        }
        // A wedge, less the slope that the other one leaves: an angle φ of the wall bears as much
        // as the rest, and F = (κ L/π) (1 + m) sin φ.
        let half = 0.5 * load / (0.5 * PI * 1e5);
        let slope = 0.005 - 0.5 * half;
        let wide = 2.0 * PI * half / ((1.0 + slope) * (PI * slope / (1.0 + slope)).sin());
        for limit in [solution.b(), solution.a()].iter().filter(|_| load < 100.0) {
            assert!(((limit - 1.0) / wide - 1.0).abs() < 1e-4, "{load}: {limit} for {wide}");
        }
    }
}
