//! The built-in shapes, and their placement.
#![allow(missing_docs, clippy::excessive_precision)] // Values are given to 20 digits.

use crate::common::{NanSafe, Profile};
use approx::assert_relative_eq;
use linecontact::profile::{Crowning, Ellipse, Involute, Line, Parabola, Placed, Placement};
use linecontact::profile::{rounded_punch, wedge};
use linecontact::reference::{self, ClosedForm, Hertz};
use linecontact::{
    Contact, Control, CurvePoint, Flat, ParametricProfile, Piece, Piecewise, PiecewiseError,
    ProfileError,
};
use std::f64::consts::{FRAC_PI_2, PI};

/// Returns relative errors of a solve on a flat: of the two limits, against the half-width, and the
/// largest error of the pressure on a grid.
fn against(upper: &dyn ParametricProfile<f64>, form: &dyn ClosedForm<f64>) -> [f64; 3] {
    let (want, load) = (form.limits(), form.load(1.0));
    let contact = Contact::new(&Flat, upper).unwrap();
    let solution = contact.solve(Control::Load(load)).unwrap();
    let (got, l, pressure) = (solution.hull(), want.half_width(), solution.pressure().unwrap());
    let off = |x: f64| (pressure.at(x).unwrap() / form.pressure(x, 1.0) - 1.0).abs();
    let at = |i: i32| want.at_angle(PI * (f64::from(i) + 0.1) / 20.0);
    let worst = (1..19).map(at).map(off).fold(0.0, NanSafe::nan_max);
    [(got.left - want.left).abs() / l, (got.right - want.right).abs() / l, worst]
}

/// X, Y, X' and Y' to 20 digits, from the formulas in the documentation of each shape; the last
/// number of a row is the allowed error of the slope.
#[test]
fn points_and_derivatives_keep_their_digits() {
    let tiny = 0.5f64.powi(20);
    let ellipse: Profile = Box::new(Ellipse::new(2.0, 0.75, [-FRAC_PI_2, FRAC_PI_2]).unwrap());
    let involute: Profile = Box::new(Involute::new(37.5, 0.375, [0.0, 1.5]).unwrap());
    let crowning: Profile = Box::new(Crowning::new(0.0078125, 5.0, [-5.0, 5.0]).unwrap());
    let ellipse_points = [
        (
            tiny,
            [1.9073486328122108794e-6, 3.4106051316482223982e-13],
            [1.9999999999990905053, 7.1525573730457907978e-7],
        ),
        (
            0.75,
            [1.3632775200466683335, 0.20123334834463433527],
            [1.4633777377476417726, 0.51122907001750062505],
        ),
        (
            -1.5703125,
            [-1.9999997659116371065, 0.74963712991798481348],
            [0.00096765355204049738761, -0.74999991221686391494],
        ),
    ];
    let involute_points = [
        (
            tiny,
            [0.000013411062127486515984, 6.3948954638621418508e-12],
            [14.062535762780470333, 0.000013411079180512174226],
        ),
        (
            -0.25,
            [-2.3254902448563968271, 0.24307455118674271444],
            [4.5417769767686474257, -1.1597060590055762325],
        ),
        (
            0.75,
            [18.694967771252693396, 8.7558293452607126112],
            [30.868124155614318641, 28.756635188484410159],
        ),
    ];
    let crowning_points = [
        (tiny, [tiny, 2.8421709430404524423e-16], [1.0, 5.9604644775392793404e-10]),
        (-3.0, [-3.0, 0.0034866179892845274338], [1.0, -0.0029296875]),
        (5.0 - tiny, [5.0 - tiny, 0.11546276905031638626], [1.0, 8191.9992187499254942]),
    ];
    for (body, points) in
        [(ellipse, ellipse_points), (involute, involute_points), (crowning, crowning_points)]
    {
        for (k, [x, y], [dx, dy]) in points {
            let got = body.at(k);
            for (got, want) in [(got.x, x), (got.y, y), (got.dx, dx), (got.dy, dy)] {
                assert_relative_eq!(got, want, epsilon = 0.0, max_relative = 1e-15);
            }
            if let Some(slope) = body.slope_at(x) {
                assert_relative_eq!(slope, dy / dx, epsilon = 0.0, max_relative = 1e-15);
            }
        }
        // The whole curve, with its derivatives against differences.
        Piece::checked(&*body).unwrap();
    }
}

