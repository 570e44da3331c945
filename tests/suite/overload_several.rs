//! Capacity of bodies with several contacts: independent of the prescribed quantity.
#![allow(missing_docs)]

use crate::common;
use common::{Counting, Profile, Shares, graph, quartic};
use linecontact::{Contact, ContactError, Control, Edge, Flat, SolveError};
use std::f64::consts::PI;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Returns load, half-width, peak and end from the error of an overload.
fn bears(contact: &Contact<f64>, load: f64) -> [f64; 4] {
    match contact.solve(Control::Load(load)).map(|solution| solution.intervals().to_vec()) {
        Err(ContactError::Solve(SolveError::DomainTooShort {
            carried,
            half_width,
            peak,
            end,
            load: asked,
            ..
        })) => {
            assert_eq!(asked, load);
            [carried, half_width, peak, end]
        }
        other => panic!("{load}: {other:?}"),
    }
}

/// With E* = 1 contacts up to c² = 1 + d/2, d = sqrt(4F/π), and P = 2 x sqrt((x² - α²)(β² - x²)).
#[test]
fn two_contacts_bear_what_the_closed_form_says() {
    for c in [1.05f64, 1.2, 1.4] {
        for [from, to] in [[-c, c], [-c, 1.5], [-1.5, c]] {
            let body = quartic(from, to);
            let contact = Contact::new(&Flat, &*body).unwrap().kappa(PI / 2.0);
            let d = 2.0 * (c * c - 1.0);
            let load = PI * d * d / 4.0;
            let p = |v: f64| 2.0 * v.sqrt() * ((d / 2.0).powi(2) - (v - 1.0).powi(2)).sqrt();
            // 3 v² - 4 v + 1 = d²/4 at the maximum of v P².
            let v = (4.0 + (4.0 + 3.0 * d * d).sqrt()) / 6.0;
            let due = [load, c, p(v), if from == -c { -c } else { c }];
            for times in [1.0 + 1e-9, 1.1, 3.0, 1e3, 1e9] {
                let found = bears(&contact, times * load);
                for (found, due) in found.into_iter().zip(due) {
                    let is_end = due.abs() == c && [from, to] == [-c, c];
                    let off = if is_end { found.abs() - c } else { found - due };
                    assert!(off.abs() <= 1e-9 * due.abs(), "{c} {times}: {found} for {due}");
                }
            }
            let under = contact.solve(Control::Load(load * (1.0 - 1e-9))).unwrap();
            assert_eq!(under.intervals().len(), 2);
        }
    }
}

struct Scene {
    name: &'static str,
    body: Profile,
    edges: [Edge<f64>; 2],
    contacts: usize,
}

fn wavy(amplitude: f64, wave: f64, [from, to]: [f64; 2]) -> Profile {
    graph(from, to, move |x: f64| {
        [
            x * x / 2.0 + amplitude * (wave * x + 0.4).cos(),
            x - amplitude * wave * (wave * x + 0.4).sin(),
        ]
    })
}

fn scenes() -> Vec<Scene> {
    let free = [Edge::Free; 2];
    vec![
        Scene { name: "quartic", body: quartic(-1.5, 1.2), edges: free, contacts: 2 },
        Scene { name: "wavy", body: wavy(0.02, 20.0, [-0.5, 0.45]), edges: free, contacts: 4 },
        Scene { name: "more", body: wavy(0.02, 40.0, [-0.45, 0.7]), edges: free, contacts: 7 },
        Scene { name: "flatter", body: wavy(3e-4, 40.0, [-0.5, 0.7]), edges: free, contacts: 1 },
        Scene {
            name: "corner",
            body: quartic(-1.1, 1.3),
            edges: [Edge::FreeUntil(-1.1), Edge::Free],
            contacts: 2,
        },
        Scene {
            name: "merged",
            body: quartic(-1.1, 1.6),
            edges: [Edge::FreeUntil(-1.1), Edge::Free],
            contacts: 1,
        },
    ]
}

#[test]
fn several_contacts_bear_the_same_whatever_is_asked_and_the_error_is_cheap() {
    let mut faults = Vec::new();
    for Scene { name, body, edges, contacts } in scenes() {
        let body = Counting(body, &AtomicUsize::new(0));
        let contact = Contact::new(&Flat, &body).unwrap().edges(edges[0], edges[1]);
        let first = bears(&contact, 1e3);
        let [load, half_width, peak, end] = first;
        // The load is sharp: slightly less has a contact that almost reaches the end.
        body.1.store(0, Ordering::Relaxed);
        let half = contact.solve(Control::Load(load / 2.0)).unwrap();
        let at_half = body.1.load(Ordering::Relaxed);
        drop(half);
        let under = contact.solve(Control::Load(load * (1.0 - 1e-9))).unwrap();
        println!("{name}: {first:?}, {:?}", under.intervals());
        let limit = if end < 0.0 { under.hull().left } else { under.hull().right };
        if under.intervals().len() != contacts
            || (limit - end).abs() > 1e-6
            || (under.hull().half_width() - half_width).abs() > 1e-6
            || peak.is_finite() && (under.peak().unwrap().pressure - peak).abs() > 1e-6 * peak
        {
            faults.push(format!("{name}: {first:?} {:?}", under.intervals()));
        }
        for times in [1.0 + 1e-6, 1.1, 1.6, 3.0, 10.0, 1e3, 1e6, 1e13] {
            body.1.store(0, Ordering::Relaxed);
            let again = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| {
                bears(&contact, times * load)
            }));
            let taken = body.1.load(Ordering::Relaxed);
            println!("  {times:e}: {taken} evaluations, {at_half} at half of it");
            let is_same = |again: [f64; 4]| {
                again.iter().zip(first).all(|(a, b)| *a == b || (a / b - 1.0).abs() < 1e-9)
            };
            if !again.is_ok_and(is_same) || taken > 20 * at_half {
                faults.push(format!("{name} {times:e}: {taken} of {at_half}"));
            }
        }
    }
    assert!(faults.is_empty(), "{}:\n{}", faults.len(), faults.join("\n"));
}

