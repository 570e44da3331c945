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
//! `cos kθ/(π L sin θ)` has the Cauchy integral `-U_{k-1}/L` on its own contact; outside, with `z =
//! (x - c)/L` and `|u| < 1` in `z = (u + 1/u)/2`, it has `uᵏ/(L sqrt(z² - 1))`, and the potential
//! `-uᵏ/k`, or `ln(L/(2|u|))` for k = 0.

use super::bend::Bend;
use super::spread::{Loads, Nodes, Spread};
use super::{Kernel, terms};
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
    /// Largest ρ in the contacts, as a share of the largest part of Eq. (1).
    pub residual: T,
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
        let loads = Loads::of(kernel.distance(), &spreads);
        let (mut places, mut largest, mut off) = (Vec::new(), T::zero(), T::zero());
        for spread in &spreads {
            let on = spread.on;
            let [terms, ..] = terms(kernel.distance(), on);
            let nodes = Nodes::new(on, terms);
            let new: Vec<T> = nodes.x.iter().map(|&x| loads.slope(kernel, x)).collect();
            let old = |x: T| bend.map_or(T::zero(), |bend| bend.slope(x));
            let rho: Vec<T> = new.iter().zip(&nodes.x).map(|(&new, &x)| new - old(x)).collect();
            // A comparison loses NaN.
            let is_known = |(&x, &rho): (&T, &T)| (rho + loads.height(kernel, x)).is_finite();
            if let Some((&x, _)) = nodes.x.iter().zip(&rho).find(|&at| !is_known(at)) {
                return Err(x);
            }
            let size = |row: &[T]| row.iter().fold(T::zero(), |most, a| most.max(a.abs()));
            // The half-planes' part is about as large as the sum of the coefficients.
            let half_planes = spread.q.iter().fold(T::zero(), |sum, q| sum + q.abs());
            largest = largest.max(size(&new)).max(half_planes / on.half_width());
            off = off.max(size(&rho));
            places.push(Place { on, nodes, rho });
        }
        let residual = if largest > T::zero() { off / largest } else { off };
        let system = System { kernel, places, kept };
        let rises = system.gaps().map(|ends| {
            let [from, to] = ends
                .map(|x| loads.height(kernel, x) - bend.map_or(T::zero(), |bend| bend.height(x)));
            to - from
        });
        let Some(change) = system.solve(rises.collect(), T::zero()) else { return Ok(None) };
        let mut at = 0;
        for (spread, place) in spreads.iter_mut().zip(&system.places) {
            let terms = place.nodes.len();
            spread.q.resize(spread.q.len().max(terms), T::zero());
            spread.q.iter_mut().zip(&change[at..at + terms]).for_each(|(q, &by)| *q += by);
            at += terms;
        }
        Ok(Some(Self { spreads, residual }))
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
        let [few, terms, _] = terms(kernel.distance(), on);
        let terms = if is_rough { few / 2 } else { terms };
        Place { on, nodes: Nodes::new(on, terms), rho: vec![T::zero(); terms] }
    };
    let places: Vec<Place<T>> = contacts.iter().map(place).collect();
    let system = System { kernel, places, kept: Kept::Load };
    let gaps = vec![T::zero(); contacts.len() - 1];
    let mut q = system.solve(gaps, T::one())?.into_iter();
    let spread =
        |place: &Place<T>| Spread { on: place.on, q: q.by_ref().take(place.nodes.len()).collect() };
    Some(system.places.iter().map(spread).collect())
}

/// Contact in the system.
struct Place<T> {
    on: Interval<T>,
    /// As many nodes as coefficients are corrected.
    nodes: Nodes<T>,
    /// ρ at the nodes.
    rho: Vec<T>,
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

    /// Solves for the changes of the coefficients, given `∫ ρ` over the gaps and the last
    /// condition.
    fn solve(&self, rises: Vec<T>, last: T) -> Option<Vec<T>> {
        // By columns: each the left sides of all equations for one unknown.
        let mut columns: Vec<Vec<T>> =
            (0..self.places.len()).flat_map(|j| self.columns(j)).collect();
        if let Kept::Moment(kappa) = self.kept {
            columns.push(self.column_of_tilt(kappa));
        }
        let count = columns.len();
        let rows: Vec<Vec<T>> =
            (0..count).map(|row| columns.iter().map(|column| column[row]).collect()).collect();
        let of = |place: &Place<T>| place.nodes.second_kind(&place.rho);
        let mut right: Vec<T> = self.places.iter().flat_map(of).chain(rises).map(|a| -a).collect();
        right.resize(count - 1, T::zero());
        right.push(last);
        let (mut system, mut change) = (LinearSystem::new(), Vec::new());
        if !system.factor(rows.iter().map(Vec::as_slice)) {
            return None;
        }
        system.solve(&right, &mut change);
        Some(change)
    }

