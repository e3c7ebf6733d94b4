//! Balance of forces on random stacks: on a box around the load, and of tractions on both sides of interfaces.

use pellicle_contact::axisymmetric::quadrature::composite;
use pellicle_influence::{Depth, ElementFields, SubsurfaceState};
use pellicle_kernel::{Base, Foundation, Interface, KernelError, Layer, Material, Side};

use super::super::comparison::Comparison;
use super::super::run::{ValidationError, ValidationRun};
use super::super::section::ValidationSection;

/// The section.
pub const SECTION: ValidationSection = ValidationSection {
    name: "Stress inside: balance of forces",
    source: "five sides of a box below the loaded element carry the load; tractions are continuous across interfaces",
    because: "relative to the load, or to the largest traction on the interface; rounding of the fields, 1e-11, and the \
              rule of the box",
    rows,
};

/// Accuracy of the fields and of the quadrature rule.
const ACCURACY: f64 = 1e-9;
/// Number of stacks in this section; a test takes more.
const STACKS: usize = 3;

fn rows(_: ValidationRun) -> Result<Vec<Comparison>, ValidationError> {
    let stacks = random_stacks(STACKS)?;
    let boxes: Result<Vec<_>, _> = stacks.iter().map(box_forces).collect();
    let jumps: Result<Vec<_>, _> = stacks.iter().map(traction_jumps).collect();
    let (boxes, jumps) = (boxes?.concat(), jumps?.concat());
    Ok(vec![
        Comparison::worst(
            format!("a box in {STACKS} random stacks, 2 loads, 3 forces"),
            boxes.into_iter(),
            ACCURACY,
        ),
        Comparison::worst(
            format!("tractions across {} interfaces", jumps.len()),
            jumps.into_iter(),
            ACCURACY,
        ),
    ])
}

/// Returns stacks of one to four layers, thin and thick, stiff and soft, ν from 0 to ½, bonded, on springs or sliding,
/// on half-spaces and rigid bases; they are the same in every run.
///
/// # Errors
/// Never.
pub fn random_stacks(count: usize) -> Result<Vec<Foundation>, KernelError> {
    let mut chaos = std::f64::consts::FRAC_1_SQRT_2;
    // All values are in (0, 1).
    let mut next = || {
        chaos = 3.99 * chaos * (1.0 - chaos);
        chaos
    };
    let material = |next: &mut dyn FnMut() -> f64| {
        let modulus = 10.0_f64.powf(3.0 * next() - 1.5);
        // A quarter of them are incompressible.
        Material::new(modulus, (0.65 * next()).min(0.5))
    };
    let mut stack = || {
        let mut layers = Vec::new();
        let more = 4.0 * next();
        for _ in (0..4).take_while(|i| f64::from(*i) <= more) {
            let thickness = 10.0_f64.powf(1.3 * next() - 1.0);
            let interface = match next() {
                x if x < 0.6 => Interface::Bonded,
                x if x < 0.8 => Interface::spring(next(), next())?,
                _ => Interface::Frictionless,
            };
            layers.push(Layer::new(thickness, material(&mut next)?, interface)?);
        }
        let base = material(&mut next)?;
        let is_rigid = next() < 0.3;
        Foundation::new(
            layers,
            if is_rigid {
                Base::Rigid
            } else {
                Base::HalfSpace(base)
            },
        )
    };
    (0..count).map(|_| stack()).collect()
}

/// Sides of the box around an element of side 1, not centred on it.
const WEST_EAST: [f64; 2] = [-1.1, 1.7];
const SOUTH_NORTH: [f64; 2] = [-0.9, 1.3];

