//! Approach and stiffness of layers.

use super::oracle::approach;
use super::periodic::{PERIOD, waves};
use super::scenes::random_layer;
use super::{RIGID, coated, half_plane, layer, parabola};
use crate::common::{Profile, graph, worst};
use crate::random_scenes::Dice;
use linecontact::{Base, Contact, Control, Foundation, Material, Reference, References};

const STEEL: Material<f64> = Material::Elastic { youngs_modulus: 3.0, poisson_ratio: 0.3 };

fn to(x: f64, reference: Reference<f64>) -> References<f64> {
    References { x, lower: reference, upper: reference }
}

/// Two crests, of which the left one is touched first.
fn crests() -> Profile {
    graph(-2.5, 2.5, |x| [0.5 * (x * x - 1.0).powi(2) + 0.03 * x, 2.0 * x * (x * x - 1.0) + 0.03])
}

/// Height of the place that the crests touch first.
fn first_height() -> f64 {
    let mut x = -1.0f64;
    for _ in 0..20 {
        x -= (2.0 * x * (x * x - 1.0) + 0.03) / (6.0 * x * x - 2.0);
    }
    0.5 * (x * x - 1.0).powi(2) + 0.03 * x
}

/// A layer of the base's material is none, wherever the reference lies; and in a layer of endless
/// thickness, all of it is a half-plane.
#[test]
fn limits_of_equal_materials_and_of_thick_layers() {
    let (one, other) = (Material::elastic(1.0, 0.3), Material::elastic(2.0, 0.45));
    let same =
        [layer(1.0, 0.3, 0.7, half_plane(1.0, 0.3)), layer(2.0, 0.45, 0.2, half_plane(2.0, 0.45))];
    let thick =
        |base: [Base<f64>; 2]| [layer(1.0, 0.3, 1e15, base[0]), layer(2.0, 0.45, 1e15, base[1])];
    let anywhere = [0.02, 0.3, 0.7, 1.5, 40.0, 1e9].map(Reference::Depth);
    let anywhere = anywhere.into_iter().chain([Reference::Disc(30.0), Reference::Length(5.0)]);
    let deep = [0.02, 0.3, 5.0].map(Reference::Depth).to_vec();
    let soft = [half_plane(0.2, 0.1), half_plane(7.0, 0.4)];
    let cases = [(same, anywhere.collect()), (thick(soft), deep.clone())];
    let mut errors = Vec::new();
    for (body, load) in [(parabola(6.0), 0.5), (crests(), 0.3)] {
        let plain = coated(&body, one, other).solve(Control::Load(load)).unwrap();
        for (layers, references) in &cases {
            let pairs: [[Foundation<f64>; 2]; 3] = [
                [layers[0].into(), other.into()],
                [one.into(), layers[1].into()],
                [layers[0].into(), layers[1].into()],
            ];
            for [lower, upper] in pairs {
                let solution = coated(&body, lower, upper).solve(Control::Load(load)).unwrap();
                for &reference in references {
                    for x in [0.0, -0.9, 1.1, 2.4] {
                        let at = to(x, reference);
                        let (found, exact) =
                            (solution.approach(&at).unwrap(), plain.approach(&at).unwrap());
                        let size = exact.bodies.abs().max(exact.lower.abs()).max(exact.upper.abs());
                        errors.push((found.bodies - exact.bodies) / size);
                        errors.push((found.lower - exact.lower) / size);
                        errors.push((found.upper - exact.upper) / size);
                        let stiffness = solution.stiffness(&at).unwrap();
                        errors.push(stiffness / plain.stiffness(&at).unwrap() - 1.0);
                    }
                }
            }
        }
    }
    let worst = worst(errors.into_iter().map(f64::abs));
    println!("{worst:.1e}");
    assert!(worst < 1e-13);
}

