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
