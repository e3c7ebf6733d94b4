//! The time and memory of stresses and critical loads, from the counted work of their searches.
//!
//! All constants of time are here. `cargo bench -p pellicle-contact --bench stress_forecast` measures them anew, in
//! some four minutes of CPU time: it prints them in the order in which they stand below, and how well they describe 80
//! searches and 24 pairs of critical loads.

use std::time::Duration;

use pellicle_contact::{LoadedElements, LoadingPath, SearchWork, critical_work, search_work};

use crate::case::Case;
use crate::case::stress::StressCase;

/// CPU time of each [term](SearchWork::terms) of a search, s, without and with friction. *Measured* on 0 to 8 layers,
/// 64 to 1024 elements per side, all stresses and two of them, before the search became two to three times faster, then
/// scaled as a whole: on six runs of one and eight layers, 256 to 1024 elements, forecasts are 0.9 to 1.8 times the
/// time. The terms in layers are of graded layers, 102 to 652 in all, on 64 × 64 elements, with and without friction:
/// they are 0.75 to 0.85 of the time.
const SECONDS: [[f64; SearchWork::TERMS]; 2] = [
    [0.0, 1.2e-4, 4.7e-8, 3.0e-3, 1.2e-4, 1.1e-7, 2.3e-6],
    [0.0, 1.2e-4, 1.1e-7, 2.9e-3, 1.2e-4, 2.4e-7, 4.0e-6],
];

/// CPU time of a critical load: in searches of the whole body for its stress, and in solutions of the contact.
/// *Measured* as above, up to 256 elements per side, within a factor of about two. They are lowest for one layer under
/// sliding, where the peak is at the surface.
const PER_CRITICAL_LOAD: [f64; 2] = [1.5, 6.4];

/// CPU time of a product with `K` for each element of the grid, s, on a quadrant: an estimate.
const SECONDS_PER_PRODUCT: f64 = 3e-8;

/// Memory of the functions of the distance of a plane or a peak in a layered body, bytes: of each, and of each for
/// every layer. *Measured* as the largest resident sets on 64 × 64 elements: of 2 and 8 layers 26 and 55 MB, of 102 to
/// 652 sublayers of graded ones 113 to 683 MB, a run without stresses 17 MB.
const BYTES_OF_FUNCTIONS: [f64; 2] = [2.5e5, 2.5e4];

/// Memory of a place on a plane that is kept, and of one on the plane under computation, bytes.
const BYTES_PER_PLACE: [f64; 2] = [24.0, 150.0];

/// What the stresses of a case cost beside its contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StressCost {
    /// CPU time of the extremes of all steps.
    pub extremes: Duration,
    /// CPU time of all critical loads; none without a strength.
    pub critical: Option<Duration>,
    /// Memory of one search, bytes.
    pub bytes: f64,
}

impl StressCost {
    /// Forecasts the cost of a case from a trial of its smallest and its largest load; `products` is the number of
    /// products with `K` in a solution. None without stresses.
    #[must_use]
    pub fn of(case: &Case, trial: &LoadingPath, products: f64) -> Option<Self> {
        let stress = case.stress.as_ref()?;
        let each = stress.body.each().iter();
        let costs = each.map(|body| Self::inside(case, &stress.inside(*body), trial, products));
        costs.reduce(Self::and)
    }

    /// The cost of the one body and then of the other.
    fn and(self, other: Self) -> Self {
        let critical = [self.critical, other.critical].into_iter().flatten();
        Self {
            extremes: self.extremes + other.extremes,
            critical: critical.reduce(|one, other| one + other),
            bytes: self.bytes.max(other.bytes),
        }
    }

