//! The verbs of every kind of support, against its product and against the whole grid.

use pellicle_influence::{CoefficientTable, RadialTables, Sector, SectorGrid};
use pellicle_kernel::{Foundation, Material};

use super::{
    choice::{given, under},
    divisible::Divisible,
    *,
};
use crate::grid::region::Boundary;

/// A coating on a base, for grids of up to `size` elements per side.
fn elasticity(size: usize) -> Arc<SurfaceElasticity> {
    let [coating, base] = [20.0, 1.0].map(|young| Material::new(young, 0.3).unwrap());
    let body = Foundation::coated(0.05, coating, base).unwrap();
    let tables = RadialTables::build(&body).unwrap();
    let table = CoefficientTable::assemble(&tables, 1.0 / size as f64, size).unwrap();
    Arc::new(SurfaceElasticity::new(Arc::new(table), body))
}

/// All of the grids of 16 × 16 elements, and a part of one.
fn on_grids() -> Vec<Box<dyn Divisible>> {
    let elasticity = elasticity(16);
    let of_sector = |sector| {
        let region = Region::all_of(SectorGrid::of_square(sector, 16));
        under(elasticity.clone(), region)
    };
    let mut all: Vec<_> = [Sector::Whole, Sector::Half, Sector::Quadrant]
        .map(of_sector)
        .into();
    let part = Region::whole(16).around(|[i, j]| i == 5 && j == 6);
    assert!(!part.is_whole());
    all.extend(all[0].part(&part));
    all
}

/// Few elements of a grid of 300 × 300.
fn scattered() -> Box<dyn Divisible> {
    let members = [20 * 300 + 30, 20 * 300 + 34, 70 * 300 + 200];
    let candidates = Arc::new(Candidates::around(300, &members));
    let all = under(elasticity(300), Region::whole(300));
    all.among(&Region::whole(300), &candidates).unwrap()
}

/// The product with a unit pressure on an element.
fn column(support: &mut dyn Divisible, element: usize, elements: usize) -> Vec<f64> {
    let (mut unit, mut column) = (vec![0.0; elements], vec![0.0; elements]);
    unit[element] = 1.0;
    support.apply_into(&unit, &mut column);
    column
}

#[test]
fn coefficients_are_the_entries_of_the_product() {
    // Rounding of an FFT, and the accuracy of products among scattered elements.
    let kinds = on_grids().into_iter().map(|support| (support, 1e-13));
    for (mut support, accuracy) in kinds.chain([(scattered(), 1e-8)]) {
        let size = support.region().size();
        let elements = (support.candidates()).map_or(support.region().elements(), |c| c.len());
        for element in [0, 3, elements - 1] {
            let column = column(&mut *support, element, elements);
            for (other, found) in column.iter().enumerate() {
                let wanted = support.coefficient([element, other]);
                let miss = (found - wanted).abs() / column[element];
                assert!(miss < accuracy, "{size} {element} {other}: {miss:e}");
            }
        }
    }
}

#[test]
fn weights_count_the_whole_surface_and_only_a_part_has_a_border() {
    let cell = under(elasticity(16), Region::domain(16, Boundary::Periodic));
    for support in on_grids() {
        let region = *support.region();
        let whole = support.weight() * region.elements();
        assert_eq!(whole == 256, region.is_whole());
        assert_eq!(support.may_grow(), !region.is_whole());
    }
    assert!(!cell.may_grow() && cell.weight() == 1 && !scattered().may_grow());
    // Elements beyond the border of a part are next to those on it.
    let part = on_grids().pop().unwrap();
    let [rows, columns] = part.region().lengths();
    let is_outermost = |place: [usize; 2]| {
        place[0].is_multiple_of(rows - 1) || place[1].is_multiple_of(columns - 1)
    };
    assert!(
        part.border()
            .all(|element| is_outermost(part.place(element)))
    );
}

#[test]
fn gathered_values_are_those_of_the_elements_on_the_grid() {
    let index = |region: &Region, place| region.index_on_grid(place) as f64;
    for support in on_grids().into_iter().chain([scattered()]) {
        let region = *support.region();
        let field: Vec<f64> = (0..region.everywhere().elements())
            .map(|e| e as f64)
            .collect();
        for (element, value) in support.gather(&field).into_iter().enumerate() {
            assert_eq!(value, index(&region, support.place(element)));
        }
    }
}

#[test]
fn a_cell_has_no_part_and_an_unknown_operator_no_coefficient() {
    let cell = under(elasticity(16), Region::domain(16, Boundary::Periodic));
    let part = Region::whole(16).around(|[i, j]| i == 5 && j == 6);
    assert!(cell.part(&part).is_none() && cell.part(cell.region()).is_some());
    let operator = Box::new(elasticity(16).operator(16));
    let unknown = given(operator, Region::whole(16));
    assert!(unknown.coefficient([0, 0]).is_nan() && !unknown.takes_candidates());
}
