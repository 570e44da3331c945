//! Settings of a scene.

use super::*;
use linecontact::Solver;

#[test]
fn loads_scales_and_edges() {
    let mut table = Table::new("Contact::solve");
    let (upper, good) = (body(), Control::Load(0.05));
    let contact = Contact::new(&Flat, &*upper).unwrap();
    let ways: [(&str, &str, fn(f64) -> Control<f64>); 3] = [
        ("Load", "load", Control::Load),
        ("HalfWidth", "half-width", Control::HalfWidth),
        ("PeakPressure", "peak pressure", Control::PeakPressure),
    ];
    for value in [NAN, INF, -INF, 0.0, -0.0, -1.0, -TINY] {
        for (name, says, way) in ways {
            // Without load the bodies are apart, and that is no fault.
            if value == 0.0 && name == "Load" {
                continue;
            }
            table.solve(&format!("{name}({value:e})"), 0, &contact, way(value), |wrong| {
                matches!(wrong, Wrong::Input(InputError::InvalidLoad { quantity, value: v, .. })
                    if *quantity == says && same(*v, value))
            });
        }
        table.solve(&format!("κ = {value:e}"), 0, &contact.clone().kappa(value), good, |wrong| {
            matches!(wrong, Wrong::Input(InputError::InvalidKappa { kappa }) if same(*kappa, value))
        });
        table.solve(&format!("E* = {value:e}"), 0, &contact.clone().contact_modulus(value), good, |wrong| {
            matches!(wrong, Wrong::Input(InputError::InvalidModulus { modulus }) if same(*modulus, value))
        });
        if value != 0.0 {
            let adhesive = contact.clone().edges(Edge::Free, Edge::Adhesive(value));
            table.solve(&format!("w = {value:e}"), 0, &adhesive, good, |wrong| {
                matches!(wrong, Wrong::Input(InputError::InvalidAdhesion { work }) if same(*work, value))
            });
        }
    }
    // Any finite load, however small or large, gives a contact or a reason, and no NaN.
    for value in [TINY, 1e-310, f64::MIN_POSITIVE, 1e-200, 1e200, f64::MAX] {
        for (name, _, way) in ways {
            for kappa in [1.0, TINY, f64::MAX] {
                let mut found = None;
                table.outcome(
                    &format!("{name}({value:e}), κ = {kappa:e}"),
                    40_000,
                    || {
                        let contact = contact.clone().kappa(kappa);
                        let solution = contact.solve(way(value))?;
                        found = Some((solution.hull(), solution.load()));
                        Ok(())
                    },
                    |outcome| match outcome {
                        Ok(_) => true,
                        Err(Wrong::Solve(
                            SolveError::DomainTooShort { .. }
                            | SolveError::HalfWidthTooLarge { .. }
                            | SolveError::Overflow { .. }
                            | SolveError::NoPeak { .. }
                            | SolveError::PeakTooHigh { .. }
                            | SolveError::NoEquilibrium { .. }
                            | SolveError::OutsideBodies { .. },
                        )) => true,
                        Err(Wrong::Input(InputError::InvalidLoad { .. })) => {
                            value < f64::MIN_POSITIVE
                        }
                        Err(_) => false,
                    },
                );
                if let Some((on, load)) = found {
                    let sound =
                        on.left < on.right && on.half_width().is_finite() && load.is_finite();
                    assert!(sound, "{name}({value:e}), κ = {kappa:e}: {on:?} {load:e}");
                }
            }
        }
    }
    for x in [NAN, INF, -INF] {
        for edges in [
            [Edge::Fixed(x), Edge::Free],
            [Edge::Free, Edge::FreeUntil(x)],
            [Edge::FreeUntil(x), Edge::Fixed(0.1)],
        ] {
            let [left, right] = edges;
            let contact = contact.clone().edges(left, right);
            for load in [good, Control::HalfWidth(0.1), Control::PeakPressure(0.1)] {
                table.solve(&format!("{edges:?}, {load:?}"), 0, &contact, load, |wrong| {
                    matches!(wrong, Wrong::Input(InputError::InvalidLimits { interval })
                        if same(interval.left, x) || same(interval.right, x))
                });
            }
        }
    }
    for (left, right) in [(0.2, -0.2), (0.1, 0.1), (NAN, 0.1), (0.0, INF), (-INF, INF)] {
        let is_it = |wrong: &Wrong| {
            matches!(wrong, Wrong::Input(InputError::InvalidLimits { interval })
                if same(interval.left, left) && same(interval.right, right))
        };
        for load in [good, Control::HalfWidth(0.1), Control::PeakPressure(0.1)] {
            let contact = contact.clone().start(Interval { left, right });
            table.solve(&format!("start {left} to {right}"), 0, &contact, load, is_it);
        }
        if left.is_finite() && right.is_finite() {
            let contact = contact.clone().edges(Edge::Fixed(left), Edge::Fixed(right));
            table.solve(&format!("fixed at {left} and {right}"), 0, &contact, good, is_it);
        }
    }
    for (left, right, beyond) in [(-1.5, 0.1, -1.5), (-0.1, 2.0, 2.0)] {
        let fixed = contact.clone().edges(Edge::Fixed(left), Edge::Fixed(right));
        table.solve("fixed beyond the bodies", 0, &fixed, good, |wrong| {
            matches!(wrong, Wrong::Solve(SolveError::OutsideBodies { x, range: [-1.2, 1.2] }) if *x == beyond)
        });
    }
    let both = contact.clone().edges(Edge::Fixed(-0.1), Edge::Fixed(0.1));
    for load in [Control::HalfWidth(0.1), Control::PeakPressure(0.1)] {
        table.solve(&format!("both limits and {load:?}"), 0, &both, load, |wrong| {
            matches!(
                wrong,
                Wrong::Input(InputError::BothLimitsGiven {
                    interval: Interval { left: -0.1, right: 0.1 }
                })
            )
        });
        let by_pressure = contact.clone().edge_pressure(EdgePressure::zero(1e-3, 1e-6));
        table.solve(
            &format!("Eq. (6) and {load:?}"),
            0,
            &by_pressure,
            load,
            contact_error!(ContactError::Input(InputError::EdgePressureLoad)),
        );
    }
    table.finish();
}

