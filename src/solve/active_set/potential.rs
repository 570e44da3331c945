//! Displacement of the surface by forces on cells: the logarithm of the distance, averaged over the
//! loaded cell and over the observed one.
//!
//! Up to a few hundred cells, each loaded cell has a column of a matrix, kept from cut to cut. With
//! more cells, neighbouring ones have matrices. The forces of distant groups act through their
//! moments, whose effect is interpolated between a few places of a group, and from these between
//! those of its halves (Greengard and Rokhlin, *J. Comput. Phys.* 73, 1987, 325).
//!
//! A regular kernel nearly cancels the logarithm on a thin layer. So both are averaged exactly, and
//! all cells have columns.

use crate::Real;
use crate::kernel::{Kernel, at_least};
use crate::numerics::dot;
use std::cell::RefCell;
use std::collections::HashMap;
use std::f64::consts::PI;
use std::sync::LazyLock;

/// Largest number of cells with columns.
const MAX_COLUMNS: usize = 320;

/// Largest number of cells in a group that is not halved, with more cells than `MAX_COLUMNS`.
const MAX_CELLS_UNDIVIDED: usize = 16;

/// Numbers of moments of the forces of a group, and of places in it: both leave errors of about
/// 1e-5.
const MOMENTS: usize = 8;
const PLACES: usize = 6;

/// Distances of cells, by the wider one, from which a series is the mean of the logarithm: it
/// leaves errors of 1e-5 and 1e-14.
const FAR: f64 = 1.9;
const FURTHER: f64 = 60.0;

/// Largest number of parts of a cell, each with a rule for a regular kernel: a wider one is cut.
const MAX_PARTS: usize = 12;

/// Number of lengths that are told apart.
const KEYS: f64 = 1e12;

/// Abscissae and weights of Gauss's rule with three points on [-1/2, 1/2].
const GAUSS: [(f64, f64); 3] = [
    (-0.387_298_334_620_741_7, 5.0 / 18.0),
    (0.0, 4.0 / 9.0),
    (0.387_298_334_620_741_7, 5.0 / 18.0),
];

/// Cell, in units of a length no less than the distance of any two cells.
#[derive(Clone, Copy, Debug)]
pub(super) struct CellPlace<T> {
    pub centre: T,
    pub width: T,
}

/// Returns the mean of `-ln|x - s|` for x in one cell and s in the other.
#[inline(always)]
pub(super) fn mean_log<T: Real>(one: CellPlace<T>, other: CellPlace<T>) -> T {
    let distance = (one.centre - other.centre).abs();
    if distance > T::of(FAR) * one.width.max(other.width) {
        by_series(distance, one.width, other.width)
    } else {
        exactly(distance, one.width, other.width)
    }
}

#[inline(always)]
fn by_series<T: Real>(distance: T, v: T, w: T) -> T {
    let inverse = T::one() / (distance * distance);
    let [v, w] = [v * v * inverse, w * w * inverse];
    let second = (v + w) / T::of(24.0);
    let fourth = (v * v + w * w) / T::of(320.0) + v * w / T::of(96.0);
    second + fourth - distance.ln()
}

#[inline(always)]
fn exactly<T: Real>(distance: T, v: T, w: T) -> T {
    // This formula, in units of the wider cell, is exact.
    let size = v.max(w);
    let [distance, v, w] = [distance / size, v / size, w / size];
    let twice = |y: T| {
        let y = y.abs();
        if y.is_zero() { y } else { y * y * (T::of(0.5) * y.ln() - T::of(0.75)) }
    };
    let [sum, difference] = [T::of(0.5) * (v + w), T::of(0.5) * (v - w)];
    let outer = twice(distance + sum) + twice(distance - sum);
    let inner = twice(distance + difference) + twice(distance - difference);
    (inner - outer) / (v * w) - size.ln()
}

/// Potential of forces on given cells.
pub(super) struct Potential<'s, T: Real> {
    cells: Vec<CellPlace<T>>,
    /// Potential in each cell of a unit force on a cell; empty until needed.
    columns: Vec<Vec<T>>,
    /// Groups, if there are many cells: the halves of each before it.
    groups: Vec<CellGroup<T>>,
    smooth: Option<Smooth<'s, T>>,
}

/// Regular kernel, whose integral is subtracted from the potential.
struct Smooth<'s, T: Real> {
    kernel: &'s Kernel<'s, T>,
    /// Range of the cells, which is their unit of length.
    range: [T; 2],
    /// Nodes in each cell, with weights whose sum is one, and what the integral of the kernel lacks
    /// of a symmetric one for a force there: it may contain any function of s.
    nodes: Vec<(Vec<[T; 2]>, T)>,
    /// Means of the potential, for cells of some widths at some places: of a kernel of `x - s`, at
    /// some distance, which many pairs share.
    known: RefCell<HashMap<[u64; 4], T>>,
}

