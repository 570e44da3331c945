//! Rough contacts of two bodies, from heights alone: a coarse active set.
//!
//! The bodies are cut into cells of constant pressure. A cell is *loaded*, and the gap in it is
//! closed; or it is *open*, and bears nothing. With the force q on each cell and K the potential of
//! a unit force in one cell, averaged over another,
//!
//! ```text
//! κ h_i + Σ_j K_ij q_j = δ,   q_i ≥ 0    in loaded cells
//! κ h_i + Σ_j K_ij q_j ≥ δ,   q_i = 0    in open ones,      Σ q_i = F
//! ```
//!
//! If the load acts at a given place x̄, the bodies turn: `h_i + τ (x_i - x̄)` takes the place of
//! `h_i`, and `Σ q_i (x_i - x̄) = 0` is one more condition. Cells in tension are opened and cells
//! that overlap are loaded, all at once, until none is left (Hintermüller, Ito and Kunisch, *SIAM
//! J. Optim.* 13, 2002, 865). If this makes no progress, they change one at a time, which must end
//! (Júdice and Pires, *Comput. Oper. Res.* 21, 1994, 587). Then cells are cut in three where the
//! contact is not yet resolved: their number grows with the logarithm of its smallness. The runs of
//! loaded cells are the contacts.

mod balance;
mod forces;
mod marks;
mod potential;

use crate::numerics::dot;
use crate::{ContactError, Ends, Interval, Real};
use forces::{line, sum};
use potential::{CellPlace, Potential};
use std::cmp::Ordering::Equal;

/// Number of cells at first; twice as many after a failed check may resolve more.
pub(super) const FIRST_CELLS: usize = 33;

/// Number of cells above which none is cut any more.
const MAX_CELLS: usize = 6000;

/// Largest number of rounds of cuts: enough for a contact of 1e-16 of the bodies.
const MAX_CUTS: usize = 48;

/// Least number of loaded cells in a run of [`FIRST_CELLS`], which rises with their number; the
/// cells of shorter runs are cut.
const CELLS_OF_A_RUN: usize = 4;

/// Mean depth of the gap of a round contact below the level of its edges, in units of F/κ: two
/// thirds of `κ h(L)/F`, which is one.
const ABOVE: f64 = 2.0 / 3.0;

/// Updates of the set of loaded cells before the search is given up.
const MAX_CHANGES: usize = 400;

/// Full updates without progress before switching to one cell at a time.
const MAX_IN_VAIN: usize = 4;

/// Largest sum of cells times steps over all linear systems of a search: half a minute at worst.
const MAX_WORK: usize = 200_000_000;

/// Two bodies and a load.
pub(super) struct Scene<'s, T> {
    pub kappa: T,
    pub load: T,
    /// Place where the load acts, if the bodies turn.
    pub at: Option<T>,
    /// Range that both bodies cover, up to their corners.
    pub range: [T; 2],
    /// Number of cells at first, such as [`FIRST_CELLS`].
    pub cells: usize,
    /// Known heights of the gap, `[x, h]` by rising x; may be empty.
    pub known: &'s [[T; 2]],
    /// Last contacts; may be empty.
    pub start: &'s [Interval<T>],
}

/// Contacts, to some per cent of each width.
#[derive(Clone, Debug)]
pub(super) struct Coarse<T> {
    /// Contacts, from left to right.
    pub intervals: Vec<Interval<T>>,
    /// Angle by which body 2 is turned counter-clockwise.
    pub tilt: T,
    /// Flags: the contact reaches this end of the range.
    pub reaches: Ends<bool>,
}

/// Reason why no contact is found.
#[derive(Debug, PartialEq)]
pub(super) enum NotFound<T: Real> {
    /// Error of a height that cannot be computed.
    Height(ContactError<T>),
    /// Height that is not finite.
    NotFinite { x: T, height: T },
    /// Empty range, or a load or κ that is not positive and finite.
    Scene { kappa: T, load: T, range: [T; 2] },
    /// Set of loaded cells that does not converge.
    Unsettled { solves: usize },
}

type Height<'h, T> = &'h mut dyn FnMut(T) -> Result<T, ContactError<T>>;

