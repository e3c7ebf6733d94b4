//! Tests of the program on its command line.

mod program;
