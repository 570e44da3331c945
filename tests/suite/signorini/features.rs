//! Narrow bumps and dents in a contact, at its limits and beside it, on curves of several maps.
//! The oracle is the same body with declared joints at the feature, which resolve it with any
//! nodes; and where both differ, the conditions of contact.

use super::{Bodies, Dice, TAIL, apart, judge, scenes};
use crate::common::{Profile, join};
use crate::resolution::hertz_gap;
use linecontact::{Contact, Control, Curve, CurvePoint, Flat, Solution};
use std::f64::consts::LN_2;

/// Largest change of the peak, and share of the contacts, that counts as right.
const RIGHT: f64 = 0.01;

/// Curve X(k) of a body of radius 1 at its lowest point.
#[derive(Clone, Copy, Debug)]
enum Map {
    Plain,
    Sine,
    HyperbolicSine,
    Rational,
}

impl Map {
    /// Returns X and its rate.
    fn x(self, k: f64) -> [f64; 2] {
        match self {
            Self::Plain => [k, 1.0],
            Self::Sine => [k.sin(), k.cos()],
            Self::HyperbolicSine => [k.sinh(), k.cosh()],
            Self::Rational => [k / (1.0 - 0.2 * k), (1.0 - 0.2 * k).powi(-2)],
        }
    }

    fn k(self, x: f64) -> f64 {
        match self {
            Self::Plain => x,
            Self::Sine => x.asin(),
            Self::HyperbolicSine => x.asinh(),
            Self::Rational => x / (1.0 + 0.2 * x),
        }
    }

    /// Returns height and slope: of a circle, a hyperbola, or parabolas.
    fn y(self, x: f64) -> [f64; 2] {
        let root = |sum: f64| [x * x / (1.0 + sum.sqrt()), x / sum.sqrt()];
        match self {
            Self::Sine => root(1.0 - x * x),
            Self::HyperbolicSine => root(1.0 + x * x),
            Self::Plain | Self::Rational => [0.5 * x * x, x],
        }
    }
}

/// Bump of a place, a width and a height, or a dent if the height is negative. The width is that
/// at half height of a Gaussian, or that from end to end of `(1 - s²)³`.
#[derive(Clone, Copy, Debug)]
struct Feature {
    is_compact: bool,
    at: f64,
    width: f64,
    height: f64,
}

impl Feature {
    fn y(&self, x: f64) -> [f64; 2] {
        let s = 2.0 * (x - self.at) / self.width;
        let [y, dy] = if self.is_compact {
            let rest = (1.0 - s * s).max(0.0);
            [rest.powi(3), -6.0 * s * rest * rest]
        } else {
            let y = (-LN_2 * s * s).exp();
            [y, -2.0 * LN_2 * s * y]
        };
        [self.height * y, 2.0 * self.height * dy / self.width]
    }
}

/// Body on a flat, between two parameters.
#[derive(Clone, Debug)]
struct Scene {
    map: Map,
    ends: [f64; 2],
    feature: Feature,
    load: f64,
}

impl Scene {
    /// Returns a scene whose feature has 2 to 8 % of the contact, or 12 to 30 % if it is compact,
    /// from a half-width on the left of the contact to one on its right; or a narrow one beside.
    fn new(dice: &mut Dice, is_beside: bool) -> Self {
        let maps = [Map::Plain, Map::Sine, Map::HyperbolicSine, Map::Rational];
        let map = maps[(4.0 * dice.uniform()) as usize];
        let half = dice.power_of_ten(-3.0, -0.5);
        let (xi, is_compact) = (dice.within(-2.0, 2.0), dice.uniform() < 0.3);
        let xi = if is_beside { 1.03 * xi.signum() + 0.485 * xi } else { xi };
        let [least, most]: [f64; 2] = match (is_beside, is_compact) {
            (true, _) => [0.02, 0.024],
            (false, true) => [0.12, 0.3],
            (false, false) => [0.02, 0.08],
        };
        let is_compact = is_compact && !is_beside;
        let width = 2.0 * half * dice.power_of_ten(least.log10(), most.log10());
        let depth = half * width * dice.power_of_ten(-2.0, 0.0);
        let above = if xi.abs() > 1.0 { half * half * hertz_gap(xi.abs()) } else { 0.0 };
        let is_dent = xi.abs() < 1.1 && dice.uniform() < 0.5;
        let height = if is_dent { -depth } else { above * dice.within(1.0, 1.5) + depth };
        let feature = Feature { is_compact, at: xi * half, width, height };
        let ends = [-0.9, 0.95].map(|x| map.k(x));
        Self { map, ends, feature, load: 0.5 * half * half }
    }

