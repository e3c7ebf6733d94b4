//! Parameters of a relief that change its springs or heights but not its outline: reading and replacing them.

use crate::error::TextureError;
use crate::film::Film;
use crate::relief::Relief;
use crate::relief_map::{MapCompliance, ReliefMap};

/// One parameter of a [`Relief`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum ReliefParameter {
    /// Young's modulus of a film, of cylinders, or of recesses or a map that have one, Pa.
    YoungModulus,
    /// Height of cylinders or thickness of a film, m.
    Height,
    /// Uniform compliance of a map, m/Pa.
    Compliance,
}

impl Relief {
    /// Returns the parameters of the relief; a bare surface has none.
    #[must_use]
    pub fn parameters(&self) -> Vec<ReliefParameter> {
        let all = [
            ReliefParameter::YoungModulus,
            ReliefParameter::Height,
            ReliefParameter::Compliance,
        ];
        let is_there = |of: &ReliefParameter| self.parameter(*of).is_some_and(|value| value > 0.0);
        all.into_iter().filter(is_there).collect()
    }

    /// Returns the value of a parameter in SI units, or `None` if the relief has no such parameter.
    #[must_use]
    pub fn parameter(&self, parameter: ReliefParameter) -> Option<f64> {
        use ReliefParameter::{Compliance, Height, YoungModulus};
        match (parameter, self) {
            (YoungModulus, Self::Film(film)) => Some(film.young_modulus()),
            (YoungModulus, Self::Cylinders(cylinders)) => Some(cylinders.young_modulus()),
            (YoungModulus, Self::Recesses(recesses)) => recesses.young_modulus(),
            (Height, Self::Film(_) | Self::Cylinders(_)) => self.height(),
            (_, Self::Map(map)) => match (parameter, map.compliance()) {
                (YoungModulus, MapCompliance::YoungModulus(value))
                | (Compliance, MapCompliance::Uniform(value)) => Some(value),
                _ => None,
            },
            _ => None,
        }
    }

    /// Returns the same relief, with the same spring law, with another value of one parameter; an unchanged copy if it
    /// has no such parameter.
    ///
    /// # Errors
    ///
    /// As [`Film::new`], [`Cylinders::new`](crate::Cylinders::new) and [`ReliefMap::new`].
    pub fn with_parameter(
        &self,
        parameter: ReliefParameter,
        value: f64,
    ) -> Result<Self, TextureError> {
        if self.parameter(parameter).is_none() {
            return Ok(self.clone());
        }
        let or = |wanted: ReliefParameter, own: f64| if parameter == wanted { value } else { own };
        let is_linear = self.spring_law().is_linear();
        Ok(match self {
            Self::Bare | Self::Custom(_) => self.clone(),
            Self::Film(film) => {
                let other = Film::new(
                    or(ReliefParameter::Height, film.thickness()),
                    or(ReliefParameter::YoungModulus, film.young_modulus()),
                )?;
                Self::Film(if is_linear { other } else { other.stiffening() })
            }
            Self::Cylinders(cylinders) => Self::Cylinders(cylinders.with_springs(
                or(ReliefParameter::Height, cylinders.height()),
                or(ReliefParameter::YoungModulus, cylinders.young_modulus()),
            )?),
            Self::Recesses(recesses) => Self::Recesses(recesses.with_springs(value)?),
            Self::Map(map) => {
                let compliance = match map.compliance() {
                    MapCompliance::Uniform(_) => MapCompliance::Uniform(value),
                    MapCompliance::YoungModulus(_) => MapCompliance::YoungModulus(value),
                };
                let other = ReliefMap::new(map.map().clone(), compliance)?;
                Self::Map(if is_linear {
                    other
                } else {
                    other.stiffening()?
                })
            }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{CylinderSpec, Cylinders, Lattice};

    #[test]
    fn every_parameter_is_listed_read_and_replaced_independently() {
        let film = Film::new(0.5, 2.0).unwrap();
        let stiffening = Relief::Film(film.stiffening());
        let film = Relief::Film(film);
        let pillars = Cylinders::new(CylinderSpec {
            lattice: Lattice::Square,
            radius: 0.1,
            height: 0.5,
            period: 1.0,
            offset: [0.0, 0.0],
            young_modulus: 2.0,
        });
        for relief in [film, stiffening, Relief::Cylinders(pillars.unwrap())] {
            let all = relief.parameters();
            assert_eq!(
                all,
                [ReliefParameter::YoungModulus, ReliefParameter::Height]
            );
            let other = relief
                .with_parameter(ReliefParameter::YoungModulus, 3.0)
                .unwrap();
            let is_linear = relief.spring_law().is_linear();
            assert_eq!(other.spring_law().is_linear(), is_linear);
            let values = all.iter().map(|of| other.parameter(*of).unwrap());
            assert_eq!(values.collect::<Vec<_>>(), [3.0, 0.5]);
            assert!(
                relief
                    .with_parameter(ReliefParameter::Height, -1.0)
                    .is_err()
            );
        }
        assert!(Relief::Bare.parameters().is_empty());
    }
}
