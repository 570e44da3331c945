//! Approach and stiffness of the bodies.
//!
//! The displacement of the surface of a half-plane grows like a logarithm with the distance of the
//! point it is measured from, so that it needs a point of reference. With `M = E/(1 - ν²)` of body
//! i, and `ξ = x - s`, its surface at x approaches the reference by
//!
//! ```text
//! δ_i(x) = 1/(π M_i) ∫ P(s) k_i(ξ) ds
//! k = ln(1 + d²/ξ²) - d²/((1 - ν)(d² + ξ²))    the point at depth d below x
//! k = 2 ln(2R/|ξ|) - 2                          the centre of a disc, loaded at the opposite point
//! k = 2 ln(ℓ/|ξ|)                               any other constant
//! ```
//!
//! The first is the strain below the surface (Johnson, *Contact Mechanics*, 1985, Eqs. 2.23)
//! integrated over the depth; for `d` much longer than the contact it is the formula of Weber and
//! Banaschek (1953) for gear teeth. The second is Johnson's (§5.6). In plane stress M is E, and ν
//! is `ν/(1 + ν)`.
//!
//! **The approach of the bodies** δ is the decrease in distance of the two references since first
//! touch: `δ = δ₁ + δ₂ + h(x) - h_first - gap(x)` with h the gap before loading, `h_first` its
//! least value, and `gap(x)` the gap under load, zero inside a contact. The logarithm need not be
//! integrated for it. Averaged over a contact j of centre c and half-width L with the weight
//! `1/(π sqrt(L² - (x - c)²))`, `ln|ξ|` is
//!
//! ```text
//! G(s) = ln(L/2) inside contact j,    ln((|s - c| + sqrt((s - c)² - L²))/2) outside
//! ```
//!
//! As the gap under load is zero in contact j, the formula for δ may be averaged over it. With the
//! contact that has `h_first` as contact j,
//!
//! ```text
//! δ = <h> - h_first + Σ 1/(π M_i) ∫ P (k_i(ξ) + 2 ln|ξ| - 2 G) ds
//! ```
//!
//! with no singular term.
//!
//! **Layers.** A wave of pressure of wavenumber ω presses the surface of a layer down K times as
//! far as that of a half-plane of its material, and the reference V times; in the half-plane it
//! would be V₀ times. With M and ν of the layer and `Z = exp(iωx) ∫ P(s) exp(-iωs) ds`,
//!
//! ```text
//! ∫ P (k_i + 2 ln|ξ|) ds + 2 ∫ (F (K - 1) - Re(Z) (V - V₀))/ω dω     over ω > 0
//! ```
//!
//! takes the place of the first integral, h is the gap of the [bent](crate::kernel) bodies, and the
//! approach of one surface is less by `2/(π M_i) ∫ (K - 1) (F - Re(Z))/ω dω`. For a length ℓ, V -
//! V₀ is `(K(0) - 1) exp(-ωℓ)`, and Z is F: far beside the contact the surface is that of the base.
//! On a rigid base V is zero, whatever the reference. In a row of contacts the wavenumbers are
//! `2πn/p`, and the logarithm is `ln|2 sin(πξ/p)|`: zero on average, as all waves are.
//!
//! **Stiffness**: `dδ/dF` is the sum alone, with the
//! [rate](crate::LoadRates) `∂P/∂F` of the pressure in place of P; the stiffness `dF/dδ` is exact,
//! without differences.

use super::ContactState;
use super::load_rates::LoadRates;
use super::pressure_integral::{Density, Integrals};
use super::solved::Solved;
use super::undeformed_gap::UndeformedGap;
use crate::gap::{Gap, Sampler};
use crate::kernel::{Bend, Periodic, RegularKernel, wavenumbers};
use crate::material::{Coating, Elasticity};
use crate::quadrature::{Engine, Panels};
use crate::{
    Body, ContactError, Fallible, InputError, Interval, Real, Reference, References, Side,
    Solution, SolveError,
};

