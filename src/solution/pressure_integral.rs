//! Integrals of the pressure times a kernel that may be steep above one point of the contact.
//!
//! ```text
//! ∫ P(s) K(x - s) ds = ∫ P w K(x - s) dθ,   s = c + L cos θ,   w = sqrt((s + b)(a - s))
//! ```
//!
//! `P w` is bounded at every kind of edge. The angle is split at the breakpoints and at the point
//! of the contact nearest to x. Each panel is halved until the 16-point Gauss rule agrees with the
//! sum over the two halves to `ε^(3/4)` of the integral of the absolute value. Where the integrand
//! is smooth the result is then good to rounding; next to a kink, where the panels shrink towards
//! it, to about the tolerance.
//!
//! Angles are measured from the angle of x, so that the distance `x - s` keeps its relative
//! accuracy however close the two are, and the kernel may be as narrow as needed.
//!
//! Most panels do not depend on x. `P w` at their nodes, and at the nodes of their halves, is kept:
//! among a thousand breakpoints only the panels next to x need new pressures.

mod graded_rule;

use super::potential::Potential;
use super::solved::Solved;
use crate::kernel::{Kernel, Spread, loads, series, terms};
use crate::numerics::gauss_legendre::GaussLegendre;
use crate::{ContactError, Ends, EvaluationError, Fallible, Interval, Pressure, Real};
use graded_rule::GradedRule;
use std::sync::OnceLock;

/// Number of nodes of a panel.
const NODES: usize = 16;

/// Noise of the pressures of many contacts, as a share of the largest coefficient.
const COEFFICIENT_NOISE: f64 = 1e-11;

/// Largest number of panels beyond those between the breakpoints, before an integral is given up.
pub(super) const MAX_PANELS: usize = 20_000;

/// Integrated quantity: the pressure, or its rate with the load.
pub(crate) trait Density<T: Real> {
    /// Fills in the values at places strictly inside the contacts.
    fn values(&self, x: &[T], values: &mut [T]) -> Fallible<T, ()>;

    /// Returns the density on a single contact as seen from below, if it has a closed form.
    fn potential(&self) -> Fallible<T, Option<Potential<T>>> {
        Ok(None)
    }
}

/// Density on all contacts, ready to be integrated.
pub(crate) struct Integrals<T: Real, D> {
    pub density: D,
    /// Integral of the density over all contacts.
    pub load: T,
    /// Largest number of panels beyond those between the breakpoints.
    most: usize,
    /// Contacts, from left to right.
    contacts: Ones<T>,
}

/// Contacts, of which a single one is kept without an allocation.
enum Ones<T: Real> {
    Single([One<T>; 1]),
    Several(Vec<One<T>>),
}

impl<T: Real> Ones<T> {
    fn of(contacts: &[Interval<T>], one: impl Fn((usize, &Interval<T>)) -> One<T>) -> Self {
        match contacts {
            [on] => Self::Single([one((0, on))]),
            several => Self::Several(several.iter().enumerate().map(one).collect()),
        }
    }
}

impl<T: Real> std::ops::Deref for Ones<T> {
    type Target = [One<T>];

    fn deref(&self) -> &[One<T>] {
        match self {
            Self::Single(one) => one,
            Self::Several(several) => several,
        }
    }
}

/// One of the contacts.
#[derive(Clone)]
struct One<T> {
    on: Interval<T>,
    /// Breakpoints inside, rising, and the next ones beyond the limits.
    breakpoints: Vec<T>,
    beyond: [Option<T>; 2],
    /// Flags: `P w` vanishes at this limit.
    free: Ends<bool>,
    /// `P w` on the panels between the breakpoints, from the right one on.
    kept: OnceLock<Vec<Kept<T>>>,
}

/// `P w` at the nodes of a panel, of its right half and of its left half, each from right to left.
type Kept<T> = [[T; NODES]; 3];

impl<'p, T: Real> Integrals<T, Pressure<'p, T>> {
    /// Prepares the pressure of a solution.
    pub fn new(solved: Solved<'p, T>) -> Result<Self, ContactError<T>> {
        let contacts = solved.contacts();
        let one = |(i, &on): (usize, &Interval<T>)| {
            let (gap, free, kept) = (solved.gap, solved.free(i), OnceLock::new());
            let beyond = [gap.breakpoint_before(on.left), gap.breakpoint_after(on.right)];
            One { on, breakpoints: gap.breakpoints(on).collect(), beyond, free, kept }
        };
        let contacts = Ones::of(contacts, one);
        let (density, load) = (Pressure::new(solved)?, solved.found.load);
        Ok(Self { density, load, most: MAX_PANELS, contacts })
    }
}

