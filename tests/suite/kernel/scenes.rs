//! Random coated bodies.

use super::oracle::{compliance, residual};
use super::{RIGID, assert_limits, coated, half_plane, layer};
use crate::common::{Profile, graph, join};
use crate::corners::polygon;
use crate::random_scenes::Dice;
use linecontact::profile::Ellipse;
use linecontact::{Base, ContactError, Control, Foundation, InputError, Layer, Material};
use std::f64::consts::PI;

/// A random layer, and the compliance of its surface.
pub fn random_layer(random: &mut Dice) -> (Layer<f64>, f64) {
    let (modulus, ratio) = (random.power_of_ten(-1.0, 1.0), random.within(0.0, 0.49));
    let thickness = random.power_of_ten(-1.0, 0.5);
    let soft = random.power_of_ten(-2.0, 2.0);
    let base = match (4.0 * random.uniform()) as usize {
        0 => Base::Bonded,
        1 => Base::Frictionless,
        _ => half_plane(modulus * soft, random.within(0.0, 0.49)),
    };
    (layer(modulus, ratio, thickness, base), (1.0 - ratio * ratio) / modulus)
}

/// Every contact meets Eq. (1) by sums of its own, and its certificate holds.
#[test]
fn random_coated_bodies_meet_the_equation() {
    let count = std::env::var("SCENES").ok().and_then(|count| count.parse().ok()).unwrap_or(12);
    let mut refused = 0;
    // In the last one the kernel has to grow, too: its base is 77 times as soft as the coating.
    for seed in (0..count).chain((count <= 108).then_some(108)) {
        let random = &mut Dice::new(9100 + seed);
        let (one, compliance) = random_layer(random);
        let plain = Material::elastic(random.power_of_ten(-1.0, 1.0), 0.3);
        let Material::Elastic { youngs_modulus, .. } = plain else { continue };
        let (other, other_compliance, second) = match (3.0 * random.uniform()) as usize {
            0 => (Foundation::from(Material::Rigid), 0.0, None),
            1 => (Foundation::from(plain), 0.91 / youngs_modulus, None),
            _ => {
                let (layer, compliance) = random_layer(random);
                (Foundation::from(layer), compliance, Some(layer))
            }
        };
        let (wave, height) = (random.within(2.0, 6.0), random.within(0.0, 0.3));
        let phase = random.within(0.0, 2.0 * PI);
        let slope = move |x: f64| x - height / wave * (wave * x + phase).sin();
        let body = graph(-12.0, 12.0, move |x| {
            [0.5 * x * x + height / (wave * wave) * (wave * x + phase).cos(), slope(x)]
        });
        let kappa = PI / 2.0 / (compliance + other_compliance);
        let load = kappa * random.power_of_ten(-2.0, -0.5);
        // Each other body turns until the load acts at a given place.
        let at = random.within(-0.3, 0.3);
        let control = if seed % 2 == 0 {
            Control::Load(load)
        } else {
            Control::CentreOfPressure { load, at }
        };
        let contact = coated(&body, one, other);
        let solution = match contact.solve(control) {
            Ok(solution) => solution,
            Err(error) => {
                println!("{seed}: {error}");
                refused += 1;
                continue;
            }
        };
        let share = |compliance: f64| compliance * kappa / (PI / 2.0);
        let mut layers = vec![(share(compliance), one)];
        layers.extend(second.map(|second| (share(other_compliance), second)));
        let tilt = solution.tilt();
        let off = residual(&solution, kappa, &layers, None, |x| slope(x) + tilt);
        if seed % 2 == 1 {
            let centre = solution.centre_of_pressure().unwrap();
            assert!((centre - at).abs() < 1e-12 * solution.hull().half_width().max(1.0));
        }
        assert!(off < 1e-8, "{seed}: {off:e}");
        assert!(solution.certify().is_ok(), "{seed}: {:?}", solution.certify());
    }
    assert!(1000 * refused <= count, "{refused} refused");
}

