//! Invalid parameters of closed forms, and invalid places.

use super::*;
use linecontact::reference::{
    Biquadratic, ClosedForm, Cosine, Ellipse, Exponential, FlatPunch, Hertz, Hyperbola, Jkr,
    PinInHole, PowerLaw, ReferenceError, RoundedPunch, UnequalRadii, Wedge, Westergaard,
    body as body_of,
};
use linecontact::{Material, PlaneState};

type Form = Box<dyn ClosedForm<f64>>;
type Made = Result<Form, ReferenceError<f64>>;

fn boxed<F: ClosedForm<f64> + 'static>(form: Result<F, ReferenceError<f64>>) -> Made {
    form.map(|form| Box::new(form) as Form)
}

/// Constructors, each from a row of four numbers; some take fewer.
const CONSTRUCTORS: [(&str, usize, fn([f64; 4]) -> Made); 22] = [
    ("Hertz", 2, |[a, b, ..]| boxed(Hertz::new(a, b))),
    ("Hertz under load", 3, |[a, b, c, _]| boxed(Hertz::under_load(a, b, c))),
    ("wedge", 2, |[a, b, ..]| boxed(Wedge::new(a, b))),
    ("wedge, unequal", 3, |[a, b, c, _]| boxed(Wedge::unequal(a, b, c))),
    ("wedge under load", 4, |[a, b, c, d]| boxed(Wedge::under_load(a, b, c, d))),
    ("power", 3, |[a, b, c, _]| boxed(PowerLaw::new(a, b, c))),
    ("power under load", 4, |[a, b, c, d]| boxed(PowerLaw::under_load(a, b, c, d))),
    ("biquadratic", 3, |[a, b, c, _]| boxed(Biquadratic::new(a, b, c))),
    ("biquadratic under load", 4, |[a, b, c, d]| boxed(Biquadratic::under_load(a, b, c, d))),
    ("radii", 3, |[a, b, c, _]| boxed(UnequalRadii::new(a, b, c))),
    ("radii under load", 4, |[a, b, c, d]| boxed(UnequalRadii::under_load(a, b, c, d))),
    ("rounded punch", 3, |[a, b, c, _]| boxed(RoundedPunch::new(a, b, c))),
    ("rounded punch under load", 4, |[a, b, c, d]| boxed(RoundedPunch::under_load(a, b, c, d))),
    ("flat punch", 4, |[a, b, c, d]| boxed(FlatPunch::under_load(a, b, c, d))),
    ("ellipse", 3, |[a, b, c, _]| boxed(Ellipse::new(a, b, c))),
    ("circle", 2, |[a, b, ..]| boxed(Ellipse::circle(a, b))),
    ("hyperbola", 3, |[a, b, c, _]| boxed(Hyperbola::new(a, b, c))),
    ("exponential", 3, |[a, b, c, _]| boxed(Exponential::new(a, b, c))),
    ("cosine", 3, |[a, b, c, _]| boxed(Cosine::new(a, b, c))),
    ("JKR", 3, |[a, b, c, _]| boxed(Jkr::new(a, b, c))),
    ("JKR under load", 4, |[a, b, c, d]| boxed(Jkr::under_load(a, b, c, d))),
    ("JKR of no work", 2, |[a, b, ..]| boxed(Jkr::new(a, 0.0, b))),
];

/// Extreme values for every parameter: NaN, infinities, zeros, negative, tiny and huge numbers.
const EXTREMES: [f64; 12] =
    [NAN, INF, -INF, 0.0, -0.0, -1.0, TINY, -TINY, f64::MIN_POSITIVE, 1e-200, 1e200, f64::MAX];

