//! A formula in `k`, as written in the reference files, compiled once.
//!
//! The rules are Python's. `**` binds first, from right to left; then a sign; then `*` and `/`;
//! then `+` and `-`, these from left to right. So every rounding is that of the formula as written.
//! There is one difference: an exponent with a sign needs parentheses.

use linecontact::Real;
use std::fmt::Debug;
use std::str::FromStr;
use thiserror::Error;

/// Real number that can be parsed: `f32`, `f64`.
pub trait Number: Real + FromStr<Err: Debug> {}
impl<T: Real + FromStr<Err: Debug>> Number for T {}

/// Text that cannot be read, up to the end of the formula.
#[derive(Debug, Error)]
#[error("{wanted} is expected at {rest:?}")]
pub struct SyntaxError {
    wanted: &'static str,
    rest: String,
}

/// Formula in `k`, or a constant.
#[derive(Clone, Debug)]
pub enum Expression<T: Number> {
    K,
    Constant(T),
    Function(fn(T) -> T, Box<Self>),
    Operation(fn(T, T) -> T, Box<[Self; 2]>),
}

impl<T: Number> Expression<T> {
    /// Compiles a formula.
    ///
    /// # Errors
    /// [`SyntaxError`] at the place where the syntax ends, and for any variable but `k` or any
    /// function that the files do not use.
    pub fn new(text: &str) -> Result<Self, SyntaxError> {
        let text = text.replace(' ', "");
        let mut parser = Parser { rest: &text };
        let formula = parser.sum()?;
        if parser.rest.is_empty() { Ok(formula) } else { parser.missing("an operator") }
    }

    /// Returns the value at `k`.
    pub fn at(&self, k: T) -> T {
        match self {
            Self::K => k,
            Self::Constant(value) => *value,
            Self::Function(apply, inner) => apply(inner.at(k)),
            Self::Operation(apply, sides) => apply(sides[0].at(k), sides[1].at(k)),
        }
    }

    fn operation(apply: fn(T, T) -> T, left: Self, right: Self) -> Self {
        Self::Operation(apply, Box::new([left, right]))
    }
}

/// Recursive descent through the formula, with a method for each precedence.
struct Parser<'t> {
    rest: &'t str,
}

impl<'t> Parser<'t> {
    fn sum<T: Number>(&mut self) -> Result<Expression<T>, SyntaxError> {
        let mut sum = self.product()?;
        loop {
            let apply: fn(T, T) -> T = match self.rest.as_bytes().first() {
                Some(b'+') => |a, b| a + b,
                Some(b'-') => |a, b| a - b,
                _ => return Ok(sum),
            };
            self.rest = &self.rest[1..];
            sum = Expression::operation(apply, sum, self.product()?);
        }
    }

    fn product<T: Number>(&mut self) -> Result<Expression<T>, SyntaxError> {
        let mut product = self.signed()?;
        loop {
            let apply: fn(T, T) -> T = match self.rest.as_bytes().first() {
                Some(b'*') => |a, b| a * b,
                Some(b'/') => |a, b| a / b,
                _ => return Ok(product),
            };
            self.rest = &self.rest[1..];
            product = Expression::operation(apply, product, self.signed()?);
        }
    }

    fn signed<T: Number>(&mut self) -> Result<Expression<T>, SyntaxError> {
        if self.take("-") {
            return Ok(Expression::Function(|a| -a, Box::new(self.signed()?)));
        }
        self.power()
    }

    fn power<T: Number>(&mut self) -> Result<Expression<T>, SyntaxError> {
        let base = self.operand()?;
        if self.take("**") {
            return Ok(Expression::operation(|a, b| a.powf(b), base, self.power()?));
        }
        Ok(base)
    }

    fn operand<T: Number>(&mut self) -> Result<Expression<T>, SyntaxError> {
        if self.rest.starts_with(|c: char| c.is_ascii_digit()) {
            return self.number();
        }
        let name = self.split(|_, c| c.is_ascii_alphanumeric());
        if name == "k" {
            return Ok(Expression::K);
        }
        let apply: fn(T) -> T = match name {
            "" => |a| a,
            "sin" => |a| a.sin(),
            "cos" => |a| a.cos(),
            "tan" => |a| a.tan(),
            "exp" => |a| a.exp(),
            "log" => |a| a.ln(),
            "sqrt" => |a| a.sqrt(),
            "sinh" => |a| a.sinh(),
            "cosh" => |a| a.cosh(),
            "tanh" => |a| a.tanh(),
            "asin" => |a| a.asin(),
            "acos" => |a| a.acos(),
            "atan" => |a| a.atan(),
            "abs" => |a| a.abs(),
            _ => return self.missing("k or a known function before this"),
        };
        if !self.take("(") {
            return self.missing("a number, k or a parenthesis");
        }
        let inner = self.sum()?;
        if !self.take(")") {
            return self.missing("a closing parenthesis");
        }
        Ok(if name.is_empty() { inner } else { Expression::Function(apply, Box::new(inner)) })
    }

    fn number<T: Number>(&mut self) -> Result<Expression<T>, SyntaxError> {
        let digits = self.split(|before, c| {
            let exponent = before.ends_with(['e', 'E']) && matches!(c, '+' | '-');
            c.is_ascii_digit() || matches!(c, '.' | 'e' | 'E') || exponent
        });
        digits.parse().map(Expression::Constant).or_else(|_| self.missing("a number before this"))
    }

    /// Takes characters up to the first that does not belong to those before it.
    fn split(&mut self, belongs: impl Fn(&str, char) -> bool) -> &'t str {
        let mut ends = self.rest.char_indices();
        let end = ends.find(|&(i, c)| !belongs(&self.rest[..i], c)).map(|(i, _)| i);
        let (word, rest) = self.rest.split_at(end.unwrap_or(self.rest.len()));
        self.rest = rest;
        word
    }

    fn take(&mut self, token: &str) -> bool {
        let rest = self.rest.strip_prefix(token);
        self.rest = rest.unwrap_or(self.rest);
        rest.is_some()
    }

    fn missing<R>(&self, wanted: &'static str) -> Result<R, SyntaxError> {
        Err(SyntaxError { wanted, rest: self.rest.to_owned() })
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
        assert_eq!(value("2**k**2", 3.0), 512.0);
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
        for text in ["k**-2", "x", "erf(k)", "k +", "(k", "k)", "2k", "1e", "sin k", ""] {
            assert!(Expression::<f64>::new(text).is_err(), "{text}");
        }
    }
}