/// Distances by which two bodies come together under load.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Approach<T> {
    /// δ, the decrease in distance of the two references since the bodies, at the same tilt, just
    /// touched: a length.
    pub bodies: T,
    /// δ₁, the approach of the surface of body 1 at x to its own reference: a length, 0 for a rigid
    /// body.
    pub lower: T,
    /// δ₂, the approach of the surface of body 2 at x to its own reference: a length.
    pub upper: T,
}

impl<T: Real> Solution<'_, T> {
    /// Returns the approach of the bodies, to about 1e-12 of the integral of the logarithm.
    ///
    /// It takes no longer than some ten pressures, and no evaluation with
    /// [`Panels`](crate::Panels). Several contacts take longer, as do depths of less than three
    /// half-widths below a contact with breakpoints. With a layer the contact is sampled once more,
    /// before the bend.
    ///
    /// Each body approaches a reference of its own: on a rigid base that is the base, and
    /// [`References`] are not used; beside it the other body has its own. If bodies repeat with a
    /// [period](crate::Contact::period), it is the mean plane of their surfaces.
    ///
    /// ```
    /// use linecontact::profile::Parabola;
    /// use linecontact::{Contact, Control, Flat, Material, PlaneState, Reference, References};
    ///
    /// // A steel roller of 10 mm between steel blocks, of which this is one: mm, MPa, N/mm.
    /// let roller = Parabola::new(10.0f64, [-1.0, 1.0])?;
    /// let steel = Material::elastic(210e3, 0.3);
    /// let contact = Contact::new(&Flat, &roller)?.materials(steel, steel, PlaneState::Strain);
    /// let solution = contact.solve(Control::Load(500.0))?;
    /// let to = References { x: 0.0, lower: Reference::Depth(20.0), upper: Reference::Disc(10.0) };
    /// let approach = solution.approach(&to)?;
    /// assert!((approach.lower + approach.upper - approach.bodies).abs() < 1e-15);
    ///
    /// // Johnson, §5.6.
    /// let share = 500.0 * 0.91 / (std::f64::consts::PI * 210e3);
    /// let johnson = share * (2.0 * (40.0 / solution.a()).ln() - 1.0);
    /// assert!((approach.upper / johnson - 1.0).abs() < 1e-13);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`InputError::NoMaterials`] without [`Contact::materials`](crate::Contact::materials);
    /// [`InputError::InvalidReference`]; [`SolveError::OutsideBodies`] if x is not finite; those of
    /// [`pressure`](Self::pressure);
    /// [`EvaluationError::Integral`](crate::EvaluationError::Integral);
    /// [`EvaluationError::HalfPlanesOnly`](crate::EvaluationError::HalfPlanesOnly) with a kernel
    /// besides layers.
    pub fn approach(&self, references: &References<T>) -> Result<Approach<T>, ContactError<T>> {
        T::approach(self, references)
    }

    /// Returns the stiffness dF/dδ of the bodies against each other, a pressure: the derivative of
    /// the load per unit length by their [approach](Self::approach), at a fixed tilt. For one
    /// contact it takes no longer than a pressure.
    ///
    /// The approach of half-planes grows with the load, for all depths and for discs larger than
    /// the contact. (The surface of one body need not approach a point close below it,
    /// `Approach::upper`: outside the contact it may be lifted while the gap closes.) A stiff
    /// coating that bends may grow thicker, and both bodies recede from a point in it: a negative
    /// stiffness.
    ///
    /// ```
    /// use linecontact::profile::Parabola;
    /// use linecontact::{Contact, Control, Flat, Material, PlaneState, Reference, References};
    ///
    /// let roller = Parabola::new(10.0f64, [-1.0, 1.0])?;
    /// let steel = Material::elastic(210e3, 0.3);
    /// let contact = Contact::new(&Flat, &roller)?.materials(Material::Rigid, steel, PlaneState::Strain);
    /// let solution = contact.solve(Control::Load(500.0))?;
    /// let disc = Reference::Disc(10.0);
    /// let stiffness = solution.stiffness(&References { x: 0.0, lower: disc, upper: disc })?;
    /// // From Johnson's formula, with da/dF = a/(2 F).
    /// let exact = std::f64::consts::PI * 210e3 / 0.91 / (2.0 * (40.0 / solution.a()).ln() - 2.0);
    /// assert!((stiffness / exact - 1.0).abs() < 1e-13);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`approach`](Self::approach), and those of [`load_rates`](Self::load_rates).
    pub fn stiffness(&self, references: &References<T>) -> Result<T, ContactError<T>> {
        Ok(T::one() / T::approach_rate(self, references)?)
    }
}

