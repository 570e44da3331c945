//! Newton's method on both limits and the load at once.
//!
//! Three equations for `-b`, `a` and F, linear in what the quadrature says of a trial contact:
//!
//! ```text
//! at a:   F - κ L (m₁ + m₀) = π L K_a        or  a is given
//! at -b:  F - κ L (m₁ - m₀) = π L K_b        or  b is given
//! F is given,  or the half-width L is
//! ```
//!
//! with `K = 0` at a free edge and `π L K = -2 sqrt(κ w L)` at an adhesive one. (The tension `-P ≈
//! K_I/sqrt(2π d)` at a distance d from an edge has `K_I² = 2 E* w`, and `P ≈ K sqrt(L/2d)`;
//! κ = π E*/2. With a parabola this is the line contact of Johnson, Kendall and Roberts as Barquins
//! has it, *J. Adhesion* 26 (1988) 1.) The Jacobian is exact: the derivatives of `m₀` and `m₁` by
//! the limits come with them.
//!
//! A step in the half-width is taken as one in `L²`, in which the load of a round body is linear.

use super::edges::{Conditions, Control, Edge};
use crate::quadrature::{Engine, Moments};
use crate::{ContactError, Gap, Interval, Real};
use nalgebra::{Matrix3, Vector3};

/// Steps before the search is given up.
const MOST_STEPS: usize = 60;

/// A contact that meets its conditions.
#[derive(Clone, Copy)]
pub(super) struct Settled<T> {
    pub on: Interval<T>,
    pub load: T,
    /// Estimated error of the limits relative to the half-width.
    pub error: T,
    /// The load that such an error stands for.
    pub force: T,
}

/// How well a contact has to meet them.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Effort {
    /// To a few hundredths of its width, or until it is known to be much narrower than the start.
    Sketch,
    /// To rounding.
    Full,
}

/// Finds the limits from a start nearby; `None` where that fails.
pub(super) fn settle<T: Real>(
    engine: &mut dyn Engine<T>,
    gap: &Gap<'_, T>,
    conditions: &Conditions<T>,
    start: Interval<T>,
    effort: Effort,
) -> Result<Option<Settled<T>>, ContactError<T>> {
    let (one, half) = (T::one(), T::of(0.5));
    let range = gap.range();
    let mut on = conditions.with_given_limits(start);
    let mut load = conditions.load();
    let mut before: Option<T> = None;
    // A step that was cut short tells nothing of the next.
    let certain = |size: T| Some(size).filter(|&size| size <= T::of(0.25));
    for _ in 0..MOST_STEPS {
        let half_width = on.half_width();
        if !(half_width > T::zero() && half_width.is_finite()) {
            return Ok(None);
        }
        let m = engine.moments(gap, on)?;
        let Some(system) = System::new(conditions, on, load, &m) else { return Ok(None) };
        let Some(inverse) = system.jacobian.try_inverse() else { return Ok(None) };
        let step = inverse * system.residual;
        let [right, left] = [-step[0], -step[1]];
        if !((right - left).is_finite() && step[2].is_finite()) {
            return Ok(None);
        }
        load -= step[2] * system.scale;
        let size = right.abs() + left.abs();
        let before_move = on;
        on = conditions.moved(on, right, left);
        let back = |from: T, to: T, end: T, beyond: bool| {
            // Half the way, since the slope may be infinite at the very end of a body.
            if beyond { half * from + half * end } else { to }
        };
        let far = size > T::of(0.05);
        let allowed = if far { opening(engine, conditions, before_move, on) } else { on };
        let allowed = Interval {
            left: back(before_move.left, allowed.left, range[0], allowed.left < range[0]),
            right: back(before_move.right, allowed.right, range[1], allowed.right > range[1]),
        };
        if allowed != on {
            (on, before) = (allowed, None);
            continue;
        }
        let share = before.map_or(one, |before| size / before);
        let next = share * share * size;
        if effort == Effort::Sketch {
            if size <= T::of(0.03) || on.half_width() < T::of(1e-6) * start.half_width() {
                let sound = opens(engine, conditions, on) && system.is_stable(conditions);
                return Ok(sound.then_some(Settled { on, load, error: size, force: size }));
            }
            before = certain(size);
            continue;
        }
        let done = next <= half * T::epsilon() && size <= half * half;
        let slow = before.is_some() && share >= T::of(0.25);
        if done || slow {
            let noise = system.error(&inverse, &m);
            let rounding = [on.right, on.left].map(|x| T::epsilon() * x.abs() / on.half_width());
            let least = noise[0].max(noise[1]) + rounding[0].max(rounding[1]);
            let stalled = slow && size <= T::of(1e3) * least;
            if done || stalled {
                if !(opens(engine, conditions, on) && system.is_stable(conditions)) {
                    return Ok(None);
                }
                let left_over = (if stalled { one } else { share * share }) * half;
                // The noise is known from a few coefficients only.
                let error =
                    |i: usize| T::of(4.0) * (noise[i] + rounding[i]) + left_over * step[i].abs();
                let errors = [error(0), error(1)];
                let force = system.force(errors);
                // More doubt than this is no contact found.
                if errors[0].max(errors[1]) > T::of(0.03) {
                    return Ok(None);
                }
                return Ok(Some(Settled { on, load, error: errors[0].max(errors[1]), force }));
            }
        }
        before = certain(size);
    }
    Ok(None)
}

