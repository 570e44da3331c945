//! One of several contacts: the slope of the gap times the weight, and its integrals.

use super::super::edge_integrals::{self, EdgeSums};
use super::super::hilbert_transform::{BATCH, Edges, HilbertTransform};
use super::super::near_far_sum::{NearFarSum, Seen};
use super::super::panel::{MANY, Panel, Series, rise, spans, within};
use super::super::panel_set::PanelSet;
use crate::gap::{Cost, Gap};
use crate::numerics::chebyshev::{MAX_SIZE, SIZES, Table, by_size, power_series, size_for};
use crate::quadrature::Moments;
use crate::{ContactError, Fallible, InputError, Interval, Real, Side};

/// Most halvings of a panel to resolve the weight next to a gap, which may be as narrow as rounding
/// allows.
const MAX_CUTS_OF_PANEL: usize = 60;

/// Most halvings for derivatives alone, which may be noise.
const DERIVATIVE_HALVES: usize = 4;

/// Most panels of one contact; beyond it none is halved any more.
const MOST_PANELS: usize = 1 << 12;

/// Margin of the sampled span beyond a contact, as a share of its width, so that its limits can be
/// moved.
const SPAN_MARGIN: f64 = 0.1;

/// Smallest width of a contact, as a share of the sampled span; a narrower one is sampled anew.
const LEAST_WIDTH: f64 = 0.4;

/// Smallest width of the sampled span, as a share of the contact; a narrower span is forgotten. A
/// panel next to a corner, as narrow as a share s of the contact, costs eps/√s in the limits.
const LEAST_SPAN: f64 = 1e-3;

/// Twice the largest share of the last two terms in a series over a whole contact, for a trial.
/// Limits are then off by up to 1e-4 of a width, and by 1e-8 after one step on all panels.
const TRIAL_TOLERANCE: f64 = 2e-5;

/// Distance from a contact, in half-widths, from which on the cosine series of its panels is exact
/// to rounding: its error there is u¹⁶.
const FAR_DISTANCE: f64 = 4.0;

/// Largest length of a wall, as a share of the half-width, and least share of its rise in that of
/// the whole contact, in proportion to its length.
const MAX_WALL: f64 = 0.1;

/// Number of nodes at which the weight is computed together.
const WIDE: usize = 4;

#[derive(Clone)]
pub(super) struct OneOfSeveral<T> {
    pub on: Interval<T>,
    /// Slope of the gap around the contact.
    pub panel_set: PanelSet<T>,
    /// Place in the contact, the height of the gap there of the bodies as described, the largest
    /// height of either body, and the height added by tilt and bend.
    height: Option<[T; 4]>,
    /// Panels of `H`, the slope times `w p sqrt((x - α)(β - x))`, over the contact.
    panels: Vec<Panel<T>>,
    /// Spans still to be resolved, each with the number of its halvings.
    waiting: Vec<([T; 2], usize)>,
    transform: HilbertTransform<T>,
    /// H as a cosine series: all of it on a single panel, or the terms that count from afar.
    series: Series<T>,
    /// Sum over the panels, if there are several.
    far: NearFarSum<T>,
    /// Moments of H.
    pub moments: Moments<T>,
}

impl<T: Real> OneOfSeveral<T> {
    pub fn new(tolerance: T) -> Self {
        let zero = T::zero();
        let nowhere = Interval { left: zero, right: zero };
        Self {
            on: nowhere,
            panel_set: PanelSet::new(tolerance),
            height: None,
            panels: Vec::new(),
            waiting: Vec::new(),
            transform: HilbertTransform::new(),
            series: ([zero; MAX_SIZE], 0),
            far: NearFarSum::new(),
            moments: EdgeSums::new().moments(nowhere),
        }
    }

    /// Returns a contact whose slope was sampled elsewhere.
    pub fn on_panels(panel_set: PanelSet<T>) -> Self {
        let mut one = Self::new(panel_set.tolerance);
        one.panel_set = panel_set;
        one
    }

    /// Forgets the samples, since the contact or the bodies have changed.
    pub fn clear(&mut self, same_bodies: bool) {
        self.panel_set.clear(same_bodies);
        self.height = None;
    }

