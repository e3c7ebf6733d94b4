//! The iteration: its fields, which outlive it, and the steps of each phase.

use crate::{
    ContactError, DiscreteProblem, Load,
    solver::{
        Shortcuts, Watch,
        gradient::{
            best_pressure::BestPressure,
            load_control::LoadControl,
            preconditioner::Preconditioner,
            springs::Springs,
            state::State,
            steps::{
                Context,
                conjugate::ConjugateSteps,
                face::FaceDescent,
                newton::Newton,
                outcome::StepOutcome,
                segment::Segment,
                spectral::SpectralSteps,
                stiffness::{Wanted, pressure_sum_per_penetration},
            },
            strategy::{Phase, Strategy},
            working_set::WorkingSet,
        },
    },
    vector::{add_scaled, each, update_with},
};

/// All fields of an iteration, allocated once for all loads on one problem.
pub struct Fields {
    state: State,
    set: WorkingSet,
    best: BestPressure,
    preconditioner: Preconditioner,
    segment: Segment,
    steps: Steps,
    /// None for linear springs.
    springs: Option<Springs>,
}

/// The memory of each kind of step.
struct Steps {
    spectral: SpectralSteps,
    conjugate: ConjugateSteps,
    newton: Option<Newton>,
    faces: Option<FaceDescent>,
}

impl Fields {
    pub fn new(problem: &DiscreteProblem, shortcuts: Shortcuts) -> Self {
        Self {
            state: State::new(problem),
            set: WorkingSet::new(problem.elements()),
            best: BestPressure::new(),
            preconditioner: Preconditioner::new(problem, shortcuts),
            segment: Segment::new(problem.elements()),
            steps: Steps {
                spectral: SpectralSteps::new(problem.elements()),
                conjugate: ConjugateSteps::new(problem.elements()),
                newton: None,
                faces: None,
            },
            springs: Springs::of(problem),
        }
    }

    /// The context of the steps, and their memory.
    fn on<'a>(&'a mut self, problem: &'a mut DiscreteProblem) -> (Context<'a>, &'a mut Steps) {
        let context = Context {
            problem,
            state: &mut self.state,
            set: &mut self.set,
            preconditioner: &mut self.preconditioner,
            segment: &mut self.segment,
        };
        (context, &mut self.steps)
    }

    /// Discards the memory of all steps so far.
    fn restart(&mut self) {
        self.preconditioner.restart();
        self.steps.spectral.restart();
        self.steps.conjugate.restart();
        if let Some(newton) = &mut self.steps.newton {
            newton.restart();
        }
    }
}

/// The assessment of the current pressure.
#[derive(Debug, Clone, Copy)]
pub struct Judgement {
    /// The largest line of the certificate.
    pub residual: f64,
    /// The same for the linear problem; it differs if nonlinear springs have been linearised.
    pub linear: f64,
    /// Whether no element pulls.
    pub is_admissible: bool,
}

/// The iteration for one load.
pub struct Iteration<'a> {
    problem: &'a mut DiscreteProblem,
    fields: Box<Fields>,
    /// Whether the last step kept the set, so that the next may be conjugate to it.
    keeps_set: bool,
    /// The residual of the current pressure.
    residual: f64,
    begins_with_newton: bool,
}

impl<'a> Iteration<'a> {
    /// Begins a load from a pressure (Pa), independently of the previous load: one product.
    pub fn begin(
        problem: &'a mut DiscreteProblem,
        mut fields: Box<Fields>,
        load: Load,
        start: &[f64],
    ) -> Self {
        let control = LoadControl::of(problem, load);
        fields.preconditioner.begin();
        fields.restart();
        fields.best.restart();
        fields.state.start(problem, control, start);
        if let Some(springs) = &mut fields.springs {
            springs.linearise_here(problem, &mut fields.state);
            fields.preconditioner.follow_springs(problem);
        }
        fields.set.start(&mut fields.state);
        // A zero start presses everywhere; from there the fast steps find the contact sooner.
        let has_contact = start.iter().any(|p| *p > 0.0);
        let begins_with_newton = has_contact && fields.preconditioner.is_for_newton();
        if begins_with_newton {
            // Overlaps outside the start's contact are as uncertain as its pressures.
            fields.set.keep_pressing(&mut fields.state);
        }
        Self {
            problem,
            fields,
            keeps_set: false,
            residual: f64::INFINITY,
            begins_with_newton,
        }
    }