/// Finds the contacts of a scene from the height of the gap at any x of the range; adds to the
/// `work` of the search.
pub(super) fn active_set<T: Real>(
    scene: &Scene<'_, T>,
    work: &mut usize,
    height: Height<'_, T>,
) -> Result<Coarse<T>, NotFound<T>> {
    let mut set = ActiveSet { work: *work, ..ActiveSet::new(scene, height)? };
    let settled = set.settle(scene, height);
    *work = set.work;
    settled.map(|()| set.found())
}

#[derive(Clone, Copy)]
struct Cell<T> {
    left: T,
    right: T,
    height: T,
    /// Force as a share of the load.
    force: T,
    loaded: bool,
    /// Number of the cell before cells were cut; `None` for a new one.
    number: Option<usize>,
}

impl<T: Real> Cell<T> {
    fn centre(&self) -> T {
        T::of(0.5) * self.left + T::of(0.5) * self.right
    }

    fn width(&self) -> T {
        self.right - self.left
    }

    fn pressure(&self) -> T {
        self.force / self.width()
    }
}

struct ActiveSet<T> {
    cells: Vec<Cell<T>>,
    range: [T; 2],
    kappa: T,
    load: T,
    at: Option<T>,
    /// Least number of loaded cells in a run.
    cells_of_a_run: usize,
    /// Rise κ h/F above the lowest cell, and the potential.
    rise: Vec<T>,
    potential: Vec<T>,
    matrix: Potential<T>,
    /// Sum of rise and potential in loaded cells: a level, and a slope about the place of the load.
    level: T,
    slope: T,
    /// True if cells were cut since rise and potential were computed.
    changed: bool,
    /// Number of linear systems solved.
    solves: usize,
    work: usize,
}

impl<T: Real> ActiveSet<T> {
    /// Loads the cells in which the bodies touch, cut as finely as needed to resolve the contacts.
    fn settle(&mut self, scene: &Scene<'_, T>, height: Height<'_, T>) -> Result<(), NotFound<T>> {
        self.take_up(scene.start, height)?;
        for _ in 0..MAX_CUTS {
            self.converge()?;
            let (marks, intervals) = (self.marks(scene.known), self.intervals());
            if !self.cut(&marks, &intervals, height)? {
                break;
            }
        }
        if self.changed { self.converge() } else { Ok(()) }
    }

    fn new(scene: &Scene<'_, T>, height: Height<'_, T>) -> Result<Self, NotFound<T>> {
        let Scene { kappa, load, at, range, cells, .. } = *scene;
        let [kappa, load] = [kappa, load].map(|value| value.component(0));
        let at = at.map(|at| at.component(0));
        let range = range.map(|end| end.component(0));
        let width = range[1] - range[0];
        let positive = |value: T| value > T::zero() && value.is_finite();
        if !([kappa, load, width].into_iter().all(positive)
            && range[0].is_finite()
            && range[1].is_finite())
        {
            return Err(NotFound::Scene { kappa, load, range });
        }
        let mut set = Self {
            cells: Vec::new(),
            range,
            kappa,
            load,
            at,
            cells_of_a_run: CELLS_OF_A_RUN * (cells / FIRST_CELLS).max(1),
            rise: Vec::new(),
            potential: Vec::new(),
            matrix: Potential::new(),
            level: T::zero(),
            slope: T::zero(),
            changed: true,
            solves: 0,
            work: 0,
        };
        let mut left = range[0];
        let cells = cells.clamp(1, MAX_CELLS);
        for i in 1..=cells {
            let share = T::count(i) / T::count(cells);
            let right = if i == cells { range[1] } else { range[0] + share * width };
            // A range of a few units in the last place has room for fewer cells.
            if right > left {
                set.add([left, right], None, height)?;
                left = right;
            }
        }
        // Cells are needed on both sides of the place where the load acts.
        while let (Some(_), Some(last)) = (at, set.cells.len().checked_sub(1)) {
            let [left, right] = [0, last].map(|i| set.arm(set.cells[i].centre()) > T::zero());
            let marks: Vec<_> = (0..=last).map(|i| i == 0 && left || i == last && !right).collect();
            if !set.cut(&marks, &[], height)? {
                break;
            }
        }
        set.rest();
        Ok(set)
    }