#[test]
fn solves_agree_with_the_closed_forms() {
    let within = |body: &dyn ParametricProfile<f64>, form: &dyn ClosedForm<f64>| {
        let off = against(body, form);
        assert!(off.iter().all(|&off| off < 1e-13), "{form:?}: {off:?}");
    };
    let hertz = Hertz::new(1.3, 0.7).unwrap();
    within(&Parabola::new(1.3, [-2.0, 3.0]).unwrap(), &hertz);
    for half_width in [0.05, 0.6, 0.95] {
        let circle = reference::Ellipse::circle(1.0, half_width).unwrap();
        within(&Ellipse::circle(1.0, [-1.5, 1.5]).unwrap(), &circle);
    }
    let ellipse = reference::Ellipse::new(2.0, 0.3, 1.5).unwrap();
    within(&Ellipse::new(2.0, 0.3, [-1.2, 1.3]).unwrap(), &ellipse);
    let unequal = reference::Wedge::unequal(0.3, 0.7, 0.8).unwrap();
    within(&wedge([-0.3, 0.7], 9.0).unwrap(), &unequal);
    let punch = reference::RoundedPunch::new(0.4, 0.7, 1.0).unwrap();
    within(&rounded_punch(0.4, 0.7, 9.0).unwrap(), &punch);
    for half_width in [0.1, 2.0, 4.5, 4.999] {
        let form = reference::Crowning::new(0.01, 5.0, half_width).unwrap();
        let roller = Crowning::new(0.01, 5.0, [-5.0, 5.0]).unwrap();
        let off = against(&roller, &form);
        // Factor L/(l - L), which magnifies an error of the load or of x.
        let open = 1e-14 * (1.0 + half_width / (5.0 - half_width));
        assert!(off.iter().all(|&off| off < 10.0 * open), "{half_width}: {off:?}");
    }
}

/// The involutes of a solution of 25 digits (tests/data/gear_involute_pitch_point.json).
#[test]
fn two_involutes_touch_as_gear_teeth_do() {
    let pitch = 93.0 / 256.0;
    let flank = |radius| Involute::new(radius, pitch, [0.004, pitch + 1.0]).unwrap();
    let half_turn = Placement::default().mirrored().flipped();
    let pinion = Placed::new(flank(37.5), half_turn).unwrap();
    let wheel = flank(112.5);
    let contact = Contact::new(&pinion, &wheel).unwrap().contact_modulus(113187.0);
    let solution = contact.solve(Control::Load(1571.0 / PI)).unwrap();
    assert_relative_eq!(solution.a(), 0.23773942151913456, epsilon = 0.0, max_relative = 1e-13);
    assert_relative_eq!(solution.b(), 0.24161411179371945, epsilon = 0.0, max_relative = 1e-13);
}

/// An arc turned about its centre is another arc of the same circle.
#[test]
fn a_rotated_arc_is_an_arc() {
    let turn = 0.3;
    let arc = Ellipse::circle(2.0, [-0.5, 0.5]).unwrap();
    let about_centre = Placement::default().shifted(0.0, -2.0).rotated(turn).shifted(0.0, 2.0);
    let turned = Placed::new(arc, about_centre).unwrap();
    let whole = Ellipse::circle(2.0, [-1.5, 1.5]).unwrap();
    for i in -4..=4 {
        let k = 0.125 * f64::from(i);
        let (got, want) = (turned.at(k), whole.at(k + turn));
        for (got, want) in [(got.x, want.x), (got.dx, want.dx), (got.dy, want.dy)] {
            assert!((got - want).abs() < 1e-15, "{k}: {got} {want}");
        }
        // Near the lowest point the shift by the radius leaves an absolute rounding error of the
        // height.
        assert!((got.y - want.y).abs() < 1e-15, "{k}");
    }
    assert_eq!(turned.slope_at(0.0), None);
    let load = Control::Load(1e-3);
    let solve = |body: &dyn ParametricProfile<f64>| {
        Contact::new(&Flat, body).unwrap().solve(load).unwrap().hull()
    };
    let (got, want) = (solve(&turned), solve(&whole));
    assert_relative_eq!(got.right, want.right, epsilon = 0.0, max_relative = 1e-13);
    assert_relative_eq!(got.left, want.left, epsilon = 0.0, max_relative = 1e-13);
}

