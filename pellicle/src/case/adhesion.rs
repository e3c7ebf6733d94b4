//! The contacts of a case with adhesion, and the check that the other tables are compatible with it.
//!
//! Adhesive contacts are axisymmetric and solved without a grid. The grid solves the contact without adhesion that has
//! the same radius: the whole pressure by the DMT law, and by JKR all but the tension of a flat punch.

use pellicle_contact::adhesion::{
    Adhesion, AdhesionLaw, AdhesiveContact, AdhesiveCurve, TaborRange,
};
use pellicle_contact::axisymmetric::{AxisymmetricElasticity, AxisymmetricProfile};
use pellicle_contact::{ContactError, Load};
use pellicle_influence::ElasticBodies;
use rayon::prelude::*;

use super::foundation::FoundationCase;
use super::grid::{BoundaryCase, GridCase};
use super::indenter::IndenterCase;
use super::load::LoadCase;
use super::spring_law::LawCase;
use super::surface::SurfaceCase;
use super::warnings::CaseWarning;
use crate::display::significant;
use crate::input::diagnosis::Diagnosis;
use crate::input::table_reader::TableReader;

/// The reason why a key is rejected.
const BECAUSE: &str = "with load.work_of_adhesion";

/// The shapes that can adhere.
const SHAPES: &str = "\"paraboloid\", \"sphere\", \"cone\" or \"power\": adhesion is computed for contacts that are circles and grow with the load";

/// The contacts of a case with adhesion.
#[derive(Debug, Clone, PartialEq)]
pub struct AdhesiveContacts {
    /// Where adhesion acts.
    pub law: AdhesionLaw,
    /// One contact per load; none where the indenter has come off.
    pub steps: Vec<Option<AdhesiveContact>>,
    /// The contact under the least force.
    pub pull_off: AdhesiveContact,
    /// The contact at the least penetration.
    pub last_contact: AdhesiveContact,
    /// The contact under no force.
    pub zero_load: AdhesiveContact,
    /// The contact at no penetration, into which the indenter jumps if it is prescribed.
    pub jump_in: AdhesiveContact,
    /// Work lost if the contact is made and broken under a prescribed penetration, J.
    pub work_lost: f64,
    /// Tabor's number; none for a tip without curvature.
    pub tabor_number: Option<f64>,
}

/// Rejects the keys of other tables that are incompatible with a work of adhesion.
///
/// # Errors
///
/// A [`Diagnosis`] of the first incompatible key.
pub fn refuse(
    root: &TableReader<'_>,
    (surface, load, grid): (&SurfaceCase, &LoadCase, &GridCase),
    hardness: Option<f64>,
) -> Result<(), Diagnosis> {
    let field = |table: &str, key: &str| root.required(table, "")?.table()?.required(key, "");
    if load.work_of_adhesion.is_none() {
        return match load.adhesion {
            None => Ok(()),
            Some(_) => {
                Err(field("load", "adhesion")?
                    .unusable(&"without work_of_adhesion", "both or neither"))
            }
        };
    }
    if grid.boundary == BoundaryCase::Periodic {
        return Err(field("grid", "boundary")?.unusable(&BECAUSE, "\"free\""));
    }
    match surface {
        SurfaceCase::Bare => {}
        SurfaceCase::Film(film) if film.law == LawCase::Linear => {}
        SurfaceCase::Film(_) => {
            let wanted = "\"linear\": adhesion is computed for linear springs";
            return Err(field("surface", "law")?.unusable(&BECAUSE, wanted));
        }
        _ => {
            let wanted = "\"bare\" or \"film\": adhesion is computed for contacts that are circles";
            return Err(field("surface", "kind")?.unusable(&BECAUSE, wanted));
        }
    }
    if let Some(stress) = root.optional("stress") {
        let wanted = "no stresses: those of the tension of adhesion are not computed";
        return Err(stress.unusable(&BECAUSE, wanted));
    }
    if let Some(output) = root.optional("output")
        && let Some(over) = output.table()?.optional("mean_pressure_over")
    {
        let wanted = "no length: the pressure with the tension of adhesion is not averaged";
        return Err(over.unusable(&BECAUSE, wanted));
    }
    if load.sensitivities {
        let wanted = "false: derivatives are those of contact without adhesion";
        return Err(field("load", "sensitivities")?.unusable(&BECAUSE, wanted));
    }
    if hardness.is_some() {
        let wanted = "no hardness: adhesion is computed for elastic contact";
        return Err(field("load", "work_of_adhesion")?.unusable(&"with a hardness", wanted));
    }
    Ok(())
}

