//! The filter on islands, on sectors, under plates and at borders, against the system that it inverts.

use std::sync::Arc;

use pellicle_influence::{
    CoefficientTable, ElasticOperator, RadialTables, Sector, SectorGrid, SurfaceElasticity, love,
};
use pellicle_kernel::{Foundation, Material};

use super::{EdgeBand, RestrictedFilter};
use crate::solver::gradient::load_control::LoadControl;
use crate::{
    DiscreteProblem,
    grid::region::Region,
    problem::support::choice::under,
    solver::gradient::{tests::begun, working_set::WorkingSet},
    vector::{add_scaled, dot},
};

const SIZE: usize = 48;

fn surface() -> Arc<SurfaceElasticity> {
    let steel = Material::new(210e9, 0.3).unwrap();
    let table =
        CoefficientTable::from_fn(1e-6, SIZE, |offset| love::coefficient(&steel, 1e-6, offset));
    let foundation = Foundation::half_space(steel);
    Arc::new(SurfaceElasticity::new(Arc::new(table.unwrap()), foundation))
}

/// Pillars within a disc, with this period and radius in elements.
fn set_of_pillars(surface: &Arc<SurfaceElasticity>, period: f64, radius: f64) -> WorkingSet {
    set_where(surface, |e| {
        let [x, y] = [e / SIZE, e % SIZE].map(|i| i as f64 - 23.5);
        let [px, py] = [x, y].map(|along| along.rem_euclid(period) - period / 2.0);
        x.hypot(y) < 19.0 && px.hypot(py) < radius
    })
}

/// The elements for which a rule holds.
fn set_where(surface: &Arc<SurfaceElasticity>, inside: impl Fn(usize) -> bool) -> WorkingSet {
    let pressure: Vec<f64> = (0..SIZE * SIZE)
        .map(|e| f64::from(u8::from(inside(e))))
        .collect();
    let gap = vec![1.0; SIZE * SIZE];
    let eta = vec![0.0; SIZE * SIZE];
    let problem = DiscreteProblem::elastic(surface.clone(), SIZE, eta, gap, 1e-12);
    let control = LoadControl::Penetration(0.0);
    begun(&mut problem.unwrap(), control, &pressure).1
}

/// The filter on the whole grid without springs, adapted to a set.
fn filter_on(surface: &SurfaceElasticity, set: &WorkingSet) -> RestrictedFilter {
    let mut filter = RestrictedFilter::new(surface.symbol(SIZE), &Region::whole(SIZE));
    filter.update(set, &vec![0.0; SIZE * SIZE]);
    filter
}

/// The relative error of the pressure that the filter recovers from `K p` on the set.
fn miss(filter: &mut RestrictedFilter, surface: &SurfaceElasticity, set: &WorkingSet) -> f64 {
    let mut pressure: Vec<f64> = (0..SIZE * SIZE).map(|e| (e as f64).sin()).collect();
    set.clear_outside(&mut pressure);
    let mut recovered = vec![0.0; SIZE * SIZE];
    surface.operator(SIZE).apply_into(&pressure, &mut recovered);
    set.clear_outside(&mut recovered);
    filter.apply(set, &mut recovered);
    add_scaled(&mut recovered, -1.0, &pressure);
    (dot(&recovered, &recovered) / dot(&pressure, &pressure)).sqrt()
}

/// The filter's result for a mirrored field on pillars on both axes, on a sector.
fn filtered_mirror(surface: &Arc<SurfaceElasticity>, sector: SectorGrid) -> Vec<f64> {
    let cut = |field: Vec<f64>| sector.cut(&field);
    let along = |i: usize| (i as f64 - 23.5).abs();
    let mirrored = |of: &dyn Fn(f64, f64) -> f64| {
        let places = (0..SIZE * SIZE).map(|e| [along(e / SIZE), along(e % SIZE)]);
        cut(places.map(|[x, y]| of(x, y)).collect())
    };
    let pillars = mirrored(&|x, y| {
        let [px, py] = [x, y].map(|along| (along + 4.5).rem_euclid(9.0) - 4.5);
        f64::from(u8::from(x.hypot(y) < 18.0 && px.hypot(py) < 3.5))
    });
    let mut field = mirrored(&|x, y| (0.3 * x).cos() + (0.9 * y).sin());
    let zeros = vec![0.0; pillars.len()];
    let gap = vec![1.0; pillars.len()];
    let support = under(surface.clone(), Region::all_of(sector));
    let problem = DiscreteProblem::on(support, zeros.clone(), gap, 1e-12);
    let set = begun(
        &mut problem.unwrap(),
        LoadControl::Penetration(0.0),
        &pillars,
    )
    .1;
    let mut filter = RestrictedFilter::new(surface.symbol(SIZE), &Region::all_of(sector));
    filter.update(&set, &zeros);
    assert!(!filter.band.is_empty());
    set.clear_outside(&mut field);
    filter.apply(&set, &mut field);
    field
}

