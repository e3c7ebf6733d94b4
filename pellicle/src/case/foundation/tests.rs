//! Foundations read from text and split.

use pellicle_kernel::Layer;

use super::layer::{InterfaceCase, NamedInterface};
use super::*;
use crate::input::table_reader::tests::read_table;

fn read(text: &str) -> Result<FoundationCase, String> {
    read_table(text, |table| {
        FoundationCase::read(&table, &Scope::default())
    })
}

const SUBSTRATE: &str = "substrate = { young_modulus = \"7 GPa\", poisson_ratio = 0.4 }\n";
const LAYER: &str =
    "[[layer]]\nthickness = \"10 nm\"\nyoung_modulus = \"70 GPa\"\npoisson_ratio = 0.3\n";

#[test]
fn layers_are_read_from_the_surface_down() {
    let foundation = read(&format!("{SUBSTRATE}{LAYER}interface = \"frictionless\"")).unwrap();
    assert_eq!(foundation.layer.len(), 1);
    assert_eq!(foundation.layer[0].thickness, 1e-8);
    let sliding = InterfaceCase::Named(NamedInterface::Frictionless);
    assert_eq!(foundation.layer[0].interface, sliding);
    assert_eq!(foundation.surface_young_modulus(), Some(70e9));
}

/// Splits a layer with this graded modulus on the substrate.
fn graded(modulus: &str) -> Result<SplitFoundation, String> {
    let layer = LAYER.replace("\"70 GPa\"", modulus);
    let foundation = read(&format!("{SUBSTRATE}{layer}"))?;
    Ok(foundation.split().unwrap())
}

#[test]
fn an_interface_may_have_spring_compliances() {
    let spring = "interface = { normal_compliance = 0, shear_compliance = \"2 nm/GPa\" }";
    let foundation = read(&format!("{SUBSTRATE}{LAYER}{spring}")).unwrap();
    let built = foundation.split().unwrap().foundation;
    let interface = built.layers()[0].interface();
    assert_eq!(interface.shear_compliance(), 2e-18);
    assert_eq!(interface.normal_compliance(), 0.0);
    for (interface, wanted) in [
        ("{ shear_compliance = 1e-18 }", "normal_compliance"),
        (
            "{ normal_compliance = -1e-18, shear_compliance = 0 }",
            "a compliance of zero or more",
        ),
        (
            "{ normal_compliance = 0, shear_compliance = \"1 GPa\" }",
            "a compliance of zero or more",
        ),
        (
            "{ normal_compliance = 0, shear_compliance = 0, stiffness = 1 }",
            "stiffness",
        ),
        ("\"glued\"", "bonded"),
    ] {
        let refused = read(&format!("{SUBSTRATE}{LAYER}interface = {interface}")).unwrap_err();
        let text = format!("{refused:?} {refused}");
        assert!(text.contains(wanted), "{interface}: {text}");
    }
}

#[test]
fn a_graded_layer_is_split_until_its_compliance_converges() {
    for (profile, middle) in [("linear", 40e9), ("exponential", 10e9 * 7_f64.sqrt())] {
        let grading = format!("{{ from = \"10 GPa\", to = \"70 GPa\", profile = \"{profile}\" }}");
        let SplitFoundation { foundation, splits } = graded(&grading).unwrap();
        let layers = foundation.layers();
        let [split] = splits[..] else {
            panic!("{splits:?}")
        };
        assert_eq!((split.layer, split.sublayers), (0, layers.len()));
        assert!(split.error > 0.0 && split.error <= 1e-4, "{}", split.error);
        let thickness: f64 = layers.iter().map(Layer::thickness).sum();
        approx::assert_relative_eq!(thickness, 1e-8, max_relative = 1e-12);
        let mut depth = 0.0;
        let of_middle = layers.iter().find(|layer| {
            depth += layer.thickness();
            depth > 0.5e-8
        });
        let modulus = of_middle.unwrap().material().young_modulus();
        assert!(
            (modulus / middle - 1.0).abs() < 0.1,
            "{profile}: {modulus:e}"
        );
    }
}

