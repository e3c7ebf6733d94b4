//! Questions that no search can answer.

use super::*;

#[test]
fn a_wrong_question_is_one_sentence_with_what_was_found_and_what_is_wanted() {
    let faults = [
        (
            "max_presure < 2 GPa",
            "load.force",
            None,
            "--find: found no result `max_presure` of this case, wanted a number of the result of this case",
        ),
        (
            "max_pressure_at < 2 um",
            "load.force",
            None,
            "--find: found `max_pressure_at`, which is no number",
        ),
        (
            "plastic_depth < 2 um",
            "load.force",
            None,
            "--find: found `plastic_depth`, which is given with a hardness",
        ),
        (
            "max_pressure < 2 um",
            "load.force",
            None,
            "--find: found `2 um`, wanted a pressure such as \"70 GPa\"",
        ),
        (
            "max_pressure = 2 GPa",
            "load.force",
            None,
            "--find: found `max_pressure = 2 GPa`, wanted a number of the result and its limit",
        ),
        (
            "max_pressure <",
            "load.force",
            None,
            "--find: found ``, wanted a pressure",
        ),
        (
            "max_pressure < 2 GPa",
            "load.forse",
            None,
            "--by: found no number `load.forse` among the keys of a case",
        ),
        (
            "max_pressure < 2 GPa",
            "grid.elements",
            None,
            "--by: found `grid.elements`, whose value is",
        ),
        (
            "max_pressure < 2 GPa",
            "indenter.kind",
            None,
            "--by: found no number `indenter.kind`",
        ),
        (
            "max_pressure < 2 GPa",
            "foundation.substrate.hardness",
            None,
            "--by: found `foundation.substrate.hardness`, of which",
        ),
        (
            "max_pressure < 2 GPa",
            "surface.period",
            None,
            "--by: found `surface.period`, of which the case has no positive value, wanted the range of its values",
        ),
        (
            "max_pressure < 2 GPa",
            "load.force",
            Some(["1 um", "2 N"]),
            "--between: found `1 um`, wanted a force",
        ),
        (
            "max_pressure < 2 GPa",
            "load.force",
            Some(["1 N", "1 N"]),
            "--between: found the same value twice",
        ),
        (
            "max_pressure < 2 GPa",
            "load.force",
            Some(["-1 N", "1 N"]),
            "--by, key `load.force`: found -1.0000 N, wanted",
        ),
    ];
    for (condition, key, between, wanted) in faults {
        let refused = Search::new(base(BALL), &question(condition, key, between));
        let found = refused.unwrap_err().to_string();
        assert!(found.starts_with(wanted), "{found}");
        assert!(!found.contains('\n'), "{found}");
    }
    let study = format!("[study]\nvary = {{ }}\n{BALL}");
    let refused = Search::new(base(&study), &question("force < 1 N", "load.force", None));
    assert!(
        refused
            .unwrap_err()
            .to_string()
            .contains("found a table [study]")
    );
}
