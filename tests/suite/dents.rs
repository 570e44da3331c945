//! Narrow dents and bumps inside a contact, which part it.
#![allow(missing_docs)]

use crate::common::{graph, on_flat};
use crate::random_scenes::Dice;
use linecontact::{Contact, ContactError, Control, Piecewise, SolveError};

/// Dent, or bump if the depth is negative: place, half-width and depth.
type Dent = [f64; 3];

/// Returns height and slope of a parabola with dents that do not overlap; its vertex is at
/// `centre`.
fn heights(centre: f64, mut dents: Vec<Dent>) -> impl Fn(f64) -> [f64; 2] {
    dents.sort_by(|one, other| one[0].total_cmp(&other[0]));
    move |x| {
        let x = x - centre;
        let after = dents.partition_point(|dent| dent[0] <= x);
        let beside = &dents[after.saturating_sub(1)..dents.len().min(after + 1)];
        beside.iter().fold([0.5 * x * x, x], |[y, dy], [at, width, depth]| {
            let s = (x - at) / width;
            let q = (1.0 - s * s).max(0.0);
            [y + depth * q.powi(3), dy - 6.0 * depth * s * q * q / width]
        })
    }
}

/// Returns this parabola on a flat.
fn dented(centre: f64, dents: Vec<Dent>) -> Contact<'static, f64> {
    on_flat(graph(centre - 1.0, centre + 1.0, heights(centre, dents)))
}

/// Returns the number of contacts; 0 if the scene is refused. No solution has tension or overlap.
fn contacts(contact: &Contact<'_, f64>, scene: &str) -> usize {
    let Ok(solution) = contact.solve(Control::Load(0.02)) else { return 0 };
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
        let contact = dented(0.0, vec![[at, width, depth]]);
        assert_eq!(contacts(&contact, &scene), count, "{scene}");
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
        let contact = dented(0.0, vec![[at, width, depth]]);
        let contact = if asked { contact.resolution(width) } else { contact };
        let count = contacts(&contact, &format!("{seed}: {at} {width} {depth}"));
        parted += usize::from(count > 1);
        refused += usize::from(count == 0);
    }
    println!("of 200 contacts {parted} are parted, {refused} refused");
    assert!(parted >= 147 && refused == 0, "{parted}, {refused}");
}

/// A point in the dent disturbs those that were evaluated with it.
#[test]
fn a_dent_far_from_the_origin_is_found_where_it_is() {
    for (centre, asked) in [(1629.0, 2.0), (1e5, 1.0), (1e6, 1.0)] {
        let contact = dented(centre, vec![[0.062589, 1.675e-4, 1.383e-4]]);
        let contact = contact.resolution(asked * 1.675e-4);
        let solution = contact.solve(Control::Load(0.02)).unwrap();
        assert_eq!(solution.intervals().len(), 2, "{centre}");
    }
}

/// Each is found by itself, in as many rounds as it takes.
#[test]
fn a_hundred_dents_are_found() {
    let dice = &mut Dice::new(1);
    let width = 3e-5;
    let dent =
        |i: u32| [(f64::from(i) + dice.within(0.2, 0.8)) * 3.8e-3 - 0.19, width, 1e-4 * width];
    let contact = dented(0.0, (0..100).map(dent).collect()).resolution(width);
    let solution = contact.solve(Control::Load(0.02)).unwrap();
    solution.certify().unwrap();
}

/// What only the panels have found, in the contact, takes nothing from the search outside it.
#[test]
fn a_dent_inside_leaves_a_bump_outside_to_be_found() {
    let inside = [0.1271644232660752, 0.0395174346507024, -0.0115228193512213];
    for bump in [[-0.2705, 0.003, -0.015], [-0.2835, 0.0123, -0.0154], [-0.2945, 0.017, -0.021]] {
        let solution = dented(0.0, vec![inside, bump]).solve(Control::Load(0.018)).unwrap();
        assert_eq!(solution.intervals().len(), 3, "{bump:?}");
    }
}

