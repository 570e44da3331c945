//! Bodies from lines and arcs: tangents, corners, fillets, chamfers, halves, and what cannot be
//! drawn.

use linecontact::profile::{Outline, Placement, Segment};
use linecontact::{
    Contact, Control, CurvePoint, Flat, ParametricProfile, PiecewiseError, ProfileError,
};

const FROM: [f64; 2] = [0.5, -2.0];

/// Returns the points at the ends of each piece, from left to right.
fn ends(body: &dyn ParametricProfile<f64>) -> Vec<[CurvePoint<f64>; 2]> {
    (0..body.pieces()).map(|i| body.piece(i).unwrap().ends).collect()
}

fn slope(point: &CurvePoint<f64>) -> f64 {
    point.dy / point.dx
}

fn near(got: f64, due: f64, what: &str) {
    assert!((got - due).abs() < 4e-15 * (1.0 + due.abs()), "{what}: {got} {due}");
}

#[test]
fn each_segment_continues_the_last() {
    let outline = Outline::from(FROM).line(2.0).arc(10.0, 3.0).line(1.0).arc(-4.0, 2.5).line(0.5);
    let ends = ends(&outline.build().unwrap());
    let rise = (3.0f64 / 10.0).asin();
    let end = (rise.sin() - 2.5 / 4.0).asin();
    let angles = [0.0, 0.0, rise, rise, end, end];
    let x = [0.5, 2.5, 5.5, 6.5, 9.0, 9.5];
    let steps = [
        0.0,
        10.0 * (1.0 - rise.cos()),
        rise.tan(),
        -4.0 * (rise.cos() - end.cos()),
        0.5 * end.tan(),
    ];
    let mut y = FROM[1];
    assert_eq!(ends.len(), 5);
    for (i, ([left, right], step)) in ends.iter().zip(steps).enumerate() {
        for (point, i) in [(left, i), (right, i + 1)] {
            near(point.x, x[i], "x");
            near(slope(point), angles[i].tan(), "slope");
        }
        near(left.y, y, "y");
        y += step;
        near(right.y, y, "y");
    }
}

/// A wall that a rotation makes overhang is named, not the overlap with its neighbours; one with a
/// longer run turns with the body.
#[test]
fn a_wall_turned_beyond_the_upright_is_named() {
    for (run, overhangs) in [(1e-6, true), (1e-4, false)] {
        let land = Outline::from([0.0, 0.1]).line(0.5).corner(-0.1 / run).line(run);
        let pad = land.corner(0.0).line(2.0).corner(0.5).line(0.5).mirrored().build().unwrap();
        for (angle, piece) in [(1e-4, 3), (-1e-4, 6)] {
            let turned = pad.clone().placed(Placement::default().rotated(angle)).map(|_| ());
            let expected = |error| match error {
                PiecewiseError::InPiece { piece: at, source: ProfileError::TurnsBack { .. } } => {
                    at == piece
                }
                _ => false,
            };
            assert_eq!(turned.is_err_and(expected), overhangs, "{turned:?}");
            assert!(overhangs || turned.is_ok(), "{turned:?}");
        }
    }
}

#[test]
fn a_fillet_between_lines_touches_at_the_length_of_its_tangents() {
    // However flat the corner, the arc meets its lines, at half its length to the first digits.
    for [before, turn, radius] in [[0.1, 3e-4, 1e3], [0.2, 1e-6, 1e5], [-0.1, -1e-2, 50.0]] {
        let outline = Outline::from([0.0, 0.0]).corner(before).line(4.0).corner(before + turn);
        let ends = ends(&outline.fillet(radius).line(5.0).build().unwrap());
        let half = 0.5 * radius * turn.abs() / (1.0 + before * before).powf(1.5);
        assert!((ends[1][0].x - 4.0 + half).abs() < 0.01 * half, "{ends:?}, {half}");
    }
    for (before, behind, radius) in [(0.0, 1.0, 0.7), (0.5, -0.8, 0.3), (-0.2, 0.1, 3.0)] {
        let outline = Outline::from([0.0, 0.0]).corner(before).line(4.0).corner(behind);
        let body = outline.fillet(radius).line(5.0).build().unwrap();
        let angles = [before, behind].map(f64::atan);
        let tangent = radius * (0.5 * (angles[1] - angles[0])).abs().tan();
        let ends = ends(&body);
        assert_eq!(ends.len(), 3);
        for (side, sign) in [(0, -1.0), (1, 1.0)] {
            let point = ends[1][side];
            near(point.x, 4.0 + sign * tangent * angles[side].cos(), "x");
            near(point.y, 4.0 * before + sign * tangent * angles[side].sin(), "y");
            near(slope(&point), angles[side].tan(), "slope");
        }
        near(ends[2][1].y, 4.0 * before + 5.0 * behind, "the end is where it was");
    }
}

