//! Cylinders: Hertz's contact, and the contact of exact circles.

use super::case::{
    AT, Case, FORCE, Given, HALF_WIDTH, LENGTH, MEAN, MODULUS, Made, PEAK, PRESSURE, Place,
    STIFFNESS,
};
use super::precise::{PI, Precise, greatest, n, root};
use linecontact::profile::{Ellipse, Parabola};
use linecontact::{Contact, Control, Flat, Material, PlaneState, Reference, References, Solution};
use std::error::Error;

/// E in MPa, and ν.
pub const STEEL: [f64; 2] = [210e3, 0.3];
const ALUMINIUM: [f64; 2] = [70e3, 0.33];

pub fn material([modulus, ratio]: [f64; 2]) -> Material<f64> {
    Material::elastic(modulus, ratio)
}

/// Returns (1 - ν²)/E.
pub fn compliance([modulus, ratio]: [f64; 2]) -> Precise {
    (n(1.0) - n(ratio) * n(ratio)) / n(modulus)
}

/// Returns E* of steel on steel.
pub fn like_steel() -> Precise {
    n(1.0) / (n(2.0) * compliance(STEEL))
}

/// Returns a and p₀ of Hertz for the relative radius R.
pub fn hertz(load: f64, radius: Precise, modulus: Precise) -> [Precise; 2] {
    let half_width = (n(4.0) * n(load) * radius / (PI * modulus)).sqrt();
    [half_width, n(2.0) * n(load) / (PI * half_width)]
}

/// Returns σ_x, σ_y and τ_xy of Hertz (Johnson, Eqs. 4.49).
fn hertz_stress(a: Precise, peak: Precise, x: f64, depth: f64) -> [Precise; 3] {
    let (x, y) = (n(x), n(depth));
    let sum = a * a - x * x + y * y;
    let m = (((sum * sum + n(4.0) * x * x * y * y).sqrt() + sum) / n(2.0)).sqrt();
    let along = x * y / m;
    let both = m * m + along * along;
    let share = (y * y + along * along) / both;
    let scale = -(peak / a);
    [
        scale * (m * (n(1.0) + share) - n(2.0) * y),
        scale * m * (n(1.0) - share),
        scale * along * (m * m - y * y) / both,
    ]
}

/// Returns the approach of the centre of a disc under Hertz's pressure, and its rate (Johnson,
/// section 5.6).
fn disc(of: [f64; 2], load: f64, radius: f64, a: Precise) -> [Precise; 2] {
    let log = n(2.0) * (n(4.0) * n(radius) / a).ln();
    let share = compliance(of) / PI;
    [share * n(load) * (log - n(1.0)), share * (log - n(2.0))]
}

