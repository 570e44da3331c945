//! A case: a scene with its known values.

use super::precise::Precise;
use std::error::Error;

/// Largest relative error of a value rounded to fifteen digits: half a unit of the last one.
pub const FIFTEEN_DIGITS: f64 = 5e-15;

/// Largest relative difference that passes between closed form and solver.
pub const AGREEMENT: f64 = 1e-12;

/// Units, then quantities with their units.
pub const LENGTH: &str = "mm";
pub const PRESSURE: &str = "MPa";
pub const FORCE: &str = "N/mm";

pub const HALF_WIDTH: (&str, &str) = ("half_width", LENGTH);
pub const PEAK: (&str, &str) = ("peak_pressure", PRESSURE);
pub const MEAN: (&str, &str) = ("mean_pressure", PRESSURE);
pub const AT: (&str, &str) = ("pressure", PRESSURE);
pub const LEFT: (&str, &str) = ("left_limit", LENGTH);
pub const RIGHT: (&str, &str) = ("right_limit", LENGTH);
pub const LOAD: (&str, &str) = ("load", FORCE);
pub const TRACTION: (&str, &str) = ("traction", PRESSURE);
pub const STICK: (&str, &str) = ("stick_half_width", LENGTH);
pub const MODULUS: (&str, &str) = ("contact_modulus", PRESSURE);
pub const STIFFNESS: (&str, &str) = ("stiffness", PRESSURE);
pub const STRENGTH: [(&str, &str); 2] =
    [("edge_strength_left", PRESSURE), ("edge_strength_right", PRESSURE)];

/// Case, or the error of the solver.
pub type Made = Result<Case, Box<dyn Error>>;

/// Parameter as a tuple: symbol, value, unit and meaning.
pub type Given = (&'static str, f64, &'static str, &'static str);

/// Place at which a value holds.
#[derive(Clone, Copy)]
pub enum Place {
    Whole,
    At(f64),
    Below(f64, f64),
}

pub struct Row {
    pub quantity: &'static str,
    pub unit: &'static str,
    pub place: Place,
    pub value: f64,
    /// Bound on the relative error.
    pub error: f64,
    pub kind: &'static str,
    pub formula: String,
    pub source: String,
    /// Value from the solver.
    pub solved: f64,
    /// Largest relative difference that passes between the two.
    pub allowed: f64,
}

pub struct Parameter {
    pub symbol: &'static str,
    pub value: f64,
    pub unit: &'static str,
    pub meaning: &'static str,
}

pub struct Case {
    pub name: &'static str,
    pub title: &'static str,
    pub lower: String,
    pub upper: String,
    pub parameters: Vec<Parameter>,
    pub rows: Vec<Row>,
    /// Source of the rows that follow.
    source: String,
}

impl Case {
    pub fn new(
        name: &'static str,
        title: &'static str,
        bodies: [&str; 2],
        parameters: &[Given],
    ) -> Self {
        let parameters = parameters.iter().map(|&(symbol, value, unit, meaning)| Parameter {
            symbol,
            value,
            unit,
            meaning,
        });
        let [lower, upper] = bodies.map(str::to_owned);
        Self {
            name,
            title,
            lower,
            upper,
            parameters: parameters.collect(),
            rows: Vec::new(),
            source: String::new(),
        }
    }

    pub fn source(&mut self, source: &str) {
        self.source = source.into();
    }

    /// Adds a value from a formula, to fifteen digits.
    pub fn closed(
        &mut self,
        (quantity, unit): (&'static str, &'static str),
        place: Place,
        value: Precise,
        solved: f64,
        formula: &str,
    ) -> &mut Row {
        let (value, error) = (value.rounded(), FIFTEEN_DIGITS);
        self.add(Row {
            quantity,
            unit,
            place,
            value,
            error,
            kind: "closed form",
            formula: formula.into(),
            source: self.source.clone(),
            solved,
            allowed: AGREEMENT,
        })
    }

    /// Adds a computed value from a reference file.
    pub fn computed(
        &mut self,
        (quantity, unit): (&'static str, &'static str),
        place: Place,
        value: f64,
        error: f64,
        solved: f64,
    ) -> &mut Row {
        self.add(Row {
            quantity,
            unit,
            place,
            value,
            error,
            kind: "computed",
            formula: String::new(),
            source: self.source.clone(),
            solved,
            allowed: AGREEMENT,
        })
    }

    fn add(&mut self, row: Row) -> &mut Row {
        self.rows.push(row);
        let last = self.rows.len() - 1;
        &mut self.rows[last]
    }
}

impl Row {
    /// Marks the place of a maximum, of which the solver knows only half the digits.
    pub fn flat(&mut self) {
        self.allowed = 1e-6;
    }

    pub fn within(&mut self, allowed: f64) {
        self.allowed = allowed;
    }

    pub fn difference(&self) -> f64 {
        (self.solved / self.value - 1.0).abs()
    }

    pub fn places(&self) -> [Option<f64>; 2] {
        match self.place {
            Place::Whole => [None, None],
            Place::At(x) => [Some(x), None],
            Place::Below(x, depth) => [Some(x), Some(depth)],
        }
    }
}
