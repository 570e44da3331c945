//! Profiles: every way to make one, and every fault of one.
#![allow(missing_docs)]

use crate::common;

use common::{Profile, graph, paper, parabola};
use linecontact::reference::{ClosedForm, Hertz, Wedge};
use linecontact::{
    Contact, ContactError, Control, Convexity, Curve, CurvePoint, Flat, InputError,
    ParametricProfile, Piece, Piecewise, PiecewiseError, ProfileError,
};

fn half_width(upper: &dyn ParametricProfile<f64>) -> f64 {
    let contact = Contact::new(&Flat, upper).unwrap();
    contact.solve(Control::Load(0.01)).unwrap().a()
}

#[test]
fn single_coordinates_are_those_of_the_point() {
    let curve = paper::three().upper;
    let CurvePoint { x, y, dx, dy } = curve.at(0.3);
    assert_eq!([curve.x(0.3), curve.y(0.3), curve.dx(0.3), curve.dy(0.3)], [x, y, dx, dy]);
}

#[test]
fn a_known_slope_inverts_nothing() {
    struct Graph;
    impl ParametricProfile<f64> for Graph {
        fn domain(&self) -> [f64; 2] {
            [-1.0, 1.0]
        }
        fn at(&self, k: f64) -> CurvePoint<f64> {
            CurvePoint { x: k, y: k * k / 2.0, dx: 1.0, dy: k }
        }
        fn slope_at(&self, x: f64) -> Option<f64> {
            Some(x)
        }
    }
    let contact = Contact::new(&Flat, &Graph).unwrap();
    let solution = contact.solve(Control::Load(0.02)).unwrap();
    assert!((solution.a() / 0.2 - 1.0).abs() < 1e-15);
    assert_eq!(solution.cost().evaluations, 0);
}

#[test]
fn pieces_have_parameters_of_their_own() {
    // x²/2 in three pieces: by k = x; by k = -3 x, falling; by k³ + k = x.
    let breakpoint = (0..20).fold(0.1, |k: f64, _| k - (k * k * k + k - 0.1) / (3.0 * k * k + 1.0));
    let pieces: Vec<Profile> = vec![
        graph(-2.0, -0.1, |x| [x * x / 2.0, x]),
        Box::new(Curve::new([-0.3, 0.3], |k: f64| {
            let x = -k / 3.0;
            CurvePoint { x, y: x * x / 2.0, dx: -1.0 / 3.0, dy: -x / 3.0 }
        })),
        Box::new(Curve::new([breakpoint, 1.0], |k: f64| {
            let (x, dx) = (k * k * k + k, 3.0 * k * k + 1.0);
            CurvePoint { x, y: x * x / 2.0, dx, dy: x * dx }
        })),
    ];
    let joined = Piecewise::new(pieces).unwrap();
    let whole = half_width(&*parabola(2.0));
    assert!((half_width(&joined) / whole - 1.0).abs() < 1e-14);

    // Breakpoints are visible to quadratures.
    let pieces: Vec<_> = (0..joined.pieces()).map(|i| joined.piece(i).unwrap()).collect();
    assert_eq!(pieces.len(), 3);
    assert!(pieces[1].k[0] > pieces[1].k[1], "the middle piece falls");
    assert!(pieces.windows(2).all(|pair| (pair[0].x()[1] - pair[1].x()[0]).abs() < 1e-15));

    // A single parameter runs through the whole curve.
    assert_eq!(joined.domain(), [0.0, 3.0]);
    for k in [0.0, 0.4, 1.0, 1.3, 2.0, 2.9, 3.0] {
        let point = joined.at(k);
        assert!((point.y - point.x * point.x / 2.0).abs() < 1e-15, "{k}");
        assert!((point.dy / point.dx - point.x).abs() < 1e-14, "{k}");
        assert!(point.dx > 0.0, "left to right, whatever the pieces do");
    }
}

