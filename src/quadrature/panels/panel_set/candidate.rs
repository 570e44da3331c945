//! Span tried out as one panel, and the limits of its halving.

use crate::Real;
use crate::profile::Noise;
use crate::quadrature::panels::Panel;

/// Most halvings of a span next to a jump: the rest is then too short to count in any integral.
pub(super) const MAX_AT_JUMP: usize = 110;

/// Error of a panel as a share of its rise, times the share by which that falls from one halving to
/// the next: a rise like a power p of the distance adds 1/p of itself to the pressure, with
/// `2⁻ᵖ = 1 - p ln 2`. The estimate is 24 errors or more, which leaves half as much again. Of a
/// square root, which falls by 0.29, the coefficients tell enough.
const BY_FALL: f64 = std::f64::consts::LN_2 / 16.0;
const FALL_OF_A_SQUARE_ROOT: f64 = 1.0 - std::f64::consts::FRAC_1_SQRT_2;

/// Length of a panel, in units in the last place of x, on which their rounding explains some of
/// what its series misses.
pub(super) const FEW_ULPS: f64 = 1024.0;

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
    /// True if the series misses the slope at an end by more than noise.
    pub has_tip: bool,
    /// Relative error of a derivative that calls for a split, or zero.
    pub derivatives: T,
    /// Rise of the slope on the panel, or what its series misses at the end of a piece; the same of
    /// the span that was halved, and of the one before.
    pub rise: T,
    pub rose: [T; 2],
}

impl<T: Real> Candidate<T> {
    /// Returns an untried candidate.
    pub fn new(x: [T; 2]) -> Self {
        let [split, falls, sparse, wave, hides, has_tip] = [false; 6];
        let (panel, [allowed, derivatives, rise]) = (Panel::new(x), [T::zero(); 3]);
        let (level, rose) = (0, [T::zero(); 2]);
        Self {
            panel,
            split,
            allowed,
            level,
            falls,
            sparse,
            wave,
            hides,
            has_tip,
            derivatives,
            rise,
            rose,
        }
    }

    /// Tells whether a panel with a larger error than this would be halved, but is too short.
    pub fn is_given_up(&self, allowed: T) -> bool {
        let [left, right] = self.panel.x;
        let short = T::of(FEW_ULPS) * T::epsilon() * left.abs().max(right.abs());
        self.panel.error > allowed && (self.level >= MAX_AT_JUMP || right - left < short)
    }

    /// Raises the error of a panel that is too short to be halved: what is left on it rises like a
    /// root, or is a jump. A rise that is NaN says nothing.
    pub fn own_up(&mut self) {
        // One halving may have cut next to the corner.
        let left = (self.rise / self.rose[0]).max(self.rose[0] / self.rose[1]);
        let falls = (T::one() - left).max(T::one() / T::count(MAX_AT_JUMP));
        let share = T::of(BY_FALL) * (falls.recip() - T::of(FALL_OF_A_SQUARE_ROOT.recip()));
        let doubt = share * self.rise;
        let is_known = doubt.partial_cmp(&doubt).is_some();
        self.panel.error =
            self.panel.error.max(if is_known { doubt } else { T::one() / T::zero() });
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

#[cfg(test)]
mod tests {
    use super::Candidate;

    #[test]
    fn a_rise_that_is_unknown_is_the_worst() {
        let own_up = |rise: f64| {
            let mut trial = Candidate { rise, rose: [0.1; 2], ..Candidate::new([0.0, 1e-15]) };
            trial.own_up();
            trial.panel.error
        };
        // As much again in each of the 110 halvings to come.
        assert!((own_up(0.1) - 0.46).abs() < 0.01);
        assert!(own_up(f64::NAN).is_infinite());
    }
}
