//! Derivatives of a solution by its parameters: the solver on dual numbers.
#![allow(missing_docs)]

use crate::common::NanSafe;
use crate::forms;
use crate::formulas;

use approx::assert_relative_eq;
use forms::{Form, KAPPA, forms_of};
use formulas::{Body2, Lower3, Upper3};
use linecontact::autodiff::Autodiff;
use linecontact::autodiff::num_dual::{Derivative, Dual64, DualSVec64, HyperDual64};
use linecontact::reference::{ClosedForm, Ellipse, Hertz};
use linecontact::search::{Brent, StoppingCriteria, strategies};
use linecontact::{
    Contact, Control, Cost, Curve, CurvePoint, Edge, EdgePressure, Flat, Midpoint,
    ParametricProfile, Piecewise, Real, Solution, Solver,
};
use std::f64::consts::PI;

/// Returns a number with a derivative of about its own size, by a factor that varies with the
/// value.
pub fn seeded(value: f64) -> Dual64 {
    Dual64::new(value, value * (31.0 * value).sin())
}

pub fn plain(value: f64) -> Dual64 {
    Dual64::from_re(value)
}

/// Smooth piece of a closed form's body between two abscissae, by an uneven parameter from 0 to 1.
/// Its bend has a derivative too; no result may depend on it.
struct Bent<'f> {
    form: &'f dyn ClosedForm<Dual64>,
    ends: [Dual64; 2],
    bend: Dual64,
}

impl ParametricProfile<Dual64> for Bent<'_> {
    fn domain(&self) -> [Dual64; 2] {
        [plain(0.0), plain(1.0)]
    }
    fn at(&self, k: Dual64) -> CurvePoint<Dual64> {
        let ([from, to], one) = (self.ends, plain(1.0));
        // From the nearer end: a breakpoint may be at x = 0.
        let bend = self.bend * k * (one - k);
        let x = if k.re < 0.5 {
            from + (to - from) * (k + bend)
        } else {
            to - (to - from) * (one - k - bend)
        };
        let dx = (to - from) * (one + self.bend * (one - k - k));
        let slope = if k.re == 1.0 { self.form.slope_left(x) } else { self.form.slope(x) };
        CurvePoint { x, y: self.form.height(x), dx, dy: slope * dx }
    }
}

fn bent(form: &dyn ClosedForm<Dual64>, reach: Dual64) -> Piecewise<Dual64, Bent<'_>> {
    let mut ends = vec![-reach];
    ends.extend(form.breakpoints().into_iter().filter(|x| x.re.abs() < reach.re));
    ends.push(reach);
    let piece = |ends: &[Dual64]| Bent { form, ends: [ends[0], ends[1]], bend: seeded(0.3) };
    Piecewise::new(ends.windows(2).map(piece).collect()).unwrap()
}

/// Returns the largest errors of value and derivative of the limits, as shares of the half-width.
fn limits_off(solution: &Solution<'_, Dual64>, form: &dyn ClosedForm<Dual64>) -> [f64; 2] {
    let (got, want) = (solution.hull(), form.limits());
    let l = want.half_width().re;
    [got.right - want.right, got.left - want.left].iter().fold([0.0f64; 2], |max, off| {
        [max[0].nan_max((off.re / l).abs()), max[1].nan_max((off.eps / l).abs())]
    })
}

/// Returns the largest errors of value and derivative of the pressure, relative to the local
/// pressure or a tenth of the mean pressure. The derivative is multiplied by sin θ, since it is
/// infinite at the edges.
fn pressure_off(
    solution: &Solution<'_, Dual64>,
    form: &dyn ClosedForm<Dual64>,
    kappa: Dual64,
) -> [f64; 2] {
    let (want, pressure) = (form.limits(), solution.pressure().unwrap());
    let mean = form.load(kappa).re.abs() / want.half_width().re;
    let mut largest = [0.0f64; 2];
    for i in 1..40 {
        let x = plain(want.at_angle(plain(PI * (f64::from(i) + 0.1) / 40.0)).re);
        let exact = form.pressure(x, kappa);
        let got = pressure.estimate(x, &mut Cost::default()).unwrap().value;
        let sine = (want.chebyshev_weight(x) / want.half_width()).re;
        let size = mean.max(0.1 * exact.re.abs());
        let off = [got.re - exact.re, (got.eps - exact.eps) * sine];
        largest = [0, 1].map(|i| largest[i].nan_max(off[i].abs() / size));
    }
    largest
}

