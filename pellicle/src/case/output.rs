//! `[output]`: the fields and pictures that a run writes.

use serde::Serialize;

use crate::input::diagnosis::Diagnosis;
use crate::input::table_reader::TableReader;
use crate::input::value_reader::ValueReader;

/// The files that a run writes in addition to summary, curve and report.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct OutputCase {
    /// The loading steps whose fields are written.
    pub fields: Steps,
    /// The loading steps whose pictures are drawn; with `none`, the pictures of the whole run are also omitted.
    pub pictures: Steps,
    /// The formats of the fields, without duplicates.
    pub formats: Vec<Format>,
}

/// A choice of loading steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[serde(rename_all = "lowercase")]
pub enum Steps {
    /// Every loading step
    All,
    /// The last loading step
    Last,
    /// No loading step
    None,
}

/// A format of fields.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[serde(rename_all = "lowercase")]
pub enum Format {
    /// NumPy arrays, from which pictures can be redrawn
    Npz,
    /// VTK image data, for ParaView
    Vti,
    /// The layout of contact.engineering
    Nc,
    /// Gwyddion simple fields
    Gsf,
}

const STEPS: [(&str, Steps); 3] = [
    ("all", Steps::All),
    ("last", Steps::Last),
    ("none", Steps::None),
];

const FORMATS: [(&str, Format); 4] = [
    ("npz", Format::Npz),
    ("vti", Format::Vti),
    ("nc", Format::Nc),
    ("gsf", Format::Gsf),
];

impl Steps {
    /// Whether step `step` of `steps`, counted from 0, is included.
    #[must_use]
    pub fn contains(self, step: usize, steps: usize) -> bool {
        match self {
            Self::All => step < steps,
            Self::Last => step + 1 == steps,
            Self::None => false,
        }
    }

    /// The number of included steps, of `steps` in all.
    #[must_use]
    pub fn count(self, steps: usize) -> usize {
        match self {
            Self::All => steps,
            Self::Last => steps.min(1),
            Self::None => 0,
        }
    }
}

impl Default for OutputCase {
    fn default() -> Self {
        Self {
            fields: Steps::Last,
            pictures: Steps::Last,
            formats: vec![Format::Npz],
        }
    }
}

impl OutputCase {
    /// Reads the table.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of the first key with an unknown value.
    pub fn read(table: &TableReader<'_>) -> Result<Self, Diagnosis> {
        table.only(&["fields", "pictures", "formats"])?;
        let default = Self::default();
        let steps = |key| table.optional(key).map(|field| field.choice(&STEPS));
        Ok(Self {
            fields: steps("fields").unwrap_or(Ok(default.fields))?,
            pictures: steps("pictures").unwrap_or(Ok(default.pictures))?,
            formats: (table.optional("formats"))
                .map_or(Ok(default.formats), |field| formats(&field))?,
        })
    }

    /// Sets the formats, dropping duplicates.
    pub fn set_formats(&mut self, formats: &[Format]) {
        self.formats = formats.to_vec();
        self.formats.sort_unstable();
        self.formats.dedup();
    }
}

fn formats(field: &ValueReader<'_>) -> Result<Vec<Format>, Diagnosis> {
    let wanted =
        "a list of \"npz\", \"vti\", \"nc\", \"gsf\"; for no fields at all write fields = \"none\"";
    let items = field.list(wanted)?.into_iter();
    let mut formats: Vec<_> = items
        .map(|item| item.choice(&FORMATS))
        .collect::<Result<_, _>>()?;
    formats.sort_unstable();
    formats.dedup();
    Ok(formats)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::input::table_reader::tests::read_table;

    fn read(text: &str) -> Result<OutputCase, String> {
        read_table(text, |table| OutputCase::read(&table))
    }

    #[test]
    fn fields_and_pictures_default_to_the_last_step_and_fields_to_npz() {
        let output = read("").unwrap();
        assert_eq!((output.fields, output.pictures), (Steps::Last, Steps::Last));
        assert_eq!(output.formats, [Format::Npz]);
        let kept = |steps: Steps| (0..3).filter(|i| steps.contains(*i, 3)).collect::<Vec<_>>();
        assert_eq!(kept(Steps::Last), [2]);
        assert_eq!(kept(Steps::All), [0, 1, 2]);
        assert!(kept(Steps::None).is_empty());
        for steps in [Steps::All, Steps::Last, Steps::None] {
            assert_eq!(kept(steps).len(), steps.count(3));
        }
    }

    #[test]
    fn each_format_is_chosen_by_name_and_counted_once() {
        let output = read("formats = [\"nc\", \"npz\", \"nc\"]").unwrap();
        assert_eq!(output.formats, [Format::Npz, Format::Nc]);
    }

    #[test]
    fn invalid_steps_and_formats_are_rejected_with_the_valid_choices() {
        for (text, wanted) in [
            ("fields = \"lats\"", "\"all\", \"last\", \"none\""),
            ("pictures = true", "\"all\", \"last\", \"none\""),
            ("formats = [\"hdf5\"]", "\"npz\", \"vti\", \"nc\", \"gsf\""),
            ("formats = []", "fields = \"none\""),
            ("formats = \"npz\"", "a list of"),
            ("picture = \"all\"", "fields, pictures, formats"),
        ] {
            let message = read(text).unwrap_err();
            assert!(message.contains(wanted), "{message}");
        }
    }
}
