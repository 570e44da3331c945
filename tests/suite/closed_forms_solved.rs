//! The solver against the closed forms of `linecontact::reference`.
#![allow(missing_docs)]

use crate::common::{NanSafe, circle, graph, join, limits_off, on_flat, worst};
use crate::forms;

use approx::assert_relative_eq;
use forms::{Form, KAPPA, forms};
use linecontact::reference::{ClosedForm, Ellipse, Exponential, PowerLaw, Wedge, body};
use linecontact::search::{Bisection, LimitSearch, Secant};
use linecontact::{Contact, ContactError, Control, Cost, Flat, SolveError};
use std::f64::consts::PI;

/// Solves all closed forms, and returns the largest relative errors of the limits and of the
/// pressure away from the edges.
pub fn largest_errors() -> [f64; 2] {
    let mut largest = [0.0; 2];
    for Form { name, form, reach } in forms::<f64>() {
        let (want, load) = (form.limits(), form.load(KAPPA));
        let body = body(&*form, -reach, reach).unwrap_or_else(|e| panic!("{name}: {e}"));
        let [left, right] = form.edges();
        let contact = Contact::new(&Flat, &body).expect(&name).kappa(KAPPA).edges(left, right);
        // The body ends in the trough of the wave, and would touch there as well.
        let contact = contact.single_interval(name == "cosine 0.7");
        let solution = contact.solve(Control::Load(load)).expect(&name);
        let (got, l) = (solution.hull(), want.half_width());
        let limits = [got.right - want.right, got.left - want.left].map(|d| d.abs() / l);
        let relative = [got.right / want.right - 1.0, got.left / want.left - 1.0].map(f64::abs);
        let pressure = solution.pressure().expect(&name);
        let estimate = |x| pressure.estimate(x, &mut Cost::default()).expect(&name).value;
        let mut inside = 0.0f64;
        for i in 1..40 {
            let x = want.at_angle(PI * (f64::from(i) + 0.1) / 40.0);
            let exact = form.pressure(x, KAPPA);
            let share = limits[0].max(limits[1]) * l * l / (x - want.left).min(want.right - x);
            // A JKR pressure passes through zero.
            let size = exact.abs().max(0.1 * load.abs() / l);
            inside = inside.max((estimate(x) - exact).abs() / size - share);
        }
        // Next to an edge, at the same distance from the computed and from the exact limits.
        let distance = 1e-6 * l;
        let pairs = [
            (got.right - distance, want.right - distance),
            (got.left + distance, want.left + distance),
        ];
        let (mut beside, mut open) = (0.0f64, 1.0f64);
        for (got, exact) in pairs {
            let exact = form.pressure(exact, KAPPA);
            beside = beside.max((estimate(got) / exact - 1.0).abs());
            // A pressure that hardly rises from the edge is more sensitive to an error of the
            // limits.
            let hertz = 2.0 * load / (PI * l) * (2.0 * distance / l).sqrt();
            open = open.max((hertz / exact).abs());
        }
        println!(
            "{name:24} a {:8.1e} b {:8.1e}  P {inside:8.1e}, beside an edge {beside:8.1e}",
            relative[0], relative[1]
        );
        assert!(limits.into_iter().all(|error| error < 1e-12), "{name}: {limits:?}");
        assert!(inside < 1e-12, "{name}: {inside}");
        // One ulp of a limit is a share of 1e-10 of the distance.
        let far = want.right.abs().max(want.left.abs()) / distance;
        assert!(beside < 1e-12 + 2.0 * f64::EPSILON * far * open, "{name}: {beside}");
        largest = [worst([largest[0], worst(relative)]), largest[1].nan_max(inside)];
    }
    largest
}

#[test]
fn the_solver_agrees_with_them() {
    largest_errors();
}

#[test]
fn a_half_width_gives_the_load_of_a_nearly_full_circle() {
    let half_width = 1.0 - 0.5f64.powi(20);
    let form = Ellipse::circle(1.0, half_width).unwrap();
    let contact = on_flat(circle(-1.57, 1.57, 1.0));
    let solution = contact.solve(Control::HalfWidth(half_width)).unwrap();
    // An ulp of the half-width is 8e-12 of the load.
    assert_relative_eq!(solution.load(), form.load(1.0), epsilon = 0.0, max_relative = 4e-11);
}