/// Limits and pressure have the derivatives of the formulas, by every parameter of every closed
/// form and by κ.
#[test]
fn closed_forms() {
    let kappa = seeded(KAPPA);
    for Form { name, form, reach } in forms_of(&seeded) {
        // The derivatives of |x|^n, n < 2, are not finite at 0.
        if ["power 1", "power 1.2", "power 1.5"].contains(&&*name) {
            continue;
        }
        let body = bent(&*form, reach);
        let [left, right] = form.edges();
        let contact = Contact::new(&Flat, &body).unwrap().kappa(kappa).edges(left, right);
        // This form has tension inside.
        let contact = contact.single_interval(name == "cosine 0.7");
        let solution = contact.solve(Control::Load(form.load(kappa))).expect(&name);
        let limits = limits_off(&solution, &*form);
        let pressure = pressure_off(&solution, &*form, kappa);
        let [p, rate] = pressure;
        println!("{name:32} limits {:8.1e} {:8.1e}  P {p:8.1e} {rate:8.1e}", limits[0], limits[1]);
        assert!(limits[0] < 5e-15 && limits[1] < 2e-14, "{name}: {limits:?}");
        // JKR pressures pass through zero, next to infinite ones.
        let allowed = if name.starts_with("JKR") { 1e-11 } else { 1e-12 };
        assert!(pressure[0] < 1e-12 && pressure[1] < allowed, "{name}: {pressure:?}");
    }
}

/// Searches of one unknown at a time, and a quadrature without derivatives, give the same limits.
#[test]
fn every_way_to_the_limits() {
    let kappa = seeded(KAPPA);
    let searches = strategies(StoppingCriteria::FULL);
    let names = ["Hertz", "wedge 0.3, 0.7", "radii 1, 2.5", "flat punch on one edge", "JKR 0.4"];
    let forms = forms_of(&seeded).into_iter().filter(|form| names.contains(&&*form.name));
    for Form { name, form, reach } in forms {
        let body = bent(&*form, reach);
        let [left, right] = form.edges();
        let contact = Contact::new(&Flat, &body).unwrap().kappa(kappa).edges(left, right);
        let load = form.load(kappa);
        for (search_name, search) in &searches {
            let by_panels = contact.clone().limit_search(&**search).inversion(&**search);
            let by_rule = by_panels.clone().quadrature(&Midpoint::DEFAULT);
            for (rule, contact) in [("panels", &by_panels), ("midpoint", &by_rule)] {
                let name = format!("{name}, {search_name}, {rule}");
                let solution = contact.solve(Control::Load(load)).expect(&name);
                let off = limits_off(&solution, &*form);
                assert!(off[0] < 5e-15 && off[1] < 2e-14, "{name}: {off:?}");
                if name.starts_with("flat") {
                    continue;
                }
                let width = Control::HalfWidth(form.limits().half_width());
                let solution = contact.solve(width).expect(&name);
                let off = limits_off(&solution, &*form);
                assert!(off[0] < 5e-15 && off[1] < 2e-14, "{name}: {off:?}");
                let got = solution.load();
                assert_relative_eq!(got.re, load.re, epsilon = 0.0, max_relative = 1e-14);
                assert_relative_eq!(got.eps, load.eps, epsilon = 0.0, max_relative = 1e-12);
            }
        }
    }
}

/// The paper's rule: on its grid, off it, and next to a grid point.
#[test]
fn pressure_by_the_papers_rule() {
    let form = Hertz::new(seeded(1.3), seeded(0.7)).unwrap();
    let kappa = seeded(KAPPA);
    let body = bent(&form, plain(9.0));
    let rule = Midpoint { segments: 128, extrapolations: 5, ..Midpoint::DEFAULT };
    let contact = Contact::new(&Flat, &body).unwrap().kappa(kappa).quadrature(&rule);
    let solution = contact.solve(Control::Load(form.load(kappa))).unwrap();
    let pressure = solution.pressure().unwrap();
    for share in [0.0, 0.25, 0.2501, 0.1234567, 0.25 + 1.0 / 256.0, 0.25 + 1.0 / 256.0 + 1e-5, 0.9]
    {
        for x in [plain(0.7 * share), seeded(0.7) * share] {
            let exact = form.pressure(x, kappa);
            let got = pressure.estimate(x, &mut Cost::default()).unwrap().value;
            assert_relative_eq!(got.re, exact.re, epsilon = 0.0, max_relative = 1e-9);
            let size = exact.re.abs().max(exact.eps.abs());
            assert!((got.eps - exact.eps).abs() < 1e-6 * size, "{share}: {got:?} {exact:?}");
        }
    }
}

