//! Reference solutions, and the scenes they belong to, for all integration tests.
#![allow(dead_code, missing_docs)] // Each test crate uses its own part.

#[path = "../../examples/paper/curves.rs"]
pub mod paper;
#[path = "../../benches/shared/scenes.rs"]
pub mod speed_scenes;

pub mod controls;

use linecontact::search::{Bracket, LimitSearch, Root, SearchError};
use linecontact::{
    Contact, Curve, CurvePoint, Flat, Interval, ParametricProfile, Piece, Piecewise, Real, Solution,
};
use serde_json::Value;
use std::f64::consts::PI;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

pub type Profile = Box<dyn ParametricProfile<f64>>;

/// Solution to 25 digits, from `tests/data`.
pub struct Reference {
    pub a: f64,
    pub b: f64,
    pub c: f64,
    pub kappa: f64,
    /// Pairs of x and P(x).
    pub points: Vec<[f64; 2]>,
    /// Amplification of a relative error of the data in each pressure.
    pub amplification: Vec<f64>,
}

impl Reference {
    pub fn half_width(&self) -> f64 {
        (self.a + self.b) / 2.0
    }

    pub fn z(&self, x: f64) -> f64 {
        (x - (self.a - self.b) / 2.0) / self.half_width()
    }
}

/// Reads a file of `tests/data`.
fn data(name: &str) -> Value {
    let path = format!("{}/tests/data/{name}.json", env!("CARGO_MANIFEST_DIR"));
    let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{path}: {e}"));
    serde_json::from_str(&text).expect("valid JSON")
}

fn number(v: &Value) -> f64 {
    v.as_str().expect("a decimal in a string").parse().expect("a number")
}

/// Returns numbers of a layer from `kernels/layers.json`.
pub fn kernel_values<const N: usize>(name: &str, keys: [&str; N]) -> [f64; N] {
    let json = data("kernels/layers");
    let layers = "layers: R = h = a = E1 = 1, rigid parabola, nu .3 unless said";
    keys.map(|key| number(&json[layers][name][key]))
}

pub fn reference(name: &str) -> Reference {
    let json = data(name);
    let list = |key: &str| json[key].as_array().cloned().unwrap_or_default();
    Reference {
        a: number(&json["a"]),
        b: number(&json["b"]),
        c: number(&json["C"]),
        kappa: json.get("scale_value").map_or(1.0, number),
        points: list("points").iter().map(|p| [number(&p[0]), number(&p[1])]).collect(),
        amplification: list("points_amplification").iter().map(number).collect(),
    }
}

/// Returns the contacts of a solution, from left to right.
pub fn intervals<T: Real>(solution: &Solution<T>) -> Vec<Interval<T>> {
    solution.intervals().to_vec()
}

/// Reference solution with several contacts, from `tests/data/several`.
pub struct Several {
    pub contacts: Vec<Interval<f64>>,
    /// Load of each contact.
    pub loads: Vec<f64>,
    /// Pairs of x and P(x).
    pub points: Vec<[f64; 2]>,
}

pub fn several(name: &str) -> Several {
    let json = data(&format!("several/{name}"));
    let pairs = |key: &str| -> Vec<[f64; 2]> {
        let list = json[key].as_array().expect("a list");
        list.iter().map(|pair| [number(&pair[0]), number(&pair[1])]).collect()
    };
    let contacts = pairs("limits").into_iter().map(|[left, right]| Interval { left, right });
    let loads = json["loads"].as_array().expect("a list").iter().map(number).collect();
    Several { contacts: contacts.collect(), loads, points: pairs("points") }
}

/// Scene with a reference solution: its name, its bodies, and the relative accuracy of the limits
/// that its formulas allow in binary64.
pub struct Scene {
    pub name: &'static str,
    pub lower: Profile,
    pub upper: Profile,
    pub accuracy: f64,
}

impl Scene {
    pub fn contact(&self) -> Contact<'_, f64> {
        let kappa = reference(self.name).kappa;
        Contact::new(&*self.lower, &*self.upper).expect(self.name).kappa(kappa)
    }
}

