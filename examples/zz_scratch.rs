use linecontact::*;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
fn main() {
    let calls = AtomicUsize::new(0);
    let body = Curve::new([-1.0, 1.0], |k: f64| {
        calls.fetch_add(1, Relaxed);
        CurvePoint { x: k + k * k * k, y: k * k / 2.0, dx: 1.0 + 3.0 * k * k, dy: k }
    });
    let contact = Contact::new(&Flat, &body).unwrap();
    let rule = Midpoint { segments: 32, ..Midpoint::DEFAULT };
    for contact in [
        contact.clone(),
        contact.clone().quadrature(&rule),
        contact.clone().single_interval(true),
        contact.clone().quadrature(&rule).single_interval(true),
    ] {
        for c in [Control::PeakPressure(0.05), Control::Load(0.05)] {
            let before = calls.load(Relaxed);
            let cost = contact.solve(c).unwrap().cost();
            println!("{c:?} {cost:?} {}", calls.load(Relaxed) - before);
        }
    }
}
