//! A target for each reader: its bench, and the bytes that libFuzzer invents in the place of its file.

pub use libfuzzer_sys;
pub use pellicle_tests::bytes::{Bench, readers};

/// Defines the target of the reader of this name.
#[macro_export]
macro_rules! target {
    ($name:literal) => {
        thread_local! {
            static BENCH: $crate::Bench = $crate::Bench::new($crate::readers::named($name).expect("a reader"));
        }
        $crate::libfuzzer_sys::fuzz_target!(|bytes: &[u8]| {
            BENCH.with(|bench| {
                let _has_value = bench.has_value(bytes);
            });
        });
    };
}
