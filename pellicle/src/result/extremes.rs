//! The extremes of the stresses in a body or on an interface, as numbers of a result.

use pellicle_contact::{
    BodyStress, BodyUtilisation, Extreme, InterfaceStress, InterfaceUtilisation, StressQuantity,
};

/// An extreme of a body or an interface `P`, at a point with this many axes, and the strength that limits it.
#[derive(Debug, Clone, Copy)]
pub struct StressExtreme<P: 'static, U: 'static, const AXES: usize> {
    /// The quantity, whose name is its key in `summary.json`.
    pub quantity: StressQuantity,
    /// Its name in words, as in tables.
    pub name: &'static str,
    /// Its meaning, in words.
    pub meaning: &'static str,
    /// Its value; none if it is not wanted.
    pub value: fn(&P) -> Option<Extreme<AXES>>,
    /// The strength that limits it, if any does.
    pub limit: Option<Limit<U>>,
}

/// A strength that limits an extreme.
#[derive(Debug, Clone, Copy)]
pub struct Limit<U: 'static> {
    /// Its name.
    pub strength: &'static str,
    /// The ratio of the extreme to it; none if it is not given.
    pub used: fn(&U) -> Option<f64>,
}

/// Those of a body.
pub const OF_BODIES: &[StressExtreme<BodyStress, BodyUtilisation, 3>] = &[
    StressExtreme {
        quantity: StressQuantity::VonMises,
        name: "max von Mises",
        meaning: "largest von Mises stress",
        value: |body| body.max_von_mises,
        limit: Some(Limit {
            strength: "yield",
            used: |used| used.yielding,
        }),
    },
    StressExtreme {
        quantity: StressQuantity::MaxPrincipal,
        name: "max principal",
        meaning: "largest principal stress, tension positive",
        value: |body| body.max_principal,
        limit: Some(Limit {
            strength: "tensile",
            used: |used| used.tension,
        }),
    },
    StressExtreme {
        quantity: StressQuantity::MinPrincipal,
        name: "min principal",
        meaning: "least principal stress, tension positive",
        value: |body| body.min_principal,
        limit: None,
    },
    StressExtreme {
        quantity: StressQuantity::MaxShear,
        name: "max shear",
        meaning: "Tresca's largest shear, half the difference of the principal stresses",
        value: |body| body.max_shear,
        limit: None,
    },
];

/// Those of an interface.
pub const OF_INTERFACES: &[StressExtreme<InterfaceStress, InterfaceUtilisation, 2>] = &[
    StressExtreme {
        quantity: StressQuantity::ShearTraction,
        name: "max shear traction",
        meaning: "largest traction along the interface",
        value: |interface| interface.max_shear_traction,
        limit: Some(Limit {
            strength: "shear",
            used: |used| used.shear,
        }),
    },
    StressExtreme {
        quantity: StressQuantity::Tension,
        name: "max tension",
        meaning: "largest normal stress, 0 without tension",
        value: |interface| interface.max_tension,
        limit: Some(Limit {
            strength: "tensile",
            used: |used| used.tension,
        }),
    },
    StressExtreme {
        quantity: StressQuantity::Compression,
        name: "max compression",
        meaning: "largest pressure on the interface",
        value: |interface| interface.max_compression,
        limit: None,
    },
];
