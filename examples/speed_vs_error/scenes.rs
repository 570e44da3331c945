//! The contacts, with their known solutions.

use super::common::{self, Profile, paper, reference};
use linecontact::{Contact, ContactError, Control, Curve, CurvePoint, Edge, Flat, Interval};
use std::f64::consts::{FRAC_PI_2, PI};

/// Two bodies, their load, and their solution.
pub struct Scene {
    pub name: &'static str,
    pub lower: Profile,
    pub upper: Profile,
    kappa: f64,
    c: f64,
    /// True if the limits are given.
    pub fixed: bool,
    pub limits: Interval<f64>,
    /// Pairs of x and P(x), no closer to an edge than the outermost of 101 equidistant points.
    pub inside: Vec<[f64; 2]>,
    /// Pairs of x and P(x) at about a millionth of the half-width from an edge.
    pub edge: Vec<[f64; 2]>,
    /// Source of P(x).
    pub source: &'static str,
    /// Largest error of the default that passes, for the limits and the pressure inside: 1e-12, or
    /// more if the data do not allow that.
    pub allowed: f64,
}

pub const CLOSED_FORM: &str = "101 points, closed form";
pub const FILE: &str = "points of the reference file";

/// Place of the outermost of 101 equidistant points, in half-widths from the centre.
const OUTERMOST: f64 = 100.0 / 102.0;

impl Scene {
    pub fn contact(&self) -> Result<Contact<'_, f64>, ContactError<f64>> {
        let contact = Contact::new(&*self.lower, &*self.upper)?.kappa(self.kappa);
        let Interval { left, right } = self.limits;
        let fixed = [Edge::Fixed(left), Edge::Fixed(right)];
        Ok(match self.fixed {
            true => contact.edges(fixed[0], fixed[1]).single_interval(true),
            false => contact,
        })
    }

    pub fn load(&self) -> Control<f64> {
        Control::Load(self.c / PI)
    }

    pub fn mean_pressure(&self) -> f64 {
        self.c / PI / (self.limits.right - self.limits.left)
    }

    /// Returns 101 equidistant points.
    pub fn grid(&self) -> [f64; 101] {
        let (c, half) = (self.limits.centre(), self.limits.half_width());
        std::array::from_fn(|i| c + half * (-1.0 + 2.0 * (i + 1) as f64 / 102.0))
    }

    /// Makes a scene whose pressure has a closed form.
    fn exact(
        name: &'static str,
        [lower, upper]: [Profile; 2],
        (kappa, c): (f64, f64),
        [left, right]: [f64; 2],
        pressure: impl Fn(f64) -> f64,
    ) -> Self {
        let limits = Interval { left, right };
        let (source, allowed) = (CLOSED_FORM, 1e-12);
        let (inside, edge, fixed) = (Vec::new(), Vec::new(), false);
        let mut scene =
            Self { name, lower, upper, kappa, c, fixed, limits, inside, edge, source, allowed };
        let step = 1e-6 * limits.half_width();
        scene.inside = scene.grid().map(|x| [x, pressure(x)]).to_vec();
        scene.edge = [left + step, right - step].map(|x| [x, pressure(x)]).to_vec();
        scene
    }

    /// Makes a scene from a reference file.
    fn of_file(name: &'static str, file: &str, [lower, upper]: [Profile; 2]) -> Self {
        let want = reference(file);
        let limits = Interval { left: -want.b, right: want.a };
        let near = |x: f64| want.z(x).abs();
        let finite = want.points.iter().copied().filter(|[_, p]| p.is_finite());
        let inside = finite.clone().filter(|&[x, _]| near(x) <= OUTERMOST).collect();
        let edge = finite.filter(|&[x, _]| near(x) > 1.0 - 1e-5).collect();
        let (kappa, c) = (want.kappa, want.c);
        // Effect of the rounding of data and limits on the pressure.
        let weighed = want.points.iter().zip(&want.amplification);
        let magnified = weighed.filter(|([x, _], _)| near(*x) <= OUTERMOST).map(|(_, &by)| by);
        let allowed = 10.0 * f64::EPSILON * magnified.fold(0.0, f64::max);
        let (source, allowed, fixed) = (FILE, allowed.max(1e-12), false);
        Self { name, lower, upper, kappa, c, fixed, limits, inside, edge, source, allowed }
    }
}

