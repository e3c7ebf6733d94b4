//! Area and extent of a contact, with its edge placed within an element.
//!
//! Counting elements gives the area to first order, with the scatter of a staircase. Along a smooth edge the field
//!
//! ```text
//! s = (κ K₀₀ + η) p   in contact,      s = −g   beside it
//! ```
//!
//! crosses zero between a centre in contact and one beside it, `δ` elements outside the edge. `K₀₀` is the coefficient
//! of an element on itself. `κ` and `δ` are those of a square-root pressure at a straight edge of a half-space, on the
//! elements of this method: over all directions and positions of the edge `δ` scatters by 0.02 for this κ, and over a
//! circle by 0.0005. Springs that are soft compared with an element's own elasticity make the field linear across the
//! edge, and `δ` vanishes.
//!
//! An element whose pressure is cut at a hardness does not locate the edge beside it. The edge is taken to be halfway,
//! as between single elements.
//!
//! The zero line is drawn by marching squares over the centres. Where the contact ends at the indenter's rim or the
//! outline of a relief, the edge follows from geometry. Checked against closed forms in `tests/tests/convergence`.

use crate::{grid::region::Place, result::contact_field::ContactField};

/// `κ`.
pub const OWN_PRESSURE: f64 = 1.2;
/// `δ`, in elements.
pub const OFFSET: f64 = 0.1316;
/// Scatter of `δ` averaged over an edge of many elements, in elements.
const UNCERTAINTY: f64 = 0.001;
/// Largest fraction of a polygon that may be subtracted; a contact of single elements is mostly edge.
const LARGEST_CUT: f64 = 0.5;

/// Area and extent of a contact.
#[derive(Debug, Clone, Copy, Default)]
pub struct ContactShape {
    /// Area in m², in total and on the relief.
    pub area: f64,
    pub area_on_relief: f64,
    /// Uncertainty of the area from the position of the edge within its elements, in m². A contact of at most two
    /// elements across everywhere is as uncertain as its area: each of its elements has a part in an edge.
    pub uncertainty: f64,
    /// Distance from the axis to the farthest point of the edge, in m.
    pub radius: f64,
    /// Whether the contact meets an outline of the relief or the indenter's rim, or ends at a pressure that is cut.
    pub meets_outline: bool,
}

/// The shape within some cells; areas in elements.
#[derive(Clone, Copy, Default)]
struct CellSum {
    area: f64,
    area_on_relief: f64,
    cut: f64,
    cut_on_relief: f64,
    radius: f64,
    meets_outline: bool,
    /// Whether three by three elements are in contact.
    has_block: bool,
}

/// Where the contact ends between two centres.
#[derive(Clone, Copy)]
pub struct Crossing {
    /// Distance from the first centre, in elements.
    pub from_first: f64,
    /// Distance by which the edge lies inside the zero line, in elements.
    pub offset: f64,
    /// Whether the contact ends at an outline or a rim, or steeply at an element whose pressure is cut.
    is_outline: bool,
}

/// One corner of a cell: the centre of an element.
#[derive(Clone, Copy)]
struct CellCorner {
    place: Place,
    element: Option<usize>,
    is_in_contact: bool,
    is_on_relief: bool,
}

/// Corners of a cell in order, from the one that identifies it.
const TURN: [[isize; 2]; 4] = [[0, 0], [1, 0], [1, 1], [0, 1]];

impl ContactShape {
    /// The shape of the contact in a solved field.
    pub fn of(field: &ContactField<'_>) -> Self {
        let (region, grid) = (field.region, field.grid);
        // Cells from one before the region, if it has a border, to its last element.
        let size = region.size().cast_signed();
        let lines = region.by_lines(field.pressure, |line, _| {
            CellSum::of_line(field, line.cast_signed(), size)
        });
        let before = region.first_line()..0;
        let before = before.map(|line| CellSum::of_line(field, line, size));
        let all = before.chain(lines).fold(CellSum::default(), CellSum::and);
        let whole = region.weight() as f64 * grid.element_area();
        let without = |area: f64, cut: f64| whole * (area - cut.min(LARGEST_CUT * area));
        let area = without(all.area, all.cut);
        Self {
            area,
            area_on_relief: without(all.area_on_relief, all.cut_on_relief),
            uncertainty: if all.has_block {
                whole * all.cut * (UNCERTAINTY / OFFSET)
            } else {
                area
            },
            radius: all.radius,
            meets_outline: all.meets_outline,
        }
    }
}

