//! Cells against closed forms, and what they refuse.

use super::*;
use crate::{ContactError, Side, SolveError};
use std::f64::consts::{FRAC_PI_2, PI};

fn scene(load: f64, range: [f64; 2]) -> Scene<'static, f64> {
    let cells = FIRST_CELLS;
    let kappa = FRAC_PI_2;
    let watch = &|| Ok(());
    Scene { kappa, load, at: None, range, cells, known: &[], start: &[], kernel: None, watch }
}

fn set<'s>(
    scene: &Scene<'s, f64>,
    h: impl Fn(f64) -> f64,
) -> Result<ActiveSet<'s, f64>, NotFound<f64>> {
    let mut set = ActiveSet::new(scene, &mut |x| Ok(h(x)))?;
    set.settle(scene, &mut |x| Ok(h(x))).map(|()| set)
}

fn find(scene: &Scene<'_, f64>, h: impl Fn(f64) -> f64) -> Result<Coarse<f64>, NotFound<f64>> {
    Ok(set(scene, h)?.found())
}

/// Returns the contacts found on many equal cells.
fn even(scene: &Scene<'_, f64>, cells: usize, h: impl Fn(f64) -> f64) -> Coarse<f64> {
    let scene = Scene { cells, known: &[], start: &[], ..*scene };
    let mut set = ActiveSet::new(&scene, &mut |x| Ok(h(x))).unwrap();
    set.converge(&scene).unwrap();
    set.found()
}

fn heights(n: usize, [from, to]: [f64; 2], h: impl Fn(f64) -> f64) -> Vec<[f64; 2]> {
    let x = |i| from + (to - from) * f64::from(i) / (n - 1) as f64;
    (0..n as i32).map(|i| [x(i), h(x(i))]).collect()
}

/// A load needs a loaded cell, even if the bodies do not turn.
#[test]
fn no_cell_bears_no_load() {
    let mut set = set(&scene(0.1, [-2.0, 2.0]), |x| 0.5 * x * x).unwrap();
    assert!(set.bears());
    set.cells.iter_mut().for_each(|cell| cell.loaded = false);
    assert!(!set.bears());
}

/// Returns the largest error of the limits, as a share of the width.
fn off(on: Interval<f64>, exact: Interval<f64>) -> f64 {
    let width = exact.right - exact.left;
    (on.left - exact.left).abs().max((on.right - exact.right).abs()) / width
}

struct Random(u64);

impl Random {
    fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        let x = (self.0 ^ (self.0 >> 29)).wrapping_mul(0xbf58476d1ce4e5b9);
        ((x ^ (x >> 32)) >> 11) as f64 / (1u64 << 53) as f64
    }

    fn within(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.unit()
    }

    fn normal(&mut self) -> f64 {
        (-2.0 * (1.0 - self.unit()).ln()).sqrt() * (2.0 * PI * self.unit()).cos()
    }

    /// Returns one wave, or twelve of any length: amplitude, wave number, phase.
    fn waves(&mut self, one: bool) -> Vec<[f64; 3]> {
        if one {
            let (steep, length) = (10f64.powf(self.within(-1.7, 0.5)), self.within(0.15, 0.8));
            return vec![[steep * length * length, 2.0 * PI / length, self.within(0.0, 2.0 * PI)]];
        }
        let size = 0.8 * 10f64.powf(self.within(-0.3, 1.2));
        let mut wave = |_| {
            let k = self.within(3.0, 25.0);
            [size * self.normal() / k / k, k, self.within(0.0, 2.0 * PI)]
        };
        (0..12).map(&mut wave).collect()
    }
}

fn wavy(waves: &[[f64; 3]], x: f64) -> f64 {
    waves.iter().map(|[a, k, phase]| a * (k * x + phase).cos()).sum()
}

#[test]
fn hertz_under_any_load() {
    let mut random = Random(3);
    let mut all = Vec::new();
    for i in 0..=100 {
        let (load, c) = (10f64.powf(f64::from(i) * 0.137 - 14.0), random.within(-0.7, 0.7));
        let set = set(&scene(load, [-2.0, 2.0]), |x| (x - c).powi(2) / 2.0).unwrap();
        let found = set.found();
        let half = (4.0 * load / PI).sqrt();
        let &[on] = found.intervals.as_slice() else { panic!("{load}: {found:?}") };
        all.push(off(on, Interval { left: c - half, right: c + half }));
        assert!(set.cells.len() <= 130 && found.reaches == Ends::both(false), "{found:?}");
    }
    all.sort_by(f64::total_cmp);
    assert!(all[50] < 0.015 && all[100] < 0.08, "{} {}", all[50], all[100]);
}

