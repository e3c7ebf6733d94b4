//! Files that are read in the same way: one `[[data]]` table, whose guesses its own reader has confirmed.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use pellicle::display::Unit;
use pellicle::input::span::Source;

use super::data_text::{self, Line};
use super::file_names::{named, relative};
use super::survey::Survey;
use super::words::{quantity, quoted};
use super::{DraftError, DraftKind};
use crate::measured::baseline::BeforeContactRows;
use crate::measured::channel::Channel;
use crate::measured::curve::MeasuredCurve;
use crate::measured::data_table::DataTable;
use crate::measured::error::CurveError;

/// A baseline is subtracted if its slope is this many standard errors, as a fit would then not follow the stretch
/// before the contact: otherwise its zero alone is sought.
const SLOPE_ERRORS: f64 = 4.0;
/// Continuous stiffness is evaluated above this part of the largest force: noise about the zero of the depth may leave
/// no area of contact.
const LEAST_FORCE: f64 = 0.01;
/// The line of a file whose force has a slope of its own.
const BASELINE: &str = "baseline = \"before contact\"";
/// The radius of a ball on a cantilever, m, if the file states none.
pub(super) const SOFT_RADIUS: f64 = 5e-6;

/// A file and its curve.
type Member = (Survey, MeasuredCurve);

/// Files that are read in the same way.
#[derive(Debug)]
pub(super) struct Group {
    /// The first of them.
    pub(super) survey: Survey,
    /// Its curve, as the drafted table reads it.
    pub(super) curve: MeasuredCurve,
    /// Whether the body is soft: probed by a cantilever.
    pub(super) is_soft: bool,
    /// Number of files.
    pub(super) count: usize,
    /// What `file` says, once for each table.
    files: Vec<String>,
    lines: Vec<Line>,
}

impl Group {
    /// Groups files that are curves; others become failures.
    pub(super) fn all(
        surveys: Vec<Survey>,
        folder: &Path,
        kind: DraftKind,
        failures: &mut Vec<DraftError>,
    ) -> Vec<Self> {
        let mut alike: Vec<(Vec<Line>, Vec<Member>)> = Vec::new();
        for mut survey in surveys {
            match read_either_way(&mut survey, folder) {
                Ok(curve) => {
                    let keys = data_text::keys(&survey);
                    match alike.iter_mut().find(|(known, _)| *known == keys) {
                        Some((_, members)) => members.push((survey, curve)),
                        None => alike.push((keys, vec![(survey, curve)])),
                    }
                }
                Err(error) => failures.push(error),
            }
        }
        let groups = alike.into_iter();
        groups
            .filter_map(|(keys, members)| Self::of(keys, members, folder, kind))
            .collect()
    }

    fn of(
        mut lines: Vec<Line>,
        mut members: Vec<Member>,
        folder: &Path,
        kind: DraftKind,
    ) -> Option<Self> {
        let count = members.len();
        let pop_in = members
            .iter()
            .find_map(|(survey, _)| survey.history.as_ref()?.pop_in);
        let is_stiffness = members
            .iter()
            .all(|(survey, _)| survey.has(Channel::Stiffness));
        let is_soft = kind == DraftKind::Afm || members.iter().all(|(of, _)| of.spring.is_some());
        lines.extend(baseline(&members).filter(|_| !is_stiffness));
        let reread = |survey: &Survey| read(survey, folder, &lines).ok();
        // The forces of the segment are those above the baseline.
        for (survey, curve) in &mut members {
            if let Some(again) = reread(survey) {
                *curve = again;
            }
        }
        let is_unloading = members.iter().any(|(survey, _)| survey.is_unloading);
        if is_unloading {
            // An evaluation finds loading, hold and unloading itself.
            let history = members.first().and_then(|(of, _)| of.history.as_ref());
            let peak = history.map(|of| of.peak.0).filter(|_| is_stiffness);
            lines.extend(peak.map(|peak| deep_line(LEAST_FORCE * peak)));
        } else if let Some(pop_in) = pop_in.filter(|_| !is_stiffness && !is_soft) {
            let why = format!(
                "a pop-in of {} in row {}, at {}: before it the contact is elastic",
                quantity(pop_in.height, Unit::Metre),
                pop_in.row,
                quantity(pop_in.force, Unit::Newton)
            );
            lines.push(Line::new(
                "segment = { until = \"largest depth step\" }",
                why,
            ));
        }
        let paths: Vec<PathBuf> = members
            .iter()
            .map(|(survey, _)| survey.file.clone())
            .collect();
        let (survey, curve) = members.into_iter().next()?;
        let curve = read(&survey, folder, &lines).unwrap_or(curve);
        Some(Self {
            survey,
            curve,
            is_soft,
            count,
            files: named(&paths, folder),
            lines,
        })
    }

