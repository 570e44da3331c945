//! The boundary elements used as an oracle by other tests, against closed forms.
#![allow(missing_docs)]

use crate::boundary_elements::{Oracle, height, solve};
use crate::common::NanSafe;
use crate::common::{graph, join, paper, parabola, several};
use crate::forms::KAPPA;

use linecontact::reference::{
    ClosedForm, Cosine, FlatPunch, Hertz, PolynomialMap, Quartic, RoundedPunch, UnequalRadii, Wedge,
};
use linecontact::{Interval, ParametricProfile};
use std::f64::consts::PI;

/// Returns the errors of the limits, relative to the oracle's estimates and to the width, and the
/// largest error of a pressure relative to the peak, away from kinks and corners.
fn errors(form: &dyn ClosedForm<f64>, oracle: &Oracle) -> [f64; 3] {
    let contacts = form.contacts();
    assert_eq!(oracle.contacts.len(), contacts.len(), "{:?} {contacts:?}", oracle.contacts);
    let [mut admitted, mut wide, mut pressure] = [0.0f64; 3];
    let mut peak = 0.0f64;
    for ((got, error), want) in oracle.contacts.iter().zip(&oracle.errors).zip(&contacts) {
        let width = want.right - want.left;
        for (got, want, error) in
            [(got.left, want.left, error[0]), (got.right, want.right, error[1])]
        {
            let off = (got - want).abs();
            admitted = admitted.nan_max(off / error.max(1e-12 * width));
            wide = wide.nan_max(off / width);
        }
        for i in 1..60 {
            let x = want.at_angle(PI * f64::from(i) / 60.3);
            let cell = 3.0 * oracle.cell(x);
            let kink = |&breakpoint: &f64| (breakpoint - x).abs() < cell;
            let exact = form.pressure(x, KAPPA);
            let corner = form.edges().iter().any(|edge| !matches!(edge, linecontact::Edge::Free));
            if form.breakpoints().iter().any(kink) || corner && !(4..57).contains(&i) {
                continue;
            }
            peak = peak.max(exact);
            pressure = pressure.nan_max((oracle.at(x) - exact).abs());
        }
    }
    [admitted, wide, pressure / peak]
}

#[test]
fn it_agrees_with_closed_forms() {
    let map = |form, count, amplitude| PolynomialMap::new(form, count, amplitude, 1.0).unwrap();
    let hertz = |half_width| Hertz::new(0.7, half_width).unwrap();
    let forms: Vec<(&str, f64, Box<dyn ClosedForm<f64>>)> = vec![
        ("Hertz", 1.0, Box::new(hertz(0.3))),
        ("small", 1.0, Box::new(hertz(1e-4))),
        ("wedge", 1.0, Box::new(Wedge::unequal(0.2, 0.7, 0.3).unwrap())),
        ("radii", 1.0, Box::new(UnequalRadii::new(1.0, 0.05, 0.4).unwrap())),
        ("rounded punch", 1.0, Box::new(RoundedPunch::new(0.3, 0.4, 0.35).unwrap())),
        ("cosine", 0.9, Box::new(Cosine::new(0.1, 2.0, 0.5).unwrap())),
        ("punch", 0.5, Box::new(FlatPunch::under_load(0.5, 0.1, 0.7, KAPPA).unwrap())),
        ("on one edge", 0.5, Box::new(FlatPunch::under_load(0.5, 0.9, 0.2, KAPPA).unwrap())),
        ("two", 1.2, Box::new(map(hertz(0.3), 2, 0.4))),
        ("two, nearly one", 1.2, Box::new(map(hertz(0.3), 2, 0.3003))),
        ("three, small", 1.2, Box::new(map(hertz(0.3), 3, 60.0))),
        ("five", 1.1, Box::new(map(hertz(0.3), 5, 0.5))),
        ("eight", 1.05, Box::new(map(hertz(0.3), 8, 0.5))),
        ("quartic", 1.6, Box::new(Quartic::under_load(0.3, 1.0, 0.3, KAPPA).unwrap())),
        ("quartic, merged", 1.8, Box::new(Quartic::under_load(0.3, 1.0, 1.2, KAPPA).unwrap())),
    ];
    for (name, reach, form) in forms {
        let load = form.load(KAPPA);
        let started = std::time::Instant::now();
        let oracle = solve(&|x| form.height(x), KAPPA, load, [-reach, reach], &form.breakpoints());
        let oracle = oracle.expect(name);
        let [admitted, wide, pressure] = errors(&*form, &oracle);
        println!(
            "{name:16} nodes {:4} limits {admitted:8.1e} of a cell, {wide:8.1e} of the width, P {pressure:8.1e}  {:?}",
            oracle.x.len(),
            started.elapsed()
        );
        assert!(admitted <= 1.0 && wide < 1e-3, "{name}: {admitted} {wide}");
        assert!(pressure < 2e-3, "{name}: {pressure}");
        assert!((oracle.load() / load - 1.0).abs() < 1e-9, "{name}: {}", oracle.load());
        assert!(oracle.gap.iter().all(|&gap| gap >= 0.0), "{name}");
    }
}

