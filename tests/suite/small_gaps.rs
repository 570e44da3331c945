//! Bodies whose gap is a small difference of large heights, and walls far steeper than the contact.

use linecontact::{
    Contact, ContactError, Control, Curve, CurvePoint, Flat, Interval, ParametricProfile,
    SolveError, Solver,
};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// Height and slope by x.
type Graph = fn(f64) -> [f64; 2];

/// Two valleys, the second 5 % higher, and more farther up.
fn valleys(x: f64) -> [f64; 2] {
    let (sin, cos) = (9.0 * x + 0.5).sin_cos();
    [0.5 * x * x + 0.1 * cos, x - 0.9 * sin]
}

/// A graph plus a multiple of another, from -3 to 3, with X = k.
fn sum(graph: Graph, share: f64, other: Graph) -> impl ParametricProfile<f64> {
    Curve::new([-3.0, 3.0], move |x: f64| {
        let ([y, dy], [more, slope]) = (graph(x), other(x));
        CurvePoint { x, y: y + share * more, dx: 1.0, dy: dy + share * slope }
    })
}

fn nothing(_: f64) -> [f64; 2] {
    [0.0; 2]
}

/// Both bodies may be far from Y = 0, or wavy themselves: the gap alone counts, as far as the
/// heights are known. An overlap of less than the rounding of a slope was taken for noise, so that
/// a warm start kept one contact of two, and a half-width within a jump was had.
#[test]
fn what_both_bodies_share_changes_nothing() {
    let shared: [Graph; 4] = [
        |_| [1.0, 0.0],
        |_| [1000.0, 0.0],
        |x| [5.0 * (1.4 * x).sin(), 7.0 * (1.4 * x).cos()],
        |x| [(1.4 * x + 0.3).sin(), 1.4 * (1.4 * x + 0.3).cos()],
    ];
    let intervals = |solution: &linecontact::Solution<'_, f64>| solution.intervals().to_vec();
    for share in [1e-4, 1e-5, 1e-6, 1e-8] {
        let alone = sum(nothing, share, valleys);
        let alone = Contact::new(&Flat, &alone).unwrap().kappa(1.0);
        for (i, &graph) in shared.iter().enumerate() {
            // Where the least load moves heights by 1000 of their roundings.
            let rounding = f64::EPSILON * graph(0.5)[0].abs().max(1.0);
            if share * 1e-3 < 1e3 * rounding {
                continue;
            }
            let (lower, upper) = (sum(graph, 0.0, nothing), sum(graph, share, valleys));
            let contact = Contact::new(&lower, &upper).unwrap().kappa(1.0);
            let mut solver = Solver::new();
            for load in [1e-3, 3e-3, 1e-2, 3e-2, 0.1, 0.3].map(|load| share * load) {
                let due = intervals(&alone.solve(Control::Load(load)).unwrap());
                for found in [
                    solver.solve(&contact, Control::Load(load)).unwrap(),
                    contact.solve(Control::Load(load)).unwrap(),
                ] {
                    assert!(agree(&found, &due), "{share} {i} {load:e}: {found}, not {due:?}");
                    assert!(found.report().is_checked());
                }
            }
            for width in [0.08, 0.1, 0.2] {
                let found = contact.solve(Control::HalfWidth(width)).map(|found| intervals(&found));
                let in_jump = matches!(&found, Err(ContactError::Solve(SolveError::InJump { .. })));
                assert!(in_jump, "{share} {i} {width}: {found:?}");
            }
        }
    }
}

/// Tells whether limits agree within the error that the solution states.
fn agree(found: &linecontact::Solution<'_, f64>, due: &[Interval<f64>]) -> bool {
    let error = found.limits_error().unwrap().max(1e-12);
    let same = |(one, other): (&Interval<f64>, &Interval<f64>)| {
        let off = (one.left - other.left).abs().max((one.right - other.right).abs());
        off <= error * other.half_width()
    };
    found.intervals().len() == due.len() && found.intervals().iter().zip(due).all(same)
}

/// The heights of several contacts are known to the rounding of the bodies' own heights.
#[test]
fn a_certificate_knows_how_far_heights_are_known() {
    for (i, graph) in [nothing, |_| [1.0, 0.0], |_| [1000.0, 0.0]].into_iter().enumerate() {
        let (lower, upper) = (sum(graph, 0.0, nothing), sum(graph, 1e-5, valleys));
        let contact = Contact::new(&lower, &upper).unwrap().kappa(1.0);
        let found = contact.solve(Control::Load(3e-7)).unwrap();
        assert_eq!(found.intervals().len(), 2);
        assert!(found.certify().unwrap().is_proved(), "{i}");
    }
}

