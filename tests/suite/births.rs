//! Contacts about to be born at a corner, or to merge at a hollow one.
#![allow(missing_docs)]

use crate::common::{Shares, on_flat};
use crate::corners::polygon;
use linecontact::profile::{Ellipse, Outline, Placed, Placement};
use linecontact::{Contact, ContactError, Control, SolveError};
use std::f64::consts::PI;

/// Between contacts that a load has all but merged, at a hollow corner, the gap is known to
/// rounding, as are the pressures beside it.
#[test]
fn a_gap_about_to_close_takes_no_more_integrals() {
    let third = 1.0 / 3.0;
    let lower = [[-1.0, -0.3], [-0.6, -0.03], [-0.2, -0.07], [0.2, -0.06], [0.6, -0.09]];
    let upper = [[-1.0, 0.22], [-2.0 * third, 0.08], [-third, 0.08], [0.0, 0.03], [third, 0.06]];
    let lower = polygon(&[&lower[..], &[[1.0, -0.29]]].concat());
    let upper = polygon(&[&upper[..], &[[2.0 * third, 0.08], [1.0, 0.25]]].concat());
    let contact = Contact::new(&*lower, &*upper).unwrap().contact_modulus(0.5);
    for load in [0.1, 0.11, 0.112] {
        let solution = contact.solve(Control::Load(load)).unwrap();
        let gap = solution.intervals()[2].right;
        let width = solution.intervals()[3].left - gap;
        assert!(width > 0.0 && width < 1e-9 && (gap - third).abs() < width, "{load}: {width}");
        // It gives up after 20 000 panels.
        let open = solution.gap_at(third).unwrap();
        assert!(open.abs() < 1e-12, "{load}: {open}");
    }
}

/// A contact is born at a corner 2 from a wedge under a load that puts the gap there to zero: under
/// no more, and no less.
#[test]
fn a_contact_is_born_where_the_gap_closes() {
    let load = 1e-3;
    for (m, low) in [(0.1, 6.5387e-3), (0.01, 4.2364e-3)] {
        let points = [[-5.0, 5.0 * m], [0.0, 0.0], [1.0, m], [2.0, low], [5.0, low + 3.0 * m]];
        let contact = on_flat(polygon(&points));
        let mut counts = Vec::new();
        for i in -20..=20 {
            let solution =
                contact.solve(Control::Load(load * (1.0 + 1e-4 * f64::from(i)))).unwrap();
            counts.push(solution.intervals().len());
            assert!(solution.certify().unwrap().is_proved(), "{i}: {solution}");
            let open = solution.gap_at(2.0).unwrap_or(0.0);
            assert!(open >= -1e-10 * load, "{i}: {open}");
        }
        counts.dedup();
        assert_eq!(counts, [1, 2], "{load}");
    }
}

/// The contacts do not depend on the unit of length: the left one bears 3 % and more.
#[test]
fn a_pad_has_the_same_contacts_in_any_unit() {
    let mut last = None;
    for unit in [3e-7, 0.3, 300.0, 3e5, 3e11] {
        let points = [[-4.9, 0.12], [-0.9, 0.0], [0.0, 0.0], [0.85, -0.0017], [4.85, 0.1183]];
        let contact = on_flat(polygon(&points.map(|point| point.map(|x| x * unit))));
        let shares = [4.7e-4, 5.2e-4, 5.5e-4];
        let found = shares.map(|share| contact.solve(Control::Load(share * unit)).unwrap());
        let centres = found.map(|found| found.centre_of_pressure().unwrap() / unit);
        let before = *last.get_or_insert(centres);
        let off = |i: usize| (centres[i] - before[i]).abs();
        assert!((0..3).all(|i| off(i) < 1e-9), "{unit}: {centres:?} {before:?}");
    }
}

/// A level land beside a ramp: the certificate follows the gap over it, too.
#[test]
fn a_gap_beside_a_level_land_is_certified() {
    for load in [0.01, 0.02, 0.03] {
        let points = [[0.0, 1e-2], [1e-6, 0.0], [1.0, 0.02], [1.5, 0.02], [4.5, 0.32]];
        let contact = on_flat(polygon(&points));
        let solution = contact.solve(Control::Load(load)).unwrap();
        assert!(solution.intervals().len() == 2 && solution.gap_at(1.0).unwrap() > 0.0);
        assert!(solution.certify().unwrap().is_proved(), "{load}: {solution}");
    }
}

