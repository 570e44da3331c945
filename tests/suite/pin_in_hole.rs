//! A pin in a hole: the closed form, and what solutions for half-planes say of bodies that conform.

use crate::common::{NanSafe, graph};
use crate::integrals::integral;
use linecontact::profile::{Ellipse, Parabola};
use linecontact::reference::{ClosedForm, Hertz, PinInHole, ReferenceError};
use linecontact::{
    Base, Contact, ContactError, Control, Edge, Flat, InputError, Interval, Layer, Material,
    ParametricProfile, PlaneState, Solution,
};
use std::f64::consts::PI;

/// Like materials with E* = 1/2, so that the plane modulus of either is 1.
const LIKE: [Material<f64>; 2] =
    [Material::Elastic { youngs_modulus: 0.91, poisson_ratio: 0.3 }; 2];

fn under_load(
    clearance: f64,
    load: f64,
    materials: [Material<f64>; 2],
) -> Result<PinInHole<f64>, ContactError<f64>> {
    PinInHole::under_load(1.0, clearance, load, materials, PlaneState::Strain)
}

fn degrees(form: PinInHole<f64>) -> f64 {
    form.half_angle().to_degrees()
}

/// The values of an independent solution of the equation, from Michell's stress functions.
#[test]
fn half_angles_of_like_materials() {
    for (want, clearance) in [
        (5.0, 333.005_555_054_615_33),
        (20.0, 19.535_250_703_152_81),
        (45.0, 2.823_121_257_841_271),
        (70.0, 0.488_027_274_513_996_7),
        (80.0, 0.126_145_537_318_698_6),
        (84.827_945_649_400_3, 0.0),
        (86.0, -0.027_032_932_066_081_007),
        (100.0, -0.270_230_992_120_858_2),
        (120.0, -0.461_185_781_603_829_5),
    ] {
        for load in [1.0, 1e-3, 1e5] {
            let form = under_load(clearance * load, load, LIKE).unwrap();
            let off = degrees(form) / want - 1.0;
            assert!(off.abs() < 1e-15, "{want}°: {off:e}");
        }
        let stress = LIKE.map(|_| Material::elastic(1.0, 0.3));
        let form = PinInHole::under_load(1.0, clearance, 1.0, stress, PlaneState::Stress).unwrap();
        assert!((degrees(form) / want - 1.0).abs() < 1e-15);
    }
    // Nearly straight, and nearly all round.
    let form = under_load(1e200, 1.0, LIKE).unwrap();
    assert!((form.half_angle() / (4.0 / (PI * 0.5e200)).sqrt() - 1.0).abs() < 1e-15);
    assert!(degrees(under_load(-(2.0 / PI) * (1.0 - 1e-12), 1.0, LIKE).unwrap()) > 179.9);
}

/// With β = 0, against the formula by Dundurs' α = (E*_hole - E*_pin)/(E*_hole + E*_pin).
#[test]
fn half_angles_of_incompressible_materials() {
    let incompressible = |plane_modulus: f64| Material::elastic(0.75 * plane_modulus, 0.5);
    for ratio in [0.2f64, 3.0, 100.0] {
        let alpha = (ratio - 1.0) / (ratio + 1.0);
        for angle in [20.0f64, 60.0, 75.0, 110.0] {
            let u = (angle.to_radians() / 2.0).tan().powi(2);
            let falls = (alpha - 1.0) * (u.ln_1p() + 2.0 * u * u) + 2.0;
            let clearance = falls / (PI * (1.0 + alpha) * u * (u + 1.0));
            let materials = [incompressible(1.0), incompressible(ratio)];
            let off = degrees(under_load(clearance, 1.0, materials).unwrap()) / angle - 1.0;
            assert!(off.abs() < 4e-15, "{ratio}, {angle}°: {off:e}");
        }
    }
    for rigid in 0..2 {
        let pair = |material| {
            let mut pair = [incompressible(1.0); 2];
            pair[rigid] = material;
            degrees(under_load(0.3, 1.0, pair).unwrap())
        };
        let off = pair(incompressible(1e12)) / pair(Material::Rigid) - 1.0;
        assert!(off.abs() < 1e-11, "{off:e}");
    }
}

