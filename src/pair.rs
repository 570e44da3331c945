//! Two bodies that move: poses in, force and torque out.
//!
//! A simulator of rigid bodies asks at each step which force two bodies exert on each other where
//! they stand. Body 2 is seen in the frame of body 1, in which the load acts along y. The overlap
//! of the bodies along this axis is the [approach](crate::Solution::approach) of their references.

use crate::gap::{Sampler, Shape};
use crate::material::Foundation;
use crate::profile::{Convexity, CurvePoint, Piece, Placed, Placement, finite};
use crate::solution::is_steep;
use crate::{
    Body, Contact, ContactError, Control, Fallible, InputError, ParametricProfile, PlaneState,
    ProfileError, Real, References, Side, Solver,
};
use std::sync::Arc;

/// Step of the differences of a stiffness, as a share of the overlap and of the half-width: half of
/// the digits that the square of the step leaves.
const DIFFERENCE: f64 = 1e-4;

/// Overlap that counts as none, in units of the rounding of the heights.
const ROUNDING: f64 = 64.0;

/// Place of a body in the plane: its origin, and the angle by which it is turned counter-clockwise.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Pose<T> {
    /// X of the body's origin: a length.
    pub x: T,
    /// Y of the body's origin: a length.
    pub y: T,
    /// Angle, counter-clockwise: radians.
    pub angle: T,
}

impl<T: Real> Pose<T> {
    /// Returns a direction of the body in the plane.
    fn turned(&self, [x, y]: [T; 2]) -> [T; 2] {
        let (sin, cos) = self.angle.sin_cos();
        [cos * x - sin * y, sin * x + cos * y]
    }

    /// Returns this pose in the frame of another.
    fn seen_from(&self, other: &Self) -> Self {
        let back = Self { angle: -other.angle, ..*other };
        let (at, angle) = ([self.x - other.x, self.y - other.y], self.angle - other.angle);
        // To turn numbers that are not finite would mix them with the others.
        let is_known = at.iter().chain([&angle]).all(T::is_finite);
        let [x, y] = if is_known { back.turned(at) } else { at };
        Self { x, y, angle }
    }

    /// Checks that all its numbers are finite.
    fn check(&self) -> Result<(), ProfileError<T>> {
        finite("the x of a pose", self.x, true, "finite")?;
        finite("the y of a pose", self.y, true, "finite")?;
        finite("the angle of a pose", self.angle, true, "finite")
    }

    /// Returns the pose moved by a step in one of its numbers.
    fn moved(mut self, which: usize, step: T) -> Self {
        *[&mut self.x, &mut self.y, &mut self.angle][which] += step;
        self
    }
}

/// Force of two bodies on each other, per unit length; all of it zero if they are apart.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Wrench<T> {
    /// Largest overlap of the undeformed bodies along the y axis of body 1, a length; the gap
    /// between them, negative, if they are apart, and minus infinity if they lie beside each other.
    pub penetration: T,
    /// Force on body 2, that on body 1 with the other sign: force/length.
    pub force: [T; 2],
    /// Place in the plane where it acts, the centre of pressure on the surface of body 1; if the
    /// bodies are apart, where they would touch first.
    pub at: [T; 2],
    /// Torques on body 1 and on body 2, each about the body's own origin, counter-clockwise: force.
    pub torque: [T; 2],
    /// Number of places where the bodies touch.
    pub contacts: usize,
    /// True if the surfaces slope by more than 0.3 in the frame of body 1 where they touch, unlike
    /// half-planes: turn the frame, so that its y axis is about normal to the contact.
    pub is_steep: bool,
}

