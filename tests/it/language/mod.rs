//! Language models: how a server is asked, what is recorded of it, what becomes of what it says.

mod faults;
mod grounded;
mod llama;
#[cfg(feature = "embeddings")]
mod nearest;
mod program;
mod recorded;
mod server;
