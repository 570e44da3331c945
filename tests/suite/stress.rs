//! Stress below the surface, against closed forms, equilibrium and the pressure on the surface.
#![allow(missing_docs)]

use crate::common::{NanSafe, worst};
use crate::forms::KAPPA;
use linecontact::profile::{Parabola, rounded_punch, wedge};
use linecontact::reference::{
    Biquadratic, ClosedForm, FlatPunch, Hertz, UnequalRadii, Wedge, body,
};
use linecontact::stress::{Stress, Subsurface};
use linecontact::{
    Contact, ContactError, Control, Curve, CurvePoint, Edge, EvaluationError, Flat, Midpoint,
    SolveError,
};
use linecontact::{ParametricProfile, Piecewise};
use std::f64::consts::PI;
use std::ops::{Add, ControlFlow, Div, Mul, Sub};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// Complex number with the operations that the potentials need.
#[derive(Clone, Copy, Debug)]
struct Complex(f64, f64);

impl Complex {
    fn sqrt(self) -> Self {
        let r = self.0.hypot(self.1);
        let re = ((r + self.0.abs()) / 2.0).sqrt();
        let im = self.1.abs() / (2.0 * re);
        let (re, im) = if self.0 >= 0.0 { (re, im) } else { (im, re) };
        Self(re, im.copysign(self.1))
    }
    fn ln(self) -> Self {
        Self(self.0.hypot(self.1).ln(), self.1.atan2(self.0))
    }
    /// Returns `sqrt(z - 1) sqrt(z + 1)`.
    fn root(self) -> Self {
        Self(self.0 - 1.0, self.1).sqrt() * Self(self.0 + 1.0, self.1).sqrt()
    }
    fn asin(self) -> Self {
        let log = (Self(-self.1, self.0) + (Self(1.0, 0.0) - self * self).sqrt()).ln();
        Self(log.1, -log.0)
    }
}
impl Add for Complex {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self(self.0 + o.0, self.1 + o.1)
    }
}
impl Sub for Complex {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        Self(self.0 - o.0, self.1 - o.1)
    }
}
impl Mul for Complex {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        Self(self.0 * o.0 - self.1 * o.1, self.0 * o.1 + self.1 * o.0)
    }
}
impl Mul<f64> for Complex {
    type Output = Self;
    fn mul(self, o: f64) -> Self {
        Self(self.0 * o, self.1 * o)
    }
}
impl Div for Complex {
    type Output = Self;
    fn div(self, o: Self) -> Self {
        self * Self(o.0, -o.1) * (1.0 / (o.0 * o.0 + o.1 * o.1))
    }
}

/// Returns the stress from `W = ∫ P ds/(ζ - s)` and `W'` at depth y.
fn of_potential(w: Complex, dw: Complex, y: f64, mu: f64) -> Stress<f64> {
    let [sum, difference, shear] = [2.0 / PI * w.1, -2.0 * y / PI * dw.0, -y / PI * dw.1];
    // A traction alone: its σ_y is μ times τ_xy, and its τ_xy μ times σ_x of the pressure.
    let sigma_x = (sum - difference) / 2.0;
    let along = -2.0 * mu / PI * w.0 - mu * shear;
    Stress {
        sigma_x: sigma_x + along,
        sigma_y: (sum + difference) / 2.0 + mu * shear,
        tau_xy: shear + mu * sigma_x,
    }
}

fn largest_difference(a: &Stress<f64>, b: &Stress<f64>) -> f64 {
    let parts =
        [a.sigma_x - b.sigma_x, a.sigma_y - b.sigma_y, a.tau_xy - b.tau_xy].map(|d: f64| d.abs());
    worst(parts)
}

/// Returns places x in half-widths and depths.
fn places() -> impl Iterator<Item = (f64, f64)> {
    let x = [-3.0, -1.1, -1.0, -0.93, -0.5, -1e-3, 0.0, 0.2, 0.77, 0.999, 1.0, 1.001, 1.7, 40.0];
    let depth = [1e-12, 1e-6, 1e-3, 0.03, 0.3, 0.7861514, 1.5, 20.0];
    x.into_iter().flat_map(move |x| depth.map(|y| (x, y)))
}