/// Returns the graph of y = f(x) over a range of x, from f(x) and f'(x).
pub fn graph(
    from: f64,
    to: f64,
    y: impl Fn(f64) -> [f64; 2] + Send + Sync + 'static,
) -> Box<dyn ParametricProfile<f64>> {
    Box::new(Curve::new([from, to], move |k| {
        let [y, dy] = y(k);
        CurvePoint { x: k, y, dx: 1.0, dy }
    }))
}

pub fn parabola(reach: f64) -> Profile {
    graph(-reach, reach, |x| [x * x / 2.0, x])
}

/// Returns x⁴ - 2x².
pub fn quartic(from: f64, to: f64) -> Profile {
    graph(from, to, |x| [x * x * (x * x - 2.0), 4.0 * x * (x * x - 1.0)])
}

/// Returns a point of x = k + k³/5 on the parabola x²/2, so that x has to be inverted.
pub fn by_cubic(k: f64) -> CurvePoint<f64> {
    let (x, dx) = (k + 0.2 * k * k * k, 1.0 + 0.6 * k * k);
    CurvePoint { x, y: x * x / 2.0, dx, dy: x * dx }
}

type Found = Result<Root<f64>, SearchError<f64>>;

/// A user's search: may evaluate the function, and returns whatever it likes.
pub struct Strategy(pub fn(&mut dyn FnMut(f64) -> f64, &Bracket<f64>) -> Found);

impl LimitSearch<f64> for Strategy {
    fn find(&self, f: &mut dyn FnMut(f64) -> f64, bracket: &Bracket<f64>) -> Found {
        self.0(f, bracket)
    }
}

impl Strategy {
    /// Returns a point as the root, whatever the function value there.
    pub fn take(x: f64, f: &mut dyn FnMut(f64) -> f64, bracket: &Bracket<f64>) -> Found {
        Ok(Root { x, residual: f(x), bracket: [bracket.lo, bracket.hi], evaluations: 1 })
    }
}

/// Returns the contact of a body above a flat.
pub fn on_flat<'b>(body: Profile) -> Contact<'b, f64> {
    Contact::owned(Arc::new(Flat), body.into()).unwrap()
}

/// Returns a circle of radius 1 by its angle, from left to right for a sign of 1.
pub fn circle(from: f64, to: f64, sign: f64) -> Profile {
    Box::new(Curve::new([from, to], move |k: f64| {
        let (sin, cos) = k.sin_cos();
        CurvePoint { x: sign * sin, y: 1.0 - cos, dx: sign * cos, dy: sin }
    }))
}

pub fn join(pieces: Vec<Profile>) -> Profile {
    Box::new(Piecewise::new(pieces).expect("the pieces meet"))
}

/// Returns |x|^n/n, in two pieces.
pub fn power(n: f64) -> Profile {
    join(vec![
        graph(-2.0, 0.0, move |x| [(-x).powf(n) / n, -(-x).powf(n - 1.0)]),
        graph(0.0, 2.0, move |x| [x.powf(n) / n, x.powf(n - 1.0)]),
    ])
}

fn cubic_parameter(eps: f64) -> Profile {
    Box::new(Curve::new([-2.0, 2.0], move |k: f64| {
        let (x, dx) = (k * k * k + eps * k, 3.0 * k * k + eps);
        CurvePoint { x, y: x * x / 2.0, dx, dy: x * dx }
    }))
}

/// Returns the flank of a gear's tooth, by the angle rolled off beyond the pitch point.
pub fn gear(radius: f64, sign: f64) -> Profile {
    let t0 = 93.0 / 256.0;
    Box::new(Curve::new([-0.36, 1.0], move |k: f64| {
        let (r, t, (s, c)) = (sign * radius, t0 + k, k.sin_cos());
        CurvePoint {
            x: r * (c + t * s - 1.0),
            y: r * (s - t * c + t0),
            dx: r * t * c,
            dy: r * t * s,
        }
    }))
}

