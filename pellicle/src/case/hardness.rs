//! The check that the other tables of a case are compatible with a hardness.

use super::foundation::FoundationCase;
use super::indenter::IndenterCase;
use super::load::LoadCase;
use super::solver::SolverCase;
use crate::input::diagnosis::Diagnosis;
use crate::input::table_reader::TableReader;

/// Rejects two different hardnesses, and requests that are not available with a hardness.
///
/// # Errors
///
/// A [`Diagnosis`] of the incompatible key.
pub fn check(
    root: &TableReader<'_>,
    (foundation, indenter, solver): (&FoundationCase, &IndenterCase, &SolverCase),
    load: &LoadCase,
    has_critical_loads: bool,
) -> Result<(), Diagnosis> {
    let of_bodies = foundation.hardness_against(indenter);
    let Some(hardness) = solver.hardness.or(of_bodies) else {
        return Ok(());
    };
    let field = |table: &str, key: &str| root.required(table, "")?.table()?.required(key, "");
    if let Some(other) = of_bodies.filter(|other| other.total_cmp(&hardness).is_ne()) {
        let body = key_of(foundation, indenter);
        let reason = format!("while {body} is {other:e}");
        let wanted = "one hardness of the surface, here or there";
        return Err(field("solver", "hardness")?.unusable(&reason, wanted));
    }
    let because = "with a hardness";
    if load.sensitivities {
        let wanted = "false: derivatives are those of elastic contact";
        return Err(field("load", "sensitivities")?.unusable(&because, wanted));
    }
    if has_critical_loads {
        let wanted = "stresses without strengths: critical loads are those of elastic contact";
        return Err(root.required("stress", "")?.unusable(&because, wanted));
    }
    Ok(())
}

/// The key of the smaller hardness of both surfaces.
fn key_of(foundation: &FoundationCase, indenter: &IndenterCase) -> String {
    let other = indenter.foundation().filter(|other| {
        let [own, other] = [foundation.hardness(), other.hardness()];
        other.is_some_and(|other| own.is_none_or(|own| other < own))
    });
    let (path, body) = match &other {
        Some(other) => ("indenter.body", other.as_ref()),
        None => ("foundation", foundation),
    };
    let part = if body.layer.is_empty() {
        "substrate"
    } else {
        "layer[0]"
    };
    format!("{path}.{part}.hardness")
}

#[cfg(test)]
mod tests {
    use std::path::Path;
    use std::sync::Arc;

    use crate::case::Case;
    use crate::input::span::Source;

    fn read(layer: &str, more: &str) -> Result<Case, String> {
        let text = format!(
            "[foundation]\nsubstrate = {{ young_modulus = 1, poisson_ratio = 0.3{layer} }}\n\
             [indenter]\nkind = \"paraboloid\"\nradius = 1\n[load]\nforce = 1e-3\n{more}"
        );
        let source = Arc::new(Source::new("case.toml", text));
        Case::parse(&source, "case", Path::new(""), &[]).map_err(|error| error.to_string())
    }

    #[test]
    fn the_hardness_is_that_of_the_solver_table_or_of_the_topmost_body() {
        let hardness = |layer, more| read(layer, more).unwrap().hardness();
        assert_eq!(hardness("", ""), None);
        assert_eq!(hardness("", "[solver]\nhardness = 0.1"), Some(0.1));
        assert_eq!(hardness(", hardness = 0.2", ""), Some(0.2));
        assert_eq!(
            hardness(", hardness = 0.2", "[solver]\nhardness = 0.2"),
            Some(0.2)
        );
        let coating =
            "[[foundation.layer]]\nthickness = 1\nyoung_modulus = 1\npoisson_ratio = 0.3\n";
        assert_eq!(hardness(", hardness = 0.2", coating), None);
        assert_eq!(hardness("", &format!("{coating}hardness = 0.3")), Some(0.3));
    }

    #[test]
    fn two_different_hardnesses_and_unsupported_combinations_are_rejected() {
        for (layer, more, words) in [
            (
                ", hardness = 0.2",
                "[solver]\nhardness = 0.1",
                "foundation.substrate.hardness is 2e-1",
            ),
            (
                ", hardness = 0.2",
                "sensitivities = true",
                "derivatives are those of elastic contact",
            ),
            (
                ", hardness = 0.2, yield_strength = 1",
                "[stress]",
                "critical loads are those of elastic contact",
            ),
        ] {
            let message = read(layer, more).unwrap_err();
            assert!(message.contains(words), "{message}");
        }
        assert!(read(", hardness = 0.2", "[stress]").is_ok());
    }
}