#[test]
fn a_fillet_touches_lines_and_arcs_of_any_kind() {
    let radii = [None, Some(12.0), Some(-12.0), Some(30.0), Some(-30.0)];
    let mut fillets = 0;
    for (before, behind) in radii.iter().flat_map(|one| radii.iter().map(move |other| (one, other)))
    {
        for (start, corner, radius) in
            [(0.1, 0.6, 0.4), (0.5, -0.2, 0.8), (-0.7, 0.3, 2.0), (0.2, -0.9, 2.0)]
        {
            let draw = |outline: Outline<f64>, radius: &Option<f64>| match *radius {
                None => outline.line(3.0),
                Some(radius) => outline.arc(radius, 3.0),
            };
            let sharp = draw(Outline::from(FROM).corner(start), before).corner(corner);
            let outline = draw(sharp.clone().fillet(radius), behind);
            let what = format!("{before:?} {behind:?} {start} {corner} {radius}");
            let segments = outline.segments().unwrap();
            let plain = draw(sharp, behind).segments().unwrap();
            let bends = ends(&draw(Outline::from(FROM).corner(start), before).build().unwrap());
            let Segment { radius: Some(found), ends: angles, .. } = segments[1] else {
                panic!("{what}")
            };
            let is_hollow = corner > slope(&bends[0][1]);
            assert_eq!(found, if is_hollow { radius } else { -radius }, "{what}");
            assert!(angles[0] < angles[1], "{what}");
            // The segments themselves stay where they are.
            for (one, other) in [(segments[0], plain[0]), (segments[2], plain[1])] {
                assert_eq!(Segment { ends: other.ends, ..one }, other, "{what}");
            }
            let ends = ends(&outline.build().unwrap());
            for pair in ends.windows(2) {
                let [left, right] = [pair[0][1], pair[1][0]];
                let off = [left.x - right.x, left.y - right.y, slope(&left) - slope(&right)];
                assert!(off.iter().all(|off| off.abs() < 3e-14), "{what} {off:?}");
            }
            fillets += 1;
        }
    }
    assert_eq!(fillets, 100);
}

#[test]
fn a_chamfer_begins_and_ends_at_its_lengths() {
    let outline =
        Outline::from([0.0, 0.0]).arc(-50.0, 8.0).corner(-1.0).chamfer(0.25, 0.5).line(2.0);
    let ends = ends(&outline.build().unwrap());
    let at = |x: f64| (2500.0 - x * x).sqrt() - 50.0;
    assert_eq!(ends.len(), 3);
    near(ends[1][0].x, 7.75, "x");
    near(ends[1][0].y, at(7.75), "y");
    near(ends[1][1].x, 8.5, "x");
    near(ends[1][1].y, at(8.0) - 0.5, "y");
}

#[test]
fn halves_are_mirrored_about_the_start() {
    let half = Outline::from(FROM).line(1.0).arc(5.0, 2.0).corner(1.0).fillet(0.2).line(1.0);
    let symmetric = ends(&half.clone().mirrored().build().unwrap());
    assert_eq!(symmetric.len(), 8);
    for (i, end) in symmetric.iter().enumerate() {
        let [left, right] = [end[0], symmetric[7 - i][1]];
        near(left.x - 0.5, 0.5 - right.x, "x");
        assert_eq!((left.y, slope(&left)), (right.y, -slope(&right)));
    }
    let other = Outline::from(FROM).arc(-3.0, 2.0);
    let body = ends(&half.clone().left(other).build().unwrap());
    assert_eq!(body.len(), 5);
    near(body[0][0].x, -1.5, "x");
    near(body[0][0].y, FROM[1] - 3.0 + 5.0f64.sqrt(), "y");
    let apart = half.left(Outline::from([0.5, 1.0]).line(1.0)).build().err();
    assert!(matches!(apart, Some(PiecewiseError::Jump { .. })), "{apart:?}");
}