    fn lowest(&self) -> Option<usize> {
        let by_height = |&i: &usize, &j: &usize| {
            let [one, other] = [i, j].map(|i| self.cells[i].height);
            one.partial_cmp(&other).unwrap_or(Equal)
        };
        (0..self.cells.len()).min_by(by_height)
    }

    /// Returns the distance to the right of the place of the load, as a share of the range.
    fn arm(&self, x: T) -> T {
        self.at.map_or(T::zero(), |at| (x - at) / (self.range[1] - self.range[0]))
    }

    /// Loads cells to start with, as if each yielded independently: those below a line on which the
    /// load acts at its place. The level of the line by [`ABOVE`] is right for one round contact.
    fn rest(&mut self) {
        let lowest = self.lowest().map_or(T::zero(), |lowest| self.cells[lowest].height);
        let arms: Vec<T> = self.cells.iter().map(|cell| self.arm(cell.centre())).collect();
        let rises = self.cells.iter().map(|cell| self.rise_of(cell.height, lowest));
        let rises: Vec<T> = rises.collect();
        let [first, second] = self.supports(&arms);
        let mut loaded: Vec<usize> = (0..arms.len()).collect();
        for _ in 0..MAX_CHANGES {
            let [on, above]: [Vec<T>; 2] =
                [&arms, &rises].map(|of| loaded.iter().map(|&i| of[i]).collect());
            let runs = 1 + loaded.windows(2).filter(|pair| pair[0] + 1 < pair[1]).count();
            let excess = T::of(ABOVE) * T::count(loaded.len()) / T::count(runs);
            let [level, slope] = line(&on, [sum(&above) + excess, dot(&on, &above)]);
            let is_below =
                |i: usize| rises[i] < level + slope * arms[i] || i == first || i == second;
            let next: Vec<_> = (0..arms.len()).filter(|&i| is_below(i)).collect();
            if next == loaded {
                break;
            }
            loaded = next;
        }
        self.cells.iter_mut().for_each(|cell| cell.loaded = false);
        loaded.iter().for_each(|&i| self.cells[i].loaded = true);
    }

    /// Returns the cells that rigid bodies would rest on: the lowest one, or the pair whose
    /// connecting line is lowest where the load acts.
    fn supports(&self, arms: &[T]) -> [usize; 2] {
        let middle = arms.partition_point(|&arm| arm <= T::zero());
        let line = |&[i, j]: &[usize; 2]| {
            let share = arms[i] / (arms[i] - arms[j]);
            self.cells[i].height + share * (self.cells[j].height - self.cells[i].height)
        };
        let pairs = (0..middle).flat_map(|i| (middle..arms.len()).map(move |j| [i, j]));
        let by_line = |one: &_, other: &_| line(one).partial_cmp(&line(other)).unwrap_or(Equal);
        let lowest = self.lowest().unwrap_or(0);
        pairs.min_by(by_line).unwrap_or([lowest; 2])
    }

    /// Tells whether there are loaded cells whose forces can act where they have to.
    fn bears(&self) -> bool {
        let arms = || {
            let loaded = self.cells.iter().filter(|cell| cell.loaded);
            loaded.map(|cell| self.arm(cell.centre()))
        };
        let turns = self.at.is_some();
        arms().any(|arm| arm <= T::zero()) && (!turns || arms().any(|arm| arm > T::zero()))
    }

    /// Returns the gap in a cell, as a multiple of F/κ.
    fn gap(&self, i: usize) -> T {
        let aside = self.slope * self.arm(self.cells[i].centre());
        self.rise[i] + self.potential[i] - self.level - aside
    }

    fn add(
        &mut self,
        [left, right]: [T; 2],
        known: Option<T>,
        height: Height<'_, T>,
    ) -> Result<&mut Cell<T>, NotFound<T>> {
        let (force, loaded, number) = (T::zero(), false, None);
        let mut cell = Cell { left, right, height: T::zero(), force, loaded, number };
        cell.height = match known {
            Some(height) => height,
            None => {
                let x = cell.centre();
                let height = height(x).map_err(NotFound::Height)?.component(0);
                if !height.is_finite() {
                    return Err(NotFound::NotFinite { x, height });
                }
                height
            }
        };
        let number = self.cells.len();
        self.cells.push(cell);
        Ok(&mut self.cells[number])
    }

