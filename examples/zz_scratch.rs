use linecontact::*;
fn main() {
    let quartic = Curve::new([-3.0, 3.0], |k: f64| CurvePoint {
        x: k,
        y: k * k * (k * k - 2.0),
        dx: 1.0,
        dy: 4.0 * k * (k * k - 1.0),
    });
    let contact = Contact::new(&Flat, &quartic).unwrap().contact_modulus(1.0);
    for load in [1e-6, 0.1, 1.0, 3.0, 3.2, 5.0] {
        match contact.solve(Control::Load(load)) {
            Ok(s) => println!(
                "{load}: {:?} cost {:?} err {:?} {:?} peak {:?}",
                s.intervals(),
                s.cost(),
                s.limits_error(),
                s.report().trials(),
                s.peak()
            ),
            Err(e) => println!("{load}: {e}"),
        }
    }
    let mut solver = Solver::new();
    for load in [3.2, 3.1, 3.0, 2.0, 1.0, 2.0, 3.0, 3.1, 3.2] {
        match solver.solve(&contact, Control::Load(load)) {
            Ok(s) => println!(
                "{load}: {:?} cost {:?} err {:?} {:?}",
                s.intervals(),
                s.cost(),
                s.limits_error(),
                s.report().trials()
            ),
            Err(e) => println!("{load}: {e}"),
        }
    }
    // rough
    let rough = Curve::new([-2.0, 2.0], |k: f64| {
        let w = [(0.01, 9.0, 0.4), (-0.006, 17.3, 1.9), (0.003, 31.0, 4.0)];
        let (mut y, mut dy) = (k * k / 2.0, k);
        for (a, f, p) in w {
            y += a * (f * k + p as f64).cos();
            dy -= a * f * (f * k + p as f64).sin();
        }
        CurvePoint { x: k, y, dx: 1.0, dy }
    });
    let contact = Contact::new(&Flat, &rough).unwrap().contact_modulus(1.0);
    for load in [1e-5, 1e-3, 0.01, 0.02, 0.05, 0.1, 1.0] {
        match contact.solve(Control::Load(load)) {
            Ok(s) => println!(
                "{load}: {:?} cost {:?} err {:?} {:?}",
                s.intervals(),
                s.cost(),
                s.limits_error(),
                s.report().trials()
            ),
            Err(e) => println!("{load}: {e}"),
        }
    }
}
