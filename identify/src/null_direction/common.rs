//! Directions that several models have in common.

use faer::Mat;

use super::{NullDirections, kernel};
use crate::IdentifyError;

impl NullDirections {
    /// The directions that leave the curves of all models unchanged: their restriction to the parameters of each model
    /// is a direction of that model.
    ///
    /// A parameter shared by several models has the same name in all of them; one that belongs to a single model, or
    /// has different values in them, needs its own name.
    ///
    /// # Errors
    ///
    /// [`IdentifyError::Decomposition`] where a number is not finite.
    pub fn common(models: &[Self]) -> Result<Self, IdentifyError> {
        if let [one] = models {
            return Ok(one.clone());
        }
        let mut parameters: Vec<String> = Vec::new();
        for name in models.iter().flat_map(|model| &model.parameters) {
            if !parameters.contains(name) {
                parameters.push(name.clone());
            }
        }
        // One weight for each direction of each model.
        let weights: usize = models.iter().map(|model| model.vectors.len()).sum();
        let rows = equations(models, &parameters, weights);
        let equations = Mat::from_fn(rows.len(), weights, |row, weight| rows[row][weight]);
        let vector = |solution: Vec<f64>| {
            let of_name = |name: &String| {
                let row = models.iter().scan(0, |first, model| {
                    let row = row(model, name, *first, weights);
                    *first += model.vectors.len();
                    Some(row)
                });
                let row = row.flatten().next();
                row.map_or(0.0, |row| {
                    row.iter().zip(&solution).map(|(a, b)| a * b).sum()
                })
            };
            parameters.iter().map(of_name).collect()
        };
        let vectors = kernel(&equations)?.into_iter().map(vector).collect();
        Self::new(parameters, vectors)
    }
}

/// One equation for each parameter and each model that has it, except the first: its change equals that in the first
/// model.
fn equations(models: &[NullDirections], parameters: &[String], weights: usize) -> Vec<Vec<f64>> {
    let mut equations = Vec::new();
    for name in parameters {
        let mut first: Option<Vec<f64>> = None;
        let mut before = 0;
        for model in models {
            if let Some(row) = row(model, name, before, weights) {
                match &first {
                    None => first = Some(row),
                    Some(known) => {
                        equations.push(row.iter().zip(known).map(|(a, b)| a - b).collect());
                    }
                }
            }
            before += model.vectors.len();
        }
    }
    equations
}

/// The change of a parameter as a row over the weights of all models; `None` if the model does not have it.
fn row(model: &NullDirections, name: &str, before: usize, weights: usize) -> Option<Vec<f64>> {
    let place = model.parameters.iter().position(|known| known == name)?;
    let mut row = vec![0.0; weights];
    for (vector, entry) in model.vectors.iter().zip(&mut row[before..]) {
        *entry = vector[place];
    }
    Some(row)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Unknown;

    fn model(names: &[&str], vectors: &[&[f64]]) -> NullDirections {
        let names = names.iter().map(|name| (*name).to_owned()).collect();
        let vectors = vectors.iter().map(|vector| vector.to_vec()).collect();
        NullDirections::new(names, vectors).unwrap()
    }

    fn rank(directions: &NullDirections, unknowns: &[&str]) -> usize {
        let unknown = |name: &&str| Unknown::positive(*name, [0.1, 10.0]).unwrap();
        let unknowns: Vec<Unknown> = unknowns.iter().map(unknown).collect();
        directions.among(&unknowns).unwrap().rank()
    }

    #[test]
    fn a_gauge_holds_for_two_indenters_only_if_both_may_change() {
        // E → E/b, R → b² R for two paraboloids on one body.
        let one = model(&["E", "R"], &[&[-1.0, 2.0]]);
        let other = model(&["E", "R'"], &[&[-1.0, 2.0]]);
        let common = NullDirections::common(&[one, other]).unwrap();
        assert_eq!(rank(&common, &["E", "R", "R'"]), 1);
        assert_eq!(rank(&common, &["E", "R"]), 0);
    }

    #[test]
    fn a_direction_of_only_one_of_two_models_is_not_common() {
        let film = model(&["E", "H"], &[&[1.0, 1.0]]);
        let bare = model(&["E"], &[]);
        let common = NullDirections::common(&[film.clone(), bare]).unwrap();
        assert_eq!(rank(&common, &["E", "H"]), 0);
        let same = NullDirections::common(&[film.clone(), film]).unwrap();
        assert_eq!(rank(&same, &["E", "H"]), 1);
    }
}
