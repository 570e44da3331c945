//! Eq. (1) by sums that share nothing with the solver but the pressures.

use linecontact::{Base, Cost, Interval, Layer, Material, Solution};
use std::f64::consts::PI;

/// Compliance K(ξ) of a layer by matching displacements of Navier's equations at its base, all of
/// the form `exp(±z)` and `z exp(±z)` times `exp(ix)`: six conditions, solved by elimination.
pub fn compliance(layer: &Layer<f64>, wavenumber: f64) -> f64 {
    let Material::Elastic { youngs_modulus: e1, poisson_ratio: n1 } = layer.material else {
        panic!("a rigid layer")
    };
    let depth = wavenumber * layer.thickness;
    // σz, τ, X and Z at a depth z, for one of the solutions.
    let column = |e: f64, nu: f64, s: f64, z: f64, k: usize| {
        let [x, dx, w, dw] = if k == 0 {
            [1.0, s, s, 1.0]
        } else {
            [z, 1.0 + s * z, s * z - 3.0 + 4.0 * nu, s * (s * z - 2.0 + 4.0 * nu)]
        };
        let shear = e / (2.0 * (1.0 + nu));
        let dilation = nu / (1.0 - 2.0 * nu) * (dw - x);
        [2.0 * shear * (dw + dilation), shear * (dx + w), x, w].map(|value| value * (s * z).exp())
    };
    let solutions = [(-1.0, 0), (-1.0, 1), (1.0, 0), (1.0, 1)];
    let mut rows = vec![vec![0.0; 7]; 6];
    for (j, (s, k)) in solutions.into_iter().enumerate() {
        let (top, bottom) = (column(e1, n1, s, 0.0, k), column(e1, n1, s, depth, k));
        // Those that grow are measured at the base.
        let scale = if s > 0.0 { (-depth).exp() } else { 1.0 };
        (rows[0][j], rows[1][j]) = (scale * top[0], scale * top[1]);
        for i in 0..4 {
            rows[2 + i][j] = scale * bottom[i];
        }
    }
    rows[0][6] = -1.0;
    match layer.base {
        Base::HalfPlane(Material::Elastic { youngs_modulus: e2, poisson_ratio: n2 }) => {
            for k in 0..2 {
                let below = column(e2, n2, -1.0, depth, k);
                for i in 0..4 {
                    rows[2 + i][4 + k] = -below[i] * depth.exp();
                }
            }
        }
        // X = Z = 0, or τ = Z = 0; the stresses left are unknowns of their own.
        Base::Frictionless => {
            (rows[2][4], rows[4][5]) = (1.0, 1.0);
        }
        _ => (rows[2][4], rows[3][5]) = (1.0, 1.0),
    }
    let unknowns = solved(rows);
    let surface: f64 = (0..4)
        .map(|j| {
            let (s, k) = solutions[j];
            let scale = if s > 0.0 { (-depth).exp() } else { 1.0 };
            unknowns[j] * scale * column(e1, n1, s, 0.0, k)[3]
        })
        .sum();
    surface * e1 / (1.0 - n1 * n1) / 2.0
}

fn solved(mut rows: Vec<Vec<f64>>) -> Vec<f64> {
    let n = rows.len();
    for i in 0..n {
        let pivot = (i..n).max_by(|&a, &b| rows[a][i].abs().total_cmp(&rows[b][i].abs())).unwrap();
        rows.swap(i, pivot);
        for j in 0..n {
            if j != i {
                let (factor, pivot) = (rows[j][i] / rows[i][i], rows[i].clone());
                rows[j].iter_mut().zip(pivot).for_each(|(a, b)| *a -= factor * b);
            }
        }
    }
    (0..n).map(|i| rows[i][n] / rows[i][i]).collect()
}

/// Longest length on which the compliance changes.
fn length(layer: &Layer<f64>) -> f64 {
    let at_zero = compliance(layer, 1e-6 / layer.thickness);
    layer.thickness * at_zero.max(1.0)
}

