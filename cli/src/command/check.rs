//! `pellicle check`: the case as resolved, and estimates of the work of solving it.

use std::borrow::Cow;

use pellicle::case::Case;
use pellicle::case::foundation::FoundationCase;
use pellicle::case::foundation::layer::LayerCase;
use pellicle::case::grid::GridCase;
use pellicle::case::map::MapCase;
use pellicle::case::surface::SurfaceCase;
use pellicle::case::with_units::with_units;
use pellicle::display::{self, Unit, quantity, significant};
use pellicle::forecast::Forecast;
use pellicle::input::units::Units;
use pellicle_contact::Step;
use pellicle_texture::SlopeSpectrum;

use crate::arguments::CaseArguments;
use crate::command::Outcome;
use crate::failure::Failure;
use crate::output::disk_space;
use crate::progress::in_words;
use crate::{cache, terminal};

/// Prints the case with every default filled in, then the estimates and the warnings to expect.
///
/// # Errors
///
/// [`Failure`] if the case is wrong.
pub fn check(arguments: &CaseArguments) -> Result<Outcome, Failure> {
    let mut case = Case::read(&arguments.path, &arguments.sets)?;
    let cache = cache::open();
    let chosen = case.grid.longer_side().is_none();
    let forecast = Forecast::new(&case, &case.model(&cache)?.value);
    case.check_extent(forecast.side)?;
    case.grid.take_side(forecast.side);
    let resolved = serde_json::to_value(&case)?;
    let resolved = match case.units {
        Units::Si => with_units(resolved),
        Units::Consistent => resolved,
    };
    let resolved = toml::to_string(&resolved)?;
    let estimates = estimates(&case, &forecast, chosen)?;
    terminal::print(&format!("{}\n{resolved}\n{estimates}", heading(case.units)))?;
    for warning in &forecast.warnings {
        terminal::report(&format!("warning: {warning}"));
    }
    cache::report_warnings(&cache);
    Ok(Outcome::Done)
}

fn heading(units: Units) -> &'static str {
    match units {
        Units::Si => "# The case as resolved.",
        Units::Consistent => "# The case as resolved, in its own units.",
    }
}

/// Formats resolution, work and memory as comments, so that the output is again a case file.
fn estimates(case: &Case, forecast: &Forecast, chosen: bool) -> Result<String, Failure> {
    let element_side = forecast.side / case.grid.elements as f64;
    let metres = |value| quantity(value, Unit::Metre, case.units);
    let how = if chosen {
        "chosen from the load"
    } else {
        "as given"
    };
    let mut lines = Estimates::default();
    lines.add(
        "side of the domain",
        &format!("{} ({how})", metres(forecast.side)),
    );
    lines.add("element side", &metres(element_side));
    for (name, length) in features(case) {
        let count = significant(length / element_side, 3);
        lines.add(&format!("elements per {name}"), &count);
    }
    lines.graded(case)?;
    lines.maps(case, element_side);
    lines.add("loading steps", &case.steps().to_string());
    lines.add("memory, about", &display::memory(forecast.need.bytes));
    let [planes, size] = lines.stresses(case, forecast)?;
    let disk = disk_space::bytes(case) + disk_space::of_stresses(case, planes, size);
    lines.add("disk, about", &megabytes(disk));
    if let Some([least, most]) = forecast.products(case.grid.elements) {
        let [least, most] = [least, most].map(|products| format!("{products:.0}"));
        let range = if least == most {
            least
        } else {
            format!("{least} to {most}")
        };
        lines.add("products with K per step, about", &range);
    }
    if let Some(step) = &forecast.step {
        let trial = GridCase {
            elements: forecast.trial,
            ..case.grid
        };
        let elements = trial.lengths().unwrap_or([forecast.trial; 2]);
        lines.trial(step, elements, element_side, case.units);
    }
    Ok(lines.lines.concat())
}

fn megabytes(bytes: f64) -> String {
    format!("{} MB", significant(bytes / 1e6, 2))
}

/// Comment lines of names and values, in columns.
#[derive(Default)]
struct Estimates {
    lines: Vec<String>,
}

impl Estimates {
    fn add(&mut self, name: &str, value: &str) {
        self.lines.push(format!("# {name:<38}{value}\n"));
    }

    /// Adds the number of homogeneous layers into which each graded layer is split.
    fn graded(&mut self, case: &Case) -> Result<(), Failure> {
        let other = case.indenter.foundation();
        let bodies = [
            (Some(Cow::Borrowed(&case.foundation)), ""),
            (other, " of the indenter"),
        ];
        for (body, of) in bodies {
            let splits = body.map(|body| body.split()).transpose()?;
            for split in splits.into_iter().flat_map(|split| split.splits) {
                let (sublayers, error) = (split.sublayers, significant(split.error, 2));
                let name = format!("layer {}{of}, graded, is split into", split.layer);
                self.add(
                    &name,
                    &format!("{sublayers}, relative error of C(k) {error}"),
                );
            }
        }
        Ok(())
    }

