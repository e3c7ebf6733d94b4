//! Points as lists in a file, for `#[serde(with)]`: serde does not support arrays of generic length.

use serde::de::{Deserialize, Deserializer, Error};
use serde::ser::{SerializeSeq, Serializer};

/// Writes a point as a list.
///
/// # Errors
///
/// Those of the serializer.
pub fn serialize<S: Serializer, const AXES: usize>(
    point: &[f64; AXES],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    let mut list = serializer.serialize_seq(Some(AXES))?;
    for along in point {
        list.serialize_element(along)?;
    }
    list.end()
}

/// Reads a point, with `null` as NaN.
///
/// # Errors
///
/// Those of the deserializer if there is no list of as many numbers.
pub fn deserialize<'de, D: Deserializer<'de>, const AXES: usize>(
    deserializer: D,
) -> Result<[f64; AXES], D::Error> {
    let list = Vec::<Option<f64>>::deserialize(deserializer)?;
    let list: Vec<f64> = list.iter().map(|along| along.unwrap_or(f64::NAN)).collect();
    list.try_into()
        .map_err(|list: Vec<f64>| Error::invalid_length(list.len(), &"the axes of a point"))
}
