//! Limits of linear elasticity with small strains: numbers of a solved contact that no body can have.
//!
//! The equations of a contact are linear and have a solution at every load. What it means is checked here. Each number
//! is divided by its limit, so that the model cannot hold from 1 on:
//!
//! | limit | number | divided by | counts if |
//! |---|---|---|---|
//! | [`LayerThickness`](ModelLimit::LayerThickness) | shortening of a layer below the deepest or most pressed point, or of all together at least | its thickness, or theirs | there are layers |
//! | [`RigidBase`](ModelLimit::RigidBase) | displacement of the surface, on a bare body that of a rigid indenter | depth of the base | the base is rigid |
//! | [`IndenterRadius`](ModelLimit::IndenterRadius) | penetration | radius of a sphere, paraboloid or punch | the indenter's own part of it is large, see below |
//! | [`Modulus`](ModelLimit::Modulus) | mean pressure that reaches a layer or the base | its Young's modulus | it is thicker than the pressure is wide |
//! | [`WornLayer`](ModelLimit::WornLayer) | depth of wear | thickness of the top layer | a bare surface wears |
//!
//! Both bodies are examined, each below the same pressure.
//!
//! A penetration may exceed a small indenter's radius where a stiff skin sinks as a whole. The contact then is narrow
//! ([`NARROW`]) or, under a punch, its pressure small ([`SMALL_PRESSURE`]). A layer thinner than its pressure is wide
//! cannot move sideways, so it carries more than its modulus; what it cannot do is in its shortening. Springs of a
//! relief have a [warning](crate::Warning::FilmShortening) of their own. Self-similar tips and maps have no size.

use std::cell::OnceCell;
use std::f64::consts::PI;

use pellicle_influence::{ElasticBodies, ElasticBody, LayerColumn, LayerCompression};
use pellicle_texture::{Grid, Relief};

use crate::{Boundary, Indenter, LimitRatio, Model, ModelLimit, PeakPlace, Step};

/// Below this ratio of largest pressure to smallest Young's modulus no strain comes near a tenth, and layers are not
/// examined.
const NEGLIGIBLE_PRESSURE: f64 = 0.02;
/// A contact with a radius below this part of the indenter's is narrow. On a half-space a sphere sunk by its radius has
/// 0.83, a paraboloid 1.
const NARROW: f64 = 0.5;
/// A mean pressure below this part of the modulus is small under a punch. On a half-space one sunk by its radius has
/// 0.64 E*; below it on the axis, half of that.
const SMALL_PRESSURE: f64 = 0.25;

/// The limits of a model on a grid, with the tables that they need.
pub(crate) struct ModelLimits<'a> {
    model: &'a Model,
    grid: Grid,
    boundary: Boundary,
    /// Of each body; made on first use; none if the kernel cannot compute them.
    tables: [OnceCell<Option<LayerCompression>>; 2],
}

/// A body in a solved contact.
struct PressedBody<'a> {
    bodies: &'a ElasticBodies,
    of: ElasticBody,
    /// Its layers below the places where they may be shortened most; none where nothing is.
    columns: Vec<LayerColumn>,
}

impl<'a> ModelLimits<'a> {
    pub fn new(model: &'a Model, grid: Grid, boundary: Boundary) -> Self {
        Self {
            model,
            grid,
            boundary,
            tables: [const { OnceCell::new() }; 2],
        }
    }

    /// The numbers of a step over their limits, at most one of each kind: the largest.
    pub fn ratios(&mut self, step: &Step) -> Vec<LimitRatio> {
        let bodies = self.model.tables.bodies();
        let elastic = ElasticBody::ALL.into_iter().zip(&self.tables);
        let elastic = elastic.filter(|(of, _)| !bodies.of(*of).is_rigid());
        let pressed = elastic.map(|(of, tables)| PressedBody {
            bodies,
            of,
            columns: self.columns(of, tables, step),
        });
        let pressed: Vec<_> = pressed.collect();
        let modulus = largest(pressed.iter().filter_map(|body| body.modulus(step)));
        let carried = modulus.map_or(0.0, |found| found.ratio);
        [
            largest(
                pressed
                    .iter()
                    .flat_map(|body| [body.thickness(), self.together(step, body.of)])
                    .flatten(),
            ),
            largest(
                pressed
                    .iter()
                    .filter_map(|body| self.rigid_base(step, body)),
            ),
            self.indenter_radius(step, carried),
            modulus,
        ]
        .into_iter()
        .flatten()
        .collect()
    }

