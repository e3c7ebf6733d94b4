//! `.npy`: one two-dimensional NumPy array, first index along x.

use super::error::MapError;
use super::grid_points::{self, PointsError};
use super::map_file::MapFile;
use super::npy_header::NpyHeader;

/// Reads the array, of floats or integers in either byte order and either axis order.
///
/// # Errors
///
/// [`MapError::Npy`] if the file has no such array; arrays of objects or complex numbers are not read.
pub fn parse(bytes: &[u8]) -> Result<MapFile, MapError> {
    let header = NpyHeader::read(bytes)?;
    let kind = NumberType::named(&header.kind)?;
    let [along_x, along_y] = header.shape[..] else {
        let found = header.shape.len();
        return Err(MapError::Npy(format!("it has {found} dimensions")));
    };
    let (count, size) = (along_x.checked_mul(along_y), kind.size);
    if count == Some(0) {
        return Err(MapError::Empty);
    }
    let data = &bytes[header.length..];
    if count.and_then(|count| count.checked_mul(size)) != Some(data.len()) {
        return Err(MapError::Npy(format!(
            "its header says {along_x} × {along_y} numbers of {size} bytes, and {} bytes follow",
            data.len()
        )));
    }
    let at = |n: usize| kind.number(&data[n * size..(n + 1) * size]);
    let heights: Vec<f64> = if header.is_fortran {
        // The file goes column by column, the map row by row.
        let row = |i: usize| (0..along_y).map(move |j| at(i + j * along_x));
        (0..along_x).flat_map(row).collect()
    } else {
        (0..along_x * along_y).map(at).collect()
    };
    Ok(MapFile::of_array([along_x, along_y], heights)?)
}

impl MapFile {
    /// Creates the map of a NumPy array, value `(i, j)` at `i * shape[1] + j`: rows of heights, first index along x, or
    /// rows of three, the points x, y, z of a regular grid.
    ///
    /// # Errors
    ///
    /// [`PointsError`] for eight or more rows of three that form no grid: no map is three samples wide.
    pub fn of_array(shape: [usize; 2], values: Vec<f64>) -> Result<Self, PointsError> {
        const OTHERWISE: &str = "if each row is three heights, save the array transposed";
        if shape[1] != 3 {
            return Ok(Self::bare(shape, values));
        }
        match grid_points::map(&values) {
            Ok(map) => Ok(map),
            Err(_) if !grid_points::are_points(&values) => Ok(Self::bare(shape, values)),
            Err(reason) => Err(PointsError {
                lines: shape[0],
                reason,
                otherwise: OTHERWISE,
            }),
        }
    }
}

/// A type of number, by NumPy's name: `<f8` is a little-endian float of 8 bytes.
#[derive(Clone, Copy)]
struct NumberType {
    class: NumberClass,
    size: usize,
    is_big_endian: bool,
}

#[derive(Clone, Copy)]
enum NumberClass {
    Float,
    Signed,
    Unsigned,
}

impl NumberType {
    fn named(name: &str) -> Result<Self, MapError> {
        let (order, class_and_size) = name.split_at_checked(1).unwrap_or_default();
        let (class, size) = match class_and_size {
            "f2" => (NumberClass::Float, 2),
            "f4" => (NumberClass::Float, 4),
            "f8" => (NumberClass::Float, 8),
            "i1" => (NumberClass::Signed, 1),
            "i2" => (NumberClass::Signed, 2),
            "i4" => (NumberClass::Signed, 4),
            "i8" => (NumberClass::Signed, 8),
            "u1" => (NumberClass::Unsigned, 1),
            "u2" => (NumberClass::Unsigned, 2),
            "u4" => (NumberClass::Unsigned, 4),
            "u8" => (NumberClass::Unsigned, 8),
            _ => {
                return Err(MapError::Npy(format!(
                    "its elements are of the type \"{name}\", wanted floats or integers of at most 64 bits"
                )));
            }
        };
        Ok(Self {
            class,
            size,
            is_big_endian: order == ">",
        })
    }

    fn number(self, bytes: &[u8]) -> f64 {
        let push = |bits: u64, byte: &u8| (bits << 8) | u64::from(*byte);
        let bits = if self.is_big_endian {
            bytes.iter().fold(0, push)
        } else {
            bytes.iter().rev().fold(0, push)
        };
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_possible_wrap,
            reason = "the bits of a number of this size"
        )]
        match (self.class, self.size) {
            (NumberClass::Unsigned, _) => bits as f64,
            (NumberClass::Signed, size) => {
                // The sign is the highest of the number's bits.
                let above = 64 - 8 * size;
                (((bits << above) as i64) >> above) as f64
            }
            (NumberClass::Float, 2) => half(bits as u16),
            (NumberClass::Float, 4) => f64::from(f32::from_bits(bits as u32)),
            (NumberClass::Float, _) => f64::from_bits(bits),
        }
    }
}

