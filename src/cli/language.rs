//! Which models read language: flags and environment to [`Models`].

use std::time::Duration;

use anyhow::Context;

use super::UsageError;
use crate::modality::human::LanguageModel;
use crate::model::Models;
use crate::model::chat::{ApiKey, Chat, ChatOptions, Endpoint};
use crate::time::Span;
use crate::updater::{Config, Language};

/// Who reads sentences: the built-in interpreter, unless a server is named.
#[derive(Clone, Debug, Default, clap::Args)]
#[command(next_help_heading = "Language")]
pub struct LanguageArgs {
    /// Chat server that reads sentences (OpenAI-compatible: hosted, or llama.cpp, vLLM, Ollama on
    /// this machine), such as <http://localhost:11434/v1>; with --model alone, `OPENAI_BASE_URL`.
    /// Where it fails, the built-in interpreter reads, and the recording says so
    #[arg(long, value_name = "URL")]
    server: Option<String>,
    /// Model to ask for
    #[arg(long, value_name = "NAME")]
    model: Option<String>,
    /// Environment variable that holds the key of the server, `OPENAI_API_KEY` if none is named;
    /// the key is never recorded or printed
    #[arg(long, value_name = "NAME")]
    key_env: Option<String>,
    /// Longest wait for one answer of the server; it is asked up to three times
    #[arg(long, value_name = "SPAN", default_value = "30s")]
    server_timeout: Span,
    /// Folder of a sentence-transformers model (BERT, safetensors) that finds the nearest known
    /// label for a name that nobody knows
    #[cfg(feature = "embeddings")]
    #[arg(long, value_name = "DIR")]
    embeddings: Option<std::path::PathBuf>,
}

/// Least similarity at which a label is taken for a name nobody knows, unless the configuration
/// says otherwise. With all-MiniLM-L6-v2, nine of twelve pairs of synonyms are above it, and none
/// of twelve pairs of things that stand side by side.
#[cfg(feature = "embeddings")]
const LEAST_SIMILARITY: f64 = 0.6;

impl LanguageArgs {
    /// Whether a server is to be asked.
    pub fn asks_server(&self) -> bool {
        self.server.is_some() || self.model.is_some()
    }

    /// `config` with what these arguments ask for.
    pub fn applied_to(&self, mut config: Config) -> Config {
        if self.asks_server() {
            config.language = Language::Server;
        }
        #[cfg(feature = "embeddings")]
        if self.embeddings.is_some() {
            config.label_similarity.get_or_insert(LEAST_SIMILARITY);
        }
        config
    }

    /// The models that `config` asks for, as these arguments name them.
    ///
    /// # Errors
    /// [`UsageError`] if the two do not fit, or something is missing.
    pub fn models(&self, config: &Config) -> anyhow::Result<Models> {
        let chat = match (config.language, self.asks_server()) {
            (Language::Server, true) => Some(self.chat()?),
            (Language::Server, false) => {
                return usage("language is read by a server here: name it by --server and --model");
            }
            (Language::Builtin, true) => {
                return usage(
                    "this recording's language is read by the built-in interpreter: leave out \
                     --server and --model, or start a new recording",
                );
            }
            (Language::Builtin, false) => None,
        };
        let nearest = self.nearest(config)?;
        Ok(Models { chat: chat.map(|chat| Box::new(chat) as _), nearest })
    }

    #[cfg(feature = "embeddings")]
    fn nearest(&self, config: &Config) -> anyhow::Result<Option<Box<dyn LanguageModel>>> {
        match (&self.embeddings, config.label_similarity) {
            (Some(folder), Some(_)) => {
                Ok(Some(Box::new(crate::model::embed::Embeddings::load(folder)?)))
            }
            (None, None) => Ok(None),
            (None, Some(_)) => usage("names are compared by a model here: name it by --embeddings"),
            (Some(_), None) => usage(
                "this recording's names are compared by no model: leave out --embeddings, or \
                 start a new recording",
            ),
        }
    }

    #[cfg(not(feature = "embeddings"))]
    #[allow(clippy::unused_self)]
    fn nearest(&self, config: &Config) -> anyhow::Result<Option<Box<dyn LanguageModel>>> {
        match config.label_similarity {
            None => Ok(None),
            Some(_) => usage("label_similarity needs the cargo feature `embeddings`"),
        }
    }

    fn chat(&self) -> anyhow::Result<Chat> {
        let Some(model) = &self.model else {
            return usage("name the model to ask for by --model");
        };
        let (base, from) = match (&self.server, variable("OPENAI_BASE_URL")?) {
            (Some(base), _) => (base.clone(), "--server"),
            (None, Some(base)) => (base, "OPENAI_BASE_URL"),
            (None, None) => {
                return usage("name the server by --server, or in OPENAI_BASE_URL");
            }
        };
        let endpoint =
            Endpoint::new(&base).map_err(|error| UsageError(format!("{from}: {error}")))?;
        let timeout = Duration::from_nanos(self.server_timeout.0);
        let options = ChatOptions { timeout, ..ChatOptions::default() };
        Ok(Chat::new(endpoint, model, self.key()?, options))
    }

    fn key(&self) -> anyhow::Result<Option<ApiKey>> {
        let name = self.key_env.as_deref().unwrap_or("OPENAI_API_KEY");
        match variable(name)? {
            Some(text) => {
                let wrong = |error| UsageError(format!("the key in {name}: {error}"));
                Ok(Some(ApiKey::new(&text).map_err(wrong)?))
            }
            None if self.key_env.is_some() => {
                usage(&format!("{name} is not set: it must hold the key"))
            }
            None => Ok(None),
        }
    }
}

/// An environment variable; an empty one is none. What it holds is not for error messages.
fn variable(name: &str) -> anyhow::Result<Option<String>> {
    let Some(value) = std::env::var_os(name).filter(|value| !value.is_empty()) else {
        return Ok(None);
    };
    let text = value.into_string().ok().with_context(|| format!("{name} is not text in UTF-8"))?;
    Ok(Some(text))
}

fn usage<T>(what: &str) -> anyhow::Result<T> {
    Err(UsageError(what.to_owned()).into())
}
