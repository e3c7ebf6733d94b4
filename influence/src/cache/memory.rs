//! What is kept in memory, up to a limit.

use std::sync::{Arc, Mutex, PoisonError};

use super::key::Key;
use crate::{CoefficientTable, RadialTables};

/// Bytes of each shelf: the coefficients of grids of up to 8000² elements together, next to which a solver needs a hundred times as much.
const LIMIT: usize = 1 << 28;

/// One shelf for each kind of data.
#[derive(Debug, Default)]
pub(super) struct Memory {
    pub tables: Shelf<RadialTables>,
    pub coefficients: Shelf<CoefficientTable>,
}

/// Data by key, those used last at the end.
#[derive(Debug)]
pub(super) struct Shelf<T>(Mutex<Vec<Entry<T>>>);

#[derive(Debug)]
struct Entry<T> {
    key: Key,
    value: Arc<T>,
    bytes: usize,
}

impl<T> Default for Shelf<T> {
    fn default() -> Self {
        Self(Mutex::default())
    }
}

impl<T> Shelf<T> {
    /// The data of this key, if they are there.
    pub(super) fn take_down(&self, key: &Key) -> Option<Arc<T>> {
        let mut entries = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let place = entries.iter().position(|entry| entry.key == *key)?;
        let entry = entries.remove(place);
        let value = entry.value.clone();
        entries.push(entry);
        Some(value)
    }

    /// Keeps data of about so many bytes; what was not used for longest makes room.
    pub(super) fn put_up(&self, key: Key, value: &Arc<T>, bytes: usize) {
        if bytes > LIMIT {
            return;
        }
        let mut entries = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        entries.retain(|entry| entry.key != key);
        entries.push(Entry {
            key,
            value: value.clone(),
            bytes,
        });
        let mut kept = 0;
        let fits = |entry: &&Entry<T>| {
            kept += entry.bytes;
            kept <= LIMIT
        };
        let count = entries.iter().rev().take_while(fits).count();
        let surplus = entries.len() - count;
        entries.drain(..surplus);
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use super::{Key, LIMIT, Shelf};

    fn key(number: u8) -> Key {
        Key(blake3::hash(&[number]))
    }

    #[test]
    fn what_was_not_used_for_longest_makes_room() {
        let shelf = Shelf::default();
        for number in 0..3 {
            shelf.put_up(key(number), &Arc::new(number), LIMIT / 3);
        }
        assert_eq!(shelf.take_down(&key(0)).as_deref(), Some(&0));
        shelf.put_up(key(3), &Arc::new(3), LIMIT / 3);
        let found: Vec<_> = (0..4).map(|n| shelf.take_down(&key(n)).is_some()).collect();
        assert_eq!(found, [true, false, true, true]);
    }

    #[test]
    fn what_is_too_large_is_not_kept() {
        let shelf = Shelf::default();
        shelf.put_up(key(0), &Arc::new(0), 1);
        shelf.put_up(key(1), &Arc::new(1), LIMIT + 1);
        assert!(shelf.take_down(&key(1)).is_none());
        assert!(shelf.take_down(&key(0)).is_some());
    }
}