    /// Cuts the marked cells in three, and loads the parts that lie in intervals. Tells whether any
    /// cell was cut.
    fn cut(
        &mut self,
        marks: &[bool],
        intervals: &[Interval<T>],
        height: Height<'_, T>,
    ) -> Result<bool, NotFound<T>> {
        let room = MAX_CELLS.saturating_sub(self.cells.len()) / 2;
        let cells = std::mem::take(&mut self.cells);
        let mut cut = 0;
        for (cell, &mark) in cells.iter().zip(marks) {
            let Cell { left, right, height: middle, force, .. } = *cell;
            let third = cell.width() / T::of(3.0);
            // The centre stays in place.
            let [from, to] = [left + third, right - third];
            let finest = T::of(64.0) * T::epsilon() * left.abs().max(right.abs());
            if !mark || cut >= room || cell.width() <= finest || from >= to {
                self.cells.push(*cell);
                continue;
            }
            cut += 1;
            let thirds = [([left, from], None), ([from, to], Some(middle)), ([to, right], None)];
            for (ends, known) in thirds {
                let third = self.add(ends, known, height)?;
                let x = third.centre();
                let first = intervals.partition_point(|on| on.right <= x);
                if intervals.get(first).is_some_and(|on| on.contains(x)) {
                    (third.loaded, third.force) = (true, force / T::of(3.0));
                }
            }
        }
        self.changed |= cut > 0;
        Ok(cut > 0)
    }

    /// Returns the rise κ h/F above the lowest cell.
    fn rise_of(&self, height: T, lowest: T) -> T {
        (height - lowest) / self.load * self.kappa
    }

    /// Cuts and loads the cells in the contacts found last.
    fn take_up(&mut self, start: &[Interval<T>], height: Height<'_, T>) -> Result<(), NotFound<T>> {
        let start: Vec<_> = start.iter().map(Interval::plain).collect();
        let touched = |cell: &Cell<T>| {
            let first = start.partition_point(|on| on.right <= cell.left);
            start.get(first).copied().filter(|on| on.left < cell.right)
        };
        for _ in 0..MAX_CUTS {
            let wide = |cell: &Cell<T>| {
                let sixth = |on: Interval<T>| on.half_width() / T::count(self.cells_of_a_run / 2);
                touched(cell).is_some_and(|on| cell.width() > sixth(on))
            };
            let marks: Vec<_> = self.cells.iter().map(wide).collect();
            if !self.cut(&marks, &[], height)? {
                break;
            }
        }
        let inside = |cell: &Cell<T>| touched(cell).is_some_and(|on| on.contains(cell.centre()));
        if self.cells.iter().any(inside) {
            for cell in &mut self.cells {
                cell.loaded = inside(cell);
            }
        }
        Ok(())
    }

    /// Prepares the matrix and the rises for cells that were cut.
    fn prepare(&mut self) {
        let [left, right] = self.range;
        let place = |cell: &Cell<T>| CellPlace {
            centre: (cell.centre() - left) / (right - left),
            width: cell.width() / (right - left),
        };
        let before: Vec<_> = self.cells.iter().map(|cell| cell.number).collect();
        let places = self.cells.iter().map(place).collect();
        self.matrix.set(places, &before, |j| self.cells[j].loaded);
        for (i, cell) in self.cells.iter_mut().enumerate() {
            cell.number = Some(i);
        }
        let lowest = self.lowest().map_or(T::zero(), |lowest| self.cells[lowest].height);
        // Beyond this rise the height of a cell no longer matters.
        let highest = T::epsilon().recip().powi(4);
        let rise = |cell: &Cell<T>| self.rise_of(cell.height, lowest).min(highest);
        self.rise = self.cells.iter().map(rise).collect();
        self.changed = false;
    }

