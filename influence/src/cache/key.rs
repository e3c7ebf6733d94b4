//! The name of data: a hash of everything that determines them.

use blake3::Hasher;
use pellicle_kernel::{Base, Foundation, Interface, Material};

/// Version of the files' layout and of the order of the numbers in them. To be raised whenever either changes.
pub(super) const FORMAT: u32 = 2;

/// Version of the numbers. To be raised whenever, for any foundation and grid, a coefficient or a number of the radial tables may
/// change by a single bit: a change in this crate's or the kernel's arithmetic, tolerances or panels. The test
/// `the_algorithm_has_the_version_of_its_numbers` in this crate's `tests/cache/contents.rs` notices most of them.
const ALGORITHM: u32 = 3;

/// Name of data, 256 bits: different for any difference in what determines them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Key(pub(super) blake3::Hash);

/// What is named.
#[derive(Clone, Copy, Debug)]
pub(super) enum Kind {
    Tables,
    Coefficients { element_side: f64, size: usize },
}

impl Key {
    /// The key of data of one foundation.
    pub(super) fn new(foundation: &Foundation, kind: Kind) -> Self {
        let mut hasher = Hasher::new();
        hash_versions(&mut hasher);
        match kind {
            Kind::Tables => hash_words(&mut hasher, [0, 0, 0]),
            Kind::Coefficients { element_side, size } => {
                hash_words(&mut hasher, [1, element_side.to_bits(), size as u64]);
            }
        }
        hash_foundation(&mut hasher, foundation);
        Self(hasher.finalize())
    }
}

/// The release, and the platform, whose exponentials and logarithms may differ in the last bit.
fn hash_versions(hasher: &mut Hasher) {
    hash_words(hasher, [FORMAT, ALGORITHM].map(u64::from));
    let texts = [
        env!("CARGO_PKG_NAME"),
        env!("CARGO_PKG_VERSION"),
        std::env::consts::ARCH,
        std::env::consts::OS,
    ];
    for text in texts {
        hash_words(hasher, [text.len() as u64]);
        hasher.update(text.as_bytes());
    }
}

fn hash_foundation(hasher: &mut Hasher, foundation: &Foundation) {
    hash_words(hasher, [foundation.layers().len() as u64]);
    for layer in foundation.layers() {
        let interface = match layer.interface() {
            Interface::Bonded => 0,
            Interface::Frictionless => 1,
        };
        hash_words(hasher, [interface, layer.thickness().to_bits()]);
        hash_material(hasher, layer.material());
    }
    match foundation.base() {
        Base::Rigid => hash_words(hasher, [0]),
        Base::HalfSpace(material) => {
            hash_words(hasher, [1]);
            hash_material(hasher, material);
        }
    }
}

fn hash_material(hasher: &mut Hasher, material: Material) {
    let numbers = [material.young_modulus(), material.poisson_ratio()];
    hash_words(hasher, numbers.map(f64::to_bits));
}

fn hash_words<const N: usize>(hasher: &mut Hasher, words: [u64; N]) {
    for word in words {
        hasher.update(&word.to_le_bytes());
    }
}

#[cfg(test)]
mod tests {
    use pellicle_kernel::{Base, Foundation, Interface, Layer, Material};

    use super::{Key, Kind};

    /// One layer on a half-space or a rigid base, of these numbers.
    fn key([thickness, e1, nu1, e2, nu2]: [f64; 5], interface: Interface, rigid: bool) -> Key {
        let material = |e, nu| Material::new(e, nu).unwrap();
        let layer = Layer::new(thickness, material(e1, nu1), interface).unwrap();
        let base = if rigid {
            Base::Rigid
        } else {
            Base::HalfSpace(material(e2, nu2))
        };
        let foundation = Foundation::new(vec![layer], base).unwrap();
        Key::new(&foundation, Kind::Tables)
    }

    #[test]
    fn any_bit_of_the_foundation_changes_the_key() {
        let numbers = [1e-6, 400e9, 0.25, 210e9, 0.3];
        let mut keys = vec![
            key(numbers, Interface::Bonded, false),
            key(numbers, Interface::Frictionless, false),
            key(numbers, Interface::Bonded, true),
        ];
        for i in 0..numbers.len() {
            let mut other = numbers;
            other[i] = other[i].next_up();
            keys.push(key(other, Interface::Bonded, false));
        }
        for (i, key) in keys.iter().enumerate() {
            assert!(!keys[..i].contains(key), "{i}");
        }
        assert_eq!(key(numbers, Interface::Bonded, false), keys[0]);
    }

    #[test]
    fn the_grid_changes_the_key() {
        let foundation = Foundation::half_space(Material::new(1.0, 0.3).unwrap());
        let grid = |element_side, size| {
            let kind = Kind::Coefficients { element_side, size };
            Key::new(&foundation, kind)
        };
        let first = grid(0.1, 64);
        assert_eq!(first, grid(0.1, 64));
        let tables = Key::new(&foundation, Kind::Tables);
        for other in [grid(0.1_f64.next_up(), 64), grid(0.1, 65), tables] {
            assert_ne!(first, other);
        }
    }
}
