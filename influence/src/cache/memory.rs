//! Values kept in memory, up to a limit.

use std::sync::{Arc, Mutex, PoisonError};

use blake3::Hash;

/// Values of one type by key, those used last at the end.
#[derive(Debug)]
pub(super) struct Memory<T> {
    /// Bytes that the values may take together.
    limit: usize,
    entries: Mutex<Vec<KeptEntry<T>>>,
}

#[derive(Debug)]
struct KeptEntry<T> {
    key: Hash,
    value: Arc<T>,
    bytes: usize,
}

impl<T> Memory<T> {
    pub(super) fn new(limit: usize) -> Self {
        Self {
            limit,
            entries: Mutex::default(),
        }
    }

    /// The value of a key, if it is there.
    pub(super) fn get(&self, key: &Hash) -> Option<Arc<T>> {
        let mut entries = self.entries.lock().unwrap_or_else(PoisonError::into_inner);
        let place = entries.iter().position(|entry| entry.key == *key)?;
        let entry = entries.remove(place);
        let value = entry.value.clone();
        entries.push(entry);
        Some(value)
    }

    /// Keeps a value of about so many bytes; the one that was not used for longest makes room.
    pub(super) fn insert(&self, key: Hash, value: &Arc<T>, bytes: usize) {
        if bytes > self.limit {
            return;
        }
        let mut entries = self.entries.lock().unwrap_or_else(PoisonError::into_inner);
        entries.retain(|entry| entry.key != key);
        entries.push(KeptEntry {
            key,
            value: value.clone(),
            bytes,
        });
        let mut kept = 0;
        let fits = |entry: &&KeptEntry<T>| {
            kept += entry.bytes;
            kept <= self.limit
        };
        let count = entries.iter().rev().take_while(fits).count();
        let surplus = entries.len() - count;
        entries.drain(..surplus);
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
    fn the_value_that_was_not_used_for_longest_makes_room() {
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
    fn a_value_that_is_too_large_is_not_kept() {
        let memory = Memory::new(30);
        memory.insert(key(0), &Arc::new(0), 1);
        memory.insert(key(1), &Arc::new(1), 31);
        assert!(memory.get(&key(1)).is_none());
        assert!(memory.get(&key(0)).is_some());
    }
}
