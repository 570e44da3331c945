//! The five examples of the paper, with its own formulas.

use linecontact::{Curve, CurvePoint, ParametricProfile, Piecewise};
use std::f64::consts::PI;

/// Smooth curve of the paper: one formula and its range of k.
pub type Formula = Curve<f64, fn(f64) -> CurvePoint<f64>>;

fn formula(from: f64, to: f64, point: fn(f64) -> CurvePoint<f64>) -> Formula {
    Curve::new([from, to], point)
}

/// One of the two bodies of an example.
pub type Profile = Box<dyn ParametricProfile<f64>>;

fn smooth(from: f64, to: f64, point: fn(f64) -> CurvePoint<f64>) -> Profile {
    Box::new(formula(from, to, point))
}

fn joined(left: Formula, right: Formula) -> Profile {
    Box::new(Piecewise::new(vec![left, right]).expect("both pieces pass through the origin"))
}

/// Example of the paper: its bodies and the constant C of its load.
pub struct Example {
    pub lower: Profile,
    pub upper: Profile,
    pub c: f64,
}

/// Makes Example 1, Eqs. (27), (28).
pub fn one() -> Example {
    Example {
        lower: smooth(-2.0, 0.0, |k| {
            let x = k + 1.0;
            CurvePoint { x, y: -0.5 * x.asin(), dx: 1.0, dy: -0.5 / (1.0 - x * x).sqrt() }
        }),
        upper: smooth(-1.0 / 3.0, 1.0 / 3.0, |k| {
            let x = 3.0 * k;
            let root = (1.0 - x * x).sqrt();
            CurvePoint { x, y: 0.5 * x * root, dx: 3.0, dy: 1.5 * (1.0 - 2.0 * x * x) / root }
        }),
        c: 0.0,
    }
}

/// Makes Example 2, Eqs. (30), (31).
pub fn two() -> Example {
    Example {
        lower: smooth(-2.0, 2.0, |k| CurvePoint {
            x: 2.0 * k + 0.2,
            y: -36.0 * k * k,
            dx: 2.0,
            dy: -72.0 * k,
        }),
        upper: smooth(-2.0, 2.0, |k| CurvePoint {
            x: 3.0 * k + 0.2,
            y: 63.0 * k * k,
            dx: 3.0,
            dy: 126.0 * k,
        }),
        c: 128.0 * PI * PI / 25.0,
    }
}

/// Makes Example 3, Eqs. (33), (34). The ranges of k end at the folds of X.
pub fn three() -> Example {
    Example {
        lower: smooth(-1.353999702552852, 0.7911938540783813, |k| {
            let (s, c) = k.sin_cos();
            CurvePoint {
                x: 2.0 * c - 8.0 * k * c - 9.0 * s + 7.0 * k * s - 2.0,
                y: (15.0 * s + 9.0 * c - 15.0 * k * c - 6.0 * k * s - 9.0) * 1e5,
                dx: -17.0 * c + 5.0 * s + 8.0 * k * s + 7.0 * k * c,
                dy: (-15.0 * s + 15.0 * k * s - 6.0 * k * c) * 1e5,
            }
        }),
        upper: smooth(-1.428061671618955, 0.7623463067015128, |k| {
            let (s, c) = k.sin_cos();
            CurvePoint {
                x: 7.0 * s - 8.0 * c + 3.0 * k * c - 9.0 * k * s + 8.0,
                y: (35.0 * k * c - 35.0 * s - 30.0 * c + 10.0 * k * s + 30.0) * 1e5,
                dx: 10.0 * c - s - 3.0 * k * s - 9.0 * k * c,
                dy: (40.0 * s - 35.0 * k * s + 10.0 * k * c) * 1e5,
            }
        }),
        c: 300.0,
    }
}

