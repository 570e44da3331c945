//! Derivatives of a solution with several contacts by its parameters.
#![allow(missing_docs)]

use crate::derivatives::{plain, seeded};
use crate::forms::KAPPA;

use linecontact::autodiff::num_dual::{Dual64, HyperDual64};
use linecontact::reference::{ClosedForm, Hertz, PolynomialMap, Quartic, Wedge, body};
use linecontact::{
    Contact, Control, Cost, Curve, CurvePoint, Edge, Ends, Flat, ParametricProfile, Real, Solution,
    Solver,
};
use std::f64::consts::PI;

/// Returns `x⁴ - 2x²` with coefficients as parameters.
fn quartic<T: Real>(reach: f64, [fourth, second]: [T; 2]) -> impl ParametricProfile<T> {
    Curve::new([-reach, reach].map(T::of), move |k: T| {
        let square = k * k;
        CurvePoint {
            x: k,
            y: square * (fourth * square - second),
            dx: T::one(),
            dy: k * (T::of(4.0) * fourth * square - T::of(2.0) * second),
        }
    })
}

/// β² - α² = sqrt(4F/π), α² + β² = 2.
#[test]
fn limits_by_the_load() {
    let body = quartic(2.5, [plain(1.0), plain(2.0)]);
    let contact = Contact::new(&Flat, &body).unwrap().contact_modulus(plain(1.0));
    let mut solver = Solver::new();
    for load in [1e-5, 0.01, 0.5, 1.0, 2.5, 3.0, 3.1] {
        let given = Control::Load(plain(load).derivative());
        for solution in [contact.solve(given).unwrap(), solver.solve(&contact, given).unwrap()] {
            let d = (4.0 * load / PI).sqrt();
            let [inner, outer] = [(1.0 - d / 2.0).sqrt(), (1.0 + d / 2.0).sqrt()];
            let rates = [-d / (8.0 * load * inner), d / (8.0 * load * outer)];
            let [first, second] = solution.intervals() else { panic!("F = {load}") };
            let limits = [(second.left, rates[0]), (second.right, rates[1])];
            let near = 1.0 / (1.0 - load / PI);
            let width = outer - inner;
            for ((got, want), other) in limits.into_iter().zip([first.right, first.left]) {
                assert!((got.eps + other.eps).abs() <= 1e-11 * near * want.abs(), "F = {load}");
                // The width follows from the load.
                let error = (got.eps - want).abs() * load / width;
                assert!(error < 1e-12 * near, "F = {load}: {} for {want}", got.eps);
            }
            let known = solution.load_rates().unwrap();
            for (Ends { left, right }, on) in known.limits.iter().zip(solution.intervals()) {
                assert!((left.re / on.left.eps - 1.0).abs() < 1e-10 * near, "F = {load}");
                assert!((right.re / on.right.eps - 1.0).abs() < 1e-10 * near, "F = {load}");
            }
            for share in [0.1, 0.5, 0.8] {
                let x = plain(inner + share * width);
                let got = solution.pressure().unwrap().at(x).unwrap().eps;
                let rate = known.pressure(x).unwrap().re;
                assert!((got / rate - 1.0).abs() < 1e-10 * near, "F = {load}: {got}, {rate}");
            }
            for region in solution.contacts().unwrap() {
                assert!((region.load.eps - 0.5).abs() < 1e-11 * near, "F = {load}: {region:?}");
            }
        }
    }
}

/// Returns the relative errors of a solution on dual numbers against a closed form: derivatives of
/// the limits and of the pressures.
fn off(form: &dyn ClosedForm<Dual64>, solution: &Solution<Dual64>, kappa: Dual64) -> [f64; 2] {
    let want = form.contacts();
    assert_eq!(solution.intervals().len(), want.len());
    let size = |a: f64, b: f64| a.max(b.abs());
    let limits = |on: &linecontact::Interval<Dual64>| [on.left, on.right];
    let of_limits = want.iter().flat_map(limits).fold(0.0, |max, x| size(max, x.eps));
    let mut worst = [0.0f64; 2];
    for (got, want) in solution.intervals().iter().zip(&want) {
        for (got, want) in limits(got).into_iter().zip(limits(want)) {
            assert!(got.eps.is_finite(), "{got:?}");
            worst[0] = worst[0].max((got.eps - want.eps).abs() / of_limits);
        }
    }
    let pressure = solution.pressure().unwrap();
    let (mut most, mut of_pressures) = (0.0f64, 0.0f64);
    for on in &want {
        for i in 1..12 {
            let x = plain(on.at_angle(plain(PI * (f64::from(i) + 0.1) / 12.0)).re);
            let exact = form.pressure(x, kappa);
            let got = pressure.estimate(x, &mut Cost::default()).unwrap().value;
            assert!(got.eps.is_finite(), "P({x}) = {got:?}");
            (most, of_pressures) =
                (most.max((got.eps - exact.eps).abs()), size(of_pressures, exact.eps));
        }
    }
    worst[1] = most / of_pressures;
    worst
}

