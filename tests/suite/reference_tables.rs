//! The values in `docs/reference`, each by a method independent of its origin: the conditions on
//! the limits and the pressure between them as integrals over the slopes of the bodies, the
//! singular equation itself for sharp edges, and sums over the pressure for all derived quantities.
//! The integrals are those of `tests/common/integrals.rs`.
#![allow(missing_docs)]

use crate::boundary_elements::point;
use crate::common::{assert_close, paper, worst};
use crate::integrals::{integral, principal, strength};
use linecontact::profile::{Involute, Placed, Placement};
use linecontact::{Interval, ParametricProfile};
use serde_json::Value;
use std::f64::consts::PI;

const CLOSE: f64 = 1e-11;

fn file(name: &str) -> String {
    let path = format!("{}/docs/reference/{name}", env!("CARGO_MANIFEST_DIR"));
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{path}: {error}"))
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(f64::NAN)
}

#[derive(Clone)]
struct Row {
    quantity: String,
    x: f64,
    depth: f64,
    value: f64,
}

struct Case {
    name: String,
    parameters: Value,
    rows: Vec<Row>,
}

fn cases() -> Vec<Case> {
    let json: Value = serde_json::from_str(&file("cases.json")).unwrap();
    let case = |case: &Value| {
        let row = |row: &Value| Row {
            quantity: row["quantity"].as_str().unwrap().into(),
            x: number(&row["x"]),
            depth: number(&row["depth"]),
            value: number(&row["value"]),
        };
        Case {
            name: case["case"].as_str().unwrap().into(),
            parameters: case["parameters"].clone(),
            rows: case["values"].as_array().unwrap().iter().map(row).collect(),
        }
    };
    json["cases"].as_array().unwrap().iter().map(case).collect()
}

impl Case {
    fn parameter(&self, symbol: &str) -> Option<f64> {
        let mut list = self.parameters.as_array().unwrap().iter();
        list.find(|p| p["symbol"] == symbol).map(|p| number(&p["value"]))
    }

    fn of(&self, symbol: &str) -> f64 {
        self.parameter(symbol).unwrap_or_else(|| panic!("{}: no {symbol}", self.name))
    }

    fn value(&self, quantity: &str) -> f64 {
        let row = self.rows.iter().find(|row| row.quantity == quantity);
        row.unwrap_or_else(|| panic!("{}: no {quantity}", self.name)).value
    }

    fn has(&self, quantity: &str) -> bool {
        self.rows.iter().any(|row| row.quantity == quantity)
    }

    /// Returns (1 - ν²)/E of both bodies, and ν.
    fn materials(&self) -> [[f64; 2]; 2] {
        let of = |e: &str, nu: &str| {
            let nu = self.parameter(nu).or(self.parameter("nu")).unwrap_or(0.0);
            let e = self.parameter(e).or(self.parameter("E"));
            [e.map_or(0.0, |e| (1.0 - nu * nu) / e), nu]
        };
        [of("E1", "nu1"), of("E2", "nu2")]
    }

    fn modulus(&self) -> f64 {
        let [one, other] = self.materials();
        self.parameter("E*").unwrap_or(1.0 / (one[0] + other[0]))
    }

    fn load(&self) -> f64 {
        let with_pi = self.parameter("C").or(self.parameter("pi F"));
        with_pi.map_or_else(|| self.of("F"), |c| c / PI)
    }

    /// Returns the contacts, from left to right.
    fn contacts(&self) -> Vec<Interval<f64>> {
        let on = |left, right| Interval { left, right };
        let pair = |left: &str, right: &str| on(self.value(left), self.value(right));
        match self.name.as_str() {
            "two_contacts" => {
                let right = pair("left_limit", "right_limit");
                vec![on(-right.right, -right.left), right]
            }
            "three_contacts" => {
                let (right, middle) = (pair("left_limit", "right_limit"), self.value("half_width"));
                vec![on(-right.right, -right.left), on(-middle, middle), right]
            }
            "wavy_parabola" => {
                vec![pair("left_limit_1", "right_limit_1"), pair("left_limit_2", "right_limit_2")]
            }
            "lifted_punch" => vec![on(-self.of("H"), self.value("right_limit"))],
            "flat_punch" | "tilted_punch" => vec![on(-self.of("H"), self.of("H"))],
            _ if self.has("half_width") => {
                vec![on(-self.value("half_width"), self.value("half_width"))]
            }
            _ => vec![pair("left_limit", "right_limit")],
        }
    }
}

