//! The bytes of one file: a header of 88 bytes, then the payload.
//!
//! | bytes | what |
//! |---|---|
//! | 0–7 | `PELLICLE` |
//! | 8–15 | version of the format, little-endian like every number |
//! | 16–47 | key |
//! | 48–55 | length of the payload |
//! | 56–87 | BLAKE3 of all the bytes before and of the payload |

use super::key::{FORMAT, Key};
use super::warning::FileFault;

const MAGIC: &[u8; 8] = b"PELLICLE";

/// Length of the header.
pub(super) const HEADER: usize = CHECKED + 32;

/// Length of the part of the header that the checksum is of.
const CHECKED: usize = 56;

/// The header of this payload.
pub(super) fn seal(key: &Key, payload: &[u8]) -> Vec<u8> {
    let mut header = Vec::with_capacity(HEADER);
    header.extend_from_slice(MAGIC);
    header.extend_from_slice(&u64::from(FORMAT).to_le_bytes());
    header.extend_from_slice(key.0.as_bytes());
    header.extend_from_slice(&(payload.len() as u64).to_le_bytes());
    let checksum = checksum(&header, payload);
    header.extend_from_slice(checksum.as_bytes());
    header
}

/// The payload of a file that is whole and what it should be.
pub(super) fn unseal<'a>(key: &Key, bytes: &'a [u8]) -> Result<&'a [u8], FileFault> {
    let (magic, rest) = bytes.split_first_chunk().ok_or(FileFault::Foreign)?;
    if magic != MAGIC {
        return Err(FileFault::Foreign);
    }
    let (header, payload) = bytes.split_at_checked(HEADER).ok_or(FileFault::Length {
        found: bytes.len() as u64,
        wanted: HEADER as u64,
    })?;
    check_version(word(rest))?;
    if &header[16..48] != key.0.as_bytes() {
        return Err(FileFault::OtherData);
    }
    check_length(word(&header[48..]), payload)?;
    if checksum(&header[..CHECKED], payload).as_bytes() != &header[CHECKED..] {
        return Err(FileFault::Checksum);
    }
    Ok(payload)
}

fn check_version(found: u64) -> Result<(), FileFault> {
    if found == u64::from(FORMAT) {
        return Ok(());
    }
    Err(FileFault::Version {
        found,
        wanted: FORMAT,
    })
}

fn check_length(wanted: u64, payload: &[u8]) -> Result<(), FileFault> {
    let found = payload.len() as u64;
    if found == wanted {
        return Ok(());
    }
    let header = HEADER as u64;
    Err(FileFault::Length {
        found: header + found,
        wanted: header.saturating_add(wanted),
    })
}

fn checksum(header: &[u8], payload: &[u8]) -> blake3::Hash {
    let mut hasher = blake3::Hasher::new();
    hasher.update(header).update(payload).finalize()
}

/// The number that the bytes begin with; 0 if they are too few.
fn word(bytes: &[u8]) -> u64 {
    bytes.first_chunk().copied().map_or(0, u64::from_le_bytes)
}

#[cfg(test)]
mod tests {
    use super::{FORMAT, FileFault, HEADER, Key, seal, unseal};

    fn key(text: &str) -> Key {
        Key(blake3::hash(text.as_bytes()))
    }

    fn file(payload: &[u8]) -> Vec<u8> {
        let mut bytes = seal(&key("a"), payload);
        bytes.extend_from_slice(payload);
        bytes
    }

    #[test]
    fn what_was_sealed_comes_out() {
        for payload in [&b""[..], b"payload"] {
            assert_eq!(unseal(&key("a"), &file(payload)), Ok(payload));
        }
    }

    #[test]
    fn a_file_cut_off_anywhere_is_refused() {
        let whole = file(&[7; 100]);
        for length in 0..whole.len() {
            let fault = unseal(&key("a"), &whole[..length]).unwrap_err();
            let expected = match length {
                0..8 => FileFault::Foreign,
                8..HEADER => FileFault::Length {
                    found: length as u64,
                    wanted: HEADER as u64,
                },
                _ => FileFault::Length {
                    found: length as u64,
                    wanted: whole.len() as u64,
                },
            };
            assert_eq!(fault, expected);
        }
    }

    #[test]
    fn a_bit_turned_anywhere_is_noticed() {
        let whole = file(&[7; 100]);
        for bit in 0..8 * whole.len() {
            let mut bytes = whole.clone();
            bytes[bit / 8] ^= 1 << (bit % 8);
            assert!(unseal(&key("a"), &bytes).is_err(), "bit {bit}");
        }
    }

    #[test]
    fn each_fault_has_its_name() {
        let mut whole = file(b"payload");
        assert_eq!(unseal(&key("b"), &whole), Err(FileFault::OtherData));
        whole.push(0);
        let (found, wanted) = (96, 95);
        assert_eq!(
            unseal(&key("a"), &whole),
            Err(FileFault::Length { found, wanted })
        );
        whole.pop();
        whole[90] += 1;
        assert_eq!(unseal(&key("a"), &whole), Err(FileFault::Checksum));
        whole[8] += 1;
        let (found, wanted) = (u64::from(FORMAT) + 1, FORMAT);
        assert_eq!(
            unseal(&key("a"), &whole),
            Err(FileFault::Version { found, wanted })
        );
        whole[0] += 1;
        assert_eq!(unseal(&key("a"), &whole), Err(FileFault::Foreign));
    }
}
