//! The arrangement every day starts from: where each handled thing is then.

use std::collections::{BTreeMap, BTreeSet};

use super::places::Places;
use super::rows::Row;
use super::{ActionsError, Options, csv_rows};
use crate::change::topological_pose;
use crate::geometry::Size;
use crate::graph::{Label, Layer, NodeId, Object, Placement, PoseSource};
use crate::interchange::{ImportReport, MOVABLE_DECAY_RATE, counted};

/// Side of the cube that stands for a thing one can carry.
const THING_SIDE_UM: i64 = 100_000;

/// Where a thing is when a day starts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Home {
    pub room: NodeId,
    pub support: Option<NodeId>,
}

/// Class of each thing, and of the place where it is.
pub(super) type Initial = BTreeMap<NodeId, (Label, Label)>;

/// The handled things in an order in which supports come before what rests on them.
pub(super) type Homes = Vec<(NodeId, Home)>;

/// Puts every handled thing into the graph, where the days start.
pub(super) fn find(
    places: &mut Places,
    options: &Options<'_>,
    rows: &[Row],
    initial: &Initial,
    report: &mut ImportReport,
) -> Result<Homes, ActionsError> {
    let usage = Usage::of(rows);
    let mut things: BTreeMap<NodeId, &Label> = BTreeMap::new();
    for row in rows {
        let first = *things.entry(row.object).or_insert(&row.label);
        if *first != row.label {
            report.count("rows that name a thing otherwise than the first row did", 1);
        }
    }
    things.extend(initial.iter().map(|(id, (label, _))| (*id, label)));
    let mut wanted = BTreeMap::new();
    let (mut first_put, mut nowhere) = (Vec::new(), Vec::new());
    for id in things.keys() {
        let place = match (initial.get(id), usage.first_put.get(id)) {
            (Some((_, class)), _) => Some(usage.place(places, *id, class, report)?),
            (None, _) if places.graph.contains(*id) => None,
            (None, Some(number)) => {
                first_put.push(*id);
                places.destinations.get(number).copied()
            }
            (None, None) => {
                nowhere.push(*id);
                None
            }
        };
        wanted.insert(*id, place.filter(|place| place != id));
    }
    if !first_put.is_empty() && options.initial_csv.is_some() {
        report.note(counted(&first_put, "things begin where they are first put"));
    }
    if !nowhere.is_empty() {
        report.note(counted(&nowhere, "things are never said to be anywhere: room unknown"));
    }
    settle(places, &things, &wanted, options, report)
}

fn settle(
    places: &mut Places,
    things: &BTreeMap<NodeId, &Label>,
    wanted: &BTreeMap<NodeId, Option<NodeId>>,
    options: &Options<'_>,
    report: &mut ImportReport,
) -> Result<Homes, ActionsError> {
    let mut homes: Homes = Vec::new();
    let mut settled = BTreeSet::new();
    for id in things.keys() {
        let mut chain = vec![*id];
        // Down to something that is there: furniture, a room, or a thing that is settled.
        while let Some(Some(below)) = wanted.get(chain.last().expect("it begins with one")) {
            let is_thing = wanted.contains_key(below) && !settled.contains(below);
            if !is_thing || chain.contains(below) {
                break;
            }
            chain.push(*below);
        }
        for id in chain.into_iter().rev().filter(|id| settled.insert(*id)).collect::<Vec<_>>() {
            let mut place = wanted.get(&id).copied().flatten();
            if place.is_some_and(|place| !places.graph.contains(place)) {
                report.note(format!(
                    "{id} begins in a room known only by name: its place rests on it"
                ));
                place = None;
            }
            homes.push((id, insert(places, id, things[&id], place, options)?));
        }
    }
    Ok(homes)
}

fn insert(
    places: &mut Places,
    id: NodeId,
    label: &Label,
    place: Option<NodeId>,
    options: &Options<'_>,
) -> Result<Home, ActionsError> {
    let known = places.graph.object(id).cloned();
    let support = place.filter(|place| place.layer() == Layer::Object);
    let room = match (place, support.and_then(|on| places.graph.object(on)), &known) {
        (_, Some(below), _) => below.room,
        (Some(room), None, _) => room,
        (None, None, Some(object)) => {
            return Ok(Home { room: object.room, support: object.support });
        }
        (None, None, None) => places.unknown_room()?,
    };
    let size = match &known {
        Some(object) => object.size,
        None => Size::from_micrometres([THING_SIDE_UM; 3]).expect("the side is positive"),
    };
    let pose = topological_pose(&places.graph, room, support, size);
    let pose_source = PoseSource::Topological;
    let at = options.start;
    if let Some(object) = known {
        let there = Placement { room, support, pose, pose_source, at };
        if places.graph.place_object(id, &there).is_err() {
            // It carries its own place: then it stays where the graph has it.
            return Ok(Home { room: object.room, support: object.support });
        }
    } else {
        let (label, decay_rate) = (label.clone(), MOVABLE_DECAY_RATE);
        let object =
            Object { label, pose, size, decay_rate, last_observed: at, pose_source, room, support };
        places.graph.insert_object(id, object)?;
    }
    Ok(Home { room, support })
}

/// Reads the CSV of the arrangement.
pub(super) fn read(text: &str) -> Result<Initial, ActionsError> {
    let rows = csv_rows::read("initial", text, &["object", "object_id", "place"], |line| {
        let id = NodeId::new(Layer::Object, line.id(1)?).expect("the index was checked");
        Ok((id, (line.label(0)?, line.label(2)?)))
    })?;
    Ok(rows.into_iter().collect())
}

/// How often the log puts what where.
#[derive(Debug, Default)]
struct Usage {
    /// By class of the destination, then by its number.
    overall: BTreeMap<Label, BTreeMap<u32, u64>>,
    /// By thing and number of the destination.
    own: BTreeMap<(NodeId, u32), u64>,
    first_put: BTreeMap<NodeId, u32>,
}

impl Usage {
    fn of(rows: &[Row]) -> Self {
        let mut usage = Self::default();
        for row in rows {
            let Some((number, class)) = &row.destination else { continue };
            usage.first_put.entry(row.object).or_insert(*number);
            *usage.own.entry((row.object, *number)).or_default() += 1;
            if !usage.overall.contains_key(class) {
                usage.overall.insert(class.clone(), BTreeMap::new());
            }
            let numbers = usage.overall.get_mut(class).expect("it was just seen to be there");
            *numbers.entry(*number).or_default() += 1;
        }
        usage
    }

    /// The place of `class` that is meant: that where the thing itself is put most often, then
    /// that where most is put, then the smallest number.
    fn place(
        &self,
        places: &mut Places,
        id: NodeId,
        class: &Label,
        report: &mut ImportReport,
    ) -> Result<NodeId, ActionsError> {
        let Some(numbers) = self.overall.get(class) else { return places.place_of_class(class) };
        let own = |number: &u32| self.own.get(&(id, *number)).copied().unwrap_or(0);
        let best = numbers
            .iter()
            .max_by_key(|(number, n)| (own(number), **n, std::cmp::Reverse(**number)))
            .map(|(number, _)| *number)
            .expect("a class is only there with a number");
        if numbers.len() > 1 {
            report.note(format!(
                "{id} begins at {class} {best}, of {} places of that name: it is put there most",
                numbers.len()
            ));
        }
        Ok(places.destinations[&best])
    }
}