/// Returns the slope of a body at x.
fn slope_of(body: &dyn ParametricProfile<f64>, x: f64) -> f64 {
    let at = point(body, x);
    at.dy / at.dx
}

fn of_bodies(
    lower: Box<dyn ParametricProfile<f64>>,
    upper: Box<dyn ParametricProfile<f64>>,
) -> Box<dyn Fn(f64) -> f64> {
    Box::new(move |x| slope_of(&*upper, x) - slope_of(&*lower, x))
}

/// Any number of free contacts: slope of the gap, its kinks, and the limits.
struct Free {
    slope: Box<dyn Fn(f64) -> f64>,
    kinks: Vec<f64>,
    kappa: f64,
    contacts: Vec<Interval<f64>>,
}

impl Free {
    /// Returns `R(x)` without the two factors of one contact.
    fn others(&self, without: usize, x: f64) -> f64 {
        let of = |(j, on): (usize, &Interval<f64>)| {
            if j == without { 1.0 } else { (x - on.left) * (x - on.right) }
        };
        self.contacts.iter().enumerate().map(of).product()
    }

    fn sign(&self, j: usize) -> f64 {
        if (self.contacts.len() - 1 - j).is_multiple_of(2) { 1.0 } else { -1.0 }
    }

    /// Returns `∫ f(s)/sqrt(R)` over all contacts, with the sign of the root.
    fn weighted(&self, ends: &[f64], f: impl Fn(f64) -> f64) -> f64 {
        let of = |(j, on): (usize, &Interval<f64>)| {
            self.sign(j) * integral(*on, ends, |s| f(s) / self.others(j, s).abs().sqrt())
        };
        self.contacts.iter().enumerate().map(of).sum()
    }

    /// Returns the load, and the largest residual of the conditions on the limits, relative to
    /// their terms.
    fn conditions(&self) -> [f64; 2] {
        let count = self.contacts.len() as i32;
        let g = |s: f64| self.kappa * (self.slope)(s);
        let moment = |k: i32| self.weighted(&self.kinks, |s| s.powi(k) * g(s));
        let size = |k: i32| {
            let of = |(j, on): (usize, &Interval<f64>)| {
                let part = |s: f64| (s.powi(k) * g(s)).abs() / self.others(j, s).abs().sqrt();
                integral(*on, &self.kinks, part)
            };
            self.contacts.iter().enumerate().map(of).sum::<f64>()
        };
        let mut left = worst((0..count).map(|k| (moment(k) / size(k)).abs()));
        // Every gap closes at both its ends: the opening slope integrates to zero between two
        // contacts.
        for (j, pair) in self.contacts.windows(2).enumerate() {
            let gap = Interval { left: pair[0].right, right: pair[1].left };
            let opens = |x: f64| {
                let root = (x - gap.left) * (gap.right - x);
                let all = self.others(j, x).abs() * ((x - pair[0].left) * (x - pair[0].right));
                all.abs().sqrt() * self.quotient(x) * root.abs().sqrt()
            };
            let size = integral(gap, &[], |x| opens(x).abs());
            left = left.max((integral(gap, &[], opens) / size).abs());
        }
        [moment(count) / PI, left]
    }

    /// Returns `∫ (G(s) - G(x))/(s - x) ds/sqrt(R)`.
    fn quotient(&self, x: f64) -> f64 {
        let at = (self.slope)(x);
        let ends = [&self.kinks[..], &[x]].concat();
        self.kappa * self.weighted(&ends, |s| ((self.slope)(s) - at) / (s - x))
    }

