//! Derived quantities of several contacts, against closed forms, stored solutions, independent sums
//! over the pressures, and differences of solves.
#![allow(missing_docs)]

use crate::common::NanSafe;
use crate::common::{Profile, difference, graph, join, several};
use crate::forms::KAPPA;

use linecontact::profile::Ellipse;
use linecontact::reference::{ClosedForm, Hertz, PolynomialMap, Quartic, Wedge, body};
use linecontact::{
    Contact, ContactError, ContactRegion, Control, Cost, Edge, Ends, EvaluationError, Flat,
    Interval, Real, Solution, SolveError, Solver,
};
use std::f64::consts::PI;

/// Body on a flat, E* = 1.
pub struct Scene {
    pub name: &'static str,
    pub body: Profile,
    edges: [Edge<f64>; 2],
    pub load: f64,
}

impl Scene {
    fn contact(&self) -> Contact<'_, f64> {
        let [left, right] = self.edges;
        Contact::new(&Flat, &*self.body).unwrap().contact_modulus(1.0).edges(left, right)
    }

    pub fn solve(&self, load: f64) -> Solution<'_, f64> {
        self.contact().solve(Control::Load(load)).unwrap()
    }
}

/// Returns a polynomial with these coefficients, from the highest on.
fn polynomial<const N: usize>(from: f64, to: f64, coefficients: [f64; N]) -> Profile {
    graph(from, to, move |x| {
        coefficients.iter().fold([0.0; 2], |[y, dy], a| [y * x + a, dy * x + y])
    })
}

/// Returns the scenes of `tests/data/several`, those with closed forms among them.
pub fn all_scenes() -> Vec<Scene> {
    let free = |name, body, load| Scene { name, body, edges: [Edge::Free; 2], load };
    let fifth = [102.4, 0.0, -256.0, 0.0, 224.0, 0.0, -80.0, 0.0, 10.0, 0.0, 0.0];
    // |T₄|/40, cut at the zeros of the polynomial.
    let [outer, inner] = [0.9238795325112867, 0.3826834323650898];
    let cuts = [-1.3, -outer, -inner, inner, outer, 1.3];
    let fourth = cuts.windows(2).zip([1.0, -1.0, 1.0, -1.0, 1.0]).map(|(ends, sign)| {
        polynomial(ends[0], ends[1], [0.2, 0.0, -0.2, 0.0, 0.025].map(|a| sign * a))
    });
    let mut all = scenes();
    all.push(free("map_T4_wedge", join(fourth.collect()), 0.03));
    all.push(free("map_T5_hertz", polynomial(-1.3, 1.3, fifth), 0.05));
    all
}

/// Returns the scenes of `tests/data/several` without closed forms of maps.
fn scenes() -> Vec<Scene> {
    let free = |name, body, load| Scene { name, body, edges: [Edge::Free; 2], load };
    let quartic = || polynomial(-2.5, 2.5, [1.0, 0.0, -2.0, 0.0, 0.0]);
    let cubic = [0.16666666666666666, 0.0, -1.0, 0.09999999999999999, 1.5, -0.3, 0.015];
    let waves = |waves: &'static [[f64; 3]]| {
        graph(-2.0, 2.0, |x| {
            waves.iter().fold([x * x / 2.0, x], |[y, dy], [a, k, phase]| {
                let (sin, cos) = (k * x + phase).sin_cos();
                [y + a * cos, dy - a * k * sin]
            })
        })
    };
    vec![
        free("quartic_F0_1", quartic(), 0.1),
        free("quartic_F3_0", quartic(), 3.0),
        free("map_cubic_hertz", polynomial(-2.6, 2.6, cubic), 0.4),
        free(
            "published_quartic",
            polynomial(
                -2.0,
                3.0,
                [
                    0.22281692032865347,
                    -0.44563384065730693,
                    -0.22281692032865347,
                    0.44563384065730693,
                    0.0,
                ],
            ),
            1.0,
        ),
        free(
            "published_sextic",
            polynomial(
                -3.4,
                3.4,
                [
                    0.004244131815783876,
                    0.002122065907891938,
                    -0.05729577951308232,
                    -0.027586856802595195,
                    0.18037560217081472,
                    0.07639437268410976,
                    -0.07639437268410976,
                ],
            ),
            1.0,
        ),
        free(
            "rough_parabola",
            waves(&[[0.01, 9.0, 0.4], [-0.006, 17.3, 1.9], [0.003, 31.0, 4.0]]),
            0.02,
        ),
        free("wavy_parabola_5", waves(&[[0.012, 20.0, 0.3]]), 0.03),
        Scene {
            name: "wavy_punch_one_corner",
            body: graph(-1.0, 1.0, |x| {
                let (sin, cos) = (7.0 * x + 0.4).sin_cos();
                [-0.02 * cos + 0.02 * x, 0.14 * sin + 0.02]
            }),
            edges: [Edge::Fixed(-1.0), Edge::Free],
            load: 0.05,
        },
    ]
}

