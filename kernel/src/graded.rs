//! A layer whose material changes with depth, split into homogeneous sublayers.
//!
//! Every sublayer takes the material at its mid-depth, an error of second order in its thickness. Halving sublayer `i`
//! changes the compliance by `δᵢ(k)`, and the changes of different sublayers add up. The remaining error of the halves
//! is `δᵢ/3` in the second-order regime and somewhat more where a sublayer is as thick as the wave is long; `δᵢ/2` is
//! assumed. Sublayers with large changes are halved until `Σ |δᵢ(k)| / 2` is below the tolerance for all wavenumbers up
//! to the largest requested. Near the surface, short waves require thin sublayers.

use crate::{Base, Foundation, Interface, KernelError, Layer, Material};

/// A layer of given thickness whose material is a function of depth below its top.
///
/// ```
/// use pellicle_kernel::{Base, GradedLayer, GradingOptions, Interface, Material};
///
/// let steel = Material::new(210e9, 0.3)?;
/// // Young's modulus falls linearly from 400 GPa to the steel's over 2 µm.
/// let coating = GradedLayer::new(2e-6, Interface::Bonded, |z| {
///     Material::new(400e9 - 190e9 * z / 2e-6, 0.3)
/// })?;
/// let split = coating.split(&[], Base::HalfSpace(steel), &GradingOptions::default())?;
/// assert!(split.error_estimate <= 1e-4 && split.sublayers < 200);
/// // Long waves do not see the coating: C → 2 (1 − ν²)/(E k), with a remainder of order k H = 2e-6.
/// let steel_alone = 2.0 * 0.91 / 210e9;
/// assert!((split.foundation.compliance(1.0) / steel_alone - 1.0).abs() < 2e-6);
/// # Ok::<(), pellicle_kernel::KernelError>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct GradedLayer<F> {
    thickness: f64,
    interface: Interface,
    profile: F,
}

/// Options for splitting a graded layer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GradingOptions {
    /// Relative error of `C(k)` that the splitting may cause; 1e-4 by default. The error is of second order: a
    /// hundredth of it takes ten times as many sublayers.
    pub tolerance: f64,
    /// Largest `k H` at which the tolerance holds, with the layer's thickness `H`; 100 by default, waves of a sixteenth
    /// of the thickness.
    pub largest_wavenumber: f64,
    /// Largest number of sublayers; 1000 by default, and never fewer than 8. The work of splitting grows with its
    /// square.
    pub most_sublayers: usize,
}

/// A graded layer split into sublayers, with the bodies below it.
#[derive(Debug, Clone, PartialEq)]
pub struct SplitLayer {
    /// The sublayers and everything below as one foundation.
    pub foundation: Foundation,
    /// Number of sublayers that replace the graded layer.
    pub sublayers: usize,
    /// Estimated relative error of `C(k)` caused by the splitting.
    pub error_estimate: f64,
}

impl Default for GradingOptions {
    fn default() -> Self {
        Self {
            tolerance: 1e-4,
            largest_wavenumber: 100.0,
            most_sublayers: 1000,
        }
    }
}

impl<F: Fn(f64) -> Result<Material, KernelError>> GradedLayer<F> {
    /// A layer of `thickness` (m) on an `interface`; `profile` gives the material at a depth (m) below its top and is
    /// called only inside it. It should be smooth; convergence is slow across a jump.
    ///
    /// # Errors
    ///
    /// [`KernelError::Thickness`] if the thickness is not positive and finite.
    pub fn new(thickness: f64, interface: Interface, profile: F) -> Result<Self, KernelError> {
        if !(thickness.is_finite() && thickness > 0.0) {
            return Err(KernelError::Thickness { found: thickness });
        }
        Ok(Self {
            thickness,
            interface,
            profile,
        })
    }

