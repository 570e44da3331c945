//! No overlap outside.
//!
//! It is the check of each solve, on a survey that has points of its own in each cell, finer ones near the limits,
//! and heights that go with its slopes.
//! Next to a limit the gap may be less than the rounding of the heights. There the slopes decide: outside the contacts
//!
//! ```text
//! V'(x) = (1/κ) ∫ P(s)/(x - s) ds
//! ```
//!
//! falls with x where P ≥ 0, and at a free limit it is the slope of the bodies. As long as they are steeper than at the
//! limit, the gap grows.

use super::{Extremum, MOST_EVALUATIONS, undecided};
use crate::gap::{Cost, Node, Rise, Sampler, Survey};
use crate::quadrature::panels::Rises;
use crate::solution::pressure_integral::Integrals;
use crate::solution::signorini_check::{Beside, Seen, SignoriniCheck, by_size};
use crate::solution::{ContactState, ExteriorField, Solved};
use crate::{ContactError, Ends, Interval, Real, Side};

/// The length of a cell, as a share of the spacing: its points are no further apart than 0.181 of that.
const CELL: f64 = 1.25;

/// The shares of the half-width and of the distance from a limit that a cell may be long.
const NEAR_LIMIT: [f64; 2] = [0.0625, 0.5];

/// Halvings of panels that contradict the heights, after which it is no narrow feature between two points.
const MOST_HALVINGS: usize = 12;

/// The number of measured noises, three standard deviations each, by which heights may be off: nine points of a panel,
/// and the limit.
const NOISE: f64 = 4.0;

/// The room between two contacts, or beyond the outermost ones.
struct Room<T> {
    on: Interval<T>,
    /// The half-width of the contact on either side.
    beside: Ends<Option<T>>,
}

/// A point where the bodies are nearest to each other.
struct Turn<T> {
    room: usize,
    /// The points on either side; twice the same at an end.
    between: [T; 2],
    gap: T,
    /// Whether they overlap there by more than the series of the pressures leave open.
    overlaps: bool,
}

/// Everything outside the contacts.
pub(super) struct Outside<'s, T: Real> {
    check: SignoriniCheck<'s, T>,
    ends: Ends<T>,
    /// Before the first contact, between each two, and beyond the last.
    rooms: Vec<Room<T>>,
    /// The distances from the limits of each within which the bodies are steeper than there.
    opens: Vec<[T; 2]>,
    look: Survey<T>,
    fields: Vec<ExteriorField<T>>,
}

impl<'s, T: Real> Outside<'s, T> {
    /// Finds the least gap at a place where the bodies approach each other again.
    ///
    /// # Errors
    /// [`ContactError::Overlap`], [`ContactError::InconsistentHeights`], [`ContactError::Undecided`], and those of
    /// sampling the bodies.
    pub fn look(
        check: SignoriniCheck<'s, T>,
        ends: Ends<T>,
        spacing: T,
        cost: &mut Cost,
    ) -> Result<Option<Extremum<T>>, ContactError<T>> {
        let rooms = rooms(check.contacts(), ends);
        if rooms.iter().all(Room::is_empty) {
            return Ok(None);
        }
        let mut look = Survey::new();
        look.take(&check.gap.tilted(T::zero()), cost)?;
        let spans = rooms.iter().filter(|room| !room.is_empty());
        let spans: Vec<[T; 2]> = spans.map(|room| [room.on.left, room.on.right]).collect();
        let mut grid = Vec::new();
        rooms.iter().for_each(|room| room.cells(T::of(CELL) * spacing, &mut grid));
        look.cut(check.gap, &grid, &spans, cost)?;
        let (opens, fields) = (Vec::new(), Vec::new());
        let mut outside = Self { check, ends, rooms, opens, look, fields };
        outside.compare_heights(&spans, cost)?;
        outside.opens = outside.opens();
        if (0..outside.rooms.len()).all(|i| outside.is_open(i)) {
            return Ok(None);
        }
        outside.measure_noise(cost)?;
        let Self { check, fields, .. } = &mut outside;
        let SignoriniCheck { gap, integrator, kappa, found, .. } = *check;
        check.exact = Some(Integrals::new(Solved { gap, integrator, kappa, found })?);
        check.fields(fields)?;
        check.resolve(fields, ContactState::<T>::rounding())?;
        outside.overlap(cost)?;
        outside.least_gap(cost)
    }

