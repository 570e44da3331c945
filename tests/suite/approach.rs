//! Approach and stiffness of bodies, against integrated strains of Hertz's contact, formulas of the
//! field, independent sums over the pressure, and differences of solves.
#![allow(missing_docs)]

use crate::common::{Profile, graph, on_flat, parabola, quartic, worst};
use crate::integrals::{integral, strength};
use linecontact::profile::{Ellipse, Parabola};
use linecontact::reference::{ClosedForm, Hertz};
use linecontact::{
    Body, Contact, ContactError, Control, Edge, Flat, InputError, Material, Midpoint,
    ParametricProfile, Piecewise, PlaneState, Reference, References, Solution, SolveError, Solver,
};
use std::f64::consts::{E, PI};

const STEEL: Material<f64> = Material::Elastic { youngs_modulus: 2.1, poisson_ratio: 0.3 };
const SOFT: Material<f64> = Material::Elastic { youngs_modulus: 0.7, poisson_ratio: 0.45 };

/// Returns (1 - ν²)/(π E).
fn share(material: Material<f64>) -> f64 {
    match material {
        Material::Elastic { youngs_modulus, poisson_ratio } => {
            (1.0 - poisson_ratio * poisson_ratio) / (PI * youngs_modulus)
        }
        Material::Rigid => 0.0,
    }
}

fn deep(x: f64, depth: f64) -> References<f64> {
    References { x, lower: Reference::Depth(depth), upper: Reference::Depth(depth) }
}

/// Returns the displacement towards a depth by its definition, from values of the pressure alone.
fn by_definition(solution: &Solution<f64>, material: Material<f64>, x: f64, depth: f64) -> f64 {
    let Material::Elastic { poisson_ratio: ratio, .. } = material else { return 0.0 };
    let pressure = solution.pressure().unwrap();
    let kernel = |s: f64| {
        let square = (x - s).powi(2);
        (depth * depth / square).ln_1p()
            - depth * depth / ((1.0 - ratio) * (depth * depth + square))
    };
    let sum = solution.intervals().iter().fold(0.0, |sum, on| {
        let density = |s: f64| {
            if s <= on.left || s >= on.right || s == x {
                return 0.0;
            }
            pressure.at(s).unwrap_or(0.0) * kernel(s)
        };
        sum + integral(*on, &[x], strength(*on, density))
    });
    share(material) * sum
}

#[test]
fn below_hertz_it_is_the_integral_of_the_strains() {
    let body = Parabola::new(1.0, [-1.0, 1.0]).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap().materials(STEEL, SOFT, PlaneState::Strain);
    let solution = contact.solve(Control::HalfWidth(0.01)).unwrap();
    let largest = solution.peak().unwrap().pressure;
    let mut errors = Vec::new();
    for exponent in -12..=24 {
        let z = 10f64.powf(0.25 * f64::from(exponent));
        let approach = solution.approach(&deep(0.0, 0.01 * z)).unwrap();
        let mut total = [0.0; 2];
        for (material, found) in [(STEEL, approach.lower), (SOFT, approach.upper)] {
            let Material::Elastic { poisson_ratio: ratio, .. } = material else { panic!() };
            let size = PI * share(material) * largest * 0.01;
            let logarithm = size * z.asinh();
            // Without a difference of large numbers.
            let exact = logarithm - size * ratio / (1.0 - ratio) * z / ((1.0 + z * z).sqrt() + z);
            errors.push((found - exact) / logarithm);
            total = [total[0] + exact, total[1] + logarithm];
        }
        errors.push((approach.bodies - total[0]) / total[1]);
    }
    let worst = worst(errors.into_iter().map(f64::abs));
    println!("share of the integral of the logarithm: {worst:.1e}");
    assert!(worst < 1e-12);
}

