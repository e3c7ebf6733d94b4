//! The bytes of one file: a header of 88 bytes, then the payload.
//!
//! | bytes | what |
//! |---|---|
//! | 0–7 | `PELLICLE` |
//! | 8–15 | version of the format, little-endian like every number |
//! | 16–47 | key |
//! | 48–55 | length of the payload |
//! | 56–87 | BLAKE3 of all the bytes before and of the payload |

use std::io::{self, BufReader, ErrorKind, Read};

use super::encoding::Decoder;
use super::key::{FORMAT, Key};
use super::warning::FileFault;

const MAGIC: &[u8; 8] = b"PELLICLE";

/// Length of the header.
pub(super) const HEADER: usize = CHECKED + 32;

/// Bytes read from the system and hashed at once: given a few thousand at a time, BLAKE3 takes twice as long for each.
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

/// Decodes the payload of a file of this length if it is whole and what it should be. No more of it than a buffer holds is in the memory at a time.
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
            found: header.len() as u64,
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
    let hashed = Hashed {
        // One byte more shows that the file goes on.
        file: file.take(payload as u64 + 1),
        hasher,
        failure: None,
    };
    let mut file = BufReader::with_capacity(BUFFER.min(payload), hashed);
    let decoded = decode(&mut Decoder::new(&mut file, payload));
    // What is not in order has not been read to its end.
    io::copy(&mut file, &mut io::sink()).map_err(unreadable)?;
    let Hashed {
        hasher, failure, ..
    } = file.get_ref();
    if let Some(kind) = failure {
        return Err(FileFault::Unreadable(*kind));
    }
    if hasher.finalize().as_bytes() != &header[CHECKED..] {
        return Err(FileFault::Checksum);
    }
    decoded.ok_or(FileFault::Contents)
}

/// A file that is hashed as it is read.
struct Hashed<R> {
    file: R,
    hasher: blake3::Hasher,
    /// What went wrong first, which a decoder does not tell.
    failure: Option<ErrorKind>,
}

impl<R: Read> Read for Hashed<R> {
    fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
        let count = self.file.read(bytes).inspect_err(|error| {
            let kind = Some(error.kind()).filter(|kind| *kind != ErrorKind::Interrupted);
            self.failure = self.failure.or(kind);
        })?;
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
    use super::{BUFFER, Decoder, ErrorKind, FORMAT, FileFault, HEADER, Key, Read, io, seal};

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
        let whole = file(&[7; 104]);
        assert!(unseal(&key("a"), &whole).is_ok());
        for bit in 0..8 * whole.len() {
            let mut bytes = whole.clone();
            bytes[bit / 8] ^= 1 << (bit % 8);
            let fault = unseal(&key("a"), &bytes).unwrap_err();
            assert_ne!(fault, FileFault::Contents, "bit {bit}");
        }
    }

    #[test]
    fn of_a_file_longer_than_the_buffer_every_byte_counts() {
        let mut whole = file(&vec![7; 2 * BUFFER + 800]);
        assert_eq!(unseal(&key("a"), &whole).unwrap().len(), BUFFER / 4 + 100);
        let length = whole.len() as u64;
        let nothing = |_: &mut Decoder<'_>| None::<()>;
        let given_up = super::unseal(&key("a"), &*whole, length, nothing);
        assert_eq!(given_up, Err(FileFault::Contents));
        *whole.last_mut().unwrap() += 1;
        for decoded in [None, Some(())] {
            let found = super::unseal(&key("a"), &*whole, length, |_| decoded);
            assert_eq!(found, Err(FileFault::Checksum));
        }
    }

    #[test]
    fn a_file_that_changes_its_length_while_it_is_read_is_refused() {
        let whole = file(&[7; 16]);
        let longer = [&whole[..], &[7]].concat();
        for bytes in [&longer[..], &whole[..whole.len() - 1]] {
            let found = super::unseal(&key("a"), bytes, whole.len() as u64, |_| Some(()));
            assert_eq!(found, Err(FileFault::Checksum));
        }
    }

    #[test]
    fn an_error_that_passes_is_not_held_against_the_contents() {
        /// Fails once, after the header.
        struct Failing<'a>(&'a [u8], bool);
        impl Read for Failing<'_> {
            fn read(&mut self, bytes: &mut [u8]) -> io::Result<usize> {
                if self.1 && self.0.len() <= 16 {
                    self.1 = false;
                    return Err(ErrorKind::TimedOut.into());
                }
                self.0.read(bytes)
            }
        }
        let whole = file(&[7; 16]);
        let numbers = |decoder: &mut Decoder<'_>| decoder.index().zip(decoder.index());
        let found = super::unseal(&key("a"), Failing(&whole, true), 104, numbers);
        assert_eq!(found, Err(FileFault::Unreadable(ErrorKind::TimedOut)));
        let found = super::unseal(&key("a"), Failing(&whole, false), 104, numbers);
        assert!(found.is_ok());
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
