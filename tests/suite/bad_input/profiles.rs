//! Invalid curves and pieces.

use super::*;

#[test]
fn bodies() {
    let mut table = Table::new("Contact::new and Piece::checked");
    let domains = [
        [NAN, 1.0],
        [-1.0, NAN],
        [-INF, 1.0],
        [-1.0, INF],
        [1.0, -1.0],
        [0.5, 0.5],
        [-1.5e308, 1.5e308],
    ];
    for domain in domains {
        let wanted = move |source: &ProfileError<f64>| {
            matches!(source, ProfileError::Domain { from, to }
                if same(*from, domain[0]) && same(*to, domain[1]))
        };
        let name = format!("domain {domain:?}");
        table.row(
            &name,
            0,
            || Ok(Contact::new(&Flat, &*curve(domain, by_cubic)).map(|_| ())?),
            |wrong| {
                matches!(wrong, Wrong::Input(InputError::Profile { body: Body::Upper, source })
                    if wanted(source))
            },
        );
        let below = |wrong: &Wrong| {
            matches!(wrong, Wrong::Input(InputError::Profile { body: Body::Lower, source })
                if wanted(source))
        };
        let lower = curve(domain, by_cubic);
        table.row(&name, 2, || Ok(Contact::new(&*lower, &*body()).map(|_| ())?), below);
        let checked = |wrong: &Wrong| matches!(wrong, Wrong::Profile(source) if wanted(source));
        table.row(&name, 0, || Ok(Piece::checked(&*curve(domain, by_cubic)).map(|_| ())?), checked);
        table.row(&name, 0, || Ok(Piece::new(&*curve(domain, by_cubic)).map(|_| ())?), checked);
        let joined = |wrong: &Wrong| {
            matches!(wrong, Wrong::Breakpoint(PiecewiseError::InPiece { piece: 2, source })
                if wanted(source))
        };
        let pieces = vec![curve([-2.0, -1.0], by_cubic), curve(domain, by_cubic)];
        table.row(&name, 39, || Ok(Piecewise::new(pieces).map(|_| ())?), joined);
    }
    // A domain between two neighbouring numbers is narrow, but valid.
    let narrow = curve([0.0, TINY], |k| CurvePoint { x: k, y: 0.0, dx: 1.0, dy: 0.0 });
    table.row(
        "a subnormal domain",
        100,
        || solve(&*narrow, Control::Load(1.0)),
        contact_error!(ContactError::Solve(SolveError::NoFirstContact { .. })),
    );
    for value in [NAN, INF, -INF] {
        let end = curve([-1.0, 1.0], move |k| CurvePoint {
            x: if k == 1.0 { value } else { k },
            ..by_cubic(k)
        });
        let wanted = |source: &ProfileError<f64>| {
            matches!(source, ProfileError::NotFinite { quantity: "X", k: 1.0, value: v }
                if same(*v, value))
        };
        let name = format!("X({value}) at the end");
        table.row(&name, 2, || Ok(Contact::new(&Flat, &*end).map(|_| ())?), |wrong| {
            matches!(wrong, Wrong::Input(InputError::Profile { source, .. }) if wanted(source))
        });
        table.row(
            &format!("X({value}) at the end"),
            39,
            || Ok(Piece::checked(&*end).map(|_| ())?),
            |wrong| matches!(wrong, Wrong::Profile(source) if wanted(source)),
        );
    }
    let still = curve([-1.0, 1.0], |k| CurvePoint { x: 0.25, y: k, dx: 0.0, dy: 1.0 });
    table.row(
        "X stands still",
        3,
        || Ok(Contact::new(&Flat, &*still).map(|_| ())?),
        contact_error!(ContactError::Input(InputError::Profile {
            source: ProfileError::TurnsBack { k: 0.0, x: 0.25, .. },
            ..
        })),
    );
    let beside = curve([-3.0, -1.0], |k| CurvePoint { x: k, y: 0.0, dx: 1.0, dy: 0.0 });
    table.row(
        "one end in common",
        4,
        || {
            Ok(Contact::new(&*beside, &*curve([-1.0, 1.0], |k| CurvePoint { x: k, ..by_cubic(k) }))
                .map(|_| ())?)
        },
        contact_error!(ContactError::Input(InputError::NoCommonRange {
            lower: [-3.0, -1.0],
            upper: [-1.0, 1.0]
        })),
    );
    table.finish();
}

/// Compound profile as a user might write it.
struct Compound {
    says: usize,
    has: usize,
    parts: Vec<Profile>,
}

impl ParametricProfile<f64> for Compound {
    fn domain(&self) -> [f64; 2] {
        [-1.0, 1.0]
    }
    fn at(&self, k: f64) -> CurvePoint<f64> {
        self.parts[0].at(k)
    }
    fn pieces(&self) -> usize {
        self.says
    }
    fn piece(&self, index: usize) -> Option<Piece<'_, f64>> {
        self.parts[..self.has].get(index).map(|part| Piece::new(part).expect("a good piece"))
    }
}

