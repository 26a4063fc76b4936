//! What is really where: [`TrueWorld`].

use std::sync::Arc;

use super::blocks::{Block, parts, upright, yaw};
use super::house::{House, Space, Surface, Thing};
use super::random::Random;
use super::scenario::Place;
use super::shapes::polygon::contains;
use crate::geometry::Pose;

/// Where a thing is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Presence {
    /// Where its pose says.
    There,
    /// In the robot's gripper.
    Held,
    /// Not in the house any more.
    Gone,
}

/// The house as it is by now. Thing number n is `O{n+1}` of the graph, also once it is gone.
#[derive(Clone, Debug)]
pub struct TrueWorld {
    house: Arc<House>,
    space: Space,
    things: Vec<(Thing, Presence)>,
}

/// Where a thing is put: a place that was found to be free.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// `world_from_object`.
    pub pose: Pose,
    /// Number of the room.
    pub room: usize,
    /// Number of the thing it stands on; none for the floor.
    pub support: Option<usize>,
}

/// Why there is no such place or thing.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PlaceError {
    /// Nothing is called that.
    #[error("there is no {name:?} in the house by then{hint}")]
    NoThing {
        /// What was asked for.
        name: String,
        /// What could be meant.
        hint: String,
    },
    /// Several are.
    #[error("{name:?} may be {}: give the name", .candidates.join(" or "))]
    Ambiguous {
        /// What was asked for.
        name: String,
        /// Their names.
        candidates: Vec<String>,
    },
    /// No such room.
    #[error("there is no room {name:?}; there are {}", .rooms.join(", "))]
    NoRoom {
        /// What was asked for.
        name: String,
        /// Those there are.
        rooms: Vec<String>,
    },
    /// Nothing can be put on it.
    #[error("nothing can be put on {name:?}{surface}; it has {}", list(.has))]
    NoSurface {
        /// What.
        name: String,
        /// Which part of it.
        surface: String,
        /// What it has.
        has: Vec<String>,
    },
    /// There is no room left.
    #[error("{thing:?} does not fit on {on}: {why}")]
    NoRoomLeft {
        /// What was to be put there.
        thing: String,
        /// Where.
        on: String,
        /// Why not.
        why: &'static str,
    },
    /// Neither a support nor a room is given.
    #[error("say where: a thing to put it `on`, or a `room`")]
    Nowhere,
}

fn list(names: &[String]) -> String {
    if names.is_empty() { "no level surface".to_owned() } else { names.join(", ") }
}

/// So many places are tried before it is said that nothing fits.
const TRIES: usize = 400;
/// Things are put this far from edges, and this far from each other, metres.
const MARGIN_M: f64 = 0.015;

impl TrueWorld {
    /// The house as it was built.
    pub fn new(house: Arc<House>) -> Self {
        let things = house.things.iter().map(|thing| (thing.clone(), Presence::There)).collect();
        Self { space: Space::new(&house), things, house }
    }

    /// The house.
    pub fn house(&self) -> &Arc<House> {
        &self.house
    }

    /// What takes up space by now.
    pub fn space(&self) -> &Space {
        &self.space
    }

    /// How many things there ever were.
    pub fn len(&self) -> usize {
        self.things.len()
    }

    /// Whether there never was anything.
    pub fn is_empty(&self) -> bool {
        self.things.is_empty()
    }

    /// Thing number `n`, where it is by now.
    pub fn thing(&self, n: usize) -> &Thing {
        &self.things[n].0
    }

    /// Whether thing number `n` is there.
    pub fn presence(&self, n: usize) -> Presence {
        self.things[n].1
    }

