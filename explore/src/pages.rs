//! The pages that are open, and the newest request of each.

use std::collections::BTreeMap;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Time for which a page may be gone before the program ends: a page that is loaded again is back much earlier.
pub const GRACE: Duration = Duration::from_secs(5);

/// Most pages whose requests are told apart; of more, those that asked longest ago are forgotten.
const MOST_PAGES: usize = 64;

/// The pages.
#[derive(Debug, Default)]
pub struct Pages(Mutex<State>);

#[derive(Debug, Default)]
struct State {
    open: usize,
    /// When the last one closed; none before the first one.
    closed: Option<Instant>,
    turns: u64,
    newest: BTreeMap<String, Newest>,
}

/// The newest request of a page.
#[derive(Debug, Clone, Copy)]
struct Newest {
    /// Its number on the page: requests may arrive in another order.
    number: u64,
    /// Its turn among those of all pages.
    turn: u64,
}

/// A request of a page, which a newer one of the same page supersedes.
#[derive(Debug)]
pub struct Turn<'a> {
    pages: &'a Pages,
    page: String,
    number: u64,
}

/// An open page.
#[derive(Debug)]
pub struct OpenPage<'a>(&'a Pages);

impl Pages {
    fn state(&self) -> MutexGuard<'_, State> {
        // The numbers are right even if a thread ended in between.
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Begins a request of a page, which has numbered it.
    #[must_use]
    pub fn turn(&self, page: &str, number: u64) -> Turn<'_> {
        let mut state = self.state();
        state.turns += 1;
        let turn = state.turns;
        let newest = state.newest.entry(page.to_owned());
        let newest = newest.or_insert(Newest { number, turn });
        *newest = Newest {
            number: newest.number.max(number),
            turn,
        };
        if state.newest.len() > MOST_PAGES {
            let oldest = state.newest.iter().min_by_key(|(_, newest)| newest.turn);
            if let Some(page) = oldest.map(|(page, _)| page.clone()) {
                state.newest.remove(&page);
            }
        }
        Turn {
            pages: self,
            page: page.to_owned(),
            number,
        }
    }

    /// Counts a page as open until the value is dropped.
    #[must_use]
    pub fn open(&self) -> OpenPage<'_> {
        self.state().open += 1;
        OpenPage(self)
    }

    /// Whether all pages are closed, and have been for [`GRACE`]; not before the first one was opened.
    #[must_use]
    pub fn are_closed(&self) -> bool {
        let state = self.state();
        state.open == 0 && state.closed.is_some_and(|closed| closed.elapsed() > GRACE)
    }
}

impl Turn<'_> {
    /// Whether a newer request of the same page has begun.
    #[must_use]
    pub fn is_superseded(&self) -> bool {
        let state = self.pages.state();
        let newest = state.newest.get(&self.page);
        newest.is_none_or(|newest| newest.number > self.number)
    }
}

impl Drop for OpenPage<'_> {
    fn drop(&mut self) {
        let mut state = self.0.state();
        state.open -= 1;
        state.closed = Some(Instant::now());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_newer_request_supersedes_those_of_its_page_and_no_others() {
        let pages = Pages::default();
        let (first, other) = (pages.turn("a", 1), pages.turn("b", 1));
        assert!(!first.is_superseded());
        let third = pages.turn("a", 3);
        let late = pages.turn("a", 2);
        assert!(first.is_superseded() && late.is_superseded());
        assert!(!third.is_superseded() && !other.is_superseded());
    }

    #[test]
    fn pages_beyond_counting_are_forgotten() {
        let pages = Pages::default();
        let first = pages.turn("first", 1);
        let turns: Vec<_> = (0..MOST_PAGES)
            .map(|i| pages.turn(&i.to_string(), 1))
            .collect();
        assert!(first.is_superseded() && turns.iter().all(|turn| !turn.is_superseded()));
    }

    #[test]
    fn a_page_that_never_opened_does_not_end_the_program() {
        let pages = Pages::default();
        assert!(!pages.are_closed());
        drop(pages.open());
        assert!(!pages.are_closed(), "it may be loaded again");
        pages.state().closed = Instant::now().checked_sub(2 * GRACE);
        assert!(pages.are_closed());
        let open = pages.open();
        assert!(!pages.are_closed());
        drop(open);
    }
}
