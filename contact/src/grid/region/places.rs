//! The places around a region's elements: mirror images, periodic images, and the border where the contact may go on.

use super::{Boundary, Place, Region};

impl Region {
    /// Indices on the whole grid of the element at a place in the region.
    pub fn index_on_whole(&self, [i, j]: Place) -> [isize; 2] {
        let [above, left] = self.grid.first_index();
        let [row, column] = self.origin;
        [
            (above + row).cast_signed() + i,
            (left + column).cast_signed() + j,
        ]
    }

    /// Row and column on the grid of the element at a place within the region.
    pub fn on_grid(&self, [row, column]: [usize; 2]) -> [usize; 2] {
        let [above, left] = self.origin;
        [above + row, left + column]
    }

    /// Its index on the grid.
    pub fn index_on_grid(&self, place: [usize; 2]) -> usize {
        let [row, column] = self.on_grid(place);
        row * self.grid.size() + column
    }

    /// The element of the region at a place, itself, its mirror image or its periodic image; none elsewhere.
    pub fn element(&self, place: Place) -> Option<usize> {
        let place = match self.boundary {
            Boundary::Free => place,
            Boundary::Periodic => {
                let lengths = self.lengths().map(usize::cast_signed);
                [0, 1].map(|axis: usize| place[axis].rem_euclid(lengths[axis]))
            }
        };
        let along = |axis: usize| {
            let image = self.grid.on_this_side(axis, place[axis]);
            let lines = self.lengths()[axis];
            usize::try_from(image).ok().filter(|image| *image < lines)
        };
        Some(along(0)? * self.size + along(1)?)
    }

    /// The first line of places next to an element: the line before it, or 0 in a cell, whose last line is next to its
    /// first.
    pub fn first_line(&self) -> isize {
        match self.boundary {
            Boundary::Free => -1,
            Boundary::Periodic => 0,
        }
    }

    /// The first, by index, of the elements of the whole grid represented by the element in a row and column.
    pub fn first_image(&self, place: [usize; 2]) -> [usize; 2] {
        self.grid.first_image(self.on_grid(place))
    }

    /// The first of the points (m) for which a point stands.
    pub fn first_image_of_point(&self, point: [f64; 2]) -> [f64; 2] {
        self.grid.first_image_of_point(point)
    }

    /// The place of the element whose first image is this element of the whole grid.
    pub fn place_of_image(&self, image: [usize; 2]) -> Place {
        // An element is the first image of its own first image.
        let element = self.grid.first_image(image);
        [0, 1].map(|axis: usize| element[axis].cast_signed() - self.origin[axis].cast_signed())
    }

    /// The fraction of the cell between four places starting at this one that belongs to the sector: a cell across an
    /// axis of symmetry belongs to several sectors.
    pub fn share_of_cell(&self, place: Place) -> f64 {
        let parts = self.grid.parts().into_iter().zip(place);
        let across = parts.filter(|(_, i)| *i < 0).map(|(parts, _)| parts);
        1.0 / across.product::<usize>() as f64
    }

    /// The elements beside which the grid continues without symmetry; none if the region is all of it.
    pub fn border(&self) -> impl Iterator<Item = usize> + use<> {
        let rim = (!self.is_whole()).then(|| self.rim());
        rim.into_iter().flatten()
    }

    /// The outermost elements; the axes of a sector are not part of the rim.
    pub fn rim(&self) -> impl Iterator<Item = usize> + use<> {
        let [rows, size] = self.lengths();
        let ends = |axis: usize, last: usize| {
            let first = (!self.grid.mirrored()[axis]).then_some(0);
            first.into_iter().chain([last])
        };
        let of_rows = ends(0, rows - 1).flat_map(move |i| (0..size).map(move |j| i * size + j));
        let of_columns = ends(1, size - 1).flat_map(move |j| (0..rows).map(move |i| i * size + j));
        of_rows.chain(of_columns)
    }

    /// The index in the region of the element in a row and column of the grid; none if it is outside.
    pub fn place(&self, [row, column]: [usize; 2]) -> Option<usize> {
        let [line, column] = [
            row.checked_sub(self.origin[0])?,
            column.checked_sub(self.origin[1])?,
        ];
        let [rows, columns] = self.lengths();
        (line < rows && column < columns).then(|| line * self.size + column)
    }
}