impl<T: Real> Smooth<'_, T> {
    /// Takes other cells: a rule of three points for each length on which the kernel changes.
    fn take(&mut self, cells: &[CellPlace<T>]) {
        let [left, right] = self.range;
        let size = right - left;
        let length = T::of(0.5) * self.kernel.distance() / size;
        let nodes = |cell: &CellPlace<T>| {
            let parts = at_least((cell.width / length).component(0)).clamp(1, MAX_PARTS);
            let (width, count) = (cell.width / T::count(parts), T::count(parts));
            let node = |(part, (at, weight)): (usize, (f64, f64))| {
                let place = T::count(part) + T::of(0.5 + at) - T::of(0.5) * count;
                let x = cell.centre + width * place;
                [x * size, T::of(weight) / count]
            };
            let all = (0..parts).flat_map(|part| GAUSS.map(|point| (part, point)));
            let nodes: Vec<[T; 2]> = all.map(node).collect();
            let lack = |x: T| self.kernel.height(x, left) - self.kernel.height(left, x);
            let lacks = nodes.iter().map(|&[x, weight]| weight * lack(x));
            let lacks = lacks.fold(T::zero(), |sum, lack| sum + lack);
            (nodes, lacks)
        };
        self.nodes = cells.iter().map(nodes).collect();
    }

    // Inlined it would cost ten contacts of half-planes 3 % more instructions.
    #[inline(never)]
    fn mean(&self, [i, j]: [usize; 2], [one, other]: [CellPlace<T>; 2]) -> T {
        let places = match self.kernel.formula {
            Some(_) => [one.centre, other.centre],
            None => [(one.centre - other.centre).abs(), T::zero()],
        };
        let key = [one.width, other.width, places[0], places[1]].map(|length| {
            let key: f64 = (T::of(KEYS) * length).to_subset_unchecked();
            key.round().to_bits()
        });
        let mean = || {
            let ([left, right], (loads, lacks)) = (self.range, &self.nodes[j]);
            let of = |&[x, weight]: &[T; 2]| weight * self.kernel.sums([1], x, loads)[0];
            let sum = self.nodes[i].0.iter().map(of).fold(*lacks, |sum, of| sum + of);
            // With a potential of zero at the distance of both ends the matrix is positive.
            let level = self.kernel.height(right, left);
            let distance = (one.centre - other.centre).abs();
            let is_far = distance > T::of(FURTHER) * one.width.max(other.width);
            let mean_log = if is_far { by_series } else { exactly };
            (mean_log(distance, one.width, other.width) + level - sum).component(0)
        };
        *self.known.borrow_mut().entry(key).or_insert_with(mean)
    }
}

/// Adjacent cells.
struct CellGroup<T> {
    cells: [usize; 2],
    centre: T,
    radius: T,
    /// Numbers of the two halves, if any.
    halves: Option<[usize; 2]>,
    /// Powers of the places of the cells about the middle, if there are no halves.
    powers: Vec<[T; MOMENTS]>,
    /// Shares of the values at the places of the group in those at the places of both halves, or in
    /// the mean over each cell.
    shares: Vec<[T; PLACES]>,
    /// Distant groups, and the potential of their moments at the places.
    far: Vec<(usize, [[T; MOMENTS]; PLACES])>,
    /// Ranges of nearby cells, each with a matrix whose rows are the cells of the group.
    near: Vec<([usize; 2], Vec<T>)>,
}

impl<'s, T: Real> Potential<'s, T> {
    pub fn new(kernel: Option<&'s Kernel<'s, T>>, range: [T; 2]) -> Self {
        let (cells, columns, groups) = (Vec::new(), Vec::new(), Vec::new());
        let smooth = |kernel| {
            let (nodes, known) = (Vec::new(), RefCell::default());
            Smooth { kernel, range, nodes, known }
        };
        Self { cells, columns, groups, smooth: kernel.map(smooth) }
    }

    /// Tells whether there is a regular kernel.
    pub fn is_of_kernel(&self) -> bool {
        self.smooth.is_some()
    }

