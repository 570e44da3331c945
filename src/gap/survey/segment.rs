//! A cubic between two points of a graph.

use crate::Real;

/// Hermite's cubic, over the share t of the way from one point to the next.
pub(super) struct Segment<T> {
    pub width: T,
    height: T,
    /// Slope from end to end.
    pub chord: T,
    /// Slope of the chord less the slope at the start, and slope at the end less the slope of the
    /// chord.
    bends: [T; 2],
}

impl<T: Real> Segment<T> {
    /// Makes the cubic through two points `[x, y]` with given slopes.
    pub fn new([from, height]: [T; 2], [to, other]: [T; 2], slopes: [T; 2]) -> Self {
        let cubic = Self::exact([from, height], [to, other], slopes);
        let [first, second] = cubic.bends;
        // With a bend of more than twice the other one the cubic would leave the triangle of the
        // tangents, and an end that is nearly upright, or a kink, would make it swing.
        let within = |bend: T, other: T| {
            let most = T::of(2.0) * other.abs();
            // NaN where the slope is not known: then as on a parabola.
            if bend.partial_cmp(&bend).is_some() { bend.max(-most).min(most) } else { other }
        };
        let bends = [within(first, second), within(second, first)];
        let usable = |bend: T| if bend.is_finite() { bend } else { T::zero() };
        Self { bends: bends.map(usable), ..cubic }
    }

    /// Makes the cubic whatever its bends, for a body that is known to be a cubic.
    pub fn exact([from, height]: [T; 2], [to, other]: [T; 2], slopes: [T; 2]) -> Self {
        let width = to - from;
        let chord = (other - height) / width;
        Self { width, height, chord, bends: [chord - slopes[0], slopes[1] - chord] }
    }

    /// Returns height and slope.
    pub fn at(&self, t: T) -> [T; 2] {
        let ([first, second], two) = (self.bends, T::of(2.0));
        let u = T::one() - t;
        // The chord, less a bulge that has the right slopes at both ends.
        let bulge = t * u * (first * u + second * t);
        let slope = first * u * (u - two * t) + second * t * (two * u - t);
        [self.height + self.width * (t * self.chord - bulge), self.chord - slope]
    }

    /// Returns the share of the way to the lowest place, if it is between the ends.
    pub fn minimum(&self) -> Option<T> {
        let ([first, second], two, three) = (self.bends, T::of(2.0), T::of(3.0));
        // The slope is a + b t + c t².
        let a = self.chord - first;
        let b = two * (two * first - second);
        let c = three * (second - first);
        let root = (b * b - T::of(4.0) * a * c).sqrt();
        // Zero at which the slope rises.
        let t = if b > T::zero() { -two * a / (b + root) } else { (root - b) / (two * c) };
        (t > T::zero() && t < T::one()).then_some(t)
    }
}
