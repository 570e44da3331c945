//! Numbers of twice the length, with 31 digits: fifteen of them are those of the formula, however
//! the system's library rounds sin and ln.
//!
//! A number is the sum of two (Dekker, *Numer. Math.* 18, 1971, 224). A function of the system's
//! library is only the start of one step of Newton's method.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// Sum of two numbers; the second is less than the rounding of the first.
#[derive(Clone, Copy, Debug)]
pub struct Precise(f64, f64);

pub const PI: Precise = Precise(std::f64::consts::PI, 1.224_646_799_147_353_2e-16);
const LN_2: Precise = Precise(std::f64::consts::LN_2, 2.319_046_813_846_299_6e-17);

/// Halvings of an argument before a power series, and its number of terms: 2⁻⁶ⁿ/n! is below 1e-34
/// from n = 14 on.
const HALVINGS: i32 = 6;
const TERMS: u32 = 18;

/// Reads a decimal as it is written: 0.3 is three tenths.
pub fn n(decimal: f64) -> Precise {
    let text = decimal.to_string();
    let (whole, part) = text.split_once('.').unwrap_or((&text, ""));
    let digits: f64 = format!("{whole}{part}").parse().expect("digits");
    Precise(digits, 0.0) / Precise(10.0, 0.0).powi(part.len() as u32)
}

/// Adds two numbers, the larger one first.
fn quick_sum(a: f64, b: f64) -> Precise {
    let sum = a + b;
    Precise(sum, b - (sum - a))
}

impl Precise {
    pub fn value(self) -> f64 {
        self.0
    }

    pub fn sqrt(self) -> Self {
        if self.0 == 0.0 {
            return self;
        }
        let root = Self(self.0.sqrt(), 0.0);
        root + (self - root * root) / (root + root)
    }

    pub fn powi(self, exponent: u32) -> Self {
        (0..exponent).fold(Self(1.0, 0.0), |power, _| power * self)
    }

    pub fn exp(self) -> Self {
        let twos = (self.0 / LN_2.0).round();
        let rest = (self - LN_2 * Self(twos, 0.0)).scaled(-HALVINGS);
        let mut series = Self(0.0, 0.0);
        for k in (1..=TERMS).rev() {
            series = (series + Self(1.0, 0.0)) * rest / Self(f64::from(k), 0.0);
        }
        // e²ˣ - 1 = (eˣ - 1)(eˣ + 1)
        for _ in 0..HALVINGS {
            series = series * (series + Self(2.0, 0.0));
        }
        (series + Self(1.0, 0.0)).scaled(twos as i32)
    }

    pub fn ln(self) -> Self {
        let start = Self(self.0.ln(), 0.0);
        start + (self * (-start).exp() - Self(1.0, 0.0))
    }

    pub fn sin_cos(self) -> [Self; 2] {
        let part = self.scaled(-HALVINGS);
        let square = part * part;
        let [mut sin, mut versine] = [Self(0.0, 0.0); 2];
        for k in (1..=TERMS).rev() {
            let k = 2.0 * f64::from(k);
            sin = (Self(1.0, 0.0) - sin) * square / Self(k * (k + 1.0), 0.0);
            versine = (Self(1.0, 0.0) - versine) * square / Self(k * (k - 1.0), 0.0);
        }
        // The alternating series have given 1 - cos x and (x - sin x)/x.
        let mut sin = part * (Self(1.0, 0.0) - sin);
        for _ in 0..HALVINGS {
            let double = Self(2.0, 0.0) * sin * (Self(1.0, 0.0) - versine);
            versine = Self(2.0, 0.0) * sin * sin;
            sin = double;
        }
        [sin, Self(1.0, 0.0) - versine]
    }

    pub fn atan(self) -> Self {
        let start = Self(self.0.atan(), 0.0);
        let [sin, cos] = start.sin_cos();
        start + (self * cos - sin) / (cos + self * sin)
    }

    pub fn acos(self) -> Self {
        Self(2.0, 0.0) * ((Self(1.0, 0.0) - self) / (Self(1.0, 0.0) + self)).sqrt().atan()
    }

    pub fn asinh(self) -> Self {
        (self + (self * self + Self(1.0, 0.0)).sqrt()).ln()
    }

    pub fn acosh(self) -> Self {
        (self + (self * self - Self(1.0, 0.0)).sqrt()).ln()
    }

    /// Rounds once to fifteen significant digits, and returns the number that prints as these
    /// digits.
    pub fn rounded(self) -> f64 {
        self.rounded_to(15)
    }

    pub fn rounded_to(self, digits: i32) -> f64 {
        if self.0 == 0.0 {
            return 0.0;
        }
        assert!(self.0.is_finite(), "not a number to be written");
        let ten = |power: i32| Self(10.0, 0.0).powi(power as u32);
        let mut shift = digits - 1 - self.0.abs().log10().floor() as i32;
        loop {
            let whole = if shift < 0 { self / ten(-shift) } else { self * ten(shift) };
            let near = whole.0.round();
            let rest = (whole.0 - near) + whole.1;
            let near = if rest > 0.5 {
                near + 1.0
            } else if rest < -0.5 {
                near - 1.0
            } else {
                near
            };
            // Rounding may have carried the logarithm across a power of ten.
            if near.abs() < 10f64.powi(digits) {
                return format!("{near}e{}", -shift).parse().expect("a number");
            }
            shift -= 1;
        }
    }

    fn scaled(self, twos: i32) -> Self {
        let by = 2f64.powi(twos);
        Self(self.0 * by, self.1 * by)
    }
}

impl Add for Precise {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        let both = |a: f64, b: f64| {
            let sum = a + b;
            let shown = sum - a;
            Self(sum, (a - (sum - shown)) + (b - shown))
        };
        let (high, low) = (both(self.0, other.0), both(self.1, other.1));
        let sum = quick_sum(high.0, high.1 + low.0);
        quick_sum(sum.0, sum.1 + low.1)
    }
}

impl Neg for Precise {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}

impl Sub for Precise {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Precise {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        let product = self.0 * other.0;
        let rest = self.0.mul_add(other.0, -product);
        quick_sum(product, rest + (self.0 * other.1 + self.1 * other.0))
    }
}

impl Div for Precise {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let first = Self(self.0 / other.0, 0.0);
        let rest = self - other * first;
        let second = Self(rest.0 / other.0, 0.0);
        let rest = rest - other * second;
        first + second + Self(rest.0 / other.0, 0.0)
    }
}

/// Finds the root of a function near a start, by the secant method: a step of 1e-18 leaves an error
/// of 1e-29.
pub fn root(start: Precise, function: impl Fn(Precise) -> Precise) -> Precise {
    let (mut last, mut x) = (start, start * n(1.001));
    let mut last_value = function(last);
    for _ in 0..60 {
        let value = function(x);
        if value.0 == last_value.0 && value.1 == last_value.1 {
            break;
        }
        let small = (x - last).0.abs() <= 1e-18 * x.0.abs();
        let next = x - value * (x - last) / (value - last_value);
        (last, last_value, x) = (x, value, next);
        if small {
            break;
        }
    }
    x
}

/// Finds the maximum of a smooth function near a start, at a zero of its slope.
pub fn greatest(start: Precise, function: impl Fn(Precise) -> Precise) -> [Precise; 2] {
    let step = n(1e-9);
    let place = root(start, |x| function(x + step) - function(x - step));
    [place, function(place)]
}
