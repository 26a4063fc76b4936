//! Compiles the protobuf contracts in `schemas/` to Rust types and to embedded descriptors.
//!
//! Pure Rust: no `protoc` is needed.

use std::error::Error;
use std::path::Path;
use std::{env, fs};

/// Contracts of the channels, by file stem; each holds one channel message.
const CHANNELS: [&str; 11] = [
    "graph_state",
    "utterance",
    "task",
    "task_status",
    "tick",
    "language_reply",
    "interpretation",
    "staleness",
    "change_record",
    "transaction",
    "checkpoint",
];

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo:rerun-if-changed=schemas");
    println!("cargo:rerun-if-changed=schemas/build.rs");
    let out = env::var("OUT_DIR")?;
    let files = CHANNELS.map(|stem| format!("schemas/scenefold/v1/{stem}.proto"));
    for (stem, file) in CHANNELS.iter().zip(&files) {
        // With what it imports, dependencies first; without comments, which would double it.
        let descriptors = protox::Compiler::new(["schemas"])?
            .include_imports(true)
            .include_source_info(false)
            .open_file(file)?
            .encode_file_descriptor_set();
        fs::write(Path::new(&out).join(format!("{stem}.fds")), descriptors)?;
    }
    prost_build::Config::new().compile_fds(protox::compile(&files, ["schemas"])?)?;
    Ok(())
}