    /// The cost of the stresses in one body.
    fn inside(case: &Case, stress: &StressCase, trial: &LoadingPath, products: f64) -> Self {
        let trial = &trial.seen_from(stress.body.into());
        let body = stress.body.of(&case.foundation, Some(&case.indenter));
        let model = stress.model(&body, trial.tables.foundation());
        let slides = usize::from(stress.friction > 0.0);
        let elements = case.grid.elements;
        let loaded: Vec<LoadedElements> = (0..trial.steps.len())
            .map(|step| LoadedElements::of_step(trial, step, elements))
            .collect();
        let works = loaded.iter().map(|loaded| search_work(&model, *loaded));
        let works: Vec<SearchWork> = works.collect();
        let each: f64 = works.iter().map(|work| seconds(work, slides)).sum();
        let mean = each / works.len().max(1) as f64;
        let of_loads = loaded
            .last()
            .map_or_else(Vec::new, |loaded| critical_work(&model, *loaded));
        let [searches, solutions] = PER_CRITICAL_LOAD;
        let solution = SECONDS_PER_PRODUCT * products * (elements as f64).powi(2);
        let critical: f64 = (of_loads.iter())
            .map(|work| searches * seconds(work, slides) + solutions * solution)
            .sum();
        let bytes = works.iter().map(bytes);
        Self {
            extremes: duration(mean * case.steps() as f64),
            critical: (!of_loads.is_empty() && case.wear.is_none()).then(|| duration(critical)),
            bytes: bytes.fold(0.0, f64::max),
        }
    }

    /// CPU time of all of it.
    #[must_use]
    pub fn total(&self) -> Duration {
        self.extremes + self.critical.unwrap_or_default()
    }
}

fn seconds(work: &SearchWork, slides: usize) -> f64 {
    let terms = work.terms().into_iter().zip(SECONDS[slides]);
    terms.map(|(term, seconds)| term * seconds).sum()
}

fn bytes(work: &SearchWork) -> f64 {
    let [kept, computed] = BYTES_PER_PLACE;
    let [each, in_layer] = BYTES_OF_FUNCTIONS;
    let in_layers = work.planes_in_layers + work.peaks_in_layers;
    let functions = if in_layers > 0.0 {
        each * (work.planes + work.peaks) + in_layer * in_layers
    } else {
        0.0
    };
    functions + kept * work.kept + computed * work.largest_plane
}

/// A duration of these seconds; the longest one if they are too many.
fn duration(seconds: f64) -> Duration {
    Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX)
}

#[cfg(test)]
mod tests {
    use std::path::Path;
    use std::sync::Arc;

    use pellicle_influence::Cache;

    use super::*;
    use crate::forecast::Forecast;
    use crate::input::span::Source;

    fn cost(more: &str, sets: &[&str]) -> Option<StressCost> {
        let text = format!(
            "[foundation]\nsubstrate = {{ young_modulus = 1, poisson_ratio = 0.3 }}\n\
             layer = [{{ thickness = 0.02, young_modulus = 2, poisson_ratio = 0.3 }}]\n\
             [indenter]\nkind = \"paraboloid\"\nradius = 1\n[load]\nforces = [1e-3, 1e-3, 1e-3]\n{more}"
        );
        let source = Arc::new(Source::new("case.toml", text));
        let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
        let case = Case::parse(&source, "case", Path::new(""), &sets).unwrap();
        let model = case.model(&Cache::in_memory()).unwrap().value;
        Forecast::new(&case, &model).stress
    }

    #[test]
    fn stresses_cost_by_what_is_asked_for() {
        assert_eq!(cost("", &[]), None);
        let all = cost("[stress]", &[]).unwrap();
        assert_eq!((all.critical, all.total()), (None, all.extremes));
        let only = cost("[stress]\nonly = [\"max_von_mises\"]", &[]).unwrap();
        assert!(3 * only.extremes < all.extremes, "{only:?} {all:?}");
        assert!(only.bytes < all.bytes);
        // Each step is searched.
        let one = cost("[stress]", &["load.forces=[1e-3]"]).unwrap();
        let ratio = all.extremes.as_secs_f64() / one.extremes.as_secs_f64();
        assert!((ratio - 3.0).abs() < 1e-3, "{ratio}");
        let strong = cost("[stress]", &["foundation.layer.0.yield_strength=1"]).unwrap();
        assert!(strong.critical.is_some() && strong.total() > strong.extremes);
        let modulus =
            "foundation.layer.0.young_modulus={ from = 2, to = 200, profile = \"linear\" }";
        let graded = cost("[stress]", &[modulus]).unwrap();
        assert!(graded.bytes > 4.0 * all.bytes && graded.extremes > 4 * all.extremes);
        let fine = cost("[stress]", &["grid.elements=1024"]).unwrap();
        assert!(fine.extremes > all.extremes, "{fine:?} {all:?}");
    }
}