    /// Splits the layer, on top of `layers` (surface down) and a `base`, until `C(k)` has converged.
    ///
    /// The cost is dominated by a few evaluations of `C` of `n` layers for each of the `n` sublayers, at 4 wavenumbers
    /// per decade. Accuracy: `an_exponential_layer_converges_to_its_closed_form`.
    ///
    /// # Errors
    ///
    /// [`KernelError::Grading`] if the tolerance is not reached with the allowed number of sublayers, or if the
    /// tolerance is not positive; any error of `profile` or of [`Foundation::new`].
    pub fn split(
        &self,
        layers: &[Layer],
        base: Base,
        options: &GradingOptions,
    ) -> Result<SplitLayer, KernelError> {
        let splitting = Splitting {
            layer: self,
            layers,
            base,
            wavenumbers: wavenumbers(options.largest_wavenumber, self.thickness),
        };
        let mut cells = even_cells(self.thickness);
        loop {
            let changes = splitting.changes(&cells)?;
            let error = error_of_halves(&changes);
            if error <= options.tolerance {
                return splitting.finish(&halved(&cells, |_| true), error);
            }
            let largest: Vec<f64> = changes.iter().map(|change| largest(change)).collect();
            let worst = self::largest(&largest);
            let finer = halved(&cells, |i| largest[i] >= WORTH_HALVING * worst);
            if 2 * finer.len() > options.most_sublayers || !error.is_finite() {
                return Err(KernelError::Grading {
                    sublayers: cells.len(),
                    reached: error,
                    wanted: options.tolerance,
                });
            }
            cells = finer;
        }
    }
}

/// Sublayers that change `C` by at least this fraction of the largest change are halved together: one halving reduces
/// the change of a sublayer 4 to 8 times, so the others among them would be the worst next.
const WORTH_HALVING: f64 = 0.2;

/// Top and bottom of a sublayer, m below the top of the graded layer.
type DepthRange = (f64, f64);

/// The initial four sublayers of equal thickness.
fn even_cells(thickness: f64) -> Vec<DepthRange> {
    let cut = |i: u8| thickness * f64::from(i) / 4.0;
    (0..4).map(|i| (cut(i), cut(i + 1))).collect()
}

fn halves((top, bottom): DepthRange) -> [DepthRange; 2] {
    let middle = 0.5 * (top + bottom);
    [(top, middle), (middle, bottom)]
}

fn halved(cells: &[DepthRange], wanted: impl Fn(usize) -> bool) -> Vec<DepthRange> {
    let pieces = |(i, &cell): (usize, &DepthRange)| {
        if wanted(i) {
            halves(cell).to_vec()
        } else {
            vec![cell]
        }
    };
    cells.iter().enumerate().flat_map(pieces).collect()
}

/// Four wavenumbers per decade from `k H = 0.01` to the largest.
fn wavenumbers(largest: f64, thickness: f64) -> Vec<f64> {
    let step = 10_f64.powf(0.25);
    let grid = std::iter::successors(Some(0.01), |kh| Some(kh * step));
    grid.take_while(|&kh| kh < largest)
        .chain([largest])
        .map(|kh| kh / thickness)
        .collect()
}

fn largest(values: &[f64]) -> f64 {
    values
        .iter()
        .fold(0.0, |largest, value| value.abs().max(largest))
}

/// `max_k Σᵢ |δᵢ(k)| / 2`, NaN if any change is NaN.
fn error_of_halves(changes: &[Vec<f64>]) -> f64 {
    let count = changes.first().map_or(0, Vec::len);
    let sums = (0..count).map(|j| changes.iter().map(|change| change[j].abs()).sum::<f64>() / 2.0);
    sums.fold(0.0, |largest: f64, sum| {
        if sum <= largest || largest.is_nan() {
            largest
        } else {
            sum
        }
    })
}

/// A graded layer, the bodies below it, and the wavenumbers at which the compliance is compared.
struct Splitting<'a, F> {
    layer: &'a GradedLayer<F>,
    layers: &'a [Layer],
    base: Base,
    wavenumbers: Vec<f64>,
}

