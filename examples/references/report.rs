//! Compares the solver's results with the reference, and reports in a line.

use super::boundary_elements::Oracle;
use super::noise::Noise;
use super::reference::{Kind, Point, Reference, Several};
use linecontact::{Cost, Interval};
use std::f64::consts::PI;

/// Largest relative error that passes where the data allow it.
const WANTED: f64 = 1e-12;
/// Factor by which an error may exceed the floor where the floor is higher.
const MARGIN: f64 = 20.0;
/// Unit roundoff.
const ROUNDING: f64 = f64::EPSILON / 2.0;
/// Largest difference from the pressure of the boundary elements that passes, as a share of the
/// peak.
const ELEMENTS: f64 = 0.01;

/// Result of the solver for a file.
pub struct Answer {
    /// Contacts from left to right.
    pub contacts: Vec<Interval<f64>>,
    /// Pressures at the points of the file, or the reason why there is none.
    pub pressures: Vec<Result<f64, String>>,
    /// Cost of the solve.
    pub cost: Cost,
}

/// Result of the comparison for a file.
pub struct Report {
    /// Name of the file.
    pub name: String,
    /// Kind of the file.
    pub kind: String,
    /// True if the file passes.
    pub ok: bool,
    /// Errors of `a` and `b` as shares of the half-width; with several contacts the largest errors
    /// of the right and of the left limits, as shares of the width of each.
    limits: Option<[f64; 2]>,
    /// Largest relative error of a pressure, and the highest floor.
    pressure: Option<[f64; 2]>,
    cost: Option<Cost>,
    /// Further remarks.
    remarks: Vec<String>,
}

impl Report {
    /// Reports a file that ended in an error.
    pub fn of_error(name: &str, kind: String, ok: bool, error: String) -> Self {
        let (name, remarks) = (name.to_owned(), vec![error]);
        Self { name, kind, ok, limits: None, pressure: None, cost: None, remarks }
    }

    /// Reports a file that was solved.
    pub fn of_answer(name: &str, reference: &Reference, answer: &Answer, noise: &Noise) -> Self {
        let mut report = Self {
            name: name.to_owned(),
            kind: reference.kind_name.clone(),
            ok: true,
            limits: None,
            pressure: None,
            cost: Some(answer.cost),
            remarks: Vec::new(),
        };
        let [got] = answer.contacts[..] else {
            report.fail(format!("{} contacts, but one is expected", answer.contacts.len()));
            return report;
        };
        let Some(on) = reference.limits else { return report };
        if reference.kind != Kind::Fixed {
            report.compare_limits(on, got, noise);
        }
        report.compare_pressures(reference, on, &answer.pressures, noise);
        report
    }

    /// Reports a solved file with several contacts, within the tolerances that it gives.
    pub fn of_several(name: &str, reference: &Reference, want: &Several, answer: &Answer) -> Self {
        let mut report = Self::of_error(name, reference.kind_name.clone(), true, String::new());
        report.remarks.clear();
        report.cost = Some(answer.cost);
        if want.contacts.len() == answer.contacts.len() {
            let off = |i: usize, side: fn(Interval<f64>) -> f64| {
                let (want, got) = (want.contacts[i], answer.contacts[i]);
                (side(got) - side(want)).abs() / (want.right - want.left)
            };
            let largest = |side| {
                let all = (0..want.contacts.len()).map(|i| off(i, side));
                all.fold(0.0f64, |most, off| if off <= most { most } else { off })
            };
            let errors = [largest(|on| on.right), largest(|on| on.left)];
            report.limits = Some(errors);
            if !errors.iter().all(|&error| error <= want.of_width) {
                report.fail(format!("limits: allowed {:.1e}", want.of_width));
            }
        } else {
            let [want, got] = [&want.contacts, &answer.contacts].map(Vec::len);
            report.fail(format!("contacts: {got}, but {want} are expected"));
        }
        let largest = reference.points.iter().fold(0.0f64, |most, p| most.max(p.pressure.abs()));
        let mut worst = 0.0;
        for (point, got) in reference.points.iter().zip(&answer.pressures) {
            let off = got.as_ref().map_or(f64::NAN, |p| (p - point.pressure).abs() / largest);
            if off <= worst {
                continue;
            }
            worst = if off.is_nan() { f64::INFINITY } else { off };
            if off.is_nan() || off > want.of_largest {
                let why = got.as_ref().err().map_or(String::new(), |why| format!("; {why}"));
                let allowed = want.of_largest;
                report.fail(format!("P({:?}): off {off:.1e}, allowed {allowed:.1e}{why}", point.x));
            }
        }
        report.pressure = Some([worst, want.of_largest]);
        report
    }

    /// Compares a file that says only that one interval is not enough with boundary elements; the
    /// pressures of `answer` are at the oracle's nodes.
    pub fn of_elements(
        name: &str,
        reference: &Reference,
        answer: &Answer,
        oracle: &Oracle,
        kinks: &[f64],
    ) -> Self {
        let mut report = Self::of_error(name, reference.kind_name.clone(), true, String::new());
        report.remarks.clear();
        report.cost = Some(answer.cost);
        if let Some([x, error]) = oracle.disagreement(&answer.contacts) {
            let known = &oracle.contacts;
            report
                .fail(format!("limit {x:?}: not within {error:.1e}; boundary elements: {known:?}"));
        }
        let at = |x: f64| {
            let node = oracle.x.partition_point(|&node| node < x);
            answer.pressures.get(node).and_then(|p| p.as_ref().ok()).map_or(f64::NAN, |&p| p)
        };
        let [off, x] = oracle.pressure_off(kinks, at);
        report.pressure = Some([off, ELEMENTS]);
        if off.is_nan() || off > ELEMENTS {
            report.fail(format!("P({x:?}): off {off:.1e} of the peak of the boundary elements"));
        }
        report
    }

