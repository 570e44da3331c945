//! Where the bodies touch first: the point at which the slope of the gap passes from negative to
//! positive. Every single contact of a gap whose slope rises contains it.

use crate::gap::{Sampler, Side};
use crate::search::{Bracket, Brent, LimitSearch, SearchError};
use crate::{ContactError, Interval, Real};

/// Two abscissae and the slope of the gap there.
struct Signs<T> {
    x: [T; 2],
    slope: [T; 2],
}

/// Finds it, looking first at the start, or else in the middle of the bodies.
pub(super) fn first_contact<T: Real>(
    sampler: &mut Sampler<'_, T>,
    joints: &[T],
    range: [T; 2],
    start: Option<Interval<T>>,
) -> Result<T, ContactError<T>> {
    let mut signs = widen(sampler, Interval { left: range[0], right: range[1] }, start)?;
    match jump(sampler, joints, &mut signs)? {
        Some(joint) => Ok(joint),
        None => zero(sampler, signs),
    }
}

/// Widens until the slope is negative on the left and positive on the right.
fn widen<T: Real>(
    sampler: &mut Sampler<'_, T>,
    whole: Interval<T>,
    start: Option<Interval<T>>,
) -> Result<Signs<T>, ContactError<T>> {
    let zero = T::zero();
    // Not the very ends: the slope of a round body may be infinite there.
    let margin = T::of(1e-3) * whole.half_width();
    let within = |x: T| x.max(whole.left + margin).min(whole.right - margin);
    let quarter = T::of(0.25) * whole.half_width();
    let middle = Interval { left: whole.centre() - quarter, right: whole.centre() + quarter };
    let start = start.unwrap_or(middle);

    let (mut x, mut step) = ([within(start.left), within(start.right)], start.half_width());
    let mut slope = [sampler.slope(x[0])?, sampler.slope(x[1])?];
    while !(slope[0] <= zero && slope[1] >= zero && slope[0] < slope[1]) {
        let closes_outward = slope[0] > zero && slope[1] < zero;
        let before = x;
        step *= T::of(2.0);
        if slope[0] >= zero {
            x[0] = within(x[0] - step);
        }
        if slope[1] <= zero {
            x[1] = within(x[1] + step);
        }
        if closes_outward || x == before {
            return Err(ContactError::NoFirstContact { x: before, slope });
        }
        for i in 0..2 {
            if x[i] != before[i] {
                slope[i] = sampler.slope(x[i])?;
            }
        }
    }
    Ok(Signs { x, slope })
}

/// A wedge touches at a joint, where the slope has no zero but jumps through it. Where no joint
/// is the place, they narrow the bracket.
fn jump<T: Real>(
    sampler: &mut Sampler<'_, T>,
    joints: &[T],
    Signs { x, slope }: &mut Signs<T>,
) -> Result<Option<T>, ContactError<T>> {
    for &joint in joints {
        if joint <= x[0] || joint >= x[1] {
            continue;
        }
        let left = sampler.slope_from(joint, Side::Left)?;
        let right = sampler.slope_from(joint, Side::Right)?;
        if left > T::zero() {
            (x[1], slope[1]) = (joint, left);
        } else if right < T::zero() {
            (x[0], slope[0]) = (joint, right);
        } else {
            return Ok(Some(joint));
        }
    }
    Ok(None)
}

/// The zero of the slope in the bracket.
fn zero<T: Real>(
    sampler: &mut Sampler<'_, T>,
    Signs { x, slope }: Signs<T>,
) -> Result<T, ContactError<T>> {
    let mut failed = None;
    let mut f = |x| {
        sampler.slope(x).unwrap_or_else(|error| {
            failed = Some(error);
            T::of(f64::NAN)
        })
    };
    let bracket = Bracket::new(x[0], x[1]).values(slope[0], slope[1]);
    let root = Brent::default().find(&mut f, &bracket);
    match (failed, root) {
        (Some(error), _) => Err(error),
        // Any point of a bracket this tight lies in the contact.
        (None, Ok(root) | Err(SearchError::Budget { best: root })) => Ok(root.x),
        (None, Err(_)) => Err(ContactError::NoFirstContact { x, slope }),
    }
}
