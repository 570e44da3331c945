//! Each error message names the values of the error, and suggests a remedy.
#![allow(missing_docs)]

use linecontact::profile::{Parabola, SplineError};
use linecontact::reference::ReferenceError;
use linecontact::search::{Root, SearchError};
use linecontact::{
    Body, Contact, ContactError, Control, Curve, CurvePoint, Edge, Ends, EvaluationError, Flat,
    InputError, Interval, PiecewiseError, ProfileError, SolveError,
};

const ON: Interval<f64> = Interval { left: -11.5, right: 12.5 };

/// Returns an error of each variant with distinct numbers, further words of its message, and its
/// kind.
fn contact_errors() -> Vec<(ContactError<f64>, &'static [&'static str])> {
    let not_finite = ProfileError::NotFinite { quantity: "Y'", k: 21.5, value: f64::NAN };
    let astray = SearchError::NotConverged { x: 22.5, residual: 23.5 };
    let (half_width, load, end, peak) = (31.5, 32.5, 33.5, 34.5);
    let yes = true;
    vec![
        (ContactError::Input(InputError::Shape(not_finite)), &["Y'", "NaN", "end the domain"]),
        (
            ContactError::Input(InputError::Pieces(PiecewiseError::Tolerance { tolerance: -1.5 })),
            &["-1.5"],
        ),
        (ContactError::Input(InputError::Points(SplineError::TooFew { points: 33 })), &["four"]),
        (
            ContactError::Input(InputError::ClosedForm(ReferenceError::Parameter {
                name: "the clearance",
                value: -1.5,
                must: "positive",
            })),
            &["the clearance is -1.5", "positive"],
        ),
        (ContactError::Solve(SolveError::Cancelled { evaluations: 41, last: ON }), &["cancelled"]),
        (
            ContactError::Input(InputError::Profile { body: Body::Upper, source: not_finite }),
            &["upper body: Y' is NaN"],
        ),
        (
            ContactError::Input(InputError::NoCommonRange { lower: [1.5, 2.5], upper: [3.5, 4.5] }),
            &["lower covers x = 1.5 to 2.5", "upper 3.5 to 4.5", "move one"],
        ),
        (
            ContactError::Solve(SolveError::OutsideBodies { x: 5.5, range: [6.5, 7.5] }),
            &["only 6.5 to 7.5", "extend"],
        ),
        (
            ContactError::Solve(SolveError::Inversion {
                body: Body::Lower,
                x: 8.5,
                source: astray,
            }),
            &["lower body"],
        ),
        (
            ContactError::Input(InputError::InvalidLoad {
                quantity: "half-width",
                value: -9.5,
                must: "positive",
            }),
            &["the half-width is -9.5: it must be finite, and positive"],
        ),
        (
            ContactError::Input(InputError::InvalidModulus { modulus: -9.5 }),
            &["-9.5", "E*", "positive"],
        ),
        (ContactError::Input(InputError::InvalidKappa { kappa: -8.5 }), &["κ = -8.5", "π E*/2"]),
        (
            ContactError::Input(InputError::InvalidThickness {
                body: Body::Upper,
                thickness: -9.5,
            }),
            &["layer of the upper body", "-9.5", "positive and finite"],
        ),
        (
            ContactError::Input(InputError::InvalidPeriod { period: -9.5 }),
            &["period -9.5", "positive and finite"],
        ),
        (
            ContactError::Input(InputError::NotPeriodic {
                body: Body::Upper,
                what: "the height",
                ends: [9.5, 8.5],
            }),
            &["upper body", "the height is 9.5 at its left end and 8.5", "exactly one period"],
        ),
        (
            ContactError::Solve(SolveError::CompleteContact { load: 9.5, complete: 8.5 }),
            &["load is 9.5", "about 8.5", "lower the load"],
        ),
        (
            ContactError::Input(InputError::Kernel {
                what: "its decay must be positive, but c",
                at: -1.5,
            }),
            &["kernel", "its decay", "c = -1.5"],
        ),
        (
            ContactError::Input(InputError::LayerTooThin { ratio: 101.5, limit: 100.5 }),
            &["101.5 times", "at most 100.5", "foundation of springs"],
        ),
        (
            ContactError::Input(InputError::KernelNotSupported { why: "an edge is Adhesive" }),
            &["an edge is Adhesive"],
        ),
        (
            ContactError::Solve(SolveError::Bending { residual: 1.5, solves: 120 }),
            &["period, layer or kernel", "120 solves", "1.5", "complete contact of a period"],
        ),
        (
            ContactError::Evaluation(EvaluationError::HalfPlanesOnly { quantity: "the approach" }),
            &["the approach", "not known", "layer"],
        ),
        (
            ContactError::Evaluation(EvaluationError::NoStress { depths: [0.25, 1.5] }),
            &["depths from 0.25 to 1.5", "rigid base"],
        ),
        (
            ContactError::Input(InputError::InvalidLimits { interval: ON }),
            &["-b = -11.5", "a = 12.5"],
        ),
        (
            ContactError::Input(InputError::InvalidEdgePressure { name: "ε_a", value: -7.5 }),
            &["ε_a = -7.5"],
        ),
        (
            ContactError::Solve(SolveError::NoFirstContact { x: [1.5, 2.5], slope: [3.5, 4.5] }),
            &["3.5 at x = 1.5", "widen"],
        ),
        (
            ContactError::Solve(SolveError::NoFirstContact { x: [1.5, 2.5], slope: [3.5, -4.5] }),
            &["bulge away", "flip"],
        ),
        (
            ContactError::Solve(SolveError::NoFirstContact { x: [1.5, 2.5], slope: [0.0; 2] }),
            &["parallel", "FreeUntil", "like curves"],
        ),
        (
            ContactError::Solve(SolveError::NoFirstContact { x: [1.5, 2.5], slope: [-3.5, 4.5] }),
            &["-3.5 at x = 1.5", "below the smallest normal number", "units"],
        ),
        (
            ContactError::Solve(SolveError::DomainTooShort {
                end,
                carried: 13.5,
                load,
                half_width,
                peak,
                kappa_is_default: yes,
            }),
            &["at x = 33.5", "carry 13.5", "load 32.5", "contact_modulus missing?"],
        ),
        (
            ContactError::Solve(SolveError::HalfWidthTooLarge {
                wanted: 14.5,
                half_width,
                end,
                load,
                peak,
                kappa_is_default: yes,
            }),
            &["half-width 14.5", "at x = 33.5", "contact_modulus missing?"],
        ),
        (
            ContactError::Solve(SolveError::NoEquilibrium { half_width, near: 15.5 }),
            &[
                "near x = 15.5",
                "the last that was tried",
                "single_interval",
                "breakpoints",
                "Fit::smooth",
                "start",
            ],
        ),
        (
            ContactError::Solve(SolveError::NoEquilibrium { half_width: 1.5e-13, near: 16.5 }),
            &["near x = 16.5", "too far from 0", "move the origin"],
        ),
        (ContactError::Solve(SolveError::Overflow { interval: ON }), &["too small", "units"]),
        (
            ContactError::Solve(SolveError::BudgetSpent { evaluations: 42, budget: 43, last: ON }),
            &["the budget is 43", "breakpoints"],
        ),
        (
            ContactError::Solve(SolveError::LimitSearch { best: ON, source: astray }),
            &["-b = -11.5, a = 12.5"],
        ),
        (
            ContactError::Solve(SolveError::EdgePressureNotMet {
                best: ON,
                at_a: 16.5,
                at_b: 17.5,
            }),
            &["A = 16.5", "B = 17.5", "more segments"],
        ),
        (
            ContactError::Input(InputError::InvalidSegments { segments: 44, extrapolations: 45 }),
            &["44 segments", "45 extrapolations"],
        ),
        (
            ContactError::Evaluation(EvaluationError::Singular { x: 18.5 }),
            &["x = 18.5 is infinite", "edge_singularities"],
        ),
        (
            ContactError::Input(InputError::InconsistentHeights {
                between: [1.5, 2.5],
                by_heights: 3.5,
                by_slopes: 4.5,
            }),
            &["x = 1.5 to 2.5", "3.5 by the heights", "4.5 by their slopes", "check_derivatives"],
        ),
        (
            ContactError::Input(InputError::InconsistentHeights {
                between: [1.5; 2],
                by_heights: 3.5,
                by_slopes: 0.0,
            }),
            &["at x = 1.5", "3.5 by the heights", "at a joint within its tolerance"],
        ),
        (
            ContactError::Input(InputError::NotConvex { between: [1.5, 2.5], slopes: [4.5, 3.5] }),
            &["from 4.5 to 3.5", "from x = 1.5 to 2.5", "Convexity::Unknown"],
        ),
        (
            ContactError::Input(InputError::NotConvex { between: [1.5, 1.5], slopes: [4.5, 3.5] }),
            &["at x = 1.5"],
        ),
        (
            ContactError::Input(InputError::InvalidResolution { resolution: 1.5, least: 2.5 }),
            &["resolution is 1.5", "more than 2.5"],
        ),
        (
            ContactError::Input(InputError::InvalidResolution { resolution: -1.5, least: 0.0 }),
            &["-1.5", "more than 0"],
        ),
        (
            ContactError::Solve(SolveError::FeatureMissed { x: 1.5, slope: 2.5, assumed: 3.5 }),
            &["x = 1.5 is 2.5"],
        ),
        (
            ContactError::Solve(SolveError::Unbalanced { x: 1.5, strength: 2.5, allowed: 3.5 }),
            &["within 3.5"],
        ),
        (
            ContactError::Solve(SolveError::Undecided { x: 1.5, evaluations: 46, samples: 47 }),
            &["46 evaluations"],
        ),
        (
            ContactError::Solve(SolveError::Undecided { x: 1.5, evaluations: 0, samples: 0 }),
            &["x = 1.5, as the limits", "move the origin"],
        ),
        (
            ContactError::Input(InputError::InvalidTolerance { tolerance: -6.5 }),
            &["-6.5", "tolerance < 1"],
        ),
        (
            ContactError::Input(InputError::InvalidAdhesion { work: -5.5 }),
            &["-5.5", "not negative"],
        ),
        (
            ContactError::Input(InputError::BothLimitsGiven { interval: ON }),
            &["-b = -11.5", "the load must be given"],
        ),
        (
            ContactError::Input(InputError::InvalidMoment {
                quantity: "moment",
                value: f64::INFINITY,
            }),
            &["the moment is inf", "finite"],
        ),
        (
            ContactError::Input(InputError::TiltNotSupported { why: "so it is" }),
            &["so it is", "Panels"],
        ),
        (
            ContactError::Solve(SolveError::TiltNotFound {
                load,
                at: 1.5,
                reached: 2.5,
                tilt: 3.5,
                ends: Ends { left: 4.5, right: 5.5 },
            }),
            &["act at x = 1.5", "nearest is x = 2.5", "tilt 3.5", "extend the domain"],
        ),
        (
            ContactError::Solve(SolveError::PullOff { load: -3.5, least: -2.5 }),
            &["load -3.5", "than -2.5, the pull-off force", "pull less"],
        ),
        (
            ContactError::Input(InputError::PeakEdge { edge: Edge::Fixed(1.5) }),
            &["Fixed(1.5)", "half-width"],
        ),
        (
            ContactError::Solve(SolveError::PeakTooHigh {
                wanted: 1.5,
                half_width,
                found: 2.5,
                end,
                load,
                kappa_is_default: yes,
            }),
            &["peak pressure 1.5", "x = 33.5", "it is 2.5", "contact_modulus missing?"],
        ),
        (
            ContactError::Solve(SolveError::NoPeak { wanted: 1.5, half_width, found: 2.5 }),
            &["peak pressure 1.5", "is 2.5", "give the load"],
        ),
        (
            ContactError::Solve(SolveError::NoPeak {
                wanted: 1.5,
                half_width,
                found: f64::INFINITY,
            }),
            &["peak pressure 1.5", "is inf", "give the load", "round the kink"],
        ),
        (
            ContactError::Solve(SolveError::InJump { wanted: 1.5, load, below: 0.5, above: 2.5 }),
            &["0.5 and 2.5", "not 1.5", "load 32.5", "both sides"],
        ),
        (
            ContactError::Solve(SolveError::LoadUnknown { half_width, load }),
            &["half-width of 31.5", "load 32.5", "corners hold", "give the load"],
        ),
        (
            ContactError::Evaluation(EvaluationError::AboveSurface { x: 1.5, depth: -2.5 }),
            &["x = 1.5", "depth -2.5"],
        ),
        (
            ContactError::Input(InputError::InvalidYoungsModulus {
                body: Body::Upper,
                modulus: -1.5,
            }),
            &["upper body", "-1.5", "Rigid"],
        ),
        (ContactError::Input(InputError::BothRigid), &["Material::Rigid", "elastic"]),
        (ContactError::Input(InputError::NoMaterials), &["Contact::materials"]),
        (ContactError::Input(InputError::InvalidReference { length: -1.5 }), &["-1.5", "depth"]),
        (
            ContactError::Solve(SolveError::ApproachTooLarge { wanted: 1.5, approach: 2.5, load }),
            &["approach of 1.5", "carry 32.5", "approach of 2.5"],
        ),
        (
            ContactError::Solve(SolveError::Falls { quantity: "approach", load, rate: -1.5 }),
            &["approach", "load 32.5", "-1.5", "ask for less", "give the load", "deeper"],
        ),
        (
            ContactError::Evaluation(EvaluationError::OutsideTable {
                approach: 4.5,
                range: [2.5, 3.5],
            }),
            &["2.5 to 3.5, not 4.5", "larger loads"],
        ),
        (
            ContactError::Input(InputError::InvalidRelief { z: 3.5, height: -0.25 }),
            &["-0.25 at z = 3.5", "flip"],
        ),
        (
            ContactError::Input(InputError::Relief {
                source: Box::new(ContactError::Solve(SolveError::OutsideBodies {
                    x: 5.5,
                    range: [6.5, 7.5],
                })),
            }),
            &["relief of the roller", "5.5", "6.5 to 7.5"],
        ),
        (
            ContactError::Input(InputError::Pose {
                x: 1.5,
                y: 2.5,
                angle: 0.25,
                source: Box::new(ContactError::Input(InputError::InvalidReference { length: 8.5 })),
            }),
            &["body 2 is at x = 1.5, y = 2.5, turned by 0.25", "8.5"],
        ),
        (
            ContactError::Solve(SolveError::ToleranceNotReached {
                tolerance: 1e-16,
                reached: 2.5e-15,
            }),
            &["1e-16", "2.5e-15", "narrower range"],
        ),
        (
            ContactError::Input(InputError::InvalidRoller { length: -1.5, slices: 0, most: 99 }),
            &["length -1.5", "0 slices", "positive", "1 to 99"],
        ),
        (
            ContactError::Evaluation(EvaluationError::SliceOutsideTable {
                z: 0.5,
                approach: 4.5,
                range: [2.5, 3.5],
            }),
            &["z = 0.5", "4.5", "2.5 to 3.5", "larger loads", "misalignment"],
        ),
        (
            ContactError::Solve(SolveError::LoadBeyondBodies {
                load,
                at: 5.5,
                ends: Ends { left: -4.5, right: 4.5 },
            }),
            &["acts at x = 5.5", "moment", "-4.5 to 4.5", "move the load inward"],
        ),
        (
            ContactError::Solve(SolveError::LoadBeyondSlices { load, at: 5.5, ends: [-4.5, 4.5] }),
            &["load 32.5", "z = 5.5", "-4.5 to 4.5", "inward"],
        ),
        (ContactError::Solve(SolveError::OneSlice { z: 1.5 }), &["z = 1.5", "more slices"]),
        (
            ContactError::Solve(SolveError::RollerNotFound {
                source: SearchError::NotFinite { x: 1.5, value: f64::NAN },
            }),
            &["NaN at 1.5", "units"],
        ),
        (
            ContactError::Input(InputError::InvalidSlipFriction { friction: -1.5 }),
            &["-1.5", "positive"],
        ),
        (
            ContactError::Input(InputError::InvalidShear { quantity: "tension", value: 1.5 }),
            &["tension = 1.5"],
        ),
        (
            ContactError::Solve(SolveError::SlipsEverywhere { force: 1.5, limit: 2.5 }),
            &["1.5", "μF = 2.5", "raise the load"],
        ),
        (
            ContactError::Solve(SolveError::SticksEverywhere { force: 1.5, limit: 2.5 }),
            &["1.5", "μF = 2.5", "load_rates"],
        ),
        (
            ContactError::Solve(SolveError::ReversedSlip {
                zone: Interval { left: 1.5, right: 2.5 },
                contact: ON,
            }),
            &["stick from 1.5 to 2.5", "reverses"],
        ),
        (
            ContactError::Input(InputError::UnlikeBodies { beta: 0.25 }),
            &["β = 0.25", "like bodies"],
        ),
        (ContactError::Input(InputError::SlipNotSupported { why: "so it is" }), &["so it is"]),
        (
            ContactError::Input(InputError::InvalidPoissonRatio { body: None, ratio: 1.5 }),
            &["Poisson's ratio is 1.5: ", "0 to 1/2", "0.3"],
        ),
        (
            ContactError::Input(InputError::InvalidPoissonRatio {
                body: Some(Body::Upper),
                ratio: 1.5,
            }),
            &["upper body: Poisson's ratio is 1.5: "],
        ),
        (
            ContactError::Input(InputError::InvalidFriction { coefficient: f64::NAN }),
            &["NaN", "finite"],
        ),
        (
            ContactError::Evaluation(EvaluationError::InvalidPosition {
                x: 1.5,
                inside: true,
                interval: ON,
            }),
            &["lie inside"],
        ),
        (
            ContactError::Evaluation(EvaluationError::InvalidPosition {
                x: 1.5,
                inside: false,
                interval: ON,
            }),
            &["lie outside"],
        ),
        (
            ContactError::Evaluation(EvaluationError::NoLoadDerivative { why: "so it is" }),
            &["so it is"],
        ),
        (ContactError::Input(InputError::EdgePressureLoad), &["load must be given", "edges()"]),
        (
            ContactError::Evaluation(EvaluationError::LengthMismatch { x: 48, pressures: 49 }),
            &["48 abscissae", "49 places"],
        ),
        (
            ContactError::Evaluation(EvaluationError::Integral { x: 1.5, panels: 51 }),
            &["x = 1.5", "51 panels"],
        ),
        (
            ContactError::Evaluation(EvaluationError::Unresolved {
                x: 1.5,
                pressure: 2.5,
                error: 3.5,
            }),
            &["2.5 with an error"],
        ),
    ]
}

