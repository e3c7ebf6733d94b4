//! The keys of `[stress]`, and the model built from them.

use super::*;
use crate::input::table_reader::tests::read_table;

const LAYER: &str =
    "layer = [{ thickness = 2, young_modulus = 3, poisson_ratio = 0.3 }]\nsubstrate = ";

fn read_on(substrate: &str, side: Option<f64>, text: &str) -> Result<StressCase, String> {
    let foundation = format!("{LAYER}{substrate}");
    let foundation = read_table(&foundation, |table| {
        FoundationCase::read(&table, &Scope::default())
    })?;
    read_table(text, |table| {
        let foundation = Some(&foundation);
        let scope = Scope {
            foundation,
            side,
            ..Scope::default()
        };
        StressCase::read(&table, &scope)
    })
}

const HALF_SPACE: &str = "{ young_modulus = 1, poisson_ratio = 0.3 }";

fn read(text: &str) -> Result<StressCase, String> {
    read_on(HALF_SPACE, None, text)
}

#[test]
fn everything_has_a_default() {
    assert_eq!(read(""), Ok(StressCase::default()));
}

const LAYERS: &str = "layer = [\
    { thickness = 0.1, young_modulus = { from = 1, to = 2, profile = \"linear\" }, poisson_ratio = 0.3, \
      tensile_strength = 5, interface_shear_strength = 6 },\
    { thickness = 0.2, young_modulus = 3, poisson_ratio = 0.3, yield_strength = 4, interface_tensile_strength = 7 }]\n";

fn model(substrate: &str) -> StressModel {
    let foundation = format!("{LAYERS}substrate = {substrate}");
    let case = read_table(&foundation, |table| {
        FoundationCase::read(&table, &Scope::default())
    })
    .unwrap();
    let stress = read("friction = 0.2\ndirection = 1").unwrap();
    stress.model(&case, &case.split().unwrap().foundation)
}

#[test]
fn the_bodies_of_a_model_are_the_layers_of_the_case_and_the_substrate() {
    let of = "{ young_modulus = 1, poisson_ratio = 0.3, yield_strength = 8, tensile_strength = 9 }";
    let model = model(of);
    assert_eq!(
        (model.sliding.friction, model.sliding.direction),
        (0.2, 1.0)
    );
    let bodies = model.bodies.iter().map(|body| {
        let strengths = body.strengths;
        let [top, bottom] = [body.top, body.bottom].map(|depth| (depth * 1e9).round() / 1e9);
        (
            &body.name[..],
            top,
            bottom,
            strengths.yield_strength,
            strengths.tensile_strength,
        )
    });
    let wanted = [
        ("layer[0]", 0.0, 0.1, None, Some(5.0)),
        ("layer[1]", 0.1, 0.3, Some(4.0), None),
        ("substrate", 0.3, f64::INFINITY, Some(8.0), Some(9.0)),
    ];
    assert_eq!(bodies.collect::<Vec<_>>(), wanted);
    assert_eq!(model.bodies[0].bottom, model.bodies[1].top);
    let interfaces = model.interfaces.iter().map(|interface| {
        let strengths = interface.strengths;
        (
            interface.index,
            strengths.shear_strength,
            strengths.tensile_strength,
        )
    });
    assert_eq!(
        interfaces.collect::<Vec<_>>(),
        [(0, Some(6.0), None), (1, None, Some(7.0))]
    );
    assert_eq!(model.interfaces[1].depth, model.bodies[2].top);
}

#[test]
fn a_rigid_base_is_not_a_body_but_has_an_interface() {
    let model = model("\"rigid\"");
    assert_eq!((model.bodies.len(), model.interfaces.len()), (2, 2));
    assert_eq!(model.bodies[1].bottom, model.interfaces[1].depth);
}

#[test]
fn planes_are_as_given_or_down_to_two_radii_with_both_sides_of_interfaces() {
    let foundation = format!("{LAYERS}substrate = {HALF_SPACE}");
    let case = read_table(&foundation, |table| {
        FoundationCase::read(&table, &Scope::default())
    })
    .unwrap();
    let built = case.split().unwrap().foundation;
    let depths = |text: &str, radius| {
        let planes = read(text).unwrap().planes(&case, &built, radius);
        planes.iter().map(|plane| plane.depth.z).collect::<Vec<_>>()
    };
    assert_eq!(depths("depths = [0, 0.1, 5]", 1.0), [0.0, 0.1, 0.1, 5.0]);
    let chosen = depths("", 1.0);
    assert_eq!((chosen[0], chosen[chosen.len() - 1]), (0.0, 2.0));
    let twice = chosen.windows(2).filter(|pair| pair[0] == pair[1]).count();
    assert_eq!(twice, 2);
}

#[test]
fn the_extent_is_as_given_or_one_and_a_half_contacts_within_the_domain() {
    assert_eq!(read("extent = 2").unwrap().side(1.0, 9.0), 2.0);
    assert_eq!(read("").unwrap().side(1.0, 9.0), 3.0);
    assert_eq!(read("").unwrap().side(4.0, 9.0), 9.0);
}

#[test]
fn depths_are_a_list_or_a_range_and_are_sorted() {
    let depths = |text: &str| read(text).unwrap().depths.unwrap();
    assert_eq!(depths("depths = [3, 0, 2, 3]"), [0.0, 2.0, 3.0]);
    let range = "depths = { from = 0, to = \"10 um\", count = 3 }";
    assert_eq!(depths(range), [0.0, 5e-6, 1e-5]);
}

