//! What has to hold at the edges of a contact.

use crate::gap::{Cost, Gap};
use crate::quadrature::{Engine, Moments, Pressing, complete};
use crate::{ContactError, Interval, Real};

/// What becomes of one edge of the contact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Edge<T> {
    /// A smooth body: the limit is where the pressure ends at zero.
    Free,
    /// A sharp corner at this `x`, from which the contact does not part. The pressure may be
    /// infinite there.
    Fixed(T),
    /// A smooth body with a sharp corner at this `x`: free as long as the contact does not reach
    /// the corner, fixed from then on.
    UpTo(T),
    /// Adhesion over so short a range that it acts at the edge alone (Johnson, Kendall and
    /// Roberts), with this work of adhesion w: energy per unit area, not negative.
    Adhesive(T),
}

impl<T: Real> Edge<T> {
    /// The limit, where it is known.
    pub(super) fn limit(&self) -> Option<T> {
        match *self {
            Self::Fixed(x) => Some(x),
            _ => None,
        }
    }

    pub(super) fn is_free(&self) -> bool {
        matches!(self, Self::Free | Self::UpTo(_))
    }
}

/// What is asked of the contact as a whole.
#[derive(Clone, Copy)]
pub(super) enum Control<T> {
    Load(T),
    HalfWidth(T),
}

/// What a contact has to meet.
#[derive(Clone, Copy)]
pub(super) struct Conditions<T> {
    pub kappa: T,
    /// At -b and at a.
    pub edges: [Edge<T>; 2],
    pub control: Control<T>,
}

impl<T: Real> Conditions<T> {
    /// The load, or zero where it is not known.
    pub fn load(&self) -> T {
        match self.control {
            Control::Load(load) => load,
            Control::HalfWidth(_) => T::zero(),
        }
    }

    /// What adhesion takes from the load at each edge: half of `2 sqrt(κ w L)`. By roots, so as not to
    /// underflow.
    pub fn pull(&self, half_width: T) -> [T; 2] {
        self.edges.map(|edge| match edge {
            Edge::Adhesive(work) => self.kappa.sqrt() * work.sqrt() * half_width.sqrt(),
            _ => T::zero(),
        })
    }

    /// The load under which the edges that are not fixed are as they should be, on an average;
    /// `None` if both are fixed.
    pub fn balance(&self, on: Interval<T>, m: &Moments<T>) -> Option<T> {
        let half_width = on.half_width();
        let (mut sum, mut count) = (T::zero(), 0);
        let signs = [-T::one(), T::one()];
        for ((edge, pull), sign) in self.edges.iter().zip(self.pull(half_width)).zip(signs) {
            if edge.limit().is_none() {
                sum += self.kappa * half_width * (m.first + sign * m.mean) - pull - pull;
                count += 1;
            }
        }
        (count > 0).then(|| sum / T::count(count))
    }

    /// The interval, with those limits that are given.
    pub fn with_given_limits(&self, on: Interval<T>) -> Interval<T> {
        let width = on.right - on.left;
        let limits = self.edges.map(|edge| edge.limit());
        let given =
            Interval { left: limits[0].unwrap_or(on.left), right: limits[1].unwrap_or(on.right) };
        match limits {
            [Some(left), None] if left >= on.right => Interval { left, right: left + width },
            [None, Some(right)] if right <= on.left => Interval { left: right - width, right },
            _ => given,
        }
    }

    /// The interval, where both limits are given, or the half-width and one of them.
    pub fn both_limits(&self) -> Option<Interval<T>> {
        let limits = self.edges.map(|edge| edge.limit());
        match (limits, self.control) {
            ([Some(left), Some(right)], _) => Some(Interval { left, right }),
            ([Some(left), None], Control::HalfWidth(half_width)) => {
                Some(Interval { left, right: left + half_width + half_width })
            }
            ([None, Some(right)], Control::HalfWidth(half_width)) => {
                Some(Interval { left: right - half_width - half_width, right })
            }
            _ => None,
        }
    }

