//! [`Places`]: the base graph, and what a destination is in it; creates what it lacks.

use std::collections::{BTreeMap, BTreeSet};

use super::rows::Row;
use super::{ActionsError, Options, csv_rows};
use crate::change::topological_pose;
use crate::geometry::Size;
use crate::graph::{Label, Layer, NodeId, Object, PoseSource, Region, SceneGraph};
use crate::interchange::{IMMOVABLE_DECAY_RATE, ImportReport, counted};
use crate::time::Stamp;

/// Side of the cube that stands for furniture of which only the name is known.
const FURNITURE_SIDE_UM: i64 = 500_000;
/// Rooms that nobody named.
const UNKNOWN_ROOM: &str = "unknown";

/// The base graph with all places in it.
#[derive(Debug)]
pub(super) struct Places {
    pub graph: SceneGraph,
    /// What each destination number is: an object or a room.
    pub destinations: BTreeMap<u32, NodeId>,
    /// The places CSV: class, and room if it has one.
    listed: BTreeMap<u32, (Label, Option<Label>)>,
    /// Numbers that nothing new may take.
    taken: BTreeSet<u32>,
    start: Stamp,
    from_list: Vec<NodeId>,
    made_up: Vec<NodeId>,
    renamed: Vec<String>,
}

impl Places {
    /// The base graph with the destinations of `rows`, except those that are handled themselves.
    /// `things` are the numbers of what is handled or listed as such.
    pub fn new(
        options: &Options<'_>,
        rows: &[Row],
        things: &BTreeSet<u32>,
    ) -> Result<Self, ActionsError> {
        let listed = options.places_csv.map(read_list).transpose()?.unwrap_or_default();
        let named: BTreeMap<u32, &Label> = rows
            .iter()
            .rev()
            .filter_map(|row| row.destination.as_ref())
            .map(|(n, l)| (*n, l))
            .collect();
        let mut places = Self {
            graph: options.graph.clone().unwrap_or_default(),
            destinations: BTreeMap::new(),
            taken: things.iter().chain(named.keys()).chain(listed.keys()).copied().collect(),
            listed,
            start: options.start,
            from_list: Vec::new(),
            made_up: Vec::new(),
            renamed: Vec::new(),
        };
        for (number, class) in named {
            let id = if things.contains(&number) {
                node_id(Layer::Object, number, class)?
            } else {
                places.place(number, class)?
            };
            places.destinations.insert(number, id);
        }
        Ok(places)
    }

    /// The node of the place with this number.
    pub fn place(&mut self, number: u32, class: &Label) -> Result<NodeId, ActionsError> {
        let object = node_id(Layer::Object, number, class)?;
        let room = node_id(Layer::Room, number, class)?;
        if let Some(known) = [object, room].into_iter().find(|id| self.graph.contains(*id)) {
            let label = self.graph.label(known).filter(|label| !label.same_class(class.as_str()));
            if let Some(label) = label {
                self.renamed.push(format!("{class} {number} is {label} {known}"));
            }
            return Ok(known);
        }
        match self.listed.get(&number).cloned() {
            Some((class, None)) => {
                self.graph.insert_region(room, named_only(class))?;
                self.from_list.push(room);
                Ok(room)
            }
            Some((class, Some(room))) => {
                self.from_list.push(object);
                let room = self.room_named(room.as_str())?;
                self.furnish(object, class, room)
            }
            None => self.make_up(object, class),
        }
    }

    /// A place of which only the class is known: in the list, in the graph, or a new one.
    pub fn place_of_class(&mut self, class: &Label) -> Result<NodeId, ActionsError> {
        let listed = self.listed.iter().find(|(_, (label, _))| label.same_class(class.as_str()));
        if let Some((number, _)) = listed {
            return self.place(*number, class);
        }
        let same = |label: &Label| label.same_class(class.as_str());
        let object = self.graph.all_objects().find(|(_, object)| same(&object.label));
        let room = self.graph.rooms().find(|(_, room)| same(&room.label));
        if let Some(id) = object.map(|(id, _)| id).or(room.map(|(id, _)| id)) {
            return Ok(id);
        }
        let last =
            self.graph.last_index(Layer::Object).into_iter().chain(self.taken.last().copied());
        let number = last.max().map_or(0, |last| last + 1);
        self.make_up(node_id(Layer::Object, number, class)?, class)
    }

    fn make_up(&mut self, id: NodeId, class: &Label) -> Result<NodeId, ActionsError> {
        self.made_up.push(id);
        let room = self.unknown_room()?;
        self.furnish(id, class.clone(), room)
    }

    /// The room where things are of which no room is known.
    pub fn unknown_room(&mut self) -> Result<NodeId, ActionsError> {
        self.room_named(UNKNOWN_ROOM)
    }

    /// The room with this name; a new one without extent if there is none.
    fn room_named(&mut self, name: &str) -> Result<NodeId, ActionsError> {
        let known = self.graph.rooms().find(|(_, room)| room.label.same_class(name));
        if let Some((id, _)) = known {
            return Ok(id);
        }
        let label = Label::new(name).expect("it was a label, or is one of ours");
        let after = self.graph.last_index(Layer::Room).map_or(0, |last| last + 1);
        // Not a number that a destination has: that would be taken for this room.
        let number =
            (after..=u32::MAX).find(|number| !self.taken.contains(number)).unwrap_or(u32::MAX);
        let id = node_id(Layer::Room, number, &label)?;
        self.graph.insert_region(id, named_only(label))?;
        Ok(id)
    }

    fn furnish(&mut self, id: NodeId, label: Label, room: NodeId) -> Result<NodeId, ActionsError> {
        let size = Size::from_micrometres([FURNITURE_SIDE_UM; 3]).expect("the side is positive");
        let object = Object {
            label,
            pose: topological_pose(&self.graph, room, None, size),
            size,
            decay_rate: IMMOVABLE_DECAY_RATE,
            last_observed: self.start,
            pose_source: PoseSource::Topological,
            room,
            support: None,
        };
        self.graph.insert_object(id, object)?;
        Ok(id)
    }

    /// Says what was created, and what goes by another name.
    pub fn tell(&self, report: &mut ImportReport) {
        report.count("places created from the list", self.from_list.len() as u64);
        report.count("places created in a room known only by name", self.made_up.len() as u64);
        if !self.made_up.is_empty() {
            let named = |id: &NodeId| self.graph.label(*id).map(|label| format!("{label} {id}"));
            let words: Vec<String> = self.made_up.iter().take(12).filter_map(named).collect();
            let note = counted(&self.made_up, "places are in no graph and no list of places");
            report.note(format!("{note} ({})", words.join(", ")));
        }
        if !self.renamed.is_empty() {
            report.note(format!("goes by another name in the graph: {}", self.renamed.join("; ")));
        }
    }
}

fn read_list(text: &str) -> Result<BTreeMap<u32, (Label, Option<Label>)>, ActionsError> {
    let rows = csv_rows::read("places", text, &["id", "class", "room"], |line| {
        let room = if line.text(2).is_empty() { None } else { Some(line.label(2)?) };
        Ok((line.id(0)?, (line.label(1)?, room)))
    })?;
    Ok(rows.into_iter().collect())
}

fn named_only(label: Label) -> Region {
    Region { label, extent: None, parent: None }
}

pub(super) fn node_id(layer: Layer, number: u32, what: &Label) -> Result<NodeId, ActionsError> {
    NodeId::new(layer, number).ok_or_else(|| ActionsError::NoIdLeft { what: what.to_string() })
}
