//! The program `vsgl` under another name: a package's tests can run only binaries of its own package, and Cargo then
//! builds them first, in the tests' profile.
//!
//! It tells how much memory and time it took, if the variable `VSGL_USAGE_FILE` names a file to write that into.

use vsgl_tests::usage::{computed, peak};

fn main() -> std::process::ExitCode {
    let code = vsgl_cli::main();
    if let Some(path) = std::env::var_os("VSGL_USAGE_FILE") {
        // Where the system does not tell, nothing is written.
        if let (Some(kib), Some(seconds)) = (peak(), computed()) {
            let _ = std::fs::write(path, format!("{kib} {seconds}"));
        }
    }
    code
}
