//! Bodies by their parameters.

use crate::profile::stored::{pair, shapes};
use crate::profile::{self, Fit, Placed, Placement, Spline};
use crate::{ContactError, Fallible, Flat, ParametricProfile, Piecewise, Real};
use serde::{Deserialize, Deserializer, Serialize, de};
use std::sync::Arc;

type Built<T> = Fallible<T, Arc<dyn ParametricProfile<T>>>;

/// Body that a file can hold: a shape, and the steps that place it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[serde(bound(serialize = "T: Real + Serialize", deserialize = "T: Real + Deserialize<'de>"))]
pub struct PlacedShape<T> {
    /// Shape, with its vertex at the origin.
    pub shape: Shape<T>,
    /// Steps that place it, the first one first.
    #[serde(default = "Vec::new", skip_serializing_if = "Vec::is_empty")]
    pub steps: Vec<Step<T>>,
}

/// Makes [`Shape`] from the table of shapes.
macro_rules! shape {
    (
        $($(#[$about:meta])* $name:literal $body:ident {
            $($field:ident: $($one:ident)? $([$two:ident; 2])?),*
        })*
        ; $($(#[$says:meta])* $called:literal $whole:ident = $join:ident {
            $($(#[$tells:meta])* $part:ident: $($single:ident)? $([$double:ident; 2])?),*
        })*
    ) => {
        /// Shape by its parameters, under the names of its constructor's arguments.
        #[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
        #[serde(deny_unknown_fields, rename_all = "snake_case", bound(
            serialize = "T: Real + Serialize", deserialize = "T: Real + Deserialize<'de>"
        ))]
        #[non_exhaustive]
        pub enum Shape<T> {
            /// Level line without ends.
            Flat,
            $($(#[$about])* #[serde(rename = $name)] $body(profile::$body<T>),)*
            $($(#[$says])* #[serde(rename = $called)] $whole {$(
                $(#[$tells])*
                $($part: $single,)?
                $(#[serde(deserialize_with = "pair")] $part: [$double; 2],)?
            )*},)*
            /// Measured points: [`Spline::fitted`].
            Spline {
                /// Points `[x, y]` in order of rising x.
                #[serde(deserialize_with = "pairs")]
                points: Vec<[T; 2]>,
                /// Settings of the fit.
                #[serde(default)]
                fit: Fit<T>,
            },
            /// Pieces from left to right: [`Piecewise::new`].
            Piecewise {
                /// Pieces; each may be joined itself.
                parts: Vec<PlacedShape<T>>,
                /// Tolerance of the joints: [`Piecewise::with_tolerance`].
                #[serde(default, skip_serializing_if = "Option::is_none")]
                tolerance: Option<T>,
            },
        }

        impl<T: Real> Shape<T> {
            /// Makes the shape that has this name in files from its numbers. They are asked for by
            /// name, those of a pair as `domain.0` and `domain.1`. Returns `None` if no shape of
            /// numbers alone has the name, or a number is missing.
            ///
            /// ```
            /// use linecontact::scene::Shape;
            ///
            /// let given = [("radius", 2.0), ("domain.0", -1.0), ("domain.1", 1.0)];
            /// let number = |name: &str| Some(given.iter().find(|(known, _)| *known == name)?.1);
            /// let parabola = Shape::from_numbers("parabola", number);
            /// assert!(matches!(parabola, Some(Ok(Shape::Parabola(_)))));
            /// assert!(Shape::from_numbers("line", number).is_none());
            /// ```
            ///
            /// # Errors
            /// [`InputError::Shape`](crate::InputError::Shape), as of the constructor.
            pub fn from_numbers(
                name: &str,
                mut number: impl FnMut(&str) -> Option<T>,
            ) -> Option<Result<Self, ContactError<T>>> {
                Some(match name {
                    "flat" => Ok(Self::Flat),
                    $($name => profile::$body::new($(
                        $(std::convert::identity::<$one>(number(stringify!($field))?))?
                        $(both::<$two, _>(stringify!($field), &mut number)?)?
                    ),*).map(Self::$body).map_err(Into::into),)*
                    $($called => Ok(Self::$whole {$(
                        $($part: std::convert::identity::<$single>(number(stringify!($part))?),)?
                        $($part: both::<$double, _>(stringify!($part), &mut number)?,)?
                    )*}),)*
                    _ => return None,
                })
            }

            /// Builds the body where it is placed, if it is. A smoothed spline is fitted to the
            /// points there, so that it keeps its uncertainty.
            ///
            /// # Errors
            /// As [`PlacedShape::build`].
            pub fn build(&self, to: Option<Placement<T>>) -> Built<T> {
                match self {
                    Self::Flat => put(Flat, to, Placed::new),
                    $(Self::$body(body) => put(*body, to, Placed::new),)*
                    $(&Self::$whole { $($part),* } => {
                        put(profile::$join($($part),*)?, to, Piecewise::placed)
                    })*
                    Self::Spline { points, fit } => match to {
                        // Refuses an impossible placement.
                        Some(to) if fit.smooth => put(Placed::new(Flat, to)?, Some(to), |_, to| {
                            Spline::fitted_at(points, *fit, to)
                        }),
                        _ => put(Spline::fitted(points, *fit)?, to, Spline::placed),
                    },
                    Self::Piecewise { parts, tolerance } => {
                        let parts = parts.iter().map(PlacedShape::build).collect::<Result<_, _>>()?;
                        let whole = match *tolerance {
                            None => Piecewise::new(parts)?,
                            Some(tolerance) => Piecewise::with_tolerance(parts, tolerance)?,
                        };
                        put(whole, to, Piecewise::placed)
                    }
                }
            }
        }
    };
}
shapes!(shape);

/// Asks for both numbers of a pair.
fn both<T, F: FnMut(&str) -> Option<T>>(name: &str, number: &mut F) -> Option<[T; 2]> {
    Some([number(&format!("{name}.0"))?, number(&format!("{name}.1"))?])
}

/// Places a body, if it is to be placed.
fn put<T: Real, P, Q, E: Into<ContactError<T>>>(
    body: P,
    to: Option<Placement<T>>,
    placed: impl FnOnce(P, Placement<T>) -> Result<Q, E>,
) -> Built<T>
where
    P: ParametricProfile<T> + 'static,
    Q: ParametricProfile<T> + 'static,
{
    Ok(match to {
        None => Arc::new(body),
        Some(to) => Arc::new(placed(body, to).map_err(Into::into)?),
    })
}

/// Step of a placement, about the origin: a method of [`Placement`].
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "snake_case")]
pub enum Step<T> {
    /// Moves along X and across, by two lengths.
    Shifted(T, T),
    /// Exchanges left and right.
    Mirrored,
    /// Turns the body upside down.
    Flipped,
    /// Turns by an angle in radians, from X towards Y.
    Rotated(T),
    /// Multiplies all lengths by a factor.
    Scaled(T),
}