    /// Numbers of the things that are there.
    pub fn present(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.things.len()).filter(|n| self.things[*n].1 == Presence::There)
    }

    /// The thing with this name, or the only one there with this label.
    pub fn find(&self, name: &str) -> Result<usize, PlaceError> {
        if let Some(n) = self.present().find(|n| self.thing(*n).name == name) {
            return Ok(n);
        }
        let found: Vec<usize> =
            self.present().filter(|n| self.thing(*n).label.same_class(name)).collect();
        let named = || name.to_owned();
        match found[..] {
            [n] => Ok(n),
            [] => Err(PlaceError::NoThing { name: named(), hint: self.hint(name) }),
            _ => Err(PlaceError::Ambiguous {
                name: named(),
                candidates: found.iter().map(|n| self.thing(*n).name.clone()).collect(),
            }),
        }
    }

    fn hint(&self, name: &str) -> String {
        let near = self
            .things
            .iter()
            .map(|(thing, _)| thing.name.as_str())
            .find(|known| known.contains(name) || name.contains(known) || similar(known, name));
        near.map_or(String::new(), |known| format!("; is {known:?} meant?"))
    }

    /// Number of the room with this label.
    pub fn room(&self, label: &str) -> Result<usize, PlaceError> {
        let rooms = &self.house.rooms;
        rooms.iter().position(|room| room.label.same_class(label)).ok_or_else(|| {
            PlaceError::NoRoom {
                name: label.to_owned(),
                rooms: rooms.iter().map(|room| room.label.as_str().to_owned()).collect(),
            }
        })
    }

    /// Takes a thing away or into the gripper.
    pub fn take(&mut self, n: usize, presence: Presence) {
        self.things[n].1 = presence;
        self.space.put(n, None);
    }

    /// Puts a thing somewhere, with everything that stands on it.
    pub fn put(&mut self, n: usize, spot: Spot) {
        let (from, to) = (self.thing(n).pose.isometry(), spot.pose.isometry());
        for above in self.standing_on(n) {
            let pose = to * from.inverse() * self.thing(above).pose.isometry();
            if let Ok(pose) = Pose::from_isometry(&pose) {
                self.put(above, Spot { pose, room: spot.room, support: Some(n) });
            }
        }
        let (thing, presence) = &mut self.things[n];
        *presence = Presence::There;
        (thing.pose, thing.room, thing.support) = (spot.pose, spot.room, spot.support);
        self.space.put(n, Some(&spot.pose));
    }

    /// Adds a thing that was never there; its number.
    pub fn add(&mut self, thing: Thing) -> usize {
        self.space.add(&thing);
        self.things.push((thing, Presence::There));
        self.things.len() - 1
    }

    /// Lets what is in the gripper go with it.
    pub fn carry(&mut self, world_from_gripper: &nalgebra::Isometry3<f64>) {
        for (thing, presence) in &mut self.things {
            if *presence == Presence::Held {
                let pose = Pose::from_isometry(world_from_gripper);
                thing.pose = pose.expect("the robot stays where poses are");
            }
        }
    }

    /// What stands on thing number `n`.
    pub fn standing_on(&self, n: usize) -> Vec<usize> {
        self.present().filter(|other| self.thing(*other).support == Some(n)).collect()
    }

    /// A free place for `thing`, which is not in anybody's way itself.
    pub fn place(
        &self,
        thing: &Thing,
        place: &Place,
        random: &mut Random,
    ) -> Result<Spot, PlaceError> {
        match (&place.on, &place.room) {
            (Some(on), _) => self.place_on(thing, self.find(on)?, place, random),
            (None, Some(room)) => self.place_in(thing, self.room(room)?, place, random),
            (None, None) => Err(PlaceError::Nowhere),
        }
    }

    fn place_on(
        &self,
        thing: &Thing,
        on: usize,
        place: &Place,
        random: &mut Random,
    ) -> Result<Spot, PlaceError> {
        let support = self.thing(on);
        let wanted = |surface: &&Surface| {
            place.surface.as_ref().is_none_or(|name| surface.name.eq_ignore_ascii_case(name))
        };
        let surfaces: Vec<&Surface> = support.surfaces.iter().filter(wanted).collect();
        if surfaces.is_empty() {
            return Err(PlaceError::NoSurface {
                name: support.name.clone(),
                surface: place.surface.as_ref().map_or(String::new(), |name| format!("'s {name}")),
                has: support.surfaces.iter().map(|surface| surface.name.clone()).collect(),
            });
        }
        let spot = |pose| Spot { pose, room: support.room, support: Some(on) };
        // The first of several that are one above the other, if the place is given.
        let mut next = surfaces.iter();
        let exact = place.is_exact();
        let tries = if exact { surfaces.len() } else { TRIES };
        self.first_free(thing, tries, random, &mut |random| {
            let surface = if exact { next.next() } else { random.pick(&surfaces) }?;
            let (at, turn) = on_surface(thing, support, surface, place, random)?;
            upright(at, turn).map(spot)
        })
        .ok_or_else(|| no_room_left(thing, &support.name))
    }

    fn place_in(
        &self,
        thing: &Thing,
        room: usize,
        place: &Place,
        random: &mut Random,
    ) -> Result<Spot, PlaceError> {
        let outline = &self.house.rooms[room].outline;
        let range = |axis: usize| {
            let values = outline.iter().map(|corner| corner[axis]);
            (values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max))
        };
        let ((x0, x1), (y0, y1)) = (range(0), range(1));
        let z = thing.size.metres()[2] / 2.0;
        let tries = if place.is_exact() { 1 } else { TRIES };
        self.first_free(thing, tries, random, &mut |random| {
            let drawn = [random.between(x0, x1), random.between(y0, y1)];
            let turn = turn(place, random);
            let [x, y] = place.at.unwrap_or(drawn);
            let pose = upright([x, y, z], turn)?;
            let [w, h, d] = half(thing);
            let around = Block::of(&pose, [-w, -h, -d], [w, h, d]);
            let inside = around.corners().iter().all(|corner| contains(outline, *corner));
            inside.then_some(Spot { pose, room, support: None })
        })
        .ok_or_else(|| no_room_left(thing, self.house.rooms[room].label.as_str()))
    }

    fn first_free(
        &self,
        thing: &Thing,
        tries: usize,
        random: &mut Random,
        draw: &mut dyn FnMut(&mut Random) -> Option<Spot>,
    ) -> Option<Spot> {
        let shape = parts(&thing.mesh);
        (0..tries).filter_map(|_| draw(random)).find(|spot| self.admits(thing, &shape, *spot))
    }

    /// Whether nothing is in the way of `thing` at `spot`.
    pub fn is_free(&self, thing: &Thing, spot: Spot) -> bool {
        self.admits(thing, &parts(&thing.mesh), spot)
    }

    fn admits(&self, thing: &Thing, shape: &[([f64; 3], [f64; 3])], spot: Spot) -> bool {
        let own = (0..self.len()).find(|n| self.thing(*n).name == thing.name);
        let wide = |(low, high): &([f64; 3], [f64; 3])| {
            let mut block = Block::of(&spot.pose, *low, *high);
            block.half = block.half.map(|half| half + MARGIN_M);
            block
        };
        let blocks: Vec<Block> = shape.iter().map(wide).collect();
        self.space.has_room_for(&blocks, own)
    }
}