pub fn scenes() -> Vec<Scene> {
    let flat = || -> Profile { Box::new(Flat) };
    let on_flat = |name, upper, accuracy| Scene { name, lower: flat(), upper, accuracy };
    let printed = |name, example: paper::Example, accuracy| {
        let paper::Example { lower, upper, .. } = example;
        Scene { name, lower, upper, accuracy }
    };
    vec![
        printed("paper_example_2", paper::two(), 1e-15),
        printed("paper_example_3_scale_one", paper::three(), 6e-14),
        printed("paper_example_3_scale_half_pi", paper::three(), 6e-14),
        printed("paper_example_4_scale_one", paper::four(), 2e-12),
        printed("paper_example_4_scale_half_pi", paper::four(), 2e-12),
        printed("paper_example_5_scale_one", paper::five(), 5e-13),
        printed("paper_example_5_scale_half_pi", paper::five(), 5e-13),
        on_flat("power_n_1", power(1.0), 2e-15),
        on_flat("power_n_3", power(3.0), 4e-15),
        on_flat("power_n_6", power(6.0), 4e-15),
        on_flat("power_n_20", power(20.0), 4e-15),
        on_flat(
            "tilted_wedge",
            join(vec![
                graph(-9.0, 0.0, |x| [-x / 4.0, -0.25]),
                graph(0.0, 9.0, |x| [1.75 * x, 1.75]),
            ]),
            5e-15,
        ),
        on_flat(
            "asym_parabola_1e6",
            join(vec![
                graph(-9.0, 0.0, |x| [x * x / 2.0, x]),
                graph(0.0, 9.0, |x| [5e5 * x * x, 1e6 * x]),
            ]),
            1e-12,
        ),
        on_flat("hertz_tiny", parabola(1.0), 1e-15),
        on_flat("hertz_huge", graph(-4e150, 4e150, |x| [x * x / 2.0, x]), 1e-15),
        on_flat(
            "hertz_offcentre",
            graph(134217720.0, 134217740.0, |x| [(x - 134217728.0).powi(2) / 2.0, x - 134217728.0]),
            1e-15,
        ),
        on_flat(
            "sinh40_param",
            Box::new(Curve::new([-1.0, 1.0], |k: f64| {
                let (x, dx) =
                    ((40.0 * k).sinh() / 40f64.sinh(), 40.0 * (40.0 * k).cosh() / 40f64.sinh());
                CurvePoint { x, y: (3.0 * x).cosh() - 1.0, dx, dy: 3.0 * (3.0 * x).sinh() * dx }
            })),
            1e-14,
        ),
        on_flat("k3eps_hertz", cubic_parameter(1.0 / 1073741824.0), 2e-15),
        on_flat(
            "rounded_punch_1e-6",
            join(vec![
                graph(-3.0, -1.0, |x| [(x + 1.0).powi(2) / 2.0, x + 1.0]),
                graph(-1.0, 1.0, |_| [0.0, 0.0]),
                graph(1.0, 3.0, |x| [(x - 1.0).powi(2) / 2.0, x - 1.0]),
            ]),
            2e-15,
        ),
        on_flat(
            "wavy_convex",
            graph(-3.0, 3.0, |x| {
                let (s, c) = (16.0 * x).sin_cos();
                [x * x / 2.0 + c / 1024.0, x - s / 64.0]
            }),
            2e-15,
        ),
        Scene {
            name: "gear_involute_pitch_point",
            lower: gear(37.5, -1.0),
            upper: gear(112.5, 1.0),
            accuracy: 1e-13,
        },
    ]
}

/// Returns the order of convergence: minus the least-squares slope of log(error) against log(n).
pub fn order(errors: &[(usize, f64)]) -> f64 {
    let points: Vec<(f64, f64)> = errors.iter().map(|&(n, e)| ((n as f64).ln(), e.ln())).collect();
    let count = points.len() as f64;
    let mean_x = points.iter().map(|p| p.0).sum::<f64>() / count;
    let mean_y = points.iter().map(|p| p.1).sum::<f64>() / count;
    let covariance: f64 = points.iter().map(|p| (p.0 - mean_x) * (p.1 - mean_y)).sum();
    let variance: f64 = points.iter().map(|p| (p.0 - mean_x).powi(2)).sum();
    -covariance / variance
}

