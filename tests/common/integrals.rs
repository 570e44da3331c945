//! Integrals over a pressure by tanh-sinh quadrature between the points where the pressure is not
//! smooth, and over a slope by the midpoint rule; shares no code with the crate.

use linecontact::Interval;
use std::f64::consts::PI;

/// Integrates over the contact in θ, by the tanh-sinh rule of Takahasi and Mori on panels that end
/// at the edges, the breakpoints and the pole.
pub fn integral(on: Interval<f64>, ends: &[f64], integrand: impl Fn(f64) -> f64) -> f64 {
    let angle = |x: f64| 2.0 * (on.right - x).sqrt().atan2((x - on.left).sqrt());
    let inside = ends.iter().filter(|&&x| on.contains(x));
    let mut angles: Vec<f64> = inside.map(|&x| angle(x)).collect();
    angles.extend([0.0, PI]);
    angles.sort_by(f64::total_cmp);
    let width = on.right - on.left;
    let place = |theta: f64| {
        let x = if theta < PI / 2.0 {
            on.right - width * (theta / 2.0).sin().powi(2)
        } else {
            on.left + width * ((PI - theta) / 2.0).sin().powi(2)
        };
        // At the edges themselves P sin θ may be inf times 0.
        x.clamp(on.left.next_up(), on.right.next_down())
    };
    const STEP: f64 = 1.0 / 32.0;
    let mut total = 0.0;
    for panel in angles.windows(2) {
        let half = (panel[1] - panel[0]) / 2.0;
        for i in -128i32..=128 {
            let t = STEP * f64::from(i);
            let u = PI / 2.0 * t.sinh();
            // Distance from the nearer end of the panel.
            let distance = half * (-u.abs()).exp() / u.cosh();
            let theta = if i < 0 { panel[0] + distance } else { panel[1] - distance };
            let weight = half * STEP * PI / 2.0 * t.cosh() / u.cosh().powi(2);
            let value = integrand(place(theta));
            if value.is_finite() {
                total += weight * value;
            }
        }
    }
    total
}

/// Returns `P sin θ` times the half-width at the rounded x: the integrand in θ.
pub fn strength(on: Interval<f64>, pressure: impl Fn(f64) -> f64) -> impl Fn(f64) -> f64 {
    move |x| pressure(x) * (x - on.left).sqrt() * (on.right - x).sqrt()
}

/// Returns `PV∫ P(s)/(x - s) ds`.
pub fn principal(
    on: Interval<f64>,
    breakpoints: &[f64],
    x: f64,
    pressure: impl Fn(f64) -> f64,
) -> f64 {
    let strength = strength(on, pressure);
    let at_x = strength(x);
    // PV∫ ds/((x - s) w(s)) is zero.
    integral(on, &[breakpoints, &[x]].concat(), |s| (strength(s) - at_x) / (x - s))
}

/// Returns `(1/π) ∫ g dθ` and `(1/π) ∫ g cos θ dθ` of a slope without breakpoints, by the midpoint
/// rule in θ: to rounding, if the slope is smooth on the scale of the contact.
pub fn edge_integrals(on: Interval<f64>, slope: impl Fn(f64) -> f64) -> [f64; 2] {
    const N: usize = 4000;
    (0..N).fold([0.0; 2], |[mean, first], i| {
        let cos = (PI * (i as f64 + 0.5) / N as f64).cos();
        let g = slope(on.centre() + on.half_width() * cos) / N as f64;
        [mean + g, first + g * cos]
    })
}
