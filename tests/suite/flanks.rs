//! Flanks of gear teeth, as given by users: involutes by formulas that cancel, so that X is noisy,
//! and loads beyond the capacity of a flank. A contact this narrow is Hertz's to a share (a/ρ)².
#![allow(missing_docs)]

use crate::common::{Counting, Profile, Strategy};
use crate::random_scenes::Dice;
use linecontact::profile::{Involute, Placed, Placement};
use linecontact::search::SearchError;
use linecontact::{
    Body, Contact, ContactError, Control, Curve, CurvePoint, Flat, Interval, SolveError,
};
use std::sync::atomic::{AtomicUsize, Ordering};

/// Least count of evaluations under half the load that others are compared with.
const LEAST_TAKEN: usize = 124;

/// Flank of a base circle of this radius that touches at the roll angle `at`.
#[derive(Clone, Copy, Debug)]
struct Flank {
    radius: f64,
    at: f64,
    angles: [f64; 2],
}

impl Flank {
    /// Returns the radius of curvature at the point of touch.
    fn curvature_radius(&self) -> f64 {
        self.radius * self.at
    }

    fn exact(&self, upper: bool) -> Profile {
        let involute = Involute::new(self.radius, self.at, self.angles).unwrap();
        let turned = Placement::default().mirrored().flipped();
        if upper { Box::new(involute) } else { Box::new(Placed::new(involute, turned).unwrap()) }
    }

    /// Returns the flank with X from coordinates about the distant centre of the circle; Y has the
    /// same noise, or none.
    fn noisy(&self, upper: bool, centre: f64, in_y: bool) -> Profile {
        let (Self { radius: r, at, angles }, exact) = (*self, self.exact(upper));
        let (sin, cos) = at.sin_cos();
        let sign = if upper { 1.0 } else { -1.0 };
        Box::new(Curve::new(angles, move |t: f64| {
            let [u, v] = [r * (t.sin() - t * t.cos()), r * (t.cos() + t * t.sin())];
            let x = (sin * u + cos * v + centre) - (centre + r);
            let y = (cos * u - sin * v + centre) - (centre - r * at);
            let point = exact.at(t - at);
            CurvePoint { x: sign * x, y: if in_y { sign * y } else { point.y }, ..point }
        }))
    }
}

/// Returns a pair of flanks, or one on a flat: the bodies, the radius of curvature of the gap, and
/// the length over which the radius changes.
fn pair(dice: &mut Dice, in_y: bool) -> ([Profile; 2], f64, f64) {
    let mut flank = || {
        let (radius, at) = (dice.power_of_ten(1.3, 2.0), dice.power_of_ten(-1.7, -0.2));
        let long = at * dice.power_of_ten(-1.0, 0.0);
        Flank { radius, at, angles: [at - long, at + long] }
    };
    let [upper, lower] = [flank(), flank()];
    let centre = dice.power_of_ten(0.0, 2.5);
    let length = |flank: Flank| flank.curvature_radius() * flank.at;
    let upper_body = upper.noisy(true, centre, in_y);
    if dice.uniform() < 0.3 {
        return ([Box::new(Flat), upper_body], upper.curvature_radius(), length(upper));
    }
    let sum = 1.0 / upper.curvature_radius() + 1.0 / lower.curvature_radius();
    let bodies = [lower.noisy(false, centre, in_y), upper_body];
    (bodies, 1.0 / sum, length(upper).min(length(lower)))
}

/// Solves and certifies random flanks; `SCENES=n` in the environment sets their number.
fn solve_and_certify(in_y: bool) {
    let scenes = std::env::var("SCENES").map_or(300, |n| n.parse().unwrap());
    let (mut refused, mut wrong) = (Vec::new(), Vec::new());
    // Besides any seeds, one whose X falls by noise within narrow panels.
    for seed in (0..scenes).chain([333]) {
        let mut dice = Dice::new(seed);
        let ([lower, upper], radius, length) = pair(&mut dice, in_y);
        let half_width = dice.power_of_ten(-7.0, -3.5);
        let load = half_width * half_width / (2.0 * radius);
        let contact = Contact::new(&*lower, &*upper).unwrap();
        let found = contact.solve(Control::Load(load)).and_then(|solution| {
            let share = half_width / length;
            let error = (solution.hull().half_width() / half_width - 1.0).abs();
            if error > 2.0 * solution.limits_error().unwrap() + share * share {
                wrong.push((seed, error, solution.limits_error()));
            }
            solution.certify()
        });
        refused.extend(found.err().map(|error| (seed, error)));
    }
    println!("{} of {scenes} refused, {} wrong", refused.len(), wrong.len());
    assert!(refused.is_empty(), "{}: {:?}", refused[0].0, refused[0].1);
    assert!(wrong.is_empty(), "{:?}", wrong[0]);
}

