//! Certificates: contacts pass; anything else is refused at the right place with the right value.
#![allow(missing_docs)]

use crate::common;
use crate::forms;

use common::{Profile, graph, join, parabola};
use forms::{Form, KAPPA, forms};
use linecontact::reference::body;
use linecontact::{
    Contact, ContactError, Control, Curve, CurvePoint, Edge, Extremum, Flat, InputError, Midpoint,
    SolveError, Solver,
};
use std::f64::consts::PI;

/// Returns x²/2 + ε cos wx, on [-3, 3].
fn wavy(eps: f64, w: f64) -> Profile {
    graph(-3.0, 3.0, move |x| {
        let (s, c) = (w * x).sin_cos();
        [x * x / 2.0 + eps * c, x - eps * w * s]
    })
}

/// Returns J_n from its integral, which the trapezoidal rule gives to all digits.
fn bessel(n: i32, x: f64) -> f64 {
    let m = 400;
    let term = |i: i32| {
        let t = PI * f64::from(i) / f64::from(m);
        (f64::from(n) * t - x * t.sin()).cos() * if i == 0 || i == m { 0.5 } else { 1.0 }
    };
    (0..=m).map(term).sum::<f64>() / f64::from(m)
}

/// Closed form for such a wave: P(x) for |x| < l, the load, and the gap outside.
struct Wave {
    eps: f64,
    w: f64,
    l: f64,
    /// J_1, J_3, ... of w l.
    odd: Vec<f64>,
}

impl Wave {
    fn new(eps: f64, w: f64, l: f64) -> Self {
        let odd = (0..60).map(|n| bessel(2 * n + 1, w * l)).collect();
        Self { eps, w, l, odd }
    }

    fn load(&self) -> f64 {
        self.l * self.l / 2.0 - self.eps * self.w * self.l * self.odd[0]
    }

    /// Returns the coefficients c_k, k = 1, 3, ..., of the slope.
    fn c(&self, n: usize) -> f64 {
        let first = if n == 0 { self.l } else { 0.0 };
        let sign = if n.is_multiple_of(2) { 1.0 } else { -1.0 };
        first - 2.0 * self.eps * self.w * sign * self.odd[n]
    }

    fn pressure(&self, x: f64) -> f64 {
        let theta = (x / self.l).acos();
        let term = |n: usize| self.c(n) * ((2 * n + 1) as f64 * theta).sin();
        (0..60).map(term).sum::<f64>() / PI
    }

    /// Returns the gap, with x = l cosh t: Σ c_k u^k, u = exp(-t), integrated term by term.
    fn gap(&self, x: f64) -> f64 {
        let body = |x: f64| x * x / 2.0 + self.eps * (self.w * x).cos();
        let t = (x / self.l).acosh();
        let drawn = |n: usize| {
            // ∫ e^{-kt} l sinh t dt
            let k = (2 * n + 1) as f64;
            let up = if n == 0 { t } else { (1.0 - (-(k - 1.0) * t).exp()) / (k - 1.0) };
            let down = (1.0 - (-(k + 1.0) * t).exp()) / (k + 1.0);
            self.c(n) * self.l / 2.0 * (up - down)
        };
        body(x) - body(self.l) - (0..60).map(drawn).sum::<f64>()
    }
}

/// Returns the least value on a fine grid, refined.
fn least(f: impl Fn(f64) -> f64, mut from: f64, mut to: f64) -> [f64; 2] {
    let mut best = [from, f64::INFINITY];
    for _ in 0..8 {
        let step = (to - from) / 400.0;
        for i in 0..=400 {
            let x = from + step * f64::from(i);
            if f(x) < best[1] {
                best = [x, f(x)];
            }
        }
        (from, to) = ((best[0] - 2.0 * step).max(from), (best[0] + 2.0 * step).min(to));
    }
    best
}

/// Returns the amplitude at which f, positive for small amplitudes, becomes zero.
fn margin(f: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    assert!(f(low) > 0.0 && f(high) < 0.0);
    for _ in 0..60 {
        let middle = (low + high) / 2.0;
        if f(middle) > 0.0 { low = middle } else { high = middle }
    }
    low
}

