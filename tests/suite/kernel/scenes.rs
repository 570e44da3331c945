//! Random coated bodies.

use super::oracle::residual;
use super::{coated, half_plane, layer};
use crate::common::graph;
use crate::random_scenes::Dice;
use linecontact::{Base, Control, Foundation, Layer, Material};
use std::f64::consts::PI;

/// A random layer, and the compliance of its surface.
pub fn random_layer(random: &mut Dice) -> (Layer<f64>, f64) {
    let (modulus, ratio) = (random.power_of_ten(-1.0, 1.0), random.within(0.0, 0.49));
    let thickness = random.power_of_ten(-1.0, 0.5);
    let soft = random.power_of_ten(-2.0, 2.0);
    let base = match (4.0 * random.uniform()) as usize {
        0 => Base::Bonded,
        1 => Base::Frictionless,
        _ => half_plane(modulus * soft, random.within(0.0, 0.49)),
    };
    (layer(modulus, ratio, thickness, base), (1.0 - ratio * ratio) / modulus)
}

/// Every contact meets Eq. (1) by sums of its own, and its certificate holds.
#[test]
fn random_coated_bodies_meet_the_equation() {
    let count = std::env::var("SCENES").ok().and_then(|count| count.parse().ok()).unwrap_or(12);
    let mut refused = 0;
    // In the last one the kernel has to grow, too: its base is 77 times as soft as the coating.
    for seed in (0..count).chain((count <= 108).then_some(108)) {
        let random = &mut Dice::new(9100 + seed);
        let (one, compliance) = random_layer(random);
        let plain = Material::elastic(random.power_of_ten(-1.0, 1.0), 0.3);
        let Material::Elastic { youngs_modulus, .. } = plain else { continue };
        let (other, other_compliance, second) = match (3.0 * random.uniform()) as usize {
            0 => (Foundation::from(Material::Rigid), 0.0, None),
            1 => (Foundation::from(plain), 0.91 / youngs_modulus, None),
            _ => {
                let (layer, compliance) = random_layer(random);
                (Foundation::from(layer), compliance, Some(layer))
            }
        };
        let (wave, height) = (random.within(2.0, 6.0), random.within(0.0, 0.3));
        let phase = random.within(0.0, 2.0 * PI);
        let slope = move |x: f64| x - height / wave * (wave * x + phase).sin();
        let body = graph(-12.0, 12.0, move |x| {
            [0.5 * x * x + height / (wave * wave) * (wave * x + phase).cos(), slope(x)]
        });
        let kappa = PI / 2.0 / (compliance + other_compliance);
        let load = kappa * random.power_of_ten(-2.0, -0.5);
        // Each other body turns until the load acts at a given place.
        let at = random.within(-0.3, 0.3);
        let control = if seed % 2 == 0 {
            Control::Load(load)
        } else {
            Control::CentreOfPressure { load, at }
        };
        let contact = coated(&body, one, other);
        let solution = match contact.solve(control) {
            Ok(solution) => solution,
            Err(error) => {
                println!("{seed}: {error}");
                refused += 1;
                continue;
            }
        };
        let share = |compliance: f64| compliance * kappa / (PI / 2.0);
        let mut layers = vec![(share(compliance), one)];
        layers.extend(second.map(|second| (share(other_compliance), second)));
        let tilt = solution.tilt();
        let off = residual(&solution, kappa, &layers, |x| slope(x) + tilt);
        if seed % 2 == 1 {
            let centre = solution.centre_of_pressure().unwrap();
            assert!((centre - at).abs() < 1e-12 * solution.hull().half_width().max(1.0));
        }
        assert!(off < 1e-8, "{seed}: {off:e}");
        assert!(solution.certify().is_ok(), "{seed}: {:?}", solution.certify());
    }
    assert!(1000 * refused <= count, "{refused} refused");
}
