//! Declared convexity of bodies, and how a solve checks it.

use crate::common::{controls::controls_of, on_flat, parabola};
use crate::random_scenes::Dice;
use linecontact::profile::{Crowning, Ellipse, Involute, Parabola, Placed, Placement};
use linecontact::{
    Contact, ContactError, Control, Convexity, Curve, CurvePoint, Flat, InputError,
    ParametricProfile, Piece, Piecewise, Real,
};

type Body<T> = Box<dyn ParametricProfile<T>>;

/// Pieces that are declared convex as a whole.
struct Declared<P>(Piecewise<f64, P>);

impl<P: ParametricProfile<f64>> ParametricProfile<f64> for Declared<P> {
    fn domain(&self) -> [f64; 2] {
        self.0.domain()
    }
    fn at(&self, k: f64) -> CurvePoint<f64> {
        self.0.at(k)
    }
    fn pieces(&self) -> usize {
        self.0.pieces()
    }
    fn piece(&self, index: usize) -> Option<Piece<'_, f64>> {
        self.0.piece(index)
    }
    fn convexity(&self) -> Convexity {
        Convexity::Convex
    }
}

fn declared(half: f64, at: impl Fn(f64) -> CurvePoint<f64> + Send + Sync + 'static) -> Body<f64> {
    Box::new(Curve::new([-half, half], at).with_convexity(Convexity::Convex))
}

/// Asserts that the error names places where the slope falls.
fn is_refused(body: &dyn ParametricProfile<f64>, control: Control<f64>, case: &str) {
    let solved = Contact::new(&Flat, body).unwrap().solve(control);
    let error = solved.map(|_| ()).expect_err(case);
    let ContactError::Input(InputError::NotConvex { between, slopes }) = error else {
        panic!("{case}: {error}")
    };
    assert!(between[0] <= between[1] && slopes[0] > slopes[1], "{case}: {error}");
}

/// A wave of curvature 1.5 on a body of curvature 1.
#[test]
fn a_wavy_body_declared_convex_is_refused() {
    let controls = controls_of(&on_flat(parabola(1.0)).solve(Control::Load(0.2)).unwrap());
    for wave_number in [8.0, 15.0, 20.0, 50.0, 200.0] {
        let wave = move |k: f64| {
            let (sin, cos) = (wave_number * k).sin_cos();
            [-1.5 * cos / (wave_number * wave_number), 1.5 * sin / wave_number]
        };
        let parabola = declared(1.0, move |k| {
            let [y, dy] = wave(k);
            CurvePoint { x: k, y: 0.5 * k * k + y, dx: 1.0, dy: k + dy }
        });
        let circle = declared(1.2, move |k| {
            let ((sin, cos), [y, dy]) = (k.sin_cos(), wave(k));
            CurvePoint { x: sin, y: 1.0 - cos + y, dx: cos, dy: sin + dy }
        });
        // A curve whose X is not proportional to k.
        let bent = declared(0.8, move |k| {
            let (x, dx) = (k + 0.2 * k * k * k, 1.0 + 0.6 * k * k);
            let [y, dy] = wave(x);
            CurvePoint { x, y: 0.5 * x * x + y, dx, dy: (x + dy) * dx }
        });
        for (name, body) in [("parabola", &parabola), ("circle", &circle), ("bent", &bent)] {
            for &control in &controls {
                is_refused(&**body, control, &format!("{name}, {wave_number}, {control:?}"));
            }
        }
    }
}

/// Two parabolas that meet in a crest: the slope falls at the joint and nowhere else.
#[test]
fn joints_where_the_slope_falls_are_seen() {
    for fall in [1e-1, 1e-3, 1e-5, 1e-7] {
        let part = |from: f64, to: f64, slope: f64| {
            Curve::new([from, to], move |k: f64| CurvePoint {
                x: k,
                y: 0.5 * k * k + slope * (k - 0.05),
                dx: 1.0,
                dy: k + slope,
            })
        };
        let parts = vec![part(-1.0, 0.05, fall), part(0.05, 1.0, 0.0)];
        let body = Declared(Piecewise::new(parts).unwrap());
        is_refused(&body, Control::Load(0.02), &format!("a joint with a fall of {fall}"));
    }
}

/// Two valleys, with a crest at the start of the search.
#[test]
fn two_valleys_are_refused() {
    let body = declared(2.0, |k| {
        let (y, dy) = (k * k * (k * k - 2.0), 4.0 * k * (k * k - 1.0));
        CurvePoint { x: k, y, dx: 1.0, dy }
    });
    is_refused(&*body, Control::Load(1e-3), "a quartic");
}