    /// Takes other cells, some of which had a number before. Keeps the columns of the wanted ones.
    pub fn set(
        &mut self,
        cells: Vec<CellPlace<T>>,
        before: &[Option<usize>],
        wanted: impl Fn(usize) -> bool,
    ) {
        let known = std::mem::take(&mut self.columns);
        self.cells = cells;
        self.groups.clear();
        if let Some(smooth) = &mut self.smooth {
            smooth.take(&self.cells);
        } else if self.cells.len() > MAX_COLUMNS {
            let root = self.group([0, self.cells.len()]);
            self.see(root, vec![root]);
            return;
        }
        for (j, &number) in before.iter().enumerate() {
            let column = number.and_then(|number| known.get(number)).filter(|_| wanted(j));
            self.columns.push(match column {
                Some(column) if !column.is_empty() => {
                    let entry = |(i, number): (usize, &Option<usize>)| {
                        number.map_or_else(|| self.mean_log(i, j), |number| column[number])
                    };
                    before.iter().enumerate().map(entry).collect()
                }
                _ => Vec::new(),
            });
        }
    }

    /// Computes the column for a force on a cell.
    pub fn load(&mut self, j: usize) {
        if self.columns.get(j).is_some_and(Vec::is_empty) {
            let cells = &self.cells;
            self.columns[j] = match &self.smooth {
                None => self.column(j, |i| mean_log(cells[i], cells[j])),
                Some(smooth) => self.column(j, |i| smooth.mean([i, j], [cells[i], cells[j]])),
            };
        }
    }

    fn column(&self, j: usize, mean: impl Fn(usize) -> T) -> Vec<T> {
        // The matrix is symmetric.
        let entry = |i: usize| self.columns[i].get(j).copied().unwrap_or_else(|| mean(i));
        (0..self.cells.len()).map(entry).collect()
    }

    #[inline(always)]
    fn mean_log(&self, i: usize, j: usize) -> T {
        let (one, other) = (self.cells[i], self.cells[j]);
        match &self.smooth {
            None => mean_log(one, other),
            Some(smooth) => smooth.mean([i, j], [one, other]),
        }
    }

    /// Returns the potential in cell i of a unit force on cell j.
    pub fn entry(&self, i: usize, j: usize) -> T {
        if let Some(column) = self.columns.get(j) {
            return column[i];
        }
        let mut group = &self.groups[self.groups.len() - 1];
        while let Some([left, right]) = group.halves {
            group = &self.groups[if i < self.groups[left].cells[1] { left } else { right }];
        }
        let near = group.near.iter().find(|([first, end], _)| (*first..*end).contains(&j));
        match near {
            Some(([first, end], matrix)) => {
                matrix[(i - group.cells[0]) * (end - first) + j - first]
            }
            None => self.mean_log(i, j),
        }
    }

    /// Computes the potential of the forces in every cell; with many cells, only in the wanted
    /// ones.
    pub fn of(&self, forces: &[T], wanted: impl Fn(usize) -> bool, potential: &mut [T]) {
        potential.fill(T::zero());
        for (column, &force) in self.columns.iter().zip(forces).filter(|of| !of.1.is_zero()) {
            for (potential, &entry) in potential.iter_mut().zip(column) {
                *potential += force * entry;
            }
        }
        let mut moments = Vec::with_capacity(self.groups.len());
        for group in &self.groups {
            moments.push(match group.halves {
                None => group.moments(&forces[group.cells[0]..group.cells[1]]),
                Some(halves) => {
                    group.merged(halves.map(|half| (&self.groups[half], moments[half])))
                }
            });
        }
        let mut at_places = vec![[T::zero(); PLACES]; self.groups.len()];
        for (number, group) in self.groups.iter().enumerate().rev() {
            let mut values = at_places[number];
            for (source, transfer) in &group.far {
                for (value, row) in values.iter_mut().zip(transfer) {
                    *value += dot(row, &moments[*source]);
                }
            }
            let between = |shares: &[T; PLACES]| dot(shares, &values);
            if let Some(halves) = group.halves {
                for (half, shares) in halves.into_iter().zip(group.shares.as_chunks().0) {
                    at_places[half] = shares.each_ref().map(between);
                }
                continue;
            }
            let [from, to] = group.cells;
            for (i, shares) in (from..to).zip(&group.shares).filter(|&(i, _)| wanted(i)) {
                potential[i] =
                    group.near.iter().fold(between(shares), |sum, ([first, end], matrix)| {
                        let row = (i - from) * (end - first);
                        sum + dot(&matrix[row..row + end - first], &forces[*first..*end])
                    });
            }
        }
    }

