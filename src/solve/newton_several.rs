//! Newton's method on all limits of several contacts at once.
//!
//! The equations and their exact Jacobian are those of the quadrature. A step is cut short where a contact or a
//! gap would lose more than two thirds of its width at once. A gap that shrinks step after step, or until the heights
//! of the bodies no longer tell where it is, is one that closes; a contact that does so is one that the bodies do not
//! have: the caller starts again without it.

use super::single_contact::MOST_DOUBT;
use crate::gap::Gap;
use crate::numerics::LinearSystem;
use crate::quadrature::panels::{Several, System};
use crate::solution::ContactState;
use crate::{ContactError, Ends, Interval, Real, Side};
use std::cmp::Ordering;

/// Steps before the search is given up.
const MOST_STEPS: usize = 60;

/// What a contact or a gap keeps of its width in one step.
const LEAST_LEFT: f64 = 0.3;

/// By how much a width may grow in one step.
const MOST_GROWTH: f64 = 4.0;

/// Steps in a row that are cut short by the same width, or end, before it is taken not to exist: a gap at a kink, or a
/// contact where the bodies have just met, may be as narrow as rounding.
const MOST_CUT: i32 = 12;

/// How Newton's method ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum SeveralOutcome {
    Found,
    /// The gap after this contact closes.
    Closed(usize),
    /// This contact vanishes.
    Lost(usize),
    /// A limit reaches beyond an end of the bodies.
    Beyond(Side),
    Failed,
}

/// What is sought besides the limits.
#[derive(Clone, Copy)]
pub(super) enum Besides<T> {
    /// The tilt under which the load acts at this place.
    Tilt(T),
    /// The load under which the outermost limit is at an end of the bodies.
    Load(Side),
}

/// A gap of so many units of rounding of x is nothing.
const NOTHING: f64 = 64.0;

/// What cuts a step short: a contact (even) or a gap (odd), by twice its number.
type CutWidth = usize;

#[derive(Clone)]
pub(super) struct NewtonSeveral<T> {
    /// By how much body 2 is turned.
    pub tilt: T,
    /// What the contacts bear: F/κ.
    pub load: T,
    /// The contacts, from left to right.
    pub on: Vec<Interval<T>>,
    /// Estimated errors of the limits, each as a share of the half-width of its contact.
    pub errors: Vec<T>,
    pub steps: usize,
    system: System<T>,
    linear: LinearSystem<T>,
    step: Vec<T>,
    /// What the limits move by.
    moves: Vec<T>,
    /// The widths between them, from the narrowest to the widest.
    order: Vec<usize>,
    /// What the conditions leave open: of one of them, and of what that makes of the limits.
    unit: Vec<T>,
    open: Vec<T>,
}

impl<T: Real> NewtonSeveral<T> {
    pub fn new() -> Self {
        let [errors, step, moves, unit, open] = std::array::from_fn(|_| Vec::new());
        let (system, linear) = (System::new(), LinearSystem::new());
        let (on, tilt, load) = (Vec::new(), T::zero(), T::zero());
        let steps = 0;
        let order = Vec::new();
        Self { tilt, load, on, errors, steps, system, linear, step, moves, order, unit, open }
    }

