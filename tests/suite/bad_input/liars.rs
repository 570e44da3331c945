//! Searches and quadratures that give up, or lie.

use super::answers::ask_all;
use super::*;
use crate::common::{NanSafe, Strategy};

#[test]
fn budgets_of_searches() {
    let mut table = Table::new("Contact::solve with a small budget");
    let (upper, load) = (power(3.0), Control::Load(0.05));
    let inverted = body();
    let rule = Midpoint::default();
    for max_evaluations in [0, 1, 2] {
        let tolerance = StoppingCriteria { max_evaluations, ..StoppingCriteria::FULL };
        for (by, strategy) in strategies(tolerance) {
            let contact =
                Contact::new(&Flat, &*inverted).unwrap().inversion(&*strategy).quadrature(&rule);
            let contact = contact.single_interval(true);
            let name = format!("inversion by {by}, {max_evaluations}");
            table.row(
                &name,
                40,
                || Ok(contact.solve(load).map(|_| ())?),
                |wrong| {
                    matches!(wrong, Wrong::Solve(SolveError::Inversion {
                        body: Body::Upper, x, source: SearchError::Budget { best },
                    }) if best.evaluations <= max_evaluations && x.abs() < 1.2 && best.x.abs() <= 1.0)
                },
            );
            let contact = Contact::new(&Flat, &*upper).unwrap().limit_search(&*strategy);
            let contact = contact.single_interval(true);
            table.outcome(
                &format!("search by {by}, {max_evaluations}"),
                0,
                || Ok(contact.solve(load).map(|_| ())?),
                |outcome| {
                    matches!(
                        outcome,
                        Ok(_)
                            | Err(Wrong::Solve(SolveError::LimitSearch {
                                source: SearchError::Budget { .. },
                                ..
                            }))
                    )
                },
            );
        }
    }
    table.finish();
}

fn root(x: f64) -> Result<Root<f64>, SearchError<f64>> {
    Ok(Root { x, residual: 0.0, bracket: [x, x], evaluations: usize::MAX })
}

#[test]
fn strategies_that_lie() {
    let mut table = Table::new("Contact::solve by a strategy that lies");
    let upper = body();
    let contact = Contact::new(&Flat, &*upper).unwrap();
    let flat = curve([-1.0, 1.0], |k| {
        let (x, dx) = (k * k * k + 1e-9 * k, 3.0 * k * k + 1e-9);
        CurvePoint { x, y: x * x / 2.0, dx, dy: x * dx }
    });
    let flat = Contact::new(&Flat, &*flat).unwrap();
    let exact = 0.1f64.sqrt();
    let rule = Midpoint::default();
    let liars: [(&str, Strategy); 10] = [
        ("says nothing was looked at", Strategy(|_, b| root(b.lo))),
        (
            "says the other end",
            Strategy(|f, b| {
                f(b.hi);
                root(b.hi)
            }),
        ),
        (
            "the middle as the root",
            Strategy(|f, b| {
                let x = b.lo + 0.37 * (b.hi - b.lo);
                f(x);
                root(x)
            }),
        ),
        ("NaN", Strategy(|_, _| root(NAN))),
        ("infinite", Strategy(|_, _| root(INF))),
        (
            "beyond",
            Strategy(|f, b| {
                let x = b.hi + 7.0 * (b.hi - b.lo);
                f(x);
                root(x)
            }),
        ),
        (
            "looks at NaN",
            Strategy(|f, b| {
                f(NAN);
                root(b.lo)
            }),
        ),
        (
            "looks at infinity",
            Strategy(|f, b| {
                f(INF);
                f(-INF);
                root(b.lo)
            }),
        ),
        (
            "looks far away",
            Strategy(|f, b| {
                f(1e300);
                f(-1e300);
                root(b.hi)
            }),
        ),
        (
            "an error of its own",
            Strategy(|_, b| Err(SearchError::NotFinite { x: b.lo, value: NAN })),
        ),
    ];
    for (name, liar) in &liars {
        for (how, contact, most) in [
            ("inversion", contact.clone().inversion(liar).quadrature(&rule), 40_000),
            ("inversion, panels", contact.clone().inversion(liar), 40_000),
            ("search", contact.clone().limit_search(liar), 4_000),
            ("search, half-width", contact.clone().limit_search(liar), 4_000),
            ("search, peak", contact.clone().limit_search(liar), 40_000),
            ("inversion of a flat spot, panels", flat.clone().inversion(liar), 40_000),
        ] {
            let load = if how.contains("width") {
                Control::HalfWidth(exact)
            } else if how.contains("peak") {
                Control::PeakPressure(exact / std::f64::consts::PI)
            } else {
                Control::Load(0.05)
            };
            let mut off = None;
            table.outcome(
                &format!("{how}: {name}"),
                most,
                || {
                    let solution = contact.solve(load)?;
                    let error =
                        (solution.a() - exact).abs().nan_max((solution.b() - exact).abs()) / exact;
                    off = Some((error, solution.limits_error().unwrap_or(0.0)));
                    Ok(())
                },
                |outcome| match outcome {
                    Ok(_) => true,
                    Err(
                        Wrong::Input(InputError::Profile { .. })
                        | Wrong::Solve(
                            SolveError::Inversion { .. }
                            | SolveError::LimitSearch { .. }
                            | SolveError::OutsideBodies { .. }
                            | SolveError::Overflow { .. },
                        ),
                    ) => true,
                    Err(Wrong::Solve(SolveError::NoPeak { .. })) => how.contains("peak"),
                    Err(_) => false,
                },
            );
            if let Some((error, estimate)) = off {
                assert!(error <= 3.0 * estimate + 4e-16, "{how}: {name}: {error:e} > {estimate:e}");
            }
        }
    }
    table.finish();
}

