//! A user-defined quadrature: Gauss-Chebyshev sums, and the pressure by the series of the slope.
#![allow(missing_docs)]

use crate::common::{graph, join, on_flat, parabola};
use crate::forms::KAPPA;
use linecontact::gap::Sampler;
use linecontact::quadrature::{Integrator, LoadCase, Moments, Quadrature};
use linecontact::reference::{ClosedForm, Exponential, body};
use linecontact::{
    Contact, ContactError, Control, Cost, Edge, Ends, Estimate, Flat, Gap, Interval, Midpoint,
    Panels, SolveError, Solver,
};
use std::any::Any;
use std::f64::consts::PI;
use std::sync::Arc;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

type Asked<R> = Result<R, ContactError<f64>>;

#[derive(Default)]
struct Rule {
    points: usize,
    /// Number of integrators made.
    made: AtomicUsize,
    /// Breakpoints reported by the gap.
    breakpoints: Option<Arc<Mutex<Vec<Breakpoints>>>>,
}

/// Range of a gap, and its breakpoints in rising and in falling order.
type Breakpoints = ([f64; 2], Vec<f64>, Vec<f64>);

#[derive(Clone)]
struct Sums {
    points: usize,
    sampler: Sampler<f64>,
    on: Interval<f64>,
    /// Coefficients of the slope.
    series: Vec<f64>,
    breakpoints: Option<Arc<Mutex<Vec<Breakpoints>>>>,
}

impl Quadrature<f64> for Rule {
    fn integrator(&self) -> Asked<Box<dyn Integrator<f64>>> {
        self.made.fetch_add(1, Relaxed);
        Ok(Box::new(Sums {
            points: self.points,
            sampler: Sampler::default(),
            on: Interval { left: 0.0, right: 0.0 },
            series: Vec::new(),
            breakpoints: self.breakpoints.clone(),
        }))
    }
    fn serves(&self, integrator: &dyn Integrator<f64>) -> bool {
        let known = (integrator as &dyn Any).downcast_ref::<Sums>();
        known.is_some_and(|sums| sums.points == self.points)
    }
}

impl Sums {
    /// Returns the coefficients of cos kθ, k < K, in the slope over an interval.
    fn coefficients<const K: usize>(
        &mut self,
        gap: &Gap<f64>,
        on: Interval<f64>,
        of: [usize; K],
    ) -> Asked<[f64; K]> {
        let mut sums = [0.0; K];
        for i in 0..self.points {
            let angle = PI * (i as f64 + 0.5) / self.points as f64;
            let slope = self.sampler.slope(gap, on.at_angle(angle))?;
            for (sum, k) in sums.iter_mut().zip(of) {
                *sum += slope * (k as f64 * angle).cos() / self.points as f64;
            }
        }
        Ok(sums)
    }
}

