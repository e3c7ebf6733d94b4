//! The content of the pictures of stresses, collected plane by plane.

use pellicle::case::foundation::depths::BodyPlane;
use pellicle_plot::stress::view::{InterfaceTractions, StressSection, StressView, SurfaceLine};

use super::plane_values::PlaneValues;

/// Collects the section and the tractions, plane by plane.
pub struct ViewCollector {
    view: StressView,
    /// The position of each point of the line among the points of a plane.
    samples: Vec<CellPoint>,
    reach: SectionDepths,
}

/// The depth of the section, and those of the interfaces, m.
#[derive(Debug, Clone, PartialEq)]
pub struct SectionDepths {
    /// The depth of the section's last plane.
    pub deepest: f64,
    /// The depths of the layers' bottoms.
    pub bottoms: Vec<f64>,
}

/// A point between four points of a plane: the first of them, and the fractions of the way to the next along x and y.
#[derive(Debug, Clone, Copy)]
struct CellPoint {
    first: [usize; 2],
    part: [f64; 2],
}

impl ViewCollector {
    /// Begins a view of planes whose points have these coordinates along x and y, on and below a line, which is moved
    /// to lie within them.
    pub fn new(line: SurfaceLine, centres: &[f64], reach: SectionDepths) -> Self {
        let [low, high] = ends(centres);
        let line = SurfaceLine {
            through: line.through.map(|along| along.clamp(low, high)),
            ..line
        };
        let along = coordinates(line.within(low, high), centres);
        let samples = along
            .iter()
            .map(|along| CellPoint::of(line.at(*along), centres));
        Self {
            samples: samples.collect(),
            reach,
            view: StressView {
                section: StressSection {
                    line,
                    along,
                    depths: Vec::new(),
                    bodies: Vec::new(),
                    von_mises: Vec::new(),
                    max_principal: Vec::new(),
                },
                centres: centres.to_vec(),
                interfaces: Vec::new(),
            },
        }
    }

    /// Adds the next plane.
    pub(super) fn add(&mut self, plane: BodyPlane, values: &PlaneValues) {
        let along = |field: &[f64]| -> Vec<f64> {
            let samples = self.samples.iter();
            samples
                .map(|sample| sample.value(field, values.size))
                .collect()
        };
        if plane.depth.z <= self.reach.deepest {
            let section = &mut self.view.section;
            section.depths.push(plane.depth.z);
            section.bodies.push(plane.body);
            section.von_mises.extend(along(values.von_mises()));
            section.max_principal.extend(along(values.max_principal()));
        }
        // The plane is the lower side of its body.
        if self.reach.bottoms.get(plane.body) == Some(&plane.depth.z) {
            self.view.interfaces.push(InterfaceTractions {
                index: plane.body,
                depth: plane.depth.z,
                shear: values.shear_traction(),
                normal: values.normal_traction().to_vec(),
            });
        }
    }

    /// Returns the view.
    pub fn finish(self) -> StressView {
        self.view
    }
}

impl CellPoint {
    fn of(point: [f64; 2], centres: &[f64]) -> Self {
        let place = point.map(|along| {
            let above = centres.partition_point(|centre| *centre <= along);
            let first = above.clamp(1, centres.len().max(2) - 1) - 1;
            match centres.get(first..first + 2) {
                Some([one, other]) => (first, ((along - one) / (other - one)).clamp(0.0, 1.0)),
                _ => (0, 0.0),
            }
        });
        Self {
            first: place.map(|(first, _)| first),
            part: place.map(|(_, part)| part),
        }
    }

    /// Interpolates the field between the four points.
    fn value(&self, field: &[f64], size: usize) -> f64 {
        let [i, j] = self.first;
        let [x, y] = self.part;
        let mut sum = 0.0;
        for (i, weight) in [(i, 1.0 - x), (i + 1, x)] {
            for (j, weight) in [(j, weight * (1.0 - y)), (j + 1, weight * y)] {
                if weight != 0.0 {
                    sum += weight * field[i * size + j];
                }
            }
        }
        sum
    }
}

fn ends(centres: &[f64]) -> [f64; 2] {
    match (centres.first(), centres.last()) {
        (Some(low), Some(high)) => [*low, *high],
        _ => [0.0; 2],
    }
}

