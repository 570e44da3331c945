//! Boundary elements: an oracle for any number of contacts that shares no code with the crate.
//!
//! The pressure is linear between nodes; P ≥ 0 and gap ≥ 0 hold at the nodes (collocation, an
//! active set). Cells are halved at the ends of contacts, in contacts of few cells, where the
//! pressure bends, and where the open gap is about to close. The integrals of the logarithm over a
//! cell are exact.
#![allow(dead_code)] // Each test crate uses its own part.

use linecontact::{CurvePoint, Interval, ParametricProfile};

/// Number of cells at the start.
const CELLS: usize = 128;
/// Largest number of halvings.
const HALVINGS: usize = 24;
/// Number of nodes at which halving stops.
const NODES: usize = 1600;
/// Least number of cells of a contact.
const FEWEST: usize = 32;
/// Largest bend of the pressure at a node, as a share of the peak.
const BEND: f64 = 0.02;
/// Number of cells halved on either side of an end of a contact.
const BESIDE: usize = 4;

/// Solution of the contact problem, to the resolution of the cells.
#[derive(Clone, Debug)]
pub struct Oracle {
    /// Contacts, from left to right.
    pub contacts: Vec<Interval<f64>>,
    /// Largest error of each limit.
    pub errors: Vec<[f64; 2]>,
    /// Sum of κ times the gap and the logarithmic potential of the pressures in the contacts.
    pub approach: f64,
    /// Nodes, from left to right.
    pub x: Vec<f64>,
    /// Pressures at the nodes.
    pub pressure: Vec<f64>,
    /// Gap of the loaded bodies at the nodes.
    pub gap: Vec<f64>,
}

impl Oracle {
    /// Returns the largest nodal pressure.
    pub fn peak(&self) -> f64 {
        self.pressure.iter().fold(0.0, |peak, &p| peak.max(p))
    }

    /// Returns the pressure at x, linear between the nodes.
    pub fn at(&self, x: f64) -> f64 {
        let right = self.x.partition_point(|&node| node < x).clamp(1, self.x.len() - 1);
        let [from, to] = [self.x[right - 1], self.x[right]];
        let share = (x - from) / (to - from);
        self.pressure[right - 1] * (1.0 - share) + self.pressure[right] * share
    }

    /// Returns the length of the longest cell next to x.
    pub fn cell(&self, x: f64) -> f64 {
        let right = self.x.partition_point(|&node| node < x).clamp(2, self.x.len() - 2);
        let cells = self.x[right - 2..=right + 1].windows(2).map(|cell| cell[1] - cell[0]);
        cells.fold(0.0, f64::max)
    }

    /// Returns a limit on which these contacts and the oracle disagree (missing in one of the two),
    /// with the distance that would pass; `None` if they agree. Gaps and contacts too narrow for
    /// the cells are not judged.
    pub fn disagreement(&self, contacts: &[Interval<f64>]) -> Option<[f64; 2]> {
        let found = sides(contacts);
        let known = sides(&self.contacts);
        let errors: Vec<f64> = self.errors.iter().flatten().copied().collect();
        let narrow = |limits: &[f64], i: usize, error: f64| {
            let beside = [i.checked_sub(1), Some(i + 1)].into_iter().flatten();
            let mut beside = beside.filter_map(|i| limits.get(i));
            beside.any(|other| (other - limits[i]).abs() <= error)
        };
        for (i, &x) in found.iter().enumerate() {
            let near = |j: usize| (known[j] - x).abs() <= errors[j];
            let [left, right] = [found[i & !1], found[i | 1]];
            let error = 4.0 * self.cell(x) + 3e-4 * (right - left);
            if !(i % 2..known.len()).step_by(2).any(near) && !narrow(&found, i, error) {
                return Some([x, error]);
            }
        }
        for (j, &x) in known.iter().enumerate() {
            let near = |i: usize| (found[i] - x).abs() <= errors[j];
            if !(j % 2..found.len()).step_by(2).any(near) && !narrow(&known, j, errors[j]) {
                return Some([x, errors[j]]);
            }
        }
        None
    }

