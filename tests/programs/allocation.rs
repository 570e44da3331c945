//! A solver that has been used before allocates nothing.
//!
//! The count is that of the whole process. The program therefore has no test harness, whose threads
//! allocate at any time.

// A program has one allocator.
use super::cam_follower::ALLOCATOR;
use linecontact::{
    Contact, Control, Curve, CurvePoint, Flat, Material, Pair, ParametricProfile, Piecewise, Pose,
    Reference, References, Solver,
};
use stats_alloc::Region;

/// Counts the allocations of some work.
fn allocations(work: impl FnOnce()) -> usize {
    let region = Region::new(ALLOCATOR);
    work();
    let change = region.change();
    change.allocations + change.reallocations
}

/// Returns a circle that rolls over x.
fn roller(x0: f64, radius: f64) -> impl ParametricProfile<f64> {
    Curve::new([-1.0, 1.0], move |k: f64| {
        let (sin, cos) = k.sin_cos();
        CurvePoint {
            x: x0 + radius * sin,
            y: radius * (1.0 - cos),
            dx: radius * cos,
            dy: radius * sin,
        }
    })
}

/// Returns a blunt wedge of three pieces: two flanks and an arc.
fn three_pieces() -> impl ParametricProfile<f64> {
    let piece = |from: f64, to: f64, bend: f64| {
        Curve::new([from, to], move |k: f64| {
            let over = k - k.clamp(-0.1, 0.1);
            CurvePoint {
                x: k,
                y: k * k / 2.0 + bend * over * over,
                dx: 1.0,
                dy: k + 2.0 * bend * over,
            }
        })
    };
    let pieces = vec![piece(-1.0, -0.1, 1.5), piece(-0.1, 0.1, 0.0), piece(0.1, 1.0, 0.7)];
    Piecewise::new(pieces).expect("the pieces meet")
}

/// Solves a scene from its two bodies, down to 101 pressures.
fn solve(
    solver: &mut Solver<f64>,
    lower: &dyn ParametricProfile<f64>,
    upper: &dyn ParametricProfile<f64>,
    load: f64,
) {
    let contact = Contact::new(lower, upper).unwrap();
    pressures(solver, &contact, load);
}

fn pressures(solver: &mut Solver<f64>, contact: &Contact<f64>, load: f64) {
    let solution = solver.solve(contact, Control::Load(load)).unwrap();
    let (on, mut pressures) = (solution.hull(), [0.0; 101]);
    let x: [f64; 101] = std::array::from_fn(|i| on.at_angle(0.02 + 0.03 * i as f64));
    let pressure = solution.pressure().unwrap();
    pressure.at_many(&x, &mut pressures).unwrap();
    assert!(pressures.iter().all(|&p| p > 0.0));
    assert!(pressure.at(on.centre()).unwrap() > 0.0);
}

pub(crate) fn main() {
    several_contacts();
    nothing_is_allocated_after_the_first_solve();
    bodies_that_move();
    if std::env::args().any(|argument| argument == "--ignored") {
        nothing_grows_over_a_million_solves();
    }
}

fn nothing_is_allocated_after_the_first_solve() {
    assert!(allocations(|| drop(std::hint::black_box(vec![1; 100]))) > 0, "the counter counts");

    let blunt = three_pieces();
    let (below, body) = (roller(0.1, -2.0), roller(0.0, 0.5));
    let contact = Contact::new(&below, &body).unwrap();
    let on_three = Contact::new(&Flat, &blunt).unwrap();
    let mut solver = Solver::new();

    // Warm-up: the largest buffers that follow.
    for load in [0.05, 0.01, 0.08] {
        pressures(&mut solver, &contact, load);
        pressures(&mut solver, &on_three, load);
    }
    let again = allocations(|| pressures(&mut solver, &contact, 0.05));
    assert_eq!(again, 0, "the scene of before");
    let next = allocations(|| {
        for load in [0.06, 0.04, 0.02, 0.05] {
            pressures(&mut solver, &contact, load);
        }
    });
    assert_eq!(next, 0, "the next load");
    let moved = allocations(|| {
        for i in 0..20 {
            let t = 0.01 * f64::from(i);
            let (lower, upper) = (roller(0.1 + t, -2.0), roller(0.5 * t, 0.5 - 0.1 * t));
            solve(&mut solver, &lower, &upper, 0.05);
        }
    });
    assert_eq!(moved, 0, "smooth bodies that move");
    let pieces = allocations(|| {
        for load in [0.06, 0.04, 0.02, 0.05] {
            solve(&mut solver, &Flat, &blunt, load);
        }
    });
    assert_eq!(pieces, 0, "a body of three pieces");
    let moved = allocations(|| {
        for i in 0..20 {
            let lower = roller(0.01 * f64::from(i), -4.0);
            solve(&mut solver, &lower, &blunt, 0.03);
        }
    });
    assert_eq!(moved, 0, "a body of three pieces on one that moves");
}

