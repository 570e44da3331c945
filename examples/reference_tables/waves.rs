//! Contact in several places: an infinite row of crests, two bumps, three bumps.

use super::case::{AT, HALF_WIDTH, LEFT, LENGTH, LOAD, MEAN, Made, PEAK, Place, RIGHT};
use super::hertz::{hertz, like_steel, steel_on_steel};
use super::precise::{PI, Precise, n, root};
use linecontact::reference::{Hertz, PolynomialMap, Quartic, Westergaard, body};
use linecontact::{Contact, Control, Curve, CurvePoint, Flat};

/// Makes the case of a row of crests. In ξ = tan(π x/λ) one crest is a single contact.
pub fn wave() -> Made {
    let (amplitude, wavelength, load) = (1e-4, 1.0, 20.0);
    let mut case = steel_on_steel(
        "wave",
        "Wavy steel surface on a steel half-plane, periodic",
        "y = A (1 - cos(2 pi x/l)), a crest at x = 0",
        &[
            ("A", amplitude, LENGTH, "amplitude, half the height"),
            ("l", wavelength, LENGTH, "wavelength"),
            ("F", load, "N/mm", "load on each wavelength"),
        ],
    );
    let modulus = like_steel();
    let kappa = PI * modulus / n(2.0);
    let [big, l] = [amplitude, wavelength].map(n);
    let complete = PI * modulus * big;
    let sine = (n(load) / complete).sqrt();
    let angle = (sine / (n(1.0) - sine * sine).sqrt()).atan();
    let a = l * angle / PI;
    // A body over ξ with the slope 4 π A/λ ξ/(1 + ξ²).
    let steep = (n(4.0) * big / l).value();
    let unrolled = Curve::new([-9.0, 9.0], move |xi: f64| CurvePoint {
        x: xi,
        y: 0.5 * std::f64::consts::PI * steep * (xi * xi).ln_1p(),
        dx: 1.0,
        dy: std::f64::consts::PI * steep * xi / (1.0 + xi * xi),
    });
    let contact = Contact::new(&Flat, &unrolled)?.contact_modulus(modulus.value());
    let [s, c] = angle.sin_cos();
    let solution = contact.solve(Control::HalfWidth((s / c).value()))?;
    let pressure = solution.pressure()?;
    let form = Westergaard::under_load(amplitude, wavelength, load, kappa.value())?;
    case.source(
        "Westergaard, J. Appl. Mech. 6, 1939, A49; Johnson, Contact Mechanics, 1985, section 13.2",
    );
    let formula = "sin^2(pi a/l) = F/(pi E* A)";
    case.closed(HALF_WIDTH, Place::Whole, a, form.limits().right, formula);
    let formula = "2 pi E* A/l cos(pi x/l) sqrt(sin^2(pi a/l) - sin^2(pi x/l))";
    for x in [0.0, 0.1, 0.2] {
        let [sin, cos] = (PI * n(x) / l).sin_cos();
        let value = n(2.0) * complete / l * cos * (sine * sine - sin * sin).sqrt();
        let at = (std::f64::consts::PI * x / wavelength).tan();
        let what = if x == 0.0 { PEAK } else { AT };
        case.closed(what, Place::At(x), value, pressure.at(at)?, formula);
    }
    let formula = "F/l, over the whole wavelength";
    case.closed(MEAN, Place::Whole, n(load) / l, form.load(kappa.value()) / wavelength, formula);
    let solved = 2.0 * kappa.value() * amplitude;
    let formula = "pi E* A: the load on a wavelength from which on the contact is complete";
    case.closed(("complete_load", "N/mm"), Place::Whole, complete, solved, formula);
    Ok(case)
}

