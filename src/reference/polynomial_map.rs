//! Several contacts made of one, by a polynomial.

use super::{ClosedForm, ReferenceError, check, positive};
use crate::numerics::ascending;
use crate::{Edge, Interval, Real};

/// N contacts in a row, made of one: the body `H(v(x))/N`, where H is the body of another form with
/// the contact `[-b, a]` in v, and v is a polynomial that rises or falls over all of `[-b, a]` N
/// times.
///
/// ```text
/// v(x) = s T_N(x/r),   T_N(cos φ) = cos Nφ,   s > a, b
/// contacts: where -b ≤ v(x) ≤ a,   P(x) = abs(v'(x)) P_H(v(x))/N,   F/N on each
/// ```
///
/// The form is exact. Since `Σ 1/(x - t) = v'(x)/(v(x) - w)` over the N places t at which v is w,
/// `PV∫ P(t)/(x - t) dt = v'(x)/N PV∫ P_H(w)/(v(x) - w) dw`, and `v'/N` also multiplies the slope
/// of H. Every gap between two contacts closes at both ends, as v has the same value there
/// (polynomial maps: Geronimo and Van Assche, *Trans. Amer. Math. Soc.* 308, 1988, 559).
///
/// H is any form without adhesion: [`Hertz`](super::Hertz) makes smooth crests,
/// [`Wedge`](super::Wedge) a kink inside each contact, [`RoundedPunch`](super::RoundedPunch) flats.
/// [`FlatPunch`](super::FlatPunch) makes N sharp punches side by side: their pressures can be
/// compared with other codes, but no [`body`](super::body) with corners inside can be given to a
/// [`Contact`](crate::Contact). As s decreases to a, neighbours merge.
///
/// ```
/// use linecontact::reference::{ClosedForm, Hertz, PolynomialMap};
///
/// let (kappa, load) = (1.7, 0.05);
/// let form = PolynomialMap::new(Hertz::under_load(1.0, load, kappa)?, 3, 0.9, 2.0)?;
/// let contacts = form.contacts();
/// assert_eq!(contacts.len(), 3);
/// assert_eq!(contacts[1].left, -contacts[1].right); // the middle one of three, where v = 0
/// # Ok::<(), linecontact::reference::ReferenceError<f64>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct PolynomialMap<T, F> {
    form: F,
    amplitude: T,
    radius: T,
    /// Zeros of v, from left to right: v is their product, so that it keeps its digits there.
    zeros: Vec<T>,
    contacts: Vec<Interval<T>>,
    /// Places where the slope is not smooth, and v there.
    breakpoints: Vec<[T; 2]>,
}

impl<T: Real, F: ClosedForm<T>> PolynomialMap<T, F> {
    /// Creates the form from H, the number N of contacts, the amplitude s of the polynomial, in the
    /// unit of the lengths of H, and the half-width r of the span on which it swings between ±s.
    ///
    /// # Errors
    /// [`ReferenceError::Parameter`] if N is 0, s or r is not positive and finite, s is not larger
    /// than a and b, or H has adhesive edges.
    pub fn new(form: F, count: usize, amplitude: T, radius: T) -> Result<Self, ReferenceError<T>> {
        check("the number of contacts", T::count(count), count > 0, "at least 1")?;
        positive([("the amplitude", amplitude), ("the radius", radius)])?;
        let limits = form.limits();
        let apart = limits.right < amplitude && -limits.left < amplitude;
        check("the amplitude", amplitude, apart, "larger than the limits of the one contact")?;
        for edge in form.edges() {
            if let Edge::Adhesive(work) = edge {
                check("the work of adhesion", work, false, "none at all")?;
            }
        }
        let (zeros, contacts, breakpoints) = (Vec::new(), Vec::new(), Vec::new());
        let mut map = Self { form, amplitude, radius, zeros, contacts, breakpoints };
        map.zeros = (0..count).map(|branch| map.place(count, branch, T::zero())).collect();
        for branch in 0..count {
            let ends = [limits.left, limits.right].map(|v| map.place(count, branch, v));
            let [left, right] = if map.rises(branch) { ends } else { [ends[1], ends[0]] };
            map.contacts.push(Interval { left, right });
        }
        for v in map.form.breakpoints() {
            let places = map.places(v);
            map.breakpoints.extend(places.into_iter().map(|x| [x, v]));
        }
        map.breakpoints.sort_by(|a, b| ascending(&a[0], &b[0]));
        Ok(map)
    }

    /// Returns the amplitude s.
    pub fn amplitude(&self) -> T {
        self.amplitude
    }

    /// Returns the half-width r.
    pub fn radius(&self) -> T {
        self.radius
    }

    /// Returns the form H.
    pub fn form(&self) -> &F {
        &self.form
    }

    /// Tells whether v rises on a branch, counted from the left. On the last one it does.
    fn rises(&self, branch: usize) -> bool {
        (self.zeros.len() - 1 - branch).is_multiple_of(2)
    }

