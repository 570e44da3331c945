//! User-defined searches that stop early: their errors show.
#![allow(missing_docs)]

use crate::common::{Strategy, by_cubic, graph, on_flat};
use linecontact::quadrature::Quadrature;
use linecontact::search::{Bracket, Brent, LimitSearch, Root, SearchError, StoppingCriteria};
use linecontact::{
    Body, Contact, ContactError, Control, Curve, CurvePoint, Flat, Interval, Midpoint, Panels,
    SolveError,
};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

#[test]
fn a_sloppy_search_for_the_limits_shows() {
    let contact = on_flat(graph(-1.0, 1.0, |x| [x * x / 2.0 + x.powi(3) / 5.0, x + 0.6 * x * x]));
    let exact = contact.solve(Control::Load(0.03)).unwrap().a();
    for relative in [0.1, 1e-2, 1e-4, 1e-8] {
        let sloppy = Brent { tolerance: StoppingCriteria::relative(relative) };
        let contact = contact.clone().limit_search(&sloppy);
        let solution = contact.solve(Control::Load(0.03)).unwrap();
        let error = (solution.a() - exact).abs() / solution.hull().half_width();
        assert!(error <= 2.0 * solution.limits_error().unwrap(), "{relative}: {error:e}");
        assert_eq!(solution.report().is_checked(), relative < 1e-2, "{relative}: {solution}");
    }
}

#[test]
fn a_sloppy_inversion_shows() {
    let body = Curve::new([-1.0, 1.0], by_cubic);
    let rule = Midpoint::default();
    let contact = Contact::new(&Flat, &body).unwrap().quadrature(&rule);
    let chord = Strategy(|f, b| {
        let [f_lo, f_hi] = b.values.unwrap();
        Strategy::take(b.lo - f_lo * (b.hi - b.lo) / (f_hi - f_lo), f, b)
    });
    let sloppy = contact.clone().inversion(&chord);
    let solution = sloppy.solve(Control::Load(0.02)).unwrap();
    let error = (solution.a() / 0.2 - 1.0).abs();
    assert!(error > 0.05 && error <= 2.0 * solution.limits_error().unwrap(), "{error}");
    assert!(!solution.report().is_checked(), "{solution}");

    for astray in [
        Strategy(|f, b| Strategy::take(5.0 * b.hi, f, b)),
        Strategy(|f, b| Strategy::take(f64::NAN, f, b)),
    ] {
        let contact = contact.clone().inversion(&astray);
        let error = contact.solve(Control::Load(0.02)).unwrap_err();
        assert!(
            matches!(
                error,
                ContactError::Solve(SolveError::Inversion {
                    source: SearchError::LeftBracket { .. },
                    ..
                })
            ),
            "{error}"
        );
    }
}

#[test]
fn an_inversion_that_stops_where_it_begins_is_an_error() {
    // The parabola by sinh 40 k: a few Newton steps do not invert it.
    let body = Curve::new([-1.0, 1.0], |k: f64| {
        let scale = 40f64.sinh();
        let (x, dx) = ((40.0 * k).sinh() / scale, 40.0 * (40.0 * k).cosh() / scale);
        CurvePoint { x, y: x * x / 2.0, dx, dy: x * dx }
    });
    let idle = Strategy(|f, b| Strategy::take(b.lo, f, b));
    let midpoint = Midpoint::DEFAULT;
    let quadratures: [&dyn Quadrature<f64>; 2] = [&Panels::FULL, &midpoint];
    for quadrature in quadratures {
        let contact = Contact::new(&Flat, &body).unwrap().inversion(&idle).quadrature(quadrature);
        let contact = contact.start(Interval { left: -0.9, right: 0.9 });
        let error = contact.solve(Control::Load(0.3)).map(|_| ()).unwrap_err();
        let ContactError::Solve(SolveError::Inversion { body: Body::Upper, x, source }) = error
        else {
            panic!("{error}")
        };
        let SearchError::NotConverged { x: k, residual } = source else { panic!("{source}") };
        let there = (40.0 * k).sinh() / 40f64.sinh();
        assert!((there - x - residual).abs() < 1e-12 && residual.abs() > 1e-3, "{source}");
    }
}

/// Brent's method that counts its searches and the values of their functions.
#[derive(Default)]
struct Counting {
    searches: AtomicUsize,
    values: AtomicUsize,
}

impl LimitSearch<f64> for Counting {
    fn find(
        &self,
        f: &mut dyn FnMut(f64) -> f64,
        bracket: &Bracket<f64>,
    ) -> Result<Root<f64>, SearchError<f64>> {
        self.searches.fetch_add(1, Relaxed);
        let counted = &mut |x| {
            self.values.fetch_add(1, Relaxed);
            f(x)
        };
        Brent::default().find(counted, bracket)
    }
}

#[test]
fn searches_and_their_values_are_counted() {
    let body = Curve::new([-1.0, 1.0], |k: f64| {
        let (x, dx) = (k + 0.2 * k * k * k, 1.0 + 0.6 * k * k);
        CurvePoint { x, y: x * x / 2.0 + x.powi(3) / 5.0, dx, dy: (x + 0.6 * x * x) * dx }
    });
    let rule = Midpoint::default();
    let of = |own: [Option<&Counting>; 2], quadrature: Option<&dyn Quadrature<f64>>| {
        let mut contact = Contact::new(&Flat, &body).unwrap().single_interval(true);
        if let Some(quadrature) = quadrature {
            contact = contact.quadrature(quadrature);
        }
        if let Some(own) = own[0] {
            contact = contact.inversion(own);
        }
        if let Some(own) = own[1] {
            contact = contact.limit_search(own);
        }
        let cost = contact.solve(Control::Load(0.02)).unwrap().cost();
        [cost.searches, cost.search_values]
    };
    let counted = |own: &Counting| [&own.searches, &own.values].map(|count| count.load(Relaxed));
    // Newton's method finds both limits at once.
    assert_eq!(of([None; 2], None), [0; 2]);
    for quadrature in [None, Some(&rule as &dyn Quadrature<f64>)] {
        let both = [Counting::default(), Counting::default()];
        let found = of([Some(&both[0]), Some(&both[1])], quadrature);
        let [inversion, limits] = [0, 1].map(|i| counted(&both[i]));
        assert_eq!(found, [0, 1].map(|i| inversion[i] + limits[i]));
        assert!(limits[0] > 0 && limits[1] > limits[0], "{limits:?}");
        assert!(inversion[0] > 0 && inversion[1] > inversion[0], "{inversion:?}");
    }
}
