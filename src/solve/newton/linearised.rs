//! Linearised equations of one contact, and the step by them.
//!
//! There are three equations for `-b`, `a` and F, linear in the moments of a trial contact:
//!
//! ```text
//! at -b:  F - κ L (m₁ - m₀) = π L K_b        or  b is given
//! at a:   F - κ L (m₁ + m₀) = π L K_a        or  a is given
//! F is given,  or the half-width L is
//! ```
//!
//! with `K = 0` at a free edge and `π L K = -2 sqrt(κ w L)` at an adhesive one. (The tension
//! `-P ≈ K_I/sqrt(2π d)` at a distance d from an edge has `K_I² = 2 E* w`, and `P ≈ K sqrt(L/2d)`;
//! κ = π E*/2. For a parabola this is the line contact of Johnson, Kendall and Roberts as given by
//! Barquins, *J. Adhesion* 26 (1988) 1.) The Jacobian is exact: the quadrature gives the
//! derivatives of `m₀` and `m₁` by the limits. The control settles one unknown beforehand, F or
//! `a + b`; two are left.
//!
//! If the load F acts at a given place x̄, the bodies turn by an angle τ, which adds τ to `m₀` and
//! leaves `m₁` and `m₂` unchanged. It is eliminated: with the forces `Δ = F - κ L m₁` and
//! `E = f (c - x̄)/L + κ L m₂/2`,
//!
//! ```text
//! both free:  Δ + E = 0 at -b,  Δ - E = 0 at a,  f = κ L m₁
//! a given:    Δ/2 + E = 0 at -b,                 f = F
//! -b given:   Δ/2 - E = 0 at a,                  f = F
//! then        τ = m₂ - m₀ + 2 F (c - x̄)/(κ L²)
//! ```
//!
//! (Where limits are free τ is also -m₀, or follows from m₁; but so the rounding of a limit next to
//! a corner changes it to first order, and by m₂ to second order.)
//!
//! (With the load carried by a trial in place of F, `E` rises with c on every convex body, however
//! far off the trial is: by `κ L/2 (1/π) ∫ g' dθ`, since `m₁ = (L/π) ∫ g' sin² θ dθ`.)
//!
//! The derivatives of `m₂` follow from those of `m₀` and `m₁`:
//! `L² ∂m₂/∂L = (L²/π) ∫ g' cos θ dθ - 2 L m₂`.
//!
//! A step in the half-width is taken in `L²`, in which the load of a round body is linear; a long
//! step is taken in the power of L that the load seems to follow. The centre moves with L to keep
//! the balance `m₀ = 0`, by `dc/dL` from its derivatives: if one limit is a million times as stiff
//! as the other, it stays in place. The balance itself is linearised without the factor L that both
//! rows have: for a parabola it is linear in c, and one step leads to its centre from any distance.

use super::super::edges::{Conditions, Given};
use crate::quadrature::Moments;
use crate::{Ends, Interval, Real, Side};
use nalgebra::{Matrix2, Vector2};

/// Longest step that is taken, in half-widths: a longer one leads nowhere.
const LONGEST_STEP: f64 = 1e9;

/// Returns an interval with its limits moved by steps in half-widths, given the load as a share of
/// the carried load. The half-width changes as its square would, by a factor of 1/33 to 4. The
/// centre moves with it by `lean` per unit, to keep the balance: one limit may be a million times
/// as stiff as the other.
pub(super) fn moved<T: Real>(
    conditions: &Conditions<T>,
    on: Interval<T>,
    lean: T,
    [left, right]: [T; 2],
    share: T,
) -> Interval<T> {
    let (zero, one, half) = (T::zero(), T::one(), T::of(0.5));
    let half_width = on.half_width();
    let [along, asked] = [half * (right + left), half * (right - left)];
    let wider = if asked < T::of(-0.3) && share > zero && share < one {
        // Far off, the step shows the power of the half-width that the load follows: 2 for a round
        // body, 1 for a wedge.
        let power = (one - share) / -asked;
        (share.powf(one / power) - one).max(T::of(-0.97))
    } else {
        let square = (one + asked + asked).max(T::of(1e-3));
        ((square - one) / (one + square.sqrt())).min(T::of(3.0))
    };
    match conditions.limits() {
        Ends { left: None, right: None } => {
            let along = match conditions.given {
                // Bodies that turn have another balance.
                Given::Centre { .. } => along.max(-one).min(one),
                _ => along + lean * (wider - asked),
            };
            let on = Interval {
                left: on.left + (along - wider) * half_width,
                right: on.right + (along + wider) * half_width,
            };
            match conditions.given {
                // A given width that was rounded far from x = 0 would stay rounded.
                Given::HalfWidth(given)
                    if (on.half_width() - given).abs()
                        > T::epsilon() * (on.left.abs() + on.right.abs()) =>
                {
                    Interval { left: on.centre() - given, right: on.centre() + given }
                }
                _ => on,
            }
        }
        Ends { left, right } => Interval {
            left: left.unwrap_or(on.left - (wider + wider) * half_width),
            right: right.unwrap_or(on.right + (wider + wider) * half_width),
        },
    }
}

