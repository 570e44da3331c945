//! Random bodies with a convex gap, and changes of their description.

use linecontact::{Contact, Curve, CurvePoint, ParametricProfile, Piecewise, Real};
use proptest::prelude::*;
use std::sync::Arc;

/// Term of the slope of a gap; none of them falls with x.
#[derive(Clone, Copy, Debug)]
pub enum Term {
    Line(f64, f64),
    Cube(f64, f64),
    Sinh(f64, f64, f64),
    Tanh(f64, f64, f64),
    /// Curvature from a breakpoint on to the right.
    Ramp(f64, f64),
    /// Curvature to the left of a breakpoint.
    RampLeft(f64, f64),
    /// Slope that jumps up.
    Jump(f64, f64),
    /// Constant slope: a tilt.
    Tilt(f64),
    /// Neither convex nor concave: only for both bodies at once.
    Wave(f64, f64),
}

impl Term {
    /// Returns height and slope, on the piece that holds `middle`: it decides the side of each
    /// breakpoint.
    fn at<T: Real>(&self, x: T, middle: f64) -> [T; 2] {
        let (n, half) = (T::of, T::of(0.5));
        let quadratic = |c: f64, x0: f64| {
            let t = x - n(x0);
            [half * n(c) * t * t, n(c) * t]
        };
        match *self {
            Self::Line(c, x0) => quadratic(c, x0),
            Self::Cube(c, x0) => {
                let t = x - n(x0);
                [n(0.25 * c) * t * t * t * t, n(c) * t * t * t]
            }
            Self::Sinh(c, k, x0) => {
                let t = n(k) * (x - n(x0));
                [n(c) / n(k) * t.cosh(), n(c) * t.sinh()]
            }
            Self::Tanh(c, w, x0) => {
                let t = (x - n(x0)) / n(w);
                let far = t.abs() + (n(-2.0) * t.abs()).exp().ln_1p();
                [n(c) * n(w) * far, n(c) * t.tanh()]
            }
            Self::Ramp(c, x0) if middle > x0 => quadratic(c, x0),
            Self::RampLeft(c, x0) if middle < x0 => quadratic(c, x0),
            Self::Jump(c, x0) if middle > x0 => [n(c) * (x - n(x0)), n(c)],
            Self::Ramp(..) | Self::RampLeft(..) | Self::Jump(..) => [T::zero(); 2],
            Self::Tilt(c) => [n(c) * x, n(c)],
            Self::Wave(c, k) => [-n(c) / n(k) * (n(k) * x).cos(), n(c) * (n(k) * x).sin()],
        }
    }

    fn breakpoint(&self) -> Option<f64> {
        match *self {
            Self::Ramp(_, x0) | Self::RampLeft(_, x0) | Self::Jump(_, x0) => Some(x0),
            _ => None,
        }
    }
}

fn slope(terms: &[Term], x: f64) -> f64 {
    terms.iter().map(|term| term.at(x, x)[1]).sum()
}

/// Smooth piece of a body.
#[derive(Clone)]
pub struct Part<T> {
    pub domain: [T; 2],
    pub at: Arc<dyn Fn(T) -> CurvePoint<T> + Send + Sync>,
}

impl<T: Real> Part<T> {
    /// Returns the piece with each point moved.
    pub fn moved(
        self,
        to: impl Fn(CurvePoint<T>) -> CurvePoint<T> + Send + Sync + 'static,
    ) -> Self {
        let at = self.at;
        Self { domain: self.domain, at: Arc::new(move |k| to(at(k))) }
    }

    /// Returns the curve by another parameter: k = m(q), for q over a range.
    pub fn by(self, range: [T; 2], m: impl Fn(T) -> [T; 2] + Send + Sync + 'static) -> Self {
        let Self { domain: [from, to], at } = self;
        let through = move |q: T| {
            let [k, dk] = m(q);
            // The ends stay the same, to the last bit.
            let point = at(k.max(from).min(to));
            CurvePoint { dx: point.dx * dk, dy: point.dy * dk, ..point }
        };
        Self { domain: range, at: Arc::new(through) }
    }
}

pub type Body<T> = Vec<Part<T>>;

/// Returns the body of some terms, between -4 and 4, in pieces that end at their breakpoints and at
/// `splits`.
fn body<T: Real>(terms: &[Term], sign: f64, splits: &[f64]) -> Body<T> {
    let mut ends: Vec<f64> =
        terms.iter().filter_map(Term::breakpoint).chain(splits.iter().copied()).collect();
    ends.extend([-4.0, 4.0]);
    ends.sort_by(f64::total_cmp);
    ends.dedup();
    let part = |ends: &[f64]| {
        let (terms, middle) = (terms.to_vec(), 0.5 * (ends[0] + ends[1]));
        let at = move |x: T| {
            let [mut y, mut dy] = [T::zero(); 2];
            for term in &terms {
                let [height, slope] = term.at(x, middle);
                (y, dy) = (y + T::of(sign) * height, dy + T::of(sign) * slope);
            }
            CurvePoint { x, y, dx: T::one(), dy }
        };
        Part { domain: [T::of(ends[0]), T::of(ends[1])], at: Arc::new(at) }
    };
    ends.windows(2).map(part).collect()
}

