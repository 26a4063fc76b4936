//! What people say, in numbers: the corpus of this project, and commands and instructions that
//! others collected.

mod alfred;
mod corpus;
mod huric;

use std::collections::BTreeMap;

use scenefold::change::ChangeRecord;
use scenefold::event::{Event, Utterance};
use scenefold::interchange::scene;
use scenefold::updater::{Config, Updater};

/// An updater whose graph is that of a scene.
fn updater(scene: &str) -> Updater {
    let import = scene::import(scene).unwrap();
    let mut updater = Updater::new(Config::default());
    updater.update(import.start, Event::InitialGraph(import.graph)).unwrap();
    updater
}

/// What a sentence changes, said by itself.
fn changes(updater: &Updater, text: &str) -> Vec<ChangeRecord> {
    let mut updater = updater.clone();
    let at = updater.at();
    let said = Utterance { speaker: String::new(), text: text.to_owned() };
    let logged = updater.update(at, Event::Utterance(said)).unwrap();
    let change = |event| match event {
        Event::Change(record) => Some(record),
        _ => None,
    };
    logged.into_iter().filter_map(|logged| change(logged.event)).collect()
}

/// The text of a file of the shared data; `None` where there is none.
fn shared(path: &str) -> Option<String> {
    let folder = std::env::var("SCENEFOLD_SHARED_DATA").ok()?;
    Some(std::fs::read_to_string(format!("{folder}/{path}")).unwrap())
}

/// Right and all, by kind.
#[derive(Default)]
struct Tally(BTreeMap<String, (usize, usize)>);

impl Tally {
    fn add(&mut self, kind: &str, right: bool) {
        let of = self.0.entry(kind.to_owned()).or_default();
        of.0 += usize::from(right);
        of.1 += 1;
    }

    fn share(&self) -> f64 {
        let (right, all) = self.0.values().fold((0, 0), |sum, of| (sum.0 + of.0, sum.1 + of.1));
        right as f64 / all as f64
    }

    /// One line per kind, then the sum.
    fn table(&self) -> String {
        let lines =
            self.0.iter().map(|(kind, (right, all))| format!("{kind:24} {right:4} of {all}\n"));
        lines.collect::<String>() + &format!("{:24} {:.3}\n", "share", self.share())
    }
}
