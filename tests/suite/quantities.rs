//! Moment, rates, the gap outside the contact and the residual, against closed forms and
//! differences.
#![allow(missing_docs)]

use crate::common;
use crate::common::NanSafe;
use crate::forms;
use crate::integrals::{integral, strength};

use common::{difference, graph, parabola, scenes};
use forms::{Form, KAPPA, forms};
use linecontact::reference::{ClosedForm, FlatPunch, Hertz, PowerLaw, UnequalRadii, Wedge, body};
use linecontact::{
    Contact, ContactError, Control, Edge, EdgePressure, EvaluationError, Flat, Midpoint, SolveError,
};
use std::f64::consts::PI;

/// Returns `∫ x P dx` of a form.
fn moment(form: &dyn ClosedForm<f64>) -> f64 {
    let on = form.limits();
    let strength = strength(on, |x| form.pressure(x, KAPPA));
    integral(on, &form.breakpoints(), |x| x * strength(x))
}

#[test]
fn moments_of_closed_forms() {
    for Form { name, form, reach } in forms::<f64>() {
        let on = form.limits();
        let body = body(&*form, -reach, reach).unwrap();
        let [left, right] = form.edges();
        let contact = Contact::new(&Flat, &body).unwrap().kappa(KAPPA).edges(left, right);
        let contact = contact.single_interval(name == "cosine 0.7");
        let solution = contact.solve(Control::Load(form.load(KAPPA))).unwrap();
        let (got, want) = (solution.moment().unwrap(), moment(&*form));
        let force = solution.load().abs().max(KAPPA * on.half_width() * 1e-3);
        let error = (got - want).abs() / (force * on.left.abs().max(on.right.abs()));
        println!("{name:24} moment {got:9.2e}: error {error:.1e}");
        assert!(error < 3e-12, "{name}: {got} is not {want}");
        let centre = solution.centre_of_pressure().unwrap();
        assert!((centre * solution.load() - got).abs() <= 1e-15 * got.abs());
        let mean = solution.mean_pressure() * (solution.a() + solution.b());
        assert!((mean / solution.load() - 1.0).abs() < 1e-15);
    }
}

#[test]
fn a_tilted_punch_is_pressed_off_centre() {
    // ∫ x (F - κ m x)/(π sqrt(H² - x²)) dx = -κ m H²/2
    let form = FlatPunch::under_load(0.5, 0.1, 0.7, KAPPA).unwrap();
    let body = body(&form, -0.5, 0.5).unwrap();
    let [left, right] = form.edges();
    let contact = Contact::new(&Flat, &body).unwrap().kappa(KAPPA).edges(left, right);
    let solution = contact.solve(Control::Load(0.7)).unwrap();
    let want = -KAPPA * 0.1 * 0.125;
    assert!((solution.moment().unwrap() / want - 1.0).abs() < 1e-14);
    let rates = solution.load_rates().unwrap();
    assert_eq!([rates.a, rates.b], [0.0; 2]);
    assert!((rates.pressure(0.3).unwrap() * PI * 0.4 - 1.0).abs() < 1e-15);
}

/// For flat punches the integrated difference is only rounding.
#[test]
fn flat_punches_meet_the_equation() {
    for (load, slope) in [(0.02, 0.0), (1e-300, 0.0), (-0.1, 0.0), (0.7, 1e-13), (0.7, 0.1)] {
        let flat = graph(-2.0, 2.0, move |x| [slope * x, slope]);
        let contact = Contact::new(&Flat, &*flat).unwrap().kappa(KAPPA);
        let contact = contact.edges(Edge::Fixed(-0.5), Edge::Fixed(0.5)).single_interval(true);
        let solution = contact.solve(Control::Load(load)).unwrap();
        for x in [-0.49, 0.0, 0.05, 0.3] {
            let residual = solution.residual(x).unwrap();
            assert!(
                residual.abs() < 1e-12 * solution.mean_pressure().abs(),
                "{load}: {residual:e}"
            );
        }
    }
}

