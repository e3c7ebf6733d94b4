//! Whether a contact continues beyond its domain or the map of a measured surface.
//!
//! A solution on the square, extended by zero pressure, solves the contact problem on the whole plane if nothing
//! overlaps outside the square, that is, if `u + g0 ≥ D` there. Next to the edge this holds where no element on the rim
//! of the square has pressure, or the initial gap behind it is wider than `D`. Farther away `u` is computed from the
//! pressure summed over blocks, on ever larger squares for as long as the indenter is lower than `D`. For an indenter
//! that rises from its axis, the height alone or a few blocks usually suffice.

use std::{cell::OnceCell, sync::Arc};

use pellicle_influence::{SectorGrid, SurfaceElasticity};
use pellicle_texture::{Grid, Relief};

use crate::problem::model::initial_gap;
use crate::{Indenter, Model, Profile, Solution};

/// Blocks per side over which the pressure is summed.
const BLOCKS: usize = 64;
/// Blocks per side of the first, coarse check.
const FEW_BLOCKS: usize = 16;
/// Gap over penetration at which the coarse check is conclusive: it is accurate to some hundredths of the penetration.
const CLEAR: f64 = 0.1;
/// Overlap over penetration beyond the domain that counts as contact: the displacement of blocks is accurate to some
/// thousandths of the penetration.
const OVERLAP: f64 = 0.01;
/// Most doublings of the square: a thousand million times the domain.
const MOST_DOUBLINGS: usize = 30;

/// The limit at which a contact is cut off.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CutOff {
    /// The edge of the domain.
    Domain,
    /// The end of a measured relief, beyond which the surface is unknown.
    ReliefMap,
    /// The end of a measured indenter that was cut out of something larger.
    IndenterMap,
}

/// Whether the indenter covers the centre of any element.
pub(crate) fn can_touch(model: &Model, grid: &Grid) -> bool {
    lowest_height(model, grid).is_finite()
}

/// The indenter's smallest height at the elements next to its axis, m. It is infinite if the indenter covers no
/// element's centre, since no indenter has a hole or a recess at its axis.
pub(crate) fn lowest_height(model: &Model, grid: &Grid) -> f64 {
    let beside_middle = |axis: usize| {
        let length = grid.lengths()[axis];
        let lines = [(length / 2).saturating_sub(1), (length / 2).min(length - 1)];
        lines.map(|i| grid.centre_along(axis, i))
    };
    let [along_x, along_y] = [0, 1].map(beside_middle);
    smallest(&(model.indenter).heights(&along_x.map(|x| along_y.map(|y| [x, y])).concat()))
}

/// The surroundings of a domain, computed as far as needed.
pub(crate) struct Surroundings<'a> {
    model: &'a Model,
    grid: Grid,
    frames: Vec<SquareFrame>,
}

/// The frame between a square and one of twice its side.
struct SquareFrame {
    /// A check of the indenter alone, if it rises from its axis: no gap is smaller than its height.
    coarse_check: Option<CoarseCheck>,
    /// Made on first use.
    blocks: Option<Blocks>,
}

/// A coarse check of a frame.
struct CoarseCheck {
    /// The indenter's smallest height on the inner edge, m.
    lowest: f64,
    /// Made on first use.
    blocks: Option<Blocks>,
}

/// A frame in blocks.
struct Blocks {
    around: Around,
    /// `g0` (m) at the blocks of the larger square; infinite on those of the smaller.
    gaps: Vec<f64>,
    /// The smallest gap, m.
    smallest_gap: f64,
    /// The indenter's smallest height at the blocks of the frame, m.
    lowest: f64,
    /// Made on first use; none if there are no coefficients for blocks this large.
    elasticity: OnceCell<Option<Arc<SurfaceElasticity>>>,
}

impl<'a> Surroundings<'a> {
    pub fn of(model: &'a Model, grid: Grid) -> Self {
        Self {
            model,
            grid,
            frames: Vec::new(),
        }
    }