impl AdhesiveContacts {
    /// The contacts of a case; none without a work of adhesion.
    ///
    /// # Errors
    ///
    /// A [`Diagnosis`] of an indenter that cannot adhere, or of a work of adhesion that its shape cannot hold.
    pub fn find(
        root: &TableReader<'_>,
        (foundation, surface, indenter): (&FoundationCase, &SurfaceCase, &IndenterCase),
        load: &LoadCase,
    ) -> Result<Option<Self>, Diagnosis> {
        let Some(work) = load.work_of_adhesion else {
            return Ok(None);
        };
        let kind = root
            .required("indenter", "")?
            .table()?
            .required("kind", "")?;
        let of_load = root.required("load", "")?.table()?;
        let given = of_load.required("work_of_adhesion", "")?;
        let shape = indenter.build().map_err(|error| kind.refused(&error))?;
        let Some(profile) = AxisymmetricProfile::of(&shape) else {
            return Err(kind.unusable(&BECAUSE, SHAPES));
        };
        let split = foundation.split().map_err(|error| given.refused(&error))?;
        let body = indenter
            .build_body()
            .map_err(|error| kind.refused(&error))?;
        let bodies = ElasticBodies::new(split.foundation, body);
        let law = load.adhesion.unwrap_or_default();
        let relief = surface.build().map_err(|error| kind.refused(&error))?;
        let elasticity = AxisymmetricElasticity::new(&bodies).on_relief(&relief);
        let elasticity = elasticity.ok_or_else(|| kind.refused(&ContactError::NotAxisymmetric))?;
        let found = AdhesiveCurve::new(elasticity, profile, Adhesion { work, law });
        let found = found.and_then(|curve| Self::on(&curve, law, &load.loads(f64::NAN)));
        match found {
            Ok(found) => Ok(Some(found)),
            Err(error @ ContactError::NoDmtFormula) => {
                Err(of_load.required("adhesion", "")?.refused(&error))
            }
            Err(error) => Err(given.refused(&error)),
        }
    }

    fn on(curve: &AdhesiveCurve, law: AdhesionLaw, loads: &[Load]) -> Result<Self, ContactError> {
        let steps = loads.par_iter().map(|load| match *load {
            Load::Force(force) => curve.at_force(force).map(Some),
            Load::Penetration(penetration) => curve.at_penetration(penetration),
        });
        Ok(Self {
            law,
            steps: steps.collect::<Result<_, _>>()?,
            pull_off: curve.pull_off(),
            last_contact: curve.last_contact(),
            // Found to rounding; what is prescribed is exact.
            zero_load: AdhesiveContact {
                force: 0.0,
                ..curve.at_force(0.0)?
            },
            jump_in: AdhesiveContact {
                penetration: 0.0,
                ..curve.at_penetration(0.0)?.unwrap_or(curve.last_contact())
            },
            work_lost: curve.work_lost()?,
            tabor_number: curve.tabor_number()?,
        })
    }

    /// The loads under which contacts without adhesion have the radii of these; the load given where there is none.
    #[must_use]
    pub fn loads_without(&self, given: &[Load]) -> Vec<Load> {
        let steps = self.steps.iter().zip(given);
        let loads = steps.map(|(contact, given)| match contact {
            Some(contact) if contact.force_without > 0.0 => Load::Force(contact.force_without),
            _ => *given,
        });
        loads.collect()
    }