    /// Changes the set of loaded cells until none is in tension and none overlaps, except next to a
    /// run of enough cells.
    fn converge(&mut self) -> Result<(), NotFound<T>> {
        if self.changed {
            self.prepare();
        }
        let (mut least, mut in_vain) = (usize::MAX, 0);
        for _ in 0..MAX_CHANGES {
            if !self.bears() {
                self.rest();
            }
            if !self.bears() || self.work > MAX_WORK {
                break;
            }
            let rounding = self.solve();
            let wrong: Vec<_> = (0..self.cells.len())
                .filter(|&i| {
                    let Cell { loaded, force, .. } = self.cells[i];
                    if loaded { force < -rounding } else { self.gap(i) < -rounding }
                })
                .collect();
            let runs = self.runs();
            // If only cells next to long enough runs are wrong, the limits are known.
            let is_limit = |&i: &usize| {
                let next = runs.partition_point(|run| run[1] + 1 < i);
                let beside = |&[from, to]: &[usize; 2]| i + 1 == from || i == to + 1;
                let some = |[from, to]: &[usize; 2]| 2 * (to - from + 1) >= CELLS_OF_A_RUN;
                runs[next..].iter().take(2).any(|run| beside(run) && some(run))
            };
            if wrong.iter().all(is_limit) {
                return Ok(());
            }
            in_vain = if wrong.len() < least { 0 } else { in_vain + 1 };
            least = least.min(wrong.len());
            let all = if in_vain <= MAX_IN_VAIN { 0 } else { wrong.len() - 1 };
            for &i in &wrong[all..] {
                let cell = &mut self.cells[i];
                cell.loaded = !cell.loaded;
                cell.force = T::zero();
            }
        }
        Err(NotFound::Unsettled { solves: self.solves })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Side;
    use crate::SolveError;
    use std::f64::consts::{FRAC_PI_2, PI};

    fn scene(load: f64, range: [f64; 2]) -> Scene<'static, f64> {
        let cells = FIRST_CELLS;
        Scene { kappa: FRAC_PI_2, load, at: None, range, cells, known: &[], start: &[] }
    }

    fn set(
        scene: &Scene<'_, f64>,
        h: impl Fn(f64) -> f64,
    ) -> Result<ActiveSet<f64>, NotFound<f64>> {
        let mut set = ActiveSet::new(scene, &mut |x| Ok(h(x)))?;
        set.settle(scene, &mut |x| Ok(h(x))).map(|()| set)
    }

    fn find(scene: &Scene<'_, f64>, h: impl Fn(f64) -> f64) -> Result<Coarse<f64>, NotFound<f64>> {
        Ok(set(scene, h)?.found())
    }

    /// Returns the contacts found on many equal cells.
    fn even(scene: &Scene<'_, f64>, cells: usize, h: impl Fn(f64) -> f64) -> Coarse<f64> {
        let scene = Scene { cells, known: &[], start: &[], ..*scene };
        let mut set = ActiveSet::new(&scene, &mut |x| Ok(h(x))).unwrap();
        set.converge().unwrap();
        set.found()
    }

    fn heights(n: usize, [from, to]: [f64; 2], h: impl Fn(f64) -> f64) -> Vec<[f64; 2]> {
        let x = |i| from + (to - from) * f64::from(i) / (n - 1) as f64;
        (0..n as i32).map(|i| [x(i), h(x(i))]).collect()
    }

    /// A load needs a loaded cell, even if the bodies do not turn.
    #[test]
    fn no_cell_bears_no_load() {
        let mut set = set(&scene(0.1, [-2.0, 2.0]), |x| 0.5 * x * x).unwrap();
        assert!(set.bears());
        set.cells.iter_mut().for_each(|cell| cell.loaded = false);
        assert!(!set.bears());
    }

    /// Returns the largest error of the limits, as a share of the width.
    fn off(on: Interval<f64>, exact: Interval<f64>) -> f64 {
        let width = exact.right - exact.left;
        (on.left - exact.left).abs().max((on.right - exact.right).abs()) / width
    }

    struct Random(u64);

    impl Random {
        fn unit(&mut self) -> f64 {
            self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            let x = (self.0 ^ (self.0 >> 29)).wrapping_mul(0xbf58476d1ce4e5b9);
            ((x ^ (x >> 32)) >> 11) as f64 / (1u64 << 53) as f64
        }

        fn within(&mut self, from: f64, to: f64) -> f64 {
            from + (to - from) * self.unit()
        }

        fn normal(&mut self) -> f64 {
            (-2.0 * (1.0 - self.unit()).ln()).sqrt() * (2.0 * PI * self.unit()).cos()
        }

