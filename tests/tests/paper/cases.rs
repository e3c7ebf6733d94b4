//! The paper's cases and our own. Each is solved once per grid, for all tests that need it.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use pellicle_contact::{
    Domain, FlatPunch, Indenter, Load, LoadingPath, Model, Pyramid, SolverOptions, Step, solve_path,
};
use pellicle_kernel::Foundation;
use pellicle_tests::scene::{coated, cylinders, material, model, paraboloid};
use pellicle_texture::{Film, Relief};

/// Radius of the paper's cylinders, in units of the indenter's radius.
pub const RADIUS: f64 = 5e-3;
/// Height of the cylinders and thickness of the coating.
const HEIGHT: f64 = 1e-4;
/// Distance between neighbouring cylinders in Figs. 2 and 3.
pub const PERIOD: f64 = 1.0 / 80.0;

/// Forces of the curves of Fig. 4, in units of `1e-5 E1 R²` with the stiff coating's E1.
const LOADING: [f64; 18] = [
    0.02, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.3571, 0.45, 0.55, 0.7142, 0.9, 1.1, 1.3, 1.5, 1.7,
    1.9, 2.1426,
];
/// Forces of the curves of Fig. 6, in mN; the last is that of Fig. 5.
const INDENTATION: [f64; 19] = [
    0.01, 0.02, 0.04, 0.07, 0.1, 0.15, 0.2, 0.3, 0.4, 0.55, 0.7, 0.9, 1.1, 1.3, 1.5, 1.7, 1.9, 2.1,
    2.3,
];

/// The paper's two coatings.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Coating {
    /// Ten times softer than its base.
    Soft,
    /// Ten times stiffer than its base.
    Stiff,
}

/// A case file, or a modified one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum PaperCase {
    /// Fig. 2: soft coating, small load.
    Fig2a,
    /// Fig. 2(a) on a square just larger than the contact, with edges of the cylinders rounded by so many percent of
    /// their height.
    Rounded(u8),
    /// Fig. 2: stiff coating, small load.
    Fig2b,
    /// Fig. 2: soft coating, six times the load.
    Fig2c,
    /// Fig. 2: stiff coating, six times the load.
    Fig2d,
    /// Fig. 2(d) on a domain of eleven periods.
    WholePeriods,
    /// Fig. 3 according to its labels: both loads of the other coating.
    Labels(Coating),
    /// Fig. 4: the curve with this many periods per indenter radius.
    Curve(Coating, u8),
    /// Period R/80 at one to ten times the last load of Fig. 4.
    Beyond(Coating),
    /// Fig. 6: the pyramid's curve, with or without the film; its last load is that of Fig. 5.
    Berkovich {
        /// Whether the film is there.
        film: bool,
    },
    /// One cylinder under a flat punch of its own size.
    OneCylinder(Coating),
}

type Solved = Arc<OnceLock<Arc<LoadingPath>>>;

/// The certified path of a case; solved by the first test that needs it.
pub fn path(case: PaperCase, elements: usize) -> Arc<LoadingPath> {
    static SOLVED: Mutex<BTreeMap<(PaperCase, usize), Solved>> = Mutex::new(BTreeMap::new());
    let solved = Arc::clone(
        SOLVED
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
            .entry((case, elements))
            .or_default(),
    );
    Arc::clone(solved.get_or_init(|| {
        let (model, domain, loads) = case.posed();
        let options = SolverOptions::default();
        let path = solve_path(&model, domain, elements, &loads, &options, &mut ());
        let path = path.expect("a solution");
        for step in &path.steps {
            let certificate = &step.solution.certificate;
            assert!(certificate.is_satisfied(), "{case:?}: {certificate:?}");
        }
        Arc::new(path)
    }))
}

/// The only step of a case with one load.
pub fn only_step(case: PaperCase, elements: usize) -> Step {
    path(case, elements).steps[0].clone()
}

