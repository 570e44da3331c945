//! Rigid punches and wedges on steel, and a punch of steel with rounded edges.

use super::case::{
    AT, Case, FORCE, Given, HALF_WIDTH, LEFT, LENGTH, MEAN, Made, PEAK, PRESSURE, Place, RIGHT,
    STICK, STIFFNESS, STRENGTH, TRACTION,
};
use super::hertz::{STEEL, compliance, like_steel, material, steel_on_steel};
use super::precise::{PI, Precise, greatest, n, root};
use linecontact::profile::rounded_punch;
use linecontact::reference::{FlatPunch, PowerLaw, Wedge, body};
use linecontact::{
    Contact, Control, Edge, Flat, Material, PlaneState, Reference, References, Shear,
};
use std::error::Error;

/// Returns E* of steel under a rigid body.
fn under_rigid() -> Precise {
    n(1.0) / compliance(STEEL)
}

/// Makes a case of a rigid body on steel.
fn rigid_on_steel(
    name: &'static str,
    title: &'static str,
    upper: &'static str,
    parameters: &[Given],
) -> Case {
    let mut all = vec![
        ("E1", STEEL[0], PRESSURE, "Young's modulus, lower body; the upper one is rigid"),
        ("nu1", STEEL[1], "1", "Poisson's ratio, lower body"),
    ];
    all.extend(parameters);
    Case::new(name, title, ["half-plane, y = 0", upper], &all)
}

pub fn wedge() -> Made {
    let (slope, load) = (0.02, 500.0);
    let mut case = rigid_on_steel(
        "wedge",
        "Rigid blunt wedge on a steel half-plane",
        "y = m |x|",
        &[("m", slope, "1", "slope"), ("F", load, FORCE, "load")],
    );
    let modulus = under_rigid();
    let form = Wedge::new(slope, 1.0)?;
    let shape = body(&form, -1.0, 1.0)?;
    let contact = Contact::new(&Flat, &shape)?.contact_modulus(modulus.value());
    let solution = contact.solve(Control::Load(load))?;
    let pressure = solution.pressure()?;
    let a = n(load) / (n(slope) * modulus);
    let mean = n(slope) * modulus / n(2.0);
    case.source("Johnson, Contact Mechanics, 1985, section 5.2");
    case.closed(HALF_WIDTH, Place::Whole, a, solution.a(), "a = F/(m E*)");
    case.closed(MEAN, Place::Whole, mean, solution.mean_pressure(), "m E*/2");
    for x in [0.01, 0.05, 0.1] {
        let value = n(slope) * modulus / PI * (a / n(x)).acosh();
        case.closed(AT, Place::At(x), value, pressure.at(x)?, "m E*/pi arcosh(a/|x|)");
    }
    case.source("limit of Johnson 1985, Eqs. 2.23, with that pressure");
    let shear = solution.subsurface()?.max_shear()?.value;
    let value = n(slope) * modulus / PI;
    let formula = "m E*/pi, just below the tip, where the pressure is infinite";
    case.closed(("max_shear", PRESSURE), Place::Whole, value, shear, formula).within(1e-10);
    Ok(case)
}

/// Returns `ln(sin((θ + φ)/2)/|sin((θ - φ)/2)|)` of two angles.
fn logarithm(one: Precise, other: Precise) -> Precise {
    let sine = |angle: Precise| (angle / n(2.0)).sin_cos()[0];
    let ratio = sine(one + other) / sine(one - other);
    (ratio * ratio).ln() / n(2.0)
}