#[test]
fn tension_in_a_wave_on_both_sides_of_the_margin() {
    // The contacts of the three files, with the amplitude grown until the pressure touches zero.
    for (w, l, highest) in [
        (16.0, 0.233_306_345_773_701_2, 0.03),
        (24.0, 1.142_738_838_438_643, 0.03),
        (16.0, 0.979, 0.1),
    ] {
        let lowest = |eps: f64| {
            let wave = Wave::new(eps, w, l);
            least(|x| wave.pressure(x), 0.0, 0.99 * l)
        };
        let at = margin(|eps| lowest(eps)[1], 1e-4, highest);
        for off in [1e-1, 1e-3, 1e-6, 1e-8] {
            let below = wavy(at * (1.0 - off), w);
            let contact = Contact::new(&Flat, &*below).unwrap();
            let contact = contact.edges(Edge::FreeUntil(-l), Edge::FreeUntil(l));
            let load = Control::Load(Wave::new(at * (1.0 - off), w, l).load() * (1.0 + 1e-13));
            let passed = contact.solve(load).and_then(|s| s.certify());
            let near = passed.unwrap_or_else(|e| panic!("w = {w}, -{off}: {e}")).pressure.unwrap();
            let mean = Wave::new(at * (1.0 - off), w, l).load() / (2.0 * l);
            assert!(near.value > 0.0 && near.value * mean < 10.0 * off, "{near:?}");

            let eps = at * (1.0 + off);
            let above = wavy(eps, w);
            let contact = Contact::new(&Flat, &*above).unwrap().single_interval(true);
            let contact = contact.edges(Edge::FreeUntil(-l), Edge::FreeUntil(l));
            let load = Control::Load(Wave::new(eps, w, l).load() * (1.0 + 1e-13));
            let error = contact.clone().certified(true).solve(load).unwrap_err();
            let ContactError::Solve(SolveError::Tension { x, pressure, .. }) = error else {
                panic!("{error}")
            };
            let [place, value] = lowest(eps);
            println!("w = {w}, ε (1 + {off:e}): {x} {pressure:e} for {place} {value:e}");
            assert!(
                (pressure - value).abs() < 1e-3 * value.abs() + 1e-13,
                "{value:e} {pressure:e}"
            );
            assert!((x.abs() - place).abs() < 1e-5 * l, "{x} for {place}");
            // The solution is still available without the certificate.
            assert!((contact.solve(load).unwrap().a() / l - 1.0).abs() < 1e-12);
        }
    }
}

#[test]
fn overlap_beside_a_wave_on_both_sides_of_the_margin() {
    // A contact on the crest of the wave at zero would not do: it lies in the middle of a trough,
    // and the next crest comes closer as the amplitude grows.
    let (w, l) = (16.0, 0.380_560_682_395_248_3);
    let deepest = |eps: f64| {
        let wave = Wave::new(eps, w, l);
        least(|x| wave.gap(x), l + 0.02, 1.0)
    };
    let at = margin(|eps| deepest(eps)[1], 1e-3, 0.0156);
    for off in [1e-2, 1e-4, 1e-6] {
        for sign in [-1.0, 1.0] {
            let eps = at * (1.0 + sign * off);
            let body = wavy(eps, w);
            let contact = Contact::new(&Flat, &*body).unwrap();
            // It is one of three contacts under one load. If they overlap, the solver may see it
            // too.
            let contact = contact.single_interval(sign > 0.0);
            let plain = contact.solve(Control::HalfWidth(l)).unwrap();
            assert!((plain.load() / Wave::new(eps, w, l).load() - 1.0).abs() < 1e-12);
            let [place, value] = deepest(eps);
            match plain.certify() {
                Ok(certificate) => {
                    assert!(sign < 0.0, "passes with {value:e} at {place}");
                    let near = certificate.gap.expect("it comes near");
                    assert!(
                        (near.value - value).abs() < 1e-3 * value + 1e-12,
                        "{near:?} {value:e}"
                    );
                    assert!((near.x.abs() - place).abs() < 1e-5, "{near:?} for {place}");
                }
                Err(ContactError::Solve(SolveError::Overlap { x, gap, .. })) => {
                    assert!(sign > 0.0, "refused with {value:e} at {place}");
                    println!("ε (1 + {off:e}): {x} {gap:e} for {place} {value:e}");
                    assert!((gap - value).abs() < 1e-3 * value.abs() + 1e-12, "{gap:e} {value:e}");
                    assert!((x.abs() - place).abs() < 1e-5, "{x} for {place}");
                }
                Err(error) => panic!("{error}"),
            }
        }
    }
}

