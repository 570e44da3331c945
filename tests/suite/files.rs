//! Bodies, settings and results through JSON and back: unchanged, or refused with the constructor's
//! error.

use crate::common::{controls::controls_of, on_flat, quartic};
use linecontact::profile::{Crowning, Ellipse, Fit, Involute, Line, Parabola};
use linecontact::search::{Bisection, Brent, Newton, Secant, StoppingCriteria};
use linecontact::{
    Base, Contact, Control, Convexity, CurvePoint, Edge, EdgePressure, Estimate, Exponents, Flat,
    Foundation, Interval, Layer, Material, Midpoint, Panels, PlaneState, Reference, References,
    Report, Shear, Solution, SpringTable, Summary,
};
use serde::Serialize;
use serde::de::DeserializeOwned;
use std::fmt::Debug;

fn there_and_back<V: Serialize + DeserializeOwned>(value: &V) -> V {
    serde_json::from_str(&serde_json::to_string(value).unwrap()).unwrap()
}

fn is_kept<V: Serialize + DeserializeOwned + PartialEq + Debug>(value: V) {
    assert_eq!(there_and_back(&value), value);
}

#[test]
fn bodies_are_kept() {
    is_kept(Flat);
    is_kept(Parabola::new(3.0f64, [-1.0, 2.0]).unwrap());
    is_kept(Parabola::new(0.1f32, [-1.0, 2.0]).unwrap());
    is_kept(Ellipse::new(3.0f64, -0.7, [-1.1, 1.2]).unwrap());
    is_kept(Line::new(-0.3f64, [0.0, 0.1]).unwrap());
    is_kept(Involute::new(50.0f64, 0.4, [0.1, 0.7]).unwrap());
    is_kept(Crowning::new(0.01f64, 5.0, [-5.0, 4.9]).unwrap());
}

