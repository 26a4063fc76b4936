//! `LanguageReply`.

use super::common::{evidence, read_evidence};
use super::fields::{Fields, required};
use super::{WireError, proto};
use crate::event::{LanguageReply, MAX_ANSWER, MAX_SENTENCE};

pub(super) fn language_reply(reply: &LanguageReply) -> proto::LanguageReply {
    use proto::language_reply::Outcome;
    let outcome = match &reply.answer {
        Ok(answer) => Outcome::Answer(answer.clone()),
        Err(error) => Outcome::Error(error.clone()),
    };
    proto::LanguageReply {
        of: Some(evidence(&reply.of)),
        back_end: reply.back_end.to_string(),
        model: reply.model.clone(),
        prompt: reply.prompt.to_string(),
        request: reply.request.clone(),
        outcome: Some(outcome),
        attempts: reply.attempts,
        latency_nanos: reply.latency_nanos,
    }
}

pub(super) fn read_language_reply(payload: &[u8]) -> Result<LanguageReply, WireError> {
    const NAME: &str = "LanguageReply";
    let mut fields = Fields::new(NAME, payload);
    let (mut of, mut answer) = (None, None);
    let (mut back_end, mut model, mut prompt, mut request) = ("", "", "", "");
    let (mut attempts, mut latency_nanos) = (0, 0);
    while let Some(field) = fields.next()? {
        match field.number {
            1 => field.once(&mut of, read_evidence(&field)?)?,
            2 => back_end = field.text("back_end")?,
            3 => model = field.text("model")?,
            4 => prompt = field.text("prompt")?,
            5 => request = field.long_text("request", MAX_SENTENCE)?,
            6 => answer = Some(Ok(field.long_text("answer", MAX_ANSWER)?.to_owned())),
            7 => answer = Some(Err(field.long_text("error", MAX_ANSWER)?.to_owned())),
            8 => attempts = field.u32("attempts")?,
            9 => latency_nanos = field.u64()?,
            _ => {}
        }
    }
    Ok(LanguageReply {
        of: required(of, NAME, "of")?,
        back_end: back_end.to_owned().into(),
        model: model.to_owned(),
        prompt: prompt.to_owned().into(),
        request: request.to_owned(),
        answer: required(answer, NAME, "outcome")?,
        attempts,
        latency_nanos,
    })
}
