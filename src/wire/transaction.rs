//! `Transaction`: what the fold eats. Written here, read in `read`.

mod read;

pub use read::{MAX_TRANSACTION_ITEMS, decode_edits, decode_transaction};

use super::common::{evidence, index, node, object, other_time, pose, pose_source, region, size};
use super::proto;
use crate::change::{Cause, Departure, Primitive, Sighting, Transaction};
use crate::graph::{Layer, Node, NodeId, Placement};
use crate::time::Stamp;
use proto::step::{Cause as WireCause, Primitive as WirePrimitive};

pub(super) fn transaction(transaction: &Transaction) -> proto::Transaction {
    let mut last = None;
    let steps = transaction.steps.iter().map(|step| {
        let cause = (last.replace(&step.cause) != Some(&step.cause)).then(|| cause(&step.cause));
        proto::Step { cause, primitive: Some(primitive(&step.primitive, transaction.at)) }
    });
    proto::Transaction { steps: steps.collect() }
}

fn cause(cause: &Cause) -> WireCause {
    match cause {
        Cause::Change(seq) => WireCause::Change(*seq),
        Cause::Evidence(reference) => WireCause::Evidence(evidence(reference)),
    }
}

fn primitive(primitive: &Primitive, at: Stamp) -> WirePrimitive {
    match primitive {
        Primitive::Find { query, room, support, candidates, chosen, reason } => {
            WirePrimitive::Find(proto::Find {
                query: query.clone(),
                room: room.map(|id| index(id, Layer::Room)),
                support: support.map(|id| index(id, Layer::Object)),
                candidate_nodes: candidates.iter().copied().map(node).collect(),
                chosen_node: chosen.map(node),
                reason: reason.clone(),
            })
        }
        Primitive::Add { id, node: what } => WirePrimitive::Add(add(*id, what, at)),
        Primitive::Remove { id, to, at: since } => WirePrimitive::Remove(proto::Remove {
            node: node(*id),
            to: departure(*to).into(),
            at_nanos: other_time(*since, Some(at)),
        }),
        Primitive::Move { id, to } => WirePrimitive::Move(move_(*id, to, at)),
        Primitive::Observe { at: seen_at, seen } => WirePrimitive::Observe(proto::Observe {
            seen: seen.iter().map(sighting).collect(),
            at_nanos: other_time(*seen_at, Some(at)),
        }),
        Primitive::SetDecay { id, decay_rate, origin } => {
            WirePrimitive::SetDecay(proto::SetDecay {
                object: index(*id, Layer::Object),
                decay_rate_per_s: *decay_rate,
                origin: origin.clone(),
            })
        }
    }
}

fn add(id: NodeId, what: &Node, at: Stamp) -> proto::Add {
    let (what, access) = match what {
        Node::Object(it) => (proto::add::What::Object(object(it, Some(at))), &[][..]),
        Node::Region(it, access) => (proto::add::What::Region(region(it)), &access[..]),
    };
    let access_rooms = access.iter().map(|room| index(*room, Layer::Room)).collect();
    proto::Add { node: node(id), what: Some(what), access_rooms }
}

fn departure(to: Departure) -> proto::Departure {
    match to {
        Departure::Gone => proto::Departure::Gone,
        Departure::Held => proto::Departure::Held,
    }
}

fn move_(id: NodeId, to: &Placement, at: Stamp) -> proto::Move {
    proto::Move {
        object: index(id, Layer::Object),
        room: index(to.room, Layer::Room),
        support: to.support.map(|id| index(id, Layer::Object)),
        pose: Some(pose(&to.pose)),
        pose_source: pose_source(to.pose_source),
        at_nanos: other_time(to.at, Some(at)),
    }
}

fn sighting(sighting: &Sighting) -> proto::Sighting {
    proto::Sighting {
        object: index(sighting.id, Layer::Object),
        pose: sighting.pose.as_ref().map(pose),
        size: sighting.size.map(size),
    }
}
