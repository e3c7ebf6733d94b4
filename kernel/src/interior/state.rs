//! Amplitudes of displacements and stresses of one wave, with their phases and signs.

/// One of the two bodies at an interface.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Side {
    /// The body above the interface.
    Above,
    /// The body below the interface.
    Below,
}

/// Amplitudes at one place under three loads on the surface, each of unit amplitude.
///
/// With `x` along the wave vector, `z` into the body and tension positive, the loads and fields are
///
/// ```text
/// load                                    pressure p = cos kx   traction along x: sin kx   traction along y: sin kx
/// on the surface                          σ_zz = −cos kx        σ_xz = −sin kx             σ_yz = −sin kx
/// u_x  = horizontal_displacement ·        sin kx                sin kx
/// u_z  = vertical_displacement ·          cos kx                cos kx
/// σ_xx = longitudinal_stress ·            cos kx                cos kx
/// σ_yy = transverse_stress ·              cos kx                cos kx
/// σ_zz = normal_stress ·                  cos kx                cos kx
/// σ_xz = shear_stress ·                   sin kx                sin kx
/// u_y  = displacement ·                                                                    sin kx
/// σ_yz = vertical_shear_stress ·                                                           sin kx
/// σ_xy = lateral_shear_stress ·                                                            cos kx
/// ```
///
/// Tractions act on the body: along `+x` and `+y` they drag the surface in that direction. Fields without an entry are
/// zero. In complex notation the fields under a pressure `e^{ikx}` have the factor `e^{ikx}` where the table has a
/// cosine and `−i e^{ikx}` where it has a sine; under a traction `e^{ikx}` along `x` or `y` they have `e^{ikx}` for a
/// sine and `i e^{ikx}` for a cosine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Amplitudes {
    /// Under a pressure.
    pub normal: InPlane,
    /// Under a traction along the wave vector.
    pub shear: InPlane,
    /// Under a traction across the wave vector.
    pub antiplane: Antiplane,
}

/// Amplitudes of plane strain, per unit amplitude of the load; phases and signs: [`Amplitudes`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InPlane {
    /// `u_x`, m/Pa, along the wave vector.
    pub horizontal_displacement: f64,
    /// `u_z`, m/Pa, into the body; under a pressure, on the surface, the compliance `C(k)`.
    pub vertical_displacement: f64,
    /// `σ_xx`, along the wave vector.
    pub longitudinal_stress: f64,
    /// `σ_yy = ν (σ_xx + σ_zz)`, across the wave vector.
    pub transverse_stress: f64,
    /// `σ_zz`; −1 on the surface under a pressure.
    pub normal_stress: f64,
    /// `σ_xz`; −1 on the surface under a traction along the wave vector.
    pub shear_stress: f64,
}

/// Amplitudes of antiplane strain, per unit amplitude of the load; phases and signs: [`Amplitudes`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Antiplane {
    /// `u_y`, m/Pa.
    pub displacement: f64,
    /// `σ_yz`; −1 on the surface.
    pub vertical_shear_stress: f64,
    /// `σ_xy`.
    pub lateral_shear_stress: f64,
}
