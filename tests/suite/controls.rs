//! Half-width, peak and approach of several contacts, and values that no load has.
#![allow(missing_docs)]

use crate::common;

use common::{Profile, Shares, controls::controls_of, graph, join, on_flat, quartic};
use linecontact::{
    Contact, ContactError, Control, Edge, Flat, Material, PlaneState, Solution, SolveError,
};
use std::f64::consts::PI;

#[test]
fn two_contacts_of_a_quartic_by_their_width_and_by_their_peak() {
    // From sqrt(1 - d/2) to sqrt(1 + d/2), up to F = π.
    let contact = on_flat(quartic(-3.0, 3.0)).contact_modulus(1.0);
    for load in [1e-4f64, 0.3, 2.0, 3.1] {
        let d = (4.0 * load / PI).sqrt();
        let [near, far] = [(1.0 - d / 2.0).sqrt(), (1.0 + d / 2.0).sqrt()];
        // P = 2 x sqrt((x² - near²)(far² - x²)) is largest at the maximum of u (u - near²)(far² -
        // u), u = x².
        let [one, two] = [near * near, far * far];
        let u = ((one + two) + ((one + two).powi(2) - 3.0 * one * two).sqrt()) / 3.0;
        let peak = 2.0 * (u * (u - one) * (two - u)).sqrt();
        for control in [Control::HalfWidth(far), Control::PeakPressure(peak)] {
            let solution = contact.solve(control).unwrap();
            assert_eq!(solution.intervals().len(), 2, "{control:?}");
            // The width beyond 1 goes with the root of the load.
            let allowed = 1e-11 + 8.0 * f64::EPSILON / d;
            assert!((solution.load() / load - 1.0).abs() < allowed, "{control:?}: {solution}");
            assert!((solution.intervals()[1].left - near).abs() < 1e-11 * d.max(1e-2));
        }
    }
}

#[test]
fn a_value_in_a_jump_is_refused_with_both_sides() {
    // Under the lightest load the hull already spans both equal hills.
    let contact = on_flat(quartic(-3.0, 3.0)).contact_modulus(1.0);
    let error = contact.solve(Control::HalfWidth(0.5)).unwrap_err();
    let ContactError::Solve(SolveError::InJump { wanted, below, above, .. }) = error else {
        panic!("{error}")
    };
    assert_eq!((wanted, below), (0.5, 0.0));
    assert!((1.0..1.1).contains(&above), "{above}");

    // A hill next to the one that is touched first.
    let body = graph(-1.0, 3.0, |x: f64| {
        let (bell, slope) = ((-2.0 * (x - 1.5).powi(2)).exp(), -4.0 * (x - 1.5));
        [x * x / 2.0 - 1.1 * bell, x - 1.1 * bell * slope]
    });
    let contact = on_flat(body);
    let error = contact.solve(Control::HalfWidth(0.5)).unwrap_err();
    let ContactError::Solve(SolveError::InJump { load, below, above, .. }) = error else {
        panic!("{error}")
    };
    let sides = [1.0 - 1e-7, 1.0 + 1e-7].map(|times| {
        let solution = contact.solve(Control::Load(times * load)).unwrap();
        (solution.intervals().len(), solution.hull().half_width())
    });
    assert_eq!(sides.map(|(count, _)| count), [1, 2], "{load}");
    assert!((sides[0].1 / below - 1.0).abs() < 1e-6 && (sides[1].1 / above - 1.0).abs() < 1e-3);
    assert!(below < 0.5 && above > 0.5);
}

#[test]
fn what_a_load_gives_finds_the_load_again() {
    let steel = Material::elastic(1.0, 0.3);
    let mut several = 0;
    for (waves, steep) in [(7.0, 0.5), (13.0, 2.0), (31.0, 6.0), (57.0, 12.0), (90.0, 20.0)] {
        let amplitude = steep / (waves * waves);
        let body = graph(-1.0, 1.0, move |x: f64| {
            let (sin, cos) = (waves * x + 0.4).sin_cos();
            [x * x / 2.0 + amplitude * cos, x - amplitude * waves * sin]
        });
        let contact = on_flat(body).materials(steel, steel, PlaneState::Strain);
        for load in [1e-5, 1e-4, 1e-3, 1e-2] {
            let due = contact.solve(Control::Load(load)).unwrap();
            several += usize::from(due.intervals().len() > 1);
            for control in controls_of(&due) {
                let found = contact.solve(control);
                let found = found.unwrap_or_else(|e| panic!("{waves} {load} {control:?}: {e}"));
                let off = (found.load() / load - 1.0).abs();
                assert!(off < 1e-9, "{waves} {load} {control:?}: {found}, off by {off}");
                assert_eq!(found.intervals().len(), due.intervals().len());
            }
        }
    }
    assert!(several > 5, "{several}");
}

