//! Gaps that are not convex, with contacts in any number of places: the contacts must not pull nor
//! overlap, and must carry the load.
//!
//! The gap of the loaded bodies is computed here, from the pressures alone. Over one contact, with
//! `s = c + L cos θ`, the function `P L sin θ` is a cosine series, and
//!
//! ```text
//! ∫ cos kθ ln|z - cos θ| dθ = -(π/k) cos kφ for z = cos φ,  -(π/k) exp(-kξ) for z = ±cosh ξ
//! ```
//!
//! with `-π ln 2` and `π (ξ - ln 2)` for k = 0.

use super::Rng;
use super::oracle::{Term, sum};
use super::scene::body;
use linecontact::{Contact, Control, Cost, Edge, Interval};
use std::f64::consts::{LN_2, PI};

/// Number of terms of a cosine series.
const TERMS: usize = 192;
/// Largest tension ascribed to rounding, as a share of the peak.
const TENSION: f64 = 1e-9;
/// Largest error of the gap, as a share of the heights and displacements.
const GAP: f64 = 1e-7;

#[derive(Debug)]
struct Scene {
    upper: Vec<Term>,
    lower: Vec<Term>,
    ends: [f64; 2],
    parameters: [usize; 2],
    corners: bool,
    kappa: f64,
    load: f64,
}

impl Scene {
    fn new(rng: &mut Rng) -> Self {
        let bend = rng.scale(0.1, 10.0);
        let mut terms = vec![Term::Line(bend, rng.between(-0.5, 0.5))];
        for _ in 0..1 + rng.below(6) {
            // Up to three times the largest wave for which the gap stays convex.
            let k = rng.scale(2.0, 60.0);
            terms.push(Term::Wave(bend / k * rng.scale(0.1, 3.0), k));
        }
        if rng.chance(0.3) {
            let x = rng.between(-1.0, 1.0);
            terms.push(Term::Jump(bend * rng.between(-0.3, 0.3), x));
        }
        let corners = rng.chance(0.2);
        let width = if corners { rng.between(0.3, 1.0) } else { rng.between(4.0, 5.0) };
        let kappa = if rng.chance(0.5) { 1.0 } else { rng.scale(1e-6, 1e6) };
        // A parabola of this curvature has a half-width from 1e-3 to 1.
        let load = 0.5 * kappa * bend * rng.scale(1e-6, 1.0);
        let (mut upper, mut lower) = (Vec::new(), Vec::new());
        for term in terms {
            if rng.chance(0.8) { upper.push(term) } else { lower.push(term.negated()) }
        }
        let parameters = [rng.below(3), rng.below(3)];
        Self { upper, lower, ends: [-width, width], parameters, corners, kappa, load }
    }

    /// Returns κ times the height of the gap before it is loaded.
    fn height(&self, x: f64) -> f64 {
        self.kappa * (sum(&self.upper, x, true)[0] - sum(&self.lower, x, true)[0])
    }
}

/// Pressure over a contact as a cosine series of `P L sin θ`.
struct Series {
    on: Interval<f64>,
    terms: Vec<f64>,
}

impl Series {
    fn new(
        on: Interval<f64>,
        pressure: impl Fn(f64) -> Result<f64, String>,
    ) -> Result<Self, String> {
        let angle = |i: usize| (i as f64 + 0.5) / TERMS as f64 * PI;
        let values: Result<Vec<f64>, String> = (0..TERMS)
            .map(|i| Ok(pressure(on.at_angle(angle(i)))? * on.half_width() * angle(i).sin()))
            .collect();
        let (values, share) = (values?, 2.0 / TERMS as f64);
        let term = |k: usize| {
            let sum: f64 =
                values.iter().enumerate().map(|(i, v)| v * (k as f64 * angle(i)).cos()).sum();
            if k == 0 { 0.5 * share * sum } else { share * sum }
        };
        Ok(Self { on, terms: (0..TERMS).map(term).collect() })
    }

    fn load(&self) -> f64 {
        PI * self.terms[0]
    }

    /// Returns `∫ P(s) ln|x - s| ds`.
    fn logarithm(&self, x: f64) -> f64 {
        let z = (x - self.on.centre()) / self.on.half_width();
        let inside = z.abs() <= 1.0;
        let angle = if inside { z.acos() } else { z.abs().acosh() };
        let sign = if z < 0.0 { -1.0f64 } else { 1.0 };
        let zeroth = if inside { -LN_2 } else { angle - LN_2 } + self.on.half_width().ln();
        let mut sum = PI * zeroth * self.terms[0];
        for (k, term) in self.terms.iter().enumerate().skip(1) {
            let order = k as f64;
            let value = if inside {
                (order * angle).cos()
            } else {
                sign.powi(k as i32) * (-order * angle).exp()
            };
            sum -= PI / order * term * value;
        }
        sum
    }

