//! Published values: a loaded square on a half-space, circles on three layers.

use pellicle_influence::{Depth, ElementFields, SurfaceLoad};
use pellicle_kernel::{Base, Foundation, Interface, Layer, Material, Side};

use super::super::comparison::Comparison;
use super::super::independent::hankel::{RadialState, circle, fields};
use super::super::run::{ValidationError, ValidationRun};
use super::super::section::ValidationSection;
use super::squares::LoadedCircle;

/// The section.
pub const SECTION: ValidationSection = ValidationSection {
    name: "Stress inside: published numbers",
    source: "CONTACT's example subsurf (E. A. H. Vollebregt); ELLEA1 (E. Levenberg 2016) and the programs of AMADEUS \
             (European Commission 2000), as the validation files of ALVA (A. Skar, S. Andersen 2020) quote them",
    because: "in units of the pressure, in mm, or in microstrain; the last digit printed, and the spread of the \
              programs",
    rows,
};

fn rows(_: ValidationRun) -> Result<Vec<Comparison>, ValidationError> {
    let parts = [loaded_square()?, one_circle()?, two_circles()?, strains()?];
    Ok(parts.concat())
}

/// z, `σ_zz`, `σ_xx` of CONTACT's first case.
const LOADED_SQUARE: [[f64; 3]; 14] = [
    [0.1, -0.994_287, -0.555_944],
    [0.2, -0.960_374, -0.366_593],
    [0.3, -0.891_525, -0.227_289],
    [0.4, -0.799_677, -0.134_431],
    [0.5, -0.700_842, -0.076_184],
    [0.6, -0.606_403, -0.040_853],
    [0.7, -0.521_977, -0.019_799],
    [0.8, -0.449_212, -0.007_388],
    [0.9, -0.387_679, -0.000_156],
    [1.0, -0.336_086, 0.003_977],
    [1.25, -0.240_934, 0.007_720],
    [1.667, -0.149_346, 0.007_342],
    [2.5, -0.071_611, 0.004_458],
    [5.0, -0.018_785, 0.001_325],
];
/// CONTACT's values have four correct digits: at depth 0.5 it gives −0.700842, the exact value is −0.700886.
const CONTACTS_OWN: f64 = 2e-4;

/// z, `σ_zz`, `σ_xx`, `u_z` below the centre: Boussinesq's point loads integrated over the square by mpmath, to 15
/// digits.
const BOUSSINESQ: [[f64; 4]; 4] = [
    [
        0.1,
        -0.994_294_491_884_103,
        -0.556_116_845_000_119,
        0.379_564_189_874_296,
    ],
    [
        0.5,
        -0.700_885_930_281_195,
        -0.076_223_701_526_069_3,
        0.265_157_850_494_201,
    ],
    [
        1.0,
        -0.336_107_580_693_597,
        0.003_972_595_213_422_59,
        0.170_503_683_000_846,
    ],
    [
        2.5,
        -0.071_613_544_524_628_7,
        0.004_457_758_872_489_93,
        0.075_856_249_060_264_1,
    ],
];
/// Rounding of the closed form.
const ROUNDING: f64 = 1e-13;

/// Pressure 1 on a unit square, G = 1, ν = 0.28.
fn loaded_square() -> Result<Vec<Comparison>, ValidationError> {
    let body = Foundation::half_space(Material::new(2.56, 0.28)?);
    let at = |z| {
        let side = Side::Above;
        let element = ElementFields::new(&body, 1.0, Depth { z, side }, 1.0)?;
        Ok::<_, ValidationError>(element.state(SurfaceLoad::Pressure, [0.0, 0.0]))
    };
    let mut of_contact = vec![off([0.265_146, at(0.5)?.displacement[2]])];
    for [z, axial, lateral] in LOADED_SQUARE {
        let [xx, _, zz, ..] = at(z)?.stress;
        of_contact.extend([[axial, zz], [lateral, xx]].map(off));
    }
    let mut exact = Vec::new();
    for [z, axial, lateral, sinking] in BOUSSINESQ {
        let state = at(z)?;
        let [xx, _, zz, ..] = state.stress;
        exact.extend([[axial, zz], [lateral, xx], [sinking, state.displacement[2]]].map(off));
    }
    let row = |check: &str, pairs: Vec<_>, tolerance| {
        Comparison::worst(check.into(), pairs.into_iter(), tolerance)
    };
    Ok(vec![
        row("square by CONTACT: 29 values", of_contact, CONTACTS_OWN),
        row("square by quadrature: 12 values", exact, ROUNDING),
    ])
}

/// A pavement in mm and `MPa`: thickness, modulus and Poisson's ratio of the layers and of the base.
struct Pavement {
    layers: [[f64; 3]; 2],
    base: [f64; 2],
}

