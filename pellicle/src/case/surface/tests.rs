//! The keys of `[surface]`, and the messages about invalid ones.

use super::super::foundation::FoundationCase;
use super::super::foundation::strength::BodyStrengthCase;
use super::super::foundation::substrate::{MaterialCase, SubstrateCase};
use super::*;
use crate::input::table_reader::tests::read_table;

fn read(text: &str) -> Result<SurfaceCase, String> {
    let material = MaterialCase {
        young_modulus: 10.0,
        poisson_ratio: 0.3,
        strength: BodyStrengthCase::default(),
    };
    let foundation = FoundationCase {
        substrate: SubstrateCase::Elastic(material),
        layer: Vec::new(),
    };
    read_table(text, |table| {
        let maps = MapSources::default();
        let scope = Scope {
            maps: Some(&maps),
            foundation: Some(&foundation),
            ..Scope::default()
        };
        SurfaceCase::read(&table, &scope)
    })
}

const CYLINDERS: &str = "kind = \"cylinders\"\nradius = 1\nheight = 2\nperiod = 3\n";

#[test]
fn cylinders_default_to_the_modulus_of_the_topmost_body() {
    let Ok(SurfaceCase::Cylinders(cylinders)) = read(CYLINDERS) else {
        panic!("not cylinders")
    };
    assert_eq!(cylinders.young_modulus, 10.0);
    assert_eq!(cylinders.offset, [0.0, 0.0]);
}

#[test]
fn a_surface_is_bare_by_default() {
    assert_eq!(read(""), Ok(SurfaceCase::Bare));
}

#[test]
fn overlapping_cylinders_are_reported_at_their_radius() {
    let message = read(&CYLINDERS.replace("radius = 1", "radius = 1.6")).unwrap_err();
    assert!(
        message.starts_with("case.toml, line 2, key `radius`: found 1.6"),
        "{message}"
    );
    assert!(message.contains("overlap"), "{message}");
}

#[test]
fn keys_of_another_kind_of_surface_are_unknown() {
    let message =
        read("kind = \"film\"\nthickness = 1\nyoung_modulus = 1\nradius = 3").unwrap_err();
    assert!(
        message.starts_with("case.toml, line 4, key `radius`: found an unknown key"),
        "{message}"
    );
}

#[test]
fn springs_are_linear_by_default() {
    let film = "kind = \"film\"\nthickness = 1\nyoung_modulus = 1\n";
    for (text, linear) in [(CYLINDERS, "law = \"linear\""), (film, "law = \"linear\"")] {
        let law = |law: &str| {
            let relief = read(&format!("{text}{law}")).unwrap().build().unwrap();
            relief.spring_law().is_linear()
        };
        assert!(law("") && law(linear) && !law("law = \"logarithmic\""));
    }
    let map = "kind = \"map\"\nfile = \"a.npy\"\ncompliance = 1\nlaw = \"logarithmic\"";
    let message = read(map).unwrap_err();
    assert!(
        message.contains("key `law`: found \"logarithmic\", wanted \"linear\", or young_modulus"),
        "{message}"
    );
    let rough = read("kind = \"rough\"\nfile = \"a.npy\"\nlaw = \"linear\"").unwrap_err();
    assert!(rough.contains("key `law`: found an unknown key"), "{rough}");
}

#[test]
fn invalid_surfaces_are_rejected() {
    for text in [
        "kind = \"cilinders\"",
        "kind = 3",
        "kind = \"map\"",
        "kind = \"map\"\nfile = \"a.npy\"",
        "kind = \"map\"\ncompliance = 0",
        "kind = \"map\"\nfile = \"a.npy\"\ncompliance = 0\nyoung_modulus = 1",
        "kind = \"film\"\nthickness = 1",
        "kind = \"film\"\nthickness = 1\nyoung_modulus = 1\nlaw = \"cubic\"",
        "kind = \"bare\"\nlaw = \"linear\"",
        "radius = 1",
    ] {
        assert!(read(text).is_err(), "{text}");
    }
    for change in [
        "offset = [1]",
        "offset = 1",
        "offset = [1, nan]",
        "lattice = \"cubic\"",
    ] {
        assert!(read(&format!("{CYLINDERS}{change}")).is_err(), "{change}");
    }
}

const DIMPLES: &str = "kind = \"dimples\"\nradius = 1\ndepth = 0.2\n";
const GROOVES: &str = "kind = \"grooves\"\nwidth = 1\ndepth = 0.2\n";

#[test]
fn impossible_patterns_are_refused_at_the_key_that_makes_them_so() {
    let cylinders: &[_] = &[
        ("edge_radius = 1.1", "edge_radius", "at most 1.0"),
        ("edge_radius = -1", "edge_radius", "found -1"),
    ];
    let dimples: &[_] = &[
        ("period = 1.9", "radius", "overlapping circles"),
        ("area_fraction = 1", "area_fraction", "between 0 and 1"),
        ("area_fraction = 0.8", "area_fraction", "at most 0.7854"),
        (
            "area_fraction = 0.91\nlattice = \"hexagonal\"",
            "area_fraction",
            "at most 0.9069",
        ),
        (
            "period = 3\narea_fraction = 0.1",
            "area_fraction",
            "found period and area_fraction",
        ),
        ("", "period", "exactly one of period and area_fraction"),
        (
            "period = 2.1\nedge_radius = 1",
            "edge_radius",
            "more than the period",
        ),
        ("period = 3\nlaw = \"logarithmic\"", "law", "young_modulus"),
    ];
    let grooves: &[_] = &[
        ("period = 0.9", "width", "less than the period"),
        (
            "period = 2\nedge_radius = 0.3",
            "edge_radius",
            "at most 0.2",
        ),
        (
            "period = 2\nprofile = \"sine\"\nedge_radius = 0.1",
            "edge_radius",
            "at most 0",
        ),
        ("area_fraction = 0", "area_fraction", "between 0 and 1"),
    ];
    let all = [
        (CYLINDERS, cylinders),
        (DIMPLES, dimples),
        (GROOVES, grooves),
    ];
    for (kind, faults) in all {
        for (more, key, reason) in faults {
            let message = read(&format!("{kind}{more}")).unwrap_err();
            let names_the_key = message.contains(&format!("key `{key}`"));
            assert!(
                names_the_key && message.contains(reason),
                "{more}: {message}"
            );
        }
    }
    let deep = read(&DIMPLES.replace("0.2", "1.2\nperiod = 3")).unwrap_err();
    assert!(
        deep.contains("key `depth`") && deep.contains("half a sphere"),
        "{deep}"
    );
}

#[test]
fn a_pattern_is_the_same_by_its_period_and_by_its_area_fraction() {
    let build = |text: String| read(&text).unwrap().build().unwrap();
    for (kind, period, fraction) in [
        (DIMPLES, 4.0, std::f64::consts::PI / 16.0),
        (GROOVES, 4.0, 0.25),
    ] {
        let relief = build(format!("{kind}area_fraction = {fraction}"));
        for vector in [[period, 0.0], [0.0, period]] {
            let misfit = relief.distance_to_translation(vector).unwrap();
            assert!(misfit < 1e-14, "{kind}: {misfit}");
        }
    }
}

#[test]
fn recesses_are_in_the_bodys_own_surface_unless_they_have_a_modulus() {
    let springs = |more: &str| {
        let relief = read(&format!("{DIMPLES}period = 3\n{more}"))
            .unwrap()
            .build();
        relief.unwrap().height()
    };
    assert_eq!(springs(""), None);
    assert_eq!(
        springs("young_modulus = 1\nlaw = \"logarithmic\""),
        Some(0.2)
    );
}
