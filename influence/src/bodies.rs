//! The two elastic bodies whose displacements under a pressure add up, and the directions in their parameters that
//! change the scale or preserve the compliance.

mod parameter;

pub use parameter::ElasticParameter;

use pellicle_kernel::{
    Base, Foundation, FoundationDirection, FoundationParameter, Layer, Material,
};

/// A foundation and the counterbody pressed against it, which may have layers too: an indenter much larger than the
/// contact. Either may be [rigid](Foundation::rigid); the compliances add.
#[derive(Clone, Debug, PartialEq)]
pub struct ElasticBodies {
    foundation: Foundation,
    counterbody: Foundation,
}

/// One of two bodies in contact.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default, Hash)]
pub enum ElasticBody {
    /// The foundation.
    #[default]
    Foundation,
    /// The body pressed against it, such as an indenter.
    Counterbody,
}

/// Rates of change `dθ/dt` of some parameters, each in its own unit.
pub type ElasticDirection = Vec<(ElasticParameter, f64)>;

impl ElasticBody {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Foundation, Self::Counterbody];

    /// The other one.
    #[must_use]
    pub fn other(self) -> Self {
        match self {
            Self::Foundation => Self::Counterbody,
            Self::Counterbody => Self::Foundation,
        }
    }
}

impl ElasticBodies {
    /// A foundation under a counterbody: another foundation, a material for a half-space, or `None::<Material>` if it
    /// is rigid.
    #[must_use]
    pub fn new(foundation: Foundation, counterbody: impl Into<Foundation>) -> Self {
        Self {
            foundation,
            counterbody: counterbody.into(),
        }
    }

    /// One of the two.
    #[must_use]
    pub fn of(&self, body: ElasticBody) -> &Foundation {
        match body {
            ElasticBody::Foundation => &self.foundation,
            ElasticBody::Counterbody => &self.counterbody,
        }
    }

    /// Both, the foundation first.
    #[must_use]
    pub fn each(&self) -> [&Foundation; 2] {
        [&self.foundation, &self.counterbody]
    }

    /// The foundation.
    #[must_use]
    pub fn foundation(&self) -> &Foundation {
        &self.foundation
    }

    /// The counterbody.
    #[must_use]
    pub fn counterbody(&self) -> &Foundation {
        &self.counterbody
    }

    /// The same bodies, the counterbody as the foundation.
    #[must_use]
    pub fn swapped(&self) -> Self {
        Self {
            foundation: self.counterbody.clone(),
            counterbody: self.foundation.clone(),
        }
    }

    /// Whether neither deforms.
    #[must_use]
    pub fn are_rigid(&self) -> bool {
        self.each().into_iter().all(Foundation::is_rigid)
    }

    /// Whether either has layers.
    #[must_use]
    pub fn have_layers(&self) -> bool {
        let has_layers = |body: &Foundation| !body.layers().is_empty();
        self.each().into_iter().any(has_layers)
    }

    /// `C(k)` of both bodies together, m/Pa, at the wavenumber `k` (1/m).
    #[must_use]
    pub fn compliance(&self, wavenumber: f64) -> f64 {
        self.foundation.compliance(wavenumber) + self.counterbody.compliance(wavenumber)
    }

    /// `E*` of the surfaces in contact, Pa: `1/E* = 1/E₁* + 1/E₂*` of the topmost materials.
    #[must_use]
    pub fn surface_modulus(&self) -> f64 {
        let [one, other] = self
            .each()
            .map(|body| body.surface_material().plane_strain_modulus());
        let (softer, stiffer) = if other < one {
            (other, one)
        } else {
            (one, other)
        };
        softer / (1.0 + softer / stiffer)
    }

    /// `E*` of the softest and of the stiffest materials of both bodies, Pa; a rigid base counts as none.
    #[must_use]
    pub fn modulus_range(&self) -> [f64; 2] {
        let compliances = self.each().map(|body| {
            let layers = body.layers().iter().map(Layer::material);
            let materials = layers
                .chain(body.base_material())
                .chain([body.surface_material()]);
            let compliances = materials.map(|material| 1.0 / material.plane_strain_modulus());
            compliances.fold([0.0, f64::INFINITY], |[most, least], of| {
                [f64::max(most, of), f64::min(least, of)]
            })
        });
        [0, 1].map(|end| 1.0 / (compliances[0][end] + compliances[1][end]))
    }

    /// `Φ − 1` of both together, `Σ E*/E_b* (Φ_b − 1)` with `E*` of the [surfaces](Self::surface_modulus), without
    /// cancellation.
    #[must_use]
    pub fn response_minus_one(&self, wavenumber: f64) -> f64 {
        let modulus = self.surface_modulus();
        let of_body = |body: &Foundation| {
            let own = body.surface_material().plane_strain_modulus();
            modulus / own * body.response_minus_one(wavenumber)
        };
        self.each().into_iter().map(of_body).sum()
    }