    fn pressure(&self, x: f64) -> f64 {
        let Some(j) = self.contacts.iter().position(|on| x > on.left && x < on.right) else {
            return 0.0;
        };
        let on = self.contacts[j];
        let root = ((x - on.left) * (on.right - x)).sqrt() * self.others(j, x).abs().sqrt();
        self.sign(j) * root * self.quotient(x) / (PI * PI)
    }

    /// Returns the load of one contact.
    fn load_of(&self, j: usize) -> f64 {
        let on = self.contacts[j];
        integral(on, &self.kinks, strength(on, |s| self.pressure(s)))
    }
}

fn free(case: &Case) -> Option<Free> {
    let of = |symbol: &str| case.of(symbol);
    let mut kinks = Vec::new();
    let slope: Box<dyn Fn(f64) -> f64> = match case.name.as_str() {
        "hertz_cylinder" | "partial_slip" | "bulk_tension" => {
            let r = of("R");
            Box::new(move |x| x / r)
        }
        "unlike_cylinders" | "ansys_vm191" => {
            let (one, other) = (of("R1"), of("R2"));
            Box::new(move |x| x / one + x / other)
        }
        "cylinder_in_groove" => {
            let (groove, roller) = (of("R1"), of("R2"));
            Box::new(move |x| {
                x / (roller * roller - x * x).sqrt() - x / (groove * groove - x * x).sqrt()
            })
        }
        "wedge" | "unequal_wedge" => {
            let m = case.parameter("m");
            let (left, right) = (m.unwrap_or_else(|| of("m1")), m.unwrap_or_else(|| of("m2")));
            kinks = vec![0.0];
            Box::new(move |x| if x < 0.0 { -left } else { right })
        }
        "quartic_punch" => {
            let a = of("A");
            Box::new(move |x| 4.0 * a * x.powi(3))
        }
        "rounded_punch" => {
            let (d, r) = (of("d"), of("R"));
            kinks = vec![-d, d];
            Box::new(move |x| (x.abs() - d).max(0.0) / r * x.signum())
        }
        "two_contacts" => {
            let (d, r) = (of("D"), of("r"));
            Box::new(move |x| 4.0 * d / r * (x / r) * ((x / r).powi(2) - 1.0))
        }
        "three_contacts" => {
            let (big, s, r) = (of("R"), of("s"), of("r"));
            Box::new(move |x| {
                let z = x / r;
                let (v, rise) = (s * z * (4.0 * z * z - 3.0), s * (12.0 * z * z - 3.0) / r);
                v * rise / (3.0 * big)
            })
        }
        "wavy_parabola" => {
            let (a, q, s) = (of("A"), of("q"), of("s"));
            Box::new(move |x| x - a * q * (q * x + s).sin())
        }
        "involute_gear" => {
            let flank = |radius: &str, placement| {
                let involute = Involute::new(of(radius), of("t"), [0.01, 1.0]).unwrap();
                Box::new(Placed::new(involute, placement).unwrap())
            };
            let half_turn = Placement::default().mirrored().flipped();
            of_bodies(flank("r1", half_turn), flank("r2", Placement::default()))
        }
        "paper_example_3" | "paper_example_4" | "paper_example_5" => {
            let example = match case.name.as_bytes().last() {
                Some(b'3') => paper::three(),
                Some(b'4') => paper::four(),
                _ => paper::five(),
            };
            kinks = vec![0.0];
            of_bodies(example.lower, example.upper)
        }
        _ => return None,
    };
    let kappa = PI / 2.0 * case.modulus();
    Some(Free { slope, kinks, kappa, contacts: case.contacts() })
}