#[test]
fn far_below_it_is_the_formula_of_weber_and_banaschek() {
    let body = Parabola::new(1.0, [-1.0, 1.0]).unwrap();
    let contact =
        Contact::new(&Flat, &body).unwrap().materials(Material::Rigid, STEEL, PlaneState::Strain);
    let solution = contact.solve(Control::Load(0.001)).unwrap();
    let off = |depth: f64| {
        let found = solution.approach(&deep(0.0, depth)).unwrap();
        assert_eq!(found.lower, 0.0);
        let exact = share(STEEL) * 0.001 * (2.0 * (2.0 * depth / solution.a()).ln() - 0.3 / 0.7);
        (found.bodies / exact - 1.0).abs()
    };
    let a = solution.a();
    assert!(off(2500.0 * a) < 1e-7 && off(1e6 * a) < 1e-12 && off(2.5 * a) > 0.02);
}

/// ANSYS verification case 191: cylinders of radius 10 and 13, 3200 per unit length.
#[test]
fn the_reference_decides_between_the_values_of_verification_case_191() {
    let lower = Parabola::new(-10.0f64, [-5.0, 5.0]).unwrap();
    let upper = Parabola::new(13.0, [-5.0, 5.0]).unwrap();
    let contact = Contact::new(&lower, &upper).unwrap().materials(
        Material::elastic(30000.0, 0.25),
        Material::elastic(29120.0, 0.3),
        PlaneState::Strain,
    );
    let solution = contact.solve(Control::Load(3200.0)).unwrap();
    assert!((solution.a() - 1.20).abs() < 0.005);
    let approach = |of: &dyn Fn(f64) -> Reference<f64>| {
        let references = References { x: 0.0, lower: of(10.0), upper: of(13.0) };
        solution.approach(&references).unwrap().bodies
    };
    // Johnson's discs, and Roark's formula with its different constant.
    assert!((approach(&Reference::Disc) - 0.3995).abs() < 5e-5);
    assert!((approach(&|r| Reference::Length(r * (-1.0f64 / 6.0).exp())) - 0.4174).abs() < 1.5e-4);
    assert!((approach(&|r| Reference::Length(2.0 * r / E)) - 0.3995).abs() < 5e-5);
    assert!((approach(&Reference::Depth) - 0.3507).abs() < 2e-3);
}

#[test]
fn it_is_the_integral_of_the_pressure_at_any_place() {
    let lopsided = graph(-1.5, 1.5, |x| [x * x / 2.0 + x.powi(3) / 6.0, x + x * x / 2.0]);
    let quartic = quartic(-2.5, 2.5);
    let edges = [Edge::Free, Edge::Free];
    let punch = [Edge::Fixed(-0.3), Edge::Free];
    // The sum cannot approach the infinite pressure at a corner closer than the rounding of s; the
    // error is of the order of its root.
    let scenes = [
        (&lopsided, edges, 0.1, [0.0, 0.1, -0.3, 0.9, -1.2], 2e-12),
        (&lopsided, punch, 0.2, [0.0, 0.3, -0.29, 0.9, -0.4], 1e-7),
        (&quartic, edges, 0.5, [1.0, -1.05, 0.0, 0.4, 1.8], 2e-12),
    ];
    for (body, [left, right], load, places, allowed) in scenes {
        let mut errors = Vec::new();
        let contact = Contact::new(&Flat, &**body).unwrap().edges(left, right).materials(
            SOFT,
            STEEL,
            PlaneState::Strain,
        );
        let solution = contact.solve(Control::Load(load)).unwrap();
        let [first, least] = if load == 0.5 { [1.0, -1.0] } else { [0.0, 0.0] };
        let far = solution.approach(&deep(first, 1e9)).unwrap().bodies;
        for x in places {
            for depth in [0.05, 1.0, 30.0] {
                let found = solution.approach(&deep(x, depth)).unwrap();
                let lower = by_definition(&solution, SOFT, x, depth);
                let upper = by_definition(&solution, STEEL, x, depth);
                errors.push((found.lower - lower) / lower.abs());
                errors.push((found.upper - upper) / upper.abs());
                // Gap outside the contact.
                let open = solution.gap_at(x).unwrap_or(0.0);
                let height = body.at(x).y - least;
                let size = upper.abs() + height.abs();
                errors.push((found.bodies - (lower + upper + height - open)) / size);
            }
            // At this depth the place hardly matters.
            errors.push(solution.approach(&deep(x, 1e9)).unwrap().bodies / far - 1.0);
        }
        let worst = worst(errors.into_iter().map(f64::abs));
        println!("largest error {worst:.1e}");
        assert!(worst < allowed);
    }
}