/// The pressures times R/Q, from 30 digits; those in the middle agree with the independent solution
/// to 13 digits.
#[test]
fn pressures() {
    for (angle, want) in [
        (5.0f64, [7.302_082_805_139_457, 6.323_781_642_389_045, 3.182_891_764_516_943_3]),
        (20.0, [1.852_391_002_696_727_2, 1.603_735_536_037_380_2, 0.806_654_994_984_575_6]),
        (45.0, [0.882_111_356_492_388_7, 0.758_546_085_571_389_6, 0.375_876_083_267_812_8]),
        (70.0, [0.649_550_421_907_086_1, 0.542_959_519_458_608, 0.252_581_408_652_794_4]),
        (120.0, [0.586_262_288_611_707_3, 0.420_252_719_942_760_4, 0.131_129_944_576_587_08]),
    ] {
        let angle = angle.to_radians();
        let form = PinInHole::new(2.0, angle).unwrap();
        for (part, want) in [0.0, 0.5, 0.9].into_iter().zip(want) {
            for theta in [part * angle, -part * angle] {
                let off = 2.0 * form.pressure(theta) / want - 1.0;
                assert!(off.abs() < 3e-15, "{angle}, {part}: {off:e}");
            }
        }
        assert_eq!(form.pressure(angle), 0.0);
        assert_eq!(form.pressure(-angle.next_up()), 0.0);
        assert!(form.pressure(f64::NAN).is_nan());
    }
    // All round, (1 + cos θ)/π.
    let round = PinInHole::new(1.0, PI.next_down()).unwrap();
    for theta in [0.0f64, 1.0, -2.0, 3.0] {
        assert!((round.pressure(theta) - (1.0 + theta.cos()) / PI).abs() < 1e-15);
    }
}

#[test]
fn the_pressure_bears_the_load() {
    let (radius, load) = (3.0, 7.0);
    for clearance in [1e4, 300.0, 20.0, 1.0, 0.0, -3.0, -4.4] {
        let form = PinInHole::under_load(radius, clearance, load, LIKE, PlaneState::Strain);
        let form = form.unwrap();
        let half = form.half_angle();
        let on = Interval { left: -half, right: half };
        let upward = |theta: f64| radius * form.pressure(theta) * theta.cos();
        let borne = integral(on, &[0.0], |x| upward(x) * on.chebyshev_weight(x));
        assert!((borne / load - 1.0).abs() < 1e-14, "{clearance}: {borne}");
    }
}

/// Small arcs are Hertz's contact of parabolas.
#[test]
fn a_small_arc_is_that_of_half_planes() {
    let (radius, load, kappa) = (2.0, 1e-3, PI / 4.0);
    for clearance in [1.0, 1e3, 1e9] {
        let form = PinInHole::under_load(radius, clearance, load, LIKE, PlaneState::Strain);
        let form = form.unwrap();
        let hertz = Hertz::under_load(radius * radius / clearance, load, kappa).unwrap();
        let half_width = hertz.limits().right;
        let square = form.half_angle().powi(2);
        assert!((half_width / radius / form.half_angle() - 1.0).abs() < square + 1e-15);
        for part in [0.0, 0.6, 0.9] {
            let hertz = hertz.pressure(part * half_width, kappa);
            let pressure = form.pressure(part * form.half_angle());
            assert!((pressure / hertz - 1.0).abs() < square + 4e-15, "{clearance}, {part}");
        }
    }
}

#[test]
fn what_is_no_pin_in_a_hole_is_refused() {
    let clearance = |form: Result<PinInHole<f64>, _>| match form {
        Err(ContactError::Input(InputError::ClosedForm(ReferenceError::Parameter {
            name,
            value,
            ..
        }))) => {
            assert_eq!(name, "the clearance");
            value
        }
        other => panic!("{other:?}"),
    };
    // An interference all round, from 2 Q/(π E*_hole) on.
    let least = -2.0 / PI;
    assert_eq!(clearance(under_load(1.001 * least, 1.0, LIKE)), 1.001 * least);
    assert!(under_load(0.999 * least, 1.0, LIKE).is_ok());
    assert!(clearance(under_load(f64::NAN, 1.0, LIKE)).is_nan());
    let rubber = Material::elastic(1.0, 0.5);
    assert_eq!(clearance(under_load(0.0, 1.0, [rubber, Material::Rigid])), 0.0);
    assert!(under_load(0.0, 1.0, [Material::Rigid, rubber]).is_ok());

    let named = |radius, load| {
        let form = PinInHole::under_load(radius, 0.1, load, LIKE, PlaneState::Strain);
        form.unwrap_err().to_string()
    };
    for wrong in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(named(wrong, 1.0).starts_with("the radius is"));
        assert!(named(1.0, wrong).starts_with("the load is"));
        assert!(PinInHole::new(wrong, 1.0).is_err() && PinInHole::new(1.0, wrong).is_err());
    }
    assert!(PinInHole::new(1.0, PI).is_err());
    // Too small a load for any angle.
    assert!(named(1.0, f64::from_bits(1)).starts_with("the half-angle is 0"));

    // E alike, ν 0.3 and 0: β of the golden values.
    let pair = [Material::elastic(1.0, 0.3), Material::elastic(1.0, 0.0)];
    for (materials, want) in [
        (pair, 0.125_654_450_261_780_07),
        ([pair[0], Material::elastic(1e9, 0.3)], -0.285_714_285_142_857_2),
        ([pair[0], Material::Rigid], -2.0 / 7.0),
    ] {
        match under_load(0.1, 1.0, materials) {
            Err(ContactError::Input(InputError::UnlikeBodies { beta })) => {
                assert!((beta / want - 1.0).abs() < 1e-14, "{beta}");
            }
            other => panic!("{other:?}"),
        }
    }
    let error = under_load(0.1, 1.0, [Material::elastic(1.0, 0.6), pair[0]]).unwrap_err();
    assert!(matches!(error, ContactError::Input(InputError::InvalidPoissonRatio { .. })));
    let error = under_load(0.1, 1.0, [Material::Rigid; 2]).unwrap_err();
    assert_eq!(error, ContactError::Input(InputError::BothRigid));
}

