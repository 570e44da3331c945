//! Integrals of the pressure times a kernel that may be steep above one point of the contact.
//!
//! ```text
//! ∫ P(s) K(x - s) ds = ∫ P w K(x - s) dθ,   s = c + L cos θ,   w = sqrt((s + b)(a - s))
//! ```
//!
//! `P w` is bounded at every kind of edge. The angle is split at the joints and at the point of the
//! contact nearest to x, and each panel is halved until Gauss's rule of 16 nodes agrees with itself
//! on the two halves to `ε^(3/4)` of the integral of the absolute value. Where the integrand is
//! smooth the result is then good to rounding; beside a kink, where the panels shrink towards it,
//! to about the tolerance.
//!
//! Angles are counted from that of x, so that the distance `x - s` keeps its relative accuracy
//! however close the two are, and with it a kernel as narrow as wanted.

use crate::quadrature::Gauss;
use crate::{ContactError, Interval, Pressure, Real, Solution};

/// Nodes of a panel.
const NODES: usize = 16;

/// Panels beyond those between the joints before an integral is given up.
const MOST_PANELS: usize = 20_000;

/// The pressure of a contact, ready to be integrated.
pub(crate) struct Integrals<'p, T: Real> {
    pub pressure: Pressure<'p, T>,
    /// Of the contact, rising.
    pub joints: Vec<T>,
    /// Whether `P w` vanishes at a and at -b.
    free: [bool; 2],
}

impl<'p, T: Real> Integrals<'p, T> {
    pub fn new(solution: &'p Solution<'_, T>) -> Result<Self, ContactError<T>> {
        let on = solution.interval();
        let joints = solution.gap().joints(on).collect();
        let free = solution.found().free;
        Ok(Self { pressure: solution.pressure()?, joints, free })
    }

    /// `∫ K dθ` for kernels that are given `x - s` and `P w`.
    pub fn over<const N: usize>(
        &self,
        x: T,
        kernel: impl Fn(T, T) -> [T; N],
    ) -> Result<[T; N], ContactError<T>> {
        self.over_as_of(T::zero(), x, kernel)
    }

    /// The same to no more than the tolerance of an integral of this size: for a kernel that may be
    /// the rounding of a difference and nothing else.
    pub fn over_as_of<const N: usize>(
        &self,
        least: T,
        x: T,
        kernel: impl Fn(T, T) -> [T; N],
    ) -> Result<[T; N], ContactError<T>> {
        let view = View::new(self.pressure.interval(), x);
        let mut pending = Vec::new();
        let (mut total, mut size) = ([T::zero(); N], [T::zero(); N]);
        for ends in view.ends(&self.joints).windows(2) {
            let panel = self.panel(&view, [ends[0], ends[1]], &kernel)?;
            add(&mut size, &panel.size);
            pending.push(panel);
        }
        let tolerance = T::epsilon().powf(T::of(0.75));
        // Below the least normal number, which is about that, there are fewer digits.
        let least = T::max_value().map_or(least, |max| least.max(max.recip()));
        let mut left = MOST_PANELS;
        while let Some(panel) = pending.pop() {
            let [from, to] = panel.ends;
            let middle = T::of(0.5) * (from + to);
            let halves = [
                self.panel(&view, [from, middle], &kernel)?,
                self.panel(&view, [middle, to], &kernel)?,
            ];
            let noise = self.noise(view.place(middle, self.free).0);
            let mut agreed = true;
            let mut refined = [T::zero(); N];
            for i in 0..N {
                refined[i] = halves[0].sum[i] + halves[1].sum[i];
                size[i] += halves[0].size[i] + halves[1].size[i] - panel.size[i];
                let allowed = tolerance * size[i].max(least) + noise * panel.size[i];
                agreed &= (refined[i] - panel.sum[i]).abs() <= allowed;
            }
            if agreed {
                add(&mut total, &refined);
                continue;
            }
            if left == 0 {
                return Err(ContactError::Integral { x, panels: MOST_PANELS });
            }
            left -= 1;
            pending.extend(halves);
        }
        Ok(total)
    }

    /// What the rounding of s makes of the pressure beside a joint, where it may go like a
    /// logarithm: no halving mends that.
    fn noise(&self, s: T) -> T {
        let Interval { left, right } = self.pressure.interval();
        let mut distance = right - left;
        let next = self.joints.partition_point(|&joint| joint < s);
        for joint in &self.joints[next.saturating_sub(1)..self.joints.len().min(next + 1)] {
            distance = distance.min((s - *joint).abs());
        }
        let rounding = T::of(0.25) * T::epsilon() * s.abs();
        if distance > rounding { rounding / distance } else { T::one() }
    }

