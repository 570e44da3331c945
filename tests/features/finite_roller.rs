//! Rollers of finite length: the lamina model of ISO/TS 16281 from a table in a file, states in
//! files, and derivatives by dual numbers.

use linecontact::autodiff::num_dual::Dual64;
use linecontact::profile::{Crowning, Ellipse};
use linecontact::{
    Contact, FiniteRoller, Flat, Material, PlaneState, Real, Reference, References, RollerState,
    SpringTable,
};

/// Diameter and length in mm.
const SIZES: [f64; 2] = [12.0, 15.0];

fn relief<T: Real>(share: f64) -> Crowning<T> {
    let end = T::of(0.5 * SIZES[1]);
    Crowning::new(T::of(share * SIZES[0]), end, [-end, end]).unwrap()
}

/// Returns a point of the law of ISO/TS 16281 as a point of a table: the load per unit length, and
/// exponents of load, width and peak.
fn iso(approach: f64) -> String {
    let load = 35_948.0 * SIZES[1].powf(-1.0 / 9.0) * approach.powf(10.0 / 9.0);
    let stiffness = 10.0 / 9.0 * load / approach;
    format!(
        r#"{{"approach": {approach:e}, "load": {load:e}, "stiffness": {stiffness:e}, "half_contact": 0.1,
            "peak": 1e3, "exponents": [{:e}, 0.0, 0.0]}}"#,
        10.0 / 9.0
    )
}

fn law(points: [String; 2]) -> Result<SpringTable<f64>, serde_json::Error> {
    let [first, last] = points;
    serde_json::from_str(&format!(
        r#"{{"points": [{first}, {last}], "error": 0.0, "stiffness_error": 0.0, "touch_error": 0.0}}"#
    ))
}

/// Sums the slices of ISO/TS 16281 with its sign of ψ and twice the relief, for both raceways.
fn laminae(approach: f64, misalignment: f64, n: u32) -> [f64; 2] {
    let [diameter, length] = SIZES;
    let constant = 35_948.0 * length.powf(8.0 / 9.0) / f64::from(n);
    let mut sums = [0.0; 2];
    for k in 0..n {
        let x = length * ((f64::from(k) + 0.5) / f64::from(n) - 0.5);
        let profile = 0.00035 * diameter * (1.0 / (1.0 - (2.0 * x / length).powi(2))).ln();
        let by = (approach - misalignment.tan() * x - 2.0 * profile).max(0.0);
        let load = constant * by.powf(10.0 / 9.0);
        sums = [sums[0] + load, sums[1] + load * x];
    }
    sums
}

#[test]
fn with_the_law_of_iso_16281_it_is_its_lamina_model() {
    let table = law([iso(1e-3), iso(0.1)]).unwrap();
    let roller = FiniteRoller::new(table, SIZES[1], 30, &relief(0.0007)).unwrap();
    for (approach, angle) in [(0.02, 0.0), (0.02, 1e-3), (0.03, -2e-3), (0.005, 4e-3)] {
        let [load, moment] = laminae(approach, -angle, 30);
        let state = roller.at(approach, angle.tan()).unwrap();
        assert!((state.load / load - 1.0).abs() < 1e-12, "{approach} {angle}");
        assert!((state.moment - moment).abs() < 1e-12 * load * SIZES[1], "{approach} {angle}");
        let kept: RollerState<f64> =
            serde_json::from_str(&serde_json::to_string(&state).unwrap()).unwrap();
        assert_eq!(kept, state);
    }
}

#[test]
fn a_table_in_which_the_load_falls_is_refused() {
    let falling = iso(1e-3).replace(&format!("[{:e}", 10.0 / 9.0), "[-1.0");
    assert!(law([falling, iso(0.1)]).unwrap_err().to_string().contains("rising approach and load"));
}

#[test]
fn load_and_moment_have_the_derivatives_of_the_stiffness() {
    let circle = Ellipse::circle(Dual64::from_re(6.0), [-1.0, 1.0].map(Dual64::from_re)).unwrap();
    let steel = Material::elastic(Dual64::from_re(206e3), Dual64::from_re(0.3));
    let contact = Contact::new(&Flat, &circle).unwrap().materials(steel, steel, PlaneState::Strain);
    let [radius, length] = [6.0, 15.0].map(Dual64::from_re);
    let (lower, upper) = (Reference::Length(length), Reference::Disc(radius));
    let to = References { x: Dual64::from_re(0.0), lower, upper };
    let loads = [0.1, 2000.0].map(Dual64::from_re);
    let table = SpringTable::new(&contact, &to, loads, Dual64::from_re(1e-4)).unwrap();
    let roller = FiniteRoller::new(table.clone(), length, 30, &relief(0.00035)).unwrap();
    for (load, moment) in [
        ([6e3, 0.0], [0.0, 1.0]),
        ([6e3, 1.0], [5e3, 0.0]),
        ([6e3, 0.0], [5e3, 1.0]),
        ([800.0, 0.3], [4e3, 2.0]),
    ] {
        let [load, moment] = [load, moment].map(|[value, rate]| Dual64::new(value, rate));
        let state = roller.under_moment(load, moment).unwrap();
        let [first, second] = state.stiffness;
        let by = [state.approach.eps, state.misalignment.eps];
        let rates = [first, second].map(|row| row[0].re * by[0] + row[1].re * by[1]);
        assert!((rates[0] - load.eps).abs() < 1e-9, "{rates:?}");
        assert!((rates[1] - moment.eps).abs() < 1e-8, "{rates:?}");

        let misalignment = Dual64::new(state.misalignment.re, 1e-3);
        let state = roller.under_load(load, misalignment).unwrap();
        let [direct, coupling] = state.stiffness[0].map(|stiffness| stiffness.re);
        let rate = direct * state.approach.eps + coupling * 1e-3;
        assert!((rate - load.eps).abs() < 1e-9 * direct, "{rate}");
    }
    // The search starts at the approach of a single slice.
    let one = FiniteRoller::new(table, length, 1, &Flat).unwrap();
    let state = one.under_load(Dual64::new(6e3, 1.0), Dual64::from_re(0.0)).unwrap();
    assert!((state.stiffness[0][0].re * state.approach.eps - 1.0).abs() < 1e-9, "{state:?}");
}
