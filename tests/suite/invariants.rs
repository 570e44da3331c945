//! Results that must not change, or must change in a known way, if the same contact is given
//! differently: random scenes, the same in every run.
#![allow(missing_docs)]

use crate::common::NanSafe;
use crate::integrals;
mod scene;

use integrals::{integral, principal, strength};
use linecontact::{Contact, Control, Cost, CurvePoint};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;
use scene::{Bodies, Body, Part, Scene, Term, scenes};

const EPSILON: f64 = f64::EPSILON;

/// Solved contact with its error estimates.
#[derive(Clone, Copy, Debug)]
struct Answer {
    left: f64,
    right: f64,
    load: f64,
    /// Absolute error of the limits.
    error: f64,
    /// Pressures at five places along the contact, with their errors.
    pressures: [[f64; 2]; PLACES.len()],
}

const PLACES: [f64; 5] = [-0.95, -0.4, 0.05, 0.5, 0.97];

fn answer(contact: &Contact<f64>, load: Control<f64>) -> Answer {
    let solution = contact.solve(load).unwrap_or_else(|error| panic!("{error}"));
    let on = solution.hull();
    let pressure = solution.pressure().expect("pressures");
    let error = solution.limits_error().expect("limits that were sought") * on.half_width();
    let pressures = PLACES.map(|z| {
        let x = on.centre() + on.half_width() * z;
        let at = |x| pressure.estimate(x, &mut Cost::default()).expect("a pressure");
        // The place is as uncertain as the limits; beside a jump the pressure is steep.
        let beside = at(x + error + 2.0 * EPSILON * x.abs()).value;
        [at(x).value, at(x).error + (beside - at(x).value).abs()]
    });
    Answer { left: on.left, right: on.right, load: solution.load(), error, pressures }
}

impl Answer {
    fn of(bodies: [Body<f64>; 2], kappa: f64, load: Control<f64>) -> Self {
        answer(&Bodies::new(bodies).contact(kappa), load)
    }

    fn scaled(self, x: f64, pressure: f64) -> Self {
        Self {
            left: x * self.left,
            right: x * self.right,
            load: x * pressure * self.load,
            error: x * self.error,
            pressures: self.pressures.map(|both| both.map(|value| pressure * value)),
        }
    }

    fn mirrored(self) -> Self {
        Self { left: -self.right, right: -self.left, ..self }
    }

    fn shifted(self, by: f64) -> Self {
        Self { left: self.left + by, right: self.right + by, ..self }
    }

    /// Tells whether both answers have the same bits.
    fn is_exactly(&self, other: &Self) -> bool {
        let bits = |a: &Self| {
            [a.left, a.right, a.load, a.pressures[1][0], a.pressures[4][0]].map(f64::to_bits)
        };
        bits(self) == bits(other)
    }

    /// Checks that both limits agree within their estimates and the rounding of the limits.
    fn agrees(&self, other: &Self) -> Result<(), String> {
        let half_width = 0.5 * (self.right - self.left);
        let rounding = 4.0 * EPSILON * (self.left.abs().max(self.right.abs()) + half_width);
        let allowed = 2.0 * (self.error + other.error) + rounding;
        let off = (self.left - other.left).abs().nan_max((self.right - other.right).abs());
        if off.is_nan() || off > allowed {
            return Err(format!(
                "limits off by {:e} L, allowed {:e} L",
                off / half_width,
                allowed / half_width
            ));
        }
        let load = (self.load / other.load - 1.0).abs();
        if load.is_nan() || load > 10.0 * allowed / half_width {
            return Err(format!("load off by {load:e}, allowed {:e}", 10.0 * allowed / half_width));
        }
        Ok(())
    }

    /// Checks that limits and pressures agree.
    fn agrees_all(&self, other: &Self) -> Result<(), String> {
        self.agrees(other)?;
        let half_width = 0.5 * (self.right - self.left);
        let moved = EPSILON * (self.left.abs().max(self.right.abs()) / half_width + 1.0);
        for (i, z) in PLACES.into_iter().enumerate() {
            let ([one, e_one], [two, e_two]) = (self.pressures[i], other.pressures[i]);
            // The places depend on the limits of each answer.
            let steep = self.load / half_width / (1.0 - z * z);
            let limits = (self.error + other.error) / half_width;
            let allowed = 2.0 * (e_one + e_two) + 4.0 * steep * (moved + limits);
            let off = (one - two).abs();
            if off.is_nan() || off > allowed {
                return Err(format!("pressure {one:e} at {z} off by {off:e}, allowed {allowed:e}"));
            }
        }
        Ok(())
    }
}

fn base(scene: &Scene) -> Answer {
    Answer::of(scene.bodies(), scene.kappa, Control::HalfWidth(scene.half_width))
}