/// Flat lands with steep walls on a layer: next to their corners the rounding of x moves the
/// pressure, so that Eq. (1) is not met to rounding. The lands are symmetric, and so are the loads.
#[test]
fn lands_press_a_layer() {
    let count = std::env::var("SCENES").ok().and_then(|count| count.parse().ok()).unwrap_or(40);
    for seed in 0..count {
        let random = &mut Dice::new(seed);
        let lands = 1 + (3.0 * random.uniform()) as i32;
        let wall = random.power_of_ten(-6.0, -1.7);
        let ratio = [0.3, 0.45, 0.5][(3.0 * random.uniform()) as usize];
        let base = if random.uniform() < 0.5 { Base::Bonded } else { Base::Frictionless };
        let layer = layer(1.0, ratio, random.power_of_ten(-1.0, 0.3), base);
        let step = 1.8 / f64::from(2 * lands - 1);
        let (mut x, mut points) = (-0.9, vec![[-1.0, 0.2]]);
        for land in 1..=lands {
            points.extend([[x, 0.0], [x + step, 0.0]]);
            if land < lands {
                points.extend([[x + step + wall, 0.1], [x + 2.0 * step - wall, 0.1]]);
            }
            x += 2.0 * step;
        }
        points.push([1.0, 0.2]);
        let (body, load) = (polygon(&points), random.power_of_ten(-4.0, -2.0));
        let contact = coated(&body, layer, Material::Rigid);
        let solution = contact.solve(Control::Load(load));
        let solution = solution.unwrap_or_else(|error| panic!("{seed}: {error}"));
        assert!(solution.limits_error() < Some(1e-6), "{seed}: {solution}");
        let loads: Vec<f64> = solution.contacts().unwrap().iter().map(|one| one.load).collect();
        assert_eq!(loads.len(), lands as usize, "{seed}: {solution}");
        for (one, other) in loads.iter().zip(loads.iter().rev()) {
            assert!((one - other).abs() < 1e-6 * load, "{seed}: {loads:?}");
        }
        assert!((loads.iter().sum::<f64>() / load - 1.0).abs() < 1e-6, "{seed}: {loads:?}");
    }
}

/// A plain joint within rounding of a limit is no corner: Eq. (1) is met to rounding.
#[test]
fn a_joint_beside_a_limit_leaves_a_coated_contact_as_exact() {
    let bowl = |x: f64| [0.5 * x * x, x];
    for (ratio, thickness) in [(0.3, 0.3), (0.45, 0.05), (0.5, 0.02), (0.3, 0.01)] {
        let layer = layer(1.0, ratio, thickness, Base::Bonded);
        let whole = graph(-2.0, 2.0, bowl);
        let exact = coated(&whole, layer, Material::Rigid).solve(Control::HalfWidth(0.3)).unwrap();
        for ulps in [-2, -1, 1, 2] {
            let at = f64::from_bits(exact.a().to_bits().wrapping_add_signed(ulps));
            let body = join(vec![graph(-2.0, at, bowl), graph(at, 2.0, bowl)]);
            let solution = coated(&body, layer, Material::Rigid).solve(Control::Load(exact.load()));
            let solution = solution.unwrap();
            let off = (solution.a() - exact.a()).abs().max((solution.b() - exact.b()).abs());
            let scene = format!("{thickness}, {ulps}: {off:e}, {solution}");
            assert!(off < 1e-12 && solution.limits_error() < Some(1e-11), "{scene}");
        }
    }
}

/// A circle, a parabola or a rough body on a layer, and a load of about this half-width by the
/// thickness: any base and any Poisson's ratio up to 1/2.
struct Loaded {
    layer: Layer<f64>,
    other: Material<f64>,
    /// Share of the layer in the compliance.
    share: f64,
    kappa: f64,
    body: Profile,
    slope: Box<dyn Fn(f64) -> f64>,
    load: f64,
}