#[test]
fn stiffness_is_the_derivative_of_load_by_approach() {
    let circle = Ellipse::circle(1.0, [-1.5, 1.5]).unwrap();
    let (circle, quartic): (Profile, Profile) = (Box::new(circle), quartic(-2.5, 2.5));
    let wedge = graph(-1.0, 1.0, |x| [x.abs() + x * x / 2.0, x.signum() + x]);
    let free = [Edge::Free; 2];
    let flat: [Edge<f64>; 2] = [Edge::Fixed(-0.5), Edge::Fixed(0.6)];
    let corner = [Edge::Fixed(-0.3), Edge::Free];
    let scenes: [(&Profile, [Edge<f64>; 2], f64); 5] = [
        (&circle, free, 0.3),
        (&circle, flat, 0.9),
        (&circle, corner, 0.2),
        (&quartic, free, 0.5),
        (&wedge, free, 0.3),
    ];
    let mut errors = Vec::new();
    for (body, [left, right], load) in scenes {
        let contact = Contact::new(&Flat, &**body).unwrap().edges(left, right).materials(
            STEEL,
            SOFT,
            PlaneState::Strain,
        );
        // When a limit passes x, the derivative behaves like a root.
        let places = if body.at(0.5).dy > 1.2 { [0.05, 0.9, 0.5] } else { [0.05, 0.9, 0.2] };
        for (lower, upper) in [
            (Reference::Depth(0.01), Reference::Depth(5.0)),
            (Reference::Depth(0.7), Reference::Disc(3.0)),
            (Reference::Length(2.0), Reference::Disc(3.0)),
        ] {
            for x in places {
                let references = References { x, lower, upper };
                let solve = |load: f64| contact.solve(Control::Load(load)).unwrap();
                let at = |h: f64| solve(load + h).approach(&references).unwrap().bodies;
                let h = 2e-3 * load;
                let difference =
                    (8.0 * (at(h) - at(-h)) - (at(2.0 * h) - at(-2.0 * h))) / (12.0 * h);
                let stiffness = solve(load).stiffness(&references).unwrap();
                errors.push((stiffness * difference - 1.0).abs());
            }
        }
    }
    let worst = worst(errors.into_iter().map(f64::abs));
    println!("largest difference {worst:.1e}");
    assert!(worst < 1e-8);
}

/// A flat punch: the pressure and its rate are one function.
#[test]
fn a_flat_punch_is_as_stiff_under_any_load() {
    let punch = graph(-1.0, 1.0, |_| [0.0, 0.0]);
    let contact = Contact::new(&Flat, &*punch)
        .unwrap()
        .edges(Edge::Fixed(-1.0), Edge::Fixed(1.0))
        .materials(Material::Rigid, STEEL, PlaneState::Strain);
    for depth in [1e-3f64, 0.1, 3.0, 1e6] {
        // ∫ P ln(d² + s²) ds = 2 F ln((d + sqrt(d² + 1))/2), ∫ P ln s² ds = -2 F ln 2.
        let share = share(STEEL);
        let root = depth.hypot(1.0);
        let exact = share * (2.0 * depth.asinh() - depth / root / 0.7);
        for load in [0.1, 4.0] {
            let solution = contact.solve(Control::Load(load)).unwrap();
            let found = solution.approach(&deep(0.0, depth)).unwrap().bodies;
            let stiffness = solution.stiffness(&deep(0.0, depth)).unwrap();
            // Relative to the integral of the logarithm.
            let allowed = 1e-12 * 2.0 * share * depth.asinh();
            assert!((found / load - exact).abs() < allowed, "{depth} {load} {found}");
            assert!((1.0 / stiffness - exact).abs() < allowed, "{depth} {load} {stiffness}");
        }
    }
}