#[test]
fn segments_meet_where_circles_are_far_away() {
    for radius in [1e3, 1e4, 1e5, 1e6, 1e7] {
        for (from, to) in [(0.0, 0.3), (0.27, -0.5), (-1.5, 0.1), (2.0, 0.9), (-0.01, 0.01)] {
            for radius in [radius, -radius] {
                let before = Outline::from([-7.0, 1.5]).corner(from).line(0.3).arc(radius, 20.0);
                let outline = before.corner(to).fillet(0.5).arc(-radius, 2.0).line(1.0);
                for whole in [outline.clone(), outline.mirrored()] {
                    let found = whole.build();
                    assert!(found.is_ok(), "{radius} {from} {to} {:?}", found.err());
                }
            }
        }
    }
}

#[test]
fn an_arc_may_end_upright() {
    let body = Outline::from([0.0, 0.0]).arc(2.0, 2.0).mirrored().build().unwrap();
    let ends = ends(&body);
    assert_eq!((ends[0][0].x, ends[1][1].x), (-2.0, 2.0));
    near(ends[1][1].y, 2.0, "y");
}

#[test]
fn the_contact_of_an_outline_is_proved_and_that_of_its_shape() {
    let crown = Outline::from([0.0, 0.0]).arc(200.0, 4.0).corner(0.5).fillet(0.3).line(0.5);
    let body = crown.mirrored().build().unwrap();
    let contact = Contact::new(&Flat, &body).unwrap().contact_modulus(115e3).certified(true);
    let solution = contact.solve(Control::Load(300.0)).unwrap();
    let circle = linecontact::profile::Ellipse::circle(200.0, [-0.03, 0.03]).unwrap();
    let whole = Contact::new(&Flat, &circle).unwrap().contact_modulus(115e3);
    let want = whole.solve(Control::Load(300.0)).unwrap();
    let (a, want): (f64, f64) = (solution.a(), want.a());
    assert!(a < 3.0 && (a / want - 1.0).abs() < 1e-12);
}

#[test]
fn what_cannot_be_drawn_is_named_by_its_segment() {
    let start = || Outline::from([0.0, 0.0]);
    let cases: [(Outline<f64>, usize, &str, f64); 19] = [
        (Outline::from([0.0, f64::NAN]).line(1.0), 1, "a coordinate of the start", f64::NAN),
        (start().line(0.0), 1, "the length along x", 0.0),
        (start().line(1.0).line(f64::NAN), 2, "the length along x", f64::NAN),
        (start().line(1.0).arc(0.0, 1.0), 2, "the radius", 0.0),
        (start().arc(1.0, 1.0).arc(f64::INFINITY, 1.0), 2, "the radius", f64::INFINITY),
        (start().line(1.0).line(1.0).arc(2.0, 2.5), 3, "the length along x", 2.5),
        (start().corner(f64::NAN).line(1.0), 1, "the slope after the corner", f64::NAN),
        (start().fillet(1.0).line(1.0), 1, "the radius of the fillet in front of it", 1.0),
        (
            start().line(1.0).fillet(0.5).line(1.0),
            2,
            "the radius of the fillet in front of it",
            0.5,
        ),
        (
            start().line(1.0).corner(1.0).fillet(-1.0).line(1.0),
            2,
            "the radius of the fillet in front of it",
            -1.0,
        ),
        (
            start().line(1.0).corner(1.0).fillet(9.0).line(9.0),
            2,
            "the radius of the fillet in front of it",
            9.0,
        ),
        // Too large for the arc that it would touch from inside.
        (
            start().arc(2.0, 1.0).corner(3.0).fillet(5.0).line(90.0),
            2,
            "the radius of the fillet in front of it",
            5.0,
        ),
        (
            start().line(1.0).corner(1.0).chamfer(0.5, 2.0).line(1.0),
            2,
            "a length of the chamfer in front of it",
            2.0,
        ),
        (
            start().line(1.0).corner(1.0).chamfer(-0.5, 0.5).line(1.0),
            2,
            "a length of the chamfer in front of it",
            0.5,
        ),
        (start().chamfer(0.5, 0.5).line(1.0), 1, "a length of the chamfer in front of it", 0.5),
        // Nothing is drawn behind these.
        (start().line(1.0).fillet(0.1), 2, "the radius of the fillet in front of it", 0.1),
        (start().line(1.0).corner(0.5), 2, "the slope after the corner", 0.5),
        (
            start().line(1.0).corner(1.0).chamfer(0.1, 0.2),
            2,
            "a length of the chamfer in front of it",
            0.2,
        ),
        (start().corner(0.5), 1, "the slope after the corner", 0.5),
    ];
    for (outline, at, called, given) in cases {
        for halved in [outline.clone(), start().line(1.0).left(outline)] {
            let Err(PiecewiseError::InSegment { segment, source }) = halved.build() else {
                panic!("{halved:?}")
            };
            let ProfileError::Parameter { name, value, .. } = source else { panic!("{source}") };
            assert_eq!(
                (segment, name, value.to_bits()),
                (at, called, given.to_bits()),
                "{halved:?}"
            );
        }
    }
    let error = start().line(1.0).arc(2.0, 2.5).build().err().unwrap();
    assert_eq!(
        error.to_string(),
        "segment 2 of the outline: the length along x is 2.5: it must be so short that the arc does not turn back"
    );
    for upright in [start().line(0.0), start().corner(f64::NEG_INFINITY).line(1.0)] {
        let said = upright.build().err().unwrap().to_string();
        assert!(said.ends_with("an upright wall is drawn by wall"), "{said}");
    }
    let empty = start().build().err();
    assert!(matches!(empty, Some(PiecewiseError::NoPieces)), "{empty:?}");
    assert!(Outline::from([0.0f32, 0.0]).line(1.0).arc(-9.0, 2.0).build().is_ok());
}

