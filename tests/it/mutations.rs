//! Thousands of damaged recordings: no panic, no abort, no hang, bounded memory, and what is
//! saved of them is intact.
//!
//! The work is done by a child process under limits of the system, so that even an abort or an
//! absurd allocation is a failed test and not a dead machine.

use std::fs;
use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::process::Command;

use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use scenefold::history::{Selector, first_holding, why};
use scenefold::recording::{RecorderOptions, Recording, Status, SyncPolicy, Walk, recover, verify};
use scenefold::time::At;

use crate::house::{MANY_CHECKPOINTS, inputs, record};
use crate::kill::Dice;
use crate::synthetic;

/// Set in the child process.
const CHILD: &str = "SCENEFOLD_MUTATIONS_CHILD";
const MUTATIONS: u64 = 3000;
/// Address space of the child, KiB: threads reserve much more than they use.
const ADDRESS_KIB: u64 = 4 << 20;
/// What the child may really use, KiB.
const PEAK_KIB: u64 = 600 << 10;
/// Processor time after which the child counts as hanging.
const CPU_SECONDS: u64 = 400;

#[test]
fn damaged_recordings_are_survived() {
    if std::env::var_os(CHILD).is_some() {
        return mutate_all();
    }
    let this = std::env::current_exe().unwrap();
    let limits = format!("ulimit -v {ADDRESS_KIB}; ulimit -t {CPU_SECONDS}; exec \"$0\" \"$@\"");
    let name = "mutations::damaged_recordings_are_survived";
    let output = Command::new("sh")
        .args(["-c", &limits])
        .arg(this)
        .args(["--exact", name, "--nocapture"])
        .env(CHILD, "1")
        .output()
        .unwrap();
    let text = String::from_utf8_lossy(&output.stdout);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{:?}\n{text}\n{errors}", output.status);
    assert!(text.contains("1 passed"), "{text}");
}

fn mutate_all() {
    let folder = tempfile::tempdir().unwrap();
    let bases = bases(folder.path());
    let mut failures = Vec::new();
    for seed in 1..=MUTATIONS {
        let mut dice = Dice(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
        let (mut bytes, saved_as) = bases[seed as usize % bases.len()].clone();
        let mut what = format!("seed {seed}:");
        for _ in 0..=dice.below(3) {
            what += &format!(" {}", mutate(&mut bytes, &mut dice));
        }
        let tried = catch_unwind(AssertUnwindSafe(|| survive(&bytes, &saved_as, folder.path())));
        match tried {
            Ok(Ok(())) => {}
            Ok(Err(why)) => failures.push(format!("{what}\n  {why}")),
            Err(_) => failures.push(format!("{what}\n  panicked")),
        }
    }
    let shown = failures[..failures.len().min(20)].join("\n");
    assert!(failures.is_empty(), "{} of {MUTATIONS}:\n{shown}", failures.len());
    if let Some(peak) = peak_kib() {
        assert!(peak < PEAK_KIB, "{peak} KiB were used");
    }
}

/// Most memory this process ever used, where the system tells.
fn peak_kib() -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    line.split_whitespace().nth(1)?.parse().ok()
}

/// Some recordings that are small, so that every part of them is hit, and what verify may call
/// what is saved of them; of files of other programs, which promise nothing, anything.
fn bases(folder: &Path) -> Vec<(Vec<u8>, Vec<Status>)> {
    let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &[7; 32]);
    let mut runner = TestRunner::new_with_rng(Config::default(), rng);
    let mut recorded = |name: &str, options: &RecorderOptions, chunk_after| {
        let path = folder.join(name);
        let inputs = inputs(12..20).new_tree(&mut runner).unwrap().current();
        record(&path, &inputs, options, chunk_after);
        fs::read(path).unwrap()
    };
    let plain = RecorderOptions { sync: SyncPolicy::Never, ..RecorderOptions::default() };
    let few = recorded("few.mcap", &plain, 100);
    let many = recorded("many.mcap", &MANY_CHECKPOINTS, 3);
    let foreign = foreign(&many, Some(mcap::Compression::Lz4));
    let unchunked = foreign_of(&few);
    let by_hand = vec![Status::Intact, Status::Nondeterministic];
    vec![
        (few, vec![Status::Intact]),
        (many, vec![Status::Intact]),
        (synthetic::every_primitive(), by_hand),
        (foreign, vec![]),
        (unchunked, vec![]),
    ]
}

fn foreign_of(bytes: &[u8]) -> Vec<u8> {
    foreign(bytes, None)
}

/// The same messages as another program would write them: other compression, or no chunks.
fn foreign(bytes: &[u8], compression: Option<mcap::Compression>) -> Vec<u8> {
    let options = mcap::WriteOptions::new().compression(compression).chunk_size(Some(2000));
    let options = options.use_chunks(compression.is_some());
    let mut out = std::io::Cursor::new(Vec::new());
    let mut writer = options.create(&mut out).unwrap();
    for message in mcap::MessageStream::new(bytes).unwrap() {
        writer.write(&message.unwrap()).unwrap();
    }
    writer.finish().unwrap();
    drop(writer);
    out.into_inner()
}

/// Where the records of a file begin, and how long they are with their heads.
fn records(bytes: &[u8]) -> Vec<(usize, usize)> {
    let mut records = Vec::new();
    let mut at = 8;
    while let Some(head) = bytes.get(at..at + 9) {
        let length = u64::from_le_bytes(head[1..].try_into().unwrap());
        let Some(end) = usize::try_from(length).ok().and_then(|n| (at + 9).checked_add(n)) else {
            break;
        };
        if end > bytes.len() {
            break;
        }
        records.push((at, end - at));
        at = end;
    }
    records
}