    /// Returns the limit that cuts off the contact of a solution, if any.
    pub fn limit_reached(&mut self, solution: &Solution) -> Option<CutOff> {
        map_reached(self.model, &self.grid, &solution.pressure)
            .or_else(|| self.cut_off(solution).then_some(CutOff::Domain))
    }

    /// Whether a larger domain would have contact outside this one.
    pub fn cut_off(&mut self, solution: &Solution) -> bool {
        let is_contact = solution.pressure.iter().any(|p| *p > 0.0);
        is_contact
            && solution.penetration.is_finite()
            && (self.presses_at_the_rim(solution) || self.overlaps_farther_away(solution))
    }

    /// Whether an element on the rim has pressure while the gap behind it is less than the penetration.
    fn presses_at_the_rim(&self, solution: &Solution) -> bool {
        let (size, last) = (self.grid.size(), self.grid.size() - 1);
        let outside = self.grid.centre(last) + self.grid.element_side();
        let continues = |i: usize, j: usize, behind: [f64; 2]| {
            solution.pressure[i * size + j] > 0.0
                && initial_gap_at(self.model, behind) < solution.penetration
        };
        (0..size).any(|k| {
            let along = self.grid.centre(k);
            continues(0, k, [-outside, along])
                || continues(last, k, [outside, along])
                || continues(k, 0, [along, -outside])
                || continues(k, last, [along, outside])
        })
    }

    /// Whether the indenter overlaps the surrounding surface, as displaced by the pressure.
    fn overlaps_farther_away(&mut self, solution: &Solution) -> bool {
        for doublings in 0..MOST_DOUBLINGS {
            if self.frames.len() == doublings {
                self.frames
                    .push(SquareFrame::of(self.model, self.side(doublings)));
            }
            let side = self.side(doublings);
            let frame = &mut self.frames[doublings];
            if frame.overlaps(self.model, side, &self.grid, solution) {
                return true;
            }
            if frame.is_the_last(self.model, side, solution.penetration) {
                break;
            }
        }
        false
    }

    /// Side of the smaller square of a frame, m.
    fn side(&self, doublings: usize) -> f64 {
        (0..doublings).fold(self.grid.side(), |side, _| 2.0 * side)
    }
}

impl SquareFrame {
    fn of(model: &Model, side: f64) -> Self {
        let rises = !matches!(
            model.indenter,
            Indenter::Map(_) | Indenter::Plane(_) | Indenter::Custom(_)
        );
        Self {
            coarse_check: rises.then(|| CoarseCheck::of(model, side)),
            blocks: None,
        }
    }

    /// Whether anything overlaps within the frame.
    fn overlaps(&mut self, model: &Model, side: f64, grid: &Grid, solution: &Solution) -> bool {
        if let Some(coarse_check) = &mut self.coarse_check
            && coarse_check.is_clear(model, side, grid, solution)
        {
            return false;
        }
        let blocks = self
            .blocks
            .get_or_insert_with(|| Blocks::of(model, &model.relief, Around::new(side, BLOCKS)));
        let touched = (1.0 - OVERLAP) * solution.penetration;
        blocks.is_closer_than(touched, model, grid, solution)
    }

    /// Whether the indenter is higher than the penetration everywhere beyond this frame: every shape rises from its
    /// axis except a map, which ends somewhere, and a plane, above which a map's surface is the same beyond its end.
    fn is_the_last(&self, model: &Model, side: f64, penetration: f64) -> bool {
        match (&self.coarse_check, &self.blocks) {
            (None, Some(blocks)) if matches!(model.indenter, Indenter::Plane(_)) => {
                is_beyond_the_map(&model.relief, side) && blocks.smallest_gap >= penetration
            }
            (Some(coarse_check), _) => coarse_check.lowest >= penetration,
            (None, Some(blocks)) if matches!(model.indenter, Indenter::Map(_)) => {
                blocks.lowest.is_infinite()
            }
            (None, Some(blocks)) => blocks.lowest >= penetration,
            (None, None) => false,
        }
    }
}

