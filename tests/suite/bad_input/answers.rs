//! Queries of a solution.

use super::*;

/// Makes every query of a solution, at good and bad places.
pub fn ask_all(solution: &Solution<f64>) {
    let Interval { left, right } = solution.hull();
    let places = [
        NAN,
        INF,
        -INF,
        left,
        right,
        left / 2.0 + right / 2.0,
        right.next_down(),
        right.next_up(),
        right + 0.01,
        left - 0.01,
        TINY,
        f64::MAX,
    ];
    let _ = (solution.peak(), solution.moment(), solution.centre_of_pressure(), solution.certify());
    let (pressure, rates, below) =
        (solution.pressure(), solution.load_rates(), solution.subsurface());
    for x in places {
        let _ = (solution.gap_at(x), solution.gap_slope(x), solution.residual(x));
        if let Ok(pressure) = &pressure {
            let mut many = [0.0; 2];
            let _ = (
                pressure.at(x),
                pressure.estimate(x, &mut Cost::default()),
                pressure.at_many(&[x, 0.0], &mut many),
            );
        }
        if let Ok(rates) = &rates {
            let _ = rates.pressure(x);
        }
        if let Ok(below) = &below {
            let _ = (below.at(x, 0.1), below.at(0.1, x));
        }
    }
    if let Ok(below) = below {
        let _ = (below.max_shear(), below.max_von_mises(0.3), below.max_tension());
    }
}

