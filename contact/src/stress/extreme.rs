//! One extreme of a stress.

use serde::{Deserialize, Serialize};

use crate::nan_from_null;

/// An extreme of a stress: at a point (x, y, z) of a body, or (x, y) of an interface.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Extreme<const AXES: usize> {
    /// Value, in Pa.
    #[serde(deserialize_with = "nan_from_null")]
    pub value: f64,
    /// Place, in m.
    #[serde(with = "point")]
    pub at: [f64; AXES],
    /// Whether the value settles as the grid is refined.
    pub resolved: bool,
    /// Half-width of the interval around the value that contains the truth, in Pa; none with a single grid.
    pub estimate: Option<f64>,
}

impl Extreme<2> {
    /// Places the extreme of an interface at a depth (m) in space.
    pub(super) fn at_depth(self, depth: f64) -> Extreme<3> {
        let Self {
            value,
            at: [x, y],
            resolved,
            estimate,
        } = self;
        Extreme {
            value,
            at: [x, y, depth],
            resolved,
            estimate,
        }
    }
}

/// Points as lists: serde does not support arrays of generic length.
mod point {
    use serde::de::{Deserialize, Deserializer, Error};
    use serde::ser::{SerializeSeq, Serializer};

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

    pub fn deserialize<'de, D: Deserializer<'de>, const AXES: usize>(
        deserializer: D,
    ) -> Result<[f64; AXES], D::Error> {
        let list = Vec::<Option<f64>>::deserialize(deserializer)?;
        let list: Vec<f64> = list.iter().map(|along| along.unwrap_or(f64::NAN)).collect();
        list.try_into()
            .map_err(|list: Vec<f64>| Error::invalid_length(list.len(), &"the axes of a point"))
    }
}
