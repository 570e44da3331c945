//! Two bodies as one function of x: the slope of the gap between them.
//!
//! This is the only place that calls the user's curves:
//!
//! ```text
//! g(x) = Y₂'(k₂)/X₂'(k₂) - Y₁'(k₁)/X₁'(k₁)   where X₁(k₁) = X₂(k₂) = x      (4, 5, 8)
//! ```
//!
//! Each value costs one inversion for each body that needs one. The inversion starts from
//! the curve's own last point, moved on by Newton's rule, so that neighbouring abscissae cost
//! two or three evaluations each.

use crate::profile::Piece;
use crate::search::{Bracket, LimitSearch, SearchError};
use crate::{Body, ContactError, CurvePoint, ParametricProfile, ProfileError, Real};

/// The slope of the gap between two bodies, not yet sampled.
#[derive(Clone)]
pub struct Gap<'a, T: Real> {
    bodies: [Vec<Piece<'a, T>>; 2],
    inversion: &'a dyn LimitSearch<T>,
    range: [T; 2],
    joints: Vec<T>,
}

/// What sampling the gap has cost.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cost {
    /// Values of the gap slope `g(x)`.
    pub samples: usize,
    /// Evaluations of the users' curves while solving: calls of [`ParametricProfile::at`].
    pub evaluations: usize,
}

impl std::ops::Add for Cost {
    type Output = Self;
    fn add(mut self, other: Self) -> Self {
        self += other;
        self
    }
}

impl std::ops::AddAssign for Cost {
    fn add_assign(&mut self, other: Self) {
        self.samples += other.samples;
        self.evaluations += other.evaluations;
    }
}

/// The side from which a joint is looked at.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Side {
    Left,
    Right,
}

impl<'a, T: Real> Gap<'a, T> {
    pub(crate) fn new(
        lower: &'a dyn ParametricProfile<T>,
        upper: &'a dyn ParametricProfile<T>,
        inversion: &'a dyn LimitSearch<T>,
    ) -> Result<Self, ContactError<T>> {
        let bodies = [pieces(Body::Lower, lower)?, pieces(Body::Upper, upper)?];
        let [lower, upper] = [extent(&bodies[0]), extent(&bodies[1])];
        let range = [lower[0].max(upper[0]), lower[1].min(upper[1])];
        if range[0] >= range[1] {
            return Err(ContactError::Apart { lower, upper });
        }
        let mut joints: Vec<T> = Vec::new();
        for body in &bodies {
            joints.extend(body.iter().skip(1).map(|piece| piece.x[0]));
        }
        joints.retain(|&x| x > range[0] && x < range[1]);
        joints.sort_by(|x, y| x.partial_cmp(y).expect("checked: the ends of pieces are finite"));
        joints.dedup();
        Ok(Self { bodies, inversion, range, joints })
    }

    pub(crate) fn with_inversion(self, inversion: &'a dyn LimitSearch<T>) -> Self {
        Self { inversion, ..self }
    }

    /// The range of `x` that both bodies cover.
    pub fn range(&self) -> [T; 2] {
        self.range
    }

    /// Where either profile passes from one piece to the next, rising.
    pub fn joints(&self) -> &[T] {
        &self.joints
    }

    /// A sampler, which takes values of the slope one after the other.
    pub fn sampler(&self) -> Sampler<'_, T> {
        Sampler { gap: self, near: [None; 2], cost: Cost::default(), missed: T::zero() }
    }
}

fn pieces<T: Real>(
    body: Body,
    profile: &dyn ParametricProfile<T>,
) -> Result<Vec<Piece<'_, T>>, ContactError<T>> {
    let pieces = profile.pieces();
    if !pieces.is_empty() {
        return Ok(pieces);
    }
    match Piece::new(profile) {
        Ok(piece) => Ok(vec![piece]),
        Err(source) => Err(ContactError::Profile { body, source }),
    }
}

fn extent<T: Real>(pieces: &[Piece<'_, T>]) -> [T; 2] {
    [pieces[0].x[0], pieces[pieces.len() - 1].x[1]]
}

/// Takes values of the gap's slope, and keeps count.
pub struct Sampler<'g, T: Real> {
    gap: &'g Gap<'g, T>,
    near: [Option<Near<T>>; 2],
    /// What it has cost so far.
    pub cost: Cost,
    /// The largest `|X(k) - x|` that the inversions have left.
    pub(crate) missed: T,
}

/// The last point of a curve, from which the next inversion starts.
#[derive(Clone, Copy)]
struct Near<T> {
    piece: usize,
    k: T,
    point: CurvePoint<T>,
}

