//! Stress in a layer and its base.

use super::oracle::stresses;
use super::periodic::{PERIOD, row, waves};
use super::scenes::random_layer;
use super::{RIGID, coated, half_plane, layer, parabola};
use crate::common::{NanSafe, graph, join, worst};
use crate::random_scenes::Dice;
use linecontact::stress::Subsurface;
use linecontact::{
    Base, Body, Contact, ContactError, Control, Edge, EvaluationError, Flat, Foundation, Layer,
    Material, Solution,
};
use std::f64::consts::{PI, TAU};

const BASES: [Base<f64>; 3] = [Base::Bonded, Base::Frictionless, Base::HalfPlane(STEEL)];
const STEEL: Material<f64> = Material::Elastic { youngs_modulus: 0.3, poisson_ratio: 0.35 };

/// σx, σy and τ at a place.
fn at(below: &Subsurface<'_, f64>, x: f64, depth: f64) -> [f64; 3] {
    let stress = below.at(x, depth).unwrap();
    [stress.sigma_x, stress.sigma_y, stress.tau_xy]
}

/// Returns the first depth in the base.
fn beyond(depth: f64) -> f64 {
    depth * (1.0 + f64::EPSILON)
}

fn most(differences: impl IntoIterator<Item = f64>) -> f64 {
    differences.into_iter().fold(0.0, |most: f64, value| most.nan_max(value.abs()))
}

/// Twenty random scenes, each at random places in the layer, at the interface and in the base.
#[test]
fn random_layers_have_the_stress_of_a_direct_sum() {
    let mut errors = Vec::new();
    for seed in 0..20 {
        let random = &mut Dice::new(700 + seed);
        let (one, compliance) = random_layer(random);
        let wave = random.within(1.0, 4.0);
        let body = graph(-12.0, 12.0, move |x| {
            [0.5 * x * x + 0.1 * (wave * x + 1.0).cos(), x - 0.1 * wave * (wave * x + 1.0).sin()]
        });
        // The other body is rigid, a half-plane or coated.
        let (other, modulus) = (random_layer(random).0, random.power_of_ten(-1.0, 1.0));
        let contact = match seed % 3 {
            0 => coated(&body, one, RIGID),
            1 => coated(&body, one, Material::elastic(modulus, 0.3)),
            _ => coated(&body, one, other),
        };
        let load = random.power_of_ten(-1.5, -0.3) / compliance;
        let solution = contact.solve(Control::Load(load)).unwrap();
        let (hull, thickness) = (solution.hull(), one.thickness);
        let mut place = |depth: f64| {
            [hull.centre() + random.within(-2.0, 2.0) * hull.half_width(), depth * thickness]
        };
        let mut places = vec![place(0.5), place(0.7), place(0.95), place(1.0)];
        if matches!(one.base, Base::HalfPlane(_)) {
            places.extend([place(1.0001), place(1.4), place(3.0), place(20.0)]);
        }
        let below = solution.subsurface_of(Body::Lower).unwrap();
        let peak = solution.peak().unwrap().pressure;
        let expected = stresses(&solution, &one, &places, None);
        let off = most(places.iter().zip(&expected).flat_map(|(&[x, depth], expected)| {
            let found = at(&below, x, depth);
            let size = peak.max(most(*expected));
            [0, 1, 2].map(|i| (found[i] - expected[i]) / size)
        }));
        assert!(off < 1e-9, "{seed} {one:?}: {off:e}");
        errors.push(off);
    }
    println!("{:.1e}", worst(errors));
}

fn scene(base: Base<f64>) -> (Layer<f64>, Solution<'static, f64>) {
    let one = layer(1.0, 0.3, 0.7, base);
    let body: &'static crate::common::Profile = Box::leak(Box::new(parabola(6.0)));
    let contact = coated(body, one, Material::elastic(2.0, 0.25));
    (one, contact.solve(Control::HalfWidth(1.0)).unwrap())
}

#[test]
fn the_surface_bears_the_pressure() {
    for base in BASES {
        let (_, solution) = scene(base);
        let (below, pressure) =
            (solution.subsurface_of(Body::Lower).unwrap(), solution.pressure().unwrap());
        for x in [-0.9, 0.0, 0.4, 1.5, 30.0] {
            let expected = pressure.at(x).unwrap_or(0.0);
            let [along, normal, shear] = at(&below, x, 0.0);
            assert!((normal + expected).abs() <= 1e-15 && shear == 0.0, "{x}");
            // Just below there is the same stress: the sum goes on to the surface.
            let [deep, normal, shear] = at(&below, x, 1e-13);
            let off = most([deep - along, normal + expected, shear]);
            assert!(off < 1e-12, "{base:?} {x}: {off:e}");
        }
    }
}