impl CellSum {
    /// Sums over the cells whose first corner lies in a line.
    fn of_line(field: &ContactField<'_>, line: isize, size: isize) -> Self {
        let mut part = Self::default();
        for column in field.region.first_line()..size {
            let in_contact = field.in_contact_around([line, column]);
            if in_contact == 4 && !part.has_block {
                let beside = [
                    [line + 1, column],
                    [line, column + 1],
                    [line + 1, column + 1],
                ];
                let mut beside = beside.into_iter();
                part.has_block = beside.all(|place| field.in_contact_around(place) == 4);
            }
            match in_contact {
                0 => {}
                4 if field.is_one_side([line, column]) => part.add_whole(field, [line, column]),
                _ => part.add(
                    field,
                    TURN.map(|[i, j]| corner(field, [line + i, column + j])),
                ),
            }
        }
        part
    }

    /// Adds a cell whose corners are all in contact, and all on one side of an outline.
    fn add_whole(&mut self, field: &ContactField<'_>, place: Place) {
        let share = field.region.share_of_cell(place);
        self.area += share;
        if field.element(place).is_some_and(|e| field.is_on_relief(e)) {
            self.area_on_relief += share;
        }
    }

    fn add(&mut self, field: &ContactField<'_>, corners: [CellCorner; 4]) {
        let count =
            |is: fn(&CellCorner) -> bool| corners.iter().filter(|corner| is(corner)).count();
        let in_contact = count(|corner| corner.is_in_contact);
        let on_relief = count(|corner| corner.is_in_contact && corner.is_on_relief);
        let share = field.region.share_of_cell(corners[0].place);
        let polygon = Polygon::of(field, &corners, |corner| corner.is_in_contact);
        self.area += share * polygon.area;
        self.cut += share * polygon.cut;
        self.radius = self.radius.max(polygon.radius);
        self.meets_outline |= polygon.meets_outline || on_relief % in_contact != 0;
        let polygon = match on_relief {
            0 => return,
            _ if on_relief == in_contact => polygon,
            _ => Polygon::of(field, &corners, |corner| {
                corner.is_in_contact && corner.is_on_relief
            }),
        };
        self.area_on_relief += share * polygon.area;
        self.cut_on_relief += share * polygon.cut;
    }

    fn and(self, other: Self) -> Self {
        Self {
            area: self.area + other.area,
            area_on_relief: self.area_on_relief + other.area_on_relief,
            cut: self.cut + other.cut,
            cut_on_relief: self.cut_on_relief + other.cut_on_relief,
            radius: self.radius.max(other.radius),
            meets_outline: self.meets_outline || other.meets_outline,
            has_block: self.has_block || other.has_block,
        }
    }
}

fn corner(field: &ContactField<'_>, place: Place) -> CellCorner {
    let element = field.element(place);
    CellCorner {
        place,
        element,
        is_in_contact: element.is_some_and(|e| field.pressure[e] > 0.0),
        is_on_relief: element.is_some_and(|e| field.is_on_relief(e)),
    }
}

/// The part of a cell that belongs to the contact.
#[derive(Clone, Copy, Default)]
struct Polygon {
    /// Area, in elements.
    area: f64,
    /// Distance from the zero line to the edge, in elements.
    cut: f64,
    radius: f64,
    /// Whether the end of the contact follows from geometry.
    meets_outline: bool,
}

