//! Figures of README.md, compared with what is measured and counted here.
//!
//! The errors of measured points are compared by `examples/measured_profile.rs`, the evaluations
//! for each of many pieces by `examples/pieces.rs`, the output of the first program by
//! `examples/quickstart.rs`.
#![allow(missing_docs)]

use crate::{closed_forms_solved, default_solve, kept, limits, several_bench, stress, tasks_bench};
use linecontact::{Contact, Control, Flat};

fn readme() -> String {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/README.md");
    std::fs::read_to_string(path).unwrap()
}

/// Returns the cells of the only row of a table that starts with a cell, without that cell.
fn row(first: &str) -> Vec<String> {
    let (text, start) = (readme(), format!("|{first}|"));
    let mut rows = text.lines().filter_map(|line| line.strip_prefix(&start));
    let row = rows.next().unwrap_or_else(|| panic!("README has no row {start}"));
    assert!(rows.next().is_none(), "README has several rows {start}");
    row.trim_end_matches('|').split('|').map(str::to_owned).collect()
}

/// Returns the numbers in a text; `3 200 to 15 000` has two.
fn numbers(text: &str) -> Vec<f64> {
    let (mut found, mut may_go_on) = (Vec::<f64>::new(), false);
    for word in text.split_whitespace() {
        let digits = word.trim_end_matches([',', ';']);
        let number = digits.parse::<f64>().ok();
        match (number, found.last_mut()) {
            (Some(number), Some(last)) if may_go_on && digits.len() == 3 => {
                *last = 1e3 * *last + number;
            }
            (Some(number), _) => found.push(number),
            (None, _) => {}
        }
        may_go_on = number.is_some() && digits == word;
    }
    found
}

/// Returns the µs that a text states.
fn micros(text: &str) -> Vec<f64> {
    let units = [(" µs", 1.0), (" ms", 1e3), (" s", 1e6)];
    let unit = units.iter().find(|(unit, _)| text.ends_with(unit));
    let (_, unit) = unit.unwrap_or_else(|| panic!("{text} has no unit"));
    numbers(text).into_iter().map(|number| number * unit).collect()
}

#[test]
fn errors_are_those_measured() {
    let is_noisy = |name: &str| ["3", "4", "5"].iter().any(|n| name.contains(&format!("_{n}_s")));
    let (noisy, smooth): (Vec<_>, Vec<_>) =
        limits::errors().into_iter().partition(|(name, _)| is_noisy(name));
    assert_eq!(noisy.len(), 6);
    let worst = |errors: Vec<(_, f64)>| crate::common::worst(errors.into_iter().map(|e| e.1));
    let [limits, pressure] = closed_forms_solved::largest_errors();
    for (name, measured) in [
        ("limits, smooth bodies", worst(smooth).max(limits)),
        ("limits, formulas that lose digits", worst(noisy)),
        ("pressure, closed forms", pressure),
        ("stress at any depth below one contact, beside kinks too", stress::largest_error()),
    ] {
        let printed = numbers(&row(name)[0])[0];
        println!("README: {name}: {measured:.1e}, printed {printed:.0e}");
        // With other sin, cos and pow a few ulps may be several times as many.
        let factor = if kept::SAME_LIBRARY { 1.0 } else { kept::ERROR_FACTOR };
        assert!(measured <= factor * printed, "{name}: {measured:e} is more than {printed:e}");
        assert!(
            measured >= printed / 5.0 / factor,
            "{name}: {measured:e} is far below {printed:e}"
        );
    }
}

#[test]
fn evaluations_are_those_counted() {
    for (scene, first, next) in [
        ("circle", "circle as a closure, default solve, from nothing", "the circle, next load"),
        ("example4", "the paper's Example 4, default solve, from nothing", "Example 4, next load"),
    ] {
        let [evaluations, heights, again] = default_solve::evaluations(scene).map(|n| n as f64);
        assert_eq!(numbers(&row(first)[1]), [evaluations, heights], "{first}");
        assert_eq!((row(next)[1].as_str(), again), ("none", 0.0), "{next}");
    }
    let from_start = "Example 4 from a given start, with 101 pressures";
    assert_eq!(numbers(&row(from_start)[1]), [tasks_bench::evaluations("T5", 1e-12) as f64]);
    let all = crate::common::speed_scenes::SCENES.map(|scene| default_solve::answers(scene)[1]);
    let range = [all.iter().min(), all.iter().max()].map(|n| two_digits(*n.unwrap()));
    assert_eq!(numbers(&row("`certify`, smooth bodies")[1]), range);
}

