//! Compares counts and errors of examples with those kept in the repository.

/// True where sin, cos and pow are those of the kept counts; with other libraries a search may take
/// a step more or fewer.
pub const SAME_LIBRARY: bool =
    cfg!(all(target_arch = "x86_64", target_os = "linux", target_env = "gnu"));
const SLACK: f64 = if SAME_LIBRARY { 0.0 } else { 0.1 };
/// Allowed factor of an error: a few ulps here may be several times as many elsewhere.
pub const ERROR_FACTOR: f64 = 10.0;
const ERROR_FLOOR: f64 = 2e-15;

pub fn counts_agree(kept: f64, found: f64) -> bool {
    (found - kept).abs() <= SLACK * kept
}

/// Tells whether an estimate agrees with the kept one; a smaller estimate counts as a change too.
#[allow(dead_code)]
pub fn estimates_agree(kept: f64, found: f64) -> bool {
    found <= ERROR_FACTOR * kept && kept <= ERROR_FACTOR * found
}

/// Tells whether an error is no larger than the kept one allows.
pub fn errors_agree(kept: f64, found: f64) -> bool {
    found <= (ERROR_FACTOR * kept).max(ERROR_FLOOR) || kept.is_nan() && found.is_nan()
}
