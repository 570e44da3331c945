//! Scenes and their solvers.

use crate::call::{self, Array, Numbers};
use crate::control::{Choice, Prescribed, ReferenceRow, control, none_such, references};
use crate::profile::{AsTheyAre, Lift, Profile};
use crate::solution::{PartialSlip, Solution};
use linecontact::quadrature::Quadrature;
use linecontact::reference::PinInHole;
use linecontact::search::{LimitSearch, StoppingCriteria, strategies};
use linecontact::{
    Base, Contact, Edge, EdgePressure, Exponents, Foundation, Interval, Layer, Material, Midpoint,
    Panels, PlaneState, Real, Shear, Stack,
};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::any::Any;
use std::collections::HashMap;
use std::sync::{LazyLock, Mutex, PoisonError};

type Kept = HashMap<String, &'static (dyn Any + Send + Sync)>;

/// Makes a setting permanent, as a contact that is kept borrows its settings. Each is made once,
/// for any number of contacts.
fn kept<S: Send + Sync + 'static>(choice: &Choice, setting: S) -> &'static S {
    static ALL: LazyLock<Mutex<Kept>> = LazyLock::new(Mutex::default);
    let mut all = ALL.lock().unwrap_or_else(PoisonError::into_inner);
    let name = format!("{} {choice:?}", std::any::type_name::<S>());
    if let Some(found) = all.get(&name).and_then(|kept| kept.downcast_ref()) {
        return found;
    }
    let setting: &'static S = Box::leak(Box::new(setting));
    all.insert(name, setting);
    setting
}

fn search<T: Real>(choice: &Choice) -> PyResult<&'static dyn LimitSearch<T>> {
    let &[absolute, relative, residual, evaluations] = choice.1.as_slice() else {
        return none_such("search", choice);
    };
    // A float from an int of Python.
    let max_evaluations = evaluations as usize;
    let tolerance = StoppingCriteria { absolute, relative, residual, max_evaluations };
    match strategies::<T>(tolerance).into_iter().find(|(name, _)| *name == choice.0) {
        Some((_, search)) => Ok(&**kept(choice, search)),
        None => none_such("search", choice),
    }
}

/// Returns the names of the searches.
#[pyfunction]
pub fn searches() -> Vec<&'static str> {
    strategies::<f64>(StoppingCriteria::FULL).into_iter().map(|(name, _)| name).collect()
}

fn quadrature<T: Real>(choice: &Choice) -> PyResult<&'static dyn Quadrature<T>> {
    Ok(match (choice.0.as_str(), choice.1.as_slice()) {
        ("panels", &[tolerance]) => kept(choice, Panels { tolerance }),
        ("midpoint", &[segments, extrapolations, even]) => {
            let exponents = if even != 0.0 { Exponents::Even } else { Exponents::HalfInteger };
            let (segments, extrapolations) = (segments as usize, extrapolations as u32);
            kept(choice, Midpoint { segments, extrapolations, exponents })
        }
        _ => return none_such("quadrature", choice),
    })
}

fn edge<L: Lift>((name, value): &(String, f64), lift: &mut L) -> PyResult<Edge<L::Of>> {
    let mut given = || lift.number("value", *value);
    Ok(match name.as_str() {
        "free" => Edge::Free,
        "fixed" => Edge::Fixed(given()),
        "free_until" => Edge::FreeUntil(given()),
        "adhesive" => Edge::Adhesive(given()),
        _ => return none_such("edge", &(name.clone(), vec![*value])),
    })
}

/// Young's modulus E and Poisson's ratio ν; `None` for a rigid body.
pub type Elastic = Option<(f64, f64)>;

fn material<L: Lift>(of: Elastic, lift: &mut L) -> Material<L::Of> {
    of.map_or(Material::Rigid, |(modulus, ratio)| {
        let modulus = lift.number("youngs_modulus", modulus);
        Material::elastic(modulus, lift.number("poisson_ratio", ratio))
    })
}

