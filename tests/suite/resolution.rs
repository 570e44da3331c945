//! The narrowest feature requested by a user.

use crate::random_scenes::Dice;
use linecontact::{
    Contact, ContactError, Control, Convexity, Curve, CurvePoint, Flat, InputError,
    ParametricProfile, Solver,
};

/// Returns the gap outside Hertz's contact under load, over the square of the half-width, at ξ
/// half-widths: Johnson, *Contact Mechanics*, 1985, Eq. 4.44 and the height of the parabola.
pub fn hertz_gap(xi: f64) -> f64 {
    let root = (xi * xi - 1.0).sqrt();
    0.5 * (xi * root - (xi + root).ln())
}

/// Bump of height 1 at `s`, and its slope by `s`.
type Bump = fn(f64) -> [f64; 2];

/// Gaussian bell of width 1 at half its height.
fn bell(s: f64) -> [f64; 2] {
    let rate = 4.0 * std::f64::consts::LN_2;
    let y = (-rate * s * s).exp();
    [y, -2.0 * rate * s * y]
}

/// Bump `(1 - (2 s)²)³`, of width 1 from end to end.
fn compact(s: f64) -> [f64; 2] {
    let rest = (1.0 - 4.0 * s * s).max(0.0);
    [rest.powi(3), -24.0 * s * rest * rest]
}

/// Returns a parabola of radius 1 with a bump, as long as points for a contact of a half-width may
/// go.
fn burred(bump: Bump, [place, width, height]: [f64; 3], half: f64) -> impl ParametricProfile<f64> {
    let reach = (30.0 * half).min(1.0);
    Curve::new([-reach, reach], move |k: f64| {
        let [y, dy] = bump((k - place) / width);
        CurvePoint { x: k, y: 0.5 * k * k - height * y, dx: 1.0, dy: k - height / width * dy }
    })
}

/// Returns the number of heights sampled in all scenes, with a resolution and without.
fn seen_beside(share: f64, bump: Bump, scenes: u64) -> [usize; 2] {
    let mut price = [0; 2];
    for seed in 0..scenes {
        let mut dice = Dice::new(seed);
        let half = dice.power_of_ten(-3.0, -0.4);
        let reach = (1.0 + (2.0 * (30.0 * half).min(1.0) / half).ln()).sqrt();
        let xi = dice.within(1.01, reach);
        let place = if dice.uniform() < 0.5 { -xi * half } else { xi * half };
        let height = half * half * hertz_gap(xi) * dice.within(1.5, 3.0);
        let width = share * 2.0 * half;
        let body = burred(bump, [place, width, height], half);
        let load = Control::Load(0.5 * half * half);
        let contact = Contact::new(&Flat, &body).unwrap();
        price[1] += contact.solve(load).map_or(0, |solution| solution.cost().heights);
        let scene = format!("{seed}: {width:e} beside {half:e} at {xi}");
        let solution = contact.resolution(width).solve(load);
        let solution = solution.unwrap_or_else(|error| panic!("{scene}: {error}"));
        assert!(solution.intervals().iter().any(|on| on.contains(place)), "{scene}");
        price[0] += solution.cost().heights;
    }
    price
}

/// Solves bumps inside the contact, which change the pressure by their slope; the slope of the
/// parabola at the limits is `half`. Returns the number of heights sampled.
fn seen_inside(share: f64, bump: Bump, scenes: u64) -> usize {
    let mut price = 0;
    for seed in 0..scenes {
        let mut dice = Dice::new(seed);
        let half = dice.power_of_ten(-3.0, -0.4);
        let width = share * 2.0 * half;
        // Symmetric places coincide with nodes.
        let xi = if seed == 0 { 0.0 } else { dice.within(-0.99, 0.99) };
        let height = half * width * dice.power_of_ten(-2.0, -1.0);
        let height = if dice.uniform() < 0.5 { -height } else { height };
        let body = burred(bump, [xi * half, width, height], half);
        let load = Control::Load(0.5 * half * half);
        let contact = Contact::new(&Flat, &body).unwrap().resolution(width);
        let scene = format!("{seed}: {width:e} in {half:e} at {xi}");
        let solution = contact.solve(load).unwrap_or_else(|error| panic!("{scene}: {error}"));
        // On the flank of the bump the pressure differs from Hertz's.
        let pressure = solution.pressure().unwrap();
        let off = [-0.2, 0.0, 0.2].map(|s| {
            let x = xi * half + s * width;
            let hertz = (half * half - x * x).sqrt() / std::f64::consts::PI;
            (pressure.at(x).unwrap() / hertz - 1.0).abs()
        });
        assert!(off.iter().any(|&off| off > 1e-3), "{scene}: {off:?}");
        price += solution.cost().heights;
    }
    price
}

#[test]
fn burrs_as_narrow_as_asked_for_are_seen() {
    println!("share of the contact, bump: evaluations beside, by default, inside");
    for share in [0.005, 0.002, 0.001] {
        for (name, bump) in [("bell", bell as Bump), ("compact", compact)] {
            let scenes = 40;
            let [beside, by_default] = seen_beside(share, bump, scenes);
            let inside = seen_inside(share, bump, scenes);
            let [beside, by_default, inside] =
                [beside, by_default, inside].map(|sum| sum / scenes as usize);
            println!("{share}, {name}: {beside}, {by_default}, {inside}");
        }
    }
}

