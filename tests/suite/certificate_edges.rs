//! Adhesive edges and corners: gap outside, stress below, and rates of the limits.
#![allow(missing_docs)]

use crate::common::{NanSafe, Shares, graph, parabola, worst};
use crate::forms::KAPPA;
use linecontact::{Contact, ContactError, Control, Edge, Flat, Solution, SolveError};
use std::f64::consts::PI;

#[test]
fn the_free_limit_beside_a_corner_moves_as_in_closed_form() {
    // With an edge held at distance e from the middle F = κ L (3 L/2 - e): the other limit moves by
    // 2/(κ (3 L - e)). Turned by a slope m, the middle of the parabola lies at -m.
    let body = |m: f64| graph(-2.0, 2.0, move |x| [x * x / 2.0 + m * x, x + m]);
    for tilt in [0.0, 0.07, -0.05] {
        for load in [0.05, 0.2, 0.6] {
            for right in [false, true] {
                let upper = body(tilt);
                let (corner, free) = (Edge::Fixed(if right { 0.2 } else { -0.2 }), Edge::Free);
                let [left, right_edge] = if right { [free, corner] } else { [corner, free] };
                let contact = Contact::new(&Flat, &*upper).unwrap().kappa(KAPPA);
                let contact = contact.edges(left, right_edge);
                let solution = contact.solve(Control::Load(load * KAPPA)).unwrap();
                let rates = solution.load_rates().unwrap();
                let half_width = solution.hull().half_width();
                // From the middle of the parabola.
                let e = if right { 0.2 + tilt } else { 0.2 - tilt };
                let force = KAPPA * half_width * (1.5 * half_width - e);
                assert!((force / (load * KAPPA) - 1.0).abs() < 1e-14, "{tilt} {load} {right}");
                let exact = 2.0 / (KAPPA * (3.0 * half_width - e));
                let [held, moves] = if right { [rates.a, rates.b] } else { [rates.b, rates.a] };
                assert_eq!(held, 0.0);
                assert!((moves / exact - 1.0).abs() < 1e-13, "{tilt} {load}: {moves} {exact}");
            }
        }
    }
}

/// Parabola of radius 1 and its gap outside the contact, both edges of the same strength: P = (κ/π)
/// root - A/root with A = (κ L²/2 - F)/π, root² = L² - x².
struct Parabola {
    half_width: f64,
    /// Adhesion π A/κ.
    pull: f64,
}

impl Parabola {
    fn of(solution: &Solution<f64>) -> Self {
        let half_width = solution.hull().half_width();
        let pull = half_width * half_width / 2.0 - solution.load() / KAPPA;
        Self { half_width, pull }
    }
    fn gap(&self, x: f64) -> f64 {
        let (x, l) = (x.abs(), self.half_width);
        let (root, area) = ((x * x - l * l).sqrt(), (x / l).acosh());
        0.5 * (x * root - l * l * area) + self.pull * area
    }
    fn slope(&self, x: f64) -> f64 {
        let root = (x * x - self.half_width * self.half_width).sqrt();
        (root + self.pull / root).copysign(x)
    }
    /// Returns σ_x and σ_y below the middle: -(2 y/π) ∫ P s²/(s² + y²)² ds, -(2 y³/π) ∫ P/(s² +
    /// y²)² ds.
    fn stress(&self, y: f64) -> [f64; 2] {
        let l = self.half_width;
        let r = l.hypot(y);
        let elliptic =
            [(l * l + 2.0 * y * y) / r - 2.0 * y, l * l / r].map(|part| -KAPPA / PI * part);
        // ∫ ds/((s² + y²) root) = π/(y r).
        let strength = self.pull * KAPPA / PI;
        let flat_y = -(l * l + 2.0 * y * y) / r.powi(3);
        let flat_x = -(l * l) / r.powi(3);
        [elliptic[0] - strength * flat_x, elliptic[1] - strength * flat_y]
    }
}