fn compare(
    name: &str,
    field: &Subsurface<'_, f64>,
    scale: f64,
    mu: f64,
    allowed: f64,
    potential: impl Fn(Complex) -> [Complex; 2],
) -> f64 {
    let on = field.hull();
    let half_width = on.half_width();
    let (mut worst, mut place) = (0.0, (0.0, 0.0));
    for (x, y) in places() {
        let [w, dw] = potential(Complex(x, y));
        let want = of_potential(w, dw, y, mu);
        // The forms are centred; at an edge the rounding of the centre would matter.
        let at = match x {
            -1.0 => on.left,
            1.0 => on.right,
            _ => half_width * x,
        };
        let got = field.at(at, half_width * y).unwrap();
        // An error of the limits is magnified next to an edge, as in the pressure.
        let magnified = (x.abs() - 1.0).hypot(y).sqrt().min(1.0);
        let error = magnified * largest_difference(&got, &want)
            / scale.max(want.sigma_x.abs()).max(want.sigma_y.abs());
        if error.is_nan() || error > worst {
            (worst, place) = (error, (x, y));
        }
    }
    println!("{name:24} μ = {mu:4}: largest error {worst:.1e} at {place:?}");
    assert!(worst < allowed, "{name}: {worst} at {place:?}");
    worst
}

/// Returns the largest error of the stress below four closed forms, as a share of a pressure.
pub fn largest_error() -> f64 {
    worst([below_hertz(), below_two_terms(), below_a_wedge(), below_a_tilted_punch()])
}

/// Returns the largest error below Hertz's contact, with friction and without.
fn below_hertz() -> f64 {
    let form = Hertz::new(2.0, 0.3).unwrap();
    let peak = form.pressure(0.0, KAPPA);
    let body = body(&form, -1.0, 1.0).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap().kappa(KAPPA);
    let solution = contact.solve(Control::HalfWidth(0.3)).unwrap();
    worst([0.0, 0.25, -1.0].map(|mu| {
        let field = solution.subsurface().unwrap().friction(mu).unwrap();
        compare("Hertz", &field, peak, mu, 2e-14, |z| {
            let root = z.root();
            // 1/(z + root), which does not cancel.
            let u = Complex(1.0, 0.0) / (z + root);
            [u * (PI * peak), u * (-PI * peak) / root]
        })
    }))
}

#[test]
fn hertz_everywhere() {
    below_hertz();
    let form = Hertz::new(2.0, 0.3).unwrap();
    let peak = form.pressure(0.0, KAPPA);
    let body = body(&form, -1.0, 1.0).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap().kappa(KAPPA);
    let solution = contact.solve(Control::HalfWidth(0.3)).unwrap();
    // On the axis, Johnson, Eqs. 4.46; and the same field by Eqs. 4.49 with their m and n.
    let field = solution.subsurface().unwrap();
    let (mut on_axis, mut off_axis) = (0.0f64, 0.0f64);
    for i in 1..=60 {
        let y = 0.3 * 10f64.powf(-8.0 + f64::from(i) / 6.0);
        let root = 0.3f64.hypot(y);
        let got = field.at(0.0, y).unwrap();
        let sigma_x = -peak / 0.3 * ((0.09 + 2.0 * y * y) / root - 2.0 * y);
        let sigma_y = -peak * 0.3 / root;
        on_axis = on_axis.nan_max((got.sigma_y / sigma_y - 1.0).abs());
        on_axis = on_axis.nan_max((got.sigma_x - sigma_x).abs() / peak / (1.0 + y / 0.3));
        assert!(got.tau_xy.abs() < 1e-14 * peak);
        let x = 0.21;
        let s = 0.09 - x * x + y * y;
        let r = (s * s + 4.0 * x * x * y * y).sqrt();
        let m = ((r + s) / 2.0).sqrt();
        let n = x * y / m;
        let share = (y * y + n * n) / (m * m + n * n);
        let want = Stress {
            sigma_x: -peak / 0.3 * (m * (1.0 + share) - 2.0 * y),
            sigma_y: -peak / 0.3 * m * (1.0 - share),
            tau_xy: -peak / 0.3 * n * (m * m - y * y) / (m * m + n * n),
        };
        let got = field.at(x, y).unwrap();
        off_axis = off_axis.nan_max(largest_difference(&got, &want) / peak / (1.0 + y / 0.3));
    }
    println!("Johnson 4.46 {on_axis:.1e}, 4.49 {off_axis:.1e}");
    assert!(on_axis < 2e-14 && off_axis < 2e-14);
}

/// Returns the largest error below a parabola with an x⁴.
fn below_two_terms() -> f64 {
    let form = Biquadratic::new(1.0, 5.0, 0.4).unwrap();
    let body = body(&form, -1.0, 1.0).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap().kappa(KAPPA);
    let solution = contact.solve(Control::Load(form.load(KAPPA))).unwrap();
    // κ (x + 20 x³) = c₁ cos θ + c₃ cos 3θ.
    let cubic = KAPPA * 20.0 * 0.4f64.powi(3) / 4.0;
    let (c1, c3) = (KAPPA * 0.4 + 3.0 * cubic, cubic);
    worst([0.0, 0.3].map(|mu| {
        let field = solution.subsurface().unwrap().friction(mu).unwrap();
        compare("parabola and x⁴", &field, solution.peak().unwrap().pressure, mu, 2e-14, |z| {
            let root = z.root();
            let u = Complex(1.0, 0.0) / (z + root);
            let cube = u * u * u;
            [u * c1 + cube * c3, (u * -c1 + cube * (-3.0 * c3)) / root]
        })
    }))
}

