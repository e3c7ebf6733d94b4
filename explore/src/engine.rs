//! From the text of a case to its answer.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

use pellicle::case::Case;
use pellicle::display::Unit;
use pellicle::input::span::Source;
use pellicle::input::toml_tree::{self, TomlNode, TomlValue};
use pellicle::input::{overrides, source_file};
use pellicle::memory::MemoryBudget;
use pellicle::run::{self, Resources};
use pellicle::summary::{RunSummary, WarningSummary};
use pellicle::{Completeness, Error, Event, Monitor, Run};
use pellicle_contact::{ContactError, Signal};
use pellicle_influence::Cache;
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use crate::edit::{self, Edit, EditError, Starters};
use crate::pages::Turn;
use crate::picture::{self, Detail, scale};
use crate::{form, numbers};

/// A case to start from.
#[derive(Debug, Clone, Serialize)]
pub struct Template {
    /// The name of its file.
    pub name: String,
    /// What it is about.
    pub meaning: String,
    /// Its text.
    pub text: String,
}

/// What the page is opened with.
#[derive(Debug)]
pub struct Setup {
    /// The case to open; without one, the page lets the user choose a template.
    pub case: Option<Template>,
    /// The commented cases, from which tables that are added take their values, too.
    pub templates: Vec<Template>,
    /// The folder to which file names in cases are relative.
    pub folder: PathBuf,
    /// The coefficients found so far.
    pub cache: Cache,
    /// The critical loads of a run in words, a line each.
    pub critical: fn(&RunSummary) -> String,
}

/// A request of the page.
#[derive(Debug, Clone, Deserialize)]
pub struct Ask {
    /// The page.
    pub page: String,
    /// Its number among those of the page.
    pub number: u64,
    /// The name of the file.
    pub name: String,
    /// The text of the case.
    pub text: String,
    /// Its changes.
    #[serde(default)]
    pub edits: Vec<Edit>,
    /// Elements per side, if fewer than those of the case are enough for now; stresses are then left out.
    #[serde(default)]
    pub elements: Option<usize>,
    /// The loading step that is drawn; by default the last.
    #[serde(default)]
    pub step: Option<usize>,
}

/// Solves cases, one at a time: a solution uses every core.
#[derive(Debug)]
pub struct Engine {
    setup: Setup,
    starters: Starters,
    memory: MemoryBudget,
    solving: Mutex<()>,
    /// Whether the program ends.
    ending: AtomicBool,
}

/// Why there is no result.
enum Fault {
    Edit(EditError),
    Case(Error),
    /// A newer request of the page makes this one needless.
    Superseded,
}

impl From<Error> for Fault {
    fn from(error: Error) -> Self {
        match error {
            Error::Contact(ContactError::Cancelled { .. }) => Self::Superseded,
            error => Self::Case(error),
        }
    }
}

impl Engine {
    /// An engine for this page.
    #[must_use]
    pub fn new(setup: Setup) -> Self {
        let texts = setup.templates.iter().map(|of| of.text.as_str());
        Self {
            starters: Starters::new(texts),
            setup,
            memory: MemoryBudget::default(),
            solving: Mutex::default(),
            ending: AtomicBool::new(false),
        }
    }

    /// Stops what is being solved, and everything after it.
    pub fn end(&self) {
        self.ending.store(true, Ordering::Relaxed);
    }

    /// Whether it has been ended.
    #[must_use]
    pub fn is_ending(&self) -> bool {
        self.ending.load(Ordering::Relaxed)
    }

    /// What the page is made of: the fields of a case, the templates, the case to open.
    #[must_use]
    pub fn form(&self) -> Value {
        json!({
            "form": form::table(&Case::shape()),
            "templates": self.setup.templates,
            "case": self.setup.case,
        })
    }

    /// The answer: the text with its changes and its values; its result, or the error and its key; or that a newer
    /// request makes it needless.
    #[must_use]
    pub fn answer(&self, ask: &Ask, turn: &Turn<'_>) -> Value {
        let text = match edit::edited(&ask.text, &ask.edits, &self.starters) {
            Ok(text) => text,
            Err(error) => return answer(&ask.text, Err(Fault::Edit(error))),
        };
        answer(&text, self.result(ask, &text, turn))
    }

    fn result(&self, ask: &Ask, text: &str, turn: &Turn<'_>) -> Result<Value, Fault> {
        let _solving = self.solving.lock().unwrap_or_else(PoisonError::into_inner);
        if turn.is_superseded() || self.is_ending() {
            return Err(Fault::Superseded);
        }
        let start = Instant::now();
        let (case, detail) = self.case(ask, text)?;
        let resources = Resources {
            cache: &self.setup.cache,
            memory: &self.memory,
            writers: 0,
        };
        let mut monitor = Watch { turn, engine: self };
        let run = run::solve(&case, resources, start, &mut monitor)?;
        let mut run = run
            .filter(|run| run.completeness == Completeness::Whole)
            .ok_or(Fault::Superseded)?;
        run.summary.add_case(&case)?;
        let warnings = self.setup.cache.take_warnings();
        let warnings = warnings.iter().map(WarningSummary::from);
        run.summary.warnings.extend(warnings);
        let mut result = self.told(&run, ask.step, detail);
        result["seconds"] = start.elapsed().as_secs_f64().into();
        Ok(result)
    }

