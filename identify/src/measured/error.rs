//! The reasons why a file does not give a measured curve, each with a stable code.

use pellicle::input::decode::NotInEncoding;

/// The reason why a file does not give a measured curve.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CurveError {
    /// The file cannot be read.
    #[error("found a file that cannot be read ({cause}), wanted a table of numbers as text")]
    Unreadable {
        /// The message of the operating system.
        cause: String,
    },
    /// The file is empty.
    #[error("found an empty file, wanted a table of numbers as text")]
    Empty,
    /// The file is not text.
    #[error("found {kind}, wanted a table as text: {tool}")]
    Binary {
        /// The apparent type of the file.
        kind: &'static str,
        /// The way to convert it to a table.
        tool: &'static str,
    },
    /// The text is not in this encoding.
    #[error(
        "found a byte in line {line} that is not {encoding}, wanted another encoding, such as \"windows-1252\""
    )]
    Encoding {
        /// The name of the encoding.
        encoding: String,
        /// Line of the byte, from 1.
        line: usize,
    },
    /// No line contains the text after which the table begins.
    #[error("found no line with \"{text}\", wanted the text of a line of the file")]
    SkipUntil {
        /// The text.
        text: String,
    },
    /// There is no table with this number.
    #[error("found {found} tables, wanted the number of one of them, not {wanted}")]
    NoSuchTable {
        /// The requested number.
        wanted: usize,
        /// Number of tables in the file.
        found: usize,
    },
    /// There are no lines of numbers.
    #[error("found no table, wanted lines with two numbers or more{}", .hint.unwrap_or_default())]
    NoTable {
        /// The setting that gives a table, as the end of the sentence.
        hint: Option<&'static str>,
    },
    /// No column has this name.
    #[error("found no column \"{name}\" among {columns}, wanted its name or its number from 1")]
    NoSuchColumn {
        /// The key of the column.
        key: &'static str,
        /// The requested name.
        name: String,
        /// The existing names.
        columns: String,
    },
    /// Several columns have this name.
    #[error(
        "found the columns {numbers} with the name \"{name}\", wanted the number of one of them"
    )]
    NameTwice {
        /// The key of the column.
        key: &'static str,
        /// The requested name.
        name: String,
        /// The numbers of the columns with that name.
        numbers: String,
    },
    /// The number of a column is larger than the table.
    #[error(
        "found a table of {columns} columns, wanted a number from 1 to {columns}, not {number}"
    )]
    ColumnRange {
        /// The key of the column.
        key: &'static str,
        /// The requested number.
        number: usize,
        /// Number of columns of the table.
        columns: usize,
    },
    /// Neither the file nor the table of units gives a unit.
    #[error(
        "found no unit of {name} in the file, wanted one in units, such as {name} = \"{example}\""
    )]
    NoUnit {
        /// The key of the column.
        name: &'static str,
        /// An example of a unit.
        example: &'static str,
    },
    /// The file gives another unit.
    #[error(
        "found {name} in {header} in the header of the file, and in {given} here, wanted one unit; \
         a bare number, the SI value of a 1 in the file, replaces that of the header"
    )]
    OtherUnit {
        /// The key of the column.
        name: &'static str,
        /// The unit in the header.
        header: String,
        /// The unit in the table of units.
        given: String,
    },
    /// The file gives two units.
    #[error(
        "found {name} in {header} in its heading and in {below} below it, wanted one unit; a bare number in units, the SI \
         value of a 1 in the file, replaces both"
    )]
    TwoUnits {
        /// The key of the column.
        name: &'static str,
        /// The unit in the heading.
        header: String,
        /// The unit in the line of units.
        below: String,
    },
    /// The name or the unit of the column indicates another quantity.
    #[error(
        "found the column \"{column}\", {found}, wanted one of {wanted}: are the columns swapped?"
    )]
    OtherQuantity {
        /// The key of the column.
        name: &'static str,
        /// The header of the column.
        column: String,
        /// The quantity that the header names.
        found: String,
        /// The expected dimension.
        wanted: &'static str,
    },
    /// A column of a voltage or a current has no calibration.
    #[error(
        "found the column \"{column}\", which is in {unit}, wanted in units what one {unit} is, \
         such as {name} = \"80 {example}/{unit}\", or a column of another name"
    )]
    NoCalibration {
        /// The key of the column.
        name: &'static str,
        /// The header of the column.
        column: String,
        /// Its unit.
        unit: String,
        /// An example of a unit.
        example: &'static str,
    },
    /// A number whose digits may be grouped by thousands.
    #[error(
        "found \"{field}\" in row {row}, which is a number above a thousand or a fraction, and no number in the file \
         shows which, wanted the other decimal mark, or numbers without separators of thousands"
    )]
    GroupedOrDecimal {
        /// The text of the number.
        field: String,
        /// The row, from 1.
        row: usize,
    },
    /// A number whose digits are grouped by the separator of the columns.
    #[error(
        "found {fields} in row {row}, one number in two fields, wanted numbers without separators of thousands, or \
         quotation marks around them"
    )]
    GroupedBySeparator {
        /// The fields.
        fields: String,
        /// The row, from 1.
        row: usize,
    },
    /// No row has a valid number in every requested column.
    #[error(
        "found {rows} rows, none with valid numbers in every column that is read, wanted at least one"
    )]
    NoNumbers {
        /// Rows of the table.
        rows: usize,
    },
    /// The forces are nowhere above their noise.
    #[error(
        "found forces that stay within their noise of {noise:.2e} N, wanted a contact, under which they rise"
    )]
    NoContact {
        /// Standard deviation of single forces, N.
        noise: f64,
    },
    /// No row has this marker.
    #[error("found no marker \"{marker}\" among {markers}, wanted one of them")]
    NoSuchMarker {
        /// The end of the segment that refers to it.
        end: &'static str,
        /// The requested marker.
        marker: String,
        /// The existing markers.
        markers: String,
    },
    /// No row has this value in the column of segments.
    #[error("found no row of the segment {value} among {values}, wanted one of them")]
    NoSuchSegment {
        /// The requested value.
        value: String,
        /// The existing values.
        values: String,
    },
    /// A row to be omitted is not in the table.
    #[error("found {rows} rows, wanted row {row} among them, which is to be omitted")]
    NoSuchRow {
        /// The row, from 1.
        row: usize,
        /// Rows of the table.
        rows: usize,
    },
    /// The segment keeps too few points.
    #[error("found {found} points in the segment out of {rows} rows, wanted at least {wanted}")]
    TooFewPoints {
        /// Number of points kept.
        found: usize,
        /// Rows of the table.
        rows: usize,
        /// The smallest number of points.
        wanted: usize,
    },
    /// The force is the same at every point.
    #[error("found a force of {force:e} N in every point of the segment, wanted one that changes")]
    ConstantForce {
        /// The force, N.
        force: f64,
    },
    /// The segment is an unloading.
    #[error(
        "found a force that falls from {from:e} to {to:e} N, an unloading, wanted a loading, or part = \"unloading\""
    )]
    Unloading {
        /// Force of the first point, N.
        from: f64,
        /// Force of the last point, N.
        to: f64,
    },
    /// The unloading is not elastic.
    #[error(
        "found an unloading that gives back {:.0} % of the work of the loading over the same depths: it is contact with \
         an imprint, or creep, but the model is contact with the undeformed surface; wanted the loading, up to its \
         first yield",
        100.0 * .part
    )]
    Hysteresis {
        /// The part of the work that it gives back.
        part: f64,
    },
    /// The file states another spring constant.
    #[error(
        "found {given:.4e} N/m, and {stated:.4e} N/m in line {line} of the file, \"{text}\", wanted one of them; a bare \
         number replaces that of the file"
    )]
    OtherSpringConstant {
        /// The one in the fit file, N/m.
        given: f64,
        /// The one in the file, N/m.
        stated: f64,
        /// Its line, from 1.
        line: usize,
        /// The text of the line.
        text: String,
    },
    /// There is no stretch before the contact to take a baseline from.
    #[error(
        "found no stretch before the contact{}, wanted {wanted} points of it or more: \
         without a baseline in the file give \"off\"", .range.map_or_else(String::new, |[near, far]| format!(" from {near:e} to {far:e} m before it"))
    )]
    NoBaseline {
        /// The distances before the contact, m.
        range: Option<[f64; 2]>,
        /// The smallest number of points.
        wanted: usize,
    },
    /// The depth decreases as the force increases.
    #[error(
        "found a depth that falls as the force rises, wanted a depth counted positive into the body: \
         swap the columns, or reverse the sign, such as units = {{ depth = \"-1 nm\" }}; of a cantilever, whose \
         deflection would then exceed its approach, check the unit of the force or deflection and the spring constant, or \
         give baseline = \"before contact\" if the force has a slope of its own"
    )]
    DepthFalls,
    /// The direction in which the piezo's height is counted cannot be determined from the force.
    #[error(
        "found a height that does not change with the force, wanted height_direction = \"toward\" or \"away\""
    )]
    HeightDirection,
}