/// Returns `∫ P f dx` over a contact, from computed pressures, by the midpoint rule in the angle.
fn sum(solution: &Solution<f64>, on: Interval<f64>, f: impl Fn(f64) -> f64) -> f64 {
    let pressure = solution.pressure().unwrap();
    let count = 600;
    let terms = (0..count).map(|i| {
        let x = on.at_angle(PI * (f64::from(i) + 0.5) / f64::from(count));
        let p = pressure.estimate(x, &mut Cost::default()).unwrap().value;
        p * on.chebyshev_weight(x) * f(x)
    });
    PI / f64::from(count) * terms.sum::<f64>()
}

#[test]
fn what_each_contact_bears() {
    for scene in scenes() {
        let (name, want) = (scene.name, several(scene.name));
        let solution = scene.solve(scene.load);
        let contacts = solution.contacts().unwrap();
        assert_eq!(contacts.len(), want.loads.len(), "{name}");
        let (mut total, mut moment, mut highest) = (0.0, 0.0, 0.0f64);
        let mut worst = [0.0f64; 3];
        for (i, (region, load)) in contacts.iter().zip(&want.loads).enumerate() {
            let on = solution.intervals()[i];
            assert_eq!(region.interval, on);
            assert_eq!(region.half_width(), on.half_width());
            worst[0] = worst[0].nan_max((region.load / load - 1.0).abs());
            let own = sum(&solution, on, |_| 1.0);
            assert!((region.load / own - 1.0).abs() < 1e-13, "{name}");
            let centre = sum(&solution, on, |x| x - on.centre()) / own;
            let got = region.centre_of_pressure().unwrap() - on.centre();
            worst[1] = worst[1].nan_max((got - centre).abs() / on.half_width());
            let mean = region.load / (on.right - on.left);
            assert!((region.mean_pressure() / mean - 1.0).abs() < 1e-14);
            (total, moment) = (total + region.load, moment + region.moment());
            let largest =
                |top: f64, p: &[f64; 2]| if on.contains(p[0]) { top.max(p[1]) } else { top };
            let highest_kept = want.points.iter().fold(0.0, largest);
            match region.peak {
                Some(peak) => {
                    assert!(on.contains(peak.x) && peak.pressure >= highest_kept * (1.0 - 1e-9));
                    // No pressure is larger.
                    let pressure = solution.pressure().unwrap();
                    for j in 1..200 {
                        let x = on.at_angle(PI * f64::from(j) / 200.0);
                        let p = pressure.estimate(x, &mut Cost::default()).unwrap().value;
                        assert!(p <= peak.pressure * (1.0 + 1e-12), "{name}: P({x})");
                    }
                    highest = highest.max(peak.pressure);
                }
                None => assert!(i == 0 && scene.edges[0] != Edge::Free, "{name}"),
            }
        }
        let load = solution.load();
        assert_eq!(load, scene.load);
        let reach = solution.a().abs().max(solution.b().abs());
        worst[2] = (total / load - 1.0).abs();
        println!(
            "{name:24} loads {:.1e}, centres {:.1e}, sum {:.1e}",
            worst[0], worst[1], worst[2]
        );
        assert!(worst[0] < 1e-11 && worst[1] < 1e-12 && worst[2] < 1e-13, "{name}");
        let all: f64 = contacts.iter().map(|one| sum(&solution, one.interval, |x| x)).sum();
        assert!((moment - all).abs() < 1e-12 * load * reach, "{name}");
        assert!((solution.moment().unwrap() - all).abs() < 1e-12 * load * reach, "{name}");
        let centre = solution.centre_of_pressure().unwrap();
        assert!((centre - all / load).abs() < 1e-12 * reach, "{name}");
        let widths: f64 = contacts.iter().map(|one| 2.0 * one.half_width()).sum();
        assert!((solution.mean_pressure() * widths / load - 1.0).abs() < 1e-14, "{name}");
        match solution.peak() {
            Ok(peak) => assert_eq!(peak.pressure, highest, "{name}"),
            Err(error) => assert_eq!(
                error,
                ContactError::Evaluation(EvaluationError::Singular { x: -1.0 }),
                "{name}"
            ),
        }
    }
}

