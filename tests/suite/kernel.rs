//! Bodies with a regular kernel, Eq. (1) in full: layers, compliances by wavenumber, formulas.
#![allow(missing_docs)]

mod approach;
mod oracle;
mod periodic;
mod rates;
mod refused;
mod scenes;
mod stack;
mod stress;
mod walls;

use crate::common::{Profile, graph, join, kernel_values};
use linecontact::profile::{Line, Parabola};
use linecontact::reference::Westergaard;
use linecontact::{
    Base, Body, Contact, Control, Curve, CurvePoint, Edge, Flat, Foundation, Layer, Material,
    PlaneState, Reference, References, RegularKernel, Solution, Solver, SurfaceCompliance,
};
use std::f64::consts::PI;
use std::sync::Arc;

pub const RIGID: Material<f64> = Material::Rigid;

pub fn layer(modulus: f64, ratio: f64, thickness: f64, base: Base<f64>) -> Layer<f64> {
    Layer { material: Material::elastic(modulus, ratio), thickness, base }
}

pub fn half_plane(modulus: f64, ratio: f64) -> Base<f64> {
    Base::HalfPlane(Material::elastic(modulus, ratio))
}

pub fn coated(
    body: &Profile,
    lower: impl Into<Foundation<f64>>,
    upper: impl Into<Foundation<f64>>,
) -> Contact<'_, f64> {
    Contact::new(&Flat, &**body).unwrap().materials(lower, upper, PlaneState::Strain)
}

pub fn parabola(end: f64) -> Profile {
    graph(-end, end, |x| [0.5 * x * x, x])
}

fn assert_limits(solution: &Solution<'_, f64>, expected: &[[f64; 2]], tolerance: f64) {
    assert_eq!(solution.intervals().len(), expected.len());
    for (on, [left, right]) in solution.intervals().iter().zip(expected) {
        let off = (on.left - left).abs().max((on.right - right).abs());
        assert!(off <= tolerance, "{on:?}: {off:e}");
    }
}

/// The limits, p(0) and the load of a parabola by a direct solution in 22 digits.
#[test]
fn layers_agree_with_values_of_22_digits() {
    let cases = [
        ("slip", layer(1.0, 0.3, 1.0, Base::Frictionless), 1e-14),
        ("bonded nu=0.3", layer(1.0, 0.3, 1.0, Base::Bonded), 1e-14),
        ("bonded nu=0.5", layer(1.0, 0.5, 1.0, Base::Bonded), 1e-14),
        ("E2=5 nu=.3/.3", layer(1.0, 0.3, 1.0, half_plane(5.0, 0.3)), 1e-14),
        ("E2=0.2 nu=.3/.3", layer(1.0, 0.3, 1.0, half_plane(0.2, 0.3)), 1e-14),
        // Here K(0) is 90: so much larger is r than what is left of it.
        ("E2=0.01 nu=.2/.4", layer(1.0, 0.2, 1.0, half_plane(0.01, 0.4)), 3e-14),
    ];
    let body = parabola(6.0);
    for (name, layer, tolerance) in cases {
        let [load, peak] = kernel_values(name, ["F", "p0"]);
        for contact in [coated(&body, layer, RIGID), coated(&body, RIGID, layer)] {
            let solution = contact.solve(Control::Load(load)).unwrap();
            assert_limits(&solution, &[[-1.0, 1.0]], tolerance);
            let found = solution.pressure().unwrap().at(0.0).unwrap();
            assert!((found / peak - 1.0).abs() < tolerance, "{name}: {:e}", found / peak - 1.0);
            assert!(solution.report().is_checked());
            assert!(solution.certify().unwrap().is_proved(), "{name}");
            assert!(solution.residual(0.3).unwrap().abs() < 1e-12 * peak);
        }
    }
}

/// Both bodies have layers, and touch in two places (`theory.md`, "mechanism").
#[test]
fn two_contacts_of_two_coated_bodies() {
    let body = graph(-2.0, 2.0, |x| {
        [0.5 * (x * x - 1.0).powi(2) + 0.03 * x, 2.0 * x * (x * x - 1.0) + 0.03]
    });
    let (lower, upper) =
        (layer(1.0, 0.3, 0.5, Base::Bonded), layer(2.0, 0.4, 0.3, Base::Frictionless));
    let expected =
        [[-1.196828919442471, -0.7470943773397546], [0.802035958927394, 1.14053487234748]];
    for (one, other) in [(lower, upper), (upper, lower)] {
        let solution = coated(&body, one, other).solve(Control::Load(0.2)).unwrap();
        assert_limits(&solution, &expected, 4e-15);
        let pressure = solution.pressure().unwrap().at(-1.0).unwrap();
        assert!((pressure / 0.38205042990074 - 1.0).abs() < 1e-14);
        assert!(solution.certify().unwrap().is_proved());
    }
}

