//! A search of one's own.

use linecontact::search::{Bracket, LimitSearch, Root, SearchError};

/// Illinois method: the secant between the ends of a sign change, where an end that has stayed
/// twice counts with half its value (Dowell and Jarratt, *BIT* 11, 1971, 168).
pub struct Illinois;

impl LimitSearch<f64> for Illinois {
    fn find(
        &self,
        f: &mut dyn FnMut(f64) -> f64,
        bracket: &Bracket<f64>,
    ) -> Result<Root<f64>, SearchError<f64>> {
        let [mut lo, mut hi] = [bracket.lo, bracket.hi];
        let mut evaluations = 0;
        let mut value = |x: f64| {
            evaluations += 1;
            f(x)
        };
        let [mut f_lo, mut f_hi] = bracket.values.unwrap_or_else(|| [value(lo), value(hi)]);
        if f_lo.signum() == f_hi.signum() {
            return Err(SearchError::NoSignChange { lo, hi, f_lo, f_hi });
        }
        let mut best = if f_lo.abs() < f_hi.abs() { (lo, f_lo) } else { (hi, f_hi) };
        let mut x = bracket.guess.unwrap_or(f64::NAN);
        let mut moved_lo = None;
        for _ in 0..2200 {
            if best.1 == 0.0 || hi - lo <= 4.0 * f64::EPSILON * lo.abs().max(hi.abs()) {
                break;
            }
            if !(x > lo && x < hi) {
                x = 0.5 * lo + 0.5 * hi;
            }
            let here = value(x);
            if !here.is_finite() {
                return Err(SearchError::NotFinite { x, value: here });
            }
            if here.abs() < best.1.abs() {
                best = (x, here);
            }
            let moves_lo = here.signum() == f_lo.signum();
            let stayed = if moved_lo.replace(moves_lo) == Some(moves_lo) { 0.5 } else { 1.0 };
            if moves_lo {
                (lo, f_lo, f_hi) = (x, here, stayed * f_hi);
            } else {
                (hi, f_hi, f_lo) = (x, here, stayed * f_lo);
            }
            x = (lo * f_hi - hi * f_lo) / (f_hi - f_lo);
        }
        Ok(Root { x: best.0, residual: best.1, bracket: [lo, hi], evaluations })
    }
}
