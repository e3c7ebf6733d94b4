//! A first search with the zeros of the abscissae held where the curves show them.
//!
//! Far from the best fit the zeros that fit best are far from the true ones: a body a hundred times too stiff follows a
//! curve only near its end, one a hundred times too soft not at all. From there a search may end where the whole
//! approach, its baseline included, is that of a contact. With the zeros held there is no such minimum, and a search
//! over the unknowns that ends so begins near the best fit.

use crate::{
    Curve, ForwardError, ForwardModel, IdentifyError, Prediction, Problem,
    least_squares::{LeastSquares, Stopping},
    metric::Metric,
    predictor::Predictor,
};

/// A model whose abscissae are counted from these origins.
struct FromOrigins<'a> {
    model: &'a dyn ForwardModel,
    origins: Vec<f64>,
}

impl ForwardModel for FromOrigins<'_> {
    fn predict(&self, parameters: &[f64]) -> Result<Prediction, ForwardError> {
        self.model.predict_from(parameters, &self.origins)
    }
}

/// The origins of all points, if every curve shows its own and the problem seeks them.
fn origins(problem: &Problem) -> Option<Vec<f64>> {
    let curves = problem.curves().iter();
    let of = |curve: &Curve| Some(vec![curve.origin()?; curve.points()]);
    let each = curves.map(of).collect::<Option<Vec<_>>>()?;
    problem.has_abscissa_zeros().then(|| each.concat())
}

/// The coordinates at which such a search from these ends, and the number of its predictions; these coordinates
/// themselves, and none, where no zeros are shown or sought.
pub(crate) fn search(
    model: &dyn ForwardModel,
    problem: &Problem,
    start: Vec<f64>,
    stopping: Stopping,
) -> Result<(Vec<f64>, usize), IdentifyError> {
    let Some(origins) = origins(problem) else {
        return Ok((start, 0));
    };
    let model = FromOrigins { model, origins };
    let problem = problem.without_abscissa_zeros();
    let mut predictor = Predictor::new(&model, &problem);
    let Some(first) = predictor.evaluate(&start)? else {
        return Ok((start, predictor.predictions()));
    };
    let metric = Metric::provisional(&problem, &first);
    let free: Vec<usize> = (0..start.len()).collect();
    let search = LeastSquares {
        problem: &problem,
        metric: &metric,
        free: &free,
        stopping,
    };
    let minimum = search.descend(&mut predictor, first, |_| false)?;
    Ok((minimum.at.position.clone(), predictor.predictions()))
}