/// A single contact has one region.
#[test]
fn one_contact_is_a_region_too() {
    let form = Hertz::new(0.7, 0.3).unwrap();
    let body = body(&form, -1.0, 1.0).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap().kappa(KAPPA);
    let solution = contact.solve(Control::Load(form.load(KAPPA))).unwrap();
    let contacts = solution.contacts().unwrap();
    let [region] = contacts[..] else { panic!("{contacts:?}") };
    assert_eq!((region.interval, region.load), (solution.hull(), solution.load()));
    assert_eq!(region.edge_singularities, solution.edge_singularities());
    assert_eq!(region.peak, solution.peak().ok());
    assert!(region.centre_of_pressure().unwrap().abs() < 1e-14 * 0.3);
}

/// The strength of the corner is the limit of the pressure there, relative to its own contact.
#[test]
fn the_singularity_of_a_corner() {
    let scenes = scenes();
    let scene = scenes.last().unwrap();
    let solution = scene.solve(scene.load);
    let contacts = solution.contacts().unwrap();
    let first = contacts[0];
    let strengths = solution.edge_singularities();
    let strength = strengths.left;
    assert_eq!((first.edge_singularities, strengths.right), (strengths, 0.0));
    assert!(contacts[1..].iter().all(|one| one.edge_singularities == Ends::both(0.0)));
    let (on, pressure) = (first.interval, solution.pressure().unwrap());
    let at = |share: f64| {
        let x = on.left + share * on.half_width();
        let sine = on.chebyshev_weight(x) / on.half_width();
        (sine * pressure.at(x).unwrap(), sine)
    };
    // P sin θ is strength + c sin²θ.
    let ((one, s1), (two, s2)) = (at(1e-4), at(4e-4));
    let limit = (one * s2 * s2 - two * s1 * s1) / (s2 * s2 - s1 * s1);
    assert!((limit / strength - 1.0).abs() < 1e-6, "{limit}, {strength}");
    assert!(matches!(
        pressure.at(-1.0),
        Err(ContactError::Evaluation(EvaluationError::Singular { x: -1.0 }))
    ));
}

type Map<T> = PolynomialMap<T, Hertz<T>>;

fn map<T: Real>(count: usize, share: f64) -> Map<T> {
    let hertz = Hertz::new(T::of(0.7), T::of(0.3)).unwrap();
    PolynomialMap::new(hertz, count, T::of(0.3 * share), T::one()).unwrap()
}

/// Returns v and v' of a map, by Chebyshev's recurrence.
fn chebyshev<T: Real>(form: &Map<T>, x: T) -> [T; 2] {
    let two = T::of(2.0);
    let (mut before, mut here) = ([T::one(), T::zero()], [x, T::one()]);
    for _ in 1..form.contacts().len() {
        let [value, slope] = here;
        let after = [two * x * value - before[0], two * (value + x * slope) - before[1]];
        (before, here) = (here, after);
    }
    here.map(|value| form.amplitude() * value)
}

