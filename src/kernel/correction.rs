//! Linear correction of the pressures, with the limits held.
//!
//! A contact of the bent bodies meets Eq. (1) but for `ρ = ∫ K P ds - r`. On the same contacts, with
//! a change δP that may be infinite at all limits,
//!
//! ```text
//! PV∫ δP/(x - s) ds + ∫ K δP ds - κ δτ = -ρ        ∫ δP = 0 (or another condition), and ∫ x δP = 0 with a tilt δτ
//! ```
//!
//! and the left side integrated over each gap is `-∫ ρ`, too. To first order moved limits do not
//! change P: its derivatives by them have the factors K_a and K_b, zero in the end. So the limits
//! can stay, and the search converges quadratically. It need not be accurate: ρ is.
//!
//! `cos kθ/(π L sin θ)` has the Cauchy integral `-U_{k-1}/L` on its own contact; outside, with
//! `z = (x - c)/L` and `|u| < 1` in `z = (u + 1/u)/2`, it has `uᵏ/(L sqrt(z² - 1))`, and the potential
//! `-uᵏ/k`, or `ln(L/(2|u|))` of k = 0.

use super::bend::Bend;
use super::wavenumbers::{Harmonics, Rule, Spread, Transform};
use super::Kernel;
use crate::numerics::LinearSystem;
use crate::numerics::chebyshev::value_at;
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
    /// Largest ρ in the contacts, as a share of the largest r.
    pub residual: T,
}

/// Contact in the system: its interval, and the harmonics that the kernel needs there.
struct Place<T> {
    on: Interval<T>,
    /// Number of coefficients that are corrected.
    terms: usize,
    waves: Option<[Harmonics<T>; 2]>,
    /// Chebyshev coefficients of ρ.
    rho: Vec<T>,
}

/// Chebyshev coefficients of a function on an interval from values at n nodes.
pub(super) fn expanded<T: Real>(on: Interval<T>, n: usize, of: impl Fn(T) -> T) -> Vec<T> {
    let angle = |i: usize| T::pi() * (T::count(i) + T::of(0.5)) / T::count(n);
    let values: Vec<T> =
        (0..n).map(|i| of(on.centre() + on.half_width() * angle(i).cos())).collect();
    let share = |k: usize| if k == 0 { T::one() } else { T::of(2.0) } / T::count(n);
    let term = |k: usize, i: usize| values[i] * (T::count(k) * angle(i)).cos();
    (0..n).map(|k| share(k) * (0..n).map(|i| term(k, i)).fold(T::zero(), |a, b| a + b)).collect()
}

