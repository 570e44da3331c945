//! Scene whose contacts are the stick zones.

use crate::contact::{Contact, Edge};
use crate::material::Elasticity;
use crate::solution::{Shear, Solution};
use crate::{Fallible, InputError, Real, SolveError};

impl<'b, T: Real> Contact<'b, T> {
    /// Checks that partial slip can be solved for this shear.
    pub(crate) fn check_shear(&self, shear: &Shear<T>) -> Fallible<T, ()> {
        let Shear { friction, force, tension } = *shear;
        if !(friction.is_finite() && friction > T::zero()) {
            return Err(InputError::InvalidSlipFriction { friction }.into());
        }
        for (quantity, value) in [("force", force), ("tension", tension)] {
            if !value.is_finite() {
                return Err(InputError::InvalidShear { quantity, value }.into());
            }
        }
        let refuse = |why| Err(InputError::SlipNotSupported { why }.into());
        if self.edge_pressure.is_some() {
            return refuse("the edges are by Eq. (6)");
        }
        if self.edges.are_adhesive() {
            return refuse("an edge is Adhesive");
        }
        if self.kernel_of_bodies()?.is_some() {
            return refuse("the bodies have a layer, a period or another kernel");
        }
        if let Some(bodies) = self.elasticity()? {
            Elasticity::check_like(&bodies)?;
        }
        Ok(())
    }

    /// Returns the scene whose contacts are the stick zones, and its load.
    pub(crate) fn sticking(
        &self,
        normal: &Solution<'b, T>,
        shear: &Shear<T>,
    ) -> Fallible<T, (Self, T)> {
        let Shear { friction, force, tension } = *shear;
        let (load, limit) = (normal.load(), friction * normal.load());
        if force.abs() >= limit {
            return Err(SolveError::SlipsEverywhere { force, limit }.into());
        }
        // The traction is a difference, of which no digits would be left.
        let least = T::epsilon().powf(T::of(0.75)) * limit;
        if !force.is_zero() && force.abs() < least {
            return Err(SolveError::SticksEverywhere { force, limit }.into());
        }
        // μ E*, with the sign of the force.
        let stiffness = friction * self.kappa / T::frac_pi_2();
        let turn = T::of(0.5) * tension / stiffness;
        let turn = if force < T::zero() { turn } else { -turn };
        let mut scene = self.clone();
        scene.gap = self.gap.tilted(normal.tilt() + turn).into_owned();
        scene.edges = self.edges.map(Edge::let_go);
        (scene.start, scene.certified) = (None, false);
        Ok((scene, load - force.abs() / friction))
    }
}