#[test]
fn the_centre_of_pressure_at_either_end_of_the_numbers() {
    // x²/2 with a further term on the right: the same bodies in other units, and other moduli.
    let scene = |unit: f64, kappa: f64| {
        let body = graph(-unit, unit, move |x| {
            let z = x / unit;
            [unit * z * z * (0.5 + 0.3 * z), z * (1.0 + 0.9 * z)]
        });
        let contact = Contact::new(&Flat, &*body).unwrap().kappa(kappa);
        let solution = contact.solve(Control::Load(0.02 * unit * kappa)).unwrap();
        let moment = solution.moment().map(|moment| moment / solution.load() / unit);
        (solution.centre_of_pressure().unwrap() / unit, moment)
    };
    let (centre, moment) = scene(1.0, 1.0);
    assert!((moment.unwrap() / centre - 1.0).abs() < 1e-14);
    for (length, modulus) in [(-500, 0), (-500, -300), (500, 300), (-500, 500), (0, 900)] {
        let (got, moment) = scene(2f64.powi(length), 2f64.powi(modulus));
        assert_eq!(got, centre, "{length}, {modulus}");
        // The moment may overflow.
        if 2 * length + modulus > 1023 {
            assert!(
                matches!(moment, Err(ContactError::Solve(SolveError::Overflow { .. }))),
                "{moment:?}"
            );
        }
    }
}

#[test]
fn rates_are_those_of_solves() {
    type Case = (&'static str, Box<dyn ClosedForm<f64>>, Option<f64>);
    let forms: [Case; 5] = [
        ("Hertz", Box::new(Hertz::new(1.0, 0.3).unwrap()), None),
        ("unequal radii", Box::new(UnequalRadii::new(1.0, 0.2, 0.3).unwrap()), None),
        ("wedge", Box::new(Wedge::unequal(0.1, 0.3, 0.3).unwrap()), None),
        ("|x|³", Box::new(PowerLaw::new(1.0, 3.0, 0.3).unwrap()), None),
        ("parabola with a corner", Box::new(Hertz::new(1.0, 0.3).unwrap()), Some(-0.1)),
    ];
    for (name, form, corner) in forms {
        let load = form.load(KAPPA);
        let body = body(&*form, corner.unwrap_or(-1.0), 1.0).unwrap();
        let mut contact = Contact::new(&Flat, &body).unwrap().kappa(KAPPA);
        if let Some(corner) = corner {
            contact = contact.edges(Edge::Fixed(corner), Edge::Free);
        }
        let solve = |load| contact.solve(Control::Load(load)).unwrap();
        let solution = solve(load);
        let rates = solution.load_rates().unwrap();
        let a = difference(|load| solve(load).a(), load);
        let b = difference(|load| solve(load).b(), load);
        let mut worst = (rates.a - a).abs().nan_max((rates.b - b).abs()) / a.abs();
        for share in [0.2, 0.5, 0.83] {
            let x = -solution.b() + share * (solution.a() + solution.b());
            let p = difference(|load| solve(load).pressure().unwrap().at(x).unwrap(), load);
            worst = worst.nan_max((rates.pressure(x).unwrap() / p - 1.0).abs());
        }
        println!("{name:24} rates {:.3e} {:.3e}: error {worst:.1e}", rates.a, rates.b);
        assert!(worst < 1e-9, "{name}: {worst}");
    }
    // L = sqrt(2 R F/κ)
    let form = Hertz::new(1.0, 0.3).unwrap();
    let body = body(&form, -1.0, 1.0).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap().kappa(KAPPA);
    let solution = contact.solve(Control::Load(form.load(KAPPA))).unwrap();
    let rates = solution.load_rates().unwrap();
    assert!((rates.a * KAPPA * 0.3 - 1.0).abs() < 1e-14);
    assert!((rates.b * KAPPA * 0.3 - 1.0).abs() < 1e-14);
    assert_eq!(rates.pressure(0.5).unwrap(), 0.0);
}

#[test]
fn rates_that_are_not_known() {
    let body = parabola(1.0);
    let contact = Contact::new(&Flat, &*body).unwrap().kappa(KAPPA);
    let refused = |contact: &Contact<'_, f64>| {
        let rates = contact.solve(Control::Load(0.05)).unwrap().load_rates();
        assert!(
            matches!(
                rates,
                Err(ContactError::Evaluation(EvaluationError::NoLoadDerivative { .. }))
            ),
            "{rates:?}"
        );
    };
    let midpoint = Midpoint::default();
    refused(&contact.clone().quadrature(&midpoint));
    let wanted = EdgePressure::zero(1e-5, 1e-3);
    refused(&contact.edge_pressure(wanted));
}

