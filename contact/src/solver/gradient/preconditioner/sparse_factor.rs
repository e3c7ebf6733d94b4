//! A factorised sparse approximate inverse of the system on the working set, `(K + η)_II⁻¹ ≈ Gᵀ G`.
//!
//! The elements are [ordered](self::order) from coarse to fine and grouped into small tiles. The elements of a tile
//! share their nearest *earlier* elements as neighbours, and their rows of `G` are the last rows of the inverse
//! Cholesky factor of the small dense system of these neighbours and themselves (Kaporin 1994; Vecchia's approximation,
//! optimal in the Kullback–Leibler sense, and its aggregation: Schäfer, Katzfuss and Owhadi 2021):
//!
//! ```text
//! (K + η)_nn = L Lᵀ,    Lᵀ g = e
//! ```
//!
//! A tile shares work among its elements: one dense factor, one search for neighbours and one gathering of values,
//! where separate rows would take a dozen of each.
//!
//! Coefficients depend only on the offset, so tiles whose elements and neighbours have the same places and compliances
//! share one block: nearly all tiles inside a smooth contact, few on a rough surface. Computed blocks are kept while
//! the set changes, so an exchange costs only the blocks whose elements it affects.
//!
//! A small set is solved directly instead.

mod blocks;
mod cholesky;
mod direct;
mod local_system;
mod order;
pub mod scattered;

use std::{
    collections::HashMap,
    sync::{Arc, LazyLock},
};

use pellicle_influence::SurfaceElasticity;
use rayon::prelude::*;

use self::{
    blocks::{FactorBlocks, Product, Room},
    direct::DirectFactor,
    local_system::{LocalSystem, NearCoefficients, Workspace, class},
    order::{COLOURS, TILE, colour, earlier_offsets, own_offsets},
};
use crate::grid::region::Region;
use crate::problem::support::Support;
use crate::solver::gradient::working_set::WorkingSet;
use crate::vector::single;

/// Most elements of a set that is solved directly: with 140 elements of 65,536 this takes 11 products instead of 40.
const MOST_DIRECT: f64 = 500.0;
/// The same on large grids: the cube of its elements over those of the grid, so that the dense factor costs no more
/// than a few products. With it 750 elements of 1024² take 11 products instead of 53.
const MOST_DIRECT_CUBED: f64 = 2000.0;
/// Places searched for a tile's neighbours, nearest first. In a contact of a few summits most are empty: 160 places
/// take twice the products.
const PLACES: usize = 4000;
/// Distance from an axis of symmetry, in units of the spacing of a tile's level, within which mirror images are
/// included in a block: with 8 a bare coating 1000 times as stiff takes a third more products at N = 512.
const NEAR_AXIS: u32 = 24;
/// Length of a pattern's header.
const HEADER_LENGTH: usize = 4;
/// Numbers in all blocks together beyond which all blocks are discarded, about 0.5 GB: a path of many loads keeps
/// adding blocks.
const MOST_ENTRIES: usize = 1 << 27;
/// Tiles whose blocks, about 1 MB, serve both products while they are in the cache: with all tiles at a time, and in
/// double precision, a rough film takes a tenth longer on a grid of 1024².
const TOGETHER: usize = 1 << 8;
/// Fewest of them per thread.
const AT_LEAST: usize = TOGETHER / 8;
/// Tiles per parallel chunk; the same for every number of threads.
const PART: usize = 1 << 9;

/// The factor `G` on the working set of one region.
pub struct SparseFactor {
    region: Region,
    /// Its rows, and elements per row.
    lengths: [usize; 2],
    /// The coarsest level, which has one element.
    top: u32,
    neighbours: usize,
    elasticity: Arc<SurfaceElasticity>,
    /// Class of `η/K₀₀` of every element.
    classes: Vec<u16>,
    /// The block of each known pattern.
    known: HashMap<Pattern, u32>,
    blocks: FactorBlocks,
    /// Coefficients between elements of each level.
    near: Vec<NearCoefficients>,
    /// Compliance `η` of the relief (m/Pa).
    compliance: Vec<f64>,
    /// The factor of a small set, instead of the blocks.
    direct: Option<DirectFactor>,
    /// The tiles that hold elements of the set.
    tiles: Vec<Tile>,
    /// `r` on the grid.
    residual: Vec<f32>,
    /// `G r` on [`TOGETHER`] of them.
    product: Vec<Product>,
    /// `Gᵀ G r` on the grid.
    image: Vec<f64>,
}

/// A tile that holds elements of the set.
#[derive(Clone, Copy)]
struct Tile {
    /// Index of its first place.
    first: i32,
    block: u32,
}

/// Offsets of earlier elements, by colour.
static EARLIER: LazyLock<[Vec<[i32; 2]>; 4]> =
    LazyLock::new(|| [0, 1, 2, 3].map(|colour| earlier_offsets(colour, PLACES)));
/// Offsets of a tile's own elements.
static OWN: LazyLock<Vec<[i32; 2]>> = LazyLock::new(own_offsets);
/// The same for the only tile of the coarsest level.
const TOP_OFFSETS: [[i32; 2]; 1] = [[0, 0]];

