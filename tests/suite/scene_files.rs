//! Scenes in files: every body through TOML and JSON and back, bit for bit, and what is refused.

use linecontact::profile::{Crowning, Ellipse, Fit, Involute, Line, Parabola};
use linecontact::scene::{PlacedShape, Scene, SceneError, Shape, Step, Stiffness};
use linecontact::{
    Base, Contact, Control, Edge, Ends, Flat, InputError, Layer, Material, PlaneState, Reference,
    References,
};
use serde_json::{Value, json};
use std::collections::BTreeSet;

/// Bodies of every shape, with numbers whose last digit matters.
fn shapes() -> Vec<Shape<f64>> {
    let points: Vec<_> = (-9..=9).map(|i| 0.13 * f64::from(i)).map(|x| [x, x.cosh()]).collect();
    let line = Line::new(-0.1, [-0.7, 0.0]).unwrap();
    let rise = PlacedShape {
        shape: Shape::Line(Line::new(0.1, [0.0, 1.0]).unwrap()),
        steps: vec![Step::Scaled(0.7)],
    };
    vec![
        Shape::Flat,
        Shape::Line(Line::new(0.1, [-1.0 / 3.0, 0.7]).unwrap()),
        Shape::Parabola(Parabola::new(0.1 + 0.2, [-1.0, 2.0 / 3.0]).unwrap()),
        Shape::Ellipse(Ellipse::new(3.0, -0.7, [-1.1, 1.2]).unwrap()),
        Shape::Involute(Involute::new(50.0, 0.4, [0.1, 0.7]).unwrap()),
        Shape::Crowning(Crowning::new(1e-300, 5.0, [-5.0, 4.9]).unwrap()),
        Shape::Wedge { slopes: [-0.1, 0.3], reach: 0.7 },
        Shape::RoundedPunch { flat: 0.3, radius: 0.7, reach: 1.1 },
        Shape::Spline { points: points.clone(), fit: Fit::default() },
        Shape::Spline { points, fit: Fit { smooth: true, outliers: None, period: Some(2.5) } },
        Shape::Piecewise { parts: vec![Shape::Line(line).into(), rise], tolerance: Some(1e-9) },
    ]
}

/// Layers on both bodies.
fn layers(base: Material<f64>) -> Stiffness<f64> {
    let rubber = Material::elastic(5.1, 0.48);
    let [lower, upper] = [(0.7, Base::HalfPlane(base)), (1.0 / 3.0, Base::Frictionless)]
        .map(|(thickness, base)| Layer { material: rubber, thickness, base }.into());
    Stiffness::Materials { lower, upper, plane: PlaneState::Strain }
}

#[test]
fn every_scene_is_kept_bit_for_bit() {
    let to = References { x: 0.1, lower: Reference::Depth(3.0), upper: Reference::Disc(2.0) };
    let steel = Material::elastic(210e3, 0.3);
    for (i, shape) in shapes().into_iter().enumerate() {
        let steps = vec![
            Step::Mirrored,
            Step::Shifted(1e-3 / 7.0, 2e22),
            Step::Scaled(1.1),
            Step::Flipped,
            Step::Rotated(1e-3),
        ];
        let mut scene = Scene::new(shape, PlacedShape { shape: Shape::Flat, steps });
        scene.title = "\"three\"\nlines\\ äöü".to_owned();
        scene.units.load = "N/mm".to_owned();
        scene.stiffness = [
            None,
            Some(Stiffness::Kappa(0.1)),
            Some(Stiffness::ContactModulus(115e3)),
            Some(Stiffness::Materials {
                lower: Material::Rigid.into(),
                upper: steel.into(),
                plane: PlaneState::Stress,
            }),
            Some(layers(steel)),
        ][i % 5]
            .clone();
        scene.edges = [None, Some(Ends { left: Edge::Free, right: Edge::FreeUntil(0.1) })][i % 2];
        scene.certified = i % 3 == 0;
        scene.resolution = [None, Some(1e-5)][i % 2];
        scene.period = [None, None, Some(2.5)][i % 3];
        scene.references = [None, Some(to)][i % 2];
        scene.controls = vec![
            Control::Load(1.0 / 3.0),
            Control::Approach { approach: 0.01, references: to },
            Control::Moment { load: 1.0, moment: -0.1, about: 0.3 },
        ];
        let toml = scene.to_toml().unwrap();
        assert_eq!(Scene::from_toml(&toml).as_ref(), Ok(&scene), "{toml}");
        let json = scene.to_json().unwrap();
        assert_eq!(Scene::from_json(&json).as_ref(), Ok(&scene), "{json}");
        assert_eq!(Scene::<f64>::from_json(&json).unwrap().to_toml().unwrap(), toml);
    }
}

