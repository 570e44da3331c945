//! Several layers on a base.

use super::oracle::residual;
use super::{RIGID, coated, half_plane, layer, parabola};
use crate::common::graph;
use crate::random_scenes::Dice;
use linecontact::{
    Base, Body, ContactError, Control, EvaluationError, Foundation, InputError, Material,
    Reference, References, Stack,
};
use std::f64::consts::PI;

fn stack(layers: &[(f64, f64, f64)], base: Base<f64>) -> Stack<f64> {
    let layers = layers.iter().map(|&(e, nu, h)| (Material::elastic(e, nu), h)).collect();
    Stack { layers, base }
}

fn to(lower: Reference<f64>) -> References<f64> {
    References { x: 0.0, lower, upper: Reference::Depth(5.0) }
}

/// A stack of one layer is that layer, like ones are one, and a last one like the base is none.
#[test]
fn like_layers_are_one() {
    let body = parabola(6.0);
    for base in [Base::Bonded, Base::Frictionless, half_plane(0.2, 0.4), half_plane(30.0, 0.1)] {
        for ratio in [0.0, 0.3, 0.5] {
            let one = layer(1.0, ratio, 1.0, base);
            let exact = coated(&body, one, RIGID).solve(Control::Load(0.5)).unwrap();
            let alone = stack(&[(1.0, ratio, 1.0)], base);
            let alone = coated(&body, alone, RIGID).solve(Control::Load(0.5)).unwrap();
            assert_eq!(alone.intervals(), exact.intervals());
            let mut stacks = vec![stack(&[(1.0, ratio, 0.25), (1.0, ratio, 0.75)], base)];
            if let Base::HalfPlane(Material::Elastic { youngs_modulus, poisson_ratio }) = base {
                let like = (youngs_modulus, poisson_ratio, 0.4);
                stacks.push(stack(&[(1.0, ratio, 1.0), like], base));
            }
            for stack in stacks {
                let found = coated(&body, RIGID, stack.clone()).solve(Control::Load(0.5)).unwrap();
                let off = found.a() / exact.a() - 1.0;
                assert!(off.abs() < 1e-13, "{stack:?}: {off:e}");
                assert!(found.certify().unwrap().is_proved());
                let length = to(Reference::Length(50.0));
                let found = coated(&body, stack, RIGID).solve(Control::Load(0.5)).unwrap();
                let [one, other] = [&exact, &found].map(|of| of.approach(&length).unwrap().lower);
                assert!((other / one - 1.0).abs() < 1e-12, "{one} {other}");
            }
        }
    }
}

/// Like layers are one below bodies that repeat, too, and under a moment.
#[test]
fn like_layers_of_a_row_and_of_bodies_that_turn() {
    let wave = graph(-0.5, 0.5, |x| {
        let (sin, cos) = (2.0 * PI * x).sin_cos();
        [0.01 * (1.0 - cos), 0.02 * PI * sin]
    });
    let body = parabola(6.0);
    let two = stack(&[(1.0, 0.3, 0.1), (1.0, 0.3, 0.2)], half_plane(5.0, 0.2));
    let one = layer(1.0, 0.3, 0.3, half_plane(5.0, 0.2));
    let row = |of: Foundation<f64>| {
        coated(&wave, of, RIGID).period(1.0).solve(Control::Load(0.005)).unwrap()
    };
    let [found, exact] = [row(two.clone().into()), row(one.into())];
    assert!((found.a() / exact.a() - 1.0).abs() < 1e-13, "{found} {exact}");
    let turned = |of: Foundation<f64>| {
        let control = Control::CentreOfPressure { load: 0.1, at: 0.25 };
        coated(&body, RIGID, of).solve(control).unwrap()
    };
    let [found, exact] = [turned(two.into()), turned(one.into())];
    assert!((found.a() / exact.a() - 1.0).abs() < 1e-13, "{found} {exact}");
    assert!((found.tilt() / exact.tilt() - 1.0).abs() < 1e-12, "{found} {exact}");
}

