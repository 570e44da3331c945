//! All tests, but for those of dual numbers, as one program: the solver is compiled only once.
#![allow(missing_docs)]
#![allow(clippy::duplicate_mod, reason = "programs of their own, whose scenes are compared")]

#[path = "../common/boundary_elements.rs"]
mod boundary_elements;
#[path = "../common/mod.rs"]
mod common;
#[path = "../common/forms.rs"]
mod forms;
#[cfg(feature = "autodiff")]
#[path = "../common/formulas.rs"]
mod formulas;
#[path = "../common/integrals.rs"]
mod integrals;
#[allow(dead_code)]
#[path = "../common/kept.rs"]
mod kept;
#[allow(dead_code)]
#[path = "../../benches/several.rs"]
mod several_bench;
#[allow(dead_code)]
#[path = "../../benches/tasks.rs"]
mod tasks_bench;

mod accuracy;
mod apart;
mod approach;
#[cfg(feature = "autodiff")]
mod autodiff;
mod bad_input;
mod births;
mod certificate;
mod certificate_edges;
mod certificate_several;
mod check_derivatives;
mod closed_forms;
mod closed_forms_solved;
mod common_shapes;
mod controls;
mod corners;
mod declared_convexity;
mod default_solve;
mod dents;
mod displacement;
mod display;
mod edge_pressures;
mod edges;
mod errors;
mod estimates;
#[cfg(feature = "scene")]
mod files;
mod finite_roller;
mod flanks;
mod flats;
mod fretting;
mod fuzz_regressions;
mod held_corners;
mod held_widths;
mod invariants;
mod joints;
mod kernel;
mod land_widths;
mod largest_values;
mod limits;
mod loads;
mod messages;
mod narrow_features;
mod nested_search;
mod noise;
mod oracle;
mod outliers;
mod outline;
mod overload;
mod overload_several;
mod own_curves;
mod own_quadrature;
mod own_searches;
mod owned;
mod pair;
mod partial_slip;
mod peak;
mod pieces;
mod pin_in_hole;
mod profiles;
mod pull_off;
mod quadrature;
mod quantities;
mod random_scenes;
mod readme;
mod reference_tables;
mod references_f32;
mod resolution;
mod rows_of_lands;
mod safeguards;
mod saturated;
#[cfg(feature = "scene")]
mod scene_files;
mod search_counts;
mod searches;
mod several_closed_forms;
mod several_quantities;
mod several_solved;
mod shapes;
mod signorini;
mod slits;
mod small_gaps;
mod solver;
mod spline;
mod spring;
mod starts;
mod stress;
mod tilt;
mod undeclared;
mod unseen;
mod what_is_checked;
