//! Files of force microscopes and cantilever indenters: AFM Workshop, JPK, Optics11.

use pellicle_identify::measured::exclusion::ExclusionReason;

use super::invented::read;
use super::{check_ends, codes, excluded, one, refused};

const WORKSHOP: &str = "file = \"fmt-afm-workshop*.csv\"\n";

#[test]
fn extend_and_retract_side_by_side_are_separate_columns() {
    let extend = "columns = { height = \"Extend Z-Sense\", force = \"Extend Force\" }\nspring_constant = \"40 N/m\"";
    let curve = one(&format!("{WORKSHOP}{extend}"));
    assert_eq!((curve.table_rows, curve.rows.len()), (1015, 1015));
    check_ends(curve.force(), 1276.4373e-9, 4240.6828e-9);
    // The height grows towards the surface: 18452.4571 nm − 15072.4571 nm.
    let approach = curve.approach().unwrap();
    assert!((approach[1014] - 3380e-9).abs() < 1e-20);
    // δ = 3380 nm − (4240.6828 − 1276.4373) nN/(40 N/m), rounded a few times at 2e-5 m.
    let depth = curve.depth().unwrap();
    assert!((depth[1014] - (3380.0 - 2964.2455 / 40.0) * 1e-9).abs() < 2e-20);
    let retract = "columns = { height = 3, force = 4 }\nspring_constant = \"40 N/m\"\nsegment = { part = \"unloading\" }\nbaseline = \"off\"";
    let curve = one(&format!("{WORKSHOP}{retract}"));
    check_ends(curve.force(), 3809.6950e-9, 1282.1253e-9);
    let depth = curve.depth().unwrap();
    assert!(depth[0] == 0.0 && depth[1014] < -3e-6);
}

#[test]
fn a_height_without_spring_constant_and_a_retract_read_as_loading_are_refused() {
    let found = refused(&format!("{WORKSHOP}columns = {{ height = 1, force = 2 }}"));
    assert!(
        found.contains("key `data[0].spring_constant`") && found.contains("\"0.04 N/m\""),
        "{found}"
    );
    let found = refused(&format!(
        "{WORKSHOP}columns = {{ height = 3, force = 4 }}\nspring_constant = 40"
    ));
    assert!(
        found.contains("an unloading, wanted a loading, or part = \"unloading\""),
        "{found}"
    );
}

const JPK: &str = r#"
file = "jpk_spot3-0192.csv"
columns = { height = "height measured", force = "force", time = "time", segment = "segment" }
spring_constant = { mean = "0.043493666407368466 N/m", sd = "0.004 N/m" }
"#;

#[test]
fn a_jpk_table_has_comments_segments_and_heights_that_increase_away_from_the_sample() {
    let curve = one(&format!(
        "{JPK}segment = {{ value = 0 }}\nbaseline = \"off\""
    ));
    assert_eq!((curve.table_rows, curve.rows.len()), (4000, 2000));
    assert_eq!(excluded(&curve, ExclusionReason::OtherSegment), 2000);
    check_ends(curve.force(), -5.1455792e-10, 3.4799183e-9);
    // Larger is farther away: 22.815672 µm − 17.817248 µm of approach.
    let approach = curve.approach().unwrap();
    assert!((approach[1999] - 4.998424e-6).abs() < 1e-20);
    let bent = (3.4799183e-9 + 5.1455792e-10) / 0.043493666407368466;
    assert!((curve.depth().unwrap()[1999] - (4.998424e-6 - bent)).abs() < 2e-20);
    // A stiffer spring bends half as much.
    let stiffer = curve.depth_with(2.0 * 0.043493666407368466).unwrap();
    assert!((stiffer[1999] - (4.998424e-6 - bent / 2.0)).abs() < 2e-20);
    assert_eq!(codes(&curve).len(), 0);
}

#[test]
fn the_retract_of_a_jpk_table_is_not_a_loading() {
    let found = refused(&format!("{JPK}segment = {{ value = 1 }}"));
    assert!(
        found.contains("key `data[0].segment`") && found.contains("an unloading"),
        "{found}"
    );
    // A cell gives back a part of the work.
    let found = refused(&format!(
        "{JPK}segment = {{ value = 1, part = \"unloading\" }}"
    ));
    assert!(
        found.contains("key `data[0].segment.part`")
            && found.contains("% of the work of the loading"),
        "{found}"
    );
    let found = refused(&format!("{JPK}segment = {{ value = \"pause\" }}"));
    assert!(
        found.contains("segment \"pause\" among \"0\", \"1\""),
        "{found}"
    );
}

