//! The closed forms with several contacts, against the equations they solve, by a quadrature that
//! shares nothing with them or with the solver.
#![allow(missing_docs)]

use crate::common::NanSafe;
use crate::common::several;
use crate::forms::KAPPA;
use crate::integrals::integral;

use approx::assert_relative_eq;
use linecontact::reference::{
    ClosedForm, FlatPunch, Hertz, Jkr, PolynomialMap, Quartic, ReferenceError, RoundedPunch,
    UnequalRadii, Wedge, body,
};
use linecontact::{Edge, Interval, Real};
use std::f64::consts::PI;

const COUNTS: [usize; 5] = [2, 3, 5, 8, 16];

/// Returns forms with N contacts, some of them with hard parameters.
fn forms<T: Real>() -> Vec<(String, Box<dyn ClosedForm<T>>)> {
    let n = T::of;
    let kappa = n(KAPPA);
    let mut forms: Vec<(String, Box<dyn ClosedForm<T>>)> = Vec::new();
    let mut add = |name: String, form| forms.push((name, form));
    for count in COUNTS {
        // s sets the distance of neighbours: 1.001, 3 and 40 times its limit.
        for share in [1.001, 3.0, 40.0] {
            let map = |form| PolynomialMap::new(form, count, n(0.3 * share), n(1.7)).unwrap();
            let form = map(Hertz::new(n(0.7), n(0.3)).unwrap());
            add(format!("Hertz {count}, {share}"), Box::new(form));
        }
        let wedge = Wedge::unequal(n(0.2), n(0.3), n(0.4)).unwrap();
        let map = PolynomialMap::new(wedge, count, n(0.7), n(1.0)).unwrap();
        add(format!("wedge {count}"), Box::new(map));
        let radii = UnequalRadii::new(n(1.0), n(0.1), n(0.4)).unwrap();
        let map = PolynomialMap::new(radii, count, n(1.0), n(1.0)).unwrap();
        add(format!("radii {count}"), Box::new(map));
        let punch = RoundedPunch::new(n(0.2), n(0.7), n(0.3)).unwrap();
        let map = PolynomialMap::new(punch, count, n(0.5), n(1.0)).unwrap();
        add(format!("rounded punch {count}"), Box::new(map));
        for slope in [0.0, 0.1, 0.9] {
            let punch = FlatPunch::under_load(n(0.3), n(slope), n(0.2), kappa).unwrap();
            let map = PolynomialMap::new(punch, count, n(0.5), n(1.0)).unwrap();
            add(format!("sharp punch {slope}, {count}"), Box::new(map));
        }
    }
    let quartic = |load: f64| Quartic::under_load(n(0.3), n(1.3), n(load * 0.6 * KAPPA), kappa);
    for load in [1e-3, 0.4, 0.99, 1.0, 1.01, 3.0] {
        add(format!("quartic {load}"), Box::new(quartic(load).unwrap()));
    }
    forms
}

/// Integrals over the pressures of all contacts.
struct Sums<'f> {
    form: &'f dyn ClosedForm<f64>,
    contacts: Vec<Interval<f64>>,
    breakpoints: Vec<f64>,
    /// Flag: the edges are sharp; their infinite pressures are not evaluated as close to the edge
    /// as tanh-sinh does.
    sharp: bool,
}

impl<'f> Sums<'f> {
    fn new(form: &'f dyn ClosedForm<f64>, name: &str) -> Self {
        let (contacts, breakpoints) = (form.contacts(), form.breakpoints());
        Self { form, contacts, breakpoints, sharp: name.starts_with("sharp") }
    }

