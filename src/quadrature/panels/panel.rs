//! One polynomial piece of the slope, and the verdict on its coefficients.

use super::PanelIntegrator;
use super::panel_set::PanelSet;
use crate::gap::Gap;
use crate::numerics::chebyshev::{
    Coeffs, MAX_SIZE, SIZES, Table, by_size, expand, primitive, size_for, value_at, values,
};
use crate::real::same;
use crate::{Interval, Real};

/// Largest number of coefficients of a slope whose pressure has no valley between 32 places.
const SMOOTH: usize = 16;

/// Least number of panels for which one series over a contact is tried: fewer cost less than that.
pub(super) const MANY: usize = 8;

/// Slope of the gap over an interval without breakpoints, as a Chebyshev series.
#[derive(Clone, Copy)]
pub(crate) struct Panel<T> {
    /// Left and right end.
    pub x: [T; 2],
    /// Number of nodes sampled.
    pub n: usize,
    /// Coefficients, `n` in number, of which the first `length` exceed rounding.
    pub series: Coeffs<T>,
    pub length: usize,
    /// Estimated largest error of the series.
    pub error: T,
    /// Part of the slopes that is rounding, or noise of the formulas.
    pub noise: T,
    /// Largest fall of the slope from a node to the next.
    pub fall: T,
    /// Distance between places in a contact at which the series was checked; infinite if only its
    /// nodes were sampled.
    pub apart: T,
    /// Left- and rightmost node with their heights, unless the bodies know their slopes.
    pub outermost: Option<[NodeHeight<T>; 2]>,
}

/// Height of the gap near a node, with the slopes of both bodies there. A body that knows its slope
/// has no height here.
#[derive(Clone, Copy)]
pub(crate) struct NodeHeight<T> {
    pub x: T,
    pub height: T,
    /// Uncertainty of the height, apart from noise.
    pub doubt: T,
    pub slopes: [T; 2],
}

impl<T: Real> Panel<T> {
    /// Returns a panel without samples.
    pub fn new(x: [T; 2]) -> Self {
        let (zero, apart) = (T::zero(), T::one() / T::zero());
        Self {
            x,
            n: 0,
            series: [zero; MAX_SIZE],
            length: 0,
            error: zero,
            noise: zero,
            fall: zero,
            apart,
            outermost: None,
        }
    }

    /// Counts the coefficients of a panel with n nodes.
    pub fn count(&mut self, n: usize) {
        self.n = n;
        self.length = significant_length(&self.series[..n], 0..T::COMPONENTS, rounding);
    }

    /// Drops the coefficients that are mere noise of this level: they say nothing about the slope,
    /// and add up at the ends of the panel.
    pub fn drop_noise(&mut self, level: T) {
        let by_value = significant_length(self.coefficients(), 0..1, |_| T::of(4.0) * level);
        // Derivatives have their own noise.
        self.length =
            significant_length(self.coefficients(), 1..T::COMPONENTS, rounding).max(by_value);
    }

    /// Replaces the series, which overshoots where the slope jumps, by a straight line between the
    /// values at the first and the last node. The rise then stays between the neighbours, and no
    /// seam is left.
    pub fn straighten(&mut self) {
        let (half, z) = (T::of(0.5), &Table::of(self.n).z[..self.n]);
        let [first, last] = [z[0], z[self.n - 1]].map(|z| value_at(self.coefficients(), T::of(z)));
        (self.series[0], self.series[1]) = (half * (first + last), half * (last - first));
        self.length = 2;
    }

