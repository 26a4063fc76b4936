//! Spoken commands to a home robot (HuRIC): as human input they change nothing, as tasks their
//! theme and goal are found in the command's own map.

use scenefold::change::NodeRef;
use scenefold::modality::human::{ground_errand, read_task};
use serde_json::{Value, json};

use super::{Tally, changes, shared, updater};

fn commands() -> Option<Vec<Value>> {
    let text = shared("huric/commands.jsonl")?;
    Some(text.lines().map(|line| serde_json::from_str(line).unwrap()).collect())
}

fn texts<'a>(of: &'a Value, list: &'a str) -> impl Iterator<Item = &'a str> {
    of[list].as_array().into_iter().flatten().filter_map(Value::as_str)
}

fn list<'a>(of: &'a Value, name: &str) -> &'a [Value] {
    of[name].as_array().map_or(&[], Vec::as_slice)
}

const ROOMS: [&str; 10] = [
    "kitchen",
    "bathroom",
    "bedroom",
    "livingroom",
    "dining_room",
    "hall",
    "corridor",
    "studio",
    "garden",
    "room",
];

/// The command's map: entity 3 is `R3` or `O3`, labelled by its first name.
fn scene(command: &Value) -> String {
    let (mut rooms, mut objects) = (vec![json!({"id": "R999", "label": "somewhere"})], Vec::new());
    for (n, entity) in list(command, "entities").iter().enumerate() {
        let kind = entity["atom"].as_str().unwrap().rsplit_once('_').unwrap().0;
        let label = &entity["names"][0];
        match ROOMS.contains(&kind) {
            true => rooms.push(json!({"id": format!("R{n}"), "label": label})),
            false => objects.push(json!({"id": format!("O{n}"), "label": label, "room": "R999"})),
        }
    }
    json!({"rooms": rooms, "objects": objects}).to_string()
}

fn frames<'a>(command: &'a Value, wanted: &'a [&str]) -> impl Iterator<Item = &'a Value> {
    let is_wanted = |frame: &&Value| wanted.contains(&frame["frame"].as_str().unwrap());
    list(command, "frames").iter().filter(is_wanted)
}

/// The entity that an element names: the longest name that ends in its head, or stands in it.
fn entity(command: &Value, element: &Value) -> Option<u32> {
    let head = element["head"].as_str()?.to_lowercase();
    let text = format!(" {} ", element["text"].as_str()?.to_lowercase());
    let mut found: Vec<(usize, u32)> = Vec::new();
    for (n, entity) in (0..).zip(list(command, "entities")) {
        for name in texts(entity, "names") {
            let name = name.to_lowercase().replace('_', " ");
            let ends =
                name.split(' ').next_back() == Some(&head) || name == head.trim_end_matches('s');
            if ends || text.contains(&format!(" {name} ")) || text.contains(&format!(" {name}s ")) {
                found.push((if ends { name.len() } else { 0 }, n));
            }
        }
    }
    found.into_iter().max().map(|it| it.1)
}

/// Theme and goal by the annotation.
fn truth(command: &Value) -> (Option<u32>, Option<u32>) {
    let (mut theme, mut goal) = (None, None);
    for frame in frames(command, &["Bringing", "Placing", "Taking"]) {
        for element in list(frame, "elements") {
            let head = element["head"].as_str().unwrap_or_default();
            match element["role"].as_str() {
                Some("Theme") if theme.is_none() && head != "it" && head != "them" => {
                    theme = entity(command, element)
                }
                Some("Goal") => {
                    goal = entity(command, element).filter(|_| head != "me" && head != "here")
                }
                _ => {}
            }
        }
    }
    (theme, goal)
}

#[test]
fn commands_change_nothing() {
    let Some(commands) = commands() else { return };
    let mut changing = Vec::new();
    for command in &commands {
        let text = command["sentence"].as_str().unwrap();
        // Statements of place do report something.
        if frames(command, &["Being_located"]).next().is_none()
            && !changes(&updater(&scene(command)), text).is_empty()
        {
            changing.push(text);
        }
    }
    assert!(changing.len() * 100 <= commands.len(), "{changing:?}");
}

#[test]
fn tasks_find_their_theme_and_goal() {
    let Some(commands) = commands() else { return };
    let mut tally = Tally::default();
    for command in &commands {
        let truth = truth(command);
        let Some(frame) = frames(command, &["Bringing", "Placing", "Taking"]).next() else {
            continue;
        };
        if truth == (None, None) {
            continue;
        }
        let text = command["sentence"].as_str().unwrap();
        let home = updater(&scene(command));
        let first = read_task(text).first().map(|errand| ground_errand(home.world(), errand, None));
        let first = first.unwrap_or_default();
        let index = |node: Option<NodeRef>| Some(node?.id?.index()).filter(|index| *index != 999);
        let found = (index(first.object), index(first.support.or(first.target_room)));
        tally.add(frame["frame"].as_str().unwrap(), found == truth);
        if found != truth {
            println!("{text}: {found:?}, not {truth:?}");
        }
    }
    println!("{}", tally.table());
    assert!(tally.share() >= 0.85, "{}", tally.table());
}
