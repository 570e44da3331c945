//! Newton's method on all limits of several contacts at once.
//!
//! The equations and their Jacobian are those of the quadrature: a step moves each limit outward if
//! the pressure on the contacts at hand would have a positive singularity there, and inward if a
//! negative one. So a false gap closes, and a false contact vanishes, whatever the other limits
//! do. A step leaves a third of a width. If a width is cut so step after step, the gap
//! closes, or the contact does not exist; and a gap closes that the heights of the bodies no longer
//! resolve. The caller starts again without all of these.
//!
//! With many contacts the first steps are trials: contacts of many panels are taken as one panel
//! each, and half the digits suffice for gaps and for contacts far from each other. A trial leaves
//! limits off by some 1e-4 of a width; then two steps with all digits suffice.

mod widths;

use super::super::fault::Fault;
use super::super::single_contact::MAX_DOUBT;
use super::Progress;
use crate::gap::Gap;
use crate::quadrature::panels::{Several, System};
use crate::solution::ContactState;
use crate::{Ends, Interval, Real, Side};
use std::borrow::Cow;

/// Steps before the search is given up.
const MAX_NEWTON_STEPS: usize = 60;

/// Largest number of steps in a row in which the same width is cut, each time to a smaller share,
/// or the same end is passed. Then that contact or gap is taken not to exist: a gap at a kink, or a
/// contact where the bodies have just met, may be as narrow as rounding, and 0.3⁴⁵ is less.
const MAX_CUT: i32 = 9;

/// Size of a step after which trials end: the limits are then off by about its square, like those
/// of a trial.
const LAST_TRIAL: f64 = 0.02;

/// Least number of contacts for a trial: with few it saves little, and a tiny contact that was just
/// born needs all digits.
const LEAST_TRIED: usize = 8;

/// Number of conditions from one to the next whose uncertainties are taken together: the errors of
/// the limits are then a few per cent smaller than from each by itself.
const APART: usize = 16;

/// Number of such steps after which a width goes together with another that is taken not to exist:
/// it is 0.3⁶ of what it was.
const MAX_CUT_STEPS: i32 = 3;

/// Unknown besides the limits.
#[derive(Clone, Copy)]
pub(in super::super) enum Besides<T> {
    /// Tilt under which the load acts at this place.
    Tilt(T),
    /// Load under which the outermost limit on this side is at the end of the bodies.
    Load(Side),
}

/// Width number: twice that of its contact (even), plus one for the gap after it (odd).
type Width = usize;

/// Conditions that several contacts have to meet.
#[derive(Clone, Copy)]
pub(in super::super) struct Conditions<'s, 'b, T: Real> {
    pub gap: &'s Gap<'b, T>,
    /// Load as F/κ.
    pub load: T,
    /// Ends of the bodies.
    pub ends: Ends<T>,
    pub besides: Option<Besides<T>>,
}

impl<T: Real> Conditions<'_, '_, T> {
    /// Returns the side whose outermost limit is put at an end of the bodies, if the load for it is
    /// sought.
    fn end(&self) -> Option<Side> {
        match self.besides {
            Some(Besides::Load(side)) => Some(side),
            _ => None,
        }
    }
}

#[derive(Clone)]
pub(in super::super) struct NewtonSeveral<T> {
    /// Angle by which body 2 is turned.
    pub tilt: T,
    /// Load carried by the contacts: F/κ.
    pub load: T,
    /// Contacts, from left to right.
    pub on: Vec<Interval<T>>,
    /// Estimated errors of the limits, each as a share of the half-width of its contact.
    pub errors: Vec<T>,
    /// Limits of each contact that a corner holds.
    pub held: Vec<Ends<bool>>,
    /// Outermost limit that stays at the end of the bodies.
    at_end: Option<Side>,
    /// Residues at the poles of the quadrature.
    residues: Vec<T>,
    progress: Progress<T>,
    /// All unknowns before the last step, and before this one.
    before: [Vec<T>; 2],
    /// Flag: the limits are not yet worth all panels.
    is_trial: bool,
    /// Number of steps in a row in which each width was cut, and an end was passed.
    cut: Vec<i32>,
    passed: Option<(Side, i32)>,
    /// Widths cut in this step.
    widths: Vec<Width>,
    system: System<T>,
    step: Vec<T>,
    /// Steps of all limits.
    moves: Vec<T>,
    /// Numbers of the widths, from the narrowest to the widest.
    order: Vec<usize>,
    /// Right-hand side with the uncertainty of some conditions, and the uncertainty of the limits
    /// due to all.
    unit: Vec<T>,
    open: Vec<T>,
}