    /// Returns the largest difference from the nodal pressures, as a share of the peak, and its
    /// place. Nodes near ends of contacts and kinks, where the cells are too long, are left out.
    pub fn pressure_off(&self, kinks: &[f64], at: impl Fn(f64) -> f64) -> [f64; 2] {
        let (peak, mut worst) = (self.peak(), [0.0, f64::NAN]);
        for (i, on) in self.contacts.iter().enumerate() {
            let [left, right] = self.errors[i];
            let inside = Interval { left: on.left + 4.0 * left, right: on.right - 4.0 * right };
            let ends = [self.x[0], self.x[self.x.len() - 1]];
            let margin = 0.02 * (on.right - on.left);
            for (&x, &pressure) in self.x.iter().zip(&self.pressure) {
                let kink = |&kink: &f64| (kink - x).abs() < margin;
                let corner = ends.iter().any(|&end| (end - x).abs() < margin);
                if inside.contains(x) && !kinks.iter().any(kink) && !corner {
                    let off = (at(x) - pressure).abs() / peak;
                    if off.is_nan() || off > worst[0] {
                        worst = [off, x];
                    }
                }
            }
        }
        worst
    }

    /// Returns the load per unit length.
    pub fn load(&self) -> f64 {
        self.load_in(Interval { left: self.x[0], right: self.x[self.x.len() - 1] })
    }

    /// Returns the load of the cells on an interval and next to it.
    pub fn load_in(&self, on: Interval<f64>) -> f64 {
        let is_in = |&i: &usize| self.x[i + 1] >= on.left && self.x[i] <= on.right;
        let cell = |i: usize| {
            0.5 * (self.x[i + 1] - self.x[i]) * (self.pressure[i] + self.pressure[i + 1])
        };
        (0..self.x.len() - 1).filter(is_in).map(cell).sum()
    }
}

/// Returns all limits, from left to right.
fn sides(contacts: &[Interval<f64>]) -> Vec<f64> {
    contacts.iter().flat_map(|on| [on.left, on.right]).collect()
}

/// Solves the contact of a gap `f₂(x) - f₁(x)` under a load; `None` if the active set does not
/// settle.
///
/// `nodes` are the places of kinks of the gap; the range ends the bodies.
pub fn solve(
    gap: &dyn Fn(f64) -> f64,
    kappa: f64,
    load: f64,
    range: [f64; 2],
    kinks: &[f64],
) -> Option<Oracle> {
    let [from, to] = range;
    let mut x: Vec<f64> =
        (0..=CELLS).map(|i| from + (to - from) * i as f64 / CELLS as f64).collect();
    x.extend(kinks.iter().copied().filter(|&x| x > from && x < to));
    x.sort_by(f64::total_cmp);
    x.dedup_by(|b, a| *b - *a < 1e-9 * (to - from));
    x[0] = from;
    let mut on = vec![true; x.len()];
    let mut halved = 0;
    loop {
        let height: Vec<f64> = x.iter().map(|&x| kappa * gap(x)).collect();
        let found = active_set(&x, &height, load, &mut on)?;
        let shortest = (to - from) * 0.5f64.powi(28);
        let split = cells_to_halve(&x, &on, &found, kinks, shortest);
        if !split.contains(&true) || x.len() > NODES || halved == HALVINGS {
            return Some(finished(&x, &on, found, kappa));
        }
        halved += 1;
        let (mut finer, mut flags) = (Vec::new(), Vec::new());
        for i in 0..x.len() {
            finer.push(x[i]);
            flags.push(on[i]);
            if i + 1 < x.len() && split[i] {
                finer.push(0.5 * (x[i] + x[i + 1]));
                flags.push(on[i] && on[i + 1]);
            }
        }
        (x, on) = (finer, flags);
    }
}