#[test]
fn an_optics11_file_has_a_long_header_and_its_own_indentation() {
    let columns = "columns = { depth = \"Indentation (nm)\", force = \"Load (uN)\", time = 1 }";
    let curve = one(&format!("file = \"optics11*.txt\"\n{columns}"));
    assert_eq!((curve.table_rows, curve.rows.len()), (2500, 2164));
    assert_eq!(curve.header[4], "Piezo (nm)");
    check_ends(curve.force(), 0.001509e-6, 0.04924e-6);
    check_ends(curve.depth(), 0.0, 12405.641064e-9);
    check_ends(curve.time(), 10.5, 12.663);
}

#[test]
fn piezo_and_load_of_an_optics11_file_give_the_indentation_that_it_states() {
    let columns = "columns = { height = \"Piezo\", force = \"Load\" }\nspring_constant = \"0.019 N/m\"\nbaseline = \"off\"";
    let curve = one(&format!("file = \"optics11*.txt\"\n{columns}"));
    let depth = curve.depth().unwrap();
    let stated = one("file = \"optics11*.txt\"\ncolumns = { depth = 3, force = 2 }");
    let stated = stated.depth().unwrap();
    // From 2 µm on, so that both count from the same point. Loads are given to 1 pN, which is 0.05 nm on this spring.
    let from = stated.iter().position(|depth| *depth > 2e-6).unwrap();
    for point in from..stated.len() {
        let difference = (depth[point] - depth[from]) - (stated[point] - stated[from]);
        assert!(difference.abs() < 0.2e-9, "{difference:e}");
    }
}

#[test]
fn the_deflection_of_an_optics11_file_gives_the_load_that_it_states() {
    let columns = "columns = { height = \"Piezo\", deflection = \"Cantilever\" }\nspring_constant = 0.019\nbaseline = \"off\"";
    let curve = one(&format!("file = \"optics11*.txt\"\n{columns}"));
    let stated = one("file = \"optics11*.txt\"\ncolumns = { depth = 3, force = 2 }");
    assert_eq!(curve.rows.len(), stated.rows.len());
    for (force, stated) in curve.force().unwrap().iter().zip(stated.force().unwrap()) {
        // Loads are given to 1 pN.
        assert!((force - stated).abs() < 0.51e-12, "{force:e} {stated:e}");
    }
    // Another spring constant scales the force; the penetration is the approach minus the deflection in any case.
    let stiffer = one(&format!("file = \"optics11*.txt\"\n{columns}").replace("0.019", "0.038"));
    let doubled = stiffer.force().unwrap();
    assert!((doubled[2000] - 2.0 * curve.force().unwrap()[2000]).abs() < 1e-20);
    let (approach, deflection) = (curve.approach().unwrap(), curve.deflection().unwrap());
    let penetration = approach[2000] - (deflection[2000] - deflection[0]);
    // Rounded at 1e-5 m.
    assert!((curve.depth().unwrap()[2000] - penetration).abs() < 1e-20);
    let both = "columns = { height = 5, deflection = 4, force = 2 }\nspring_constant = 0.019";
    let found = refused(&format!("file = \"optics11*.txt\"\n{both}"));
    assert!(
        found.contains("found force and deflection, wanted one of them"),
        "{found}"
    );
}

/// Heights (nm, away) and forces (nN) of an approach and a retraction of 200 rows each: a line that falls by `fall`
/// over 1400 nm, and a contact over 600 nm that rises by 4 nN.
fn on_a_falling_line(fall: f64) -> String {
    let force = |z: f64, i: usize| {
        let contact = 4.0 * ((z - 1400.0).max(0.0) / 600.0).powf(1.5);
        contact - fall * z / 1400.0 + 0.01 * (2.4 * i as f64).sin()
    };
    let row = |i: usize| {
        let z = 10.0 * if i < 200 { i } else { 399 - i } as f64;
        format!("{},{}\n", 9000.0 - z, force(z, i))
    };
    (0..400).map(row).collect()
}

#[test]
fn the_baseline_of_a_curve_may_fall_by_more_than_its_contact_rises() {
    for fall in [2.0, 5.0] {
        for part in ["loading", "unloading"] {
            let table = format!(
                "file = \"a.txt\"\ncolumns = {{ height = 1, force = 2 }}\nunits = {{ height = \"nm\", force = \"nN\" }}\n\
                 spring_constant = \"0.1 N/m\"\nheight_direction = \"away\"\nsegment = {{ part = \"{part}\" }}"
            );
            let curve = read(&table, on_a_falling_line(fall).as_bytes()).unwrap();
            // Of the two rows at the largest height, one or both.
            assert!(curve.rows.len().abs_diff(200) <= 1, "{fall} {part}");
            let before = curve.before_contact.expect("a line before the contact");
            assert!(before.is_subtracted && !before.is_bent, "{fall} {part}");
            let slope = -fall * 1e-9 / 1400e-9;
            assert!((before.line.slope / slope - 1.0).abs() < 0.03, "{before:?}");
            let force = curve.force().unwrap();
            let most = force.iter().copied().fold(0.0, f64::max);
            assert!((most / 3.95e-9 - 1.0).abs() < 0.05, "{most}");
        }
    }
}