impl<T: Real, D: Density<T>> Integrals<T, D> {
    /// Prepares the density of a unit load that is smooth inside the contacts, and infinite at
    /// their limits.
    pub fn of_unit_load(density: D, contacts: &[Interval<T>]) -> Self {
        let (breakpoints, beyond, free) = (Vec::new(), [None; 2], Ends::both(false));
        let one = One { on: contacts[0], breakpoints, beyond, free, kept: OnceLock::new() };
        let contacts = Ones::of(contacts, |(_, &on)| One { on, ..one.clone() });
        Self { density, load: T::one(), most: MAX_PANELS, contacts }
    }

    /// Gives up each integral after a number of panels.
    pub fn up_to(self, most: usize) -> Self {
        Self { most, ..self }
    }

    /// Returns `∫ K dθ` for kernels of `x - s` and `P w`.
    pub fn over<const N: usize>(
        &self,
        x: T,
        kernel: impl Fn(T, T) -> [T; N],
    ) -> Result<[T; N], ContactError<T>> {
        self.over_as_of(T::zero(), x, |_, distance, strength| kernel(distance, strength))
    }

    /// Returns the integral to the tolerance of an integral of size `least` or more: for a kernel
    /// that may be only the rounding of a difference. The kernel also gets a flag: s lies in the
    /// contact with x.
    pub fn over_as_of<const N: usize>(
        &self,
        least: T,
        x: T,
        kernel: impl Fn(bool, T, T) -> [T; N],
    ) -> Result<[T; N], ContactError<T>> {
        self.sum(&self.contacts, tolerance(), least, x, kernel)
    }

    /// Returns the integral over one contact, given by its number: to rounding next to a kink too,
    /// if possible.
    pub fn over_one<const N: usize>(
        &self,
        contact: usize,
        x: T,
        kernel: impl Fn(T, T) -> [T; N],
    ) -> Result<[T; N], ContactError<T>> {
        let (one, kernel) =
            (&self.contacts[contact..=contact], |_, x, strength| kernel(x, strength));
        let fine = tolerance::<T>().min(T::of(64.0) * T::epsilon());
        match self.sum(one, fine, T::zero(), x, kernel) {
            Err(ContactError::Evaluation(EvaluationError::Integral { .. })) => {
                self.sum(one, tolerance(), T::zero(), x, kernel)
            }
            result => result,
        }
    }

    /// Returns the densities as loads at nodes, for waves that fall at least half as fast as a
    /// kernel.
    pub fn loads(&self, kernel: &Kernel<'_, T>) -> Result<Vec<[T; 2]>, ContactError<T>> {
        let distance = T::of(0.5) * kernel.distance();
        Ok(loads(distance, &self.spreads(distance)?))
    }

    /// Returns the densities by as many coefficients as reach a kernel with its nearest singularity
    /// at a distance.
    pub fn spreads(&self, distance: T) -> Result<Vec<Spread<T>>, ContactError<T>> {
        let spread = |(i, &One { on, .. }): (usize, &One<T>)| {
            let [_, some, most] = terms(distance, T::one(), on);
            Ok(Spread { on, q: self.coefficients(i, [some, most])? })
        };
        self.contacts.iter().enumerate().map(spread).collect()
    }

    /// Returns the coefficients q_k of `P = Σ q_k cos kθ/(π L sin θ)` in one contact, at least some
    /// of them, and more until they vanish, up to a count.
    fn coefficients(&self, contact: usize, [some, most]: [usize; 2]) -> Fallible<T, Vec<T>> {
        let mut count = some;
        // As long as that costs less than integrals. Most breakpoints are kinks, but the pressure
        // may be smooth where a period begins.
        let is_smooth = self.contacts[contact].breakpoints.is_empty();
        while count < if is_smooth { 4 * most } else { most } {
            if let Some(q) = self.smooth_coefficients(contact, count) {
                return Ok(q);
            }
            count *= 2;
        }
        self.all_coefficients(contact, most)
    }