        /// Returns one wave, or twelve of any length: amplitude, wave number, phase.
        fn waves(&mut self, one: bool) -> Vec<[f64; 3]> {
            if one {
                let (steep, length) = (10f64.powf(self.within(-1.7, 0.5)), self.within(0.15, 0.8));
                return vec![[
                    steep * length * length,
                    2.0 * PI / length,
                    self.within(0.0, 2.0 * PI),
                ]];
            }
            let size = 0.8 * 10f64.powf(self.within(-0.3, 1.2));
            let mut wave = |_| {
                let k = self.within(3.0, 25.0);
                [size * self.normal() / k / k, k, self.within(0.0, 2.0 * PI)]
            };
            (0..12).map(&mut wave).collect()
        }
    }

    fn wavy(waves: &[[f64; 3]], x: f64) -> f64 {
        waves.iter().map(|[a, k, phase]| a * (k * x + phase).cos()).sum()
    }

    #[test]
    fn hertz_under_any_load() {
        let mut random = Random(3);
        let mut all = Vec::new();
        for i in 0..=100 {
            let (load, c) = (10f64.powf(f64::from(i) * 0.137 - 14.0), random.within(-0.7, 0.7));
            let set = set(&scene(load, [-2.0, 2.0]), |x| (x - c).powi(2) / 2.0).unwrap();
            let found = set.found();
            let half = (4.0 * load / PI).sqrt();
            let &[on] = found.intervals.as_slice() else { panic!("{load}: {found:?}") };
            all.push(off(on, Interval { left: c - half, right: c + half }));
            assert!(set.cells.len() <= 130 && found.reaches == Ends::both(false), "{found:?}");
        }
        all.sort_by(f64::total_cmp);
        assert!(all[50] < 0.015 && all[100] < 0.08, "{} {}", all[50], all[100]);
    }

    #[test]
    fn two_contacts_until_they_merge() {
        let h = |x: f64| x.powi(4) - 2.0 * x * x;
        for (load, allowed) in [(1e-8, 0.08), (0.1, 0.04), (1.0, 0.04), (3.0, 0.06), (3.3, 0.04)] {
            let found = find(&scene(load, [-3.0, 3.0]), h).unwrap();
            let d = (4.0f64 * load / PI).sqrt();
            let [inner, outer] =
                [1.0 - d / 2.0, 1.0 + d / 2.0].map(|square| square.max(0.0).sqrt());
            let exact = if load < PI {
                vec![[-outer, -inner], [inner, outer]]
            } else {
                // One contact: 3β⁴ - 4β² = 4F/π.
                let square = (2.0 + (4.0 + 12.0 * load / PI).sqrt()) / 3.0;
                vec![[-square.sqrt(), square.sqrt()]]
            };
            assert_eq!(found.intervals.len(), exact.len(), "{load}: {found:?}");
            for (&on, [left, right]) in found.intervals.iter().zip(exact) {
                assert!(off(on, Interval { left, right }) < allowed, "{load}: {found:?}");
            }
        }
    }

    #[test]
    fn random_bodies_as_on_fine_even_cells() {
        let mut random = Random(7);
        let (mut wrong, mut counted) = (0, Vec::new());
        for i in 0..200 {
            let waves = random.waves(i % 2 == 1);
            let h = |x: f64| x * x / 2.0 + wavy(&waves, x);
            let known = heights(64, [-2.0, 2.0], h);
            let load = 10f64.powf(random.within(-4.0, -0.3));
            let scene = Scene { known: &known, ..scene(load, [-2.0, 2.0]) };
            let set = set(&scene, h).unwrap();
            let found = set.found();
            counted.push(set.cells.len());
            let fine = even(&scene, 801, h);
            // The fine cells do not resolve the width of a run of few cells.
            let far = |(&on, &fine): (&Interval<f64>, &Interval<f64>)| {
                fine.half_width() > 0.05 && off(on, fine) > 0.12
            };
            wrong += usize::from(
                found.intervals.len() != fine.intervals.len()
                    || found.intervals.iter().zip(&fine.intervals).any(far),
            );
        }
        counted.sort_unstable();
        assert!(wrong <= 2, "{wrong} of 200");
        assert!(counted[100] <= 70 && counted[199] <= 250, "{counted:?}");
    }

