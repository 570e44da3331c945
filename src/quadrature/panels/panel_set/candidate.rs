//! A span that is tried out as one panel, and how often it may be halved.

use crate::Real;
use crate::profile::Noise;
use crate::quadrature::panels::Panel;

/// How often a span is halved beside a jump: what is left is no part of any integral.
pub(super) const MOST_LEVELS: usize = 110;

/// The share to which a panel of half the length must bring the error down where a span is halved
/// yet more often: beside a root of high order, such as that in the slope of `|x|^(11/10)`, the
/// pressure still depends on what is left.
const FALL_OF_A_ROOT: f64 = 0.98;

/// How often it is halved then: the derivatives are not to overflow.
const LEVELS_OF_A_ROOT: usize = 500;

/// How often at the most a span is halved to resolve a wave. (It may be hundreds of kinks.)
pub(super) const LEVELS_OF_A_WAVE: usize = 10;

/// A panel that may have to be split.
#[derive(Clone, Copy)]
pub(super) struct Candidate<T> {
    pub panel: Panel<T>,
    pub split: bool,
    /// The error that it may have.
    pub allowed: T,
    /// How often the span has been halved.
    pub level: usize,
    /// Whether halving it once more should help, however often that has been done.
    pub falls: bool,
    /// Whether it is part of what looked like noise and is none.
    pub wave: bool,
    /// Whether its heights contradict its slopes.
    pub hides: bool,
    /// The share of its size by which a derivative is off that calls for a split, or zero.
    pub derivatives: T,
}

impl<T: Real> Candidate<T> {
    /// Not tried yet.
    pub fn new(x: [T; 2]) -> Self {
        let (panel, zero) = (Panel::new(x), T::zero());
        let (falls, wave, hides) = (false, false, false);
        Self { panel, split: false, allowed: zero, level: 0, falls, wave, hides, derivatives: zero }
    }

    /// Whether it is better than what it is a half of; with other nodes it cannot be told.
    pub fn falls_below(&self, whole: &Self) -> bool {
        let less = self.panel.tail <= T::of(FALL_OF_A_ROOT) * whole.panel.tail;
        less || self.panel.n != whole.panel.n
    }

    /// Whether it has not been halved too often yet.
    pub fn may_be_halved(&self) -> bool {
        let most = if self.wave {
            LEVELS_OF_A_WAVE
        } else if self.falls {
            LEVELS_OF_A_ROOT
        } else {
            MOST_LEVELS
        };
        self.level < most
    }
}

/// Whether a panel can be halved: it is longer than a few units in the last place, or than the noise of X.
pub(super) fn is_long<T: Real>([left, right]: [T; 2], noise: Option<[Noise<T>; 2]>) -> bool {
    let middle = T::of(0.5) * left + T::of(0.5) * right;
    let rounded = T::epsilon() * left.abs().max(right.abs());
    let fine = T::of(8.0) * noise.map_or(rounded, |[one, other]| rounded.max(one.x).max(other.x));
    right - left > fine && middle > left && middle < right
}