impl<T: Real> NewtonSeveral<T> {
    pub fn new() -> Self {
        let [errors, residues, step, moves, unit, open] = Default::default();
        Self {
            tilt: T::zero(),
            load: T::zero(),
            on: Vec::new(),
            errors,
            held: Vec::new(),
            at_end: None,
            residues,
            progress: Progress::new(),
            before: Default::default(),
            is_trial: true,
            cut: Vec::new(),
            passed: None,
            widths: Vec::new(),
            system: System::new(),
            step,
            moves,
            order: Vec::new(),
            unit,
            open,
        }
    }

    /// Moves the contacts until they bear a load. Turns the bodies until it acts at a given place,
    /// or changes the load until an outermost limit is at the end of the bodies, if that is sought.
    pub fn converge(
        &mut self,
        several: &mut Several<T>,
        conditions: &Conditions<'_, '_, T>,
    ) -> Result<(), Fault<T>> {
        self.errors.clear();
        self.load = conditions.load;
        if !matches!(conditions.besides, Some(Besides::Tilt(_))) {
            self.tilt = conditions.gap.tilt();
        }
        self.at_end = conditions.end();
        self.residues.clear();
        (self.progress, self.passed) = (Progress::new(), None);
        self.is_trial = self.on.len() >= LEAST_TRIED;
        self.cut.clear();
        self.cut.resize(2 * self.on.len() - 1, 0);
        let mut turned = conditions.gap.tilted(self.tilt);
        for _ in 0..MAX_NEWTON_STEPS {
            self.assemble(several, &turned, conditions)?;
            self.shorten();
            if !self.step.iter().all(|step| step.is_finite()) {
                break;
            }
            self.keep();
            self.turn(&mut turned, conditions.besides);
            let size = self.size();
            if self.limit(conditions)? {
                continue;
            }
            if self.is_trial {
                self.is_trial = size > T::of(LAST_TRIAL);
                continue;
            }
            if self.accept(size) && !self.passes_joint(conditions.gap) {
                if self.is_closed() {
                    return Err(self.gone());
                }
                for _ in 0..T::DERIVATIVE_ORDER {
                    self.assemble(several, &turned, conditions)?;
                    self.turn(&mut turned, conditions.besides);
                    self.advance(conditions.gap);
                }
                several.set(&turned, &self.on, &self.held, conditions.ends, false)?;
                several.carry(self.load, &self.residues);
                several.press();
                return Ok(());
            }
            // At a kink the slope of the equations jumps: whole steps may lead from one side of it
            // to the other for ever.
            if self.progress.has_grown_to(size) && self.turns_back() {
                self.go_back();
                turned = conditions.gap.tilted(self.tilt);
            } else {
                self.before.swap(0, 1);
                self.progress.note([size, T::zero()]);
            }
        }
        Err(Fault::Failed)
    }

    /// Keeps the unknowns before a step.
    fn keep(&mut self) {
        let mut here = std::mem::take(&mut self.before[1]);
        here.clear();
        here.extend(self.unknowns().map(|x| *x));
        self.before[1] = here;
    }

    /// Tells whether the limits go back against the step before.
    fn turns_back(&self) -> bool {
        let [last, here] = &self.before;
        let now = self.on.iter().flat_map(|on| [on.left, on.right]);
        let both = now.zip(last.iter().zip(here));
        let along =
            |sum: T, (now, (&last, &here)): (T, (&T, &T))| sum + (now - here) * (here - last);
        both.fold(T::zero(), along) < T::zero()
    }

