//! Punches held at both corners: both must press, without tension between them.
#![allow(missing_docs)]

use crate::common::{Profile, Shares, graph, intervals, on_flat};
use crate::corners::polygon;
use approx::assert_relative_eq;
use linecontact::profile::Ellipse;
use linecontact::quadrature::Quadrature;
use linecontact::search::Brent;
use linecontact::{
    Contact, ContactError, Control, Cost, Edge, Flat, InputError, Interval, Midpoint, Outcome,
    Panels, Solution, SolveError,
};
use std::f64::consts::PI;

fn fixed<'b>(contact: &Contact<'b, f64>, half: f64) -> Contact<'b, f64> {
    contact.clone().edges(Edge::Fixed(-half), Edge::Fixed(half))
}

/// Returns three crests between two corners.
fn wavy() -> Contact<'static, f64> {
    let k = 4.0 * PI;
    on_flat(graph(-1.5, 1.5, move |x| [-0.01 * (k * x).cos(), 0.01 * k * (k * x).sin()]))
}

/// Hertz: the contact is far narrower than the distance of the corners.
#[test]
fn a_roller_held_beyond_its_contact_lifts_off() {
    let roller = Ellipse::circle(10.0, [-1.0, 1.0]).unwrap();
    let contact = Contact::new(&Flat, &roller).unwrap().contact_modulus(115e3);
    let held = contact.edges(Edge::Fixed(-5.0), Edge::Fixed(5.0));
    let midpoint = Midpoint::DEFAULT;
    let quadratures: [&dyn Quadrature<f64>; 2] = [&Panels::FULL, &midpoint];
    for quadrature in quadratures {
        let held = held.clone().quadrature(quadrature);
        let error = held.solve(Control::Load(500.0)).map(|s| s.hull()).unwrap_err();
        assert!(matches!(error, ContactError::Solve(SolveError::LiftsOff { .. })), "{error}");
        let alone = held.single_interval(true).solve(Control::Load(500.0)).unwrap();
        assert!(!alone.report().is_checked() && alone.edge_singularities().left < 0.0);
        assert!(alone.to_string().contains(", not checked"), "{alone}");
    }
}

#[test]
fn a_wavy_punch_touches_in_several_places_between_its_corners() {
    let contact = wavy();
    let until = contact.clone().edges(Edge::FreeUntil(-0.5), Edge::FreeUntil(0.5));
    for load in [0.01, 0.03] {
        let load = Control::Load(load);
        let [found, known] = [&fixed(&contact, 0.5), &until]
            .map(|contact| contact.solve(load).unwrap_or_else(|error| panic!("{load:?}: {error}")));
        assert!(found.report().is_checked() && found.intervals().len() == 3, "{found}");
        assert_eq!(found.hull().left, -0.5);
        for (found, known) in found.intervals().iter().zip(known.intervals()) {
            assert_relative_eq!(found.left, known.left, epsilon = 1e-12);
            assert_relative_eq!(found.right, known.right, epsilon = 1e-12);
        }
        // As a single interval it would solve the equation with tension.
        let alone = fixed(&contact, 0.5).single_interval(true).solve(load).unwrap();
        let pressure = alone.pressure().unwrap();
        assert!(pressure.at(0.25).unwrap() < 0.0 && !alone.report().is_checked());
        assert_eq!(alone.report().attempts().last().unwrap().outcome, Outcome::Unchecked);
        // The paper's rule, and a user's search, know only one contact.
        let (rule, brent) = (Midpoint::DEFAULT, Brent::DEFAULT);
        for one in
            [fixed(&contact, 0.5).quadrature(&rule), fixed(&contact, 0.5).limit_search(&brent)]
        {
            let error = one.solve(load).map(|s| s.hull()).unwrap_err();
            assert!(matches!(error, ContactError::Solve(SolveError::Tension { .. })), "{error}");
        }
    }
}

