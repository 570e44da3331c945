//! Bodies that repeat with a period.

use super::oracle::residual;
use super::scenes::random_layer;
use super::{RIGID, assert_limits, coated, half_plane, layer};
use crate::common::{Profile, graph};
use crate::corners::polygon;
use crate::random_scenes::Dice;
use crate::several_bench::{PERIODIC, Periodic, rough};
use linecontact::profile::Piecewise;
use linecontact::{
    Base, Contact, ContactError, Control, Curve, CurvePoint, Edge, Flat, InputError, Layer,
    Material, ParametricProfile, PlaneState, Reference, References, RegularKernel, Solution,
    SolveError, Solver,
};
use std::f64::consts::{PI, TAU};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

pub const PERIOD: f64 = 1.3;

/// Waves with heights `Σ a (1 - cos(2π n x/p + φ))`, described from a place on.
pub fn waves(from: f64, terms: &[[f64; 3]]) -> Profile {
    let terms = terms.to_vec();
    graph(from, from + PERIOD, move |x| {
        terms.iter().fold([0.0; 2], |[height, slope], &[a, n, phase]| {
            let (sin, cos) = (TAU * n * x / PERIOD + phase).sin_cos();
            [height + a * (1.0 - cos), slope + a * TAU * n / PERIOD * sin]
        })
    })
}

pub fn row(body: &Profile) -> Contact<'_, f64> {
    Contact::new(&Flat, &**body).unwrap().contact_modulus(1.0).period(PERIOD)
}

fn steel_on_rigid(body: &Profile) -> Contact<'_, f64> {
    let contact = Contact::new(&Flat, &**body).unwrap().period(PERIOD);
    contact.materials(RIGID, Material::elastic(0.91, 0.3), PlaneState::Strain)
}

const ANYWHERE: References<f64> =
    References { x: 0.7, lower: Reference::Depth(1.0), upper: Reference::Depth(1.0) };

/// A land whose period begins anew at a step of 2e-11 of its height, as drawn with a steep wall, in
/// a contact that ends on a ramp.
#[test]
fn a_period_that_does_not_close_to_the_last_bit() {
    let [closed, open] = [0.0, 6e-13].map(|step| {
        let points = [[0.25, 0.0], [0.25 + 3e-8, 0.03], [0.65, 0.03], [0.75, step], [1.0, step]];
        let body = polygon(&[&[[0.0, 0.0]], &points[..]].concat());
        let contact = Contact::new(&Flat, &body).unwrap().kappa(1.0).period(1.0);
        contact.solve(Control::Load(0.03)).unwrap().hull()
    });
    assert!((closed.left - 0.7153).abs() < 1e-3 && (closed.right - 1.25).abs() < 1e-12);
    assert!((closed.left - open.left).abs() < 1e-10 && (closed.right - open.right).abs() < 1e-10);
}

/// Peaks of a rough row under loads at which contacts are born: from the pressures of one load, the
/// contacts under another may not be found, and a period has no ends that they could leave.
#[test]
fn peaks_of_a_rough_row() {
    let term = |k: f64| [1e-3 * k.powf(-1.3), TAU * k, (12.9898 * k).sin() * 43.0];
    let terms: Vec<[f64; 3]> = (1..=12).map(|k| term(f64::from(k))).collect();
    let body = graph(0.0, 1.0, move |x| {
        terms.iter().fold([0.0; 2], |[y, slope], &[a, omega, phase]| {
            let (sin, cos) = (omega * x + phase).sin_cos();
            [y + a * cos, slope - a * omega * sin]
        })
    });
    let contact = Contact::new(&Flat, &*body).unwrap().kappa(1.0).period(1.0);
    for load in [3e-4, 1e-3, 2e-3] {
        let peak = contact.solve(Control::Load(load)).unwrap().peak().unwrap().pressure;
        let found = contact.solve(Control::PeakPressure(peak)).unwrap();
        assert!((found.load() / load - 1.0).abs() < 1e-12, "{load}: {found}");
    }
}

