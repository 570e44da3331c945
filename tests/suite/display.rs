//! Results as text.
#![allow(missing_docs)]

use crate::common::{Profile, join, on_flat, quartic};
use crate::corners::polygon;
use linecontact::profile::{Ellipse, Outline, Parabola, Placed, Placement};
use linecontact::stress::Stress;
use linecontact::{
    Base, Contact, Control, Cost, Curve, CurvePoint, Edge, Estimate, Extremum, Flat, Interval,
    Layer, Material, Peak, PlaneState,
};

#[test]
fn intervals_and_numbers() {
    let on = Interval { left: -0.2, right: 0.25 };
    assert_eq!(on.to_string(), "[-0.2, 0.25]");
    assert_eq!(format!("{on:.3} {on:.1e}"), "[-0.200, 0.250] [-2.0e-1, 2.5e-1]");
    let cost = Cost { samples: 3, evaluations: 2, heights: 1, ..Cost::default() };
    assert_eq!(cost.to_string(), "3 samples by 2 evaluations, and 1 for heights");
    let cost = Cost { searches: 4, search_values: 30, ..cost };
    let all = "3 samples by 2 evaluations, and 1 for heights; 4 searches with 30 values";
    assert_eq!(cost.to_string(), all);
    let estimate = Estimate { value: 0.1 + 0.2, error: 4.44e-17 };
    assert_eq!(estimate.to_string(), "0.30000000000000004 ± 4.4e-17");
    let peak = Peak { x: 0.0, pressure: 1234567.8f32, error: 0.1 };
    assert_eq!(format!("{peak} {peak:.2}"), "1.23457e6 at x = 0 1.2e6 at x = 0");
    let least = Extremum { x: f64::INFINITY, value: 0.000_999_999_99 };
    assert_eq!(least.to_string(), "0.001 at x = inf");
    let stress = Stress { sigma_x: -1.0, sigma_y: -1.0 / 3.0, tau_xy: 1e-5 };
    assert_eq!(stress.to_string(), "σ_x = -1, σ_y = -0.333333, τ_xy = 1e-5");
}

#[test]
fn a_solution_in_three_lines() {
    let body = Parabola::new(1.0f64, [-1.0, 1.0]).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap().kappa(1.0);
    let text = contact.solve(Control::HalfWidth(0.2)).unwrap().to_string();
    let lines: Vec<_> = text.lines().collect();
    assert_eq!(lines.len(), 3);
    assert_eq!(lines[0], "contact [-0.2, 0.2]");
    // 2 F/(π L)
    assert!(lines[1].starts_with("load 0.02, largest pressure 0.063662 at x = "), "{text}");
    assert!(lines[2].ends_with(" of the half-width, checked"), "{text}");

    let alone = contact.clone().single_interval(true).solve(Control::Load(0.02)).unwrap();
    assert!(format!("{alone:.2}").contains("pressure 0.064 at"));
    assert!(alone.to_string().ends_with(", not checked"));

    let tilted = contact.solve(Control::CentreOfPressure { load: 0.02, at: 0.1 }).unwrap();
    assert!(tilted.to_string().contains("load 0.02, tilt -0.1, largest"), "{tilted}");
}

#[test]
fn a_stiffness_that_nobody_gave_is_told() {
    let body = Parabola::new(1.0f64, [-1.0, 1.0]).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap();
    for (contact, told) in [(contact.clone(), true), (contact.kappa(1.0), false)] {
        let text = contact.solve(Control::Load(0.02)).unwrap().to_string();
        assert_eq!(text.ends_with("\nκ is 1, as no modulus and no materials were given"), told);
    }
}

/// Places far from 0 have six digits of the width, too, and residuals within the error of the
/// limits pull at nothing.
#[test]
fn places_far_from_the_origin_are_told_apart() {
    let cases = [
        (1e3, "contact [999.764717, 1000.23528]"),
        (1e6, "contact [999999.764717, 1.00000023528e6]"),
        (1e9, "contact [9.99999999764717e8, 1.00000000023528e9]"),
    ];
    let text = |origin: f64| {
        let body = Curve::new([origin - 1.0, origin + 1.0], |k: f64| {
            let x = k - origin;
            CurvePoint { x: k, y: 0.05 * x * x, dx: 1.0, dy: 0.1 * x }
        });
        let contact = Contact::new(&Flat, &body).unwrap().contact_modulus(115e3);
        contact.solve(Control::Load(500.0)).unwrap().to_string()
    };
    for (origin, expected) in cases {
        let text = text(origin);
        let lines: Vec<_> = text.lines().collect();
        assert!(lines.len() == 3 && lines[0] == expected, "{text}");
    }
    // No corner and no quadrature is to blame where the digits of x end.
    let far = text(1e13);
    assert!(far.ends_with("x has too few digits: move the origin to the contact"), "{far}");
}