#[test]
fn edge_pressures_rules_and_tolerances() {
    let mut table = Table::new("Contact::solve");
    let (upper, load) = (body(), Control::Load(0.05));
    let contact = Contact::new(&Flat, &*upper).unwrap();
    let good = EdgePressure::zero(1e-3, 1e-6);
    for value in [NAN, INF, -INF, 0.0, -1.0] {
        let all = [
            ("A", EdgePressure { at_a: value, ..good }),
            ("B", EdgePressure { at_b: value, ..good }),
            ("ε_a", EdgePressure { distance_a: value, ..good }),
            ("ε_b", EdgePressure { distance_b: value, ..good }),
            ("ε₁", EdgePressure { tolerance_a: value, ..good }),
            ("ε₂", EdgePressure { tolerance_b: value, ..good }),
        ];
        for (wrong_one, edges) in all {
            if value.is_finite() && ["A", "B"].contains(&wrong_one) {
                continue;
            }
            let contact = contact.clone().edge_pressure(edges);
            table.solve(&format!("{wrong_one} = {value}"), 0, &contact, load, |wrong| {
                matches!(wrong, Wrong::Input(InputError::InvalidEdgePressure { name, value: v })
                    if *name == wrong_one && same(*v, value))
            });
        }
        let by_pressure = contact.clone().edge_pressure(good);
        table.solve(&format!("Eq. (6) under {value}"), 0, &by_pressure, Control::Load(value), |wrong| {
            matches!(wrong, Wrong::Input(InputError::InvalidLoad { quantity: "load", value: v, .. }) if same(*v, value))
        });
    }
    let far = contact.clone().edge_pressure(EdgePressure::zero(2.4, 1e-6));
    table.solve("ε_a as long as the bodies", 100, &far, load, |wrong| {
        matches!(wrong, Wrong::Input(InputError::InvalidEdgePressure { name: "ε_a", value: 2.4 }))
    });
    for (segments, extrapolations) in [
        (0, 0),
        (0, 2),
        (usize::MAX, 0),
        (usize::MAX, 1),
        (1 << 20, 20),
        (1 << 24, 0),
        (9, 40),
        (9, u32::MAX),
        (usize::MAX, u32::MAX),
    ] {
        let rule = Midpoint { segments, extrapolations, exponents: Exponents::Even };
        let contact = contact.clone().quadrature(&rule);
        let is_it = |wrong: &Wrong| {
            matches!(wrong, Wrong::Input(InputError::InvalidSegments { segments: s, extrapolations: e })
                if (*s, *e) == (segments, extrapolations))
        };
        table.solve(&format!("{rule:?}"), 0, &contact, load, is_it);
        let of_solver = || Ok(Solver::new().solve(&contact, load).map(|_| ())?);
        table.row(&format!("solver of {rule:?}"), 0, of_solver, is_it);
    }
    for tolerance in [NAN, INF, -INF, -1.0, -TINY, 1.0, 7.0] {
        let panels = Panels { tolerance };
        let contact_by = contact.clone().quadrature(&panels);
        let is_it = |wrong: &Wrong| {
            matches!(wrong, Wrong::Input(InputError::InvalidTolerance { tolerance: t })
                if same(*t, tolerance))
        };
        table.solve(&format!("{panels:?}"), 0, &contact_by, load, is_it);
        let of_solver = || Ok(Solver::new().solve(&contact_by, load).map(|_| ())?);
        table.row(&format!("solver of {panels:?}"), 0, of_solver, is_it);
        // Both kinds of search, if in use.
        if tolerance >= 0.0 && tolerance.is_finite() {
            continue;
        }
        let rule = Midpoint::default();
        for tolerance in [
            StoppingCriteria { absolute: tolerance, ..StoppingCriteria::FULL },
            StoppingCriteria { relative: tolerance, ..StoppingCriteria::FULL },
            StoppingCriteria { residual: tolerance, ..StoppingCriteria::FULL },
        ] {
            let given = [tolerance.absolute, tolerance.relative, tolerance.residual];
            let bad = given.into_iter().find(|&v| v != 0.0).unwrap();
            for (name, strategy) in strategies(tolerance) {
                let inverting = contact.clone().inversion(&*strategy).quadrature(&rule);
                table.solve(
                    &format!("inversion by {name}, {tolerance:?}"),
                    200,
                    &inverting,
                    load,
                    |wrong| {
                        matches!(wrong, Wrong::Solve(SolveError::Inversion {
                            source: SearchError::Tolerance { value }, ..
                        }) if same(*value, bad))
                    },
                );
                let searching = contact.clone().limit_search(&*strategy);
                let name = format!("search by {name}, {tolerance:?}");
                table.solve(&name, 200, &searching, load, |wrong| {
                    matches!(wrong, Wrong::Solve(SolveError::LimitSearch {
                        best, source: SearchError::Tolerance { value },
                    }) if same(*value, bad) && best.left < best.right)
                });
            }
        }
    }
    table.finish();
}
