//! `--json` documents have the keys of the contract, and no others.

use serde_json::Value;

use super::{damaged, golden, keys, on_recording, run};

const CHANGE: &str = "action at code confidence detector evidence held modality object occurred \
                      outcome pose reason seq size source_room support target_room";
const OBJECT: &str =
    "decay_rate id label last_observed pose pose_source probability room size support";

fn every<'v>(value: &'v Value, key: &str) -> &'v Vec<Value> {
    let list = value[key].as_array().unwrap();
    assert!(!list.is_empty(), "{key}");
    list
}

#[test]
fn info_tells_what_is_in_a_recording() {
    let json = on_recording("info REC --json").expect(0).json();
    assert_eq!(
        keys(&json),
        "changes channels checkpoints damage end finished library messages primitives program \
         segments start"
    );
    for channel in every(&json, "channels") {
        assert_eq!(keys(channel), "count encoding schema topic");
    }
    let counted: u64 =
        every(&json, "channels").iter().map(|channel| channel["count"].as_u64().unwrap()).sum();
    assert_eq!(json["messages"].as_u64(), Some(counted));
    assert_eq!(json["start"], "2026-01-05T00:00:01Z");
}

#[test]
fn log_is_a_stream_of_change_records() {
    let records = on_recording("log REC --json").expect(0).json_lines();
    assert_eq!(records.len(), 22);
    for (record, seq) in records.iter().zip(1_u64..) {
        assert_eq!(keys(record), CHANGE);
        assert_eq!(record["seq"], seq);
        assert_eq!(keys(&record["object"]), "id label");
        assert_eq!(keys(&record["occurred"]), "not_after not_before");
        for evidence in every(record, "evidence") {
            assert_eq!(keys(evidence), "order topic");
        }
    }
    let rejected = on_recording("log REC --json --rejected").expect(0).json_lines();
    assert!(rejected.iter().all(|record| record["outcome"] == "rejected"));
    assert!(!rejected.is_empty() && rejected.len() < records.len());
    let vase = on_recording("log REC --json --object vase").expect(0).json_lines();
    assert!(vase.iter().all(|record| record["object"]["label"] == "vase"));
    assert_eq!(vase.len(), 2);
    let by_id = on_recording("log REC --json --object O2 --modality action").json_lines();
    assert!(by_id.iter().all(|record| record["object"]["id"] == "O2"));
    assert_eq!(on_recording("log REC --json --modality human").expect(0).out, "");
}

#[test]
fn replay_is_the_graph() {
    let json = on_recording("replay REC --json").expect(0).json();
    assert_eq!(keys(&json), "at buildings floors hash held objects rooms");
    for room in every(&json, "rooms") {
        assert_eq!(keys(room), "access_to floor id label pose size");
    }
    for object in every(&json, "objects").iter().chain(every(&json, "held")) {
        assert_eq!(keys(object), OBJECT);
        assert_eq!(keys(&object["pose"]), "orientation position");
        assert_eq!(keys(&object["pose"]["orientation"]), "w x y z");
        let probability = object["probability"].as_f64().unwrap();
        assert!((0.0..=1.0).contains(&probability));
    }
    let by_hand = golden("every_primitive").display().to_string();
    let json = run(&["replay", &by_hand, "--json"]).expect(0).json();
    assert_eq!(keys(&every(&json, "floors")[0]), "building id label pose size");
    let hydra = golden("hydra_apartment").display().to_string();
    let json = run(&["replay", &hydra, "--json"]).expect(0).json();
    assert_eq!(keys(&every(&json, "buildings")[0]), "id label pose size");
}

#[test]
fn diff_tells_what_differs() {
    let json = on_recording("diff REC --json").expect(3).json();
    assert_eq!(keys(&json), "added changed moved removed");
    assert_eq!(every(&json, "added")[0]["id"], "O7");
    assert_eq!(keys(&every(&json, "moved")[0]), "angle distance fields from id label to");
    let same = on_recording("diff REC REC --json").expect(0).json();
    assert!(same.as_object().unwrap().values().all(|list| list == &Value::Array(vec![])));
}

#[test]
fn why_is_a_chain_to_the_inputs() {
    let json = on_recording("why REC O4 --json").expect(0).json();
    assert_eq!(keys(&json), "events initial namesakes object state upto");
    for event in every(&json, "events") {
        assert_eq!(
            keys(event),
            "along_with also at change evidence find inputs order primitive sightings"
        );
    }
    let caused = every(&json, "events").iter().find(|event| !event["primitive"].is_null());
    let caused = caused.unwrap();
    assert_eq!(keys(&caused["change"]), CHANGE);
    assert_eq!(every(caused, "inputs")[0]["topic"], "/robot/task_status");
}

#[test]
fn bisect_names_the_event() {
    let json = on_recording("bisect REC --when absent(O4) --json").expect(0).json();
    assert_eq!(keys(&json), "at change order");
    let never = on_recording("bisect REC --when objects>100 --json").expect(3).json();
    assert_eq!(never["order"], Value::Null);
}

#[test]
fn reprocess_and_verify_tell_what_is_different() {
    let json = on_recording("reprocess REC --json").expect(0).json();
    assert_eq!(keys(&json), "differences different equal hash inputs");
    assert_eq!(json["equal"], true);
    let json = on_recording("verify REC --json").expect(0).json();
    let verify = "chain checkpoints events findings hash missing_after reprocessed status";
    assert_eq!(keys(&json), verify);
    assert_eq!(json["status"], "intact");
    let by_hand = golden("every_primitive").display().to_string();
    let json = run(&["verify", "--json", &by_hand]).expect(3).json();
    assert_eq!(keys(&every(&json, "findings")[0]), "segment status what");
    let json = run(&["reprocess", "--json", &by_hand]).expect(3).json();
    assert_eq!(keys(&every(&json, "differences")[0]), "at now order recorded");
}

#[test]
fn recover_lists_what_is_lost() {
    let folder = tempfile::tempdir().unwrap();
    let (bad, saved) = (damaged(folder.path()), folder.path().join("saved.mcap"));
    let (bad, saved) = (bad.display().to_string(), saved.display().to_string());
    let json = run(&["recover", &bad, "-o", &saved, "--json"]).expect(3).json();
    assert_eq!(keys(&json), "damage edited_before lost messages_recovered");
    assert_eq!(keys(&every(&json, "lost")[0]), "first_event last_event");
    let info = run(&["info", &saved, "--json"]).expect(0).json();
    assert_eq!(info["messages"], json["messages_recovered"]);
}

#[test]
fn snapshot_and_import_tell_what_they_did() {
    let json = on_recording("snapshot REC --dir no_such_folder --json").expect(3).json();
    assert_eq!(keys(&json), "accepted failed passed");
    assert_eq!(keys(&every(&json, "failed")[0]), "diff golden reason recording");
    let folder = tempfile::tempdir().unwrap();
    let (scene, out) = (folder.path().join("a.json"), folder.path().join("a.mcap"));
    std::fs::write(&scene, on_recording("replay REC --json").out).unwrap();
    let (scene, out) = (scene.display().to_string(), out.display().to_string());
    let json = run(&["import", "scene", &scene, "-o", &out, "--json"]).expect(0).json();
    for key in ["recording", "events", "changes", "primitives", "hash", "chain"] {
        assert!(!json[key].is_null(), "{key}");
    }
}