/// Returns the names that a file may have in a place, from what is said of another: in backquotes,
/// after the wrong one.
fn allowed_in_place_of(shape: &Value) -> BTreeSet<String> {
    let file = json!({ "lower": { "shape": shape }, "upper": { "shape": "flat" } });
    let refused = Scene::<f64>::from_json(&file.to_string()).unwrap_err();
    refused.reason.split('`').skip(3).step_by(2).map(str::to_owned).collect()
}

#[test]
fn the_schema_has_every_shape_and_its_parameters() {
    let schema: Value = serde_json::from_str(include_str!("../../docs/scene.schema.json")).unwrap();
    let names = |of: &Value| of.as_object().unwrap().keys().cloned().collect::<BTreeSet<_>>();
    let mut described = BTreeSet::from(["flat".to_owned()]);
    for one in schema["$defs"]["shape"]["oneOf"].as_array().unwrap() {
        for (name, shape) in one["properties"].as_object().into_iter().flatten() {
            let known = allowed_in_place_of(&json!({ name: { "unknown": 0 } }));
            assert_eq!(names(&shape["properties"]), known, "{name}");
            described.insert(name.clone());
        }
    }
    let known = allowed_in_place_of(&json!("unknown"));
    assert_eq!(described, known);
    let name = |shape| match serde_json::to_value(shape).unwrap() {
        Value::String(flat) => flat,
        others => names(&others).pop_first().unwrap(),
    };
    assert_eq!(shapes().into_iter().map(name).collect::<BTreeSet<_>>(), known);
}

#[test]
fn a_shape_is_made_from_its_numbers() {
    let numbers = [("slopes.0", -0.1), ("slopes.1", 0.3), ("reach", 0.7), ("radius", 0.0)];
    let number = |name: &str| Some(numbers.iter().find(|(known, _)| *known == name)?.1);
    let wedge = Shape::Wedge { slopes: [-0.1, 0.3], reach: 0.7 };
    assert_eq!(Shape::from_numbers("wedge", number), Some(Ok(wedge)));
    assert_eq!(Shape::from_numbers("flat", number), Some(Ok(Shape::Flat)));
    for name in ["parabola", "rounded_punch", "spline", "Wedge", ""] {
        assert_eq!(Shape::from_numbers(name, number), None, "{name}");
    }
    let parabola = |name: &str| Some(if name == "domain.1" { 1.0 } else { 0.0 });
    let refused = Parabola::new(0.0, [0.0, 1.0]).unwrap_err();
    let found = Shape::from_numbers("parabola", parabola);
    assert_eq!(found, Some(Err(InputError::Shape(refused).into())));
}

/// The package for Python reads and writes the same files.
#[test]
fn a_file_is_written_again_byte_by_byte() {
    for text in [include_str!("../data/scene.toml"), include_str!("../data/layers.toml")] {
        let scene = Scene::<f64>::from_toml(text).unwrap();
        assert_eq!(scene.to_toml().unwrap(), text);
        let contact = scene.contact().unwrap();
        for &control in &scene.controls {
            contact.solve(control).unwrap();
        }
    }
}