    #[test]
    fn a_hundred_contacts() {
        let h = |x: f64| 0.05 * x * x - 1e-3 * (2.0 * PI * x / 0.03).cos();
        let known = heights(10_000, [-2.0, 2.0], h);
        let mut scene = Scene { known: &known, ..scene(0.1, [-2.0, 2.0]) };
        let first = set(&scene, h).unwrap();
        let found = first.found();
        let fine = even(&scene, 4001, h);
        assert_eq!(found.intervals.len(), fine.intervals.len());
        assert!(found.intervals.len() > 70 && first.cells.len() < 2000, "{found:?}");
        for (&on, &fine) in found.intervals.iter().zip(&fine.intervals) {
            assert!(off(on, fine) < 0.12, "{on:?} {fine:?}");
        }
        // Under a little more load, contacts are born and none dies.
        (scene.start, scene.load) = (&found.intervals, 0.11);
        let more = find(&scene, h).unwrap();
        assert!(more.intervals.len() >= found.intervals.len());
        let fine = even(&scene, 4001, h);
        assert_eq!(more.intervals.len(), fine.intervals.len());
    }

    #[test]
    fn corners_hold_the_ends() {
        for (a, k, phase, load, n, reaches) in [
            (0.02, 7.0, 0.4, 0.05, 3, Ends { left: true, right: false }),
            (0.02, 7.0, 0.0, 0.08, 3, Ends::both(true)),
            (0.02, 4.2, 2.9, 0.05, 2, Ends::both(true)),
            (0.02, 7.0, 3.5, 0.002, 1, Ends::both(false)),
        ] {
            let h = |x: f64| -a * (k * x + phase).cos() + 0.02 * x;
            let scene = scene(load, [-1.0, 1.0]);
            let (found, fine) = (find(&scene, h).unwrap(), even(&scene, 1001, h));
            assert_eq!(fine.reaches, found.reaches, "{found:?} {fine:?}");
            assert_eq!((n, reaches), (fine.intervals.len(), fine.reaches), "{fine:?}");
            for (&on, &fine) in found.intervals.iter().zip(&fine.intervals) {
                assert!(off(on, fine) < 0.12, "{on:?} {fine:?}");
            }
            for (end, at, x) in [(Side::Left, 0, -1.0), (Side::Right, n - 1, 1.0)] {
                assert_eq!(found.intervals[at][end] == x, found.reaches[end]);
            }
        }
    }

    /// The parabola x²/2 rolls until it touches around the line of the load, by elimination and by
    /// conjugate gradients.
    #[test]
    fn a_parabola_rolls() {
        for (load, at) in [(1e-6, 0.3), (0.01, -0.7), (0.3, 0.01), (0.3, 0.9)] {
            let scene = Scene { at: Some(at), ..scene(load, [-2.0, 2.0]) };
            let half = (4.0 * load / PI).sqrt();
            let due = Interval { left: at - half, right: at + half };
            let h = |x: f64| 0.5 * x * x;
            let coarse = find(&scene, h).unwrap();
            assert_eq!(coarse.intervals.len(), 1);
            assert!(off(coarse.intervals[0], due) < 0.12, "{load} {at}: {coarse:?}");
            assert!((coarse.tilt + at).abs() < 0.1 * half, "{load} {at}: {coarse:?}");
            if load > 0.1 {
                let fine = even(&scene, 2001, h);
                assert!(off(fine.intervals[0], due) < 0.01, "{load} {at}: {fine:?}");
                assert!((fine.tilt + at).abs() < 0.01 * half, "{load} {at}: {fine:?}");
            }
        }
    }

    #[test]
    fn from_the_last_contact_with_fewer_solves() {
        let h = |x: f64| x.powi(4) - 2.0 * x * x;
        let mut scene = scene(1e-6, [-3.0, 3.0]);
        let cold = set(&scene, h).unwrap();
        let last = cold.found().intervals;
        scene.start = &last;
        scene.load = 1.1e-6;
        let warm = set(&scene, h).unwrap();
        assert_eq!(warm.found().intervals.len(), 2);
        assert!(warm.solves <= 4 && 3 * warm.solves < cold.solves);
        // A start far from the contacts costs some more, but leads to the same ones.
        scene.start = &[Interval { left: 1.9, right: 1.900_001 }];
        assert_eq!(find(&scene, h).unwrap().intervals.len(), 2);
        scene.start =
            &[Interval { left: f64::NAN, right: 1.0 }, Interval { left: 5.0, right: -7.0 }];
        assert_eq!(find(&scene, h).unwrap().intervals.len(), 2);
    }