/// Returns an upper bound on the true noise, given its estimate from only a few coefficients. The
/// cap `sqrt(ε)` keeps a loose tolerance from hiding that a step is still too short.
pub(super) fn doubtful<T: Real>(noise: T) -> T {
    (T::of(1e3) * noise).min(T::epsilon().sqrt()).max(T::of(4.0) * noise)
}

/// Linearised equations: rows for -b and a. Limits are in half-widths, forces in units of `scale`.
pub(super) struct Linearised<T> {
    /// Derivatives of both rows by -b and by a.
    jacobian: [[T; 2]; 2],
    residual: [T; 2],
    /// Derivatives by the two unknowns: -b and a; or, with a given half-width, both limits at once
    /// and the load.
    matrix: Matrix2<T>,
    by_load: bool,
    /// True if the difference of the rows is the balance.
    is_balance: bool,
    /// Unit of force, per unit length.
    scale: T,
    stiffness: T,
}

/// Step from an interval and a load.
#[derive(Clone, Copy)]
pub(super) struct Step<T> {
    pub from: Interval<T>,
    load: T,
    /// Load that the contact at the start of the step would carry.
    carried: T,
    /// Shift of the centre per unit of the half-width.
    lean: T,
    pub inverse: Matrix2<T>,
    /// Unit of force of the Jacobian.
    unit: T,
    /// Steps of -b and of a, in half-widths.
    pub limits: [T; 2],
    force: T,
    /// Share of the step that is taken.
    pub share: T,
}

impl<T: Real> Step<T> {
    /// Returns the length of the step, in half-widths.
    pub fn size(&self) -> T {
        self.limits[0].abs() + self.limits[1].abs()
    }

    /// Returns the interval and the load at the end of the step.
    pub fn end(&self, conditions: &Conditions<T>) -> (Interval<T>, T) {
        let load = self.load + self.share * self.force;
        let limits = self.limits.map(|step| self.share * step);
        (moved(conditions, self.from, self.lean, limits, load / self.carried), load)
    }

    /// Tells whether the next step would be longer by the same Jacobian, as far as rounding shows.
    pub fn grew_to(&self, next: &Linearised<T>, on: Interval<T>) -> bool {
        let ([left, right, _], size) = (next.steps_of(on, self), self.size());
        let rounding = T::epsilon() * (on.left.abs() + on.right.abs());
        left.abs() + right.abs() >= size && size * on.half_width() > T::of(64.0) * rounding
    }
}

