//! `pellicle identify --each`: curves with positions, each fitted alone.

use std::fs;

use super::draft::{STIFFNESS, approach, in_nanometres, table};
use super::runner::{TestFolder, names};

/// Three curves with positions, one of them a misfit, and a file of text.
fn map() -> TestFolder {
    let folder = TestFolder::new();
    let write = |name: &str, place: [f64; 2], rows: &[[f64; 2]]| {
        let [x, y] = place;
        let head = format!(
            "X (um)\t{x}\nY (um)\t{y}\nk (N/m)\t0.05\nTip radius (um)\t5\nZ (nm)\tForce (nN)\n"
        );
        fs::write(
            folder.path(name),
            table(&head, &in_nanometres(rows), '\t', '.'),
        )
        .unwrap();
    };
    for seed in 1..4 {
        write(
            &format!("p{seed}.txt"),
            [f64::from(u32::try_from(seed).unwrap()), 2.0],
            &approach(seed),
        );
    }
    // Ever stiffer than Hertz: a base below.
    let stiffer = |[z, f]: [f64; 2]| {
        let more = f * f / 4e-9;
        [z + more / STIFFNESS, f + more]
    };
    let stiff: Vec<_> = approach(4).into_iter().map(stiffer).collect();
    write("p4.txt", [1.0, 4.0], &stiff);
    let ran = folder.run(&["init", "fit", "--from", "p*.txt"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    fs::write(folder.path("p5.txt"), "X (um)\t2\nY (um)\t4\nno curve\n").unwrap();
    folder
}

#[test]
fn each_curve_alone_gives_a_table_and_a_map_and_one_that_fails_stops_no_other() {
    let folder = map();
    let fit = fs::read_to_string(folder.path("p1.toml")).unwrap();
    assert!(fit.contains("file = \"*.txt\""), "{fit}");
    // The constants are in the files, which are compared with the fit file.
    let ran = folder.run(&["identify", "p1.toml", "--each"]);
    assert_eq!(ran.code, Some(2), "{}", ran.stderr);
    assert!(
        ran.stderr.contains("1 of 5 curves failed"),
        "{}",
        ran.stderr
    );
    let results = folder.path("results/p1-each");
    assert!(ran.stderr.contains("5 curves: 3 fitted"), "{}", ran.stderr);
    assert_eq!(
        names(&results),
        ["each-map.png", "each-map.svg", "each.csv", "each.json"]
    );
    let text = fs::read_to_string(results.join("each.csv")).unwrap();
    let rows: Vec<Vec<&str>> = text.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(
        rows[0][..5],
        [
            "file",
            "x [m]",
            "y [m]",
            "fit",
            "foundation.substrate.young_modulus [Pa]"
        ]
    );
    for row in &rows[1..4] {
        assert_eq!(row[3], "fitted", "{row:?}");
        let [value, low, high] = [4, 5, 6].map(|cell| row[cell].parse::<f64>().unwrap());
        assert!(
            low < value && value < high && (value / 1e4 - 1.0).abs() < 0.03,
            "{row:?}"
        );
    }
    assert_ne!(rows[4][3], "fitted", "{:?}", rows[4]);
    assert_eq!(rows[5][3], "failed");
    assert!(
        text.lines().nth(5).unwrap().contains("found no table"),
        "{text}"
    );
    assert!(
        rows[4][0].ends_with("p4.txt") && rows[4][1..3] == ["1e-6", "4e-6"],
        "{:?}",
        rows[4]
    );
}
