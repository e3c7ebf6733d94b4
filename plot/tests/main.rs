//! Every picture can be drawn and rendered, whatever its numbers.

mod fits;
mod solutions;