    /// The interval with its limits moved by steps in units of the half-width, given the load as a
    /// share of what the interval would carry. The half-width moves as its square would, by no more
    /// than a factor of 33 down or 4 up.
    pub fn moved(&self, on: Interval<T>, [right, left]: [T; 2], share: T) -> Interval<T> {
        let (one, half) = (T::one(), T::of(0.5));
        let half_width = on.half_width();
        let wider = half * (right - left);
        let wider = if wider < T::of(-0.3) && share > T::zero() && share < one {
            // Far off, the power of the half-width that the load goes with is read off the step: 2
            // for a round body, 1 for a wedge.
            let power = (one - share) / -wider;
            (share.powf(one / power) - one).max(T::of(-0.97))
        } else {
            let square = (one + wider + wider).max(T::of(1e-3));
            ((square - one) / (one + square.sqrt())).min(T::of(3.0))
        };
        let along = (half * (right + left)).max(-one).min(one);
        match self.edges.map(|edge| edge.limit()) {
            [None, None] => Interval {
                left: on.left + (along - wider) * half_width,
                right: on.right + (along + wider) * half_width,
            },
            [left, right] => Interval {
                left: left.unwrap_or(on.left - (wider + wider) * half_width),
                right: right.unwrap_or(on.right + (wider + wider) * half_width),
            },
        }
    }
}

/// The paper's conditions at the edges, Eq. (6): `|P(a - ε_a) - A| ≤ ε₁` and
/// `|P(ε_b - b) - B| ≤ ε₂`.
///
/// A is the pressure *at* a distance from the edge, where a smooth contact has
/// `P ≈ p₀ sqrt(2 ε_a/L)`. With A = 0 the limits come out too wide, by about 2 ε_a: the pressure
/// then ends in a small negative singularity. And the paper's quadrature needs some segments
/// between the two: a distance below a segment's width 2L/N gains nothing.
/// [`Edge::Free`] has neither flaw, and costs a twentieth or less.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgePressure<T> {
    /// A, the pressure wanted at `a - ε_a`; a pressure.
    pub at_a: T,
    /// B, the pressure wanted at `ε_b - b`; a pressure.
    pub at_b: T,
    /// ε_a, the distance from `a`; a length, positive.
    pub distance_a: T,
    /// ε_b, the distance from `-b`; a length, positive.
    pub distance_b: T,
    /// ε₁, how far the pressure may be from A; positive.
    pub tolerance_a: T,
    /// ε₂, how far the pressure may be from B; positive.
    pub tolerance_b: T,
}

impl<T: Real> EdgePressure<T> {
    /// A = B = 0, with the same distance and the same tolerance on both sides.
    pub fn zero(distance: T, tolerance: T) -> Self {
        Self {
            at_a: T::zero(),
            at_b: T::zero(),
            distance_a: distance,
            distance_b: distance,
            tolerance_a: tolerance,
            tolerance_b: tolerance,
        }
    }

    /// `a - ε_a` and `ε_b - b`.
    fn places(&self, on: Interval<T>) -> [T; 2] {
        [on.right - self.distance_a, on.left + self.distance_b]
    }

    /// Whether a contact meets the conditions, given by how much it misses them.
    pub(super) fn met(&self, on: Interval<T>, excess: &Excess<T>) -> Result<(), ContactError<T>> {
        let [x_a, x_b] = self.places(on);
        let at_a = excess.at_a / (T::pi() * on.edge_root(x_a));
        let at_b = excess.at_b / (T::pi() * on.edge_root(x_b));
        if at_a.abs() <= self.tolerance_a && at_b.abs() <= self.tolerance_b {
            Ok(())
        } else {
            Err(ContactError::EdgePressureNotMet { best: on, at_a, at_b })
        }
    }

    pub(super) fn check(&self) -> Result<(), ContactError<T>> {
        let entries = [
            ("A", self.at_a, false),
            ("B", self.at_b, false),
            ("ε_a", self.distance_a, true),
            ("ε_b", self.distance_b, true),
            ("ε₁", self.tolerance_a, true),
            ("ε₂", self.tolerance_b, true),
        ];
        for (name, value, positive) in entries {
            if !value.is_finite() || (positive && value <= T::zero()) {
                return Err(ContactError::EdgePressure { name, value });
            }
        }
        Ok(())
    }
}