/// Returns all scenes.
pub fn all() -> Vec<Scene> {
    let of = |paper::Example { lower, upper, .. }| [lower, upper];
    let printed = |name, file, example| Scene::of_file(name, file, of(example));
    let shared = |name, file| {
        let scene = common::scenes().into_iter().find(|scene| scene.name == file);
        let scene = scene.expect("one of the scenes that the tests share");
        Scene::of_file(name, file, [scene.lower, scene.upper])
    };
    let [one, two] = [paper::one(), paper::two()];
    let (load_1, load_2) = ((1.0, one.c), (FRAC_PI_2, two.c));
    let one =
        Scene::exact(
            "Example 1",
            of(one),
            load_1,
            [-1.0, 1.0],
            |x| match common::example_1_exact(x) {
                // A pressure of zero has no relative error.
                0.0 => f64::NAN,
                p => p,
            },
        );
    let two = Scene::exact("Example 2", of(two), load_2, [-0.6, 1.0], common::example_2_exact);
    let mut scenes = vec![
        Scene { fixed: true, ..one },
        two,
        printed("Example 3", "paper_example_3_scale_one", paper::three()),
        // The formulas of these two examples have a noise of 6e-13 and 1e-13 of the slope.
        Scene {
            allowed: 1e-11,
            ..printed("Example 4", "paper_example_4_scale_one", paper::four())
        },
        Scene {
            allowed: 4e-12,
            ..printed("Example 5", "paper_example_5_scale_one", paper::five())
        },
        circle("circle L/R=0.5", 0.5),
        circle("circle L/R=0.99", 0.99),
        wedge(),
        shared("curvature 1 and 1e6", "asym_parabola_1e6"),
        shared("rounded punch 1+1e-6", "rounded_punch_1e-6"),
        shared("gear teeth", "gear_involute_pitch_point"),
        Scene::of_file("|x|^1.5", "power_n_3_over_2", [Box::new(Flat), common::power(1.5)]),
        shared("|x|^20", "power_n_20"),
    ];
    scenes.iter_mut().for_each(|scene| scene.inside.retain(|[_, p]| !p.is_nan()));
    scenes
}

/// Makes a circle of radius 1 on a flat.
///
/// `P = (1/π) ∫ F'(l)/sqrt(l² - x²) dl` from |x| to L, with positive terms only. F is the load for
/// the half-width l: `F' = (2/π) l E(l)/(1 - l²)`, E the complete elliptic integral.
fn circle(name: &'static str, half_width: f64) -> Scene {
    let share = |l: f64| {
        // The integrand is periodic: equal steps converge like a geometric series.
        let sines = (0..256).map(|i| (PI * (f64::from(i) + 0.5) / 256.0).sin());
        let mean = sines.map(|s| (1.0 - (l * s).powi(2)).sqrt()).sum::<f64>() / 256.0;
        mean / ((1.0 - l) * (1.0 + l))
    };
    let body = Curve::new([-1.5, 1.5], |k: f64| {
        let (half_sin, half_cos) = (0.5 * k).sin_cos();
        let down = 2.0 * half_sin * half_sin;
        let sin = 2.0 * half_sin * half_cos;
        CurvePoint { x: sin, y: down, dx: 1.0 - down, dy: sin }
    });
    let c = PI * integral(|s| s * half_width * half_width * share(s * half_width));
    let pressure = |x: f64| {
        let square = (half_width - x) * (half_width + x);
        square.sqrt() / PI * integral(|s| share((x * x + square * s * s).sqrt()))
    };
    let bodies: [Profile; 2] = [Box::new(Flat), Box::new(body)];
    Scene::exact(name, bodies, (1.0, c), [-half_width, half_width], pressure)
}

/// Integrates from 0 to 1 by the doubly exponential rule.
fn integral(f: impl Fn(f64) -> f64) -> f64 {
    const STEP: f64 = 1.0 / 32.0;
    let nodes = (-112..=112).map(|i| {
        let t = STEP * f64::from(i);
        let s = 1.0 / (1.0 + (-PI * t.sinh()).exp());
        f(s) * s * (1.0 - s) * PI * t.cosh()
    });
    STEP * nodes.sum::<f64>()
}

/// Makes a wedge. The pressure is the integral of a kernel Λ times the derivative of the slope;
/// here only the jump by 2 at 0 remains: `P = (2/π²) Λ(x, 0)`.
fn wedge() -> Scene {
    let want = reference("tilted_wedge");
    let (a, b) = (want.a, want.b);
    let scene = common::scenes().into_iter().find(|scene| scene.name == "tilted_wedge");
    let scene = scene.expect("one of the scenes that the tests share");
    Scene::exact("wedge", [scene.lower, scene.upper], (1.0, want.c), [-b, a], move |x| {
        let (m, n) = ((a * (x + b)).sqrt(), ((a - x) * b).sqrt());
        let ratio = 2.0 * m.min(n) * (m + n) / (x.abs() * (a + b));
        2.0 / (PI * PI) * ratio.ln_1p()
    })
}
