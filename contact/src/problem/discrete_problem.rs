//! The contact problem on one grid in the form for solvers: an operator, `η`, `g0` and an element area.
//!
//! Find `p ≥ 0` and `D` with `g = K p + η p + g0 − D ≥ 0` and `p g = 0`: the conditions (2.1)–(2.2) of the paper in our
//! signs. The solution minimises the energy `½ p·(K + η) p + g0·p` over the pressures of the given force, or that
//! energy less `D Σ p` if the penetration is given. Springs with another [law](SpringLaw) have `w*(p)` instead of
//! `η p`, and `∫ w* dp` instead of `½ η p²`, which is also convex. With a hardness `p_max` the minimum is over
//! `0 ≤ p ≤ p_max`: where `p = p_max` the gap may be negative, and its absolute value is the plastic depth.

mod fields;
pub mod hardness;
mod part;

use std::sync::Arc;

use pellicle_influence::{ElasticOperator, SurfaceElasticity};
use pellicle_texture::SpringLaw;

use self::fields::{check_length, check_values, is_rough};
use crate::{
    Boundary, ContactError,
    grid::region::Region,
    problem::{
        gap_scale::GapScale,
        held_pressure::HeldPressure,
        relief_springs::ReliefSprings,
        scale::Scale,
        support::{Support, choice, divisible::Divisible},
    },
    vector::{each, update_with},
};

/// A unique token of a problem; clones are equal.
#[derive(Debug, Clone, Default)]
pub struct Identity(Arc<()>);

impl PartialEq for Identity {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

/// The problem on one grid. Fields hold N² values with index `i N + j`, the first index along x.
pub struct DiscreteProblem {
    support: Box<dyn Divisible>,
    springs: ReliefSprings,
    initial_gap: Vec<f64>,
    element_area: f64,
    /// `p_max`, in Pa; infinite without a limit.
    hardness: f64,
    /// The elements at the limit, while they are part of the load.
    held: Option<HeldPressure>,
    scale: Scale,
    identity: Identity,
}

impl DiscreteProblem {
    /// Creates a problem from the operator `K` (m/Pa on N² elements), the relief's compliance `η` (m/Pa, ≥ 0), the
    /// initial gap `g0` (m; +∞ on elements that cannot touch) and the area `4a²` of an element (m²).
    ///
    /// # Errors
    /// A field whose length is not N², a compliance that is negative or not finite, a gap that is NaN or −∞, an area
    /// that is not positive, or a gap that is infinite everywhere.
    pub fn new(
        operator: Box<dyn ElasticOperator>,
        relief_compliance: Vec<f64>,
        initial_gap: Vec<f64>,
        element_area: f64,
    ) -> Result<Self, ContactError> {
        let region = Region::whole(operator.size());
        let support = choice::given(operator, region);
        Self::on(support, relief_compliance, initial_gap, element_area)
    }

    /// Creates a problem on a grid of `size` elements per side with known elasticity, which lets solvers use regions
    /// and preconditioners; the other arguments as for [`Self::new`].
    ///
    /// # Errors
    /// As [`Self::new`].
    ///
    /// # Panics
    /// If `size` exceeds that of the elasticity.
    pub fn elastic(
        elasticity: Arc<SurfaceElasticity>,
        size: usize,
        relief_compliance: Vec<f64>,
        initial_gap: Vec<f64>,
        element_area: f64,
    ) -> Result<Self, ContactError> {
        assert!(size <= elasticity.size(), "a grid within the coefficients");
        let support = choice::under(elasticity, Region::whole(size));
        Self::on(support, relief_compliance, initial_gap, element_area)
    }

    /// Creates a problem on a periodic cell, which is the largest grid that the elasticity allows; the other arguments
    /// as for [`Self::new`].
    ///
    /// On a half-space displacements are relative to the mean plane of the deformed surface, so that a prescribed
    /// penetration means little. On a rigid base they are relative to the undeformed surface, and under an elastic
    /// indenter to the mean plane of its deformed surface.
    ///
    /// # Errors
    /// As [`Self::new`].
    pub fn periodic(
        elasticity: Arc<SurfaceElasticity>,
        relief_compliance: Vec<f64>,
        initial_gap: Vec<f64>,
        element_area: f64,
    ) -> Result<Self, ContactError> {
        let region = Region::domain(elasticity.size(), Boundary::Periodic);
        let support = choice::under(elasticity, region);
        Self::on(support, relief_compliance, initial_gap, element_area)
    }