/// σ_y and τ are continuous at the interface, and the strains of the surface of both along x; on a
/// base without friction τ vanishes.
#[test]
fn the_interface_bears_both_sides() {
    for base in BASES {
        let (one, solution) = scene(base);
        let below = solution.subsurface_of(Body::Lower).unwrap();
        for x in [-3.0, -0.9, 0.0, 0.4, 1.5, 7.0, 300.0, 1e7] {
            let [along, normal, shear] = at(&below, x, one.thickness);
            match base {
                Base::HalfPlane(_) => {
                    let [base_along, base_normal, base_shear] =
                        at(&below, x, beyond(one.thickness));
                    let off = most([normal - base_normal, shear - base_shear]);
                    assert!(off < 2e-15, "{x}: {off:e}");
                    // ε_x = (1 + ν)/E ((1 - ν) σ_x - ν σ_y)
                    let strain = |modulus: f64, ratio: f64, along: f64, normal: f64| {
                        (1.0 + ratio) / modulus * ((1.0 - ratio) * along - ratio * normal)
                    };
                    let off = strain(1.0, 0.3, along, normal)
                        - strain(0.3, 0.35, base_along, base_normal);
                    assert!(off.abs() < 2e-14, "{x}: {off:e}");
                }
                Base::Frictionless => assert!(shear.abs() < 1e-14, "{x}: {shear:e}"),
                // Held: no strain along x.
                _ => assert!((0.7 * along - 0.3 * normal).abs() < 1e-14, "{x}"),
            }
        }
    }
}

/// Equilibrium, `∂σ_x/∂x + ∂τ/∂y = 0` and `∂τ/∂x + ∂σ_y/∂y = 0`, and the compatibility of strains,
/// `∇²(σ_x + σ_y) = 0`, by differences.
#[test]
fn equilibrium_in_layer_and_base() {
    let step = 1e-3;
    // Of sixth order.
    let weights = [1.0 / 60.0, -3.0 / 20.0, 3.0 / 4.0].map(|weight| weight / step);
    for base in BASES {
        let (_, solution) = scene(base);
        let below = solution.subsurface_of(Body::Lower).unwrap();
        let depths = [0.2, 0.35, 0.69, 0.75, 1.5];
        let count = if matches!(base, Base::HalfPlane(_)) { 5 } else { 3 };
        for (x, depth) in depths[..count].iter().flat_map(|&y| [(0.3, y), (-1.1, y), (2.0, y)]) {
            let slope = |way: [f64; 2], of: usize| -> f64 {
                let pairs = weights.iter().zip([3.0, 2.0, 1.0]).map(|(weight, n)| {
                    let [there, back] = [n * step, -n * step]
                        .map(|s| at(&below, x + s * way[0], depth + s * way[1])[of]);
                    weight * (there - back)
                });
                pairs.sum()
            };
            let (across, down) = ([1.0, 0.0], [0.0, 1.0]);
            let off = most([slope(across, 0) + slope(down, 2), slope(across, 2) + slope(down, 1)]);
            assert!(off < 1e-11, "{base:?} {x} {depth}: {off:e}");
            let sum = |x: f64, y: f64| at(&below, x, y)[..2].iter().sum::<f64>();
            let beside = [across, down].map(|[right, down]| {
                let [right, down] = [right, down].map(|way| step * way);
                sum(x + right, depth + down) + sum(x - right, depth - down)
            });
            let laplacian = (beside[0] + beside[1] - 4.0 * sum(x, depth)) / (step * step);
            assert!(laplacian.abs() < 1e-4, "{base:?} {x} {depth}: {laplacian:e}");
        }
    }
}

