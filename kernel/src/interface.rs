//! How two bodies of a foundation touch.

/// The boundary between a layer and the body below it.
///
/// Both kinds are *bilateral*: the normal displacement is continuous, in tension as in
/// compression, so that the foundation stays linear and a layer cannot lift off. A layer on a
/// frictionless interface is therefore held normal to the surface at every wavenumber; in the
/// plane it slides freely, and only a wave of zero wavenumber (a rigid translation) could carry
/// it away, which a normal pressure never excites.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Interface {
    /// Displacements and tractions are continuous.
    #[default]
    Bonded,
    /// The shear traction is zero; normal displacement and traction are continuous.
    Frictionless,
}