    /// Adds all groups within one, and then that; returns its number.
    fn group(&mut self, [from, to]: [usize; 2]) -> usize {
        let half = T::of(0.5);
        let middle = usize::midpoint(from, to);
        let is_divided = to - from > MAX_CELLS_UNDIVIDED;
        let halves =
            is_divided.then(|| [[from, middle], [middle, to]].map(|part| self.group(part)));
        let (first, last) = (self.cells[from], self.cells[to - 1]);
        let [left, right] = [first.centre - half * first.width, last.centre + half * last.width];
        let (centre, radius) = (half * (left + right), half * (right - left));
        let (mut powers, mut shares) = (Vec::new(), Vec::new());
        for half in halves.iter().flatten().map(|&half| &self.groups[half]) {
            let at = |place: T| (half.centre + place * half.radius - centre) / radius;
            shares.extend(places().map(|place| cardinals(at(place))));
        }
        for cell in self.cells[from..to].iter().filter(|_| !is_divided) {
            let mut mean = ([T::zero(); MOMENTS], [T::zero(); PLACES]);
            for (at, weight) in GAUSS {
                let t = (cell.centre - centre + T::of(at) * cell.width) / radius;
                let mut power = T::of(weight);
                for mean in &mut mean.0 {
                    *mean += power;
                    power *= t;
                }
                for (mean, value) in mean.1.iter_mut().zip(cardinals(t)) {
                    *mean += T::of(weight) * value;
                }
            }
            powers.push(mean.0);
            shares.push(mean.1);
        }
        let (cells, far, near) = ([from, to], Vec::new(), Vec::new());
        self.groups.push(CellGroup { cells, centre, radius, halves, powers, shares, far, near });
        self.groups.len() - 1
    }

    /// Prepares for the effect of groups on one, and on all within it.
    fn see(&mut self, number: usize, mut sources: Vec<usize>) {
        let target = &self.groups[number];
        let (mut far, mut beside, mut near) = (Vec::new(), Vec::new(), Vec::new());
        while let Some(source) = sources.pop() {
            let group = &self.groups[source];
            let apart = (group.centre - target.centre).abs();
            let is_wider = target.halves.is_none() || group.radius > target.radius;
            if apart > T::of(2.5) * (group.radius + target.radius) {
                let at = |place: T| group.transfer(target.centre + place * target.radius);
                far.push((source, places().map(at)));
            } else if let Some(halves) = group.halves.filter(|_| is_wider) {
                sources.extend(halves);
            } else if target.halves.is_some() {
                beside.push(source);
            } else {
                near.push((group.cells, self.matrix(target.cells, group.cells)));
            }
        }
        for half in target.halves.into_iter().flatten() {
            self.see(half, beside.clone());
        }
        let target = &mut self.groups[number];
        (target.far, target.near) = (far, near);
    }

    /// Returns the potential in some cells of unit forces on others, row by row.
    fn matrix(&self, [from, to]: [usize; 2], [first, end]: [usize; 2]) -> Vec<T> {
        (from..to).flat_map(|i| (first..end).map(move |j| self.mean_log(i, j))).collect()
    }
}

impl<T: Real> CellGroup<T> {
    fn moments(&self, forces: &[T]) -> [T; MOMENTS] {
        let mut moments = [T::zero(); MOMENTS];
        for (powers, &force) in self.powers.iter().zip(forces).filter(|of| !of.1.is_zero()) {
            for (moment, &power) in moments.iter_mut().zip(powers) {
                *moment += force * power;
            }
        }
        moments
    }

    /// Returns the moments from those of the halves.
    fn merged(&self, halves: [(&Self, [T; MOMENTS]); 2]) -> [T; MOMENTS] {
        let mut merged = [T::zero(); MOMENTS];
        for (half, mut moments) in halves {
            let (aside, size) =
                ((half.centre - self.centre) / self.radius, half.radius / self.radius);
            let mut power = T::one();
            for moment in &mut moments {
                *moment *= power;
                power *= size;
            }
            // The binomial theorem, a power of `aside` at a time.
            for first in 1..MOMENTS {
                for k in (first..MOMENTS).rev() {
                    let before = moments[k - 1];
                    moments[k] += aside * before;
                }
            }
            merged.iter_mut().zip(moments).for_each(|(merged, moment)| *merged += moment);
        }
        merged
    }

    /// Returns the potential of each moment at x.
    fn transfer(&self, x: T) -> [T; MOMENTS] {
        let distance = x - self.centre;
        let ratio = self.radius / distance;
        let mut row = [-distance.abs().ln(); MOMENTS];
        let mut power = T::one();
        for (k, share) in row.iter_mut().enumerate().skip(1) {
            power *= ratio;
            *share = power / T::count(k);
        }
        row
    }
}