    /// Moves the contacts until they bear a load, that is F/κ; and turns the bodies until it acts at a place,
    /// or changes the load until an outermost limit is where it has been put, at an end of the bodies.
    pub fn converge(
        &mut self,
        several: &mut Several<T>,
        gap: &Gap<'_, T>,
        load: T,
        corners: Ends<bool>,
        ends: Ends<T>,
        besides: Option<Besides<T>>,
    ) -> Result<SeveralOutcome, ContactError<T>> {
        self.errors.clear();
        self.load = load;
        if !matches!(besides, Some(Besides::Tilt(_))) {
            self.tilt = gap.tilt();
        }
        // The limits that stay where they are.
        let mut held = corners;
        if let Some(Besides::Load(side)) = besides {
            held[side] = true;
        }
        let mut turned = gap.tilted(self.tilt);
        let (one, half) = (T::one(), T::of(0.5));
        let mut before: Option<T> = None;
        let mut cut: Option<(CutWidth, i32)> = None;
        let mut more_steps = None;
        for _ in 0..MOST_STEPS {
            self.steps += 1;
            // Between two contacts at a concave kink the gap falls exponentially with the load.
            if let Some(i) = (0..self.on.len() - 1).find(|&i| self.is_nothing(i)) {
                return Ok(SeveralOutcome::Closed(i));
            }
            several.set(&turned, &self.on, corners, ends)?;
            several.system(self.load, &mut self.system);
            match besides {
                Some(Besides::Tilt(at)) => several.turning(load, at, &mut self.system),
                Some(Besides::Load(side)) => several.by_load(side, &mut self.system),
                None => {}
            }
            if let Some(i) = self.system.lost {
                return Ok(SeveralOutcome::Closed(i));
            }
            if !self.linear.factor(&self.system.jacobian, self.system.residual.len()) {
                return Ok(SeveralOutcome::Failed);
            }
            self.linear.solve(&self.system.residual, &mut self.step);
            self.set_moves(held);
            let place = if more_steps.is_none() { self.too_far(held, cut) } else { None };
            if !self.step.iter().all(|step| step.is_finite()) {
                return Ok(SeveralOutcome::Failed);
            }
            match (besides, self.step.last()) {
                (Some(Besides::Tilt(_)), Some(&step)) => {
                    self.tilt -= step;
                    turned = turned.tilted(self.tilt);
                }
                (Some(Besides::Load(_)), Some(&step)) => self.load -= step,
                _ => {}
            }
            // For the derivatives of dual numbers, beyond the convergence of the value.
            if let Some(left) = &mut more_steps {
                self.advance(held, None);
                *left -= 1;
                if *left == 0 {
                    several.set(&turned, &self.on, corners, ends)?;
                    several.press();
                    return Ok(SeveralOutcome::Found);
                }
                continue;
            }
            let size = self.size(held);
            let last = self.on.len() - 1;
            let hull = Interval { left: self.on[0].left, right: self.on[last].right };
            self.advance(held, cut);
            // Where one load reaches both ends, one of them is passed by rounding.
            if let Some(Besides::Load(_)) = besides {
                let nothing = T::epsilon().powf(T::of(2.0 / 3.0)) * hull.half_width();
                if self.on[0].left >= ends.left - nothing {
                    self.on[0].left = self.on[0].left.max(ends.left);
                }
                if self.on[last].right <= ends.right + nothing {
                    self.on[last].right = self.on[last].right.min(ends.right);
                }
            }
            let next = Interval { left: self.on[0].left, right: self.on[last].right };
            let (beyond_left, beyond_right) = (next.left < ends.left, next.right > ends.right);
            if beyond_left {
                self.on[0].left = half * hull.left + half * ends.left;
            }
            if beyond_right {
                self.on[last].right = half * hull.right + half * ends.right;
            }
            // Nothing is left of a contact that was cut short time and again.
            if let Some(i) = place.filter(|place| place % 2 == 0).map(|place| place / 2)
                && self.on[i].left >= self.on[i].right
            {
                return Ok(SeveralOutcome::Lost(i));
            }
            // A contact may have left the bodies as a whole.
            let ordered = |pair: [T; 2]| pair[0] < pair[1];
            if !self.on.iter().all(|on| ordered([on.left, on.right]))
                || !self.on.windows(2).all(|pair| ordered([pair[0].right, pair[1].left]))
            {
                return Ok(SeveralOutcome::Failed);
            }
            if place.is_some() || beyond_left || beyond_right {
                let place = place.unwrap_or(if beyond_left { usize::MAX - 1 } else { usize::MAX });
                let times = cut.filter(|&(at, _)| at == place).map_or(0, |(_, times)| times) + 1;
                cut = Some((place, times));
                if times > MOST_CUT {
                    return Ok(match place {
                        usize::MAX => SeveralOutcome::Beyond(Side::Right),
                        place if place == usize::MAX - 1 => SeveralOutcome::Beyond(Side::Left),
                        place if place % 2 == 0 => SeveralOutcome::Lost(place / 2),
                        place => SeveralOutcome::Closed(place / 2),
                    });
                }
                before = None;
                continue;
            }
            cut = None;
            let ratio = before.map_or(one, |before| size / before);
            let done = size <= T::of(0.25) && ratio * ratio * size <= half * T::epsilon();
            // Rounding keeps the steps from falling any further.
            let stalled = ratio >= T::of(0.25);
            let small = size <= T::epsilon().sqrt() || self.is_small();
            if done || stalled && small {
                self.estimate(held);
            }
            if done || stalled && small && (size <= T::epsilon().sqrt() || self.is_all_doubt()) {
                if let Some(i) = (0..last).find(|&i| self.is_nothing(i)) {
                    return Ok(SeveralOutcome::Closed(i));
                }
                if stalled {
                    let left =
                        self.moves.iter().zip(self.on.iter().flat_map(|on| [on.half_width(); 2]));
                    let add = |(error, (step, half_width)): (&mut T, (&T, T))| {
                        *error += step.abs() / half_width;
                    };
                    self.errors.iter_mut().zip(left).for_each(add);
                }
                if T::DERIVATIVE_ORDER == 0 {
                    several.set(&turned, &self.on, corners, ends)?;
                    several.press();
                    return Ok(SeveralOutcome::Found);
                }
                more_steps = Some(T::DERIVATIVE_ORDER);
            }
            // A long step tells nothing of the next.
            before = Some(size).filter(|&size| size <= half * half);
        }
        Ok(SeveralOutcome::Failed)
    }

