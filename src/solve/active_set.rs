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

use crate::kernel::Kernel;
use crate::numerics::ascending;
use crate::numerics::dot;
use crate::{ContactError, Ends, Fallible, Interval, Real};
use forces::{line, sum};
use potential::{CellPlace, Potential};

/// Number of cells at first; twice as many after a failed check may resolve more.
pub(super) const FIRST_CELLS: usize = 33;

/// Number of cells above which none is cut any more: five for each of 3 000 contacts, whose limits
/// take minutes.
const MAX_CUT_CELLS: usize = 15_000;

/// Largest number of rounds of cuts: enough for a contact of 1e-16 of the bodies.
const MAX_CUTS: usize = 48;

/// Least number of loaded cells in a run of [`FIRST_CELLS`], which rises with their number; the
/// cells of shorter runs are cut.
const CELLS_OF_A_RUN: usize = 4;

/// Mean depth of the gap of a round contact below the level of its edges, in units of F/κ: two
/// thirds of `κ h(L)/F`, which is one.
const MEAN_DEPTH: f64 = 2.0 / 3.0;

/// Width of the cells in a contact, by the distance of the nearest singularity of a regular kernel,
/// and the number of cells of this width that are too many.
pub(super) const LENGTH: f64 = 0.3;
const MAX_OF_KERNEL: usize = 500;

/// Updates of the set of loaded cells before the search is given up.
const MAX_CHANGES: usize = 400;

/// Full updates without progress before switching to one cell at a time.
const MAX_IN_VAIN: usize = 4;

/// Largest sum of cells times steps over all linear systems of a search: a quarter of a minute at
/// worst, and twenty times what a step of the heights takes.
const MAX_WORK: usize = 20_000_000;

/// Two bodies and a load.
pub(super) struct Scene<'s, T: Real> {
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
    /// Regular kernel, if any.
    pub kernel: Option<&'s Kernel<'s, T>>,
    /// Look whether the search is cancelled.
    pub watch: &'s dyn Fn() -> Fallible<T, ()>,
}

/// Contacts, to some per cent of each width.
#[derive(Clone, Debug)]
pub(super) struct Coarse<T: Real> {
    /// Contacts, from left to right.
    pub intervals: Vec<Interval<T>>,
    /// Angle by which body 2 is turned counter-clockwise.
    pub tilt: T,
    /// Flags: the contact reaches this end of the range.
    pub reaches: Ends<bool>,
}

impl<T: Real> Coarse<T> {
    /// Returns the interval from the first contact, of at least one, to the last.
    pub fn hull(&self) -> Interval<T> {
        let last = self.intervals.len() - 1;
        Interval { left: self.intervals[0].left, right: self.intervals[last].right }
    }
}

/// Reason why no contact is found.
#[derive(Debug, PartialEq)]
pub(super) enum NotFound<T: Real> {
    /// Error of a height that cannot be computed, or of a search that is cancelled.
    Height(ContactError<T>),
    /// Height that is not finite.
    NotFinite { x: T, height: T },
    /// Empty range, or a load or κ that is not positive and finite.
    Scene { kappa: T, load: T, range: [T; 2] },
    /// Set of loaded cells that does not converge.
    Unsettled { solves: usize },
}

type Height<'h, T> = &'h mut dyn FnMut(T) -> Fallible<T, T>;

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

struct ActiveSet<'s, T: Real> {
    cells: Vec<Cell<T>>,
    range: [T; 2],
    kappa: T,
    load: T,
    at: Option<T>,
    /// Least number of loaded cells in a run.
    cells_of_a_run: usize,
    /// Width of the cells in a contact that resolves a regular kernel.
    length: Option<T>,
    /// Rise κ h/F above the lowest cell, and the potential.
    rise: Vec<T>,
    potential: Vec<T>,
    matrix: Potential<'s, T>,
    /// Sum of rise and potential in loaded cells: a level, and a slope about the place of the load.
    level: T,
    slope: T,
    /// Uncertainty of the forces and the gaps last solved for.
    uncertainty: T,
    /// True if cells were cut since rise and potential were computed.
    changed: bool,
    /// Number of linear systems solved.
    solves: usize,
    work: usize,
}

impl<'s, T: Real> ActiveSet<'s, T> {
    /// Loads the cells in which the bodies touch, cut as finely as needed to resolve the contacts.
    fn settle(&mut self, scene: &Scene<'_, T>, height: Height<'_, T>) -> Result<(), NotFound<T>> {
        self.take_up(scene.start, height)?;
        for _ in 0..MAX_CUTS {
            self.converge(scene)?;
            let (marks, intervals) = (self.marks(scene.known), self.intervals());
            if !self.cut(&marks, &intervals, height)? {
                break;
            }
        }
        if self.changed { self.converge(scene) } else { Ok(()) }
    }

    fn new(scene: &Scene<'s, T>, height: Height<'_, T>) -> Result<Self, NotFound<T>> {
        let Scene { kappa, load, at, range, cells, kernel, .. } = *scene;
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
            matrix: Potential::new(kernel, range),
            length: kernel.map(|kernel| T::of(LENGTH) * kernel.distance()),
            level: T::zero(),
            slope: T::zero(),
            uncertainty: T::zero(),
            changed: true,
            solves: 0,
            work: 0,
        };
        let mut left = range[0];
        let cells = cells.clamp(1, MAX_CUT_CELLS);
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
        let by_height =
            |&i: &usize, &j: &usize| ascending(&self.cells[i].height, &self.cells[j].height);
        (0..self.cells.len()).min_by(by_height)
    }

    /// Returns the distance to the right of the place of the load, as a share of the range.
    fn arm(&self, x: T) -> T {
        self.at.map_or(T::zero(), |at| (x - at) / (self.range[1] - self.range[0]))
    }

    /// Loads cells to start with, as if each yielded independently: those below a line on which the
    /// load acts at its place. The line's level by [`MEAN_DEPTH`] is right for one round contact.
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
            let excess = T::of(MEAN_DEPTH) * T::count(loaded.len()) / T::count(runs);
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
        let by_line = |one: &_, other: &_| ascending(&line(one), &line(other));
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
        let room = MAX_CUT_CELLS.saturating_sub(self.cells.len()) / 2;
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
        // Places are as close together as x can be: a distance from an end of the range is rounded
        // as the range is, which is far wider than the cells at a step.
        let size = self.range[1] - self.range[0];
        let place =
            |cell: &Cell<T>| CellPlace { centre: cell.centre() / size, width: cell.width() / size };
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
    fn converge(&mut self, scene: &Scene<'_, T>) -> Result<(), NotFound<T>> {
        if self.changed {
            self.prepare();
        }
        let (mut least, mut in_vain) = (usize::MAX, 0);
        for _ in 0..MAX_CHANGES {
            (scene.watch)().map_err(NotFound::Height)?;
            if !self.bears() {
                self.rest();
            }
            if !self.bears() || self.work > MAX_WORK {
                break;
            }
            self.uncertainty = self.solve();
            let wrong: Vec<_> = (0..self.cells.len())
                .filter(|&i| {
                    let Cell { loaded, force, .. } = self.cells[i];
                    (if loaded { force } else { self.gap(i) }) < -self.uncertainty
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
mod tests;