/// A layer of the base's material is none, and under a thick one there is a half-plane.
#[test]
fn limits_of_equal_materials_and_of_thick_layers() {
    let body = parabola(6.0);
    let solve =
        |lower: Layer<f64>| coated(&body, lower, RIGID).solve(Control::HalfWidth(1.0)).unwrap();
    let plain = coated(&body, Material::elastic(1.0, 0.3), RIGID);
    let plain = plain.solve(Control::HalfWidth(1.0)).unwrap();
    let plain = plain.subsurface().unwrap();
    let compare = |solution: &Solution<'_, f64>, depths: &[f64]| {
        let below = solution.subsurface_of(Body::Lower).unwrap();
        let places = depths.iter().flat_map(|&y| [0.0, 0.5, -0.97, 1.3, 40.0].map(|x| [x, y]));
        most(places.flat_map(|[x, y]| {
            let (one, other) = (at(&below, x, y), at(&plain, x, y));
            [0, 1, 2].map(|i| one[i] - other[i])
        }))
    };
    let same = solve(layer(1.0, 0.3, 0.5, half_plane(1.0, 0.3)));
    let off = compare(&same, &[0.0, 1e-6, 0.2, 0.5, beyond(0.5), 1.0, 5.0, 100.0, 1e5]);
    assert!(off < 2e-15, "{off:e}");
    for thickness in [1e2, 1e4, 1e6] {
        let off = compare(&solve(layer(1.0, 0.3, thickness, Base::Bonded)), &[0.0, 0.5, 3.0]);
        assert!(off < 0.4 / thickness, "{thickness}: {off:e}");
    }
    // No tension on a half-plane; and what is refused does not depend on the materials.
    assert!(same.subsurface_of(Body::Upper).unwrap().friction(0.1).is_err());
    let below = same.subsurface_of(Body::Lower).unwrap();
    let tension = below.max_tension().unwrap();
    assert!(tension.value < 1e-15, "{tension:?}");
}

/// Two contacts, both bodies coated: each body has a stress of its own.
#[test]
fn two_contacts_of_coated_bodies() {
    let body = graph(-2.0, 2.0, |x| {
        [0.5 * (x * x - 1.0).powi(2) + 0.03 * x, 2.0 * x * (x * x - 1.0) + 0.03]
    });
    let pair = [layer(1.0, 0.3, 0.5, Base::Bonded), layer(2.0, 0.4, 0.3, half_plane(0.5, 0.2))];
    let contact = coated(&body, pair[0], pair[1]);
    let solution = contact.solve(Control::Load(0.2)).unwrap();
    assert_eq!(solution.intervals().len(), 2);
    for (of, one) in [Body::Lower, Body::Upper].into_iter().zip(pair) {
        let below = solution.subsurface_of(of).unwrap();
        let places = [[-1.0, 0.2], [0.1, 0.25], [0.9, 0.3], [1.6, 0.15]];
        let expected = stresses(&solution, &one, &places, None);
        let off = most(places.iter().zip(&expected).flat_map(|(&[x, depth], expected)| {
            let found = at(&below, x, depth);
            [0, 1, 2].map(|i| found[i] - expected[i])
        }));
        assert!(off < 1e-10, "{of}: {off:e}");
        // The largest shear is that of a fine grid.
        let largest = below.max_shear().unwrap();
        let rigid = matches!(one.base, Base::Bonded);
        let bottom = if rigid { one.thickness } else { 2.0 };
        let grid = most(
            (0..=200)
                .flat_map(|i| {
                    (0..=60).map(move |j| [0.02 * f64::from(i) - 2.0, bottom * f64::from(j) / 60.0])
                })
                .map(|[x, depth]| below.at(x, depth).unwrap().max_shear()),
        );
        assert!(largest.value >= grid && largest.value < 1.01 * grid, "{largest:?} {grid}");
    }
}

/// Finds the largest stress of a grid that is fine beside the layer.
fn largest_of(range: [f64; 2], depths: [f64; 2], value: impl Fn(f64, f64) -> f64) -> f64 {
    let (columns, rows) = (200, 25);
    let share =
        |[from, to]: [f64; 2], i: usize, of: usize| from + (to - from) * i as f64 / of as f64;
    let places = (0..=columns).flat_map(|i| (0..=rows).map(move |j| (i, j)));
    places.fold(f64::NEG_INFINITY, |most, (i, j)| {
        most.nan_max(value(share(range, i, columns), share(depths, j, rows)))
    })
}

