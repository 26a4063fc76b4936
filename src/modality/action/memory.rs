//! What the detector remembers between inputs, and its bytes.

use std::collections::BTreeMap;

use crate::bytes::{Reader, Writer};
use crate::change::NodeRef;
use crate::event::Task;
use crate::graph::{CanonicalError, Label, NodeId};

/// Something that a task has picked and not yet placed.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Grasp {
    /// This object.
    Known(NodeId),
    /// Something of this name that the graph does not know.
    Unknown(NodeRef),
    /// One of these.
    Ambiguous(Vec<NodeId>),
}

/// What is remembered of a task that is not over.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct TaskMemory {
    /// What was announced, and the number of the event that did.
    pub announced: Option<(u64, Task)>,
    /// What the instruction asks for after that, in order.
    pub rest: Vec<Task>,
    /// In the order picked.
    pub in_hand: Vec<Grasp>,
}

/// By task id.
pub(super) type Tasks = BTreeMap<String, TaskMemory>;

pub(super) fn write(tasks: &Tasks, out: &mut Writer) {
    out.u64(tasks.len() as u64);
    for (id, task) in tasks {
        out.text(id);
        out.option(task.announced.as_ref(), |out, (order, task)| {
            out.u64(*order);
            write_task(out, task);
        });
        out.u64(task.in_hand.len() as u64);
        task.in_hand.iter().for_each(|grasp| write_grasp(grasp, out));
    }
}

/// Writes what tasks ask for after what they are at, which follows everything else.
pub(super) fn write_rest(tasks: &Tasks, out: &mut Writer) {
    let several = || tasks.iter().filter(|(_, task)| !task.rest.is_empty());
    out.u64(several().count() as u64);
    for (id, task) in several() {
        out.text(id);
        out.u64(task.rest.len() as u64);
        task.rest.iter().for_each(|task| write_task(out, task));
    }
}

pub(super) fn read_rest(tasks: &mut Tasks, input: &mut Reader<'_>) -> Result<(), CanonicalError> {
    let malformed = CanonicalError::Malformed { what: "memory of the parts of tasks" };
    try_read_rest(tasks, input).ok_or(malformed)
}

fn try_read_rest(tasks: &mut Tasks, input: &mut Reader<'_>) -> Option<()> {
    for _ in 0..input.u64()? {
        let id = input.text()?.to_owned();
        let count = input.u64()?;
        let rest = (0..count).map(|_| read_task(input, &id)).collect::<Option<_>>()?;
        tasks.get_mut(&id)?.rest = rest;
    }
    Some(())
}

fn write_task(out: &mut Writer, task: &Task) {
    out.text(&task.instruction);
    for node in [&task.object, &task.source_room, &task.target_room, &task.support] {
        out.option(node.as_ref(), write_ref);
    }
}

fn write_ref(out: &mut Writer, node: &NodeRef) {
    out.u64(node.id.map_or(0, NodeId::bits));
    out.text(node.label.as_ref().map_or("", Label::as_str));
}

fn write_grasp(grasp: &Grasp, out: &mut Writer) {
    match grasp {
        Grasp::Known(id) => {
            out.u64(1);
            out.u64(id.bits());
        }
        Grasp::Unknown(node) => {
            out.u64(2);
            write_ref(out, node);
        }
        Grasp::Ambiguous(ids) => {
            out.u64(3);
            out.u64(ids.len() as u64);
            ids.iter().for_each(|id| out.u64(id.bits()));
        }
    }
}

pub(super) fn read(input: &mut Reader<'_>) -> Result<Tasks, CanonicalError> {
    read_tasks(input).ok_or(CanonicalError::Malformed { what: "memory of tasks" })
}

fn read_tasks(input: &mut Reader<'_>) -> Option<Tasks> {
    let count = input.u64()?;
    let mut tasks = Tasks::new();
    for _ in 0..count {
        let task_id = input.text()?.to_owned();
        let announced = input.option(|input| Some((input.u64()?, read_task(input, &task_id)?)))?;
        let rest = Vec::new();
        let grasps = input.u64()?;
        let in_hand = (0..grasps).map(|_| read_grasp(input)).collect::<Option<_>>()?;
        tasks.insert(task_id, TaskMemory { announced, rest, in_hand });
    }
    Some(tasks)
}

fn read_task(input: &mut Reader<'_>, task_id: &str) -> Option<Task> {
    let instruction = input.text()?.to_owned();
    let mut node = || input.option(read_ref);
    let (object, source_room, target_room, support) = (node()?, node()?, node()?, node()?);
    let task_id = task_id.to_owned();
    Some(Task { task_id, instruction, object, source_room, target_room, support })
}

fn read_ref(input: &mut Reader<'_>) -> Option<NodeRef> {
    let id = match input.u64()? {
        0 => None,
        bits => Some(NodeId::try_from(bits).ok()?),
    };
    let label = match input.text()? {
        "" => None,
        text => Some(Label::new(text).ok()?),
    };
    Some(NodeRef { id, label })
}

fn read_grasp(input: &mut Reader<'_>) -> Option<Grasp> {
    let id = |input: &mut Reader<'_>| NodeId::try_from(input.u64()?).ok();
    Some(match input.u64()? {
        1 => Grasp::Known(id(input)?),
        2 => Grasp::Unknown(read_ref(input)?),
        3 => {
            let count = input.u64()?;
            Grasp::Ambiguous((0..count).map(|_| id(input)).collect::<Option<_>>()?)
        }
        _ => return None,
    })
}
