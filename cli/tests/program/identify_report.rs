//! The files of a fit: its pictures and its page, and no files with `--json` alone.

use std::fs;
use std::path::Path;

use serde_json::Value;

use super::runner::{TestFolder, names};

/// The folder of the recorded curves.
const CURVES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../identify/tests/curves");

/// The files of every fit.
const ALWAYS: [&str; 9] = [
    "covariance.csv",
    "fit-curve.png",
    "fit-curve.svg",
    "fit-profiles.png",
    "fit-profiles.svg",
    "fit.csv",
    "fit.json",
    "profiles.csv",
    "report.html",
];

/// Writes a fit file for Hertz's contact, `D = (9Q²/(16 R E*²))^⅓`, with the depths raised to a power and 0.2 nm of
/// noise.
fn hertz(folder: &TestFolder, unknowns: &str, power: f64) {
    let row = |i: i32| {
        let force = 2e-5 * f64::from(i);
        let reduced = 7e10 / (1.0 - 0.09);
        let depth = (9.0 * force * force / (16.0 * 1e-5 * reduced * reduced)).cbrt();
        let noise = 3e-10 * f64::sin(17.0 * f64::from(i * i));
        let depth = depth.powf(power) * 1e-7_f64.powf(1.0 - power) + noise;
        format!("{force:e},{depth:e}")
    };
    let rows: Vec<_> = (1..=40).map(row).collect();
    let text = format!("force,depth\n{}\n", rows.join("\n"));
    fs::write(folder.path("curve.csv"), text).unwrap();
    let fit = format!(
        r#"title = "Hertz & <noise>"
[model]
foundation = {{ substrate = {{ young_modulus = "50 GPa", poisson_ratio = 0.3 }} }}
indenter = {{ kind = "paraboloid", radius = "10 um" }}
[[data]]
file = "curve.csv"
columns = {{ depth = "depth", force = "force" }}
units = {{ depth = "m", force = "N" }}
noise = {{ depth = "0.3 nm", correlation = "none" }}
[unknown]
{unknowns}
"#
    );
    fs::write(folder.path("fit.toml"), fit).unwrap();
}

const MODULUS: &str =
    r#""foundation.substrate.young_modulus" = { from = "5 GPa", to = "500 GPa" }"#;
const RADIUS: &str = r#""indenter.radius" = { from = "1 um", to = "100 um" }"#;

/// Returns the result of a fit and its page, which must name every unknown with its verdict and the reason.
fn page(results: &Path) -> (Value, String) {
    let read = |name: &str| fs::read_to_string(results.join(name)).unwrap();
    let (fit, page) = (read("fit.json"), read("report.html"));
    let fit: Value = serde_json::from_str(&fit).unwrap();
    let page = page.replace("&#39;", "'");
    for unknown in fit["unknowns"].as_array().unwrap() {
        for field in ["key", "verdict", "why"] {
            let text = unknown[field].as_str().unwrap();
            assert!(page.contains(text), "{field}: {text}");
        }
    }
    // Nothing is loaded from another site.
    let addresses = page.replace("http://www.w3.org/2000/svg", "");
    assert!(!addresses.contains("://"), "an address in the page");
    (fit, page)
}

fn assert_is_png(path: &Path) {
    let bytes = fs::read(path).unwrap();
    let decoder = png::Decoder::new(std::io::Cursor::new(bytes));
    let mut reader = decoder.read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    assert!(info.width > 500 && info.height > 300, "{info:?}");
    // There is ink on white.
    assert!(pixels.contains(&255) && pixels.iter().any(|value| *value < 60));
}

#[test]
fn a_fit_of_one_unknown_writes_curve_profile_and_page() {
    let folder = TestFolder::new();
    hertz(&folder, MODULUS, 1.0);
    let output = folder.run(&["identify", "fit.toml", "--out", "results"]);
    assert_eq!(output.code, Some(0), "{}", output.stderr);
    let results = folder.path("results");
    assert_eq!(names(&results), ALWAYS);
    assert_is_png(&results.join("fit-curve.png"));
    assert_is_png(&results.join("fit-profiles.png"));
    let (_, page) = page(&results);
    assert!(
        page.contains("Hertz &amp; &lt;noise&gt;") || page.contains("Hertz &#38; &#60;noise&#62;")
    );
    assert!(page.contains("Fitted: the model fits the measurements."));
    assert_eq!(page.matches("<figure").count(), 2);
}

#[test]
fn an_unidentifiable_unknown_is_shown_with_its_known_combination() {
    let folder = TestFolder::new();
    hertz(&folder, &format!("{MODULUS}\n{RADIUS}"), 1.0);
    let output = folder.run(&["identify", "fit.toml", "--out", "results"]);
    assert_eq!(output.code, Some(0), "{}", output.stderr);
    let (_, page) = page(&folder.path("results"));
    assert!(
        page.contains("Known instead: foundation.substrate.young_modulus * indenter.radius^0.5")
    );
    assert!(page.contains("E (substrate) · R^0.5 over its best value"));
}

