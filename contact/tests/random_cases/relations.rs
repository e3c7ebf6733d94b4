//! Relations that hold exactly: other units, mirrors, a quarter turn, a layer in two parts, and the bodies swapped.

use pellicle_contact::{Domain, SolverOptions, Status};
use rayon::prelude::*;

use super::case::Case;
use super::view::View;
use super::{FINE, OTHER, SI, extent};

/// Penetration, force, contact area and largest pressure, in the units of the view; none if the case is not certified.
fn numbers(seed: u64, most: usize, view: View, side: Option<f64>) -> Option<([f64; 4], f64)> {
    let mut case = Case::draw_made(seed, most, view);
    let [length, modulus] = [view.units.length, view.units.modulus];
    if let Some(side) = side {
        case.domain = Domain::Side(side * length);
    }
    let options = SolverOptions {
        tolerance: FINE,
        contact_stiffness: false,
        ..SolverOptions::default()
    };
    let path = case.solve(&options).ok()?;
    let step = &path.steps[0];
    let is_certified = matches!(step.status(), Status::Certified | Status::BeyondModel);
    let numbers = [
        step.solution.penetration / length,
        step.solution.force / (modulus * length * length),
        step.summary.contact_area / (length * length),
        step.summary.max_pressure / modulus,
    ];
    is_certified.then_some((numbers, path.grid.side() / length))
}

#[test]
fn views_of_a_random_case_have_the_same_numbers() {
    let (count, most) = extent();
    let plain = View::plain(SI);
    let views = [
        ("units", View::plain(OTHER)),
        (
            "mirror",
            View {
                is_mirrored: true,
                ..plain
            },
        ),
        (
            "quarter turn",
            View {
                quarter_turns: 1,
                ..plain
            },
        ),
        (
            "both",
            View {
                is_mirrored: true,
                quarter_turns: 2,
                ..plain
            },
        ),
        (
            "split layer",
            View {
                is_split: true,
                ..plain
            },
        ),
        (
            "swapped bodies",
            View {
                is_swapped: true,
                ..plain
            },
        ),
    ];
    let compared: Vec<(u64, &str, f64)> = (0..count)
        .into_par_iter()
        .filter_map(|seed| Some((seed, numbers(seed, most, plain, None)?)))
        .flat_map_iter(|(seed, (wanted, side))| {
            let found = views.iter().filter_map(move |(name, view)| {
                let (found, _) = numbers(seed, most, *view, Some(side))?;
                let parts = found.iter().zip(wanted);
                let parts = parts.map(|(found, wanted)| (found / wanted - 1.0).abs());
                Some((seed, *name, parts.fold(0.0, f64::max)))
            });
            found.collect::<Vec<_>>()
        })
        .collect();
    for (name, _) in views {
        let of_view = compared.iter().filter(|(_, of, _)| *of == name);
        let mut differences: Vec<(f64, u64)> = of_view.map(|(seed, _, by)| (*by, *seed)).collect();
        differences.sort_unstable_by(|one, other| one.0.total_cmp(&other.0));
        let beyond = differences.iter().filter(|(by, _)| *by > SAME).count();
        eprintln!(
            "{name}: {} of {count} compared, {beyond} beyond {SAME:e}; at most {:?}",
            differences.len(),
            &differences[differences.len().saturating_sub(4)..],
        );
        assert!(2 * differences.len() as u64 > count, "{name}");
        assert!(differences.iter().all(|(by, _)| *by <= SAME), "{name}");
    }
}

/// Relative difference of two views of the same case.
const SAME: f64 = 1e-8;
