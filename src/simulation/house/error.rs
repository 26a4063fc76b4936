//! Why a house was refused: [`HouseError`], [`LoadError`].

use std::path::PathBuf;

/// One thing that is wrong with a house.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{path}: {problem}")]
pub struct HouseError {
    /// Where in the file: `objects[3].size[1]`.
    pub path: String,
    /// What is wrong, and how to mend it.
    pub problem: String,
}

impl HouseError {
    /// A complaint about a field.
    pub(super) fn new(path: impl Into<String>, problem: impl Into<String>) -> Self {
        Self { path: path.into(), problem: problem.into() }
    }
}

/// Why there is no house of this name, or in this file.
#[derive(Debug, thiserror::Error)]
pub enum LoadError {
    /// Neither a built-in house nor a file.
    #[error("{name}: there is no such file, and no built-in house of this name; there are {known}")]
    Unknown {
        /// What was asked for.
        name: String,
        /// Names of the built-in houses.
        known: String,
    },
    /// The file cannot be read.
    #[error("{}: {error}", .path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// Why.
        error: std::io::Error,
    },
    /// The house is not possible, or the file not a house file.
    #[error("{}", listed(.file, .errors))]
    House {
        /// The file, or the name of the built-in house.
        file: String,
        /// What is wrong, in the order of the file.
        errors: Vec<HouseError>,
    },
    /// The graph could not be read.
    #[error("{file}: {problem}")]
    Graph {
        /// The file.
        file: String,
        /// Why.
        problem: String,
    },
}

/// The first complaints, one a line.
fn listed(file: &str, errors: &[HouseError]) -> String {
    const SHOWN: usize = 8;
    let mut lines: Vec<String> =
        errors.iter().take(SHOWN).map(|error| format!("{file}: {error}")).collect();
    if errors.len() > SHOWN {
        lines.push(format!("{file}: and {} more", errors.len() - SHOWN));
    }
    lines.join("\n       ")
}
