//! [`ActionDetector`]: from task statuses to claims.

use super::memory::{self, Grasp, TaskMemory, Tasks};
use crate::bytes::{Reader, Writer};
use crate::change::{
    Action, Claim, EvidenceRef, Modality, NodeRef, Occurred, Rejection, World, locate, locate_room,
};
use crate::event::{Interpretation, Status, Task, TaskStatus};
use crate::graph::{CanonicalError, NodeId, Object};
use crate::modality::Desk;
use crate::modality::desk::{evidence, node_ref};
use crate::modality::human::{
    Errand, GroundedErrand, LabelSimilarity, ground_errand, read_task, spans,
};

const TASK_TOPIC: &str = "/robot/task";
const STATUS_TOPIC: &str = "/robot/task_status";

/// Notices what the robot does to the world with its own hands. See the module docs.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ActionDetector {
    tasks: Tasks,
}

impl ActionDetector {
    /// Name and version, as change records carry it.
    pub const NAME: &'static str = "action/1";

    /// A task was announced by event `order`. What it does not name by node is understood from
    /// its instruction by the built-in interpreter.
    pub fn task(&mut self, desk: &mut Desk<'_>, order: u64, task: &Task) {
        let errands = if task.object.is_none() { read_task(&task.instruction) } else { Vec::new() };
        self.task_of(desk, order, task, &errands, None);
    }

    /// A task was announced whose instruction asks for `errands`, in order.
    pub fn task_of(
        &mut self,
        desk: &mut Desk<'_>,
        order: u64,
        task: &Task,
        errands: &[Errand],
        similarity: Option<&dyn LabelSimilarity>,
    ) {
        let mut parts = Vec::new();
        for errand in errands {
            let grounded = ground_errand(desk.world(), errand, similarity);
            let spans = spans(desk, &grounded.trail);
            let part = completed(task, grounded);
            desk.interpret(Interpretation { spans, ..interpret(desk, order, &part) });
            parts.push(part);
        }
        if parts.is_empty() {
            desk.interpret(interpret(desk, order, task));
            parts.push(task.clone());
        }
        let memory = self.tasks.entry(task.task_id.clone()).or_default();
        memory.announced = Some((order, parts.remove(0)));
        memory.rest = parts;
    }

    /// A status was reported by event `order`.
    pub fn task_status(&mut self, desk: &mut Desk<'_>, order: u64, status: &TaskStatus) {
        let memory = self.tasks.remove(&status.task_id).unwrap_or_default();
        let mut report = Report { desk, order, status, memory };
        let over = match status.status {
            Status::Started => false,
            Status::Picked => report.picked(),
            Status::Placed => report.placed(),
            Status::Failed => report.failed(),
            Status::Done => report.done(),
        };
        let memory = report.memory;
        // A task that nobody announced is remembered only while its hand is full.
        let idle = memory.announced.is_none() && memory.in_hand.is_empty();
        if !over && !idle {
            self.tasks.insert(status.task_id.clone(), memory);
        }
    }

    pub(crate) fn write_bytes(&self, out: &mut Writer) {
        memory::write(&self.tasks, out);
    }

    /// Whether no task has parts that are still to come.
    pub(crate) fn is_simple(&self) -> bool {
        self.tasks.values().all(|task| task.rest.is_empty())
    }

    pub(crate) fn write_parts(&self, out: &mut Writer) {
        memory::write_rest(&self.tasks, out);
    }

    pub(crate) fn read_parts(&mut self, input: &mut Reader<'_>) -> Result<(), CanonicalError> {
        memory::read_rest(&mut self.tasks, input)
    }

    pub(crate) fn read_bytes(input: &mut Reader<'_>) -> Result<Self, CanonicalError> {
        Ok(Self { tasks: memory::read(input)? })
    }
}

/// One status and what is known about its task. The methods return whether the task is over.
struct Report<'a, 'd> {
    desk: &'a mut Desk<'d>,
    order: u64,
    status: &'a TaskStatus,
    memory: TaskMemory,
}