/// Computes the forces on five sides of a box whose sixth side is the loaded surface, whose load they balance: wanted,
/// found, error. The box ends in the base, or in the middle of the last layer on a rigid one.
///
/// # Errors
/// An error if the kernel cannot give the amplitudes.
pub fn box_forces(body: &Foundation) -> Result<Vec<([f64; 2], f64)>, ValidationError> {
    let mut borders: Vec<f64> = (0..=body.layers().len())
        .map(|i| body.interface_depth(i))
        .collect();
    let bottom = match (body.base(), body.layers().last()) {
        (Base::Rigid, Some(last)) => body.thickness() - last.thickness() / 2.0,
        _ => body.thickness() + 0.5,
    };
    borders.retain(|border| *border < bottom);
    borders.push(bottom);
    let halves = |[start, end]: [f64; 2]| composite(&[start, f64::midpoint(start, end), end]);
    let (along_x, along_y) = (halves(WEST_EAST), halves(SOUTH_NORTH));
    let mut forces = [[0.0; 3]; 2];
    let mut add = |element: &ElementFields, point, normal: [f64; 3], weight: f64| {
        let loads = element.at(point);
        for (force, state) in forces.iter_mut().zip([loads.normal, loads.tangential]) {
            for (sum, traction) in force.iter_mut().zip(tractions(&state, normal)) {
                *sum += weight * traction;
            }
        }
    };
    let side = Side::Above;
    for (z, height) in composite(&borders) {
        let element = ElementFields::new(body, 1.0, Depth { z, side }, 3.0)?;
        for (sign, [x, y]) in [-1.0, 1.0]
            .into_iter()
            .zip([0, 1].map(|i| [WEST_EAST[i], SOUTH_NORTH[i]]))
        {
            for (along, width) in &along_y {
                add(&element, [x, *along], [sign, 0.0, 0.0], width * height);
            }
            for (along, width) in &along_x {
                add(&element, [*along, y], [0.0, sign, 0.0], width * height);
            }
        }
    }
    let floor = ElementFields::new(body, 1.0, Depth { z: bottom, side }, 3.0)?;
    for (x, width) in &along_x {
        for (y, length) in &along_y {
            add(&floor, [*x, *y], [0.0, 0.0, 1.0], width * length);
        }
    }
    // The load on the body: a pressure downwards, a traction along +x.
    let balanced = [[0.0, 0.0, -1.0], [-1.0, 0.0, 0.0]];
    let pairs = balanced.iter().flatten().zip(forces.iter().flatten());
    Ok(pairs
        .map(|(wanted, found)| ([*wanted, *found], (found - wanted).abs()))
        .collect())
}

/// The traction `σ n`.
fn tractions(state: &SubsurfaceState, [x, y, z]: [f64; 3]) -> [f64; 3] {
    let [xx, yy, zz, xy, xz, yz] = state.stress;
    [
        xx * x + xy * y + xz * z,
        xy * x + yy * y + yz * z,
        xz * x + yz * y + zz * z,
    ]
}

/// Returns for each interface between layers the largest difference of a traction above and below, relative to the
/// largest traction there.
///
/// # Errors
/// An error if the kernel cannot give the amplitudes.
pub fn traction_jumps(body: &Foundation) -> Result<Vec<([f64; 2], f64)>, ValidationError> {
    let last = match body.base() {
        Base::Rigid => body.layers().len() - 1,
        Base::HalfSpace(_) => body.layers().len(),
    };
    let points = [[0.1, 0.2], [0.5, -0.3], [0.9, 1.1], [-2.0, 0.7]];
    let mut jumps = Vec::new();
    for z in (1..=last).map(|i| body.interface_depth(i)) {
        let at = |side| ElementFields::new(body, 1.0, Depth { z, side }, 4.0);
        let (above, below) = (at(Side::Above)?, at(Side::Below)?);
        let of = |element: &ElementFields, point| {
            let loads = element.at(point);
            [loads.normal, loads.tangential].map(|state| tractions(&state, [0.0, 0.0, 1.0]))
        };
        let mut worst = ([0.0; 2], 0.0_f64);
        let mut largest = 0.0_f64;
        for point in points {
            let pairs = [of(&above, point), of(&below, point)].map(|loads| loads.concat());
            for (above, below) in pairs[0].iter().zip(&pairs[1]) {
                largest = largest.max(above.abs());
                let jump = (below - above).abs();
                if jump >= worst.1 || jump.is_nan() {
                    worst = ([*above, *below], jump);
                }
            }
        }
        jumps.push((worst.0, worst.1 / largest));
    }
    Ok(jumps)
}
