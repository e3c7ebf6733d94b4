//! `pellicle identify` of unloadings: Oliver and Pharr's numbers, calibrations, and moduli of films.

use std::fmt::Write as _;
use std::fs;

use serde_json::Value;

use super::identify_plan::number;
use super::runner::{ProgramOutput, TestFolder};

/// Made by Oliver and Pharr's relations: 72 GPa, 9.5 GPa, a contact depth of 180 nm, a drift of 0.02 nm/s.
const SILICA: &str = include_str!("../../../identify/tests/curves/synthetic_fused_silica.txt");

const EVALUATION: &str = r#"
[[data]]
file = "silica.txt"
columns = { time = 1, depth = 2, force = 3 }
observe = "unloading"
[evaluation]
area_function = [24.5, "0 nm"]
frame_compliance = "0.3 nm/mN"
drift = "hold"
poisson_ratio = 0.17
"#;

const MODEL: &str = r#"
[model.foundation]
substrate = { young_modulus = "50 GPa", poisson_ratio = 0.17 }
[unknown]
"foundation.substrate.young_modulus" = { from = "5 GPa", to = "500 GPa" }
"#;

/// Means of public tests with a Berkovich tip on 500 nm of thermal oxide on silicon.
const OXIDE: &str = include_str!("../../src/templates/oxide.csv");
const OXIDE_FIT: &str = include_str!("../../src/templates/fit-film.toml");

pub fn run(fit: &str, data: &[(&str, &str)]) -> (TestFolder, ProgramOutput) {
    let folder = TestFolder::new();
    fs::write(folder.path("fit.toml"), fit).unwrap();
    for (name, text) in data {
        fs::write(folder.path(name), text).unwrap();
    }
    let ran = folder.run(&["identify", "fit.toml", "--out", "found", "--json"]);
    (folder, ran)
}

fn value(of: &Value) -> f64 {
    number(&of["value"])
}

#[test]
fn an_unloading_gives_modulus_hardness_and_contact_depth_within_a_percent_with_drift_and_frame_taken_out()
 {
    let (folder, ran) = run(EVALUATION, &[("silica.txt", SILICA)]);
    let found = ran.printed();
    let of = &found["indentation"][0];
    for (name, truth) in [
        ("indentation_modulus", 72e9),
        ("indentation_hardness", 9.5e9),
        ("contact_depth", 180e-9),
        ("max_depth", 260.784_603e-9),
        ("contact_stiffness", 70_011.2),
    ] {
        let (found, sd) = (value(&of[name]), number(&of[name]["sd"]));
        assert!((found / truth - 1.0).abs() < 0.01, "{name}: {found}");
        assert!((found - truth).abs() < 3.0 * sd, "{name}: {found} ± {sd}");
    }
    let drift = value(&of["drift_rate"]);
    assert!((drift - 2e-11).abs() < 3.0 * number(&of["drift_rate"]["sd"]));
    assert_eq!(found["verdict"], "evaluated");
    for file in [
        "indentation.csv",
        "fit.json",
        "report.html",
        "unloading.svg",
        "unloading.png",
    ] {
        assert!(folder.path("found").join(file).is_file(), "{file}");
    }
    let table = fs::read_to_string(folder.path("found/indentation.csv")).unwrap();
    assert!(table.starts_with("file,curve,max_depth [m],max_depth sd [m],max_force [N]"));
}