impl<T: Real> Solution<'_, T> {
    /// Returns the displacement of the surface of a body by the pressure, at any x, beside the
    /// contact and beyond the ends of the bodies, too: a length along y, into the body. It is that
    /// against the body's [reference](References), zero there, and `Approach::lower` or
    /// `Approach::upper` at the x of the references.
    ///
    /// ```
    /// use linecontact::profile::Parabola;
    /// use linecontact::{
    ///     Body, Contact, Control, Flat, Material, PlaneState, Reference, References,
    /// };
    ///
    /// let roller = Parabola::new(10.0f64, [-1.0, 1.0])?;
    /// let steel = Material::elastic(210e3, 0.3);
    /// let contact = Contact::new(&Flat, &roller)?.materials(steel, steel, PlaneState::Strain);
    /// let solution = contact.solve(Control::Load(500.0))?;
    /// let depth = Reference::Depth(20.0);
    /// let to = References { x: 0.0, lower: depth, upper: depth };
    /// let [middle, limit] =
    ///     [0.0, solution.a()].map(|x| solution.displacement(Body::Lower, x, &to));
    /// // Half of the height of the roller at the limit: both bodies are alike.
    /// let height = solution.a() * solution.a() / 20.0;
    /// assert!(((middle? - limit?) / (0.5 * height) - 1.0).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`approach`](Self::approach).
    pub fn displacement(
        &self,
        body: Body,
        x: T,
        references: &References<T>,
    ) -> Result<T, ContactError<T>> {
        T::displacement(self, body, x, references)
    }
}

/// Contact and both bodies with their references: all data of the approach.
pub(crate) struct Approaching<'s, T: Real> {
    solved: Solved<'s, T>,
    x: T,
    bodies: [Referred<T>; 2],
}

/// Body with its reference.
#[derive(Clone)]
struct Referred<T> {
    body: Elasticity<T>,
    /// Depth of the reference, or the length in the logarithm.
    length: T,
    is_depth: bool,
}

/// Returns a place on or beside the bodies, in the period that was solved.
fn place<T: Real>(gap: &Gap<'_, T>, x: T) -> Fallible<T, T> {
    let (x, range) = (gap.folded(x), gap.range());
    if x.is_finite() { Ok(x) } else { Err(SolveError::OutsideBodies { x, range }.into()) }
}

/// Contact in which the bodies touched first, by its number, and the heights of the gap there.
struct First<T> {
    contact: usize,
    heights: UndeformedGap<T>,
}