/// A pad bears a little on the walls at its ends: they are no wrong unit.
#[test]
fn walls_next_to_the_limits_are_no_steep_surfaces() {
    let pad = Outline::from([0.0, 0.0]).arc(1e5, 5.0).corner(1.0).line(1.0).mirrored();
    let pad = pad.build().unwrap();
    for load in [100.0, 500.0, 2e4] {
        let contact = Contact::new(&Flat, &pad).unwrap().contact_modulus(115e3);
        let solution = contact.solve(Control::Load(load)).unwrap();
        assert!(!solution.is_steep(), "{load}: {solution}");
    }
}

/// The place of the largest pressure has half of the digits, that of first touch the rounding.
#[test]
fn places_that_are_zero_to_rounding_are_written_so() {
    let circle = Ellipse::circle(10.0, [-1.2, 1.2]).unwrap();
    let contact = Contact::new(&Flat, &circle).unwrap();
    for half_width in [0.2, 1.0] {
        let solution = contact.solve(Control::HalfWidth(half_width)).unwrap();
        let text = solution.to_string();
        assert!(solution.peak().unwrap().x != 0.0 && text.contains(" at x = 0\n"), "{text}");
    }
    let touching = contact.solve(Control::Load(0.0)).unwrap();
    assert!(touching.a() != 0.0);
    assert_eq!(touching.to_string(), "apart by 0 at x = 0, without load");
    let aside = Placed::new(circle, Placement::default().shifted(1e-6, 0.0)).unwrap();
    let text = Contact::new(&Flat, &aside).unwrap().solve(Control::HalfWidth(0.2)).unwrap();
    assert!(!text.to_string().contains(" at x = 0\n"), "{text}");
}

/// Bodies that conform as far as this are steep, too, and units may be wrong in both.
#[test]
fn bodies_that_conform_and_are_steep_are_told_both() {
    let circle = |radius| Ellipse::circle(radius, [-1.5, 1.5]).unwrap();
    let (hole, pin) = (circle(10.02), circle(10.0));
    let contact = Contact::new(&hole, &pin).unwrap().contact_modulus(115e3);
    for (load, expected) in [(240.0, [true, true]), (60.0, [true, false]), (10.0, [false, false])] {
        let solution = contact.solve(Control::Load(load)).unwrap();
        assert_eq!([solution.conformity().is_some(), solution.is_steep()], expected, "{load}");
        let text = solution.to_string();
        let told =
            ["the bodies conform", "do all units go together?"].map(|word| text.contains(word));
        assert_eq!(told, expected, "{text}");
    }
    // A lined bush has the note without the shares, which are those of half-planes.
    let liner = Layer { material: Material::elastic(1e3, 0.3), thickness: 0.3, base: Base::Bonded };
    let lined = contact.materials(liner, Material::Rigid, PlaneState::Strain);
    for (load, conforms) in [(40.0, true), (1.0, false)] {
        let solution = lined.solve(Control::Load(load)).unwrap();
        let text = solution.to_string();
        assert!(solution.conformity().is_none() && text.contains("conform") == conforms, "{text}");
        assert!(!text.contains('%'), "{text}");
    }
}

#[test]
fn several_contacts_and_given_limits() {
    let text = on_flat(quartic(-2.0, 2.0)).solve(Control::Load(0.5)).unwrap().to_string();
    assert!(text.starts_with("2 contacts [-1.") && text.contains("], [0."), "{text}");

    let punch = Contact::new(&Flat, &Flat).unwrap().kappa(1.0);
    let punch = punch.edges(Edge::Fixed(-1.0), Edge::Fixed(1.0));
    let text = punch.solve(Control::Load(0.3)).unwrap().to_string();
    let expected = "contact [-1, 1]\nload 0.3, pressure infinite at x = 1\nlimits given, checked";
    assert_eq!(text, expected);
}