#[test]
fn the_gap_of_hertz() {
    let form = Hertz::new(2.0, 0.3).unwrap();
    let body = body(&form, -3.0, 3.0).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap().kappa(KAPPA);
    let solution = contact.solve(Control::HalfWidth(0.3)).unwrap();
    let (mut gap, mut slope) = (0.0f64, 0.0f64);
    for i in 0..60 {
        let beyond = 0.3 * 10f64.powf(-6.0 + 0.115 * f64::from(i));
        for x in [0.3 + beyond, -0.3 - beyond] {
            let g = (solution.gap_at(x).unwrap() - form.gap(x)).abs() / x.powi(2);
            gap = gap.nan_max(g);
            let want = (x * x - 0.09).sqrt().copysign(x) / 2.0;
            // Uncertainty of the limits by rounding is magnified next to an edge.
            let magnified = (beyond / 0.3).sqrt().min(1.0);
            let error = (solution.gap_slope(x).unwrap() - want).abs();
            slope = slope.nan_max(magnified * error / x.abs());
        }
    }
    println!("gap {gap:.1e}, slope {slope:.1e}");
    assert!(gap < 2e-14 && slope < 1e-15);
    for edge in [solution.a(), -solution.b()] {
        assert_eq!(solution.gap_at(edge).unwrap(), 0.0);
        assert_eq!(solution.gap_slope(edge).unwrap(), 0.0);
    }
}

/// Gap of the wedge: `κ gap' = κ m - 2 κ m/π arcsin(L/x)`.
#[test]
fn the_gap_of_a_wedge_and_of_a_punch() {
    let form = Wedge::new(0.1, 0.2).unwrap();
    let wedge = body(&form, -1.0, 1.0).unwrap();
    let contact = Contact::new(&Flat, &wedge).unwrap().kappa(KAPPA);
    let solution = contact.solve(Control::Load(form.load(KAPPA))).unwrap();
    let l = solution.a();
    for x in [0.21f64, 0.3, 0.7, -0.5] {
        let ratio = l / x.abs();
        let slope = 0.1 * (1.0 - 2.0 / PI * ratio.asin());
        let error = (solution.gap_slope(x).unwrap().abs() - slope).abs();
        assert!(error < 1e-12, "{x}: {error}");
        // ∫ arcsin(L/x) dx = x arcsin(L/x) + L arcosh(x/L)
        let gap = 0.1 * (x.abs() - l)
            - 0.2 / PI * (x.abs() * ratio.asin() + l * (1.0 / ratio).acosh() - l * PI / 2.0);
        let error = (solution.gap_at(x).unwrap() - gap).abs();
        assert!(error < 1e-13, "{x}: {error}");
    }
    // A flat with corners at ±0.5 on bodies that extend further: the half-plane sinks by F/κ
    // arcosh(x/H).
    let flat = graph(-2.0, 2.0, |_| [0.3, 0.0]);
    let contact = Contact::new(&Flat, &*flat).unwrap().kappa(KAPPA);
    let contact = contact.edges(Edge::Fixed(-0.5), Edge::Fixed(0.5));
    let solution = contact.solve(Control::Load(0.1)).unwrap();
    for x in [0.6f64, 1.9, -0.7] {
        let gap = -0.1 / KAPPA * (x.abs() / 0.5).acosh();
        let error = (solution.gap_at(x).unwrap() / gap - 1.0).abs();
        assert!(error < 1e-11, "{x}: {error}");
    }
}

#[test]
fn the_gap_is_the_integral_of_its_slope() {
    for scene in scenes().into_iter().filter(|scene| scene.name.starts_with("paper_example_4")) {
        let reference = common::reference(scene.name);
        let contact = scene.contact();
        let solution = contact.solve(Control::Load(reference.c / PI)).unwrap();
        let (a, half_width) = (solution.a(), solution.hull().half_width());
        let gap = |x| solution.gap_at(x).unwrap();
        let x = a + 0.5 * half_width;
        // Truncation and rounding of the difference are 3e-9 at this step.
        let h = 0.01 * half_width;
        let slope =
            (8.0 * (gap(x + h) - gap(x - h)) - gap(x + 2.0 * h) + gap(x - 2.0 * h)) / (12.0 * h);
        let got = solution.gap_slope(x).unwrap();
        println!("{}: {:.1e}", scene.name, got / slope - 1.0);
        assert!((got / slope - 1.0).abs() < 1e-8);
    }
}

