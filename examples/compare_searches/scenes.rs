//! Contacts whose limits are known.

use super::curves::{self, Example, Profile};
use linecontact::{Contact, ContactError, Curve, CurvePoint, Flat, Piecewise};
use std::f64::consts::{FRAC_PI_2, PI};

/// Two bodies, their load, and the exact limits.
pub struct Scene {
    pub name: &'static str,
    lower: Profile,
    upper: Profile,
    kappa: f64,
    /// Constant C of the load.
    pub c: f64,
    pub a: f64,
    pub b: f64,
    /// Largest relative error of the limits that passes: the effect of the noise of the formulas.
    pub allowed: f64,
}

impl Scene {
    fn paper(name: &'static str, example: Example, a: f64, b: f64, allowed: f64) -> Self {
        let Example { lower, upper, c } = example;
        Self { name, lower, upper, kappa: 1.0, c, a, b, allowed }
    }

    fn on_flat(name: &'static str, upper: Profile, c: f64, a: f64, b: f64) -> Self {
        Self { name, lower: Box::new(Flat), upper, kappa: 1.0, c, a, b, allowed: 1e-13 }
    }

    pub fn contact(&self) -> Result<Contact<'_, f64>, ContactError<f64>> {
        Ok(Contact::new(&*self.lower, &*self.upper)?.kappa(self.kappa))
    }

    /// Returns the errors of `a` and `b`, relative to themselves, or to the half-width where it is
    /// smaller.
    pub fn errors(&self, a: f64, b: f64) -> [f64; 2] {
        let half_width = 0.5 * (self.a + self.b);
        [(a, self.a), (b, self.b)]
            .map(|(found, exact)| (found - exact).abs() / exact.abs().min(half_width))
    }
}

/// Returns Examples 3 to 5 with κ = 1. The references have 25 digits (`tests/data`).
pub fn paper() -> [Scene; 3] {
    let (a, b) = (0.05763680561192331, 0.05786118098062241);
    let three = Scene::paper("Example 3", curves::three(), a, b, 1e-12);
    let (a, b) = (6.616627213322834e-4, 3.104117294153146e-3);
    let four = Scene::paper("Example 4", curves::four(), a, b, 1e-12);
    let (a, b) = (4.386593301132873e-3, 1.876493466655127e-3);
    let five = Scene::paper("Example 5", curves::five(), a, b, 1e-12);
    [three, four, five]
}

pub fn all() -> Vec<Scene> {
    let two = Scene::paper("Example 2", curves::two(), 1.0, 0.6, 1e-13);
    let mut scenes = vec![Scene { kappa: FRAC_PI_2, ..two }];
    scenes.extend(paper());
    scenes.extend([wedge(), power_20(), uneven_parabola(), far_parabola()]);
    // The half-width is sqrt(2C/π).
    let tiny = (2.0 * 1e-300 / PI).sqrt();
    scenes.push(Scene::on_flat("parabola, C = 1e-300", graph(0.0, parabola), 1e-300, tiny, tiny));
    scenes
}

/// Makes the graph of a function, given with its slope, over 4 units to either side of `middle`.
fn graph(middle: f64, f: fn(f64) -> [f64; 2]) -> Profile {
    Box::new(Curve::new([middle - 4.0, middle + 4.0], move |k| {
        let [y, dy] = f(k - middle);
        CurvePoint { x: k, y, dx: 1.0, dy }
    }))
}

/// Joins the graphs of two functions at x = 0.
fn joined(left: fn(f64) -> [f64; 2], right: fn(f64) -> [f64; 2]) -> Profile {
    let side = |from, to, f: fn(f64) -> [f64; 2]| {
        Curve::new([from, to], move |k| {
            let [y, dy] = f(k);
            CurvePoint { x: k, y, dx: 1.0, dy }
        })
    };
    let pieces = vec![side(-4.0, 0.0, left), side(0.0, 4.0, right)];
    Box::new(Piecewise::new(pieces).expect("both sides pass through the origin"))
}

fn parabola(x: f64) -> [f64; 2] {
    [0.5 * x * x, x]
}

/// Makes a wedge. With θ = π s₁/(s₁ + s₂): L = C/((s₁ + s₂) sin θ), centre -L cos θ.
fn wedge() -> Scene {
    let wedge = joined(|x| [-0.25 * x, -0.25], |x| [1.75 * x, 1.75]);
    Scene::on_flat("wedge, slopes -1/4, 7/4", wedge, 1.0, 0.09945618368982906, 2.513669746062924)
}

fn power_20() -> Scene {
    let power = graph(0.0, |x| [x.powi(20) / 20.0, x.powi(19)]);
    Scene::on_flat("|x|^20/20", power, 7.0, 1.1352655950297739, 1.1352655950297739)
}

/// Makes a parabola whose curvature jumps from 1 to a million.
fn uneven_parabola() -> Scene {
    let profile = joined(parabola, |x| [5e5 * x * x, 1e6 * x]);
    let (a, b) = (1.0276252005197066e-4, 0.9212971802054848);
    Scene::on_flat("curvatures 1, 1e6", profile, 1.0, a, b)
}

/// Makes a parabola at about 2^27 with half-width 1: a and b can be exact only to their own last
/// bits.
fn far_parabola() -> Scene {
    let (x0, profile) = (134217728.0, graph(134217728.0, parabola));
    let scene = Scene::on_flat("parabola at 2^27", profile, FRAC_PI_2, x0 + 1.0, 1.0 - x0);
    Scene { allowed: 2.0 * x0 * f64::EPSILON, ..scene }
}