/// The key of a block: level and colour, the tile's distance from nearby axes of a quadrant, the number of its own
/// elements, and for each of them and each neighbour the index of its offset and its class.
type Pattern = Box<[u32]>;

impl SparseFactor {
    /// Creates a factor for a region, with `neighbours` entries per block in addition to the tile's own elements.
    pub fn new(
        elasticity: Arc<SurfaceElasticity>,
        region: &Region,
        relief_compliance: &[f64],
        neighbours: usize,
    ) -> Self {
        let lengths = region.lengths();
        let side = lengths.into_iter().max().unwrap_or(0);
        let top = side.next_power_of_two().trailing_zeros();
        Self {
            region: *region,
            lengths,
            top,
            neighbours,
            classes: classes(&elasticity, relief_compliance),
            compliance: relief_compliance.to_vec(),
            direct: None,
            known: HashMap::new(),
            blocks: FactorBlocks::default(),
            near: (0..=top)
                .map(|level| NearCoefficients::of(&elasticity, level))
                .collect(),
            tiles: Vec::new(),
            residual: Vec::new(),
            product: Vec::new(),
            image: Vec::new(),
            elasticity,
        }
    }

    /// Sets other compliances of the relief, in m/Pa. Patterns include the compliances, so known blocks stay valid.
    pub fn take_compliance(&mut self, relief_compliance: &[f64]) {
        self.classes = classes(&self.elasticity, relief_compliance);
        self.compliance.copy_from_slice(relief_compliance);
    }

    /// Finds the block of every tile that holds elements of the set, and computes new ones.
    pub fn update(&mut self, support: &dyn Support, set: &WorkingSet) {
        self.direct = None;
        let most_direct = (MOST_DIRECT_CUBED * set.mask().len() as f64).cbrt();
        if set.len() as f64 <= MOST_DIRECT.max(most_direct) {
            self.direct = DirectFactor::new(support, &self.compliance, set.mask());
            if self.direct.is_some() {
                return;
            }
        }
        if self.blocks.entries() > MOST_ENTRIES {
            self.known.clear();
            self.blocks = FactorBlocks::default();
        }
        let found: Vec<(Tile, Option<Pattern>)> = (0..=self.top)
            .flat_map(|level| self.look_up(level, set.mask()))
            .collect();
        self.tiles.clear();
        let mut fresh: Vec<Pattern> = Vec::new();
        for (mut tile, unknown) in found {
            if let Some(pattern) = unknown {
                let next = self.blocks.len() + fresh.len();
                tile.block = *self.known.entry(pattern).or_insert_with_key(|pattern| {
                    fresh.push(pattern.clone());
                    u32::try_from(next).expect("fewer blocks than elements")
                });
            }
            self.tiles.push(tile);
        }
        let mut blocks = std::mem::take(&mut self.blocks);
        let sizes: Vec<[usize; 2]> = fresh.iter().map(size_of).collect();
        let rooms = blocks.make_room(&sizes);
        let rooms = rooms.into_par_iter().zip(&fresh).with_min_len(8);
        rooms.for_each_init(Workspace::default, |workspace, (room, pattern)| {
            self.compute(pattern, workspace, room);
        });
        self.blocks = blocks;
    }

    /// The tiles of a level that hold elements, with their blocks or the patterns of blocks not yet known.
    fn look_up(&self, level: u32, mask: &[bool]) -> Vec<(Tile, Option<Pattern>)> {
        let [rows, columns] =
            (self.lengths).map(|along| index(along.div_ceil((TILE as usize) << level)));
        let tiles = (0..rows * columns).into_par_iter().with_min_len(PART);
        let found: Vec<Vec<(Tile, Option<Pattern>)>> = tiles
            .fold(Vec::new, |mut found, tile| {
                found.extend(self.look_up_tile(level, [tile / columns, tile % columns], mask));
                found
            })
            .collect();
        found.into_iter().flatten().collect()
    }

    fn look_up_tile(
        &self,
        level: u32,
        tile: [i32; 2],
        mask: &[bool],
    ) -> Option<(Tile, Option<Pattern>)> {
        let first = tile.map(|along| (along * TILE) << level);
        let members = |offsets| self.members(first, level, offsets, mask);
        let own: Vec<u32> = members(self.own(level)).collect();
        if own.is_empty() {
            return None;
        }
        let (near, colour) = (self.near_axis(level), colour(tile[0], tile[1]));
        let mut pattern = Vec::with_capacity(HEADER_LENGTH + own.len() + self.neighbours);
        pattern.push(COLOURS * level + colour);
        pattern.extend([0, 1].map(|axis: usize| first[axis].unsigned_abs().min(near[axis])));
        pattern.push(index(own.len()).unsigned_abs());
        pattern.extend(own);
        pattern.extend(members(self.earlier(level, colour)).take(self.neighbours));
        let known = self.known.get(pattern.as_slice()).copied();
        let tile = Tile {
            first: first[0] * index(self.row()) + first[1],
            block: known.unwrap_or(u32::MAX),
        };
        Some((tile, known.is_none().then(|| pattern.into_boxed_slice())))
    }