/// The conditions at the edges, as two numbers to be brought to zero.
#[derive(Clone, Copy)]
pub(super) enum Goal<T> {
    /// Singularities of given strength.
    Strength { conditions: Conditions<T>, load: T },
    /// Eq. (6).
    Pressure { kappa: T, load: T, wanted: EdgePressure<T> },
}

/// By how much a trial contact misses its conditions, as forces per unit length. Positive at an
/// edge: the edge must move outward (the paper's readjustment rule).
#[derive(Clone, Copy)]
pub(super) struct Excess<T> {
    /// At `a`.
    pub at_a: T,
    /// At `-b`.
    pub at_b: T,
    /// Up to this, shift and spread are zero to rounding, or to the tolerances.
    floor: T,
    /// The load that the contact carries, where that is known.
    pub carried: Option<T>,
    /// The force that the conditions are missed by a share of.
    pub size: T,
    /// By what factor the width of a round body should change, whose load goes with its square.
    pub growth: T,
    /// Estimated error of the edges relative to the half-width, from the quadrature.
    pub error: T,
}

impl<T: Real> Excess<T> {
    /// Positive: the whole contact must move to the right.
    pub fn shift(&self) -> T {
        self.above(self.floor, self.at_a - self.at_b)
    }

    /// The shift, or zero if it is settled well enough for the load to be looked at: moving a
    /// contact changes its spread by less than its shift, so with a shift a thousandth of the
    /// spread the sign of the spread is certain. As the spread vanishes this tightens.
    pub fn rough_shift(&self) -> T {
        let spread = self.at_a + self.at_b;
        self.above(self.floor.max(T::of(1e-3) * spread.abs()), self.at_a - self.at_b)
    }

    /// Positive: the contact must widen.
    pub fn spread(&self) -> T {
        self.above(self.floor, self.at_a + self.at_b)
    }

    /// The spread on a scale on which the width is found in fewer steps: the logarithm of the
    /// load over the load carried, which falls evenly whatever the shape of the bodies.
    pub fn deficit(&self) -> T {
        let (half, spread) = (T::of(0.5), self.spread());
        match self.carried {
            Some(carried) if carried > T::zero() => {
                let excess = half * spread / carried;
                // Close to zero from the difference, elsewhere from the ratio, which may be huge.
                if excess.abs() < half { excess.ln_1p() } else { self.growth.ln() / half }
            }
            // Nothing is carried: larger than any logarithm.
            Some(_) => T::epsilon().recip(),
            None => spread,
        }
    }

    fn above(&self, floor: T, value: T) -> T {
        if value.abs() <= floor { T::zero() } else { value }
    }

    pub fn is_finite(&self) -> bool {
        (self.at_a - self.at_b).is_finite() && (self.at_a + self.at_b).is_finite()
    }
}

/// Far from x = 0 the abscissae themselves are rounded: by how much, relative to the half-width.
fn rounding<T: Real>(on: Interval<T>) -> T {
    T::epsilon() * on.left.abs().max(on.right.abs()) / on.half_width()
}

/// Estimated error of the edges relative to the half-width, where the conditions there are that a sum of
/// the moments of this size is what it is.
pub(super) fn relative_error<T: Real>(on: Interval<T>, m: &Moments<T>, sum: T) -> T {
    m.error / sum + m.inversion / on.half_width() + rounding(on)
}

impl<T: Real> Goal<T> {
    /// The limits -b and a, where they are given.
    pub fn limits(&self) -> [Option<T>; 2] {
        match *self {
            Self::Strength { conditions, .. } => conditions.edges.map(|edge| edge.limit()),
            Self::Pressure { .. } => [None; 2],
        }
    }

    /// Whether adhesion pulls at one edge more than at the other.
    pub fn is_lopsided(&self) -> bool {
        let Self::Strength { conditions, .. } = self else { return false };
        let [at_b, at_a] = conditions.pull(T::one());
        at_b != at_a
    }

    /// Whether the conditions can be looked at on bodies that cover this range of x.
    pub fn check(&self, range: [T; 2]) -> Result<(), ContactError<T>> {
        if let Self::Pressure { wanted, .. } = self {
            for (name, value) in [("ε_a", wanted.distance_a), ("ε_b", wanted.distance_b)] {
                if value >= range[1] - range[0] {
                    return Err(ContactError::EdgePressure { name, value });
                }
            }
        }
        Ok(())
    }