/// Convex gap that touches first at some place near 0, given by two bodies.
#[derive(Clone, Debug)]
pub struct Scene {
    pub upper: Vec<Term>,
    pub lower: Vec<Term>,
    /// Half-width of the loaded contact.
    pub half_width: f64,
    pub kappa: f64,
}

impl Scene {
    pub fn bodies<T: Real>(&self) -> [Body<T>; 2] {
        self.split(&[])
    }

    pub fn split<T: Real>(&self, splits: &[f64]) -> [Body<T>; 2] {
        [body(&self.lower, -1.0, splits), body(&self.upper, 1.0, splits)]
    }

    /// Returns both bodies with one term more on each.
    pub fn on_common<T: Real>(&self, term: Term) -> [Body<T>; 2] {
        let with = |terms: &[Term], sign| body(&[terms, &[term]].concat(), sign, &[]);
        let Term::Wave(c, k) = term else { unreachable!("only waves") };
        let below = [&self.lower[..], &[Term::Wave(-c, k)]].concat();
        [body(&below, -1.0, &[]), with(&self.upper, 1.0)]
    }

    /// Returns the slope of the gap, not at a breakpoint.
    pub fn slope(&self, x: f64) -> f64 {
        slope(&self.upper, x) + slope(&self.lower, x)
    }

    /// Returns the sum of the absolute slopes of all terms of the gap.
    pub fn size(&self, x: f64) -> f64 {
        self.upper.iter().chain(&self.lower).map(|term| term.at(x, x)[1].abs()).sum()
    }

    pub fn tilted(&self, by: f64) -> Self {
        let mut tilted = self.clone();
        tilted.upper.push(Term::Tilt(by));
        tilted
    }

    /// Returns the places where the slope is not smooth, or turns so fast that a quadrature needs a
    /// panel end.
    pub fn breaks(&self) -> Vec<f64> {
        let mut breaks = Vec::new();
        for term in self.upper.iter().chain(&self.lower) {
            breaks.extend(term.breakpoint());
            if let Term::Tanh(_, w, x0) = *term {
                breaks.extend([-4.0, -1.0, 0.0, 1.0, 4.0].map(|share| x0 + share * w));
            }
        }
        breaks
    }
}

/// Rounds a number to one that both types represent.
fn single(x: f64) -> f64 {
    f64::from(x as f32)
}

fn term() -> impl Strategy<Value = Term> {
    (0..8, -2.0..2.0, -1.0..1.0, -1.5..1.5).prop_map(|(kind, size, place, width)| {
        let (c, x0, w) = (single(f64::exp(size)), single(place), single(f64::exp(width)));
        match kind {
            0 | 1 => Term::Line(c, x0),
            2 => Term::Cube(c, x0),
            3 => Term::Sinh(c, w, x0),
            4 => Term::Tanh(c, single(0.3 * w), x0),
            5 => Term::Ramp(c, x0),
            6 => Term::RampLeft(c, x0),
            _ => Term::Jump(c, x0),
        }
    })
}

/// Returns the strategy of all scenes.
pub fn scenes() -> impl Strategy<Value = Scene> {
    let terms = |n: std::ops::Range<usize>| prop::collection::vec(term(), n);
    (terms(1..4), terms(0..3), -0.5..0.5, -3.0..0.2, -8.0..8.0).prop_map(
        |(mut upper, lower, touch, size, kappa)| {
            // A little curvature everywhere, so that the gap closes at one place.
            upper.push(Term::Line(0.25, 0.0));
            let tilt = -slope(&upper, touch) - slope(&lower, touch);
            upper.push(Term::Tilt(single(tilt)));
            let (half_width, kappa) = (single(f64::exp(size)), single(f64::exp(kappa)));
            Scene { upper, lower, half_width, kappa }
        },
    )
}

/// Bodies as profiles for a solve.
pub struct Bodies<T: Real>([Box<dyn ParametricProfile<T>>; 2]);

impl<T: Real> Bodies<T> {
    pub fn new(parts: [Body<T>; 2]) -> Self {
        Self(parts.map(|parts| {
            let curves =
                parts.into_iter().map(|Part { domain, at }| Curve::new(domain, move |k| at(k)));
            Box::new(Piecewise::new(curves.collect()).expect("the pieces meet")) as Box<_>
        }))
    }

    pub fn contact(&self, kappa: T) -> Contact<'_, T> {
        let [lower, upper] = &self.0;
        Contact::new(&**lower, &**upper).expect("two bodies").kappa(kappa)
    }
}