#[test]
fn pieces_of_pieces() {
    let quarter = |from, to| graph(from, to, |x| [x * x / 2.0, x]);
    let left: Profile =
        Box::new(Piecewise::new(vec![quarter(-2.0, -1.0), quarter(-1.0, 0.1)]).unwrap());
    let right: Profile =
        Box::new(Piecewise::new(vec![quarter(0.1, 0.15), quarter(0.15, 2.0)]).unwrap());
    let whole = Piecewise::new(vec![left, right]).unwrap();
    assert_eq!(whole.pieces(), 4);
    assert!((half_width(&whole) / half_width(&*parabola(2.0)) - 1.0).abs() < 1e-14);
}

fn line(from: f64, to: f64, shift: f64, up: f64) -> Profile {
    Box::new(Curve::new([from, to], move |k: f64| CurvePoint {
        x: k + shift,
        y: k + up,
        dx: 1.0,
        dy: 1.0,
    }))
}

#[test]
fn breakpoints_are_checked() {
    let join = |pieces| Piecewise::new(pieces).map(|_: Piecewise<f64, Profile>| ()).unwrap_err();
    let first = || line(-1.0, 0.0, 0.0, 0.0);
    assert_eq!(
        join(vec![first(), line(0.0, 1.0, 1e-6, 0.0)]),
        PiecewiseError::Gap { breakpoint: 1, left: 0.0, right: 1e-6, share: 1e-6 / (1.0 + 1e-6) }
    );
    assert_eq!(
        join(vec![first(), line(0.0, 1.0, 0.0, 0.0), line(1.0, 2.0, -0.25, 0.0)]),
        PiecewiseError::Overlap { breakpoint: 2, left: 1.0, right: 0.75, share: 0.25 / 1.75 }
    );
    assert_eq!(
        join(vec![first(), line(0.0, 1.0, 0.0, 1e-13)]),
        PiecewiseError::Jump {
            breakpoint: 1,
            x: 0.0,
            left: 0.0,
            right: 1e-13,
            share: 1e-13 / (1.0 + 1e-13)
        }
    );
    assert_eq!(
        join(vec![first(), line(0.0, 1.0, 1e-13, 0.0)]),
        PiecewiseError::Gap {
            breakpoint: 1,
            left: 0.0,
            right: 1e-13,
            share: 1e-13 / (1.0 + 1e-13)
        }
    );
    // Pieces in the wrong order overlap.
    assert!(matches!(
        join(vec![line(0.0, 1.0, 0.0, 0.0), first()]),
        PiecewiseError::Overlap { breakpoint: 1, left: 1.0, right: -1.0, .. }
    ));
    // So does a flat, on either side: it has no ends to be joined at.
    for pieces in [vec![first(), Box::new(Flat)], vec![Box::new(Flat) as Profile, first()]] {
        let endless = join(pieces).to_string();
        assert!(endless.contains("overlap of inf") && !endless.contains("e307"), "{endless}");
        assert!(
            endless.ends_with("such as a Flat, is no piece: take a Line of slope 0"),
            "{endless}"
        );
    }

    // Rounding is not a gap, and measured pieces may be joined with a tolerance.
    let off = |by| vec![first(), line(0.0, 1.0, by, 0.0)];
    assert!(Piecewise::new(off(1e-15)).is_ok());
    assert!(Piecewise::with_tolerance(off(1e-6), 1e-5).is_ok());
}

#[test]
fn a_piece_that_turns_back_is_found_where_it_turns() {
    let fold = |from, to| {
        Curve::new([from, to], |k: f64| CurvePoint {
            x: k * k * k - k / 4.0,
            y: k * k,
            dx: 3.0 * k * k - 0.25,
            dy: 2.0 * k,
        })
    };
    let turning = 1.0 / 12f64.sqrt();
    for (from, to, at) in [(-1.0, 1.0, -turning), (0.0, 1.0, turning), (-0.2, 1.3, turning)] {
        let body = fold(from, to);
        let error = Piece::checked(&body).map(|_| ()).unwrap_err();
        let ProfileError::TurnsBack { k, x, .. } = error else { panic!("{error}") };
        assert!((k - at).abs() < 1e-15, "{k} for {at}");
        assert!((x - (at.powi(3) - at / 4.0)).abs() < 1e-15);
    }
    // Each branch alone is valid, up to the fold itself.
    for (from, to) in [(turning, 1.0), (-turning, turning), (-1.0, -turning)] {
        assert!(Piece::checked(&fold(from, to)).is_ok(), "[{from}, {to}]");
    }
    let joined = Piecewise::new(vec![fold(-1.0, 1.0)]).map(|_| ()).unwrap_err();
    assert!(matches!(
        joined,
        PiecewiseError::InPiece { piece: 1, source: ProfileError::TurnsBack { .. } }
    ));
}

