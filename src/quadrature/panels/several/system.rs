//! The step of Newton's method: all limits from one unknown for each contact.
//!
//! A step δ of the limits changes V by `W(x) = -Σ ω_e/(x - e)`, with `ω_e = V(e) δ_e/2`. With
//! `r = S²/p²`, the function `Q = r W` is finite at the limits. Its poles are the zeros of p, where
//! the balance makes W known, and the corners z:
//!
//! ```text
//! Q(x) = Σ_k C_k/(x - ν_k) - Σ_k V(ν_k) A_k/(x - ν_k)² + q(x)      A_k = S²/p_k² at ν_k
//! q(x) = C + D (x - c), D = ∫ w p g ds                              without corners
//! q(x) = Σ C_z/(x - z)                                              with corners
//! δ_e = -2 Q(e)/(r'(e) V(e))
//! ```
//!
//! So every Q meets all conditions of balance. Its N constants follow from the N others, which it
//! changes by
//!
//! ```text
//! of a gap:     -(1/π) ∫ (p/S Q + S/p V(ν_k)) dx
//! of the load:  -(C + 2 ρ₁ D)/π without corners, with ρ₁ of Several::afar, else -Σ C/π
//! ```
//!
//! With poles μ of p W has the further terms `-π δc/(x - μ)`, with as many conditions more
//!
//! ```text
//! Q(μ) = 0        δc = -Q'(μ)/(π A)        A = S²/p_k² at μ
//! ```
//!
//! and with n > N corners at infinity the step of the load F, `-π δF`:
//!
//! ```text
//! Σ C = 0        -(Σ C_z (z - x₀) + Σ C_k (ν_k - x₀) - Σ V(ν_k) A_k)/π = δF
//! ```
//!
//! A gap acts on another by the inverse square of their distance: next to its pole, `p/S` is odd.

use super::terms::Terms;
use crate::Real;
use crate::numerics::{Combine, FarField, LinearSystem, dot};

/// Conditions on the free limits, from left to right, linearised.
#[derive(Clone)]
pub(crate) struct System<T> {
    /// Residual of each condition: balance, load, gaps, and the condition besides.
    pub residual: Vec<T>,
    /// Uncertainty of each residual, by quadrature and rounding.
    pub open: Vec<T>,
    /// Gap so narrow that the rounding of the heights moves it by more than its width.
    pub lost: Option<usize>,
    /// Number of the load condition, after those of balance.
    pub load_row: usize,
    /// Numbers of the free limits, rising.
    pub free: Vec<usize>,
    /// Limits, from left to right.
    pub(super) limits: Vec<T>,
    /// V at the limits, signed as where the pressure next to them is positive.
    pub(super) at_ends: Vec<T>,
    /// Slopes of r at the limits.
    pub(super) slopes: Vec<T>,
    /// Parts of V by the contacts far from each gap.
    pub(super) far: FarField<T>,
    /// Changes of the gaps by a tilt of the bodies.
    pub(super) by_tilt: Vec<T>,
    pub(super) poles: Poles<T>,
    /// Polynomial part of `p/S`, with the poles of p.
    pub(super) polynomial: Terms<T>,
    /// Changes of the load and of each gap, a row for each: by the constants, by V at the zeros,
    /// and by D.
    pub(super) rows: Vec<T>,
    pub(super) besides: Option<Besides<T>>,
    linear: LinearSystem<T>,
    /// Room for a row, and for the constants and the known part of Q.
    pub(super) row: Vec<T>,
    known: Vec<T>,
}

/// Poles of Q.
#[derive(Clone)]
pub(super) struct Poles<T> {
    /// Zeros of p, then corners.
    pub at: Vec<T>,
    /// `A_k` of each zero; 0 for a corner.
    pub squares: Vec<T>,
    /// Center c; `None` with corners.
    pub centre: Option<T>,
    /// Poles of p, each with its `A`.
    pub of_p: Vec<[T; 2]>,
}

/// Condition for an unknown besides the limits.
#[derive(Clone)]
pub(super) struct Besides<T> {
    /// Derivatives of the condition by the limits and by the unknown.
    pub by_limits: Vec<T>,
    pub by_unknown: T,
    /// Derivatives of all other conditions by the unknown; then the steps that make up for them.
    pub others: Vec<T>,
}

impl<T: Real> Poles<T> {
    /// Returns the number of constants.
    pub fn count(&self) -> usize {
        self.at.len() + usize::from(self.centre.is_some())
    }

