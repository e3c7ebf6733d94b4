//! The numbers and the fields of a result, each declared once: terminal, tables, pages, schema, documents and the
//! Python package go through these lists.

pub mod documents;
pub mod extremes;
pub mod fields;
pub mod quantities;
pub mod quantity;
pub mod square_fields;
pub mod table;