#[test]
fn compound_profiles_that_are_none() {
    let mut table = Table::new("a profile of pieces");
    let at = |from: f64, to: f64| {
        curve([from, to], |k| CurvePoint { x: k, y: k * k / 2.0, dx: 1.0, dy: k })
    };
    let parts = || vec![at(-1.0, 0.0), at(0.0, 1.0), at(1.0, 2.0)];
    let bad = [
        ("no pieces but one", 0, 1, parts(), 0),
        ("one more piece than it says", 2, 3, parts(), 2),
        ("pieces of which there is none", 2, 0, parts(), 0),
        ("more pieces than it has", 9, 3, parts(), 8),
        ("the wrong order", 2, 2, vec![at(0.0, 1.0), at(-1.0, 0.0)], 1),
        ("pieces apart", 2, 2, vec![at(-1.0, -0.5), at(0.5, 1.0)], 1),
    ];
    for (name, says, has, parts, fault) in bad {
        let compound = Compound { says, has, parts };
        if name != "pieces apart" && name != "the wrong order" {
            let faults = [
                check_derivatives(&compound).unwrap_err(),
                Placed::new(&compound, Placement::default()).map(|_| ()).unwrap_err(),
            ];
            assert_eq!(faults, [ProfileError::Pieces { count: says, index: fault }; 2], "{name}");
        }
        table.row(name, 100, || solve(&compound, Control::Load(0.02)), |wrong| {
            matches!(wrong, Wrong::Input(InputError::Profile { body: Body::Upper,
                source: ProfileError::Pieces { count, index } }) if (*count, *index) == (says, fault))
        });
    }
    let compound = Compound { says: 3, has: 3, parts: parts() };
    table.outcome("as it should be", 200, || solve(&compound, Control::Load(0.02)), Result::is_ok);
    table.finish();
}

#[test]
fn breakpoints() {
    let mut table = Table::new("Piecewise::new");
    let line = |from: f64, to: f64, up: f64| {
        curve([from, to], move |k| CurvePoint { x: k, y: up, dx: 1.0, dy: 0.0 })
    };
    table.row(
        "no pieces",
        0,
        || Ok(Piecewise::<f64, Profile>::new(vec![]).map(|_| ())?),
        |wrong| matches!(wrong, Wrong::Breakpoint(PiecewiseError::NoPieces)),
    );
    for tolerance in [NAN, INF, -INF, -1.0, -TINY] {
        let pieces = || vec![line(-1.0, 0.0, 0.0), line(0.0, 1.0, 0.0)];
        let joined = || Ok(Piecewise::with_tolerance(pieces(), tolerance).map(|_| ())?);
        table.row(&format!("tolerance {tolerance}"), 0, joined, |wrong| {
            matches!(wrong, Wrong::Breakpoint(PiecewiseError::Tolerance { tolerance: t })
                if same(*t, tolerance))
        });
    }
    let mut pair = |name: &str, right: Profile, expected: fn(&PiecewiseError<f64>) -> bool| {
        let pieces = vec![line(-1.0, 0.0, 0.0), right];
        table.row(
            name,
            78,
            || Ok(Piecewise::new(pieces).map(|_| ())?),
            |wrong| matches!(wrong, Wrong::Breakpoint(error) if expected(error)),
        );
    };
    pair("Y that is NaN", line(0.0, 1.0, NAN), |error| {
        matches!(
            error,
            PiecewiseError::InPiece {
                piece: 2,
                source: ProfileError::NotFinite { quantity: "Y", k: 0.0, .. }
            }
        )
    });
    pair("Y that is infinite", line(0.0, 1.0, INF), |error| {
        matches!(
            error,
            PiecewiseError::InPiece {
                piece: 2,
                source: ProfileError::NotFinite { quantity: "Y", k: 0.0, .. }
            }
        )
    });
    table.finish();
}

