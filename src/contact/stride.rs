//! Which width to try next while the load is being enclosed.

use crate::Real;

/// The largest power of the width that a load is taken to go with.
const STEEPEST: f64 = 40.0;

/// A relative step that is certain to change a number.
pub(super) fn ulps<T: Real>() -> T {
    T::of(8.0) * T::epsilon()
}

/// Guesses widths from how the load has answered to the last ones: it is taken to go with a power
/// of the width, which is 2 for bodies round where they touch, and is seen after two trials.
pub(super) struct Stride<T> {
    exponent: T,
    /// The last half-width and the growth asked for there.
    before: Option<[T; 2]>,
    /// By which power of the expected factor to change the width, so as to pass the root and so
    /// enclose it, and by how much beyond that factor at most. At first a little; if that did not
    /// pass it, twice and four times as far (on a logarithmic scale).
    power: T,
    beyond: T,
}

impl<T: Real> Stride<T> {
    pub fn new() -> Self {
        let little = T::of(1.1);
        Self { exponent: T::of(2.0), before: None, power: little, beyond: little }
    }

    /// The next half-width after one that is too narrow (`wider`) or too wide. `growth` is the
    /// factor by which a round body would have to grow.
    pub fn next(&mut self, half_width: T, growth: T, wider: bool) -> T {
        if let Some([last, asked]) = self.before.replace([half_width, growth]) {
            let seen = T::of(-2.0) * (growth / asked).ln() / (half_width / last).ln();
            if seen > T::of(0.5) {
                self.exponent = seen.min(T::of(STEEPEST));
            }
        }
        let pull = growth.powf(T::of(2.0) / self.exponent);
        let factor = if wider {
            pull.powf(self.power).min(pull * self.beyond).max(T::one() + ulps())
        } else {
            pull.powf(self.power).max(pull / self.beyond).min(T::one() - ulps())
        };
        (self.power, self.beyond) = (self.power + self.power, self.beyond.powi(4));
        half_width * factor
    }
}
