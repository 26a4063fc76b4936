//! What stands where, and whether something fits: [`Space`], [`SurfaceInWorld`].

use super::{House, Surface, Thing};
use crate::geometry::{Pose, Size};
use crate::simulation::blocks::{Block, depth, parts};

/// Boxes that reach into each other by less than this only touch, metres.
pub const TOUCH_M: f64 = 0.003;
/// How far a thing may jut out over the edge of a surface, metres.
const EDGE_M: f64 = 0.005;

/// A surface of a thing in the world frame.
#[derive(Clone, Debug, PartialEq)]
pub struct SurfaceInWorld {
    /// What it is called.
    pub name: String,
    /// Its middle, metres.
    pub centre: [f64; 2],
    /// Direction of its first axis, a unit vector; the second is a quarter turn to the left.
    pub along: [f64; 2],
    /// Half extents along its axes, metres.
    pub half: [f64; 2],
    /// Its height, metres.
    pub z: f64,
    /// Free height above it, metres.
    pub clearance_m: Option<f64>,
}

/// Why something does not fit.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Misfit {
    /// Its footprint reaches beyond the surface.
    #[error("it juts {by_m:.2} m out over the edge of the surface")]
    JutsOut {
        /// How far.
        by_m: f64,
    },
    /// There is something close above the surface.
    #[error("it is {high_m:.2} m high, but there are only {free_m:.2} m above the surface")]
    TooHigh {
        /// Its height.
        high_m: f64,
        /// The free height.
        free_m: f64,
    },
    /// It stands too high or too low.
    #[error("its lower face is {by_m:.3} m above the surface")]
    Floats {
        /// How far; negative if it is below.
        by_m: f64,
    },
    /// Something else is there.
    #[error("it reaches {by_m:.3} m into {}", .other.map_or("a wall".to_owned(), |n| format!("thing {n}")))]
    Occupied {
        /// Number of the other thing; none for a wall.
        other: Option<usize>,
        /// How far.
        by_m: f64,
    },
}

/// A surface of `thing`, where the thing is now. Things on their side have no level surfaces:
/// the answer makes sense only for upright ones.
pub fn surface_in_world(thing: &Thing, surface: &Surface) -> SurfaceInWorld {
    let (low, high) = (surface.min, surface.max);
    let z = surface.z;
    let block = Block::of(&thing.pose, [low[0], low[1], z], [high[0], high[1], z]);
    SurfaceInWorld {
        name: surface.name.clone(),
        centre: block.centre,
        along: block.along,
        half: block.half,
        z: block.z[1],
        clearance_m: surface.clearance_m,
    }
}

impl SurfaceInWorld {
    /// Whether the footprint of a box lies on the surface, and its height under what is above.
    /// Looks at nothing else that stands there, and not at the height of `pose`.
    pub fn holds(&self, pose: &Pose, size: Size) -> Result<(), Misfit> {
        let block = around(pose, size);
        let by_m = self.beyond(&block);
        if by_m > EDGE_M {
            return Err(Misfit::JutsOut { by_m });
        }
        let high_m = block.z[1] - block.z[0];
        match self.clearance_m {
            Some(free_m) if free_m < high_m => Err(Misfit::TooHigh { high_m, free_m }),
            _ => Ok(()),
        }
    }

    /// How far the farthest corner lies beyond the edge; negative if all are within.
    fn beyond(&self, block: &Block) -> f64 {
        let ([c, s], [a, b]) = (self.along, self.half);
        let beyond = |[x, y]: [f64; 2]| {
            let (dx, dy) = (x - self.centre[0], y - self.centre[1]);
            ((dx * c + dy * s).abs() - a).max((dy * c - dx * s).abs() - b)
        };
        block.corners().into_iter().map(beyond).fold(f64::NEG_INFINITY, f64::max)
    }
}