#[test]
fn a_narrow_fold_is_found_when_it_is_met() {
    // X turns back only for |k| < 0.012, between the points of the check, but at the contact.
    let dimple = Curve::new([-1.0, 1.05], |k: f64| CurvePoint {
        x: k * k * k - 4.3e-4 * k,
        y: k * k,
        dx: 3.0 * k * k - 4.3e-4,
        dy: 2.0 * k,
    });
    assert!(Piece::checked(&dimple).is_ok());
    let contact = Contact::new(&Flat, &dimple);
    let result = contact.and_then(|contact| contact.solve(Control::Load(1e-3)).map(|_| ()));
    let message = result.unwrap_err().to_string();
    assert!(message.contains("turns back"), "{message}");
}

#[test]
fn values_are_checked() {
    let hole = Curve::new([0.0, 3.2], |k: f64| CurvePoint {
        x: if k > 3.0 { f64::NAN } else { k },
        y: 0.0,
        dx: 1.0,
        dy: 0.0,
    });
    let error = Piece::checked(&hole).map(|_| ()).unwrap_err();
    assert!(
        matches!(error, ProfileError::NotFinite { quantity: "X", k, value } if k > 3.0 && value.is_nan())
    );
    // X' may be infinite at the very ends, but not inside.
    let root = |from| {
        Curve::new([from, 1.0], |k: f64| CurvePoint {
            x: k.cbrt(),
            y: k,
            dx: k.cbrt().powi(-2) / 3.0,
            dy: 1.0,
        })
    };
    assert!(Piece::checked(&root(0.0)).is_ok());
    assert!(matches!(
        Piece::checked(&root(-1.0)).map(|_| ()),
        Err(ProfileError::NotFinite { quantity: "X'", k: 0.0, .. })
    ));
    // A standstill: X constant over part of the range.
    let still =
        Curve::new([-1.0, 1.0], |k: f64| CurvePoint { x: k.max(0.0), y: k, dx: 1.0, dy: 1.0 });
    assert!(matches!(Piece::checked(&still).map(|_| ()), Err(ProfileError::TurnsBack { .. })));
}

#[test]
fn fine_waves_and_kinks_are_no_wrong_derivatives() {
    // In single precision the first difference of the check is longer than these waves.
    let wavy = Curve::new([-3.0f32, 3.0], |k: f32| CurvePoint {
        x: k,
        y: k * k / 2.0 + (100.0 * k).cos() / 1e3,
        dx: 1.0,
        dy: k - (100.0 * k).sin() / 10.0,
    });
    assert!(Piece::checked(&wavy).is_ok());
    // A kink within the first difference, next to a point of the check.
    let at = 0.2763 + 1e-6;
    let kinked = Curve::new([0.0, 1.0], move |k: f64| CurvePoint {
        x: k,
        y: (k - at).abs(),
        dx: 1.0,
        dy: (k - at).signum(),
    });
    assert!(Piece::checked(&kinked).is_ok());
}

