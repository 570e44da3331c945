//! Narrow dents and bumps inside a contact, which part it.
#![allow(missing_docs)]

use crate::common::{graph, on_flat};
use crate::random_scenes::Dice;
use linecontact::{Contact, ContactError, Control, SolveError};

/// Returns a parabola with a dent at a place; with a bump if the depth is negative.
fn dented(at: f64, width: f64, depth: f64) -> Contact<'static, f64> {
    on_flat(graph(-1.0, 1.0, move |x| {
        let s: f64 = (x - at) / width;
        let q = (1.0 - s * s).max(0.0);
        [0.5 * x * x + depth * q.powi(3), x - 6.0 * depth * s * q * q / width]
    }))
}

/// Returns the number of contacts; 0 if the scene is refused. No solution has tension or overlap.
fn contacts(contact: &Contact<'_, f64>, scene: &str) -> usize {
    let solution = match contact.solve(Control::Load(0.02)) {
        Ok(s) => s,
        Err(e) => {
            println!("{scene}: refused {e}");
            return 0;
        }
    };
    if let Err(ContactError::Solve(fault)) = solution.certify() {
        // No point of either body shows a dent between the probes.
        assert!(matches!(fault, SolveError::FeatureMissed { .. }), "{scene}: {fault}");
        println!("{scene} is missed");
    }
    solution.intervals().len()
}

#[test]
fn a_narrow_dent_parts_a_contact() {
    for (at, width, depth, count) in [
        (0.05, 0.01, 0.005, 2),
        (0.05, 0.02, 0.005, 2),
        (0.04, 0.02, 0.01, 2),
        (0.05, 0.01, -0.005, 3),
    ] {
        let scene = format!("{at} {width} {depth}");
        assert_eq!(contacts(&dented(at, width, depth), &scene), count, "{scene}");
    }
}

/// From 2.5 to 12 % of the contact, and narrower where a resolution asks for it.
#[test]
fn a_dent_that_is_seen_leaves_no_tension() {
    let [mut parted, mut refused] = [0; 2];
    for seed in 0..200 {
        let dice = &mut Dice::new(seed);
        let asked = seed % 2 == 0;
        let width = if asked { dice.power_of_ten(-3.3, -2.0) } else { dice.within(0.01, 0.05) };
        let (depth, at) = (width * dice.within(-0.5, 0.5), dice.within(-0.18, 0.18));
        let contact = dented(at, width, depth);
        let contact = if asked { contact.resolution(width) } else { contact };
        let count = contacts(&contact, &format!("{seed}: {at} {width} {depth}"));
        parted += usize::from(count > 1);
        refused += usize::from(count == 0);
    }
    println!("of 200 contacts {parted} are parted, {refused} refused");
    assert!(parted >= 142 && refused <= 4, "{parted}, {refused}");
}
