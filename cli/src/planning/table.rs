//! `plan.csv`: a row for each design and parameter, best design first.

use super::design::DesignResult;
use super::text;

/// Returns the table.
#[must_use]
pub fn csv(designs: &[DesignResult]) -> String {
    let header = "rank,design,curves,key,unit,value,standard error of ln,low,high,verdict\n";
    let rows = designs.iter().enumerate().flat_map(|(index, design)| {
        text::numbers(design).map(move |of| {
            let [low, high] = of.interval.map(number);
            format!(
                "{},\"{}\",{},{},{},{:e},{},{low},{high},{}\n",
                index + 1,
                text::name(design),
                design.curves.len(),
                of.key,
                of.unit,
                of.value,
                number(of.standard_error),
                of.verdict
            )
        })
    });
    header.to_owned() + &rows.collect::<String>()
}

/// Writes a number, or an empty cell.
fn number(value: Option<f64>) -> String {
    value.map_or_else(String::new, |value| format!("{value:e}"))
}
