//! Who is meant: from an id or a label to one node of the log.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::ops::ControlFlow;

use super::{WhyError, is_decisive};
use crate::change::{NodeRef, Primitive, World};
use crate::event::Event;
use crate::graph::{Label, Layer, Node, NodeId, SceneGraph};
use crate::history::log::walk;
use crate::history::place::named;
use crate::history::log::advance_in;
use crate::history::{EventLog, Place};

/// Names a node.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Selector {
    /// By its id.
    Id(NodeId),
    /// By its label, as [`Label::same_class`] compares.
    Label(String),
}

/// Whether a node is there.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Presence {
    /// It is in the graph.
    Present,
    /// It is in the gripper.
    Held,
    /// It was there and is not any more.
    Absent,
}

impl Presence {
    /// The word for it in JSON.
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Present => "present",
            Self::Held => "held",
            Self::Absent => "absent",
        }
    }

    /// Whether `id` is there in `world`.
    pub fn of(world: &World, id: NodeId) -> Self {
        match world.graph().object(id) {
            Some(object) if object.is_held() => Self::Held,
            Some(_) => Self::Present,
            None if world.graph().contains(id) => Self::Present,
            None => Self::Absent,
        }
    }
}

/// A node that may be meant.
#[derive(Clone, Debug, PartialEq)]
pub struct Candidate {
    /// The node.
    pub node: NodeRef,
    /// Whether it is there.
    pub presence: Presence,
    /// Where it is, or was last; nothing for a region.
    pub place: Option<Place>,
}

/// `mug O3  kitchen, on table O1`.
impl fmt::Display for Candidate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.node)?;
        match (&self.place, self.presence) {
            (Some(place), Presence::Present) => write!(f, "  {place}"),
            (Some(place), Presence::Held) => {
                write!(f, "  in the gripper, picked in {}", place.spot())
            }
            (Some(place), Presence::Absent) => write!(f, "  absent, was in {}", place.spot()),
            (None, presence) => write!(f, "  {}", presence.as_str()),
        }
    }
}

/// Who is meant, and the namesakes that never changed.
///
/// A label means the only node of that label, or the only one of several that was ever added,
/// moved or removed.
pub(super) fn select<L: EventLog>(
    log: &L,
    upto: u64,
    who: &Selector,
) -> Result<(NodeId, Vec<NodeRef>), WhyError<L::Error>> {
    let label = match who {
        Selector::Id(id) => return Ok((*id, vec![])),
        Selector::Label(label) => label,
    };
    let mut census = Census { label, nodes: BTreeMap::new(), labels: BTreeSet::new() };
    let world = walk(log, upto, WhyError::Log, |world, logged| {
        advance_in(log, world, logged)?;
        match &logged.event {
            Event::InitialGraph(graph) => census.count_graph(graph),
            Event::Transaction(transaction) => {
                transaction.steps.iter().for_each(|step| census.count(&step.primitive));
            }
            _ => {}
        }
        Ok::<_, WhyError<L::Error>>(ControlFlow::Continue(()))
    })?;
    census.choose(&world)
}

/// Who answers to a label, and which labels there are.
struct Census<'a> {
    label: &'a str,
    /// By id: the label, and whether the node was ever touched.
    nodes: BTreeMap<NodeId, (Label, bool)>,
    labels: BTreeSet<Label>,
}

impl Census<'_> {
    fn count_graph(&mut self, graph: &SceneGraph) {
        graph.all_objects().for_each(|(id, object)| self.meet(id, &object.label));
        for layer in [Layer::Room, Layer::Floor, Layer::Building] {
            graph.regions(layer).for_each(|(id, region)| self.meet(id, &region.label));
        }
    }

    fn meet(&mut self, id: NodeId, label: &Label) {
        if label.same_class(self.label) {
            self.nodes.entry(id).or_insert_with(|| (label.clone(), false));
        }
        if !self.labels.contains(label) {
            self.labels.insert(label.clone());
        }
    }

    fn count(&mut self, primitive: &Primitive) {
        match primitive {
            Primitive::Add { id, node: Node::Object(object) } => self.meet(*id, &object.label),
            Primitive::Add { id, node: Node::Region(region, _) } => self.meet(*id, &region.label),
            _ => {}
        }
        if !is_decisive(primitive) {
            return;
        }
        for id in primitive.nodes() {
            if let Some((_, touched)) = self.nodes.get_mut(&id) {
                *touched = true;
            }
        }
    }

    fn choose<E>(self, world: &World) -> Result<(NodeId, Vec<NodeRef>), WhyError<E>> {
        let touched: Vec<NodeId> =
            self.nodes.iter().filter(|(_, (_, touched))| *touched).map(|(id, _)| *id).collect();
        let all: Vec<NodeId> = self.nodes.keys().copied().collect();
        let chosen = match (all.as_slice(), touched.as_slice()) {
            ([], _) => {
                let wanted = format!("{:?}", self.label);
                return Err(WhyError::Unknown { wanted, similar: self.similar() });
            }
            ([only], _) | (_, [only]) => *only,
            (all, []) => return Err(self.ambiguous(world, all)),
            (_, several) => return Err(self.ambiguous(world, several)),
        };
        let node = |(id, (label, _)): (&NodeId, &(Label, bool))| {
            (*id != chosen).then(|| NodeRef { id: Some(*id), label: Some(label.clone()) })
        };
        Ok((chosen, self.nodes.iter().filter_map(node).collect()))
    }

    fn ambiguous<E>(&self, world: &World, ids: &[NodeId]) -> WhyError<E> {
        let candidate = |id: &NodeId| Candidate {
            node: NodeRef { id: Some(*id), label: Some(self.nodes[id].0.clone()) },
            presence: Presence::of(world, *id),
            place: place(world, *id),
        };
        let candidates = ids.iter().map(candidate).collect();
        WhyError::Ambiguous { wanted: format!("{:?}", self.label), candidates }
    }

    /// Labels spelled similarly, or of which the wanted one is a part; the most similar first.
    fn similar(&self) -> Vec<String> {
        let labels: Vec<&str> = self.labels.iter().map(Label::as_str).collect();
        let wanted = self.label.to_lowercase();
        let close = similar::get_close_matches(wanted.as_str(), &labels, 3, 0.6);
        let part = |label: &&&str| wanted.len() > 2 && label.to_lowercase().contains(&wanted);
        let parts = labels.iter().filter(part).copied();
        let mut found: Vec<String> = Vec::new();
        for label in close.into_iter().chain(parts) {
            if found.len() < 3 && !found.iter().any(|known| known.as_str() == label) {
                found.push(label.to_owned());
            }
        }
        found
    }
}

/// Where `id` is, or was last.
pub(super) fn place(world: &World, id: NodeId) -> Option<Place> {
    world.known(id).map(|object| Place::of(world.graph(), object))
}

/// The node with the label it is known by, or was.
pub(super) fn node_ref(world: &World, id: NodeId) -> NodeRef {
    let known =
        world.known(id).map(|object| NodeRef { id: Some(id), label: Some(object.label.clone()) });
    known.unwrap_or_else(|| named(world.graph(), id))
}