/// Whether everything outside a square of this side (m) lies beyond the end of a relief's map.
fn is_beyond_the_map(relief: &Relief, side: f64) -> bool {
    let Relief::Map(relief) = relief else {
        return false;
    };
    let extent = relief.map().extent();
    extent.iter().all(|own| *own <= side * (1.0 + f64::EPSILON))
}

impl CoarseCheck {
    fn of(model: &Model, side: f64) -> Self {
        let edge = |k: usize| (k as f64 / BLOCKS as f64 - 0.5) * side;
        let half = 0.5 * side;
        let places = (0..=BLOCKS).flat_map(|k| {
            let along = edge(k);
            [[-half, along], [half, along], [along, -half], [along, half]]
        });
        let places: Vec<_> = places.collect();
        Self {
            lowest: smallest(&model.indenter.heights(&places)),
            blocks: None,
        }
    }

    /// Whether there is certainly no overlap.
    fn is_clear(&mut self, model: &Model, side: f64, grid: &Grid, solution: &Solution) -> bool {
        let depth = solution.penetration;
        if self.lowest >= depth {
            return true;
        }
        let blocks = self
            .blocks
            .get_or_insert_with(|| Blocks::of(model, &Relief::Bare, Around::new(side, FEW_BLOCKS)));
        blocks.can_move(model)
            && !blocks.is_closer_than((1.0 + CLEAR) * depth, model, grid, solution)
    }
}

impl Blocks {
    /// Computes the gaps above this relief.
    fn of(model: &Model, relief: &Relief, around: Around) -> Self {
        let count = around.count();
        let blocks = (0..count * count).map(|block| [block / count, block % count]);
        let outer = blocks.clone().filter(|block| !around.is_within(*block));
        let places: Vec<_> = outer.map(|block| block.map(|i| around.centre(i))).collect();
        let heights = model.indenter.heights(&places);
        let outer_gaps = initial_gap(&heights, &relief.profile_at(&places));
        let mut next = outer_gaps.iter().copied();
        let gap = |block| {
            let gap = (!around.is_within(block)).then(|| next.next());
            gap.flatten().unwrap_or(f64::INFINITY)
        };
        Self {
            around,
            smallest_gap: smallest(&outer_gaps),
            gaps: blocks.map(gap).collect(),
            lowest: smallest(&heights),
            elasticity: OnceCell::new(),
        }
    }

    fn elasticity(&self, model: &Model) -> Option<&Arc<SurfaceElasticity>> {
        let made = self
            .elasticity
            .get_or_init(|| self.around.elasticity(model));
        made.as_ref()
    }

    /// Whether there are coefficients for blocks this large.
    fn can_move(&self, model: &Model) -> bool {
        self.elasticity(model).is_some()
    }

    /// Whether the gap from the undeformed indenter to the displaced surface is anywhere less than `limit` (m); false
    /// without coefficients.
    fn is_closer_than(&self, limit: f64, model: &Model, grid: &Grid, solution: &Solution) -> bool {
        if self.smallest_gap >= limit {
            return false;
        }
        let around = self.around;
        let Some(elasticity) = self.elasticity(model) else {
            return false;
        };
        let pressure = around.summed(grid, &solution.pressure);
        let count = around.count();
        let mut displacement = vec![0.0; count * count];
        let (shown, first) = (SectorGrid::whole(count), [around.first(); 2]);
        let mut operator = elasticity.under_window(shown, first, around.within);
        operator.apply_into(&pressure, &mut displacement);
        let mut places = displacement.iter().zip(&self.gaps);
        places.any(|(u, g0)| u + g0 < limit)
    }
}

/// The blocks of a square around another of half its side.
#[derive(Clone, Copy)]
struct Around {
    /// Side of a block, m.
    block: f64,
    /// Blocks per side of the smaller square.
    within: usize,
}

impl Around {
    /// Surrounds a smaller square of side `side` (m) with `within` blocks per side.
    fn new(side: f64, within: usize) -> Self {
        Self {
            block: side / within as f64,
            within,
        }
    }

    /// Blocks per side of the larger square.
    fn count(self) -> usize {
        2 * self.within
    }

    /// The first block of the smaller square.
    fn first(self) -> usize {
        self.within / 2
    }