/// Pressures, κ times the gap of the loaded bodies, and the approach subtracted from it.
struct Found {
    pressure: Vec<f64>,
    gap: Vec<f64>,
    approach: f64,
}

fn active_set(x: &[f64], height: &[f64], load: f64, on: &mut [bool]) -> Option<Found> {
    let n = x.len();
    let matrix: Vec<f64> = x.iter().flat_map(|&at| influences(x, at)).collect();
    let weight = |j: usize| {
        let left = if j > 0 { x[j] - x[j - 1] } else { 0.0 };
        let right = if j + 1 < n { x[j + 1] - x[j] } else { 0.0 };
        0.5 * (left + right)
    };
    for round in 0..400 {
        let active: Vec<usize> = (0..n).filter(|&i| on[i]).collect();
        let m = active.len();
        let mut system = vec![0.0; (m + 1) * (m + 2)];
        for (row, &i) in active.iter().enumerate() {
            let line = &mut system[row * (m + 2)..(row + 1) * (m + 2)];
            for (column, &j) in active.iter().enumerate() {
                line[column] = matrix[i * n + j];
            }
            (line[m], line[m + 1]) = (-1.0, -height[i]);
        }
        let line = &mut system[m * (m + 2)..];
        for (column, &j) in active.iter().enumerate() {
            line[column] = weight(j);
        }
        (line[m], line[m + 1]) = (0.0, load);
        let solution = gauss(&mut system, m + 1)?;
        let approach = solution[m];
        let mut pressure = vec![0.0; n];
        for (&i, &p) in active.iter().zip(&solution) {
            pressure[i] = p;
        }
        let gap: Vec<f64> = (0..n)
            .map(|i| {
                if on[i] {
                    return 0.0;
                }
                let pressed: f64 = active.iter().map(|&j| matrix[i * n + j] * pressure[j]).sum();
                height[i] + pressed - approach
            })
            .collect();
        let wrong: Vec<usize> =
            (0..n).filter(|&i| if on[i] { pressure[i] < 0.0 } else { gap[i] < 0.0 }).collect();
        if wrong.is_empty() {
            return Some(Found { pressure, gap, approach });
        }
        if round < 40 {
            wrong.iter().for_each(|&i| on[i] = !on[i]);
        } else {
            // The set may cycle: from now on only the worst node changes.
            let most = |of: &[f64]| of.iter().fold(f64::MIN_POSITIVE, |most, v| most.max(v.abs()));
            let (peak, open) = (most(&pressure), most(&gap));
            let share = |i: usize| if on[i] { -pressure[i] / peak } else { -gap[i] / open };
            let worst = wrong.into_iter().max_by(|&i, &j| share(i).total_cmp(&share(j)))?;
            on[worst] = !on[worst];
        }
    }
    None
}

/// Returns, for all nodes, `-∫ ln|x - s| ds` over the pressure that is one at the node, zero at its
/// neighbours and linear between them.
fn influences(nodes: &[f64], x: f64) -> Vec<f64> {
    // Antiderivatives of ln|u| and of u ln|u|.
    let antiderivatives = |&node: &f64| {
        let u = node - x;
        let log = if u == 0.0 { 0.0 } else { u.abs().ln() };
        [u * log - u, 0.5 * u * u * log - 0.25 * u * u]
    };
    let known: Vec<[f64; 2]> = nodes.iter().map(antiderivatives).collect();
    let mut influence = vec![0.0; nodes.len()];
    for i in 0..nodes.len() - 1 {
        let [from, to] = [nodes[i] - x, nodes[i + 1] - x];
        let (h, middle) = (to - from, 0.5 * (from + to));
        // Integrals over the parts that fall from one to zero, and that rise to one.
        let [falls, rises] = if middle.abs() > 300.0 * h {
            // The antiderivatives would cancel; the Gauss-Legendre rule with three points is
            // accurate.
            let root = 0.6f64.sqrt();
            let at = [(-root, 5.0 / 18.0), (0.0, 8.0 / 18.0), (root, 5.0 / 18.0)];
            at.into_iter().fold([0.0; 2], |[falls, rises], (z, w)| {
                let log = h * w * (middle + 0.5 * h * z).abs().ln();
                [falls + log * 0.5 * (1.0 - z), rises + log * 0.5 * (1.0 + z)]
            })
        } else {
            let [zeroth, first] = [0, 1].map(|k| known[i + 1][k] - known[i][k]);
            [(to * zeroth - first) / h, (first - from * zeroth) / h]
        };
        influence[i] -= falls;
        influence[i + 1] -= rises;
    }
    influence
}