/// Returns a convex polygon from -1 to 1.
fn polygon(shares: &mut Shares) -> Profile {
    let pieces = 3 + shares.between(0.0, 9.99) as usize;
    let mut sorted = |count: usize, most: f64| {
        let mut values: Vec<f64> = (0..count).map(|_| shares.between(-most, most)).collect();
        values.sort_by(f64::total_cmp);
        values
    };
    let [mut xs, mut slopes] = [sorted(pieces - 1, 0.95), sorted(pieces - 2, 0.5)];
    xs.extend([-1.0, 1.0]);
    slopes.extend([-0.6, 0.6]);
    for values in [&mut xs, &mut slopes] {
        values.sort_by(f64::total_cmp);
    }
    let mut from = 0.0;
    let part = |(ends, &slope): (&[f64], &f64)| {
        let (left, height) = (ends[0], from);
        from += slope * (ends[1] - left);
        graph(left, ends[1], move |x| [height + slope * (x - left), slope])
    };
    join(xs.windows(2).zip(&slopes).map(part).collect())
}

/// Returns a flat from -1 to 1 between arcs of different radii, with or without crown and tilt.
fn punch(shares: &mut Shares) -> Profile {
    let radii = [0; 2].map(|_| shares.power_of_ten(-2.5, -0.5));
    let mut some = |nothing: f64| {
        let is_nothing = shares.between(0.0, 1.0) < nothing;
        if is_nothing { 0.0 } else { shares.power_of_ten(-6.0, -2.0) }
    };
    let [tilt, crown] = [some(0.4), some(0.5)];
    let flat = move |x: f64| [(crown * x / 2.0 + tilt) * x, crown * x + tilt];
    let arc = move |x: f64, edge: f64, radius: f64| {
        let ([height, slope], d) = (flat(edge), x - edge);
        let root = (radius * radius - d * d).sqrt();
        [height + slope * d + d * d / (radius + root), slope + d / root]
    };
    let [left, right] = radii;
    join(vec![
        graph(-1.0 - 0.9 * left, -1.0, move |x| arc(x, -1.0, left)),
        graph(-1.0, 1.0, flat),
        graph(1.0, 1.0 + 0.9 * right, move |x| arc(x, 1.0, right)),
    ])
}

/// Returns a flat between two parabolas, tilted.
fn roller(shares: &mut Shares) -> Profile {
    let [tilt, depth, flat] =
        [[-5.0, -2.0], [-3.0, -0.5], [-1.0, -0.1]].map(|[from, to]| shares.power_of_ten(from, to));
    let body = move |x: f64| {
        let d = (x.abs() - flat).max(0.0);
        [tilt * x + depth * d * d, tilt + 2.0 * depth * d * x.signum()]
    };
    join([-1.0, -flat, flat, 1.0].windows(2).map(|ends| graph(ends[0], ends[1], body)).collect())
}

fn wave(shares: &mut Shares) -> Profile {
    let [waves, phase] = [shares.between(3.0, 150.0), shares.between(0.0, 2.0 * PI)];
    let tall = shares.power_of_ten(-1.0, 1.3) / (waves * waves);
    graph(-1.0, 1.0, move |x: f64| {
        let (sin, cos) = (waves * x + phase).sin_cos();
        [x * x / 2.0 + tall * cos, x - tall * waves * sin]
    })
}

/// Returns two hills; if they are equally high, a width below their distance needs no load.
fn hills(shares: &mut Shares) -> Profile {
    let lean = shares.power_of_ten(-6.0, -0.5);
    graph(-1.2, 1.2, move |x: f64| {
        [x * x * (4.0 * x * x - 2.0) + lean * x, 4.0 * x * (4.0 * x * x - 1.0) + lean]
    })
}

fn value(solution: &Solution<f64>, control: Control<f64>) -> Result<f64, ContactError<f64>> {
    Ok(match control {
        Control::HalfWidth(_) => solution.hull().half_width(),
        _ => solution.peak()?.pressure,
    })
}