pub fn unequal_wedge() -> Made {
    let (slopes, load) = ([0.01, 0.03], 500.0);
    let mut case = rigid_on_steel(
        "unequal_wedge",
        "Rigid wedge with unlike flanks on a steel half-plane",
        "y = -m1 x for x < 0, m2 x for x > 0",
        &[
            ("m1", slopes[0], "1", "slope on the left"),
            ("m2", slopes[1], "1", "slope on the right"),
            ("F", load, FORCE, "load"),
        ],
    );
    let modulus = under_rigid();
    let form = Wedge::unequal(slopes[0], slopes[1], 1.0)?;
    let shape = body(&form, -1.0, 1.0)?;
    let contact = Contact::new(&Flat, &shape)?.contact_modulus(modulus.value());
    let solution = contact.solve(Control::Load(load))?;
    let pressure = solution.pressure()?;
    let both = n(slopes[0]) + n(slopes[1]);
    let tip = PI * n(slopes[0]) / both;
    let [sin, cos] = tip.sin_cos();
    let l = n(2.0) * n(load) / (modulus * both * sin);
    case.source(
        "Johnson, Contact Mechanics, 1985, section 5.2, with the two conditions at the edges",
    );
    let formula = "-L (1 + cos phi), phi = pi m1/(m1+m2), L = 2 F/(E* (m1+m2) sin phi)";
    case.closed(LEFT, Place::Whole, -(l * (n(1.0) + cos)), -solution.b(), formula);
    case.closed(RIGHT, Place::Whole, l * (n(1.0) - cos), solution.a(), "L (1 - cos phi)");
    for x in [-0.1, 0.02] {
        let angle = (n(x) / l + cos).acos();
        let value = modulus * both / (n(2.0) * PI) * logarithm(angle, tip);
        let formula =
            "E* (m1+m2)/(2 pi) ln(sin((t+phi)/2)/|sin((t-phi)/2)|), x = L (cos t - cos phi)";
        case.closed(AT, Place::At(x), value, pressure.at(x)?, formula);
    }
    let centre = -(l * cos / n(2.0));
    case.closed(
        ("centre_of_pressure", LENGTH),
        Place::Whole,
        centre,
        solution.centre_of_pressure()?,
        "-L cos(phi)/2",
    )
    .within(1e-11); // the solver's moment, across a kink
    Ok(case)
}

pub fn quartic_punch() -> Made {
    let (coefficient, load) = (1e-3, 1000.0);
    let mut case = rigid_on_steel(
        "quartic_punch",
        "Rigid punch of fourth degree on a steel half-plane",
        "y = A x^4",
        &[("A", coefficient, "1/mm^3", "coefficient"), ("F", load, FORCE, "load")],
    );
    let modulus = under_rigid();
    let form = PowerLaw::new(coefficient, 4.0, 1.0)?;
    let shape = body(&form, -4.0, 4.0)?;
    let contact = Contact::new(&Flat, &shape)?.contact_modulus(modulus.value());
    let solution = contact.solve(Control::Load(load))?;
    let pressure = solution.pressure()?;
    let scale = modulus * n(coefficient);
    let a = (n(4.0) * n(load) / (n(3.0) * PI * scale)).sqrt().sqrt();
    let at = |x: Precise| scale * (a * a - x * x).sqrt() * (a * a + n(2.0) * x * x);
    case.source("Steuermann 1939; Johnson, Contact Mechanics, 1985, section 5.3");
    case.closed(HALF_WIDTH, Place::Whole, a, solution.a(), "a = (4 F/(3 pi E* A))^(1/4)");
    for x in [0.0, 0.5, 1.0] {
        let formula = "E* A sqrt(a^2-x^2) (a^2 + 2 x^2)";
        case.closed(AT, Place::At(x), at(n(x)), pressure.at(x)?, formula);
    }
    let peak = solution.peak()?;
    let place = a / n(2.0).sqrt();
    case.closed(PEAK, Place::Whole, at(place), peak.pressure, "sqrt(2) E* A a^3, at both places");
    case.closed(("peak_x", LENGTH), Place::Whole, place, peak.x.abs(), "a/sqrt(2), on either side")
        .flat();
    Ok(case)
}

