//! The scenes: bodies as pieces whose slopes can be changed a little, with their known solutions.

use super::common;
use linecontact::reference::{ClosedForm, Ellipse, Hertz, PowerLaw, RoundedPunch, UnequalRadii};
use linecontact::{Curve, CurvePoint, Flat, Interval, ParametricProfile, Piecewise};
use std::f64::consts::{FRAC_PI_2, PI};
use std::sync::Arc;

pub type Profile = Box<dyn ParametricProfile<f64>>;
type Map = Arc<dyn Fn(CurvePoint<f64>) -> CurvePoint<f64> + Send + Sync>;
type At = Arc<dyn Fn(f64) -> CurvePoint<f64> + Send + Sync>;

/// Smooth piece: the range of its parameter and its points.
#[derive(Clone)]
pub struct Part([f64; 2], At);

fn part(from: f64, to: f64, at: impl Fn(f64) -> CurvePoint<f64> + Send + Sync + 'static) -> Part {
    Part([from, to], Arc::new(at))
}

fn graph(from: f64, to: f64, y: impl Fn(f64) -> [f64; 2] + Send + Sync + 'static) -> Part {
    part(from, to, move |x| {
        let [y, dy] = y(x);
        CurvePoint { x, y, dx: 1.0, dy }
    })
}

/// Contact whose solution is known.
pub struct Scene {
    pub name: String,
    /// Pieces of the lower and the upper body; none for the flat.
    pub bodies: [Vec<Part>; 2],
    pub limits: Interval<f64>,
    pub load: f64,
    pub kappa: f64,
    /// Pairs of x and P(x).
    pub points: Vec<[f64; 2]>,
}

impl Scene {
    /// Returns both bodies, with the points of one of them changed.
    pub fn changed(&self, which: usize, map: Map) -> [Profile; 2] {
        let body = |i: usize| -> Profile {
            if self.bodies[i].is_empty() {
                return Box::new(Flat);
            }
            let pieces = self.bodies[i].iter().cloned().map(|Part(range, at)| {
                let map = map.clone();
                Curve::new(range, move |k| if i == which { map(at(k)) } else { at(k) })
            });
            Box::new(Piecewise::new(pieces.collect()).expect("the pieces meet"))
        };
        [body(0), body(1)]
    }

    fn of(name: impl Into<String>, form: &dyn ClosedForm<f64>, parts: Vec<Part>) -> Self {
        let (limits, kappa) = (form.limits(), 1.0);
        let points = [-0.999, -0.9, -0.4, 0.1, 0.5, 0.9, 0.999].map(|z| {
            let x = limits.centre() + limits.half_width() * z;
            [x, form.pressure(x, kappa)]
        });
        let (bodies, load) = ([Vec::new(), parts], form.load(kappa));
        Self { name: name.into(), bodies, limits, load, kappa, points: points.to_vec() }
    }

    fn from_file(name: &str, file: &str, bodies: [Vec<Part>; 2]) -> Self {
        let common::Reference { a, b, c, kappa, points, .. } = common::reference(file);
        let limits = Interval { left: -b, right: a };
        Self { name: name.into(), bodies, limits, load: c / PI, kappa, points }
    }
}

fn circle(from: f64, to: f64) -> Part {
    part(from, to, |k| {
        let (sin, cos) = k.sin_cos();
        CurvePoint { x: sin, y: 2.0 * (k / 2.0).sin().powi(2), dx: cos, dy: sin }
    })
}

/// Makes y = x²/2 over four half-widths to either side.
fn parabola(half_width: f64) -> Part {
    graph(-4.0 * half_width, 4.0 * half_width, |x| [x * x / 2.0, x])
}

/// Makes the involute of a circle, unwound by the angle `start + k`.
fn involute(radius: f64, start: f64, [from, to]: [f64; 2], sign: f64) -> Part {
    part(from, to, move |k| {
        let (r, t, (s, c)) = (sign * radius, start + k, k.sin_cos());
        // 1 - cos k without loss of digits.
        let versine = 2.0 * (k / 2.0).sin().powi(2);
        let (x, y) = (r * (t * s - versine), r * (s - t * c + start));
        CurvePoint { x, y, dx: r * t * c, dy: r * t * s }
    })
}

/// Computes `J₁(x)` from its integral; the trapezoidal rule is exact to rounding.
fn bessel_1(x: f64) -> f64 {
    let term = |i: u32| {
        let t = PI * (f64::from(i) + 0.5) / 200.0;
        (t - x * t.sin()).cos()
    };
    (0..200).map(term).sum::<f64>() / 200.0
}

/// Makes y = x²/2 + A cos(ω x)/ω², convex up to A = 1; the load follows from Bessel's integral.
fn wave(amplitude: f64, omega: f64) -> Scene {
    let body = graph(-4.0, 4.0, move |x| {
        let (sin, cos) = (omega * x).sin_cos();
        [x * x / 2.0 + amplitude * cos / (omega * omega), x - amplitude * sin / omega]
    });
    let load = 0.5 - amplitude / omega * bessel_1(omega);
    let (name, limits) = (
        format!("wave, amplitude 1 - {:.0e}", 1.0 - amplitude),
        Interval { left: -1.0, right: 1.0 },
    );
    Scene { name, bodies: [Vec::new(), vec![body]], limits, load, kappa: 1.0, points: Vec::new() }
}