/// Returns central differences of solves, with Richardson extrapolation.
pub fn difference(of: impl Fn(f64) -> f64, at: f64) -> f64 {
    let central = |h: f64| (of(at * (1.0 + h)) - of(at * (1.0 - h))) / (2.0 * at * h);
    (4.0 * central(2e-4) - central(4e-4)) / 3.0
}

/// Returns the larger error of two limits, as a share of the half-width due.
pub fn limits_off(found: Interval<f64>, due: Interval<f64>) -> f64 {
    (found.left - due.left).abs().nan_max((found.right - due.right).abs()) / due.half_width()
}

/// Returns the smooth pieces of a body.
pub fn pieces<T: Real>(body: &dyn ParametricProfile<T>) -> Vec<Piece<'_, T>> {
    match body.pieces() {
        0 => vec![Piece::new(body).expect("a body that can be solved")],
        count => (0..count).filter_map(|i| body.piece(i)).collect(),
    }
}

/// Compares two numbers, relative to the larger one.
#[track_caller]
pub fn assert_close(got: f64, want: f64, max_relative: f64) {
    approx::assert_relative_eq!(got, want, epsilon = 0.0, max_relative = max_relative);
}

/// Maximum in which NaN exceeds every number; `max` would lose it.
pub trait NanSafe: Real {
    fn nan_max(self, other: Self) -> Self {
        let is_nan = self.partial_cmp(&self).is_none();
        if is_nan || self > other { self } else { other }
    }
}

impl<T: Real> NanSafe for T {}

/// Returns the largest error, 0 if there are none; NaN if any error is NaN.
pub fn worst(errors: impl IntoIterator<Item = f64>) -> f64 {
    errors.into_iter().fold(0.0, NanSafe::nan_max)
}

/// Returns the exact pressure of the paper's Example 1.
pub fn example_1_exact(x: f64) -> f64 {
    -(2.0 * x + (1.0 - x * x) * ((1.0 + x) / (1.0 - x)).ln()) / (PI * PI * (1.0 - x * x).sqrt())
}

/// Returns the exact pressure of the paper's Example 2.
pub fn example_2_exact(x: f64) -> f64 {
    16.0 * ((1.0 - x) * (0.6 + x)).sqrt()
}

/// Wrapper that counts the evaluations of a curve.
pub struct Counting<'c, P>(pub P, pub &'c AtomicUsize);

impl<P: ParametricProfile<f64>> ParametricProfile<f64> for Counting<'_, P> {
    fn domain(&self) -> [f64; 2] {
        self.0.domain()
    }
    fn at(&self, k: f64) -> CurvePoint<f64> {
        self.1.fetch_add(1, Ordering::Relaxed);
        self.0.at(k)
    }
    fn pieces(&self) -> usize {
        self.0.pieces()
    }
    fn piece(&self, index: usize) -> Option<Piece<'_, f64>> {
        self.0.piece(index)
    }
}

/// Uniform random numbers, the same on every platform.
pub struct Shares(pub u64);

impl Shares {
    pub fn between(&mut self, from: f64, to: f64) -> f64 {
        self.0 = self.0.wrapping_mul(0x5851_F42D_4C95_7F2D).wrapping_add(0x1405_7B7E_F767_814F);
        from + (to - from) * ((self.0 >> 11) as f64 / (1u64 << 53) as f64)
    }

    pub fn power_of_ten(&mut self, from: f64, to: f64) -> f64 {
        10f64.powf(self.between(from, to))
    }

    /// Returns a number with a distribution close to the normal one.
    pub fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.between(0.0, 1.0)).sum::<f64>() - 6.0
    }
}
