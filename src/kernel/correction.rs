//! Linear correction of the pressures, with the limits held.
//!
//! A contact of the bent bodies meets Eq. (1) but for `ρ = ∫ K P ds - r`. On the same contacts,
//! with a change δP that may be infinite at all limits,
//!
//! ```text
//! PV∫ δP/(x - s) ds + ∫ K δP ds - κ δτ = -ρ
//! ```
//!
//! and the left side integrated over each gap is `-∫ ρ`, too; the load stays, or what else is
//! given, and with a tilt δτ the moment. To first order moved limits do not change P: its
//! derivatives by them have the factors K_a and K_b, zero in the end. So the limits can stay, and
//! the search converges quadratically. The correction need not be accurate: ρ is.
//!
//! The unknowns are the values of `Σ q_k cos kθ` at the nodes of a Gauss-Chebyshev rule, and
//! Eq. (1) holds between them, where that rule is right for the principal value, too (Erdogan
//! and Gupta, *Q. Appl. Math.* 29, 1972, 525). Outside a contact, with `z = (x - c)/L` and
//! `|u| < 1` in `z = (u + 1/u)/2`, a pressure `cos kθ/(π L sin θ)` has the Cauchy integral
//! `uᵏ/(L sqrt(z² - 1))`, and the potential `-uᵏ/k`, or `ln(L/(2|u|))` for k = 0.

use super::Kernel;
use super::bend::Bend;
use super::spread::{Nodes, Spread, loads};
use crate::numerics::LinearSystem;
use crate::{Interval, Real};

/// Condition on the change of the pressures.
#[derive(Clone, Copy)]
pub(crate) enum Kept<T> {
    /// The load is given.
    Load,
    /// The load and its moment are given; the scale κ of the tilt.
    Moment(T),
    /// The width from the first limit to the last is given: the outer strengths stay, on average.
    Width,
    /// The pressure at a place is given.
    Pressure(T),
}

/// Pressures that meet Eq. (1) on given contacts, and how far the given ones do.
pub(crate) struct Correction<T> {
    /// Corrected pressures.
    pub spreads: Vec<Spread<T>>,
    /// Largest ρ in the contacts, as a share of the largest part of Eq. (1), in each component of
    /// their numbers.
    pub residuals: Vec<T>,
}

impl<T: Real> Correction<T> {
    /// Corrects the pressures of a contact of bodies with this bend, if any; `None` if the system
    /// is singular. Fails with the place where the kernel is not finite.
    pub fn new(
        kernel: &Kernel<'_, T>,
        bend: Option<&Bend<'_, T>>,
        mut spreads: Vec<Spread<T>>,
        kept: Kept<T>,
    ) -> Result<Option<Self>, T> {
        let loads = loads(kernel.distance(), &spreads);
        let sum = |of: usize, x: T| kernel.sums([of], x, &loads)[0];
        let (zero, mut places) = (T::zero(), Vec::new());
        let mut sizes = vec![[zero; 2]; T::COMPONENTS];
        for spread in &spreads {
            let on = spread.on;
            let mut place = Place::new(on, kernel.terms(on)[0]);
            let new: Vec<T> = place.between.iter().map(|&x| sum(0, x)).collect();
            let old = |x: T| bend.map_or(T::zero(), |bend| bend.slope(x));
            place.rho = new.iter().zip(&place.between).map(|(&new, &x)| new - old(x)).collect();
            // A comparison loses NaN, which a formula may have in its integral alone.
            let is_known = |(&x, &rho): (&T, &T)| {
                rho.is_finite() && (kernel.formula.is_none() || sum(1, x).is_finite())
            };
            let mut each = place.between.iter().zip(&place.rho);
            if let Some((&x, _)) = each.find(|&at| !is_known(at)) {
                return Err(x);
            }
            for (part, [off, largest]) in sizes.iter_mut().enumerate() {
                let size = |a: &T| a.component(part).abs();
                let most = |row: &[T]| row.iter().map(size).fold(zero, T::max);
                // The half-planes' part is about as large as the sum of the coefficients.
                let half_planes = spread.q.iter().map(size).fold(zero, |sum, q| sum + q);
                *largest = largest.max(most(&new)).max(half_planes / on.half_width());
                *off = off.max(most(&place.rho));
            }
            places.push(place);
        }
        let share = |[off, largest]: [T; 2]| if largest > zero { off / largest } else { off };
        let residuals = sizes.into_iter().map(share).collect();
        let system = System { kernel, places, kept };
        let height = |x: T| sum(1, x) - bend.map_or(zero, |bend| bend.height(x));
        let rises = system.gaps().map(|[from, to]| height(to) - height(from));
        let Some(change) = system.solve(rises.collect(), &[T::zero()]) else { return Ok(None) };
        for (spread, change) in spreads.iter_mut().zip(change) {
            spread.q.resize(spread.q.len().max(change.q.len()), T::zero());
            spread.q.iter_mut().zip(change.q).for_each(|(q, by)| *q += by);
        }
        Ok(Some(Self { spreads, residuals }))
    }
}