/// Two bodies that move, each in its own frame, with all that their force depends on but their
/// poses.
///
/// The load acts along the y axis of body 1: of a cam and its follower, body 1 is the follower.
/// Where the surfaces slope by s in its frame, the real force is normal to them: its part along x,
/// some s times the load, is left out, and so is its torque. A body that rolls over bumps, or into
/// the flank of a groove, is no case for a pair.
///
/// As for a [`Contact`], body 1 is below and body 2 above it, in the frame of body 1: each surface
/// is a curve without a turn, with the material of body 2 above it. A body that is turned until its
/// curve runs back, or further, upside down, is refused: of a cam that goes round, each step takes
/// the side that faces the follower, as a body of its own. A round body that rolls keeps its angle,
/// with its origin in the middle: its turn changes nothing.
///
/// The references stay where they are as the contact moves. Those at a depth then see it from
/// aside, and the force has a potential only about: of a punch 6 wide that rests on one of its
/// edges, ∂F/∂angle and ∂torque/∂y differ by 1.3 % with references 30 deep, and by 0.03 % with
/// references 300 deep or of a [`Reference::Length`](crate::Reference::Length).
///
/// A contact that reaches an end of the bodies is an error, and features narrower than those that
/// [`Contact::solve`] sees are not seen unless a [`resolution`](Self::resolution) asks for them.
///
/// ```
/// use linecontact::profile::Parabola;
/// use linecontact::{Flat, Material, Pair, Pose, Reference, References};
///
/// // A roller of 10 mm on a plate: mm, MPa, N/mm.
/// let roller = Parabola::new(10.0f64, [-1.0, 1.0])?;
/// let steel = Material::elastic(210e3, 0.3);
/// let to = References { x: 0.0, lower: Reference::Depth(30.0), upper: Reference::Disc(10.0) };
/// let mut pair = Pair::new(&Flat, &roller, (steel, steel), to);
/// let plate = Pose { x: 0.0, y: 0.0, angle: 0.0 };
/// let pressed = pair.at(plate, Pose { x: 3.0, y: -0.01, angle: 0.02 })?;
/// assert!(pressed.force[1] > 0.0 && pressed.force[0] == 0.0 && pressed.contacts == 1);
/// // The roller has turned by 0.02, and touches 0.02 R beside its lowest point.
/// assert!((pressed.at[0] - (3.0 - 0.2)).abs() < 1e-3);
/// let lifted = pair.at(plate, Pose { x: 3.0, y: 0.01, angle: 0.0 })?;
/// assert!(lifted.force == [0.0; 2] && lifted.penetration == -0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Pair<'b, T: Real> {
    bodies: [Shape<'b, T>; 2],
    materials: [Foundation<T>; 2],
    state: PlaneState,
    references: References<T>,
    resolution: Option<T>,
    solver: Solver<T>,
}

/// Force in the frame of body 1, with the lengths by which it changes.
struct Pressed<T> {
    wrench: Wrench<T>,
    /// Half-width of the contacts, and distances from the origin of body 2 along x and y.
    half_width: T,
    arm: [T; 2],
}

impl<'b, T: Real> Pair<'b, T> {
    /// Creates a pair in plane strain. The x of the references is counted from the origin of body 2
    /// along body 1, and kept within the bodies.
    pub fn new(
        lower: &'b dyn ParametricProfile<T>,
        upper: &'b dyn ParametricProfile<T>,
        materials: (impl Into<Foundation<T>>, impl Into<Foundation<T>>),
        references: References<T>,
    ) -> Self {
        Self::of([Shape::Lent(lower), Shape::Lent(upper)], materials, references)
    }

    /// Creates a pair with bodies that it owns.
    pub fn owned(
        lower: Arc<dyn ParametricProfile<T>>,
        upper: Arc<dyn ParametricProfile<T>>,
        materials: (impl Into<Foundation<T>>, impl Into<Foundation<T>>),
        references: References<T>,
    ) -> Self {
        Self::of([Shape::Owned(lower), Shape::Owned(upper)], materials, references)
    }