    /// Creates the problem on all elements of a support's region, with their fields and the area of one element.
    pub(crate) fn on(
        mut support: Box<dyn Divisible>,
        relief_compliance: Vec<f64>,
        initial_gap: Vec<f64>,
        element_area: f64,
    ) -> Result<Self, ContactError> {
        let elements = support.region().elements();
        check_length("relief compliance", relief_compliance.len(), elements)?;
        check_length("initial gap", initial_gap.len(), elements)?;
        check_values(
            "relief compliance",
            &relief_compliance,
            "finite and ≥ 0",
            |eta| eta >= 0.0 && eta.is_finite(),
        )?;
        check_values("initial gap", &initial_gap, "a number or +∞", |gap| {
            gap > f64::NEG_INFINITY
        })?;
        if !(element_area > 0.0 && element_area.is_finite()) {
            return Err(ContactError::ElementArea { area: element_area });
        }
        if initial_gap.iter().all(|gap| gap.is_infinite()) {
            return Err(ContactError::NothingCanTouch { elements });
        }
        let loaded_area = support.weight() as f64 * element_area;
        Ok(Self {
            scale: Scale::new(loaded_area.sqrt(), support.own_coefficient()),
            support,
            springs: ReliefSprings::new(SpringLaw::LINEAR, relief_compliance),
            initial_gap,
            element_area,
            hardness: f64::INFINITY,
            held: None,
            identity: Identity::default(),
        })
    }

    /// The same problem with another spring law; the relief's compliance is that at rest.
    #[must_use]
    pub fn with_spring_law(mut self, spring_law: SpringLaw) -> Self {
        self.springs.take_law(spring_law);
        self.identity = Identity::default();
        self
    }

    /// The elasticity from which the operator is built, if known.
    #[must_use]
    pub fn elasticity(&self) -> Option<&Arc<SurfaceElasticity>> {
        self.support.elasticity()
    }

    /// Replaces the initial gap, in m.
    pub(crate) fn take_initial_gap(&mut self, initial_gap: Vec<f64>) {
        assert_eq!(initial_gap.len(), self.elements());
        (self.initial_gap, self.identity) = (initial_gap, Identity::default());
    }

    /// Replaces the relief: the compliance of its springs at rest (m/Pa) and the initial gap (m).
    pub(crate) fn take_relief(&mut self, compliance: Vec<f64>, initial_gap: Vec<f64>) {
        assert_eq!(compliance.len(), self.elements());
        self.springs = ReliefSprings::new(self.springs.law(), compliance);
        self.take_initial_gap(initial_gap);
    }

    /// The ratio of the body's compliances to waves as long as the grid and to the shortest, relative to a homogeneous
    /// body; 1 if the elasticity is unknown.
    pub(crate) fn stiffness_contrast(&self) -> f64 {
        let per_wavelength = |elasticity: &Arc<SurfaceElasticity>, elements: usize| {
            elasticity.cell_response(elements) / elements as f64
        };
        self.elasticity().map_or(1.0, |elasticity| {
            per_wavelength(elasticity, elasticity.size()) / per_wavelength(elasticity, 2)
        })
    }

    /// The units in which the problem's quantities are of order 1, apart from the effect of the load.
    pub(crate) fn scale(&self) -> Scale {
        self.scale
    }

    /// A unique token by which a solver recognises that data kept from the previous load belong to this problem.
    #[must_use]
    pub fn identity(&self) -> &Identity {
        &self.identity
    }

    /// Where its pressures live.
    pub(crate) fn support(&self) -> &dyn Support {
        &*self.support
    }

    /// The same, for products on parts of it.
    pub(crate) fn support_mut(&mut self) -> &mut dyn Divisible {
        &mut *self.support
    }

    /// All of the region that holds its elements.
    pub(crate) fn region(&self) -> Region {
        *self.support.region()
    }

    /// The scale of gaps, in SI units.
    pub(crate) fn gap_scale(&self) -> GapScale {
        self.support.gap_scale()
    }

    /// Elements per row, N.
    #[must_use]
    pub fn size(&self) -> usize {
        self.support.region().size()
    }