    /// The displacement of the surface over the depth of a rigid base.
    fn rigid_base(&self, step: &Step, pressed: &PressedBody<'_>) -> Option<LimitRatio> {
        if pressed.bodies.of(pressed.of).base_material().is_some() {
            return None;
        }
        let displacement = if self.has_known_surface(pressed.of) {
            // Where the indenter's lowest point presses; D is exact.
            step.solution.penetration
        } else {
            let all = pressed.columns.iter();
            let all = all.map(|column| column.shortenings.iter().sum());
            all.fold(0.0, f64::max)
        };
        Some(LimitRatio {
            limit: ModelLimit::RigidBase { of: pressed.of },
            ratio: displacement / pressed.bodies.of(pressed.of).thickness(),
        })
    }

    /// At least how much the layers of a body are shortened together over their thickness, if the displacement of its
    /// surface is known: by what the base, pressed without them, does not give. One of them is shortened by as much, as
    /// the one that gives most. Below a layer that does not change its volume this is all that is known for sure.
    fn together(&self, step: &Step, of: ElasticBody) -> Option<LimitRatio> {
        let body = self.model.tables.bodies().of(of);
        if !self.has_known_surface(of) {
            return None;
        }
        let pressure = &step.solution.pressure;
        let place = nearest_in_contact(self.grid, pressure)?;
        let height = self.model.indenter.height(place[0], place[1]);
        let base = body.base_material().map_or(0.0, |base| {
            displacement(self.grid, pressure, place) / base.plane_strain_modulus()
        });
        let gives = |layer: &usize| {
            let layer = &body.layers()[*layer];
            layer.thickness() / layer.material().young_modulus()
        };
        let layers = 0..body.layers().len();
        let layer = layers.max_by(|one, other| gives(one).total_cmp(&gives(other)))?;
        Some(LimitRatio {
            limit: ModelLimit::LayerThickness { of, layer },
            ratio: (step.solution.penetration - height - base) / body.thickness(),
        })
    }

    /// Whether a body's surface in contact is the other's, which does not deform, so that its displacement is known,
    /// and that of its layers with it: no interface yields.
    fn has_known_surface(&self, of: ElasticBody) -> bool {
        let bodies = self.model.tables.bodies();
        let mut layers = bodies.of(of).layers().iter();
        self.model.relief == Relief::Bare
            && self.boundary == Boundary::Free
            && bodies.of(of.other()).is_rigid()
            && layers.all(|layer| layer.interface().normal_compliance() <= 0.0)
    }

    /// The penetration over the radius of the indenter, of two the smaller, if that part of it is its own.
    fn indenter_radius(&self, step: &Step, pressed: f64) -> Option<LimitRatio> {
        let is_wide = |radius: f64| step.summary.contact_radius > NARROW * radius;
        let radius = match &self.model.indenter {
            Indenter::Sphere(sphere) if is_wide(sphere.radius()) => sphere.radius(),
            Indenter::Paraboloid(of) if is_wide(of.radius()) => of.radius(),
            Indenter::EllipticParaboloid(of) => {
                let [x, y] = of.radii();
                let smaller = x.min(y);
                // The semi-axis along it: A = π a b
                let across = step.summary.contact_area / (PI * step.summary.contact_radius);
                if across <= NARROW * smaller {
                    return None;
                }
                smaller
            }
            Indenter::FlatPunch(punch) if pressed > SMALL_PRESSURE => punch.radius(),
            _ => return None,
        };
        Some(LimitRatio {
            limit: ModelLimit::IndenterRadius,
            ratio: step.solution.penetration / radius,
        })
    }

