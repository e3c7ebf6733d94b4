//! Warnings about a case that can be solved but may not be what its user meant.

mod maps;

use pellicle_contact::{CutOff, Warning};
use pellicle_influence::ElasticBody;

use super::Case;
use super::adhesion::AdhesiveContacts;
use super::foundation::layer::LayerCase;
use super::key_dimension;
use super::stressed_body::StressedBody;
use crate::input::dimension::Dimension;
use crate::input::key_path::dotted;
use crate::input::span::CALL;
use crate::input::toml_tree::{TomlNode, TomlTable, TomlValue};
use crate::input::units::Units;

/// A warning about a case.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CaseWarning {
    /// A short name, for programs.
    pub code: &'static str,
    /// A sentence, for human readers.
    pub message: String,
}

/// The sentence of a warning about the solution, with the key to change.
fn with_key(warning: &Warning) -> String {
    let key = match warning {
        Warning::DomainEdge { .. }
        | Warning::DomainMuchLarger { .. }
        | Warning::CutOff {
            by: CutOff::Domain, ..
        } => "grid.side",
        Warning::FilmShortening { .. } => "surface.law",
        Warning::MapUnderResolved { .. } => "grid.elements",
        _ => return warning.to_string(),
    };
    format!("{warning} (`{key}`)")
}

/// The unit of a bare number in a case that has units, by its path; none where a bare number is usual: the length
/// that 1 in a file of heights stands for.
fn bare_unit(path: &str) -> Option<&'static str> {
    let is_usual = ["height_unit", "lateral_unit"]
        .iter()
        .any(|key| path.ends_with(key));
    let dimension = key_dimension::of_path(path).filter(|_| !is_usual);
    dimension.map(Dimension::si_unit)
}

impl Case {
    /// The sentence of a warning about the solution, with the key to change, or the case's own name of a body.
    #[must_use]
    pub fn sentence(&self, warning: &Warning) -> String {
        match warning {
            Warning::CutOff {
                by: CutOff::ReliefMap,
                ..
            } => warning.to_string() + &maps::tilt_of_cut_off(self.surface.map()),
            Warning::CutOff {
                by: CutOff::IndenterMap,
                ..
            } => warning.to_string() + &maps::tilt_of_cut_off(self.indenter.map()),
            Warning::LayerShortening { .. }
            | Warning::LayerWorn { .. }
            | Warning::BeyondModel { .. } => {
                let name = |of, body: usize| {
                    let mut names = self.names_of_split(of).into_iter();
                    names.nth(body).unwrap_or_default()
                };
                warning.words(&name)
            }
            _ => with_key(warning),
        }
    }

    /// The names of a body's layers and base, those of a graded layer with their number of all.
    fn names_of_split(&self, of: ElasticBody) -> Vec<String> {
        let other = self.indenter.foundation();
        match (of, other) {
            (ElasticBody::Foundation, _) => self.foundation.names_of_split(),
            (ElasticBody::Counterbody, Some(body)) if !body.layer.is_empty() => {
                let names = body.names_of_split().into_iter();
                names
                    .map(|name| format!("{name} of the indenter"))
                    .collect()
            }
            (ElasticBody::Counterbody, _) => vec!["the indenter".to_owned()],
        }
    }

    /// The warnings about the case, solved on a domain of this side.
    #[must_use]
    pub fn warnings(&self, side: f64) -> Vec<CaseWarning> {
        let mut warnings = Vec::new();
        let root = self.document.root();
        // The numbers of a call are in SI units by its documentation.
        let is_file = !root.span.source.name().ends_with(CALL);
        if is_file && Units::of(root) == Units::Si {
            bare_numbers(root, &mut warnings);
        }
        warnings.extend(maps::of(self, side));
        warnings.extend(self.unused_strengths());
        warnings.extend(self.unjudged_springs());
        warnings.extend(self.unbounded_displacement());
        warnings.extend(self.adhesion.iter().flat_map(AdhesiveContacts::warnings));
        warnings
    }

    /// The warning about springs, which no strength judges.
    fn unjudged_springs(&self) -> Option<CaseWarning> {
        let is_judged = self.stress.is_some() && self.foundation.has_strengths();
        (is_judged && self.surface.has_springs()).then(|| CaseWarning {
            code: "springs-not-judged",
            message: "critical loads are those of layers, interfaces and substrate: the springs of the surface have no \
                      strength; the stress in a spring is its pressure, so compare the largest pressure with the \
                      strength of their material"
                .to_owned(),
        })
    }

