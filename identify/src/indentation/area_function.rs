//! The projected area of a contact over its depth.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use super::IndentationError;

/// The half angle of a modified Berkovich pyramid, between axis and face: `3√3 tan² = 24.5`.
const BERKOVICH: f64 = 65.27;
/// That of a Vickers pyramid, `4 tan² = 24.504`.
const VICKERS: f64 = 68.0;
/// That of the corner of a cube, `3√3 tan² = 2.598`.
const CUBE_CORNER: f64 = 35.264_389_682_754_654;

/// The area function of an indenter.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum AreaFunction {
    /// `A(h) = c₀ h² + c₁ h + c₂ h^½ + c₃ h^¼ + …`: the coefficients, in m^(2 − power).
    Polynomial(Vec<f64>),
    /// The geometry of the tip.
    Tip(Tip),
}

/// A pointed indenter whose end is a ball.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Tip {
    /// Its shape.
    pub shape: TipShape,
    /// Radius of its end, m; zero for a sharp one.
    pub radius: f64,
}

/// The shape of an indenter.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum TipShape {
    /// A three-sided pyramid of 65.27° between axis and face.
    Berkovich,
    /// A four-sided pyramid of 68° between axis and face.
    Vickers,
    /// A three-sided pyramid of 35.26°.
    CubeCorner,
    /// A cone with this angle between axis and side, rad.
    Cone(f64),
    /// A ball.
    Sphere,
}

impl TipShape {
    /// `c₀` of `A = c₀ h²` and the angle between axis and face (rad); none for a ball.
    fn pyramid(self) -> Option<(f64, f64)> {
        let of = |factor: f64, angle: f64| Some((factor * angle.tan().powi(2), angle));
        match self {
            Self::Berkovich => of(3.0 * 3.0_f64.sqrt(), BERKOVICH.to_radians()),
            Self::Vickers => of(4.0, VICKERS.to_radians()),
            Self::CubeCorner => of(3.0 * 3.0_f64.sqrt(), CUBE_CORNER.to_radians()),
            Self::Cone(angle) => of(PI, angle),
            Self::Sphere => None,
        }
    }
}

impl AreaFunction {
    /// The power of the depth of coefficient `k`: 2, 1, ½, ¼, …
    #[must_use]
    pub fn power(k: usize) -> f64 {
        2.0 * 0.5_f64.powi(i32::try_from(k).unwrap_or(i32::MAX))
    }

    /// The area (m²) at a depth (m).
    #[must_use]
    pub fn area(&self, depth: f64) -> f64 {
        match self {
            Self::Polynomial(coefficients) => {
                let terms = coefficients.iter().enumerate();
                terms.map(|(k, c)| c * depth.powf(Self::power(k))).sum()
            }
            Self::Tip(tip) => tip.area(depth),
        }
    }

    /// The area (m²) at a depth (m), which must be positive and within the lower half of a ball.
    ///
    /// # Errors
    ///
    /// [`IndentationError::Area`] if it is not positive, [`IndentationError::DeeperThanBall`] beyond the radius.
    pub fn positive_area(&self, depth: f64) -> Result<f64, IndentationError> {
        if let Self::Tip(Tip {
            shape: TipShape::Sphere,
            radius,
        }) = *self
            && depth > radius
        {
            return Err(IndentationError::DeeperThanBall { depth, radius });
        }
        let area = self.area(depth);
        if depth > 0.0 && area > 0.0 && area.is_finite() {
            Ok(area)
        } else {
            Err(IndentationError::Area { depth, area })
        }
    }

    /// The surface of the indenter within a depth, m²: that of the faces of a sharp pyramid of the same projected area,
    /// `A/sin α`. Without a shape it is a Berkovich pyramid's.
    #[must_use]
    pub fn surface(&self, depth: f64) -> f64 {
        let shape = match self {
            Self::Polynomial(_) => TipShape::Berkovich,
            Self::Tip(tip) => tip.shape,
        };
        match (shape.pyramid(), self) {
            (Some((_, angle)), _) => self.area(depth) / angle.sin(),
            // A cap of height h has the surface 2πRh.
            (None, Self::Tip(tip)) => 2.0 * PI * tip.radius * depth,
            (None, Self::Polynomial(_)) => self.area(depth),
        }
    }
}

