//! The case file: one problem in TOML, read into numbers and checked, every default filled in.

pub mod adhesion;
mod bare_value;
pub mod builder;
pub mod caller_shape;
mod flat;
pub mod foundation;
pub mod grid;
mod hardness;
pub mod height_limits;
pub mod indenter;
pub mod key_dimension;
pub mod load;
pub mod map;
pub mod map_sources;
pub mod output;
pub mod parameter;
pub mod parts;
pub mod periodic;
mod problem;
pub mod solver;
pub mod spring_law;
pub mod stress;
pub mod stressed_body;
pub mod surface;
pub mod unit_slip;
pub mod warnings;
pub mod wear;
pub mod with_units;

use std::borrow::Cow;
use std::path::Path;
use std::sync::Arc;

use serde::Serialize;

use self::adhesion::AdhesiveContacts;
use self::foundation::FoundationCase;
use self::grid::{BoundaryCase, GridCase};
use self::indenter::IndenterCase;
use self::load::LoadCase;
use self::map_sources::MapSources;
use self::output::OutputCase;
use self::solver::SolverCase;
use self::stress::StressCase;
use self::stressed_body::StressedBody;
use self::surface::SurfaceCase;
use self::wear::WearCase;
use crate::declare::{Field, Kinds, Presence, Record, Scope, Shape, TableShape};
use crate::error::Error;
use crate::input::diagnosis::Diagnosis;
use crate::input::document::Document;
use crate::input::overrides;
use crate::input::source_file;
use crate::input::span::Source;
use crate::input::table_reader::TableReader;
use crate::input::toml_tree::{self, TomlNode};
use crate::input::units::Units;
use crate::input::value_reader::ValueReader;

/// A problem as resolved: every default filled in, every value in SI units or the case's own consistent ones.
///
/// Written as TOML it is a case file again.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Case {
    /// Title; by default the name of the file.
    pub title: String,
    /// The elastic body.
    pub foundation: FoundationCase,
    /// The relief on it.
    pub surface: SurfaceCase,
    /// The indenter.
    pub indenter: IndenterCase,
    /// Force, nominal pressure or penetration, or a list of one of them.
    pub load: LoadCase,
    /// The grid.
    pub grid: GridCase,
    /// Tolerance and method.
    pub solver: SolverCase,
    /// The fields and pictures to write.
    pub output: OutputCase,
    /// The requested stresses, if any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stress: Option<StressCase>,
    /// The wear of the surface, if any.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wear: Option<WearCase>,
    /// The contacts with adhesion, if it has a work of adhesion.
    #[serde(skip)]
    pub adhesion: Option<AdhesiveContacts>,
    /// The system of units.
    #[serde(skip)]
    pub units: Units,
    /// The document it was read from.
    #[serde(skip)]
    pub document: Document,
}

/// A case file as it was read, to be resolved with many values of its keys.
#[derive(Debug, Clone)]
pub struct BaseCase {
    /// The tree of its text.
    pub root: TomlNode,
    /// Title of a case that has none of its own.
    name: String,
    /// Its maps, and the folder to which its file names are relative.
    maps: MapSources,
}

impl BaseCase {
    /// Reads the case file, with the values of `--set` in place of its own. It need not be a valid case yet.
    ///
    /// # Errors
    ///
    /// [`Error`] if the file cannot be read or is not TOML.
    pub fn read(path: &Path, sets: &[String]) -> Result<Self, Error> {
        let mut root = toml_tree::parse(&Arc::new(source_file::read(path)?))?;
        for argument in sets {
            overrides::set(&mut root, argument)?;
        }
        Ok(Self {
            root,
            name: source_file::stem(path),
            maps: MapSources::in_folder(path.parent().unwrap_or(Path::new(""))),
        })
    }

    /// Reads the text of a case whose maps come from `maps`; `name` is the title of a case that has none.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] if it is not TOML.
    pub fn parse(source: &Arc<Source>, name: &str, maps: MapSources) -> Result<Self, Diagnosis> {
        Ok(Self {
            root: toml_tree::parse(source)?,
            name: name.to_owned(),
            maps,
        })
    }

    /// The folder to which its file names are relative.
    #[must_use]
    pub fn folder(&self) -> &Path {
        self.maps.folder()
    }

