//! `[model]` of a fit file: a case, which supplies the fixed values and the starts.

use std::path::Path;
use std::sync::Arc;

use pellicle::case::Case;
use pellicle::case::map_sources::MapSources;
use pellicle::case::parameter::{CaseParameter, WORK_OF_ADHESION};
use pellicle::input::diagnosis::Diagnosis;
use pellicle::input::key_path;
use pellicle::input::overrides;
use pellicle::input::source_file;
use pellicle::input::span::Span;
use pellicle::input::toml_tree::{self, TomlEntry, TomlNode, TomlTable, TomlValue};
use pellicle::input::value_reader::ValueReader;
use pellicle_contact::adhesion::Adhesion;
use pellicle_contact::{ContactError, Model, ModelParameter};
use pellicle_influence::Cache;

use super::shape::model_file;

/// The kinds of indenters with one radius.
const ROUND: [&str; 3] = ["paraboloid", "sphere", "flat-punch"];

/// The model of a fit: the tree of a case, and its radial tables by shape.
#[derive(Debug, Clone)]
pub struct FitModel {
    root: TomlNode,
    maps: MapSources,
    name: String,
    cache: Cache,
}

/// The model of a case, and the parameters that can be fitted.
#[derive(Debug)]
pub struct ModelParameters {
    /// The model.
    pub model: Model,
    /// Its adhesion, if any.
    pub adhesion: Option<Adhesion>,
    /// The parameters.
    pub parameters: Vec<CaseParameter>,
}

impl FitModel {
    /// Reads the table: the path of a case, relative to the folder of the fit file, or the tables of a case, whose maps
    /// come from `maps`.
    ///
    /// # Errors
    ///
    /// An [`Error`](pellicle::Error) if the case does not exist or is invalid.
    pub fn read(field: &ValueReader<'_>, maps: &MapSources) -> Result<Self, pellicle::Error> {
        let table = field.clone().table()?;
        let cache = Cache::of_shapes();
        let (root, maps, name) = if let Some(case) = table.optional("case") {
            table.only(&model_file().keys())?;
            let path = maps.folder().join(case.text()?);
            let root = toml_tree::parse(&Arc::new(source_file::read(&path)?))?;
            let folder = path.parent().unwrap_or(Path::new(""));
            (
                root,
                MapSources::in_folder(folder),
                source_file::stem(&path),
            )
        } else {
            (field.node().clone(), maps.clone(), "model".to_owned())
        };
        let mut model = Self {
            root,
            maps,
            name,
            cache,
        };
        // A case has a load; a fit uses its adhesion only.
        if model.place_of("load").is_none() {
            model.replace_table("load", vec![("force", TomlValue::Float(1.0))]);
        }
        model.give_adhesion_a_load();
        Ok(model)
    }

    /// The place of a table of the case, if it has one of this key.
    pub(super) fn place_of(&self, key: &str) -> Option<Span> {
        let TomlValue::Table(root) = &self.root.value else {
            return None;
        };
        root.entry(key).map(|entry| entry.key_span.clone())
    }

    /// Replaces a table of the case by one of these values.
    pub(super) fn replace_table(&mut self, key: &str, values: Vec<(&str, TomlValue)>) {
        let span = self.root.span.clone();
        let TomlValue::Table(root) = &mut self.root.value else {
            return;
        };
        let entry = |key: &str, value: TomlValue| TomlEntry {
            key: key.to_owned(),
            key_span: span.clone(),
            node: TomlNode {
                value,
                span: span.clone(),
            },
        };
        let entries = values.into_iter().map(|(key, value)| entry(key, value));
        let table = TomlValue::Table(TomlTable {
            entries: entries.collect(),
        });
        root.entries.retain(|entry| entry.key != key);
        root.entries.push(entry(key, table));
    }

    /// Adds a penetration to a load that is but a work of adhesion: with adhesion there is a contact at none.
    fn give_adhesion_a_load(&mut self) {
        const ADHESION: [&str; 2] = ["work_of_adhesion", "adhesion"];
        let TomlValue::Table(root) = &mut self.root.value else {
            return;
        };
        let Some(load) = root.entry_mut("load") else {
            return;
        };
        let span = load.node.span.clone();
        let TomlValue::Table(load) = &mut load.node.value else {
            return;
        };
        let is_adhesion = |entry: &TomlEntry| ADHESION.contains(&entry.key.as_str());
        if !load.entries.is_empty() && load.entries.iter().all(is_adhesion) {
            load.entries.push(TomlEntry {
                key: "penetration".to_owned(),
                key_span: span.clone(),
                node: TomlNode {
                    value: TomlValue::Float(0.0),
                    span,
                },
            });
        }
    }

