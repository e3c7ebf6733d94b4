//! The table of numbers in a text: its beginning and end, its rows, and the headers of its columns.

use super::decimal_mark::DecimalMark;
use super::error::CurveError;
use super::header::HeaderField;
use super::header_lines::LinesAbove;
use super::separator::Separator;
use super::stated::StatedNumber;
use super::text_options::TextOptions;

/// A run of rows counts as a table if it has at least 1/10 as many rows as the longest run.
const SHARE_OF_LONGEST: usize = 10;

/// A table whose header is repeated goes on if no number of its next row is farther from that of its last one than this
/// part of the range of its column, or so many of its last steps; a new test begins anew.
const GOES_ON: f64 = 0.1;
const MOST_STEPS: f64 = 2.0;
/// Most lines between a table and its continuation: a title, the names and the units of its columns.
const MOST_BETWEEN: usize = 4;

const SAMPLED: usize = 500;

/// A table in a text.
#[derive(Debug, Clone, PartialEq)]
pub struct TextTable<'t> {
    /// The separator of its columns.
    pub separator: Separator,
    /// The headers of its columns; empty if there are none.
    pub header: Vec<HeaderField>,
    /// Its rows, as lines of the text; lines without any value are left out.
    pub rows: Vec<&'t str>,
    /// Number of columns of its first row.
    pub columns: usize,
    /// Number of tables in the text.
    pub tables: usize,
    /// The numbers that the lines above it state.
    pub stated: Vec<StatedNumber>,
}

/// The role of a line in a table.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum LineKind {
    /// At least two fields are numbers.
    Row,
    /// As many fields as the first row has, with one number or no word among them.
    Broken,
    /// No value at all, or a comment.
    Blank,
    /// Something else, at which a table ends.
    Other,
}

/// Consecutive lines of a table, from the first row to the end of the last.
#[derive(Debug, Clone, Copy)]
struct RowRun {
    start: usize,
    end: usize,
    rows: usize,
}

impl<'t> TextTable<'t> {
    /// Finds the table that the options specify.
    ///
    /// # Errors
    ///
    /// [`CurveError`] if there is none.
    pub fn find(text: &'t str, options: &TextOptions) -> Result<Self, CurveError> {
        let lines = lines(text);
        let found = Separator::of(&lines, options.decimal);
        let hint = hint(&lines, options.decimal, found.map_or(0, |(_, rows)| rows));
        let no_table = || CurveError::NoTable { hint };
        let separator = match (options.separator, found) {
            (Some(separator), _) => separator,
            (None, Some((separator, _))) if hint.is_none() => separator,
            _ => return Err(no_table()),
        };
        let runs = RowRuns {
            lines: &lines,
            separator,
            decimal: options.decimal,
        };
        let (floor, run, tables) = match &options.skip_until {
            Some(text) => runs.behind(text, options.table.unwrap_or(1))?,
            None => runs.of_whole_text(options.table.unwrap_or(1))?,
        };
        let run = run.ok_or_else(no_table)?;
        let kept = lines.get(run.start..run.end).unwrap_or_default();
        let columns = kept.first().map_or(0, |row| separator.fields(row).len());
        let is_row = |line: &&&str| {
            let kind = runs.kind(line, columns);
            matches!(kind, LineKind::Row | LineKind::Broken)
        };
        Ok(Self {
            separator,
            header: LinesAbove {
                lines: lines.get(floor..run.start).unwrap_or_default(),
                separator,
                width: columns,
                is_named: options.skip_until.is_some(),
            }
            .headers(),
            rows: kept.iter().filter(is_row).copied().collect(),
            columns,
            tables,
            stated: StatedNumber::all(lines.get(..run.start).unwrap_or_default()),
        })
    }
}

/// Splits a text into lines, with any kind of line ending.
fn lines(text: &str) -> Vec<&str> {
    let mark = if text.contains('\n') { '\n' } else { '\r' };
    text.split(mark)
        .map(|line| line.trim_matches('\r'))
        .collect()
}

/// The decimal mark that gives a table, if the present one gives hardly any row.
fn hint(lines: &[&str], decimal: DecimalMark, rows: usize) -> Option<&'static str> {
    let (other, hint) = match decimal {
        DecimalMark::Point => (DecimalMark::Comma, ": decimal = \",\" gives one"),
        DecimalMark::Comma => (DecimalMark::Point, ": decimal = \".\" gives one"),
    };
    let (_, of_other) = Separator::of(lines, other)?;
    (of_other > SHARE_OF_LONGEST * rows).then_some(hint)
}

/// The runs of rows in the lines of a text.
struct RowRuns<'a, 't> {
    lines: &'a [&'t str],
    separator: Separator,
    decimal: DecimalMark,
}

impl RowRuns<'_, '_> {
    /// Returns the n-th table of the whole text, and the number of tables.
    fn of_whole_text(&self, wanted: usize) -> Result<(usize, Option<RowRun>, usize), CurveError> {
        let runs = self.all(0, self.lines.len());
        let longest = runs.iter().map(|run| run.rows).max().unwrap_or(0);
        let is_long = |run: &&RowRun| run.rows * SHARE_OF_LONGEST >= longest;
        let tables: Vec<_> = runs.iter().filter(is_long).copied().collect();
        let found = tables.len();
        match tables.get(wanted - 1) {
            None if found > 0 => Err(CurveError::NoSuchTable { wanted, found }),
            run => Ok((0, run.copied(), found)),
        }
    }