/// P = (F - κ m x)/(π sqrt(l² - x²)) of a tilted flat, by any quadrature.
#[test]
fn a_tilted_punch_holds_at_both_corners_up_to_its_tilt() {
    let midpoint = Midpoint::DEFAULT;
    let quadratures: [&dyn Quadrature<f64>; 2] = [&Panels::FULL, &midpoint];
    for (quadrature, m) in quadratures.into_iter().flat_map(|q| [(q, 0.3), (q, -0.3)]) {
        let contact = on_flat(graph(-1.0, 1.0, move |x| [m * x, m])).quadrature(quadrature);
        for (load, holds) in [(0.151, true), (0.149, false), (1e-3, false), (10.0, true)] {
            let found = fixed(&contact, 0.5).solve(Control::Load(load));
            match found {
                Ok(solution) => {
                    assert!(holds && solution.report().is_checked(), "{load}");
                    let exact = load / (PI * 0.5);
                    assert_relative_eq!(
                        solution.pressure().unwrap().at(0.0).unwrap(),
                        exact,
                        max_relative = 1e-9
                    );
                }
                Err(ContactError::Solve(SolveError::LiftsOff { x, .. })) => {
                    assert!(!holds);
                    assert_eq!(x, 0.5 * m.signum());
                }
                Err(error) => panic!("{load}: {error}"),
            }
        }
    }
}

#[test]
fn only_a_load_that_presses_makes_sense_unless_one_interval_is_asked_for() {
    let flat = on_flat(graph(-1.0, 1.0, |_| [0.0, 0.0]));
    for load in [0.0, -1.0, f64::NAN, f64::INFINITY, 1e-310] {
        let solve = |single| {
            let contact = fixed(&flat, 0.5).single_interval(single);
            contact.solve(Control::Load(load)).map(|s| s.hull())
        };
        let refused = |found: Result<_, _>| {
            matches!(found, Err(ContactError::Input(InputError::InvalidLoad { .. })))
        };
        assert!(refused(solve(false)), "{load}: {:?}", solve(false));
        assert!(solve(true).is_ok() || refused(solve(true)), "{load}: {:?}", solve(true));
        assert_eq!(solve(true).is_ok(), load.is_finite(), "{load}");
        // The remedy belongs to a load between two corners only.
        let remedy = solve(false).unwrap_err().to_string().contains("single_interval(true)");
        let sought = flat.clone().solve(Control::Load(-1.0)).map(drop).unwrap_err();
        assert!(remedy && !sought.to_string().contains("single_interval"), "{sought}");
    }
}

/// A solver that holds several contacts refuses corners beyond the bodies as well.
#[test]
fn of_two_edges_the_one_that_is_nowhere_is_named() {
    let said = |left, right| {
        let body = Ellipse::circle(1.0, [-0.5, 0.5]).unwrap();
        let contact = on_flat(Box::new(body)).edges(left, right);
        contact.solve(Control::Load(0.1)).unwrap_err().to_string()
    };
    let error = said(Edge::Fixed(f64::NAN), Edge::Free);
    assert!(error.contains("-b = NaN to a = 0.479426"), "{error}");
    let error = said(Edge::Fixed(-0.25), Edge::FreeUntil(f64::INFINITY));
    assert!(error.contains("-b = -0.25 to a = inf"), "{error}");
}

#[test]
fn corners_beyond_the_bodies_are_named_by_a_solver_too() {
    let contact = wavy();
    let mut solver = linecontact::Solver::new();
    let load = Control::Load(0.03);
    for edges in [[Edge::Fixed(-0.5), Edge::Fixed(2.0)], [Edge::FreeUntil(-0.5), Edge::Fixed(2.0)]]
    {
        assert_eq!(solver.solve(&fixed(&contact, 0.5), load).unwrap().intervals().len(), 3);
        let beyond = contact.clone().edges(edges[0], edges[1]);
        let error = solver.solve(&beyond, load).map(|s| s.hull()).unwrap_err();
        assert!(
            matches!(error, ContactError::Solve(SolveError::OutsideBodies { x: 2.0, .. })),
            "{error}"
        );
    }
}