/// A kink inside the contact, where the pressure goes like a logarithm.
#[test]
fn a_wedge_on_a_layer() {
    let side = |from: f64, to: f64, slope: f64| graph(from, to, move |x| [slope * x, slope]);
    let body = join(vec![side(-3.0, 0.0, -0.3), side(0.0, 3.0, 0.3)]);
    let contact = coated(&body, layer(1.0, 0.3, 1.0, Base::Bonded), RIGID);
    let solution = contact.solve(Control::Load(0.4)).unwrap();
    assert_limits(&solution, &[[-0.837686811249576, 0.837686811249576]], 1e-14);
}

/// Contacts are born and merge on the way.
#[test]
fn a_rough_body_on_a_layer() {
    let waves = [(7.0, 0.3), (13.0, 1.1), (23.0, 2.0), (31.0, 4.0)];
    let body = graph(-5.0, 5.0, move |x| {
        waves.iter().enumerate().fold([x * x / 40.0, x / 20.0], |[y, dy], (j, (q, phase))| {
            let amplitude = 0.02 / (j as f64 + 1.0).powi(2);
            let (sin, cos) = (q * x + phase).sin_cos();
            [y + amplitude * cos, dy - amplitude * q * sin]
        })
    });
    let cases = [
        (0.5, 0.1, 6, [-2.2597109514950158, 2.2031782901075987]),
        (0.2, 0.06, 8, [-2.277543016167543, 2.2122688808134523]),
        (5.0, 0.15, 4, [-1.4411686796371581, 1.4263537795910777]),
    ];
    for (modulus, load, count, [left, right]) in cases {
        let layer = layer(1.0, 0.3, 1.0, half_plane(modulus, 0.3));
        let solution = coated(&body, layer, RIGID).solve(Control::Load(load)).unwrap();
        assert_eq!(solution.intervals().len(), count);
        let hull = solution.hull();
        assert!((hull.left - left).abs().max((hull.right - right).abs()) < 5e-15);
    }
}

/// A cover of rubber on steel has the same contact on a body three thousand thicknesses wide, where
/// half-planes of the rubber would touch over two hundred, as on a narrow one.
#[test]
fn the_width_of_the_bodies_does_not_count() {
    let steel = Material::elastic(210e3, 0.3);
    let cover = layer(5.0, 0.48, 0.02, Base::HalfPlane(steel));
    let found = [3.0, 60.0].map(|half| {
        let body = Parabola::new(100.0, [-half, half]).unwrap();
        let contact = Contact::new(&Flat, &body).unwrap();
        let contact = contact.materials(steel, cover, PlaneState::Strain);
        [Control::Load(1.0), Control::PeakPressure(2.0)]
            .map(|control| contact.solve(control).unwrap().a())
    });
    for (i, known) in [0.439_955_635, 0.462_318_389].into_iter().enumerate() {
        assert!((found[0][i] - known).abs() < 1e-8, "{found:?}");
        assert!((found[1][i] / found[0][i] - 1.0).abs() < 1e-11, "{found:?}");
    }
}

/// A thin layer on a rigid base: the factors of Wiener and Hopf, exact but for `exp(-a/h)`.
#[test]
fn thin_layers_follow_the_law_of_wiener_and_hopf() {
    // c in K ~ cξ, λ₁ and λ₃.
    let cases = [
        (Base::Frictionless, 0.5, 0.1771315758, -0.0167511976, [8.0, 12.0]),
        (Base::Bonded, 0.4081632653061224, 0.1220706479, -0.0530083740, [12.0, 16.0]),
    ];
    for (base, c, first, third, ratios) in cases {
        for ratio in ratios {
            let stiffness: f64 = 1.0 / 0.91 / (2.0 * c);
            let wide: f64 = ratio + first;
            let load = 2.0 * stiffness / 3.0 * (wide.powi(3) - 3.0 * third);
            let body = parabola(3.0 * ratio);
            let contact = coated(&body, layer(1.0, 0.3, 1.0, base), RIGID);
            let found = contact.solve(Control::Load(load)).unwrap().a() / ratio - 1.0;
            assert!(found.abs() < 3e-11, "{base:?} {ratio}: {found:e}");
        }
    }
}

