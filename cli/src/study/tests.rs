//! Tests of a study's file, and of its table after a kill.

use std::fs;
use std::path::Path;

use tempfile::TempDir;

use super::case_blocks::CaseBlocks;
use super::case_status::CaseStatus;
use super::folder::StudyFolder;
use super::gather::{OtherTable, gather};
use super::identity::StudyIdentity;
use super::kept_file::KeptFields;
use super::plan::StudyPlan;
use super::results_table::ResultsTable;
use super::shard::Shard;
use super::{Study, study_file};
use crate::failure::Failure;

const BASE: &str = r#"
[foundation]
substrate = { young_modulus = "7 GPa", poisson_ratio = 0.4 }

[[foundation.layer]]
thickness = "10 nm"
young_modulus = "70 GPa"
poisson_ratio = 0.3

[indenter]
kind = "paraboloid"
radius = "4 um"

[load]
forces = ["1 uN", "2 uN"]
"#;

const SAMPLES: &str = "\
indenter.radius [um],foundation.layer[0].thickness,title
3,10 nm,a
4,12 nm,b
5,11 nm,c
";

fn study(text: &str) -> Result<Study, String> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("study.toml");
    fs::write(folder.path().join("base.toml"), BASE).unwrap();
    fs::write(folder.path().join("samples.csv"), SAMPLES).unwrap();
    fs::write(&path, text).unwrap();
    let named = |error: Failure| {
        error
            .to_string()
            .replace(&folder.path().display().to_string(), "")
    };
    study_file::read(&path, &[]).map_err(named)
}

fn plan(text: &str, shard: Shard) -> StudyPlan {
    StudyPlan::new(&study(text).unwrap(), shard).unwrap()
}

const TWO_KEYS: &str = r#"
[study]
case = "base.toml"

[study.vary]
"foundation.layer[0].thickness" = ["10 nm", "20 nm", "30 nm"]
grid.elements = { from = 32, to = 128, count = 3, spacing = "log" }
"#;

#[test]
fn a_product_changes_the_last_key_fastest_and_integers_stay_integers() {
    let study = study(TWO_KEYS).unwrap();
    assert_eq!(study.case_count(), 9);
    assert_eq!(
        study.words(0),
        "foundation.layer[0].thickness = 10 nm, grid.elements = 32"
    );
    assert_eq!(
        study.words(5),
        "foundation.layer[0].thickness = 20 nm, grid.elements = 128"
    );
    let case = study.case(5).unwrap();
    assert_eq!(
        (case.foundation.layer[0].thickness, case.grid.elements),
        (20e-9, 128)
    );
}

#[test]
fn a_zip_takes_the_values_together() {
    let zipped = study(&TWO_KEYS.replace("[study]", "[study]\ncombine = \"zip\"")).unwrap();
    assert_eq!(zipped.case_count(), 3);
    assert_eq!(
        zipped.words(1),
        "foundation.layer[0].thickness = 20 nm, grid.elements = 64"
    );
}

#[test]
fn the_columns_of_a_file_change_together_and_combine_with_other_keys() {
    let text = "[study]\ncase = \"base.toml\"\n[study.vary]\ngrid.elements = [32, 64]\nfrom = \"samples.csv\"\n";
    let product = study(text).unwrap();
    assert_eq!((product.case_count(), product.varied_keys().len()), (6, 4));
    assert_eq!(
        product.words(4),
        "grid.elements = 64, indenter.radius = 4.0000 µm, foundation.layer[0].thickness = 12.000 nm, title = b"
    );
    let case = product.case(4).unwrap();
    assert_eq!(
        (case.foundation.layer[0].thickness, &*case.title),
        (12e-9, "b")
    );
    let radius = &product.varied_keys()[1];
    assert_eq!(
        (radius.heading().as_str(), &*radius.cell(1)),
        ("indenter.radius [m]", "4e-6")
    );
    // As a list of the same values gives it.
    let listed = "[study]\ncase = \"base.toml\"\n[study.vary]\nindenter.radius = [\"3 um\", \"4 um\", \"5 um\"]\n";
    let listed = study(listed).unwrap();
    assert_eq!(case.indenter, listed.case(1).unwrap().indenter);
    let zip = text.replace("[study]", "[study]\ncombine = \"zip\"");
    let message = study(&zip).unwrap_err();
    assert!(
        message.contains("key `indenter.radius`: found 3 values, wanted 2"),
        "{message}"
    );
    let zip = study(&zip.replace("[32, 64]", "[32, 48, 64]")).unwrap();
    assert_eq!(
        (zip.case_count(), zip.case(2).unwrap().grid.elements),
        (3, 64)
    );
    let missing = study(&text.replace("samples", "sample")).unwrap_err();
    assert!(missing.contains("sample.csv: found"), "{missing}");
    let number = study(&text.replace("\"samples.csv\"", "3")).unwrap_err();
    assert!(
        number.contains("key `study.vary.from`: found 3"),
        "{number}"
    );
}