/// Random stacks meet Eq. (1) by sums of their own, with conditions at every interface.
#[test]
fn random_stacks_meet_the_equation() {
    let count = std::env::var("SCENES").ok().and_then(|count| count.parse().ok()).unwrap_or(12);
    let (mut refused, mut worst) = (0, 0.0f64);
    for seed in 0..count {
        let random = &mut Dice::new(8800 + seed);
        let number = 2 + (3.0 * random.uniform()) as usize;
        let layers: Vec<_> = (0..number)
            .map(|_| {
                let ratio = random.within(0.0, 0.5);
                (random.power_of_ten(-1.0, 1.0), ratio, random.power_of_ten(-1.0, 0.3))
            })
            .collect();
        let base = match (3.0 * random.uniform()) as usize {
            0 => Base::Bonded,
            1 => Base::Frictionless,
            _ => half_plane(random.power_of_ten(-1.0, 1.0), random.within(0.0, 0.5)),
        };
        let of = stack(&layers, base);
        let (wave, height) = (random.within(2.0, 6.0), random.within(0.0, 0.3));
        let slope = move |x: f64| x - height / wave * (wave * x + 1.0).sin();
        let body = graph(-12.0, 12.0, move |x| {
            [0.5 * x * x + height / (wave * wave) * (wave * x + 1.0).cos(), slope(x)]
        });
        let (modulus, ratio, _) = layers[0];
        let kappa = PI / 2.0 * modulus / (1.0 - ratio * ratio);
        let load = kappa * random.power_of_ten(-2.0, -0.5);
        let solution = match coated(&body, of.clone(), RIGID).solve(Control::Load(load)) {
            Ok(solution) => solution,
            Err(error) => {
                println!("{seed}: {error}");
                refused += 1;
                continue;
            }
        };
        let off = residual(&solution, kappa, &[(1.0, of.clone())], None, slope);
        worst = worst.max(off);
        // The rule of the sums is as exact as that.
        assert!(off < 5e-11, "{seed}: {off:e}, {of:?}");
        assert!(solution.certify().unwrap().is_proved(), "{seed}");
    }
    println!("{count} stacks, {refused} refused, Eq. (1) to {worst:.1e}");
    assert!(refused <= count / 100, "{refused}");
}

/// A rigid layer is a rigid base; what is not known below several layers is refused.
#[test]
fn what_a_stack_cannot_have() {
    let body = parabola(6.0);
    let solve = |of: Stack<f64>| coated(&body, of, RIGID).solve(Control::Load(0.5));
    let two = [(1.0, 0.3, 0.5), (2.0, 0.2, 0.5)];
    let mut on_rigid = stack(&two, Base::Frictionless);
    on_rigid.layers.insert(2, (RIGID, 1.0));
    on_rigid.layers.push((Material::elastic(1.0, 0.3), 1.0));
    let exact = solve(stack(&two, Base::Bonded)).unwrap();
    assert_eq!(solve(on_rigid).unwrap().intervals(), exact.intervals());
    let below = exact.subsurface_of(Body::Lower).map(|_| ()).unwrap_err();
    assert!(matches!(below, ContactError::Evaluation(EvaluationError::HalfPlanesOnly { .. })));
    assert!(below.to_string().contains("several layers"), "{below}");
    let soft = solve(stack(&two, half_plane(0.5, 0.3))).unwrap();
    let depth = soft.approach(&to(Reference::Depth(0.2))).unwrap_err();
    assert!(depth.to_string().contains("several layers"), "{depth}");
    for thickness in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let wrong = solve(stack(&[two[0], (1.0, 0.3, thickness)], Base::Bonded)).unwrap_err();
        assert!(matches!(wrong, ContactError::Input(InputError::InvalidThickness { .. })));
    }
    // Without layers it is its base.
    let bare = solve(stack(&[], half_plane(1.0, 0.3))).unwrap();
    let plain = coated(&body, Material::elastic(1.0, 0.3), RIGID);
    assert_eq!(bare.intervals(), plain.solve(Control::Load(0.5)).unwrap().intervals());
}
