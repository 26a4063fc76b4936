//! Arbitrary domain values for property tests. Only compiled for tests.
//!
//! Strategies are boxed: nested by value they are too large for the stack of a test thread.
//! Values are valid by themselves; those of [`graph`] and [`world`] are valid together.

use std::borrow::Cow;

use proptest::collection::vec;
use proptest::option;
use proptest::prelude::*;
use proptest::sample::select;

use crate::change::{
    Action, Cause, ChangeRecord, Claim, Departure, EvidenceRef, Modality, NodeRef, Occurred,
    Outcome, Primitive, Sighting, Step, Transaction, World,
};
use crate::event::{
    Interpretation, LanguageReply, Span, StaleTarget, Staleness, Status, Task, TaskStatus, Topic,
    Utterance,
};
use crate::geometry::{Pose, Size};
use crate::graph::{Label, Layer, Node, NodeId, Object, Placement, PoseSource, Region, SceneGraph};
use crate::time::Stamp;

prop_compose! {
    /// Any label of the shape that labels mostly have, and some in other scripts.
    pub fn label()(text in "[a-z]{1,8}( [a-z]{1,6})?|[\\p{L}\\p{N}]{1,5}") -> Label {
        Label::new(&text).expect("not empty, short, without control characters")
    }
}

/// Any instant.
pub fn stamp() -> BoxedStrategy<Stamp> {
    prop_oneof![
        Just(Stamp::EPOCH),
        Just(Stamp::MAX),
        (0..=Stamp::MAX.nanos()).prop_map(Stamp::from_nanos),
        // About 2026, where recordings are.
        (1_767_000_000_000_000_000..1_798_000_000_000_000_000_u64).prop_map(Stamp::from_nanos),
    ]
    .boxed()
}

/// Any pose within some kilometres: upright, turned about z, or turned anyhow.
pub fn pose() -> BoxedStrategy<Pose> {
    let turn = prop_oneof![
        Just([1.0, 0.0, 0.0, 0.0]),
        (-1.0..1.0_f64).prop_map(|z| [0.5, 0.0, 0.0, z]),
        prop::array::uniform4(-1.0..1.0_f64),
    ];
    let place = prop_oneof![
        prop::array::uniform3(-10.0..10.0_f64),
        prop::array::uniform3(-1.0e7..1.0e7_f64)
    ];
    (place, turn).prop_map(|(at, wxyz)| Pose::new(at, wxyz).unwrap_or(Pose::IDENTITY)).boxed()
}

prop_compose! {
    /// Any box.
    pub fn size()(sides in prop::array::uniform3(1..10_000_000_i64)) -> Size {
        Size::from_micrometres(sides).expect("sides are positive and not huge")
    }
}

/// Any node of a layer, most of them with small indices.
pub fn node_of(layer: Layer) -> BoxedStrategy<NodeId> {
    prop_oneof![8 => 0..200_u32, 1 => 0..=NodeId::MAX_INDEX]
        .prop_map(move |index| NodeId::new(layer, index).expect("the index is in range"))
        .boxed()
}

/// Any node of any layer.
pub fn node() -> impl Strategy<Value = NodeId> {
    select(&Layer::ALL[..]).prop_flat_map(node_of)
}

/// A node as the planner leaves it, or as someone claims it.
pub fn node_ref() -> BoxedStrategy<NodeRef> {
    (option::of(node()), option::of(label())).prop_map(|(id, label)| NodeRef { id, label }).boxed()
}

/// A reference to any message.
pub fn evidence_ref() -> BoxedStrategy<EvidenceRef> {
    let own = select(&Topic::OWN[..]).prop_map(|topic| topic.name());
    let other = "/[a-z_]{1,10}(/[a-z_]{1,10})?".prop_map(Cow::Owned);
    (prop_oneof![own, other], 1..u64::MAX)
        .prop_map(|(topic, order)| EvidenceRef { topic, order })
        .boxed()
}

/// Any decay rate, immovable included.
pub fn decay_rate() -> impl Strategy<Value = f64> {
    prop_oneof![Just(0.0), 0.0..1.0_f64, Just(f64::MAX)]
}

