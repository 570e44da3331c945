//! The default engine against 25-digit references.
#![allow(missing_docs)]

mod common;

use common::{reference, scenes};
use linecontact::{Cost, Load};

#[test]
fn references() {
    for scene in scenes() {
        let truth = reference(scene.name);
        let contact = scene.contact();
        let solution = match contact.solve(Load::Constant(truth.c)) {
            Ok(solution) => solution,
            Err(error) => {
                println!("{:30} {error}", scene.name);
                continue;
            }
        };
        let half_width = truth.half_width();
        let error_a = (solution.a() - truth.a).abs() / half_width;
        let error_b = (solution.b() - truth.b).abs() / half_width;
        let cost = solution.cost();
        let estimate = solution.limits_error().unwrap();
        let pressure = solution.pressure().unwrap();
        let (mut worst, mut floor, mut over, mut under) = (0.0f64, 0.0f64, 0.0f64, 0.0f64);
        for (&[x, exact], k) in truth.points.iter().zip(&truth.amplification) {
            if exact == 0.0 || !exact.is_finite() {
                continue;
            }
            match pressure.estimate(x, &mut Cost::default()) {
                Ok(e) => {
                    let error = (e.value - exact).abs();
                    worst = worst.max(error / exact.abs());
                    floor = floor.max(k * 1.1e-16);
                    if error > e.error {
                        println!(
                            "  {} z {} P {exact:e} error {error:e} est {:e}",
                            scene.name,
                            truth.z(x),
                            e.error
                        );
                    }
                    under = under.max(error / e.error);
                    over = over.max(e.error / error.max(1e-16 * k * exact.abs()));
                }
                Err(error) => println!("{x}: {error}"),
            }
        }
        println!(
            "{:30} a {error_a:.1e} b {error_b:.1e} est {estimate:.1e} P {worst:.1e} floor {floor:.1e} under {under:.1e} over {over:.1e} {} {}",
            scene.name, cost.samples, cost.evaluations
        );
    }
}