#[test]
fn two_contacts_until_they_merge() {
    let h = |x: f64| x.powi(4) - 2.0 * x * x;
    for (load, allowed) in [(1e-8, 0.08), (0.1, 0.04), (1.0, 0.04), (3.0, 0.06), (3.3, 0.04)] {
        let found = find(&scene(load, [-3.0, 3.0]), h).unwrap();
        let d = (4.0f64 * load / PI).sqrt();
        let [inner, outer] = [1.0 - d / 2.0, 1.0 + d / 2.0].map(|square| square.max(0.0).sqrt());
        let exact = if load < PI {
            vec![[-outer, -inner], [inner, outer]]
        } else {
            // One contact: 3β⁴ - 4β² = 4F/π.
            let square = (2.0 + (4.0 + 12.0 * load / PI).sqrt()) / 3.0;
            vec![[-square.sqrt(), square.sqrt()]]
        };
        assert_eq!(found.intervals.len(), exact.len(), "{load}: {found:?}");
        for (&on, [left, right]) in found.intervals.iter().zip(exact) {
            assert!(off(on, Interval { left, right }) < allowed, "{load}: {found:?}");
        }
    }
}

#[test]
fn random_bodies_as_on_fine_even_cells() {
    let mut random = Random(7);
    let (mut wrong, mut counted) = (0, Vec::new());
    for i in 0..200 {
        let waves = random.waves(i % 2 == 1);
        let h = |x: f64| x * x / 2.0 + wavy(&waves, x);
        let known = heights(64, [-2.0, 2.0], h);
        let load = 10f64.powf(random.within(-4.0, -0.3));
        let scene = Scene { known: &known, ..scene(load, [-2.0, 2.0]) };
        let set = set(&scene, h).unwrap();
        let found = set.found();
        counted.push(set.cells.len());
        let fine = even(&scene, 801, h);
        // The fine cells do not resolve the width of a run of few cells.
        let far = |(&on, &fine): (&Interval<f64>, &Interval<f64>)| {
            fine.half_width() > 0.05 && off(on, fine) > 0.12
        };
        wrong += usize::from(
            found.intervals.len() != fine.intervals.len()
                || found.intervals.iter().zip(&fine.intervals).any(far),
        );
    }
    counted.sort_unstable();
    assert!(wrong <= 2, "{wrong} of 200");
    assert!(counted[100] <= 70 && counted[199] <= 250, "{counted:?}");
}

#[test]
fn a_hundred_contacts() {
    let h = |x: f64| 0.05 * x * x - 1e-3 * (2.0 * PI * x / 0.03).cos();
    let known = heights(10_000, [-2.0, 2.0], h);
    let mut scene = Scene { known: &known, ..scene(0.1, [-2.0, 2.0]) };
    let first = set(&scene, h).unwrap();
    let found = first.found();
    let fine = even(&scene, 4001, h);
    assert_eq!(found.intervals.len(), fine.intervals.len());
    assert!(found.intervals.len() > 70 && first.cells.len() < 2000, "{found:?}");
    for (&on, &fine) in found.intervals.iter().zip(&fine.intervals) {
        assert!(off(on, fine) < 0.12, "{on:?} {fine:?}");
    }
    // Under a little more load, contacts are born and none dies.
    (scene.start, scene.load) = (&found.intervals, 0.11);
    let more = find(&scene, h).unwrap();
    assert!(more.intervals.len() >= found.intervals.len());
    let fine = even(&scene, 4001, h);
    assert_eq!(more.intervals.len(), fine.intervals.len());
}

/// Next to a wide cell the lowest of narrow ones is not cut again and again.
#[test]
fn noise_is_resolved_in_few_rounds() {
    let mut random = Random(5);
    let noise: Vec<f64> = (0..1201).map(|_| random.normal()).collect();
    let load = 0.05;
    let h = |x: f64| {
        let at = (x + 1.0) * 600.0;
        let i = (at.floor().max(0.0) as usize).min(1199);
        let share = at - i as f64;
        0.5 * x * x + 0.03 * load * (noise[i] + share * (noise[i + 1] - noise[i]))
    };
    let known = heights(1201, [-1.0, 1.0], h);
    let scene = Scene { kappa: 1.0, known: &known, ..scene(load, [-1.0, 1.0]) };
    let set = set(&scene, h).unwrap();
    assert!(set.solves < 36, "{} solves", set.solves);
}

