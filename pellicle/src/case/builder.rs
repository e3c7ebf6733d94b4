//! A case built in code from the types of the physics.
//!
//! It is written as a tree with units and read like a file, so that everything that holds for a file holds for it, and
//! its results are in SI units.

use std::path::Path;
use std::sync::Arc;

use serde::ser::Error as _;

use super::Case;
use super::foundation::FoundationCase;
use super::grid::{BoundaryCase, GridCase};
use super::indenter::IndenterCase;
use super::indenter::body::IndenterBody;
use super::load::LoadCase;
use super::output::OutputCase;
use super::solver::SolverCase;
use super::stress::StressCase;
use super::surface::SurfaceCase;
use super::with_units::with_units;
use crate::error::Error;
use crate::input::document::Document;
use crate::input::span::{CALL, Source};
use crate::input::units::Units;
use crate::monitor::Monitor;
use crate::run::Run;

/// A case being built. All numbers are in SI units; what is not given has the default of a case file.
#[derive(Debug, Clone)]
pub struct CaseBuilder(Case);

impl Case {
    /// Begins a case: a foundation, an indenter and a load, or several as `vec![Load::Force(1e-3), …]`, all of the
    /// same kind.
    pub fn build(
        foundation: impl Into<FoundationCase>,
        indenter: impl Into<IndenterCase>,
        load: impl Into<LoadCase>,
    ) -> CaseBuilder {
        CaseBuilder(Self {
            title: "case".into(),
            foundation: foundation.into(),
            surface: SurfaceCase::Bare,
            indenter: indenter.into(),
            load: load.into(),
            grid: GridCase::default(),
            solver: SolverCase::default(),
            output: OutputCase::default(),
            stress: None,
            wear: None,
            adhesion: None,
            units: Units::Si,
            document: Document::default(),
        })
    }
}

impl CaseBuilder {
    /// The title of the results.
    #[must_use]
    pub fn title(mut self, title: &str) -> Self {
        title.clone_into(&mut self.0.title);
        self
    }

    /// The relief on the body.
    #[must_use]
    pub fn surface(mut self, surface: impl Into<SurfaceCase>) -> Self {
        self.0.surface = surface.into();
        self
    }

    /// The elastic body of the indenter, a [`Material`](pellicle_kernel::Material) or layers as a
    /// [`Foundation`](pellicle_kernel::Foundation); it is rigid without one.
    #[must_use]
    pub fn elastic_indenter(mut self, body: impl Into<IndenterBody>) -> Self {
        self.0.indenter.body = Some(body.into());
        self
    }

    /// Elements per side.
    #[must_use]
    pub fn elements(mut self, elements: usize) -> Self {
        self.0.grid.elements = elements;
        self
    }

    /// Side of the domain, m; by default it is chosen from the load.
    #[must_use]
    pub fn side(mut self, side: f64) -> Self {
        self.0.grid.side = Some(side);
        self
    }

    /// A periodic cell of this side, m.
    #[must_use]
    pub fn periodic(mut self, side: f64) -> Self {
        self.0.grid.boundary = BoundaryCase::Periodic;
        self.side(side)
    }

    /// An oblong periodic cell of these sides along x and y, m; [elements](Self::elements) are those along the longer
    /// one.
    #[must_use]
    pub fn oblong(mut self, sides: [f64; 2]) -> Self {
        self.0.grid.boundary = BoundaryCase::Periodic;
        self.0.grid.sides = Some(sides);
        self
    }

    /// The pressure at which the surface yields, Pa.
    #[must_use]
    pub fn hardness(mut self, hardness: f64) -> Self {
        self.0.solver.hardness = Some(hardness);
        self
    }

    /// The stresses inside, with a coefficient of friction and a direction of sliding (rad, from +x to +y).
    #[must_use]
    pub fn stress(mut self, friction: f64, direction: f64) -> Self {
        self.0.stress = Some(StressCase {
            friction,
            direction,
            ..StressCase::default()
        });
        self
    }

    /// Any other field of the case, such as strengths of its layers.
    #[must_use]
    pub fn with(mut self, change: impl FnOnce(&mut Case)) -> Self {
        change(&mut self.0);
        self
    }

    /// The case, checked.
    ///
    /// # Errors
    ///
    /// [`Error::Case`] of the first key that is wrong.
    pub fn case(self) -> Result<Case, Error> {
        let tree = with_units(serde_json::to_value(&self.0)?);
        let text = toml::to_string(&tree).map_err(serde_json::Error::custom)?;
        let source = Arc::new(Source::new(format!("Case{CALL}"), text));
        Ok(Case::parse(&source, &self.0.title, Path::new(""), &[])?)
    }

