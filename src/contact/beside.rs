//! What the bodies have beside half-planes, as the user has set it.

use crate::Real;
use crate::kernel::{Formula, SurfaceCompliance};
use std::sync::Arc;

/// Kernel and compliance set by the user; layers are part of the materials.
#[derive(Clone)]
pub(crate) struct Beside<'b, T: Real> {
    pub formula: Option<Formula<'b, T>>,
    pub compliance: Option<Arc<dyn SurfaceCompliance<T>>>,
}

impl<T: Real> Default for Beside<'_, T> {
    fn default() -> Self {
        Self { formula: None, compliance: None }
    }
}
