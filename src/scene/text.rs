//! Scenes as text.

use super::Scene;
use crate::Real;
use serde::Serialize;
use serde::de::DeserializeOwned;
use thiserror::Error;

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

    fn writing(error: impl ToString) -> Self {
        Self { line: None, field: String::new(), reason: error.to_string() }
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
    /// and bodies that cannot be built.
    pub fn from_toml(text: &str) -> Result<Self, SceneError> {
        let fault = |field: String, error: &toml::de::Error| SceneError {
            line: error.span().map(|span| 1 + text[..span.start].matches('\n').count()),
            field,
            reason: error.message().to_owned(),
        };
        let file = toml::Deserializer::parse(text).map_err(|error| fault(String::new(), &error))?;
        serde_path_to_error::deserialize(file)
            .map_err(|error| fault(field(error.path()), error.inner()))
    }

    /// Reads a scene from JSON.
    ///
    /// # Errors
    /// As [`from_toml`](Self::from_toml).
    pub fn from_json(text: &str) -> Result<Self, SceneError> {
        let fault = |field: String, error: &serde_json::Error| {
            let said = error.to_string();
            let reason = said.rsplit_once(" at line ").map_or(&*said, |(reason, _)| reason);
            SceneError { line: Some(error.line()), field, reason: reason.to_owned() }
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
        toml::to_string(self).map_err(SceneError::writing)
    }

    /// Writes the scene as JSON.
    ///
    /// # Errors
    /// As [`to_toml`](Self::to_toml).
    pub fn to_json(&self) -> Result<String, SceneError> {
        serde_json::to_string_pretty(self).map_err(SceneError::writing)
    }
}
