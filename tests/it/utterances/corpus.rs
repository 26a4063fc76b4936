//! `tests/data/utterances.jsonl`: sentences over three homes, with the records they must give.
//!
//! A third of it, by the hash of the text, was set aside: while the interpreter was built, only
//! its total was looked at, never its sentences.

use std::collections::BTreeMap;
use std::fs;

use scenefold::change::{Action, ChangeRecord, Outcome};

use super::{Tally, changes, updater};

#[derive(serde::Deserialize)]
struct Line {
    graph: String,
    construction: String,
    text: String,
    /// `removed O3`, `moved O3 to R1 on O7`, `added lamp to R1`, `rejected ambiguous`.
    records: Vec<String>,
}

fn data(path: &str) -> String {
    fs::read_to_string(format!("{}/tests/data/{path}", env!("CARGO_MANIFEST_DIR"))).unwrap()
}

fn corpus() -> Vec<Line> {
    data("utterances.jsonl").lines().map(|line| serde_json::from_str(line).unwrap()).collect()
}

/// FNV-1a, whose remainder by three sets a third aside.
fn is_set_aside(text: &str) -> bool {
    let step = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
    text.bytes().fold(0xcbf2_9ce4_8422_2325, step) % 3 == 0
}

/// A record in the short form of the corpus.
fn short(record: &ChangeRecord) -> String {
    if let Outcome::Rejected { code, .. } = &record.outcome {
        return format!("rejected {code}");
    }
    let claim = &record.claim;
    let id = |node: &scenefold::change::NodeRef| node.id.unwrap().to_string();
    let object = match claim.action {
        Action::Added => claim.object.label.as_ref().unwrap().to_string(),
        _ => id(&claim.object),
    };
    let place = |word: &str, node: &Option<scenefold::change::NodeRef>| {
        let node = node.as_ref().filter(|_| claim.action != Action::Removed);
        node.map_or(String::new(), |node| format!(" {word} {}", id(node)))
    };
    format!(
        "{} {object}{}{}",
        claim.action.as_str(),
        place("to", &claim.target_room),
        place("on", &claim.support)
    )
}

#[derive(Default)]
struct Scores {
    built: Tally,
    aside: Tally,
    /// Sentences that must change nothing and did, of both parts.
    false_changes: usize,
}

fn scores() -> Scores {
    let mut scores = Scores::default();
    let mut homes = BTreeMap::new();
    for line in corpus() {
        let home = homes
            .entry(line.graph.clone())
            .or_insert_with(|| updater(&data(&format!("language/{}.json", line.graph))));
        let records = changes(home, &line.text);
        let found: Vec<String> = records.iter().map(short).collect();
        let right = found == line.records;
        let aside = is_set_aside(&line.text);
        let tally = if aside { &mut scores.aside } else { &mut scores.built };
        tally.add(&line.construction, right);
        let none = line.records.is_empty() && line.construction.starts_with("none");
        scores.false_changes += usize::from(none && records.iter().any(ChangeRecord::is_applied));
        if !right && !aside {
            println!("{} | {} | {} | {found:?}", line.graph, line.construction, line.text);
        }
    }
    scores
}

#[test]
fn the_corpus_is_large_enough() {
    let corpus = corpus();
    let none = corpus.iter().filter(|line| line.construction.starts_with("none")).count();
    let aside = corpus.iter().filter(|line| is_set_aside(&line.text)).count();
    assert!(corpus.len() - none >= 400 && none >= 150, "{} {none}", corpus.len());
    assert!(aside * 3 >= corpus.len(), "{aside} of {}", corpus.len());
}

#[test]
fn sentences_give_exactly_the_records_they_must() {
    let scores = scores();
    println!("used for building:\n{}", scores.built.table());
    println!("set aside:\n{}", scores.aside.table());
    assert!(scores.aside.share() >= 0.95, "{}", scores.aside.table());
    assert!(scores.built.share() >= 0.95, "{}", scores.built.table());
    assert_eq!(scores.false_changes, 0);
}