impl<'b, T: Real> Correction<T> {
    /// Corrects the pressures of a contact of bodies with this bend, if any; `None` if the system
    /// is singular.
    pub fn new(
        kernel: &Kernel<'b, T>,
        bend: Option<&Bend<'b, T>>,
        spreads: Vec<Spread<T>>,
        kept: Kept<T>,
    ) -> Option<Self> {
        let bent = bend.map_or(&[][..], Bend::spreads);
        let rule = kernel.levels.as_ref().map(|levels| levels.rule(0));
        let harmonics = |rule| {
            let of = |spread: &Spread<T>| {
                let [_, some, _] = kernel.terms(spread.on);
                Harmonics::new(rule, spread.on, some.max(spread.q.len()))
            };
            spreads.iter().map(of).collect::<Vec<_>>()
        };
        let harmonics = rule.map_or(Vec::new(), harmonics);
        let transforms = rule.map(|rule| {
            let old = bend.and_then(|bend| bend.whole(kernel));
            let old = old.cloned().unwrap_or_else(|| rule.transform(bent));
            [rule.sum(&harmonics, &spreads), old]
        });
        let difference = transforms.as_ref().map(|[new, old]| new.less(old));
        let (mut places, mut largest, mut off) = (Vec::new(), T::zero(), T::zero());
        let mut harmonics = harmonics.into_iter();
        for spread in &spreads {
            let (on, [terms, all, _]) = (spread.on, kernel.terms(spread.on));
            let mut sums = [vec![T::zero(); all], vec![T::zero(); all]];
            let mut waves = None;
            if let (Some(rule), Some(mut harmonics)) = (rule, harmonics.next())
                && let (Some([new, _]), Some(less)) = (&transforms, &difference)
            {
                harmonics.truncate(all);
                let weighted = harmonics.weighted(rule);
                add(&mut sums[0], &weighted.series(&less.parts));
                add(&mut sums[1], &weighted.series(&new.parts));
                waves = Some([harmonics, weighted]);
            }
            if let Some(formula) = &kernel.formula {
                let [new, old] = [&spreads[..], bent];
                let of = |from, x| formula.over(from, x)[1];
                add(&mut sums[0], &expanded(on, all, |x| of(new, x) - of(old, x)));
                add(&mut sums[1], &expanded(on, all, |x| of(new, x)));
            }
            let [rho, r] = sums;
            let size = |row: &[T]| row.iter().fold(T::zero(), |sum, a| sum + a.abs());
            (largest, off) = (largest.max(size(&r)), off.max(size(&rho)));
            places.push(Place { on, terms, waves, rho });
        }
        let residual = if largest > T::zero() { off / largest } else { off };
        let system = System { kernel, rule, places, kept };
        let rises = system.rises(difference.as_ref(), &spreads, bent);
        let change = system.solve(&rises)?;
        let mut spreads = spreads;
        let mut at = 0;
        for (spread, place) in spreads.iter_mut().zip(&system.places) {
            add(&mut spread.q, &change[at..at + place.terms]);
            at += place.terms;
        }
        Some(Self { spreads, residual })
    }
}

fn add<T: Real>(sum: &mut [T], terms: &[T]) {
    sum.iter_mut().zip(terms).for_each(|(sum, &term)| *sum += term);
}

struct System<'s, 'b, T: Real> {
    kernel: &'s Kernel<'b, T>,
    rule: Option<&'s Rule<T>>,
    places: Vec<Place<T>>,
    kept: Kept<T>,
}

impl<T: Real> System<'_, '_, T> {
    /// Lists the gaps between contacts.
    fn gaps(&self) -> impl Iterator<Item = [T; 2]> {
        self.places.windows(2).map(|pair| [pair[0].on.right, pair[1].on.left])
    }

    /// Returns `∫ ρ` over the gaps.
    fn rises(&self, less: Option<&Transform<T>>, new: &[Spread<T>], old: &[Spread<T>]) -> Vec<T> {
        let height = |x: T| {
            let waves = self.rule.zip(less).map(|(rule, less)| rule.height(less, x));
            let formula = self.kernel.formula.as_ref();
            let formula = formula.map(|formula| formula.over(new, x)[0] - formula.over(old, x)[0]);
            waves.into_iter().chain(formula).fold(T::zero(), |sum, height| sum + height)
        };
        self.gaps().map(|[from, to]| height(to) - height(from)).collect()
    }

    /// Solves for the changes of the coefficients.
    fn solve(&self, rises: &[T]) -> Option<Vec<T>> {
        let tilts = usize::from(matches!(self.kept, Kept::Moment(_)));
        let count = self.places.iter().map(|place| place.terms).sum::<usize>() + tilts;
        // By columns: each the left sides of all equations for one unknown.
        let mut columns = Vec::with_capacity(count);
        for (j, place) in self.places.iter().enumerate() {
            for k in 0..place.terms {
                columns.push(self.column(j, k));
            }
        }
        if let Kept::Moment(kappa) = self.kept {
            columns.push(self.column_of_tilt(kappa));
        }
        let rows: Vec<Vec<T>> =
            (0..count).map(|row| columns.iter().map(|column| column[row]).collect()).collect();
        let mut right = Vec::with_capacity(count);
        for place in &self.places {
            right.extend(second_kind(&place.rho[..place.terms]).map(|rho| -rho));
        }
        right.extend(rises.iter().map(|&rise| -rise));
        right.resize(count, T::zero());
        let (mut system, mut change) = (LinearSystem::new(), Vec::new());
        let is_regular = system.factor(rows.iter().map(Vec::as_slice));
        if !is_regular {
            return None;
        }
        system.solve(&right, &mut change);
        Some(change)
    }