/// Coordinates from one end to another, spaced about as the points of a plane; along x or y, the coordinates of those
/// points.
fn coordinates([from, to]: [f64; 2], centres: &[f64]) -> Vec<f64> {
    let [low, high] = ends(centres);
    if from.to_bits() == low.to_bits() && to.to_bits() == high.to_bits() {
        return centres.to_vec();
    }
    let step = (high - low) / (centres.len().max(2) - 1) as f64;
    let steps = ((to - from) / step).ceil();
    if !(1.0..1e6).contains(&steps) {
        return vec![from];
    }
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "between 1 and 1e6"
    )]
    let count = steps as usize;
    let at = |i: usize| from + (to - from) * (i as f64 / steps);
    (0..=count).map(at).collect()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::FRAC_PI_2;

    use pellicle_influence::Depth;
    use pellicle_kernel::Side;

    use super::*;

    const CENTRES: [f64; 4] = [-1.5, -0.5, 0.5, 1.5];

    /// The stresses of planes whose von Mises stress is a linear function of position.
    fn view(line: SurfaceLine, planes: &[(f64, usize)]) -> StressView {
        let reach = SectionDepths {
            deepest: 0.3,
            bottoms: vec![0.1, 0.5],
        };
        let mut collector = ViewCollector::new(line, &CENTRES, reach);
        for (z, body) in planes {
            let values = PlaneValues::filled(CENTRES.len(), |field, i, j| {
                field as f64 + 10.0 * CENTRES[i] + 100.0 * CENTRES[j]
            });
            let depth = Depth {
                z: *z,
                side: Side::Above,
            };
            collector.add(BodyPlane { depth, body: *body }, &values);
        }
        collector.finish()
    }

    #[test]
    fn a_section_along_x_or_y_uses_the_points_of_the_planes() {
        let along_x = SurfaceLine {
            through: [0.3, 0.25],
            direction: 0.0,
        };
        let section = view(along_x, &[(0.0, 0)]).section;
        assert_eq!(section.along, CENTRES);
        let wanted = CENTRES.map(|x| 9.0 + 10.0 * x + 25.0);
        assert_eq!(section.von_mises, wanted);
        let along_y = SurfaceLine {
            direction: FRAC_PI_2,
            ..along_x
        };
        let section = view(along_y, &[(0.0, 0)]).section;
        assert_eq!(section.along, CENTRES);
        let wanted = CENTRES.map(|y| 9.0 + 3.0 + 100.0 * y);
        for (found, wanted) in section.von_mises.iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-13);
        }
    }

    #[test]
    fn bodies_end_at_interfaces_and_a_single_plane_is_not_a_body() {
        let line = SurfaceLine {
            through: [0.0; 2],
            direction: 0.0,
        };
        let depths = |planes: &[(f64, usize)]| view(line, planes).section.depths_of_bodies();
        let two = [(0.0, 0), (0.1, 0), (0.1, 1), (0.3, 1)];
        assert_eq!(depths(&two), [0.0, 0.1, 0.3]);
        assert_eq!(depths(&two[..3]), [0.0, 0.1]);
        assert!(depths(&[]).is_empty());
    }

    #[test]
    fn an_oblique_section_runs_from_side_to_side_with_correct_positions() {
        let line = SurfaceLine {
            through: [1.0, 0.5],
            direction: 0.5,
        };
        let section = view(line, &[(0.0, 0)]).section;
        let (first, last) = (section.along[0], section.along[section.along.len() - 1]);
        for end in [first, last].map(|along| line.at(along)) {
            let farthest = end[0].abs().max(end[1].abs());
            assert!((farthest - 1.5).abs() < 1e-12, "{end:?}");
        }
        for (along, found) in section.along.iter().zip(&section.von_mises) {
            let [x, y] = line.at(*along);
            assert!((found - (9.0 + 10.0 * x + 100.0 * y)).abs() < 1e-11);
            assert!(line.distance([x, y]) < 1e-15);
        }
        let [sin, cos] = [0.5_f64.sin(), 0.5_f64.cos()];
        assert!((line.distance([1.0 - 2.0 * sin, 0.5 + 2.0 * cos]) - 2.0).abs() < 1e-14);
    }

    #[test]
    fn tractions_are_those_of_the_planes_above_interfaces() {
        let line = SurfaceLine {
            through: [0.0; 2],
            direction: 0.0,
        };
        let view = view(line, &[(0.0, 0), (0.1, 0), (0.1, 1), (0.2, 1)]);
        assert_eq!(view.section.bodies, [0, 0, 1, 1]);
        let [interface] = &view.interfaces[..] else {
            panic!("one interface")
        };
        assert_eq!((interface.index, interface.depth), (0, 0.1));
        let (sxz, syz) = (7.0 - 15.0 - 150.0, 8.0 - 15.0 - 150.0);
        assert!((interface.shear[0] - f64::hypot(sxz, syz)).abs() < 1e-12);
        assert_eq!(interface.normal[0], 5.0 - 15.0 - 150.0);
    }

    #[test]
    fn an_interface_below_the_section_still_has_tractions() {
        let line = SurfaceLine {
            through: [0.0; 2],
            direction: 0.0,
        };
        let view = view(line, &[(0.2, 1), (0.5, 1), (0.5, 2)]);
        assert_eq!(view.section.depths, [0.2]);
        assert_eq!(view.interfaces[0].index, 1);
    }

    #[test]
    fn a_line_outside_the_planes_is_moved_onto_them() {
        let line = SurfaceLine {
            through: [9.0, -9.0],
            direction: 0.0,
        };
        let section = view(line, &[(0.0, 0)]).section;
        assert_eq!(section.line.through, [1.5, -1.5]);
        assert_eq!(section.von_mises[0], 9.0 - 15.0 - 150.0);
    }
}
