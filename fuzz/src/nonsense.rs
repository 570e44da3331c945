//! Meaningless numbers wherever numbers are asked for: the result is an error or an answer, in
//! bounded time.

use super::Rng;
use linecontact::{
    Contact, Control, Cost, Curve, CurvePoint, Edge, EdgePressure, Exponents, Flat, Interval,
    Midpoint, Panels, Piecewise,
};
use std::sync::atomic::{AtomicUsize, Ordering};

fn number(rng: &mut Rng) -> f64 {
    match rng.below(8) {
        0 => f64::from_bits(rng.bits()),
        1 => {
            [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0, -0.0, 5e-324, f64::MAX][rng.below(7)]
        }
        2 => -rng.scale(1e-3, 1e3),
        3 => rng.scale(1e-300, 1e300),
        _ => rng.scale(1e-3, 10.0),
    }
}

fn interval(rng: &mut Rng) -> [f64; 2] {
    if rng.chance(0.6) {
        [-rng.scale(1e-3, 10.0), rng.scale(1e-3, 10.0)]
    } else {
        [number(rng), number(rng)]
    }
}

fn edge(rng: &mut Rng) -> Edge<f64> {
    match rng.below(8) {
        0 => Edge::Fixed(number(rng)),
        1 => Edge::FreeUntil(number(rng)),
        2 => Edge::Adhesive(number(rng)),
        _ => Edge::Free,
    }
}

pub fn run(mut rng: Rng) -> Result<bool, String> {
    let evaluations = AtomicUsize::new(0);
    let rng = &mut rng;
    let curve = |rng: &mut Rng| {
        let (ends, wrong, value) = (interval(rng), rng.below(6), number(rng));
        let (bend, third, from) = (number(rng), number(rng), rng.between(-1.0, 1.0));
        let evaluations = &evaluations;
        Curve::new(ends, move |k: f64| {
            evaluations.fetch_add(1, Ordering::Relaxed);
            let x = k + third * k * k * k;
            let mut point =
                CurvePoint { x, y: bend * x * x / 2.0, dx: 1.0 + 3.0 * third * k * k, dy: 0.0 };
            point.dy = bend * x * point.dx;
            // One of the four components is wrong in places.
            if k > from {
                match wrong {
                    0 => point.x = value,
                    1 => point.dx = value,
                    2 => point.dy = value,
                    _ => {}
                }
            }
            point
        })
    };
    let (one, two) = (curve(rng), curve(rng));
    let joined = Piecewise::with_tolerance(vec![curve(rng), curve(rng)], number(rng));
    let contact = match (&joined, rng.below(4)) {
        (Ok(joined), 0) => Contact::new(&one, joined),
        (_, 1) => Contact::new(&one, &two),
        _ => Contact::new(&Flat, &two),
    };
    let Ok(mut contact) = contact else { return Ok(false) };
    let (panels, midpoint) = (
        Panels { tolerance: number(rng) },
        Midpoint {
            segments: rng.below(40),
            extrapolations: rng.below(5) as u32,
            exponents: Exponents::Even,
        },
    );
    if rng.chance(0.5) {
        contact = contact.kappa(number(rng));
    }
    if rng.chance(0.4) {
        contact = contact.edges(edge(rng), edge(rng));
    }
    if rng.chance(0.2) {
        let [left, right] = interval(rng);
        contact = contact.start(Interval { left, right });
    }
    let quadrature = rng.below(8);
    match quadrature {
        0 => contact = contact.quadrature(&panels),
        1 => contact = contact.quadrature(&midpoint),
        2 => {
            contact = contact
                .quadrature(&midpoint)
                .edge_pressure(EdgePressure::zero(number(rng), number(rng)));
        }
        _ => {}
    }
    let value = number(rng);
    let load = [Control::Load(value), Control::HalfWidth(value), Control::PeakPressure(value)]
        [rng.below(3)];
    let solved = contact.solve(load);
    // Budgets of the documentation, plus uncounted evaluations at single places.
    let most = if matches!(quadrature, 1 | 2) { 40_000_000 } else { 1_100_000 };
    let took = evaluations.load(Ordering::Relaxed);
    if took > most {
        return Err(format!(
            "evaluations: {took} by quadrature {quadrature} for {load:?} on {contact:?}"
        ));
    }
    let Ok(solution) = solved else { return Ok(false) };
    let on = solution.hull();
    let is_sound = if solution.is_apart() {
        // No load presses; a negative zero is none, either.
        let is_none = matches!(load, Control::Load(0.0)) && solution.load().to_bits() == 0;
        is_none && solution.intervals().is_empty() && on.left == on.right && on.left.is_finite()
    } else {
        on.left < on.right && on.right - on.left < f64::INFINITY && solution.load().is_finite()
    };
    if !is_sound {
        return Err(format!(
            "limits: {on:?} under {} for {load:?} on {contact:?}",
            solution.load()
        ));
    }
    for x in [number(rng), on.left + (on.right - on.left) * rng.share()] {
        let _ = (solution.gap_at(x), solution.gap_slope(x), solution.residual(x));
        if let Ok(pressure) = solution.pressure() {
            let _ = (pressure.at(x), pressure.estimate(x, &mut Cost::default()));
        }
        if let Ok(below) = solution.subsurface() {
            let _ = below.at(x, number(rng));
        }
    }
    let _ = (solution.peak(), solution.moment(), solution.load_rates().map(|_| ()));
    if rng.chance(0.05) {
        let _ = solution.certify();
    }
    Ok(true)
}