impl Report<'_, '_> {
    fn picked(&mut self) -> bool {
        let object = self.object();
        let claim = Claim {
            source_room: self.status.room.clone().or_else(|| self.task()?.source_room.clone()),
            support: self.status.support.clone(),
            held: true,
            ..self.claim(Action::Removed, object.clone())
        };
        if object.is_empty() {
            let rejection = self.names_nothing();
            self.desk.reject(claim, rejection);
            return false;
        }
        let grasp = match self.desk.claim(claim) {
            Ok(NodeRef { id: Some(id), .. })
            | Err(
                Rejection::AlreadyHeld { object: NodeRef { id: Some(id), .. } }
                | Rejection::AlreadyAbsent { object: NodeRef { id: Some(id), .. } },
            ) => Grasp::Known(id),
            Err(Rejection::Ambiguous { candidates, .. }) => Grasp::Ambiguous(candidates),
            Err(Rejection::Contradiction { .. }) => return false,
            Ok(_) | Err(_) => Grasp::Unknown(object),
        };
        if !self.memory.in_hand.contains(&grasp) {
            self.memory.in_hand.push(grasp);
        }
        false
    }

    fn placed(&mut self) -> bool {
        let grasp = self.grasp();
        let (action, object) = match grasp.map(|n| &self.memory.in_hand[n]) {
            Some(Grasp::Known(id)) => (Action::Moved, node_ref(self.desk.world(), *id)),
            Some(Grasp::Unknown(object)) => (self.moved_or_added(object), object.clone()),
            Some(Grasp::Ambiguous(candidates)) => {
                let candidates = candidates.clone();
                let claim = self.placing(Action::Moved, self.object());
                let task = self.status.task_id.clone();
                self.desk.reject(claim, Rejection::PlacedAmbiguous { task, candidates });
                self.let_go(grasp);
                return false;
            }
            // Never picked, as far as is known: the robot's own hands are believed.
            None => (self.moved_or_added(&self.object()), self.object()),
        };
        let claim = self.placing(action, object.clone());
        if object.is_empty() {
            let rejection = self.names_nothing();
            self.desk.reject(claim, rejection);
        } else if self.desk.claim(claim).is_ok() {
            self.let_go(grasp);
            self.next_part();
        }
        false
    }

    /// What the instruction asks for next, once this part of it is placed.
    fn next_part(&mut self) {
        if self.memory.in_hand.is_empty()
            && !self.memory.rest.is_empty()
            && let Some((_, task)) = &mut self.memory.announced
        {
            *task = self.memory.rest.remove(0);
        }
    }

    /// Which of the things in the hand the report is about: the one it names, or the last one
    /// picked if it names none.
    fn grasp(&mut self) -> Option<usize> {
        let world = self.desk.world();
        // What another task has placed meanwhile is not in this hand any more.
        self.memory.in_hand.retain(|grasp| match grasp {
            Grasp::Known(id) => world.graph().object(*id).is_none_or(Object::is_held),
            _ => true,
        });
        let hand = &self.memory.in_hand;
        match &self.status.object {
            Some(named) => hand.iter().rposition(|grasp| means(world, grasp, named)),
            None => hand.len().checked_sub(1),
        }
    }

    fn let_go(&mut self, grasp: Option<usize>) {
        if let Some(grasp) = grasp {
            self.memory.in_hand.remove(grasp);
        }
    }

    fn failed(&mut self) -> bool {
        let dropped = self.status.pose.is_some()
            || self.status.room.is_some()
            || self.status.support.is_some();
        let mut held = self.held();
        if let Some(object) = held.last().cloned().filter(|_| dropped) {
            // Where the task wanted it is not where it fell: only the report counts.
            let claim = Claim {
                target_room: self.status.room.clone(),
                support: self.status.support.clone(),
                ..self.claim(Action::Moved, object)
            };
            // What is not put down by that stays in the gripper, and is told below.
            if self.desk.claim(claim).is_ok() {
                held.pop();
            }
        }
        self.keep_holding(held, |task, object| Rejection::FailedHolding { task, object })
    }

    fn done(&mut self) -> bool {
        let held = self.held();
        self.keep_holding(held, |task, object| Rejection::DoneHolding { task, object })
    }

    /// The task is over, but these stay in the gripper.
    fn keep_holding(
        &mut self,
        held: Vec<NodeRef>,
        why: impl Fn(String, NodeRef) -> Rejection,
    ) -> bool {
        for object in held {
            let rejection = why(self.status.task_id.clone(), object.clone());
            self.desk.reject(self.placing(Action::Moved, object), rejection);
        }
        true
    }

    /// What the task has in the gripper, as far as the graph knows it, in the order picked.
    fn held(&self) -> Vec<NodeRef> {
        let world = self.desk.world();
        let held = |grasp: &Grasp| match grasp {
            Grasp::Known(id) if world.graph().object(*id).is_some_and(Object::is_held) => {
                Some(node_ref(world, *id))
            }
            _ => None,
        };
        self.memory.in_hand.iter().filter_map(held).collect()
    }

