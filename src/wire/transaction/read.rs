//! Reading transactions. Replay reads millions of them, straight into the domain.

use crate::change::{Cause, Departure, Edit, Primitive, Sighting, Step, Transaction};
use crate::graph::{Label, Layer, Node, Placement};
use crate::time::Stamp;
use crate::wire::WireError;
use crate::wire::common::{
    first, index_of, node_of, read_decay_rate, read_evidence, read_index, read_label, read_node,
    read_object, read_pose, read_pose_source, read_region, read_size, read_stamp,
};
use crate::wire::fields::{Field, Fields, required};
use crate::wire::labels::Labels;

/// Most steps, sightings, candidates and accesses that one transaction may hold together: an
/// empty entry is two bytes on the wire but a hundred times that in memory.
pub const MAX_TRANSACTION_ITEMS: usize = 1 << 17;

/// Counts entries, so that a hostile payload costs bounded memory.
struct Budget(usize);

impl Budget {
    #[inline]
    fn take(&mut self, field: &'static str) -> Result<(), WireError> {
        let limit = MAX_TRANSACTION_ITEMS;
        let too_much = || WireError::TooMuch { message: "Transaction", field, limit };
        self.0 = self.0.checked_sub(1).ok_or_else(too_much)?;
        Ok(())
    }
}

/// Reads the payload of `/primitive`; `at` is its log time.
pub fn decode_transaction(at: Stamp, payload: &[u8]) -> Result<Transaction, WireError> {
    let mut fields = Fields::new("Transaction", payload);
    let mut budget = Budget(MAX_TRANSACTION_ITEMS);
    let mut steps: Vec<Step> = Vec::new();
    while let Some(field) = fields.next()? {
        if field.number == 1 {
            budget.take("steps")?;
            let before = steps.last().map(|step| &step.cause);
            let step = read_step(field.message("Step")?, before, at, &mut budget)?;
            steps.push(step);
        }
    }
    Ok(Transaction { at, steps })
}

/// Appends what a payload of `/primitive` does to a graph to `edits`, and leaves out what only
/// explains it. Takes and refuses what [`decode_transaction`] does; after a refusal `edits` is as
/// it was.
pub fn decode_edits(
    at: Stamp,
    payload: &[u8],
    labels: &mut Labels,
    edits: &mut Vec<Edit>,
) -> Result<(), WireError> {
    let before = edits.len();
    let read = append_edits(at, payload, labels, edits);
    if read.is_err() {
        edits.truncate(before);
    }
    read
}

fn append_edits(
    at: Stamp,
    payload: &[u8],
    labels: &mut Labels,
    edits: &mut Vec<Edit>,
) -> Result<(), WireError> {
    let mut fields = Fields::new("Transaction", payload);
    let mut budget = Budget(MAX_TRANSACTION_ITEMS);
    let mut step = 0;
    while let Some(field) = fields.next()? {
        if field.number == 1 {
            budget.take("steps")?;
            let read = read_edit(field.message("Step")?, step > 0, at, &mut budget, labels)?;
            edits.extend(read.map(|primitive| Edit { step, primitive }));
            step += 1;
        }
    }
    Ok(())
}

#[inline]
fn read_step(
    mut fields: Fields<'_>,
    before: Option<&Cause>,
    at: Stamp,
    budget: &mut Budget,
) -> Result<Step, WireError> {
    let (mut cause, mut primitive) = (None, None);
    let mut label = |field: &Field<'_>| read_label(field, "Object");
    while let Some(field) = fields.next()? {
        match field.number {
            1 => field.once(&mut cause, Cause::Change(field.u64()?))?,
            2 => field.once(&mut cause, Cause::Evidence(read_evidence(&field)?))?,
            3 => field.once(&mut primitive, read_find(field.message("Find")?, budget)?)?,
            _ => {
                if let Some(read) = read_primitive(&field, at, budget, &mut label)? {
                    field.once(&mut primitive, read)?;
                }
            }
        }
    }
    Ok(Step {
        cause: required(cause.or_else(|| before.cloned()), "Step", "cause")?,
        primitive: required(primitive, "Step", "primitive")?,
    })
}