/// The next load takes no evaluation of the curves, for several contacts too.
#[test]
fn a_second_solve_takes_no_evaluations() {
    let tilted = on_flat(graph(-1.0, 1.0, |x| {
        [0.1 * x - x * x / 8.0 + 0.01 * (5.0 * x).sin(), 0.1 - x / 4.0 + 0.05 * (5.0 * x).cos()]
    }));
    for (contact, loads) in [(tilted, [1.0, 1.1, 2.0]), (wavy(), [0.1, 0.101, 0.102])] {
        let mut solver = linecontact::Solver::new();
        for (i, load) in loads.into_iter().enumerate() {
            let solution = solver.solve(&fixed(&contact, 0.5), Control::Load(load)).unwrap();
            assert!(solution.report().is_checked());
            assert_eq!(solution.cost().evaluations == 0, i > 0, "{load}: {}", solution.cost());
        }
    }
}

/// Punch between two corners: flat, tilted, crowned or hollow, wavy.
struct Punch {
    tilt: f64,
    crown: f64,
    waves: Vec<[f64; 3]>,
    ends: [f64; 2],
    beyond: f64,
    kappa: f64,
    load: f64,
}

impl Punch {
    fn random(seed: u64) -> Self {
        let mut random = Shares(seed);
        (0..8).for_each(|_| _ = random.between(0.0, 1.0));
        let mut any = |from, to| random.between(from, to);
        let half = 10f64.powf(any(-1.0, 1.0));
        let centre = half * any(-2.0, 2.0);
        let kind = (any(0.0, 6.0)) as usize;
        let slope = 10f64.powf(any(-3.0, -0.5));
        let tilt = if kind % 2 == 1 { slope * any(-1.0, 1.0) } else { 0.0 };
        let crown = if kind >= 2 { slope / half * any(-1.0, 1.0) } else { 0.0 };
        let count = if kind >= 3 { 1 + any(0.0, 3.0) as usize } else { 0 };
        let wave = |_| {
            let k = PI / half * any(0.5, 5.0);
            [slope / k * any(0.1, 1.0), k, any(0.0, 2.0 * PI)]
        };
        let waves = (0..count).map(wave).collect();
        let kappa = 10f64.powf(any(-2.0, 5.0));
        let load = kappa * slope * half * 10f64.powf(any(-2.0, 1.0));
        let beyond = half * if any(0.0, 1.0) < 0.5 { 0.0 } else { any(0.1, 1.0) };
        Self { tilt, crown, waves, ends: [centre - half, centre + half], beyond, kappa, load }
    }

    fn at(&self, x: f64) -> [f64; 2] {
        let z = x - 0.5 * (self.ends[0] + self.ends[1]);
        let mut at = [self.tilt * z + 0.5 * self.crown * z * z, self.tilt + self.crown * z];
        for &[size, k, phase] in &self.waves {
            at[0] += size * (k * z + phase).sin();
            at[1] += size * k * (k * z + phase).cos();
        }
        at
    }

    fn body(&self) -> Profile {
        let Self { tilt, crown, ref waves, ends, beyond, kappa, load } = *self;
        let copy = Self { tilt, crown, waves: waves.clone(), ends, beyond, kappa, load };
        graph(ends[0] - beyond, ends[1] + beyond, move |x| copy.at(x))
    }
}

/// Outcome of a scene.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    Right,
    Refused,
    Wrong,
}

/// Pressure of several contacts: for each its interval, and the coefficients of `P sin θ L` as a
/// cosine series.
struct Pushed(Vec<(Interval<f64>, Vec<f64>)>);

