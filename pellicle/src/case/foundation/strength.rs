//! Strengths: the largest stresses that a body and an interface bear.

use crate::declare::macros::record;
use crate::declare::{Codec, pressure};

record! {
    /// The strength of a body; each limit may be missing.
    #[derive(Copy, Default)]
    pub struct BodyStrengthCase {
        #[serde(skip_serializing_if = "Option::is_none")]
        yield_strength: Option<f64> = pressure().positive().optional("none"),
            "von Mises' stress at which the body yields";
        #[serde(skip_serializing_if = "Option::is_none")]
        tensile_strength: Option<f64> = pressure().positive().optional("none"),
            "largest principal stress that the body bears";
        #[serde(skip_serializing_if = "Option::is_none")]
        hardness: Option<f64> = pressure().positive().optional("none"),
            "contact pressure at which its surface yields; only of the topmost body";
    }
}

record! {
    /// The strength of the interface below a layer; each limit may be missing.
    #[derive(Copy, Default)]
    pub struct InterfaceStrengthCase {
        #[serde(skip_serializing_if = "Option::is_none")]
        interface_shear_strength: Option<f64> = pressure().positive().optional("none"),
            "shear traction at which the layer comes off";
        #[serde(skip_serializing_if = "Option::is_none")]
        interface_tensile_strength: Option<f64> = pressure().positive().optional("none"),
            "tension at which the layer comes off";
    }
}
