//! The program `vsgl` under another name: a package's tests can run only binaries of its own package, and Cargo then
//! builds them first, in the tests' profile.

fn main() -> std::process::ExitCode {
    vsgl_cli::main()
}
