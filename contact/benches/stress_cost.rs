//! What stresses and critical loads cost beside the contact, in CPU time on one thread: 24 cases on 64 × 64 elements
//! and three on 512 × 512. `cargo bench -p pellicle-contact --bench stress_cost` prints a line a case and the sums.

#![expect(clippy::print_stdout, reason = "criterion has no ratios")]

use std::hint::black_box;
use std::sync::Arc;
use std::time::Instant;

use pellicle_contact::{
    BodyPart, BodyStrengths, Cone, Domain, Indenter, InterfacePart, InterfaceStrengths, Load,
    LoadingPath, Model, Paraboloid, Sliding, SolverOptions, Sphere, StressExtremes, StressModel,
    critical_loads, solve_path, stress_extremes,
};
use pellicle_influence::{Cache, RadialTables};
use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};
use pellicle_texture::Relief;
use rayon::ThreadPoolBuilder;

/// Part of the largest stress at which a strength is reached.
const PART: f64 = 0.7;

/// CPU time of this thread in s; on systems other than Linux, time.
fn now(start: Instant) -> f64 {
    let times = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = times.and_then(|times| times.split(' ').next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(|| start.elapsed().as_secs_f64(), |time| time / 1e9)
}

/// The mean CPU time of a function over this many seconds, and its last result.
fn timed<T>(seconds: f64, mut function: impl FnMut() -> T) -> (f64, T) {
    let start = Instant::now();
    let before = now(start);
    let mut count = 0.0;
    loop {
        let result = black_box(function());
        count += 1.0;
        let time = now(start) - before;
        if time > seconds {
            return (time / count, result);
        }
    }
}

/// A body of up to three layers, 1 stiff.
fn foundation(layers: usize) -> Foundation {
    let material = |modulus, ratio| Material::new(modulus, ratio).expect("a material");
    let of = [(0.03, 2.0, 0.2), (0.05, 0.7, 0.35), (0.02, 4.0, 0.25)];
    let layers = of[..layers].iter().map(|(thickness, modulus, ratio)| {
        Layer::new(*thickness, material(*modulus, *ratio), Interface::Bonded).expect("a layer")
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
            direction: 0.3 * friction,
        },
        bodies: bodies.collect(),
        interfaces: interfaces.collect(),
        ..StressModel::default()
    }
}

/// Two strengths of the first body and two of the last, or of the first interface: up to four.
fn strengthen(stress: &mut StressModel, found: &StressExtremes) -> usize {
    let mut count = 0;
    let mut some = |value: f64| {
        count += usize::from(value > 0.0);
        (value > 0.0).then_some(PART * value)
    };
    let first = &found.bodies[0];
    stress.bodies[0].strengths = BodyStrengths {
        yield_strength: some(first.max_von_mises.expect("wanted").value),
        tensile_strength: some(first.max_principal.expect("wanted").value),
    };
    if let (Some(interface), Some(of)) = (stress.interfaces.first_mut(), found.interfaces.first()) {
        interface.strengths.shear_strength = some(of.max_shear_traction.expect("wanted").value);
        let last = found.bodies.len() - 1;
        let of = &found.bodies[last];
        stress.bodies[last].strengths.yield_strength =
            some(of.max_von_mises.expect("wanted").value);
    }
    count
}

/// CPU times of the contact, the extremes and four critical loads.
fn case(index: usize, elements: usize, seconds: f64) -> [f64; 3] {
    let foundation = foundation(index % 4);
    let friction = [0.0, 0.1, 0.3, 0.5, 0.0, 0.2][index / 4];
    let indenter = match index % 3 {
        0 => Indenter::from(Paraboloid::new(1.0).expect("an indenter")),
        1 => Indenter::from(Cone::new(1.45, 0.0).expect("an indenter")),
        _ => Indenter::from(Sphere::new(1.0).expect("an indenter")),
    };
    let model = Model {
        tables: Arc::new(RadialTables::build(&foundation).expect("tables")),
        relief: Relief::Bare,
        indenter,
        cache: Cache::in_memory(),
    };
    let options = SolverOptions {
        coarse_pressures: true,
        ..SolverOptions::default()
    };
    let load = [Load::Force(1e-3)];
    let solve = || -> LoadingPath {
        solve_path(
            &model,
            Domain::Automatic,
            elements,
            &load,
            &options,
            &mut (),
        )
        .expect("a solution")
    };
    let (contact, path) = timed(seconds, solve);
    let mut stress = stresses(&foundation, friction);
    let (extremes, found) = timed(seconds, || {
        stress_extremes(&path, 0, &stress).expect("extremes")
    });
    let count = strengthen(&mut stress, &found);
    let found = [found];
    let (critical, loads) = timed(seconds, || {
        let domain = Domain::Automatic;
        critical_loads(&model, &path, &found, domain, &options, &stress, &mut ()).expect("loads")
    });
    let met = loads.iter().filter(|load| load.force.is_some()).count();
    let four = critical * 4.0 / count as f64;
    println!(
        "{elements} layers {} friction {friction}: contact {:.2} ms, extremes {:.1} ({:.1}), four critical loads {:.1} ({:.1}), {met} of {count} met",
        index % 4,
        1e3 * contact,
        1e3 * extremes,
        extremes / contact,
        1e3 * four,
        four / contact
    );
    [contact, extremes, four]
}

fn main() {
    let pool = ThreadPoolBuilder::new()
        .num_threads(1)
        .build()
        .expect("a thread");
    pool.install(|| {
        for (elements, indices, seconds) in [(64, (0..24).collect(), 0.1), (512, vec![0, 6, 13], 0.3)] {
            let indices: Vec<usize> = indices;
            let mut sums = [0.0; 3];
            for index in indices {
                let times = case(index, elements, seconds);
                sums.iter_mut().zip(times).for_each(|(sum, time)| *sum += time);
            }
            let [contact, extremes, critical] = sums;
            println!(
                "{elements}: contact {contact:.3} s, extremes {:.1} times that, four critical loads {:.1} times",
                extremes / contact,
                critical / contact
            );
        }
    });
}