#[test]
fn one_contact_is_westergaards() {
    let d = 0.02;
    for a in [0.01, 0.05, 0.2, 0.4, 0.45 * PERIOD, 0.6, 0.63] {
        let sin = (PI * a / PERIOD).sin();
        let (load, peak) = (PI * d * sin * sin, TAU * d / PERIOD * sin);
        // Described from below the crest, from the crest and from between.
        for from in [-0.5 * PERIOD, 0.0, 0.3] {
            let body = waves(from, &[[d, 1.0, 0.0]]);
            let solution = steel_on_rigid(&body).solve(Control::Load(load)).unwrap();
            let [on] = *solution.intervals() else { panic!("{a}: {:?}", solution.intervals()) };
            let crest = if on.right > PERIOD { PERIOD } else { 0.0 };
            assert!((on.half_width() / a - 1.0).abs() < 2e-14, "{a} {from}: {on:?}");
            assert!((on.centre() - crest).abs() < 4e-14, "{a} {from}: {on:?}");
            assert!((solution.peak().unwrap().pressure / peak - 1.0).abs() < 1e-13);
            // At any x, a period further on, too.
            let x = 0.3 * a;
            let sine = (PI * x / PERIOD).sin();
            let expected =
                TAU * d / PERIOD * (PI * x / PERIOD).cos() * (sin * sin - sine * sine).sqrt();
            let pressure = solution.pressure().unwrap();
            let mut pressures = [0.0; 3];
            pressure.at_many(&[x - PERIOD, x, x + 3.0 * PERIOD], &mut pressures).unwrap();
            for pressure in pressures.into_iter().chain([pressure.at(x + PERIOD).unwrap()]) {
                assert!((pressure / expected - 1.0).abs() < 1e-13, "{a} {from}");
            }
            assert!(solution.residual(x - PERIOD).unwrap().abs() < 1e-12 * peak);
            // gap' = 2 |P| as continued beyond the limit.
            let beside = 0.5 * (a + 0.5 * PERIOD);
            let high = (PI * beside / PERIOD).sin();
            let root = (high * high - sin * sin).sqrt();
            let expected = 2.0 * d * (high * root - sin * sin * ((high + root) / sin).ln());
            for x in [beside, beside + PERIOD] {
                let gap = solution.gap_at(x).unwrap();
                assert!((gap - expected).abs() < 1e-15 + 1e-12 * expected, "{a} {from}: {gap:e}");
            }
            let rates = solution.load_rates().unwrap();
            let expected = (PI * x / PERIOD).cos() / PERIOD / (sin * sin - sine * sine).sqrt();
            let off = rates.pressure(x).unwrap() / expected - 1.0;
            assert!(off.abs() < 1e-12, "{a} {from}: {off:e}");
            // F = π d sin²(πa/p)
            let width = 1.0 / (d * PI * PI / PERIOD * (TAU * a / PERIOD).sin());
            assert!((rates.a / width - 1.0).abs() < 1e-11, "{a} {from}: {}", rates.a / width - 1.0);
            let approach = d * sin * sin * (1.0 - (sin * sin).ln());
            let found = solution.approach(&ANYWHERE).unwrap();
            assert!((found.bodies / approach - 1.0).abs() < 1e-13, "{a} {from}: {found:?}");
            let stiffness = PI / -(sin * sin).ln();
            let found = solution.stiffness(&ANYWHERE).unwrap();
            assert!(
                (found / stiffness - 1.0).abs() < 1e-11,
                "{a} {from}: {}",
                found / stiffness - 1.0
            );
            if a > 0.3 {
                solution.certify().unwrap();
            }
        }
    }
}

