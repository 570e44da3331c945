//! Judgements of a survey, each with something unknown in it.

use super::convex::{Shape as Bend, convex_stretches};
use super::*;
use crate::gap::Shape;
use crate::kernel::{Bend as Bent, Formula, Kernel, RegularKernel, Spread};
use crate::profile::{Curve, CurvePoint, Flat};
use crate::search::Newton as Inversion;
use std::f64::consts::PI;
use std::ops::ControlFlow;
use std::sync::Arc;

/// Number of a node outside the contact.
const I: usize = 1;

/// What may be unknown about the gap between the first two of some nodes.
type Unknown = (&'static str, fn(&mut [Node<f64>]));
const UNKNOWN: [Unknown; 5] = [
    ("a piece is known only by its ends", |nodes| nodes[0].is_open = true),
    ("a point is missed", |nodes| (nodes[0].is_void, nodes[0].after) = (true, f64::INFINITY)),
    ("a slope is no number", |nodes| nodes[1].slopes = [f64::NAN; 2]),
    ("a wave hides in the doubt of a slope", |nodes| nodes[0].doubts = [0.0, 0.01]),
    ("a wave hides before an upright end", |nodes| {
        (nodes[0].doubts, nodes[1].slopes) = ([0.0, 0.1], [f64::INFINITY; 2]);
    }),
];

/// Shows the survey of a parabola on a flat.
fn surveyed(judge: impl Fn(&Gap<'_, f64>, &mut Survey<f64>)) {
    let body =
        Curve::new([-1.0, 1.0], |k: f64| CurvePoint { x: k, y: 0.5 * k * k, dx: 1.0, dy: k });
    let inversion = Inversion::default();
    let gap = Gap::new(Shape::Lent(&Flat), Shape::Lent(&body), &inversion).unwrap();
    let mut survey = Survey::new();
    survey.take(&gap, &mut Cost::default()).unwrap();
    judge(&gap, &mut survey);
}

fn contact() -> Interval<f64> {
    Interval { left: -0.2, right: 0.2 }
}

#[test]
fn convex_is_only_what_is_known() {
    surveyed(|_, survey| assert!(survey.shape_after(I) == Bend::Convex));
    for (what, set) in UNKNOWN {
        surveyed(|_, survey| {
            set(&mut survey.nodes[I..]);
            assert!(survey.shape_after(I) != Bend::Convex, "{what}");
        });
    }
    // Two nodes within rounding, where the slope jumps down.
    surveyed(|_, survey| {
        let node = survey.nodes[I];
        survey.nodes[I].slopes[1] += 1.0;
        survey.nodes[I + 1] = Node { x: node.x.next_up(), ..node };
        assert!(survey.shape_after(I) != Bend::Convex);
    });
}

#[test]
fn nothing_is_proved_beside_the_unknown() {
    let proves = |survey: &mut Survey<f64>, gap: &Gap<'_, f64>| {
        survey.prove(gap, contact(), 0.02, &mut Cost::default()).unwrap()
    };
    surveyed(|gap, survey| {
        assert!(proves(survey, gap) && survey.is_convex());
        survey.refine(gap, Asked::Load(0.02), 0.25, &mut Cost::default()).unwrap();
        assert!(survey.is_one_valley());
    });
    for (what, set) in UNKNOWN {
        surveyed(|gap, survey| {
            let inside = survey.nodes.partition_point(|node| node.x < 0.0);
            set(&mut survey.nodes[inside - 1..]);
            assert!(!proves(survey, gap) && !survey.is_convex(), "{what}");
        });
    }
    // A slope that falls at a node in the contact.
    surveyed(|gap, survey| {
        let inside = survey.nodes.partition_point(|node| node.x < 0.0);
        survey.nodes[inside].slopes[0] += 1e-6;
        assert!(!proves(survey, gap) && !survey.is_convex());
    });
}

/// A kernel that bends nothing.
struct Nothing;

impl RegularKernel<f64> for Nothing {
    fn slope(&self, _x: f64, _s: f64) -> f64 {
        0.0
    }

    fn height(&self, _x: f64, _s: f64) -> f64 {
        0.0
    }

    fn nearest_singularity(&self) -> f64 {
        1.0
    }
}

/// No bounds are known for a bend between the places of a survey.
#[test]
fn nothing_is_proved_of_bent_bodies() {
    let formula = Some(Formula::Owned(Arc::new(Nothing)));
    let kernel = Kernel { table: None, formula, row: None, is_of_bodies: false };
    let pressure = Spread { on: contact(), q: vec![1.0] };
    surveyed(|gap, survey| {
        assert!(survey.bulges());
        let bent = gap.bent(Bent::new(&kernel, std::slice::from_ref(&pressure)), 1.0);
        survey.bend(&bent);
        assert!(survey.is_bent_as(&bent) && !survey.is_bent_as(gap) && !survey.bulges());
        let mut cost = Cost::default();
        assert!(!survey.prove(&bent, contact(), 0.02, &mut cost).unwrap());
        assert!(!survey.is_convex() && cost.heights == 0);
        survey.bend(gap);
        assert!(survey.bulges() && survey.prove(gap, contact(), 0.02, &mut cost).unwrap());
    });
}

/// Beyond a convex stretch the gap may be as low as can be where it is unknown.
#[test]
fn untouched_is_only_what_is_known() {
    let height: [Unknown; 2] = [
        ("a height is no number", |nodes| nodes[0].height = f64::NAN),
        ("a height is uncertain", |nodes| nodes[0].after = 1.0),
    ];
    surveyed(|gap, survey| {
        survey.nodes[I].doubts = [0.0, 0.01];
        assert!(survey.is_untouched_beyond(gap, contact(), 0.1) && !survey.is_convex());
    });
    for (what, set) in UNKNOWN[..2].iter().chain(&height) {
        surveyed(|gap, survey| {
            survey.nodes[I].doubts = [0.0, 0.01];
            set(&mut survey.nodes[I..]);
            assert!(!survey.is_untouched_beyond(gap, contact(), 0.1), "{what}");
        });
    }
    surveyed(|gap, survey| assert!(!survey.is_untouched_beyond(gap, contact(), f64::NAN)));
}

#[test]
fn heights_are_sure_only_where_all_is_known() {
    let after = |set: &dyn Fn(&mut [Node<f64>])| {
        let found = std::cell::Cell::new(f64::NAN);
        surveyed(|_, survey| {
            survey.nodes.iter_mut().for_each(|node| node.after = 1.0);
            set(&mut survey.nodes[I..]);
            convex_stretches(&mut survey.nodes, &mut survey.rates);
            found.set(survey.nodes[I].after);
        });
        found.get()
    };
    assert!(after(&|_| ()) < 0.1);
    for (what, set) in &UNKNOWN[..3] {
        assert!(after(set) >= 1.0, "{what}");
    }
    // Two spans further on the slope falls.
    assert_eq!(after(&|nodes| nodes[3].slopes[0] = -1.0), 1.0);
}

/// Errors are final only if no other contacts can hide.
#[test]
fn nothing_bulges_that_is_unknown() {
    surveyed(|_, survey| assert!(survey.bulges()));
    for (what, set) in &UNKNOWN[..2] {
        surveyed(|_, survey| {
            set(&mut survey.nodes[I..]);
            assert!(!survey.bulges(), "{what}");
        });
    }
    surveyed(|_, survey| {
        survey.nodes[I].height = f64::NAN;
        assert!(!survey.is_one_valley());
    });
}

#[test]
fn a_look_that_was_broken_off_has_seen_nothing() {
    let body = Curve::new([-1.0, 1.0], |k: f64| {
        let (sin, cos) = (40.0 * PI * k).sin_cos();
        CurvePoint { x: k, y: 0.5 * k * k + 1e-5 * cos, dx: 1.0, dy: k - 4e-4 * PI * sin }
    });
    let inversion = Inversion::default();
    let stop = |_: Cost, _: Interval<f64>| ControlFlow::Break(());
    for is_stopped in [false, true] {
        let gap = Gap::new(Shape::Lent(&Flat), Shape::Lent(&body), &inversion).unwrap();
        let gap = if is_stopped { gap.with_watch(&stop) } else { gap };
        let (mut survey, mut cost) = (Survey::new(), Cost::default());
        survey.take(&gap, &mut cost).unwrap();
        let found = survey.resolve(&gap, 0.02, &[contact()], &mut cost);
        assert_eq!(found.is_err(), is_stopped);
        assert_eq!(survey.is_resolved(&gap, 0.02), !is_stopped);
    }
}

/// What the panels of a contact have seen is a feature of the curve, and not of the flat below it.
#[test]
fn a_flat_has_no_features_to_learn() {
    surveyed(|gap, survey| {
        let rises = [([0.1, 0.101], 1e-3)];
        survey.learn(gap, &rises, 0.02, &mut Cost::default()).unwrap();
        let panels = survey.bodies.each_ref().map(|body| body.panels.len());
        assert!(panels[0] == 1 && panels[1] > 4, "{panels:?}");
    });
}
