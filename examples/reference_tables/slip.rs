//! Hertz's contact with a tangential force.

use super::case::{Case, Given, HALF_WIDTH, LENGTH, Made, PEAK, Place, STICK, TRACTION};
use super::hertz::{hertz, like_steel, steel_on_steel};
use super::precise::n;
use linecontact::profile::Parabola;
use linecontact::{Contact, Control, Flat, PartialSlip, Shear};
use std::error::Error;

const RADIUS: f64 = 10.0;
const PRESSED: f64 = 500.0;
const FRICTION: f64 = 0.3;
const FORCE: f64 = 75.0;

const SLIPPING: [Given; 4] = [
    ("R", RADIUS, LENGTH, "radius"),
    ("F", PRESSED, "N/mm", "load, first"),
    ("mu", FRICTION, "1", "coefficient of friction"),
    (
        "Q",
        FORCE,
        "N/mm",
        "tangential force, second; on the lower body in the direction of positive x",
    ),
];

/// Adds Hertz's contact with a tangential force, and perhaps a tension in the lower body.
fn slipping(case: &mut Case, tension: f64, places: [f64; 3]) -> Result<(), Box<dyn Error>> {
    let modulus = like_steel();
    let roller = Parabola::new(RADIUS, [-2.0, 2.0])?;
    let contact = Contact::new(&Flat, &roller)?.contact_modulus(modulus.value());
    let shear = Shear { friction: FRICTION, force: FORCE, tension };
    let slip: PartialSlip<f64> = contact.partial_slip(Control::Load(PRESSED), shear)?;
    let [a, peak] = hertz(PRESSED, n(RADIUS), modulus);
    let mu = n(FRICTION);
    let c = a * (n(1.0) - n(FORCE) / (mu * n(PRESSED))).sqrt();
    let shift = n(tension) * a / (n(4.0) * mu * peak);
    let zone = slip.stick_zones()[0];
    case.source("Hertz 1882; Johnson, Contact Mechanics, 1985, Eqs. 4.43 to 4.45");
    case.closed(HALF_WIDTH, Place::Whole, a, slip.normal().a(), "a = sqrt(4 F R/(pi E*))");
    let solved = slip.normal().peak()?.pressure;
    case.closed(PEAK, Place::At(0.0), peak, solved, "p0 = 2 F/(pi a)");
    case.source("Cattaneo 1938; Mindlin 1949; Johnson 1985, section 7.2");
    let solved = zone.half_width();
    case.closed(STICK, Place::Whole, c, solved, "c = a sqrt(1 - Q/(mu F))");
    if tension != 0.0 {
        case.source("Nowell and Hills 1987");
        let formula = "sigma a/(4 mu p0), the centre of the stick zone";
        case.closed(("stick_centre", LENGTH), Place::Whole, shift, zone.centre(), formula);
    }
    let traction = slip.traction()?;
    for x in places {
        let [all, part] = [n(x) / a, (n(x) - shift) / c];
        let mut value = (n(1.0) - all * all).sqrt();
        if part.value().abs() < 1.0 {
            value = value - c / a * (n(1.0) - part * part).sqrt();
        }
        let formula = if tension == 0.0 {
            "mu p0 (sqrt(1-(x/a)^2) - c/a sqrt(1-(x/c)^2)), the second where |x| < c"
        } else {
            "mu p0 (sqrt(1-(x/a)^2) - c/a sqrt(1-((x-e)/c)^2)), the second where |x-e| < c, e the \
             centre of the stick zone"
        };
        case.closed(TRACTION, Place::At(x), mu * peak * value, traction.at(x)?, formula);
    }
    if tension == 0.0 {
        let value = mu * peak * (n(FORCE) / (mu * n(PRESSED))).sqrt();
        let formula = "largest, at x = c: mu p0 sqrt(Q/(mu F))";
        let solved = traction.at(zone.right)?;
        case.closed(("peak_traction", "MPa"), Place::Whole, value, solved, formula);
    }
    Ok(())
}

pub fn partial_slip() -> Made {
    let mut case = steel_on_steel(
        "partial_slip",
        "Steel cylinder on a steel half-plane, then a tangential force",
        "parabola y = x^2/(2 R)",
        &SLIPPING,
    );
    slipping(&mut case, 0.0, [0.0, 0.1, 0.2])?;
    Ok(case)
}

pub fn bulk_tension() -> Made {
    let tension = ("sigma", 50.0, "MPa", "tension of the lower body along x, with the force");
    let mut case = steel_on_steel(
        "bulk_tension",
        "Steel cylinder on a stretched steel half-plane, with a tangential force",
        "parabola y = x^2/(2 R)",
        &[&SLIPPING[..], &[tension]].concat(),
    );
    slipping(&mut case, tension.1, [-0.1, 0.0, 0.2])?;
    Ok(case)
}
