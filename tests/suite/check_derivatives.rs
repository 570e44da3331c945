//! `check_derivatives` finds every fault, and none in correct curves.

use crate::common;

use common::{Profile, paper, pieces};
use linecontact::profile::Piece;
use linecontact::{
    Body, Contact, ContactError, Control, Curve, CurvePoint, Flat, InputError, ParametricProfile,
    Piecewise, ProfileError, check_derivatives,
};

/// Profile with changed derivatives.
struct Changed<P, C> {
    of: P,
    change: C,
}

impl<P, C> ParametricProfile<f64> for Changed<P, C>
where
    P: ParametricProfile<f64>,
    C: Fn(f64, CurvePoint<f64>) -> CurvePoint<f64> + Send + Sync,
{
    fn domain(&self) -> [f64; 2] {
        self.of.domain()
    }
    fn at(&self, k: f64) -> CurvePoint<f64> {
        (self.change)(k, self.of.at(k))
    }
}

/// Returns correct curves: those of the paper, and some that are hard to differentiate.
fn right() -> Vec<(String, Profile)> {
    let mut all: Vec<(String, Profile)> = Vec::new();
    for (i, example) in [paper::one(), paper::two(), paper::three(), paper::four(), paper::five()]
        .into_iter()
        .enumerate()
    {
        all.push((format!("example {} lower", i + 1), example.lower));
        all.push((format!("example {} upper", i + 1), example.upper));
    }
    let mut graph = |name: &str, from: f64, to: f64, y: fn(f64) -> [f64; 2]| {
        let curve = Curve::new([from, to], move |k| {
            let [y, dy] = y(k);
            CurvePoint { x: k, y, dx: 1.0, dy }
        });
        all.push((name.into(), Box::new(curve)));
    };
    graph("|x|^1.5", -1.0, 1.0, |x| [x.abs().powf(1.5), 1.5 * x.abs().sqrt() * x.signum()]);
    graph("|x|^20", -1.0, 1.0, |x| [x.powi(20), 20.0 * x.powi(19)]);
    graph("kink", -1.0, 1.1, |x| [x.abs(), if x < 0.0 { -1.0 } else { 1.0 }]);
    graph("kink off the grid", -1.0, 1.0, |x| {
        [(x - 0.3123).abs() * 1e3, if x < 0.3123 { -1e3 } else { 1e3 }]
    });
    graph("a step of tanh", -1.0, 1.0, |x| {
        let t = (1e5 * (x - 0.1234)).tanh();
        [t, 1e5 * (1.0 - t * t)]
    });
    graph("waves", -1.0, 1.0, |x| {
        [x * x + 1e-5 * (1e3 * x).cos(), 2.0 * x - 1e-2 * (1e3 * x).sin()]
    });
    graph("fine waves", -1.0, 1.0, |x| {
        [x * x + 1e-8 * (1e5 * x).cos(), 2.0 * x - 1e-3 * (1e5 * x).sin()]
    });
    graph("noise of 1e-8", -1.0, 1.0, |x| [(x * x + 1e8) - 1e8, 2.0 * x]);
    graph("far off", 1e6, 1e6 + 1.0, |x| {
        let x = x - 1e6;
        [x * x / 2.0, x]
    });
    graph("logarithm", 0.0, 1.0, |x| [if x > 0.0 { x * x.ln() - x } else { 0.0 }, x.ln()]);
    graph("cube root", -1.0, 1.0, |x| [x.cbrt(), x.cbrt().powi(-2) / 3.0]);
    graph("tiny", -1.0, 1.0, |x| [1e-200 * x * x, 2e-200 * x]);
    graph("flat", -1.0, 1.0, |_| [5.0, 0.0]);
    all.push((
        "circle to its very ends".into(),
        Box::new(Curve::new([-1.0, 1.0], |k: f64| {
            let root = (1.0 - k * k).sqrt();
            CurvePoint { x: 2.0 * k, y: -root, dx: 2.0, dy: k / root }
        })),
    ));
    all
}

#[test]
fn no_alarm_where_the_derivatives_are_right() {
    for (name, profile) in right() {
        check_derivatives(&*profile).unwrap_or_else(|error| panic!("{name}: {error}"));
    }
}

#[test]
fn no_alarm_in_single_precision() {
    let arc = Curve::new([-1.5, 1.5], |k: f32| {
        let (sin, cos) = k.sin_cos();
        CurvePoint { x: 10.0 * sin, y: 10.0 * (1.0 - cos), dx: 10.0 * cos, dy: 10.0 * sin }
    });
    check_derivatives(&arc).unwrap();
    let wrong = Curve::new([-1.5, 1.5], |k: f32| {
        let (sin, cos) = k.sin_cos();
        CurvePoint { x: 10.0 * sin, y: 10.0 * (1.0 - cos), dx: 10.0 * cos, dy: 10.02 * sin }
    });
    assert!(matches!(
        check_derivatives(&wrong),
        Err(ProfileError::Derivative { quantity: "Y'", .. })
    ));
}

