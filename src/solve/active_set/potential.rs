//! Displacement of the surface by forces on cells: the logarithm of the distance, averaged over the
//! loaded cell and over the observed one.
//!
//! Up to a few hundred cells, each loaded cell has a column of a matrix, kept from cut to cut. With
//! more cells, neighbouring ones have matrices. The forces of distant cells act through their
//! moments (Barnes and Hut, *Nature* 324, 1986, 446), whose effect is interpolated between a few
//! places of a block of cells.

use crate::Real;
use crate::numerics::dot;
use std::f64::consts::PI;
use std::sync::LazyLock;

/// Largest number of cells with columns.
const MAX_COLUMNS: usize = 320;

/// Largest number of cells in a block, with more cells than `MAX_COLUMNS`.
const BLOCK: usize = 16;

/// Numbers of moments of the forces of a group, and of places in a block: both leave errors of
/// about 1e-5.
const MOMENTS: usize = 10;
const PLACES: usize = 8;

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
pub(super) fn mean_log<T: Real>(one: CellPlace<T>, other: CellPlace<T>) -> T {
    let distance = (one.centre - other.centre).abs();
    let (v, w) = (one.width, other.width);
    if distance > T::of(1.9) * v.max(w) {
        let inverse = T::one() / (distance * distance);
        let [v, w] = [v * v * inverse, w * w * inverse];
        let second = (v + w) / T::of(24.0);
        let fourth = (v * v + w * w) / T::of(320.0) + v * w / T::of(96.0);
        return second + fourth - distance.ln();
    }
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
pub(super) struct Potential<T> {
    cells: Vec<CellPlace<T>>,
    /// Potential in each cell of a unit force on a cell; empty until needed.
    columns: Vec<Vec<T>>,
    /// Groups and blocks, if there are many cells.
    groups: Vec<CellGroup<T>>,
    blocks: Vec<Block<T>>,
}

/// Adjacent cells, and the powers of their places about the middle of the group.
struct CellGroup<T> {
    cells: [usize; 2],
    centre: T,
    radius: T,
    powers: Vec<[T; MOMENTS]>,
    /// Numbers of the two halves; `None` for a block.
    halves: Option<[usize; 2]>,
}

/// Smallest group, and the matrices that act on its cells.
struct Block<T> {
    cells: [usize; 2],
    /// Ranges of nearby cells, each with a matrix whose rows are the cells of the block.
    near: Vec<([usize; 2], Vec<T>)>,
    /// Distant groups, and the potential of their moments at the places.
    far: Vec<(usize, [[T; MOMENTS]; PLACES])>,
    /// Shares of the values at the places in the mean over each cell.
    shares: Vec<[T; PLACES]>,
}

impl<T: Real> Potential<T> {
    pub fn new() -> Self {
        let (cells, columns) = (Vec::new(), Vec::new());
        Self { cells, columns, groups: Vec::new(), blocks: Vec::new() }
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
        self.blocks.clear();
        if self.cells.len() > MAX_COLUMNS {
            let root = group(&self.cells, [0, self.cells.len()], BLOCK, &mut self.groups);
            for target in self.groups.iter().filter(|group| group.halves.is_none()) {
                self.blocks.push(Block::new(&self.cells, &self.groups, target, root));
            }
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
            // The matrix is symmetric.
            let entry = |i: usize| match self.columns[i].get(j) {
                Some(&entry) => entry,
                None => self.mean_log(i, j),
            };
            self.columns[j] = (0..self.cells.len()).map(entry).collect();
        }
    }

    fn mean_log(&self, i: usize, j: usize) -> T {
        mean_log(self.cells[i], self.cells[j])
    }

    /// Returns the potential in cell i of a unit force on cell j.
    pub fn entry(&self, i: usize, j: usize) -> T {
        if let Some(column) = self.columns.get(j) {
            return column[i];
        }
        let block = &self.blocks[self.blocks.partition_point(|block| block.cells[1] <= i)];
        let near = block.near.iter().find(|([first, end], _)| (*first..*end).contains(&j));
        match near {
            Some(([first, end], matrix)) => {
                matrix[(i - block.cells[0]) * (end - first) + j - first]
            }
            None => self.mean_log(i, j),
        }
    }

    /// Computes the potential of the forces in every cell; with many cells, only in the wanted
    /// ones.
    pub fn of(&self, forces: &[T], wanted: impl Fn(usize) -> bool, potential: &mut [T]) {
        if !self.columns.is_empty() {
            potential.fill(T::zero());
            for (column, &force) in self.columns.iter().zip(forces).filter(|of| !of.1.is_zero()) {
                for (potential, &entry) in potential.iter_mut().zip(column) {
                    *potential += force * entry;
                }
            }
        }
        let moments: Vec<_> = self.groups.iter().map(|group| group.moments(forces)).collect();
        for block in &self.blocks {
            let mut at_places = [T::zero(); PLACES];
            for (group, transfer) in &block.far {
                for (value, row) in at_places.iter_mut().zip(transfer) {
                    *value += dot(row, &moments[*group]);
                }
            }
            let [from, to] = block.cells;
            for (i, shares) in (from..to).zip(&block.shares).filter(|&(i, _)| wanted(i)) {
                let mut sum = dot(shares, &at_places);
                for ([first, end], matrix) in &block.near {
                    let row = (i - from) * (end - first);
                    sum += dot(&matrix[row..row + end - first], &forces[*first..*end]);
                }
                potential[i] = sum;
            }
        }
    }
}

/// Adds a group and all groups within it; returns its number.
fn group<T: Real>(
    cells: &[CellPlace<T>],
    [from, to]: [usize; 2],
    block: usize,
    groups: &mut Vec<CellGroup<T>>,
) -> usize {
    let half = T::of(0.5);
    let halves = (to - from > block).then(|| {
        let middle = usize::midpoint(from, to);
        [[from, middle], [middle, to]].map(|part| group(cells, part, block, groups))
    });
    let (first, last) = (cells[from], cells[to - 1]);
    let [left, right] = [first.centre - half * first.width, last.centre + half * last.width];
    let (centre, radius) = (half * (left + right), half * (right - left));
    let powers = cells[from..to].iter().map(|cell| {
        let mut mean = [T::zero(); MOMENTS];
        for (at, weight) in GAUSS {
            let t = (cell.centre - centre + T::of(at) * cell.width) / radius;
            let mut power = T::of(weight);
            for mean in &mut mean {
                *mean += power;
                power *= t;
            }
        }
        mean
    });
    let powers = powers.collect();
    groups.push(CellGroup { cells: [from, to], centre, radius, powers, halves });
    groups.len() - 1
}

impl<T: Real> CellGroup<T> {
    fn moments(&self, forces: &[T]) -> [T; MOMENTS] {
        let mut moments = [T::zero(); MOMENTS];
        let [from, to] = self.cells;
        for (powers, &force) in self.powers.iter().zip(&forces[from..to]) {
            if !force.is_zero() {
                for (moment, &power) in moments.iter_mut().zip(powers) {
                    *moment += force * power;
                }
            }
        }
        moments
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

impl<T: Real> Block<T> {
    fn new(
        cells: &[CellPlace<T>],
        groups: &[CellGroup<T>],
        target: &CellGroup<T>,
        root: usize,
    ) -> Self {
        let [from, to] = target.cells;
        let places = AT_PLACES.map(|at| T::of(at[1]));
        let (mut near, mut far) = (Vec::new(), Vec::new());
        let mut waiting = vec![root];
        while let Some(number) = waiting.pop() {
            let source = &groups[number];
            let apart = (source.centre - target.centre).abs();
            if apart > T::of(2.5) * (source.radius + target.radius) {
                let at = |t: T| source.transfer(target.centre + t * target.radius);
                far.push((number, places.map(at)));
            } else if let Some(halves) = source.halves {
                waiting.extend(halves);
            } else {
                let [first, end] = source.cells;
                let mut matrix = Vec::with_capacity((to - from) * (end - first));
                for i in from..to {
                    for j in first..end {
                        // The matrix of a block on itself is symmetric.
                        let known = first == from && j < i;
                        matrix.push(if known {
                            matrix[(j - first) * (end - first) + i - from]
                        } else {
                            mean_log(cells[i], cells[j])
                        });
                    }
                }
                near.push((source.cells, matrix));
            }
        }
        let shares = cells[from..to].iter().map(|cell| {
            let mut shares = [T::zero(); PLACES];
            for (at, weight) in GAUSS {
                let t = (cell.centre + T::of(at) * cell.width - target.centre) / target.radius;
                for (share, value) in shares.iter_mut().zip(cardinals(t)) {
                    *share += T::of(weight) * value;
                }
            }
            shares
        });
        Self { cells: [from, to], near, shares: shares.collect(), far }
    }
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
        let mut potential = Potential::new();
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
