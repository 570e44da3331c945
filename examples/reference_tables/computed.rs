//! Contacts without a closed form, from the files in `tests/data`.

use super::case::{AT, Case, FIFTEEN_DIGITS, LEFT, Made, PEAK, Place, RIGHT};
use super::paper::{Example, five, four, three};
use linecontact::profile::{Involute, Placed, Placement};
use linecontact::{Contact, Control, Curve, CurvePoint, Flat, ParametricProfile};
use serde_json::Value;
use std::error::Error;
use std::f64::consts::PI;
use std::fs::read_to_string;
use std::path::Path;

const SOURCE: &str =
    "tests/data of linecontact: 66 digits or more, by two quadratures; the solver agrees";

fn file(name: &str) -> Result<Value, Box<dyn Error>> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("tests/data/{name}.json"));
    Ok(serde_json::from_str(&read_to_string(path)?)?)
}

/// Reads a decimal with more digits than a number has, rounded to `digits` of them.
fn decimal(value: &Value, digits: usize) -> Result<f64, Box<dyn Error>> {
    let number: f64 = value.as_str().ok_or("a decimal in a string")?.parse()?;
    Ok(format!("{number:.*e}", digits - 1).parse()?)
}

fn exact(value: &Value) -> Result<f64, Box<dyn Error>> {
    Ok(value.as_str().ok_or("a decimal in a string")?.parse()?)
}

/// Adds limits, peak and three pressures of one contact; the solver may be off by the noise of the
/// formulas.
fn one_contact(
    case: &mut Case,
    name: &str,
    [lower, upper]: [&dyn ParametricProfile<f64>; 2],
    noise: f64,
) -> Result<(), Box<dyn Error>> {
    let known = file(name)?;
    let contact = Contact::new(lower, upper)?.kappa(exact(&known["scale_value"])?);
    let solution = contact.solve(Control::Load(exact(&known["C"])? / PI))?;
    let (a, b) = (decimal(&known["a"], 15)?, decimal(&known["b"], 15)?);
    case.source(SOURCE);
    case.computed(LEFT, Place::Whole, -b, FIFTEEN_DIGITS, -solution.b()).within(noise);
    case.computed(RIGHT, Place::Whole, a, FIFTEEN_DIGITS, solution.a()).within(noise);
    let peak = decimal(&known["P_max"], 15)?;
    case.computed(PEAK, Place::Whole, peak, FIFTEEN_DIGITS, solution.peak()?.pressure)
        .within(noise);
    let pressure = solution.pressure()?;
    let points = known["points"].as_array().ok_or("no points")?;
    let middle = points.len() / 2;
    let zero = points.iter().position(|point| exact(&point[0]).is_ok_and(|x| x == 0.0));
    for i in [middle - 6, zero.unwrap_or(middle), middle + 6] {
        let x = exact(&points[i][0])?;
        let value = decimal(&points[i][1], 15)?;
        case.computed(AT, Place::At(x), value, FIFTEEN_DIGITS, pressure.at(x)?).within(noise);
    }
    Ok(())
}

/// Largest relative difference from the solver where the formulas lose no digits, for unsymmetric
/// limits.
const SMOOTH: f64 = 1e-12;

pub fn gear() -> Made {
    let (base, rolled, modulus) = ([37.5, 112.5], 93.0 / 256.0, 113_187.0);
    let mut case = Case::new(
        "involute_gear",
        "Two involute gear teeth at the pitch point",
        [
            "involute of a circle of radius r1: x = -r1 (cos k + (t+k) sin k - 1), y = -r1 (sin k - (t+k) cos k + t)",
            "involute of a circle of radius r2: x = r2 (cos k + (t+k) sin k - 1), y = r2 (sin k - (t+k) cos k + t)",
        ],
        &[
            ("r1", base[0], "mm", "base radius of the pinion"),
            ("r2", base[1], "mm", "base radius of the wheel"),
            (
                "t",
                rolled,
                "1",
                "roll angle of both at the pitch point: the tangent of the pressure angle",
            ),
            ("E*", modulus, "MPa", "contact modulus"),
            ("pi F", 1571.0, "N/mm", "pi times the load"),
        ],
    );
    let flank =
        |i: usize, placement| Placed::new(Involute::new(base[i], rolled, [0.01, 1.0])?, placement);
    let pinion = flank(0, Placement::default().mirrored().flipped())?;
    let wheel = flank(1, Placement::default())?;
    one_contact(&mut case, "gear_involute_pitch_point", [&pinion, &wheel], SMOOTH)?;
    Ok(case)
}