/// The largest stress in the layer, in the base and in both, beside a grid: soft and stiff
/// coatings, thin and thick.
#[test]
fn largest_stresses_of_each_material() {
    let body = parabola(20.0);
    for (modulus, thickness) in
        [(0.1, 0.3), (0.1, 2.0), (2.0, 0.05), (2.0, 0.3), (2.0, 2.0), (100.0, 0.1), (100.0, 1.0)]
    {
        let one = layer(modulus, 0.25, thickness, half_plane(1.0, 0.3));
        let solution = coated(&body, one, RIGID).solve(Control::HalfWidth(1.0)).unwrap();
        let below = || solution.subsurface_of(Body::Lower).unwrap();
        let (field, far) = (below(), 3.0f64.max(20.0 * thickness));
        let shear = |x: f64, depth: f64| field.at(x, depth).unwrap().max_shear();
        let ends = [[0.0, thickness], [beyond(thickness), thickness + 3.0f64.max(2.0 * thickness)]];
        let mut largest = 0.0f64;
        for depths in ends {
            let grid =
                largest_of([0.0, 1.5], depths, shear).max(largest_of([1.5, far], depths, shear));
            let within = below().within([depths[0].min(thickness), depths[1]]).unwrap();
            let found = within.max_shear().unwrap();
            assert!(found.value >= grid && found.value < 1.02 * grid, "{one:?}: {found:?} {grid}");
            assert!(found.depth >= depths[0] && found.depth <= depths[1]);
            largest = largest.max(found.value);
        }
        let off = below().max_shear().unwrap().value / largest - 1.0;
        assert!(off.abs() < 1e-14, "{one:?}: {off:e}");
        let grid = (0..=4000).map(|i| far * f64::from(i) / 4000.0);
        let grid = grid.map(|x| field.at(x, 0.0).unwrap().sigma_x).fold(0.0, f64::max);
        let tension = field.max_tension().unwrap().value;
        assert!(
            tension >= grid * (1.0 - 1e-12) && tension <= 1.01 * grid + 1e-15,
            "{one:?}: {tension} {grid}"
        );
    }
}

/// A stiff plate on a soft base bends: σ_x changes its sign over the thickness.
#[test]
fn a_stiff_coating_bends() {
    let body = parabola(20.0);
    let one = layer(1000.0, 0.25, 0.2, half_plane(1.0, 0.3));
    let solution = coated(&body, one, RIGID).solve(Control::HalfWidth(0.3)).unwrap();
    let below = solution.subsurface_of(Body::Lower).unwrap();
    let [top, bottom] = [0.0, 0.2].map(|depth| below.at(0.0, depth).unwrap().sigma_x);
    assert!(top < 0.0 && bottom > 0.0 && (top + bottom).abs() < 0.3 * bottom, "{top} {bottom}");
    // Forces in balance: the moment of half of the plate is that of the pressures on it.
    let tension = below.max_tension().unwrap();
    assert!(tension.x.abs() > 0.3 && tension.value > 0.0, "{tension:?}");
}

#[test]
fn what_is_not_known_is_refused() {
    let body = parabola(6.0);
    let coating = layer(1.0, 0.3, 0.5, Base::Bonded);
    let contact = coated(&body, coating, Material::elastic(2.0, 0.3));
    let solution = contact.solve(Control::Load(0.5)).unwrap();
    let quantity = |error: ContactError<f64>| match error {
        ContactError::Evaluation(EvaluationError::HalfPlanesOnly { quantity }) => quantity,
        other => panic!("{other}"),
    };
    let both = quantity(solution.subsurface().map(|_| ()).unwrap_err());
    assert!(both.contains("both bodies"), "{both}");
    let below = |of: Body| solution.subsurface_of(of).unwrap();
    for of in [Body::Lower, Body::Upper] {
        assert!(below(of).friction(0.0).is_ok());
        let why = quantity(below(of).friction(0.1).map(|_| ()).unwrap_err());
        assert!(why.contains("friction"), "{why}");
    }
    let depths = |error: ContactError<f64>| match error {
        ContactError::Evaluation(EvaluationError::NoStress { depths }) => depths,
        other => panic!("{other}"),
    };
    assert_eq!(depths(below(Body::Lower).at(0.0, 0.6).unwrap_err()), [0.6; 2]);
    for given in [[0.5, 1.0], [-0.1, 0.2], [0.2, 0.2], [0.2, f64::NAN]] {
        let error = below(Body::Lower).within(given).map(|_| ()).unwrap_err();
        let found = depths(error);
        assert!(found[0] == given[0] && (found[1] == given[1] || given[1].is_nan()));
    }
    // The half-plane beside it has the stress of half-planes under the same pressure.
    let upper = below(Body::Upper);
    let pressure = solution.pressure().unwrap();
    let loads = (0..400).map(|i| {
        let x = solution.hull().at_angle(PI * (f64::from(i) + 0.5) / 400.0);
        let strength = pressure.at(x).unwrap() * solution.hull().chebyshev_weight(x);
        (x, strength * PI / 400.0)
    });
    let expected: f64 = loads
        .map(|(s, load)| {
            let (x, y) = (0.3 - s, 0.4f64);
            -2.0 / PI * load * y * x * x / (x * x + y * y).powi(2)
        })
        .sum();
    assert!((at(&upper, 0.3, 0.4)[0] - expected).abs() < 1e-14);
    // Another compliance, or a kernel, is not a body below the surface.
    let own = Contact::new(&Flat, &*body).unwrap();
    let own = own.contact_modulus(1.0).compliance(super::own_compliance());
    let solution = own.solve(Control::Load(0.2)).unwrap();
    for of in [Body::Lower, Body::Upper] {
        quantity(solution.subsurface_of(of).map(|_| ()).unwrap_err());
    }
}

