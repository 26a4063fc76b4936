//! λ by class: where a table is configured, nodes get their λ from it, with the reason.

use crate::change::{Cause, Primitive};
use crate::graph::{Node, NodeId};
use crate::modality::Desk;
use crate::modality::time::DecayTable;

/// Sets λ of every object of the initial graph, event `order`, that the table says something of:
/// also where it is what the graph says already, so that the log tells where it comes from.
pub(super) fn settle(desk: &mut Desk<'_>, table: &DecayTable, order: u64) {
    let cause = crate::change::EvidenceRef { topic: "/graph/initial".into(), order };
    let objects = desk.world().graph().all_objects();
    let said: Vec<(NodeId, f64, String)> = objects
        .filter_map(|(id, object)| {
            let (decay, origin) = table.for_object(&object.label, object.decay_rate)?;
            Some((id, decay.rate_per_s, table.explain(decay, &origin)))
        })
        .collect();
    for (id, rate, why) in said {
        desk.set_decay(Cause::Evidence(cause.clone()), id, rate, why);
    }
}

/// Sets λ of the objects that this update added, where the table says another one.
pub(super) fn settle_added(desk: &mut Desk<'_>, table: &DecayTable) {
    let added = desk.steps().iter().filter_map(|step| match &step.primitive {
        Primitive::Add { id, node: Node::Object(object) } => Some((step, *id, object)),
        _ => None,
    });
    let said: Vec<_> = added
        .filter_map(|(step, id, object)| {
            let (decay, origin) = table.for_object(&object.label, object.decay_rate)?;
            let differs = decay.rate_per_s.to_bits() != object.decay_rate.to_bits();
            let why = || table.explain(decay, &origin);
            differs.then(|| (step.cause.clone(), id, decay.rate_per_s, why()))
        })
        .collect();
    for (cause, id, rate, why) in said {
        desk.set_decay(cause, id, rate, why);
    }
}
