//! The study file: `[study]`, and the base case in the same file or in one of its own.
//!
//! ```toml
//! [study]
//! case = "coating.toml"        # from the folder of this file; without it the rest of this file is the base case
//! combine = "product"          # every value with every other, the last key fastest; or "zip": the first of all, the second of all, …
//!
//! keep = ["pressure"]          # fields of all cases in one file
//!
//! [study.vary]                 # any key of the case: a list, or a range; a key with brackets in quotes
//! "foundation.layer[0].thickness" = ["1 um", "2 um"]
//! load.force = { from = "1 mN", to = "10 mN", count = 5, spacing = "log" }
//! from = "samples.csv"         # or cases made elsewhere: a column for every key, whose values change together
//! ```

use std::path::Path;
use std::sync::Arc;

use pellicle::input::diagnosis::{Diagnosis, Fault};
use pellicle::input::key_path::{self, dotted};
use pellicle::input::overrides;
use pellicle::input::source_file;
use pellicle::input::span::{COMMAND_LINE, Source, Span};
use pellicle::input::table_reader::TableReader;
use pellicle::input::toml_tree::{self, TomlNode, TomlTable, TomlValue};
use pellicle::input::value_reader::ValueReader;

use crate::StudyError;
use crate::keys;
use crate::numbering::{CaseNumbering, Combine, MAX_CASES};
use crate::samples;
use crate::varied_key::VariedKey;
use crate::{KeptField, Study};

/// The key of `[study.vary]` that names a file and no key of the case.
pub(crate) const FROM: &str = "from";

/// Reads the file, and the base case with the values of `sets` in place of its own.
///
/// # Errors
///
/// [`StudyError`] if a file cannot be read or is not a valid study.
pub fn read(path: &Path, sets: &[String]) -> Result<Study, StudyError> {
    let root = parse(path)?;
    let here = path.parent().unwrap_or(Path::new(""));
    let parts = StudyTable::of(&root, here)?;
    let (mut base, case) = match parts.case {
        Some(case) => (parse(&here.join(case))?, here.join(case)),
        None => (without_study(&root), path.to_owned()),
    };
    for argument in sets {
        refuse_varied(argument, &parts.varied_keys)?;
        overrides::set(&mut base, argument)?;
    }
    Ok(Study {
        name: source_file::stem(path),
        case_name: source_file::stem(&case),
        folder: case.parent().unwrap_or(Path::new("")).to_owned(),
        base,
        numbering: parts.numbering,
        varied_keys: parts.varied_keys,
        keep: parts.keep,
    })
}

/// A value from the command line of a key that the study varies would have no effect.
fn refuse_varied(argument: &str, varied_keys: &[VariedKey]) -> Result<(), Diagnosis> {
    let key = argument.split_once('=').map_or("", |(key, _)| key);
    let Some(path) = key_path::parts(key) else {
        return Ok(());
    };
    let is_it = |varied: &&VariedKey| key_path::parts(&varied.key).as_ref() == Some(&path);
    let Some(varied) = varied_keys.iter().find(is_it) else {
        return Ok(());
    };
    let source = Arc::new(Source::new(COMMAND_LINE, argument.to_owned()));
    let fault = Fault::Wrong {
        found: format!("a value of {}, which [study.vary] varies", varied.key),
        wanted: "a key that it does not vary".into(),
    };
    Err(Diagnosis::of_text(Span::new(&source, 0..key.len()), fault))
}

fn parse(path: &Path) -> Result<TomlNode, StudyError> {
    let source: Arc<Source> = Arc::new(source_file::read(path)?);
    Ok(toml_tree::parse(&source)?)
}

fn without_study(root: &TomlNode) -> TomlNode {
    let mut base = root.clone();
    if let TomlValue::Table(table) = &mut base.value {
        table.entries.retain(|entry| entry.key != "study");
    }
    base
}

/// The table `[study]`.
struct StudyTable<'a> {
    case: Option<&'a str>,
    numbering: CaseNumbering,
    varied_keys: Vec<VariedKey>,
    keep: Vec<KeptField>,
}