#[test]
fn a_layer_graded_between_equal_moduli_is_homogeneous() {
    let same = graded("{ from = \"70 GPa\", to = \"70 GPa\", profile = \"linear\" }").unwrap();
    let one = graded("\"70 GPa\"").unwrap().foundation;
    for k in [1e6, 1e8, 1e10] {
        let (split, whole) = (same.foundation.compliance(k), one.compliance(k));
        approx::assert_relative_eq!(split, whole, max_relative = 1e-12);
    }
}

#[test]
fn an_invalid_grading_is_reported_at_its_key() {
    let message = |modulus: &str| graded(modulus).err().unwrap();
    for (modulus, wanted) in [
        ("{ from = 1, to = 2 }", "young_modulus.profile`"),
        (
            "{ from = 1, to = 2, profile = \"liner\" }",
            "wanted one of \"linear\", \"exponential\"",
        ),
        (
            "{ from = 0, to = 2, profile = \"linear\" }",
            "young_modulus.from`",
        ),
        (
            "{ from = 1, too = 2, profile = \"linear\" }",
            "young_modulus.too`",
        ),
        ("[1, 2]", "young_modulus`"),
    ] {
        assert!(message(modulus).contains(wanted), "{}", message(modulus));
    }
}

#[test]
fn layers_may_rest_on_a_rigid_base() {
    let foundation = read(&format!("substrate = \"rigid\"\n{LAYER}")).unwrap();
    assert_eq!(foundation.substrate, SubstrateCase::Rigid);
    // A base alone may lie below an elastic indenter.
    assert!(read("substrate = \"rigid\"").unwrap().is_rigid());
    let alone = Source::new("case.toml", "[foundation]\nsubstrate = \"rigid\"".into());
    assert!(FoundationCase::parse(&Arc::new(alone)).is_err());
}

#[test]
fn a_layer_without_thickness_is_reported_at_its_header() {
    let text = format!(
        "{SUBSTRATE}{}",
        LAYER.replace("thickness = \"10 nm\"\n", "")
    );
    assert_eq!(
        read(&text).unwrap_err(),
        "case.toml, line 2, key `layer[0].thickness`: found no such key, \
         wanted a positive length such as \"5 nm\", or a bare number"
    );
}

#[test]
fn an_impossible_poissons_ratio_is_reported_at_its_key() {
    for ratio in ["0.6", "-0.1", "nan", "\"0.3\""] {
        let text = format!(
            "{SUBSTRATE}{}",
            LAYER.replace("ratio = 0.3", &format!("ratio = {ratio}"))
        );
        let message = read(&text).unwrap_err();
        assert!(
            message.starts_with(&format!(
                "case.toml, line 5, key `layer[0].poisson_ratio`: found {ratio}"
            )),
            "{message}"
        );
        assert!(message.contains("[0, 0.5]"), "{message}");
    }
}

#[test]
fn invalid_foundations_are_rejected() {
    let faulty = [
        "",
        "substrate = \"rigit\"",
        "substrate = 3",
        "substrate = { young_modulus = \"5 nm\", poisson_ratio = 0.3 }",
        "substrate = { young_modulus = 1 }",
        "substrate = { young_modulus = 1, poisson_ratio = 0.3, density = 1 }",
        "substrate = \"rigid\"\n[layer]\nthickness = 1",
        "substrate = \"rigid\"\nlayer = [1]",
    ];
    for text in faulty {
        assert!(read(text).is_err(), "{text}");
    }
}

#[test]
fn a_residual_stress_beyond_small_strains_is_reported_at_its_key() {
    let with = |stress: &str| read(&format!("{SUBSTRATE}{LAYER}residual_stress = \"{stress}\""));
    assert_eq!(with("-5 GPa").unwrap().layer[0].residual_stress, -5e9);
    for stress in ["-8 GPa", "8 GPa", "2000 GPa"] {
        let message = with(stress).unwrap_err();
        assert!(
            message.contains("key `layer[0].residual_stress`") && message.contains("a tenth"),
            "{message}"
        );
    }
}