    /// Returns the left sides for `cos kθ/(π L sin θ)` on one contact.
    fn column(&self, j: usize, k: usize) -> Vec<T> {
        let own = &self.places[j];
        let one = || {
            let mut q = vec![T::zero(); own.terms];
            q[k] = T::one();
            [Spread { on: own.on, q }]
        };
        let parts = own.waves.as_ref().map(|[harmonics, _]| harmonics.of_one(k));
        let mut column = Vec::new();
        for (i, place) in self.places.iter().enumerate() {
            let mut series = vec![T::zero(); place.terms];
            if let (Some(parts), Some([_, weighted])) = (&parts, &place.waves) {
                add(&mut series, &weighted.first(place.terms, parts));
            }
            if let Some(formula) = &self.kernel.formula {
                add(&mut series, &expanded(place.on, place.terms, |x| formula.over(&one(), x)[1]));
            }
            if i != j {
                let field = |x: T| outside(own.on, x, k)[0];
                add(&mut series, &expanded(place.on, place.terms, field));
            }
            let start = column.len();
            column.extend(second_kind(&series));
            if i == j && k > 0 {
                column[start + k - 1] -= T::one() / own.on.half_width();
            }
        }
        let height = |x: T| {
            let waves = self.rule.zip(parts.as_ref()).map(|(rule, parts)| {
                rule.height(&Transform::of(parts.clone(), k), x)
            });
            let formula = self.kernel.formula.as_ref().map(|formula| formula.over(&one(), x)[0]);
            let potential = outside(own.on, x, k)[1];
            waves.into_iter().chain(formula).fold(potential, |sum, height| sum + height)
        };
        column.extend(self.gaps().map(|[from, to]| height(to) - height(from)));
        column.extend(self.conditions(own.on, j, k));
        column
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
                let left = if j > 0 { zero } else if k % 2 == 0 { one } else { -one };
                vec![right + left]
            }
            Kept::Pressure(x) if on.contains(x) => {
                let z = (x - on.centre()) / on.half_width();
                let mut q = vec![zero; k + 1];
                q[k] = one;
                vec![if k == 0 { one } else { value_at(&q, z) }]
            }
            Kept::Pressure(_) => vec![zero],
        }
    }

    fn column_of_tilt(&self, kappa: T) -> Vec<T> {
        let mut column = Vec::new();
        for place in &self.places {
            let mut level = vec![T::zero(); place.terms];
            level[0] = -kappa;
            column.extend(second_kind(&level));
        }
        column.extend(self.gaps().map(|[from, to]| -kappa * (to - from)));
        column.resize(column.len() + 2, T::zero());
        column
    }
}

/// Returns the coefficients of `U_0` to `U_{n-2}` of a Chebyshev series of n terms.
fn second_kind<T: Real>(series: &[T]) -> impl Iterator<Item = T> {
    let half = T::of(0.5);
    (1..series.len()).map(move |m| {
        let before = if m == 1 { series[0] } else { half * series[m - 1] };
        before - series.get(m + 1).map_or(T::zero(), |&after| half * after)
    })
}

/// Returns the Cauchy integral and the potential of `cos kθ/(π L sin θ)` at x, outside the interval
/// or at its ends.
fn outside<T: Real>(on: Interval<T>, x: T, k: usize) -> [T; 2] {
    let (half_width, one) = (on.half_width(), T::one());
    let z = (x - on.centre()) / half_width;
    let root = ((z.abs() - one).max(T::zero()) * (z.abs() + one)).sqrt();
    let sign = if z < T::zero() { -one } else { one };
    let u = sign / (z.abs() + root);
    let power = (0..k).fold(one, |power, _| power * u);
    let potential = match k {
        0 => (half_width / (u.abs() + u.abs())).ln(),
        _ => -power / T::count(k),
    };
    [sign * power / (half_width * root), potential]
}
