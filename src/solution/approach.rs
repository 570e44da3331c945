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
//! with no singular term. **Stiffness**: `dδ/dF` is the sum alone, with the
//! [rate](crate::LoadRates) `∂P/∂F` of the pressure in place of P; the stiffness `dF/dδ` is exact,
//! without differences.

use super::ContactState;
use super::load_rates::LoadRates;
use super::pressure::Pressure;
use super::pressure_integral::{Density, Integrals};
use super::solved::Solved;
use super::undeformed_gap::UndeformedGap;
use crate::gap::Sampler;
use crate::material::Elasticity;
use crate::quadrature::{Engine, Panels};
use crate::{
    ContactError, InputError, Interval, Real, Reference, References, Side, Solution, SolveError,
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
    /// [`InputError::InvalidReference`]; [`SolveError::OutsideBodies`]; those of
    /// [`pressure`](Self::pressure);
    /// [`EvaluationError::Integral`](crate::EvaluationError::Integral).
    pub fn approach(&self, references: &References<T>) -> Result<Approach<T>, ContactError<T>> {
        T::approach(self, references)
    }

    /// Returns the stiffness dF/dδ of the bodies against each other, a pressure: the derivative of
    /// the load per unit length by their [approach](Self::approach), at a fixed tilt. For one
    /// contact it takes no longer than a pressure.
    ///
    /// The approach of the bodies grows with the load, for all depths and for discs larger than the
    /// contact. (The surface of one body need not approach a point close below it,
    /// `Approach::upper`: outside the contact it may be lifted while the gap closes.)
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

/// Contact, elasticity of its bodies and their references: all data of the approach.
pub(crate) struct Approaching<'s, T: Real> {
    solved: Solved<'s, T>,
    bodies: [Elasticity<T>; 2],
    references: References<T>,
    /// Share of each body in the bend, if its approach is absolute.
    absolute: [Option<T>; 2],
}

/// Returns for each body the length in its logarithm and its share in the bend, if its approach is
/// absolute: for a layer on a rigid base, to the base; for a row of contacts, of the mean planes.
/// Bodies without a kernel have none, and other kernels are refused.
fn absolute_lengths<T: Real>(
    solved: &Solved<'_, T>,
    bodies: &[Elasticity<T>; 2],
) -> Result<[Option<[T; 2]>; 2], ContactError<T>> {
    let Some(bend) = solved.gap.bend() else { return Ok([None; 2]) };
    let kernel = bend.kernel_of_bodies();
    let is_rigid = |body: &Elasticity<T>| body.layer.map(|layer| layer.is_on_rigid());
    let share = |i: usize| bodies[i].compliance / (bodies[0].compliance + bodies[1].compliance);
    if let Some(period) = kernel.period_of_half_planes() {
        // ln|2 sin(π(x - s)/p)| is zero on average.
        return Ok([0, 1].map(|i| Some([period / T::two_pi(), share(i)])));
    }
    let of_layer = |i: usize| Some([kernel.absolute_length(share(i))?, T::one()]);
    let lengths = match bodies.each_ref().map(is_rigid) {
        [Some(true), None] => [of_layer(0), None],
        [None, Some(true)] => [None, of_layer(1)],
        _ => [None; 2],
    };
    if lengths == [None; 2] || solved.several().is_some() {
        let quantity = "the approach (but that of one contact with one layer on a rigid base, and of half-planes with \
                        a period)";
        solved.of_half_planes(quantity)?;
    }
    Ok(lengths)
}

/// Contact in which the bodies touched first, by its number, and the heights of the gap there.
struct First<T> {
    contact: usize,
    heights: UndeformedGap<T>,
}

impl<'s, T: Real> Approaching<'s, T> {
    pub fn new(
        solved: Solved<'s, T>,
        bodies: Option<[Elasticity<T>; 2]>,
        references: &References<T>,
    ) -> Result<Self, ContactError<T>> {
        let bodies = bodies.ok_or(InputError::NoMaterials)?;
        let mut references = *references;
        references.x = solved.gap.folded(references.x);
        let lengths = absolute_lengths(&solved, &bodies)?;
        let absolute = lengths.map(|length| length.map(|[_, share]| share));
        for (own, length) in [&mut references.lower, &mut references.upper].into_iter().zip(lengths)
        {
            *own = length.map_or(*own, |[length, _]| Reference::Length(length));
        }
        let References { x, lower, upper } = references;
        let half_width = solved.found.interval.half_width();
        let range = solved.gap.range();
        if !(x >= range[0] && x <= range[1]) {
            return Err(SolveError::OutsideBodies { x, range }.into());
        }
        for (reference, body) in [lower, upper].into_iter().zip(bodies) {
            let (Reference::Depth(length) | Reference::Disc(length) | Reference::Length(length)) =
                reference;
            // The formula of the disc is for contacts that are small beside it.
            let is_large = !matches!(reference, Reference::Disc(radius) if radius <= half_width);
            let valid = length.is_finite() && length > T::zero() && is_large;
            if !(valid || body.compliance.is_zero()) {
                return Err(InputError::InvalidReference { length }.into());
            }
        }
        Ok(Self { solved, bodies, references, absolute })
    }