    /// Its tables.
    pub(super) fn text(&self) -> String {
        let story = self.story();
        let mut text: String = story.iter().flat_map(|one| ["# ", one, "\n"]).collect();
        for file in &self.files {
            let key = Line::new(format!("file = {}", quoted(file)), self.counted());
            text += "[[data]]\n";
            text.extend([&key].into_iter().chain(&self.lines).map(Line::text));
            text.push('\n');
        }
        text
    }

    fn counted(&self) -> String {
        if self.files.len() == 1 && self.count > 1 {
            format!(
                "{} files: repeats, whose scatter is told; identify --each fits each alone",
                self.count
            )
        } else {
            String::new()
        }
    }
}

/// Reads a curve, with the sign of its depth reversed if that alone makes it one.
fn read_either_way(survey: &mut Survey, folder: &Path) -> Result<MeasuredCurve, DraftError> {
    match read(survey, folder, &data_text::keys(survey)) {
        Err(DraftError::Curve {
            error: CurveError::DepthFalls,
            file,
        }) => {
            let error = CurveError::DepthFalls;
            let mut keys = data_text::keys(survey);
            if survey.spring.is_some() {
                // A slope of the force along the height of the piezo is a slope of the depth, too.
                keys.push(Line::new(BASELINE, String::new()));
            } else {
                survey.reversed.push(Channel::Depth);
                keys = data_text::keys(survey);
            }
            let again = read(survey, folder, &keys);
            again.map_err(|_| DraftError::Curve { file, error })
        }
        read => read,
    }
}

/// Reads a curve with these keys.
fn read(survey: &Survey, folder: &Path, lines: &[Line]) -> Result<MeasuredCurve, DraftError> {
    let file = || survey.file.clone();
    let keys: Vec<&str> = lines.iter().map(|line| line.key.as_str()).collect();
    let keys = keys.join("\n");
    let text = format!(
        "[[data]]\nfile = {}\n{keys}\n",
        quoted(&relative(&survey.file, folder))
    );
    let refused = |message: String| DraftError::Refused {
        file: file(),
        message,
    };
    let source = Arc::new(Source::new("draft", text));
    let tables =
        DataTable::parse_all(&source, folder).map_err(|error| refused(error.to_string()))?;
    let table = tables.first().ok_or(DraftError::NoFiles)?;
    MeasuredCurve::read(&survey.file, table).map_err(|error| DraftError::Curve {
        file: file(),
        error,
    })
}

/// The baseline, if all curves show a stretch before the contact and it has a slope.
fn baseline(members: &[Member]) -> Option<Line> {
    let before = members.iter().map(|(_, curve)| curve.before_contact);
    let before: Vec<_> = before.collect::<Option<_>>()?;
    let is_sloped = |of: &&BeforeContactRows| of.line.slope.abs() > SLOPE_ERRORS * of.line.slope_sd;
    let first = before.iter().find(is_sloped);
    first.map(|first| {
        let slope = quantity(first.line.slope, Unit::NewtonPerMetre);
        Line::new(
            BASELINE,
            format!("the force has a slope of {slope} before the contact"),
        )
    })
}

fn deep_line(force: f64) -> Line {
    let key = format!(
        "segment = {{ from = {} }}",
        quoted(&quantity(force, Unit::Newton))
    );
    Line::new(
        key,
        "below a hundredth of the largest force the zero of the depth matters most",
    )
}