/// Below a punch, whose pressure is infinite at its corners, and a wedge, where it goes like a
/// logarithm.
#[test]
fn corners_and_kinks() {
    let coating = layer(1.0, 0.3, 0.4, half_plane(3.0, 0.2));
    let flat = graph(-1.0, 1.0, |_| [0.0, 0.0]);
    let punch = coated(&flat, coating, RIGID).edges(Edge::Fixed(-1.0), Edge::Fixed(1.0));
    let punch = punch.solve(Control::Load(1.0)).unwrap();
    let below = punch.subsurface_of(Body::Lower).unwrap();
    let places = [[0.0, 0.2], [0.99, 0.4], [-1.2, 0.3], [0.5, 0.9]];
    let expected = stresses(&punch, &coating, &places, None);
    let off = most(places.iter().zip(&expected).flat_map(|(&[x, depth], expected)| {
        let found = at(&below, x, depth);
        [0, 1, 2].map(|i| found[i] - expected[i])
    }));
    assert!(off < 1e-10, "{off:e}");
    for error in [below.at(1.0, 0.0).unwrap_err(), below.max_shear().unwrap_err()] {
        let is_typed = matches!(error, ContactError::Evaluation(EvaluationError::Singular { .. }));
        assert!(is_typed, "{error}");
    }
    let base = below.within([0.4, f64::INFINITY]).unwrap();
    assert!(matches!(base.max_shear(), Ok(peak) if peak.depth >= 0.4 && peak.value > 0.1));

    let side = |from: f64, to: f64, slope: f64| graph(from, to, move |x| [slope * x, slope]);
    let wedge = join(vec![side(-3.0, 0.0, -0.3), side(0.0, 3.0, 0.3)]);
    let wedge = coated(&wedge, coating, RIGID).solve(Control::Load(0.4)).unwrap();
    let below = wedge.subsurface_of(Body::Lower).unwrap();
    for x in [0.0, 1e-3, 0.1, 0.9] {
        let [one, other] = [0.4, beyond(0.4)].map(|depth| at(&below, x, depth));
        let off = most([one[1] - other[1], one[2] - other[2]]);
        assert!(off < 1e-13, "{x}: {off:e}");
    }
}

