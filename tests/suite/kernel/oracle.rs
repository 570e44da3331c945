//! Eq. (1) by sums that share nothing with the solver but the pressures.

use crate::integrals::{integral, strength};
use linecontact::{Base, Cost, Foundation, Interval, Layer, Material, Reference, Solution, Stack};
use std::f64::consts::PI;

/// σz, τ, X, Z and σx at a depth z of a displacement `(iX, Z) exp(ix)` that solves Navier's
/// equations: `exp(sz)` (k = 0) or `z exp(sz)` (k = 1) along x.
fn column(material: Material<f64>, s: f64, z: f64, k: usize) -> [f64; 5] {
    let Material::Elastic { youngs_modulus, poisson_ratio: nu } = material else {
        panic!("a rigid material")
    };
    // With the dilation `dw - x` over `1 - 2ν`, which has a limit.
    let ([x, dx, w, dw], dilation) = if k == 0 {
        ([1.0, s, s, 1.0], 0.0)
    } else {
        ([z, 1.0 + s * z, s * z - 3.0 + 4.0 * nu, s * (s * z - 2.0 + 4.0 * nu)], -2.0 * nu * s)
    };
    let shear = youngs_modulus / (2.0 * (1.0 + nu));
    [2.0 * shear * (dw + dilation), shear * (dx + w), x, w, 2.0 * shear * (dilation - x)]
        .map(|value| value * (s * z).exp())
}

/// Layers under a wave of pressure, with displacements matched at each base: four conditions a
/// layer and two more, solved by elimination. Lengths are in units of 1/ω.
struct Wave {
    /// Material, top and bottom of each layer.
    layers: Vec<(Material<f64>, [f64; 2])>,
    base: Base<f64>,
    unknowns: Vec<f64>,
}

const SOLUTIONS: [(f64, usize); 4] = [(-1.0, 0), (-1.0, 1), (1.0, 0), (1.0, 1)];

/// A layer, or several.
pub trait Layered {
    fn stack(&self) -> Stack<f64>;

    /// Thickness of the layer at the surface.
    fn thickness(&self) -> f64 {
        self.stack().layers[0].1
    }
}

impl Layered for Layer<f64> {
    fn stack(&self) -> Stack<f64> {
        Stack { layers: vec![(self.material, self.thickness)], base: self.base }
    }
}

impl Layered for Stack<f64> {
    fn stack(&self) -> Stack<f64> {
        self.clone()
    }
}

impl Wave {
    fn new(of: &impl Layered, wavenumber: f64) -> Self {
        let Stack { layers, base } = of.stack();
        let next = |top: &mut f64, (material, thickness): (Material<f64>, f64)| {
            let from = std::mem::replace(top, *top + wavenumber * thickness);
            Some((material, [from, *top]))
        };
        let layers: Vec<_> = layers.into_iter().scan(0.0, next).collect();
        let n = 4 * layers.len() + 2;
        let mut rows = vec![vec![0.0; n + 1]; n];
        let mut wave = Self { layers, base, unknowns: Vec::new() };
        rows[0][n] = -1.0;
        for (i, (_, [top, bottom])) in wave.layers.iter().enumerate() {
            for j in 0..4 {
                let (above, below) = (wave.own(i, j, *top), wave.own(i, j, *bottom));
                let conditions = if i == 0 { &above[..2] } else { &above[..4] };
                let first = if i == 0 { 0 } else { 4 * i - 2 };
                let sign = if i == 0 { 1.0 } else { -1.0 };
                for (row, value) in rows[first..].iter_mut().zip(conditions) {
                    row[4 * i + j] = sign * value;
                }
                for (row, value) in rows[4 * i + 2..].iter_mut().zip(&below[..4]) {
                    row[4 * i + j] = *value;
                }
            }
        }
        match base {
            Base::HalfPlane(base) => {
                for k in 0..2 {
                    let below = column(base, -1.0, 0.0, k);
                    for i in 0..4 {
                        rows[n - 4 + i][n - 2 + k] = -below[i];
                    }
                }
            }
            // X = Z = 0, or τ = Z = 0; the stresses left are unknowns of their own.
            Base::Frictionless => {
                (rows[n - 4][n - 2], rows[n - 2][n - 1]) = (1.0, 1.0);
            }
            _ => (rows[n - 4][n - 2], rows[n - 3][n - 1]) = (1.0, 1.0),
        }
        wave.unknowns = solved(rows);
        wave
    }