#[test]
fn the_gap_and_the_stress_beside_adhesive_edges() {
    let body = parabola(2.0);
    for (work, load) in [(1e-3, 0.1), (0.02, 0.0), (0.05, -0.05), (1e-6, 0.4)] {
        let contact = Contact::new(&Flat, &*body).unwrap().kappa(KAPPA);
        let contact = contact.edges(Edge::Adhesive(work), Edge::Adhesive(work));
        let solution = contact.solve(Control::Load(load)).unwrap();
        let exact = Parabola::of(&solution);
        let l = exact.half_width;
        let beside = [1e-9, 1e-4, 0.1, 0.5, 1.5].into_iter().flat_map(|d| [l + d, -l - d]);
        let beside: Vec<f64> = beside.filter(|x| x.abs() < 2.0).collect();
        // Rounding of the heights and of the limits, which is magnified next to an edge; very close
        // to an edge also the integral over the pressure: 1e-12 of its size.
        let gaps = worst(beside.iter().map(|&x| {
            let rounding = 8.0 * f64::EPSILON * (exact.slope(x).abs() * l + x * x + l * l);
            let close = if x.abs() - l < 1e-6 { 2e-12 * l * l } else { 0.0 };
            (solution.gap_at(x).unwrap() - exact.gap(x)).abs()
                / (2e-12 * exact.gap(x) + rounding + close)
        }));
        let slopes = worst(beside.iter().map(|&x| {
            let rounding = f64::EPSILON / (x.abs() - l);
            let off = solution.gap_slope(x).unwrap() / exact.slope(x) - 1.0;
            off.abs() / (1.0 + rounding / 1e-12)
        }));
        let field = solution.subsurface().unwrap();
        let peak = KAPPA / PI * l;
        let stresses = worst([1e-3, 0.1, 0.5, 0.786, 2.0, 10.0].into_iter().map(|share| {
            let y = share * l;
            let (got, want) = (field.at(0.0, y).unwrap(), exact.stress(y));
            let off = (got.sigma_x - want[0]).abs().nan_max((got.sigma_y - want[1]).abs());
            off / (peak + exact.pull * KAPPA / l)
        }));
        println!(
            "{work} {load}: gap {gaps:.2} of what is allowed, slope {slopes:.1e}, stress {stresses:.1e}"
        );
        assert!(gaps < 1.0 && slopes < 1e-12 && stresses < 1e-14, "{work} {load}");
    }
}

/// Returns x²/2 from one end to another, less a hump on either side.
fn humped(ends: [f64; 2], humps: [[f64; 3]; 2]) -> crate::common::Profile {
    graph(ends[0], ends[1], move |x| {
        let hump = |[height, at, width]: [f64; 3]| {
            let z = (x - at) / width;
            let value = height * (-z * z).exp();
            [-value, 2.0 * z / width * value]
        };
        let [one, two] = humps.map(hump);
        [x * x / 2.0 + one[0] + two[0], x + one[1] + two[1]]
    })
}

