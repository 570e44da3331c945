//! A body from a drawing: straight lines and arcs, tangent to each other but at corners.
//!
//! A fillet of radius ρ touches both segments at its corner. With the corner as the origin, let n
//! be the upward normal of a segment there, and κ its curvature, positive where it bulges
//! downwards. A circle of curvature 1/ρ that touches the segment has its centre c where
//!
//! ```text
//! n·c - κ w/2 = ρ      w = |c|² - ρ²
//! ```
//!
//! which is a line for κ = 0, and else a circle about the centre of the arc. Seen along the mean
//! direction of both segments, with the half angle δ between them, `n = [±sin δ, cos δ]`: c is a
//! linear function of w, and w of the size ρ² tan² δ is the smaller root of a quadratic equation,
//! that of the fillet next to the corner. It touches at `(c - ρ n)/(1 - ρ κ)`. Nothing is the
//! difference of large numbers, however flat the corner.

use super::{
    Ellipse, Line, ParametricProfile, Piecewise, PiecewiseError, Placed, Placement, ProfileError,
    finite,
};
use crate::Real;
use std::sync::Arc;

const SLOPE: &str = "the slope after the corner";
/// Condition on slopes.
const SLOPED: &str = "finite; an upright wall is drawn by wall";
/// Condition on lengths along x.
const LONG: &str = "positive and finite; an upright wall is drawn by wall";

/// Body of an outline: a piece for each line and arc.
type Outlined<T> = Piecewise<T, Arc<dyn ParametricProfile<T>>>;

/// Builder of a body from lines and arcs, as they are dimensioned in a drawing.
///
/// It begins level, and goes to the right. Each segment continues in the direction of the last, but
/// after a [`corner`](Self::corner), which may be rounded or cut. Lengths are along x, of sharp
/// corners: a fillet takes from the segments on either side. A radius is positive for an arc that
/// bulges downwards, as that of an upper body, and negative for one that bulges upwards. A
/// symmetric body is drawn by its right half.
///
/// ```
/// use linecontact::profile::Outline;
/// use linecontact::{Contact, Control, Flat};
///
/// // A roller along its axis: flat for 4 mm either way, then with a crown of 200 mm, and at 5.5 mm
/// // an edge at 45°, rounded by 0.1 mm.
/// let crowned = Outline::from([0.0, 0.0]).line(4.0).arc(200.0, 1.5);
/// let roller = crowned.corner(1.0).fillet(0.1).line(0.3).mirrored().build()?;
/// let contact = Contact::new(&Flat, &roller)?.contact_modulus(115e3);
/// let solution = contact.solve(Control::Load(500.0))?;
/// assert!(solution.a() > 4.0 && solution.a() < 5.5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[must_use]
pub struct Outline<T> {
    start: [T; 2],
    drawn: Vec<Drawn<T>>,
    /// Corner in front of the segment to be drawn next: its slope behind, and its finish.
    next: (Option<T>, Option<Finish<T>>),
    /// Run of the wall in front of it.
    run: Option<T>,
    /// Right half whose mirror image is the left one.
    left: Option<Box<Self>>,
}

/// Segment as it is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Drawn<T> {
    /// `None` for a line.
    radius: Option<T>,
    length: T,
    /// Corner in front of it.
    corner: (Option<T>, Option<Finish<T>>),
}

/// Finish of a corner.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Finish<T> {
    /// Radius.
    Round(T),
    /// Lengths along x in front of the corner and behind it.
    Cut([T; 2]),
}

/// Piece of an outline: a [`Line`], or an arc of a [circle](Ellipse::circle).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment<T> {
    /// Radius of an arc, negative where it bulges upwards; `None` for a line.
    pub radius: Option<T>,
    /// Slope of a line; of an arc, at its middle angle, zero.
    pub slope: T,
    /// First and last x of a line, from `at`, or angles at the ends of an arc.
    pub ends: [T; 2],
    /// Origin of the line, or lowest or highest point of the circle.
    pub at: [T; 2],
}

impl<T: Real> Outline<T> {
    /// Starts an outline at a point, level.
    pub fn from(start: [T; 2]) -> Self {
        Self { start, drawn: Vec::new(), next: (None, None), run: None, left: None }
    }

