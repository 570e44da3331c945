//! What the bodies have beside half-planes.

use crate::kernel::{Formula, Kernel, Layers, Periodic, SurfaceCompliance, Table};
use crate::{ContactError, InputError, Real};
use std::sync::{Arc, OnceLock};

/// Kernel and compliance set by the user, with the table of the compliance; layers are part of the
/// materials.
#[derive(Clone)]
pub(crate) struct Beside<'b, T: Real> {
    pub formula: Option<Formula<'b, T>>,
    pub compliance: Option<Arc<dyn SurfaceCompliance<T>>>,
    /// Period of both bodies.
    pub period: Option<T>,
    /// Table of the compliance and the layers, made for the first solve.
    pub table: OnceLock<Arc<Table<T>>>,
}

impl<T: Real> Default for Beside<'_, T> {
    fn default() -> Self {
        Self { formula: None, compliance: None, period: None, table: OnceLock::new() }
    }
}

impl<'b, T: Real> Beside<'b, T> {
    /// Tells whether the user has set nothing.
    pub fn is_empty(&self) -> bool {
        self.formula.is_none() && self.compliance.is_none() && self.period.is_none()
    }

    /// Returns the kernel of these and of the layers, if there is any.
    pub fn kernel(
        &self,
        layers: Option<Layers<T>>,
    ) -> Result<Option<Box<Kernel<'b, T>>>, ContactError<T>> {
        let layers = layers.map(|layers| Arc::new(layers) as Arc<dyn SurfaceCompliance<T>>);
        let compliance = match (layers, self.compliance.clone()) {
            (Some(one), Some(other)) => Some(Arc::new(Sum([one, other])) as Arc<_>),
            (one, other) => one.or(other),
        };
        let formula = self.formula.clone();
        let row = self.period.map(Periodic::new);
        if compliance.is_none() && formula.is_none() && row.is_none() {
            return Ok(None);
        }
        let lengths = compliance.iter().flat_map(|of| {
            [
                ("its decay must be positive and finite, but c", of.decay()),
                ("its longest length must be positive and finite, but ℓ", of.longest()),
            ]
        });
        let distance = formula.iter().map(|of| {
            (
                "its nearest singularity must lie at a positive, finite distance, but d",
                of.kernel().nearest_singularity(),
            )
        });
        for (what, at) in lengths.chain(distance) {
            if !(at.is_finite() && at > T::zero()) {
                return Err(InputError::Kernel { what, at }.into());
            }
        }
        let table = match (compliance, self.table.get()) {
            (Some(_), Some(table)) => Some(table.clone()),
            (Some(of), None) => {
                let what = "the compliance is not a positive number at ω";
                let table =
                    Table::new(of, self.period).map_err(|at| InputError::Kernel { what, at })?;
                Some(self.table.get_or_init(|| Arc::new(table)).clone())
            }
            (None, _) => None,
        };
        let is_of_bodies = self.formula.is_none() && self.compliance.is_none();
        Ok(Some(Box::new(Kernel { table, formula, row, is_of_bodies })))
    }
}

/// Sum of two compliances.
struct Sum<T>([Arc<dyn SurfaceCompliance<T>>; 2]);

impl<T: Real> SurfaceCompliance<T> for Sum<T> {
    fn excess(&self, wavenumber: T) -> T {
        self.0[0].excess(wavenumber) + self.0[1].excess(wavenumber)
    }

    fn decay(&self) -> T {
        self.0[0].decay().min(self.0[1].decay())
    }

    fn longest(&self) -> T {
        self.0[0].longest().max(self.0[1].longest())
    }
}
