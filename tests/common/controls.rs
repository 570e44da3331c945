//! Each control of the library, for tests that go over all of them.

use linecontact::{Control, Reference, References, Solution};

/// The file of `Control` again: a `non_exhaustive` enum is matched without a wildcard only in the
/// crate that has it. So below, where a control is missing, nothing compiles.
#[path = "../../src/contact/control.rs"]
mod source;
use source::Control as Kind;

/// Returns each control, without numbers.
fn kinds() -> impl Iterator<Item = Kind<()>> {
    let nowhere = References { x: (), lower: Reference::Depth(()), upper: Reference::Depth(()) };
    std::iter::successors(Some(Kind::Load(())), move |kind| match kind {
        Kind::Load(()) => Some(Kind::HalfWidth(())),
        Kind::HalfWidth(()) => Some(Kind::PeakPressure(())),
        Kind::PeakPressure(()) => Some(Kind::Approach { approach: (), references: nowhere }),
        Kind::Approach { .. } => Some(Kind::Moment { load: (), moment: (), about: () }),
        Kind::Moment { .. } => Some(Kind::CentreOfPressure { load: (), at: () }),
        Kind::CentreOfPressure { .. } => None,
    })
}

/// Returns each control under which this solution should be found again. One that it has no value
/// of is left out, as a peak at a corner is, or an approach without materials.
pub fn controls_of(solution: &Solution<f64>) -> Vec<Control<f64>> {
    let (load, on) = (solution.load(), solution.hull());
    let depth = Reference::Depth(20.0 * on.half_width());
    let references = References { x: on.centre(), lower: depth, upper: depth };
    let value = |kind| {
        Some(match kind {
            Kind::Load(()) => Control::Load(load),
            Kind::HalfWidth(()) => Control::HalfWidth(on.half_width()),
            Kind::PeakPressure(()) => Control::PeakPressure(solution.peak().ok()?.pressure),
            Kind::Approach { .. } => {
                let approach = solution.approach(&references).ok()?.bodies;
                Control::Approach { approach, references }
            }
            Kind::Moment { .. } => {
                let about = on.left;
                let moment = solution.moment().ok()? - load * about;
                Control::Moment { load, moment, about }
            }
            Kind::CentreOfPressure { .. } => {
                Control::CentreOfPressure { load, at: solution.centre_of_pressure().ok()? }
            }
        })
    };
    kinds().filter_map(value).collect()
}
