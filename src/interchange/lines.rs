//! Inputs as JSON lines: `{"at": …, "topic": …, "message": {…}}`, what `ingest` reads.
//!
//! | topic | message |
//! |---|---|
//! | `/human/utterance` | `{speaker?, text}` |
//! | `/robot/task` | `{task_id, instruction?, object?, source_room?, target_room?, support?}` |
//! | `/robot/task_status` | `{task_id, status, object?, room?, support?, pose?}` |
//! | `/clock` | none |
//!
//! `status` is started, picked, placed, failed or done; nodes are `{id?, label?}`; a pose is
//! `{position: [x, y, z], orientation?: {w, x, y, z}}` in metres, world frame. `at` is RFC 3339.

use super::json::{self, At, JsonError};
use crate::change::NodeRef;
use crate::event::{Event, Status, Task, TaskStatus, Topic, Utterance};
use crate::geometry::Pose;
use crate::graph::Label;
use crate::time::Stamp;

/// Reads one line.
///
/// ```
/// use scenefold::interchange::lines;
/// let line = r#"{"at": "2026-01-05T08:00:00Z", "topic": "/clock"}"#;
/// assert!(lines::parse(line).is_ok());
/// assert!(lines::parse("{}").unwrap_err().to_string().contains("at"));
/// ```
pub fn parse(line: &str) -> Result<(Stamp, Event), JsonError> {
    let value = json::parse(line)?;
    let root = At::root(&value);
    root.only(&["at", "topic", "message"])?;
    let at = root.field("at")?.parsed()?;
    let topic = root.field("topic")?;
    let event = match Topic::named(topic.text()?) {
        Topic::Clock => Event::Tick,
        Topic::Utterance => utterance(&root.field("message")?)?,
        Topic::Task => task(&root.field("message")?)?,
        Topic::TaskStatus => task_status(&root.field("message")?)?,
        _ => {
            return Err(topic.error(
                "not a topic for lines; known are /human/utterance, /robot/task, \
                 /robot/task_status, /clock",
            ));
        }
    };
    Ok((at, event))
}

fn utterance(message: &At<'_>) -> Result<Event, JsonError> {
    message.only(&["speaker", "text"])?;
    let speaker = optional_text(message, "speaker")?;
    let text = message.field("text")?.text()?.to_owned();
    Ok(Event::Utterance(Utterance { speaker, text }))
}

fn task(message: &At<'_>) -> Result<Event, JsonError> {
    message.only(&["task_id", "instruction", "object", "source_room", "target_room", "support"])?;
    Ok(Event::Task(Task {
        task_id: task_id(message)?,
        instruction: optional_text(message, "instruction")?,
        object: node(message, "object")?,
        source_room: node(message, "source_room")?,
        target_room: node(message, "target_room")?,
        support: node(message, "support")?,
    }))
}

fn task_status(message: &At<'_>) -> Result<Event, JsonError> {
    message.only(&["task_id", "status", "object", "room", "support", "pose"])?;
    let word = message.field("status")?;
    let text = word.text()?;
    let status = Status::ALL.into_iter().find(|status| status.as_str() == text);
    let status = status.ok_or_else(|| {
        word.error(format!("{text:?} must be started, picked, placed, failed or done"))
    })?;
    Ok(Event::TaskStatus(TaskStatus {
        task_id: task_id(message)?,
        status,
        pose: message.optional("pose")?.map(|pose| read_pose(&pose)).transpose()?,
        object: node(message, "object")?,
        room: node(message, "room")?,
        support: node(message, "support")?,
    }))
}

fn task_id(message: &At<'_>) -> Result<String, JsonError> {
    let id = message.field("task_id")?;
    match id.text()? {
        "" => Err(id.error("a task needs a name")),
        text => Ok(text.to_owned()),
    }
}

fn optional_text(message: &At<'_>, name: &str) -> Result<String, JsonError> {
    let text = message.optional(name)?.map(|text| text.text().map(str::to_owned)).transpose()?;
    Ok(text.unwrap_or_default())
}

fn node(message: &At<'_>, name: &str) -> Result<Option<NodeRef>, JsonError> {
    let Some(node) = message.optional(name)? else { return Ok(None) };
    node.only(&["id", "label"])?;
    let id = node.optional("id")?.map(|id| id.parsed()).transpose()?;
    let label = node.optional("label")?;
    let label = label.map(|label| Label::new(label.text()?).map_err(|e| label.error(e)));
    let found = NodeRef { id, label: label.transpose()? };
    if found.is_empty() { Err(node.error("it needs an id or a label")) } else { Ok(Some(found)) }
}

fn read_pose(pose: &At<'_>) -> Result<Pose, JsonError> {
    pose.only(&["position", "orientation"])?;
    let position = pose.field("position")?.triple()?;
    let orientation = pose.optional("orientation")?.map(|q| q.quaternion()).transpose()?;
    let upright = [1.0, 0.0, 0.0, 0.0];
    Pose::new(position, orientation.unwrap_or(upright)).map_err(|error| pose.error(error))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn refused(line: &str, because: &str) {
        let error = parse(line).unwrap_err().to_string();
        assert!(error.contains(because), "{error}");
    }

    #[test]
    fn a_status_is_read_with_all_it_names() {
        let line = r#"{"at":"1970-01-01T00:00:01Z","topic":"/robot/task_status","message":
            {"task_id":"t","status":"placed","object":{"id":"O1"},"room":{"label":"kitchen"},
             "support":{"id":"O2","label":"table"},"pose":{"position":[1,2,3]}}}"#;
        let (at, event) = parse(line).unwrap();
        assert_eq!(at, Stamp::from_nanos(1_000_000_000));
        let Event::TaskStatus(status) = event else { panic!("{event:?}") };
        assert_eq!(status.status, Status::Placed);
        assert_eq!(status.pose, Pose::at([1.0, 2.0, 3.0]).ok());
        assert_eq!(status.object, Some(NodeRef::id("O1".parse().unwrap())));
    }

    #[test]
    fn what_is_wrong_with_a_line_is_named() {
        let line = |message: &str| {
            format!(
                r#"{{"at":"1970-01-01T00:00:01Z","topic":"/robot/task_status","message":{message}}}"#
            )
        };
        refused("", "not JSON");
        refused("[]", "object");
        refused(r#"{"at":"now","topic":"/clock"}"#, "at");
        refused(r#"{"at":"1970-01-01T00:00:01Z","topic":"/change","message":{}}"#, "/clock");
        refused(&line("{}"), "status");
        refused(&line(r#"{"task_id":"t","status":"lifted"}"#), "picked");
        refused(&line(r#"{"task_id":"t","status":"picked","object":{}}"#), "message.object");
        refused(&line(r#"{"task_id":"t","status":"picked","objct":{}}"#), "objct");
        refused(
            &line(r#"{"task_id":"t","status":"picked","pose":{"position":[1,2]}}"#),
            "message.pose.position",
        );
    }
}
