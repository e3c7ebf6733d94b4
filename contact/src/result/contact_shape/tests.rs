//! Areas and extents of contacts whose edge has a closed form.

use std::{f64::consts::PI, sync::Arc};

use pellicle_influence::{Cache, ElasticOperator, RadialTables};
use pellicle_kernel::{Foundation, Material};
use pellicle_texture::{Film, Grid, Relief};

use super::*;
use crate::{
    Boundary, DiscreteProblem, FlatPunch, Indenter, Load, Model, Paraboloid, Solution,
    grid::region::Region,
    result::certificate::{JudgedFields, Trial},
};

const SIZE: usize = 64;
const SIDE: f64 = 1.0 / 64.0;
const RADIUS: f64 = 0.3;

/// Elements that are not displaced.
struct Rigid;

impl ElasticOperator for Rigid {
    fn size(&self) -> usize {
        SIZE
    }

    fn apply_into(&mut self, _: &[f64], displacement: &mut [f64]) {
        displacement.fill(0.0);
    }
}

/// Fields as functions of the distance ρ from the axis.
struct Fields {
    pressure: fn(f64) -> f64,
    gap: fn(f64) -> f64,
    compliance: f64,
    is_on_relief: fn(usize) -> bool,
}

/// The shape of a contact with these fields; an element's coefficient on itself is 1.
fn shape(
    fields: &Fields,
    relief: Relief,
    indenter: impl Into<Indenter>,
    boundary: Boundary,
) -> ContactShape {
    let body = Foundation::half_space(Material::new(1.0, 0.3).unwrap());
    let model = Model {
        tables: Arc::new(RadialTables::build(&body).unwrap()),
        relief,
        indenter: indenter.into(),
        cache: Cache::none(),
    };
    let grid = Grid::new(1.0, SIZE).unwrap();
    let sample = |of: fn(f64) -> f64| -> Vec<f64> {
        let radius = |e: usize| grid.centre(e / SIZE).hypot(grid.centre(e % SIZE));
        (0..SIZE * SIZE).map(|e| of(radius(e))).collect()
    };
    let compliance = vec![fields.compliance; SIZE * SIZE];
    let mask: Vec<bool> = (0..SIZE * SIZE)
        .map(|e| (fields.is_on_relief)(e / SIZE))
        .collect();
    let region = Region::domain(SIZE, boundary);
    let initial_gap = sample(fields.gap);
    let problem = DiscreteProblem::new(
        Box::new(Rigid),
        compliance.clone(),
        initial_gap.clone(),
        SIDE * SIDE,
    );
    let trial = Trial {
        region: &region,
        load: Load::Penetration(0.0),
        expected: f64::INFINITY,
        tolerance: 1e-8,
    };
    let mut judged = JudgedFields::on(region);
    let pressure = sample(fields.pressure);
    Solution::judge_within(&mut problem.unwrap(), trial, pressure.clone(), &mut judged);
    ContactShape::of(&ContactField {
        model: &model,
        grid: &grid,
        region: &region,
        pressure: &pressure,
        hardness: f64::INFINITY,
        initial_gap: &initial_gap,
        judged: &judged,
        mask: &mask,
        compliance: &compliance,
        coefficient: 1.0,
    })
}

fn paraboloid() -> Paraboloid {
    Paraboloid::new(1.0).unwrap()
}

/// A field whose level falls to zero at [`RADIUS`], with slope 1.
const CIRCLE: Fields = Fields {
    pressure: |rho| (RADIUS - rho).max(0.0) / OWN_PRESSURE,
    gap: |rho| (rho - RADIUS).max(0.0),
    compliance: 0.0,
    is_on_relief: |_| false,
};

/// Largest area that chords cut off a circle: `c³/12R` each, of lengths c up to `√2 h`.
const BY_CHORDS: f64 = PI * SIDE * SIDE / 3.0;

#[track_caller]
fn assert_near(found: f64, wanted: f64, error: f64) {
    assert!((found - wanted).abs() < error, "{found} {wanted}");
}

#[test]
fn the_area_of_a_circle_is_reduced_by_the_distance_of_its_edge_from_the_zero_line() {
    let found = shape(&CIRCLE, Relief::Bare, paraboloid(), Boundary::Free);
    let cut = OFFSET * SIDE;
    assert_near(found.area, PI * RADIUS * (RADIUS - 2.0 * cut), BY_CHORDS);
    assert_near(found.radius, RADIUS - cut, SIDE * SIDE / RADIUS);
    assert_near(
        found.uncertainty,
        2.0 * PI * RADIUS * SIDE * UNCERTAINTY,
        1e-6,
    );
    assert!(found.area_on_relief == 0.0 && !found.meets_outline);
}

#[test]
fn on_springs_the_edge_lies_nearer_to_the_zero_line() {
    let fields = Fields {
        pressure: |rho| (RADIUS - rho).max(0.0) / (OWN_PRESSURE + 0.5),
        compliance: 0.5,
        is_on_relief: |_| true,
        ..CIRCLE
    };
    let film = Relief::Film(Film::new(0.5, 1.0).unwrap());
    let found = shape(&fields, film, paraboloid(), Boundary::Free);
    let cut = OFFSET * SIDE / 1.5;
    assert_near(found.area, PI * RADIUS * (RADIUS - 2.0 * cut), BY_CHORDS);
    assert_near(found.radius, RADIUS - cut, SIDE * SIDE / RADIUS);
    assert_eq!(found.area_on_relief, found.area);
}

#[test]
fn a_relief_under_half_of_the_contact_bears_half_of_its_area() {
    let fields = Fields {
        is_on_relief: |row| row < SIZE / 2,
        ..CIRCLE
    };
    let found = shape(&fields, Relief::Bare, paraboloid(), Boundary::Free);
    // Except for the two cells where the edge meets the outline.
    assert_near(found.area_on_relief, found.area / 2.0, SIDE * SIDE / 2.0);
    assert!(found.meets_outline);
}

#[test]
fn the_contact_of_a_punch_ends_at_its_rim() {
    let fields = Fields {
        pressure: |rho| f64::from(u8::from(rho < RADIUS)),
        gap: |rho| if rho < RADIUS { 0.0 } else { f64::INFINITY },
        ..CIRCLE
    };
    let punch = FlatPunch::new(RADIUS).unwrap();
    let found = shape(&fields, Relief::Bare, punch, Boundary::Free);
    assert_near(found.area, PI * RADIUS * RADIUS, BY_CHORDS);
    assert_near(found.radius, RADIUS, SIDE * SIDE / RADIUS);
    assert!(found.uncertainty == 0.0 && found.meets_outline);
}

#[test]
fn full_contact_has_the_area_of_the_domain() {
    let fields = Fields {
        pressure: |_| 1.0,
        gap: |_| 0.0,
        ..CIRCLE
    };
    let area = |boundary| shape(&fields, Relief::Bare, paraboloid(), boundary).area;
    assert_near(area(Boundary::Periodic), 1.0, 1e-13);
    // Less the tips of the corners, an eighth of an element each.
    assert_near(area(Boundary::Free), 1.0 - 0.5 * SIDE * SIDE, 1e-13);
}