/// Returns the pressures of a flat punch on contacts under a unit load: the rate of the pressure by
/// the load, to rounding or to about a thousandth. `None` if the system is singular.
pub(crate) fn punch<T: Real>(
    kernel: &Kernel<'_, T>,
    contacts: &[Interval<T>],
    is_rough: bool,
) -> Option<Vec<Spread<T>>> {
    let place = |&on: &Interval<T>| {
        let [few, terms, _] = kernel.terms(on);
        let terms = if is_rough { few / 2 } else { terms };
        Place::new(on, terms)
    };
    let places: Vec<Place<T>> = contacts.iter().map(place).collect();
    let system = System { kernel, places, kept: Kept::Load };
    let gaps = vec![T::zero(); contacts.len() - 1];
    system.solve(gaps, &[T::one()])
}

/// Gap of two bodies, times κ.
pub(crate) struct Given<S, H> {
    pub slope: S,
    pub height: H,
}

/// Returns the pressures under which bodies meet Eq. (1) on given contacts, with singular edges,
/// roughly; the load, or the load and its moment, are given. `None` if the system is singular.
pub(crate) fn pressed<T: Real, E>(
    kernel: &Kernel<'_, T>,
    contacts: &[Interval<T>],
    kept: Kept<T>,
    load: &[T],
    mut gap: Given<impl FnMut(T) -> Result<T, E>, impl FnMut(T) -> Result<T, E>>,
) -> Result<Option<Vec<Spread<T>>>, E> {
    let mut place = |&on: &Interval<T>| {
        let mut place = Place::new(on, kernel.terms(on)[0]);
        for (rho, &x) in place.rho.iter_mut().zip(&place.between) {
            *rho = -(gap.slope)(x)?;
        }
        Ok(place)
    };
    let places: Result<_, E> = contacts.iter().map(&mut place).collect();
    let system = System { kernel, places: places?, kept };
    let mut rise = |[from, to]: [T; 2]| Ok((gap.height)(from)? - (gap.height)(to)?);
    let rises: Result<_, E> = system.gaps().map(&mut rise).collect();
    Ok(system.solve(rises?, load))
}

/// Contact in the system.
struct Place<T> {
    on: Interval<T>,
    /// As many nodes as coefficients are corrected.
    nodes: Nodes<T>,
    /// Places between the nodes, and ρ there.
    between: Vec<T>,
    rho: Vec<T>,
}

impl<T: Real> Place<T> {
    fn new(on: Interval<T>, terms: usize) -> Self {
        let cos = |i: usize| (T::pi() * (T::count(i) / T::count(terms))).cos();
        let between = (1..terms).map(|i| on.centre() + on.half_width() * cos(i)).collect();
        Self { on, nodes: Nodes::new(on, terms), between, rho: vec![T::zero(); terms - 1] }
    }
}

struct System<'s, 'b, T: Real> {
    kernel: &'s Kernel<'b, T>,
    places: Vec<Place<T>>,
    kept: Kept<T>,
}

impl<T: Real> System<'_, '_, T> {
    /// Lists the gaps between contacts.
    fn gaps(&self) -> impl Iterator<Item = [T; 2]> {
        self.places.windows(2).map(|pair| [pair[0].on.right, pair[1].on.left])
    }

    /// Solves for the changes of the pressures, given `∫ ρ` over the gaps and the last conditions.
    fn solve(&self, rises: Vec<T>, last: &[T]) -> Option<Vec<Spread<T>>> {
        let rows = self.rows();
        let rho = self.places.iter().flat_map(|place| place.rho.iter().copied());
        let mut right: Vec<T> = rho.chain(rises).map(|a| -a).collect();
        right.resize(rows.len() - last.len(), T::zero());
        right.extend(last);
        let (mut system, mut change) = (LinearSystem::new(), Vec::new());
        if !system.factor(rows.iter().map(Vec::as_slice)) {
            return None;
        }
        system.solve(&right, &mut change);
        let mut change = change.into_iter();
        let spread = |Place { on, nodes, .. }: &Place<T>| Spread {
            on: *on,
            q: nodes.coefficients(change.by_ref().take(nodes.len())),
        };
        Some(self.places.iter().map(spread).collect())
    }

