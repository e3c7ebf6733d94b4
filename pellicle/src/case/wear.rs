//! `[wear]`: wear of the surface over a sliding distance.

use pellicle_contact::wear::Wear;

use super::foundation::FoundationCase;
use super::load::LoadCase;
use super::spring_law::LawCase;
use super::surface::SurfaceCase;
use crate::declare::macros::{one_of, record};
use crate::declare::{Codec, fraction, length, part, series, wear_coefficient};
use crate::input::diagnosis::Diagnosis;
use crate::input::table_reader::TableReader;

/// The largest number of distances; more is a mistake.
const MAX_DISTANCES: usize = 10_000;

/// What is wanted for the error of a step.
const TOLERANCES: &str = "a part of the largest depth, from 1e-6 to 0.1";

record! {
    /// The wear of a surface.
    pub struct WearCase {
        coefficient: f64 = wear_coefficient().positive(),
            "depth of wear per pressure and sliding distance, by Archard the worn volume over force and distance";
        #[serde(flatten)] distances: WearDistances = part(), "the sliding distance, or a list of them";
        tolerance: f64 = fraction(1e-6..=0.1, TOLERANCES.into()).or(Wear::TOLERANCE, "5e-3"),
            "error of the depths in each step, over the largest depth";
    }
}

one_of! {
    /// The sliding distances of the results.
    pub enum WearDistances, "exactly one of distance and distances", None;
    distance: Distance(f64) = length().not_negative(), "one sliding distance";
    distances: Distances(Vec<f64>) = series(length().not_negative(), MAX_DISTANCES),
        "a curve over sliding distances, which must not fall: a step each";
}

impl WearDistances {
    /// The distances in order.
    #[must_use]
    pub fn list(&self) -> &[f64] {
        match self {
            Self::Distance(one) => std::slice::from_ref(one),
            Self::Distances(several) => several,
        }
    }
}

impl WearCase {
    /// The wear itself.
    #[must_use]
    pub fn build(&self) -> Wear {
        Wear {
            coefficient: self.coefficient,
            distances: self.distances.list().to_vec(),
            tolerance: self.tolerance,
        }
    }
}