impl Pavement {
    fn foundation(&self, first_interface: Interface) -> Result<Foundation, ValidationError> {
        let layer = |[thickness, modulus, ratio]: [f64; 3], interface| {
            Layer::new(thickness, Material::new(modulus, ratio)?, interface)
        };
        let layers = vec![
            layer(self.layers[0], first_interface)?,
            layer(self.layers[1], Interface::Bonded)?,
        ];
        let [modulus, ratio] = self.base;
        let base = Base::HalfSpace(Material::new(modulus, ratio)?);
        Ok(Foundation::new(layers, base)?)
    }
}

/// The three layers of ELLEA1's tables.
const ELLEA: Pavement = Pavement {
    layers: [[150.0, 3000.0, 0.30], [600.0, 200.0, 0.35]],
    base: [40.0, 0.40],
};
const ELLEA_LOAD: LoadedCircle = LoadedCircle {
    radius: 150.0,
    pressure: 1.1,
};
/// Depth (mm), compressive stress (`MPa`) across and along the axis, and sinking (mm), on the axis of one circle.
#[expect(
    clippy::approx_constant,
    reason = "a displacement in mm happens to be near ln 2"
)]
const ONE_CIRCLE: [[f64; 4]; 17] = [
    [10.0, 2.0253, 1.0923, 1.0515],
    [20.0, 1.7171, 1.0703, 1.0516],
    [30.0, 1.4244, 1.0346, 1.0513],
    [40.0, 1.1460, 0.9864, 1.0505],
    [50.0, 0.8803, 0.9271, 1.0493],
    [75.0, 0.2577, 0.7431, 1.0451],
    [100.0, -0.3396, 0.5405, 1.0396],
    [150.0, -1.6757, 0.2752, 1.0235],
    [200.0, 0.0067, 0.2172, 0.9644],
    [250.0, -0.0010, 0.1728, 0.9163],
    [300.0, -0.0064, 0.1388, 0.8769],
    [350.0, -0.0109, 0.1123, 0.8441],
    [400.0, -0.0149, 0.0911, 0.8165],
    [450.0, -0.0189, 0.0739, 0.7930],
    [500.0, -0.0233, 0.0598, 0.7726],
    [750.0, -0.0600, 0.0220, 0.6931],
    [1000.0, -0.0005, 0.0146, 0.5777],
];
/// Depth (mm), compressive stress (`MPa`) across the line of the centres, along it and downwards, and sinking (mm),
/// midway between the centres of two touching circles.
const TWO_CIRCLES: [[f64; 5]; 17] = [
    [10.0, 2.7463, 2.1929, 1.0708, 1.9191],
    [20.0, 2.2753, 1.9296, 1.0326, 1.9202],
    [30.0, 1.8581, 1.6627, 0.9863, 1.9207],
    [40.0, 1.4763, 1.3955, 0.9335, 1.9207],
    [50.0, 1.1197, 1.1293, 0.8758, 1.9202],
    [75.0, 0.2936, 0.4705, 0.7202, 1.9173],
    [100.0, -0.5021, -0.1813, 0.5674, 1.9121],
    [150.0, -2.2806, -1.4829, 0.3726, 1.8936],
    [200.0, 0.0101, 0.0456, 0.3148, 1.8148],
    [250.0, -0.0028, 0.0221, 0.2649, 1.7457],
    [300.0, -0.0127, 0.0050, 0.2221, 1.6855],
    [350.0, -0.0211, -0.0082, 0.1856, 1.6330],
    [400.0, -0.0288, -0.0193, 0.1546, 1.5871],
    [450.0, -0.0366, -0.0294, 0.1281, 1.5469],
    [500.0, -0.0450, -0.0394, 0.1055, 1.5112],
    [750.0, -0.1144, -0.1102, 0.0419, 1.3645],
    [1000.0, -0.0009, -0.0006, 0.0284, 1.1442],
];
/// ELLEA1's values have three to four digits: both methods here differ from them by up to 4e-4.
const ELLEAS_OWN: f64 = 5e-4;
/// Elements along a circle's diameter.
const ELEMENTS: usize = 128;
/// Error of the grid at a depth of thirteen element sides under the rim.
const GRID: f64 = 3e-4;

fn above(z: f64) -> Depth {
    Depth {
        z,
        side: Side::Above,
    }
}

fn off(pair: [f64; 2]) -> ([f64; 2], f64) {
    (pair, (pair[1] - pair[0]).abs())
}

/// Compares with Hankel's integrals of the kernel's amplitudes.
fn one_circle() -> Result<Vec<Comparison>, ValidationError> {
    let body = ELLEA.foundation(Interface::Bonded)?;
    let mut pairs = Vec::new();
    for [z, across, along, sinking] in ONE_CIRCLE {
        let load = circle(ELLEA_LOAD.pressure, ELLEA_LOAD.radius);
        let state = fields(&body, &load, above(z), &[0.0])?[0];
        pairs.extend(
            [
                [across, -state.radial],
                [along, -state.axial],
                [sinking, state.sinking],
            ]
            .map(off),
        );
    }
    let check = "ELLEA1, a circle, by Hankel: 51 values".into();
    Ok(vec![Comparison::worst(
        check,
        pairs.into_iter(),
        ELLEAS_OWN,
    )])
}