fn pose_source() -> impl Strategy<Value = PoseSource> {
    select(vec![PoseSource::Measured, PoseSource::Topological, PoseSource::Held])
}

prop_compose! {
    /// Any object, whatever graph its room and support are in.
    pub fn object()(
        label in label(), pose in pose(), size in size(), decay_rate in decay_rate(),
        last_observed in stamp(), pose_source in pose_source(),
        room in node_of(Layer::Room), support in option::of(node_of(Layer::Object)),
    ) -> Object {
        Object { label, pose, size, decay_rate, last_observed, pose_source, room, support }
    }
}

prop_compose! {
    /// Any region without a parent.
    pub fn region()(label in label(), extent in option::of((pose(), size()))) -> Region {
        Region { label, extent, parent: None }
    }
}

/// How a graph is drawn: what the edits refuse is left out, so that any drawing is a graph.
#[derive(Clone, Debug)]
struct Drawing {
    regions: Vec<(usize, Region)>,
    access: Vec<(u32, u32)>,
    objects: Vec<(u32, Object, u32)>,
}

fn drawing() -> BoxedStrategy<Drawing> {
    let regions = vec((0..4_usize, region()), 1..8);
    let access = vec((0..4_u32, 0..4_u32), 0..6);
    let objects = vec((1..70_u32, object(), 0..200_u32), 0..12);
    (regions, access, objects)
        .prop_map(|(regions, access, objects)| Drawing { regions, access, objects })
        .boxed()
}

/// Any graph: regions of all layers with parents or without, accesses, objects that rest on
/// others (also on ones with larger ids) and objects in the gripper.
pub fn graph() -> BoxedStrategy<SceneGraph> {
    drawing()
        .prop_map(|drawing| {
            let mut graph = SceneGraph::new();
            draw_regions(&mut graph, &drawing);
            draw_objects(&mut graph, &drawing.objects);
            graph
        })
        .boxed()
}

fn draw_regions(graph: &mut SceneGraph, drawing: &Drawing) {
    let id = |layer, index: usize| NodeId::new(layer, index as u32 * 3).expect("a small index");
    for layer in [Layer::Building, Layer::Floor, Layer::Room] {
        for (n, (pick, region)) in drawing.regions.iter().enumerate() {
            let above = [Layer::Building, Layer::Floor].into_iter().find(|l| *l > layer);
            let parent = above.map(|layer| id(layer, *pick)).filter(|id| graph.contains(*id));
            if *pick == layer as usize || (layer == Layer::Room && n == 0) {
                let _ = graph.insert_region(id(layer, n), Region { parent, ..region.clone() });
            }
        }
    }
    let rooms: Vec<NodeId> = graph.rooms().map(|(id, _)| id).collect();
    for (a, b) in &drawing.access {
        let room = |n: &u32| rooms[*n as usize % rooms.len()];
        let _ = graph.connect(room(a), room(b));
    }
}

fn draw_objects(graph: &mut SceneGraph, objects: &[(u32, Object, u32)]) {
    let rooms: Vec<NodeId> = graph.rooms().map(|(id, _)| id).collect();
    let mut next = 0;
    let mut ids = Vec::new();
    for (step, object, _) in objects {
        let id = NodeId::new(Layer::Object, next).expect("a small index");
        next += step;
        let room = rooms[object.room.index() as usize % rooms.len()];
        let object = Object { room, support: None, ..object.clone() };
        graph.insert_object(id, object).expect("a new id in a known room");
        ids.push(id);
    }
    for (id, (_, _, on)) in ids.iter().zip(objects) {
        let support = ids.get(*on as usize % (2 * ids.len())).copied();
        let object = graph.object(*id).expect("it was just inserted");
        let to = Placement { support, ..Placement::of(object) };
        let _ = graph.place_object(*id, &to);
    }
}

/// Any world: a graph, some of whose objects have left since, so that there are departed ones.
pub fn world() -> impl Strategy<Value = World> {
    (graph(), vec((any::<bool>(), departure(), stamp()), 12)).prop_map(|(graph, leave)| {
        let ids: Vec<NodeId> = graph.all_objects().map(|(id, _)| id).collect();
        let mut world = World::from_graph(graph);
        for (id, (leaves, to, at)) in ids.into_iter().zip(leave) {
            if leaves {
                let _ = Primitive::Remove { id, to, at }.apply(&mut world);
            }
        }
        world
    })
}