    /// Draws a straight line over a length along x.
    pub fn line(self, length: T) -> Self {
        self.draw(None, length)
    }

    /// Draws an upright wall, up by a positive height or down by a negative one. The next segment
    /// is level, but after a [`corner`](Self::corner). Along x the wall takes 1.5e-8 of its height
    /// from that segment, if there is one: the root of the machine epsilon, as a curve has one
    /// height at each x. A body that is to turn needs a slanted wall, by a corner and a line.
    ///
    /// ```
    /// use linecontact::ParametricProfile;
    /// use linecontact::profile::Outline;
    ///
    /// // A land from -1 to 1, and a groove of depth 0.5 on either side.
    /// let half = Outline::from([0.0, 0.0]).line(1.0).wall(-0.5).line(2.0).wall(0.5).line(1.0);
    /// assert_eq!(half.mirrored().build()?.pieces(), 10);
    /// # Ok::<(), linecontact::PiecewiseError<f64>>(())
    /// ```
    pub fn wall(mut self, height: T) -> Self {
        let run = height.abs() * T::epsilon().sqrt();
        if !run.is_zero() {
            self.next.0 = Some(height / run);
            self = self.draw(None, run);
        }
        (self.next.0, self.run) = (Some(T::zero()), Some(run));
        self
    }

    /// Draws an arc of a circle over a length along x.
    pub fn arc(self, radius: T, length: T) -> Self {
        self.draw(Some(radius), length)
    }

    /// Makes a corner: the next segment starts with another slope. Of two corners in front of a
    /// segment the last counts, and so of fillets and chamfers.
    pub fn corner(mut self, slope: T) -> Self {
        self.next.0 = Some(slope);
        self
    }

    /// Rounds the corner in front of the next segment.
    pub fn fillet(mut self, radius: T) -> Self {
        self.next.1 = Some(Finish::Round(radius));
        self
    }

    /// Cuts the corner in front of the next segment by a straight line, which begins and ends at
    /// two lengths along x from it.
    pub fn chamfer(mut self, before: T, behind: T) -> Self {
        self.next.1 = Some(Finish::Cut([before, behind]));
        self
    }

    /// Makes the body symmetric: the mirror image of what is drawn stands to its left, in place of
    /// any other left half.
    pub fn mirrored(self) -> Self {
        let half = self.clone();
        self.left(half)
    }

    /// Draws another left half: the mirror image of `half`, which is drawn from the middle, too.
    pub fn left(mut self, half: Self) -> Self {
        self.left = Some(Box::new(half));
        self
    }

    fn draw(mut self, radius: Option<T>, length: T) -> Self {
        let run = self.run.take().filter(|&run| run < length);
        let length = run.map_or(length, |run| length - run);
        self.drawn.push(Drawn { radius, length, corner: std::mem::take(&mut self.next) });
        self
    }

    /// Joins the segments to a body.
    ///
    /// # Errors
    /// [`PiecewiseError::InSegment`] for a segment that cannot be drawn;
    /// [`PiecewiseError::NoPieces`]; as [`Piecewise::new`] if the halves do not meet.
    pub fn build(&self) -> Result<Outlined<T>, PiecewiseError<T>> {
        let body =
            |(i, segment): (usize, Segment<T>)| segment.body().map_err(PiecewiseError::in_piece(i));
        let segments = self.segments()?;
        let tolerance = Self::tolerance(&segments);
        let bodies = segments.into_iter().enumerate().map(body);
        Piecewise::with_tolerance(bodies.collect::<Result<_, _>>()?, tolerance)
    }

    /// Returns the tolerance of the joints: the rounding of circles that are far larger than the
    /// body.
    pub fn tolerance(segments: &[Segment<T>]) -> T {
        let sizes = segments.iter().map(|one| one.radius.map_or(T::one(), |r| r.abs() / one.run()));
        T::of(64.0) * T::epsilon() * sizes.fold(T::one(), |one, other| one.max(other))
    }

