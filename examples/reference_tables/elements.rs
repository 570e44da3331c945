//! Plain textbook boundary elements: pressures that are constant on an element or linear between
//! nodes, Flamant's displacements, and an active set of the points in contact.

use std::error::Error;

#[derive(Clone, Copy)]
pub enum Kind {
    Constant,
    Linear,
}

/// Contact problem with E* = 1.
pub struct Scene<'s> {
    /// Height of the body above the half-plane.
    pub height: &'s dyn Fn(f64) -> f64,
    pub load: f64,
    /// Period of an infinite row of contacts.
    pub period: Option<f64>,
}

pub struct Found {
    /// Collocation points, for pressure and gap.
    pub x: Vec<f64>,
    pub pressure: Vec<f64>,
    /// Number of points in contact.
    pub touching: usize,
    /// Approach of the bodies, towards a reference length of 1.
    pub approach: f64,
}

impl Found {
    pub fn peak(&self) -> f64 {
        self.pressure.iter().fold(0.0, |peak: f64, &p| peak.max(p))
    }

    /// Returns the pressure at x, linear between the points.
    pub fn at(&self, x: f64) -> f64 {
        let right = self.x.partition_point(|&place| place < x).clamp(1, self.x.len() - 1);
        let share = (x - self.x[right - 1]) / (self.x[right] - self.x[right - 1]);
        self.pressure[right - 1] * (1.0 - share) + self.pressure[right] * share
    }
}

/// Solves with elements between the given nodes; `starts_on` gives the points in contact at the
/// start.
pub fn solve(
    kind: Kind,
    nodes: &[f64],
    scene: &Scene<'_>,
    starts_on: impl Fn(f64) -> bool,
) -> Result<Found, Box<dyn Error>> {
    let x: Vec<f64> = match kind {
        Kind::Constant => nodes.windows(2).map(|cell| 0.5 * (cell[0] + cell[1])).collect(),
        Kind::Linear => nodes.to_vec(),
    };
    let count = x.len();
    // Displacement at each point by each unknown, and the length over which the unknown acts.
    let mut influence = vec![vec![0.0; count]; count];
    let mut area = vec![0.0; count];
    for (j, cell) in nodes.windows(2).enumerate() {
        let length = cell[1] - cell[0];
        for (i, row) in influence.iter_mut().enumerate() {
            let [all, rising] = logarithms([cell[0] - x[i], cell[1] - x[i]], scene.period);
            let scale = -2.0 / std::f64::consts::PI;
            match kind {
                Kind::Constant => row[j] += scale * all,
                Kind::Linear => {
                    row[j] += scale * (all - rising);
                    row[j + 1] += scale * rising;
                }
            }
        }
        match kind {
            Kind::Constant => area[j] += length,
            Kind::Linear => (area[j], area[j + 1]) = (area[j] + 0.5 * length, 0.5 * length),
        }
    }
    let height: Vec<f64> = x.iter().map(|&x| (scene.height)(x)).collect();
    let mut on: Vec<bool> = x.iter().map(|&x| starts_on(x)).collect();
    for _ in 0..100 {
        let active: Vec<usize> = (0..count).filter(|&i| on[i]).collect();
        let mut system: Vec<Vec<f64>> = active
            .iter()
            .map(|&i| {
                let row = active.iter().map(|&j| influence[i][j]);
                row.chain([-1.0, -height[i]]).collect()
            })
            .collect();
        system.push(active.iter().map(|&j| area[j]).chain([0.0, scene.load]).collect());
        let solution = eliminate(system);
        let approach = solution[active.len()];
        let mut pressure = vec![0.0; count];
        active.iter().zip(&solution).for_each(|(&i, &p)| pressure[i] = p);
        let gap = |i: usize| {
            let pressed: f64 = active.iter().map(|&j| influence[i][j] * pressure[j]).sum();
            height[i] + pressed - approach
        };
        let wrong: Vec<usize> =
            (0..count).filter(|&i| if on[i] { pressure[i] < 0.0 } else { gap(i) < 0.0 }).collect();
        if wrong.is_empty() {
            return Ok(Found { x, pressure, touching: active.len(), approach });
        }
        wrong.into_iter().for_each(|i| on[i] = !on[i]);
    }
    Err("the active set does not settle".into())
}

/// Returns `∫ ln|u| du` over an element, and the integral with a weight that rises from 0 to 1. For
/// a row of sources the kernel is ln|2 sin|, in units of its length.
fn logarithms([from, to]: [f64; 2], period: Option<f64>) -> [f64; 2] {
    let shift = period.map_or(0.0, |l| l * (0.5 * (from + to) / l).round());
    let [from, to] = [from - shift, to - shift];
    let length = to - from;
    let zeroth = |u: f64| if u == 0.0 { 0.0 } else { u * u.abs().ln() - u };
    let first = |u: f64| if u == 0.0 { 0.0 } else { 0.5 * u * u * (u.abs().ln() - 0.5) };
    let all = zeroth(to) - zeroth(from);
    let rising = (first(to) - first(from) - from * all) / length;
    let Some(l) = period else { return [all, rising] };
    // The contribution of the images is smooth: Gauss's rule with three points.
    let angle = std::f64::consts::PI / l;
    let images = |u: f64| if u == 0.0 { 0.0 } else { ((angle * u).sin() / (angle * u)).abs().ln() };
    let root = 0.6f64.sqrt();
    let points =
        [(0.5 - 0.5 * root, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.5 + 0.5 * root, 5.0 / 18.0)];
    points.into_iter().fold([all, rising], |[all, rising], (share, weight)| {
        let added = weight * length * images(from + share * length);
        [all + added, rising + share * added]
    })
}

/// Solves a linear system by Gaussian elimination with the largest pivot of each column; the right
/// side is the last column.
fn eliminate(mut system: Vec<Vec<f64>>) -> Vec<f64> {
    let n = system.len();
    for column in 0..n {
        let size = |row: &usize| system[*row][column].abs();
        let pivot = (column..n).max_by(|a, b| size(a).total_cmp(&size(b))).unwrap_or(column);
        system.swap(column, pivot);
        let (above, below) = system.split_at_mut(column + 1);
        let line = &above[column];
        for row in below {
            let factor = row[column] / line[column];
            for (value, &from) in row[column..].iter_mut().zip(&line[column..]) {
                *value -= factor * from;
            }
        }
    }
    let mut solution = vec![0.0; n];
    for row in (0..n).rev() {
        let line = &system[row];
        let known: f64 = (row + 1..n).map(|j| line[j] * solution[j]).sum();
        solution[row] = (line[n] - known) / line[row];
    }
    solution
}