    /// A body's layers below the places of a step at which they may be shortened most; none where nothing is.
    fn columns(
        &self,
        of: ElasticBody,
        tables: &OnceCell<Option<LayerCompression>>,
        step: &Step,
    ) -> Vec<LayerColumn> {
        let foundation = self.model.tables.bodies().of(of);
        let (layers, base) = (foundation.layers().iter(), foundation.base_material());
        let moduli = layers.map(|layer| layer.material().young_modulus());
        let moduli = moduli.chain(base.map(|base| base.young_modulus()));
        let softest = moduli.fold(f64::INFINITY, f64::min);
        let is_negligible = step.summary.max_pressure < NEGLIGIBLE_PRESSURE * softest;
        if foundation.layers().is_empty() || is_negligible {
            return Vec::new();
        }
        let known = base.is_none() && self.has_known_surface(of);
        let (side, grid) = (self.grid.element_side(), self.grid);
        let tables = tables.get_or_init(|| {
            LayerCompression::new(foundation, [side / 2.0, 2.0 * grid.side()]).ok()
        });
        let Some(tables) = tables else {
            return Vec::new();
        };
        let pressure = &step.solution.pressure;
        let boundary = self.boundary;
        let places = places(grid, boundary, step).into_iter();
        let columns = places.map(|place| {
            let column = below(tables, (grid, boundary), pressure, place);
            if !known {
                return column;
            }
            // The surface lies on the other body, and the base does not move.
            let height = self.model.indenter.height(place[0], place[1]);
            let displacement = step.solution.penetration - height;
            scaled(column, displacement)
        });
        columns.collect()
    }
}

impl PressedBody<'_> {
    /// The largest shortening of a layer over its thickness.
    fn thickness(&self) -> Option<LimitRatio> {
        let (of, layers) = (self.of, self.bodies.of(self.of).layers());
        let of_column = |column: &LayerColumn| {
            let shortenings = column.shortenings.iter().zip(layers).enumerate();
            let ratios = shortenings.map(|(layer, (shortening, found))| LimitRatio {
                limit: ModelLimit::LayerThickness { of, layer },
                ratio: shortening / found.thickness(),
            });
            ratios.collect::<Vec<_>>()
        };
        largest(self.columns.iter().flat_map(of_column))
    }

    /// The mean pressure that reaches a layer or the base over its modulus, the largest of those thicker than it is
    /// wide.
    fn modulus(&self, step: &Step) -> Option<LimitRatio> {
        let (force, mean) = (step.solution.force, step.summary.mean_pressure);
        let body = self.bodies.of(self.of);
        let (layers, base) = (body.layers(), body.base_material());
        let ratio = |body: usize| {
            let pressure = match body.checked_sub(1) {
                None => mean,
                Some(above) => {
                    let reaching = self.columns.iter().map(|column| column.pressures[above]);
                    reaching.fold(0.0, f64::max).min(mean)
                }
            };
            let (material, thickness) = match layers.get(body) {
                Some(layer) => (layer.material(), layer.thickness()),
                None => (base?, f64::INFINITY),
            };
            // F = π a² p
            let is_wider = (force / (PI * pressure)).sqrt() > thickness;
            (pressure > 0.0 && !is_wider).then(|| LimitRatio {
                limit: ModelLimit::Modulus { of: self.of, body },
                ratio: pressure / material.young_modulus(),
            })
        };
        largest((0..=layers.len()).filter_map(ratio))
    }
}

/// A column whose layers are shortened by this much (m) together.
fn scaled(mut column: LayerColumn, together: f64) -> LayerColumn {
    let factor = together / column.shortenings.iter().sum::<f64>();
    if factor.is_finite() && factor > 0.0 {
        for shortening in &mut column.shortenings {
            *shortening *= factor;
        }
    }
    column
}