/// Returns bodies of waves or with two valleys, with and without a corner, and turned by a load on
/// a given line.
fn random_scene(i: usize, shares: &mut Shares) -> ([f64; 2], Profile, Option<f64>) {
    let mut random = |from: f64, to: f64| shares.between(from, to);
    let [tall, wave, phase] = [random(0.1, 1.0), random(6.0, 30.0), random(0.0, 6.0)];
    let [from, to] = [random(-1.0, -0.3), random(0.3, 1.0)];
    let at = from + (to - from) * random(0.1, 0.9);
    let (tall, lean) = (if i % 5 == 1 { 0.02 * tall } else { tall }, random(-0.3, 0.3));
    let body = if i % 5 == 2 {
        graph(from, to, move |x: f64| {
            [x * x * (4.0 * x * x - 2.0) + lean * x, 4.0 * x * (4.0 * x * x - 1.0) + lean]
        })
    } else {
        graph(from, to, move |x: f64| {
            let angle = wave * x + phase;
            [x * x / 2.0 + tall / wave * angle.cos(), x - tall * angle.sin()]
        })
    };
    ([from, to], body, (i % 5 == 4).then_some(at))
}

/// Overloaded bodies: the capacity named by the error is carried, and closes the gap at an end; a
/// slightly larger load is refused with the same capacity.
#[test]
fn random_bodies_bear_what_the_error_says() {
    let count = std::env::var("SCENES").ok().and_then(|count| count.parse().ok()).unwrap_or(150);
    let (mut shares, mut several, mut touching, mut nothing) = (Shares(1), 0, 0, 0);
    let (mut faults, mut dearest) = (Vec::new(), [0.0f64; 2]);
    for i in 0..count {
        let ([from, to], body, at) = random_scene(i, &mut shares);
        let body = Counting(body, &AtomicUsize::new(0));
        let mut contact = Contact::new(&Flat, &body).unwrap();
        if i % 5 == 3 {
            contact = contact.edges(Edge::FreeUntil(from), Edge::Free);
        }
        let asked = 10f64.powf(shares.between(0.5, 4.0));
        let solve = |load: f64| match at {
            Some(at) => contact.solve(Control::CentreOfPressure { load, at }),
            None => contact.solve(Control::Load(load)),
        };
        let carried = match solve(asked).map(|_| ()) {
            Err(ContactError::Solve(SolveError::DomainTooShort { carried, end, .. }))
                if end == from || end == to =>
            {
                carried
            }
            // The slopes show that an end is the lowest place.
            Err(ContactError::Solve(SolveError::NoFirstContact { .. })) if at.is_none() => 0.0,
            other => {
                faults.push(format!("{i}: {other:?}"));
                continue;
            }
        };
        let taken = body.1.swap(0, Ordering::Relaxed);
        if carried == 0.0 {
            nothing += 1;
            if let Ok(solution) = solve(1e-6) {
                faults.push(format!("{i}: {:?} under 1e-6", solution.intervals()));
            }
            continue;
        }
        let under = match solve(carried * (1.0 - 1e-6)) {
            Ok(under) => under,
            Err(error) => {
                faults.push(format!("{i}: {carried}: {error}"));
                continue;
            }
        };
        let dearer = taken as f64 / body.1.load(Ordering::Relaxed).max(100) as f64;
        let kind = &mut dearest[usize::from(at.is_some())];
        *kind = kind.max(dearer);
        let room = [from, to].map(|end| under.gap_at(end).unwrap_or(0.0));
        if room[0].min(room[1]).abs() > 1e-4 * carried {
            faults.push(format!("{i}: {carried} leaves {room:?}"));
        }
        let on = under.hull();
        touching += usize::from((on.left - from).min(to - on.right) > 0.01);
        several += usize::from(under.intervals().len() > 1);
        match solve(carried * 1.001).map(|_| ()) {
            Err(ContactError::Solve(SolveError::DomainTooShort { carried: again, .. }))
                if (again / carried - 1.0).abs() < 1e-9 => {}
            // At that place at most its capacity.
            Err(ContactError::Solve(SolveError::TiltNotFound { .. })) if at.is_some() => {}
            other => faults.push(format!("{i}: more than {carried}: {other:?}")),
        }
    }
    println!(
        "{several} by several contacts, {touching} until an end touches, {nothing} nothing; {dearest:?}"
    );
    assert!(faults.is_empty(), "{}:\n{}", faults.len(), faults.join("\n"));
    assert!(several >= 30 && touching >= 20 && nothing >= 5, "{several} {touching} {nothing}");
    // Evaluations, as shares of those of a solve, or of 100 if it takes less.
    assert!(dearest[0] <= 50.0 && dearest[1] <= 34.0, "{dearest:?}");
}
