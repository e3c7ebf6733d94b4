//! Measured curves: the readings of an instrument, their model, how finely the model is solved for them, and a request
//! to stop.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use pellicle_contact::adhesion::Adhesion;
use pellicle_contact::{Model, ModelParameter};
use serde::{Deserialize, Serialize};

/// All measured curves of one model, taken under the same conditions.
#[derive(Debug, Clone)]
pub struct ContactCurve {
    /// The model, with the values of the parameters that are not sought and of those in `own`.
    pub model: Model,
    /// The measured quantity and its abscissa.
    pub observable: Observable,
    /// Abscissae of all points (N or m), in the order of the measurement.
    pub abscissae: Vec<f64>,
    /// Parameters for which these curves have their own value, and which are not sought here.
    pub own: Vec<ModelParameter>,
    /// Where the abscissa of each point begins, as far as is known before a fit: the contact is solved at loads that
    /// cover the abscissae counted from there. Empty for zeros.
    pub origins: Vec<f64>,
    /// Compliance in series with the contact, m/N, zero for none: that of a cantilever, whose end approaches the body
    /// by `D + F/k`. Forces are then observed at approaches, which have no noise of the force in them, and penetrations
    /// at forces, `z − F/k`, have it twice.
    pub series: f64,
    /// What the imprints under unloadings have displaced of the top layer, if that is allowed for.
    pub thinned: Option<Thinned>,
    /// Adhesion, of a work that the parameters may replace; none for a contact without. The curve is then the branch
    /// from the jump-out on: points before it do not belong here.
    pub adhesion: Option<Adhesion>,
}

/// What imprints have displaced of a layer.
#[derive(Debug, Clone, PartialEq)]
pub struct Thinned {
    /// The thickness of the layer.
    pub thickness: ModelParameter,
    /// What is taken off it at each point, m.
    pub off: Vec<f64>,
}

impl ContactCurve {
    /// Whether a parameter belongs to the model or its adhesion.
    #[must_use]
    pub fn has(&self, parameter: ModelParameter) -> bool {
        match parameter {
            ModelParameter::WorkOfAdhesion => self.adhesion.is_some(),
            _ => self.model.parameter(parameter).is_some(),
        }
    }

    /// The abscissae of all points, counted from these origins; no origins are zeros.
    pub(super) fn abscissae_from(&self, origins: &[f64]) -> Vec<f64> {
        let mut abscissae = self.abscissae.clone();
        let pairs = abscissae.iter_mut().zip(origins);
        pairs.for_each(|(abscissa, origin)| *abscissa -= origin);
        abscissae
    }
}

/// The measured quantity and its abscissa.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Observable {
    /// The penetration (m) at forces (N).
    #[default]
    #[serde(rename = "depth at force")]
    DepthAtForce,
    /// The force (N) at penetrations (m), or at approaches (m) where there is a compliance in series.
    #[serde(rename = "force at depth")]
    ForceAtDepth,
    /// The contact stiffness `dQ/dD` (N/m) at contact radii (m), `√(A/π)` of the contact area A. For indenters of
    /// revolution it does not depend on their shape: it is the stiffness of a flat punch of that radius. For a
    /// Berkovich pyramid it is larger, by 9 % where the tip is round and by 18 % beyond.
    #[serde(rename = "stiffness at contact radius")]
    StiffnessAtContactRadius,
    /// The contact stiffness `S = dQ/dD` (N/m) at forces (N): neither the zero of the depth nor an area enters.
    #[serde(rename = "stiffness at force")]
    StiffnessAtForce,
    /// The contact stiffness `S = dQ/dD` (N/m) at penetrations (m).
    #[serde(rename = "stiffness at depth")]
    StiffnessAtDepth,
    /// The contact stiffness (N/m) at the beginning of unloadings, at the radii (m) of their contacts: that of a flat
    /// punch, as an imprint nearly fits its indenter (R. B. King, Int. J. Solids Struct. 23, 1657 (1987)).
    #[serde(rename = "unloading")]
    UnloadingStiffness,
}

/// A quantity of a contact that an instrument reads.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reading {
    /// The force, N.
    Force,
    /// The penetration, m.
    Depth,
    /// `√(A/π)` of the contact area A, m.
    ContactRadius,
    /// The contact stiffness `dQ/dD`, N/m.
    Stiffness,
}

impl Observable {
    /// Every observable, with the words that name it in a fit file.
    pub const ALL: [(&'static str, Self); 6] = [
        ("depth at force", Self::DepthAtForce),
        ("force at depth", Self::ForceAtDepth),
        ("stiffness at depth", Self::StiffnessAtDepth),
        ("stiffness at force", Self::StiffnessAtForce),
        (
            "stiffness at contact radius",
            Self::StiffnessAtContactRadius,
        ),
        ("unloading", Self::UnloadingStiffness),
    ];

    /// The quantity at whose values the other one is observed.
    #[must_use]
    pub fn abscissa(self) -> Reading {
        match self {
            Self::DepthAtForce | Self::StiffnessAtForce => Reading::Force,
            Self::ForceAtDepth | Self::StiffnessAtDepth => Reading::Depth,
            Self::StiffnessAtContactRadius | Self::UnloadingStiffness => Reading::ContactRadius,
        }
    }

    /// The observed quantity.
    #[must_use]
    pub fn observed(self) -> Reading {
        match self {
            Self::DepthAtForce => Reading::Depth,
            Self::ForceAtDepth => Reading::Force,
            Self::StiffnessAtContactRadius
            | Self::StiffnessAtForce
            | Self::StiffnessAtDepth
            | Self::UnloadingStiffness => Reading::Stiffness,
        }
    }
}

impl Reading {
    /// Its name: `contact radius`.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Force => "force",
            Self::Depth => "depth",
            Self::ContactRadius => "contact radius",
            Self::Stiffness => "stiffness",
        }
    }

    /// Its SI unit.
    #[must_use]
    pub fn unit(self) -> &'static str {
        match self {
            Self::Force => "N",
            Self::Depth | Self::ContactRadius => "m",
            Self::Stiffness => "N/m",
        }
    }
}

/// How the curves are computed.
#[derive(Debug, Clone)]
pub struct CurveOptions {
    /// Elements per side of the finer of the two grids; even.
    pub elements: usize,
    /// Loads per decade of the force at which the contact is solved; without a grid, per factor e in its radius.
    pub loads_per_decade: f64,
    /// Checked before each load of a prediction, which ends with
    /// [`ForwardError::Stopped`](crate::ForwardError::Stopped) once it is raised.
    pub stop: StopFlag,
}

impl Default for CurveOptions {
    /// 64 elements and six loads per decade: errors of 1e-5 of D for paraboloids, 5e-4 for rounded pyramids
    /// (`tests/contact_curves.rs`).
    fn default() -> Self {
        Self {
            elements: 64,
            loads_per_decade: 6.0,
            stop: StopFlag::default(),
        }
    }
}

/// A request to end the work; all clones share the same flag.
#[derive(Debug, Clone, Default)]
pub struct StopFlag(Arc<AtomicBool>);

impl StopFlag {
    /// Asks the work to end. Returns whether this is the first request.
    #[must_use = "the work may have been stopped already"]
    pub fn raise(&self) -> bool {
        !self.0.swap(true, Ordering::SeqCst)
    }

    /// Whether the work should end.
    #[must_use]
    pub fn is_raised(&self) -> bool {
        self.0.load(Ordering::SeqCst)
    }
}
