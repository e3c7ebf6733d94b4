//! The arenas from which the C library gives threads their memory.

/// Starts the program again with one arena for all threads if its address space is limited: the C library would
/// reserve 64 MB for each thread as long as they fit, so more address space would leave less memory.
#[cfg(target_os = "linux")]
pub fn share() {
    use std::env;
    use std::os::unix::process::CommandExt;

    use pellicle::memory::{ARENAS, has_limited_addresses};

    let mut arguments = env::args_os();
    if let (true, None, Some(name), Ok(program)) = (
        has_limited_addresses(),
        env::var_os(ARENAS),
        arguments.next(),
        env::current_exe(),
    ) {
        let mut again = std::process::Command::new(program);
        // Returns only if it fails; the program then goes on as it is.
        drop(again.arg0(name).args(arguments).env(ARENAS, "1").exec());
    }
}

/// Other systems are not asked for the memory they leave.
#[cfg(not(target_os = "linux"))]
pub fn share() {}
