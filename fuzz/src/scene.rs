//! A convex gap whose contact is known beforehand, solved in a random way.

use super::Rng;
use super::oracle::{On, Term, sum};
use linecontact::search::Brent;
use linecontact::{
    Contact, Control, Cost, Curve, CurvePoint, Edge, Exponents, Flat, Interval, Midpoint, Panels,
    ParametricProfile, Piecewise,
};

const EPSILON: f64 = f64::EPSILON;
const QUADRATURE: Midpoint =
    Midpoint { segments: 256, extrapolations: 4, exponents: Exponents::HalfInteger };

/// Scene, and the way in which it is solved.
#[derive(Debug)]
struct Scene {
    on: On,
    kappa: f64,
    upper: Vec<Term>,
    lower: Vec<Term>,
    breakpoints: Vec<f64>,
    declared: bool,
    ends: [f64; 2],
    parameters: [usize; 2],
    start: Option<[f64; 2]>,
    tolerance: f64,
    midpoint: bool,
    nested: bool,
    way: Way,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Way {
    Load,
    HalfWidth,
    CornersBeyond,
    CornerAtEdge,
    NoAdhesion,
}

impl Scene {
    fn new(rng: &mut Rng) -> Option<Self> {
        let half_width = if rng.chance(0.5) { rng.scale(1e-6, 1.0) } else { rng.between(0.1, 1.5) };
        let centre = if rng.chance(0.3) { 0.0 } else { rng.between(-1.0, 1.0) };
        let on = On { centre, half_width };
        let mut terms = smooth_terms(rng, on);
        if rng.chance(0.6) {
            terms.extend(
                (0..1 + rng.below(3)).map(|_| breakpointed_term(rng, on)).collect::<Vec<_>>(),
            );
        }
        let breakpoints: Vec<f64> = terms.iter().filter_map(Term::breakpoint).collect();
        let [mean, ..] = on.moments(&terms);
        terms.push(Term::Level(-mean));
        let [_, first, size] = on.moments(&terms);
        let parts: f64 = terms.iter().map(|term| on.moments(&[*term])[2]).sum();
        if first.is_nan() || first <= 1e-9 * size || size <= 1e-9 * parts {
            return None;
        }
        let (mut upper, mut lower) = (Vec::new(), Vec::new());
        for &term in &terms {
            if rng.chance(0.7) { upper.push(term) } else { lower.push(term.negated()) }
        }
        if rng.chance(0.3) && half_width > 1e-3 {
            let wave = Term::Wave(rng.between(0.1, 1.0), rng.scale(0.5, 4.0));
            upper.push(wave);
            lower.push(wave);
        }
        let (left, right) = (centre - half_width, centre + half_width);
        let start = match rng.below(4) {
            1 => Some([
                left - half_width * rng.scale(0.1, 3.0),
                right + half_width * rng.scale(0.1, 3.0),
            ]),
            2 => {
                let at = rng.between(-3.5, 3.4);
                Some([at, at + rng.scale(1e-9, 0.5)])
            }
            _ => None,
        };
        let ways = [
            Way::Load,
            Way::Load,
            Way::HalfWidth,
            Way::CornersBeyond,
            Way::CornerAtEdge,
            Way::NoAdhesion,
        ];
        Some(Self {
            on,
            kappa: if rng.chance(0.5) { 1.0 } else { rng.scale(1e-6, 1e6) },
            upper,
            lower,
            breakpoints,
            declared: rng.chance(0.8),
            ends: [-4.0 - rng.share(), 4.0 + rng.share()],
            parameters: [rng.below(3), rng.below(3)],
            start,
            tolerance: if rng.chance(0.3) { rng.scale(1e-12, 1e-3) } else { 0.0 },
            midpoint: rng.chance(0.1),
            nested: rng.chance(0.2),
            way: ways[rng.below(ways.len())],
        })
    }

    /// Returns all terms of the gap.
    fn gap(&self) -> Vec<Term> {
        self.upper.iter().copied().chain(self.lower.iter().map(|term| term.negated())).collect()
    }

