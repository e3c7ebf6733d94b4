//! The time of stresses and critical loads for their counted work, in CPU time on one thread. `cargo bench -p
//! pellicle-contact --bench stress_forecast` prints the constants of the program's forecast, and how far the times of
//! these cases are from it. Some minutes.

#![expect(clippy::print_stdout, reason = "criterion fits no constants")]

use std::sync::Arc;
use std::time::Instant;

use pellicle_contact::{
    BodyPart, BodyStrengths, Domain, Indenter, InterfacePart, InterfaceStrengths, Load,
    LoadedElements, LoadingPath, Model, Paraboloid, SearchWork, Sliding, SolverOptions,
    StressModel, StressQuantity, critical_loads, critical_work, search_work, solve_path,
    stress_extremes,
};
use pellicle_influence::{Cache, RadialTables};
use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};
use pellicle_texture::Relief;
use rayon::ThreadPoolBuilder;

/// Part of the largest stress at which a strength is reached.
const PART: f64 = 0.7;
/// Steps of the fit of the constants; more change nothing.
const STEPS: usize = 20_000;

/// CPU time of this thread in s; on systems other than Linux, time.
fn now(start: Instant) -> f64 {
    let times = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = times.and_then(|times| times.split(' ').next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(|| start.elapsed().as_secs_f64(), |time| time / 1e9)
}

/// The CPU time of a function, and its result.
fn timed<T>(function: impl FnOnce() -> T) -> (f64, T) {
    let start = Instant::now();
    let before = now(start);
    let result = function();
    (now(start) - before, result)
}

/// A body of layers of a fiftieth to a twentieth of the contact's scale, alternately stiff and soft.
fn foundation(layers: usize) -> Foundation {
    let material = |modulus, ratio| Material::new(modulus, ratio).expect("a material");
    let of = [(0.03, 2.0, 0.2), (0.05, 0.7, 0.35), (0.02, 4.0, 0.25)];
    let layers = (0..layers).map(|i| {
        let (thickness, modulus, ratio) = of[i % 3];
        Layer::new(thickness, material(modulus, ratio), Interface::Bonded).expect("a layer")
    });
    Foundation::new(layers.collect(), Base::HalfSpace(material(1.0, 0.3))).expect("a foundation")
}

/// Bodies and interfaces of a foundation without strengths.
fn stresses(foundation: &Foundation, friction: f64) -> StressModel {
    let count = foundation.layers().len();
    let depth = |i: usize| match i {
        0 => 0.0,
        i if i > count => f64::INFINITY,
        i => foundation.interface_depth(i),
    };
    let bodies = (0..=count).map(|i| BodyPart {
        name: format!("body {i}"),
        top: depth(i),
        bottom: depth(i + 1),
        strengths: BodyStrengths::default(),
    });
    let interfaces = (0..count).map(|i| InterfacePart {
        index: i,
        depth: depth(i + 1),
        strengths: InterfaceStrengths::default(),
    });
    StressModel {
        sliding: Sliding {
            friction,
            direction: 0.0,
        },
        bodies: bodies.collect(),
        interfaces: interfaces.collect(),
        ..StressModel::default()
    }
}

/// Terms of the counted work, and the time that they take, s.
struct Sample<const TERMS: usize> {
    name: String,
    terms: [f64; TERMS],
    seconds: f64,
}

/// A solved case.
struct Solved {
    model: Model,
    path: LoadingPath,
    stress: StressModel,
    seconds: f64,
}

fn solved(layers: usize, elements: usize, friction: f64) -> Solved {
    let foundation = foundation(layers);
    let model = Model {
        tables: Arc::new(RadialTables::build(&foundation).expect("tables")),
        relief: Relief::Bare,
        indenter: Indenter::from(Paraboloid::new(1.0).expect("an indenter")),
        cache: Cache::in_memory(),
    };
    let options = SolverOptions {
        coarse_pressures: true,
        ..SolverOptions::default()
    };
    let load = [Load::Force(1e-3)];
    let (seconds, path) = timed(|| {
        let domain = Domain::Automatic;
        solve_path(&model, domain, elements, &load, &options, &mut ()).expect("a solution")
    });
    Solved {
        stress: stresses(&foundation, friction),
        model,
        path,
        seconds,
    }
}

/// The extremes of all stresses and of some only, and the contact.
fn extremes(case: &mut Solved, name: &str) -> Vec<Sample<{ SearchWork::TERMS }>> {
    let some = vec![StressQuantity::VonMises, StressQuantity::ShearTraction];
    let all = [None, Some(some)];
    let samples = all.map(|only| {
        let count = only
            .as_ref()
            .map_or("all".to_owned(), |of| of.len().to_string());
        case.stress.only = only;
        let (seconds, _) =
            timed(|| stress_extremes(&case.path, 0, &case.stress).expect("extremes"));
        Sample {
            name: format!("{name}, {count} stresses"),
            terms: search_work(
                &case.stress,
                LoadedElements::of_step(&case.path, 0, case.path.grid.size()),
            )
            .terms(),
            seconds,
        }
    });
    case.stress.only = None;
    samples.into()
}

/// Yield of the first body and shear of the first interface, or tension of the first body without one: the seconds that
/// one search for each would take, the elements of the grid for each, and the time.
fn critical(case: &mut Solved, name: &str, constants: &[f64; SearchWork::TERMS]) -> Sample<2> {
    let extremes = stress_extremes(&case.path, 0, &case.stress).expect("extremes");
    let part = |value: f64| (value > 0.0).then_some(PART * value);
    let first = &extremes.bodies[0];
    let mut strengths = BodyStrengths {
        yield_strength: first.max_von_mises.and_then(|found| part(found.value)),
        tensile_strength: None,
    };
    match (
        case.stress.interfaces.first_mut(),
        extremes.interfaces.first(),
    ) {
        (Some(interface), Some(of)) => {
            let shear = of.max_shear_traction;
            interface.strengths.shear_strength = shear.and_then(|found| part(found.value));
        }
        _ => strengths.tensile_strength = first.max_principal.and_then(|found| part(found.value)),
    }
    case.stress.bodies[0].strengths = strengths;
    let (model, domain, options) = (&case.model, Domain::Automatic, SolverOptions::default());
    let (seconds, _) = timed(|| {
        let (path, stress) = (&case.path, &case.stress);
        critical_loads(model, path, &[extremes], domain, &options, stress, &mut ()).expect("loads")
    });
    let works = critical_work(
        &case.stress,
        LoadedElements::of_step(&case.path, 0, case.path.grid.size()),
    );
    let searches = works.iter().map(|work| sum(&work.terms(), constants));
    Sample {
        name: format!("{name}, {} critical loads", works.len()),
        terms: [searches.sum(), works.len() as f64 * case.seconds],
        seconds,
    }
}

/// Products of the contact times elements of the grid, and the time.
fn contact(case: &Solved, name: &str) -> Sample<1> {
    let products = case.path.steps[0].work.operator_applications as f64;
    Sample {
        name: format!("{name}, contact"),
        terms: [products * case.path.grid.len() as f64],
        seconds: case.seconds,
    }
}

fn sum<const TERMS: usize>(terms: &[f64; TERMS], constants: &[f64; TERMS]) -> f64 {
    terms
        .iter()
        .zip(constants)
        .map(|(term, of)| term * of)
        .sum()
}

/// The constants, not negative, with the least sum of squares of the relative differences from these times, by descent
/// along each in turn.
fn fitted<const TERMS: usize>(samples: &[Sample<TERMS>]) -> [f64; TERMS] {
    let rows: Vec<[f64; TERMS]> = (samples.iter())
        .map(|sample| sample.terms.map(|term| term / sample.seconds))
        .collect();
    let mut constants = [0.0; TERMS];
    for step in 0..STEPS * TERMS {
        let i = step % TERMS;
        let square: f64 = rows.iter().map(|row| row[i] * row[i]).sum();
        if square > 0.0 {
            let slope: f64 = rows
                .iter()
                .map(|row| row[i] * (1.0 - sum(row, &constants)))
                .sum();
            constants[i] = (constants[i] + slope / square).max(0.0);
        }
    }
    balanced(samples, constants)
}

/// The constants times the factor with which the largest and the smallest ratio of forecast to time are as far from 1.
fn balanced<const TERMS: usize>(
    samples: &[Sample<TERMS>],
    constants: [f64; TERMS],
) -> [f64; TERMS] {
    let ratios = samples.iter();
    let ratios = ratios.map(|sample| sum(&sample.terms, &constants) / sample.seconds);
    let [least, most] = ratios.fold([f64::INFINITY, 0.0_f64], |[least, most], ratio| {
        [least.min(ratio), most.max(ratio)]
    });
    constants.map(|of| of / (least * most).sqrt())
}

/// Prints the constants and the ratio of forecast to time of every case.
fn report<const TERMS: usize>(what: &str, samples: &[Sample<TERMS>], constants: [f64; TERMS]) {
    let mut extent = [f64::INFINITY, 0.0];
    for sample in samples {
        let ratio = sum(&sample.terms, &constants) / sample.seconds;
        extent = [extent[0].min(ratio), extent[1].max(ratio)];
        println!(
            "{}: {:.3} s, forecast {ratio:.2} of it",
            sample.name, sample.seconds
        );
    }
    println!(
        "{what}: {}, within {:.2} to {:.2} of {} cases\n",
        constants.map(|of| format!("{of:.2e}")).join(", "),
        extent[0],
        extent[1],
        samples.len()
    );
}

fn main() {
    let pool = ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("a thread");
    pool.install(|| {
        let (mut of_critical, mut of_contacts) = (Vec::new(), Vec::new());
        for friction in [0.0, 0.3] {
            let (mut samples, mut cases) = (Vec::new(), Vec::new());
            for elements in [64, 128, 256, 512, 1024] {
                for layers in [0, 1, 3, 8] {
                    let name = format!("{elements} elements, {layers} layers, friction {friction}");
                    let mut case = solved(layers, elements, friction);
                    samples.extend(extremes(&mut case, &name));
                    // A contact shorter than a tick of the clock tells nothing.
                    let of_contact = contact(&case, &name);
                    of_contacts.extend(Some(of_contact).filter(|sample| sample.seconds > 0.0));
                    if elements <= 256 {
                        cases.push((case, name));
                    }
                }
            }
            let constants = fitted(&samples);
            report(
                &format!("extremes, friction {friction}"),
                &samples,
                constants,
            );
            let cases = cases.iter_mut();
            of_critical.extend(cases.map(|(case, name)| critical(case, name, &constants)));
        }
        let constants = fitted(&of_critical);
        report("critical loads", &of_critical, constants);
        let constants = fitted(&of_contacts);
        report("a product for each element", &of_contacts, constants);
    });
}
