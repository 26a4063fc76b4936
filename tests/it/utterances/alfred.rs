//! Instructions for pick-and-place tasks (ALFRED), written by people who watched the task: object
//! and receptacle, among all classes of the file.

use std::collections::BTreeSet;

use scenefold::change::NodeRef;
use scenefold::modality::human::{ground_errand, read_task};
use serde_json::json;

use super::{Tally, shared, updater};

struct Row {
    object: String,
    receptacle: String,
    instruction: String,
}

fn rows() -> Option<Vec<Row>> {
    let text = shared("alfred/pick_and_place.csv")?;
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let headers = reader.headers().unwrap().clone();
    let column = |name| headers.iter().position(|header| header == name).unwrap();
    let columns = [column("object"), column("receptacle"), column("instruction")];
    let row = |record: Result<csv::StringRecord, _>| {
        let record = record.unwrap();
        let [object, receptacle, instruction] = columns.map(|n| record[n].to_owned());
        Row { object, receptacle, instruction }
    };
    Some(reader.records().map(row).collect())
}

/// One room with one thing of every class.
fn scene(rows: &[Row]) -> String {
    let classes: BTreeSet<&String> =
        rows.iter().flat_map(|row| [&row.object, &row.receptacle]).collect();
    let objects: Vec<_> = classes.iter().map(|class| json!({"label": class})).collect();
    json!({"rooms": [{"label": "room"}], "objects": objects}).to_string()
}

#[test]
fn instructions_name_their_object_and_receptacle() {
    let Some(rows) = rows() else { return };
    let home = updater(&scene(&rows));
    let (mut both, mut object, mut receptacle) =
        (Tally::default(), Tally::default(), Tally::default());
    // Every other row: the rest takes as long again and tells no more.
    for row in rows.iter().step_by(2) {
        let first = read_task(&row.instruction)
            .first()
            .map(|errand| ground_errand(home.world(), errand, None));
        let first = first.unwrap_or_default();
        let is = |node: Option<NodeRef>, class: &str| {
            node.and_then(|it| it.label).is_some_and(|label| label.as_str() == class)
        };
        let right = (is(first.object, &row.object), is(first.support, &row.receptacle));
        object.add("object", right.0);
        receptacle.add("receptacle", right.1);
        both.add("both", right.0 && right.1);
    }
    println!("{}{}{}", object.table(), receptacle.table(), both.table());
    assert!(both.share() >= 0.75, "{}", both.table());
}
