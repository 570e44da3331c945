//! Largest stresses below and along a contact that slips, in part or all over: against closed
//! forms for Hertz's pressure, a quadrature of mpmath, the equation of the contact, and scans.
#![allow(missing_docs)]

use crate::common::{Profile, graph, join, quartic, worst};
use crate::forms::KAPPA;
use linecontact::profile::{Ellipse, Parabola, Spline, rounded_punch, wedge};
use linecontact::reference::{
    Biquadratic, ClosedForm, FlatPunch, Hertz, UnequalRadii, body as body_of,
};
use linecontact::stress::{Stress, StressPeak};
use linecontact::{
    Body, Contact, ContactError, Control, Edge, EvaluationError, Extremum, Flat, InputError,
    Midpoint, ParametricProfile, PartialSlip, Shear,
};
use std::f64::consts::PI;

const BODIES: [(Body, f64); 2] = [(Body::Lower, 1.0), (Body::Upper, -1.0)];

/// Presses a parabola of radius 1 on a flat, with E* = 1 and the load 0.1, and passes partial slip
/// on, with p₀ and the half-width.
fn hertz(friction: f64, share: f64, tension: f64, look: impl FnOnce(&PartialSlip<f64>, f64, f64)) {
    let body = Parabola::new(1.0, [-1.0, 1.0]).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap().contact_modulus(1.0);
    let shear = Shear { friction, force: share * friction * 0.1, tension };
    let slip = contact.partial_slip(Control::Load(0.1), shear).unwrap();
    let half_width = (0.4 / PI).sqrt();
    look(&slip, 0.2 / (PI * half_width), half_width);
}

/// Under sliding friction the equation of the contact gives σ_x = -P - 2 μ κ g/π on the surface, so
/// that a free trailing limit is stretched by 2 μ κ |g|/π: by 2 μ p₀ under Hertz's pressure
/// (Johnson, §7.1), as κ g = π p₀ x/L.
#[test]
fn a_body_that_slides_is_stretched_at_its_trailing_limit() {
    let check =
        |form: &dyn ClosedForm<f64>, profile: &dyn ParametricProfile<f64>, peak: Option<f64>| {
            let contact = Contact::new(&Flat, profile).unwrap().kappa(KAPPA);
            let solution = contact.solve(Control::Load(form.load(KAPPA))).unwrap();
            for friction in [0.05, 0.3, 1.0, -0.3] {
                let below = solution.subsurface().unwrap().friction(friction).unwrap();
                let on = below.hull();
                let trailing = if friction > 0.0 { on.left } else { on.right };
                let stretched = 2.0 * friction.abs() / PI * KAPPA * form.slope(trailing).abs();
                let Extremum { x, value } = below.max_tension().unwrap();
                assert_eq!(x, trailing);
                assert!((value / stretched - 1.0).abs() < 1e-13, "{friction}: {value} {stretched}");
                if let Some(peak) = peak {
                    assert!((value / (2.0 * friction.abs() * peak) - 1.0).abs() < 1e-13);
                }
            }
            // Without friction there is none.
            assert_eq!(solution.subsurface().unwrap().max_tension().unwrap().value.abs(), 0.0);
        };
    let form = Hertz::new(2.0, 0.3).unwrap();
    let peak = form.pressure(0.0, KAPPA);
    check(&form, &body_of(&form, -1.0, 1.0).unwrap(), Some(peak));
    let form = Biquadratic::new(1.0, 5.0, 0.4).unwrap();
    check(&form, &body_of(&form, -1.0, 1.0).unwrap(), None);
    let form = UnequalRadii::under_load(1.0, 0.2, 0.05, KAPPA).unwrap();
    check(&form, &body_of(&form, -1.0, 1.0).unwrap(), None);
}