    /// Returns a scene whose feature lies anywhere on the body, wider than 2 % of the contact or
    /// narrower.
    fn anywhere(dice: &mut Dice) -> Self {
        let scene = Self::new(dice, false);
        let half = (2.0 * scene.load).sqrt();
        let at = dice.within(-0.85, 0.9);
        let xi = at.abs() / half;
        // What the load takes of the height of the body.
        let taken = if xi > 1.0 { half * half * (0.5 * xi * xi - hertz_gap(xi)) } else { 0.0 };
        let above = (scene.map.y(at)[0] - taken) * dice.within(1.0, 1.2);
        let above = if xi > 1.0 { above } else { 0.0 };
        // No needle: flanks of slope 30.
        let width = (2.0 * half * dice.power_of_ten(-2.5, -0.5)).max(0.03 * above);
        let depth = half.min(10.0 * width) * width * dice.power_of_ten(-2.0, 0.0);
        let feature = Feature { at, width, height: above + depth, ..scene.feature };
        Self { feature, ..scene }
    }

    fn height(&self, x: f64) -> f64 {
        self.map.y(x)[0] - self.feature.y(x)[0]
    }

    /// Returns the body in pieces that end at some places, in widths of the feature.
    fn body(&self, cuts: &[f64]) -> Profile {
        let Self { map, ends, feature, .. } = *self;
        let cuts = cuts.iter().map(|cut| map.k(feature.at + cut * feature.width));
        let cuts = cuts.filter(|&k| k > ends[0] && k < ends[1]);
        let k: Vec<f64> = std::iter::once(ends[0]).chain(cuts).chain([ends[1]]).collect();
        let piece = |k: &[f64]| -> Profile {
            Box::new(Curve::new([k[0], k[1]], move |k: f64| {
                let [x, dx] = map.x(k);
                let ([y, dy], [bump, by_x]) = (map.y(x), feature.y(x));
                CurvePoint { x, y: y - bump, dx, dy: (dy - by_x) * dx }
            }))
        };
        join(k.windows(2).map(piece).collect())
    }

    /// Tells whether the contacts have the limits and the peak of other ones.
    fn is_same(one: &Solution<f64>, other: &Solution<f64>) -> bool {
        let [peak, known] = [one, other].map(|solution| solution.peak().unwrap().pressure);
        let off = apart(one.intervals(), other.intervals());
        (peak / known - 1.0).abs() < RIGHT && off < RIGHT
    }

    /// Tells whether a solution has neither tension nor overlap.
    fn is_contact(&self, solution: &Solution<f64>) -> bool {
        let [from, to] = [-0.9, 0.95];
        let share = |i: u32| from + (to - from) * f64::from(i) / 2000.0;
        let mut places: Vec<f64> = (0..=2000).map(share).collect();
        let Feature { at, width, .. } = self.feature;
        places.extend((-100..=100).map(|i| at + f64::from(i) / 50.0 * width));
        let hull = solution.hull();
        places
            .extend((-200..=200).map(|i| hull.centre() + f64::from(i) / 50.0 * hull.half_width()));
        places.retain(|x| (from..=to).contains(x));
        places.sort_by(f64::total_cmp);
        let height = |x: f64| self.height(x);
        let bodies = Bodies { tail: TAIL[0], height: &height, kappa: 1.0, places };
        !judge(&bodies, solution, self.load).is_wrong(1e-5)
    }
}