/// Returns the fault found: quantity, k, and the derivative as a share of its correct value.
fn fault(profile: &dyn ParametricProfile<f64>) -> Option<(&'static str, f64, f64)> {
    match check_derivatives(profile) {
        Ok(()) => None,
        Err(ProfileError::Derivative { quantity, k, given, difference }) => {
            Some((quantity, k, given / difference))
        }
        Err(other) => panic!("{other}"),
    }
}

/// Wrong sign and wrong factors, in either derivative of every curve of the paper, except where
/// noise or a height of zero hides them.
#[test]
fn factors_and_signs_are_found_in_every_curve_of_the_paper() {
    for example in [paper::one(), paper::two(), paper::three(), paper::four(), paper::five()] {
        for profile in [&*example.lower, &*example.upper] {
            for Piece { curve, .. } in pieces(profile) {
                for factor in [-1.0, 1.001, 0.9999, 1.0 + 1e-6, 0.0] {
                    for (name, [fx, fy]) in [("X'", [factor, 1.0]), ("Y'", [1.0, factor])] {
                        let change = |_, p: CurvePoint<f64>| CurvePoint {
                            dx: fx * p.dx,
                            dy: fy * p.dy,
                            ..p
                        };
                        let (quantity, _, seen) =
                            fault(&Changed { of: curve, change }).expect(name);
                        assert_eq!(quantity, name);
                        let off = (seen - factor).abs();
                        assert!(off < 1e-2 * (1.0 - factor).abs(), "{seen} for {factor}");
                    }
                }
            }
        }
    }
}

/// A fault in a small range of k only is found, and placed there.
#[test]
fn a_fault_in_a_small_range_is_found_where_it_is() {
    for width in [0.3, 0.03, 0.006] {
        for from in [-0.99, -0.3, 0.05123, 0.777] {
            for factor in [-1.0, 1.01] {
                let curve = Curve::new([-1.0, 1.0], move |k: f64| {
                    let wrong = k > from && k < from + width;
                    let dy = if wrong { factor * k.sinh() } else { k.sinh() };
                    CurvePoint { x: 3.0 * k, y: k.cosh(), dx: 3.0, dy }
                });
                let (quantity, k, seen) = fault(&curve).expect("a fault");
                assert_eq!(quantity, "Y'");
                assert!(k > from && k < from + width, "{k} in {from} + {width}");
                assert!((seen - factor).abs() < 0.01 * (1.0 - factor).abs(), "{seen} for {factor}");
            }
        }
    }
}

/// An additive fault, where the correct derivative vanishes.
#[test]
fn a_term_too_much_is_found() {
    let curve =
        Curve::new([-1.0, 1.0], |k: f64| CurvePoint { x: k, y: 0.0, dx: 1.0, dy: 1e-9 * k * k });
    assert!(matches!(fault(&curve), Some(("Y'", _, seen)) if seen.abs() > 1e3));
}

#[test]
fn compound_profiles_are_looked_at_piece_by_piece() {
    let piece = |from: f64, to: f64, factor: f64| {
        Curve::new([from, to], move |k: f64| CurvePoint {
            x: k,
            y: k * k,
            dx: 1.0,
            dy: 2.0 * factor * k,
        })
    };
    let right = Piecewise::new(vec![piece(-1.0, 0.0, 1.0), piece(0.0, 1.0, 1.0)]).unwrap();
    assert_eq!(check_derivatives(&right), Ok(()));
    let wrong = Piecewise::new(vec![piece(-1.0, 0.0, 1.0), piece(0.0, 1.0, 1.002)]).unwrap();
    let (_, k, seen) = fault(&wrong).unwrap();
    assert!(k > 0.0 && (seen - 1.002).abs() < 1e-5);
}

#[test]
fn what_is_not_finite_is_reported() {
    let pole = Curve::new([-1.0, 1.0], |k: f64| CurvePoint {
        x: k,
        y: 1.0 / k,
        dx: 1.0,
        dy: -1.0 / (k * k),
    });
    assert!(matches!(check_derivatives(&pole), Err(ProfileError::NotFinite { quantity: "Y", .. })));
    let empty = Curve::new([1.0, 1.0], |k: f64| CurvePoint { x: k, y: k, dx: 1.0, dy: 1.0 });
    assert!(matches!(check_derivatives(&empty), Err(ProfileError::Domain { .. })));
}

#[test]
fn a_slope_by_x_that_is_another() {
    /// Parabola with a factor in its slope by x.
    struct Given(f64);
    impl ParametricProfile<f64> for Given {
        fn domain(&self) -> [f64; 2] {
            [-1.0, 1.0]
        }
        fn at(&self, k: f64) -> CurvePoint<f64> {
            let x = k + 0.1 * k * k * k;
            let dx = 1.0 + 0.3 * k * k;
            CurvePoint { x, y: x * x / 2.0, dx, dy: x * dx }
        }
        fn slope_at(&self, x: f64) -> Option<f64> {
            Some(self.0 * x)
        }
    }
    assert_eq!(check_derivatives(&Given(1.0)), Ok(()));
    for factor in [2.0, -1.0, 1.0 + 1e-6] {
        let error = check_derivatives(&Given(factor)).unwrap_err();
        let ProfileError::Derivative { quantity, k, given, difference } = error else { panic!() };
        assert_eq!(quantity, "slope_at(x)");
        let x = k + 0.1 * k * k * k;
        assert!((difference / x - 1.0).abs() < 1e-14 && (given / x - factor).abs() < 1e-14);
    }
}