#[test]
fn a_narrow_asperity_far_away() {
    // Hertz with L = 0.2, whose gap outside is L²/2 (cosh t sinh t - t) for x = L cosh t, and a
    // bump of 8e-4 of the domain just high enough to touch.
    let gap = |x: f64| {
        let t = (x / 0.2).acosh();
        0.02 * (t.cosh() * t.sinh() - t)
    };
    let (load, domain) = (Control::Load(0.02), 20.0);
    for (at, width) in
        [(7.123_456_7, 8e-4 * domain), (-3.3, 8e-4 * domain), (0.2345, 1e-3), (9.99, 0.015)]
    {
        // The gap between the bump and the flat rises over the bump: place of the least gap, and
        // height at which the bump touches.
        let shape = move |x: f64| {
            let s = (x - at) / (width / 2.0);
            if s.abs() < 1.0 { (1.0 - s * s).powi(4) } else { 0.0 }
        };
        let least_with = |height: f64| {
            least(|x: f64| gap(x.abs()) - height * shape(x), at - width / 2.0, at + width / 2.0)
        };
        let height = margin(|height| least_with(height)[1], 1e-9, 100.0);
        for off in [-1e-6, 1e-6] {
            let high = height * (1.0 + off);
            let body = graph(-10.0, 10.0, move |x| {
                let s = (x - at) / (width / 2.0);
                let slope = if s.abs() < 1.0 {
                    -8.0 * s * (1.0 - s * s).powi(3) / (width / 2.0)
                } else {
                    0.0
                };
                [x * x / 2.0 - high * shape(x), x - high * slope]
            });
            let contact = Contact::new(&Flat, &*body).unwrap();
            let solution = contact.solve(load).unwrap();
            assert!((solution.a() - 0.2).abs() < 1e-14);
            let [place, value] = least_with(high);
            let found = solution.certify();
            println!("at {at}, {off:e}: {found:?} for {place} {value:e}");
            let near = match found {
                Ok(certificate) if off < 0.0 => certificate.gap.unwrap(),
                Err(ContactError::Solve(SolveError::Overlap { x, gap: value, .. }))
                    if off > 0.0 =>
                {
                    Extremum { x, value }
                }
                other => panic!("{off}: {other:?}, for {place} {value:e}"),
            };
            assert!((near.value - value).abs() < 1e-2 * value.abs(), "{near:?} {value:e}");
            assert!((near.x - place).abs() < 1e-2 * width, "{near:?} for {place}");
        }
    }
}

#[test]
fn an_asperity_on_both_sides_of_the_margin() {
    // x²/2 - A exp(-64 (x - 8/5)²) under C = 3/2: a Hertz contact, to 1e-10, and its gap outside.
    let load = Control::Load(1.5 / PI);
    let l = (3.0 / PI).sqrt();
    let bump = |x: f64| (-64.0 * (x - 1.6) * (x - 1.6)).exp();
    let deepest = |height: f64| {
        let gap = |x: f64| {
            let t = (x / l).acosh();
            l * l / 2.0 * (t.cosh() * t.sinh() - t) - height * (bump(x) - bump(l))
        };
        least(gap, 1.3, 1.9)
    };
    let at = margin(|height| deepest(height)[1], 0.1, 0.625);
    for off in [-1e-2, -1e-4, -1e-6, 1e-6, 1e-4, 1e-2] {
        let height = at * (1.0 + off);
        let body = graph(-3.0, 3.0, move |x| {
            let bump = height * bump(x);
            [x * x / 2.0 - bump, x + 128.0 * (x - 1.6) * bump]
        });
        let contact = Contact::new(&Flat, &*body).unwrap().single_interval(true);
        let [place, value] = deepest(height);
        let found = contact.solve(load).unwrap().certify();
        println!("A (1 + {off:e}): {found:?} for {place} {value:e}");
        let near = match found {
            Ok(certificate) if off < 0.0 => certificate.gap.unwrap(),
            Err(ContactError::Solve(SolveError::Overlap { x, gap: value, .. })) if off > 0.0 => {
                Extremum { x, value }
            }
            other => panic!("{off}: {other:?}, for {place} {value:e}"),
        };
        assert!((near.value - value).abs() < 1e-3 * value.abs() + 1e-9, "{near:?} {value:e}");
        assert!((near.x - place).abs() < 1e-5, "{near:?} for {place}");
    }
}

/// Asperities of the least promised width, anywhere, and far higher than the gap: found in a short
/// time.
#[test]
fn tall_narrow_asperities() {
    let start = std::time::Instant::now();
    let width = 20.0 / 400.0 / 4.0;
    for i in 0..60 {
        // Unrelated places.
        let at = 0.5 + 9.4 * (0.618_033_988_75 * f64::from(i)).fract();
        let at = if i % 2 == 0 { at } else { -at };
        let body = graph(-10.0, 10.0, move |x| {
            let s = (x - at) / (width / 2.0);
            let [bump, slope] = if s.abs() < 1.0 {
                [(1.0 - s * s).powi(4), -8.0 * s * (1.0 - s * s).powi(3) / (width / 2.0)]
            } else {
                [0.0; 2]
            };
            [x * x / 2.0 - 0.75 * at * at * bump, x - 0.75 * at * at * slope]
        });
        let contact = Contact::new(&Flat, &*body).unwrap();
        let found = contact.solve(Control::Load(0.02)).unwrap().certify();
        let Err(ContactError::Solve(SolveError::Overlap { x, .. })) = found else {
            panic!("{at}: {found:?}")
        };
        assert!((x - at).abs() < width, "{at}: {found:?}");
    }
    // Seconds for each are too many.
    assert!(start.elapsed().as_secs() < 30, "{:?}", start.elapsed());
}