#[test]
fn random_flanks_with_noise_in_x_are_solved_and_certified() {
    solve_and_certify(false);
}

/// Contacts no deeper than the noise of the heights.
#[test]
fn random_flanks_with_noise_in_x_and_y_are_solved_and_certified() {
    solve_and_certify(true);
}

/// Noise in X does not excuse a search that stops early.
#[test]
fn a_strategy_that_stops_in_the_middle_is_refused_beside_noise() {
    let middle = Strategy(|f, b| Strategy::take(0.5 * b.lo + 0.5 * b.hi, f, b));
    let flank = Flank { radius: 47.0, at: 0.03, angles: [0.0, 0.9] };
    let body = flank.noisy(true, 90.0, false);
    // With a given start, no heights are known that would locate the points without the search.
    let start = Interval { left: -3e-6, right: 3e-6 };
    let contact = Contact::new(&Flat, &*body).unwrap().inversion(&middle).start(start);
    let error = contact.solve(Control::Load(1e-12)).map(|_| ()).unwrap_err();
    let source = SearchError::NotConverged { x: 0.0, residual: 0.0 };
    let same =
        |other: &SearchError<f64>| std::mem::discriminant(other) == std::mem::discriminant(&source);
    assert!(
        matches!(&error, ContactError::Solve(SolveError::Inversion { body: Body::Upper, source, .. }) if same(source)),
        "{error}"
    );
}

/// Overloads a flank that has one end 1.5 half-widths from the point of touch. Checks the capacity
/// and returns the cost of the error, relative to a solve at half the capacity.
fn overloaded(dice: &mut Dice, radius: f64, noisy: bool, times: f64) -> Result<f64, String> {
    let at = dice.power_of_ten(-1.7, -0.2);
    let half_width = radius * at * dice.power_of_ten(if noisy { -6.0 } else { -7.0 }, -2.0);
    let (reach, long) = (1.5 * half_width / (radius * at), at * dice.within(0.3, 1.0));
    let to_left = dice.uniform() < 0.5;
    let angles = if to_left { [at - reach.min(at), at + long] } else { [at - long, at + reach] };
    let flank = Flank { radius, at, angles };
    let body = if noisy { flank.noisy(true, 90.0, false) } else { flank.exact(true) };
    let count = AtomicUsize::new(0);
    let body = Counting(body, &count);
    let contact = Contact::new(&Flat, &body).unwrap();
    let bears = 2.25 * half_width * half_width / (2.0 * radius * at);
    let half = contact.solve(Control::Load(0.5 * bears)).map_err(|error| error.to_string())?;
    let taken = half.cost().evaluations + half.cost().heights;
    count.store(0, Ordering::Relaxed);
    match contact.solve(Control::Load(times * bears)).map(|_| ()) {
        Err(ContactError::Solve(SolveError::DomainTooShort { carried, .. })) => {
            let share = half_width / (radius * at * at);
            if (carried / bears - 1.0).abs() > 10.0 * share + 1e-6 {
                return Err(format!("{flank:?} bears {carried:e}, not {bears:e}"));
            }
        }
        other => return Err(format!("{flank:?}: {other:?}")),
    }
    // Half the load costs almost nothing if the gap is soon proved convex.
    Ok(count.load(Ordering::Relaxed) as f64 / taken.max(LEAST_TAKEN) as f64)
}

#[test]
fn random_flanks_loaded_beyond_their_end_are_refused_at_once() {
    let (mut worst, mut faults) = (0.0f64, Vec::new());
    for seed in 0..150 {
        for times in [3.0, 1000.0] {
            for noisy in [false, true] {
                match overloaded(&mut Dice::new(seed), 47.0, noisy, times) {
                    // Panels of noisy bodies are split before the noise is measured.
                    Ok(ratio) if ratio <= if noisy { 60.0 } else { 20.0 } => {
                        worst = worst.max(ratio);
                    }
                    Ok(ratio) => faults.push(format!("{seed} {noisy}: {ratio} times")),
                    Err(fault) => faults.push(format!("{seed} {noisy}: {fault}")),
                }
            }
        }
    }
    println!("{worst} times the evaluations of half the load, {} faults", faults.len());
    assert!(faults.is_empty(), "{} as {}", faults.len(), faults[0]);
}