    /// Thickness of the thinner of the topmost layers, m; none without layers.
    #[must_use]
    pub fn thinnest_top(&self) -> Option<f64> {
        let top = |body: &Foundation| body.layers().first().map(Layer::thickness);
        self.each().into_iter().filter_map(top).reduce(f64::min)
    }

    /// Thickness of the layers of the body that has the thicker ones, m; 0 without layers.
    #[must_use]
    pub fn thickness(&self) -> f64 {
        let [foundation, counterbody] = self.each().map(Foundation::thickness);
        foundation.max(counterbody)
    }

    /// Displacement per uniform pressure on a cell that repeats, m/Pa, from the plane where displacements of that cell
    /// are measured.
    ///
    /// The mean displacement of a half-space is infinite and is left out, that of layers on it included. What remains
    /// is that of bodies on a rigid base, [`Foundation::confined_compliance`].
    #[must_use]
    pub fn mean_compliance(&self) -> f64 {
        let of_body = |body: &Foundation| match body.base() {
            Base::Rigid => body.confined_compliance(),
            Base::HalfSpace(_) => 0.0,
        };
        self.each().into_iter().map(of_body).sum()
    }

    /// Whether the mean displacement of a cell that repeats is finite: both bases are rigid.
    #[must_use]
    pub fn has_finite_mean(&self) -> bool {
        let is_finite = |body: &Foundation| body.base() == Base::Rigid;
        self.each().into_iter().all(is_finite)
    }

    /// The change of all parameters under a change of scale; see
    /// [`Foundation::scaling`](pellicle_kernel::Foundation::scaling).
    #[must_use]
    pub fn scaling(&self, length: f64, modulus: f64) -> ElasticDirection {
        let bodies = ElasticBody::ALL.into_iter();
        let of_bodies =
            bodies.flat_map(|body| within(body, self.of(body).scaling(length, modulus)));
        of_bodies.collect()
    }

    /// Changes that preserve the compliance of both bodies together at every wavenumber: those of
    /// [each](pellicle_kernel::Foundation::null_directions), on homogeneous bodies the change of both moduli at
    /// constant `1/E₁* + 1/E₂*`, and between equal bodies opposite changes of any parameter.
    #[must_use]
    pub fn null_directions(&self) -> Vec<ElasticDirection> {
        let own = |body: ElasticBody| {
            let directions = self.of(body).null_directions().into_iter();
            directions.map(move |direction| within(body, direction))
        };
        let of_foundation = own(ElasticBody::Foundation);
        if self.have_layers() && self.foundation == self.counterbody {
            // Those of the counterbody are differences of these.
            return of_foundation.chain(self.opposite_changes()).collect();
        }
        let of_counterbody = own(ElasticBody::Counterbody);
        let of_bodies = of_foundation.chain(of_counterbody);
        of_bodies.chain(self.exchange_of_moduli()).collect()
    }

    /// Opposite changes of a parameter of equal bodies.
    fn opposite_changes(&self) -> impl Iterator<Item = ElasticDirection> {
        let opposite = |of: FoundationParameter| {
            vec![
                (ElasticParameter::Foundation(of), 1.0),
                (ElasticParameter::Counterbody(of), -1.0),
            ]
        };
        self.foundation.parameters().into_iter().map(opposite)
    }

    /// The change of both moduli of homogeneous bodies at constant `1/E₁* + 1/E₂*`.
    fn exchange_of_moduli(&self) -> Option<ElasticDirection> {
        if self.have_layers() || self.each().into_iter().any(Foundation::is_rigid) {
            return None;
        }
        // dE/E = E* dt, dE_i/E_i = −E_i* dt
        let [surface, other] = self.each().map(Foundation::surface_material);
        let rate = |of: Material| {
            of.young_modulus() * of.plane_strain_modulus() / surface.plane_strain_modulus()
        };
        let modulus = FoundationParameter::YoungModulus { body: 0 };
        Some(vec![
            (ElasticParameter::Foundation(modulus), rate(surface)),
            (ElasticParameter::Counterbody(modulus), -rate(other)),
        ])
    }
}

fn within(body: ElasticBody, direction: FoundationDirection) -> ElasticDirection {
    let of_body = |(of, change)| (ElasticParameter::new(body, of), change);
    direction.into_iter().map(of_body).collect()
}

impl From<Foundation> for ElasticBodies {
    /// A foundation under a rigid counterbody.
    fn from(foundation: Foundation) -> Self {
        Self::new(foundation, Foundation::rigid())
    }
}
