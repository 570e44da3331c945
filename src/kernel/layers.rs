//! Layers of both bodies.

use super::SurfaceCompliance;
use crate::Real;
use crate::material::{Coating, Elasticity};

/// Layers of both bodies, each with the share of its body in the compliance of the contact: what
/// they add to half-planes.
pub(crate) struct Layers<T> {
    layers: Vec<(T, Coating<T>)>,
}

impl<T: Real> Layers<T> {
    /// Returns the layers of two bodies; `None` without any.
    pub fn of(bodies: &[Elasticity<T>; 2]) -> Option<Self> {
        let sum = bodies[0].compliance + bodies[1].compliance;
        let layer = |body: &Elasticity<T>| Some((body.compliance / sum, body.layer.clone()?));
        let layers: Vec<_> = bodies.iter().filter_map(layer).collect();
        (!layers.is_empty()).then_some(Self { layers })
    }
}

impl<T: Real> SurfaceCompliance<T> for Layers<T> {
    fn excess(&self, wavenumber: T) -> T {
        let term =
            |(share, layer): &(T, Coating<T>)| *share * layer.excess(wavenumber * layer.thickness);
        self.layers.iter().map(term).fold(T::zero(), |sum, term| sum + term)
    }

    fn decay(&self) -> T {
        let thicknesses = self.layers.iter().map(|(_, layer)| layer.thickness);
        T::of(2.0) * thicknesses.fold(T::one() / T::zero(), |least, other| least.min(other))
    }

    fn longest(&self) -> T {
        self.layers.iter().fold(T::zero(), |most, (_, layer)| most.max(layer.longest()))
    }
}