#[test]
fn a_series_of_two_terms() {
    below_two_terms();
}

/// Returns the largest error below a wedge, whose potential is `W = 2 κ m/π arcsin(L/ζ)`.
fn below_a_wedge() -> f64 {
    let form = Wedge::new(0.1, 0.2).unwrap();
    let body = body(&form, -1.0, 1.0).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap().kappa(KAPPA);
    let solution = contact.solve(Control::Load(form.load(KAPPA))).unwrap();
    worst([0.0, 0.3].map(|mu| {
        let field = solution.subsurface().unwrap().friction(mu).unwrap();
        compare("wedge", &field, solution.mean_pressure(), mu, 2e-14, |z| {
            let inverse = Complex(1.0, 0.0) / z;
            let scale = 2.0 * KAPPA * 0.1 / PI;
            [inverse.asin() * scale, inverse / z.root() * -scale]
        })
    }))
}

#[test]
fn a_wedge_whose_pressure_is_infinite() {
    below_a_wedge();
}

/// Returns the largest error below a tilted flat punch.
fn below_a_tilted_punch() -> f64 {
    let (load, slope, half_width) = (0.7, 0.1, 0.5);
    let form = FlatPunch::under_load(half_width, slope, load, KAPPA).unwrap();
    let body = body(&form, -0.5, 0.5).unwrap();
    let [left, right] = form.edges();
    let contact = Contact::new(&Flat, &body).unwrap().kappa(KAPPA).edges(left, right);
    let solution = contact.solve(Control::Load(load)).unwrap();
    let (alpha, beta) = (load / half_width / PI, -KAPPA * slope / PI);
    worst([0.0, 0.3].map(|mu| {
        let field = solution.subsurface().unwrap().friction(mu).unwrap();
        compare("tilted flat punch", &field, solution.mean_pressure(), mu, 2e-14, |z| {
            let root = z.root();
            let top = Complex(alpha, 0.0) + z * beta;
            let w = top / root - Complex(beta, 0.0);
            let dw = Complex(beta, 0.0) / root - top * z / (root * root * root);
            [w * PI, dw * PI]
        })
    }))
}

#[test]
fn a_tilted_flat_punch() {
    below_a_tilted_punch();
}

/// The forces through a cut at any depth equal those on the surface.
#[test]
fn a_cut_carries_the_load() {
    let form = UnequalRadii::under_load(1.0, 0.2, 0.05, KAPPA).unwrap();
    let body = body(&form, -1.0, 1.0).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap().kappa(KAPPA);
    let solution = contact.solve(Control::Load(0.05)).unwrap();
    let mu = 0.4;
    let field = solution.subsurface().unwrap().friction(mu).unwrap();
    let on = field.hull();
    for depth in [0.2, 1.0, 3.0].map(|depth| depth * on.half_width()) {
        // The trapezoidal rule in t, x = c + sinh t.
        let step = 0.04;
        let (mut normal, mut shear) = (0.0, 0.0);
        for i in -750..=750 {
            let t = step * f64::from(i);
            let stress = field.at(on.centre() + depth * t.sinh(), depth).unwrap();
            normal += step * depth * t.cosh() * stress.sigma_y;
            shear += step * depth * t.cosh() * stress.tau_xy;
        }
        let (normal, shear) = (normal / 0.05 + 1.0, shear / (mu * 0.05) + 1.0);
        println!("depth {depth:.3}: load {normal:.1e}, traction {shear:.1e}");
        assert!(normal.abs() < 1e-11 && shear.abs() < 1e-11);
    }
}

/// From far away a contact is a line load, whatever rounding leaves of its balance.
#[test]
fn far_below_it_is_a_line_load() {
    let form = UnequalRadii::under_load(1.0, 0.2, 0.05, KAPPA).unwrap();
    let body = body(&form, -1.0, 1.0).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap().kappa(KAPPA);
    let solution = contact.solve(Control::Load(0.05)).unwrap();
    let field = solution.subsurface().unwrap();
    for depth in [1e17, 1e60, 1e200] {
        let line = -2.0 * 0.05 / (PI * depth);
        let found = field.at(0.0, depth).unwrap().sigma_y;
        assert!((found / line - 1.0).abs() < 1e-14, "{depth:e}: {found:e} for {line:e}");
    }
}