/// The load for a given peak pressure: `P₀ = 2F/(π L)` and `L = P₀ π R/κ`.
#[test]
fn a_given_peak() {
    let (radius, kappa, wanted) = (seeded(1.3), seeded(KAPPA), seeded(0.31));
    let unit = Hertz::new(radius, plain(1.0)).unwrap();
    let form = Hertz::new(radius, wanted * PI * radius / kappa).unwrap();
    let body = bent(&unit, plain(9.0));
    let contact = Contact::new(&Flat, &body).unwrap().kappa(kappa);
    let solution = contact.solve(Control::PeakPressure(wanted)).unwrap();
    let off = limits_off(&solution, &form);
    assert!(off[0] < 1e-14 && off[1] < 1e-13, "{off:?}");
    assert_relative_eq!(
        solution.load().eps,
        form.load(kappa).eps,
        epsilon = 0.0,
        max_relative = 1e-12
    );
}

/// Load for a given peak that is not proportional to the width: for `g = c x³` the pressure is
/// `P = c L³ (3/2 s - s³)/π` with s = sin θ, largest at s² = 1/2, and `L³ = sqrt(2) π P₀/c`.
#[test]
fn a_given_peak_of_a_body_that_stiffens() {
    let (c, wanted) = (0.7f64, 0.31);
    let l = (2f64.sqrt() * PI * wanted / c).cbrt();
    for (seed, exact) in [([1.0, 0.0], -l / (3.0 * c)), ([0.0, 1.0], l / (3.0 * wanted))] {
        let c = Dual64::new(c, seed[0]);
        let body = Curve::new([-2.0, 2.1].map(plain), move |k: Dual64| CurvePoint {
            x: k,
            y: c * k * k * k * k / 4.0,
            dx: plain(1.0),
            dy: c * k * k * k,
        });
        let contact = Contact::new(&Flat, &body).unwrap();
        let solution = contact.solve(Control::PeakPressure(Dual64::new(wanted, seed[1]))).unwrap();
        for limit in [solution.a(), solution.b()] {
            assert_relative_eq!(limit.re, l, epsilon = 0.0, max_relative = 1e-13);
            assert_relative_eq!(limit.eps, exact, epsilon = 0.0, max_relative = 1e-12);
        }
    }
}

/// Edges by the paper's Eq. (6), against differences of solutions at a tight tolerance.
#[test]
fn given_pressures_at_the_edges() {
    let half_width = |radius: Dual64, load: Dual64| {
        let parabola = Curve::new([-1.0, 1.0].map(plain), move |k: Dual64| CurvePoint {
            x: k,
            y: k * k / (radius + radius),
            dx: plain(1.0),
            dy: k / radius,
        });
        let wanted = EdgePressure::zero(plain(0.01), plain(1e-12));
        let contact = Contact::new(&Flat, &parabola).unwrap().edge_pressure(wanted);
        contact.solve(Control::Load(load)).unwrap().a()
    };
    let [r, f, h] = [1.3, 0.05, 1e-4];
    let value = |r: f64, f: f64| half_width(plain(r), plain(f)).re;
    let by_radius = (value(r + h, f) - value(r - h, f)) / (2.0 * h);
    let by_load = (value(r, f + h) - value(r, f - h)) / (2.0 * h);
    let got = half_width(Dual64::new(r, 1.0), plain(f)).eps;
    assert_relative_eq!(got, by_radius, epsilon = 0.0, max_relative = 1e-6);
    let got = half_width(plain(r), Dual64::new(f, 1.0)).eps;
    assert_relative_eq!(got, by_load, epsilon = 0.0, max_relative = 1e-4);
}