    /// Moves the contact to an interval, and samples the missing part of the gap within `ends`.
    pub fn sample(
        &mut self,
        gap: &Gap<'_, T>,
        on: Interval<T>,
        ends: [T; 2],
    ) -> Result<(), ContactError<T>> {
        self.on = on;
        let plain = on.plain();
        let close = |have: Interval<T>| {
            let [on, have] = [on, have].map(|on| on.half_width());
            on >= T::of(LEAST_WIDTH) * have && have >= T::of(LEAST_SPAN) * on
        };
        let is_close = self.panel_set.interval().is_some_and(close);
        if !(is_close && self.panel_set.covers(plain)) {
            if !is_close {
                self.clear(true);
            }
            let room = T::of(SPAN_MARGIN) * (plain.right - plain.left);
            let [from, to] = ends;
            let half = T::of(0.5);
            // At most half the way to an end, where the slope may be infinite.
            let span = Interval {
                left: (plain.left - room).max(half * plain.left + half * from),
                right: (plain.right + room).min(half * plain.right + half * to),
            };
            self.panel_set.extend(gap, span)?;
        }
        self.panel_set.add(gap);
        let [place, height, highest] = match self.height {
            Some([place, height, highest, _]) => [place, height, highest],
            None => {
                let places = [plain.centre(), plain.centre() + T::of(0.5) * plain.half_width()];
                self.height_at(gap, places)?
            }
        };
        self.height = Some([place, height, highest, gap.with_added(place, T::zero())]);
        Ok(())
    }

    /// Returns the first of two places, the height of the gap there, and the largest height of
    /// either body. If heights contradict the slopes, probes for a narrow feature.
    fn height_at(&mut self, gap: &Gap<'_, T>, places: [T; 2]) -> Fallible<T, [T; 3]> {
        loop {
            let mut cost = Cost::default();
            let heights = self.panel_set.heights(gap, places, &mut cost);
            self.panel_set.cost += cost;
            let may_hide =
                matches!(heights, Err(ContactError::Input(InputError::InconsistentHeights { .. })));
            if !may_hide || !self.panel_set.probe(gap, self.on.plain())? {
                return heights.map(|([height, _], highest)| [places[0], height, highest]);
            }
        }
    }

    /// Returns the height of the gap at a place in the contact, or at its limits: one height of the
    /// bodies plus the integral of the slope from there.
    pub fn height(&self, x: T) -> T {
        self.height.map_or(T::zero(), |[place, height, _, added]| {
            height + added + rise(&self.panel_set.panels, place, x)
        })
    }

    /// Returns the size of the terms in such a height, of which those of the bodies may be far
    /// larger than their difference.
    pub fn height_size(&self, height: T) -> T {
        height.abs() + self.height.map_or(T::zero(), |[_, _, highest, _]| highest)
    }

    /// Multiplies the slope by a weight, and prepares for the conditions on the limits. For a trial
    /// one panel is taken if it is almost enough.
    pub fn set(&mut self, weight: impl Fn([T; WIDE]) -> [T; WIDE], is_trial: bool) {
        let (on, tolerance) = (self.on, self.panel_set.tolerance);
        if !(is_trial && self.panel_set.panels.len() >= MANY && self.on_one_panel(&weight)) {
            self.panels.clear();
            for (panel, x) in spans(within(&self.panel_set.panels, on), on) {
                self.waiting.push((x, 0));
                // The weight bends over the whole of a contact.
                let more = if x[1] - x[0] > on.half_width() { 4 } else { 0 };
                let least = size_for((panel.length + more).min(MAX_SIZE)).max(8);
                while let Some((x, halved)) = self.waiting.pop() {
                    let (product, resolved, moved) =
                        multiply(x, (&|x| panel.value(x), panel.error, least), &weight, tolerance);
                    let resolved = resolved && (moved || halved >= DERIVATIVE_HALVES);
                    let [from, to] = x;
                    let middle = T::of(0.5) * (from + to);
                    let may = halved < MAX_CUTS_OF_PANEL && self.panels.len() < MOST_PANELS;
                    if !resolved && may && middle > from && middle < to {
                        self.waiting
                            .extend([[middle, to], [from, middle]].map(|x| (x, halved + 1)));
                        continue;
                    }
                    self.panels.push(product);
                }
            }
        }
        let mut over = None;
        self.moments = edge_integrals::moments(&self.panels, on, &mut over, None);
        self.series = over.unwrap_or_else(|| {
            self.far.set(&self.panels, on, Seen::Outside);
            self.far.cosines()
        });
    }