pub fn hertz_cylinder() -> Made {
    let (radius, load, depth) = (10.0, 500.0, 30.0);
    let mut case = Case::new(
        "hertz_cylinder",
        "Steel cylinder on a steel half-plane",
        ["half-plane, y = 0", "parabola y = x^2/(2 R)"],
        &[
            ("E1", STEEL[0], PRESSURE, "Young's modulus, lower body"),
            ("nu1", STEEL[1], "1", "Poisson's ratio, lower body"),
            ("E2", STEEL[0], PRESSURE, "Young's modulus, upper body"),
            ("nu2", STEEL[1], "1", "Poisson's ratio, upper body"),
            ("R", radius, LENGTH, "radius"),
            ("F", load, FORCE, "load"),
            ("d", depth, LENGTH, "depth of the reference point of the lower body, below x = 0"),
        ],
    );
    let roller = Parabola::new(radius, [-2.0, 2.0])?;
    let contact = Contact::new(&Flat, &roller)?.materials(
        material(STEEL),
        material(STEEL),
        PlaneState::Strain,
    );
    let solution = contact.solve(Control::Load(load))?;
    let (pressure, below) = (solution.pressure()?, solution.subsurface()?);
    let modulus = like_steel();
    let [a, peak] = hertz(load, n(radius), modulus);
    case.source("Hertz 1882; Johnson, Contact Mechanics, 1985, Eqs. 4.43 to 4.45");
    let solved = PlaneState::Strain.contact_modulus(material(STEEL), material(STEEL))?;
    case.closed(MODULUS, Place::Whole, modulus, solved, "E* = 1/((1-nu1^2)/E1 + (1-nu2^2)/E2)");
    case.closed(HALF_WIDTH, Place::Whole, a, solution.a(), "a = sqrt(4 F R/(pi E*))");
    case.closed(PEAK, Place::At(0.0), peak, solution.peak()?.pressure, "p0 = 2 F/(pi a)");
    case.closed(MEAN, Place::Whole, n(load) / (a + a), solution.mean_pressure(), "F/(2 a)");
    for x in [0.1, 0.2] {
        let share = n(x) / a;
        let value = peak * (n(1.0) - share * share).sqrt();
        case.closed(AT, Place::At(x), value, pressure.at(x)?, "p0 sqrt(1 - (x/a)^2)");
    }
    case.source("Johnson 1985, Eqs. 4.46 on the axis, 4.49 beside it");
    for (x, y) in [(0.0, 0.1), (0.0, 0.3), (0.15, 0.1)] {
        let values = hertz_stress(a, peak, x, y);
        let found = below.at(x, y)?;
        let formulas = [
            "-p0/a (m (1 + (y^2+n^2)/(m^2+n^2)) - 2 y), y = depth, \
             m^2 = (sqrt((a^2-x^2+y^2)^2 + 4 x^2 y^2) + a^2 - x^2 + y^2)/2, n = x y/m",
            "-p0/a m (1 - (y^2+n^2)/(m^2+n^2))",
            "-p0/a n (m^2-y^2)/(m^2+n^2), y into the body",
        ];
        let names = ["sigma_x", "sigma_y", "tau_xy"];
        let solved = [found.sigma_x, found.sigma_y, found.tau_xy];
        // There is no shear on the axis.
        for i in 0..if x == 0.0 { 2 } else { 3 } {
            case.closed(
                (names[i], PRESSURE),
                Place::Below(x, y),
                values[i],
                solved[i],
                formulas[i],
            );
        }
    }
    case.source(
        "Johnson 1985, Eq. 4.47; in closed form from the zero of the derivative, 1 - u - u^2 = 0",
    );
    let golden = (n(5.0).sqrt() - n(1.0)) / n(2.0);
    let shear = below.max_shear()?;
    let value = peak * golden * golden * golden.sqrt();
    case.closed(
        ("max_shear", PRESSURE),
        Place::Whole,
        value,
        shear.value,
        "p0 u^(5/2), u = (sqrt(5)-1)/2",
    );
    case.closed(
        ("max_shear_depth", LENGTH),
        Place::Whole,
        a * golden.sqrt(),
        shear.depth,
        "a sqrt(u), below x = 0",
    )
    .flat();
    case.source("root of one equation, from Johnson 1985, Eqs. 4.46");
    let ratio = n(STEEL[1]);
    let [depth_of, largest] = greatest(n(0.7), |t| {
        let root = (n(1.0) + t * t).sqrt();
        let [along, across] = [(n(1.0) + n(2.0) * t * t) / root - n(2.0) * t, n(1.0) / root];
        let sum = along + across;
        let squares = (n(1.0) - ratio + ratio * ratio) * sum * sum;
        (squares - n(3.0) * along * across).sqrt()
    });
    let mises = below.max_von_mises(STEEL[1])?;
    let formula = "largest over the depth of sqrt((1-nu+nu^2)(sx+sy)^2 - 3 sx sy), nu = 0.3";
    case.closed(("max_von_mises", PRESSURE), Place::Whole, peak * largest, mises.value, formula);
    case.closed(("max_von_mises_depth", LENGTH), Place::Whole, a * depth_of, mises.depth, formula)
        .flat();
    let to = References { x: 0.0, lower: Reference::Depth(depth), upper: Reference::Disc(radius) };
    let approach = solution.approach(&to)?;
    // Approach towards a depth: the integral of the strain below Hertz's pressure.
    let t = n(depth) / a;
    let share = compliance(STEEL) / PI;
    let far = (n(1.0) + t * t).sqrt();
    let nu = ratio / (n(1.0) - ratio);
    let lower = n(2.0) * share * n(load) * (t.asinh() - nu * t / (far + t));
    let rate = share * (n(2.0) * t.asinh() - t / far / (n(1.0) - ratio));
    let [upper, upper_rate] = disc(STEEL, load, radius, a);
    case.source(
        "integral of the strains of Johnson 1985, Eqs. 4.46; for d much larger than a it is Weber \
         and Banaschek 1953",
    );
    case.closed(
        ("approach_lower", LENGTH),
        Place::Whole,
        lower,
        approach.lower,
        "2 (1-nu^2) F/(pi E) (asinh(d/a) - nu/(1-nu) d/(sqrt(a^2+d^2)+d)): of the surface at x = 0 \
         towards the point at depth d",
    );
    case.source("Johnson 1985, section 5.6");
    case.closed(
        ("approach_upper", LENGTH),
        Place::Whole,
        upper,
        approach.upper,
        "(1-nu^2) F/(pi E) (2 ln(4 R/a) - 1): of the surface towards the centre of a disc loaded at the opposite point",
    );
    case.closed(
        ("approach", LENGTH),
        Place::Whole,
        lower + upper,
        approach.bodies,
        "approach_lower + approach_upper",
    );
    case.closed(
        STIFFNESS,
        Place::Whole,
        n(1.0) / (rate + upper_rate),
        solution.stiffness(&to)?,
        "dF/d(approach), with d ln(a)/dF = 1/(2 F)",
    );
    Ok(case)
}