#[test]
fn a_scene_solves_to_the_same_bits() {
    let text = r#"
        stiffness = { materials = { lower = "rigid", upper = { elastic = { youngs_modulus = 210e3, poisson_ratio = 0.3 } } } }
        [lower]
        shape = "flat"
        [upper]
        shape = { ellipse = { along = 10, across = 10, angles = [-1.5, 1.5] } }
    "#;
    let scene = Scene::from_toml(text).unwrap();
    let roller = Ellipse::circle(10.0, [-1.5, 1.5]).unwrap();
    let by_hand = Contact::new(&Flat, &roller).unwrap().materials(
        Material::Rigid,
        Material::elastic(210e3, 0.3),
        PlaneState::Strain,
    );
    let load = Control::Load(500.0);
    let (read, made) =
        (scene.contact().unwrap().solve(load).unwrap(), by_hand.solve(load).unwrap());
    assert_eq!(read.hull(), made.hull());
    assert_eq!(read.peak().unwrap(), made.peak().unwrap());
}

#[test]
fn a_layer_solves_to_the_same_bits() {
    let text = include_str!("../data/layers.toml");
    let scene = Scene::from_toml(text).unwrap();
    let [rubber, steel] = [Material::elastic(5.0, 0.48), Material::elastic(210e3, 0.3)];
    let cover = Layer { material: rubber, thickness: 10.0, base: Base::HalfPlane(steel) };
    let blanket = Layer { material: rubber, thickness: 2.0, base: Base::Bonded };
    let roller = Parabola::new(100.0, [-30.0, 30.0]).unwrap();
    let by_hand =
        Contact::new(&Flat, &roller).unwrap().materials(blanket, cover, PlaneState::Strain);
    let read = scene.contact().unwrap().solve(scene.controls[0]).unwrap();
    let made = by_hand.solve(scene.controls[0]).unwrap();
    assert_eq!(read.hull(), made.hull());
    assert_eq!(read.peak().unwrap(), made.peak().unwrap());
}

#[test]
fn a_smoothed_spline_is_not_put_where_nothing_can_be() {
    let points = (-9..=9).map(|i| 0.1 * f64::from(i)).map(|x| [x, x * x]).collect();
    let shape = Shape::Spline { points, fit: Fit { smooth: true, ..Fit::default() } };
    let error = PlacedShape { shape, steps: vec![Step::Scaled(0.0)] }.build().err().unwrap();
    assert_eq!(error.to_string(), "a factor of a placement is 0: it must be not zero");
}

#[test]
fn a_smoothed_spline_keeps_its_uncertainty_where_it_is_placed() {
    let height = |i: i32| 5e-5 * f64::from(i * i) + 1e-6 * f64::from(i * 7 % 5 - 2);
    let points: Vec<_> = (-100..=100).map(|i| [0.01 * f64::from(i), height(i)]).collect();
    let shape = Shape::Spline { points, fit: Fit { smooth: true, ..Fit::default() } };
    let measured = |steps| {
        let scene = Scene::new(Shape::Flat, PlacedShape { shape: shape.clone(), steps });
        let solution = scene.contact().unwrap().solve(Control::Load(0.02)).unwrap();
        (solution.a(), solution.b(), solution.uncertainty().unwrap().a)
    };
    let (here, there) = (measured(vec![]), measured(vec![Step::Mirrored]));
    assert!((there.0 / here.1 - 1.0).abs() < 1e-12 && (there.1 / here.0 - 1.0).abs() < 1e-12);
    assert!(here.2 > 0.0 && there.2 > 0.0);
}

type Read = fn(&str) -> Result<Scene<f64>, SceneError>;

/// Asserts that the file is refused at a line and a field, for a reason, once a text in it is
/// replaced.
fn assert_refused(read: Read, good: &str, rows: &[(&str, &str, usize, &str, &str)]) {
    assert!(read(good).is_ok());
    for &(from, to, line, field, reason) in rows {
        let text = good.replacen(from, to, 1);
        let error = read(&text).expect_err(&text);
        let place = (error.line, error.field.as_str());
        assert!(place == (Some(line), field) && error.reason.contains(reason), "{text}{error:#?}");
        let said = error.to_string();
        assert!(said.starts_with(&format!("line {line}: {field}")), "{said}");
    }
}

