//! Half-widths of lands: what lies in a jump, at a corner, or beyond one.
#![allow(missing_docs)]

use crate::common::{Profile, Shares, on_flat};
use crate::controls::wrong;
use crate::corners::polygon;
use linecontact::profile::Outline;
use linecontact::{Contact, ContactError, Control, Flat, SolveError};

/// Returns lands from -1 to 1 of equal slopes beside each, with the heights given.
fn lands(ends: &[[f64; 2]], heights: &[f64], wall: f64, depth: f64) -> Profile {
    let run = depth / wall;
    let mut points = Vec::new();
    for (&[left, right], &height) in ends.iter().zip(heights) {
        points.extend([[left - run, height + depth], [left, height], [right, height]]);
        points.push([right + run, height + depth]);
    }
    polygon(&points)
}

/// Finds the load of a half-width, or the error.
fn load(contact: &Contact<f64>, half_width: f64) -> Result<f64, SolveError<f64>> {
    match contact.solve(Control::HalfWidth(half_width)) {
        Ok(solution) => Ok(solution.load()),
        Err(ContactError::Solve(error)) => Err(error),
        Err(error) => panic!("{half_width}: {error}"),
    }
}

fn in_jump(found: Result<f64, SolveError<f64>>, sides: [f64; 2]) {
    let Err(SolveError::InJump { below, above, .. }) = found else { panic!("{found:?}") };
    assert!((below - sides[0]).abs() < 1e-5 && (above - sides[1]).abs() < 1e-5, "{found:?}");
}

/// Under the lightest load a land is as wide as it will be, to rounding, and beside a corner j a
/// contact ends d = (F/(2 j))²/(2 L) beyond it.
#[test]
fn of_one_land() {
    let body = lands(&[[-1.0, 1.0]], &[0.0], 0.1, 0.1);
    let contact = on_flat(body);
    for half_width in [0.1, 0.5, 0.9, 0.99] {
        in_jump(load(&contact, half_width), [0.0, 1.0]);
    }
    let found = load(&contact, 1.0);
    let Err(SolveError::LoadUnknown { load: light, .. }) = found else { panic!("{found:?}") };
    assert!(light < 1e-6, "{light}");
    for (half_width, due) in [(1.000_000_1, 2.847_050e-5), (1.01, 9.025_643e-3)] {
        assert!((load(&contact, half_width).unwrap() / due - 1.0).abs() < 1e-6);
    }
}

#[test]
fn of_three_lands() {
    let ends = [[-0.9, -0.5], [-0.1, 0.1], [0.5, 0.9]];
    let body = lands(&ends, &[0.0; 3], 10.0, 0.1);
    let contact = on_flat(body);
    for half_width in [0.3, 0.8] {
        in_jump(load(&contact, half_width), [0.0, 0.9]);
    }
    let found = load(&contact, 0.9);
    assert!(matches!(found, Err(SolveError::LoadUnknown { .. })), "{found:?}");
    // Also from a warm start, and where the contact ends next to the corner.
    for due in [1e-6, 1e-4, 1e-2, 1e-1] {
        let half_width = contact.solve(Control::Load(due)).unwrap().hull().half_width();
        match load(&contact, half_width) {
            Ok(load) => assert!((load / due - 1.0).abs() < 1e-6, "{due}: {load}"),
            Err(SolveError::LoadUnknown { .. }) => assert!(half_width < 0.9 + 1e-14, "{due}"),
            Err(error) => panic!("{due}: {error}"),
        }
    }
    // The land in the middle touches first.
    let body = lands(&ends, &[0.0, -0.01, 0.0], 10.0, 0.1);
    let contact = on_flat(body);
    in_jump(load(&contact, 0.05), [0.0, 0.1]);
    assert!(matches!(load(&contact, 0.1), Err(SolveError::LoadUnknown { .. })));
    for half_width in [0.1001, 0.2, 0.5] {
        in_jump(load(&contact, half_width), [0.1, 0.9]);
    }
}