/// Squares of these depths overflow or underflow.
#[test]
fn no_depth_is_too_small_or_too_large() {
    let body = Parabola::new(1.0, [-1.0, 1.0]).unwrap();
    let contact =
        Contact::new(&Flat, &body).unwrap().materials(Material::Rigid, STEEL, PlaneState::Strain);
    let solution = contact.solve(Control::HalfWidth(0.1)).unwrap();
    for x in [0.0, 0.05, 0.3] {
        // Far away 2 ln(2d/L) - 1/(1 - ν), with L = 0.1.
        let exact = share(STEEL) * (2.0 * (20.0f64.ln() + 300.0 * 10.0f64.ln()) - 1.0 / 0.7);
        let stiffness = solution.stiffness(&deep(x, 1e300)).unwrap();
        assert!((stiffness * exact - 1.0).abs() < 1e-13, "{x}: {stiffness}");
        // Under the contact nothing moves; outside it the gap closes.
        for depth in [1e-150, 1e-200, 1e-300] {
            let stiffness = solution.stiffness(&deep(x, depth)).unwrap();
            assert!(stiffness > if x > 0.1 { 0.1 } else { 1e100 }, "{x} {depth}: {stiffness}");
        }
    }
}

/// Returns the largest height of a body in its contacts.
fn highest(body: &dyn linecontact::ParametricProfile<f64>, solution: &Solution<f64>) -> f64 {
    let heights = solution.intervals().iter().map(|on| body.y(on.centre()).abs());
    worst(heights)
}

#[test]
fn the_load_of_an_approach_is_that_which_has_it() {
    let circle = Ellipse::circle(1.0, [-1.5, 1.5]).unwrap();
    let (circle, quartic): (Profile, Profile) = (Box::new(circle), quartic(-2.5, 2.5));
    let free = [Edge::Free; 2];
    let corner = [Edge::Fixed(-0.3), Edge::Free];
    let until = [Edge::FreeUntil(-0.1), Edge::FreeUntil(0.2)];
    let mut errors = Vec::new();
    for (body, [left, right]) in
        [(&circle, free), (&circle, corner), (&circle, until), (&quartic, free)]
    {
        let contact = Contact::new(&Flat, &**body).unwrap().edges(left, right).materials(
            STEEL,
            SOFT,
            PlaneState::Strain,
        );
        let mut solver = Solver::new();
        for load in [1e-6, 0.01, 0.3, 0.9] {
            for references in [deep(0.1, 4.0), deep(0.9, 200.0)] {
                let Ok(solution) = contact.solve(Control::Load(load)) else { continue };
                let approach = solution.approach(&references).unwrap().bodies;
                let control = Control::Approach { approach, references };
                for found in
                    [contact.solve(control).unwrap(), solver.solve(&contact, control).unwrap()]
                {
                    // Heights of 1 are rounded, and so is the approach under a tiny load.
                    let off = found.load() / load - 1.0;
                    let rounding = 1e-16 * highest(&**body, &solution) / approach;
                    errors.push((off.abs() - rounding).max(0.0));
                    errors.push((found.a() - solution.a()) / solution.hull().half_width());
                    assert_eq!(found.intervals().len(), solution.intervals().len());
                }
            }
        }
    }
    assert!(errors.len() > 40);
    let worst = worst(errors.into_iter().map(f64::abs));
    println!("largest error of the load {worst:.1e}");
    assert!(worst < 1e-12);
}