    /// Number of elements; N² for a square.
    #[must_use]
    pub fn elements(&self) -> usize {
        self.initial_gap.len()
    }

    /// The law of the relief's springs.
    #[must_use]
    pub fn spring_law(&self) -> SpringLaw {
        self.springs.law()
    }

    /// The springs under its elements.
    pub(crate) fn springs(&self) -> &ReliefSprings {
        &self.springs
    }

    /// The relief's compliance at rest `η`, in m/Pa.
    #[must_use]
    pub fn relief_compliance(&self) -> &[f64] {
        self.springs.relief()
    }

    /// Adds linear springs of this compliance (m/Pa) to all elements, or removes them if it is 0.
    pub(crate) fn soften(&mut self, compliance: f64) {
        if self.springs.soften(compliance) {
            self.identity = Identity::default();
        }
    }

    /// `κ` (m/Pa), the displacement of an element by opposite pressures on it and on a neighbour; by a pressure on it
    /// alone if the elasticity is unknown.
    pub(crate) fn shortest_compliance(&self) -> f64 {
        let elasticity = self.elasticity();
        elasticity.map_or(self.scale.compliance, |elasticity| {
            elasticity.coefficient([0, 0]) - elasticity.coefficient([1, 0])
        })
    }

    /// The initial gap `g0 = f − f*`, in m.
    #[must_use]
    pub fn initial_gap(&self) -> &[f64] {
        (self.held.as_ref()).map_or(&self.initial_gap, |held| &held.gap)
    }

    /// The initial gap without the displacement by held elements, in m.
    pub(crate) fn own_gap(&self) -> &[f64] {
        &self.initial_gap
    }

    /// Whether the surface is [rough](is_rough).
    pub(crate) fn is_rough(&self) -> bool {
        is_rough(self.size(), &self.initial_gap)
    }

    /// The area `4a²` of an element, in m².
    #[must_use]
    pub fn element_area(&self) -> f64 {
        self.element_area
    }

    /// The area on which one value of the pressure acts, in m²: an element and its mirror images. `Q = area Σ p`.
    #[must_use]
    pub fn loaded_area(&self) -> f64 {
        self.support.weight() as f64 * self.element_area
    }

    /// The operator `K`; exclusive, because a product uses the operator's own buffers.
    pub fn operator_mut(&mut self) -> &mut dyn ElasticOperator {
        &mut *self.support
    }

    /// Writes `K p` (m) of a pressure (Pa) on the problem's elements.
    pub(crate) fn displace(&mut self, pressure: &[f64], displacement: &mut [f64]) {
        self.support.apply_into(pressure, displacement);
    }

    /// Lower bound (m) of the displacement at this distance in elements or more from pressures ≥ 0 with this sum:
    /// `min(0, min k) Σ p` over all images; −∞ if the elasticity is unknown.
    pub(crate) fn least_displacement(&self, total: f64, distance: usize) -> f64 {
        let images = self.support.weight() as f64;
        self.elasticity().map_or(f64::NEG_INFINITY, |elasticity| {
            images * total * elasticity.least_coefficient_from(distance).min(0.0)
        })
    }

    /// Linearises nonlinear springs at a pressure ≥ 0, in the units of the problem's scale.
    pub(crate) fn linearise_springs(&mut self, pressure: &[f64]) {
        self.springs.linearise(self.scale, pressure);
    }

    /// Writes `K p + w*(p)` (m) of the pressure `p` (Pa) into `deformation`, `(K + η) p` on linear springs: one product
    /// with `K`.
    pub fn deform_into(&mut self, pressure: &[f64], deformation: &mut [f64]) {
        self.displace(pressure, deformation);
        self.springs.shorten_into(pressure, deformation);
    }

    /// Writes `(K + η) p` of the linear problem into `deformation`, both in the units of the problem's
    /// [scale](Self::scale).
    pub(crate) fn deform_to_scale(&mut self, pressure: &[f64], deformation: &mut [f64]) {
        let per_unit = 1.0 / self.scale.compliance;
        self.displace(pressure, deformation);
        if self.springs.are_rigid() {
            return each(deformation, |v| *v *= per_unit);
        }
        let compliance = self.springs.compliance();
        update_with(deformation, compliance, pressure, |v, eta, p| {
            *v = (*v + eta * p) * per_unit;
        });
    }
}

#[cfg(test)]
mod tests;