    /// Resolves the case of `root`, which is the tree of this case with other values.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first fault.
    pub fn resolve(&self, root: &TomlNode) -> Result<Case, Diagnosis> {
        Case::resolve_with(root, &self.name, &self.maps)
    }
}

impl Case {
    /// The tables of a case and their fields.
    #[must_use]
    pub fn shape() -> TableShape {
        let mut case = TableShape::default();
        let mut add = |key, meaning, presence, shape| {
            let field = Field {
                key,
                meaning,
                shape,
                presence,
            };
            case.fields.push(field);
        };
        let or = |words: &str| Presence::Default(words.into());
        let required = || Presence::Required;
        let table = Shape::Table;
        add(
            "title",
            "title of the results",
            or("the name of the file"),
            Shape::Text,
        );
        add(
            "foundation",
            "the elastic body",
            required(),
            table(FoundationCase::shape()),
        );
        add(
            "surface",
            "the relief on it",
            or("none"),
            Shape::Kinds(SurfaceCase::shape()),
        );
        add(
            "indenter",
            "the body pressed in",
            required(),
            Shape::Kinds(IndenterCase::shape_of_table()),
        );
        add(
            "load",
            "force, nominal pressure or penetration",
            required(),
            table(LoadCase::shape()),
        );
        add(
            "grid",
            "the domain and its elements",
            or("its defaults"),
            table(GridCase::shape()),
        );
        add(
            "solver",
            "tolerance, method and hardness",
            or("its defaults"),
            table(SolverCase::shape()),
        );
        add(
            "output",
            "the fields and pictures to write",
            or("its defaults"),
            table(OutputCase::shape()),
        );
        add(
            "stress",
            "requests the stresses inside",
            or("no stresses"),
            table(StressCase::shape()),
        );
        add(
            "wear",
            "wears the surface over a sliding distance",
            or("no wear"),
            table(WearCase::shape()),
        );
        case
    }

    /// Reads the case file; maps that it names are sought in its folder.
    ///
    /// # Errors
    ///
    /// [`Error::Unreadable`] if the file cannot be read, [`Error::Case`] if it is not a valid case.
    pub fn from_toml(path: &Path) -> Result<Self, Error> {
        Self::read(path, &[])
    }

    /// Reads the case file, with the values of `--set` in place of its own.
    ///
    /// # Errors
    ///
    /// [`Error::Unreadable`] if the file cannot be read, [`Error::Case`] if it is not a valid case.
    pub fn read(path: &Path, sets: &[String]) -> Result<Self, Error> {
        let source = Arc::new(source_file::read(path)?);
        let stem = source_file::stem(path);
        let folder = path.parent().unwrap_or(Path::new(""));
        Ok(Self::parse(&source, &stem, folder, sets)?)
    }

    /// Reads the text of a case that names its files relative to `folder`.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first fault.
    pub fn parse(
        source: &Arc<Source>,
        name: &str,
        folder: &Path,
        sets: &[String],
    ) -> Result<Self, Diagnosis> {
        let mut root = toml_tree::parse(source)?;
        for argument in sets {
            overrides::set(&mut root, argument)?;
        }
        Self::resolve(&root, name, folder)
    }

    /// Reads a case from the tree of its text; `name` is its title if it has none of its own.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first fault.
    pub fn resolve(root: &TomlNode, name: &str, folder: &Path) -> Result<Self, Diagnosis> {
        Self::resolve_with(root, name, &MapSources::in_folder(folder))
    }

    /// Reads the text of a case whose maps come from `maps`.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first fault.
    pub fn parse_with(
        source: &Arc<Source>,
        name: &str,
        maps: &MapSources,
    ) -> Result<Self, Diagnosis> {
        Self::resolve_with(&toml_tree::parse(source)?, name, maps)
    }