/// Makes Example 4, Eqs. (35), (36). "X ≤ 0" holds on several ranges of k; the branch through k = 0
/// is meant.
pub fn four() -> Example {
    let left = formula(0.0, 5.540299783323928, |k| {
        let (s, c) = k.sin_cos();
        CurvePoint {
            x: 12.0 * c - 2.0 * s - 3.0 * k * c + 2.0 * k * s - 12.0,
            y: (7.11 * c + 0.63 * s - 0.63 * k * c - 7.83 * k * s - 7.11) * 1e6,
            dx: -10.0 * s - 5.0 * c + 3.0 * k * s + 2.0 * k * c,
            dy: (-14.94 * s + 0.63 * k * s - 7.83 * k * c) * 1e6,
        }
    });
    let right = formula(-1.5010288405450835, 0.0, |k| {
        let (s, c) = k.sin_cos();
        CurvePoint {
            x: 6.0 * c - 5.0 * s - 3.0 * k * c + 9.0 * k * s - 6.0,
            y: (0.7 * k * s - 5600.0 * k * k - 3.5 * k * k * c) * 1e5,
            dx: 3.0 * s - 8.0 * c + 3.0 * k * s + 9.0 * k * c,
            dy: (0.7 * s - 6.3 * k * c - 11200.0 * k + 3.5 * k * k * s) * 1e5,
        }
    });
    Example {
        lower: joined(left, right),
        upper: smooth(-1.317538157404613, 0.9495704265766943, |k| {
            let (s, c) = k.sin_cos();
            CurvePoint {
                x: 3.0 * s + 2.0 * k * c - k * s,
                y: (0.027 * k * c - 0.027 * s - 1.8 * c + 1.8) * 1e7,
                dx: 5.0 * c - s - 2.0 * k * s - k * c,
                dy: (1.8 * s - 0.027 * k * s) * 1e7,
            }
        }),
        c: 20.0,
    }
}

/// Makes Example 5, Eqs. (37), (38). The upper body uses k ≥ 0 on both sides; the right piece of
/// the lower body ends before the pole of the tangent at -π/2.
pub fn five() -> Example {
    let lower_left = formula(0.0, 0.5445944427356815, |k| {
        let (s, c, t) = (k.sin(), k.cos(), k.tan());
        let dt = 1.0 + t * t;
        CurvePoint {
            x: 5.0 * k * k * t * t - 2.0 * t - 3.0 * k * c,
            y: (2.08 * s + 6.50 * c * c - 2.08 * k * c - 6.50) * 1e7,
            dx: 10.0 * k * t * t + 10.0 * k * k * t * dt - 2.0 * dt - 3.0 * c + 3.0 * k * s,
            dy: (2.08 * k * s - 13.0 * s * c) * 1e7,
        }
    });
    let lower_right = formula(-1.57, 0.0, |k| {
        let (s, c, t) = (k.sin(), k.cos(), k.tan());
        let dt = 1.0 + t * t;
        CurvePoint {
            x: 7.0 * c - 2.0 * t - 5.0 * k * c + 6.0 * k * t - 7.0,
            y: 33600.0 * k * t - 33600000.0 * t * t + 53200.0 * k * k * c,
            dx: -7.0 * s - 2.0 * dt - 5.0 * c + 5.0 * k * s + 6.0 * t + 6.0 * k * dt,
            dy: 33600.0 * (t + k * dt) - 67200000.0 * t * dt + 106400.0 * k * c
                - 53200.0 * k * k * s,
        }
    });
    let upper_left = formula(0.0, 0.5418316060488749, |k| {
        let (s, c, t) = (k.sin(), k.cos(), k.tan());
        let dt = 1.0 + t * t;
        CurvePoint {
            x: 2.0 * c * c - 3.0 * t + 10.0 * k * k * t * t - 5.0 * k * c - 2.0,
            y: 9e6 * t * t * t - 200.0 * k * t * t - 300.0 * k * k * c,
            dx: -4.0 * s * c - 3.0 * dt + 20.0 * k * t * t + 20.0 * k * k * t * dt - 5.0 * c
                + 5.0 * k * s,
            dy: 2.7e7 * t * t * dt - 200.0 * t * t - 400.0 * k * t * dt - 600.0 * k * c
                + 300.0 * k * k * s,
        }
    });
    let upper_right = formula(0.0, 0.6113196849814056, |k| {
        let (s, c, t) = (k.sin(), k.cos(), k.tan());
        let dt = 1.0 + t * t;
        CurvePoint {
            x: 6.0 * t + 5.0 * k * c - 7.0 * k * t,
            y: (8.5 * k * c - 8.5 * s - 7.5 * c + 7.5) * 1e5,
            dx: 6.0 * dt + 5.0 * c - 5.0 * k * s - 7.0 * t - 7.0 * k * dt,
            dy: (7.5 * s - 8.5 * k * s) * 1e5,
        }
    });
    Example {
        lower: joined(lower_left, lower_right),
        upper: joined(upper_left, upper_right),
        c: 36.0,
    }
}
