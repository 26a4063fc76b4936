//! What is asked of language models about an input, and what is made of their replies.

use super::{Config, Language, Updater};
use crate::event::{Event, LanguageReply};
use crate::modality::Desk;
use crate::modality::human::{
    HumanDetector, LabelSimilarity, LanguageModel, LanguageRequest, MAX_ASKED, NEAREST_PROMPT,
    Nearest, READING_PROMPT, Reading, Said, nearest_request, parse_reading, reading_request,
};

impl Updater {
    /// What a model is to be asked next about `input`, with what was answered so far in
    /// `outputs`; `None` if nothing (more) is needed.
    ///
    /// First what a sentence reports, if a server is to read it; then which labels are nearest
    /// to names that nobody knows, if a model is to be asked that. [`Updater::ask`] asks until
    /// nothing is needed. A reply that is an error, or none at all, is fine: the built-in
    /// interpreter reads the sentence then.
    pub fn request(&self, input: &Event, outputs: &[Event]) -> Option<LanguageRequest> {
        let Event::Utterance(said) = input else { return None };
        let (world, text) = (&self.world, said.text.as_str());
        let reads = self.config.language == Language::Server
            && text.len() <= MAX_ASKED
            && !self.human.corrects(world, self.at, text);
        if reads && reply(outputs, READING_PROMPT).is_none() {
            return reading_request(world, text);
        }
        if self.config.label_similarity.is_none() || reply(outputs, NEAREST_PROMPT).is_some() {
            return None;
        }
        let answers = Answers::of(&self.config, text, 0, outputs);
        let reading = answers.reading.as_ref().ok().and_then(Option::as_ref);
        let reading = reading.map(|(_, reading)| reading);
        nearest_request(world, &self.human.unknown_names(world, self.at, text, reading))
    }

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

/// The reply to the question of this kind, whatever its version, and its place in `outputs`.
fn reply<'o>(outputs: &'o [Event], prompt: &str) -> Option<(usize, &'o LanguageReply)> {
    let kind = |prompt: &str| prompt.split('/').next().map(str::to_owned);
    outputs.iter().enumerate().find_map(|(n, output)| match output {
        Event::LanguageReply(reply) if kind(&reply.prompt) == kind(prompt) => Some((n, reply)),
        _ => None,
    })
}

/// What the replies of models say about a sentence, as far as the configuration asks for them.
pub(super) struct Answers {
    /// Which back end read it, and what; `None` if the built-in interpreter is to.
    ///
    /// # Errors
    /// Why the built-in interpreter must, though a model was to.
    reading: Result<Option<(String, Reading)>, String>,
    nearest: Option<Nearest>,
    /// Numbers of the replies that are made use of.
    replies: Vec<u64>,
}

impl Answers {
    /// Those in `outputs`, which follow event `order`, about `text`.
    pub fn of(config: &Config, text: &str, order: u64, outputs: &[Event]) -> Self {
        let mut answers = Self { reading: Ok(None), nearest: None, replies: Vec::new() };
        let number = |n: usize| order + 1 + n as u64;
        if config.language == Language::Server {
            answers.reading = match reply(outputs, READING_PROMPT) {
                // Not asked for corrections and long texts: that is for the built-in one.
                None => Ok(None),
                Some((n, reply)) => {
                    answers.replies.push(number(n));
                    read(text, reply).map(Some)
                }
            };
        }
        if let (Some(least), Some((n, reply))) =
            (config.label_similarity, reply(outputs, NEAREST_PROMPT))
        {
            answers.replies.push(number(n));
            let answer = reply.answer.as_ref().ok();
            // Nothing is near, then: what is unknown stays so.
            answers.nearest = answer.and_then(|answer| Nearest::parse(answer, least).ok());
        }
        answers
    }

    /// Has `human` make claims of it.
    pub fn utterance(
        &self,
        human: &mut HumanDetector,
        desk: &mut Desk<'_>,
        order: u64,
        text: &str,
    ) {
        let similarity = self.nearest.as_ref().map(|nearest| nearest as &dyn LabelSimilarity);
        let said = Said { similarity, replies: &self.replies, ..Said::new(order, text) };
        match &self.reading {
            Ok(Some((back_end, reading))) => {
                human.told(desk, &said, reading, back_end.clone().into());
            }
            Ok(None) => human.utterance(desk, &said),
            Err(why) => human.utterance(desk, &Said { instead: Some(why), ..said }),
        }
    }
}

fn read(text: &str, reply: &LanguageReply) -> Result<(String, Reading), String> {
    let answer = reply.answer.as_ref().map_err(Clone::clone)?;
    let reading = parse_reading(text, answer).map_err(|error| error.to_string())?;
    Ok((reply.back_end.to_string(), reading))
}
