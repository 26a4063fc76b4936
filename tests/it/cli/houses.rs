//! `house` and `plan`.

use std::fs;

use super::{golden, keys, run};

#[test]
fn houses_are_listed_checked_and_printed() {
    let list = run(&["house"]).expect(0).out;
    for name in ["apartment", "cottage", "loft"] {
        assert!(list.contains(name));
        let json = run(&["house", name, "--json"]).expect(0).json();
        assert_eq!(keys(&json), "classes doors movable name notes objects rooms triangles");
        assert!(json["objects"].as_u64().unwrap() >= 45);
    }
    let printed = run(&["house", "loft", "--print"]).expect(0).out;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.json");
    fs::write(&path, &printed).unwrap();
    let text = run(&["house", &path.display().to_string()]).expect(0).out;
    assert!(text.contains("living room") && text.contains("opens to kitchen"), "{text}");
    assert_eq!(run(&["house", "--json"]).expect(0).json().as_array().unwrap().len(), 3);
}

#[test]
fn a_wrong_house_names_the_file_and_the_field() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.json");
    let text =
        run(&["house", "cottage", "--print"]).out.replacen("\"yaw\": 90", "\"yaw\": 9000", 1);
    fs::write(&path, text).unwrap();
    let path = path.display().to_string();
    run(&["house", &path]).expect(1).says(&["mine.json: objects[", "].yaw: 9000"]);
    run(&["plan", &path]).expect(1).says(&["mine.json"]);
    run(&["house", "chateau"]).expect(1).says(&["chateau", "apartment, cottage, loft"]);
    run(&["house", "--print"]).expect(2);
    run(&["house", "chateau", "--print"]).expect(2);
}

#[test]
fn plans_are_written_as_svg_and_png() {
    let folder = tempfile::tempdir().unwrap();
    let recording = golden("household_day").display().to_string();
    let svg = run(&["plan", "apartment"]).expect(0).out;
    assert!(svg.starts_with("<svg") && svg.ends_with("</svg>\n"));
    assert_eq!(run(&["plan", "apartment"]).out, svg);
    let at = |name: &str| folder.path().join(name).display().to_string();
    for (n, args) in [
        vec!["loft", "--width", "300"],
        vec![recording.as_str(), "--at", "8h", "--width", "300"],
        vec![recording.as_str(), "--since", "start", "--probability", "--width", "300"],
    ]
    .into_iter()
    .enumerate()
    {
        let out = at(&format!("{n}.png"));
        let mut line = vec!["plan"];
        line.extend(args);
        line.extend(["-o", &out]);
        run(&line).expect(0);
        assert_eq!(fs::read(&out).unwrap()[1..4], *b"PNG");
        run(&line).expect(1).says(&["choose another name"]);
    }
    let scene = at("scene.json");
    fs::write(&scene, run(&["replay", &recording, "--json"]).out).unwrap();
    assert!(run(&["plan", &scene]).expect(0).out.contains("KITCHEN"));
    run(&["plan", "loft", "-o", "plan.jpg"]).expect(2).says(&["plan.jpg", ".svg"]);
    run(&["plan", "loft", "--since", "start"]).expect(2).says(&["recordings"]);
    run(&["plan", "no_such_file"]).expect(1).says(&["no_such_file"]);
}