#[test]
fn curves() {
    let mut table = Table::new("Contact::solve");
    let at =
        |name: &'static str,
         upper: Profile,
         expected: &dyn Fn(&ProfileError<f64>) -> bool,
         table: &mut Table| {
            for load in [Control::Load(0.05), Control::HalfWidth(0.3), Control::PeakPressure(0.1)] {
                table.row(name, 40_000, || solve(&*upper, load), |wrong| {
                matches!(wrong, Wrong::Input(InputError::Profile { body: Body::Upper, source })
                    if expected(source))
            });
            }
        };
    let inside = |k: f64| (0.11..0.3).contains(&k);
    let hole = |name| {
        move |source: &ProfileError<f64>| {
            matches!(source, ProfileError::NotFinite { quantity, k, value }
                if *quantity == name && inside(*k) && !value.is_finite())
        }
    };
    let slope = "the slope Y'/X'";
    for value in [NAN, INF, -INF] {
        let with = move |k: f64| if inside(k) { value } else { 1.0 };
        at(
            "X is not finite in places",
            curve([-1.0, 1.0], move |k| CurvePoint { x: by_cubic(k).x * with(k), ..by_cubic(k) }),
            &hole("X"),
            &mut table,
        );
        at(
            "Y' is not finite in places",
            curve([-1.0, 1.0], move |k| CurvePoint { dy: by_cubic(k).dy * with(k), ..by_cubic(k) }),
            &hole(slope),
            &mut table,
        );
    }
    let with = move |k: f64| if inside(k) { NAN } else { 1.0 };
    at(
        "X' is NaN in places",
        curve([-1.0, 1.0], move |k| CurvePoint { dx: by_cubic(k).dx * with(k), ..by_cubic(k) }),
        &hole(slope),
        &mut table,
    );
    at(
        "X' is zero in places",
        curve([-1.0, 1.0], move |k| CurvePoint {
            dx: if inside(k) { 0.0 } else { by_cubic(k).dx },
            ..by_cubic(k)
        }),
        &hole(slope),
        &mut table,
    );
    at(
        "all is NaN but the ends",
        curve([-1.0, 1.0], |k| {
            let nan = if k.abs() == 1.0 { 1.0 } else { NAN };
            CurvePoint { x: k * nan, y: nan, dx: nan, dy: k * nan }
        }),
        &|source| matches!(source, ProfileError::NotFinite { k, .. } if k.abs() < 1.0),
        &mut table,
    );
    at(
        "x runs to and fro",
        curve([-1.0, 1.0], |k| {
            let (x, dx) = (k * k * k - k / 4.0, 3.0 * k * k - 0.25);
            CurvePoint { x, y: x * x / 2.0, dx, dy: x * dx }
        }),
        &|source| matches!(source, ProfileError::TurnsBack { k, .. } if k.abs() < 0.9),
        &mut table,
    );
    // tan has a pole at π/2, which is not representable: a huge value, and a change of sign.
    at(
        "a pole inside",
        curve([-0.5, 2.0], |k| {
            let (x, dx) = (k.tan(), 1.0 + k.tan().powi(2));
            CurvePoint { x, y: x * x / 2.0, dx, dy: x * dx }
        }),
        &|_| true,
        &mut table,
    );
    at(
        "a pole at a number",
        curve([-0.5, 2.0], |k| {
            let (x, dx) = ((1.0 - k).recip() - 1.0, (1.0 - k).powi(-2));
            CurvePoint { x, y: x * x / 2.0, dx, dy: x * dx }
        }),
        &|_| true,
        &mut table,
    );
    table.finish();
}

#[test]
fn curves_that_change_between_calls() {
    // The result cannot be right; it must only be returned.
    let mut table = Table::new("Contact::solve on a curve that changes");
    for seed in 0..12u32 {
        for size in [1e-12, 1e-6, 1e-2, 1.0] {
            let changing = curve([-1.0, 1.0], move |k| {
                let mut bits = (EVALUATIONS.get() as u64 + 1)
                    .wrapping_mul(0x9E37_79B9_7F4A_7C15 ^ u64::from(seed));
                let mut noise = || {
                    bits ^= bits >> 29;
                    bits = bits.wrapping_mul(0xBF58_476D_1CE4_E5B9);
                    1.0 + size * ((bits >> 11) as f64 / (1u64 << 53) as f64 - 0.5)
                };
                let CurvePoint { x, y, dx, dy } = by_cubic(k);
                CurvePoint { x: x * noise(), y: y * noise(), dx: dx * noise(), dy: dy * noise() }
            });
            for load in [Control::Load(0.05), Control::HalfWidth(0.3), Control::PeakPressure(0.1)] {
                let name = format!("{load:?} with {size:e}, seed {seed}");
                let mut seen = None;
                table.outcome(
                    &name,
                    400_000,
                    || {
                        let contact = Contact::new(&Flat, &*changing)?;
                        let solution = contact.solve(load)?;
                        seen = Some((solution.hull(), solution.limits_error()));
                        Ok(())
                    },
                    |_| true,
                );
                if let Some((on, error)) = seen {
                    assert!(on.left < on.right && on.right.is_finite(), "{name}: {on:?}");
                    // The estimate covers the effect of the change on the limits.
                    let exact = if matches!(load, Control::Load(_)) { 0.1f64.sqrt() } else { 0.3 };
                    if !matches!(load, Control::PeakPressure(_)) {
                        let off = (on.half_width() / exact - 1.0).abs();
                        assert!(off <= 30.0 * error.unwrap() + 3e-15, "{name}: {off:e}, {error:?}");
                    }
                }
            }
        }
    }
    table.finish();
}
