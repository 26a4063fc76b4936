//! What the robot does: errands first, otherwise its round of the rooms.

use std::collections::VecDeque;

use super::grid::{Cell, Grid};
use super::motion::{Body, Leg, wrapped};
use super::path::{distance, plan, reachable};
use super::views::viewpoints;
use crate::event::Status;
use crate::simulation::blocks::Block;
use crate::simulation::random::Random;
use crate::simulation::scenario::{Errand, RobotConfig};
use crate::simulation::shapes::polygon::contains;
use crate::simulation::world::{Presence, Spot, TrueWorld};

/// What the robot reports of a task, and what it did to the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Report {
    /// Number of the errand.
    pub errand: usize,
    /// How far it is.
    pub status: Status,
    /// The thing that was picked or placed.
    pub thing: Option<usize>,
}

/// Seconds that the hand needs.
const GRASP_S: f64 = 1.0;
/// Things lower than this are in the robot's way, metres.
const BODY_HEIGHT_M: f64 = 1.4;
/// It drives over what is lower than this, metres.
const STEP_M: f64 = 0.03;
/// Half the picture, and some to spare: what one look covers to either side, radians.
const LOOK_HALF: [f64; 2] = [0.5, 0.36];
/// A look takes this long, seconds: two pictures at 2 Hz, with the turn of the head.
const LOOK_S: f64 = 0.8;

/// The robot's mind.
#[derive(Clone, Debug)]
pub struct Mind {
    config: RobotConfig,
    errands: VecDeque<usize>,
    doing: Option<Fetch>,
    /// Rooms of the round that are still to be visited.
    left: VecDeque<usize>,
    rounds_left: u32,
    /// Viewpoints of the room it is in that are still to be taken.
    views: VecDeque<[f64; 2]>,
    /// The room they are in.
    room: usize,
    /// Where things that can be moved, and what they can be put on, stood when the robot learned
    /// the house, with their rooms: what it goes to look at.
    targets: Vec<(usize, [f64; 3])>,
    /// The floor, and what it was made for.
    floor: Option<(Vec<Block>, Grid)>,
}

/// An errand being run.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Fetch {
    errand: usize,
    stage: Stage,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Stage {
    Reaching(usize),
    Carrying(usize, Spot),
    Leaving(usize),
}

impl Mind {
    /// A mind that knows the house as it is now.
    pub fn new(config: RobotConfig, world: &TrueWorld) -> Self {
        let worth_a_look =
            |n: &usize| world.thing(*n).movable || !world.thing(*n).surfaces.is_empty();
        let targets = world
            .present()
            .filter(worth_a_look)
            .map(|n| (world.thing(n).room, world.thing(n).pose.position()))
            .collect();
        Self {
            rounds_left: config.rounds,
            config,
            errands: VecDeque::new(),
            doing: None,
            left: VecDeque::new(),
            views: VecDeque::new(),
            room: 0,
            targets,
            floor: None,
        }
    }

    /// Where it stands at the start: where there is most room in its room.
    pub fn start(&mut self, world: &TrueWorld) -> Option<[f64; 2]> {
        let room = self.config.room.as_ref().and_then(|room| world.room(room).ok()).unwrap_or(0);
        let outline = world.house().rooms[room].outline.clone();
        let grid = self.grid(world);
        let cell = grid
            .free_cells()
            .filter(|cell| contains(&outline, grid.point(*cell)))
            .max_by_key(|cell| (grid.clearance_mm(*cell), std::cmp::Reverse(*cell)))?;
        Some(grid.point(cell))
    }

    /// Somebody asked for something.
    pub fn ask(&mut self, errand: usize) {
        self.errands.push_back(errand);
    }

    /// Whether everything asked for is done.
    pub fn is_free(&self) -> bool {
        self.errands.is_empty() && self.doing.is_none()
    }

