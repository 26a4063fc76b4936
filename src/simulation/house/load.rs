//! Finding a house by its name or its file: [`load`].

use std::path::Path;

use serde_json::Value;

use super::built_in::{BUILT_IN, BuiltIn};
use super::error::LoadError;
use super::{House, HouseError, build, from_graph, read};
use crate::interchange::{scene, virtualhome};

/// A house, and what had to be mended to make it one.
#[derive(Clone, Debug, PartialEq)]
pub struct Loaded {
    /// The house.
    pub house: House,
    /// What was left out or changed; empty for house files, which are right or refused.
    pub notes: Vec<String>,
}

/// The house of this name, or in this file: a house file, the graph of a VirtualHome apartment,
/// or a scene as `replay --json` prints it. A file of the name goes before a built-in house only
/// if the name has a dot or a slash.
pub fn load(name: &str) -> Result<House, LoadError> {
    load_reported(name).map(|loaded| loaded.house)
}

/// As [`load`], and tells what had to be mended.
pub fn load_reported(name: &str) -> Result<Loaded, LoadError> {
    if let Some(house) = BuiltIn::named(name) {
        let errors = |errors| LoadError::House { file: name.to_owned(), errors };
        return Ok(Loaded { house: house.house().map_err(errors)?, notes: Vec::new() });
    }
    let path = Path::new(name);
    let text = std::fs::read_to_string(path).map_err(|error| match error.kind() {
        std::io::ErrorKind::NotFound => {
            let known = BUILT_IN.map(|house| house.name).join(", ");
            LoadError::Unknown { name: name.to_owned(), known }
        }
        _ => LoadError::Io { path: path.to_owned(), error },
    })?;
    let named =
        path.file_stem().map_or(name.to_owned(), |stem| stem.to_string_lossy().into_owned());
    match kind(&text) {
        Kind::House => {
            let errors = |errors| LoadError::House { file: name.to_owned(), errors };
            let file = read(&text).map_err(|error| errors(vec![error]))?;
            let house = build(&file, path.parent()).map_err(errors)?;
            Ok(Loaded { house, notes: Vec::new() })
        }
        Kind::Graph => of_graph(&text, &named, name),
    }
}

enum Kind {
    House,
    Graph,
}

/// What a text holds: graphs have nodes, or objects with ids and rooms by id.
fn kind(text: &str) -> Kind {
    let Ok(Value::Object(fields)) = serde_json::from_str(text) else { return Kind::House };
    let scene = ["hash", "floors", "buildings", "at"];
    let is_graph =
        fields.contains_key("nodes") || scene.iter().any(|key| fields.contains_key(*key));
    if is_graph { Kind::Graph } else { Kind::House }
}

fn of_graph(text: &str, named: &str, file: &str) -> Result<Loaded, LoadError> {
    let refused = |problem: String| LoadError::Graph { file: file.to_owned(), problem };
    let is_scene = !text.contains("\"nodes\"");
    let graph = if is_scene {
        scene::import(text).map_err(|error| refused(error.to_string()))?.graph
    } else {
        let options = virtualhome::Options { structure: true, ..Default::default() };
        virtualhome::import(text, &options).map_err(|error| refused(error.to_string()))?.graph
    };
    let made = from_graph(&graph, named).map_err(|error: HouseError| refused(error.to_string()))?;
    Ok(Loaded { house: made.house, notes: made.notes })
}
