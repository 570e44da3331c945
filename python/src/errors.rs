//! Each error of the library as an exception with its numbers: the classes are in `errors.py`.

use linecontact::autodiff::num_dual::Dual64;
use linecontact::profile::SplineError;
use linecontact::search::{Root, SearchError};
use linecontact::{
    Body, ContactError, Edge, Ends, EvaluationError, InputError, Interval, PiecewiseError,
    ProfileError, Real, SolveError,
};
use pyo3::IntoPyObjectExt;
use pyo3::prelude::*;
use std::fmt::Display;

/// Name of a class, and its attributes.
type Row = (&'static str, Vec<(&'static str, Py<PyAny>)>);

/// Error that has a class.
pub trait Describe: Display {
    fn row(&self, py: Python<'_>) -> PyResult<Row>;
}

/// Value that an error names.
pub trait Named {
    fn named(&self, py: Python<'_>) -> PyResult<Py<PyAny>>;
}

macro_rules! plain {
    ($($type:ty),*) => {$(
        impl Named for $type {
            fn named(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
                (*self).into_py_any(py)
            }
        }
    )*};
}
plain!(f64, usize, u32, bool, &'static str);

impl Named for Dual64 {
    fn named(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        self.re.named(py)
    }
}

macro_rules! nested {
    ($($type:ident),*) => {$(
        impl<T: Real + Named> Named for $type<T> {
            fn named(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
                to_python(py, self).into_py_any(py)
            }
        }
    )*};
}
nested!(ProfileError, SearchError, ContactError);

impl<T: Named> Named for Box<T> {
    fn named(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        (**self).named(py)
    }
}

impl<T: Named> Named for [T; 2] {
    fn named(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        (self[0].named(py)?, self[1].named(py)?).into_py_any(py)
    }
}

impl<T: Real + Named> Named for Interval<T> {
    fn named(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        [self.left, self.right].named(py)
    }
}

impl<T: Named> Named for Ends<T> {
    fn named(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        (self.left.named(py)?, self.right.named(py)?).into_py_any(py)
    }
}

impl Named for Body {
    fn named(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        self.to_string().into_py_any(py)
    }
}

impl Named for Option<Body> {
    fn named(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        self.map_or(Ok(py.None()), |body| body.named(py))
    }
}

impl<T: Named> Named for Edge<T> {
    fn named(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        match self {
            Self::Free => ("free", None),
            Self::Fixed(x) => ("fixed", Some(x.named(py)?)),
            Self::FreeUntil(x) => ("free_until", Some(x.named(py)?)),
            Self::Adhesive(work) => ("adhesive", Some(work.named(py)?)),
        }
        .into_py_any(py)
    }
}

impl<T: Named> Named for Root<T> {
    fn named(&self, py: Python<'_>) -> PyResult<Py<PyAny>> {
        (self.x.named(py)?, self.residual.named(py)?, self.evaluations).into_py_any(py)
    }
}

/// Names the classes of an enum by a prefix and the variant, and their attributes by the fields.
macro_rules! table {
    ($type:ident, $prefix:literal, $names:ident, transparent: [$($inner:ident),*];
     $($variant:ident { $($field:ident),* };)*) => {
        impl<T: Real + Named> Describe for $type<T> {
            fn row(&self, py: Python<'_>) -> PyResult<Row> {
                Ok(match self {
                    $(Self::$inner(error) => return error.row(py),)*
                    $(Self::$variant { $($field),* } => {
                        let numbers = vec![$((stringify!($field), $field.named(py)?)),*];
                        (concat!($prefix, stringify!($variant), "Error"), numbers)
                    })*
                    // The enums may grow; a test compares their variants with the classes.
                    _ => ("LineContactError", Vec::new()),
                })
            }
        }

        const $names: &[(&str, &[&str])] = &[
            $((concat!($prefix, stringify!($variant), "Error"), &[$(stringify!($field)),*]),)*
        ];
    };
}

impl<T: Real + Named> Describe for ContactError<T> {
    fn row(&self, py: Python<'_>) -> PyResult<Row> {
        match self {
            Self::Input(error) => error.row(py),
            Self::Solve(error) => error.row(py),
            Self::Evaluation(error) => error.row(py),
        }
    }
}

table! {
    InputError, "", INPUT, transparent: [Shape, Pieces, Points];
    Profile { body, source };
    NoCommonRange { lower, upper };
    InvalidLoad { quantity, value, must };
    Pose { x, y, angle, source };
    InvalidKappa { kappa };
    InvalidModulus { modulus };
    InvalidLimits { interval };
    InvalidThickness { body, thickness };
    InvalidPeriod { period };
    NotPeriodic { body, what, ends };
    Kernel { what, at };
    LayerTooThin { ratio, limit };
    KernelNotSupported { why };
    InvalidEdgePressure { name, value };
    InvalidSegments { segments, extrapolations };
    InconsistentHeights { between, by_heights, by_slopes };
    NotConvex { between, slopes };
    InvalidTolerance { tolerance };
    InvalidResolution { resolution, least };
    InvalidAdhesion { work };
    BothLimitsGiven { interval };
    InvalidMoment { quantity, value };
    TiltNotSupported { why };
    PeakEdge { edge };
    InvalidPoissonRatio { body, ratio };
    InvalidYoungsModulus { body, modulus };
    BothRigid {};
    NoMaterials {};
    InvalidReference { length };
    InvalidRelief { z, height };
    Relief { source };
    InvalidRoller { length, slices, most };
    InvalidFriction { coefficient };
    InvalidSlipFriction { friction };
    InvalidShear { quantity, value };
    UnlikeBodies { beta };
    SlipNotSupported { why };
    EdgePressureLoad {};
}
table! {
    SolveError, "", SOLVE, transparent: [];
    Bending { residual, solves };
    CompleteContact { load, complete };
    Cancelled { evaluations, last };
    OutsideBodies { x, range };
    Inversion { body, x, source };
    NoFirstContact { x, slope };
    DomainTooShort { end, carried, load, half_width, peak, kappa_is_default };
    HalfWidthTooLarge { wanted, half_width, end, load, peak, kappa_is_default };
    NoEquilibrium { half_width, near };
    Overflow { interval };
    BudgetSpent { evaluations, budget, last };
    LimitSearch { best, source };
    EdgePressureNotMet { best, at_a, at_b };
    Tension { x, pressure, interval, load };
    LiftsOff { x, strength, interval, load };
    Overlap { x, gap, interval, load };
    FeatureMissed { x, slope, assumed };
    Unbalanced { x, strength, allowed };
    Undecided { x, evaluations, samples };
    TiltNotFound { load, at, reached, tilt, ends };
    PullOff { load, least };
    PeakTooHigh { wanted, half_width, found, end, load, kappa_is_default };
    NoPeak { wanted, half_width, found };
    InJump { wanted, load, below, above };
    LoadUnknown { half_width, load };
    ApproachTooLarge { wanted, approach, load };
    Falls { quantity, load, rate };
    ToleranceNotReached { tolerance, reached };
    LoadBeyondBodies { load, at, ends };
    LoadBeyondSlices { load, at, ends };
    OneSlice { z };
    RollerNotFound { source };
    SlipsEverywhere { force, limit };
    SticksEverywhere { force, limit };
    ReversedSlip { zone, contact };
}
table! {
    EvaluationError, "", EVALUATION, transparent: [];
    Singular { x };
    AboveSurface { x, depth };
    NoStress { depths };
    OutsideTable { approach, range };
    SliceOutsideTable { z, approach, range };
    InvalidPosition { x, inside, interval };
    HalfPlanesOnly { quantity };
    NoLoadDerivative { why };
    NoUncertainty { why };
    LengthMismatch { x, pressures };
    Integral { x, panels };
    Unresolved { x, pressure, error };
}
table! {
    ProfileError, "Profile", PROFILE, transparent: [];
    Parameter { name, value, must };
    Joined { pieces };
    Domain { from, to };
    NotFinite { quantity, k, value };
    Derivative { quantity, k, given, difference };
    TurnsBack { k, x, domain };
    Pieces { count, index };
}
table! {
    PiecewiseError, "Piecewise", PIECEWISE, transparent: [];
    InPiece { piece, source };
    InSegment { segment, source };
    Tolerance { tolerance };
    NoPieces {};
    Gap { breakpoint, left, right, share };
    Overlap { breakpoint, left, right, share };
    Jump { breakpoint, x, left, right, share };
}
table! {
    SplineError, "Spline", SPLINE, transparent: [];
    TooFew { points };
    NotFinite { row, x, y };
    Duplicate { row, x };
    Unsorted { row, x, before };
    Outlier { row, x, y, expected, deviations };
    Period { period, first, last };
    Limit { deviations };
    Overflow { row, x, before };
}
table! {
    SearchError, "Search", SEARCH, transparent: [];
    Bracket { lo, hi };
    NoSignChange { lo, hi, f_lo, f_hi };
    NotFinite { x, value };
    Budget { best };
    LeftBracket { x, lo, hi };
    NotConverged { x, residual };
    Tolerance { value };
}

/// Returns the name in Python of a field that may be a keyword there.
fn attribute(field: &'static str) -> &'static str {
    if field == "from" { "from_" } else { field }
}

/// Makes the exception of an error.
pub fn to_python<E: Describe + ?Sized>(py: Python<'_>, error: &E) -> PyErr {
    let made = || {
        let (name, numbers) = error.row(py)?;
        let class = py.import("linecontact.errors")?.getattr(name)?;
        let exception = class.call1((error.to_string(),))?;
        for (field, value) in numbers {
            if field == "source" {
                exception.setattr("__cause__", &value)?;
            }
            exception.setattr(attribute(field), value)?;
        }
        Ok::<_, PyErr>(PyErr::from_value(exception))
    };
    made().unwrap_or_else(|failed| failed)
}

/// Makes the exception for a function that does not return four arrays.
pub fn missing_derivatives(py: Python<'_>, count: usize) -> PyErr {
    let made = || {
        let class = py.import("linecontact.errors")?.getattr("MissingDerivativesError")?;
        Ok::<_, PyErr>(PyErr::from_value(class.call1((count,))?))
    };
    made().unwrap_or_else(|failed| failed)
}

/// Returns all classes in the table, with the names of their attributes.
#[pyfunction]
pub fn variants() -> Vec<(&'static str, Vec<&'static str>)> {
    let tables = [INPUT, SOLVE, EVALUATION, PROFILE, PIECEWISE, SPLINE, SEARCH];
    tables
        .into_iter()
        .flatten()
        .map(|&(name, fields)| (name, fields.iter().copied().map(attribute).collect()))
        .collect()
}
