//! Fig. 4: penetration, and its derivative, over the load.

use pellicle_cli::drawing::Dash;
use pellicle_cli::drawing::colours::{self, Colour};

use super::loading::{self, Curve, LoadAxis, Loading, Planned, View};
use super::parameters::Parameters;
use super::picture::Picture;
use super::studio::{PENETRATION, Studio};
use crate::XtaskError;

const STIFF: Colour = colours::PURPLE;
const COMPLIANT: Colour = colours::GREEN;

/// Every curve: colours are coatings, dashes the larger period.
const CURVES: [Planned; 4] = [
    (
        "cases/paper/fig4-stiff-60",
        "stiff coating, T = R/60",
        STIFF,
        Dash::Dashed,
    ),
    (
        "cases/paper/fig4-stiff-80",
        "stiff coating, T = R/80",
        STIFF,
        Dash::Solid,
    ),
    (
        "cases/paper/fig4-soft-60",
        "compliant coating, T = R/60",
        COMPLIANT,
        Dash::Dashed,
    ),
    (
        "cases/paper/fig4-soft-80",
        "compliant coating, T = R/80",
        COMPLIANT,
        Dash::Solid,
    ),
];

const VIEWS: [View; 2] = [
    View {
        title: "penetration",
        y: "D, 10⁻³ R",
        value: |step| step.penetration / 1e-3,
    },
    View {
        title: "its derivative, the inverse of the contact stiffness",
        y: "dD/dQ, 1/(E₁R)",
        value: |step| 1.0 / step.contact_stiffness.unwrap_or(f64::NAN),
    },
];

/// Two coatings with two periods each, under the same forces.
pub(super) fn draw(studio: &mut Studio<'_>) -> Result<Vec<Picture>, XtaskError> {
    let curves = loading::curves(studio, &CURVES, &[PENETRATION])?;
    let loading = Loading {
        curves: &curves,
        load: LoadAxis {
            title: "Q, 10⁻⁵ E₁R² (E₁ of the stiff coating)",
            divisor: 1e-5,
        },
        views: VIEWS,
    };
    let title = "Fig. 4: penetration of a paraboloid into a textured coating against load";
    let sheet = loading.sheet(title, &subtitle(studio, &curves), materials(&curves), false);
    Ok(vec![loading.draw("fig4", sheet)])
}

fn subtitle(studio: &Studio<'_>, curves: &[Curve]) -> String {
    let case = Parameters::of(&curves[0].run);
    format!(
        "{}paraboloid of radius R; coating {}; cylinders {}",
        studio.quality.mark(),
        case.thickness(),
        case.cylinders()
    )
}

fn materials(curves: &[Curve]) -> String {
    let [stiff, compliant] = [0, 2].map(|i: usize| Parameters::of(&curves[i].run).materials());
    format!(
        "compliant coating: {compliant}; stiff coating: {stiff}; the same forces on both, in units of the stiff coating's E₁"
    )
}