    /// The elements of the set at these offsets, as entries of a pattern.
    fn members(
        &self,
        [i, j]: [i32; 2],
        level: u32,
        offsets: &'static [[i32; 2]],
        mask: &[bool],
    ) -> impl Iterator<Item = u32> {
        (0..).zip(offsets).filter_map(move |(place, [x, y])| {
            let (i, j) = (
                self.within(0, i + (x << level))?,
                self.within(1, j + (y << level))?,
            );
            let element = i * self.row() + j;
            mask[element].then(|| place << 16 | u32::from(self.classes[element]))
        })
    }

    /// Offsets of the own elements of a level's tiles.
    fn own(&self, level: u32) -> &'static [[i32; 2]] {
        if level == self.top {
            &TOP_OFFSETS
        } else {
            &OWN
        }
    }

    /// Offsets of earlier elements; none for the coarsest level.
    fn earlier(&self, level: u32, colour: u32) -> &'static [[i32; 2]] {
        if level == self.top {
            &[]
        } else {
            &EARLIER[colour as usize]
        }
    }

    /// Distance in elements from each axis within which mirror images are included in a block of this level; 0 for an
    /// axis without symmetry.
    fn near_axis(&self, level: u32) -> [u32; 2] {
        let lines = self.region.mirrored_lines((NEAR_AXIS << level) as usize);
        lines.map(|lines| index(lines).unsigned_abs())
    }

    /// Elements per row.
    fn row(&self) -> usize {
        let [_, size] = self.lengths;
        size
    }

    /// The index of a row or column, if it is on the grid.
    fn within(&self, axis: usize, index: i32) -> Option<usize> {
        let place = usize::try_from(index).ok()?;
        (place < self.lengths[axis]).then_some(place)
    }

    /// Computes the block of a pattern.
    fn compute(&self, pattern: &Pattern, workspace: &mut Workspace, room: Room<'_>) {
        let (level, colour) = (pattern[0] / COLOURS, pattern[0] % COLOURS);
        let (own, neighbours) = pattern[HEADER_LENGTH..].split_at(own_of(pattern));
        let place = |offsets: &[[i32; 2]], entry: &u32| offsets[(entry >> 16) as usize];
        let earlier = neighbours
            .iter()
            .map(|entry| place(self.earlier(level, colour), entry));
        let places: Vec<[i32; 2]> = earlier
            .chain(own.iter().map(|entry| place(self.own(level), entry)))
            .collect();
        let classes: Vec<u16> = neighbours
            .iter()
            .chain(own)
            .map(|entry| class_in(*entry))
            .collect();
        let near = self.near_axis(level);
        let system = LocalSystem {
            elasticity: &self.elasticity,
            near: &self.near[level as usize],
            level,
            places: &places,
            classes: &classes,
            own: own.len(),
            to_axis: [0, 1].map(|axis: usize| {
                let along = pattern[1 + axis];
                (along < near[axis]).then_some(along)
            }),
        };
        let row = index(self.row());
        let distances = places.iter().map(|[x, y]| (x * row + y) << level);
        room.fill(distances, system.rows(workspace));
    }

    /// `r ← Gᵀ G r`, up to single precision; values outside the set become 0.
    pub fn apply(&mut self, field: &mut [f64]) {
        if let Some(direct) = &mut self.direct {
            return direct.apply(field);
        }
        self.image.clear();
        self.image.resize(field.len(), 0.0);
        self.residual.clear();
        self.residual.extend(field.iter().map(|r| single(*r)));
        let (blocks, residual) = (&self.blocks, &self.residual);
        for tiles in self.tiles.chunks(TOGETHER) {
            let products = tiles.par_iter().with_min_len(AT_LEAST).map(|tile| {
                let block = blocks.block(tile.block);
                block.multiply(tile.first, residual)
            });
            products.collect_into_vec(&mut self.product);
            for (tile, y) in tiles.iter().zip(&self.product) {
                let block = blocks.block(tile.block);
                block.add_transposed(tile.first, y, &mut self.image);
            }
        }
        field.copy_from_slice(&self.image);
    }
}

/// The numbers of a pattern's unknowns and of the tile's own elements among them.
fn size_of(pattern: &Pattern) -> [usize; 2] {
    [pattern.len() - HEADER_LENGTH, own_of(pattern)]
}

fn own_of(pattern: &Pattern) -> usize {
    pattern[HEADER_LENGTH - 1] as usize
}

/// The class of every element's compliance (m/Pa).
fn classes(elasticity: &SurfaceElasticity, relief_compliance: &[f64]) -> Vec<u16> {
    let own = elasticity.coefficient([0, 0]);
    let classes = relief_compliance.iter().map(|eta| class(eta / own));
    classes.collect()
}

/// The class of compliance in the lower half of a pattern's entry.
fn class_in(entry: u32) -> u16 {
    let [_, _, high, low] = entry.to_be_bytes();
    u16::from_be_bytes([high, low])
}

/// A grid index as a signed number; grids end at 16,384 elements per side.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    reason = "indices of a grid lie far below 2³¹"
)]
fn index(index: usize) -> i32 {
    index as i32
}