#[test]
fn derivatives_that_are_wrong() {
    let with = |fx: f64, fy: f64| {
        Curve::new([-1.0, 1.0], move |k: f64| {
            let (x, dx) = (k + 0.2 * k * k * k, 1.0 + 0.6 * k * k);
            CurvePoint { x, y: x * x / 2.0, dx: fx * dx, dy: fy * x * dx }
        })
    };
    let solve = |body: &dyn ParametricProfile<f64>| {
        Contact::new(&Flat, body).and_then(|contact| contact.solve(Control::Load(0.02)).map(|_| ()))
    };
    assert!(Piece::checked(&with(1.0, 1.0)).is_ok());
    let twice = Piece::checked(&with(1.0, 2.0)).map(|_| ());
    assert!(matches!(twice, Err(ProfileError::Derivative { quantity: "Y'", .. })), "{twice:?}");
    assert_eq!(solve(&with(1.0, 1.0)), Ok(()));
    for (fx, fy, name) in [(2.0, 1.0, "X'"), (0.5, 1.0, "X'"), (10.0, 1.0, "X'"), (1.0, -1.0, "Y'")]
    {
        let body = with(fx, fy);
        let error = Piece::checked(&body).map(|_| ()).unwrap_err();
        let ProfileError::Derivative { quantity, .. } = error else { panic!("{error}") };
        assert_eq!(quantity, name);
        // Without that check the survey finds it after many series, or the solver finds that slopes
        // and heights disagree.
        let error = solve(&body).unwrap_err();
        let ContactError::Input(InputError::Profile {
            source: ProfileError::Derivative { quantity, .. },
            ..
        }) = error
        else {
            panic!("{error}")
        };
        assert!(quantity == name || quantity == "the slope Y'/X'", "{quantity}");
    }
}

#[test]
fn slopes_that_are_a_third_off() {
    // The slope of a parabola is x, whatever its parameter; heights may have a large offset.
    let with = |factor: f64, sign: f64, falls: f64, height: f64| {
        Curve::new([-1.0, 1.0], move |k: f64| {
            let (x, dx) = (falls * (k + 0.2 * k * k * k), falls * (1.0 + 0.6 * k * k));
            let y = height + sign * x * x / 2.0;
            CurvePoint { x, y, dx, dy: factor * sign * x * dx }
        })
    };
    for (falls, height) in [(1.0, 0.0), (-1.0, 0.0), (1.0, 1e3)] {
        for (factor, seen) in [(0.6, false), (1.8, false), (0.45, true), (2.1, true), (9.0, true)] {
            let bodies = [with(factor, -1.0, falls, height), with(factor, 1.0, falls, height)];
            let (left, right) = (Contact::new(&bodies[0], &Flat), Contact::new(&Flat, &bodies[1]));
            for (body, contact) in [(Body::Lower, left), (Body::Upper, right)] {
                let error = contact.unwrap().solve(Control::Load(0.02)).map(|_| ()).unwrap_err();
                // Smaller faults show in the rise over a whole panel.
                let by_rise =
                    matches!(error, ContactError::Input(InputError::InconsistentHeights { .. }));
                assert_eq!(by_rise, !seen, "{factor}: {error:?}");
                if by_rise {
                    continue;
                }
                let ContactError::Input(InputError::Profile { body: at_fault, source }) = error
                else {
                    panic!()
                };
                let ProfileError::Derivative { k, given, difference, .. } = source else {
                    panic!()
                };
                assert_eq!(at_fault, body);
                let sign = if body == Body::Lower { -1.0 } else { 1.0 };
                let slope = sign * falls * (k + 0.2 * k * k * k);
                assert!((given / slope - factor).abs() < 1e-12, "{given} {slope}");
                assert!((difference / slope - 1.0).abs() < 1e-4, "{difference} {slope}");
            }
        }
    }
}

/// Many curves are NaN, or another shape, beyond their ends.
#[test]
fn a_curve_is_not_looked_at_beyond_its_ends() {
    struct Bounded([f64; 2]);
    impl ParametricProfile<f64> for Bounded {
        fn domain(&self) -> [f64; 2] {
            self.0
        }
        fn at(&self, k: f64) -> CurvePoint<f64> {
            assert!(k >= self.0[0] && k <= self.0[1], "{k} is beyond {:?}", self.0);
            CurvePoint { x: 2.0 * k, y: k * k, dx: 2.0, dy: 2.0 * k }
        }
        fn slope_at(&self, x: f64) -> Option<f64> {
            assert!(x >= 2.0 * self.0[0] && x <= 2.0 * self.0[1], "{x} is beyond {:?}", self.0);
            Some(0.5 * x)
        }
    }
    for domain in [[-1.0, 1.0], [0.1, 0.2], [5.0, 8.0], [-3.0, -2.9]] {
        assert_eq!(check_derivatives(&Bounded(domain)), Ok(()));
    }
}
