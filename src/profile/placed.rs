//! A body moved, turned, mirrored or scaled.

use super::{Convexity, CurvePoint, ParametricProfile, Piece, ProfileError, finite};
use crate::Real;

/// Name of a quantity in errors.
const FACTORS: &str = "the product of all factors of a placement";

/// Placement of a body: a map of the plane that keeps angles, built step by step.
///
/// Each step follows the earlier ones and acts about the origin:
/// `Placement::default().rotated(0.1).shifted(2.0, 0.0)` turns a body and then moves it.
/// [`flipped`](Self::flipped) brings a body to the other side of a contact: flipping both bodies
/// and exchanging them leaves the contact unchanged.
///
/// ```
/// use linecontact::profile::{Ellipse, Placed, Placement};
/// use linecontact::{Contact, Control};
///
/// // Two rollers, one above the other and 3 to its right.
/// let roller = Ellipse::circle(10.0f64, [-1.4, 1.4])?;
/// let above = Placed::new(roller, Placement::default().shifted(3.0, 0.0))?;
/// let below = Placed::new(roller, Placement::default().flipped())?;
/// let contact = Contact::new(&below, &above)?;
/// let solution = contact.solve(Control::Load(0.01))?;
/// assert!((solution.hull().centre() - 1.5).abs() < 1e-13);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement<T> {
    /// Matrix `[[a, b], [c, d]]`: `x ↦ a x + b y`, `y ↦ c x + d y`.
    matrix: [[T; 2]; 2],
    shift: [T; 2],
    /// First step that cannot be done, and its value.
    fault: Option<(&'static str, T)>,
}

impl<T: Real> Default for Placement<T> {
    fn default() -> Self {
        let (zero, one) = (T::zero(), T::one());
        Self { matrix: [[one, zero], [zero, one]], shift: [zero; 2], fault: None }
    }
}

impl<T: Real> Placement<T> {
    fn asked(mut self, what: &'static str, value: T, possible: bool) -> Self {
        if !(possible && value.is_finite()) {
            self.fault = self.fault.or(Some((what, value)));
        }
        self
    }

    /// Moves the body by `along` in the direction of `X` and by `across` in the direction of `Y`.
    #[must_use]
    pub fn shifted(mut self, along: T, across: T) -> Self {
        for (shift, by) in [along, across].into_iter().enumerate() {
            self = self.asked("a shift of a placement", by, true);
            self.shift[shift] += by;
        }
        self
    }

    /// Exchanges left and right: `X` becomes `-X`, without any rounding.
    #[must_use]
    pub fn mirrored(mut self) -> Self {
        self.matrix[0] = self.matrix[0].map(|entry| -entry);
        self.shift[0] = -self.shift[0];
        self
    }

    /// Turns the body upside down: `Y` becomes `-Y`, without any rounding. Mirrored and flipped is
    /// half a turn.
    #[must_use]
    pub fn flipped(mut self) -> Self {
        self.matrix[1] = self.matrix[1].map(|entry| -entry);
        self.shift[1] = -self.shift[1];
        self
    }

    /// Turns the body by an angle in radians, from the X axis towards the Y axis.
    #[must_use]
    pub fn rotated(self, angle: T) -> Self {
        let (sin, cos) = angle.sin_cos();
        let turn = |[x, y]: [T; 2]| [cos * x - sin * y, sin * x + cos * y];
        let [[a, b], [c, d]] = self.matrix;
        let [[a, c], [b, d]] = [turn([a, c]), turn([b, d])];
        let turned = Self { matrix: [[a, b], [c, d]], shift: turn(self.shift), ..self };
        turned.asked("an angle of a placement", angle, true)
    }

    /// Multiplies all lengths by a factor; a negative one adds half a turn.
    #[must_use]
    pub fn scaled(self, factor: T) -> Self {
        let times = |row: [T; 2]| row.map(|entry| entry * factor);
        let scaled = Self { matrix: self.matrix.map(times), shift: times(self.shift), ..self };
        scaled.asked("a factor of a placement", factor, !factor.is_zero())
    }

    /// Returns a point of the body where it is placed.
    pub(super) fn apply(&self, point: [T; 2]) -> [T; 2] {
        let [x, y] = self.direction(point);
        [x + self.shift[0], y + self.shift[1]]
    }

    /// Tells whether `X` depends on `X` alone, and `Y` on `Y`.
    fn is_upright(&self) -> bool {
        self.matrix[0][1].is_zero() && self.matrix[1][0].is_zero()
    }

