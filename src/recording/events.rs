//! Walking over the events of a recording in their order.

use std::collections::BTreeSet;
use std::ops::ControlFlow;

use super::open::{Recording, Segment};
use super::orphans::Orphans;
use crate::container::{LogError, MessageFilter, RawMessage};
use crate::event::{Event, Logged, SensorMessage, Topic};
use crate::history::{EventLog, FoldError};
use crate::time::Stamp;
use crate::wire;

/// Which events are walked over.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Walk {
    /// All but images and clouds.
    Events,
    /// All of them.
    Everything,
}

/// An event as it is stored.
#[derive(Clone, Copy, Debug)]
pub(super) struct RawEvent<'a> {
    pub order: u64,
    pub topic: &'a Topic,
    pub channel: u16,
    pub log_time: u64,
    pub publish_time: u64,
    pub data: &'a [u8],
}

impl<'a> RawEvent<'a> {
    /// The event that `message` is, as number `order`.
    pub fn of(order: u64, topic: &'a Topic, message: &RawMessage<'a>) -> Self {
        Self {
            order,
            topic,
            channel: message.channel,
            log_time: message.log_time,
            publish_time: message.publish_time,
            data: message.data,
        }
    }
}

/// Why a recording could not be walked to the end.
#[derive(Debug, thiserror::Error)]
#[error("{error}\n  {}", .path.display())]
pub struct WalkError {
    path: std::path::PathBuf,
    error: LogError,
}

type RawVisitor<'v, 'r> = dyn FnMut(&'r Segment, RawEvent<'_>) -> ControlFlow<()> + 'v;

impl Recording {
    /// Visits the events numbered `first` to `last`, in order, until the visitor breaks.
    /// What cannot be read or understood is left out and reported by [`Recording::trouble`].
    pub fn visit_events(
        &self,
        walk: Walk,
        (first, last): (u64, u64),
        visitor: &mut dyn FnMut(&Logged) -> ControlFlow<()>,
    ) -> Result<(), WalkError> {
        self.walk(walk, (first, last), &mut |segment, raw| match decode(segment, raw) {
            Ok(logged) => visitor(&logged),
            Err(error) => {
                self.report(segment, format_args!("event #{}: {error}", raw.order));
                ControlFlow::Continue(())
            }
        })
    }

    /// As [`Recording::visit_events`], before decoding.
    pub(super) fn walk<'r>(
        &'r self,
        walk: Walk,
        (first, last): (u64, u64),
        visitor: &mut RawVisitor<'_, 'r>,
    ) -> Result<(), WalkError> {
        let numbered = self.is_numbered();
        let (from_segment, from_time, known) = match numbered {
            true => self.place_before(first),
            false => (0, 0, 0),
        };
        let mut counted = 0;
        for (n, segment) in self.segments.iter().enumerate().skip(from_segment) {
            let filter = MessageFilter { from_time, ..filter(segment, walk, numbered) };
            let mut orphans = Orphans::after(known, self, n);
            let mut each = |raw: RawEvent<'_>| {
                counted += 1;
                let order = if numbered { raw.order } else { counted };
                if order > last {
                    return ControlFlow::Break(());
                }
                let wanted = walk == Walk::Everything || !segment.sensors.contains(&raw.channel);
                if (numbered && !orphans.takes(order)) || order < first || !wanted {
                    return ControlFlow::Continue(());
                }
                visitor(segment, RawEvent { order, ..raw })
            };
            if self.walk_segment(segment, filter, &mut each)?.is_break() {
                break;
            }
        }
        Ok(())
    }

    fn walk_segment(
        &self,
        segment: &Segment,
        filter: MessageFilter,
        each: &mut dyn FnMut(RawEvent<'_>) -> ControlFlow<()>,
    ) -> Result<ControlFlow<()>, WalkError> {
        let failed = |error| WalkError { path: segment.path.clone(), error };
        let mut cursor = segment.log.messages(filter);
        let mut flow = ControlFlow::Continue(());
        while let Some(message) = cursor.next_message().map_err(failed)? {
            let Some(topic) = segment.topics.get(&message.channel) else { continue };
            flow = each(RawEvent::of(u64::from(message.sequence), topic, &message));
            if flow.is_break() {
                break;
            }
        }
        for damage in cursor.damage().items() {
            self.report_damage(segment, damage);
        }
        Ok(flow)
    }

    /// A segment and a log time at or before event `order`, by the nearest checkpoint, and the
    /// number of the last event that the checkpoint covers.
    fn place_before(&self, order: u64) -> (usize, u64, u64) {
        let before = self.checkpoints().rfind(|c| c.order < order);
        before.map_or((0, 0, 0), |c| (c.segment, c.at.nanos(), c.order))
    }

    /// The event with this number, sensor data included; `None` if it is not there.
    pub fn event(&self, order: u64) -> Result<Option<Logged>, WalkError> {
        let mut found = None;
        self.visit_events(Walk::Everything, (order, order), &mut |logged| {
            found = Some(logged.clone());
            ControlFlow::Break(())
        })?;
        Ok(found)
    }
}

impl EventLog for Recording {
    type Error = WalkError;

    fn visit(
        &self,
        first: u64,
        last: u64,
        visitor: &mut dyn FnMut(&Logged) -> ControlFlow<()>,
    ) -> Result<(), WalkError> {
        self.visit_events(Walk::Events, (first, last), visitor)
    }

    fn visit_all(
        &self,
        first: u64,
        last: u64,
        visitor: &mut dyn FnMut(&Logged) -> ControlFlow<()>,
    ) -> Result<(), WalkError> {
        self.visit_events(Walk::Everything, (first, last), visitor)
    }

    fn refused(&self, error: &FoldError) -> bool {
        if let Some(segment) = self.segments.last() {
            self.report(segment, error);
        }
        true
    }
}

/// In files of other programs every message counts, so every channel must be walked over.
fn filter(segment: &Segment, walk: Walk, numbered: bool) -> MessageFilter {
    let mut channels: BTreeSet<u16> = segment.events.clone();
    if walk == Walk::Everything || !numbered {
        channels.extend(&segment.sensors);
    }
    MessageFilter { channels: Some(channels), ..MessageFilter::default() }
}

/// The event that a stored message holds.
pub(super) fn decode(segment: &Segment, raw: RawEvent<'_>) -> Result<Logged, wire::WireError> {
    let at = Stamp::from_nanos(raw.log_time);
    let event = match raw.topic {
        Topic::Sensor(_) => Event::Sensor(sensor_message(segment, raw)),
        own => wire::decode(own, at, raw.data)?,
    };
    let published = Stamp::from_nanos(raw.publish_time);
    Ok(Logged { order: raw.order, at, published, event })
}

pub(super) fn sensor_message(segment: &Segment, raw: RawEvent<'_>) -> SensorMessage {
    let channel = segment.log.channels().get(&raw.channel);
    let schema = channel.and_then(|channel| segment.log.schemas().get(&channel.schema_id));
    SensorMessage {
        topic: raw.topic.name().as_ref().into(),
        message_encoding: channel.map_or("", |channel| &channel.message_encoding).into(),
        schema_name: schema.map_or("", |schema| &schema.name).into(),
        schema_encoding: schema.map_or("", |schema| &schema.encoding).into(),
        schema: schema.map_or(&[][..], |schema| &schema.data).into(),
        data: raw.data.into(),
    }
}