/// Rejects distances that fall, and requests that are not available with wear.
///
/// # Errors
///
/// A [`Diagnosis`] of the incompatible key.
pub fn check(
    root: &TableReader<'_>,
    wear: &WearCase,
    (foundation, surface, load): (&FoundationCase, &SurfaceCase, &LoadCase),
    hardness: Option<f64>,
) -> Result<(), Diagnosis> {
    let because = "with [wear]";
    let field = |table: &str, key: &str| root.required(table, "")?.table()?.required(key, "");
    if let Err(error) = wear.build().checked() {
        return Err(field("wear", "distances")?.refused(&error));
    }
    if load.steps() > 1 {
        let keys = ["forces", "pressures", "penetrations"];
        let table = root.required("load", "")?.table()?;
        let several = table.given(&keys).first().copied().unwrap_or(keys[0]);
        let wanted = "one load, under which the surface wears over the distances";
        return Err(table.required(several, "")?.unusable(&because, wanted));
    }
    if load.work_of_adhesion.is_some() {
        let wanted = "none: adhesion is computed for surfaces without wear";
        return Err(field("load", "work_of_adhesion")?.unusable(&because, wanted));
    }
    if load.sensitivities {
        let wanted = "false: derivatives are those of surfaces without wear";
        return Err(field("load", "sensitivities")?.unusable(&because, wanted));
    }
    if hardness.is_some() {
        let wanted = "no hardness: wear is that of elastic contact";
        let found = match (foundation.hardness(), foundation.layer.is_empty()) {
            (None, _) => field("solver", "hardness")?,
            _ => root.required("wear", "")?,
        };
        return Err(found.unusable(&"with a hardness", wanted));
    }
    let law = match surface {
        SurfaceCase::Cylinders(of) => of.law,
        SurfaceCase::Dimples(of) => of.law,
        SurfaceCase::Grooves(of) => of.law,
        SurfaceCase::Film(of) => of.law,
        SurfaceCase::Map(of) => of.law,
        SurfaceCase::Bare | SurfaceCase::Rough(_) | SurfaceCase::Function(_) => LawCase::Linear,
    };
    if law == LawCase::Logarithmic {
        let wanted = "\"linear\": the length of stiffening springs after wear is not known";
        return Err(field("surface", "law")?.unusable(&because, wanted));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::path::Path;
    use std::sync::Arc;

    use crate::case::Case;
    use crate::input::span::Source;

    fn read(load: &str, wear: &str, more: &str) -> Result<Case, String> {
        let text = format!(
            "[foundation]\nsubstrate = {{ young_modulus = \"200 GPa\", poisson_ratio = 0.3 }}\n\
             [indenter]\nkind = \"paraboloid\"\nradius = \"1 mm\"\n[load]\n{load}\n[wear]\n{wear}\n\
             {more}\n[grid]\nelements = 32"
        );
        let source = Arc::new(Source::new("case.toml", text));
        Case::parse(&source, "case", Path::new(""), &[]).map_err(|error| error.to_string())
    }

    const FORCE: &str = "force = \"1 N\"";
    const WEAR: &str = "coefficient = \"1e-15 m^2/N\"\ndistances = { from = \"1 m\", to = \"100 m\", count = 3, spacing = \"log\" }\ntolerance = 0.01";

    #[test]
    fn coefficients_are_read_in_every_usual_unit() {
        for text in [
            "\"1e-15 m^2/N\"",
            "\"1e-6 mm^3/(N m)\"",
            "\"1e-6 mm^3/Nm\"",
            "\"1e-6 mm^3/N/m\"",
            "\"1e-3 um^2/N\"",
        ] {
            let case = read(
                FORCE,
                &format!("coefficient = {text}\ndistance = \"1 m\""),
                "",
            );
            let found = case.unwrap().wear.unwrap().coefficient;
            assert!((found / 1e-15 - 1.0).abs() < 1e-14, "{text}: {found:e}");
        }
    }

    #[test]
    fn each_distance_is_a_step_with_its_wear() {
        let case = read(FORCE, WEAR, "").unwrap();
        assert_eq!(case.steps(), 3);
        let run = case.solve(&mut ()).unwrap();
        assert_eq!(run.summary.steps.len(), 3);
        for (step, distance) in run.summary.steps.iter().zip([1.0, 10.0, 100.0]) {
            let wear = step.wear.as_ref().unwrap();
            assert!((wear.distance / distance - 1.0).abs() < 1e-12);
            // k Q s
            assert!(
                (wear.volume / (1e-15 * distance) - 1.0).abs() < 1e-11,
                "{wear:?}"
            );
            assert!(wear.max_depth > 0.0 && step.certificate.satisfied);
        }
        // The heights after wear are a field.
        let surface = run.path.surface(&run.path.geometry(), 2).unwrap();
        let lowest = surface
            .worn_profile
            .iter()
            .fold(0.0_f64, |low, height| low.min(*height));
        let depth = run.summary.steps[2].wear.as_ref().unwrap().max_depth;
        assert!(
            (lowest + depth).abs() < 1e-15 * depth.max(1.0),
            "{lowest} {depth}"
        );
    }

    #[test]
    fn stresses_are_those_under_the_pressure_of_each_distance_without_critical_loads() {
        let strong = "[stress]\nonly = [\"max_von_mises\"]\n";
        let case = read(FORCE, WEAR, strong).unwrap();
        let run = case.solve(&mut ()).unwrap();
        let peaks = run.summary.steps.iter().map(|step| {
            let stress = step.stress.as_ref().unwrap();
            let found = stress.extremes.bodies[0].max_von_mises.unwrap().value;
            [found, step.summary.max_pressure]
        });
        let peaks: Vec<_> = peaks.collect();
        assert!(peaks.windows(2).all(|of| of[1][0] < of[0][0]), "{peaks:?}");
        // Hertz: 0.62 p₀ before wear flattens the contact, less than p₀ after.
        assert!(
            peaks
                .iter()
                .all(|[stress, p]| *stress > 0.3 * p && stress < p),
            "{peaks:?}"
        );
        assert!(run.summary.critical.is_none());
    }

    #[test]
    fn what_does_not_wear_is_refused_with_the_reason() {
        let one = "coefficient = \"1e-15 m^2/N\"\ndistance = \"1 m\"";
        let film = "[surface]\nkind = \"film\"\nthickness = \"1 um\"\nyoung_modulus = \"1 GPa\"\nlaw = \"logarithmic\"";
        for (load, wear, more, words) in [
            (
                FORCE,
                "coefficient = \"-1e-15 m^2/N\"\ndistance = 1",
                "",
                "a positive wear coefficient",
            ),
            (
                FORCE,
                "coefficient = \"1 m\"\ndistance = 1",
                "",
                "(a length), wanted a positive wear coefficient",
            ),
            (FORCE, "distance = \"1 m\"", "", "wear.coefficient"),
            (
                FORCE,
                "coefficient = 1",
                "",
                "exactly one of distance and distances",
            ),
            (
                FORCE,
                "coefficient = 1\ndistance = 1\ndistances = [1, 2]",
                "",
                "distance and distances",
            ),
            (
                FORCE,
                "coefficient = 1\ndistances = [2, 1]",
                "",
                "distances from 0 that do not fall",
            ),
            ("forces = [1, 2]", one, "", "one load"),
            ("force = 1\nsensitivities = true", one, "", "without wear"),
            (
                "force = 1\nwork_of_adhesion = 1e-3",
                one,
                "",
                "without wear",
            ),
            (
                FORCE,
                one,
                "[solver]\nhardness = \"1 GPa\"",
                "elastic contact",
            ),
            (FORCE, one, film, "\"linear\""),
        ] {
            let message = read(load, wear, more).unwrap_err();
            assert!(message.contains(words), "{wear} {more}: {message}");
        }
    }
}