#[test]
fn by_all_parameters_of_closed_forms() {
    let kappa = seeded(KAPPA);
    let (hertz, wedge) = (
        Hertz::new(seeded(0.7), seeded(0.3)).unwrap(),
        Wedge::unequal(plain(0.2), plain(0.3), seeded(0.4)).unwrap(),
    );
    let mut forms: Vec<(String, Box<dyn ClosedForm<Dual64>>, f64)> = Vec::new();
    for load in [0.01, 0.5, 0.95] {
        let load = seeded(load) * kappa * 0.6;
        let form = Quartic::under_load(seeded(0.3), seeded(1.3), load, kappa).unwrap();
        forms.push((format!("quartic {}", load.re), Box::new(form), 2.5));
    }
    for count in [2usize, 3, 5] {
        let reach = (2.0 / count as f64).cosh();
        for share in [1.1, 3.0] {
            let form = PolynomialMap::new(hertz, count, seeded(0.3 * share), seeded(1.0)).unwrap();
            forms.push((format!("Hertz {count}, {share}"), Box::new(form), reach));
        }
        // Kinks that do not move.
        let form = PolynomialMap::new(wedge, count, seeded(0.7), plain(1.0)).unwrap();
        forms.push((format!("wedge {count}"), Box::new(form), reach));
    }
    for (name, form, reach) in forms {
        let body = body(&*form, plain(-reach), plain(reach)).unwrap();
        let contact = Contact::new(&Flat, &body).unwrap().kappa(kappa);
        let solution = contact.solve(Control::Load(form.load(kappa))).unwrap();
        let [of_limits, of_pressures] = off(&*form, &solution, kappa);
        println!("{name:24} limits {of_limits:.1e}, P {of_pressures:.1e}");
        assert!(of_limits < 1e-11 && of_pressures < 1e-10, "{name}");
    }
}

/// A rough body, and one with a corner, against differences of solves.
#[test]
fn by_the_height_of_a_wave() {
    fn rough<T: Real>(height: T) -> impl ParametricProfile<T> {
        Curve::new([-2.0, 2.0].map(T::of), move |k: T| {
            let (sin, cos) = (T::of(20.0) * k + T::of(0.3)).sin_cos();
            CurvePoint {
                x: k,
                y: T::of(0.5) * k * k + height * cos,
                dx: T::one(),
                dy: k - T::of(20.0) * height * sin,
            }
        })
    }
    fn punch<T: Real>(height: T) -> impl ParametricProfile<T> {
        Curve::new([-1.0, 1.0].map(T::of), move |k: T| {
            let (sin, cos) = (T::of(7.0) * k + T::of(0.4)).sin_cos();
            CurvePoint {
                x: k,
                y: T::of(0.02) * k - height * cos,
                dx: T::one(),
                dy: T::of(0.02) + T::of(7.0) * height * sin,
            }
        })
    }
    fn numbers<T: Real>(body: &dyn ParametricProfile<T>, load: f64, corner: bool) -> Vec<T> {
        let left = if corner { Edge::Fixed(-T::one()) } else { Edge::Free };
        let contact = Contact::new(&Flat, body).unwrap().contact_modulus(T::one());
        let contact = contact.edges(left, Edge::Free);
        let solution = contact.solve(Control::Load(T::of(load))).unwrap();
        let mut numbers: Vec<T> = Vec::new();
        for region in solution.contacts().unwrap() {
            numbers.extend([region.interval.left, region.interval.right, region.load]);
            numbers.push(region.centre_of_pressure().unwrap());
        }
        let pressure = solution.pressure().unwrap();
        for x in if corner { [-0.9, -0.1, 0.8] } else { [-0.15, -0.1, 0.1] } {
            numbers.push(pressure.at(T::of(x)).unwrap());
        }
        numbers.push(solution.edge_singularities().left);
        numbers
    }
    let derivatives =
        |numbers: Vec<Dual64>| -> Vec<f64> { numbers.iter().map(|n| n.eps).collect() };
    let differences = |of: &dyn Fn(f64) -> Vec<f64>, at: f64| -> Vec<f64> {
        let central = |h: f64| -> Vec<f64> {
            let [more, less] = [of(at * (1.0 + h)), of(at * (1.0 - h))];
            more.iter().zip(&less).map(|(more, less)| (more - less) / (2.0 * at * h)).collect()
        };
        let (fine, coarse) = (central(1e-3), central(2e-3));
        fine.iter().zip(&coarse).map(|(fine, coarse)| (4.0 * fine - coarse) / 3.0).collect()
    };
    let cases = [
        (
            "rough",
            derivatives(numbers(&rough(plain(0.012).derivative()), 0.03, false)),
            differences(&|height| numbers(&rough(height), 0.03, false), 0.012),
        ),
        (
            "punch",
            derivatives(numbers(&punch(plain(0.02).derivative()), 0.05, true)),
            differences(&|height| numbers(&punch(height), 0.05, true), 0.02),
        ),
    ];
    for (name, got, want) in cases {
        let size = want.iter().fold(0.0f64, |max, a| max.max(a.abs()));
        assert_eq!(got.len(), want.len());
        for (i, (got, want)) in got.iter().zip(&want).enumerate() {
            let error = (got - want).abs() / want.abs().max(1e-3 * size);
            assert!(error < 1e-6, "{name}, number {i}: {got} for {want}");
        }
    }
}

