//! Any text as each of the formats that are imported.
#![no_main]

use libfuzzer_sys::fuzz_target;
use scenefold::graph::SceneGraph;
use scenefold::interchange::{Import, actions, scene, spark_dsg, virtualhome};

fuzz_target!(|bytes: &[u8]| {
    let Some((format, text)) = bytes.split_first() else { return };
    let Ok(text) = std::str::from_utf8(text) else { return };
    let import: Option<Import> = match format % 4 {
        0 => scene::import(text).ok(),
        1 => spark_dsg::import(text).ok(),
        2 => virtualhome::import(text, &virtualhome::Options::default()).ok(),
        _ => actions::import(text, &actions::Options::default()).ok(),
    };
    if let Some(import) = import {
        let bytes = import.graph.to_bytes();
        let again = SceneGraph::from_bytes(&bytes);
        assert_eq!(again.as_ref(), Ok(&import.graph), "what is imported can be stored");
    }
});