/// A groove parts a land: all four limits are at corners, the inner ones inside the body.
#[test]
fn limits_that_corners_hold_are_named() {
    let (wall, depth) = (1e-10, 0.1);
    let knots = [[-2.0, 0.0], [-1.0, 0.0], [-1.0 + wall, depth], [1.0 - wall, depth], [1.0, 0.0]];
    let knots = [&knots[..], &[[2.0, 0.0]]].concat();
    let line = |ends: &[[f64; 2]]| -> Profile {
        let [[x, y], [to, end]] = [ends[0], ends[1]];
        let slope = (end - y) / (to - x);
        Box::new(Curve::new([x, to], move |k: f64| CurvePoint {
            x: k,
            y: y + slope * (k - x),
            dx: 1.0,
            dy: slope,
        }))
    };
    let body = join(knots.windows(2).map(line).collect());
    let contact = Contact::new(&Flat, &*body).unwrap().kappa(1.0);
    let contact = contact.edges(Edge::Fixed(-2.0), Edge::FreeUntil(2.0));
    let text = contact.solve(Control::Load(0.3)).unwrap().to_string();
    assert!(text.ends_with(" of the half-width, held at x = -2, -1, 1, 2, checked"), "{text}");
}

#[test]
fn a_certificate_in_a_line() {
    let body = Parabola::new(1.0f64, [-1.0, 1.0]).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap();
    let certificate = contact.solve(Control::Load(0.02)).unwrap().certify().unwrap();
    let text = certificate.to_string();
    assert!(text.starts_with("no tension, no overlap, in cells of 0.005: "), "{text}");
    assert!(text.ends_with(&certificate.cost.to_string()));
}

#[test]
fn bodies_that_would_have_to_pull_are_told_of_unless_they_adhere() {
    let pull = "would have to pull at each other at x = ";
    let punch = Contact::new(&Flat, &Flat).unwrap().edges(Edge::Fixed(-1.0), Edge::Fixed(1.0));
    let pulled = punch.clone().single_interval(true).solve(Control::Load(-0.3)).unwrap();
    let text = pulled.to_string();
    assert!(text.contains(&format!("{pull}-1")) && text.contains(&format!("{pull}1")), "{text}");
    let text = punch.solve(Control::Load(0.3)).unwrap().to_string();
    assert!(!text.contains(pull), "{text}");

    let body = Parabola::new(1.0f64, [-1.0, 1.0]).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap();
    let contact = contact.edges(Edge::Adhesive(1e-3), Edge::Adhesive(1e-3));
    let solution = contact.solve(Control::Load(0.02)).unwrap();
    assert!(solution.edge_singularities().into_iter().all(|strength| strength < 0.0));
    let text = solution.to_string();
    assert!(!text.contains(pull), "{text}");

    // Limits just beyond the corners of a pad, on its ramps.
    let pad = polygon(&[[0.0, 0.2], [1.0, 0.0], [1.7, 0.0], [2.7, 0.2]]);
    let contact = Contact::new(&Flat, &*pad).unwrap().contact_modulus(115e3);
    for load in [0.3, 1.0, 10.0] {
        let text = contact.solve(Control::Load(load)).unwrap().to_string();
        assert!(!text.contains(pull), "{load}: {text}");
    }
}

/// P is proportional to (L²/2 - 0.1 + x²) sqrt(L² - x²): nearest to zero in the middle.
#[test]
fn a_certificate_tells_the_least_ratio() {
    let hollow = Curve::new([-1.0, 1.0], |k: f64| {
        let k2 = k * k;
        CurvePoint { x: k, y: k2 * (k2 / 4.0 - 0.05), dx: 1.0, dy: k * (k2 - 0.1) }
    });
    let contact = Contact::new(&Flat, &hollow).unwrap();
    let certificate = contact.solve(Control::HalfWidth(0.6)).unwrap().certify().unwrap();
    let text = format!("{certificate:.3}");
    // F = κ (3 L⁴/8 - 0.1 L²/2), and the ratio 2 κ L² (L²/2 - 0.1)/(π F) in the middle.
    let ratio = 0.72 * 0.08 / (std::f64::consts::PI * (0.375 * 0.1296 - 0.05 * 0.36));
    assert!(text.starts_with(&format!("no tension (least ratio {ratio:.3} at x = ")), "{text}");
}