    /// What was found.
    pub fn found(
        &self,
        several: &Several<T>,
        kappa: T,
        load: T,
        corners: Ends<bool>,
        ends: Ends<T>,
    ) -> ContactState<T> {
        let on = &self.on;
        // The load goes about with the square of a width.
        let [mut sum, mut all] = [T::zero(); 2];
        for (on, errors) in on.iter().zip(self.errors.chunks_exact(2)) {
            let square = on.half_width() * on.half_width();
            sum += square * errors[0].max(errors[1]);
            all += square;
        }
        ContactState {
            interval: Interval { left: on[0].left, right: on[on.len() - 1].right },
            load,
            strengths: Ends::from_fn(|side| kappa * several.strength(side)),
            free: corners.map(|corner| !corner),
            adhesive: Ends::both(false),
            error: Some(self.errors.iter().fold(T::zero(), |max, &error| max.max(error))),
            error_by_load: Some(sum / all),
            force: None,
            trend: None,
            tilt: self.tilt,
            ends,
        }
    }

    /// The free limits, by the number of their contact and whether they are right ones.
    fn free(&self, corners: Ends<bool>) -> impl Iterator<Item = (usize, bool)> + use<T> {
        let last = self.on.len() - 1;
        let both = (0..=last).flat_map(|i| [(i, false), (i, true)]);
        both.filter(move |&(i, right)| {
            !(i == 0 && !right && corners.left || i == last && right && corners.right)
        })
    }

    /// The width that the step takes furthest below the least that it may leave, if any. That of a gap is kept from
    /// falling further, and what else moves with it: the condition that a pressure in its place would not meet is
    /// left open.
    fn too_far(&mut self, corners: Ends<bool>, cut: Option<(CutWidth, i32)>) -> Option<CutWidth> {
        let mut worst: Option<(T, CutWidth)> = None;
        for i in 0..self.moves.len() - 1 {
            let share = (self.moves[i + 1] - self.moves[i]) / self.width(i);
            let (square, least) = (T::one() + share + share, Self::least(i, cut));
            if square < least * least && worst.is_none_or(|(least, _)| square < least) {
                worst = Some((square, i));
            }
        }
        let (_, place) = worst?;
        if place % 2 == 1 {
            let row = self.system.row_of_gap(place / 2);
            self.unit.clear();
            self.unit.resize(self.step.len(), T::zero());
            self.unit[row] = T::one();
            self.linear.solve(&self.unit, &mut self.open);
            let left = place - usize::from(corners.left);
            let narrows = |step: &[T]| step[left + 1] - step[left];
            // To nothing, of which the least is left.
            let excess = narrows(&self.step) - T::of(0.5) * self.width(place);
            let open = excess / narrows(&self.open);
            if open.is_finite() {
                for (step, &by_open) in self.step.iter_mut().zip(&self.open) {
                    *step -= open * by_open;
                }
                self.set_moves(corners);
            }
        }
        Some(place)
    }

