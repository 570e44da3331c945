//! Curves with automatic derivatives, against the same curves with derivatives written by hand.

use crate::common;
use crate::formulas;

use common::paper;
use formulas::{Lower3, Upper3};
use linecontact::autodiff::{Autodiff, Differentiable, Formula, Over};
use linecontact::{Contact, Control, Flat, ParametricProfile, Piecewise, Real, check_derivatives};
use std::f64::consts::PI;

const UNIT: [f64; 2] = [1.0; 2];
const LOWER_3: Autodiff<Lower3<f64>> = Autodiff(Lower3 { coefficient: 8.0, scale: UNIT });
const UPPER_3: Autodiff<Upper3<f64>> = Autodiff(Upper3 { scale: UNIT });

/// Automatic derivatives equal those written by hand, to the rounding of the terms that cancel.
#[test]
fn derivatives_of_example_3_are_those_of_the_paper() {
    let by_hand = paper::three();
    let pairs: [(&dyn ParametricProfile<f64>, &dyn ParametricProfile<f64>); 2] =
        [(&*by_hand.lower, &LOWER_3), (&*by_hand.upper, &UPPER_3)];
    for (by_hand, auto) in pairs {
        let [from, to] = auto.domain();
        for i in 0..=100 {
            let k = from + (to - from) * f64::from(i) / 100.0;
            let (p, q) = (by_hand.at(k), auto.at(k));
            assert_eq!((p.x, p.y), (q.x, q.y));
            assert_eq!((auto.x(k), auto.y(k)), (q.x, q.y));
            assert!((p.dx - q.dx).abs() < 40.0 * f64::EPSILON * 10.0, "{k}");
            assert!((p.dy - q.dy).abs() < 40.0 * f64::EPSILON * 1e6 * 10.0, "{k}");
        }
        check_derivatives(auto).unwrap();
    }
}

/// The contact matches the reference, at the cost of a solve with derivatives written by hand.
#[test]
fn example_3_is_solved_without_derivatives() {
    let reference = common::reference("paper_example_3_scale_one");
    let by_hand = paper::three();
    let (lower, upper) = (LOWER_3, UPPER_3);
    let load = Control::Load(reference.c / PI);
    let contact = Contact::new(&lower, &upper).unwrap();
    let solution = contact.solve(load).unwrap();
    // The formulas have noise of 2e-14.
    approx::assert_relative_eq!(solution.a(), reference.a, epsilon = 0.0, max_relative = 1e-14);
    approx::assert_relative_eq!(solution.b(), reference.b, epsilon = 0.0, max_relative = 1e-14);
    let contact = Contact::new(&*by_hand.lower, &*by_hand.upper).unwrap();
    let evaluations = contact.solve(load).unwrap().cost().evaluations;
    assert!(solution.cost().evaluations <= evaluations + 10, "{evaluations}");
}

/// One flank of a wedge, in double or single precision.
struct Flank<T> {
    slope: T,
    range: [T; 2],
}

impl<T: Real> Formula<T> for Flank<T> {
    fn domain(&self) -> [T; 2] {
        self.range
    }
    fn point<N: Over<T>>(&self, k: N) -> (N, N) {
        (k, N::lift(self.slope) * k)
    }
}

#[test]
fn pieces_are_joined_in_either_precision() {
    fn half_width<T: Differentiable>() -> T {
        let (zero, one) = (T::zero(), T::one());
        let flanks = vec![
            Autodiff(Flank { slope: -one, range: [-one, zero] }),
            Autodiff(Flank { slope: one, range: [zero, one] }),
        ];
        let wedge = Piecewise::new(flanks).unwrap();
        let contact = Contact::new(&Flat, &wedge).unwrap();
        contact.solve(Control::Load(T::of(0.5))).unwrap().a()
    }
    // F = 2 m L/π.
    approx::assert_relative_eq!(half_width::<f64>(), PI / 4.0, epsilon = 0.0, max_relative = 1e-14);
    let single = f64::from(half_width::<f32>());
    approx::assert_relative_eq!(single, PI / 4.0, epsilon = 0.0, max_relative = 1e-6);
}