    /// Tells whether a limit has passed a joint in the last step, by more than the rounding of x.
    /// Next to a corner the equations change within less than the step, whose size then tells
    /// nothing of the next.
    fn passes_joint(&self, gap: &Gap<'_, T>) -> bool {
        let limits = self.on.iter().flat_map(|on| [on.left, on.right]);
        let mut both = limits.zip(&self.before[1]);
        both.any(|(x, &last)| {
            let rounding = T::of(8.0) * T::epsilon() * x.abs();
            let [from, to] = [x.min(last), x.max(last)];
            to - from > rounding && gap.breakpoint_after(from).is_some_and(|z| z <= to)
        })
    }

    /// Goes to the middle of the step before, and takes the last one back.
    fn go_back(&mut self) {
        let before = std::mem::take(&mut self.before);
        for (x, (&from, &to)) in self.unknowns().zip(before[0].iter().zip(&before[1])) {
            *x = T::of(0.5) * from + T::of(0.5) * to;
        }
        self.before = before;
    }

    /// Lists the limits, and the other unknowns.
    fn unknowns(&mut self) -> impl Iterator<Item = &mut T> {
        let limits = self.on.iter_mut().flat_map(|Interval { left, right }| [left, right]);
        limits.chain(&mut self.residues).chain([&mut self.tilt, &mut self.load])
    }

    /// Assembles the equations of the contacts at hand, and solves them for the step.
    fn assemble(
        &mut self,
        several: &mut Several<T>,
        turned: &Gap<'_, T>,
        conditions: &Conditions<'_, '_, T>,
    ) -> Result<(), Fault<T>> {
        // Between two contacts at a concave kink the gap shrinks exponentially with the load.
        if self.is_closed() {
            return Err(self.gone());
        }
        several.set(turned, &self.on, &self.held, conditions.ends, self.is_trial)?;
        self.residues.resize(several.poles(), T::zero());
        several.carry(self.load, &self.residues);
        several.system(self.load, &mut self.system);
        match conditions.besides {
            Some(Besides::Tilt(at)) => several.turning(conditions.load, at, &mut self.system),
            Some(Besides::Load(side)) => several.by_load(side, &mut self.system),
            None => {}
        }
        if let Some(i) = self.system.lost {
            self.cut[2 * i + 1] = MAX_CUT;
            return Err(self.gone());
        }
        if !self.system.factor() {
            // The conditions of a vanishing contact, or of a closing gap, are alike in the end.
            let vanishes = self.cut.iter().any(|&times| times >= MAX_CUT_STEPS);
            return Err(if vanishes { self.gone() } else { Fault::Failed });
        }
        self.system.step(&mut self.step);
        self.moves.clear();
        self.moves.resize(2 * self.on.len(), T::zero());
        for (&i, &step) in self.system.free.iter().zip(&self.step) {
            if self.moves_freely(i) {
                self.moves[i] = -step;
            }
        }
        Ok(())
    }

    /// Takes the step of the residues, and of the tilt or of the load, if sought.
    fn turn(&mut self, turned: &mut Cow<'_, Gap<'_, T>>, besides: Option<Besides<T>>) {
        let steps = &self.step[self.system.free.len()..];
        self.residues.iter_mut().zip(steps).for_each(|(residue, &step)| *residue -= step);
        match (besides, self.step.last()) {
            (Some(Besides::Tilt(_)), Some(&step)) => {
                self.tilt -= step;
                *turned = Cow::Owned(turned.tilted(self.tilt).into_owned());
            }
            (Some(Besides::Load(_)), Some(&step)) => self.load -= step,
            _ => {}
        }
    }