    /// What a step leaves of a width at least, as a share of it. One may fall faster that was kept from it before:
    /// `cut` is what was, and how often in a row.
    fn least(i: CutWidth, cut: Option<(CutWidth, i32)>) -> T {
        let times = match cut {
            Some((place, times)) if place == i => times + 1,
            _ => 1,
        };
        T::of(LEAST_LEFT.powi(times))
    }

    fn width(&self, i: CutWidth) -> T {
        let on = &self.on[i / 2];
        if i.is_multiple_of(2) { on.right - on.left } else { self.on[i / 2 + 1].left - on.right }
    }

    /// What the step moves each limit by.
    fn set_moves(&mut self, corners: Ends<bool>) {
        self.moves.clear();
        self.moves.resize(2 * self.on.len(), T::zero());
        let free = self.free(corners).map(|(i, right)| 2 * i + usize::from(right));
        for (i, &step) in free.zip(&self.step) {
            self.moves[i] = -step;
        }
    }

    fn limit(&mut self, i: usize) -> &mut T {
        let on = &mut self.on[i / 2];
        if i.is_multiple_of(2) { &mut on.left } else { &mut on.right }
    }

    /// Takes the step. The square of each width, of contacts and of gaps, changes as the step would have it:
    /// the load of a round body goes with it, and so does what is left of a gap that closes.
    fn advance(&mut self, corners: Ends<bool>, cut: Option<(CutWidth, i32)>) {
        let (zero, one, two) = (T::zero(), T::one(), T::of(2.0));
        let count = self.moves.len();
        let mut order = std::mem::take(&mut self.order);
        order.clear();
        order.extend(0..count - 1);
        // The narrowest first: their limits may move by more than they are wide.
        let by_width = |&one: &usize, &other: &usize| {
            self.width(one).partial_cmp(&self.width(other)).unwrap_or(Ordering::Equal)
        };
        order.sort_unstable_by(by_width);
        for &i in &order {
            let width = self.width(i);
            let change = self.moves[i + 1] - self.moves[i];
            let least = Self::least(i, cut) * width;
            let square = (width * (width + two * change)).max(least * least);
            let next = square.sqrt().min(T::of(MOST_GROWTH) * width);
            let correction = next - (width + change);
            // On both sides, but a narrow neighbour has no room for it, and a corner stays.
            let room = |beside: Option<CutWidth>, corner: bool| match beside {
                Some(beside) => width.min(self.width(beside)),
                None if corner => zero,
                None => width,
            };
            let left = room(i.checked_sub(1), corners.left);
            let right = room((i + 2 < count).then_some(i + 1), corners.right);
            let share = right / (left + right);
            self.moves[i] -= (one - share) * correction;
            self.moves[i + 1] += share * correction;
        }
        self.order = order;
        // What is good for one width may be too much for the next.
        let mut share = one;
        for i in 0..count - 1 {
            let (width, less) = (self.width(i), self.moves[i] - self.moves[i + 1]);
            let most = (one - T::of(0.5 * LEAST_LEFT.powi(MOST_CUT))) * width;
            if less > most {
                share = share.min(most / less);
            }
        }
        for i in 0..count {
            let step = share * self.moves[i];
            *self.limit(i) += step;
        }
    }