#[test]
fn the_base_case_may_stand_in_the_same_file_and_ranges_carry_units() {
    let text = format!(
        "[study.vary]\nload.force = {{ from = \"1 uN\", to = \"1 mN\", count = 4, spacing = \"log\" }}\n{BASE}"
    );
    let study = study(&text.replace("forces = [\"1 uN\", \"2 uN\"]", "")).unwrap();
    let force = |i| match study.case(i).unwrap().load.values {
        crate::case::load::LoadValues::Force(force) => force,
        other => panic!("{other:?}"),
    };
    // Both ends are exact; between them, one rounding of the power.
    assert_eq!([force(0), force(3)], [1e-6, 1e-3]);
    assert!((force(1) / 1e-5 - 1.0).abs() < 1e-15);
    assert_eq!(study.varied_keys()[0].heading(), "load.force [N]");
}

#[test]
fn what_is_no_study_is_told_with_its_key() {
    for (text, wanted) in [
        ("[load]\nforce = 1", "key `study`: found no such key"),
        (
            "[study]\ncase = \"base.toml\"",
            "key `study.vary`: found no such key",
        ),
        (
            "[study]\ncase = \"base.toml\"\n[study.vary]\nload.force = 3",
            "key `load.force`: found 3, wanted a list of values",
        ),
        (
            "[study]\ncase = \"base.toml\"\ncombine = \"zip\"\n[study.vary]\na = [1]\nb = [1, 2]",
            "key `b`: found 2 values, wanted 1, as many as `a` has",
        ),
        (
            "[study]\ncase = \"base.toml\"\n[study.vary]\na = { from = 0, to = 1, count = 3, spacing = \"log\" }",
            "key `a.to`: found a range",
        ),
        (
            "[study]\ncase = \"base.toml\"\n[study.vary]\na = { from = \"1 nm\", to = \"1 N\", count = 3 }",
            "key `a.to`: found \"1 N\", wanted a value with a unit of the same kind",
        ),
        (
            "[study]\ncase = \"base.toml\"\n[study.vary]\na.0.b = [1]\n\"a[0].b\" = [2]",
            "key `a[0].b`: found the same key twice",
        ),
        (
            "[study]\ncase = \"base.toml\"\n[study.vary]\na = [1]\n[load]\nforce = 1",
            "key `load`: found an unknown key, wanted one of study",
        ),
    ] {
        let message = study(text).unwrap_err();
        assert!(message.contains(wanted), "{wanted} in {message}");
    }
    let nowhere = study("[study]\ncase = \"no.toml\"\n[study.vary]\na = [1]").unwrap_err();
    assert!(nowhere.contains("no.toml"), "{nowhere}");
}

#[test]
fn a_key_that_no_case_can_have_is_told_before_any_work() {
    let text = TWO_KEYS.replace("grid.elements", "grid.elemnts");
    let study = study(&text).unwrap();
    let message = StudyPlan::new(&study, Shard::WHOLE)
        .unwrap_err()
        .to_string();
    assert!(
        message.contains("study.toml, line 7, key `grid.elemnts`"),
        "{message}"
    );
}