#[test]
fn on_the_surface_it_is_the_pressure() {
    let form = UnequalRadii::under_load(1.0, 0.2, 0.05, KAPPA).unwrap();
    let body = body(&form, -1.0, 1.0).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap().kappa(KAPPA);
    let solution = contact.solve(Control::Load(0.05)).unwrap();
    let pressure = solution.pressure().unwrap();
    let peak = solution.peak().unwrap().pressure;
    let mu = 0.4;
    let field = solution.subsurface().unwrap().friction(mu).unwrap();
    let on = field.hull();
    let mut worst = 0.0f64;
    for i in 0..40 {
        let x = on.at_angle(PI * (f64::from(i) + 0.4) / 40.0);
        let (stress, p) = (field.at(x, 1e-13 * on.half_width()).unwrap(), pressure.at(x).unwrap());
        // PV∫ P ds/(x - s) = κ g.
        let sigma_x = -p - 2.0 * mu / PI * KAPPA * form.slope(x);
        for (got, want) in
            [(stress.sigma_y, -p), (stress.tau_xy, -mu * p), (stress.sigma_x, sigma_x)]
        {
            worst = worst.nan_max((got - want).abs() / peak);
        }
    }
    println!("{worst:.1e}");
    assert!(worst < 1e-11);
}

/// `κ g` is x/R in the contact and `(x - sqrt(x² - L²))/R` outside it.
#[test]
fn on_the_surface_of_hertz() {
    let (radius, l, mu) = (2.0, 0.3f64, 0.4);
    let form = Hertz::new(radius, l).unwrap();
    let body = body(&form, -1.0, 1.0).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap().kappa(KAPPA);
    let solution = contact.solve(Control::HalfWidth(l)).unwrap();
    let peak = solution.peak().unwrap().pressure;
    let (a, b) = (solution.a(), solution.b());
    for x in [0.0, 0.1, -0.2, 0.2999, a, -b, 0.31, -0.7, 5.0, -1e9] {
        let p = form.pressure(x, KAPPA);
        let pull = KAPPA / radius
            * if x.abs() <= l { x } else { l * l / (x + x.signum() * (x * x - l * l).sqrt()) };
        for mu in [0.0, mu] {
            let field = solution.subsurface().unwrap().friction(mu).unwrap();
            let got = field.at(x, 0.0).unwrap();
            let want = Stress { sigma_x: -p - 2.0 * mu / PI * pull, sigma_y: -p, tau_xy: -mu * p };
            // At the edges, relative to the uncertainty of the limits by rounding.
            let error = largest_difference(&got, &want) / peak;
            assert!(
                error < if x.abs() == a.max(b) { 1e-7 } else { 3e-14 },
                "{x}, μ = {mu}: {error:e}"
            );
        }
    }
    // The largest von Mises stress for ν = 0 is at the surface, p₀.
    let largest = solution.subsurface().unwrap().max_von_mises(0.0).unwrap();
    assert!((largest.value / peak - 1.0).abs() < 1e-15 && largest.depth == 0.0, "{largest:?}");
    // With friction this strong the shear is μ p₀ all over the contact, and nowhere larger.
    for mu in [0.6, 0.9] {
        let sliding = solution.subsurface().unwrap().friction(mu).unwrap().max_shear().unwrap();
        assert!((sliding.value / (mu * peak) - 1.0).abs() < 1e-14, "{sliding:?}");
    }
}

/// At a tip the pressure is infinite, but not the shear without friction: as the depth goes to zero
/// it is `κ m/π² · y x/(x² + y²) ·` 2 at most, which below the tip is `2 κ m/π²`.
#[test]
fn at_a_tip_and_at_corners() {
    let form = Wedge::new(0.1, 0.2).unwrap();
    let wedge = body(&form, -1.0, 1.0).unwrap();
    let contact = Contact::new(&Flat, &wedge).unwrap().kappa(KAPPA);
    let solution = contact.solve(Control::Load(form.load(KAPPA))).unwrap();
    let field = solution.subsurface().unwrap();
    let infinite = |refused: Result<_, _>, at: f64| {
        assert_eq!(
            refused.unwrap_err(),
            ContactError::Evaluation(EvaluationError::Singular { x: at })
        );
    };
    infinite(field.at(0.0, 0.0).map(|_| ()), 0.0);
    infinite(field.max_von_mises(0.3).map(|_| ()), 0.0);
    let shear = field.max_shear().unwrap().value;
    assert!((shear / (2.0 * KAPPA * 0.1 / PI.powi(2)) - 1.0).abs() < 1e-10, "{shear}");
    let mises = field.max_von_mises(0.5).unwrap().value;
    assert!((mises / (3f64.sqrt() * shear) - 1.0).abs() < 1e-14);
    infinite(field.friction(0.01).unwrap().max_shear().map(|_| ()), 0.0);

    let form = FlatPunch::under_load(0.5, 0.1, 0.7, KAPPA).unwrap();
    let punch = body(&form, -1.0, 1.0).unwrap();
    let [left, right] = form.edges();
    let contact = Contact::new(&Flat, &punch).unwrap().kappa(KAPPA).edges(left, right);
    let solution = contact.solve(Control::Load(0.7)).unwrap();
    let field = solution.subsurface().unwrap().friction(0.3).unwrap();
    for x in [-0.5, 0.5] {
        infinite(field.at(x, 0.0).map(|_| ()), x);
    }
    let stress = field.at(0.2, 0.0).unwrap();
    let sigma_x = -form.pressure(0.2, KAPPA) - 0.6 / PI * KAPPA * 0.1;
    assert!((stress.sigma_x / sigma_x - 1.0).abs() < 1e-14);
    assert_eq!(field.at(0.6, 0.0).unwrap().sigma_y, 0.0);
}

