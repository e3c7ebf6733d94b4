//! A reader for `NetCDF` files of the classic format with 64-bit offsets, independent of the program.

use std::collections::BTreeMap;

/// Returns every variable by name; one without records counts as a single record.
pub fn variables(bytes: Vec<u8>) -> BTreeMap<String, Records> {
    NetcdfReader { bytes, at: 0 }.variables()
}

/// Dimensions and variables of such a `NetCDF` file.
struct NetcdfReader {
    bytes: Vec<u8>,
    at: usize,
}

/// A variable over the record dimension: the values of each record.
pub type Records = Vec<Vec<f64>>;

impl NetcdfReader {
    fn integer(&mut self) -> usize {
        self.at += 4;
        u32::from_be_bytes(self.bytes[self.at - 4..self.at].try_into().unwrap()) as usize
    }

    fn text(&mut self) -> String {
        let length = self.integer();
        let text = String::from_utf8(self.bytes[self.at..self.at + length].to_vec()).unwrap();
        self.at += length.next_multiple_of(4);
        text
    }

    fn skip_attributes(&mut self) {
        self.integer();
        for _ in 0..self.integer() {
            self.text();
            let size = [0, 1, 1, 2, 4, 4, 8][self.integer()];
            let length = self.integer();
            self.at += (length * size).next_multiple_of(4);
        }
    }

    /// Returns every variable by name; one without records counts as a single record.
    fn variables(mut self) -> BTreeMap<String, Records> {
        assert_eq!(self.bytes[..4], *b"CDF\x02");
        self.at = 4;
        let records = self.integer();
        assert_eq!(self.integer(), 10);
        let dimensions = self.integer();
        let lengths: Vec<_> = (0..dimensions)
            .map(|_| {
                self.text();
                self.integer()
            })
            .collect();
        self.skip_attributes();
        assert_eq!(self.integer(), 11);
        let mut found = Vec::new();
        for _ in 0..self.integer() {
            let name = self.text();
            let dimensions: Vec<_> = (0..self.integer()).map(|_| self.integer()).collect();
            self.skip_attributes();
            let (kind, size) = (self.integer(), self.integer());
            let begin = (self.integer() << 32) + self.integer();
            let has_records = dimensions.first().is_some_and(|i| lengths[*i] == 0);
            found.push((name, kind, size, begin, has_records));
        }
        let of_record: usize = found.iter().filter(|v| v.4).map(|v| v.2).sum();
        let values = |kind, bytes: &[u8]| -> Vec<f64> {
            match kind {
                4 => bytes
                    .chunks(4)
                    .map(|b| f64::from(i32::from_be_bytes(b.try_into().unwrap())))
                    .collect(),
                _ => bytes
                    .chunks(8)
                    .map(|b| f64::from_be_bytes(b.try_into().unwrap()))
                    .collect(),
            }
        };
        let bytes = &self.bytes;
        let end = found
            .iter()
            .filter(|v| !v.4)
            .map(|v| v.3 + v.2)
            .max()
            .unwrap();
        assert_eq!(
            bytes.len(),
            end + records * of_record,
            "nothing more in the file"
        );
        let variables = found
            .into_iter()
            .map(|(name, kind, size, begin, has_records)| {
                let records = if has_records { records } else { 1 };
                let record = |i| values(kind, &bytes[begin + i * of_record..][..size]);
                (name, (0..records).map(record).collect())
            });
        variables.collect()
    }
}
