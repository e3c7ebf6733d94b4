//! Tests of the program on its command line, and of the reader of measured curves.

mod curves;
mod program;
