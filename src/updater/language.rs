//! What is asked of language models about an input, and what is made of their replies.

use super::{Config, Language, Updater};
use crate::change::EvidenceRef;
use crate::event::{Event, Interpretation, LanguageReply, Topic, Utterance};
use crate::modality::Desk;
use crate::modality::human::{
    LanguageModel, LanguageRequest, NEAREST_PROMPT, READING_PROMPT, Reading, parse_reading, reading_request,
};

impl Updater {
    /// What a model is to be asked next about `input`, with what was answered so far in
    /// `outputs`; `None` if nothing (more) is needed.
    ///
    /// Call it until it gives `None`, adding each reply to `outputs`, then hand both to
    /// [`Updater::update_with`]. A reply that is an error, or none at all, is fine: the built-in
    /// interpreter reads the sentence then.
    pub fn request(&self, input: &Event, outputs: &[Event]) -> Option<LanguageRequest> {
        match input {
            Event::Utterance(said) => {
                if self.config.language == Language::Server
                    && reply(outputs, READING_PROMPT).is_none()
                {
                    return reading_request(&self.world, &said.text);
                }
                None
            }
            _ => None,
        }
    }
}

impl Updater {
    /// Asks `model` all that is needed to know about `input`; the replies, in order.
    ///
    /// Whatever the model does, the replies can be recorded: those that are too long are
    /// recorded as errors.
    pub fn ask(&self, input: &Event, mut model: Option<&mut dyn LanguageModel>) -> Vec<Event> {
        let mut outputs = Vec::new();
        while let Some(request) = self.request(input, &outputs) {
            let reply = match &mut model {
                Some(model) => model.answer(&request),
                None => LanguageReply::nobody(&request),
            };
            // Under another name it would not be found, and asked for for ever.
            let reply = LanguageReply { prompt: request.prompt.into(), ..reply };
            outputs.push(Event::LanguageReply(recordable(reply)));
        }
        outputs
    }
}

fn recordable(reply: LanguageReply) -> LanguageReply {
    match Event::LanguageReply(reply.clone()).check_length() {
        Ok(()) => reply,
        Err(too_long) => LanguageReply {
            back_end: reply.back_end.chars().take(100).collect::<String>().into(),
            model: reply.model.chars().take(100).collect(),
            request: String::new(),
            answer: Err(too_long.to_string()),
            ..reply
        },
    }
}

/// The reply to the question of this kind, whatever its version.
fn reply<'o>(outputs: &'o [Event], prompt: &str) -> Option<&'o LanguageReply> {
    let kind = |prompt: &str| prompt.split('/').next().map(str::to_owned);
    outputs.iter().find_map(|output| match output {
        Event::LanguageReply(reply) if kind(&reply.prompt) == kind(prompt) => Some(reply),
        _ => None,
    })
}

/// What the models' replies make of a sentence.
#[derive(Debug)]
pub(super) enum Read {
    /// A model read it: by which back end, and what.
    ByModel(String, Reading),
    /// The built-in interpreter must; why, if a model was to.
    BuiltIn(Option<String>),
}

/// Reads `text` as the reply in `outputs` has it, if the configuration asks for that.
fn read(config: &Config, text: &str, outputs: &[Event]) -> Read {
    if config.language == Language::Builtin {
        return Read::BuiltIn(None);
    }
    let Some(reply) = reply(outputs, READING_PROMPT) else {
        return Read::BuiltIn(Some("no model was asked".to_owned()));
    };
    match &reply.answer {
        Err(error) => Read::BuiltIn(Some(error.clone())),
        Ok(answer) => match parse_reading(text, answer) {
            Ok(reading) => Read::ByModel(reply.back_end.to_string(), reading),
            Err(error) => Read::BuiltIn(Some(error.to_string())),
        },
    }
}

pub(super) fn utterance(
    desk: &mut Desk<'_>,
    config: &Config,
    order: u64,
    said: &Utterance,
    outputs: &[Event],
) {
    let _ = NEAREST_PROMPT;
    let note = match read(config, &said.text, outputs) {
        Read::BuiltIn(None) => return,
        Read::BuiltIn(Some(why)) => format!("read by the built-in interpreter: {why}"),
        Read::ByModel(back_end, reading) => format!("{} by {back_end}", reading.note),
    };
    desk.interpret(Interpretation {
        of: EvidenceRef { topic: Topic::Utterance.name(), order },
        object: None,
        source_room: None,
        target_room: None,
        support: None,
        note,
    });
}
