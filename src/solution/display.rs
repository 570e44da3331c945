//! Results as lines of text.

use super::stress::Stress;
use super::{Certificate, Conformity, Extremum, Peak, Solution};
use crate::rounded::{DIGITS, Rounded, is_far, within};
use crate::{ContactError, Estimate, EvaluationError, Real, Side};
use std::fmt::{Display, Formatter, Result};

fn rounded<T: Real>(value: T, f: &Formatter<'_>) -> Rounded {
    Rounded(value.to_subset_unchecked(), f.precision().unwrap_or(DIGITS))
}

/// Share of the largest pressure from which on its error is told.
const UNCERTAIN: f64 = 1e-3;

/// Returns a place, or zero if it is zero to rounding, in a range of this width: a place of a
/// largest value has half of the digits.
fn place<T: Real>(x: T, width: T) -> T {
    if x.abs() > T::epsilon().sqrt() * width { x } else { T::zero() }
}

/// Writes contacts, load, largest pressure and quality in three lines, and warnings: of a largest
/// pressure that is uncertain by more than 1e-3, of a stiffness that was not given, and of bodies
/// that [conform](Solution::conformity) or [are steep](Solution::is_steep). Numbers have six
/// digits, or as many as the precision (`{:.3}`); places have more if they are far from 0.
impl<T: Real> Display for Solution<'_, T> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let (contacts, digits) = (self.intervals(), f.precision().unwrap_or(DIGITS));
        if self.is_apart() {
            let [from, to] = self.solved().gap.range();
            let x = place(self.a(), to - from);
            let [by, x] = [self.separation(), x].map(|length| rounded(length, f));
            return write!(f, "apart by {by} at x = {x}, without load");
        }
        match contacts.len() {
            1 => f.write_str("contact ")?,
            several => write!(f, "{several} contacts ")?,
        }
        for (i, on) in contacts.iter().enumerate() {
            f.write_str(if i > 0 { ", " } else { "" })?;
            let [left, right] = [on.left, on.right].map(|x| within(x, on, digits));
            write!(f, "[{left}, {right}]")?;
        }
        write!(f, "\nload {}", rounded(self.load(), f))?;
        if !self.tilt().is_zero() {
            write!(f, ", tilt {}", rounded(self.tilt(), f))?;
        }
        let (hull, peak) = (self.hull(), self.peak());
        let at = |x: T| within(place(x, hull.right - hull.left), &hull, digits);
        match peak {
            Ok(Peak { x, pressure, .. }) => {
                write!(f, ", largest pressure {} at x = {}", rounded(pressure, f), at(x))?;
            }
            Err(ContactError::Evaluation(EvaluationError::Singular { x })) => {
                write!(f, ", pressure infinite at x = {}", at(x))?;
            }
            Err(_) => f.write_str(", largest pressure not found")?,
        }
        match self.limits_error() {
            Some(error) => {
                let error = Rounded(error.to_subset_unchecked(), 2);
                write!(f, "\nlimits to {error} of the half-width, ")?;
                let solved = self.solved();
                let held = solved.held_limits().filter(|held| !self.found.adhesive[held.1]);
                let held: Vec<_> = held.collect();
                for (n, &(i, side, _)) in held.iter().rev().enumerate() {
                    f.write_str(if n > 0 { ", " } else { "held at x = " })?;
                    write!(f, "{}", at(solved.contacts()[i][side]))?;
                }
                f.write_str(if held.is_empty() { "" } else { ", " })?;
            }
            None => f.write_str("\nlimits given, ")?,
        }
        f.write_str(if self.report().is_checked() { "checked" } else { "not checked" })?;
        self.warn(peak.ok(), f)
    }
}