    /// Returns the error of the limits by the rounding of slopes and limits, as a share of the
    /// half-width.
    fn noise(&self, first: f64, terms: &[Term]) -> f64 {
        let On { centre, half_width } = self.on;
        let all: Vec<Term> = self.upper.iter().chain(&self.lower).copied().collect();
        let size = (0..9).map(|i| {
            let x = centre + half_width * (f64::from(i) / 4.0 - 1.0);
            all.iter().map(|term| term.at(x, true)[1].abs()).sum::<f64>()
        });
        let size = size.fold(0.0, f64::max);
        let step = 1e-4;
        let mean = |sign: f64| {
            On { centre: centre + sign * step * half_width, half_width }.moments(terms)[0]
        };
        let stiffness = ((mean(1.0) - mean(-1.0)) / (2.0 * step)).abs().min(first);
        4e-16 * size / stiffness + EPSILON * (centre.abs() + half_width) / half_width
    }
}

fn place(rng: &mut Rng, on: On) -> f64 {
    if rng.chance(0.8) {
        on.centre + on.half_width * rng.between(-1.3, 1.3)
    } else {
        rng.between(-3.0, 3.0)
    }
}

fn smooth_terms(rng: &mut Rng, on: On) -> Vec<Term> {
    let count = 1 + rng.below(3);
    let term = |_| {
        let c = rng.scale(0.1, 10.0);
        match rng.below(6) {
            0 | 1 => Term::Line(c, place(rng, on)),
            2 => Term::Cube(c, place(rng, on)),
            3 => Term::Sinh(c, rng.scale(0.3, 5.0), place(rng, on)),
            4 => {
                let k = rng.between(-3.0, 3.0);
                Term::Exp(c * k.signum(), k)
            }
            _ => Term::Tanh(c, on.half_width * rng.scale(0.03, 10.0), place(rng, on)),
        }
    };
    (0..count).map(term).collect()
}

fn breakpointed_term(rng: &mut Rng, on: On) -> Term {
    let x = place(rng, on);
    let c = if rng.chance(0.3) { 2f64.powi(rng.below(28) as i32) } else { rng.scale(0.1, 10.0) };
    match rng.below(8) {
        0..=2 => Term::RampRight(c, x),
        3 | 4 => Term::RampLeft(c, x),
        5 | 6 => Term::Jump(rng.scale(0.01, 10.0) * on.half_width, x),
        _ => Term::Power(rng.scale(0.1, 10.0), [1.5, 2.5, 3.0][rng.below(3)], x),
    }
}

/// Builds a body between two ends, its breakpoints declared or not.
pub fn body(
    terms: &[Term],
    ends: [f64; 2],
    declared: bool,
    parameter: usize,
) -> Box<dyn ParametricProfile<f64>> {
    if terms.is_empty() {
        return Box::new(Flat);
    }
    let mut ends = ends.to_vec();
    if declared {
        ends.extend(terms.iter().filter_map(Term::breakpoint).filter(|x| x.abs() < 3.999));
    }
    ends.sort_by(f64::total_cmp);
    ends.dedup();
    let pieces = ends.windows(2).map(|ends| piece(terms.to_vec(), ends[0], ends[1], parameter));
    Box::new(Piecewise::new(pieces.collect()).expect("the pieces meet"))
}

/// Builds a piece with the parameter x, asinh x or -x.
fn piece(
    terms: Vec<Term>,
    from: f64,
    to: f64,
    parameter: usize,
) -> Box<dyn ParametricProfile<f64>> {
    let domain = match parameter {
        0 => [from, to],
        1 => [from.asinh(), to.asinh()],
        _ => [-to, -from],
    };
    let middle = (from + to) / 2.0;
    Box::new(Curve::new(domain, move |k: f64| {
        let (x, dx) = match parameter {
            0 => (k, 1.0),
            1 if k == domain[0] => (from, k.cosh()),
            1 if k == domain[1] => (to, k.cosh()),
            1 => (k.sinh(), k.cosh()),
            _ => (-k, -1.0),
        };
        let [y, slope, _] = sum(&terms, x, x < middle);
        CurvePoint { x, y, dx, dy: slope * dx }
    }))
}

/// Tells whether there was a contact to compare; an error names the fault.
pub fn run(mut rng: Rng) -> Result<bool, String> {
    let Some(scene) = Scene::new(&mut rng) else { return Ok(false) };
    check(&scene, &mut rng).map_err(|finding| format!("{finding} | {scene:?}"))
}

fn check(scene: &Scene, rng: &mut Rng) -> Result<bool, String> {
    let On { centre, half_width } = scene.on;
    let (left, right) = (centre - half_width, centre + half_width);
    let terms = scene.gap();
    let [_, first, _] = scene.on.moments(&terms);
    let load = scene.kappa * half_width * first;
    let [of_upper, of_lower] = scene.parameters;
    let upper = body(&scene.upper, scene.ends, scene.declared, of_upper);
    let lower = body(&scene.lower, scene.ends, scene.declared, of_lower);
    let (panels, brent) = (Panels { tolerance: scene.tolerance }, Brent::default());
    let mut contact =
        Contact::new(&*lower, &*upper).map_err(|e| format!("refused: {e}"))?.kappa(scene.kappa);
    contact =
        if scene.midpoint { contact.quadrature(&QUADRATURE) } else { contact.quadrature(&panels) };
    if scene.nested {
        contact = contact.limit_search(&brent);
    }
    if let Some([left, right]) = scene.start {
        contact = contact.start(Interval { left, right });
    }
    contact = match scene.way {
        Way::Load | Way::HalfWidth => contact,
        Way::CornersBeyond => contact.edges(
            Edge::FreeUntil(left - 0.01 * half_width),
            Edge::FreeUntil(right + 0.5 * half_width),
        ),
        Way::CornerAtEdge => contact.edges(Edge::Fixed(left), Edge::Free),
        Way::NoAdhesion => contact.edges(Edge::Adhesive(0.0), Edge::Adhesive(0.0)),
    };
    let pressed = if scene.way == Way::HalfWidth {
        Control::HalfWidth(half_width)
    } else {
        Control::Load(load)
    };
    // At a corner of exactly zero strength rounding decides whether the body lifts off.
    let contact = contact.single_interval(scene.way == Way::CornerAtEdge || rng.chance(0.5));
    let solution = contact.solve(pressed).map_err(|e| format!("refused: {e}"))?;
    if solution.intervals().len() != 1 {
        return Err(format!("intervals: {:?}", solution.intervals()));
    }

    let most = match (scene.declared, scene.midpoint) {
        (_, true) => 1_000_000,
        (true, _) => 20_000,
        (false, _) => 100_000,
    };
    let Cost { evaluations, heights, .. } = solution.cost();
    let evaluations = evaluations + heights;
    if evaluations > most {
        return Err(format!("evaluations: {evaluations}"));
    }
    let noise = scene.noise(first, &terms);
    let estimate = solution.limits_error().unwrap_or(f64::NAN);
    let off = (solution.a() - right).abs().max((solution.b() + left).abs()) / half_width;
    // The tolerance is one of the slope.
    let allowed = 3.0 * estimate + 10.0 * noise + scene.tolerance;
    if off.is_nan() || off > allowed {
        return Err(format!(
            "limits: off by {off:.2e}, estimated {estimate:.2e}, noise {noise:.1e}"
        ));
    }
    let off = (solution.load() / load - 1.0).abs();
    if off.is_nan() || off > 20.0 * allowed {
        return Err(format!("load: off by {off:.2e}, estimated {estimate:.2e}, noise {noise:.1e}"));
    }
    // At breakpoints the order and the error of the rule are unknown.
    if scene.way == Way::NoAdhesion || (scene.midpoint && !scene.breakpoints.is_empty()) {
        return Ok(true);
    }
    let pressure = solution.pressure().map_err(|e| format!("refused: pressure: {e}"))?;
    let size = scene.kappa
        * (terms.iter().map(|t| t.at(left, true)[1].abs() + t.at(right, true)[1].abs()))
            .sum::<f64>();
    for i in 0..6 {
        let near = rng.scale(1e-6, 1e-1);
        let z = [rng.between(-0.99, 0.99), 1.0 - near, near - 1.0][i % 3];
        let x = centre + half_width * z;
        let apart = scene
            .breakpoints
            .iter()
            .map(|breakpoint| (breakpoint - x).abs())
            .fold(half_width, f64::min);
        if x <= solution.hull().left || x >= solution.hull().right || apart == 0.0 {
            continue;
        }
        let exact = scene.kappa * scene.on.pressure(&terms, x);
        let got = pressure
            .estimate(x, &mut Cost::default())
            .map_err(|e| format!("refused: pressure: {e}"))?;
        let root = (1.0 - z * z).sqrt();
        let rounding = (30.0 * noise + 1e-12) * exact / (root * root)
            + 1e-14 * size / root
            + 100.0 * EPSILON * (centre.abs() + half_width) / apart * exact;
        let off = (got.value - exact).abs();
        if off.is_nan() || off > 3.0 * got.error + rounding {
            return Err(format!(
                "pressure: at z = {z}, {} from a breakpoint: {:e} for {exact:e}, error {:.1e}, rounding {rounding:.1e}",
                apart / half_width,
                got.value,
                got.error
            ));
        }
    }
    if rng.chance(0.1) {
        solution.certify().map_err(|e| format!("certificate: {e}"))?;
        let x = centre + half_width * rng.between(-0.9, 0.9);
        let apart = scene
            .breakpoints
            .iter()
            .map(|breakpoint| (breakpoint - x).abs())
            .fold(half_width, f64::min);
        let regular = apart > 1e-3 * half_width && !scene.midpoint;
        if let (Ok(residual), true) = (solution.residual(x), regular)
            && residual.abs() > size * (1e-9 + 1e3 * (estimate + noise))
        {
            return Err(format!(
                "equation: {residual:e} of {size:e} at {x}, estimated {estimate:.1e}"
            ));
        }
    }
    Ok(true)
}