    /// Multiplies the slope by a weight on one panel; tells whether that is almost enough.
    fn on_one_panel(&mut self, weight: &impl Fn([T; WIDE]) -> [T; WIDE]) -> bool {
        let (x, zero) = ([self.on.left, self.on.right], T::zero());
        let slope = |x| self.panel_set.slope(x).unwrap_or(zero);
        let tolerance = T::of(TRIAL_TOLERANCE);
        let (product, resolved, _) = multiply(x, (&slope, zero, MAX_SIZE), weight, tolerance);
        // A fillet at the end of a flat may lie beyond the last node.
        let most = product.series.iter().fold(zero, |most, a| most.max(a.abs()));
        let is_end = |&x: &T| {
            let value = slope(x) * weight([x; WIDE])[0];
            (product.value(x) - value).abs() <= tolerance.sqrt() * (most + value.abs())
        };
        let is_seen = resolved && x.iter().all(is_end);
        self.panels.clear();
        self.panels.push(product);
        is_seen
    }

    /// Prepares for pressures in the contact.
    pub fn press(&mut self) {
        let over = Some(&self.series).filter(|_| self.panels.len() == 1);
        // A bound on |H|.
        let bound = |panel: &Panel<T>| panel.series.iter().fold(T::zero(), |sum, a| sum + a.abs());
        let size = self.panels.iter().map(bound).fold(T::zero(), T::max);
        self.transform.set(&self.panels, over, self.on, size, self.panel_set.tolerance);
    }

    /// Returns `V(x) = ∫ H/((s - x) sqrt((s - α)(β - s))) ds` at a place outside this contact, at a
    /// distance from its nearer end.
    pub fn outside(&self, x: T, distance: T) -> T {
        let half_width = self.on.half_width();
        let beyond = distance / half_width;
        if self.panels.len() > 1 && beyond < T::of(FAR_DISTANCE) {
            return self.far.outside(x, distance, self.on);
        }
        let root = (beyond * (beyond + T::of(2.0))).sqrt();
        let right = x > self.on.centre();
        let size = T::one() / (T::one() + beyond + root);
        // In the Joukowski variable.
        let u = if right { size } else { -size };
        let sum = power_series(&self.series.0[..self.series.1], u);
        let sum = T::pi() * sum / (root * half_width);
        if right { -sum } else { sum }
    }

    /// Returns the same integral as [`outside`](Self::outside) at a place not next to this contact.
    pub fn seen_from(&self, x: T) -> T {
        self.outside(x, (self.on.left - x).max(x - self.on.right))
    }

    /// Returns the contact, and its panels as seen from below the surface.
    pub fn in_plane(&self) -> (Interval<T>, NearFarSum<T>) {
        let mut sum = NearFarSum::new();
        sum.set(&self.panels, self.on, Seen::Below);
        (self.on, sum)
    }

    /// Returns how far the nearest singularity of the slope may lie from a limit, if the gap is
    /// much steeper there than further inside: the limit lies next to a corner, or on a shoulder.
    pub fn wall(&self, side: Side) -> Option<T> {
        let (on, panels) = (self.on, within(&self.panel_set.panels, self.on));
        let (last, others) = match side {
            Side::Left => panels.split_first()?,
            Side::Right => panels.split_last()?,
        };
        let [inner, outer] = [Side::Left, Side::Right].map(|s| usize::from(s == side));
        let away = |x: T| (on[side] - x).abs();
        // A series of n terms ends at rounding: its ellipse grows as the n-th root of that.
        let rho = T::epsilon().powf(-T::one() / T::count(last.length));
        let beyond = T::of(0.25) * (last.x[1] - last.x[0]) * (rho + rho.recip() - T::of(2.0));
        let (wall, half_width) = (away(last.x[inner]).min(beyond), on.half_width());
        // A limit that is held belongs to the panel inside, not to the one beyond the corner.
        let far = if side == Side::Left { panels.last() } else { panels.first() }?;
        let middle = self.panel_set.slope(on.centre())?;
        let at_end = last.value(on[side]);
        let all = (at_end - middle).abs().max((at_end - far.value(on[side.other()])).abs());
        let inside = on[side] + wall * if side == Side::Left { T::one() } else { -T::one() };
        let inward: &mut dyn Iterator<Item = &Panel<T>> = match side {
            Side::Left => &mut others.iter(),
            Side::Right => &mut others.iter().rev(),
        };
        let near = T::of(MAX_WALL) * half_width;
        let is_steep = std::iter::once((wall, last.value(inside)))
            .chain(inward.map(|panel| (away(panel.x[outer]), panel.value(panel.x[outer]))))
            .take_while(|&(away, _)| away < near)
            .any(|(away, value)| (at_end - value).abs() * near > away * all);
        (is_steep && wall > T::zero()).then_some(wall)
    }