/// Returns the contacts of a map, each with the relative error of its load against an equal share.
fn shares(form: &dyn ClosedForm<f64>, count: usize) -> Vec<(ContactRegion<f64>, f64)> {
    let reach = (2.0 / count as f64).cosh();
    let body = body(form, -reach, reach).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap().kappa(KAPPA);
    let load = form.load(KAPPA);
    let solution = contact.solve(Control::Load(load)).unwrap();
    let regions = solution.contacts().unwrap();
    assert_eq!(regions.len(), count);
    let off = |region: &ContactRegion<f64>| (region.load * count as f64 / load - 1.0).abs();
    regions.iter().map(|region| (*region, off(region))).collect()
}

#[test]
fn each_contact_of_a_map_bears_its_share() {
    for count in [2usize, 3, 5] {
        for share in [1.1, 3.0] {
            for (_, off) in shares(&map::<f64>(count, share), count) {
                assert!(off < 1e-12, "{count}, {share}: {off:e}");
            }
        }
        // A kink inside each.
        let wedge = Wedge::unequal(0.2, 0.3, 0.4).unwrap();
        let form = PolynomialMap::new(wedge, count, 0.7, 1.0).unwrap();
        for (region, off) in shares(&form, count) {
            assert!(off < 3e-13, "wedge {count}: {off:e}");
            assert_eq!(region.peak, None);
        }
    }
}

#[test]
fn rates_of_all_limits() {
    for scene in scenes() {
        let (name, load) = (scene.name, scene.load);
        let solution = scene.solve(load);
        let rates = solution.load_rates().unwrap();
        let contacts = solution.intervals();
        assert_eq!(rates.limits.len(), contacts.len(), "{name}");
        assert_eq!(
            [rates.b, rates.a],
            [-rates.limits[0].left, rates.limits[contacts.len() - 1].right]
        );
        let mut worst = [0.0f64; 3];
        for (i, Ends { left, right }) in rates.limits.iter().enumerate() {
            let want = [
                difference(|load| scene.solve(load).intervals()[i].left, load),
                difference(|load| scene.solve(load).intervals()[i].right, load),
            ];
            let size = contacts[i].half_width() / load;
            worst[0] = worst[0].nan_max((left - want[0]).abs() / size);
            worst[0] = worst[0].nan_max((right - want[1]).abs() / size);
            let corner = i == 0 && scene.edges[0] != Edge::Free;
            assert!(*left < 0.0 || corner && *left == 0.0, "{name}");
            assert!(*right > 0.0, "{name}");
        }
        let mut total = 0.0;
        for &on in contacts {
            for share in [0.2, 0.5, 0.83] {
                let x = on.left + share * (on.right - on.left);
                let want =
                    difference(|load| scene.solve(load).pressure().unwrap().at(x).unwrap(), load);
                worst[1] = worst[1].nan_max((rates.pressure(x).unwrap() / want - 1.0).abs());
            }
            let terms = (0..200).map(|i| {
                let x = on.at_angle(PI * (f64::from(i) + 0.5) / 200.0);
                let rate = rates.pressure(x).unwrap();
                assert!(rate > 0.0, "{name}: ∂P/∂F at {x} is {rate}");
                rate * on.chebyshev_weight(x)
            });
            total += PI / 200.0 * terms.sum::<f64>();
            for x in [on.left, on.right] {
                assert_eq!(
                    rates.pressure(x),
                    Err(ContactError::Evaluation(EvaluationError::Singular { x })),
                    "{name}"
                );
            }
        }
        worst[2] = (total - 1.0).abs();
        println!("{name:24} rates {:.1e}, of P {:.1e}, sum {:.1e}", worst[0], worst[1], worst[2]);
        assert!(worst[0] < 1e-7 && worst[1] < 1e-7 && worst[2] < 1e-12, "{name}");
        for pair in contacts.windows(2) {
            assert_eq!(rates.pressure(0.5 * (pair[0].right + pair[1].left)), Ok(0.0), "{name}");
        }
        assert_eq!(rates.pressure(-9.0), Ok(0.0));
        assert_eq!(rates.pressure(9.0), Ok(0.0));
        assert!(matches!(
            rates.pressure(f64::NAN),
            Err(ContactError::Evaluation(EvaluationError::InvalidPosition { .. }))
        ));
    }
}