/// Describes the fault of the answer for a value, if any, by the contacts under loads: a share
/// `aside` of that under which it jumps they are on its sides.
pub fn wrong(
    contact: &Contact<f64>,
    wanted: f64,
    control: Control<f64>,
    aside: f64,
) -> Option<String> {
    let under = |load: f64| {
        let solution = contact.solve(Control::Load(load))?;
        Ok::<_, ContactError<f64>>((value(&solution, control)?, solution.hull().half_width()))
    };
    let is_near = |one: f64, other: f64, share: f64| (one / other - 1.0).abs() <= share;
    match contact.solve(control) {
        Ok(solution) => {
            let is = value(&solution, control);
            let again = under(solution.load());
            let is_right = is.as_ref().is_ok_and(|&is| is_near(is, wanted, 1e-7))
                && again.as_ref().is_ok_and(|&(again, _)| is_near(again, wanted, 1e-6));
            (!is_right).then(|| format!("{}: {is:?}, again {again:?}", solution.load()))
        }
        // On almost flat bodies, rounded heights do not show which place touches first.
        Err(ContactError::Solve(SolveError::InJump { load, .. })) if load < 1e-13 => None,
        Err(error @ ContactError::Solve(SolveError::InJump { load, below, above, .. })) => {
            let sides = [below == 0.0, above.is_infinite()];
            let [less, more] = [1.0 - aside, 1.0 + aside].map(|times| under(times * load));
            let less = sides[0] || less.as_ref().is_ok_and(|&(less, _)| less <= wanted * 1.001);
            let more = sides[1] || more.as_ref().is_ok_and(|&(more, _)| more >= wanted / 1.001);
            (!(less && more && above > below * 1.001)).then(|| error.to_string())
        }
        Err(
            error @ ContactError::Solve(
                SolveError::HalfWidthTooLarge { load, half_width, .. }
                | SolveError::PeakTooHigh { load, half_width, .. },
            ),
        ) => {
            let widest = under(load * (1.0 - 1e-6));
            let is_right = widest.as_ref().is_ok_and(|&(most, width)| {
                most <= wanted * (1.0 + 1e-6) && is_near(width, half_width, 1e-2)
            });
            (!is_right).then(|| format!("{error}: {widest:?}"))
        }
        Err(error) => Some(error.to_string()),
    }
}

/// Values of random bodies, both of some load and arbitrary. (The seeds by number were wrong or
/// refused once: jumps unseen at a corner, flats, edges narrower than the spacing of pressure
/// samples.)
#[test]
fn random_bodies_by_half_width_and_peak() {
    let count = std::env::var("SCENES").ok().and_then(|count| count.parse().ok()).unwrap_or(60);
    let (mut faults, mut judged) = (Vec::new(), 0);
    for i in
        (0..count).chain([184, 293, 341, 478, 489, 862, 955, 1037, 1471, 1601, 1671, 2345, 4785])
    {
        let mut shares = Shares(i + 1);
        (0..3).for_each(|_| _ = shares.between(0.0, 1.0));
        let bodies = [polygon, punch, roller, wave, hills, wave];
        let body = bodies[i as usize % 6](&mut shares);
        let mut contact = Contact::new(&Flat, &*body).unwrap();
        if i % 6 == 5 {
            contact = contact.edges(Edge::FreeUntil(-1.0), Edge::FreeUntil(1.0));
        }
        let load = shares.power_of_ten(-6.0, -0.5);
        let Ok(due) = contact.solve(Control::Load(load)) else { continue };
        for (control, most) in
            [(Control::HalfWidth as fn(f64) -> _, 0.1), (Control::PeakPressure, 0.5)]
        {
            let any = shares.power_of_ten(-4.0, most);
            // A polygon has no largest pressure.
            let Ok(wanted) = value(&due, control(1.0)) else { continue };
            for wanted in [wanted, any] {
                judged += 1;
                let fault = wrong(&contact, wanted, control(wanted), 1e-5);
                faults.extend(fault.map(|fault| format!("{i} {:?}: {fault}", control(wanted))));
            }
        }
    }
    println!("{judged} values");
    assert!(faults.is_empty(), "{}:\n{}", faults.len(), faults.join("\n"));
    assert!(judged > 200, "{judged}");
}

/// Returns two powers of |x|, one on each side, half of them parabolas.
fn uneven(shares: &mut Shares) -> Profile {
    let mut side = |sign: f64| {
        let (radius, power) = (shares.power_of_ten(-2.5, 0.5), shares.between(1.2, 6.0));
        let power = if shares.between(0.0, 1.0) < 0.5 { 2.0 } else { power };
        move |x: f64| {
            let t = (sign * x / radius).max(0.0);
            [radius / power * t.powf(power), sign * t.powf(power - 1.0)]
        }
    };
    let [left, right] = [side(-1.0), side(1.0)];
    join(vec![graph(-1.0, 0.0, left), graph(0.0, 1.0, right)])
}