impl<F: Fn(f64) -> Result<Material, KernelError>> Splitting<'_, F> {
    /// `δᵢ(k) = Cᵢ(k)/C(k) − 1` by sublayer and wavenumber, where `Cᵢ` has sublayer `i` halved.
    fn changes(&self, cells: &[DepthRange]) -> Result<Vec<Vec<f64>>, KernelError> {
        let present = self.compliances(cells)?;
        let change = |i| {
            let finer = self.compliances(&halved(cells, |j| j == i))?;
            let pairs = finer.iter().zip(&present);
            Ok(pairs
                .map(|(finer, present)| finer / present - 1.0)
                .collect())
        };
        (0..cells.len()).map(change).collect()
    }

    fn compliances(&self, cells: &[DepthRange]) -> Result<Vec<f64>, KernelError> {
        let foundation = self.foundation(cells)?;
        Ok(self
            .wavenumbers
            .iter()
            .map(|&k| foundation.compliance(k))
            .collect())
    }

    fn finish(&self, cells: &[DepthRange], error_estimate: f64) -> Result<SplitLayer, KernelError> {
        Ok(SplitLayer {
            foundation: self.foundation(cells)?,
            sublayers: cells.len(),
            error_estimate,
        })
    }

    fn foundation(&self, cells: &[DepthRange]) -> Result<Foundation, KernelError> {
        let last = cells.len() - 1;
        let sublayer = |(i, &(top, bottom)): (usize, &DepthRange)| {
            let material = (self.layer.profile)(0.5 * (top + bottom))?;
            let interface = if i == last {
                self.layer.interface
            } else {
                Interface::Bonded
            };
            Layer::new(bottom - top, material, interface)
        };
        let sublayers = cells.iter().enumerate().map(sublayer);
        let layers: Result<Vec<_>, _> = sublayers
            .chain(self.layers.iter().copied().map(Ok))
            .collect();
        Foundation::new(layers?, self.base)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `k`, `C(k)` of `E = 4 e^{−1.5 z}`, `ν = 0.25`, `z < 1`, bonded to `E = 0.9`, `ν = 0.3`.
    ///
    /// In tractions divided by `e^{−1.5 z}` the equations have constant coefficients, so their solution is one matrix
    /// exponential, computed with mpmath to 60 digits or more.
    const EXPONENTIAL: [(f64, f64); 8] = [
        (0.01, 201.595_992_673_744_15),
        (0.1, 19.675_552_556_496_5),
        (0.5, 3.559_247_913_112_484_5),
        (1.0, 1.510_491_452_400_118_5),
        (2.0, 0.537_284_244_319_398_4),
        (5.0, 0.134_417_460_704_398_47),
        (10.0, 0.056_010_329_060_881_896),
        (30.0, 0.016_569_664_036_924_936),
    ];

    fn exponential(tolerance: f64) -> SplitLayer {
        let profile = |z: f64| Material::new(4.0 * (-1.5 * z).exp(), 0.25);
        let layer = GradedLayer::new(1.0, Interface::Bonded, profile).unwrap();
        let base = Base::HalfSpace(Material::new(0.9, 0.3).unwrap());
        let options = GradingOptions {
            tolerance,
            largest_wavenumber: 30.0,
            ..GradingOptions::default()
        };
        layer.split(&[], base, &options).unwrap()
    }

    fn worst_error(split: &SplitLayer) -> f64 {
        let errors = EXPONENTIAL.map(|(k, wanted)| split.foundation.compliance(k) / wanted - 1.0);
        largest(&errors)
    }

    #[test]
    fn an_exponential_layer_converges_to_its_closed_form() {
        for tolerance in [1e-3, 1e-4, 1e-5] {
            let split = exponential(tolerance);
            let error = worst_error(&split);
            println!(
                "{tolerance:e} {} {:e} {error:e}",
                split.sublayers, split.error_estimate
            );
            assert!(
                error <= split.error_estimate && split.error_estimate <= tolerance,
                "{error:e}"
            );
            // The estimate adds magnitudes, so it is larger, but not by orders of magnitude.
            assert!(error >= 0.02 * split.error_estimate, "{error:e}");
        }
    }

    #[test]
    fn splitting_is_of_second_order() {
        let (coarse, fine) = (exponential(1e-3), exponential(1e-5));
        let finer = |split: &SplitLayer| f64::from(u32::try_from(split.sublayers).unwrap());
        // 100 times the accuracy for about 10 times the sublayers
        let growth = finer(&fine) / finer(&coarse);
        assert!((5.0..20.0).contains(&growth), "{growth}");
    }

    #[test]
    fn a_homogeneous_profile_needs_no_refinement() {
        let material = Material::new(3.0, 0.4).unwrap();
        let base = Base::HalfSpace(Material::new(1.0, 0.2).unwrap());
        let below = Layer::new(0.2, Material::new(5.0, 0.1).unwrap(), Interface::Bonded).unwrap();
        for interface in [Interface::Bonded, Interface::Frictionless] {
            let layer = GradedLayer::new(0.5, interface, |_| Ok(material)).unwrap();
            let split = layer
                .split(&[below], base, &GradingOptions::default())
                .unwrap();
            let whole = Layer::new(0.5, material, interface).unwrap();
            let whole = Foundation::new(vec![whole, below], base).unwrap();
            assert_eq!(split.sublayers, 8);
            // Eight layers instead of one: roundings
            assert!((split.foundation.response(2.0) / whole.response(2.0) - 1.0).abs() < 3e-15);
        }
    }

    #[test]
    fn too_few_sublayers_are_an_error_with_the_numbers() {
        let layer =
            GradedLayer::new(1.0, Interface::Bonded, |z| Material::new(1.0 + z, 0.3)).unwrap();
        let options = GradingOptions {
            tolerance: 1e-9,
            most_sublayers: 20,
            ..GradingOptions::default()
        };
        let failed = layer.split(&[], Base::Rigid, &options);
        let Err(KernelError::Grading {
            sublayers,
            reached,
            wanted,
        }) = failed
        else {
            panic!("{failed:?}");
        };
        assert!(sublayers <= 20 && reached > wanted);
    }

    #[test]
    fn the_sublayers_allowed_are_used_and_not_exceeded() {
        let (needed, wanted) = (exponential(1e-4).sublayers, 1e-4);
        let profile = |z: f64| Material::new(4.0 * (-1.5 * z).exp(), 0.25);
        let layer = GradedLayer::new(1.0, Interface::Bonded, profile).unwrap();
        let base = Base::HalfSpace(Material::new(0.9, 0.3).unwrap());
        let within = |most_sublayers| {
            let options = GradingOptions {
                tolerance: wanted,
                largest_wavenumber: 30.0,
                most_sublayers,
            };
            layer.split(&[], base, &options)
        };
        assert_eq!(within(needed).unwrap().sublayers, needed);
        assert!(matches!(
            within(needed - 1),
            Err(KernelError::Grading { .. })
        ));
    }

    #[test]
    fn the_compliance_is_compared_at_four_wavenumbers_a_decade() {
        let found = wavenumbers(50.0, 2.0);
        // k H from 0.01 to 10^1.5, then the largest, at H = 2
        assert_eq!(found.len(), 16);
        assert!((found[15] - 25.0).abs() <= 0.0);
        for (i, k) in (0..15).zip(&found) {
            // fifteen roundings of the ratio
            assert!((k / (0.005 * 10_f64.powf(0.25 * f64::from(i))) - 1.0).abs() < 1e-14);
        }
        assert_eq!(wavenumbers(0.01, 2.0), [0.005]);
    }

    #[test]
    fn the_error_of_halving_is_half_the_summed_changes_at_the_worst_wavenumber() {
        let changes = [vec![1.0, -2.0, 0.0], vec![3.0, 4.0, 1.0]];
        assert!((error_of_halves(&changes) - 3.0).abs() <= 0.0);
        assert!(error_of_halves(&[vec![f64::NAN, 1.0], vec![0.0, 1.0]]).is_nan());
    }

    #[test]
    fn an_error_in_the_profile_is_returned() {
        let layer = GradedLayer::new(1.0, Interface::Bonded, |z| {
            Material::new(1.0 - 2.0 * z, 0.3)
        })
        .unwrap();
        let failed = layer.split(&[], Base::Rigid, &GradingOptions::default());
        assert!(matches!(failed, Err(KernelError::YoungModulus { .. })));
    }
}
