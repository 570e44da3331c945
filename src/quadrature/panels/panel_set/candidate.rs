//! Span tried out as one panel, and the limits of its halving.

use crate::Real;
use crate::profile::Noise;
use crate::quadrature::panels::Panel;

/// Most halvings of a span next to a jump: the rest is then too short to count in any integral.
pub(super) const MAX_AT_JUMP: usize = 110;

/// Share of the error that a half may keep if halving is to go on beyond [`MAX_AT_JUMP`]: next to a
/// root of high order, as in the slope of `|x|^(11/10)`, the pressure still depends on the rest.
pub(super) const FALL_OF_A_ROOT: f64 = 0.98;

/// Most halvings next to such a root, so that derivatives do not overflow.
const LEVELS_OF_A_ROOT: usize = 500;

/// Most halvings of a span to resolve a wave. (It may be hundreds of kinks.)
pub(super) const LEVELS_OF_A_WAVE: usize = 10;

/// Panel that may have to be split.
#[derive(Clone, Copy)]
pub(super) struct Candidate<T> {
    pub panel: Panel<T>,
    pub split: bool,
    /// Allowed error of the slope.
    pub allowed: T,
    /// Number of halvings so far.
    pub level: usize,
    /// True if another halving should help, whatever the level.
    pub falls: bool,
    /// True if parts start with the fewest nodes: a halving has doubled the error, as of noise, or
    /// there seems to be a kink, which needs as many halvings whatever their nodes. (A loose
    /// tolerance would end them early.)
    pub sparse: bool,
    /// True if the span is part of a wave that looked like noise.
    pub wave: bool,
    /// True if the heights contradict the slopes.
    pub hides: bool,
    /// Relative error of a derivative that calls for a split, or zero.
    pub derivatives: T,
}

impl<T: Real> Candidate<T> {
    /// Returns an untried candidate.
    pub fn new(x: [T; 2]) -> Self {
        let [split, falls, sparse, wave, hides] = [false; 5];
        let (panel, [allowed, derivatives]) = (Panel::new(x), [T::zero(); 2]);
        Self { panel, split, allowed, level: 0, falls, sparse, wave, hides, derivatives }
    }

    /// Tells whether the coefficients fall as those of a kink do, like a low power of their number:
    /// from the second quarter to the last to a third, a ninth or a twenty-seventh. Those of a wave
    /// stay as long as it is not resolved, and then fall by far more.
    pub fn has_kink(&self) -> bool {
        let (n, largest) = (self.panel.n, |most: T, a: &T| most.max(a.abs()));
        let largest = |from| self.panel.series[from..from + n / 4].iter().fold(T::zero(), largest);
        let (before, last) = (largest(n / 4), largest(n - n / 4));
        last + last < before && T::count(n) * last > before
    }

    /// Tells whether the span may be halved again.
    pub fn may_be_halved(&self) -> bool {
        let most = if self.wave {
            LEVELS_OF_A_WAVE
        } else if self.falls {
            LEVELS_OF_A_ROOT
        } else {
            MAX_AT_JUMP
        };
        self.level < most
    }
}

/// Tells whether a panel can be halved: it is longer than a few units in the last place, and than
/// the noise of X.
pub(super) fn is_long<T: Real>([left, right]: [T; 2], noise: Option<[Noise<T>; 2]>) -> bool {
    let middle = T::of(0.5) * left + T::of(0.5) * right;
    let rounded = T::epsilon() * left.abs().max(right.abs());
    let fine = T::of(8.0) * noise.map_or(rounded, |[one, other]| rounded.max(one.x).max(other.x));
    right - left > fine && middle > left && middle < right
}