    /// Refuses heights that contradict the slopes, after panels have been made so fine that none hides it.
    fn compare_heights(
        &mut self,
        spans: &[[T; 2]],
        cost: &mut Cost,
    ) -> Result<(), ContactError<T>> {
        let gap = self.check.gap;
        let heights = self.look.nodes().iter().filter(|node| {
            node.x >= self.ends.left && node.x <= self.ends.right && node.height.is_finite()
        });
        let [low, high] = heights
            .fold([T::one() / T::zero(), -T::one() / T::zero()], |on, node| {
                [on[0].min(node.height), on[1].max(node.height)]
            });
        let open = T::epsilon().cbrt() * (high - low);
        let mut sampler = Sampler::default();
        for round in 0.. {
            if let Some(x) = self.look.settle(gap, spans, open, MOST_EVALUATIONS, cost)? {
                return Err(undecided(x, *cost));
            }
            let mut contradictions = Vec::new();
            for rise in self.look.rises(spans) {
                let Rise { between, by_heights, by_slopes, highest } = rise;
                // Where X stands still there is no rise.
                let is_way =
                    between[1] - between[0] > T::of(64.0) * T::epsilon() * between[1].abs();
                let rises = Rises { between, by_heights, by_slopes, highest, open };
                match rises.compare_beside_noise(gap, &mut sampler) {
                    Err(error) if is_way && round == MOST_HALVINGS => return Err(error),
                    Err(_) if is_way => contradictions.push(between),
                    _ => {}
                }
            }
            if contradictions.is_empty() {
                break;
            }
            contradictions.sort_by(|one, other| by_size(one[0], other[0]));
            self.look.refine_at(gap, &contradictions, None, cost)?;
        }
        cost.heights += sampler.cost.evaluations;
        Ok(())
    }

    /// Finds how far from its limits the gap opens in each room.
    fn opens(&self) -> Vec<[T; 2]> {
        // With tension at an edge the pressure may pull less farther off.
        let pulls = self.check.found.adhesive != Ends::both(false);
        let from = |room: &Room<T>, end: Side| match room.beside[end] {
            Some(_) if !pulls => self.opens_from(room.on, end),
            _ => T::zero(),
        };
        self.rooms.iter().map(|room| Side::BOTH.map(|end| from(room, end))).collect()
    }

    /// Returns how far from the limit at one end of a room the gap opens.
    fn opens_from(&self, room: Interval<T>, end: Side) -> T {
        let Self { check, look, .. } = self;
        let (gap, nodes, limit) = (check.gap, look.nodes(), room[end]);
        let (first, last) = (
            nodes.partition_point(|node| node.x <= room.left),
            nodes.partition_point(|node| node.x < room.right),
        );
        // As in the contact.
        let slope = Sampler::default().slope_from(gap, gap.nearest(limit), end);
        let Ok(at_limit) = slope else { return T::zero() };
        let outward = if end == Side::Left { T::one() } else { -T::one() };
        let opens = |node: &&Node<T>| {
            let slopes = node.slopes.map(|slope| outward * (slope + gap.tilt()));
            let slope = slopes[0].min(slopes[1]) - node.doubt;
            let rounding = T::of(16.0) * T::epsilon() * at_limit.abs();
            slope >= outward * at_limit - rounding
        };
        let nodes = &nodes[first..last.max(first)];
        let count = match end {
            Side::Left => nodes.iter().take_while(opens).count(),
            Side::Right => nodes.iter().rev().take_while(opens).count(),
        };
        match (count, end) {
            (0, _) => T::zero(),
            (count, _) if count == nodes.len() => room.right - room.left,
            (count, Side::Left) => nodes[count - 1].x - limit,
            (count, Side::Right) => limit - nodes[nodes.len() - count].x,
        }
    }