/// Three contacts a period, by Newton's method on the limits with the cotangent as kernel.
#[test]
fn several_contacts_agree_with_another_method() {
    let d = 0.02;
    let cases = [
        (
            0.03,
            [
                [0.388_529_910_500_014_73, 0.463_660_736_936_456_76],
                [0.825_173_931_130_970_5, 0.932_686_792_022_824_7],
                [-0.078_150_410_352_380_64, 0.068_032_728_262_040_47],
            ],
            [0.004_372_239_495_204_181_5, 0.008_931_755_258_449_052, 0.016_696_005_246_346_776],
        ),
        (
            0.06,
            [
                [0.357_583_848_659_436_43, 0.493_492_688_598_232_8],
                [0.799_279_865_809_387_3, 0.960_856_879_250_890_8],
                [-0.103_239_773_513_230_71, 0.091_994_723_063_361_28],
            ],
            [0.013_525_249_661_212_08, 0.018_875_012_483_800_923, 0.027_599_737_854_986_99],
        ),
    ];
    for from in [0.1, -0.2, 0.9] {
        let body = waves(from, &[[d, 3.0, 0.0], [0.6 * d, 1.0, 0.4]]);
        let scene = row(&body);
        let mut solver = Solver::new();
        for (load, limits, loads) in &cases {
            let check = |solution: &Solution<'_, f64>| {
                let regions = solution.contacts().unwrap();
                assert_eq!(regions.len(), 3);
                for region in &regions {
                    let shift = |[left, right]: [f64; 2]| {
                        let turns = ((region.interval.left - left) / PERIOD).round() * PERIOD;
                        [left + turns, right + turns]
                    };
                    let off = |i: usize| {
                        let [left, right] = shift(limits[i]);
                        (region.interval.left - left)
                            .abs()
                            .max((region.interval.right - right).abs())
                    };
                    let i = (0..3).min_by(|&i, &j| off(i).total_cmp(&off(j))).unwrap();
                    assert!(off(i) < 2e-15, "{from} {load}: {:e}", off(i));
                    assert!((region.load - loads[i]).abs() < 1e-15);
                }
            };
            check(&scene.solve(Control::Load(*load)).unwrap());
            check(&solver.solve(&scene, Control::Load(*load)).unwrap());
        }
    }
}

/// Returns random waves, at most 12 a period.
fn random_waves(random: &mut Dice) -> Vec<[f64; 3]> {
    let count = 1 + (5.0 * random.uniform()) as usize;
    let wave = |_| {
        let n = (1.0 + 12.0 * random.uniform()).floor();
        [random.power_of_ten(-3.0, -1.0) / n, n, random.within(0.0, TAU)]
    };
    (0..count).map(wave).collect()
}

/// Every contact of random waves meets Eq. (1) by sums with the cotangent, half of them on layers;
/// next loads agree with first ones.
#[test]
fn random_rows_meet_the_equation() {
    let count = std::env::var("SCENES").ok().and_then(|count| count.parse().ok()).unwrap_or(24);
    let (mut refused, mut complete, mut contacts) = (0, 0, 0);
    // One interval that is no contact (375), a contact born at the cut (399), a short contact above
    // thin layers (523), and a step that begins with pressures over the cut (893).
    let named = [375, 399, 523, 893].into_iter().filter(|&seed| seed >= count && count > 1);
    for seed in (0..count).chain(named) {
        let random = &mut Dice::new(77_000 + seed);
        let terms = random_waves(random);
        let slope = |x: f64| {
            terms.iter().fold(0.0, |sum, &[a, n, phase]| {
                sum + a * TAU * n / PERIOD * (TAU * n * x / PERIOD + phase).sin()
            })
        };
        let body = waves(random.within(-1.0, 1.0), &terms);
        let (one, compliance) = random_layer(random);
        let is_layered = seed % 2 == 1;
        let (kappa, layers) = match is_layered {
            true => (PI / 2.0 / compliance, vec![(1.0, one)]),
            false => (PI / 2.0, vec![]),
        };
        let scene = match is_layered {
            true => coated(&body, RIGID, one).period(PERIOD),
            false => row(&body),
        };
        let steepest = terms.iter().fold(0.0, |sum, &[a, n, _]| sum + a * n / PERIOD);
        let load = kappa * steepest * PERIOD * random.power_of_ten(-3.0, 0.0);
        let mut solver = Solver::new();
        for load in [load, 1.5 * load] {
            let solution = match scene.solve(Control::Load(load)) {
                Err(ContactError::Solve(SolveError::CompleteContact { complete: at, .. })) => {
                    assert!(load > 0.9 * at, "{seed}: {load} of {at}");
                    complete += 1;
                    continue;
                }
                Err(error) => {
                    println!("{seed} at {load}: {error}");
                    refused += 1;
                    continue;
                }
                Ok(solution) => solution,
            };
            contacts += solution.intervals().len();
            let off = residual(&solution, kappa, &layers, Some(PERIOD), slope);
            assert!(off < 1e-8, "{seed} at {load}: {off:e}");
            let certificate = solution.certify();
            assert!(certificate.is_ok(), "{seed}: {certificate:?}");
            let next = match solver.solve(&scene, Control::Load(load)) {
                Ok(next) => next,
                Err(error) => panic!("{seed} warm at {load}: {error}"),
            };
            let peaks = [&solution, &next].map(|solution| solution.peak().unwrap().pressure);
            assert!((peaks[1] / peaks[0] - 1.0).abs() < 1e-9, "{seed} at {load}: {peaks:?}");
        }
    }
    println!("{contacts} contacts, {complete} complete, {refused} refused");
    assert!(1000 * refused <= count, "{refused} refused");
}

