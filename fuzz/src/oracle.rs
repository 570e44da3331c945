//! Slopes that are sums of terms, and their contact by tanh-sinh quadrature.

use std::f64::consts::{FRAC_PI_2, PI};

/// Term of the slope of a gap that does not fall.
#[derive(Clone, Copy, Debug)]
pub enum Term {
    Level(f64),
    Line(f64, f64),
    Cube(f64, f64),
    Sinh(f64, f64, f64),
    Exp(f64, f64),
    Tanh(f64, f64, f64),
    RampRight(f64, f64),
    RampLeft(f64, f64),
    Jump(f64, f64),
    Power(f64, f64, f64),
    /// Wave, whose slope falls in places: for a convex gap it is equal on both bodies.
    Wave(f64, f64),
}
use Term::*;

impl Term {
    /// Returns height, slope and curvature; at a breakpoint those on the given side.
    pub fn at(&self, x: f64, right: bool) -> [f64; 3] {
        let none = [0.0; 3];
        match *self {
            Level(c) => [c * x, c, 0.0],
            Line(c, x0) => [c * (x - x0).powi(2) / 2.0, c * (x - x0), c],
            Cube(c, x0) => {
                let t = x - x0;
                [c * t.powi(4) / 4.0, c * t.powi(3), 3.0 * c * t * t]
            }
            Sinh(c, k, x0) => {
                let t = k * (x - x0);
                [c / k * t.cosh(), c * t.sinh(), c * k * t.cosh()]
            }
            Exp(c, k) => {
                let e = (k * x).exp();
                [c / k * e, c * e, c * k * e]
            }
            Tanh(c, w, x0) => {
                let t = (x - x0) / w;
                let far = t.abs() + (-2.0 * t.abs()).exp().ln_1p();
                let steep = if t.abs() > 300.0 { 0.0 } else { t.cosh().powi(-2) };
                [c * w * far, c * t.tanh(), c / w * steep]
            }
            RampRight(c, x0) if x > x0 || (x == x0 && right) => Line(c, x0).at(x, right),
            RampLeft(c, x0) if x < x0 || (x == x0 && !right) => Line(c, x0).at(x, right),
            Jump(c, x0) if x > x0 || (x == x0 && right) => [c * (x - x0), c, 0.0],
            RampRight(..) | RampLeft(..) | Jump(..) => none,
            Power(c, p, x0) => {
                let (t, q) = (x - x0, (x - x0).abs());
                [
                    c * q.powf(p + 1.0) / (p + 1.0),
                    c * q.powf(p) * t.signum(),
                    c * p * q.powf(p - 1.0),
                ]
            }
            Wave(c, k) => [-c / k * (k * x).cos(), c * (k * x).sin(), c * k * (k * x).cos()],
        }
    }

    pub fn negated(self) -> Self {
        match self {
            Level(c) => Level(-c),
            Line(c, a) => Line(-c, a),
            Cube(c, a) => Cube(-c, a),
            Sinh(c, k, a) => Sinh(-c, k, a),
            Exp(c, k) => Exp(-c, k),
            Tanh(c, w, a) => Tanh(-c, w, a),
            RampRight(c, a) => RampRight(-c, a),
            RampLeft(c, a) => RampLeft(-c, a),
            Jump(c, a) => Jump(-c, a),
            Power(c, p, a) => Power(-c, p, a),
            Wave(c, k) => Wave(-c, k),
        }
    }

    pub fn breakpoint(&self) -> Option<f64> {
        match *self {
            RampRight(_, x) | RampLeft(_, x) | Jump(_, x) | Power(_, _, x) => Some(x),
            _ => None,
        }
    }

    /// Returns the values on a span of which `middle` is a point, so that a place rounded to a
    /// breakpoint stays on its side.
    fn on(&self, x: f64, middle: f64) -> [f64; 3] {
        match self.breakpoint() {
            Some(breakpoint) if (x - breakpoint) * (middle - breakpoint) <= 0.0 => {
                // The curvature of a power may be infinite at the breakpoint itself.
                let x = if matches!(self, Power(..)) && x == breakpoint {
                    breakpoint + 1e-300
                } else {
                    breakpoint
                };
                self.at(x, middle > breakpoint)
            }
            _ => self.at(x, true),
        }
    }
}