    /// Returns coefficients by the pressures at as many places (Gauss-Chebyshev), if the last of
    /// them vanish.
    fn smooth_coefficients(&self, contact: usize, count: usize) -> Option<Vec<T>> {
        let on = self.contacts[contact].on;
        let angle = |i: usize| T::pi() * (T::count(i) + T::of(0.5)) / T::count(count);
        let places: Vec<T> = (0..count).map(|i| on.at_angle(angle(i))).collect();
        let mut bounded = vec![T::zero(); count];
        self.density.values(&places, &mut bounded).ok()?;
        let weight = |x: T| T::pi() * on.chebyshev_weight(x);
        bounded.iter_mut().zip(&places).for_each(|(value, &x)| *value *= weight(x));
        let mut q = series(&bounded);
        let largest = |q: &[T]| q.iter().fold(T::zero(), |most, q| most.max(q.abs()));
        // At a kink they may be infinite.
        q.iter().all(|q| q.is_finite()).then_some(())?;
        let least = T::epsilon() * largest(&q);
        let [before, last] = [largest(&q[count - 8..count - 4]), largest(&q[count - 4..])];
        // Coefficients that fall no more are the noise of the pressures.
        let is_noise =
            last >= T::of(0.25) * before && last <= T::of(COEFFICIENT_NOISE) * largest(&q);
        let vanish = is_noise || last <= T::of(64.0) * least;
        q.truncate(q.iter().rposition(|q| q.abs() > least).map_or(1, |last| last + 1));
        vanish.then_some(q)
    }

    fn all_coefficients(&self, contact: usize, count: usize) -> Fallible<T, Vec<T>> {
        /// Coefficients that are integrated together, with the same pressures.
        const COEFFICIENTS_TOGETHER: usize = 128;
        let on = self.contacts[contact].on;
        let (one, mut q) = (T::one(), Vec::with_capacity(count + COEFFICIENTS_TOGETHER));
        while q.len() < count {
            let first = q.len();
            let block = self.over_one(contact, on.centre(), |distance, strength| {
                let z = -distance / on.half_width();
                let (mut pair, mut block) = ([one, z], [T::zero(); COEFFICIENTS_TOGETHER]);
                for k in 0..first + COEFFICIENTS_TOGETHER {
                    if k >= first {
                        block[k - first] = strength * if k == 0 { one } else { pair[0] + pair[0] };
                    }
                    pair = [pair[1], (z + z) * pair[1] - pair[0]];
                }
                block
            })?;
            q.extend(block);
        }
        q.truncate(count);
        Ok(q)
    }

    fn sum<const N: usize>(
        &self,
        contacts: &[One<T>],
        tolerance: T,
        least: T,
        x: T,
        kernel: impl Fn(bool, T, T) -> [T; N],
    ) -> Fallible<T, [T; N]> {
        let mut pending = Vec::new();
        let (mut total, mut size) = ([T::zero(); N], [T::zero(); N]);
        let mut views = Vec::with_capacity(contacts.len());
        for one in contacts {
            views.push((one, GradedRule::new(one.on, x), one.kept(&self.density)?));
        }
        let panel = |i: usize, ends: [T; 2], known: Option<usize>, part: usize| {
            let (one, graded_rule, kept) = &views[i];
            let bounded = match known {
                Some(known) => graded_rule.seen(&kept[known], part),
                None => one.bounded(&self.density, graded_rule, ends)?,
            };
            let kernel = |distance, strength| kernel(one.on.contains(x), distance, strength);
            Ok::<_, ContactError<T>>(GradedPanel::new(graded_rule, ends, &bounded, &kernel))
        };
        for (i, (one, graded_rule, _)) in views.iter().enumerate() {
            for (ends, known) in graded_rule.panels(&one.breakpoints) {
                let whole = panel(i, ends, known, 0)?;
                add(&mut size, &whole.size);
                pending.push((i, whole, known));
            }
        }
        // Below about the least normal number there are fewer digits.
        let least = T::max_value().map_or(least, |max| least.max(max.recip()));
        let mut left = self.most;
        while let Some((contact, whole, known)) = pending.pop() {
            let [from, to] = whole.ends;
            let middle = T::of(0.5) * (from + to);
            let half = |ends, part| panel(contact, ends, known, part);
            let halves = [half([from, middle], 1)?, half([middle, to], 2)?];
            let (one, graded_rule, _) = &views[contact];
            let noise = one.noise(graded_rule.place(middle, one.free).0);
            let mut agreed = true;
            let mut refined = [T::zero(); N];
            for i in 0..N {
                refined[i] = halves[0].sum[i] + halves[1].sum[i];
                size[i] += halves[0].size[i] + halves[1].size[i] - whole.size[i];
                let allowed = tolerance * size[i].max(least) + noise * whole.size[i];
                agreed &= (refined[i] - whole.sum[i]).abs() <= allowed;
            }
            if agreed {
                add(&mut total, &refined);
                continue;
            }
            if left == 0 {
                return Err(EvaluationError::Integral { x, panels: self.most }.into());
            }
            left -= 1;
            pending.extend(halves.map(|half| (contact, half, None)));
        }
        Ok(total)
    }
}