/// Base of layers: "bonded" or "frictionless", or a half-plane.
#[derive(FromPyObject)]
pub enum Below {
    Rigid(String),
    HalfPlane(Elastic),
}

/// Layers from the surface down, each with its thickness, and their base; none on a half-plane.
pub type Surface = (Vec<(Elastic, f64)>, Below);

pub fn foundation<L: Lift>((layers, base): &Surface, lift: &mut L) -> PyResult<Foundation<L::Of>> {
    let mut found = Vec::new();
    let base = below(layers, base, &mut found, lift)?;
    Ok(match (&found[..], base) {
        ([], Base::HalfPlane(material)) => material.into(),
        (&[(material, thickness)], base) => Layer { material, thickness, base }.into(),
        (_, base) => Stack { layers: found, base }.into(),
    })
}

/// Lists layers, each the base of the one before, and returns the last base.
fn below<L: Lift>(
    layers: &[(Elastic, f64)],
    base: &Below,
    found: &mut Vec<(Material<L::Of>, L::Of)>,
    lift: &mut L,
) -> PyResult<Base<L::Of>> {
    let [(of, thickness), rest @ ..] = layers else {
        return match base {
            Below::HalfPlane(of) => Ok(Base::HalfPlane(material(*of, lift))),
            Below::Rigid(name) if name == "bonded" => Ok(Base::Bonded),
            Below::Rigid(name) if name == "frictionless" => Ok(Base::Frictionless),
            Below::Rigid(name) => none_such("base", &(name.clone(), Vec::new())),
        };
    };
    let material = lift.inside("material", |lift| material(*of, lift));
    found.push((material, lift.number("thickness", *thickness)));
    lift.inside("base", |lift| below(rest, base, found, lift))
}

pub fn plane(name: &str) -> PyResult<PlaneState> {
    match name {
        "strain" => Ok(PlaneState::Strain),
        "stress" => Ok(PlaneState::Stress),
        _ => Err(PyValueError::new_err(format!("plane is {name:?}: 'strain' or 'stress'"))),
    }
}

fn shear((friction, force, tension): (f64, f64, f64)) -> Shear<f64> {
    Shear { friction, force, tension }
}

/// Returns the contact modulus E* of two bodies.
#[pyfunction]
pub fn contact_modulus(
    py: Python<'_>,
    lower: Elastic,
    upper: Elastic,
    state: &str,
) -> PyResult<f64> {
    let state = plane(state)?;
    let [lower, upper] = [lower, upper].map(|of| material(of, &mut AsTheyAre));
    call::library(py, || state.contact_modulus(lower, upper))
}

/// Returns the half-angle of a pin in a hole, and the pressures at angles.
#[pyfunction]
pub fn pin_in_hole(
    py: Python<'_>,
    sizes: [f64; 3],
    materials: [Elastic; 2],
    state: &str,
    angles: Numbers<'_>,
) -> PyResult<(f64, Array)> {
    let ([radius, clearance, load], state) = (sizes, plane(state)?);
    let bodies = materials.map(|of| material(of, &mut AsTheyAre));
    let form = call::library(py, || PinInHole::under_load(radius, clearance, load, bodies, state))?;
    let pressures = angles.as_array().iter().map(|&angle| form.pressure(angle)).collect();
    Ok((form.half_angle(), call::array(py, pressures)))
}