/// Returns the places of a group, in units of its radius from its centre.
fn places<T: Real>() -> [T; PLACES] {
    AT_PLACES.map(|at| T::of(at[1]))
}

/// Chebyshev polynomials at the places.
static AT_PLACES: LazyLock<[[f64; PLACES]; PLACES]> = LazyLock::new(|| {
    let angle = |m: usize| PI * (m as f64 + 0.5) / PLACES as f64;
    std::array::from_fn(|m| std::array::from_fn(|k| (k as f64 * angle(m)).cos()))
});

/// Returns, at t, the polynomials that are one at one of the places and zero at the others.
fn cardinals<T: Real>(t: T) -> [T; PLACES] {
    // By the discrete orthogonality of Chebyshev polynomials at their own zeros.
    let mut twice = [T::one(); PLACES];
    let (mut before, mut chebyshev) = (T::one(), t);
    for twice in &mut twice[1..] {
        *twice = chebyshev + chebyshev;
        (before, chebyshev) = (chebyshev, T::of(2.0) * t * chebyshev - before);
    }
    let sum = |at: &[f64; PLACES]| {
        let both = at.iter().zip(&twice);
        both.fold(T::zero(), |sum, (&at, &twice)| sum + T::of(at) * twice) / T::count(PLACES)
    };
    std::array::from_fn(|m| sum(&AT_PLACES[m]))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cells of very different widths, side by side.
    fn graded(n: usize) -> Vec<CellPlace<f64>> {
        let width = |i: usize| 1.0 + 80.0 * (0.5 + 0.5 * (i as f64 * 0.04).sin()).powi(6);
        let total: f64 = (0..n).map(width).sum();
        let mut left = 0.0;
        let mut cell = |i| {
            let width = width(i) / total;
            left += width;
            CellPlace { centre: left - width / 2.0, width }
        };
        (0..n).map(&mut cell).collect()
    }

    #[test]
    fn the_mean_logarithm_is_its_double_integral() {
        let (points, weights) = gauss(40);
        for (distance, v, w) in [(0.9f64, 0.3, 0.2), (0.35, 0.3, 0.4), (0.2, 0.1, 0.05)] {
            let one = CellPlace { centre: distance, width: v };
            let mut sum = 0.0;
            for (t, a) in points.iter().zip(&weights) {
                for (u, b) in points.iter().zip(&weights) {
                    sum -= a * b * (distance + 0.5 * v * t - 0.5 * w * u).abs().ln() / 4.0;
                }
            }
            let found = mean_log(one, CellPlace { centre: 0.0, width: w });
            // The formula for cells far from each other leaves out the sixth power.
            assert!((found / sum - 1.0).abs() < 2e-4, "{distance}: {found} {sum}");
        }
        // A cell on itself: 3/2 - ln w.
        let cell = CellPlace { centre: 0.4f64, width: 0.01 };
        assert!((mean_log(cell, cell) - (1.5 - 0.01f64.ln())).abs() < 1e-13);
    }

    fn gauss(n: usize) -> (Vec<f64>, Vec<f64>) {
        // The midpoint rule in the angle suffices off the diagonal.
        let angle = |i: usize| std::f64::consts::PI * (i as f64 + 0.5) / n as f64;
        let weight = |i: usize| {
            let series =
                |k: usize| 2.0 * (2.0 * k as f64 * angle(i)).cos() / (4.0 * (k * k) as f64 - 1.0);
            2.0 / n as f64 * (1.0 - (1..=n / 2).map(series).sum::<f64>())
        };
        ((0..n).map(|i| angle(i).cos()).collect(), (0..n).map(weight).collect())
    }

    #[test]
    fn groups_far_off_act_as_their_cells_do() {
        let cells = graded(1500);
        let force = |i: usize| ((i * 7919) % 101) as f64 / 101.0;
        let forces: Vec<_> = (0..cells.len()).map(force).collect();
        let total: f64 = forces.iter().sum();
        let mut potential = Potential::new(None, [0.0, 1.0]);
        potential.set(cells.clone(), &vec![None; cells.len()], |_| true);
        let mut found = vec![0.0; cells.len()];
        potential.of(&forces, |_| true, &mut found);
        for (&cell, &found) in cells.iter().zip(&found) {
            let each = cells.iter().zip(&forces);
            let direct: f64 = each.map(|(&other, force)| force * mean_log(cell, other)).sum();
            assert!((found - direct).abs() < 2e-5 * total, "{found} {direct}");
        }
    }
}