impl Pushed {
    /// Returns ∫ P ln|x - s| ds, by ∫ cos nφ ln|z - cos φ| dφ = -(π/n) ρⁿ with z = (ρ + 1/ρ)/2, |ρ|
    /// <= 1.
    fn potential(&self, x: f64) -> f64 {
        let of = |(on, series): &(Interval<f64>, Vec<f64>)| {
            let l = on.half_width();
            let z = (x - on.centre()) / l;
            let power = |n: f64| {
                if on.contains(x) {
                    (n * on.angle(x)).cos()
                } else {
                    let rho = z.signum() * (z.abs() - (z * z - 1.0).sqrt());
                    rho.powf(n)
                }
            };
            let far = if on.contains(x) { 0.5 } else { 0.5 * (z.abs() + (z * z - 1.0).sqrt()) };
            let mut sum = PI * series[0] * (l * far).ln();
            let mut rho = 1.0;
            for (n, c) in series.iter().enumerate().skip(1) {
                let n = n as f64;
                rho = if on.contains(x) { power(n) } else { rho * power(1.0) };
                sum -= PI / n * c * rho;
            }
            sum
        };
        self.0.iter().map(of).sum()
    }
}

/// Describes a violated condition, if any. Only the contact has pressure everywhere, carries the
/// load, closes the gap to one height in all contacts, and leaves more of it elsewhere.
fn fault(punch: &Punch, solution: &Solution<f64>, held: bool) -> Option<String> {
    const COUNT: usize = 512;
    if !solution.report().is_checked() {
        return Some("not checked".to_owned());
    }
    let contacts = intervals(solution);
    let [first, last] = [contacts[0], contacts[contacts.len() - 1]];
    let [left, right] = punch.ends;
    if held && [first.left, last.right] != punch.ends {
        return Some(format!("from {:?} to {:?}", first.left, last.right));
    }
    let pressure = solution.pressure().unwrap();
    let (mut pushed, mut load) = (Pushed(Vec::new()), 0.0);
    for on in &contacts {
        let mut series = vec![0.0; COUNT / 2];
        for i in 0..COUNT {
            let angle = PI * (i as f64 + 0.5) / COUNT as f64;
            let p = pressure.estimate(on.at_angle(angle), &mut Cost::default()).unwrap();
            if p.value < -4.0 * p.error - 1e-9 * punch.load / on.half_width() {
                return Some(format!("P({:?}) = {:e}", on.at_angle(angle), p.value));
            }
            let share = p.value * angle.sin() * on.half_width() / COUNT as f64;
            series[0] += share;
            for (n, c) in series.iter_mut().enumerate().skip(1) {
                *c += 2.0 * share * (n as f64 * angle).cos();
            }
        }
        load += PI * series[0];
        pushed.0.push((*on, series));
    }
    if (load / punch.load - 1.0).abs() > 1e-9 {
        return Some(format!("the pressures add up to {load} of {}", punch.load));
    }
    let size = punch.load / punch.kappa;
    let height = |x: f64| punch.at(x)[0] - pushed.potential(x) / punch.kappa;
    let level = height(first.centre());
    let rounding = 1e-8 * size + 1e-13 * (punch.at(first.left)[0].abs() + level.abs());
    for on in &contacts {
        for i in 0..40 {
            let x = on.at_angle(PI * (f64::from(i) + 0.5) / 40.0);
            if (height(x) - level).abs() > rounding {
                return Some(format!("off by {:e} F/κ at {x:?}", (height(x) - level) / size));
            }
        }
    }
    let nothing = |x| Interval { left: x, right: x };
    let all = [vec![nothing(left)], contacts, vec![nothing(right)]].concat();
    for pair in all.windows(2).filter(|pair| pair[0].right < pair[1].left) {
        // Squared, for a high density where the gap opens. Next to a limit the potential has half
        // of its digits.
        for i in 10..=200 {
            let share = (f64::from(i) / 200.0).powi(2);
            let [from, to] = [pair[0].right, pair[1].left];
            for x in [from + (to - from) * share, to - (to - from) * share] {
                if height(x) < level - rounding {
                    return Some(format!(
                        "overlap of {:e} F/κ at {x:?}",
                        (level - height(x)) / size
                    ));
                }
            }
        }
    }
    None
}