impl Settings {
    /// Builds the contact from numbers that `lift` makes of the settings.
    fn build<L: Lift>(&self, py: Python<'_>, lift: &mut L) -> PyResult<Contact<'static, L::Of>> {
        let lower = lift.inside("lower", |lift| lift.body(py, self.lower.get()))?;
        let upper = lift.inside("upper", |lift| lift.body(py, self.upper.get()))?;
        let mut contact = call::library(py, || Contact::owned(lower, upper))?
            .watch(&call::watch)
            .certified(self.certified)
            .single_interval(self.single_interval);
        if let Some(kappa) = self.kappa {
            contact = contact.kappa(lift.number("kappa", kappa));
        }
        if let Some(modulus) = self.contact_modulus {
            contact = contact.contact_modulus(lift.number("contact_modulus", modulus));
        }
        if let Some((lower, upper, state)) = &self.materials {
            let [lower, upper] = lift.inside("materials", |lift| {
                [(0, lower), (1, upper)].map(|(i, of)| lift.inside(i, |lift| foundation(of, lift)))
            });
            contact = contact.materials(lower?, upper?, plane(state)?);
        }
        if let Some([left, right]) = &self.edges {
            let (left, right) = lift.inside("edges", |lift| {
                let left = lift.inside(0, |lift| edge(left, lift))?;
                Ok::<_, PyErr>((left, lift.inside(1, |lift| edge(right, lift))?))
            })?;
            contact = contact.edges(left, right);
        }
        if let Some([at_a, at_b, distance_a, distance_b, tolerance_a, tolerance_b]) =
            self.edge_pressure
        {
            contact = contact.edge_pressure(lift.inside("edge_pressure", |lift| EdgePressure {
                at_a: lift.number("at_a", at_a),
                at_b: lift.number("at_b", at_b),
                distance_a: lift.number("distance_a", distance_a),
                distance_b: lift.number("distance_b", distance_b),
                tolerance_a: <L::Of as Real>::of(tolerance_a),
                tolerance_b: <L::Of as Real>::of(tolerance_b),
            }));
        }
        if let Some([left, right]) = self.start.map(|ends| ends.map(<L::Of as Real>::of)) {
            contact = contact.start(Interval { left, right });
        }
        if let Some(choice) = &self.inversion {
            contact = contact.inversion(search(choice)?);
        }
        if let Some(choice) = &self.limit_search {
            contact = contact.limit_search(search(choice)?);
        }
        if let Some(choice) = &self.quadrature {
            contact = contact.quadrature(quadrature(choice)?);
        }
        if let Some(length) = self.resolution {
            contact = contact.resolution(<L::Of as Real>::of(length));
        }
        if let Some(period) = self.period {
            contact = contact.period(lift.number("period", period));
        }
        Ok(contact)
    }
}

/// Two bodies, their stiffness, edges and settings.
#[pyclass(frozen, module = "linecontact._native")]
pub struct Scene {
    settings: Settings,
    pub contact: Contact<'static, f64>,
}

impl Scene {
    /// Returns the contact in numbers of another kind.
    pub fn lifted<L: Lift>(
        &self,
        py: Python<'_>,
        lift: &mut L,
    ) -> PyResult<Contact<'static, L::Of>> {
        self.settings.build(py, lift)
    }
}

/// Makes the class of scenes from its settings.
macro_rules! scene {
    ($($setting:ident: $type:ty,)*) => {
        /// Everything that a contact is made of.
        struct Settings {
            $($setting: $type,)*
        }

        #[pymethods]
        impl Scene {
            #[new]
            #[pyo3(signature = (*, $($setting),*))]
            #[expect(clippy::too_many_arguments, reason = "each is a setting with a name")]
            fn new(py: Python<'_>, $($setting: $type),*) -> PyResult<Self> {
                let settings = Settings { $($setting),* };
                let contact = settings.build(py, &mut AsTheyAre)?;
                Ok(Self { settings, contact })
            }

            fn solve(&self, py: Python<'_>, prescribed: Prescribed) -> PyResult<Solution> {
                let control = control(prescribed)?;
                call::library(py, || self.contact.solve(control)).map(Solution)
            }

            fn partial_slip(
                &self,
                py: Python<'_>,
                prescribed: Prescribed,
                acting: (f64, f64, f64),
            ) -> PyResult<PartialSlip> {
                let (control, shear) = (control(prescribed)?, shear(acting));
                call::library(py, || self.contact.partial_slip(control, shear)).map(PartialSlip)
            }
        }
    };
}
scene! {
    lower: Py<Profile>,
    upper: Py<Profile>,
    kappa: Option<f64>,
    contact_modulus: Option<f64>,
    materials: Option<(Surface, Surface, String)>,
    edges: Option<[(String, f64); 2]>,
    edge_pressure: Option<[f64; 6]>,
    start: Option<[f64; 2]>,
    inversion: Option<Choice>,
    limit_search: Option<Choice>,
    quadrature: Option<Choice>,
    resolution: Option<f64>,
    period: Option<f64>,
    certified: bool,
    single_interval: bool,
}

