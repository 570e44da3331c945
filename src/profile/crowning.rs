//! The logarithmic relief of a roller.

use super::{Convexity, CurvePoint, ParametricProfile, ProfileError, finite, interval};
use crate::Real;

/// Logarithmic (Lundberg) crowning: `Y = -C ln(1 - (X/l)²)`, with `X = k`. This relief keeps the
/// pressure of a roller from rising at its ends (Lundberg, *Forschung auf dem Gebiete des
/// Ingenieurwesens* 10, 1939, 201).
///
/// In the plane it describes a body that is long across, such as a slide shoe with crowned ends.
/// The relief along the axis of a roller is a contact in space, for which a plane solution is only
/// a guide: take it as the relief of a [`FiniteRoller`](crate::FiniteRoller).
///
/// The slope `2 C X/((l - X)(l + X))` is infinite at ±l. Slope and height are computed from the
/// distances to the two ends, so that they keep their digits next to them.
///
/// ```
/// use linecontact::profile::Crowning;
/// use linecontact::{Contact, Control, Flat};
///
/// let (depth, half_length) = (0.01f64, 5.0);
/// let roller = Crowning::new(depth, half_length, [-half_length, half_length])?;
/// let contact = Contact::new(&Flat, &roller)?;
/// let solution = contact.solve(Control::HalfWidth(4.0))?;
/// // F = 2 κ C (l/sqrt(l² - L²) - 1)
/// assert!((solution.load() / (0.02 * (5.0 / 3.0 - 1.0)) - 1.0).abs() < 1e-14);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Crowning<T> {
    depth: T,
    half_length: T,
    domain: [T; 2],
}

impl<T: Real> Crowning<T> {
    /// Creates a crowning with depth C and half-length l between two abscissae, at most from -l to
    /// l. C is positive for an upper body and negative for a lower one.
    ///
    /// # Errors
    /// [`ProfileError::Parameter`] unless C is not zero, l is positive, both finite, and both ends
    /// are within ±l; [`ProfileError::Domain`].
    pub fn new(depth: T, half_length: T, domain: [T; 2]) -> Result<Self, ProfileError<T>> {
        finite("the depth", depth, !depth.is_zero(), "finite and not zero")?;
        finite("the half-length", half_length, half_length > T::zero(), "positive and finite")?;
        for end in interval(domain)? {
            finite("an end", end, end.abs() <= half_length, "within the half-length")?;
        }
        Ok(Self { depth, half_length, domain })
    }
}

impl<T: Real> ParametricProfile<T> for Crowning<T> {
    fn domain(&self) -> [T; 2] {
        self.domain
    }

    fn convexity(&self) -> Convexity {
        Convexity::of_sign(self.depth)
    }

    fn at(&self, k: T) -> CurvePoint<T> {
        let y = relief::height(self.depth, self.half_length, k);
        CurvePoint { x: k, y, dx: T::one(), dy: relief::slope(self.depth, self.half_length, k) }
    }

    fn slope_at(&self, x: T) -> Option<T> {
        Some(relief::slope(self.depth, self.half_length, x))
    }
}

/// Height and slope at x, shared with the closed form.
pub(crate) mod relief {
    use crate::Real;

    pub(crate) fn height<T: Real>(depth: T, half_length: T, x: T) -> T {
        let share = x / half_length;
        let logarithm = if share.abs() < T::of(0.5) {
            (-share * share).ln_1p()
        } else {
            let [left, right] = [half_length + x, half_length - x];
            ((left / half_length) * (right / half_length)).ln()
        };
        -depth * logarithm
    }

    pub(crate) fn slope<T: Real>(depth: T, half_length: T, x: T) -> T {
        let [left, right] = [half_length + x, half_length - x];
        depth * (x / left) * (T::of(2.0) / right)
    }
}
