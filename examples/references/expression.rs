//! A formula in `k` as the reference files write it, compiled once.
//!
//! Python's rules: `**` before a sign before `*` and `/` before `+` and `-`, and equals from left
//! to right, so that every rounding is that of the formula as written. Operators of our own give
//! exmex these rules; its defaults take `-k^2` for `(-k)^2` and `2*k/3` for `2*(k/3)`.

use exmex::{BinOp, ExError, Express, FlatEx, MakeOperators, Operator};
use linecontact::Real;
use std::fmt::Debug;
use std::str::FromStr;

/// A real number that can be read: `f32`, `f64`.
pub trait Number: Real + Default + FromStr<Err: Debug> {}
impl<T: Real + Default + FromStr<Err: Debug>> Number for T {}

/// A formula in `k`, or a constant. Boxed, because a [`FlatEx`] takes 20 kB on the stack.
#[derive(Clone, Debug)]
pub struct Expression<T: Number>(Box<FlatEx<T, Operators>>);

impl<T: Number> Expression<T> {
    /// Compiles a formula.
    ///
    /// # Errors
    /// What exmex says of the syntax; any variable but `k`.
    pub fn new(text: &str) -> Result<Self, ExError> {
        // exmex binds a sign closer than `**`. So there is none: at the very start of a formula or of
        // a parenthesis 0 in front makes it a difference, and after an operator it is a factor. One
        // in an exponent is a syntax error, as `-` is no unary operator below.
        let text = without_exponents(&text.replace(' ', ""));
        let mut text = format!("({text})").replace("(-", "(0-");
        for (sign, factor) in [("+-", "+(0-1)*"), ("--", "-(0-1)*"), ("/-", "/(0-1)/")] {
            text = text.replace(sign, factor);
        }
        let text = text.replace("**-", "**~").replace("*-", "*(0-1)*").replace("**~", "**-");
        let formula = Box::new(FlatEx::<T, Operators>::parse(&text)?);
        match formula.var_names().iter().find(|name| *name != "k") {
            Some(name) => Err(ExError::new(&format!("{name} in {text} is not k"))),
            None => Ok(Self(formula)),
        }
    }

    /// The value at `k`.
    pub fn at(&self, k: T) -> T {
        self.0.eval_relaxed(&[k]).expect("checked: k is the only variable")
    }
}

/// The same with `0.00001` for `1e-05`, which exmex does not read.
fn without_exponents(text: &str) -> String {
    let (mut plain, mut rest) = (String::new(), text);
    while let Some(start) = rest.find(|c: char| c.is_ascii_digit()) {
        let is_part = |(i, c): (usize, char)| {
            let after_e = i > 0 && matches!(rest.as_bytes()[start + i - 1], b'e' | b'E');
            c.is_ascii_digit() || c == '.' || matches!(c, 'e' | 'E') || after_e && "+-".contains(c)
        };
        let end = rest[start..].char_indices().find(|&at| !is_part(at)).map(|(i, _)| start + i);
        let (number, behind) = rest.split_at(end.unwrap_or(rest.len()));
        let (before, digits) = number.split_at(start);
        plain += before;
        match digits.parse::<f64>() {
            Ok(value) if digits.contains(['e', 'E']) => plain += &value.to_string(),
            _ => plain += digits,
        }
        rest = behind;
    }
    plain + rest
}

/// The operators and functions that occur in the files.
#[derive(Clone, Debug)]
struct Operators;

impl<T: Number> MakeOperators<T> for Operators {
    fn make<'a>() -> Vec<Operator<'a, T>> {
        // Not even sums and products are declared commutative: exmex would fold constants
        // across the others.
        let binary = |name, prio, apply: fn(T, T) -> T| {
            Operator::make_bin(name, BinOp { apply, prio, is_commutative: false })
        };
        let unary = |name, apply: fn(T) -> T| Operator::make_unary(name, apply);
        vec![
            binary("+", 0, |a, b| a + b),
            binary("-", 0, |a, b| a - b),
            binary("*", 1, |a, b| a * b),
            binary("/", 1, |a, b| a / b),
            binary("**", 2, |a, b| a.powf(b)),
            unary("sin", |a| a.sin()),
            unary("cos", |a| a.cos()),
            unary("tan", |a| a.tan()),
            unary("exp", |a| a.exp()),
            unary("log", |a| a.ln()),
            unary("sqrt", |a| a.sqrt()),
            unary("sinh", |a| a.sinh()),
            unary("cosh", |a| a.cosh()),
            unary("tanh", |a| a.tanh()),
            unary("asin", |a| a.asin()),
            unary("acos", |a| a.acos()),
            unary("atan", |a| a.atan()),
            unary("abs", |a| a.abs()),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::Expression;

    fn value(text: &str, k: f64) -> f64 {
        Expression::new(text).expect(text).at(k)
    }

    #[test]
    fn signs_powers_and_order() {
        assert_eq!(value("-k**2", 3.0), -9.0);
        assert_eq!(value("-(-k)**(3)/(3)", 3.0), 9.0);
        assert_eq!(value("(-3/8)*k**2 + 1/4", 2.0), -1.25);
        assert_eq!(value("2*k**(1/2)", 9.0), 6.0);
        assert_eq!(value("1 - 2 - 3 + 4", 0.0), 0.0);
        assert_eq!(value("2/2*k/4*2", 6.0), 3.0);
        assert_eq!(value("tan(-k)**2", 0.5), 0.5f64.tan().powi(2));
        assert_eq!(value("-tan(k)**2*k", 0.5), -0.5f64.tan().powi(2) * 0.5);
        assert_eq!(value("2**3/4", 0.0), 2.0);
        assert_eq!(value("2*-k", 3.0), -6.0);
        assert_eq!(value("k - -3/4 + -k**2", 3.0), -5.25);
        assert_eq!(value("8/-k*2", 4.0), -4.0);
        assert_eq!(value("1e-05*k+2.5E+3-1e3/k", 4.0), 1e-5 * 4.0 + 2.5e3 - 1e3 / 4.0);
        assert_eq!(value("exp(k)+3.25*2", 0.0), 7.5);
    }

    #[test]
    fn rounds_as_written() {
        let k = 0.1;
        assert_eq!(value("7*k/3", k), 7.0 * k / 3.0);
        assert_eq!(value("k + 1 + 2", k), k + 1.0 + 2.0);
        assert_eq!(value("k/1048576 + 134217728", k), k / 1048576.0 + 134217728.0);
        assert_eq!(value("1/1048576*k", k), 1.0 / 1048576.0 * k);
        assert_eq!(Expression::new("k/3").expect("k/3").at(0.1f32), 0.1f32 / 3.0);
    }

    #[test]
    fn refuses_what_it_does_not_know() {
        for text in ["k**-2", "x", "erf(k)", "k +", "(k", ""] {
            assert!(Expression::<f64>::new(text).is_err(), "{text}");
        }
    }
}