/// Cattaneo and Mindlin's traction is the difference of two that slide: μ p₀ over a, and μ p₀ c/a
/// over c. For `p sqrt(1 - t²)`, t = x/r, the integral `PV∫ P(s)/(x - s) ds` is π p t inside and
/// π p (t - sign(t) sqrt(t² - 1)) outside. At x = -a, where P = 0,
///
/// ```text
/// σ_x = -2 μ p₀ (-1 + c/a (a/c - sqrt(a²/c² - 1))) = 2 μ p₀ sqrt(1 - c²/a²) = 2 μ p₀ sqrt(Q/(μF))
/// ```
#[test]
fn cattaneo_and_mindlin_stretch_the_trailing_limit() {
    for share in [1e-6, 1e-3, 0.1, 0.5, 0.9, 0.999, 0.999_999, -0.3, -0.99] {
        hertz(0.4, share, 0.0, |slip, peak, a| {
            for (body, sign) in BODIES {
                let below = slip.subsurface(body).unwrap();
                let Extremum { x, value } = below.max_tension().unwrap();
                assert!((x / a + sign * share.signum()).abs() < 1e-14);
                let exact = 0.8 * peak * share.abs().sqrt();
                // The distance from the limit to the stick zone has the rounding of both.
                let error = (value / exact - 1.0).abs() * share.abs();
                assert!(error < 1e-15 + 1e-14 * share.abs(), "{share}: {error:e}");
                assert_eq!(below.at(x, 0.0).unwrap().sigma_x, value);
            }
        });
    }
}

/// A tension σ moves the stick zone by e = σ a/(4 μ p₀) (Nowell and Hills 1987). As above, with
/// t = (x - e)/c for the stick zone, the trailing limit of the lower body is stretched by
/// `2 μ p₀ sqrt((a + e)² - c²)/a - σ/2`, besides its own tension.
#[test]
fn a_tension_changes_the_stretch_of_the_trailing_limit() {
    for (share, shift) in [(0.5, 0.1), (0.5, -0.1), (0.2, 0.04), (0.9, 0.3)] {
        hertz(0.4, share, shift * 1.6 * 0.2 / (0.4 * PI).sqrt(), |slip, peak, _| {
            let found = slip.subsurface(Body::Lower).unwrap().max_tension().unwrap();
            let exact = 0.8 * (((1.0f64 + shift).powi(2) - (1.0 - share)).sqrt() - shift);
            assert!((found.value / peak / exact - 1.0).abs() < 1e-13, "{share} {shift}");
            assert_eq!(found.x, -slip.normal().b());
        });
    }
}

/// The same by the quadrature of mpmath, rounded from 18 digits, of `2/π ∫ q(s)/(s - x) ds` at the
/// trailing limit over the traction of Cattaneo and Mindlin or of Nowell and Hills.
#[test]
fn a_quadrature_of_the_stretch() {
    for (share, shift, exact) in [
        (0.5, 0.0, 0.565_685_424_949_238),
        (0.9, 0.0, 0.758_946_638_440_411),
        (0.01, 0.0, 0.08),
        (0.5, 0.1, 0.594_091_981_854_108_7),
        (0.5, -0.1, 0.525_421_149_026_401_8),
    ] {
        hertz(0.4, share, shift * 1.6 * 0.2 / (0.4 * PI).sqrt(), |slip, peak, _| {
            let found = slip.subsurface(Body::Lower).unwrap().max_tension().unwrap();
            assert!((found.value / peak / exact - 1.0).abs() < 1e-13, "{share} {shift}");
        });
    }
}

/// With s² = Q/(μF) = 1 - c²/a², the difference of the surface stresses in a slip zone is
/// `2 μ p₀ sqrt(x² - c²)/a`, and the shear stress μ P: so the largest shear in the plane is μ p₀ s
/// all over both slip zones. At the leading side the sum of the stresses is largest where
/// x² = (c² + μ² a²)/(1 + μ²): there the von Mises stress is
/// `p₀ s sqrt((1 - 2ν)² (1 + μ²) + 3 μ²)`. For strong friction nothing below is larger.
#[test]
fn strong_friction_has_its_largest_stress_in_a_slip_zone() {
    for (friction, share) in [(0.9, 0.9), (0.9, 0.999), (2.0, 0.3), (2.0, -0.9), (50.0, 0.01)] {
        hertz(friction, share, 0.0, |slip, peak, a| {
            let s = f64::abs(share).sqrt();
            for (body, sign) in BODIES {
                let below = slip.subsurface(body).unwrap();
                let shear = below.max_shear().unwrap();
                let stick = slip.stick_zones()[0].right;
                let exact = friction * peak * s;
                println!("{friction} {share}: {shear:?} {:e}", shear.value / exact - 1.0);
                assert!((shear.value / exact - 1.0).abs() < 1e-12, "{friction} {share}: {shear:?}");
                assert!(shear.depth < 1e-6 * a && shear.x.abs() >= stick * (1.0 - 1e-6));
                for poisson in [0.0, 0.3, 0.5] {
                    let mises = below.max_von_mises(poisson).unwrap();
                    let exact = peak
                        * s
                        * ((1.0 - 2.0 * poisson).powi(2) * (1.0 + friction.powi(2))
                            + 3.0 * friction.powi(2))
                        .sqrt();
                    assert!((mises.value / exact - 1.0).abs() < 1e-12, "{poisson}: {mises:?}");
                    let leading = sign
                        * f64::signum(share)
                        * a
                        * ((1.0 - s * s + friction.powi(2)) / (1.0 + friction.powi(2))).sqrt();
                    assert!(poisson == 0.5 || (mises.x / leading - 1.0).abs() < 1e-6, "{mises:?}");
                }
            }
        });
    }
}