/// Writes a parametric curve in words, with all its pieces.
fn curve(pieces: &Value) -> Result<String, Box<dyn Error>> {
    let piece = |piece: &Value| {
        let of = |key: &str| piece[key].as_str().ok_or("not a curve");
        let ends = [exact(&piece["k_from"])?, exact(&piece["k_to"])?];
        let range = format!("k from {} to {}", ends[0], ends[1]);
        Ok(format!("x = {}, y = {}, {range}", of("X")?, of("Y")?))
    };
    let pieces = pieces.as_array().ok_or("no pieces")?.iter().map(piece);
    Ok(pieces.collect::<Result<Vec<_>, Box<dyn Error>>>()?.join("; and "))
}

/// Makes the case of an example of the paper, with E* = 1.
fn example(name: &'static str, title: &'static str, file: &str, example: &Example) -> Made {
    let known = self::file(file)?;
    let [lower, upper] = ["body1", "body2"].map(|body| curve(&known[body]["pieces"]));
    let mut case = Case::new(
        name,
        title,
        [&lower?, &upper?],
        &[("E*", 1.0, "1", "contact modulus: kappa = pi/2"), ("C", example.c, "1", "pi F")],
    );
    one_contact(&mut case, file, [&*example.lower, &*example.upper], 1e-11)?;
    for row in &mut case.rows {
        row.unit = "1";
    }
    Ok(case)
}

pub fn example_3() -> Made {
    let title = "Example 3 of the paper, Eqs. 33 and 34";
    example("paper_example_3", title, "paper_example_3_scale_half_pi", &three())
}

pub fn example_4() -> Made {
    let title = "Example 4 of the paper, Eqs. 35 and 36: a corner in the slope";
    example("paper_example_4", title, "paper_example_4_scale_half_pi", &four())
}

pub fn example_5() -> Made {
    let title = "Example 5 of the paper, Eqs. 37 and 38: corners in both";
    example("paper_example_5", title, "paper_example_5_scale_half_pi", &five())
}

/// Makes the case of a parabola with waves.
pub fn wavy_parabola() -> Made {
    let (waves, number, phase, load) = (0.012, 20.0, 0.3, 0.03);
    let mut case = Case::new(
        "wavy_parabola",
        "Parabola with waves on a half-plane: two contacts that are not alike",
        ["half-plane, y = 0", "y = x^2/2 + A cos(q x + s)"],
        &[
            ("A", waves, "1", "amplitude of the waves"),
            ("q", number, "1", "wave number"),
            ("s", phase, "1", "phase"),
            ("E*", 1.0, "1", "contact modulus"),
            ("F", load, "1", "load on both contacts"),
        ],
    );
    let known = file("several/wavy_parabola_5")?;
    let shape = Curve::new([-2.0, 2.0], move |k: f64| {
        let (sin, cos) = (number * k + phase).sin_cos();
        let (y, dy) = (0.5 * k * k + waves * cos, k - number * waves * sin);
        CurvePoint { x: k, y, dx: 1.0, dy }
    });
    let contact = Contact::new(&Flat, &shape)?.contact_modulus(1.0);
    let solution = contact.solve(Control::Load(load))?;
    let contacts = solution.contacts()?;
    // The limits are known to 3e-12 of the width.
    let (error, digits) = (1e-11, 12);
    case.source(
        "tests/data/several of linecontact: Newton's method on all limits, at two node counts; the \
         solver agrees",
    );
    let names = [
        [("left_limit_1", "1"), ("right_limit_1", "1"), ("load_1", "1")],
        [("left_limit_2", "1"), ("right_limit_2", "1"), ("load_2", "1")],
    ];
    for (i, [left, right, borne]) in names.into_iter().enumerate() {
        let (limits, on) = (&known["limits"][i], solution.intervals()[i]);
        let value = |value: &Value| decimal(value, digits);
        case.computed(left, Place::Whole, value(&limits[0])?, error, on.left).within(error);
        case.computed(right, Place::Whole, value(&limits[1])?, error, on.right).within(error);
        let load = value(&known["loads"][i])?;
        case.computed(borne, Place::Whole, load, error, contacts[i].load).within(error);
    }
    let pressure = solution.pressure()?;
    for i in [2, 3, 10, 11] {
        let point = &known["points"][i];
        let (x, value) = (exact(&point[0])?, decimal(&point[1], digits)?);
        case.computed((AT.0, "1"), Place::At(x), value, error, pressure.at(x)?).within(error);
    }
    Ok(case)
}