fn departure() -> impl Strategy<Value = Departure> {
    select(vec![Departure::Gone, Departure::Held])
}

fn outcome() -> impl Strategy<Value = Outcome> {
    prop_oneof![
        Just(Outcome::Applied),
        ("[a-z_]{1,12}", ".{0,40}")
            .prop_map(|(code, reason)| Outcome::Rejected { code: code.into(), reason }),
    ]
}

prop_compose! {
    /// Any claim.
    pub fn claim()(
        (modality, action) in (select(&Modality::ALL[..]), select(&Action::ALL[..])),
        detector in "[a-z]{1,8}/[0-9]",
        object in node_ref(),
        (source_room, target_room) in (option::of(node_ref()), option::of(node_ref())),
        support in option::of(node_ref()),
        (pose, size) in (option::of(pose()), option::of(size())),
        confidence in 0.0..=1.0_f64,
        (not_before, not_after) in (option::of(stamp()), option::of(stamp())),
        held: bool,
        evidence in vec(evidence_ref(), 0..4),
    ) -> Claim {
        Claim {
            modality, detector: detector.into(), action, object, source_room, target_room,
            support, pose, size, confidence, occurred: Occurred { not_before, not_after }, held,
            evidence,
        }
    }
}

prop_compose! {
    /// Any change record.
    pub fn change_record()(
        seq in 1..u64::MAX, at in stamp(), claim in claim(), outcome in outcome(),
    ) -> ChangeRecord {
        ChangeRecord { seq, at, claim, outcome }
    }
}

prop_compose! {
    fn placement()(
        room in node_of(Layer::Room), support in option::of(node_of(Layer::Object)),
        pose in pose(), pose_source in pose_source(), at in stamp(),
    ) -> Placement {
        Placement { room, support, pose, pose_source, at }
    }
}

prop_compose! {
    fn find()(
        query in ".{0,12}", room in option::of(node_of(Layer::Room)),
        support in option::of(node_of(Layer::Object)), candidates in vec(node(), 0..5),
        chosen in option::of(node()), reason in ".{0,20}",
    ) -> Primitive {
        Primitive::Find { query, room, support, candidates, chosen, reason }
    }
}

fn add() -> BoxedStrategy<Primitive> {
    let of_object = (node_of(Layer::Object), object())
        .prop_map(|(id, object)| Primitive::Add { id, node: Node::Object(object) });
    let layer = select(vec![Layer::Room, Layer::Floor, Layer::Building]);
    let of_region = (layer.prop_flat_map(node_of), region(), option::of(node()), access())
        .prop_map(|(id, region, parent, access)| {
            let node = Node::Region(Region { parent, ..region }, access);
            Primitive::Add { id, node }
        });
    prop_oneof![of_object, of_region].boxed()
}

fn access() -> impl Strategy<Value = Vec<NodeId>> {
    vec(node_of(Layer::Room), 0..3)
}

fn sighting() -> impl Strategy<Value = Sighting> {
    (node_of(Layer::Object), option::of(pose()), option::of(size()))
        .prop_map(|(id, pose, size)| Sighting { id, pose, size })
}

/// Any primitive, whatever a graph would say to it.
pub fn primitive() -> BoxedStrategy<Primitive> {
    let object = || node_of(Layer::Object);
    prop_oneof![
        find(),
        add(),
        (node(), departure(), stamp()).prop_map(|(id, to, at)| Primitive::Remove { id, to, at }),
        (object(), placement()).prop_map(|(id, to)| Primitive::Move { id, to }),
        (stamp(), vec(sighting(), 0..4)).prop_map(|(at, seen)| Primitive::Observe { at, seen }),
        (object(), decay_rate(), ".{0,12}").prop_map(|(id, decay_rate, origin)| {
            Primitive::SetDecay { id, decay_rate, origin }
        }),
    ]
    .boxed()
}