    /// Returns `∫ f P ds`; `f` takes the place, and the value subtracted from P times the root of
    /// both distances.
    fn sum(&self, pole: Option<f64>, f: impl Fn(f64, f64) -> f64) -> f64 {
        let over = |&on: &Interval<f64>| {
            let inside = self.breakpoints.iter().copied().chain(pole).filter(|&x| on.contains(x));
            let strength = |s: f64| {
                self.form.pressure(s, KAPPA) * (s - on.left).sqrt() * (on.right - s).sqrt()
            };
            let at_pole = pole.filter(|&x| on.contains(x)).map_or(0.0, strength);
            let integrand = |s| f(s, strength(s) - at_pole);
            if self.sharp {
                let places = (0..400).map(|i| on.at_angle(PI * (f64::from(i) + 0.5) / 400.0));
                return PI / 400.0 * places.map(integrand).sum::<f64>();
            }
            integral(on, &inside.collect::<Vec<_>>(), integrand)
        };
        self.contacts.iter().map(over).sum()
    }

    fn load(&self) -> f64 {
        self.sum(None, |_, strength| strength)
    }

    /// Returns `PV∫ P(s)/(x - s) ds`. (The integral of one over both roots is zero inside.)
    fn principal(&self, x: f64) -> f64 {
        self.sum(Some(x), |s, strength| strength / (x - s))
    }
}

#[test]
fn they_solve_the_equations() {
    for (name, form) in forms::<f64>() {
        let contacts = form.contacts();
        let sums = Sums::new(&*form, &name);
        let load = sums.load() / form.load(KAPPA) - 1.0;
        let steepest = contacts
            .iter()
            .flat_map(|on| [form.slope(on.left), form.slope_left(on.right)])
            .fold(0.0f64, |most, slope| most.max(slope.abs()));
        let mut equation = 0.0f64;
        for on in &contacts {
            let scale =
                (KAPPA * steepest).max(sums.load() / on.half_width() / contacts.len() as f64);
            for i in [1, 3, 6] {
                let x = on.at_angle(PI * (f64::from(i) + 0.2) / 8.6);
                let off = sums.principal(x) - KAPPA * form.slope(x);
                equation = equation.nan_max(off.abs() / scale);
            }
        }
        println!("{name:24} equation {equation:8.1e}  load {load:8.1e}");
        assert!(equation < 2e-10 && (equation < 1e-11 || sums.sharp), "{name}: {equation}");
        assert!(load.abs() < 1e-11, "{name}: {load}");
    }
}

/// In every gap the bodies are apart, and they meet again at its other end: the slope of the gap is
/// g - W/κ with `W = ∫ P/(x - s) ds`.
#[test]
fn the_gaps_are_open_and_close() {
    for (name, form) in forms::<f64>() {
        if form.edges() != [Edge::Free; 2] || name.starts_with("sharp") {
            continue;
        }
        let contacts = form.contacts();
        let sums = Sums::new(&*form, &name);
        for pair in contacts.windows(2) {
            let on = Interval { left: pair[0].right, right: pair[1].left };
            let opening = |x: f64| form.slope(x) - sums.principal(x) / KAPPA;
            // The midpoint rule with the roots at both ends factored out, up to a place and on to
            // the end.
            let steps = 32;
            let mut gap = 0.0;
            let mut least = f64::INFINITY;
            let mut most = 0.0f64;
            for i in (0..steps).rev() {
                let theta = PI * (f64::from(i) + 0.5) / f64::from(steps);
                let weight = PI / f64::from(steps) * on.half_width() * theta.sin();
                let step = weight * opening(on.at_angle(theta));
                gap += step;
                most = most.nan_max(gap);
                if i > 0 {
                    least = least.min(gap);
                }
            }
            assert!(least > -1e-9 * most && most > 0.0, "{name}: {least:e} in {on:?}");
            assert!(gap.abs() < 1e-5 * most, "{name}: {gap:e} of {most:e} left at {:?}", on.right);
        }
    }
}