pub fn flat_punch() -> Made {
    let (half, load, depth) = (5.0, 10e3, 50.0);
    let mut case = rigid_on_steel(
        "flat_punch",
        "Rigid flat punch with sharp corners on a steel half-plane",
        "y = 0 for |x| < H",
        &[
            ("H", half, LENGTH, "half-width of the punch"),
            ("F", load, FORCE, "load"),
            ("d", depth, LENGTH, "depth of the reference point, below x = 0"),
        ],
    );
    let form = FlatPunch::under_load(half, 0.0, load, 1.0)?;
    let shape = body(&form, -half, half)?;
    let contact = Contact::new(&Flat, &shape)?
        .edges(Edge::Fixed(-half), Edge::Fixed(half))
        .materials(material(STEEL), Material::Rigid, PlaneState::Strain);
    let solution = contact.solve(Control::Load(load))?;
    let pressure = solution.pressure()?;
    case.source("Johnson, Contact Mechanics, 1985, section 2.8");
    for x in [0.0, 2.5, 4.9] {
        let value = n(load) / (PI * (n(half) * n(half) - n(x) * n(x)).sqrt());
        case.closed(AT, Place::At(x), value, pressure.at(x)?, "F/(pi sqrt(H^2-x^2))");
    }
    let formula = "K = F/(pi H): next to the edge the pressure is K/sqrt(1 - (x/H)^2)";
    let strength = n(load) / (PI * n(half));
    case.closed(STRENGTH[1], Place::Whole, strength, solution.edge_singularities().right, formula);
    let t = n(depth) / n(half);
    let far = (n(1.0) + t * t).sqrt();
    let rate = compliance(STEEL) / PI * (n(2.0) * t.asinh() - t / far / (n(1.0) - n(STEEL[1])));
    let to = References { x: 0.0, lower: Reference::Depth(depth), upper: Reference::Depth(depth) };
    case.source("integral of the strains of Johnson 1985, Eqs. 2.23, with that pressure");
    case.closed(
        ("approach", LENGTH),
        Place::Whole,
        rate * n(load),
        solution.approach(&to)?.bodies,
        "(1-nu^2) F/(pi E) (2 asinh(d/H) - d/((1-nu) sqrt(H^2+d^2)))",
    );
    let formula = "F/approach, whatever the load";
    case.closed(STIFFNESS, Place::Whole, n(1.0) / rate, solution.stiffness(&to)?, formula);
    Ok(case)
}

/// Adds a flat punch held at a slope, in contact at both edges or at one.
fn tilted(case: &mut Case, half: f64, slope: f64, load: f64) -> Result<(), Box<dyn Error>> {
    let modulus = under_rigid();
    let kappa = PI * modulus / n(2.0);
    let on_both = load > kappa.value() * slope * half;
    let form = FlatPunch::under_load(half, slope, load, kappa.value())?;
    let shape = body(&form, -half, half)?;
    let right = if on_both { Edge::Fixed(half) } else { Edge::Free };
    let contact = Contact::new(&Flat, &shape)?
        .edges(Edge::Fixed(-half), right)
        .contact_modulus(modulus.value());
    let solution = contact.solve(Control::Load(load))?;
    let pressure = solution.pressure()?;
    let [h, m, f] = [half, slope, load].map(n);
    let steep = kappa * m;
    case.source("Johnson, Contact Mechanics, 1985, section 2.8");
    if on_both {
        for x in [-2.5, 0.0, 2.5] {
            let value = (f - steep * n(x)) / (PI * (h * h - n(x) * n(x)).sqrt());
            let formula = "(F - pi E* m x/2)/(pi sqrt(H^2-x^2))";
            case.closed(AT, Place::At(x), value, pressure.at(x)?, formula);
        }
        let strengths = [f / (PI * h) + steep / PI, f / (PI * h) - steep / PI];
        let formulas = [
            "F/(pi H) + E* m/2: next to the edge the pressure is that over sqrt(1 - (x/H)^2)",
            "F/(pi H) - E* m/2",
        ];
        for (i, solved) in solution.edge_singularities().into_iter().enumerate() {
            case.closed(STRENGTH[i], Place::Whole, strengths[i], solved, formulas[i]);
        }
        let moment = -(steep * h * h / n(2.0));
        let formula = "integral of p x dx: -pi E* m H^2/4";
        case.closed(("moment", "N"), Place::Whole, moment, solution.moment()?, formula);
    } else {
        let l = f / steep;
        let right = n(2.0) * l - h;
        let formula = "a = 2 L - H, L = 2 F/(pi E* m); the left limit is -H";
        case.closed(RIGHT, Place::Whole, right, solution.a(), formula);
        for x in [-4.0, -1.0] {
            let value = steep / PI * ((right - n(x)) / (n(x) + h)).sqrt();
            let formula = "E* m/2 sqrt((a-x)/(x+H))";
            case.closed(AT, Place::At(x), value, pressure.at(x)?, formula);
        }
        let solved = solution.centre_of_pressure()?;
        let formula = "(a-H)/2 - (a+H)/4";
        let centre = (right - h) / n(2.0) - (right + h) / n(4.0);
        case.closed(("centre_of_pressure", LENGTH), Place::Whole, centre, solved, formula);
    }
    Ok(())
}

pub fn tilted_punch() -> Made {
    held_at_a_tilt("tilted_punch", "Rigid flat punch held at a tilt, on both corners", 0.002)
}

pub fn lifted_punch() -> Made {
    held_at_a_tilt("lifted_punch", "Rigid flat punch held at a larger tilt, on one corner", 0.01)
}