/// What a step changes; `None` if it only explains. `caused` if a step before it has a cause.
#[inline]
fn read_edit(
    mut fields: Fields<'_>,
    caused: bool,
    at: Stamp,
    budget: &mut Budget,
    labels: &mut Labels,
) -> Result<Option<Primitive>, WireError> {
    let (mut cause, mut primitive) = (None, None);
    let mut label = |field: &Field<'_>| labels.read(field, "Object");
    while let Some(field) = fields.next()? {
        match field.number {
            1 => field.once(&mut cause, field.u64().map(drop)?)?,
            2 => field.once(&mut cause, read_evidence(&field).map(drop)?)?,
            3 => field.once(&mut primitive, check_find(field.message("Find")?, budget)?)?,
            _ => {
                if let Some(read) = read_primitive(&field, at, budget, &mut label)? {
                    field.once(&mut primitive, Some(read))?;
                }
            }
        }
    }
    required(cause.or(caused.then_some(())), "Step", "cause")?;
    required(primitive, "Step", "primitive")
}

/// The primitive other than `Find` that a field of `Step` holds, if it holds one.
#[inline]
fn read_primitive(
    field: &Field<'_>,
    at: Stamp,
    budget: &mut Budget,
    label: &mut dyn FnMut(&Field<'_>) -> Result<Label, WireError>,
) -> Result<Option<Primitive>, WireError> {
    Ok(Some(match field.number {
        4 => read_add(field.message("Add")?, at, budget, label)?,
        5 => read_remove(field.message("Remove")?, at)?,
        6 => read_move(field.message("Move")?, at)?,
        7 => read_observe(field.message("Observe")?, at, budget)?,
        8 => read_set_decay(field.message("SetDecay")?)?,
        _ => return Ok(None),
    }))
}

/// Reads a `Find` without keeping it, unless its choice is none of its candidates: then it is for
/// the graph to refuse it.
fn check_find(fields: Fields<'_>, budget: &mut Budget) -> Result<Option<Primitive>, WireError> {
    let mut chosen = None;
    let mut ahead = fields.clone();
    while let Some(field) = ahead.next()? {
        if field.number == 5 {
            chosen = Some(read_node(&field, "chosen_node")?);
        }
    }
    let mut among = chosen.is_none();
    let mut rest = fields.clone();
    while let Some(field) = rest.next()? {
        match field.number {
            1 => field.derived_text("query").map(drop)?,
            2 => read_index(&field, "room", Layer::Room).map(drop)?,
            3 => read_index(&field, "support", Layer::Object).map(drop)?,
            4 => field.numbers(|number| {
                budget.take("candidate_nodes")?;
                among |= Some(node_of(&field, "candidate_nodes", number)?) == chosen;
                Ok(())
            })?,
            6 => field.derived_text("reason").map(drop)?,
            _ => {}
        }
    }
    if among { Ok(None) } else { read_find(fields, &mut Budget(MAX_TRANSACTION_ITEMS)).map(Some) }
}

fn read_find(mut fields: Fields<'_>, budget: &mut Budget) -> Result<Primitive, WireError> {
    let (mut query, mut reason) = ("", "");
    let (mut room, mut support, mut chosen, mut candidates) = (None, None, None, Vec::new());
    while let Some(field) = fields.next()? {
        match field.number {
            1 => query = field.derived_text("query")?,
            2 => room = Some(read_index(&field, "room", Layer::Room)?),
            3 => support = Some(read_index(&field, "support", Layer::Object)?),
            4 => field.numbers(|number| {
                budget.take("candidate_nodes")?;
                candidates.push(node_of(&field, "candidate_nodes", number)?);
                Ok(())
            })?,
            5 => chosen = Some(read_node(&field, "chosen_node")?),
            6 => reason = field.derived_text("reason")?,
            _ => {}
        }
    }
    let (query, reason) = (query.to_owned(), reason.to_owned());
    Ok(Primitive::Find { query, room, support, candidates, chosen, reason })
}

fn read_add(
    mut fields: Fields<'_>,
    at: Stamp,
    budget: &mut Budget,
    label: &mut dyn FnMut(&Field<'_>) -> Result<Label, WireError>,
) -> Result<Primitive, WireError> {
    let (mut id, mut what, mut access) = (first(Layer::Object), None, Vec::new());
    while let Some(field) = fields.next()? {
        match field.number {
            1 => id = read_node(&field, "node")?,
            2 => {
                let object = read_object(field.message("Object")?, at, label)?;
                field.once(&mut what, Node::Object(object))?;
            }
            3 => {
                let region = read_region(field.message("Region")?)?;
                field.once(&mut what, Node::Region(region, Vec::new()))?;
            }
            4 => field.numbers(|number| {
                budget.take("access_rooms")?;
                access.push(index_of(&field, "access_rooms", Layer::Room, number)?);
                Ok(())
            })?,
            _ => {}
        }
    }
    let value = |expected| WireError::Value {
        message: "Add",
        field: "node",
        value: id.to_string().into(),
        expected,
    };
    let is_object = id.layer() == Layer::Object;
    match required(what, "Add", "what")? {
        Node::Object(_) if !is_object => Err(value("an object, as what is added is one")),
        Node::Object(_) if !access.is_empty() => Err(value("a room, as it gives access to rooms")),
        Node::Region(..) if is_object => Err(value("a region, as what is added is one")),
        Node::Region(region, _) => Ok(Primitive::Add { id, node: Node::Region(region, access) }),
        node @ Node::Object(_) => Ok(Primitive::Add { id, node }),
    }
}

fn read_remove(mut fields: Fields<'_>, log_time: Stamp) -> Result<Primitive, WireError> {
    let (mut id, mut to, mut at) = (first(Layer::Object), None, log_time);
    while let Some(field) = fields.next()? {
        match field.number {
            1 => id = read_node(&field, "node")?,
            2 => {
                to = match field.u64()? {
                    1 => Some(Departure::Gone),
                    2 => Some(Departure::Held),
                    other => return Err(field.refuse("to", other, "1 (gone) or 2 (held)")),
                }
            }
            3 => at = read_stamp(&field, "at_nanos")?,
            _ => {}
        }
    }
    Ok(Primitive::Remove { id, to: required(to, "Remove", "to")?, at })
}

#[inline]
fn read_move(mut fields: Fields<'_>, log_time: Stamp) -> Result<Primitive, WireError> {
    let (mut id, mut room, mut at) = (first(Layer::Object), first(Layer::Room), log_time);
    let (mut support, mut pose, mut pose_source) = (None, None, None);
    while let Some(field) = fields.next()? {
        match field.number {
            1 => id = read_index(&field, "object", Layer::Object)?,
            2 => room = read_index(&field, "room", Layer::Room)?,
            3 => support = Some(read_index(&field, "support", Layer::Object)?),
            4 => field.once(&mut pose, read_pose(field.message("Pose")?)?)?,
            5 => pose_source = Some(read_pose_source(&field)?),
            6 => at = read_stamp(&field, "at_nanos")?,
            _ => {}
        }
    }
    let pose = required(pose, "Move", "pose")?;
    let pose_source = required(pose_source, "Move", "pose_source")?;
    Ok(Primitive::Move { id, to: Placement { room, support, pose, pose_source, at } })
}

fn read_observe(
    mut fields: Fields<'_>,
    log_time: Stamp,
    budget: &mut Budget,
) -> Result<Primitive, WireError> {
    let (mut at, mut seen) = (log_time, Vec::new());
    while let Some(field) = fields.next()? {
        match field.number {
            1 => {
                budget.take("seen")?;
                seen.push(read_sighting(field.message("Sighting")?)?);
            }
            2 => at = read_stamp(&field, "at_nanos")?,
            _ => {}
        }
    }
    Ok(Primitive::Observe { at, seen })
}

fn read_sighting(mut fields: Fields<'_>) -> Result<Sighting, WireError> {
    let (mut id, mut pose, mut size) = (first(Layer::Object), None, None);
    while let Some(field) = fields.next()? {
        match field.number {
            1 => id = read_index(&field, "object", Layer::Object)?,
            2 => field.once(&mut pose, read_pose(field.message("Pose")?)?)?,
            3 => field.once(&mut size, read_size(field.message("Size")?)?)?,
            _ => {}
        }
    }
    Ok(Sighting { id, pose, size })
}

fn read_set_decay(mut fields: Fields<'_>) -> Result<Primitive, WireError> {
    let (mut id, mut decay_rate, mut origin) = (first(Layer::Object), 0.0, "");
    while let Some(field) = fields.next()? {
        match field.number {
            1 => id = read_index(&field, "object", Layer::Object)?,
            2 => decay_rate = read_decay_rate(&field)?,
            3 => origin = field.text("origin")?,
            _ => {}
        }
    }
    Ok(Primitive::SetDecay { id, decay_rate, origin: origin.to_owned() })
}
