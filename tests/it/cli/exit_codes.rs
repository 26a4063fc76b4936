//! 0 clean, 1 failure, 2 usage, 3 finished with findings.

use super::{damaged, golden, on_recording, run};

#[test]
fn clean_runs_exit_with_0() {
    for line in [
        "info REC",
        "log REC",
        "log REC --rejected",
        "replay REC",
        "replay REC --at start",
        "replay REC --at 12.5s",
        "replay REC --at 2026-01-05T00:00:20Z",
        "replay REC --at #20",
        "replay REC --at c3",
        "replay REC --at 1767571215000000000",
        "diff REC REC",
        "why REC O4",
        "bisect REC --when absent(O4)",
        "reprocess REC",
        "verify REC",
        "export REC --format scene",
        "export REC --format spark-dsg",
        "export REC --format dot",
        "--version",
        "--help",
    ] {
        let ran = on_recording(line).expect(0);
        assert_eq!(ran.err, "", "{line}");
        assert!(!ran.out.is_empty(), "{line}");
    }
}

#[test]
fn failures_exit_with_1() {
    for line in [
        "info no_such_file",
        "log no_such_file",
        "replay no_such_file",
        "diff REC no_such_file",
        "why no_such_file mug",
        "bisect no_such_file --when objects>1",
        "reprocess no_such_file",
        "verify no_such_file",
        "recover no_such_file -o never.mcap",
        "snapshot no_such_file",
        "import scene no_such_file -o never.mcap",
        "export no_such_file --format dot",
        "ingest --graph no_such_file -o never.mcap",
    ] {
        on_recording(line).expect(1).says(&["no such file", "No such file"]);
    }
    for line in ["replay REC --at #900", "replay REC --at c900", "why REC unicorn"] {
        on_recording(line).expect(1);
    }
    assert!(!std::path::Path::new("never.mcap").exists());
}

#[test]
fn wrong_use_exits_with_2() {
    for line in [
        "frobnicate",
        "info",
        "replay REC --at noon",
        "diff REC --tolerance=-1",
        "diff REC --tolerance=NaN",
        "why REC",
        "why REC mug",
        "bisect REC",
        "bisect REC --when absent(mug",
        "log REC --modality smell",
        "export REC",
        "export REC --format svg",
        "recover REC",
        "snapshot",
        "snapshot REC REC",
        "import scene REC",
        "ingest",
    ] {
        let ran = on_recording(line).expect(2);
        assert!(ran.err.starts_with("error: "), "{line}: {}", ran.err);
        assert_eq!(ran.out, "", "{line}");
    }
}

#[test]
fn findings_exit_with_3() {
    for line in [
        "diff REC",
        "diff REC --from start --to end",
        "bisect REC --when objects>100",
        "snapshot REC --dir no_such_folder",
    ] {
        assert!(!on_recording(line).expect(3).out.is_empty(), "{line}");
    }
    let by_hand = golden("every_primitive").display().to_string();
    run(&["verify", &by_hand]).expect(3);
    run(&["reprocess", &by_hand]).expect(3);
}

#[test]
fn damage_is_a_finding_of_every_command_that_meets_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = damaged(folder.path()).display().to_string();
    let saved = folder.path().join("saved.mcap").display().to_string();
    for args in [
        vec!["log", &path],
        vec!["verify", &path],
        vec!["recover", &path, "-o", &saved],
        vec!["why", &path, "O4"],
    ] {
        run(&args).expect(3);
    }
    assert!(run(&["log", &path]).err.contains("warning: damaged.mcap: "));
    run(&["verify", &saved]).expect(0);
    // What stands before the damage, or after a later checkpoint, is certain.
    run(&["replay", &path, "--at", "start"]);
    let json = run(&["verify", &path, "--json"]).expect(3).json();
    assert_eq!(json["status"], "corrupt");
}