#[test]
fn corners_hold_the_ends() {
    for (a, k, phase, load, n, reaches) in [
        (0.02, 7.0, 0.4, 0.05, 3, Ends { left: true, right: false }),
        (0.02, 7.0, 0.0, 0.08, 3, Ends::both(true)),
        (0.02, 4.2, 2.9, 0.05, 2, Ends::both(true)),
        (0.02, 7.0, 3.5, 0.002, 1, Ends::both(false)),
    ] {
        let h = |x: f64| -a * (k * x + phase).cos() + 0.02 * x;
        let scene = scene(load, [-1.0, 1.0]);
        let (found, fine) = (find(&scene, h).unwrap(), even(&scene, 1001, h));
        assert_eq!(fine.reaches, found.reaches, "{found:?} {fine:?}");
        assert_eq!((n, reaches), (fine.intervals.len(), fine.reaches), "{fine:?}");
        for (&on, &fine) in found.intervals.iter().zip(&fine.intervals) {
            assert!(off(on, fine) < 0.12, "{on:?} {fine:?}");
        }
        for (end, at, x) in [(Side::Left, 0, -1.0), (Side::Right, n - 1, 1.0)] {
            assert_eq!(found.intervals[at][end] == x, found.reaches[end]);
        }
    }
}

/// The parabola x²/2 rolls until it touches around the line of the load, by elimination and by
/// conjugate gradients.
/// A step that is known as closely as x can be.
#[test]
fn a_step_far_from_the_ends() {
    let mut random = Random(5);
    for _ in 0..30 {
        let (at, load) = (random.within(-0.1, 0.1), 10f64.powf(random.within(-4.0, -2.0)));
        let h = |x: f64| x * x / 2.0 + if x > at { 0.01 } else { 0.0 };
        let beside = (0..104).map(|i| 0.5f64.powf(f64::from(i) * 0.5));
        let mut places: Vec<_> = beside.flat_map(|d| [at - d, at + d]).collect();
        places.sort_by(f64::total_cmp);
        let known: Vec<_> = places.into_iter().map(|x| [x, h(x)]).collect();
        let found = set(&Scene { known: &known, ..scene(load, [-1.0, 1.0]) }, h).unwrap();
        assert!(found.work < MAX_WORK / 10, "{at} {load}: {}", found.work);
    }
}

#[test]
fn a_parabola_rolls() {
    for (load, at) in [(1e-6, 0.3), (0.01, -0.7), (0.3, 0.01), (0.3, 0.9)] {
        let scene = Scene { at: Some(at), ..scene(load, [-2.0, 2.0]) };
        let half = (4.0 * load / PI).sqrt();
        let due = Interval { left: at - half, right: at + half };
        let h = |x: f64| 0.5 * x * x;
        let coarse = find(&scene, h).unwrap();
        assert_eq!(coarse.intervals.len(), 1);
        assert!(off(coarse.intervals[0], due) < 0.12, "{load} {at}: {coarse:?}");
        assert!((coarse.tilt + at).abs() < 0.1 * half, "{load} {at}: {coarse:?}");
        if load > 0.1 {
            let fine = even(&scene, 2001, h);
            assert!(off(fine.intervals[0], due) < 0.01, "{load} {at}: {fine:?}");
            assert!((fine.tilt + at).abs() < 0.01 * half, "{load} {at}: {fine:?}");
        }
    }
}

#[test]
fn from_the_last_contact_with_fewer_solves() {
    let h = |x: f64| x.powi(4) - 2.0 * x * x;
    let mut scene = scene(1e-6, [-3.0, 3.0]);
    let cold = set(&scene, h).unwrap();
    let last = cold.found().intervals;
    scene.start = &last;
    scene.load = 1.1e-6;
    let warm = set(&scene, h).unwrap();
    assert_eq!(warm.found().intervals.len(), 2);
    assert!(warm.solves <= 4 && 3 * warm.solves < cold.solves);
    // A start far from the contacts costs some more, but leads to the same ones.
    scene.start = &[Interval { left: 1.9, right: 1.900_001 }];
    assert_eq!(find(&scene, h).unwrap().intervals.len(), 2);
    scene.start = &[Interval { left: f64::NAN, right: 1.0 }, Interval { left: 5.0, right: -7.0 }];
    assert_eq!(find(&scene, h).unwrap().intervals.len(), 2);
}

