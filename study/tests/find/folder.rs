//! The folder of a search: what is solved stays solved, and another search is refused.

use pellicle_study::find::folder::SearchFolder;

use super::*;

#[test]
fn an_interrupted_search_solves_no_case_twice_and_finds_the_same() {
    let search = search(BALL, "max_pressure < 1 GPa", "load.force", None);
    let (answer, tried) = run(&search, vec![]);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("found");
    let (claimed, before) = SearchFolder::claim(&path, &search, false).unwrap();
    assert!(before.is_empty());
    claimed.write(&search, &tried, None).unwrap();
    drop(claimed);
    let (_claimed, before) = SearchFolder::claim(&path, &search, false).unwrap();
    assert_eq!(before, tried);
    // With a changed number in place of a solved one, the answer changes.
    let mut wrong = before.clone();
    for tried in &mut wrong {
        tried.number = tried.number.map(|number| 1.1 * number);
    }
    assert_eq!(run(&search, before).0, answer);
    assert_ne!(run(&search, wrong).0.value, answer.value);
}

#[test]
fn another_search_in_the_folder_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("found");
    let first = search(BALL, "max_pressure < 1 GPa", "load.force", None);
    SearchFolder::claim(&path, &first, false).unwrap();
    let same = search(BALL, "max_pressure < 2 GPa", "load.force", None);
    assert!(SearchFolder::claim(&path, &same, false).is_ok());
    let wider = search(
        BALL,
        "max_pressure < 1 GPa",
        "load.force",
        Some(["1 mN", "9 N"]),
    );
    assert!(SearchFolder::claim(&path, &wider, false).is_ok());
    let other = search(BALL, "contact_area < 1 mm^2", "load.force", None);
    let refused = |other: &Search| {
        let refused = SearchFolder::claim(&path, other, false);
        refused.unwrap_err().to_string()
    };
    let found = refused(&other);
    assert!(
        found.contains(
            "found a search whose number is max pressure, wanted contact area: give --fresh"
        ),
        "{found}"
    );
    let between = Some(["1 mm", "9 mm"]);
    let found = refused(&search(
        BALL,
        "max_pressure < 1 GPa",
        "indenter.radius",
        between,
    ));
    assert!(
        found.contains("found a search whose key is load.force, wanted indenter.radius"),
        "{found}"
    );
    let glass = BALL.replace("206 GPa", "70 GPa");
    let found = refused(&search(&glass, "max_pressure < 1 GPa", "load.force", None));
    assert!(
        found.contains("found a search whose case is one with other values, wanted this one"),
        "{found}"
    );
    assert!(SearchFolder::claim(&path, &other, true).is_ok());
    // A case without a value of the key is that of its range.
    let without = BALL.replace("force = \"1 N\"", "");
    let of = |low| {
        search(
            &without,
            "max_pressure < 1 GPa",
            "load.force",
            Some([low, "9 N"]),
        )
    };
    SearchFolder::claim(&path, &of("2 N"), true).unwrap();
    let found = refused(&of("1 N"));
    assert!(
        found.contains(
            "whose range of load.force is 2.0000 N to 9.0000 N, wanted 1.0000 N to 9.0000 N"
        ),
        "{found}"
    );
    std::fs::write(folder.path().join("own.txt"), "mine").unwrap();
    assert!(SearchFolder::claim(folder.path(), &other, true).is_err());
}
