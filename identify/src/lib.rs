//! Identification of the parameters of a layered contact from measured curves.
//!
#![doc = include_str!("../README.md")]
#![cfg_attr(
    test,
    allow(
        clippy::float_cmp,
        reason = "tests compare numbers that are exact in binary"
    )
)]