/// Next to an edge the paper's rule has no correct digit of the pressure; the stress has all.
#[test]
fn the_rule_that_found_the_contact_does_not_matter() {
    let body = Parabola::new(1.0, [-1.0, 1.0]).unwrap();
    let rule = Midpoint { segments: 20, ..Midpoint::DEFAULT };
    let contact = Contact::new(&Flat, &body).unwrap().contact_modulus(1.0).quadrature(&rule);
    let shear = Shear { friction: 0.9, force: 0.9 * 0.09, tension: 0.0 };
    let slip = contact.partial_slip(Control::Load(0.1), shear).unwrap();
    let peak = 0.2 / (0.1 * 4.0 * PI).sqrt();
    let below = slip.subsurface(Body::Lower).unwrap();
    let s = 0.9f64.sqrt();
    let sliding = slip.normal().subsurface().unwrap().friction(0.9).unwrap();
    let without = slip.normal().subsurface().unwrap();
    for (found, exact) in [
        (below.max_shear().unwrap().value, 0.9 * peak * s),
        (below.max_tension().unwrap().value, 1.8 * peak * s),
        (sliding.max_shear().unwrap().value, 0.9 * peak),
        (sliding.max_tension().unwrap().value, 1.8 * peak),
        (without.max_von_mises(0.0).unwrap().value, peak),
    ] {
        assert!((found / exact - 1.0).abs() < 1e-9, "{found} {exact}");
    }
}

/// Without a tangential force, or nearly so, it is Hertz's contact (Johnson, Eq. 4.47).
#[test]
fn without_a_force_it_is_the_contact_without_friction() {
    for share in [0.0, 1e-11, -1e-9] {
        hertz(0.4, share, 0.0, |slip, peak, a| {
            let without = slip.normal().subsurface().unwrap();
            for (body, _) in BODIES {
                let below = slip.subsurface(body).unwrap();
                let shear = below.max_shear().unwrap();
                assert!((shear.value / peak - 0.300_283_1).abs() < 1e-7, "{shear:?}");
                assert!((shear.depth / a - 0.786_151_4).abs() < 1e-6, "{shear:?}");
                let mises = [below.max_von_mises(0.3), without.max_von_mises(0.3)];
                let [with, without] = mises.map(|mises| mises.unwrap().value);
                assert!((with / without - 1.0).abs() < 1e-14 + share.abs(), "{with} {without}");
                let tension = below.max_tension().unwrap().value;
                assert!(tension <= 0.801 * peak * share.abs().sqrt(), "{share}: {tension:e}");
            }
        });
    }
}

/// Returns a narrow bump on a wide body.
fn bump() -> Profile {
    graph(-3.0, 3.0, |x| {
        let bell = (-(x / 0.1).powi(2)).exp();
        [x * x / 40.0 - 0.004 * bell, x / 20.0 + 0.8 * x * bell]
    })
}

/// Returns bodies and loads.
fn scenes() -> Vec<(&'static str, Profile, f64)> {
    let points: Vec<[f64; 2]> = (-40..=40)
        .map(|i| 0.025 * f64::from(i))
        .map(|x| [x, x * x / 2.0 + 0.004 * (9.0 * x + 0.5).sin()])
        .collect();
    let lopsided = |x: f64| [x * x / 2.0 + x.powi(3) / 6.0, x + x * x / 2.0];
    vec![
        ("circle", Box::new(Ellipse::circle(1.0, [-1.5, 1.5]).unwrap()), 0.3),
        ("lopsided", graph(-1.5, 1.5, lopsided), 0.2),
        ("two contacts", quartic(-2.5, 2.5), 0.5),
        ("two that are one", quartic(-2.5, 2.5), 4.0),
        ("rounded punch", Box::new(rounded_punch(1.0, 0.1, 1.8).unwrap()), 0.05),
        ("bump", bump(), 0.0057),
        ("spline", Box::new(Spline::through(&points).unwrap()), 0.05),
    ]
}