/// The rough surfaces of the benches meet Eq. (1), and their peaks are those with which other
/// programs are compared.
#[test]
fn rough_surfaces_meet_the_equation() {
    for Periodic { most, load, contacts, peak } in PERIODIC {
        let body = rough::surface(most);
        let contact = Contact::new(&Flat, &body).unwrap().contact_modulus(1.0).period(1.0);
        let solution = contact.solve(Control::Load(load)).unwrap();
        assert_eq!(solution.intervals().len(), contacts);
        let none: [(f64, Layer<f64>); 0] = [];
        let off = residual(&solution, PI / 2.0, &none, Some(1.0), |x| body.at(x).dy);
        let found = solution.peak().unwrap().pressure;
        println!("{most} {load}: residual {off:.1e}, peak {:.1e}", found / peak - 1.0);
        assert!(off < 1e-10 && (found / peak - 1.0).abs() < 1e-12);
    }
}

/// The rates of pressure, limits and approach of several contacts against differences, and the
/// contacts by their half-width, peak and approach.
#[test]
fn rates_and_controls_of_several_contacts() {
    let body = waves(0.1, &[[0.02, 3.0, 0.0], [0.012, 1.0, 0.4]]);
    let scene = steel_on_rigid(&body);
    let (load, step) = (0.06, 1e-4);
    let solve = |load: f64| scene.solve(Control::Load(load)).unwrap();
    let (at, below, above) = (solve(load), solve(load - step), solve(load + step));
    let rates = at.load_rates().unwrap();
    for (i, limits) in rates.limits.iter().enumerate() {
        let of = |side: fn(&linecontact::Interval<f64>) -> f64| {
            (side(&above.intervals()[i]) - side(&below.intervals()[i])) / (2.0 * step)
        };
        assert!((limits.left / of(|on| on.left) - 1.0).abs() < 1e-5);
        assert!((limits.right / of(|on| on.right) - 1.0).abs() < 1e-5);
        let x = at.intervals()[i].centre() + 0.02;
        let [high, low] =
            [&above, &below].map(|solution| solution.pressure().unwrap().at(x).unwrap());
        let expected = (high - low) / (2.0 * step);
        for x in [x - PERIOD, x, x + 2.0 * PERIOD] {
            assert!((rates.pressure(x).unwrap() / expected - 1.0).abs() < 1e-5);
        }
    }
    let [high, low] = [&above, &below].map(|solution| solution.approach(&ANYWHERE).unwrap().bodies);
    let stiffness = at.stiffness(&ANYWHERE).unwrap();
    assert!((stiffness * (high - low) / (2.0 * step) - 1.0).abs() < 1e-6);
    // Wherever the references are.
    let references = References { x: -0.3, ..ANYWHERE };
    let bodies = at.approach(&ANYWHERE).unwrap().bodies;
    assert!((at.approach(&references).unwrap().bodies / bodies - 1.0).abs() < 1e-13);

    let peak = at.peak().unwrap().pressure;
    let controls = [
        Control::HalfWidth(at.hull().half_width()),
        Control::PeakPressure(peak),
        Control::Approach { approach: bodies, references: ANYWHERE },
    ];
    for control in controls {
        let found = scene.solve(control).unwrap();
        assert!((found.load() / load - 1.0).abs() < 1e-11, "{control:?}: {}", found.load());
    }
}