fn loaded(random: &mut Dice) -> Loaded {
    let ratio = [0.0, 0.3, 0.45, 0.49, 0.5][(5.0 * random.uniform()) as usize];
    let stiff = random.power_of_ten(-3.0, 3.0);
    let base = match (4.0 * random.uniform()) as usize {
        0 => Base::Bonded,
        1 => Base::Frictionless,
        _ => half_plane(1.0 / stiff, random.within(0.0, 0.5)),
    };
    let layer = layer(1.0, ratio, 1.0, base);
    let half_width = random.power_of_ten(-1.0, 2.0);
    let (own, modulus) = (1.0 - ratio * ratio, random.power_of_ten(-1.0, 2.0));
    let (other, beside) = match random.uniform() < 0.3 {
        true => (Material::elastic(modulus, 0.3), 0.91 / modulus),
        false => (Material::Rigid, 0.0),
    };
    let (share, kappa) = (own / (own + beside), PI / 2.0 / (own + beside));
    let soft = 1.0 + share * (compliance(&layer, 3.0 / half_width) - 1.0);
    // Under a stiff coating the contact may be some times as wide.
    let times = if matches!(base, Base::HalfPlane(_)) && stiff > 10.0 { 12.0 } else { 1.0 };
    let radius = times * half_width * random.power_of_ten(0.5, 3.0);
    let end = times * half_width * random.within(2.5, 6.0);
    let load = 0.5 * kappa * half_width * half_width / (soft * radius);
    let (wave, part) = (random.power_of_ten(0.0, 1.3) / half_width, random.power_of_ten(-2.0, 1.5));
    let phase = random.within(0.0, 2.0 * PI);
    let (body, slope): (Profile, Box<dyn Fn(f64) -> f64>) = match (3.0 * random.uniform()) as usize
    {
        0 => {
            let body = graph(-end, end, move |x| [0.5 * x * x / radius, x / radius]);
            (body, Box::new(move |x| x / radius))
        }
        1 => {
            let end = (end / radius).min(0.9);
            let body = Ellipse::circle(radius, [-end.asin(), end.asin()]).unwrap();
            (Box::new(body), Box::new(move |x| x / (radius * radius - x * x).sqrt()))
        }
        _ => {
            let slope = move |x: f64| (x - part / wave * (wave * x + phase).sin()) / radius;
            let height = move |x: f64| {
                (0.5 * x * x + part / (wave * wave) * (wave * x + phase).cos()) / radius
            };
            (graph(-end, end, move |x| [height(x), slope(x)]), Box::new(slope))
        }
    };
    Loaded { layer, other, share, kappa, body, slope, load }
}

/// Loads on layers that are thick or thin, stiff or soft. Some contacts are wider than is solved.
#[test]
fn random_loads_on_layers_meet_the_equation() {
    let count = std::env::var("SCENES").ok().and_then(|count| count.parse().ok()).unwrap_or(100);
    let (mut refused, mut too_thin) = (0, 0);
    for seed in 0..count {
        let scene = loaded(&mut Dice::new(61_000 + seed));
        let contact = coated(&scene.body, scene.layer, scene.other);
        let solution = match contact.solve(Control::Load(scene.load)) {
            Ok(solution) => solution,
            Err(ContactError::Input(InputError::LayerTooThin { ratio, .. })) => {
                assert!(ratio > 100.0);
                too_thin += 1;
                continue;
            }
            Err(error) => {
                println!("{seed}: {error}");
                refused += 1;
                continue;
            }
        };
        let layers = [(scene.share, scene.layer)];
        let off = residual(&solution, scene.kappa, &layers, None, scene.slope);
        assert!(off < 1e-8, "{seed}: {off:e}");
        assert!(solution.certify().is_ok(), "{seed}: {:?}", solution.certify());
    }
    assert!(1000 * refused <= count && 50 * too_thin <= count, "{refused}, {too_thin}");
}

/// A land between a wall and a ramp under light loads, on a layer and in a period: held at both
/// corners, its pressure is in proportion to the load.
#[test]
fn a_land_under_light_loads() {
    let wall = 1e6;
    let points = [[-0.7, 0.025], [-0.5, 0.025], [0.0, 0.0], [1.5, 0.0]];
    let points = [&points[..], &[[1.5 + 0.025 / wall, 0.025], [2.3, 0.025]]].concat();
    let body = polygon(&points);
    let layer = layer(1.0, 0.3, 0.4, Base::Bonded);
    let steel = Material::elastic(3.0, 0.3);
    for contact in [coated(&body, RIGID, layer), coated(&body, RIGID, steel).period(3.0)] {
        let mut last = None;
        for load in [1e-9, 1e-7, 1e-5] {
            let solution = contact.solve(Control::Load(load)).unwrap();
            assert_limits(&solution, &[[0.0, 1.5]], 1e-6);
            let pressure = solution.pressure().unwrap();
            let shares = [0.1, 0.75, 1.4].map(|x| pressure.at(x).unwrap() / load);
            for (share, last) in shares.into_iter().zip(last.unwrap_or(shares)) {
                assert!((share / last - 1.0).abs() < 1e-4, "{load}: {shares:?} {last:?}");
            }
            last = Some(shares);
        }
    }
}