/// Reversing the force mirrors the places below a symmetric body, and is the same as to look at the
/// other body.
#[test]
fn a_reversed_force_mirrors_the_places() {
    for (name, profile, load) in scenes() {
        let contact = Contact::new(&Flat, &*profile).unwrap().contact_modulus(1.0);
        let [there, back] = [0.5, -0.5].map(|share| {
            let shear = Shear { friction: 0.2, force: share * 0.2 * load, tension: 0.0 };
            contact.partial_slip(Control::Load(load), shear).unwrap()
        });
        let found = |slip: &PartialSlip<f64>, body| {
            let below = slip.subsurface(body).unwrap();
            let Extremum { x, value } = below.max_tension().unwrap();
            let tension = StressPeak { x, depth: 0.0, value };
            [below.max_shear().unwrap(), below.max_von_mises(0.3).unwrap(), tension]
        };
        assert_eq!(found(&there, Body::Lower), found(&back, Body::Upper));
        if name == "lopsided" || name == "spline" {
            continue;
        }
        let size = there.normal().hull().half_width();
        let reversed = found(&back, Body::Lower);
        for (one, other) in found(&there, Body::Lower).into_iter().zip(reversed) {
            assert!((one.value / other.value - 1.0).abs() < 1e-13, "{name}: {one:?} {other:?}");
            let off = worst([one.x + other.x, one.depth - other.depth].map(f64::abs)) / size;
            assert!(off < 1e-6, "{name}: {one:?} {other:?}");
        }
    }
}

/// Returns places and depths graded to the surface and to the limits of contacts and stick zones.
fn scan(slip: &PartialSlip<f64>) -> Vec<[f64; 2]> {
    let zones = slip.normal().intervals().iter().chain(slip.stick_zones());
    let limits: Vec<f64> = zones.flat_map(|on| [on.left, on.right]).collect();
    let mut places = Vec::new();
    for on in slip.normal().intervals() {
        let along = |i: i32, n: i32| on.at_angle(PI * (f64::from(i) + 0.5) / f64::from(n));
        places.extend((0..4000).map(|i| [along(i, 4000), 0.0]));
        for i in 0..60 {
            let depth = on.half_width() * 10f64.powf(0.5 - 0.1 * f64::from(i));
            places.extend((0..120).map(|j| [along(j, 120), depth]));
            for away in [-2.0, -1.0, -0.5, -0.2, 0.0, 0.2, 0.5, 1.0, 2.0] {
                places.extend(limits.iter().map(|x| [x + away * depth, depth]));
                places.extend(limits.iter().map(|x| [x + away * depth, 0.0]));
            }
        }
    }
    places
}

#[test]
fn no_stress_of_a_scan_is_above_the_largest() {
    for (name, profile, load) in scenes() {
        let contact = Contact::new(&Flat, &*profile).unwrap().contact_modulus(1.0);
        for (friction, share) in
            [(0.2, 1e-6), (0.2, 0.5), (0.5, 0.9), (0.5, -0.999), (1.5, 0.3), (0.3, 0.999_999)]
        {
            let shear = Shear { friction, force: share * friction * load, tension: 0.0 };
            let slip = contact.partial_slip(Control::Load(load), shear).unwrap();
            let places = scan(&slip);
            for (body, _) in BODIES {
                let below = slip.subsurface(body).unwrap();
                let at = |[x, depth]: [f64; 2]| below.at(x, depth).unwrap();
                let stresses: Vec<Stress<f64>> = places.iter().map(|&place| at(place)).collect();
                let compare = |kind, peak: StressPeak<f64>, of: &dyn Fn(&Stress<f64>) -> f64| {
                    let there = of(&at([peak.x, peak.depth]));
                    assert!((there / peak.value - 1.0).abs() < 1e-7, "{name} {kind} {peak:?}");
                    let (i, highest) =
                        stresses.iter().map(of).enumerate().fold((0, 0.0), |best, (i, value)| {
                            if value > best.1 { (i, value) } else { best }
                        });
                    let above = highest / peak.value - 1.0;
                    let place = places[i];
                    assert!(
                        above < 1e-9,
                        "{name} {friction} {share} {kind}: {peak:?}, but {highest} at {place:?}"
                    );
                };
                compare("shear", below.max_shear().unwrap(), &Stress::max_shear);
                let mises = below.max_von_mises(0.3).unwrap();
                compare("von Mises", mises, &|stress| stress.von_mises(0.3).unwrap());
                let Extremum { x, value } = below.max_tension().unwrap();
                let surface = |stress: &Stress<f64>| stress.sigma_x;
                let top = places.iter().zip(&stresses).filter(|(place, _)| place[1] == 0.0);
                let top = top.map(|(_, stress)| surface(stress)).fold(0.0, f64::max);
                assert!(top / value - 1.0 < 1e-9, "{name} {friction} {share}: {value} {top} {x}");
                assert_eq!(at([x, 0.0]).sigma_x, value);
            }
        }
    }
}

