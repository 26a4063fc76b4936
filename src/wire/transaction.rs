//! `Transaction`: what the fold eats. Written here, read in `read`.

mod read;

pub use read::{MAX_TRANSACTION_ITEMS, decode_edits, decode_transaction};

#[cfg(test)]
use super::common::evidence;
use super::common::{
    index, node, object, other_time, pose, pose_source, put_evidence, put_pose, region, size,
};
use super::proto;
use super::put::Put;
use crate::change::{Cause, Departure, Primitive, Sighting, Transaction};
use crate::graph::{Layer, Node, NodeId, Placement};
use crate::time::Stamp;
#[cfg(test)]
use proto::step::Cause as WireCause;
use proto::step::Primitive as WirePrimitive;

/// The generated struct of a transaction: what [`put_transaction`] must write the bytes of.
#[cfg(test)]
pub(super) fn transaction(transaction: &Transaction) -> proto::Transaction {
    let mut last = None;
    let steps = transaction.steps.iter().map(|step| {
        let cause = (last.replace(&step.cause) != Some(&step.cause)).then(|| cause(&step.cause));
        proto::Step { cause, primitive: Some(primitive(&step.primitive, transaction.at)) }
    });
    proto::Transaction { steps: steps.collect() }
}

#[cfg(test)]
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

/// Appends the payload of a transaction. The edits that are nearly all there are, are written as
/// they are; the others through their generated structs.
pub(super) fn put_transaction(transaction: &Transaction, out: &mut Vec<u8>) {
    let mut last = None;
    for step in &transaction.steps {
        Put(out).message(1, |put| {
            if last.replace(&step.cause) != Some(&step.cause) {
                put_cause(put, &step.cause);
            }
            put_primitive(put, &step.primitive, transaction.at);
        });
    }
}

fn put_cause(put: &mut Put<'_>, cause: &Cause) {
    match cause {
        Cause::Change(seq) => put.present_u64(1, *seq),
        Cause::Evidence(reference) => put.message(2, |put| put_evidence(put, reference)),
    }
}

fn put_primitive(put: &mut Put<'_>, primitive: &Primitive, at: Stamp) {
    match primitive {
        Primitive::Find { query, room, support, candidates, chosen, reason } => {
            put.message(3, |put| {
                put.text(1, query);
                put.optional_u32(2, room.map(|id| index(id, Layer::Room)));
                put.optional_u32(3, support.map(|id| index(id, Layer::Object)));
                put.packed(4, candidates.iter().copied().map(node));
                put.optional_u32(5, chosen.map(node));
                put.text(6, reason);
            });
        }
        Primitive::Remove { id, to, at: since } => put.message(5, |put| {
            put.u64(1, node(*id).into());
            put.u64(2, departure(*to) as u64);
            put.optional_fixed64(3, other_time(*since, Some(at)));
        }),
        Primitive::Move { id, to } => put.message(6, |put| {
            put.u64(1, index(*id, Layer::Object).into());
            put.u64(2, index(to.room, Layer::Room).into());
            put.optional_u32(3, to.support.map(|id| index(id, Layer::Object)));
            put.message(4, |put| put_pose(put, &to.pose));
            put.u64(5, pose_source(to.pose_source) as u64);
            put.optional_fixed64(6, other_time(to.at, Some(at)));
        }),
        other => self::primitive(other, at).encode(put.0),
    }
}