/// Returns a roller crowned by a logarithm, tilted.
fn crowned(shares: &mut Shares) -> Profile {
    let [tilt, depth] =
        [[-6.0, -2.0], [-5.0, -1.0]].map(|[from, to]| shares.power_of_ten(from, to));
    let flat = if shares.between(0.0, 1.0) < 0.5 { 0.0 } else { shares.between(0.1, 0.9) };
    let length = 1.0 + shares.power_of_ten(-4.0, -1.0);
    let body = move |x: f64| {
        let t = (x.abs() - flat).max(0.0) / (length - flat);
        let slope = 2.0 * depth * t / (1.0 - t * t) / (length - flat);
        [tilt * x - depth * (-t * t).ln_1p(), tilt + slope * x.signum()]
    };
    let ends = if flat > 0.0 { vec![-1.0, -flat, flat, 1.0] } else { vec![-1.0, 1.0] };
    join(ends.windows(2).map(|ends| graph(ends[0], ends[1], body)).collect())
}

/// Returns a parabola with waves of several lengths.
fn rough(shares: &mut Shares) -> Profile {
    let waves: Vec<[f64; 3]> = (0..5)
        .map(|_| {
            let wave = shares.power_of_ten(1.2, 2.3);
            let tall = shares.power_of_ten(0.0, 1.5) / (wave * wave);
            [tall, wave, shares.between(0.0, 2.0 * PI)]
        })
        .collect();
    graph(-1.0, 1.0, move |x: f64| {
        let mut at = [x * x / 2.0, x];
        for &[tall, wave, phase] in &waves {
            let (sin, cos) = (wave * x + phase).sin_cos();
            at[0] += tall * cos;
            at[1] -= tall * wave * sin;
        }
        at
    })
}

/// Each solution by load is found again by each control. (The seeds by number were refused once: a
/// first load off by 27 orders on unlike sides of the lowest gap, loads that did not close in, a
/// trial where two contacts merge.)
#[test]
fn random_solutions_are_found_again_by_each_control() {
    let count = std::env::var("SCENES").ok().and_then(|count| count.parse().ok()).unwrap_or(100);
    let steel = Material::elastic(1.0, 0.3);
    let (mut judged, mut faults) = (0, Vec::new());
    for seed in (0..count).chain([1205, 1387, 3149, 4157]) {
        let mut shares = Shares(seed + 1);
        (0..3).for_each(|_| _ = shares.between(0.0, 1.0));
        let bodies = [punch, uneven, crowned, roller, wave, hills, rough];
        let body = bodies[seed as usize % bodies.len()](&mut shares);
        let contact = Contact::new(&Flat, &*body).unwrap();
        let contact = contact.materials(steel, steel, PlaneState::Strain);
        let load = shares.power_of_ten(-6.0, -0.5);
        let Ok(due) = contact.solve(Control::Load(load)) else { continue };
        let count = due.intervals().len();
        for control in controls_of(&due) {
            judged += 1;
            match contact.solve(control) {
                Ok(found) => {
                    let off = (found.load() / load - 1.0).abs();
                    if off > 1e-6 || found.intervals().len() != count {
                        faults.push(format!("{seed} {control:?}: {load} {due} {found}"));
                    }
                }
                Err(error) => faults.push(format!("{seed} {load} {control:?}: {error}")),
            }
        }
    }
    println!("{judged} values");
    assert!(faults.is_empty(), "{}:\n{}", faults.len(), faults.join("\n"));
}

/// The loads tried for a half-width are near the one sought: not far beyond what the bodies bear.
#[test]
fn the_half_width_of_many_contacts_costs_a_few_solves() {
    let mut ratios = Vec::new();
    for seed in 0..300 {
        let mut shares = Shares(seed + 1);
        (0..3).for_each(|_| _ = shares.between(0.0, 1.0));
        let body = rough(&mut shares);
        let contact = Contact::new(&Flat, &*body).unwrap();
        let Ok(due) = contact.solve(Control::Load(shares.power_of_ten(-6.0, -0.5))) else {
            continue;
        };
        if due.intervals().len() > 4 {
            let found = contact.solve(Control::HalfWidth(due.hull().half_width())).unwrap();
            assert!((found.load() / due.load() - 1.0).abs() < 1e-9, "{seed}: {found} {due}");
            ratios.push(found.cost().samples as f64 / due.cost().samples as f64);
        }
    }
    ratios.sort_by(f64::total_cmp);
    let median = ratios[ratios.len() / 2];
    println!("{median} times the samples of a solve by load, of {}", ratios.len());
    assert!(ratios.len() > 10 && median < 8.0, "{ratios:?}");
}
