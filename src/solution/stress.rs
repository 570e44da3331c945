//! Stress below the surface of either body.
//!
//! In the equations each body is an elastic half-plane with its surface at y = 0. At depth y the
//! pressure P and a traction q = μ P along the surface cause the stresses
//!
//! ```text
//! σ_x  = -2/π (A₂ + μ A₃),   σ_y  = -2/π (A₀ + μ A₁),   τ_xy = -2/π (A₁ + μ A₂)
//! A_k  = ∫ P(s) y³⁻ᵏ (x - s)ᵏ/((x - s)² + y²)² ds
//! ```
//!
//! (Johnson, *Contact Mechanics*, 1985, Eqs. 2.23a to c). Tension is positive, y points into the
//! body, and q acts on the surface in the direction of positive x. On the surface itself
//!
//! ```text
//! σ_x = -P - 2 μ/π PV∫ P(s)/(x - s) ds,   σ_y = -P,   τ_xy = -μ P
//! ```
//!
//! where the integral is κ g(x) inside the contact, by the equation of the contact.
//!
//! **Either body.** Without friction both bodies have the same stress at the same depth. With
//! friction the traction on the other body is opposite: if the upper body slides towards positive x
//! over the lower one, the lower has μ, and the upper -μ. Such a traction leaves the pressure
//! unchanged only for like bodies, or for small μ (Johnson, §7.2).
//!
//! **Layers.** A body with a [layer](crate::Layer) has a stress of its own:
//! [`Solution::subsurface_of`]. In the layer a sum over wavenumbers adds to the stress of the
//! half-plane, in the base a sum is all of it. The half-plane beside it has the stress above.
//!
//! **Periods.** Below bodies that repeat, W has `π/p cot(π(ζ - s)/p)` for `1/(ζ - s)`: its own
//! contacts as one period, and the rest at the nodes of the kernel. Of the mean pressure F/p a
//! half-plane has `σ_x = σ_y = -F/p`, as on its surface; what holds its ends may add a σ_x.
//!
//! **Accuracy.** The integrals follow from one function of ζ = x + i y and its derivative,
//!
//! ```text
//! W(ζ) = ∫ P(s)/(ζ - s) ds
//! A₀ + A₂ = -Im W,   A₂ - A₀ = -y Re W',   2 A₁ = y Im W',   A₁ + A₃ = Re W
//! ```
//!
//! (Muskhelishvili's potential), which the panels of the slope give in closed form. The stress is
//! good to some units in the last place of the largest pressure at any depth, next to kinks and
//! jumps of the slope too; below a jump its relative error is at least the rounding of x over y. At
//! a distance d from a free edge, the rounding of the limits adds `sqrt(L/d)` units. A value takes
//! about a microsecond for each contact with smooth bodies.
//!
//! ```
//! use linecontact::{Contact, Control, Curve, CurvePoint, Flat};
//!
//! let parabola = Curve::new([-1.0, 1.0], |k: f64| CurvePoint { x: k, y: k * k / 2.0, dx: 1.0, dy: k });
//! let contact = Contact::new(&Flat, &parabola)?;
//! let solution = contact.solve(Control::HalfWidth(0.1))?;
//! let peak = solution.peak()?.pressure;
//!
//! // The greatest shear lies below the surface (Johnson, Eq. 4.47).
//! let largest = solution.subsurface()?.max_shear()?;
//! assert!((largest.value / peak - 0.3002831).abs() < 1e-7);
//! assert!((largest.depth / 0.1 - 0.7861514).abs() < 1e-6);
//! # Ok::<(), linecontact::ContactError<f64>>(())
//! ```

mod largest;
mod layered;
mod tension;

use super::pressure_integral::{Density, Integrals};
use crate::gap::Sampler;
use crate::kernel::Periodic;
use crate::material::{Coating, checked_ratio};
use crate::quadrature::panels::CauchyTransform;
use crate::{
    Body, ContactError, EvaluationError, Fallible, InputError, Interval, Pressure, Real, Solution,
};
use layered::Layered;
use nalgebra::Complex;