#[test]
fn what_is_asked_of_a_solution() {
    let mut table = Table::new("Solution");
    let upper = body();
    let contact = Contact::new(&Flat, &*upper).unwrap();
    let solution = contact.solve(Control::Load(0.05)).unwrap();
    let on = solution.hull();
    let pressure = solution.pressure().unwrap();
    let below = || solution.subsurface().unwrap();
    let rates = solution.load_rates().unwrap();
    let (middle, beside) = (0.5 * (on.left + on.right), on.right + 0.1);
    for x in [NAN, INF, -INF, 1.3, -1.3, f64::MAX] {
        let outside = |wrong: &Wrong| {
            matches!(wrong, Wrong::Solve(SolveError::OutsideBodies { x: at, range: [-1.2, 1.2] })
                if same(*at, x))
        };
        let misplaced = |wrong: &Wrong| {
            matches!(wrong, Wrong::Evaluation(EvaluationError::InvalidPosition { x: at, inside: true, interval })
                if same(*at, x) && *interval == on)
        };
        let above = |wrong: &Wrong| {
            matches!(wrong, Wrong::Evaluation(EvaluationError::AboveSurface { x: at, depth: 0.1 })
                if same(*at, x))
        };
        table.row(&format!("pressure at {x}"), 0, || Ok(pressure.at(x)?), outside);
        table.row(
            &format!("estimate at {x}"),
            0,
            || Ok(pressure.estimate(x, &mut Cost::default())?),
            outside,
        );
        table.row(
            &format!("pressures at {x}"),
            0,
            || Ok(pressure.at_many(&[middle, x], &mut [0.0; 2])?),
            outside,
        );
        table.row(&format!("gap at {x}"), 0, || Ok(solution.gap_at(x)?), outside);
        table.row(&format!("slope of the gap at {x}"), 0, || Ok(solution.gap_slope(x)?), outside);
        table.row(&format!("residual at {x}"), 0, || Ok(solution.residual(x)?), misplaced);
        if x.is_nan() {
            table.row("rate at NaN", 0, || Ok(rates.pressure(x)?), misplaced);
        }
        if !x.is_finite() {
            table.row(&format!("stress at {x}"), 0, || Ok(below().at(x, 0.1)?), above);
            table.row(&format!("friction {x}"), 0, || Ok(below().friction(x).map(|_| ())?), |wrong| {
                matches!(wrong, Wrong::Input(InputError::InvalidFriction { coefficient }) if same(*coefficient, x))
            });
        }
    }
    for x in [on.left, on.right] {
        table.row(
            "rate at an edge",
            0,
            || Ok(rates.pressure(x)?),
            |wrong| matches!(wrong, Wrong::Evaluation(EvaluationError::Singular { x: at }) if *at == x),
        );
        table.row("residual at an edge", 0, || Ok(solution.residual(x)?), |wrong| {
            matches!(wrong, Wrong::Evaluation(EvaluationError::InvalidPosition { x: at, inside: true, .. }) if *at == x)
        });
    }
    for x in [middle, on.right.next_down(), on.left.next_up()] {
        for asked in [solution.gap_at(x), solution.gap_slope(x)] {
            table.row("gap inside", 0, || Ok(asked?), |wrong| {
                matches!(wrong, Wrong::Evaluation(EvaluationError::InvalidPosition { x: at, inside: false, .. })
                    if *at == x)
            });
        }
    }
    for depth in [NAN, INF, -INF, -1.0, -TINY] {
        table.row(
            &format!("depth {depth}"),
            0,
            || Ok(below().at(middle, depth)?),
            |wrong| {
                matches!(wrong, Wrong::Evaluation(EvaluationError::AboveSurface { x, depth: d })
                    if *x == middle && same(*d, depth))
            },
        );
    }
    for (x, depth) in [
        (middle, TINY),
        (middle, f64::MAX),
        (f64::MAX, f64::MAX),
        (f64::MAX, TINY),
        (on.right, TINY),
        (beside, 1e-300),
    ] {
        table.outcome(
            &format!("stress at {x:e}, {depth:e}"),
            0,
            || {
                let stress = below().at(x, depth)?;
                assert!(
                    (stress.sigma_x + stress.sigma_y + stress.tau_xy).is_finite(),
                    "{x:e} {depth:e} {stress:?}"
                );
                Ok(())
            },
            |outcome| {
                matches!(outcome, Ok(_) | Err(Wrong::Evaluation(EvaluationError::Integral { .. })))
            },
        );
    }
    let stress = Stress { sigma_x: -1.0, sigma_y: -2.0, tau_xy: 0.5 };
    for poisson in [NAN, INF, -INF, -TINY, -0.1, 0.5f64.next_up(), 1.0] {
        let is_it = |wrong: &Wrong| {
            matches!(wrong, Wrong::Input(InputError::InvalidPoissonRatio { body: None, ratio })
                if same(*ratio, poisson))
        };
        table.row(&format!("σ_z with ν = {poisson}"), 0, || Ok(stress.sigma_z(poisson)?), is_it);
        table.row(
            &format!("von Mises with ν = {poisson}"),
            0,
            || Ok(stress.von_mises(poisson)?),
            is_it,
        );
        table.row(
            &format!("largest with ν = {poisson}"),
            0,
            || Ok(below().max_von_mises(poisson)?),
            is_it,
        );
    }
    for (x, places) in [(vec![], 1), (vec![middle], 0), (vec![middle; 3], 2), (vec![NAN; 40], 41)] {
        let (given, mut out) = (x.len(), vec![0.0; places]);
        table.row(
            &format!("{given} x, {places} places"),
            0,
            || Ok(pressure.at_many(&x, &mut out)?),
            |wrong| {
                matches!(wrong, Wrong::Evaluation(EvaluationError::LengthMismatch { x, pressures })
                    if (*x, *pressures) == (given, places))
            },
        );
    }
    // At an infinite pressure, or with zero load.
    let punch = contact.clone().edges(Edge::Fixed(-0.2), Edge::Fixed(0.3));
    let punch = punch.solve(Control::Load(0.5)).unwrap();
    let pressure = punch.pressure().unwrap();
    for x in [-0.2, 0.3] {
        for asked in [pressure.at(x), punch.gap_slope(x)] {
            table.row(&format!("infinite at {x}"), 0, || Ok(asked?), |wrong| {
                matches!(wrong, Wrong::Evaluation(EvaluationError::Singular { x: at }) if *at == x)
            });
        }
    }
    let below = punch.subsurface().unwrap();
    let singular = |wrong: &Wrong| {
        matches!(wrong, Wrong::Evaluation(EvaluationError::Singular { x })
            if [-0.2, 0.3].contains(x))
    };
    table.row("largest shear at a corner", 0, || Ok(below.max_shear()?), singular);
    table.row("largest von Mises at a corner", 0, || Ok(below.max_von_mises(0.3)?), singular);
    let idle = contact.clone().edges(Edge::Fixed(-0.2), Edge::Fixed(0.3));
    let idle = idle.single_interval(true).solve(Control::Load(0.0)).unwrap();
    table.row(
        "centre of no load",
        0,
        || Ok(idle.centre_of_pressure()?),
        contact_error!(ContactError::Input(InputError::InvalidLoad {
            quantity: "load",
            value: 0.0,
            must: "not zero"
        })),
    );
    let sticky = contact.clone().edges(Edge::Adhesive(1e-3), Edge::Free);
    let sticky = sticky.solve(Control::Load(0.05)).unwrap();
    table.row(
        "rates with adhesion",
        0,
        || Ok(sticky.load_rates()?),
        contact_error!(ContactError::Evaluation(EvaluationError::NoLoadDerivative { .. })),
    );
    let holey = curve([-1.0, 1.0], |k| CurvePoint {
        y: if k > 0.5 { NAN } else { by_cubic(k).y },
        ..by_cubic(k)
    });
    let on_holey = Contact::new(&Flat, &*holey).unwrap().single_interval(true);
    let on_holey = on_holey.solve(Control::Load(0.05)).unwrap();
    table.row(
        "gap where Y is NaN",
        20,
        || Ok(on_holey.gap_at(0.8)?),
        contact_error!(ContactError::Input(InputError::Profile {
            body: Body::Upper,
            source: ProfileError::NotFinite { quantity: "Y", .. }
        })),
    );
    // All other queries answer, or return an error with its reason.
    for solution in [&solution, &punch, &idle, &sticky] {
        let ask = || {
            ask_all(solution);
            Ok(())
        };
        table.outcome("everything", 400_000, ask, Result::is_ok);
    }
    table.finish();
}