/// Both bodies have waves, described over different periods; one goes down in x, one is of pieces.
#[test]
fn bodies_may_be_described_over_different_periods() {
    let d = 0.02;
    let sum = waves(0.0, &[[d, 3.0, 0.0], [0.6 * d, 1.0, 0.4]]);
    let upper = waves(0.4, &[[d, 3.0, 0.0]]);
    let part = |from: f64, to: f64| -> Box<dyn ParametricProfile<f64>> {
        Box::new(Curve::new([-to, -from], move |k: f64| {
            let (sin, cos) = (0.4 - TAU * k / PERIOD).sin_cos();
            CurvePoint {
                x: -k,
                y: -0.6 * d * (1.0 - cos),
                dx: -1.0,
                dy: 0.6 * d * TAU / PERIOD * sin,
            }
        }))
    };
    let lower = Piecewise::new(vec![part(-0.4, 0.1), part(0.1, PERIOD - 0.4)]).unwrap();
    let both = Contact::new(&lower, &*upper).unwrap().contact_modulus(1.0).period(PERIOD);
    for load in [1e-4, 0.03, 0.1] {
        let one = row(&sum).solve(Control::Load(load)).unwrap();
        let other = both.solve(Control::Load(load)).unwrap();
        let peaks = [&one, &other].map(|solution| solution.peak().unwrap().pressure);
        assert!((peaks[1] / peaks[0] - 1.0).abs() < 1e-12, "{load}: {peaks:?}");
        let at = one.peak().unwrap().x;
        let gap = one.gap_at(at + 0.2).unwrap_or(0.0) - other.gap_at(at + 0.2).unwrap_or(0.0);
        assert!(gap.abs() < 1e-14, "{load}: {gap:e}");
    }
}

#[test]
fn what_is_not_possible_is_refused() {
    let crest = waves(-0.5 * PERIOD, &[[0.02, 1.0, 0.0]]);
    let error =
        |contact: Contact<'_, f64>, control| contact.solve(control).map(|_| ()).unwrap_err();
    let load = Control::Load(0.01);
    for period in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let fault = error(row(&crest).period(period), load);
        assert!(matches!(fault, ContactError::Input(InputError::InvalidPeriod { .. })), "{fault}");
    }
    let not_periodic = |body: &Profile, says: &str| {
        let fault = error(row(body), load);
        let ContactError::Input(InputError::NotPeriodic { what, .. }) = fault else {
            panic!("{fault}")
        };
        assert!(what.contains(says), "{fault}");
    };
    not_periodic(&graph(0.0, 1.2, |x| [0.5 * x * x, x]), "x, less the period");
    not_periodic(&graph(-0.3, 1.0, |x| [0.5 * x * x, x]), "height");
    not_periodic(&graph(-0.5 * PERIOD, 0.5 * PERIOD, |x| [0.5 * x * x, x]), "slope");

    let refused = |contact: Contact<'_, f64>, control, says: &str| {
        let fault = error(contact, control);
        let is_typed = matches!(fault, ContactError::Input(InputError::KernelNotSupported { why }) if why.contains(says));
        assert!(is_typed && fault.to_string().contains("period"), "{fault}");
    };
    refused(row(&crest).edges(Edge::Fixed(-0.1), Edge::Free), load, "not Free");
    refused(row(&crest).kernel(&Nothing), load, "by a formula");
    refused(row(&crest), Control::Moment { load: 0.01, moment: 0.0, about: 0.0 }, "a moment");
    refused(row(&crest), Control::CentreOfPressure { load: 0.01, at: 0.0 }, "a moment");

    // Westergaard's waves touch everywhere under π d E*.
    for load in [0.0628, 0.0629, 1.0] {
        let fault = error(row(&crest), Control::Load(load));
        let ContactError::Solve(SolveError::CompleteContact { complete, .. }) = fault else {
            panic!("{fault}")
        };
        assert!((complete / (0.02 * PI) - 1.0).abs() < 1e-12, "{complete}");
    }
    // As many waves as places are looked at, described from a crest.
    let fine = waves(0.0, &[[0.02, 64.0, 0.0]]);
    let fault = error(row(&fine), Control::Load(1e3));
    let ContactError::Solve(SolveError::CompleteContact { complete, .. }) = fault else {
        panic!("{fault}")
    };
    assert!((complete / (64.0 * 0.02 * PI) - 1.0).abs() < 1e-9, "{complete}");
    for control in [Control::HalfWidth(0.65), Control::PeakPressure(0.2)] {
        let fault = error(row(&crest), control);
        let is_typed = matches!(
            fault,
            ContactError::Solve(SolveError::CompleteContact { .. } | SolveError::InJump { .. })
        );
        assert!(is_typed, "{control:?}: {fault}");
    }
    // Of like bodies no gap is left.
    for body in [&Flat as &dyn ParametricProfile<f64>, &crest, &waves(0.1, &[[0.02, 1.0, 0.7]])] {
        let like = Contact::new(body, body).unwrap().contact_modulus(1.0).period(PERIOD);
        let fault = error(like, load);
        let ContactError::Solve(SolveError::CompleteContact { complete, .. }) = fault else {
            panic!("{fault}")
        };
        assert!(complete.abs() < 1e-12, "{complete}");
        assert!(fault.to_string().contains("move one of two like bodies"), "{fault}");
    }
}