/// Sum of cosines `[amplitude, wavenumber, phase]`.
fn cosines<const N: usize>(terms: [[f64; 3]; N], x: f64) -> [f64; 2] {
    terms.iter().fold([0.0; 2], |[y, dy], [a, k, phase]| {
        let (sin, cos) = (k * x + phase).sin_cos();
        [y + a * cos, dy - a * k * sin]
    })
}

/// A contact between the limits of two has a slope that falls, a little beside the steepest one but
/// much beside the pressure: it was said to be checked, under a load below zero.
#[test]
fn what_bears_nothing_is_no_contact() {
    let shared = |x: f64| {
        cosines(
            [
                [-0.0057, 13.82, 4.923],
                [0.0958, 3.03, 5.316],
                [-0.549, 1.155, 3.497],
                [-0.00385, 6.296, 5.932],
            ],
            x,
        )
    };
    let waves = |x: f64| {
        let [y, dy] =
            cosines([[0.0753, 3.506, 6.094], [-0.0633, 2.108, 4.815], [0.0335, 5.585, 4.935]], x);
        [0.5 * x * x + y, x + dy]
    };
    let lower = Curve::new([-1.0, 1.0], |k: f64| {
        let (x, dx) = (3.0 * (0.598 * k).sin() / 0.598f64.sin(), 3.0 * 0.598 * (0.598 * k).cos());
        let ([y, slope], dx) = (shared(x), dx / 0.598f64.sin());
        CurvePoint { x, y, dx, dy: slope * dx }
    });
    let mut borne = 0;
    for share in [1.235e-9, 3e-10] {
        let upper = Curve::new([0.0, 6.0], |k: f64| {
            let x = -3.0 + 6.0 * (1.9 * k).exp_m1() / 11.4f64.exp_m1();
            let dx = 11.4 * (1.9 * k).exp() / 11.4f64.exp_m1();
            let ([y, slope], [more, steeper]) = (shared(x), waves(x));
            CurvePoint { x, y: y + share * more, dx, dy: (slope + share * steeper) * dx }
        });
        let contact = Contact::new(&lower, &upper).unwrap().kappa(1.0);
        for width in [0.385, 0.4] {
            let Ok(found) = contact.solve(Control::HalfWidth(width)) else { continue };
            assert!(found.load() > 0.0 && found.intervals().len() == 2, "{share} {width}: {found}");
            borne += 1;
        }
    }
    assert!(borne > 0);
}

/// Between points far up a wall a series rings, where the points themselves leave no room for it:
/// cells took the rings for contacts, and nine of these were refused.
#[test]
fn a_wall_of_a_high_power_has_no_contacts() {
    for power in [20.0, 33.0, 40.0, 54.0, 60.0] {
        for height in [1e-3, 1e-4, 1e-5] {
            for wave in [2.0, 4.0, 7.0] {
                let body = Curve::new([-1.3, 1.3], |x: f64| {
                    let (sin, cos) = (wave * x + 0.4).sin_cos();
                    let steep = power * x.abs().powf(power - 1.0) * x.signum();
                    let (y, dy) = (x.abs().powf(power), steep - height * wave * sin);
                    CurvePoint { x, y: y + height * cos, dx: 1.0, dy }
                });
                let contact = Contact::new(&Flat, &body).unwrap().kappa(1.0);
                for load in [1e-3, 1e-2, 0.1] {
                    let name = format!("{power} {height} {wave} {load}");
                    let found = contact.solve(Control::Load(load)).expect(&name);
                    assert!(
                        found.report().is_checked() && found.hull().half_width() < 1.0,
                        "{name}"
                    );
                }
            }
        }
    }
}

/// Two valleys of the same depth touch at once: smaller half-widths come with no load. Loads below
/// the rounding of the heights took up to 12 s.
#[test]
fn a_half_width_within_a_jump_from_zero_is_soon_refused() {
    for (shared, share) in [(1.0, 1e-3), (0.1, 1e-4)] {
        let count = AtomicUsize::new(0);
        let at = |x: f64, share: f64| {
            count.fetch_add(1, Relaxed);
            let ((sin, cos), (wave, even)) = ((1.4 * x + 0.3).sin_cos(), (12.0 * x).sin_cos());
            let y = shared * sin + share * (0.5 * x * x + 0.1 * even);
            CurvePoint { x, y, dx: 1.0, dy: 1.4 * shared * cos + share * (x - 1.2 * wave) }
        };
        let lower = Curve::new([-3.0, 3.0], |k: f64| at(k, 0.0));
        let upper = Curve::new([-3.0, 3.0], |k: f64| at(k, share));
        let contact = Contact::new(&lower, &upper).unwrap().kappa(1.0);
        let error = contact.solve(Control::HalfWidth(0.05)).map(|_| ()).unwrap_err();
        let in_jump = matches!(error, ContactError::Solve(SolveError::InJump { .. }));
        assert!(in_jump, "{shared}: {error}");
        assert!(count.load(Relaxed) < 10_000, "{shared}: {count:?} points");
    }
}
