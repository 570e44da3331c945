//! Many scenes at once, over all cores (feature `rayon`).

use crate::{Real, Solver};
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Largest number of scenes that one solver takes in a row.
const MAX_IN_A_ROW: usize = 32;
/// Number of rows into which even a short slice is divided, to keep all cores busy.
const SLICE_ROWS: usize = 64;

/// Solves each scene of a slice, over all cores, and returns the results in the order of the
/// scenes.
///
/// A scene is anything from which `solve` can make a contact: a load, a set of parameters, a time.
/// The closure gets a [`Solver`] that has solved the scenes before it, and keeps what it needs of
/// the solution. A scene that fails does not stop the others. `progress` gets the number of scenes
/// done, on the thread that has done the last one; two calls may overlap.
///
/// The results do not depend on the number of threads, bit for bit: the slice is cut into rows of
/// up to 32 scenes, by its length alone, and each row starts with a new solver. Within a row each
/// scene starts from the contact before, so neighbours should be alike. The threads are those of
/// rayon's current pool.
///
/// ```
/// use linecontact::{Contact, ContactError, Control, Curve, CurvePoint, Flat, InputError, sweep};
///
/// let parabola = Curve::new([-1.0, 1.0], |k: f64| CurvePoint { x: k, y: k * k / 2.0, dx: 1.0, dy: k });
/// let contact = Contact::new(&Flat, &parabola)?;
/// let loads = [0.02, -1.0, 0.08];
/// let half_widths: Vec<Result<f64, ContactError<f64>>> = sweep(
///     &loads,
///     |solver, &load| Ok(solver.solve(&contact, Control::Load(load))?.a()),
///     |done| eprintln!("{done} of {}", loads.len()),
/// );
/// assert!((half_widths[0].as_ref().unwrap() - 0.2).abs() < 1e-15);
/// assert!(matches!(half_widths[1], Err(ContactError::Input(InputError::InvalidLoad { .. }))));
/// assert!((half_widths[2].as_ref().unwrap() - 0.4).abs() < 1e-15);
/// # Ok::<(), ContactError<f64>>(())
/// ```
pub fn sweep<T, S, R, E>(
    scenes: &[S],
    solve: impl Fn(&mut Solver<T>, &S) -> Result<R, E> + Sync,
    progress: impl Fn(usize) + Sync,
) -> Vec<Result<R, E>>
where
    T: Real,
    S: Sync,
    R: Send,
    E: Send,
{
    let row = scenes.len().div_ceil(SLICE_ROWS).clamp(1, MAX_IN_A_ROW);
    let done = AtomicUsize::new(0);
    let in_a_row = |row: &'_ [S]| -> Vec<Result<R, E>> {
        let mut solver = Solver::new();
        let one = |scene| {
            let result = solve(&mut solver, scene);
            progress(1 + done.fetch_add(1, Ordering::Relaxed));
            result
        };
        row.iter().map(one).collect()
    };
    scenes.par_chunks(row).flat_map_iter(in_a_row).collect()
}