#[test]
fn bodies_are_what_a_user_writes() {
    let read: Parabola<f64> = serde_json::from_str(r#"{"radius": 2, "domain": [-1, 1]}"#).unwrap();
    assert_eq!(read, Parabola::new(2.0, [-1.0, 1.0]).unwrap());
}

/// Returns the error for text that is not a valid `V`.
fn refusal<V: DeserializeOwned>(json: &str) -> String {
    match serde_json::from_str::<V>(json) {
        Ok(_) => panic!("{json} was taken"),
        Err(error) => error.to_string(),
    }
}

#[test]
fn bad_bodies_are_refused_as_by_their_constructors() {
    let radius = refusal::<Parabola<f64>>(r#"{"radius": 0.0, "domain": [-1.0, 1.0]}"#);
    let by_constructor = Parabola::new(0.0f64, [-1.0, 1.0]).unwrap_err();
    assert_eq!(radius, by_constructor.to_string());
    assert!(radius.contains("the radius is 0:"), "{radius}");

    let base = r#"{"base_radius": -1.0, "origin": 0.4, "angles": [0.0, 0.8]}"#;
    let said = [
        (refusal::<Involute<f64>>(base), "the base radius is -1:"),
        (
            refusal::<Parabola<f64>>(r#"{"radius": 1.0, "domain": [1.0, 1.0]}"#),
            "k cannot run from 1 to 1:",
        ),
        (refusal::<Parabola<f64>>(r#"{"domain": [-1.0, 1.0]}"#), "missing field `radius`"),
        (refusal::<Parabola<f64>>(r#"{"radius": 1.0, "domian": [-1.0, 1.0]}"#), "`domian`"),
        (
            refusal::<Ellipse<f64>>(r#"{"along": 1.0, "across": 0.0, "angles": [-1.0, 1.0]}"#),
            "the semi-axis across it is 0: it",
        ),
        (
            refusal::<Crowning<f64>>(
                r#"{"depth": 0.1, "half_length": 1.0, "domain": [-1.0, 1.5]}"#,
            ),
            "an end is 1.5",
        ),
        (refusal::<Line<f64>>(r#"{"slope": null, "domain": [-1.0, 1.5]}"#), "null"),
    ];
    for (message, expected) in said {
        assert!(message.contains(expected), "{message}");
    }
}

#[test]
fn settings_are_kept_and_have_their_defaults() {
    is_kept(StoppingCriteria { residual: 1e-3, ..StoppingCriteria::relative(0.1) });
    is_kept(Bisection { tolerance: StoppingCriteria::relative(1e-3) });
    is_kept(Panels { tolerance: 1e-7 });
    is_kept(Midpoint { exponents: Exponents::Even, ..Midpoint::DEFAULT });
    is_kept(Fit { smooth: true, outliers: None::<f64>, period: None });
    is_kept(Fit { period: Some(0.7), ..Fit::default() });
    is_kept(Edge::<f64>::Free);
    is_kept(Edge::FreeUntil(0.3));
    is_kept(EdgePressure::zero(0.1, 1e-3));
    let (soft, state) = (Material::elastic(1.0, 0.3), PlaneState::Strain);
    let contact = on_flat(quartic(-2.0, 2.0)).materials(soft, soft, state);
    let controls = controls_of(&contact.solve(Control::Load(0.5)).unwrap());
    assert!(controls.len() > 5);
    controls.into_iter().for_each(is_kept);
    is_kept(Material::elastic(210e3, 0.3));
    is_kept(Material::<f64>::Rigid);
    is_kept(Foundation::from(Material::elastic(210e3, 0.3)));
    is_kept(Foundation::<f64>::from(Material::Rigid));
    for base in [Base::Bonded, Base::Frictionless, Base::HalfPlane(Material::Rigid)] {
        is_kept(Foundation::from(Layer { material: soft, thickness: 0.1, base }));
    }
    is_kept(PlaneState::Stress);
    let references =
        References { x: 0.1, lower: Reference::Depth(3.0), upper: Reference::Disc(2.0) };
    is_kept(references);
    is_kept(Reference::Length(0.7));
    is_kept(Shear { friction: 0.3, force: -1.0, tension: 2.0 });
    is_kept(Convexity::Concave);
    is_kept(CurvePoint { x: 0.1, y: 0.2, dx: 0.3, dy: 0.4 });

    let read = |json: &str| serde_json::from_str::<Newton>(json).unwrap();
    assert_eq!(read("{}"), Newton::DEFAULT);
    let loose = r#"{"tolerance": {"relative": 1e-6}}"#;
    assert_eq!(read(loose), Newton { tolerance: StoppingCriteria::relative(1e-6) });
    assert_eq!(serde_json::from_str::<Secant>("{}").unwrap(), Secant::DEFAULT);
    assert_eq!(serde_json::from_str::<Brent>("{}").unwrap(), Brent::DEFAULT);
    assert_eq!(serde_json::from_str::<Panels>("{}").unwrap(), Panels::FULL);
    assert_eq!(serde_json::from_str::<Fit<f64>>("{}").unwrap(), Fit::default());
    let coarse = Midpoint { segments: 32, ..Midpoint::DEFAULT };
    assert_eq!(serde_json::from_str::<Midpoint>(r#"{"segments": 32}"#).unwrap(), coarse);
    assert!(refusal::<Panels>(r#"{"tolerence": 0.1}"#).contains("`tolerence`"));
    assert!(refusal::<Control<f64>>(r#"{"lode": 0.1}"#).contains("`lode`"));
    assert!(refusal::<Control<f64>>(r#"{"load": null}"#).contains("null"));
}

fn bumps() -> Solution<'static, f64> {
    on_flat(quartic(-2.0, 2.0)).solve(Control::Load(0.5)).unwrap()
}

#[test]
fn results_are_kept() {
    let solution = bumps();
    assert_eq!(solution.intervals().len(), 2);
    is_kept(solution.intervals().to_vec());
    is_kept(solution.hull());
    is_kept(solution.cost());
    is_kept(*solution.report());
    is_kept(solution.peak().unwrap());
    is_kept(solution.contacts().unwrap());
    is_kept(solution.certify().unwrap());
    is_kept(Estimate { value: 0.1, error: 1e-17 });
    let below = solution.subsurface().unwrap();
    is_kept(below.at(0.9, 0.1).unwrap());
    is_kept(below.max_shear().unwrap());
    is_kept(solution.summary().unwrap());

    let rates = solution.load_rates().unwrap();
    let written = serde_json::to_value(&rates).unwrap();
    assert_eq!(written["a"], rates.a);
    assert_eq!(written["limits"][1]["left"], rates.limits[1].left);
}

#[test]
fn results_with_materials_are_kept() {
    let steel = Material::elastic(210e3, 0.3);
    let roller = Parabola::new(10.0f64, [-1.0, 1.0]).unwrap();
    let contact = Contact::new(&Flat, &roller).unwrap().materials(steel, steel, PlaneState::Strain);
    let references =
        References { x: 0.0, lower: Reference::Depth(9.0), upper: Reference::Disc(10.0) };
    is_kept(contact.solve(Control::Load(500.0)).unwrap().approach(&references).unwrap());
    let shear = Shear { friction: 0.3, force: 50.0, tension: 0.0 };
    let slip = contact.partial_slip(Control::Load(500.0), shear).unwrap();
    is_kept(slip.traction().unwrap().at(0.1).unwrap());

    let table = SpringTable::new(&contact, &references, [1.0, 1000.0], 1e-6).unwrap();
    is_kept(table.clone());
    let middle = table.points().nth(1).unwrap();
    is_kept(middle);
    let between = 1.1 * middle.approach;
    assert_eq!(there_and_back(&table).at(between).unwrap(), table.at(between).unwrap());
    let written = serde_json::to_string(&table).unwrap();
    let bad = written.replacen("\"load\":1.0,", "\"load\":1e4,", 1);
    assert_ne!(bad, written);
    assert!(refusal::<SpringTable<f64>>(&bad).contains("rising approach and load"));
}

#[test]
fn a_report_reads_back_its_trials() {
    let report = bumps().report().attempts().to_vec();
    let many: Vec<_> = report.iter().copied().cycle().take(30).collect();
    let read: Report = serde_json::from_str(&serde_json::to_string(&many).unwrap()).unwrap();
    // The largest number of attempts that a report keeps, and the last attempt.
    assert_eq!(read.attempts().len(), 12);
    assert_eq!(read.attempts().last(), many.last());
    let none: Report = serde_json::from_str("[]").unwrap();
    assert!(none.attempts().is_empty() && !none.is_checked());
}

#[test]
fn a_summary_is_the_solution() {
    let solution = bumps();
    let row: Summary<f64> = there_and_back(&solution.summary().unwrap());
    assert_eq!(row.intervals, solution.intervals());
    assert_eq!(row.load, solution.load());
    assert!((row.loads[0] - 0.25).abs() < 1e-13 && (row.loads[1] - 0.25).abs() < 1e-13);
    assert_eq!(row.peak, solution.peak().ok());
    assert_eq!(row.centre_of_pressure, solution.centre_of_pressure().ok());
    assert_eq!(row.report, *solution.report());
    assert_eq!((row.kappa, row.tilt, row.checked), (1.0, 0.0, true));

    // A flat punch: both limits are given, and the pressure at them is infinite.
    let contact = Contact::new(&Flat, &Flat).unwrap().edges(Edge::Fixed(-1.0), Edge::Fixed(1.0));
    let solution = contact.solve(Control::Load(0.5)).unwrap();
    let row = solution.summary().unwrap();
    assert_eq!((row.peak, row.limits_error), (None, None));
    assert_eq!(row.intervals, [Interval { left: -1.0, right: 1.0 }]);
    // P = F/(π sqrt(1 - x²))
    let strength = 0.5 / std::f64::consts::PI;
    assert!(row.edge_singularities.into_iter().all(|k| (k / strength - 1.0).abs() < 1e-15));
    is_kept(row);
}