/// If an asperity touches to within rounding, either answer is right; the gap is zero to rounding.
#[test]
fn an_asperity_that_touches() {
    let l = (3.0 / PI).sqrt();
    let bump = |x: f64| (-64.0 * (x - 1.6) * (x - 1.6)).exp();
    let gap = |x: f64| {
        let t = (x / l).acosh();
        l * l / 2.0 * (t.cosh() * t.sinh() - t)
    };
    let at = least(|x| gap(x) / (bump(x) - bump(l)), 1.3, 1.9)[1];
    for off in [-1e-10, -1e-11, -1e-12, 0.0, 1e-12, 1e-11] {
        let height = at * (1.0 + off);
        let body = graph(-3.0, 3.0, move |x| {
            let bump = height * bump(x);
            [x * x / 2.0 - bump, x + 128.0 * (x - 1.6) * bump]
        });
        let contact = Contact::new(&Flat, &*body).unwrap();
        let solution = contact.solve(Control::Load(1.5 / PI)).unwrap();
        let near = match solution.certify() {
            // It touches, on less than 1e-5.
            Ok(_) if solution.intervals().len() == 2 => {
                let on = solution.intervals()[1];
                assert!(on.half_width() < 1e-5, "{off}: {on:?}");
                Extremum { x: on.centre(), value: 0.0 }
            }
            Ok(certificate) => certificate.gap.unwrap(),
            Err(ContactError::Solve(SolveError::Overlap { x, gap: value, .. })) => {
                Extremum { x, value }
            }
            Err(error) => panic!("{error}"),
        };
        assert!((near.x - 1.579_545_6).abs() < 1e-5 && near.value.abs() < 1e-10, "{off}: {near:?}");
    }
}

#[test]
fn a_budget_that_is_spent() {
    // Waves beyond the contact that no number of panels resolves.
    let body = graph(-3.0, 3.0, |x: f64| {
        let out = (x - 0.5).max(0.0).powi(4);
        [x * x / 2.0, x + out * (1e9 * x).sin()]
    });
    let contact = Contact::new(&Flat, &*body).unwrap();
    let solution = contact.solve(Control::Load(0.02)).unwrap();
    let error = solution.certify().map(|_| ()).unwrap_err();
    println!("{error}");
    let ContactError::Solve(SolveError::Undecided { x, evaluations, .. }) = error else {
        panic!("{error}")
    };
    assert!(x > 0.3 && evaluations < 1_300_000);
}

#[test]
fn kinks_and_edges_that_lift() {
    // A kink downwards parts the bodies, and one upwards does not; a gap narrower than the rounding
    // of x or of the heights is not told from none.
    for (slope, is_told) in [(1e-6, false), (1e-4, false), (0.03, false), (0.125, true)] {
        let kink = |s: f64| {
            join(vec![
                graph(-3.0, 0.0, move |x| [x * x / 2.0 + s * x, x + s]),
                graph(0.0, 3.0, move |x| [x * x / 2.0 - s * x, x - s]),
            ])
        };
        let solve = |body: &Profile| {
            let contact = Contact::new(&Flat, &**body)?.certified(true).single_interval(true);
            contact.solve(Control::Load(1.5 / PI))?.certify()
        };
        assert!(solve(&kink(-slope)).unwrap().is_proved());
        match solve(&kink(slope)) {
            Err(ContactError::Solve(SolveError::Tension { x, pressure, .. })) if is_told => {
                assert_eq!([x, pressure], [0.0, f64::NEG_INFINITY]);
            }
            Ok(proof) if !is_told => {
                let least = proof.pressure.unwrap();
                assert!([least.x, least.value] == [0.0; 2] && !proof.is_proved(), "{proof:?}");
            }
            other => panic!("{slope}: {other:?}"),
        }
    }
    // A tilted punch, F - m x: it lifts at the right edge once m l > F; beyond its corners there is
    // nothing to touch.
    for (m, lifts) in [(0.0, None), (3.9, None), (4.1, Some(0.5)), (-4.1, Some(-0.5))] {
        let body = graph(-1.0, 1.0, move |x| [m * x, m]);
        let contact = Contact::new(&Flat, &*body).unwrap();
        let contact = contact.edges(Edge::Fixed(-0.5), Edge::Fixed(0.5)).certified(true);
        let contact = contact.single_interval(true);
        match (contact.solve(Control::Load(2.0)), lifts) {
            (Ok(_), None) => {}
            (Err(ContactError::Solve(SolveError::Tension { x, pressure, .. })), Some(at)) => {
                assert_eq!([x, pressure], [at, f64::NEG_INFINITY]);
            }
            (other, _) => panic!("{m}: {other:?}"),
        }
    }
}