pub fn all() -> Vec<Scene> {
    let mut scenes = Vec::new();
    for half_width in [1e-150, 1e-75, 1.0, 1e75, 1e150] {
        let form = Hertz::new(1.0, half_width).expect("a contact");
        scenes.push(Scene::of(
            format!("parabola, L = {half_width:e}"),
            &form,
            vec![parabola(half_width)],
        ));
    }
    let far = 134217728.0;
    let shifted = graph(far - 8.0, far + 12.0, move |x| [(x - far).powi(2) / 2.0, x - far]);
    scenes.push(Scene::from_file(
        "1e8 half-widths off centre",
        "hertz_offcentre",
        [Vec::new(), vec![shifted]],
    ));
    let form = Ellipse::circle(1.0, 1.0 - 1e-7).expect("a contact");
    scenes.push(Scene::of("circle, L/R = 1 - 1e-7", &form, vec![circle(-FRAC_PI_2, FRAC_PI_2)]));
    for n in [1.0, 1.5, 2.0, 3.0, 4.0, 6.0, 10.0, 20.0, 50.0, 100.0] {
        let form = PowerLaw::new(1.0 / n, n, 1.0).expect("a contact");
        let side = move |x: f64| {
            let q = x.abs();
            [q.powf(n) / n, q.powf(n - 1.0)]
        };
        let left = graph(-1.5, 0.0, move |x| [side(x)[0], -side(x)[1]]);
        scenes.push(Scene::of(format!("|x|^{n}"), &form, vec![left, graph(0.0, 1.5, side)]));
    }
    let form = UnequalRadii::new(1.0, 1e-6, 1.0).expect("a contact");
    let (left, right) =
        (graph(-9.0, 0.0, |x| [x * x / 2.0, x]), graph(0.0, 9.0, |x| [5e5 * x * x, 1e6 * x]));
    scenes.push(Scene::of("curvatures 1 and 1e6", &form, vec![left, right]));
    let form = RoundedPunch::new(1.0, 1.0, 1.0 + 1e-6).expect("a contact");
    let flank = |from, to, end: f64| graph(from, to, move |x| [(x - end).powi(2) / 2.0, x - end]);
    let punch =
        vec![flank(-3.0, -1.0, -1.0), graph(-1.0, 1.0, |_| [0.0, 0.0]), flank(1.0, 3.0, 1.0)];
    scenes.push(Scene::of("rounded punch, L/d = 1 + 1e-6", &form, punch));
    let form = Hertz::new(1.0, 0.5).expect("a contact");
    let cubic = part(-1.5, 1.5, |k| {
        let (x, dx) = (k * k * k + 1e-6 * k, 3.0 * k * k + 1e-6);
        CurvePoint { x, y: x * x / 2.0, dx, dy: x * dx }
    });
    scenes.push(Scene::of("X = k³ + 1e-6 k", &form, vec![cubic]));
    let sinh = part(-1.0, 1.0, |k| {
        let (x, dx) = ((40.0 * k).sinh() / 40f64.sinh(), 40.0 * (40.0 * k).cosh() / 40f64.sinh());
        CurvePoint { x, y: 2.0 * (1.5 * x).sinh().powi(2), dx, dy: 3.0 * (3.0 * x).sinh() * dx }
    });
    scenes.push(Scene::from_file("X = sinh 40 k", "sinh40_param", [Vec::new(), vec![sinh]]));
    let gears = [(37.5, -1.0), (112.5, 1.0)]
        .map(|(radius, sign)| vec![involute(radius, 93.0 / 256.0, [-0.36, 1.0], sign)]);
    scenes.push(Scene::from_file(
        "involute gears at the pitch point",
        "gear_involute_pitch_point",
        gears,
    ));
    let start = 1.0 / 64.0;
    let flank = vec![involute(37.5, start, [-2047.0 / 2048.0 * start, 1.0], 1.0)];
    scenes.push(Scene::from_file(
        "gear near the base circle",
        "gear_near_base_circle",
        [Vec::new(), flank],
    ));
    let form = Ellipse::circle(1.0, 0.3).expect("a contact");
    let breakpoints = [-1.2, -1e-2, -1e-5, -1e-9, 0.0, 1e-12, 1e-7, 0.25, 0.25 + 1e-8, 1.2];
    let arcs = breakpoints.windows(2).map(|ends| circle(ends[0], ends[1])).collect();
    scenes.push(Scene::of("circle in arcs down to 1e-12", &form, arcs));
    scenes.extend([0.9, 1.0 - 1e-3, 1.0 - 1e-6, 1.0 - 1e-9].map(|amplitude| wave(amplitude, 12.0)));
    scenes
}