/// Stress in plane strain: a pressure; tension is positive.
///
/// ```
/// use linecontact::stress::Stress;
///
/// let pure_shear = Stress { sigma_x: 0.0f64, sigma_y: 0.0, tau_xy: 2.0 };
/// assert_eq!(pure_shear.principal(), [2.0, -2.0]);
/// assert!((pure_shear.von_mises(0.3)? - 2.0 * 3.0f64.sqrt()).abs() < 1e-15);
/// # Ok::<(), linecontact::ContactError<f64>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Stress<T> {
    /// σ_x, parallel to the surface.
    pub sigma_x: T,
    /// σ_y, normal to the surface.
    pub sigma_y: T,
    /// τ_xy, with y into the body.
    pub tau_xy: T,
}

impl<T: Real> Stress<T> {
    /// Adds `share` times another stress.
    pub(super) fn with(self, share: T, other: Self) -> Self {
        Self {
            sigma_x: self.sigma_x + share * other.sigma_x,
            sigma_y: self.sigma_y + share * other.sigma_y,
            tau_xy: self.tau_xy + share * other.tau_xy,
        }
    }

    /// Returns the principal stresses in the plane, the larger one first.
    pub fn principal(&self) -> [T; 2] {
        let mean = T::of(0.5) * (self.sigma_x + self.sigma_y);
        let radius = self.max_shear();
        [mean + radius, mean - radius]
    }

    /// Returns the largest shear stress in the plane, half the difference of the principal
    /// stresses.
    pub fn max_shear(&self) -> T {
        (T::of(0.5) * (self.sigma_x - self.sigma_y)).hypot(self.tau_xy)
    }

    /// Returns σ_z = ν (σ_x + σ_y), the stress that keeps the strain plane.
    ///
    /// # Errors
    /// [`InputError::InvalidPoissonRatio`] for ν outside [0, 1/2], or NaN.
    pub fn sigma_z(&self, poisson: T) -> Result<T, ContactError<T>> {
        Ok(checked_ratio(poisson, None)? * (self.sigma_x + self.sigma_y))
    }

    /// Returns the von Mises equivalent stress in plane strain,
    ///
    /// ```text
    /// sqrt( (1 - ν + ν²)(σ_x + σ_y)² - 3 (σ_x σ_y - τ_xy²) ).
    /// ```
    ///
    /// # Errors
    /// [`InputError::InvalidPoissonRatio`] for ν outside [0, 1/2], or NaN.
    pub fn von_mises(&self, poisson: T) -> Result<T, ContactError<T>> {
        // The formula above, written as a sum of squares.
        let share = T::of(0.5) - checked_ratio(poisson, None)?;
        let sum = self.sigma_x + self.sigma_y;
        Ok((share * sum).hypot(T::of(3.0).sqrt() * self.max_shear()))
    }
}

/// Stress below a contact: [`Solution::subsurface`].
///
/// ```
/// use linecontact::profile::Parabola;
/// use linecontact::{Contact, Control, Flat};
///
/// let body = Parabola::new(1.0f64, [-1.0, 1.0])?;
/// let solution = Contact::new(&Flat, &body)?.solve(Control::Load(0.02))?;
/// let stress = solution.subsurface()?.at(0.0, 0.2)?;
/// // On the axis σ_y = -p₀ L/sqrt(L² + y²), here with y = L.
/// let largest = solution.peak()?.pressure;
/// assert!((stress.sigma_y / (-largest / 2.0f64.sqrt()) - 1.0).abs() < 1e-13);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct Subsurface<'p, T: Real> {
    solution: &'p Solution<'p, T>,
    pressure: Pressure<'p, T>,
    /// `None` of bodies that are apart.
    transform: Option<CauchyTransform<T>>,
    /// Layer on this body.
    layered: Option<Box<Layered<T>>>,
    /// Period of both bodies, and loads at places in it.
    row: Option<(Periodic<T>, Vec<[T; 2]>)>,
    /// Depths at which the largest stress is looked for.
    depths: [T; 2],
    friction: T,
    /// Stress below the contact under P*, if the contact sticks there: the traction is μ (P - P*).
    stick: Option<Box<Self>>,
}

