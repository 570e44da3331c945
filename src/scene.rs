//! Scenes in files: two bodies by their parameters, their stiffness, and the quantities to solve
//! for.
//!
//! A [`Scene`] is data only, in TOML or in JSON. Python reads and writes the same files
//! (`linecontact.Scene.from_file`), and `docs/scene.schema.json` describes them for editors.
//! Numbers are written with all their digits, so that a scene solves to the same bits wherever it
//! is read. Curves given as functions, and your own profiles, cannot be written: [`Shape`] has the
//! bodies that a file can hold.
//!
//! ```
//! use linecontact::scene::Scene;
//!
//! let scene = Scene::<f64>::from_toml(
//!     r#"
//!     title = "A roller in a groove"
//!     units = { length = "mm", pressure = "MPa", load = "N/mm" }
//!     stiffness = { contact_modulus = 115e3 }
//!     controls = [{ load = 500.0 }, { half_width = 0.3 }]
//!
//!     [lower]
//!     shape = { ellipse = { along = 40.0, across = 40.0, angles = [-1.5, 1.5] } }
//!
//!     [upper]
//!     shape = { ellipse = { along = 10.0, across = 10.0, angles = [-1.5, 1.5] } }
//!     steps = [{ shifted = [3.0, 0.0] }, "mirrored"]
//!     "#,
//! )?;
//! let contact = scene.contact()?;
//! for &control in &scene.controls {
//!     let solution = contact.solve(control)?;
//!     println!("{} N/mm, {} mm", solution.load(), solution.hull().half_width());
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod shape;
mod text;

pub use shape::{PlacedShape, Shape, Step};
pub use text::SceneError;

use crate::{Contact, ContactError, Control, Edge, Ends, Foundation, PlaneState, Real, References};
use serde::{Deserialize, Deserializer, Serialize, de};

/// Contents of a file: a [`Contact`], and the quantities to prescribe.
///
/// ```
/// use linecontact::profile::Ellipse;
/// use linecontact::scene::{Scene, Shape, Stiffness};
/// use linecontact::Control;
///
/// let roller = Shape::Ellipse(Ellipse::circle(10.0, [-1.5, 1.5])?);
/// let mut scene = Scene::new(Shape::Flat, roller);
/// scene.stiffness = Some(Stiffness::ContactModulus(115e3));
/// scene.controls.push(Control::Load(500.0));
/// let read = Scene::from_json(&scene.to_json()?)?;
/// assert_eq!(read, scene);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[serde(bound(serialize = "T: Real + Serialize", deserialize = "T: Real + Deserialize<'de>"))]
#[non_exhaustive]
pub struct Scene<T> {
    /// Name of the scene, for people.
    #[serde(default, skip_serializing_if = "String::is_empty")]
    pub title: String,
    /// Labels of the units.
    #[serde(default, deserialize_with = "agreeing", skip_serializing_if = "Units::is_empty")]
    pub units: Units,
    /// Source of κ; without it κ = 1.
    #[serde(default, deserialize_with = "possible", skip_serializing_if = "Option::is_none")]
    pub stiffness: Option<Stiffness<T>>,
    /// Conditions at the edges: [`Contact::edges`]. Without them both edges are free.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub edges: Option<Ends<Edge<T>>>,
    /// Narrowest feature to be seen, a length: [`Contact::resolution`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub resolution: Option<T>,
    /// Period of both bodies along x: [`Contact::period`].
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub period: Option<T>,
    /// True if each solution must be proven: [`Contact::certified`].
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub certified: bool,
    /// Points between which results give the approach and the stiffness; they need materials.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub references: Option<References<T>>,
    /// Quantities to prescribe, one for each solve.
    #[serde(default = "Vec::new", skip_serializing_if = "Vec::is_empty")]
    pub controls: Vec<Control<T>>,
    /// Body 1.
    #[serde(deserialize_with = "shape::possible")]
    pub lower: PlacedShape<T>,
    /// Body 2.
    #[serde(deserialize_with = "shape::possible")]
    pub upper: PlacedShape<T>,
}

/// Source of the scale κ.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "snake_case")]
pub enum Stiffness<T> {
    /// E*, a pressure: [`Contact::contact_modulus`].
    ContactModulus(T),
    /// κ, a pressure: [`Contact::kappa`].
    Kappa(T),
    /// Materials of both bodies: [`Contact::materials`].
    Materials {
        /// Material or layer of body 1.
        lower: Foundation<T>,
        /// Material or layer of body 2.
        upper: Foundation<T>,
        /// Thickness of the bodies across the plane.
        #[serde(default)]
        plane: PlaneState,
    },
}

/// Reads a stiffness, and refuses one that no contact can have.
fn possible<'de, T: Real + Deserialize<'de>, D: Deserializer<'de>>(
    file: D,
) -> Result<Option<Stiffness<T>>, D::Error> {
    let scene =
        Scene { stiffness: Option::deserialize(file)?, ..Scene::new(Shape::Flat, Shape::Flat) };
    let checked = scene.contact().and_then(|contact| contact.check(Control::Load(T::one())));
    checked.map_err(de::Error::custom)?;
    Ok(scene.stiffness)
}

/// Labels of the units that the numbers of a scene are in. They are printed, and convert nothing;
/// an empty one is not printed. Files whose units are not known, are those of other quantities,
/// such as kN for a load per unit length, or do not go together, such as GPa with mm and N/mm, are
/// refused.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default, deny_unknown_fields)]
pub struct Units {
    /// Unit of lengths, such as `mm`.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub length: String,
    /// Unit of pressures, such as `MPa`.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub pressure: String,
    /// Unit of loads per unit length, such as `N/mm`.
    #[serde(skip_serializing_if = "String::is_empty")]
    pub load: String,
}

