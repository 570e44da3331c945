//! Scenes as text.

use super::Scene;
use crate::Real;
use serde::Serialize;
use serde::de::DeserializeOwned;
use thiserror::Error;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Reason why a file holds no scene, or why a scene cannot be written.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
#[error("{}{reason}", self.place())]
pub struct SceneError {
    /// Line of the fault, from 1, where it is known.
    pub line: Option<usize>,
    /// Field at fault, such as `upper.shape`; empty if it is the file as a whole.
    pub field: String,
    /// Nature of the fault.
    pub reason: String,
}

impl SceneError {
    fn place(&self) -> String {
        let line = self.line.map(|line| format!("line {line}: ")).unwrap_or_default();
        let field = if self.field.is_empty() { "" } else { &format!("{}: ", self.field) };
        line + field
    }
}

/// Forms of a control.
const CONTROLS: &str = "; a control is { load = F }, { half_width = L }, { peak_pressure = p }, { moment = { load = F, \
    moment = M, about = x } }, { centre_of_pressure = { load = F, at = x } }, or { approach = { approach = d, \
    references = { x = x, lower = { depth = h }, upper = { disc = R } } } }";

/// Words of Rust in the messages of its readers, and what stands in a file.
#[rustfmt::skip]
const WORDS: [(&str, &str); 7] = [
    ("wanted exactly 1 element, ", "one name with a value is wanted: "), ("newtype variant", "a name with a value"),
    ("unit variant", "a name alone"), ("unknown variant", "unknown name"), ("floating point", "number"),
    ("expected f64", "expected a number"), ("struct variant Control::", "the table of "),
];

fn fault(line: Option<usize>, field: String, said: &str) -> SceneError {
    let plain = WORDS.iter().fold(said.to_owned(), |said, (of, word)| said.replace(of, word));
    let forms = if field.starts_with("controls") { CONTROLS } else { "" };
    SceneError { line, field, reason: plain + forms }
}

/// Finds a number that is not finite, with the name and the place of it.
fn not_finite(name: &str, value: &Spanned<DeValue<'_>>) -> Option<(String, usize)> {
    match value.get_ref() {
        DeValue::Float(number) if !number.as_str().parse().is_ok_and(f64::is_finite) => {
            Some((name.to_owned(), value.span().start))
        }
        DeValue::Array(all) => all.iter().find_map(|one| not_finite(name, one)),
        DeValue::Table(all) => all.iter().find_map(|(key, one)| not_finite(key.get_ref(), one)),
        _ => None,
    }
}

/// Names the fields that lead to a fault.
fn field(path: &serde_path_to_error::Path) -> String {
    let path = path.to_string();
    // Neither the file as a whole nor the unknown place where it ends is a field.
    if path == "." || path == "?" { String::new() } else { path }
}

impl<T: Real + DeserializeOwned> Scene<T> {
    /// Reads a scene from TOML.
    ///
    /// # Errors
    /// [`SceneError`], with line and field: for text that is not TOML, unknown or missing fields,
    /// and bodies and stiffnesses that cannot be.
    pub fn from_toml(text: &str) -> Result<Self, SceneError> {
        let line = |place: usize| Some(1 + text[..place].matches('\n').count());
        let fault = |field, error: &toml::de::Error| {
            fault(error.span().and_then(|span| line(span.start)), field, error.message())
        };
        let file = DeTable::parse(text).map_err(|error| fault(String::new(), &error))?;
        let mut all = file.get_ref().iter();
        let infinite = all.find_map(|(key, value)| not_finite(key.get_ref(), value));
        let scene = serde_path_to_error::deserialize(toml::Deserializer::from(file))
            .map_err(|error| fault(field(error.path()), error.inner()))?;
        // Bodies and stiffnesses name their values themselves.
        infinite.map_or(Ok(scene), |(name, place)| {
            Err(self::fault(line(place), name, "the number is not finite"))
        })
    }

    /// Reads a scene from JSON.
    ///
    /// # Errors
    /// As [`from_toml`](Self::from_toml).
    pub fn from_json(text: &str) -> Result<Self, SceneError> {
        let fault = |field: String, error: &serde_json::Error| {
            let said = error.to_string();
            let reason = said.rsplit_once(" at line ").map_or(&*said, |(reason, _)| reason);
            fault(Some(error.line()), field, reason)
        };
        let mut file = serde_json::Deserializer::from_str(text);
        let scene = serde_path_to_error::deserialize(&mut file)
            .map_err(|error| fault(field(error.path()), error.inner()))?;
        file.end().map_err(|error| fault(String::new(), &error))?;
        Ok(scene)
    }
}

impl<T: Real + Serialize> Scene<T> {
    /// Writes the scene as TOML.
    ///
    /// # Errors
    /// [`SceneError`] without a line.
    pub fn to_toml(&self) -> Result<String, SceneError> {
        toml::to_string(self).map_err(|error| fault(None, String::new(), &error.to_string()))
    }

    /// Writes the scene as JSON.
    ///
    /// # Errors
    /// As [`to_toml`](Self::to_toml).
    pub fn to_json(&self) -> Result<String, SceneError> {
        serde_json::to_string_pretty(self)
            .map_err(|error| fault(None, String::new(), &error.to_string()))
    }
}