#[test]
fn slopes_up_to_e_to_the_150th_do_not_hide_the_contact() {
    let form = Exponential::new(1.0, 1.0, 25.0).unwrap();
    for end in [50.0, 100.0, 150.0] {
        let body = body(&form, -end, end).unwrap();
        let contact = Contact::new(&Flat, &body).unwrap();
        let solution = contact.solve(Control::Load(form.load(1.0))).unwrap();
        assert!(limits_off(solution.hull(), form.limits()) < 1e-13, "{end}: {solution:?}");
    }
}

#[test]
fn a_load_lost_in_the_rounding_of_the_forces_is_refused() {
    // The bodies carry 151 on [-300, 3.4]; slopes of e^300 on the other side hide that.
    let form = Exponential::new(1.0, 1.0, 1.0).unwrap();
    let body = body(&form, -300.0, 300.0).unwrap();
    for strategy in [&Bisection::default() as &dyn LimitSearch<f64>, &Secant::default()] {
        let contact = Contact::new(&Flat, &body).unwrap().limit_search(strategy);
        let refused = contact.solve(Control::Load(1e10));
        let Err(ContactError::Solve(SolveError::DomainTooShort {
            end: -300.0,
            carried,
            half_width,
            ..
        })) = refused
        else {
            panic!("{refused:?}")
        };
        // c₀ = 0 and F by e^{c} I_0(L) = 1, L e^{c} I_1(L) = F, with I_1/I_0 = 1 - 1/(2 L) - 1/(8
        // L²) - ...
        let l = half_width;
        let ratio = 1.0 - 0.5 / l - 0.125 / (l * l) - 0.125 / (l * l * l);
        assert_relative_eq!(carried, l * ratio, epsilon = 0.0, max_relative = 1e-8);
    }
}

#[test]
fn a_wedge_and_its_mirror_image_are_as_exact() {
    for (left, right) in [(1e-6, 1.0), (1.0, 1e-6)] {
        let form = Wedge::unequal(left, right, 1.0).unwrap();
        let body = body(&form, -10.0, 10.0).unwrap();
        let (new, secant) = (|| Contact::new(&Flat, &body).unwrap(), Secant::default());
        for (contact, short_error) in [(new(), 1e-5), (new().limit_search(&secant), 1e-14)] {
            let solution = contact.solve(Control::Load(form.load(1.0))).unwrap();
            assert!(
                limits_off(solution.hull(), form.limits()) < 1e-14,
                "{left} {right}: {solution:?}"
            );
            // The search for one limit at a time keeps the digits of the short side, too.
            let short = solution.a().min(solution.b());
            let [b, a] = [-form.limits().left, form.limits().right];
            assert_relative_eq!(short, a.min(b), epsilon = 0.0, max_relative = short_error);
        }
    }
}

#[test]
fn a_slope_that_all_but_jumps() {
    for power in [1.1, 1.03, 1.001] {
        let form = PowerLaw::new(1.0, power, 1.0).unwrap();
        let body = body(&form, -2.0, 2.0).unwrap();
        let contact = Contact::new(&Flat, &body).unwrap();
        let solution = contact.solve(Control::Load(form.load(1.0))).unwrap();
        let (off, estimate) =
            (limits_off(solution.hull(), form.limits()), solution.limits_error().unwrap());
        assert!(off < 4e-15 && off <= estimate && estimate < 1e-13, "{power}: {off} {estimate}");
    }
}

/// A flat of half-width 1 with edges of radius 1, each touched on a hundred-millionth of it. The
/// pressures are by tanh-sinh quadrature in 56 digits, of the limits for exactly this C.
#[test]
fn a_punch_whose_edges_take_part_with_next_to_nothing() {
    let edge =
        |from: f64, to: f64, at: f64| graph(from, to, move |x| [(x - at) * (x - at) / 2.0, x - at]);
    let flat = graph(-1.0, 1.0, |_| [0.0, 0.0]);
    let contact = on_flat(join(vec![edge(-4.0, -1.0, -1.0), flat, edge(1.0, 4.0, 1.0)]));
    let solution = contact.solve(Control::Load(1.885_618_089_763_79e-12 / PI)).unwrap();
    let pressure = solution.pressure().unwrap();
    for (x, exact) in [
        (-0.992_708_884_025_142_7, 1.585_020_485_348_030_3e-12),
        (-0.464_723_176_691_000_3, 2.157_679_774_955_724_4e-13),
        (0.464_723_176_691_000_3, 2.157_679_774_955_724_4e-13),
    ] {
        let got = pressure.at(x).unwrap();
        assert_relative_eq!(got, exact, epsilon = 0.0, max_relative = 1e-12);
    }
}
