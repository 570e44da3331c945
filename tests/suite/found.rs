//! What random scenes have found, as single cases with an oracle.
#![allow(missing_docs, clippy::excessive_precision)]

use crate::common;

use common::{Profile, graph, join};
use linecontact::search::Brent;
use linecontact::{Contact, Flat, Interval, Load, Panels};

/// The slope t + c x, and j more to the right of x₀.
fn with_jump(j: f64, x0: f64, c: f64, t: f64) -> Profile {
    let y = move |x: f64, more: f64| [t * x + c * x * x / 2.0 + more * (x - x0), t + c * x + more];
    join(vec![graph(-4.0, x0, move |x| y(x, 0.0)), graph(x0, 4.0, move |x| y(x, j))])
}

/// From 40 digits, by the two equations in closed form.
#[test]
fn an_edge_just_beyond_a_jump_of_the_slope() {
    let cases = [
        (
            (1.0, -0.5162306427955627, 0.25, -0.9992687106132507),
            0.5135073661804199,
            (0.51078408311082659441, 0.51623064925001324934, 0.032987142897883062987),
        ),
        (
            (5.236591339111328, 0.0790955051779747, 0.25, -0.01930171437561512),
            0.05381026864051819,
            (0.079097136668507332429, 0.028523400612529044524, 0.001060393212825595038),
        ),
        (
            (1.8191059827804565, -0.5082387328147888, 0.25, -1.7092387676239014),
            0.07782440632581711,
            (-0.35259051476219777117, 0.50823932741383198748, 0.00093323369624120227465),
        ),
    ];
    for ((j, x0, c, t), half_width, (a, b, load)) in cases {
        let body = with_jump(j, x0, c, t);
        let contact = Contact::new(&Flat, &*body).unwrap();
        for pressed in [Load::ToHalfWidth(half_width), Load::PerLength(load)] {
            let solution = contact.solve(pressed).unwrap();
            let off = (solution.a() - a).abs().max((solution.b() - b).abs()) / half_width;
            let allowed = solution.limits_error().unwrap() + 1e-15;
            assert!(off <= allowed && allowed < 2e-13, "{pressed:?}: {off:e}, {allowed:e}");
            let off = (solution.load() / load - 1.0).abs();
            assert!(off < 5e-14, "{pressed:?}: load off by {off:e}");
        }
    }
}

/// A panel of many nodes has only noise left, its halves with fewer nodes have more.
#[test]
fn halves_of_a_panel_that_is_all_but_resolved() {
    let tanh = |c: f64, w: f64, x0: f64| {
        move |x: f64| {
            let t: f64 = (x - x0) / w;
            [c * w * (t.abs() + (-2.0 * t.abs()).exp().ln_1p()), c * t.tanh()]
        }
    };
    let (one, two) = (
        tanh(1.679356336593628, 0.15086889266967773, -0.7687158584594727),
        tanh(1.2392243146896362, 0.7830978035926819, 0.0),
    );
    let tilt = -1.34610116481781;
    let upper = graph(-4.0, 4.0, move |x| {
        let [y, dy] = one(x);
        [y + 0.125 * x * x + tilt * x, dy + 0.25 * x + tilt]
    });
    let lower = graph(-4.0, 4.0, move |x| two(x).map(|value| -value));
    let contact = Contact::new(&*lower, &*upper).unwrap();
    for half_width in [0.448, 0.449, 0.45, 0.45035219192504883, 0.451, 0.46] {
        let solution = contact.solve(Load::ToHalfWidth(half_width)).unwrap();
        assert!(solution.limits_error().unwrap() < 1e-13, "{solution:?}");
        for z in [-0.9, -0.6, -0.2, 0.1, 0.8] {
            let on = solution.interval();
            let residual = solution.residual(on.centre() + half_width * z).unwrap();
            assert!(residual.abs() < 1e-12, "{half_width} {z}: {residual:e}");
        }
    }
}

/// A wave on both bodies is not in the gap; few nodes do for that, but not for the wave.
#[test]
fn a_wave_on_both_bodies_is_no_wrong_derivative() {
    let wave = |x: f64| {
        let (sin, cos) = (3.4229738164748196 * x).sin_cos();
        [-0.795571308622995 / 3.4229738164748196 * cos, 0.795571308622995 * sin]
    };
    let upper = graph(-4.188255260300484, 4.614434906737044, move |x| {
        let [y, dy] = wave(x);
        [y + 0.25 * x * x, dy + 0.5 * x]
    });
    let lower = graph(-4.188255260300484, 4.614434906737044, wave);
    let contact = Contact::new(&*lower, &*upper).unwrap();
    let (brent, coarse) = (Brent::default(), Panels { tolerance: 1e-3 });
    for contact in [contact.clone(), contact.clone().search(&brent), contact.quadrature(&coarse)] {
        for (left, right) in [(-0.611, -0.6105), (2.0, 2.001), (-3.0, 3.0), (-4.0, -3.9)] {
            let contact = contact.clone().start(Interval { left, right });
            let solution = contact.solve(Load::ToHalfWidth(0.8)).unwrap();
            assert!((solution.load() / 0.16 - 1.0).abs() < 1e-12, "{solution:?}");
        }
    }
}

/// A loose tolerance, and a slope whose largest part is a straight line: four nodes see a huge fall
/// of the coefficients, which does not go on.
#[test]
fn a_steep_line_before_a_series() {
    let at = |x: f64| {
        [
            2f64.powi(24) * x * x + 3.0 * (2.0 * x).exp() / 2.0,
            2f64.powi(25) * x + 3.0 * (2.0 * x).exp(),
        ]
    };
    let body = graph(-3.0, 3.0, at);
    let contact = Contact::new(&Flat, &*body).unwrap();
    let exact = contact.solve(Load::ToHalfWidth(1.0)).unwrap().interval();
    for tolerance in [1e-13, 1e-12, 1e-11, 1e-10, 1e-9, 1e-8, 1e-6] {
        let rule = Panels { tolerance };
        let coarse = contact.clone().quadrature(&rule);
        let solution = coarse.solve(Load::ToHalfWidth(1.0)).unwrap();
        let off = (solution.a() - exact.right).abs();
        let estimate = solution.limits_error().unwrap();
        assert!(off <= estimate, "{tolerance}: {off:e} > {estimate:e}");
    }
}