    /// Takes the step of the limits; tells whether widths were cut or an end passed.
    fn limit(&mut self, conditions: &Conditions<'_, '_, T>) -> Result<bool, Fault<T>> {
        let (hull, ends) = (self.hull(), conditions.ends);
        self.advance(conditions.gap);
        for (i, cut) in self.cut.iter_mut().enumerate() {
            *cut = if self.widths.contains(&i) { *cut + 1 } else { 0 };
        }
        // If one load reaches both ends, one of them is passed by rounding.
        let rounding = T::epsilon().powf(T::of(2.0 / 3.0)) * hull.half_width();
        let rounding = conditions.end().map_or(T::zero(), |_| rounding);
        let mut passed = None;
        for (side, outward) in [(Side::Left, -T::one()), (Side::Right, T::one())] {
            let beyond = (self.hull()[side] - ends[side]) * outward;
            if beyond > rounding {
                passed = passed.or(Some(side));
                put(&mut self.on, side, T::of(0.5) * hull[side] + T::of(0.5) * ends[side]);
            } else if beyond > T::zero() {
                put(&mut self.on, side, ends[side]);
            }
        }
        let times = |&(last, times): &(Side, i32)| (passed == Some(last)).then_some(times);
        let times = self.passed.as_ref().and_then(times).unwrap_or(0);
        self.passed = passed.map(|side| (side, times + 1));
        let is_left = |&i: &Width| self.width(i) > T::zero();
        if !self.widths.iter().all(is_left) || self.cut.iter().any(|&times| times > MAX_CUT) {
            return Err(self.gone());
        }
        // A whole contact may have left the bodies.
        if !(self.on.iter().all(|on| on.left < on.right)
            && self.on.windows(2).all(|pair| pair[0].right < pair[1].left))
        {
            return Err(Fault::Failed);
        }
        match self.passed {
            Some((side, times)) if times > MAX_CUT => Err(Fault::Beyond(side)),
            None if self.widths.is_empty() => Ok(false),
            _ => {
                self.progress.forget();
                Ok(true)
            }
        }
    }

    /// Tells whether the last step, of this size, was short enough, or as short as rounding allows.
    fn accept(&mut self, size: T) -> bool {
        let judged = self.progress.judge([size, T::zero()]);
        // A limit moves no further than x is rounded.
        let least = T::of(0.5) * T::epsilon() * size / judged.next[0];
        let share = |on: Interval<T>, x: T| least * (T::one() + x.abs() / on.half_width());
        let shares = self.on.iter().flat_map(|&on| [on.left, on.right].map(|x| share(on, x)));
        let is_done = judged.is_done || self.is_within(shares);
        let is_short = size <= T::epsilon().sqrt();
        let is_stalled =
            judged.is_stalled && (is_short || self.is_within(std::iter::repeat(T::of(MAX_DOUBT))));
        if is_done || is_stalled {
            self.estimate();
        }
        let ends =
            is_done || is_stalled && (is_short || self.is_within(self.errors.iter().copied()));
        if ends && judged.is_stalled {
            for (i, step) in self.moves.iter().enumerate() {
                self.errors[i] += step.abs() / self.on[i / 2].half_width();
            }
        }
        ends
    }

    /// Returns the interval from the first of the contacts to the last.
    fn hull(&self) -> Interval<T> {
        Interval { left: self.on[0].left, right: self.on[self.on.len() - 1].right }
    }

    /// Returns the contacts found.
    pub fn found(
        &self,
        several: &Several<T>,
        kappa: T,
        load: T,
        conditions: &Conditions<'_, '_, T>,
    ) -> ContactState<T> {
        let on = &self.on;
        // The load is about proportional to the square of a width.
        let [mut sum, mut all] = [T::zero(); 2];
        for (on, errors) in on.iter().zip(self.errors.chunks_exact(2)) {
            let square = on.half_width() * on.half_width();
            sum += square * errors[0].max(errors[1]);
            all += square;
        }
        ContactState {
            interval: self.hull(),
            load,
            strengths: Ends {
                left: kappa * several.strength(0, Side::Left),
                right: kappa * several.strength(on.len() - 1, Side::Right),
            },
            free: Ends { left: !self.held[0].left, right: !self.held[on.len() - 1].right },
            adhesive: Ends::both(false),
            error: Some(self.errors.iter().fold(T::zero(), |max, &error| max.max(error))),
            error_by_load: Some(sum / all),
            load_error: None,
            moment_derivatives: None,
            tilt: self.tilt,
            ends: conditions.ends,
            apart: None,
        }
    }

    /// Tells whether a limit, by its number among all from left to right, is sought.
    fn moves_freely(&self, i: usize) -> bool {
        let is_at_end = match self.at_end {
            Some(Side::Left) => i == 0,
            Some(Side::Right) => i + 1 == 2 * self.on.len(),
            None => false,
        };
        !is_at_end && !self.held[i / 2][Side::BOTH[i % 2]]
    }