fn held_at_a_tilt(name: &'static str, title: &'static str, slope: f64) -> Made {
    let (half, load) = (5.0, 10e3);
    let mut case = rigid_on_steel(
        name,
        title,
        "y = m x for |x| < H",
        &[
            ("H", half, LENGTH, "half-width of the punch"),
            ("m", slope, "1", "slope, held"),
            ("F", load, FORCE, "load"),
        ],
    );
    tilted(&mut case, half, slope, load)?;
    Ok(case)
}

pub fn rounded_flat_punch() -> Made {
    let (flat, radius, load, friction, force) = (2.0, 100.0, 2000.0, 0.3, 300.0);
    let mut case = steel_on_steel(
        "rounded_punch",
        "Flat steel punch with rounded edges on a steel half-plane, then a tangential force",
        "y = 0 for |x| < d, (|x|-d)^2/(2 R) beyond",
        &[
            ("d", flat, LENGTH, "half-width of the flat part"),
            ("R", radius, LENGTH, "radius of the edges"),
            ("F", load, "N/mm", "load, first"),
            ("mu", friction, "1", "coefficient of friction"),
            ("Q", force, "N/mm", "tangential force, second"),
        ],
    );
    let modulus = like_steel();
    let shape = rounded_punch(flat, radius, 8.0)?;
    let contact = Contact::new(&Flat, &shape)?.contact_modulus(modulus.value());
    let [d, r] = [flat, radius].map(n);
    // Angle φ of the end of the flat, d = L cos φ, under a load.
    let angle = |load: Precise| {
        root(n(0.8), |phi| {
            let [sin, cos] = phi.sin_cos();
            let l = d / cos;
            modulus * l * l / (n(2.0) * r) * (phi - sin * cos) - load
        })
    };
    let pressure = |phi: Precise, x: Precise| {
        let l = d / phi.sin_cos()[1];
        let theta = (x / l).acos();
        let [right, left] = [logarithm(theta, phi), logarithm(theta, PI - phi)];
        let bends = (x - d) * right - (x + d) * left + n(2.0) * phi * (l * l - x * x).sqrt();
        modulus / (n(2.0) * PI * r) * bends
    };
    let shear = Shear { friction, force, tension: 0.0 };
    let slip = contact.partial_slip(Control::Load(load), shear)?;
    let (solution, found) = (slip.normal(), slip.normal().pressure()?);
    let [all, stuck] = [angle(n(load)), angle(n(load) - n(force) / n(friction))];
    case.source(
        "Shtaerman 1949; Ciavarella, Hills and Monno, Proc. Instn Mech. Engrs C 212, 1998, 319",
    );
    let width = |phi: Precise| d / phi.sin_cos()[1];
    let formula = "a = d/cos(phi), phi the root of F = E* a^2/(2 R) (phi - sin(phi) cos(phi))";
    case.closed(HALF_WIDTH, Place::Whole, width(all), solution.a(), formula);
    let formula = "E*/(2 pi R) ((x-d) G(t,phi) - (x+d) G(t,pi-phi) + 2 phi sqrt(a^2-x^2)), x = a cos t, \
                   G(t,s) = ln(sin((t+s)/2)/|sin((t-s)/2)|)";
    for x in [0.0, 1.5, 2.5] {
        case.closed(AT, Place::At(x), pressure(all, n(x)), found.at(x)?, formula);
    }
    let [place, value] = greatest(n(2.3), |x| pressure(all, x));
    let peak = solution.peak()?;
    case.closed(
        PEAK,
        Place::Whole,
        value,
        peak.pressure,
        "largest of that, at peak_x on either side",
    );
    case.closed(("peak_x", LENGTH), Place::Whole, place, peak.x.abs(), "zero of its derivative")
        .flat();
    case.source("Ciavarella, Hills and Monno 1998; Ciavarella 1998; Jaeger 1998");
    let formula = "that of the contact under F - Q/mu";
    let zone = slip.stick_zones()[0].right;
    case.closed(STICK, Place::Whole, width(stuck), zone, formula);
    let traction = slip.traction()?;
    for x in [0.0, 1.5, 2.4] {
        let less = if n(x).value() < width(stuck).value() { pressure(stuck, n(x)) } else { n(0.0) };
        let value = n(friction) * (pressure(all, n(x)) - less);
        let formula = "mu (p(x; F) - p(x; F - Q/mu)), the second where it sticks";
        case.closed(TRACTION, Place::At(x), value, traction.at(x)?, formula);
    }
    Ok(case)
}