/// Largest stress and its place.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct StressPeak<T> {
    /// Abscissa.
    pub x: T,
    /// Depth below the surface.
    pub depth: T,
    /// Stress at this place.
    pub value: T,
}

impl<T: Real> Solution<'_, T> {
    /// Prepares the stress below the surface of two half-planes, the same in both. With
    /// [`Panels`](crate::Panels) this takes no sample of the bodies; after another quadrature it
    /// samples panels on the contact.
    ///
    /// # Errors
    /// Those of [`pressure`](Self::pressure); [`EvaluationError::HalfPlanesOnly`] if a body has a
    /// layer, [`subsurface_of`](Self::subsurface_of) tells which one is meant, and with another
    /// kernel.
    pub fn subsurface(&self) -> Result<Subsurface<'_, T>, ContactError<T>> {
        T::subsurface(self, None)
    }

    /// Prepares the stress below the surface of one body: a half-plane, or one with a layer. There
    /// a stress costs more the wider the contacts are beside the thickness.
    ///
    /// ```
    /// use linecontact::profile::Parabola;
    /// use linecontact::{Base, Body, Contact, Control, Flat, Layer, Material, PlaneState};
    ///
    /// // A hard coating of 3 µm on steel: mm, MPa, N/mm.
    /// let steel = Material::elastic(210e3, 0.3);
    /// let (material, base) = (Material::elastic(400e3, 0.25), Base::HalfPlane(steel));
    /// let roller = Parabola::new(1.0, [-0.1, 0.1])?;
    /// let contact = Contact::new(&Flat, &roller)?;
    /// let coated = Layer { material, thickness: 3e-3, base };
    /// let contact = contact.materials(coated, steel, PlaneState::Strain);
    /// let solution = contact.solve(Control::HalfWidth(9e-3))?;
    /// let below = solution.subsurface_of(Body::Lower)?;
    /// // σ_x jumps at the interface.
    /// let (layer, base) = (below.at(0.0, 3e-3)?, below.at(0.0, 3e-3 * (1.0 + 1e-15))?);
    /// assert!((layer.sigma_y / base.sigma_y - 1.0f64).abs() < 1e-12);
    /// assert!((layer.sigma_x / base.sigma_x - 1.0).abs() > 0.1);
    /// // The largest stress in the steel.
    /// let base = below.within([3e-3, f64::INFINITY])?.max_von_mises(0.3)?;
    /// assert!(base.depth > 3e-3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Those of [`pressure`](Self::pressure); [`EvaluationError::HalfPlanesOnly`] with a kernel
    /// besides layers and periods, whose stress is not known.
    pub fn subsurface_of(&self, body: Body) -> Result<Subsurface<'_, T>, ContactError<T>> {
        T::subsurface(self, Some(body))
    }

    pub(crate) fn below(&self, body: Option<Body>) -> Fallible<T, Subsurface<'_, T>> {
        let layer = self.layer(body)?;
        let (pressure, zero) = (self.pressure()?, T::zero());
        let (mut layered, mut row) = (None, None);
        if let Some(bend) = self.gap.bend() {
            let kernel = bend.kernel_of_bodies();
            let loads = Integrals::new(self.solved())?.loads(kernel)?;
            let period = kernel.row.as_ref().map(|row| row.period);
            let below = |layer| Layered::new(layer, loads.clone(), self.hull(), period);
            layered = layer.map(|layer| Box::new(below(layer)));
            row = kernel.row.clone().map(|row| (row, loads));
        }
        Ok(Subsurface {
            solution: self,
            transform: if self.is_apart() { None } else { Some(pressure.cauchy_transform()?) },
            pressure,
            layered,
            row,
            depths: [zero, T::one() / zero],
            friction: zero,
            stick: None,
        })
    }

    /// Returns the layer of a body, if it has one. Both are meant if none is named.
    fn layer(&self, body: Option<Body>) -> Fallible<T, Option<Coating<T>>> {
        let bodies = self.elasticity.clone();
        let mut layers = bodies.map_or([None, None], |bodies| bodies.map(|body| body.layer));
        let is_known = self.gap.bend().is_none_or(|bend| bend.kernel_of_bodies().is_of_bodies);
        let quantity = match body.map(|body| layers[body as usize].take()) {
            Some(Some(layer)) if is_known && layer.is_of_stack() => {
                "the stress below several layers"
            }
            Some(layer) if is_known => return Ok(layer),
            None if is_known && layers.iter().all(Option::is_none) => return Ok(None),
            None if is_known => "the stress of both bodies at once (name the lower or upper one)",
            _ => "the stress below the surface (but that of layers)",
        };
        Err(EvaluationError::HalfPlanesOnly { quantity }.into())
    }
}

