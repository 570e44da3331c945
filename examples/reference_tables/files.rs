//! The files: one JSON file with everything, and two tables.

use super::case::{Case, Parameter, Row};
use serde_json::Value;

fn text(text: &str) -> String {
    Value::from(text).to_string()
}

/// Writes all cases, with one line per parameter and one per value.
pub fn json(cases: &[Case]) -> String {
    let case = |case: &Case| {
        let parameter = |p: &Parameter| {
            format!(
                "    {{\"symbol\": {}, \"value\": {}, \"unit\": {}, \"meaning\": {}}}",
                text(p.symbol),
                p.value,
                text(p.unit),
                text(p.meaning)
            )
        };
        let row = |row: &Row| {
            let [x, depth] = row.places();
            let place = |name: &str, at: Option<f64>| {
                at.map_or(String::new(), |at| format!("\"{name}\": {at}, "))
            };
            format!(
                "    {{\"quantity\": {}, {}{}\"value\": {}, \"unit\": {}, \"relative_error\": {:e}, \"kind\": {}, \
                 \"formula\": {}, \"source\": {}}}",
                text(row.quantity),
                place("x", x),
                place("depth", depth),
                row.value,
                text(row.unit),
                row.error,
                text(row.kind),
                text(&row.formula),
                text(&row.source)
            )
        };
        let list = |lines: Vec<String>| format!("[\n{}\n   ]", lines.join(",\n"));
        format!(
            "  {{\n   \"case\": {},\n   \"title\": {},\n   \"lower_body\": {},\n   \"upper_body\": {},\n   \
             \"parameters\": {},\n   \"values\": {}\n  }}",
            text(case.name),
            text(case.title),
            text(&case.lower),
            text(&case.upper),
            list(case.parameters.iter().map(parameter).collect()),
            list(case.rows.iter().map(row).collect())
        )
    };
    let cases: Vec<String> = cases.iter().map(case).collect();
    format!(
        "{{\n \"format\": \"linecontact-reference-values-1\",\n \"conventions\": {},\n \"cases\": [\n{}\n ]\n}}\n",
        text(CONVENTIONS),
        cases.join(",\n")
    )
}

const CONVENTIONS: &str = "Plane strain, elastic half-planes, no friction unless said. x along the contact, \
    bodies by Y upwards; stresses, the same in both bodies, with y and the depth into the body. \
    Pressure positive in compression, stresses positive in tension. Loads per unit length. \
    E* = 1/((1 - nu1^2)/E1 + (1 - nu2^2)/E2). relative_error: half a unit of the last digit, or the estimate.";

/// Formats a field of a table, in quotes if necessary.
fn field(text: &str) -> String {
    if text.contains([',', '"']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.into()
    }
}

fn line(fields: &[String]) -> String {
    fields.iter().map(|text| field(text)).collect::<Vec<_>>().join(",") + "\n"
}

/// Writes one line per value.
pub fn values_csv(cases: &[Case]) -> String {
    let mut text =
        "case,quantity,x,depth,value,unit,relative_error,kind,formula,source\n".to_owned();
    for case in cases {
        for row in &case.rows {
            let [x, depth] = row.places().map(|at| at.map_or(String::new(), |at| at.to_string()));
            text += &line(&[
                case.name.into(),
                row.quantity.into(),
                x,
                depth,
                row.value.to_string(),
                row.unit.into(),
                format!("{:e}", row.error),
                row.kind.into(),
                row.formula.clone(),
                row.source.clone(),
            ]);
        }
    }
    text
}

/// Writes one line per body or parameter.
pub fn cases_csv(cases: &[Case]) -> String {
    let mut text = "case,symbol,value,unit,meaning\n".to_owned();
    for case in cases {
        for (name, body) in [("lower body", &case.lower), ("upper body", &case.upper)] {
            text +=
                &line(&[case.name.into(), name.into(), String::new(), String::new(), body.into()]);
        }
        for p in &case.parameters {
            text += &line(&[
                case.name.into(),
                p.symbol.into(),
                p.value.to_string(),
                p.unit.into(),
                p.meaning.into(),
            ]);
        }
    }
    text
}
