//! Each message of an error names the values that it was given, and says what to do.
#![allow(missing_docs)]

use linecontact::profile::SplineError;
use linecontact::search::{Root, SearchError};
use linecontact::{
    Body, ContactError, Edge, Ends, ErrorKind, Interval, PiecewiseError, ProfileError,
};

use ContactError as E;
use ErrorKind::{Evaluation, Input, Solve};

const ON: Interval<f64> = Interval { left: -11.5, right: 12.5 };

/// An error of each kind, whose numbers differ; what else its message has to say; and its kind.
fn contact_errors() -> Vec<(E<f64>, &'static [&'static str], ErrorKind)> {
    let not_finite = ProfileError::NotFinite { quantity: "Y'", k: 21.5, value: f64::NAN };
    let astray = SearchError::NotConverged { x: 22.5, residual: 23.5 };
    let (half_width, load, end, peak) = (31.5, 32.5, 33.5, 34.5);
    let yes = true;
    vec![
        (E::Shape(not_finite), &["Y'", "NaN", "end the domain"], Input),
        (E::Pieces(PiecewiseError::Tolerance { tolerance: -1.5 }), &["-1.5"], Input),
        (E::Points(SplineError::TooFew { points: 33 }), &["four"], Input),
        (E::Cancelled { evaluations: 41, last: ON }, &["cancelled"], Solve),
        (E::Profile { body: Body::Upper, source: not_finite }, &["upper body: Y' is NaN"], Input),
        (
            E::NoCommonRange { lower: [1.5, 2.5], upper: [3.5, 4.5] },
            &["lower covers x = 1.5 to 2.5", "upper 3.5 to 4.5"],
            Input,
        ),
        (E::OutsideBodies { x: 5.5, range: [6.5, 7.5] }, &["only 6.5 to 7.5"], Solve),
        (E::Inversion { body: Body::Lower, x: 8.5, source: astray }, &["lower body"], Solve),
        (
            E::InvalidLoad { quantity: "half-width", value: -9.5 },
            &["-9.5", "half-width", "positive"],
            Input,
        ),
        (E::InvalidModulus { modulus: -9.5 }, &["-9.5", "E*", "positive"], Input),
        (E::InvalidKappa { kappa: -8.5 }, &["κ = -8.5", "π E*/2"], Input),
        (E::InvalidLimits { interval: ON }, &["-b = -11.5", "a = 12.5"], Input),
        (E::InvalidEdgePressure { name: "ε_a", value: -7.5 }, &["ε_a = -7.5"], Input),
        (
            E::NoFirstContact { x: [1.5, 2.5], slope: [3.5, 4.5] },
            &["3.5 at x = 1.5", "widen"],
            Solve,
        ),
        (E::NoFirstContact { x: [1.5, 2.5], slope: [3.5, -4.5] }, &["bulge away", "flip"], Solve),
        (E::NoFirstContact { x: [1.5, 2.5], slope: [0.0; 2] }, &["parallel", "FreeUntil"], Solve),
        (
            E::DomainTooShort { end, carried: 13.5, load, half_width, peak, kappa_is_default: yes },
            &["at x = 33.5", "carry 13.5", "load 32.5", "contact_modulus missing?"],
            Solve,
        ),
        (
            E::HalfWidthTooLarge {
                wanted: 14.5,
                half_width,
                end,
                load,
                peak,
                kappa_is_default: yes,
            },
            &["half-width 14.5", "at x = 33.5", "contact_modulus missing?"],
            Solve,
        ),
        (
            E::EndReached { end, load, kappa_is_default: yes },
            &["FreeUntil(33.5)", "(κ is 1"],
            Solve,
        ),
        (E::NoEquilibrium { half_width, near: 15.5 }, &["near x = 15.5", "give a start"], Solve),
        (E::Overflow { interval: ON }, &["units"], Solve),
        (
            E::BudgetSpent { evaluations: 42, budget: 43, last: ON },
            &["the budget is 43", "breakpoints"],
            Solve,
        ),
        (E::LimitSearch { best: ON, source: astray }, &["-b = -11.5, a = 12.5"], Solve),
        (
            E::EdgePressureNotMet { best: ON, at_a: 16.5, at_b: 17.5 },
            &["A = 16.5", "B = 17.5", "more segments"],
            Solve,
        ),
        (
            E::InvalidSegments { segments: 44, extrapolations: 45 },
            &["44 segments", "45 extrapolations"],
            Input,
        ),
        (E::Singular { x: 18.5 }, &["x = 18.5 is infinite", "edge_singularities"], Evaluation),
        (
            E::InconsistentHeights { between: [1.5, 2.5], by_heights: 3.5, by_slopes: 4.5 },
            &["x = 1.5 to 2.5", "3.5 by the heights", "4.5 by their slopes"],
            Input,
        ),
        (E::FeatureMissed { x: 1.5, slope: 2.5, assumed: 3.5 }, &["x = 1.5 is 2.5"], Solve),
        (E::Unbalanced { x: 1.5, strength: 2.5, allowed: 3.5 }, &["within 3.5"], Solve),
        (E::Undecided { x: 1.5, evaluations: 46, samples: 47 }, &["46 evaluations"], Solve),
        (E::InvalidTolerance { tolerance: -6.5 }, &["-6.5", "below 1"], Input),
        (E::InvalidAdhesion { work: -5.5 }, &["-5.5", "not negative"], Input),
        (E::BothLimitsGiven { interval: ON }, &["-b = -11.5", "the load must be given"], Input),
        (E::InvalidMoment { value: f64::INFINITY }, &["inf", "finite"], Input),
        (E::TiltNotSupported { why: "so it is" }, &["so it is", "Panels"], Input),
        (
            E::TiltNotFound {
                load,
                at: 1.5,
                reached: 2.5,
                tilt: 3.5,
                ends: Ends { left: 4.5, right: 5.5 },
            },
            &["act at x = 1.5", "nearest is x = 2.5", "tilt 3.5", "extend the domain"],
            Solve,
        ),
        (E::PullOff { load: -3.5, least: -2.5 }, &["load -3.5", "down to -2.5"], Solve),
        (E::PeakEdge { edge: Edge::Fixed(1.5) }, &["Fixed(1.5)", "half-width"], Input),
        (
            E::PeakTooHigh {
                wanted: 1.5,
                half_width,
                found: 2.5,
                end,
                load,
                kappa_is_default: yes,
            },
            &["peak pressure 1.5", "x = 33.5", "it is 2.5", "contact_modulus missing?"],
            Solve,
        ),
        (
            E::NoPeak { wanted: 1.5, half_width, found: 2.5 },
            &["peak pressure 1.5", "is 2.5"],
            Solve,
        ),
        (E::AboveSurface { x: 1.5, depth: -2.5 }, &["x = 1.5", "depth -2.5"], Evaluation),
        (
            E::InvalidYoungsModulus { body: Body::Upper, modulus: -1.5 },
            &["upper body", "-1.5", "Rigid"],
            Input,
        ),
        (E::BothRigid, &["Material::Rigid", "elastic"], Input),
        (E::NoMaterials, &["Contact::materials"], Input),
        (E::InvalidReference { length: -1.5 }, &["-1.5", "depth"], Input),
        (
            E::ApproachTooLarge { wanted: 1.5, approach: 2.5, load },
            &["approach of 1.5", "carry 32.5", "approach of 2.5"],
            Solve,
        ),
        (E::ApproachFalls { load, rate: -1.5 }, &["load 32.5", "-1.5", "deeper"], Solve),
        (
            E::OutsideTable { approach: 1.5, range: [2.5, 3.5] },
            &["2.5 to 3.5, not 1.5"],
            Evaluation,
        ),
        (E::InvalidSlipFriction { friction: -1.5 }, &["-1.5", "positive"], Input),
        (E::InvalidShear { quantity: "tension", value: 1.5 }, &["tension = 1.5"], Input),
        (E::SlipsEverywhere { force: 1.5, limit: 2.5 }, &["1.5", "μF = 2.5"], Solve),
        (E::SticksEverywhere { force: 1.5, limit: 2.5 }, &["1.5", "μF = 2.5", "load_rates"], Solve),
        (
            E::ReversedSlip { zone: Interval { left: 1.5, right: 2.5 }, contact: ON },
            &["stick from 1.5 to 2.5", "reverses"],
            Solve,
        ),
        (E::UnlikeBodies { beta: 0.25 }, &["β = 0.25", "like bodies"], Input),
        (E::SlipNotSupported { why: "so it is" }, &["so it is"], Input),
        (E::InvalidPoissonRatio { ratio: 1.5 }, &["0 to 1/2"], Input),
        (E::InvalidFriction { coefficient: f64::NAN }, &["NaN", "finite"], Input),
        (E::InvalidPosition { x: 1.5, inside: true, interval: ON }, &["lie inside"], Evaluation),
        (E::InvalidPosition { x: 1.5, inside: false, interval: ON }, &["lie outside"], Evaluation),
        (E::NoLoadDerivative { why: "so it is" }, &["so it is"], Evaluation),
        (E::EdgePressureLoad, &["load must be given", "edges()"], Input),
        (E::LengthMismatch { x: 48, pressures: 49 }, &["48 abscissae", "49 places"], Evaluation),
        (E::Integral { x: 1.5, panels: 51 }, &["x = 1.5", "51 panels"], Evaluation),
        (E::Unresolved { x: 1.5, pressure: 2.5, error: 3.5 }, &["2.5 with an error"], Evaluation),
    ]
}