    /// Whether the gap after a contact is as narrow as rounding.
    pub fn is_nothing(&self, i: usize) -> bool {
        self.gap(i) <= self.rounding(i)
    }

    /// The rounding of the limits of a contact and of the next.
    fn rounding(&self, i: usize) -> T {
        let size = self.on[i].left.abs().max(self.on[i + 1].right.abs());
        T::of(NOTHING) * T::epsilon() * size
    }

    /// The largest step, as a share of the half-width of its contact or of the gap beside it: next to a kink
    /// the pressure tells how narrow the gap is.
    fn size(&self, corners: Ends<bool>) -> T {
        let share = |((i, right), &step): ((usize, bool), &T)| {
            let gap = if right { Some(i) } else { i.checked_sub(1) };
            let gap =
                gap.filter(|&gap| gap + 1 < self.on.len()).map(|gap| T::of(0.5) * self.gap(gap));
            step.abs() / gap.map_or(self.on[i].half_width(), |gap| gap.min(self.on[i].half_width()))
        };
        self.free(corners).zip(&self.step).map(share).fold(T::zero(), |max, share| max.max(share))
    }

    /// The width of the gap after a contact.
    fn gap(&self, i: usize) -> T {
        self.on[i + 1].left - self.on[i].right
    }

    /// A gap that is nothing, as far as its place is in doubt: by the rounding of both contacts.
    pub fn closed_gap(&self, i: usize) -> Interval<T> {
        let rounding = self.rounding(i);
        Interval { left: self.on[i].right - rounding, right: self.on[i + 1].left + rounding }
    }

    /// Whether no limit has moved by more than it may be in doubt.
    fn is_small(&self) -> bool {
        let half_widths = self.on.iter().flat_map(|on| [on.half_width(); 2]);
        half_widths.zip(&self.moves).all(|(half, step)| step.abs() <= T::of(MOST_DOUBT) * half)
    }

    /// Whether no limit has moved by more than it is in doubt.
    fn is_all_doubt(&self) -> bool {
        let errors = self.errors.iter().zip(self.on.iter().flat_map(|on| [on.half_width(); 2]));
        errors.zip(&self.moves).all(|((&error, half_width), step)| step.abs() <= error * half_width)
    }