const RADIUS: f64 = 10.0;
const CLEARANCE: f64 = 1e-3;

fn pin_under(load: f64) -> PinInHole<f64> {
    PinInHole::under_load(RADIUS, CLEARANCE, load, LIKE, PlaneState::Strain).unwrap()
}

/// Half-angles in degrees, and the percent by which the peak of Hertz's formulas is too low.
const PARABOLAS: [(f64, f64); 4] = [(10.0, 1.2), (20.0, 4.8), (30.0, 10.8), (45.0, 24.0)];

/// Returns the load of a half-angle in degrees.
fn load_at(angle: f64) -> f64 {
    let (mut low, mut high) = (1e-12, 1.0);
    for _ in 0..100 {
        let middle = f64::sqrt(low * high);
        if degrees(pin_under(middle)) < angle { low = middle } else { high = middle }
    }
    low
}

#[test]
fn hertz_in_place_of_the_hole() {
    for (angle, percent) in PARABOLAS {
        let load = load_at(angle);
        let hertz = (0.5 * load * CLEARANCE / PI).sqrt() / RADIUS;
        let too_low = 100.0 * (1.0 - hertz / pin_under(load).pressure(0.0));
        assert!((too_low - percent).abs() < 0.05, "{angle}°: {too_low}");
    }
}

/// Returns the share by which the pressure in the middle is too low beside that of the pin in its
/// hole, which is the largest there. (From 38° on half-planes have larger ones beside it.)
fn real(solution: &Solution<'_, f64>) -> f64 {
    let pressure = solution.pressure().unwrap().at(0.0).unwrap();
    1.0 - pressure / pin_under(solution.load()).pressure(0.0)
}

fn solved([lower, upper]: [&dyn ParametricProfile<f64>; 2], half_width: f64) -> Solution<'_, f64> {
    let [hole, pin] = LIKE;
    let contact = Contact::new(lower, upper).unwrap();
    let contact = contact.materials(hole, pin, PlaneState::Strain);
    contact.solve(Control::HalfWidth(half_width)).unwrap()
}

/// Solutions for half-planes say how far they are from the closed form, whether the pin lies in the
/// hole or the hole on the pin.
#[test]
fn a_solution_says_what_conformity_costs() {
    let circle = |radius: f64| Ellipse::circle(radius, [-1.5, 1.5]).unwrap();
    let (pin, hole) = (circle(RADIUS), circle(RADIUS + CLEARANCE));
    let [pin_below, hole_above] = [RADIUS, RADIUS + CLEARANCE].map(|r| {
        graph(-9.9, 9.9, move |x| {
            let y = (r * r - x * x).sqrt();
            [y, -x / y]
        })
    });
    for angle in [5.0f64, 9.0, 9.2, 10.0, 20.0, 30.0, 45.0, 60.0] {
        let half_width = RADIUS * angle.to_radians().sin();
        let mut differ = 0.0f64;
        for bodies in [[&hole as &dyn ParametricProfile<f64>, &pin], [&*pin_below, &*hole_above]] {
            let solution = solved(bodies, half_width);
            let text = solution.to_string();
            let Some(found) = solution.conformity() else {
                assert!(angle < 9.1 && !text.contains("conform"), "{text}");
                continue;
            };
            assert!(angle > 9.1);
            assert!((found.angle.to_degrees() - angle).abs() < 2e-2, "{}", found.angle);
            let real = real(&solution);
            differ = differ.nan_max((found.too_low / real - 1.0).abs());
            let said = [found.too_low, found.parabolas_too_low].map(|share| 100.0 * share);
            if let Some((_, percent)) = PARABOLAS.into_iter().find(|row| row.0 == angle) {
                assert!((said[1] - percent).abs() < 0.06, "{angle}°: {}", said[1]);
            }
            let said = format!("{:.1} % too low, {:.1} % if parabolas", said[0], said[1]);
            assert!(
                text.contains(&said) && text.contains(&format!("with {angle:.1}° at")),
                "{text}"
            );
            assert_eq!(text.contains("steep"), solution.is_steep(), "{text}");
            println!("{angle}°: {:.3} % said, {:.3} % real", 100.0 * found.too_low, 100.0 * real);
        }
        assert!(differ < 0.013, "{angle}°: {differ}");
    }
}