    /// Returns the left sides for the pressures `cos kθ/(π L sin θ)` on one contact.
    fn columns(&self, j: usize) -> Vec<Vec<T>> {
        let Place { on, ref nodes, .. } = self.places[j];
        let mut columns = vec![Vec::new(); nodes.len()];
        for (i, place) in self.places.iter().enumerate() {
            // By targets: the field of each pressure there.
            let field = |x: T| {
                let kernel = nodes.means(nodes.x.iter().map(|&s| self.kernel.slope(x, s)));
                let beside = (i != j).then(|| outside(on, x, nodes.len()));
                let beside = beside.into_iter().flatten().map(|[cauchy, _]| cauchy);
                sums(kernel, beside)
            };
            let fields: Vec<Vec<T>> = place.nodes.x.iter().map(|&x| field(x)).collect();
            for (k, column) in columns.iter_mut().enumerate() {
                let start = column.len();
                let values: Vec<T> = fields.iter().map(|field| field[k]).collect();
                column.extend(place.nodes.second_kind(&values));
                if i == j && k > 0 {
                    column[start + k - 1] -= on.half_width().recip();
                }
            }
        }
        let rises = self.gaps().map(|[from, to]| {
            let rise = |&s: &T| self.kernel.height(to, s) - self.kernel.height(from, s);
            let kernel = nodes.means(nodes.x.iter().map(rise));
            let [from, to] = [from, to].map(|x| outside(on, x, nodes.len()));
            sums(kernel, to.iter().zip(&from).map(|(to, from)| to[1] - from[1]))
        });
        let rises: Vec<Vec<T>> = rises.collect();
        for (k, column) in columns.iter_mut().enumerate() {
            column.extend(rises.iter().map(|rise| rise[k]));
            column.extend(self.conditions(on, j, k));
        }
        columns
    }

    /// Returns the left sides of the conditions on the whole.
    fn conditions(&self, on: Interval<T>, j: usize, k: usize) -> Vec<T> {
        let (zero, one) = (T::zero(), T::one());
        let load = if k == 0 { one } else { zero };
        match self.kept {
            Kept::Load => vec![load],
            Kept::Moment(_) => {
                let arm = match k {
                    0 => on.centre(),
                    1 => T::of(0.5) * on.half_width(),
                    _ => zero,
                };
                vec![load, arm]
            }
            Kept::Width => {
                let right = if j + 1 == self.places.len() { one } else { zero };
                let left = if k.is_multiple_of(2) { one } else { -one };
                vec![right + if j == 0 { left } else { zero }]
            }
            Kept::Pressure(x) if on.contains(x) => vec![(T::count(k) * on.angle(x)).cos()],
            Kept::Pressure(_) => vec![zero],
        }
    }

    fn column_of_tilt(&self, kappa: T) -> Vec<T> {
        let mut column = Vec::new();
        for place in &self.places {
            column.extend(place.nodes.second_kind(&vec![-kappa; place.nodes.len()]));
        }
        column.extend(self.gaps().map(|[from, to]| -kappa * (to - from)));
        column.resize(column.len() + 2, T::zero());
        column
    }
}

/// Adds the second of two rows to the first; it may be empty.
fn sums<T: Real>(mut row: Vec<T>, other: impl Iterator<Item = T>) -> Vec<T> {
    row.iter_mut().zip(other).for_each(|(sum, value)| *sum += value);
    row
}

/// Returns the Cauchy integrals and the potentials of `cos kθ/(π L sin θ)` at x, outside the
/// interval or at its ends, for each k.
fn outside<T: Real>(on: Interval<T>, x: T, count: usize) -> Vec<[T; 2]> {
    let (half_width, one) = (on.half_width(), T::one());
    // |z| - 1: zero at a limit, or the root of its rounding would count.
    let beside = (x - on.right).max(on.left - x).max(T::zero()) / half_width;
    let root = (beside * (beside + T::of(2.0))).sqrt();
    let sign = if x < on.centre() { -one } else { one };
    let u = sign / (one + beside + root);
    let scale = sign / (half_width * root);
    let mut power = one;
    let term = |k: usize| {
        let potential = match k {
            0 => (half_width / (u.abs() + u.abs())).ln(),
            _ => -power / T::count(k),
        };
        let term = [scale * power, potential];
        power *= u;
        term
    };
    (0..count).map(term).collect()
}