/// Nodes of a contact with `P w` there (Gauss-Chebyshev), times π/n.
fn loads(solution: &Solution<'_, f64>, nodes: usize) -> Vec<(usize, f64, f64)> {
    let pressure = solution.pressure().unwrap();
    let mut loads = Vec::new();
    for (i, on) in solution.intervals().iter().enumerate() {
        for k in 0..nodes {
            let x = on.at_angle(PI * (k as f64 + 0.5) / nodes as f64);
            // The pressures next to the limits hardly count, however uncertain.
            let estimate = pressure.estimate(x, &mut Cost::default()).unwrap();
            let strength = estimate.value * on.chebyshev_weight(x);
            loads.push((i, x, strength * PI / nodes as f64));
        }
    }
    loads
}

/// Returns the largest residual of Eq. (1) at some places, as a share of the largest term; the
/// shares are those of both bodies in 1/E*. The bodies may have a period.
pub fn residual(
    solution: &Solution<'_, f64>,
    kappa: f64,
    layers: &[(f64, Layer<f64>)],
    period: Option<f64>,
    slope: impl Fn(f64) -> f64,
) -> f64 {
    let nodes = 200;
    let loads = loads(solution, nodes);
    let mut waves = Vec::new();
    for (omega, weight) in wavenumbers(solution.hull(), layers, period) {
        let excess: f64 =
            layers.iter().map(|(share, layer)| share * (compliance(layer, omega) - 1.0)).sum();
        let (mut re, mut im) = (0.0, 0.0);
        for (_, s, load) in &loads {
            (re, im) = (re + load * (omega * s).cos(), im - load * (omega * s).sin());
        }
        waves.push((omega, weight * excess * re, weight * excess * im));
    }
    let cauchy = |x: f64| period.map_or(1.0 / x, |p| PI / p / (PI * x / p).tan());
    let (mut worst, mut size) = (0.0f64, 0.0f64);
    for on in solution.intervals() {
        // Between two nodes the rule for the principal value is that for a regular integral.
        for k in [nodes / 4, nodes / 2, 4 * nodes / 5] {
            let x = on.at_angle(PI * k as f64 / nodes as f64);
            let principal: f64 = loads.iter().map(|(_, s, load)| load * cauchy(x - s)).sum();
            let kernel: f64 =
                waves.iter().map(|(w, re, im)| re * (w * x).sin() + im * (w * x).cos()).sum();
            worst = worst.max((principal + kernel - kappa * slope(x)).abs());
            size = size.max(principal.abs()).max(kernel.abs());
        }
    }
    worst / size
}

/// Lists wavenumbers with their weights: those of the period, or a rule of its own, short panels of
/// three points (Gauss), everywhere alike.
fn wavenumbers(
    hull: Interval<f64>,
    layers: &[(f64, Layer<f64>)],
    period: Option<f64>,
) -> Vec<(f64, f64)> {
    let mut waves = Vec::new();
    if layers.is_empty() {
        return waves;
    }
    let thinnest = layers.iter().map(|(_, layer)| layer.thickness).fold(f64::INFINITY, f64::min);
    let end = 16.0 / thinnest;
    if let Some(period) = period {
        let step = 2.0 * PI / period;
        waves.extend((1..).map(|n| (step * f64::from(n), step)).take_while(|&(w, _)| w < end));
        return waves;
    }
    let finest = layers.iter().map(|(_, layer)| 0.01 / length(layer)).fold(f64::INFINITY, f64::min);
    let widest = (0.05 / thinnest).min(0.2 / (hull.right - hull.left));
    let mut from = 0.0;
    while from < end {
        let step = finest.max(0.05 * from).min(widest);
        for (node, weight) in
            [(-0.6f64.sqrt(), 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.6f64.sqrt(), 5.0 / 9.0)]
        {
            waves.push((from + 0.5 * step * (1.0 + node), 0.5 * step * weight));
        }
        from += step;
    }
    waves
}