impl Polygon {
    fn of(
        field: &ContactField<'_>,
        corners: &[CellCorner; 4],
        belongs: impl Fn(&CellCorner) -> bool,
    ) -> Self {
        let inside = corners.each_ref().map(&belongs);
        if inside == [true; 4] {
            return Self {
                area: 1.0,
                ..Self::default()
            };
        }
        let mut polygon = Self::default();
        let mut points: [[f64; 2]; 8] = [[0.0; 2]; 8];
        let mut count = 0;
        let mut crossings: [([f64; 2], f64); 4] = [([0.0; 2], 0.0); 4];
        let mut crossed = 0;
        for k in 0..4 {
            let next = (k + 1) % 4;
            let ends = [TURN[k], TURN[next]].map(|at| at.map(|i| i as f64));
            if inside[k] {
                points[count] = ends[0];
                count += 1;
            }
            if inside[k] != inside[next] {
                let (from, to, way) = if inside[k] {
                    (k, next, ends)
                } else {
                    (next, k, [ends[1], ends[0]])
                };
                let crossing = crossing(field, &corners[from], &corners[to]);
                let point = [0, 1]
                    .map(|axis| way[0][axis] + crossing.from_first * (way[1][axis] - way[0][axis]));
                points[count] = point;
                count += 1;
                crossings[crossed] = (point, crossing.offset);
                crossed += 1;
                polygon.meets_outline |= crossing.is_outline;
                polygon.reach_to(field, corners[0].place, point, crossing.offset);
            }
        }
        polygon.area = shoelace(&points[..count]);
        // The edge runs from where the circuit leaves the contact to where it re-enters.
        let first = usize::from(!inside[0]);
        for pair in (first..first + crossed).step_by(2) {
            let [(from, offset), (to, other)] =
                [crossings[pair % crossed], crossings[(pair + 1) % crossed]];
            let length = (to[0] - from[0]).hypot(to[1] - from[1]);
            polygon.cut += 0.5 * (offset + other) * length;
        }
        polygon
    }

    fn reach_to(&mut self, field: &ContactField<'_>, [i, j]: Place, [u, v]: [f64; 2], offset: f64) {
        let [x, y] = field.point([i as f64 + u, j as f64 + v]);
        let inside = offset * field.grid.element_side();
        self.radius = self.radius.max(x.hypot(y) - inside);
    }
}

/// Twice the area is the sum of `x y′ − x′ y` along the sides.
fn shoelace(points: &[[f64; 2]]) -> f64 {
    let twice: f64 = (0..points.len())
        .map(|k| {
            let ([x, y], [u, v]) = (points[k], points[(k + 1) % points.len()]);
            x * v - u * y
        })
        .sum();
    0.5 * twice.abs()
}

/// Locates the end of the contact between the centre of an element in contact and that of one that is not.
pub fn crossing_between(field: &ContactField<'_>, inside: Place, outside: Place) -> Crossing {
    crossing(field, &corner(field, inside), &corner(field, outside))
}

/// Locates the end of the contact between a centre that belongs to it and one that does not.
fn crossing(field: &ContactField<'_>, inside: &CellCorner, outside: &CellCorner) -> Crossing {
    let at = |from_first: f64| Crossing {
        from_first,
        offset: 0.0,
        is_outline: true,
    };
    let (Some(element), Some(other)) = (inside.element, outside.element) else {
        // The domain ends with the element.
        return at(0.5);
    };
    let points = [inside.place, outside.place].map(|place| field.centre(place));
    if inside.is_on_relief != outside.is_on_relief {
        return at(between(points.map(|at| {
            field
                .model
                .relief
                .distance_to_outline(at)
                .unwrap_or(f64::NAN)
        })));
    }
    if field.is_at_limit(element) {
        return at(0.5);
    }
    let gap = field.gap_of(other).max(0.0);
    if gap.is_infinite() {
        return at(between(points.map(|[x, y]| {
            crate::Profile::distance_to_rim(&field.model.indenter, x, y)
        })));
    }
    let (own, eta) = (field.coefficient, field.secant_of(element));
    // s = (κ K₀₀ + η) p
    let level = (OWN_PRESSURE * own + eta) * field.pressure[element];
    // Both are 0 if the pressure is too small to give a level.
    let from_first = if level + gap > 0.0 {
        level / (level + gap)
    } else {
        0.5
    };
    Crossing {
        from_first,
        offset: OFFSET * own / (own + eta),
        is_outline: false,
    }
}

/// Returns where a distance vanishes between two places, positive at the first and negative at the second; halfway if
/// it has no such zero.
fn between([first, second]: [f64; 2]) -> f64 {
    let part = first / (first - second);
    if (0.0..=1.0).contains(&part) {
        part
    } else {
        0.5
    }
}

#[cfg(test)]
mod tests;