pub fn sum(terms: &[Term], x: f64, right: bool) -> [f64; 3] {
    terms.iter().fold([0.0; 3], |sum, term| {
        let term = term.at(x, right);
        [0, 1, 2].map(|i| sum[i] + term[i])
    })
}

/// Contact by its centre and half-width.
#[derive(Clone, Copy, Debug)]
pub struct On {
    pub centre: f64,
    pub half_width: f64,
}

impl On {
    pub fn x(&self, theta: f64) -> f64 {
        self.centre + self.half_width * theta.cos()
    }

    fn angle(&self, x: f64) -> Option<f64> {
        let z = (x - self.centre) / self.half_width;
        (z.abs() < 1.0).then(|| z.acos())
    }

    /// Calls `f` with θ, its weight, its distances from the two ends of its span, and the middle of
    /// this span.
    fn over(
        &self,
        terms: &[Term],
        at: Option<f64>,
        mut f: impl FnMut(f64, f64, [f64; 2], [f64; 2], f64),
    ) {
        let mut ends = vec![0.0, PI];
        for term in terms {
            ends.extend(term.breakpoint().and_then(|x| self.angle(x)));
            if let Tanh(_, w, x0) = *term {
                let near = [-20.0, -5.0, -1.0, 0.0, 1.0, 5.0, 20.0];
                ends.extend(near.iter().filter_map(|share| self.angle(x0 + share * w)));
            }
        }
        ends.extend(at);
        ends.sort_by(f64::total_cmp);
        for ends in ends.windows(2).filter(|ends| ends[0] < ends[1]) {
            let half = (ends[1] - ends[0]) / 2.0;
            let middle = self.x((ends[0] + ends[1]) / 2.0);
            const STEP: f64 = 1.0 / 24.0;
            for i in -90i32..=90 {
                let t = STEP * f64::from(i);
                let u = FRAC_PI_2 * t.sinh();
                let weight = STEP * half * FRAC_PI_2 * t.cosh() / u.cosh().powi(2);
                let q = (-2.0 * u.abs()).exp();
                let near = half * 2.0 * q / (1.0 + q);
                let away =
                    if u < 0.0 { [near, 2.0 * half - near] } else { [2.0 * half - near, near] };
                let theta = if u < 0.0 { ends[0] + away[0] } else { ends[1] - away[1] };
                f(theta, weight, away, [ends[0], ends[1]], middle);
            }
        }
    }

    /// Returns `(1/π) ∫ g dθ`, `(1/π) ∫ g cos θ dθ`, `(1/π) ∫ |g| dθ`.
    pub fn moments(&self, terms: &[Term]) -> [f64; 3] {
        let mut sums = [0.0; 3];
        self.over(terms, None, |theta, weight, _, _, middle| {
            let g: f64 = terms.iter().map(|term| term.on(self.x(theta), middle)[1]).sum();
            sums[0] += weight * g;
            sums[1] += weight * g * theta.cos();
            sums[2] += weight * g.abs();
        });
        sums.map(|sum| sum / PI)
    }

    /// Returns the pressure between free edges, for κ = 1, from the curvature.
    pub fn pressure(&self, terms: &[Term], x: f64) -> f64 {
        let Some(phi) = self.angle(x) else { return 0.0 };
        let kernel =
            |theta: f64, apart: f64| (((theta + phi) / 2.0).sin() / (apart / 2.0).sin()).abs().ln();
        let mut sum = 0.0;
        self.over(terms, Some(phi), |theta, weight, away, ends, middle| {
            let curvature: f64 = terms.iter().map(|term| term.on(self.x(theta), middle)[2]).sum();
            let apart = match ends {
                [from, _] if from == phi => away[0],
                [_, to] if to == phi => away[1],
                _ => theta - phi,
            };
            let term = weight * curvature * self.half_width * theta.sin() * kernel(theta, apart);
            sum += if term.is_finite() { term } else { 0.0 };
        });
        for term in terms {
            if let Jump(jump, breakpoint) = *term {
                sum +=
                    self.angle(breakpoint).map_or(0.0, |theta| jump * kernel(theta, theta - phi));
            }
        }
        sum / (PI * PI)
    }
}
