//! The heights of the gap before loading over a contact, from the panels of its slope.
//!
//! With `x = c + L cos θ` and h the height above the left limit,
//!
//! ```text
//! h(x) = ∫ g dx from the left limit to x      mean height: (1/π) ∫ h dθ
//! ```
//!
//! On a panel h is a polynomial, and Gauss's rule gives its integral over θ.

use super::solved::Solved;
use crate::numerics::chebyshev::{evaluate, primitive, value_at};
use crate::numerics::gauss_legendre::GaussLegendre;
use crate::quadrature::panels::{Arc, HalfAngle, Panel};
use crate::search::{Bracket, Brent, LimitSearch, SearchError, StoppingCriteria};
use crate::{ContactError, Real};

/// Number of nodes treated together.
const LANES: usize = 8;

/// Heights above the left limit of a contact.
#[derive(Clone, Copy)]
pub(super) struct UndeformedGap<T> {
    /// Mean height over θ.
    pub mean: T,
    /// Least height.
    pub least: T,
    /// Height at a given place, if it is in this contact.
    pub at: Option<T>,
}

impl<T: Real> UndeformedGap<T> {
    pub fn new(solved: Solved<'_, T>, contact: usize, at: T) -> Result<Self, ContactError<T>> {
        let (gap, on) = (solved.gap, solved.contacts()[contact]);
        let integrator = solved.integrator.panels_over(gap, on)?;
        let mut found = Self { mean: T::zero(), least: T::zero(), at: None };
        let (mut height, mut left) = (T::zero(), HalfAngle::of(on, on.left));
        for (panel, x) in integrator.spans(contact) {
            let right = HalfAngle::of(on, x[1]);
            let arc = Arc::new(x[1] - x[0], left, right, on.right - on.left);
            if at >= x[0] && at <= x[1] {
                found.at = Some(height + panel.rise(x[0], at));
            }
            height = found.add(panel, x, &arc, height);
            left = right;
        }
        found.mean *= T::frac_1_pi();
        Ok(found)
    }

    /// Adds the heights on a panel between two places, given the height at the left one; returns
    /// the height at the right one.
    fn add(&mut self, panel: &Panel<T>, x: [T; 2], arc: &Arc<T>, height: T) -> T {
        let (half, by_half) = (panel.half(), T::one() / panel.half());
        let primitive = primitive(panel.coefficients());
        let primitive = &primitive[..=panel.length];
        let ends = x.map(|x| panel.local(x));
        let (rises, slopes) = evaluate(primitive, &ends);
        let height_at = |rise: T| height + half * (rise - rises[0]);
        let mut before = [ends[0], slopes[0]];
        let mut pass = |least: &mut T, place: T, slope: T| {
            if before[1] < T::zero() && slope >= T::zero() {
                let lowest = lowest(panel, [before[0], place], [before[1], slope]);
                *least = least.min(height_at(value_at(primitive, lowest)));
            }
            before = [place, slope];
        };
        let rule = GaussLegendre::suited(panel.length + 1, arc.tangent);
        let mut sum = T::zero();
        for block in 0..rule.n / LANES {
            let [y, weight] = arc.nodes::<LANES>(rule, block);
            let s = y.map(|y| ends[0] + (y - arc.to_left) * by_half);
            let (rise, slope) = evaluate(primitive, &s);
            for i in 0..LANES {
                sum += weight[i] * height_at(rise[i]);
                pass(&mut self.least, s[i], slope[i]);
            }
        }
        pass(&mut self.least, ends[1], slopes[1]);
        self.mean += sum * arc.tangent;
        let end = height_at(rises[1]);
        self.least = self.least.min(end);
        end
    }
}

/// Returns the place between two others, with their slopes, at which the slope of a panel rises
/// through zero.
fn lowest<T: Real>(panel: &Panel<T>, [from, to]: [T; 2], [falls, rises]: [T; 2]) -> T {
    let bracket = Bracket::new(from, to).values(falls, rises);
    // The height is off by the square of the slope that is left.
    let residual = (T::epsilon().sqrt() * (rises - falls)).to_subset_unchecked();
    let brent = Brent { tolerance: StoppingCriteria { residual, ..StoppingCriteria::FULL } };
    match brent.find(&mut |s| value_at(panel.coefficients(), s), &bracket) {
        Ok(root) | Err(SearchError::Budget { best: root }) => root.x,
        // The places are two neighbouring numbers: either will do.
        Err(_) => from,
    }
}