/// A thick layer is a half-plane, `F (1 + g₁ a²/2h²) = F` of Hertz, and a layer of the base's
/// material is none.
#[test]
fn limits_of_thick_layers_and_of_equal_materials() {
    let body = Parabola::new(1.0, [-6.0, 6.0]).unwrap();
    let body: Profile = Box::new(body);
    let plain = coated(&body, Material::elastic(1.0, 0.3), RIGID);
    let hertz = plain.solve(Control::Load(0.5)).unwrap();
    let same = coated(&body, layer(1.0, 0.3, 1.0, half_plane(1.0, 0.3)), RIGID);
    let found = same.solve(Control::Load(0.5)).unwrap();
    assert!((found.a() / hertz.a() - 1.0).abs() < 1e-15);
    for thickness in [1e2, 1e3, 1e6] {
        let thick = coated(&body, layer(1.0, 0.3, thickness, Base::Bonded), RIGID);
        let found = thick.solve(Control::Load(0.5)).unwrap();
        let off = (found.a() / hertz.a() - 1.0).abs();
        assert!(off < 1e-15 + (hertz.a() / thickness).powi(2), "{thickness}: {off:e}");
    }
}

/// Kernel of a row of equal contacts, less that of one: `π/p cot(π y/p) - 1/y`.
struct Row {
    period: f64,
}

impl RegularKernel<f64> for Row {
    fn slope(&self, x: f64, s: f64) -> f64 {
        let y = PI * (x - s) / self.period;
        // The series up to y⁷; the next term is y⁹/93555.
        let near = -y / 3.0 - y.powi(3) / 45.0 - 2.0 * y.powi(5) / 945.0 - y.powi(7) / 4725.0;
        PI / self.period * if y.abs() < 0.03 { near } else { y.tan().recip() - y.recip() }
    }

    fn height(&self, x: f64, s: f64) -> f64 {
        let y = PI * (x - s) / self.period;
        if y == 0.0 { 0.0 } else { (y.sin() / y).ln() }
    }

    fn nearest_singularity(&self) -> f64 {
        self.period / 10.0
    }
}

/// Westergaard's wavy surface, by the kernel of a row of contacts.
#[test]
fn a_kernel_by_a_formula_is_that_of_a_row_of_contacts() {
    let (period, amplitude) = (1.3f64, 0.02);
    let wave = 2.0 * PI / period;
    let body = graph(-period / 2.0, period / 2.0, move |x| {
        let (sin, cos) = (wave * x).sin_cos();
        [amplitude * (1.0 - cos), amplitude * wave * sin]
    });
    let kernel = Row { period };
    for half_width in [0.05, 0.2, 0.4] {
        let exact = Westergaard::new(amplitude, period, half_width).unwrap();
        let contact = Contact::new(&Flat, &*body).unwrap().contact_modulus(1.0).kernel(&kernel);
        let solution = contact.solve(Control::Load(exact.load(PI / 2.0))).unwrap();
        let off = solution.a() / half_width - 1.0;
        assert!(off.abs() < 1e-13, "{half_width}: {off:e}");
        let peak = solution.peak().unwrap().pressure / exact.pressure(0.0, PI / 2.0) - 1.0;
        assert!(peak.abs() < 1e-13, "{half_width}: {peak:e}");
        let owned = Contact::new(&Flat, &*body).unwrap().contact_modulus(1.0);
        let owned = owned.owned_kernel(Arc::new(Row { period }));
        let again = owned.solve(Control::Load(solution.load())).unwrap();
        assert_eq!(again.intervals(), solution.intervals());
        // Without the kernel, half-planes are not as wide under any load.
        let by_width = owned.solve(Control::HalfWidth(half_width)).unwrap();
        assert!((by_width.load() / solution.load() - 1.0).abs() < 1e-12);
    }
}

/// Compliance of a layer on a rigid base without friction, `K = (cosh 2ξ - 1)/(sinh 2ξ + 2ξ)`.
struct Frictionless;

