//! The tables of indenters built in code: their shapes are those of the physics.

use pellicle_contact::{
    Cone, EllipticParaboloid, FlatPunch, Paraboloid, PowerLaw, Pyramid, Sphere,
};

use super::{
    BerkovichCase, ConeCase, IndenterCase, IndenterShape, ParaboloidCase, PowerCase, RoundCase,
    VickersCase,
};

impl From<IndenterShape> for IndenterCase {
    fn from(shape: IndenterShape) -> Self {
        Self { shape, body: None }
    }
}

impl From<Paraboloid> for IndenterCase {
    fn from(of: Paraboloid) -> Self {
        IndenterShape::Paraboloid(ParaboloidCase::Radius(of.radius())).into()
    }
}

impl From<EllipticParaboloid> for IndenterCase {
    fn from(of: EllipticParaboloid) -> Self {
        IndenterShape::Paraboloid(ParaboloidCase::Radii(of.radii())).into()
    }
}

impl From<Sphere> for IndenterCase {
    fn from(of: Sphere) -> Self {
        let radius = of.radius();
        IndenterShape::Sphere(RoundCase { radius }).into()
    }
}

impl From<FlatPunch> for IndenterCase {
    fn from(of: FlatPunch) -> Self {
        let radius = of.radius();
        IndenterShape::FlatPunch(RoundCase { radius }).into()
    }
}

impl From<PowerLaw> for IndenterCase {
    fn from(of: PowerLaw) -> Self {
        IndenterShape::Power(PowerCase {
            exponent: of.exponent(),
            coefficient: of.coefficient(),
        })
        .into()
    }
}

impl From<Cone> for IndenterCase {
    fn from(of: Cone) -> Self {
        IndenterShape::Cone(ConeCase {
            half_angle: of.half_angle(),
            tip_radius: of.tip_radius(),
        })
        .into()
    }
}

impl From<Pyramid> for IndenterCase {
    fn from(of: Pyramid) -> Self {
        let (tip_radius, face_angle) = (of.tip_radius(), of.face_angle());
        if of.faces() == 4 {
            return IndenterShape::Vickers(VickersCase {
                tip_radius,
                face_angle,
            })
            .into();
        }
        IndenterShape::Berkovich(BerkovichCase {
            tip_radius,
            face_angle,
        })
        .into()
    }
}
