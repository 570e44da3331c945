//! Many scenes at once: the same results for any number of threads, in order; a failure affects its
//! own scene only.
#![allow(missing_docs)]

use linecontact::{
    Contact, ContactError, Control, Curve, CurvePoint, Flat, InputError, Panels, Solver, sweep,
};
use std::sync::Mutex;
use thiserror::Error;

/// Radius and load of a roller on a flat.
type Scene = (f64, f64);

#[derive(Debug, Error, PartialEq)]
enum Fault {
    #[error("no radius")]
    Radius,
    #[error(transparent)]
    Contact(#[from] ContactError<f64>),
}

fn scenes(n: usize) -> Vec<Scene> {
    let share = |i: usize| i as f64 / n as f64;
    let scene = |i: usize| match i % 7 {
        3 => (1.0, -1.0),
        5 => (0.0, 0.1),
        _ => (1.0 + share(i), 0.01 + 0.2 * share(i)),
    };
    (0..n).map(scene).collect()
}

/// Returns the limits and a pressure of each scene, and the reports of progress, for a number of
/// threads.
fn solve(scenes: &[Scene], threads: usize) -> (Vec<Result<[f64; 3], Fault>>, Vec<usize>) {
    let told = Mutex::new(Vec::new());
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let results = pool.install(|| {
        sweep(
            scenes,
            |solver, &(radius, load)| {
                if radius <= 0.0 {
                    return Err(Fault::Radius);
                }
                let arc = Curve::new([-1.5, 1.5], |k: f64| {
                    let (s, c) = k.sin_cos();
                    let (x, y) = (radius * s, radius * (1.0 - c));
                    CurvePoint { x, y, dx: radius * c, dy: radius * s }
                });
                let contact = Contact::new(&Flat, &arc)?;
                let solution = solver.solve(&contact, Control::Load(load))?;
                let pressure = solution.pressure()?.at(0.1 * solution.a())?;
                Ok([solution.a(), solution.b(), pressure])
            },
            |done| told.lock().unwrap().push(done),
        )
    });
    (results, told.into_inner().unwrap())
}

#[test]
fn the_number_of_threads_does_not_matter() {
    for n in [0, 1, 5, 64, 65, 500, 3000] {
        let scenes = scenes(n);
        let (alone, _) = solve(&scenes, 1);
        assert_eq!(alone.len(), n);
        for threads in [2, 3, 8] {
            let (results, mut told) = solve(&scenes, threads);
            assert!(results == alone, "{n} scenes, {threads} threads");
            told.sort_unstable();
            assert!(told.into_iter().eq(1..=n));
        }
    }
}

#[test]
fn a_scene_that_fails_fails_alone() {
    let scenes = scenes(500);
    let (results, _) = solve(&scenes, 2);
    for (&(radius, load), result) in scenes.iter().zip(results) {
        if radius == 0.0 {
            assert_eq!(result, Err(Fault::Radius));
        } else if load < 0.0 {
            let (quantity, value, must) = ("load", load, "positive where limits are sought");
            assert_eq!(
                result,
                Err(Fault::Contact(ContactError::Input(InputError::InvalidLoad {
                    quantity,
                    value,
                    must
                })))
            );
        } else {
            // A scene solved after others gives the result of a scene solved alone.
            let arc = Curve::new([-1.5, 1.5], |k: f64| {
                let (s, c) = k.sin_cos();
                CurvePoint { x: radius * s, y: -radius * c, dx: radius * c, dy: radius * s }
            });
            let contact = Contact::new(&Flat, &arc).unwrap();
            let alone = contact.solve(Control::Load(load)).unwrap();
            let [a, b, _] = result.unwrap();
            assert!((a / alone.a() - 1.0).abs() < 2e-14 && (b / alone.b() - 1.0).abs() < 2e-14);
        }
    }
}

#[test]
fn settings_that_cannot_be_used_are_an_error_of_each() {
    let never = Panels { tolerance: 2.0 };
    let contact = Contact::new(&Flat, &Flat).unwrap().quadrature(&never);
    let solve =
        |solver: &mut Solver<f64>, load| solver.solve(&contact, Control::Load(load)).map(|_| ());
    let results: Vec<Result<(), ContactError<f64>>> =
        sweep(&[1.0, 2.0, 3.0], |solver, &load| solve(solver, load), |_| {});
    assert_eq!(
        results,
        vec![Err(ContactError::Input(InputError::InvalidTolerance { tolerance: 2.0 })); 3]
    );
}
