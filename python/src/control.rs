//! Choices by name, including the prescribed quantity of a contact.

use crate::profile::{AsTheyAre, Lift};
use linecontact::{Control, Reference, References};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// Name and its numbers.
pub type Choice = (String, Vec<f64>);

pub fn none_such<T>(what: &str, (name, numbers): &Choice) -> PyResult<T> {
    Err(PyValueError::new_err(format!("no {what} {name}{numbers:?}")))
}

/// Abscissa x, and kind and length of both references.
pub type ReferenceRow = (f64, (String, f64), (String, f64));

pub fn references(row: ReferenceRow) -> PyResult<References<f64>> {
    references_of(&row, &mut AsTheyAre)
}

pub fn references_of<L: Lift>(
    (x, lower, upper): &ReferenceRow,
    lift: &mut L,
) -> PyResult<References<L::Of>> {
    let reference = |(name, length): &(String, f64), lift: &mut L| {
        let mut given = || lift.number("value", *length);
        Ok(match name.as_str() {
            "depth" => Reference::Depth(given()),
            "disc" => Reference::Disc(given()),
            "length" => Reference::Length(given()),
            _ => return none_such("reference", &(name.clone(), vec![*length])),
        })
    };
    lift.inside("references", |lift| {
        Ok(References {
            x: lift.number("x", *x),
            lower: lift.inside("lower", |lift| reference(lower, lift))?,
            upper: lift.inside("upper", |lift| reference(upper, lift))?,
        })
    })
}

/// Prescribed quantity: its name, its numbers, and the references of an approach.
pub type Prescribed = (String, Vec<f64>, Option<ReferenceRow>);

pub fn control(prescribed: Prescribed) -> PyResult<Control<f64>> {
    control_of(&prescribed, &mut AsTheyAre)
}

pub fn control_of<L: Lift>(
    (name, numbers, to): &Prescribed,
    lift: &mut L,
) -> PyResult<Control<L::Of>> {
    Ok(match (name.as_str(), numbers.as_slice(), to) {
        ("load", &[load], None) => Control::Load(lift.number("load", load)),
        ("half_width", &[half_width], None) => {
            Control::HalfWidth(lift.number("half_width", half_width))
        }
        ("peak_pressure", &[pressure], None) => {
            Control::PeakPressure(lift.number("peak_pressure", pressure))
        }
        ("approach", &[approach], Some(to)) => {
            let approach = lift.number("approach", approach);
            Control::Approach { approach, references: references_of(to, lift)? }
        }
        ("moment", &[load, moment, about], None) => Control::Moment {
            load: lift.number("load", load),
            moment: lift.number("moment", moment),
            about: lift.number("about", about),
        },
        ("centre_of_pressure", &[load, at], None) => Control::CentreOfPressure {
            load: lift.number("load", load),
            at: lift.number("centre_of_pressure", at),
        },
        _ => return none_such("control", &(name.clone(), numbers.clone())),
    })
}
