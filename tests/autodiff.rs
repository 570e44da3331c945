//! Curves without hand-written derivatives, against the same curves with them.

mod common;

use common::paper;
use linecontact::autodiff::{Autodiff, Formula};
use linecontact::{Contact, Flat, Load, ParametricProfile, Piecewise, Real, check_derivatives};
use std::f64::consts::PI;

/// The two bodies of the paper's Example 3, Eqs. (33), (34), without their derivatives.
struct Lower3;
struct Upper3;

impl Formula<f64> for Lower3 {
    fn domain(&self) -> [f64; 2] {
        [-1.353999702552852, 0.7911938540783813]
    }
    fn point<N: Real>(&self, k: N) -> (N, N) {
        let n = N::of;
        let (s, c) = k.sin_cos();
        let x = n(2.0) * c - n(8.0) * k * c - n(9.0) * s + n(7.0) * k * s - n(2.0);
        let y = n(15.0) * s + n(9.0) * c - n(15.0) * k * c - n(6.0) * k * s - n(9.0);
        (x, y * n(1e5))
    }
}

impl Formula<f64> for Upper3 {
    fn domain(&self) -> [f64; 2] {
        [-1.428061671618955, 0.7623463067015128]
    }
    fn point<N: Real>(&self, k: N) -> (N, N) {
        let n = N::of;
        let (s, c) = k.sin_cos();
        let x = n(7.0) * s - n(8.0) * c + n(3.0) * k * c - n(9.0) * k * s + n(8.0);
        let y = n(35.0) * k * c - n(35.0) * s - n(30.0) * c + n(10.0) * k * s + n(30.0);
        (x, y * n(1e5))
    }
}

/// Derivatives are those written by hand, to the rounding of the terms that cancel in them.
#[test]
fn derivatives_of_example_3_are_those_of_the_paper() {
    let by_hand = paper::three();
    let pairs: [(&dyn ParametricProfile<f64>, &dyn ParametricProfile<f64>); 2] =
        [(&*by_hand.lower, &Autodiff(Lower3)), (&*by_hand.upper, &Autodiff(Upper3))];
    for (by_hand, auto) in pairs {
        let [from, to] = by_hand.domain();
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

/// The contact is that of the reference, and costs what it costs with derivatives written by hand.
#[test]
fn example_3_is_solved_without_derivatives() {
    let reference = common::reference("paper_example_3_scale_one");
    let by_hand = paper::three();
    let (lower, upper) = (Autodiff(Lower3), Autodiff(Upper3));
    let load = Load::Constant(reference.c);
    let contact = Contact::new(&lower, &upper).unwrap();
    let solution = contact.solve(load).unwrap();
    approx::assert_relative_eq!(solution.a(), reference.a, epsilon = 0.0, max_relative = 5e-15);
    approx::assert_relative_eq!(solution.b(), reference.b, epsilon = 0.0, max_relative = 5e-15);
    let contact = Contact::new(&*by_hand.lower, &*by_hand.upper).unwrap();
    let evaluations = contact.solve(load).unwrap().cost().evaluations;
    assert!(solution.cost().evaluations <= evaluations + 10, "{evaluations}");
}

/// One flank of a wedge; single precision works alike.
struct Flank<T> {
    slope: T,
    range: [T; 2],
}

impl<T: Real> Formula<T> for Flank<T> {
    fn domain(&self) -> [T; 2] {
        self.range
    }
    fn point<N: linecontact::autodiff::Over<T>>(&self, k: N) -> (N, N) {
        (k, N::lift(self.slope) * k)
    }
}

#[test]
fn pieces_are_joined_in_either_precision() {
    fn half_width<T: Real + linecontact::autodiff::Differentiable>() -> T {
        let (zero, one) = (T::zero(), T::one());
        let flanks = vec![
            Autodiff(Flank { slope: -one, range: [-one, zero] }),
            Autodiff(Flank { slope: one, range: [zero, one] }),
        ];
        let wedge = Piecewise::new(flanks).unwrap();
        let contact = Contact::new(&Flat, &wedge).unwrap();
        contact.solve(Load::PerLength(T::of(0.5))).unwrap().a()
    }
    // F = 2 m L/π.
    approx::assert_relative_eq!(half_width::<f64>(), PI / 4.0, epsilon = 0.0, max_relative = 1e-14);
    let single = f64::from(half_width::<f32>());
    approx::assert_relative_eq!(single, PI / 4.0, epsilon = 0.0, max_relative = 1e-6);
}
