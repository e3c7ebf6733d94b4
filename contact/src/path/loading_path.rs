//! A solved path, and what follows from its steps: the surface under each, and the contact seen from either body.

use std::sync::Arc;

use pellicle_influence::{CoefficientTable, ElasticBody, Origin, RadialTables, SurfaceElasticity};
use pellicle_texture::{Grid, Relief};

use crate::{
    Boundary, DeformedSurface, Indenter, SampledModel, Solution, Step, Warning,
    grid::region::Region,
    problem::{model::initial_gap, support::choice::under},
    vector::add_scaled,
};

/// A solved path.
#[derive(Debug, Clone)]
pub struct LoadingPath {
    /// The finest grid.
    pub grid: Grid,
    /// One step per load, in the order given.
    pub steps: Vec<Step>,
    /// Warnings to the user.
    pub warnings: Vec<Warning>,
    /// Time spent on coefficients and geometry of all grids while no load was being solved, in s; excludes the radial
    /// tables, which are built earlier.
    pub coefficients_seconds: f64,
    /// Origin of the coefficients of all grids together; excludes the radial tables.
    pub coefficients_origin: Origin,
    /// Time spent in solvers, in s; less than the sum over the steps if several were solved at once.
    pub solve_seconds: f64,
    /// Whether the observer cancelled; then only the loads before the first unfinished one are included.
    pub interrupted: bool,
    /// The foundation and the indenter's body, with their radial tables.
    pub tables: Arc<RadialTables>,
    /// The boundary condition of the square.
    pub boundary: Boundary,
    /// Hardness that limits the pressure, in Pa; infinite without one.
    pub hardness: f64,
    /// None if no load reached the finest grid.
    pub(super) elasticity: Option<Arc<SurfaceElasticity>>,
    pub(crate) relief: Relief,
    pub(crate) indenter: Indenter,
}

impl LoadingPath {
    /// This path without its steps, and these.
    pub(crate) fn take_steps(mut self) -> (Self, Vec<Step>) {
        let steps = std::mem::take(&mut self.steps);
        (self, steps)
    }

    /// Adds the step of another path on the same grid, with its time.
    pub(crate) fn append(&mut self, step: Step, other: &Self) {
        self.steps.push(step);
        self.coefficients_seconds += other.coefficients_seconds;
        self.solve_seconds += other.solve_seconds;
    }

    /// Samples relief and indenter on the finest grid; a path does not store them.
    #[must_use]
    pub fn geometry(&self) -> SampledModel {
        SampledModel::on(self.grid, &self.relief, &self.indenter)
    }

    /// Computes the surface at a step, with the displacement of the foundation alone, from its pressure and the path's
    /// [geometry](Self::geometry) by one product with `K`. A path stores only the pressures, which take a quarter of
    /// the memory. None if there is no such step.
    ///
    /// # Panics
    /// If the geometry is that of another grid.
    #[must_use]
    pub fn surface(&self, geometry: &SampledModel, step: usize) -> Option<DeformedSurface> {
        assert_eq!(geometry.grid, self.grid, "geometry on the path's grid");
        let elasticity = self.elasticity.as_ref()?;
        let Solution {
            pressure,
            penetration,
            ..
        } = &self.steps.get(step)?.solution;
        let all = Region::of_grid(&self.grid, self.boundary);
        let displacement = displacement_of(elasticity.clone(), &all, pressure);
        let relief = &geometry.relief;
        let worn = (self.steps[step].wear.as_ref()).map(|wear| wear.applied(&self.relief, relief));
        let (profile, compliance) = match &worn {
            Some(worn) => (&worn.profile[..], &worn.compliance[..]),
            None => (relief.profile(), relief.compliance()),
        };
        let mut surface = DeformedSurface::new(
            displacement,
            (pressure, self.hardness),
            (relief.spring_law(), compliance),
            &initial_gap(&geometry.indenter_profile, profile),
            *penetration,
        );
        surface.worn_profile = worn.map_or(Vec::new(), |worn| worn.profile);
        if let Some(counterbody) = self.alone(ElasticBody::Counterbody) {
            let own = displacement_of(Arc::new(counterbody), &all, pressure);
            add_scaled(&mut surface.displacement, -1.0, &own);
        }
        Some(surface)
    }

    /// The elasticity of one body alone; none if it is rigid.
    fn alone(&self, body: ElasticBody) -> Option<SurfaceElasticity> {
        let foundation = self.tables.bodies().of(body);
        if foundation.is_rigid() {
            return None;
        }
        let side = self.grid.element_side();
        let coefficient = |offset| self.tables.coefficient_of(body, side, offset);
        let table = CoefficientTable::from_fn(side, self.grid.size(), coefficient).ok()?;
        Some(SurfaceElasticity::new(Arc::new(table), foundation.clone()))
    }

    /// The same contact seen from one of its bodies, which becomes the foundation: the same pressures, and the stresses
    /// inside that body.
    #[must_use]
    pub fn seen_from(&self, body: ElasticBody) -> Self {
        let mut path = self.clone();
        if body == ElasticBody::Counterbody {
            path.tables = Arc::new(self.tables.swapped());
        }
        path
    }
}

/// Computes `K p` (m) of a pressure (Pa) on all of a region.
fn displacement_of(elasticity: Arc<SurfaceElasticity>, all: &Region, pressure: &[f64]) -> Vec<f64> {
    let mut displacement = vec![0.0; pressure.len()];
    let part = all.around_pressing(pressure).unwrap_or(*all);
    let mut body = under(elasticity, *all);
    body.apply_around([&part, all], &part.cut(pressure), &mut displacement);
    displacement
}
