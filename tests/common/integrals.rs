//! Integrals over a pressure by a rule that shares nothing with the crate: tanh-sinh, between the
//! places where the pressure is not smooth.

use std::f64::consts::{FRAC_PI_2, PI};

/// `∫ f dθ` from one angle to another; `f` may have singularities at both ends.
fn tanh_sinh(from: f64, to: f64, f: &mut dyn FnMut(f64) -> f64) -> f64 {
    const STEP: f64 = 1.0 / 32.0;
    let half = 0.5 * (to - from);
    let mut sum = 0.0;
    for i in -104i32..=104 {
        let t = STEP * f64::from(i);
        let u = FRAC_PI_2 * t.sinh();
        // From the nearer end, so that no place is rounded to it.
        let share = 2.0 / (1.0 + (2.0 * u.abs()).exp());
        let theta = if i < 0 { from + half * share } else { to - half * share };
        let weight = STEP * half * FRAC_PI_2 * t.cosh() / u.cosh().powi(2);
        if theta > from && theta < to {
            sum += weight * f(theta);
        }
    }
    sum
}

/// The contact `[-b, a]` by the angle: `x = c + L cos θ`.
#[derive(Clone, Copy)]
pub struct Angles {
    centre: f64,
    half_width: f64,
}

impl Angles {
    pub fn new(left: f64, right: f64) -> Self {
        Self { centre: 0.5 * (left + right), half_width: 0.5 * (right - left) }
    }

    fn angle(&self, x: f64) -> f64 {
        ((x - self.centre) / self.half_width).acos()
    }

    fn over(&self, breakpoints: &[f64], mut f: impl FnMut(f64) -> f64) -> f64 {
        let inside = |x: &&f64| (**x - self.centre).abs() < self.half_width;
        let mut ends: Vec<f64> =
            breakpoints.iter().filter(inside).map(|&x| self.angle(x)).collect();
        ends.extend([0.0, PI]);
        ends.sort_by(f64::total_cmp);
        ends.windows(2).map(|ends| tanh_sinh(ends[0], ends[1], &mut f)).sum()
    }

    /// `∫ P dx`.
    pub fn load(&self, breakpoints: &[f64], pressure: &dyn Fn(f64) -> f64) -> f64 {
        self.over(breakpoints, |theta| {
            self.half_width * theta.sin() * pressure(self.centre + self.half_width * theta.cos())
        })
    }

    /// `PV∫ P(s)/(x - s) ds`.
    pub fn principal(&self, breakpoints: &[f64], x: f64, pressure: &dyn Fn(f64) -> f64) -> f64 {
        let strength =
            |theta: f64| theta.sin() * pressure(self.centre + self.half_width * theta.cos());
        let phi = self.angle(x);
        let at_x = strength(phi);
        // PV∫ dθ/(cos φ - cos θ) is zero.
        let with_x = [breakpoints, &[x]].concat();
        self.over(&with_x, |theta| {
            let distance = 2.0 * (0.5 * (theta + phi)).sin() * (0.5 * (theta - phi)).sin();
            if distance == 0.0 { 0.0 } else { (strength(theta) - at_x) / distance }
        })
    }
}
