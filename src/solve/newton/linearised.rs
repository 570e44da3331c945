//! The equations of one contact, linearised, and the step by them.
//!
//! There are three for `-b`, `a` and F, linear in the moments of a trial contact:
//!
//! ```text
//! at -b:  F - κ L (m₁ - m₀) = π L K_b        or  b is given
//! at a:   F - κ L (m₁ + m₀) = π L K_a        or  a is given
//! F is given,  or the half-width L is
//! ```
//!
//! with `K = 0` at a free edge and `π L K = -2 sqrt(κ w L)` at an adhesive one. (The tension `-P ≈
//! K_I/sqrt(2π d)` at a distance d from an edge has `K_I² = 2 E* w`, and `P ≈ K sqrt(L/2d)`;
//! κ = π E*/2. With a parabola this is the line contact of Johnson, Kendall and Roberts as Barquins
//! has it, *J. Adhesion* 26 (1988) 1.) The Jacobian is exact: the derivatives of `m₀` and `m₁` by
//! the limits come with them. The control settles one unknown beforehand, F or `a + b`; two are left.
//!
//! Where the load F is to act at a place x̄ the bodies turn by an angle τ, which adds τ to `m₀` and nothing to
//! `m₁` and `m₂`. It is eliminated: with the forces `Δ = F - κ L m₁` and `E = f (c - x̄)/L + κ L m₂/2`,
//!
//! ```text
//! both free:    Δ + E = 0 at -b,  Δ - E = 0 at a,   f = κ L m₁     then  τ = -m₀
//! a given:      Δ/2 + E = 0 at -b,                  f = F          then  τ = m₁ - F/(κ L) - m₀
//! -b given:     Δ/2 - E = 0 at a,                   f = F          then  τ = F/(κ L) - m₁ - m₀
//! both given:                                                      τ = m₂ - m₀ + 2 F (c - x̄)/(κ L²)
//! ```
//!
//! (With the load that a trial carries, and not F, `E` rises with c on every body that bulges, however far the
//! trial is off: by `κ L/2 (1/π) ∫ g' dθ`, since `m₁ = (L/π) ∫ g' sin² θ dθ`.)
//!
//! The derivatives of `m₂` are those of `m₀` and `m₁`: `L² ∂m₂/∂L = (L²/π) ∫ g' cos θ dθ - 2 L m₂`.
//!
//! A step in the half-width is taken as one in `L²`, in which the load of a round body is linear; a
//! long one as in the power of L that the load is seen to go with. The centre is taken along as the balance
//! `m₀ = 0` has it, `dc/dL` by its derivatives: where one limit is a million times as stiff as the other, it
//! stays where it is. The balance itself is linearised without the factor L that both rows have: that of a
//! parabola is linear in c, and one step leads to its centre from however far.

use super::super::edges::{Conditions, Given};
use crate::quadrature::Moments;
use crate::{Ends, Interval, Real, Side};
use nalgebra::{Matrix2, Vector2};

/// A step longer than so many half-widths leads nowhere.
const MOST_STEP: f64 = 1e9;