    /// Called when the body has nothing to do: acts on what it has come for, and sets out for
    /// what is next. `idle` tells that nothing more will happen: then rounds are counted.
    /// Returns what to report, and whether there is anything left to do.
    pub fn decide(
        &mut self,
        body: &mut Body,
        world: &mut TrueWorld,
        errands: &[Errand],
        random: &mut Random,
        idle: bool,
    ) -> (Vec<Report>, bool) {
        let mut reports = Vec::new();
        if let Some(fetch) = self.doing.take() {
            self.go_on(fetch, body, world, errands, random, &mut reports);
            return (reports, true);
        }
        if let Some(errand) = self.errands.pop_front() {
            self.set_out(errand, body, world, errands, &mut reports);
            return (reports, true);
        }
        (reports, self.look_around(body, world, idle))
    }

    fn set_out(
        &mut self,
        errand: usize,
        body: &mut Body,
        world: &TrueWorld,
        errands: &[Errand],
        reports: &mut Vec<Report>,
    ) {
        reports.push(Report { errand, status: Status::Started, thing: None });
        // What is left of the room's viewpoints is no longer near.
        self.views.clear();
        let thing = world.find(&errands[errand].pick).ok();
        let gone = thing.filter(|n| {
            let thing = world.thing(*n);
            self.approach(body, world, thing.pose.position(), thing.room)
        });
        match gone {
            Some(n) => self.doing = Some(Fetch { errand, stage: Stage::Reaching(n) }),
            None => reports.push(Report { errand, status: Status::Failed, thing: None }),
        }
    }

    fn go_on(
        &mut self,
        Fetch { errand, stage }: Fetch,
        body: &mut Body,
        world: &mut TrueWorld,
        errands: &[Errand],
        random: &mut Random,
        reports: &mut Vec<Report>,
    ) {
        let mut report = |status, thing| reports.push(Report { errand, status, thing });
        match stage {
            Stage::Reaching(n) if world.presence(n) != Presence::There => {
                report(Status::Failed, None);
            }
            Stage::Reaching(n) => {
                let spot = world.place(world.thing(n), &errands[errand].place, random);
                let Ok(spot) = spot else { return report(Status::Failed, None) };
                world.take(n, Presence::Held);
                report(Status::Picked, Some(n));
                if self.approach(body, world, spot.pose.position(), spot.room) {
                    let stage = Stage::Carrying(n, spot);
                    self.doing = Some(Fetch { errand, stage });
                } else {
                    report(Status::Failed, None);
                }
            }
            Stage::Carrying(n, spot) => {
                // Somebody may have put something there meanwhile.
                let free = world.is_free(world.thing(n), spot);
                let again = if free {
                    Ok(spot)
                } else {
                    world.place(world.thing(n), &errands[errand].place, random)
                };
                let Ok(spot) = again else { return report(Status::Failed, None) };
                world.put(n, spot);
                report(Status::Placed, Some(n));
                let (pan, tilt) = body.look_at(body.at, spot.pose.position());
                body.add(Leg::Look(pan, tilt, GRASP_S));
                self.doing = Some(Fetch { errand, stage: Stage::Leaving(n) });
            }
            Stage::Leaving(n) => report(Status::Done, Some(n)),
        }
    }

    /// Goes within reach of a point and looks at it; false if there is no way.
    fn approach(&mut self, body: &mut Body, world: &TrueWorld, at: [f64; 3], room: usize) -> bool {
        let (from, reach) = (body.at, self.config.body.reach_m);
        let outline = world.house().rooms[room].outline.clone();
        let grid = self.grid(world);
        let ways = reachable(grid, from);
        let target = [at[0], at[1]];
        let cost = |(cell, metres): (&Cell, &f64)| {
            let point = grid.point(*cell);
            let off = (distance(point, target) - 0.7).abs();
            (contains(&outline, point) && distance(point, target) <= reach)
                .then_some((*cell, metres + 3.0 * off))
        };
        let best = ways.iter().filter_map(cost).min_by(|a, b| a.1.total_cmp(&b.1));
        let way = best.and_then(|(cell, _)| plan(grid, from, grid.point(cell)));
        let Some(way) = way else { return false };
        body.follow(&way);
        let stand = way.last().copied().unwrap_or(from);
        body.add(Leg::Turn(libm::atan2(target[1] - stand[1], target[0] - stand[0])));
        let (pan, tilt) = body.look_at(stand, at);
        body.add(Leg::Look(pan, tilt, GRASP_S));
        true
    }

