//! Cases with measured maps: tilt, edges, register, outline.

mod as_they_come;
mod edges;
mod flat;
mod malformed;
mod malformed_texts;
mod outline;
mod register;
mod surfaces;
mod tilt;

use std::path::Path;
use std::sync::Arc;

use ndarray::Array2;
use pellicle::Case;
use pellicle::case::map_sources::MapSources;
use pellicle::input::span::Source;
use pellicle::summary::{RunSummary, StepSummary};

/// Maps by their names, each square.
type Maps<'a> = &'a [(&'a str, &'a Array2<f64>)];

fn case(text: &str, maps: Maps<'_>) -> Result<Case, String> {
    let mut sources = MapSources::in_folder(Path::new(""));
    for (name, map) in maps {
        let (rows, columns) = map.dim();
        sources = sources.with_array(name, [rows, columns], map.iter().copied().collect());
    }
    let source = Arc::new(Source::new("case.toml", text.to_owned()));
    Case::parse_with(&source, "case", &sources).map_err(|diagnosis| diagnosis.to_string())
}

fn solved(text: &str, maps: Maps<'_>) -> RunSummary {
    let case = case(text, maps).expect("a valid case");
    case.solve(&mut ()).expect("a solution").summary
}

/// The only step of a case, and the codes of its warnings.
fn step(text: &str, maps: Maps<'_>) -> (StepSummary, Vec<String>) {
    let summary = solved(text, maps);
    let codes = summary.warnings.iter().map(|warning| warning.code.clone());
    (summary.steps[0].clone(), codes.collect())
}