/// Compares with the elements of a grid.
fn two_circles() -> Result<Vec<Comparison>, ValidationError> {
    let body = ELLEA.foundation(Interface::Bonded)?;
    let mut pairs = Vec::new();
    for [z, across, along, downwards, sinking] in TWO_CIRCLES {
        let beside = [0.0, ELLEA_LOAD.radius];
        let state = ELLEA_LOAD.states(&body, ELEMENTS, above(z), &[beside])?[0] * 2.0;
        let [xx, yy, zz, ..] = state.stress;
        let displacement = state.displacement[2];
        pairs.extend(
            [
                [across, -xx],
                [along, -yy],
                [downwards, -zz],
                [sinking, displacement],
            ]
            .map(off),
        );
    }
    let check = "ELLEA1, two circles, by elements: 68 values".into();
    Ok(vec![
        Comparison::worst(check, pairs.into_iter(), ELLEAS_OWN),
        two_ways(&body)?,
    ])
}

/// Compares the circle made of elements with Hankel's integrals under its rim.
fn two_ways(body: &Foundation) -> Result<Comparison, ValidationError> {
    let LoadedCircle { radius, pressure } = ELLEA_LOAD;
    let mut pairs = Vec::new();
    for z in [30.0, 150.0, 300.0] {
        let state = ELLEA_LOAD.states(body, ELEMENTS, above(z), &[[0.0, radius]])?[0];
        let radial = fields(body, &circle(pressure, radius), above(z), &[radius])?[0];
        let [xx, yy, zz, _, _, yz] = state.stress;
        let RadialState {
            radial,
            hoop,
            axial,
            shear,
            ..
        } = radial;
        pairs.extend([[hoop, xx], [radial, yy], [axial, zz], [shear, yz]].map(off));
    }
    let check = "a circle by elements and by Hankel: 12 stresses".into();
    Ok(Comparison::worst(check, pairs.into_iter(), GRID))
}

/// The pavement of AMADEUS' comparison of programs.
const AMADEUS: Pavement = Pavement {
    layers: [[260.0, 5000.0, 0.35], [500.0, 200.0, 0.40]],
    base: [50.0, 0.45],
};
const AMADEUS_LOAD: LoadedCircle = LoadedCircle {
    radius: 150.8,
    pressure: 0.7,
};
/// Millionths of strain: horizontal at the bottom of the first layer, vertical at the top of the second and of the
/// base, under the circle's centre and its rim, by BISAR. KENLAYER and GAMES differ by at most 0.3.
const BONDED: [f64; 6] = [-100.5, 251.7, 185.0, -61.9, 192.2, 177.5];
/// The same if the first layer slides, by BISAR; KENLAYER differs by 1. GAMES, whose interface was not quite
/// frictionless, has 11 and −1 for the second and fifth.
const SLIDING: [f64; 6] = [-120.0, 1.0, 217.0, -78.0, -10.0, 205.0];

fn strains() -> Result<Vec<Comparison>, ValidationError> {
    let row = |what: &str, interface, wanted: [f64; 6], tolerance| {
        let found = strains_of(&AMADEUS.foundation(interface)?)?;
        let pairs = wanted
            .into_iter()
            .zip(found)
            .map(|(wanted, found)| off([wanted, found]));
        let check = format!("AMADEUS, {what}: 6 strains, 1e-6");
        Ok::<_, ValidationError>(Comparison::worst(check, pairs, tolerance))
    };
    Ok(vec![
        row("bonded", Interface::Bonded, BONDED, 0.3)?,
        row("sliding", Interface::Frictionless, SLIDING, 1.0)?,
    ])
}

/// The strains, in the order of [`BONDED`].
fn strains_of(body: &Foundation) -> Result<Vec<f64>, ValidationError> {
    let (places, side) = (
        [0.0, AMADEUS_LOAD.radius],
        [Side::Above, Side::Below, Side::Below],
    );
    let load = circle(AMADEUS_LOAD.pressure, AMADEUS_LOAD.radius);
    let depths = [1, 1, 2].map(|index| body.interface_depth(index));
    let states = |i: usize| {
        let depth = Depth {
            z: depths[i],
            side: side[i],
        };
        fields(body, &load, depth, &places)
    };
    let states = [states(0)?, states(1)?, states(2)?];
    let mut strains = Vec::new();
    for place in 0..places.len() {
        for (body, states) in [
            AMADEUS.layers[0][1..].as_ref(),
            &AMADEUS.layers[1][1..],
            &AMADEUS.base,
        ]
        .into_iter()
        .zip(&states)
        {
            let RadialState {
                radial,
                hoop,
                axial,
                ..
            } = states[place];
            let (modulus, ratio) = (body[0], body[1]);
            let strain = if strains.len() % 3 == 0 {
                radial - ratio * (hoop + axial)
            } else {
                axial - ratio * (radial + hoop)
            };
            // These programs count compression as positive.
            strains.push(-1e6 * strain / modulus);
        }
    }
    Ok(strains)
}