/// Below the tip of an asymmetric wedge the shear rises along a narrow ridge up to the surface,
/// where it is `κ (m₁ + m₂)/π²`.
#[test]
fn below_a_tip_that_leans() {
    for slopes in [[-0.02f64, 0.05], [-0.3, 0.1], [-1e-3, 1e-2]] {
        let body = wedge(slopes, 9.0).unwrap();
        let contact = Contact::new(&Flat, &body).unwrap().kappa(KAPPA);
        let solution = contact.solve(Control::HalfWidth(1.0)).unwrap();
        let shear = solution.subsurface().unwrap().max_shear().unwrap();
        let limit = KAPPA * (slopes[1] - slopes[0]) / PI.powi(2);
        assert!((shear.value / limit - 1.0).abs() < 1e-8, "{shear:?} for {limit}");
        assert!(shear.depth < 1e-4 && shear.x.abs() < 1e-4, "{shear:?}");
    }
}

#[test]
fn the_search_for_the_largest_shear_can_be_ended() {
    let (looks, parabola) = (AtomicUsize::new(0), Parabola::new(1.0, [-1.0, 1.0]).unwrap());
    let watch = |_, _| {
        let is_over = looks.fetch_add(1, Relaxed) >= 100;
        if is_over { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
    };
    let contact = Contact::new(&Flat, &parabola).unwrap().watch(&watch);
    let solution = contact.solve(Control::Load(0.02)).unwrap();
    let field = solution.subsurface().unwrap();
    for error in [field.max_shear().unwrap_err(), field.max_von_mises(0.3).unwrap_err()] {
        assert!(matches!(error, ContactError::Solve(SolveError::Cancelled { .. })), "{error}");
    }
    assert_eq!(looks.load(Relaxed), 102);
}

/// A flat punch of which the contact covers very little of the round corners: the largest shear is
/// below a corner, scales with the covered width, and so does its place.
#[test]
fn below_round_corners_that_are_hardly_touched() {
    let punch = rounded_punch(1.0, 1.0, 3.0).unwrap();
    let contact = Contact::new(&Flat, &punch).unwrap().kappa(KAPPA);
    let [shallow, deep] = [1e-6, 1e-5].map(|touched| {
        let solution = contact.solve(Control::HalfWidth(1.0 + touched)).unwrap();
        let field = solution.subsurface().unwrap();
        let found = field.max_shear().unwrap();
        for i in 0..40 {
            for j in 0..20 {
                let x = 1.0 + touched * (f64::from(i) - 20.0) / 10.0;
                let depth = touched * 0.01 * 1.4f64.powi(j);
                let shear = field.at(x, depth).unwrap().max_shear();
                assert!(shear <= found.value, "{shear} at {x}, {depth}, but {found:?}");
            }
        }
        [found.value, found.x.abs() - 1.0, found.depth].map(|number| number / touched)
    });
    for (one, other) in shallow.into_iter().zip(deep) {
        assert!((one / other - 1.0).abs() < 1e-4, "{shallow:?} {deep:?}");
    }
}

#[test]
fn where_hertz_yields() {
    let form = Hertz::new(1.0, 0.1).unwrap();
    let body = body(&form, -1.0, 1.0).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap();
    let solution = contact.solve(Control::HalfWidth(0.1)).unwrap();
    let peak = solution.peak().unwrap().pressure;
    let field = solution.subsurface().unwrap();
    let shear = field.max_shear().unwrap();
    println!("shear {} at {}, {}", shear.value / peak, shear.x / 0.1, shear.depth / 0.1);
    // By Johnson 4.46 on the axis.
    let sigma = |t: f64| {
        let root = 1f64.hypot(t);
        [-((1.0 + 2.0 * t * t) / root - 2.0 * t), -1.0 / root]
    };
    let best = |f: &dyn Fn(f64) -> f64| {
        let (mut lo, mut hi) = (0.3, 1.5);
        while hi - lo > 1e-9 {
            let third = (hi - lo) / 3.0;
            if f(lo + third) < f(hi - third) { lo += third } else { hi -= third }
        }
        [(lo + hi) / 2.0, f((lo + hi) / 2.0)]
    };
    let [depth, value] = best(&|t| (sigma(t)[0] - sigma(t)[1]).abs() / 2.0);
    assert!((depth - 0.7861514).abs() < 5e-8 && (value - 0.3002831).abs() < 5e-8);
    assert!((shear.value / peak - value).abs() < 1e-14);
    assert!((shear.depth / 0.1 - depth).abs() < 2e-7 && shear.x.abs() < 2e-8);
    for nu in [0.0, 0.3, 0.5] {
        let got = field.max_von_mises(nu).unwrap();
        let [depth, value] = best(&|t| {
            let [x, y] = sigma(t);
            let z = nu * (x + y);
            (((x - y).powi(2) + (y - z).powi(2) + (z - x).powi(2)) / 2.0).sqrt()
        });
        println!("ν = {nu}: {} at {}", got.value / peak, got.depth / 0.1);
        if nu > 0.2 {
            assert!((got.value / peak - value).abs() < 1e-14);
            assert!((got.depth / 0.1 - depth).abs() < 2e-7);
        } else {
            // The largest value is at the surface, p₀.
            assert!((got.value / peak - 1.0).abs() < 3e-6 && got.depth < 2e-7);
        }
    }
}

#[test]
fn invariants() {
    let stress = Stress { sigma_x: -3.0, sigma_y: 1.0, tau_xy: 1.5 };
    assert_eq!(stress.principal(), [1.5, -3.5]);
    assert_eq!(stress.max_shear(), 2.5);
    let [x, y, t, z]: [f64; 4] = [-3.0, 1.0, 1.5, -0.6];
    assert!((stress.sigma_z(0.3).unwrap() - z).abs() < 1e-15);
    let squares: f64 = [x - y, y - z, z - x].iter().map(|d| d * d).sum();
    let mises = (squares / 2.0 + 3.0 * t * t).sqrt();
    assert!((stress.von_mises(0.3).unwrap() / mises - 1.0).abs() < 1e-15);
}

#[test]
fn no_depth_is_too_shallow_for_its_place() {
    let form = Hertz::new(1.0, 0.1).unwrap();
    let body = body(&form, -1.0, 1.0).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap();
    let solution = contact.solve(Control::HalfWidth(0.1)).unwrap();
    let field = solution.subsurface().unwrap();
    // Far away nothing overflows.
    assert!(field.at(1e200, 1e-200).unwrap().max_shear() >= 0.0);
    assert!(field.at(0.0, 1e-200).unwrap().max_shear() < 1e-12);
    // If some components of the stress have no digits left, the others remain.
    assert!(field.at(1e6, 1e-300).unwrap().max_shear() < 1e-300);
}

#[test]
fn in_single_precision() {
    let form = Hertz::new(1.0f32, 0.1).unwrap();
    let body = body(&form, -1.0, 1.0).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap().edges(Edge::Free, Edge::Free);
    let solution = contact.solve(Control::HalfWidth(0.1)).unwrap();
    let peak = solution.peak().unwrap().pressure;
    let shear = solution.subsurface().unwrap().max_shear().unwrap();
    assert!((shear.value / peak - 0.3002831).abs() < 1e-5, "{shear:?}");
    assert!((shear.depth / 0.1 - 0.7861514).abs() < 1e-2, "{shear:?}");
}

#[test]
fn at_either_end_of_the_numbers() {
    for (reach, half_width) in [(1.0f64, 7e-151f64), (4e150, 9e149)] {
        let form = Hertz::new(1.0, half_width).unwrap();
        let body = body(&form, -reach, reach).unwrap();
        let contact = Contact::new(&Flat, &body).unwrap();
        let solution = contact.solve(Control::HalfWidth(half_width)).unwrap();
        let peak = solution.peak().unwrap().pressure;
        let shear = solution.subsurface().unwrap().max_shear().unwrap();
        assert!((shear.value / peak - 0.3002831).abs() < 1e-7, "{shear:?}");
        assert!((shear.depth / half_width - 0.7861514).abs() < 1e-6, "{shear:?}");
    }
}

/// Next to a breakpoint of a body far from x = 0 the places themselves are rounded.
#[test]
fn beside_a_breakpoint_anywhere() {
    for shift in [0.0f64, 0.37, -20.0, 1e6] {
        let tip = |k: f64| 0.1 * (k - shift).abs();
        let side = |from: f64, to: f64, slope: f64| {
            Curve::new([shift + from, shift + to], move |k: f64| CurvePoint {
                x: k,
                y: tip(k),
                dx: 1.0,
                dy: slope,
            })
        };
        let body = Piecewise::new(vec![
            Box::new(side(-1.0, 0.0, -0.1)) as Box<dyn ParametricProfile<f64>>,
            Box::new(side(0.0, 1.0, 0.1)),
        ])
        .unwrap();
        let contact = Contact::new(&Flat, &body).unwrap();
        let solution = contact.solve(Control::HalfWidth(0.2)).unwrap();
        let field = solution.subsurface().unwrap().friction(0.3).unwrap();
        let mut worst = 0.0f64;
        for (x, y) in [(0.0f64, 1e-9f64), (1e-9, 1e-9), (-1e-7, 1e-12), (0.3, 1e-6), (0.1, 0.5)] {
            // The rounded x.
            let at: f64 = shift + 0.2 * x;
            let z = Complex((at - shift) / 0.2, y);
            let inverse = Complex(1.0, 0.0) / z;
            let scale = 2.0 * 0.1 / PI;
            let want = of_potential(inverse.asin() * scale, inverse / z.root() * -scale, y, 0.3);
            let got = field.at(at, 0.2 * y).unwrap();
            let error = largest_difference(&got, &want) / want.sigma_y.abs();
            let rounding = 4.0 * f64::EPSILON * shift.abs() / (0.2 * y.hypot(x));
            worst = worst.nan_max(error / (1e-13 + rounding));
        }
        println!("breakpoint at {shift}: {worst:.2} of what rounding allows");
        assert!(worst < 1.0, "{shift}: {worst}");
    }
}

#[test]
fn a_field_shows_its_contact_and_its_friction() {
    let body = crate::common::parabola(1.0);
    let contact = Contact::new(&Flat, &*body).unwrap();
    let solution = contact.solve(Control::Load(0.01)).unwrap();
    let field = solution.subsurface().unwrap().friction(0.375).unwrap();
    let shown = format!("{field:?}");
    for part in [format!("{:?}", solution.hull()), "friction: 0.375".into()] {
        assert!(shown.contains(&part), "{shown}");
    }
}

type Part<'a> = Box<dyn ParametricProfile<f64> + 'a>;

/// Returns a parabola in pieces, with a parameter that has to be inverted.
fn in_pieces(pieces: usize, calls: &AtomicUsize) -> Piecewise<f64, Part<'_>> {
    let ends = |i: usize| i as f64 / pieces as f64 - 0.5;
    let piece = |i: usize| {
        let point = |k: f64| {
            calls.fetch_add(1, Relaxed);
            let square = k * k;
            let x = k + k * square;
            let slope = 1.0 + 3.0 * square;
            CurvePoint { x, y: x * x / 2.0, dx: slope, dy: x * slope }
        };
        Box::new(Curve::new([ends(i), ends(i + 1)], point)) as Part<'_>
    };
    Piecewise::new((0..pieces).map(piece).collect::<Vec<_>>()).unwrap()
}