/// X = ±k², Y = m x + x²/2 with x = k²: a wedge and a parabola. At the tip the slope is 0/0 on both
/// sides.
#[test]
fn a_tip_where_both_derivatives_vanish() {
    for m in [0.3, 2.0] {
        let side = |sign: f64| {
            Curve::new([0.0, 1.5], move |k: f64| {
                let (x, dx) = (k * k, 2.0 * k);
                CurvePoint { x: sign * x, y: x * (m + x / 2.0), dx: sign * dx, dy: dx * (m + x) }
            })
        };
        let body = Piecewise::new(vec![side(-1.0), side(1.0)]).unwrap();
        for l in [0.1, 1.3] {
            // For the same limits, loads and pressures add up.
            let (wedge, round) = (Wedge::new(m, l).unwrap(), Hertz::new(1.0, l).unwrap());
            let contact = Contact::new(&Flat, &body).unwrap().kappa(1.0);
            let solution = contact.solve(Control::Load(wedge.load(1.0) + round.load(1.0))).unwrap();
            assert!(
                (solution.a() / l - 1.0).abs() < 1e-13 && (solution.b() / l - 1.0).abs() < 1e-13
            );
            let error = solution.limits_error().unwrap();
            assert!(error < 1e-12, "{error:e}");
            let pressure = solution.pressure().unwrap();
            for x in [0.01, 0.3, 0.9].map(|z| z * l) {
                let exact = wedge.pressure(x, 1.0) + round.pressure(x, 1.0);
                assert!((pressure.at(x).unwrap() / exact - 1.0).abs() < 1e-12);
            }
            assert!(solution.cost().evaluations < 2000, "{:?}", solution.cost());
        }
    }
}

#[test]
fn joined_bodies_bulge_as_their_pieces_and_corners_do() {
    let line = |slope: f64, from: f64, to: f64| graph(from, to, move |x| [slope * x, slope]);
    let of = |left: f64, right: f64| {
        let told = |profile: Profile| Told { profile, convexity: Convexity::Straight };
        let pieces = vec![told(line(left, -1.0, 0.0)), told(line(right, 0.0, 1.0))];
        Piecewise::new(pieces).unwrap().convexity()
    };
    assert_eq!(of(-0.5, 0.3), Convexity::Convex);
    assert_eq!(of(0.3, -0.5), Convexity::Concave);
    assert_eq!(of(0.3, 0.3), Convexity::Straight);
}

/// Profile with its convexity.
struct Told {
    profile: Profile,
    convexity: Convexity,
}

impl ParametricProfile<f64> for Told {
    fn domain(&self) -> [f64; 2] {
        self.profile.domain()
    }
    fn at(&self, k: f64) -> CurvePoint<f64> {
        self.profile.at(k)
    }
    fn pieces(&self) -> usize {
        self.profile.pieces()
    }
    fn piece(&self, index: usize) -> Option<Piece<'_, f64>> {
        self.profile.piece(index)
    }
    fn convexity(&self) -> Convexity {
        self.convexity
    }
}

/// x²/2 from -1 to 0.2 and from 2.2 on: the first contact that extends into the hole is an error,
/// even if no heights are sampled.
#[test]
fn a_hole_between_two_pieces_is_no_body() {
    struct Holed([Profile; 2]);
    impl ParametricProfile<f64> for Holed {
        fn domain(&self) -> [f64; 2] {
            [0.0, 1.0]
        }
        fn at(&self, _: f64) -> CurvePoint<f64> {
            unreachable!("it is asked by its pieces")
        }
        fn pieces(&self) -> usize {
            2
        }
        fn piece(&self, index: usize) -> Option<Piece<'_, f64>> {
            self.0.get(index).map(|piece| Piece::new(piece).unwrap())
        }
        fn convexity(&self) -> Convexity {
            Convexity::Convex
        }
    }
    let part = |from: f64, to: f64| graph(from, to, |x| [x * x / 2.0, x]);
    let body = Holed([part(-1.0, 0.2), part(2.2, 3.0)]);
    let contact = Contact::new(&Flat, &body).unwrap();
    let error = contact.solve(Control::Load(0.2)).unwrap_err();
    let wanted = ProfileError::Pieces { count: 2, index: 1 };
    assert!(
        matches!(&error, ContactError::Input(InputError::Profile { source, .. }) if *source == wanted),
        "{error}"
    );
}