fn cause() -> BoxedStrategy<Cause> {
    prop_oneof![
        // Few numbers, so that steps often share one.
        (0..3_u64).prop_map(Cause::Change),
        any::<u64>().prop_map(Cause::Change),
        evidence_ref().prop_map(Cause::Evidence),
    ]
    .boxed()
}

/// Any transaction; some of its times are its own.
pub fn transaction() -> BoxedStrategy<Transaction> {
    let step = (cause(), primitive(), any::<bool>());
    (stamp(), vec(step, 0..6))
        .prop_map(|(at, steps)| {
            let steps = steps.into_iter().map(|(cause, primitive, now)| {
                let primitive = if now { at_time(primitive, at) } else { primitive };
                Step { cause, primitive }
            });
            Transaction { at, steps: steps.collect() }
        })
        .boxed()
}

fn at_time(primitive: Primitive, at: Stamp) -> Primitive {
    match primitive {
        Primitive::Remove { id, to, .. } => Primitive::Remove { id, to, at },
        Primitive::Move { id, to } => Primitive::Move { id, to: Placement { at, ..to } },
        Primitive::Observe { seen, .. } => Primitive::Observe { at, seen },
        Primitive::Add { id, node: Node::Object(object) } => {
            Primitive::Add { id, node: Node::Object(Object { last_observed: at, ..object }) }
        }
        other => other,
    }
}

/// Any utterance.
pub fn utterance() -> impl Strategy<Value = Utterance> {
    (".{0,8}", ".{0,60}").prop_map(|(speaker, text)| Utterance { speaker, text })
}

prop_compose! {
    /// Any task.
    pub fn task()(
        task_id in ".{0,8}", instruction in ".{0,40}", object in option::of(node_ref()),
        source_room in option::of(node_ref()), target_room in option::of(node_ref()),
        support in option::of(node_ref()),
    ) -> Task {
        Task { task_id, instruction, object, source_room, target_room, support }
    }
}

prop_compose! {
    /// Any status of a task.
    pub fn task_status()(
        task_id in ".{0,8}", status in select(&Status::ALL[..]), pose in option::of(pose()),
        object in option::of(node_ref()), room in option::of(node_ref()),
        support in option::of(node_ref()),
    ) -> TaskStatus {
        TaskStatus { task_id, status, pose, object, room, support }
    }
}

prop_compose! {
    /// Any reply of a model.
    pub fn language_reply()(
        of in evidence_ref(), back_end in "[a-z]{1,8}/[0-9]", model in ".{0,12}",
        prompt in "[a-z]{0,8}/[0-9]", request in ".{0,60}",
        answer in proptest::result::maybe_ok(".{0,60}", ".{0,20}"),
        attempts: u32, latency_nanos: u64,
    ) -> LanguageReply {
        let (back_end, prompt) = (back_end.into(), prompt.into());
        LanguageReply { of, back_end, model, prompt, request, answer, attempts, latency_nanos }
    }
}

prop_compose! {
    /// Any words and what they were taken to mean.
    fn span()(
        role in "[a-z]{0,8}", start in any::<u32>(), end in any::<u32>(),
        chosen in vec(node_ref(), 0..3), candidates in vec(node_ref(), 0..3), why in ".{0,20}",
    ) -> Span {
        Span { role: role.into(), start, end, chosen, candidates, why }
    }
}

prop_compose! {
    /// Any report of what became improbable.
    pub fn staleness()(
        threshold in 0.0..1.0_f64,
        targets in vec((node_ref(), option::of(node_ref()), 0.0..1.0_f64, 0.0..1.0_f64, stamp()), 0..4),
    ) -> Staleness {
        let target = |(object, room, probability, decay_rate, last_observed)| {
            StaleTarget { object, room, probability, decay_rate, last_observed }
        };
        Staleness { threshold, targets: targets.into_iter().map(target).collect() }
    }
}

prop_compose! {
    /// Any interpretation.
    pub fn interpretation()(
        of in evidence_ref(), object in option::of(node_ref()),
        source_room in option::of(node_ref()), target_room in option::of(node_ref()),
        support in option::of(node_ref()), note in ".{0,20}", spans in vec(span(), 0..3),
    ) -> Interpretation {
        Interpretation { of, object, source_room, target_room, support, note, spans }
    }
}
