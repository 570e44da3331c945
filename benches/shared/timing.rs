//! Measurement of time in the benches.

use std::time::Instant;

/// Returns the µs of a call: the least of three medians over five batches of about 20 ms each.
pub fn time(mut call: impl FnMut()) -> f64 {
    let mut batch = |calls: usize| {
        let start = Instant::now();
        (0..calls).for_each(|_| call());
        start.elapsed().as_secs_f64() * 1e6 / calls as f64
    };
    // A long call warms itself up.
    let first = batch(1);
    batch((1e3 / first) as usize);
    let calls = (20e3 / batch((1e3 / first).max(1.0) as usize)).max(1.0) as usize;
    let mut median = || {
        let mut each = [(); 5].map(|()| batch(calls));
        each.sort_by(f64::total_cmp);
        each[2]
    };
    median().min(median()).min(median())
}
