//! The methods tried on each contact: quadratures on a ladder of settings, and searches.
//!
//! Not every quadrature is tried with every search: the quadratures have the default searches, and
//! the searches, one at a time, have the default quadrature. The paper's rule inverts the curves at
//! each of its points, so the searches that invert are tried with it, too.

use super::scenes::Scene;
use linecontact::quadrature::Quadrature;
use linecontact::search::{LimitSearch, StoppingCriteria, strategies};
use linecontact::{EdgePressure, Exponents, Interval, Midpoint, Panels};
use std::sync::LazyLock;

/// Names of the quadratures.
pub const PANELS: &str = "panels";
pub const METHODS: [&str; 7] = [
    PANELS,
    "right powers ET=4",
    "right powers ET=2",
    "paper ET=2",
    "paper ET=1",
    "paper ET=0",
    "paper ET=2, Eq. (6)",
];

/// Name that stands for a search that is not set.
pub const DEFAULT: &str = "default";

/// Search under its name.
type Named = (&'static str, Box<dyn LimitSearch<f64>>);

static SEARCHES: LazyLock<Vec<Named>> = LazyLock::new(|| strategies(StoppingCriteria::FULL));

/// Returns the names of the searches.
pub fn searches() -> impl Iterator<Item = &'static str> {
    SEARCHES.iter().map(|&(name, _)| name)
}

/// Returns a search by its name; none for the default.
pub fn search(name: &str) -> Option<&'static dyn LimitSearch<f64>> {
    SEARCHES.iter().find(|(of, _)| *of == name).map(|(_, search)| &**search)
}

/// Way to solve a contact.
pub struct Way {
    pub method: &'static str,
    pub setting: String,
    pub inversion: &'static str,
    pub limits: &'static str,
    pub quadrature: Box<dyn Quadrature<f64>>,
    /// Condition of the paper for the limits, in place of free edges.
    pub edge_pressure: Option<EdgePressure<f64>>,
}

fn panels(tolerance: f64) -> Way {
    let setting =
        if tolerance > 0.0 { format!("tol={tolerance:.0e}") } else { "tol=full".to_owned() };
    let quadrature = Box::new(Panels { tolerance });
    let (inversion, limits, edge_pressure) = (DEFAULT, DEFAULT, None);
    Way { method: PANELS, setting, inversion, limits, quadrature, edge_pressure }
}

fn midpoint(method: &'static str, rule: Midpoint) -> Way {
    let setting = format!("N={}", rule.segments);
    let (inversion, limits, edge_pressure) = (DEFAULT, DEFAULT, None);
    Way { method, setting, inversion, limits, quadrature: Box::new(rule), edge_pressure }
}

/// Returns all ways to solve this contact.
pub fn all(scene: &Scene) -> Vec<Way> {
    // The right exponents depend on how the slope of the gap times the root ends.
    let right = if scene.fixed { Exponents::Even } else { Exponents::HalfInteger };
    let mut ways: Vec<Way> = [1e-3, 1e-6, 1e-9, 1e-12, 0.0].map(panels).into();
    for (method, extrapolations, exponents) in [
        ("right powers ET=4", 4, right),
        ("right powers ET=2", 2, right),
        ("paper ET=2", 2, Exponents::Even),
        ("paper ET=1", 1, Exponents::Even),
        ("paper ET=0", 0, Exponents::Even),
    ] {
        let rungs = [16, 64, 256, 1024, 4096];
        let rule = |segments| Midpoint { segments, extrapolations, exponents };
        ways.extend(rungs.map(|segments| midpoint(method, rule(segments))));
    }
    let inversions = searches().flat_map(|inversion| {
        let ways = [panels(1e-3), panels(1e-6), panels(0.0), {
            let rule = Midpoint { exponents: right, ..Midpoint::DEFAULT };
            midpoint("right powers ET=4", rule)
        }];
        ways.map(|way| Way { inversion, ..way })
    });
    ways.extend(inversions);
    if scene.fixed {
        return ways;
    }
    for segments in [64, 256, 1024] {
        // The condition holds one segment inside, as close to the edge as the rule allows.
        let Interval { left, right } = scene.limits;
        let distance = (right - left) / segments as f64;
        let zero = EdgePressure::zero(distance, 1e-6 * scene.mean_pressure());
        let way = midpoint("paper ET=2, Eq. (6)", Midpoint::paper(segments, 2));
        ways.push(Way { edge_pressure: Some(zero), ..way });
    }
    ways.extend(
        searches()
            .flat_map(|limits| [1e-3, 1e-6, 0.0].map(panels).map(|way| Way { limits, ..way })),
    );
    ways
}