/// A tenth, a hundredth and a thousandth of the contact of a smooth parabola, after the default.
#[test]
fn evaluations_are_those_kept() {
    let body = burred(bell, [0.0, 1.0, 0.0], 1.0);
    let contact = Contact::new(&Flat, &body).unwrap();
    let heights =
        |contact: &Contact<'_, f64>| contact.solve(Control::Load(0.02)).unwrap().cost().heights;
    let kept = [4e-2, 4e-3, 4e-4].map(|length| heights(&contact.clone().resolution(length)));
    assert_eq!([heights(&contact), kept[0], kept[1], kept[2]], [30, 190, 1836, 18225]);
}

/// After a solve at a coarser resolution, a solver samples again.
#[test]
fn a_warm_solver_looks_again() {
    let (half, share) = (0.2, 0.002);
    let width = share * 2.0 * half;
    for (place, height) in [(0.25, 0.02), (0.0713, 0.05 * half * width)] {
        let body = burred(compact, [place, width, height], 1.0);
        let contact = Contact::new(&Flat, &body).unwrap();
        let load = Control::Load(0.5 * half * half);
        let cold = contact.clone().resolution(width).solve(load).unwrap();
        let mut solver = Solver::new();
        solver.solve(&contact, load).unwrap();
        solver.solve(&contact.clone().resolution(3.0 * width), load).unwrap();
        let warm = solver.solve(&contact.clone().resolution(width), load).unwrap();
        assert_eq!(cold.intervals().len(), warm.intervals().len(), "at {place}");
        let peaks = [&cold, &warm].map(|solution| solution.peak().unwrap().pressure);
        assert!((peaks[1] / peaks[0] - 1.0).abs() < 1e-9, "at {place}: {peaks:?}");
        // Known features are kept at no cost.
        let again = solver.solve(&contact.resolution(width), load).unwrap();
        assert_eq!(again.intervals().len(), cold.intervals().len());
        assert_eq!(again.cost().heights, 0, "at {place}");
    }
}

/// Also with several contacts, and with any declared convexity.
#[test]
fn declared_bodies_are_looked_at() {
    let (half, width, place) = (0.2, 4e-4, 0.25);
    let at = move |k: f64| {
        let [y, dy] = compact((k - place) / width);
        CurvePoint { x: k, y: 0.5 * k * k - 0.02 * y, dx: 1.0, dy: k - 0.02 / width * dy }
    };
    let body = Curve::new([-1.0, 1.0], at).with_convexity(Convexity::Convex);
    let contact = Contact::new(&Flat, &body).unwrap();
    let load = Control::Load(0.5 * half * half);
    assert_eq!(contact.solve(load).unwrap().intervals().len(), 1);
    let contact = contact.resolution(width);
    assert_eq!(contact.solve(load).unwrap().intervals().len(), 2);
    let bare = contact.single_interval(true).solve(load).unwrap();
    assert_eq!((bare.intervals().len(), bare.cost().heights), (1, 0));
}

#[test]
fn lengths_that_are_none_are_refused() {
    let body = burred(bell, [0.0, 1.0, 0.0], 1.0);
    let contact = Contact::new(&Flat, &body).unwrap();
    for length in [0.0, -1e-3, f64::NAN, f64::INFINITY, 1e-17] {
        let found = contact.clone().resolution(length).solve(Control::Load(0.02));
        let error = found.map(|_| ()).unwrap_err();
        let ContactError::Input(InputError::InvalidResolution { resolution, least }) = error else {
            panic!("{error}")
        };
        assert_eq!(resolution.to_bits(), length.to_bits());
        assert!(!(length > least && length < f64::INFINITY), "{error}");
    }
    // More points than the budget allows, on bodies of 2 or of a few millionths.
    let error = contact.clone().resolution(1e-9).solve(Control::Load(0.02)).map(|_| ());
    let Err(ContactError::Input(InputError::InvalidResolution { least, .. })) = error else {
        panic!("{error:?}")
    };
    assert!(least > 6e-6 && least < 7e-6, "{least}");
    contact.resolution(1.001 * least).solve(Control::Load(0.02)).unwrap();
}

/// An asperity 1.4 half-widths beside the contact, where the load alone does not reach: 0.13 deep
/// in the other body.
#[test]
fn an_asperity_far_from_the_contact_is_seen_on_request() {
    let lower = Curve::new([-6.0, 6.0], |k: f64| {
        let bump = 17.0 / 8.0 * (-1024.0 * (k + 2.5).powi(2)).exp();
        let dy = -2048.0 * (k + 2.5) * bump - 0.5 * k;
        CurvePoint { x: k, y: bump - 0.25 * k * k, dx: 1.0, dy }
    });
    let upper = Curve::new([-6.0, 6.0], |k: f64| CurvePoint {
        x: k,
        y: 0.25 * k * k,
        dx: 1.0,
        dy: 0.5 * k,
    });
    let contact = Contact::new(&lower, &upper).unwrap().resolution(0.05);
    let solution = contact.solve(Control::Load(0.5570423)).unwrap();
    assert!(solution.intervals().len() == 2 && solution.intervals()[0].contains(-2.5));
    solution.certify().unwrap();
}