    /// A contact must be wider than this.
    pub fn least_width(&self) -> T {
        match self {
            Self::Strength { .. } => T::zero(),
            Self::Pressure { wanted, .. } => wanted.distance_a.max(wanted.distance_b),
        }
    }

    /// Tries a contact.
    pub fn excess(
        &self,
        gap: &Gap<'_, T>,
        on: Interval<T>,
        engine: &mut dyn Engine<T>,
        cost: &mut Cost,
    ) -> Result<Excess<T>, ContactError<T>> {
        let two = T::of(2.0);
        match *self {
            // π L K at each edge: forces, which stay finite as the contact shrinks.
            Self::Strength { conditions, load } => {
                let m = engine.moments(gap, on)?;
                let stiffness = conditions.kappa * on.half_width();
                let rounding = rounding(on);
                let carried = stiffness * m.first;
                let balance = stiffness * m.mean;
                let pull = conditions.pull(on.half_width()).map(|pull| pull + pull);
                let half = T::of(0.5);
                // Beside a corner the two may cancel, and little load be left.
                let both = m.first.abs() + m.mean.abs();
                // Only the free edges count.
                let (at_a, at_b, needed, borne, sum) = match self.limits() {
                    [Some(_), None] => {
                        let (needed, borne) = (load + pull[1], carried + balance);
                        (needed - borne, needed - borne, needed, borne, both)
                    }
                    [None, Some(_)] => {
                        let (needed, borne) = (load + pull[0], carried - balance);
                        (needed - borne, needed - borne, needed, borne, both)
                    }
                    _ => {
                        let (at_a, at_b) = (load + pull[1] - carried, load + pull[0] - carried);
                        let needed = load + half * (pull[0] + pull[1]);
                        (at_a - balance, at_b + balance, needed, carried, m.first.abs())
                    }
                };
                let ratio = needed / borne;
                let least = T::epsilon().powi(5);
                let growth = if !(borne > T::zero() && needed > T::zero()) {
                    two
                } else if ratio > least && ratio < least.recip() {
                    ratio.sqrt()
                } else {
                    // By roots, so as not to underflow.
                    needed.sqrt() / borne.sqrt()
                };
                Ok(Excess {
                    at_a,
                    at_b,
                    // The estimated error errs on the safe side.
                    floor: stiffness * (T::of(0.25) * m.error).max(rounding * m.size),
                    carried: Some(borne),
                    size: stiffness * sum,
                    growth,
                    error: relative_error(on, &m, sum),
                })
            }
            // Likewise π sqrt((x + b)(a - x)) (P - A): a narrow contact is in balance where it is
            // in the middle, however unlike the two distances are.
            Self::Pressure { kappa, load, wanted } => {
                let [x_a, x_b] = wanted.places(on);
                for (name, value, x, end) in [
                    ("ε_a", wanted.distance_a, x_a, on.right),
                    ("ε_b", wanted.distance_b, x_b, on.left),
                ] {
                    if x == end {
                        return Err(ContactError::EdgePressure { name, value });
                    }
                }
                engine.prepare(gap, on)?;
                complete(engine, gap, on, cost)?;
                let pressing = Pressing { kappa, load, free: [false; 2] };
                let mut error = T::zero();
                let mut excess = |x, pressure| -> Result<T, ContactError<T>> {
                    let estimate = engine.estimate(gap, &pressing, x, cost)?;
                    let root = T::pi() * on.edge_root(x);
                    error += root * estimate.error / load;
                    Ok(root * (estimate.value - pressure))
                };
                let (at_a, at_b) = (excess(x_a, wanted.at_a)?, excess(x_b, wanted.at_b)?);
                let growth = if at_a + at_b > T::zero() { two } else { two.recip() };
                let tolerance = |x, tolerance| T::pi() * on.edge_root(x) * tolerance;
                let tolerance_a = tolerance(x_a, wanted.tolerance_a);
                let floor = T::of(0.5) * tolerance_a.min(tolerance(x_b, wanted.tolerance_b));
                Ok(Excess { at_a, at_b, floor, carried: None, size: load, growth, error })
            }
        }
    }
}
