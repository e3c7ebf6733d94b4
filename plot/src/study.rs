//! Pictures of many cases: a number of their results over the keys that vary.

pub mod curves;
pub mod map;
pub mod sample;