/// Bodies of all kinds against sums over wavenumbers, with one contact and two.
#[test]
fn approaches_agree_with_a_direct_sum() {
    let soft = layer(1.0, 0.3, 0.6, half_plane(0.2, 0.4));
    let stiff = layer(2.0, 0.2, 0.3, half_plane(0.5, 0.3));
    let pairs: [[Foundation<f64>; 2]; 4] = [
        [soft.into(), RIGID.into()],
        [STEEL.into(), stiff.into()],
        [soft.into(), layer(1.0, 0.45, 0.5, Base::Bonded).into()],
        [stiff.into(), soft.into()],
    ];
    let references = [
        Reference::Depth(0.2),
        Reference::Depth(1.3),
        Reference::Depth(9.0),
        Reference::Length(6.0),
    ];
    let mut errors = Vec::new();
    for (body, load, first, height) in
        [(parabola(6.0), 0.3, 0.0, 0.0), (crests(), 0.15, -0.95, first_height())]
    {
        for bodies in &pairs {
            let [lower, upper] = bodies.clone();
            let solution = coated(&body, lower, upper).solve(Control::Load(load)).unwrap();
            assert_eq!(solution.intervals().len(), if height == 0.0 { 1 } else { 2 });
            for x in [first, 0.1, 1.9] {
                for reference in references {
                    let found = solution.approach(&to(x, reference)).unwrap();
                    let exact =
                        bodies.each_ref().map(|of| approach(&solution, of, x, reference, None));
                    let size = exact[0].abs().max(exact[1].abs());
                    errors.push((found.lower - exact[0]) / size);
                    errors.push((found.upper - exact[1]) / size);
                    let gap = body.at(x).y - height - solution.gap_at(x).unwrap_or(0.0);
                    errors.push((found.bodies - (exact[0] + exact[1] + gap)) / size);
                }
            }
        }
    }
    let worst = worst(errors.into_iter().map(f64::abs));
    println!("{worst:.1e}");
    assert!(worst < 1e-10);
}

/// Layers below a period: the approach is that of the mean planes.
#[test]
fn mean_planes_of_layers() {
    let body = waves(0.1, &[[0.02, 3.0, 0.0], [0.012, 1.0, 0.4]]);
    let from = (0..10_000).map(|i| 0.1 + PERIOD * f64::from(i) / 1e4);
    let from = from.min_by(|&one, &other| body.y(one).total_cmp(&body.y(other))).unwrap();
    // The lowest place of a parabola through three.
    let [left, middle, right] = [-1e-4, 0.0, 1e-4].map(|by| body.y(from + by));
    let first = middle - (right - left).powi(2) / (8.0 * (left + right - 2.0 * middle));
    let pairs: [[Foundation<f64>; 2]; 2] = [
        [layer(1.0, 0.3, 0.1, half_plane(0.2, 0.4)).into(), STEEL.into()],
        [
            layer(2.0, 0.2, 0.3, Base::Bonded).into(),
            layer(1.0, 0.45, 0.05, half_plane(4.0, 0.3)).into(),
        ],
    ];
    for bodies in pairs {
        let [lower, upper] = bodies.clone();
        let contact = coated(&body, lower, upper).period(PERIOD);
        let solution = contact.solve(Control::Load(0.03)).unwrap();
        assert_eq!(solution.intervals().len(), 3);
        let anywhere = Reference::Depth(1.0);
        for x in [solution.intervals()[1].centre(), solution.hull().left - 0.01] {
            let found = solution.approach(&to(x, anywhere)).unwrap();
            let exact =
                bodies.each_ref().map(|of| approach(&solution, of, x, anywhere, Some(PERIOD)));
            let gap = body.at(x).y - first - solution.gap_at(x).unwrap_or(0.0);
            for (found, exact) in [
                (found.lower, exact[0]),
                (found.upper, exact[1]),
                (found.bodies, exact[0] + exact[1] + gap),
            ] {
                assert!((found - exact).abs() < 1e-11, "{x}: {found} {exact}");
            }
        }
        assert_stiffness(&contact, 0.03, &to(0.3, anywhere));
    }
}

fn assert_stiffness(contact: &Contact<'_, f64>, load: f64, references: &References<f64>) {
    let solve = |load: f64| contact.solve(Control::Load(load)).unwrap();
    let (solution, step) = (solve(load), 2e-3 * load);
    let at = |by: f64| solve(load + by).approach(references).unwrap().bodies;
    let rate = (8.0 * (at(step) - at(-step)) - (at(2.0 * step) - at(-2.0 * step))) / (12.0 * step);
    let off = solution.stiffness(references).unwrap() * rate - 1.0;
    assert!(off.abs() < 2e-9, "{references:?}: {off:e}");
    // The load of this approach is this one.
    let approach = solution.approach(references).unwrap().bodies;
    let again = contact.solve(Control::Approach { approach, references: *references }).unwrap();
    assert!((again.load() / load - 1.0).abs() < 1e-12, "{}", again.load() / load - 1.0);
}