/// Returns the exact pressure with sharp edges or a period, after checking that it solves the
/// equation.
fn other_pressure(case: &Case) -> Box<dyn Fn(f64) -> f64> {
    let (on, kappa) = (case.contacts()[0], PI / 2.0 * case.modulus());
    match case.name.as_str() {
        "flat_punch" | "tilted_punch" => {
            let right = case.value("edge_strength_right");
            let left = if case.has("edge_strength_left") {
                case.value("edge_strength_left")
            } else {
                right
            };
            let h = case.of("H");
            let pressure = move |x: f64| {
                let z = x / h;
                // Product of the distances to the edges, which are exact.
                0.5 * h * (right + left + (right - left) * z) / ((h - x) * (h + x)).sqrt()
            };
            let slope = case.parameter("m").unwrap_or(0.0);
            for x in [-0.7 * h, 0.1 * h, 0.6 * h] {
                let found = principal(on, &[], x, pressure);
                assert!((found - kappa * slope).abs() < CLOSE * right, "{}", case.name);
            }
            Box::new(pressure)
        }
        "lifted_punch" => {
            let first = case.rows.iter().find(|row| row.quantity == "pressure").unwrap().clone();
            let shape = move |x: f64| ((on.right - x) / (x - on.left)).sqrt();
            let scale = first.value / shape(first.x);
            let pressure = move |x: f64| scale * shape(x);
            for x in [0.9 * on.left, 0.5 * on.left] {
                assert_close(principal(on, &[], x, pressure), kappa * case.of("m"), CLOSE);
            }
            Box::new(pressure)
        }
        "wave" => {
            let (l, peak) = (case.of("l"), case.value("peak_pressure"));
            let sine = move |x: f64| (PI * x / l).sin();
            let pressure = move |x: f64| {
                let inside = sine(on.right - x) * sine(on.right + x);
                peak * (PI * x / l).cos() * inside.max(0.0).sqrt() / sine(on.right)
            };
            let strength = strength(on, pressure);
            for x in [0.1 * on.right, 0.5 * on.right, 0.8 * on.right] {
                let at = strength(x);
                let left = integral(on, &[x], |s| {
                    let angle = PI * (x - s) / l;
                    (strength(s) * angle / angle.tan() - at) / (x - s)
                });
                let slope = 2.0 * PI * case.of("A") / l * (2.0 * PI * x / l).sin();
                assert_close(left, kappa * slope, CLOSE);
            }
            Box::new(pressure)
        }
        name => panic!("{name}: a case without a second way"),
    }
}

/// Returns σ_x, σ_y and τ_xy by Johnson, Eqs. 2.23.
fn stress(on: Interval<f64>, pressure: &dyn Fn(f64) -> f64, x: f64, y: f64) -> [f64; 3] {
    [[2, 1], [0, 3], [1, 2]].map(|[along, down]: [i32; 2]| {
        let kernel = |s: f64| {
            let square = (x - s).powi(2) + y * y;
            -2.0 / PI * pressure(s) * (x - s).powi(along) * y.powi(down) / square.powi(2)
        };
        integral(on, &[x], strength(on, kernel))
    })
}

/// Asserts that a smooth function has its maximum at a place: the value, zero slope, and less on
/// either side.
fn is_largest(value: f64, at: f64, of: impl Fn(f64) -> f64) {
    assert_close(of(at), value, CLOSE);
    let near = |steps: i32| of(at + 3e-4 * at * f64::from(steps));
    let [left, right] = [near(-1), near(1)];
    let slope = (8.0 * (right - left) - (near(2) - near(-2))) / (12.0 * 3e-4 * value);
    assert!(slope.abs() < 1e-10 && left < value && right < value, "{value}: {slope:e}");
}

/// Returns the maximum of a smooth function within a distance of one from a place, by
/// golden-section search.
fn largest_near(place: f64, of: impl Fn(f64) -> f64) -> f64 {
    let golden = 0.5 * (5f64.sqrt() - 1.0);
    let (mut from, mut to) = (place - 1.0, place + 1.0);
    while to - from > 1e-7 {
        let [left, right] = [to - golden * (to - from), from + golden * (to - from)];
        if of(left) < of(right) { from = left } else { to = right }
    }
    of(0.5 * (from + to))
}

