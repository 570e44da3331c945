//! A pin in a hole: the closed form.

use crate::integrals::integral;
use linecontact::reference::{ClosedForm, Hertz, PinInHole, ReferenceError};
use linecontact::{ContactError, InputError, Interval, Material, PlaneState};
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