/// One piece of damage; says which.
fn mutate(bytes: &mut Vec<u8>, dice: &mut Dice) -> String {
    if bytes.len() < 32 {
        return "nothing".to_owned();
    }
    let at = |dice: &mut Dice| dice.below(bytes.len() as u64) as usize;
    let (a, b) = (at(dice), at(dice));
    let (from, to) = (a.min(b), a.max(b));
    let record = |dice: &mut Dice, bytes: &[u8]| {
        let records = records(bytes);
        if records.is_empty() { (8, 9) } else { records[dice.below(records.len() as u64) as usize] }
    };
    match dice.below(14) {
        0..=2 => {
            bytes[a] ^= 1 << dice.below(8);
            format!("flip@{a}")
        }
        3 => {
            let end = (a + 1 + dice.below(64) as usize).min(bytes.len());
            bytes[a..end].iter_mut().for_each(|byte| *byte = dice.below(256) as u8);
            format!("noise@{a}..{end}")
        }
        4 => {
            let end = (a + 1 + dice.below(4000) as usize).min(bytes.len());
            bytes[a..end].fill(0);
            format!("zeros@{a}..{end}")
        }
        5 => {
            bytes.truncate(a);
            format!("truncate@{a}")
        }
        6 => {
            bytes.drain(from..to.min(from + 500));
            format!("cut@{from}..{}", to.min(from + 500))
        }
        7 => {
            let piece: Vec<u8> = bytes[from..to.min(from + 3000)].to_vec();
            bytes.splice(b..b, piece);
            format!("copy@{from}->{b}")
        }
        8..=9 => {
            let (start, _) = record(dice, bytes);
            let wild = [0, 1, 8, 255, 1 << 20, 1 << 31, 1 << 40, u64::MAX - 8, u64::MAX];
            let length = wild[dice.below(wild.len() as u64) as usize];
            if let Some(field) = bytes.get_mut(start + 1..start + 9) {
                field.copy_from_slice(&length.to_le_bytes());
            }
            format!("length@{start}={length}")
        }
        10 => {
            let (start, _) = record(dice, bytes);
            bytes[start] = dice.below(20) as u8;
            format!("opcode@{start}")
        }
        11 => {
            let (start, length) = record(dice, bytes);
            bytes.drain(start..(start + length).min(bytes.len()));
            format!("drop@{start}")
        }
        12 => {
            let (start, length) = record(dice, bytes);
            let piece = bytes[start..(start + length).min(bytes.len())].to_vec();
            let (to, _) = record(dice, bytes);
            bytes.splice(to..to, piece);
            format!("double@{start}->{to}")
        }
        _ => {
            let (one, other) = (record(dice, bytes), record(dice, bytes));
            let (first, second) = if one.0 < other.0 { (one, other) } else { (other, one) };
            let end = second.0 + second.1;
            if first.0 + first.1 <= second.0 && end <= bytes.len() {
                let swapped = [
                    &bytes[second.0..end],
                    &bytes[first.0 + first.1..second.0],
                    &bytes[first.0..first.0 + first.1],
                ]
                .concat();
                bytes.splice(first.0..end, swapped);
            }
            format!("swap@{},{}", one.0, other.0)
        }
    }
}

/// Everything that reads a recording, on these bytes.
fn survive(bytes: &[u8], saved_as: &[Status], folder: &Path) -> Result<(), String> {
    let (path, saved): (PathBuf, PathBuf) = (folder.join("bad.mcap"), folder.join("saved.mcap"));
    let _ = fs::remove_file(&saved);
    fs::write(&path, bytes).unwrap();
    let Ok(recording) = Recording::open(&path) else {
        let _ = verify(&path, &mut |_| ());
        return Ok(());
    };
    read_all(&recording);
    let verified = verify(&path, &mut |_| ());
    let recovered = recover(&Recording::scan(&path).unwrap(), &saved, &mut |_| ());
    match (verified, recovered) {
        (Ok(found), Ok(_)) if found.status == Status::Intact && !saved_as.is_empty() => {
            let sealed = recording.seal().map(|seal| seal.chain);
            // Whatever was changed, it was none of the events.
            if sealed != found.chain || !recording.trouble().is_empty() {
                return Err(format!("called intact: {:?}", recording.trouble()));
            }
        }
        (Ok(_), Ok(_)) => {}
        (Ok(_), Err(error)) => return Err(format!("recover refuses: {error}")),
        // A scan trusts other bytes than an index does, and may find no recording in them.
        (Err(_), _) => return Ok(()),
    }
    let intact = verify(&saved, &mut |_| ()).map_err(|error| format!("saved: {error}"))?;
    if saved_as.is_empty() || saved_as.contains(&intact.status) {
        return Ok(());
    }
    Err(format!("saved is {}: {:?}", intact.status.as_str(), intact.findings))
}

fn read_all(recording: &Recording) {
    recording.summary();
    let mut count = 0;
    for walk in [Walk::Events, Walk::Everything] {
        let _ = recording.visit_events(walk, (1, u64::MAX), &mut |_| {
            count += 1;
            ControlFlow::Continue(())
        });
    }
    for (point, threads) in [
        (At::Start, 1),
        (At::End, 1),
        (At::End, 2),
        (At::Event(9), 1),
        (At::Change(2), 1),
        (At::SinceStart(3_000_000_000), 2),
    ] {
        let _ = recording.state_at(point, threads);
    }
    let mug: Result<Selector, _> = "mug".parse();
    let _ = why(recording, u64::MAX, &mug.unwrap());
    let _ = first_holding(recording, &"absent(mug)".parse().unwrap());
    let _ = recording.event(5);
    recording.trouble();
}