    fn of(
        bodies: [Shape<'b, T>; 2],
        materials: (impl Into<Foundation<T>>, impl Into<Foundation<T>>),
        references: References<T>,
    ) -> Self {
        let (state, resolution, solver) = (PlaneState::Strain, None, Solver::new());
        let materials = [materials.0.into(), materials.1.into()];
        Self { bodies, materials, state, references, resolution, solver }
    }

    /// Sets the plane state of both bodies.
    #[must_use]
    pub fn plane_state(self, state: PlaneState) -> Self {
        Self { state, ..self }
    }

    /// Sets the narrowest feature of the bodies to be seen, a length along the x axis of body 1: as
    /// [`Contact::resolution`]. Each step then samples all of the bodies.
    #[must_use]
    pub fn resolution(self, length: T) -> Self {
        Self { resolution: Some(length), ..self }
    }

    /// Returns the force of the bodies on each other where they stand. It starts from the contact
    /// found last, and then allocates nothing for smooth bodies that touch in one place; the pieces
    /// of body 2 are listed at each step.
    ///
    /// It is continuous where bodies touch, and where contacts appear or merge.
    ///
    /// # Errors
    /// [`InputError::Pose`] with the place of body 2 in the frame of body 1: if it turns back there
    /// or is upside down, or stands nowhere, and with each error of [`Contact::solve`] under the
    /// approach.
    pub fn at(&mut self, lower: Pose<T>, upper: Pose<T>) -> Result<Wrench<T>, ContactError<T>> {
        Ok(self.pressed(lower, upper)?.wrench)
    }

    /// Returns the stiffness of the bodies against each other: the derivatives of the force on body
    /// 2 along x and y and of the torque on it, in the rows, by x, y and angle of its pose, with
    /// the other sign, as for a spring. By central differences, about nine digits where the bodies
    /// are not far from their origins: six times [`at`](Self::at).
    ///
    /// # Errors
    /// As [`at`](Self::at).
    pub fn stiffness(
        &mut self,
        lower: Pose<T>,
        upper: Pose<T>,
    ) -> Result<[[T; 3]; 3], ContactError<T>> {
        let Pressed { wrench, half_width, arm } = self.pressed(lower, upper)?;
        let mut stiffness = [[T::zero(); 3]; 3];
        if wrench.contacts == 0 {
            return Ok(stiffness);
        }
        let [along, across] = arm.map(|arm| half_width + arm.abs());
        let turn = (wrench.penetration / along).min(half_width / across);
        let size = wrench.penetration.min(half_width);
        for (which, size) in [size, size, turn].into_iter().enumerate() {
            let step = T::of(DIFFERENCE) * size;
            let [before, after] =
                [-step, step].map(|step| self.at(lower, upper.moved(which, step)));
            let [before, after] =
                [before?, after?].map(|at| [at.force[0], at.force[1], at.torque[1]]);
            for (row, stiffness) in stiffness.iter_mut().enumerate() {
                stiffness[which] = (before[row] - after[row]) / (step + step);
            }
        }
        Ok(stiffness)
    }

    fn pressed(&mut self, lower: Pose<T>, upper: Pose<T>) -> Fallible<T, Pressed<T>> {
        let seen = upper.seen_from(&lower);
        let poses = lower.check().and(upper.check()).map_err(ContactError::from);
        let found = poses.and_then(|()| self.pressed_in_frame(&seen));
        let Pose { x, y, angle } = seen;
        let of_pose = |error| InputError::Pose { x, y, angle, source: Box::new(error) };
        let mut found = found.map_err(of_pose)?;
        let Wrench { force, at, .. } = &mut found.wrench;
        let [x, y] = lower.turned(*at);
        (*force, *at) = (lower.turned(*force), [lower.x + x, lower.y + y]);
        Ok(found)
    }

    /// Returns the force in the frame of body 1, from where body 2 is seen.
    fn pressed_in_frame(&mut self, seen: &Pose<T>) -> Fallible<T, Pressed<T>> {
        let zero = T::zero();
        let apart = |penetration: T, at: [T; 2]| {
            let (force, torque, contacts, is_steep) = ([zero; 2], [zero; 2], 0, false);
            let wrench = Wrench { penetration, force, at, torque, contacts, is_steep };
            Ok(Pressed { wrench, half_width: zero, arm: [zero; 2] })
        };
        let [lower, body] = self.bodies.each_ref().map(|shape| shape.profile());
        let placement = Placement::default().rotated(seen.angle).shifted(seen.x, seen.y);
        let [from, to] = body.domain().map(|k| body.at(k));
        let is_turned_over = (to.x > from.x) != (placement.point(to).x > placement.point(from).x);
        let must = "one at which body 2 is not upside down: its material would be below its curve; \
                    describe the side of it that faces body 1";
        finite("the angle of body 2", seen.angle, !is_turned_over, must)?;
        let (smooth, joined);
        let upper: &dyn ParametricProfile<T> = match Piece::first_of(body)? {
            None => {
                smooth = Placed::new(body, placement)?;
                &smooth
            }
            Some((count, _)) => {
                joined = Joined::new(body, count, placement)?;
                &joined
            }
        };
        let contact = match Contact::new(lower, upper) {
            Err(ContactError::Input(InputError::NoCommonRange { .. })) => {
                return apart(-T::one() / zero, [seen.x, seen.y]);
            }
            contact => {
                let [lower, upper] = self.materials.clone();
                contact?.materials(lower, upper, self.state)
            }
        };
        let contact = contact.with_resolution(self.resolution);
        let [place, gap] = self.solver.first_touch(&contact)?;
        let mut sampler = Sampler::default();
        let mut height = |x: T| sampler.body_height(&contact.gap, Body::Lower, x);
        if -gap <= T::of(ROUNDING) * T::epsilon() * (seen.x.abs() + seen.y.abs()) {
            return apart(-gap, [place, height(place)?]);
        }
        let [from, to] = contact.gap.range();
        let x = (seen.x + self.references.x).max(from).min(to);
        let references = References { x, ..self.references };
        let control = Control::Approach { approach: -gap, references };
        let solution = self.solver.solve(&contact, control)?;
        let (load, x) = (solution.load(), solution.centre_of_pressure()?);
        let at = [x, height(x)?];
        let slope = sampler.body_slope(&contact.gap, Body::Lower, x, Side::Left)?;
        let wrench = Wrench {
            penetration: -gap,
            force: [zero, load],
            at,
            torque: [-x * load, (x - seen.x) * load],
            contacts: solution.intervals().len(),
            is_steep: is_steep(slope) || solution.has_steep_limits(),
        };
        let arm = [x - seen.x, at[1] - seen.y];
        Ok(Pressed { wrench, half_width: solution.hull().half_width(), arm })
    }
}

/// Body of several pieces in the frame of another body.
struct Joined<'p, T: Real> {
    body: &'p dyn ParametricProfile<T>,
    parts: Vec<Part<'p, T>>,
}

