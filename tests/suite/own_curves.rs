//! User-defined curves: points in a batch, slopes by x, pieces; by value and through pointers.
#![allow(missing_docs)]

use crate::common::by_cubic;
use linecontact::profile::{Placed, Placement};
use linecontact::quadrature::Quadrature;
use linecontact::{Contact, Control, Convexity, Curve, CurvePoint, Flat};
use linecontact::{Midpoint, Panels, ParametricProfile, Piece, Piecewise, Solution};
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// Curve of [`by_cubic`] that evaluates its points in batches, and counts them.
#[derive(Default)]
struct Batches {
    batches: AtomicUsize,
    in_batches: AtomicUsize,
    alone: AtomicUsize,
}

impl ParametricProfile<f64> for Batches {
    fn domain(&self) -> [f64; 2] {
        [-1.0, 1.0]
    }
    fn at(&self, k: f64) -> CurvePoint<f64> {
        self.alone.fetch_add(1, Relaxed);
        by_cubic(k)
    }
    fn at_many(&self, k: &[f64], points: &mut [CurvePoint<f64>]) {
        assert_eq!(k.len(), points.len());
        self.batches.fetch_add(1, Relaxed);
        self.in_batches.fetch_add(k.len(), Relaxed);
        for (to, &k) in points.iter_mut().zip(k) {
            *to = by_cubic(k);
        }
    }
}

#[test]
fn points_in_batches_are_those_one_by_one() {
    let bits = |solution: &Solution<f64>| {
        let (on, pressure) = (solution.hull(), solution.pressure().unwrap());
        [on.left, on.right, pressure.at(0.05).unwrap(), solution.limits_error().unwrap()]
            .map(f64::to_bits)
    };
    let (batches, one_by_one) = (Batches::default(), Curve::new([-1.0, 1.0], by_cubic));
    let midpoint = Midpoint::DEFAULT;
    let quadratures: [&dyn Quadrature<f64>; 2] = [&Panels::FULL, &midpoint];
    for (rule, quadrature) in quadratures.into_iter().enumerate() {
        let contact = Contact::new(&Flat, &batches).unwrap().quadrature(quadrature);
        let [many, alone] = [&batches.in_batches, &batches.alone].map(|count| count.load(Relaxed));
        let solution = contact.solve(Control::Load(0.02)).unwrap();
        let many = batches.in_batches.load(Relaxed) - many;
        let alone = batches.alone.load(Relaxed) - alone;
        // F = L²/2
        assert!((solution.a() / 0.2 - 1.0).abs() < 4e-15, "{solution:?}");
        // Every point evaluated is counted, and most of those of the panels are in batches.
        let cost = solution.cost();
        assert_eq!(many + alone, cost.evaluations + cost.heights);
        assert!(many > 0 && (rule == 1 || 2 * many > alone), "{many} {alone}");
        let other = Contact::new(&Flat, &one_by_one).unwrap().quadrature(quadrature);
        let other = other.solve(Control::Load(0.02)).unwrap();
        assert_eq!(bits(&solution), bits(&other));
        assert_eq!(cost, other.cost());
    }
    assert!(batches.batches.load(Relaxed) < batches.in_batches.load(Relaxed));
}

/// Profile with its own implementation of every method.
struct Odd {
    inner: Curve<f64, fn(f64) -> CurvePoint<f64>>,
}

impl ParametricProfile<f64> for Odd {
    fn domain(&self) -> [f64; 2] {
        [-3.0, 4.0]
    }
    fn at(&self, k: f64) -> CurvePoint<f64> {
        CurvePoint { x: k, y: 1.0, dx: 2.0, dy: 3.0 }
    }
    fn x(&self, k: f64) -> f64 {
        k + 10.0
    }
    fn y(&self, k: f64) -> f64 {
        k + 20.0
    }
    fn dx(&self, k: f64) -> f64 {
        k + 30.0
    }
    fn dy(&self, k: f64) -> f64 {
        k + 40.0
    }
    fn slope_at(&self, x: f64) -> Option<f64> {
        Some(5.0 * x)
    }
    fn at_many(&self, _: &[f64], points: &mut [CurvePoint<f64>]) {
        points.fill(CurvePoint { x: 7.0, y: 7.0, dx: 7.0, dy: 7.0 });
    }
    fn convexity(&self) -> Convexity {
        Convexity::Convex
    }
    fn pieces(&self) -> usize {
        11
    }
    fn piece(&self, index: usize) -> Option<Piece<'_, f64>> {
        (index == 2).then(|| Piece::new(&self.inner).unwrap())
    }
}

#[test]
fn a_curve_that_is_put_elsewhere_or_joined_is_asked_in_batches_too() {
    let batches = Arc::new(Batches::default());
    let counts = || [&batches.batches, &batches.alone].map(|count| count.load(Relaxed));
    let placement = Placement::default().rotated(0.1).scaled(2.0).flipped().shifted(0.3, -0.2);
    let placed = Placed::new(batches.clone(), placement).unwrap();
    let k = [-0.9, -0.1, 0.4, 1.0];
    let mut points = k.map(by_cubic);
    let before = counts();
    placed.at_many(&k, &mut points);
    assert_eq!(counts(), [before[0] + 1, before[1]]);
    assert_eq!(points, k.map(|k| placed.at(k)));

    // Before it is joined, a piece is checked over its whole length in one batch, and for its
    // derivatives.
    let before = counts();
    Piecewise::new(vec![batches.clone()]).unwrap();
    let after = counts();
    assert_eq!(after[0], before[0] + 1);
    assert!(after[1] - before[1] <= 6, "{before:?} {after:?}");
}

#[test]
fn a_pointer_to_a_profile_answers_as_the_profile_does() {
    let odd = || Odd { inner: Curve::new([-1.0, 1.0], by_cubic) };
    fn check<P: ParametricProfile<f64>>(profile: P) {
        assert_eq!(profile.domain(), [-3.0, 4.0]);
        let at = profile.at(0.5);
        assert_eq!([at.x, at.y, at.dx, at.dy], [0.5, 1.0, 2.0, 3.0]);
        let one_by_one = [profile.x(0.5), profile.y(0.5), profile.dx(0.5), profile.dy(0.5)];
        assert_eq!(one_by_one, [10.5, 20.5, 30.5, 40.5]);
        assert_eq!(profile.slope_at(0.5), Some(2.5));
        let mut points = [profile.at(0.0); 2];
        profile.at_many(&[0.1, 0.2], &mut points);
        assert!(points.iter().all(|point| [point.x, point.dy] == [7.0; 2]), "{points:?}");
        assert!(matches!(profile.convexity(), Convexity::Convex));
        assert_eq!(profile.pieces(), 11);
        assert_eq!(profile.piece(2).map(|piece| piece.x()), Some([-1.2, 1.2]));
        assert!(profile.piece(1).is_none());
    }
    let (own, lent) = (odd(), &odd());
    check::<&Odd>(lent);
    check::<&&Odd>(&lent);
    check(own);
    check(Box::new(odd()));
    check(Arc::new(odd()));
    check(Box::new(odd()) as Box<dyn ParametricProfile<f64>>);
    check(Arc::new(odd()) as Arc<dyn ParametricProfile<f64>>);
}