    /// Appends the panel, turned and bent as the gap is, in parts where a bend takes more terms
    /// than one panel has.
    pub fn push_with_added(&self, gap: &Gap<'_, T>, to: &mut Vec<Self>) {
        let Some(bend) = gap.bend() else {
            let mut turned = *self;
            turned.series[0] += gap.tilt();
            return to.push(turned);
        };
        let [left, right] = self.x;
        let terms = bend.terms(Interval { left, right });
        let n = size_for(terms).max(self.n);
        let (mut sum, mut values) = (Self { n, ..*self }, [T::zero(); MAX_SIZE]);
        values.iter_mut().zip(sum.nodes()).for_each(|(value, x)| *value = gap.added_slope(x));
        let added: Coeffs<T> = by_size!(n, N => {
            let row = Table::of(N).coefficients(&values.as_chunks::<N>().0[0]);
            std::array::from_fn(|k| row.get(k).copied().unwrap_or(T::zero()))
        });
        let size = |terms: &[T], part: usize| {
            terms.iter().fold(T::zero(), |most, a| most.max(a.component(part).abs()))
        };
        let rounding = |part: usize| T::of(2.0) * T::epsilon() * size(&added, part);
        let is_open = |part: usize| size(&added[n - 2..n], part) > rounding(part);
        if terms > MAX_SIZE && (0..T::COMPONENTS).any(is_open) {
            let middle = T::of(0.5) * left + T::of(0.5) * right;
            for x in [[left, middle], [middle, right]] {
                let (series, length) = self.over(Interval { left: x[0], right: x[1] });
                Self { x, series, length, ..*self }.push_with_added(gap, to);
            }
            return;
        }
        // What lies beyond the length is noise.
        sum.series[self.length..].fill(T::zero());
        sum.series.iter_mut().zip(added).for_each(|(a, by)| *a += by);
        sum.count(n);
        // The series tells whether the slope falls.
        (sum.error, sum.fall) = (self.error + rounding(0), T::one() / T::zero());
        to.push(sum);
    }

    /// Returns the place of `x` in the panel, from -1 to 1; exact at both ends.
    pub fn local(&self, x: T) -> T {
        ((x - self.x[0]) - (self.x[1] - x)) / (self.x[1] - self.x[0])
    }

    pub fn half(&self) -> T {
        T::of(0.5) * (self.x[1] - self.x[0])
    }

    /// Returns the nodes.
    pub fn nodes(&self) -> impl Iterator<Item = T> + use<'_, T> {
        let place = |&z: &f64| self.x[0] + self.half() * T::of(1.0 + z);
        Table::of(self.n).z[..self.n].iter().map(place)
    }

    pub fn coefficients(&self) -> &[T] {
        &self.series[..self.length]
    }

    /// Returns the slope at the left and at the right end.
    pub fn at_ends(&self) -> [T; 2] {
        let mut sums = [T::zero(); 2];
        for (i, &a) in self.coefficients().iter().enumerate() {
            sums[i % 2] += a;
        }
        [sums[0] - sums[1], sums[0] + sums[1]]
    }

    /// Returns the slope at x.
    pub fn value(&self, x: T) -> T {
        value_at(self.coefficients(), self.local(x))
    }

    /// Returns `∫ g dx` from one place to another.
    pub fn rise(&self, from: T, to: T) -> T {
        let ends = [from, to].map(|x| self.local(x));
        let [from, to] = values(&primitive(self.coefficients())[..=self.length], &ends);
        self.half() * (to - from)
    }

    /// Returns the slope as `Σ c_k T_k(z)` over a contact `c + L z`.
    #[inline(always)]
    pub fn over(&self, on: Interval<T>) -> Series<T> {
        if same(self.x[0], on.left) && same(self.x[1], on.right) {
            return (self.series, self.length);
        }
        let ends = [self.local(on.left), self.local(on.right)];
        (expand(self.coefficients(), ends), size_for(self.length))
    }
}

/// Coefficients of a series, and the number of significant ones.
pub(super) type Series<T> = (Coeffs<T>, usize);

/// Returns the size up to which a coefficient is rounding, given the size of the largest.
fn rounding<T: Real>(largest: T) -> T {
    T::of(0.125) * T::epsilon() * largest
}

/// Returns the number of significant coefficients, two at least: up to the last that exceeds
/// `nothing`, a function of the largest, in any of the components `parts`.
fn significant_length<T: Real>(
    series: &[T],
    parts: std::ops::Range<usize>,
    nothing: impl Fn(T) -> T,
) -> usize {
    let mut length = 2;
    for part in parts {
        let size = |a: &T| a.component(part).abs();
        let nothing = nothing(series.iter().fold(T::zero(), |max, a| max.max(size(a))));
        let last = series.iter().rposition(|a| size(a) > nothing);
        length = last.map_or(2, |last| last + 1).max(length);
    }
    length
}