/// Quadrature whose values are all the same, such as NaN.
struct Same(f64);

impl Quadrature<f64> for Same {
    fn integrator(&self) -> Result<Box<dyn Integrator<f64>>, ContactError<f64>> {
        Ok(Box::new(Self(self.0)))
    }
}

impl Integrator<f64> for Same {
    fn fork(&self) -> Box<dyn Integrator<f64>> {
        Box::new(Self(self.0))
    }
    fn reset(&mut self, _: bool) {}
    fn moments(
        &mut self,
        _: &Gap<f64>,
        _: Interval<f64>,
    ) -> Result<Moments<f64>, ContactError<f64>> {
        let Self(value) = *self;
        Ok(Moments {
            m2: None,
            m0: value,
            m1: value,
            l1_norm: value,
            error: value,
            inversion: value,
            derivatives: None,
        })
    }
    fn prepare(&mut self, _: &Gap<f64>, _: Interval<f64>) -> Result<(), ContactError<f64>> {
        Ok(())
    }
    fn estimate(
        &self,
        _: &Gap<f64>,
        _: &LoadCase<f64>,
        _: f64,
        _: &mut Cost,
    ) -> Result<Estimate<f64>, ContactError<f64>> {
        Ok(Estimate { value: self.0, error: self.0 })
    }
    fn cost(&self) -> Cost {
        Cost {
            samples: usize::MAX,
            evaluations: usize::MAX,
            heights: usize::MAX,
            searches: usize::MAX,
            search_values: usize::MAX,
        }
    }
}

#[test]
fn quadratures_that_lie() {
    let mut table = Table::new("Contact::solve by a quadrature that lies");
    let upper = body();
    for value in [NAN, INF, -INF, 0.0, 1.0, -1.0, TINY, f64::MAX] {
        let lie = Same(value);
        let contact = Contact::new(&Flat, &*upper).unwrap().quadrature(&lie);
        let fixed = contact.clone().edges(Edge::Fixed(-0.1), Edge::Fixed(0.2));
        let corner = contact.clone().edges(Edge::FreeUntil(-0.1), Edge::FreeUntil(0.2));
        let by_brent = contact.clone().limit_search(&Brent::DEFAULT);
        for (how, contact) in
            [("free", &contact), ("corners", &corner), ("searched", &by_brent), ("fixed", &fixed)]
        {
            for load in [Control::Load(0.05), Control::HalfWidth(0.3), Control::PeakPressure(0.1)] {
                table.outcome(
                    &format!("{how}, {value:e}, {load:?}"),
                    40_000,
                    || {
                        let solution = contact.solve(load)?;
                        assert!(solution.a() + solution.b() > 0.0);
                        ask_all(&solution);
                        Ok(())
                    },
                    |_| true,
                );
            }
        }
    }
    table.finish();
}