impl<'s, T: Real> Approaching<'s, T> {
    pub fn new(
        solved: Solved<'s, T>,
        bodies: Option<&[Elasticity<T>; 2]>,
        references: &References<T>,
    ) -> Result<Self, ContactError<T>> {
        let bodies = bodies.ok_or(InputError::NoMaterials)?;
        let kernel = solved.gap.bend().map(Bend::kernel_of_bodies);
        if kernel.is_some_and(|kernel| !kernel.is_of_bodies) {
            solved.of_half_planes("the approach (but that of layers)")?;
        }
        let References { x, lower, upper } = *references;
        let x = place(solved.gap, x)?;
        let half_width = solved.found.interval.half_width();
        let period = kernel.and_then(|kernel| kernel.row.as_ref()).map(|row| row.period);
        let referred = |body: &Elasticity<T>, reference| {
            // A row has its mean planes, a rigid base is a reference, and a rigid body needs none.
            let own = match (period, &body.layer) {
                (Some(period), _) => Some(period / T::two_pi()),
                (None, Some(layer)) => layer.is_on_rigid().then_some(layer.thickness),
                (None, None) => body.compliance.is_zero().then_some(half_width),
            };
            let (given, length, is_depth) = match reference {
                Reference::Depth(depth) => (depth, depth, true),
                Reference::Disc(radius) => (radius, T::of(2.0) * radius / T::e(), false),
                Reference::Length(length) => (length, length, false),
            };
            if let Some(length) = own {
                return Ok(Referred { body: body.clone(), length, is_depth: false });
            }
            // The formula of the disc is for contacts that are small beside it.
            let is_small = matches!(reference, Reference::Disc(radius) if radius <= half_width);
            if is_small || !(given.is_finite() && given > T::zero()) {
                return Err(ContactError::from(InputError::InvalidReference { length: given }));
            }
            if is_depth && body.layer.as_ref().is_some_and(Coating::is_of_stack) {
                solved.of_half_planes("the approach to a depth below several layers")?;
            }
            Ok(Referred { body: body.clone(), length, is_depth })
        };
        let bodies = [referred(&bodies[0], lower)?, referred(&bodies[1], upper)?];
        Ok(Self { solved, x, bodies })
    }

    fn first(&self) -> Fallible<T, First<T>> {
        let heights = |contact| UndeformedGap::new(self.solved, contact, self.x);
        let mut first = First { contact: 0, heights: heights(0)? };
        if let Some(bend) = self.solved.gap.bend() {
            // The bodies touched before they were bent.
            let (contact, least) = self.first_before_bend()?;
            let (left, kappa) = (self.solved.contacts()[contact].left, self.solved.kappa);
            first = First { contact, heights: heights(contact)? };
            first.heights.least = least + bend.height(left) / kappa;
            return Ok(first);
        }
        if let Some(several) = self.solved.several() {
            let lowest = |at: &First<T>| several.height(at.contact, Side::Left) + at.heights.least;
            for contact in 1..self.solved.contacts().len() {
                let other = First { contact, heights: heights(contact)? };
                first = if lowest(&other) < lowest(&first) { other } else { first };
            }
        }
        Ok(first)
    }

    /// Returns the contact in which the bodies touched before they were bent, and their least
    /// height there above that at its left limit.
    fn first_before_bend(&self) -> Fallible<T, (usize, T)> {
        let Solved { gap, found, .. } = self.solved;
        let before = gap.as_described();
        let before = &before.tilted(found.tilt);
        let (mut integrator, mut sampler) = (Engine::new(&Panels::FULL)?, Sampler::default());
        let mut first: Option<(usize, T, T)> = None;
        for (contact, &interval) in self.solved.contacts().iter().enumerate() {
            integrator.prepare(before, interval)?;
            let found = &ContactState { interval, ..*found };
            let solved = Solved { gap: before, integrator: &integrator, found, ..self.solved };
            let least = UndeformedGap::new(solved, 0, self.x)?.least;
            let left = if self.solved.contacts().len() > 1 {
                sampler.height(before, interval.left)?
            } else {
                T::zero()
            };
            if first.is_none_or(|(_, _, lowest)| left + least < lowest) {
                first = Some((contact, least, left + least));
            }
        }
        Ok(first.map_or((0, T::zero()), |(contact, least, _)| (contact, least)))
    }

    /// Returns the unit of all lengths in logarithms.
    fn scale(&self) -> T {
        self.solved.contacts()[0].half_width()
    }

    /// Sums over both bodies `1/(π M_i)` times the integral of the body, less twice the logarithm.
    fn both(&self, smooth: [T; 2], logarithm: T) -> T {
        self.of_each(smooth, logarithm).into_iter().fold(T::zero(), |sum, of| sum + of)
    }