    /// Returns the first long table from the n-th line with the text on, and the number of such lines.
    fn behind(
        &self,
        text: &str,
        wanted: usize,
    ) -> Result<(usize, Option<RowRun>, usize), CurveError> {
        let words = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
        let text = words(text);
        let has_text =
            |(number, line): (usize, &&str)| words(line).contains(&text).then_some(number);
        let starts: Vec<_> = self.lines.iter().enumerate().filter_map(has_text).collect();
        let found = starts.len();
        let Some(&start) = starts.get(wanted - 1) else {
            return Err(match found {
                0 => CurveError::SkipUntil { text },
                _ => CurveError::NoSuchTable { wanted, found },
            });
        };
        let end = starts.get(wanted).copied().unwrap_or(self.lines.len());
        let runs = self.all(start, end);
        let longest = runs.iter().map(|run| run.rows).max().unwrap_or(0);
        let long = runs
            .iter()
            .find(|run| run.rows * SHARE_OF_LONGEST >= longest);
        Ok((start, long.copied(), found))
    }

    /// Finds all runs between two lines.
    fn all(&self, start: usize, end: usize) -> Vec<RowRun> {
        let mut runs: Vec<RowRun> = Vec::new();
        let (mut open, mut columns) = (false, 0);
        for number in start..end {
            let line = self.lines.get(number).copied().unwrap_or_default();
            match (self.kind(line, columns), open) {
                (LineKind::Row, false) if self.goes_on(runs.last(), number) => {
                    open = true;
                    if let Some(run) = runs.last_mut() {
                        (run.end, run.rows) = (number + 1, run.rows + 1);
                    }
                }
                (LineKind::Row, false) => {
                    open = true;
                    columns = self.separator.fields(line).len();
                    runs.push(RowRun {
                        start: number,
                        end: number + 1,
                        rows: 1,
                    });
                }
                (LineKind::Row | LineKind::Broken, true) => {
                    if let Some(run) = runs.last_mut() {
                        (run.end, run.rows) = (number + 1, run.rows + 1);
                    }
                }
                (LineKind::Other, _) => open = false,
                (LineKind::Blank | LineKind::Broken, _) => {}
            }
        }
        runs
    }

    /// Whether a run goes on with the row in this line, behind its own header.
    fn goes_on(&self, run: Option<&RowRun>, next: usize) -> bool {
        let Some(run) = run else {
            return false;
        };
        let is_empty = |line: &&&str| line.trim().is_empty();
        let above = self.lines[..run.start].iter().rev();
        let Some(header) = above.clone().find(|line| !is_empty(line)) else {
            return false;
        };
        let between = self.lines[run.end..next].iter();
        let between: Vec<_> = between.filter(|line| !is_empty(line)).collect();
        if !between.contains(&header) || between.len() > MOST_BETWEEN {
            return false;
        }
        let numbers = |line: &&str| -> Vec<f64> {
            let fields = self.separator.fields(line).into_iter();
            let number = |field| self.decimal.number(field).unwrap_or(f64::NAN);
            fields.map(number).collect()
        };
        // A few hundred rows tell the range, and the last two where it goes on and by which steps.
        let some = (run.start..run.end).step_by(run.rows.div_ceil(SAMPLED));
        let some = some.chain(run.end.saturating_sub(2)..run.end);
        let rows: Vec<_> = some.map(|line| numbers(&self.lines[line])).collect();
        let next = numbers(&self.lines[next]);
        let goes_on = |(column, number): (usize, &f64)| {
            let all = || rows.iter().filter_map(|row| row.get(column)).copied();
            let low = all().fold(f64::INFINITY, f64::min);
            let high = all().fold(f64::NEG_INFINITY, f64::max);
            let mut finite = all().rev().filter(|number| number.is_finite());
            let Some(last) = finite.next() else {
                return true;
            };
            let step = finite.next().map_or(0.0, |before| (last - before).abs());
            let jump = (number - last).abs();
            jump.is_nan() || jump <= f64::max(GOES_ON * (high - low), MOST_STEPS * step)
        };
        next.len() == rows[0].len() && next.iter().enumerate().all(goes_on)
    }

    fn kind(&self, line: &str, columns: usize) -> LineKind {
        if line.starts_with(['#', '%']) {
            return LineKind::Blank;
        }
        let fields = self.separator.fields(line);
        let is_number = |field: &&&str| self.decimal.number(field).is_some();
        let numbers = fields.iter().filter(is_number).take(2).count();
        if numbers == 2 {
            return LineKind::Row;
        }
        if fields.iter().all(|field| field.is_empty()) {
            return LineKind::Blank;
        }
        let has_word = |field: &&str| field.contains(char::is_alphabetic);
        let may_be_broken = numbers == 1 || !fields.iter().any(has_word);
        if fields.len() == columns && columns > 1 && may_be_broken {
            return LineKind::Broken;
        }
        LineKind::Other
    }
}
