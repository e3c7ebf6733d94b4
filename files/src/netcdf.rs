//! The header of a `NetCDF` file of the classic format with 64-bit offsets: big-endian numbers and padded names.
//!
//! The values follow, variable by variable. Variables over the record dimension come last, interleaved: all of them for
//! its first index, then for the second. A variable has at most 4 GiB, but for interleaved variables the limit applies
//! to each record, so a file with records has no practical limit.

use std::io;

/// Tags of the format for the part that follows.
const DIMENSIONS: u32 = 10;
const VARIABLES: u32 = 11;
const ATTRIBUTES: u32 = 12;

/// Codes of the format for the types of text and of numbers in attributes.
const CHAR: u32 = 2;
const DOUBLE: u32 = 6;

/// The length that marks the record dimension.
pub const RECORDS: usize = 0;

/// A named value beside the variables.
#[derive(Debug, Clone, PartialEq)]
pub enum Attribute {
    /// A text.
    Text(&'static str, String),
    /// A number.
    Number(&'static str, f64),
}

/// The type of a variable's values.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// An integer of 8 bits.
    Byte,
    /// An integer of 32 bits.
    Integer,
    /// A number in double precision.
    Double,
}

/// A variable, without its values.
#[derive(Debug, Clone, PartialEq)]
pub struct Variable {
    /// Its name.
    pub name: &'static str,
    /// The numbers of its dimensions.
    pub dimensions: Vec<usize>,
    /// Its attributes.
    pub attributes: Vec<Attribute>,
    /// The type of its values.
    pub kind: Kind,
}

/// Everything before the values.
#[derive(Debug, Clone, PartialEq)]
pub struct Header {
    /// Number of records, the length of the record dimension.
    pub records: usize,
    /// Names and lengths of the dimensions; the length of the record dimension is [`RECORDS`].
    pub dimensions: Vec<(&'static str, usize)>,
    /// Attributes of the file.
    pub attributes: Vec<Attribute>,
    /// The variables in the order of their values, those over the record dimension last.
    pub variables: Vec<Variable>,
}

impl Kind {
    fn number(self) -> u32 {
        match self {
            Self::Byte => 1,
            Self::Integer => 4,
            Self::Double => 6,
        }
    }

    fn bytes(self) -> usize {
        match self {
            Self::Byte => 1,
            Self::Integer => 4,
            Self::Double => 8,
        }
    }
}

impl Header {
    /// Encodes the header.
    ///
    /// # Errors
    ///
    /// An error if a number does not fit into the format.
    pub fn bytes(&self) -> io::Result<Vec<u8>> {
        // The offsets follow from the length of the header, which does not depend on them.
        let length = self.bytes_with_values_at(0)?.len();
        self.bytes_with_values_at(length)
    }

    /// Bytes of a variable, or of one record of it, padding included.
    fn size(&self, variable: &Variable) -> usize {
        let lengths = variable.dimensions.iter().map(|i| self.dimensions[*i].1);
        let values: usize = lengths.filter(|length| *length != RECORDS).product();
        (values * variable.kind.bytes()).next_multiple_of(4)
    }

    fn bytes_with_values_at(&self, start: usize) -> io::Result<Vec<u8>> {
        let mut bytes = b"CDF\x02".to_vec();
        push_count(&mut bytes, self.records)?;
        push_u32(&mut bytes, DIMENSIONS);
        push_count(&mut bytes, self.dimensions.len())?;
        for (name, length) in &self.dimensions {
            push_text(&mut bytes, name)?;
            push_count(&mut bytes, *length)?;
        }
        push_attributes(&mut bytes, &self.attributes)?;
        push_u32(&mut bytes, VARIABLES);
        push_count(&mut bytes, self.variables.len())?;
        let mut begin = start;
        for variable in &self.variables {
            self.push_variable(&mut bytes, variable, begin)?;
            begin += self.size(variable);
        }
        Ok(bytes)
    }

    fn push_variable(
        &self,
        bytes: &mut Vec<u8>,
        variable: &Variable,
        begin: usize,
    ) -> io::Result<()> {
        push_text(bytes, variable.name)?;
        push_count(bytes, variable.dimensions.len())?;
        for dimension in &variable.dimensions {
            push_count(bytes, *dimension)?;
        }
        push_attributes(bytes, &variable.attributes)?;
        push_u32(bytes, variable.kind.number());
        push_count(bytes, self.size(variable))?;
        bytes.extend((begin as u64).to_be_bytes());
        Ok(())
    }
}

fn push_attributes(bytes: &mut Vec<u8>, attributes: &[Attribute]) -> io::Result<()> {
    if attributes.is_empty() {
        // An empty list is written as two zeros.
        bytes.extend([0; 8]);
        return Ok(());
    }
    push_u32(bytes, ATTRIBUTES);
    push_count(bytes, attributes.len())?;
    for attribute in attributes {
        match attribute {
            Attribute::Text(name, text) => {
                push_text(bytes, name)?;
                push_u32(bytes, CHAR);
                push_text(bytes, text)?;
            }
            Attribute::Number(name, number) => {
                push_text(bytes, name)?;
                push_u32(bytes, DOUBLE);
                push_count(bytes, 1)?;
                bytes.extend(number.to_be_bytes());
            }
        }
    }
    Ok(())
}

/// Appends the length in bytes, the bytes, and zeros up to a multiple of four.
fn push_text(bytes: &mut Vec<u8>, text: &str) -> io::Result<()> {
    push_count(bytes, text.len())?;
    bytes.extend(text.as_bytes());
    bytes.resize(bytes.len().next_multiple_of(4), 0);
    Ok(())
}

fn push_u32(bytes: &mut Vec<u8>, number: u32) {
    bytes.extend(number.to_be_bytes());
}

fn push_count(bytes: &mut Vec<u8>, count: usize) -> io::Result<()> {
    let count = u32::try_from(count).map_err(io::Error::other)?;
    push_u32(bytes, count);
    Ok(())
}
