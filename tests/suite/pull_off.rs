//! Adhesive contacts under a pull, down to pull-off and beyond it.
#![allow(missing_docs)]

use crate::edges::Quadratic;
use crate::forms::KAPPA;

use approx::{assert_abs_diff_eq, assert_relative_eq};
use linecontact::{Contact, ContactError, Control, Edge, Flat, SolveError, Solver};

/// Parabola with its pull-off load. dF/dL = 0: with two adhesive edges L³ = R² w/κ, with one L³ =
/// R² w/(4 κ); F = -3 κ L²/(2 R).
struct PullOff {
    edges: [Edge<f64>; 2],
    share: f64,
}

impl PullOff {
    const WORK: f64 = 2e-4;
    const RADIUS: f64 = 0.8;

    fn cases() -> [Self; 3] {
        let (adhesive, free) = (Edge::Adhesive(Self::WORK), Edge::Free);
        [([adhesive; 2], 1.0), ([adhesive, free], 0.25), ([free, adhesive], 0.25)]
            .map(|(edges, share)| Self { edges, share })
    }

    fn half_width(&self) -> f64 {
        (self.share * Self::RADIUS * Self::RADIUS * Self::WORK / KAPPA).cbrt()
    }

    fn load(&self) -> f64 {
        -1.5 * KAPPA * self.half_width().powi(2) / Self::RADIUS
    }

    /// Returns the half-width under a part of the pull-off load.
    fn under(&self, part: f64) -> Result<f64, ContactError<f64>> {
        let body = Quadratic([0.0, 1.0 / Self::RADIUS, 0.0]).body(-2.0, 2.0);
        let [left, right] = self.edges;
        let contact = Contact::new(&Flat, &*body)?.kappa(KAPPA).edges(left, right);
        Ok(contact.solve(Control::Load(part * self.load()))?.hull().half_width())
    }

    fn check(&self, part: f64) {
        let half_width =
            self.under(part).unwrap_or_else(|e| panic!("{:?} {part}: {e}", self.edges));
        let least = self.half_width();
        assert!(half_width > least, "the branch that grows with the load: {half_width} {least}");
        let pull = 2.0 * (self.share * KAPPA * Self::WORK * half_width).sqrt();
        let load = KAPPA * half_width * half_width / (2.0 * Self::RADIUS) - pull;
        assert_abs_diff_eq!(load, part * self.load(), epsilon = 1e-14 * self.load().abs());
    }
}

#[test]
fn adhesion_bears_a_pull_down_to_pull_off() {
    for case in PullOff::cases() {
        // At 0.84 of the load a free edge passes x = 0, the lowest point of the body.
        for part in [0.0, 0.5, 0.83, 0.85, 0.9, 0.99, 0.9999] {
            case.check(part);
        }
    }
    PullOff::cases()[0].check(0.999999);
}

#[test]
fn beyond_pull_off_the_error_says_so() {
    for case in PullOff::cases() {
        for part in [1.0001, 1.01, 2.0, 100.0, 1e6] {
            let error = case.under(part).unwrap_err();
            let ContactError::Solve(SolveError::PullOff { load, least }) = error else {
                panic!("{:?} {part}: {error}", case.edges)
            };
            assert_relative_eq!(load, part * case.load(), epsilon = 0.0, max_relative = 1e-15);
            // `least` is the load of a contact that was found: not beyond pull-off.
            assert!(least >= case.load() * (1.0 + 1e-9), "{least}");
            // It is close to pull-off, as the message needs.
            assert!(least <= case.load() * (1.0 - 2e-3), "{least}");
        }
    }
}