#[test]
fn swapped_mirrored_shifted_and_scaled_bodies_come_as_near() {
    let body = |shift: f64, sign: f64, scale: f64, up: f64| {
        graph(scale * (shift - 1.0), scale * (shift + 1.0), move |x| {
            let z = sign * (x / scale - shift);
            [up * scale * (z * z / 2.0 + z.powi(3) / 5.0), up * sign * (z + 0.6 * z * z)]
        })
    };
    let straight = body(0.0, 1.0, 1.0, 1.0);
    let solve = |lower: &Profile, upper: &Profile, materials: [Material<f64>; 2], to, load| {
        let [one, other] = materials;
        let contact = Contact::new(&**lower, &**upper).unwrap();
        let contact = contact.materials(one, other, PlaneState::Stress);
        let solution = contact.solve(Control::Load(load)).unwrap();
        (solution.approach(&to).unwrap(), solution.stiffness(&to).unwrap())
    };
    let flat = graph(-1.0, 1.0, |_| [0.0, 0.0]);
    let references = |x, lower, upper| References {
        x,
        lower: Reference::Depth(lower),
        upper: Reference::Disc(upper),
    };
    let (one, stiff) = solve(&flat, &straight, [STEEL, SOFT], references(0.1, 0.5, 2.0), 0.1);

    let (swapped, stiff_too) = solve(
        &body(0.0, 1.0, 1.0, -1.0),
        &flat,
        [SOFT, STEEL],
        References { x: 0.1, lower: Reference::Disc(2.0), upper: Reference::Depth(0.5) },
        0.1,
    );
    assert!((swapped.lower / one.upper - 1.0).abs() < 1e-13);
    assert!((swapped.upper / one.lower - 1.0).abs() < 1e-13);
    assert!((stiff_too / stiff - 1.0).abs() < 1e-13);
    let mirrored =
        solve(&flat, &body(0.0, -1.0, 1.0, 1.0), [STEEL, SOFT], references(-0.1, 0.5, 2.0), 0.1);
    let wide = graph(-10.0, 10.0, |_| [0.0, 0.0]);
    let shifted =
        solve(&wide, &body(3.0, 1.0, 1.0, 1.0), [STEEL, SOFT], references(3.1, 0.5, 2.0), 0.1);
    let huge = graph(-1e9, 1e9, |_| [0.0, 0.0]);
    let scale = 2f64.powi(20);
    let scaled = solve(
        &huge,
        &body(0.0, 1.0, scale, 1.0),
        [STEEL, SOFT],
        references(0.1 * scale, 0.5 * scale, 2.0 * scale),
        0.1 * scale,
    );
    for ((found, stiffness), scale) in [(mirrored, 1.0), (shifted, 1.0), (scaled, scale)] {
        assert!((found.bodies / (scale * one.bodies) - 1.0).abs() < 1e-13);
        assert!((found.lower / (scale * one.lower) - 1.0).abs() < 1e-13);
        assert!((found.upper / (scale * one.upper) - 1.0).abs() < 1e-13);
        assert!((stiffness / stiff - 1.0).abs() < 1e-13);
    }
}

#[test]
fn plane_stress_is_plane_strain_of_another_material() {
    let body = Parabola::new(1.0, [-1.0, 1.0]).unwrap();
    let (modulus, ratio) = (2.1, 0.3);
    let other = Material::elastic(
        modulus * (1.0 + 2.0 * ratio) / (1.0f64 + ratio).powi(2),
        ratio / (1.0 + ratio),
    );
    let contact = Contact::new(&Flat, &body).unwrap();
    let contacts = [
        contact.clone().materials(STEEL, STEEL, PlaneState::Stress),
        contact.materials(other, other, PlaneState::Strain),
    ];
    let [stress, strain] = contacts.map(|contact| {
        let solution = contact.solve(Control::Load(0.01)).unwrap();
        let approach = solution.approach(&deep(0.02, 0.3)).unwrap();
        [solution.a(), solution.peak().unwrap().pressure, approach.bodies, approach.lower]
    });
    // E* = E/2.
    let hertz = Hertz::under_load(1.0, 0.01, PI / 2.0 * 1.05).unwrap();
    assert!((stress[0] / hertz.limits().right - 1.0).abs() < 1e-14);
    for (stress, strain) in stress.into_iter().zip(strain) {
        assert!((stress / strain - 1.0).abs() < 1e-14);
    }
}

#[test]
fn another_quadrature_finds_the_same_to_its_accuracy() {
    let body = Ellipse::circle(1.0, [-1.5, 1.5]).unwrap();
    let midpoint = Midpoint { segments: 4000, ..Midpoint::default() };
    let contact =
        Contact::new(&Flat, &body).unwrap().materials(Material::Rigid, STEEL, PlaneState::Strain);
    let references = deep(0.1, 3.0);
    let of = |contact: &Contact<f64>| {
        contact.solve(Control::Load(0.3)).unwrap().approach(&references).unwrap().bodies
    };
    let (one, other) = (of(&contact), of(&contact.clone().quadrature(&midpoint)));
    assert!((other / one - 1.0).abs() < 1e-5, "{:e}", other / one - 1.0);
}

