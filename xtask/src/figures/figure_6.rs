//! Fig. 6: largest pressure and penetration of the pyramid over the load, with and without film.

use pellicle_cli::Units;
use pellicle_cli::drawing::Dash;
use pellicle_cli::{Unit, quantity};

use super::loading::{self, BARE, Curve, FILM, LoadAxis, Loading, Planned, View};
use super::parameters::{Parameters, short};
use super::picture::Picture;
use super::studio::{PEAK, PENETRATION, Studio};
use crate::XtaskError;

/// Both curves up to the load of Fig. 5.
const CURVES: [Planned; 2] = [
    ("cases/paper/fig6-film", "with film", FILM, Dash::Solid),
    ("cases/paper/fig6-bare", "without film", BARE, Dash::Solid),
];

const VIEWS: [View; 2] = [
    View {
        title: "(a) largest pressure",
        y: "largest p, GPa",
        value: |step| step.max_pressure / 1e9,
    },
    View {
        title: "(b) penetration",
        y: "D, nm",
        value: |step| step.penetration / 1e-9,
    },
];

/// The same coating and tip, with the film and without.
pub(super) fn draw(studio: &mut Studio<'_>) -> Result<Vec<Picture>, XtaskError> {
    let curves = loading::curves(studio, &CURVES, &[PENETRATION, PEAK])?;
    let loading = Loading {
        curves: &curves,
        load: LoadAxis {
            title: "Q, mN",
            divisor: 1e-3,
        },
        views: VIEWS,
    };
    let title = "Fig. 6: Berkovich pyramid with a rounded tip, with and without film";
    let sheet = loading.sheet(title, &subtitle(studio, &curves), remark(&curves), true);
    Ok(vec![loading.draw("fig6", sheet)])
}

fn subtitle(studio: &Studio<'_>, curves: &[Curve]) -> String {
    let film = Parameters::of(&curves[0].run);
    format!(
        "{}tip radius {}; coating {}; film {}",
        studio.quality.mark(),
        film.tip_radius(),
        film.thickness(),
        film.film()
    )
}

fn remark(curves: &[Curve]) -> String {
    let film = Parameters::of(&curves[0].run);
    let force = quantity(curves[0].run.last().force, Unit::Newton, Units::Si);
    format!(
        "coating: {}, {}. The last load, {}, is that of Fig. 5; the film shortens by more than its thickness, as printed.",
        film.modulus(),
        film.materials(),
        short(&force)
    )
}
