//! A rough surface that repeats: the same in the example, the benches and the tests.

use linecontact::{Curve, CurvePoint, ParametricProfile};
use std::f64::consts::TAU;

/// Returns a surface of period 1 and root mean square slope 1 for the upper body: cosines of 4 to
/// `most` waves a period, their amplitudes as k^-1.3 (Hurst exponent 0.8), their phases k³ modulo
/// 2π, as good as random.
pub fn surface(most: u32) -> impl ParametricProfile<f64> {
    let waves = (4..=most).map(|k| {
        let k = f64::from(k);
        [k.powf(-1.3), TAU * k, (k * k * k).rem_euclid(TAU)]
    });
    let mut waves: Vec<[f64; 3]> = waves.collect();
    let square: f64 = waves.iter().map(|[height, rate, _]| 0.5 * (height * rate).powi(2)).sum();
    waves.iter_mut().for_each(|wave| wave[0] /= square.sqrt());
    Curve::new([0.0, 1.0], move |x: f64| {
        let [y, dy] = waves.iter().fold([0.0; 2], |[y, dy], &[height, rate, phase]| {
            let (sin, cos) = (rate * x + phase).sin_cos();
            [y - height * cos, dy + height * rate * sin]
        });
        CurvePoint { x, y, dx: 1.0, dy }
    })
}
