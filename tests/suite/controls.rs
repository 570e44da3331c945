//! Half-width, peak and approach of several contacts, and values that no load has.
#![allow(missing_docs)]

use crate::common;

use common::{graph, on_flat};
use linecontact::{Contact, ContactError, Control, Material, PlaneState, Reference, References};
use std::f64::consts::PI;

/// The quartic x² (x² - 2) with E* = 1: two contacts up to F = π, from sqrt(1 - d/2) to sqrt(1 + d/2) with d = sqrt(4 F/π).
fn quartic<'b>() -> Contact<'b, f64> {
    let body = graph(-3.0, 3.0, |x| [x * x * (x * x - 2.0), 4.0 * x * (x * x - 1.0)]);
    on_flat(body).contact_modulus(1.0)
}

#[test]
fn two_contacts_of_a_quartic_by_their_width_and_by_their_peak() {
    let contact = quartic();
    for load in [1e-4f64, 0.3, 2.0, 3.1] {
        let d = (4.0 * load / PI).sqrt();
        let [near, far] = [(1.0 - d / 2.0).sqrt(), (1.0 + d / 2.0).sqrt()];
        // P = 2 x sqrt((x² - near²)(far² - x²)) is largest where x² = u does: u (u - near²)(far² - u).
        let [one, two] = [near * near, far * far];
        let u = ((one + two) + ((one + two).powi(2) - 3.0 * one * two).sqrt()) / 3.0;
        let peak = 2.0 * (u * (u - one) * (two - u)).sqrt();
        for control in [Control::HalfWidth(far), Control::PeakPressure(peak)] {
            let solution = contact.solve(control).unwrap();
            assert_eq!(solution.intervals().len(), 2, "{control:?}");
            // The width beyond 1 goes with the root of the load.
            let allowed = 1e-11 + 8.0 * f64::EPSILON / d;
            assert!((solution.load() / load - 1.0).abs() < allowed, "{control:?}: {solution}");
            assert!((solution.intervals()[1].left - near).abs() < 1e-11 * d.max(1e-2));
        }
    }
}

#[test]
fn a_value_in_a_jump_is_refused_with_both_sides() {
    // Under the lightest load two equal hills are as wide as they are apart.
    let error = quartic().solve(Control::HalfWidth(0.5)).unwrap_err();
    let ContactError::InJump { wanted, below, above, .. } = error else { panic!("{error}") };
    assert_eq!((wanted, below), (0.5, 0.0));
    assert!((1.0..1.1).contains(&above), "{above}");

    // A hill beside the one that is touched first.
    let body = graph(-1.0, 3.0, |x: f64| {
        let (bell, slope) = ((-2.0 * (x - 1.5).powi(2)).exp(), -4.0 * (x - 1.5));
        [x * x / 2.0 - 1.1 * bell, x - 1.1 * bell * slope]
    });
    let contact = on_flat(body);
    let error = contact.solve(Control::HalfWidth(0.5)).unwrap_err();
    let ContactError::InJump { load, below, above, .. } = error else { panic!("{error}") };
    let sides = [1.0 - 1e-7, 1.0 + 1e-7].map(|times| {
        let solution = contact.solve(Control::Load(times * load)).unwrap();
        (solution.intervals().len(), solution.hull().half_width())
    });
    assert_eq!(sides.map(|(count, _)| count), [1, 2], "{load}");
    assert!((sides[0].1 / below - 1.0).abs() < 1e-6 && (sides[1].1 / above - 1.0).abs() < 1e-3);
    assert!(below < 0.5 && above > 0.5);
}

#[test]
fn what_a_load_gives_finds_the_load_again() {
    let steel = Material::elastic(1.0, 0.3);
    let references =
        References { x: 0.0, lower: Reference::Depth(9.0), upper: Reference::Depth(9.0) };
    let mut several = 0;
    for (waves, steep) in [(7.0, 0.5), (13.0, 2.0), (31.0, 6.0), (57.0, 12.0), (90.0, 20.0)] {
        let amplitude = steep / (waves * waves);
        let body = graph(-1.0, 1.0, move |x: f64| {
            let (sin, cos) = (waves * x + 0.4).sin_cos();
            [x * x / 2.0 + amplitude * cos, x - amplitude * waves * sin]
        });
        let contact = on_flat(body).materials(steel, steel, PlaneState::Strain);
        for load in [1e-5, 1e-4, 1e-3, 1e-2] {
            let due = contact.solve(Control::Load(load)).unwrap();
            several += usize::from(due.intervals().len() > 1);
            let approach = due.approach(&references).unwrap().bodies;
            for control in [
                Control::HalfWidth(due.hull().half_width()),
                Control::PeakPressure(due.peak().unwrap().pressure),
                Control::Approach { approach, references },
            ] {
                let found = contact.solve(control);
                let found = found.unwrap_or_else(|e| panic!("{waves} {load} {control:?}: {e}"));
                let off = (found.load() / load - 1.0).abs();
                assert!(off < 1e-9, "{waves} {load} {control:?}: {found}, off by {off}");
                assert_eq!(found.intervals().len(), due.intervals().len());
            }
        }
    }
    assert!(several > 5, "{several}");
}