/// Johnson, Eq. (4.47), below a hundred pieces.
#[test]
fn the_largest_shear_below_many_pieces() {
    let calls = AtomicUsize::new(0);
    let body = in_pieces(100, &calls);
    let contact = Contact::new(&Flat, &body).unwrap();
    let solution = contact.solve(Control::HalfWidth(0.6)).unwrap();
    let shear = solution.subsurface().unwrap().max_shear().unwrap();
    assert!((shear.value / (0.6 / PI) - 0.300_283_1).abs() < 1e-7, "{shear:?}");
    assert!((shear.depth / 0.6 - 0.786_151_4).abs() < 1e-6, "{shear:?}");
}

/// With the panels available no stress calls the curves, whatever quadrature gave the limits.
#[test]
fn a_stress_takes_no_evaluation() {
    let calls = AtomicUsize::new(0);
    let body = in_pieces(32, &calls);
    let rule = Midpoint { segments: 64, ..Midpoint::DEFAULT };
    for is_rule in [false, true] {
        let contact = Contact::new(&Flat, &body).unwrap();
        let contact = if is_rule { contact.quadrature(&rule) } else { contact };
        let solution = contact.solve(Control::HalfWidth(0.6)).unwrap();
        let below = solution.subsurface().unwrap();
        let before = calls.load(Relaxed);
        // The parabola is Hertz's contact: on the axis σ_y = -κ L/(π R) L/sqrt(L² + y²).
        for depth in [1e-3, 0.3, 2.0] {
            let want = -0.6 / PI * 0.6 / 0.6f64.hypot(depth);
            let found = below.at(0.0, depth).unwrap().sigma_y;
            assert!((found / want - 1.0).abs() < 1e-13, "{depth}: {found} for {want}");
        }
        assert_eq!(calls.load(Relaxed), before);
    }
}