    /// What the equations leave open of the limits, and rounding.
    fn estimate(&mut self, corners: Ends<bool>) {
        let n = self.step.len();
        self.open.clear();
        self.open.resize(n, T::zero());
        for (k, &error) in self.system.open.iter().enumerate() {
            self.unit.clear();
            self.unit.resize(n, T::zero());
            self.unit[k] = error;
            self.linear.solve(&self.unit, &mut self.step);
            for (open, step) in self.open.iter_mut().zip(&self.step) {
                *open += step.abs();
            }
        }
        self.errors.clear();
        self.errors.resize(2 * self.on.len(), T::zero());
        for ((i, right), &open) in self.free(corners).zip(&self.open) {
            let on = self.on[i];
            let rounding = T::epsilon() * on.left.abs().max(on.right.abs());
            self.errors[2 * i + usize::from(right)] =
                T::of(4.0) * (open + rounding) / on.half_width();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gap::Shape;
    use crate::profile::{Curve, CurvePoint, Flat, Piecewise};
    use crate::search::Newton as Inversion;
    use std::f64::consts::PI;

    fn solve(
        body: &dyn crate::ParametricProfile<f64>,
        load: f64,
        start: &[[f64; 2]],
        corners: Ends<bool>,
    ) -> (Vec<Interval<f64>>, Vec<f64>, Several<f64>) {
        let inversion = Inversion::default();
        let gap = Gap::new(Shape::Lent(&Flat), Shape::Lent(body), &inversion).unwrap();
        let mut several = Several::new(16.0 * f64::EPSILON);
        let mut newton = NewtonSeveral::new();
        newton.on = start.iter().map(|&[left, right]| Interval { left, right }).collect();
        let outcome =
            newton.converge(&mut several, &gap, load, corners, gap.range().into(), None).unwrap();
        assert_eq!(outcome, SeveralOutcome::Found, "{:?}", newton.on);
        (newton.on, newton.errors, several)
    }

    #[test]
    fn a_quartic_up_to_its_merge() {
        let body = Curve::new([-3.0, 3.0], |k: f64| {
            let square = k * k;
            CurvePoint { x: k, y: square * (square - 2.0), dx: 1.0, dy: 4.0 * k * (square - 1.0) }
        });
        // E* = 1, so κ = π/2.
        for load in [1e-6, 0.1, 1.0, 3.0, 0.9995 * PI, 0.9999998 * PI] {
            let d = f64::sqrt(4.0 * load / PI);
            let [al, be] = [(1.0 - d / 2.0).sqrt(), (1.0 + d / 2.0).sqrt()];
            let off = 0.1 * (be - al);
            let start = [[-be + off, -al - off], [al + off, be - off]];
            let (on, errors, several) =
                solve(&body, load / std::f64::consts::FRAC_PI_2, &start, Ends::both(false));
            let width = be - al;
            let limits = on.iter().flat_map(|on| [on.left, on.right]);
            for ((x, due), error) in limits.zip([-be, -al, al, be]).zip(errors) {
                let allowed = 1e-12f64.max(error) * width;
                assert!((x - due).abs() <= allowed, "F {load}: {x} for {due}, error {error}");
            }
            let x: Vec<f64> = [0.001, 0.3, 0.7, 0.95].iter().map(|s| al + s * width).collect();
            let mut p = vec![0.0; 4];
            several.pressures(&x, &mut p);
            let top = 2.0 * 1.0 * width / 2.0;
            for (x, p) in x.into_iter().zip(p) {
                let due = 2.0 * x * ((x * x - al * al) * (be * be - x * x)).sqrt();
                let got = p * std::f64::consts::FRAC_PI_2;
                // Beside a limit its rounding counts.
                let rounding = f64::EPSILON * due / (x - al);
                assert!(
                    (got - due).abs() <= 1e-11 * top + rounding,
                    "F {load}: P({x}) {got} for {due}"
                );
            }
        }
    }

    #[test]
    fn kinks_inside_each_contact() {
        // m |T|/N with T = 2 x² - 1 scaled: kinks at ±sqrt(1/2), declared.
        let piece = |from: f64, to: f64, sign: f64| {
            Curve::new([from, to], move |k: f64| CurvePoint {
                x: k,
                y: sign * (2.0 * k * k - 1.0) * 0.5,
                dx: 1.0,
                dy: sign * 2.0 * k,
            })
        };
        let r = 0.5f64.sqrt();
        let body =
            Piecewise::new(vec![piece(-1.5, -r, 1.0), piece(-r, r, -1.0), piece(r, 1.5, 1.0)])
                .unwrap();
        for load in [0.01f64, 0.2, 0.6] {
            // The wedge |v| bears F = 2 a/π with κ = 1, on |v| <= a; each of N contacts a half.
            let a = load * std::f64::consts::PI / 2.0;
            let [al, be] = [((1.0 - a) / 2.0).sqrt(), ((1.0 + a) / 2.0).sqrt()];
            let off = 0.05 * (be - al);
            let start = [[-be - off, -al + off], [al + off, be + off]];
            let (on, _, several) = solve(&body, load, &start, Ends::both(false));
            for (x, due) in
                [(on[0].left, -be), (on[0].right, -al), (on[1].left, al), (on[1].right, be)]
            {
                assert!((x - due).abs() <= 1e-12 * (be - al), "F {load}: {x} for {due}");
            }
            let x = al + 0.3 * (be - al);
            let v = 2.0 * x * x - 1.0;
            let due = 4.0 * x / 2.0 * 2.0 / PI.powi(2) * (a / v.abs()).acosh();
            let mut p = [0.0];
            several.pressures(&[x], &mut p);
            assert!((p[0] / due - 1.0).abs() < 1e-11, "{} for {due}", p[0]);
        }
    }
}