/// The largest ratio; the first of equal ones.
fn largest(ratios: impl Iterator<Item = LimitRatio>) -> Option<LimitRatio> {
    let finite = ratios.filter(|found| found.ratio.is_finite());
    finite.reduce(|one, other| if other.ratio > one.ratio { other } else { one })
}

/// The places of the largest pressure, unless it is an edge's and grows with the grid, and of the element in contact
/// nearest to the indenter's lowest point, m.
fn places(grid: Grid, boundary: Boundary, step: &Step) -> Vec<[f64; 2]> {
    let peak = step.summary.max_pressure_at;
    let is_smooth = match step.summary.peak_place {
        PeakPlace::Inside | PeakPlace::Ridge => true,
        PeakPlace::Outline | PeakPlace::IndenterEdge => false,
    };
    let mut places = if is_smooth { vec![peak] } else { Vec::new() };
    if boundary == Boundary::Periodic && is_smooth {
        return places;
    }
    let nearest = nearest_in_contact(grid, &step.solution.pressure);
    let is_new = |place: &[f64; 2]| {
        !is_smooth || (place[0] - peak[0]).hypot(place[1] - peak[1]) > 2.0 * grid.element_side()
    };
    places.extend(nearest.filter(is_new));
    places
}

/// The centre of the element in contact that is nearest to the axis, m.
fn nearest_in_contact(grid: Grid, pressure: &[f64]) -> Option<[f64; 2]> {
    let row = grid.row();
    let in_contact = (0..pressure.len()).filter(|element| pressure[*element] > 0.0);
    let places = in_contact.map(|element| grid.point([element / row, element % row]));
    let distance = |place: &[f64; 2]| place[0].hypot(place[1]);
    places.min_by(|one, other| distance(one).total_cmp(&distance(other)))
}

/// The displacement of a half-space of modulus `E* = 1` at the centre of an element under pressures on a grid, m Pa, by
/// point forces beside the element's own square: `u = Σ p A/(π r)`, and `4 ln(1 + √2) p h/π` of a square of side h
/// (A. E. H. Love, Phil. Trans. A 228, 377 (1929)).
fn displacement(grid: Grid, pressure: &[f64], [x, y]: [f64; 2]) -> f64 {
    let (row, side) = (grid.row(), grid.element_side());
    let of_element = |(element, p): (usize, &f64)| {
        let [u, v] = grid.point([element / row, element % row]);
        let distance = (u - x).hypot(v - y);
        if distance < 0.5 * side {
            4.0 * (1.0 + 2.0_f64.sqrt()).ln() * p * side / PI
        } else {
            p * side * side / (PI * distance)
        }
    };
    pressure.iter().enumerate().map(of_element).sum()
}

/// The layers below a place under pressures on a grid. In a periodic cell they are split into their mean, and what
/// differs from it within half a cell to either side of the place.
fn below(
    tables: &LayerCompression,
    (grid, boundary): (Grid, Boundary),
    pressure: &[f64],
    [x, y]: [f64; 2],
) -> LayerColumn {
    let row = grid.row();
    let (mean, away): (f64, fn(f64, f64) -> f64) = match boundary {
        Boundary::Free => (0.0, |distance, _| distance),
        Boundary::Periodic => (
            pressure.iter().sum::<f64>() / pressure.len() as f64,
            |distance, side| distance - side * (distance / side).round(),
        ),
    };
    let along = |axis: usize, from: f64| -> Vec<f64> {
        let (length, side) = (grid.lengths()[axis], grid.sides()[axis]);
        let centres = (0..length).map(|i| grid.centre_along(axis, i) - from);
        centres.map(|distance| away(distance, side)).collect()
    };
    let (along_x, along_y) = (along(0, x), along(1, y));
    let loads = pressure.iter().enumerate();
    let loads = loads.map(|(element, p)| (element, p - mean));
    let loads = loads
        .filter(|(_, p)| *p != 0.0)
        .map(|(element, p)| ([along_x[element / row], along_y[element % row]], p));
    tables.below(loads, grid.element_side(), mean)
}

#[cfg(test)]
mod tests;