    /// Returns a bound on the sum of the terms left out.
    fn error(&self) -> f64 {
        let last = self.terms.iter().enumerate().skip(TERMS / 2);
        8.0 * last.map(|(k, term)| PI / k as f64 * term.abs()).sum::<f64>()
    }
}

/// Tells whether there was a contact; an error names the fault.
pub fn run(mut rng: Rng) -> Result<bool, String> {
    let scene = Scene::new(&mut rng);
    check(&scene, &mut rng).map_err(|finding| format!("{finding} | {scene:?}"))
}

fn check(scene: &Scene, rng: &mut Rng) -> Result<bool, String> {
    let [of_upper, of_lower] = scene.parameters;
    let upper = body(&scene.upper, scene.ends, true, of_upper);
    let lower = body(&scene.lower, scene.ends, true, of_lower);
    let of = |error: linecontact::ContactError<f64>| format!("refused: {error}");
    let mut contact = Contact::new(&*lower, &*upper).map_err(of)?.kappa(scene.kappa);
    if scene.corners {
        let [left, right] = scene.ends.map(Edge::FreeUntil);
        contact = contact.edges(left, right);
    }
    let solution = contact.solve(Control::Load(scene.load)).map_err(of)?;
    let (contacts, pressure) = (solution.intervals(), solution.pressure().map_err(of)?);
    if contacts.windows(2).any(|two| two[0].right >= two[1].left) {
        return Err(format!("intervals: {contacts:?}"));
    }
    let at = |x: f64| Ok(pressure.estimate(x, &mut Cost::default()).map_err(of)?.value);

    let series: Result<Vec<Series>, String> =
        contacts.iter().map(|&on| Series::new(on, at)).collect();
    let series = series?;
    let load: f64 = series.iter().map(Series::load).sum();
    let off = (load / scene.load - 1.0).abs();
    let error = series.iter().map(Series::error).sum::<f64>();
    if off.is_nan() || off > GAP + error / scene.load {
        return Err(format!("load: off by {off:.1e}, with {} contacts", contacts.len()));
    }

    // At the nodes of the series, and next to breakpoints, where the pressure may be singular.
    let all: Vec<Term> = scene.upper.iter().chain(&scene.lower).copied().collect();
    let breakpoints: Vec<f64> = all.iter().filter_map(Term::breakpoint).collect();
    let (mut peak, mut least) = (0.0f64, [f64::INFINITY, f64::NAN]);
    let aside = |breakpoint: f64| {
        (1..12).flat_map(move |i| [breakpoint - 0.1f64.powi(i), breakpoint + 0.1f64.powi(i)])
    };
    for on in contacts {
        let evenly = (1..128).map(|i| on.at_angle(PI * f64::from(i) / 128.0));
        let near = breakpoints
            .iter()
            .flat_map(|&breakpoint| aside(breakpoint))
            .filter(|&x| on.contains(x));
        for x in evenly.chain(near) {
            let p: f64 = at(x)?;
            peak = peak.max(p);
            if p.is_nan() || p < least[0] {
                least = [p, x];
            }
        }
    }
    if least[0].is_nan() || least[0] < -TENSION * peak {
        return Err(format!("tension: {:.1e} of the peak at {}", least[0] / peak, least[1]));
    }

    // The gap must be level in the contacts, and nowhere lower.
    let (mut outside, [from, to]) = (Vec::new(), scene.ends);
    outside.extend((0..200).map(|_| rng.between(from, to)));
    for two in contacts.windows(2) {
        let (left, width) = (two[0].right, two[1].left - two[0].right);
        outside.extend((0..20).map(|_| left + width * rng.share()));
    }
    let gap = |x: f64| {
        let bent: f64 = series.iter().map(|series| series.logarithm(x)).sum();
        (scene.height(x) - bent, scene.height(x).abs() + bent.abs())
    };
    let (level, size) = gap(contacts[0].centre());
    for on in contacts {
        for i in 1..8 {
            let x = on.at_angle(PI * f64::from(i) / 8.0);
            let (height, here) = gap(x);
            let off = (height - level).abs();
            if off.is_nan() || off > GAP * size.max(here) + error {
                return Err(format!("level: off by {:.1e} at {x} in {on:?}", off / size));
            }
        }
    }
    for x in outside {
        let (height, here) = gap(x);
        let free = !contacts.iter().any(|on| on.contains(x));
        let over = level - height;
        if free && (over.is_nan() || over > GAP * size.max(here) + error) {
            return Err(format!(
                "overlap: {:.1e} at {x}, outside {contacts:?}",
                (level - height) / size
            ));
        }
    }
    Ok(true)
}
