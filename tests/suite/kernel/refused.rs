//! What a layer or another kernel does not allow, and faults of kernels.

use super::{RIGID, coated, half_plane, layer, parabola};
use crate::common::{Profile, graph};
use linecontact::profile::Ellipse;
use linecontact::search::Brent;
use linecontact::{
    Base, Contact, ContactError, Control, Edge, EdgePressure, EvaluationError, Flat, InputError,
    Material, Midpoint, PlaneState, Reference, References, RegularKernel, Shear, SolveError,
    SurfaceCompliance,
};
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

fn refusal(contact: &Contact<'_, f64>, control: Control<f64>) -> &'static str {
    match contact.solve(control).unwrap_err() {
        ContactError::Input(InputError::KernelNotSupported { why }) => why,
        other => panic!("{other}"),
    }
}

#[test]
fn settings_that_no_kernel_allows() {
    let body = parabola(6.0);
    let contact = coated(&body, layer(1.0, 0.3, 1.0, Base::Bonded), RIGID);
    let load = Control::Load(0.5);
    let adhesive = contact.clone().edges(Edge::Adhesive(0.01), Edge::Adhesive(0.01));
    assert!(refusal(&adhesive, load).contains("Adhesive"));
    let searched = contact.clone().limit_search(&Brent::DEFAULT);
    assert!(refusal(&searched, load).contains("strategy"));
    let paper = contact.clone().edge_pressure(EdgePressure::zero(1e-3, 1e-9));
    assert!(refusal(&paper, load).contains("Eq. (6)"));
    let midpoint = contact.clone().quadrature(&Midpoint::DEFAULT);
    assert!(refusal(&midpoint, load).contains("quadrature"));
    let references =
        References { x: 0.0, lower: Reference::Depth(2.0), upper: Reference::Depth(2.0) };
    let shear = Shear { friction: 0.3, force: 0.01, tension: 0.0 };
    let slip = contact.partial_slip(load, shear).map(|_| ()).unwrap_err();
    assert!(slip.to_string().contains("layer"), "{slip}");

    // Of another compliance the depth is not known.
    let soft = coated(&body, layer(1.0, 0.3, 1.0, half_plane(0.2, 0.3)), RIGID);
    let solution = soft.compliance(super::own_compliance()).solve(load).unwrap();
    let refused = [
        solution.approach(&references).map(|_| ()).unwrap_err(),
        solution.stiffness(&references).map(|_| ()).unwrap_err(),
        solution.subsurface().map(|_| ()).unwrap_err(),
        solution.uncertainty().map(|_| ()).unwrap_err(),
    ];
    for error in refused {
        let is_typed =
            matches!(error, ContactError::Evaluation(EvaluationError::HalfPlanesOnly { .. }));
        assert!(is_typed, "{error}");
    }
}

#[test]
fn impossible_layers_are_refused() {
    let body = parabola(6.0);
    let solve = |layer| coated(&body, layer, RIGID).solve(Control::Load(0.5)).map(|_| ());
    for thickness in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = solve(layer(1.0, 0.3, thickness, Base::Bonded)).unwrap_err();
        let is_typed = matches!(error, ContactError::Input(InputError::InvalidThickness { .. }));
        assert!(is_typed, "{error}");
    }
    let error = solve(layer(1.0, 0.6, 1.0, Base::Bonded)).unwrap_err();
    assert!(matches!(error, ContactError::Input(InputError::InvalidPoissonRatio { .. })));
    let error = solve(layer(1.0, 0.3, 1.0, half_plane(-1.0, 0.3))).unwrap_err();
    assert!(matches!(error, ContactError::Input(InputError::InvalidYoungsModulus { .. })));
    // With both bodies rigid at the surface nothing gives way.
    let rigid = Material::Rigid;
    let error = coated(&body, rigid, rigid).solve(Control::Load(0.5)).map(|_| ()).unwrap_err();
    assert!(matches!(error, ContactError::Input(InputError::BothRigid)));
    let thin = coated(&body, layer(1.0, 0.3, 1e-3, half_plane(2.0, 0.3)), RIGID);
    match thin.solve(Control::Load(0.5)).map(|_| ()).unwrap_err() {
        ContactError::Input(InputError::LayerTooThin { ratio, limit }) => {
            assert!(ratio > 100.0 && ratio < 2000.0 && limit == 100.0);
        }
        other => panic!("{other}"),
    }
}