#[test]
fn outside_and_at_the_limits() {
    for (name, form) in forms::<f64>() {
        let contacts = form.contacts();
        for pair in contacts.windows(2) {
            assert!(pair[0].right < pair[1].left, "{name}: {pair:?}");
            assert_eq!(form.pressure(0.5 * (pair[0].right + pair[1].left), KAPPA), 0.0, "{name}");
        }
        for on in &contacts {
            for (edge, beside) in [(on.left, on.left.next_down()), (on.right, on.right.next_up())] {
                assert_eq!(form.pressure(beside, KAPPA), 0.0, "{name} at {beside}");
                let at = form.pressure(edge, KAPPA);
                assert!(
                    at == 0.0 || at == f64::INFINITY && name.starts_with("sharp"),
                    "{name}: {at}"
                );
            }
            for i in 1..32 {
                let x = on.at_angle(PI * f64::from(i) / 32.0);
                let merging = name == "quartic 1" && x.abs() < 1e-9;
                assert!(form.pressure(x, KAPPA) > 0.0 || merging, "{name} at {x}");
            }
        }
        let on = form.limits();
        assert_eq!([on.left, on.right], [contacts[0].left, contacts[contacts.len() - 1].right]);
        assert_eq!(form.pressure(on.left - 1.0, KAPPA), 0.0, "{name}");
        assert_eq!(form.pressure(on.right + 1.0, KAPPA), 0.0, "{name}");
        assert!(form.pressure(f64::NAN, KAPPA).is_nan(), "{name}");
    }
}

/// The slope is the derivative of the height, on both sides of every breakpoint.
#[test]
fn the_bodies_are_what_they_say() {
    for (name, form) in forms::<f64>() {
        let on = form.limits();
        let (from, to) = (on.left - 0.05, on.right + 0.05);
        body(&*form, from, to).unwrap_or_else(|error| panic!("{name}: {error}"));
        let steep = form.slope(from).abs().max(form.slope_left(to).abs()).max(1e-3);
        let breakpoints = form.breakpoints();
        let mut places: Vec<f64> =
            (0..200).map(|i| from + (to - from) * f64::from(i) / 199.0).collect();
        places.extend(&breakpoints);
        for x in places {
            let h = 1e-6;
            let near = |breakpoint: &f64| (breakpoint - x).abs() < 4.0 * h && *breakpoint != x;
            if breakpoints.iter().any(near) {
                continue;
            }
            for (slope, side) in [(form.slope(x), h), (form.slope_left(x), -h)] {
                // One-sided, of the second order.
                let at = |steps: f64| form.height(x + steps * side);
                let difference = (4.0 * at(1.0) - at(2.0) - 3.0 * at(0.0)) / (2.0 * side);
                let off = (slope - difference).abs() / steep;
                assert!(off < 1e-6, "{name} at {x}: {slope}, {difference}");
            }
        }
    }
}

/// 30 digits: x = r sin ψ with sin(N (ψ - ψ₀)) = ±a/s, by mpmath; from Hertz with a/s = 1 - 2^-30.
#[test]
fn limits_next_to_merging_keep_the_digits_of_the_gap() {
    let amplitude = 1.0 / (1.0 - 0.5f64.powi(30));
    for (count, gap) in [(2, 4.315_837_285_505_831e-5), (5, 1.641_842_069_566_999e-5)] {
        let form =
            PolynomialMap::new(Hertz::new(1.0, 1.0).unwrap(), count, amplitude, 1.0).unwrap();
        let contacts = form.contacts();
        let middle = count / 2;
        let got = contacts[middle].left - contacts[middle - 1].right;
        assert_relative_eq!(got, gap, epsilon = 0.0, max_relative = 1e-11);
    }
    // α² = 1 - sqrt(F/Fm), at F = Fm (1 - 2^-40).
    let form = Quartic::under_load(1.0, 1.0, 2.0 * (1.0 - 0.5f64.powi(40)), 1.0).unwrap();
    let inner = form.contacts()[1].left;
    let want = 0.5f64.powi(40) / (1.0 + (1.0 - 0.5f64.powi(40)).sqrt());
    assert_relative_eq!(inner, want.sqrt(), epsilon = 0.0, max_relative = 1e-15);
}