/// Beside a bump that has just come to rest on its flanks the pressure nearly vanishes, while the
/// surface is still stretched by the bump. By the equation of the contact σ_x = -P - 2 μ κ g/π.
#[test]
fn a_surface_may_be_stretched_most_inside() {
    let slope = |x: f64| x / 20.0 + 0.8 * x * (-(x / 0.1).powi(2)).exp();
    for load in [0.0044, 0.0057] {
        let body = bump();
        let contact = Contact::new(&Flat, &*body).unwrap().contact_modulus(1.0);
        let solution = contact.solve(Control::Load(load)).unwrap();
        let pressure = solution.pressure().unwrap();
        assert_eq!(solution.intervals().len(), 1);
        let below = solution.subsurface().unwrap().friction(0.5).unwrap();
        let Extremum { x, value } = below.max_tension().unwrap();
        assert!(x > -0.5 * solution.b() && value > 0.5 * slope(solution.b()));
        // μ κ/π is 1/4 here: twice that is 1/2.
        let tension = |x: f64| -pressure.at(x).unwrap() - 0.5 * slope(x);
        let highest = (-100_000..0).map(|i| x * (1.0 + 1e-6 * f64::from(i))).map(tension);
        let highest = highest.fold(0.0, f64::max);
        assert!((value / tension(x) - 1.0).abs() < 1e-12);
        assert!((value / highest - 1.0).abs() < 1e-11, "{load}: {value} {highest}");
    }
}

fn infinite<V: std::fmt::Debug>(refused: Result<V, ContactError<f64>>, at: f64) {
    let error = refused.unwrap_err();
    assert_eq!(error, ContactError::Evaluation(EvaluationError::Singular { x: at }));
}

/// At a tip the pressure is infinite, but not the traction q₀ where the bodies stick. Below the tip
/// of a wedge the shear has the parts `t sin²φ` and `t sin φ cos φ + q₀`, with t = 2 κ m/π² and φ
/// the angle from the surface. The larger root of `s² - t s - q₀² = 0` is the largest of all φ.
/// With P = t arcosh(L/x), and a stick zone of half the width, q₀ = μ t ln 2.
#[test]
fn a_tip_that_sticks_has_a_finite_shear() {
    let body = wedge([-0.1, 0.1], 9.0).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap().kappa(KAPPA);
    for friction in [0.01, 0.1, 0.3] {
        let shear = Shear { friction, force: 0.15 * friction, tension: 0.0 };
        let slip = contact.partial_slip(Control::Load(0.3), shear).unwrap();
        let below = slip.subsurface(Body::Lower).unwrap();
        let (t, q) = (0.2 * KAPPA / PI.powi(2), friction * 2f64.ln());
        let exact = 0.5 * t * (1.0 + (1.0 + 4.0 * q * q).sqrt());
        let largest = below.max_shear().unwrap();
        assert!((largest.value / exact - 1.0).abs() < 1e-8, "{friction}: {largest:?} {exact}");
        infinite(below.max_von_mises(0.3), 0.0);
        let mises = below.max_von_mises(0.5).unwrap();
        assert!((mises.value / (3f64.sqrt() * largest.value) - 1.0).abs() < 1e-14);
        // 2 μ κ/π times the slope, less that of the stick zone: m (1 - 2/π arcsin(c/a)).
        let exact = 2.0 * friction / PI * KAPPA * 0.1 * (1.0 - 2.0 / PI * 0.5f64.asin());
        let tension = below.max_tension().unwrap().value;
        assert!((tension / exact - 1.0).abs() < 1e-13, "{tension} {exact}");
    }
}

