//! Negative controls of the certificate: deliberately wrong pressures.

use pellicle_contact::{Certificate, DiscreteProblem, Load, Solution, SolverOptions};
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::{CylinderSpec, Cylinders, Lattice, Relief};

use crate::comparison::Comparison;
use crate::run::{ContactSetup, ValidationError, ValidationRun, paraboloid};
use crate::section::ValidationSection;

/// The section.
pub const SECTION: ValidationSection = ValidationSection {
    name: "The certificate's negative controls",
    source: "a solution of a textured contact, deliberately altered: the certificate must reject it",
    because: "the error is the worst line of the certificate, the tolerance the certificate's: here the error must exceed it",
    rows,
};

/// A small change, but a hundred times the certificate's tolerance.
const SMALL: f64 = 1e-6;

/// A change that makes a correct pressure wrong.
type Alteration = fn(&mut Vec<f64>);

const ALTERATIONS: [(&str, Alteration); 8] = [
    ("all pressures larger by a millionth", |p| {
        p.iter_mut().for_each(|p| *p *= 1.0 + SMALL);
    }),
    ("one pressure larger by a millionth", |p| {
        let largest = largest(p);
        p[largest] *= 1.0 + SMALL;
    }),
    ("shifted by one element", |p| p.rotate_right(1)),
    ("two pressures exchanged", |p| {
        let (least, largest) = (least(p), largest(p));
        p.swap(least, largest);
    }),
    ("one element negative", |p| {
        let least = least(p);
        p[least] = -p[least];
    }),
    ("the least pressed element removed", |p| {
        let least = least(p);
        p[least] = 0.0;
    }),
    ("an element pressed far from the contact", |p| {
        p[0] = SMALL * p[largest(p)];
    }),
    ("one pressure NaN", |p| {
        let largest = largest(p);
        p[largest] = f64::NAN;
    }),
];

fn rows(run: ValidationRun) -> Result<Vec<Comparison>, ValidationError> {
    let contact = textured()?;
    let right = run.solve(&contact)?.steps.remove(0).solution.pressure;
    let mut judge = Judge::new(run, &contact)?;
    let mut rows = vec![Comparison::accepted(
        "as solved".into(),
        &judge.judge(right.clone()),
    )];
    for (check, alter) in ALTERATIONS {
        let mut wrong = right.clone();
        alter(&mut wrong);
        rows.push(Comparison::refused(check.into(), &judge.judge(wrong)));
    }
    let other_load = Load::Force(FORCE * (1.0 + SMALL));
    let found = judge.judge_under(other_load, right);
    rows.push(Comparison::refused(
        "for a force larger by a millionth".into(),
        &found,
    ));
    let perturbation = (1.0 + run.perturbation) * (1.0 + SMALL) - 1.0;
    let other_body = ValidationRun { perturbation }
        .solve(&contact)?
        .steps
        .remove(0)
        .solution;
    let found = judge.judge(other_body.pressure);
    rows.push(Comparison::refused(
        "for coefficients larger by a millionth".into(),
        &found,
    ));
    let options = SolverOptions {
        tolerance: 1e-4,
        ..SolverOptions::default()
    };
    let loose = run.solve_with(&contact, options)?.steps.remove(0).solution;
    rows.push(Comparison::refused(
        "solved to 1e-4 only".into(),
        &judge.judge(loose.pressure),
    ));
    Ok(rows)
}

/// Force on the contact.
const FORCE: f64 = 2e-3;

/// A paraboloid on the paper's stiff coating with cylinders: islands of contact on 64 × 64 elements.
fn textured() -> Result<ContactSetup, ValidationError> {
    let spec = CylinderSpec {
        lattice: Lattice::Square,
        radius: 0.02,
        height: 2e-3,
        period: 0.05,
        offset: [0.0, 0.0],
        young_modulus: 10.0,
    };
    Ok(ContactSetup {
        foundation: Foundation::coated(0.05, Material::new(10.0, 0.3)?, Material::new(1.0, 0.4)?)?,
        relief: Relief::Cylinders(Cylinders::new(spec)?),
        indenter: paraboloid(1.0)?,
        side: 0.5,
        elements: 64,
        load: Load::Force(FORCE),
    })
}

/// Judges pressures with the certificate of a problem.
struct Judge {
    problem: DiscreteProblem,
    load: Load,
}

impl Judge {
    fn new(run: ValidationRun, contact: &ContactSetup) -> Result<Self, ValidationError> {
        let model = run.model(contact)?;
        let sampled = model.sample(contact.side, contact.elements)?;
        Ok(Self {
            problem: model.discretize(&sampled)?.value,
            load: contact.load,
        })
    }

    fn judge(&mut self, pressure: Vec<f64>) -> Certificate {
        self.judge_under(self.load, pressure)
    }

    fn judge_under(&mut self, load: Load, pressure: Vec<f64>) -> Certificate {
        let tolerance = SolverOptions::default().tolerance;
        Solution::judge(&mut self.problem, load, pressure, tolerance).certificate
    }
}

/// The element with the largest pressure.
fn largest(pressure: &[f64]) -> usize {
    let elements = 0..pressure.len();
    elements
        .max_by(|i, j| pressure[*i].total_cmp(&pressure[*j]))
        .unwrap_or(0)
}

/// The element with the smallest nonzero pressure.
fn least(pressure: &[f64]) -> usize {
    let pressed = (0..pressure.len()).filter(|i| pressure[*i] > 0.0);
    pressed
        .min_by(|i, j| pressure[*i].total_cmp(&pressure[*j]))
        .unwrap_or(0)
}