/// A parabola turned by α: `x cos α - x²/2 sin α, x sin α + x²/2 cos α`. It touches a flat where
/// its own slope is -tan α, with the radius of curvature 1/cos³ α.
#[test]
fn a_rotated_parabola_is_the_formula() {
    let (turn, parabola) = (0.25f64, Parabola::new(1.0, [-1.5, 1.5]).unwrap());
    let turned = Placed::new(parabola, Placement::default().rotated(turn)).unwrap();
    let (sin, cos) = turn.sin_cos();
    for k in [-1.25, -0.25, 0.0, 0.5, 1.0] {
        let (got, y) = (turned.at(k), k * k / 2.0);
        let want = CurvePoint {
            x: cos * k - sin * y,
            y: sin * k + cos * y,
            dx: cos - sin * k,
            dy: sin + cos * k,
        };
        for (got, want) in [(got.x, want.x), (got.y, want.y), (got.dx, want.dx), (got.dy, want.dy)]
        {
            assert_relative_eq!(got, want, epsilon = 0.0, max_relative = 4e-16);
        }
    }
    let contact = Contact::new(&Flat, &turned).unwrap();
    let solution = contact.solve(Control::HalfWidth(1e-4)).unwrap();
    let k = -turn.tan();
    let centre = solution.hull().centre();
    assert!((centre - turned.x(k)).abs() < 1e-7, "{centre}");
    assert_relative_eq!(solution.load(), 0.5e-8 * cos.powi(3), epsilon = 0.0, max_relative = 1e-7);
}

fn solved(lower: &dyn ParametricProfile<f64>, upper: &dyn ParametricProfile<f64>) -> [f64; 4] {
    let contact = Contact::new(lower, upper).unwrap();
    let solution = contact.solve(Control::Load(0.02)).unwrap();
    let (on, pressure) = (solution.hull(), solution.pressure().unwrap());
    let third = (on.right - on.left) / 3.0;
    let pressures = [on.left + third, on.right - third].map(|x| pressure.at(x).unwrap());
    [on.left, on.right, pressures[0], pressures[1]]
}

/// Returns two bodies without symmetry, one of them joined.
fn crooked() -> (Involute<f64>, Piecewise<f64, Line<f64>>) {
    (Involute::new(1.0, 0.5, [0.1, 1.2]).unwrap(), wedge([-0.2, 0.5], 3.0).unwrap())
}

#[test]
fn a_mirrored_or_exchanged_scene_has_the_same_solution() {
    let (upper, lower) = crooked();
    let lower = lower.placed(Placement::default().flipped()).unwrap();
    let plain = solved(&lower, &upper);
    let close = |got: [f64; 4], want: [f64; 4]| {
        for (got, want) in got.into_iter().zip(want) {
            assert_relative_eq!(got, want, epsilon = 0.0, max_relative = 2e-13);
        }
    };
    let mirror = Placement::default().mirrored();
    let other =
        solved(&lower.clone().placed(mirror).unwrap(), &Placed::new(upper, mirror).unwrap());
    close(other, [-plain[1], -plain[0], plain[3], plain[2]]);

    let flip = Placement::default().flipped();
    let exchanged =
        solved(&Placed::new(upper, flip).unwrap(), &lower.clone().placed(flip).unwrap());
    close(exchanged, plain);

    // Three times as large under three times the load: the same pressures.
    let scale = Placement::default().scaled(3.0).shifted(0.5, 7.0);
    let large = lower.clone().placed(scale).unwrap();
    let contact_upper = Placed::new(upper, scale).unwrap();
    let contact = Contact::new(&large, &contact_upper).unwrap();
    let solution = contact.solve(Control::Load(0.06)).unwrap();
    let on = solution.hull();
    let third = (on.right - on.left) / 3.0;
    let pressure = solution.pressure().unwrap();
    let pressures = [on.left + third, on.right - third].map(|x| pressure.at(x).unwrap());
    close([(on.left - 0.5) / 3.0, (on.right - 0.5) / 3.0, pressures[0], pressures[1]], plain);
}