#[test]
fn a_misfit_is_marked_at_the_top_of_its_page_and_in_its_pictures() {
    let folder = TestFolder::new();
    hertz(&folder, MODULUS, 1.5);
    let output = folder.run(&["identify", "fit.toml", "--out", "results"]);
    assert_eq!(output.code, Some(3), "{}", output.stderr);
    let (_, page) = page(&folder.path("results"));
    let mark = page.find("role=\"alert\">Misfit").unwrap();
    assert!(mark < page.find("<h2>").unwrap());
    let svg = fs::read_to_string(folder.path("results").join("fit-curve.svg")).unwrap();
    assert!(svg.contains("MISFIT"));
}

#[test]
fn json_alone_writes_no_files_and_force_replaces_all() {
    let folder = TestFolder::new();
    hertz(&folder, MODULUS, 1.0);
    let before = folder.names();
    assert_eq!(
        folder.run(&["identify", "fit.toml", "--json"]).code,
        Some(0)
    );
    assert_eq!(folder.names(), before);
    let again = ["identify", "fit.toml", "--out", "results", "--force"];
    assert_eq!(folder.run(&again).code, Some(0));
    // A picture of an older fit that this fit does not have.
    fs::write(folder.path("results").join("fit-repeats.png"), "old").unwrap();
    fs::write(folder.path("results").join("notes.txt"), "mine").unwrap();
    assert_eq!(folder.run(&again).code, Some(0));
    let found = names(&folder.path("results"));
    assert!(found.contains(&"notes.txt".to_owned()));
    assert!(!found.contains(&"fit-repeats.png".to_owned()), "{found:?}");
}

#[test]
fn repeats_have_a_picture_of_their_scatter() {
    let folder = TestFolder::new();
    let fit = format!(
        r#"title = "Tungsten"
[model]
foundation = {{ substrate = {{ young_modulus = "410 GPa", poisson_ratio = 0.28 }} }}
indenter = {{ kind = "paraboloid", radius = "165 nm", young_modulus = "1141 GPa", poisson_ratio = 0.07 }}
[[data]]
file = "{CURVES}/tungsten_sphere_test0*.csv"
columns = {{ depth = "depth", force = "load", time = 1 }}
units = {{ depth = "nm", force = "mN", time = "s" }}
segment = {{ from = "0.02 mN", to = "0.8 mN" }}
[unknown]
"indenter.radius" = {{ from = "20 nm", to = "2 um" }}
"#
    );
    fs::write(folder.path("fit.toml"), fit).unwrap();
    let output = folder.run(&[
        "identify",
        "fit.toml",
        "--out",
        "results",
        "--accept-misfit",
    ]);
    assert_eq!(output.code, Some(0), "{}", output.stderr);
    let results = folder.path("results");
    assert_is_png(&results.join("fit-repeats.png"));
    let svg = fs::read_to_string(results.join("fit-repeats.svg")).unwrap();
    let (fit, page) = page(&results);
    assert!(page.contains("Standard deviation between repeats"));
    for curve in fit["curves"].as_array().unwrap() {
        let file = curve["file"].as_str().unwrap();
        let name = Path::new(file).file_name().unwrap().to_string_lossy();
        assert!(svg.contains(&*name) && page.contains(file), "{name}");
    }
}

/// The page of the documentation about fits.
const GUIDE: &str = include_str!("../../../docs/identification.md");

#[test]
fn the_documented_fit_gives_the_documented_output() {
    let folder = TestFolder::new();
    let blocks: Vec<_> = GUIDE.split("```").skip(1).step_by(2).collect();
    let of = |language: &str| {
        let found = blocks.iter().find_map(|block| block.strip_prefix(language));
        found.unwrap().trim_start()
    };
    fs::write(folder.path("coating-fit.toml"), of("toml")).unwrap();
    let mut written = String::new();
    for line in of("sh").lines() {
        let words: Vec<_> = line.split_whitespace().skip(1).collect();
        let output = folder.run(&words);
        assert_eq!(output.code, Some(0), "{line}: {}", output.stderr);
        written = output.stderr;
    }
    let values: Vec<_> = written
        .lines()
        .filter(|line| line.contains(" = "))
        .collect();
    assert_eq!(values.len(), 2, "{written}");
    let said: Vec<_> = of("text")
        .lines()
        .filter(|line| line.contains(" = "))
        .collect();
    for (line, said) in values.into_iter().zip(said) {
        // The last digits depend on the search; the intervals are 0.5 and 4 % wide on each side.
        let numbers = |line: &str| -> Vec<f64> {
            let (_, numbers) = line.split_once(" = ").unwrap();
            let words = numbers.split([' ', '[', ']', ',']);
            words.filter_map(|word| word.parse().ok()).collect()
        };
        let verdict = |line: &str| line.split_whitespace().last().map(str::to_owned);
        assert_eq!(verdict(line), verdict(said));
        let (found, said) = (numbers(line), numbers(said));
        assert_eq!([found.len(), said.len()], [3; 2], "{line}");
        for (found, said) in found.iter().zip(&said) {
            assert!((found / said - 1.0).abs() < 2e-3, "{line}");
        }
    }
}
