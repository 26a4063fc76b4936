//! A recording as text: its states at chosen points and its change log, for regression tests.
//!
//! The text is made to be read in a diff: one line per object, one per change.

use std::fmt::Write;
use std::ops::ControlFlow;

use crate::change::{ChangeRecord, NodeRef, Outcome};
use crate::event::Event;
use crate::graph::{Layer, NodeId, Object, SceneGraph};
use crate::recording::{PointError, Recording, Walk, WalkError};
use crate::time::At;

/// First line of every snapshot; a later layout gets a later number.
pub const HEADER: &str = "scenefold snapshot 1";

/// Why no snapshot could be made.
#[derive(Debug, thiserror::Error)]
pub enum SnapshotError {
    /// No state at one of the points.
    #[error("--at {at}: {error}")]
    Point {
        /// The point.
        at: At,
        /// Why.
        error: PointError,
    },
    /// The recording cannot be walked.
    #[error(transparent)]
    Walk(#[from] WalkError),
}

/// The states of `recording` at `points`, and its change log, as text.
pub fn render(recording: &Recording, points: &[At]) -> Result<String, SnapshotError> {
    let mut text = format!("{HEADER}\n");
    for at in points {
        let failed = |error| SnapshotError::Point { at: *at, error };
        let state = recording.state_at(*at, 1).map_err(failed)?;
        line(&mut text, format_args!("\n== at {at} =="));
        line(&mut text, format_args!("event #{}  {}", state.order, state.at));
        line(&mut text, format_args!("state {}", state.graph().hash()));
        render_graph(&mut text, state.graph());
    }
    line(&mut text, format_args!("\n== changes =="));
    recording.visit_events(Walk::Events, (1, u64::MAX), &mut |logged| {
        if let Event::Change(record) = &logged.event {
            render_change(&mut text, logged.order, record);
        }
        ControlFlow::Continue(())
    })?;
    Ok(text)
}

/// The points that a snapshot shows, in the order of the text.
pub fn points(text: &str) -> Vec<At> {
    let at = |line: &str| line.strip_prefix("== at ")?.strip_suffix(" ==")?.parse().ok();
    text.lines().filter_map(at).collect()
}

fn render_graph(text: &mut String, graph: &SceneGraph) {
    for layer in [Layer::Building, Layer::Floor, Layer::Room] {
        for (id, region) in graph.regions(layer) {
            let parent = region.parent.map_or(String::new(), |parent| format!(" in {parent}"));
            let access: Vec<String> = graph.access_from(id).map(|room| room.to_string()).collect();
            let access = match access.is_empty() {
                true => String::new(),
                false => format!(" opens to {}", access.join(" ")),
            };
            line(text, format_args!("{id} {}{parent}{access}", region.label));
        }
    }
    graph.all_objects().for_each(|(id, object)| render_object(text, id, object));
}

fn render_object(text: &mut String, id: NodeId, object: &Object) {
    let on = object.support.map_or(String::new(), |on| format!(" on {on}"));
    let [x, y, z] = object.pose.position();
    let [qw, qx, qy, qz] = object.pose.orientation();
    let [w, h, d] = object.size.metres();
    line(
        text,
        format_args!(
            "{id} {} in {}{on} at ({x}, {y}, {z}) turned ({qw}, {qx}, {qy}, {qz}) size ({w}, {h}, \
             {d}) decay {} seen {} {}",
            object.label,
            object.room,
            object.decay_rate,
            object.last_observed,
            object.pose_source.as_str()
        ),
    );
}

fn render_change(text: &mut String, order: u64, record: &ChangeRecord) {
    let claim = &record.claim;
    let node = |node: &Option<NodeRef>| node.as_ref().map_or("-".to_owned(), NodeRef::to_string);
    let held = if claim.held { " (held)" } else { "" };
    let outcome = match &record.outcome {
        Outcome::Applied => "applied".to_owned(),
        Outcome::Rejected { code, reason } => format!("rejected {code}: {reason}"),
    };
    line(
        text,
        format_args!(
            "c{} #{order} {} {} {}{held} {} | {} -> {} | {} | {outcome}",
            record.seq,
            record.at,
            claim.modality.as_str(),
            claim.action.as_str(),
            claim.object,
            node(&claim.source_room),
            node(&claim.target_room),
            node(&claim.support)
        ),
    );
}

fn line(text: &mut String, content: std::fmt::Arguments<'_>) {
    writeln!(text, "{content}").expect("a string takes any text");
}
