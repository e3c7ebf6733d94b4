//! The bytes of one file: a header of 88 bytes, then the payload.
//!
//! | bytes | what |
//! |---|---|
//! | 0–7 | `PELLICLE` |
//! | 8–15 | version of the format, little-endian like every number |
//! | 16–47 | key |
//! | 48–55 | length of the payload |
//! | 56–87 | BLAKE3 of all the bytes before and of the payload |

use std::io::{self, BufReader, Read};

use super::encoding::Decoder;
use super::key::{FORMAT, Key};
use super::warning::FileFault;

const MAGIC: &[u8; 8] = b"PELLICLE";

/// Length of the header.
pub(super) const HEADER: usize = CHECKED + 32;

/// Bytes read from the system and hashed at once: BLAKE3 takes twice as long for each of a few thousand.
const BUFFER: usize = 1 << 18;

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

/// What the payload says of a file of this length that is whole and what it should be; it is never in the memory as a whole.
pub(super) fn unseal<T>(
    key: &Key,
    mut file: impl Read,
    length: u64,
    decode: impl FnOnce(&mut Decoder<'_>) -> Option<T>,
) -> Result<T, FileFault> {
    let unreadable = |error: io::Error| FileFault::Unreadable(error.kind());
    let mut header = Vec::with_capacity(HEADER);
    let mut first = file.by_ref().take(HEADER as u64);
    first.read_to_end(&mut header).map_err(unreadable)?;
    let (magic, rest) = header.split_first_chunk().ok_or(FileFault::Foreign)?;
    if magic != MAGIC {
        return Err(FileFault::Foreign);
    }
    if header.len() < HEADER {
        return Err(FileFault::Length {
            found: length,
            wanted: HEADER as u64,
        });
    }
    check_version(word(rest))?;
    if &header[16..48] != key.0.as_bytes() {
        return Err(FileFault::OtherData);
    }
    let payload = check_length(word(&header[48..]), length)?;
    let mut hasher = blake3::Hasher::new();
    hasher.update(&header[..CHECKED]);
    let mut file = BufReader::with_capacity(BUFFER.min(payload), Hashed { file, hasher });
    let decoded = decode(&mut Decoder::new(&mut file, payload));
    // What is not in order has not been read to its end.
    io::copy(&mut file, &mut io::sink()).map_err(unreadable)?;
    if file.get_ref().hasher.finalize().as_bytes() != &header[CHECKED..] {
        return Err(FileFault::Checksum);
    }
    decoded.ok_or(FileFault::Contents)
}

/// A file that is hashed as it is read.
struct Hashed<R> {
    file: R,
    hasher: blake3::Hasher,
}

impl<R: Read> Read for Hashed<R> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        let count = self.file.read(bytes)?;
        self.hasher.update(&bytes[..count]);
        Ok(count)
    }
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

/// The length of the payload, if it is that of a file of this length.
fn check_length(wanted: u64, length: u64) -> Result<usize, FileFault> {
    let (found, header) = (length.saturating_sub(HEADER as u64), HEADER as u64);
    let payload = usize::try_from(found).ok();
    payload
        .filter(|_| found == wanted)
        .ok_or(FileFault::Length {
            found: length,
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
    use super::{Decoder, FORMAT, FileFault, HEADER, Key, seal};

    fn key(text: &str) -> Key {
        Key(blake3::hash(text.as_bytes()))
    }

    /// Of a payload of bytes, as many whole numbers as there are.
    fn unseal(key: &Key, bytes: &[u8]) -> Result<Vec<usize>, FileFault> {
        let numbers = |decoder: &mut Decoder<'_>| {
            let mut numbers = Vec::new();
            while decoder.finish(()).is_none() {
                numbers.push(decoder.index()?);
            }
            Some(numbers)
        };
        super::unseal(key, bytes, bytes.len() as u64, numbers)
    }

    fn file(payload: &[u8]) -> Vec<u8> {
        let mut bytes = seal(&key("a"), payload);
        bytes.extend_from_slice(payload);
        bytes
    }

    #[test]
    fn what_was_sealed_comes_out() {
        for (payload, numbers) in [(&b""[..], vec![]), (b"\x07\0\0\0\0\0\0\0", vec![7])] {
            assert_eq!(unseal(&key("a"), &file(payload)), Ok(numbers));
        }
    }

    #[test]
    fn a_payload_that_says_nothing_is_told_from_a_damaged_one() {
        let mut whole = file(b"payload");
        assert_eq!(unseal(&key("a"), &whole), Err(FileFault::Contents));
        whole[90] += 1;
        assert_eq!(unseal(&key("a"), &whole), Err(FileFault::Checksum));
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