    /// Returns the left sides of all equations.
    fn rows(&self) -> Vec<Vec<T>> {
        let (zero, one, kernel) = (T::zero(), T::one(), self.kernel);
        let mut rows = Vec::new();
        for (i, place) in self.places.iter().enumerate() {
            rows.extend(place.between.iter().map(|&x| {
                let own = |j: usize, s: T| if i == j { (x - s).recip() } else { zero };
                let cauchy = |on| outside(on, x).map(|[cauchy, _]| cauchy);
                let beside = |j: usize, on| (i != j).then(|| cauchy(on));
                self.row(|j, s| kernel.slope(x, s) + own(j, s), beside, one)
            }));
        }
        rows.extend(self.gaps().map(|[from, to]| {
            let rise = |_, s: T| kernel.height(to, s) - kernel.height(from, s);
            let potential =
                |on| outside(on, to).zip(outside(on, from)).map(|(to, from)| to[1] - from[1]);
            self.row(rise, |_, on| Some(potential(on)), to - from)
        }));
        let none = |_: usize, _: Interval<T>| None::<std::iter::Empty<T>>;
        match self.kept {
            Kept::Load => rows.push(self.row(|_, _| one, none, zero)),
            Kept::Moment(_) => {
                rows.push(self.row(|_, _| one, none, zero));
                rows.push(self.row(|_, s| s, none, zero));
            }
            Kept::Width => {
                let last = self.places.len() - 1;
                let left = move |k: usize| if k.is_multiple_of(2) { one } else { -one };
                let strengths = |j: usize, _| {
                    let of = move |on: bool, value: T| if on { value } else { zero };
                    Some((0..).map(move |k| of(j == 0, left(k)) + of(j == last, one)))
                };
                rows.push(self.row(|_, _| zero, strengths, zero));
            }
            Kept::Pressure(x) => {
                let at = |on: Interval<T>| (0..).map(move |k| (T::count(k) * on.angle(x)).cos());
                let pressure = |_, on: Interval<T>| on.contains(x).then(|| at(on));
                rows.push(self.row(|_, _| zero, pressure, zero));
            }
        }
        rows
    }

    /// Returns a row: the integral of a function of the contact and of s times the pressures, and
    /// of what is known for each coefficient on a contact; and the effect of a tilt, as a multiple
    /// of -κ.
    fn row<I: Iterator<Item = T>>(
        &self,
        weight: impl Fn(usize, T) -> T,
        terms: impl Fn(usize, Interval<T>) -> Option<I>,
        tilt: T,
    ) -> Vec<T> {
        let mut row = Vec::new();
        for (j, Place { on, nodes, .. }) in self.places.iter().enumerate() {
            let start = row.len();
            row.extend(nodes.x.iter().map(|&s| weight(j, s) / T::count(nodes.len())));
            if let Some(terms) = terms(j, *on) {
                nodes.add_terms(terms, &mut row[start..]);
            }
        }
        if let Kept::Moment(kappa) = self.kept {
            row.push(-kappa * tilt);
        }
        row
    }
}

/// Returns the Cauchy integrals and the potentials of `cos kθ/(π L sin θ)` at x, outside the
/// interval or at its ends, for each k.
fn outside<T: Real>(on: Interval<T>, x: T) -> impl Iterator<Item = [T; 2]> {
    let (half_width, one) = (on.half_width(), T::one());
    // |z| - 1: zero at a limit, or the root of its rounding would count.
    let beside = (x - on.right).max(on.left - x).max(T::zero()) / half_width;
    let root = (beside * (beside + T::of(2.0))).sqrt();
    let sign = if x < on.centre() { -one } else { one };
    let u = sign / (one + beside + root);
    let scale = sign / (half_width * root);
    let powers = std::iter::successors(Some(one), move |&power| Some(power * u));
    powers.enumerate().map(move |(k, power)| {
        let potential = match k {
            0 => (half_width / (u.abs() + u.abs())).ln(),
            _ => -power / T::count(k),
        };
        [scale * power, potential]
    })
}