fn no_room_left(thing: &Thing, on: &str) -> PlaceError {
    let why = "it is too small, or what stands there leaves no room";
    PlaceError::NoRoomLeft { thing: thing.name.clone(), on: on.to_owned(), why }
}

fn half(thing: &Thing) -> [f64; 3] {
    thing.size.metres().map(|side| side / 2.0)
}

fn turn(place: &Place, random: &mut Random) -> f64 {
    let drawn = random.between(-std::f64::consts::PI, std::f64::consts::PI);
    place.yaw_deg.map_or(drawn, f64::to_radians)
}

/// Centre and turn of `thing` on `surface` of `support`, drawn where they are not given; `None`
/// if it would jut out.
fn on_surface(
    thing: &Thing,
    support: &Thing,
    surface: &Surface,
    place: &Place,
    random: &mut Random,
) -> Option<([f64; 3], f64)> {
    let (hz, turn) = (half(thing)[2], turn(place, random));
    if surface.clearance_m.is_some_and(|free| free < 2.0 * hz) {
        return None;
    }
    let world_from_support = support.pose.isometry();
    let ([hx, hy, _], inner) = (half(thing), turn - yaw(&support.pose));
    let (sin, cos) = (libm::sin(inner).abs(), libm::cos(inner).abs());
    let reach = |axis: usize| [hx * cos + hy * sin, hx * sin + hy * cos][axis] + MARGIN_M;
    let range = |axis: usize| (surface.min[axis] + reach(axis), surface.max[axis] - reach(axis));
    let ((x0, x1), (y0, y1)) = (range(0), range(1));
    if x0 > x1 || y0 > y1 {
        return None;
    }
    let drawn = [random.between(x0, x1), random.between(y0, y1)];
    let [x, y] = match place.at {
        None => drawn,
        Some([x, y]) => {
            let at = world_from_support.inverse() * nalgebra::Point3::new(x, y, 0.0);
            // To within the grid of poses.
            let within =
                |value: f64, low: f64, high: f64| value > low - 1e-5 && value < high + 1e-5;
            (within(at.x, x0, x1) && within(at.y, y0, y1)).then_some([at.x, at.y])?
        }
    };
    let at = world_from_support * nalgebra::Point3::new(x, y, surface.z + hz);
    Some(([at.x, at.y, at.z], turn))
}

/// Whether two names share most of their letters.
fn similar(a: &str, b: &str) -> bool {
    similar::TextDiff::from_chars(a, b).ratio() > 0.7
}