    /// Returns the same of each body.
    fn of_each(&self, smooth: [T; 2], logarithm: T) -> [T; 2] {
        let of = |i: usize| {
            let all = self.bodies[i].body.compliance * T::frac_1_pi();
            all * (smooth[i] - logarithm - logarithm)
        };
        [of(0), of(1)]
    }

    /// Returns `k_i + 2 ln|ξ|` of each body.
    fn kernels(&self, distance: T) -> [T; 2] {
        let (scale, two) = (self.scale(), T::of(2.0));
        self.bodies.each_ref().map(|&Referred { ref body, length, is_depth }| {
            if !is_depth {
                return two * (length / scale).ln();
            }
            let radius = length.hypot(distance);
            let down = length / radius;
            two * (radius / scale).ln() - down * down / (T::one() - body.ratio)
        })
    }

    /// Returns `∫ p (k_i + 2 ln|ξ|) ds` of each body, as a half-plane of its surface's material.
    fn of_half_planes(&self, integrals: &Integrals<T, impl Density<T>>) -> Fallible<T, [T; 2]> {
        let constant = self.kernels(T::zero()).map(|kernel| integrals.load * kernel);
        if !self.bodies.iter().any(|to| to.is_depth) {
            return Ok(constant);
        }
        if let Some(potential) = integrals.density.potential()? {
            let below = |i: usize| {
                let Referred { ref body, length, is_depth } = self.bodies[i];
                if !is_depth {
                    return Some(constant[i]);
                }
                let [potential, pull] = potential.at(self.x, length)?;
                let logarithm = potential - integrals.load * self.scale().ln();
                Some(logarithm + logarithm + pull / (T::one() - body.ratio))
            };
            if let (Some(lower), Some(upper)) = (below(0), below(1)) {
                return Ok([lower, upper]);
            }
        }
        let kernels = |distance, strength| self.kernels(distance).map(|kernel| strength * kernel);
        integrals.over(self.x, kernels)
    }

    /// Returns `∫ p (k_i + 2 ln|ξ|) ds` of each body, and `2 ∫ p R_i ds` at the references.
    fn smooth(&self, integrals: &Integrals<T, impl Density<T>>) -> Fallible<T, [[T; 2]; 2]> {
        let mut sums = [self.of_half_planes(integrals)?, [T::zero(); 2]];
        let Some(bend) = self.solved.gap.bend() else { return Ok(sums) };
        let kernel = bend.kernel_of_bodies();
        let loads = integrals.loads(kernel)?;
        for (i, of) in self.bodies.iter().enumerate() {
            let [smooth, bent] = self.of_layer(of, kernel.row.as_ref(), &loads);
            sums[0][i] += smooth + smooth;
            sums[1][i] = bent + bent;
        }
        Ok(sums)
    }

    /// Returns the sums of a body over wavenumbers, given the pressures as loads.
    fn of_layer(&self, of: &Referred<T>, row: Option<&Periodic<T>>, loads: &[[T; 2]]) -> [T; 2] {
        let sum = |of: &dyn Fn(T) -> T| {
            loads.iter().fold(T::zero(), |sum, &[s, load]| sum + load * of(self.x - s))
        };
        let load = sum(&|_| T::one());
        let bent = row.map_or(T::zero(), |row| sum(&|distance| row.height(distance, T::zero())));
        let Some(layer) = &of.body.layer else { return [T::zero(), bent] };
        let Referred { length, is_depth, .. } = *of;
        // The mean planes of a row do not depend on the base.
        let at_zero = if row.is_some() { T::zero() } else { layer.at_zero };
        let logarithm = if is_depth { T::zero() } else { (length / layer.thickness).ln() };
        let mut sums = [load * at_zero * logarithm, bent];
        let depth = if is_depth { length } else { layer.thickness };
        // As the interface sees it, at half the distance of its image.
        let lengths = [layer.thickness, layer.longest().max(depth)];
        let far = loads.iter().fold(layer.thickness, |far, [s, _]| far.max((self.x - *s).abs()));
        wavenumbers(lengths, row.map(|row| row.period), [T::zero(), far], |omega, weight| {
            let (weight, excess) = (weight / omega, layer.excess(omega * layer.thickness));
            let wave = sum(&|distance| (omega * distance).cos());
            let below = if is_depth {
                wave * layer.displacement(omega, depth)
            } else {
                load * at_zero * (-omega * depth).exp()
            };
            sums[0] += weight * (load * excess - below);
            sums[1] += weight * excess * (load - wave);
        });
        sums
    }

