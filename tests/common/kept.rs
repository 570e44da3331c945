//! Counts and errors that examples compare with those kept in the repository.

/// Counts are the same wherever sin, cos and pow are; elsewhere a search may end a step sooner
/// or later.
const SAME_LIBRARY: bool =
    cfg!(all(target_arch = "x86_64", target_os = "linux", target_env = "gnu"));
const SLACK: f64 = if SAME_LIBRARY { 0.0 } else { 0.1 };
/// An error of a few units in the last place may be another few elsewhere.
const ERROR_FACTOR: f64 = 10.0;
const ERROR_FLOOR: f64 = 2e-15;

pub fn counts_agree(kept: f64, found: f64) -> bool {
    (found - kept).abs() <= SLACK * kept
}

/// An estimate that shrinks is no better for it.
#[allow(dead_code)]
pub fn estimates_agree(kept: f64, found: f64) -> bool {
    found <= ERROR_FACTOR * kept && kept <= ERROR_FACTOR * found
}

/// Only more is a fault.
pub fn errors_agree(kept: f64, found: f64) -> bool {
    found <= (ERROR_FACTOR * kept).max(ERROR_FLOOR) || kept.is_nan() && found.is_nan()
}
