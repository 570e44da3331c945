//! Pads as they are drawn: a land, a lug lower than it by some micrometres, and a crown. Gaps
//! between land and lug close from a hollow corner, with a convex one near by.

use super::inner_corners::unlike;
use super::{Dice, scenes};
use crate::boundary_elements::solve;
use linecontact::profile::Outline;
use linecontact::{Contact, Control, Flat, Interval};

/// Slope at which the crown begins, and its length.
const RISE: f64 = 0.005;
const CROWN: f64 = 0.8;

/// Least width of a gap that boundary elements show, as a share of the land.
const NARROW: f64 = 5e-3;

/// Right half of a pad: lengths in mm.
#[derive(Clone, Copy, Debug)]
struct Pad {
    land: f64,
    slope: f64,
    lug: f64,
    radius: f64,
    /// F/κ.
    load: f64,
}

impl Pad {
    fn new(dice: &mut Dice) -> Self {
        let land = dice.power_of_ten(-1.3, -0.5);
        let slope = -dice.power_of_ten(-2.5, -1.5);
        let (lug, radius) = (dice.power_of_ten(-2.3, -1.3), dice.power_of_ten(1.0, 2.3));
        Self { land, slope, lug, radius, load: dice.power_of_ten(-4.5, -2.4) }
    }

    fn height(&self, x: f64) -> f64 {
        let (x, tip) = (x.abs(), self.land + self.lug);
        if x <= tip {
            return self.slope * (x - self.land).max(0.0);
        }
        let angle = RISE.atan();
        let (aside, above) = (x - tip + self.radius * angle.sin(), self.radius * angle.cos());
        self.slope * self.lug + above - (self.radius * self.radius - aside * aside).sqrt()
    }
}

/// At 200 N/mm three contacts were found, and made one: the limits on both sides of a gap were put
/// at the tip of the lug, which held neither.
#[test]
fn a_lug_beside_a_land_parts_from_it() {
    let drawn =
        Pad { land: 0.13, slope: -0.01, lug: 0.0156, radius: 50.0, load: 200.0 / 181_250.0 };
    let random = scenes(20).map(|seed| (seed.to_string(), Pad::new(&mut Dice::new(seed))));
    let (mut judged, mut faults) = (0, Vec::new());
    for (name, pad) in [("drawn".to_owned(), drawn)].into_iter().chain(random) {
        let Pad { land, slope, lug, radius, load } = pad;
        let outline = Outline::from([0.0, 0.0]).line(land).corner(slope).line(lug);
        let body = outline.corner(RISE).arc(radius, CROWN).mirrored().build().unwrap();
        let contact = Contact::new(&Flat, &body).unwrap().kappa(1.0);
        let solution = match contact.solve(Control::Load(load)) {
            Ok(solution) => solution,
            Err(error) => {
                faults.push(format!("{name} {pad:?}: {error}"));
                continue;
            }
        };
        // No cell is as narrow as a gap that has all but closed in its hollow corner.
        let is_seen = |on: &[Interval<f64>]| on[1].left - on[0].right > NARROW * land;
        if !solution.intervals().windows(2).all(is_seen) {
            continue;
        }
        let kinks = [-land - lug, -land, land, land + lug];
        let end = land + lug + CROWN;
        let oracle = solve(&|x| pad.height(x), 1.0, load, [-end, end], &kinks);
        if let Some(oracle) = oracle {
            judged += 1;
            faults
                .extend(unlike(&oracle, &solution).map(|fault| format!("{name} {pad:?}: {fault}")));
        }
    }
    println!("{judged} judged");
    assert!(judged > 0 && faults.is_empty(), "{}: {}", faults.len(), faults.join("\n"));
}

/// A limit that has just reached a corner at which the slope rises by 0.02 only: whole steps of
/// Newton's method lead from one side of it to the other, which left 28 of 400 loads without a
/// solution.
#[test]
fn a_limit_at_a_weak_corner_is_found() {
    let right = Outline::from([0.0, 0.0]).arc(14.403_510_136_170_25, 0.093_210_783_080_597_44);
    let right = right.corner(-0.5).fillet(0.003_213_625_642_476_981);
    let right = right.arc(5.385_349_648_496_586, 0.051_324_132_182_147_39).corner(0.05);
    let left = Outline::from([0.0, 0.0]).arc(6.323_983_945_854_503, 0.5).corner(0.1).line(0.5);
    let body = right.arc(5.0, 0.8).left(left).build().unwrap();
    let contact = Contact::new(&Flat, &body).unwrap().contact_modulus(1.0);
    let mut before = -0.4;
    for i in 0..40 {
        let load = 0.0392 + 1e-5 * f64::from(i);
        let solution = contact.solve(Control::Load(load)).unwrap_or_else(|error| {
            panic!("{load}: {error}");
        });
        let limit = solution.hull().left;
        assert!(limit < before && solution.limits_error() < Some(1e-8), "{load}: {solution}");
        before = limit;
    }
}
