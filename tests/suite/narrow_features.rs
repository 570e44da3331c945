//! Bumps beside a contact that are narrower than the distance of the points of a survey.

use crate::random_scenes::Dice;
use linecontact::{Contact, Control, Curve, CurvePoint, Flat};

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