    /// Tells whether the gap is proved to open all the way through a room.
    fn is_open(&self, i: usize) -> bool {
        let (room, [one, other]) = (&self.rooms[i], self.opens[i]);
        room.is_empty() || one + other >= room.on.right - room.on.left
    }

    /// Measures the noise of the heights at the limits, which all others are counted from.
    fn measure_noise(&mut self, cost: &mut Cost) -> Result<(), ContactError<T>> {
        let (check, mut sampler) = (&self.check, Sampler::default());
        let mut most = T::zero();
        for limit in check.contacts().iter().flat_map(|on| [on.left, on.right]) {
            most = most.max(sampler.noise_of_height(check.gap, limit)?);
        }
        cost.heights += sampler.cost.evaluations;
        self.check.noise = T::of(NOISE) * most;
        Ok(())
    }

    /// Refuses an overlap, and what hides whether there is one.
    fn overlap(&mut self, cost: &mut Cost) -> Result<(), ContactError<T>> {
        let (interval, load) = (self.check.found.interval, self.check.found.load);
        let refuse = |[x, gap]: [T; 2]| Err(ContactError::Overlap { x, gap, interval, load });
        // Where the bodies overlap at many points the deepest place is enough.
        if let Some(turn) = self.lowest_turn().filter(|turn| turn.overlaps) {
            let from = self.beside(turn.room);
            let x = self.place(&turn);
            if let Some(found) = self.check.verified(&self.fields, &from, x, cost)?.0 {
                return refuse(found);
            }
        }
        let Self { check, ends, look, fields, opens, .. } = self;
        match check.seek_overlap(fields, look, *ends, Some(opens), cost)? {
            Seen::Apart => Ok(()),
            Seen::Open(x) => Err(undecided(x, *cost)),
            Seen::Overlap(found) => refuse(found),
        }
    }

    /// Finds the least gap from which on the bodies part again.
    fn least_gap(&self, cost: &mut Cost) -> Result<Option<Extremum<T>>, ContactError<T>> {
        let Some(turn) = self.lowest_turn() else { return Ok(None) };
        let (from, x) = (self.beside(turn.room), self.place(&turn));
        let mut sampler = Sampler::default();
        let height = sampler.height(self.check.gap, x)?;
        cost.heights += sampler.cost.evaluations;
        let [value, _] = self.check.exact_gap_left(&self.fields, &from, [x, height])?;
        Ok(Some(Extremum { x, value }))
    }

    fn beside(&self, room: usize) -> Beside<T> {
        self.check.beside(&self.fields, &self.look, Some(&self.opens), room)
    }

    /// Returns the place of the lowest gap next to a point.
    fn place(&self, turn: &Turn<T>) -> T {
        match turn.between {
            [one, other] if one < other => {
                self.check.lowest_between(&self.fields, &self.look, [one, other])
            }
            [x, _] => x,
        }
    }

    /// Returns the lowest point from which on the bodies part again, or where they end.
    fn lowest_turn(&self) -> Option<Turn<T>> {
        let rooms = (0..self.rooms.len()).filter(|&i| !self.is_open(i));
        let turns = rooms.flat_map(|i| self.turns(i));
        turns.reduce(|one, other| if other.gap < one.gap { other } else { one })
    }