/// The quartic is the map of a parabola with N = 2, and the x⁴ - 2x² of the theory.
#[test]
fn the_quartic() {
    let kappa = PI / 2.0;
    for load in [1e-6, 0.1, 1.0, 3.0, 3.13] {
        let quartic = Quartic::under_load(1.0, 1.0, load, kappa).unwrap();
        let hertz = Hertz::under_load(0.25, load, kappa).unwrap();
        let map = PolynomialMap::new(hertz, 2, 1.0, 2f64.sqrt()).unwrap();
        let d = (4.0 * load / PI).sqrt();
        let (inner, outer) = ((1.0 - d / 2.0).sqrt(), (1.0 + d / 2.0).sqrt());
        for (got, other) in quartic.contacts().iter().zip(map.contacts()) {
            let (width, sign) = (outer - inner, got.left.signum());
            let want = if sign > 0.0 { [inner, outer] } else { [-outer, -inner] };
            for (got, want) in
                [got.left, got.right, other.left, other.right].iter().zip(want.iter().cycle())
            {
                assert!((got - want).abs() < 1e-15 + 1e-14 * width, "{load}: {got} {want}");
            }
            for i in 1..20 {
                let x = got.at_angle(PI * f64::from(i) / 20.0);
                let want =
                    2.0 * x.abs() * ((x * x - inner * inner) * (outer * outer - x * x)).sqrt();
                // Limits off by an ulp of x.
                let slack = 1e-12 + 1e-15 / (x - got.left).min(got.right - x);
                for form in [&quartic as &dyn ClosedForm<f64>, &map] {
                    let off = form.pressure(x, kappa) / want - 1.0;
                    assert!(off.abs() < slack, "{load}: P({x}) off by {off:e}");
                    let raised = form.height(x) - (x.powi(4) - 2.0 * x * x + 1.0);
                    assert!(raised.abs() < 1e-15, "{raised}");
                }
            }
        }
        assert_relative_eq!(quartic.load(kappa), load, epsilon = 0.0, max_relative = 1e-15);
    }
    // Equal values from both sides of F = π.
    assert_relative_eq!(Quartic::under_load(1.0, 1.0, 1.0, kappa).unwrap().merger(kappa), PI);
    let at = |load: f64| Quartic::under_load(1.0, 1.0, load, kappa).unwrap();
    let (below, above) = (at(PI * (1.0 - 1e-14)), at(PI * (1.0 + 1e-14)));
    assert_eq!([below.contacts().len(), above.contacts().len()], [2, 1]);
    for x in [0.1f64, 0.5, 1.0, 1.4] {
        let want = 2.0 * x * x * (2.0 - x * x).sqrt();
        for form in [below, above] {
            assert_relative_eq!(form.pressure(x, kappa), want, epsilon = 0.0, max_relative = 1e-11);
        }
    }
    assert_relative_eq!(at(20.0).load(kappa), 20.0, epsilon = 0.0, max_relative = 1e-15);
}

/// The closed forms agree with independently computed solutions in `tests/data/several`.
#[test]
fn they_agree_with_files() {
    let kappa = PI / 2.0;
    let hertz = Hertz::under_load(1.0, 0.05, kappa).unwrap();
    let wedge = Wedge::under_load(0.1, 0.1, 0.03, kappa).unwrap();
    let quartic = |load| Box::new(Quartic::under_load(1.0, 1.0, load, kappa).unwrap());
    let forms: [(&str, Box<dyn ClosedForm<f64>>); 4] = [
        ("map_T5_hertz", Box::new(PolynomialMap::new(hertz, 5, 2.0, 1.0).unwrap())),
        ("map_T4_wedge", Box::new(PolynomialMap::new(wedge, 4, 1.0, 1.0).unwrap())),
        ("quartic_F0_1", quartic(0.1)),
        ("quartic_F3_0", quartic(3.0)),
    ];
    for (name, form) in forms {
        let want = several(name);
        assert_eq!(form.contacts().len(), want.contacts.len(), "{name}");
        for (got, want) in form.contacts().iter().zip(&want.contacts) {
            let off = (got.left - want.left).abs().nan_max((got.right - want.right).abs());
            assert!(off < 1e-14 * want.half_width().max(0.1), "{name}: {off:e}");
        }
        let largest = want.points.iter().fold(0.0f64, |most, point| most.max(point[1]));
        for [x, pressure] in want.points {
            let off = (form.pressure(x, kappa) - pressure).abs() / largest;
            assert!(off < 1e-12, "{name}: P({x}) off by {off:e}");
        }
    }
}