#[test]
fn a_bad_file_is_refused_with_line_and_field() {
    let good = "title = \"x\"\n\n[lower]\nshape = \"flat\"\n\n[upper]\nshape = { parabola = { radius = 1.0, domain = [-1.0, 1.0] } }\n";
    let refused = [
        ("\"x\"", "x", 1, "", "quote"),
        ("title", "titel", 1, "titel", "unknown field `titel`"),
        ("flat", "flit", 4, "lower.shape", "unknown name `flit`"),
        ("shape = \"flat\"", "", 3, "lower", "missing field `shape`"),
        ("radius = 1.0, ", "", 7, "upper.shape.parabola", "missing field `radius`"),
        (
            "radius = 1.0",
            "radius = \"1\"",
            7,
            "upper.shape.parabola.radius",
            "invalid type: string",
        ),
        ("radius = 1.0", "radius = 0.0", 7, "upper.shape.parabola", "the radius is 0:"),
        ("radius = 1.0", "radius = nan", 7, "upper.shape.parabola", "the radius is NaN:"),
        ("-1.0, 1.0]", "-1.0]", 7, "upper.shape.parabola.domain", "1 numbers: there must be two"),
        ("-1.0, 1.0]", "-1.0, 1.0, 2.0]", 7, "upper.shape.parabola.domain", "3 numbers"),
        (
            "flat\"\n",
            "flat\"\nsteps = [{ scaled = 0.0 }]\n",
            3,
            "lower",
            "factor of a placement is 0",
        ),
        (
            "flat\"\n",
            "flat\"\nsteps = [\"turned\"]\n",
            5,
            "lower.steps[0]",
            "unknown name `turned`",
        ),
        ("\n\n", "\ncontrols = [{ lode = 1 }]\n", 2, "controls[0]", "unknown name `lode`"),
        ("\n\n", "\ncontrols = [{ load = \"1\" }]\n", 2, "controls[0].load", "expected a number"),
        (
            "\n\n",
            "\ncontrols = [\"load\"]\n",
            2,
            "controls[0].load",
            "expected a name with a value",
        ),
        ("\n\n", "\ncontrols = [{}]\n", 2, "controls[0]", "one name with a value is wanted"),
        (
            "\n\n",
            "\ncontrols = [{ moment = 5.0 }]\n",
            2,
            "controls[0].moment",
            "moment = { load = F",
        ),
        (
            "\n\n",
            "\ncontrols = [{ approach = 0.1 }]\n",
            2,
            "controls[0].approach",
            "references = {",
        ),
        (
            "\n\n",
            "\ncontrols = [{ approach = { approach = 0.1 } }]\n",
            2,
            "controls[0].approach",
            "missing field `references`; a control is",
        ),
        ("\n\n", "\ncontrols = [{ load = 1, moment = 5 }]\n", 2, "controls[0]", "moment = { load"),
        ("\n\n", "\ncontrols = { load = 1.0 }\n", 2, "controls", "a control is { load = F }"),
        ("\n\n", "\ncontrols = [\n{ load = nan }]\n", 3, "load", "the number is not finite"),
        ("\n\n", "\nresolution = -inf\n", 2, "resolution", "the number is not finite"),
        ("\n\n", "\nstiffness = { kappa = 1, contact_modulus = 1 }\n", 2, "stiffness", "1 element"),
        (
            "\n\n",
            "\nstiffness = { kappa = 0.0 }\n",
            2,
            "stiffness",
            "κ = 0: the scale must be positive",
        ),
        ("\n\n", "\nedges = { left = \"free\" }\n", 2, "edges", "missing field `right`"),
        (
            "\n\n",
            "\nedges = { left = \"free\", right = \"free\", up = 1 }\n",
            2,
            "edges.up",
            "`up`",
        ),
        ("\n\n", "\nunits = { width = \"mm\" }\n", 2, "units.width", "unknown field `width`"),
        (
            "\n\n",
            "\nunits = { length = \"mm\", pressure = \"GPa\", load = \"N/mm\" }\n",
            2,
            "units",
            "GPa times mm is no load per length in N/mm: give pressures in MPa",
        ),
    ];
    assert_refused(Scene::from_toml, good, &refused);
}