/// A contact at a corner is found down to the last bit of the height at which it is born, or x is
/// too coarse to tell it.
#[test]
fn a_contact_is_found_however_narrow() {
    let (m, load) = (4.5e-4, 5.6e-8);
    let (mut low, mut high) = (10.74, 10.75);
    for _ in 0..50 {
        let height = 0.5 * (low + high);
        let points = [[-5.0, 5.0 * m], [0.0, 0.0], [0.835, m * 0.835], [1.67, height * load]];
        let end = [[5.0, height * load + m * 3.33]];
        let contact = on_flat(polygon(&[&points[..], &end].concat()));
        let solution = contact.solve(Control::Load(load)).unwrap();
        let is_born = solution.intervals().len() == 2;
        *(if is_born { &mut low } else { &mut high }) = height;
    }
    assert!((low - 10.746_039_27).abs() < 1e-8, "{low}");
}

/// A land beside a wedge touches by one corner first, and bears less than the wedge: its corner is
/// sharp to it.
#[test]
fn a_land_that_bears_little_is_held_at_its_corner() {
    for load in [7.5e-5, 1e-5] {
        let mut counts = Vec::new();
        for i in 0..60 {
            let d = (3.0 + 11.0 * f64::from(i) / 60.0) * load;
            let wedge = [[-5.0, 0.015], [0.0, 0.0], [1.0, 0.0018]];
            let land = [[1.4, d], [1.6, d], [3.6, d + 0.006]];
            let contact = on_flat(polygon(&[wedge, land].concat()));
            counts.push(contact.solve(Control::Load(load)).unwrap().intervals().len());
        }
        counts.dedup();
        assert_eq!(counts, [2, 1], "{load}");
    }
}

/// A narrow land behind a hollow corner, and a wide contact before it: no limit of the wide one is
/// held at the corner of the land.
#[test]
fn narrow_lands_behind_hollow_corners() {
    for width in [0.3, 0.1, 0.03, 0.01] {
        let half = Outline::from([0.0; 2]).line(1.0).corner(0.02).line(0.7).corner(0.0).line(width);
        let body = half.corner(1e4).line(1e-6).mirrored().build().unwrap();
        let contact = on_flat(Box::new(body));
        for load in [0.02, 0.03, 0.04] {
            let solution = contact.solve(Control::Load(load)).unwrap();
            assert!(solution.certify().unwrap().is_proved(), "{width} {load}: {solution}");
        }
    }
}

/// A roller on the edge of a step, far from the ground below it, under loads for which no cells are
/// small enough: a wedge between the wall and the tangent of the roller.
#[test]
fn a_roller_rests_on_the_edge_of_a_step() {
    let radius = 20.0;
    let roller = Ellipse::circle(radius, [-1.0, 1.0]).unwrap();
    let roller = Placed::new(roller, Placement::default().shifted(-1.2, 0.0)).unwrap();
    for wall in [1.0f64, 100.0, 1e6] {
        let ground = Outline::from([-5.0, -0.5]).line(4.8).corner(wall).line(0.5 / wall);
        let step = ground.corner(0.0).line(3.0).build().unwrap();
        let contact = Contact::new(&step, &roller).unwrap().contact_modulus(115e3);
        let corner = -0.2 + 0.5 / wall;
        let aside = corner + 1.2;
        let slope = aside / (radius * radius - aside * aside).sqrt();
        for i in 0..24 {
            let load = 10f64.powf(-5.0 + 0.25 * f64::from(i));
            let solution = contact.solve(Control::Load(load)).unwrap();
            let [on] = *solution.intervals() else { panic!("{wall} {load}: {solution}") };
            assert!(on.left <= corner && corner < on.right, "{wall} {load}: {solution}");
            // At the corner θ is π times the share of the flatter side in the angle.
            let share = 0.5 * (1.0 - (PI * slope / wall).cos());
            let found = (corner - on.left) / (on.right - on.left);
            // Of x, a sum of lengths up to 5.
            let rounding = 20.0 * f64::EPSILON / (on.right - on.left);
            assert!(
                wall > 1.0 || load > 1e-2 || (found - share).abs() < 0.01 * share + rounding,
                "{wall} {load}"
            );
        }
    }
}

/// Half of a random outline: lines and arcs, with corners of either sign.
fn half(random: &mut Shares) -> Outline<f64> {
    let (mut drawn, mut slope) = (Outline::from([0.0; 2]), 0.0);
    for i in 0..random.between(2.0, 6.0) as usize {
        if i > 0 && random.between(0.0, 1.0) < 0.6 {
            slope += random.normal() * random.power_of_ten(-4.0, -1.5);
            drawn = drawn.corner(slope);
        }
        let length = random.between(0.1, 1.0);
        let [line, hollow] = [0.5, 0.25].map(|share| random.between(0.0, 1.0) < share);
        let radius = random.power_of_ten(1.3, 3.5) * if hollow { -1.0 } else { 1.0 };
        drawn = if line { drawn.line(length) } else { drawn.arc(radius, length) };
        slope += if line { 0.0 } else { length / radius };
    }
    drawn.corner(slope.max(0.0) + 0.03).line(4.0)
}