impl<T: Real> One<T> {
    /// Returns the kept panels, each computed from the edge nearer to it.
    fn kept(&self, density: &impl Density<T>) -> Fallible<T, &[Kept<T>]> {
        if let Some(kept) = self.kept.get() {
            return Ok(kept);
        }
        let views = [self.on.left, self.on.right].map(|x| GradedRule::new(self.on, x));
        let ends = [0, 1].map(|i| views[i].ends(&self.breakpoints));
        let count = self.breakpoints.len() + 1;
        let keep = |i: usize| {
            let j = count - 1 - i;
            let seen = [[ends[0][j], ends[0][j + 1]], [ends[1][i], ends[1][i + 1]]];
            let nearer = usize::from(seen[0][1] >= seen[1][1]);
            let (graded_rule, [from, to]) = (&views[nearer], seen[nearer]);
            let middle = T::of(0.5) * (from + to);
            let bounded = |ends| self.bounded(density, graded_rule, ends);
            let kept = [bounded([from, to])?, bounded([from, middle])?, bounded([middle, to])?];
            Ok([0, 1, 2].map(|part| graded_rule.seen(&kept, part)))
        };
        let kept = (0..count).map(keep).collect::<Fallible<T, _>>()?;
        Ok(self.kept.get_or_init(|| kept))
    }

    /// Returns the relative error of the pressure by the rounding of s next to a breakpoint, where
    /// the pressure may go like a logarithm: halving does not reduce it.
    fn noise(&self, s: T) -> T {
        let Interval { left, right } = self.on;
        let mut distance = right - left;
        let next = self.breakpoints.partition_point(|&breakpoint| breakpoint < s);
        let inside = self.breakpoints.iter().take(next + 1).skip(next.saturating_sub(1));
        for &breakpoint in inside.chain(self.beyond.iter().flatten()) {
            distance = distance.min((s - breakpoint).abs());
        }
        let rounding = T::of(0.25) * T::epsilon() * s.abs();
        if distance > rounding { rounding / distance } else { T::one() }
    }

    /// Returns `P w` at the nodes of a panel.
    fn bounded(
        &self,
        density: &impl Density<T>,
        graded_rule: &GradedRule<T>,
        ends: [T; 2],
    ) -> Fallible<T, [T; NODES]> {
        let places = turns(ends).map(|turn| graded_rule.place(turn, self.free));
        let mut bounded = [T::zero(); NODES];
        density.values(&places.map(|(s, _)| s), &mut bounded)?;
        for (bounded, (s, share)) in bounded.iter_mut().zip(places) {
            *bounded *= share * graded_rule.on.chebyshev_weight(s);
        }
        Ok(bounded)
    }
}

/// Returns the share of an integral to which its panels must agree with their halves.
fn tolerance<T: Real>() -> T {
    T::epsilon().powf(T::of(0.75))
}

fn add<T: Real, const N: usize>(sum: &mut [T; N], terms: &[T; N]) {
    for (sum, &term) in sum.iter_mut().zip(terms) {
        *sum += term;
    }
}

/// Returns the angles of the nodes of a panel, each from the nearer end, since either may be at x.
fn turns<T: Real>([from, to]: [T; 2]) -> [T; NODES] {
    let half = T::of(0.5) * (to - from);
    let nodes = GaussLegendre::sixteen().nodes;
    std::array::from_fn(|i| {
        let node = T::of(nodes[i]);
        let from_left = node < T::zero();
        if from_left { from + half * (T::one() + node) } else { to - half * (T::one() - node) }
    })
}

/// Range of angles with the integrals over it, and the integrals of the absolute values.
struct GradedPanel<T, const N: usize> {
    ends: [T; 2],
    sum: [T; N],
    size: [T; N],
}

impl<T: Real, const N: usize> GradedPanel<T, N> {
    fn new(
        graded_rule: &GradedRule<T>,
        ends: [T; 2],
        bounded: &[T; NODES],
        kernel: &impl Fn(T, T) -> [T; N],
    ) -> Self {
        let half = T::of(0.5) * (ends[1] - ends[0]);
        let weights = GaussLegendre::sixteen().weights;
        let mut panel = Self { ends, sum: [T::zero(); N], size: [T::zero(); N] };
        for (i, turn) in turns(ends).into_iter().enumerate() {
            // Rounding may have moved a node to the breakpoint where the pressure is infinite.
            if !bounded[i].is_finite() {
                continue;
            }
            let terms = kernel(graded_rule.distance(turn), bounded[i]);
            let weight = T::of(weights[i]) * half;
            for (k, term) in terms.into_iter().enumerate() {
                panel.sum[k] += weight * term;
                panel.size[k] += weight * term.abs();
            }
        }
        panel
    }
}