    /// The warnings about the law and the fields.
    #[must_use]
    pub fn warnings(&self) -> Vec<CaseWarning> {
        let mut warnings = Vec::new();
        warnings.extend(
            self.tabor_number
                .and_then(|number| law_warning(self.law, number)),
        );
        if self.law == AdhesionLaw::Jkr {
            warnings.push(CaseWarning {
                code: "adhesion-fields",
                message: "fields, pictures and stresses are those of the contact without adhesion that has the same radius: the tension that adhesion adds, that of a flat punch, is not in them".into(),
            });
        }
        warnings
    }
}

/// The warning that another law holds by Tabor's number.
#[must_use]
pub fn law_warning(law: AdhesionLaw, tabor_number: f64) -> Option<CaseWarning> {
    let range = TaborRange::of(tabor_number);
    let advice = match range {
        TaborRange::Jkr => "JKR holds here",
        TaborRange::Dmt => "DMT holds here",
        TaborRange::Between => "here the pull-off force of a sphere lies between both",
    };
    (!range.admits(law)).then(|| CaseWarning {
        code: "adhesion-law",
        message: format!(
            "Tabor's number is {}; JKR holds above 5, DMT below 0.1: {advice} (`load.adhesion`)",
            significant(tabor_number, 2)
        ),
    })
}

#[cfg(test)]
mod tests {
    use std::path::Path;
    use std::sync::Arc;

    use crate::case::Case;
    use crate::input::span::Source;

    fn read(indenter: &str, load: &str, more: &str) -> Result<Case, String> {
        let text = format!(
            "[foundation]\nsubstrate = {{ young_modulus = \"2 MPa\", poisson_ratio = 0.5 }}\n\
             [indenter]\n{indenter}\n[load]\n{load}\n{more}"
        );
        let source = Arc::new(Source::new("case.toml", text));
        Case::parse(&source, "case", Path::new(""), &[]).map_err(|error| error.to_string())
    }

    const BALL: &str = "kind = \"paraboloid\"\nradius = \"10 um\"";
    const STICKY: &str = "force = \"1 uN\"\nwork_of_adhesion = \"50 mJ/m^2\"";

    #[test]
    fn the_grid_solves_the_contact_without_adhesion_that_has_the_same_radius() {
        let case = read(BALL, STICKY, "").unwrap();
        let adhesion = case.adhesion.clone().unwrap();
        let contact = adhesion.steps[0].unwrap();
        // F + 3πwR + √(6πwR F + (3πwR)²)
        let unit = std::f64::consts::PI * 0.05 * 1e-5;
        let wanted = 1e-6 + 3.0 * unit + (6.0 * unit * 1e-6 + 9.0 * unit * unit).sqrt();
        assert!((contact.force_without / wanted - 1.0).abs() < 1e-10);
        assert_eq!(
            case.loads(),
            [pellicle_contact::Load::Force(contact.force_without)]
        );
        let dmt = read(BALL, &format!("{STICKY}\nadhesion = \"dmt\""), "").unwrap();
        let pull = dmt.adhesion.unwrap().pull_off.force;
        assert!((pull / (-2.0 * unit) - 1.0).abs() < 1e-12);
    }