#[test]
fn a_fit_with_a_model_gives_the_effective_indenter_of_each_unloading() {
    let (_, ran) = run(&format!("{EVALUATION}{MODEL}"), &[("silica.txt", SILICA)]);
    let found = ran.printed();
    let of = &found["indentation"][0];
    let [force, stiffness, exponent, area] =
        ["max_force", "contact_stiffness", "exponent", "area"].map(|name| value(&of[name]));
    let indenter = &of["effective_indenter"];
    let n = 1.0 / (exponent - 1.0);
    // On a half-space; to the accuracy of the fitted modulus.
    for (name, wanted) in [
        ("exponent", n),
        ("penetration", exponent * force / stiffness),
        ("contact_radius", (area / std::f64::consts::PI).sqrt()),
    ] {
        let error = value(&indenter[name]) / wanted - 1.0;
        assert!(error.abs() < 1e-8, "{name}: {error:e}");
    }
    // n = 1/(m − 1): its uncertainty is n² that of m.
    let [sd, of_exponent] = [indenter, of].map(|of| number(&of["exponent"]["sd"]));
    assert!((sd / (n * n * of_exponent) - 1.0).abs() < 1e-4);
    // f(a) = D/(√π Γ(n/2 + 1)/Γ(n/2 + ½)) lies between those of a cone and a flat punch.
    let [a, c] = ["contact_radius", "coefficient"].map(|name| value(&indenter[name]));
    let height = a * (a / c).powf(n - 1.0) / value(&indenter["penetration"]);
    assert!((0.1..0.64).contains(&height), "{height}");
    // Without a model there is none.
    let (_, ran) = run(EVALUATION, &[("silica.txt", SILICA)]);
    assert!(ran.printed()["indentation"][0]["effective_indenter"].is_null());
}

#[test]
fn without_layers_a_fit_gives_the_modulus_of_oliver_and_pharr() {
    let uncertain = r#"{ mean = "0.3 nm/mN", sd = "0.1 nm/mN" }"#;
    let of_frame = EVALUATION.replace("\"0.3 nm/mN\"", uncertain);
    for evaluation in [EVALUATION, &of_frame] {
        let (_, ran) = run(&format!("{evaluation}{MODEL}"), &[("silica.txt", SILICA)]);
        let found = ran.printed();
        let formula = value(&found["indentation"][0]["indentation_modulus"]);
        let alone = value(&found["indentation"][0]["exact"]);
        let fitted = value(&found["unknowns"][0]);
        // Only rounding differs.
        assert!((alone / formula - 1.0).abs() < 1e-12, "{alone} {formula}");
        assert!((fitted / formula - 1.0).abs() < 1e-9, "{fitted} {formula}");
        // Of one curve the interval is that of its evaluation, an uncertain frame included.
        let sd = number(&found["indentation"][0]["indentation_modulus"]["sd"]);
        let interval = [0, 1].map(|end| number(&found["unknowns"][0]["interval"][end]));
        let half = (interval[1] - interval[0]) / 2.0;
        assert!((half / (1.96 * sd) - 1.0).abs() < 0.1, "{half} {sd}");
    }
}

#[test]
fn an_oxide_on_silicon_has_one_modulus_at_all_depths_where_the_formula_rises_by_half() {
    let (_, ran) = run(OXIDE_FIT, &[("oxide.csv", OXIDE)]);
    let found = ran.printed();
    let fitted = &found["unknowns"][0];
    let [low, high] = [0, 1].map(|end| number(&fitted["interval"][end]));
    assert!(low > 68.5e9 && high < 71e9, "{low} {high}");
    let contacts = found["indentation"].as_array().unwrap();
    let moduli = |key: &str| {
        contacts
            .iter()
            .map(|of| value(&of[key]))
            .collect::<Vec<_>>()
    };
    let formula = moduli("indentation_modulus");
    assert!(formula[0] < 76e9 && formula[5] > 118e9, "{formula:?}");
    let exact = moduli("exact");
    // Down to a contact depth of 30 % of the film.
    for modulus in &exact[..5] {
        assert!((68.5e9..71e9).contains(modulus), "{exact:?}");
    }
    assert!((68.5e9..72.5e9).contains(&exact[5]), "{exact:?}");
    let warnings = found["warnings"].to_string();
    assert!(warnings.contains("thinning"), "{warnings}");
}