/// `Σ_j ∫ P/(ζ - s) ds` over waves and gaps: each contact by the Gauss-Chebyshev rule, which
/// converges below the surface and between contacts.
#[test]
fn below_waves_and_the_gaps_between_them() {
    let wave = |number: f64, amplitude: f64| {
        Curve::new([-1.0, 1.0], move |k: f64| CurvePoint {
            x: k,
            y: 0.5 * k * k + amplitude * (number * k).cos(),
            dx: 1.0,
            dy: k - number * amplitude * (number * k).sin(),
        })
    };
    for (number, amplitude, load, least) in
        [(40.0, 2e-3, 4e-3, 2), (40.0, 2e-2, 0.04, 4), (200.0, 2e-3, 0.05, 8)]
    {
        let body = wave(number, amplitude);
        let contact = Contact::new(&Flat, &body).unwrap().kappa(KAPPA);
        let solution = contact.solve(Control::Load(load)).unwrap();
        let on = solution.intervals();
        assert!(on.len() >= least, "{} contacts", on.len());
        let (pressure, below) = (solution.pressure().unwrap(), solution.subsurface().unwrap());
        let peak = solution.peak().unwrap().pressure;
        let count = 400;
        let mut points = Vec::new();
        for on in on {
            for i in 0..count {
                let s = on.at_angle(PI * (f64::from(i) + 0.5) / f64::from(count));
                let strength = pressure.at(s).unwrap() * on.chebyshev_weight(s);
                points.push([s, strength * PI / f64::from(count)]);
            }
        }
        let mut worst = 0.0f64;
        let mut check = |x: f64, y: f64| {
            let zero = [Complex(0.0, 0.0); 2];
            let [w, dw] = points.iter().fold(zero, |[w, dw], &[s, load]| {
                let term = Complex(1.0, 0.0) / Complex(x - s, y);
                [w + term * load, dw + term * term * -load]
            });
            let got = below.at(x, y).unwrap();
            worst = worst.nan_max(largest_difference(&got, &of_potential(w, dw, y, 0.0)) / peak);
        };
        for pair in on.windows(2) {
            let (from, width) = (pair[0].right, pair[1].left - pair[0].right);
            // In the middle p and V vanish.
            for share in [0.3, 0.4999, 0.5 - 1e-9, 0.5, 0.5001, 0.51, 0.7] {
                for y in [1e-12, 1e-4, 0.004, 0.006, 0.02, 0.3] {
                    check(from + share * width, y * width);
                }
            }
        }
        for on in on {
            for (x, y) in [(-0.9, 0.3), (0.0, 0.2), (0.5, 1.0), (1.0, 0.4), (0.0, 30.0)] {
                check(on.centre() + x * on.half_width(), y * on.half_width());
            }
        }
        println!("{} contacts: {worst:.1e} of the peak", on.len());
        assert!(worst < 3e-13, "{worst:e}");
    }
}

