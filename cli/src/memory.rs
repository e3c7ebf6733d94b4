//! The memory available to a case. The system kills a program that takes too much memory, and its results are lost:
//! each case therefore reserves its memory here first, and fails cleanly if there is too little.
//!
//! On Linux the available memory is the least of the free memory and the amounts that the control group and the limits
//! of the process (`ulimit -v`, `-d`) leave. Elsewhere it is unknown, and no case is refused.

use std::env;
use std::fs;
use std::path::Path;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

use crate::failure::Failure;
use crate::forecast::need::Need;
use crate::interrupt;

/// Time after which a case that waits for memory checks whether the user wants to stop.
const PAUSE: Duration = Duration::from_millis(100);

/// Time for which a measured amount stays valid for a case that needs a small part of it.
const KNOWN: Duration = Duration::from_secs(1);
/// The inverse of a small part.
const SMALL_PART: u64 = 64;

/// Address space, bytes, that the C library reserves for one more thread, unless all share one arena.
const ADDRESSES: u64 = 64 << 20;

/// The C library's variable for the number of arenas, from which threads take their memory.
const ARENAS: &str = "MALLOC_ARENA_MAX";

/// Starts the program again with one arena for all threads if its address space is limited: the C library would
/// reserve 64 MB for each thread as long as they fit, so more address space would leave less memory.
#[cfg(target_os = "linux")]
pub fn share_arena() {
    use std::os::unix::process::CommandExt;
    let limits = fs::read_to_string("/proc/self/limits");
    let is_limited = limits.is_ok_and(|limits| number(&limits, ADDRESS_SPACE).is_some());
    let mut arguments = env::args_os();
    if let (true, None, Some(name), Ok(program)) = (
        is_limited,
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
pub fn share_arena() {}

/// Bytes still available to this process; none if unknown.
#[must_use]
pub fn available() -> Option<u64> {
    let read = |path: &str| fs::read_to_string(path).ok();
    let system = read("/proc/meminfo").and_then(|text| free(&text));
    let process = read("/proc/self/limits").zip(read("/proc/self/status"));
    let reserve = if env::var(ARENAS).is_ok_and(|arenas| arenas == "1") {
        0
    } else {
        ADDRESSES
    };
    let process = process.and_then(|(limits, status)| left_by_limits(&limits, &status, reserve));
    let groups = read("/proc/self/cgroup").and_then(|text| left_by_groups(&text));
    [system, process, groups].into_iter().flatten().min()
}

/// Free memory and memory that can be freed, bytes, swap included.
fn free(meminfo: &str) -> Option<u64> {
    let kibibytes = |name| number(meminfo, name).map(|value| value * 1024);
    Some(kibibytes("MemAvailable:")? + kibibytes("SwapFree:").unwrap_or(0))
}

/// The limit on the address space, as the system names it.
const ADDRESS_SPACE: &str = "Max address space";

/// Bytes left within the limits on the process's address space, without `reserve`, and on its data.
fn left_by_limits(limits: &str, status: &str, reserve: u64) -> Option<u64> {
    let left = |limit, used| {
        let used = number(status, used)? * 1024;
        Some(number(limits, limit)?.saturating_sub(used))
    };
    let space = left(ADDRESS_SPACE, "VmSize:").map(|left| left.saturating_sub(reserve));
    let data = left("Max data size", "VmData:");
    [space, data].into_iter().flatten().min()
}

/// The first number after a name at the start of a line.
fn number(text: &str, name: &str) -> Option<u64> {
    let line = text.lines().find_map(|line| line.strip_prefix(name))?;
    line.split_whitespace().next()?.parse().ok()
}

/// Bytes left by the control groups of the process: its own and all above it.
fn left_by_groups(memberships: &str) -> Option<u64> {
    let folders = memberships.lines().filter_map(|line| {
        let (_, rest) = line.split_once(':')?;
        let (controllers, path) = rest.split_once(':')?;
        let root = match controllers {
            "" => "/sys/fs/cgroup",
            list if list.split(',').any(|name| name == "memory") => "/sys/fs/cgroup/memory",
            _ => return None,
        };
        Some((Path::new(root), path.trim_start_matches('/').to_owned()))
    });
    let left = |(root, path): (&Path, String)| {
        let folder = root.join(path);
        let groups = folder
            .ancestors()
            .take_while(|group| group.starts_with(root));
        groups.filter_map(left_by_group).min()
    };
    folders.filter_map(left).min()
}

/// Bytes left by a control group of either version; memory that it could drop counts as free.
fn left_by_group(group: &Path) -> Option<u64> {
    let read = |name: &str| fs::read_to_string(group.join(name)).ok();
    let value = |name: &str| read(name)?.trim().parse::<u64>().ok();
    let droppable = |name: &str| read("memory.stat").and_then(|text| number(&text, name));
    let left = |limit: u64, used: u64, droppable: Option<u64>| {
        limit.saturating_sub(used.saturating_sub(droppable.unwrap_or(0)))
    };
    match (value("memory.max"), value("memory.current")) {
        (Some(limit), Some(used)) => Some(left(limit, used, droppable("inactive_file "))),
        _ => Some(left(
            value("memory.limit_in_bytes")?,
            value("memory.usage_in_bytes")?,
            droppable("total_inactive_file "),
        )),
    }
}

/// The memory shared by the cases of this process.
#[derive(Debug)]
pub struct MemoryBudget {
    known: fn() -> Option<u64>,
    taken: Mutex<Taken>,
    freed: Condvar,
}

#[derive(Debug, Default)]
struct Taken {
    bytes: u64,
    /// Bytes available when nothing was taken, and the time of the measurement.
    of: Option<(Option<u64>, Instant)>,
}

impl Taken {
    /// Unlimited, if unknown.
    fn available(&self) -> u64 {
        self.of.and_then(|(bytes, _)| bytes).unwrap_or(u64::MAX)
    }

    fn is_known_for(&self, need: Need) -> bool {
        let is_recent = |(_, at): (_, Instant)| at.elapsed() < KNOWN;
        self.of.is_some_and(is_recent) && need.bytes <= self.available() / SMALL_PART
    }
}

impl Default for MemoryBudget {
    fn default() -> Self {
        Self::of(available)
    }
}

impl MemoryBudget {
    fn of(known: fn() -> Option<u64>) -> Self {
        Self {
            known,
            taken: Mutex::default(),
            freed: Condvar::new(),
        }
    }

    /// Takes the memory of a case, waiting while other cases hold it; none if the user stops meanwhile.
    ///
    /// # Errors
    ///
    /// [`Failure::Memory`] if the case needs more than is available.
    pub fn take(&self, need: Need) -> Result<Option<MemoryShare<'_>>, Failure> {
        let mut taken = self.lock();
        loop {
            if taken.bytes == 0 && !taken.is_known_for(need) {
                taken.of = Some(((self.known)(), Instant::now()));
            }
            let available = taken.available();
            if need.bytes > available {
                return Err(Failure::Memory {
                    needed: need.bytes,
                    available,
                    fitting: need.fitting(available),
                });
            }
            if need.bytes <= available - taken.bytes {
                break;
            }
            if interrupt::is_requested() {
                return Ok(None);
            }
            let waited = self.freed.wait_timeout(taken, PAUSE);
            taken = waited.unwrap_or_else(PoisonError::into_inner).0;
        }
        taken.bytes += need.bytes;
        Ok(Some(MemoryShare {
            memory: self,
            bytes: need.bytes,
        }))
    }

    fn lock(&self) -> MutexGuard<'_, Taken> {
        self.taken.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// The memory that a case has taken, given back when this is dropped.
#[derive(Debug)]
pub struct MemoryShare<'a> {
    memory: &'a MemoryBudget,
    bytes: u64,
}

impl Drop for MemoryShare<'_> {
    fn drop(&mut self) {
        self.memory.lock().bytes -= self.bytes;
        self.memory.freed.notify_all();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn available_memory_is_the_smallest_of_all_limits() {
        let meminfo = "MemTotal: 900 kB\nMemFree: 10 kB\nMemAvailable:   200 kB\nSwapFree: 50 kB\n";
        assert_eq!(free(meminfo), Some(250 * 1024));
        let status = "Name: a\nVmSize:\t   100 kB\nVmData:\t 30 kB\n";
        let limits = |space: &str| {
            format!(
                "Limit  Soft\nMax data size  81920  unlimited bytes\nMax address space {space} unlimited bytes\n"
            )
        };
        assert_eq!(
            left_by_limits(&limits("unlimited"), status, 0),
            Some(50 * 1024)
        );
        let space = limits(&(ADDRESSES + 120 * 1024).to_string());
        let left = left_by_limits(&space, status, ADDRESSES);
        assert_eq!(left, Some(20 * 1024));
        assert_eq!(left_by_limits(&limits("1"), status, 0), Some(0));
    }

    #[test]
    fn a_control_group_leaves_its_limit_minus_its_usage() {
        let group = tempfile::tempdir().unwrap();
        let write = |name: &str, text: &str| fs::write(group.path().join(name), text).unwrap();
        assert_eq!(left_by_group(group.path()), None);
        write("memory.limit_in_bytes", "1000\n");
        write("memory.usage_in_bytes", "400\n");
        assert_eq!(left_by_group(group.path()), Some(600));
        write("memory.current", "500\n");
        write("memory.max", "2000\n");
        write("memory.stat", "anon 400\ninactive_file 100\n");
        assert_eq!(left_by_group(group.path()), Some(1600));
        write("memory.limit_in_bytes", "nothing");
        write("memory.max", "max\n");
        assert_eq!(left_by_group(group.path()), None);
    }

    #[test]
    fn a_case_waits_for_memory_in_use_and_fails_if_it_could_not_run_alone() {
        let memory = MemoryBudget::of(|| Some(10));
        let need = |bytes| Need { bytes, elements: 1 };
        let first = memory.take(need(6)).unwrap().unwrap();
        let second = memory.take(need(4)).unwrap().unwrap();
        assert!(matches!(
            memory.take(need(11)),
            Err(Failure::Memory { available: 10, .. })
        ));
        std::thread::scope(|scope| {
            let third = scope.spawn(|| memory.take(need(5)).unwrap().unwrap().bytes);
            drop(second);
            assert!(!third.is_finished());
            drop(first);
            assert_eq!(third.join().unwrap(), 5);
        });
        assert_eq!(memory.lock().bytes, 0);
    }
}