    /// The warning about strengths of bodies whose stresses are not asked for.
    fn unused_strengths(&self) -> Option<CaseWarning> {
        let other = self.indenter.foundation();
        let has_strengths = |body: StressedBody| match body {
            StressedBody::Indenter => other.as_ref().is_some_and(|body| body.has_strengths()),
            StressedBody::Foundation | StressedBody::Both => self.foundation.has_strengths(),
        };
        let used = self.stress.as_ref().map(|stress| stress.body.each());
        let is_unused = |body: &StressedBody| !used.is_some_and(|used| used.contains(body));
        let mut bodies = StressedBody::Both.each().iter().copied();
        let of = bodies.find(|body| is_unused(body) && has_strengths(*body))?;
        let message = if used.is_none() {
            "strengths are given but not used: add a table [stress] to compute stresses".to_owned()
        } else {
            let (unused, only) = match of {
                StressedBody::Indenter => ("indenter", "foundation"),
                StressedBody::Foundation | StressedBody::Both => ("foundation", "indenter"),
            };
            format!(
                "the strengths of the {unused} are not used, as stresses of the {only} alone are asked for: \
                 `stress.body = \"both\"` uses them"
            )
        };
        Some(CaseWarning {
            code: "unused-strength",
            message,
        })
    }

    /// The warning about displacements above a frictionless interface under friction.
    fn unbounded_displacement(&self) -> Option<CaseWarning> {
        let friction = self.stress.as_ref()?.friction;
        let slides = |layer: &LayerCase| layer.slides();
        let lowest = self.stressed().layer.iter().rposition(slides)?;
        (friction != 0.0).then(|| CaseWarning {
            code: "unbounded-displacement",
            message: format!(
                "the interface below layer {lowest} is frictionless and cannot carry the force of friction: u_x and \
                 u_y above it are unbounded and left out (NaN, null); stresses are finite"
            ),
        })
    }
}

/// Warns about bare numbers in a case that has units elsewhere, once per key.
fn bare_numbers(root: &TomlNode, warnings: &mut Vec<CaseWarning>) {
    if let TomlValue::Table(table) = &root.value {
        in_table("", table, warnings);
    }
}

fn in_table(path: &str, table: &TomlTable, warnings: &mut Vec<CaseWarning>) {
    for entry in &table.entries {
        let path = dotted(path, &entry.key);
        match (&entry.node.value, bare_unit(&path)) {
            (_, Some(unit)) => {
                warnings.extend(bare(&entry.node).map(|at| warn_of(&path, at, unit)));
            }
            (TomlValue::Table(table), None) => in_table(&path, table, warnings),
            (TomlValue::List(items), None) => {
                for (i, item) in items.iter().enumerate() {
                    if let TomlValue::Table(table) = &item.value {
                        in_table(&format!("{path}[{i}]"), table, warnings);
                    }
                }
            }
            _ => {}
        }
    }
}

/// Returns the first bare number of a value, a list, or the ends of a range; zero needs no unit.
fn bare(node: &TomlNode) -> Option<&TomlNode> {
    match &node.value {
        TomlValue::Integer(number) => (*number != 0).then_some(node),
        TomlValue::Float(number) => (*number != 0.0).then_some(node),
        TomlValue::List(items) => items.iter().find_map(bare),
        TomlValue::Table(table) => {
            let ends = ["from", "to"]
                .into_iter()
                .filter_map(|key| table.entry(key));
            ends.map(|entry| &entry.node).find_map(bare)
        }
        _ => None,
    }
}