impl<T: Real> Linearised<T> {
    #[inline(always)]
    pub fn new(
        conditions: &Conditions<T>,
        on: Interval<T>,
        load: T,
        m: &Moments<T>,
    ) -> Option<Self> {
        let (zero, one, half) = (T::zero(), T::one(), T::of(0.5));
        let derivatives = m.derivatives?;
        let half_width = on.half_width();
        let stiffness = conditions.kappa * half_width;
        let pulls = conditions.edge_strengths(half_width);
        let scale = load.abs() + stiffness * m.l1_norm + pulls.right + pulls.left;
        if !(scale > zero && scale.is_finite()) {
            return None;
        }
        // Derivatives by centre and half-width, each times the half-width.
        let (by_scale, by_width) = (one / scale, one / half_width);
        let weight = stiffness * by_scale;
        let by_half_width = weight * half_width;
        let turning = match conditions.given {
            Given::Centre { at, .. } => Some(Turning::new(conditions, at, on, m)?),
            _ => None,
        };
        let limits = conditions.limits();
        let row = |sign: T, side: Side| match (limits[side], &turning) {
            (Some(limit), _) => ((on[side] - limit) * by_width, [zero, one], zero),
            (None, Some(turning)) => {
                let [residual, centre, width] = turning.row(sign).map(|x| x * by_scale);
                let [away, own] = [half * (centre - sign * width), half * (centre + sign * width)];
                (residual, [away, own], one)
            }
            (None, None) => {
                let pull = pulls[side];
                let carried = m.m1 + sign * m.m0;
                let residual = (load + pull + pull) * by_scale - weight * carried;
                let centre = -by_half_width * (derivatives.by_1 + sign * derivatives.by_0);
                let width = -weight * carried + pull * by_scale
                    - by_half_width * (derivatives.by_2 + sign * derivatives.by_1);
                let [away, own] = [half * (centre - sign * width), half * (centre + sign * width)];
                (residual, [away, own], one)
            }
        };
        let (at_b, [ba, bb], force_b) = row(-one, Side::Left);
        let (at_a, [ab, aa], force_a) = row(one, Side::Right);
        // The difference of the rows has no factor L: its derivative is taken off theirs.
        let is_balance = turning.is_none() && limits == Ends::both(None);
        let lean = if is_balance { T::of(0.25) * (at_a - at_b) } else { zero };
        let (jacobian, residual) = ([[bb - lean, ba + lean], [ab + lean, aa - lean]], [at_b, at_a]);
        let [[bb, ba], [ab, aa]] = jacobian;
        let matrix = match conditions.given {
            Given::Load(_) | Given::Centre { .. } => Matrix2::new(bb, ba, ab, aa),
            Given::HalfWidth(_) => Matrix2::new(ba + bb, force_b, aa + ab, force_a),
        };
        let by_load = !matches!(conditions.given, Given::HalfWidth(_));
        Some(Self { jacobian, residual, matrix, by_load, is_balance, scale, stiffness })
    }

    /// Returns the step from an interval; `None` if the limits do not act on the slope, as on a
    /// flat.
    pub fn step(&self, from: Interval<T>, load: T, carried: T) -> Option<Step<T>> {
        let inverse = self.matrix.try_inverse()?;
        let [left, right, force] = self.solve(&inverse, self.scale, self.residual);
        let size = (right - left).abs() + (right + left).abs();
        let leads = size <= T::of(LONGEST_STEP) && force.is_finite();
        let (lean, unit, share) = (self.lean(), self.scale, T::one());
        let limits = [left, right];
        leads.then_some(Step { from, load, carried, lean, inverse, unit, limits, force, share })
    }

    /// Returns the steps of -b and a, in half-widths, and of the load, by a Jacobian in a unit of
    /// force.
    #[inline(always)]
    fn solve(&self, inverse: &Matrix2<T>, unit: T, [at_b, at_a]: [T; 2]) -> [T; 3] {
        let step = -(inverse * Vector2::new(at_b, at_a));
        if self.by_load {
            [step[0], step[1], T::zero()]
        } else {
            [step[0], step[0], step[1] * unit]
        }
    }

    /// Returns the steps by the Jacobian of another contact.
    fn steps_of(&self, on: Interval<T>, other: &Step<T>) -> [T; 3] {
        let share = self.scale / other.unit;
        let [mut at_b, mut at_a] = self.residual.map(|residual| share * residual);
        if self.is_balance {
            // The balance was linearised without the factor L.
            let wider = other.from.half_width() / on.half_width();
            let half = T::of(0.5);
            let [load, balance] = [half * (at_a + at_b), half * wider * (at_a - at_b)];
            [at_b, at_a] = [load - balance, load + balance];
        }
        self.solve(&other.inverse, other.unit, [at_b, at_a])
    }

    /// Returns the step, however long; `None` if the limits do not act on the slope.
    pub fn last_step(&self) -> Option<[T; 3]> {
        let inverse = self.matrix.try_inverse()?;
        Some(self.solve(&inverse, self.scale, self.residual))
    }

    /// Tells whether the contact carries less than the required load.
    pub fn is_open(&self) -> bool {
        self.by_load && self.residual[0] + self.residual[1] > T::zero()
    }

    /// Returns the shift of the centre per unit of the half-width in balance, `dc/dL`.
    pub fn lean(&self) -> T {
        let [[bb, ba], [ab, aa]] = self.jacobian;
        let [by_left, by_right] = [ab - bb, aa - ba];
        let lean = (by_left - by_right) / (by_left + by_right);
        if lean.is_finite() { lean.max(-T::one()).min(T::one()) } else { T::zero() }
    }