    /// Lists the points of a room where the gap stops falling, on the way from a contact.
    fn turns(&self, i: usize) -> Vec<Turn<T>> {
        let Self { check, rooms, opens, look, fields, .. } = self;
        let (room, from) = (&rooms[i], self.beside(i));
        let [start, end] = [room.on.left + opens[i][0], room.on.right - opens[i][1]];
        let nodes = look.nodes();
        let (first, last) = (
            nodes.partition_point(|node| node.x < start),
            nodes.partition_point(|node| node.x <= end),
        );
        let count = last.saturating_sub(first);
        let outward = |i: usize| match room.beside.left {
            Some(_) => &nodes[first + i],
            None => &nodes[last - 1 - i],
        };
        let turn = |(i, gap): (usize, T), allowed: T| {
            let x = |i: usize| outward(i.min(count - 1)).x;
            let [one, other] = [x(i.saturating_sub(1)), x(i + 1)];
            let is_end = i == 0 || i + 1 == count;
            let between = if is_end { [x(i); 2] } else { [one.min(other), one.max(other)] };
            Turn { room: from.next, between, gap, overlaps: gap < -allowed }
        };
        let (mut turns, mut highest, mut lowest) = (Vec::new(), T::zero(), None::<(usize, T)>);
        for i in 0..count {
            let Node { x, height, .. } = *outward(i);
            let height = check.gap.turned(x, height);
            let [gap, doubt] = check.gap_left(fields, &from, [x, height]);
            let allowed = check.allowed(height, from.height) + doubt;
            match lowest {
                None if gap < highest - allowed => lowest = Some((i, gap)),
                None => highest = highest.max(gap),
                Some((_, least)) if gap < least => lowest = Some((i, gap)),
                Some((at, least)) if gap > least + allowed => {
                    turns.push(turn((at, least), allowed));
                    (highest, lowest) = (gap, None);
                }
                Some(_) => {}
            }
        }
        // Between two contacts the gap falls to the next one.
        if let Some(place) = lowest.filter(|_| !room.is_inner()) {
            turns.push(turn(place, check.noise));
        }
        turns
    }
}

impl<T: Real> Room<T> {
    fn is_empty(&self) -> bool {
        self.on.left >= self.on.right
    }

    /// Tells whether it lies between two contacts.
    fn is_inner(&self) -> bool {
        self.beside.left.is_some() && self.beside.right.is_some()
    }

    /// Lists the ends of cells, no longer than a length, and shorter towards the limits.
    fn cells(&self, most: T, grid: &mut Vec<T>) {
        if self.is_empty() {
            return;
        }
        let Interval { left, right } = self.on;
        let (half, [share, growth]) = (T::of(0.5), NEAR_LIMIT.map(T::of));
        let middle = match self.beside.left {
            Some(_) if self.is_inner() => half * left + half * right,
            Some(_) => right,
            None => left,
        };
        let walk = |length: T, beside: Option<T>| {
            let mut places = Vec::new();
            let Some(half_width) = beside else { return places };
            let mut reached = T::zero();
            while reached < length {
                // The first one begins inside, so that it has the limit itself.
                let inside = T::of(0.25) * (share * half_width).min(most).min(length);
                places.push(if reached.is_zero() { -inside } else { reached });
                let step = (growth * reached).max(share * half_width).min(most);
                reached =
                    if reached + T::of(1.25) * step >= length { length } else { reached + step };
            }
            places
        };
        let [up, down] =
            [walk(middle - left, self.beside.left), walk(right - middle, self.beside.right)];
        grid.extend(up.into_iter().map(|distance| left + distance));
        grid.push(middle);
        grid.extend(down.into_iter().rev().map(|distance| right - distance));
    }
}

/// Lists the rooms before, between and beyond the contacts.
fn rooms<T: Real>(contacts: &[Interval<T>], ends: Ends<T>) -> Vec<Room<T>> {
    let room = |next: usize| {
        let [before, after] =
            [next.checked_sub(1).map(|i| contacts[i]), contacts.get(next).copied()];
        let left = before.map_or(ends.left, |on| on.right);
        let right = after.map_or(ends.right, |on| on.left);
        let beside = Ends { left: before, right: after };
        let beside = beside.map(|on| on.map(|on| on.half_width()));
        Room { on: Interval { left, right }, beside }
    };
    (0..=contacts.len()).map(room).collect()
}
