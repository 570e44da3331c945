//! The angle θ of `x = c + L cos θ` without a trigonometric function.
//!
//! The half-angle of a point is known from its distances to the two edges:
//! `cos θ/2 = sqrt((x + b)/2L)`, `sin θ/2 = sqrt((a - x)/2L)`. On a span with the middle θ_m let
//! `σ = tan((θ - θ_m)/2)`. Then
//!
//! ```text
//! x - x_m = -2 L σ (σ cos θ_m + sin θ_m)/(1 + σ²)          dθ = 2 dσ/(1 + σ²)
//! ```
//!
//! which keeps all digits of a distance within the span however short it is, and the integrand is
//! smooth: its only poles are at σ = ±i, and |σ| < 1.
//!
//! If digits of short distances are not needed, a polynomial is summed as a cosine series instead,
//! whose integrals over a span are differences of `sin kθ/k`.

use crate::numerics::chebyshev::MAX_SIZE;
use crate::numerics::gauss_legendre::GaussLegendre;
use crate::{Interval, Real};

/// Point of the contact, by the cosine and sine of half its angle.
#[derive(Clone, Copy)]
pub(crate) struct HalfAngle<T> {
    pub cos: T,
    pub sin: T,
}

impl<T: Real> HalfAngle<T> {
    pub fn of(on: Interval<T>, x: T) -> Self {
        let width = on.right - on.left;
        // At an edge itself a plain zero: the root has no derivative there.
        let share = |distance: T| {
            if distance > T::zero() { (distance / width).sqrt() } else { T::zero() }
        };
        Self { cos: share(x - on.left), sin: share(on.right - x) }
    }

    /// Returns cos θ.
    pub fn cosine(&self) -> T {
        (self.cos - self.sin) * (self.cos + self.sin)
    }

    /// Returns sin θ.
    pub fn sine(&self) -> T {
        (self.cos + self.cos) * self.sin
    }
}

/// Integrals of `cos kφ` over a span of φ; from 0 to θ they are θ and `sin kθ/k`.
pub(super) type Sines<T> = [T; MAX_SIZE + 2];

impl<T: Real> HalfAngle<T> {
    /// Returns the integrals from 0 to θ, up to k = `count - 1`.
    pub fn sines(&self, count: usize) -> Sines<T> {
        let two = T::of(2.0);
        let mut sines = [T::zero(); MAX_SIZE + 2];
        sines[0] = two * self.sin.atan2(self.cos);
        let twice = two * self.cosine();
        let (mut before, mut sine) = (T::zero(), self.sine());
        for (k, integral) in sines[1..count].iter_mut().enumerate() {
            *integral = sine / T::count(k + 1);
            (before, sine) = (sine, twice * sine - before);
        }
        sines
    }
}

/// Span of a contact, by the angles of its ends.
pub(crate) struct Arc<T> {
    /// Middle of the span: cos θ_m and sin θ_m.
    pub cos: T,
    sin: T,
    /// Value of σ at the left end; at the right end it is the negative.
    pub tangent: T,
    /// Width of the contact.
    pub width: T,
    /// Distance `x_left - x_m`.
    pub to_left: T,
}

impl<T: Real> Arc<T> {
    /// Returns the span from `left` to `right`, given by half-angles, in a contact of a given
    /// width.
    pub fn new(length: T, left: HalfAngle<T>, right: HalfAngle<T>, width: T) -> Self {
        let cos = left.cos * right.cos - left.sin * right.sin;
        let sin = left.sin * right.cos + left.cos * right.sin;
        let half_sine = length / (width * sin);
        let half_cosine = left.cos * right.cos + left.sin * right.sin;
        let tangent = half_sine / (T::one() + half_cosine);
        let mut arc = Self { cos, sin, tangent, width, to_left: T::zero() };
        arc.to_left = arc.beside_middle(tangent).0;
        arc
    }

    /// Returns `x - x_m` and dθ/dσ at σ.
    #[inline(always)]
    fn beside_middle(&self, sigma: T) -> (T, T) {
        let turn = T::one() / (T::one() + sigma * sigma);
        (-self.width * sigma * (sigma * self.cos + self.sin) * turn, turn + turn)
    }

    /// Returns `x - x_m` and dθ/σ at W nodes of a rule over the span, with σ at its end.
    #[inline(always)]
    pub fn nodes<const W: usize>(&self, rule: &GaussLegendre, block: usize) -> [[T; W]; 2] {
        let [mut y, mut weight] = [[T::zero(); W]; 2];
        for i in 0..W {
            let node = block * W + i;
            let turn;
            (y[i], turn) = self.beside_middle(self.tangent * T::of(rule.nodes[node]));
            weight[i] = T::of(rule.weights[node]) * turn;
        }
        [y, weight]
    }
}
