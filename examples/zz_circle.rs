//! x
use linecontact::profile::*;
use linecontact::*;
use std::hint::black_box;
fn main() {
    let mode = std::env::args().nth(1).unwrap();
    let ratio: f64 = std::env::args().nth(2).unwrap().parse().unwrap();
    let arc = Curve::new([-1.5, 1.5], |k: f64| {
        let (s, c) = k.sin_cos();
        CurvePoint { x: 10.0 * s, y: 10.0 * (1.0 - c), dx: 10.0 * c, dy: 10.0 * s }
    });
    let rubber = Material::elastic(1.0, 0.3);
    let layer = Layer { material: rubber, thickness: 1.0, base: Base::Bonded };
    let c = Contact::new(&Flat, &arc).unwrap();
    let plain = c.clone().materials(rubber, Material::Rigid, PlaneState::Strain);
    let coated = c.materials(layer, Material::Rigid, PlaneState::Strain);
    let load = coated.solve(Control::HalfWidth(ratio)).unwrap().load();
    let pload = plain.solve(Control::HalfWidth(ratio)).unwrap().load();
    let n: usize = std::env::args().nth(3).unwrap().parse().unwrap();
    match mode.as_str() {
        "none" => {}
        "plain" => {
            for _ in 0..n {
                black_box(plain.solve(Control::Load(pload)).unwrap());
            }
        }
        "coated" => {
            for _ in 0..n {
                black_box(coated.solve(Control::Load(load)).unwrap());
            }
        }
        "pnext" => {
            let mut s = Solver::new();
            for i in 0..n {
                black_box(s.solve(&plain, Control::Load(pload * (1.0 + 0.01 * i as f64))).unwrap());
            }
        }
        _ => {
            let mut s = Solver::new();
            for i in 0..n {
                let r = black_box(
                    s.solve(&coated, Control::Load(load * (1.0 + 0.01 * i as f64))).unwrap(),
                );
                if n < 3 {
                    println!("{}", r.cost());
                }
            }
        }
    }
}