#[test]
fn what_cannot_be_answered_is_refused() {
    let body = Parabola::new(1.0, [-1.0, 1.0]).unwrap();
    let scene = Contact::new(&Flat, &body).unwrap();
    let bare = scene.clone().contact_modulus(1.0);
    let references = deep(0.0, 1.0);
    let control = |approach| Control::Approach { approach, references };
    assert_eq!(bare.solve(control(0.1)).unwrap_err(), ContactError::Input(InputError::NoMaterials));
    let solution = bare.solve(Control::Load(0.01)).unwrap();
    assert_eq!(
        solution.approach(&references).unwrap_err(),
        ContactError::Input(InputError::NoMaterials)
    );
    assert_eq!(
        solution.stiffness(&references).unwrap_err(),
        ContactError::Input(InputError::NoMaterials)
    );

    let with = |lower, upper| scene.clone().materials(lower, upper, PlaneState::Strain);
    let solve = |contact: Contact<f64>| contact.solve(Control::Load(0.01)).unwrap_err();
    assert_eq!(
        solve(with(Material::Rigid, Material::Rigid)),
        ContactError::Input(InputError::BothRigid)
    );
    for modulus in [0.0, -1.0, f64::INFINITY, f64::NAN, 1e-310] {
        let error = solve(with(STEEL, Material::elastic(modulus, 0.3)));
        assert!(
            matches!(error, ContactError::Input(InputError::InvalidYoungsModulus { .. })),
            "{error}"
        );
    }
    for ratio in [-0.1, 0.51, f64::NAN, f64::INFINITY] {
        let error = solve(with(Material::elastic(1.0, ratio), STEEL));
        assert!(
            matches!(error, ContactError::Input(InputError::InvalidPoissonRatio { .. })),
            "{error}"
        );
        assert!(error.to_string().starts_with("lower body: Poisson's ratio is "), "{error}");
    }
    let contact = with(STEEL, STEEL);
    for approach in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        let error = contact.solve(control(approach)).unwrap_err();
        assert!(
            matches!(
                error,
                ContactError::Input(InputError::InvalidLoad { quantity: "approach", .. })
            ),
            "{error}"
        );
    }
    let solution = contact.solve(Control::Load(0.01)).unwrap();
    for depth in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = solution.approach(&deep(0.0, depth)).unwrap_err();
        assert!(
            matches!(error, ContactError::Input(InputError::InvalidReference { .. })),
            "{error}"
        );
    }
    // The formula of a disc holds for contacts much smaller than the disc.
    let disc = |radius| References { lower: Reference::Disc(radius), ..deep(0.0, 1.0) };
    let error = solution.approach(&disc(0.99 * solution.a())).unwrap_err();
    assert!(matches!(error, ContactError::Input(InputError::InvalidReference { .. })), "{error}");
    assert!(solution.stiffness(&disc(1.01 * solution.a())).unwrap() > 0.0);
    for x in [f64::NEG_INFINITY, f64::NAN] {
        let error = solution.approach(&deep(x, 1.0)).unwrap_err();
        assert!(matches!(error, ContactError::Solve(SolveError::OutsideBodies { .. })), "{error}");
    }
    // A rigid body has no reference.
    let rigid = with(Material::Rigid, STEEL).solve(Control::Load(0.01)).unwrap();
    let upper = Reference::Depth(1.0);
    assert!(rigid.approach(&References { x: 0.0, lower: Reference::Depth(-1.0), upper }).is_ok());
}

/// A half-plane goes on beyond the end of its body, and discs and lengths have no place.
#[test]
fn references_beside_the_bodies_are_those_of_half_planes() {
    let body = Parabola::new(1.0, [-0.5, 1.0]).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap().materials(STEEL, SOFT, PlaneState::Strain);
    let solution = contact.solve(Control::Load(0.01)).unwrap();
    for x in [-0.5, -0.6, 3.0] {
        let found = solution.approach(&deep(x, 1.5)).unwrap();
        for (found, material) in [(found.lower, STEEL), (found.upper, SOFT)] {
            let exact = by_definition(&solution, material, x, 1.5);
            assert!((found / exact - 1.0).abs() < 1e-9, "{x}: {found} {exact}");
        }
        let control = Control::Approach { approach: found.bodies, references: deep(x, 1.5) };
        let again = contact.solve(control);
        assert!((again.unwrap().load() / 0.01 - 1.0).abs() < 1e-12, "{x}");
        let [at, inside] = [x, 0.1].map(|x| References {
            x,
            lower: Reference::Length(7.0),
            upper: Reference::Disc(2.0),
        });
        let [at, inside] = [at, inside].map(|to| {
            let beside = solution.displacement(Body::Lower, 0.9, &to).unwrap();
            (solution.approach(&to).unwrap().bodies, solution.stiffness(&to).unwrap(), beside)
        });
        assert_eq!(at, inside, "{x}");
    }
}