#[test]
fn a_tip_that_slips_and_a_corner_have_infinite_shear() {
    // The slope jumps at 0 and, by less, at 0.3, which bears only the larger load.
    let body = join(vec![
        graph(-3.0, 0.0, |x| [-0.2 * x, -0.2]),
        graph(0.0, 0.3, |x| [0.1 * x, 0.1]),
        graph(0.3, 3.0, |x| [0.03 + 0.2 * (x - 0.3), 0.2]),
    ]);
    let contact = Contact::new(&Flat, &*body).unwrap().contact_modulus(1.0);
    for (share, sticks) in [(0.9, false), (0.05, true)] {
        let shear = Shear { friction: 0.3, force: share * 0.3 * 0.1, tension: 0.0 };
        let slip = contact.partial_slip(Control::Load(0.1), shear).unwrap();
        let below = slip.subsurface(Body::Upper).unwrap();
        assert!(slip.normal().hull().contains(0.3));
        assert_eq!(slip.stick_zones()[0].contains(0.3), sticks);
        let shear = below.max_shear();
        if sticks {
            shear.unwrap();
        } else {
            infinite(shear, 0.3);
        }
        infinite(below.max_von_mises(0.3), 0.0);
        assert!(below.max_tension().unwrap().value > 0.0);
        let error = below.max_von_mises(0.6).unwrap_err();
        let is_ratio = |error: &_| {
            matches!(error, ContactError::Input(InputError::InvalidPoissonRatio { ratio: 0.6, .. }))
        };
        assert!(is_ratio(&error), "{error}");
    }

    let form = FlatPunch::under_load(0.5, 0.0, 0.7, KAPPA).unwrap();
    let punch = body_of(&form, -1.0, 1.0).unwrap();
    let [left, right] = form.edges();
    let contact = Contact::new(&Flat, &punch).unwrap().kappa(KAPPA).edges(left, right);
    let shear = Shear { friction: 0.3, force: 0.1, tension: 0.0 };
    let slip = contact.partial_slip(Control::Load(0.7), shear).unwrap();
    let below = slip.subsurface(Body::Lower).unwrap();
    infinite(below.max_shear(), 0.5);
    infinite(below.max_von_mises(0.3), 0.5);
    // It slides towards the right: only the left corner is stretched.
    infinite(below.max_tension(), -0.5);
    infinite(slip.subsurface(Body::Upper).unwrap().max_tension(), 0.5);
    let pressed = Shear { force: 0.0, ..shear };
    let slip = contact.partial_slip(Control::Load(0.7), pressed).unwrap();
    assert_eq!(slip.traction().unwrap().at(0.1).unwrap(), 0.0);
    assert_eq!(slip.subsurface(Body::Lower).unwrap().max_tension().unwrap().value, 0.0);

    // One corner, which leads or trails.
    let body = Parabola::new(2.0, [-1.0, 1.0]).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap().kappa(KAPPA);
    let contact = contact.edges(Edge::Free, Edge::Fixed(0.2));
    let solution = contact.solve(Control::Load(0.1)).unwrap();
    let below = |friction| solution.subsurface().unwrap().friction(friction).unwrap().max_tension();
    let Extremum { x, value } = below(0.3).unwrap();
    assert_eq!(x, -solution.b());
    assert!((value / (0.6 / PI * KAPPA * solution.b() / 2.0) - 1.0).abs() < 1e-13);
    infinite(below(-0.3), 0.2);
    assert_eq!(below(0.0).unwrap().value, 0.0);
    // A tension may turn the traction round at a corner that sticks: then it is stretched, too.
    for (tension, turns) in [(0.0, false), (0.02, false), (0.1, true), (0.2, true)] {
        let tension = tension * KAPPA / PI;
        let shear = Shear { friction: 0.5, force: 0.1 * 0.05 * KAPPA, tension };
        let slip = contact.partial_slip(Control::Load(0.1 * KAPPA), shear).unwrap();
        let below = slip.subsurface(Body::Lower).unwrap();
        let beside = below.at(0.2 + 1e-12, 0.0).unwrap().sigma_x;
        assert_eq!(beside > 1e3 * KAPPA, turns);
        if turns {
            infinite(below.max_tension(), 0.2);
        } else {
            assert_eq!(below.max_tension().unwrap().x, -slip.normal().b());
        }
    }

    let contact = contact.edges(Edge::Adhesive(1e-4), Edge::Adhesive(1e-4));
    let solution = contact.solve(Control::Load(0.1)).unwrap();
    infinite(solution.subsurface().unwrap().max_tension(), solution.a());
}