/// Bodies drawn with arcs, whose contacts were missed next to limits: behind a hollow corner, and
/// at a corner with a curved flank on one side.
#[test]
fn drawn_bodies_have_all_their_contacts() {
    let from = || Outline::from([0.0; 2]);
    let right = from().arc(1669.2388696217415, 0.12147401992094332).corner(0.0);
    let right = right.arc(404.5878249504983, 0.35173157265730937).corner(0.008163575460616936);
    let right = right.arc(27.180985061400907, 0.5732076056981326).corner(0.003707041656956522);
    let right = right.line(0.3700477608646358).corner(0.003403023125338611);
    let right = right.arc(-70.26227202667825, 0.967933050449561).corner(0.03846276502308547);
    let left = from().arc(966.7186145082451, 0.7664456245880891).corner(0.006684120463740123);
    let left = left.line(0.0777118743782497).corner(0.034645896295178856);
    let hollow = right.line(4.0).left(left.line(4.0));
    let right = from().arc(2247.2833411030156, 0.3247622731585698).corner(-0.0017444941594612646);
    let right = right.line(0.8515812907125168).corner(0.03);
    let left = from().arc(150.54158251069805, 0.16622295207793109).corner(-0.02164404820200118);
    let left = left.arc(471.31848758150744, 0.4558887608787793).corner(-0.023846603992818394);
    let left = left.arc(113.99998744964195, 0.2746689929037843).corner(0.03);
    let curved = right.line(4.0).left(left.line(4.0));
    let cases = [
        (hollow, [0.017_450_506, 0.017_626_773_835_670_04]),
        (curved, [0.010_266_898_495_162_057, 0.010_267_576_317_353_196]),
    ];
    for (outline, loads) in cases {
        let contact = on_flat(Box::new(outline.build().unwrap()));
        for load in loads {
            let solution = contact.solve(Control::Load(load)).unwrap();
            assert!(solution.certify().is_ok(), "{load}: {solution}");
        }
    }
}

/// Loads next to those at which contacts are born or merge, at corners of either sign: the
/// certificate accuses none. `SCENES=n` in the environment sets the number of bodies, in place of
/// some that were accused or refused.
#[test]
fn loads_beside_births() {
    let scenes = std::env::var("SCENES").ok().and_then(|count| count.parse().ok());
    let seeds: Vec<u64> =
        scenes.map_or(vec![18, 26, 38, 66, 129, 248, 263], |count: u64| (0..count).collect());
    let (mut solved, mut accused, mut refused) = (0, Vec::new(), Vec::new());
    for seed in seeds {
        let mut random = Shares(seed);
        random.between(0.0, 1.0);
        let [left, right] = [(); 2].map(|()| half(&mut random));
        let contact = on_flat(Box::new(right.left(left).build().unwrap()));
        let lightest = random.power_of_ten(-4.5, -1.5);
        let mut count = |load: f64| {
            let solution = match contact.solve(Control::Load(load)) {
                Ok(solution) => solution,
                Err(ContactError::Solve(SolveError::DomainTooShort { .. })) => return None,
                Err(error) => {
                    refused.push(format!("{seed} {load:e}: {error}"));
                    return None;
                }
            };
            solved += 1;
            match solution.certify() {
                // A gap as narrow as x is known.
                Ok(_) | Err(ContactError::Solve(SolveError::Undecided { .. })) => {}
                Err(error) => accused.push(format!("{seed} {load:e}: {error}")),
            }
            Some(solution.intervals().len())
        };
        let loads: [_; 8] = std::array::from_fn(|i| lightest * 10f64.powf(i as f64 / 7.0));
        let counts = loads.map(&mut count);
        for i in 0..7 {
            let [mut low, mut high] = [loads[i], loads[i + 1]];
            let Some((few, other)) = counts[i].zip(counts[i + 1]) else { continue };
            for _ in 0..if few == other { 0 } else { 14 } {
                let load = 0.5 * (low + high);
                let Some(found) = count(load) else { break };
                *(if found == few { &mut low } else { &mut high }) = load;
            }
        }
    }
    println!("{solved} solved, {} accused, {} refused", accused.len(), refused.len());
    let all = [accused, refused].concat();
    assert!(all.is_empty(), "{}", all.join("\n"));
}