#[test]
fn placing_keeps_breakpoints_and_known_slopes() {
    let (_, wedge) = crooked();
    let moved = wedge.placed(Placement::default().mirrored().shifted(2.0, 1.0)).unwrap();
    assert_eq!(moved.pieces(), 2);
    let pieces = [0, 1].map(|i| moved.piece(i).unwrap());
    assert_eq!([pieces[0].x(), pieces[1].x()], [[-1.0, 2.0], [2.0, 5.0]]);
    assert_eq!([0, 1].map(|i| pieces[i].curve.slope_at(0.0)), [Some(-0.5), Some(0.2)]);
    assert_eq!(moved.at(1.0).y, 1.0);

    // A wedge turned by less than the angle of its flank: tan(α - β).
    let turn = 0.1f64.atan();
    let (_, wedge) = crooked();
    let turned = wedge.placed(Placement::default().rotated(turn)).unwrap();
    let slopes = [0, 1].map(|i| turned.piece(i).unwrap().ends[i]).map(|end| end.dy / end.dx);
    assert_relative_eq!(slopes[0], -0.1 / 1.02, epsilon = 0.0, max_relative = 1e-15);
    assert_relative_eq!(slopes[1], 0.6 / 0.95, epsilon = 0.0, max_relative = 1e-15);

    // Turned by exactly that angle it lies on its flank, which is level to rounding.
    let (_, wedge) = crooked();
    let turned = wedge.placed(Placement::default().rotated(0.2f64.atan())).unwrap();
    let left = turned.piece(0).unwrap().ends[0];
    assert!(left.dy.abs() < 1e-16 && left.y.abs() < 1e-15, "{left:?}");
    let round = Ellipse::circle(-2.0, [-1.0, 1.0]).unwrap();
    let contact = Contact::new(&round, &turned).unwrap();
    let ends = contact.solve(Control::Load(0.01)).unwrap().hull();
    assert!(ends.left < 0.0 && ends.right > 0.0, "{ends:?}");

    // An infinite slope stays infinite, and does not become NaN.
    let crowning = Crowning::new(0.1, 1.0, [-1.0, 1.0]).unwrap();
    let moved = Placed::new(crowning, Placement::default().shifted(3.0, 0.0)).unwrap();
    assert_eq!(moved.at(1.0).dy, f64::INFINITY);
    assert_eq!(moved.slope_at(4.0), Some(f64::INFINITY));

    // Steps take effect in their order, about the origin.
    let placement = Placement::default().shifted(1.0, 0.0).rotated(FRAC_PI_2).scaled(2.0);
    let point = Placed::new(Parabola::new(1.0, [-1.0, 1.0]).unwrap(), placement).unwrap().at(0.0);
    assert!(point.x.abs() < 1e-15 && (point.y - 2.0).abs() < 1e-15, "{point:?}");
}

