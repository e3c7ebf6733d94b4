//! `[output]`: the fields and pictures that a run writes.

use serde::Serialize;
use serde_json::Value;

use crate::declare::macros::record;
use crate::declare::{Codec, length, list, word};

record! {
    /// The files that a run writes in addition to summary, curve and report, and a number beyond those that every run
    /// has.
    pub struct OutputCase {
        fields: Steps = word(STEPS).or(Steps::Last, "\"last\""), "loading steps whose fields are written";
        pictures: Steps = word(STEPS).or(Steps::Last, "\"last\""),
            "loading steps whose pictures are drawn; with \"none\", those of the whole run are left out too";
        formats: Vec<Format> = list(word(FORMATS), FORMATS_WANTED).map(distinct).or(vec![Format::Npz], "[\"npz\"]"),
            "formats of the fields";
        #[serde(skip_serializing_if = "Option::is_none")]
        mean_pressure_over: Option<f64> = length().positive().optional("none"),
            "diameter of a disc over which the pressure is averaged: the largest average is a result beside the largest pressure";
    }
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

const STEPS: &[(&str, Steps)] = &[
    ("all", Steps::All),
    ("last", Steps::Last),
    ("none", Steps::None),
];

const FORMATS: &[(&str, Format)] = &[
    ("npz", Format::Npz),
    ("vti", Format::Vti),
    ("nc", Format::Nc),
    ("gsf", Format::Gsf),
];

const FORMATS_WANTED: &str =
    "a list of \"npz\", \"vti\", \"nc\", \"gsf\"; for no fields at all write fields = \"none\"";

/// The formats in order, each once.
fn distinct(mut formats: Vec<Format>) -> Vec<Format> {
    formats.sort_unstable();
    formats.dedup();
    formats
}

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
            mean_pressure_over: None,
        }
    }
}

impl OutputCase {
    /// Removes the choice of files from a case as JSON: it changes no result.
    pub fn leave_out_files(case: &mut Value) {
        let Some(Value::Object(output)) = case.get_mut("output") else {
            return;
        };
        for key in ["fields", "pictures", "formats"] {
            output.remove(key);
        }
        let is_empty = output.is_empty();
        if let Some(case) = case.as_object_mut().filter(|_| is_empty) {
            case.remove("output");
        }
    }

    /// Sets the formats, dropping duplicates.
    pub fn set_formats(&mut self, formats: &[Format]) {
        self.formats = formats.to_vec();
        self.formats.sort_unstable();
        self.formats.dedup();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::declare::{Record, Scope};
    use crate::input::table_reader::tests::read_table;

    fn read(text: &str) -> Result<OutputCase, String> {
        read_table(text, |table| OutputCase::read(&table, &Scope::default()))
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
    fn only_the_choice_of_files_is_left_out_of_what_changes_results() {
        let left = |text: &str| {
            let output = serde_json::to_value(read(text).unwrap()).unwrap();
            let mut case = serde_json::json!({ "title": "a", "output": output });
            OutputCase::leave_out_files(&mut case);
            case.to_string()
        };
        assert_eq!(left("fields = \"all\""), r#"{"title":"a"}"#);
        let over = left("mean_pressure_over = 0.5");
        assert_eq!(over, r#"{"title":"a","output":{"mean_pressure_over":0.5}}"#);
        let mut without = serde_json::json!({ "title": "a" });
        OutputCase::leave_out_files(&mut without);
        assert_eq!(without.to_string(), r#"{"title":"a"}"#);
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
            ("mean_pressure_over = \"0 um\"", "a positive length"),
        ] {
            let message = read(text).unwrap_err();
            assert!(message.contains(wanted), "{message}");
        }
    }
}
