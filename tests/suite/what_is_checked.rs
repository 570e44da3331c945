//! Reported checks of a solution, for every search, quadrature and control: a contact far from the
//! known one is never reported as checked, and a contact near it always is.
#![allow(missing_docs)]

use crate::common::{Strategy, controls::controls_of, graph, on_flat};
use linecontact::profile::Parabola;
use linecontact::quadrature::Quadrature;
use linecontact::search::{Bisection, Brent, LimitSearch, StoppingCriteria};
use linecontact::{
    Contact, Control, Edge, EdgePressure, Flat, Material, Midpoint, Outcome, Panels, PlaneState,
    Solution,
};
use std::f64::consts::PI;
use std::sync::Arc;

const L: f64 = 0.2;
const LOAD: f64 = L * L / 2.0;

/// Largest uncertainty of the limits, as a share of the half-width, at which they determine the
/// contact.
const OPEN: f64 = 1.0 / 1600.0;

type Named<T> = Vec<(String, T)>;
type Search = Option<Box<dyn LimitSearch<f64>>>;

fn searches() -> Named<Search> {
    let mut all: Named<Search> = vec![
        ("default".to_owned(), None),
        ("bisection".to_owned(), Some(Box::new(Bisection::DEFAULT))),
    ];
    for relative in [1e-8, 1e-3, 0.1] {
        let tolerance = StoppingCriteria::relative(relative);
        all.push((format!("Brent {relative}"), Some(Box::new(Brent { tolerance }))));
        all.push((format!("bisection {relative}"), Some(Box::new(Bisection { tolerance }))));
    }
    let stops: [(&str, Strategy); 4] = [
        ("middle", Strategy(|f, b| Strategy::take(0.5 * (b.lo + b.hi), f, b))),
        ("lo", Strategy(|f, b| Strategy::take(b.lo, f, b))),
        ("hi", Strategy(|f, b| Strategy::take(b.hi, f, b))),
        (
            "chord",
            Strategy(|f, b| {
                let [f_lo, f_hi] = b.values.unwrap_or([-1.0, 1.0]);
                Strategy::take(b.lo - f_lo * (b.hi - b.lo) / (f_hi - f_lo), f, b)
            }),
        ),
    ];
    all.extend(stops.into_iter().map(|(name, search)| {
        (format!("stops at {name}"), Some(Box::new(search) as Box<dyn LimitSearch<f64>>))
    }));
    all
}

fn quadratures() -> Named<Box<dyn Quadrature<f64>>> {
    let mut all: Named<Box<dyn Quadrature<f64>>> = Vec::new();
    all.push(("panels".to_owned(), Box::new(Panels::FULL)));
    for segments in [4, 32] {
        let rule = Midpoint { segments, ..Midpoint::DEFAULT };
        all.push((format!("midpoint {segments}"), Box::new(rule)));
    }
    all.push(("paper".to_owned(), Box::new(Midpoint::paper(8, 1))));
    all
}

/// Tells whether a solution reports that it is checked, after asserting that all its reports agree.
fn says(name: &str, solution: &Solution<f64>) -> bool {
    let checked = solution.report().is_checked();
    let outcome = solution.report().attempts().last().map(|attempt| attempt.outcome);
    assert_eq!(checked, outcome == Some(Outcome::Passed), "{name}");
    let text = solution.to_string();
    let line = text.lines().find(|line| line.starts_with("limits ")).unwrap();
    assert_eq!(checked, line.ends_with(", checked"), "{name}: {text}");
    assert_eq!(!checked, line.ends_with(", not checked"), "{name}: {text}");
    if let Ok(summary) = solution.summary() {
        assert_eq!(checked, summary.checked, "{name}");
    }
    checked
}

#[test]
fn what_is_said_is_what_was_checked() {
    let declared = Parabola::new(1.0, [-1.0, 1.0]).unwrap();
    let declared = Contact::owned(Arc::new(Flat), Arc::new(declared)).unwrap();
    // A body of unknown convexity, not symmetric, with corners that it does not reach.
    let aside = on_flat(graph(-0.9, 1.1, |x| [x * x / 2.0, x]))
        .edges(Edge::FreeUntil(-0.3), Edge::FreeUntil(0.4));
    // κ = 1.
    let soft = Material::elastic(4.0 / PI, 0.0);
    let (searches, quadratures) = (searches(), quadratures());
    let mut counts = [0; 3];
    for (body, contact) in [("declared", declared), ("aside", aside)] {
        let contact = contact.materials(soft, soft, PlaneState::Stress);
        let controls = controls_of(&contact.solve(Control::Load(LOAD)).unwrap());
        for (by, search) in &searches {
            for (rule, quadrature) in &quadratures {
                let mut contact = contact.clone().quadrature(&**quadrature);
                if let Some(search) = search {
                    contact = contact.limit_search(&**search);
                }
                for &control in &controls {
                    let name = format!("{body}, {by}, {rule}, {control:?}");
                    let Ok(solution) = contact.solve(control) else {
                        counts[0] += 1;
                        continue;
                    };
                    let on = solution.hull();
                    let off = (on.left + L).abs().max((on.right - L).abs()) / L;
                    let doubt = solution.limits_error().unwrap();
                    let checked = says(&name, &solution);
                    counts[if checked { 1 } else { 2 }] += 1;
                    assert!(!checked || off <= 2.0 * OPEN, "{name}: off by {off:e} of {doubt:e}");
                    assert_eq!(checked, doubt <= OPEN, "{name}: off by {off:e} of {doubt:e}");
                    if let Control::Load(_) = control {
                        let alone = contact.clone().single_interval(true).solve(control);
                        assert!(!says(&name, &alone.unwrap()), "{name}");
                    }
                }
            }
        }
    }
    println!("refused, checked, not checked: {counts:?}");
    assert!(counts[1] > 150 && counts[2] > 80, "{counts:?}");
}

/// Eq. (6), and given intervals.
#[test]
fn other_edges_say_what_was_checked_too() {
    let body = || graph(-1.0, 1.0, |x| [x * x / 2.0, x]);
    for (rule, quadrature) in quadratures() {
        let contact = on_flat(body()).quadrature(&*quadrature);
        let wanted = EdgePressure::zero(0.05, 1.0);
        if let Ok(solution) = contact.clone().edge_pressure(wanted).solve(Control::Load(LOAD)) {
            assert!(!says(&rule, &solution), "{rule}");
        }
        // P = (L² - x²)/.. + (F - l²/2)/..: the corners press from F = l²/2 on.
        let held = contact.edges(Edge::Fixed(-0.2), Edge::Fixed(0.2));
        for (load, presses) in [(1.1 * LOAD, true), (0.9 * LOAD, false)] {
            let found = held.solve(Control::Load(load));
            assert_eq!(found.is_ok(), presses, "{rule}");
            if let Ok(solution) = found {
                assert!(says(&rule, &solution) && solution.limits_error().is_none(), "{rule}");
            }
            let alone = held.clone().single_interval(true).solve(Control::Load(load)).unwrap();
            assert!(!says(&rule, &alone), "{rule}");
        }
    }
}
