//! Eight indentations of tungsten with a rounded tip: elastic up to a pop-in, with markers.

use pellicle_identify::measured::exclusion::ExclusionReason;

use super::{check_ends, codes, excluded, one, read, refused};

const TABLE: &str = r#"
columns = { depth = "depth", force = "load", time = "time", marker = "marker" }
units = { depth = "nm", force = "mN" }
"#;

#[test]
fn every_elastic_segment_ends_at_its_pop_in() {
    let segment = "segment = { until = \"largest depth step\" }";
    let curves = read(&format!(
        "file = \"tungsten_sphere_test*.csv\"\n{TABLE}{segment}"
    ))
    .unwrap();
    // The last point before the pop-in, read from the files: row, depth in nm, force in mN.
    let wanted = [
        (774, 30.960_204_619_931_6, 0.812_086_615_131_596),
        (1061, 35.953_678_611_055_2, 1.115_032_363_683_71),
        (1049, 35.403_683_018_359, 1.104_697_784_742_07),
        (1000, 34.918_090_636_192_9, 1.045_895_193_768_8),
        (988, 34.241_744_657_991_4, 1.041_008_066_132_8),
        (1040, 35.761_170_299_300_9, 1.093_748_238_803_17),
        (980, 33.771_645_765_205_6, 1.030_981_936_844_21),
        (1024, 35.749_411_627_997_3, 1.077_777_706_011_95),
    ];
    assert_eq!(curves.len(), wanted.len());
    for (curve, (row, depth, force)) in curves.iter().zip(wanted) {
        let file = curve.file.display();
        assert_eq!(
            (curve.rows[0], *curve.rows.last().unwrap()),
            (1, row),
            "{file}"
        );
        check_ends(curve.depth(), 0.0, depth * 1e-9);
        check_ends(curve.force(), 0.0, force * 1e-3);
        assert!((30e-9..37e-9).contains(curve.depth().unwrap().last().unwrap()));
        assert!((0.8e-3..1.12e-3).contains(curve.force().unwrap().last().unwrap()));
        assert_eq!(codes(curve).len(), 0, "{file}: {:?}", curve.warnings);
    }
}

#[test]
fn a_segment_bounded_by_forces_may_end_before_the_pop_in() {
    let segment =
        "segment = { from = \"0.01 mN\", to = \"0.8 mN\", until = \"largest depth step\" }";
    let curve = one(&format!(
        "file = \"tungsten_sphere_test05.csv\"\n{TABLE}{segment}"
    ));
    let force = curve.force().unwrap();
    assert!(force.iter().all(|force| (0.01e-3..=0.8e-3).contains(force)));
    // There is no distinct step below 0.8 mN.
    assert_eq!(codes(&curve), ["no-depth-step"]);
    let counted: usize = curve.excluded.iter().map(|found| found.count).sum();
    assert_eq!(counted + curve.rows.len(), curve.table_rows);
}

#[test]
fn markers_bound_a_segment() {
    let file = "file = \"tungsten_sphere_test01.csv\"\n";
    let segment = "segment = { from = { marker = \"Surface Index Coarse\" }, to = { marker = \"End Of Loading Index\" } }";
    let curve = one(&format!("{file}{TABLE}{segment}"));
    assert_eq!((curve.rows[0], *curve.rows.last().unwrap()), (8, 2846));
    check_ends(curve.time(), 0.075_958_099_999_994, 30.327_418_3);
    assert_eq!(excluded(&curve, ExclusionReason::BeforeSegment), 7);
    let found = refused(&format!(
        "{file}{TABLE}segment = {{ to = {{ marker = \"End\" }} }}"
    ));
    assert!(
        found.contains("key `data[0].segment.to`")
            && found.contains("\"Surface Index\", \"Surface Index Coarse\""),
        "{found}"
    );
}

#[test]
fn rows_and_times_bound_a_segment() {
    let file = "file = \"tungsten_sphere_test02.csv\"\n";
    let curve = one(&format!("{file}{TABLE}segment = {{ from = 11, to = 510 }}"));
    assert_eq!((curve.rows[0], curve.rows.len()), (11, 500));
    let curve = one(&format!(
        "{file}{TABLE}segment = {{ from = \"1 s\", to = \"2000 ms\" }}"
    ));
    let time = curve.time().unwrap();
    assert!(time.iter().all(|time| (1.0..=2.0).contains(time)) && time.len() > 80);
}