    /// Assesses the current pressure by the running residual, and keeps it if it is admissible and the best so far.
    pub fn judge(&mut self) -> Judgement {
        let Fields {
            state,
            best,
            springs,
            ..
        } = &mut *self.fields;
        let (linear, is_admissible) = state.residual();
        let residual = match springs {
            Some(springs) if is_admissible => springs.residual(self.problem, state),
            _ => linear,
        };
        if is_admissible {
            best.offer(state, residual);
        }
        self.residual = residual;
        Judgement {
            residual,
            linear,
            is_admissible,
        }
    }

    /// Linearises nonlinear springs again if the residual by their law clearly exceeds that of the linear problem.
    /// Returns whether it did. No product.
    pub fn linearise(&mut self, judgement: &Judgement, phase: Phase) -> bool {
        let Fields { state, springs, .. } = &mut *self.fields;
        let Some(springs) = springs else {
            return false;
        };
        if !judgement.is_admissible
            || !Springs::need_linearising(judgement.linear, judgement.residual)
        {
            return false;
        }
        springs.linearise(self.problem, state);
        self.begin_on_tangents();
        let Fields {
            state, set, steps, ..
        } = &mut *self.fields;
        match (phase, &mut steps.faces) {
            (Phase::Fast, _) => set.update(state),
            (Phase::Descent, Some(faces)) => faces.begin(state),
            _ => (),
        }
        true
    }

    /// Discards everything that depends on the previous linearisation of the springs.
    fn begin_on_tangents(&mut self) {
        self.keeps_set = false;
        self.fields.restart();
        let preconditioner = &mut self.fields.preconditioner;
        preconditioner.follow_springs(self.problem);
    }

    /// Reports progress to the observer; an error if the observer cancels.
    pub fn report(
        &mut self,
        watch: &mut Watch<'_>,
        iteration: usize,
        residual: f64,
    ) -> Result<(), ContactError> {
        let set = &mut self.fields.set;
        let (weight, grid) = (self.problem.support().weight(), self.problem.region());
        let working_set = [set.len(), set.take_moves()].map(|elements| weight * elements);
        watch.tell(grid.grid_size(), iteration, residual, working_set)
    }

    /// Whether the contact reaches the border of its support.
    pub fn reaches_border(&self) -> bool {
        let border = self.problem.support().border();
        self.fields.set.holds_any(border)
    }

    /// Products with `K` so far.
    pub fn applications(&self) -> usize {
        self.fields.state.applications()
    }

    /// Whether the preconditioner knows the operator.
    pub fn knows_operator(&self) -> bool {
        self.fields.preconditioner.knows_operator()
    }

    /// Whether the load begins with Newton's method.
    pub fn begins_with_newton(&self) -> bool {
        self.begins_with_newton
    }

    /// The number of fast steps that are cut in succession before they give way.
    pub fn most_cuts(&self) -> usize {
        self.fields.preconditioner.most_cuts()
    }

    /// Takes a conjugate step if the set has not changed, else a spectral one.
    pub fn fast_step(&mut self) -> StepOutcome {
        let (mut context, steps) = self.fields.on(self.problem);
        let Steps {
            spectral,
            conjugate,
            ..
        } = steps;
        let outcome = if context.set.is_unchanged() && self.keeps_set {
            spectral.forget_direction();
            let outcome = conjugate.step_within(&mut context);
            self.keeps_set = outcome == StepOutcome::Free;
            outcome
        } else {
            conjugate.restart();
            self.keeps_set = true;
            spectral.step(&mut context)
        };
        context.set.update(context.state);
        outcome
    }

    /// Takes a step of the linear system on the set, or exchanges elements.
    pub fn newton_step(&mut self, tolerance: f64) -> StepOutcome {
        let (mut context, steps) = self.fields.on(self.problem);
        let elements = context.state.elements();
        let newton = steps.newton.get_or_insert_with(|| Newton::new(elements));
        newton.step(&mut context, tolerance)
    }

    /// Takes a step of the linear system on the face, or goes to the next face.
    pub fn face_step(&mut self) -> StepOutcome {
        let (mut context, steps) = self.fields.on(self.problem);
        if let Some(faces) = &mut steps.faces {
            faces.step(&mut context);
        }
        StepOutcome::Free
    }

