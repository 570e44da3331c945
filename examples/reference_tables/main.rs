//! Writes reference values for other codes: contacts with geometry, load, units, formulas and
//! sources, as JSON and CSV.
//!
//! ```sh
//! cargo run --release --example reference_tables              # writes docs/reference
//! cargo run --release --example reference_tables -- --check   # compares it with what is there
//! ```
//!
//! Closed forms are evaluated with twice the digits of a number, and written with fifteen; the
//! other values come from `tests/data`. The solver computes each value, too, and must agree. The
//! page `docs/check_your_code.md` says how to use them; the errors of boundary elements in its
//! table are measured here.

mod case;
mod computed;
mod elements;
mod files;
mod hertz;
mod mesh;
#[path = "../paper/curves.rs"]
#[allow(dead_code)]
mod paper;
mod precise;
mod punches;
mod slip;
mod waves;

use case::{Case, Row};
use std::error::Error;
use std::fs;
use std::path::Path;

fn cases() -> Result<Vec<Case>, Box<dyn Error>> {
    [
        hertz::hertz_cylinder,
        hertz::unlike_cylinders,
        hertz::verification_case_191,
        hertz::cylinder_in_groove,
        punches::wedge,
        punches::unequal_wedge,
        punches::quartic_punch,
        punches::flat_punch,
        punches::tilted_punch,
        punches::lifted_punch,
        punches::rounded_flat_punch,
        waves::wave,
        waves::two_contacts,
        waves::three_contacts,
        slip::partial_slip,
        slip::bulk_tension,
        computed::gear,
        computed::wavy_parabola,
        computed::example_3,
        computed::example_4,
        computed::example_5,
    ]
    .into_iter()
    .map(|case| case())
    .collect()
}

pub(crate) fn main() -> Result<(), Box<dyn Error>> {
    let check = match std::env::args().nth(1).as_deref() {
        Some("--check") => true,
        Some(other) => return Err(format!("{other}: give --check or nothing").into()),
        None => false,
    };
    let cases = cases()?;
    println!("{:<20} {:>6}  largest difference of the solver", "case", "values");
    for case in &cases {
        let worst = case
            .rows
            .iter()
            .max_by(|a, b| (a.difference() / a.allowed).total_cmp(&(b.difference() / b.allowed)));
        let Some(worst) = worst else { return Err(format!("{}: no values", case.name).into()) };
        let Row { quantity, allowed, .. } = worst;
        let difference = worst.difference();
        println!(
            "{:<20} {:>6}  {difference:.1e} of {quantity}, allowed {allowed:.0e}",
            case.name,
            case.rows.len()
        );
        if difference.is_nan() || difference > *allowed {
            let Row { value, solved, .. } = worst;
            return Err(format!("{}: {quantity} {value}, solved {solved}", case.name).into());
        }
    }
    let mesh = mesh::table()?;
    print!("{mesh}");

    let docs = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs");
    let page = fs::read_to_string(docs.join("check_your_code.md"))?;
    if !page.contains(&mesh) {
        return Err("docs/check_your_code.md has another table of meshes".into());
    }
    let folder = docs.join("reference");
    fs::create_dir_all(&folder)?;
    for (name, text) in [
        ("cases.json", files::json(&cases)),
        ("cases.csv", files::cases_csv(&cases)),
        ("values.csv", files::values_csv(&cases)),
    ] {
        let path = folder.join(name);
        if !check {
            fs::write(path, text)?;
        } else if fs::read_to_string(path)? != text {
            return Err(format!("docs/reference/{name} is not what is written now").into());
        }
    }
    let values: usize = cases.iter().map(|case| case.rows.len()).sum();
    println!("{values} values of {} cases in docs/reference", cases.len());
    Ok(())
}