    /// Returns the pieces of the body, from left to right.
    ///
    /// # Errors
    /// [`PiecewiseError::InSegment`], with the number of the line or arc, as drawn, from 1. A
    /// corner, a fillet or a chamfer at the end misses the segment after it.
    pub fn segments(&self) -> Result<Vec<Segment<T>>, PiecewiseError<T>> {
        let mut found = Vec::<Segment<T>>::with_capacity(2 * self.drawn.len());
        let mut end = (self.start, T::zero());
        for (i, drawn) in self.drawn.iter().enumerate() {
            let fault = |source| PiecewiseError::InSegment { segment: i + 1, source };
            for start in end.0 {
                finite("a coordinate of the start", start, true, "finite").map_err(fault)?;
            }
            let mut segment = Segment::behind(end, drawn).map_err(fault)?;
            end = segment.end(1);
            if let Some(finish) = drawn.corner.1 {
                let before = found.last_mut();
                let between = before.and_then(|before| before.finish(&mut segment, finish));
                let must = "positive, at a corner, and leave a part of the segments on either side";
                found.push(between.ok_or_else(|| fault(finish.fault(must)))?);
            }
            found.push(segment);
        }
        let (name, must) = (SLOPE, "in front of a line or an arc");
        // Nothing need be behind a wall.
        let next = self.next.0.filter(|slope| self.run.is_none() || !slope.is_zero());
        let corner = next.map(|value| ProfileError::Parameter { name, value, must });
        if let Some(source) = self.next.1.map(|finish| finish.fault(must)).or(corner) {
            return Err(PiecewiseError::InSegment { segment: self.drawn.len() + 1, source });
        }
        let Some(left) = &self.left else { return Ok(found) };
        let left = left.segments()?;
        let mirrored = left.iter().rev().map(|segment| segment.mirrored(self.start[0]));
        Ok(mirrored.chain(found).collect())
    }
}

impl<T: Real> Finish<T> {
    /// Returns the error of a corner that cannot be finished so.
    fn fault(self, must: &'static str) -> ProfileError<T> {
        let (name, value) = match self {
            Self::Round(radius) => ("the radius of the fillet in front of it", radius),
            Self::Cut([one, other]) => ("a length of the chamfer in front of it", one.max(other)),
        };
        ProfileError::Parameter { name, value, must }
    }
}

impl<T: Real> Segment<T> {
    /// Draws a segment behind the end of the last, in its direction if there is no corner.
    fn behind((at, angle): ([T; 2], T), drawn: &Drawn<T>) -> Result<Self, ProfileError<T>> {
        let (zero, length) = (T::zero(), drawn.length);
        let angle = drawn.corner.0.map_or(angle, T::atan);
        finite(SLOPE, drawn.corner.0.unwrap_or(zero), true, SLOPED)?;
        finite("the length along x", length, length > zero, LONG)?;
        let Some(radius) = drawn.radius else {
            let slope = drawn.corner.0.unwrap_or_else(|| angle.tan());
            return Ok(Self { radius: None, slope, ends: [zero, length], at });
        };
        finite("the radius", radius, !radius.is_zero(), "finite and not zero")?;
        let from = angle * radius.signum();
        let reach = from.sin() + length / radius.abs();
        let (must, one) = ("so short that the arc does not turn back", T::one());
        finite("the length along x", length, reach <= one + T::of(4.0) * T::epsilon(), must)?;
        Ok(Self::arc_from(at, radius, [from, reach.min(one).asin()]))
    }

    fn arc_from(start: [T; 2], radius: T, ends: [T; 2]) -> Self {
        let arc = Self { radius: Some(radius), slope: T::zero(), ends, at: [T::zero(); 2] };
        let (from, _) = arc.end(0);
        Self { at: [start[0] - from[0], start[1] - from[1]], ..arc }
    }

    /// Returns the left or the right end, and the angle of the slope there.
    fn end(&self, side: usize) -> ([T; 2], T) {
        let ([x, y], k) = (self.at, self.ends[side]);
        let Some(radius) = self.radius else {
            return ([x + k, y + self.slope * k], self.slope.atan());
        };
        let (sin, cos) = k.sin_cos();
        let height = radius * sin * (sin / (T::one() + cos));
        ([x + radius.abs() * sin, y + height], k * radius.signum())
    }

    fn run(&self) -> T {
        self.end(1).0[0] - self.end(0).0[0]
    }