/// Depths beyond the largest shear: it falls on the axis like `t - t²/sqrt(1 + t²)`, `t = y/L`.
#[test]
fn the_largest_stress_from_one_depth_to_another() {
    let body = Parabola::new(1.0, [-1.0, 1.0]).unwrap();
    let solution = Contact::new(&Flat, &body).unwrap().solve(Control::HalfWidth(0.2)).unwrap();
    let peak = solution.peak().unwrap().pressure;
    let within = |depths: [f64; 2]| solution.subsurface().unwrap().within(depths).unwrap();
    for share in [1.0, 2.5, 30.0] {
        let found = within([0.2 * share, f64::INFINITY]).max_shear().unwrap();
        let root = share.hypot(1.0);
        let expected = share / (root * (share + root)) * peak;
        assert!((found.value / expected - 1.0).abs() < 1e-12, "{share}: {found:?}");
        assert!(found.depth == 0.2 * share && found.x.abs() < 1e-6 * root, "{share}: {found:?}");
    }
    let shallow = within([0.0, 0.1]).max_shear().unwrap();
    assert!(shallow.depth == 0.1 && shallow.value >= (0.5 - 0.25 / 1.25f64.sqrt()) * peak);
    let all = solution.subsurface().unwrap().max_shear().unwrap();
    assert_eq!(within([0.0, f64::INFINITY]).max_shear().unwrap(), all);
}