/// Units, with their sizes in m and N to four digits, and their powers of length and of force.
#[rustfmt::skip]
const UNITS: [(&str, f64, f64, f64); 12] = [
    ("m", 1e0, 1.0, 0.0), ("in", 2.54e-2, 1.0, 0.0), ("ft", 3.048e-1, 1.0, 0.0), ("mil", 2.54e-5, 1.0, 0.0),
    ("\u{e5}", 1e-10, 1.0, 0.0), ("N", 1e0, 0.0, 1.0), ("lbf", 4.448, 0.0, 1.0), ("kgf", 9.807, 0.0, 1.0),
    ("Pa", 1e0, -2.0, 1.0), ("bar", 1e5, -2.0, 1.0), ("psi", 6.895e3, -2.0, 1.0), ("ksi", 6.895e6, -2.0, 1.0),
];

/// Prefixes of units; the micro sign and the Greek mu are different.
#[rustfmt::skip]
const PREFIXES: [(&str, f64); 11] = [
    ("", 1e0), ("G", 1e9), ("M", 1e6), ("k", 1e3), ("da", 1e1), ("c", 1e-2), ("m", 1e-3), ("u", 1e-6),
    ("\u{b5}", 1e-6), ("\u{3bc}", 1e-6), ("n", 1e-9),
];

impl Units {
    fn is_empty(&self) -> bool {
        *self == Self::default()
    }
}

/// Returns the logarithm of the size of a unit such as `N/mm²`, and its powers of length and of
/// force, if it is known.
fn size(label: &str) -> Option<[f64; 3]> {
    let one = |label: &str| {
        let root = label.trim().strip_suffix(['²', '2']);
        let name = root.map_or(label, |root| root.trim_end_matches('^')).trim();
        let times = if root.is_some() { 2.0 } else { 1.0 };
        UNITS.iter().find_map(|&(unit, size, length, force)| {
            let prefix = name.strip_suffix(unit)?;
            let (_, factor) = PREFIXES.iter().find(|one| one.0 == prefix)?;
            Some([(factor * size).ln(), length, force].map(|power| times * power))
        })
    };
    let Some((of, per)) = label.split_once('/') else { return one(label) };
    let (of, per) = (one(of)?, one(per)?);
    Some([0, 1, 2].map(|i| of[i] - per[i]))
}

/// Reads units, and refuses those that are not known, or of another quantity, and those whose
/// product of pressure and length is another load.
fn agreeing<'de, D: Deserializer<'de>>(file: D) -> Result<Units, D::Error> {
    let units = Units::deserialize(file)?;
    let Units { length, pressure, load } = &units;
    for (label, quantity, powers) in [
        (length, "lengths", [1.0, 0.0]),
        (pressure, "pressures", [-2.0, 1.0]),
        (load, "loads per length, such as kN/mm", [-1.0, 1.0]),
    ] {
        if !label.is_empty() && size(label).is_none_or(|size| size[1..] != powers) {
            // A load per length is of two units, a force and a length.
            let is_of = |of: [f64; 2]| of == powers || (powers[0] == -1.0 && of[0] >= 0.0);
            let of = UNITS.iter().filter(|one| is_of([one.2, one.3])).map(|one| one.0);
            let says = format!("{label} is no unit of {quantity}: known are ");
            let prefixed = " (m, N and Pa with a prefix, too, such as mm)";
            return Err(de::Error::custom(says + &of.collect::<Vec<_>>().join(", ") + prefixed));
        }
    }
    // Other powers of ten, or inches among them, are off by far more.
    let goes = |unit: &str| Some((size(unit)?[0] + size(length)?[0] - size(load)?[0]).abs() < 0.5);
    if goes(pressure) == Some(false) {
        let mut others = ["Pa", "kPa", "MPa", "GPa", "psi", "ksi"].into_iter();
        let other = others.find(|one| goes(one) == Some(true));
        let remedy = other.map(|one| format!(": give pressures in {one}")).unwrap_or_default();
        let says = format!("{pressure} times {length} is no load per length in {load}{remedy}");
        return Err(de::Error::custom(says));
    }
    Ok(units)
}

impl<T: Real> Scene<T> {
    /// Creates the scene of two bodies, with the defaults of [`Contact::owned`] and without
    /// controls.
    pub fn new(lower: impl Into<PlacedShape<T>>, upper: impl Into<PlacedShape<T>>) -> Self {
        Self {
            title: String::new(),
            units: Units::default(),
            stiffness: None,
            edges: None,
            resolution: None,
            period: None,
            certified: false,
            references: None,
            controls: Vec::new(),
            lower: lower.into(),
            upper: upper.into(),
        }
    }

    /// Builds the contact.
    ///
    /// # Errors
    /// As [`Contact::owned`], and [`PlacedShape::build`].
    pub fn contact(&self) -> Result<Contact<'static, T>, ContactError<T>> {
        let contact = Contact::owned(self.lower.build()?, self.upper.build()?)?;
        let mut contact = match self.stiffness.clone() {
            None => contact,
            Some(Stiffness::ContactModulus(modulus)) => contact.contact_modulus(modulus),
            Some(Stiffness::Kappa(kappa)) => contact.kappa(kappa),
            Some(Stiffness::Materials { lower, upper, plane }) => {
                contact.materials(lower, upper, plane)
            }
        };
        if let Some(Ends { left, right }) = self.edges {
            contact = contact.edges(left, right);
        }
        if let Some(period) = self.period {
            contact = contact.period(period);
        }
        Ok(contact.with_resolution(self.resolution).certified(self.certified))
    }
}