/// Returns a body of random shape that bulges upwards or downwards as it declares.
fn bulging<T: Real>(dice: &mut Dice) -> Body<T>
where
    Placement<T>: Copy,
{
    let of = |value: f64| T::of(value);
    let radius = dice.power_of_ten(-1.0, 2.0);
    let curve = |reach: f64, point: Box<dyn Fn(T) -> [T; 2] + Send + Sync>| -> Body<T> {
        let at = move |k: T| {
            let [y, dy] = point(k);
            CurvePoint { x: k, y, dx: T::one(), dy }
        };
        Box::new(Curve::new([of(-reach), of(reach)], at).with_convexity(Convexity::Convex))
    };
    match (8.0 * dice.uniform()) as usize {
        0 => Box::new(Parabola::new(of(radius), [of(-radius), of(radius)]).unwrap()),
        1 => {
            let flat = dice.power_of_ten(-1.0, 1.0);
            let angle = of(dice.within(0.5, 1.55));
            Box::new(Ellipse::new(of(radius), of(flat * radius), [-angle, angle]).unwrap())
        }
        2 => {
            let depth = dice.power_of_ten(-4.0, 0.0);
            let length = of(radius);
            Box::new(Crowning::new(of(depth), length, [-length, length]).unwrap())
        }
        3 => {
            let origin = dice.within(0.05, 0.7);
            let angles = [of(0.5 * origin), of(1.5 * origin)];
            Box::new(Involute::new(of(radius), of(origin), angles).unwrap())
        }
        // A power of |x|, whose curvature may be infinite or zero in the middle.
        4 => {
            let power = dice.within(1.2, 6.0);
            curve(
                1.0,
                Box::new(move |k: T| {
                    let rest = k.abs().powf(of(power - 1.0));
                    let slope = if k < T::zero() { -rest } else { rest };
                    [k.abs() * rest / of(power), slope]
                }),
            )
        }
        // A formula whose digits cancel.
        5 => {
            let far = of(dice.power_of_ten(0.0, 1.0));
            curve(
                1.0,
                Box::new(move |k: T| {
                    let ratio = (far + k) / far;
                    [of(0.5) * far * (ratio * ratio - T::one()) - k, ratio - T::one()]
                }),
            )
        }
        // Kinks up and steps of the curvature, at breakpoints.
        6 => {
            let (mut parts, mut slope, mut y, mut x) = (Vec::new(), of(-0.5), T::zero(), of(-1.0));
            for _ in 0..5 {
                let (from, height, start) = (x, y, slope);
                let curvature = of(dice.power_of_ten(-2.0, 0.0));
                let to = from + of(0.4);
                let at = move |k: T| {
                    let away = k - from;
                    let y = height + away * (start + of(0.5) * curvature * away);
                    CurvePoint { x: k, y, dx: T::one(), dy: start + curvature * away }
                };
                parts.push(Curve::new([from, to], at).with_convexity(Convexity::Convex));
                let end = at(to);
                let kink = if dice.uniform() < 0.5 { 0.0 } else { dice.power_of_ten(-3.0, -1.0) };
                (x, y, slope) = (to, end.y, end.dy + of(kink));
            }
            Box::new(Piecewise::with_tolerance(parts, of(1e-5)).unwrap())
        }
        // Kinks up that are not breakpoints.
        _ => {
            let (kink, place) = (of(dice.power_of_ten(-3.0, 0.0)), of(dice.within(-0.2, 0.2)));
            curve(
                1.0,
                Box::new(move |k: T| {
                    let sign = if k < place { -T::one() } else { T::one() };
                    [of(0.5) * k * k + kink * (k - place).abs(), k + kink * sign]
                }),
            )
        }
    }
}

/// Returns the number of random scenes solved; none may be refused for its declared convexity.
fn right_words<T: Real>(scenes: u64) -> usize {
    let mut solved = 0;
    for seed in 0..scenes {
        let mut dice = Dice::new(seed);
        let of = |value: f64| T::of(value);
        let upper = bulging::<T>(&mut dice);
        let lower = bulging::<T>(&mut dice);
        // Turned a little, moved far away, and turned upside down.
        let angle = of(if dice.uniform() < 0.5 { 0.0 } else { dice.within(-0.1, 0.1) });
        let away = of(if dice.uniform() < 0.5 { 0.0 } else { dice.power_of_ten(-1.0, 1.5) });
        let put = Placement::default().rotated(angle).shifted(away, of(0.1));
        let is_joined = upper.pieces() > 0 || lower.pieces() > 0;
        let (upper, lower): (Body<T>, Body<T>) = if is_joined {
            (upper, Box::new(Flat))
        } else {
            let Ok(lower) = Placed::new(lower, put.flipped()) else { continue };
            let Ok(upper) = Placed::new(upper, put) else { continue };
            (Box::new(upper), Box::new(lower))
        };
        let Ok(contact) = Contact::new(&*lower, &*upper) else { continue };
        let load = of(dice.power_of_ten(-14.0, -1.0));
        let control = match (4.0 * dice.uniform()) as usize {
            0 => Control::HalfWidth(load.sqrt()),
            1 => Control::PeakPressure(load.sqrt()),
            2 => Control::CentreOfPressure { load, at: away + of(1e-3) },
            _ => Control::Load(load),
        };
        match contact.solve(control) {
            Ok(_) => solved += 1,
            Err(error) => {
                let is_it = matches!(error, ContactError::Input(InputError::NotConvex { .. }));
                assert!(!is_it, "scene {seed}, {control:?}: {error}");
            }
        }
    }
    solved
}

#[test]
fn no_right_word_is_refused() {
    let scenes = std::env::var("SCENES").map_or(2000, |count| count.parse().unwrap());
    let solved = [right_words::<f64>(scenes), right_words::<f32>(scenes)];
    println!("{solved:?} of {scenes} solved");
    assert!(solved.iter().all(|&solved| 2 * solved > scenes as usize), "{solved:?}");
}

/// The same curves, of unknown shape, are solved.
#[test]
fn undeclared_they_are_solved() {
    let wave = Curve::new([-1.0, 1.0], |k: f64| {
        let (sin, cos) = (20.0 * k).sin_cos();
        CurvePoint { x: k, y: 0.5 * k * k - 1.5 / 400.0 * cos, dx: 1.0, dy: k + 0.075 * sin }
    });
    assert!(Contact::new(&Flat, &wave).unwrap().solve(Control::Load(0.1)).is_ok());
}