#[test]
fn corners_end_a_body() {
    // Beyond its corner the formula of the body continues and turns down; the body ends.
    let body = graph(-1.0, 2.0, |x: f64| [x * x / 2.0 - x.powi(4) / 4.0, x - x.powi(3)]);
    let contact = Contact::new(&Flat, &*body).unwrap();
    let load = Control::Load(0.01);
    let error = contact.solve(load).map(|_| ()).unwrap_err();
    // The gap is lowest at that end.
    assert!(
        matches!(
            error,
            ContactError::Solve(SolveError::DomainTooShort { end: 2.0, carried: 0.0, .. })
        ),
        "{error}"
    );
    let single = contact.clone().single_interval(true).certified(true);
    let error = single.solve(load).map(|_| ()).unwrap_err();
    assert!(
        matches!(error, ContactError::Solve(SolveError::Overlap { x, .. }) if x == 2.0),
        "{error}"
    );
    for corner in [0.1, 0.5] {
        let ends = contact.clone().edges(Edge::Free, Edge::FreeUntil(corner)).certified(true);
        ends.solve(load).unwrap_or_else(|error| panic!("{corner}: {error}"));
    }
    let fixed = contact.edges(Edge::Free, Edge::Fixed(0.1)).certified(true);
    fixed.solve(load).unwrap();
}

#[test]
fn solvers_and_other_quadratures() {
    let (good, bad) = (wavy(1.0 / 1024.0, 16.0), wavy(1.0 / 64.0, 16.0));
    let first = Contact::new(&Flat, &*good).unwrap().certified(true);
    // With several contacts it passes.
    let parted = Contact::new(&Flat, &*bad).unwrap().certified(true);
    let second = parted.clone().single_interval(true);
    let mut solver = Solver::new();
    let load = Control::Load(5.0 / 64.0 / PI);
    for _ in 0..2 {
        assert!(solver.solve(&first, load).is_ok());
        let error = solver.solve(&second, load).map(|_| ()).unwrap_err();
        assert!(matches!(error, ContactError::Solve(SolveError::Tension { .. })), "{error}");
        let solution = solver.solve(&parted, load).unwrap();
        assert!(solution.intervals().len() > 1, "{solution:?}");
    }
    let rule = Midpoint { segments: 256, ..Midpoint::default() };
    for one in [parted, second] {
        let error = one.quadrature(&rule).solve(load).map(|_| ()).unwrap_err();
        assert!(matches!(error, ContactError::Solve(SolveError::Tension { .. })), "{error}");
    }
    first.quadrature(&rule).solve(load).unwrap();
}

#[test]
fn closed_forms_are_contacts() {
    for Form { name, form, reach } in forms::<f64>() {
        let body = body(&*form, -reach, reach).unwrap_or_else(|e| panic!("{name}: {e}"));
        let [left, right] = form.edges();
        let contact = Contact::new(&Flat, &body).unwrap().kappa(KAPPA).edges(left, right);
        let contact = contact.single_interval(true);
        let solution = contact.solve(Control::Load(form.load(KAPPA))).unwrap();
        let found = solution.certify();
        if name == "cosine 0.7" {
            // The body ends in the trough of the wave, 0.3 from the edge: there the terms 2 J_k of
            // its slope leave a gap of 0.0411 - 0.0524.
            let error = found.unwrap_err();
            let ContactError::Solve(SolveError::Overlap { x, gap, .. }) = error else {
                panic!("{error}")
            };
            assert!((x.abs() - 1.0).abs() < 1e-12 && (gap + 0.0113).abs() < 1e-4, "{error}");
            continue;
        }
        let certificate = found.unwrap_or_else(|e| panic!("{name}: {e}"));
        println!("{name:24} {:?} {:?}", certificate.pressure, certificate.cost);
    }
}

#[test]
fn what_a_plain_certificate_takes() {
    // A convex gap: sampled over all of the bodies, and nothing else.
    let body = parabola(1.0);
    let contact = Contact::new(&Flat, &*body).unwrap();
    let solution = contact.solve(Control::Load(0.02)).unwrap();
    let certificate = solution.certify().unwrap();
    assert_eq!((certificate.pressure, certificate.gap), (None, None));
    println!("{certificate:?}");
    let bodies = [body, wavy(1.0 / 256.0, 24.0), wavy(1.0 / 1024.0, 16.0)];
    for body in &bodies {
        let contact = Contact::new(&Flat, &**body).unwrap();
        let start = std::time::Instant::now();
        let solution = contact.solve(Control::Load(0.7 / PI)).unwrap();
        let solved = start.elapsed();
        let found = solution.certify();
        println!("{solved:?}, with the certificate {:?}: {found:?}", start.elapsed());
    }
    assert!(certificate.cost.samples < 4_000, "{certificate:?}");
    // Narrower features, on request.
    let contact = Contact::new(&Flat, &*bodies[0]).unwrap().resolution(1e-4);
    let finer = contact.solve(Control::Load(0.02)).unwrap().certify().unwrap();
    assert_eq!(finer.spacing, 4e-4);
    // In f32 as well.
    let body =
        Curve::new([-1.0, 1.0], |k: f32| CurvePoint { x: k, y: k * k / 2.0, dx: 1.0, dy: k });
    let contact = Contact::new(&Flat, &body).unwrap().certified(true);
    contact.solve(Control::Load(0.02)).unwrap();
}