    /// The grid knows nothing of the integral equation.
    #[test]
    fn the_grid_s_contact_has_the_radius_and_the_penetration_of_the_integral_equation() {
        let film =
            "[surface]\nkind = \"film\"\nthickness = \"0.5 um\"\nyoung_modulus = \"1 MPa\"\n";
        let layer = "[[foundation.layer]]\nthickness = \"1 um\"\nyoung_modulus = \"10 MPa\"\npoisson_ratio = 0.3\n";
        for more in [film.to_owned(), layer.to_owned(), format!("{layer}{film}")] {
            let case = read(BALL, STICKY, &format!("{more}[grid]\nelements = 128")).unwrap();
            let wanted = case.adhesion.clone().unwrap().steps[0].unwrap();
            let run = case.solve(&mut ()).unwrap();
            let step = &run.path.steps[0];
            let ratios = [
                step.solution.penetration / wanted.penetration_without,
                (step.summary.contact_area / std::f64::consts::PI).sqrt() / wanted.radius,
            ];
            // Of second order in an element, 1/43 of the radius.
            for (ratio, error) in ratios.into_iter().zip([2e-4, 2e-3]) {
                assert!((ratio - 1.0).abs() < error, "{more} {ratios:?}");
            }
            let [penetration, force] =
                [run.summary.steps[0].penetration, run.summary.steps[0].force];
            assert!(penetration < wanted.penetration_without && (force / 1e-6 - 1.0).abs() < 1e-9);
        }
    }

    #[test]
    fn what_does_not_adhere_is_refused_with_the_reason() {
        let negative = STICKY.replace("50 mJ", "-50 mJ");
        let force = STICKY.replace("50 mJ/m^2", "50 mN");
        let dmt = format!("{STICKY}\nadhesion = \"dmt\"");
        let faulty = [
            (
                BALL,
                negative.as_str(),
                "",
                "wanted a positive energy per area",
            ),
            (
                BALL,
                &force,
                "",
                "(a force), wanted a positive energy per area",
            ),
            (
                BALL,
                "force = 1\nadhesion = \"jkr\"",
                "",
                "without work_of_adhesion",
            ),
            (
                "kind = \"berkovich\"",
                STICKY,
                "",
                "contacts that are circles",
            ),
            (
                "kind = \"paraboloid\"\nradii = [1, 2]",
                STICKY,
                "",
                "contacts that are circles",
            ),
            (
                "kind = \"flat-punch\"\nradius = 1",
                STICKY,
                "",
                "contacts that are circles",
            ),
            (
                "kind = \"cone\"\nhalf_angle = \"70 deg\"",
                &dmt,
                "",
                "DMT law has no formula",
            ),
            (
                BALL,
                STICKY,
                "[surface]\nkind = \"cylinders\"\nradius = 1e-6\nheight = 1e-6\nperiod = 5e-6",
                "contacts that are circles",
            ),
            (
                BALL,
                STICKY,
                "[surface]\nkind = \"film\"\nthickness = 1\nyoung_modulus = 1e6\nlaw = \"logarithmic\"",
                "linear springs",
            ),
            (BALL, STICKY, "[stress]", "tension of adhesion"),
            (BALL, STICKY, "[solver]\nhardness = 1", "with a hardness"),
            (
                BALL,
                STICKY,
                "[output]\nmean_pressure_over = 1e-6",
                "not averaged",
            ),
            (
                BALL,
                STICKY,
                "[grid]\nboundary = \"periodic\"\nside = 1",
                "wanted \"free\"",
            ),
            (
                BALL,
                &format!("{STICKY}\nsensitivities = true"),
                "",
                "contact without adhesion",
            ),
        ];
        for (indenter, load, more, words) in faulty {
            let message = read(indenter, load, more).unwrap_err();
            assert!(message.contains(words), "{message}");
        }
    }

    #[test]
    fn a_law_outside_its_range_is_warned_of() {
        let codes = |load: &str| {
            let warnings = read(BALL, load, "").unwrap().warnings(1e-5);
            warnings
                .into_iter()
                .map(|warning| warning.code)
                .collect::<Vec<_>>()
        };
        // A soft body: Tabor's number is far above 5.
        assert_eq!(codes(STICKY), ["adhesion-fields"]);
        assert_eq!(
            codes(&format!("{STICKY}\nadhesion = \"dmt\"")),
            ["adhesion-law"]
        );
    }
}