    #[test]
    fn single_precision() {
        for load in [1e-5f32, 1e-3, 0.1] {
            let scene = Scene {
                kappa: std::f32::consts::FRAC_PI_2,
                load,
                at: None,
                range: [-2.0f32, 2.0],
                cells: FIRST_CELLS,
                known: &[],
                start: &[],
            };
            let found = active_set(&scene, &mut 0, &mut |x: f32| Ok(x * x / 2.0 + 3.0)).unwrap();
            let half = f64::from(4.0 * load / std::f32::consts::PI).sqrt();
            // Under light loads the rounding of heights near 3 shows.
            for Interval { left, right } in &found.intervals {
                let on = Interval { left: f64::from(*left), right: f64::from(*right) };
                assert!(off(on, Interval { left: -half, right: half }) < 0.15, "{load}: {on:?}");
            }
            assert_eq!(found.intervals.len(), 1);
        }
    }

    #[test]
    fn no_scene_is_a_trap() {
        let flat = find(&scene(0.1, [-1.0, 3.0]), |_| 7.0).unwrap();
        assert_eq!(flat.intervals, [Interval { left: -1.0, right: 3.0 }]);
        assert_eq!(flat.reaches, Ends::both(true));
        let whole = f64::MAX / 4.0;
        let flat = find(&scene(1e-300, [-whole, whole]), |_| 0.0).unwrap();
        assert_eq!(flat.reaches, Ends::both(true));
        // Heights that overflow with this load, and a range of three numbers.
        let steep = find(&scene(1e-300, [-1.0, 1.0]), |x| 1e10 * (x - 0.2).abs()).unwrap();
        assert!(steep.intervals.len() == 1 && (steep.intervals[0].centre() - 0.2).abs() < 1e-9);
        let next = 1.0 + f64::EPSILON;
        assert!(find(&scene(0.1, [1.0, next]), |x| x).is_ok());
        for range in [[1.0, 1.0], [1.0, -1.0], [f64::NAN, 1.0], [0.0, f64::INFINITY]] {
            let refused = find(&scene(0.1, range), |x| x * x);
            assert!(matches!(refused, Err(NotFound::Scene { .. })), "{range:?}");
        }
        for load in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let refused = find(&scene(load, [-1.0, 1.0]), |x| x * x);
            assert!(matches!(refused, Err(NotFound::Scene { .. })), "{load}");
        }
        let hole = |x: f64| if x > 0.3 { f64::NAN } else { x * x };
        let refused = find(&scene(0.1, [-1.0, 1.0]), hole);
        assert!(matches!(refused, Err(NotFound::NotFinite { x, .. }) if x > 0.3), "{refused:?}");
        let outside = ContactError::Solve(SolveError::OutsideBodies { x: 0.0, range: [0.0, 1.0] });
        let refused = active_set(&scene(0.1, [-1.0, 1.0]), &mut 0, &mut |_| Err(outside.clone()));
        assert_eq!(refused.unwrap_err(), NotFound::Height(outside));
        // The search has spent all its work before.
        let mut spent = MAX_WORK + 1;
        let refused = active_set(&scene(0.1, [-1.0, 1.0]), &mut spent, &mut |x| Ok(x * x));
        assert_eq!(refused.map(|_| ()), Err(NotFound::Unsettled { solves: 0 }));
        // Noise from cell to cell: the search ends in any case.
        let noise = |x: f64| (x.to_bits().wrapping_mul(0x9e3779b97f4a7c15) >> 11) as f64 * 1e-16;
        for load in [1e-6, 1e-2, 1.0] {
            let known = heights(1000, [-1.0, 1.0], noise);
            let found = set(&Scene { known: &known, ..scene(load, [-1.0, 1.0]) }, noise);
            assert!(found.is_ok_and(|found| found.cells.len() <= MAX_CELLS), "{load}");
        }
    }
}