/// A pair that lifts off and touches again.
fn bodies_that_move() {
    let (plate, body) = (roller(0.0, -4.0), roller(0.0, 0.5));
    let steel = Material::elastic(2.1, 0.3);
    let length = Reference::Length(3.0);
    let to = References { x: 0.0, lower: length, upper: length };
    let mut pair = Pair::new(&plate, &body, (steel, steel), to);
    let mut run = || {
        for i in 0..40 {
            let t = 0.1 * f64::from(i);
            let (lower, y) = (Pose { x: 0.0, y: 0.0, angle: 0.0 }, 0.01 * t.sin());
            let wrench = pair.at(lower, Pose { x: 0.05 * t, y, angle: 0.02 * t });
            std::hint::black_box(wrench.unwrap());
        }
    };
    run();
    assert_eq!(allocations(run), 0, "a pair");
}

/// Nothing is allocated while the number of contacts does not change.
fn several_contacts() {
    let bumps = |reach: f64, shape: fn(f64) -> [f64; 2]| {
        Curve::new([-reach, reach], move |k: f64| {
            let [y, dy] = shape(k);
            CurvePoint { x: k, y, dx: 1.0, dy }
        })
    };
    let two = bumps(1.6, |x| [x.powi(4) - 2.0 * x * x, 4.0 * x.powi(3) - 4.0 * x]);
    // T₃²: bumps at the zeros of T₃.
    let three = bumps(1.2, |x| {
        let [t, slope] = [4.0 * x.powi(3) - 3.0 * x, 12.0 * x * x - 3.0];
        [t * t, 2.0 * t * slope]
    });
    let mut solver = Solver::new();
    for (count, body, [light, heavy]) in [(2, &two, [0.5, 2.5]), (3, &three, [0.1, 0.5])] {
        let contact = Contact::new(&Flat, body).unwrap().contact_modulus(1.0);
        // Down and up again. Every cycle has other panels than the one before; after some cycles
        // all of them fit.
        let cycle = |solver: &mut Solver<f64>, [light, heavy]: [f64; 2]| {
            for i in 0..=20 {
                let share = f64::from(10i32.abs_diff(i)) / 10.0;
                in_each(solver, &contact, light + share * (heavy - light), count);
            }
        };
        for share in [0.0, 0.01, 0.02, 0.03] {
            cycle(&mut solver, [light * (1.0 + share), heavy * (1.0 - share)]);
        }
        let next = allocations(|| cycle(&mut solver, [1.015 * light, 0.975 * heavy]));
        assert_eq!(next, 0, "{count} contacts under the next load");
    }
}

/// Solves, and evaluates pressures in each of `count` contacts.
fn in_each(solver: &mut Solver<f64>, contact: &Contact<f64>, load: f64, count: usize) {
    let solution = solver.solve(contact, Control::Load(load));
    let solution = solution.unwrap_or_else(|error| panic!("{count} contacts, F = {load}: {error}"));
    assert_eq!(solution.intervals().len(), count, "F = {load}");
    let pressure = solution.pressure().unwrap();
    for on in solution.intervals() {
        let x: [f64; 31] = std::array::from_fn(|i| on.at_angle(0.02 + 0.1 * i as f64));
        let mut pressures = [0.0; 31];
        pressure.at_many(&x, &mut pressures).unwrap();
        assert!(pressures.iter().all(|&p| p > 0.0));
    }
}

/// Memory does not grow over a million solves; takes half a minute:
/// `LINECONTACT_PROGRAM=allocation cargo test --release --test programs -- --ignored`.
fn nothing_grows_over_a_million_solves() {
    let (blunt, below) = (three_pieces(), roller(0.1, -2.0));
    let contact = Contact::new(&below, &blunt).unwrap();
    let mut solver = Solver::new();
    let load = |i: u32| Control::Load(0.01 + 1e-3 * f64::from(i.wrapping_mul(2_654_435_761) >> 26));
    for i in 0..1000 {
        solver.solve(&contact, load(i)).unwrap();
    }
    let region = Region::new(ALLOCATOR);
    for i in 0..1_000_000 {
        assert!(solver.solve(&contact, load(i)).unwrap().a() > 0.0);
    }
    let change = region.change();
    println!("{change:?}");
    assert_eq!(change.allocations + change.reallocations, 0);
    assert_eq!(change.bytes_allocated, change.bytes_deallocated);
}