    fn is_within(self, block: [usize; 2]) -> bool {
        let within = self.first()..self.first() + self.within;
        block.iter().all(|k| within.contains(k))
    }

    fn elasticity(self, model: &Model) -> Option<Arc<SurfaceElasticity>> {
        let grid = Grid::new(self.block * self.count() as f64, self.count()).ok()?;
        Some(model.elasticity(&grid).ok()?.value)
    }

    fn centre(self, i: usize) -> f64 {
        (i as f64 + 0.5 - self.within as f64) * self.block
    }

    /// The pressure of a grid in the middle, summed over the blocks of the smaller square.
    fn summed(self, grid: &Grid, pressure: &[f64]) -> Vec<f64> {
        let size = grid.size();
        let shares: Vec<_> = (0..size).map(|i| self.shares(grid, i)).collect();
        let per_block = (grid.element_side() / self.block).powi(2);
        let mut blocks = vec![0.0; self.within.pow(2)];
        for (i, row) in pressure.chunks_exact(size).enumerate() {
            for (j, p) in row.iter().enumerate().filter(|(_, p)| **p > 0.0) {
                for (bi, along_x) in &shares[i] {
                    for (bj, along_y) in &shares[j] {
                        blocks[bi * self.within + bj] += along_x * along_y * per_block * p;
                    }
                }
            }
        }
        blocks
    }

    /// The blocks that an element covers along one axis, with its share in each.
    fn shares(self, grid: &Grid, i: usize) -> Vec<(usize, f64)> {
        let half = grid.element_side() / 2.0;
        let count = self.within as f64;
        let place = |x: f64| (x / self.block + count / 2.0).clamp(0.0, count);
        let (from, to) = (place(grid.centre(i) - half), place(grid.centre(i) + half));
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped to the blocks"
        )]
        let blocks = from as usize..(to.ceil() as usize).min(self.within);
        let part = |block: usize| {
            let start = (block as f64).max(from);
            let end = (block as f64 + 1.0).min(to);
            (block, (end - start).max(0.0) / (to - from))
        };
        blocks.map(part).collect()
    }
}

/// The smallest of some lengths; infinite if there are none.
fn smallest(lengths: &[f64]) -> f64 {
    lengths.iter().copied().fold(f64::INFINITY, f64::min)
}

/// `g0 = f − f*` at a point, m.
fn initial_gap_at(model: &Model, [x, y]: [f64; 2]) -> f64 {
    let profile = model.relief.profile_at(&[[x, y]]);
    model.indenter.height(x, y) - profile[0]
}

/// Returns the map whose end the contact reaches, to within an element.
fn map_reached(model: &Model, grid: &Grid, pressure: &[f64]) -> Option<CutOff> {
    let (size, side) = (grid.size(), grid.element_side());
    let presses = |ends: &dyn Fn([f64; 2]) -> bool| {
        let mut pressed = (0..pressure.len()).filter(|e| pressure[*e] > 0.0);
        pressed.any(|e| ends([grid.centre(e / size), grid.centre(e % size)]))
    };
    let along = |[x, y]: [f64; 2], axis: usize| match axis {
        0 => [[x - side, y], [x + side, y]],
        _ => [[x, y - side], [x, y + side]],
    };
    if let Relief::Map(relief) = &model.relief
        && presses(&|place| {
            let mut around = [0, 1].into_iter().flat_map(|axis| along(place, axis));
            !around.all(|next| relief.map().covers(next))
        })
    {
        return Some(CutOff::ReliefMap);
    }
    let ends = |[x, y]: [f64; 2]| model.indenter.height(x, y).is_infinite();
    let Indenter::Map(map) = &model.indenter else {
        return None;
    };
    // An indenter that ends is not cut off: its end is its outline. A scan of something larger is.
    let is_cut = |axis: usize| {
        presses(&|place| along(place, axis).into_iter().any(ends)) && map.rises_to_its_ends(axis)
    };
    [0, 1]
        .into_iter()
        .any(is_cut)
        .then_some(CutOff::IndenterMap)
}

#[cfg(test)]
mod tests;
