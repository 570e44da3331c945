//! The regular kernel of the paper's Eq. (1): bodies that are not half-planes.
//!
//! ```text
//! PV∫ P(s)/(x - s) ds + ∫ K(x, s) P(s) ds = κ (f₂' - f₁')      on every contact          (1)
//! ```
//!
//! K is smooth, so its integral `r(x) = ∫ K P ds` is smooth, too: it bends a body. A contact with a
//! kernel is the contact of half-planes whose gap has the slope `g - r/κ`, with the pressure P
//! that makes r. The search for it is in `solve/bending.rs`.
//!
//! A kernel of `x - s` is given by wavenumber. With `û = 2 K(ω) p̂/(E* ω)` for the displacement of
//! the surface under a wave of pressure,
//!
//! ```text
//! r(x) = ∫ (K - 1) Im[exp(iωx) P̂(ω)] dω     P̂(ω) = ∫ P exp(-iωs) ds     over ω > 0
//! ```

mod bend;
mod correction;
mod layers;
mod periodic;
mod spread;
mod table;

pub(crate) use bend::Bend;
pub(crate) use correction::{Correction, Given, Kept, pressed, punch};
pub(crate) use layers::Layers;
pub(crate) use periodic::Periodic;
pub(crate) use spread::{Spread, loads, series};
pub(crate) use table::{Table, wavenumbers};

use crate::{Interval, Real};
use std::sync::Arc;

/// Regular kernel K(x, s) of the paper's Eq. (1), a reciprocal length.
///
/// It must be smooth for x on all of the bodies and s in the contacts, and as smooth beyond: the
/// strengths at the edges are those of half-planes.
pub trait RegularKernel<T: Real>: Send + Sync {
    /// Returns K(x, s).
    fn slope(&self, x: T, s: T) -> T;

    /// Returns a function of x and s whose derivative by x is K, `∫ K dx`; it may contain any
    /// function of s.
    fn height(&self, x: T, s: T) -> T;

    /// Returns the distance from the bodies to the nearest singularity of K(x, s) as a function of
    /// a complex x: a length.
    fn nearest_singularity(&self) -> T;
}

/// Compliance of the surfaces of both bodies by wavenumber ω, as a multiple K(ω) of that of
/// half-planes with the contact modulus E*.
///
/// The edges of a contact see only half-planes if K - 1 falls exponentially; other bodies, such as
/// springs below the surface, are not contacts of this kind.
pub trait SurfaceCompliance<T: Real>: Send + Sync {
    /// Returns K(ω) - 1 for ω > 0, without cancellation; K must be positive.
    fn excess(&self, wavenumber: T) -> T;

    /// Returns the length c for which K - 1 falls like `exp(-c ω)`: twice the thickness of a layer.
    fn decay(&self) -> T;

    /// Returns the longest length on which K changes: for a layer on a soft base, its thickness
    /// times the ratio of both moduli.
    fn longest(&self) -> T;
}

/// Kernel by a formula, lent by the user or owned.
#[derive(Clone)]
pub(crate) enum Formula<'b, T: Real> {
    Lent(&'b dyn RegularKernel<T>),
    Owned(Arc<dyn RegularKernel<T>>),
}

impl<T: Real> Formula<'_, T> {
    pub fn kernel(&self) -> &dyn RegularKernel<T> {
        match self {
            Self::Lent(kernel) => *kernel,
            Self::Owned(kernel) => &**kernel,
        }
    }
}

/// All that a scene has beside half-planes.
#[derive(Clone)]
pub(crate) struct Kernel<'b, T: Real> {
    pub table: Option<Arc<Table<T>>>,
    pub formula: Option<Formula<'b, T>>,
    /// The other contacts of a row, one in each period.
    pub row: Option<Periodic<T>>,
    /// Flag: nothing of it is set by the user but layers and a period.
    pub is_of_bodies: bool,
}