/// Piece of a body in another place, with its range of k and its ends.
struct Part<'p, T: Real> {
    curve: Placed<T, &'p dyn ParametricProfile<T>>,
    k: [T; 2],
    ends: [CurvePoint<T>; 2],
}

impl<'p, T: Real> Joined<'p, T> {
    fn new(
        body: &'p dyn ParametricProfile<T>,
        count: usize,
        placement: Placement<T>,
    ) -> Result<Self, ProfileError<T>> {
        let part = |index: usize| {
            let Some(Piece { curve, k, ends }) = body.piece(index) else {
                return Err(ProfileError::Pieces { count, index });
            };
            let ends = ends.map(|end| placement.point(end));
            if ends[0].x < ends[1].x {
                return Ok(Part { curve: Placed::new(curve, placement)?, k, ends });
            }
            Err(ProfileError::TurnsBack { k: k[1], x: ends[1].x, domain: k })
        };
        Ok(Self { body, parts: (0..count).map(part).collect::<Result<_, _>>()? })
    }
}

impl<T: Real> ParametricProfile<T> for Joined<'_, T> {
    fn domain(&self) -> [T; 2] {
        self.body.domain()
    }

    fn at(&self, k: T) -> CurvePoint<T> {
        self.body.at(k)
    }

    fn convexity(&self) -> Convexity {
        self.body.convexity()
    }

    fn pieces(&self) -> usize {
        self.parts.len()
    }

    fn piece(&self, index: usize) -> Option<Piece<'_, T>> {
        let Part { curve, k, ends } = self.parts.get(index)?;
        Some(Piece { curve, k: *k, ends: *ends })
    }
}

impl<T: Real> std::fmt::Debug for Pair<'_, T> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { materials, state, references, .. } = self;
        let mut debug = f.debug_struct("Pair");
        debug.field("materials", materials).field("state", state).field("references", references);
        debug.finish_non_exhaustive()
    }
}