    /// Moves the left or the right end to another x, if that is between both ends.
    fn cut(&mut self, side: usize, x: T) -> Option<()> {
        let inside = x > self.end(0).0[0] && x < self.end(1).0[0];
        let k = x - self.at[0];
        self.ends[side] = self.radius.map_or(k, |radius| (k / radius.abs()).asin());
        inside.then_some(())
    }

    fn mirrored(&self, about: T) -> Self {
        let ([first, last], [x, y]) = (self.ends, self.at);
        Self { slope: -self.slope, ends: [-last, -first], at: [about + about - x, y], ..*self }
    }

    /// Shortens this segment and the next at their corner, and returns what goes between them.
    fn finish(&mut self, next: &mut Self, finish: Finish<T>) -> Option<Self> {
        let ([corner, height], behind) = next.end(0);
        match finish {
            Finish::Cut([before, behind]) => {
                self.cut(1, corner - before)?;
                next.cut(0, corner + behind)?;
                let (at, [to, height]) = (self.end(1).0, next.end(0).0);
                let (run, rise) = (to - at[0], height - at[1]);
                Some(Self { radius: None, slope: rise / run, ends: [T::zero(), run], at })
            }
            Finish::Round(radius) => {
                let curvatures = [&*self, next].map(|of| of.radius.map_or(T::zero(), T::recip));
                let touch = fillet(radius, [self.end(1).1, behind], curvatures)?;
                let [first, last] = touch.map(|(point, _)| corner + point[0]);
                self.cut(1, first)?;
                next.cut(0, last)?;
                let turns = (touch[1].1 - touch[0].1).signum();
                let start = [first, height + touch[0].0[1]];
                let angles = touch.map(|(_, angle)| angle * turns);
                Some(Self::arc_from(start, radius * turns, angles))
            }
        }
    }

    fn body(self) -> Result<Arc<dyn ParametricProfile<T>>, ProfileError<T>> {
        let to = Placement::default().shifted(self.at[0], self.at[1]);
        Ok(match self.radius {
            None => Arc::new(Placed::new(Line::new(self.slope, self.ends)?, to)?),
            Some(radius) => Arc::new(Placed::new(Ellipse::circle(radius, self.ends)?, to)?),
        })
    }
}

/// Point from the corner, and the angle of the slope there.
type Touch<T> = ([T; 2], T);

/// Finds where a fillet touches the segments in front of a corner and behind it, by the angles and
/// curvatures that they have at the corner.
fn fillet<T: Real>(radius: T, angles: [T; 2], curvatures: [T; 2]) -> Option<[Touch<T>; 2]> {
    let (half, quarter, two) = (T::of(0.5), T::of(0.25), T::of(2.0));
    let (mean, turn) = (half * (angles[0] + angles[1]), half * (angles[1] - angles[0]));
    let ((sin, cos), radius) = (turn.sin_cos(), radius * turn.signum());
    // The centre is [by_w[0] w, ρ/cos δ + by_w[1] w].
    let by_w = [
        quarter * (curvatures[0] - curvatures[1]) / sin,
        quarter * (curvatures[0] + curvatures[1]) / cos,
    ];
    let linear = T::one() - two * radius * by_w[1] / cos;
    let constant = radius * sin / cos * (radius * sin / cos);
    let square = by_w[0] * by_w[0] + by_w[1] * by_w[1];
    let root = (linear * linear - two * two * square * constant).sqrt();
    let w = two * constant / (linear + root);
    let (sin_mean, cos_mean) = mean.sin_cos();
    let touch = [0, 1].map(|side| {
        let (curvature, sin) = (curvatures[side], if side == 0 { sin } else { -sin });
        let scale = T::one() - radius * curvature;
        let along = (by_w[0] * w - radius * sin) / scale;
        let up = (radius * sin * sin / cos + by_w[1] * w) / scale;
        let angle = (curvature * along - sin).atan2(cos - curvature * up);
        let point = [along * cos_mean - up * sin_mean, along * sin_mean + up * cos_mean];
        (scale > T::zero()).then_some((point, mean + angle))
    });
    Some([touch[0]?, touch[1]?])
}