    /// Takes the next viewpoint; false once all rounds are over.
    fn look_around(&mut self, body: &mut Body, world: &TrueWorld, idle: bool) -> bool {
        let Some(point) = self.next_view(body.at, world, idle) else { return false };
        let Some(way) = plan(self.grid(world), body.at, point) else { return true };
        body.follow(&way);
        let heading = match way[..] {
            [.., a, b] => libm::atan2(b[1] - a[1], b[0] - a[0]),
            _ => body.yaw,
        };
        for look in self.looks(body, point, heading) {
            body.add(look);
        }
        true
    }

    fn next_view(&mut self, at: [f64; 2], world: &TrueWorld, idle: bool) -> Option<[f64; 2]> {
        let mut tried = 0;
        while self.views.is_empty() {
            if self.left.is_empty() {
                if idle && self.rounds_left == 0 || tried > world.house().rooms.len() {
                    return None;
                }
                self.rounds_left -= u32::from(idle);
                self.left = self.round(world);
            }
            tried += 1;
            let room = self.left.pop_front()?;
            self.room = room;
            let targets: Vec<[f64; 2]> = self
                .targets
                .iter()
                .filter(|(of, _)| *of == room)
                .map(|(_, at)| [at[0], at[1]])
                .collect();
            let grid = self.grid(world);
            let (ways, walls) = (reachable(grid, at), world.space().walls());
            self.views = viewpoints(world.house(), (grid, walls), &ways, room, &targets).into();
        }
        // The nearest first.
        let nearest = (0..self.views.len())
            .min_by(|a, b| distance(at, self.views[*a]).total_cmp(&distance(at, self.views[*b])))?;
        self.views.remove(nearest)
    }

    fn round(&self, world: &TrueWorld) -> VecDeque<usize> {
        if self.config.round.is_empty() {
            return (0..world.house().rooms.len()).collect();
        }
        self.config.round.iter().filter_map(|room| world.room(room).ok()).collect()
    }

    /// Looks that together show every target around `point`.
    fn looks(&self, body: &Body, point: [f64; 2], heading: f64) -> Vec<Leg> {
        let mut left: Vec<(f64, f64)> = self
            .targets
            .iter()
            .filter(|(of, _)| *of == self.room)
            .filter(|(_, at)| (0.3..3.5).contains(&distance(point, [at[0], at[1]])))
            .map(|(_, at)| {
                let bearing = libm::atan2(at[1] - point[1], at[0] - point[0]);
                (wrapped(bearing - heading), body.look_at(point, *at).1)
            })
            .collect();
        // From one side to the other.
        left.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        let mut looks = Vec::new();
        while let Some((pan, tilt)) = left.first().copied() {
            let (pan, tilt) = (pan + LOOK_HALF[0] * 0.9, tilt.clamp(0.0, 0.9));
            looks.push(Leg::Look(pan, tilt, LOOK_S));
            let seen = |(p, t): &(f64, f64)| {
                (p - pan).abs() <= LOOK_HALF[0] && (t - tilt).abs() <= LOOK_HALF[1]
            };
            let before = left.len();
            left.retain(|target| !seen(target));
            if left.len() == before {
                left.remove(0);
            }
        }
        looks
    }

    /// The floor as it is now.
    fn grid(&mut self, world: &TrueWorld) -> &Grid {
        let things = world.present().flat_map(|n| world.space().parts_of(n));
        let in_the_way = |block: &&Block| block.z[0] < BODY_HEIGHT_M && block.z[1] > STEP_M;
        let obstacles: Vec<Block> =
            world.space().walls().iter().chain(things).filter(in_the_way).copied().collect();
        let radius = self.config.body.radius_m;
        let floor = self.floor.take().filter(|(made_for, _)| *made_for == obstacles);
        let made = floor.unwrap_or_else(|| {
            let grid = Grid::new(world.house(), &obstacles, radius);
            (obstacles, grid)
        });
        &self.floor.insert(made).1
    }
}
