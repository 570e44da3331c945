//! Reports of searches that fail, which no solution shows.

use super::{Work, Workspace, find};
use crate::gap::Cost;
use crate::profile::{Parabola, ParametricProfile};
use crate::quadrature::Engine;
use crate::solution::{Attempt, Outcome, Report, Start};
use crate::{
    Contact, ContactError, Control, Curve, CurvePoint, Edge, EdgePressure, Flat, InputError,
    SolveError,
};
use std::f64::consts::TAU;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Returns the attempts of a search that fails, and its error.
fn failure(contact: &Contact<'_, f64>, load: f64) -> (Report, ContactError<f64>) {
    let (mut integrator, mut workspace) =
        (Engine::new(contact.quadrature).unwrap(), Workspace::new());
    let mut cost = Cost::default();
    let mut work = Work { integrator: &mut integrator, workspace: &mut workspace, cost: &mut cost };
    let error =
        find(contact, Control::Load(load), &mut work).map(|(found, _)| found.interval).unwrap_err();
    (workspace.report, error)
}

fn wavy() -> impl ParametricProfile<f64> {
    Curve::new([-1.5, 1.5], |k: f64| {
        let (sin, cos) = (2.0 * TAU * k).sin_cos();
        CurvePoint { x: k, y: k * k / 20.0 - 0.01 * cos, dx: 1.0, dy: k / 10.0 + 0.02 * TAU * sin }
    })
}

fn not_found(start: Start) -> Attempt {
    Attempt { start, outcome: Outcome::NotFound }
}

#[test]
fn a_corner_that_lifts_off_ends_an_attempt() {
    let (round, wavy) = (Parabola::new(1.0, [-1.0, 1.0]).unwrap(), wavy());
    let lifts_off = |error| matches!(error, ContactError::Solve(SolveError::LiftsOff { .. }));
    let held = Contact::new(&Flat, &round).unwrap().edges(Edge::Fixed(-0.5), Edge::Free);
    let (report, error) = failure(&held, 0.01);
    assert!(lifts_off(error));
    assert_eq!(report.attempts(), [not_found(Start::Middle)]);
    let held = Contact::new(&Flat, &wavy).unwrap().edges(Edge::Fixed(-0.7), Edge::Free);
    let (report, error) = failure(&held, 0.01);
    assert!(lifts_off(error));
    assert_eq!(report.attempts().first(), Some(&not_found(Start::ActiveSet)));
    assert_eq!(report.attempts().last(), Some(&not_found(Start::LowestGap)));
}

#[test]
fn a_search_that_finds_no_limits_ends_an_attempt() {
    let round = Parabola::new(1.0, [-1.0, 1.0]).unwrap();
    let contact = Contact::new(&Flat, &round).unwrap();
    for contact in [contact.clone(), contact.clone().single_interval(true)] {
        let (report, error) = failure(&contact, 2.0);
        assert!(matches!(error, ContactError::Solve(SolveError::DomainTooShort { .. })), "{error}");
        assert_eq!(report.attempts(), [not_found(Start::Middle)]);
    }
    let strict = EdgePressure { at_a: 0.1, at_b: 0.1, ..EdgePressure::zero(0.05, 1e-30) };
    let (report, error) = failure(&contact.edge_pressure(strict), 0.1);
    assert!(matches!(error, ContactError::Solve(SolveError::EdgePressureNotMet { .. })), "{error}");
    assert_eq!(report.attempts(), [not_found(Start::Middle)]);
}

#[test]
fn a_body_that_no_search_can_sample_ends_an_attempt() {
    let wavy = wavy();
    let failing = Curve::new([-1.5, 1.5], |k: f64| {
        let point = wavy.at(k);
        CurvePoint { y: if (1.1..1.25).contains(&k) { f64::NAN } else { point.y }, ..point }
    });
    let (report, error) = failure(&Contact::new(&Flat, &failing).unwrap(), 0.01);
    assert!(matches!(error, ContactError::Input(InputError::Profile { .. })), "{error}");
    assert_eq!(report.attempts(), [not_found(Start::LowestGap)]);
}

/// A user may stop a search at any time.
#[test]
fn a_search_that_is_stopped_ends_an_attempt() {
    let (round, wavy, calls) =
        (Parabola::new(1.0, [-1.0, 1.0]).unwrap(), wavy(), AtomicUsize::new(0));
    let bodies: [(&dyn ParametricProfile<f64>, _); 2] =
        [(&round, Start::Middle), (&wavy, Start::LowestGap)];
    for (body, first) in bodies {
        for most in 0.. {
            calls.store(0, Ordering::Relaxed);
            let stop = |_, _| match calls.fetch_add(1, Ordering::Relaxed) < most {
                true => ControlFlow::Continue(()),
                false => ControlFlow::Break(()),
            };
            let contact = Contact::new(&Flat, body).unwrap().watch(&stop);
            if contact.solve(Control::Load(0.01)).is_ok() {
                assert!(most > 0);
                break;
            }
            calls.store(0, Ordering::Relaxed);
            let (report, error) = failure(&contact, 0.01);
            assert!(matches!(error, ContactError::Solve(SolveError::Cancelled { .. })), "{error}");
            let last = report.attempts().last().map(|last| last.outcome);
            assert_eq!(last, Some(Outcome::NotFound), "{most}");
            assert!(most > 0 || report.attempts()[0] == not_found(first), "{report:?}");
        }
    }
}