/// Parabolas in place of the circles are Hertz's, whose error is larger.
#[test]
fn parabolas_in_place_of_circles() {
    let parabola = |radius: f64| Parabola::new(radius, [-20.0, 20.0]).unwrap();
    let (pin, hole) = (parabola(RADIUS), parabola(RADIUS + CLEARANCE));
    for (angle, percent) in PARABOLAS {
        let [lower, upper] = LIKE;
        let contact = Contact::new(&hole, &pin).unwrap();
        let contact = contact.materials(lower, upper, PlaneState::Strain);
        let solution = contact.solve(Control::Load(load_at(angle))).unwrap();
        let found = solution.conformity().unwrap();
        println!("{angle}°: {found}, {:.3} % real", 100.0 * real(&solution));
        assert!((100.0 * real(&solution) - percent).abs() < 0.06);
        assert!((found.angle.to_degrees() / angle - 1.0).abs() < 0.04);
        assert!((found.parabolas_too_low / real(&solution) - 1.0).abs() < 0.08);
    }
}

#[test]
fn bodies_that_do_not_conform() {
    let circle = |radius: f64| Ellipse::circle(radius, [-1.5, 1.5]).unwrap();
    let (pin, hole, groove) = (circle(RADIUS), circle(RADIUS + CLEARANCE), circle(500.0));
    let roller = graph(-9.0, 9.0, |x| [-x * x / 20.0, -x / 10.0]);
    let flank = |side: f64, radius: f64| {
        graph(-9.0, 9.0, move |x| [side * x + x * x / radius / 2.0, side + x / radius])
    };
    let flanks = [-1.0, 1.0].map(|side| [RADIUS + CLEARANCE, RADIUS].map(|r| flank(side, r)));
    // A groove along the bottom of the hole, over which the pin rests on two contacts.
    let parted = graph(-9.0, 9.0, |x| {
        let (radius, groove) = (RADIUS + CLEARANCE, 1e-3 * (-x * x).exp());
        [x * x / radius / 2.0 - groove, x / radius + 2.0 * x * groove]
    });
    let whole = Parabola::new(RADIUS, [-9.0, 9.0]).unwrap();
    let scenes: [(&str, [&dyn ParametricProfile<f64>; 2]); 6] = [
        ("over a groove", [&*parted, &whole]),
        ("on a flat", [&Flat, &pin]),
        ("on another roller", [&*roller, &pin]),
        ("in a wide groove", [&groove, &pin]),
        ("on the left flank", flanks[0].each_ref().map(|flank| &**flank as _)),
        ("on the right flank", flanks[1].each_ref().map(|flank| &**flank as _)),
    ];
    for (name, bodies) in scenes {
        let solution = solved(bodies, 4.0);
        assert_eq!(solution.conformity(), None, "{name}");
        let text = solution.to_string();
        assert!(text.contains("steep") && !text.contains("conform"), "{name}: {text}");
    }

    // Not half-planes, and corners at which the pressure is infinite anyway.
    let rubber = Material::elastic(1.0, 0.3);
    let layer = Layer { material: rubber, thickness: 5.0, base: Base::Bonded };
    let contact = Contact::new(&hole, &pin).unwrap();
    let layered = contact.clone().materials(layer, Material::Rigid, PlaneState::Strain);
    let solution = layered.solve(Control::Load(1e-4)).unwrap();
    assert!(solution.is_steep() && solution.conformity().is_none(), "{solution}");
    let held = contact.edges(Edge::Fixed(-4.0), Edge::Fixed(4.0));
    let solution = held.solve(Control::Load(1.0)).unwrap();
    assert!(solution.is_steep() && solution.conformity().is_none(), "{solution}");
}
