//! Human language: what people say has changed.

mod model;
mod model_excerpt;
mod model_nearest;
mod model_reply;
mod model_request;
#[cfg(test)]
mod tests_model;
mod reading;

pub use model::{LanguageModel, LanguageRequest, NearestQuestion, Question};
pub use model_excerpt::{Excerpt, ObjectEntry, RoomEntry};
pub use model_nearest::{Nearest, NearestAnswer, NearestLabel};
pub use model_reply::{MAX_CHANGES, ReplyError, parse_reading, parse_task};
pub use model_request::{
    ANSWER_SCHEMA, MAX_ASKED, NEAREST_PROMPT, READING_PROMPT, TASK_PROMPT, nearest_request,
    reading_request, task_request,
};
pub use reading::{Mention, Quantity, Reading, Statement, When};