/// `x⁴ - 2x²` and maps: the punches in closed form, `|v'|/(N π sqrt(L² - v²))`.
#[test]
fn rates_in_closed_form() {
    let scene = &scenes()[0];
    for load in [1e-4, 0.1, 1.0, 3.0] {
        let solution = scene.solve(load);
        let rates = solution.load_rates().unwrap();
        let d = (4.0 * load / PI).sqrt();
        let [inner, outer] = [(1.0 - d / 2.0).sqrt(), (1.0 + d / 2.0).sqrt()];
        // α² = 1 - d/2, and d' = d/(2F).
        let want = [inner, outer].map(|limit| d / (8.0 * load * limit));
        let [first, second] = rates.limits[..] else { panic!("{rates:?}") };
        for (got, want) in
            [(first.right, want[0]), (second.left, -want[0]), (second.right, want[1])]
        {
            assert!((got / want - 1.0).abs() < 1e-11, "F = {load}: {got}, {want}");
        }
        for i in 1..20 {
            let on = Interval { left: inner, right: outer };
            let x = on.at_angle(PI * f64::from(i) / 20.0);
            let root = on.chebyshev_weight(x) * ((x + inner) * (x + outer)).sqrt();
            let error = rates.pressure(-x).unwrap() * PI * root / x - 1.0;
            assert!(error.abs() < 1e-10, "F = {load}, x = {x}: {error:e}");
        }
    }
    for count in [2usize, 3, 8] {
        let form = map::<f64>(count, 1.1);
        let reach = (2.0 / count as f64).cosh();
        let body = body(&form, -reach, reach).unwrap();
        let contact = Contact::new(&Flat, &body).unwrap().kappa(KAPPA);
        let solution = contact.solve(Control::Load(form.load(KAPPA))).unwrap();
        let rates = solution.load_rates().unwrap();
        for on in solution.intervals() {
            for i in 1..10 {
                let x = on.at_angle(PI * f64::from(i) / 10.0);
                let [v, slope] = chebyshev(&form, x);
                let want = slope.abs() / (count as f64 * PI * (0.09 - v * v).sqrt());
                let error = rates.pressure(x).unwrap() / want - 1.0;
                assert!(error.abs() < 1e-10, "{count}: {error:e}");
            }
        }
    }
}

/// The gap of a map is Hertz's gap at v, over N.
#[test]
fn the_gap_between_contacts_and_beside_them() {
    for (count, share) in [(2usize, 1.1), (2, 3.0), (3, 1.1), (3, 3.0), (5, 2.0)] {
        let form = map::<f64>(count, share);
        let reach = (2.0 / count as f64).cosh();
        let body = body(&form, -reach, reach).unwrap();
        let contact = Contact::new(&Flat, &body).unwrap().kappa(KAPPA);
        let solution = contact.solve(Control::Load(form.load(KAPPA))).unwrap();
        let contacts = solution.intervals();
        let mut places = vec![[-reach, contacts[0].left]];
        places.extend(contacts.windows(2).map(|pair| [pair[0].right, pair[1].left]));
        places.push([contacts[count - 1].right, reach]);
        let heights: f64 =
            places.iter().flatten().map(|&x| form.height(x).abs()).fold(0.0, f64::max);
        let n = count as f64;
        let mut worst = [0.0f64; 2];
        for [from, to] in places {
            for i in 1..16 {
                let x = from + (to - from) * f64::from(i) / 16.0;
                let [v, rise] = chebyshev(&form, x);
                let gap = form.form().gap(v) / n;
                worst[0] = worst[0].nan_max((solution.gap_at(x).unwrap() - gap).abs() / heights);
                let slope = (v * v - 0.09).sqrt().copysign(v) / 0.7 * rise / n;
                let size = form.slope(x).abs().max(0.3 / 0.7);
                worst[1] = worst[1].nan_max((solution.gap_slope(x).unwrap() - slope).abs() / size);
            }
        }
        println!("{count}, {share}: gap {:.1e}, slope {:.1e}", worst[0], worst[1]);
        assert!(worst[0] < 1e-13 && worst[1] < 1e-12, "{count}, {share}");
        for on in contacts {
            for x in [on.left, on.right] {
                assert_eq!(solution.gap_at(x), Ok(0.0));
                assert_eq!(solution.gap_slope(x), Ok(0.0));
            }
            let x = on.centre();
            let inside = ContactError::Evaluation(EvaluationError::InvalidPosition {
                x,
                inside: false,
                interval: *on,
            });
            assert_eq!(solution.gap_at(x), Err(inside.clone()));
            assert_eq!(solution.gap_slope(x), Err(inside));
        }
        // Each gap closes at both its ends.
        for pair in contacts.windows(2) {
            let near = pair[1].left - 1e-9 * pair[1].half_width();
            assert!(solution.gap_at(near).unwrap().abs() < 1e-13 * heights);
        }
    }
}

