//! Closed forms used by the tests.
#![allow(dead_code)] // Each test crate uses its own part.

use linecontact::reference::{
    Biquadratic, ClosedForm, Cosine, Crowning, Ellipse, Exponential, FlatPunch, Hertz, Hyperbola,
    Jkr, PowerLaw, RoundedPunch, UnequalRadii, Wedge, Westergaard,
};
use linecontact::{Interval, Real};

pub const KAPPA: f64 = 1.7;

pub struct Form<T> {
    pub name: String,
    pub form: Box<dyn ClosedForm<T>>,
    /// Distance from x = 0 to the ends of the body.
    pub reach: T,
}

/// One contact of a periodic row, in ξ = tan(π x/λ).
#[derive(Debug)]
pub struct Unrolled<T> {
    pub row: Westergaard<T>,
    amplitude: T,
    wavelength: T,
}

impl<T: Real> Unrolled<T> {
    pub fn new(amplitude: f64, wavelength: f64, half_width: f64) -> Self {
        let [amplitude, wavelength, half_width] = [amplitude, wavelength, half_width].map(T::of);
        Self {
            row: Westergaard::new(amplitude, wavelength, half_width).unwrap(),
            amplitude,
            wavelength,
        }
    }

    fn angle(&self) -> T {
        T::pi() * self.row.limits().right / self.wavelength
    }

    fn steepness(&self) -> T {
        T::of(4.0) * self.amplitude / self.wavelength
    }
}

impl<T: Real> ClosedForm<T> for Unrolled<T> {
    fn limits(&self) -> Interval<T> {
        let right = self.angle().tan();
        Interval { left: -right, right }
    }

    fn load(&self, kappa: T) -> T {
        // ∫ cos ψ sqrt(sin² ψ_a - sin² ψ) dψ/cos² ψ = π (1 - cos ψ_a)
        T::two_pi() * kappa * self.steepness() * (T::of(0.5) * self.angle()).sin().powi(2)
    }

    fn pressure(&self, xi: T, kappa: T) -> T {
        // Near the edges x is less exact than ξ: there the difference of the angles is used.
        let right = self.limits().right;
        if xi.abs() > right {
            return T::zero();
        }
        let below = ((right - xi) / (T::one() + right * xi)).atan();
        let above = ((right + xi) / (T::one() - right * xi)).atan();
        let above = if above < T::zero() { above + T::pi() } else { above };
        let below = if below < T::zero() { below + T::pi() } else { below };
        let cosine = (T::one() + xi * xi).sqrt().recip();
        kappa * self.steepness() * cosine * below.sin().sqrt() * above.sin().sqrt()
    }

    fn height(&self, xi: T) -> T {
        T::of(0.5) * T::pi() * self.steepness() * (xi * xi).ln_1p()
    }

    fn slope(&self, xi: T) -> T {
        T::pi() * self.steepness() * xi / (T::one() + xi * xi)
    }
}

/// Returns closed forms with half-widths near 1.
pub fn forms<T: Real>() -> Vec<Form<T>> {
    forms_of(&T::of)
}

/// Returns the forms of [`forms`] with parameters made by a function.
pub fn forms_of<T: Real>(n: &dyn Fn(f64) -> T) -> Vec<Form<T>> {
    let kappa = n(KAPPA);
    let mut forms = Vec::new();
    let mut add = |name: &str, reach: f64, form: Box<dyn ClosedForm<T>>| {
        forms.push(Form { name: name.into(), form, reach: T::of(reach) });
    };
    let [half, one, two] = [0.5, 1.0, 2.0].map(n);
    add("Hertz", 9.0, Box::new(Hertz::new(n(1.3), n(0.7)).unwrap()));
    add("wedge", 9.0, Box::new(Wedge::new(n(0.3), n(0.8)).unwrap()));
    for right in [0.02, 0.7, 30.0] {
        let form = Wedge::unequal(n(0.3), n(right), n(0.8)).unwrap();
        add(&format!("wedge 0.3, {right}"), 9.0, Box::new(form));
    }
    for exponent in [1.0, 1.2, 1.5, 2.0, 2.6, 3.0, 3.5, 4.0, 6.3, 11.0, 30.5] {
        let form = PowerLaw::new(n(0.4), T::of(exponent), n(0.9)).unwrap();
        add(&format!("power {exponent}"), 2.0, Box::new(form));
    }
    for quartic in [0.5, -0.1, 0.0] {
        let form = Biquadratic::new(n(1.1), n(quartic), n(0.9)).unwrap();
        add(&format!("biquadratic {quartic}"), 1.4, Box::new(form));
    }
    for right in [1e-3, 0.4, 1.0, 2.5, 100.0] {
        let form = UnequalRadii::new(one, n(right), n(0.9)).unwrap();
        add(&format!("radii 1, {right}"), 9.0, Box::new(form));
    }
    for flat in [1e-3, 0.4, 0.875, 1.0 - 1.0 / 8192.0] {
        let form = RoundedPunch::new(n(flat), n(0.7), one).unwrap();
        add(&format!("rounded punch {flat}"), 9.0, Box::new(form));
    }
    let punch = |slope: f64, load: f64| FlatPunch::under_load(half, n(slope), n(load), kappa);
    add("flat punch", 1.0, Box::new(punch(0.0, 2.0).unwrap()));
    add("flat punch, tilted", 1.0, Box::new(punch(-0.3, 2.0).unwrap()));
    add("flat punch on one edge", 1.0, Box::new(punch(0.3, 0.2).unwrap()));
    add("flat punch on the other", 1.0, Box::new(punch(-0.9, 0.2).unwrap()));
    for half_width in [0.05, 0.6, 0.95] {
        let form = Ellipse::circle(one, n(half_width)).unwrap();
        add(&format!("circle {half_width}"), 0.99, Box::new(form));
    }
    add("ellipse", 1.9, Box::new(Ellipse::new(two, n(0.3), n(1.5)).unwrap()));
    for half_width in [0.1, 1.0, 1.95] {
        let form = Crowning::new(n(0.3), two, n(half_width)).unwrap();
        add(&format!("crowning {half_width}"), 1.99, Box::new(form));
    }
    for tip in [3.0, 0.3, 0.03] {
        let form = Hyperbola::new(n(0.6), n(tip), n(1.2)).unwrap();
        add(&format!("hyperbola {tip}"), 9.0, Box::new(form));
    }
    for half_width in [0.01, 1.0, 4.0] {
        let form = Exponential::new(n(0.8), n(1.5), n(half_width)).unwrap();
        add(&format!("exponential {half_width}"), 8.0, Box::new(form));
    }
    for half_width in [0.05, 0.6, 0.7] {
        let form = Cosine::new(n(0.1), two, n(half_width)).unwrap();
        add(&format!("cosine {half_width}"), 1.0, Box::new(form));
    }
    for half_width in [0.1, 0.25, 0.4] {
        let form = Unrolled::new(0.3, 1.0, half_width);
        add(&format!("row {half_width}"), 9.0, Box::new(form));
    }
    for load in [-0.3, 0.0, 0.4] {
        let form = Jkr::under_load(n(1.3), n(0.3), n(load), kappa).unwrap();
        add(&format!("JKR {load}"), 9.0, Box::new(form));
    }
    forms
}
