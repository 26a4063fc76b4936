//! `Utterance`, `Task`, `TaskStatus`, `Tick` and `Interpretation`.

use super::common::{
    evidence, node_ref, optional_ref, pose, read_evidence, read_node_ref, read_pose,
};
use super::fields::{Field, Fields, required};
use super::{WireError, proto};
use crate::event::{Interpretation, Span, Status, Task, TaskStatus, Utterance};

/// Longest utterance or instruction, in bytes.
pub const MAX_UTTERANCE: usize = crate::event::MAX_SENTENCE;

pub(super) fn utterance(utterance: &Utterance) -> proto::Utterance {
    proto::Utterance { speaker: utterance.speaker.clone(), text: utterance.text.clone() }
}

pub(super) fn read_utterance(payload: &[u8]) -> Result<Utterance, WireError> {
    let mut fields = Fields::new("Utterance", payload);
    let (mut speaker, mut text) = ("", "");
    while let Some(field) = fields.next()? {
        match field.number {
            1 => speaker = field.text("speaker")?,
            2 => text = field.long_text("text", MAX_UTTERANCE)?,
            _ => {}
        }
    }
    Ok(Utterance { speaker: speaker.to_owned(), text: text.to_owned() })
}

pub(super) fn task(task: &Task) -> proto::Task {
    proto::Task {
        task_id: task.task_id.clone(),
        instruction: task.instruction.clone(),
        object: optional_ref(task.object.as_ref()),
        source_room: optional_ref(task.source_room.as_ref()),
        target_room: optional_ref(task.target_room.as_ref()),
        support: optional_ref(task.support.as_ref()),
    }
}

pub(super) fn read_task(payload: &[u8]) -> Result<Task, WireError> {
    let mut fields = Fields::new("Task", payload);
    let mut task = Task::default();
    while let Some(field) = fields.next()? {
        match field.number {
            1 => field.text("task_id")?.clone_into(&mut task.task_id),
            2 => field.long_text("instruction", MAX_UTTERANCE)?.clone_into(&mut task.instruction),
            3 => field.once(&mut task.object, read_node_ref(&field)?)?,
            4 => field.once(&mut task.source_room, read_node_ref(&field)?)?,
            5 => field.once(&mut task.target_room, read_node_ref(&field)?)?,
            6 => field.once(&mut task.support, read_node_ref(&field)?)?,
            _ => {}
        }
    }
    Ok(task)
}

pub(super) fn task_status(status: &TaskStatus) -> proto::TaskStatus {
    use proto::Status as Wire;
    let word = match status.status {
        Status::Started => Wire::Started,
        Status::Picked => Wire::Picked,
        Status::Placed => Wire::Placed,
        Status::Failed => Wire::Failed,
        Status::Done => Wire::Done,
    };
    proto::TaskStatus {
        task_id: status.task_id.clone(),
        status: word.into(),
        object_pose: status.pose.as_ref().map(pose),
        object: optional_ref(status.object.as_ref()),
        room: optional_ref(status.room.as_ref()),
        support: optional_ref(status.support.as_ref()),
    }
}

pub(super) fn read_task_status(payload: &[u8]) -> Result<TaskStatus, WireError> {
    let mut fields = Fields::new("TaskStatus", payload);
    let mut read = TaskStatus::bare("", Status::Started);
    let mut status = None;
    while let Some(field) = fields.next()? {
        match field.number {
            1 => field.text("task_id")?.clone_into(&mut read.task_id),
            2 => {
                status = Some(match field.u64()? {
                    n @ 1..=5 => Status::ALL[n as usize - 1],
                    other => {
                        let expected =
                            "1 (started), 2 (picked), 3 (placed), 4 (failed) or 5 (done)";
                        return Err(field.refuse("status", other, expected));
                    }
                });
            }
            3 => field.once(&mut read.pose, read_pose(field.message("Pose")?)?)?,
            4 => field.once(&mut read.object, read_node_ref(&field)?)?,
            5 => field.once(&mut read.room, read_node_ref(&field)?)?,
            6 => field.once(&mut read.support, read_node_ref(&field)?)?,
            _ => {}
        }
    }
    Ok(TaskStatus { status: required(status, "TaskStatus", "status")?, ..read })
}

pub(super) fn read_tick(payload: &[u8]) -> Result<(), WireError> {
    let mut fields = Fields::new("Tick", payload);
    while fields.next()?.is_some() {}
    Ok(())
}

pub(super) fn interpretation(of: &Interpretation) -> proto::Interpretation {
    proto::Interpretation {
        of: Some(evidence(&of.of)),
        object: of.object.as_ref().map(node_ref),
        source_room: optional_ref(of.source_room.as_ref()),
        target_room: optional_ref(of.target_room.as_ref()),
        support: optional_ref(of.support.as_ref()),
        note: of.note.clone(),
        spans: of.spans.iter().map(span).collect(),
    }
}

fn span(span: &Span) -> proto::Span {
    proto::Span {
        role: span.role.to_string(),
        start: span.start,
        end: span.end,
        chosen: span.chosen.iter().map(node_ref).collect(),
        candidates: span.candidates.iter().map(node_ref).collect(),
        why: span.why.clone(),
    }
}

fn read_span(field: &Field<'_>) -> Result<Span, WireError> {
    let mut fields = field.message("Span")?;
    let (chosen, candidates) = (Vec::new(), Vec::new());
    let (role, why) = ("".into(), String::new());
    let mut span = Span { role, start: 0, end: 0, chosen, candidates, why };
    while let Some(field) = fields.next()? {
        match field.number {
            1 => span.role = field.text("role")?.to_owned().into(),
            2 => span.start = field.u32("start")?,
            3 => span.end = field.u32("end")?,
            4 => span.chosen.push(read_node_ref(&field)?),
            5 => span.candidates.push(read_node_ref(&field)?),
            6 => field.derived_text("why")?.clone_into(&mut span.why),
            _ => {}
        }
    }
    Ok(span)
}

pub(super) fn read_interpretation(payload: &[u8]) -> Result<Interpretation, WireError> {
    let mut fields = Fields::new("Interpretation", payload);
    let (mut of, mut object, mut source_room) = (None, None, None);
    let (mut target_room, mut support, mut note, mut spans) = (None, None, "", Vec::new());
    while let Some(field) = fields.next()? {
        match field.number {
            1 => field.once(&mut of, read_evidence(&field)?)?,
            2 => field.once(&mut object, read_node_ref(&field)?)?,
            3 => field.once(&mut source_room, read_node_ref(&field)?)?,
            4 => field.once(&mut target_room, read_node_ref(&field)?)?,
            5 => field.once(&mut support, read_node_ref(&field)?)?,
            6 => note = field.derived_text("note")?,
            7 => spans.push(read_span(&field)?),
            _ => {}
        }
    }
    let of = required(of, "Interpretation", "of")?;
    let note = note.to_owned();
    Ok(Interpretation { of, object, source_room, target_room, support, note, spans })
}
