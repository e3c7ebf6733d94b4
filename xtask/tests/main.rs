//! Tests of the chores on the real workspace: its house rules, the figures, and the driver of the comparison.

mod compare;
mod figures;
mod workspace;
