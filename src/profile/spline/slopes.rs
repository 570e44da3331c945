//! The slopes that give a cubic spline a continuous second derivative.

use crate::Real;

/// Returns the slope at each of four or more points, x rising, with "not a knot" at both ends (de
/// Boor, *A Practical Guide to Splines*, 1978, chapter IV).
pub(super) fn slopes<T: Real>(points: &[[T; 2]]) -> Vec<T> {
    let (n, two, three) = (points.len(), T::of(2.0), T::of(3.0));
    let h = |i: usize| points[i + 1][0] - points[i][0];
    let chord = |i: usize| (points[i + 1][1] - points[i][1]) / h(i);
    // Condition at an end, from the two distances next to it, the outer one first.
    let end = |[h0, h1]: [T; 2], [c0, c1]: [T; 2]| {
        let sum = h0 + h1;
        (three * h0 + two * h1) * (h1 / sum) * c0 + h0 * (h0 / sum) * c1
    };
    // Elimination from the left: slope i is `right[i] - above[i]` times slope i + 1.
    let mut above = Vec::with_capacity(n);
    let mut right = Vec::with_capacity(n);
    above.push((h(0) + h(1)) / h(1));
    right.push(end([h(0), h(1)], [chord(0), chord(1)]) / h(1));
    for i in 1..n - 1 {
        let (before, after) = (h(i - 1), h(i));
        let pivot = two * (before + after) - after * above[i - 1];
        let rhs = three * (after * chord(i - 1) + before * chord(i)) - after * right[i - 1];
        above.push(before / pivot);
        right.push(rhs / pivot);
    }
    let (outer, inner) = (h(n - 2), h(n - 3));
    let rhs = end([outer, inner], [chord(n - 2), chord(n - 3)]);
    let pivot = inner - (outer + inner) * above[n - 2];
    right.push((rhs - (outer + inner) * right[n - 2]) / pivot);
    for i in (0..n - 1).rev() {
        right[i] = right[i] - above[i] * right[i + 1];
    }
    right
}