    /// Solution of a number in a layer; those that grow are measured at its bottom, the others at
    /// its top.
    fn own(&self, i: usize, j: usize, z: f64) -> [f64; 5] {
        let ((material, [top, bottom]), (s, k)) = (self.layers[i], SOLUTIONS[j]);
        let scale = if s > 0.0 { (top - bottom).exp() } else { 1.0 };
        column(material, s, z - top, k).map(|value| scale * value)
    }

    /// σz, τ, X, Z and σx at a depth, at an interface those above it.
    fn at(&self, z: f64) -> [f64; 5] {
        let mut sum = [0.0; 5];
        let mut add = |unknown: f64, column: [f64; 5]| {
            sum.iter_mut().zip(column).for_each(|(sum, value)| *sum += unknown * value);
        };
        let last = self.layers.len() - 1;
        let depth = self.layers[last].1[1];
        match self.base {
            Base::HalfPlane(base) if z > depth => (0..2).for_each(|k| {
                add(self.unknowns[4 * last + 4 + k], column(base, -1.0, z - depth, k));
            }),
            _ => {
                let i = self.layers[..last].partition_point(|(_, [_, bottom])| *bottom < z);
                (0..4).for_each(|j| add(self.unknowns[4 * i + j], self.own(i, j, z)));
            }
        }
        sum
    }
}