    /// Tells whether the contact grows with its load; if it does not, another contact does.
    pub fn is_stable(&self, conditions: &Conditions<T>) -> bool {
        let [[bb, ba], [ab, aa]] = self.jacobian;
        let Ends { left, right } = conditions.limits();
        match (conditions.given, left, right) {
            (Given::HalfWidth(_), ..) | (_, Some(_), Some(_)) => true,
            (_, None, None) => aa * bb < ab * ba,
            (_, Some(_), None) => aa < T::zero(),
            (_, None, Some(_)) => bb > T::zero(),
        }
    }

    /// Tells whether the conditions hold to the error of the moments and the rounding of the
    /// limits. (Small steps alone prove nothing: a poor guess may creep.)
    pub fn is_met(&self, m: &Moments<T>, rounding: [T; 2]) -> bool {
        let left_open = (self.stiffness * m.error + self.force(rounding)) / self.scale;
        self.residual.iter().all(|residual| residual.abs() <= doubtful(left_open))
    }

    /// Returns the load that moves the limits by these errors, in half-widths.
    pub fn force(&self, errors: [T; 2]) -> T {
        let row = |[b, a]: [T; 2]| b.abs() * errors[0] + a.abs() * errors[1];
        row(self.jacobian[0]).max(row(self.jacobian[1])) * self.scale
    }

    /// Returns the errors of `-b` and `a`, in half-widths, due to the error of the moments.
    pub fn error(&self, inverse: &Matrix2<T>, m: &Moments<T>) -> [T; 2] {
        let error = self.stiffness * m.error / self.scale;
        let row = |i: usize| error * (inverse[(i, 0)].abs() + inverse[(i, 1)].abs());
        [row(0), row(usize::from(self.by_load))]
    }
}

/// Conditions of a load that acts at a given place: forces, with their derivatives by the centre
/// and by the half-width, each times the half-width.
struct Turning<T> {
    /// Force Δ; Δ/2 if a limit is given.
    load: [T; 3],
    /// Force E.
    moment: [T; 3],
}

impl<T: Real> Turning<T> {
    fn new(conditions: &Conditions<T>, at: T, on: Interval<T>, m: &Moments<T>) -> Option<Self> {
        let (half, derivatives, second) = (T::of(0.5), m.derivatives?, m.m2?);
        let (load, half_width) = (conditions.load(), on.half_width());
        let stiffness = conditions.kappa * half_width;
        let by_width = stiffness * half_width;
        // κ L m₁.
        let carried = [
            stiffness * m.m1,
            by_width * derivatives.by_1,
            stiffness * m.m1 + by_width * derivatives.by_2,
        ];
        let left = load - carried[0];
        let both_free = conditions.limits() == Ends::both(None);
        let (acting, load) = if both_free {
            (carried, [left, -carried[1], -carried[2]])
        } else {
            // This condition was multiplied by the half-width, whose derivative adds `left`.
            let row = [half * left, -half * carried[1], half * (left - carried[2])];
            ([load, T::zero(), T::zero()], row)
        };
        let arm = (on.centre() - at) / half_width;
        Some(Self {
            load,
            moment: [
                acting[0] * arm + half * stiffness * second,
                acting[0]
                    + acting[1] * arm
                    + by_width * (derivatives.by_2 - half * derivatives.by_0),
                acting[2] * arm + half * by_width * derivatives.by_1,
            ],
        })
    }

    /// Returns the residual at a free edge, -b (negative sign) or a; positive if it must move
    /// outward.
    fn row(&self, sign: T) -> [T; 3] {
        std::array::from_fn(|i| self.load[i] - sign * self.moment[i])
    }
}

/// Returns the load of a converged contact of given width. It takes one more step, since the last
/// one was only linear. The moments alone would not do: limits rounded close to a jump of the slope
/// have other moments than a contact.
pub(in super::super) fn load_of<T: Real>(
    conditions: &Conditions<T>,
    on: Interval<T>,
    load: T,
    m: &Moments<T>,
) -> T {
    let more = Linearised::new(conditions, on, load, m).and_then(|system| {
        let [.., more] = system.last_step()?;
        Some(load + more)
    });
    more.filter(|load| load.is_finite()).unwrap_or(load)
}