impl<T> From<Shape<T>> for PlacedShape<T> {
    fn from(shape: Shape<T>) -> Self {
        Self { shape, steps: Vec::new() }
    }
}

impl<T: Real> PlacedShape<T> {
    /// Builds the body. A smoothed spline is fitted to the points where they are placed, so that it
    /// keeps its uncertainty.
    ///
    /// # Errors
    /// [`InputError::Shape`](crate::InputError::Shape),
    /// [`InputError::Pieces`](crate::InputError::Pieces) and
    /// [`InputError::Points`](crate::InputError::Points), as of the constructors.
    pub fn build(&self) -> Result<Arc<dyn ParametricProfile<T>>, ContactError<T>> {
        let placed = || self.steps.iter().fold(Placement::default(), Step::after);
        self.shape.build((!self.steps.is_empty()).then(placed))
    }
}

impl<T: Real> Step<T> {
    fn after(placement: Placement<T>, step: &Self) -> Placement<T> {
        match *step {
            Self::Shifted(along, across) => placement.shifted(along, across),
            Self::Mirrored => placement.mirrored(),
            Self::Flipped => placement.flipped(),
            Self::Rotated(angle) => placement.rotated(angle),
            Self::Scaled(factor) => placement.scaled(factor),
        }
    }
}

/// Two numbers.
#[derive(Deserialize)]
#[serde(bound = "T: Deserialize<'de>")]
struct Pair<T>(#[serde(deserialize_with = "pair")] [T; 2]);

fn pairs<'de, T: Deserialize<'de>, D: Deserializer<'de>>(file: D) -> Result<Vec<[T; 2]>, D::Error> {
    Ok(Vec::<Pair<T>>::deserialize(file)?.into_iter().map(|pair| pair.0).collect())
}

/// Reads a body, and refuses one that cannot be built.
pub(super) fn possible<'de, T: Real + Deserialize<'de>, D: Deserializer<'de>>(
    file: D,
) -> Result<PlacedShape<T>, D::Error> {
    let body = PlacedShape::deserialize(file)?;
    body.build().map_err(de::Error::custom)?;
    Ok(body)
}
