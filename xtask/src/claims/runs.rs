//! Evidence from runs of the release binary.

use std::collections::BTreeMap;
use std::rc::Rc;

use serde_json::Value;

use super::evidence::{Evidence, Numbers, Subject};
use super::{ClaimsError, ContactFields, Curve, Cylinders};
use crate::{Keep, PaperCase, PaperRun, Request, Runner, XtaskError};

/// Results of the paper's cases: kept from before, or solved now.
pub(super) struct Runs<'a> {
    runner: Runner,
    tell: &'a mut dyn FnMut(&str),
    /// Runs of this session by their request's folder; one with fields also answers for its numbers.
    solved: BTreeMap<String, Rc<PaperRun>>,
    /// The fields looked at last: claims about one case stand together, and fields are large.
    last: Option<(String, Rc<ContactFields>)>,
}

impl<'a> Runs<'a> {
    /// Runs by this runner; `tell` hears what is solved and what was kept.
    pub(super) fn new(runner: Runner, tell: &'a mut dyn FnMut(&str)) -> Self {
        Self {
            runner,
            tell,
            solved: BTreeMap::new(),
            last: None,
        }
    }

    fn run(&mut self, subject: Subject<'_>, keep: Keep) -> Result<Rc<PaperRun>, XtaskError> {
        let request = Request {
            case: case(subject.case)?,
            elements: subject.elements,
            sets: subject.set.to_vec(),
            keep,
        };
        let name = request.folder();
        let with_fields = Request {
            keep: Keep::Fields,
            ..request.clone()
        };
        let known = [&name, &with_fields.folder()]
            .into_iter()
            .find_map(|name| self.solved.get(name));
        if let Some(run) = known {
            return Ok(Rc::clone(run));
        }
        let run = Rc::new(self.runner.run(&request, self.tell)?);
        self.solved.insert(name, Rc::clone(&run));
        Ok(run)
    }
}

impl Evidence for Runs<'_> {
    fn fields(&mut self, subject: Subject<'_>) -> Result<Rc<ContactFields>, XtaskError> {
        let name = format!("{subject:?}");
        if let Some((_, fields)) = self.last.as_ref().filter(|(last, _)| *last == name) {
            return Ok(Rc::clone(fields));
        }
        let run = self.run(subject, Keep::Fields)?;
        let fields = Rc::new(contact_fields(&run, subject)?);
        self.last = Some((name, Rc::clone(&fields)));
        Ok(fields)
    }

    fn cylinders(&mut self, subject: Subject<'_>) -> Result<Cylinders, XtaskError> {
        let run = self.run(subject, Keep::Numbers)?;
        let surface = &run.record.case["surface"];
        let length = |key: &str| number(&surface[key], subject, key);
        Ok(Cylinders {
            radius: length("radius")?,
            period: length("period")?,
        })
    }

    fn numbers(&mut self, subject: Subject<'_>) -> Result<Numbers, XtaskError> {
        let run = self.run(subject, Keep::Numbers)?;
        let step = step(&run, subject)?;
        Ok(Numbers {
            element_side: run.record.grid.element_side,
            penetration: step.penetration,
            max_pressure: step.max_pressure,
            max_pressure_at: step.max_pressure_at,
            contact_area: step.contact_area,
            contact_area_between: step.contact_area_between,
            spring_length: spring_length(&run, subject)?,
        })
    }

    fn curve(&mut self, subject: Subject<'_>) -> Result<Rc<Curve>, XtaskError> {
        let run = self.run(subject, Keep::Numbers)?;
        let steps = run.steps();
        let gradient = steps
            .iter()
            .map(|step| step.contact_stiffness.map_or(f64::NAN, f64::recip));
        let curve = Curve {
            force: steps.iter().map(|step| step.force).collect(),
            penetration: steps.iter().map(|step| step.penetration).collect(),
            max_pressure: steps.iter().map(|step| step.max_pressure).collect(),
            contact_area: steps.iter().map(|step| step.contact_area).collect(),
            gradient: gradient.collect(),
        };
        Ok(Rc::new(curve.checked()?))
    }
}

/// The case of the paper with this name.
fn case(name: &str) -> Result<PaperCase, ClaimsError> {
    let found = PaperCase::ALL.into_iter().find(|case| case.name() == name);
    found.ok_or_else(|| ClaimsError::Case {
        found: name.to_owned(),
    })
}

fn step<'a>(
    run: &'a PaperRun,
    subject: Subject<'_>,
) -> Result<&'a pellicle_cli::output::summary::StepSummary, ClaimsError> {
    let missing = || wrong(subject, format!("it has no step {}", subject.step));
    run.steps().get(subject.step).ok_or_else(missing)
}

fn contact_fields(run: &PaperRun, subject: Subject<'_>) -> Result<ContactFields, XtaskError> {
    let penetration = step(run, subject)?.penetration;
    let stored = run.fields(subject.step)?;
    let fields = stored.fields(run.side());
    // g = u + w* + f − f* − D
    let indenter = (0..fields.pressure.len()).map(|i| {
        fields.gap[i] - fields.displacement[i] - fields.shortening[i]
            + fields.profile[i]
            + penetration
    });
    let contact = ContactFields {
        elements: fields.size,
        side: fields.side,
        pressure: fields.pressure.to_vec(),
        displacement: fields.displacement.to_vec(),
        indenter: indenter.collect(),
        relief: fields.mask.to_vec(),
    };
    Ok(contact.checked()?)
}

/// Springs and a half-space of the top layer's material are equally compliant at the wavenumber k where
/// `η = 2/(E* k)`, `E* = E1/(1 − ν1²)`, so their length is `1/k = η E*/2`.
fn spring_length(run: &PaperRun, subject: Subject<'_>) -> Result<f64, ClaimsError> {
    let case = &run.record.case;
    let layer = &case["foundation"]["layer"][0];
    let [young, poisson] =
        ["young_modulus", "poisson_ratio"].map(|key| number(&layer[key], subject, key));
    let springs = number(&case["surface"]["young_modulus"], subject, "young_modulus")?;
    let height = run.record.relief_height();
    let height = height.ok_or_else(|| wrong(subject, "its relief has no one height".to_owned()))?;
    Ok(height / springs * young? / (1.0 - poisson?.powi(2)) / 2.0)
}

fn number(value: &Value, subject: Subject<'_>, key: &str) -> Result<f64, ClaimsError> {
    let missing = || wrong(subject, format!("its case has no number `{key}`"));
    value.as_f64().ok_or_else(missing)
}

fn wrong(subject: Subject<'_>, problem: String) -> ClaimsError {
    ClaimsError::Result {
        case: subject.case.to_owned(),
        elements: subject.elements,
        problem,
    }
}