/// The contact is as wide as on half-planes of the base, or on springs, however soft the layer is:
/// on bodies of any length it is told by a ratio, good to a tenth where it is known.
#[test]
fn however_thin_a_layer_is_it_is_told() {
    let steel = half_plane(210e3, 0.3);
    let cases = [
        (5.0, 1e-12, steel, 1.05e11),
        (5.0, 1e-3, steel, f64::NAN),
        (5.0, 1e-3, Base::Bonded, f64::NAN),
        // As cells tell it on shorter bodies.
        (5.0, 3e-3, steel, 130.9),
        (5.0, 3e-3, Base::Frictionless, 294.0),
        (500.0, 1e-3, steel, f64::NAN),
        (5000.0, 1e-6, steel, 1.05e5),
        (5000.0, 1e-4, Base::Bonded, 743.0),
    ];
    for (modulus, thickness, base, known) in cases {
        for end in [5.0, 9.9] {
            let angle = f64::asin(end / 10.0);
            let roller: Profile = Box::new(Ellipse::circle(10.0, [-angle, angle]).unwrap());
            let material = Material::elastic(210e3, 0.3);
            let scene = coated(&roller, material, layer(modulus, 0.49, thickness, base));
            let error = scene.solve(Control::Load(100.0)).map(|_| ()).unwrap_err();
            let ContactError::Input(InputError::LayerTooThin { ratio, .. }) = error else {
                panic!("{modulus}, {thickness}, {base:?}, up to {end}: {error}");
            };
            let is_known = known.is_nan() || (ratio / known - 1.0).abs() <= 0.11;
            assert!(ratio > 100.0 && is_known, "{ratio} {known}");
        }
    }
}

/// Compliance with a fault.
struct Faulty {
    excess: f64,
    decay: f64,
}

impl SurfaceCompliance<f64> for Faulty {
    fn excess(&self, wavenumber: f64) -> f64 {
        self.excess * (-wavenumber).exp()
    }

    fn decay(&self) -> f64 {
        self.decay
    }

    fn longest(&self) -> f64 {
        1.0
    }
}

/// Kernel with a fault.
struct NotANumber {
    is_slope: bool,
}

impl RegularKernel<f64> for NotANumber {
    fn slope(&self, x: f64, _: f64) -> f64 {
        if self.is_slope && x > 0.1 { f64::NAN } else { 0.0 }
    }

    fn height(&self, x: f64, _: f64) -> f64 {
        if !self.is_slope && x > 0.1 { f64::NAN } else { 0.0 }
    }

    fn nearest_singularity(&self) -> f64 {
        1.0
    }
}

#[test]
fn faulty_kernels_are_refused() {
    let body: Profile = parabola(6.0);
    let contact = Contact::new(&Flat, &*body).unwrap().contact_modulus(1.0);
    let fault = |contact: Contact<'_, f64>| match contact.solve(Control::Load(0.5)) {
        Err(ContactError::Input(InputError::Kernel { what, .. })) => what,
        Err(other) => panic!("{other}"),
        Ok(_) => panic!("solved"),
    };
    for excess in [-1.5, f64::NAN, f64::INFINITY] {
        let faulty = Arc::new(Faulty { excess, decay: 1.0 });
        assert_eq!(
            fault(contact.clone().compliance(faulty)),
            "the compliance is not a positive number at ω"
        );
    }
    for decay in [0.0, -1.0, f64::NAN] {
        let faulty = Arc::new(Faulty { excess: 0.5, decay });
        assert!(fault(contact.clone().compliance(faulty)).contains("decay"));
    }
    for is_slope in [true, false] {
        let kernel = NotANumber { is_slope };
        assert!(fault(contact.clone().kernel(&kernel)).contains("not finite at x"));
    }
    // What is plain stays so: the kernel of nothing is not asked for.
    let plain = contact.clone().materials(RIGID, Material::elastic(1.0, 0.3), PlaneState::Strain);
    assert!(plain.solve(Control::Load(0.5)).unwrap().load_rates().is_ok());
}

/// A solve that is cancelled ends, under each control: no other way is tried.
#[test]
fn a_cancelled_solve_ends() {
    let body = parabola(6.0);
    for control in [Control::Load(0.5), Control::HalfWidth(0.7), Control::PeakPressure(0.4)] {
        let asked = AtomicUsize::new(0);
        let once = |_, _| match asked.fetch_add(1, Ordering::Relaxed) {
            2 => ControlFlow::Break(()),
            _ => ControlFlow::Continue(()),
        };
        let contact = coated(&body, layer(1.0, 0.3, 1.0, Base::Bonded), RIGID).watch(&once);
        let error = contact.solve(control).map(|_| ()).unwrap_err();
        let is_cancelled = matches!(error, ContactError::Solve(SolveError::Cancelled { .. }));
        assert!(is_cancelled, "{control:?}: {error}");
    }
}

/// Asks a contact for a load, a width, a peak and an approach, and returns the errors.
fn failures(contact: &Contact<'_, f64>, controls: [Control<f64>; 4]) -> [ContactError<f64>; 4] {
    controls.map(|control| contact.solve(control).map(|_| ()).unwrap_err())
}

