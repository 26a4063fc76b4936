//! The `scenefold` program: arguments in, exit code out.

use std::process::ExitCode;

fn main() -> ExitCode {
    scenefold::cli::main()
}