#[test]
fn a_pull_may_fit_bodies_too_short_for_no_load() {
    // F = κ L²/2 - 2 sqrt(κ w L) on bodies from -1 to 1, least at L³ = w/κ.
    let body = Quadratic([0.0, 1.0, 0.0]).body(-1.0, 1.0);
    let contact = Contact::new(&Flat, &*body).unwrap().kappa(KAPPA);
    for narrowest in [0.5, 0.8, 0.95] {
        let work = KAPPA * f64::powi(narrowest, 3);
        let load = |l: f64| KAPPA * l * l / 2.0 - 2.0 * (KAPPA * work * l).sqrt();
        let glued = contact.clone().edges(Edge::Adhesive(work), Edge::Adhesive(work));
        let solve = |load| Ok(glued.solve(Control::Load(load))?.a());
        for part in [0.1, 0.3, 0.6, 0.9, 0.99] {
            let l = narrowest + part * (1.0 - narrowest);
            let found = solve(load(l)).unwrap_or_else(|e| panic!("{narrowest} {l}: {e}"));
            // Near pull-off the load determines the width to fewer digits.
            let doubt = 1e-13 + 4.0 * f64::EPSILON * load(l).abs() / (l - narrowest).powi(2);
            assert_relative_eq!(found, l, epsilon = 0.0, max_relative = doubt);
        }
        for wanted in [0.0, 0.5 * load(1.0), load(1.001)] {
            let error: ContactError<f64> = solve(wanted).unwrap_err();
            let ContactError::Solve(SolveError::DomainTooShort {
                carried, load: asked, end, ..
            }) = error
            else {
                panic!("{error}")
            };
            assert_eq!((asked, end.abs()), (wanted, 1.0));
            assert_relative_eq!(carried, load(1.0), epsilon = 0.0, max_relative = 1e-13);
        }
        for part in [1.001, 3.0, 1e3] {
            let pull_off = load(narrowest);
            let error: ContactError<f64> = solve(part * pull_off).unwrap_err();
            let ContactError::Solve(SolveError::PullOff { least, .. }) = error else {
                panic!("{error}")
            };
            assert!(least > pull_off && least <= pull_off * (1.0 - 2e-3), "{least} {pull_off}");
        }
    }
    // Wider than the bodies even at pull-off.
    let glued = contact.edges(Edge::Adhesive(2.0 * KAPPA), Edge::Adhesive(2.0 * KAPPA));
    for load in [-1.0, -2.0, -10.0] {
        let error = glued.solve(Control::Load(load)).unwrap_err();
        assert!(matches!(error, ContactError::Solve(SolveError::DomainTooShort { .. })), "{error}");
    }
}

#[test]
fn a_pull_at_one_edge_may_fit_bodies_too_short_for_no_load() {
    // F = κ L²/2 - sqrt(κ w L), c = -sqrt(w/(κ L)); zero load at L³ = 4 w/κ, the least load at a
    // sixteenth of it.
    let (work, none) = (0.03, (4.0f64 * 0.03 / KAPPA).cbrt());
    let centre = |l: f64| -(work / (KAPPA * l)).sqrt();
    let end = centre(none) - 0.99 * none;
    let glued = (Edge::Adhesive(work), Edge::Free);
    let body = Quadratic([0.0, 1.0, 0.0]).body(end, 2.0);
    let contact = Contact::new(&Flat, &*body).unwrap().kappa(KAPPA).edges(glued.0, glued.1);
    assert!(contact.solve(Control::Load(0.0)).is_err());
    for part in [0.95, 0.8, 0.6, 0.5] {
        let l = part * none;
        let load = KAPPA * l * l / 2.0 - (KAPPA * work * l).sqrt();
        let solution = contact.solve(Control::Load(load)).unwrap_or_else(|e| panic!("{part}: {e}"));
        let on = solution.hull();
        assert_relative_eq!(on.left, centre(l) - l, epsilon = 0.0, max_relative = 1e-12);
        assert_relative_eq!(on.right, centre(l) + l, epsilon = 0.0, max_relative = 1e-12);
    }
}

#[test]
fn a_pull_too_far_is_the_same_error_after_a_contact() {
    let case = &PullOff::cases()[0];
    let body = Quadratic([0.0, 1.0 / PullOff::RADIUS, 0.0]).body(-2.0, 2.0);
    let [left, right] = case.edges;
    let contact = Contact::new(&Flat, &*body).unwrap().kappa(KAPPA).edges(left, right);
    let mut solver = Solver::new();
    solver.solve(&contact, Control::Load(0.5 * case.load())).unwrap();
    let error = solver.solve(&contact, Control::Load(1.5 * case.load())).unwrap_err();
    let ContactError::Solve(SolveError::PullOff { least, .. }) = error else { panic!("{error}") };
    assert!(least > case.load() && least <= case.load() * (1.0 - 2e-3), "{least}");
}
