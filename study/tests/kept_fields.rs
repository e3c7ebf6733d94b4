//! Fields of all cases kept in one file.

use pellicle_study::kept_record;

use super::*;

#[cfg(unix)]
#[test]
fn offsets_of_the_fields_of_a_million_cases_exceed_four_gigabytes() {
    use std::os::unix::fs::FileExt;
    let folder = tempfile::tempdir().unwrap();
    let keeps = MILLION.replace("[study]", "[study]\nkeep = [\"pressure\"]");
    let keeps = format!("{keeps}grid.elements = [32]\n");
    let identity = plan(&keeps, Shard::WHOLE).identity;
    let kept = KeptFields::open(folder.path(), &identity, 0)
        .unwrap()
        .unwrap();
    kept_record::add_failed(&kept, 999_999).unwrap();
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
fn a_field_too_large_for_the_format_is_rejected_before_anything_is_solved() {
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
        matches!(refused, StudyError::KeptTooLarge { elements: e, steps: s } if (e, s) == (elements, steps)),
        "{refused}"
    );
}

#[test]
fn fields_of_an_oblong_cell_are_not_kept() {
    let text = "[study]\ncase = \"base.toml\"\nkeep = [\"pressure\"]\n[study.vary]\n\
                grid = [{ sides = [\"2 um\", \"1 um\"], elements = 32, boundary = \"periodic\" }]\n";
    let refused = StudyPlan::new(&study(text).unwrap(), Shard::WHOLE).unwrap_err();
    assert!(matches!(refused, StudyError::KeptOblong), "{refused}");
}