/// Solver that starts from the contact found last.
#[pyclass(frozen, module = "linecontact._native")]
pub struct Solver(Mutex<linecontact::Solver<f64>>);

#[pymethods]
impl Solver {
    #[new]
    fn new() -> Self {
        Self(Mutex::new(linecontact::Solver::new()))
    }

    fn solve(
        &self,
        py: Python<'_>,
        scene: Bound<'_, Scene>,
        prescribed: Prescribed,
    ) -> PyResult<Solution> {
        let (contact, control) = (&scene.get().contact, control(prescribed)?);
        call::alone(py, &self.0, "Solver", |solver| solver.solve(contact, control)).map(Solution)
    }

    fn partial_slip(
        &self,
        py: Python<'_>,
        scene: Bound<'_, Scene>,
        prescribed: Prescribed,
        acting: (f64, f64, f64),
    ) -> PyResult<PartialSlip> {
        let (contact, control) = (&scene.get().contact, control(prescribed)?);
        let slip = |solver: &mut linecontact::Solver<f64>| {
            solver.partial_slip(contact, control, shear(acting))
        };
        call::alone(py, &self.0, "Solver", slip).map(PartialSlip)
    }
}

/// Load as a function of approach.
#[pyclass(frozen, module = "linecontact._native")]
pub struct SpringTable(pub linecontact::SpringTable<f64>);

type Columns = (Array, Array, Array, Array, Array);

/// Returns approach, load, stiffness, half-width and peak; a peak of `None` is infinite.
fn columns(py: Python<'_>, points: impl Iterator<Item = linecontact::SpringPoint<f64>>) -> Columns {
    let points: Vec<_> = points.collect();
    let column = |of: fn(&linecontact::SpringPoint<f64>) -> f64| {
        call::array(py, points.iter().map(of).collect())
    };
    (
        column(|point| point.approach),
        column(|point| point.load),
        column(|point| point.stiffness),
        column(|point| point.half_contact),
        column(|point| point.peak.unwrap_or(f64::INFINITY)),
    )
}

#[pymethods]
impl SpringTable {
    #[new]
    fn new(
        py: Python<'_>,
        scene: Bound<'_, Scene>,
        to: ReferenceRow,
        loads: [f64; 2],
        tolerance: f64,
    ) -> PyResult<Self> {
        let (contact, to) = (&scene.get().contact, references(to)?);
        call::library(py, || linecontact::SpringTable::new(contact, &to, loads, tolerance))
            .map(Self)
    }

    #[getter]
    fn error(&self) -> f64 {
        self.0.error()
    }

    #[getter]
    fn stiffness_error(&self) -> f64 {
        self.0.stiffness_error()
    }

    #[getter]
    fn touch_error(&self) -> f64 {
        self.0.touch_error()
    }

    fn points(&self, py: Python<'_>) -> Columns {
        columns(py, self.0.points())
    }

    fn at(&self, py: Python<'_>, approach: Numbers<'_>) -> PyResult<Columns> {
        let approach = approach.as_array().to_vec();
        let found: Vec<_> = call::library(py, || {
            approach.iter().map(|&approach| self.0.at(approach)).collect::<Result<_, _>>()
        })?;
        Ok(columns(py, found.into_iter()))
    }
}
