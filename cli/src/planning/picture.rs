//! The picture of a plan: the expected interval of each unknown against the largest force.

use pellicle_plot::fit::designs::{DesignedUnknown, Designs};
use pellicle_plot::fit::heading::FitHeading;

use super::candidate::{CandidateCurve, radius_words};
use super::design::{DesignResult, ExpectedResult};
use super::text::percent;
use crate::identification::{names, units};

/// Prepares the picture of the designs; `conditions` are the noise and the number of points.
#[must_use]
pub fn designs(title: &str, level: f64, conditions: &str, all: &[DesignResult]) -> Designs {
    let mut singles: Vec<(&CandidateCurve, &DesignResult)> = all
        .iter()
        .filter_map(|design| match &design.curves[..] {
            [one] => Some((one, design)),
            _ => None,
        })
        .collect();
    singles.sort_by(|(one, _), (other, _)| one.forces[1].total_cmp(&other.forces[1]));
    let radii = distinct(singles.iter().map(|(curve, _)| curve.radius));
    let [least, most] = match (singles.first(), singles.last()) {
        (Some((first, _)), Some((last, _))) => [first.forces[1], last.forces[1]],
        _ => [1.0, 1.0],
    };
    let together = all.iter().max_by_key(|design| design.curves.len());
    let together = together.filter(|design| design.curves.len() > 1);
    let count = all.first().map_or(0, |design| design.unknowns.len());
    let unknown = |index: usize| {
        let of = |design: &DesignResult| half_width(&design.unknowns[index]);
        let line = |radius: &Option<f64>| {
            let of_radius = singles.iter().filter(|(curve, _)| curve.radius == *radius);
            of_radius
                .map(|(curve, design)| (curve.forces[1], of(design)))
                .collect()
        };
        DesignedUnknown {
            name: names::of_key(&all[0].unknowns[index].key),
            lines: radii.iter().map(line).collect(),
            together: together.and_then(of),
        }
    };
    Designs {
        head: FitHeading {
            title: format!("{title}: what to measure"),
            numbers: format!("expected {} intervals of one curve alone", percent(level)),
        },
        note: conditions.to_owned(),
        // Over many decades, the unit is chosen for short numbers in the middle of the axis.
        forces: units::scale((least * most).sqrt(), "N"),
        indenters: radii
            .iter()
            .map(|radius| radius.map_or("one curve".into(), radius_words))
            .collect(),
        unknowns: (0..count).map(unknown).collect(),
    }
}

/// Half the interval in percent of the value; `None` if it is lost.
fn half_width(of: &ExpectedResult) -> Option<f64> {
    let factor = of.factor.filter(|_| !of.is_lost())?;
    Some(100.0 * (factor - 1.0))
}

fn distinct(all: impl Iterator<Item = Option<f64>>) -> Vec<Option<f64>> {
    let mut found: Vec<Option<f64>> = Vec::new();
    for radius in all {
        if !found.contains(&radius) {
            found.push(radius);
        }
    }
    found.sort_by(|one, other| one.partial_cmp(other).unwrap_or(std::cmp::Ordering::Equal));
    found
}
