//! A case built in code from the types of the physics.
//!
//! It is written as a tree with units and read like a file, so that everything that holds for a file holds for it, and
//! its results are in SI units.

use std::path::Path;
use std::sync::Arc;

use pellicle_contact::{Cone, FlatPunch, Load, Paraboloid, Pyramid, Sphere};
use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};
use pellicle_texture::{Cylinders, Film, Lattice, SpringLaw};

use serde::ser::Error as _;

use super::Case;
use super::foundation::FoundationCase;
use super::foundation::layer::{InterfaceCase, LayerCase, NamedInterface, SpringCase};
use super::foundation::modulus::ModulusCase;
use super::foundation::strength::{BodyStrengthCase, InterfaceStrengthCase};
use super::foundation::substrate::{MaterialCase, SubstrateCase};
use super::grid::{BoundaryCase, GridCase};
use super::indenter::{
    BerkovichCase, ConeCase, ElasticConstants, IndenterCase, IndenterShape, RoundCase, VickersCase,
};
use super::load::{LoadCase, LoadValues};
use super::output::OutputCase;
use super::solver::SolverCase;
use super::spring_law::LawCase;
use super::stress::StressCase;
use super::surface::{CylindersCase, FilmCase, LatticeCase, SurfaceCase};
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

    /// The material of the indenter, which is rigid without one.
    #[must_use]
    pub fn elastic_indenter(mut self, material: Material) -> Self {
        self.0.indenter.material = Some(ElasticConstants {
            young_modulus: material.young_modulus(),
            poisson_ratio: material.poisson_ratio(),
        });
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

impl From<Material> for MaterialCase {
    fn from(material: Material) -> Self {
        Self {
            young_modulus: material.young_modulus(),
            poisson_ratio: material.poisson_ratio(),
            strength: BodyStrengthCase::default(),
        }
    }
}

impl From<Layer> for LayerCase {
    fn from(layer: Layer) -> Self {
        let material = MaterialCase::from(layer.material());
        Self {
            thickness: layer.thickness(),
            young_modulus: ModulusCase::Uniform(material.young_modulus),
            poisson_ratio: material.poisson_ratio,
            interface: layer.interface().into(),
            strength: material.strength,
            interface_strength: InterfaceStrengthCase::default(),
        }
    }
}

impl From<Interface> for InterfaceCase {
    fn from(interface: Interface) -> Self {
        match interface {
            Interface::Bonded => Self::Named(NamedInterface::Bonded),
            Interface::Frictionless => Self::Named(NamedInterface::Frictionless),
            spring @ Interface::Spring(_) => Self::Spring(SpringCase {
                normal_compliance: spring.normal_compliance(),
                shear_compliance: spring.shear_compliance(),
            }),
        }
    }
}

impl From<Foundation> for FoundationCase {
    fn from(foundation: Foundation) -> Self {
        Self {
            substrate: match foundation.base() {
                Base::Rigid => SubstrateCase::Rigid,
                Base::HalfSpace(material) => SubstrateCase::Elastic(material.into()),
            },
            layer: foundation
                .layers()
                .iter()
                .map(|layer| (*layer).into())
                .collect(),
        }
    }
}

impl From<IndenterShape> for IndenterCase {
    fn from(shape: IndenterShape) -> Self {
        Self {
            shape,
            material: None,
        }
    }
}

impl From<Paraboloid> for IndenterCase {
    fn from(of: Paraboloid) -> Self {
        let radius = of.radius();
        IndenterShape::Paraboloid(RoundCase { radius }).into()
    }
}

impl From<Sphere> for IndenterCase {
    fn from(of: Sphere) -> Self {
        let radius = of.radius();
        IndenterShape::Sphere(RoundCase { radius }).into()
    }
}

impl From<FlatPunch> for IndenterCase {
    fn from(of: FlatPunch) -> Self {
        let radius = of.radius();
        IndenterShape::FlatPunch(RoundCase { radius }).into()
    }
}

impl From<Cone> for IndenterCase {
    fn from(of: Cone) -> Self {
        IndenterShape::Cone(ConeCase {
            half_angle: of.half_angle(),
            tip_radius: of.tip_radius(),
        })
        .into()
    }
}

impl From<Pyramid> for IndenterCase {
    fn from(of: Pyramid) -> Self {
        let (tip_radius, face_angle) = (of.tip_radius(), of.face_angle());
        if of.faces() == 4 {
            return IndenterShape::Vickers(VickersCase {
                tip_radius,
                face_angle,
            })
            .into();
        }
        IndenterShape::Berkovich(BerkovichCase {
            tip_radius,
            face_angle,
        })
        .into()
    }
}

impl From<Load> for LoadCase {
    fn from(load: Load) -> Self {
        let values = match load {
            Load::Force(force) => LoadValues::Force(force),
            Load::Penetration(depth) => LoadValues::Penetration(depth),
        };
        values.into()
    }
}

impl From<LoadValues> for LoadCase {
    fn from(values: LoadValues) -> Self {
        Self {
            values,
            sensitivities: false,
        }
    }
}

impl From<SpringLaw> for LawCase {
    fn from(law: SpringLaw) -> Self {
        if law == SpringLaw::LINEAR {
            Self::Linear
        } else {
            Self::Logarithmic
        }
    }
}

impl From<Film> for SurfaceCase {
    fn from(film: Film) -> Self {
        Self::Film(FilmCase {
            thickness: film.thickness(),
            young_modulus: film.young_modulus(),
            law: film.spring_law().into(),
        })
    }
}

impl From<Cylinders> for SurfaceCase {
    fn from(of: Cylinders) -> Self {
        Self::Cylinders(CylindersCase {
            radius: of.radius(),
            height: of.height(),
            period: of.period(),
            lattice: match of.lattice() {
                Lattice::Square => LatticeCase::Square,
                Lattice::Hexagonal => LatticeCase::Hexagonal,
            },
            offset: of.offset(),
            young_modulus: of.young_modulus(),
            law: of.spring_law().into(),
        })
    }
}

#[cfg(test)]
mod tests {
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
        let shapes: [(IndenterCase, pellicle_contact::Indenter); 5] = [
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