    /// Returns the largest step, as a share of the half-width of its contact or of the gap next to
    /// it: next to a kink the pressure shows how narrow the gap is.
    fn size(&self) -> T {
        let (half, last) = (T::of(0.5), self.moves.len() - 1);
        let half_width = |i: Width| half * self.width(i);
        let shares = self.system.free.iter().zip(&self.step).map(|(&i, step)| {
            let beside = [i.checked_sub(1), (i < last).then_some(i)].into_iter().flatten();
            step.abs() / beside.map(half_width).reduce(T::min).unwrap_or(T::one())
        });
        shares.fold(T::zero(), T::max)
    }

    /// Tells whether no limit has moved by more than a share of the half-width of its contact.
    fn is_within(&self, shares: impl Iterator<Item = T>) -> bool {
        let mut moves = self.moves.iter().zip(shares).enumerate();
        moves.all(|(i, (step, share))| step.abs() <= share * self.on[i / 2].half_width())
    }

    /// Estimates the errors of the limits, from the uncertainty of the equations and rounding.
    /// Conditions far apart are taken together: a limit feels the nearest.
    fn estimate(&mut self) {
        let n = self.system.open.len();
        self.open.clear();
        self.open.resize(n, T::zero());
        for first in 0..n.min(APART) {
            self.unit.clear();
            self.unit.resize(n, T::zero());
            let each = self.unit.iter_mut().zip(&self.system.open).skip(first).step_by(APART);
            each.for_each(|(unit, &error)| *unit = error);
            self.system.solve(&self.unit, &mut self.step);
            for (open, step) in self.open.iter_mut().zip(&self.step) {
                *open += step.abs();
            }
        }
        self.errors.clear();
        self.errors.resize(2 * self.on.len(), T::zero());
        for (&i, &open) in self.system.free.iter().zip(&self.open) {
            let on = self.on[i / 2];
            let rounding = T::epsilon() * on.left.abs().max(on.right.abs());
            self.errors[i] = T::of(4.0) * (open + rounding) / on.half_width();
        }
    }
}

/// Returns the outermost contact on a side.
pub(in super::super) fn outermost<T: Real>(on: &mut [Interval<T>], side: Side) -> &mut Interval<T> {
    let last = on.len() - 1;
    &mut on[if side == Side::Left { 0 } else { last }]
}

/// Puts an outermost limit at a place.
pub(in super::super) fn put<T: Real>(on: &mut [Interval<T>], side: Side, x: T) {
    let on = outermost(on, side);
    match side {
        Side::Left => on.left = x,
        Side::Right => on.right = x,
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
        held: &[Ends<bool>],
    ) -> (Vec<Interval<f64>>, Vec<f64>, Several<f64>) {
        let inversion = Inversion::default();
        let gap = Gap::new(Shape::Lent(&Flat), Shape::Lent(body), &inversion).unwrap();
        let mut several = Several::new(16.0 * f64::EPSILON);
        let mut newton = NewtonSeveral::new();
        newton.on = start.iter().map(|&[left, right]| Interval { left, right }).collect();
        newton.held = held.to_vec();
        let ends = gap.range().into();
        let conditions = Conditions { gap: &gap, load, ends, besides: None };
        assert!(newton.converge(&mut several, &conditions).is_ok(), "{:?}", newton.on);
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
                solve(&body, load / std::f64::consts::FRAC_PI_2, &start, &[Ends::both(false); 2]);
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
                // Next to a limit, its rounding counts.
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
        // The function m |T|/N with T = 2 x² - 1 scaled: declared kinks at ±sqrt(1/2).
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
            // The wedge |v| bears F = 2 a/π with κ = 1, on |v| <= a; each of the two contacts bears
            // half.
            let a = load * std::f64::consts::PI / 2.0;
            let [al, be] = [((1.0 - a) / 2.0).sqrt(), ((1.0 + a) / 2.0).sqrt()];
            let off = 0.05 * (be - al);
            let start = [[-be - off, -al + off], [al + off, be + off]];
            let (on, _, several) = solve(&body, load, &start, &[Ends::both(false); 2]);
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