    /// Returns the place on a branch where v has a given value between -s and s.
    fn place(&self, count: usize, branch: usize, v: T) -> T {
        let rises = (count - 1 - branch).is_multiple_of(2);
        let v = if rises { v } else { -v };
        // With x = r sin ψ, v is s sin(N (ψ - ψ₀)) between two turning points. The angle is
        // measured from ψ₀ or from the nearer turning point, there by the distance of v from s,
        // which keeps its digits.
        let step = T::frac_pi_2() / T::count(count);
        let middle = T::count(2 * branch + 1) - T::count(count);
        let [below, above] = [self.amplitude - v.abs(), self.amplitude + v.abs()];
        let angle = if v.abs() < T::of(0.5) * self.amplitude {
            step * middle + (v / self.amplitude).asin() / T::count(count)
        } else {
            let side = T::one().copysign(v);
            let rest = T::of(2.0) * below.sqrt().atan2(above.sqrt()) / T::count(count);
            step * (middle + side) - side * rest
        };
        self.radius * angle.sin()
    }

    /// Lists all places where v has a given value, from left to right: on all branches, or the
    /// outermost.
    fn places(&self, v: T) -> Vec<T> {
        let count = self.zeros.len();
        if v.abs() < self.amplitude {
            return (0..count).map(|branch| self.place(count, branch, v)).collect();
        }
        let right = self.radius * ((v.abs() / self.amplitude).acosh() / T::count(count)).cosh();
        match (v > T::zero(), count.is_multiple_of(2)) {
            (true, true) => vec![-right, right],
            (true, false) => vec![right],
            (false, true) => Vec::new(),
            (false, false) => vec![-right],
        }
    }

    /// Returns v and v'. The sign of v is right whatever the rounding, as it follows from the
    /// zeros.
    fn polynomial(&self, x: T) -> [T; 2] {
        let double = T::of(2.0) / self.radius;
        let [mut value, mut slope] = [T::of(0.5) * self.amplitude, T::zero()];
        for &zero in &self.zeros {
            let factor = double * (x - zero);
            slope = slope * factor + value * double;
            value *= factor;
        }
        // At a breakpoint v is known.
        let breakpoint = self.breakpoints.iter().find(|breakpoint| breakpoint[0] == x);
        [breakpoint.map_or(value, |breakpoint| breakpoint[1]), slope]
    }

    /// Returns the slope on one side of x.
    fn slope_beside(&self, x: T, right: bool) -> T {
        let [v, rise] = self.polynomial(x);
        let upwards = (rise > T::zero()) == right;
        let slope = if upwards { self.form.slope(v) } else { self.form.slope_left(v) };
        slope * rise / T::count(self.zeros.len())
    }
}

impl<T: Real, F: ClosedForm<T>> ClosedForm<T> for PolynomialMap<T, F> {
    fn limits(&self) -> Interval<T> {
        let last = self.contacts.len() - 1;
        Interval { left: self.contacts[0].left, right: self.contacts[last].right }
    }

    fn contacts(&self) -> Vec<Interval<T>> {
        self.contacts.clone()
    }

    fn load(&self, kappa: T) -> T {
        self.form.load(kappa)
    }

    fn pressure(&self, x: T, kappa: T) -> T {
        let Interval { left: low, right: high } = self.form.limits();
        let [mut v, rise] = self.polynomial(x);
        let branch = self.contacts.partition_point(|on| on.right < x);
        if let Some(&on) = self.contacts.get(branch) {
            if x < on.left {
                return T::zero();
            }
            // Rounding must not move a point out of its contact, nor off a limit.
            let [left, right] = if self.rises(branch) { [low, high] } else { [high, low] };
            v = match x {
                _ if x == on.left => left,
                _ if x == on.right => right,
                _ => v.clamp(low, high),
            };
        } else if x > self.limits().right {
            return T::zero();
        }
        rise.abs() * self.form.pressure(v, kappa) / T::count(self.zeros.len())
    }

    fn height(&self, x: T) -> T {
        self.form.height(self.polynomial(x)[0]) / T::count(self.zeros.len())
    }

    fn slope(&self, x: T) -> T {
        self.slope_beside(x, true)
    }

    fn slope_left(&self, x: T) -> T {
        self.slope_beside(x, false)
    }

    fn breakpoints(&self) -> Vec<T> {
        self.breakpoints.iter().map(|breakpoint| breakpoint[0]).collect()
    }

    /// Returns the edges at the outermost limits.
    fn edges(&self) -> [Edge<T>; 2] {
        let Interval { left, right } = self.limits();
        let [low, high] = self.form.edges();
        let moved = |edge: Edge<T>, x: T| match edge {
            Edge::Free => Edge::Free,
            _ => Edge::Fixed(x),
        };
        [moved(if self.rises(0) { low } else { high }, left), moved(high, right)]
    }
}