/// Returns the numbers of at least `least` characters that an error shows, without their signs.
fn numbers(shown: &str, least: usize) -> impl Iterator<Item = f64> {
    let parts = shown.split(|c: char| !c.is_ascii_digit() && c != '.');
    parts.filter(move |part| part.len() >= least).filter_map(|part| part.parse().ok())
}

fn assert_says(error: &(impl std::error::Error + Send + Sync + 'static), words: &[&str]) {
    let (fields, message) = (format!("{error:?}"), error.to_string());
    // A single digit belongs to a name.
    for number in numbers(&fields, 2) {
        assert!(numbers(&message, 1).any(|said| said == number), "{number} of {fields}: {message}");
    }
    for word in words {
        assert!(message.contains(word), "{word}: {message}");
    }
    assert!(message.len() < 400 && !message.contains("  "), "{message}");
}

#[test]
fn the_message_of_a_contact_names_its_values() {
    for (error, words) in contact_errors() {
        assert_says(&error, words);
    }
}

#[test]
fn the_message_of_what_is_no_contact_says_where_it_is_none_and_what_helps() {
    let (interval, load) = (ON, 1.5);
    let helps =
        ["step the load to it with a Solver", "change it a little", "breakpoints", "Fit::smooth"];
    let minus_infinity = f64::NEG_INFINITY;
    for (error, words, helps) in [
        (
            ContactError::Solve(SolveError::Tension { x: 2.5, pressure: -3.5, interval, load }),
            "part there",
            &helps[..],
        ),
        (
            ContactError::Solve(SolveError::Tension {
                x: 2.5,
                pressure: minus_infinity,
                interval,
                load,
            }),
            "-inf",
            &["Solver", "round the corner off"],
        ),
        (
            ContactError::Solve(SolveError::Overlap { x: 2.5, gap: -3.5, interval, load }),
            "touch there",
            &helps[..],
        ),
    ] {
        assert_says(&error, &["x = 2.5", "-11.5 to 12.5", "the load 1.5", words]);
        assert_says(&error, helps);
    }
    let lifts =
        ContactError::Solve(SolveError::LiftsOff { x: 2.5, strength: -3.5, interval, load })
            .to_string();
    let words = ["Fixed(2.5)", "-3.5", "the load 1.5", "FreeUntil(2.5)"];
    assert!(words.iter().all(|word| lifts.contains(word)), "{lifts}");
}

/// Six digits; more if two numbers differ only beyond them; all if the number is to be copied.
#[test]
fn messages_have_the_digits_that_tell_something() {
    let end = 0.987_654_321_012;
    let message = |[carried, half_width, peak]: [f64; 3]| {
        let (load, kappa_is_default) = (0.500_000_001, false);
        SolveError::DomainTooShort { end, carried, load, half_width, peak, kappa_is_default }
            .to_string()
    };
    let (some, none) = (message([0.5, 0.123_456_789, 5.415_062_361_294_345]), message([0.0; 3]));
    for words in ["carry 0.5 ", "load 0.500000001,", "half-width 0.123457 ", "pressure 5.41506;"] {
        assert!(some.contains(words), "{words}: {some}");
    }
    assert!(some.contains("x = 0.987654:"), "{some}");
    assert!(some.contains("FreeUntil(0.987654321012)"), "{some}");
    assert!(none.contains("touch first at their end x = 0.987654,"), "{none}");
    assert!(none.contains("FreeUntil(0.987654321012)"), "{none}");
    let pulled = message([-1.5, 1.0, -0.3]);
    assert!(pulled.contains("lower adhesion, which pulls there"), "{pulled}");
    let unknown = message([f64::NAN; 3]);
    assert!(unknown.contains("x = 0.987654 under the load 0.5: extend"), "{unknown}");
    assert!(unknown.contains("FreeUntil(") && !unknown.contains("NaN"), "{unknown}");
    let flats = Contact::new(&Flat, &Flat)
        .and_then(|contact| contact.solve(Control::Load(1.0)).map(|_| ()));
    let message = flats.unwrap_err().to_string();
    assert!(message.contains("0 at x = -inf and 0 at x = inf"), "{message}");
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
        (PiecewiseError::InPiece { piece: 12, source: not_finite }, "piece 12 from the left: X"),
        (
            PiecewiseError::InSegment { segment: 12, source: not_finite },
            "segment 12 of the outline: X' is NaN",
        ),
        (PiecewiseError::Tolerance { tolerance: -1.5 }, "-1.5"),
    ] {
        assert_says(&error, &[words]);
    }
    for (error, words) in [
        (
            PiecewiseError::Gap { breakpoint: 12, left: 1.5, right: 3.75, share: 0.75 },
            "gap of 2.25 between pieces 12 and 13 from the left",
        ),
        (
            PiecewiseError::Overlap { breakpoint: 12, left: 3.75, right: 1.5, share: 0.75 },
            "overlap of 2.25 between pieces 12 and 13 from the left",
        ),
        (
            PiecewiseError::Jump { breakpoint: 12, x: 4.5, left: 1.5, right: 3.75, share: 0.75 },
            "jump of 2.25 between pieces 12 and 13 from the left",
        ),
    ] {
        assert_says(&error, &[words, "with_tolerance, above 0.75"]);
    }
    for (error, words) in [
        (SplineError::NotFinite { row: 12, x: 1.5, y: f64::NAN }, "remove the row"),
        (SplineError::Duplicate { row: 12, x: 1.5 }, "row 12"),
        (SplineError::Unsorted { row: 12, x: 1.5, before: 2.5 }, "after 2.5"),
        (
            SplineError::Period { period: 1.5, first: 0.25, last: 1.75 },
            "the period 1.5 from the first point, x = 0.25, must end behind the last one, x = 1.75",
        ),
    ] {
        assert_says(&error, &[words]);
    }
    let best = Root { x: 1.5, residual: 2.5, bracket: [3.5, 4.5], evaluations: 12 };
    for (error, words) in [
        (SearchError::NotFinite { x: 1.5, value: f64::NAN }, "NaN at 1.5"),
        (SearchError::Budget { best }, "raise max_evaluations"),
        (SearchError::LeftBracket { x: 1.5, lo: 2.5, hi: 3.5 }, "[2.5, 3.5]: it must stay"),
        (
            SearchError::NotConverged { x: 1.5, residual: 2.5 },
            "still 2.5: tighten the tolerance, if one was set, or write",
        ),
        (SearchError::Tolerance { value: -1.5 }, "tolerance -1.5 is out of range"),
    ] {
        assert_says(&error, &[words]);
    }
}