    /// Returns V at one end of the contact, without its infinite part.
    pub fn at_end(&self, side: Side) -> T {
        let Some(derivatives) = self.moments.derivatives else { return T::zero() };
        let sign = if side == Side::Left { -T::one() } else { T::one() };
        T::pi() * (derivatives.by_0 + sign * derivatives.by_1)
    }

    /// Returns `sqrt((x - α)(β - x)) V(x)` at the first `count` points, in the contact, and the
    /// root.
    pub fn inside(&self, x: &[T; BATCH], count: usize) -> ([T; BATCH], [T; BATCH]) {
        let edges = Edges::of(self.on, x);
        (self.transform.at(x, count, &edges), edges.root)
    }

    /// Estimates the error of the first result of [`inside`](Self::inside).
    pub fn error(&self, x: T) -> T {
        self.transform.error(&self.panels, x)
    }
}

/// Returns a panel of the product of a slope and a weight over a span, and two flags: its nodes
/// suffice for the value, and for the derivatives that dual numbers carry. `error` is that of the
/// slope, `least` the number of nodes tried first.
fn multiply<T: Real>(
    x: [T; 2],
    (slope, error, least): (&impl Fn(T) -> T, T, usize),
    weight: &impl Fn([T; WIDE]) -> [T; WIDE],
    tolerance: T,
) -> (Panel<T>, bool, bool) {
    let half = T::of(0.5);
    let (mut product, mut resolved, mut moved) = (Panel::new(x), false, false);
    for n in SIZES.into_iter().filter(|&n| n >= least) {
        let table = Table::of(n);
        let (reach, mut largest) = (half * (x[1] - x[0]), T::zero());
        let mut values = [T::zero(); MAX_SIZE];
        let chunks = values[..n].as_chunks_mut::<WIDE>().0;
        for (values, &z) in chunks.iter_mut().zip(table.z.as_chunks().0) {
            // From the nearer end, where the weight may be steep.
            let places = z.map(|z| match z {
                z if z < 0.0 => x[0] + reach * T::of(1.0 + z),
                z => x[1] - reach * T::of(1.0 - z),
            });
            let factors = weight(places);
            largest = factors.iter().fold(largest, |largest, factor| largest.max(factor.abs()));
            *values = std::array::from_fn(|i| factors[i] * slope(places[i]));
        }
        by_size!(n, N => {
            let row = &values.as_chunks::<N>().0[0];
            product.series[..N].copy_from_slice(&table.coefficients(row));
        });
        product.count(n);
        let size = |terms: &[T], part| {
            terms.iter().fold(T::zero(), |max, a| max.max(a.component(part).abs()))
        };
        let parts = [0..n, n - 6..n - 4, n - 4..n - 2, n - 2..n];
        let [all, earlier, before, last] = parts.map(|terms| size(&product.series[terms], 0));
        // The coefficients left out fall like the last ones.
        let fall = (last / before).max(before / earlier);
        let last = if fall < T::of(0.3) { last * fall } else { last };
        // The rounding of x counts where the weight is steep.
        let bend = (values[n - 1] - values[0]).abs() / (x[1] - x[0]);
        let noise = error * largest + T::epsilon() * x[0].abs().max(x[1].abs()) * bend;
        product.error = noise + last;
        // Halving does not mend values that are not finite.
        resolved = last <= half * tolerance * all + noise || !all.is_finite();
        // The derivatives of dual numbers must be resolved, too: the weight bends more as a limit
        // moves.
        let small = T::epsilon().powf(T::of(0.75));
        moved = (1..T::COMPONENTS).all(|part| {
            let all = size(&product.series[..n], part);
            size(&product.series[n - 2..n], part) <= small * all || !all.is_finite()
        });
        if resolved && moved {
            break;
        }
    }
    (product, resolved, moved)
}