pub fn two_contacts() -> Made {
    let (depth, radius, load) = (1e-3, 1.0, 200.0);
    let mut case = steel_on_steel(
        "two_contacts",
        "Two bumps with a hollow between them on a steel half-plane",
        "y = D ((x/r)^2 - 1)^2",
        &[
            ("D", depth, LENGTH, "depth of the hollow"),
            ("r", radius, LENGTH, "distance of a bump from x = 0"),
            ("F", load, "N/mm", "load on both"),
        ],
    );
    let modulus = like_steel();
    let kappa = (PI * modulus / n(2.0)).value();
    let form = Quartic::under_load(depth, radius, load, kappa)?;
    let shape = body(&form, -3.0, 3.0)?;
    let contact = Contact::new(&Flat, &shape)?.contact_modulus(modulus.value());
    let solution = contact.solve(Control::Load(load))?;
    let on = solution.intervals()[1];
    let [deep, r] = [depth, radius].map(n);
    let merger = PI * modulus * deep;
    let share = (n(load) / merger).sqrt();
    let [inner, outer] = [r * (n(1.0) - share).sqrt(), r * (n(1.0) + share).sqrt()];
    let at = |x: Precise| {
        let product = (x * x - inner * inner) * (outer * outer - x * x);
        n(2.0) * modulus * deep / (r * r * r * r) * x * product.sqrt()
    };
    case.source("polynomial map of Hertz's contact: Geronimo and Van Assche, Trans. Amer. Math. Soc. 308, 1988, 559");
    let formula = "of the right contact: r sqrt(1 - s), s = sqrt(F/(pi E* D)); the left one is its mirror image";
    case.closed(LEFT, Place::Whole, inner, on.left, formula);
    case.closed(RIGHT, Place::Whole, outer, on.right, "of the right contact: r sqrt(1 + s)");
    let pressure = solution.pressure()?;
    for x in [0.7, 1.0, 1.2] {
        let formula = "2 E* D/r^4 |x| sqrt((x^2-i^2)(o^2-x^2)), i and o the limits";
        case.closed(AT, Place::At(x), at(n(x)), pressure.at(x)?, formula);
    }
    // The largest x² (x² - i²)(o² - x²): a quadratic equation for x².
    let (sum, product) = (inner * inner + outer * outer, inner * inner * outer * outer);
    let square = (sum + (sum * sum - n(3.0) * product).sqrt()) / n(3.0);
    let peak = solution.peak()?;
    let formula = "largest of that, at x^2 = (s + sqrt(s^2 - 3 q))/3, s = i^2 + o^2, q = i^2 o^2";
    case.closed(PEAK, Place::Whole, at(square.sqrt()), peak.pressure, formula);
    case.closed(("peak_x", LENGTH), Place::Whole, square.sqrt(), peak.x.abs(), "on either side")
        .flat();
    let formula = "pi E* D: the load at which the two become one";
    let solved = Quartic::under_load(depth, radius, load, kappa)?.merger(kappa);
    case.closed(("merging_load", "N/mm"), Place::Whole, merger, solved, formula);
    Ok(case)
}

pub fn three_contacts() -> Made {
    let (relative, amplitude, span, load) = (50.0, 1.0, 3.0, 500.0);
    let mut case = steel_on_steel(
        "three_contacts",
        "Three bumps on a steel half-plane",
        "y = v^2/(6 R), v = s (4 (x/r)^3 - 3 x/r)",
        &[
            ("R", relative, LENGTH, "radius"),
            ("s", amplitude, LENGTH, "amplitude of v"),
            ("r", span, LENGTH, "half-width of the span on which v swings between -s and s"),
            ("F", load, "N/mm", "load on all three"),
        ],
    );
    let modulus = like_steel();
    let kappa = (PI * modulus / n(2.0)).value();
    let form = PolynomialMap::new(Hertz::under_load(relative, load, kappa)?, 3, amplitude, span)?;
    let shape = body(&form, -4.0, 4.0)?;
    let contact = Contact::new(&Flat, &shape)?.contact_modulus(modulus.value());
    let solution = contact.solve(Control::Load(load))?;
    let contacts = solution.contacts()?;
    let [one, peak] = hertz(load, n(relative), modulus);
    let (s, r) = (n(amplitude), n(span));
    let v = |x: Precise| s * (n(4.0) * x * x * x / (r * r * r) - n(3.0) * x / r);
    let rise = |x: Precise| s * (n(12.0) * x * x / (r * r * r) - n(3.0) / r);
    let at = |x: Precise| {
        let share = v(x) / one;
        let slope = rise(x);
        let size = if slope.value() < 0.0 { -slope } else { slope };
        size * peak * (n(1.0) - share * share).sqrt() / n(3.0)
    };
    case.source("polynomial map of Hertz's contact: Geronimo and Van Assche, Trans. Amer. Math. Soc. 308, 1988, 559");
    let middle = root(n(0.55), |x| v(x) + one);
    let formula = "of the middle contact: root of v(x) = -h next to 0, h = sqrt(4 F R/(pi E*))";
    case.closed(HALF_WIDTH, Place::Whole, middle, solution.intervals()[1].right, formula);
    let right = solution.intervals()[2];
    let formula = "of the right contact: root of v(x) = -h";
    case.closed(LEFT, Place::Whole, root(n(2.3), |x| v(x) + one), right.left, formula);
    let formula = "of the right contact: root of v(x) = h";
    case.closed(RIGHT, Place::Whole, root(n(2.8), |x| v(x) - one), right.right, formula);
    case.closed(LOAD, Place::Whole, n(load) / n(3.0), contacts[2].load, "F/3 on each");
    let pressure = solution.pressure()?;
    for x in [0.0, 0.3, 2.5, 2.7] {
        let formula = "|v'(x)|/3 2 F/(pi h) sqrt(1 - (v/h)^2)";
        case.closed(AT, Place::At(x), at(n(x)), pressure.at(x)?, formula);
    }
    Ok(case)
}