impl Integrator<f64> for Sums {
    fn fork(&self) -> Box<dyn Integrator<f64>> {
        Box::new(self.clone())
    }
    fn reset(&mut self, same_bodies: bool) {
        self.sampler.cost = Cost::default();
        if !same_bodies {
            self.sampler = Sampler::default();
        }
    }
    fn moments(&mut self, gap: &Gap<f64>, on: Interval<f64>) -> Asked<Moments<f64>> {
        let [m0, m1, m2] = self.coefficients(gap, on, [0, 1, 2])?;
        let error = 1e-15 * m1.abs();
        let (m2, l1_norm) = (Some(m2), m1.abs());
        Ok(Moments { m0, m1, m2, l1_norm, error, inversion: 0.0, derivatives: None })
    }
    fn prepare(&mut self, gap: &Gap<f64>, on: Interval<f64>) -> Asked<()> {
        // Invalid arguments.
        let (range, mut panels) = (gap.range(), Panels::FULL.integrator()?);
        for x in [range[0] - 1.0, range[1] + 0.5, f64::NAN] {
            let beyond = Sampler::default().slope(gap, x).unwrap_err();
            assert!(
                matches!(beyond, ContactError::Solve(SolveError::OutsideBodies { .. })),
                "{beyond}"
            );
            let beyond = panels.moments(gap, Interval { left: x, right: x + 9.0 }).unwrap_err();
            assert!(
                matches!(beyond, ContactError::Solve(SolveError::OutsideBodies { .. })),
                "{beyond}"
            );
        }
        // An integrator that was not prepared has no samples.
        let load_case = LoadCase { kappa: 1.0, load: 1.0, free: Ends::both(true) };
        let unprepared = Midpoint::DEFAULT.integrator()?;
        let estimate = unprepared.estimate(gap, &load_case, on.centre(), &mut Cost::default())?;
        assert_eq!(estimate.error, f64::INFINITY);
        self.on = on;
        self.series.clear();
        for k in 0..self.points - 1 {
            let [c] = self.coefficients(gap, on, [k])?;
            self.series.push(if k == 0 { c } else { 2.0 * c });
        }
        if let Some(seen) = &self.breakpoints {
            let after = |x: &f64| gap.breakpoint_after(*x);
            let before = |x: &f64| gap.breakpoint_before(*x);
            let up = std::iter::successors(gap.breakpoint_after(f64::NEG_INFINITY), after);
            let down = std::iter::successors(gap.breakpoint_before(f64::INFINITY), before);
            let inside: Vec<f64> = gap.breakpoints(on).collect();
            let within = |x: &f64| *x > on.left && *x < on.right;
            assert_eq!(inside, up.clone().filter(within).collect::<Vec<_>>());
            seen.lock().unwrap().push((gap.range(), up.collect(), down.collect()));
        }
        Ok(())
    }
    /// Evaluates the pressure by `PV∫ sqrt(1 - t²) U_{n-1}(t)/(z - t) dt = π T_n(z)`, and
    /// `2 T_n = U_n - U_{n-2}`.
    fn estimate(
        &self,
        _: &Gap<f64>,
        of: &LoadCase<f64>,
        x: f64,
        _: &mut Cost,
    ) -> Asked<Estimate<f64>> {
        let (angle, l) = (self.on.angle(x), self.on.half_width());
        let term = |(k, c): (usize, &f64)| match k {
            0 => c * angle.cos(),
            1 => 0.5 * c * (2.0 * angle).cos(),
            _ => 0.5 * c * (((k + 1) as f64 * angle).cos() - ((k - 1) as f64 * angle).cos()),
        };
        let integral = PI * l * self.series.iter().enumerate().map(term).sum::<f64>();
        let value = (PI * of.load - of.kappa * integral) / (PI * PI * l * angle.sin());
        Ok(Estimate { value, error: 1e-14 * of.load / l })
    }
    fn cost(&self) -> Cost {
        self.sampler.cost
    }
}

#[test]
fn a_rule_of_ones_own_solves_hertz_and_another() {
    let rule = Rule { points: 40, ..Rule::default() };
    let contact = on_flat(parabola(1.0)).quadrature(&rule);
    let mut solver = Solver::new();
    for l in [0.1f64, 0.7] {
        // F = L²/2, P = sqrt(L² - x²)/π
        for control in
            [Control::Load(l * l / 2.0), Control::HalfWidth(l), Control::PeakPressure(l / PI)]
        {
            let solution = solver.solve(&contact, control).unwrap();
            let near = if let Control::PeakPressure(_) = control { 1e-12 } else { 1e-14 };
            assert!((solution.a() / l - 1.0).abs() < near, "{solution:?}");
            assert!((2.0 * solution.load() / (l * l) - 1.0).abs() < 2.0 * near, "{solution:?}");
            let pressure = solution.pressure().unwrap();
            for z in [-0.9f64, 0.0, 0.5] {
                let exact = l * (1.0 - z * z).sqrt() / PI;
                assert!((pressure.at(z * l).unwrap() / exact - 1.0).abs() < 2.0 * near);
            }
            assert!(solution.moment().unwrap().abs() < 1e-15);
        }
    }
    assert_eq!(rule.made.load(Relaxed), 1, "a solver goes on with it");

    let form = Exponential::new(1.0, 0.8, 0.5).unwrap();
    let body = body(&form, -3.0, 3.0).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap().kappa(KAPPA).quadrature(&rule);
    let (want, solution) = (form.limits(), contact.solve(Control::Load(form.load(KAPPA))).unwrap());
    let got = solution.hull();
    assert!((got.left - want.left).abs() < 1e-14 && (got.right - want.right).abs() < 1e-14);
    for angle in [0.3, 1.0, 2.0, 2.9] {
        let x = want.at_angle(angle);
        let (got, exact) = (solution.pressure().unwrap().at(x).unwrap(), form.pressure(x, KAPPA));
        assert!((got / exact - 1.0).abs() < 1e-12, "{x}: {got} {exact}");
    }
    assert!(solution.cost().samples > 0);
}