    /// Reads a case from the tree of its text, its maps from `maps`.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first fault.
    pub fn resolve_with(root: &TomlNode, name: &str, maps: &MapSources) -> Result<Self, Diagnosis> {
        let table = TableReader::root(root)?;
        let shape = Self::shape();
        table.only(&shape.keys()).map_err(|diagnosis| {
            if table.optional("study").is_none() {
                return diagnosis;
            }
            diagnosis.with_help("a file with [study] is solved with `pellicle study FILE`")
        })?;
        let title = match table.optional("title") {
            Some(field) => field.text()?,
            None => name,
        };
        // One line for pictures, tables and terminals, without control characters.
        let title = title.replace(char::is_control, " ");
        bare_value::refuse(&table, &shape)?;
        let required = |key| table.required(key, &format!("a table [{key}]"))?.table();
        let optional = |key| table.optional(key).map(ValueReader::table).transpose();
        let mut scope = Scope {
            maps: Some(maps),
            ..Scope::default()
        };
        let foundation = FoundationCase::read(&required("foundation")?, &scope)?;
        scope.foundation = Some(&foundation);
        let mut surface = match optional("surface")? {
            Some(table) => SurfaceCase::read(&table, &scope)?,
            None => SurfaceCase::Bare,
        };
        let grid = read_or_default::<GridCase>(optional("grid")?, &scope)?;
        (scope.elements, scope.side) = (grid.elements, grid.longer_side());
        let output = read_or_default::<OutputCase>(optional("output")?, &scope)?;
        let mut indenter = IndenterCase::read(&required("indenter")?, &scope)?;
        if indenter.body.is_none() {
            foundation.refuse_rigid(&required("foundation")?)?;
        }
        let stress = optional("stress")?;
        let stress = stress.map(|table| StressCase::read_of(&table, Some(&indenter), &scope));
        let stress = stress.transpose()?;
        match (grid.boundary, grid.both_sides()) {
            (BoundaryCase::Periodic, Some(sides)) => {
                periodic::fit(&table, &foundation, sides, &mut surface, &mut indenter)?;
            }
            _ => periodic::refuse_nominal_pressure(&table)?,
        }
        if grid.boundary == BoundaryCase::Free {
            periodic::refuse_tapered(
                &table,
                [("surface", surface.map()), ("indenter", indenter.map())],
            )?;
        }
        flat::check(&table, &surface, &indenter, &grid)?;
        let given = [surface.map(), indenter.map()];
        let units = given.into_iter().flatten().map(|map| map.units);
        let units = units.fold(Units::of(root), Units::or);
        let solver = read_or_default::<SolverCase>(optional("solver")?, &scope)?;
        let load = LoadCase::read(&required("load")?, &scope)?;
        let stressed = stress.as_ref().map_or(&[][..], |stress| stress.body.each());
        let has_critical_loads =
            (stressed.iter()).any(|body| body.of(&foundation, Some(&indenter)).has_strengths());
        let bodies = (&foundation, &indenter, &solver);
        hardness::check(&table, bodies, &load, has_critical_loads)?;
        let of_bodies = || foundation.hardness_against(&indenter);
        let hardness = solver.hardness.or_else(of_bodies);
        adhesion::refuse(&table, (&surface, &load, &grid), hardness)?;
        let wear = optional("wear")?;
        let wear = wear
            .map(|table| WearCase::read(&table, &scope))
            .transpose()?;
        if let Some(wear) = &wear {
            wear::check(&table, wear, (&foundation, &surface, &load), hardness)?;
        }
        let adhesion = AdhesiveContacts::find(&table, (&foundation, &surface, &indenter), &load)?;
        Ok(Self {
            title,
            foundation,
            surface,
            indenter,
            load,
            grid,
            solver,
            output,
            stress,
            wear,
            adhesion,
            units,
            document: Document::new(root),
        })
    }

    /// The body inside which stresses are requested, by default the foundation; that of both has the planes.
    #[must_use]
    pub fn stressed(&self) -> Cow<'_, FoundationCase> {
        let body = self
            .stress
            .as_ref()
            .map_or_else(StressedBody::default, |stress| stress.body);
        body.of(&self.foundation, Some(&self.indenter))
    }
}

/// Reads a table, or takes the default if it is missing.
fn read_or_default<T: Record + Default>(
    table: Option<TableReader<'_>>,
    scope: &Scope<'_>,
) -> Result<T, Diagnosis> {
    table.map_or_else(|| Ok(T::default()), |table| T::read(&table, scope))
}

#[cfg(test)]
mod tests;