/// At an edge that is not fixed the bodies open: `g(a) > 0 > g(-b)`. A step that goes too far for
/// that is cut short, a tenth before the place where the slope changes its sign.
fn opening<T: Real>(
    engine: &dyn Engine<T>,
    conditions: &Conditions<T>,
    from: Interval<T>,
    to: Interval<T>,
) -> Interval<T> {
    let (zero, half) = (T::zero(), T::of(0.5));
    if is_pulled(conditions) {
        return to;
    }
    let cut = |from: T, to: T, sign: T| {
        let opens = |x: T| engine.slope(x).is_none_or(|slope| slope * sign > zero);
        if opens(to) || !opens(from) {
            return to;
        }
        let (mut open, mut closed) = (from, to);
        for _ in 0..40 {
            let middle = half * open + half * closed;
            if opens(middle) { open = middle } else { closed = middle }
        }
        open + T::of(0.1) * (from - open)
    };
    let [left, right] = conditions.edges.map(|edge| edge.limit());
    Interval {
        left: left.unwrap_or_else(|| cut(from.left, to.left, -T::one())),
        right: right.unwrap_or_else(|| cut(from.right, to.right, T::one())),
    }
}

/// Whether adhesion acts, under which the bodies need not open at the other edge either.
fn is_pulled<T: Real>(conditions: &Conditions<T>) -> bool {
    conditions.edges.iter().any(|edge| matches!(edge, Edge::Adhesive(_)))
}

/// Whether the bodies open at those edges of a contact that are free.
fn opens<T: Real>(engine: &dyn Engine<T>, conditions: &Conditions<T>, on: Interval<T>) -> bool {
    let opens = |x: T, sign: T| engine.slope(x).is_none_or(|slope| slope * sign >= T::zero());
    let [left, right] = &conditions.edges;
    is_pulled(conditions)
        || (!left.is_free() || opens(on.left, -T::one()))
            && (!right.is_free() || opens(on.right, T::one()))
}

/// The equations, linearised: rows for a, -b and the control; columns in units of the half-width
/// and of `scale`.
struct System<T> {
    jacobian: Matrix3<T>,
    residual: Vector3<T>,
    /// A force per unit length.
    scale: T,
    stiffness: T,
}

impl<T: Real> System<T> {
    fn new(conditions: &Conditions<T>, on: Interval<T>, load: T, m: &Moments<T>) -> Option<Self> {
        let (zero, one, half) = (T::zero(), T::one(), T::of(0.5));
        let trend = m.trend?;
        let half_width = on.half_width();
        let stiffness = conditions.kappa * half_width;
        let share = |scale: T| one / scale;
        let pull = |edge: &Edge<T>| match *edge {
            Edge::Adhesive(work) => (conditions.kappa * work * half_width).sqrt(),
            _ => zero,
        };
        let [pull_b, pull_a] = [pull(&conditions.edges[0]), pull(&conditions.edges[1])];
        let scale = load.abs() + stiffness * m.size + pull_a + pull_b;
        if !(scale > zero && scale.is_finite()) {
            return None;
        }
        let mut jacobian = Matrix3::zeros();
        let mut residual = Vector3::zeros();
        // Derivatives by centre and half-width, each times the half-width.
        let (scale_share, width_share) = (share(scale), share(half_width));
        let weight = stiffness * scale_share;
        let by_half_width = weight * half_width;
        for (row, sign, edge, pull) in
            [(0, one, &conditions.edges[1], pull_a), (1, -one, &conditions.edges[0], pull_b)]
        {
            match edge.limit() {
                Some(limit) => {
                    let x = if row == 0 { on.right } else { on.left };
                    jacobian[(row, row)] = one;
                    residual[row] = (x - limit) * width_share;
                }
                None => {
                    let carried = m.first + sign * m.mean;
                    residual[row] = (load + pull + pull) * scale_share - weight * carried;
                    let centre = -by_half_width * (trend.by_1 + sign * trend.by_0);
                    let width = -weight * carried + pull * scale_share
                        - by_half_width * (trend.by_2 + sign * trend.by_1);
                    jacobian[(row, 0)] = half * (centre + width);
                    jacobian[(row, 1)] = half * (centre - width);
                    jacobian[(row, 2)] = one;
                }
            }
        }
        match conditions.control {
            Control::Load(wanted) => {
                jacobian[(2, 2)] = one;
                residual[2] = (load - wanted) * scale_share;
            }
            Control::HalfWidth(wanted) => {
                jacobian[(2, 0)] = half;
                jacobian[(2, 1)] = -half;
                residual[2] = (half_width - wanted) * width_share;
            }
        }
        Some(Self { jacobian, residual, scale, stiffness })
    }

    /// Whether the contact grows with its load: where it does not, another does.
    fn is_stable(&self, conditions: &Conditions<T>) -> bool {
        let j = |row, column| self.jacobian[(row, column)];
        match (conditions.control, conditions.edges.map(|edge| edge.limit())) {
            (Control::Load(_), [None, None]) => j(0, 0) * j(1, 1) < j(0, 1) * j(1, 0),
            (Control::Load(_), [Some(_), None]) => j(0, 0) < T::zero(),
            (Control::Load(_), [None, Some(_)]) => j(1, 1) > T::zero(),
            _ => true,
        }
    }

    /// The load that moves the limits by so much of the half-width.
    fn force(&self, errors: [T; 2]) -> T {
        let row = |i: usize| {
            self.jacobian[(i, 0)].abs() * errors[0] + self.jacobian[(i, 1)].abs() * errors[1]
        };
        row(0).max(row(1)) * self.scale
    }

    /// What the error of the moments leaves open of `a` and of `-b`, in half-widths.
    fn error(&self, inverse: &Matrix3<T>, m: &Moments<T>) -> [T; 2] {
        let error = self.stiffness * m.error / self.scale;
        [0, 1].map(|i| error * (inverse[(i, 0)].abs() + inverse[(i, 1)].abs()))
    }
}