    /// Returns `∫ p G ds` of a contact.
    fn mean_logarithm(
        &self,
        integrals: &Integrals<T, impl Density<T>>,
        on: Interval<T>,
    ) -> Fallible<T, T> {
        let (contacts, half) = (self.solved.contacts(), T::of(0.5));
        let (scale, half_width) = (self.scale(), on.half_width());
        let inside = (half * half_width / scale).ln();
        if contacts.len() == 1 {
            return Ok(integrals.load * inside);
        }
        let [mean] = integrals.over_as_of(T::zero(), on.centre(), |own, distance, strength| {
            let from = distance.abs();
            let root = ((from - half_width).max(T::zero()) * (from + half_width)).sqrt();
            [strength * if own { inside } else { (half * (from + root) / scale).ln() }]
        })?;
        Ok(mean)
    }

    /// Returns the approach of the bodies alone, and its rate dδ/dF. Fails if it falls.
    pub fn with_rate(&self) -> Result<[T; 2], ContactError<T>> {
        let (rate, load, quantity) = (self.rate()?, self.solved.found.load, "approach");
        if !(rate > T::zero() && rate.is_finite()) {
            return Err(SolveError::Falls { quantity, load, rate }.into());
        }
        let integrals = Integrals::new(self.solved)?;
        let [smooth, _] = self.smooth(&integrals)?;
        Ok([self.of_bodies(&integrals, smooth, &self.first()?)?, rate])
    }

    /// Returns the approach of the bodies from the integrals of the kernels.
    fn of_bodies(
        &self,
        integrals: &Integrals<T, impl Density<T>>,
        smooth: [T; 2],
        first: &First<T>,
    ) -> Fallible<T, T> {
        let UndeformedGap { mean, least, .. } = first.heights;
        let logarithm = self.mean_logarithm(integrals, self.solved.contacts()[first.contact])?;
        Ok(mean - least + self.both(smooth, logarithm))
    }

    /// Returns dδ/dF: with ∂P/∂F any contact may be the first.
    pub fn rate(&self) -> Result<T, ContactError<T>> {
        if self.solved.found.apart.is_some() {
            return Ok(T::one() / T::zero());
        }
        let (contacts, bend) = (self.solved.contacts(), self.solved.gap.bend());
        if let ([on], None) = (contacts, bend) {
            LoadRates::limits_of_one(self.solved)?;
            let punches = self.bodies.each_ref().map(|of| self.of_punch(*on, of));
            return Ok(self.both(punches, T::zero()));
        }
        let rates = LoadRates::of(self.solved)?;
        let integrals = Integrals::of_unit_load(&rates, contacts);
        let logarithm = self.mean_logarithm(&integrals, contacts[0])?;
        let [smooth, _] = self.smooth(&integrals)?;
        let rate = self.both(smooth, logarithm);
        let Some(bend) = bend else { return Ok(rate) };
        let loads = integrals.loads(bend.kernel_of_bodies())?;
        Ok(rate - bend.mean_height(&loads, contacts[0]) / self.solved.kappa)
    }

