//! Values kept in memory, up to a limit.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use blake3::Hash;

/// Values of one type by key; finding one among a hundred thousand takes no longer than among ten.
#[derive(Debug)]
pub(super) struct Memory<T> {
    /// Bytes that the values may take in total.
    limit: usize,
    entries: Mutex<Entries<T>>,
}

#[derive(Debug)]
struct Entries<T> {
    by_key: BTreeMap<[u8; 32], KeptEntry<T>>,
    /// Keys by time of last use.
    by_use: BTreeMap<u64, [u8; 32]>,
    /// The time: number of uses so far.
    uses: u64,
    bytes: usize,
}

#[derive(Debug)]
struct KeptEntry<T> {
    value: Arc<T>,
    bytes: usize,
    /// Time of its last use.
    used: u64,
}

impl<T> Memory<T> {
    pub(super) fn new(limit: usize) -> Self {
        let entries = Entries {
            by_key: BTreeMap::new(),
            by_use: BTreeMap::new(),
            uses: 0,
            bytes: 0,
        };
        Self {
            limit,
            entries: Mutex::new(entries),
        }
    }

    /// The value of a key, if it is there.
    pub(super) fn get(&self, key: &Hash) -> Option<Arc<T>> {
        let mut entries = self.lock();
        let KeptEntry { value, bytes, .. } = entries.remove(key.as_bytes())?;
        entries.put(*key.as_bytes(), value.clone(), bytes);
        Some(value)
    }

    /// Keeps a value of about `bytes` bytes; the least recently used ones make room.
    pub(super) fn insert(&self, key: Hash, value: &Arc<T>, bytes: usize) {
        if bytes > self.limit {
            return;
        }
        let mut entries = self.lock();
        entries.remove(key.as_bytes());
        entries.put(*key.as_bytes(), value.clone(), bytes);
        while entries.bytes > self.limit {
            let Some((_, oldest)) = entries.by_use.pop_first() else {
                return;
            };
            entries.remove(&oldest);
        }
    }

    fn lock(&self) -> MutexGuard<'_, Entries<T>> {
        self.entries.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<T> Entries<T> {
    fn remove(&mut self, key: &[u8; 32]) -> Option<KeptEntry<T>> {
        let entry = self.by_key.remove(key)?;
        self.by_use.remove(&entry.used);
        self.bytes -= entry.bytes;
        Some(entry)
    }

    /// Adds a missing entry as the most recently used one.
    fn put(&mut self, key: [u8; 32], value: Arc<T>, bytes: usize) {
        self.uses += 1;
        let used = self.uses;
        self.bytes += bytes;
        self.by_use.insert(used, key);
        self.by_key.insert(key, KeptEntry { value, bytes, used });
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::{Hash, Memory};

    fn key(number: u8) -> Hash {
        blake3::hash(&[number])
    }

    #[test]
    fn the_least_recently_used_value_is_evicted() {
        let memory = Memory::new(30);
        for number in 0..3 {
            memory.insert(key(number), &Arc::new(number), 10);
        }
        assert_eq!(memory.get(&key(0)).as_deref(), Some(&0));
        memory.insert(key(3), &Arc::new(3), 10);
        let found: Vec<_> = (0..4).map(|n| memory.get(&key(n)).is_some()).collect();
        assert_eq!(found, [true, false, true, true]);
    }

    #[test]
    fn a_value_stored_twice_counts_once() {
        let memory = Memory::new(30);
        for _ in 0..5 {
            memory.insert(key(0), &Arc::new(0), 10);
        }
        memory.insert(key(1), &Arc::new(1), 20);
        assert!(memory.get(&key(0)).is_some() && memory.get(&key(1)).is_some());
        let entries = memory.lock();
        assert_eq!((entries.by_key.len(), entries.by_use.len()), (2, 2));
        assert_eq!(entries.bytes, 30);
    }

    #[test]
    fn a_value_that_is_too_large_is_not_stored() {
        let memory = Memory::new(30);
        memory.insert(key(0), &Arc::new(0), 1);
        memory.insert(key(1), &Arc::new(1), 31);
        assert!(memory.get(&key(1)).is_none());
        assert!(memory.get(&key(0)).is_some());
    }
}