#[test]
fn in_single_precision_too() {
    for ((name, single), (_, double)) in forms::<f32>().into_iter().zip(forms::<f64>()) {
        if name == "quartic 1" {
            // At the merger itself rounding decides.
            continue;
        }
        let hull = double.limits();
        let size = hull.right.abs().max(hull.left.abs());
        for (single, double) in single.contacts().iter().zip(double.contacts()) {
            for (got, want) in [(single.left, double.left), (single.right, double.right)] {
                // Where the contacts almost merge, a/s = 0.999 has lost three digits.
                assert!((f64::from(got) - want).abs() < 1e-5 * size, "{name}: {got} {want}");
            }
        }
        let peak = |on: &Interval<f64>| double.pressure(on.centre(), KAPPA);
        let most = double.contacts().iter().map(peak).fold(0.0, f64::max);
        for on in double.contacts() {
            for i in 2..9 {
                let x = on.at_angle(PI * f64::from(i) / 10.1) as f32;
                let got = f64::from(single.pressure(x, KAPPA as f32));
                let want = double.pressure(f64::from(x), KAPPA);
                assert!(
                    (got - want).abs() < 1e-3 * most.max(want),
                    "{name}: P({x}) = {got}, {want}"
                );
            }
        }
        let load = f64::from(single.load(KAPPA as f32)) / double.load(KAPPA) - 1.0;
        assert!(load.abs() < 1e-5, "{name}: {load}");
    }
}

#[test]
fn what_makes_no_sense_is_refused() {
    let hertz = Hertz::new(1.0, 0.5).unwrap();
    for (count, amplitude, radius, name) in [
        (0, 1.0, 1.0, "the number of contacts"),
        (2, 0.5, 1.0, "the amplitude"),
        (2, f64::NAN, 1.0, "the amplitude"),
        (2, -1.0, 1.0, "the amplitude"),
        (2, 1.0, 0.0, "the radius"),
        (2, 1.0, f64::INFINITY, "the radius"),
    ] {
        match PolynomialMap::new(hertz, count, amplitude, radius) {
            Err(ReferenceError::Parameter { name: which, .. }) => assert_eq!(which, name),
            other => panic!("{name}: {other:?}"),
        }
    }
    // On either side only one of the limits is further out.
    for (left, right) in [(1.0, 0.3), (0.3, 1.0)] {
        let form = UnequalRadii::new(left, right, 0.5).unwrap();
        let [near, far] = [-form.limits().left, form.limits().right];
        let refused = PolynomialMap::new(form, 2, 0.5 * (near + far), 1.0);
        assert!(matches!(refused, Err(ReferenceError::Parameter { name: "the amplitude", .. })));
    }
    let sticky = Jkr::new(1.0, 0.1, 0.5).unwrap();
    let refused = PolynomialMap::new(sticky, 2, 2.0, 1.0);
    assert!(matches!(refused, Err(ReferenceError::Parameter { name: "the work of adhesion", .. })));
    for wrong in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(Quartic::under_load(wrong, 1.0, 1.0, 1.0).is_err());
        assert!(Quartic::under_load(1.0, wrong, 1.0, 1.0).is_err());
        assert!(Quartic::under_load(1.0, 1.0, wrong, 1.0).is_err());
        assert!(Quartic::under_load(1.0, 1.0, 1.0, wrong).is_err());
    }
}

/// Two bumps of any height and distance merge under the load given by the form.
#[test]
fn two_bumps_merge_under_the_load_that_the_form_tells() {
    for (depth, radius, kappa) in [(0.3f64, 2.0, 1.7), (2.5, 0.4, 0.2)] {
        let under = |load| Quartic::under_load(depth, radius, load, kappa).unwrap();
        let merger = under(1.0).merger(kappa);
        for (share, count) in [(1.0f64 - 1e-9, 2), (1.0 + 1e-9, 1)] {
            let form = under(share * merger);
            assert_eq!(form.contacts().len(), count, "{share}");
            assert!((form.load(kappa) / merger / share - 1.0).abs() < 1e-14);
        }
    }
}