#[test]
fn what_is_no_shape_is_refused() {
    fn named<S>(made: Result<S, ProfileError<f64>>, expected: &str) {
        match made.err().expect(expected) {
            ProfileError::Parameter { name, .. } => assert_eq!(name, expected),
            other => panic!("{other}"),
        }
    }
    let unit = [-1.0, 1.0];
    for radius in [0.0, f64::NAN, f64::INFINITY, 1e-310] {
        named(Parabola::new(radius, unit), "the radius");
    }
    named(Line::new(f64::NAN, unit), "the slope");
    named(Ellipse::circle(0.0, unit), "the semi-axis along the contact");
    named(Ellipse::new(-1.0, 1.0, unit), "the semi-axis along the contact");
    named(Ellipse::new(1.0, f64::NAN, unit), "the semi-axis across it");
    named(Ellipse::circle(1.0, [0.0, 1.6]), "an angle");
    named(Involute::new(-1.0, 0.3, [0.1, 0.5]), "the base radius");
    named(Involute::new(1.0, -0.3, [0.1, 0.5]), "the angle at the origin");
    named(Involute::new(1.0, 0.3, [-0.1, 0.5]), "a roll angle");
    named(Involute::new(1.0, 0.3, [0.1, 1.9]), "a roll angle");
    named(Crowning::new(0.0, 1.0, unit), "the depth");
    named(Crowning::new(1.0, -1.0, unit), "the half-length");
    named(Crowning::new(1.0, 1.0, [-1.0, 1.5]), "an end");
    named(Crowning::new(1.0, 1.0, [-1.5, 1.0]), "an end");
    let parabola = Parabola::new(1.0, unit).unwrap();
    // The error names the first invalid step and its value.
    let place = Placement::default;
    for (wrong, name, asked) in [
        (place().scaled(0.0), "a factor of a placement", 0.0),
        (place().scaled(f64::INFINITY).rotated(f64::NAN), "a factor of a placement", f64::INFINITY),
        (place().rotated(f64::NAN), "an angle of a placement", f64::NAN),
        (place().rotated(f64::INFINITY), "an angle of a placement", f64::INFINITY),
        (place().shifted(f64::INFINITY, 0.0), "a shift of a placement", f64::INFINITY),
        (place().shifted(0.0, f64::NAN).scaled(2.0), "a shift of a placement", f64::NAN),
        (place().scaled(1e-200).scaled(1e-200), "the product of all factors of a placement", 0.0),
        (
            place().shifted(1e308, 0.0).scaled(10.0),
            "the sum of the shifts of a placement",
            f64::INFINITY,
        ),
    ] {
        let refused = Placed::new(parabola, wrong);
        let Err(ProfileError::Parameter { value, .. }) = refused else { panic!("{refused:?}") };
        assert_eq!(value.to_bits(), asked.to_bits(), "{name}");
        named(refused, name);
    }

    for domain in [[1.0, -1.0], [0.0, 0.0], [0.0, f64::INFINITY], [f64::NAN, 1.0]] {
        let wrong = |made: Option<ProfileError<f64>>| {
            assert!(matches!(made, Some(ProfileError::Domain { .. })), "{domain:?} {made:?}");
        };
        wrong(Parabola::new(1.0, domain).err());
        wrong(Line::new(1.0, domain).err());
        wrong(Ellipse::circle(1.0, domain).err());
        wrong(Crowning::new(1.0, 1.0, domain).err());
        wrong(Involute::new(1.0, 0.0, domain).err());
    }
    let in_piece = |made: Option<PiecewiseError<f64>>, at: usize, of: &str| match made {
        Some(PiecewiseError::InPiece {
            piece,
            source: ProfileError::Parameter { name, .. },
            ..
        }) => {
            assert_eq!((piece, name), (at, of));
        }
        other => panic!("{other:?}"),
    };
    in_piece(wedge([-0.1, f64::NAN], 1.0).err(), 2, "the slope");
    in_piece(wedge([-0.1, 0.1], -1.0).err(), 1, "the reach");
    in_piece(rounded_punch(1.0, 1.0, 0.5).err(), 1, "the reach");
    in_piece(rounded_punch(1.0, 1.0, f64::NAN).err(), 1, "the reach");
    in_piece(rounded_punch(-0.5, 1.0, 0.5).err(), 2, "the half-width of the flat");
    in_piece(rounded_punch(0.5, 0.0, 1.0).err(), 1, "the radius");

    // A joined body is not smooth, and a body turned too far turns back.
    let joined = wedge([-0.1, 0.1], 1.0).unwrap();
    let error = Placed::new(&joined, Placement::default()).err();
    assert_eq!(error, Some(ProfileError::Joined { pieces: 2 }));
    assert!(joined.placed(Placement::default().rotated(1.55)).is_err());
    let turned = Placed::new(parabola, Placement::default().rotated(1.0)).unwrap();
    assert!(matches!(Piece::checked(&turned), Err(ProfileError::TurnsBack { .. })));
}

#[test]
fn shapes_are_generic() {
    let roller = Ellipse::circle(1.0f32, [-1.5, 1.5]).unwrap();
    let moved = Placed::new(roller, Placement::default().shifted(0.25, 0.0)).unwrap();
    let contact = Contact::new(&Flat, &moved).unwrap();
    let form = reference::Ellipse::circle(1.0f32, 0.5).unwrap();
    let solution = contact.solve(Control::Load(form.load(1.0))).unwrap();
    assert!((solution.a() - 0.75).abs() < 1e-6, "{}", solution.a());
}
