//! Part 1: solving `X(k) = x`, each time from the whole domain and without an initial guess.

use super::curves::{self, Profile};
use super::{Tally, searches};
use linecontact::search::{Bracket, LimitSearch, SearchError};
use linecontact::{Curve, CurvePoint, ParametricProfile};
use std::f64::consts::FRAC_PI_2;

const TARGETS: i32 = 101;

/// Largest error of k that passes, in units of the attainable error.
const MAX_EXCESS: f64 = 4.0;

/// Curve, and the k towards which the targets crowd from the far end of its domain.
struct Case {
    name: &'static str,
    profile: Profile,
    /// Index of the piece, if the profile has pieces.
    piece: usize,
    hard: f64,
    /// Distance of the last target from `hard`, as a fraction of the distance of the first.
    closest: f64,
    /// Rounding error of X(k) where large terms cancel in it, as an absolute length.
    noise: f64,
}

impl Case {
    fn new(name: &'static str, profile: Profile, hard: f64, closest: f64) -> Self {
        Self { name, profile, piece: 0, hard, closest, noise: 0.0 }
    }

    fn paper(name: &'static str, profile: Profile, piece: usize, noise: f64) -> Self {
        Self { piece, noise, ..Self::new(name, profile, 0.0, 1e-4) }
    }

    fn curve(&self) -> &dyn ParametricProfile<f64> {
        self.profile.piece(self.piece).map_or(&*self.profile, |piece| piece.curve)
    }

    /// Returns the roots sought, in geometric progression.
    fn targets(&self) -> impl Iterator<Item = f64> {
        let Self { hard, closest, .. } = *self;
        let [from, to] = self.curve().domain().map(|end| end - hard);
        let far = if from.abs() > to.abs() { from } else { to };
        (0..TARGETS)
            .map(move |i| hard + 0.7 * far * closest.powf(f64::from(i) / f64::from(TARGETS - 1)))
    }

    /// Returns the smallest error of k that a search can reach: the last two bits of k, where it
    /// stops, and the effect of rounding in x and X(k).
    fn attainable(&self, k: f64, point: CurvePoint<f64>) -> f64 {
        let rounding = f64::EPSILON * point.x.abs() + self.noise;
        4.0 * f64::EPSILON * k.abs() + rounding / point.dx.abs()
    }
}

fn abscissa<F>(end: f64, x: F) -> Profile
where
    F: Fn(f64) -> [f64; 2] + Send + Sync + 'static,
{
    Box::new(Curve::new([-end, end], move |k| {
        let [x, dx] = x(k);
        CurvePoint { x, y: 0.0, dx, dy: 0.0 }
    }))
}

fn cubic(eps: f64) -> Profile {
    abscissa(1.0, move |k| [k * k * k + eps * k, 3.0 * k * k + eps])
}

fn cases() -> Vec<Case> {
    let sine = abscissa(FRAC_PI_2, |k| [k.sin(), k.cos()]);
    let fold = abscissa(1.0, |k| [3.0 * k - k * k * k, 3.0 - 3.0 * k * k]);
    let sinh = abscissa(1.0, |k| {
        let (u, unit) = (40.0 * k, 40f64.sinh());
        [u.sinh() / unit, 40.0 * u.cosh() / unit]
    });
    let huge = abscissa(1e150, |k| {
        let u = k / 1e150;
        [k + k * u * u, 1.0 + 3.0 * u * u]
    });
    vec![
        Case::paper("Example 3, lower body", curves::three().lower, 0, 8e-15),
        Case::paper("Example 5, lower left", curves::five().lower, 0, 0.0),
        Case::paper("Example 5, lower right", curves::five().lower, 1, 4e-15),
        Case::paper("Example 5, upper right", curves::five().upper, 1, 0.0),
        Case::new("sin k, to its fold", sine, FRAC_PI_2, 1e-6),
        Case::new("3k - k^3, to its fold", fold, 1.0, 1e-6),
        Case::new("sinh 40k / sinh 40", sinh, 0.0, 1e-6),
        Case::new("k^3 + 2^-20 k", cubic(2f64.powi(-20)), 0.0, 1e-6),
        Case::new("k^3 + 2^-30 k", cubic(2f64.powi(-30)), 0.0, 1e-8),
        Case::new("k, to k = 1e-150", abscissa(1.0, |k| [k, 1.0]), 0.0, 1e-150),
        Case::new("k + k^3/1e300, k to 1e150", huge, 0.0, 1e-150),
    ]
}

/// Results for all the targets on one curve.
#[derive(Default)]
struct Outcome {
    evaluations: usize,
    most: usize,
    /// Largest relative errors of k, and of X(k) compared with x.
    errors: [f64; 2],
    /// Largest error of k in units of the attainable error.
    excess: f64,
    failure: Option<SearchError<f64>>,
}

fn invert(case: &Case, search: &dyn LimitSearch<f64>) -> Outcome {
    let curve = case.curve();
    let [lo, hi] = curve.domain();
    let mut outcome = Outcome::default();
    for k in case.targets() {
        let mut exact = curve.at(k);
        // As a rule no k meets x to the last bit. This keeps it so here.
        exact.x = exact.x.next_up();
        let mut f = |k: f64| {
            let point = curve.at(k);
            (point.x - exact.x, point.dx)
        };
        match search.find_with_slope(&mut f, &Bracket::new(lo, hi)) {
            Ok(root) => {
                let error = (root.x - k).abs();
                let [of_k, of_x] = &mut outcome.errors;
                *of_k = of_k.max(error / k.abs());
                *of_x = of_x.max((curve.x(root.x) / exact.x - 1.0).abs());
                outcome.excess = outcome.excess.max(error / case.attainable(k, exact));
                outcome.evaluations += root.evaluations;
                outcome.most = outcome.most.max(root.evaluations);
            }
            Err(error) => outcome.failure = Some(error),
        }
    }
    outcome
}

/// Prints the table.
pub fn cold() -> Tally {
    println!(
        "# 1. Inversion of X(k) = x on one curve, from its whole domain, ends included in the"
    );
    println!(
        "# count. {TARGETS} targets crowd geometrically towards a point: k = 0, a fold, or what"
    );
    println!(
        "# the name says. The reference is the k from which x = X(k) was computed. err(k) and"
    );
    println!(
        "# err(x) are relative, and limited where X is flat or cancels; \"of best\" is the error"
    );
    println!("# of k divided by what the last bits of k, x and X(k) allow.");
    println!(
        "{:<26} {:<10} {:>7} {:>5} {:>9} {:>9} {:>8}",
        "curve", "search", "mean", "most", "err(k)", "err(x)", "of best"
    );
    let mut tally = Tally::default();
    for case in cases() {
        for (i, (search, strategy)) in searches().into_iter().enumerate() {
            let outcome = invert(&case, &*strategy);
            let Outcome { evaluations, most, errors: [k, x], excess, .. } = outcome;
            let name = if i == 0 { case.name } else { "" };
            let mean = evaluations as f64 / f64::from(TARGETS);
            print!("{name:<26} {search:<10} {mean:>7.1} {most:>5} {k:>9.1e} {x:>9.1e}");
            println!(" {excess:>8.2}");
            tally.count(search, mean.round() as usize);
            if excess > MAX_EXCESS {
                tally.fail(search, "k is less accurate than the numbers allow");
            }
            if let Some(error) = outcome.failure {
                tally.fail(search, &error.to_string());
            }
        }
    }
    tally
}
