//! The body of a closed form as a profile.

use super::ClosedForm;
use crate::{CurvePoint, ParametricProfile, Piecewise, PiecewiseError, Real};

/// Smooth part of the body of a closed form: the graph of its height, with `k = x`.
#[derive(Clone, Copy, Debug)]
pub struct Graph<'f, T> {
    form: &'f dyn ClosedForm<T>,
    ends: [T; 2],
}

/// Returns the body of a closed form between two abscissae, in pieces that end where its slope is
/// not smooth. With [`Flat`](crate::Flat) below and the form's [`edges`](ClosedForm::edges) it is
/// the scene that the form solves.
///
/// # Errors
/// [`PiecewiseError`] if the ends are not in order, or if the body has no slope at one of them.
pub fn body<T: Real>(
    form: &dyn ClosedForm<T>,
    from: T,
    to: T,
) -> Result<Piecewise<T, Graph<'_, T>>, PiecewiseError<T>> {
    let mut ends = vec![from];
    ends.extend(form.breakpoints().into_iter().filter(|&x| x > from && x < to));
    ends.push(to);
    Piecewise::new(ends.windows(2).map(|ends| Graph { form, ends: [ends[0], ends[1]] }).collect())
}

impl<T: Real> Graph<'_, T> {
    fn slope(&self, x: T) -> T {
        if x == self.ends[1] { self.form.slope_left(x) } else { self.form.slope(x) }
    }
}

impl<T: Real> ParametricProfile<T> for Graph<'_, T> {
    fn domain(&self) -> [T; 2] {
        self.ends
    }

    fn at(&self, k: T) -> CurvePoint<T> {
        CurvePoint { x: k, y: self.form.height(k), dx: T::one(), dy: self.slope(k) }
    }

    fn slope_at(&self, x: T) -> Option<T> {
        Some(self.slope(x))
    }
}