    /// Adds the stress planes of the largest load and their work; returns their number and the points along a side.
    fn stresses(&mut self, case: &Case, forecast: &Forecast) -> Result<[usize; 2], Failure> {
        let Some(stress) = &case.stress else {
            return Ok([0; 2]);
        };
        let trial = forecast
            .step
            .as_ref()
            .map(|step| step.summary.contact_radius);
        let radius = trial.filter(|radius| *radius > 0.0);
        let radius = radius.unwrap_or(forecast.side / 3.0);
        let body = case.stressed();
        let planes = stress.planes(&body, &body.split()?.foundation, radius);
        let extent = stress.side(radius, forecast.side);
        let size = case.grid.elements as f64 * extent / forecast.side;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "at most the elements of the grid"
        )]
        let size = size.round().max(1.0) as usize;
        let count = planes.len();
        self.add(
            "stresses per step, about",
            &format!("{count} planes of {size} × {size} points"),
        );
        let deepest = planes.last().map_or(0.0, |plane| plane.depth.z);
        self.add("  down to", &quantity(deepest, Unit::Metre, case.units));
        let strengths = body.criteria().len();
        if strengths > 0 {
            let words = format!("{strengths}, each by solving some ten more loads");
            self.add("critical loads", &words);
        }
        if let Some(cost) = forecast.stress {
            self.add("CPU time of stresses, about", &in_words(cost.extremes));
            if let Some(critical) = cost.critical {
                self.add("CPU time of critical loads, about", &in_words(critical));
            }
        }
        Ok([count, size])
    }

    /// Adds the sampling of the maps: samples per element and per shortest wave.
    fn maps(&mut self, case: &Case, element_side: f64) {
        let maps = [
            ("surface", case.surface.map()),
            ("indenter", case.indenter.map()),
        ];
        for (table, map) in maps
            .into_iter()
            .filter_map(|(table, map)| Some((table, map?)))
        {
            let per_element = significant(element_side / sample(map), 3);
            self.add(&format!("samples per element ({table})"), &per_element);
            let wave = SlopeSpectrum::of(map.own()).shortest_wave();
            let wave = wave.map(|wave| significant(wave / sample(map), 2));
            let wave = wave.unwrap_or_else(|| "none found".into());
            self.add(&format!("samples per shortest wave ({table})"), &wave);
        }
    }

    /// Adds the contact of the largest load on the coarse grid.
    fn trial(&mut self, step: &Step, [x, y]: [usize; 2], element_side: f64, units: Units) {
        let (solution, summary) = (&step.solution, &step.summary);
        let of = |value, unit| quantity(value, unit, units);
        let radius = summary.contact_radius;
        self.add(
            "elements per contact radius, about",
            &significant(radius / element_side, 2),
        );
        self.lines.push(format!(
            "# a trial of the largest load on {x} × {y} elements: Q = {}, D = {}, largest pressure {}\n",
            of(solution.force, Unit::Newton),
            of(solution.penetration, Unit::Metre),
            of(summary.max_pressure, Unit::Pascal),
        ));
        if let Some(depth) = summary.plastic_depth.filter(|depth| *depth > 0.0) {
            let depth = of(depth, Unit::Metre);
            self.add("plastic depth, about", &depth);
        }
    }
}

/// The lengths that a grid should resolve.
fn features(case: &Case) -> Vec<(String, f64)> {
    let of_body = |body: &FoundationCase, of: &str| {
        let layers = body.layer.iter().enumerate();
        let thickness = |(i, layer): (usize, &LayerCase)| {
            (format!("thickness of layer {i}{of}"), layer.thickness)
        };
        layers.map(thickness).collect::<Vec<_>>()
    };
    let other = case.indenter.foundation();
    let other = other.map_or_else(Vec::new, |body| of_body(&body, " of the indenter"));
    let thickness = of_body(&case.foundation, "").into_iter().chain(other);
    let relief = match &case.surface {
        SurfaceCase::Cylinders(cylinders) => vec![
            ("radius of a cylinder".to_owned(), cylinders.radius),
            ("period of the cylinders".to_owned(), cylinders.period()),
        ],
        SurfaceCase::Dimples(dimples) => vec![
            ("radius of a dimple".to_owned(), dimples.radius),
            ("period of the dimples".to_owned(), dimples.period()),
        ],
        SurfaceCase::Grooves(grooves) => vec![
            ("width of a groove".to_owned(), grooves.width),
            ("period of the grooves".to_owned(), grooves.period()),
        ],
        SurfaceCase::Map(_)
        | SurfaceCase::Function(_)
        | SurfaceCase::Rough(_)
        | SurfaceCase::Bare
        | SurfaceCase::Film { .. } => Vec::new(),
    };
    thickness.chain(relief).collect()
}

/// The shorter side of a pixel, m.
fn sample(map: &MapCase) -> f64 {
    let [x, y] = map.shape().map(|samples| samples as f64);
    (map.sides[0] / x).min(map.sides[1] / y)
}