/// Least ratio and least gap of a proved contact are values, not doubts. A pressure that is
/// negative by no more than rounding is proved up to that.
#[test]
fn what_is_proved_and_what_hangs_on_rounding() {
    let two_feet = common::quartic(-2.0, 2.0);
    let contact = Contact::new(&Flat, &*two_feet).unwrap();
    let certificate = contact.solve(Control::Load(0.5)).unwrap().certify().unwrap();
    assert!(certificate.pressure.unwrap().value > 0.5 && certificate.is_proved(), "{certificate}");
    assert!(!certificate.to_string().contains("up to rounding"));

    // P is proportional to (L²/2 - 0.1 + x²) sqrt(L² - x²), at x = 0 less than zero by rounding.
    let hollow = graph(-1.0, 1.0, |x| [x.powi(4) / 4.0 - 0.05 * x * x, x.powi(3) - 0.1 * x]);
    let contact = Contact::new(&Flat, &*hollow).unwrap().single_interval(true);
    for (off, is_proved) in [(1e-3, true), (1e-9, true), (-1e-14, false)] {
        let half_width = f64::sqrt(2.0 * (0.1 + off));
        let solution = contact.solve(Control::HalfWidth(half_width)).unwrap();
        let certificate = solution.certify().unwrap();
        let text = certificate.to_string();
        assert_eq!(certificate.is_proved(), is_proved, "{off}: {certificate:?}");
        assert_eq!(text.contains(", up to rounding, in cells"), !is_proved, "{text}");
    }
}

#[test]
fn a_kink_that_nobody_declared() {
    for (s, parts) in [(1e-3, false), (0.125, true)] {
        let body = graph(-3.0, 3.0, move |x| [x * x / 2.0 - s * x.abs(), x - s * x.signum()]);
        let contact = Contact::new(&Flat, &*body).unwrap().single_interval(true);
        let found = contact.solve(Control::Load(1.5 / PI)).unwrap().certify();
        // The pressure at the slighter kink is negative only at distances below rounding.
        assert_eq!(
            matches!(found, Err(ContactError::Solve(SolveError::Tension { .. }))),
            parts,
            "{found:?}"
        );
    }
}

#[test]
fn a_jump_that_nobody_declared_is_no_overlap() {
    // The slope of the gap rises throughout. Next to the jump, panels are shorter than the rounding
    // of x at the edges.
    let (kink, jump) = (-1.0604356397670964, 0.1901019206798418);
    let upper = Curve::new([-4.205813929637161, 4.305901873322346], move |k: f64| {
        let (ramp, step) = ((-k - kink).max(0.0), (-k - jump).max(0.0));
        let (bent, steep) = (0.6037230083871006, 0.03352221083836538);
        let slope = bent * ramp + if -k > jump { steep } else { 0.0 } - 0.5189720051051511;
        let y = bent * ramp * ramp / 2.0 + steep * step + 0.5189720051051511 * k;
        CurvePoint { x: -k, y, dx: -1.0, dy: -slope }
    });
    let lower = graph(-4.305901873322346, 4.205813929637161, |x| {
        let (c, w, t) = (-0.6436923543907254, 0.3113539310659338, 0.7980676574954262);
        [c / w * (w * (x - t)).cosh(), c * (w * (x - t)).sinh()]
    });
    let contact = Contact::new(&*lower, &upper).unwrap();
    for half_width in [1.2, 1.4183818177577037, 1.6] {
        let solution = contact.solve(Control::HalfWidth(half_width)).unwrap();
        let found = solution.certify();
        assert!(found.is_ok(), "{half_width}: {found:?}");
    }
}

#[test]
fn a_corner_without_adhesion_bears_no_tension_beside_an_adhesive_edge() {
    let body = parabola(1.0);
    let edges = [Edge::Fixed(-0.1), Edge::Adhesive(1e-3)];
    let contact = Contact::new(&Flat, &*body).unwrap().edges(edges[0], edges[1]);
    let error = contact.solve(Control::Load(-0.005)).unwrap_err();
    assert!(matches!(error, ContactError::Solve(SolveError::LiftsOff { x: -0.1, .. })), "{error}");
    let contact = contact.single_interval(true);
    let found = contact.solve(Control::Load(-0.005)).unwrap().certify();
    assert!(
        matches!(found, Err(ContactError::Solve(SolveError::Tension { x: -0.1, .. }))),
        "{found:?}"
    );
    assert!(contact.solve(Control::Load(0.05)).unwrap().certify().is_ok());
}