    /// An object that is known was moved; one that nobody knew is new.
    fn moved_or_added(&self, object: &NodeRef) -> Action {
        match locate(self.desk.world(), object, None) {
            Err(Rejection::UnknownObject { .. }) if object.label.is_some() => Action::Added,
            _ => Action::Moved,
        }
    }

    fn placing(&self, action: Action, object: NodeRef) -> Claim {
        Claim {
            target_room: self.status.room.clone().or_else(|| self.task()?.target_room.clone()),
            support: self.status.support.clone().or_else(|| self.task()?.support.clone()),
            ..self.claim(action, object)
        }
    }

    fn claim(&self, action: Action, object: NodeRef) -> Claim {
        Claim {
            modality: Modality::Action,
            detector: ActionDetector::NAME.into(),
            action,
            object,
            source_room: None,
            target_room: None,
            support: None,
            pose: self.status.pose,
            size: None,
            confidence: 1.0,
            occurred: Occurred::at(self.desk.at()),
            held: false,
            evidence: self.evidence(),
        }
    }

    fn evidence(&self) -> Vec<EvidenceRef> {
        let announced = self.memory.announced.as_ref();
        let task = announced.map(|(order, _)| evidence(TASK_TOPIC, *order));
        std::iter::once(evidence(STATUS_TOPIC, self.order)).chain(task).collect()
    }

    fn object(&self) -> NodeRef {
        let named = self.status.object.clone();
        named.or_else(|| self.task()?.object.clone()).unwrap_or_default()
    }

    fn task(&self) -> Option<&Task> {
        self.memory.announced.as_ref().map(|(_, task)| task)
    }

    fn names_nothing(&self) -> Rejection {
        match self.task() {
            Some(_) => Rejection::NothingNamed,
            None => Rejection::UnknownTask { task: self.status.task_id.clone() },
        }
    }
}

/// The task with what its planner left open.
fn completed(task: &Task, errand: GroundedErrand) -> Task {
    let told = task.target_room.is_some() || task.support.is_some();
    Task {
        object: task.object.clone().or(errand.object),
        source_room: task.source_room.clone().or(errand.source_room),
        target_room: task.target_room.clone().or(errand.target_room.filter(|_| !told)),
        support: task.support.clone().or(errand.support.filter(|_| !told)),
        ..task.clone()
    }
}

/// Whether `named` may be what is grasped.
fn means(world: &World, grasp: &Grasp, named: &NodeRef) -> bool {
    let is = |id: NodeId| match (named.id, &named.label) {
        (Some(named), _) => named == id,
        (None, Some(label)) => {
            world.known(id).is_some_and(|object| object.label.same_class(label.as_str()))
        }
        (None, None) => false,
    };
    match grasp {
        Grasp::Known(id) => is(*id),
        Grasp::Ambiguous(candidates) => candidates.iter().any(|id| is(*id)),
        Grasp::Unknown(grasped) => match (&grasped.label, &named.label) {
            (Some(grasped), Some(named)) => grasped.same_class(named.as_str()),
            _ => grasped.id.is_some() && grasped.id == named.id,
        },
    }
}

/// What the nodes named by a task mean against the world as it is now.
fn interpret(desk: &Desk<'_>, order: u64, task: &Task) -> Interpretation {
    let world = desk.world();
    let mut notes = Vec::new();
    let mut room = |room: &Option<NodeRef>| -> Option<NodeId> {
        locate_room(world, room.as_ref()?).map_err(|why| notes.push(why.to_string())).ok()
    };
    let (source, target) = (room(&task.source_room), room(&task.target_room));
    let mut thing = |thing: &Option<NodeRef>, room: Option<NodeId>| -> Option<NodeId> {
        locate(world, thing.as_ref()?, room).map_err(|why| notes.push(why.to_string())).ok()
    };
    let (object, support) = (thing(&task.object, source), thing(&task.support, target));
    if task.object.is_none() {
        notes.push("the task names no object".to_owned());
    }
    let named = |id: Option<NodeId>| id.map(|id| node_ref(world, id));
    Interpretation {
        of: evidence(TASK_TOPIC, order),
        object: named(object),
        source_room: named(source),
        target_room: named(target),
        support: named(support),
        note: notes.join("; "),
        spans: Vec::new(),
    }
}
