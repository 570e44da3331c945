//! Scenes in files.

use linecontact::scene::{Scene, SceneError};
use pyo3::prelude::*;

/// Translates a scene from one format into another: "toml" or "json".
#[pyfunction]
pub fn scene_text(py: Python<'_>, text: &str, from: &str, to: &str) -> PyResult<String> {
    let scene: Result<Scene<f64>, _> =
        if from == "toml" { Scene::from_toml(text) } else { Scene::from_json(text) };
    let written =
        scene.and_then(|scene| if to == "toml" { scene.to_toml() } else { scene.to_json() });
    match written {
        Ok(text) => Ok(text),
        Err(SceneError { line, field, reason }) => {
            let class = py.import("linecontact.errors")?.getattr("SceneFileError")?;
            Err(PyErr::from_value(class.call1(("", line, field, reason))?))
        }
    }
}