/// Errors name the prescribed quantity, E* and not κ where it was given, and degrees only if they
/// may have been used.
#[test]
fn errors_name_what_was_given() {
    let body = Parabola::new(1.0, [-1.0, 1.0]).unwrap();
    let contact = Contact::new(&Flat, &body).unwrap();
    let text = |contact: &Contact<f64>, control| {
        contact.solve(control).map(|_| ()).unwrap_err().to_string()
    };
    for (name, control) in [
        ("the load is", Control::Load as fn(f64) -> _),
        ("the half-width is", Control::HalfWidth),
        ("the peak pressure is", Control::PeakPressure),
    ] {
        for value in [f64::NAN, -1.0, 5e-324, 1e-310] {
            let text = text(&contact, control(value));
            assert!(text.starts_with(name), "{text}");
            assert_eq!(text.contains("digits are lost"), value > 0.0, "{text}");
        }
    }
    for modulus in [-2.0, f64::NAN, 1.7e308] {
        let contact = contact.clone().contact_modulus(modulus);
        let error = contact.solve(Control::Load(0.01)).map(|_| ()).unwrap_err();
        assert!(matches!(error, ContactError::Input(InputError::InvalidModulus { .. })), "{error}");
        assert!(error.to_string().starts_with("E* = "), "{error}");
    }
    let arc = |from: f64, to: f64| {
        let arc = Curve::new([from, to], |k: f64| {
            let (sin, cos) = k.sin_cos();
            CurvePoint { x: sin, y: 1.0 - cos, dx: cos, dy: sin }
        });
        let solved =
            Contact::new(&Flat, &arc).and_then(|c| c.solve(Control::Load(0.01)).map(|_| ()));
        solved.unwrap_err().to_string()
    };
    assert!(arc(-90.0, 90.0).contains("degrees") && arc(0.0, 90.0).contains("degrees"));
    assert!(!arc(-3.0, 3.0).contains("degrees"));
}