/// Decodes a float of 16 bits: sign, 5 bits of exponent, 10 of fraction (IEEE 754, binary16).
fn half(bits: u16) -> f64 {
    let fraction = f64::from(bits & 0x3ff);
    let size = match (bits >> 10) & 0x1f {
        0 => fraction * 2_f64.powi(-24),
        31 if fraction == 0.0 => f64::INFINITY,
        31 => f64::NAN,
        exponent => (1.0 + fraction / 1024.0) * 2_f64.powi(i32::from(exponent) - 15),
    };
    if bits >> 15 == 1 { -size } else { size }
}

#[cfg(test)]
mod tests {
    use ndarray::{Array2, ShapeBuilder, array};
    use ndarray_npy::WriteNpyExt;

    use super::super::npy_header::tests::file;
    use super::*;

    fn bytes(array: &impl WriteNpyExt) -> Vec<u8> {
        let mut bytes = Vec::new();
        array.write_npy(&mut bytes).unwrap();
        bytes
    }

    #[test]
    fn arrays_of_every_type_and_order_are_read_with_the_first_index_along_x() {
        let mut fortran = Array2::<f64>::zeros((3, 2).f());
        fortran.assign(&array![[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]]);
        let files = [
            bytes(&array![[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]]),
            bytes(&fortran),
            bytes(&array![[1.0_f32, 2.0], [3.0, 4.0], [5.0, 6.0]]),
            bytes(&array![[1_u16, 2], [3, 4], [5, 6]]),
            bytes(&array![[1_i64, 2], [3, 4], [5, 6]]),
            bytes(&array![[1_i8, 2], [3, 4], [5, 6]]),
            bytes(&array![[1_u64, 2], [3, 4], [5, 6]]),
        ];
        for file in files {
            let map = parse(&file).unwrap();
            assert_eq!(map.shape, [3, 2]);
            assert_eq!(map.heights, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
        }
    }

    #[test]
    fn every_sign_size_and_byte_order_is_decoded() {
        let values = |kind: &str, data: &[u8]| {
            let header =
                format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': (2, 1), }}");
            parse(&file(&header, data)).unwrap().heights
        };
        assert_eq!(values("|i1", &[0xff, 0x7f]), [-1.0, 127.0]);
        assert_eq!(values(">i2", &[0xff, 0xfe, 1, 0]), [-2.0, 256.0]);
        assert_eq!(values("<u2", &[0xff, 0xff, 1, 0]), [65535.0, 1.0]);
        // 1.5 and −2⁻²⁴, which has the smallest magnitude.
        assert_eq!(values("<f2", &[0, 0x3e, 1, 0x80]), [1.5, -2_f64.powi(-24)]);
        assert_eq!(values(">f2", &[0x7b, 0xff, 0x35, 0]), [65504.0, 0.3125]);
        assert_eq!(
            values(">f4", &[0xc0, 0, 0, 0, 0x3f, 0x80, 0, 0]),
            [-2.0, 1.0]
        );
    }

    #[test]
    fn an_unsupported_type_is_named() {
        for kind in ["<c16", "|b1", "<U7", "|O", "<f16", "", "<M8[ns]"] {
            let header =
                format!("{{'descr': '{kind}', 'fortran_order': False, 'shape': (1, 1), }}");
            let message = parse(&file(&header, &[0; 16])).unwrap_err().to_string();
            assert!(message.contains(&format!("type \"{kind}\"")), "{message}");
        }
    }

    #[test]
    fn invalid_or_not_two_dimensional_arrays_are_rejected() {
        let whole = bytes(&array![[1.0, 2.0]]);
        let promising = String::from_utf8_lossy(&whole).replace("(1, 2), ", "(1, 9999999999), ");
        let files = [
            bytes(&array![1.0, 2.0]),
            bytes(&array![[true]]),
            bytes(&Array2::<f64>::zeros((0, 3))),
            whole[..whole.len() - 1].to_vec(),
            promising.into_bytes(),
            b"no array".to_vec(),
            Vec::new(),
        ];
        for (i, file) in files.iter().enumerate() {
            assert!(parse(file).is_err(), "{i}");
        }
    }
}