    /// The case of a text, with fewer elements and without stresses if that is asked for and possible.
    fn case(&self, ask: &Ask, text: &str) -> Result<(Case, Detail), Error> {
        let source = Arc::new(Source::new(&ask.name, text.to_owned()));
        let root = toml_tree::parse(&source)?;
        let title = source_file::stem(Path::new(&ask.name));
        let resolve = |root: &TomlNode| Case::resolve(root, &title, &self.setup.folder);
        let case = resolve(&root)?;
        let fewer = ask.elements.filter(|fewer| *fewer < case.grid.elements);
        let sketched = fewer.and_then(|elements| {
            let mut root = root;
            overrides::set(&mut root, &format!("grid.elements={elements}")).ok()?;
            if let TomlValue::Table(table) = &mut root.value {
                table.entries.retain(|entry| entry.key != "stress");
                // A mean over less than an element is refused.
                let outputs = table
                    .entries
                    .iter_mut()
                    .filter(|entry| entry.key == "output");
                for output in outputs {
                    if let TomlValue::Table(output) = &mut output.node.value {
                        let is_mean = |key: &str| key == "mean_pressure_over";
                        output.entries.retain(|entry| !is_mean(&entry.key));
                    }
                }
            }
            resolve(&root).ok()
        });
        Ok(match sketched {
            Some(sketched) => (sketched, Detail::Sketch),
            None => (case, Detail::Whole),
        })
    }

    fn told(&self, run: &Run, step: Option<usize>, detail: Detail) -> Value {
        let summary = &run.summary;
        let steps = summary.steps.iter();
        let last = summary.steps.len().saturating_sub(1);
        let step = step.unwrap_or(last).min(last);
        let forces = steps.clone().map(|step| step.force);
        let penetrations = steps.clone().map(|step| step.penetration);
        let pressures = steps.clone().map(|step| step.summary.max_pressure);
        json!({
            "title": summary.title, "status": summary.status,
            "elements": summary.grid.elements, "is_sketch": detail == Detail::Sketch,
            "grid": format!(
                "{} elements, {}",
                summary.grid.elements_in_words(),
                summary.grid.sides_in_words(summary.units),
            ),
            "warnings": summary.warnings,
            "steps": steps.map(|step| numbers::step(summary, step)).collect::<Vec<_>>(),
            "step": step,
            "critical": (self.setup.critical)(summary).lines().collect::<Vec<_>>(),
            "pictures": picture::of_step(run, step, detail),
            "scales": {
                "force": scale(forces, Unit::Newton, run),
                "penetration": scale(penetrations, Unit::Metre, run),
                "pressure": scale(pressures, Unit::Pascal, run),
                "length": scale([summary.grid.side / 2.0], Unit::Metre, run),
            },
        })
    }
}

/// Stops a solution that nobody waits for.
struct Watch<'a> {
    turn: &'a Turn<'a>,
    engine: &'a Engine,
}

impl Monitor for Watch<'_> {
    fn told(&mut self, _: Event<'_>) -> Signal {
        if self.turn.is_superseded() || self.engine.is_ending() {
            Signal::Cancel
        } else {
            Signal::Continue
        }
    }
}

fn answer(text: &str, result: Result<Value, Fault>) -> Value {
    let source = Arc::new(Source::new("", text.to_owned()));
    let values = toml_tree::parse(&source).map_or(Value::Null, |root| values(&root));
    let mut answer = json!({ "text": text, "values": values });
    match result {
        Ok(result) => answer["result"] = result,
        Err(Fault::Superseded) => answer["superseded"] = true.into(),
        Err(Fault::Edit(error)) => answer["error"] = json!({ "sentence": error.to_string() }),
        Err(Fault::Case(Error::Case(diagnosis))) => {
            answer["error"] = json!({
                "key": diagnosis.key, "line": diagnosis.span.line(),
                "sentence": diagnosis.fault.to_string(), "help": diagnosis.help,
            });
        }
        Err(Fault::Case(error)) => answer["error"] = json!({ "sentence": error.to_string() }),
    }
    answer
}

/// The values of a text, as they are written.
fn values(node: &TomlNode) -> Value {
    match &node.value {
        TomlValue::Text(text) => text.as_str().into(),
        TomlValue::Integer(number) => (*number).into(),
        TomlValue::Float(number) => (*number).into(),
        TomlValue::Boolean(truth) => (*truth).into(),
        TomlValue::Datetime => Value::Null,
        TomlValue::List(items) => items.iter().map(values).collect(),
        TomlValue::Table(table) => {
            let entries = table.entries.iter();
            entries
                .map(|entry| (entry.key.clone(), values(&entry.node)))
                .collect()
        }
    }
}
