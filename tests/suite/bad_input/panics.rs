//! User code that panics.

use super::*;
use linecontact::Solver;

/// Returns a curve that panics at its `at`-th call.
fn panicking(at: usize) -> Profile {
    curve([-1.0, 1.0], move |k| {
        assert!(EVALUATIONS.get() != at, "the user's own");
        by_cubic(k)
    })
}

#[test]
fn panics_of_the_user_pass_through() {
    let good = body();
    let contact = Contact::new(&Flat, &*good).unwrap();
    let rule = Midpoint::default();
    let of = |solution: &Solution<f64>| {
        let pressure = solution.pressure().unwrap().at(0.05).unwrap();
        [solution.a(), solution.b(), solution.load(), pressure]
    };
    let load = Control::Load(0.05);
    for contact in [
        contact.clone(),
        contact.clone().quadrature(&rule),
        contact.clone().edges(Edge::Adhesive(1e-3), Edge::Free),
    ] {
        let wanted = of(&contact.solve(load).unwrap());
        let mut solver = Solver::new();
        let mut passed = 0;
        for at in (1..40).chain((40..4000).step_by(97)) {
            let bad = panicking(at);
            // The first two calls are those of Contact::new.
            EVALUATIONS.set(if at > 2 { 0 } else { 2 });
            let Ok(scene) = Contact::new(&Flat, &*bad) else { panic!() };
            EVALUATIONS.set(2);
            let outcome =
                catch_unwind(AssertUnwindSafe(|| solver.solve(&scene, load).map(|s| s.a()).ok()));
            passed += usize::from(outcome.is_err());
            // Cold and warm, as if nothing had happened.
            for _ in 0..2 {
                let got = of(&solver.solve(&contact, load).unwrap());
                for (got, want) in got.into_iter().zip(wanted) {
                    assert!(
                        (got - want).abs() <= 1e-13 * want.abs(),
                        "after call {at}: {got:e} for {want:e}"
                    );
                }
            }
        }
        assert!(passed > 8, "{passed} panics");
    }
}