    /// Adds the result of another comparison of the same file.
    pub fn and(mut self, other: Self) -> Self {
        self.ok &= other.ok;
        self.cost = other.cost;
        self.remarks.extend(other.remarks);
        self
    }

    /// Marks the file as failed, with the reason.
    pub fn fail(&mut self, remark: String) {
        self.ok = false;
        self.remarks.push(remark);
    }

    fn compare_limits(&mut self, want: Interval<f64>, got: Interval<f64>, noise: &Noise) {
        let half_width = want.half_width();
        let errors = [got.right - want.right, got.left - want.left].map(|e| e.abs() / half_width);
        self.limits = Some(errors);
        let farthest = want.left.abs().max(want.right.abs());
        let floor = (1.0 + farthest / half_width) * ROUNDING + noise.edges;
        let allowed = allowed(floor);
        if !errors.iter().all(|&error| error <= allowed) {
            self.ok = false;
            self.remarks.push(format!("limits: allowed {allowed:.1e}"));
        }
    }

    fn compare_pressures(
        &mut self,
        reference: &Reference,
        on: Interval<f64>,
        got: &[Result<f64, String>],
        noise: &Noise,
    ) {
        let (mut largest, mut highest, mut worst, mut remark) = (0.0f64, 0.0f64, 1.0, None);
        for (i, (point, got)) in reference.points.iter().zip(got).enumerate() {
            let error = got.as_ref().map_or(f64::INFINITY, |p| (p / point.pressure - 1.0).abs());
            let error = if error.is_nan() { f64::INFINITY } else { error };
            let floor = floor(reference, i, on, noise);
            (largest, highest) = (largest.max(error), highest.max(floor));
            let (allowed, x) = (allowed(floor), point.x);
            // The allowed error may be infinite; an infinite error fails even then.
            let share = if error.is_finite() { error / allowed } else { f64::INFINITY };
            if share > worst {
                worst = share;
                self.ok = false;
                let why = got.as_ref().err().map_or(String::new(), |why| format!("; {why}"));
                remark = Some(format!("P({x:?}): off {error:.1e}, allowed {allowed:.1e}{why}"));
            }
        }
        self.remarks.extend(remark);
        self.pressure = Some([largest, highest]);
    }

    /// Returns the heading of the table.
    pub fn heading() -> String {
        line(
            ["NAME", "KIND", "", "ERR_A", "ERR_B", "ERR_P", "FLOOR_P", "SAMPLES", "EVALUATIONS"]
                .map(str::to_owned),
        )
    }
}

/// Returns the relative error of the pressure at a point that is not the solver's fault: rounding
/// and the uncertainty of the edges, both times the amplification at this point, and the uncertain
/// slope of the gap, of which `P/κ` is a conjugate function divided by π.
fn floor(reference: &Reference, i: usize, on: Interval<f64>, noise: &Noise) -> f64 {
    let Point { x, pressure, amplification } = reference.points[i];
    let unit = reference.kappa / (PI * pressure.abs());
    let rounded = amplification.unwrap_or(1.0) * ROUNDING;
    if reference.kind != Kind::Fixed {
        let edges = amplification.unwrap_or(1.0) * noise.edges;
        return rounded + edges + unit * (noise.slope[i] + noise.mean_slope);
    }
    // Fixed edges: P = (C - κ PV∫ ...)/(π² root). Its terms are of the order of κ |G| L, and the
    // distances from the edges are in the root.
    let share = |edge: f64| (x.abs() + edge.abs()) / (2.0 * (x - edge).abs());
    let edges = (share(on.left) + share(on.right)) * ROUNDING;
    let rise = on.half_width() / on.chebyshev_weight(x);
    let terms = noise.steepest * ROUNDING + noise.mean_slope;
    rounded + edges + unit * (noise.slope[i] + rise * terms)
}

/// Returns the largest error that passes.
fn allowed(floor: f64) -> f64 {
    WANTED.max(MARGIN * floor)
}

impl std::fmt::Display for Report {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let error = |e: Option<f64>| e.map_or("-".to_owned(), |e| format!("{e:.1e}"));
        let count = |n: Option<usize>| n.map_or("-".to_owned(), |n| n.to_string());
        let verdict = if self.ok { "ok" } else { "FAIL" };
        f.write_str(&line([
            self.name.clone(),
            self.kind.clone(),
            verdict.to_owned(),
            error(self.limits.map(|errors| errors[0])),
            error(self.limits.map(|errors| errors[1])),
            error(self.pressure.map(|pressure| pressure[0])),
            error(self.pressure.map(|pressure| pressure[1])),
            count(self.cost.map(|cost| cost.samples)),
            count(self.cost.map(|cost| cost.evaluations)),
        ]))?;
        self.remarks.iter().try_for_each(|remark| write!(f, "\n    {remark}"))
    }
}

fn line([name, kind, verdict, a, b, p, floor, samples, evaluations]: [String; 9]) -> String {
    format!(
        "{name:30} {kind:38} {verdict:4} {a:>7} {b:>7} {p:>7} {floor:>7} {samples:>8} {evaluations:>11}"
    )
}