/// Returns the panels that an interval lies on. The outermost of them may have to be continued a
/// little.
pub(super) fn within<T: Real>(panels: &[Panel<T>], on: Interval<T>) -> &[Panel<T>] {
    let first = panels.partition_point(|panel| panel.x[1] <= on.left);
    let last = panels.partition_point(|panel| panel.x[0] < on.right).max(first + 1);
    &panels[first.min(panels.len() - 1)..last.min(panels.len())]
}

/// Returns a polynomial with N values of the slope over a contact, and the panels that differ from
/// it at a node of their part of the contact, judged by the difference and the place.
pub(super) fn across<'p, const N: usize, T: Real>(
    panels: &'p [Panel<T>],
    on: Interval<T>,
    is_same: impl Fn(&Panel<T>, T, T) -> bool + 'p,
) -> (Panel<T>, impl Iterator<Item = &'p Panel<T>>) {
    let mut whole = Panel { n: N, ..Panel::new([on.left, on.right]) };
    let mut values = [T::zero(); N];
    for (value, x) in values.iter_mut().zip(whole.nodes()) {
        let next = panels.partition_point(|panel| panel.x[1] < x);
        *value = panels[next.min(panels.len() - 1)].value(x);
    }
    whole.series[..N].copy_from_slice(&Table::of(N).coefficients(&values));
    whole.count(N);
    let differs = move |&(panel, x): &(&Panel<T>, [T; 2])| {
        let part = Panel { n: panel.n, ..Panel::new(x) };
        !part.nodes().all(|x| is_same(&whole, whole.value(x) - panel.value(x), x))
    };
    (whole, spans(panels, on).filter(differs).map(|(panel, _)| panel))
}

/// Least fall of the slope from one panel to the next, in units of its error, that is no rounding:
/// there the pressure goes to minus infinity.
const LEAST_FALL: f64 = 16.0;

impl<T: Real> PanelIntegrator<T> {
    /// Lists the places in a contact where the slope falls from one panel to the next.
    pub(crate) fn drops(&self, contact: usize) -> impl Iterator<Item = T> {
        let (PanelSet { panels, tolerance, size, .. }, on) = self.contact(contact);
        let falls = move |pair: &&[Panel<T>]| {
            let error = pair[0].error.max(pair[1].error) + *tolerance * *size;
            pair[0].at_ends()[1] - pair[1].at_ends()[0] > T::of(LEAST_FALL) * error
        };
        within(panels, on).windows(2).filter(falls).map(|pair| pair[0].x[1])
    }

    /// Adds the parts of a contact whose panels differ by more than allowed from one smooth series
    /// over it.
    pub(crate) fn uneven(&self, contact: usize, allowed: impl Fn(T) -> T, to: &mut Vec<[T; 2]>) {
        let (PanelSet { panels, .. }, on) = self.contact(contact);
        let is_same = |_: &Panel<T>, missed: T, x| missed.abs() <= allowed(x);
        let (_, uneven) = across::<SMOOTH, T>(within(panels, on), on, is_same);
        to.extend(uneven.map(|panel| [panel.x[0].max(on.left), panel.x[1].min(on.right)]));
    }

    /// Lists the rises of the gap from node to node of the panels of all contacts, of the bodies as
    /// described.
    pub(crate) fn rises_between(&self) -> Vec<([T; 2], T)> {
        let mut rises = Vec::new();
        // A first estimate has seen too little.
        if self.decay.is_some() {
            return rises;
        }
        let count = self.several().map_or(1, |several| several.contacts().len());
        for panel_set in (0..count).map(|i| self.contact(i).0) {
            for panel in panel_set.as_described() {
                let nodes: Vec<T> = panel.nodes().collect();
                let rise = |x: &[T]| ([x[0], x[1]], panel.rise(x[0], x[1]));
                let x = [&[panel.x[0]], &nodes[..], &[panel.x[1]]].concat();
                rises.extend(x.windows(2).map(rise));
            }
        }
        rises
    }
}