impl<'a> StudyTable<'a> {
    fn of(root: &'a TomlNode, here: &Path) -> Result<Self, StudyError> {
        let root = TableReader::root(root)?;
        let study = root.required("study", "a table [study]")?.table()?;
        study.only(&keys::study().keys())?;
        let case = study
            .optional("case")
            .map(|field| field.text())
            .transpose()?;
        if case.is_some() {
            root.only(&["study"])?;
        }
        let combine = match study.optional("combine") {
            Some(field) => field.choice(&Combine::CHOICES)?,
            None => Combine::Product,
        };
        let keep = study.optional("keep");
        let keep = keep.map_or(Ok(Vec::new()), |field| kept(&field))?;
        let vary = study.required("vary", "a table of keys, each with a list or a range")?;
        let TomlValue::Table(table) = vary.value() else {
            let wanted = "a table of keys, each with a list or a range";
            return Err(vary.wanted(wanted).into());
        };
        let mut varied_keys = Vec::new();
        collect("", table, &mut varied_keys)?;
        varied_keys.extend(sampled(table, here)?);
        varied_keys.sort_by_key(|varied| varied.key_span.bytes.start);
        if varied_keys.is_empty() {
            return Err(vary
                .wanted("at least one key with a list or a range")
                .into());
        }
        let lengths = number_axes(&mut varied_keys);
        let numbering = CaseNumbering { combine, lengths };
        check(&varied_keys, &numbering)?;
        Ok(Self {
            case,
            numbering,
            varied_keys,
            keep,
        })
    }
}

/// The fields that are kept, each once.
fn kept(field: &ValueReader<'_>) -> Result<Vec<KeptField>, Diagnosis> {
    let words = KeptField::CHOICES.map(|(word, _)| word);
    let wanted = format!("a list of \"{}\"", words.join("\", \""));
    let items = field.list(&wanted)?.into_iter();
    let mut kept = items
        .map(|item| item.choice(&KeptField::CHOICES))
        .collect::<Result<Vec<_>, _>>()?;
    kept.sort_unstable();
    kept.dedup();
    Ok(kept)
}

/// Gives every key an axis, and those of a file one together; the number of values of every axis.
fn number_axes(varied_keys: &mut [VariedKey]) -> Vec<usize> {
    let mut lengths = Vec::new();
    let mut is_after_sampled = false;
    for varied in varied_keys {
        if !(is_after_sampled && varied.is_sampled()) {
            lengths.push(varied.len());
        }
        varied.axis = lengths.len() - 1;
        is_after_sampled = varied.is_sampled();
    }
    lengths
}

/// The keys of the file that `from` names, a path relative to `here`.
fn sampled(table: &TomlTable, here: &Path) -> Result<Vec<VariedKey>, StudyError> {
    let Some(entry) = table.entry(FROM) else {
        return Ok(Vec::new());
    };
    let name = ValueReader::new(format!("study.vary.{FROM}"), &entry.node);
    let columns = samples::read(&here.join(name.text()?), MAX_CASES)?;
    let key = |(key, column)| VariedKey::sampled(key, entry.key_span.clone(), column);
    Ok(columns.into_iter().map(key).collect())
}

/// Collects the keys of a table and of its subtables: `load.force = …` is the key `force` of the table `load`.
fn collect(
    path: &str,
    table: &TomlTable,
    varied_keys: &mut Vec<VariedKey>,
) -> Result<(), Diagnosis> {
    for entry in &table.entries {
        if path.is_empty() && entry.key == FROM {
            continue;
        }
        let key = dotted(path, &entry.key);
        match &entry.node.value {
            TomlValue::Table(inner) if inner.entry("from").is_none() => {
                collect(&key, inner, varied_keys)?;
            }
            _ => varied_keys.push(VariedKey::read(key, entry.key_span.clone(), &entry.node)?),
        }
    }
    Ok(())
}

/// Refuses repeated keys, lists of different lengths to be zipped, and too many cases.
fn check(varied_keys: &[VariedKey], numbering: &CaseNumbering) -> Result<(), Diagnosis> {
    let wrong = |varied: &VariedKey, found: String, wanted: String| {
        let fault = Fault::Wrong { found, wanted };
        Err(Diagnosis::of_key(
            varied.key.clone(),
            varied.key_span.clone(),
            fault,
        ))
    };
    let Some(first) = varied_keys.first() else {
        return Ok(());
    };
    let is_given_before = |(i, varied): &(usize, &VariedKey)| {
        let path = key_path::parts(&varied.key);
        varied_keys[..*i]
            .iter()
            .any(|other| key_path::parts(&other.key) == path)
    };
    if let Some((_, varied)) = varied_keys.iter().enumerate().find(is_given_before) {
        return wrong(varied, "the same key twice".into(), "each key once".into());
    }
    let wanted = first.len();
    let other = varied_keys.iter().find(|varied| varied.len() != wanted);
    if let (Combine::Zip, Some(other)) = (numbering.combine, other) {
        let found = format!("{} values", other.len());
        let wanted = format!("{wanted}, as many as `{}` has, to be zipped", first.key);
        return wrong(other, found, wanted);
    }
    if numbering.case_count() > MAX_CASES {
        let found = format!("{} cases", numbering.case_count());
        return wrong(first, found, format!("at most {MAX_CASES}"));
    }
    Ok(())
}