#[test]
fn a_film_of_another_unit_is_refused_or_its_trend_is_told() {
    let (_, ran) = run(
        &OXIDE_FIT.replace("500 nm", "50 nm"),
        &[("oxide.csv", OXIDE)],
    );
    assert_eq!(ran.code, Some(2), "{}", ran.stderr);
    let said = ran.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(said.contains("foundation.layer[0].thickness"), "{said}");
    assert!(
        said.contains("a top layer of 50.000 nm and 4 deeper contacts"),
        "{said}"
    );
    // As thick as nothing knows of its base, it has the moduli of the formula.
    let (_, ran) = run(
        &OXIDE_FIT.replace("500 nm", "500 um"),
        &[("oxide.csv", OXIDE)],
    );
    assert!(
        ran.printed()["warnings"].to_string().contains("\"trend\""),
        "{}",
        ran.stderr
    );
    let (_, ran) = run(OXIDE_FIT, &[("oxide.csv", OXIDE)]);
    assert!(
        !ran.printed()["warnings"].to_string().contains("\"trend\""),
        "{}",
        ran.stderr
    );
}

#[test]
fn a_calibration_on_a_known_body_gives_another_evaluation_its_area_function_and_frame() {
    // Readings of a continuous stiffness: A = 24.5 h² + 300 nm h, C_f = 0.3 nm/mN, E_r of silica under diamond.
    let reduced = 1.0 / ((1.0 - 0.17_f64.powi(2)) / 72e9 + (1.0 - 0.07_f64.powi(2)) / 1141e9);
    let mut rows = String::from("depth [m],force [N],stiffness [N/m]\n");
    for i in 0..40_u32 {
        let contact = 30e-9 * 1.07_f64.powf(f64::from(i));
        let area = 24.5 * contact * contact + 300e-9 * contact;
        let stiffness = 2.0 / std::f64::consts::PI.sqrt() * reduced * area.sqrt();
        // A noise of 0.3 %.
        let stiffness = stiffness * (1.0 + 0.003 * (f64::from(i * i) * 17.0 + 0.4).sin());
        let force = 9.5e9 * area;
        let depth = contact + 0.75 * force / stiffness + 0.3e-6 * force;
        let measured = 1.0 / (1.0 / stiffness + 0.3e-6);
        writeln!(rows, "{depth:e},{force:e},{measured:e}").unwrap();
    }
    let calibration = r#"
[[data]]
file = "rows.csv"
columns = { depth = 1, force = 2, stiffness = 3 }
observe = "unloading"
[evaluation]
poisson_ratio = 0.17
calibrate = { young_modulus = "72 GPa", coefficients = 2 }
"#;
    let (folder, ran) = run(calibration, &[("rows.csv", &rows)]);
    let found = ran.printed();
    for of in found["indentation"].as_array().unwrap() {
        let modulus = value(&of["indentation_modulus"]);
        assert!((modulus / 72e9 - 1.0).abs() < 0.02, "{modulus}");
    }
    // Another evaluation reads the file: the same contacts without a frame give the same areas.
    fs::copy(
        folder.path("found/calibration.toml"),
        folder.path("tip.toml"),
    )
    .unwrap();
    let evaluation = calibration.replace(
        r#"calibrate = { young_modulus = "72 GPa", coefficients = 2 }"#,
        r#"area_function = "tip.toml""#,
    );
    fs::write(folder.path("other.toml"), evaluation).unwrap();
    let ran = folder.run(&["identify", "other.toml", "--json"]);
    let other = ran.printed();
    let of = &other["indentation"][20];
    let contact = 30e-9 * 1.07_f64.powi(20);
    let truth = 24.5 * contact * contact + 300e-9 * contact;
    let (area, sd) = (value(&of["area"]), number(&of["area"]["sd"]));
    assert!(
        (area / truth - 1.0).abs() < 0.01 && sd > 0.0,
        "{area} ± {sd}"
    );
    assert_eq!(
        other["indentation"][20]["area"],
        found["indentation"][20]["area"]
    );
    let text = fs::read_to_string(folder.path("tip.toml")).unwrap();
    let frame = text.split("mean = \"").nth(1).unwrap();
    let frame: f64 = frame.split(' ').next().unwrap().parse().unwrap();
    assert!((frame / 0.3e-6 - 1.0).abs() < 0.05, "{frame}");
}