/// Solves n equations with one right-hand side by Gaussian elimination with column pivoting.
fn gauss(system: &mut [f64], n: usize) -> Option<Vec<f64>> {
    let width = n + 1;
    for column in 0..n {
        let size = |row: &usize| system[row * width + column].abs();
        let pivot = (column..n).max_by(|a, b| size(a).total_cmp(&size(b)))?;
        if size(&pivot) == 0.0 {
            return None;
        }
        if pivot != column {
            let (above, below) = system.split_at_mut(pivot * width);
            above[column * width..(column + 1) * width].swap_with_slice(&mut below[..width]);
        }
        let (above, below) = system.split_at_mut((column + 1) * width);
        let line = &above[column * width..];
        for row in below.chunks_exact_mut(width) {
            let factor = row[column] / line[column];
            if factor != 0.0 {
                for (value, &from) in row[column..].iter_mut().zip(&line[column..]) {
                    *value -= factor * from;
                }
            }
        }
    }
    let mut solution = vec![0.0; n];
    for row in (0..n).rev() {
        let line = &system[row * width..(row + 1) * width];
        let known: f64 = (row + 1..n).map(|j| line[j] * solution[j]).sum();
        solution[row] = (line[n] - known) / line[row];
    }
    solution.iter().all(|value| value.is_finite()).then_some(solution)
}

/// Returns the first and last node of each run of nodes in contact.
fn runs(on: &[bool]) -> Vec<[usize; 2]> {
    let mut runs: Vec<[usize; 2]> = Vec::new();
    for i in (0..on.len()).filter(|&i| on[i]) {
        match runs.last_mut() {
            Some(run) if run[1] + 1 == i => run[1] = i,
            _ => runs.push([i, i]),
        }
    }
    runs
}

fn cells_to_halve(
    x: &[f64],
    on: &[bool],
    found: &Found,
    kinks: &[f64],
    shortest: f64,
) -> Vec<bool> {
    let last = x.len() - 1;
    let mut split = vec![false; last];
    let mut ask = |from: usize, to: usize, share: f64| {
        for i in from..to.min(last) {
            split[i] |= x[i + 1] - x[i] > shortest.max(share);
        }
    };
    let runs = runs(on);
    for &[from, to] in &runs {
        let width = x[(to + 1).min(last)] - x[from.saturating_sub(1)];
        if to - from < FEWEST {
            ask(from.saturating_sub(1), to + 1, 0.0);
        }
        // Cells next to an end get as short as 3e-4 of the contact; at a corner the pressure is
        // infinite.
        for end in [from, to + 1] {
            let share = if end == 0 || end > last { 1e-4 } else { 3e-4 };
            ask(end.saturating_sub(BESIDE), end + BESIDE, share * width);
        }
    }
    for &kink in kinks {
        // The pressure is logarithmic at a kink.
        let node = x.partition_point(|&x| x < kink);
        if let Some([from, to]) = runs.iter().find(|run| run[0] <= node && node <= run[1]) {
            ask(node.saturating_sub(BESIDE), node + BESIDE, 1e-3 * (x[*to] - x[*from]));
        }
    }
    let peak = found.pressure.iter().fold(0.0f64, |peak, &p| peak.max(p));
    for &[from, to] in &runs {
        let pressure = &found.pressure;
        for i in from + 1..to {
            // Linear interpolation errs by an eighth of the second difference between nodes.
            let chord = pressure[i - 1] - 2.0 * pressure[i] + pressure[i + 1];
            if chord.abs() > BEND * peak {
                ask(i - 1, i + 1, 2e-3 * (x[to] - x[from]));
            }
        }
    }
    for pair in runs.windows(2) {
        // A gap of few cells.
        let [from, to] = [pair[0][1], pair[1][0]];
        if to - from < 8 {
            ask(from, to, 1e-3 * (x[pair[1][1]] - x[pair[0][0]]));
        }
    }
    for i in 1..last {
        let (gap, least) = (&found.gap, found.gap[i]);
        if !on[i] && least <= gap[i - 1] && least <= gap[i + 1] {
            // Between nodes the gap may be lower by about an eighth of the second difference.
            let bend = gap[i - 1] - 2.0 * least + gap[i + 1];
            if least < bend {
                ask(i - 1, i + 1, 0.0);
            }
        }
    }
    split
}

