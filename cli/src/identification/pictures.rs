//! The pictures of a fit, each as SVG and as PNG, and the drawings in its report.

use std::path::Path;

use pellicle::display::{count, significant};
use pellicle_identify::indentation::{IndentationNumber, Uncertain};
use pellicle_identify::{Estimate, Fit, FitVerdict, Reading, Role};
use pellicle_plot::fit::axes;
use pellicle_plot::fit::curve::{AxisQuantity, CurveUse, Curves, FittedCurve, FittedPoint};
use pellicle_plot::fit::heading::FitHeading;
use pellicle_plot::fit::moduli::{Moduli, ModulusAtDepth};
use pellicle_plot::fit::profiles::Profiles;
use pellicle_plot::fit::repeats::{Repeated, RepeatsPlot};
use pellicle_plot::fit::unknown::{Combination, FittedUnknown};
use pellicle_plot::sheet::style::Style;
use rayon::prelude::*;

use super::result::FitResult;
use super::{Identification, names, units};
use crate::evaluation::result::Indentation;
use crate::failure::Failure;
use crate::output::write_progress::WriteProgress;

/// A picture of a fit.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FitPicture {
    /// Points, model and residuals.
    Curve,
    /// The profile of each unknown.
    Profiles,
    /// The values of each repeat.
    Repeats,
    /// The modulus from each unloading alone.
    Moduli,
}

impl FitPicture {
    /// All pictures, in the order of the report.
    pub const ALL: [Self; 4] = [Self::Moduli, Self::Curve, Self::Profiles, Self::Repeats];

    /// Its name, without extension.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Curve => "fit-curve",
            Self::Profiles => "fit-profiles",
            Self::Repeats => "fit-repeats",
            Self::Moduli => "fit-moduli",
        }
    }
}

/// The drawn pictures, as SVG.
pub type FitDrawings = Vec<(FitPicture, String)>;

/// Draws and writes the pictures of the fit.
///
/// # Errors
///
/// [`Failure::File`] if a picture cannot be written.
pub fn write(
    folder: &Path,
    of: &Identification,
    fit: &Fit,
    found: &FitResult,
    style: &Style,
    writer: &WriteProgress<'_>,
) -> Result<FitDrawings, Failure> {
    let subject = FitSubject { of, fit, found };
    let one = |picture: &FitPicture| {
        let name = picture.name();
        let svg = writer.drawn(name, || Ok(subject.draw(*picture, style)));
        let Some(svg) = svg.flatten() else {
            return Ok(None);
        };
        let written = writer.picture(folder, name, || svg)?;
        Ok(written.map(|svg| (*picture, svg)))
    };
    let drawn = FitPicture::ALL.par_iter().map(one);
    let drawn = drawn.collect::<Result<Vec<_>, Failure>>()?;
    Ok(drawn.into_iter().flatten().collect())
}

/// The subject of the pictures: a problem, its fit and the result.
struct FitSubject<'a> {
    of: &'a Identification,
    fit: &'a Fit,
    found: &'a FitResult,
}

/// The name of an axis, with its symbol, and its SI unit.
fn axis(reading: Reading) -> (&'static str, &'static str) {
    let name = match reading {
        Reading::Force => "force Q",
        Reading::Depth => "depth D",
        Reading::ContactRadius => "contact radius a",
        Reading::Stiffness => "contact stiffness S",
    };
    (name, reading.unit())
}

