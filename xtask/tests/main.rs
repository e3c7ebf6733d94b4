//! Tests of the chores on the real workspace: house rules, figures, golden values, and the driver of the comparison.

mod compare;
mod figures;
mod golden;
mod workspace;
