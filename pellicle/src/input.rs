//! The TOML of a case, a study or a fit file: its text and positions in it, its tree, quantities with units, and
//! readers of tables and values that diagnose the first fault.

pub mod clean;
pub mod decode;
pub mod diagnosis;
pub mod dimension;
pub mod document;
pub mod key_path;
pub mod overrides;
pub mod quantity;
pub mod quantity_list;
pub mod source_file;
pub mod spacing;
pub mod span;
pub mod synonyms;
pub mod table_reader;
pub mod toml_tree;
pub mod units;
pub mod value_reader;
pub mod withdrawn;