/// Returns limits, pressures, moment, peak, subsurface stress and the gap outside.
fn answers(solution: &Solution<'_, Dual64>, x: [Dual64; 2]) -> Vec<Dual64> {
    let pressure = solution.pressure().unwrap();
    let half_width = solution.hull().half_width();
    let below = solution.subsurface().unwrap().at(x[0], half_width).unwrap();
    vec![
        solution.a(),
        solution.b(),
        pressure.at(x[0]).unwrap(),
        pressure.at(x[1]).unwrap(),
        solution.moment().unwrap(),
        solution.peak().unwrap().pressure,
        below.von_mises(plain(0.3)).unwrap(),
        solution.gap_at(solution.a() + half_width).unwrap(),
    ]
}

/// Returns the answers for Example 3, with its coefficient, the scales of X and Y, κ, C, and the
/// places as parameters.
fn example_3(p: [Dual64; 7]) -> Vec<Dual64> {
    let [coefficient, sx, sy, kappa, c, x0, x1] = p;
    let scale = [sx, sy];
    let lower = Autodiff(Lower3 { coefficient, scale });
    let upper = Autodiff(Upper3 { scale });
    let contact = Contact::new(&lower, &upper).unwrap().kappa(kappa);
    answers(&contact.solve(Control::Load(c / plain(PI))).unwrap(), [x0, x1])
}

/// Returns the answers for Example 2, with the same parameters.
fn example_2(p: [Dual64; 7]) -> Vec<Dual64> {
    let [coefficient, sx, sy, kappa, c, x0, x1] = p;
    let lower = Autodiff(Body2 { along: plain(2.0) * sx, across: coefficient * sy });
    let upper = Autodiff(Body2 { along: plain(3.0) * sx, across: plain(63.0) * sy });
    let contact = Contact::new(&lower, &upper).unwrap().kappa(kappa);
    answers(&contact.solve(Control::Load(c / plain(PI))).unwrap(), [x0, x1])
}

/// Derivatives against differences of the fourth order, parameter by parameter.
#[test]
fn examples_of_the_paper_against_differences() {
    type Scene = fn([Dual64; 7]) -> Vec<Dual64>;
    let second = [-36.0, 1.0, 1.0, PI / 2.0, 128.0 * PI * PI / 25.0, 0.1, 0.7];
    let third = [8.0, 1.0, 1.0, 1.0, 300.0, 1e-4, 4e-4];
    let scenes: [([f64; 7], Scene); 2] = [(second, example_2), (third, example_3)];
    for (at, scene) in scenes {
        let value = |p: [f64; 7]| -> Vec<f64> {
            scene(p.map(plain)).iter().map(|answer| answer.re).collect()
        };
        let values = value(at);
        for i in 0..7 {
            let step = 2e-3 * at[i];
            let shifted = |by: f64| {
                let mut p = at;
                p[i] += by * step;
                value(p)
            };
            let [one, two, back_one, back_two] = [1.0, 2.0, -1.0, -2.0].map(shifted);
            let mut p = at.map(plain);
            p[i].eps = 1.0;
            for (j, got) in scene(p).into_iter().enumerate() {
                assert_relative_eq!(got.re, values[j], epsilon = 0.0, max_relative = 1e-11);
                let fourth = 8.0 * (one[j] - back_one[j]) - (two[j] - back_two[j]);
                let difference = fourth / (12.0 * step);
                // The moment of Example 3 is a small difference, and its formulas are noisy.
                let allowed = if at == third && [4, 7].contains(&j) { 1e-8 } else { 2e-9 };
                let off = (got.eps - difference) * at[i] / values[j];
                assert!(off.abs() < allowed, "parameter {i}, answer {j}: {off:e}");
            }
        }
    }
}