#[test]
fn the_equation_is_met_in_each_contact() {
    for scene in scenes() {
        let solution = scene.solve(scene.load);
        let mean = solution.mean_pressure();
        let mut worst = 0.0f64;
        for on in solution.intervals() {
            for i in 0..8 {
                let x = on.at_angle(PI * (f64::from(i) + 0.37) / 8.0);
                worst = worst.nan_max(solution.residual(x).unwrap().abs() / mean);
            }
        }
        println!("{:24} residual {worst:.1e} of the mean pressure", scene.name);
        assert!(worst < 1e-10, "{}: {worst:e}", scene.name);
        for pair in solution.intervals().windows(2) {
            for x in [pair[0].right, 0.5 * (pair[0].right + pair[1].left), pair[1].left] {
                let refused = matches!(
                    solution.residual(x),
                    Err(ContactError::Evaluation(EvaluationError::InvalidPosition {
                        inside: true,
                        ..
                    }))
                );
                assert!(refused, "{}: {x}", scene.name);
            }
        }
    }
}

/// Stress is additive: below two contacts it is the sum of the stresses below each.
#[test]
fn the_stress_below_is_the_sum_of_all() {
    for scene in scenes() {
        let solution = scene.solve(scene.load);
        let top = solution.mean_pressure();
        let mu = 0.3;
        let below = solution.subsurface().unwrap().friction(mu).unwrap();
        let hull = solution.hull();
        let least = solution.intervals().iter().map(|on| on.half_width()).fold(f64::MAX, f64::min);
        let mut worst = 0.0f64;
        for i in 0..6 {
            for depth in [0.4 * least, least, hull.half_width()] {
                let x = hull.left + hull.half_width() * 0.39 * f64::from(i);
                let a: [f64; 4] = std::array::from_fn(|k| {
                    let k = k as i32;
                    let term = |s: f64| {
                        let square = (x - s).powi(2) + depth * depth;
                        depth.powi(3 - k) * (x - s).powi(k) / (square * square)
                    };
                    solution.intervals().iter().map(|&on| sum(&solution, on, term)).sum()
                });
                let got = below.at(x, depth).unwrap();
                for (got, want) in [
                    (got.sigma_x, a[2] + mu * a[3]),
                    (got.sigma_y, a[0] + mu * a[1]),
                    (got.tau_xy, a[1] + mu * a[2]),
                ] {
                    worst = worst.nan_max((got + 2.0 / PI * want).abs() / top);
                }
            }
        }
        println!("{:24} stress {worst:.1e} of the mean pressure", scene.name);
        assert!(worst < 1e-11, "{}: {worst:e}", scene.name);
        // On the surface of a gap there is no normal stress; friction alone stretches it.
        let pair = &solution.intervals()[..2];
        let x = 0.5 * (pair[0].right + pair[1].left);
        let free = solution.subsurface().unwrap().at(x, 0.0).unwrap();
        assert_eq!([free.sigma_x, free.sigma_y, free.tau_xy], [0.0; 3]);
        let pulled = below.at(x, 0.0).unwrap();
        let term = |s: f64| 1.0 / (x - s);
        let pull: f64 = solution.intervals().iter().map(|&on| sum(&solution, on, term)).sum();
        assert!((pulled.sigma_x + 2.0 / PI * mu * pull).abs() < 1e-11 * top, "{}", scene.name);
        assert_eq!([pulled.sigma_y, pulled.tau_xy], [0.0; 2]);
    }
}