    fn direction(&self, [x, y]: [T; 2]) -> [T; 2] {
        let [[a, b], [c, d]] = self.matrix;
        // Keeps an infinite slope infinite.
        if self.is_upright() { [a * x, d * y] } else { [a * x + b * y, c * x + d * y] }
    }

    /// Tells whether left and right are exchanged.
    pub(super) fn reverses(&self) -> bool {
        self.matrix[0][0] < T::zero()
    }

    pub(crate) fn point(&self, CurvePoint { x, y, dx, dy }: CurvePoint<T>) -> CurvePoint<T> {
        let ([x, y], [dx, dy]) = (self.apply([x, y]), self.direction([dx, dy]));
        CurvePoint { x, y, dx, dy }
    }
}

/// Smooth body in another place. [`Piecewise::placed`](super::Piecewise::placed) places a body
/// joined from pieces.
///
/// A body that is rotated too far turns back in `X`, which is reported like any other such body
/// ([`ProfileError::TurnsBack`]).
///
/// ```
/// use linecontact::ParametricProfile;
/// use linecontact::profile::{Parabola, Placed, Placement};
///
/// let parabola = Parabola::new(1.0, [-1.0, 1.0])?;
/// let moved = Placed::new(parabola, Placement::default().scaled(2.0).shifted(5.0, 0.5))?;
/// assert_eq!([moved.x(1.0), moved.y(1.0)], [7.0, 1.5]);
/// # Ok::<(), linecontact::ProfileError<f64>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placed<T, P> {
    curve: P,
    placement: Placement<T>,
}

impl<T: Real, P: ParametricProfile<T>> Placed<T, P> {
    /// Creates the body `curve` at its placement.
    ///
    /// # Errors
    /// [`ProfileError::Parameter`] if a step of the placement was not finite, or a factor was zero;
    /// [`ProfileError::Joined`] for a body of several pieces.
    pub fn new(curve: P, placement: Placement<T>) -> Result<Self, ProfileError<T>> {
        if let Some((what, value)) = placement.fault {
            let must = if value.is_finite() { "not zero" } else { "finite" };
            return Err(ProfileError::Parameter { name: what, value, must });
        }
        let [[a, b], [c, d]] = placement.matrix;
        let size = a.hypot(b);
        finite(FACTORS, size, size > T::zero(), "finite and not zero")?;
        for value in [c, d, placement.shift[0], placement.shift[1]] {
            finite("the sum of the shifts of a placement", value, true, "finite")?;
        }
        if let Some((pieces, _)) = Piece::first_of(&curve)? {
            return Err(ProfileError::Joined { pieces });
        }
        Ok(Self { curve, placement })
    }
}

impl<T: Real, P: ParametricProfile<T>> ParametricProfile<T> for Placed<T, P> {
    fn domain(&self) -> [T; 2] {
        // The ends of a flat body stay finite where it is magnified.
        let size = self.placement.matrix.map(|[a, b]| a.abs() + b.abs());
        let most = T::max_value().unwrap_or(T::one() / T::epsilon()) * T::of(0.25);
        let most = most / size[0].max(size[1]).max(T::one());
        self.curve.domain().map(|end| end.max(-most).min(most))
    }

    fn convexity(&self) -> Convexity {
        let [[a, b], [c, d]] = self.placement.matrix;
        // d²Y/dX² is multiplied by the determinant over the third power of dX/dx.
        let span = if self.placement.is_upright() {
            a
        } else {
            let [from, to] = self.curve.domain();
            let CurvePoint { dx, dy, .. } = self.curve.at(T::of(0.5) * from + T::of(0.5) * to);
            (a * dx + b * dy) * dx
        };
        let determinant = a * d - b * c;
        if (determinant > T::zero()) == (span > T::zero()) {
            self.curve.convexity()
        } else {
            self.curve.convexity().flipped()
        }
    }

    fn at(&self, k: T) -> CurvePoint<T> {
        self.placement.point(self.curve.at(k))
    }

    fn at_many(&self, k: &[T], points: &mut [CurvePoint<T>]) {
        self.curve.at_many(k, points);
        for point in points {
            *point = self.placement.point(*point);
        }
    }

    fn slope_at(&self, x: T) -> Option<T> {
        if !self.placement.is_upright() {
            return None;
        }
        let [[a, _], [_, d]] = self.placement.matrix;
        let slope = self.curve.slope_at((x - self.placement.shift[0]) / a)?;
        Some(slope * (d / a))
    }

    fn slope_deviation(&self, _: &[T], _: &[T]) -> Option<T> {
        // Without places a deviation tells only whether the curve is exact.
        self.curve.slope_deviation(&[], &[])
    }
}