/// Tells whether the contacts are the same, to a share of the narrowest.
fn alike(one: &Solution<f64>, other: &Solution<f64>) -> bool {
    let [one, other] = [one, other].map(intervals);
    let narrowest = one.iter().map(Interval::half_width).fold(f64::INFINITY, f64::min);
    let near = |a: f64, b: f64| (a - b).abs() <= 1e-6 * narrowest;
    let both =
        |(a, b): (&Interval<f64>, &Interval<f64>)| near(a.left, b.left) && near(a.right, b.right);
    one.len() == other.len() && one.iter().zip(&other).all(both)
}

/// Returns the faults of other ways to a correct contact: corners that may be let go, the load at
/// its point of action, and the paper's rule, which knows only one contact.
fn other_ways(
    punch: &Punch,
    held: &Contact<'static, f64>,
    known: &Solution<f64>,
) -> Option<String> {
    let [left, right] = punch.ends;
    let until = held.clone().edges(Edge::FreeUntil(left), Edge::FreeUntil(right));
    let control = Control::Load(punch.load);
    let at = known.centre_of_pressure().unwrap();
    let turned = Control::CentreOfPressure { load: punch.load, at };
    for (name, found) in [("FreeUntil", until.solve(control)), ("centre", held.solve(turned))] {
        match found {
            Ok(found) if alike(&found, known) => {}
            Ok(found) => return Some(format!("{name}: {found}")),
            Err(error) => return Some(format!("{name}: {error}")),
        }
    }
    let rule = Midpoint::DEFAULT;
    match held.clone().quadrature(&rule).solve(control) {
        Ok(found) if alike(&found, known) => None,
        Err(ContactError::Solve(SolveError::Tension { .. })) if known.intervals().len() > 1 => None,
        Ok(found) => Some(format!("Midpoint: {found}")),
        Err(error) => Some(format!("Midpoint: {error}")),
    }
}

/// Judges a random punch by the conditions of contact, with a remark; if a corner lifts, judges the
/// contact without it.
pub fn judge(seed: u64) -> (Verdict, String) {
    let punch = Punch::random(seed);
    let [left, right] = punch.ends;
    let control = Control::Load(punch.load);
    let contact = on_flat(punch.body()).kappa(punch.kappa);
    let held = contact.clone().edges(Edge::Fixed(left), Edge::Fixed(right));
    match held.solve(control) {
        Ok(solution) => {
            let fault = fault(&punch, &solution, true);
            match fault.or_else(|| other_ways(&punch, &held, &solution)) {
                Some(fault) => (Verdict::Wrong, fault),
                None => (Verdict::Right, format!("{} contacts", solution.intervals().len())),
            }
        }
        Err(ContactError::Solve(SolveError::LiftsOff { x, .. })) => {
            let until = contact.edges(Edge::FreeUntil(left), Edge::FreeUntil(right)).solve(control);
            let fault = match until {
                // It ends before that corner, and is right.
                Ok(until) if [until.hull().left, until.hull().right].contains(&x) => {
                    Some(format!("{x:?} is reached"))
                }
                Ok(until) => fault(&punch, &until, false),
                Err(error) => Some(format!("FreeUntil: {error}")),
            };
            let verdict = if fault.is_some() { Verdict::Wrong } else { Verdict::Right };
            (verdict, fault.unwrap_or(format!("LiftsOff at {x:?}")))
        }
        Err(error) => (Verdict::Refused, error.to_string()),
    }
}

#[test]
fn random_punches_between_two_corners() {
    let mut counts = [0; 3];
    // The last seeds have gaps that fall to a corner, and contacts of almost no width.
    for seed in (0..100).chain([3550, 4562, 4740]) {
        let (verdict, word) = judge(seed);
        counts[verdict as usize] += 1;
        assert_eq!(verdict, Verdict::Right, "{seed}: {word}");
    }
    println!("right, refused, wrong: {counts:?}");
}

