//! Transfer of fields between a region and its grid.

use rayon::prelude::*;

use super::Region;

impl Region {
    /// The part of a field of the grid that lies in the region's `line`-th row.
    pub fn line<'a, T>(&self, field: &'a [T], line: usize) -> &'a [T] {
        let [above, left] = self.origin;
        let first = (above + line) * self.grid.size() + left;
        &field[first..first + self.size]
    }

    /// Returns the results of `of_line` for each row of a field on the region, in order.
    pub fn by_lines<T: Send>(
        &self,
        part: &[f64],
        of_line: impl Fn(usize, &[f64]) -> T + Sync,
    ) -> Vec<T> {
        self.for_lines(part, &of_line)
    }

    /// The same with a trait object, so that it is compiled once for each type of result.
    fn for_lines<T: Send>(
        &self,
        part: &[f64],
        of_line: &(dyn Fn(usize, &[f64]) -> T + Sync),
    ) -> Vec<T> {
        let lines = part.par_chunks(self.size).enumerate();
        let lines = lines.with_min_len(self.rows_per_thread());
        lines.map(|(line, values)| of_line(line, values)).collect()
    }

    /// The part of a field of the grid that lies in the region.
    pub fn cut<T: Copy + Default + Send + Sync>(&self, field: &[T]) -> Vec<T> {
        self.take_over(&self.everywhere(), field)
    }

    /// Returns the field of the whole grid that is `part` in the region and its mirror images, and 0 outside, where the
    /// zeroed memory is not touched.
    pub fn scatter(&self, part: Vec<f64>) -> Vec<f64> {
        if self.grid.has_images() {
            self.unfold(&part)
        } else if self.is_whole() {
            part
        } else {
            self.everywhere().take_over(self, &part)
        }
    }

    /// The same for a region whose rows begin at an axis.
    fn unfold(&self, part: &[f64]) -> Vec<f64> {
        let (axis, [_, width]) = (self.grid.size(), self.grid.whole_lengths());
        let [lines, _] = self.lengths();
        let [above, _] = self.origin;
        let mut field = vec![0.0; width * width];
        let rows = field.par_chunks_exact_mut(width).enumerate();
        let [first, count] = match self.grid.mirrored() {
            [true, _] => [axis - lines, 2 * lines],
            [false, _] => [above, lines],
        };
        let rows = rows.skip(first).take(count);
        let rows = rows.with_min_len(self.rows_per_thread());
        rows.for_each(|(i, row)| {
            let line = match self.grid.mirrored() {
                [true, _] if i < axis => axis - 1 - i,
                [true, _] => i - axis,
                [false, _] => i - above,
            };
            let values = &part[line * self.size..(line + 1) * self.size];
            let (left, right) = row.split_at_mut(axis);
            right[..self.size].copy_from_slice(values);
            let left = left.iter_mut().rev();
            left.zip(values).for_each(|(left, value)| *left = *value);
        });
        field
    }

    /// Returns the field on this region that is `part` on the elements shared with the other region and 0 elsewhere.
    pub fn take_over<T: Copy + Default + Send + Sync>(&self, other: &Self, part: &[T]) -> Vec<T> {
        let mut field = vec![T::default(); self.elements()];
        let (own, others) = (self.lengths(), other.lengths());
        let [rows, columns] = [0, 1].map(|axis: usize| {
            let first = self.origin[axis].max(other.origin[axis]);
            let end = (self.origin[axis] + own[axis]).min(other.origin[axis] + others[axis]);
            first..end.max(first)
        });
        let lines = field.par_chunks_mut(self.size).enumerate();
        let lines = lines.with_min_len(self.rows_per_thread());
        lines.for_each(|(line, values)| {
            let i = self.origin[0] + line;
            if rows.contains(&i) {
                let to = columns.start - self.origin[1];
                let from = (i - other.origin[0]) * other.size + columns.start - other.origin[1];
                values[to..to + columns.len()].copy_from_slice(&part[from..from + columns.len()]);
            }
        });
        field
    }
}
