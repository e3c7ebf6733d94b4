//! The commented cases of `pellicle init`; each runs as it is.

use std::borrow::Cow;

use clap::ValueEnum;
use pellicle::case::Case;
use pellicle::declare::schema;
use pellicle::declare::template::with_other_keys;
use pellicle::summary::schema::of_summary;
use pellicle_identify::draft::DraftKind;

/// A case to start from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, ValueEnum)]
pub enum Template {
    /// A ball on a coating with a pattern of pillars
    #[default]
    Cylinders,
    /// A ball on a hard coating with dimples
    Dimples,
    /// A Berkovich pyramid on a coating with a soft film
    Film,
    /// A ball on a hard coating: a load-penetration curve
    Coating,
    /// A Berkovich pyramid on a bare half-space
    Berkovich,
    /// A Vickers pyramid on coated steel
    Vickers,
    /// A cube corner on a film that slides on a rigid base
    CubeCorner,
    /// A rounded cone on a coating
    Cone,
    /// The imprint of an indenter unloaded: a power-law indenter on a coating, with the stresses inside
    Power,
    /// A flat punch on an elastic layer on a rigid base
    FlatPunch,
    /// A ball on a half-space, to compare with the closed form
    Hertz,
    /// A ball on a rough elastic body
    Rough,
    /// A plane on a rough elastic body that repeats: contact area over pressure
    RoughPeriodic,
    /// The heights of the cases `rough` and `rough-periodic`, rough-surface.csv
    RoughMap,
    /// A fit of a modulus to a measured curve of force over depth; with --from of yours
    Fit,
    /// A fit of a modulus to an approach of a force microscope; with --from of yours
    FitAfm,
    /// Modulus and hardness from an unloading, by Oliver and Pharr; with --from of yours
    FitUnloading,
    /// The modulus of a film from unloadings on a coated body: thermal oxide on silicon
    FitFilm,
    /// The unloadings of the fit `fit-film`, oxide.csv
    Oxide,
    /// A curve to try `fit-afm` with, approach.txt: a ball of 5 µm on a body of 10 kPa
    Approach,
    /// A curve to try `fit-unloading` with, indentation.txt: fused silica of 72 GPa
    Indentation,
    /// A parameter study: a ball on coatings of several thicknesses under several loads
    Study,
    /// The JSON schema of a case, with which editors complete and check it while it is typed
    Schema,
    /// The JSON schema of a fit
    FitSchema,
    /// The JSON schema of a study
    StudySchema,
    /// The JSON schema of summary.json
    SummarySchema,
}

/// The first line of a file of this kind, `case`, `fit` or `study`: editors complete and check it by the schema of this
/// name beside it, which `pellicle init schema`, `fit-schema` and `study-schema` write.
fn schema_line(kind: &str) -> String {
    format!("#:schema {kind}.schema.json\n")
}