#[test]
fn corners_on_both_sides_that_pull_are_refused() {
    let corners =
        |left: Edge<f64>, right: Edge<f64>| Contact::new(&Flat, &Flat).unwrap().edges(left, right);
    let held = corners(Edge::Fixed(-5.0), Edge::Fixed(5.0));
    for at in [4.0, -4.0] {
        let control = Control::CentreOfPressure { load: 1000.0, at };
        let error = held.solve(control).map(|_| ()).unwrap_err();
        assert!(
            matches!(error, ContactError::Solve(SolveError::LiftsOff { x, .. }) if x * at < 0.0),
            "{error}"
        );
        // The punch lifts off until its contact is four times as wide as the distance from the load
        // to its corner.
        let free = corners(Edge::FreeUntil(-5.0), Edge::FreeUntil(5.0));
        let hull = free.solve(control).unwrap().hull();
        let inner = if at > 0.0 { hull.left } else { -hull.right };
        assert!((inner - 1.0).abs() < 1e-12, "{hull:?}");
    }
    let pressed = held.solve(Control::CentreOfPressure { load: 1000.0, at: 2.0 }).unwrap();
    assert!(pressed.edge_singularities().into_iter().all(|strength| strength > 0.0));
}

/// Coplanar lands between grooves bear shares of the load that hang on their corners alone, but for
/// the distance beyond them: those of rigid punches, `q/√∏(x - e)` with the polynomial q that
/// closes the grooves (Gauss-Chebyshev). The first cells put limits a tenth of a land beside the
/// corners.
#[test]
fn coplanar_lands_share_the_load_as_rigid_ones_do() {
    type Scene = (&'static [f64], &'static [f64], [f64; 2], &'static [f64]);
    let scenes: [Scene; 5] = [
        (&[0.3, 1.0], &[0.9], [0.02, 100.0], &[0.37816, 0.62184]),
        (&[0.6, 1.0], &[2.0], [0.02, 10.0], &[0.45278, 0.54722]),
        (&[2.2, 0.4, 0.8, 1.9], &[1.6; 3], [0.3, 1.0], &[0.38336, 0.1101, 0.14878, 0.35776]),
        (
            &[3.0, 2.0, 0.3, 2.0, 1.1],
            &[0.5, 1.2, 0.9, 0.2],
            [0.05, 3.0],
            &[0.36729, 0.16729, 0.06379, 0.18574, 0.21589],
        ),
        (&[1.8, 0.7, 1.7], &[2.0, 1.4], [0.05, 0.1], &[0.42234, 0.1804, 0.39726]),
    ];
    for (lands, grooves, [depth, slope], shares) in scenes {
        let wall = depth / slope;
        let mut points = vec![[-wall, depth]];
        let mut x = 0.0;
        for (land, groove) in lands.iter().zip(grooves.iter().chain([&0.0])) {
            points.extend([[x, 0.0], [x + land, 0.0], [x + land + wall, depth]]);
            x += land + groove;
            if *groove > 0.0 {
                points.push([x - wall, depth]);
            }
        }
        let contact = on_flat(polygon(&points));
        for load in [0.2, 0.5, 0.9, 1.0, 1.1, 2.0, 4.0].map(|load| 1e-5 * load) {
            let solution = contact.solve(Control::Load(load)).unwrap();
            let contacts = solution.contacts().unwrap();
            assert_eq!(contacts.len(), lands.len(), "{lands:?}, {load}: {solution}");
            for (one, share) in contacts.iter().zip(shares) {
                assert!((one.load / load - share).abs() < 1e-4, "{lands:?}, {load}: {solution}");
            }
            // Beside chamfers of slope 0.1 the gap is as narrow as the limits are known.
            let proof = solution.certify();
            let is_open = matches!(proof, Err(ContactError::Solve(SolveError::Undecided { .. })));
            assert!(proof.is_ok() || is_open && slope < 1.0, "{lands:?}, {load}: {proof:?}");
        }
    }
}
