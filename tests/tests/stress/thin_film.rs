//! Formulas for paraboloids on thin layers, compared with the integral equation: the numbers of
//! docs/thin-film-formulas.md.

use pellicle_kernel::Interface::{Bonded, Frictionless};
use pellicle_validation::film_formulas::{ThinLayer, polynomial};

fn film(interface: pellicle_kernel::Interface, poisson_ratio: f64) -> ThinLayer {
    ThinLayer {
        interface,
        poisson_ratio,
    }
}

/// χ and exact ψ: bonded with ν = 0.5, 0.49, 0.45, 0.3, 0, and sliding.
const PSI: [[f64; 7]; 11] = [
    [0.05, 1.0602, 1.0591, 1.0550, 1.0461, 1.0403, 1.0388],
    [0.1, 1.1291, 1.1263, 1.1171, 1.0972, 1.0844, 1.0811],
    [0.2, 1.2980, 1.2906, 1.2662, 1.2156, 1.1846, 1.1771],
    [0.3, 1.5182, 1.5032, 1.4543, 1.3580, 1.3023, 1.2896],
    [0.5, 2.1562, 2.1099, 1.9671, 1.7170, 1.5903, 1.5668],
    [0.7, 3.0982, 2.9859, 2.6612, 2.1600, 1.9393, 1.9082],
    [1.0, 5.1154, 4.7980, 3.9741, 2.9197, 2.5377, 2.5045],
    [1.5, 10.305, 9.1427, 6.6694, 4.2927, 3.6304, 3.6052],
    [2.0, 18.369, 15.229, 9.7967, 5.7124, 4.7703, 4.7532],
    [3.0, 46.353, 32.616, 16.774, 8.5908, 7.0956, 7.0870],
    [5.0, 173.71, 83.606, 31.657, 14.375, 11.791, 11.788],
];

/// Errors of formulas in %: χ, then Dimitriadis, four terms, the thin limit, for a bonded incompressible layer and for
/// a sliding one with ν = ½.
const ERRORS: [[f64; 7]; 7] = [
    [0.1, -0.2, 0.0, -99.9, 1.4, 0.0, -78.2],
    [0.2, -1.1, 0.0, -99.3, 2.9, 0.0, -60.0],
    [0.3, -2.7, 0.1, -97.9, 4.4, 0.1, -45.2],
    [0.5, -7.7, 1.1, -93.2, 7.6, 0.6, -24.8],
    [1.0, -16.3, 18.9, -77.0, 22.0, 9.2, -5.9],
    [2.0, -12.3, 101.5, -48.7, 90.5, 66.3, -0.9],
    [5.0, 12.7, 392.4, -15.2, 546.1, 477.3, -0.1],
];

#[test]
fn the_table_of_the_page_on_thin_films_is_reproduced() {
    let ratios = [0.5, 0.49, 0.45, 0.3, 0.0];
    let bonded = ratios.map(|nu| film(Bonded, nu));
    for [chi, psi @ ..] in PSI {
        let films = bonded.into_iter().chain([film(Frictionless, 0.2)]);
        for (film, printed) in films.zip(psi) {
            let exact = film.exact(chi).unwrap();
            // Five digits.
            assert!(
                (printed / exact - 1.0).abs() < 5e-5,
                "{film:?} {chi}: {exact}"
            );
        }
    }
    let films = [film(Bonded, 0.5), film(Frictionless, 0.5)];
    for [chi, errors @ ..] in ERRORS {
        let found = films.iter().flat_map(|film| {
            let exact = film.exact(chi).unwrap();
            let [dimitriadis, series] = [film.dimitriadis().unwrap(), film.series().unwrap()];
            let of = |psi: f64| 100.0 * (psi / exact - 1.0);
            [
                of(polynomial(&dimitriadis, chi)),
                of(polynomial(&series, chi)),
                of(film.thin_limit(chi)),
            ]
        });
        for (printed, found) in errors.into_iter().zip(found) {
            assert!((printed - found).abs() < 0.051, "{chi}: {printed} {found}");
        }
    }
}

#[test]
fn the_series_is_exact_up_to_the_fourth_power() {
    for film in [
        film(Bonded, 0.5),
        film(Bonded, 0.3),
        film(Frictionless, 0.3),
    ] {
        let error = |chi| polynomial(&film.series().unwrap(), chi) / film.exact(chi).unwrap() - 1.0;
        let order = (error(0.16) / error(0.08)).log2();
        // The fifth and sixth powers, of either sign; a wrong coefficient would leave the fourth at most.
        assert!(order > 4.5, "{film:?}: {order}");
    }
}

#[test]
fn the_force_on_a_sliding_layer_depends_on_the_plane_strain_modulus_alone() {
    let [one, other] = [0.0, 0.5].map(|nu| film(Frictionless, nu).exact(0.8).unwrap());
    assert!((one / other - 1.0).abs() < 1e-12, "{one} {other}");
}

#[test]
fn a_very_thin_layer_approaches_its_limit() {
    // The rim, one thickness wide, is not negligible compared with the contact radius.
    for (film, chi) in [
        (film(Bonded, 0.5), 12.0),
        (film(Bonded, 0.3), 12.0),
        (film(Frictionless, 0.3), 12.0),
    ] {
        let [near, far] =
            [chi / 2.0, chi].map(|chi| film.thin_limit(chi) / film.exact(chi).unwrap() - 1.0);
        assert!(
            far.abs() < 0.08 && far.abs() < 0.6 * near.abs(),
            "{film:?}: {near} {far}"
        );
    }
}

#[test]
fn the_program_solves_thin_layers_as_the_integral_equation_does() {
    for film in [
        film(Bonded, 0.5),
        film(Bonded, 0.3),
        film(Frictionless, 0.5),
    ] {
        for radius in [0.3, 1.0, 3.0] {
            let [chi, wanted] = film.at_contact_radius(radius).unwrap();
            let error = film.solved(chi, 2.4 * radius).unwrap() / wanted - 1.0;
            assert!(error.abs() < 1e-4, "{film:?} {radius}: {error:e}");
        }
    }
}