#[test]
fn units_that_do_not_go_together_are_refused() {
    let read = |[length, pressure, load]: [&str; 3]| {
        let units =
            format!(r#"{{ "length": "{length}", "pressure": "{pressure}", "load": "{load}" }}"#);
        let body = r#"{ "shape": "flat" }"#;
        Scene::<f64>::from_json(&format!(
            r#"{{ "units": {units}, "lower": {body}, "upper": {body} }}"#
        ))
    };
    for units in [
        ["mm", "MPa", "N/mm"],
        ["mm", "N/mm²", "N/mm"],
        ["mm", "N/mm^2", "kN/m"],
        ["mm", "GPa", "kN/mm"],
        ["m", "Pa", "N/m"],
        ["µm", "MPa", "N / m"],
        ["in", "psi", "lbf/in"],
        ["mm", "MPa", ""],
        ["cm", "bar", "daN/cm"],
        ["mm", "kgf/mm²", "kgf/mm"],
        ["mil", "ksi", "lbf/in"],
        ["", "GPa", "N/mm"],
    ] {
        assert!(read(units).is_ok(), "{units:?}");
    }
    for (units, remedy) in [
        (["mm", "GPa", "N/mm"], ": give pressures in MPa"),
        (["mm", "Pa", "N/m"], ": give pressures in kPa"),
        (["m", "MPa", "N/m"], ": give pressures in Pa"),
        (["in", "ksi", "lbf/in"], ": give pressures in psi"),
        (["in", "MPa", "lbf/in"], ": give pressures in psi"),
        (["cm", "MPa", "N/mm"], ""),
        (["mm", "bar", "N/mm"], ": give pressures in MPa"),
    ] {
        let [length, pressure, load] = units;
        let says = format!("{pressure} times {length} is no load per length in {load}{remedy}");
        let error = read(units).expect_err(&says);
        assert_eq!((error.field.as_str(), error.reason.as_str()), ("units", &*says));
    }
    for (at, quantity, label) in [
        (0, "lengths", "furlong"),
        (0, "lengths", "mm²"),
        (1, "pressures", "N"),
        (1, "pressures", "N/m/m"),
        (2, "loads per length", "kN"),
        (2, "loads per length", "kgf"),
        (2, "loads per length", "kg/mm"),
        (2, "loads per length", "Pa"),
    ] {
        let mut units = ["mm", "MPa", "N/mm"];
        units[at] = label;
        let error = read(units).expect_err(label);
        assert_eq!(error.field, "units");
        let says = format!("{label} is no unit of {quantity}");
        // Only those of this quantity.
        let known = match at {
            0 => "known are m, in, ft, mil, å",
            1 => "known are Pa, bar, psi, ksi",
            _ => "known are m, in, ft, mil, å, N, lbf, kgf",
        };
        assert!(
            error.reason.starts_with(&says) && error.reason.contains(&format!("{known} (")),
            "{error}"
        );
        // Whatever others there are.
        let mut units = [""; 3];
        units[at] = label;
        assert!(read(units).is_err(), "{label}");
    }
}

#[test]
fn a_bad_layer_is_refused_with_line_and_field() {
    let good = "[lower]\nshape = \"flat\"\n[upper]\nshape = \"flat\"\n\
                [stiffness.materials]\nlower = \"rigid\"\n\
                [stiffness.materials.upper.layer]\n\
                material = { elastic = { youngs_modulus = 1.0, poisson_ratio = 0.3 } }\nthickness = 1.0\n\
                base = { half_plane = { elastic = { youngs_modulus = 1.0, poisson_ratio = 0.3 } } }\n";
    let layer = "stiffness.materials.upper.layer";
    let rows = [
        (
            "\"rigid\"",
            "\"rigit\"",
            6,
            "stiffness.materials.lower",
            "`rigit`, expected one of `elastic`, `rigid`, `layer`",
        ),
        (
            "lower = \"rigid\"",
            "lower = { layer = { thickness = 1 } }",
            6,
            "stiffness.materials.lower.layer",
            "missing field `material`",
        ),
        (
            "poisson_ratio = 0.3",
            "poisson_ratio = 0.6",
            5,
            "stiffness",
            "upper body: Poisson's ratio is 0.6",
        ),
        ("upper.layer", "upper.lair", 7, "stiffness.materials.upper", "unknown name `lair`"),
        (
            "\nthickness",
            "\nthickness = 1\ndepth",
            10,
            &format!("{layer}.depth"),
            "unknown field `depth`",
        ),
        (
            "thickness = 1.0",
            "thickness = \"1\"",
            9,
            &format!("{layer}.thickness"),
            "invalid type: string",
        ),
        ("thickness = 1.0\n", "", 7, layer, "missing field `thickness`"),
        ("half_plane", "half", 10, &format!("{layer}.base"), "unknown name `half`"),
        (
            "{ half_plane = { elastic = { youngs_modulus",
            "{ half_plane = { elastic = { modulus",
            10,
            &format!("{layer}.base.half_plane.elastic"),
            "unexpected keys in table: modulus",
        ),
    ];
    assert_refused(Scene::from_toml, good, &rows);
    let json = "{\"lower\": {\"shape\": \"flat\"},\n\"upper\": {\"shape\": \"flat\"},\n\
                \"stiffness\": {\"materials\": {\"lower\": {\"elastic\":\
                {\"youngs_modulus\": 1, \"poisson_ratio\": 0}}, \"upper\": {\"layer\":\n\
                {\"material\": \"rigid\", \"thickness\": 1, \"base\": \"bonded\"}}}}}";
    let rows = [
        ("bonded", "glued", 4, &*format!("{layer}.base"), "unknown name `glued`"),
        ("\"thickness\"", "\"thick\"", 4, &format!("{layer}.thick"), "unknown field `thick`"),
        ("\"layer\"", "\"lair\"", 3, "stiffness.materials.upper", "unknown name `lair`"),
    ];
    assert_refused(Scene::from_json, json, &rows);
}

#[test]
fn a_bad_json_file_is_refused_with_line_and_field() {
    let good = "{\n\"lower\": {\"shape\": \"flat\"},\n\"upper\": {\"shape\": {\n\"wedge\": {\"slopes\": [-0.1, 0.1], \"reach\": 1}}}\n}";
    let wedge = "\"wedge\": {\"slopes\": [-0.1, 0.1], \"reach\": 1}";
    let part = |from: f64, to: f64| {
        format!(r#"{{"shape": {{"line": {{"slope": 0.1, "domain": [{from}, {to}]}}}}}}"#)
    };
    let parts = |gap: f64, tolerance: &str| {
        let both = [part(-1.0, 0.0), part(gap, 1.0)].join(", ");
        format!(r#""piecewise": {{"parts": [{both}], "tolerance": {tolerance}}}"#)
    };
    assert!(Scene::<f64>::from_json(&good.replace(wedge, &parts(0.0, "1e-12"))).is_ok());
    let refused = [
        ("\"flat\"", "flat", 2, "lower.shape", "expected"),
        ("0.1]", "null]", 4, "upper.shape.wedge.slopes[1]", "invalid type: null"),
        (
            "\"reach\": 1",
            "\"reach\": -1",
            5,
            "upper",
            "piece 1 from the left: the reach is -1: it must be positive",
        ),
        (wedge, r#""piecewise": {"parts": []}"#, 5, "upper", "at least one piece"),
        (
            wedge,
            &parts(0.5, "1e-12"),
            5,
            "upper",
            "gap of 0.5 between pieces 1 and 2 from the left",
        ),
        (wedge, &parts(0.0, "-1"), 5, "upper", "tolerance -1 is out of range"),
        (wedge, r#""spline": {"points": [[0, 0], [1, 1], [0.5, 2], [2, 3]]}"#, 5, "upper", "row 3"),
        (": 1}}}\n}", ": 1}}}\n}\n]", 6, "", "trailing characters"),
        ("\n}", "", 4, "", "EOF"),
    ];
    assert_refused(Scene::from_json, good, &refused);
}