    /// Prepares the new phase.
    pub fn begin_phase(&mut self, strategy: &mut Strategy) {
        let failures = match strategy.phase() {
            Phase::Fast | Phase::Newton(0) => 0,
            Phase::Newton(_) | Phase::Descent => 1,
        };
        let (context, steps) = self.fields.on(self.problem);
        let is_known = (context.preconditioner).prepare_for_newton(context.problem, failures);
        if !is_known {
            strategy.descend();
        }
        if strategy.phase() == Phase::Descent {
            self.begin_descent();
        } else if let Some(newton) = &mut steps.newton {
            newton.restart();
        }
    }

    /// Returns to the best admissible pressure and discards the memory of all steps: one product.
    pub fn begin_descent(&mut self) {
        self.keeps_set = false;
        self.fields.restart();
        let (residual, _) = self.fields.state.residual();
        let Fields { best, state, .. } = &mut *self.fields;
        let pressure = best.or(state, residual).to_vec();
        let (context, steps) = self.fields.on(self.problem);
        context.state.press_anywhere();
        context.state.pressure.copy_from_slice(&pressure);
        context.state.clip(context.problem);
        context.set.update(context.state);
        let elements = context.state.elements();
        let faces = steps
            .faces
            .get_or_insert_with(|| FaceDescent::new(elements));
        faces.begin(context.state);
    }

    /// `dQ/dD` (N/m) on the elements that press, and the products taken; none if no element presses.
    pub fn contact_stiffness(&mut self) -> (Option<f64>, usize) {
        let Fields { state, springs, .. } = &mut *self.fields;
        if let Some(springs) = springs {
            springs.linearise_here(self.problem, state);
            self.begin_on_tangents();
        }
        let (mut context, steps) = self.fields.on(self.problem);
        context.set.keep_pressing(context.state);
        if context.set.len() == 0 {
            return (None, 0);
        }
        let (sum, applications) =
            pressure_sum_per_penetration(&mut context, &mut steps.conjugate, Wanted::Sum);
        let per_sum = self.problem.loaded_area() / self.problem.scale().compliance;
        (sum.map(|sum| sum * per_sum), applications)
    }

    /// `dp/dD` (Pa/m) on the elements that press, 0 elsewhere; none if no element presses or if the system does not
    /// converge even with the sparse factor.
    pub fn pressure_per_penetration(&mut self) -> Option<Vec<f64>> {
        let unit = self.problem.scale().compliance;
        let (mut context, steps) = self.fields.on(self.problem);
        context.set.keep_pressing(context.state);
        if context.set.len() == 0 {
            return None;
        }
        let mut field = vec![0.0; context.state.elements()];
        for failures in 0..=1 {
            let conjugate = &mut steps.conjugate;
            let wanted = Wanted::Field(&mut field);
            if let (Some(_), _) = pressure_sum_per_penetration(&mut context, conjugate, wanted) {
                each(&mut field, |q| *q /= unit);
                return Some(field);
            }
            (context.preconditioner).prepare_for_newton(context.problem, 1 + failures);
        }
        None
    }

    /// The running penetration, in m.
    pub fn penetration(&self) -> f64 {
        self.problem.scale().length * self.fields.state.penetration
    }

    /// The best pressure found, in Pa.
    pub fn best_pressure(&self) -> Vec<f64> {
        let Fields { state, best, .. } = &*self.fields;
        let mut pressure = best.or(state, self.residual).to_vec();
        let unit = self.problem.scale().pressure();
        each(&mut pressure, |p| *p *= unit);
        pressure
    }

    /// `K p` of the [best pressure](Self::best_pressure), in m, everywhere: `v − g0 − η p`. Only for a problem with a
    /// hardness, and if it is known without a product.
    pub fn displacement(&self) -> Option<Vec<f64>> {
        let Fields { state, best, .. } = &*self.fields;
        let is_at_best = std::ptr::eq(best.or(state, self.residual), state.pressure.as_slice());
        (self.problem.has_hardness() && is_at_best).then(|| {
            let scale = self.problem.scale();
            let mut displacement = state.v.clone();
            add_scaled(&mut displacement, -1.0, &state.initial_gap);
            each(&mut displacement, |u| *u *= scale.length);
            let unit = scale.pressure();
            let compliance = self.problem.springs().compliance();
            update_with(
                &mut displacement,
                &state.pressure,
                compliance,
                |u, p, eta| {
                    *u -= eta * (unit * p);
                },
            );
            displacement
        })
    }

    /// Returns the fields, for the next load on the same problem.
    pub fn into_fields(self) -> Box<Fields> {
        self.fields
    }
}