/// Adds the values of two cylinders of unlike materials.
fn two_cylinders(
    case: &mut Case,
    materials: [[f64; 2]; 2],
    radii: [f64; 2],
    load: f64,
    x: f64,
) -> Result<(Solution<'static, f64>, Precise), Box<dyn Error>> {
    let lower = Parabola::new(-radii[0], [-0.5 * radii[0], 0.5 * radii[0]])?;
    let upper = Parabola::new(radii[1], [-0.5 * radii[0], 0.5 * radii[0]])?;
    let contact = Contact::owned(std::sync::Arc::new(lower), std::sync::Arc::new(upper))?
        .materials(material(materials[0]), material(materials[1]), PlaneState::Strain);
    let solution = contact.solve(Control::Load(load))?;
    let modulus = n(1.0) / (compliance(materials[0]) + compliance(materials[1]));
    let radius = n(1.0) / (n(1.0) / n(radii[0]) + n(1.0) / n(radii[1]));
    let [a, peak] = hertz(load, radius, modulus);
    case.source("Hertz 1882; Johnson, Contact Mechanics, 1985, Eqs. 4.43 to 4.45");
    let solved =
        PlaneState::Strain.contact_modulus(material(materials[0]), material(materials[1]))?;
    case.closed(MODULUS, Place::Whole, modulus, solved, "E* = 1/((1-nu1^2)/E1 + (1-nu2^2)/E2)");
    case.closed(
        HALF_WIDTH,
        Place::Whole,
        a,
        solution.a(),
        "a = sqrt(4 F R/(pi E*)), 1/R = 1/R1 + 1/R2",
    );
    case.closed(PEAK, Place::At(0.0), peak, solution.peak()?.pressure, "p0 = 2 F/(pi a)");
    let share = n(x) / a;
    let value = peak * (n(1.0) - share * share).sqrt();
    case.closed(AT, Place::At(x), value, solution.pressure()?.at(x)?, "p0 sqrt(1 - (x/a)^2)");
    let to =
        References { x: 0.0, lower: Reference::Disc(radii[0]), upper: Reference::Disc(radii[1]) };
    let [one, other] = [0, 1].map(|i| disc(materials[i], load, radii[i], a));
    case.source("Johnson 1985, section 5.6");
    case.closed(
        ("approach", LENGTH),
        Place::Whole,
        one[0] + other[0],
        solution.approach(&to)?.bodies,
        "sum over both of (1-nu^2) F/(pi E) (2 ln(4 R/a) - 1): of the centres of discs",
    );
    case.closed(
        STIFFNESS,
        Place::Whole,
        n(1.0) / (one[1] + other[1]),
        solution.stiffness(&to)?,
        "dF/d(approach): 1 over the sum of (1-nu^2)/(pi E) (2 ln(4 R/a) - 2)",
    );
    Ok((solution, a))
}

fn two_cylinder_parameters(materials: [[f64; 2]; 2], radii: [f64; 2], load: f64) -> [Given; 7] {
    [
        ("E1", materials[0][0], PRESSURE, "Young's modulus, lower body"),
        ("nu1", materials[0][1], "1", "Poisson's ratio, lower body"),
        ("E2", materials[1][0], PRESSURE, "Young's modulus, upper body"),
        ("nu2", materials[1][1], "1", "Poisson's ratio, upper body"),
        ("R1", radii[0], LENGTH, "radius, lower body"),
        ("R2", radii[1], LENGTH, "radius, upper body"),
        ("F", load, FORCE, "load"),
    ]
}

const CYLINDERS: [&str; 2] = ["parabola y = -x^2/(2 R1)", "parabola y = x^2/(2 R2)"];

pub fn unlike_cylinders() -> Made {
    let (materials, radii, load) = ([ALUMINIUM, STEEL], [20.0, 30.0], 200.0);
    let mut case = Case::new(
        "unlike_cylinders",
        "Steel cylinder on an aluminium cylinder",
        CYLINDERS,
        &two_cylinder_parameters(materials, radii, load),
    );
    two_cylinders(&mut case, materials, radii, load, 0.1)?;
    Ok(case)
}