/// Second derivatives against the closed form on the same numbers.
#[test]
fn second_derivatives() {
    let hyper = |value: f64, first: f64, second: f64| HyperDual64::new(value, first, second, 0.0);
    let (depth, radius) = (hyper(0.3, 1.0, 0.2), hyper(1.3, 0.1, 1.0));
    let (load, kappa) = (hyper(0.4, 0.5, 0.3), HyperDual64::from_re(KAPPA));
    let form = Quartic::under_load(depth, radius, load, kappa).unwrap();
    let body = body(&form, HyperDual64::from_re(-2.5), HyperDual64::from_re(2.5)).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap().kappa(kappa);
    let solution = contact.solve(Control::Load(load)).unwrap();
    for (got, want) in solution.intervals().iter().zip(form.contacts()) {
        for (got, want) in [(got.left, want.left), (got.right, want.right)] {
            for (got, want) in
                [(got.eps1, want.eps1), (got.eps2, want.eps2), (got.eps1eps2, want.eps1eps2)]
            {
                assert!((got / want - 1.0).abs() < 1e-10, "{got} for {want}");
            }
        }
    }
    let pressure = solution.pressure().unwrap();
    for x in [-1.2, 1.1, 1.5] {
        let x = HyperDual64::from_re(x);
        let (got, want) = (pressure.at(x).unwrap(), form.pressure(x, kappa));
        for (got, want) in [(got.eps1, want.eps1), (got.eps1eps2, want.eps1eps2)] {
            assert!((got / want - 1.0).abs() < 1e-9, "P: {got} for {want}");
        }
    }
}

/// `P² = 4 u (u - α²)(β² - u)`, u = x²: the rate of a moving peak needs its place to more than half
/// the digits.
#[test]
fn peak_by_the_load() {
    let body = quartic(2.5, [plain(1.0), plain(2.0)]);
    let contact = Contact::new(&Flat, &body).unwrap().contact_modulus(plain(1.0));
    for load in [0.01, 0.3, 1.0, 2.5] {
        let peak = contact.solve(Control::Load(plain(load).derivative())).unwrap().peak().unwrap();
        // u - 1 = t: 4 (1 + t)(s² - t²) is largest at t = (sqrt(1 + 3 s²) - 1)/3, with s² = F/π.
        let square: f64 = load / PI;
        let u = (2.0 + (1.0 + 3.0 * square).sqrt()) / 3.0;
        let pressure = 2.0 * (u * (square - (u - 1.0).powi(2))).sqrt();
        // By s² alone, since P² is stationary in u.
        let rate = 2.0 * u / (pressure * PI);
        assert!((peak.pressure.re / pressure - 1.0).abs() < 1e-12, "{load}: {peak:?}, {pressure}");
        let off = (peak.pressure.eps / rate - 1.0).abs();
        assert!(off < 1e-12, "{load}: {off:e}");
    }
}