#[test]
fn parameters_and_places() {
    let mut wrong = Vec::new();
    for (name, count, make) in CONSTRUCTORS {
        for good in [[0.4, 0.8, 1.2, 0.7], [1.3, 0.6, 0.5, 1.1], [0.5, 2.6, 0.6, 0.9]] {
            for i in 0..count {
                for value in EXTREMES {
                    let mut numbers = good;
                    numbers[i] = value;
                    let asked = || {
                        let made = make(numbers);
                        if let Ok(form) = &made {
                            everywhere(&**form);
                        }
                        made.map(|_| ())
                    };
                    let row = format!("{name}{:?}", &numbers[..count]);
                    match catch_unwind(asked) {
                        Err(_) => wrong.push(format!("{row}: panics")),
                        Ok(Ok(())) if !value.is_finite() => wrong.push(format!("{row}: accepted")),
                        Ok(Err(ReferenceError::Parameter { must: "", .. })) => {
                            wrong.push(format!("{row}: says nothing"));
                        }
                        Ok(_) => {}
                    }
                }
            }
        }
    }
    for value in EXTREMES {
        for numbers in [[value, 1.0, 0.3], [0.1, value, 0.3], [0.1, 1.0, value]] {
            let made = Westergaard::new(numbers[0], numbers[1], numbers[2]);
            let under = Westergaard::under_load(numbers[0], numbers[1], numbers[2], 1.0);
            if !value.is_finite() && (made.is_ok() || under.is_ok()) {
                wrong.push(format!("Westergaard{numbers:?}: accepted"));
            }
            for form in [made, under].into_iter().flatten() {
                let _ = (
                    form.limits(),
                    form.load(1.0),
                    form.pressure(NAN, 1.0),
                    form.pressure(INF, 1.0),
                );
            }
            let steel = Material::elastic(1.0, 0.3);
            let [radius, clearance, load] = numbers;
            let state = PlaneState::Strain;
            let made = PinInHole::under_load(radius, clearance, load, [steel, steel], state);
            if !value.is_finite() && made.is_ok() {
                wrong.push(format!("PinInHole{numbers:?}: accepted"));
            }
            if let Ok(form) = made {
                let angle = form.half_angle();
                for theta in [0.0, angle, -angle, NAN, INF] {
                    let _ = form.pressure(theta);
                }
                assert!(angle > 0.0 && angle < std::f64::consts::PI, "{numbers:?}");
            }
        }
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

/// Evaluates all functions of a form at every place; NaN may give NaN or zero.
fn everywhere(form: &dyn ClosedForm<f64>) {
    let Interval { left, right } = form.limits();
    for x in
        EXTREMES.into_iter().chain([left, right, left.next_up(), right.next_down(), 2.0 * right])
    {
        let _ = (form.pressure(x, 1.0), form.height(x), form.slope(x), form.slope_left(x));
    }
    for kappa in EXTREMES {
        let _ = (form.load(kappa), form.pressure(0.5 * right, kappa));
    }
    let _ = (form.breakpoints(), form.edges());
}

#[test]
fn ranges_of_bodies() {
    let mut table = Table::new("reference::body");
    let form = Hertz::new(1.0, 0.3).unwrap();
    for (from, to) in [(NAN, 1.0), (-1.0, NAN), (-INF, 1.0), (-1.0, INF), (1.0, -1.0), (0.2, 0.2)] {
        table.row(
            &format!("{from} to {to}"),
            0,
            || Ok(body_of(&form, from, to).map(|_| ())?),
            |wrong| {
                matches!(wrong, Wrong::Breakpoint(PiecewiseError::InPiece {
                    piece: 1, source: ProfileError::Domain { from: f, to: t },
                }) if same(*f, from) && same(*t, to))
            },
        );
    }
    table.finish();
}

/// The error names the load or the modulus, not the half-width that would follow from it.
#[test]
fn a_load_and_a_modulus_that_are_none_are_named() {
    for (name, count, make) in CONSTRUCTORS.into_iter().filter(|row| row.0.ends_with("under load"))
    {
        let named = |place: usize, value: f64| {
            let mut numbers = [0.5, 2.6, 0.6, 0.9];
            numbers[place] = value;
            let error = make(numbers).err().unwrap_or_else(|| panic!("{name}: {numbers:?}"));
            let ReferenceError::Parameter { name, .. } = error else { panic!("{name}: {error}") };
            name
        };
        for value in [NAN, INF, -INF] {
            assert_eq!(named(count - 2, value), "the load", "{name}: {value}");
        }
        for value in [NAN, INF, 0.0, -1.0] {
            assert_eq!(named(count - 1, value), "κ", "{name}: {value}");
        }
        // Each parameter has a name of its own.
        let mut names: Vec<_> = (0..count).map(|place| named(place, INF)).collect();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), count, "{name}: {names:?}");
    }
}