    /// Whether the indenter is of a kind with one radius, and has none.
    pub(super) fn lacks_radius(&self) -> bool {
        let TomlValue::Table(root) = &self.root.value else {
            return false;
        };
        let Some(TomlValue::Table(indenter)) = root.entry("indenter").map(|of| &of.node.value)
        else {
            return false;
        };
        let kind = indenter.entry("kind").map(|of| &of.node.value);
        let is_round = matches!(kind, Some(TomlValue::Text(kind)) if ROUND.contains(&&**kind));
        is_round && indenter.entry("radius").is_none()
    }

    /// Gives the indenter a radius.
    pub(super) fn give_radius(&mut self, radius: &str) {
        let TomlValue::Table(root) = &mut self.root.value else {
            return;
        };
        let Some(indenter) = root.entry_mut("indenter") else {
            return;
        };
        let span = indenter.node.span.clone();
        let TomlValue::Table(indenter) = &mut indenter.node.value else {
            return;
        };
        indenter.entries.push(TomlEntry {
            key: "radius".to_owned(),
            key_span: span.clone(),
            node: TomlNode {
                value: TomlValue::Text(radius.to_owned()),
                span,
            },
        });
    }

    /// Returns the model of the case with the values of some keys replaced.
    ///
    /// # Errors
    ///
    /// An [`Error`](pellicle::Error) if the resulting case is invalid.
    pub fn with(&self, set: &TomlTable) -> Result<ModelParameters, pellicle::Error> {
        let mut root = self.root.clone();
        for TomlEntry {
            key,
            key_span,
            node,
        } in &set.entries
        {
            overrides::replace(&mut root, key, key_span, node.clone())?;
        }
        let case = Case::resolve_with(&root, &self.name, &self.maps)?;
        if case.hardness().is_some() {
            return Err(case.blame(ContactError::WithHardness { what: "fits" }));
        }
        let model = case.model(&self.cache)?.value;
        let parameters = case.parameters(&model)?;
        let adhesion = case.load.work_of_adhesion.map(|work| Adhesion {
            work,
            law: case.load.adhesion.unwrap_or_default(),
        });
        Ok(ModelParameters {
            model,
            adhesion,
            parameters,
        })
    }

    /// Returns the model of the unchanged case.
    ///
    /// # Errors
    ///
    /// As [`Self::with`].
    pub fn parameters(&self) -> Result<ModelParameters, pellicle::Error> {
        self.with(&TomlTable::default())
    }
}

impl ModelParameters {
    /// Finds the parameter of a key, in any spelling.
    #[must_use]
    pub fn find(&self, key: &str) -> Option<&CaseParameter> {
        let path = key_path::parts(key)?;
        let is_wanted = |of: &&CaseParameter| key_path::parts(&of.key).as_ref() == Some(&path);
        self.parameters.iter().find(is_wanted)
    }

    /// The parameters of these keys.
    #[must_use]
    pub fn given_in(&self, set: &TomlTable) -> Vec<ModelParameter> {
        let found = set.entries.iter().filter_map(|entry| self.find(&entry.key));
        found.map(|of| of.parameter).collect()
    }

    /// Finds the parameter of a key that a fit file names.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] that lists the available parameters.
    pub fn required(
        &self,
        field: &ValueReader<'_>,
        key: &str,
    ) -> Result<&CaseParameter, Diagnosis> {
        let lacks_adhesion = key_path::parts(key) == key_path::parts(WORK_OF_ADHESION);
        if lacks_adhesion && self.adhesion.is_none() {
            return Err(field.unusable(
                &"without load.work_of_adhesion in the model",
                "it there as well, such as \"50 mJ/m^2\": the contact adheres, and the search starts there",
            ));
        }
        self.find(key).ok_or_else(|| {
            let keys: Vec<&str> = self.parameters.iter().map(|of| of.key.as_str()).collect();
            field.unknown_key(key, &keys)
        })
    }

    /// The radius of the indenter, if it has one.
    #[must_use]
    pub fn radius(&self) -> Option<&CaseParameter> {
        let keys = ["indenter.radius", "indenter.tip_radius"];
        keys.iter().find_map(|key| self.find(key))
    }

    /// The value of a parameter in the case.
    #[must_use]
    pub fn value(&self, of: &CaseParameter) -> Option<f64> {
        match of.parameter {
            ModelParameter::WorkOfAdhesion => self.adhesion.map(|adhesion| adhesion.work),
            parameter => self.model.parameter(parameter),
        }
    }
}
