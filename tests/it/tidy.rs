//! The shape of the sources: who may use whom, how long files are, how they begin.

use std::fs;
use std::path::{Path, PathBuf};

/// Modules in the order of `lib.rs`, which is that of the alphabet; here by rank: a module may use
/// only those before it.
const RANKS: [&str; 23] = [
    "bytes",
    "time",
    "geometry",
    "graph",
    "change",
    "event",
    "document",
    "interchange",
    "wire",
    "container",
    "history",
    "modality",
    "updater",
    "learn",
    "patrol",
    "recording",
    "snapshot",
    "model",
    "simulation",
    "evaluation",
    "view",
    "cli",
    "testing",
];

const LINES_MAX: usize = 800;

fn files(folder: &Path, extension: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut entries: Vec<PathBuf> =
        fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() {
            found.extend(files(&path, extension));
        } else if path.extension().is_some_and(|found| found == extension) {
            found.push(path);
        }
    }
    found
}

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// Path from the root of the crate, text.
fn sources(folder: &str) -> Vec<(String, String)> {
    let path = root().join(folder);
    let read = |path: PathBuf| {
        let name = path.strip_prefix(root()).unwrap().to_string_lossy().into_owned();
        (name, fs::read_to_string(path).unwrap())
    };
    files(&path, "rs").into_iter().map(read).collect()
}

fn rank(module: &str) -> Option<usize> {
    RANKS.iter().position(|name| *name == module)
}

/// The module of `src` that a file belongs to.
fn module_of(name: &str) -> &str {
    let name = name.strip_prefix("src/").unwrap();
    name.split('/').next().unwrap().trim_end_matches(".rs")
}

fn is_test(name: &str) -> bool {
    name.contains("/tests") || name.contains("testing.rs")
}

/// The part of a file before its tests.
fn before_tests(text: &str) -> &str {
    let Some(end) = text.rfind("\nmod tests {") else { return text };
    match text[..end].rfind("#[cfg(test)]") {
        // Nothing but attributes and comments stands between the two.
        Some(start) if !text[start..end].contains('}') => &text[..start],
        _ => text,
    }
}

/// What a line names after `crate::`.
fn crate_names(line: &str) -> impl Iterator<Item = &str> {
    let code = line.split("//").next().unwrap();
    code.split("crate::").skip(1).map(|rest| {
        let end = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
        &rest[..end]
    })
}

#[test]
fn every_module_has_a_rank() {
    for (name, text) in sources("src") {
        if name == "src/lib.rs" {
            for line in text.lines().filter(|line| line.trim_end().ends_with(';')) {
                let Some((_, module)) = line.split_once("mod ") else { continue };
                let module = module.trim_end().trim_end_matches(';');
                if !module.chars().all(|c| c.is_ascii_lowercase() || c == '_') {
                    continue;
                }
                assert!(rank(module).is_some(), "{module} has no rank in tests/it/tidy.rs");
            }
        }
    }
}

#[test]
fn a_module_uses_only_those_below_it() {
    let mut wrong = Vec::new();
    for (name, text) in sources("src") {
        let Some(own) = rank(module_of(&name)) else { continue };
        if is_test(&name) {
            continue;
        }
        for (n, line) in before_tests(&text).lines().enumerate() {
            for used in crate_names(line).filter_map(rank) {
                if used > own {
                    wrong.push(format!("{name}:{}: uses {}", n + 1, RANKS[used]));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn files_are_short_and_say_what_they_are() {
    let mut wrong = Vec::new();
    for (name, text) in sources("src").into_iter().chain(sources("tests")) {
        if !text.starts_with("//!") {
            wrong.push(format!("{name}: does not begin with //!"));
        }
        if text.lines().count() > LINES_MAX {
            wrong.push(format!("{name}: is longer than {LINES_MAX} lines"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn nothing_is_unwrapped_outside_tests() {
    let mut wrong = Vec::new();
    for (name, text) in sources("src") {
        if is_test(&name) {
            continue;
        }
        for (n, line) in before_tests(&text).lines().enumerate() {
            let code = line.split("//").next().unwrap();
            if code.contains(".unwrap()") {
                wrong.push(format!("{name}:{}: {}", n + 1, line.trim()));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn nothing_names_a_machine() {
    let words = ["/home/", "/root/", "/Users/", "/work/shared", "/work/main"];
    let own = file!().replace('\\', "/");
    let mut wrong = Vec::new();
    for (name, text) in sources("src").into_iter().chain(sources("tests")) {
        for word in words.iter().filter(|word| text.contains(**word) && name != own) {
            wrong.push(format!("{name}: names {word}"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn tests_are_never_ignored() {
    let attribute = ["#[", "ignore"].concat();
    for (name, text) in sources("src").into_iter().chain(sources("tests")) {
        assert!(!text.contains(&attribute), "{name}");
    }
}
