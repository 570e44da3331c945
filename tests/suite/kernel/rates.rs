//! Rates by the load, approach and stiffness of layers.

use super::{RIGID, coated, half_plane, layer, parabola};
use crate::common::kernel_values;
use linecontact::{Base, Control, Material, Reference, References, Solution};

const TO: References<f64> =
    References { x: 0.0, lower: Reference::Depth(7.0), upper: Reference::Depth(7.0) };

/// On a rigid base the approach is absolute: no reference counts.
#[test]
fn approaches_agree_with_values_of_22_digits() {
    let cases = [
        ("slip", layer(1.0, 0.3, 1.0, Base::Frictionless)),
        ("bonded nu=0.3", layer(1.0, 0.3, 1.0, Base::Bonded)),
        ("bonded nu=0.5", layer(1.0, 0.5, 1.0, Base::Bonded)),
    ];
    let body = parabola(6.0);
    for (name, layer) in cases {
        let [load, delta] = kernel_values(name, ["F", "delta"]);
        for lower in [true, false] {
            let contact =
                if lower { coated(&body, layer, RIGID) } else { coated(&body, RIGID, layer) };
            let solution = contact.solve(Control::Load(load)).unwrap();
            let approach = solution.approach(&TO).unwrap();
            let off = approach.bodies / delta - 1.0;
            assert!(off.abs() < 1e-13, "{name}: {off:e}");
            // At x = 0 the bodies touched first.
            let own = if lower { approach.lower } else { approach.upper };
            assert!((own / delta - 1.0).abs() < 1e-13, "{name}: {own}");
            let control = Control::Approach { approach: delta, references: TO };
            let again = contact.solve(control).unwrap();
            assert!((again.load() / load - 1.0).abs() < 1e-13, "{name}: {}", again.load());
            assert!(again.report().is_checked());
        }
    }
}

/// Thin layers, by the factors of Wiener and Hopf.
#[test]
fn approaches_of_thin_layers() {
    let cases =
        [(Base::Frictionless, 0.1771315758, 0.0), (Base::Bonded, 0.1220706479, 0.0714285714)];
    for (base, first, second) in cases {
        let ratio: f64 = 12.0;
        let body = parabola(3.0 * ratio);
        let contact = coated(&body, layer(1.0, 0.3, 1.0, base), RIGID);
        let solution = contact.solve(Control::HalfWidth(ratio)).unwrap();
        let expected = ((ratio + first).powi(2) + second) / 2.0;
        let off = solution.approach(&TO).unwrap().bodies / expected - 1.0;
        assert!(off.abs() < 3e-10, "{base:?}: {off:e}");
    }
}

#[test]
fn rates_and_stiffness_against_differences() {
    let body = parabola(6.0);
    let steel = Material::elastic(3.0, 0.3);
    let cases = [
        (layer(1.0, 0.3, 1.0, Base::Bonded), RIGID),
        (layer(1.0, 0.45, 0.4, Base::Frictionless), steel),
        (layer(1.0, 0.3, 0.6, half_plane(0.2, 0.3)), RIGID),
    ];
    for (i, (layer, other)) in cases.into_iter().enumerate() {
        let contact = coated(&body, layer, other);
        let solve = |load: f64| contact.solve(Control::Load(load)).unwrap();
        let (load, step) = (0.5, 1e-3);
        let solution = solve(load);
        let rates = solution.load_rates().unwrap();
        let moved = [step, -step, 2.0 * step, -2.0 * step].map(|by| solve(load + by));
        let differ =
            |value: [f64; 4]| (8.0 * (value[0] - value[1]) - (value[2] - value[3])) / (12.0 * step);
        let limits = differ(moved.each_ref().map(Solution::a));
        assert!((rates.a / limits - 1.0).abs() < 1e-9, "{i}: {} {limits}", rates.a);
        assert!((rates.b / limits - 1.0).abs() < 1e-9);
        let x = 0.3 * solution.a();
        let pressure =
            differ(moved.each_ref().map(|solution| solution.pressure().unwrap().at(x).unwrap()));
        assert!((rates.pressure(x).unwrap() / pressure - 1.0).abs() < 1e-8, "{i}: {pressure}");
        let approach = moved.each_ref().map(|one| one.approach(&TO).unwrap().bodies);
        let (stiffness, expected) = (solution.stiffness(&TO).unwrap(), differ(approach).recip());
        assert!((stiffness / expected - 1.0).abs() < 1e-9, "{i}: {stiffness} {expected}");
    }
}