impl<T: Real> Sampler<'_, T> {
    /// The slope of the gap `f₂' - f₁'` at `x`. A joint belongs to the piece on its left.
    ///
    /// # Errors
    /// [`ContactError::OutsideBodies`], [`ContactError::Inversion`],
    /// [`ContactError::Profile`].
    pub fn slope(&mut self, x: T) -> Result<T, ContactError<T>> {
        self.slope_from(x, Side::Left)
    }

    pub(crate) fn slope_from(&mut self, x: T, side: Side) -> Result<T, ContactError<T>> {
        let range = self.gap.range;
        if !(x >= range[0] && x <= range[1]) {
            return Err(ContactError::OutsideBodies { x, range });
        }
        self.cost.samples += 1;
        let lower = self.body_slope(Body::Lower, x, side)?;
        let upper = self.body_slope(Body::Upper, x, side)?;
        Ok(upper - lower)
    }

    fn body_slope(&mut self, body: Body, x: T, side: Side) -> Result<T, ContactError<T>> {
        let gap = self.gap;
        let pieces = &gap.bodies[body as usize];
        let ends_before = |piece: &Piece<'_, T>| match side {
            Side::Left => piece.x[1] < x,
            Side::Right => piece.x[1] <= x,
        };
        let index = pieces.partition_point(ends_before).min(pieces.len() - 1);
        let piece = &pieces[index];
        let fault = |quantity, k, value| {
            let source = ProfileError::NotFinite { quantity, k, value };
            Err(ContactError::Profile { body, source })
        };
        if let Some(slope) = piece.curve.slope_at(x) {
            // Such a body is given by x itself.
            return if slope.is_finite() { Ok(slope) } else { fault("slope_at(x)", x, slope) };
        }
        let Near { k, point, .. } = self.invert(body, index, x)?;
        let slope = point.dy / point.dx;
        if slope.is_finite() { Ok(slope) } else { fault("the slope Y'/X'", k, slope) }
    }

    /// Solves `X(k) = x` on a piece.
    fn invert(&mut self, body: Body, index: usize, x: T) -> Result<Near<T>, ContactError<T>> {
        let gap = self.gap;
        let piece = &gap.bodies[body as usize][index];
        let near = self.near[body as usize].filter(|near| near.piece == index);
        let rises = piece.k[0] < piece.k[1];
        let turns =
            |near: &Near<T>| (near.point.dx < T::zero()) == rises && !near.point.dx.is_zero();
        let mut at = |k: T| {
            self.cost.evaluations += 1;
            Near { piece: index, k, point: piece.curve.at(k) }
        };
        let (mut last, mut turned) = (None, None);
        let k = if x <= piece.x[0] {
            piece.k[0]
        } else if x >= piece.x[1] {
            piece.k[1]
        } else {
            let guess = match near {
                Some(Near { k, point, .. }) => k + (x - point.x) / point.dx,
                None => {
                    let along = (x - piece.x[0]) / (piece.x[1] - piece.x[0]);
                    piece.k[0] + along * (piece.k[1] - piece.k[0])
                }
            };
            let mut f = |k: T| {
                let here = at(k);
                last = Some(here);
                turned = turned.or(last.filter(turns));
                (here.point.x - x, here.point.dx)
            };
            let ends = [(piece.k[0], piece.x[0] - x), (piece.k[1], piece.x[1] - x)];
            let [(lo, f_lo), (hi, f_hi)] =
                if ends[0].0 < ends[1].0 { ends } else { [ends[1], ends[0]] };
            let bracket = Bracket::new(lo, hi).values(f_lo, f_hi).guess(guess);
            match gap.inversion.find_with_slope(&mut f, &bracket) {
                Ok(root) if root.x >= lo && root.x <= hi => root.x,
                Ok(root) => {
                    let source = SearchError::Astray { x: root.x, lo, hi };
                    return Err(ContactError::Inversion { body, x, source });
                }
                Err(SearchError::NotFinite { x: k, value }) => {
                    let source = ProfileError::NotFinite { quantity: "X", k, value };
                    return Err(ContactError::Profile { body, source });
                }
                Err(source) => return Err(ContactError::Inversion { body, x, source }),
            }
        };
        let found = last.filter(|last| last.k == k).unwrap_or_else(|| at(k));
        if let Some(Near { k, point, .. }) = turned.or(Some(found).filter(turns)) {
            let source = ProfileError::TurnsBack { k, x: point.x };
            return Err(ContactError::Profile { body, source });
        }
        self.missed = self.missed.max((found.point.x - x).abs());
        self.near[body as usize] = Some(found);
        Ok(found)
    }
}

impl<T: Real> std::fmt::Debug for Gap<'_, T> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { range, joints, .. } = self;
        let mut debug = f.debug_struct("Gap");
        debug.field("range", range).field("joints", joints).finish_non_exhaustive()
    }
}