impl FitSubject<'_> {
    fn draw(&self, picture: FitPicture, style: &Style) -> Option<String> {
        match picture {
            FitPicture::Curve => self.curves().draw(style),
            FitPicture::Profiles => self.profiles().draw(style),
            FitPicture::Repeats => self.repeats().draw(style),
            FitPicture::Moduli => self.moduli().draw(style),
        }
    }

    fn head(&self) -> FitHeading {
        let verdict = match self.fit.verdict {
            FitVerdict::Fitted => "fitted",
            FitVerdict::Misfit => "MISFIT: the model does not fit the measurements",
            FitVerdict::OutsideModel => "OUTSIDE THE MODEL",
            FitVerdict::NotConverged => "NOT CONVERGED",
        };
        let left_out = match self.fit.excluded.len() {
            0 => String::new(),
            number => format!(", {number} of them left out"),
        };
        FitHeading {
            title: self.found.title.clone(),
            numbers: format!(
                "{}{left_out}, {}, χ²/ν = {}, {verdict}",
                count(self.of.sources.len(), "curve"),
                count(self.fit.goodness.points, "point"),
                significant(self.fit.goodness.chi_squared_per_degree, 3),
            ),
        }
    }

    /// The names of the files, without folders.
    fn names(&self) -> Vec<String> {
        let name = |path: &Path| {
            path.file_name()
                .unwrap_or_default()
                .to_string_lossy()
                .into_owned()
        };
        let sources = self.of.sources.iter();
        sources.map(|source| name(&source.measured.file)).collect()
    }

    fn curves(&self) -> Curves {
        let points = &self.fit.points;
        let left_out: Vec<usize> = self.fit.excluded.iter().map(|one| one.curve).collect();
        let mut first = 0;
        let sources = self.of.sources.iter().zip(self.names()).enumerate();
        let curve = sources.map(|(index, (source, name))| {
            let span = first..first + source.abscissa.len();
            first = span.end;
            let point = |(i, at): (usize, usize)| FittedPoint {
                abscissa: source.abscissa[i],
                observed: source.observed[i],
                model: points.model[at],
                whitened: points.whitened[at],
            };
            let usage = if left_out.contains(&index) {
                CurveUse::LeftOut
            } else {
                CurveUse::Used
            };
            FittedCurve {
                name,
                points: span.enumerate().map(point).collect(),
                usage,
            }
        });
        let curves: Vec<_> = curve.collect();
        let [x, y] = self.quantities(&curves);
        Curves {
            head: self.head(),
            x,
            y,
            all: curves,
        }
    }

    /// Abscissa and ordinate of the curves, each with a unit that suits its largest value.
    fn quantities(&self, curves: &[FittedCurve]) -> [AxisQuantity; 2] {
        let observable = self.of.model.curves().first().map(|curve| curve.observable);
        let observable = observable.unwrap_or_default();
        let [mut x, y] = [observable.abscissa(), observable.observed()].map(axis);
        if self.of.is_at_approach() {
            x = ("approach z", "m");
        }
        let points = || curves.iter().flat_map(|curve| &curve.points);
        let quantity = |(name, unit), largest: f64| AxisQuantity {
            name,
            scale: units::scale(largest, unit),
        };
        let largest = |ends: Option<[f64; 2]>| ends.map_or(1.0, |[low, high]| high.max(-low));
        [
            quantity(x, largest(axes::ends(points().map(|point| point.abscissa)))),
            quantity(y, largest(axes::ends(points().map(|point| point.observed)))),
        ]
    }

    fn profiles(&self) -> Profiles {
        let sought = self.sought();
        Profiles {
            head: self.head(),
            level: self.of.file.report.level,
            unknowns: sought.map(|(index, of)| self.unknown(index, of)).collect(),
        }
    }

    fn repeats(&self) -> RepeatsPlot {
        let repeated = |(index, estimate): (usize, &Estimate)| {
            let between = estimate.between_curves.as_ref()?;
            Some(Repeated {
                unknown: self.unknown(index, estimate),
                scatter: between.standard_deviation,
                values: between.values.clone(),
            })
        };
        RepeatsPlot {
            head: self.head(),
            names: self.names(),
            unknowns: self.sought().filter_map(repeated).collect(),
        }
    }

    /// The moduli of the contacts of unloadings; without points in other fits.
    fn moduli(&self) -> Moduli {
        let contacts = &self.found.indentation;
        let depth = |of: &Indentation| of.number(IndentationNumber::ContactDepth).value;
        let exact = contacts.iter().filter_map(|of| {
            let exact = of.exact.as_ref().filter(|exact| exact.unit == "Pa")?;
            Some(ModulusAtDepth {
                depth: depth(of),
                modulus: exact.value?,
                sd: exact.sd?,
            })
        });
        let formula = contacts.iter().map(|of| {
            let Uncertain { value, sd } = of.number(IndentationNumber::IndentationModulus);
            ModulusAtDepth {
                depth: depth(of),
                modulus: value,
                sd,
            }
        });
        let unknown = self.found.unknowns.first();
        Moduli {
            head: self.head(),
            name: unknown.map_or(String::new(), |of| names::of_key(&of.key)),
            exact: exact.collect(),
            formula: formula.collect(),
            interval: unknown.map_or([None; 2], |of| of.interval),
        }
    }

    /// The unknowns of the fit without the nuisances.
    fn sought(&self) -> impl Iterator<Item = (usize, &Estimate)> {
        let all = self.fit.estimates.iter().enumerate();
        all.filter(|(_, estimate)| estimate.role == Role::Sought)
    }

    fn unknown(&self, index: usize, estimate: &Estimate) -> FittedUnknown {
        let case = &self.of.file.all_unknowns()[index];
        // The unknowns of a fit file are positive and fitted by their logarithms.
        let wald = estimate.wald.map(|[low, high]| 0.5 * (high / low).ln());
        let profile = estimate.profile.iter();
        let combination = estimate.known_combination.as_ref();
        FittedUnknown {
            name: names::of_key(&estimate.name),
            symbol: names::symbol(&estimate.name),
            scale: units::scale(estimate.value, case.unit()),
            value: estimate.value,
            interval: estimate.interval,
            bounds: case.range,
            verdict: estimate.verdict.to_string(),
            wald: wald.filter(|half| half.is_finite() && *half > 0.0),
            threshold: estimate.threshold(self.of.file.report.level),
            profile: profile
                .map(|point| [point.value, point.delta_chi_squared])
                .collect(),
            combination: combination.map(|known| Combination {
                words: names::combination(&known.expression),
                interval: known.interval.map(|end| Some(end? / known.value)),
            }),
        }
    }
}