/// Rounds a count to two digits.
fn two_digits(count: usize) -> f64 {
    let unit = 10f64.powi(count.ilog10() as i32 - 1);
    (count as f64 / unit).round() * unit
}

#[test]
fn contacts_are_those_found() {
    let many = several_bench::MANY
        .map(|(count, noise, load)| (several_bench::noisy(count, noise * load), load));
    let rough = (several_bench::profile(), several_bench::ROUGH_LOAD);
    let [_, .., most] = many;
    let found = [rough, most].map(|(body, load)| {
        let contact = Contact::new(&Flat, &body).unwrap();
        contact.solve(Control::Load(load)).unwrap().intervals().len() as f64
    });
    let [few, _, many] = numbers(&row("a rough surface")[0])[..] else { panic!("three numbers") };
    assert_eq!([few, many], found);
}

/// Returns the number that `benches/instructions.tsv` keeps for a scene.
fn instructions(scene: &str, column: &str) -> f64 {
    let kept = include_str!("../../benches/instructions.tsv");
    let cells = |line: &'static str| line.split('\t').collect::<Vec<_>>();
    kept.split("\n\n")
        .find_map(|table| {
            let mut rows = table.lines().filter(|line| !line.starts_with('#')).map(cells);
            let at = rows.next()?.iter().position(|&name| name == column)?;
            rows.find(|row| row[0] == scene)?[at].parse().ok()
        })
        .unwrap_or_else(|| panic!("{column} of {scene} is not counted"))
}

/// Times depend on the machine, but that of an instruction is nearly the same in all rows.
#[test]
fn times_are_in_proportion_to_instructions() {
    let time = |first: &str| micros(&row(first)[0]);
    let certify = time("`certify`, smooth bodies");
    let rough = &row("a rough surface")[0];
    let rows = [
        (time("circle as a closure, default solve, from nothing")[0], "circle", "cold"),
        (time("the circle, next load")[0], "circle", "next"),
        (time("the paper's Example 4, default solve, from nothing")[0], "example4", "cold"),
        (time("Example 4, next load")[0], "example4", "next"),
        (certify[0], "parabola", "certify"),
        (certify[1], "example4", "certify"),
        (1e6 * numbers(rough)[1], "rough", "cold"),
    ];
    let each = rows.map(|(micros, scene, column)| micros / instructions(scene, column));
    for (one, each) in rows.iter().zip(each) {
        println!("README: {one:?}: {:.3} ns per instruction", 1e3 * each);
    }
    let [least, most] = [f64::min, f64::max].map(|of| each.into_iter().reduce(of).unwrap());
    assert!(most <= 2.0 * least, "{each:?}");
}

#[test]
fn what_the_text_repeats_is_in_the_tables() {
    let text = readme().split_whitespace().collect::<Vec<_>>().join(" ");
    let time = |first: &str| row(first)[0].clone();
    let circle = time("circle as a closure, default solve, from nothing");
    let harder = time("the paper's Example 4, default solve, from nothing");
    let next = ["the circle, next load", "Example 4, next load"].map(|of| micros(&time(of))[0]);
    let [next, also] = next.map(f64::round);
    assert_eq!(next, also);
    let digits = -numbers(&row("pressure, closed forms")[0])[0].log10().ceil();
    for statement in [
        format!("A circle takes {circle} for the first load, a harder example {harder};"),
        format!("the next load takes about {next} µs for either"),
        format!("limits and pressure are exact to about {digits} digits"),
        format!("Rust {} or later", env!("CARGO_PKG_RUST_VERSION")),
    ] {
        assert!(text.contains(&statement), "README does not say: {statement}");
    }
}