/// Returns the displacements of both surfaces towards their references, by a density of the
/// pressure.
fn approaches(
    case: &Case,
    on: Interval<f64>,
    density: &dyn Fn(f64) -> f64,
    roark: bool,
) -> [f64; 2] {
    let [lower, upper] = case.materials();
    let disc = |r: f64| move |s: f64| 2.0 * (2.0 * r / s.abs()).ln() - 2.0;
    let depth = |d: f64, nu: f64| {
        move |s: f64| (d * d / (s * s)).ln_1p() - d * d / ((1.0 - nu) * (d * d + s * s))
    };
    let length = |l: f64| move |s: f64| 2.0 * (l / s.abs()).ln();
    let kernels: [Box<dyn Fn(f64) -> f64>; 2] = match case.name.as_str() {
        "hertz_cylinder" => [Box::new(depth(case.of("d"), lower[1])), Box::new(disc(case.of("R")))],
        "flat_punch" => [Box::new(depth(case.of("d"), lower[1])), Box::new(|_| 0.0)],
        _ if roark => ["R1", "R2"].map(|r| -> Box<dyn Fn(f64) -> f64> {
            Box::new(length(case.of(r) * (-1.0f64 / 6.0).exp()))
        }),
        _ => ["R1", "R2"].map(|r| -> Box<dyn Fn(f64) -> f64> { Box::new(disc(case.of(r))) }),
    };
    let part = |compliance: f64, kernel: &dyn Fn(f64) -> f64| {
        let weighted = |s: f64| if s == 0.0 { 0.0 } else { density(s) * kernel(s) };
        compliance / PI * integral(on, &[0.0], weighted)
    };
    [part(lower[0], &kernels[0]), part(upper[0], &kernels[1])]
}

/// Returns the traction for given limits of the stick zone, after checking that it carries Q, obeys
/// friction, and stretches the stick zone as the tension does.
fn traction(case: &Case, pressure: &dyn Fn(f64) -> f64) -> Box<dyn Fn(f64) -> f64> {
    let (mu, q, on) = (case.of("mu"), case.of("Q"), case.contacts()[0]);
    let c = case.value("stick_half_width");
    if case.name == "rounded_punch" {
        let mut stuck = free(case).unwrap();
        stuck.contacts = vec![Interval { left: -c, right: c }];
        let [load, left] = stuck.conditions();
        assert_close(load, case.load() - q / mu, CLOSE);
        assert!(left < CLOSE);
        let all = free(case).unwrap();
        return Box::new(move |x| mu * (all.pressure(x) - stuck.pressure(x)));
    }
    let centre = if case.has("stick_centre") { case.value("stick_centre") } else { 0.0 };
    let (a, peak) = (on.right, pressure(0.0));
    let q_of = move |x: f64| {
        let root = |z: f64| ((1.0 - z) * (1.0 + z)).max(0.0).sqrt();
        mu * peak * (root(x / a) - c / a * root((x - centre) / c))
    };
    let ends = [centre - c, centre + c];
    assert_close(integral(on, &ends, strength(on, q_of)), q, CLOSE);
    let tension = case.parameter("sigma").unwrap_or(0.0);
    for share in [-0.8, -0.1, 0.5] {
        let x = centre + share * c;
        let found = principal(on, &ends, x, q_of);
        assert!((found - PI * tension / 4.0).abs() < CLOSE * peak, "{}: {found}", case.name);
    }
    Box::new(q_of)
}