impl<T: Real> Solution<'_, T> {
    /// Writes a line for a peak that is uncertain, for a stiffness that was not given, for each
    /// corner that would have to pull, and for bodies unlike half-planes.
    fn warn(&self, peak: Option<Peak<T>>, f: &mut Formatter<'_>) -> Result {
        let (hull, found, digits) = (self.hull(), &self.found, f.precision().unwrap_or(DIGITS));
        let at = |x: T| within(place(x, hull.right - hull.left), &hull, digits);
        if let Some(Peak { x, pressure, error }) = peak
            && error > T::of(UNCERTAIN) * pressure.abs()
        {
            let why = match is_far(x, hull.half_width()) {
                true => "x has too few digits: move the origin to the contact".into(),
                false => {
                    format!("is a corner at x = {} no breakpoint, or the quadrature coarse?", at(x))
                }
            };
            let error = Rounded(error.to_subset_unchecked(), 2);
            write!(f, "\nthe largest pressure is uncertain by {error}: {why}")?;
        }
        if self.has_default_stiffness {
            f.write_str("\nκ is 1, as no modulus and no materials were given")?;
        }
        for side in Side::BOTH {
            let least = -found.zero_tolerance() * self.mean_pressure().abs();
            // At a limit that was found free the strength is what is left of zero: just beyond a
            // corner that is the rounding of x, magnified.
            let is_held = !found.adhesive[side] && !found.free[side];
            if is_held && found.strengths[side] < least {
                let x = at(hull[side]);
                write!(f, "\nthe bodies would have to pull at each other at x = {x}")?;
            }
        }
        if let Some(conformity) = self.conformity() {
            write!(f, "\n{conformity}")?;
        } else if let Some(angle) = self.conforming() {
            let angle: f64 = angle.to_subset_unchecked();
            write!(
                f,
                "\nthe bodies conform, with {:.1}° at the limits, unlike layers on half-planes: the pressure in the \
                 middle is too low",
                angle.to_degrees()
            )?;
        }
        if self.is_steep() {
            f.write_str(
                "\nthe surfaces are steep (slopes above 0.3), so less like half-planes: do all units go together?",
            )?;
        }
        Ok(())
    }
}

/// Writes the angle in degrees and both shares in percent, in one line.
impl<T: Real> Display for Conformity<T> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let number = |value: T| -> f64 { value.to_subset_unchecked() };
        write!(
            f,
            "the bodies conform, with {:.1}° at the limits, unlike half-planes: the pressure in the middle, the peak \
             of a pin in a hole, is about {:.1} % too low, {:.1} % if parabolas stand for circles",
            number(self.angle).to_degrees(),
            100.0 * number(self.too_low),
            100.0 * number(self.parabolas_too_low)
        )
    }
}

impl<T: Real> Display for Peak<T> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        write!(f, "{} at x = {}", rounded(self.pressure, f), rounded(self.x, f))
    }
}

impl<T: Real> Display for Extremum<T> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        write!(f, "{} at x = {}", rounded(self.value, f), rounded(self.x, f))
    }
}

/// Writes the value with all its digits, and its error with two; a precision applies to the value.
impl<T: Real> Display for Estimate<T> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let [value, error] = [self.value, self.error].map(|number| number.to_subset_unchecked());
        let digits = f.precision().unwrap_or(17);
        write!(f, "{} ± {}", Rounded(value, digits), Rounded(error, 2))
    }
}

/// Writes the proof and its least values in one line.
impl<T: Real> Display for Certificate<T> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        for (proved, by, least) in
            [("no tension", "ratio", &self.pressure), (", no overlap", "gap", &self.gap)]
        {
            f.write_str(proved)?;
            if let Some(least) = least {
                write!(f, " (least {by} ")?;
                least.fmt(f)?;
                f.write_str(")")?;
            }
        }
        f.write_str(if self.is_proved() { "" } else { ", up to rounding" })?;
        write!(f, ", in cells of {}: {}", rounded(self.spacing, f), self.cost)
    }
}

impl<T: Real> Display for Stress<T> {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let [along, across, shear] = [self.sigma_x, self.sigma_y, self.tau_xy];
        let [along, across, shear] = [along, across, shear].map(|stress| rounded(stress, f));
        write!(f, "σ_x = {along}, σ_y = {across}, τ_xy = {shear}")
    }
}