/// The panels of each set of contacts are probed, also after another set has been checked.
#[test]
fn a_dent_is_found_in_each_set_of_contacts() {
    let bump = [0.21067437532481167, 0.003223475910553986, -0.0006658811572233661];
    let dent = [0.04368880512183311, 0.012046298271562533, -0.0007784899279854057];
    let solution = dented(0.0, vec![bump, dent]).resolution(0.0029).solve(Control::Load(0.02));
    let solution = solution.unwrap();
    solution.certify().unwrap();
    // Found with breakpoints at the ends and the middles of both.
    let known = [-0.199914921, 0.198907445, 0.210062135, 0.210914352];
    let limits = solution.intervals().iter().flat_map(|on| [on.left, on.right]);
    assert!(limits.zip(known).all(|(limit, known)| (limit - known).abs() < 1e-9));
    assert_eq!(solution.intervals().len(), 2);
}

/// The first panels of the survey are as uncertain as the bump is high, and its points are kept for
/// the next ones.
#[test]
fn a_bump_beside_the_contact_is_seen_by_finer_panels() {
    for [at, width, height] in [
        [0.21160371965887267, 0.003425640667115573, 0.002056749524748172],
        [-0.2129862179683356, 0.0038130656446340333, 0.0026398721125417794],
    ] {
        let body = graph(-1.0, 1.0, move |x| {
            let s = (x - at) / width;
            let bell = height * (-0.5 * s * s).exp();
            [0.5 * x * x - bell, x + bell * s / width]
        });
        let solution = on_flat(body).resolution(0.008).solve(Control::Load(0.02)).unwrap();
        assert!(solution.intervals().iter().any(|on| on.contains(at)), "{at}");
        solution.certify().unwrap();
    }
}

/// Returns one to three dents and bumps, next to each other or apart, at the limits or not.
fn some_dents(dice: &mut Dice) -> Vec<Dent> {
    let count = 1 + (3.0 * dice.uniform()) as usize;
    let mut dents: Vec<Dent> = Vec::new();
    while dents.len() < count {
        let width = dice.power_of_ten(-3.3, -1.6);
        let at = dice.within(-0.26, 0.26);
        let depth = width * dice.power_of_ten(-3.0, -0.4);
        let depth = if dice.uniform() < 0.5 { -depth } else { depth };
        if dents.iter().all(|[other, reach, _]| (other - at).abs() > width + reach) {
            dents.push([at, width, depth]);
        }
    }
    dents.sort_by(|one, other| one[0].total_cmp(&other[0]));
    dents
}

/// The joints of the dents are declared in one of two bodies. Besides any seeds, 6, 194 and 972,
/// where no single contact balances; 167 and 354, where a limit leaves little of a dent in the
/// contact; 282 and 2338, where a panel ends in a bump.
#[test]
fn dents_asked_for_are_found_without_their_joints() {
    for seed in (0..12).chain([167, 194, 196, 208, 282, 354, 425, 795, 972, 2338]) {
        let dents = some_dents(&mut Dice::new(seed));
        let least = dents.iter().fold(1.0, |least: f64, dent| least.min(dent[1]));
        let mut joints = vec![-1.0];
        joints.extend(dents.iter().flat_map(|[at, width, _]| [at - width, *at, at + width]));
        joints.push(1.0);
        let piece = |pair: &[f64]| graph(pair[0], pair[1], heights(0.0, dents.clone()));
        let declared = Piecewise::new(joints.windows(2).map(piece).collect()).unwrap();
        let known =
            on_flat(Box::new(declared)).resolution(least).solve(Control::Load(0.02)).unwrap();
        let contact = dented(0.0, dents.clone()).resolution(0.9 * least);
        let solution = contact.solve(Control::Load(0.02));
        let solution = solution.unwrap_or_else(|error| panic!("{seed}: {error}"));
        let (one, other) = (known.intervals(), solution.intervals());
        assert_eq!(one.len(), other.len(), "{seed}");
        for (one, other) in one.iter().zip(other) {
            let off = (one.left - other.left).abs().max((one.right - other.right).abs());
            assert!(off < 1e-9, "{seed}: {one:?}, {other:?}");
        }
    }
}