impl<T: Real> Subsurface<'_, T> {
    /// Adds a traction μ P on the surface of this body, in the direction of positive x; μ has
    /// either sign. Default 0.
    ///
    /// # Errors
    /// [`InputError::InvalidFriction`] if μ is not finite; [`EvaluationError::HalfPlanesOnly`] if
    /// either body has a layer, on which a traction changes the pressure, too.
    pub fn friction(self, coefficient: T) -> Result<Self, ContactError<T>> {
        if !coefficient.is_finite() {
            return Err(InputError::InvalidFriction { coefficient }.into());
        }
        if !coefficient.is_zero() && self.solution.layer(None).is_err() {
            let quantity = "the stress of friction";
            return Err(EvaluationError::HalfPlanesOnly { quantity }.into());
        }
        Ok(Self { friction: coefficient, ..self })
    }

    /// Looks for the largest shear and von Mises stress only from one depth to another, which may
    /// be infinite: in a hardened zone, in a layer, or in its base. Depths that begin at an
    /// interface begin in the base, and those that end there end in the layer.
    ///
    /// # Errors
    /// [`EvaluationError::NoStress`] for depths that do not rise from zero or more on, and in a
    /// rigid base.
    pub fn within(mut self, depths: [T; 2]) -> Result<Self, ContactError<T>> {
        self.depths = depths;
        let is_valid = depths[0] >= T::zero() && depths[1] > depths[0];
        if !is_valid || self.materials().is_empty() {
            return Err(EvaluationError::NoStress { depths }.into());
        }
        Ok(self)
    }

    /// Lists the depths of each material, of those at which stress is looked for.
    fn materials(&self) -> Vec<[T; 2]> {
        let [from, to] = self.depths;
        let whole = [T::zero(), T::one() / T::zero()];
        let mut depths = self.layered.as_ref().map_or(vec![whole], |layered| layered.materials());
        depths.iter_mut().for_each(|[top, bottom]| {
            (*top, *bottom) = (top.max(from), bottom.min(to));
        });
        depths.retain(|[top, bottom]| top < bottom);
        depths
    }

    /// Returns the stress at any x, at any depth from zero on. Depths below ε³ L count as zero.
    ///
    /// At the interface of a layer and its base σ_x jumps; at its very depth the stress is that of
    /// the layer, and just below, as at `depth * (1.0 + f64::EPSILON)`, that of the base.
    ///
    /// # Errors
    /// [`EvaluationError::AboveSurface`] for a depth that is negative, and for numbers that are not
    /// finite; [`EvaluationError::NoStress`] in a rigid base; [`EvaluationError::Singular`] on the
    /// surface where the pressure is infinite; on the surface, with friction, those of sampling the
    /// gap.
    pub fn at(&self, x: T, depth: T) -> Result<Stress<T>, ContactError<T>> {
        T::stress(self, x, depth)
    }

    pub(crate) fn stress(&self, x: T, depth: T) -> Fallible<T, Stress<T>> {
        let x = self.solution.gap.folded(x);
        let [mut normal, along] = self.parts(x, depth, !self.friction.is_zero())?;
        if let Some(layered) = &self.layered {
            normal = layered.stress(normal, x, depth)?;
        }
        let stress = normal.with(self.friction, along);
        match &self.stick {
            Some(stick) => Ok(stress.with(-self.friction, stick.parts(x, depth, true)?[1])),
            None => Ok(stress),
        }
    }

    /// Takes off the traction μ P* of the contact that sticks.
    pub(super) fn less(self, stick: Self) -> Self {
        Self { stick: Some(Box::new(stick)), ..self }
    }

    /// Returns the stress under the pressure, and the stress under an equal traction, which is
    /// valid on the surface only if `with_traction`.
    fn parts(&self, x: T, depth: T, with_traction: bool) -> Fallible<T, [Stress<T>; 2]> {
        if !(x.is_finite() && depth.is_finite() && depth >= T::zero()) {
            return Err(EvaluationError::AboveSurface { x, depth }.into());
        }
        let zero = T::zero();
        let Some(transform) = &self.transform else {
            return Ok([Stress { sigma_x: zero, sigma_y: zero, tau_xy: zero }; 2]);
        };
        // All digits of the depth are lost there.
        if depth <= T::epsilon().powi(3) * self.hull().half_width() {
            return self.on_surface(transform, x, with_traction);
        }
        let ([pull, by_depth], half) = (self.potential(transform, x, depth), T::of(0.5));
        let a0 = half * (by_depth.re - pull.im);
        let a1 = half * by_depth.im;
        let (a2, a3) = (-half * (by_depth.re + pull.im), pull.re - a1);
        let [a0, a1, a2, a3] = [a0, a1, a2, a3].map(|a| -T::of(2.0) * T::frac_1_pi() * a);
        let normal = Stress { sigma_x: a2, sigma_y: a0, tau_xy: a1 };
        Ok([normal, Stress { sigma_x: a3, sigma_y: a1, tau_xy: a2 }])
    }

    /// Returns W and `y W'` of all periods.
    fn potential(&self, transform: &CauchyTransform<T>, x: T, depth: T) -> [Complex<T>; 2] {
        let [mut pull, mut by_depth] = transform.at(x, depth);
        if let Some((row, loads)) = &self.row {
            for &[s, load] in loads {
                let [value, slope] = row.below(x - s, depth);
                (pull, by_depth) = (pull + value * load, by_depth + slope * (load * depth));
            }
        }
        [pull, by_depth]
    }

    /// Returns the limits of both stresses as the depth goes to zero.
    fn on_surface(
        &self,
        transform: &CauchyTransform<T>,
        x: T,
        with_traction: bool,
    ) -> Fallible<T, [Stress<T>; 2]> {
        let touches = self.solution.intervals().iter().any(|on| x >= on.left && x <= on.right);
        let mut pressure = [T::zero()];
        if Interval::find(self.solution.intervals(), x).1.is_some() {
            self.pressure.values(&[x], &mut pressure)?;
            // Next to an edge a rule without panels has no correct digit.
            if self.solution.integrator.panels().is_none() && pressure[0].is_finite() {
                let depth = T::epsilon().powi(3) * self.hull().half_width();
                pressure = [-T::frac_1_pi() * transform.at(x, depth)[0].im];
            }
        }
        let [pressure] = pressure;
        if self.solution.solved().is_held(x) || !pressure.is_finite() {
            return Err(EvaluationError::Singular { x }.into());
        }
        let pull = if !with_traction {
            T::zero()
        } else if touches {
            // A rounded edge may lie beyond the end of a body.
            let gap = &self.solution.gap;
            let [from, to] = gap.range();
            let bent = gap.bend().map_or(T::zero(), |bend| bend.slope(x));
            self.solution.kappa * Sampler::default().slope(gap, x.max(from).min(to))? + bent
        } else {
            self.potential(transform, x, T::zero())[0].re
        };
        let zero = T::zero();
        let along = T::of(2.0) * T::frac_1_pi() * pull;
        let normal = Stress { sigma_x: -pressure, sigma_y: -pressure, tau_xy: zero };
        Ok([normal, Stress { sigma_x: -along, sigma_y: zero, tau_xy: -pressure }])
    }

    /// Returns the interval from the first limit of the contacts to the last.
    pub fn hull(&self) -> Interval<T> {
        self.solution.hull()
    }
}

impl<T: Real> std::fmt::Debug for Subsurface<'_, T> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let mut debug = f.debug_struct("Subsurface");
        debug.field("interval", &self.hull()).field("friction", &self.friction);
        debug.finish_non_exhaustive()
    }
}
