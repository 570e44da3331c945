//! Numbers of a solution by name: the columns of a sweep, and the numbers that have a gradient.

use linecontact::stress::StressPeak;
use linecontact::{Body, ContactError, Peak, Real, References, Solution, Uncertainty};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::cell::OnceCell;

/// Makes the quantities, each with its name in Python.
macro_rules! quantities {
    ($($name:literal $quantity:ident)*) => {
        /// Number of a solution.
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        pub enum Quantity {
            $($quantity,)*
        }

        /// Names in Python.
        pub const NAMES: &[(&str, Quantity)] = &[$(($name, Quantity::$quantity),)*];
    };
}
quantities! {
    "load" Load
    "a" A
    "b" B
    "half_width" HalfWidth
    "centre" Centre
    "tilt" Tilt
    "mean_pressure" MeanPressure
    "peak_pressure" PeakPressure
    "peak_x" PeakX
    "peak_error" PeakError
    "moment" Moment
    "centre_of_pressure" CentreOfPressure
    "max_shear" MaxShear
    "max_shear_x" MaxShearX
    "max_shear_depth" MaxShearDepth
    "approach" Approach
    "stiffness" Stiffness
    "separation" Separation
    "contacts" Contacts
    "limits_error" LimitsError
    "half_width_deviation" HalfWidthDeviation
    "peak_pressure_deviation" PeakPressureDeviation
    "is_checked" IsChecked
    "evaluations" Evaluations
}

impl Quantity {
    pub fn named(name: &str) -> PyResult<Self> {
        let found = NAMES.iter().find(|(known, _)| *known == name);
        found.map(|&(_, quantity)| quantity).ok_or_else(|| {
            let all: Vec<&str> = NAMES.iter().map(|&(known, _)| known).collect();
            PyValueError::new_err(format!("no quantity {name:?}: there are {}", all.join(", ")))
        })
    }

    /// Returns a quantity that changes smoothly with the scene, and whose derivative the library
    /// knows.
    pub fn differentiable(name: &str) -> PyResult<Self> {
        let found = Self::named(name)?;
        let why = match found {
            // Found by searches for a largest value, which have no derivatives.
            Self::PeakX | Self::MaxShearX | Self::MaxShearDepth => {
                "is the place of a largest value"
            }
            Self::Contacts | Self::IsChecked | Self::Evaluations => "does not change smoothly",
            Self::PeakError
            | Self::LimitsError
            | Self::HalfWidthDeviation
            | Self::PeakPressureDeviation => "is an estimate",
            _ => return Ok(found),
        };
        Err(PyValueError::new_err(format!("{name} {why}: it has no derivative here")))
    }
}

impl Quantity {
    /// Returns what tells this quantity of a largest value that is infinite at x.
    pub fn infinite(self) -> Option<fn(f64) -> f64> {
        match self {
            Self::PeakX | Self::MaxShearX => Some(|x| x),
            Self::PeakPressure | Self::MaxShear => Some(|_| f64::INFINITY),
            Self::PeakError | Self::MaxShearDepth => Some(|_| 0.0),
            _ => None,
        }
    }
}

/// Source of quantities of one solution: results that several quantities share are computed once.
pub struct Asked<'s, T: Real> {
    solution: &'s Solution<'s, T>,
    references: Option<&'s References<T>>,
    body: Option<Body>,
    peak: OnceCell<Peak<T>>,
    shear: OnceCell<StressPeak<T>>,
    uncertainty: OnceCell<Uncertainty<T>>,
}

fn once<V: Copy, E>(cell: &OnceCell<V>, make: impl FnOnce() -> Result<V, E>) -> Result<V, E> {
    match cell.get() {
        Some(&value) => Ok(value),
        None => make().map(|value| *cell.get_or_init(|| value)),
    }
}

impl<'s, T: Real> Asked<'s, T> {
    pub fn of(
        solution: &'s Solution<'s, T>,
        references: Option<&'s References<T>>,
        body: Option<Body>,
    ) -> Self {
        Self {
            solution,
            references,
            body,
            peak: OnceCell::new(),
            shear: OnceCell::new(),
            uncertainty: OnceCell::new(),
        }
    }

    fn peak(&self) -> Result<Peak<T>, ContactError<T>> {
        once(&self.peak, || self.solution.peak())
    }

    fn shear(&self) -> Result<StressPeak<T>, ContactError<T>> {
        once(&self.shear, || match self.body {
            Some(body) => self.solution.subsurface_of(body)?.max_shear(),
            None => self.solution.subsurface()?.max_shear(),
        })
    }

    fn uncertainty(&self) -> Result<Uncertainty<T>, ContactError<T>> {
        once(&self.uncertainty, || self.solution.uncertainty())
    }

    /// Returns the value of a quantity; NaN for an error of limits that were given, for lengths
    /// without references, and for what bodies that are apart do not have.
    pub fn value(&self, quantity: Quantity) -> Result<T, ContactError<T>> {
        let (solution, nan) = (self.solution, T::of(f64::NAN));
        Ok(match quantity {
            Quantity::Load => solution.load(),
            Quantity::A => solution.a(),
            Quantity::B => solution.b(),
            Quantity::HalfWidth => solution.hull().half_width(),
            Quantity::Centre => solution.hull().centre(),
            Quantity::Tilt => solution.tilt(),
            Quantity::MeanPressure => solution.mean_pressure(),
            Quantity::PeakPressure => self.peak()?.pressure,
            Quantity::PeakX => self.peak()?.x,
            Quantity::PeakError => self.peak()?.error,
            Quantity::Moment => solution.moment()?,
            // Bodies that lift off in a sweep are no failure.
            Quantity::CentreOfPressure if solution.is_apart() => nan,
            Quantity::CentreOfPressure => solution.centre_of_pressure()?,
            Quantity::MaxShear => self.shear()?.value,
            Quantity::MaxShearX => self.shear()?.x,
            Quantity::MaxShearDepth => self.shear()?.depth,
            Quantity::Approach => match self.references {
                Some(references) => solution.approach(references)?.bodies,
                None => nan,
            },
            Quantity::Stiffness => match self.references {
                Some(references) => solution.stiffness(references)?,
                None => nan,
            },
            Quantity::Separation => solution.separation(),
            Quantity::Contacts => T::of(solution.intervals().len() as f64),
            Quantity::LimitsError => solution.limits_error().unwrap_or(nan),
            Quantity::HalfWidthDeviation | Quantity::PeakPressureDeviation
                if solution.is_apart() =>
            {
                nan
            }
            Quantity::HalfWidthDeviation => self.uncertainty()?.half_width,
            Quantity::PeakPressureDeviation => self.uncertainty()?.peak_pressure,
            Quantity::IsChecked => T::of(f64::from(u8::from(solution.report().is_checked()))),
            Quantity::Evaluations => T::of(solution.cost().evaluations as f64),
        })
    }
}
