//! `.npy`: one array of NumPy in two dimensions, first index along x.

use ndarray::Array2;
use ndarray_npy::{ReadNpyError, ReadNpyExt, ReadableElement};

use super::{MapError, MapFile};

/// Reads an array of one kind of numbers.
type Reader = fn(&[u8]) -> Result<Array2<f64>, ReadNpyError>;

/// Reads the array, of floats or integers in either order of bytes and of axes.
///
/// # Errors
///
/// [`MapError::Npy`] if there is no such array; an array of objects or of complex numbers is none.
pub fn parse(bytes: &[u8]) -> Result<MapFile, MapError> {
    check_length(bytes)?;
    let readers: [Reader; 8] = [
        |bytes| array::<f64>(bytes, |x| x),
        |bytes| array::<f32>(bytes, f64::from),
        |bytes| array::<i16>(bytes, f64::from),
        |bytes| array::<u16>(bytes, f64::from),
        |bytes| array::<i32>(bytes, f64::from),
        |bytes| array::<u32>(bytes, f64::from),
        |bytes| array::<u8>(bytes, f64::from),
        |bytes| array::<i64>(bytes, |x| x as f64),
    ];
    for read in readers {
        match read(bytes) {
            Ok(array) => {
                let (along_x, along_y) = array.dim();
                // Row by row, whatever the order in memory.
                let heights = array.iter().copied().collect();
                return Ok(MapFile::bare([along_x, along_y], heights));
            }
            Err(ReadNpyError::WrongDescriptor(_)) => {}
            Err(error) => return Err(MapError::Npy(error.to_string())),
        }
    }
    Err(MapError::Npy(
        "its elements are neither floats nor integers".into(),
    ))
}

fn array<T: ReadableElement + Copy>(
    bytes: &[u8],
    number: fn(T) -> f64,
) -> Result<Array2<f64>, ReadNpyError> {
    Ok(Array2::<T>::read_npy(bytes)?.mapv(number))
}

/// Refuses a header that promises more elements than the file has bytes, before memory is asked for.
fn check_length(bytes: &[u8]) -> Result<(), MapError> {
    let header = &bytes[..bytes.len().min(1 << 16)];
    let header = String::from_utf8_lossy(header);
    let shape = header
        .split_once("'shape':")
        .and_then(|(_, after)| after.split_once('('))
        .and_then(|(_, after)| after.split_once(')'));
    let Some((shape, _)) = shape else {
        return Err(MapError::Npy("it has no header of NumPy's".into()));
    };
    let sizes = shape
        .split(',')
        .map(str::trim)
        .filter(|size| !size.is_empty());
    let elements = sizes
        .map(str::parse::<usize>)
        .try_fold(1_usize, |product, size| product.checked_mul(size.ok()?));
    match elements {
        Some(0) => Err(MapError::Empty),
        Some(elements) if elements <= bytes.len() => Ok(()),
        _ => Err(MapError::Npy(format!(
            "its header says {}, more than the file holds",
            shape.chars().take(40).collect::<String>()
        ))),
    }
}

#[cfg(test)]
mod tests {
    use ndarray::{ShapeBuilder, array};
    use ndarray_npy::WriteNpyExt;

    use super::*;

    fn bytes(array: &impl WriteNpyExt) -> Vec<u8> {
        let mut bytes = Vec::new();
        array.write_npy(&mut bytes).unwrap();
        bytes
    }

    #[test]
    fn arrays_of_every_number_and_order_are_read_with_the_first_index_along_x() {
        let mut fortran = Array2::<f64>::zeros((3, 2).f());
        fortran.assign(&array![[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]]);
        let files = [
            bytes(&array![[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]]),
            bytes(&fortran),
            bytes(&array![[1.0_f32, 2.0], [3.0, 4.0], [5.0, 6.0]]),
            bytes(&array![[1_u16, 2], [3, 4], [5, 6]]),
            bytes(&array![[1_i64, 2], [3, 4], [5, 6]]),
        ];
        for file in files {
            let map = parse(&file).unwrap();
            assert_eq!(map.shape, [3, 2]);
            assert_eq!(map.heights, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]);
        }
    }

    #[test]
    fn what_is_no_array_in_two_dimensions_is_refused() {
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