/// Returns the base answer with a wider error, for slopes that are rounded anew. A common rounding
/// of all slopes shifts the limits, which no solver can detect.
fn rounded(scene: &Scene, common: f64) -> Answer {
    let wanted = base(scene);
    let size = common + scene.size(wanted.left).max(scene.size(wanted.right));
    let tilt = 1e-6 * (scene.slope(wanted.right) - scene.slope(wanted.left));
    let tilted = changed(scene, wanted.load, scene.tilted(tilt).bodies());
    let off = (tilted.left - wanted.left).abs().nan_max((tilted.right - wanted.right).abs());
    Answer { error: wanted.error + 2.0 * EPSILON * size * off / tilt, ..wanted }
}

/// Solves changed bodies under the load of the scene's half-width.
fn changed(scene: &Scene, load: f64, bodies: [Body<f64>; 2]) -> Answer {
    Answer::of(bodies, scene.kappa, Control::Load(load))
}

fn moved(
    bodies: [Body<f64>; 2],
    to: impl Fn(CurvePoint<f64>) -> CurvePoint<f64> + Send + Sync + Copy + 'static,
) -> [Body<f64>; 2] {
    bodies.map(|parts| parts.into_iter().map(|part| part.moved(to)).collect())
}

fn mirror(bodies: [Body<f64>; 2]) -> [Body<f64>; 2] {
    let mut bodies = moved(bodies, |p| CurvePoint { x: -p.x, dx: -p.dx, ..p });
    bodies.iter_mut().for_each(|parts| parts.reverse());
    bodies
}

fn flipped(parts: Body<f64>) -> Body<f64> {
    parts.into_iter().map(|part| part.moved(|p| CurvePoint { y: -p.y, dy: -p.dy, ..p })).collect()
}

fn stretched(bodies: [Body<f64>; 2], sx: f64, sy: f64) -> [Body<f64>; 2] {
    moved(bodies, move |p| CurvePoint { x: sx * p.x, y: sy * p.y, dx: sx * p.dx, dy: sy * p.dy })
}

fn config(seed: u64) -> ProptestConfig {
    let rng_seed = RngSeed::Fixed(seed);
    ProptestConfig { cases: 400, rng_seed, failure_persistence: None, ..ProptestConfig::default() }
}

fn holds(agreed: Result<(), String>) -> Result<(), TestCaseError> {
    agreed.map_err(TestCaseError::fail)
}