/// The box of a thing.
pub fn around(pose: &Pose, size: Size) -> Block {
    let half = size.metres().map(|side| side / 2.0);
    Block::of(pose, half.map(|h| -h), half)
}

/// What takes up space in a house: walls, and the parts of things; kept up to date while things
/// are moved.
#[derive(Clone, Debug)]
pub struct Space {
    walls: Vec<Block>,
    shapes: Vec<Vec<([f64; 3], [f64; 3])>>,
    things: Vec<Option<Vec<Block>>>,
}

impl Space {
    /// A house as it was built.
    pub fn new(house: &House) -> Self {
        let walls = house.walls().iter().map(|slab| around(&slab.pose, slab.size)).collect();
        let mut space = Self { walls, shapes: Vec::new(), things: Vec::new() };
        house.things.iter().for_each(|thing| space.add(thing));
        space
    }

    /// One more thing; its number is that of things so far.
    pub fn add(&mut self, thing: &Thing) {
        self.shapes.push(parts(&thing.mesh));
        self.things.push(None);
        self.put(self.things.len() - 1, Some(&thing.pose));
    }

    /// Thing number `n` is now somewhere else, or nowhere.
    pub fn put(&mut self, n: usize, pose: Option<&Pose>) {
        self.things[n] = pose.map(|pose| self.blocks(n, pose));
    }

    fn blocks(&self, n: usize, pose: &Pose) -> Vec<Block> {
        self.shapes[n].iter().map(|(low, high)| Block::of(pose, *low, *high)).collect()
    }

    /// Whether thing number `n` could be at `pose` without reaching into a wall or another
    /// thing. The parts of things are looked at one by one: a chair stands under a table, a book
    /// between the boards of a shelf.
    pub fn is_free(&self, n: usize, pose: &Pose) -> Result<(), Misfit> {
        self.collision(n, &self.blocks(n, pose), TOUCH_M)
    }

    /// As [`Space::is_free`] for thing number `n` where it is; of pairs only that with a lower
    /// number is told.
    pub(super) fn collision_of(&self, n: usize) -> Result<(), Misfit> {
        let Some(own) = &self.things[n] else { return Ok(()) };
        self.collision(n, own, TOUCH_M)
    }

    fn collision(&self, n: usize, own: &[Block], touch_m: f64) -> Result<(), Misfit> {
        let by_m = depth(own, &self.walls);
        if by_m > touch_m {
            return Err(Misfit::Occupied { other: None, by_m });
        }
        for (other, blocks) in self.things.iter().enumerate() {
            let Some(blocks) = blocks.as_ref().filter(|_| other != n) else { continue };
            if is_mat(blocks) != is_mat(own) {
                continue;
            }
            let by_m = depth(own, blocks);
            if by_m > touch_m {
                return Err(Misfit::Occupied { other: Some(other), by_m });
            }
        }
        Ok(())
    }

    /// Whether thing number `n` could stand at `pose` on a surface: it lies on it, within its
    /// edges, below what is above, and collides with nothing.
    pub fn fits(
        &self,
        n: usize,
        size: Size,
        pose: &Pose,
        surface: &SurfaceInWorld,
    ) -> Result<(), Misfit> {
        surface.holds(pose, size)?;
        let by_m = around(pose, size).z[0] - surface.z;
        if by_m.abs() > TOUCH_M {
            return Err(Misfit::Floats { by_m });
        }
        self.is_free(n, pose)
    }

    /// How far the nearest wall is from the box of a thing, metres; negative inside.
    pub(super) fn to_wall(&self, pose: &Pose, size: Size) -> f64 {
        let own = around(pose, size);
        -self.walls.iter().map(|wall| wall.depth(&own)).fold(f64::NEG_INFINITY, f64::max)
    }
}

/// Whether it lies flat on the floor, as a rug does: other things may stand on it.
fn is_mat(blocks: &[Block]) -> bool {
    blocks.iter().all(|block| block.z[0] > -0.01 && block.z[1] < 0.025)
}