/// Exact identities: limits depend on κ and C, and on heights and C, only by the quotient; lengths
/// and load scale together; ∂P/∂F has a closed form.
#[test]
fn invariants() {
    let at = [8.0, 1.0, 1.0, 1.0, 300.0, 1e-4, 4e-4];
    let dually = |seed: [f64; 7]| {
        example_3([0, 1, 2, 3, 4, 5, 6].map(|i| Dual64::new(at[i], seed[i] * at[i])))
    };
    let close = |got: f64, want: f64, size: f64| {
        assert!((got - want).abs() < 1e-12 * size.abs(), "{got:e} {want:e} {size:e}");
    };
    // κ and C: pressures are proportional to both. Heights and C.
    for seed in [[0.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0]] {
        let answers = dually(seed);
        for (got, power) in answers.iter().zip([0.0, 0.0, 1.0, 1.0]) {
            close(got.eps, power * got.re, got.re);
        }
    }
    // All lengths and C: pressures do not change.
    let answers = dually([0.0, 1.0, 1.0, 0.0, 1.0, 1.0, 1.0]);
    for (got, power) in answers.iter().zip([1.0, 1.0, 0.0, 0.0]) {
        close(got.eps, power * got.re, got.re);
    }
    // C = π F alone.
    let answers = dually([0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
    let (a, b) = (answers[0].re, answers[1].re);
    for (got, x) in [(answers[2], at[5]), (answers[3], at[6])] {
        close(got.eps, at[4] / PI / (PI * (a - x).sqrt() * (x + b).sqrt()), got.eps);
    }
    let scale = [plain(1.0); 2];
    let lower = Autodiff(Lower3 { coefficient: plain(8.0), scale });
    let upper = Autodiff(Upper3 { scale });
    let contact = Contact::new(&lower, &upper).unwrap();
    let rates = contact.solve(Control::Load(plain(at[4] / PI))).unwrap().load_rates().unwrap();
    close(answers[0].eps, rates.a.re * at[4] / PI, answers[0].eps);
    close(answers[1].eps, rates.b.re * at[4] / PI, answers[1].eps);
}

/// Returns `a = sqrt(2 F R/κ)` of a parabola.
fn hertz<T: Real>(radius: T, load: T, kappa: T) -> T {
    let parabola = Curve::new([-T::one(), T::one()], move |k: T| CurvePoint {
        x: k,
        y: k * k / (radius + radius),
        dx: T::one(),
        dy: k / radius,
    });
    let contact = Contact::new(&Flat, &parabola).unwrap().kappa(kappa);
    contact.solve(Control::Load(load)).unwrap().a()
}

/// A whole gradient from one solution, and second derivatives.
#[test]
fn other_dual_numbers() {
    let [r, f, kappa] = [1.3f64, 0.05, 1.7];
    let a = (2.0 * f * r / kappa).sqrt();
    let close = |got: f64, want: f64, allowed: f64| {
        assert_relative_eq!(got, want, epsilon = 0.0, max_relative = allowed);
    };
    let seeds = [r, f, kappa].map(DualSVec64::<3>::from_re);
    let [radius, load, scale] = [0, 1, 2].map(|i| {
        let mut seed = seeds[i];
        seed.eps = Derivative::derivative_generic(nalgebra::Const::<3>, nalgebra::Const::<1>, i);
        seed
    });
    let got = hertz(radius, load, scale);
    let gradient = got.eps.0.unwrap();
    close(got.re, a, 1e-15);
    for (i, want) in [a / (2.0 * r), a / (2.0 * f), -a / (2.0 * kappa)].into_iter().enumerate() {
        close(gradient[i], want, 1e-14);
    }
    let got = hertz(
        HyperDual64::from_re(r).derivative1(),
        HyperDual64::from_re(f).derivative2(),
        HyperDual64::from_re(kappa),
    );
    close(got.eps1, a / (2.0 * r), 1e-14);
    close(got.eps2, a / (2.0 * f), 1e-14);
    close(got.eps1eps2, a / (4.0 * r * f), 1e-14);
}

/// A dent of zero depth: the derivative needs samples where the values need none. With
/// `g = x/R + d h'(x)`, `∂m₁/∂d` is an integral of `h'`, and `a` moves by it.
#[test]
fn a_derivative_finer_than_the_values() {
    for width in [0.3, 0.03, 0.01] {
        let depth = Dual64::new(0.0, 1.0);
        let dent = Curve::new([-1.0, 1.0].map(plain), move |k: Dual64| {
            let bell = plain((-(k.re / width).powi(2)).exp());
            let rise = bell * plain(-2.0 * k.re / (width * width));
            CurvePoint { x: k, y: k * k * 0.5 + depth * bell, dx: plain(1.0), dy: k + depth * rise }
        });
        let contact = Contact::new(&Flat, &dent).unwrap();
        let solution = contact.solve(Control::Load(plain(0.02))).unwrap();
        // F = L m₁, m₁ = L/2 + d n, n = (1/π) ∫ h'(L cos θ) cos θ dθ: dL = -n.
        let (l, n) = (0.2, 20_000);
        let slope = |x: f64| -2.0 * x / (width * width) * (-(x / width).powi(2)).exp();
        let node = |i: usize| (PI * (i as f64 + 0.5) / n as f64).cos();
        let mean = (0..n).map(|i| slope(l * node(i)) * node(i)).sum::<f64>() / n as f64;
        assert_relative_eq!(solution.a().re, l, epsilon = 0.0, max_relative = 1e-14);
        assert_relative_eq!(solution.a().eps, -mean, epsilon = 0.0, max_relative = 1e-12);
        assert_relative_eq!(solution.b().eps, -mean, epsilon = 0.0, max_relative = 1e-12);
    }
}

/// A solver that is used again, for the next load and for the next body.
#[test]
fn again_and_again() {
    let kappa = seeded(KAPPA);
    let unit = Ellipse::circle(seeded(1.0), seeded(0.5)).unwrap();
    let body = bent(&unit, plain(0.99));
    let contact = Contact::new(&Flat, &body).unwrap().kappa(kappa);
    let mut solver = Solver::new();
    for half_width in [0.5, 0.51, 0.3, 0.3] {
        // The derivative changes from solve to solve, even if the value does not.
        for seed in [1.0, -2.0] {
            let half_width = Dual64::new(half_width, seed);
            let form = Ellipse::circle(seeded(1.0), half_width).unwrap();
            let solution = solver.solve(&contact, Control::Load(form.load(kappa))).unwrap();
            let off = limits_off(&solution, &form);
            assert!(off[0] < 5e-15 && off[1] < 2e-14, "{off:?}");
        }
    }
}

/// K = 0 on the left of a parabola that is held at x = s on the right: F R = κ L (3 L/2 - s).
#[test]
fn a_limit_given_on_the_right() {
    let (half_width, s, kappa) = (seeded(0.4), seeded(0.1), seeded(KAPPA));
    let (half, brent) = (plain(0.5), Brent::default());
    let body = Curve::new([plain(-2.0), plain(2.0)], move |k: Dual64| CurvePoint {
        x: k,
        y: k * k * half,
        dx: plain(1.0),
        dy: k,
    });
    let load = kappa * half_width * (half_width * plain(1.5) - s);
    let contact = Contact::new(&Flat, &body).unwrap().kappa(kappa);
    let held = contact.edges(Edge::Free, Edge::Fixed(s));
    for contact in [held.clone().limit_search(&brent), held] {
        let solution = contact.solve(Control::Load(load)).unwrap();
        let (got, want) = (solution.b(), half_width + half_width - s);
        assert_relative_eq!(got.re, want.re, epsilon = 0.0, max_relative = 1e-14);
        assert_relative_eq!(got.eps, want.eps, epsilon = 0.0, max_relative = 1e-12);
    }
}

/// The tilt of a parabola under a moment is -M/(F R), its centre at M/F. A wedge t|x| with E* = 1
/// tilts by t (1 - 2θ₀/π) with cot θ₀ = -2 t M/F².
#[test]
fn a_tilt_by_the_moment() {
    let (load, m) = (0.2, 0.03);
    let moment = |m: Dual64| Control::Moment { load: plain(load), moment: m, about: plain(0.0) };
    let parabola = Curve::new([plain(-3.0), plain(3.0)], |k: Dual64| CurvePoint {
        x: k,
        y: k * k / 4.0,
        dx: plain(1.0),
        dy: k / 2.0,
    });
    let contact = Contact::new(&Flat, &parabola).unwrap();
    let solution = contact.solve(moment(Dual64::new(m, 1.0))).unwrap();
    let tilt = solution.tilt();
    assert_relative_eq!(tilt.re, -m / (2.0 * load), epsilon = 0.0, max_relative = 1e-13);
    assert_relative_eq!(tilt.eps, -1.0 / (2.0 * load), epsilon = 0.0, max_relative = 1e-12);
    assert_relative_eq!(solution.a().eps, 1.0 / load, epsilon = 0.0, max_relative = 1e-12);
    assert_relative_eq!(solution.b().eps, -1.0 / load, epsilon = 0.0, max_relative = 1e-12);

    let t = 0.3;
    let flank = |from: f64, to: f64, slope: f64| {
        let slope = plain(slope);
        Curve::new([plain(from), plain(to)], move |k: Dual64| CurvePoint {
            x: k,
            y: slope * k,
            dx: plain(1.0),
            dy: slope,
        })
    };
    let wedge = Piecewise::new(vec![flank(-5.0, 0.0, -t), flank(0.0, 5.0, t)]).unwrap();
    let contact = Contact::new(&Flat, &wedge).unwrap().contact_modulus(plain(1.0));
    let tilt = contact.solve(moment(Dual64::new(m, 1.0))).unwrap().tilt();
    let theta = f64::atan2(1.0, -2.0 * t * m / (load * load));
    assert_relative_eq!(tilt.re, t * (1.0 - 2.0 * theta / PI), epsilon = 0.0, max_relative = 1e-12);
    let rate = -(2.0 * t * theta.sin() / load).powi(2) / PI;
    assert_relative_eq!(tilt.eps, rate, epsilon = 0.0, max_relative = 1e-11);
}

/// Tilt of two contacts, and of a contact held at a corner, against differences.
#[test]
fn a_tilt_of_several_contacts_by_the_moment() {
    fn quartic<T: Real>() -> impl ParametricProfile<T> {
        Curve::new([T::of(-3.0), T::of(3.0)], |k: T| {
            let square = k * k;
            let y = square * (square - T::of(2.0));
            CurvePoint { x: k, y, dx: T::one(), dy: T::of(4.0) * k * (square - T::one()) }
        })
    }
    for (load, edges) in [
        (1.0, [Edge::Free, Edge::Free]),
        (1.0, [Edge::Free, Edge::FreeUntil(1.1)]),
        (4.0, [Edge::Free, Edge::FreeUntil(1.1)]),
    ] {
        let dual = edges.map(|edge| match edge {
            Edge::FreeUntil(x) => Edge::FreeUntil(plain(x)),
            _ => Edge::Free,
        });
        let at = -0.2;
        let body = quartic::<Dual64>();
        let contact = Contact::new(&Flat, &body).unwrap().edges(dual[0], dual[1]);
        let control = Control::CentreOfPressure { load: plain(load), at: Dual64::new(at, 1.0) };
        let solution = contact.solve(control).unwrap();
        let body = quartic::<f64>();
        let contact = Contact::new(&Flat, &body).unwrap().edges(edges[0], edges[1]);
        let key = |at: f64| {
            let solution = contact.solve(Control::CentreOfPressure { load, at }).unwrap();
            [solution.tilt(), solution.b()]
        };
        let h = 1e-4;
        let far = [key(at + 2.0 * h), key(at - 2.0 * h)];
        let near = [key(at + h), key(at - h)];
        for (i, got) in [solution.tilt(), solution.b()].into_iter().enumerate() {
            assert_relative_eq!(got.re, key(at)[i], epsilon = 0.0, max_relative = 1e-11);
            let rate = (8.0 * (near[0][i] - near[1][i]) - (far[0][i] - far[1][i])) / (12.0 * h);
            assert_relative_eq!(got.eps, rate, epsilon = 0.0, max_relative = 1e-8);
        }
    }
}

/// Bodies that are apart have derivatives by their shape, but the width has none by a load of zero.
#[test]
fn apart_the_place_of_first_touch_has_derivatives() {
    // (x - s)²/2 by its place s.
    let place = Dual64::new(0.3, 1.0);
    let body = Curve::new([plain(-1.0), plain(1.0)], move |k: Dual64| CurvePoint {
        x: k,
        y: plain(0.5) * (k - place) * (k - place),
        dx: plain(1.0),
        dy: k - place,
    });
    let contact = Contact::new(&Flat, &body).unwrap();
    let apart = contact.solve(Control::Load(plain(0.0))).unwrap();
    assert!((apart.a().eps - 1.0).abs() < 1e-7 && (apart.a().re - 0.3).abs() < 1e-15);
    assert!(apart.is_apart() && (apart.gap_at(plain(0.8)).unwrap().eps + 0.5).abs() < 1e-14);
    let error = contact.solve(Control::Load(Dual64::new(0.0, 1.0))).map(drop).unwrap_err();
    assert!(error.to_string().contains("touch in a point"), "{error}");
}