fn finished(x: &[f64], on: &[bool], found: Found, kappa: f64) -> Oracle {
    let last = x.len() - 1;
    let (mut contacts, mut errors) = (Vec::new(), Vec::new());
    for [from, to] in runs(on) {
        // The square of the pressure falls linearly towards the limit, which locates the limit in
        // the last cell.
        let end = |edge: usize, inside: usize, outside: Option<usize>| {
            let Some(outside) = outside else { return [x[edge], 0.0] };
            // One cell, and the error that the shape of the pressure leaves in all others.
            let error = 2.0 * (x[outside] - x[edge]).abs() + 3e-4 * (x[to] - x[from]);
            let [low, high] = [edge, inside].map(|i| found.pressure[i].powi(2));
            let fall = (high - low) / (x[inside] - x[edge]);
            let on = (x[edge] - low / fall).clamp(x[edge].min(x[outside]), x[edge].max(x[outside]));
            [if on.is_finite() { on } else { 0.5 * (x[edge] + x[outside]) }, error]
        };
        let left = end(from, (from + 1).min(to), from.checked_sub(1));
        let right = end(to, to.saturating_sub(1).max(from), (to < last).then_some(to + 1));
        contacts.push(Interval { left: left[0], right: right[0] });
        errors.push([left[1], right[1]]);
    }
    let gap = found.gap.iter().map(|gap| gap / kappa).collect();
    let (x, pressure) = (x.to_vec(), found.pressure);
    Oracle { contacts, errors, approach: found.approach, x, pressure, gap }
}

/// Returns the height of a body at x.
pub fn height(body: &dyn ParametricProfile<f64>, x: f64) -> f64 {
    // Continues linearly past the nearer end, as far as k is rounded.
    let at = point(body, x);
    if at.dx == 0.0 { at.y } else { at.y + at.dy / at.dx * (x - at.x) }
}

/// Returns the point of a body at x, by bisection of `X(k) = x` on the piece that holds x.
pub fn point(body: &dyn ParametricProfile<f64>, x: f64) -> CurvePoint<f64> {
    let on = |curve: &dyn ParametricProfile<f64>, [mut lo, mut hi]: [f64; 2]| {
        let rising = curve.x(lo) < curve.x(hi);
        for _ in 0..200 {
            let k = 0.5 * (lo + hi);
            if k <= lo.min(hi) || k >= lo.max(hi) {
                break;
            }
            if (curve.x(k) < x) == rising { lo = k } else { hi = k }
        }
        curve.at(lo)
    };
    match body.pieces() {
        0 => on(body, body.domain()),
        count => {
            // First piece that does not end before x.
            let (mut first, mut last) = (0, count - 1);
            while first < last {
                let middle = (first + last) / 2;
                let ends = body.piece(middle).map_or(f64::NAN, |piece| piece.ends[1].x);
                if x <= ends { last = middle } else { first = middle + 1 }
            }
            let piece = body.piece(first).expect("counted");
            on(piece.curve, piece.k)
        }
    }
}