#[test]
fn a_direction_is_an_angle_with_unit_or_in_radians() {
    let direction = |text: &str| read(text).unwrap().direction;
    assert!((direction("direction = \"90 deg\"") - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
    assert_eq!(direction("direction = -1.5"), -1.5);
    assert_eq!(direction("direction = 6"), 6.0);
    assert!(direction("direction = \"720 deg\"") > 12.0);
}

#[test]
fn a_bare_angle_beyond_a_full_turn_is_refused_as_meant_in_degrees() {
    for bare in ["90", "-45.5", "6.3"] {
        let message = read(&format!("direction = {bare}")).unwrap_err();
        let wanted = format!("found {bare}, wanted a unit, as in \"{bare} deg\"");
        assert!(message.contains(&wanted), "{message}");
    }
}

#[test]
fn invalid_stress_tables_are_rejected_with_what_is_wanted() {
    for (text, wanted) in [
        (
            "friction = -0.1",
            "key `friction`: found -0.1, wanted a coefficient of friction",
        ),
        ("friction = 10.5", "from 0 to 10"),
        ("friction = \"0.1\"", "from 0 to 10"),
        ("friction = nan", "from 0 to 10"),
        (
            "depths = [1, \"-1 nm\"]",
            "key `depths[1]`: found \"-1 nm\", wanted a depth of zero or more",
        ),
        (
            "depths = { from = -1, to = 2, count = 3 }",
            "key `depths.from`: found -1, wanted a depth",
        ),
        (
            "depths = { from = 0, to = 2, count = 3, spacing = \"log\" }",
            "key `depths.from`",
        ),
        (
            "depths = { from = 0, to = 2, count = 1001 }",
            "from 2 to 1000",
        ),
        ("depths = []", "wanted a list"),
        ("depths = 3", "wanted a list"),
        ("extent = 0", "wanted a positive length"),
        ("direction = \"5 nm\"", "wanted a finite angle"),
        (
            "frictoin = 1",
            "one of body, depths, extent, friction, direction, only",
        ),
        (
            "only = []",
            "found [], wanted a list of some of \"max_von_mises\", ",
        ),
        ("only = \"max_tension\"", "wanted a list of some of"),
        (
            "only = [\"max_shear\", \"von_mises\"]",
            "key `only[1]`: found \"von_mises\", wanted one of \"max_von_mises\", ",
        ),
    ] {
        let message = read(text).unwrap_err();
        assert!(message.contains(wanted), "{text}: {message}");
    }
}

#[test]
fn the_wanted_stresses_are_in_the_order_of_results_each_once() {
    let stress = read("only = [\"max_tension\", \"max_von_mises\", \"max_tension\"]").unwrap();
    let wanted = vec![StressQuantity::VonMises, StressQuantity::Tension];
    assert!(stress.wants(StressQuantity::Tension) && !stress.wants(StressQuantity::MaxShear));
    assert_eq!(stress.only, Some(wanted));
    assert!(read("").unwrap().wants(StressQuantity::MaxShear));
}

#[test]
fn a_strength_whose_stress_is_left_out_is_refused() {
    let foundation = format!("{LAYERS}substrate = {HALF_SPACE}");
    let case = read_table(&foundation, |table| {
        FoundationCase::read(&table, &Scope::default())
    })
    .unwrap();
    let read = |text: &str| {
        read_table(text, |table| {
            let foundation = Some(&case);
            let scope = Scope {
                foundation,
                ..Scope::default()
            };
            StressCase::read(&table, &scope)
        })
    };
    let all =
        "only = [\"max_principal\", \"max_von_mises\", \"max_shear_traction\", \"max_tension\"]";
    assert!(read(all).is_ok());
    for (quantity, of) in [
        (
            "max_von_mises",
            "the yield_strength of layer[1] limits, or no such strength",
        ),
        ("max_principal", "the tensile_strength of layer[0]"),
        (
            "max_shear_traction",
            "the interface_shear_strength of interface[0]",
        ),
        (
            "max_tension",
            "the interface_tensile_strength of interface[1]",
        ),
    ] {
        let without = all.replace(&format!("\"{quantity}\""), "\"max_shear\"");
        let message = read(&without).unwrap_err();
        let wanted = format!("wanted \"{quantity}\" among them, which {of}");
        assert!(message.contains("key `only`: found "), "{message}");
        assert!(message.contains(&wanted), "{message}");
    }
}

#[test]
fn a_depth_inside_a_rigid_base_is_rejected_and_its_top_accepted() {
    assert!(read_on("\"rigid\"", None, "depths = [0, 2]").is_ok());
    let message = read_on("\"rigid\"", None, "depths = [0, 2.1]").unwrap_err();
    let wanted = "found 2.1, wanted at most 2e0, the depth of the rigid base";
    assert!(message.contains(wanted), "{message}");
}

#[test]
fn an_extent_beyond_a_given_domain_is_rejected() {
    assert!(read_on(HALF_SPACE, Some(4.0), "extent = 4").is_ok());
    let message = read_on(HALF_SPACE, Some(4.0), "extent = 5").unwrap_err();
    let wanted = "found 5, wanted at most the side of the domain, 4e0";
    assert!(message.contains(wanted), "{message}");
}