/// Two lands from 1 to 2 and from -2 to -1, of upright walls, below a flat, have known pressures.
/// Up or down, far from x = 0 or not, with a fillet on either side of the wall.
#[test]
fn walls_are_upright() {
    for (at, depth) in [(0.0, 1.0), (0.0, 1e-3), (0.0, 50.0), (300.0, 0.1)] {
        let half =
            Outline::from([at, -depth]).line(1.0).wall(depth).line(1.0).wall(-depth).line(1.0);
        let lands = half.mirrored().build().unwrap();
        assert!((ends(&lands)[6][0].y + depth).abs() < 1e-13 * depth);
        let contact = Contact::new(&lands, &Flat).unwrap().contact_modulus(1.0);
        let solution = contact.solve(Control::Load(1e-4 * depth)).unwrap();
        let pressure = solution.pressure().unwrap();
        let limits: Vec<f64> =
            solution.intervals().iter().flat_map(|on| [on.left - at, on.right - at]).collect();
        for (limit, due) in limits.iter().zip([-2.0, -1.0, 1.0, 2.0]) {
            assert!((limit - due).abs() < 4e-8 * depth.max(1.0), "{limits:?}");
        }
        for x in [1.1f64, -1.5, 1.9] {
            let due = 1e-4 * depth / std::f64::consts::PI * x.abs()
                / ((x * x - 1.0) * (4.0 - x * x)).sqrt();
            let got = pressure.at(at + x).unwrap();
            assert!((got / due - 1.0).abs() < 2e-7 * depth.max(1.0), "{depth}, {x}: {got} {due}");
        }
    }
    for half in [
        Outline::from([0.0, 0.0]).line(2.0).fillet(0.1).wall(-1.0).line(2.0),
        Outline::from([0.0, 0.0]).line(2.0).wall(-1.0).fillet(0.1).line(2.0),
        Outline::from([0.0, 0.0]).line(2.0).wall(1.0).corner(0.1).fillet(0.1).line(2.0),
    ] {
        let ends = ends(&half.build().unwrap());
        assert!((ends.last().unwrap()[1].x - 4.0).abs() < 4e-8, "{ends:?}");
        assert_eq!(ends.len(), 4, "{ends:?}");
    }
    let single = Outline::from([0.0f32, 0.0]).line(1.0).wall(-0.5).line(1.0).build();
    assert_eq!(single.unwrap().pieces(), 3);
    // A step of no height is none, and a punch may end with its sides.
    let flat = Outline::from([0.0, 0.0]).line(1.0).wall(0.0).line(1.0).build().unwrap();
    assert_eq!(flat.pieces(), 2);
    let punch = Outline::from([0.0, 0.0]).line(1.0).wall(0.5).mirrored().build().unwrap();
    assert_eq!(punch.pieces(), 4);
    let corner = Outline::from([0.0, 0.0]).line(1.0).wall(0.5).corner(0.1).build().err().unwrap();
    assert!(corner.to_string().contains("segment 3"), "{corner}");
}
