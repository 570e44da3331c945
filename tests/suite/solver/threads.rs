//! One solver for each thread, on shared profiles.
#![allow(missing_docs)]

use crate::common;

use common::{Profile, graph, join, paper};
use linecontact::{Contact, ContactError, Control, Solver};

/// Returns the limits, load, a pressure and the cost, bit by bit.
fn key(
    solver: &mut Solver<f64>,
    contact: &Contact<f64>,
    load: Control<f64>,
) -> Result<[u64; 5], ContactError<f64>> {
    let solution = solver.solve(contact, load)?;
    let pressure = solution.pressure()?.at(solution.hull().centre())?;
    let bits = [solution.a(), solution.b(), solution.load(), pressure].map(f64::to_bits);
    let [a, b, load, pressure] = bits;
    Ok([a, b, load, pressure, solution.cost().evaluations as u64])
}

#[test]
fn every_thread_has_the_same_bits() {
    let paper::Example { lower, upper, .. } = paper::three();
    let joined: Profile = join(vec![
        graph(-2.0, 0.1, |x| [x * x / 2.0, x]),
        graph(0.1, 2.0, |x| [x * x / 2.0 + 3.0 * (x - 0.1).powi(2), x + 6.0 * (x - 0.1)]),
    ]);
    let below = graph(-3.0, 3.0, |x| [-0.1 * x.cosh(), -0.1 * x.sinh()]);
    let run = |first: usize| {
        let scenes = [
            Contact::new(&*lower, &*upper).unwrap(),
            Contact::new(&*below, &*joined).unwrap(),
            Contact::new(&*below, &*upper).unwrap(),
        ];
        // Each thread in an order of its own, but cold in each scene.
        let mut keys = vec![Vec::new(); scenes.len()];
        for i in 0..scenes.len() {
            let which = (first + i) % scenes.len();
            let mut solver = Solver::new();
            for step in 0..40 {
                let load = Control::Load(0.01 + 0.002 * f64::from(step * 7 % 40));
                keys[which].push(key(&mut solver, &scenes[which], load).ok());
            }
        }
        keys
    };
    let alone = run(0);
    assert!(alone.iter().flatten().filter(|key| key.is_some()).count() > 60, "{alone:?}");
    std::thread::scope(|scope| {
        let threads: Vec<_> = (0..8).map(|i| scope.spawn(move || run(i))).collect();
        for thread in threads {
            assert_eq!(thread.join().unwrap(), alone);
        }
    });
}