#[test]
fn other_values_make_another_study_and_other_words_do_not() {
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

/// The fingerprint of a study of `keys` whose base case is `base`, beside a map with these heights.
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
fn heights_of_a_map_count_and_values_that_every_case_replaces_do_not() {
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
fn a_default_written_out_leaves_the_study_the_same_and_another_value_does_not() {
    let of = |base: &str| fingerprint_of(base, "indenter.radius = [\"3 um\", \"4 um\"]", "");
    let first = of(BASE);
    let elements = crate::case::grid::GridCase::default().elements;
    let base = format!("{BASE}\n[grid]\nelements = {elements}\nboundary = \"free\"\n");
    assert_eq!(first, of(&base));
    assert_eq!(first, of(&format!("{base}\n[solver]\ntolerance = 1e-8\n")));
    assert_ne!(first, of(&format!("{base}\n[solver]\ntolerance = 1e-7\n")));
}

#[test]
fn results_of_an_older_layout_are_those_of_another_study() {
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
    let refused = StudyFolder::claim(folder.path(), &identity, false);
    assert!(matches!(refused, Err(Failure::OtherStudy { .. })));
    let place = StudyFolder::claim(folder.path(), &identity, true).unwrap();
    assert_eq!(
        ResultsTable::open(place, &identity).unwrap().tally().done(),
        0
    );
    fs::write(folder.path().join("study.json"), "{\"mine\": 1}").unwrap();
    assert!(StudyFolder::claim(folder.path(), &identity, true).is_err());
}

#[cfg(unix)]
#[test]
fn the_fields_of_a_million_cases_have_their_places_beyond_four_gigabytes() {
    use std::os::unix::fs::FileExt;
    let folder = tempfile::tempdir().unwrap();
    let keeps = MILLION.replace("[study]", "[study]\nkeep = [\"pressure\"]");
    let keeps = format!("{keeps}grid.elements = [32]\n");
    let identity = plan(&keeps, Shard::WHOLE).identity;
    let kept = KeptFields::open(folder.path(), &identity, 0)
        .unwrap()
        .unwrap();
    super::kept_record::add_failed(&kept, 999_999).unwrap();
    kept.finish().unwrap();
    let file = fs::File::open(folder.path().join("fields-n32.nc")).unwrap();
    let length = file.metadata().unwrap().len();
    assert!(length > 8_208_000_000 && length < 8_208_010_000, "{length}");
    // Number, status and side of the last case, whose fields are NaN, at the end of the file.
    let mut record = vec![0; 16 + 8192];
    file.read_exact_at(&mut record, length - 8208).unwrap();
    assert_eq!(record[..8], [0, 15, 66, 64, 0, 0, 0, 3]);
    assert!(
        record[8..]
            .chunks(8)
            .all(|bytes| bytes == f64::NAN.to_be_bytes())
    );
    let mut cases = [0; 4];
    file.read_exact_at(&mut cases, 4).unwrap();
    assert_eq!(u32::from_be_bytes(cases), 1_000_000);
}

#[test]
fn a_field_of_one_case_that_the_format_cannot_hold_is_refused_before_anything_is_solved() {
    let base = format!("{BASE}\n[output]\nfields = \"all\"\n");
    let text = TWO_KEYS.replace("[study]", "[study]\nkeep = [\"pressure\"]");
    let loads: Vec<_> = (1..9).map(|i| format!("\"{i} uN\"")).collect();
    let text = text.replace(
        "grid.elements = { from = 32, to = 128, count = 3, spacing = \"log\" }",
        "",
    );
    let text = format!(
        "{text}load.forces = [[{}]]\ngrid.elements = [8192]\n",
        loads.join(", ")
    );
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("study.toml");
    fs::write(folder.path().join("base.toml"), base).unwrap();
    fs::write(&path, text).unwrap();
    let study = study_file::read(&path, &[]).unwrap();
    let refused = StudyPlan::new(&study, Shard::WHOLE).unwrap_err();
    let (elements, steps) = (8192, 8);
    assert!(
        matches!(refused, Failure::KeptTooLarge { elements: e, steps: s } if (e, s) == (elements, steps)),
        "{refused}"
    );
}

/// A million cases.
const MILLION: &str = r#"
[study]
case = "base.toml"

[study.vary]
indenter.radius = { from = "3 um", to = "5 um", count = 1000 }
"foundation.layer[0].thickness" = { from = "10 nm", to = "20 nm", count = 1000 }
"#;

#[test]
fn a_million_cases_are_planned_by_reading_as_many_as_there_are_values() {
    let plan = plan(MILLION, Shard { index: 3, count: 7 });
    assert_eq!(plan.identity.numbering.len(), 1_000_000);
    // The first case has one value of each key.
    assert_eq!((plan.refused.tried, plan.refused.count), (1999, 0));
    let stored = serde_json::to_string(&plan.identity).unwrap();
    assert!(stored.len() < 1000, "{}", stored.len());
    let rows = |case| plan.identity.rows.of(&plan.identity.numbering, case);
    assert_eq!((rows(999_999), rows(1_000_000)), (Some(2), None));
}

#[test]
fn an_invalid_value_is_found_before_anything_is_solved() {
    let text = TWO_KEYS.replace("\"30 nm\"", "\"-30 nm\"");
    let refused = plan(&text, Shard::WHOLE).refused;
    // Three values of each key, of which the first case has one each.
    assert_eq!((refused.tried, refused.count), (5, 1));
    let words = refused.words().unwrap();
    assert!(
        words.starts_with("case 7 is invalid and will be recorded as failed: "),
        "{words}"
    );
    assert!(words.contains("thickness`: found \"-30 nm\""), "{words}");
}

#[test]
fn every_list_of_loads_has_its_own_number_of_rows() {
    let text = "[study]\ncase = \"base.toml\"\n[study.vary]\ngrid.elements = [32, 64]\n\
                load.forces = [[\"1 uN\"], [\"1 uN\", \"2 uN\", \"3 uN\"]]\nsolver.tolerance = [1e-6, 1e-8]\n";
    let identity = plan(text, Shard::WHOLE).identity;
    let rows: Vec<_> = (0..8).filter_map(|case| identity.rows_of(case)).collect();
    assert_eq!(rows, [1, 1, 3, 3, 1, 1, 3, 3]);
}

#[test]
fn a_layer_that_only_some_cases_have_has_columns() {
    let layer = "{ thickness = \"10 nm\", young_modulus = \"70 GPa\", poisson_ratio = 0.3 }";
    let text = format!(
        "[study]\ncase = \"base.toml\"\n[study.vary]\nstress = [{{}}]\n\
         foundation.layer = [[{layer}], [{layer}, {layer}]]\n"
    );
    let header = plan(&text, Shard::WHOLE).identity.header;
    assert!(header.contains("layer[1]"), "{header}");
}

#[test]
fn results_are_forced_to_the_disk_in_groups() {
    let folder = tempfile::tempdir().unwrap();
    let identity = plan(MILLION, Shard::WHOLE).identity;
    let columns = identity.header.split(',').count();
    let mut table = table(folder.path(), &identity);
    assert!(table.unforced().unwrap().is_none());
    let mut forced = 0;
    for group in 0..3 {
        for case in 100 * group..100 * (group + 1) {
            let rows = rows(columns, case, CaseStatus::Certified);
            table.add(case, CaseStatus::Certified, &rows).unwrap();
        }
        // They have left the process all the same.
        let text = fs::read(table.path()).unwrap();
        assert_eq!(blocks(&text, &identity).blocks.len(), 100 * (group + 1));
        while let Some(file) = table.unforced().unwrap() {
            file.force().unwrap();
            forced += 1;
        }
    }
    assert_eq!(forced, 3);
}

/// Two rows for a case, one for a failed one.
fn rows(columns: usize, case: usize, status: CaseStatus) -> String {
    let cells = ",x".repeat(columns - 2);
    let row = format!("{},{}{cells}\n", case + 1, status.word());
    if status == CaseStatus::Failed {
        row
    } else {
        row.repeat(2)
    }
}

fn blocks(text: &[u8], identity: &StudyIdentity) -> CaseBlocks {
    CaseBlocks::of(text, identity).unwrap().unwrap()
}

fn table(folder: &Path, identity: &StudyIdentity) -> ResultsTable {
    let place = StudyFolder::claim(folder, identity, false).unwrap();
    ResultsTable::open(place, identity).unwrap()
}

#[test]
fn a_table_cut_at_any_byte_keeps_its_whole_cases_and_no_other() {
    let identity = plan(TWO_KEYS, Shard::WHOLE).identity;
    let columns = identity.header.split(',').count();
    let order = [4, 0, 7, 2];
    let status = |case| {
        if case == 7 {
            CaseStatus::Failed
        } else {
            CaseStatus::Certified
        }
    };
    let mut text = format!("{}\n", identity.header);
    let mut ends = vec![text.len()];
    for case in order {
        text += &rows(columns, case, status(case));
        ends.push(text.len());
    }
    for cut in 0..=text.len() {
        let found = blocks(&text.as_bytes()[..cut], &identity);
        let whole = ends.iter().filter(|end| **end <= cut).count();
        assert_eq!(found.blocks.len(), whole.saturating_sub(1), "{cut}");
        let end = ends[..whole].last().copied().unwrap_or(0);
        assert_eq!(found.end, end as u64, "{cut}");
    }
}

#[test]
fn a_table_is_mended_gone_on_with_and_put_in_order() {
    let folder = tempfile::tempdir().unwrap();
    let identity = plan(TWO_KEYS, Shard::WHOLE).identity;
    let columns = identity.header.split(',').count();
    let block = |case| rows(columns, case, CaseStatus::Certified);
    let path = identity.table(folder.path());
    identity.write(folder.path()).unwrap();
    fs::write(&path, format!("{}\n{}9,certi", identity.header, block(3))).unwrap();
    let mut opened = table(folder.path(), &identity);
    assert_eq!(opened.tally().done(), 1);
    let remaining = opened.remaining(&identity);
    assert_eq!(remaining.count_left(), 8);
    assert!(remaining.eq([0, 1, 2, 4, 5, 6, 7, 8]));
    for case in [8, 7, 6, 5, 4, 2, 1, 0] {
        opened
            .add(case, CaseStatus::Certified, &block(case))
            .unwrap();
    }
    opened.finish(&identity).unwrap();
    let all: String = (0..9).map(block).collect();
    assert_eq!(
        fs::read_to_string(&path).unwrap(),
        format!("{}\n{all}", identity.header)
    );
}

#[test]
fn a_table_of_something_else_is_not_touched() {
    let folder = tempfile::tempdir().unwrap();
    let identity = plan(TWO_KEYS, Shard::WHOLE).identity;
    let path = identity.table(folder.path());
    fs::write(&path, "mine\n").unwrap();
    for fresh in [false, true] {
        let claimed = StudyFolder::claim(folder.path(), &identity, fresh);
        assert!(matches!(claimed, Err(Failure::NoResults { .. })));
        assert_eq!(fs::read_to_string(&path).unwrap(), "mine\n");
    }
}

#[test]
fn a_table_is_open_for_one_process() {
    let folder = tempfile::tempdir().unwrap();
    let identity = plan(TWO_KEYS, Shard::WHOLE).identity;
    let _first = table(folder.path(), &identity);
    let second = StudyFolder::claim(folder.path(), &identity, true);
    assert!(second.unwrap_err().to_string().contains("another process"));
}

/// Writes the parts `done` of three.
fn parts(folder: &TempDir, done: &[usize]) {
    for index in 1..=3 {
        let identity = plan(TWO_KEYS, Shard { index, count: 3 }).identity;
        let columns = identity.header.split(',').count();
        let mut table = table(folder.path(), &identity);
        for case in identity.cases() {
            if done.contains(&case) {
                let rows = rows(columns, case, CaseStatus::Certified);
                table.add(case, CaseStatus::Certified, &rows).unwrap();
            }
        }
    }
}

#[test]
fn parts_are_gathered_only_when_no_case_is_missing() {
    let folder = tempfile::tempdir().unwrap();
    parts(&folder, &[0, 1, 2, 3, 4, 5, 6, 8]);
    let found = gather(folder.path(), OtherTable::Keep).unwrap();
    assert_eq!((found.missing, found.table), (vec![7], None));
    parts(&folder, &[7]);
    let table = gather(folder.path(), OtherTable::Keep)
        .unwrap()
        .table
        .unwrap();
    let identity = plan(TWO_KEYS, Shard::WHOLE).identity;
    let columns = identity.header.split(',').count();
    let all: String = (0..9)
        .map(|case| rows(columns, case, CaseStatus::Certified))
        .collect();
    assert_eq!(
        fs::read_to_string(table).unwrap(),
        format!("{}\n{all}", identity.header)
    );
    assert!(gather(Path::new("nowhere"), OtherTable::Keep).is_err());
}

#[test]
fn the_values_of_a_key_are_read_once() {
    let study = study(TWO_KEYS).unwrap();
    let thickness = &study.varied_keys()[0];
    assert_eq!([0, 1, 3].map(|i| thickness.cell(i)), ["1e-8", "2e-8", ""]);
    // The same text, not one made anew from the values.
    assert!(std::ptr::eq(
        &raw const *thickness.cell(1),
        &raw const *thickness.cell(1)
    ));
}

#[test]
fn values_with_and_without_units_are_one_column_and_what_is_no_quantity_among_them_is_refused() {
    let values = "[\"10 nm\", \"20 nm\", \"30 nm\"]";
    assert!(TWO_KEYS.contains(values));
    let with = |other: &str| study(&TWO_KEYS.replace(values, &format!("[\"10 nm\", {other}]")));
    let mixed = with("2e-8").unwrap();
    let thickness = &mixed.varied_keys()[0];
    assert!(
        thickness.heading().ends_with("[m]"),
        "{}",
        thickness.heading()
    );
    assert_eq!([0, 1].map(|i| thickness.cell(i)), ["1e-8", "2e-8"]);
    for odd in ["\"2 furlong\"", "\"2 N\""] {
        let refused = with(odd).unwrap_err();
        assert!(
            refused.contains("of the kind of the key's other values"),
            "{refused}"
        );
    }
}

#[test]
fn a_row_ends_where_its_quotes_are_closed() {
    let text = TWO_KEYS.replace("grid.elements", "title").replace(
        "{ from = 32, to = 128, count = 3, spacing = \"log\" }",
        "[\"a\\nb\", \"c\\r\\n\\\"d\", \"e,f\"]",
    );
    let study = study(&text).unwrap();
    let plan = StudyPlan::new(&study, Shard::WHOLE).unwrap();
    let rows = (0..9).map(|case| plan.columns.failed(&study, case, "why"));
    let table = format!("{}\n{}", plan.identity.header, rows.collect::<String>());
    for cut in 0..=table.len() {
        let found = blocks(&table.as_bytes()[..cut], &plan.identity);
        let end = usize::try_from(found.end).unwrap();
        let again = blocks(&table.as_bytes()[..end], &plan.identity);
        assert_eq!(again, found, "{cut}");
        assert!(cut < table.len() || found.blocks.len() == 9, "{cut}");
    }
}

#[test]
fn the_place_is_held_until_the_table_is_in_order() {
    let folder = tempfile::tempdir().unwrap();
    let identity = plan(TWO_KEYS, Shard::WHOLE).identity;
    let columns = identity.header.split(',').count();
    let mut opened = table(folder.path(), &identity);
    for case in (0..9).rev() {
        let rows = rows(columns, case, CaseStatus::Certified);
        opened.add(case, CaseStatus::Certified, &rows).unwrap();
    }
    // Whoever has the table's old file open does not have the place.
    let old = fs::File::open(identity.table(folder.path())).unwrap();
    assert!(StudyFolder::claim(folder.path(), &identity, false).is_err());
    opened.finish(&identity).unwrap();
    let again = table(folder.path(), &identity);
    assert_eq!(again.tally().done(), 9);
    assert!(!crate::output::lock::is_at(&old, again.path()));
}