/// Contacts without a closed form, from `tests/data/several`.
#[test]
fn it_agrees_with_files() {
    type Height = fn(f64) -> f64;
    let scenes: [(&str, f64, f64, Height); 3] = [
        ("rough_parabola", 0.02, 2.0, |x| {
            x * x / 2.0 + 0.01 * (9.0 * x + 0.4).cos() - 0.006 * (17.3 * x + 1.9).cos()
                + 0.003 * (31.0 * x + 4.0).cos()
        }),
        ("wavy_parabola_5", 0.03, 2.0, |x| x * x / 2.0 + 0.012 * (20.0 * x + 0.3).cos()),
        ("wavy_punch_one_corner", 0.05, 1.0, |x| -0.02 * (7.0 * x + 0.4).cos() + 0.02 * x),
    ];
    for (name, load, reach, height) in scenes {
        let oracle = solve(&height, PI / 2.0, load, [-reach, reach], &[]).expect(name);
        let want = several(name);
        assert_eq!(oracle.contacts.len(), want.contacts.len(), "{name}");
        assert_eq!(oracle.disagreement(&want.contacts), None, "{name}");
        // The oracle disagrees with a contact that is displaced, too large or missing.
        for wrong in 0..want.contacts.len() {
            let mut contacts = want.contacts.clone();
            contacts[wrong].right += 2e-3 * contacts[wrong].half_width();
            assert!(oracle.disagreement(&contacts).is_some(), "{name}");
            contacts.remove(wrong);
            assert!(oracle.disagreement(&contacts).is_some(), "{name}");
        }
        let hull = Interval {
            left: want.contacts[0].left,
            right: want.contacts[want.contacts.len() - 1].right,
        };
        assert!(oracle.disagreement(&[hull]).is_some(), "{name}");
        for [x, pressure] in want.points {
            let corner = (x.abs() - 1.0).abs() < 0.02;
            let off = (oracle.at(x) - pressure).abs() / 0.2;
            assert!(off < 2e-3 || corner, "{name}: P({x}) off by {off:e}");
        }
    }
}

/// Five wedges, too: a kink inside each contact, between nodes.
#[test]
fn kinks_that_it_is_not_told_of() {
    let wedge = Wedge::unequal(0.2, 0.3, 0.4).unwrap();
    let form = PolynomialMap::new(wedge, 5, 0.7, 1.0).unwrap();
    let oracle = solve(&|x| form.height(x), KAPPA, form.load(KAPPA), [-1.05, 1.05], &[]).unwrap();
    let [admitted, wide, pressure] = errors(&form, &oracle);
    println!("{admitted} {wide} {pressure}");
    assert!(wide < 5e-3 && pressure < 0.05, "{admitted} {wide} {pressure}");
}

#[test]
fn heights_of_curves() {
    let body = join(vec![
        graph(-2.0, 0.0, |x| [x * x / 2.0, x]),
        graph(0.0, 1.0, |x| [x * x * x, 3.0 * x * x]),
        graph(1.0, 4.0, |x| [x, 1.0]),
    ]);
    for (x, want) in [(-2.0, 2.0), (-0.3, 0.045), (0.0, 0.0), (0.5, 0.125), (1.0, 1.0), (3.7, 3.7)]
    {
        assert!((height(&*body, x) - want).abs() < 1e-15, "{x}");
    }
    assert!((height(&*parabola(1.0), 0.7) - 0.245).abs() < 1e-15);
    // A curve of the paper, at a parameter.
    let curve = paper::three().upper;
    let [from, to] = curve.domain();
    let k = from + 0.4 * (to - from);
    let point = curve.at(k);
    assert!((height(&*curve, point.x) - point.y).abs() < 1e-9 * point.y.abs(), "{point:?}");
}
