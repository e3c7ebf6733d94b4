//! The largest stresses that a search has found, to be marked.

/// A value and its place, m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Extreme<const AXES: usize> {
    /// The value, Pa.
    pub value: f64,
    /// Its coordinates, m.
    pub at: [f64; AXES],
}

/// The largest stresses in the bodies and on the interfaces; empty if none were sought.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Extremes {
    /// The bodies, from the surface down.
    pub bodies: Vec<BodyExtremes>,
    /// The interfaces.
    pub interfaces: Vec<InterfaceExtremes>,
}

/// The largest stresses in a body, as far as they were sought.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyExtremes {
    /// Its name.
    pub name: String,
    /// The largest von Mises stress.
    pub von_mises: Option<Extreme<3>>,
    /// The largest principal stress.
    pub max_principal: Option<Extreme<3>>,
}

/// The largest tractions on an interface, as far as they were sought.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InterfaceExtremes {
    /// Its index, from 0 at the surface.
    pub index: usize,
    /// The largest shear traction.
    pub shear: Option<Extreme<2>>,
    /// The largest tension.
    pub tension: Option<Extreme<2>>,
    /// The largest compression.
    pub compression: Option<Extreme<2>>,
}