/// A bump between two nodes, unseen by the panels, is not certified.
#[test]
fn what_the_panels_have_missed_is_not_certified() {
    let mut missed = 0;
    for i in 0..50 {
        let (at, wide) = (0.19 * (f64::from(i) + 0.5) / 50.0, 0.006);
        let body = graph(-1.0, 1.0, move |x| {
            let (y, dy) = (x * x / 2.0, x);
            let angle = PI * (x - at) / wide;
            if angle.abs() >= PI / 2.0 {
                return [y, dy];
            }
            let (sin, cos) = angle.sin_cos();
            let deep = 0.015;
            [y - deep * cos.powi(4), dy + deep * 4.0 * PI / wide * cos.powi(3) * sin]
        });
        let contact = Contact::new(&Flat, &*body).unwrap();
        let Ok(solution) = contact.solve(Control::Load(0.02)) else { continue };
        let unaware = (solution.a() - 0.2).abs() < 1e-12;
        match solution.certify() {
            Err(ContactError::Solve(SolveError::FeatureMissed { x, slope, assumed }))
                if unaware =>
            {
                missed += 1;
                assert!((x - at).abs() < wide / 2.0, "{x} {at}");
                assert!(
                    (assumed - x).abs() < 1e-9 && (slope - x).abs() > 1e-7,
                    "{slope} {assumed}"
                );
            }
            other => assert!(!unaware || other.is_err(), "{at}: {other:?}"),
        }
    }
    assert!(missed > 5, "{missed}");
}

/// A kink downwards far from x = 0, where an ulp of x is large: P tends to minus infinity at the
/// kink, and the error says so.
#[test]
fn a_kink_downwards_far_out() {
    let kink = |x: f64, s: f64| {
        let side = |from: f64, to: f64, s: f64| {
            graph(from, to, move |k: f64| [(k - x) * ((k - x) / 2.0 + s), k - x + s])
        };
        join(vec![side(x - 4.0, x, s), side(x, x + 4.0, -s)])
    };
    for (x, s) in [(700.0, 1.0 / 3.0), (-1e5, 0.2), (1e7, 0.3)] {
        let body = kink(x, s);
        let contact = Contact::new(&Flat, &*body).unwrap().single_interval(true);
        let error = contact.solve(Control::Load(1.0)).unwrap().certify().unwrap_err();
        let ContactError::Solve(SolveError::Tension { x: there, pressure, .. }) = error else {
            panic!("{error}")
        };
        assert!(there == x && pressure == f64::NEG_INFINITY, "{there} {pressure}");
    }
}

/// Returns x²/2 with one smooth rise of the slope, of width w and height s, at x₀.
pub fn risen(x0: f64, w: f64, s: f64) -> Profile {
    graph(-1.0, 1.0, move |x: f64| {
        let t = ((x - x0) / w).tanh();
        [x * x / 2.0 + s * w * t, x + s * (1.0 - t * t)]
    })
}

/// Returns the error of limits under a load, as a share of the half-width, from c₀ and c₁ with
/// enough points to resolve the rise.
fn limits_off(on: linecontact::Interval<f64>, load: f64, slope: impl Fn(f64) -> f64) -> f64 {
    let (n, c, l) = (20_000, on.centre(), on.half_width());
    let (mut m0, mut m1) = (0.0, 0.0);
    for i in 0..n {
        let cos = (PI * (f64::from(i) + 0.5) / f64::from(n)).cos();
        let g = slope(c + l * cos) / f64::from(n);
        (m0, m1) = (m0 + g, m1 + g * cos);
    }
    (m0.abs() + (load / l - m1).abs()) / l
}

/// Bumps that the panels of the solver may have missed, but not those of the certificate: no limits
/// are certified whose error exceeds their estimate.
#[test]
fn limits_that_are_off_are_not_certified() {
    let load = 0.02;
    let (mut wrong, mut certified) = (0, 0);
    let mut scenes = Vec::new();
    let share = |i: usize, step: f64| (step * (i as f64 + 0.5)).fract();
    for tolerance in [0.0, 1e-6, 1e-4, 1e-3] {
        for i in 0..100 {
            let x0 = 0.19 * (2.0 * share(i, 0.618_033_988_75) - 1.0);
            let w = 1e-3 * 40f64.powf(share(i, 0.754_877_666_2));
            let s = 3e-4 * 60f64.powf(share(i, 0.569_840_291));
            scenes.push((x0, w, s, tolerance));
        }
    }
    for (x0, w, s, tolerance) in scenes {
        let body = risen(x0, w, s);
        let panels = linecontact::Panels { tolerance };
        let contact = Contact::new(&Flat, &*body).unwrap().quadrature(&panels);
        let Ok(solution) = contact.solve(Control::Load(load)) else { continue };
        if solution.certify().is_err() {
            continue;
        }
        certified += 1;
        let slope = |x: f64| x + s * (1.0 - ((x - x0) / w).tanh().powi(2));
        let off = limits_off(solution.hull(), load, slope);
        if off > 10.0 * solution.limits_error().unwrap() + tolerance + 1e-13 {
            println!("{x0} {w} {s} {tolerance}: {off:e} {:?}", solution.limits_error());
            wrong += 1;
        }
    }
    println!("{wrong} of {certified}");
    assert!(wrong == 0 && certified > 50, "{wrong} of {certified}");
}

