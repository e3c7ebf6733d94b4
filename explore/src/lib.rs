//! A page in the browser that solves a contact while its numbers are changed.
//!
#![doc = include_str!("../README.md")]

mod edit;
mod engine;
mod form;
mod gate;
mod http;
mod numbers;
mod pages;
mod picture;
mod server;

pub use engine::{Setup, Template};
pub use server::{Ending, Server};
