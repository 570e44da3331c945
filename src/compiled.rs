//! Entries of the solver that are compiled in this crate for `f64`.
//!
//! The solver is generic: a program that uses it would compile all of it again at each build. A
//! function without type parameters is compiled once, with its crate. The only such functions that
//! stable Rust chooses by the type of a number are those of a trait, where an `impl` overrides the
//! default. So [`Real`](crate::Real) has these entries as hidden methods, and its `impl` for `f64`
//! has the same ones again.

pub(crate) use crate::profile::{Fit, Spline, SplineError};
pub(crate) use crate::quadrature::{Integrator, Panels};
pub(crate) use crate::solution::{Approaching, certify};
pub(crate) use crate::stress::{Stress, StressPeak, Subsurface};
pub(crate) use crate::{
    Approach, Body, Certificate, Contact, ContactError, ContactRegion, Control, Cost, Estimate,
    Extremum,
};
pub(crate) use crate::{LoadRates, Peak, Pressure, References, Solution, Solver, SpringTable};

/// Writes each entry as a method with an attribute.
macro_rules! methods {
    (@result $value:ty) => { Result<$value, ContactError<Self>> };
    (@result $value:ty, $error:ty) => { Result<$value, $error> };
    ($attribute:meta; $(
        $name:ident $(<$life:lifetime>)? ($($argument:ident: $type:ty),+ $(,)?)
        -> $value:ty $(, $error:ty)? = $body:expr;
    )+) => {$(
        #[$attribute]
        fn $name $(<$life>)? ($($argument: $type),+)
            -> crate::compiled::methods!(@result $value $(, $error)?) { $body }
    )+};
}

/// Writes the entries into the trait or its `impl`, with an attribute.
macro_rules! entries {
    ($attribute:meta) => { crate::compiled::methods! { $attribute;
        panels(rule: &Panels) -> Box<dyn Integrator<Self>> = Ok(rule.prepared()?);
        solve<'b>(contact: &Contact<'b, Self>, control: Control<Self>) -> Solution<'b, Self>
            = contact.solve_cold(control);
        solve_next<'b>(
            solver: &mut Solver<Self>, contact: &Contact<'b, Self>, control: Control<Self>,
        ) -> Solution<'b, Self> = solver.solve_next(contact, control);
        pressure(pressure: &Pressure<'_, Self>, x: Self) -> Self = pressure.at_one(x);
        estimate(pressure: &Pressure<'_, Self>, x: Self, cost: &mut Cost) -> Estimate<Self>
            = pressure.estimated(x, cost);
        density(pressure: &Pressure<'_, Self>, x: &[Self], values: &mut [Self]) -> ()
            = pressure.unchecked(x, values);
        pressures(pressure: &Pressure<'_, Self>, x: &[Self], values: &mut [Self]) -> ()
            = pressure.at_all(x, values);
        peak(of: &Solution<'_, Self>) -> Peak<Self> = of.solved().peak();
        regions(of: &Solution<'_, Self>) -> Vec<ContactRegion<Self>> = of.solved().regions();
        moment(of: &Solution<'_, Self>) -> Self = of.solved().moment_by_half_width();
        gap_at(of: &Solution<'_, Self>, x: Self) -> Self = of.solved().gap_at(x);
        gap_slope(of: &Solution<'_, Self>, x: Self) -> Self = of.solved().gap_slope(x);
        certify(of: &Solution<'_, Self>) -> Certificate<Self> = certify(of.solved());
        load_rates(of: &Solution<'_, Self>) -> LoadRates<Self> = LoadRates::of(of.solved());
        approach(of: &Solution<'_, Self>, to: &References<Self>) -> Approach<Self>
            = Approaching::new(of.solved(), of.elasticity.as_ref(), to)?.of_all();
        displacement(
            of: &Solution<'_, Self>, body: Body, x: Self, to: &References<Self>,
        ) -> Self = Approaching::new(of.solved(), of.elasticity.as_ref(), to)?.of_surface(body, x);
        approach_rate(of: &Solution<'_, Self>, to: &References<Self>) -> Self
            = Approaching::new(of.solved(), of.elasticity.as_ref(), to)?.rate();
        subsurface<'s>(of: &'s Solution<'_, Self>, body: Option<Body>) -> Subsurface<'s, Self>
            = of.below(body);
        stress(below: &Subsurface<'_, Self>, x: Self, depth: Self) -> Stress<Self>
            = below.stress(x, depth);
        largest_shear(below: &Subsurface<'_, Self>) -> StressPeak<Self> = below.largest_shear();
        largest_von_mises(below: &Subsurface<'_, Self>, poisson: Self) -> StressPeak<Self>
            = below.largest_von_mises(poisson);
        largest_tension(below: &Subsurface<'_, Self>) -> Extremum<Self> = below.largest_tension();
        spring_table(
            contact: &Contact<'_, Self>, to: &References<Self>, loads: [Self; 2], tolerance: Self,
        ) -> SpringTable<Self> = SpringTable::solve(contact, to, loads, tolerance);
        spline(points: &[[Self; 2]], fit: Fit<Self>) -> Spline<Self>, SplineError<Self>
            = Spline::fit(points, fit);
    }};
}
pub(crate) use {entries, methods};