    fn panel<const N: usize>(
        &self,
        view: &View<T>,
        ends: [T; 2],
        kernel: &impl Fn(T, T) -> [T; N],
    ) -> Result<Panel<T, N>, ContactError<T>> {
        let half = T::of(0.5) * (ends[1] - ends[0]);
        let rule = Gauss::sixteen();
        let zero = [T::zero(); NODES];
        let (mut s, mut distance, mut share) = (zero, zero, zero);
        for i in 0..NODES {
            // From the nearer end, since either may be at x.
            let node = T::of(rule.nodes[i]);
            let turn = if node < T::zero() {
                ends[0] + half * (T::one() + node)
            } else {
                ends[1] - half * (T::one() - node)
            };
            (s[i], distance[i], share[i]) = view.place(turn, self.free);
        }
        let mut pressure = [T::zero(); NODES];
        self.pressure.values(&s, &mut pressure)?;
        let mut panel = Panel { ends, sum: [T::zero(); N], size: [T::zero(); N] };
        for i in 0..NODES {
            // A node may have been rounded to the joint where the pressure is infinite.
            if !pressure[i].is_finite() {
                continue;
            }
            let terms = kernel(distance[i], share[i] * pressure[i] * view.on.edge_root(s[i]));
            let weight = T::of(rule.weights[i]) * half;
            for (k, term) in terms.into_iter().enumerate() {
                panel.sum[k] += weight * term;
                panel.size[k] += weight * term.abs();
            }
        }
        Ok(panel)
    }
}

fn add<T: Real, const N: usize>(sum: &mut [T; N], terms: &[T; N]) {
    for (sum, &term) in sum.iter_mut().zip(terms) {
        *sum += term;
    }
}

/// A range of angles with the integrals over it, and those of the absolute values.
struct Panel<T, const N: usize> {
    ends: [T; 2],
    sum: [T; N],
    size: [T; N],
}

/// The contact as seen from x: angles are counted from the point nearest to x, away from the edge
/// nearest to x.
struct View<T> {
    on: Interval<T>,
    /// Whether that is the right edge.
    right: bool,
    /// The angle between that edge and the nearest point, up to π/2.
    theta: T,
    /// How far outside the contact x is.
    beyond: T,
    /// How far inside, and x itself.
    inward: T,
    x: T,
}

impl<T: Real> View<T> {
    fn new(on: Interval<T>, x: T) -> Self {
        let right = x > on.centre();
        let inward = if right { on.right - x } else { x - on.left };
        let beyond = (-inward).max(T::zero());
        let mut view = Self { on, right, theta: T::zero(), beyond, inward, x };
        if inward > T::zero() {
            view.theta = view.angle(x);
        }
        view
    }

    /// The angle of a point of the contact from the edge.
    fn angle(&self, x: T) -> T {
        let angle = self.on.angle(x);
        if self.right {
            angle
        } else {
            let Interval { left, right } = self.on;
            T::of(2.0) * (x - left).sqrt().atan2((right - x).sqrt())
        }
    }

    /// The ends of the panels: both edges, the joints, and the nearest point itself.
    fn ends(&self, joints: &[T]) -> Vec<T> {
        let mut ends = vec![-self.theta, T::pi() - self.theta];
        if self.theta > T::zero() {
            ends.push(T::zero());
        }
        let apart = |turn: &T| turn.abs() > T::of(16.0) * T::epsilon();
        ends.extend(joints.iter().map(|&joint| self.angle(joint) - self.theta).filter(apart));
        ends.sort_by(|a, b| a.partial_cmp(b).unwrap_or(std::cmp::Ordering::Equal));
        ends.dedup();
        ends
    }

    /// A point s strictly inside the contact, `x - s`, and by how much the distance of s from the
    /// nearer edge, if free, was rounded: `P w` goes with it there.
    fn place(&self, turn: T, free: [bool; 2]) -> (T, T, T) {
        let half = T::of(0.5);
        let Interval { left, right } = self.on;
        let width = right - left;
        let half_angle = half * (self.theta + turn);
        let rounding = T::epsilon() * left.abs().max(right.abs());
        let near = half_angle < T::frac_pi_4();
        let inward = width * if near { half_angle.sin() } else { half_angle.cos() }.powi(2);
        let along = width * (self.theta + half * turn).sin() * (half * turn).sin();
        let distance = self.beyond + along;
        let distance = if self.right { distance } else { -distance };
        let at_right = near == self.right;
        // From whichever of x and the edge is nearer.
        let s = if along.abs() < half * self.inward {
            self.x - distance
        } else if at_right {
            right - inward
        } else {
            left + inward
        };
        let s = s.max(left + rounding).min(right - rounding);
        let share = match (at_right, free) {
            (true, [true, _]) => inward / (right - s),
            (false, [_, true]) => inward / (s - left),
            _ => T::one(),
        };
        (s, distance, share)
    }
}