    /// The case checked and solved, as by [`Case::solve`].
    ///
    /// # Errors
    ///
    /// Those of [`Self::case`] and [`Case::solve`].
    pub fn solve(self, monitor: &mut dyn Monitor) -> Result<Run, Error> {
        self.case()?.solve(monitor)
    }
}

#[cfg(test)]
mod tests {
    use pellicle_contact::{Cone, FlatPunch, Load, Paraboloid, PowerLaw, Pyramid, Sphere};
    use pellicle_kernel::{Foundation, Material};
    use pellicle_texture::Film;

    use super::*;
    use crate::case::foundation::strength::BodyStrengthCase;

    fn body() -> Foundation {
        let [coat, base] =
            [(300e9, 0.25), (210e9, 0.3)].map(|(e, nu)| Material::new(e, nu).unwrap());
        Foundation::coated(2e-6, coat, base).unwrap()
    }

    #[test]
    fn a_case_built_in_code_is_that_of_its_file() {
        let built = Case::build(body(), Cone::new(1.2, 1e-7).unwrap(), Load::Force(5e-3))
            .title("cone")
            .surface(Film::new(3e-9, 1.7e9).unwrap().stiffening())
            .elastic_indenter(Material::new(1141e9, 0.07).unwrap())
            .elements(64)
            .hardness(7e9)
            .case();
        let text = "title = \"cone\"\n[foundation]\n\
            substrate = { young_modulus = \"210 GPa\", poisson_ratio = 0.3 }\n\
            layer = [{ thickness = \"2 um\", young_modulus = \"300 GPa\", poisson_ratio = 0.25 }]\n\
            [surface]\nkind = \"film\"\nthickness = \"3 nm\"\nyoung_modulus = \"1.7 GPa\"\nlaw = \"logarithmic\"\n\
            [indenter]\nkind = \"cone\"\nhalf_angle = \"1.2 rad\"\ntip_radius = \"100 nm\"\n\
            young_modulus = \"1141 GPa\"\npoisson_ratio = 0.07\n\
            [load]\nforce = \"5 mN\"\n[grid]\nelements = 64\n[solver]\nhardness = \"7 GPa\"\n";
        let source = Arc::new(Source::new("cone.toml", text.to_owned()));
        assert_eq!(
            built.unwrap(),
            Case::parse(&source, "cone", Path::new(""), &[]).unwrap()
        );
    }

    #[test]
    fn every_shape_is_built_as_it_was() {
        let pyramid = Pyramid::cube_corner(1e-8).unwrap();
        let shapes: [(IndenterCase, pellicle_contact::Indenter); 6] = [
            (pyramid.clone().into(), pyramid.into()),
            (
                Pyramid::vickers(0.0).unwrap().into(),
                Pyramid::vickers(0.0).unwrap().into(),
            ),
            (
                Sphere::new(1e-3).unwrap().into(),
                Sphere::new(1e-3).unwrap().into(),
            ),
            (
                Paraboloid::new(1e-3).unwrap().into(),
                Paraboloid::new(1e-3).unwrap().into(),
            ),
            (
                PowerLaw::new(3.2, 1e-6).unwrap().into(),
                PowerLaw::new(3.2, 1e-6).unwrap().into(),
            ),
            (
                FlatPunch::new(1e-3).unwrap().into(),
                FlatPunch::new(1e-3).unwrap().into(),
            ),
        ];
        for (case, indenter) in shapes {
            let built = Case::build(body(), case, Load::Penetration(1e-8))
                .case()
                .unwrap();
            assert_eq!(built.indenter.build().unwrap(), indenter);
        }
    }

    #[test]
    fn a_fault_names_its_key_and_no_line() {
        let sphere = Sphere::new(1e-3).unwrap();
        let wrong = Case::build(body(), sphere, Load::Force(-1.0))
            .case()
            .unwrap_err();
        assert!(
            wrong
                .to_string()
                .starts_with("Case(…), key `load.force`: found"),
            "{wrong}"
        );
        let strength = BodyStrengthCase {
            yield_strength: Some(-1.0),
            ..BodyStrengthCase::default()
        };
        let wrong = Case::build(body(), sphere, Load::Force(1e-3))
            .with(|case| case.foundation.layer[0].strength = strength)
            .case()
            .unwrap_err();
        assert!(
            wrong
                .to_string()
                .contains("key `foundation.layer[0].yield_strength`"),
            "{wrong}"
        );
    }
}
