//! The program as a user meets it: its exit codes, what it prints where, and what it leaves behind.

mod bad_input;
mod files;
mod runner;
mod tables;