impl<T: Real> Kernel<'_, T> {
    fn parts(&self) -> impl Iterator<Item = &dyn RegularKernel<T>> {
        let table = self.table.as_deref().map(|table| table as &dyn RegularKernel<T>);
        table.into_iter().chain(self.formulas())
    }

    fn formulas(&self) -> impl Iterator<Item = &dyn RegularKernel<T>> {
        let row = self.row.as_ref().map(|row| row as &dyn RegularKernel<T>);
        row.into_iter().chain(self.formula.as_ref().map(Formula::kernel))
    }

    /// Returns K(x, s).
    pub fn slope(&self, x: T, s: T) -> T {
        self.parts().fold(T::zero(), |sum, part| sum + part.slope(x, s))
    }

    /// Returns the integral of K by x.
    pub fn height(&self, x: T, s: T) -> T {
        self.parts().fold(T::zero(), |sum, part| sum + part.height(x, s))
    }

    /// Takes the distance of the next period for contacts in an interval of the range at hand.
    pub fn in_range(&mut self, range: [T; 2], on: Interval<T>) {
        let Some(row) = &mut self.row else { return };
        let distance = (on.left - range[0]).min(range[1] - on.right);
        (row.range, row.distance) = (range, distance.max(T::of(LEAST_DISTANCE) * row.period));
    }

    /// Returns the compliance of the surfaces by wavenumber.
    pub fn compliance(&self, wavenumber: T) -> T {
        let table = self.table.as_ref();
        T::one() + table.map_or(T::zero(), |table| table.excess(wavenumber))
    }

    /// Returns the distance of the nearest singularity of a layer, or of a formula.
    pub fn layer_distance(&self) -> Option<T> {
        let table = self.table.as_deref().map(RegularKernel::nearest_singularity);
        let formula = self.formula.as_ref().map(|formula| formula.kernel().nearest_singularity());
        table.into_iter().chain(formula).reduce(T::min)
    }

    /// Returns the distance of the nearest singularity of the kernel.
    pub fn distance(&self) -> T {
        let distances = self.parts().map(RegularKernel::nearest_singularity);
        distances.fold(T::one() / T::zero(), |least, distance| least.min(distance))
    }

    /// Returns the numbers of [terms] on an interval.
    pub fn terms(&self, on: Interval<T>) -> [usize; 3] {
        let softness = self.compliance(T::frac_pi_2() / on.half_width());
        terms(self.distance(), softness, on)
    }

    /// Returns sums of K(x, s) (0) or of its integral by x (1) over loads at places s.
    pub fn sums<const N: usize>(&self, which: [usize; N], x: T, loads: &[[T; 2]]) -> [T; N] {
        let table = self.table.as_ref();
        let mut sums = table.map_or([T::zero(); N], |table| table.sums(which, x, loads));
        for kernel in self.formulas() {
            for &[s, load] in loads {
                for (sum, which) in sums.iter_mut().zip(which) {
                    let value = if which == 0 { kernel.slope(x, s) } else { kernel.height(x, s) };
                    *sum += load * value;
                }
            }
        }
        sums
    }
}

/// Returns numbers of terms on an interval with the nearest singularity of the kernel at a distance
/// c and a compliance at its wavenumber: of a pressure that is corrected, of r, and the most of any
/// pressure that reach r.
///
/// The first number leaves a correction of 1e-4 to 1e-6 (found by trial). On a thin
/// layer that is a share of what the kernel takes away, and more are needed for the same share of
/// the compliance that is left: the error falls like `exp(-4 c n/2L)`. Coefficients beyond the most
/// meet only wavenumbers at which K - 1 is below rounding, or terms of K that are.
pub(crate) fn terms<T: Real>(distance: T, compliance: T, on: Interval<T>) -> [usize; 3] {
    let ratio = ratio(distance, on);
    let sum = |first: f64, by_root: f64, by_ratio: f64| {
        at_least(T::of(first) + T::of(by_root) * ratio.sqrt() + T::of(by_ratio) * ratio)
    };
    let softness: f64 = compliance.component(0).to_subset_unchecked();
    let corrected = sum(8.0, 4.0, 2.2 + 0.25 * -softness.min(1.0).ln());
    let most = sum(30.0, 0.0, 10.0).min(at_least(degree(ratio)));
    [corrected, terms_of_bend(distance, on).max(corrected), most]
}

/// Returns the number of terms of r on an interval, with the nearest singularity of the kernel at a
/// distance c.
///
/// r has singularities c above the ends of the interval, on an ellipse around it with the sum ρ of
/// the half-axes, in half-widths: its series converges like `ρ⁻ⁿ`. As they are no simple poles, it
/// takes six more for rounding (by trial, up to 2L/c = 90).
fn terms_of_bend<T: Real>(distance: T, on: Interval<T>) -> usize {
    let (two, high) = (T::of(2.0), T::of(2.0) / ratio(distance, on).max(T::epsilon()));
    // The root of z² - 1 for z = 1 + iw is that of w² (2i/w - 1).
    let size = (high * high + two + two).sqrt();
    let along = (two * high / (size + high)).sqrt();
    let above = (T::of(0.5) * high * (size + high)).sqrt();
    let ellipse = (T::one() + along).hypot(high + above);
    at_least(T::of(6.0) - T::epsilon().ln() / ellipse.ln())
}

/// Returns the degree of the polynomial in s that K(x, s) is, to rounding, for x in the contact.
fn degree<T: Real>(ratio: T) -> T {
    T::of(8.0) + T::of(18.0) * ratio
}

/// Returns the number of nodes for integrals of a pressure times the kernel, and the number of its
/// terms that count: the rule is exact up to twice its nodes.
fn nodes<T: Real>(distance: T, spread: &Spread<T>) -> [usize; 2] {
    let degree = degree(ratio(distance, spread.on));
    let terms = at_least(degree).min(spread.q.len());
    [at_least(T::of(0.5) * (degree + T::count(terms))), terms]
}

fn ratio<T: Real>(distance: T, on: Interval<T>) -> T {
    (T::of(2.0) * on.half_width() / distance).component(0)
}

/// Returns the least number of terms that is not below a value.
pub(crate) fn at_least<T: Real>(value: T) -> usize {
    (0..MAX_TERMS).find(|&n| T::count(n) >= value).unwrap_or(MAX_TERMS)
}

/// Least distance of the next period that is taken, by the period: no less is left by a cut in the
/// widest gap that is solved. On the way there it may be as narrow as a slit of the bodies.
const LEAST_DISTANCE: f64 = 4e-3;

/// Largest number of coefficients of a pressure.
const MAX_TERMS: usize = 2100;
