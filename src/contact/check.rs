//! Whether what solves the equations is a contact: nothing pulls inside, nothing overlaps outside.
//!
//! Inside, a slope of the gap that rises on every panel proves it (the kernel of theory: P is an integral of g' with a
//! kernel that is positive). Only otherwise pressures are looked at. Outside, the gap between the loaded bodies
//! is looked at where their heights are known.

use super::Found;
use super::field::{Field, POINTS};
use crate::gap::{Cost, Gap, Sampler};
use crate::quadrature::panels::{self, Several};
use crate::quadrature::{Engine, Pressing};
use crate::{ContactError, Interval, Real};

/// The contacts of a solution, ready to be checked.
pub(super) struct Check<'c, T: Real> {
    pub gap: &'c Gap<'c, T>,
    pub engine: &'c dyn Engine<T>,
    pub kappa: T,
    pub found: &'c Found<T>,
}

impl<T: Real> Check<'_, T> {
    fn contacts(&self) -> &[Interval<T>] {
        let several = panels::several(self.engine).map(Several::contacts);
        several.unwrap_or(std::slice::from_ref(&self.found.interval))
    }

    fn pressing(&self) -> Pressing<T> {
        Pressing { kappa: self.kappa, load: self.found.load, free: self.found.free }
    }

    /// The share of the mean pressure, or of the heights in the contact, that is taken for zero.
    fn share(&self) -> T {
        let rounding = T::epsilon().cbrt() * T::epsilon().cbrt();
        let error = T::of(16.0) * self.found.error.unwrap_or(T::zero());
        rounding.max(error).min(T::of(0.01))
    }

    /// The pressures in each contact.
    pub fn fields(&self, fields: &mut Vec<Field<T>>) -> Result<(), ContactError<T>> {
        fields.clear();
        for &on in self.contacts() {
            let x = Field::places(on);
            let mut pressures = [T::zero(); POINTS];
            let pressing = self.pressing();
            self.engine.pressures(self.gap, &pressing, &x, &mut pressures, &mut Cost::default())?;
            fields.push(Field::new(on, &x, &pressures));
        }
        Ok(())
    }
}