/// Far apart, the largest shear is Hertz's below either bump.
#[test]
fn the_largest_shear_below_two_bumps() {
    let load = 1e-7;
    let solution_of = &scenes()[0];
    let solution = solution_of.solve(load);
    let largest = solution.subsurface().unwrap().max_shear().unwrap();
    let peak = solution.peak().unwrap().pressure;
    assert!((largest.value / peak - 0.3002831).abs() < 1e-4, "{largest:?}");
    let half_width = solution.intervals()[0].half_width();
    assert!((largest.depth / half_width - 0.7861514).abs() < 1e-2, "{largest:?}");
}

#[test]
fn pressures_at_limits_and_in_gaps() {
    for scene in scenes() {
        let solution = scene.solve(scene.load);
        let pressure = solution.pressure().unwrap();
        let contacts = solution.intervals();
        let (mut x, mut want) = (Vec::new(), Vec::new());
        for on in contacts {
            for x in [on.left, on.right] {
                if x == -1.0 && scene.edges[0] != Edge::Free {
                    continue;
                }
                assert_eq!(pressure.at(x), Ok(0.0), "{}", scene.name);
                // Just inside, the pressure is small, or cannot be told from rounding.
                let inward = if x == on.left { 1e-12 } else { -1e-12 } * on.half_width();
                match pressure.at(x + inward) {
                    Ok(p) => assert!(p > 0.0 && p < 1e-4 * solution.mean_pressure()),
                    Err(error) => assert!(matches!(
                        error,
                        ContactError::Evaluation(EvaluationError::Unresolved { .. })
                    )),
                }
            }
        }
        for pair in contacts.windows(2) {
            let [from, to] = [pair[0].right, pair[1].left];
            for share in [1e-9, 0.5, 1.0 - 1e-9] {
                let place = from + share * (to - from);
                let gap = pressure.estimate(place, &mut Cost::default()).unwrap();
                assert_eq!([gap.value, gap.error], [0.0; 2], "{}", scene.name);
                x.push(place);
                want.push(0.0);
            }
        }
        // In any order, with any neighbours.
        for i in 0..40 {
            let on = contacts[i % contacts.len()];
            x.push(on.at_angle(PI * (i as f64 + 0.5) / 40.0));
            want.push(pressure.estimate(x[x.len() - 1], &mut Cost::default()).unwrap().value);
        }
        let order: Vec<usize> = (0..x.len()).map(|i| (i * 17) % x.len()).collect();
        let places: Vec<f64> = order.iter().map(|&i| x[i]).collect();
        let mut got = vec![f64::NAN; x.len()];
        pressure.at_many(&places, &mut got).unwrap();
        for (&i, got) in order.iter().zip(&got) {
            assert!((got - want[i]).abs() <= 1e-13 * want[i], "{}: P({})", scene.name, x[i]);
        }
        for outside in [9.0, -9.0, f64::NAN, f64::INFINITY] {
            let refused =
                |error| matches!(error, ContactError::Solve(SolveError::OutsideBodies { .. }));
            assert!(refused(pressure.at(outside).unwrap_err()));
            let mut out = [0.0; 2];
            let mixed = [contacts[0].centre(), outside];
            assert!(refused(pressure.at_many(&mixed, &mut out).unwrap_err()));
        }
    }
}

/// A solution stays valid while its solver goes on, and so does a clone.
#[test]
fn rates_of_kept_solutions() {
    let scene = &scenes()[1];
    let contact = scene.contact();
    let mut solver = Solver::new();
    let first = solver.solve(&contact, Control::Load(1.0)).unwrap();
    let want = first.load_rates().unwrap();
    solver.solve(&contact, Control::Load(2.0)).unwrap();
    assert_eq!(first.load_rates().unwrap(), want);
    let cold = scene.solve(1.0).load_rates().unwrap();
    assert!((cold.a / want.a - 1.0).abs() < 1e-12);
}

