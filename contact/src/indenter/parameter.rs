//! Reading and replacing single numbers of an indenter.

use super::{
    Cone, EllipticParaboloid, FlatPunch, Indenter, IndenterError, IndenterQuantity, Paraboloid,
    PowerLaw, Pyramid, Sphere,
};

impl Indenter {
    /// The numbers on which the height depends smoothly. A flat punch, a map and a custom shape have none, and a sharp
    /// tip has no tip radius. Of a power law, the exponents 1 and 50 have no neighbours on one side, and at exponent 1
    /// the height does not depend on the coefficient.
    #[must_use]
    pub fn parameters(&self) -> Vec<IndenterQuantity> {
        use IndenterQuantity::{
            Coefficient, Exponent, FaceAngle, HalfAngle, Radius, RadiusAlongX, RadiusAlongY,
            TipRadius,
        };
        let all = [
            Radius,
            RadiusAlongX,
            RadiusAlongY,
            HalfAngle,
            FaceAngle,
            TipRadius,
            Exponent,
            Coefficient,
        ];
        let is_there = |of: &IndenterQuantity| self.parameter(*of).is_some_and(|value| value > 0.0);
        let all = all.into_iter().filter(is_there);
        let is_smooth = |of: &IndenterQuantity| match self {
            Self::FlatPunch(_) => false,
            Self::PowerLaw(shape) => {
                let exponent = shape.exponent();
                exponent > PowerLaw::LEAST_EXPONENT
                    && (exponent < PowerLaw::MOST_EXPONENT || *of == Coefficient)
            }
            _ => true,
        };
        all.filter(is_smooth).collect()
    }

    /// The value of a number, in m or rad, or without unit; none if the shape has no such number.
    #[must_use]
    pub fn parameter(&self, quantity: IndenterQuantity) -> Option<f64> {
        use IndenterQuantity::{
            Coefficient, Exponent, FaceAngle, HalfAngle, Radius, RadiusAlongX, RadiusAlongY,
            TipRadius,
        };
        match (quantity, self) {
            (Radius, Self::Paraboloid(shape)) => Some(shape.radius()),
            (RadiusAlongX, Self::EllipticParaboloid(shape)) => Some(shape.radii()[0]),
            (RadiusAlongY, Self::EllipticParaboloid(shape)) => Some(shape.radii()[1]),
            (Radius, Self::Sphere(shape)) => Some(shape.radius()),
            (Radius, Self::FlatPunch(shape)) => Some(shape.radius()),
            (HalfAngle, Self::Cone(shape)) => Some(shape.half_angle()),
            (TipRadius, Self::Cone(shape)) => Some(shape.tip_radius()),
            (FaceAngle, Self::Pyramid(shape)) => Some(shape.face_angle()),
            (TipRadius, Self::Pyramid(shape)) => Some(shape.tip_radius()),
            (Exponent, Self::PowerLaw(shape)) => Some(shape.exponent()),
            (Coefficient, Self::PowerLaw(shape)) => Some(shape.coefficient()),
            _ => None,
        }
    }

    /// The same shape with another value of one number; unchanged if it has no such number.
    ///
    /// ```
    /// use pellicle_contact::{Cone, Indenter, IndenterQuantity};
    ///
    /// let cone = Indenter::from(Cone::new(1.2, 50e-9)?);
    /// let blunter = cone.with_parameter(IndenterQuantity::TipRadius, 80e-9)?;
    /// assert_eq!(blunter, Cone::new(1.2, 80e-9)?.into());
    /// # Ok::<(), pellicle_contact::IndenterError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// Those of the shape's constructor.
    pub fn with_parameter(
        &self,
        quantity: IndenterQuantity,
        value: f64,
    ) -> Result<Self, IndenterError> {
        if self.parameter(quantity).is_none() {
            return Ok(self.clone());
        }
        let or = |wanted: IndenterQuantity, own: f64| if quantity == wanted { value } else { own };
        Ok(match self {
            Self::Paraboloid(_) => Paraboloid::new(value)?.into(),
            Self::EllipticParaboloid(shape) => EllipticParaboloid::new([
                or(IndenterQuantity::RadiusAlongX, shape.radii()[0]),
                or(IndenterQuantity::RadiusAlongY, shape.radii()[1]),
            ])?
            .into(),
            Self::Sphere(_) => Sphere::new(value)?.into(),
            Self::FlatPunch(_) => FlatPunch::new(value)?.into(),
            Self::Cone(shape) => Cone::new(
                or(IndenterQuantity::HalfAngle, shape.half_angle()),
                or(IndenterQuantity::TipRadius, shape.tip_radius()),
            )?
            .into(),
            Self::Pyramid(shape) => Pyramid::new(
                shape.faces(),
                or(IndenterQuantity::FaceAngle, shape.face_angle()),
                or(IndenterQuantity::TipRadius, shape.tip_radius()),
            )?
            .into(),
            Self::PowerLaw(shape) => PowerLaw::new(
                or(IndenterQuantity::Exponent, shape.exponent()),
                or(IndenterQuantity::Coefficient, shape.coefficient()),
            )?
            .into(),
            Self::Plane(_) | Self::Map(_) | Self::Custom(_) => self.clone(),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_parameter_is_listed_read_and_replaced_separately() {
        use IndenterQuantity::{Coefficient, Exponent};
        let shapes: [Indenter; 5] = [
            Paraboloid::new(0.5).unwrap().into(),
            EllipticParaboloid::new([0.5, 2.0]).unwrap().into(),
            Sphere::new(0.5).unwrap().into(),
            Cone::new(0.9, 0.5).unwrap().into(),
            Pyramid::berkovich(0.5).unwrap().into(),
        ];
        for shape in shapes {
            let all = shape.parameters();
            for (index, quantity) in all.iter().enumerate() {
                let other = shape.with_parameter(*quantity, 0.75).unwrap();
                let mut expected: Vec<_> = all.iter().map(|of| shape.parameter(*of)).collect();
                expected[index] = Some(0.75);
                let found: Vec<_> = all.iter().map(|of| other.parameter(*of)).collect();
                assert_eq!(found, expected);
            }
            assert!(!all.is_empty());
        }
        let punch = Indenter::from(FlatPunch::new(1.0).unwrap());
        assert!(punch.parameters().is_empty());
        let sharp = Indenter::from(Cone::new(1.0, 0.0).unwrap());
        assert_eq!(sharp.parameters(), [IndenterQuantity::HalfAngle]);
        let wanted: [(f64, &[IndenterQuantity]); 4] = [
            (1.0, &[]),
            (1.1, &[Exponent, Coefficient]),
            (49.0, &[Exponent, Coefficient]),
            (50.0, &[Coefficient]),
        ];
        for (exponent, wanted) in wanted {
            let shape = Indenter::from(PowerLaw::new(exponent, 1.0).unwrap());
            assert_eq!(shape.parameters(), wanted);
        }
    }
}