/// Returns one to four random lands, their half-width, and the shares left.
fn random(seed: u64) -> (Profile, f64, Shares) {
    let mut shares = Shares(seed + 1);
    (0..3).for_each(|_| _ = shares.between(0.0, 1.0));
    let number = 1 + shares.between(0.0, 3.99) as usize;
    let (wall, depth) = (shares.power_of_ten(-1.0, 2.0), shares.power_of_ten(-2.0, -1.0));
    let step = depth / wall * 2.2 + shares.between(0.05, 0.3);
    let mut ends: Vec<[f64; 2]> = Vec::new();
    let mut x = -1.0;
    for _ in 0..number {
        let width = shares.between(0.1, 0.6);
        ends.push([x, x + width]);
        x += width + step;
    }
    let high =
        shares.power_of_ten(-6.0, -2.0) * if shares.between(0.0, 1.0) < 0.5 { 0.0 } else { 1.0 };
    let heights: Vec<f64> = (0..number).map(|_| high * shares.between(0.0, 1.0)).collect();
    (lands(&ends, &heights, wall, depth), 0.5 * (ends[number - 1][1] + 1.0), shares)
}

/// Random lands, by half-widths at random, by that of all lands and by those of a load. (The seeds
/// by number were refused once.)
#[test]
fn of_random_lands() {
    let count = std::env::var("SCENES").ok().and_then(|count| count.parse().ok()).unwrap_or(10);
    let (mut faults, mut judged) = (Vec::new(), 0);
    for seed in (0..count).chain([17, 26, 36]) {
        let (body, reach, mut shares) = random(seed);
        let contact = on_flat(body);
        let under = contact.solve(Control::Load(shares.power_of_ten(-7.0, -1.0)));
        let under = under.map(|solution| solution.hull().half_width());
        let random = [shares.between(0.1, 1.3), shares.between(0.9, 1.01)].map(|by| by * reach);
        for wanted in random.into_iter().chain([reach]).chain(under.ok()) {
            judged += 1;
            match contact.solve(Control::HalfWidth(wanted)) {
                Err(ContactError::Solve(SolveError::LoadUnknown { load, .. })) => {
                    // A corner holds a limit up to a distance of about 1e-8 of the contact.
                    let [again, more] = [1.0, 1.1].map(|times| {
                        let under = contact.solve(Control::Load(times * load)).unwrap();
                        (under.hull().half_width() / wanted - 1.0).abs()
                    });
                    if again.max(more) > 3e-8 {
                        faults.push(format!("{seed} {wanted}: {load} {again} {more}"));
                    }
                }
                _ => {
                    // A contact born at a corner is seen once it bears some 1e-5 of the load.
                    let fault = wrong(&contact, wanted, Control::HalfWidth(wanted), 3e-4);
                    faults.extend(fault.map(|fault| format!("{seed} {wanted}: {fault}")));
                }
            }
        }
    }
    println!("{judged} values");
    assert!(faults.is_empty(), "{}:\n{}", faults.len(), faults.join("\n"));
}

/// The width of many lands with upright walls and narrow slits does not tell their load, and says
/// so: a first load that is far too large is no failure.
#[test]
fn of_many_lands_between_upright_walls() {
    for seed in 0..20 {
        let mut shares = Shares(seed + 1);
        (0..3).for_each(|_| _ = shares.between(0.0, 1.0));
        let (count, depth) =
            (1 + shares.between(0.0, 19.9) as usize, shares.power_of_ten(-3.0, 0.0));
        let mut half = Outline::from([-1.0, depth]).line(1.0);
        let mut width = 0.0;
        for _ in 0..count {
            let [land, slit] = [shares.power_of_ten(-3.5, 0.0), shares.power_of_ten(-4.0, -0.3)];
            half = half.wall(-depth).line(land).wall(depth).line(slit);
            width += land + slit;
        }
        let body = half.line(1.0).build().unwrap();
        let contact = Contact::new(&Flat, &body).unwrap().contact_modulus(115e3);
        for share in [1e-6, 1e-3, 1.0] {
            let solution = contact.solve(Control::Load(share * width * depth)).unwrap();
            let half_width = solution.hull().half_width();
            let found = load(&contact, half_width);
            assert!(
                matches!(found, Err(SolveError::LoadUnknown { .. })),
                "{seed} {share}: {found:?}"
            );
        }
    }
}