fn warn_of(path: &str, at: &TomlNode, unit: &str) -> CaseWarning {
    let (written, span) = (at.span.text(), &at.span);
    CaseWarning {
        code: "bare-number",
        message: format!(
            "{}, key `{path}`: {written} among values with units is {written} {unit}; write \"{written} {unit}\" if that is meant",
            span.words()
        ),
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;
    use std::sync::Arc;

    use super::*;
    use crate::input::span::Source;
    use crate::input::toml_tree;

    fn found(text: &str) -> Vec<String> {
        let root = toml_tree::parse(&Arc::new(Source::new("case.toml", text.into()))).unwrap();
        let mut warnings = Vec::new();
        bare_numbers(&root, &mut warnings);
        warnings
            .into_iter()
            .map(|warning| warning.message)
            .collect()
    }

    #[test]
    fn a_bare_number_is_reported_with_its_line_key_and_assumed_unit() {
        assert_eq!(
            found("[[foundation.layer]]\nthickness = 2\npoisson_ratio = 0.3\n"),
            [
                "case.toml, line 2, key `foundation.layer[0].thickness`: 2 among values with units is 2 m; write \"2 m\" if that is meant"
            ]
        );
    }

    #[test]
    fn bare_lists_and_ranges_are_reported_once_zeros_and_dimensionless_numbers_never() {
        let text = "[load]\nforces = { from = 1e-3, to = 2e-3, count = 4 }\n[surface]\noffset = [0, 1e-6]\n\
            [grid]\nelements = 64\n[indenter]\ntip_radius = 0\nhalf_angle = 1.2\nradius = \"5 nm\"\n";
        let found = found(text);
        assert_eq!(found.len(), 3, "{found:?}");
        assert!(
            found
                .iter()
                .any(|words| words.contains("line 2, key `load.forces`: 1e-3"))
        );
        assert!(
            found
                .iter()
                .any(|words| words.contains("line 4, key `surface.offset`: 1e-6"))
        );
        assert!(found.iter().any(|words| {
            words.contains("key `indenter.half_angle`: 1.2 among values with units is 1.2 rad")
        }));
    }

    #[test]
    fn bare_numbers_of_a_call_are_in_si_units() {
        let text = "[foundation]\nsubstrate = { young_modulus = \"3 GPa\", poisson_ratio = 0.3 }\n\
            [indenter]\nkind = \"sphere\"\nradius = 1e-3\n[load]\nforce = \"1 mN\"\n";
        let is_warned = |name: &str| {
            let source = Arc::new(Source::new(name, text.to_owned()));
            let case = Case::parse(&source, "case", Path::new(""), &[]).unwrap();
            let warnings = case.warnings(1.0);
            warnings.iter().any(|warning| warning.code == "bare-number")
        };
        assert!(is_warned("case.toml"));
        assert!(!is_warned("Case(…)"));
    }

    /// Whether strengths of each body are warned of as unused, with this table `[stress]`.
    fn unused_strengths(foundation: &str, indenter: &str, stress: &str) -> Option<String> {
        let text = format!(
            "[foundation]\nsubstrate = {{ young_modulus = 1, poisson_ratio = 0.3{foundation} }}\n\
             [indenter]\nkind = \"sphere\"\nradius = 1\n\
             body.substrate = {{ young_modulus = 2, poisson_ratio = 0.3{indenter} }}\n\
             [load]\nforce = 1e-3\n{stress}"
        );
        let source = Arc::new(Source::new("case.toml", text));
        let case = Case::parse(&source, "case", Path::new(""), &[]).unwrap();
        let mut warnings = case.warnings(1.0).into_iter();
        let warning = warnings.find(|warning| warning.code == "unused-strength");
        warning.map(|warning| warning.message)
    }

    #[test]
    fn springs_beside_a_judged_body_are_told_of() {
        let film = "kind = \"film\"\nthickness = 0.1\nyoung_modulus = 1";
        for (surface, strength, stress, is_told) in [
            (film, ", yield_strength = 1", "[stress]", true),
            (film, "", "[stress]", false),
            (film, ", yield_strength = 1", "", false),
            ("kind = \"bare\"", ", yield_strength = 1", "[stress]", false),
        ] {
            let text = format!(
                "[foundation]\nsubstrate = {{ young_modulus = 1, poisson_ratio = 0.3{strength} }}\n\
                 [surface]\n{surface}\n[indenter]\nkind = \"sphere\"\nradius = 1\n[load]\nforce = 1e-3\n{stress}"
            );
            let source = Arc::new(Source::new("case.toml", text));
            let case = Case::parse(&source, "case", Path::new(""), &[]).unwrap();
            let mut warnings = case.warnings(1.0).into_iter();
            let found = warnings.any(|warning| warning.code == "springs-not-judged");
            assert_eq!(found, is_told, "{surface} {strength} {stress}");
        }
    }

    #[test]
    fn strengths_of_a_body_whose_stresses_are_not_asked_for_are_told_of() {
        let strength = ", yield_strength = 1";
        for (foundation, indenter, stress, told) in [
            ("", "", "", None),
            (strength, "", "", Some("add a table [stress]")),
            ("", strength, "", Some("add a table [stress]")),
            (strength, "", "[stress]", None),
            (
                "",
                strength,
                "[stress]",
                Some("strengths of the indenter are not used"),
            ),
            (
                strength,
                "",
                "[stress]\nbody = \"indenter\"",
                Some("strengths of the foundation"),
            ),
            (strength, strength, "[stress]\nbody = \"both\"", None),
        ] {
            let found = unused_strengths(foundation, indenter, stress);
            let is_right = match (&found, told) {
                (Some(found), Some(told)) => found.contains(told),
                (found, told) => found.is_none() && told.is_none(),
            };
            assert!(is_right, "{found:?} for {told:?}");
        }
    }

    #[test]
    fn a_warning_names_the_key_to_change_if_there_is_one() {
        let step = 0;
        let cut_off = |by| with_key(&Warning::CutOff { step, by });
        assert!(cut_off(CutOff::Domain).ends_with("choose a larger side, or none (`grid.side`)"));
        assert!(!cut_off(CutOff::IndenterMap).contains('`'));
        let shortening = with_key(&Warning::FilmShortening { step, times: 2.0 });
        assert!(shortening.ends_with("choose a logarithmic law (`surface.law`)"));
    }
}
