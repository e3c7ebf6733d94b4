//! The cache returns the stored data to the bit, and damage to the disk costs no more than time.

#![expect(
    clippy::unwrap_used,
    reason = "a scene that cannot be built fails its test"
)]

mod contents;
mod damage;
mod folder;
mod scene;
mod together;