#[test]
fn on_a_quadrant_filter_and_band_include_the_images_beyond_the_axes() {
    let surface = surface();
    let sector = SectorGrid::of_square(Sector::Quadrant, SIZE);
    let whole = sector.cut(&filtered_mirror(&surface, SectorGrid::whole(SIZE)));
    let quadrant = filtered_mirror(&surface, sector);
    let largest = whole.iter().fold(0.0, |most: f64, z| most.max(z.abs()));
    for (one, other) in quadrant.iter().zip(&whole) {
        // Single precision, with some sums.
        assert!((one - other).abs() < 1e-4 * largest, "{one} {other}");
    }
}

/// A coating two and a half elements thick, ten times as stiff as its base.
fn plate() -> Arc<SurfaceElasticity> {
    let [coating, base] = [1e9, 1e8].map(|modulus| Material::new(modulus, 0.3).unwrap());
    let foundation = Foundation::coated(2.5e-6, coating, base).unwrap();
    let tables = RadialTables::build(&foundation).unwrap();
    let table = CoefficientTable::assemble(&tables, 1e-6, SIZE).unwrap();
    Arc::new(SurfaceElasticity::new(Arc::new(table), foundation))
}

#[test]
fn under_a_stiff_coating_the_filter_with_the_band_is_positive() {
    let surface = plate();
    let set = set_of_pillars(&surface, 7.0, 2.2);
    let mut filter = filter_on(&surface, &set);
    filter.is_plate = true;
    let work = |filter: &mut RestrictedFilter, wavenumber: f64| {
        let wave = |e: usize| (wavenumber * (e / SIZE) as f64).cos();
        let mut residual: Vec<f64> = (0..SIZE * SIZE).map(wave).collect();
        set.clear_outside(&mut residual);
        let mut filtered = residual.clone();
        filter.apply(&set, &mut filtered);
        dot(&residual, &filtered) / dot(&residual, &residual)
    };
    let waves = (0..16).map(|k| 0.2 * f64::from(k));
    for wavenumber in waves {
        let twice = work(&mut filter, wavenumber);
        assert!(twice > 0.0, "{wavenumber}: {twice}");
    }
    filter.is_plate = false;
    assert!(work(&mut filter, 0.0) < 0.0, "once is not enough");
}

#[test]
fn with_the_band_the_filter_nearly_inverts_the_system_on_separate_pillars() {
    let surface = surface();
    let set = set_of_pillars(&surface, 9.0, 3.5);
    let mut filter = filter_on(&surface, &set);
    let with_band = miss(&mut filter, &surface, &set);
    filter.band = EdgeBand::new(filter.wide);
    let without = miss(&mut filter, &surface, &set);
    assert!(
        with_band < 0.03 && without > 0.08,
        "{with_band} and {without}"
    );
}

/// A contact over all of the grid, with pressures that rise towards its border.
#[test]
fn a_wider_grid_keeps_opposite_borders_apart() {
    let surface = surface();
    let set = set_where(&surface, |_| true);
    let mut missed = [SIZE, SIZE + 24].map(|size| {
        let symbol = surface.symbol(size);
        let mut filter = RestrictedFilter::new(symbol, &Region::whole(SIZE));
        filter.update(&set, &vec![0.0; SIZE * SIZE]);
        assert_eq!(filter.band.is_empty(), size == SIZE);
        miss(&mut filter, &surface, &set)
    });
    missed[1] *= 2.0;
    assert!(missed[1] < missed[0], "{missed:?}");
}