/// Returns the number of certified scenes, and of those with a least gap.
fn least_gaps(seed: u64, edges: [bool; 2], corners: [bool; 2]) -> [usize; 2] {
    let (mut shares, mut certified, mut with_gap) = (Shares(seed), 0, 0);
    for scene in 0..30 {
        let corner = shares.between(0.1, 0.3);
        let side = |sign: f64, shares: &mut Shares| {
            let (at, width) = (shares.between(0.8, 1.5), shares.between(0.1, 0.3));
            [shares.between(0.1, 0.6) * at * at, sign * at, width]
        };
        let humps = [side(-1.0, &mut shares), side(1.0, &mut shares)];
        let work = shares.between(0.1, 1.0) * 0.01;
        let load = shares.between(0.02, 0.25);
        let edge = |i: usize, sign: f64| match (corners[i], edges[i]) {
            (true, _) => Edge::Fixed(sign * corner),
            (_, true) => Edge::Adhesive(work),
            _ => Edge::Free,
        };
        let end = |i: usize, sign: f64| sign * if corners[i] { corner } else { 2.0 };
        let body = humped([end(0, -1.0), end(1, 1.0)], humps);
        let contact = Contact::new(&Flat, &*body).unwrap().kappa(KAPPA).single_interval(true);
        let start = linecontact::Interval { left: -corner, right: corner };
        let contact = contact.edges(edge(0, -1.0), edge(1, 1.0)).start(start);
        let Ok(solution) = contact.solve(Control::Load(load)) else { continue };
        let near = match solution.certify() {
            Ok(certificate) => {
                certified += 1;
                let Some(near) = certificate.gap else { continue };
                with_gap += 1;
                [near.x, near.value]
            }
            Err(ContactError::Solve(SolveError::Overlap { x, gap, .. })) => [x, gap],
            Err(_) => continue,
        };
        let size = solution.hull().half_width().powi(2);
        let known = solution.gap_at(near[0]).unwrap();
        assert!(
            (near[1] - known).abs() < 1e-9 * size + 1e-7 * known.abs(),
            "{scene}: {near:?} {known}"
        );
        // There is no lower gap beyond which the bodies part again.
        for (i, sign) in [(0, -1.0), (1, 1.0)] {
            if corners[i] {
                continue;
            }
            let edge = if i == 0 { solution.hull().left } else { solution.hull().right };
            let x = |step: i32| edge + f64::from(step) / 40.0 * (sign * 2.0 - edge);
            let gaps: Vec<f64> = (1..=39).map(|step| solution.gap_at(x(step)).unwrap()).collect();
            for three in gaps.windows(3) {
                let turns = three[1] < three[0] && three[1] <= three[2];
                assert!(
                    !turns || three[1] > near[1] - 1e-9 * size,
                    "{scene}: {near:?}, but {three:?}"
                );
            }
        }
    }
    [certified, with_gap]
}

#[test]
fn certified_gaps_are_those_of_the_pressure() {
    let (no, yes) = (false, true);
    for (seed, adhesive, corners, at_least) in [
        (1, [yes, yes], [no, no], 5),
        (2, [yes, no], [no, no], 5),
        (3, [no, yes], [no, no], 5),
        (4, [no, no], [yes, no], 5),
        (5, [no, no], [no, yes], 5),
        (6, [yes, yes], [yes, no], 5),
        (7, [yes, yes], [no, yes], 5),
    ] {
        let [certified, with_gap] = least_gaps(seed, adhesive, corners);
        println!("{adhesive:?} {corners:?}: {certified} certified, {with_gap} with a least gap");
        assert!(with_gap >= at_least, "{adhesive:?} {corners:?}: {with_gap}");
    }
}

#[test]
fn slight_bumps_between_the_nodes_are_not_certified() {
    // A bump of the slope, about 3e-4 of the largest slope: too narrow for the panels, too slight
    // for tension.
    let plain = parabola(1.0);
    let cost = |body: &dyn linecontact::ParametricProfile<f64>| {
        let contact = Contact::new(&Flat, body).unwrap();
        contact.solve(Control::Load(0.08)).unwrap().cost().evaluations
    };
    let usual = cost(&*plain);
    let (mut shares, mut unseen) = (Shares(26), 0);
    for scene in 0..60 {
        let (at, width) = (shares.between(-0.35, 0.35), shares.between(1e-3, 3e-3));
        let size = 10f64.powf(shares.between(-4.5, -3.5));
        let body = graph(-1.0, 1.0, move |x: f64| {
            let t = ((x - at) / width).clamp(-1.0, 1.0);
            let area = t - 2.0 / 3.0 * t.powi(3) + t.powi(5) / 5.0;
            [x * x / 2.0 + size * width * area, x + size * (1.0 - t * t).powi(2)]
        });
        if cost(&*body) != usual {
            continue;
        }
        unseen += 1;
        let contact = Contact::new(&Flat, &*body).unwrap();
        let certificate = contact.solve(Control::Load(0.08)).unwrap().certify();
        assert!(
            matches!(
                certificate,
                Err(ContactError::Solve(SolveError::FeatureMissed { x, .. }))
                    if (x - at).abs() < width
            ),
            "{scene}: {size:e} at {at}, {width}: {certificate:?}"
        );
    }
    assert!(unseen > 30, "{unseen}");
}