/// A search that is cancelled ends before its next system of equations.
#[test]
fn a_search_that_is_cancelled() {
    let cancelled = || {
        ContactError::Solve(SolveError::Cancelled {
            evaluations: 7,
            last: Interval { left: -1.0, right: 1.0 },
        })
    };
    for most in 0..3 {
        let looks = std::cell::Cell::new(0);
        let watch =
            || if looks.replace(looks.get() + 1) < most { Ok(()) } else { Err(cancelled()) };
        let scene = Scene { watch: &watch, ..scene(1e-6, [-2.0, 2.0]) };
        let mut set = ActiveSet::new(&scene, &mut |x| Ok(x * x / 2.0)).unwrap();
        let found = set.settle(&scene, &mut |x| Ok(x * x / 2.0));
        assert_eq!(found, Err(NotFound::Height(cancelled())));
        assert_eq!((looks.get(), set.solves), (most + 1, most));
    }
}

#[test]
fn single_precision() {
    for load in [1e-5f32, 1e-3, 0.1] {
        let scene = Scene {
            kappa: std::f32::consts::FRAC_PI_2,
            load,
            at: None,
            range: [-2.0f32, 2.0],
            cells: FIRST_CELLS,
            known: &[],
            start: &[],
            kernel: None,
            watch: &|| Ok(()),
        };
        let found = active_set(&scene, &mut 0, &mut |x: f32| Ok(x * x / 2.0 + 3.0)).unwrap();
        let half = f64::from(4.0 * load / std::f32::consts::PI).sqrt();
        // Under light loads the rounding of heights near 3 shows.
        for Interval { left, right } in &found.intervals {
            let on = Interval { left: f64::from(*left), right: f64::from(*right) };
            assert!(off(on, Interval { left: -half, right: half }) < 0.15, "{load}: {on:?}");
        }
        assert_eq!(found.intervals.len(), 1);
    }
}

#[test]
fn no_scene_is_a_trap() {
    let flat = find(&scene(0.1, [-1.0, 3.0]), |_| 7.0).unwrap();
    assert_eq!(flat.intervals, [Interval { left: -1.0, right: 3.0 }]);
    assert_eq!(flat.reaches, Ends::both(true));
    let whole = f64::MAX / 4.0;
    let flat = find(&scene(1e-300, [-whole, whole]), |_| 0.0).unwrap();
    assert_eq!(flat.reaches, Ends::both(true));
    // Heights that overflow with this load, and a range of three numbers.
    let steep = find(&scene(1e-300, [-1.0, 1.0]), |x| 1e10 * (x - 0.2).abs()).unwrap();
    assert!(steep.intervals.len() == 1 && (steep.intervals[0].centre() - 0.2).abs() < 1e-9);
    let next = 1.0 + f64::EPSILON;
    assert!(find(&scene(0.1, [1.0, next]), |x| x).is_ok());
    for range in [[1.0, 1.0], [1.0, -1.0], [f64::NAN, 1.0], [0.0, f64::INFINITY]] {
        let refused = find(&scene(0.1, range), |x| x * x);
        assert!(matches!(refused, Err(NotFound::Scene { .. })), "{range:?}");
    }
    for load in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let refused = find(&scene(load, [-1.0, 1.0]), |x| x * x);
        assert!(matches!(refused, Err(NotFound::Scene { .. })), "{load}");
    }
    let hole = |x: f64| if x > 0.3 { f64::NAN } else { x * x };
    let refused = find(&scene(0.1, [-1.0, 1.0]), hole);
    assert!(matches!(refused, Err(NotFound::NotFinite { x, .. }) if x > 0.3), "{refused:?}");
    let outside = ContactError::Solve(SolveError::OutsideBodies { x: 0.0, range: [0.0, 1.0] });
    let refused = active_set(&scene(0.1, [-1.0, 1.0]), &mut 0, &mut |_| Err(outside.clone()));
    assert_eq!(refused.unwrap_err(), NotFound::Height(outside));
    // The search has spent all its work before.
    let mut spent = MAX_WORK + 1;
    let refused = active_set(&scene(0.1, [-1.0, 1.0]), &mut spent, &mut |x| Ok(x * x));
    assert_eq!(refused.map(|_| ()), Err(NotFound::Unsettled { solves: 0 }));
    // Noise from cell to cell: the search ends in any case.
    let noise = |x: f64| (x.to_bits().wrapping_mul(0x9e3779b97f4a7c15) >> 11) as f64 * 1e-16;
    for load in [1e-6, 1e-2, 1.0] {
        let known = heights(1000, [-1.0, 1.0], noise);
        let found = set(&Scene { known: &known, ..scene(load, [-1.0, 1.0]) }, noise);
        assert!(found.is_ok_and(|found| found.cells.len() <= MAX_CUT_CELLS), "{load}");
    }
}
