//! Invalid brackets and functions.

use super::*;

#[test]
fn searches() {
    let mut table = Table::new("LimitSearch::find");
    let nan_free = |root: &Root<f64>| root.x.is_finite() && root.residual.is_finite();
    for (i, search) in strategies(StoppingCriteria::FULL) {
        let calls = Cell::new(0);
        let mut run =
            |name: &str,
             bracket: Bracket<f64>,
             f: &dyn Fn(f64) -> f64,
             expected: &dyn Fn(&Result<Root<f64>, SearchError<f64>>) -> bool| {
                calls.set(0);
                let mut found = None;
                table.outcome(
                    &format!("{i}: {name}"),
                    0,
                    || {
                        let mut counted = |x: f64| {
                            calls.set(calls.get() + 1);
                            f(x)
                        };
                        let root = search.find(&mut counted, &bracket);
                        found = Some(root);
                        Ok(root?)
                    },
                    |_| true,
                );
                let found = found.expect("no panic");
                assert!(expected(&found), "{i}: {name}: {found:?}");
                assert!(calls.get() <= 2202, "{i}: {name}: {} calls", calls.get());
            };
        let good = Bracket::new(-1.0, 2.0);
        for (lo, hi) in [(NAN, 1.0), (0.0, NAN), (-INF, 1.0), (0.0, INF), (1.0, 0.0)] {
            run(
                "a bracket that is none",
                Bracket::new(lo, hi),
                &|x| x - 0.3,
                &|found| matches!(found, Err(SearchError::Bracket { lo: l, hi: h }) if same(*l, lo) && same(*h, hi)),
            );
        }
        run("no sign change", good, &|_| 1.0, &|found| {
            *found == Err(SearchError::NoSignChange { lo: -1.0, hi: 2.0, f_lo: 1.0, f_hi: 1.0 })
        });
        for [at_lo, at_hi] in [[NAN, 1.0], [-1.0, INF], [-INF, 1.0], [-1.0, NAN]] {
            run("values that are none", good.values(at_lo, at_hi), &|x| x - 0.3, &|found| {
                matches!(found, Err(SearchError::NotFinite { x, value })
                    if (same(*value, at_lo) && *x == -1.0) || (same(*value, at_hi) && *x == 2.0))
            });
        }
        for value in [NAN, INF, -INF] {
            run(
                "values not finite inside",
                good,
                &|x| if x.abs() < 0.9 { value } else { x },
                &|found| {
                    matches!(found, Err(SearchError::NotFinite { x, value: v })
                        if x.abs() < 0.9 && same(*v, value))
                },
            );
        }
        for guess in [NAN, INF, -INF, 9.0, -1.0, 2.0] {
            run("a guess that is none", good.guess(guess), &|x| x - 0.3, &|found| {
                found.is_ok_and(|root| (root.x - 0.3).abs() < 1e-15)
            });
        }
        // The values at the ends are trusted, even if they are wrong.
        run("values that lie", good.values(-5.0, 5.0), &|x| x + 7.0, &|found| {
            found.map_or(true, |root| nan_free(&root) && root.x >= -1.0 && root.x <= 2.0)
        });
        run("a jump", good, &|x| if x > 0.4 { 1.0 } else { -1.0 }, &|found| {
            found.is_ok_and(|root| (root.x - 0.4).abs() < 1e-14)
        });
        run("a pole", good, &|x| (x - 0.4).recip(), &|found| match found {
            Ok(root) => (root.x - 0.4).abs() < 1e-14,
            Err(SearchError::NotFinite { x, .. }) => (x - 0.4).abs() < 1e-14,
            Err(_) => false,
        });
        let (count, last) = (Cell::new(0u32), Cell::new(0.0));
        run(
            "another sign at each call",
            good,
            &|_| {
                count.set(count.get() + 1);
                last.set(if count.get().is_multiple_of(2) { 1.0 } else { -1.0 });
                last.get()
            },
            &|found| found.map_or(true, |root| nan_free(&root)),
        );
        run("the smallest numbers", Bracket::new(-TINY, TINY), &|x| x, &|found| {
            found.is_ok_and(|root| root.x.abs() <= TINY)
        });
        run("values that overflow a product", good, &|x| 1e300 * (x - 0.3), &|found| {
            found.is_ok_and(|root| (root.x - 0.3).abs() < 1e-15)
        });
        run("values that underflow a product", good, &|x| 1e-300 * (x - 0.3), &|found| {
            found.is_ok_and(|root| (root.x - 0.3).abs() < 1e-7)
        });
        for slope in [NAN, INF, 0.0, -1.0, 1e-300] {
            calls.set(0);
            let root = search.find_with_slope(
                &mut |x| {
                    calls.set(calls.get() + 1);
                    (x.powi(3) - 0.3, slope)
                },
                &good,
            );
            assert!(
                root.is_ok_and(|root| (root.x - 0.3f64.cbrt()).abs() < 1e-14),
                "{i}, slope {slope}: {root:?}"
            );
            assert!(calls.get() < 300, "{i}, slope {slope}: {} calls", calls.get());
        }
    }
    table.finish();
}