#[test]
fn stiffness_is_the_derivative_and_the_approach_may_be_given() {
    let soft = layer(1.0, 0.3, 0.6, half_plane(0.2, 0.4));
    let stiff = layer(2.0, 0.2, 0.3, half_plane(0.5, 0.3));
    for (body, load) in [(parabola(6.0), 0.3), (crests(), 0.15)] {
        let pairs: [[Foundation<f64>; 2]; 3] = [
            [soft.into(), RIGID.into()],
            [STEEL.into(), stiff.into()],
            [stiff.into(), soft.into()],
        ];
        for [lower, upper] in pairs {
            let contact = coated(&body, lower, upper);
            for reference in [Reference::Depth(0.4), Reference::Depth(5.0), Reference::Disc(20.0)] {
                assert_stiffness(&contact, load, &to(0.1, reference));
            }
        }
    }
}

/// A depth far below is a length of the base: `2 ln d - 1/(1 - ν)` is `2 ln ℓ`.
#[test]
fn far_below_a_depth_is_a_length() {
    let mut errors = Vec::new();
    for seed in 0..30 {
        let random = &mut Dice::new(500 + seed);
        let ([modulus, soft], ratio) =
            ([0, 1].map(|_| random.power_of_ten(-1.0, 1.0)), 0.1 + 0.01 * f64::from(seed as u8));
        let base = half_plane(modulus * soft, ratio);
        let one = layer(modulus, random.within(0.0, 0.5), random.power_of_ten(-1.0, 1.0), base);
        let body = parabola(6.0);
        let solution = coated(&body, one, STEEL).solve(Control::HalfWidth(0.5)).unwrap();
        let at = |reference| {
            let to = References { lower: reference, ..to(0.2, Reference::Depth(1.0)) };
            let approach = solution.approach(&to).unwrap();
            [approach.lower, approach.bodies, solution.stiffness(&to).unwrap().recip()]
        };
        let far = at(Reference::Depth(1e16));
        let length = at(Reference::Length(1e16 * (-0.5 / (1.0 - ratio)).exp()));
        errors.extend(far.iter().zip(length).map(|(one, other)| one / other - 1.0));
    }
    let worst = worst(errors.into_iter().map(f64::abs));
    println!("{worst:.1e}");
    assert!(worst < 1e-13);
}

/// Random layers with references anywhere in them and below.
#[test]
fn random_layers_agree_with_a_direct_sum() {
    let count = std::env::var("SCENES").ok().and_then(|count| count.parse().ok()).unwrap_or(4);
    let mut errors = Vec::new();
    for seed in 0..count {
        let random = &mut Dice::new(31_000 + seed);
        let ((one, compliance), (two, _)) = (random_layer(random), random_layer(random));
        let bodies: [Foundation<f64>; 2] = match seed % 3 {
            0 => [one.into(), RIGID.into()],
            1 => [one.into(), STEEL.into()],
            _ => [two.into(), one.into()],
        };
        let (wave, height) = (random.within(2.0, 6.0), random.within(0.0, 0.3));
        let body = graph(-12.0, 12.0, move |x| {
            let (sin, cos) = (wave * x + 1.0).sin_cos();
            [0.5 * x * x + height / (wave * wave) * cos, x - height / wave * sin]
        });
        let load = random.power_of_ten(-2.0, -0.3) / compliance;
        let [lower, upper] = bodies.clone();
        let solution = coated(&body, lower, upper).solve(Control::Load(load)).unwrap();
        let depths = [0.01, random.uniform(), 1.0, 1.001, random.power_of_ten(0.0, 2.0)];
        let depths = depths.map(|depth| Reference::Depth(depth * one.thickness));
        for reference in depths.into_iter().chain([Reference::Length(20.0)]) {
            for x in [solution.hull().centre(), random.within(-4.0, 4.0)] {
                let found = solution.approach(&to(x, reference)).unwrap();
                let exact = bodies.each_ref().map(|of| approach(&solution, of, x, reference, None));
                let size = exact[0].abs().max(exact[1].abs()).max(1e-3 * load * compliance);
                errors.push((found.lower - exact[0]) / size);
                errors.push((found.upper - exact[1]) / size);
            }
        }
    }
    let worst = worst(errors.into_iter().map(f64::abs));
    println!("{worst:.1e}");
    assert!(worst < 1e-8);
}