impl PaperCase {
    /// The model, its domain and its loads.
    fn posed(self) -> (Model, Domain, Vec<Load>) {
        let [soft, stiff] = [Coating::Soft, Coating::Stiff];
        match self {
            Self::Fig2a => textured(soft, 1.0, 80, 0.08, &[0.3571e-4]),
            Self::Rounded(percent) => rounded(percent),
            Self::Fig2b => textured(stiff, 1.0, 80, 0.08, &[0.3571e-5]),
            Self::Fig2c => textured(soft, 1.0, 80, 0.12, &[2.1426e-4]),
            Self::Fig2d => textured(stiff, 1.0, 80, 0.14, &[2.1426e-5]),
            Self::WholePeriods => textured(stiff, 1.0, 80, 0.1375, &[2.1426e-5]),
            Self::Labels(Coating::Soft) => textured(soft, 1.0, 80, 0.08, &[0.3571e-5, 2.1426e-5]),
            Self::Labels(Coating::Stiff) => textured(stiff, 1.0, 80, 0.3, &[0.3571e-4, 2.1426e-4]),
            Self::Curve(coating, periods) => {
                let side = [0.08, 0.14][coating as usize];
                textured(
                    coating,
                    of_stiff(coating),
                    periods,
                    side,
                    &LOADING.map(|q| q * 1e-5),
                )
            }
            Self::Beyond(coating) => {
                let side = [0.18, 0.32][coating as usize];
                let forces =
                    [0, 1, 2, 3, 4, 5, 6].map(|i| 2.1426e-5 * 10_f64.powf(f64::from(i) / 6.0));
                textured(coating, of_stiff(coating), 80, side, &forces)
            }
            Self::Berkovich { film } => berkovich(film),
            Self::OneCylinder(coating) => one_cylinder(coating),
        }
    }
}

/// The coating's modulus in units of the stiff coating's, as used in Fig. 4 for both.
fn of_stiff(coating: Coating) -> f64 {
    [0.1, 1.0][coating as usize]
}

/// The coated body with this modulus of its coating.
fn body(coating: Coating, young_modulus: f64) -> Foundation {
    let (poisson_ratio, base) = match coating {
        Coating::Soft => (0.4, material(10.0 * young_modulus, 0.3)),
        Coating::Stiff => (0.3, material(0.1 * young_modulus, 0.4)),
    };
    coated(HEIGHT, material(young_modulus, poisson_ratio), base)
}

/// A paraboloid on cylinders of the coating's own material.
fn textured(
    coating: Coating,
    young_modulus: f64,
    periods: u8,
    side: f64,
    forces: &[f64],
) -> (Model, Domain, Vec<Load>) {
    let relief = cylinders(RADIUS, HEIGHT, 1.0 / f64::from(periods), young_modulus);
    let model = model(&body(coating, young_modulus), relief, paraboloid(1.0));
    let loads = forces.iter().copied().map(Load::Force).collect();
    (model, Domain::Side(side), loads)
}

/// Fig. 2(a) with rounded cylinders.
fn rounded(percent: u8) -> (Model, Domain, Vec<Load>) {
    let (mut model, domain, loads) = textured(Coating::Soft, 1.0, 80, 0.034, &[0.3571e-4]);
    if let Relief::Cylinders(cylinders) = model.relief {
        let rounded = cylinders.rounded(f64::from(percent) / 100.0 * HEIGHT);
        model.relief = Relief::Cylinders(rounded.expect("at most the height"));
    }
    (model, domain, loads)
}

/// A Berkovich pyramid with a tip radius of 400 nm on the stiff coating of 10 nm, in SI units.
fn berkovich(film: bool) -> (Model, Domain, Vec<Load>) {
    let body = coated(10e-9, material(70e9, 0.3), material(7e9, 0.4));
    let relief = if film {
        Relief::Film(Film::new(5e-9, 0.14e9).expect("a film"))
    } else {
        Relief::Bare
    };
    let indenter = Indenter::Pyramid(Pyramid::berkovich(400e-9).expect("a pyramid"));
    let loads = INDENTATION.map(|q| Load::Force(q * 1e-3)).to_vec();
    (model(&body, relief, indenter), Domain::Automatic, loads)
}

/// A flat punch of a cylinder's radius on a film of the cylinders' compliance.
fn one_cylinder(coating: Coating) -> (Model, Domain, Vec<Load>) {
    let relief = Relief::Film(Film::new(HEIGHT, 1.0).expect("a film"));
    let indenter = Indenter::FlatPunch(FlatPunch::new(RADIUS).expect("a punch"));
    let model = model(&body(coating, 1.0), relief, indenter);
    (model, Domain::Side(0.0105), vec![Load::Penetration(1e-4)])
}

/// `ℓ = η E1 / (2 (1 − ν1²))`, below which springs of compliance `η = h/E1` are the more compliant: half the cylinders'
/// height over `1 − ν1²`.
pub fn spring_length(coating: Coating) -> f64 {
    let poisson_ratio: f64 = [0.4, 0.3][coating as usize];
    HEIGHT / (1.0 - poisson_ratio.powi(2)) / 2.0
}