fn check(case: &Case) {
    let name = &case.name;
    // Formulas that lose digits, and values with few digits.
    let close = match name.as_str() {
        "paper_example_3" | "paper_example_4" | "paper_example_5" | "wavy_parabola" => 2e-10,
        _ => CLOSE,
    };
    let contacts = case.contacts();
    let (on, load, modulus) = (contacts[0], case.load(), case.modulus());
    let kappa = PI / 2.0 * modulus;
    let scene = free(case);
    if let Some(scene) = &scene {
        let [found, left] = scene.conditions();
        println!("{name}: load {:.1e}, limits {left:.1e}", found / load - 1.0);
        assert_close(found, load, close);
        assert!(left < close, "{name}: {left}");
    }
    let other = if scene.is_none() { Some(other_pressure(case)) } else { None };
    let pressure = |x: f64| match (&scene, &other) {
        (Some(scene), _) => scene.pressure(x),
        (_, Some(other)) => other(x),
        _ => f64::NAN,
    };
    if let Some(other) = &other {
        assert_close(integral(on, &[], strength(on, other)), load, CLOSE);
    }
    // Hertz's pressure is cheap enough for many integrations.
    let hertz = |s: f64| {
        let z = s / on.right;
        pressure_of_hertz(load, on.right) * ((1.0 - z) * (1.0 + z)).max(0.0).sqrt()
    };
    let slips = case.parameter("Q").is_some().then(|| traction(case, &pressure));
    let shear = |y: f64| {
        let [x, y, _] = stress(on, &hertz, 0.0, y);
        0.5 * (x - y).abs()
    };
    let mises = |y: f64| {
        let [sx, sy, _] = stress(on, &hertz, 0.0, y);
        let nu = case.materials()[0][1];
        ((1.0 - nu + nu * nu) * (sx + sy).powi(2) - 3.0 * sx * sy).sqrt()
    };
    for Row { quantity, x, depth, value } in case.rows.clone() {
        let is = |found: f64| {
            let error = (found / value - 1.0).abs();
            assert!(error < close, "{name}: {quantity} {value}, found {found}");
        };
        match quantity.as_str() {
            "contact_modulus" => is(modulus),
            // Checked by the conditions on the limits, or by the equation, above.
            "half_width"
            | "left_limit"
            | "right_limit"
            | "left_limit_1"
            | "right_limit_1"
            | "left_limit_2"
            | "right_limit_2"
            | "edge_strength_left"
            | "edge_strength_right"
            | "stick_half_width"
            | "stick_centre"
            | "peak_x"
            | "max_shear_depth"
            | "max_von_mises_depth" => {}
            "pressure" => is(pressure(x)),
            "peak_pressure" if case.has("peak_x") => {
                is_largest(value, case.value("peak_x"), pressure);
            }
            "peak_pressure" if x.is_nan() => {
                let at = |i: f64| pressure(on.at_angle(PI * i / 100.0));
                let most = (1..100).map(f64::from).max_by(|&i, &j| at(i).total_cmp(&at(j)));
                is(largest_near(most.unwrap(), at));
            }
            "peak_pressure" => is(pressure(x)),
            "mean_pressure" if name == "wave" => is(load / case.of("l")),
            "mean_pressure" => is(load / (on.right - on.left)),
            "sigma_x" => is(stress(on, &hertz, x, depth)[0]),
            "sigma_y" => is(stress(on, &hertz, x, depth)[1]),
            "tau_xy" => is(stress(on, &hertz, x, depth)[2]),
            "max_shear" if name == "wedge" => {
                // Below the tip the shear falls with the square of the depth, next to it faster.
                let scene = scene.as_ref().unwrap();
                let at = |x: f64, y: f64| {
                    let [sx, sy, t] = stress(on, &|s| scene.pressure(s), x, y);
                    (0.5 * (sx - sy)).hypot(t)
                };
                let y = 3e-3 * on.right;
                let tip = (4.0 * at(0.0, y) - at(0.0, 2.0 * y)) / 3.0;
                assert!((tip / value - 1.0).abs() < 5e-10, "{tip} {value}");
                assert!(at(0.1 * y, y) < tip && at(-0.1 * y, y) < tip);
            }
            "max_shear" => is_largest(value, case.value("max_shear_depth"), shear),
            "max_von_mises" => is_largest(value, case.value("max_von_mises_depth"), mises),
            "approach" | "approach_lower" | "approach_upper" | "approach_by_roark" => {
                let density = strength(on, &pressure);
                let of_hertz = strength(on, hertz);
                let simple: &dyn Fn(f64) -> f64 =
                    if name == "flat_punch" { &density } else { &of_hertz };
                let [lower, upper] = approaches(case, on, simple, quantity.ends_with("roark"));
                is(match quantity.as_str() {
                    "approach_lower" => lower,
                    "approach_upper" => upper,
                    _ => lower + upper,
                });
            }
            "stiffness" => {
                // The rate of the pressure is the pressure of a flat punch.
                let [lower, upper] = approaches(case, on, &|_| 1.0 / PI, false);
                is(1.0 / (lower + upper));
            }
            "moment" => is(integral(on, &[], strength(on, |s| s * pressure(s)))),
            "centre_of_pressure" => {
                let kinks = scene.as_ref().map_or(&[][..], |scene| &scene.kinks);
                is(integral(on, kinks, strength(on, |s| s * pressure(s))) / load);
            }
            "load" => is(scene.as_ref().unwrap().load_of(2)),
            "load_1" => is(scene.as_ref().unwrap().load_of(0)),
            "load_2" => is(scene.as_ref().unwrap().load_of(1)),
            "complete_load" => {
                // The pressure p (1 + cos 2πx/l) is nowhere negative; the midpoint rule about the
                // pole is exact.
                let (l, p) = (case.of("l"), value / case.of("l"));
                let at = 0.2 * l;
                let sum = (0..40).map(|i| {
                    let s = at + l * (f64::from(i) + 0.5) / 40.0;
                    p * (2.0 * PI * s / l).cos() / (PI * (at - s) / l).tan()
                });
                let slope = 2.0 * PI * case.of("A") / l * (2.0 * PI * at / l).sin();
                assert_close(sum.sum::<f64>() * PI / 40.0, kappa * slope, CLOSE);
            }
            "merging_load" => {
                // One contact, with zero pressure in the middle.
                let mut merged = free(case).unwrap();
                let end = 2f64.sqrt() * case.of("r");
                merged.contacts = vec![Interval { left: -end, right: end }];
                assert_close(merged.conditions()[0], value, CLOSE);
                assert!(merged.pressure(0.0).abs() < CLOSE * value);
            }
            "traction" => is(slips.as_ref().unwrap()(x)),
            "peak_traction" => {
                let (slips, c) = (slips.as_ref().unwrap(), case.value("stick_half_width"));
                is(slips(c));
                assert!(slips(0.999 * c) < value && slips(1.001 * c) < value);
            }
            other => panic!("{name}: {other} is not checked"),
        }
    }
}

fn pressure_of_hertz(load: f64, half_width: f64) -> f64 {
    2.0 * load / (PI * half_width)
}

#[test]
fn every_value_by_a_second_way() {
    let cases = cases();
    assert!(cases.len() > 20);
    cases.iter().for_each(check);
}

/// The tables agree with the file.
#[test]
fn tables_and_file_agree() {
    let (values, parameters) = (file("values.csv"), file("cases.csv"));
    let mut lines = values.lines().skip(1);
    for case in cases() {
        for Row { quantity, x, depth, value } in &case.rows {
            let shown = |x: &f64| if x.is_nan() { String::new() } else { x.to_string() };
            let start = format!("{},{quantity},{},{},{value},", case.name, shown(x), shown(depth));
            let line = lines.next().unwrap_or_default();
            assert!(line.starts_with(&start), "{line}\n{start}");
        }
        for parameter in case.parameters.as_array().unwrap() {
            let symbol = parameter["symbol"].as_str().unwrap();
            let start = format!("{},{symbol},{},", case.name, number(&parameter["value"]));
            assert!(parameters.lines().any(|line| line.starts_with(&start)), "{start}");
        }
    }
    assert_eq!(lines.next(), None);
}