#[test]
fn in_single_precision_estimates_are_honest() {
    let kappa = KAPPA as f32;
    let quartic = |load| Quartic::under_load(1.0f32, 1.0, load, kappa).unwrap();
    let forms: [(Box<dyn ClosedForm<f32>>, f32); 5] = [
        (Box::new(quartic(0.1)), 2.0),
        (Box::new(quartic(0.5)), 2.0),
        (Box::new(quartic(0.9 * 2.0 * kappa)), 2.0),
        (Box::new(map::<f32>(3, 1.1)), (2.0f32 / 3.0).cosh()),
        (Box::new(map::<f32>(3, 3.0)), (2.0f32 / 3.0).cosh()),
    ];
    for (i, (form, reach)) in forms.into_iter().enumerate() {
        let body = body(&*form, -reach, reach).unwrap();
        let contact = Contact::new(&Flat, &body).unwrap().kappa(kappa);
        let load = form.load(kappa);
        let solution = contact.solve(Control::Load(load)).unwrap();
        let (got, want) = (solution.contacts().unwrap(), form.contacts());
        assert_eq!(got.len(), want.len(), "{i}");
        let said = solution.limits_error().unwrap();
        let mut off = 0.0f32;
        for (got, want) in got.iter().zip(&want) {
            let error = (got.interval.left - want.left)
                .abs()
                .nan_max((got.interval.right - want.right).abs());
            off = off.nan_max(error / want.half_width());
            let bears = got.load * (solution.intervals().len() as f32) / load - 1.0;
            assert!(bears.abs() < 1e-3f32.max(10.0 * said), "{i}: {bears:e}");
        }
        println!("{i}: limits off by {off:.1e}, said {said:.1e}");
        assert!(off < 1e-6f32.max(2.0 * said) && said < 1e-2, "{i}: {off:e}, said {said:e}");
        let pressure = solution.pressure().unwrap();
        let peak = solution.peak().unwrap().pressure;
        for on in &want {
            for j in 1..16 {
                let x = on.at_angle(std::f32::consts::PI * (j as f32) / 16.0);
                let found = pressure.estimate(x, &mut Cost::default()).unwrap();
                let off = (found.value - form.pressure(x, kappa)).abs();
                assert!(off < 3.0 * found.error + 1e-5 * peak, "{i}: P({x}) {off:e}, {found:?}");
            }
        }
        let rates = solution.load_rates().unwrap();
        assert!(rates.limits.iter().all(|rates| rates.left < 0.0 && rates.right > 0.0));
    }
}

/// A pin in a hole up to 75°: both surfaces are steep there, and the gap between them is not.
#[test]
fn steepness_of_a_pin_in_a_hole() {
    let arc = |radius: f64| Ellipse::circle(radius, [-1.5, 1.5]).unwrap();
    let (pin, hole) = (arc(10.0), arc(10.01));
    for (degrees, steep) in [(75.0f64, true), (10.0, false)] {
        let half_width = 10.0 * degrees.to_radians().sin();
        let contact = Contact::new(&hole, &pin).unwrap();
        let solution = contact.solve(Control::HalfWidth(half_width)).unwrap();
        assert_eq!(solution.is_steep(), steep);
        assert_eq!(solution.steepest_slope().unwrap() > linecontact::STEEPEST_HALF_PLANE, steep);
    }
}

/// Steepness counts the slopes in each contact only, whatever was sampled before.
#[test]
fn steepness_of_several_contacts() {
    let body = |scale: f64| {
        graph(-2.0, 2.0, move |x: f64| {
            [scale * x * x * (x * x - 2.0), 4.0 * scale * x * (x * x - 1.0)]
        })
    };
    for (scale, steep) in [(0.01, false), (1.0, true)] {
        let body = body(scale);
        let contact = Contact::new(&Flat, &*body).unwrap();
        let solution = contact.solve(Control::Load(0.3 * scale)).unwrap();
        assert_eq!(solution.intervals().len(), 2);
        assert_eq!(solution.is_steep(), steep);
        assert_eq!(solution.steepest_slope().unwrap() > linecontact::STEEPEST_HALF_PLANE, steep);
    }
}