    /// Returns the step of the residue at a pole of p, from the constants and the known part of Q.
    fn residue(&self, [x, square_at_pole]: [T; 2], known: &[T]) -> T {
        let (constants, values) = known.split_at(self.count());
        let poles = self.at.iter().zip(&self.squares).zip(constants.iter().zip(values));
        let fall = poles.fold(T::zero(), |sum, ((&at, &square), (&constant, &value))| {
            let away = T::one() / (x - at);
            sum + away * away * (constant - (square + square) * value * away)
        });
        fall / (T::pi() * square_at_pole)
    }

    /// Adds a share of Q at a place to a row.
    pub fn add(&self, x: T, share: T, row: &mut [T]) {
        let (by_constants, by_known) = row.split_at_mut(self.count());
        let both = by_constants.iter_mut().zip(by_known.iter_mut());
        for ((by_constant, by_zero), (&at, &square)) in both.zip(self.at.iter().zip(&self.squares))
        {
            let away = T::one() / (x - at);
            let by_pole = share * away;
            *by_constant += by_pole;
            *by_zero -= square * by_pole * away;
        }
        if let Some(centre) = self.centre {
            by_constants[self.at.len()] += share;
            by_known[self.at.len()] += share * (x - centre);
        }
    }

    /// Returns Q at a place for given constants and a given known part.
    fn value(&self, x: T, known: &[T]) -> T {
        let (constants, values) = known.split_at(self.count());
        let poles = self.at.iter().zip(&self.squares).zip(constants.iter().zip(values));
        let sum = poles.fold(T::zero(), |sum, ((&at, &square), (&constant, &value))| {
            let away = T::one() / (x - at);
            sum + away * (constant - square * value * away)
        });
        let last = self.at.len();
        self.centre.map_or(sum, |centre| sum + constants[last] + values[last] * (x - centre))
    }
}

impl<T: Real> System<T> {
    pub fn new() -> Self {
        let [residual, open, limits, at_ends, slopes, by_tilt] = Default::default();
        let [at, squares, rows, row, known] = Default::default();
        let (free, of_p) = (Vec::new(), Vec::new());
        let (far, linear) = (FarField::new(Combine::Sum), LinearSystem::new());
        Self {
            residual,
            open,
            lost: None,
            load_row: 0,
            free,
            limits,
            at_ends,
            slopes,
            far,
            by_tilt,
            poles: Poles { at, squares, centre: None, of_p },
            polynomial: Terms::none(),
            rows,
            besides: None,
            linear,
            row,
            known,
        }
    }

    /// Adds a condition: its residual, and its uncertainty.
    pub(super) fn add(&mut self, residual: T, open: T) {
        self.residual.push(residual);
        self.open.push(open);
    }

    /// Prepares for steps; `false` if the limits do not follow from the conditions.
    pub fn factor(&mut self) -> bool {
        let n = self.poles.count();
        let is_regular = self.linear.factor(self.rows.chunks_exact(2 * n).map(|row| &row[..n]));
        if let (true, Some(mut besides)) = (is_regular, self.besides.take()) {
            let others = std::mem::take(&mut besides.others);
            self.solve(&others, &mut besides.others);
            self.besides = Some(besides);
        }
        is_regular
    }

    /// Computes the step against the residuals: of the free limits, of the residues at the poles of
    /// p, and of the unknown besides.
    pub fn step(&mut self, step: &mut Vec<T>) {
        let residual = std::mem::take(&mut self.residual);
        self.solve(&residual, step);
        self.residual = residual;
    }

    /// Computes the step against these values of the conditions.
    pub fn solve(&mut self, values: &[T], step: &mut Vec<T>) {
        let Self { poles, row, known, .. } = self;
        let n = poles.count();
        let (balance, others) = values.split_at(self.load_row);
        let rows = self.rows.chunks_exact(2 * n);
        let besides = others.get(rows.len()).map_or(T::zero(), |&value| value);
        row.clear();
        row.extend(
            rows.zip(others).map(|(row, &value)| value + dot(&row[n..n + balance.len()], balance)),
        );
        // The constants with the sign of a step, so the known part of Q, too.
        self.linear.solve(row, known);
        known.extend(balance.iter().map(|&value| -value));
        known.resize(2 * n, T::zero());
        step.clear();
        step.extend(self.free.iter().map(|&i| {
            let by_limit = -T::of(2.0) / (self.slopes[i] * self.at_ends[i]);
            by_limit * poles.value(self.limits[i], known)
        }));
        step.extend(poles.of_p.iter().map(|&pole| poles.residue(pole, known)));
        if let Some(Besides { by_limits, by_unknown, others }) = &self.besides {
            let open = besides - dot(by_limits, step);
            let unknown = open / (*by_unknown - dot(by_limits, others));
            step.iter_mut().zip(others).for_each(|(step, &by)| *step -= unknown * by);
            step.push(unknown);
        }
    }
}