proptest! {
    #![proptest_config(config(61))]

    #[test]
    fn a_half_width_and_its_load(scene in scenes()) {
        let wanted = base(&scene);
        holds(changed(&scene, wanted.load, scene.bodies()).agrees_all(&wanted))?;
    }

    #[test]
    fn mirrored(scene in scenes()) {
        let wanted = base(&scene);
        let mut got = changed(&scene, wanted.load, mirror(scene.bodies())).mirrored();
        holds(got.agrees(&wanted))?;
        got = changed(&scene, wanted.load, mirror(mirror(scene.bodies())));
        prop_assert!(got.is_exactly(&changed(&scene, wanted.load, scene.bodies())));
    }

    #[test]
    fn bodies_swapped(scene in scenes()) {
        let wanted = base(&scene);
        let [lower, upper] = scene.bodies();
        let got = changed(&scene, wanted.load, [flipped(upper), flipped(lower)]);
        prop_assert!(got.is_exactly(&changed(&scene, wanted.load, scene.bodies())), "{:?} {:?}", got, wanted);
    }

    #[test]
    fn shifted(scene in scenes(), near in -4.0..4.0f64, far in prop::bool::ANY) {
        let wanted = base(&scene);
        let by = if far { near.signum() * 1e8 * scene.half_width } else { near };
        let got = changed(&scene, wanted.load, moved(scene.bodies(), move |p| CurvePoint { x: p.x + by, ..p }));
        let rounded = Answer { error: wanted.error + 2.0 * EPSILON * by.abs(), ..wanted };
        holds(got.agrees(&rounded.shifted(by)))?;
    }

    #[test]
    fn stretched_along_and_across(scene in scenes(), sx in 0.01..100.0f64, sy in 0.01..100.0f64) {
        let wanted = rounded(&scene, 0.0);
        let bodies = stretched(scene.bodies(), sx, sy);
        let got = Answer::of(bodies, scene.kappa, Control::Load(sy * wanted.load));
        holds(got.agrees_all(&wanted.scaled(sx, sy / sx)))?;
    }

    #[test]
    fn powers_of_two_change_no_bit(scene in scenes(), x in -60..60i32, y in -60..60i32, stiff in -200..200i32) {
        let [sx, sy, stiff] = [x, y, stiff].map(|i| 2f64.powi(i));
        let load = base(&scene).load;
        let wanted = changed(&scene, load, scene.bodies());
        let bodies = stretched(scene.bodies(), sx, sy);
        let got = Answer::of(bodies, scene.kappa * stiff, Control::Load(sy * stiff * load));
        let same = got.is_exactly(&wanted.scaled(sx, sy / sx * stiff));
        prop_assert!(same, "{:?} {:?}", got, wanted.scaled(sx, sy / sx * stiff));
    }

    #[test]
    fn a_common_shape(scene in scenes(), size in 0.05..2.0f64, waves in 0.3..4.0f64) {
        let wanted = rounded(&scene, size);
        let got = changed(&scene, wanted.load, scene.on_common(Term::Wave(size, waves)));
        holds(got.agrees_all(&wanted))?;
    }

    #[test]
    fn other_parameters(scene in scenes(), bend in 0.1..3.0f64, falling in [prop::bool::ANY, prop::bool::ANY]) {
        let wanted = rounded(&scene, 0.0);
        let [mut lower, mut upper] = scene.bodies();
        for (parts, falling) in [(&mut lower, falling[0]), (&mut upper, falling[1])] {
            *parts = std::mem::take(parts).into_iter().map(|part| by_sinh(part, bend, falling)).collect();
        }
        holds(changed(&scene, wanted.load, [lower, upper]).agrees_all(&wanted))?;
    }

    #[test]
    fn split_where_it_is_smooth(scene in scenes(), splits in prop::collection::vec(-1.5..1.5f64, 1..4)) {
        let wanted = base(&scene);
        holds(changed(&scene, wanted.load, scene.split(&splits)).agrees_all(&wanted))?;
    }

    #[test]
    fn more_load_is_more_contact(scene in scenes(), more in 1e-6..1.0f64) {
        let wanted = base(&scene);
        let less = changed(&scene, wanted.load * (1.0 - 0.5 * more), scene.bodies());
        let slack = 2.0 * (less.error + wanted.error);
        prop_assert!(less.left >= wanted.left - slack && less.right <= wanted.right + slack);
        let growth = (wanted.right - wanted.left) - (less.right - less.left);
        prop_assert!(growth > -slack && (more < 1e-3 || growth > slack), "{:e} {:e}", growth, slack);
    }

    #[test]
    fn equilibrium_and_the_equation(scene in scenes(), z in -0.99..0.99f64) {
        let bodies = Bodies::new(scene.bodies());
        let contact = bodies.contact(scene.kappa);
        let solution = contact.solve(Control::HalfWidth(scene.half_width)).unwrap();
        let on = solution.hull();
        let all = solution.pressure().unwrap();
        let pressure = |x: f64| all.estimate(x, &mut Cost::default()).map_or(0.0, |p| p.value);
        let breakpoints = scene.breaks();
        let load = integral(on, &breakpoints, strength(on, pressure));
        prop_assert!((load / solution.load() - 1.0).abs() < 1e-11, "{:e} for {:e}", load, solution.load());
        let x = on.centre() + on.half_width() * z;
        prop_assume!(breakpoints.iter().all(|breakpoint| (breakpoint - x).abs() > 1e-3 * on.half_width()));
        let got = principal(on, &breakpoints, x, pressure);
        let size = scene.kappa * (scene.slope(on.left).abs() + scene.slope(on.right).abs());
        let residual = got - scene.kappa * scene.slope(x);
        prop_assert!(residual.abs() < 1e-9 * size, "{:e} of {:e}", residual, size);
    }

    #[test]
    fn single_precision(scene in scenes()) {
        let wanted = base(&scene);
        let bodies = Bodies::<f32>::new(scene.bodies());
        let contact = bodies.contact(scene.kappa as f32);
        let solution = contact.solve(Control::Load(wanted.load as f32)).unwrap();
        let on = solution.hull();
        let half_width = f64::from(on.half_width());
        let error = f64::from(solution.limits_error().unwrap()) * half_width;
        let rounding = 4.0 * f64::from(f32::EPSILON) * (wanted.left.abs().max(wanted.right.abs()) + half_width);
        for (got, want) in [(on.left, wanted.left), (on.right, wanted.right)] {
            let off = (f64::from(got) - want).abs();
            prop_assert!(off <= 2.0 * error + rounding, "off by {:e} L, error {:e} L, rounding {:e}",
                off / half_width, error / half_width, rounding / half_width);
        }
    }
}

/// Returns a piece with an uneven parameter, along which x rises or falls.
fn by_sinh(part: Part<f64>, bend: f64, falling: bool) -> Part<f64> {
    let [from, to] = part.domain;
    let (half, sign) = (0.5 * (to - from), if falling { -1.0 } else { 1.0 });
    part.by([-1.0, 1.0], move |q| {
        let t = sign * bend * q;
        [from + half * (1.0 + t.sinh() / bend.sinh()), half * sign * bend * t.cosh() / bend.sinh()]
    })
}