/// Inputs that were wrong or refused.
fn known_scenes() -> Vec<Scene> {
    let bell = |at, sigma: f64, height| Feature {
        is_compact: false,
        at,
        width: (8.0 * LN_2).sqrt() * sigma,
        height,
    };
    let of_root = |at, root: f64, height| bell(at, root / 2f64.sqrt(), height);
    let dent = Feature { is_compact: true, at: -0.08, width: 0.09, height: -0.004 };
    let on = |map, ends, feature, load| Scene { map, ends, feature, load };
    let plain = |feature, load| on(Map::Plain, [-1.0, 1.0], feature, load);
    let mut all = vec![
        on(Map::Sine, [-1.2, 1.2], bell(0.12, 0.005, 0.0017), 0.005),
        plain(of_root(0.69, 0.038, 0.133), 0.138),
        plain(
            of_root(
                -0.166_347_098_658_202_35,
                0.008_880_356_781_206_857,
                0.002_225_867_295_296_287_3,
            ),
            0.010_932_429_652_814_775,
        ),
    ];
    all.extend((0..10).map(|i| plain(dent, 0.0035 + 1e-4 * f64::from(i))));
    all
}

/// No feature that moves the peak by 1 % is missed or refused.
#[test]
fn no_narrow_feature_in_or_beside_a_contact_is_missed() {
    let scene = |seed| (format!("{seed}"), Scene::new(&mut Dice::new(seed), seed % 2 == 1));
    // As yet seed 1549 is missed, of the first 6 000: between nodes 4.3 widths apart.
    let random = scenes(100).map(scene);
    let known = known_scenes().into_iter().enumerate();
    let known = known.map(|(i, scene)| (format!("known {i}"), scene));
    none_is_missed(known.chain(random), false);
}

/// Nor is one anywhere on the bodies, if its length is asked for.
#[test]
fn no_feature_anywhere_is_missed_at_its_resolution() {
    let scene = |seed| (format!("{seed}"), Scene::anywhere(&mut Dice::new(seed)));
    // Seeds by number: a body that touches at the feature alone.
    none_is_missed(scenes(100).chain([204, 986]).map(scene), true);
}

fn none_is_missed(scenes: impl Iterator<Item = (String, Scene)>, is_asked: bool) {
    let (mut felt, mut unlike, mut wrong, mut refused) = (0, [0; 2], Vec::new(), Vec::new());
    for (name, scene) in scenes {
        let load = Control::Load(scene.load);
        let [body, declared] = [&[][..], &[-3.0, -1.3, -0.5, 0.0, 0.5, 1.3, 3.0]];
        let [body, declared] = [body, declared].map(|cuts| scene.body(cuts));
        let known = Contact::new(&Flat, &*declared).unwrap().solve(load);
        let bare = Scene { feature: Feature { height: 0.0, ..scene.feature }, ..scene.clone() };
        let peak = |solution: &Solution<f64>| solution.peak().unwrap().pressure;
        let bare = bare.body(&[]);
        let without = peak(&Contact::new(&Flat, &*bare).unwrap().solve(load).unwrap());
        // A feature too faint to count.
        if known.as_ref().is_ok_and(|known| (peak(known) / without - 1.0).abs() < RIGHT) {
            continue;
        }
        felt += 1;
        let contact = Contact::new(&Flat, &*body).unwrap();
        let contact = if is_asked { contact.resolution(scene.feature.width) } else { contact };
        let found = match contact.solve(load) {
            Ok(found) => found,
            Err(error) => {
                refused.push(format!("{name}: {error}, {scene:?}"));
                continue;
            }
        };
        let agrees = known.as_ref().is_ok_and(|known| Scene::is_same(&found, known));
        if !agrees && !scene.is_contact(&found) {
            let on = (found.intervals(), known.as_ref().map(Solution::intervals));
            wrong.push(format!("{name}: {on:?}, {scene:?}"));
        }
        unlike[usize::from(known.is_err())] += usize::from(!agrees);
    }
    println!(
        "{felt} scenes, {} wrong, {} refused; {unlike:?} unlike declared ones, or these refused",
        wrong.len(),
        refused.len()
    );
    let lists = [&wrong, &refused].map(|list| list.join("\n"));
    assert!(
        wrong.is_empty() && refused.is_empty(),
        "{} wrong:\n{}\n{} refused:\n{}",
        wrong.len(),
        lists[0],
        refused.len(),
        lists[1]
    );
}
