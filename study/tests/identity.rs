//! The identity of studies: the changes that make a different study.

use serde_json::{Value, json};

use super::*;

#[test]
fn different_values_make_another_study_and_different_wording_does_not() {
    let fingerprint = |text: &str| plan(text, Shard::WHOLE).identity.fingerprint;
    let first = fingerprint(TWO_KEYS);
    assert_eq!(first, fingerprint(&format!("# a comment\n{TWO_KEYS}")));
    assert_eq!(
        first,
        fingerprint(&TWO_KEYS.replace("\"20 nm\"", "\"0.02 um\""))
    );
    assert_ne!(
        first,
        fingerprint(&TWO_KEYS.replace("\"20 nm\"", "\"21 nm\""))
    );
}

/// Returns the fingerprint of a study of `keys` with the base case `base`, beside a map with these heights.
fn fingerprint_of(base: &str, keys: &str, heights: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("study.toml");
    fs::write(folder.path().join("base.toml"), base).unwrap();
    fs::write(folder.path().join("map.csv"), heights).unwrap();
    let study = format!("[study]\ncase = \"base.toml\"\n[study.vary]\n{keys}\n");
    fs::write(&path, study).unwrap();
    let study = study_file::read(&path, &[]).unwrap();
    StudyPlan::new(&study, Shard::WHOLE)
        .unwrap()
        .identity
        .fingerprint
}

#[test]
fn the_identity_includes_map_heights_but_not_values_that_every_case_replaces() {
    let map = "kind = \"map\"\nfile = \"map.csv\"\nside = \"1 um\"\nheight_unit = \"1 nm\"";
    let bare = "kind = \"paraboloid\"\nradius = \"4 um\"";
    let base = BASE.replace(bare, map);
    assert_ne!(base, BASE);
    let (keys, heights) = ("grid.elements = [32, 64]", "0,1,0\n1,2,1\n0,1,0\n");
    let first = fingerprint_of(&base, keys, heights);
    assert_eq!(first, fingerprint_of(&base, keys, heights));
    assert_ne!(
        first,
        fingerprint_of(&base, keys, &heights.replace('2', "3"))
    );
    // A map that only some cases have.
    let tables = format!(
        "indenter = [{{ {} }}, {{ {} }}]",
        bare.replace('\n', ", "),
        map.replace('\n', ", ")
    );
    let some = fingerprint_of(BASE, &tables, heights);
    assert_ne!(
        some,
        fingerprint_of(BASE, &tables, &heights.replace('2', "3"))
    );
    let other = BASE.replace("thickness = \"10 nm\"", "thickness = \"11 nm\"");
    let thickness = "\"foundation.layer[0].thickness\" = [\"10 nm\"]";
    let of = |base: &str, keys: &str| fingerprint_of(base, keys, heights);
    assert_eq!(of(BASE, thickness), of(&other, thickness));
    assert_ne!(of(BASE, keys), of(&other, keys));
    let output = format!("{BASE}\n[output]\nfields = \"none\"\n");
    assert_eq!(of(BASE, keys), of(&output, keys));
}

#[test]
fn writing_out_a_default_keeps_the_study_and_another_value_changes_it() {
    let of = |base: &str| fingerprint_of(base, "indenter.radius = [\"3 um\", \"4 um\"]", "");
    let first = of(BASE);
    let elements = pellicle::case::grid::GridCase::default().elements;
    let base = format!("{BASE}\n[grid]\nelements = {elements}\nboundary = \"free\"\n");
    assert_eq!(first, of(&base));
    assert_eq!(first, of(&format!("{base}\n[solver]\ntolerance = 1e-8\n")));
    assert_ne!(first, of(&format!("{base}\n[solver]\ntolerance = 1e-7\n")));
}

#[test]
fn results_of_an_older_layout_count_as_another_study() {
    let folder = tempfile::tempdir().unwrap();
    let identity = plan(TWO_KEYS, Shard::WHOLE).identity;
    let old = format!(
        "{{\"schema\": \"pellicle-study/1\", \"version\": \"0.1.0\", \"study\": \"a\", \
         \"shard\": {{\"index\": 1, \"count\": 1}}, \"fingerprint\": {:?}, \"header\": \"case,status\", \
         \"rows\": [1, 1, 1]}}",
        identity.fingerprint
    );
    fs::write(folder.path().join("study.json"), old).unwrap();
    fs::write(identity.table(folder.path()), "case,status\n1,failed\n").unwrap();
    let refused = StudyFolder::claim(folder.path(), &identity, false, &|_| Ok(()));
    assert!(matches!(refused, Err(StudyError::OtherStudy { .. })));
    let place = StudyFolder::claim(folder.path(), &identity, true, &|_| Ok(())).unwrap();
    assert_eq!(
        ResultsTable::open(place, &identity).unwrap().tally().done(),
        0
    );
    fs::write(folder.path().join("study.json"), "{\"mine\": 1}").unwrap();
    assert!(StudyFolder::claim(folder.path(), &identity, true, &|_| Ok(())).is_err());
}

#[test]
fn an_identity_whose_numbers_no_study_can_have_is_damaged() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("study.json");
    let text = TWO_KEYS.replace("[study]\n", "[study]\nkeep = [\"pressure\"]\n");
    let identity = plan(&text, Shard::WHOLE).identity;
    let read = |pointer: &str, number: Value| {
        let mut value = serde_json::to_value(&identity).unwrap();
        *value.pointer_mut(pointer).unwrap() = number;
        fs::write(&path, value.to_string()).unwrap();
        StudyIdentity::read(&path)
    };
    assert_eq!(
        read("/done_before", json!(0)).unwrap(),
        Some(identity.clone())
    );
    let largest = u64::MAX;
    for (pointer, number) in [
        ("/numbering/lengths", json!([3, 0])),
        ("/numbering/lengths", json!([largest, 3])),
        ("/numbering/lengths", json!([1000, 1001])),
        ("/numbering/lengths", json!([3])),
        ("/rows/axes", json!([7])),
        ("/rows/counts", json!([])),
        ("/kept/elements/counts", json!([32, 64])),
        ("/kept/elements/counts", json!([32, 64, largest])),
        ("/kept/steps", json!(largest)),
        ("/kept/fields", json!(["pressure", "pressure"])),
    ] {
        let refused = read(pointer, number.clone()).map_err(|error| error.to_string());
        let sentence = refused.expect_err(pointer);
        assert!(
            sentence.contains("study.json"),
            "{pointer}, {number}: {sentence}"
        );
    }
}
