#![allow(missing_docs, dead_code)]
#[path = "features/derivatives_several.rs"]
mod derivatives_several;
#[path = "common/forms.rs"]
mod forms;
