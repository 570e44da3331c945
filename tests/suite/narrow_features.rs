//! Bumps in and beside a contact that are narrower than the distance of the points of a survey, or of nodes.

use crate::random_scenes::Dice;
use linecontact::{Contact, Control, Curve, CurvePoint, Flat, ParametricProfile, Piecewise};

/// The full width at half height of a bump, as a share of the contact.
const WIDTH: f64 = 0.02;

/// The gap beside Hertz's contact under load, over the square of the half-width, at ξ half-widths: Johnson, *Contact
/// Mechanics*, 1985, Eq. 4.44 and the height of the parabola.
fn hertz_gap(xi: f64) -> f64 {
    let root = (xi * xi - 1.0).sqrt();
    0.5 * (xi * root - (xi + root).ln())
}

/// A bump that is higher than the gap at its top touches.
#[test]
fn no_bump_of_two_per_cent_beside_a_contact_is_missed() {
    let scenes = std::env::var("SCENES").map_or(300, |count| count.parse().unwrap());
    let (mut missed, mut refused) = (Vec::new(), 0);
    for seed in 0..scenes {
        let mut dice = Dice::new(seed);
        let half = dice.power_of_ten(-3.0, -0.4);
        // As far as the load reaches.
        let reach = (1.0 + (2.0 / half).ln()).sqrt();
        let xi = dice.within(1.05, reach);
        let place = if dice.uniform() < 0.5 { -xi * half } else { xi * half };
        let height = half * half * hertz_gap(xi) * dice.within(1.5, 3.0);
        let sigma = WIDTH * 2.0 * half / (8.0 * 2f64.ln()).sqrt();
        let body = Curve::new([-1.0, 1.0], move |k: f64| {
            let s = (k - place) / sigma;
            let bump = height * (-0.5 * s * s).exp();
            CurvePoint { x: k, y: 0.5 * k * k - bump, dx: 1.0, dy: k + bump * s / sigma }
        });
        let load = Control::Load(0.5 * half * half);
        match Contact::new(&Flat, &body).unwrap().solve(load) {
            Ok(solution) => {
                let touches = |on: &linecontact::Interval<f64>| on.contains(place);
                if !solution.intervals().iter().any(touches) {
                    missed.push(format!("{seed}: half-width {half:.3e}, at {xi:.3} of it"));
                }
            }
            Err(_) => refused += 1,
        }
    }
    println!("{refused} refused");
    assert!(refused <= scenes / 100, "{refused} refused");
    assert!(missed.is_empty(), "{} of {scenes}:\n{}", missed.len(), missed.join("\n"));
}

/// A round body with a bump or a dent inside its contact, of a height that moves the peak by 1 % or more, cut into pieces
/// at some places.
fn dimpled(
    place: f64,
    sigma: f64,
    height: f64,
    cuts: &[f64],
) -> Piecewise<f64, impl ParametricProfile<f64> + use<>> {
    let ends = [&[-1.0], cuts, &[1.0]].concat();
    let piece = |k: &[f64]| {
        Curve::new([k[0], k[1]], move |k: f64| {
            let s = (k - place) / sigma;
            let bump = height * (-0.5 * s * s).exp();
            CurvePoint { x: k, y: 0.5 * k * k - bump, dx: 1.0, dy: k + bump * s / sigma }
        })
    };
    Piecewise::new(ends.windows(2).map(piece).collect()).unwrap()
}

/// Pieces that end on the flanks of the bump show it whatever their nodes.
#[test]
fn no_bump_of_two_per_cent_inside_a_contact_is_missed() {
    let scenes = std::env::var("SCENES").map_or(300, |count| count.parse().unwrap());
    let (mut missed, mut refused) = (Vec::new(), 0);
    for seed in 0..scenes {
        let mut dice = Dice::new(seed);
        let half = dice.power_of_ten(-3.0, -0.4);
        let xi = dice.within(-1.0, 1.0);
        let (place, sigma) = (xi * half, WIDTH * 2.0 * half / (8.0 * 2f64.ln()).sqrt());
        // A slope of 1 to 10 % of that at the limits.
        let height = half * sigma * dice.power_of_ten(-2.0, -1.0);
        let height = if dice.uniform() < 0.5 { -height } else { height };
        let load = Control::Load(0.5 * half * half);
        let peak = |cuts: &[f64]| {
            let body = dimpled(place, sigma, height, cuts);
            let solution = Contact::new(&Flat, &body).unwrap().solve(load).ok()?;
            Some(solution.peak().unwrap().pressure)
        };
        let cuts = [-3.0, -1.0, 0.0, 1.0, 3.0].map(|s| place + s * sigma);
        let (Some(found), Some(known)) = (peak(&[]), peak(&cuts)) else {
            refused += 1;
            continue;
        };
        if (found / known - 1.0).abs() > 1e-6 {
            missed.push(format!(
                "{seed}: half-width {half:.3e}, at {xi:.3} of it: {found} for {known}"
            ));
        }
    }
    println!("{refused} refused");
    assert!(refused <= scenes / 100, "{refused} refused");
    assert!(missed.is_empty(), "{} of {scenes}:\n{}", missed.len(), missed.join("\n"));
}