#[test]
fn a_soft_film_that_piles_up_is_a_misfit_with_its_reason() {
    // Gold, titanium and oxide of 500 nm each on silicon: public readings of a Berkovich tip.
    let rows = "depth [nm],load [mN],stiffness [kN/m]\n51.4,0.169,36.2\n102.9,0.675,72.2\n199.7,2.668,150.6\n\
                247.0,4.139,190.7\n321.9,7.213,251.1\n";
    let fit = r#"
[model.foundation]
substrate = { young_modulus = "170 GPa", poisson_ratio = 0.22 }
layer = [
  { thickness = "500 nm", young_modulus = "78 GPa", poisson_ratio = 0.42 },
  { thickness = "500 nm", young_modulus = "116 GPa", poisson_ratio = 0.32 },
  { thickness = "500 nm", young_modulus = "72 GPa", poisson_ratio = 0.17 },
]
[[data]]
file = "gold.csv"
columns = { depth = 1, force = 2, stiffness = 3 }
observe = "unloading"
noise = { relative = 0.04 }
[evaluation]
tip = "berkovich"
tip_radius = "50 nm"
poisson_ratio = 0.42
[unknown]
"foundation.layer[0].young_modulus" = { from = "10 GPa", to = "400 GPa" }
"#;
    let (_, ran) = run(fit, &[("gold.csv", rows)]);
    let found = ran.printed();
    assert_eq!(found["verdict"], "misfit");
    let warnings = found["warnings"].to_string();
    assert!(
        warnings.contains("pile-up") && warnings.contains("true area"),
        "{warnings}"
    );
}

#[test]
fn what_cannot_be_evaluated_is_told_in_one_sentence() {
    let without_hold: String = SILICA
        .lines()
        .filter(|line| {
            let time = line.split('\t').next().unwrap_or_default();
            time.parse::<f64>().map_or(true, |time| time < 29.9)
        })
        .fold(String::new(), |text, line| text + line + "\n");
    let off = EVALUATION.replace("\"hold\"", "\"off\"");
    let cases: [(String, &str, &str); 11] = [
        (
            EVALUATION.into(),
            &without_hold,
            "found no hold at a constant force",
        ),
        (
            off.replace("\"0 nm\"", "\"-9 um\""),
            SILICA,
            "wanted a positive one: the area function",
        ),
        (
            off.replace("\"0 nm\"", "120"),
            SILICA,
            "found 120, wanted its unit, nm",
        ),
        (
            off.replace("\"0 nm\"", "\"120 GPa\""),
            SILICA,
            "wanted a number with a unit such as \"nm\"",
        ),
        (
            off.replace("\"off\"", "\"0.02 nm\""),
            SILICA,
            "or a rate such as \"0.02 nm/s\"",
        ),
        (
            off.replace("time = 1, ", "").replace("\"off\"", "\"hold\""),
            SILICA,
            "found no column of the time",
        ),
        (
            format!("{off}unloading = [0.4, 0.95]"),
            SILICA,
            "the upper and the lower end",
        ),
        (
            off.replace("poisson_ratio = 0.17", "poisson_ratio = 0.7"),
            SILICA,
            "wanted a number in [0, 0.5]",
        ),
        (
            format!("{off}thinning = 0.5"),
            SILICA,
            "wanted none without a [model]",
        ),
        (
            format!("{off}beta = 1000"),
            SILICA,
            "wanted a factor from 0.5 to 2, such as 1",
        ),
        (
            format!("{off}epsilon = {{ mean = 2, sd = 0.1 }}"),
            SILICA,
            "wanted a factor from 0.5 to 1.2, such as 0.75",
        ),
    ];
    for (fit, data, wanted) in cases {
        let (_, ran) = run(&fit, &[("silica.txt", data)]);
        assert_ne!(ran.code, Some(0), "{wanted}");
        // The diagnosis may be broken into lines.
        let said = ran.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(said.contains(wanted), "{wanted}: {}", ran.stderr);
    }
}

#[test]
fn threads_may_be_chosen_for_evaluations_too() {
    let (folder, ran) = run(EVALUATION, &[("silica.txt", SILICA)]);
    for arguments in [
        &["identify", "fit.toml", "--json", "--threads", "2"][..],
        &["identify", "fit.toml", "--each", "--json", "--threads", "1"],
    ] {
        let again = folder.run(arguments);
        assert_eq!(again.stdout, ran.stdout, "{}", again.stderr);
    }
}
