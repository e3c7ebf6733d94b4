//! The planes of a step: those in the files and those in the pictures, each computed once.

use pellicle::case::foundation::FoundationCase;
use pellicle::case::foundation::depths::BodyPlane;
use pellicle::case::stress::StressCase;
use pellicle_kernel::Foundation;

/// A plane and its uses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WantedPlane {
    /// The plane.
    pub plane: BodyPlane,
    /// Whether it is in the files of fields.
    pub is_filed: bool,
    /// Whether it is in the pictures.
    pub is_viewed: bool,
}

/// The uses for which planes are needed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PlaneUses {
    /// Files of fields.
    pub files: bool,
    /// Pictures, or the file to redraw them.
    pub view: bool,
}

/// The planes under a contact of this radius (m), from the surface down. Pictures show planes through all bodies, even
/// if the case requests files of only a few depths, and every interface, however deep.
#[must_use]
pub fn wanted(
    stress: &StressCase,
    case: &FoundationCase,
    foundation: &Foundation,
    contact_radius: f64,
    uses: PlaneUses,
) -> Vec<WantedPlane> {
    let filed = stress.planes(case, foundation, contact_radius);
    let mut viewed = stress.drawn_planes(case, foundation, contact_radius);
    viewed.extend(case.planes_at(foundation, &case.bottoms(foundation)));
    let mut planes: Vec<WantedPlane> = Vec::with_capacity(filed.len() + viewed.len());
    for (is_used, is_filed, of_it) in [(uses.files, true, &filed), (uses.view, false, &viewed)] {
        planes.extend(of_it.iter().filter(|_| is_used).map(|plane| WantedPlane {
            plane: *plane,
            is_filed,
            is_viewed: !is_filed,
        }));
    }
    planes.sort_by(|one, other| {
        let order = one.plane.depth.z.total_cmp(&other.plane.depth.z);
        order.then(one.plane.body.cmp(&other.plane.body))
    });
    planes.dedup_by(|later, kept| {
        let is_same = later.plane == kept.plane;
        kept.is_filed |= is_same && later.is_filed;
        kept.is_viewed |= is_same && later.is_viewed;
        is_same
    });
    planes
}

/// The contact radius from which the planes and their square are chosen, m. For a step without contact it is a third of
/// the domain, as if the contact filled it.
pub fn block_radius(contact_radius: f64, side: f64) -> f64 {
    if contact_radius > 0.0 {
        contact_radius
    } else {
        side / 3.0
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use pellicle::declare::{Record, Scope};
    use pellicle::input::span::Source;
    use pellicle::input::table_reader::TableReader;
    use pellicle::input::toml_tree;

    use super::*;

    const FOUNDATION: &str = "layer = [{ thickness = 0.5, young_modulus = 3, poisson_ratio = 0.3 }]\n\
        substrate = { young_modulus = 1, poisson_ratio = 0.3 }";

    fn planes(depths: Option<Vec<f64>>, files: bool, view: bool) -> Vec<WantedPlane> {
        let source = Arc::new(Source::new("case.toml", FOUNDATION.into()));
        let root = toml_tree::parse(&source).unwrap();
        let case =
            FoundationCase::read(&TableReader::root(&root).unwrap(), &Scope::default()).unwrap();
        let foundation = case.split().unwrap().foundation;
        let stress = StressCase {
            depths,
            ..StressCase::default()
        };
        wanted(&stress, &case, &foundation, 1.0, PlaneUses { files, view })
    }

    #[test]
    fn default_planes_are_used_for_both_files_and_pictures() {
        let both = planes(None, true, true);
        assert!(both.iter().all(|plane| plane.is_filed && plane.is_viewed));
        assert_eq!(both.len(), planes(None, true, false).len());
        assert!(planes(None, false, false).is_empty());
    }

    #[test]
    fn pictures_show_an_interface_below_all_other_planes() {
        let planes = planes(Some(vec![0.1]), false, true);
        let depths: Vec<_> = planes
            .iter()
            .rev()
            .map(|wanted| wanted.plane.depth.z)
            .collect();
        assert_eq!(depths[..3], [0.5, 0.5, 0.1]);
    }

    #[test]
    fn with_given_depths_pictures_still_span_all_bodies_down_to_the_deepest() {
        let planes = planes(Some(vec![0.25, 0.5, 1.5]), true, true);
        let filed = planes.iter().filter(|plane| plane.is_filed);
        let filed: Vec<_> = filed
            .map(|wanted| (wanted.plane.depth.z, wanted.plane.body))
            .collect();
        assert_eq!(filed, [(0.25, 0), (0.5, 0), (0.5, 1), (1.5, 1)]);
        let viewed: Vec<_> = planes.iter().filter(|plane| plane.is_viewed).collect();
        assert!(viewed.len() > 30);
        assert_eq!(viewed[0].plane.depth.z, 0.0);
        assert_eq!(viewed[viewed.len() - 1].plane.depth.z, 1.5);
        let on_interface = planes.iter().filter(|wanted| wanted.plane.depth.z == 0.5);
        assert_eq!(on_interface.filter(|wanted| wanted.is_viewed).count(), 2);
    }
}