impl Template {
    /// Returns the text of the template: of a case, a fit or a study with the line by which editors find its schema, of
    /// a case also with a list of the keys that it leaves out.
    #[must_use]
    pub fn text(self) -> Cow<'static, str> {
        let of_kind = |kind, text| (schema_line(kind) + text).into();
        let case = match self {
            Self::Schema => return schema::text(&schema::of_case()).into(),
            Self::FitSchema => return pellicle_identify::fit_file::shape::schema().into(),
            Self::StudySchema => return pellicle_study::keys::schema().into(),
            Self::SummarySchema => return schema::text(&of_summary()).into(),
            Self::RoughMap => return include_str!("templates/rough-surface.csv").into(),
            Self::Approach => return include_str!("templates/approach.txt").into(),
            Self::Oxide => return include_str!("templates/oxide.csv").into(),
            Self::Indentation => return include_str!("templates/indentation.txt").into(),
            Self::Study => return of_kind("study", include_str!("templates/study.toml")),
            Self::Fit => return of_kind("fit", include_str!("templates/fit.toml")),
            Self::FitAfm => return of_kind("fit", include_str!("templates/fit-afm.toml")),
            Self::FitFilm => return of_kind("fit", include_str!("templates/fit-film.toml")),
            Self::FitUnloading => {
                return of_kind("fit", include_str!("templates/fit-unloading.toml"));
            }
            Self::Cylinders => include_str!("templates/cylinders.toml"),
            Self::Dimples => include_str!("templates/dimples.toml"),
            Self::Film => include_str!("templates/film.toml"),
            Self::Coating => include_str!("templates/coating.toml"),
            Self::Berkovich => include_str!("templates/berkovich.toml"),
            Self::Vickers => include_str!("templates/vickers.toml"),
            Self::CubeCorner => include_str!("templates/cube-corner.toml"),
            Self::Cone => include_str!("templates/cone.toml"),
            Self::Power => include_str!("templates/power.toml"),
            Self::FlatPunch => include_str!("templates/flat-punch.toml"),
            Self::Hertz => include_str!("templates/hertz.toml"),
            Self::Rough => include_str!("templates/rough.toml"),
            Self::RoughPeriodic => include_str!("templates/rough-periodic.toml"),
        };
        let case = with_other_keys(case, &Case::shape());
        of_kind("case", &case)
    }

    /// Whether it is a case.
    #[must_use]
    pub fn is_case(self) -> bool {
        match self {
            Self::Cylinders
            | Self::Dimples
            | Self::Film
            | Self::Coating
            | Self::Berkovich
            | Self::Vickers
            | Self::CubeCorner
            | Self::Cone
            | Self::Power
            | Self::FlatPunch
            | Self::Hertz
            | Self::Rough
            | Self::RoughPeriodic => true,
            Self::RoughMap
            | Self::Fit
            | Self::FitAfm
            | Self::FitUnloading
            | Self::FitFilm
            | Self::Oxide
            | Self::Approach
            | Self::Indentation
            | Self::Study
            | Self::Schema
            | Self::FitSchema
            | Self::StudySchema
            | Self::SummarySchema => false,
        }
    }

    /// What the curves of a fit are taken for; none if it is not a template of a fit.
    #[must_use]
    pub fn draft(self) -> Option<DraftKind> {
        match self {
            Self::Fit => Some(DraftKind::Guessed),
            Self::FitAfm => Some(DraftKind::Afm),
            Self::FitUnloading => Some(DraftKind::Unloading),
            _ => None,
        }
    }

    /// Returns the command to run next, for a template written to the file `path`.
    #[must_use]
    pub fn next(self, path: &str) -> String {
        match self {
            Self::Study => format!("pellicle study {path}"),
            Self::Fit => format!(
                "put your file into it, or let it make one: pellicle identify {path} --simulate --out curve.txt; then \
                 pellicle identify {path}"
            ),
            Self::FitAfm => example("approach", path),
            Self::FitFilm => format!(
                "pellicle init oxide --out oxide.csv beside it, and pellicle identify {path}"
            ),
            Self::Oxide => "pellicle init fit-film".into(),
            Self::Approach | Self::Indentation => format!("pellicle init fit --from {path}"),
            Self::FitUnloading => example("indentation", path),
            Self::Rough | Self::RoughPeriodic => format!(
                "pellicle init rough-map --out rough-surface.csv beside it, and pellicle run {path}"
            ),
            Self::RoughMap => "pellicle init rough".into(),
            Self::SummarySchema => "check the output of pellicle run --json".into(),
            Self::Schema => format!("write #:schema {path} as the first line of a case"),
            Self::FitSchema => format!("write #:schema {path} as the first line of a fit"),
            Self::StudySchema => format!("write #:schema {path} as the first line of a study"),
            _ => format!("pellicle run {path}"),
        }
    }
}

/// What to do with the template of a fit that has an example of a curve.
fn example(curve: &str, path: &str) -> String {
    format!(
        "put your file into it, or pellicle init {curve} --out {curve}.txt beside it; then pellicle identify {path}"
    )
}

#[cfg(test)]
mod tests {
    use std::path::Path;
    use std::sync::Arc;

    use super::*;
    use pellicle::input::span::Source;
    use pellicle::input::units::Units;

    #[test]
    fn the_stress_keys_in_the_template_are_valid() {
        let uncomment = |line: &str| {
            let inner = line
                .strip_prefix("# ")
                .filter(|inner| inner.starts_with('[') || inner.split(' ').nth(1) == Some("="));
            inner.unwrap_or(line).to_owned() + "\n"
        };
        let text: String = Template::Coating.text().lines().map(uncomment).collect();
        let source = Arc::new(Source::new("coating.toml", text));
        let case = Case::parse(&source, "", Path::new(""), &[]).unwrap_or_else(|e| panic!("{e}"));
        let stress = case.stress.unwrap();
        assert_eq!((stress.friction, stress.extent), (0.15, Some(30e-6)));
        assert_eq!(stress.depths.unwrap().len(), 41);
        assert_eq!(stress.only.unwrap().len(), 4);
        assert_eq!(case.foundation.criteria().len(), 4);
    }

    #[test]
    fn every_template_is_a_case_with_units_and_comments() {
        for template in Template::value_variants().iter().filter(|of| of.is_case()) {
            let folder = tempfile::tempdir().unwrap();
            let map = folder.path().join("rough-surface.csv");
            std::fs::write(map, &*Template::RoughMap.text()).unwrap();
            let source = Arc::new(Source::new(
                format!("{template:?}"),
                template.text().into_owned(),
            ));
            let case =
                Case::parse(&source, "", folder.path(), &[]).unwrap_or_else(|e| panic!("{e}"));
            assert_eq!(case.units, Units::Si, "{template:?}");
            assert!(
                template.text().starts_with("#:schema case.schema.json\n# "),
                "{template:?}"
            );
        }
    }
}