/// Near the load of complete contact, and above it, a search took a hundred solves to its error.
#[test]
fn nearly_complete_contact_ends_soon() {
    let (wave, modulus, calls) = (1.5e-4, 115385.0, AtomicUsize::new(0));
    let body = Curve::new([0.0, 1.0], |k: f64| {
        calls.fetch_add(1, Relaxed);
        let (sin, cos) = (TAU * k).sin_cos();
        CurvePoint { x: k, y: wave * cos, dx: 1.0, dy: -wave * TAU * sin }
    });
    let contact = Contact::new(&Flat, &body).unwrap().contact_modulus(modulus).period(1.0);
    let full = PI * modulus * wave;
    let gap = |share: f64| 2.0 / PI * (1.0 - share).sqrt().asin();
    for share in [0.99, 0.998, 0.9987] {
        let solution = contact.solve(Control::Load(share * full)).unwrap();
        let off = 1.0 - 2.0 * solution.hull().half_width() - gap(share);
        assert!(off.abs() < 1e-11, "{share}: {off:e}");
    }
    for share in [0.9992, 0.9997, 1.002, 1.1, 1.14, 2.0] {
        calls.store(0, Relaxed);
        let fault = contact.solve(Control::Load(share * full)).unwrap_err();
        let ContactError::Solve(SolveError::CompleteContact { load, complete }) = fault else {
            panic!("{share}: {fault}")
        };
        assert!(load == share * full && (complete / full - 1.0).abs() < 1e-12, "{fault}");
        let calls = calls.load(Relaxed);
        println!("{share}: {calls}");
        assert!(calls < 40_000, "{share}: {calls}");
    }
}

/// Kernel that is zero.
struct Nothing;

impl RegularKernel<f64> for Nothing {
    fn slope(&self, _: f64, _: f64) -> f64 {
        0.0
    }

    fn height(&self, _: f64, _: f64) -> f64 {
        0.0
    }

    fn nearest_singularity(&self) -> f64 {
        1.0
    }
}

/// A layer as thick as ten periods is a half-plane, and one of the same material as its base, too.
#[test]
fn thick_layers_are_half_planes() {
    let body = waves(0.1, &[[0.02, 3.0, 0.0], [0.012, 1.0, 0.4]]);
    let plain = row(&body).solve(Control::Load(0.06)).unwrap();
    let thick = layer(1.0, 0.0, 10.0 * PERIOD, Base::Bonded);
    let same = layer(1.0, 0.0, 0.2, half_plane(1.0, 0.0));
    for layer in [thick, same] {
        let solution =
            coated(&body, RIGID, layer).period(PERIOD).solve(Control::Load(0.06)).unwrap();
        let limits = plain.intervals().iter().map(|on| [on.left, on.right]);
        assert_limits(&solution, &limits.collect::<Vec<_>>(), 1e-14);
    }
}