/// Compliance K(ω) of layers.
pub fn compliance(of: &impl Layered, wavenumber: f64) -> f64 {
    let Material::Elastic { youngs_modulus, poisson_ratio } = of.stack().layers[0].0 else {
        panic!("a rigid layer")
    };
    let surface = Wave::new(of, wavenumber).at(0.0)[3];
    surface * youngs_modulus / (1.0 - poisson_ratio * poisson_ratio) / 2.0
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
fn length(of: &impl Layered) -> f64 {
    let all: f64 = of.stack().layers.iter().map(|(_, thickness)| thickness).sum();
    all * compliance(of, 1e-6 / all).max(1.0)
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

/// Nodes in ω with the transform of the pressure there, times their weights, by a rule of its own:
/// short panels of three points (Gauss), the first ones alike, the others growing up to a width.
fn waves(
    loads: &[(usize, f64, f64)],
    [finest, widest, end]: [f64; 3],
) -> impl Iterator<Item = (f64, [f64; 2])> {
    let next = move |from: &f64| Some(from + finest.max(0.05 * from).min(widest));
    let starts = std::iter::successors(Some(0.0), next).take_while(move |from| *from < end);
    let rule = [(-0.6f64.sqrt(), 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.6f64.sqrt(), 5.0 / 9.0)];
    starts.flat_map(move |from| {
        let step = finest.max(0.05 * from).min(widest);
        rule.map(|(node, weight)| {
            let omega = from + 0.5 * step * (1.0 + node);
            (omega, transform(loads, omega).map(|part| 0.5 * step * weight * part))
        })
    })
}

/// Stress σx, σz, τ at places (x, depth), below the surface of a body with a layer, by a direct
/// sum, over all periods if there is one. The depths must not be small beside the thickness.
pub fn stresses(
    solution: &Solution<'_, f64>,
    layer: &Layer<f64>,
    places: &[[f64; 2]],
    period: Option<f64>,
) -> Vec<[f64; 3]> {
    let hull = solution.hull();
    let far = places.iter().fold(hull.right - hull.left, |far, [x, _]| {
        far.max((x - hull.left).abs()).max((x - hull.right).abs())
    });
    let shallowest = places.iter().fold(layer.thickness, |least, [_, depth]| least.min(*depth));
    let deepest = places.iter().fold(layer.thickness, |most, [_, depth]| most.max(*depth));
    let widest = 0.2 / far.max(deepest).max(layer.thickness);
    let rule = [(0.01 / length(layer)).min(widest), widest, 32.0 / shallowest];
    // The rule along x is exact for polynomials of twice as many terms.
    let loads = loads(solution, 100 + (16.0 / shallowest * (hull.right - hull.left)) as usize);
    let waves: Vec<_> = match period {
        None => waves(&loads, rule).collect(),
        Some(period) => {
            // The mean pressure is the limit of long waves: extrapolated, of the weight 1/2.
            let step = 2.0 * PI / period;
            let limit = [4.0, -6.0, 4.0, -1.0].into_iter().zip(1..);
            let limit = limit.map(|(weight, n)| (3e-4 * f64::from(n), 0.5 * weight));
            let others = (1..).map(|n| (step * f64::from(n), 1.0));
            let others = others.take_while(|(omega, _)| *omega < rule[2]);
            let of = |(omega, weight): (f64, f64)| {
                (omega, transform(&loads, omega).map(|part| step * weight * part))
            };
            limit.chain(others).map(of).collect()
        }
    };
    let mut sums = vec![[0.0; 3]; places.len()];
    for (omega, [re, im]) in waves {
        let wave = Wave::new(layer, omega);
        for (sum, [x, depth]) in sums.iter_mut().zip(places) {
            let [normal, shear, _, _, along] = wave.at(omega * depth);
            let (sin, cos) = (omega * x).sin_cos();
            // τ is i times a wave.
            let (re, im) = ((re * cos - im * sin) / PI, (re * sin + im * cos) / PI);
            *sum = [sum[0] + along * re, sum[1] + normal * re, sum[2] - shear * im];
        }
    }
    sums
}

/// Returns the largest residual of Eq. (1) at some places, as a share of the largest term; the
/// shares are those of both bodies in 1/E*. The bodies may have a period.
pub fn residual(
    solution: &Solution<'_, f64>,
    kappa: f64,
    layers: &[(f64, impl Layered)],
    period: Option<f64>,
    slope: impl Fn(f64) -> f64,
) -> f64 {
    // On a layer the pressure changes over its thickness.
    let thinnest = layers.iter().map(|(_, layer)| layer.thickness()).fold(f64::INFINITY, f64::min);
    let half_width = solution.intervals().iter().map(Interval::half_width).fold(0.0, f64::max);
    let nodes = 200 + 20 * (0.4 * half_width / thinnest) as usize;
    let loads = loads(solution, nodes);
    let excess = |omega: f64| -> f64 {
        layers.iter().map(|(share, layer)| share * (compliance(layer, omega) - 1.0)).sum()
    };
    let waves: Vec<_> = wavenumbers(&loads, solution.hull(), layers, period)
        .into_iter()
        .map(|(omega, [re, im])| (omega, excess(omega) * re, excess(omega) * im))
        .collect();
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

/// Lists wavenumbers with the transform of the pressure times their weights: those of the period,
/// if there is one.
fn wavenumbers(
    loads: &[(usize, f64, f64)],
    hull: Interval<f64>,
    layers: &[(f64, impl Layered)],
    period: Option<f64>,
) -> Vec<(f64, [f64; 2])> {
    if layers.is_empty() {
        return Vec::new();
    }
    let thinnest = layers.iter().map(|(_, layer)| layer.thickness()).fold(f64::INFINITY, f64::min);
    let end = 16.0 / thinnest;
    let Some(period) = period else {
        let finest = layers.iter().map(|(_, layer)| 0.01 / length(layer));
        let finest = finest.fold(f64::INFINITY, f64::min);
        let widest = (0.05 / thinnest).min(0.3 / (hull.right - hull.left));
        return waves(loads, [finest, widest, end]).collect();
    };
    let step = 2.0 * PI / period;
    let omegas = (1..).map(|n| step * f64::from(n)).take_while(|&omega| omega < end);
    omegas.map(|omega| (omega, transform(loads, omega).map(|part| step * part))).collect()
}

/// Real and imaginary part of `∫ P exp(-iωs) ds`.
fn transform(loads: &[(usize, f64, f64)], omega: f64) -> [f64; 2] {
    loads.iter().fold([0.0; 2], |[re, im], (_, s, load)| {
        [re + load * (omega * s).cos(), im - load * (omega * s).sin()]
    })
}

/// Returns the approach of the surface of a body at x to a reference, to the rigid base of its
/// layer, or with a period to its mean plane: that of a half-plane of the same material by the
/// pressures, and the rest by a sum over wavenumbers.
pub fn approach(
    solution: &Solution<'_, f64>,
    body: &Foundation<f64>,
    x: f64,
    reference: Reference<f64>,
    period: Option<f64>,
) -> f64 {
    let (material, layer) = match *body {
        Foundation::Layer(layer) => (layer.material, Some(layer)),
        Foundation::HalfPlane(material) => (material, None),
        _ => panic!("{body:?}"),
    };
    let Material::Elastic { youngs_modulus, poisson_ratio: nu } = material else { return 0.0 };
    let thickness = layer.map_or(f64::INFINITY, |layer| layer.thickness);
    let is_elastic = layer.is_none_or(|layer| matches!(layer.base, Base::HalfPlane(_)));
    let depth = match reference {
        Reference::Depth(depth) if is_elastic => depth,
        _ => thickness,
    };
    let kernel = |s: f64| match (period, reference) {
        (Some(period), _) => -2.0 * (2.0 * (PI * (x - s) / period).sin()).abs().ln(),
        (None, Reference::Length(length)) if layer.is_none() => 2.0 * (length / (x - s).abs()).ln(),
        _ => {
            let squares = depth * depth + (x - s).powi(2);
            (depth * depth / (x - s).powi(2)).ln_1p() - depth * depth / ((1.0 - nu) * squares)
        }
    };
    let pressure = solution.pressure().unwrap();
    let half_plane: f64 = solution.intervals().iter().fold(0.0, |sum, &on| {
        let density = |s: f64| {
            let is_inside = s > on.left && s < on.right && s != x;
            if is_inside { pressure.at(s).unwrap_or(0.0) * kernel(s) } else { 0.0 }
        };
        sum + integral(on, &[x], strength(on, density))
    });
    let compliance = 2.0 * (1.0 - nu * nu) / youngs_modulus;
    let half_plane = compliance / (2.0 * PI) * half_plane;
    let Some(layer) = layer else { return half_plane };
    let plain = |depth: f64| compliance * (1.0 + depth / (2.0 * (1.0 - nu))) * (-depth).exp();
    let loads = loads(solution, 200);
    let own = if let Reference::Length(length) = reference { length } else { depth };
    let far = loads.iter().fold(own, |far, (_, s, _)| far.max((x - s).abs()));
    let widest = 0.1 / far.max(thickness);
    let rule = [(0.01 / length(&layer)).min(widest), widest, 32.0 / thickness];
    let term = |omega: f64, [re, im]: [f64; 2], load: f64| {
        let (wave, (sin, cos)) = (Wave::new(&layer, omega), (omega * x).sin_cos());
        let here = re * cos - im * sin;
        let to = match (layer.base, reference) {
            _ if period.is_some() => 0.0,
            (Base::HalfPlane(_), Reference::Depth(_)) => here * wave.at(omega * depth)[3],
            (Base::HalfPlane(base), Reference::Length(length)) => {
                let Material::Elastic { youngs_modulus, poisson_ratio } = base else { panic!() };
                let compliance = 2.0 * (1.0 - poisson_ratio * poisson_ratio) / youngs_modulus;
                load * compliance * (-omega * length).exp()
            }
            _ => 0.0,
        };
        let below = if period.is_some() { 0.0 } else { plain(omega * depth) };
        (here * (wave.at(0.0)[3] - plain(0.0) + below) - to) / (PI * omega)
    };
    let rest: f64 = match period {
        Some(_) => {
            let waves = wavenumbers(&loads, solution.hull(), &[(1.0, layer)], period);
            waves.into_iter().map(|(omega, part)| term(omega, part, 0.0)).sum()
        }
        None => {
            let whole = [(0, 0.0, solution.load())];
            let waves = waves(&loads, rule).zip(waves(&whole, rule));
            waves.map(|((omega, part), (_, [load, _]))| term(omega, part, load)).sum()
        }
    };
    half_plane + rest
}