#[test]
fn an_approach_that_the_bodies_do_not_bear_is_refused_with_the_largest() {
    let body = Parabola::new(1.0, [-0.2, 0.2]).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap().materials(STEEL, STEEL, PlaneState::Strain);
    let references = deep(0.0, 3.0);
    let most = contact.solve(Control::HalfWidth(0.2)).unwrap();
    let largest = most.approach(&references).unwrap().bodies;
    for wanted in [1.001 * largest, 2.0 * largest, 1e3 * largest, 1e300] {
        let control = Control::Approach { approach: wanted, references };
        match contact.solve(control).unwrap_err() {
            ContactError::Solve(SolveError::ApproachTooLarge { approach, load, .. }) => {
                assert!((approach / largest - 1.0).abs() < 1e-6);
                assert!((load / most.load() - 1.0).abs() < 1e-6);
            }
            error => panic!("{error}"),
        }
    }
    let control = Control::Approach { approach: 0.999 * largest, references };
    assert!(contact.solve(control).unwrap().a() < 0.2);
}

/// Next to a contact the surface may move away from a point close below it. The bodies do not: the
/// gap closes.
/// Between references at lengths ℓ the approach to a parabola grows up to L = 2ℓ: dδ/dF goes like
/// ln(2ℓ/L).
#[test]
fn an_approach_that_falls_is_sought_where_it_still_grows() {
    let contact = on_flat(parabola(1.0)).materials(STEEL, STEEL, PlaneState::Strain);
    let length = Reference::Length(0.1);
    let references = References { x: 0.0, lower: length, upper: length };
    let most = contact.solve(Control::HalfWidth(0.2)).unwrap();
    let largest = most.approach(&references).unwrap().bodies;
    for share in [0.01, 0.5, 0.999, 1.0 + 1e-9, 1.1, 3.0, 30.0] {
        let approach = share * largest;
        match contact.solve(Control::Approach { approach, references }) {
            Ok(found) => {
                let is = found.approach(&references).unwrap().bodies;
                assert!((is / approach - 1.0).abs() < 1e-12, "{share}: {found}");
                assert!(share < 1.0 && found.a() < 0.2, "{share}: {found}");
            }
            Err(ContactError::Solve(SolveError::Falls { quantity, load, rate })) => {
                assert!(share > 1.0 && rate <= 0.0 && quantity == "approach", "{share}: {rate}");
                assert!((load / most.load() - 1.0).abs() < 1e-3, "{share}: {load}");
            }
            Err(error) => panic!("{share}: {error}"),
        }
    }
}

/// A rate that is positive has been so under all smaller loads, whatever the reference and however
/// many contacts are born.
#[test]
fn the_rate_of_an_approach_never_grows_with_the_load() {
    let [compressible, incompressible] = [0.0, 0.5].map(|ratio| Material::elastic(1.0, ratio));
    for (waves, steep) in [(0.0, 0.0), (7.0, 0.5), (13.0, 2.0), (31.0, 6.0)] {
        let tall = steep / f64::max(waves * waves, 1.0);
        let body = graph(-1.0, 1.0, move |x: f64| {
            let (sin, cos) = (waves * x + 0.4).sin_cos();
            [x * x / 2.0 + tall * cos, x - tall * waves * sin]
        });
        let contact = on_flat(body).materials(compressible, incompressible, PlaneState::Strain);
        let loads = (0..40).map(|i| 1e-5 * 1.2f64.powi(i));
        let solutions: Vec<_> = loads.map(|f| contact.solve(Control::Load(f)).unwrap()).collect();
        let depths = [1e-3, 1e-2, 1.0].map(Reference::Depth);
        for reference in depths.into_iter().chain([Reference::Disc(1.0), Reference::Length(1e-2)]) {
            for x in [-0.3, 0.0, 0.1] {
                let to = References { x, lower: reference, upper: reference };
                let rates = solutions.iter().map(|at| 1.0 / at.stiffness(&to).unwrap());
                let rates: Vec<f64> = rates.collect();
                let falls = rates.windows(2).all(|pair| pair[1] <= pair[0] + 1e-9 * pair[0].abs());
                assert!(falls, "{waves}, {to:?}: {rates:?}");
            }
        }
    }
}