impl SurfaceCompliance<f64> for Frictionless {
    fn excess(&self, wavenumber: f64) -> f64 {
        let decay = (-2.0 * wavenumber).exp();
        let below = 1.0 + 4.0 * wavenumber * decay - decay * decay;
        2.0 * decay * (decay - 1.0 - 2.0 * wavenumber) / below
    }

    fn decay(&self) -> f64 {
        2.0
    }

    fn longest(&self) -> f64 {
        1.0
    }
}

pub fn own_compliance() -> Arc<dyn SurfaceCompliance<f64>> {
    Arc::new(Frictionless)
}

#[test]
fn a_compliance_of_ones_own_is_that_of_the_layer() {
    let body = parabola(6.0);
    let own = Contact::new(&Flat, &*body).unwrap().contact_modulus(1.0 / 0.91);
    let own = own.compliance(own_compliance()).solve(Control::Load(1.0)).unwrap();
    let layered = coated(&body, layer(1.0, 0.3, 1.0, Base::Frictionless), RIGID);
    let layered = layered.solve(Control::Load(1.0)).unwrap();
    assert!((own.a() / layered.a() - 1.0).abs() < 1e-14);
}

/// Every control leads to the same contact, and a solver that goes on from another one, too.
#[test]
fn controls_and_solvers_agree() {
    let body = parabola(6.0);
    let contact = coated(&body, layer(1.0, 0.3, 1.0, Base::Bonded), RIGID);
    let [load, peak] = kernel_values("bonded nu=0.3", ["F", "p0"]);
    for control in [Control::HalfWidth(1.0), Control::PeakPressure(peak)] {
        let solution = contact.solve(control).unwrap();
        assert!((solution.load() / load - 1.0).abs() < 4e-15, "{control:?}");
        assert_limits(&solution, &[[-1.0, 1.0]], 4e-15);
    }
    // A parabola that turns only moves.
    let turned = contact.solve(Control::CentreOfPressure { load, at: 0.25 }).unwrap();
    assert_limits(&turned, &[[-0.75, 1.25]], 4e-15);
    assert!((turned.tilt() + 0.25).abs() < 1e-14);
    let mut solver = Solver::new();
    for share in [0.5, 1.0, 1.01, 2.0, 1.0] {
        let warm = solver.solve(&contact, Control::Load(share * load)).unwrap();
        let cold = contact.solve(Control::Load(share * load)).unwrap();
        assert!((warm.a() / cold.a() - 1.0).abs() < 4e-15, "{share}");
    }
}

/// Bodies are sampled as they are described: a bend that changes calls no curve. (Each bend sampled
/// them anew: 155 evaluations and heights for the next load.)
#[test]
fn a_bend_samples_nothing() {
    let circle = Curve::new([-1.5, 1.5], |k: f64| {
        let ((sin, cos), half) = (k.sin_cos(), (0.5 * k).sin());
        CurvePoint { x: 10.0 * sin, y: 20.0 * half * half, dx: 10.0 * cos, dy: 10.0 * sin }
    });
    let contact = Contact::new(&Flat, &circle).unwrap();
    let rubber = layer(1.0, 0.3, 1.0, Base::Bonded);
    let coated = contact.clone().materials(rubber, RIGID, PlaneState::Strain);
    let sum = |solution: Solution<'_, f64>| solution.cost().evaluations + solution.cost().heights;
    for half_width in [0.3, 1.0] {
        let [plain, coated] = [&contact, &coated].map(|contact| {
            let load = contact.solve(Control::HalfWidth(half_width)).unwrap().load();
            let mut solver = Solver::new();
            let mut under =
                |share: f64| sum(solver.solve(contact, Control::Load(share * load)).unwrap());
            [1.0, 1.02, 0.98, 1.0].map(&mut under)
        });
        println!("{half_width}: {plain:?} {coated:?}");
        assert!(4 * coated[0] <= 5 * plain[0] && coated[1..].iter().sum::<usize>() <= 28);
    }
}