impl Tip {
    /// A ball that goes over into a cone of the same `c₀` where both have the same slope:
    ///
    /// ```text
    /// A = π (2 R h − h²)                            up to h = R (1 − sin θ),      π tan² θ = c₀
    /// A = π tan² θ (h + R (1/sin θ − 1))²           beyond: the point of the cone lies that much further out
    /// ```
    fn area(self, depth: f64) -> f64 {
        let ball = PI * (2.0 * self.radius - depth) * depth;
        let Some((factor, _)) = self.shape.pyramid() else {
            return ball;
        };
        let sine = (factor / PI).sqrt().atan().sin();
        if depth <= self.radius * (1.0 - sine) {
            return ball;
        }
        let whole = depth + self.radius * (1.0 / sine - 1.0);
        factor * whole * whole
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_blunt_tip_joins_ball_and_cone_without_a_step_or_a_kink() {
        for shape in [
            TipShape::Berkovich,
            TipShape::CubeCorner,
            TipShape::Cone(1.0),
        ] {
            let tip = AreaFunction::Tip(Tip {
                shape,
                radius: 50e-9,
            });
            let (factor, _) = shape.pyramid().unwrap();
            let join = 50e-9 * (1.0 - (factor / PI).sqrt().atan().sin());
            let step = 1e-6 * join;
            let [below, at, above] = [join - step, join, join + step].map(|h| tip.area(h));
            assert!((above / below - 1.0).abs() < 1e-5, "{shape:?}");
            let slopes = (above - at) / (at - below);
            assert!((slopes - 1.0).abs() < 1e-5, "{shape:?}: {slopes}");
        }
    }

    #[test]
    fn sharp_tips_have_the_areas_and_surfaces_of_the_standard() {
        let sharp = |shape| AreaFunction::Tip(Tip { shape, radius: 0.0 });
        // ISO 14577-1: 24.50 and 24.50 projected, 26.43 the surface of a Vickers pyramid. The angle of a Berkovich
        // pyramid is given to 0.01 degrees, which is 0.02 of its area.
        assert!((sharp(TipShape::Berkovich).area(1.0) - 24.5).abs() < 1e-2);
        assert!((sharp(TipShape::Vickers).area(1.0) - 24.5).abs() < 5e-3);
        assert!((sharp(TipShape::Vickers).surface(1.0) - 26.43).abs() < 5e-3);
        assert!((sharp(TipShape::CubeCorner).area(1.0) - 2.598).abs() < 1e-3);
    }

    #[test]
    fn a_ball_has_an_area_down_to_its_radius() {
        let shape = TipShape::Sphere;
        let ball = AreaFunction::Tip(Tip {
            shape,
            radius: 5e-6,
        });
        let whole = ball.positive_area(5e-6).unwrap();
        assert!((whole / (PI * 25e-12) - 1.0).abs() < 1e-14);
        assert!(matches!(
            ball.positive_area(5.1e-6),
            Err(IndentationError::DeeperThanBall { .. })
        ));
    }

    #[test]
    fn a_polynomial_has_halving_powers_and_must_be_positive() {
        let area = AreaFunction::Polynomial(vec![24.5, 2.0, 3.0, -40.0]);
        let at = |h: f64| 24.5 * h * h + 2.0 * h + 3.0 * h.sqrt() - 40.0 * h.powf(0.25);
        assert!((area.area(0.3) / at(0.3) - 1.0).abs() < 1e-14);
        assert!(matches!(
            area.positive_area(0.3),
            Err(IndentationError::Area { .. })
        ));
    }
}