impl From<NotInEncoding> for CurveError {
    fn from(NotInEncoding { encoding, line }: NotInEncoding) -> Self {
        Self::Encoding { encoding, line }
    }
}

impl CurveError {
    /// A short name, for programs.
    #[must_use]
    pub fn code(&self) -> &'static str {
        match self {
            Self::Unreadable { .. } => "unreadable",
            Self::Empty => "empty-file",
            Self::Binary { .. } => "binary-file",
            Self::Encoding { .. } => "other-encoding",
            Self::SkipUntil { .. } => "skip-until-not-found",
            Self::NoSuchTable { .. } => "no-such-table",
            Self::NoTable { .. } => "no-table",
            Self::NoSuchColumn { .. } => "no-such-column",
            Self::NameTwice { .. } => "column-name-twice",
            Self::ColumnRange { .. } => "column-out-of-range",
            Self::NoUnit { .. } => "no-unit",
            Self::OtherUnit { .. } | Self::TwoUnits { .. } => "other-unit",
            Self::OtherQuantity { .. } => "other-quantity",
            Self::NoCalibration { .. } => "no-calibration",
            Self::GroupedOrDecimal { .. } => "grouped-or-decimal",
            Self::GroupedBySeparator { .. } => "grouped-by-separator",
            Self::NoNumbers { .. } => "no-numbers",
            Self::NoContact { .. } => "no-contact",
            Self::NoSuchMarker { .. } => "no-such-marker",
            Self::NoSuchSegment { .. } => "no-such-segment",
            Self::NoSuchRow { .. } => "no-such-row",
            Self::TooFewPoints { .. } => "too-few-points",
            Self::ConstantForce { .. } => "constant-force",
            Self::Unloading { .. } => "unloading",
            Self::Hysteresis { .. } => "hysteresis",
            Self::OtherSpringConstant { .. } => "other-spring-constant",
            Self::NoBaseline { .. } => "no-baseline",
            Self::DepthFalls => "depth-falls",
            Self::HeightDirection => "height-direction",
        }
    }

    /// The keys of a `[[data]]` table to change, the most specific first.
    #[must_use]
    pub fn keys(&self) -> Vec<String> {
        match self {
            Self::Encoding { .. } => vec!["text.encoding".into(), "text".into()],
            Self::GroupedOrDecimal { .. } => vec!["text.decimal".into(), "text".into()],
            Self::SkipUntil { .. } => vec!["text.skip_until".into()],
            Self::NoSuchTable { .. } => vec!["text.table".into()],
            Self::NoSuchColumn { key, .. }
            | Self::NameTwice { key, .. }
            | Self::ColumnRange { key, .. } => vec![format!("columns.{key}")],
            Self::NoUnit { name, .. } => vec!["units".into(), format!("columns.{name}")],
            Self::OtherUnit { name, .. } | Self::TwoUnits { name, .. } => {
                vec![format!("units.{name}")]
            }
            Self::NoCalibration { name, .. } => {
                vec![format!("units.{name}"), format!("columns.{name}")]
            }
            Self::OtherQuantity { name, .. } => vec![format!("columns.{name}")],
            Self::NoSuchMarker { end, .. } => vec![format!("segment.{end}")],
            Self::NoSuchSegment { .. } => vec!["segment.value".into()],
            Self::NoSuchRow { .. } => vec!["omit".into()],
            Self::TooFewPoints { .. } | Self::ConstantForce { .. } | Self::Unloading { .. } => {
                vec!["segment".into()]
            }
            Self::Hysteresis { .. } => vec!["segment.part".into(), "segment".into()],
            Self::OtherSpringConstant { .. } => vec!["spring_constant".into()],
            Self::NoBaseline { .. } => vec!["baseline".into()],
            Self::DepthFalls => vec!["columns.depth".into()],
            Self::HeightDirection => vec!["height_direction".into(), "columns.height".into()],
            Self::Unreadable { .. }
            | Self::NoContact { .. }
            | Self::Empty
            | Self::Binary { .. }
            | Self::NoTable { .. }
            | Self::GroupedBySeparator { .. }
            | Self::NoNumbers { .. } => Vec::new(),
        }
    }
}
