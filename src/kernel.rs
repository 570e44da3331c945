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
mod layer;
mod wavenumbers;

pub(crate) use bend::Bend;
pub(crate) use correction::{Correction, Kept};
pub(crate) use layer::Layers;
pub use layer::{Base, Foundation, Layer};
pub(crate) use wavenumbers::{Levels, Spread};

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

    /// Returns K(0) - 1.
    fn excess_at_zero(&self) -> T;
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

/// All that a scene has beside half-planes, ready for contacts of some length.
#[derive(Clone)]
pub(crate) struct Kernel<'b, T: Real> {
    pub levels: Option<Arc<Levels<T>>>,
    pub formula: Option<Formula<'b, T>>,
}

impl<T: Real> Kernel<'_, T> {
    /// Returns the distance of the nearest singularity of the kernel.
    pub fn distance(&self) -> T {
        let waves = self.levels.as_ref().map(|levels| levels.of.decay());
        let formula = self.formula.as_ref().map(|formula| formula.kernel().nearest_singularity());
        let both = [waves, formula].into_iter().flatten();
        both.fold(T::one() / T::zero(), |least, distance| least.min(distance))
    }

    /// Returns numbers of coefficients on an interval: of a pressure that is corrected, of r, and
    /// the most of any pressure that reach r.
    pub fn terms(&self, on: Interval<T>) -> [usize; 3] {
        let ratio = (T::of(2.0) * on.half_width() / self.distance()).component(0);
        let at_least = |least: T| (0..MAX_TERMS).find(|&n| T::count(n) >= least).unwrap_or(MAX_TERMS);
        // r has singularities above the ends of the interval: a series converges with the root.
        let some = |first: f64, more: f64| T::of(first) + T::of(more) * ratio.sqrt();
        [some(8.0, 6.0), some(10.0, 18.0), T::of(30.0) + T::of(10.0) * ratio].map(at_least)
    }
}

/// Largest number of coefficients of a pressure.
const MAX_TERMS: usize = 1100;