/// A body that changes between evaluations, as one with interior mutability may.
#[test]
fn a_body_that_has_changed_is_not_certified() {
    let half = std::sync::atomic::AtomicBool::new(false);
    let body = Curve::new([-1.0, 1.0], |k: f64| {
        let scale = if half.load(std::sync::atomic::Ordering::Relaxed) { 0.25 } else { 1.0 };
        CurvePoint { x: k, y: scale * k * k / 2.0, dx: 1.0, dy: scale * k }
    });
    let contact = Contact::new(&Flat, &body).unwrap();
    for midpoint in [false, true] {
        half.store(false, std::sync::atomic::Ordering::Relaxed);
        let rule = Midpoint::default();
        let contact = if midpoint { contact.clone().quadrature(&rule) } else { contact.clone() };
        let solution = contact.solve(Control::Load(0.02)).unwrap();
        solution.certify().unwrap();
        half.store(true, std::sync::atomic::Ordering::Relaxed);
        match solution.certify() {
            Err(ContactError::Solve(SolveError::FeatureMissed { .. })) if !midpoint => {}
            // F/L - m₁ = (1 - 1/4) L/2, divided by π.
            Err(ContactError::Solve(SolveError::Unbalanced { strength, allowed, .. }))
                if midpoint =>
            {
                assert!((strength * PI / 0.075 - 1.0).abs() < 1e-6, "{strength}");
                assert!(allowed < 1e-6, "{allowed}");
            }
            other => panic!("{midpoint}: {other:?}"),
        }
    }
}

#[test]
fn heights_that_are_no_numbers_are_not_certified() {
    for (from, to) in [(-1.0, 1.0), (0.19, 0.21), (-0.001, 0.001)] {
        let body = Curve::new([-1.0, 1.0], move |k: f64| {
            let y = if k >= from && k <= to { f64::NAN } else { k * k / 2.0 };
            CurvePoint { x: k, y, dx: 1.0, dy: k }
        });
        let contact = Contact::new(&Flat, &body).unwrap().certified(true);
        let error = contact.solve(Control::Load(0.02)).map(|_| ()).unwrap_err();
        let ContactError::Input(InputError::Profile { source, .. }) = error else {
            panic!("{error}")
        };
        let linecontact::ProfileError::NotFinite { quantity: "Y", k, .. } = source else {
            panic!("{source}")
        };
        assert!(k >= from && k <= to, "{k}");
    }
}

/// Undeclared kinks, next to an edge and elsewhere, also between the last nodes of two cells, where
/// neither cell sees them. The limits are right, and are certified.
#[test]
fn a_kink_between_two_cells_is_no_doubt_of_the_limits() {
    let mut found = 0;
    for (half_width, from, step) in [(1e-5, -1.05, 1.3e-3), (0.2, -0.4, 1.13e-3)] {
        for i in 0..150 {
            let s = 0.3 + half_width * (from + step * f64::from(i));
            let slope = move |x: f64| {
                let [t, more] = [x - 0.3, (x - s).max(0.0)];
                [t * t / 2.0 + more * more / 2.0, t + more]
            };
            let body = graph(-4.0, 4.2, slope);
            let contact = Contact::new(&Flat, &*body).unwrap();
            let solution = contact.solve(Control::HalfWidth(half_width)).unwrap();
            let certified = solution.certify();
            assert!(certified.is_ok(), "{s}: {:?}", certified.err());
            found += 1;
        }
    }
    assert_eq!(found, 300);
}

/// A narrow step of the body, up or down, between two nodes of the solver: the heights show it, and
/// it is resolved.
#[test]
fn a_step_between_two_nodes_is_resolved() {
    for sign in [1.0, -1.0] {
        for i in 0..50 {
            let (at, wide) = (0.19 * (f64::from(i) + 0.5) / 50.0, 0.006);
            // The slope rises by h cos⁴, and so the height by h (3 t/8 + sin(2t)/4 + sin(4t)/32).
            let body = graph(-1.0, 1.0, move |x| {
                let turn = PI / wide;
                let t = (turn * (x - at)).clamp(-PI / 2.0, PI / 2.0);
                let rise = 0.375 * t + (2.0 * t).sin() / 4.0 + (4.0 * t).sin() / 32.0;
                let high = sign * 0.01;
                [x * x / 2.0 + high * rise / turn, x + high * t.cos().powi(4)]
            });
            let contact = Contact::new(&Flat, &*body).unwrap();
            let solution = contact.solve(Control::Load(0.02)).unwrap();
            let certified = solution.certify();
            assert!(certified.is_ok(), "{sign} {at}: {:?}", certified.err());
        }
    }
}