/// Below a period, plain bodies and bodies with layers: one to several contacts.
#[test]
fn stress_below_a_period() {
    let body = waves(0.1, &[[0.02, 3.0, 0.0], [0.012, 1.0, 0.4]]);
    let none = layer(2.0, 0.25, 0.2, half_plane(2.0, 0.25));
    let pair = [layer(1.0, 0.3, 0.1, half_plane(0.3, 0.4)), layer(3.0, 0.4, 0.3, Base::Bonded)];
    let slip = layer(1.0, 0.2, 0.15, Base::Frictionless);
    let plain = Material::elastic(2.0, 0.25);
    type Case = ([Foundation<f64>; 2], [Layer<f64>; 2]);
    let cases: [Case; 3] = [
        ([plain.into(), RIGID.into()], [none; 2]),
        ([pair[0].into(), pair[1].into()], pair),
        ([slip.into(), plain.into()], [slip, none]),
    ];
    for ([lower, upper], oracle) in cases {
        let contact = coated(&body, lower, upper).period(PERIOD);
        for load in [1e-3, 0.03] {
            let solution = contact.solve(Control::Load(load)).unwrap();
            let peak = solution.peak().unwrap().pressure;
            for (of, one) in [Body::Lower, Body::Upper].into_iter().zip(oracle) {
                let mut places = vec![[0.9, 0.03], [1.3, 0.07], [0.6, 0.05], [1.25, 0.1]];
                if let Base::HalfPlane(_) = one.base {
                    places.extend([[1.9, 0.31], [0.88, 0.7], [1.0, 3.0], [1.0, 9.0]]);
                }
                let below = solution.subsurface_of(of).unwrap();
                let expected = stresses(&solution, &one, &places, Some(PERIOD));
                let off = most(places.iter().zip(&expected).flat_map(|(&[x, depth], expected)| {
                    let found = at(&below, x, depth);
                    let next = at(&below, x - 3.0 * PERIOD, depth);
                    [0, 1, 2].map(|i| {
                        (found[i] - expected[i]).abs().nan_max(1e2 * (next[i] - found[i]).abs())
                            / peak
                    })
                }));
                assert!(off < 1e-9, "{of} {load} {one:?}: {off:e}");
                // The surface bears the pressure, next to the surface as on it.
                for x in [0.88, 1.29, 0.5, 1.29 + PERIOD] {
                    let pressure = solution.pressure().unwrap().at(x).unwrap_or(0.0);
                    let (on, under) = (at(&below, x, 0.0), at(&below, x, 1e-13));
                    let off = most(
                        [0, 1, 2].map(|i| on[i] - under[i]).into_iter().chain([on[1] + pressure]),
                    );
                    assert!(off < 1e-10 * peak, "{x}: {off:e}");
                }
            }
        }
    }
}

/// The place of the largest stress lies in the period at hand, as each contact does, wherever the
/// bodies are described.
#[test]
fn the_largest_stress_lies_in_the_period_at_hand() {
    for from in [0.0, 0.3, 0.9] {
        let body = waves(from, &[[0.01, 1.0, 0.0], [0.003, 2.0, 0.0]]);
        let contact = row(&body);
        for load in [1e-3, 0.01, 0.02, 0.023] {
            let solution = contact.solve(Control::Load(load)).unwrap();
            let below = solution.subsurface().unwrap();
            let peak = below.max_shear().unwrap();
            let aside = (peak.x - solution.hull().centre()).abs();
            assert!(aside <= 0.5 * PERIOD, "{from} {load}: {peak:?}");
            let there = below.at(peak.x, peak.depth).unwrap().max_shear();
            assert!((there / peak.value - 1.0).abs() < 1e-12);
        }
    }
}

/// Friction below a period: on the surface `σ_x = -P - 2μ κ g/π`.
#[test]
fn friction_below_a_period() {
    let body = waves(0.1, &[[0.02, 1.0, 0.0]]);
    let solution = row(&body).solve(Control::Load(0.03)).unwrap();
    let below = solution.subsurface().unwrap().friction(0.3).unwrap();
    let [on] = *solution.intervals() else { panic!() };
    for share in [-0.9, 0.1, 0.6] {
        let x = on.centre() + share * on.half_width();
        let pressure = solution.pressure().unwrap().at(x).unwrap();
        let slope = 0.02 * TAU / PERIOD * (TAU * x / PERIOD).sin();
        for (depth, allowed) in [(0.0, 1e-14), (1e-12, 1e-9)] {
            let [along, normal, shear] = at(&below, x + PERIOD, depth);
            let off =
                most([along + pressure + 0.3 * slope, normal + pressure, shear + 0.3 * pressure]);
            assert!(off < allowed, "{x} {depth}: {off:e}");
        }
    }
    // Far below, the mean of all.
    let mean = -0.03 / PERIOD;
    let off =
        most(at(&below, 0.3, 40.0).into_iter().zip([mean, mean, 0.3 * mean]).map(|(a, b)| a - b));
    assert!(off < 1e-15, "{off:e}");
    // One contact far from the next ones is Hertz's.
    let narrow = row(&body).solve(Control::HalfWidth(1e-4 * PERIOD)).unwrap();
    let shear = narrow.subsurface().unwrap().max_shear().unwrap();
    let share = shear.value / narrow.peak().unwrap().pressure;
    assert!((share - 0.300_283_1).abs() < 1e-6, "{share}");
    assert!((shear.depth / narrow.a().min(1e-4 * PERIOD) - 0.786).abs() < 1e-2, "{shear:?}");
}
