//! Gauss-Legendre rules.

use crate::Real;
use std::f64::consts::PI;
use std::sync::LazyLock;

/// Largest number of nodes of a Gauss-Legendre rule.
pub(crate) const MAX_NODES: usize = 64;

/// Gauss-Legendre rule on [-1, 1].
pub(crate) struct GaussLegendre {
    pub n: usize,
    pub nodes: [f64; MAX_NODES],
    pub weights: [f64; MAX_NODES],
}

static RULES: LazyLock<[GaussLegendre; 7]> =
    LazyLock::new(|| [8, 16, 24, 32, 40, 48, MAX_NODES].map(GaussLegendre::new));

impl GaussLegendre {
    /// Returns the rule for a polynomial of n coefficients on a span with this tangent. The
    /// integrand has its poles at ±i/tangent, of an order that grows with n; this number of nodes
    /// leaves an error of 1e-15 (found by trial).
    pub fn suited<T: Real>(n: usize, tangent: T) -> &'static Self {
        let n = T::count(n);
        let needed = T::of(8.0) + T::of(0.7) * n + (T::of(14.0) + T::of(1.2) * n) * tangent;
        RULES.iter().find(|rule| T::count(rule.n) >= needed).unwrap_or(Self::finest())
    }

    /// Returns the rule for a first estimate.
    pub fn coarsest() -> &'static Self {
        &RULES[0]
    }

    /// Returns the rule of 16 nodes.
    pub fn sixteen() -> &'static Self {
        &RULES[1]
    }

    /// Returns the rule for points close by.
    pub fn finest() -> &'static Self {
        &RULES[RULES.len() - 1]
    }

    /// Computes the nodes, the zeros of the Legendre polynomial, by Newton's method.
    fn new(n: usize) -> Self {
        let mut rule = Self { n, nodes: [0.0; MAX_NODES], weights: [0.0; MAX_NODES] };
        for i in 0..n {
            let mut x = (PI * (i as f64 + 0.75) / (n as f64 + 0.5)).cos();
            let mut derivative = 1.0;
            for _ in 0..8 {
                let (mut p0, mut p1) = (1.0, x);
                for k in 2..=n {
                    let k = k as f64;
                    (p0, p1) = (p1, ((2.0 * k - 1.0) * x * p1 - (k - 1.0) * p0) / k);
                }
                derivative = n as f64 * (x * p1 - p0) / (x * x - 1.0);
                x -= p1 / derivative;
            }
            rule.nodes[i] = x;
            rule.weights[i] = 2.0 / ((1.0 - x * x) * derivative * derivative);
        }
        rule
    }
}