#[test]
fn bodies_come_nearer_with_every_load_wherever_it_is_measured() {
    let parabola: Profile = Box::new(Parabola::new(1.0, [-3.0, 3.0]).unwrap());
    let incompressible = Material::elastic(1.0, 0.5);
    let mut lifted = 0;
    for (body, load) in [(&parabola, 0.01), (&quartic(-2.5, 2.5), 1.0), (&quartic(-2.5, 2.5), 0.01)]
    {
        for material in [STEEL, incompressible] {
            let contact = Contact::new(&Flat, &**body).unwrap().materials(
                Material::Rigid,
                material,
                PlaneState::Strain,
            );
            let solution = contact.solve(Control::Load(load)).unwrap();
            for depth in [1e-4, 1e-2, 0.1, 1.0, 10.0] {
                for i in 0..=20 {
                    let references = deep(0.1 * f64::from(i) - 1.0, depth);
                    let stiffness = solution.stiffness(&references).unwrap();
                    assert!(stiffness > 0.0, "{references:?} {stiffness}");
                    lifted += i32::from(solution.approach(&references).unwrap().upper < 0.0);
                }
            }
        }
    }
    assert!(lifted > 10, "{lifted}");
}

/// Parameters `[w, a, phase, F/κ]` of x²/2 + a cos(w x + phase): one or three contacts, and a
/// lowest gap between nodes.
const WAVES: [[f64; 4]; 4] = [
    [80.80260641686415, 0.001721908468471409, 6.183185815255985, 0.12782336085816706],
    [202.4333852216777, 0.00031982018516524664, 2.5301362929552536, 0.004726301162679326],
    [160.23849996902157, 0.0005107267983487047, 1.6206137264615368, 0.04624980849022112],
    [40.60496642778215, 0.008443102511219413, 1.3734004202307304, 0.11400674544746076],
];

/// The approach counts from first touch. If a piece ends there, the lowest gap is at a known point.
#[test]
fn first_touch_of_wavy_bodies_is_at_the_lowest_gap() {
    for [w, a, phase, load] in WAVES {
        let height = move |x: f64| 0.5 * x * x + a * (w * x + phase).cos();
        let places = (0..40_000).map(|i| -1.0 + 2.0 * f64::from(i) / 40_000.0);
        let lowest = places.min_by(|&one, &other| height(one).total_cmp(&height(other)));
        let mut lowest = lowest.unwrap();
        for _ in 0..20 {
            let (sine, cosine) = (w * lowest + phase).sin_cos();
            lowest -= (lowest - a * w * sine) / (1.0 - a * w * w * cosine);
        }
        let piece = |from: f64, to: f64| {
            graph(from, to, move |x| {
                let (sine, cosine) = (w * x + phase).sin_cos();
                [0.5 * x * x + a * cosine, x - a * w * sine]
            })
        };
        let (whole, cut) = (piece(-1.0, 1.0), [piece(-1.0, lowest), piece(lowest, 1.0)]);
        let cut = Piecewise::new(cut.into()).unwrap();
        let bodies: [&dyn ParametricProfile<f64>; 2] = [&*whole, &cut];
        let [found, want] = bodies.map(|body| {
            let contact = Contact::new(&Flat, body).unwrap();
            let contact = contact.materials(Material::Rigid, STEEL, PlaneState::Strain);
            let solution = contact.solve(Control::Load(load / share(STEEL) / 2.0)).unwrap();
            solution.approach(&deep(0.3, 0.5)).unwrap().bodies
        });
        assert!((found / want - 1.0).abs() < 1e-11, "{w}: {found} for {want}");
    }
}