/// An interval with its limits moved by steps in units of the half-width, given the load as a share of
/// what it would carry. The half-width moves as its square would, by no more than a factor of 33 down or 4
/// up, and the centre with it, by `lean` for each unit, as the balance has it: one limit may be a million
/// times as stiff as the other.
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
        // Far off, the power of the half-width that the load goes with is read off the step: 2
        // for a round body, 1 for a wedge.
        let power = (one - share) / -asked;
        (share.powf(one / power) - one).max(T::of(-0.97))
    } else {
        let square = (one + asked + asked).max(T::of(1e-3));
        ((square - one) / (one + square.sqrt())).min(T::of(3.0))
    };
    match conditions.limits() {
        Ends { left: None, right: None } => {
            let along = match conditions.given {
                // Where the bodies turn the balance is another.
                Given::Centre { .. } => along.max(-one).min(one),
                _ => along + lean * (wider - asked),
            };
            let on = Interval {
                left: on.left + (along - wider) * half_width,
                right: on.right + (along + wider) * half_width,
            };
            match conditions.given {
                // Rounded where it was far from x = 0, the width that is given would stay so.
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

/// How large noise may be that is said to be so large. It is known from a few coefficients only; but
/// what a loose tolerance leaves open does not hide that a step is still too short.
pub(super) fn doubtful<T: Real>(noise: T) -> T {
    (T::of(1e3) * noise).min(T::epsilon().sqrt()).max(T::of(4.0) * noise)
}

/// The equations, linearised: rows for -b and a. Limits are in units of the half-width, forces in
/// those of `scale`.
pub(super) struct Linearised<T> {
    /// By -b and by a.
    jacobian: [[T; 2]; 2],
    residual: [T; 2],
    /// By the two unknowns: -b and a; or both at once and the load, where the half-width is given.
    matrix: Matrix2<T>,
    by_load: bool,
    /// Whether the difference of the rows is the balance.
    is_balance: bool,
    /// A force per unit length.
    scale: T,
    stiffness: T,
    /// By how much the bodies turn.
    pub tilt: T,
}

/// A step.
#[derive(Clone, Copy)]
pub(super) struct Step<T> {
    pub from: Interval<T>,
    load: T,
    /// The load that the contact it is taken from would carry.
    carried: T,
    /// By how much the centre goes with the half-width.
    lean: T,
    pub inverse: Matrix2<T>,
    /// Of force.
    unit: T,
    /// Of -b and of a, in half-widths.
    pub limits: [T; 2],
    force: T,
    /// How much of it is taken.
    pub share: T,
}

impl<T: Real> Step<T> {
    /// How long it is, in half-widths.
    pub fn size(&self) -> T {
        self.limits[0].abs() + self.limits[1].abs()
    }

    /// Where it leads, and under which load.
    pub fn end(&self, conditions: &Conditions<T>) -> (Interval<T>, T) {
        let load = self.load + self.share * self.force;
        let limits = self.limits.map(|step| self.share * step);
        (moved(conditions, self.from, self.lean, limits, load / self.carried), load)
    }

    /// Whether the next one would be longer by the same Jacobian.
    pub fn grew_to(&self, next: &Linearised<T>, on: Interval<T>) -> bool {
        let ([left, right, _], size) = (next.steps_of(on, self), self.size());
        // As far as rounding allows.
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
        let trend = m.derivatives?;
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
                let centre = -by_half_width * (trend.by_1 + sign * trend.by_0);
                let width = -weight * carried + pull * by_scale
                    - by_half_width * (trend.by_2 + sign * trend.by_1);
                let [away, own] = [half * (centre - sign * width), half * (centre + sign * width)];
                (residual, [away, own], one)
            }
        };
        let (at_b, [ba, bb], force_b) = row(-one, Side::Left);
        let (at_a, [ab, aa], force_a) = row(one, Side::Right);
        // The difference of the rows without their factor L: the change of that is taken off their derivatives.
        let is_balance = turning.is_none() && limits == Ends::both(None);
        let lean = if is_balance { T::of(0.25) * (at_a - at_b) } else { zero };
        let (jacobian, residual) = ([[bb - lean, ba + lean], [ab + lean, aa - lean]], [at_b, at_a]);
        let [[bb, ba], [ab, aa]] = jacobian;
        let matrix = match conditions.given {
            Given::Load(_) | Given::Centre { .. } => Matrix2::new(bb, ba, ab, aa),
            Given::HalfWidth(_) => Matrix2::new(ba + bb, force_b, aa + ab, force_a),
        };
        let by_load = !matches!(conditions.given, Given::HalfWidth(_));
        let tilt = conditions.tilt(on, m);
        Some(Self { jacobian, residual, matrix, by_load, is_balance, scale, stiffness, tilt })
    }

    /// The step from an interval; `None` where the limits do not act on the slope, as on a flat.
    pub fn step(&self, from: Interval<T>, load: T, carried: T) -> Option<Step<T>> {
        let inverse = self.matrix.try_inverse()?;
        let [left, right, force] = self.solve(&inverse, self.scale, self.residual);
        let size = (right - left).abs() + (right + left).abs();
        let leads = size <= T::of(MOST_STEP) && force.is_finite();
        let (lean, unit, share) = (self.lean(), self.scale, T::one());
        let limits = [left, right];
        leads.then_some(Step { from, load, carried, lean, inverse, unit, limits, force, share })
    }

    /// The steps of -b and of a, in half-widths, and that of the load, by a Jacobian in a unit of force.
    #[inline(always)]
    fn solve(&self, inverse: &Matrix2<T>, unit: T, [at_b, at_a]: [T; 2]) -> [T; 3] {
        let step = -(inverse * Vector2::new(at_b, at_a));
        if self.by_load {
            [step[0], step[1], T::zero()]
        } else {
            [step[0], step[0], step[1] * unit]
        }
    }

    /// The steps by the Jacobian of another contact.
    fn steps_of(&self, on: Interval<T>, other: &Step<T>) -> [T; 3] {
        let share = self.scale / other.unit;
        let [mut at_b, mut at_a] = self.residual.map(|residual| share * residual);
        if self.is_balance {
            // Which was linearised without the factor L.
            let wider = other.from.half_width() / on.half_width();
            let half = T::of(0.5);
            let [load, balance] = [half * (at_a + at_b), half * wider * (at_a - at_b)];
            [at_b, at_a] = [load - balance, load + balance];
        }
        self.solve(&other.inverse, other.unit, [at_b, at_a])
    }

    /// Returns the step as it is, however long; `None` where the limits do not act on the slope.
    pub fn last_step(&self) -> Option<[T; 3]> {
        let inverse = self.matrix.try_inverse()?;
        Some(self.solve(&inverse, self.scale, self.residual))
    }

    /// Tells whether less is carried than the load that is asked for.
    pub fn is_open(&self) -> bool {
        self.by_load && self.residual[0] + self.residual[1] > T::zero()
    }

    /// By how much the centre moves in balance for each unit of the half-width, `dc/dL`.
    pub fn lean(&self) -> T {
        let [[bb, ba], [ab, aa]] = self.jacobian;
        let [by_left, by_right] = [ab - bb, aa - ba];
        let lean = (by_left - by_right) / (by_left + by_right);
        if lean.is_finite() { lean.max(-T::one()).min(T::one()) } else { T::zero() }
    }

    /// Whether the contact grows with its load: where it does not, another does.
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

    /// Whether the conditions hold as well as the error of the moments and the rounding of the limits
    /// allow. (Small steps alone are no proof: a poor guess may creep.)
    pub fn is_met(&self, m: &Moments<T>, rounding: [T; 2]) -> bool {
        let left_open = (self.stiffness * m.error + self.force(rounding)) / self.scale;
        self.residual.iter().all(|residual| residual.abs() <= doubtful(left_open))
    }

    /// The load that moves the limits by so much of the half-width.
    pub fn force(&self, errors: [T; 2]) -> T {
        let row = |[b, a]: [T; 2]| b.abs() * errors[0] + a.abs() * errors[1];
        row(self.jacobian[0]).max(row(self.jacobian[1])) * self.scale
    }

    /// What the error of the moments leaves open of `-b` and of `a`, in half-widths.
    pub fn error(&self, inverse: &Matrix2<T>, m: &Moments<T>) -> [T; 2] {
        let error = self.stiffness * m.error / self.scale;
        let row = |i: usize| error * (inverse[(i, 0)].abs() + inverse[(i, 1)].abs());
        [row(0), row(usize::from(self.by_load))]
    }
}

/// The conditions of a load that acts at a given place, forces, with their derivatives by the centre and by
/// the half-width, each times the half-width.
struct Turning<T> {
    /// Δ, or Δ/2.
    load: [T; 3],
    /// E.
    moment: [T; 3],
}

impl<T: Real> Turning<T> {
    fn new(conditions: &Conditions<T>, at: T, on: Interval<T>, m: &Moments<T>) -> Option<Self> {
        let (half, trend, second) = (T::of(0.5), m.derivatives?, m.m2?);
        let (load, half_width) = (conditions.load(), on.half_width());
        let stiffness = conditions.kappa * half_width;
        let by_width = stiffness * half_width;
        // κ L m₁.
        let carried =
            [stiffness * m.m1, by_width * trend.by_1, stiffness * m.m1 + by_width * trend.by_2];
        let left = load - carried[0];
        let both_free = conditions.limits() == Ends::both(None);
        let (acting, load) = if both_free {
            (carried, [left, -carried[1], -carried[2]])
        } else {
            // A condition that was multiplied by the half-width.
            let row = [half * left, -half * carried[1], half * (left - carried[2])];
            ([load, T::zero(), T::zero()], row)
        };
        let arm = (on.centre() - at) / half_width;
        Some(Self {
            load,
            moment: [
                acting[0] * arm + half * stiffness * second,
                acting[0] + acting[1] * arm + by_width * (trend.by_2 - half * trend.by_0),
                acting[2] * arm + half * by_width * trend.by_1,
            ],
        })
    }

    /// What is asked of a free edge, positive where that must move outward: -b (negative sign) or a.
    fn row(&self, sign: T) -> [T; 3] {
        std::array::from_fn(|i| self.load[i] - sign * self.moment[i])
    }
}

/// The load of a contact of given width that has converged. By one more step, since the last was linear
/// only, and not from the moments alone: those of limits that are rounded close to a jump of the
/// slope are not those of a contact.
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