/// An upside-down body is told as such on a layer as on half-planes, and at once: in thousands of
/// values of its curve, where a search for a layer takes millions.
#[test]
fn a_body_upside_down_is_named_on_a_layer_too() {
    let asked = Arc::new(AtomicUsize::new(0));
    let counter = asked.clone();
    let body = graph(-2.0, 2.0, move |x| {
        counter.fetch_add(1, Ordering::Relaxed);
        [-0.05 * x * x, -0.1 * x]
    });
    let coating = layer(1.0, 0.3, 0.5, half_plane(0.3, 0.3));
    let references =
        References { x: 0.0, lower: Reference::Depth(20.0), upper: Reference::Depth(20.0) };
    let contact = coated(&body, coating, Material::elastic(1.0, 0.3));
    let controls = [
        Control::Load(5e-4),
        Control::HalfWidth(0.5),
        Control::PeakPressure(0.002),
        Control::Approach { approach: 0.01, references },
    ];
    for (error, control) in failures(&contact, controls).into_iter().zip(controls) {
        let is_typed = matches!(error, ContactError::Solve(SolveError::NoFirstContact { .. }));
        assert!(is_typed && error.to_string().contains("flip"), "{control:?}: {error}");
    }
    let turned = contact.solve(Control::Moment { load: 5e-4, moment: 1e-6, about: 0.0 });
    let Err(ContactError::Solve(SolveError::DomainTooShort { carried, end, .. })) = turned else {
        panic!("{:?}", turned.map(|_| ()))
    };
    assert!(carried == 0.0 && end.abs() == 2.0);
    let asked = asked.load(Ordering::Relaxed);
    println!("{asked} values");
    assert!(asked < 100_000, "{asked} values");
}

/// Bodies with a layer bear another load than half-planes (here a fifth more): what these bear is
/// not said, and what is said was solved.
#[test]
fn a_body_too_short_for_its_layer_is_told_no_load_of_half_planes() {
    let body = graph(-2.0, 2.0, |x| [0.05 * x * x, 0.1 * x]);
    let coating = layer(210e3, 0.3, 0.5, half_plane(70e3, 0.3));
    let contact = coated(&body, coating, Material::elastic(210e3, 0.3));
    assert!((contact.solve(Control::Load(21630.0)).unwrap().a() - 1.9966).abs() < 1e-3);
    let references =
        References { x: 0.0, lower: Reference::Depth(20.0), upper: Reference::Depth(20.0) };
    let controls = [
        Control::Load(31500.0),
        Control::HalfWidth(3.0),
        Control::PeakPressure(7e3),
        Control::Approach { approach: 1.0, references },
    ];
    let [by_load, by_width, by_peak, by_approach] = failures(&contact, controls);
    for load in [21840.0, 31500.0, 1e6] {
        let error = contact.solve(Control::Load(load)).map(|_| ()).unwrap_err();
        let ContactError::Solve(SolveError::DomainTooShort { carried, half_width, .. }) = error
        else {
            panic!("{load}: {error}")
        };
        assert!(carried.is_nan() && half_width.is_nan(), "{load}: {carried}, {half_width}");
    }
    let message = by_load.to_string();
    assert!(message.contains("x = -2 under the load 31500:"), "{message}");
    let is_near = |load: f64| load > 21200.0 && load < 21700.0;
    match by_width {
        ContactError::Solve(SolveError::HalfWidthTooLarge { half_width, load, .. }) => {
            assert!(half_width > 1.97 && half_width <= 2.0 && is_near(load), "{half_width} {load}");
        }
        other => panic!("{other}"),
    }
    match by_peak {
        ContactError::Solve(SolveError::PeakTooHigh { half_width, load, found, .. }) => {
            let peak = contact.solve(Control::Load(load)).unwrap().peak().unwrap().pressure;
            assert!((found / peak - 1.0).abs() < 1e-12 && is_near(load));
            assert!(half_width > 1.97 && half_width <= 2.0);
        }
        other => panic!("{other}"),
    }
    match by_approach {
        ContactError::Solve(SolveError::ApproachTooLarge { load, .. }) => assert!(is_near(load)),
        other => panic!("{other}"),
    }
    // Close to what the bodies bear all is still found.
    let widest = contact.solve(Control::HalfWidth(1.9999)).unwrap();
    let peak = contact.solve(Control::PeakPressure(widest.peak().unwrap().pressure)).unwrap();
    assert!((peak.load() / widest.load() - 1.0).abs() < 1e-9);
}

/// A contact wider than is solved is refused with its own ratio, and a peak that takes more than
/// that in few solves.
#[test]
fn a_layer_too_thin_is_told_at_once_by_its_own_ratio() {
    let asked = Arc::new(AtomicUsize::new(0));
    let counter = asked.clone();
    let body = graph(-2.0, 2.0, move |x| {
        counter.fetch_add(1, Ordering::Relaxed);
        [0.05 * x * x, 0.1 * x]
    });
    let contact = coated(&body, layer(210e3, 0.3, 0.005, half_plane(70e3, 0.3)), RIGID);
    let ratio = |control| match contact.solve(control).map(|_| ()).unwrap_err() {
        ContactError::Input(InputError::LayerTooThin { ratio, .. }) => ratio,
        other => panic!("{other}"),
    };
    assert_eq!(ratio(Control::HalfWidth(0.75)), 150.0);
    assert!(asked.swap(0, Ordering::Relaxed) < 10);
    let unreachable = ratio(Control::PeakPressure(1e7));
    let asked = asked.load(Ordering::Relaxed);
    println!("{asked} values, {unreachable}");
    assert!(asked < 10_000, "{asked} values");
    assert!(unreachable > 100.0 && unreachable < 110.0, "{unreachable}");
}