    /// Returns `∫ p (k + 2 ln|ξ| - 2 G) ds` for the pressure p of a flat punch on one contact,
    /// under a unit load. Take the ellipse through the reference with its foci at the limits, and η
    /// the logarithm of the sum of its half-axes over L: the first part is 2 η; the second is the
    /// real part of `d ∂/∂d`.
    fn of_punch(&self, on: Interval<T>, of: &Referred<T>) -> T {
        let Referred { ref body, length: depth, is_depth } = *of;
        let (one, two, half_width, x) = (T::one(), T::of(2.0), on.half_width(), self.x);
        if !is_depth {
            return two * (two * depth / half_width).ln();
        }
        let along = [x - on.left, on.right - x];
        let radii = along.map(|along| along.hypot(depth));
        // r less the distance along x, without cancellation.
        let excess = |i: usize| {
            let (along, radius) = (along[i], radii[i]);
            let beside = along > T::zero();
            if beside { depth * (depth / (radius + along)) } else { radius - along }
        };
        // cosh η - 1, with cosh η = (r₁ + r₂)/(2 L), and sinh η.
        let rise = (excess(0) + excess(1)) / (two * half_width);
        let sinh = rise.sqrt() * (rise + two).sqrt();
        // Next to the surface the displacement is zero to rounding.
        if sinh.is_zero() {
            return sinh;
        }
        let eta = (rise + sinh).ln_1p();
        // d ∂η/∂d
        let turn = (depth / radii[0] + depth / radii[1]) * (depth / (two * half_width) / sinh);
        two * eta - turn / (one - body.ratio)
    }

    pub fn of_all(&self) -> Result<Approach<T>, ContactError<T>> {
        if let Some(separation) = self.solved.found.apart {
            return Ok(Approach { bodies: -separation, lower: T::zero(), upper: T::zero() });
        }
        let integrals = Integrals::new(self.solved)?;
        let [smooth, bent] = self.smooth(&integrals)?;
        let first = self.first()?;
        let logarithm = self.logarithm(&integrals, Some(&first))?;
        let [lower, upper] = self.of_each([smooth[0] - bent[0], smooth[1] - bent[1]], logarithm);
        let bodies = self.of_bodies(&integrals, smooth, &first)?;
        Ok(Approach { bodies, lower, upper })
    }

    /// Returns the displacement of the surface of a body at any x towards its reference.
    pub fn of_surface(&self, body: Body, x: T) -> Result<T, ContactError<T>> {
        let Solved { gap, found, .. } = self.solved;
        let x = place(gap, x)?;
        if found.apart.is_some() {
            return Ok(T::zero());
        }
        let integrals = Integrals::new(self.solved)?;
        let ([smooth, _], at) =
            (self.smooth(&integrals)?, Self { x, bodies: self.bodies.clone(), ..*self });
        let bent = match gap.bend() {
            Some(_) => at.smooth(&integrals)?[1],
            None => [T::zero(); 2],
        };
        let logarithm = at.logarithm(&integrals, None)?;
        let smooth = [smooth[0] - bent[0], smooth[1] - bent[1]];
        Ok(self.of_each(smooth, logarithm)[body as usize])
    }

    /// Returns `∫ P ln|ξ| ds`.
    fn logarithm(
        &self,
        integrals: &Integrals<T, impl Density<T>>,
        known: Option<&First<T>>,
    ) -> Fallible<T, T> {
        let (x, contacts) = (self.x, self.solved.contacts());
        let Some(i) = contacts.iter().position(|on| x >= on.left && x <= on.right) else {
            let scale = self.scale();
            let logarithm = |distance: T, strength: T| [strength * (distance.abs() / scale).ln()];
            return integrals.over(x, logarithm).map(|[sum]| sum);
        };
        // Inside a contact the integral changes with x as the heights do.
        let heights = match known {
            Some(first) if first.contact == i => first.heights,
            _ => UndeformedGap::new(self.solved, i, x)?,
        };
        let rise = heights.at.unwrap_or(heights.mean) - heights.mean;
        Ok(self.mean_logarithm(integrals, contacts[i])? + self.solved.kappa * rise)
    }
}