#[test]
fn f32_solves_layers() {
    let body = Parabola::new(1.0f32, [-6.0, 6.0]).unwrap();
    let layer = Layer { material: Material::elastic(1.0, 0.3), thickness: 1.0, base: Base::Bonded };
    let contact = Contact::new(&Flat, &body).unwrap();
    let contact = contact.materials(layer, Material::Rigid, PlaneState::Strain);
    let solution = contact.solve(Control::Load(1.342_633_9f32)).unwrap();
    assert!((solution.a() - 1.0).abs() < 2e-6, "{}", solution.a());
    let below = solution.subsurface_of(Body::Lower).unwrap();
    // Held, the bottom is not stretched.
    let bottom = below.at(0.3, 1.0).unwrap();
    assert!((0.7 * bottom.sigma_x - 0.3 * bottom.sigma_y).abs() < 4e-6, "{bottom:?}");
}

/// What half-planes bear, or bodies with the bend of another load, bounds no width and no peak.
#[test]
fn half_planes_do_not_bound_a_nip() {
    let body: Profile = Box::new(Parabola::new(100.0, [-60.0, 60.0]).unwrap());
    let contact = coated(&body, RIGID, layer(5.0, 0.48, 10.0, Base::Bonded));
    let load = contact.solve(Control::Load(100.0)).unwrap();
    let peak = load.peak().unwrap().pressure;
    let again = contact.solve(Control::PeakPressure(peak)).unwrap();
    assert!((again.load() / 100.0 - 1.0).abs() < 1e-12, "{}", again.load());
    let wide = contact.solve(Control::HalfWidth(59.0)).unwrap();
    let again = contact.solve(Control::Load(wide.load())).unwrap();
    assert!((again.a() / 59.0 - 1.0).abs() < 1e-12, "{}", again.a());
    let to = Reference::Depth(1.0);
    let references = References { x: 0.0, lower: to, upper: to };
    let approach = wide.approach(&references).unwrap().bodies;
    let control = Control::Approach { approach, references };
    let again = contact.solve(control).unwrap();
    assert!((again.a() / 59.0 - 1.0).abs() < 1e-11, "{}", again.a());
}

/// A layer between two punches, each an endless flat with corners.
#[test]
fn flats_on_a_layer() {
    let layer = layer(5.0, 0.48, 10.0, Base::Bonded);
    let line = Line::new(0.0, [-3.0, 3.0]).unwrap();
    let solve = |contact: Contact<'_, f64>| {
        let contact = contact.materials(RIGID, layer, PlaneState::Strain);
        let contact = contact.edges(Edge::Fixed(-1.0), Edge::Fixed(1.0));
        let solution = contact.solve(Control::Load(1.0)).unwrap();
        solution.pressure().unwrap().at(0.3).unwrap()
    };
    let expected = solve(Contact::new(&Flat, &line).unwrap());
    let found = solve(Contact::new(&Flat, &Flat).unwrap());
    assert!((found / expected - 1.0).abs() < 1e-13, "{found} {expected}");
}

/// Checks find other contacts than the one that was sought; r of a kink on a thin layer is known to
/// fewer digits; a solver comes from other bodies.
#[test]
fn searches_end() {
    let waves = graph(-4.6, 4.6, |x| {
        let (u, (sin, cos)) = (x - 0.26, (9.438 * x + 1.189).sin_cos());
        [u * u / 964.0 + 1.45e-4 * cos, u / 482.0 - 1.45e-4 * 9.438 * sin]
    });
    let coating = layer(0.1288, 0.3638, 2.0246, half_plane(0.02253, 0.435));
    let contact = coated(&waves, RIGID, coating);
    assert!(contact.solve(Control::Load(7.1635e-4)).unwrap().report().is_checked());

    let side = |from: f64, to: f64, slope: f64| graph(from, to, move |x| [slope * x, slope]);
    let wedge = join(vec![side(-3.0, 0.0, -0.3), side(0.0, 3.0, 0.3)]);
    let contact = coated(&wedge, layer(1.0, 0.3, 0.03, Base::Bonded), RIGID);
    let solution = contact.solve(Control::Load(0.4)).unwrap();
    assert!(solution.limits_error().unwrap() < 1e-10);

    let mut solver = Solver::new();
    let rubber = layer(1.0, 0.3, 1.0, Base::Bonded);
    for centre in [-2.0, 2.0] {
        let body = graph(-6.0, 6.0, move |x| [0.5 * (x - centre).powi(2), x - centre]);
        let contact = coated(&body, rubber, RIGID);
        let warm = solver.solve(&contact, Control::Load(0.5)).unwrap();
        let cold = contact.solve(Control::Load(0.5)).unwrap();
        assert!((warm.a() - cold.a()).abs() < 1e-14, "{centre}");
    }
}
