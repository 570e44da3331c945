//! Evaluations of the default solve, as stated in docs/speed.md.
#![allow(missing_docs)]

use crate::common::speed_scenes::{SCENES, Scene, scene};
use linecontact::{
    Contact, Control, Convexity, CurvePoint, Material, ParametricProfile, PlaneState, Reference,
    References, Solver,
};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

/// Columns of evaluations, heights, and both at the next load.
const COUNTS: [usize; 3] = [3, 4, 7];

/// Solves a scene and then the next load, and returns the evaluations of the first, its heights,
/// and both together at the next load.
pub fn evaluations(name: &str) -> [usize; 3] {
    let Scene { lower, upper, load } = scene(name);
    let contact = Contact::new(&*lower, &*upper).unwrap();
    let cold = contact.solve(Control::Load(load)).unwrap().cost();
    let mut solver = Solver::new();
    solver.solve(&contact, Control::Load(load)).unwrap();
    let next = solver.solve(&contact, Control::Load(1.02 * load)).unwrap().cost();
    [cold.evaluations, cold.heights, next.evaluations + next.heights]
}

/// `cargo bench --bench default` prints the table.
#[test]
fn counts_are_those_of_the_table_of_times() {
    let text = include_str!("../../docs/speed.md");
    for name in SCENES {
        let line = text.lines().find(|line| line.starts_with(&format!("|{name}|")));
        let cells: Vec<&str> = line.unwrap().trim_matches('|').split('|').collect();
        let kept = COUNTS.map(|column| cells[column].parse::<usize>().unwrap());
        assert_eq!(kept, evaluations(name), "{name}: run `cargo bench --bench default`");
    }
}

/// Calls of the curves are what a solve from Python costs.
#[test]
fn a_curve_is_called_a_few_times_for_many_points() {
    let most = [("parabola", 5), ("circle", 4), ("example3", 13), ("wave", 12)];
    for (name, calls) in most {
        let Scene { lower, upper, load } = scene(name);
        let [lower, upper] = [lower, upper].map(|body| Called { body, calls: AtomicUsize::new(0) });
        let count = || [&lower, &upper].map(|body| body.calls.load(Relaxed)).iter().sum::<usize>();
        let contact = Contact::new(&lower, &upper).unwrap();
        let mut solver = Solver::new();
        solver.solve(&contact, Control::Load(load)).unwrap();
        let cold = count();
        solver.solve(&contact, Control::Load(1.02 * load)).unwrap();
        // A flat is a body, too, whose ends are asked for.
        let flat = usize::from(name != "example3");
        assert!(cold <= calls + flat && count() == cold, "{name}: {cold}, then {}", count());
    }
}

/// A body that counts its calls, of one point or of many.
struct Called {
    body: Box<dyn ParametricProfile<f64>>,
    calls: AtomicUsize,
}

impl ParametricProfile<f64> for Called {
    fn domain(&self) -> [f64; 2] {
        self.body.domain()
    }
    fn at(&self, k: f64) -> CurvePoint<f64> {
        self.calls.fetch_add(1, Relaxed);
        self.body.at(k)
    }
    fn at_many(&self, k: &[f64], points: &mut [CurvePoint<f64>]) {
        self.calls.fetch_add(1, Relaxed);
        self.body.at_many(k, points);
    }
    fn slope_at(&self, x: f64) -> Option<f64> {
        self.body.slope_at(x)
    }
    fn convexity(&self) -> Convexity {
        self.body.convexity()
    }
}

/// Returns the evaluations of a solve by approach, and of a certificate.
pub fn answers(name: &str) -> [usize; 2] {
    let Scene { lower, upper, load } = scene(name);
    let steel = Material::elastic(2.0, 0.3);
    let contact = Contact::new(&*lower, &*upper).unwrap();
    let contact = contact.materials(steel, steel, PlaneState::Strain);
    let solution = contact.solve(Control::Load(load)).unwrap();
    let depth = Reference::Depth(20.0 * solution.hull().half_width());
    let references = References { x: solution.hull().centre(), lower: depth, upper: depth };
    let approach = solution.approach(&references).unwrap().bodies;
    let by_approach = contact.solve(Control::Approach { approach, references }).unwrap().cost();
    let certificate = solution.certify().unwrap().cost;
    [by_approach, certificate].map(|cost| cost.evaluations.max(cost.samples) + cost.heights)
}

/// `cargo bench --bench questions` prints the table.
#[test]
fn counts_are_those_of_the_table_of_questions() {
    let text =
        include_str!("../../docs/speed.md").split("## Questions to a solution").nth(1).unwrap();
    for name in SCENES {
        let line = text.lines().find(|line| line.starts_with(&format!("|{name}|")));
        let cells: Vec<&str> = line.unwrap().trim_matches('|').split('|').collect();
        let kept = [5, 7].map(|column| cells[column].parse::<usize>().unwrap());
        assert_eq!(kept, answers(name), "{name}: run `cargo bench --bench questions`");
    }
}

/// `benches/instructions.sh` prints the counts.
#[test]
fn instructions_are_those_kept() {
    let kept = include_str!("../../benches/instructions.tsv");
    let counts = |first: &[&str], columns: &[usize]| {
        let row = kept.lines().find(|line| line.starts_with(&first.join("\t"))).unwrap();
        let cells: Vec<&str> = row.split('\t').collect();
        let thousands = |&column: &usize| match cells[column].parse::<f64>().unwrap() / 1e3 {
            count if count < 10.0 => format!("{count:.1}"),
            count if count < 1e3 => format!("{count:.0}"),
            count => grouped(count.round() as u64),
        };
        columns.iter().map(thousands).collect::<Vec<_>>()
    };
    let text = include_str!("../../docs/speed.md");
    for scalar in ["f64", "f32"] {
        let row =
            format!("|`{scalar}`|{}|", counts(&[scalar, "1", ""], &[2, 3, 4, 7, 8, 9]).join("|"));
        assert!(text.contains(&row), "{row}");
    }
    let several = include_str!("../../docs/several_contacts.md");
    for (scene, name, contacts) in [
        ("word", "circle, convexity declared", 1),
        ("one", "circle, convexity unknown", 1),
        ("two", "quartic", 2),
        ("ten", "polynomial map", 10),
        ("rough", "measured profile", 86),
    ] {
        let row = format!("|{name}|{contacts}|{}|", counts(&[scene, ""], &[1, 2]).join("|"));
        assert!(several.contains(&row), "{row}");
    }
    let unknown = format!("(of unknown shape: {} for", counts(&["one", ""], &[1, 2]).join(" and "));
    assert!(text.contains(&unknown), "{unknown}");
    // Cold, and the next load.
    let [circle, layer] = ["circle\t", "layer1\t"].map(|scene| {
        let row = kept.lines().find(|line| line.starts_with(scene)).unwrap();
        [1, 3].map(|column| row.split('\t').nth(column).unwrap().parse::<f64>().unwrap())
    });
    let [first, next] = [0, 1].map(|i| (layer[i] / circle[i]).round());
    let guide =
        include_str!("../../docs/guide.md").split_whitespace().collect::<Vec<_>>().join(" ");
    let times = format!(
        "takes {first} times the instructions of the circle of half-planes, a next load {next} times"
    );
    assert!(guide.contains(&times), "{times}");
}

/// Groups the digits of a number by thousands.
fn grouped(count: u64) -> String {
    let rest = |before: u64| format!("{} {:03}", grouped(before), count % 1000);
    if count < 1000 { count.to_string() } else { rest(count / 1000) }
}