/// Returns `∫ g dx` between two places by the panels around.
pub(crate) fn rise<T: Real>(panels: &[Panel<T>], from: T, to: T) -> T {
    if to < from {
        return -rise(panels, to, from);
    }
    let on = Interval { left: from, right: to };
    let spans = spans(within(panels, on), on);
    spans.fold(T::zero(), |sum, (panel, [from, to])| sum + panel.rise(from, to))
}

/// Lists panels with their parts of an interval; the outermost parts reach its ends.
pub(super) fn spans<T: Real>(
    panels: &[Panel<T>],
    on: Interval<T>,
) -> impl Iterator<Item = (&Panel<T>, [T; 2])> {
    let last = panels.len() - 1;
    panels.iter().enumerate().map(move |(i, panel)| {
        let from = if i == 0 { on.left } else { panel.x[0] };
        let to = if i == last { on.right } else { panel.x[1] };
        (panel, [from, to])
    })
}

/// Verdict on the coefficients of a series.
pub(super) enum Resolution<T> {
    /// Good enough, with an estimate of the largest error.
    Good(T),
    /// Noise: the coefficients have sunk into the noise of the samples, of this size.
    Noise(T),
    /// Number of nodes that should suffice, and the size of the last coefficients.
    Take(usize, T),
    /// Size of the last coefficients, which fall too slowly: the panel is too long for one
    /// polynomial.
    Split(T),
}

/// Judges a series by the larger one of each two coefficients, since it may be odd or even.
///
/// Errors up to `allowed` are good enough. `rounded` is the error of the bodies' slopes on this
/// panel by one unit of rounding.
pub(super) fn judge<T: Real>(n: usize, series: &[T], allowed: T, rounded: T) -> Resolution<T> {
    let pairs = n / 2;
    let pair = |i: usize| series[2 * i].abs().max(series[2 * i + 1].abs());
    let (last, before) = (pair(pairs - 1), pair(pairs - 2));
    let ratio = |a: T, b: T| if a.is_zero() { a } else { a / b };
    let mut fall = ratio(last, before);
    // Coefficients that fall more slowly than before have met the noise.
    let mut levels = false;
    if pairs >= 4 {
        let fell = ratio(before, pair(pairs - 3));
        levels = fall > T::of(10.0) * fell;
        fall = fall.max(fell);
    }
    if last <= T::of(8.0) * rounded {
        return Resolution::Good(last.max(rounded));
    }
    let error = if levels {
        last + last
    } else if fall < T::of(0.3) {
        (last + last) * fall
    } else {
        // The coefficients may fall only like a power: the rest adds up.
        last * T::count(n)
    };
    if error <= allowed {
        return Resolution::Good(error.max(rounded));
    }
    // Noise has no trend; the coefficients of a kink, or of a square root, fall to a third or so
    // from one third of them to the next, and to half from the third quarter to the last.
    let mean = |i: usize, parts: usize| {
        let terms = &series[i * n / parts..(i + 1) * n / parts];
        terms.iter().fold(T::zero(), |sum, a| sum + a.abs()) / T::count(terms.len())
    };
    let plateau = mean(2, 3);
    let faint = plateau <= rounded / T::epsilon().cbrt();
    let levels_off =
        || plateau >= T::of(0.42) * mean(1, 3) || n >= 24 && mean(3, 4) >= T::of(0.6) * mean(2, 4);
    if n >= 12 && faint && levels_off() {
        return Resolution::Noise(plateau);
    }
    if faint && n < 24 {
        return Resolution::Take(24, last);
    }
    let expected = |more| (n..more).step_by(2).fold(error, |expected, _| expected * fall);
    let enough = SIZES.into_iter().find(|&more| more > n && expected(more) <= allowed);
    enough.map_or(Resolution::Split(last), |more| Resolution::Take(more, last))
}