pub fn verification_case_191() -> Made {
    let (materials, radii, load) = ([[30e3, 0.25], [29_120.0, 0.3]], [10.0, 13.0], 3200.0);
    let mut case = Case::new(
        "ansys_vm191",
        "Two cylinders, those of ANSYS verification case 191",
        CYLINDERS,
        &two_cylinder_parameters(materials, radii, load),
    );
    let (solution, a) = two_cylinders(&mut case, materials, radii, load, 1.0)?;
    case.source("Roark's Formulas for Stress and Strain, two cylinders; its constant is that of this length");
    let length = |radius: f64| n(radius) * (n(-1.0) / n(6.0)).exp();
    let share = |of: [f64; 2], radius: f64| {
        let log = n(2.0) * (n(2.0) * length(radius) / a).ln();
        compliance(of) / PI * n(load) * (log + n(1.0))
    };
    let to = |radius: f64| Reference::Length(length(radius).value());
    let to = References { x: 0.0, lower: to(radii[0]), upper: to(radii[1]) };
    case.closed(
        ("approach_by_roark", LENGTH),
        Place::Whole,
        share(materials[0], radii[0]) + share(materials[1], radii[1]),
        solution.approach(&to)?.bodies,
        "sum over both of (1-nu^2) F/(pi E) (2 ln(2 R/a) + 2/3)",
    );
    Ok(case)
}

/// Computes K and K - E by the arithmetic-geometric mean.
fn elliptic(k: Precise) -> [Precise; 2] {
    let (mut one, mut other) = (n(1.0), (n(1.0) - k * k).sqrt());
    let (mut sum, mut weight) = (k * k / n(2.0), n(1.0));
    for _ in 0..8 {
        let half = (one - other) / n(2.0);
        sum = sum + weight * half * half;
        weight = weight + weight;
        (one, other) = ((one + other) / n(2.0), (one * other).sqrt());
    }
    let complete = PI / (n(2.0) * one);
    [complete, complete * sum]
}

pub fn cylinder_in_groove() -> Made {
    let (radii, load) = ([12.0, 10.0], 2000.0);
    let mut case = Case::new(
        "cylinder_in_groove",
        "Steel cylinder in a steel groove, both exact circles",
        [
            "circle of radius R1, its centre above: y = R1 - sqrt(R1^2 - x^2)",
            "circle y = R2 - sqrt(R2^2 - x^2)",
        ],
        &two_cylinder_parameters([STEEL, STEEL], radii, load),
    );
    let [groove, roller] = radii.map(|radius| Ellipse::circle(radius, [-0.5, 0.5]));
    let (groove, roller) = (groove?, roller?);
    let contact = Contact::new(&groove, &roller)?.contact_modulus(like_steel().value());
    let solution = contact.solve(Control::Load(load))?;
    let modulus = like_steel();
    let parts = |a: Precise| radii.map(|radius| elliptic(a / n(radius)));
    let borne = |a: Precise| {
        let [groove, roller] = parts(a);
        modulus * (n(radii[1]) * roller[1] - n(radii[0]) * groove[1])
    };
    let a = root(n(1.15), |a| borne(a) - n(load));
    let [groove_part, roller_part] = parts(a);
    let peak = modulus * a / PI * (roller_part[0] / n(radii[1]) - groove_part[0] / n(radii[0]));
    case.source(
        "superposition of flat punches (Barber, Contact Mechanics, 2018; Johnson 1985, section 5.3) \
         over the slope x/sqrt(R^2-x^2)",
    );
    case.closed(
        HALF_WIDTH,
        Place::Whole,
        a,
        solution.a(),
        "root of F = E* (R2 (K(k2)-E(k2)) - R1 (K(k1)-E(k1))), ki = a/Ri, K and E complete \
         elliptic integrals of modulus k",
    );
    case.closed(
        PEAK,
        Place::At(0.0),
        peak,
        solution.peak()?.pressure,
        "E* a/pi (K(k2)/R2 - K(k1)/R1)",
    );
    Ok(case)
}

/// Makes a case of two steel bodies.
pub fn steel_on_steel(
    name: &'static str,
    title: &'static str,
    upper: &'static str,
    parameters: &[Given],
) -> Case {
    let mut all = vec![
        ("E", STEEL[0], "MPa", "Young's modulus of both bodies"),
        ("nu", STEEL[1], "1", "Poisson's ratio of both bodies"),
    ];
    all.extend(parameters);
    Case::new(name, title, ["half-plane, y = 0", upper], &all)
}