#[test]
fn the_equation_is_met() {
    for scene in scenes() {
        let reference = common::reference(scene.name);
        let contact = scene.contact();
        let solution = contact.solve(Control::Load(reference.c / PI)).unwrap();
        let on = solution.hull();
        let size = solution.mean_pressure();
        let mut worst = 0.0f64;
        for i in 0..12 {
            let x = on.at_angle(PI * (f64::from(i) + 0.37) / 12.0);
            worst = worst.nan_max((solution.residual(x).unwrap() / size).abs());
        }
        println!("{:32} residual {worst:.1e} of the mean pressure", scene.name);
        // Rounding of x itself.
        let rounding = 16.0 * f64::EPSILON * on.left.abs() / on.half_width();
        assert!(worst < 3e-10f64.max(rounding), "{}: {worst}", scene.name);
    }
}

/// The paper's rule gives a pressure that is not smooth between its points.
#[test]
fn by_the_papers_rule() {
    let form = Hertz::new(1.0, 0.3).unwrap();
    let body = body(&form, -1.0, 1.0).unwrap();
    let midpoint = Midpoint::default();
    let contact = Contact::new(&Flat, &body).unwrap().kappa(KAPPA).quadrature(&midpoint);
    let solution = contact.solve(Control::Load(form.load(KAPPA))).unwrap();
    assert!(solution.moment().unwrap().abs() < 1e-6 * solution.load() * 0.3);
    assert!((solution.gap_at(0.5).unwrap() / form.gap(0.5) - 1.0).abs() < 3e-3);
    assert!(solution.residual(0.1).unwrap().abs() < 1e-3 * solution.mean_pressure());
    // Of bodies that are not symmetric, the moment is as good as the pressure between the points.
    let form = UnequalRadii::new(1.0, 3.0, 0.3).unwrap();
    let body = linecontact::reference::body(&form, -1.0, 1.0).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap().kappa(KAPPA).quadrature(&midpoint);
    let solution = contact.solve(Control::Load(form.load(KAPPA))).unwrap();
    let off = (solution.moment().unwrap() - moment(&form)).abs() / (solution.load() * 0.3);
    println!("moment by the paper's rule off by {off:.1e} F L");
    assert!(off < 3e-4);
}

#[test]
fn in_single_precision() {
    let form = Hertz::new(1.0f32, 0.3).unwrap();
    let body = body(&form, -1.0, 1.0).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap();
    let solution = contact.solve(Control::HalfWidth(0.3)).unwrap();
    assert!(solution.moment().unwrap().abs() < 1e-5 * solution.load() * 0.3);
    assert!((solution.load_rates().unwrap().a * 0.3 - 1.0).abs() < 1e-5);
    assert!((solution.gap_at(0.5).unwrap() - form.gap(0.5)).abs() < 1e-6);
    assert!(solution.residual(0.1).unwrap().abs() < 1e-4 * solution.mean_pressure());
}

#[test]
fn a_solution_shows_its_limits_and_its_load() {
    let body = parabola(1.0);
    let contact = Contact::new(&Flat, &*body).unwrap();
    let solution = contact.solve(Control::Load(0.0625)).unwrap();
    let shown = format!("{solution:?}");
    for part in [format!("{:?}", solution.hull()), format!("load: {:?}", solution.load())] {
        assert!(shown.contains(&part), "{shown}");
    }
}

/// Far away the gap is the height of the body; the effect of the contact is below the last digit.
#[test]
fn the_gap_of_hertz_far_from_a_contact_of_next_to_no_width() {
    for (l, x) in [(1e-200f64, 1.0), (1e-100, -1e100), (1e-150, 1e10)] {
        let gap = Hertz::new(2.0, l).unwrap().gap(x);
        assert!((gap / (0.25 * x * x) - 1.0).abs() < 1e-15, "{l:e} {x:e}: {gap:e}");
    }
}