    fn first(&self) -> Result<First<T>, ContactError<T>> {
        let heights = |contact| UndeformedGap::new(self.solved, contact, self.references.x);
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
    fn first_before_bend(&self) -> Result<(usize, T), ContactError<T>> {
        let Solved { gap, found, .. } = self.solved;
        let before = &gap.before_bend().tilted(found.tilt);
        let (mut integrator, mut sampler) = (Engine::new(&Panels::FULL)?, Sampler::default());
        let mut first: Option<(usize, T, T)> = None;
        for (contact, &interval) in self.solved.contacts().iter().enumerate() {
            integrator.prepare(before, interval)?;
            let found = &ContactState { interval, ..*found };
            let solved = Solved { gap: before, integrator: &integrator, found, ..self.solved };
            let least = UndeformedGap::new(solved, 0, self.references.x)?.least;
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
        let [lower, upper] = smooth.map(|smooth| smooth - logarithm - logarithm);
        let shares = self.bodies.map(|body| body.compliance);
        (shares[0] * lower + shares[1] * upper) * T::frac_1_pi()
    }

    /// Returns `∫ p (k_i + 2 ln|ξ|) ds` of each body for a density without a closed form.
    fn smooth_by_integrals(
        &self,
        integrals: &Integrals<T, impl Density<T>>,
    ) -> Result<[T; 2], ContactError<T>> {
        integrals.over(self.references.x, |distance, strength| {
            self.kernels(distance).map(|kernel| strength * kernel)
        })
    }

    /// Returns `k_i + 2 ln|ξ|` of each body.
    fn kernels(&self, distance: T) -> [T; 2] {
        let (scale, two, one) = (self.scale(), T::of(2.0), T::one());
        let References { lower, upper, .. } = self.references;
        [(lower, self.bodies[0]), (upper, self.bodies[1])].map(
            |(reference, body)| match reference {
                _ if body.compliance.is_zero() => T::zero(),
                Reference::Depth(depth) => {
                    let radius = depth.hypot(distance);
                    let down = depth / radius;
                    two * (radius / scale).ln() - down * down / (one - body.ratio)
                }
                Reference::Disc(radius) => two * ((two * radius / scale).ln() - one),
                Reference::Length(length) => two * (length / scale).ln(),
            },
        )
    }

    /// Returns `∫ p (k_i + 2 ln|ξ|) ds` of each body.
    fn smooth(&self, integrals: &Integrals<T, impl Density<T>>) -> Result<[T; 2], ContactError<T>> {
        let scale = self.scale();
        let References { x, lower, upper } = self.references;
        let (two, one) = (T::of(2.0), T::one());
        let [lower, upper] = [(lower, self.bodies[0]), (upper, self.bodies[1])];
        let is_integral = |(reference, body): (Reference<T>, Elasticity<T>)| {
            matches!(reference, Reference::Depth(_)) && !body.compliance.is_zero()
        };
        let constant = self.kernels(T::zero()).map(|kernel| integrals.load * kernel);
        if !(is_integral(lower) || is_integral(upper)) {
            return Ok(constant);
        }
        if let Some(potential) = Pressure::new(self.solved)?.potential()? {
            let below =
                |(i, (reference, body)): (usize, (Reference<T>, Elasticity<T>))| match reference {
                    Reference::Depth(depth) if !body.compliance.is_zero() => {
                        let [potential, pull] = potential.at(x, depth)?;
                        let logarithm = potential - integrals.load * scale.ln();
                        Some(two * logarithm + pull / (one - body.ratio))
                    }
                    _ => Some(constant[i]),
                };
            if let (Some(lower), Some(upper)) = (below((0, lower)), below((1, upper))) {
                return Ok([lower, upper]);
            }
        }
        self.smooth_by_integrals(integrals)
    }

    /// Returns `∫ p G ds` of a contact.
    fn mean_logarithm(
        &self,
        integrals: &Integrals<T, impl Density<T>>,
        on: Interval<T>,
    ) -> Result<T, ContactError<T>> {
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
        let smooth = self.smooth(&integrals)?;
        Ok([self.of_bodies(&integrals, smooth, &self.first()?)?, rate])
    }

    /// Returns the approach of the bodies from the integrals of the kernels.
    fn of_bodies(
        &self,
        integrals: &Integrals<T, impl Density<T>>,
        smooth: [T; 2],
        first: &First<T>,
    ) -> Result<T, ContactError<T>> {
        let UndeformedGap { mean, least, .. } = first.heights;
        let logarithm = self.mean_logarithm(integrals, self.solved.contacts()[first.contact])?;
        Ok(mean - least + self.both(smooth, logarithm))
    }

    /// Returns dδ/dF: with ∂P/∂F any contact may be the first.
    pub fn rate(&self) -> Result<T, ContactError<T>> {
        let (rates, contacts) = (LoadRates::of(self.solved)?, self.solved.contacts());
        if let (Some(bend), Some(punch)) = (self.solved.gap.bend(), rates.bent()) {
            let integrals = Integrals::of_unit_load(&rates, contacts);
            let logarithm = self.mean_logarithm(&integrals, contacts[0])?;
            let smooth = self.smooth_by_integrals(&integrals)?;
            return Ok(self.both(smooth, logarithm) - bend.mean_height(punch) / self.solved.kappa);
        }
        if let [on] = *contacts {
            let References { lower, upper, .. } = self.references;
            let [one, other] = self.bodies;
            let punches = [self.of_punch(on, lower, one), self.of_punch(on, upper, other)];
            return Ok(self.both(punches, T::zero()));
        }
        let integrals = Integrals::of_unit_load(&rates, contacts);
        let logarithm = self.mean_logarithm(&integrals, contacts[0])?;
        Ok(self.both(self.smooth(&integrals)?, logarithm))
    }

    /// Returns `∫ p (k + 2 ln|ξ| - 2 G) ds` for the pressure p of a flat punch on one contact,
    /// under a unit load. Take the ellipse through the reference with its foci at the limits, and η
    /// the logarithm of the sum of its half-axes over L: the first part is 2 η; the second is the
    /// real part of `d ∂/∂d`.
    fn of_punch(&self, on: Interval<T>, reference: Reference<T>, body: Elasticity<T>) -> T {
        let (one, two, half_width) = (T::one(), T::of(2.0), on.half_width());
        match reference {
            _ if body.compliance.is_zero() => T::zero(),
            Reference::Disc(radius) => two * ((T::of(4.0) * radius / half_width).ln() - one),
            Reference::Length(length) => two * (two * length / half_width).ln(),
            Reference::Depth(depth) => {
                let x = self.references.x;
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
                let turn =
                    (depth / radii[0] + depth / radii[1]) * (depth / (two * half_width) / sinh);
                two * eta - turn / (one - body.ratio)
            }
        }
    }

    pub fn of_all(&self) -> Result<Approach<T>, ContactError<T>> {
        let integrals = Integrals::new(self.solved)?;
        let (smooth, first) = (self.smooth(&integrals)?, self.first()?);
        let logarithm = self.logarithm(&integrals, &first)?;
        let of = |i: usize| {
            let all = self.bodies[i].compliance * T::frac_1_pi();
            let bend = |share| Some((self.solved.gap.bend()?, share));
            let bend = self.absolute[i].and_then(bend);
            let bent =
                bend.map_or(T::zero(), |(bend, share)| share * bend.height(self.references.x));
            all * (smooth[i] - T::of(2.0) * logarithm) - bent / self.solved.kappa
        };
        let bodies = self.of_bodies(&integrals, smooth, &first)?;
        Ok(Approach { bodies, lower: of(0), upper: of(1) })
    }

    /// Returns `∫ P ln|ξ| ds`.
    fn logarithm(
        &self,
        integrals: &Integrals<T, impl Density<T>>,
        first: &First<T>,
    ) -> Result<T, ContactError<T>> {
        let (x, contacts) = (self.references.x, self.solved.contacts());
        let Some(i) = contacts.iter().position(|on| x >= on.left && x <= on.right) else {
            let scale = self.scale();
            let logarithm = |distance: T, strength: T| [strength * (distance.abs() / scale).ln()];
            return integrals.over(x, logarithm).map(|[sum]| sum);
        };
        // Inside a contact the integral changes with x as the heights do.
        let heights =
            if i == first.contact { first.heights } else { UndeformedGap::new(self.solved, i, x)? };
        let rise = heights.at.unwrap_or(heights.mean) - heights.mean;
        Ok(self.mean_logarithm(integrals, contacts[i])? + self.solved.kappa * rise)
    }
}