/// A row of lands whose limits lie within 1e-8 of their corners: from solve to solve they move by
/// their error, and the bend with them. Of 300 loads six were refused.
#[test]
fn limits_at_weak_corners_leave_as_much_of_the_bend_open() {
    let at = [0.3294537672700443, 0.5825185200412495, 0.722027266336143, 0.7961993631760678];
    let (depth, wall) = (1e-2, 1e-3);
    let groove =
        |from: f64, to: f64| [[from, 0.0], [from + wall, -depth], [to - wall, -depth], [to, 0.0]];
    let corners =
        [&[[0.0, 0.0]][..], &groove(at[0], at[1]), &groove(at[2], at[3]), &[[1.0, 0.0]]].concat();
    let line = |ends: &[[f64; 2]]| {
        let [[from, y0], [to, y1]] = [ends[0], ends[1]];
        let slope = (y1 - y0) / (to - from);
        let y = move |k: f64| if k == to { y1 } else { y0 + slope * (k - from) };
        Curve::new([from, to], move |k: f64| CurvePoint { x: k, y: y(k), dx: 1.0, dy: slope })
    };
    let lands = Piecewise::new(corners.windows(2).map(line).collect()).unwrap();
    let contact = Contact::new(&lands, &Flat).unwrap().contact_modulus(210e3 / 1.82).period(1.0);
    for load in [140.3, 146.3, 158.3, 172.7, 180.5] {
        let solution = contact.solve(Control::Load(load)).unwrap();
        let borne: f64 = solution.contacts().unwrap().iter().map(|contact| contact.load).sum();
        assert!((borne / load - 1.0).abs() < 1e-7, "{borne} of {load}");
        assert!(solution.limits_error().unwrap() < 1e-7);
        solution.certify().unwrap();
    }
}

/// A land and a groove in each period, whose bottom touches where the period is described to begin:
/// it is cut in one of the gaps, even if the bottom is hollowed by a little. Half of the gaps' ends
/// by boundary elements, to a cell of 2⁻¹².
#[test]
fn the_bottom_of_a_groove_may_touch_where_the_period_was_cut() {
    let depth = 0.05;
    let scenes =
        [(0.5, 0.05, [0.042, 0.257]), (5.0, 0.06, [0.052, 0.254]), (20.0, 0.1, [0.145, 0.251])];
    let scenes = scenes.iter().flat_map(|&scene| [0.0, 1e-5].map(|hollow| (scene, hollow)));
    for ((slope, load, gap), hollow) in scenes {
        let half = 0.5 * depth / slope;
        let [fall, rise] = [[0.25 - half, 0.25 + half], [0.75 - half, 0.75 + half]];
        let middle = depth + hollow;
        let points = [[0.0, middle], [0.02, middle], [fall[0], depth], [fall[1], 0.0]];
        let others = [[rise[0], 0.0], [rise[1], depth], [0.98, middle], [1.0, middle]];
        let body = polygon(&[points, others].concat());
        let contact = Contact::new(&Flat, &*body).unwrap().period(1.0);
        let solution = contact.solve(Control::Load(load));
        let solution = solution.unwrap_or_else(|error| panic!("{slope}, {load}: {error}"));
        let ends = solution.intervals().iter().flat_map(|on| [on.left, on.right]);
        let mut ends: Vec<f64> = ends.map(|x| x.rem_euclid(1.0)).collect();
        ends.sort_by(f64::total_cmp);
        assert_eq!(ends.len(), 4, "{slope}, {load}: {solution}");
        for (end, exact) in ends.iter().zip([gap[0], gap[1], 1.0 - gap[1], 1.0 - gap[0]]) {
            assert!((end - exact).abs() < 2e-3, "{slope}, {load}: {ends:?}");
        }
        assert!((ends[0] + ends[3] - 1.0).abs() < 1e-7, "{slope}, {load}: {ends:?}");
    }
}
