//! Peaks and contact between elements followed over many grids, which the paper could not do.

use super::checks::growth;
use super::evidence::{Evidence, Numbers, Subject};
use super::file::Refinement;
use super::finding::{percent, significant};
use crate::XtaskError;

/// A refinement with the numbers of every grid.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Refined {
    refinement: Refinement,
    grids: Vec<(usize, Numbers)>,
}

/// Follows a refinement over its grids.
///
/// # Errors
/// Whatever stands against the evidence.
pub(super) fn refine(
    refinement: &Refinement,
    evidence: &mut dyn Evidence,
) -> Result<Refined, XtaskError> {
    let mut grids = Vec::new();
    for &elements in &refinement.elements {
        let subject = Subject::parse(&refinement.case, &refinement.set, elements)?;
        grids.push((elements, evidence.numbers(subject)?));
    }
    Ok(Refined {
        refinement: refinement.clone(),
        grids,
    })
}

const HEAD: &str = "\
| N | element side / ℓ | D | largest p | grows as | at r | between |
|--:|--:|--:|--:|--:|--:|--:|
";

impl Refined {
    /// A table with a line for every grid, and the exponents fitted on either side of ℓ.
    pub(super) fn markdown(&self) -> String {
        let lines = (0..self.grids.len()).map(|index| self.line(index));
        let title = &self.refinement.title;
        format!(
            "### {title}\n\n{HEAD}{}\n{}\n",
            lines.collect::<String>(),
            self.fits()
        )
    }

    fn line(&self, index: usize) -> String {
        let (elements, numbers) = self.grids[index];
        let [x, y] = numbers.max_pressure_at;
        let growth = match index.checked_sub(1).map(|before| self.peak(before)) {
            Some(before) => format!(
                "N^{}",
                significant(growth::exponent(before, self.peak(index)), 2)
            ),
            None => "–".to_owned(),
        };
        format!(
            "| {elements} | {} | {} | {} | {growth} | {} | {} |\n",
            significant(numbers.element_side / numbers.spring_length, 2),
            significant(numbers.penetration, 5),
            significant(numbers.max_pressure, 4),
            significant(x.hypot(y), 4),
            percent(numbers.contact_area_between / numbers.contact_area),
        )
    }

    /// Fits on the grids coarser and finer than ℓ; a side of fewer than two grids has none.
    fn fits(&self) -> String {
        let fit = |belongs: &dyn Fn(f64) -> bool| {
            let grids = (0..self.grids.len()).filter(|&index| {
                let numbers = self.grids[index].1;
                belongs(numbers.element_side / numbers.spring_length)
            });
            let peaks: Vec<_> = grids.map(|index| self.peak(index)).collect();
            let exponent = growth::fitted_exponent(&peaks);
            exponent.map_or_else(
                || "too few grids".to_owned(),
                |m| format!("N^{}", significant(m, 2)),
            )
        };
        format!(
            "Fitted over the grids with elements larger than ℓ: {}; smaller than ℓ: {}.\n",
            fit(&|relative| relative >= 1.0),
            fit(&|relative| relative < 1.0)
        )
    }

    fn peak(&self, index: usize) -> (usize, f64) {
        let (elements, numbers) = self.grids[index];
        (elements, numbers.max_pressure)
    }
}