#[test]
fn a_gap_knows_the_breakpoints_of_both_bodies_where_both_are() {
    // Pieces of one parabola and of one line: the contact is Hertz's.
    let cut = |at: &[f64]| {
        let piece = |ends: &[f64]| graph(ends[0], ends[1], |x| [x * x / 2.0, x]);
        join(at.windows(2).map(piece).collect())
    };
    let level =
        |at: &[f64]| join(at.windows(2).map(|e| graph(e[0], e[1], |_| [0.0, 0.0])).collect());
    let upper = cut(&[-1.0, -0.75, -0.125, 0.25, 2.0]);
    let lower = level(&[-0.875, -0.25, -0.125, 0.5, 0.75, 0.9375, 1.5]);
    let seen = Arc::new(Mutex::new(Vec::new()));
    let rule = Rule { points: 20, breakpoints: Some(seen.clone()), ..Rule::default() };
    let contact = Contact::new(&*lower, &*upper).unwrap().quadrature(&rule);
    let contact = contact.edges(Edge::Free, Edge::Free);
    let solution = contact.solve(Control::Load(0.08)).unwrap();
    assert!((solution.a() / 0.4 - 1.0).abs() < 1e-14, "{solution:?}");
    let all = vec![-0.75, -0.25, -0.125, 0.25, 0.5, 0.75, 0.9375];
    let falling: Vec<f64> = all.iter().rev().copied().collect();
    let seen = seen.lock().unwrap();
    assert!(!seen.is_empty());
    for (range, up, down) in seen.iter() {
        assert_eq!((*range, up, down), ([-0.875, 1.5], &all, &falling));
    }
}

/// Panels under another name, said to be them or not.
struct Renamed(Option<Panels>);

impl Quadrature<f64> for Renamed {
    fn integrator(&self) -> Asked<Box<dyn Integrator<f64>>> {
        Panels::FULL.integrator()
    }
    fn panels(&self) -> Option<Panels> {
        self.0
    }
}

/// Only panels that are said to be them find two contacts, and go on with one another's samples.
#[test]
fn a_quadrature_may_stand_for_panels() {
    let body = graph(-2.5, 2.5, |x| [x.powi(4) - 2.0 * x * x, 4.0 * x.powi(3) - 4.0 * x]);
    let (contact, load) = (on_flat(body), Control::Load(0.5));
    let (said, unsaid) = (Renamed(Some(Panels::FULL)), Renamed(None));
    let mut solver = Solver::new();
    let solution = solver.solve(&contact.clone().quadrature(&said), load).unwrap();
    assert_eq!(solution.intervals().len(), 2);
    assert_eq!(solution.intervals(), contact.solve(load).unwrap().intervals());
    drop(solution);
    let again = solver.solve(&contact, load).unwrap();
    assert_eq!((again.intervals().len(), again.cost().samples), (2, 0));
    let error = contact.quadrature(&unsaid).solve(load).unwrap_err();
    assert!(matches!(error, ContactError::Solve(SolveError::NoEquilibrium { .. })), "{error}");
}
