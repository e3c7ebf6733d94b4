//! The results table: after a kill, under two processes, in parts.

use super::*;

#[test]
fn results_are_flushed_to_disk_in_groups() {
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
        // The rows have left the process all the same.
        let text = fs::read(table.path()).unwrap();
        assert_eq!(blocks(&text, &identity).blocks.len(), 100 * (group + 1));
        while let Some(file) = table.unforced().unwrap() {
            file.force().unwrap();
            forced += 1;
        }
    }
    assert_eq!(forced, 3);
}

/// Returns two rows for a solved case, one for a failed one.
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
    let place = StudyFolder::claim(folder, identity, false, &|_| Ok(())).unwrap();
    ResultsTable::open(place, identity).unwrap()
}

#[test]
fn a_table_cut_at_any_byte_keeps_exactly_its_whole_cases() {
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
fn a_table_is_repaired_continued_and_sorted() {
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
fn a_table_of_another_origin_is_not_touched() {
    let folder = tempfile::tempdir().unwrap();
    let identity = plan(TWO_KEYS, Shard::WHOLE).identity;
    let path = identity.table(folder.path());
    fs::write(&path, "mine\n").unwrap();
    for fresh in [false, true] {
        let claimed = StudyFolder::claim(folder.path(), &identity, fresh, &|_| Ok(()));
        assert!(matches!(
            claimed,
            Err(StudyError::File(
                pellicle_files::FileError::NoResults { .. }
            ))
        ));
        assert_eq!(fs::read_to_string(&path).unwrap(), "mine\n");
    }
}

#[test]
fn a_table_is_open_in_one_process_at_a_time() {
    let folder = tempfile::tempdir().unwrap();
    let identity = plan(TWO_KEYS, Shard::WHOLE).identity;
    let _first = table(folder.path(), &identity);
    let second = StudyFolder::claim(folder.path(), &identity, true, &|_| Ok(()));
    assert!(second.unwrap_err().to_string().contains("another process"));
}

/// Writes the parts in `done`, of three.
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
fn parts_are_merged_only_if_no_case_is_missing() {
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
fn a_line_break_inside_quotes_does_not_end_a_row() {
    let text = TWO_KEYS.replace("grid.elements", "title").replace(
        "{ from = 32, to = 128, count = 3, spacing = \"log\" }",
        "[\"first\", \"second\", \"e,f\"]",
    );
    let study = study(&text).unwrap();
    let plan = StudyPlan::new(&study, Shard::WHOLE).unwrap();
    let rows = (0..9).map(|case| plan.columns.failed(&study, case, "why"));
    let table = format!("{}\n{}", plan.identity.header, rows.collect::<String>());
    // As a version that allowed such text has written it.
    let table = table.replace("first", "\"a\nb\"");
    let table = table.replace("second", "\"c\r\n\"\"d\"");
    for cut in 0..=table.len() {
        let found = blocks(&table.as_bytes()[..cut], &plan.identity);
        let end = usize::try_from(found.end).unwrap();
        let again = blocks(&table.as_bytes()[..end], &plan.identity);
        assert_eq!(again, found, "{cut}");
        assert!(cut < table.len() || found.blocks.len() == 9, "{cut}");
    }
}

#[test]
fn the_folder_is_locked_until_the_table_is_sorted() {
    let folder = tempfile::tempdir().unwrap();
    let identity = plan(TWO_KEYS, Shard::WHOLE).identity;
    let columns = identity.header.split(',').count();
    let mut opened = table(folder.path(), &identity);
    for case in (0..9).rev() {
        let rows = rows(columns, case, CaseStatus::Certified);
        opened.add(case, CaseStatus::Certified, &rows).unwrap();
    }
    // A process that has the table's old file open does not hold the folder.
    let old = fs::File::open(identity.table(folder.path())).unwrap();
    assert!(StudyFolder::claim(folder.path(), &identity, false, &|_| Ok(())).is_err());
    opened.finish(&identity).unwrap();
    let again = table(folder.path(), &identity);
    assert_eq!(again.tally().done(), 9);
    assert!(!pellicle_files::lock::is_at(&old, again.path()));
}