/// The numbers that an error shows, without their signs.
fn numbers(shown: &str) -> impl Iterator<Item = &str> {
    let parts = shown.split(|c: char| !c.is_ascii_digit() && c != '.');
    parts.filter(|part| part.len() > 1 && part.parse::<f64>().is_ok())
}

fn assert_says(error: &(impl std::error::Error + Send + Sync + 'static), words: &[&str]) {
    let (fields, message) = (format!("{error:?}"), error.to_string());
    for number in numbers(&fields) {
        assert!(numbers(&message).any(|said| said == number), "{number} of {fields}: {message}");
    }
    for word in words {
        assert!(message.contains(word), "{word}: {message}");
    }
    assert!(message.len() < 400 && !message.contains("  "), "{message}");
}

#[test]
fn the_message_of_a_contact_names_its_values() {
    for (error, words, kind) in contact_errors() {
        assert_says(&error, words);
        assert_eq!(error.kind(), kind, "{error}");
    }
}

/// What solves the equations all the same is for a program, and left to the fields.
#[test]
fn the_message_of_what_is_no_contact_says_where_it_is_none() {
    let (interval, load) = (ON, 1.5);
    for (error, words) in [
        (E::Tension { x: 2.5, pressure: -3.5, interval, load }, ["x = 2.5", "-3.5", "part there"]),
        (E::LiftsOff { x: 2.5, strength: -3.5, interval, load }, ["x = 2.5", "-3.5", "FreeUntil"]),
        (E::Overlap { x: 2.5, gap: -3.5, interval, load }, ["x = 2.5", "by 3.5", "touch there"]),
    ] {
        let message = error.to_string();
        assert!(words.iter().all(|word| message.contains(word)), "{message}");
        assert_eq!(error.kind(), Solve, "{message}");
    }
}

#[test]
fn the_messages_of_bodies_and_searches_name_their_values() {
    let (name, quantity) = ("radius", "X'");
    let not_finite = ProfileError::NotFinite { quantity, k: 1.5, value: f64::NAN };
    for (error, words) in [
        (ProfileError::Parameter { name, value: -1.5, must: "positive" }, "radius is -1.5"),
        (ProfileError::Joined { pieces: 13 }, "Piecewise::placed"),
        (ProfileError::Domain { from: 2.5, to: 1.5 }, "from 2.5 to 1.5"),
        (not_finite, "X' is NaN at k = 1.5"),
        (ProfileError::Derivative { quantity, k: 1.5, given: 2.5, difference: 3.5 }, "X' is 2.5"),
        (ProfileError::TurnsBack { k: 1.5, x: 2.5, domain: [3.5, 4.5] }, "X turns back at k = 1.5"),
        (ProfileError::Pieces { count: 13, index: 12 }, "13"),
    ] {
        assert_says(&error, &[words]);
    }
    for (error, words) in [
        (PiecewiseError::InPiece { piece: 12, source: not_finite }, "piece 12"),
        (PiecewiseError::Tolerance { tolerance: -1.5 }, "-1.5"),
        (PiecewiseError::Gap { breakpoint: 12, left: 1.5, right: 3.75 }, "gap of 2.25"),
        (PiecewiseError::Overlap { breakpoint: 12, left: 3.75, right: 1.5 }, "overlap of 2.25"),
        (PiecewiseError::Jump { breakpoint: 12, x: 4.5, left: 1.5, right: 3.75 }, "jump of 2.25"),
    ] {
        assert_says(&error, &[words]);
    }
    for (error, words) in [
        (SplineError::NotFinite { row: 12, x: 1.5, y: f64::NAN }, "row 12"),
        (SplineError::Duplicate { row: 12, x: 1.5 }, "row 12"),
        (SplineError::Unsorted { row: 12, x: 1.5, before: 2.5 }, "after 2.5"),
    ] {
        assert_says(&error, &[words]);
    }
    let best = Root { x: 1.5, residual: 2.5, bracket: [3.5, 4.5], evaluations: 12 };
    for (error, words) in [
        (SearchError::NotFinite { x: 1.5, value: f64::NAN }, "NaN at 1.5"),
        (SearchError::Budget { best }, "raise max_evaluations"),
        (SearchError::LeftBracket { x: 1.5, lo: 2.5, hi: 3.5 }, "[2.5, 3.5]"),
        (SearchError::NotConverged { x: 1.5, residual: 2.5 }, "still 2.5"),
        (SearchError::Tolerance { value: -1.5 }, "-1.5 is no tolerance"),
    ] {
        assert_says(&error, &[words]);
    }
}
